//! Colour and depth buffers on the device, and how their content comes back.

use std::sync::mpsc;

use super::{Device, GpuError};

/// The format of what is drawn into by a scene.
pub(super) const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// What a pass draws into. Neither side is 0.
pub(super) struct Picture {
    color: wgpu::Texture,
    depth: wgpu::Texture,
    after: Depth,
    /// What depth and stencil are cleared to.
    cleared: (f32, u8),
}

/// What becomes of the depth behind a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Depth {
    /// Nobody needs it.
    Dropped,
    /// A pass that goes on with the picture needs it, and the stencil.
    Kept,
    /// It is read with the colours, and is 32-bit floats.
    Read,
}

/// A depth format: with as many bits as a float has where the device can join that with stencil, or where there is no need
/// of stencil.
pub(super) fn depth_format(device: &Device, stencil: bool) -> wgpu::TextureFormat {
    match stencil {
        false => wgpu::TextureFormat::Depth32Float,
        true if device.has(wgpu::Features::DEPTH32FLOAT_STENCIL8) => {
            wgpu::TextureFormat::Depth32FloatStencil8
        }
        true => wgpu::TextureFormat::Depth24PlusStencil8,
    }
}

impl Picture {
    /// Both buffers of one size. The caller has checked it.
    pub(super) fn new(
        device: &Device,
        [width, height]: [u32; 2],
        format: wgpu::TextureFormat,
        depth: wgpu::TextureFormat,
        after: Depth,
    ) -> Self {
        let size = wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        };
        let mut usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        usage.set(wgpu::TextureUsages::COPY_SRC, after == Depth::Read);
        Self {
            color: color_buffer(device, size, format),
            depth: buffer(device, size, depth, usage),
            after,
            cleared: (1.0, 0),
        }
    }

    /// The same, with other values than 1 and 0 that depth and stencil are cleared to.
    pub(super) fn clearing_to(self, depth: f32, stencil: u8) -> Self {
        Self {
            cleared: (depth, stencil),
            ..self
        }
    }

    /// Other colours over the same depth and stencil.
    pub(super) fn with_color(&self, device: &Device, format: wgpu::TextureFormat) -> Self {
        Self {
            color: color_buffer(device, self.color.size(), format),
            depth: self.depth.clone(),
            after: self.after,
            cleared: self.cleared,
        }
    }

    /// Width and height.
    pub(super) fn size(&self) -> [u32; 2] {
        [self.color.width(), self.color.height()]
    }

    /// Begins a pass: the colour cleared to this one, or left as it is; depth and stencil cleared.
    pub(super) fn begin<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        clear: Option<[f64; 4]>,
    ) -> wgpu::RenderPass<'e> {
        self.pass(encoder, clear, false)
    }

    /// Goes on with depth and stencil as they are, if they were [kept](Depth::Kept); the colour cleared or left as it is.
    pub(super) fn resume<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        clear: Option<[f64; 4]>,
    ) -> wgpu::RenderPass<'e> {
        self.pass(encoder, clear, true)
    }

    fn pass<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        clear: Option<[f64; 4]>,
        resumes: bool,
    ) -> wgpu::RenderPass<'e> {
        let store = match self.after {
            Depth::Dropped => wgpu::StoreOp::Discard,
            Depth::Kept | Depth::Read => wgpu::StoreOp::Store,
        };
        let color = self.color.create_view(&Default::default());
        let depth = self.depth.create_view(&Default::default());
        let load = clear.map_or(wgpu::LoadOp::Load, |[r, g, b, a]| {
            wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a })
        });
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &color,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load,
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: match resumes {
                        true => wgpu::LoadOp::Load,
                        false => wgpu::LoadOp::Clear(self.cleared.0),
                    },
                    store,
                }),
                stencil_ops: (self.depth.format().has_stencil_aspect()).then_some(
                    wgpu::Operations {
                        load: match resumes {
                            true => wgpu::LoadOp::Load,
                            false => wgpu::LoadOp::Clear(self.cleared.1.into()),
                        },
                        store,
                    },
                ),
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        })
    }

    /// Submits what was encoded, waits, and gives the colours as bytes, row after row without gaps; behind them the
    /// depths, if they are kept, else nothing.
    ///
    /// # Errors
    /// [`GpuError::Device`] and [`GpuError::Lost`].
    pub(super) fn read(
        &self,
        device: &Device,
        mut encoder: wgpu::CommandEncoder,
    ) -> Result<(Vec<u8>, Vec<u8>), GpuError> {
        let color = Copied::of(device, &mut encoder, &self.color);
        let read = self.after == Depth::Read;
        let depth = read.then(|| Copied::of(device, &mut encoder, &self.depth));
        device.queue.submit([encoder.finish()]);
        device.check()?;
        let colors = color.bytes(device)?;
        let depths = depth.map_or(Ok(Vec::new()), |depth| depth.bytes(device))?;
        Ok((colors, depths))
    }

    /// Puts colours of four bytes into the picture, row after row without gaps.
    pub(super) fn fill(&self, device: &Device, bytes: &[u8]) {
        let size = self.color.size();
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * size.width),
            rows_per_image: None,
        };
        let to = self.color.as_image_copy();
        device.queue.write_texture(to, bytes, layout, size);
    }

    /// Copies the colour of one pixel to a place in a buffer, whose offset is a multiple of its size.
    pub(super) fn copy_pixel(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        [x, y]: [u32; 2],
        buffer: &wgpu::Buffer,
        offset: u64,
    ) {
        let mut from = self.color.as_image_copy();
        from.origin = wgpu::Origin3d { x, y, z: 0 };
        encoder.copy_texture_to_buffer(
            from,
            wgpu::TexelCopyBufferInfo {
                buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset,
                    bytes_per_row: None,
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d {
                width: 1,
                height: 1,
                depth_or_array_layers: 1,
            },
        );
    }
}

/// A texture that colours are drawn and copied into and read from.
fn color_buffer(
    device: &Device,
    size: wgpu::Extent3d,
    format: wgpu::TextureFormat,
) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
        | wgpu::TextureUsages::COPY_SRC
        | wgpu::TextureUsages::COPY_DST;
    buffer(device, size, format, usage)
}

fn buffer(
    device: &Device,
    size: wgpu::Extent3d,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    device.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

/// A buffer of so many bytes that things are copied into to be read.
pub(super) fn readback(device: &Device, size: u64) -> wgpu::Buffer {
    device.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size,
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    })
}

/// Waits for what was submitted, and gives the bytes of a [`readback`] buffer.
///
/// # Errors
/// [`GpuError::Device`] and [`GpuError::Lost`].
pub(super) fn content(device: &Device, buffer: &wgpu::Buffer) -> Result<Vec<u8>, GpuError> {
    let (send, receive) = mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |mapped| {
        // Nobody listens any more if the wait below failed.
        let _ = send.send(mapped);
    });
    device.wait()?;
    match receive.try_recv() {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return Err(GpuError::Device(error.to_string())),
        Err(error) => return Err(GpuError::Lost(error.to_string())),
    }
    let mapped =
        (buffer.get_mapped_range(..)).map_err(|error| GpuError::Device(error.to_string()))?;
    Ok(mapped.to_vec())
}

/// A 32-bit float as it comes back.
pub(super) fn number(bytes: &[u8]) -> f32 {
    <[u8; 4]>::try_from(bytes).map_or(0.0, f32::from_le_bytes)
}

/// Texels of four 32-bit floats.
pub(super) fn floats(bytes: &[u8]) -> Vec<[f32; 4]> {
    let texel = |bytes: &[u8]| {
        let channel = |i: usize| number(bytes.get(4 * i..4 * i + 4).unwrap_or_default());
        [channel(0), channel(1), channel(2), channel(3)]
    };
    bytes.chunks_exact(16).map(texel).collect()
}

/// A texture on its way back.
struct Copied {
    buffer: wgpu::Buffer,
    /// Bytes of a row, and with the gap behind it.
    row: [usize; 2],
}

impl Copied {
    /// Encodes the copy of a texture of one level and one aspect.
    fn of(device: &Device, encoder: &mut wgpu::CommandEncoder, texture: &wgpu::Texture) -> Self {
        let size = texture.size();
        let texel = texture.format().block_copy_size(None).unwrap_or(4);
        let row = size.width * texel;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = readback(device, u64::from(padded) * u64::from(size.height));
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: Some(size.height),
                },
            },
            size,
        );
        Self {
            buffer,
            row: [row as usize, padded as usize],
        }
    }

    /// Waits for the content.
    fn bytes(&self, device: &Device) -> Result<Vec<u8>, GpuError> {
        let bytes = content(device, &self.buffer)?;
        let [row, padded] = self.row;
        Ok(bytes
            .chunks_exact(padded)
            .flat_map(|padded| padded.iter().take(row))
            .copied()
            .collect())
    }
}
