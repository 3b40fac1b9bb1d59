//! What rays meet: draws of a picture as surfaces in the world, with the colours that their own shaders give them.

use crate::tree::{Hit, Ray, Tree};
use glam::{DMat4, DVec2, DVec3, DVec4, Vec4};
use std::cell::RefCell;
use texcrd::exec::Machine;
use texcrd::kernel::Slot;
use texcrd::raster::PixelBatch;
use texcrd::scene::{Output, Rendering, ShadedDraw};

/// Surfaces in the world.
pub(crate) struct World<'a> {
    draws: Vec<ShadedDraw<'a>>,
    /// Of each triangle its draw and its vertices.
    triangles: Vec<(usize, [usize; 3])>,
    tree: Tree,
}

/// A surface at a point, with what its mesh says of it there.
pub(crate) struct Surface {
    pub(crate) normal: DVec3,
    pub(crate) tangent: DVec3,
    pub(crate) bitangent: DVec3,
    pub(crate) texcoord: DVec2,
}

impl<'a> World<'a> {
    /// The draws of the picture whose names `take` wants.
    pub(crate) fn new(rendering: &'a Rendering<'_>, take: impl Fn(&str) -> bool) -> Self {
        let count = rendering
            .pass(Output::Picture)
            .map_or(0, |pass| pass.draws.len());
        let draws: Vec<_> = (0..count)
            .filter_map(|number| rendering.shaded(Output::Picture, number))
            .filter(|draw| take(draw.draw().name))
            .collect();
        let mut triangles = Vec::new();
        let mut corners = Vec::new();
        for (number, draw) in draws.iter().enumerate() {
            let world = draw.draw().world.as_dmat4();
            let mesh = draw.draw().mesh;
            for triangle in mesh.indices().chunks_exact(3) {
                let vertices = [triangle[0], triangle[1], triangle[2]].map(|index| index as usize);
                triangles.push((number, vertices));
                corners.push(
                    vertices
                        .map(|vertex| world.transform_point3(mesh.positions()[vertex].as_dvec3())),
                );
            }
        }
        Self {
            draws,
            triangles,
            tree: Tree::new(corners),
        }
    }

    /// Where a ray first meets a surface.
    pub(crate) fn hit(&self, ray: &Ray) -> Option<Hit> {
        self.tree.hit(ray)
    }

    /// What the mesh says of the surface at a point: its attributes, interpolated, in the world.
    pub(crate) fn surface(&self, hit: &Hit) -> Surface {
        let (draw, vertices) = self.triangles[hit.triangle];
        let draw = self.draws[draw].draw();
        let mix = |list: &[glam::Vec3]| -> DVec3 {
            let [a, b, c] = vertices.map(|vertex| list[vertex].as_dvec3());
            a + hit.shares[0] * (b - a) + hit.shares[1] * (c - a)
        };
        let world = draw.world.as_dmat4();
        let turned = |direction: DVec3| world.transform_vector3(direction).normalize();
        let normals: DMat4 = world.inverse().transpose();
        let [a, b, c] = vertices.map(|vertex| draw.mesh.texcoords()[vertex].as_dvec2());
        Surface {
            normal: normals
                .transform_vector3(mix(draw.mesh.normals()))
                .normalize(),
            tangent: turned(mix(draw.mesh.tangents())),
            bitangent: turned(mix(draw.mesh.bitangents())),
            texcoord: a + hit.shares[0] * (b - a) + hit.shares[1] * (c - a),
        }
    }

    /// The colour of a surface at a point: what its pixel shader makes of what its vertex shader left, the textures read at
    /// their full size. It holds for shaders whose result does not depend on where the eye is.
    pub(crate) fn color(&self, hit: &Hit) -> DVec3 {
        thread_local! {
            static ROOM: RefCell<(Machine<4>, Box<PixelBatch>)> =
                RefCell::new((Machine::new(), Box::new(PixelBatch::empty())));
        }
        let (draw, vertices) = self.triangles[hit.triangle];
        let draw = &self.draws[draw];
        let [a, b, c] = vertices.map(|vertex| draw.vertices().get(vertex).unwrap_or_default());
        let [s, t] = hit.shares;
        let mix = |a: Vec4, b: Vec4, c: Vec4| -> DVec4 {
            let [a, b, c] = [a, b, c].map(|v| v.as_dvec4());
            a + s * (b - a) + t * (c - a)
        };
        let one = |color: Vec4| color.clamp(Vec4::ZERO, Vec4::ONE);
        ROOM.with_borrow_mut(|(machine, batch)| {
            // The four pixels of a quad are at the same place: no step between them, and so the largest level.
            let fill = |attribute: &mut [[f32; texcrd::raster::LANES]; 4], value: DVec4| {
                for (lanes, value) in attribute.iter_mut().zip(value.to_array()) {
                    lanes[..4].fill(value as f32);
                }
            };
            batch.quads = 1;
            fill(
                &mut batch.diffuse,
                mix(one(a.diffuse), one(b.diffuse), one(c.diffuse)),
            );
            fill(
                &mut batch.specular,
                mix(one(a.specular), one(b.specular), one(c.specular)),
            );
            for (set, attribute) in batch.texcoords.iter_mut().enumerate() {
                let [a, b, c] = [a, b, c].map(|vertex| vertex.texcoords[set]);
                fill(attribute, mix(a, b, c));
            }
            let program = draw.program();
            program.load(machine, batch);
            machine.run(program.kernel, program.environment);
            let [r, g, b, _] = machine.lane(Slot::R0, 0);
            DVec3::new(r.into(), g.into(), b.into()).clamp(DVec3::ZERO, DVec3::ONE)
        })
    }
}
