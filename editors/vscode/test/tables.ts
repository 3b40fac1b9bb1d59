/** The tables of the Rust crate that the grammar repeats, read from its source. */

import * as fs from 'node:fs';
import * as path from 'node:path';
import { REPOSITORY } from './surroundings';

function read(file: string): string {
  return fs.readFileSync(path.join(REPOSITORY, 'src', file), 'utf8');
}

function all(text: string, pattern: RegExp): string[][] {
  return [...text.matchAll(pattern)].map((match) => match.slice(1).map((group) => group ?? ''));
}

function firstGroups(text: string, pattern: RegExp): string[] {
  return all(text, pattern).map(([first]) => first!);
}

/** Checks that a pattern found as many rows as the array says it has: a row that is written otherwise must not get lost. */
function rows<T>(found: T[], text: string, array: RegExp): T[] {
  const length = Number(array.exec(text)?.[1]);
  if (found.length !== length) {
    throw new Error(`${found.length} of ${length} rows of ${array.source} were found`);
  }
  return found;
}

/** Every mnemonic, in lower case. */
export function mnemonics(): string[] {
  return ['arithmetic', 'vertex', 'texture'].flatMap((group) => {
    const text = read(`isa/opcode/${group}.rs`);
    return rows(firstGroups(text, /\bop\(\w+, \("(\w+)", 0x/g), text, /ROWS: \[OpcodeRow; (\d+)\]/);
  });
}

/** What a mnemonic may end with: `_x2` … `_sat`. */
export function resultSuffixes(): string[] {
  const text = read('isa/modifier.rs');
  const shifts = rows(firstGroups(text, /\bshift\(-?\d, "(_\w+)"/g), text, /SHIFTS: \[ResultSuffix; (\d+)\]/);
  const saturation = firstGroups(text, /SATURATION: ResultSuffix = ResultSuffix \{\s*shift: 0,\s*suffix: "(_\w+)"/g);
  if (saturation.length !== 1) {
    throw new Error('the saturation was not found');
  }
  return [...shifts, ...saturation];
}

/** What a source may end with, in every spelling. */
export function sourceSuffixes(): string[] {
  const text = read('isa/modifier.rs');
  const found = all(text, /\brow\(\w+, \d+, \("[^"]*", "(\w*)", "(\w*)"\)/g);
  return [...new Set(rows(found, text, /SOURCE_MODIFIERS: \[SourceModifierRow; (\d+)\]/).flat())].filter(Boolean);
}

/** What may stand behind `dcl_`. */
export function usages(): string[] {
  const text = read('program.rs');
  return rows(firstGroups(text, /\(Usage::\w+, "(\w+)"\)/g), text, /USAGES: \[\(Usage, &str\); (\d+)\]/);
}

/** The most registers that any version has of each file, by prefix. */
export function registerCounts(): Map<string, number> {
  const text = read('isa/register.rs');
  const found = all(text, /\brow\(\w+, \("[^"]*", "(\w+)", \d+\), \[([\d, ]+)\]/g);
  const files = rows(found, text, /FILES: \[FileRow; (\d+)\]/);
  return new Map(files.map(([prefix, counts]) => [prefix!, Math.max(...counts!.split(',').map(Number))]));
}

/** `oPos`, `oFog`, `oPts`. */
export function rasterizerOutputs(): string[] {
  const text = read('isa/register.rs');
  return rows(firstGroups(text, /\bRastOutRow \{ name: "(\w+)"/g), text, /RAST_OUT: \[RastOutRow; (\d+)\]/);
}

/** Every version as its first line has it, with dots. */
export function versions(): string[] {
  const text = read('isa/version.rs');
  return rows(firstGroups(text, /\brow\(Version::\w+, "([\w.]+)"/g), text, /VERSIONS: \[VersionRow; (\d+)\]/);
}

/** Every value of a choice of a file in `policy` by its name on the command line, in the order of the declaration. */
function choices(file: string, type: string): string[] {
  const block = new RegExp(`\\n    ${type} "[^"]*";\\n([^}]*)\\n}`).exec(read(file))?.[1] ?? '';
  return rows(firstGroups(block, /^ {4}\w+ "(\w+)" "/gm), `[${block.split('\n').length}]`, /\[(\d+)\]/);
}

/** Every dialect. */
export function dialects(): string[] {
  return choices('policy/mod.rs', 'Dialect');
}

/** Every hardware model. */
export function models(): string[] {
  return choices('policy/model.rs', 'Model');
}
