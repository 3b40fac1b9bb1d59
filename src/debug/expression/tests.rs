//! Expected values are worked out by hand from the values that are given.

use super::*;
use crate::debug::tests::Owned;
use proptest::prelude::*;

const PIXEL: &str = "ps.1.4\n\
    def c0, 0.9, 0, 0, 0.5\n\
    texcrd r1.rgb, t1\n\
    mov r0, v0\n";

/// The value of an expression at the end of a listing, or what is wrong with it.
fn at_end(listing: &str, given: &[(&str, &[f32])], text: &str) -> Result<Value, String> {
    let owned = Owned::new(listing);
    let mut session = owned.session(given);
    while session.step() {}
    let expression: Expression = text.parse().map_err(|e: ExpressionError| e.message)?;
    let scope = session.scope().unwrap();
    expression.evaluate(&scope).map_err(|e| e.message)
}

fn pixel(text: &str) -> Result<Value, String> {
    let given: [(&str, &[f32]); 2] = [
        ("v0", &[0.5, 0.25, 1.0, 0.125]),
        ("t1", &[3.0, -4.0, 2.0, 8.0]),
    ];
    at_end(PIXEL, &given, text)
}

fn is(text: &str, expected: &[f32]) {
    let value = pixel(text).expect(text);
    assert_eq!(value.components(), expected, "{text}");
}

fn fails(text: &str, message: &str) {
    let why = pixel(text).expect_err(text);
    assert!(why.contains(message), "{text}: {why}");
}

#[test]
fn registers_swizzles_and_modifiers() {
    is("r0", &[0.5, 0.25, 1.0, 0.125]);
    is("R0.rgb", &[0.5, 0.25, 1.0]);
    is("r0.wx", &[0.125, 0.5]);
    is("r0.bbbb", &[1.0; 4]);
    is("r1.y", &[-4.0]);
    is("c0.r", &[0.9]);
    // 2·(x − 0.5), x − 0.5, 2·x, 1 − x
    is("r0_bx2", &[0.0, -0.5, 1.0, -0.75]);
    is("-r0_bx2.g", &[0.5]);
    is("-r0.g_bx2", &[0.5]);
    is("r0_bias.rg", &[0.0, -0.25]);
    is("r0_x2.rgb", &[1.0, 0.5, 2.0]);
    is("1-r0", &[0.5, 0.75, 0.0, 0.875]);
    // x / z, y / z; of `.xyw` the third component is the divisor of `_dw`.
    is("t1_dz", &[1.5, -2.0]);
    is("t1_dw.xyw", &[0.375, -0.5]);
    is("t1.xyw_da", &[0.375, -0.5]);
    is("tc1.x", &[3.0]);
    is("(r0.rg, 2, c0.a)", &[0.5, 0.25, 2.0, 0.5]);
    is("killed", &[0.0]);
}

#[test]
fn operators_bind_as_in_c() {
    is("1 + 2 * 3", &[7.0]);
    is("(1 + 2) * 3", &[9.0]);
    is("1 - 2 - 3", &[-4.0]);
    is("8 / 4 / 2", &[1.0]);
    is("-r0.r * 2", &[-1.0]);
    is("1 < 2 == 1", &[1.0]);
    is("1 || 0 && 0", &[1.0]);
    is("!0 + 1", &[2.0]);
    is("--2", &[2.0]);
    is("1.5e1 + .5 + 0.5f", &[16.0]);
    is("r0 * 2 + r0.aaaa", &[1.125, 0.625, 2.125, 0.375]);
    is("r0 > 0.25", &[1.0, 0.0, 1.0, 0.0]);
    is("r0.rg >= r0.gr", &[1.0, 0.0]);
    is("r0.rg <= 0.25", &[0.0, 1.0]);
    is("r0.rg != 0.25", &[1.0, 0.0]);
    // A condition holds if any component does.
    is("r0 > 0.75 && r0 < 0.2", &[1.0]);
    is("!(r0 > 2)", &[1.0]);
    is("nan == nan", &[0.0]);
    is("nan != nan", &[1.0]);
}

#[test]
fn arithmetic_is_the_shaders() {
    is("0 * inf", &[0.0]);
    is("nan * 0", &[0.0]);
    is("1 / 0", &[f32::INFINITY]);
    // Denormal results are zero: 1e-30² = 1e-60, and half the smallest normal number.
    is("1.17549435e-38 / 2", &[0.0]);
    is("rcp(0)", &[f32::MAX]);
    // s1 where either is NaN
    is("min(nan, 3)", &[3.0]);
    is("max(nan, 3)", &[3.0]);
}

#[test]
fn functions() {
    // 3·0.5 − 4·0.25 + 2·1 = 2.5, + 0·0.125: r1's fourth component is 0.
    is("dp3(r1, r0)", &[2.5]);
    is("dp4(r1, r0)", &[2.5]);
    is("dp3(r0, 2)", &[3.5]);
    is("length((3, 4))", &[5.0]);
    is("length(r1.rg)", &[5.0]);
    is("normalize((0, 0, 4))", &[0.0, 0.0, 1.0]);
    is("normalize((0, 0, 0))", &[0.0, 0.0, 0.0]);
    is("abs(r1.rgb)", &[3.0, 4.0, 2.0]);
    is("min(r1, r0).rg", &[0.5, -4.0]);
    is("max(r1.rgb, 0)", &[3.0, 0.0, 2.0]);
    is("sat(r1.rgb)", &[1.0, 0.0, 1.0]);
    is("isnan((nan, 1, inf))", &[1.0, 0.0, 0.0]);
    is("isinf((nan, 1, -inf))", &[0.0, 0.0, 1.0]);
    is("lrp(0.25, 4, 8)", &[7.0]);
    is("cnd(0.5, 1, 2)", &[2.0]);
    is("cmp(0, 1, 2)", &[1.0]);
    is("frc(-1.25)", &[0.75]);
    is("floor(-1.25)", &[-2.0]);
    is("log(8)", &[3.0]);
    is("exp(3)", &[8.0]);
    is("rsq(4)", &[0.5]);
    is("slt(1, 2) + sge(1, 2)", &[1.0]);
}

#[test]
fn constants_by_number() {
    let listing = "vs.1.1\nmov a0.x, v0.x\nmov oPos, c[a0.x + 2]\n";
    let given: [(&str, &[f32]); 3] = [
        ("v0", &[3.5]),
        ("c5", &[1.0, 2.0, 3.0, 4.0]),
        ("c3", &[7.0]),
    ];
    let value = |text: &str| at_end(listing, &given, text).map(|v| v.numbers);
    // a0.x is ⌊3.5⌋ = 3.
    assert_eq!(value("c[a0.x + 2]"), Ok([1.0, 2.0, 3.0, 4.0]));
    assert_eq!(value("c[a0.x]"), Ok([7.0; 4]));
    assert_eq!(value("c[3]"), Ok([7.0; 4]));
    assert_eq!(value("c5"), Ok([1.0, 2.0, 3.0, 4.0]));
    // Outside of those there are: 0, as the shader reads it.
    assert_eq!(value("c[a0.x + 1000]"), Ok([0.0; 4]));
    assert_eq!(value("c[-1]"), Ok([0.0; 4]));
    assert_eq!(value("oPos.w"), Ok([4.0, 0.0, 0.0, 0.0]));
    assert_eq!(
        value("c256"),
        Err("vs.1.1 has no c256; it has c0 to c255".into())
    );
    assert_eq!(value("t0"), Err("vs.1.1 has no t0".into()));
}

#[test]
fn coordinates_until_something_is_sampled() {
    let owned = Owned::new("ps.1.1\ntex t0\nmov r0, t0\n");
    let mut session = owned.session(&[("t0", &[0.25, 0.5, 0.0, 1.0])]);
    let t0: Expression = "t0".parse().unwrap();
    let value = |session: &Session<'_>| t0.evaluate(&session.scope().unwrap()).unwrap().numbers;
    assert_eq!(value(&session), [0.25, 0.5, 0.0, 1.0]);
    session.step();
    // No texture: opaque black.
    assert_eq!(value(&session), [0.0, 0.0, 0.0, 1.0]);
    let scope = session.scope().unwrap();
    let tc0: Expression = "tc0.y".parse().unwrap();
    assert_eq!(tc0.evaluate(&scope).unwrap(), Value::scalar(0.5));
    let target = Some((Target::Slot(Slot::texture(0).unwrap()), WriteMask::ALL));
    assert_eq!(t0.target(&scope.run.listing), target);
    assert_eq!(t0.target_here(&scope), target);
    session.back();
    let coordinates = Some((Target::Slot(Slot::texcoord(0).unwrap()), WriteMask::ALL));
    assert_eq!(t0.target_here(&session.scope().unwrap()), coordinates);
}

#[test]
fn plain_registers_can_be_written() {
    let owned = Owned::new(PIXEL);
    let listing = owned.listing();
    let target = |text: &str| text.parse::<Expression>().unwrap().target(&listing);
    let r0 = Target::Slot(Slot::R0);
    assert_eq!(target("r0"), Some((r0, WriteMask::ALL)));
    assert_eq!(target("r0.rb"), Some((r0, WriteMask::X.or(WriteMask::Z))));
    assert_eq!(target("(r0)"), Some((r0, WriteMask::ALL)));
    assert_eq!(target("c7.w"), Some((Target::Constant(7), WriteMask::W)));
    assert_eq!(
        target("depth"),
        Some((Target::Slot(Slot::DEPTH), WriteMask::X))
    );
    for text in [
        "r0.bg", "r0.xx", "-r0", "r0_x2", "r0 + 1", "killed", "r9", "c[1]", "1",
    ] {
        assert_eq!(target(text), None, "{text}");
    }
}

#[test]
fn what_is_wrong_is_said_in_words() {
    fails("r7", "ps.1.4 has no r7; it has r0 to r5");
    fails("v2", "ps.1.4 has no v2; it has v0 and v1");
    fails("a0.x", "ps.1.4 has no a0");
    fails("c8", "ps.1.4 has no c8; it has c0 to c7");
    fails("depth", "this shader writes no depth");
    fails("r0.q", "components are one to four of");
    fails("r0.xg", "components are one to four of");
    fails("r0.xyzwx", "components are one to four of");
    fails("r0.rg.b", "this has 2 components, and no third");
    fails("r0.rg + r0", "2 components do not fit 4 components");
    fails("r0_bx3", "`_bx3` is no source modifier");
    fails("r0 = 1", "`==` compares");
    fails("r0 r1", "an operator should stand before `r1`");
    fails("(r0", "a `)` is missing");
    fails("r0 +", "the expression ends where");
    fails("", "the expression ends where");
    fails("* 2", "`*` stands where");
    fails("dp3(r0)", "dp3 takes 2 arguments; there are 1");
    fails("dp3(r0.rg, r0)", "dp3 takes 3 components; this has 2");
    fails("dp3", "its arguments stand in parentheses");
    fails("sinh(1)", "there is no function `sinh`");
    fails("glub", "`glub` is no register");
    fails("2r0", "this is no number");
    fails("r0, r1", "more than four components");
    fails("c[r0]", "one number should stand here, not 4");
    fails(&"(".repeat(10_000), "too long");
    let why = "r0 + r1.q".parse::<Expression>().unwrap_err();
    assert_eq!(why.at, 7..9);
}

#[test]
fn values_are_written_in_four_ways() {
    let value = pixel("(0.5, -1.5, 0.1)").unwrap();
    assert_eq!(value.text(Format::Float), "0.5, -1.5, 0.1");
    // 0.1 is 0x3dcccccd: the nearest 32-bit number.
    assert_eq!(
        value.text(Format::Hex),
        "0x3f000000, 0xbfc00000, 0x3dcccccd"
    );
    // 0.5·255 = 127.5, to even 128; 0.1·255 = 25.5 and a little (0.1 is 0.100000001…): 26; 0.5·4096, 1.5·4096, 409.6.
    assert_eq!(
        value.text(Format::Fixed),
        "gf3 128/255, -255/255 (clamped), 26/255; r200 2048/4096, -6144/4096, 410/4096"
    );
    assert_eq!(value.text(Format::Colour), "#80001a");
    assert_eq!(pixel("1").unwrap().text(Format::Colour), "#ffffff");
    assert_eq!(number_text(f32::MAX), "3.4028235e38");
    assert_eq!(number_text(1e-5), "0.00001");
    assert_eq!(number_text(-0.0), "-0");
    for format in [Format::Float, Format::Hex, Format::Fixed, Format::Colour] {
        assert_eq!(format.letter().to_string().parse(), Ok(format));
    }
    assert!("z".parse::<Format>().is_err());
}

#[test]
fn log_messages_hold_expressions() {
    let owned = Owned::new(PIXEL);
    let mut session = owned.session(&[("v0", &[0.5, 0.25, 1.0, 0.125])]);
    while session.step() {}
    let text = |message: &str| -> String {
        let message: LogMessage = message.parse().unwrap();
        message.text(&session.scope().unwrap())
    };
    assert_eq!(text("r0 is {r0.rg} here"), "r0 is 0.5, 0.25 here");
    assert_eq!(text("{r0.r:x}{{}}"), "0x3f000000{}");
    assert_eq!(text("{r9}"), "<ps.1.4 has no r9; it has r0 to r5>");
    assert_eq!(text(""), "");
    let wrong = |message: &str| message.parse::<LogMessage>().unwrap_err();
    assert_eq!(wrong("ab {r0").at, 3..6);
    assert_eq!(wrong("ab }").at, 3..4);
    assert_eq!(wrong("ab {r0.q}").at, 6..8);
    assert!(wrong("{r0:d}").message.contains("/x"));
}

proptest! {
    /// Whatever is typed is read or refused, and what is read has a value or none.
    #[test]
    fn no_text_panics(words in prop::collection::vec(prop::sample::select(vec![
        "r0", "r1.xy", "c[", "]", "(", ")", "+", "-", "*", "/", "<", "==", "&&", "||", "!", ",", "1", "0.5", "1e9",
        ".x", ".rgba", "_bx2", "_dz", "dp3(", "normalize(", "min(", "lrp(", "a0", "t0", "tc1", "depth", "killed", "é", ".",
        "oPos", "nan", "inf", "c9", "c99999999999", "r0_dw", " ",
    ]), 0..24), text in ".{0,20}") {
        let _ = pixel(&words.concat());
        let _ = pixel(&words.join(" "));
        let _ = pixel(&text);
        let _ = text.parse::<LogMessage>();
        let _ = words.concat().parse::<LogMessage>();
    }
}
