//! Cube textures put together from 2D pictures.

use std::f32::consts::PI;

use crate::texture::cube::face_to_direction;
use crate::texture::storage::{Texels, lay_out};
use crate::texture::{
    AddressMode, Filter, Format, Sampler, Texture, TextureError, TextureKind, sample_at,
};

fn refuse(problem: impl Into<String>) -> TextureError {
    TextureError::Faces(problem.into())
}

/// A cube from six square 2D textures of the same size, format and level count, in the order +X, −X, +Y, −Y, +Z, −Z.
///
/// Each is seen from inside the cube, its top row at the top (+Y and −Y: looking up and down with +Z at the bottom and
/// at the top): Direct3D's face orientation.
///
/// # Errors
/// [`TextureError::Faces`] when they differ or are not 2D; the size limits of textures.
pub fn cube_from_faces(faces: [Texture; 6]) -> Result<Texture, TextureError> {
    let [first, ..] = &faces;
    let (format, size, count) = (first.format(), first.size(), first.level_count());
    for (face, number) in faces.iter().zip(1..) {
        if face.kind() != TextureKind::Texture2D {
            return Err(refuse(format!("picture {number} is a {}", face.kind())));
        }
        if (face.format(), face.size(), face.level_count()) != (format, size, count) {
            let [w, h, _] = face.size();
            let [first_w, first_h, _] = size;
            return Err(refuse(format!(
                "picture {number} is {w}x{h} {} with {} levels, the first {first_w}x{first_h} {format} with {count}",
                face.format(),
                face.level_count(),
            )));
        }
    }
    let levels = lay_out(TextureKind::Cube, format, size, count as usize)?;
    let total = levels.iter().map(|level| level.face_len * 6).sum();
    let mut texels = Texels::with_capacity(format, total);
    for level in 0..levels.len() {
        for face in &faces {
            let part = &face.levels[level];
            let range = part.offset..part.offset + part.face_len;
            match (&mut texels, &face.texels) {
                (Texels::Packed(all), Texels::Packed(own)) => all.extend_from_slice(&own[range]),
                (Texels::Float(all), Texels::Float(own)) => all.extend_from_slice(&own[range]),
                // The same format is always kept the same way.
                _ => return Err(refuse("they are kept in different ways")),
            }
        }
    }
    Ok(Texture {
        kind: TextureKind::Cube,
        format,
        signed: faces[0].signed,
        levels,
        texels,
    })
}

/// Column and row of each face in a cross of four columns and three rows.
const HORIZONTAL: [[u32; 2]; 6] = [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [3, 1]];
/// The same in a cross of three columns and four rows; the last stands on its head.
const VERTICAL: [[u32; 2]; 6] = [[2, 1], [0, 1], [1, 0], [1, 2], [1, 1], [1, 3]];

/// A cube from an unfolded one: a picture whose shape, 4:3 or 3:4, tells how it was unfolded. Only level 0 is used.
///
/// ```text
///      +Y                      +Y
///  −X  +Z  +X  −Z          −X  +Z  +X
///      −Y                      −Y
///                              −Z, rotated by 180°
/// ```
///
/// # Errors
/// [`TextureError::Faces`] for another shape or a texture that is not 2D.
pub fn cube_from_cross(cross: Texture) -> Result<Texture, TextureError> {
    let [width, height, _] = cross.size();
    if cross.kind() != TextureKind::Texture2D {
        return Err(refuse(format!("the cross is a {}", cross.kind())));
    }
    let edge = width.max(height) / 4;
    let (places, upside_down) = if [width, height] == [edge * 4, edge * 3] {
        (HORIZONTAL, false)
    } else if [width, height] == [edge * 3, edge * 4] {
        (VERTICAL, true)
    } else {
        return Err(refuse(format!(
            "a cross has the shape 4:3 or 3:4, not {width}x{height}"
        )));
    };
    let levels = lay_out(TextureKind::Cube, cross.format, [edge, edge, 1], 1)?;
    let mut indices = Vec::with_capacity(edge as usize * edge as usize * 6);
    for (face, [column, row]) in places.into_iter().enumerate() {
        let turned = upside_down && face == 5;
        for y in 0..edge {
            for x in 0..edge {
                let [x, y] = [x, y].map(|i| if turned { edge - 1 - i } else { i });
                indices.push(cross.levels[0].index(
                    0,
                    [(column * edge + x) as usize, (row * edge + y) as usize, 0],
                ));
            }
        }
    }
    let texels = match &cross.texels {
        Texels::Packed(words) => {
            Texels::Packed(indices.iter().map(|&index| words[index]).collect())
        }
        Texels::Float(texels) => {
            Texels::Float(indices.iter().map(|&index| texels[index]).collect())
        }
    };
    Ok(Texture {
        kind: TextureKind::Cube,
        format: cross.format,
        signed: cross.signed,
        levels,
        texels,
    })
}

/// Where a direction lies in an equirectangular picture, u and v from 0 to 1.
fn equirectangular_place([x, y, z]: [f32; 3]) -> [f32; 2] {
    let length = (x * x + y * y + z * z).sqrt();
    [
        0.5 + x.atan2(z) / (2.0 * PI),
        0.5 - (y / length).clamp(-1.0, 1.0).asin() / PI,
    ]
}

/// A cube with faces of `face_size`² texels from one picture of all directions.
///
/// The picture's middle is +Z, a quarter to the right +X, its left and right edges −Z, its top +Y: what an observer in
/// Direct3D's left-handed world sees. Only level 0 is used. Where the picture is finer than the faces, each texel
/// averages up to 8×8 samples. The result is `rgba32f` if the picture was kept in floats, else `rgba8`.
///
/// # Errors
/// [`TextureError::Faces`] for a picture that is not 2D; the size limits of textures.
pub fn cube_from_equirectangular(
    picture: Texture,
    face_size: u32,
) -> Result<Texture, TextureError> {
    if picture.kind() != TextureKind::Texture2D {
        return Err(refuse(format!("the picture is a {}", picture.kind())));
    }
    let format = match picture.texels {
        Texels::Packed(_) => Format::Rgba8,
        Texels::Float(_) => Format::Rgba32F,
    };
    let size = [face_size, face_size, 1];
    let levels = lay_out(TextureKind::Cube, format, size, 1)?;
    let sampler = Sampler {
        address: [AddressMode::Wrap, AddressMode::Clamp, AddressMode::Clamp],
        mag: Filter::Linear,
        ..Sampler::default()
    };
    // In the middle of a face a texel spans 2/face_size radians; a texel of the picture 2π/width.
    let texels_a_texel = picture.size()[0] as f32 / (PI * face_size as f32);
    let steps = texels_a_texel.ceil().clamp(1.0, 8.0) as u32;
    let place = |texel: u32, step: u32| {
        let inner = (step as f32 + 0.5) / steps as f32;
        (texel as f32 + inner) / face_size as f32
    };
    let mut texels = Texels::with_capacity(format, levels[0].face_len * 6);
    for face in 0..6 {
        for y in 0..face_size {
            for x in 0..face_size {
                let mut sum = [0.0f32; 4];
                for step in 0..steps * steps {
                    let uv = [place(x, step % steps), place(y, step / steps)];
                    let [u, v] = equirectangular_place(face_to_direction(face, uv));
                    let value = sample_at(Some(&picture), &sampler, [u, v, 0.0], 0.0);
                    for (sum, value) in sum.iter_mut().zip(value) {
                        *sum += value;
                    }
                }
                texels.push(sum.map(|sum| sum / (steps * steps) as f32));
            }
        }
    }
    Ok(Texture {
        kind: TextureKind::Cube,
        format,
        signed: picture.signed,
        levels,
        texels,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture whose every texel says where it is: red = column, green = row.
    fn map(width: u32, height: u32) -> Texture {
        let bytes: Vec<u8> = (0..height)
            .flat_map(|y| (0..width).flat_map(move |x| [x as u8, y as u8, 0, 255]))
            .collect();
        Texture::from_rgba8(width, height, &bytes).unwrap()
    }

    fn code(texture: &Texture, face: usize, x: u32, y: u32) -> [u32; 2] {
        let [r, g, ..] = texture.texel(face, 0, x, y, 0).unwrap();
        [r, g].map(|value| (value * 255.0).round() as u32)
    }

    #[test]
    fn six_faces_become_one_cube() {
        let face = |grey: u8| {
            let mut face = Texture::from_rgba8(2, 2, &[grey; 16]).unwrap();
            face.generate_mips().unwrap();
            face
        };
        let cube = cube_from_faces([0, 1, 2, 3, 4, 5].map(face)).unwrap();
        for number in 0..6 {
            for level in 0..2 {
                assert_eq!(
                    cube.texel(number, level, 0, 0, 0),
                    Some([number as f32 / 255.0; 4])
                );
            }
        }
        let other = Texture::from_rgba8(1, 1, &[0; 4]).unwrap();
        let message = cube_from_faces([face(0), face(0), other, face(0), face(0), face(0)])
            .unwrap_err()
            .to_string();
        assert!(message.contains("picture 3"), "{message}");
        let wide = [0; 6].map(|_| map(2, 1));
        assert!(matches!(
            cube_from_faces(wide),
            Err(TextureError::Shape { .. })
        ));
    }

    #[test]
    fn crosses_are_told_apart_by_shape() {
        let cube = cube_from_cross(map(8, 6)).unwrap();
        let corners: Vec<_> = (0..6).map(|face| code(&cube, face, 0, 0)).collect();
        assert_eq!(corners, [[4, 2], [0, 2], [2, 0], [2, 4], [2, 2], [6, 2]]);
        assert_eq!(code(&cube, 0, 1, 0), [5, 2]);
        let cube = cube_from_cross(map(6, 8)).unwrap();
        let corners: Vec<_> = (0..6).map(|face| code(&cube, face, 0, 0)).collect();
        // −Z stands on its head: its first texel is the last of columns 2, 3 and rows 6, 7.
        assert_eq!(corners, [[4, 2], [0, 2], [2, 0], [2, 4], [2, 2], [3, 7]]);
        assert_eq!(code(&cube, 5, 1, 1), [2, 6]);
        assert!(cube_from_cross(map(8, 8)).is_err());
        assert!(cube_from_cross(map(1, 1)).is_err());
    }

    #[test]
    fn directions_in_an_equirectangular_picture() {
        let near = |direction, expected: [f32; 2]| {
            let place = equirectangular_place(direction);
            let off = (place[0] - expected[0])
                .abs()
                .max((place[1] - expected[1]).abs());
            assert!(off < 1e-6, "{direction:?}: {place:?}");
        };
        near([0.0, 0.0, 1.0], [0.5, 0.5]);
        near([2.0, 0.0, 0.0], [0.75, 0.5]);
        near([-1.0, 0.0, 0.0], [0.25, 0.5]);
        near([0.0, 3.0, 0.0], [0.5, 0.0]);
        near([0.0, -1.0, 0.0], [0.5, 1.0]);
        near([0.0, 1.0, 1.0], [0.5, 0.25]);
        near([1.0, 0.0, -1.0], [0.875, 0.5]);
        near([0.0, 0.0, -1.0], [1.0, 0.5]);
    }

    #[test]
    fn an_equirectangular_picture_becomes_faces() {
        // Columns: −Z half, −X, +Z (two), +X, −Z half — eight columns of 45°, grey by column; the poles are rows 0 and 3.
        let columns = [0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 0.0];
        let texels: Vec<[f32; 4]> = (0..4)
            .flat_map(|row| {
                columns.map(|column| match row {
                    0 => [10.0; 4],
                    3 => [20.0; 4],
                    _ => [column; 4],
                })
            })
            .collect();
        let picture = Texture::from_texels(
            TextureKind::Texture2D,
            Format::Rgba32F,
            [8, 4, 1],
            &[texels],
        )
        .unwrap();
        // One texel a face looks at the face's middle; averaging 3×3 samples of it stays near that value.
        let cube = cube_from_equirectangular(picture, 9).unwrap();
        let middle = |face| cube.texel(face, 0, 4, 4, 0).unwrap()[0];
        let middles: Vec<f32> = (0..6).map(middle).collect();
        assert_eq!(middles, [3.0, 1.0, 10.0, 20.0, 2.0, 0.0]);
    }
}
