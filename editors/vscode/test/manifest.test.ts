/** What package.json promises: that it is there, and that it fits together. */

import assert from 'node:assert/strict';
import * as fs from 'node:fs';
import * as path from 'node:path';
import { test } from 'node:test';
import { LANGUAGE } from '../src/language';
import { ROOT, readJson } from './surroundings';

const manifest = readJson('package.json');
const { contributes } = manifest;
const launch = contributes.debuggers[0].configurationAttributes.launch;

test('every file that the manifest names exists', () => {
  const files = [
    manifest.main,
    manifest.icon,
    ...contributes.languages.map((language: any) => language.configuration),
    ...contributes.grammars.map((grammar: any) => grammar.path),
    ...contributes.snippets.map((snippets: any) => snippets.path),
  ];
  for (const file of files) {
    assert.ok(fs.statSync(path.join(ROOT, file)).isFile(), file);
  }
});

test('everything is contributed for the one language', () => {
  const [language, ...others] = contributes.languages;
  assert.deepEqual(others, []);
  assert.equal(language.id, LANGUAGE);
  assert.deepEqual(language.extensions, ['.vsh', '.psh', '.vsa', '.psa']);
  for (const list of [contributes.grammars, contributes.snippets, contributes.breakpoints]) {
    assert.deepEqual(list.map((each: any) => each.language), [LANGUAGE]);
  }
  assert.deepEqual(contributes.debuggers[0].languages, [LANGUAGE]);
  assert.equal(contributes.grammars[0].scopeName, readJson('language/d3d8asm.tmLanguage.json').scopeName);
});

test('launch attributes are those that the adapter takes, each with its description', () => {
  assert.deepEqual(Object.keys(launch.properties).toSorted(), [
    'cwd', 'defines', 'dialect', 'draw', 'includes', 'model', 'pixel', 'policies', 'primitive', 'program', 'set', 'shader', 'size', 'stopOnEntry', 'vertex',
  ]);
  assert.deepEqual(launch.required, ['program']);
  assert.equal(launch.properties.stopOnEntry.default, true);
  for (const [name, schema] of Object.entries<any>(launch.properties)) {
    assert.ok(schema.description?.length > 20, name);
  }
});

test('registers that set takes, and those that it does not', () => {
  const [pattern] = Object.keys(launch.properties.set.patternProperties);
  const takes = new RegExp(pattern!);
  for (const register of ['c0', 'c95', 'c255', 'v0', 'v15', 't0', 't5', 'C1']) {
    assert.match(register, takes);
  }
  for (const register of ['r0', 'oPos', 'c', 'c0.x', 'a0', 'x0']) {
    assert.doesNotMatch(register, takes);
  }
});

test('configurations that are offered use attributes that exist, and become JSON', () => {
  const [contributed] = contributes.debuggers;
  const offered = [...contributed.initialConfigurations, ...contributed.configurationSnippets.map((snippet: any) => snippet.body)];
  const known = new Set([...Object.keys(launch.properties), 'type', 'request', 'name']);
  for (const configuration of offered) {
    assert.equal(configuration.type, contributed.type);
    assert.equal(configuration.request, 'launch');
    assert.ok(configuration.program);
    assert.deepEqual(Object.keys(configuration).filter((name) => !known.has(name)), []);
  }
  // A value that begins with ^ is put into launch.json as it stands, so it must be JSON once its variables are.
  for (const text of JSON.stringify(offered).matchAll(/"\^((?:\\.|[^"\\])*)"/g)) {
    const snippet: string = JSON.parse(`"${text[1]}"`);
    const filled = snippet.replace(/(?<!\\)\$\{\d+:([^}]*)\}/g, '$1').replaceAll('\\$', '$');
    assert.match(JSON.parse(filled), /^\$\{(?:file|workspaceFolder|command:AskPixel)\}/);
  }
});

test('commands, variables and menus name what exists', () => {
  const commands = contributes.commands.map((command: any) => command.command);
  for (const item of Object.values<any>(contributes.menus).flat()) {
    assert.ok(commands.includes(item.command), item.command);
  }
  for (const command of Object.values(contributes.debuggers[0].variables)) {
    assert.ok(commands.includes(command), String(command));
  }
});

test('the matcher names a pattern that exists', () => {
  const names = contributes.problemPatterns.map((pattern: any) => `$${pattern.name}`);
  assert.deepEqual(contributes.problemMatchers.map((matcher: any) => matcher.pattern), names);
});

test('a workspace that is not trusted chooses no program', () => {
  assert.ok(manifest.capabilities.untrustedWorkspaces.restrictedConfigurations.includes('texcrd.path'));
});

test('words end where a hover should', () => {
  const words = new RegExp(readJson('language/configuration.json').wordPattern, 'g');
  const expected: [line: string, words: string[]][] = [
    ['+mad r0.rgb, r3, -r4_x2.r, 1-r1', ['mad', 'r0.rgb', 'r3', 'r4_x2.r', '1', 'r1']],
    ['ps.1.4', ['ps.1.4']],
    ['mov oT0.xy,c[a0.x + 3].yz', ['mov', 'oT0.xy', 'c[a0.x + 3].yz']],
    ['def c94, 0.18f, .5, 1e-3, 2', ['def', 'c94', '0.18f', '.5', '1e-3', '2']],
    ['mul_x2_sat r0, TEX_NORMALMAP_bx2, c0', ['mul_x2_sat', 'r0', 'TEX_NORMALMAP_bx2', 'c0']],
  ];
  for (const [line, parts] of expected) {
    assert.deepEqual(line.match(words), parts);
  }
});

test('the lock file names no place where packages were got', () => {
  const lock = readJson('package-lock.json');
  for (const [name, entry] of Object.entries<any>(lock.packages)) {
    assert.match(entry.resolved ?? 'https://registry.npmjs.org/', /^https:\/\/registry\.npmjs\.org\//, name);
  }
  assert.equal(lock.version, manifest.version);
});
