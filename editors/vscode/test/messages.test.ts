/** What `texcrd dap` says, held to the published declarations of the protocol: the TypeScript compiler judges every message. */

import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import * as fs from 'node:fs';
import * as path from 'node:path';
import { test } from 'node:test';
import type { DebugProtocol } from '@vscode/debugprotocol';
import { Session, fixture } from './session';
import { ROOT, aloud, withoutAdapter } from './surroundings';

const options = { skip: aloud(withoutAdapter(), 'the declarations of what the debug adapter says'), timeout: 240_000 };

/** The requests that a debugger sends, each at least once, some so that they are refused. Gives what was said. */
async function conversation(): Promise<DebugProtocol.ProtocolMessage[]> {
  const session = new Session();
  const { client } = session;
  const program = fixture('scene.toml');
  const source = { path: fixture('quad.psh') };
  try {
    await client.start();
    const breakpoints = [{ line: 3, logMessage: 'r0 is {r0}' }, { line: 4, condition: 'r0.r > 0' }, { line: 4, hitCondition: 'often' }];
    await session.launch({ program, pixel: [3, 4] }, { breakpoints: { 'quad.psh': breakpoints }, exceptions: ['nan', 'sample', 'none'] });
    await session.stop();
    const threadId = 1;
    const { body: stack } = await client.stackTraceRequest({ threadId, startFrame: 0, levels: 20 });
    for (const { id: frameId } of stack.stackFrames) {
      const { body } = await client.scopesRequest({ frameId });
      for (const { variablesReference } of body.scopes) {
        for (const variable of await session.variables(variablesReference)) {
          if (variable.variablesReference > 0) {
            await client.variablesRequest({ variablesReference: variable.variablesReference, format: { hex: true } });
          }
        }
      }
    }
    const [{ id: frameId }] = stack.stackFrames as [DebugProtocol.StackFrame];
    for (const context of ['watch', 'hover', 'clipboard', 'variables', 'repl']) {
      await client.evaluateRequest({ expression: 'c0', frameId, context }).catch(() => undefined);
      await client.evaluateRequest({ expression: 'c0.', frameId, context }).catch(() => undefined);
    }
    await client.completionsRequest({ text: 'r', column: 2, frameId });
    await client.customRequest('breakpointLocations', { source, line: 1, endLine: 9 });
    await client.customRequest('loadedSources');
    await client.gotoTargetsRequest({ source, line: 4 }).then(({ body }) => client.gotoRequest({ threadId, targetId: body.targets[0]!.id }));
    const registers = await session.scope('Registers');
    await client.setVariableRequest({ variablesReference: registers, name: 'r0', value: '1' });
    await client.customRequest('setExpression', { expression: 'c0.r', value: '0.5', frameId });
    const { body: info } = await client.dataBreakpointInfoRequest({ variablesReference: registers, name: 'r0' });
    await client.dataBreakpointInfoRequest({ name: '1 + 1' });
    await client.setDataBreakpointsRequest({ breakpoints: [{ dataId: info.dataId! }, { dataId: 'none' }] });
    for (const step of ['next', 'stepBack', 'stepIn', 'stepOut', 'pause'] as const) {
      await client.customRequest(step, { threadId });
    }
    await client.customRequest('restartFrame', { frameId });
    await client.reverseContinueRequest({ threadId });
    // The texture is sampled.
    await client.continueRequest({ threadId });
    await client.exceptionInfoRequest({ threadId });
    await client.customRequest('dance').catch(() => undefined);
    await client.customRequest('restart', {});
    for (let i = 0; i < 9; i++) {
      await client.continueRequest({ threadId });
    }
    await client.terminateRequest();
    return client.said;
  } finally {
    // Disconnects; what is said to that is kept, too.
    await client.stop();
  }
}

/** The interface that the protocol declares for a message. */
function declaration(message: any): string {
  const name = (text: string) => text[0]!.toUpperCase() + text.slice(1);
  if (message.type === 'event') {
    return `${name(message.event)}Event`;
  }
  return message.success ? `${name(message.command)}Response` : 'ErrorResponse';
}

test('every message is one of the protocol', options, async () => {
  const said = await conversation();
  const names = new Set(said.map(declaration));
  for (const name of ['StoppedEvent', 'OutputEvent', 'TerminatedEvent', 'ExceptionInfoResponse', 'SetExpressionResponse', 'DisconnectResponse']) {
    assert.ok(names.has(name), `no ${name} among ${[...names].join(', ')}`);
  }
  const lines = said.map((message, i) => `export const message${i}: DebugProtocol.${declaration(message)} = ${JSON.stringify(message, null, 1)};`);
  const folder = path.join(ROOT, 'out', 'messages');
  fs.mkdirSync(folder, { recursive: true });
  const compilerOptions = { noEmit: true, rootDir: '.', types: ['node'] };
  const settings = { extends: '../../tsconfig.json', compilerOptions, include: ['said.ts'] };
  fs.writeFileSync(path.join(folder, 'tsconfig.json'), JSON.stringify(settings));
  fs.writeFileSync(path.join(folder, 'said.ts'), ["import type { DebugProtocol } from '@vscode/debugprotocol';", ...lines, ''].join('\n'));
  const compiler = path.join(ROOT, 'node_modules', '.bin', 'tsc');
  const { status, stdout, stderr } = spawnSync(compiler, ['-p', folder], { cwd: ROOT, encoding: 'utf8', shell: process.platform === 'win32' });
  assert.equal(status, 0, `${stdout}${stderr}`);
});
