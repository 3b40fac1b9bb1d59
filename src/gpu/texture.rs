//! Textures and samplers on the device.

use super::{Device, GpuError};
use crate::texture::{AddressMode, Filter, Format, MipFilter, Sampler, Texture, TextureKind};
use crate::wgsl::{Dimension, Resource, StageOptions};
use std::collections::HashMap;

/// A texture on the device.
#[derive(Debug)]
pub(super) struct GpuTexture {
    texture: wgpu::Texture,
    levels: u32,
}

/// The name of a texture's kind at the start of a sentence.
fn kind_name(kind: TextureKind) -> &'static str {
    match kind {
        TextureKind::Texture2D => "a texture",
        TextureKind::Cube => "a cube map",
        TextureKind::Volume => "a volume",
    }
}

impl GpuTexture {
    /// Uploads all levels.
    ///
    /// # Errors
    /// [`GpuError::Limit`] for a texture that the device cannot hold.
    pub(super) fn upload(device: &Device, texture: &Texture) -> Result<Self, GpuError> {
        let [width, height, depth] = texture.size();
        let limits = device.device.limits();
        let most = match texture.kind() {
            TextureKind::Volume => limits.max_texture_dimension_3d,
            TextureKind::Texture2D | TextureKind::Cube => limits.max_texture_dimension_2d,
        };
        if width.max(height).max(depth) > most {
            return Err(GpuError::Limit {
                what: format!("{} of {width}×{height}×{depth}", kind_name(texture.kind())),
                limit: format!("at most {most} on a side"),
            });
        }
        let packed = texture.format().is_packed();
        let full = device.has(wgpu::Features::FLOAT32_FILTERABLE);
        let (format, texel_bytes) = match (packed, full) {
            (true, _) => (wgpu::TextureFormat::Rgba8Unorm, 4),
            (false, true) => (wgpu::TextureFormat::Rgba32Float, 16),
            (false, false) => (wgpu::TextureFormat::Rgba16Float, 8),
        };
        let layers = texture.face_count() as u32;
        let uploaded = device.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width,
                height,
                depth_or_array_layers: depth * layers,
            },
            mip_level_count: texture.level_count(),
            sample_count: 1,
            dimension: match texture.kind() {
                TextureKind::Volume => wgpu::TextureDimension::D3,
                TextureKind::Texture2D | TextureKind::Cube => wgpu::TextureDimension::D2,
            },
            format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for level in 0..texture.level_count() {
            let (Some([width, height, depth]), Some(mut bytes)) =
                (texture.level_size(level), texture.level_bytes(level))
            else {
                continue;
            };
            if !packed && !full {
                bytes = halves(&bytes);
            }
            device.queue.write_texture(
                wgpu::TexelCopyTextureInfo {
                    texture: &uploaded,
                    mip_level: level,
                    origin: wgpu::Origin3d::ZERO,
                    aspect: wgpu::TextureAspect::All,
                },
                &bytes,
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(width * texel_bytes),
                    rows_per_image: Some(height),
                },
                wgpu::Extent3d {
                    width,
                    height,
                    depth_or_array_layers: depth * layers,
                },
            );
        }
        device.check()?;
        Ok(Self {
            texture: uploaded,
            levels: texture.level_count(),
        })
    }

    /// A view as a shader wants it. Without mip filter only level 0 is seen.
    pub(super) fn view(&self, dimension: Dimension, sampler: &Sampler) -> wgpu::TextureView {
        self.texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(view_dimension(dimension)),
            mip_level_count: (sampler.mip == MipFilter::None).then_some(1),
            ..Default::default()
        })
    }

    /// The sampler for this texture.
    pub(super) fn sampler_state(&self, sampler: &Sampler, clamps: [bool; 3]) -> SamplerState {
        let axis = |i: usize| match sampler.address[i] {
            _ if clamps[i] => wgpu::AddressMode::ClampToEdge,
            AddressMode::Wrap => wgpu::AddressMode::Repeat,
            AddressMode::Mirror => wgpu::AddressMode::MirrorRepeat,
            // The last two are the shader's business, which then has no sampler.
            AddressMode::Clamp | AddressMode::Border | AddressMode::MirrorOnce => {
                wgpu::AddressMode::ClampToEdge
            }
        };
        let filter = |filter: Filter| match filter.is_linear() {
            false => wgpu::FilterMode::Nearest,
            true => wgpu::FilterMode::Linear,
        };
        let last = self.levels - 1;
        let (mipmap, least, most) = match sampler.mip {
            // A level of detail of at most a quarter is level 0, and still tells magnified from minified.
            MipFilter::None => (wgpu::MipmapFilterMode::Nearest, 0, 25),
            MipFilter::Point | MipFilter::Linear => (
                match sampler.mip {
                    MipFilter::Linear => wgpu::MipmapFilterMode::Linear,
                    _ => wgpu::MipmapFilterMode::Nearest,
                },
                100 * sampler.max_mip_level.min(last),
                100 * last.max(1),
            ),
        };
        SamplerState {
            address: [axis(0), axis(1), axis(2)],
            mag: filter(sampler.mag),
            min: filter(sampler.min),
            mipmap,
            lod_hundredths: [least, most],
        }
    }
}

/// A sampler as a key: equal ones are the same object on the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct SamplerState {
    address: [wgpu::AddressMode; 3],
    mag: wgpu::FilterMode,
    min: wgpu::FilterMode,
    mipmap: wgpu::MipmapFilterMode,
    /// The least and the greatest level of detail, times 100.
    lod_hundredths: [u32; 2],
}

impl SamplerState {
    pub(super) fn create(&self, device: &Device) -> wgpu::Sampler {
        let [least, most] = self.lod_hundredths.map(|level| level as f32 / 100.0);
        device.device.create_sampler(&wgpu::SamplerDescriptor {
            address_mode_u: self.address[0],
            address_mode_v: self.address[1],
            address_mode_w: self.address[2],
            mag_filter: self.mag,
            min_filter: self.min,
            mipmap_filter: self.mipmap,
            lod_min_clamp: least,
            lod_max_clamp: most,
            ..Default::default()
        })
    }
}

/// The samplers that were made so far.
#[derive(Debug, Default)]
pub(super) struct Samplers(HashMap<SamplerState, wgpu::Sampler>);

/// What is bound in group 1.
pub(super) enum Bound {
    View(wgpu::TextureView),
    Sampler(wgpu::Sampler),
}

impl Bound {
    /// The entry of the group.
    pub(super) fn entry(&self, binding: u32) -> wgpu::BindGroupEntry<'_> {
        wgpu::BindGroupEntry {
            binding,
            resource: match self {
                Self::View(view) => wgpu::BindingResource::TextureView(view),
                Self::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
            },
        }
    }
}

impl Samplers {
    /// What a binding of a stage with this texture wants; none if it is no texture and no sampler.
    pub(super) fn bound(
        &mut self,
        device: &Device,
        resource: &Resource,
        texture: &GpuTexture,
        sampler: &Sampler,
    ) -> Option<Bound> {
        match resource {
            Resource::Texture { dimension, .. } => {
                Some(Bound::View(texture.view(*dimension, sampler)))
            }
            Resource::Sampler { clamps, .. } => {
                let state = texture.sampler_state(sampler, *clamps);
                let known = self.0.entry(state).or_insert_with(|| state.create(device));
                Some(Bound::Sampler(known.clone()))
            }
            Resource::Uniform { .. } => None,
        }
    }
}

/// What a translation must know of a stage with this texture, sampled like this.
pub fn stage_options(texture: Option<&Texture>, sampler: &Sampler) -> StageOptions {
    StageOptions {
        texture: texture.map(Texture::kind),
        seamless: sampler.seamless,
        address: sampler.address,
        mag: sampler.mag,
        min: sampler.min,
        mip: sampler.mip,
        max_mip_level: sampler.max_mip_level,
        max_anisotropy: sampler.max_anisotropy,
        lod_bias: sampler.lod_bias != 0.0,
        weights: sampler.weights,
        byte_texels: texture.is_some_and(|texture| texture.format().is_packed()),
        wide_texels: texture.is_some_and(|texture| texture.format() == Format::Rgba32F),
    }
}

/// The dimension of a view.
pub(super) fn view_dimension(dimension: Dimension) -> wgpu::TextureViewDimension {
    match dimension {
        Dimension::D2 => wgpu::TextureViewDimension::D2,
        Dimension::D2Array => wgpu::TextureViewDimension::D2Array,
        Dimension::Cube => wgpu::TextureViewDimension::Cube,
        Dimension::D3 => wgpu::TextureViewDimension::D3,
    }
}

/// 32-bit floats as 16-bit ones, both as little-endian bytes.
fn halves(bytes: &[u8]) -> Vec<u8> {
    bytes
        .chunks_exact(4)
        .flat_map(|b| half(f32::from_le_bytes([b[0], b[1], b[2], b[3]])).to_le_bytes())
        .collect()
}

/// The 16-bit float nearest to a number, ties to even; what is too large is infinite.
fn half(value: f32) -> u16 {
    let bits = value.to_bits();
    let sign = (bits >> 16) as u16 & 0x8000;
    let magnitude = bits & 0x7fff_ffff;
    if magnitude > 0x7f80_0000 {
        return sign | 0x7e00;
    }
    // 65520 and more round to infinity.
    if magnitude >= 0x477f_f000 {
        return sign | 0x7c00;
    }
    // Below 2⁻¹⁴ steps are 2⁻²⁴: a sum with 0.5 puts them into the lowest bits of the fraction, rounded.
    if magnitude < 0x3880_0000 {
        let sum = f32::from_bits(magnitude) + 0.5;
        return sign | (sum.to_bits() - 0x3f00_0000) as u16;
    }
    let rounded = magnitude + 0xfff + (magnitude >> 13 & 1);
    sign | ((rounded - 0x3800_0000) >> 13) as u16
}

#[cfg(test)]
mod tests {
    use super::half;

    #[test]
    fn halves_are_the_nearest() {
        // IEEE 754 binary16: 1 sign, 5 exponent bits with bias 15, 10 fraction bits.
        for (value, bits) in [
            (0.0, 0x0000),
            (-0.0, 0x8000),
            (1.0, 0x3c00),
            (-2.0, 0xc000),
            (65504.0, 0x7bff),
            (65520.0, 0x7c00),
            (f32::INFINITY, 0x7c00),
            (6.103_515_6e-5, 0x0400), // 2⁻¹⁴
            (5.960_464_5e-8, 0x0001), // 2⁻²⁴
            (2.980_232_2e-8, 0x0000), // 2⁻²⁵: halfway to 0, which is even
            (1.000_488_3, 0x3c00),    // 1 + 2⁻¹¹: halfway, down to even
            (1.001_464_8, 0x3c02),    // 1 + 3·2⁻¹¹: halfway, up to even
        ] {
            assert_eq!(half(value), bits, "{value}");
        }
        assert_eq!(half(f32::NAN) & 0x7c00, 0x7c00);
        assert_ne!(half(f32::NAN) & 0x03ff, 0);
    }
}
