// Clears away what was compiled before, and writes what the package holds besides the code: the icon, and the licences of the
// project in one file.

import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { icon } from './icon.mjs';

const here = (path) => new URL(`../${path}`, import.meta.url);

for (const folder of ['dist', 'out']) {
  rmSync(here(folder), { recursive: true, force: true });
}
mkdirSync(here('dist'));
writeFileSync(here('dist/icon.png'), icon());

const licences = ['LICENSE-MIT', 'LICENSE-APACHE'].map((name) => readFileSync(here(`../../${name}`), 'utf8'));
const rule = `\n${'='.repeat(78)}\n\n`;
writeFileSync(here('LICENSE'), ['Licensed under MIT or Apache-2.0, at your choice.\n', ...licences].join(rule));
