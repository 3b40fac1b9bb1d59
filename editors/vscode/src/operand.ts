/** The operand under the mouse, as an expression that the debugger understands. */

/** An operand in a line: its place, and what to evaluate for it. */
export interface Operand {
  start: number;
  end: number;
  expression: string;
}

/** Registers with what may stand behind them. The modifier is no part of the expression: the register's own value is shown. */
const OPERAND =
  /(?<![\w.])(c\d*\s*\[[^\]]*\]|o(?:Pos|Fog|Pts|D\d|T\d)|a0|[rvtc]\d+)(?:_[a-z]+\d*)?(\.[xyzw]{1,4}|\.[rgba]{1,4})?(?![\w])/gi;

/** The operand that covers this character (counted from 0) of the line, unless it stands in a comment. */
export function operandAt(line: string, character: number): Operand | undefined {
  const code = line.replace(/(?:;|\/\/).*$/, '');
  for (const match of code.matchAll(OPERAND)) {
    const start = match.index;
    const end = start + match[0].length;
    if (start <= character && character < end) {
      return { start, end, expression: match[1] + (match[2] ?? '') };
    }
  }
  return undefined;
}
