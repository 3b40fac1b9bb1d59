//! What happened at one pixel.

use super::*;
use crate::exec::Machine;
use crate::kernel::Slot;
use crate::raster::{Fate, Stored, vertex_outputs};
use crate::scene::{MAX_EVENTS, Output};

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
    let told = |pixel| {
        let history = rendering.history(Output::Picture, pixel).unwrap();
        assert_eq!(history.left_out, 0);
        history.events
    };
    let events = told([2, 3]);
    let red = [255, 0, 0, 255];
    let seen: Vec<_> = (events.iter())
        .map(|event| (event.draw, event.merge.fate(), event.merge.after.color))
        .collect();
    assert_eq!(
        seen,
        [
            (0, Fate::Written, red),
            (1, Fate::Depth, red),
            (2, Fate::Killed, red),
            // 0.25 · 255 = 63.75.
            (3, Fate::Written, [255, 64, 0, 255]),
        ]
    );
    for event in &events {
        assert_eq!(event.fragment.primitive, 1);
        assert_eq!(event.fragment.vertices, [0, 2, 3]);
    }
    // At z = 0.5 + 0.25 behind 0.5.
    let depth = events[1].merge.depth.unwrap();
    assert_eq!((depth.incoming, depth.stored), (0.75, 0.5));
    assert_eq!(told([1, 3]).len(), 5);
    assert_eq!(told([4, 0]), []);
    let trace = |draw: usize| {
        let shaded = rendering.shaded(Output::Picture, draw).unwrap();
        let fragment = &events[draw].fragment;
        shaded.program().trace(&fragment.batch, fragment.lane)
    };
    // `texkill` reads t0, which every vertex gives as −1.
    let killed = trace(2);
    assert_eq!(killed.inputs, [(Slot::texcoord(0).unwrap(), [-1.0; 4])]);
    assert_eq!(killed.trace.killed_by, Some(0));
    assert_eq!(
        killed.trace.changes.last().unwrap().after,
        [0.0, 0.0, 1.0, 1.0]
    );
    assert!(rendering.shaded(Output::Picture, 5).is_none());
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
stencil = { func = "notequal", ref = 1 }
"#,
    );
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let mut fates: BTreeMap<&str, usize> = BTreeMap::new();
    for (y, x) in (0..36).flat_map(|y| (0..48).map(move |x| (y, x))) {
        let history = rendering.history(Output::Picture, [x, y]).unwrap();
        let picture = rendering.picture();
        assert_eq!(history.clear.color, [26, 51, 77, 255]);
        let Stored {
            color,
            depth,
            stencil,
        } = history.after();
        let drawn = (
            picture.color(x, y).unwrap(),
            picture.depth(x, y).unwrap(),
            picture.stencil(x, y).unwrap(),
        );
        assert_eq!((color, depth, stencil), drawn, "{x}, {y}: {history:?}");
        for event in &history.events {
            *fates.entry(event.merge.fate().name()).or_default() += 1;
        }
    }
    // Of each something, or nothing was tested.
    let names: Vec<_> = fates.keys().copied().collect();
    assert_eq!(names, ["alpha", "depth", "killed", "stencil", "written"]);
    assert!(fates.values().all(|count| *count > 10), "{fates:?}");
}

/// A debugger's way into the shaders of a pixel: its vertices and its quad, run one by one.
#[test]
fn vertices_and_quads_run_again_give_the_same() {
    let scene = loaded(
        r#"
size = [32, 24]
[camera]
position = [0, 1, -3]
look_at = [0, 0, 0]
[meshes.ball]
shape = "sphere"
slices = 12
stacks = 8
[textures.board]
generate = "checker"
size = [32, 32]
colors = [[1, 0.2, 0, 0.2], [0, 1, 1, 0.9]]
[[draw]]
mesh = "ball"
vs_text = "vs.1.1\nm4x4 oPos, v0, c0\nmov oT0, v7\nmov oD0, v3\n"
ps_text = "ps.1.1\ntex t0\nmul r0, t0, v0\n"
vs_constants.c0 = "world_view_projection"
stages.0 = { texture = "board", filter = "linear", mip = "linear" }
"#,
    );
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let history = rendering.history(Output::Picture, [16, 12]).unwrap();
    let [event] = history.events.as_slice() else {
        panic!("{history:?}");
    };
    let shaded = rendering.shaded(Output::Picture, event.draw).unwrap();
    let draw = shaded.draw();
    for index in event.fragment.vertices.map(|index| index as usize) {
        let mut machine = Machine::<1>::new();
        for (register, value) in draw.inputs(index).into_iter().enumerate() {
            machine.load(Slot::input(register).unwrap(), value);
        }
        machine.run(&draw.vertex.kernel, &draw.vertex_environment());
        let vertex = vertex_outputs(&draw.vertex.kernel, |slot| machine.lane(slot, 0));
        assert_eq!(Some(vertex), shaded.vertices().get(index));
    }
    let program = shaded.program();
    let mut machine = Machine::<4>::new();
    program.load(&mut machine, &event.fragment.batch);
    machine.run(program.kernel, shaded.environment());
    let color = machine.lane(Slot::R0, event.fragment.lane);
    assert_eq!(color, event.merge.shaded);
    assert!(color[..3].iter().any(|channel| *channel > 0.0), "{color:?}");
}

/// The faces of a cube that the picture samples, and a flat target that nobody does.
#[test]
fn pixels_of_render_targets_have_a_history_too() {
    let scene = loaded(&format!(
        r#"
size = [8, 8]
draws = ["show"]
[targets.room]
kind = "cube"
size = 8
from = [0.2, 0, 0]
clear = [0, 0, 1, 1]
draws = ["ball"]
[targets.unused]
size = 4
draws = ["ball"]
[textures.room]
target = "room"
[meshes.ball]
shape = "sphere"
slices = 9
stacks = 6
[meshes.all]
{}
[[draw]]
name = "ball"
mesh = "ball"
vs_text = "vs.1.1\nm4x4 oPos, v0, c0\nmov oD0, v3\n"
ps_text = "ps.1.1\nmov r0, v0\n"
vs_constants.c0 = "world_view_projection"
state = {{ cull = "none" }}
[[draw]]
name = "show"
mesh = "all"
vs_text = "vs.1.1\nmov oPos, v0\nmov oT0, v0\n"
ps = "stage0.psh"
stages.0.texture = "room"
"#,
        quad([-1.0, -1.0, 1.0, 1.0])
    ));
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let outputs: Vec<Output> = rendering.passes().iter().map(|pass| pass.output).collect();
    let room = |face| Output::Target { target: 0, face };
    let expected: Vec<Output> = (0..6).map(room).chain([Output::Picture]).collect();
    assert_eq!(outputs, expected);
    let mut covered = 0;
    for output in outputs {
        let drawn = rendering.drawn(output).unwrap();
        for (y, x) in (0..8).flat_map(|y| (0..8).map(move |x| (y, x))) {
            let history = rendering.history(output, [x, y]).unwrap();
            assert_eq!(Some(history.after().color), drawn.color(x, y));
            assert_eq!(Some(history.after().depth), drawn.depth(x, y));
            covered += usize::from(!history.events.is_empty());
        }
    }
    // Inside of a ball every direction meets it: 6 faces and the picture, of 64 pixels each.
    assert_eq!(covered, 7 * 64);
    let unused = Output::Target { target: 1, face: 0 };
    assert_eq!(rendering.history(unused, [0, 0]).unwrap().events, []);
    assert!(rendering.drawn(unused).is_none() && rendering.pass(unused).is_none());
}

/// More primitives at a pixel than are told of.
#[test]
fn only_the_last_events_are_kept() {
    let corner = "[-1, 1, 0.5], [1, 1, 0.5], [-1, -1, 0.5]";
    let triangles = MAX_EVENTS + 3;
    let indices = vec!["0, 1, 2"; triangles].join(", ");
    let scene = loaded(&format!(
        "size = [2, 2]\n[meshes.stack]\npositions = [{corner}]\nindices = [{indices}]\n\
         [[draw]]\nmesh = \"stack\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\nps_constants.c0 = 0.003\n\
         state = {{ alpha_blend = true, src_blend = \"one\", dest_blend = \"one\" }}\n"
    ));
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let history = rendering.history(Output::Picture, [0, 0]).unwrap();
    assert_eq!((history.events.len(), history.left_out), (MAX_EVENTS, 3));
    assert_eq!(history.events[0].fragment.primitive, 3);
    // 0.003 · 255 = 0.765 is a step each time.
    assert_eq!(history.events[0].merge.before.color, [3, 3, 3, 255]);
    assert_eq!(history.after().color, [255; 4]);
}
