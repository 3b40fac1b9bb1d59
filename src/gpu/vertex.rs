//! Vertex buffers from a declaration, and the order in which vertices are drawn.

use crate::mesh::{Attribute, Mesh};
use crate::raster::Topology;
use crate::scene::Declaration;
use crate::wgsl::VertexInput;

/// What one vertex buffer holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stream {
    /// An attribute of the mesh, one value a vertex.
    Mesh(Attribute),
    /// (0, 0, 0, 1) for all vertices: what a register reads that nothing feeds.
    Default,
}

/// The vertex buffers of a pipeline: which attribute lies in which, and which registers read it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct VertexLayout {
    streams: Vec<Stream>,
    /// Bytes from one element to the next, and what is read of it, by slot.
    buffers: Vec<(u64, Vec<wgpu::VertexAttribute>)>,
    instanced: bool,
}

impl VertexLayout {
    /// The layout for registers that a vertex shader reads, fed as a declaration says: one buffer an attribute.
    /// `instanced`: points are drawn as quads, one instance each.
    pub fn new(declaration: &Declaration, inputs: &[VertexInput], instanced: bool) -> Self {
        let mut layout = Self {
            instanced,
            ..Self::default()
        };
        for input in inputs {
            let attribute = declaration.get(input.register as usize).copied().flatten();
            let stream = attribute.map_or(Stream::Default, Stream::Mesh);
            let read = wgpu::VertexAttribute {
                format: match stream.components() {
                    3 => wgpu::VertexFormat::Float32x3,
                    _ => wgpu::VertexFormat::Float32x4,
                },
                offset: 0,
                shader_location: input.register,
            };
            match layout.streams.iter().position(|known| *known == stream) {
                Some(slot) => layout.buffers[slot].1.push(read),
                None => {
                    layout.streams.push(stream);
                    layout.buffers.push((stream.stride(), vec![read]));
                }
            }
        }
        layout
    }

    /// One buffer with an element an instance, four floats for each of these locations; none if there are none.
    pub(super) fn instances(locations: &[u32]) -> Self {
        if locations.is_empty() {
            return Self::default();
        }
        let read = |(number, location): (u64, &u32)| wgpu::VertexAttribute {
            format: wgpu::VertexFormat::Float32x4,
            offset: 16 * number,
            shader_location: *location,
        };
        let stride = 16 * locations.len() as u64;
        Self {
            streams: Vec::new(),
            buffers: vec![(stride, (0..).zip(locations).map(read).collect())],
            instanced: true,
        }
    }

    /// What the vertex buffers hold, by slot.
    pub fn streams(&self) -> impl Iterator<Item = Stream> + '_ {
        self.streams.iter().copied()
    }

    /// The layout as a pipeline wants it.
    pub fn buffers(&self) -> Vec<wgpu::VertexBufferLayout<'_>> {
        let step_mode = if self.instanced {
            wgpu::VertexStepMode::Instance
        } else {
            wgpu::VertexStepMode::Vertex
        };
        self.buffers
            .iter()
            .map(|(array_stride, attributes)| wgpu::VertexBufferLayout {
                array_stride: *array_stride,
                step_mode,
                attributes,
            })
            .collect()
    }
}

impl Stream {
    /// How many floats a vertex has.
    fn components(self) -> usize {
        match self {
            Self::Mesh(attribute) => attribute.components(),
            Self::Default => 4,
        }
    }

    /// Bytes from one vertex to the next; 0 where all share one.
    fn stride(self) -> u64 {
        match self {
            Self::Mesh(attribute) => 4 * attribute.components() as u64,
            Self::Default => 0,
        }
    }

    /// The content of the buffer for a mesh.
    pub fn bytes(self, mesh: &Mesh) -> Vec<u8> {
        let of = |values: &[f32]| -> Vec<u8> {
            values
                .iter()
                .flat_map(|value| value.to_le_bytes())
                .collect()
        };
        match self {
            Self::Mesh(attribute) => (mesh.stream(attribute).iter())
                .flat_map(|value| of(&value.to_array()[..attribute.components()]))
                .collect(),
            Self::Default => of(&[0.0, 0.0, 0.0, 1.0]),
        }
    }
}

/// The indices to draw with, if it takes any. `row` are those of the draw, without which the `count` vertices are drawn as
/// they come; strips and fans become lists, in the order that Direct3D gives their corners, so that winding and flat colours
/// are the same.
pub fn primitive_indices(topology: Topology, row: Option<&[u32]>, count: u32) -> Option<Vec<u32>> {
    let length = row.map_or(count, |row| row.len() as u32);
    let triangles = 0..length.saturating_sub(2);
    let list: Vec<u32> = match topology {
        Topology::PointList => return None,
        Topology::LineList | Topology::TriangleList => return row.map(<[u32]>::to_vec),
        Topology::LineStrip => (0..length.saturating_sub(1))
            .flat_map(|i| [i, i + 1])
            .collect(),
        Topology::TriangleStrip => triangles
            .flat_map(|i| match i % 2 {
                0 => [i, i + 1, i + 2],
                _ => [i, i + 2, i + 1],
            })
            .collect(),
        Topology::TriangleFan => triangles.flat_map(|i| [i + 1, i + 2, 0]).collect(),
    };
    let Some(row) = row else {
        return Some(list);
    };
    let vertex = |i: u32| row.get(i as usize).copied();
    Some(list.into_iter().filter_map(vertex).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn input(register: u32) -> VertexInput {
        VertexInput {
            register,
            usage: None,
        }
    }

    #[test]
    fn registers_share_the_buffer_of_an_attribute() {
        let mut declaration: Declaration = [None; 16];
        declaration[0] = Some(Attribute::Position);
        declaration[4] = Some(Attribute::Texcoord);
        declaration[5] = Some(Attribute::Position);
        let inputs = [input(0), input(4), input(5), input(9)];
        let layout = VertexLayout::new(&declaration, &inputs, false);
        let streams: Vec<_> = layout.streams().collect();
        let position = Stream::Mesh(Attribute::Position);
        let texcoord = Stream::Mesh(Attribute::Texcoord);
        assert_eq!(streams, [position, texcoord, Stream::Default]);
        let buffers = layout.buffers();
        let strides: Vec<_> = buffers.iter().map(|buffer| buffer.array_stride).collect();
        assert_eq!(strides, [12, 16, 0]);
        let locations: Vec<_> = (buffers[0].attributes.iter())
            .map(|attribute| attribute.shader_location)
            .collect();
        assert_eq!(locations, [0, 5]);
    }

    #[test]
    fn strips_and_fans_keep_direct3ds_order() {
        let strip = primitive_indices(Topology::TriangleStrip, None, 5).unwrap();
        assert_eq!(strip, [0, 1, 2, 1, 3, 2, 2, 3, 4]);
        let fan = primitive_indices(Topology::TriangleFan, None, 5).unwrap();
        assert_eq!(fan, [1, 2, 0, 2, 3, 0, 3, 4, 0]);
        let line = primitive_indices(Topology::LineStrip, None, 3).unwrap();
        assert_eq!(line, [0, 1, 1, 2]);
        assert_eq!(primitive_indices(Topology::LineList, None, 5), None);
        // The same through indices: vertices 7, 5, 6, 4.
        let row = Some([7, 5, 6, 4].as_slice());
        let strip = primitive_indices(Topology::TriangleStrip, row, 8).unwrap();
        assert_eq!(strip, [7, 5, 6, 5, 4, 6]);
        let fan = primitive_indices(Topology::TriangleFan, row, 8).unwrap();
        assert_eq!(fan, [5, 6, 7, 6, 4, 7]);
        let line = primitive_indices(Topology::LineStrip, row, 8).unwrap();
        assert_eq!(line, [7, 5, 5, 6, 6, 4]);
    }
}
