// Puts the library of the language client, with what it needs, into the one file that asks for it, and their licences behind that of
// the project: the package carries no node_modules.

import { appendFileSync, readFileSync, readdirSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';

const here = (path) => new URL(`../${path}`, import.meta.url);

const { metafile } = await build({
  absWorkingDir: fileURLToPath(new URL('..', import.meta.url)),
  entryPoints: ['dist/client.js'],
  outfile: 'dist/client.js',
  allowOverwrite: true,
  bundle: true,
  minify: true,
  platform: 'node',
  target: 'node20',
  format: 'cjs',
  external: ['vscode'],
  metafile: true,
  logLevel: 'warning',
});

const packages = new Set(Object.keys(metafile.inputs).map((file) => /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1]));
const rule = `\n${'='.repeat(78)}\n\n`;
for (const folder of [...packages].filter((folder) => folder !== undefined).sort()) {
  const { name, version } = JSON.parse(readFileSync(here(`${folder}/package.json`), 'utf8'));
  const file = readdirSync(here(folder)).find((each) => /^licen[cs]e/i.test(each));
  if (file === undefined) {
    throw new Error(`${name} has no licence to carry`);
  }
  appendFileSync(here('LICENSE'), `${rule}dist/client.js contains ${name} ${version}:\n\n${readFileSync(here(`${folder}/${file}`), 'utf8')}`);
}
