//! The scenes of the gallery, those of the article apart, which `frames` has.

use std::fs;
use std::path::Path;

use texcrd::gpu::{Differences, Renderer};
use texcrd::scene::{DirectoryResolver, LoadOptions, RenderOptions, Resolver, Scene};

use crate::frames::Files;

/// Half of what the scenes say: what is drawn is the same, and less of it.
const SIZE: [u32; 2] = [200, 150];

/// Most scenes draw the same cube map of the room: a sixteenth of its texels is as good a test.
fn smaller(line: &str) -> String {
    match line {
        "size = 256" => "size = 64",
        _ => line,
    }
    .into()
}

/// No pixel inside a triangle is more than a step of 1/255 apart, in pictures and in render targets, as `texcrd compare` asks
/// for: the gallery has no mip levels, its cube maps are seamless, and its points end in nothing.
#[test]
fn every_scene_holds() {
    let Some(device) = crate::device() else {
        return;
    };
    let folders = Path::new(env!("CARGO_MANIFEST_DIR")).join("asm");
    let entries = |folder: &Path| {
        let entries = fs::read_dir(folder).expect("the folder can be read");
        entries.map(|entry| entry.expect("an entry").path())
    };
    let mut renderer = Renderer::new(&device);
    let (mut count, mut pixels, mut apart) = (0, [0; 2], Vec::new());
    for folder in entries(&folders) {
        if !folder.is_dir() || folder.ends_with("stained_glass") {
            continue;
        }
        for file in entries(&folder) {
            let files = Files {
                folder: DirectoryResolver::new(&folder),
                edit: &smaller,
            };
            let name = file.file_name().and_then(|name| name.to_str());
            let name = name.expect("a readable name");
            let bytes = files.read(name).expect("the file can be read");
            // What scenes share has no camera, and is no picture.
            if file.extension().is_none_or(|found| found != "toml")
                || !String::from_utf8_lossy(&bytes).contains("\n[camera]\n")
            {
                continue;
            }
            let scene = Scene::load(name, &bytes, &files, &LoadOptions::default());
            let scene = scene.unwrap_or_else(|error| panic!("{error}"));
            let options = RenderOptions {
                size: Some(SIZE),
                show: None,
            };
            let cpu = (scene.rendering(&options, &|_| ())).expect("the CPU renders");
            let gpu = renderer.frame(&scene, &options, &cpu.target_pictures(), &|_| ());
            let gpu = gpu.expect("the GPU renders");
            let targets = (cpu.targets().iter().map(|target| &target.drawn))
                .zip(gpu.targets().iter().map(|target| &target.picture));
            for (cpu, gpu) in targets.chain([(cpu.picture(), gpu.picture())]) {
                let found = Differences::inside_and_on_edges(cpu, gpu);
                let [inside, edges] = found.expect("the pictures have one size");
                pixels[0] += inside.pixels();
                pixels[1] += edges.pixels();
                if inside.max() > 1 {
                    apart.push(format!("{}: {:?}", file.display(), inside.worst));
                }
            }
            count += 1;
        }
    }
    assert!(count >= 25, "only {count} scenes");
    // Were edges most of the pictures, little would be tested.
    assert!(pixels[0] > pixels[1] * 4, "{pixels:?}");
    assert!(apart.is_empty(), "{apart:#?}");
}
