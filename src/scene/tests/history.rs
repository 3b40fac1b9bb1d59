//! What happened at one pixel.

use super::*;
use crate::kernel::Slot;
use crate::raster::Fate;
use crate::scene::PixelEvent;

/// Red in front; green behind it; blue that is discarded; a quarter of green added; white beside the pixel.
#[test]
fn every_primitive_that_covers_the_pixel() {
    let whole = quad([-1.0, -1.0, 1.0, 1.0]);
    let draw = |color: &str, z: &str, more: &str| {
        format!(
            "[[draw]]\nmesh = \"all\"\nvs_text = \"vs.1.1\\nadd oPos, v0, c0\\nmov oT0, c1\\n\"\n\
             vs_constants = {{ c0 = [0, 0, {z}], c1 = -1 }}\nps_constants.c0 = {color}\n{more}\n"
        )
    };
    let plain = "ps = \"c0.psh\"";
    let kill = "ps_text = \"ps.1.1\\ntexkill t0\\nmov r0, c0\\n\"";
    let added = "ps = \"c0.psh\"\nstate = { alpha_blend = true, src_blend = \"one\", dest_blend = \"one\" }";
    let scene = loaded(&format!(
        "size = [4, 4]\n[meshes.all]\n{whole}\n{}{}{}{}\n[meshes.left]\n{}\n\
         [[draw]]\nmesh = \"left\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\nps_constants.c0 = 1\n",
        draw("[1, 0, 0, 1]", "0", plain),
        draw("[0, 1, 0, 1]", "0.25", plain),
        draw("[0, 0, 1, 1]", "0", kill),
        draw("[0, 0.25, 0, 0]", "0", added),
        quad([-1.0, -1.0, 0.0, 1.0]),
    ));
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    // Below the diagonal from the upper left corner: the second triangle.
    let events = rendering.history([2, 3]).unwrap();
    let event = |draw, fate, after| PixelEvent {
        draw,
        primitive: 1,
        fate,
        after,
    };
    let red = [255, 0, 0, 255];
    assert_eq!(
        events,
        [
            event(0, Fate::Written, red),
            event(1, Fate::Rejected, red),
            event(2, Fate::Killed, red),
            // 0.25 · 255 = 63.75.
            event(3, Fate::Written, [255, 64, 0, 255]),
        ]
    );
    assert_eq!(rendering.history([1, 3]).unwrap().len(), 5);
    assert_eq!(rendering.history([4, 0]).unwrap(), []);
    let draws = scene.passes([4, 4]).pop().unwrap().draws;
    let trace = rendering.trace(&draws[2], 1, [2, 3]).unwrap().unwrap();
    // `texkill` reads t0, which every vertex gives as −1.
    assert_eq!(trace.inputs, [(Slot::texcoord(0).unwrap(), [-1.0; 4])]);
    assert_eq!(trace.trace.killed_by, Some(0));
    assert_eq!(
        trace.trace.changes.last().unwrap().after,
        [0.0, 0.0, 1.0, 1.0]
    );
    assert_eq!(rendering.trace(&draws[2], 0, [2, 3]).unwrap(), None);
}

/// With texture, mips, fog, alpha test, stencil and blending: the history of every pixel ends in the picture.
#[test]
fn the_last_colour_is_that_of_the_picture() {
    let scene = loaded(
        r#"
size = [48, 36]
clear = [0.1, 0.2, 0.3, 1]
[camera]
position = [0, 1, -3]
look_at = [0, 0, 0]
[meshes.ring]
shape = "torus"
segments = 16
tube_segments = 8
[meshes.ball]
shape = "sphere"
slices = 12
stacks = 8
[textures.board]
generate = "checker"
size = [32, 32]
colors = [[1, 0.2, 0, 0.2], [0, 1, 1, 0.9]]
[[draw]]
mesh = "ring"
vs_text = "vs.1.1\nm4x4 oPos, v0, c0\nmov oT0, v7\nmov oFog, c4.x\n"
ps = "stage0.psh"
vs_constants = { c0 = "world_view_projection", c4 = 0.75 }
stages.0 = { texture = "board", filter = "linear", mip = "linear" }
[draw.state]
alpha_test = true
alpha_func = "greater"
alpha_ref = 100
fog = { color = [1, 1, 1] }
stencil = { func = "always", pass = "incr" }
[[draw]]
mesh = "ball"
vs_text = "vs.1.1\nm4x4 oPos, v0, c0\nmov oT0, v3\n"
ps_text = "ps.1.1\ntexkill t0\nmov r0, c0\n"
vs_constants.c0 = "world_view_projection"
ps_constants.c0 = [0.5, 0, 1, 0.5]
[draw.state]
cull = "none"
alpha_blend = true
src_blend = "srcalpha"
dest_blend = "invsrcalpha"
stencil = { func = "notequal", ref = 2 }
"#,
    );
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let mut fates = [0; 3];
    for (y, x) in (0..36).flat_map(|y| (0..48).map(move |x| (y, x))) {
        let events = rendering.history([x, y]).unwrap();
        let clear = [26, 51, 77, 255];
        let last = events.last().map_or(clear, |event| event.after);
        assert_eq!(
            Some(last),
            rendering.picture().color(x, y),
            "{x}, {y}: {events:?}"
        );
        events
            .iter()
            .for_each(|event| fates[event.fate as usize] += 1);
    }
    // Of each something, or nothing was tested.
    assert!(fates.iter().all(|count| *count > 20), "{fates:?}");
}
