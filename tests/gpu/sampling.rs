//! Textures where one pixel shows nothing: minification, mip levels, anisotropic filters, and the weights of the hardware
//! models, on both paths. First pictures of a few pixels with numbers worked out by hand, then whole surfaces compared.

use std::collections::BTreeMap;
use std::fmt::Write;

use image::RgbaImage;
use texcrd::gpu::{Device, Differences, Renderer};
use texcrd::policy::Model;
use texcrd::raster::Target;
use texcrd::scene::{LoadOptions, RenderOptions, Scene};

fn load(text: &str, model: Model) -> Scene {
    let options = LoadOptions {
        model,
        ..LoadOptions::default()
    };
    let files = BTreeMap::<String, Vec<u8>>::new();
    match Scene::load("scene.toml", text.as_bytes(), &files, &options) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}\n{text}"),
    }
}

fn draw(device: &Device, scene: &Scene) -> (Target, RgbaImage) {
    let options = RenderOptions::default();
    let cpu = scene.render(&options, &|_| ()).expect("the CPU renders");
    let gpu = Renderer::new(device).render(scene, &options, &|_| ());
    (cpu, gpu.expect("the GPU renders"))
}

/// A picture of 16×8 pixels that one rectangle covers. Its coordinates are `at` at the middle of the upper left pixel, and
/// grow by `x` to the right and by `y` downwards from pixel to pixel.
#[derive(Clone)]
struct Plane {
    at: [f32; 3],
    x: [f32; 3],
    y: [f32; 3],
    texture: String,
    stage: String,
    shader: String,
}

impl Plane {
    /// Of 2D textures `edge` texels wide, with steps in texels of level 0.
    fn new(texture: &str, edge: f32, x: [f32; 2], y: [f32; 2], stage: &str) -> Self {
        let step = |of: [f32; 2]| [of[0] / edge, of[1] / edge, 0.0];
        Self {
            at: [0.5 / edge, 0.5 / edge, 0.0],
            x: step(x),
            y: step(y),
            texture: texture.into(),
            stage: stage.into(),
            shader: "ps.1.1\ntex t0\nmov r0, t0".into(),
        }
    }

    fn scene(&self) -> Scene {
        // The pixel i, j is at (i/8 − 1, 1 − j/4) in clip space.
        let row = |axis: usize| {
            let (at, x, y) = (self.at[axis], 8.0 * self.x[axis], 4.0 * self.y[axis]);
            format!("[{x:?}, {:?}, 0, {:?}]", -y, at + x + y)
        };
        let text = format!(
            r#"
            size = [16, 8]
            [meshes.all]
            positions = [[-1, 1, 0], [1, 1, 0], [-1, -1, 0], [1, -1, 0]]
            indices = [0, 1, 2, 2, 1, 3]
            [textures.t]
            {}
            [[draw]]
            mesh = "all"
            vs_text = "vs.1.1 mov oPos, v0 m4x3 oT0.xyz, v0, c0"
            ps_text = """{}"""
            vs_constants = {{ c0 = {}, c1 = {}, c2 = {} }}
            stages.0 = {{ texture = "t", {} }}
            stages.1 = {{ texture = "t", {} }}
            "#,
            self.texture,
            self.shader,
            row(0),
            row(1),
            row(2),
            self.stage,
            self.stage,
        );
        load(&text, Model::Float)
    }

    /// Fails unless both paths give this red, in 1/255, at a pixel; halves may go to either side.
    fn shows(&self, device: &Device, expected: &[([u32; 2], f32)]) {
        let (cpu, gpu) = draw(device, &self.scene());
        for &([x, y], red) in expected {
            for (path, found) in [("CPU", cpu.to_image()), ("GPU", gpu.clone())] {
                let found = f32::from(found.get_pixel(x, y)[0]);
                assert!(
                    (found - red).abs() <= 0.6,
                    "{path} at {x},{y}: {found} instead of {red}: {}",
                    self.stage
                );
            }
        }
    }

    /// The same red at some pixels, among them neighbours of the edges.
    fn is(&self, device: &Device, red: f32) {
        let places = [[1, 1], [2, 1], [6, 5], [9, 4], [14, 6]];
        self.shows(device, &places.map(|place| (place, red)));
    }
}

/// Levels of 16×16 to 1×1 texels, each of one grey: 10, 60, 110, 160, 210.
fn greys() -> String {
    levels(|level, _, _| 10.0 + 50.0 * level as f32)
}

/// Levels of 16×16 to 1×1 texels of greys from 0 to 255, from their level, column and row.
fn levels(grey: impl Fn(u32, u32, u32) -> f32) -> String {
    let level = |level: u32| {
        let edge = 16 >> level;
        let texels = (0..edge * edge).map(|i| {
            let v = grey(level, i % edge, i / edge) / 255.0;
            format!("[{v}, {v}, {v}, 1]")
        });
        format!("[{}]", texels.collect::<Vec<_>>().join(", "))
    };
    let smaller: Vec<String> = (1..5).map(level).collect();
    format!(
        "size = [16, 16]\ntexels = {}\nmips = [{}]",
        level(0),
        smaller.join(", ")
    )
}

/// λ = log2 of the longer step: the nearest level, halves up, and the blend of two.
#[test]
fn levels_follow_the_longer_step() {
    let Some(device) = crate::device() else {
        return;
    };
    let plane = |x, y, stage: &str| Plane::new(&greys(), 16.0, x, y, stage);
    for (x, y, red) in [
        // One texel a pixel: λ = 0.
        ([1.0, 0.0], [0.0, 1.0], 10.0),
        // Two to the right, one down: the longer one counts. And the other way.
        ([2.0, 0.0], [0.0, 1.0], 60.0),
        ([1.0, 0.0], [0.0, 4.0], 110.0),
        // 3 and 4 make 5, log2 5 = 2.32. Beyond the last level it stays.
        ([3.0, 4.0], [0.0, 1.0], 110.0),
        ([64.0, 0.0], [0.0, 1.0], 210.0),
        // log2 2.75 = 1.46, log2 2.9 = 1.54.
        ([2.75, 0.0], [0.0, 1.0], 60.0),
        ([2.9, 0.0], [0.0, 1.0], 110.0),
        ([0.25, 0.0], [0.0, 0.25], 10.0),
    ] {
        plane(x, y, "mip = \"point\"").is(&device, red);
    }
    // Without a filter between levels there is only the largest.
    plane([4.0, 0.0], [0.0, 1.0], "mip = \"none\"").is(&device, 10.0);
    // 10 and 60 in the middle: log2 √2 = 1/2.
    let root = std::f32::consts::SQRT_2;
    plane([root, 0.0], [0.0, 1.0], "mip = \"linear\"").is(&device, 35.0);
}

#[test]
fn bias_and_largest_level() {
    let Some(device) = crate::device() else {
        return;
    };
    let plane = |step, stage: &str| Plane::new(&greys(), 16.0, [step, 0.0], [0.0, 1.0], stage);
    // λ = 0 + 1, 1 − 1, 1 + 9.
    plane(1.0, "mip = \"point\", lod_bias = 1").is(&device, 60.0);
    plane(2.0, "mip = \"point\", lod_bias = -1").is(&device, 10.0);
    plane(2.0, "mip = \"point\", lod_bias = 9").is(&device, 210.0);
    // Exactly between two levels: the smaller one. A little less is the larger one.
    plane(1.0, "mip = \"point\", lod_bias = 0.5").is(&device, 60.0);
    plane(2.0, "mip = \"point\", lod_bias = 0.5").is(&device, 110.0);
    plane(1.0, "mip = \"point\", lod_bias = 0.49").is(&device, 10.0);
    plane(1.0, "mip = \"linear\", lod_bias = 1.5").is(&device, 85.0);
    // No level before 2, whatever λ is; smaller ones as ever; none beyond the last.
    plane(1.0, "mip = \"point\", max_mip_level = 2").is(&device, 110.0);
    plane(8.0, "mip = \"point\", max_mip_level = 2").is(&device, 160.0);
    plane(1.0, "mip = \"linear\", max_mip_level = 9").is(&device, 210.0);
    // Without a filter between levels the largest level is 0.
    plane(1.0, "mip = \"none\", max_mip_level = 2").is(&device, 10.0);
}

/// A stripe of 0 and one of 200 texel by texel: point shows them, linear halfway between two centres shows 100.
#[test]
fn magnified_and_minified_are_told_apart_by_lambda() {
    let Some(device) = crate::device() else {
        return;
    };
    let stripes = levels(|_, x, _| 200.0 * (x % 2) as f32);
    let plane = |step: f32, stage: &str| {
        let mut plane = Plane::new(&stripes, 16.0, [0.0, 0.0], [0.0, step], stage);
        // The edge between two columns, all over the picture.
        plane.at[0] = 2.0 / 16.0;
        plane
    };
    let (sharp, smooth) = (
        "mag = \"point\", min = \"linear\"",
        "mag = \"linear\", min = \"point\"",
    );
    // λ = 0 is magnified, a little more is minified. Column 2 is the one right of the edge.
    plane(1.0, sharp).is(&device, 0.0);
    plane(1.05, sharp).is(&device, 100.0);
    plane(1.0, smooth).is(&device, 100.0);
    plane(1.05, smooth).is(&device, 0.0);
    // The bias counts.
    plane(1.0, &format!("{sharp}, lod_bias = 0.25")).is(&device, 100.0);
    plane(1.5, &format!("{sharp}, lod_bias = -1")).is(&device, 0.0);
    // The largest level that may be read does not make anything minified: level 1 has its edges at u = 2/8.
    for (stage, red) in [(sharp, 0.0), (smooth, 100.0)] {
        for mip in ["point", "linear"] {
            let mut plane = plane(0.5, &format!("{stage}, mip = \"{mip}\", max_mip_level = 1"));
            plane.at[0] = 2.0 / 8.0;
            plane.is(&device, red);
        }
    }
}

/// Borders are those of the level: at λ = 2, in level 2 of four texels, a texel is a quarter of the texture.
#[test]
fn borders_of_smaller_levels() {
    let Some(device) = crate::device() else {
        return;
    };
    let white = levels(|_, _, _| 200.0);
    let stage = "filter = \"linear\", mip = \"point\", address = \"border\", border = [0, 0, 0, 1]";
    let mut plane = Plane::new(&white, 16.0, [0.0, 0.0], [0.0, 4.0], stage);
    // Rows of pixels lie in the middle of rows of level 2: v = 1/8, 3/8, 5/8, 7/8, and then outside.
    plane.at[1] = 1.0 / 8.0;
    // u = 0 is half inside; an eighth more is the centre of the first texel, a sixteenth more a quarter short of it.
    for (u, inside) in [
        (0.0, 0.5),
        (0.125, 1.0),
        (0.0625, 0.75),
        (-0.125, 0.0),
        (1.0, 0.5),
    ] {
        plane.at[0] = u;
        let red = 200.0 * inside;
        plane.shows(&device, &[([3, 1], red), ([9, 3], red), ([9, 4], 0.0)]);
    }
    // The middle of the last row of level 2 and that of the border outside of it: a pixel row between them, half of both.
    plane.at = [0.5, 1.0 - 8.0 / 16.0, 0.0];
    plane.shows(&device, &[([3, 2], 100.0)]);
}

/// The sides of every address mode in level 1 (eight columns), beyond both edges: a column of level 1 has the grey
/// 20·(column + 1).
#[test]
fn address_modes_in_a_smaller_level() {
    let Some(device) = crate::device() else {
        return;
    };
    let columns = levels(|level, x, _| {
        if level == 1 {
            20.0 * (x + 1) as f32
        } else {
            0.0
        }
    });
    // Columns −9, −1, 8, 17 of level 1, by the formulas; the border is 255.
    for (mode, expected) in [
        ("wrap", [7, 7, 0, 1]),
        ("mirror", [7, 0, 7, 1]),
        ("clamp", [0, 0, 7, 7]),
        ("mirror_once", [7, 0, 7, 7]),
        ("border", [-1, -1, -1, -1]),
    ] {
        for (column, expected) in [-9.0, -1.0, 8.0, 17.0].into_iter().zip(expected) {
            for filter in ["point", "linear"] {
                let stage = format!(
                    "filter = \"{filter}\", mip = \"point\", address = [\"{mode}\", \"wrap\"], border = [1, 1, 1, 1]"
                );
                let mut plane = Plane::new(&columns, 16.0, [0.0, 0.0], [0.0, 2.0], &stage);
                plane.at[0] = (column + 0.5) / 8.0;
                let red = match expected {
                    -1 => 255.0,
                    column => 20.0 * (column + 1) as f32,
                };
                plane.is(&device, red);
            }
        }
    }
}

/// Derivatives are those of the coordinates that are sampled at, which a shader may have computed.
#[test]
fn dependent_reads_have_derivatives_of_their_own() {
    let Some(device) = crate::device() else {
        return;
    };
    let stage = "mip = \"point\"";
    let mut plane = Plane::new(&greys(), 16.0, [1.0, 0.0], [0.0, 1.0], stage);
    plane.is(&device, 10.0);
    // Twice the coordinates: λ = 1. Eight times: 3.
    plane.shader =
        "ps.1.4\ntexcrd r0.rgb, t0\nadd r0.rgb, r0, r0\nphase\ntexld r1, r0\nmov r0, r1".into();
    plane.is(&device, 60.0);
    plane.shader =
        "ps.1.4\ntexcrd r0.rgb, t0\nmov_x8 r0.rgb, r0\nphase\ntexld r1, r0\nmov r0, r1".into();
    plane.is(&device, 160.0);
    // texm3x2tex: u = 4·t0.x (c0 has no room for 4), v = t0.y: here both rows are those of the coordinates themselves.
    // Pixels that texkill takes out are neighbours all the same: every second column is killed, and the step is what it was.
    plane.shader = "ps.1.4\ntexcrd r0.rgb, t0\ntexld r1, t0\nmov r0, r1".into();
    plane.x[0] = 2.0 / 16.0;
    plane.is(&device, 60.0);
}

#[test]
fn pixels_that_are_killed_give_their_neighbours_derivatives() {
    let Some(device) = crate::device() else {
        return;
    };
    // t0.z is −1, 1, −1, 1 … along x only if it wraps; so it changes its sign once, between the two pixels of a quad.
    let mut plane = Plane::new(&greys(), 16.0, [2.0, 0.0], [0.0, 1.0], "mip = \"point\"");
    plane.shader = "ps.1.4\ntexcrd r0.rgb, t0\ntexkill r0\ntexld r1, t0\nmov r0, r1".into();
    plane.shader = plane.shader.replace("texkill r0\n", "phase\ntexkill r0\n");
    plane.at[2] = -6.5;
    plane.x[2] = 1.0;
    // Columns 0 to 6 are killed, and 7 is in a quad with 6. The picture is black where nothing is drawn.
    plane.shows(
        &device,
        &[
            ([6, 2], 0.0),
            ([7, 2], 60.0),
            ([7, 3], 60.0),
            ([12, 2], 60.0),
        ],
    );
}

/// On a cube the step is that of the projected coordinates, whatever the length of the directions.
#[test]
fn levels_of_a_cube() {
    let Some(device) = crate::device() else {
        return;
    };
    // Six faces with levels of 16×16 to 1×1 texels of one grey: 10 more a level, 40 more a face.
    let level = |level: u32| {
        let texels = (0..6).flat_map(|face| {
            let grey = (10.0 + 10.0 * level as f32 + 40.0 * face as f32) / 255.0;
            vec![format!("[{grey}, 0, 0, 1]"); (16usize >> level).pow(2)]
        });
        format!("[{}]", texels.collect::<Vec<_>>().join(", "))
    };
    let smaller: Vec<String> = (1..5).map(level).collect();
    let texture = format!(
        "kind = \"cube\"\nsize = [16, 16]\ntexels = {}\nmips = [{}]",
        level(0),
        smaller.join(", ")
    );
    for stage in [
        "mip = \"point\"",
        "mip = \"point\", seamless = true",
        "mip = \"point\", lod_bias = 0.001",
        "mip = \"point\", seamless = true, lod_bias = 0.001",
    ] {
        let mut plane = Plane {
            at: [-0.9, -0.9, 1.0],
            // sc by 1/8 is u by 1/16, one texel; tc by 1/16.
            x: [0.125, 0.0, 0.0],
            y: [0.0, 0.0625, 0.0],
            texture: texture.clone(),
            stage: stage.into(),
            shader: "ps.1.1\ntex t0\nmov r0, t0".into(),
        };
        // Face +Z is the fifth: 10 + 4 · 40 = 170.
        plane.shows(&device, &[([1, 1], 170.0), ([4, 4], 170.0)]);
        // Four times the step: level 2. On −Z of half the distance the step is twice as long: level 1.
        plane.x[0] = 0.5;
        plane.shows(&device, &[([1, 1], 190.0), ([2, 4], 190.0)]);
        plane.x[0] = 0.125;
        plane.at = [-0.45, -0.45, -0.5];
        plane.shows(&device, &[([1, 1], 220.0), ([4, 4], 220.0)]);
    }
}

/// Columns of level 1 as in [`address_modes_in_a_smaller_level`], 20·(column + 1): probes by hand.
///
/// Eight texels to the right and two down: λ = 3, four probes of two texels, level 1. At u = 1/2 they are at 5/16, 7/16,
/// 9/16 and 11/16, columns 2 to 5 of level 1: 60, 80, 100, 120. The linear filter reads level 3.
#[test]
fn anisotropic_probes() {
    let Some(device) = crate::device() else {
        return;
    };
    let texture = levels(|level, x, _| match level {
        0 => 10.0 * x as f32,
        1 => 20.0 * (x + 1) as f32,
        2 => 5.0,
        _ => 250.0,
    });
    let plane = |stage: &str| {
        let stage = format!("{stage}, mag = \"linear\", address = \"clamp\"");
        let mut plane = Plane::new(&texture, 16.0, [8.0, 0.0], [0.0, 2.0], &stage);
        // Pixel 4 is in the middle.
        plane.at[0] = 0.5 - 4.0 * 0.5;
        plane
    };
    let middle = |red: f32| [([4, 2], red), ([4, 3], red)];
    let with = |most: u32, mip: &str| {
        plane(&format!(
            "min = \"anisotropic\", max_anisotropy = {most}, mip = \"{mip}\""
        ))
    };
    with(16, "point").shows(&device, &middle(90.0));
    with(4, "linear").shows(&device, &middle(90.0));
    // Two probes of four texels: level 2. One probe: as a linear filter.
    with(2, "point").shows(&device, &middle(5.0));
    with(1, "point").shows(&device, &middle(250.0));
    plane("min = \"linear\", mip = \"point\"").shows(&device, &middle(250.0));
    // In level 0 the probes are at 16u − 0.5 = 4.5, 6.5, 8.5 and 10.5: 45, 65, 85, 105.
    with(16, "none").shows(&device, &middle(75.0));
    // λ = 3 + 1 − 2: level 2. No level before 3.
    let mut biased = with(16, "point");
    biased.stage += ", lod_bias = 1";
    biased.shows(&device, &middle(5.0));
    let mut limited = with(16, "point");
    limited.stage += ", max_mip_level = 3";
    limited.shows(&device, &middle(250.0));
    // λ = 3 − 3 is magnified: one probe, in level 0 between columns 7 and 8.
    let mut magnified = with(16, "point");
    magnified.stage += ", lod_bias = -3";
    magnified.shows(&device, &middle(75.0));
    // A border: at u = 0 two probes are outside (columns −2 and −1), two are columns 0 and 1 of level 1. Border is 0.
    let mut edge = with(16, "point");
    edge.stage = edge.stage.replace("\"clamp\"", "\"border\"");
    edge.at[0] = -2.0;
    edge.shows(&device, &middle((20.0 + 40.0) / 4.0));
}

/// A surface that goes away from the eye, in every way that one can be sampled.
fn surface(kind: &str, stage: &str, model: Model) -> Scene {
    let mut numbers = 1u32;
    let mut random = || {
        numbers = numbers.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(numbers >> 24) / 255.0
    };
    let (size, count) = match kind {
        "2d" => ("[16, 12]", 192),
        "volume" => ("[8, 8, 8]", 512),
        _ => ("[8, 8]", 384),
    };
    let mut texels = String::new();
    for _ in 0..count {
        let _ = write!(
            texels,
            "[{}, {}, {}, {}],",
            random(),
            random(),
            random(),
            random()
        );
    }
    let text = format!(
        r#"
        size = [96, 64]
        clear = [0, 0, 0, 1]
        [camera]
        position = [0, 0.6, -2]
        look_at = [0, 0, 0]
        [meshes.floor]
        positions = [[-3, 0, -1.8], [-3, 0, 4], [3, 0, 4], [3, 0, -1.8]]
        normals = [[-0.9, -0.6, 1], [-1.5, 1.5, 0.8], [1.7, 1.5, 1], [0.9, -0.7, 1.2]]
        indices = [0, 1, 2, 0, 2, 3]
        [textures.t]
        kind = "{kind}"
        size = {size}
        texels = [{texels}]
        mipmaps = true
        [[draw]]
        mesh = "floor"
        vs_text = "vs.1.1 m4x4 oPos, v0, c0 mov oT0, v3"
        ps_text = "ps.1.1 tex t0 mov r0, t0"
        vs_constants.c0 = "world_view_projection"
        state = {{ cull = "none" }}
        stages.0 = {{ texture = "t", {stage} }}
        "#
    );
    load(&text, model)
}

/// What the shader puts together itself is the same on both paths but for what the last bits of coordinates are worth: a
/// rounding here and there, and, where the nearest level or texel is read, another one where a pixel lies in the middle.
fn same_on_both(device: &Device, kind: &str, stage: &str, model: Model) -> Vec<u8> {
    let scene = surface(kind, stage, model);
    let (cpu, gpu) = draw(device, &scene);
    let [inside, _] = Differences::inside_and_on_edges(&cpu, &gpu).expect("one size");
    let about = format!("{kind}, {stage}, {model}");
    assert!(inside.pixels() > 3000, "{about}: {}", inside.pixels());
    // A weight of 8 bits may be another step on two axes at once.
    let (most, above) = match stage.contains("\"point\"") {
        true => (255, inside.pixels() / 500),
        false => (2, inside.pixels() / 1000),
    };
    assert!(
        inside.max() <= most && inside.above(1) <= above && inside.count(1) * 12 <= inside.pixels(),
        "{about}: {:?}, worst {:?}",
        inside.counts().collect::<Vec<_>>(),
        inside.worst
    );
    cpu.to_image().into_raw()
}

#[test]
fn surfaces_sampled_texel_by_texel() {
    let Some(device) = crate::device() else {
        return;
    };
    for kind in ["2d", "volume", "cube"] {
        let linear = same_on_both(
            &device,
            kind,
            "filter = \"linear\", mip = \"linear\", address = \"border\", border = [1, 0, 0, 1]",
            Model::R200,
        );
        let mut before = vec![linear];
        for stage in [
            "filter = \"anisotropic\", max_anisotropy = 4, mip = \"linear\"",
            "filter = \"anisotropic\", max_anisotropy = 16, mip = \"linear\", seamless = true, address = \"mirror\"",
            "filter = \"anisotropic\", max_anisotropy = 16, mip = \"point\", address = [\"clamp\", \"border\", \"mirror_once\"]",
            "filter = \"linear\", mip = \"point\", lod_bias = -0.5, seamless = true, address = \"mirror_once\"",
        ] {
            let picture = same_on_both(&device, kind, stage, Model::Float);
            assert!(
                !before.contains(&picture),
                "{kind}: {stage} changes nothing"
            );
            before.push(picture);
        }
    }
}

/// The weights of the hardware models, on every kind of texture, in smaller levels and between levels.
#[test]
fn surfaces_under_the_models() {
    let Some(device) = crate::device() else {
        return;
    };
    for kind in ["2d", "volume", "cube"] {
        for stage in [
            "filter = \"linear\"",
            "filter = \"linear\", mip = \"linear\", seamless = true",
            "filter = \"linear\", mip = \"point\", address = \"mirror\"",
            "filter = \"point\", mip = \"linear\", lod_bias = 0.3",
            "filter = \"anisotropic\", max_anisotropy = 3, mip = \"linear\"",
        ] {
            let full = same_weights(kind, stage);
            for model in [Model::Gf3, Model::R200] {
                let picture = same_on_both(&device, kind, stage, model);
                assert_ne!(picture, full, "{kind}, {stage}: {model} changes nothing");
            }
        }
    }
}

fn same_weights(kind: &str, stage: &str) -> Vec<u8> {
    let cpu = surface(kind, stage, Model::Float).render(&RenderOptions::default(), &|_| ());
    cpu.expect("the CPU renders").to_image().into_raw()
}
