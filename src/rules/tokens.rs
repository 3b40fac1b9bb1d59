//! The rules of tokens, `K…`: what never gets as far as a rule of the shader model.

use super::severity::{ADVICE, REFUSED};

// K1 was what S13 is and K2 what S12 is; neither is used again.
super::named! {
    BEHIND "K3" ADVICE "Nothing stands behind the end token.";
    OPCODE "K4" REFUSED "The low half of an instruction token is the number of an instruction of Direct3D 8.";
    STRAY "K5" REFUSED "An instruction begins with a token whose bit 31 is clear.";
    OPERANDS "K6" REFUSED "As many operand tokens follow an instruction as it has operands, each with bit 31 set.";
    REGISTER "K7" REFUSED "An operand names a register file that its kind of shader has, and a register of it that a listing of the version can name.";
    MASK "K8" REFUSED "A destination writes at least one component.";
    MODIFIER "K9" REFUSED "Modifiers are those of the kind of shader: a shift of -3 to 3 and a saturation on a destination of a pixel shader, the codes 0 to 10 on its sources, 0 and 1 on those of a vertex shader; bit 30, which makes a pair, on instructions of a pixel shader.";
    RELATIVE "K10" REFUSED "Only a constant that a vertex shader reads is addressed relative to a0.x.";
    RESERVED "K11" ADVICE "Bits without meaning are clear.";
    COMMENT "K12" REFUSED "A comment is no longer than what is left of the stream.";
    LONG "K13" REFUSED "A stream has at most 262144 tokens, and 16384 instructions and comments.";
    BYTES "K14" REFUSED "A binary file is a row of 32-bit words, the lowest byte first.";
    TEXT "K15" REFUSED "Tokens as text are hexadecimal numbers of eight digits, or numbers and macros of d3d8types.h in an array of a C source.";
    SUBTRACT "K16" ADVICE "A vertex shader subtracts by adding a negated source.";
    USAGE "K17" REFUSED "A dcl names a usage from 0 to 13 and an index from 0 to 15.";
    NO_TOKEN "K18" REFUSED "What is written as tokens has a token.";
    ELEMENT "K19" REFUSED "A token of a vertex declaration is one of the D3DVSD_ macros with arguments that fit.";
    MANY "K20" REFUSED "Only the first errors of a stream are shown.";
}
