//! The registers of single pixels, and pictures of registers.

use std::collections::BTreeMap;

use texcrd::gpu::{FragmentComparison, Parting, Renderer, compare_pixel};
use texcrd::kernel::Slot;
use texcrd::scene::{LoadOptions, RenderOptions, Scene};

const VERTEX: &str = "vs.1.1\nmov oPos, v0\nmov oT0, v7\nadd oT1, -v7, c0\n";

/// t0 runs from 0 to 1 over 8×8 pixels, whose centres are at whole numbers: column x is u = x/8. The diagonal from the
/// upper left to the lower right parts the two triangles, the first of them above it.
fn scene(vertex: &str, pixel: &str) -> Scene {
    let text = format!(
        r#"
size = [8, 8]
[meshes.all]
positions = [[-1, 1, 0.5], [1, 1, 0.5], [1, -1, 0.5], [-1, -1, 0.5]]
texcoords = [[0, 0], [1, 0], [1, 1], [0, 1]]
indices = [0, 1, 2, 0, 2, 3]
[[draw]]
name = "all"
mesh = "all"
vs_text = """{vertex}"""
ps_text = """{pixel}"""
"#
    );
    load(&text)
}

fn load(text: &str) -> Scene {
    let files: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    match Scene::load(
        "scene.toml",
        text.as_bytes(),
        &files,
        &LoadOptions::default(),
    ) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

/// The fragment at pixel (5, 2), of one scene on the CPU and of another on the GPU. There t0 is (5/8, 2/8, 0, 1).
fn compared(cpu: &Scene, gpu: &Scene) -> Option<FragmentComparison> {
    let device = crate::device()?;
    let options = RenderOptions::default();
    let cpu = cpu.rendering(&options, &|_| ()).expect("the CPU renders");
    let mut renderer = Renderer::new(&device);
    let mut gpu = renderer
        .frame(gpu, &options, &[], &|_| ())
        .expect("the GPU renders");
    let comparison = compare_pixel(&cpu, &mut gpu, [5, 2]).expect("registers can be had");
    assert_eq!(comparison.history.events.len(), 1);
    assert_eq!(
        (
            comparison.history.events[0].draw,
            comparison.history.events[0].fragment.primitive
        ),
        (0, 0)
    );
    let [fragment] = <[_; 1]>::try_from(comparison.fragments).expect("one primitive is seen");
    assert!(fragment.covered);
    Some(fragment)
}

/// Interpolated values agree within 7 units in the last place at w = 1; what follows is a handful of sums and products of
/// numbers up to 1.
const NOISE: f32 = 1e-5;

const LISTING: &str = "\
ps.1.4
def c0, 0.5, 0.25, 0.125, 1
texcrd r0.rgb, t0
mul r1.rgb, r0, c0
add r2.rgb, r1, c0
mov_x2 r0.rgb, r2
+mov r0.a, c0.a
";

#[test]
fn the_same_scene_parts_nowhere() {
    let scene = scene(VERTEX, LISTING);
    let Some(fragment) = compared(&scene, &scene) else {
        return;
    };
    assert_eq!(fragment.parting(NOISE), Parting::Nowhere);
    assert_eq!(fragment.explanation(NOISE), None);
    assert_eq!(fragment.lines.len(), 5);
    // By hand: r1 = (5/16, 1/16, 0), r2 = (13/16, 5/16, 1/8).
    let registers = fragment.registers();
    let of = |index: usize| {
        let slot = Slot::temp(index).expect("a register");
        registers
            .iter()
            .find(|pair| pair.slot == slot)
            .expect("it is written")
    };
    let near = |a: [f32; 4], b: [f32; 4]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < NOISE);
    for (index, expected) in [
        (0, [1.625, 0.625, 0.25, 1.0]),
        (1, [0.3125, 0.0625, 0.0, 0.0]),
        (2, [0.8125, 0.3125, 0.125, 0.0]),
    ] {
        let pair = of(index);
        assert!(
            near(pair.cpu, expected) && near(pair.gpu, expected),
            "{pair:?}"
        );
    }
}

#[test]
fn the_line_that_differs_is_found() {
    let other = LISTING.replace("add r2.rgb", "sub r2.rgb");
    let Some(fragment) = compared(&scene(VERTEX, LISTING), &scene(VERTEX, &other)) else {
        return;
    };
    let Parting::Line(line) = fragment.parting(NOISE) else {
        panic!("{:?}", fragment.parting(NOISE));
    };
    // The third instruction. On the GPU r2 is (5/16 − 1/2, 1/16 − 1/4, 0 − 1/8).
    assert_eq!(line.instruction, 2);
    assert_eq!(fragment.explanation(NOISE), Some(line));
    let [read] = line.reads.as_slice() else {
        panic!("{:?}", line.reads);
    };
    assert!(Some(read.slot) == Slot::temp(1) && read.difference() < NOISE);
    let [write] = line.writes.as_slice() else {
        panic!("{:?}", line.writes);
    };
    let expected = [-0.1875, -0.1875, -0.125];
    assert!(
        (write.gpu.iter().zip(expected)).all(|(a, b)| (a - b).abs() < NOISE),
        "{write:?}"
    );
    // 13/16 + 3/16.
    assert!((write.difference() - 1.0).abs() < NOISE, "{write:?}");
}

/// A difference of 2⁻¹² is made 8, 16 and 32 times as large. The colour parts by 2⁻⁷, a quarter of it is 2⁻⁹, and that is
/// reached by the multiplication by 8.
#[test]
fn the_line_that_makes_much_of_little_is_found() {
    let listing = |constant: &str| {
        format!(
            "ps.1.4\ndef c0, 0.5, 0.5, 0.5, 0.5\ndef c1, 0.500244140625, 0.5, 0.5, 0.5\n\
             sub r1, {constant}, c0\nmov_x8 r2, r1\nmov_x2 r3, r2\nmov_x2 r0, r3\n"
        )
    };
    let (cpu, gpu) = (listing("c0"), listing("c1"));
    let Some(fragment) = compared(&scene(VERTEX, &cpu), &scene(VERTEX, &gpu)) else {
        return;
    };
    let Parting::Line(line) = fragment.parting(NOISE) else {
        panic!("{:?}", fragment.parting(NOISE));
    };
    assert_eq!(line.instruction, 0);
    assert_eq!(line.relative_difference(), 2f32.powi(-12));
    let explanation = fragment.explanation(NOISE).map(|line| line.instruction);
    assert_eq!(explanation, Some(1));
    // Above a tolerance of 2⁻¹⁰ it is the first that parts, too.
    let Parting::Line(line) = fragment.parting(2f32.powi(-10)) else {
        panic!("{:?}", fragment.parting(NOISE));
    };
    assert_eq!(line.instruction, 1);
}

#[test]
fn inputs_that_part_are_not_blamed_on_the_pixel_shader() {
    let other = VERTEX.replace("mov oT0, v7", "add oT0, v7, v7");
    let Some(fragment) = compared(&scene(VERTEX, LISTING), &scene(&other, LISTING)) else {
        return;
    };
    assert_eq!(fragment.parting(NOISE), Parting::Inputs);
    assert!((fragment.inputs[0].difference() - 0.625).abs() < NOISE);
}

/// t0 is not negative anywhere, and t1 is −t0.
#[test]
fn a_pixel_that_one_side_discards() {
    let listing = |set: &str| format!("ps.1.1\ntexcoord t0\ntexkill {set}\nmov r0, t0\n");
    let (keeps, kills) = (scene(VERTEX, &listing("t2")), scene(VERTEX, &listing("t1")));
    let Some(fragment) = compared(&keeps, &kills) else {
        return;
    };
    assert_eq!(fragment.killed, [false, true]);
    let Parting::Line(line) = fragment.parting(NOISE) else {
        panic!("{:?}", fragment.parting(NOISE));
    };
    assert_eq!((line.instruction, line.kills), (1, Some([false, true])));
    // The registers are there all the same.
    assert!(
        fragment
            .registers()
            .iter()
            .all(|pair| pair.difference() < NOISE)
    );
    // The other way round.
    if let Some(fragment) = compared(&kills, &keeps) {
        assert_eq!(fragment.killed, [true, false]);
        assert!(
            matches!(fragment.parting(NOISE), Parting::Line(line) if line.kills == Some([true, false]))
        );
    }
}

/// The primitive that covers a pixel is the one that is drawn again, whatever the vertices make up. Four vertices at pixels
/// (2, 2), (6, 2), (2, 6), (6, 6), or the last two the other way round; the last two have one colour, so that lines and points
/// must have it exactly.
#[test]
fn primitives_of_every_topology() {
    let Some(device) = crate::device() else {
        return;
    };
    let [a, b, c, d] = [
        "[-0.5, 0.5, 0.5]",
        "[0.5, 0.5, 0.5]",
        "[-0.5, -0.5, 0.5]",
        "[0.5, -0.5, 0.5]",
    ];
    for (topology, vertices, pixel, primitive, tolerance) in [
        // B, D, C.
        ("trianglestrip", [a, b, c, d], [5, 5], 1, NOISE),
        // D, C, A.
        ("trianglefan", [a, b, d, c], [3, 5], 1, NOISE),
        ("linelist", [a, b, c, d], [4, 6], 1, 0.0),
        ("linestrip", [a, b, c, d], [4, 6], 2, 0.0),
        ("pointlist", [a, b, c, d], [6, 6], 3, 0.0),
    ] {
        let scene = load(&format!(
            r#"
size = [8, 8]
[meshes.four]
positions = [{}]
colors = [[1, 0, 0, 1], [0, 1, 0, 1], [0.25, 0.5, 0.75, 1], [0.25, 0.5, 0.75, 1]]
[[draw]]
mesh = "four"
topology = "{topology}"
vs_text = "vs.1.1\nmov oPos, v0\nmov oD0, v5\n"
ps_text = "ps.1.1\nmov r0, v0\n"
state = {{ point_size = 3 }}
"#,
            vertices.join(", ")
        ));
        let options = RenderOptions::default();
        let cpu = scene.rendering(&options, &|_| ()).expect("the CPU renders");
        let mut renderer = Renderer::new(&device);
        let mut gpu = renderer
            .frame(&scene, &options, &[], &|_| ())
            .expect("the GPU renders");
        let comparison = compare_pixel(&cpu, &mut gpu, pixel).expect("registers can be had");
        let fragment = comparison.fragments.last().expect("the pixel is covered");
        assert_eq!(fragment.event.fragment.primitive, primitive, "{topology}");
        assert!(fragment.covered, "{topology}");
        let difference = fragment.inputs[0].difference();
        assert!(difference <= tolerance, "{topology}: {difference}");
        // A primitive that does not lie there, and one that is none.
        let pass = scene.passes([8, 8]).pop().expect("the picture");
        for other in [0, 100] {
            let registers = gpu.registers(&pass.draws[0], other, pixel, &[]);
            assert_eq!(registers.expect("it can be asked"), None, "{topology}");
        }
    }
}
