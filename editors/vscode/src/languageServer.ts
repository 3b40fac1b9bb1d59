/** The language server: it is `texcrd lsp`; here is only what starts it, and says so where it cannot be started. */

import * as vscode from 'vscode';
import type * as Client from './client';
import { LANGUAGE } from './language';
import * as settings from './settings';

/** The name of the server to the editor: that of its settings, its output channel and its diagnostics. */
const ID = 'texcrd';
const RESTART = 'texcrd.restartServer';

type LanguageClient = Client.LanguageClient;

let server: Server | undefined;

export function contributeLanguageServer(context: vscode.ExtensionContext): void {
  const own = new Server();
  server = own;
  context.subscriptions.push(
    own.status,
    vscode.commands.registerCommand(RESTART, () => own.restart()),
    vscode.workspace.onDidChangeConfiguration(async (change) => {
      // The server hears of the other settings itself.
      if (change.affectsConfiguration('texcrd.path') || change.affectsConfiguration('texcrd.languages')) {
        await own.restart();
      }
    }),
  );
  void own.restart();
}

/** Stops the server. The editor waits for it. */
export async function endLanguageServer(): Promise<void> {
  await server?.stop();
  server = undefined;
}

class Server {
  /** Stands beside the name of the language, and says what is the matter with the server. */
  readonly status: vscode.LanguageStatusItem;
  private client: LanguageClient | undefined;
  /** What has been asked for so far: one thing is done after the other. */
  private done: Promise<void> = Promise.resolve();

  constructor() {
    this.status = vscode.languages.createLanguageStatusItem(ID, { language: LANGUAGE });
    this.status.name = 'texcrd';
  }

  restart(): Promise<void> {
    return this.behind(async () => {
      await this.end();
      await this.start();
    });
  }

  stop(): Promise<void> {
    return this.behind(() => this.end());
  }

  private behind(what: () => Promise<void>): Promise<void> {
    this.done = this.done.then(what).catch((error: unknown) => this.fail(String(error)));
    return this.done;
  }

  private async start(): Promise<void> {
    const folder = vscode.workspace.workspaceFolders?.[0];
    const found = settings.program(folder);
    if ('problem' in found) {
      this.fail(found.problem);
      return;
    }
    // Loaded only now: it is larger than all the rest.
    const { LanguageClient, State } = require('./client') as typeof Client;
    const cwd = folder?.uri.fsPath;
    const client = new LanguageClient(
      ID,
      'texcrd',
      { command: found.path, args: ['lsp'], options: cwd === undefined ? {} : { cwd } },
      {
        documentSelector: selector(),
        diagnosticCollectionName: ID,
        initializationOptions: vscode.workspace.getConfiguration(ID),
        synchronize: { configurationSection: ID },
      },
    );
    client.onDidChangeState(({ newState }) => {
      if (this.client === client && newState === State.Stopped) {
        this.fail('The language server has ended.');
      }
    });
    this.client = client;
    this.say(vscode.LanguageStatusSeverity.Information, 'texcrd', 'language server', { title: 'Restart', command: RESTART });
    await client.start();
  }

  private async end(): Promise<void> {
    const client = this.client;
    this.client = undefined;
    await client?.stop();
  }

  private fail(problem: string): void {
    const openSettings = { title: 'Open Settings', command: 'workbench.action.openSettings', arguments: ['texcrd.path'] };
    this.say(vscode.LanguageStatusSeverity.Error, 'texcrd does not run', problem, openSettings);
  }

  private say(severity: vscode.LanguageStatusSeverity, text: string, detail: string, command: vscode.Command): void {
    Object.assign(this.status, { severity, text, detail, command });
  }
}

/** The documents that the server looks at. It says nothing of those in which no shader is. */
function selector(): Client.DocumentSelector {
  const others = vscode.workspace.getConfiguration(ID).get<string[]>('languages', []);
  return [
    { language: LANGUAGE },
    { scheme: 'file', pattern: '**/*.{fx,nvv,nvp}' },
    ...others.map((language) => ({ scheme: 'file', language })),
  ];
}
