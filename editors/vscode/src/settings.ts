/** The settings of the extension. */

import * as vscode from 'vscode';
import { findProgram, notFound } from './program';

/** The setting `texcrd.dialect` for this folder, if a person has set it; else the program's own default holds. */
export function chosenDialect(folder: vscode.WorkspaceFolder | undefined): string | undefined {
  const { workspaceFolderValue, workspaceValue, globalValue } =
    vscode.workspace.getConfiguration('texcrd', folder).inspect<string>('dialect') ?? {};
  return workspaceFolderValue ?? workspaceValue ?? globalValue;
}

/** The program that `texcrd.path` names, or what to tell the person. */
export function program(folder: vscode.WorkspaceFolder | undefined): { path: string } | { problem: string } {
  const setting = vscode.workspace.getConfiguration('texcrd', folder).get<string>('path', 'texcrd');
  const found = findProgram(setting, {
    folder: folder?.uri.fsPath,
    environment: process.env,
    platform: process.platform,
  });
  return found === undefined ? { problem: notFound(setting) } : { path: found };
}

/** Tells that the program is missing, with the way to the setting. */
export async function tellProblem(problem: string): Promise<void> {
  const open = 'Open Settings';
  if ((await vscode.window.showErrorMessage(problem, open)) === open) {
    await vscode.commands.executeCommand('workbench.action.openSettings', 'texcrd.path');
  }
}
