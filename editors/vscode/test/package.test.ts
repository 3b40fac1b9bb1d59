/** The package as people install it, opened. */

import assert from 'node:assert/strict';
import * as fs from 'node:fs';
import * as path from 'node:path';
import { isBuiltin } from 'node:module';
import { test } from 'node:test';
import * as yauzl from 'yauzl';
import { ROOT, readJson } from './surroundings';

/** All files of a zip archive by name. */
function unzip(file: string): Promise<Map<string, Buffer>> {
  return new Promise((resolve, reject) => {
    const files = new Map<string, Buffer>();
    yauzl.open(file, { lazyEntries: true }, (error, archive) => {
      if (error) {
        return reject(error);
      }
      archive.on('error', reject);
      archive.on('end', () => resolve(files));
      archive.on('entry', (entry: yauzl.Entry) => {
        archive.openReadStream(entry, async (failed, stream) => {
          if (failed) {
            return reject(failed);
          }
          const chunks: Buffer[] = [];
          for await (const chunk of stream) {
            chunks.push(chunk as Buffer);
          }
          files.set(entry.fileName, Buffer.concat(chunks));
          archive.readEntry();
        });
      });
      archive.readEntry();
    });
  });
}

test('the package holds what runs, and nothing else', async () => {
  // `npm test` has just written it.
  const files = await unzip(path.join(ROOT, 'texcrd.vsix'));

  const modules = fs.readdirSync(path.join(ROOT, 'src')).map((name) => `extension/dist/${path.parse(name).name}.js`);
  const expected = [
    '[Content_Types].xml',
    'extension.vsixmanifest',
    'extension/LICENSE.txt',
    'extension/dist/icon.png',
    ...modules,
    'extension/language/configuration.json',
    'extension/language/d3d8asm.tmLanguage.json',
    'extension/language/snippets.json',
    'extension/package.json',
    'extension/readme.md',
  ];
  assert.deepEqual([...files.keys()].toSorted(), expected.toSorted());

  for (const module of modules) {
    const compiled = path.join(ROOT, path.relative('extension', module));
    assert.deepEqual(files.get(module), fs.readFileSync(compiled), module);
  }
  const manifest = JSON.parse(files.get('extension/package.json')!.toString());
  assert.deepEqual(manifest.contributes, readJson('package.json').contributes);
  const license = files.get('extension/LICENSE.txt')!.toString();
  assert.match(license, /MIT License/);
  assert.match(license, /Apache License/);
  // What others wrote is in one file, with their licences.
  for (const name of ['vscode-languageclient', 'vscode-jsonrpc', 'semver']) {
    assert.match(license, new RegExp(`dist/client\\.js contains ${name} \\d`));
  }
  const client = files.get('extension/dist/client.js')!.toString();
  const loaded = new Set([...client.matchAll(/\brequire\("([^"]+)"\)/g)].map(([, name]) => name!));
  const others = [...loaded].filter((name) => name !== 'vscode' && !isBuiltin(name));
  assert.deepEqual(others, []);

  const icon = files.get('extension/dist/icon.png')!;
  assert.equal(icon.subarray(1, 4).toString(), 'PNG');
  // The width and the height: the marketplace asks for at least 128.
  assert.deepEqual([icon.readUInt32BE(16), icon.readUInt32BE(20)], [256, 256]);
});
