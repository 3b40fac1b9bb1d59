//! Shaders that are cut and return a register.

use super::support::{Shader, valid, valid_pair};
use crate::kernel::Slot;
use crate::raster::{Compare, FogDistance, FogMode, RegisterPicture, View};
use crate::wgsl::{Fog, Options};

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

fn show(slot: Option<Slot>, instructions: usize, view: View) -> Options {
    Options {
        show: Some(RegisterPicture {
            slot: slot.unwrap(),
            instructions,
            view,
            absolute: false,
            scale: 1.0,
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
                for view in [
                    View::Exact,
                    View::Color,
                    View::Component(2),
                    View::Magnitude,
                ] {
                    let mut options = show(Some(slot), most, view);
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
    let cut = |most| valid(LISTING, &show(Slot::temp(2), most, View::Exact)).source;
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
    let shown = |slot| valid_pair(&vertex, &pixel, &show(slot, 0, View::Exact)).source;
    assert_eq!(returned(&shown(Slot::texcoord(5))), "in.t5");
    assert!(shown(Slot::texcoord(5)).contains("@location(5) t5: vec4f"));
    assert!(shown(Slot::texcoord(0)).contains("@location(0) t0: vec4f"));
    // A colour is what the shader sees of it: clamped.
    let color = shown(Slot::input(1));
    assert!(color.contains("let v1 = saturate(in.v1);") && returned(&color) == "v1");
}

#[test]
fn the_views() {
    let shown = |view, absolute, scale| {
        let mut options = show(Slot::temp(3), usize::MAX, view);
        let picture = options.show.as_mut().unwrap();
        (picture.absolute, picture.scale) = (absolute, scale);
        returned(&valid(LISTING, &options).source).to_string()
    };
    assert_eq!(shown(View::Color, false, 1.0), "vec4f(r3.rgb, 1.0)");
    assert_eq!(
        shown(View::Color, true, -0.5),
        "vec4f(abs(r3.rgb) * -0.5, 1.0)"
    );
    assert_eq!(
        shown(View::Component(3), false, 1.0),
        "vec4f(vec3f(r3.a), 1.0)"
    );
    assert_eq!(
        shown(View::Magnitude, false, 2.0),
        "vec4f(vec3f(length(r3.rgb) * 2.0), 1.0)"
    );
    assert_eq!(shown(View::Exact, true, 1.0), "abs(r3)");
}

/// `texkill` takes the pixel out of a picture, as on the CPU, but not out of a comparison of registers; fog and alpha test
/// have no part in either.
#[test]
fn what_takes_the_pixel_out() {
    let text = |view| {
        let mut options = show(Slot::temp(0), usize::MAX, view);
        options.alpha_test = Some(Compare::Greater);
        options.fog = Some(Fog {
            table: FogMode::None,
            distance: FogDistance::Z,
        });
        valid(LISTING, &options).source
    };
    let color = text(View::Color);
    assert!(
        color.contains("if killed {") && !color.contains("fog_color"),
        "{color}"
    );
    assert!(!text(View::Exact).contains("discard"));
}
