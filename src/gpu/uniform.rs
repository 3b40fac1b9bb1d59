//! What goes into the uniform blocks of a translation.

use crate::exec::STAGES;
use crate::raster::RenderState;
use crate::semantics::BumpState;
use crate::texture::{Sampler, Texture};
use crate::wgsl::{Field, Resource, UniformField};

/// Where the values of a uniform block come from: the registers and states of Direct3D 8.
#[derive(Clone, Debug)]
pub struct Uniforms<'a> {
    /// The constant registers as [`crate::exec::bind_constants`] gives them; numbers beyond the end are 0.
    pub constants: &'a [[f32; 4]],
    /// The render states.
    pub state: &'a RenderState,
    /// Width and height of the viewport in pixels.
    pub viewport: [f32; 2],
    /// The texture stages.
    pub stages: [StageUniforms; STAGES],
}

/// What of a texture stage stands in a uniform block.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StageUniforms {
    /// The bump mapping states.
    pub bump: BumpState,
    /// `D3DTSS_BORDERCOLOR`, with what the texture's format fills in ([`crate::texture::Format::with_fill`]).
    pub border: [f32; 4],
    /// `D3DTSS_MIPMAPLODBIAS`.
    pub lod_bias: f32,
    /// The numbers of the largest and of the smallest level that may be read.
    pub levels: [f32; 2],
}

impl StageUniforms {
    /// Those of a stage with this texture, sampled like this.
    pub fn new(texture: Option<&Texture>, sampler: &Sampler, bump: BumpState) -> Self {
        let border = sampler.border;
        let last = texture.map_or(0, |texture| texture.level_count() - 1);
        Self {
            levels: [sampler.max_mip_level.min(last), last].map(|level| level as f32),
            bump,
            border: texture.map_or(border, |texture| texture.format().with_fill(border)),
            lod_bias: sampler.lod_bias,
        }
    }
}

impl Uniforms<'_> {
    /// The bytes of a uniform block: [`Resource::Uniform`] says which fields it has. Empty for other resources.
    pub fn block(&self, resource: &Resource) -> Vec<u8> {
        let Resource::Uniform { fields, size, .. } = resource else {
            return Vec::new();
        };
        let mut bytes = vec![0; *size as usize];
        for field in fields {
            let start = field.offset as usize;
            let place = bytes.get_mut(start..start + field.size as usize);
            let values = self.values(field);
            for (four, value) in place.unwrap_or_default().chunks_exact_mut(4).zip(values) {
                four.copy_from_slice(&value.to_le_bytes());
            }
        }
        bytes
    }

    fn values(&self, field: &UniformField) -> Vec<f32> {
        let fog = &self.state.fog;
        let point = &self.state.point;
        let stage = |stage: u8| {
            self.stages
                .get(usize::from(stage))
                .copied()
                .unwrap_or_default()
        };
        match field.field {
            Field::Constants => {
                let count = field.size as usize / 16;
                self.constants
                    .iter()
                    .take(count)
                    .flatten()
                    .copied()
                    .collect()
            }
            Field::Viewport => self.viewport.to_vec(),
            Field::PointSize => vec![point.size],
            Field::PointMin => vec![point.min],
            Field::PointMax => vec![point.max],
            Field::ClipPlanes => (self.state.clip_planes.iter().flatten())
                .flat_map(|plane| plane.to_array())
                .collect(),
            Field::Bump(number) => stage(number).bump.matrix.to_vec(),
            Field::Luminance(number) => {
                let bump = stage(number).bump;
                vec![bump.luminance_scale, bump.luminance_offset]
            }
            Field::Border(number) => stage(number).border.to_vec(),
            Field::LodBias(number) => vec![stage(number).lod_bias],
            Field::Levels(number) => stage(number).levels.to_vec(),
            Field::AlphaReference => vec![f32::from(self.state.alpha_test.reference)],
            Field::DepthMapping => self.state.depth_mapping().to_vec(),
            Field::FogColor => fog.color.map(|channel| channel.clamp(0.0, 1.0)).to_vec(),
            Field::FogDensity => vec![fog.density],
            Field::FogStart => vec![fog.start],
            Field::FogEnd => vec![fog.end],
        }
    }
}
