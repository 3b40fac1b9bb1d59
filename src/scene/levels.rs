//! What a picture may be when levels of detail are a little off.

use image::RgbaImage;

use super::prepare::{Output, Pass};
use super::render::{RenderError, Rendering};
use crate::exec::STAGES;
use crate::texture::MipFilter;

/// The least and the greatest value that each channel of each pixel has in pictures that differ only in which mip levels
/// are read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LevelRange {
    least: RgbaImage,
    greatest: RgbaImage,
}

impl LevelRange {
    /// Takes one more picture in. One of another size is taken in as far as both reach.
    fn widen(&mut self, picture: &RgbaImage) {
        for (kept, choice) in [
            (&mut self.least, u8::min as fn(u8, u8) -> u8),
            (&mut self.greatest, u8::max),
        ] {
            for (kept, other) in kept.iter_mut().zip(picture.iter()) {
                *kept = choice(*kept, *other);
            }
        }
    }

    /// The picture within the range that is nearest to another one, channel by channel. Where the two are equal, levels
    /// alone can make the other one what it is.
    pub fn nearest(&self, picture: &RgbaImage) -> RgbaImage {
        let mut nearest = picture.clone();
        let range = self.least.iter().zip(self.greatest.iter());
        for (value, (least, greatest)) in nearest.iter_mut().zip(range) {
            // The least value is never above the greatest.
            *value = (*value).max(*least).min(*greatest);
        }
        nearest
    }
}

impl Rendering<'_> {
    /// Draws the picture or a face of a render target again, with the levels of detail of each stage moved by each of
    /// `errors`, in levels, in all combinations over the stages that read mip levels. What is read from render targets is
    /// what they hold.
    ///
    /// A linear mip filter mixes two levels in proportion to what the level of detail is above the smaller one. So what a
    /// sample gives for all levels of detail in between lies between what it gives for the ends, but for whole levels
    /// within, of which this rendering has one. Where a texture is read by what another one held, this holds nearly.
    ///
    /// `None` if no stage reads mip levels, or nothing was drawn there. The work is that of `errors.len()` to the power of
    /// the number of stages pictures: at most 8 of them in a scene, up to 6 in a shader.
    ///
    /// # Errors
    /// As [`Scene::render`](super::Scene::render).
    pub fn level_range(
        &self,
        output: Output,
        errors: &[f32],
    ) -> Result<Option<LevelRange>, RenderError> {
        let (Some(pass), Some(drawn)) = (self.pass(output), self.drawn(output)) else {
            return Ok(None);
        };
        let stages: Vec<usize> = (0..STAGES)
            .filter(|stage| self.reads_levels(pass, *stage))
            .collect();
        if stages.is_empty() || errors.is_empty() {
            return Ok(None);
        }
        let picture = drawn.to_image();
        let mut range = LevelRange {
            least: picture.clone(),
            greatest: picture,
        };
        let mut biases = [0.0; STAGES];
        self.combine(output, &stages, errors, &mut biases, &mut range)?;
        Ok(Some(range))
    }

    /// Takes into the range what is drawn with each combination of errors in these stages, beside the biases given.
    fn combine(
        &self,
        output: Output,
        stages: &[usize],
        errors: &[f32],
        biases: &mut [f32; STAGES],
        range: &mut LevelRange,
    ) -> Result<(), RenderError> {
        let Some((stage, others)) = stages.split_first() else {
            let drawn = self.redrawn(output, &|stage, sampler| {
                sampler.lod_bias += biases[stage];
            })?;
            if let Some(drawn) = drawn {
                range.widen(&drawn.to_image());
            }
            return Ok(());
        };
        for error in errors {
            biases[*stage] = *error;
            self.combine(output, others, errors, biases, range)?;
        }
        Ok(())
    }

    /// Whether a draw has a texture of more than one level in a stage, and a filter that reads them.
    fn reads_levels(&self, pass: &Pass<'_>, stage: usize) -> bool {
        pass.draws.iter().any(|draw| {
            let stage = &draw.stages[stage];
            let texture = stage.texture.and_then(|number| self.texture(number));
            stage.sampler.mip != MipFilter::None
                && texture.is_some_and(|texture| texture.level_count() > 1)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{LoadOptions, RenderOptions, Scene};
    use std::collections::BTreeMap;

    /// Eight by eight pixels show `size` texels of 0 with further levels of 0.4 and 0.8. With 12 texels on 8 pixels the
    /// level of detail is log2 1.5 = 0.585: between 0 and 0.4 that is 0.234, 59.67 of 255.
    fn scene(mip: &str) -> Scene {
        let level =
            |texels: usize, value: f32| vec![format!("[{value}, 0, 0, 1]"); texels].join(", ");
        let text = format!(
            "size = [8, 8]\n[meshes.all]\n\
             positions = [[-1, 1, 0], [1, 1, 0], [1, -1, 0], [-1, -1, 0]]\n\
             texcoords = [[0, 0], [1, 0], [1, 1], [0, 1]]\nindices = [0, 1, 2, 0, 2, 3]\n\
             [textures.levels]\nkind = \"2d\"\nformat = \"rgba32f\"\nsize = [12, 12]\n\
             texels = [{}]\nmips = [[{}], [{}], [{}]]\n\
             [[draw]]\nname = \"all\"\nmesh = \"all\"\n\
             vs_text = \"vs.1.1\\nmov oPos, v0\\nmov oT0.xy, v7\\n\"\n\
             ps_text = \"ps.1.1\\ntex t0\\nmov r0, t0\\n\"\n\
             [draw.stages]\n0 = {{ texture = \"levels\", filter = \"linear\", mip = \"{mip}\" }}\n",
            level(144, 0.0),
            level(36, 0.4),
            level(9, 0.8),
            level(1, 0.8),
        );
        let files = BTreeMap::new();
        match Scene::load(
            "scene.toml",
            text.as_bytes(),
            &files,
            &LoadOptions::default(),
        ) {
            Ok(scene) => scene,
            Err(error) => panic!("{error}"),
        }
    }

    fn range(mip: &str, errors: &[f32]) -> Option<LevelRange> {
        let scene = scene(mip);
        let rendering = scene.rendering(&RenderOptions::default(), &|_| ()).unwrap();
        rendering.level_range(Output::Picture, errors).unwrap()
    }

    fn red(picture: &RgbaImage) -> u8 {
        picture.get_pixel(4, 4).0[0]
    }

    /// 0.585 − 1/16 = 0.5225 and 0.585 + 1/16 = 0.6475, times 0.4 · 255 = 102: 53.3 and 66.04.
    #[test]
    fn a_sixteenth_of_a_level_either_way() {
        let range = range("linear", &[-0.0625, 0.0625]).unwrap();
        assert_eq!((red(&range.least), red(&range.greatest)), (53, 66));
        let of = |value: u8| RgbaImage::from_pixel(8, 8, image::Rgba([value, 0, 0, 255]));
        let nearest = |value: u8| red(&range.nearest(&of(value)));
        assert_eq!([40, 53, 60, 66, 80].map(nearest), [53, 53, 60, 66, 66]);
    }

    /// What was drawn is in the range, whatever the errors are: 59.67 is its least value with an error of 1/16, and with one
    /// of −1/16 its greatest.
    #[test]
    fn the_picture_itself_is_in_the_range() {
        let above = range("linear", &[0.0625]).unwrap();
        assert_eq!((red(&above.least), red(&above.greatest)), (60, 66));
        let below = range("linear", &[-0.0625]).unwrap();
        assert_eq!((red(&below.least), red(&below.greatest)), (53, 60));
    }

    /// The nearest level to 0.585 is 1, and to 0.485 it is 0.
    #[test]
    fn a_point_filter_changes_the_level() {
        let near = range("point", &[-0.0625]).unwrap();
        assert_eq!((red(&near.least), red(&near.greatest)), (102, 102));
        let far = range("point", &[-0.1]).unwrap();
        assert_eq!((red(&far.least), red(&far.greatest)), (0, 102));
    }

    #[test]
    fn without_mip_levels_there_is_no_range() {
        assert_eq!(range("none", &[0.0625]), None);
    }
}
