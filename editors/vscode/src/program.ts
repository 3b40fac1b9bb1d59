/** The program `texcrd`: where it is, and what to say when it is nowhere. */

import * as fs from 'node:fs';
import * as path from 'node:path';

/** What finding a program depends on besides the setting. */
export interface Surroundings {
  /** The workspace folder that relative paths and `${workspaceFolder}` mean. */
  folder: string | undefined;
  /** `PATH`, `PATHEXT`, `HOME` and so on. */
  environment: NodeJS.ProcessEnv;
  /** As `process.platform` says it. */
  platform: NodeJS.Platform;
}

/** The setting `texcrd.path` as a path: a bare name is looked for on `PATH`. `undefined` if no such program can be started. */
export function findProgram(setting: string, { folder, environment, platform }: Surroundings): string | undefined {
  const home = environment['HOME'] ?? environment['USERPROFILE'];
  let wanted = setting.trim();
  if (wanted.includes('${workspaceFolder}')) {
    if (folder === undefined) {
      return undefined;
    }
    wanted = wanted.replaceAll('${workspaceFolder}', () => folder);
  }
  if (home !== undefined) {
    wanted = wanted.replace(/^~(?=[\\/]|$)/, () => home);
  }
  if (wanted === '') {
    return undefined;
  }
  const endings = platform === 'win32' ? ['', ...(environment['PATHEXT'] ?? '.EXE').split(';')] : [''];
  const isBare = !/[\\/]/.test(wanted);
  const folders = isBare ? (environment['PATH'] ?? '').split(platform === 'win32' ? ';' : ':') : [folder ?? '.'];
  return folders
    .filter((candidate) => candidate !== '')
    .flatMap((candidate) => endings.map((ending) => path.resolve(candidate, wanted + ending)))
    .find((candidate) => canBeStarted(candidate));
}

function canBeStarted(file: string): boolean {
  try {
    fs.accessSync(file, fs.constants.X_OK);
    return fs.statSync(file).isFile();
  } catch {
    return false;
  }
}

/** What a person is told whose `texcrd` cannot be found. */
export function notFound(setting: string): string {
  return (
    `The program "${setting}" was not found. Install it with "cargo install --path ." in the folder of texcrd, ` +
    'or say in the setting "texcrd.path" where it is.'
  );
}
