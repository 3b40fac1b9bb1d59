//! `[textures.NAME]`.

use toml::Spanned;
use toml::de::{DeArray, DeValue};

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
    let paths = s.array::<Spanned<String>, 6>("faces", problems)?;
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
    let size = size(s, kind, problems);
    if let Some(node) = s.node("texels") {
        let levels = levels(node, s.node("mips"), problems, texels)?;
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
    let words = |node: Node<'_>, problems: &mut Problems| node.read(problems).map(|at| at.value);
    let levels: Vec<Vec<u32>> = levels(s.node("raw")?, s.node("mips"), problems, words)?;
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

/// Width, height and depth. One number is the edge of a cube.
fn size(s: &mut Section<'_>, kind: TextureKind, problems: &mut Problems) -> Option<[u32; 3]> {
    let is_cube = kind == TextureKind::Cube;
    if let Some(DeValue::Integer(_)) = s.peek("size")
        && is_cube
    {
        return s.get("size", problems).map(|edge| [edge, edge, 1]);
    }
    let At { value, span } = s.at::<Vec<u32>>("size", problems)?;
    match *value.as_slice() {
        [edge] if is_cube => Some([edge, edge, 1]),
        [width, height] => Some([width, height, 1]),
        [width, height, depth] => Some([width, height, depth]),
        _ => {
            let count = value.len();
            let message = format!(
                "`size` has {count} numbers; it is width and height, and depth for a volume"
            );
            problems.error(&rules::VALUE, span, message);
            None
        }
    }
}

/// The largest level and those of `mips`, each read by `level`.
fn levels<T>(
    first: Node<'_>,
    mips: Option<Node<'_>>,
    problems: &mut Problems,
    level: impl Fn(Node<'_>, &mut Problems) -> Option<Vec<T>>,
) -> Option<Vec<Vec<T>>> {
    let rest = mips.map(|node| node.into_list("a list of levels", problems));
    let nodes: Vec<Node<'_>> = std::iter::once(first)
        .chain(rest.into_iter().flatten())
        .collect();
    nodes
        .into_iter()
        .map(|node| level(node, problems))
        .collect()
}

/// The texels of a level. A number is a texel of one component, and lists of rows, slices or faces are the texels of
/// all of them.
fn texels(mut node: Node<'_>, problems: &mut Problems) -> Option<Vec<Vec<f32>>> {
    fn first<'a, 'i>(list: &'a DeArray<'i>) -> Option<&'a DeValue<'i>> {
        list.first().map(Spanned::get_ref)
    }
    while let DeValue::Array(list) = node.value.get_mut()
        && let Some(DeValue::Array(row)) = first(list)
        && let Some(DeValue::Array(_)) = first(row)
    {
        for row in std::mem::replace(list, DeArray::new()) {
            let span = row.span();
            match row.into_inner() {
                DeValue::Array(texels) => texels.into_iter().for_each(|texel| list.push(texel)),
                // Told when the list is read.
                other => list.push(Spanned::new(span, other)),
            }
        }
    }
    let numbers = match node.value.get_ref() {
        DeValue::Array(list) => {
            matches!(first(list), Some(DeValue::Integer(_) | DeValue::Float(_)))
        }
        _ => false,
    };
    if numbers {
        let numbers = node.read::<Vec<f32>>(problems)?.value;
        return Some(numbers.into_iter().map(|number| vec![number]).collect());
    }
    node.read(problems).map(|at| at.value)
}

/// A texel of one to four components; what is left out is 0, the fourth 1.
fn texel(components: Vec<f32>) -> [f32; 4] {
    let mut texel = [0.0, 0.0, 0.0, 1.0];
    for (place, component) in texel.iter_mut().zip(components) {
        *place = component;
    }
    texel
}
