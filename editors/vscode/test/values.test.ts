/** What knows nothing of the editor: launch configurations, operands under the mouse, the way to the program. */

import assert from 'node:assert/strict';
import * as fs from 'node:fs';
import * as os from 'node:os';
import * as path from 'node:path';
import { test } from 'node:test';
import { check, isScene, launchOf, readPixel } from '../src/launch';
import { operandAt } from '../src/operand';
import { findProgram, notFound } from '../src/program';

const nothing = { cwd: undefined, dialect: undefined };

test('a pixel as people write it', () => {
  for (const text of ['665,136', ' 665 , 136 ', '665 136', '665x136']) {
    assert.deepEqual(readPixel(text), [665, 136], text);
  }
  for (const text of ['', '665', '665,', '-1,2', '1.5,2', '1,2,3', 'a,b', '66513699 1']) {
    assert.equal(readPixel(text), undefined, text);
  }
});

test('a scene is a .toml, whatever its case', () => {
  assert.ok(isScene('/a/scene.toml') && isScene('B.TOML'));
  assert.ok(!isScene('/a.toml/shader.psh'));
});

test('a listing needs nothing but its name', () => {
  assert.deepEqual(check(launchOf('/a/b.psh'), nothing), {
    launch: { type: 'texcrd', request: 'launch', name: 'Debug b.psh', program: '/a/b.psh', stopOnEntry: true, cwd: '/a' },
  });
});

test('what is given is kept', () => {
  const given = { ...launchOf('/a/b.psh'), stopOnEntry: false, cwd: '/c', dialect: 'lenient', set: { c0: [1] }, vertex: 0 };
  assert.deepEqual(check(given, { cwd: '/d', dialect: 'd3d9' }), { launch: given });
});

test('folder and dialect are filled in', () => {
  const checked = check(launchOf('b.psh'), { cwd: '/d', dialect: 'd3d9' });
  assert.ok('launch' in checked);
  assert.equal(checked.launch.cwd, '/d');
  assert.equal(checked.launch.dialect, 'd3d9');
});

test('of a scene a pixel is asked for unless a pixel or a vertex is given', () => {
  const scene = launchOf('/a/scene.toml');
  assert.ok('askPixelOf' in check(scene, nothing));
  assert.ok(!('askPixelOf' in check({ ...scene, pixel: [0, 0] }, nothing)));
  // The first vertex is one, too.
  assert.ok(!('askPixelOf' in check({ ...scene, vertex: 0 }, nothing)));
});

test('a pixel that a variable put in becomes numbers', () => {
  const checked = check({ ...launchOf('/a/scene.toml'), pixel: '3, 4' }, nothing);
  assert.ok('launch' in checked);
  assert.deepEqual(checked.launch.pixel, [3, 4]);
});

test('what would fail is said', () => {
  const problem = (extra: object) => {
    const checked = check({ ...launchOf('/a/scene.toml'), ...extra }, nothing);
    return 'problem' in checked ? checked.problem : '';
  };
  assert.match(problem({ program: undefined }), /"program"/);
  assert.match(problem({ program: '  ' }), /"program"/);
  assert.match(problem({ program: 7 }), /"program"/);
  assert.match(problem({ pixel: 'there' }), /"there"/);
});

test('the operand under the mouse', () => {
  const at = (line: string, marked: string, within = 0) => operandAt(line, line.indexOf(marked) + within);
  const line = '+mad_sat r0.rgb, r3, -r4_x2.r, 1-c[a0.x + 3].yz ; and r5.a';
  assert.deepEqual(at(line, 'r0'), { start: 9, end: 15, expression: 'r0.rgb' });
  assert.equal(at(line, 'rgb')?.expression, 'r0.rgb');
  assert.equal(at(line, 'r3')?.expression, 'r3');
  // The register is shown, not what a modifier makes of it.
  assert.equal(at(line, '_x2')?.expression, 'r4.r');
  for (const part of ['c[', 'a0', '3]', 'yz']) {
    assert.equal(at(line, part)?.expression, 'c[a0.x + 3].yz', part);
  }
  for (const part of ['mad', 'sat', '1-', ', r3', '; and', 'r5.a']) {
    assert.equal(at(line, part), undefined, part);
  }
  assert.equal(at('MOV OT7.XY, V15 // v1', 'OT7')?.expression, 'OT7.XY');
  assert.equal(at('MOV OT7.XY, V15 // v1', 'v1'), undefined);
  assert.equal(operandAt('', 0), undefined);
});

/** A folder with a program `texcrd` and a file that is none, gone when the test is over. */
function withPrograms(check: (folder: string) => void): void {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'texcrd-'));
  try {
    fs.mkdirSync(path.join(folder, 'bin', 'texcrd'), { recursive: true });
    fs.mkdirSync(path.join(folder, 'tools'));
    fs.writeFileSync(path.join(folder, 'tools', 'texcrd'), '', { mode: 0o755 });
    fs.writeFileSync(path.join(folder, 'tools', 'texcrd.EXE'), '', { mode: 0o755 });
    fs.writeFileSync(path.join(folder, 'tools', 'notes'), '', { mode: 0o644 });
    check(folder);
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
}

test('the program by name and by path', { skip: process.platform === 'win32' && 'made for paths with slashes' }, () => {
  withPrograms((folder) => {
    const tool = path.join(folder, 'tools', 'texcrd');
    const environment = { PATH: `${folder}/nowhere::${folder}/bin:${folder}/tools`, HOME: folder };
    const find = (setting: string, more = {}) => findProgram(setting, { folder, environment, platform: 'linux', ...more });
    // A folder of that name is no program; nor is what cannot be started.
    assert.equal(find('texcrd'), tool);
    assert.equal(find(' texcrd '), tool);
    assert.equal(find('notes'), undefined);
    assert.equal(find('texcrd', { environment: {} }), undefined);
    assert.equal(find(''), undefined);
    assert.equal(find(tool), tool);
    assert.equal(find('tools/texcrd'), tool);
    assert.equal(find('./tools/texcrd'), tool);
    assert.equal(find('~/tools/texcrd'), tool);
    assert.equal(find('${workspaceFolder}/tools/texcrd'), tool);
    assert.equal(find('${workspaceFolder}/tools/texcrd', { folder: undefined }), undefined);
    assert.equal(find('bin/texcrd'), undefined);
  });
});

test('the endings that Windows adds', { skip: process.platform === 'win32' && 'made for paths with slashes' }, () => {
  withPrograms((folder) => {
    fs.rmSync(path.join(folder, 'tools', 'texcrd'));
    const surroundings = { folder, environment: { PATH: `${folder}/tools;${folder}`, PATHEXT: '.COM;.EXE' }, platform: 'win32' as const };
    assert.equal(findProgram('texcrd', surroundings), path.join(folder, 'tools', 'texcrd.EXE'));
    assert.equal(findProgram('texcrd', { ...surroundings, platform: 'linux' }), undefined);
  });
});

test('a person whose program is missing is told the setting', () => {
  assert.match(notFound('texcrd'), /"texcrd\.path"/);
});
