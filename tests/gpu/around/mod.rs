//! What surrounds the shaders, drawn on both paths and compared with pictures that were worked out by hand from the rules of
//! Direct3D 8.

mod coverage;
mod depth;
mod inputs;
mod merging;

use std::collections::BTreeMap;

use image::RgbaImage;
use texcrd::gpu::{Device, Renderer};
use texcrd::scene::{LoadOptions, RenderOptions, Scene};

/// The side of the pictures, unless a test says otherwise. A power of two, so that positions are exact.
const SIDE: u32 = 16;

/// The eight comparisons, and whether each holds for a left side that is smaller than, equal to and greater than the right one:
/// the new depth and the old, the reference of the stencil and what is stored, the alpha and its reference.
const FUNCTIONS: [(&str, [bool; 3]); 8] = [
    ("never", [false, false, false]),
    ("less", [true, false, false]),
    ("equal", [false, true, false]),
    ("lessequal", [true, true, false]),
    ("greater", [false, false, true]),
    ("notequal", [true, false, true]),
    ("greaterequal", [false, true, true]),
    ("always", [true, true, true]),
];

/// A vertex by where it lands on a screen of [`SIDE`] by [`SIDE`] pixels.
#[derive(Clone, Copy)]
struct Vertex {
    /// In pixels.
    at: [f32; 2],
    /// The depth.
    z: f32,
    w: f32,
    diffuse: [f32; 4],
    specular: [f32; 4],
    /// Coordinate set 0.
    t: [f32; 4],
    fog: f32,
    size: f32,
}

/// A white vertex at depth 0.5.
fn on(x: f32, y: f32) -> Vertex {
    Vertex {
        at: [x, y],
        z: 0.5,
        w: 1.0,
        diffuse: [1.0; 4],
        specular: [0.0; 4],
        t: [0.0, 0.0, 0.0, 1.0],
        fog: 1.0,
        size: 1.0,
    }
}

/// Two triangles over a rectangle, all vertices like the one given.
fn rectangle([x0, y0, x1, y1]: [f32; 4], like: Vertex) -> Vec<Vertex> {
    let corner = |at| Vertex { at, ..like };
    let [a, b, c, d] = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(corner);
    vec![a, b, c, a, c, d]
}

/// The same over the whole picture.
fn everywhere(like: Vertex) -> Vec<Vertex> {
    let side = SIDE as f32;
    rectangle([-1.0, -1.0, side, side], like)
}

/// Depth, colour and fog of what fills a picture.
fn deep(z: f32) -> Vertex {
    Vertex { z, ..on(0.0, 0.0) }
}

fn colored(r: f32, g: f32, b: f32, a: f32) -> Vertex {
    Vertex {
        diffuse: [r, g, b, a],
        ..on(0.0, 0.0)
    }
}

/// The vertex shader of all these draws; `oPts` is left out, as it would replace the size of the state.
const VERTEX: &str =
    "vs.1.1\\nmov oPos, v0\\nmov oD0, v1\\nmov oD1, v2\\nmov oT0, v3\\nmov oFog.x, v4.x\\n";
/// What writes it.
const SIZED: &str = "mov oPts.x, v4.y\\n";
/// A pixel shader that gives the diffuse colour.
const DIFFUSE: &str = "ps.1.1\\nmov r0, v0\\n";

/// A draw and its mesh as the text of a scene. `keys` are further keys of the draw, one a line; those that stand here, too,
/// replace these.
fn draw(vertices: &[Vertex], keys: &str) -> String {
    let list = |of: &dyn Fn(&Vertex) -> Vec<f32>| {
        let rows: Vec<String> = vertices.iter().map(|v| format!("{:?}", of(v))).collect();
        format!("[{}]", rows.join(", "))
    };
    let half = SIDE as f32 / 2.0;
    let place = |v: &Vertex| {
        let [x, y] = [v.at[0] / half - 1.0, 1.0 - v.at[1] / half];
        vec![x * v.w, y * v.w, v.z * v.w, v.w]
    };
    // Names of meshes must differ; what they are called does not matter.
    let name = NAMES.with(|names| {
        names.set(names.get() + 1);
        names.get()
    });
    let mesh = format!(
        "[meshes.m{name}]\npositions = {}\ntexcoords = {}\ntexcoords1 = {}\ntexcoords2 = {}\ncolors = {}\nspeculars = {}\n",
        list(&|_| vec![0.0; 3]),
        list(&|v| v.t.to_vec()),
        list(&place),
        list(&|v| vec![v.fog, v.size]),
        list(&|v| v.diffuse.to_vec()),
        list(&|v| v.specular.to_vec()),
    );
    let defaults = [
        ("vs_text", format!("\"{VERTEX}\"")),
        ("ps_text", format!("\"{DIFFUSE}\"")),
        (
            "declaration",
            "{ v0 = \"texcoord1\", v1 = \"color\", v2 = \"specular\", v3 = \"texcoord\", v4 = \"texcoord2\" }"
                .to_owned(),
        ),
    ];
    let given = |key: &str| keys.lines().any(|line| line.starts_with(key));
    let defaults = defaults.iter().filter(|(key, _)| !given(key));
    let defaults: String = (defaults.map(|(key, value)| format!("{key} = {value}\n"))).collect();
    format!("{mesh}[[draw]]\nmesh = \"m{name}\"\n{defaults}{keys}\n")
}

thread_local! {
    static NAMES: std::cell::Cell<u32> = const { std::cell::Cell::new(0) };
}

/// A picture of so many pixels, black and opaque unless further keys of the scene say otherwise.
fn scene(size: [u32; 2], keys: &str, draws: &[String]) -> Scene {
    let text = format!("size = {size:?}\n{keys}\n{}", draws.concat());
    let files: BTreeMap<String, Vec<u8>> = BTreeMap::new();
    let scene = Scene::load(
        "scene.toml",
        text.as_bytes(),
        &files,
        &LoadOptions::default(),
    );
    scene.unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The pictures of a scene on the CPU and on the GPU.
struct Both<'d> {
    /// None where these tests are to go without a GPU.
    renderer: Option<Renderer<'d>>,
}

impl<'d> Both<'d> {
    fn new(device: &'d Option<Device>) -> Self {
        Self {
            renderer: device.as_ref().map(Renderer::new),
        }
    }

    fn pictures(&mut self, scene: &Scene) -> Vec<(&'static str, RgbaImage)> {
        let options = RenderOptions::default();
        let cpu = scene.render(&options, &|_| ()).expect("the CPU renders");
        let gpu = self.renderer.as_mut().map(|renderer| {
            let drawn = renderer.render(scene, &options, &|_| ());
            ("GPU", drawn.expect("the GPU renders"))
        });
        std::iter::once(("CPU", cpu.to_image()))
            .chain(gpu)
            .collect()
    }

    /// Draws, and says which pixels of a black picture are not black, row by row.
    fn covered(&mut self, draws: &[String]) -> Vec<(&'static str, Vec<(u32, u32)>)> {
        let scene = scene([SIDE; 2], "", draws);
        let pictures = self.pictures(&scene).into_iter();
        let covered = pictures.map(|(path, picture)| {
            let pixels = picture.enumerate_pixels();
            let lit = pixels.filter(|(_, _, pixel)| pixel.0 != [0, 0, 0, 255]);
            (path, lit.map(|(x, y, _)| (x, y)).collect())
        });
        covered.collect()
    }

    /// Both paths must light these pixels and no others.
    #[track_caller]
    fn lights(&mut self, what: &str, draws: &[String], mut expected: Vec<(u32, u32)>) {
        expected.sort_by_key(|(x, y)| (*y, *x));
        for (path, lit) in self.covered(draws) {
            assert_eq!(lit, expected, "{what} on the {path}");
        }
    }

    /// Both paths must give these colours, each channel to within a step.
    #[track_caller]
    fn shows(&mut self, what: &str, scene: &Scene, expected: &[((u32, u32), [u8; 4])]) {
        for (path, picture) in self.pictures(scene) {
            for ((x, y), color) in expected {
                let found = picture.get_pixel(*x, *y).0;
                let near = (found.iter().zip(color)).all(|(a, b)| a.abs_diff(*b) <= 1);
                assert!(
                    near,
                    "{what} at {x}, {y} on the {path}: {found:?}, not {color:?}"
                );
            }
        }
    }

    /// Each column of a picture of one row is a small experiment of its own: both paths must light those columns where
    /// this is true, and leave the others black.
    #[track_caller]
    fn columns(&mut self, keys: &str, columns: &[Column]) {
        let width = columns.len() as u32;
        let draws: Vec<String> = (columns.iter().zip(0..))
            .flat_map(|(column, x)| column.draws(x))
            .collect();
        let scene = scene([width, 1], keys, &draws);
        for (path, picture) in self.pictures(&scene) {
            for (column, x) in columns.iter().zip(0..) {
                let lit = picture.get_pixel(x, 0).0[0] > 0;
                assert_eq!(lit, column.lit, "{} on the {path}", column.name);
            }
        }
    }
}

/// An experiment on one pixel: draws over it, and whether its red is lit in the end.
struct Column {
    name: String,
    steps: Vec<Step>,
    lit: bool,
}

/// One draw of an experiment.
struct Step {
    /// What its vertices are like.
    like: Vertex,
    /// The lines of its states.
    state: String,
    /// Its pixel shader.
    shader: &'static str,
    /// What its viewport says of depths.
    depths: &'static str,
}

impl Column {
    fn new(name: impl Into<String>, lit: bool) -> Self {
        Self {
            name: name.into(),
            steps: Vec::new(),
            lit,
        }
    }

    /// A draw with these states.
    fn step(mut self, like: Vertex, state: impl Into<String>) -> Self {
        self.steps.push(Step {
            like,
            state: state.into(),
            shader: DIFFUSE,
            depths: "",
        });
        self
    }

    /// The same that leaves no colour.
    fn unseen(self, like: Vertex, state: &str) -> Self {
        self.step(like, format!("color_write = \"\"\n{state}"))
    }

    /// The last draw with another pixel shader.
    fn shaded(mut self, shader: &'static str) -> Self {
        self.steps.last_mut().expect("a step").shader = shader;
        self
    }

    /// The last draw with other depths of its viewport.
    fn ranged(mut self, depths: &'static str) -> Self {
        self.steps.last_mut().expect("a step").depths = depths;
        self
    }

    /// The draws, into a viewport of one pixel.
    fn draws(&self, x: u32) -> Vec<String> {
        let draws = self.steps.iter().map(|step| {
            let (shader, state, depths) = (step.shader, &step.state, step.depths);
            let depths = if depths.is_empty() {
                String::new()
            } else {
                format!(", {depths}")
            };
            let keys = format!(
                "ps_text = \"{shader}\"\n[draw.state]\n{state}\n\
                 viewport = {{ x = {x}, y = 0, width = 1, height = 1{depths} }}"
            );
            draw(&everywhere(step.like), &keys)
        });
        draws.collect()
    }
}
