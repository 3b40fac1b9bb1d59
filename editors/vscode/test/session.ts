/** A debug session as an editor holds it: a client of the Debug Adapter Protocol that knows nothing of texcrd but its launch attributes. */

import assert from 'node:assert/strict';
import * as path from 'node:path';
import { DebugClient } from '@vscode/debugadapter-testsupport';
import type { DebugProtocol } from '@vscode/debugprotocol';
import { FIXTURES, TEXCRD } from './surroundings';

/** How long an answer may take, in milliseconds: a debug build on a busy machine, and a small shader. */
const PATIENCE = 20_000;

/** What is set before the program runs. */
export interface Before {
  /** Breakpoints by file of the fixtures. */
  breakpoints?: Record<string, DebugProtocol.SourceBreakpoint[]>;
  /** Exception filters. */
  exceptions?: string[];
}

/** What the adapter said of its own accord, in the order in which it did. */
type Turn = { stopped: DebugProtocol.StoppedEvent['body'] } | 'terminated';

export function fixture(name: string): string {
  return path.join(FIXTURES, name);
}

/**
 * The client, made to reject with all that an adapter says of a failure (people are shown the error in the body, not the short message), and to keep
 * what was said.
 */
class Client extends DebugClient {
  /** Every message of the adapter, as it came. */
  readonly said: DebugProtocol.ProtocolMessage[] = [];

  constructor() {
    super(TEXCRD!, 'dap', 'texcrd', { cwd: FIXTURES });
    const self = this as unknown as { dispatch: (body: string) => void };
    const dispatch = self.dispatch.bind(this);
    self.dispatch = (body) => {
      this.said.push(JSON.parse(body));
      const message = JSON.parse(body);
      if (message.type === 'response' && !message.success && message.body?.error) {
        const { format, variables = {} } = message.body.error as DebugProtocol.Message;
        const filled = format.replace(/\{(\w+)\}/g, (whole, name) => variables[name] ?? whole);
        message.message = `${message.message ?? ''} ${filled}`;
      }
      dispatch(JSON.stringify(message));
    };
  }
}

export class Session {
  readonly client = new Client();
  capabilities: DebugProtocol.Capabilities = {};
  /** All text of output events so far. */
  output = '';
  private readonly turns: Turn[] = [];
  private awaited: ((turn: Turn) => void) | undefined;

  constructor() {
    this.client.defaultTimeout = PATIENCE;
    this.client.on('stopped', ({ body }) => this.take({ stopped: body }));
    this.client.on('terminated', () => this.take('terminated'));
    this.client.on('output', ({ body }) => (this.output += body.output));
  }

  /** Starts the adapter and says hello. */
  static async start(): Promise<Session> {
    const session = new Session();
    await session.client.start();
    const { body } = await session.client.initializeRequest();
    session.capabilities = body ?? {};
    return session;
  }

  /** Runs what `use` does with a launched session, and ends it whatever happens. */
  static async launched<T>(launch: object, before: Before, use: (session: Session) => Promise<T>): Promise<T> {
    const session = new Session();
    try {
      await session.client.start();
      await session.launch(launch, before);
      return await use(session);
    } finally {
      await session.client.stop();
    }
  }

  /** Launches, and configures when the adapter asks for it: some do so at once, some when they have the launch request. */
  async launch(launch: object, { breakpoints = {}, exceptions = [] }: Before = {}): Promise<void> {
    const initialized = this.client.waitForEvent('initialized');
    this.capabilities = (await this.client.initializeRequest()).body ?? {};
    const launching = this.client.launchRequest({ ...launch } as DebugProtocol.LaunchRequestArguments);
    const configuring = initialized.then(async () => {
      for (const [name, list] of Object.entries(breakpoints)) {
        await this.setBreakpoints(name, list);
      }
      await this.client.setExceptionBreakpointsRequest({ filters: exceptions });
      await this.client.configurationDoneRequest();
    });
    // A launch that fails says more than what then cannot be configured.
    configuring.catch(() => undefined);
    await launching;
    await configuring;
  }

  async setBreakpoints(name: string, breakpoints: DebugProtocol.SourceBreakpoint[]): Promise<DebugProtocol.Breakpoint[]> {
    const response = await this.client.setBreakpointsRequest({ source: { path: fixture(name) }, breakpoints });
    return response.body.breakpoints;
  }

  private take(turn: Turn): void {
    if (this.awaited) {
      this.awaited(turn);
      this.awaited = undefined;
    } else {
      this.turns.push(turn);
    }
  }

  /** The next stop or the end. */
  async turn(): Promise<Turn> {
    const waiting = this.turns.shift();
    if (waiting) {
      return waiting;
    }
    let timer: NodeJS.Timeout | undefined;
    try {
      return await new Promise<Turn>((resolve, reject) => {
        this.awaited = resolve;
        timer = setTimeout(() => reject(new Error(`neither stopped nor terminated within ${PATIENCE} ms\n${this.output}`)), PATIENCE);
      });
    } finally {
      clearTimeout(timer);
    }
  }

  /** Waits for a stop: why, and where. */
  async stop(): Promise<{ reason: string; line: number; file: string }> {
    const turn = await this.turn();
    assert.notEqual(turn, 'terminated', 'it ran to its end instead of stopping');
    const { stopped } = turn as Exclude<Turn, 'terminated'>;
    const { line, source } = await this.frame();
    return { reason: stopped.reason, line, file: path.basename(source?.path ?? '') };
  }

  /** Waits for the end. */
  async end(): Promise<void> {
    assert.equal(await this.turn(), 'terminated');
  }

  async thread(): Promise<{ threadId: number }> {
    const [thread] = (await this.client.threadsRequest()).body.threads;
    assert.ok(thread, 'there is no thread');
    return { threadId: thread.id };
  }

  async frame(): Promise<DebugProtocol.StackFrame> {
    const [frame] = (await this.client.stackTraceRequest(await this.thread())).body.stackFrames;
    assert.ok(frame, 'there is no stack frame');
    return frame;
  }

  async next(): Promise<{ reason: string; line: number; file: string }> {
    await this.client.nextRequest(await this.thread());
    return this.stop();
  }

  async stepBack(): Promise<{ reason: string; line: number; file: string }> {
    await this.client.stepBackRequest(await this.thread());
    return this.stop();
  }

  async continue(): Promise<void> {
    await this.client.continueRequest(await this.thread());
  }

  async reverseContinue(): Promise<void> {
    await this.client.reverseContinueRequest(await this.thread());
  }

  async scopes(): Promise<DebugProtocol.Scope[]> {
    return (await this.client.scopesRequest({ frameId: (await this.frame()).id })).body.scopes;
  }

  /** The reference of a scope by its name. */
  async scope(name: string): Promise<number> {
    const scopes = await this.scopes();
    const scope = scopes.find((each) => each.name === name);
    return scope?.variablesReference ?? assert.fail(`there is no scope ${name} among ${scopes.map((each) => each.name).join(', ')}`);
  }

  async variables(variablesReference: number): Promise<DebugProtocol.Variable[]> {
    return (await this.client.variablesRequest({ variablesReference })).body.variables;
  }

  async variable(scope: string, name: string): Promise<DebugProtocol.Variable> {
    const variables = await this.variables(await this.scope(scope));
    const found = variables.find((variable) => variable.name === name);
    return found ?? assert.fail(`there is no ${name} among ${variables.map((each) => each.name).join(', ')} of ${scope}`);
  }

  /** The components of a register that can be unfolded, under whichever names. */
  async components(variable: DebugProtocol.Variable): Promise<DebugProtocol.Variable[]> {
    if (variable.variablesReference === 0) {
      return [];
    }
    return (await this.variables(variable.variablesReference)).filter(({ name }) => /^\.?[xyzwrgba]$/i.test(name));
  }

  /** The numbers of a register as a scope shows it. */
  async register(scope: string, name: string): Promise<number[]> {
    const variable = await this.variable(scope, name);
    const components = await this.components(variable);
    return components.length > 0 ? components.map(({ value }) => numbers(value)[0] ?? NaN) : numbers(variable.value).slice(0, 4);
  }

  /** The numbers that an expression has. */
  async evaluate(expression: string, context = 'watch'): Promise<number[]> {
    const frameId = (await this.frame()).id;
    const { body } = await this.client.evaluateRequest({ expression, frameId, context });
    return numbers(body.result);
  }

  /** Every scope with all its variables, as text: two that are equal look the same to a person. */
  async everything(): Promise<string> {
    const lines: string[] = [];
    for (const scope of await this.scopes()) {
      for (const { name } of await this.variables(scope.variablesReference)) {
        lines.push(`${scope.name} ${name} = ${(await this.register(scope.name, name)).join(', ')}`);
      }
    }
    return lines.join('\n');
  }
}

/** The numbers in a text that may say more than numbers: `(0.25, 0.5)`, `1, NaN`, `r0.x = 3`. */
export function numbers(text: string): number[] {
  const found = text.matchAll(/(?<![\w.#])(?:[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?|([-+]?)inf(?:inity)?|nan)(?![\w.])/gi);
  return [...found].map(([whole, sign]) => {
    if (/inf/i.test(whole)) {
      return sign === '-' ? -Infinity : Infinity;
    }
    return Number(whole.toLowerCase() === 'nan' ? NaN : whole);
  });
}
