//! What macros stand for.

use super::*;

#[test]
fn names_stand_for_text() {
    let text =
        "#define Pow c16.w\n#define light -c8\nmul r0, light, Pow\nmul r0, Powder, -light.w\n";
    assert_eq!(out(text), "mul r0, -c8, c16.w\nmul r0, Powder, --c8.w\n");
    assert_eq!(
        out("#define CV 4\nmov r0, c[CV]\nmov r0, c[a0.x+CV]\n"),
        "mov r0, c[4]\nmov r0, c[a0.x+4]\n"
    );
}

#[test]
fn macros_are_not_looked_for_in_comments() {
    let text = "#define A c1\nmov r0, A ; A\nA // A\n/* A */ A\n";
    assert_eq!(out(text), "mov r0, c1 ; A\nc1 // A\n/* A */ c1\n");
}

#[test]
fn a_macro_takes_the_suffix_of_a_source() {
    let text =
        "#define TEX t0\n#define L c1.x\n1-TEX_bx2, TEX_BIAS, TEX_foo, L_x2, _bx2, TEX_bx2_bx2\n";
    assert_eq!(
        out(text),
        "1-t0_bx2, t0_BIAS, TEX_foo, c1.x_x2, _bx2, TEX_bx2_bx2\n"
    );
    // A macro of that very name comes first.
    assert_eq!(out("#define T t0\n#define T_bx2 t1\nT_bx2\n"), "t1\n");
}

#[test]
fn arguments_stand_for_parameters() {
    let text =
        "#define M(a, b) mul a, b, a.b\nM(r0, c1)\nM( (x, y) ,)\nM\n(1,\n ; one\n2)\nM + 1\n";
    assert_eq!(
        out(text),
        "mul r0, c1, r0.c1\nmul (x, y), , (x, y).\nmul 1, 2, 1.2\nM + 1\n"
    );
    // No blank between name and parenthesis makes parameters; without parameters nothing is an argument.
    assert_eq!(
        out("#define A (x)\n#define B() y\nA B() B( ) B\n"),
        "(x) y y B\n"
    );
    assert_eq!(
        told(
            "#define M(a, b) a b\nM(1)\nM(1, 2, 3)\nM(1\n#if 1\n#endif\n",
            &[]
        ),
        [
            "listing:2:1 P31 `M` takes 2 arguments, but is used with 1",
            "listing:3:1 P31 `M` takes 2 arguments, but is used with 3",
            "listing:4:1 P31 the arguments of `M` have no end",
        ]
    );
}

/// The examples of the C standard (C99, 6.10.3.5), as far as they use what is read here.
#[test]
fn macros_in_macros() {
    let text = "#define x 3\n#define f(a) f(x * (a))\n#undef x\n#define x 2\n#define g f\n#define z z[0]\n\
                #define h g(~\n#define m(a) a(w)\n#define w 0,1\n#define t(a) a\n\
                f(y+1) + f(f(z)) % t(t(g)(0) + t)(1);\ng(x+(3,4)-w) | h 5) & m(f)^m(m);\n";
    let text = text.replace(';', " END");
    assert_eq!(
        out(&text),
        "f(2 * (y+1)) + f(2 * (f(2 * (z[0])))) % f(2 * (0)) + t(1) END\n\
         f(2 * (2+(3,4)-0,1)) | f(2 * (~ 5)) & f(2 * (0,1))^m(0,1) END\n"
    );
    assert_eq!(out("#define A B\n#define B A\nA B\n"), "A B\n");
}

#[test]
fn two_signs_join_words() {
    let text = "#define T(n) t##n\n#define C(a, b) a ## b . a\n#define T2(n) T(n)\n#define N 3\nT(1) C(r, 0) T(N) T2(N) T()\n";
    assert_eq!(out(text), "t1 r0 . r tN t3 t\n");
    // What is joined may be a macro, and take a suffix.
    assert_eq!(out("#define t1 done\n#define T(n) t##n\nT(1)\n"), "done\n");
}

#[test]
fn continued_lines() {
    let text = "#define REG 1 + 2 +\\\n3 + 4\nc0[ REG ]\n#define TWO(a) mov r0, a \\  \r\n  +mov r1, \\\n a ; not \\\n more\nTWO(c1)\n";
    // A word at the start of a continued line may be an instruction, and begins one here, too.
    assert_eq!(
        out(text),
        "c0[ 1 + 2 + 3 + 4 ]\nmov r0, c1\n+mov r1,\nc1\nmore\n"
    );
}

#[test]
fn words_that_come_together_stay_two() {
    assert_eq!(
        out("#define A(x) x\nA(r)A(0) A(-)1 A(c)[A(1)]\n"),
        "r 0 -1 c[1]\n"
    );
}

#[test]
fn a_second_definition_is_told_if_it_differs() {
    assert_eq!(
        out("#define A 1  +  2\n#define A 1 + 2 ; same\nA\n"),
        "1 + 2\n"
    );
    assert_eq!(
        told("#define A 1\n#define A 2\n", &[]),
        ["listing:2:9 P32 `A` is defined again, otherwise than before (listing:1)"]
    );
}
