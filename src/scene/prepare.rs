//! What a scene draws, as plain data: the passes and draws that the rasterizer, a GPU or a debugger takes.

use super::constants::{Constant, Surroundings};
use super::draw::{Declaration, Draw};
use super::error::{Problems, rules};
use super::shader::Shader;
use super::{Scene, TextureSource};
use crate::diagnostic::Span;
use crate::exec::{Environment, STAGES, bind_constants_over, overrides_definitions};
use crate::kernel::Kernel;
use crate::mesh::Mesh;
use crate::raster::{FogDistance, RenderState, Surface, Topology};
use crate::semantics::BumpState;
use crate::texture::Sampler;
use glam::{Mat4, Vec4};

/// Where the pixels of a pass go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// The picture of the scene.
    Picture,
    /// A face of a render target; the only one of a flat target is 0.
    Target {
        /// The target, by number.
        target: usize,
        /// The face, in the order of Direct3D.
        face: usize,
    },
}

/// Draws into one picture, one after the other.
#[derive(Clone, Debug)]
pub struct Pass<'a> {
    /// Where they go.
    pub output: Output,
    /// Its width and height in pixels.
    pub size: [u32; 2],
    /// Its format, and what it holds before the first draw.
    pub surface: Surface,
    /// From the world to its camera, for column vectors: `view * position`.
    pub view: Mat4,
    /// From its camera to clip space, for column vectors.
    pub projection: Mat4,
    /// The draws in order.
    pub draws: Vec<PreparedDraw<'a>>,
}

/// One draw call with everything that is set for it.
#[derive(Clone, Debug)]
pub struct PreparedDraw<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its number among the draws of the scene.
    pub number: usize,
    /// What feeds the vertex shader.
    pub mesh: &'a Mesh,
    /// From the mesh to the world, for column vectors. The shaders know it only from constants that the scene file sets.
    pub world: Mat4,
    /// Which attribute feeds which register.
    pub declaration: &'a Declaration,
    /// How vertices make up primitives.
    pub topology: Topology,
    /// The indices that the draw itself gives. Without them a triangle list takes those of the mesh, everything else its
    /// vertices in order.
    pub own_indices: Option<&'a [u32]>,
    /// The vertex shader.
    pub vertex: &'a Shader,
    /// Its constant registers.
    pub vertex_constants: Vec<[f32; 4]>,
    /// The pixel shader.
    pub pixel: &'a Shader,
    /// Its constant registers, clamped as Direct3D clamps them.
    pub pixel_constants: Vec<[f32; 4]>,
    /// The texture stages.
    pub stages: [PreparedStage; STAGES],
    /// The render states.
    pub state: RenderState,
}

impl PreparedDraw<'_> {
    /// What input register `register` holds for a vertex: the attribute that the declaration names, filled up from
    /// (0, 0, 0, 1), or these four numbers themselves.
    pub fn input(&self, vertex: usize, register: usize) -> [f32; 4] {
        let attribute = self.declaration.get(register).copied().flatten();
        attribute
            .and_then(|attribute| self.mesh.value(attribute, vertex))
            .unwrap_or(Vec4::W)
            .to_array()
    }

    /// What all input registers, `v0` to `v15`, hold for a vertex; see [`Self::input`].
    pub fn inputs(&self, vertex: usize) -> [[f32; 4]; 16] {
        std::array::from_fn(|register| self.input(vertex, register))
    }

    /// What the vertex shader runs with, beside its inputs: the constants.
    pub fn vertex_environment(&self) -> Environment<'static> {
        Environment {
            constants: self.vertex_constants.clone(),
            ..Environment::default()
        }
    }

    /// Whether a constant that one of the shaders defines itself has been set to something else.
    pub fn overrides_definitions(&self) -> bool {
        overrides_definitions(&self.vertex.kernel, &self.vertex_constants)
            || overrides_definitions(&self.pixel.kernel, &self.pixel_constants)
    }

    /// The vertices of the primitives in order; `None`: all, as they come.
    pub fn indices(&self) -> Option<&[u32]> {
        let of_mesh = || (self.topology == Topology::TriangleList).then(|| self.mesh.indices());
        self.own_indices.or_else(of_mesh)
    }
}

/// One texture stage of a draw.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PreparedStage {
    /// The texture, by its number in [`Scene::textures`].
    pub texture: Option<usize>,
    /// How it is sampled.
    pub sampler: Sampler,
    /// The bump mapping states.
    pub bump: BumpState,
}

impl Scene {
    /// What there is to draw for a picture of this size, in order: the render targets that the picture needs, each after
    /// those that it reads itself, and then the picture.
    pub fn passes(&self, size: [u32; 2]) -> Vec<Pass<'_>> {
        let needed = self.needed_targets();
        let mut left = Left::default();
        let mut passes = Vec::new();
        for &number in self.order.iter().filter(|number| needed[**number]) {
            let target = &self.targets[number];
            for face in 0..target.faces() {
                let view = target.matrices(face);
                passes.push(Pass {
                    output: Output::Target {
                        target: number,
                        face,
                    },
                    size: target.size,
                    surface: target.surface,
                    view: view.0,
                    projection: view.1,
                    draws: self.prepare(&target.draws, view, target.size, &mut left),
                });
            }
        }
        let view = self.picture_matrices(size);
        passes.push(Pass {
            output: Output::Picture,
            size,
            surface: self.surface,
            view: view.0,
            projection: view.1,
            draws: self.prepare(&self.picture, view, size, &mut left),
        });
        passes
    }

    fn picture_matrices(&self, [width, height]: [u32; 2]) -> (Mat4, Mat4) {
        self.camera
            .matrices(width.max(1) as f32 / height.max(1) as f32)
    }

    fn prepare(
        &self,
        draws: &[usize],
        view: (Mat4, Mat4),
        size: [u32; 2],
        left: &mut Left,
    ) -> Vec<PreparedDraw<'_>> {
        draws
            .iter()
            .filter_map(|&number| Some((number, self.draws.get(number)?)))
            .filter_map(|(number, draw)| {
                let surroundings = self.surroundings(draw, view, size);
                let mut state = draw.state.clone();
                state.fog.distance = (draw.fog_distance).unwrap_or_else(|| fog_distance(view.1));
                let stages = std::array::from_fn(|i| PreparedStage {
                    texture: draw.stages[i].texture,
                    sampler: draw.stages[i].sampler,
                    bump: draw.stages[i].bump,
                });
                Some(PreparedDraw {
                    name: &draw.name,
                    number,
                    mesh: self.meshes.get(draw.mesh)?,
                    world: draw.world,
                    declaration: &draw.declaration,
                    topology: draw.topology,
                    own_indices: draw.indices.as_ref().map(|at| at.value.as_slice()),
                    vertex: &draw.vertex,
                    vertex_constants: left.vertex.bind(
                        &draw.vertex.kernel,
                        &draw.vertex_constants,
                        &surroundings,
                    ),
                    pixel: &draw.pixel,
                    pixel_constants: left.pixel.bind(
                        &draw.pixel.kernel,
                        &draw.pixel_constants,
                        &surroundings,
                    ),
                    stages,
                    state,
                })
            })
            .collect()
    }

    fn surroundings(
        &self,
        draw: &Draw,
        (view, projection): (Mat4, Mat4),
        size: [u32; 2],
    ) -> Surroundings {
        Surroundings {
            world: draw.world,
            view,
            projection,
            light_direction: self.light_direction,
            time: self.time,
            size,
        }
    }

    /// The targets that a list of draws reads.
    pub(super) fn targets_read_by(&self, draws: &[usize]) -> Vec<usize> {
        let mut read: Vec<usize> = draws
            .iter()
            .filter_map(|&number| self.draws.get(number))
            .flat_map(|draw| &draw.stages)
            .filter_map(|stage| self.textures.get(stage.texture?))
            .filter_map(|texture| match texture.source {
                TextureSource::Target(target) | TextureSource::Irradiance { target, .. } => {
                    Some(target)
                }
                TextureSource::Loaded(_) => None,
            })
            .collect();
        read.sort_unstable();
        read.dedup();
        read
    }

    /// Which targets the picture needs, directly or through others.
    fn needed_targets(&self) -> Vec<bool> {
        let mut needed = vec![false; self.targets.len()];
        for number in self.targets_read_by(&self.picture) {
            needed[number] = true;
        }
        // From the last in order to the first: whoever needs a target has been seen before it.
        for &number in self.order.iter().rev() {
            if needed[number] {
                for read in self.targets_read_by(&self.targets[number].draws) {
                    needed[read] = true;
                }
            }
        }
        needed
    }

    /// Reports meanings that need the inverse of a matrix that has none, in every view in which they are used.
    pub(super) fn check_meanings(&self, problems: &mut Problems) {
        let picture = (&self.picture, self.picture_matrices(self.size), self.size);
        // The faces of a cube have the same shape, and so have either all an inverse or none.
        let targets = self
            .targets
            .iter()
            .map(|target| (&target.draws, target.matrices(0), target.size));
        let mut reported: Vec<Span> = Vec::new();
        for (draws, view, size) in std::iter::once(picture).chain(targets) {
            for draw in draws.iter().filter_map(|&number| self.draws.get(number)) {
                let surroundings = self.surroundings(draw, view, size);
                for constant in draw.vertex_constants.iter().chain(&draw.pixel_constants) {
                    if constant.bind(&surroundings).is_none() && !reported.contains(&constant.span)
                    {
                        reported.push(constant.span);
                        let message = "this needs the inverse of a matrix that has none";
                        problems.error(&rules::VALUE, constant.span, message);
                    }
                }
            }
        }
    }
}

/// What `def` has left in constant registers for the draws behind it.
#[derive(Default)]
struct Left {
    vertex: LeftOfKind,
    pixel: LeftOfKind,
}

/// The registers that shaders of a kind have defined so far, with what they hold.
#[derive(Default)]
struct LeftOfKind(Vec<(u32, [f32; 4])>);

impl LeftOfKind {
    /// The registers of a draw. What a draw sets is its own, but for registers that a shader has defined: Direct3D 8 has one
    /// file of constants, which definitions are loaded into.
    fn bind(
        &mut self,
        kernel: &Kernel,
        constants: &[Constant],
        surroundings: &Surroundings,
    ) -> Vec<[f32; 4]> {
        let set: Vec<(u32, [f32; 4])> = constants
            .iter()
            .filter_map(|constant| constant.bind(surroundings))
            .flatten()
            .collect();
        let bound = bind_constants_over(kernel, &self.0, &set);
        for (index, _) in &kernel.definitions {
            if !self.0.iter().any(|(known, _)| known == index) {
                self.0.push((*index, [0.0; 4]));
            }
        }
        for (index, value) in &mut self.0 {
            if let Some(held) = bound.get(*index as usize) {
                *value = *held;
            }
        }
        bound
    }
}

/// Direct3D 8 decides by the fourth column of the projection matrix, (0, 0, 0, 1) or not, which distance table fog uses.
fn fog_distance(projection: Mat4) -> FogDistance {
    if projection.row(3) == Vec4::W {
        FogDistance::Z
    } else {
        FogDistance::W
    }
}
