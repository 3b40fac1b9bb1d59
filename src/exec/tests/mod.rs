//! Instructions run on textures whose texels tell where they are, against coordinates worked out by hand.

mod models;

use super::*;
use crate::diagnostic::SourceMap;
use crate::kernel::{Options, Projection, Slot, lower};
use crate::semantics::BumpState;
use crate::syntax;
use crate::texture::{Format, Texture, TextureKind};

/// An 8×8 texture that holds (column, row, 0, 1) in every texel.
fn places() -> Texture {
    let texels: Vec<_> = (0..64)
        .map(|i| [(i % 8) as f32, (i / 8) as f32, 0.0, 1.0])
        .collect();
    Texture::from_texels(
        TextureKind::Texture2D,
        Format::Rgba32F,
        [8, 8, 1],
        &[texels],
    )
    .unwrap()
}

/// A cube map whose faces hold their number in red.
fn faces() -> Texture {
    let texels: Vec<_> = (0..6).map(|face| [face as f32, 0.0, 0.0, 1.0]).collect();
    Texture::from_texels(TextureKind::Cube, Format::Rgba32F, [1, 1, 1], &[texels]).unwrap()
}

/// A texture of one colour.
fn colour(texel: [f32; 4]) -> Texture {
    let texels = vec![texel];
    Texture::from_texels(
        TextureKind::Texture2D,
        Format::Rgba32F,
        [1, 1, 1],
        &[texels],
    )
    .unwrap()
}

struct Bench<'a> {
    options: Options,
    environment: Environment<'a>,
    coordinates: Vec<[f32; 4]>,
}

impl<'a> Bench<'a> {
    /// Textures for the stages from 0 and the coordinate sets from 0.
    fn new(textures: &[&'a Texture], coordinates: &[[f32; 4]]) -> Self {
        let mut environment = Environment::default();
        for (stage, texture) in environment.stages.iter_mut().zip(textures) {
            stage.texture = Some(texture);
        }
        Self {
            options: Options::default(),
            environment,
            coordinates: coordinates.to_vec(),
        }
    }

    fn run(mut self, listing: &str, constants: &[(u32, [f32; 4])]) -> Machine<1> {
        let mut sources = SourceMap::new();
        let parsed = syntax::parse(sources.add("test", listing).unwrap());
        assert_eq!(parsed.diagnostics, [], "{listing}");
        let kernel = lower(&parsed.program.unwrap(), &self.options).unwrap();
        self.environment.constants = bind_constants(&kernel, constants);
        let mut machine = Machine::new();
        for (i, set) in self.coordinates.iter().enumerate() {
            machine.load(Slot::texcoord(i).unwrap(), *set);
        }
        machine.run(&kernel, &self.environment);
        machine
    }

    /// What the listing leaves in `r0`.
    fn r0(self, listing: &str) -> [f32; 4] {
        self.run(listing, &[]).lane(Slot::R0, 0)
    }
}

#[test]
fn tex_and_texld_sample_their_own_stage() {
    let (a, b) = (colour([1.0, 2.0, 3.0, 4.0]), places());
    // (0.3, 0.9) of 8 is texel (2, 7).
    let at = [[0.0; 4], [0.3, 0.9, 0.0, 1.0]];
    let r0 = Bench::new(&[&a, &b], &at).r0("ps.1.1\ntex t0\ntex t1\nmov r0, t1\n");
    assert_eq!(r0, [2.0, 7.0, 0.0, 1.0]);
    // The stage is that of the destination, the coordinates are those of the source.
    let r0 = Bench::new(&[&a, &b], &at).r0("ps.1.4\ntexld r1, t0\nmov r0, r1\n");
    assert_eq!(r0, [0.0, 0.0, 0.0, 1.0]);
    let r0 = Bench::new(&[&a, &b], &at).r0("ps.1.4\ntexld r0, t1\n");
    assert_eq!(r0, [1.0, 2.0, 3.0, 4.0]);
}

#[test]
fn projected_stages_divide() {
    let map = places();
    let at = [[1.0, 2.0, 4.0, 8.0]];
    // By the fourth: (0.125, 0.25) is texel (1, 2); by the third: (0.25, 0.5) is texel (2, 4).
    for (projection, expected) in [
        (Projection::Fourth, [1.0, 2.0]),
        (Projection::Third, [2.0, 4.0]),
    ] {
        let mut bench = Bench::new(&[&map], &at);
        bench.options.projection[0] = projection;
        assert_eq!(bench.r0("ps.1.1\ntex t0\nmov r0, t0\n")[..2], expected);
        // ps.1.4 ignores the state: (1, 2) wraps to texel (0, 0).
        let mut bench = Bench::new(&[&map], &at);
        bench.options.projection[0] = projection;
        assert_eq!(bench.r0("ps.1.4\ntexld r0, t0\n")[..2], [0.0, 0.0]);
    }
}

#[test]
fn ps_1_4_divides_where_it_is_told_to() {
    let map = places();
    let at = [[1.0, 2.0, 99.0, 8.0]];
    let r0 = Bench::new(&[&map], &at).r0("ps.1.4\ntexld r0, t0_dw.xyw\n");
    assert_eq!(r0[..2], [1.0, 2.0]);
    let listing = "ps.1.4\ntexcrd r0.rgb, t0\nphase\ntexld r0, r0_dz\n";
    let r0 = Bench::new(&[&map], &[[1.0, 2.0, 4.0, 0.0]]).r0(listing);
    assert_eq!(r0[..2], [2.0, 4.0]);
    // A zero divisor gives 1, which wraps to texel 0.
    let r0 = Bench::new(&[&map], &[[0.3, 0.3, 0.0, 0.0]]).r0(listing);
    assert_eq!(r0[..2], [0.0, 0.0]);
    // texcrd keeps xyw, does not clamp, and divides the same way.
    let listing = "ps.1.4\ntexcrd r0.rgb, t0.xyw\nmov r0.a, r0.b\n";
    assert_eq!(Bench::new(&[], &at).r0(listing), [1.0, 2.0, 8.0, 8.0]);
    let listing = "ps.1.4\nmov r0, c0\ntexcrd r0.rg, t0_dw.xyw\n";
    let machine = Bench::new(&[], &at).run(listing, &[(0, [0.5; 4])]);
    assert_eq!(machine.lane(Slot::R0, 0), [0.125, 0.25, 0.5, 0.5]);
}

#[test]
fn texcoord_clamps_and_its_alpha_is_one() {
    let r0 = Bench::new(&[], &[[-1.0, 0.5, 2.0, 0.25]]).r0("ps.1.1\ntexcoord t0\nmov r0, t0\n");
    assert_eq!(r0, [0.0, 0.5, 1.0, 1.0]);
}

/// The test vector of the specification: texel (−15, 15)/127 and base (0.5, 0.5) under M00 = −1, M10 = 2 sample at
/// u = 0.854: texel 6 of 8. The matrix is that of the destination's stage.
#[test]
fn texbem_moves_the_coordinates() {
    let bump = colour([-15.0 / 127.0, 15.0 / 127.0, 0.5, 1.0]);
    let map = places();
    let at = [[0.0; 4], [0.5, 0.5, 0.0, 1.0]];
    let with_bump = |listing: &str| {
        let mut bench = Bench::new(&[], &at);
        bench.environment.stages[0].texture = Some(&bump);
        bench.environment.stages[1].texture = Some(&map);
        bench.environment.stages[1].bump = BumpState {
            matrix: [-1.0, 0.0, 2.0, 0.0],
            luminance_scale: 0.5,
            luminance_offset: 0.25,
        };
        bench.r0(listing)
    };
    let r0 = with_bump("ps.1.1\ntex t0\ntexbem t1, t0\nmov r0, t1\n");
    assert_eq!(r0, [6.0, 4.0, 0.0, 1.0]);
    // texbeml: times 0.5·0.5 + 0.25 = 0.5, alpha as well.
    let r0 = with_bump("ps.1.1\ntex t0\ntexbeml t1, t0\nmov r0, t1\n");
    assert_eq!(r0, [3.0, 2.0, 0.0, 0.5]);
    // bem: r0 is 0.854 = 0.5 + 15/127 + 30/127.
    let mut bench = Bench::new(&[&bump], &at);
    bench.environment.stages[1].bump.matrix = [-1.0, 0.0, 2.0, 0.0];
    let r0 =
        bench.r0("ps.1.4\ntexld r0, t0\ntexcrd r1.rgb, t1\nbem r1.rg, r1, r0\nmov r0.rgb, r1\n");
    assert!((r0[0] - 0.854_330_7).abs() < 1e-6 && r0[1] == 0.5, "{r0:?}");
}

#[test]
fn dependent_reads_take_two_or_three_channels() {
    let map = places();
    let key = colour([0.9, 0.3, 0.6, 0.4]);
    let at = [[0.0; 4]; 2];
    // ar: (0.4, 0.9) is texel (3, 7); gb: (0.3, 0.6) is (2, 4); rgb on a 2D texture: (0.9, 0.3) is (7, 2).
    for (version, opcode, expected) in [
        ("ps.1.1", "texreg2ar", [3.0, 7.0]),
        ("ps.1.1", "texreg2gb", [2.0, 4.0]),
        ("ps.1.2", "texreg2rgb", [7.0, 2.0]),
    ] {
        let listing = format!("{version}\ntex t0\n{opcode} t1, t0\nmov r0, t1\n");
        let r0 = Bench::new(&[&key, &map], &at).r0(&listing);
        assert_eq!(r0[..2], expected, "{opcode}");
    }
}

/// Rows (1, 0, 0), (0, 1, 0), (0, 0, 1) times two, … against the texel (0.25, 0.5, 0.75).
#[test]
fn matrix_instructions() {
    let key = colour([0.25, 0.5, 0.75, 1.0]);
    let (map, cube) = (places(), faces());
    let rows = [
        [0.0; 4],
        [0.5, 0.0, 0.0, -1.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 0.5, 0.0],
    ];
    // (0.125, 0.5) is texel (1, 4).
    let listing = "ps.1.1\ntex t0\ntexm3x2pad t1, t0\ntexm3x2tex t2, t0\nmov r0, t2\n";
    let r0 = Bench::new(&[&key, &map, &map], &rows).r0(listing);
    assert_eq!(r0[..2], [1.0, 4.0]);
    // (0.125, 0.5, 0.375): y is the largest, +Y is face 2.
    let listing =
        "ps.1.1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3tex t3, t0\nmov r0, t3\n";
    let r0 = Bench::new(&[&key, &map, &map, &cube], &rows).r0(listing);
    assert_eq!(r0[0], 2.0);
    // _bx2 makes it (−0.5, 0, 0.5): the rows give (−0.25, 0, 0.25); z wins the tie, +Z is face 4.
    let listing = "ps.1.1\ntex t0\ntexm3x3pad t1, t0_bx2\ntexm3x3pad t2, t0_bx2\ntexm3x3tex t3, t0_bx2\nmov r0, t3\n";
    let r0 = Bench::new(&[&key, &map, &map, &cube], &rows).r0(listing);
    assert_eq!(r0[0], 4.0);
}

#[test]
fn matrix_results_and_dots() {
    let key = colour([0.25, 0.5, 0.75, 1.0]);
    let rows = [
        [0.0; 4],
        [1.0, 2.0, 0.0, 0.0],
        [0.0, 0.0, 4.0, 0.0],
        [-2.0, 0.0, 0.0, 0.0],
    ];
    let listing =
        "ps.1.2\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3 t3, t0\nmov r0, t3\n";
    // 0.25 + 1, 3, −0.5
    assert_eq!(
        Bench::new(&[&key], &rows).r0(listing),
        [1.25, 3.0, -0.5, 1.0]
    );
    let listing = "ps.1.2\ntex t0\ntexdp3 t1, t0\nmov r0, t1\n";
    assert_eq!(Bench::new(&[&key], &rows).r0(listing), [1.25; 4]);
    // The row of the texture at 1.25, which wraps to 0.25: texel (2, 0).
    let map = places();
    let listing = "ps.1.2\ntex t0\ntexdp3tex t1, t0\nmov r0, t1\n";
    let r0 = Bench::new(&[&key, &map], &rows).r0(listing);
    assert_eq!(r0[..2], [2.0, 0.0]);
}

/// Normal (0, 0, 1) through unit rows and an eye vector: the reflection of (1, 0, 0.5) is (−1, 0, 0.5), face −X.
#[test]
fn reflections_sample_a_cube() {
    let normal = colour([0.0, 0.0, 1.0, 1.0]);
    let cube = faces();
    let rows = [
        [0.0; 4],
        [1.0, 0.0, 0.0, 1.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.5],
    ];
    let stages = [&normal, &cube, &cube, &cube];
    let pads = "ps.1.1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\n";
    let listing = format!("{pads}texm3x3vspec t3, t0\nmov r0, t3\n");
    assert_eq!(Bench::new(&stages, &rows).r0(&listing)[0], 1.0);
    let listing = format!("{pads}texm3x3spec t3, t0, c0\nmov r0, t3\n");
    let machine = Bench::new(&stages, &rows).run(&listing, &[(0, [-1.0, 0.0, 0.5, 0.0])]);
    assert_eq!(machine.lane(Slot::R0, 0)[0], 0.0);
}

#[test]
fn depth_and_kill() {
    let key = colour([1.0, 0.0, 0.0, 1.0]);
    let rows = [[0.0; 4], [0.25, 0.0, 0.0, 0.0], [0.5, 0.0, 0.0, 0.0]];
    let listing = "ps.1.3\ntex t0\ntexm3x2pad t1, t0\ntexm3x2depth t2, t0\nmov r0, t0\n";
    let machine = Bench::new(&[&key], &rows).run(listing, &[]);
    assert_eq!(machine.lane(Slot::DEPTH, 0)[0], 0.5);
    // texkill looks at the coordinates, not at what was sampled, and not at q.
    for (at, killed) in [
        ([0.0, 0.0, -0.0, -1.0], false),
        ([0.0, -0.1, 0.0, 1.0], true),
        ([0.0, 0.0, f32::NAN, 1.0], false),
    ] {
        let machine = Bench::new(&[&key], &[at]).run("ps.1.1\ntexkill t0\nmov r0, c0\n", &[]);
        assert_eq!(machine.killed(), &[killed], "{at:?}");
    }
    // In ps.1.4 a register's content can kill.
    let listing = "ps.1.4\ntexcrd r1.rgb, t0\nsub r1.rgb, r1, c0\nphase\ntexkill r1\nmov r0, c0\n";
    for (x, killed) in [(0.75, false), (0.25, true)] {
        let machine = Bench::new(&[], &[[x, 1.0, 1.0, 1.0]]).run(listing, &[(0, [0.5; 4])]);
        assert_eq!(machine.killed(), &[killed], "{x}");
    }
}

/// The differences within a quad choose the level: neighbours two texels apart give level 1.
#[test]
fn quads_choose_the_level() {
    let map = {
        let level = |value: f32, n: usize| vec![[value; 4]; n];
        let levels = [level(0.0, 64), level(1.0, 16), level(2.0, 4), level(3.0, 1)];
        Texture::from_texels(TextureKind::Texture2D, Format::Rgba32F, [8, 8, 1], &levels).unwrap()
    };
    let mut environment = Environment::default();
    environment.stages[0].texture = Some(&map);
    environment.stages[0].sampler.mip = crate::texture::MipFilter::Point;
    let mut sources = SourceMap::new();
    let parsed = syntax::parse(sources.add("test", "ps.1.4\ntexld r0, t0\n").unwrap());
    let kernel = lower(&parsed.program.unwrap(), &Options::default()).unwrap();
    let mut machine = Machine::<4>::new();
    for lane in 0..4 {
        let at = [0.25 * (lane % 2) as f32, 0.25 * (lane / 2) as f32, 0.0, 1.0];
        machine.set_lane(Slot::texcoord(0).unwrap(), lane, at);
    }
    machine.run(&kernel, &environment);
    assert_eq!(machine.lane(Slot::R0, 3), [1.0; 4]);
}

#[test]
fn macros_and_pairs_read_before_they_write() {
    let mut sources = SourceMap::new();
    let listing = "vs.1.1\nmov r0, v0\nm4x4 r0, r0, c0\nmov oPos, r0\n";
    let parsed = syntax::parse(sources.add("test", listing).unwrap());
    let kernel = lower(&parsed.program.unwrap(), &Options::default()).unwrap();
    let held: Vec<bool> = kernel.steps.iter().map(|s| s.held).collect();
    assert_eq!(held, [false, true, true, true, false, false]);
    let rows = [
        (0, [0.0, 1.0, 0.0, 0.0]),
        (1, [0.0, 0.0, 1.0, 0.0]),
        (2, [0.0, 0.0, 0.0, 1.0]),
        (3, [1.0, 0.0, 0.0, 0.0]),
    ];
    let environment = Environment {
        constants: bind_constants(&kernel, &rows),
        ..Default::default()
    };
    let mut machine = Machine::<1>::new();
    machine.load(Slot::input(0).unwrap(), [1.0, 2.0, 3.0, 4.0]);
    let trace = Trace::record(&mut machine, &kernel, &environment, 0);
    assert_eq!(machine.lane(Slot::POSITION, 0), [2.0, 3.0, 4.0, 1.0]);
    // The trace tells every row as it is written, with the register before and after.
    let rows: Vec<_> = trace
        .changes
        .iter()
        .filter(|c| c.instruction == 1)
        .collect();
    assert_eq!(rows.len(), 4);
    assert_eq!(rows[0].before, [1.0, 2.0, 3.0, 4.0]);
    assert_eq!(rows[0].after, [2.0, 2.0, 3.0, 4.0]);
    assert_eq!(rows[3].after, [2.0, 3.0, 4.0, 1.0]);
}

/// What is defined in a shader is loaded when it is set; what is set after that replaces it.
#[test]
fn set_constants_replace_definitions() {
    let listing =
        "ps.1.1\ndef c0, 0.5, 0.5, 0.5, 0.5\ndef c1, 0.25, 0.25, 0.25, 0.25\nadd r0, c0, c1\n";
    let machine = Bench::new(&[], &[]).run(listing, &[(0, [1.0; 4])]);
    assert_eq!(machine.lane(Slot::R0, 0), [1.25; 4]);
}
