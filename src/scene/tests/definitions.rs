//! How long `def` holds, from draw to draw (registers.md, 2.2): Direct3D 8 loads definitions into the one file of constants when a
//! shader is set, in Direct3D 9 they belong to their shader.

use super::*;
use crate::policy::{DefLifetime, Policies};

/// Four draws, a column each: a shader that defines c0; one that reads what is there; one whose draw sets c0; one that reads again.
const SCENE: &str = r#"
size = [4, 1]
clear = [0, 0, 1, 1]
[[draw]]
mesh = "a"
vs_text = """
vs.1.1
def c9, 0, 0.5, 0, 1
mov oPos, v0
mov oD0, c9
"""
ps_text = """
ps.1.1
def c0, 1, 0, 0, 1
mov r0, c0
"""
[[draw]]
mesh = "b"
vs_text = """
vs.1.1
mov oPos, v0
mov oD0, c9
"""
ps_text = """
ps.1.1
add r0, c0, v0
"""
[[draw]]
mesh = "c"
vs = "flat.vsh"
ps_text = """
ps.1.1
def c0, 1, 0, 0, 1
mov r0, c0
"""
ps_constants.c0 = [0, 1, 1, 1]
[[draw]]
mesh = "d"
vs = "flat.vsh"
ps_text = """
ps.1.1
mov r0, c0
"""
"#;

fn columns(def: DefLifetime) -> Vec<[u8; 4]> {
    let mut text = SCENE.to_owned();
    for (name, place) in ["a", "b", "c", "d"].into_iter().zip(0_u8..) {
        let left = f32::from(place) / 2.0 - 1.0;
        let mesh = quad([left, -1.0, left + 0.5, 1.0]);
        text.push_str(&format!("[meshes.{name}]\n{mesh}"));
    }
    let options = LoadOptions {
        policies: Policies {
            def,
            ..Policies::default()
        },
        ..LoadOptions::default()
    };
    let scene = Scene::load("scene.toml", text.as_bytes(), &files(), &options);
    let scene = scene.unwrap_or_else(|error| panic!("{error}"));
    let rendered = scene.render(&RenderOptions::default(), &|_| {}).unwrap();
    pixels(&rendered)
}

#[test]
fn definitions_stay_for_the_draws_behind() {
    // Red; c0 is still red, and c9 half green (127.5 of 255, up); what the draw sets replaces the definition; it stays, too.
    assert_eq!(
        columns(DefLifetime::WhenSet),
        [
            [255, 0, 0, 255],
            [255, 128, 0, 255],
            [0, 255, 255, 255],
            [0, 255, 255, 255]
        ]
    );
}

#[test]
fn definitions_that_always_hold_leave_nothing() {
    // Red; nobody sets c0 and c9 of the second; the definition wins over what is set; nobody sets c0 of the last.
    assert_eq!(
        columns(DefLifetime::Always),
        [[255, 0, 0, 255], [0; 4], [255, 0, 0, 255], [0; 4]]
    );
}
