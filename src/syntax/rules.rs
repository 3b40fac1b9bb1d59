//! The rules of the text, `P…`: what never gets as far as a rule of the shader model.

use crate::diagnostic::Rule;

macro_rules! rules {
    ($($name:ident $id:literal $rule:literal;)*) => {
        $(pub(super) static $name: Rule = Rule { id: $id, rule: $rule };)*

        /// Every rule that the text of a listing can break. The numbers are never reused.
        pub static RULES: &[&Rule] = &[$(&$name),*];
    };
}

rules! {
    NOT_A_LISTING "P1" "A listing is text: a version instruction with instructions behind it.";
    VERSION_MISSING "P2" "A listing begins with its version instruction; only comments and blank lines may stand before it.";
    VERSION_UNKNOWN "P3" "The version is vs.1.0, vs.1.1 or ps.1.0 to ps.1.4, with dots or with underscores throughout.";
    VERSION_TWICE "P4" "A listing holds one shader and so one version instruction.";
    COMMENT "P5" "A comment begins with ; or // and ends with its line, or stands between /* and */.";
    COMMENT_OPEN "P6" "A comment that begins with /* ends with */.";
    DIRECTIVE "P7" "Lines that begin with # speak to the preprocessor, which comes before the assembler.";
    INSTRUCTION "P8" "A statement begins with the mnemonic of an instruction of Direct3D 8.";
    MNEMONIC_LOST "P9" "Operands stand behind the mnemonic of their instruction.";
    OPERAND_COUNT "P10" "An instruction has as many operands as its form has, no more and no fewer.";
    SEPARATOR "P11" "One comma stands between two operands, and none behind the last.";
    RESULT_SUFFIX "P12" "The mnemonic of a pixel shader instruction takes one of _x2 _x4 _x8 _d2 _d4 _d8 and one _sat, each joined by an underscore.";
    REGISTER "P13" "An operand is a register: r# v# t# c# a0, or oPos oFog oPts oD# oT#.";
    SELECTOR "P14" "Behind the dot stand one to four letters, all of xyzw or all of rgba; in a write mask in order and none twice.";
    SOURCE_MODIFIER "P15" "A source takes - or 1- in front or, in pixel shaders, one of _bias _bx2 _x2 _dz _dw behind the register, with - only before the first three.";
    INDEX "P16" "The index in brackets is a sum of whole numbers and at most one a0.x.";
    NUMBER "P17" "A number is written in decimal digits, with a point or an exponent where needed, and fits a 32-bit float; infinities and NaNs are written as their eight hexadecimal digits behind 0x.";
    DECLARATION "P18" "A declaration is dcl_ with a usage, an index from 0 to 15 where needed, and a register.";
    CO_ISSUE "P19" "A + stands once in front of the second instruction of a pair.";
    STRAY "P20" "Nothing but instructions and comments stands in a listing.";
    TOO_MANY "P21" "Only the first errors of a text are shown.";
    SPELLING "P22" "A spelling that the documents do not have is read where it can mean only one thing.";
    UNREAD "P23" "What a pixel shader loads is read by a later instruction.";
    TOKEN_COMMENT "P24" "Behind ;@comment stand strings in quotes and tokens of eight hexadecimal digits; lines that begin with ;@ and a blank continue it.";
}
