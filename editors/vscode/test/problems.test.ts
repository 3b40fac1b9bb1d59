/** The problem matcher over what `texcrd check` prints: over a text that was kept, and over what the program prints now. */

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import * as fs from 'node:fs';
import * as path from 'node:path';
import { test } from 'node:test';
import { FIXTURES, TEXCRD, aloud, readJson, withoutProgram } from './surroundings';

interface Problem {
  severity: string;
  code: string;
  message: string;
  file: string;
  line: number;
  column: number;
}

/** Reads problems as the editor does: each pattern has to match the line after that of the one before. */
function problems(output: string): Problem[] {
  const { problemMatchers, problemPatterns } = readJson('package.json').contributes;
  const [matcher] = problemMatchers;
  const { patterns } = problemPatterns.find(({ name }: { name: string }) => `$${name}` === matcher.pattern);
  const lines = output.split(/\r?\n/);
  const found: Problem[] = [];
  for (let at = 0; at + patterns.length <= lines.length; at++) {
    const values: Record<string, string> = {};
    const whole = patterns.every(({ regexp, ...groups }: { regexp: string; [group: string]: any }, i: number) => {
      const match = new RegExp(regexp).exec(lines[at + i]!);
      for (const [name, group] of Object.entries(groups)) {
        values[name] = match?.[group] ?? '';
      }
      return match !== null;
    });
    if (whole) {
      const { severity, code, message, file, line, column } = values;
      found.push({ severity, code, message, file, line: Number(line), column: Number(column) } as Problem);
    }
  }
  return found;
}

/** What is wrong with broken.psh, found by reading it: severity, rule, line, column. */
const BROKEN = [
  // `rl` is no register.
  ['error', 'P13', 2, 8],
  // `1rp` is no instruction.
  ['error', 'P8', 3, 1],
  // r4, the last source, was never written.
  ['error', 'I1', 3, 24],
  // texld stands behind arithmetic.
  ['error', 'S4', 4, 1],
  // ps.1.4 has r0 to r5.
  ['error', 'O1', 5, 20],
];

function summary(found: Problem[]): unknown[] {
  return found.map(({ severity, code, line, column }) => [severity, code, line, column]);
}

test('problems of an output that was kept', () => {
  const found = problems(fs.readFileSync(path.join(FIXTURES, 'check.txt'), 'utf8'));
  assert.deepEqual(summary(found), [...BROKEN, ['warning', 'O19', 2, 6]]);
  assert.equal(found[1]!.message, '`1rp` is no instruction');
  assert.equal(found[1]!.file, 'broken.psh');
  assert.equal(found.at(-1)!.file, 'a folder/with blanks.vsh');
});

test('problems of an output with Windows paths and line ends', () => {
  const found = problems('warning[O19]: a word: and another\r\n  --> C:\\shaders\\a b.vsh:12:3\r\n');
  assert.deepEqual(found, [
    { severity: 'warning', code: 'O19', message: 'a word: and another', file: 'C:\\shaders\\a b.vsh', line: 12, column: 3 },
  ]);
});

test('problems of what the program prints', { skip: aloud(withoutProgram(), 'the live output of texcrd check') }, () => {
  // Relative and whole paths, as tasks give them.
  for (const file of ['broken.psh', path.join(FIXTURES, 'broken.psh')]) {
    const { stdout, stderr, status } = spawnSync(TEXCRD!, ['check', file], { cwd: FIXTURES, encoding: 'utf8' });
    assert.equal(status, 1, stderr);
    const found = problems(stdout + stderr);
    assert.deepEqual(summary(found), BROKEN);
    assert.ok(found.every((problem) => problem.file === file));
  }
});
