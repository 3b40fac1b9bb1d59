//! The rules of the preprocessor, `P…` behind those of the text.

use crate::diagnostic::Rule;

macro_rules! rules {
    ($($name:ident $id:literal $rule:literal;)*) => {
        $(pub(super) static $name: Rule = Rule { id: $id, rule: $rule };)*

        /// Every rule that what the preprocessor reads can break. The numbers are never reused.
        pub static RULES: &[&Rule] = &[$(&$name),*];
    };
}

rules! {
    DIRECTIVE "P25" "A directive is one of #define, #undef, #include, #if, #ifdef, #ifndef, #elif, #else, #endif, #line, #error and #pragma with what belongs to it.";
    CONDITIONAL "P26" "#if, #ifdef and #ifndef end with an #endif in the same text; #elif and one #else may stand between.";
    EXPRESSION "P27" "The condition of #if and #elif is an expression of C with whole numbers, macros and defined(NAME).";
    INCLUDE "P28" "#include names a file that can be read, in quotes or in < >.";
    BOUNDS "P29" "What is included, defined and expanded ends: files in files 32 deep, 1000 files, 4 MiB of text, 262144 words from macros.";
    STOPPED "P30" "#error ends the reading of a listing.";
    ARGUMENTS "P31" "A macro with parameters is used with as many arguments, in one pair of parentheses.";
    REDEFINED "P32" "A name is defined once, or again with the same text.";
}
