/** `texcrd lsp`, driven by the client library that its protocol's makers wrote, and held to their declarations. */

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import * as fs from 'node:fs';
import * as path from 'node:path';
import { after, test } from 'node:test';
import * as lsp from 'vscode-languageserver-protocol/node';
import { Conversation, applied, range } from './conversation';
import { ROOT, aloud, withoutServer } from './surroundings';

const options = { skip: aloud(withoutServer(), 'the language server'), timeout: 120_000 };

/** What the server said, with the declared type of it. */
const said: [type: string, value: unknown][] = [];

function keep<T>(type: string, value: T): T {
  said.push([type, value]);
  return value;
}

/** Line 2 has the pair's colour, line 4 reads all of r0. */
const LISTING = 'ps.1.1\ndef c0, 1, 0.5, 0, 1\nmov r0.rgb, v0\n+mov r0.a, v1\nmul_sat r1, r0, c0\nadd r0,r1,r0\n';

test('the server says hello and goodbye', options, async () => {
  const status = await Conversation.with(async ({ greeting }) => {
    keep('InitializeResult', greeting);
    assert.equal(greeting.serverInfo?.name, 'texcrd');
    assert.equal(greeting.capabilities.positionEncoding, 'utf-16');
  });
  assert.equal(status, 0);
});

test('diagnostics of a file with faults, and repairs', options, async () => {
  await Conversation.with(async (conversation) => {
    const { connection } = conversation;
    const uri = await conversation.open('broken.psh');
    const found = await conversation.diagnostics(uri);
    // The same faults that problems.test.ts expects of `texcrd check`, lines and columns from 0.
    const shown = found.map(({ code, severity, range: { start } }) => [code, severity, start.line, start.character]);
    assert.deepEqual(shown, [
      ['P13', 1, 1, 7],
      ['P8', 1, 2, 0],
      ['I1', 1, 2, 23],
      ['S4', 1, 3, 0],
      ['O1', 1, 4, 19],
    ]);
    const actions = await connection.sendRequest(lsp.CodeActionRequest.type, {
      textDocument: { uri },
      range: found[1]!.range,
      context: { diagnostics: [found[1]!], only: ['quickfix'] },
    });
    keep('CodeAction[]', actions);
    const action = actions!.find((each): each is lsp.CodeAction => 'isPreferred' in each && each.isPreferred === true);
    assert.equal(action?.title, 'Replace `1rp` by `lrp`');
    const [change] = action!.edit!.documentChanges as lsp.TextDocumentEdit[];
    const text = fs.readFileSync(path.join(ROOT, 'test', 'fixtures', 'broken.psh'), 'utf8');
    const repaired = applied(text, change!.edits as lsp.TextEdit[]);
    assert.match(repaired.split('\n')[2]!, /^lrp /);
    await connection.sendNotification(lsp.DidChangeTextDocumentNotification.type, {
      textDocument: { uri, version: 2 },
      contentChanges: [{ text: repaired }],
    });
    const codes = (await conversation.diagnostics(uri, 2)).map(({ code }) => code);
    assert.ok(!codes.includes('P8'), codes.join());
    for (const told of conversation.published) {
      keep('PublishDiagnosticsParams', told);
    }
  });
});

test('what is asked for about a listing', options, async () => {
  await Conversation.with(async (conversation) => {
    const { connection } = conversation;
    const uri = await conversation.open('made.psh', LISTING);
    assert.deepEqual(await conversation.diagnostics(uri), []);
    const at = (line: number, character: number) => ({ textDocument: { uri }, position: { line, character } });
    const whole = { textDocument: { uri } };

    const hover = keep('Hover', (await connection.sendRequest(lsp.HoverRequest.type, at(4, 1)))!);
    assert.match((hover.contents as lsp.MarkupContent).value, /s0 \\\* s1/);
    const constant = (await connection.sendRequest(lsp.HoverRequest.type, at(4, 17)))!;
    assert.match((constant.contents as lsp.MarkupContent).value, /def c0, 1, 0\.5, 0, 1/);

    const list = keep('CompletionList', (await connection.sendRequest(lsp.CompletionRequest.type, at(4, 4))) as lsp.CompletionList);
    assert.deepEqual(list.items.map(({ label }) => label), ['_x2', '_x4', '_d2', '_sat']);
    keep('CompletionItem', await connection.sendRequest(lsp.CompletionResolveRequest.type, list.items[0]!));

    const definition = keep('Location[]', (await connection.sendRequest(lsp.DefinitionRequest.type, at(4, 12))) as lsp.Location[]);
    assert.deepEqual(definition.map((each) => range(each.range)), ['3:5-3:9', '2:4-2:10']);
    const highlights = keep('DocumentHighlight[]', (await connection.sendRequest(lsp.DocumentHighlightRequest.type, at(4, 12)))!);
    assert.deepEqual(
      highlights.map((each) => [each.kind, range(each.range)]),
      [[3, '2:4-2:10'], [3, '3:5-3:9'], [2, '4:12-4:14'], [3, '5:4-5:6'], [2, '5:10-5:12']],
    );
    const references = await connection.sendRequest(lsp.ReferencesRequest.type, { ...at(4, 17), context: { includeDeclaration: false } });
    assert.deepEqual(references!.map((each) => range(each.range)), ['4:16-4:18']);

    const signature = keep('SignatureHelp', (await connection.sendRequest(lsp.SignatureHelpRequest.type, at(4, 13)))!);
    assert.equal(signature.activeParameter, 1);
    const symbols = keep('DocumentSymbol[]', (await connection.sendRequest(lsp.DocumentSymbolRequest.type, whole)) as lsp.DocumentSymbol[]);
    assert.deepEqual(symbols.map(({ name, children }) => [name, children?.map((child) => child.name)]), [['ps.1.1', ['c0']]]);
    keep('FoldingRange[]', await connection.sendRequest(lsp.FoldingRangeRequest.type, whole));

    const edits = keep('TextEdit[]', (await connection.sendRequest(lsp.DocumentFormattingRequest.type, { ...whole, options: { tabSize: 4, insertSpaces: true } }))!);
    assert.equal(applied(LISTING, edits), LISTING.replace('add r0,r1,r0', 'add r0, r1, r0'));
  });
});

test('inlay hints, as the settings want them', options, async () => {
  const text = 'vs.1.1\nm4x4 oPos, v0, c0\nexp r0, c4.w\nmov oD0, r0\n';
  const expected = {
    // m4x4 takes four slots, exp ten.
    totals: ['0:6 15/128 slots', '1:17 4 slots', '2:12 10 slots'],
    running: ['0:6 15/128 slots', '1:17 4 slots, 4/128', '2:12 10 slots, 14/128', '3:11 15/128'],
    off: [],
  };
  for (const [inlayHints, hints] of Object.entries(expected)) {
    await Conversation.with(async (conversation) => {
      const uri = await conversation.open('made.vsh', text);
      const all = { start: { line: 0, character: 0 }, end: { line: 4, character: 0 } };
      const found = keep('InlayHint[]', (await conversation.connection.sendRequest(lsp.InlayHintRequest.type, { textDocument: { uri }, range: all }))!);
      assert.deepEqual(found.map(({ position, label }) => `${position.line}:${position.character} ${String(label)}`), hints);
    }, { inlayHints });
  }
});

test('the editor is asked for its settings', options, async () => {
  await Conversation.with(async (conversation) => {
    conversation.configuration = { defines: ['FOG'], dialect: 'd3d8', path: 'texcrd' };
    await conversation.connection.sendNotification(lsp.DidChangeConfigurationNotification.type, { settings: null });
    // The answer has come before this is.
    await assert.rejects(conversation.connection.sendRequest('texcrd/nothing'), { code: lsp.ErrorCodes.MethodNotFound });
    const uri = await conversation.open('fog.psh', 'ps.1.1\n#ifdef FOG\nmov r0, v0\n#endif\n');
    await conversation.connection.sendRequest(lsp.FoldingRangeRequest.type, { textDocument: { uri } });
    assert.deepEqual(await conversation.diagnostics(uri), []);
  });
});

after(() => {
  if (said.length === 0) {
    return;
  }
  const lines = said.map(([type, value], i) => `export const said${i}: lsp.${type} = ${JSON.stringify(value, null, 1)};`);
  const folder = path.join(ROOT, 'out', 'said');
  fs.mkdirSync(folder, { recursive: true });
  const compilerOptions = { noEmit: true, rootDir: '.', types: ['node'] };
  fs.writeFileSync(path.join(folder, 'tsconfig.json'), JSON.stringify({ extends: '../../tsconfig.json', compilerOptions, include: ['said.ts'] }));
  fs.writeFileSync(path.join(folder, 'said.ts'), ["import type * as lsp from 'vscode-languageserver-protocol/node';", ...lines, ''].join('\n'));
  const compiler = path.join(ROOT, 'node_modules', '.bin', 'tsc');
  const { status, stdout, stderr } = spawnSync(compiler, ['-p', folder], { cwd: ROOT, encoding: 'utf8', shell: process.platform === 'win32' });
  assert.equal(status, 0, `${stdout}${stderr}`);
});
