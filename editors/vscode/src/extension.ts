/** What runs when the extension is loaded: each file adds its own contributions. */

import type * as vscode from 'vscode';
import { contributeDebugger } from './debugger';
import { contributeLanguageServer, endLanguageServer } from './languageServer';
import { contributeTasks } from './tasks';

export function activate(context: vscode.ExtensionContext): void {
  for (const contribute of [contributeDebugger, contributeTasks, contributeLanguageServer]) {
    contribute(context);
  }
}

export async function deactivate(): Promise<void> {
  await endLanguageServer();
}
