//! Whole frames of the article's scenes, in 8 bits.

use std::path::Path;

use image::RgbaImage;
use texcrd::gpu::{Device, Renderer};
use texcrd::raster::Target;
use texcrd::scene::{DirectoryResolver, LoadOptions, RenderOptions, Resolver, Scene};

const SIZE: [u32; 2] = [320, 240];

/// The folder of the scenes; without mips, every `mip` is `none`.
struct Files {
    folder: DirectoryResolver,
    mips: bool,
}

impl Resolver for Files {
    fn read(&self, path: &str) -> std::io::Result<Vec<u8>> {
        let bytes = self.folder.read(path)?;
        match String::from_utf8(bytes) {
            Ok(text) if !self.mips && path.ends_with(".toml") => Ok(text
                .replace("mip = \"linear\"", "mip = \"none\"")
                .into_bytes()),
            Ok(text) => Ok(text.into_bytes()),
            Err(binary) => Ok(binary.into_bytes()),
        }
    }
}

fn scene(name: &str, mips: bool) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("asm/stained_glass");
    let folder = DirectoryResolver::new(folder);
    let files = Files { folder, mips };
    let bytes = files.read(name).expect("the scene file is there");
    match Scene::load(name, &bytes, &files, &LoadOptions::default()) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

fn both(device: &Device, name: &str, mips: bool) -> (Target, RgbaImage) {
    let scene = scene(name, mips);
    let options = RenderOptions {
        size: Some(SIZE),
        show: None,
    };
    let cpu = scene.render(&options, &|_| ()).expect("the CPU renders");
    let gpu = Renderer::new(device).render(&scene, Some(SIZE), &|_| ());
    (cpu, gpu.expect("the GPU renders"))
}

/// Whether a pixel lies inside a triangle, with its neighbours: depth is a plane there, on the screen. Where it is not,
/// an edge of a triangle passes, and which side a pixel is on may differ.
fn inside(target: &Target, x: u32, y: u32) -> bool {
    let depth = |x: u32, y: u32| target.depth(x, y).map(f64::from);
    let flat = |before: Option<f64>, at: Option<f64>, after: Option<f64>| {
        let (Some(before), Some(at), Some(after)) = (before, at, after) else {
            return false;
        };
        // Rounding of a float of up to 1 is 2⁻²⁵, three times.
        (before - 2.0 * at + after).abs() < 2e-7
    };
    let at = depth(x, y);
    flat(depth(x.wrapping_sub(1), y), at, depth(x + 1, y))
        && flat(depth(x, y.wrapping_sub(1)), at, depth(x, y + 1))
}

/// What was found in the pixels inside triangles.
#[derive(Debug, Default)]
struct Found {
    inside: usize,
    /// Pixels by their greatest difference, up to 255.
    counts: std::collections::BTreeMap<u8, usize>,
    edges: usize,
    edges_above_1: usize,
}

impl Found {
    fn above(&self, step: u8) -> usize {
        self.counts.range(step + 1..).map(|(_, count)| count).sum()
    }

    fn max(&self) -> u8 {
        self.counts.keys().next_back().copied().unwrap_or(0)
    }
}

fn differences(cpu: &Target, gpu: &RgbaImage) -> Found {
    let mut found = Found::default();
    for (x, y, pixel) in gpu.enumerate_pixels() {
        let color = cpu.color(x, y).expect("the pictures have one size");
        let pairs = color.into_iter().zip(pixel.0);
        let step = pairs.map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0);
        if inside(cpu, x, y) {
            found.inside += 1;
            *found.counts.entry(step).or_default() += 1;
        } else {
            found.edges += 1;
            found.edges_above_1 += usize::from(step > 1);
        }
    }
    found
}

fn compare(name: &str, mips: bool) -> Option<Found> {
    let device = crate::device()?;
    let (cpu, gpu) = both(&device, name, mips);
    let found = differences(&cpu, &gpu);
    println!("{name}, mips {mips}: {found:?}");
    // Edges are lines in a picture: were they most of it, nothing would be tested.
    assert!(found.inside > found.edges * 2, "{found:?}");
    Some(found)
}

/// The room alone is one 2D sample a pixel: the weights are the same up to 0.0001/255, so that only a value half way between
/// two steps can round to either.
#[test]
fn the_room_without_mips() {
    if let Some(found) = compare("room.toml", false) {
        assert!(found.max() <= 1, "{found:?}");
    }
}

/// Clear glass: flat normals, so that the two looked-up directions of neighbours are close, and errors of interpolation
/// (7e-6 of a coordinate) are worth less than a step of 1/255 in the cube map.
#[test]
fn clear_glass_without_mips() {
    if let Some(found) = compare("figure5.toml", false) {
        assert!(found.max() <= 1, "{found:?}");
    }
}

/// Stained glass: a normal map perturbs the direction. The room behind is rendered into a cube map of its own first, on
/// each path by itself: where an edge of the room falls on different texels there, the difference of that texel would be
/// seen through the middle of the pane. That this is the whole reason is not proved.
///
/// A guard against getting worse, not the bound to be met: at most 1 for every pixel inside is what is wanted; 22 of 69676
/// were above it, 3 at most, when this was written. The limits leave room for other versions of the adapter.
#[test]
fn stained_glass_without_mips() {
    if let Some(found) = compare("scene.toml", false) {
        assert!(found.above(1) * 1000 <= found.inside, "{found:?}");
        assert!(found.max() <= 8, "{found:?}");
    }
}

/// With mips the level of detail of the adapter is off by up to 0.0625 (a linear mantissa for the logarithm), and more
/// at the seams of a cube; what that is worth depends on how much two levels differ, and a bound has yet to be derived
/// from it. Until then this guards against getting worse: 96.5 % of the stained glass were within 1 and 83 pixels above 8
/// when this was written.
#[test]
fn with_mips() {
    for name in ["figure5.toml", "scene.toml"] {
        if let Some(found) = compare(name, true) {
            assert!(
                found.above(1) * 100 <= found.inside * 4,
                "{name}: {found:?}"
            );
            assert!(
                found.above(8) * 1000 <= found.inside * 2,
                "{name}: {found:?}"
            );
        }
    }
}
