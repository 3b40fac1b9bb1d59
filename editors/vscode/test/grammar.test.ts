/** The scopes of lines in which something is easily taken for something else. What is expected was worked out by hand. */

import assert from 'node:assert/strict';
import * as fs from 'node:fs';
import * as path from 'node:path';
import { test } from 'node:test';
import { REPOSITORY } from './surroundings';
import { tokenize, tokenizeLine, type Token } from './tokens';

const ARITHMETIC = 'keyword.mnemonic.arithmetic';
const TEXTURE = 'keyword.mnemonic.texture';
const DECLARATION = 'keyword.mnemonic.declaration';
const TEMPORARY = 'variable.other.temporary.register';
const CONSTANT = 'variable.other.constant.register';
const INPUT = 'variable.parameter.input.register';
const OUTPUT = 'variable.language.output.register';
const ADDRESS = 'variable.language.address.register';
const RESULT = 'storage.modifier.result';
const SOURCE = 'storage.modifier.source';
const NUMBER = 'constant.numeric';
const DIRECTIVE = 'keyword.control.directive';
const MACRO = 'entity.name.function.preprocessor';
const OPEN = 'punctuation.section.brackets.begin';
const CLOSE = 'punctuation.section.brackets.end';
const COMMA: Token = [',', 'punctuation.separator.operand'];
const PLUS: Token = ['+', 'keyword.operator.arithmetic'];
const PAIR: Token = ['+', 'keyword.operator.coissue'];
const NEGATE: Token = ['-', 'keyword.operator.negate'];
const VERSION = 'storage.type.version';
const SEMICOLON: Token = [';', 'punctuation.definition.comment'];

function components(letters: string): Token[] {
  return [
    ['.', 'punctuation.accessor'],
    [letters, 'variable.other.member.components'],
  ];
}

const LINES: [line: string, tokens: Token[]][] = [
  ['ps.1.4', [['ps.1.4', VERSION]]],
  ['vs_1_1 // Direct3D 9', [['vs_1_1', VERSION], ['//', 'punctuation.definition.comment'], ['Direct3D 9', 'comment.line.double-slash']]],
  ['PS.1.0', [['PS.1.0', VERSION]]],
  ['vs.1.2', [['vs.1.2', 'invalid.illegal.version']]],
  ['vs_1.1', [['vs_1.1', 'invalid.illegal.version']]],
  ['ps_2_0', [['ps_2_0', 'invalid.illegal.version']]],
  ['xvs.1.0', [['xvs.1.0', 'invalid.illegal.version']]],

  // `x2` is a modifier behind an underscore only.
  [
    'mul_x2_sat r0.rgb, t0_bx2, 1-r1.a',
    [
      ['mul', ARITHMETIC], ['_x2_sat', RESULT], ['r0', TEMPORARY], ...components('rgb'), COMMA,
      ['t0', INPUT], ['_bx2', SOURCE], COMMA,
      ['1-', 'keyword.operator.complement'], ['r1', TEMPORARY], ...components('a'),
    ],
  ],
  ['texm3x2pad t1, t0_bx2', [['texm3x2pad', TEXTURE], ['t1', INPUT], COMMA, ['t0', INPUT], ['_bx2', SOURCE]]],
  ['m3x2 r0.xy, v0, c4', [['m3x2', ARITHMETIC], ['r0', TEMPORARY], ...components('xy'), COMMA, ['v0', INPUT], COMMA, ['c4', CONSTANT]]],
  ['texbeml t1, t0', [['texbeml', TEXTURE], ['t1', INPUT], COMMA, ['t0', INPUT]]],
  ['mul_d8 r0, -r1_x2.r, r2', [
    ['mul', ARITHMETIC], ['_d8', RESULT], ['r0', TEMPORARY], COMMA,
    NEGATE, ['r1', TEMPORARY], ['_x2', SOURCE], ...components('r'), COMMA, ['r2', TEMPORARY],
  ]],
  // A modifier that no version has leaves the mnemonic plain: it stands out.
  ['mul_pp r0, r0, r1', [['mul_pp', ''], ['r0', TEMPORARY], COMMA, ['r0', TEMPORARY], COMMA, ['r1', TEMPORARY]]],
  // What scanners read: `rl` for `r1`, `1rp` for `lrp`.
  ['1rp rl', [['1rp rl', '']]],
  ['texld r5, r2_dz.xyz', [['texld', TEXTURE], ['r5', TEMPORARY], COMMA, ['r2', TEMPORARY], ['_dz', SOURCE], ...components('xyz')]],
  // The components before the modifier are read, too.
  ['mov r0, t0.a_bx2', [['mov', ARITHMETIC], ['r0', TEMPORARY], COMMA, ['t0', INPUT], ...components('a'), ['_bx2', SOURCE]]],
  ['mov r0.xg, r1', [['mov', ARITHMETIC], ['r0', TEMPORARY], ['.xg', ''], COMMA, ['r1', TEMPORARY]]],

  // Three meanings of `+`.
  ['+mov r0.a, t1', [PAIR, ['mov', ARITHMETIC], ['r0', TEMPORARY], ...components('a'), COMMA, ['t1', INPUT]]],
  ['mul r0.rgb, t0, c3 +', [
    ['mul', ARITHMETIC], ['r0', TEMPORARY], ...components('rgb'), COMMA, ['t0', INPUT], COMMA, ['c3', CONSTANT], PAIR,
  ]],
  ['def c0, +1.0, -.5, 5., 1.0e+05f', [
    ['def', DECLARATION], ['c0', CONSTANT], COMMA, ['+1.0', NUMBER], COMMA, ['-.5', NUMBER], COMMA, ['5.', NUMBER], COMMA, ['1.0e+05f', NUMBER],
  ]],

  // Relative addressing.
  ['m4x3 r0.xyz, v0, c[a0.x + 3]', [
    ['m4x3', ARITHMETIC], ['r0', TEMPORARY], ...components('xyz'), COMMA, ['v0', INPUT], COMMA,
    ['c', CONSTANT], ['[', OPEN], ['a0', ADDRESS], ...components('x'), PLUS, ['3', NUMBER], [']', CLOSE],
  ]],
  ['mov r1, -c12[3 + a0.x].wzyx', [
    ['mov', ARITHMETIC], ['r1', TEMPORARY], COMMA, NEGATE,
    ['c12', CONSTANT], ['[', OPEN], ['3', NUMBER], PLUS, ['a0', ADDRESS], ...components('x'), [']', CLOSE], ...components('wzyx'),
  ]],
  ['mov oPos, c[CV_WORLD_0]', [
    ['mov', ARITHMETIC], ['oPos', OUTPUT], COMMA, ['c', CONSTANT], ['[', OPEN], ['CV_WORLD_0', ''], [']', CLOSE],
  ]],
  ['MOV OT7.XY, V15', [['MOV', ARITHMETIC], ['OT7', OUTPUT], ...components('XY'), COMMA, ['V15', INPUT]]],

  ['dcl_texcoord12 v7', [
    ['dcl', DECLARATION], ['_', 'punctuation.separator.usage'], ['texcoord', 'support.constant.usage'], ['12', 'constant.numeric.usage-index'], ['v7', INPUT],
  ]],
  ['phase ; the second', [['phase', 'keyword.mnemonic.phase'], SEMICOLON, ['the second', 'comment.line.semicolon']]],
  // Nothing begins inside a comment.
  ['; "mov" r0 /* #define', [SEMICOLON, ['"mov" r0 /* #define', 'comment.line.semicolon']]],
  ['mov/**/r0,r1', [
    ['mov', ARITHMETIC], ['/*', 'punctuation.definition.comment'], ['*/', 'punctuation.definition.comment'],
    ['r0', TEMPORARY], COMMA, ['r1', TEMPORARY],
  ]],

  ['#include "constants.h"', [['#include', DIRECTIVE], ['"constants.h"', 'string.quoted.include']]],
  [' #  define LIGHT -c8.w', [['#  define', DIRECTIVE], ['LIGHT', MACRO], NEGATE, ['c8', CONSTANT], ...components('w')]],
  ['#define ROW(n) c[n + 4]', [
    ['#define', DIRECTIVE], ['ROW', MACRO], ['(', 'punctuation.definition.parameters.begin'], ['n', 'variable.parameter.preprocessor'],
    [')', 'punctuation.definition.parameters.end'], ['c', CONSTANT], ['[', OPEN], ['n', ''], PLUS, ['4', NUMBER], [']', CLOSE],
  ]],
  ['TEX_NORMALMAP_bx2.a', [['TEX_NORMALMAP', ''], ['_bx2', SOURCE], ...components('a')]],
  ['#if defined(FOG) && COUNT >= 2', [
    ['#if', DIRECTIVE], ['defined', 'keyword.operator.defined'], ['(', ''], ['FOG', MACRO], [')', ''],
    ['&&', 'keyword.operator'], ['COUNT', MACRO], ['>=', 'keyword.operator'], ['2', NUMBER],
  ]],
];

for (const [line, expected] of LINES) {
  test(`tokens of ${JSON.stringify(line)}`, async () => {
    assert.deepEqual(await tokenizeLine(line), expected);
  });
}

test('a block comment goes on over lines', async () => {
  const [first, second, third] = await tokenize('nop /* mov\nmov r0, r1\n*/ mov');
  assert.deepEqual(first!.at(-1), ['mov', 'comment.block']);
  assert.deepEqual(second, [['mov r0, r1', 'comment.block']]);
  assert.deepEqual(third!.at(-1), ['mov', ARITHMETIC]);
});

test('a #define goes on behind a backslash, and ends without one', async () => {
  const [first, second, third] = await tokenize('#define TWICE mul r0, r0, c0 \\\nadd r0, r0, r0\nmov TWICE');
  assert.deepEqual(first!.at(-1), ['\\', 'constant.character.escape.line-continuation']);
  assert.deepEqual(second![0], ['add', ARITHMETIC]);
  assert.deepEqual(third, [['mov', ARITHMETIC], ['TWICE', '']]);
});

test('an open bracket ends with its line', async () => {
  const [, second] = await tokenize('mov r0, c[a0.x\nmov r1, r2');
  assert.deepEqual(second!.slice(0, 2), [['mov', ARITHMETIC], ['r1', TEMPORARY]]);
});

test('of the listings that come with texcrd only commas, blanks and comments have a scope that says nothing', async () => {
  const folder = path.join(REPOSITORY, 'asm', 'stained_glass');
  const listings = fs.readdirSync(folder).filter((name) => /\.[vp]sh$/.test(name));
  assert.ok(listings.length >= 4);
  for (const name of listings) {
    const lines = await tokenize(fs.readFileSync(path.join(folder, name), 'latin1').replaceAll('\r', ''));
    lines.forEach((tokens, i) => {
      const plain = tokens.filter(([, scope]) => scope === '' || scope.startsWith('invalid'));
      assert.deepEqual(plain, [], `${name}:${i + 1}`);
    });
  }
});
