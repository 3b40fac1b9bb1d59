/** The grammar as the editor runs it: the same engine, the same regular expressions. */

import * as fs from 'node:fs';
import * as path from 'node:path';
import * as oniguruma from 'vscode-oniguruma';
import * as textmate from 'vscode-textmate';
import { ROOT } from './surroundings';

export const GRAMMAR = path.join(ROOT, 'language', 'd3d8asm.tmLanguage.json');

/** A piece of text with its innermost scope, without the name of the language behind it; `''` if it has none. */
export type Token = [text: string, scope: string];

async function load(): Promise<textmate.IGrammar> {
  const wasm = fs.readFileSync(require.resolve('vscode-oniguruma/release/onig.wasm'));
  await oniguruma.loadWASM(wasm.buffer.slice(wasm.byteOffset, wasm.byteOffset + wasm.byteLength));
  const registry = new textmate.Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async () => textmate.parseRawGrammar(fs.readFileSync(GRAMMAR, 'utf8'), GRAMMAR),
  });
  const grammar = await registry.loadGrammar('source.d3d8asm');
  if (!grammar) {
    throw new Error('the grammar does not load');
  }
  return grammar;
}

const grammar = load();

/** The tokens of each line; blanks between tokens are left out. */
export async function tokenize(text: string): Promise<Token[][]> {
  const { tokenizeLine } = await grammar.then((loaded) => ({ tokenizeLine: loaded.tokenizeLine.bind(loaded) }));
  let state = textmate.INITIAL;
  return text.split('\n').map((line) => {
    const { tokens, ruleStack } = tokenizeLine(line, state);
    state = ruleStack;
    return tokens
      .map(({ startIndex, endIndex, scopes }): Token => {
        const inner = scopes.filter((scope) => !scope.startsWith('source.') && !scope.startsWith('meta.')).at(-1) ?? '';
        return [line.slice(startIndex, endIndex).trim(), inner.replace(/\.d3d8asm$/, '')];
      })
      .filter(([piece]) => piece !== '');
  });
}

/** The tokens of a single line. */
export async function tokenizeLine(line: string): Promise<Token[]> {
  return (await tokenize(line))[0]!;
}
