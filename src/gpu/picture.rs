//! Colour and depth buffers on the device, and how their content comes back.

use std::sync::mpsc;

use super::{Device, GpuError};

/// The format of what is drawn into by a scene.
pub(super) const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// What a pass draws into. Neither side is 0.
pub(super) struct Picture {
    size: wgpu::Extent3d,
    format: wgpu::TextureFormat,
    color: wgpu::Texture,
    depth: wgpu::Texture,
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
    ) -> Self {
        let size = wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        };
        let texture = |format, usage| {
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
        };
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        Self {
            size,
            format,
            color: texture(format, attachment | wgpu::TextureUsages::COPY_SRC),
            depth: texture(depth, attachment),
        }
    }

    /// Begins a pass: the colour cleared to this one, depth to 1, stencil to 0.
    pub(super) fn begin<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        clear: [f64; 4],
    ) -> wgpu::RenderPass<'e> {
        let color = self.color.create_view(&Default::default());
        let depth = self.depth.create_view(&Default::default());
        let [r, g, b, a] = clear;
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &color,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Discard,
                }),
                stencil_ops: (self.depth.format().has_stencil_aspect()).then_some(
                    wgpu::Operations {
                        load: wgpu::LoadOp::Clear(0),
                        store: wgpu::StoreOp::Discard,
                    },
                ),
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        })
    }

    /// Submits what was encoded, waits, and gives the colours as bytes, row after row without gaps.
    ///
    /// # Errors
    /// [`GpuError::Device`] and [`GpuError::Lost`].
    pub(super) fn read(
        &self,
        device: &Device,
        mut encoder: wgpu::CommandEncoder,
    ) -> Result<Vec<u8>, GpuError> {
        let texel = self.format.block_copy_size(None).unwrap_or(4);
        let row = self.size.width * texel;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = device.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(padded) * u64::from(self.size.height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        encoder.copy_texture_to_buffer(
            self.color.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: Some(self.size.height),
                },
            },
            self.size,
        );
        device.queue.submit([encoder.finish()]);
        device.check()?;
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
        Ok(mapped
            .chunks_exact(padded as usize)
            .flat_map(|padded| padded.iter().take(row as usize))
            .copied()
            .collect())
    }
}
