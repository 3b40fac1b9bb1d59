/** Snippets: that they are what they say, and that texcrd finds nothing wrong with the whole shaders among them. */

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { test } from 'node:test';
import { TEXCRD, aloud, readJson, withoutProgram } from './surroundings';
import { tokenize } from './tokens';

interface Snippet {
  prefix: string;
  description: string;
  body: string | string[];
}

const snippets = Object.entries<Snippet>(readJson('language/snippets.json'));

/** What a snippet writes if a person only presses Tab: the first of each choice, the default of each place. */
function written({ body }: Snippet): string {
  let text = typeof body === 'string' ? body : body.join('\n');
  const defaults = new Map([['0', '']]);
  text = text.replace(/\$\{(\d+)(?::([^}]*)|\|([^,|]*)[^}]*)\}/g, (_, place, value, first) => {
    defaults.set(place, value ?? first);
    return value ?? first;
  });
  return text.replace(/\$(\d+)/g, (_, place) => defaults.get(place) ?? assert.fail(`$${place} has no default`));
}

test('each snippet has a prefix of its own and a description', () => {
  const prefixes = snippets.map(([, snippet]) => snippet.prefix);
  assert.equal(new Set(prefixes).size, prefixes.length);
  assert.ok(snippets.every(([, snippet]) => snippet.description.length > 0));
});

for (const [name, snippet] of snippets) {
  test(`the grammar knows every word of the snippet "${name}"`, async () => {
    const plain = (await tokenize(written(snippet))).flat().filter(([, scope]) => scope === '' || scope.startsWith('invalid'));
    assert.deepEqual(plain, []);
  });
}

test('texcrd accepts the snippets', { skip: aloud(withoutProgram(), 'texcrd check over the snippets') }, () => {
  // What stands around those that are no whole shader, so that every register they read is written.
  const around: Record<string, [before: string, after: string]> = {
    def: ['ps.1.4\n', '\nmov r0, c0\n'],
    dcl: ['vs_1_1\n', '\nmov oPos, v0\n'],
    m4x4: ['vs.1.1\n', '\n'],
    normalize: ['vs.1.1\nmov r0, v3\n', '\nmov oPos, r0\n'],
    light: ['vs.1.1\nmov oPos, v0\n', '\n'],
    palette: ['vs.1.1\n', '\nmov r0.w, v0.w\nmov oPos, r0\n'],
    phase: ['ps.1.4\ntexcrd r0.rgb, t0\n', '\n'],
    pair: ['ps.1.1\ntex t0\nmov r0, t0\n', '\n'],
    texm3x3: ['ps.1.1\n', '\nmov r0, t3\n'],
  };
  for (const [name, snippet] of snippets) {
    const whole = /^[vp]s[._]/.test(snippet.prefix);
    const [before, after] = whole ? ['', ''] : (around[snippet.prefix] ?? assert.fail(`nothing stands around ${name}`));
    const dialect = snippet.prefix === 'dcl' || snippet.prefix === 'vs_1_1' ? 'd3d9' : 'd3d8';
    const { stdout, stderr, status } = spawnSync(TEXCRD!, ['check', '--dialect', dialect, '-'], {
      input: before + written(snippet) + after,
      encoding: 'utf8',
    });
    assert.equal(status, 0, `${name}:\n${stdout}${stderr}`);
    assert.doesNotMatch(stdout + stderr, /^warning/m, name);
  }
});
