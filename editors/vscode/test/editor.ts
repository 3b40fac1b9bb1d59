/** As much of the editor as the extension uses, so that its compiled code can be loaded without one. */

import Module from 'node:module';
import * as path from 'node:path';
import { ROOT, readJson } from './surroundings';

/** What a test sets, and what the extension did. */
export const editor = {
  settings: {} as Record<string, unknown>,
  activeTextEditor: undefined as unknown,
  workspaceFolders: undefined as unknown,
  answers: [] as (string | undefined)[],
  foundFiles: [] as string[],
  asked: [] as any[],
  errors: [] as string[],
  informations: [] as string[],
  started: [] as unknown[],
  commands: new Map<string, (...args: any[]) => any>(),
  configurationProvider: undefined as any,
  descriptorFactory: undefined as any,
  expressionProvider: undefined as any,
  taskProvider: undefined as any,
  registered: new Set<string>(),
  /** The language clients that were made, and what became of them. */
  clients: [] as Client[],
  status: undefined as any,
  configurationChanged: undefined as any,
};

/** What stands in for the client of a language server. */
class Client {
  readonly args: unknown[];
  state = 'made';
  private changed: ((change: { newState: number }) => void) | undefined;

  constructor(...args: unknown[]) {
    this.args = args;
    editor.clients.push(this);
  }

  onDidChangeState(changed: (change: { newState: number }) => void): void {
    this.changed = changed;
  }

  async start(): Promise<void> {
    this.state = 'started';
  }

  async stop(): Promise<void> {
    this.end();
  }

  /** As when the server is gone. */
  end(): void {
    this.state = 'stopped';
    this.changed?.({ newState: 1 });
  }
}

const nothing = { dispose: () => undefined };

/** What stands in for every class of the editor: it keeps what it was made with. */
class Made {
  constructor(...args: unknown[]) {
    Object.assign(this, { args });
  }
}

function file(fsPath: string): any {
  return { scheme: 'file', fsPath };
}

const vscode = {
  Uri: { file },
  Range: Made,
  EvaluatableExpression: Made,
  DebugAdapterExecutable: Made,
  ProcessExecution: Made,
  RelativePattern: Made,
  TaskGroup: { Build: 'build' },
  Task: Made,
  workspace: {
    get workspaceFolders() {
      return editor.workspaceFolders;
    },
    getWorkspaceFolder: () => undefined,
    getConfiguration: (section: string) => ({
      get: (name: string, otherwise: unknown) => editor.settings[`${section}.${name}`] ?? otherwise,
      inspect: (name: string) => ({ globalValue: editor.settings[`${section}.${name}`] }),
    }),
    onDidChangeConfiguration: (changed: unknown) => {
      editor.configurationChanged = changed;
      return nothing;
    },
    findFiles: async () => editor.foundFiles.map(file),
  },
  window: {
    get activeTextEditor() {
      return editor.activeTextEditor;
    },
    showErrorMessage: async (message: string) => void editor.errors.push(message),
    showInformationMessage: async (message: string) => void editor.informations.push(message),
    showInputBox: async (options: unknown) => {
      editor.asked.push(options);
      return editor.answers.shift();
    },
  },
  commands: {
    registerCommand: (name: string, run: () => unknown) => {
      editor.commands.set(name, run);
      return nothing;
    },
  },
  debug: {
    registerDebugConfigurationProvider: (type: string, provider: unknown) => {
      editor.registered.add(`debug:${type}`);
      editor.configurationProvider = provider;
      return nothing;
    },
    registerDebugAdapterDescriptorFactory: (type: string, factory: unknown) => {
      editor.registered.add(`adapter:${type}`);
      editor.descriptorFactory = factory;
      return nothing;
    },
    startDebugging: async (_folder: unknown, configuration: unknown) => void editor.started.push(configuration),
  },
  LanguageStatusSeverity: { Information: 0, Warning: 1, Error: 2 },
  languages: {
    createLanguageStatusItem: (id: string) => {
      editor.registered.add(`status:${id}`);
      editor.status = { ...nothing };
      return editor.status;
    },
    registerEvaluatableExpressionProvider: (language: string, provider: unknown) => {
      editor.registered.add(`hover:${language}`);
      editor.expressionProvider = provider;
      return nothing;
    },
  },
  tasks: {
    registerTaskProvider: (type: string, provider: unknown) => {
      editor.registered.add(`task:${type}`);
      editor.taskProvider = provider;
      return nothing;
    },
  },
};

/** Loads the extension as it is packaged, and activates it. */
export function activate(): void {
  const loader = Module as unknown as { _load: (request: string, ...rest: unknown[]) => unknown };
  const load = loader._load;
  const own: Record<string, unknown> = { vscode, './client': { LanguageClient: Client, State: { Stopped: 1 } } };
  loader._load = (request, ...rest) => own[request] ?? load(request, ...rest);
  const manifest = readJson('package.json');
  const memory = new Map<string, unknown>();
  const context = {
    subscriptions: [],
    extension: { packageJSON: manifest },
    workspaceState: {
      get: (key: string, otherwise: unknown) => memory.get(key) ?? otherwise,
      update: async (key: string, value: unknown) => void memory.set(key, value),
    },
  };
  require(path.join(ROOT, manifest.main)).activate(context);
}

/** An editor in which a file is open. */
export function showing(fsPath: string, languageId: string, scheme = 'file'): unknown {
  return { document: { uri: { scheme, fsPath }, languageId } };
}
