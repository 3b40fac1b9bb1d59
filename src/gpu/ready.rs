//! Draws that only have to be encoded.

use std::ops::Range;

use crate::raster::{Topology, Viewport};

/// A draw that only has to be encoded.
pub(super) struct Ready {
    pub(super) pipeline: wgpu::RenderPipeline,
    pub(super) groups: [wgpu::BindGroup; 2],
    pub(super) vertices: Vec<wgpu::Buffer>,
    pub(super) indices: Option<wgpu::Buffer>,
    /// The indices, or vertices of each instance.
    pub(super) corners: Range<u32>,
    pub(super) instances: Range<u32>,
    pub(super) stencil: u32,
    pub(super) viewport: Viewport,
    /// Left, top, width and height of what may be drawn into, neither side 0.
    pub(super) scissor: [u32; 4],
}

/// What two rectangles have in common, each with its left, top, width and height; none if that is nothing.
pub(super) fn common(a: [u32; 4], b: [u32; 4]) -> Option<[u32; 4]> {
    let [left, top] = [0, 1].map(|axis| a[axis].max(b[axis]));
    let end = |axis: usize| {
        let [a, b] = [a, b].map(|one| one[axis].saturating_add(one[axis + 2]));
        a.min(b)
    };
    let [width, height] = [end(0).saturating_sub(left), end(1).saturating_sub(top)];
    (width > 0 && height > 0).then_some([left, top, width, height])
}

impl Ready {
    /// The same, drawn into a part of the picture only; none if it draws nothing there.
    pub(super) fn within(self, part: [u32; 4]) -> Option<Self> {
        let scissor = common(self.scissor, part)?;
        Some(Self { scissor, ..self })
    }

    /// The same with one primitive only; none if there is no such primitive.
    pub(super) fn primitive(mut self, topology: Topology, number: usize) -> Option<Self> {
        let number = u32::try_from(number).ok()?;
        let (part, first, count) = match topology {
            Topology::PointList => (&mut self.instances, number, 1),
            // Strips and fans are drawn as lists.
            Topology::LineList | Topology::LineStrip => {
                (&mut self.corners, number.checked_mul(2)?, 2)
            }
            Topology::TriangleList | Topology::TriangleStrip | Topology::TriangleFan => {
                (&mut self.corners, number.checked_mul(3)?, 3)
            }
        };
        let end = first.checked_add(count).filter(|end| *end <= part.end)?;
        *part = first..end;
        Some(self)
    }

    pub(super) fn encode(&self, commands: &mut wgpu::RenderPass<'_>) {
        commands.set_pipeline(&self.pipeline);
        for (number, group) in (0..).zip(&self.groups) {
            commands.set_bind_group(number, group, &[]);
        }
        for (slot, buffer) in (0..).zip(&self.vertices) {
            commands.set_vertex_buffer(slot, buffer.slice(..));
        }
        commands.set_stencil_reference(self.stencil);
        let [x, y, width, height] = self.viewport.rectangle().map(|v| v as f32);
        commands.set_viewport(x, y, width, height, 0.0, 1.0);
        let [x, y, width, height] = self.scissor;
        commands.set_scissor_rect(x, y, width, height);
        let (corners, instances) = (self.corners.clone(), self.instances.clone());
        match &self.indices {
            Some(buffer) => {
                commands.set_index_buffer(buffer.slice(..), wgpu::IndexFormat::Uint32);
                commands.draw_indexed(corners, 0, instances);
            }
            None => commands.draw(corners, instances),
        }
    }
}
