//! A diffuse cube map: what light a surface gets from an environment.

use super::cube::face_to_direction;
use super::storage::Texture;
use super::{Format, TextureError, TextureKind};
use glam::{Vec3, Vec4};

/// The largest edge of an irradiance map. It changes slowly, so that more would only cost time.
pub const MAX_IRRADIANCE_EDGE: u32 = 64;

/// Source faces are averaged down to this edge before they are summed.
const SOURCE_EDGE: u32 = 32;

impl Texture {
    /// The diffuse cube map of this environment cube map: for every direction the mean of the environment over the
    /// half space before it, weighted by the cosine, as a surface with that normal reflects it. An environment of one
    /// colour gives that colour. Edge `edge`, 1 to [`MAX_IRRADIANCE_EDGE`]; the format is `rgba8`.
    ///
    /// # Errors
    /// [`TextureError`] if this is not a cube map or the edge is out of bounds.
    pub fn irradiance(&self, edge: u32) -> Result<Texture, TextureError> {
        if self.kind() != TextureKind::Cube {
            return Err(TextureError::Faces(
                "only of a cube map can a diffuse cube map be made".into(),
            ));
        }
        if edge == 0 || edge > MAX_IRRADIANCE_EDGE {
            return Err(TextureError::Faces(format!(
                "a diffuse cube map has an edge of 1 to {MAX_IRRADIANCE_EDGE}, not {edge}"
            )));
        }
        let sky = self.light()?;
        let mut texels = Vec::with_capacity((6 * edge * edge) as usize);
        for face in 0..6 {
            for (x, y) in (0..edge).flat_map(|y| (0..edge).map(move |x| (x, y))) {
                let normal = through(face, x, y, edge).normalize();
                texels.push(mean(&sky, normal).to_array());
            }
        }
        Texture::from_texels(TextureKind::Cube, Format::Rgba8, [edge, edge, 1], &[texels])
    }

    /// The light of each texel of a coarse level: its direction, its colour, the solid angle that it fills.
    fn light(&self) -> Result<Vec<(Vec3, Vec4, f32)>, TextureError> {
        let coarse_level = |texture: &Texture| {
            (0..texture.level_count())
                .filter_map(|level| Some((level, texture.level_size(level)?[0])))
                .find(|(_, edge)| *edge <= SOURCE_EDGE)
        };
        let mut source = std::borrow::Cow::Borrowed(self);
        let (level, edge) = match coarse_level(self) {
            Some(found) => found,
            None => {
                source.to_mut().generate_mips()?;
                coarse_level(&source).unwrap_or((0, self.size()[0]))
            }
        };
        let mut light = Vec::with_capacity((6 * edge * edge) as usize);
        for face in 0..6 {
            for (x, y) in (0..edge).flat_map(|y| (0..edge).map(move |x| (x, y))) {
                let direction = through(face, x, y, edge);
                let color = source.texel(face, level, x, y, 0).unwrap_or([0.0; 4]);
                // A texel of the face at distance 1 is seen from the centre under cos³ of its angle.
                let angle = direction.length().powi(-3);
                light.push((direction.normalize(), Vec4::from(color), angle));
            }
        }
        Ok(light)
    }
}

/// The direction through the centre of a texel.
fn through(face: usize, x: u32, y: u32, edge: u32) -> Vec3 {
    let at = [x, y].map(|i| (i as f32 + 0.5) / edge as f32);
    Vec3::from(face_to_direction(face, at))
}

/// The mean of the light before a surface.
fn mean(sky: &[(Vec3, Vec4, f32)], normal: Vec3) -> Vec4 {
    let mut sum = Vec4::ZERO;
    let mut weights = 0.0;
    for (direction, color, angle) in sky {
        let weight = direction.dot(normal).max(0.0) * angle;
        sum += *color * weight;
        weights += weight;
    }
    if weights > 0.0 { sum / weights } else { sum }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(edge: u32, color: impl Fn(usize) -> [f32; 4]) -> Texture {
        let texels: Vec<_> = (0..6)
            .flat_map(|face| vec![color(face); (edge * edge) as usize])
            .collect();
        Texture::from_texels(TextureKind::Cube, Format::Rgba8, [edge, edge, 1], &[texels]).unwrap()
    }

    #[test]
    fn one_colour_stays_that_colour() {
        let gray = cube(64, |_| [0.2, 0.4, 0.6, 1.0]);
        let diffuse = gray.irradiance(4).unwrap();
        assert_eq!(diffuse.texel(3, 0, 1, 2, 0), Some([0.2, 0.4, 0.6, 1.0]));
    }

    /// Light from the upper half only: by the cosine law a surface that faces up gets all of it, one that faces down
    /// none, one that faces sideways half.
    #[test]
    fn light_from_above() {
        let edge = 32;
        let above = |face: usize, y: u32| match face {
            2 => 1.0,
            3 => 0.0,
            // On the side faces v grows downwards.
            _ if y < edge / 2 => 1.0,
            _ => 0.0,
        };
        let mut texels = Vec::new();
        for face in 0..6 {
            for y in 0..edge {
                texels.extend(vec![[above(face, y); 4]; edge as usize]);
            }
        }
        let sky =
            Texture::from_texels(TextureKind::Cube, Format::Rgba8, [edge, edge, 1], &[texels])
                .unwrap();
        let diffuse = sky.irradiance(1).unwrap();
        let level = |face| diffuse.texel(face, 0, 0, 0, 0).unwrap()[0];
        assert_eq!(level(2), 1.0);
        assert_eq!(level(3), 0.0);
        for side in [0, 1, 4, 5] {
            assert!((level(side) - 0.5).abs() < 0.01, "{}", level(side));
        }
    }

    #[test]
    fn only_cubes_of_a_sane_size() {
        let flat = Texture::from_rgba8(1, 1, &[0; 4]).unwrap();
        assert!(flat.irradiance(4).is_err());
        assert!(cube(2, |_| [0.0; 4]).irradiance(0).is_err());
        assert!(cube(2, |_| [0.0; 4]).irradiance(1000).is_err());
    }
}
