//! The rules of the text, `P…`: what never gets as far as a rule of the shader model. Those of the preprocessor stand
//! behind those of the listing.

use super::severity::{ADVICE, MEANT, REFUSED};

// P2 and P4 were what S1 is, and are not used again.
super::named! {
    NOT_A_LISTING "P1" REFUSED "A listing is text: a version instruction with instructions behind it.";
    VERSION_UNKNOWN "P3" REFUSED "The version is vs.1.0, vs.1.1 or ps.1.0 to ps.1.4, with dots or with underscores throughout.";
    COMMENT "P5" REFUSED "A comment begins with ; or // and ends with its line, or stands between /* and */.";
    COMMENT_OPEN "P6" REFUSED "A comment that begins with /* ends with */.";
    UNSEEN_DIRECTIVE "P7" REFUSED "Lines that begin with # speak to the preprocessor, which comes before the assembler.";
    INSTRUCTION "P8" REFUSED "A statement begins with the mnemonic of an instruction of Direct3D 8.";
    MNEMONIC_LOST "P9" REFUSED "Operands stand behind the mnemonic of their instruction.";
    OPERAND_COUNT "P10" REFUSED "An instruction has as many operands as its form has, no more and no fewer.";
    SEPARATOR "P11" REFUSED "One comma stands between two operands, and none behind the last.";
    RESULT_SUFFIX "P12" REFUSED "The mnemonic of a pixel shader instruction takes one of _x2 _x4 _x8 _d2 _d4 _d8 and one _sat, each joined by an underscore.";
    REGISTER "P13" REFUSED "An operand is a register: r# v# t# c# a0, or oPos oFog oPts oD# oT#.";
    SELECTOR "P14" REFUSED "Behind the dot stand one to four letters, all of xyzw or all of rgba.";
    SOURCE_MODIFIER "P15" REFUSED "A source takes - or 1- in front or, in pixel shaders, one of _bias _bx2 _x2 _dz _dw behind the register, with - only before the first three."
        case MEANT "_sat on a source, which is passed over";
    INDEX "P16" REFUSED "The index in brackets is a sum of whole numbers and at most one a0.x.";
    NUMBER "P17" REFUSED "A number is written in decimal digits, with a point or an exponent where needed, and fits a 32-bit float; infinities and NaNs are written as their eight hexadecimal digits behind 0x.";
    DECLARATION "P18" REFUSED "A declaration is dcl_ with a usage, an index from 0 to 15 where needed, and a register.";
    CO_ISSUE "P19" REFUSED "A + stands once in front of the second instruction of a pair.";
    STRAY "P20" REFUSED "Nothing but instructions and comments stands in a listing.";
    TOO_MANY "P21" REFUSED "Only the first errors of a text are shown.";
    SPELLING "P22" ADVICE "A spelling that the documents do not have is read where it can mean only one thing.";
    UNREAD "P23" ADVICE "What a pixel shader loads is read by a later instruction.";
    TOKEN_COMMENT "P24" REFUSED "Behind ;@comment stand strings in quotes and tokens of eight hexadecimal digits; lines that begin with ;@ and a blank continue it.";
    DIRECTIVE "P25" REFUSED "A directive is one of #define, #undef, #include, #if, #ifdef, #ifndef, #elif, #else, #endif, #line, #error and #pragma with what belongs to it.";
    CONDITIONAL "P26" REFUSED "#if, #ifdef and #ifndef end with an #endif in the same text; #elif and one #else may stand between.";
    EXPRESSION "P27" REFUSED "The condition of #if and #elif is an expression of C with whole numbers, macros and defined(NAME).";
    INCLUDE "P28" REFUSED "#include names a file that can be read, in quotes or in < >.";
    BOUNDS "P29" REFUSED "What is included, defined and expanded ends: files in files 32 deep, 1000 files, 4 MiB of text, 262144 words from macros.";
    STOPPED "P30" REFUSED "#error ends the reading of a listing.";
    ARGUMENTS "P31" REFUSED "A macro with parameters is used with as many arguments, in one pair of parentheses.";
    REDEFINED "P32" ADVICE "A name is defined once, or again with the same text.";
    MAYBE_MACRO "P33" ADVICE "What is no instruction may be a macro where an included file could not be read; then nobody can tell what the shader is.";
}
