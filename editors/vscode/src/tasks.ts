/** Tasks: `texcrd check` with its problems in the Problems view. */

import * as path from 'node:path';
import * as vscode from 'vscode';
import { listingExtensions } from './language';
import * as settings from './settings';

const TYPE = 'texcrd';
/** The problem matcher of the manifest. */
const MATCHER = '$texcrd';
/** The most listings that one task names: command lines have an end. */
const MOST_FILES = 500;

/** A task of this kind as tasks.json has it; the manifest documents each property. */
interface Definition extends vscode.TaskDefinition {
  command: 'check';
  files?: string[];
  dialect?: string;
  args?: string[];
}

export function contributeTasks(context: vscode.ExtensionContext): void {
  context.subscriptions.push(vscode.tasks.registerTaskProvider(TYPE, new Checks(listingExtensions(context))));
}

class Checks implements vscode.TaskProvider {
  constructor(private readonly extensions: string[]) {}

  async provideTasks(): Promise<vscode.Task[]> {
    const folders = vscode.workspace.workspaceFolders ?? [];
    const tasks = folders.flatMap((folder) => [
      this.task(folder, { type: TYPE, command: 'check', files: ['${file}'] }, 'check the open listing'),
      this.task(folder, { type: TYPE, command: 'check' }, 'check all listings'),
    ]);
    return (await Promise.all(tasks)).filter((task) => task !== undefined);
  }

  /** A task of tasks.json: its definition is kept as it is, or the editor does not know it again. */
  async resolveTask(task: vscode.Task): Promise<vscode.Task | undefined> {
    const definition = task.definition as Definition;
    const scope = task.scope;
    const folder = typeof scope === 'object' ? scope : vscode.workspace.workspaceFolders?.[0];
    return definition.command === 'check' && folder ? this.task(folder, definition, task.name) : undefined;
  }

  private async task(folder: vscode.WorkspaceFolder, definition: Definition, name: string): Promise<vscode.Task | undefined> {
    const files = definition.files ?? (await this.listings(folder));
    if (files.length === 0) {
      return undefined;
    }
    const found = settings.program(folder);
    // A program that is missing fails when the task is run, with its name in the terminal.
    const program = 'path' in found ? found.path : 'texcrd';
    const dialect = definition.dialect ?? settings.chosenDialect(folder);
    const options = [...(dialect === undefined ? [] : ['--dialect', dialect]), ...(definition.args ?? [])];
    const execution = new vscode.ProcessExecution(program, ['check', ...options, '--', ...files], {
      cwd: folder.uri.fsPath,
    });
    const task = new vscode.Task(definition, folder, name, 'texcrd', execution, MATCHER);
    task.group = vscode.TaskGroup.Build;
    return task;
  }

  /** The listings of a folder, relative to it, in order. */
  private async listings(folder: vscode.WorkspaceFolder): Promise<string[]> {
    const endings = this.extensions.map((ending) => ending.slice(1)).join(',');
    const pattern = new vscode.RelativePattern(folder, `**/*.{${endings}}`);
    const found = await vscode.workspace.findFiles(pattern, undefined, MOST_FILES);
    return found.map((uri) => path.relative(folder.uri.fsPath, uri.fsPath)).sort();
  }
}
