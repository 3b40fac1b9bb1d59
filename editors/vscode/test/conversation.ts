/** A conversation with `texcrd lsp`, by the client library that its protocol's makers wrote. */

import { spawn, type ChildProcess } from 'node:child_process';
import { once } from 'node:events';
import * as fs from 'node:fs';
import * as path from 'node:path';
import { pathToFileURL } from 'node:url';
import * as lsp from 'vscode-languageserver-protocol/node';
import { FIXTURES, TEXCRD } from './surroundings';

/** How long the server may take to say something, in milliseconds: a debug build on a busy machine. */
const PATIENCE = 20_000;

/** What an editor can do, as far as it matters. */
const CAPABILITIES: lsp.ClientCapabilities = {
  general: { positionEncodings: ['utf-16'] },
  workspace: { workspaceEdit: { documentChanges: true }, configuration: true },
  textDocument: {
    hover: { contentFormat: ['markdown'] },
    completion: { completionItem: { snippetSupport: true } },
    codeAction: { codeActionLiteralSupport: { codeActionKind: { valueSet: ['quickfix', 'source.fixAll'] } } },
    documentSymbol: { hierarchicalDocumentSymbolSupport: true },
    publishDiagnostics: { relatedInformation: true, versionSupport: true },
  },
};

export class Conversation {
  readonly connection: lsp.ProtocolConnection;
  greeting!: lsp.InitializeResult;
  /** The answer to `workspace/configuration`. */
  configuration: object | null = null;
  private readonly process: ChildProcess;
  private readonly told: lsp.PublishDiagnosticsParams[] = [];
  private awaited: (() => void) | undefined;

  private constructor() {
    this.process = spawn(TEXCRD!, ['lsp'], { cwd: FIXTURES, stdio: ['pipe', 'pipe', 'inherit'] });
    this.connection = lsp.createProtocolConnection(
      new lsp.StreamMessageReader(this.process.stdout!),
      new lsp.StreamMessageWriter(this.process.stdin!),
    );
    this.connection.onRequest(lsp.ConfigurationRequest.type, ({ items }) => items.map(() => this.configuration));
    this.connection.onNotification(lsp.PublishDiagnosticsNotification.type, (params) => {
      this.told.push(params);
      this.awaited?.();
    });
    this.connection.listen();
  }

  /** Starts the server and says hello; `use` is what is talked about. Gives the exit status of the server. */
  static async with(use: (conversation: Conversation) => Promise<void>, options?: object): Promise<number | null> {
    const conversation = new Conversation();
    const { connection, process } = conversation;
    try {
      conversation.greeting = await connection.sendRequest(lsp.InitializeRequest.type, {
        processId: globalThis.process.pid,
        rootUri: pathToFileURL(FIXTURES).href,
        capabilities: CAPABILITIES,
        initializationOptions: options,
      });
      await connection.sendNotification(lsp.InitializedNotification.type, {});
      await use(conversation);
      await connection.sendRequest(lsp.ShutdownRequest.type);
      const exited = once(process, 'exit');
      await connection.sendNotification(lsp.ExitNotification.type);
      return (await exited)[0];
    } finally {
      connection.dispose();
      process.kill();
    }
  }

  /** Opens a file of the fixtures, or a text that is not on disk. Gives its address. */
  async open(name: string, text = fs.readFileSync(path.join(FIXTURES, name), 'utf8'), languageId = 'd3d8asm'): Promise<string> {
    const uri = pathToFileURL(path.join(FIXTURES, name)).href;
    const textDocument = { uri, languageId, version: 1, text };
    await this.connection.sendNotification(lsp.DidOpenTextDocumentNotification.type, { textDocument });
    return uri;
  }

  /** What is wrong with a document, in this version. */
  async diagnostics(uri: string, version = 1): Promise<lsp.Diagnostic[]> {
    const end = Date.now() + PATIENCE;
    for (;;) {
      const found = this.told.findLast((params) => params.uri === uri && params.version === version);
      if (found) {
        return found.diagnostics;
      }
      if (Date.now() > end) {
        throw new Error(`nothing was told of ${uri}`);
      }
      await new Promise<void>((resolve) => {
        const timer = setTimeout(resolve, 1000);
        this.awaited = () => {
          clearTimeout(timer);
          resolve();
        };
      });
    }
  }

  /** Everything that was told of what is wrong. */
  get published(): lsp.PublishDiagnosticsParams[] {
    return this.told;
  }
}

/** `line:character-line:character` */
export function range({ start, end }: lsp.Range): string {
  return `${start.line}:${start.character}-${end.line}:${end.character}`;
}

/** The text of a document with edits in it. */
export function applied(text: string, edits: lsp.TextEdit[]): string {
  const lines = text.split('\n');
  const offset = ({ line, character }: lsp.Position) => lines.slice(0, line).reduce((sum, each) => sum + each.length + 1, 0) + character;
  const backwards = edits.toSorted((a, b) => offset(b.range.start) - offset(a.range.start));
  return backwards.reduce((whole, edit) => whole.slice(0, offset(edit.range.start)) + edit.newText + whole.slice(offset(edit.range.end)), text);
}
