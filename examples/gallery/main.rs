//! The gallery: renders the scenes of `asm/`, traces the same rooms exactly, and writes down how far the one is from the
//! other. It writes the pictures of the gallery, its plots and the tables in its pages.
//!
//! `cargo run --release --example gallery` does all of it; with names of folders only these are done.
//!
//! Files: `exhibits` (what there is), `tree` and `world` (what rays meet), `optics` and `truth` (how they go on), `probe`
//! (what a shader looks up), `measure` (both compared), `plot`, `pages` (tables, pictures), `marks` (where in a page),
//! `tables` (textures that hold numbers).

mod exhibits;
mod marks;
mod measure;
mod optics;
mod pages;
mod plot;
mod probe;
mod tables;
mod tree;
mod truth;
mod world;

use exhibits::{PIECES, Piece};
use measure::{Measured, measure};
use std::error::Error;
use std::path::Path;
use std::time::Instant;
use texcrd::scene::{DirectoryResolver, LoadOptions, Output, RenderOptions, Scene};

/// All pictures are of this size.
const SIZE: [u32; 2] = [400, 300];

/// A piece after its scene was rendered.
pub(crate) struct Done {
    pub(crate) piece: &'static Piece,
    pub(crate) picture: image::RgbaImage,
    pub(crate) measured: Option<Measured>,
    /// Slots of the vertex shader, and of each phase of the pixel shader: texture and arithmetic.
    pub(crate) slots: (u32, Vec<[u32; 2]>),
    /// The version of the pixel shader.
    pub(crate) version: String,
}

fn main() -> Result<(), Box<dyn Error>> {
    let folders: Vec<String> = std::env::args().skip(1).collect();
    let begun = Instant::now();
    tables::write()?;
    let mut all = Vec::new();
    for piece in PIECES {
        if folders.is_empty() || folders.iter().any(|folder| folder == piece.folder) {
            let done = run(piece)?;
            println!("{}", pages::line(&done));
            all.push(done);
        }
    }
    pages::write(&all, folders.is_empty())?;
    println!("{:.1} s", begun.elapsed().as_secs_f64());
    Ok(())
}

fn run(piece: &'static Piece) -> Result<Done, Box<dyn Error>> {
    let folder = Path::new("asm").join(piece.folder);
    let name = format!("{}.toml", piece.scene);
    let bytes = std::fs::read(folder.join(&name))?;
    let resolver = DirectoryResolver::new(&folder);
    let scene = Scene::load(&name, &bytes, &resolver, &LoadOptions::default())?;
    let options = RenderOptions {
        size: Some(SIZE),
        show: None,
    };
    let rendering = scene.rendering(&options, &|_| ())?;
    let draws = (rendering.pass(Output::Picture)).map_or(&[][..], |pass| &pass.draws);
    let subject = piece.subject.map(|subject| subject.draw);
    let shown = draws.iter().find(|draw| subject == Some(draw.name));
    let shown = shown.or(draws.last()).ok_or("a scene draws something")?;
    let slots = |program| texcrd::validate::statistics(program).phases;
    let vertex = slots(&shown.vertex.program);
    let pixel = slots(&shown.pixel.program);
    Ok(Done {
        piece,
        picture: rendering.picture().to_image(),
        measured: (piece.subject.as_ref())
            .map(|subject| measure(&rendering, subject))
            .transpose()?,
        slots: (
            vertex.iter().map(|phase| phase.arithmetic.used).sum(),
            pixel
                .iter()
                .map(|phase| [phase.texture.used, phase.arithmetic.used])
                .collect(),
        ),
        version: shown.pixel.program.version.to_string(),
    })
}
