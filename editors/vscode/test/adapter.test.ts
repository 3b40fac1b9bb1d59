/**
 * `texcrd dap`, driven by an independent client. Written from the protocol's specification; where that leaves a choice, each choice passes. Numbers
 * were worked out by hand, and all of them are exact in 32 bits but those that a rasterizer interpolates.
 */

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { test } from 'node:test';
import { Session, fixture, numbers } from './session';
import { TEXCRD, aloud, withoutAdapter } from './surroundings';

/** An adapter that never answers must not keep the tests waiting. */
const options = { skip: aloud(withoutAdapter(), 'the tests of the debug adapter'), timeout: 120_000 };

const ARITHMETIC = {
  program: fixture('arithmetic.psh'),
  set: { t0: [0.25, 0.5, 0.75, 1], c0: [1, 0.5, 0, 0.5] },
};

/** Lines of arithmetic.psh in order, with the register that each writes and all of its components afterwards; null: not written so far. */
const STEPS: [line: number, register: string, after: (number | null)[]][] = [
  [4, 'r0', [0.25, 0.5, 0.75, null]], // r0.rgb = t0
  [5, 'r1', [0.5, 0.125, 0, 0.125]], // c0 * c1
  [6, 'r0', [0.75, 0.625, 0.75, null]], // r0.rgb + r1.rgb
  [7, 'r1', [1.125, 0.78125, 1.125, 0.125]], // 2 * 0.75 * 0.75, 2 * 0.625 * 0.625; alpha stays
  [8, 'r0', [1, 0.78125, 1, null]], // clamped to 1
  [9, 'r0', [1, 0.78125, 1, 0.5]], // c0.a
  [10, 'r0', [1, 0.78125, 1, 0.625]], // 0.5 + 0.125
  [11, 'r1', [1, 0.78125, 1, 0.625]],
];
const LINES = STEPS.map(([line]) => line);

function assertComponents(actual: number[], expected: (number | null)[], what: string): void {
  const compared = expected.map((value, i) => (value === null ? null : actual[i]));
  assert.deepEqual(compared, expected, `${what} is ${actual.join(', ')}`);
}

/** Where a stop may stand that is about what the instruction in `line` does: at it, or behind it. */
function assertAbout(actual: number, line: number, lines = LINES): void {
  const behind = lines[lines.indexOf(line) + 1];
  assert.ok(actual === line || actual === behind, `it stopped in line ${actual}; what happens, happens in line ${line}`);
}

const stopped = (launch: object, breakpoints: Record<string, any[]>, use: (session: Session) => Promise<void>) =>
  Session.launched({ ...launch, stopOnEntry: false }, { breakpoints }, use);

test('the adapter says what it can', options, async () => {
  const session = await Session.start();
  try {
    const { capabilities } = session;
    for (const capability of [
      'supportsConfigurationDoneRequest',
      'supportsStepBack',
      'supportsConditionalBreakpoints',
      'supportsHitConditionalBreakpoints',
      'supportsLogPoints',
      'supportsSetVariable',
      'supportsEvaluateForHovers',
      'supportsDataBreakpoints',
      'supportsGotoTargetsRequest',
    ] as const) {
      assert.equal(capabilities[capability], true, capability);
    }
    const filters = capabilities.exceptionBreakpointFilters ?? [];
    // The names that the debugger's commands have for them.
    assert.deepEqual(filters.map(({ filter }) => filter).toSorted(), ['clamp', 'inf', 'nan', 'range', 'sample', 'uninit']);
    assert.ok(filters.every(({ label }) => label.length > 0));
  } finally {
    await session.client.stop();
  }
});

test('a listing stops on entry, in its source', options, async () => {
  await Session.launched(ARITHMETIC, {}, async (session) => {
    const { reason, line, file } = await session.stop();
    assert.deepEqual([reason, line, file], ['entry', 4, 'arithmetic.psh']);
    const { source } = await session.frame();
    assert.equal(source?.path, ARITHMETIC.program);
  });
});

test('stopOnEntry is true where nothing is said', options, async () => {
  await Session.launched(ARITHMETIC, {}, async (session) => {
    assert.equal((await session.stop()).reason, 'entry');
  });
  await Session.launched({ ...ARITHMETIC, stopOnEntry: false }, {}, (session) => session.end());
});

test('registers, inputs, constants, textures and outputs each have a scope', options, async () => {
  await Session.launched(ARITHMETIC, {}, async (session) => {
    await session.stop();
    const names = (await session.scopes()).map(({ name }) => name);
    for (const name of ['Registers', 'Inputs', 'Constants', 'Textures', 'Outputs']) {
      assert.ok(names.includes(name), `${name} is not among ${names.join(', ')}`);
    }
    assert.deepEqual(await session.register('Inputs', 't0'), [0.25, 0.5, 0.75, 1]);
    assert.deepEqual(await session.register('Constants', 'c0'), [1, 0.5, 0, 0.5]);
    // That of the listing's own def.
    assert.deepEqual(await session.register('Constants', 'c1'), [0.5, 0.25, 1, 0.25]);
  });
});

test('each step gives the numbers that arithmetic by hand gives', options, async () => {
  await Session.launched(ARITHMETIC, {}, async (session) => {
    assert.equal((await session.stop()).line, LINES[0]);
    for (const [i, [line, register, after]] of STEPS.slice(0, -1).entries()) {
      const { reason, line: reached } = await session.next();
      assert.deepEqual([reason, reached], ['step', LINES[i + 1]]);
      assertComponents(await session.register('Registers', register), after, `${register} after line ${line}`);
    }
  });
});

test('behind the last step the run is at its end', options, async () => {
  await stopped(ARITHMETIC, { 'arithmetic.psh': [{ line: 11 }] }, async (session) => {
    assert.equal((await session.stop()).line, 11);
    await session.continue();
    await session.end();
  });
});

test('stepping back is stepping forward undone', options, async () => {
  await Session.launched(ARITHMETIC, {}, async (session) => {
    let { line } = await session.stop();
    const seen: [line: number, everything: string][] = [];
    while (line !== LINES.at(-1)) {
      seen.push([line, await session.everything()]);
      ({ line } = await session.next());
    }
    for (const [before, everything] of seen.toReversed()) {
      assert.equal((await session.stepBack()).line, before);
      assert.equal(await session.everything(), everything, `line ${before}`);
    }
  });
});

test('a breakpoint stops before its line', options, async () => {
  await stopped(ARITHMETIC, { 'arithmetic.psh': [{ line: 6 }, { line: 9 }] }, async (session) => {
    const { reason, line, file } = await session.stop();
    assert.deepEqual([reason, line, file], ['breakpoint', 6, 'arithmetic.psh']);
    assertComponents(await session.register('Registers', 'r0'), [0.25, 0.5, 0.75, null], 'r0');
    await session.continue();
    assert.equal((await session.stop()).line, 9);
    await session.continue();
    await session.end();
  });
});

test('breakpoints are answered one by one; where nothing can stop they move or are not verified', options, async () => {
  await Session.launched(ARITHMETIC, {}, async (session) => {
    await session.stop();
    const set = await session.setBreakpoints('arithmetic.psh', [{ line: 7 }, { line: 1 }, { line: 99 }]);
    assert.equal(set.length, 3);
    assert.equal(set[0]!.verified, true);
    assert.equal(set[0]!.line ?? 7, 7);
    // Line 1 is a comment, line 99 does not exist.
    assert.ok(!set[1]!.verified || LINES.includes(set[1]!.line!), JSON.stringify(set[1]));
    assert.ok(!set[2]!.verified || LINES.includes(set[2]!.line!), JSON.stringify(set[2]));
    // The next list replaces this one.
    await session.setBreakpoints('arithmetic.psh', []);
    await session.continue();
    await session.end();
  });
});

test('breakpoints have conditions', options, async () => {
  // Before line 7 r0.x is 0.75.
  const conditions: [condition: string, stops: boolean][] = [
    ['r0.x > 0.5', true],
    ['r0.x > 0.75', false],
    ['r0.x >= 0.75', true],
    ['r0.y < 0.5', false],
    ['c1.a == 0.25', true],
  ];
  for (const [condition, stops] of conditions) {
    await stopped(ARITHMETIC, { 'arithmetic.psh': [{ line: 7, condition }] }, async (session) => {
      const turn = await session.turn();
      assert.equal(turn !== 'terminated', stops, condition);
    });
  }
});

test('breakpoints count hits', options, async () => {
  // Without loops each line runs once.
  for (const [hitCondition, stops] of [['1', true], ['2', false]] as const) {
    await stopped(ARITHMETIC, { 'arithmetic.psh': [{ line: 7, hitCondition }] }, async (session) => {
      const turn = await session.turn();
      assert.equal(turn !== 'terminated', stops, hitCondition);
    });
  }
});

test('log points say what they should and do not stop', options, async () => {
  const breakpoints = { 'arithmetic.psh': [{ line: 7, logMessage: 'red is {r0.x} here' }, { line: 9 }] };
  await stopped(ARITHMETIC, breakpoints, async (session) => {
    assert.equal((await session.stop()).line, 9);
    const said = /red is (.*) here/.exec(session.output);
    assert.ok(said, session.output);
    assert.deepEqual(numbers(said[1]!), [0.75]);
  });
});

test('reverse continue goes to the breakpoint before, and then to the start', options, async () => {
  await stopped(ARITHMETIC, { 'arithmetic.psh': [{ line: 6 }, { line: 10 }] }, async (session) => {
    assert.equal((await session.stop()).line, 6);
    await session.continue();
    assert.equal((await session.stop()).line, 10);
    await session.reverseContinue();
    const { reason, line } = await session.stop();
    assert.deepEqual([reason, line], ['breakpoint', 6]);
    assertComponents(await session.register('Registers', 'r0'), [0.25, 0.5, 0.75, null], 'r0');
    await session.reverseContinue();
    assert.equal((await session.stop()).line, 4);
    await session.continue();
    assert.equal((await session.stop()).line, 6);
  });
});

test('go to a line, forwards and backwards', options, async () => {
  await Session.launched(ARITHMETIC, {}, async (session) => {
    await session.stop();
    for (const [line, alpha] of [[10, 0.5], [5, null], [11, 0.625]] as const) {
      const { body } = await session.client.gotoTargetsRequest({ source: { path: ARITHMETIC.program }, line });
      assert.ok(body.targets.length > 0, `line ${line}`);
      assert.equal(body.targets[0]!.line, line);
      await session.client.gotoRequest({ ...(await session.thread()), targetId: body.targets[0]!.id });
      const stop = await session.stop();
      assert.deepEqual([stop.reason, stop.line], ['goto', line]);
      assertComponents(await session.register('Registers', 'r0'), [null, null, null, alpha], 'r0');
    }
  });
});

test('a register can be set, and the run goes on with it', options, async () => {
  const breakpoints = { 'arithmetic.psh': [{ line: 6 }, { line: 7 }] };
  await stopped(ARITHMETIC, breakpoints, async (session) => {
    await session.stop();
    // r1 is (0.5, 0.125, 0, 0.125); its first component becomes 0.25.
    const r1 = await session.variable('Registers', 'r1');
    const [first] = await session.components(r1);
    const { body } = first
      ? await session.client.setVariableRequest({ variablesReference: r1.variablesReference, name: first.name, value: '0.25' })
      : await session.client.setVariableRequest({
          variablesReference: await session.scope('Registers'),
          name: 'r1',
          value: '0.25, 0.125, 0, 0.125',
        });
    assert.equal(numbers(body.value)[0], 0.25);
    assert.deepEqual(await session.register('Registers', 'r1'), [0.25, 0.125, 0, 0.125]);
    await session.continue();
    assert.equal((await session.stop()).line, 7);
    // 0.25 + 0.25; the others as ever.
    assertComponents(await session.register('Registers', 'r0'), [0.5, 0.625, 0.75, null], 'r0');
  });
});

test('a value that is none is refused, and nothing changes', options, async () => {
  await stopped(ARITHMETIC, { 'arithmetic.psh': [{ line: 6 }] }, async (session) => {
    await session.stop();
    const variablesReference = await session.scope('Registers');
    await assert.rejects(session.client.setVariableRequest({ variablesReference, name: 'r1', value: 'much' }));
    assert.deepEqual(await session.register('Registers', 'r1'), [0.5, 0.125, 0, 0.125]);
  });
});

test('expressions are evaluated, for watches and for hovers', options, async () => {
  await stopped(ARITHMETIC, { 'arithmetic.psh': [{ line: 6 }] }, async (session) => {
    await session.stop();
    for (const context of ['watch', 'hover']) {
      assert.deepEqual(await session.evaluate('r0.rgb', context), [0.25, 0.5, 0.75], context);
    }
    assert.deepEqual(await session.evaluate('r1.x'), [0.5]);
    assert.deepEqual(await session.evaluate('r0.zyx'), [0.75, 0.5, 0.25]);
    assert.deepEqual(await session.evaluate('c1.a'), [0.25]);
    assert.deepEqual(await session.evaluate('t0'), [0.25, 0.5, 0.75, 1]);
    const { id: frameId } = await session.frame();
    for (const expression of ['q7', 'r0.', 'r0.xg', '']) {
      await assert.rejects(session.client.evaluateRequest({ expression, frameId, context: 'watch' }), `"${expression}"`);
    }
  });
});

test('data breakpoints stop where a register is written', options, async () => {
  await Session.launched(ARITHMETIC, {}, async (session) => {
    await session.stop();
    const variablesReference = await session.scope('Registers');
    const { body } = await session.client.dataBreakpointInfoRequest({ variablesReference, name: 'r1' });
    assert.ok(body.dataId, body.description);
    assert.ok(body.accessTypes?.includes('write') ?? true);
    const set = await session.client.setDataBreakpointsRequest({ breakpoints: [{ dataId: body.dataId, accessType: 'write' }] });
    assert.deepEqual(set.body.breakpoints.map(({ verified }) => verified), [true]);
    for (const written of [5, 7]) {
      await session.continue();
      const { reason, line } = await session.stop();
      assert.equal(reason, 'data breakpoint');
      assertAbout(line, written);
    }
    await session.client.setDataBreakpointsRequest({ breakpoints: [] });
    await session.continue();
    await session.end();
  });
});

test('data breakpoints can watch a component', options, async () => {
  await stopped(ARITHMETIC, { 'arithmetic.psh': [{ line: 6 }] }, async (session) => {
    await session.stop();
    const r0 = await session.variable('Registers', 'r0');
    const components = await session.components(r0);
    assert.equal(components.length, 4, 'a register unfolds into its components');
    const { body } = await session.client.dataBreakpointInfoRequest({
      variablesReference: r0.variablesReference,
      name: components[3]!.name,
    });
    assert.ok(body.dataId, body.description);
    await session.client.setDataBreakpointsRequest({ breakpoints: [{ dataId: body.dataId, accessType: 'write' }] });
    // Lines 6 and 8 write the other three.
    await session.continue();
    const { reason, line } = await session.stop();
    assert.equal(reason, 'data breakpoint');
    assertAbout(line, 9);
  });
});

test('exception filters stop where something happens that seldom should', options, async () => {
  const large = [3e38, 3e38, 3e38, 3e38];
  const nan = { program: fixture('nan.vsh'), set: { v0: large, c0: large } };
  const clamp = { program: fixture('clamp.psh'), set: { c0: [0.75, 0.75, 0.75, 0.75], c1: [2, 2, 2, 2] } };
  const uninitialised = { program: fixture('uninitialised.psh'), dialect: 'lenient', set: { c0: [0.5, 0.5, 0.5, 0.5] } };
  const cases: [filter: string, launch: object, line: number, lines: number[]][] = [
    // 3e38 + 3e38 is more than the largest number of 32 bits.
    ['inf', nan, 3, [2, 3, 4, 5]],
    // Infinity less infinity.
    ['nan', nan, 4, [2, 3, 4, 5]],
    // 0.75 + 1 (pixel shaders clamp the constant 2) is saturated.
    ['clamp', clamp, 3, [2, 3, 4]],
    // r1 was never written.
    ['uninit', uninitialised, 3, [2, 3, 4]],
  ];
  for (const [filter, launch, line, lines] of cases) {
    await Session.launched({ ...launch, stopOnEntry: false }, { exceptions: [filter] }, async (session) => {
      const stop = await session.stop();
      assert.equal(stop.reason, 'exception', filter);
      assertAbout(stop.line, line, lines);
      if (session.capabilities.supportsExceptionInfoRequest) {
        const { body } = await session.client.exceptionInfoRequest(await session.thread());
        assert.ok(body.exceptionId.length > 0);
      }
    });
    // Where the filter is off nothing stops.
    await Session.launched({ ...launch, stopOnEntry: false }, {}, (session) => session.end());
  }
});

test('NaN and infinity are shown as what they are', options, async () => {
  const large = [3e38, 3e38, 3e38, 3e38];
  await stopped({ program: fixture('nan.vsh'), set: { v0: large, c0: large } }, { 'nan.vsh': [{ line: 5 }] }, async (session) => {
    await session.stop();
    assert.deepEqual(await session.register('Registers', 'r0'), Array(4).fill(Infinity));
    assert.deepEqual(await session.register('Registers', 'r1'), Array(4).fill(NaN));
  });
});

test('a macro is one step over, or as many steps as it has rows', options, async () => {
  // Rows c0 to c3 turn (1, 2, 3, 1) into (1 + 10, 2 + 20, 3 + 30, 1).
  const launch = {
    program: fixture('macro.vsh'),
    set: { v0: [1, 2, 3, 1], c0: [1, 0, 0, 10], c1: [0, 1, 0, 20], c2: [0, 0, 1, 30], c3: [0, 0, 0, 1] },
  };
  await Session.launched(launch, {}, async (session) => {
    assert.equal((await session.stop()).line, 2);
    assert.equal((await session.next()).line, 3);
    assert.deepEqual(await session.register('Outputs', 'oPos'), [11, 22, 33, 1]);
  });
  await Session.launched(launch, {}, async (session) => {
    let { line } = await session.stop();
    let steps = 0;
    while (line === 2) {
      await session.client.stepInRequest(await session.thread());
      ({ line } = await session.stop());
      steps += 1;
      assert.ok(steps <= 8, 'the macro has four rows');
    }
    assert.equal(line, 3);
    assert.ok(steps >= 4, `${steps} steps through four rows`);
    assert.deepEqual(await session.register('Outputs', 'oPos'), [11, 22, 33, 1]);
  });
});

test('a pixel of a scene', options, async () => {
  const launch = { program: fixture('scene.toml'), pixel: [3, 4] };
  await stopped(launch, { 'quad.psh': [{ line: 4 }] }, async (session) => {
    const { reason, line, file } = await session.stop();
    assert.deepEqual([reason, line, file], ['breakpoint', 4, 'quad.psh']);
    // The texel (0.5, 0.25, 1, 1) times the vertex colour (0.5, 0.5, 1, 1), which is the same at each corner. Weights of three corners that
    // add up to 1 but for rounding: a few times 2^-24.
    const near = (actual: number[], expected: number[]) => {
      assert.equal(actual.length, expected.length);
      expected.forEach((value, i) => assert.ok(Math.abs(actual[i]! - value) < 1e-6, `${actual.join(', ')}`));
    };
    near(await session.register('Registers', 'r0'), [0.25, 0.125, 1, 1]);
    near(await session.register('Inputs', 'v0'), [0.5, 0.5, 1, 1]);
    assert.deepEqual(await session.register('Constants', 'c0'), [0.25, 0.25, 0, 0]);
    // What was sampled comes as it is: the filter looks at the one texel.
    assert.deepEqual(await session.evaluate('t0'), [0.5, 0.25, 1, 1]);
    assert.ok((await session.variables(await session.scope('Textures'))).length > 0, 'stage 0 has a texture');
    await session.stepBack();
    assert.equal((await session.frame()).line, 3);
    await session.continue();
    assert.equal((await session.stop()).line, 4);
    await session.continue();
    await session.end();
  });
});

test('a vertex of a scene', options, async () => {
  const launch = { program: fixture('scene.toml'), draw: 'square', vertex: 2 };
  await stopped(launch, { 'quad.vsh': [{ line: 4 }] }, async (session) => {
    const { line, file } = await session.stop();
    assert.deepEqual([line, file], [4, 'quad.vsh']);
    assert.deepEqual(await session.register('Inputs', 'v0'), [1, 1, 0.5, 1]);
    assert.deepEqual(await session.register('Outputs', 'oPos'), [1, 1, 0.5, 1]);
    assert.deepEqual(await session.register('Outputs', 'oD0'), [0.5, 0.5, 1, 1]);
    await session.continue();
    await session.end();
  });
});

test('a launch that cannot be is refused with the reason', options, async () => {
  const launches: [launch: object, reason: RegExp][] = [
    [{ program: fixture('missing.psh') }, /missing\.psh/],
    [{}, /program/],
    // `rl` in line 2 is the first thing that is wrong.
    [{ program: fixture('broken.psh') }, /broken\.psh|\brl\b|error/],
    [{ program: fixture('arithmetic.psh'), set: { q0: [1] } }, /q0/],
    [{ program: fixture('scene.toml'), pixel: [800, 4] }, /800|pixel/],
    [{ program: fixture('scene.toml'), draw: 'circle', vertex: 0 }, /circle/],
    [{ program: fixture('scene.toml'), draw: 'square', vertex: 4000 }, /4000|vertex/],
    [{ program: fixture('arithmetic.psh'), dialect: 'latin' }, /latin/],
  ];
  for (const [launch, reason] of launches) {
    await assert.rejects(Session.launched(launch, {}, async () => undefined), reason, JSON.stringify(launch));
  }
});

/** Runs the adapter on bytes instead of a client; gives its exit status, `null` if it had to be killed. */
function feed(bytes: string): Promise<number | null> {
  return new Promise((resolve, reject) => {
    const adapter = spawn(TEXCRD!, ['dap'], { stdio: ['pipe', 'ignore', 'ignore'] });
    const timer = setTimeout(() => adapter.kill(), 20_000);
    adapter.on('error', reject);
    // Who does not read on does not have to be told more.
    adapter.stdin.on('error', () => undefined);
    adapter.on('exit', (status) => {
      clearTimeout(timer);
      resolve(status);
    });
    adapter.stdin.end(bytes);
  });
}

function message(text: string): string {
  return `Content-Length: ${Buffer.byteLength(text)}\r\n\r\n${text}`;
}

test('the adapter ends with its input, whatever that was', options, async () => {
  const initialize = message('{"seq":1,"type":"request","command":"initialize","arguments":{"adapterID":"texcrd"}}');
  const disconnect = message('{"seq":2,"type":"request","command":"disconnect"}');
  assert.equal(await feed(initialize + disconnect), 0);
  for (const bytes of [
    '',
    initialize,
    'no header at all\r\n\r\n',
    'Content-Length: 99999999999999999999\r\n\r\n{}',
    'Content-Length: 1000\r\n\r\n{"seq":1',
    message('{"seq":1,"type":"request"'),
    message('[]'),
    message('{"seq":1,"type":"request","command":"launch","arguments":{"program":7}}'),
    initialize + message('{"seq":2,"type":"request","command":"stackTrace","arguments":{"threadId":9}}'),
    initialize + message('{"seq":2,"type":"request","command":"dance"}'),
  ]) {
    const status = await feed(bytes);
    assert.notEqual(status, null, `it had to be killed after ${JSON.stringify(bytes)}`);
    // A panic of a Rust program ends with this status.
    assert.notEqual(status, 101, `it panicked on ${JSON.stringify(bytes)}`);
  }
});
