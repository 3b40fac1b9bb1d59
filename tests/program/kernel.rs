//! `texcrd kernel`: what runs.

use super::texcrd_with_input;

#[test]
fn steps_stand_behind_their_lines_before_and_after() {
    let listing = b"ps.1.4\ndef c0, 0.5, 0, 0, 1\n; a comment\ntexld r0, t1\nmov r1, r0\nmul_x2_sat r0.rgb, r1_bx2, c0\n+mov r0.a, c0.a\n";
    let ran = texcrd_with_input(&["kernel", "-"], listing);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let (before, after) = ran.out.split_once("rows:").expect("two parts");
    assert_eq!(
        before,
        "ps.1.4: 4 steps\n     \
         4  sample0 r0, t1\n     \
         5  mov r1, r0\n     \
         6  mul_x2_sat r0.rgb, r1_bx2, c0\n     \
         7  mov r0.a, c0.a\n"
    );
    // The copy to r1 is gone, so is what would have been the alpha of the texel; that of the constant is moved once a draw.
    let steps = |part: &str| -> Vec<String> {
        let lines = part
            .lines()
            .filter(|line| line.trim_start().starts_with(|c: char| c.is_ascii_digit()));
        let words = |line: &str| {
            line.split_whitespace()
                .take(2)
                .collect::<Vec<_>>()
                .join(" ")
        };
        lines.map(words).collect()
    };
    // Four components of t1 and c0 are read, of which one is a number.
    let (_, filled) = after.split_once("filled beforehand:\n").expect("a part");
    let filled = filled.lines().next().expect("a line");
    assert!(
        filled.contains(" = c0.x, ") && filled.ends_with(" = t1.z"),
        "{filled}"
    );
    let (once, every) = after.split_once("for every batch:").expect("two parts");
    assert_eq!(
        steps(once.split_once("once a draw:").expect("a part").1),
        ["7 mov"]
    );
    assert_eq!(steps(every), ["4 sample0", "6 (2", "6 mul_x2_sat"]);
}

#[test]
fn a_listing_that_breaks_a_rule_has_no_kernel() {
    let ran = texcrd_with_input(&["kernel", "-"], b"ps.1.1\nmov r5, v0\n");
    assert_eq!((ran.status, ran.out.as_str()), (1, ""));
    assert!(ran.err.contains("r5"), "{}", ran.err);
}
