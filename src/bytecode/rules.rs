//! The rules of tokens, `K…`, and those of vertex declarations that the rule list of the shader model has.

use crate::diagnostic::{Diagnostic, Rule, Severity, Span};

macro_rules! rules {
    ($($name:ident $id:literal $rule:literal;)*) => {
        $(pub(super) static $name: Rule = Rule { id: $id, rule: $rule };)*

        /// Every rule that tokens, and files of tokens, can break. The numbers are never reused.
        pub static RULES: &[&Rule] = &[$(&$name),*];
    };
}

rules! {
    VERSION "K1" "The first token is the version: 0xFFFE0100, 0xFFFE0101, or 0xFFFF0100 to 0xFFFF0104.";
    CUT "K2" "A shader ends with the token 0x0000FFFF.";
    BEHIND "K3" "Nothing stands behind the end token.";
    OPCODE "K4" "The low half of an instruction token is the number of an instruction of Direct3D 8.";
    STRAY "K5" "An instruction begins with a token whose bit 31 is clear.";
    OPERANDS "K6" "As many operand tokens follow an instruction as it has operands, each with bit 31 set.";
    REGISTER "K7" "An operand names a register file that its kind of shader has, and a register that a listing can name.";
    MASK "K8" "A destination writes at least one component.";
    MODIFIER "K9" "Modifiers are those of the kind of shader: a shift of -3 to 3 and a saturation on a destination of a pixel shader, the codes 0 to 10 on its sources, 0 and 1 on those of a vertex shader.";
    RELATIVE "K10" "Only a constant that a vertex shader reads is addressed relative to a0.x.";
    RESERVED "K11" "Bits without meaning are clear.";
    COMMENT "K12" "A comment is no longer than what is left of the stream.";
    LONG "K13" "A stream has at most 262144 tokens, and 16384 instructions and comments.";
    BYTES "K14" "A binary file is a row of 32-bit words, the lowest byte first.";
    TEXT "K15" "Tokens as text are hexadecimal numbers of eight digits, or numbers and macros of d3d8types.h in an array of a C source.";
    SUBTRACT "K16" "A vertex shader subtracts by adding a negated source.";
    USAGE "K17" "A dcl names a usage from 0 to 13 and an index from 0 to 15.";
    NO_TOKEN "K18" "What is written as tokens has a token.";
    ELEMENT "K19" "A token of a vertex declaration is one of the D3DVSD_ macros with arguments that fit.";
    MANY "K20" "Only the first errors of a stream are shown.";
    UNENDED "D1" "A vertex declaration ends with D3DVSD_END, 0xFFFFFFFF.";
    INPUT "D2" "A vertex shader has the input registers 0 to 15.";
    TWICE "D3" "A vertex declaration loads a register once.";
    CONSTANTS "D4" "D3DVSD_CONST loads 1 to 15 constants, none above the 96 that every device has.";
    FIXED "D5" "Without a vertex shader each register of a declaration keeps its fixed meaning, and D3DVSDE_NORMAL is D3DVSDT_FLOAT3.";
}

/// How many diagnostics a stream gets before the rest is left out.
pub(super) const MOST: usize = 100;

/// The diagnostics of one stream; their spans count tokens.
#[derive(Default)]
pub(super) struct Reports {
    list: Vec<Diagnostic>,
}

impl Reports {
    /// Whether no more are taken.
    pub(super) fn full(&self) -> bool {
        self.list.len() > MOST
    }

    /// Says something of token `at`; `help` may be empty.
    pub(super) fn tell(
        &mut self,
        severity: Severity,
        rule: &'static Rule,
        at: usize,
        message: &str,
        help: &str,
    ) {
        if self.full() {
            return;
        }
        let span = tokens(at, at + 1);
        if self.list.len() == MOST {
            let message = format!("further errors are not shown: there are more than {MOST}");
            self.list.push(Diagnostic::error(&MANY, span, message));
            return;
        }
        let message = format!("token {at} (byte {}): {message}", at as u64 * 4);
        let report = Diagnostic::new(severity, rule, span, message);
        self.list.push(match help {
            "" => report,
            _ => report.with_help(help),
        });
    }

    pub(super) fn error(&mut self, rule: &'static Rule, at: usize, message: &str, help: &str) {
        self.tell(Severity::Error, rule, at, message, help);
    }

    pub(super) fn warning(&mut self, rule: &'static Rule, at: usize, message: &str, help: &str) {
        self.tell(Severity::Warning, rule, at, message, help);
    }

    pub(super) fn finish(self) -> Vec<Diagnostic> {
        self.list
    }
}

/// The span of tokens `from` to before `to`.
pub(super) fn tokens(from: usize, to: usize) -> Span {
    Span::new(from as u32, to as u32)
}
