//! Whole frames of the article's scenes, in 8 bits.

use std::path::Path;

use image::RgbaImage;
use texcrd::gpu::{Device, Differences, LEVEL_ERROR, Renderer};
use texcrd::raster::Target;
use texcrd::scene::{
    DirectoryResolver, LoadOptions, Output, RenderOptions, Resolver, Scene, TargetPicture,
};

/// The size that the scenes name.
const FULL: [u32; 2] = [1280, 960];
const SMALL: [u32; 2] = [320, 240];

/// What a line of a scene file becomes.
pub(crate) type Edit<'a> = &'a dyn Fn(&str) -> String;

/// A folder of scenes, whose lines are changed as they are read.
pub(crate) struct Files<'a> {
    pub(crate) folder: DirectoryResolver,
    pub(crate) edit: Edit<'a>,
}

impl Resolver for Files<'_> {
    fn read(&self, path: &str) -> std::io::Result<Vec<u8>> {
        let bytes = self.folder.read(path)?;
        if !path.ends_with(".toml") {
            return Ok(bytes);
        }
        let text = String::from_utf8(bytes).expect("scene files are text");
        let lines = text.lines().map(self.edit);
        Ok(lines.collect::<Vec<_>>().join("\n").into_bytes())
    }
}

const MIP: &str = "mip = \"linear\"";

/// Textures and cube map with a sixteenth of the texels, for tests that make them many times.
fn small_textures(line: &str) -> String {
    match line {
        "size = 512" => "size = 128",
        "size = [512, 512]" => "size = [128, 128]",
        "size = [1024, 1024]" => "size = [256, 256]",
        "size = [1024, 1280]" => "size = [256, 320]",
        _ => line,
    }
    .into()
}

fn no_mips(line: &str) -> String {
    line.replace(MIP, "mip = \"none\"")
}

fn scene(name: &str, edit: Edit<'_>) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("asm/stained_glass");
    let folder = DirectoryResolver::new(folder);
    let files = Files { folder, edit };
    let bytes = files.read(name).expect("the scene file is there");
    match Scene::load(name, &bytes, &files, &LoadOptions::default()) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

fn on_cpu(name: &str, edit: Edit<'_>, size: [u32; 2]) -> (Target, Vec<TargetPicture>) {
    let options = RenderOptions {
        size: Some(size),
        show: None,
    };
    let scene = scene(name, edit);
    let drawn = (scene.rendering(&options, &|_| ())).expect("the CPU renders");
    let targets = drawn.target_pictures();
    (drawn.into_picture(), targets)
}

/// Draws each picture from what the CPU's render targets hold: one step of 1/255 in a target and one in the picture itself
/// would be two.
fn on_gpu(
    device: &Device,
    name: &str,
    edit: Edit<'_>,
    size: [u32; 2],
    targets: &[TargetPicture],
) -> (RgbaImage, Vec<TargetPicture>) {
    let options = RenderOptions {
        size: Some(size),
        show: None,
    };
    let (scene, mut renderer) = (scene(name, edit), Renderer::new(device));
    let drawn = renderer.frame(&scene, &options, targets, &|_| ());
    let drawn = drawn.expect("the GPU renders");
    (drawn.picture().clone(), drawn.targets().to_vec())
}

/// Without mips, as large as the scene says.
///
/// Texture filters agree to 0.0001 steps of 1/255 on the adapter, so that only values half way between two steps can round
/// to either. At most one pixel in ten thousand may show another triangle: where an edge goes through the very middle of
/// a pixel, the last bit of a vertex's position decides.
fn compare_without_mips(name: &str) {
    let Some(device) = crate::device() else {
        return;
    };
    let (cpu, targets) = on_cpu(name, &no_mips, FULL);
    let (gpu, drawn) = on_gpu(&device, name, &no_mips, FULL, &targets);
    assert_eq!(targets.len(), drawn.len());
    for (cpu, gpu) in targets.iter().zip(&drawn) {
        let differences = Differences::between(&cpu.picture, &gpu.picture).expect("one size");
        println!(
            "{name}, face {}: {:?}",
            cpu.face,
            differences.counts().collect::<Vec<_>>()
        );
        assert!(differences.above(1) * 10_000 <= differences.pixels());
    }
    let [inside, edges] =
        Differences::inside_and_on_edges(&cpu, &gpu).expect("the pictures have one size");
    for (place, found) in [("inside", &inside), ("on edges", &edges)] {
        println!("{name}, {place}: {:?}", found.counts().collect::<Vec<_>>());
    }
    // Edges are lines in a picture: were they most of it, nothing would be tested.
    assert!(inside.pixels() > edges.pixels() * 2);
    assert!(inside.max() <= 1, "{:?}", inside.worst);
    let all = inside.pixels() + edges.pixels();
    assert!(edges.above(1) * 10_000 <= all, "{:?}", edges.worst);
}

#[test]
fn the_room_without_mips() {
    compare_without_mips("room.toml");
}

#[test]
fn the_lookup_without_correction_without_mips() {
    compare_without_mips("figure1.toml");
}

#[test]
fn clear_glass_without_mips() {
    compare_without_mips("figure5.toml");
}

#[test]
fn stained_glass_without_mips() {
    compare_without_mips("scene.toml");
}

/// With mips. The level of detail of Mesa's software adapter is never above the true one, so that each pixel of the GPU must
/// lie between what the CPU draws with none and with all of the error, in every combination over the stages; and a step of
/// 1/255 more, because a direction that a mixed normal turns is not in proportion to it.
#[test]
fn with_mips() {
    let Some(device) = crate::device() else {
        return;
    };
    for name in ["figure5.toml", "scene.toml"] {
        let scene = scene(name, &small_textures);
        let options = RenderOptions {
            size: Some(SMALL),
            show: None,
        };
        let cpu = (scene.rendering(&options, &|_| ())).expect("the CPU renders");
        let range = cpu.level_range(Output::Picture, &[-LEVEL_ERROR, 0.0]);
        let range = range.expect("the CPU renders").expect("there are mips");
        let targets = cpu.target_pictures();
        let (gpu, _) = on_gpu(&device, name, &small_textures, SMALL, &targets);
        let [plain, _] = Differences::inside_and_on_edges(cpu.picture(), &gpu)
            .expect("the pictures have one size");
        let [beyond, _] = Differences::beyond_levels(cpu.picture(), &range, &gpu)
            .expect("the pictures have one size");
        println!("{name}: {:?}", plain.counts().collect::<Vec<_>>());
        println!("beyond levels: {:?}", beyond.counts().collect::<Vec<_>>());
        // Were the pictures equal without any of this, it would show nothing.
        assert!(plain.max() > 1);
        assert!(beyond.max() <= 1, "{name}: {:?}", beyond.worst);
    }
}

/// Whoever gives the pictures of targets sees them, and still gets what was drawn.
#[test]
fn given_targets_are_used() {
    let Some(device) = crate::device() else {
        return;
    };
    let size = [32, 24];
    let (_, targets) = on_cpu("figure5.toml", &small_textures, size);
    let white = targets.iter().map(|face| TargetPicture {
        picture: RgbaImage::from_pixel(128, 128, image::Rgba([255; 4])),
        ..face.clone()
    });
    let white: Vec<_> = white.collect();
    let (picture, drawn) = on_gpu(&device, "figure5.toml", &small_textures, size, &white);
    // The pane is clear: it shows what it looks up, and the gloss of the scene is 1.
    assert_eq!(picture.get_pixel(16, 12).0, [255; 4]);
    assert!(drawn[0].picture.pixels().any(|pixel| pixel.0 != [255; 4]));
}
