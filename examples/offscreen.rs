//! Draws a scene on the GPU and on the CPU with the library alone, and writes both pictures:
//! `cargo run --release --example offscreen asm/stained_glass/scene.toml`.

use std::error::Error;
use std::path::Path;

use texcrd::gpu::{Device, Differences, Renderer};
use texcrd::scene::{DirectoryResolver, LoadOptions, RenderOptions, Scene};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("which scene?")?;
    let folder = Path::new(&path).parent().unwrap_or(Path::new(""));
    let resolver = DirectoryResolver::new(folder);
    let bytes = std::fs::read(&path)?;
    let scene = Scene::load(&path, &bytes, &resolver, &LoadOptions::default())?;

    let device = Device::open(None)?;
    let gpu = Renderer::new(&device).render(&scene, &RenderOptions::default(), &|_| ())?;
    gpu.save("gpu.png")?;

    let cpu = scene.render(&RenderOptions::default(), &|_| ())?;
    let cpu = cpu.to_image();
    cpu.save("cpu.png")?;

    if let Some(differences) = Differences::between(&cpu, &gpu) {
        let (above, pixels) = (differences.above(1), differences.pixels());
        println!(
            "{}: {above} of {pixels} pixels differ by more than 1/255",
            device.adapter()
        );
    }
    Ok(())
}
