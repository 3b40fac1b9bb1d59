//! The uniform block of a stage.

use std::collections::BTreeSet;

/// What a field of a uniform block holds. The order is that of the block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Field {
    /// `c`: the constants c0, c1, … as far as the shader reads them, (x, y, z, w) each.
    Constants,
    /// `viewport`: width and height of the viewport in pixels.
    Viewport,
    /// `point_size`: `D3DRS_POINTSIZE`, for shaders that do not write `oPts`.
    PointSize,
    /// `point_min`: `D3DRS_POINTSIZE_MIN`.
    PointMin,
    /// `point_max`: `D3DRS_POINTSIZE_MAX`.
    PointMax,
    /// `clip_planes`: the user clip planes in clip space.
    ClipPlanes,
    /// `bump#`: `D3DTSS_BUMPENVMAT00`, `01`, `10`, `11` of a stage.
    Bump(u8),
    /// `luminance#`: `D3DTSS_BUMPENVLSCALE` and `D3DTSS_BUMPENVLOFFSET` of a stage.
    Luminance(u8),
    /// `border#`: `D3DTSS_BORDERCOLOR` of a stage, red to alpha, with what the format fills in.
    Border(u8),
    /// `lod_bias#`: `D3DTSS_MIPMAPLODBIAS` of a stage.
    LodBias(u8),
    /// `levels#`: the largest level that is read of a stage, `D3DTSS_MAXMIPLEVEL` or the last one, and the last one.
    Levels(u8),
    /// `alpha_reference`: `D3DRS_ALPHAREF` as a number from 0 to 255.
    AlphaReference,
    /// `depth_mapping`: what the depth of the position is multiplied by, and what is added:
    /// [`RenderState::depth_mapping`](crate::raster::RenderState::depth_mapping).
    DepthMapping,
    /// `fog_color`: `D3DRS_FOGCOLOR`, each channel 0 to 1.
    FogColor,
    /// `fog_density`: `D3DRS_FOGDENSITY`.
    FogDensity,
    /// `fog_start`: `D3DRS_FOGSTART`.
    FogStart,
    /// `fog_end`: `D3DRS_FOGEND`.
    FogEnd,
}

/// One field of a uniform block in its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UniformField {
    /// What it holds.
    pub field: Field,
    /// Its name in the WGSL.
    pub name: String,
    /// Its type in the WGSL.
    pub wgsl_type: String,
    /// Bytes from the start of the block.
    pub offset: u32,
    /// Bytes that it takes.
    pub size: u32,
}

impl Field {
    pub(super) fn name(self) -> String {
        match self {
            Self::Constants => "c".into(),
            Self::Viewport => "viewport".into(),
            Self::PointSize => "point_size".into(),
            Self::PointMin => "point_min".into(),
            Self::PointMax => "point_max".into(),
            Self::ClipPlanes => "clip_planes".into(),
            Self::Bump(stage) => format!("bump{stage}"),
            Self::Luminance(stage) => format!("luminance{stage}"),
            Self::Border(stage) => format!("border{stage}"),
            Self::LodBias(stage) => format!("lod_bias{stage}"),
            Self::Levels(stage) => format!("levels{stage}"),
            Self::AlphaReference => "alpha_reference".into(),
            Self::DepthMapping => "depth_mapping".into(),
            Self::FogColor => "fog_color".into(),
            Self::FogDensity => "fog_density".into(),
            Self::FogStart => "fog_start".into(),
            Self::FogEnd => "fog_end".into(),
        }
    }

    /// What stands behind the field as a comment.
    pub(super) fn about(self) -> &'static str {
        match self {
            Self::Constants => "c0, c1, …",
            Self::Viewport => "width and height in pixels",
            Self::PointSize => "D3DRS_POINTSIZE",
            Self::PointMin => "D3DRS_POINTSIZE_MIN",
            Self::PointMax => "D3DRS_POINTSIZE_MAX",
            Self::ClipPlanes => "in clip space",
            Self::Bump(_) => "D3DTSS_BUMPENVMAT00, 01, 10, 11",
            Self::Luminance(_) => "D3DTSS_BUMPENVLSCALE, D3DTSS_BUMPENVLOFFSET",
            Self::Border(_) => "D3DTSS_BORDERCOLOR",
            Self::LodBias(_) => "D3DTSS_MIPMAPLODBIAS",
            Self::Levels(_) => "D3DTSS_MAXMIPLEVEL, number of the last level",
            Self::AlphaReference => "D3DRS_ALPHAREF, 0 to 255",
            Self::DepthMapping => "scale and offset: MinZ, MaxZ, D3DRS_ZBIAS",
            Self::FogColor => "D3DRS_FOGCOLOR",
            Self::FogDensity => "D3DRS_FOGDENSITY",
            Self::FogStart => "D3DRS_FOGSTART",
            Self::FogEnd => "D3DRS_FOGEND",
        }
    }
}

/// The fields that a stage uses.
#[derive(Clone, Debug, Default)]
pub(super) struct Block {
    fields: BTreeSet<Field>,
    /// How many constants there are.
    pub(super) constants: u32,
    /// How many user clip planes there are.
    pub(super) clip_planes: u32,
}

impl Block {
    /// Notes that a field is used.
    pub(super) fn use_field(&mut self, field: Field) {
        self.fields.insert(field);
    }

    /// Type, alignment and size of a field, by the rules of WGSL for uniform buffers.
    fn shape(&self, field: Field) -> (String, u32, u32) {
        let vectors = |count: u32| (format!("array<vec4f, {count}>"), 16, 16 * count);
        match field {
            Field::Constants => vectors(self.constants),
            Field::ClipPlanes => vectors(self.clip_planes),
            Field::Bump(_) | Field::Border(_) => ("vec4f".into(), 16, 16),
            Field::FogColor => ("vec3f".into(), 16, 12),
            Field::Viewport | Field::Luminance(_) | Field::Levels(_) | Field::DepthMapping => {
                ("vec2f".into(), 8, 8)
            }
            Field::PointSize
            | Field::PointMin
            | Field::PointMax
            | Field::LodBias(_)
            | Field::AlphaReference
            | Field::FogDensity
            | Field::FogStart
            | Field::FogEnd => ("f32".into(), 4, 4),
        }
    }

    /// The fields in their places, and the size of the whole in bytes (0: no block).
    pub(super) fn fields(&self) -> (Vec<UniformField>, u32) {
        let (mut end, mut largest) = (0u32, 1);
        let fields = (self.fields.iter())
            .map(|&field| {
                let (wgsl_type, alignment, size) = self.shape(field);
                let offset = end.next_multiple_of(alignment);
                (end, largest) = (offset + size, alignment.max(largest));
                UniformField {
                    field,
                    name: field.name(),
                    wgsl_type,
                    offset,
                    size,
                }
            })
            .collect();
        (fields, end.next_multiple_of(largest))
    }
}
