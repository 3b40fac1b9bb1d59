//! The pages of the gallery: sheets of pictures, and tables between two marks in Markdown files.

use crate::Done;
use crate::exhibits::{CONTACT, PLOTTED, Piece, WITHOUT_SHEET};
use crate::marks::put;
use crate::plot::{Axis, Line, plot};
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::imageops::{self, resize};
use image::{DynamicImage, RgbaImage};
use std::error::Error;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{BufWriter, Write as _};
use std::path::Path;
use texcrd::kernel::Slot;
use texcrd::raster::{Look, RegisterPicture};
use texcrd::sheet::{Dressing, Tile, compose};

/// What stands between these lines in a page is written by the gallery.
const BEGIN: &str = "<!-- measured: written by `cargo run --release --example gallery` -->";

/// What the program prints of a piece.
pub(crate) fn line(done: &Done) -> String {
    let name = format!("{}/{}", done.piece.folder, done.piece.scene);
    match cells(done) {
        Some([mean, worst, difference]) => {
            format!(
                "{name:32} {mean:>8} {worst:>8} {difference:>8}   {}",
                slots(done)
            )
        }
        None => format!("{name:32} {:>26}   {}", "", slots(done)),
    }
}

/// Mean and worst angle, and the difference of the pictures.
fn cells(done: &Done) -> Option<[String; 3]> {
    let measured = done.measured.as_ref()?;
    let angles = match done.piece.endless {
        true => measured.ray,
        false => measured.room,
    };
    Some([
        format!("{:.2}°", angles.mean),
        // A worst angle below the mean would be one that was rounded away.
        match angles.worst {
            worst if worst < 1.0 => format!("{worst:.2}°"),
            worst => format!("{worst:.1}°"),
        },
        format!("{:.2} %", 100.0 * measured.difference),
    ])
}

/// `17; 2+4, 1+1`: the slots of the vertex shader; then texture and arithmetic slots of each phase.
fn slots(done: &Done) -> String {
    let (vertex, phases) = &done.slots;
    let phases: Vec<_> = (phases.iter())
        .map(|[texture, arithmetic]| format!("{texture}+{arithmetic}"))
        .collect();
    format!("{vertex}; {} {}", done.version, phases.join(", "))
}

/// Writes the sheet and the table of each folder, and if everything was done the table of the gallery's own page.
///
/// # Errors
/// Files that cannot be read or written.
pub(crate) fn write(all: &[Done], everything: bool) -> Result<(), Box<dyn Error>> {
    let folders = all.chunk_by(|one, next| one.piece.folder == next.piece.folder);
    for pieces in folders {
        let Some(Piece { folder, .. }) = pieces.first().map(|done| done.piece) else {
            continue;
        };
        let place = Path::new("asm").join(folder);
        if !WITHOUT_SHEET.contains(folder) {
            save(&sheet(pieces)?, &place.join(format!("{folder}.png")))?;
        }
        put(&place.join("README.md"), BEGIN, &table(pieces, false))?;
        if PLOTTED.contains(folder) {
            std::fs::write(place.join("errors.svg"), by_incidence(pieces))?;
        }
    }
    if everything {
        put(Path::new("asm/README.md"), BEGIN, &table(all, true))?;
        let rgb = DynamicImage::ImageRgba8(contact(all)?).into_rgb8();
        let mut file = BufWriter::new(File::create("docs/gallery.jpg")?);
        JpegEncoder::new_with_quality(&mut file, 88).encode_image(&rgb)?;
        file.flush()?;
    }
    Ok(())
}

/// The pictures of pieces side by side, each with its title, and the traced picture wherever the truth is another.
fn sheet(pieces: &[Done]) -> Result<RgbaImage, Box<dyn Error>> {
    let mut tiles: Vec<(String, &RgbaImage)> = Vec::new();
    for (number, done) in pieces.iter().enumerate() {
        let title = done.piece.title;
        let caption = match cells(done) {
            // The letters on pictures have no degree sign.
            Some([mean, ..]) => format!("{title}: {}", mean.replace('°', " deg")),
            None => title.to_owned(),
        };
        tiles.push((caption, &done.picture));
        // The truth is the same for all techniques that try to show it.
        if let Some(measured) = &done.measured
            && pieces
                .get(number + 1)
                .is_none_or(|next| !same_truth(done, next))
        {
            tiles.push(("traced".to_owned(), &measured.traced));
        }
    }
    side_by_side(&tiles)
}

/// The pictures that open the project's page, smaller.
fn contact(all: &[Done]) -> Result<RgbaImage, Box<dyn Error>> {
    let pictures = CONTACT.iter().filter_map(|[folder, scene, title]| {
        let piece = |done: &&Done| done.piece.folder == *folder && done.piece.scene == *scene;
        let done = all.iter().find(piece)?;
        let small = resize(&done.picture, 280, 210, imageops::FilterType::Triangle);
        Some(((*title).to_owned(), small))
    });
    let pictures: Vec<_> = pictures.collect();
    let tiles: Vec<_> = (pictures.iter())
        .map(|(caption, picture)| (caption.clone(), picture))
        .collect();
    side_by_side(&tiles)
}

/// Pictures of one size on a sheet, with captions.
fn side_by_side(tiles: &[(String, &RgbaImage)]) -> Result<RgbaImage, Box<dyn Error>> {
    let size = tiles
        .first()
        .map_or([1, 1], |(_, picture)| picture.dimensions().into());
    let described: Vec<_> = (tiles.iter())
        .map(|(caption, _)| Tile {
            caption: caption.clone(),
            picture: RegisterPicture {
                slot: Slot::R0,
                instructions: usize::MAX,
                look: Look::default(),
                killed: false,
            },
        })
        .collect();
    let dressing = Dressing {
        captions: true,
        bars: false,
        columns: None,
    };
    let picture = |number: usize| {
        tiles
            .get(number)
            .map_or_else(RgbaImage::default, |(_, picture)| (*picture).clone())
    };
    Ok(compose(&described, size, dressing, &[], picture)?)
}

/// The errors of pieces by the angle at which the ray from the eye meets the surface.
fn by_incidence(pieces: &[Done]) -> String {
    let lines = pieces.iter().filter_map(|done| {
        Some(Line {
            name: done.piece.title.to_owned(),
            points: means(&done.measured.as_ref()?.by_incidence),
        })
    });
    let across = Axis {
        name: "angle of incidence in degrees",
        end: 90.0,
        step: 10.0,
        label: |degrees| degrees.to_string(),
    };
    let up = Axis {
        name: "error of the direction in degrees",
        end: 24.0,
        step: 4.0,
        label: |degrees| degrees.to_string(),
    };
    plot(&across, &up, &lines.collect::<Vec<_>>())
}

/// Means of what lies in each unit of the horizontal axis.
fn means(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let last = points.iter().fold(0.0f64, |last, point| last.max(point[0]));
    let mut bins = vec![(0.0, 0u32); last as usize + 1];
    for [across, up] in points {
        if let Some((sum, count)) = bins.get_mut(*across as usize) {
            *sum += up;
            *count += 1;
        }
    }
    let filled = bins
        .into_iter()
        .enumerate()
        .filter(|(_, (_, count))| *count > 0);
    filled
        .map(|(at, (sum, count))| [at as f64 + 0.5, sum / f64::from(count)])
        .collect()
}

/// A PNG that is as small as can be.
fn save(picture: &RgbaImage, path: &Path) -> Result<(), Box<dyn Error>> {
    let rgb = DynamicImage::ImageRgba8(picture.clone()).into_rgb8();
    let mut file = BufWriter::new(File::create(path)?);
    let encoder =
        PngEncoder::new_with_quality(&mut file, CompressionType::Best, FilterType::Adaptive);
    rgb.write_with_encoder(encoder)?;
    Ok(file.flush()?)
}

fn same_truth(one: &Done, next: &Done) -> bool {
    match (&one.measured, &next.measured) {
        (Some(one), Some(next)) => one.traced == next.traced,
        _ => false,
    }
}

fn table(pieces: &[Done], links: bool) -> String {
    let mut text = String::from(
        "| technique | scene | `vs` slots | `ps` slots, texture + arithmetic | mean angle | worst angle | picture |\n\
         | --- | --- | --- | --- | --- | --- | --- |\n",
    );
    for done in pieces {
        let Piece {
            folder,
            scene,
            title,
            ..
        } = done.piece;
        let scene = match links {
            true => format!("[`{folder}/{scene}`]({folder}/README.md)"),
            false => format!("[`{scene}.toml`]({scene}.toml)"),
        };
        let none = || ["–"; 3].map(str::to_owned);
        let [mean, worst, difference] = cells(done).unwrap_or_else(none);
        let (vertex, phases) = &done.slots;
        let phases: Vec<_> = (phases.iter())
            .map(|[texture, arithmetic]| format!("{texture} + {arithmetic}"))
            .collect();
        let (version, phases) = (&done.version, phases.join(", "));
        // Nothing can go wrong when a string is written to.
        let _ = writeln!(
            text,
            "| {title} | {scene} | {vertex} | {version}: {phases} | {mean} | {worst} | {difference} |"
        );
    }
    text
}
