//! The rules of the shader model, `B…` to `D…`: one row a rule, with its milder cases.
//!
//! The identifiers and what they demand are those of the project's rule list; the severities follow from what its
//! authorities say of the two runtimes. A rule that nothing can break alone has a row all the same: its note says why,
//! and which rule speaks instead.

use super::severity::{ADVICE, LATER, MEANT, REFUSED, SILENT, STRICT, STRICT_ADVICE, Severities};
use super::{Case, Entry};
use crate::diagnostic::{Rule, Severity};
use crate::policy::Dialect;

/// A rule, or a case of one that is judged otherwise than the rest, under the name that the program has for it.
struct Row {
    of: Code,
    rule: &'static Rule,
    severities: Severities,
}

/// Makes, of the rows: the names, the rules, and the tables that both are looked up in.
macro_rules! model {
    ($($id:ident $severities:ident $rule:literal
        $(breaks $breaks:literal)?
        $(keeps $keeps:literal)?
        $(note $note:literal)?
        $(case $case:ident $of_case:ident $when:literal breaks $example:literal)*;)*
    ) => {
        /// A rule, or a case of one that is judged otherwise than the rest.
        ///
        /// The names are the identifiers that people see; a case has a word behind it.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub(crate) enum Code { $($id, $($case,)*)* }

        $(pub(crate) static $id: Rule = Rule { id: stringify!($id), rule: $rule };)*

        /// One row a code, in their order.
        static ROWS: &[Row] = &[$(
            Row { of: Code::$id, rule: &$id, severities: $severities },
            $(Row { of: Code::$id, rule: &$id, severities: $of_case },)*
        )*];

        /// One entry a rule.
        pub(super) static ENTRIES: &[Entry] = &[$(Entry {
            rule: &$id,
            severities: $severities,
            breaks: concat!($($breaks)?),
            keeps: concat!($($keeps)?),
            note: concat!($($note)?),
            cases: &[$(Case { when: $when, severities: $of_case, breaks: $example }),*],
        }),*];
    };
}

impl Code {
    /// How many there are.
    pub(crate) const COUNT: usize = ROWS.len();

    fn row(self) -> &'static Row {
        &ROWS[self as usize]
    }

    /// The rule itself, or that of which this is a case.
    pub(crate) fn of(self) -> Code {
        self.row().of
    }

    /// The rule that is broken.
    pub(crate) fn rule(self) -> &'static Rule {
        self.row().rule
    }

    /// What else is to be known of the rule, in sentences.
    pub(crate) fn note(self) -> &'static str {
        let own = ENTRIES
            .iter()
            .find(|entry| std::ptr::eq(entry.rule, self.rule()));
        own.map_or("", |entry| entry.note)
    }

    /// How severe the breach is; `None` if the dialect does not have the rule.
    pub(crate) fn severity(self, dialect: Dialect) -> Option<Severity> {
        self.row().severities.of(dialect)
    }
}

model! {
    B1 MEANT "A vertex shader has at most 128 instruction slots, macros counted as they expand."
        breaks "vs.1.1 | m4x4 oPos, v0, c0 | mov r0, v0 *124 | {mov} r1, v0"
        keeps "vs.1.1 | m4x4 oPos, v0, c0 | mov r0, v0 *124";
    B2 MEANT "ps.1.0 to ps.1.3 take at most 4 texture instructions."
        breaks "ps.1.1 | tex t0 | tex t1 | tex t2 | tex t3 | {tex} t3 | mov r0, t0"
        keeps "ps.1.1 | tex t0 | tex t1 | tex t2 | tex t3 | mov r0, t0";
    B3 MEANT "ps.1.0 to ps.1.3 take at most 8 arithmetic slots; a pair counts once."
        breaks "ps.1.1 | mul r0, v0, v0 *8 | {mul} r0, v0, v0"
        keeps "ps.1.1 | mul r0, v0, v0 *7 | mul r0.rgb, v0, v0 | +mov r0.a, v0";
    B4 MEANT "ps.1.4 takes at most 6 texture instructions in a phase."
        breaks "ps.1.4 | texld r0, t0 *6 | {texld} r0, t0"
        keeps "ps.1.4 | texld r0, t0 *6 | phase | texld r0, t0 *6";
    B5 MEANT "ps.1.4 takes at most 8 arithmetic slots in a phase; a pair counts once."
        breaks "ps.1.4 | mul r0, c0, c0 *8 | {mul} r0, c0, c0"
        keeps "ps.1.4 | mul r0, c0, c0 *8 | phase | mul r0, c0, c0 *8";
    B6 MEANT "ps.1.2 and ps.1.3 take at most 4 dp4."
        breaks "ps.1.2 | dp4 r0, c0, c1 *4 | {dp4} r0, c0, c1"
        keeps "ps.1.2 | dp4 r0, c0, c1 *4";
    B7 MEANT "ps.1.2 and ps.1.3 take at most 3 cmp."
        breaks "ps.1.3 | cmp r0, c0, c1, c1 *3 | {cmp} r0, c0, c1, c1"
        keeps "ps.1.3 | cmp r0, c0, c1, c1 *3";
    B8 MEANT "ps.1.4 takes at most 1 bem."
        breaks "ps.1.4 | bem r0.rg, c0, c1 | {bem} r1.rg, c0, c1 | phase | mov r0, c0"
        keeps "ps.1.4 | bem r0.rg, c0, c1 | phase | mov r0, c0";
    B9 MEANT "ps.1.4 takes _dz (_db) at most twice."
        breaks "ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, r0_dz *2 | texld r3, {r0_dz} | mov r0, r3"
        keeps "ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, r0_dz *2 | texld r3, r0 | mov r0, r3";
    B10 MEANT "ps.1.4 takes at most 1 phase instruction."
        breaks "ps.1.4 | phase | {phase} | mov r0, c0"
        keeps "ps.1.4 | phase | mov r0, c0";
    B11 SILENT "A pixel shader takes at most 12 slots, in ps.1.4 28."
        note "B2 to B5 say so: the number is the sum of theirs, so that none of them can be kept and this one broken.";
    S1 REFUSED "A listing holds one shader, which begins with its version instruction; only comments and blank lines may stand before it."
        breaks "{mov} r0, v0 | ps.1.1 | mov r0, v0"
        keeps "ps.1.1 | mov r0, v0";
    S2 LATER "def and dcl_ stand before the first arithmetic or texture instruction."
        breaks "ps.1.1 | tex t0 | {def c0, 0, 0, 0, 0} | def c1, 0, 0, 0, 0 | mul r0, t0, c0"
        keeps "ps.1.1 | def c0, 0, 0, 0, 0 | tex t0 | mul r0, t0, c0"
        note "Direct3D 8 took a def anywhere and declared inputs beside the shader; Direct3D 9 wants def and dcl_ in front of all instructions.";
    S3 MEANT "In ps.1.0 to ps.1.3 texture instructions stand before arithmetic instructions."
        breaks "ps.1.1 | mov r0, v0 | {tex} t0 | tex t1 | mov r0, t0"
        keeps "ps.1.1 | nop | tex t0 | tex t1 | mov r0, t0";
    S4 MEANT "In each phase of ps.1.4 texture instructions stand before arithmetic instructions."
        breaks "ps.1.4 | mov r0, c0 | {texld} r1, t0"
        keeps "ps.1.4 | mov r0, c0 | phase | texld r0, t0";
    S5 REFUSED "Only ps.1.4 has phase."
        breaks "ps.1.3 | {phase} | mov r0, v0"
        keeps "ps.1.4 | phase | mov r0, v0";
    S6 MEANT "A pixel shader writes r0, its result."
        breaks "{ps.1.1} | mov r1, v0"
        keeps "ps.1.1 | mov r0.rgb, v0 | +mov r0.a, v0"
        case S6Component ADVICE "only some of its components"
            breaks "{ps.1.1} | mov r0.rgb, v0";
    S7 ADVICE "After phase the alpha of r0 is written again."
        breaks "{ps.1.4} | texld r0, t0 | phase | mov r0.rgb, c0"
        keeps "ps.1.4 | texld r0, t0 | phase | mov r0.a, c0";
    S8 MEANT "A vertex shader writes oPos."
        breaks "{vs.1.1} | mov oD0, v0"
        keeps "vs.1.1 | mov oPos, v0";
    S9 LATER "A vertex shader writes all four components of oPos."
        breaks "vs.1.1 | mov {oPos.xyz}, v0"
        keeps "vs.1.1 | mov oPos.xyz, v0 | mov oPos.w, c0"
        note "Direct3D 8 let components be missing; Direct3D 9 wants the whole position.";
    S10 STRICT "oT# are written without gaps: oT1 only with oT0, y only with x."
        breaks "vs.1.1 | mov oPos, v0 | mov {oT1}, v7"
        keeps "vs.1.1 | mov oPos, v0 | mov oT0.y, v7 | mov oT0.x, v7 | mov oT1, v7"
        note "Direct3D 8 has no such rule; Direct3D 9 checks which components of each oT# are written and refuses gaps.";
    S11 STRICT "A vertex shader declares the inputs that it reads."
        breaks "vs.1.1 | mov oPos, {v0}"
        keeps "vs.1.1 | dcl_position v0 | dcl_color v5 | mov oPos, v0 | mov oD0, v5"
        note "Direct3D 8 takes the inputs from an array of D3DVSD_ tokens beside the shader; Direct3D 9 has them declared by dcl_ in the shader."
        case S11Partly LATER "where it declares others"
            breaks "vs.1.1 | dcl_position v0 | mov oPos, v0 | mov oD0, {v5}";
    S12 REFUSED "A shader in tokens ends with the token 0x0000FFFF."
        breaks "FFFF0101 | 00000001 800F0000 90E40000"
        keeps "FFFF0101 | 00000001 800F0000 90E40000 | 0000FFFF"
        note "What stands behind that token is not read; K3 says so.";
    S13 REFUSED "The first token is the version: 0xFFFE0100, 0xFFFE0101, or 0xFFFF0100 to 0xFFFF0104."
        breaks "FFFE0102 | 0000FFFF"
        keeps "FFFE0101 | 00000001 C00F0000 90E40000 | 0000FFFF"
        note "The versions of listings are those of P3. The documents of Direct3D 9 no longer offer vs.1.0 and ps.1.0; its conversion of Direct3D 8 shaders makes 1.1 of them."
        case S13Oldest STRICT_ADVICE "vs.1.0 and ps.1.0"
            breaks "{ps.1.0} | mov r0, v0";
    S14 REFUSED "An instruction exists in the version of the shader."
        breaks "ps.1.1 | tex t0 | {cmp} r0, t0, c0, c1"
        keeps "ps.1.2 | tex t0 | cmp r0, t0, c0, c1";
    O1 REFUSED "A register exists in the version of the shader."
        breaks "ps.1.1 | mov {r2}, v0 | mov r0, v0"
        keeps "ps.1.1 | mov r1, v0 | mov r0, v0";
    O2 REFUSED "A destination is a register that can be written."
        breaks "ps.1.1 | mov {c0}, v0 | mov r0, v0"
        keeps "ps.1.1 | mov r0, v0";
    O3 REFUSED "The outputs and a0 of a vertex shader cannot be read as sources."
        breaks "vs.1.1 | mov oPos, v0 | mov r0, {oD0}"
        keeps "vs.1.1 | mov oPos, v0 | mov oD0, v0";
    O4 MEANT "vs.1.0 has no address register and no relative addressing."
        breaks "vs.1.0 | mov oPos, v0 | mov r0, {c[a0.x]}"
        keeps "vs.1.1 | mov oPos, v0 | mov a0.x, v1.x | mov r0, c[a0.x]";
    O5 REFUSED "a0 is written by mov a0.x alone, before it is used."
        breaks "vs.1.1 | mov oPos, v0 | add {a0.x}, v0, v0"
        keeps "vs.1.1 | mov oPos, v0 | mov a0.x, v0 | mov r0, c[a0.x + 2]"
        case O5Unwritten MEANT "used before it is written"
            breaks "vs.1.1 | mov oPos, v0 | mov r0, {c[a0.x + 2]}";
    O6 REFUSED "Only c# as a source is addressed relative to a0.x."
        breaks "vs.1.1 | mov a0.x, v0 | mov oPos, {v[a0.x]}"
        keeps "vs.1.1 | mov oPos, v0 | mov a0.x, v0 | mov r0, -c[a0.x + 2].wzyx";
    O7 SILENT "Arithmetic of ps.1.0 to ps.1.3 writes r# or t#."
        note "O2 says so: no other register of these versions can be written.";
    O8 MEANT "Arithmetic of ps.1.4 does not name t#."
        breaks "ps.1.4 | mul r0, c0, {t0}"
        keeps "ps.1.1 | tex t0 | mul r0, c0, t0"
        case O8Written REFUSED "as a destination"
            breaks "ps.1.4 | mov {t0}, c0 | mov r0, c0";
    O9 MEANT "ps.1.4 reads v# only after phase."
        breaks "ps.1.4 | mul r0, c0, {v0} | phase | mov r0, c0"
        keeps "ps.1.4 | mul r0, c0, c0 | phase | mov r0, v0";
    O10 REFUSED "Texture instructions of ps.1.0 to ps.1.3 name t#; the last operand of texm3x3spec is c#."
        breaks "ps.1.1 | tex t0 | texbem t1, {r0} | mov r0, t1"
        keeps "ps.1.1 | tex t0 | texbem t1, t0 | mov r0, t1";
    O11 REFUSED "texld writes r# and reads t#, after phase also r#; texkill of ps.1.4 names t# or r#."
        breaks "ps.1.4 | texld {t0}, t0 | mov r0, c0"
        keeps "ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, r0 | mov r0, r1"
        case O11Phase MEANT "texld of r# before phase"
            breaks "ps.1.4 | texcrd r0.rgb, t0 | texld r1, {r0} | phase | mov r0, c0"
        case O11Kill ADVICE "texkill of r# before phase, of which it is not known whether it was refused"
            breaks "ps.1.4 | texcrd r0.rgb, t0 | texkill {r0} | phase | mov r0, c0";
    O12 REFUSED "texcrd writes r#.rgb from t# (r#.rg from t#_dw.xyw)."
        breaks "ps.1.4 | texcrd {r1.r}, t0 | mov r0, c0"
        keeps "ps.1.4 | texcrd r1.rgb, t0 | texcrd r2.rg, t1_dw.xyw | mov r0, c0"
        case O12NoMask ADVICE "without a mask, which is read as .rgb"
            breaks "ps.1.4 | texcrd {r1}, t0 | mov r0, c0";
    O13 REFUSED "Of the texture instructions only texm3x3spec reads a constant."
        breaks "ps.1.4 | texld r0, {c0}"
        keeps "ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3spec t3, t0, c0 | mov r0, t3";
    O14 MEANT "texdepth takes r5, after phase."
        breaks "ps.1.4 | texcrd r0.rgb, t0 | phase | texdepth {r0} | mov r0, c0"
        keeps "ps.1.4 | texcrd r5.rgb, t0 | phase | texdepth r5 | mov r0, c0"
        case O14Register REFUSED "a register of another file"
            breaks "ps.1.4 | phase | texdepth {t0} | mov r0, c0"
        case O14NoPhase ADVICE "in a shader without phase"
            breaks "ps.1.4 | texcrd r5.rgb, t0 | texdepth {r5} | mov r0, c0";
    O15 MEANT "The first source of cnd is r0.a in ps.1.0 to ps.1.3."
        breaks "ps.1.1 | mov r1, v0 | cnd r0, {r1.a}, v0, v1"
        keeps "ps.1.1 | mov r0, v0 | cnd r0, r0.a, v0, v1";
    O16 MEANT "cnd writes .rgba, .rgb or .a in ps.1.0 to ps.1.3."
        breaks "ps.1.1 | mov r0, v0 | cnd {r0.r}, r0.a, v0, v1"
        keeps "ps.1.1 | mov r0, v0 | cnd r0.rgb, r0.a, v0, v1";
    O17 MEANT "cmp writes a register that it does not read in ps.1.2 and ps.1.3."
        breaks "ps.1.2 | mov r0, v0 | cmp r0, {r0}, v0, v1"
        keeps "ps.1.2 | mov r1, v0 | cmp r0, r1, v0, v1";
    O18 MEANT "bem writes .rg and stands before phase."
        breaks "ps.1.4 | bem {r0.rgb}, c0, c1 | phase | mov r0, c0"
        keeps "ps.1.4 | bem r0.rg, c0, c1 | phase | mov r0, c0";
    O19 MEANT "A matrix macro takes its matrix plain and writes one component a row."
        breaks "vs.1.1 | m4x4 oPos, v0, {-c0}"
        keeps "vs.1.1 | m4x4 oPos, -v0.wzyx, c0 | m3x3 r0.xyz, v0, c0"
        case O19Mask ADVICE "a mask with more or fewer components than rows"
            breaks "vs.1.1 | mov oPos, v0 | m3x3 {r0}, v0, c0";
    O20 LATER "A matrix macro does not write a register that it reads."
        breaks "vs.1.1 | mov r0, v0 | m4x4 r0, {r0}, c0 | mov oPos, r0"
        keeps "vs.1.1 | mov r0, v0 | m4x4 r1, r0, c0 | mov oPos, r1"
        note "Direct3D 8 took it; Direct3D 9 expands the macro, so that the second row would read what the first has written.";
    O21 LATER "rcp, rsq, exp, expp, log and logp read one component, named by one letter."
        breaks "vs.1.1 | mov oPos, v0 | rcp r0, {v0}"
        keeps "vs.1.1 | mov oPos, v0 | rcp r0, v0.w | logp r0, -v0.y"
        note "Direct3D 8 took the fourth component where none was named; Direct3D 9 wants one named.";
    O22 LATER "frc writes .y or .xy."
        breaks "vs.1.1 | mov oPos, v0 | frc {r0}, v0"
        keeps "vs.1.1 | mov oPos, v0 | frc r0.xy, v0 | frc r0.y, v0"
        note "Direct3D 8 took any mask; Direct3D 9 computes .y, or .x and .y, and refuses others.";
    O23 REFUSED "Vertex shaders know no modifier but the minus sign."
        breaks "vs.1.1 | mov oPos, v0 | {mov_sat} oD0, v0"
        keeps "vs.1.1 | mov oPos, -v0";
    O24 REFUSED "A write mask names components in order and none twice, all of xyzw or all of rgba."
        breaks "vs.1.1 | mov oPos, v0 | mov r0.{yx}, v0"
        keeps "vs.1.1 | mov oPos, v0 | mov r0.xy, v0"
        note "oFog and oPts are one number each: listings of Direct3D 8 write them with .x or without a mask; Direct3D 9 takes them without a mask only."
        case O24Number STRICT "a mask on oFog or oPts"
            breaks "vs.1.1 | mov oPos, v0 | mov {oFog.x}, c0.x";
    O25 REFUSED "def names a constant register of the version, without a mask, and four numbers."
        breaks "ps.1.1 | def {c8}, 0, 0, 0, 0 | mov r0, v0"
        keeps "ps.1.1 | def c7, 0, 0, 0, 0 | mov r0, v0";
    O26 MEANT "A vertex shader counts on 96 constants, c0 to c95."
        breaks "vs.1.1 | mov oPos, {c96}"
        keeps "vs.1.1 | def c95, 0, 0, 0, 0 | m4x4 oPos, v0, c92"
        case O26Beyond REFUSED "c256 and above, where there is no storage"
            breaks "vs.1.1 | mov oPos, {c300}";
    M1 MEANT "A modifier exists in the version of the shader."
        breaks "ps.1.1 | {mul_x8} r0, v0, v0"
        keeps "ps.1.1 | mul_x4 r0, v0, v0"
        case M1Divide REFUSED "_dz and _dw"
            breaks "ps.1.1 | mov r0, {v0_dz}";
    M2 MEANT "Only arithmetic instructions take _x2, _x4, _x8, _d2, _d4, _d8 and _sat."
        breaks "ps.1.1 | {tex_sat} t0 | mov r0, t0"
        keeps "ps.1.1 | tex t0 | mov_sat r0, t0";
    M3 MEANT "Texture instructions take only the source modifiers that are theirs."
        breaks "ps.1.1 | tex t0 | texbem t1, {t0_bx2} | mov r0, t1"
        keeps "ps.1.1 | tex t0 | texm3x2pad t1, t0_bx2 | texm3x2tex t2, t0_bx2 | mov r0, t2";
    M4 REFUSED "1- stands alone: with no minus sign and no other modifier."
        breaks "ps.1.1 | mov r0, {1-v0_bx2}"
        keeps "ps.1.1 | mov r0, 1-v0";
    M5 MEANT "Constants take no modifier in ps.1.4."
        breaks "ps.1.4 | mul r0, c1, {1-c0}"
        keeps "ps.1.4 | mov r0, c0 | mul r0, c1, 1-r0";
    M6 LATER "What a modifier does to a constant is not defined in ps.1.0 to ps.1.3."
        breaks "ps.1.1 | add r0, v0, {-c1}"
        keeps "ps.1.1 | sub r0, v0, c1"
        note "Direct3D 8 took it against its own documents; Direct3D 9 refuses a modifier on a constant.";
    M7 MEANT "ps.1.0 to ps.1.3 write .rgba, .rgb or .a."
        breaks "ps.1.1 | mov r0, v0 | mov {r0.r}, c0"
        keeps "ps.1.1 | mov r0, v0 | mov r0.a, c0";
    M8 MEANT "dp3 writes .rgba or .rgb in ps.1.0 to ps.1.3."
        breaks "ps.1.1 | mov r0, v0 | dp3 {r0.a}, v0, v1"
        keeps "ps.1.1 | mov r0, v0 | dp3 r0.rgb, v0, v1";
    M9 MEANT "Sources of ps.1.0 to ps.1.3 select .a, and from ps.1.1 on .b for a result in .a."
        breaks "ps.1.1 | mul r0, v1, {v0.b}"
        keeps "ps.1.1 | mul r0, v1, v0.a | mov r0.a, v0.b";
    M10 MEANT "Sources of ps.1.4 select one component; texture coordinates select .xyz or .xyw."
        breaks "ps.1.4 | mov r0, {c0.gbr}"
        keeps "ps.1.4 | texld r0, t0.xyz | texld r1, t1.xyw | mov r0, c0.g";
    M11 MEANT "ps.1.4 reads each t# as .xyz or as .xyw, not both."
        breaks "ps.1.4 | texld r0, t0.xyz | texcrd r1.rgb, {t0.xyw}"
        keeps "ps.1.4 | texld r0, t0_dw.xyw | texcrd r1.rgb, t0.xyw | texld r2, t1"
        case M11Phases ADVICE "in different phases"
            breaks "ps.1.4 | texld r0, t0 | phase | texld r0, {t0_dw.xyw}";
    M12 MEANT "_dz divides r# in texld; _dw divides t#, with .xyw."
        breaks "ps.1.4 | texld r0, {t0_dz}"
        keeps "ps.1.4 | texld r0, t0_dw.xyw | texcrd r1.rgb, t1 | phase | texld r0, r1_dz"
        case M12Arithmetic REFUSED "in arithmetic"
            breaks "ps.1.4 | mov r1, c0 | mov r0, {r1_dz}";
    M13 MEANT "Texture instructions take no write mask, texcrd apart."
        breaks "ps.1.1 | tex {t0.rgb} | mov r0, t0"
        keeps "ps.1.1 | tex t0 | mov r0, t0";
    R1 MEANT "An instruction of a vertex shader reads one c#."
        breaks "vs.1.1 | mov oPos, v0 | add r0, c0, {c1}"
        keeps "vs.1.1 | mov oPos, v0 | add r0, c0.x, -c0.y";
    R2 MEANT "An instruction of a vertex shader reads one v#."
        breaks "vs.1.1 | mov oPos, v0 | add r0, v0, {v1}"
        keeps "vs.1.1 | mov oPos, v0 | mad r0, v0, c0, v0";
    R3 SILENT "An instruction of a vertex shader reads three r#."
        note "No instruction reads more: none has more than three sources.";
    R4 MEANT "An instruction of a pixel shader reads two c#."
        breaks "ps.1.1 | mad r0, c0, c1, {c2}"
        keeps "ps.1.1 | mad r0, c0, c1, c0";
    R5 SILENT "An instruction of ps.1.0 to ps.1.3 reads two r#."
        note "There are no more; O1 speaks of r2.";
    R6 MEANT "An instruction of ps.1.0 reads one t# and one v#."
        breaks "ps.1.0 | tex t0 | tex t1 | mul r0, t0, {t1}"
        keeps "ps.1.0 | tex t0 | mad r0, t0, v0, t0.a";
    R7 MEANT "An instruction of ps.1.1 reads two t#."
        breaks "ps.1.1 | tex t0 | tex t1 | tex t2 | mad r0, t0, t1, {t2}"
        keeps "ps.1.2 | tex t0 | tex t1 | tex t2 | mad r0, t0, t1, t2";
    R8 SILENT "An instruction of ps.1.2 and ps.1.3 reads three t#."
        note "No instruction reads more: none has more than three sources. R11 speaks of pairs.";
    R9 SILENT "An instruction of ps.1.4 reads three r# and one t#."
        note "No instruction reads more: none has more than three sources, and texture instructions have one. R11 speaks of pairs.";
    R10 SILENT "An instruction of ps.1.1 to ps.1.4 reads two v#."
        note "There are no more; O1 speaks of v2.";
    R11 MEANT "A pair reads at most three registers of a file."
        breaks "ps.1.1 | mad r0.rgb, c0, c1, v0 | +mad r0.a, c2, {c3}, v0"
        keeps "ps.1.1 | mad r0.rgb, c0, c1, v0 | +mad r0.a, c2, c1, v0";
    T1 MEANT "Texture instructions of ps.1.0 to ps.1.3 stand in the order of their stages."
        breaks "ps.1.1 | tex t1 | tex {t0} | mov r0, t0"
        keeps "ps.1.1 | tex t0 | tex t3 | mov r0, t0"
        case T1Kill ADVICE "texkill of a stage that stands before it"
            breaks "ps.1.1 | tex t0 | texkill {t0} | mov r0, t0";
    T2 MEANT "A t# is the destination of one texture instruction of ps.1.0 to ps.1.3."
        breaks "ps.1.1 | tex t0 | tex {t0} | mov r0, t0"
        keeps "ps.1.1 | tex t0 | tex t1 | mov r0, t0";
    T3 MEANT "A texture instruction reads a t# of a lower number that was written before."
        breaks "ps.1.1 | tex t1 | texbem t2, {t0} | mov r0, t2"
        keeps "ps.1.1 | tex t0 | texbem t2, t0 | mov r0, t2";
    T4 REFUSED "texm3x2pad t(m) is followed by texm3x2tex or texm3x2depth t(m+1)."
        breaks "ps.1.1 | tex t0 | texm3x2pad t1, t0 | {tex} t2 | mov r0, t2"
        keeps "ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t2, t0 | tex t3 | mov r0, t2";
    T5 REFUSED "texm3x3pad t(m) is followed by texm3x3pad t(m+1) and the instruction for the third row at t(m+2)."
        breaks "ps.1.1 | tex t0 | texm3x3pad t1, t0 | {texm3x3tex} t2, t0 | mov r0, t2"
        keeps "ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3vspec t3, t0 | mov r0, t3";
    T6 ADVICE "All rows of a matrix read the same t#."
        breaks "ps.1.1 | tex t0 | tex t1 | texm3x2pad t2, t0 | texm3x2tex t3, {t1} | mov r0, t3"
        keeps "ps.1.1 | tex t0 | tex t1 | texm3x2pad t2, t0 | texm3x2tex t3, t0 | mov r0, t3";
    T7 REFUSED "No pad stays open at the end of the texture instructions."
        breaks "ps.1.1 | tex t0 | {texm3x2pad} t1, t0 | mov r0, t0"
        keeps "ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t2, t0 | mov r0, t0";
    T8 MEANT "What a pad leaves in its t# cannot be read."
        breaks "ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t2, t0 | mul r0, {t1}, t1"
        keeps "ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t2, t0 | mov t1, v0 | mov r0, t1";
    T9 MEANT "A t# that texbem or texbeml has read is read by nothing else later."
        breaks "ps.1.1 | tex t0 | texbem t1, t0 | add r0, t1, {t0}"
        keeps "ps.1.1 | tex t0 | texbem t1, t0 | texbeml t2, t0 | add r0, t1, t2";
    T10 MEANT "After texm3x2depth its t# cannot be read."
        breaks "ps.1.3 | tex t0 | texm3x2pad t1, t0 | texm3x2depth t2, t0 | mov r0, {t2}"
        keeps "ps.1.3 | tex t0 | texm3x2pad t1, t0 | texm3x2depth t2, t0 | mov r0, t0";
    T11 ADVICE "After texkill its t# holds nothing defined."
        breaks "ps.1.1 | tex t0 | texkill t1 | mov r0, {t1}"
        keeps "ps.1.1 | tex t0 | texkill t1 | mov r0, t0";
    T12 ADVICE "How long a chain of dependent texture reads may be depends on the hardware."
        breaks "ps.1.1 | tex t0 | texbem t1, t0 | texreg2ar t2, {t1} | mov r0, t2"
        keeps "ps.1.1 | tex t0 | tex t1 | texreg2ar t2, t1 | mov r0, t2";
    T13 MEANT "texld reads an r# whose xyz was written before phase."
        breaks "ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, {r2} | mov r0, r1"
        keeps "ps.1.4 | texcrd r0.rgb, t0 | phase | texld r0, r0"
        note "Whether texkill is held to the same is not settled."
        case T13Kill ADVICE "texkill"
            breaks "ps.1.4 | phase | texld r1, t0 | texkill {r1} | mov r0, c0";
    I1 MEANT "A component of r# is written before it is read."
        breaks "ps.1.1 | add r0, {r0}, v0"
        keeps "ps.1.1 | mov r0.rgb, v0 | +mov r0.a, v0 | mul r0, r0, r0"
        note "Direct3D 8 let vertex shaders read what was never written, as 0; Direct3D 9 refuses it."
        case I1Vertex LATER "in vertex shaders, where it reads 0"
            breaks "vs.1.1 | mov oPos, {r0}";
    I2 MEANT "phase loses the alpha of every r#."
        breaks "ps.1.4 | texld r0, t0 | phase | mov r0, {r0}"
        keeps "ps.1.4 | texld r0, t0 | phase | mov r0.rgb, r0 | +mov r0.a, c0";
    I3 MEANT "texcrd leaves the components undefined that it does not write."
        breaks "ps.1.4 | texcrd r1.rgb, t0 | mov r0, {r1}"
        keeps "ps.1.4 | texcrd r1.rgb, t0 | mov r1.a, c0 | mov r0, r1";
    I4 MEANT "Arithmetic reads a t# that a texture instruction has written."
        breaks "ps.1.1 | mov r0, {t0} | mul r0, r0, t0"
        keeps "ps.1.1 | texcoord t0 | mov r0, t0";
    I5 MEANT "After texdepth r5 cannot be read."
        breaks "ps.1.4 | texcrd r5.rgb, t0 | phase | texdepth r5 | mul r0, c0, {r5.r}"
        keeps "ps.1.4 | texcrd r5.rgb, t0 | phase | texdepth r5 | mov r5, c0 | mov r0, r5";
    I6 SILENT "A component that a mask or selector leaves out need not have been written."
        note "This allows, so that nothing can break it; I1 speaks of the components that have an effect.";
    I7 ADVICE "A vertex shader reads constants that were set; others are 0."
        note "Constants are also set beside the shader, so that no listing shows it; eval, which is given them, warns.";
    C1 REFUSED "Vertex shaders have no pairs."
        breaks "vs.1.1 | mov oPos, v0 | +{mov} r0, v0"
        keeps "vs.1.1 | mov oPos, v0 | mov r0, v0";
    C2 REFUSED "+ joins an arithmetic instruction to the single arithmetic instruction before it."
        breaks "ps.1.1 | +{mov} r0, v0"
        keeps "ps.1.1 | mov r0.rgb, v0 | +mov r0.a, v0";
    C3 MEANT "Of a pair in ps.1.0 to ps.1.3 one writes .rgb and the other .a."
        breaks "ps.1.1 | mov r0, v0 | +mov {r1.a}, v0"
        keeps "ps.1.1 | mov r0.a, v0 | +mov r0.rgb, v1";
    C4 MEANT "Of a pair in ps.1.4 one writes of r, g and b, the other .a."
        breaks "ps.1.4 | mov r0, c0 | +mov {r1.a}, c0"
        keeps "ps.1.4 | mov r0, c0 | mov r0.rg, c1 | +mov r1.a, c1";
    C5 MEANT "Both halves of a pair in ps.1.0 write the same register."
        breaks "ps.1.0 | mov r0, v0 | mul r0.rgb, v0, v0 | +mov {r1.a}, v0"
        keeps "ps.1.1 | mov r0, v0 | mul r0.rgb, v0, v0 | +mov r1.a, v0";
    C6 MEANT "dp4 and bem stand alone; in a pair dp3 writes colour."
        breaks "ps.1.4 | mov r0, c0 | mov r0.a, c1 | +{dp4} r0.rgb, c0, c1"
        keeps "ps.1.4 | mov r0, c0 | mov r0.a, c1 | +dp3 r0.rgb, c0, c1";
    C7 REFUSED "Only arithmetic instructions form pairs."
        breaks "ps.1.1 | tex t0 | +{tex} t1 | mov r0, t0"
        keeps "ps.1.1 | tex t0 | tex t1 | mov r0, t0";
    C8 SILENT "A pair reads no more registers than its version allows."
        note "R11 says so.";
    D1 REFUSED "A vertex declaration ends with D3DVSD_END, 0xFFFFFFFF."
        breaks "D3DVSD_STREAM(0), | D3DVSD_REG(0, D3DVSDT_FLOAT3),"
        keeps "D3DVSD_STREAM(0), | D3DVSD_REG(0, D3DVSDT_FLOAT3), | D3DVSD_END()";
    D2 REFUSED "A vertex declaration for a vertex shader loads the input registers 0 to 15."
        breaks "D3DVSD_STREAM(0), | D3DVSD_REG(16, D3DVSDT_FLOAT3), | D3DVSD_END()"
        keeps "D3DVSD_STREAM(0), | D3DVSD_REG(15, D3DVSDT_FLOAT3), | D3DVSD_END()";
    D3 ADVICE "A vertex declaration loads a register once."
        breaks "D3DVSD_STREAM(0), | D3DVSD_REG(0, D3DVSDT_FLOAT3), | D3DVSD_REG(0, D3DVSDT_FLOAT3), | D3DVSD_END()"
        keeps "D3DVSD_STREAM(0), | D3DVSD_REG(0, D3DVSDT_FLOAT3), | D3DVSD_REG(3, D3DVSDT_FLOAT3), | D3DVSD_END()";
    D4 REFUSED "D3DVSD_CONST loads 1 to 15 constants, none above the 96 that every device has."
        breaks "D3DVSD_CONST(96, 1), | 0x00000000, 0x00000000, 0x00000000, 0x3F800000, | D3DVSD_END()"
        keeps "D3DVSD_CONST(95, 1), | 0x00000000, 0x00000000, 0x00000000, 0x3F800000, | D3DVSD_END()";
    D5 ADVICE "Without a vertex shader each register of a declaration keeps its fixed meaning, and D3DVSDE_NORMAL is D3DVSDT_FLOAT3."
        breaks "D3DVSD_STREAM(0), | D3DVSD_REG(D3DVSDE_NORMAL, D3DVSDT_FLOAT4), | D3DVSD_END()"
        keeps "D3DVSD_STREAM(0), | D3DVSD_REG(D3DVSDE_NORMAL, D3DVSDT_FLOAT3), | D3DVSD_END()"
        note "A declaration does not say whether a shader goes with it; dis --fixed-function judges it as one without.";
}
