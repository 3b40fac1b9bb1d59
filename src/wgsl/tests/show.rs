//! Shaders that are cut and return a register.

use super::support::{Shader, valid, valid_pair};
use crate::kernel::Slot;
use crate::raster::{Compare, FogDistance, FogMode};
use crate::wgsl::{Fog, Options, Shown, ShownPixels};

const LISTING: &str = "\
ps.1.4
def c0, 1, 0.5, 0.25, 0
texld r0, t0
texcrd r1.rgb, t1
texkill r1
phase
texld r2, r0
+mul r0.rgb, r2, c0
mov r0.a, c1
add r3.r, r0, v0
";

fn show(slot: Option<Slot>, instructions: usize, pixels: ShownPixels) -> Options {
    Options {
        show: Some(Shown {
            slot: slot.unwrap(),
            instructions,
            pixels,
        }),
        ..Options::default()
    }
}

/// What the pixel stage returns.
fn returned(source: &str) -> &str {
    let (_, rest) = source.rsplit_once("return ").unwrap();
    rest.split_once(';').unwrap().0
}

/// Every register at every place of shaders with discards, a depth, bump and matrix rows; of those that a pixel shader
/// does not have too, for who asks for them must not get WGSL that no device takes.
#[test]
fn every_cut_is_valid() {
    let listings = [
        LISTING,
        "ps.1.1\ntex t0\ntexbem t1, t0\ntexm3x3pad t2, t0\n",
        "ps.1.3\ntex t0\ntexm3x2pad t1, t0\ntexm3x2depth t2, t0\nmov r0, t0\n",
        "ps.1.4\ntexcrd r5.rgb, t0\nphase\ntexdepth r5\nmov r0, r5\n",
        "ps.1.1\ntex t0\ntexkill t1\nmul r0.rgb, t0, v0\n+mov r0.a, v1\n",
    ];
    let vertex = Shader::new("vs.1.1\nm4x4 oPos, v0, c0\nmov oT0, v7\nmov oD0, v5\n");
    for listing in listings {
        // The third listing does not end its matrix, which the translator does not mind.
        let pixel = Shader::new(listing);
        let instructions = pixel.program.instructions().count();
        for slot in Slot::all() {
            for most in [0, 2, instructions] {
                for pixels in [ShownPixels::All, ShownPixels::Kept, ShownPixels::Discarded] {
                    let mut options = show(Some(slot), most, pixels);
                    options.fog = Some(Fog {
                        table: FogMode::Linear,
                        distance: FogDistance::W,
                    });
                    options.alpha_test = Some(Compare::Greater);
                    valid_pair(&vertex, &pixel, &options);
                }
            }
        }
    }
}

#[test]
fn the_shader_ends_after_so_many_instructions() {
    let cut = |most| valid(LISTING, &show(Slot::temp(2), most, ShownPixels::All)).source;
    // The fifth instruction is the second `texld`; `phase` is the fourth.
    assert!(!cut(4).contains("texld r2"), "{}", cut(4));
    assert!(
        cut(5).contains("texld r2") && !cut(5).contains("mul r0"),
        "{}",
        cut(5)
    );
    assert!(cut(5).contains("textureSample(texture2"));
    assert_eq!(returned(&cut(4)), "r2");
}

/// An input that nothing reads is passed all the same if it is shown, and with all components.
#[test]
fn inputs_come_whole() {
    let vertex = Shader::new("vs.1.1\nm4x4 oPos, v0, c0\nmov oT0, v7\nmov oT5, v7\n");
    let pixel = Shader::new("ps.1.4\ntexld r0, t0\n");
    let shown = |slot| valid_pair(&vertex, &pixel, &show(slot, 0, ShownPixels::All)).source;
    assert_eq!(returned(&shown(Slot::texcoord(5))), "in.t5");
    assert!(shown(Slot::texcoord(5)).contains("@location(5) t5: vec4f"));
    assert!(shown(Slot::texcoord(0)).contains("@location(0) t0: vec4f"));
    // A colour is what the shader sees of it: clamped.
    let color = shown(Slot::input(1));
    assert!(color.contains("let v1 = saturate(in.v1);") && returned(&color) == "v1");
}

/// What becomes of a pixel is decided by the whole shader: where that may discard it or replaces its depth, the register is
/// kept and the shader goes on. Otherwise it ends.
#[test]
fn the_shader_goes_on_where_that_decides() {
    let text = |listing: &str, most, pixels| {
        let shader = valid(listing, &show(Slot::temp(2), most, pixels));
        shader.source
    };
    let kept = text(LISTING, 0, ShownPixels::Kept);
    let at = |part: &str| {
        kept.find(part)
            .unwrap_or_else(|| panic!("{part} in {kept}"))
    };
    assert!(at("let shown = r2;") < at("texld r2") && at("texld r2") < at("if killed {"));
    assert_eq!(returned(&kept), "shown");
    let discarded = text(LISTING, 0, ShownPixels::Discarded);
    assert!(discarded.contains("if !killed {"), "{discarded}");
    // All instructions have run at the end.
    let end = text(LISTING, usize::MAX, ShownPixels::Kept);
    assert_eq!(returned(&end), "r2");
    // Nothing here discards.
    let plain = LISTING.replace("texkill r1\n", "");
    let cut = text(&plain, 0, ShownPixels::Kept);
    assert!(!cut.contains("texld r2") && returned(&cut) == "r2", "{cut}");
    let depth = "ps.1.4\ntexcrd r5.rgb, t0\nphase\ntexdepth r5\nmov r2, r5\nmov r0, r2\n";
    let depth = text(depth, 1, ShownPixels::Kept);
    assert_eq!(returned(&depth), "PixelOutput(shown, depth)");
}

/// Between the halves of a pair the first has written what is shown, but the second reads what was there before.
#[test]
fn between_the_halves_of_a_pair() {
    let listing =
        "ps.1.4\ntexcrd r1.rgb, t1\ntexkill r1\nmov r2.rgb, c0\n+mov r2.a, r2.b\nmov r0, r2\n";
    let source = valid(listing, &show(Slot::temp(2), 3, ShownPixels::Kept)).source;
    let at = |part: &str| {
        let found = source.match_indices(part).map(|(at, _)| at);
        found.collect::<Vec<_>>()
    };
    let (before, back) = (at("let before_shown = r2;"), at("r2 = before_shown;"));
    let (shown, second) = (at("let shown = r2;"), at("r2.b;"));
    assert!(before < shown && shown < back && back < second, "{source}");
    assert!(
        [before, shown, back, second]
            .iter()
            .all(|found| found.len() == 1),
        "{source}"
    );
}

/// Fog and alpha test have no part in what is shown.
#[test]
fn what_takes_the_pixel_out() {
    let text = |pixels| {
        let mut options = show(Slot::temp(0), usize::MAX, pixels);
        options.alpha_test = Some(Compare::Greater);
        options.fog = Some(Fog {
            table: FogMode::None,
            distance: FogDistance::Z,
        });
        valid(LISTING, &options).source
    };
    let kept = text(ShownPixels::Kept);
    assert!(
        kept.contains("if killed {") && !kept.contains("fog_color"),
        "{kept}"
    );
    assert!(!text(ShownPixels::All).contains("discard"));
}
