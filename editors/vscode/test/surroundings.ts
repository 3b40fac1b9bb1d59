/** Where things are, and the program under test. */

import { spawnSync } from 'node:child_process';
import * as fs from 'node:fs';
import * as path from 'node:path';

/** The folder of the extension; the compiled tests lie two folders below it. */
export const ROOT = path.resolve(__dirname, '..', '..');
export const FIXTURES = path.join(ROOT, 'test', 'fixtures');
/** The folder of texcrd itself. */
export const REPOSITORY = path.resolve(ROOT, '..', '..');

export function readJson(file: string): any {
  return JSON.parse(fs.readFileSync(path.join(ROOT, file), 'utf8'));
}

/** The program that the variable TEXCRD names, if it is set. */
export const TEXCRD = process.env['TEXCRD'] ? path.resolve(process.env['TEXCRD']) : undefined;

/** `false`, or why a test that needs the program cannot be run. */
export function withoutProgram(): string | false {
  return TEXCRD === undefined ? 'the variable TEXCRD names no program' : false;
}

/** `false`, or why a test that needs the debug adapter cannot be run. */
export function withoutAdapter(): string | false {
  return withoutCommand('dap');
}

/** `false`, or why a test that needs the language server cannot be run. */
export function withoutServer(): string | false {
  return withoutCommand('lsp');
}

/** Anything but a program that was built without the command runs, and may fail. */
function withoutCommand(command: string): string | false {
  if (TEXCRD === undefined) {
    return withoutProgram();
  }
  const help = spawnSync(TEXCRD, [command, '--help'], { encoding: 'utf8' });
  return /unrecognized subcommand/.test(help.stderr ?? '') ? `${TEXCRD} has no command \`${command}\`` : false;
}

/** Says on standard error, too, what is left out: a skipped test is easily overlooked among those that pass. */
export function aloud(reason: string | false, what: string): string | false {
  if (reason) {
    console.error(`\n*** SKIPPED: ${what}: ${reason} ***\n`);
  }
  return reason;
}
