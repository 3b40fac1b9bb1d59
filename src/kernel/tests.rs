//! The shape of kernels: what becomes of an instruction before anything runs.

use super::*;
use crate::diagnostic::SourceMap;
use crate::syntax;

fn lowered(listing: &str) -> Result<Kernel, LowerError> {
    let mut sources = SourceMap::new();
    let parsed = syntax::parse(sources.add("test", listing).unwrap());
    lower(&parsed.program.unwrap(), &Options::default())
}

fn ops(listing: &str) -> Vec<Op> {
    let kernel = lowered(listing).unwrap();
    kernel.steps.iter().map(|s| s.op).collect()
}

#[test]
fn macros_become_their_rows() {
    let kernel = lowered("vs.1.1\nm4x3 oPos, v0, c4\n").unwrap();
    let rows: Vec<_> = (kernel.steps.iter())
        .map(|s| (s.op, s.mask, s.sources[1].place))
        .collect();
    let row = |mask, c| (Op::Dp4, mask, Place::Constant(c));
    let expected = [
        row(WriteMask::X, 4),
        row(WriteMask::Y, 5),
        row(WriteMask::Z, 6),
    ];
    assert_eq!(rows, expected);
    // A wider mask writes no further component, a narrower one leaves rows out.
    assert_eq!(ops("vs.1.1\nm3x3 r0, v0, c4\nmov oPos, v0\n").len(), 4);
    assert_eq!(ops("vs.1.1\nm3x3 r0.y, v0, c4\nmov oPos, v0\n").len(), 2);
}

#[test]
fn only_what_would_be_overwritten_is_held() {
    let held = |listing: &str| -> Vec<bool> {
        let kernel = lowered(listing).unwrap();
        kernel.steps.iter().map(|s| s.held).collect()
    };
    // The second half reads what the first writes.
    assert_eq!(
        held("ps.1.1\nmov r0.rgb, v0\n+mov r1.a, r0.a\n"),
        [false, false]
    );
    assert_eq!(
        held("ps.1.1\nmov r0.rgb, v0\n+mov r1.a, r0.b\n"),
        [true, false]
    );
    assert_eq!(
        held("ps.1.1\nmov r0.a, v0\n+mul r0.rgb, r0.a, v0\n"),
        [true, false]
    );
    // Two instructions that are no pair.
    assert_eq!(held("ps.1.1\nmov r0, v0\nmov r1, r0\n"), [false, false]);
    // A divided coordinate is an intermediate, not a pair.
    assert_eq!(held("ps.1.4\ntexcrd r0.rg, t0_dw.xyw\n"), [false, false]);
}

#[test]
fn instructions_over_several_lines_are_joined() {
    let listing =
        "ps.1.1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3vspec t3, t0\nmov r0, t3\n";
    use Op::*;
    let expected = [
        Sample(0),
        Dp3,
        Dp3,
        Dp3,
        Mov,
        Mov,
        Mov,
        Reflect,
        Sample(3),
        Mov,
    ];
    assert_eq!(ops(listing), expected);
    let kernel = lowered(listing).unwrap();
    // The pads are instructions of their own, everything else belongs to the last line.
    let origins: Vec<_> = kernel.steps.iter().map(|s| s.origin).collect();
    assert_eq!(origins, [0, 1, 2, 3, 3, 3, 3, 3, 3, 4]);
    assert_eq!(kernel.stages(), 0b1001);
}

/// `t1` as a source is what was sampled; as a destination it names coordinate set 1.
#[test]
fn coordinates_and_texels_are_different_slots() {
    let kernel = lowered("ps.1.1\ntex t0\ntexbem t1, t0\nmov r0, t1\n").unwrap();
    let bump = &kernel.steps[1];
    assert_eq!(bump.op, Op::Bump(1));
    assert_eq!(
        bump.sources[0].place,
        Place::Slot(Slot::texcoord(1).unwrap())
    );
    assert_eq!(
        bump.sources[1].place,
        Place::Slot(Slot::texture(0).unwrap())
    );
    // Read without having been sampled it is the coordinates, as far as it has a meaning at all.
    let kernel = lowered("ps.1.1\nmov r0, t1\n").unwrap();
    let load = &kernel.steps[0];
    assert_eq!(load.destination, Slot::texture(1).unwrap());
    assert_eq!(
        load.sources[0].place,
        Place::Slot(Slot::texcoord(1).unwrap())
    );
}

#[test]
fn scalar_outputs_take_the_component_that_is_written() {
    let fog = |mask: &str| {
        let listing = format!("vs.1.1\nmov oPos, v0\nmov oFog{mask}, v1\n");
        lowered(&listing).unwrap().fog_component
    };
    assert_eq!([fog(""), fog(".x"), fog(".w")], [0, 0, 3]);
}

#[test]
fn what_has_no_meaning_is_refused() {
    for (listing, why) in [
        ("ps.1.1\ncmp r0, v0, c0, c1\n", "ps.1.1 has no cmp"),
        ("ps.1.1\nmov r5, v0\n", "ps.1.1 has no r5"),
        ("ps.1.1\nmov c0, v0\n", "mov cannot have c0 as destination"),
        ("vs.1.1\nmov r0, oD0\n", "mov cannot read oD0 there"),
        ("ps.1.1\nmov r0, c8\n", "ps.1.1 has no constant c8"),
        (
            "ps.1.1\ntex t0\ntexm3x2tex t1, t0\nmov r0, t1\n",
            "texm3x2tex completes 1 rows, but 0 came",
        ),
    ] {
        let error = lowered(listing).unwrap_err();
        assert!(error.message.contains(why), "{listing}: {}", error.message);
        assert!(error.span.start >= 7, "the place is an instruction");
    }
}

#[test]
fn slots_have_the_names_of_listings() {
    use crate::isa::ShaderKind::{Pixel, Vertex};
    assert_eq!(Slot::FOG.name(Vertex), "oFog");
    assert_eq!(Slot::texcoord_output(7).unwrap().name(Vertex), "oT7");
    assert_eq!(Slot::ADDRESS.name(Vertex), "a0");
    assert_eq!(Slot::texture(3).unwrap().name(Pixel), "t3");
    assert_eq!(Slot::temp(5).unwrap().name(Pixel), "r5");
    assert_eq!(Slot::all().filter(|s| s.is_internal()).count(), 4);
}
