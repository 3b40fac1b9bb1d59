//! Vertex, index and uniform buffers of one frame.

use std::collections::HashMap;
use std::ops::Range;

use super::vertex::primitive_indices;
use super::{Device, Stream};
use crate::mesh::Mesh;
use crate::scene::PreparedDraw;

/// A buffer that holds these bytes, or four zeros if there are none.
pub(super) fn filled(device: &Device, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let buffer = device.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: (bytes.len() as u64).next_multiple_of(4).max(4),
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    // All content is made of 32-bit numbers.
    device.queue.write_buffer(&buffer, 0, bytes);
    buffer
}

/// Where the row of indices of a draw lies, if it has one; its mesh; the number of its topology.
type IndexKey = (*const u32, *const Mesh, u32);

/// The meshes of a scene on the device. They are told apart by where they lie, so this must not outlive the scene.
#[derive(Debug, Default)]
pub(super) struct MeshBuffers {
    streams: HashMap<(*const Mesh, Stream), wgpu::Buffer>,
    indices: HashMap<IndexKey, Option<(wgpu::Buffer, u32)>>,
}

impl MeshBuffers {
    /// The vertex buffer for a stream of a mesh.
    pub(super) fn stream(&mut self, device: &Device, mesh: &Mesh, stream: Stream) -> wgpu::Buffer {
        let known = self.streams.entry((mesh, stream));
        let create = || filled(device, &stream.bytes(mesh), wgpu::BufferUsages::VERTEX);
        known.or_insert_with(create).clone()
    }

    /// The index buffer and how many indices there are, for draws that take one.
    pub(super) fn indices(
        &mut self,
        device: &Device,
        draw: &PreparedDraw<'_>,
    ) -> Option<(wgpu::Buffer, u32)> {
        let (topology, row) = (draw.topology, draw.indices());
        let place = row.map_or(std::ptr::null(), <[u32]>::as_ptr);
        let known = (self.indices).entry((place, draw.mesh, topology.number()));
        let create = || {
            let indices = primitive_indices(topology, row, draw.mesh.vertex_count() as u32)?;
            let bytes: Vec<u8> = indices
                .iter()
                .flat_map(|index| index.to_le_bytes())
                .collect();
            let buffer = filled(device, &bytes, wgpu::BufferUsages::INDEX);
            Some((buffer, indices.len() as u32))
        };
        known.or_insert_with(create).clone()
    }
}

/// The uniform blocks of a pass, uploaded together.
pub(super) struct UniformArena {
    bytes: Vec<u8>,
    alignment: usize,
}

impl UniformArena {
    pub(super) fn new(device: &Device) -> Self {
        Self {
            bytes: Vec::new(),
            alignment: device
                .device
                .limits()
                .min_uniform_buffer_offset_alignment
                .max(16) as usize,
        }
    }

    /// Adds a block; gives its place in the buffer.
    pub(super) fn push(&mut self, block: &[u8]) -> Range<u64> {
        let start = self.bytes.len().next_multiple_of(self.alignment);
        self.bytes.resize(start, 0);
        self.bytes.extend_from_slice(block);
        start as u64..(start + block.len()) as u64
    }

    /// The entry of a bind group for a block in the buffer.
    pub(super) fn entry<'b>(
        buffer: &'b wgpu::Buffer,
        binding: u32,
        place: &Range<u64>,
    ) -> wgpu::BindGroupEntry<'b> {
        wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer,
                offset: place.start,
                size: std::num::NonZeroU64::new(place.end - place.start),
            }),
        }
    }

    /// The buffer with all blocks.
    pub(super) fn upload(&self, device: &Device) -> wgpu::Buffer {
        filled(device, &self.bytes, wgpu::BufferUsages::UNIFORM)
    }
}
