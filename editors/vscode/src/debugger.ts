/** The debugger: the adapter is `texcrd dap`; here is only what stands around it in the editor. */

import * as vscode from 'vscode';
import { LANGUAGE } from './language';
import { check, isScene, launchOf, readPixel, type Launch } from './launch';
import { operandAt } from './operand';
import * as settings from './settings';

const TYPE = 'texcrd';

export function contributeDebugger(context: vscode.ExtensionContext): void {
  const askPixel = (scene?: string) => askForPixel(context.workspaceState, scene);
  context.subscriptions.push(
    vscode.debug.registerDebugConfigurationProvider(TYPE, new Configurations(askPixel)),
    vscode.debug.registerDebugAdapterDescriptorFactory(TYPE, new Adapter()),
    vscode.languages.registerEvaluatableExpressionProvider(LANGUAGE, { provideEvaluatableExpression: hovered }),
    vscode.commands.registerCommand('texcrd.debugFile', debugFile),
    vscode.commands.registerCommand('texcrd.askPixel', async () => (await askPixel())?.join(', ')),
  );
}

type Resolved = vscode.DebugConfiguration | undefined | null;

class Configurations implements vscode.DebugConfigurationProvider {
  constructor(private readonly askPixel: (scene: string) => Promise<[number, number] | undefined>) {}

  /** Without a launch.json the editor has nothing but the file that is open. `null` opens a new launch.json. */
  resolveDebugConfiguration(_folder: vscode.WorkspaceFolder | undefined, given: vscode.DebugConfiguration): Resolved {
    if (given.type || given.request || given.name) {
      return given;
    }
    const file = openFile();
    return file === undefined ? null : launchOf(file);
  }

  /** Variables are put in now: what is missing is asked for, and what cannot work is said before anything starts. */
  async resolveDebugConfigurationWithSubstitutedVariables(
    folder: vscode.WorkspaceFolder | undefined,
    given: vscode.DebugConfiguration,
  ): Promise<Resolved> {
    const found = settings.program(folder);
    if ('problem' in found) {
      void settings.tellProblem(found.problem);
      return undefined;
    }
    const checked = check(given, { cwd: folder?.uri.fsPath, dialect: settings.chosenDialect(folder) });
    if ('problem' in checked) {
      void vscode.window.showErrorMessage(checked.problem);
      return undefined;
    }
    let launch: Launch = checked.launch;
    if ('askPixelOf' in checked) {
      const pixel = await this.askPixel(checked.askPixelOf);
      if (!pixel) {
        return undefined;
      }
      launch = { ...launch, pixel };
    }
    return launch;
  }
}

class Adapter implements vscode.DebugAdapterDescriptorFactory {
  createDebugAdapterDescriptor(session: vscode.DebugSession): vscode.DebugAdapterDescriptor {
    const found = settings.program(session.workspaceFolder);
    if ('problem' in found) {
      throw new Error(found.problem);
    }
    const { cwd } = session.configuration;
    return new vscode.DebugAdapterExecutable(found.path, ['dap'], typeof cwd === 'string' ? { cwd } : undefined);
  }
}

/** The path of the open file if it can be debugged: a listing, or a scene. */
function openFile(): string | undefined {
  const document = vscode.window.activeTextEditor?.document;
  if (!document || document.uri.scheme !== 'file') {
    return undefined;
  }
  const file = document.uri.fsPath;
  return document.languageId === LANGUAGE || isScene(file) ? file : undefined;
}

/** The command: as F5 without a launch.json, whatever launch.json there is. */
async function debugFile(): Promise<void> {
  const file = openFile();
  if (file === undefined) {
    await vscode.window.showInformationMessage('Open a listing or a scene (.toml) that has been saved to disk, and try again.');
    return;
  }
  const folder = vscode.workspace.getWorkspaceFolder(vscode.Uri.file(file));
  await vscode.debug.startDebugging(folder, launchOf(file));
}

/** Asks for a pixel; the last answer for a scene is offered again. `undefined` if the person goes away. */
async function askForPixel(memory: vscode.Memento, scene: string | undefined): Promise<[number, number] | undefined> {
  const key = `pixel:${scene ?? ''}`;
  const answer = await vscode.window.showInputBox({
    title: 'Pixel',
    prompt: 'Which pixel of the picture? Its column and row, counted from 0 at the upper left.',
    placeHolder: '320, 240',
    value: memory.get<string>(key, ''),
    validateInput: (text) => (readPixel(text) ? undefined : 'Two whole numbers, such as 320, 240'),
  });
  const pixel = answer === undefined ? undefined : readPixel(answer);
  if (pixel) {
    await memory.update(key, pixel.join(', '));
  }
  return pixel;
}

/** What a hover evaluates while the debugger stands still. */
function hovered(document: vscode.TextDocument, position: vscode.Position): vscode.EvaluatableExpression | undefined {
  const operand = operandAt(document.lineAt(position.line).text, position.character);
  if (!operand) {
    return undefined;
  }
  const range = new vscode.Range(position.line, operand.start, position.line, operand.end);
  return new vscode.EvaluatableExpression(range, operand.expression);
}
