use super::*;
use crate::raster::Fate;
use crate::scene::{LoadOptions, Output, RenderOptions, Rendering, Scene};

fn scene(text: &str) -> Scene {
    let files = std::collections::BTreeMap::<String, Vec<u8>>::new();
    Scene::load(
        "scene.toml",
        text.as_bytes(),
        &files,
        &LoadOptions::default(),
    )
    .unwrap_or_else(|error| panic!("{error}"))
}

/// A ball with everything around the shader in use, drawn twice, the second time blended; and points as sprites.
const SCENE: &str = r#"
size = [24, 18]
clear = [0.1, 0.2, 0.3, 1]
[camera]
position = [0, 1, -3]
look_at = [0, 0, 0]
[meshes.ball]
shape = "sphere"
slices = 9
stacks = 6
[meshes.dots]
positions = [[0.9, 0.5, -0.5], [-0.9, 0.4, -0.5]]
[textures.board]
generate = "checker"
size = [32, 32]
colors = [[1, 0.2, 0, 0.2], [0, 1, 1, 0.9]]
[[draw]]
name = "ball"
mesh = "ball"
vs_text = "vs.1.1\nm4x4 oPos, v0, c0\nmov oT0, v7\nadd oD0, v3, v3\nmov oFog, v3.y\n"
ps_text = "ps.1.1\ntex t0\nmul r0, t0, v0\n"
vs_constants.c0 = "world_view_projection"
stages.0 = { texture = "board", filter = "linear", mip = "linear" }
state = { fog = { enable = true, color = [1, 0, 1] } }
[[draw]]
name = "shell"
mesh = "ball"
vs_text = "vs.1.1\nm4x4 oPos, v0, c0\nmov oT0, v7\nmov oD0, v3\n"
ps_text = "ps.1.4\ntexcrd r0.rgb, t0\nphase\nadd r0.rgb, r0, v0\n+mov r0.a, c0.a\n"
vs_constants.c0 = "world_view_projection"
ps_constants.c0 = 0.5
state = { shade = "flat", z_func = "lessequal", alpha_blend = true, src_blend = "srcalpha", dest_blend = "invsrcalpha" }
[[draw]]
name = "dots"
mesh = "dots"
topology = "pointlist"
vs_text = "vs.1.1\nm4x4 oPos, v0, c0\nmov oPts.x, c4.x\n"
ps_text = "ps.1.1\ntexkill t0\ntexcoord t1\nmov r0, t1\n"
vs_constants.c0 = "world_view_projection"
vs_constants.c4 = 6
state = { point_sprite = true, alpha_test = true, alpha_func = "greater", alpha_ref = 3 }
"#;

/// Recorded runs of every primitive at every pixel agree with the frame, to the bit: the vertices with the vertex shader, the
/// inputs with the interpolation, `r0` and the pixel with the merger.
#[test]
fn recorded_pixels_are_those_of_the_frame() {
    let scene = scene(SCENE);
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let [width, height] = rendering.size();
    let mut covered = [0; 3];
    for pixel in (0..height).flat_map(|y| (0..width).map(move |x| [x, y])) {
        let subject = match PixelSubject::new(&rendering, pixel, &Which::default()) {
            Ok(subject) => subject,
            Err(PixelError::Empty { .. }) => continue,
            Err(error) => panic!("{error}"),
        };
        for event in 0..subject.history().events.len() {
            covered[subject.history().events[event].draw] += 1;
            agrees(&rendering, subject.with_event(event).unwrap());
        }
        let held = subject.history().after().color;
        assert_eq!(rendering.picture().color(pixel[0], pixel[1]), Some(held));
    }
    assert!(covered.iter().all(|count| *count > 30), "{covered:?}");
}

fn agrees(rendering: &Rendering<'_>, subject: PixelSubject<'_>) {
    let event = subject.history().events[subject.event()].clone();
    let shaded = rendering.shaded(Output::Picture, event.draw).unwrap();
    let session = Session::new(Subject::Pixel(subject));
    let (pixel, vertices) = session.runs().split_last().unwrap();
    for run in vertices {
        let RunKind::Vertex { vertex, .. } = run.kind else {
            panic!("{:?}", run.kind);
        };
        let registers = run.registers(usize::MAX);
        let position = registers.slot(Slot::POSITION, 0);
        let shaded = shaded.vertices().get(vertex as usize).unwrap();
        assert_eq!(position, shaded.position.to_array());
    }
    let batch = &event.fragment.batch;
    for moment in pixel
        .moments
        .iter()
        .filter(|m| matches!(m.event, Event::Input(_)))
    {
        let change = moment.change.unwrap();
        let slot = change.target.slot().unwrap();
        let attribute = match slot.texcoord_index() {
            Some(set) => &batch.texcoords[set],
            None => [&batch.diffuse, &batch.specular][slot.input_index().unwrap()],
        };
        for (lane, value) in change.after.iter().enumerate() {
            let expected = attribute.map(|component| component[lane].to_bits());
            assert_eq!(value.map(f32::to_bits), expected, "{slot:?} {lane}");
        }
    }
    // r0 as the last instruction left it: before the merger clamps it.
    let last = pixel
        .moments
        .iter()
        .rposition(|m| m.instruction.is_some())
        .unwrap();
    let registers = pixel.registers(last + 1);
    assert_eq!(registers.slot(Slot::R0, pixel.lane), event.merge.shaded);
    assert_eq!(registers.killed()[pixel.lane], event.merge.killed);
    let last = pixel.moments.iter().rev().find_map(|m| match &m.event {
        Event::Merge(stage) => Some(stage.as_ref()),
        _ => None,
    });
    match last {
        Some(MergeStage::Write { before, after, .. }) => {
            assert_eq!(
                (event.merge.fate(), *before, *after),
                (Fate::Written, event.merge.before, event.merge.after)
            );
        }
        Some(MergeStage::Killed) => assert_eq!(event.merge.fate(), Fate::Killed),
        Some(MergeStage::AlphaTest(test)) => assert_eq!(event.merge.alpha_test, Some(*test)),
        Some(MergeStage::Depth(test)) => assert_eq!(event.merge.depth, Some(*test)),
        other => panic!("{other:?} {:?}", event.merge),
    }
}

/// A triangle of three colours; in the middle each has a third.
const TRIANGLE: &str = r#"
size = [3, 3]
[meshes.one]
positions = [[-1, 3, 0.5], [3, -1, 0.5], [-1, -1, 0.5]]
texcoords = [[0.25, 0], [0.5, 0], [1, 0]]
[[draw]]
mesh = "one"
vs_text = "vs.1.1\nmov oPos, v0\nmov oD0, v7.x\n"
ps_text = "ps.1.1\nmov r0, v0\n"
"#;

#[test]
fn a_value_set_in_a_vertex_reaches_the_pixel() {
    let scene = scene(TRIANGLE);
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let subject = PixelSubject::new(&rendering, [1, 1], &Which::default()).unwrap();
    let mut session = Session::new(Subject::Pixel(subject));
    // Three vertices and the pixel, whose first instruction is where one starts.
    assert_eq!(session.runs().len(), 4);
    assert_eq!(session.position(), Position { run: 3, at: 1 });
    let color = |session: &Session<'_>| {
        let run = &session.runs()[3];
        run.registers(usize::MAX).slot(Slot::R0, run.lane)
    };
    let before = color(&session);
    let shares = match session.runs()[3].moments[0].event {
        Event::Input(InputSource::Interpolated { corners, shares }) => {
            assert_eq!(corners, [[0.25; 4], [0.5; 4], [1.0; 4]]);
            shares[session.runs()[3].lane]
        }
        ref other => panic!("{other:?}"),
    };
    // Behind its last instruction the second vertex gets 2, of which the rasterizer takes 1: twice what it had.
    session.go_to(Position { run: 1, at: 4 });
    let o_d0 = Slot::color_output(0).unwrap();
    assert!(session.set(Target::Slot(o_d0), WriteMask::ALL, [[2.0; 4]; 4]));
    let taken = session.next_moment().unwrap();
    assert_eq!(
        (&taken.event, taken.flags[0].clamped),
        (&Event::Taken, WriteMask::ALL)
    );
    let gained = color(&session)[0] - before[0];
    // s1 · (1 − 0.5), rounded a few times.
    assert!(
        (gained - shares[0] * 0.5).abs() < 1e-6,
        "{gained} {shares:?}"
    );
    // Going back all the way and forth again ends in the same place.
    let end = session.position();
    while session.back() {}
    while session.position() != end {
        assert!(session.step());
    }
    assert_eq!(session.registers().slot(o_d0, 0), [2.0; 4]);
}

#[test]
fn what_cannot_be_debugged_is_said() {
    let scene = scene(SCENE);
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let error = |pixel, which: &Which| {
        PixelSubject::new(&rendering, pixel, which)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(
        error([24, 0], &Which::default()),
        "the pixel 24,0 is outside of the 24x18 picture"
    );
    assert_eq!(
        error([0, 17], &Which::default()),
        "nothing is drawn at 0,17: the pixel has the clear colour"
    );
    let dots = Which {
        draw: Some("dots".into()),
        primitive: None,
    };
    assert_eq!(
        error([12, 9], &dots),
        "at 12,9 that is not drawn, only ball, shell"
    );
    let vertex = |vertex, draw| {
        VertexSubject::new(&rendering, vertex, draw)
            .map(|_| ())
            .unwrap_err()
            .to_string()
    };
    assert_eq!(vertex(2, None), "the mesh has the vertices 0 to 1, not 2");
    assert_eq!(
        vertex(0, Some("box")),
        "the picture has the draws ball, shell, dots"
    );
}

#[test]
fn a_vertex_alone() {
    let scene = scene(TRIANGLE);
    let rendering = scene.rendering(&RenderOptions::default(), &|_| {}).unwrap();
    let subject = VertexSubject::new(&rendering, 1, None).unwrap();
    let mut session = Session::new(Subject::Vertex(subject));
    while session.step() {}
    assert_eq!(
        session.registers().slot(Slot::POSITION, 0),
        [3.0, -1.0, 0.5, 1.0]
    );
}
