// Compiles WGSL files with the Tint inside Dawn, the WebGPU of Chromium: `node dawn.mjs FILE…`. No GPU is needed: Dawn's
// null backend compiles and draws nothing. Exit status: 0 all are taken, 1 some are not, 2 there is no Dawn.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

let dawn;
try {
  // Beside this script, in a folder above it, or where NODE_PATH points.
  dawn = await import(pathToFileURL(createRequire(import.meta.url).resolve('webgpu')));
} catch (error) {
  console.error(`npm's package webgpu cannot be loaded: ${error.message}`);
  process.exit(2);
}
Object.assign(globalThis, dawn.globals);
// Dawn answers nothing any more once this object has been collected.
globalThis.gpu = dawn.create(['backend=null']);
const adapter = await gpu.requestAdapter();
if (!adapter) {
  console.error('Dawn has no null backend');
  process.exit(2);
}
const device = await adapter.requestDevice();
let refused = false;
for (const file of process.argv.slice(2)) {
  device.pushErrorScope('validation');
  const module = device.createShaderModule({ code: readFileSync(file, 'utf8') });
  const { messages } = await module.getCompilationInfo();
  const error = await device.popErrorScope();
  for (const message of messages) {
    console.log(`${file}:${message.lineNum}:${message.linePos}: ${message.type}: ${message.message}`);
  }
  refused ||= error !== null || messages.length > 0;
}
process.exit(refused ? 1 : 0);
