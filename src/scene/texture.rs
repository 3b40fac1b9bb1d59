//! `[textures.NAME]`.

use super::error::{Problems, rules};
use super::files::{Files, extension};
use super::generate::Request;
use super::section::{At, Node, Section};
use super::target::MAX_TARGET_SIDE;
use crate::diagnostic::Span;
use crate::texture::load::{
    cube_from_cross, cube_from_equirectangular, cube_from_faces, decode_dds_signed, decode_image,
};
use crate::texture::{
    Format, MAX_IRRADIANCE_EDGE, Signed, Texture, TextureError, TextureKind, words_to_bytes,
};

/// The keys of which a texture has one: what it is made from.
const SOURCES: [&str; 9] = [
    "file",
    "generate",
    "faces",
    "cross",
    "equirectangular",
    "irradiance",
    "target",
    "texels",
    "raw",
];

/// What a texture of the file is.
#[derive(Clone, Debug)]
pub(crate) enum Source {
    /// Texels.
    Loaded(Texture),
    /// What a render target of this name holds.
    Target(At<String>),
    /// The diffuse cube map of the cube texture of this name.
    Irradiance {
        /// The texture.
        of: At<String>,
        /// The edge of its faces in texels.
        edge: u32,
    },
}

/// Reads a texture.
pub(crate) fn read(
    mut section: Section<'_>,
    files: &mut Files<'_>,
    problems: &mut Problems,
) -> Option<Source> {
    let span = section.span;
    let given: Vec<&str> = SOURCES.into_iter().filter(|key| section.has(key)).collect();
    let s = &mut section;
    let texture = match given.as_slice() {
        ["target"] => {
            let target = s.at::<String>("target", problems);
            section.finish(problems);
            return target.map(Source::Target);
        }
        ["irradiance"] => {
            let of = s.at::<String>("irradiance", problems);
            let edge = s.ranged("edge", 1..=MAX_IRRADIANCE_EDGE, 16, problems);
            section.finish(problems);
            return of.map(|of| Source::Irradiance { of, edge });
        }
        ["file"] => s
            .at::<String>("file", problems)
            .and_then(|path| file(&path, files, problems)),
        ["generate"] => generated(s, span, problems),
        ["faces"] => faces(s, files, problems),
        ["cross"] => s.at::<String>("cross", problems).and_then(|path| {
            let cross = file(&path, files, problems)?;
            made(cube_from_cross(cross), path.span, problems)
        }),
        ["equirectangular"] => equirectangular(s, files, problems),
        [_] => inline(s, files.signed(), problems),
        [] => {
            let sources = SOURCES.map(|key| format!("`{key}`")).join(", ");
            section.missing(&format!("one of {sources}"), problems);
            return None;
        }
        [first, second, ..] => {
            let message =
                format!("a texture is made from `{first}` or from `{second}`, not from both");
            problems.error(&rules::TWICE, span, message);
            return None;
        }
    };
    // Direct3D's own loader made all levels of a picture; what is written texel by texel stays as it is written.
    let from_picture = !matches!(given.as_slice(), ["texels" | "raw"]);
    let mipmaps: Option<bool> = section.get("mipmaps", problems);
    section.finish(problems);
    let mut texture = texture?;
    if !files.take_texture(&texture, span, problems) {
        return None;
    }
    if mipmaps.unwrap_or(from_picture && texture.level_count() == 1) {
        made(texture.generate_mips(), span, problems)?;
    }
    Some(Source::Loaded(texture))
}

/// What was made, or a problem.
pub(crate) fn made<T>(
    result: Result<T, TextureError>,
    span: Span,
    problems: &mut Problems,
) -> Option<T> {
    match result {
        Ok(value) => Some(value),
        Err(error) => {
            problems.error(&rules::CONTENT, span, error.to_string());
            None
        }
    }
}

/// A picture or a DDS file.
fn file(path: &At<String>, files: &Files<'_>, problems: &mut Problems) -> Option<Texture> {
    let bytes = files.read(path, problems)?;
    let result = if bytes.starts_with(b"DDS ") {
        decode_dds_signed(&bytes, files.signed())
    } else {
        decode_image(&bytes, extension(&path.value))
    };
    if let Err(error) = &result {
        let name = files.resolver.display_name(&path.value);
        problems.error(&rules::CONTENT, path.span, format!("`{name}`: {error}"));
    }
    result.ok()
}

fn generated(s: &mut Section<'_>, span: Span, problems: &mut Problems) -> Option<Texture> {
    let name = s.at::<String>("generate", problems);
    let request = Request {
        generate: String::new(),
        size: s.array("size", problems).map(|at| at.value),
        seed: s.get("seed", problems),
        cells: s.array("cells", problems).map(|at| at.value),
        colors: s
            .arrays("colors", problems)
            .map(|at| at.value)
            .unwrap_or_default(),
        relief: s.get("relief", problems),
    };
    let name = name?;
    let request = Request {
        generate: name.value,
        ..request
    };
    match request.draw() {
        Ok(picture) => made(
            Texture::from_rgba8(picture.width(), picture.height(), picture.as_raw()),
            span,
            problems,
        ),
        Err(error) => {
            problems.error(&rules::CONTENT, name.span, error.to_string());
            None
        }
    }
}

fn faces(s: &mut Section<'_>, files: &Files<'_>, problems: &mut Problems) -> Option<Texture> {
    let paths = s.array::<toml::Spanned<String>, 6>("faces", problems)?;
    let mut faces = Vec::with_capacity(6);
    for path in paths.value {
        let span = problems.span(path.span());
        let value = path.into_inner();
        faces.extend(file(&At { value, span }, files, problems));
    }
    let faces: [Texture; 6] = faces.try_into().ok()?;
    made(cube_from_faces(faces), paths.span, problems)
}

fn equirectangular(
    s: &mut Section<'_>,
    files: &Files<'_>,
    problems: &mut Problems,
) -> Option<Texture> {
    let path = s.at::<String>("equirectangular", problems);
    let given = s.has("face_size");
    let size = s.ranged("face_size", 1..=MAX_TARGET_SIDE, 1, problems);
    let path = path?;
    let picture = file(&path, files, problems)?;
    // A face spans a quarter of the picture's width.
    let quarter = (picture.size()[0] / 4).clamp(1, MAX_TARGET_SIDE);
    let size = if given { size } else { quarter };
    made(
        cube_from_equirectangular(picture, size),
        path.span,
        problems,
    )
}

/// Texels or words in the scene file.
fn inline(s: &mut Section<'_>, signed: Signed, problems: &mut Problems) -> Option<Texture> {
    let span = s.span;
    let kind = s.named("kind", TextureKind::Texture2D, problems);
    let format = s.named("format", Format::Rgba8, problems);
    if !s.has("size") {
        s.missing("a `size`", problems);
    }
    let size = match s.at::<Vec<u32>>("size", problems) {
        Some(At { value, .. }) if value.len() == 2 => Some([value[0], value[1], 1]),
        Some(At { value, .. }) if value.len() == 3 => Some([value[0], value[1], value[2]]),
        Some(At { value, span }) => {
            let message = format!(
                "`size` has {} numbers; it is width and height, and depth for a volume",
                value.len()
            );
            problems.error(&rules::VALUE, span, message);
            None
        }
        None => None,
    };
    if let Some(node) = s.node("texels") {
        let levels = levels::<Vec<f32>>(node, s.node("mips"), problems)?;
        let levels: Vec<Vec<[f32; 4]>> = levels
            .into_iter()
            .map(|level| level.into_iter().map(texel).collect())
            .collect();
        return made(
            Texture::from_texels_signed(kind, format, size?, &levels, signed),
            span,
            problems,
        );
    }
    let levels = levels::<u32>(s.node("raw")?, s.node("mips"), problems)?;
    let bytes: Result<Vec<Vec<u8>>, TextureError> = levels
        .iter()
        .map(|words| words_to_bytes(format, words))
        .collect();
    let bytes = made(bytes, span, problems)?;
    made(
        Texture::from_raw_signed(kind, format, size?, &bytes, signed),
        span,
        problems,
    )
}

/// The largest level and those of `mips`.
fn levels<T: serde::de::DeserializeOwned>(
    first: Node<'_>,
    mips: Option<Node<'_>>,
    problems: &mut Problems,
) -> Option<Vec<Vec<T>>> {
    let first = first.read::<Vec<T>>(problems);
    let rest = match mips {
        Some(node) => node.read::<Vec<Vec<T>>>(problems).map(|at| at.value),
        None => Some(Vec::new()),
    };
    Some(std::iter::once(first?.value).chain(rest?).collect())
}

/// A texel of one to four components; what is left out is 0, the fourth 1.
fn texel(components: Vec<f32>) -> [f32; 4] {
    let mut texel = [0.0, 0.0, 0.0, 1.0];
    for (place, component) in texel.iter_mut().zip(components) {
        *place = component;
    }
    texel
}
