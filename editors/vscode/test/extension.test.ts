/** The compiled extension in an editor that is only pretended. */

import assert from 'node:assert/strict';
import * as path from 'node:path';
import { beforeEach, test } from 'node:test';
import { activate, editor, showing } from './editor';
import { ROOT, readJson } from './surroundings';

activate();

/** A program that can be started wherever the tests run. */
const PROGRAM = process.execPath;
const folder = { uri: { fsPath: path.resolve('/work space') }, name: 'work space', index: 0 };

beforeEach(() => {
  editor.settings = { 'texcrd.path': PROGRAM };
  editor.activeTextEditor = undefined;
  editor.workspaceFolders = [folder];
  editor.answers = [];
  editor.foundFiles = [];
  for (const list of [editor.asked, editor.errors, editor.informations, editor.started]) {
    list.length = 0;
  }
});

const resolve = (configuration: object) => editor.configurationProvider.resolveDebugConfiguration(folder, configuration);
const complete = (configuration: object) =>
  editor.configurationProvider.resolveDebugConfigurationWithSubstitutedVariables(folder, configuration);
const launch = (program: string, more = {}) => ({ type: 'texcrd', request: 'launch', name: 'test', program, ...more });

test('everything that the manifest contributes is registered', () => {
  const { commands, debuggers, languages, taskDefinitions } = readJson('package.json').contributes;
  assert.deepEqual([...editor.commands.keys()].toSorted(), commands.map((command: any) => command.command).toSorted());
  const expected = [
    `debug:${debuggers[0].type}`,
    `adapter:${debuggers[0].type}`,
    `hover:${languages[0].id}`,
    `task:${taskDefinitions[0].type}`,
    'status:texcrd',
  ];
  assert.deepEqual([...editor.registered].toSorted(), expected.toSorted());
});

test('F5 in an open listing needs no launch.json', async () => {
  editor.activeTextEditor = showing('/shaders/a.psh', 'd3d8asm');
  const resolved = await complete(resolve({}));
  assert.equal(resolved.type, 'texcrd');
  assert.equal(resolved.request, 'launch');
  assert.equal(resolved.program, '/shaders/a.psh');
  assert.equal(resolved.stopOnEntry, true);
  assert.equal(resolved.cwd, folder.uri.fsPath);
  assert.deepEqual(editor.asked, []);
  // Nobody has chosen a dialect, so the program's own default holds.
  assert.equal(resolved.dialect, undefined);
});

test('F5 in an open scene asks for the pixel, and offers the last one the next time', async () => {
  editor.activeTextEditor = showing('/scenes/room.toml', 'toml');
  editor.answers = ['665, 136', '1 2'];
  assert.deepEqual((await complete(resolve({}))).pixel, [665, 136]);
  assert.deepEqual((await complete(resolve({}))).pixel, [1, 2]);
  assert.deepEqual(editor.asked.map((options) => options.value), ['', '665, 136']);
  const { validateInput } = editor.asked[0];
  assert.equal(validateInput('3, 4'), undefined);
  assert.match(validateInput('3'), /Two whole numbers/);
});

test('who goes away from the question debugs nothing', async () => {
  editor.answers = [undefined];
  assert.equal(await complete(launch('/scenes/room.toml')), undefined);
  assert.deepEqual(editor.errors, []);
});

test('F5 where nothing can be debugged opens launch.json', () => {
  for (const open of [undefined, showing('/notes.md', 'markdown'), showing('/a.psh', 'd3d8asm', 'untitled')]) {
    editor.activeTextEditor = open;
    assert.equal(resolve({}), null);
  }
});

test('a configuration of launch.json is left as it is until its variables are put in', () => {
  const given = launch('${file}');
  assert.equal(resolve(given), given);
});

test('the dialect that a person has set is used', async () => {
  editor.settings['texcrd.dialect'] = 'lenient';
  assert.equal((await complete(launch('/a.psh'))).dialect, 'lenient');
  assert.equal((await complete(launch('/a.psh', { dialect: 'd3d9' }))).dialect, 'd3d9');
});

test('a missing program is told before anything starts', async () => {
  editor.settings['texcrd.path'] = '/nowhere/texcrd';
  assert.equal(await complete(launch('/a.psh')), undefined);
  assert.equal(editor.errors.length, 1);
  assert.match(editor.errors[0]!, /\/nowhere\/texcrd.*texcrd\.path/);
  assert.throws(() => editor.descriptorFactory.createDebugAdapterDescriptor({ configuration: {} }), /\/nowhere\/texcrd/);
});

test('a configuration without a program is told', async () => {
  assert.equal(await complete({ type: 'texcrd', request: 'launch', name: 'test' }), undefined);
  assert.match(editor.errors[0]!, /"program"/);
});

test('the adapter is `texcrd dap` in the folder of the session', () => {
  const session = { configuration: { cwd: '/somewhere' }, workspaceFolder: folder };
  const { args } = editor.descriptorFactory.createDebugAdapterDescriptor(session);
  assert.deepEqual(args, [PROGRAM, ['dap'], { cwd: '/somewhere' }]);
});

test('the command debugs the open file', async () => {
  editor.activeTextEditor = showing('/shaders/a.vsa', 'd3d8asm');
  await editor.commands.get('texcrd.debugFile')!();
  assert.deepEqual(editor.started, [{ type: 'texcrd', request: 'launch', name: 'Debug a.vsa', program: '/shaders/a.vsa' }]);
});

test('the command says what it needs', async () => {
  await editor.commands.get('texcrd.debugFile')!();
  assert.deepEqual(editor.started, []);
  assert.match(editor.informations[0]!, /Open a listing or a scene/);
});

test('${command:AskPixel} gives text that becomes a pixel', async () => {
  editor.answers = ['3x4'];
  const text = await editor.commands.get('texcrd.askPixel')!();
  assert.equal(text, '3, 4');
  assert.deepEqual((await complete(launch('/scene.toml', { pixel: text }))).pixel, [3, 4]);
  editor.answers = [undefined];
  assert.equal(await editor.commands.get('texcrd.askPixel')!(), undefined);
});

test('a hover evaluates the operand', () => {
  const document = { lineAt: () => ({ text: 'mov r0.rgb, r1' }) };
  const { args } = editor.expressionProvider.provideEvaluatableExpression(document, { line: 4, character: 5 });
  assert.equal(args[1], 'r0.rgb');
  assert.deepEqual(args[0].args, [4, 4, 4, 10]);
  assert.equal(editor.expressionProvider.provideEvaluatableExpression(document, { line: 4, character: 0 }), undefined);
});

test('tasks check the open listing and all listings', async () => {
  editor.foundFiles = [path.join(folder.uri.fsPath, 'b.vsh'), path.join(folder.uri.fsPath, 'a', 'a.psh')];
  const tasks = await editor.taskProvider.provideTasks();
  const shown = tasks.map(({ args }: any) => [args[2], args[4].args[1], args[5]]);
  assert.deepEqual(shown, [
    ['check the open listing', ['check', '--', '${file}'], '$texcrd'],
    ['check all listings', ['check', '--', path.join('a', 'a.psh'), 'b.vsh'], '$texcrd'],
  ]);
  assert.equal(tasks[0].group, 'build');
});

test('where there are no listings there is no task for them', async () => {
  const tasks = await editor.taskProvider.provideTasks();
  assert.deepEqual(tasks.map(({ args }: any) => args[2]), ['check the open listing']);
});

test('a task of tasks.json keeps its definition', async () => {
  const definition = { type: 'texcrd', command: 'check', files: ['a.psh'], dialect: 'd3d9', args: ['--stats'] };
  const { args } = await editor.taskProvider.resolveTask({ definition, scope: folder, name: 'mine' });
  assert.equal(args[0], definition);
  assert.deepEqual(args[4].args, [PROGRAM, ['check', '--dialect', 'd3d9', '--stats', '--', 'a.psh'], { cwd: folder.uri.fsPath }]);
  const unknown = { definition: { type: 'texcrd', command: 'dance' }, scope: folder, name: 'mine' };
  assert.equal(await editor.taskProvider.resolveTask(unknown), undefined);
});

const restart = () => editor.commands.get('texcrd.restartServer')!();

test('the language server is `texcrd lsp` for listings and for the languages of the setting', async () => {
  editor.settings['texcrd.languages'] = ['cpp'];
  await restart();
  const client = editor.clients.at(-1)!;
  assert.equal(client.state, 'started');
  const [id, , executable, { documentSelector, diagnosticCollectionName }] = client.args as any[];
  assert.equal(id, 'texcrd');
  assert.deepEqual(executable, { command: PROGRAM, args: ['lsp'], options: { cwd: folder.uri.fsPath } });
  assert.deepEqual(documentSelector, [
    { language: 'd3d8asm' },
    { scheme: 'file', pattern: '**/*.{fx,nvv,nvp}' },
    { scheme: 'file', language: 'cpp' },
  ]);
  // Tasks have the same owner, and leave open files to the server.
  const { problemMatchers } = readJson('package.json').contributes;
  assert.deepEqual([problemMatchers[0].owner, problemMatchers[0].applyTo], [diagnosticCollectionName, 'closedDocuments']);
});

test('the command starts the server anew, and other settings than its own do not', async () => {
  await restart();
  const before = editor.clients.at(-1)!;
  await restart();
  const client = editor.clients.at(-1)!;
  assert.deepEqual([before.state, client.state], ['stopped', 'started']);
  assert.equal(editor.status.severity, 0);
  const changed = (name: string) => editor.configurationChanged({ affectsConfiguration: (section: string) => section === name });
  await changed('texcrd.dialect');
  assert.equal(editor.clients.at(-1), client);
  await changed('texcrd.path');
  assert.notEqual(editor.clients.at(-1), client);
});

test('where the program is missing, or the server ends, the status says so, and no message is in the way', async () => {
  editor.settings['texcrd.path'] = '/nowhere/texcrd';
  await restart();
  assert.equal(editor.status.severity, 2);
  assert.match(editor.status.detail, /nowhere/);
  assert.equal(editor.status.command.command, 'workbench.action.openSettings');
  editor.settings['texcrd.path'] = PROGRAM;
  await restart();
  assert.equal(editor.status.severity, 0);
  editor.clients.at(-1)!.end();
  assert.equal(editor.status.severity, 2);
  assert.deepEqual(editor.errors, []);
});

test('the library of the client is one file that loads', () => {
  // In the place of everything that the editor has stands something that can be called, made and asked for parts.
  const anything: any = new Proxy(class {}, { get: (of, name) => (name in of ? Reflect.get(of, name) : anything) });
  const loader = require('node:module') as { _load: (request: string, ...rest: unknown[]) => unknown };
  const load = loader._load;
  loader._load = (request, ...rest) => (request === 'vscode' ? anything : load(request, ...rest));
  try {
    const { LanguageClient, State } = require(path.join(ROOT, 'dist', 'client.js'));
    assert.equal(typeof LanguageClient.prototype.start, 'function');
    assert.equal(State.Stopped, 1);
  } finally {
    loader._load = load;
  }
});

test('nothing but node and the editor is loaded at run time', () => {
  const own = Object.keys(require.cache).filter((file) => file.startsWith(path.join(ROOT, 'dist')));
  assert.ok(own.length >= 3);
  for (const file of own) {
    for (const child of require.cache[file]!.children) {
      assert.ok(child.filename.startsWith(path.join(ROOT, 'dist')), child.filename);
    }
  }
});
