//! The scenes of the gallery, those of the article apart, which `frames` has.

use std::fs;
use std::path::Path;

use texcrd::gpu::{Differences, Renderer};
use texcrd::scene::{DirectoryResolver, LoadOptions, RenderOptions, Scene};

/// Half of what the scenes say: what is drawn is the same, and less of it.
const SIZE: [u32; 2] = [200, 150];

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
    let (mut count, mut apart) = (0, Vec::new());
    for folder in entries(&folders) {
        if !folder.is_dir() || folder.ends_with("stained_glass") {
            continue;
        }
        for file in entries(&folder) {
            let bytes = fs::read(&file).expect("the file can be read");
            // What scenes share has no camera, and is no picture.
            if file.extension().is_none_or(|found| found != "toml")
                || !String::from_utf8_lossy(&bytes).contains("\n[camera]\n")
            {
                continue;
            }
            let name = file.display().to_string();
            let resolver = DirectoryResolver::new(&folder);
            let scene = Scene::load(&name, &bytes, &resolver, &LoadOptions::default());
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
                // Were edges most of a picture, nothing would be tested.
                assert!(inside.pixels() > edges.pixels(), "{name}");
                if inside.max() > 1 {
                    apart.push(format!("{name}: {:?}", inside.worst));
                }
            }
            count += 1;
        }
    }
    assert!(count >= 25, "only {count} scenes");
    assert!(apart.is_empty(), "{apart:#?}");
}
