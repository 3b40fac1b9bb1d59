/** Launch configurations as values. Nothing here knows the editor. */

import * as path from 'node:path';

/** What `texcrd dap` is launched with; the manifest documents each attribute. */
export interface Launch {
  type: string;
  request: string;
  name: string;
  program?: unknown;
  pixel?: unknown;
  vertex?: unknown;
  dialect?: unknown;
  stopOnEntry?: unknown;
  cwd?: unknown;
  [other: string]: unknown;
}

/** The configuration for a file that is open, for those who have no launch.json. */
export function launchOf(file: string): Launch {
  return { type: 'texcrd', request: 'launch', name: `Debug ${path.basename(file)}`, program: file };
}

/** Whether a file is a scene; everything else is taken for a listing. */
export function isScene(program: string): boolean {
  return path.extname(program).toLowerCase() === '.toml';
}

/** A pixel as a person writes it: `665, 136`, `665 136` or `665x136`. `undefined` if that is none. */
export function readPixel(text: string): [number, number] | undefined {
  const match = /^\s*(\d{1,6})\s*[,x ]\s*(\d{1,6})\s*$/.exec(text);
  return match ? [Number(match[1]), Number(match[2])] : undefined;
}

/** A configuration that is whole, or what is wrong with it, or that a pixel has to be asked for first. */
export type Checked = { launch: Launch } | { problem: string } | { askPixelOf: string; launch: Launch };

/** Looks over a configuration whose variables have been put in: fills defaults in and finds what would fail. */
export function check(given: Launch, defaults: { cwd: string | undefined; dialect: string | undefined }): Checked {
  const { program } = given;
  if (typeof program !== 'string' || program.trim() === '') {
    return { problem: 'The launch configuration has no "program": it names a listing or a scene.' };
  }
  const launch: Launch = { ...given, stopOnEntry: given.stopOnEntry ?? true };
  launch.cwd ??= defaults.cwd ?? path.dirname(program);
  if (defaults.dialect !== undefined) {
    launch.dialect ??= defaults.dialect;
  }
  if (typeof given.pixel === 'string') {
    const pixel = readPixel(given.pixel);
    if (!pixel) {
      return { problem: `"${given.pixel}" is no pixel: write its column and row, such as 320, 240.` };
    }
    launch.pixel = pixel;
  }
  const whole = launch.pixel !== undefined || launch.vertex !== undefined;
  return isScene(program) && !whole ? { askPixelOf: program, launch } : { launch };
}
