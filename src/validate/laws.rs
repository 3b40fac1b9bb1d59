//! The rules and how severe a breach of each is: the one table of severities.

use crate::diagnostic::{Diagnostic, Rule, Severity, Span};
use crate::policy::Dialect;

/// A rule, or a case of one that is judged more mildly than the rest.
///
/// The names are the identifiers that people see; a case has a word behind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each member is the identifier of its row")]
pub(super) enum Code {
    B1,
    B2,
    B3,
    B4,
    B5,
    B6,
    B7,
    B8,
    B9,
    B10,
    S2,
    S3,
    S4,
    S5,
    S6,
    S6Component,
    S7,
    S8,
    S9,
    S10,
    S14,
    O1,
    O2,
    O3,
    O4,
    O5,
    O5Unwritten,
    O6,
    O8,
    O8Written,
    O9,
    O10,
    O11,
    O11Phase,
    O12,
    O12NoMask,
    O13,
    O14,
    O14Register,
    O15,
    O16,
    O17,
    O18,
    O19,
    O19Mask,
    O20,
    O21,
    O22,
    O23,
    O25,
    O26,
    O26Beyond,
    M1,
    M1Divide,
    M2,
    M3,
    M5,
    M6,
    M7,
    M8,
    M9,
    M10,
    M11,
    M11Phases,
    M12,
    M12Arithmetic,
    M13,
    R1,
    R2,
    R4,
    R6,
    R7,
    R11,
    T1,
    T1Kill,
    T3,
    T4,
    T5,
    T6,
    T7,
    T8,
    T9,
    T10,
    T11,
    T12,
    T13,
    I1,
    I1Vertex,
    I2,
    I3,
    I4,
    I5,
    C1,
    C2,
    C3,
    C4,
    C5,
    C6,
    C7,
}

/// Severity in each dialect, in the order of [`Dialect`]; `None`: nothing is said.
type Severities = [Option<Severity>; 3];

const E: Option<Severity> = Some(Severity::Error);
const W: Option<Severity> = Some(Severity::Warning);

/// Has no meaning that could be run.
const REFUSED: Severities = [E, E, E];
/// Both runtimes refuse it; what it would do is clear all the same.
const MEANT: Severities = [E, E, W];
/// Direct3D 8 took it against its own documents; Direct3D 9 refuses it.
const LATER: Severities = [W, E, W];
/// Against the documents; no runtime is known to refuse it.
const ADVICE: Severities = [W, W, W];
/// Only Direct3D 9 has the rule.
const STRICT: Severities = [None, E, None];

/// One row of the table.
struct Law {
    #[cfg_attr(not(test), allow(dead_code, reason = "names the row; a test reads it"))]
    code: Code,
    rule: Rule,
    severity: Severities,
    /// The code itself, or for a case the rule that it is a case of.
    of: Code,
}

const fn law(code: Code, id: &'static str, rule: &'static str, severity: Severities) -> Law {
    Law {
        code,
        rule: Rule { id, rule },
        severity,
        of: code,
    }
}

const fn case(code: Code, of: Code, severity: Severities) -> Law {
    Law {
        code,
        rule: Rule { id: "", rule: "" },
        severity,
        of,
    }
}

/// One row a code, in the order of [`Code`].
///
/// Not here, because no program can break them alone: what the text or the tokens already fix (S1, S11 to S13, O24,
/// M4, D1 to D5), what another rule says (O7 by O2, B11 by B2 to B5, T2 by T1, C8 by R11), what the number of
/// operands or registers rules out (R3, R5, R8, R9, R10), and what is allowed or only known beside the shader (I6, I7).
#[rustfmt::skip]
static LAWS: [Law; 99] = [
    law(Code::B1, "B1", "A vertex shader has at most 128 instruction slots, macros counted as they expand.", MEANT),
    law(Code::B2, "B2", "ps.1.0 to ps.1.3 take at most 4 texture instructions.", MEANT),
    law(Code::B3, "B3", "ps.1.0 to ps.1.3 take at most 8 arithmetic slots; a pair counts once.", MEANT),
    law(Code::B4, "B4", "ps.1.4 takes at most 6 texture instructions in a phase.", MEANT),
    law(Code::B5, "B5", "ps.1.4 takes at most 8 arithmetic slots in a phase; a pair counts once.", MEANT),
    law(Code::B6, "B6", "ps.1.2 and ps.1.3 take at most 4 dp4.", MEANT),
    law(Code::B7, "B7", "ps.1.2 and ps.1.3 take at most 3 cmp.", MEANT),
    law(Code::B8, "B8", "ps.1.4 takes at most 1 bem.", MEANT),
    law(Code::B9, "B9", "ps.1.4 takes _dz (_db) at most twice.", MEANT),
    law(Code::B10, "B10", "ps.1.4 takes at most 1 phase instruction.", MEANT),
    law(Code::S2, "S2", "def stands before the first arithmetic or texture instruction.", LATER),
    law(Code::S3, "S3", "In ps.1.0 to ps.1.3 texture instructions stand before arithmetic instructions.", MEANT),
    law(Code::S4, "S4", "In each phase of ps.1.4 texture instructions stand before arithmetic instructions.", MEANT),
    law(Code::S5, "S5", "Only ps.1.4 has phase.", REFUSED),
    law(Code::S6, "S6", "A pixel shader writes r0, its result.", MEANT),
    case(Code::S6Component, Code::S6, ADVICE),
    law(Code::S7, "S7", "After phase the alpha of r0 is written again.", ADVICE),
    law(Code::S8, "S8", "A vertex shader writes oPos.", MEANT),
    law(Code::S9, "S9", "A vertex shader writes all four components of oPos.", LATER),
    law(Code::S10, "S10", "oT# are written without gaps: oT1 only with oT0, y only with x.", STRICT),
    law(Code::S14, "S14", "An instruction exists in the version of the shader.", REFUSED),
    law(Code::O1, "O1", "A register exists in the version of the shader.", REFUSED),
    law(Code::O2, "O2", "A destination is a register that can be written.", REFUSED),
    law(Code::O3, "O3", "The outputs and a0 of a vertex shader cannot be read as sources.", REFUSED),
    law(Code::O4, "O4", "vs.1.0 has no address register and no relative addressing.", MEANT),
    law(Code::O5, "O5", "a0 is written by mov a0.x alone, before it is used.", REFUSED),
    case(Code::O5Unwritten, Code::O5, MEANT),
    law(Code::O6, "O6", "Only c# as a source is addressed relative to a0.x.", REFUSED),
    law(Code::O8, "O8", "Arithmetic of ps.1.4 does not name t#.", MEANT),
    case(Code::O8Written, Code::O8, REFUSED),
    law(Code::O9, "O9", "ps.1.4 reads v# only after phase.", MEANT),
    law(Code::O10, "O10", "Texture instructions of ps.1.0 to ps.1.3 name t#; the last operand of texm3x3spec is c#.", REFUSED),
    law(Code::O11, "O11", "texld writes r# and reads t#, after phase also r#; texkill of ps.1.4 names t# or r#.", REFUSED),
    case(Code::O11Phase, Code::O11, MEANT),
    law(Code::O12, "O12", "texcrd writes r#.rgb from t# (r#.rg from t#_dw.xyw).", REFUSED),
    case(Code::O12NoMask, Code::O12, ADVICE),
    law(Code::O13, "O13", "Of the texture instructions only texm3x3spec reads a constant.", REFUSED),
    law(Code::O14, "O14", "texdepth takes r5, after phase.", MEANT),
    case(Code::O14Register, Code::O14, REFUSED),
    law(Code::O15, "O15", "The first source of cnd is r0.a in ps.1.0 to ps.1.3.", MEANT),
    law(Code::O16, "O16", "cnd writes .rgba, .rgb or .a in ps.1.0 to ps.1.3.", MEANT),
    law(Code::O17, "O17", "cmp writes a register that it does not read in ps.1.2 and ps.1.3.", MEANT),
    law(Code::O18, "O18", "bem writes .rg and stands before phase.", MEANT),
    law(Code::O19, "O19", "A matrix macro takes its matrix plain and writes one component a row.", MEANT),
    case(Code::O19Mask, Code::O19, ADVICE),
    law(Code::O20, "O20", "A matrix macro does not write a register that it reads.", LATER),
    law(Code::O21, "O21", "rcp, rsq, exp, expp, log and logp read one component, named by one letter.", LATER),
    law(Code::O22, "O22", "frc writes .y or .xy.", LATER),
    law(Code::O23, "O23", "Vertex shaders know no modifier but the minus sign.", MEANT),
    law(Code::O25, "O25", "def names a constant register of the version.", REFUSED),
    law(Code::O26, "O26", "A vertex shader counts on 96 constants, c0 to c95.", MEANT),
    case(Code::O26Beyond, Code::O26, REFUSED),
    law(Code::M1, "M1", "A modifier exists in the version of the shader.", MEANT),
    case(Code::M1Divide, Code::M1, REFUSED),
    law(Code::M2, "M2", "Only arithmetic instructions take _x2, _x4, _x8, _d2, _d4, _d8 and _sat.", MEANT),
    law(Code::M3, "M3", "Texture instructions take only the source modifiers that are theirs.", MEANT),
    law(Code::M5, "M5", "Constants take no modifier in ps.1.4.", MEANT),
    law(Code::M6, "M6", "What a modifier does to a constant is not defined in ps.1.0 to ps.1.3.", LATER),
    law(Code::M7, "M7", "ps.1.0 to ps.1.3 write .rgba, .rgb or .a.", MEANT),
    law(Code::M8, "M8", "dp3 writes .rgba or .rgb in ps.1.0 to ps.1.3.", MEANT),
    law(Code::M9, "M9", "Sources of ps.1.0 to ps.1.3 select .a, and from ps.1.1 on .b for a result in .a.", MEANT),
    law(Code::M10, "M10", "Sources of ps.1.4 select one component; texture coordinates select .xyz or .xyw.", MEANT),
    law(Code::M11, "M11", "ps.1.4 reads each t# as .xyz or as .xyw, not both.", MEANT),
    case(Code::M11Phases, Code::M11, ADVICE),
    law(Code::M12, "M12", "_dz divides r# in texld; _dw divides t#, with .xyw.", MEANT),
    case(Code::M12Arithmetic, Code::M12, REFUSED),
    law(Code::M13, "M13", "Texture instructions take no write mask, texcrd apart.", MEANT),
    law(Code::R1, "R1", "An instruction of a vertex shader reads one c#.", MEANT),
    law(Code::R2, "R2", "An instruction of a vertex shader reads one v#.", MEANT),
    law(Code::R4, "R4", "An instruction of a pixel shader reads two c#.", MEANT),
    law(Code::R6, "R6", "An instruction of ps.1.0 reads one t# and one v#.", MEANT),
    law(Code::R7, "R7", "An instruction of ps.1.1 reads two t#.", MEANT),
    law(Code::R11, "R11", "A pair reads at most three registers of a file.", MEANT),
    law(Code::T1, "T1", "Texture instructions of ps.1.0 to ps.1.3 stand in the order of their stages, one a stage.", MEANT),
    case(Code::T1Kill, Code::T1, ADVICE),
    law(Code::T3, "T3", "A texture instruction reads a t# of a lower number that was written before.", MEANT),
    law(Code::T4, "T4", "texm3x2pad t(m) is followed by texm3x2tex or texm3x2depth t(m+1).", REFUSED),
    law(Code::T5, "T5", "texm3x3pad t(m) is followed by texm3x3pad t(m+1) and the instruction for the third row at t(m+2).", REFUSED),
    law(Code::T6, "T6", "All rows of a matrix read the same t#.", ADVICE),
    law(Code::T7, "T7", "No pad stays open at the end of the texture instructions.", REFUSED),
    law(Code::T8, "T8", "What a pad leaves in its t# cannot be read.", MEANT),
    law(Code::T9, "T9", "A t# that texbem or texbeml has read is read by nothing else later.", MEANT),
    law(Code::T10, "T10", "After texm3x2depth its t# cannot be read.", MEANT),
    law(Code::T11, "T11", "After texkill its t# holds nothing defined.", ADVICE),
    law(Code::T12, "T12", "How long a chain of dependent texture reads may be depends on the hardware.", ADVICE),
    law(Code::T13, "T13", "texld reads an r# whose xyz was written before phase.", MEANT),
    law(Code::I1, "I1", "A component of r# is written before it is read.", MEANT),
    case(Code::I1Vertex, Code::I1, LATER),
    law(Code::I2, "I2", "phase loses the alpha of every r#.", MEANT),
    law(Code::I3, "I3", "texcrd leaves the components undefined that it does not write.", MEANT),
    law(Code::I4, "I4", "Arithmetic reads a t# that a texture instruction has written.", MEANT),
    law(Code::I5, "I5", "After texdepth r5 cannot be read.", MEANT),
    law(Code::C1, "C1", "Vertex shaders have no pairs.", REFUSED),
    law(Code::C2, "C2", "+ joins an arithmetic instruction to the single arithmetic instruction before it.", REFUSED),
    law(Code::C3, "C3", "Of a pair in ps.1.0 to ps.1.3 one writes .rgb and the other .a.", MEANT),
    law(Code::C4, "C4", "Of a pair in ps.1.4 one writes of r, g and b, the other .a.", MEANT),
    law(Code::C5, "C5", "Both halves of a pair in ps.1.0 write the same register.", MEANT),
    law(Code::C6, "C6", "dp4 and bem stand alone; in a pair dp3 writes colour.", MEANT),
    law(Code::C7, "C7", "Only arithmetic instructions form pairs.", REFUSED),
];

const RULE_COUNT: usize = {
    let (mut count, mut i) = (0, 0);
    while i < LAWS.len() {
        if LAWS[i].of as usize == i {
            count += 1;
        }
        i += 1;
    }
    count
};

static RULE_LIST: [&Rule; RULE_COUNT] = {
    let mut list = [&LAWS[0].rule; RULE_COUNT];
    let (mut count, mut i) = (0, 0);
    while i < LAWS.len() {
        if LAWS[i].of as usize == i {
            list[count] = &LAWS[i].rule;
            count += 1;
        }
        i += 1;
    }
    list
};

/// Every rule that a program can break, in the order of the identifiers' groups.
pub static RULES: &[&Rule] = &RULE_LIST;

impl Code {
    fn law(self) -> &'static Law {
        &LAWS[self as usize]
    }

    /// The rule that is broken.
    pub(super) fn rule(self) -> &'static Rule {
        &self.law().of.law().rule
    }

    /// How severe the breach is; `None` if the dialect does not have the rule.
    pub(super) fn severity(self, dialect: Dialect) -> Option<Severity> {
        self.law().severity[dialect as usize]
    }
}

/// Why a breach that Direct3D 8 let pass is an error.
const ONLY_LATER: &str = "Direct3D 8 accepted it; Direct3D 9 refuses it";

/// How many breaches of a rule are told of one program.
const MOST_OF_A_RULE: u32 = 100;

/// What was found so far.
pub(super) struct Report {
    dialect: Dialect,
    diagnostics: Vec<Diagnostic>,
    counts: [u32; LAWS.len()],
}

impl Report {
    pub(super) fn new(dialect: Dialect) -> Self {
        Self {
            dialect,
            diagnostics: Vec::new(),
            counts: [0; LAWS.len()],
        }
    }

    /// Adds a breach, as severe as the dialect has it.
    pub(super) fn breach(
        &mut self,
        code: Code,
        span: Span,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        let Some(severity) = code.severity(self.dialect) else {
            return;
        };
        let count = &mut self.counts[code.law().of as usize];
        *count = count.saturating_add(1);
        if *count > MOST_OF_A_RULE {
            return;
        }
        let mut help = help.into();
        let was_let_pass = code.severity(Dialect::D3d8) != Some(Severity::Error);
        if self.dialect == Dialect::D3d9 && severity == Severity::Error && was_let_pass {
            help = format!("{help} ({ONLY_LATER})");
        }
        let found = Diagnostic::new(severity, code.rule(), span, message);
        self.diagnostics.push(found.with_help(help));
    }

    /// Everything that was found, by position.
    pub(super) fn finish(mut self) -> Vec<Diagnostic> {
        self.diagnostics.sort_by_key(|d| (d.span, d.rule.id));
        self.diagnostics
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_stand_in_order_and_have_one_identifier_each() {
        for (i, law) in LAWS.iter().enumerate() {
            assert_eq!(law.code as usize, i);
            let id = law.code.rule().id;
            // The name of a case begins with the identifier of its rule.
            assert!(format!("{:?}", law.code).starts_with(id) && !id.is_empty());
            assert!(law.code.rule().rule.ends_with('.'));
        }
        for (i, rule) in RULES.iter().enumerate() {
            assert!(RULES[i + 1..].iter().all(|other| other.id != rule.id));
        }
    }

    #[test]
    fn a_lenient_reader_refuses_nothing_that_a_strict_one_takes() {
        for law in &LAWS {
            let [first, later, lenient] = law.severity;
            assert!(lenient <= first, "{:?}", law.code);
            assert!(first <= later, "{:?}", law.code);
        }
    }
}
