//! The textures of a case.

use crate::diagnostic::Span;
use crate::scene::error::{Problems, rules};
use crate::scene::files::Files;
use crate::scene::section::{At, Section, parse_name};
use crate::scene::texture::{self, Source};
use crate::texture::{Format, Texture, TextureError, TextureKind};

/// A texture. One from a file may repeat what it is; it must be that. A picture is stored in the format that is asked
/// for, where that can be done.
pub(super) fn bound(
    mut section: Section<'_>,
    files: &mut Files<'_>,
    problems: &mut Problems,
) -> Option<Texture> {
    let span = section.span;
    let said = section.has("file").then(|| {
        let s = &mut section;
        let kind = s.at::<String>("kind", problems);
        let format = s.at::<String>("format", problems);
        (kind, format, s.at::<Vec<u32>>("size", problems))
    });
    let mut texture = match texture::read(section, files, problems)? {
        Source::Loaded(texture) => texture,
        Source::Target(_) | Source::Irradiance { .. } => {
            let message =
                "a case has no render targets: a texture is made from `texels`, `raw` or `file`";
            problems.error(&rules::CONTENT, span, message);
            return None;
        }
    };
    if let Some((kind, format, size)) = said {
        if let Some(At { value, span }) = kind
            && parse_name::<TextureKind>(&value) != Ok(texture.kind())
        {
            differ(span, "kind", texture.kind().to_string(), problems);
        }
        if let Some(At { value, span }) = format {
            match parse_name::<Format>(&value) {
                Ok(format) if format == texture.format() => {}
                Ok(format) if texture.format() == Format::Rgba8 && of_bytes(format) => {
                    texture = texture::made(stored(&texture, format), span, problems)?;
                }
                _ => differ(span, "format", texture.format().to_string(), problems),
            }
        }
        let is = texture.size();
        if let Some(At { value, span }) = size
            && (value.len() > 3 || (0..3).any(|i| value.get(i).copied().unwrap_or(1) != is[i]))
        {
            differ(span, "size", format!("{is:?}"), problems);
        }
    }
    Some(texture)
}

fn differ(span: Span, what: &str, is: String, problems: &mut Problems) {
    let message = format!("the {what} of the file is {is}");
    problems.error(&rules::CONTENT, span, message);
}

/// Whether the channels of a format are bytes of 0 to 1, as those of a picture are.
fn of_bytes(format: Format) -> bool {
    format.is_packed() && !format.is_compressed()
}

/// The same texels in another format.
fn stored(texture: &Texture, format: Format) -> Result<Texture, TextureError> {
    let level = |number: u32| -> Vec<[f32; 4]> {
        let [width, height, depth] = texture.level_size(number).unwrap_or_default();
        let faces = 0..texture.face_count();
        faces
            .flat_map(|face| (0..depth).map(move |z| (face, z)))
            .flat_map(|(face, z)| (0..height).map(move |y| (face, z, y)))
            .flat_map(|(face, z, y)| (0..width).map(move |x| (face, z, y, x)))
            .filter_map(|(face, z, y, x)| texture.texel(face, number, x, y, z))
            .collect()
    };
    let levels: Vec<_> = (0..texture.level_count()).map(level).collect();
    Texture::from_texels(texture.kind(), format, texture.size(), &levels)
}
