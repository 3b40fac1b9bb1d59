/** The grammar against the tables of the crate: what is an instruction, a modifier, a register is decided there. */

import assert from 'node:assert/strict';
import * as fs from 'node:fs';
import { test } from 'node:test';
import { readJson } from './surroundings';
import * as tables from './tables';
import { GRAMMAR, tokenizeLine } from './tokens';

const repository = JSON.parse(fs.readFileSync(GRAMMAR, 'utf8')).repository;

/** Every `match` under a rule of the grammar. */
function matches(rule: any): string[] {
  return [rule.match, ...(rule.patterns ?? []).flatMap(matches)].filter((match) => match !== undefined);
}

/** The words that the first group of a pattern chooses from. */
function words(match: string): string[] {
  return /^\(\?i\)\(\?<!\[\\w\.\]\)\((?:\?:)?([\w|]+)\)/.exec(match)?.[1]!.split('|') ?? assert.fail(match);
}

/** What follows the underscore of `(?:_(?:…))` or `_(?:…)`, with the underscore. */
function suffixes(match: string): string[] {
  return /_\(\?:([\w|]+)\)/.exec(match)?.[1]!.split('|').map((word) => `_${word}`) ?? assert.fail(match);
}

const rules = ['declaration', 'phase', 'texture', 'arithmetic'];

test('every mnemonic of the crate is a keyword of the grammar, and nothing else is', () => {
  const known = rules.flatMap((rule) => matches(repository[rule]).flatMap(words));
  assert.deepEqual(known.toSorted(), tables.mnemonics().toSorted());
});

test('no other rule of the grammar calls anything a mnemonic', () => {
  const others = Object.keys(repository).filter((name) => !rules.includes(name));
  for (const name of others) {
    assert.doesNotMatch(JSON.stringify(repository[name]), /keyword\.mnemonic/, name);
  }
});

for (const mnemonic of tables.mnemonics()) {
  test(`${mnemonic} is a whole word, in any case of letters`, async () => {
    for (const written of [mnemonic, mnemonic.toUpperCase()]) {
      const [[text, scope] = []] = await tokenizeLine(`${written} r0`);
      assert.equal(text, written);
      assert.match(scope!, /^keyword\.mnemonic\./);
    }
    for (const other of [`${mnemonic}q`, `q${mnemonic}`, `_${mnemonic}`]) {
      const scopes = (await tokenizeLine(other)).map(([, scope]) => scope);
      assert.ok(!scopes.some((scope) => scope.startsWith('keyword')), other);
    }
  });
}

test('instructions of later shader models are no keywords', async () => {
  for (const word of ['abs', 'pow', 'crs', 'nrm', 'mova', 'sincos', 'texldp', 'texldd', 'call', 'if', 'rep', 'ret', 'defi', 'dsx']) {
    assert.deepEqual(await tokenizeLine(word), [[word, '']], word);
  }
});

test('result modifiers are those of the crate', () => {
  for (const rule of ['texture', 'arithmetic']) {
    assert.deepEqual(suffixes(repository[rule].match).toSorted(), tables.resultSuffixes().toSorted(), rule);
  }
});

test('source modifiers are those of the crate', () => {
  assert.deepEqual(suffixes(repository['source-modifier'].match).toSorted(), tables.sourceSuffixes().toSorted());
});

test('usages are those of the crate, in the grammar and in the snippet', () => {
  const inGrammar = /\(_\)\(([\w|]+)\)/.exec(JSON.stringify(repository.declaration))?.[1]!.split('|') ?? [];
  assert.deepEqual(inGrammar.toSorted(), tables.usages().toSorted());
  const inSnippet = /\|([\w,]+)\|/.exec(readJson('language/snippets.json')['Input declaration'].body)?.[1]!.split(',') ?? [];
  assert.deepEqual(inSnippet.toSorted(), tables.usages().toSorted());
});

test('as many registers are known as the version with the most has', async () => {
  const counts = tables.registerCounts();
  // Constants have no end that all devices share.
  for (const prefix of ['r', 'v', 'a', 't', 'oD', 'oT']) {
    const count = counts.get(prefix)!;
    const [[last, lastScope] = [], ...rest] = await tokenizeLine(`${prefix}${count - 1}`);
    assert.equal(last, `${prefix}${count - 1}`);
    assert.match(lastScope!, /\.register$/, last);
    assert.deepEqual(rest, []);
    assert.deepEqual(await tokenizeLine(`${prefix}${count}`), [[`${prefix}${count}`, '']]);
  }
  for (const name of [...tables.rasterizerOutputs(), `c${counts.get('c')! - 1}`]) {
    const [[text, scope] = []] = await tokenizeLine(name);
    assert.equal(text, name);
    assert.match(scope!, /\.register$/, name);
  }
});

test('versions are those of the crate, in both spellings, for the grammar and for files of other names', async () => {
  const firstLine = new RegExp(readJson('package.json').contributes.languages[0].firstLine);
  for (const kind of ['vs', 'ps']) {
    for (let minor = 0; minor <= 9; minor++) {
      const exists = tables.versions().includes(`${kind}.1.${minor}`);
      for (const written of [`${kind}.1.${minor}`, `${kind}_1_${minor}`]) {
        const [[, scope] = []] = await tokenizeLine(written);
        assert.equal(scope, exists ? 'storage.type.version' : 'invalid.illegal.version', written);
        assert.equal(firstLine.test(`${written} ; comment`), exists, written);
      }
    }
  }
});

test('dialects are those of the crate', () => {
  const { configuration, debuggers, taskDefinitions } = readJson('package.json').contributes;
  const lists = [
    configuration.properties['texcrd.dialect'].enum,
    debuggers[0].configurationAttributes.launch.properties.dialect.enum,
    taskDefinitions[0].properties.dialect.enum,
  ];
  for (const list of lists) {
    assert.deepEqual(list, tables.dialects());
  }
});

test('hardware models are those of the crate', () => {
  const { debuggers } = readJson('package.json').contributes;
  const { model } = debuggers[0].configurationAttributes.launch.properties;
  assert.deepEqual(model.enum, tables.models());
  assert.equal(model.default, tables.models()[0]);
});
