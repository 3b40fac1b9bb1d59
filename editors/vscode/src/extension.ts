/** What runs when the extension is loaded: each file adds its own contributions. The language server will be one more of them. */

import type * as vscode from 'vscode';
import { contributeDebugger } from './debugger';
import { contributeTasks } from './tasks';

export function activate(context: vscode.ExtensionContext): void {
  for (const contribute of [contributeDebugger, contributeTasks]) {
    contribute(context);
  }
}
