//! From kernels to WGSL that a person would be glad to have written.
//!
//! [`translate`] takes a vertex shader, a pixel shader, or both linked into one module, and gives the text and a
//! [`Reflection`] of what is to be bound. Every line of a listing stands as a comment above what it became. What a line
//! became has the meaning of [`crate::semantics`]; where WGSL leaves a precision or an order open, the arithmetic is
//! spelled out.
//!
//! # The contract
//!
//! | where | what |
//! | --- | --- |
//! | group 0, binding 0 | `vs`: the uniform block of the vertex stage |
//! | group 0, binding 1 | `ps`: the uniform block of the pixel stage |
//! | group 1, binding 2·n and 2·n + 1 | texture and, where one reads it, sampler of texture stage n |
//! | vertex `@location(n)` | `v`n, four floats; what the stream does not hold is 0, 0, 0, 1 |
//! | varyings | coordinate sets 0 to 7 at locations 0 to 7, colours at 8 and 9, `oFog` at 10, clip distances at 11 and 12 |
//!
//! Only what is used is there; [`Reflection::bindings`] lists it, fields of the blocks with their offsets. Between
//! stages that are translated apart, whole vectors are passed, so that any vertex stage that writes what a pixel stage
//! reads fits to it; linked stages pass the components that are read.
//!
//! - *Constants.* A `def` is a `const` of the function, unless [`Options::overridable_definitions`] or relative
//!   addressing make it part of the uniform block. There its value is the caller's business, as is 0 for constants
//!   that nobody set. The pixel stage clamps what comes from the block to −1…1; the caller need not.
//! - *Viewport.* `vs.viewport` is its size in pixels; the half pixel between Direct3D 8's pixel centres and those of
//!   WebGPU is added in clip space. Its depths and `D3DRS_ZBIAS` come in with the pixel stage
//!   ([`Options::mapped_depth`]): WebGPU has no steps of 1/65535, and its viewport would limit the depths that shaders set.
//! - *Colours* are clamped at the vertex and in the pixel stage. The result is not clamped unless there is fog: a
//!   `unorm` target does that.
//! - *Tests.* `texkill`, user clip planes and the alpha test come behind all sampling, in one `discard`. Stencil, depth
//!   test, blending and colour mask are states of the pipeline.
//! - *Cubes* are bound as six 2D layers, filtered each for itself as Direct3D 8 did, or seamless as `texture_cube`.
//! - *Samples texel by texel.* What a sampler of WebGPU cannot do (`border`, `mirror_once`, `mirror` exactly, anisotropic filters that are the
//!   same everywhere, weights of 8 bits) the shader does itself with `textureLoad`, with everything that is known of the
//!   stage baked in: [`StageOptions`]. Such a stage has no sampler.
//! - *Points* are strips of two triangles: buffers step per instance, four vertices an instance, culling off.
//!
//! # What is assumed
//!
//! Direct3D 8 says that 0 times anything is 0, also times infinity. A product is guarded where a factor may be infinite or
//! NaN, under these assumptions: vertex data, texture coordinates, vertex constants and stage states are finite and no
//! larger than 65536 unless [`Options::wild_inputs`] says otherwise; texels lie in −1…1 unless
//! [`StageOptions::wide_texels`] does; a vector multiplied by the reciprocal of its own length, as `dp3`, `rsq`, `mul` compute it, is no longer than 1, that is, not shorter than 1e-19
//! before unless it is 0.
//!
//! Left to the GPU: denormal results, the sign of zero, NaN in coordinates and in saturation other than of fog (0 on all that is known),
//! the level of detail within what WebGPU allows, the order of the sum within `dot` unless [`Options::exact_dots`].
//!
//! # Numbers of hardware models
//!
//! Under a [`Model`] of few bits a function of its name brings numbers into its steps, where a register
//! or a constant may hold others and behind arithmetic. Filters with weights of 8 bits are computed in the shader
//! ([`StageOptions::weights`]).

mod body;
mod by_hand;
mod constants;
mod error;
mod expression;
mod faces;
mod helper;
mod layout;
mod listing;
mod magnitude;
mod number;
mod operand;
mod operation;
mod options;
mod pixel;
mod reflection;
mod shown;
#[cfg(test)]
mod tests;
mod texels;
mod together;
mod varyings;
mod vertex;

pub use error::TranslateError;
pub use layout::{Field, UniformField};
pub use options::{Fog, Observed, Options, Points, Shown, ShownPixels, StageOptions};
pub use reflection::{
    Binding, Definition, Dimension, Reflection, Resource, StageReflection, Varying, VertexInput,
};

use crate::diagnostic::SourceMap;
use crate::isa::ShaderKind;
use crate::kernel::Kernel;
use crate::policy::Model;
use crate::program::Program;
use crate::texture::TextureKind;
use body::Body;
use constants::{Constant, bound_value};
use helper::Helpers;
use layout::Block;
use listing::Lines;
use std::fmt::Write;
use std::ops::Range;
use varyings::Varyings;

/// One shader to translate.
#[derive(Clone, Copy, Debug)]
pub struct Stage<'a> {
    /// The shader as it was written.
    pub program: &'a Program,
    /// The same, lowered.
    pub kernel: &'a Kernel,
    /// The texts that the spans of the program point into.
    pub source: &'a SourceMap,
}

/// A module and what must be known to use it.
#[derive(Clone, Debug, PartialEq)]
pub struct Translation {
    /// The WGSL.
    pub source: String,
    /// What it expects.
    pub reflection: Reflection,
}

/// Translates a vertex shader, a pixel shader, or both into one module.
///
/// # Errors
/// [`TranslateError`] for no shader at all, a shader of the wrong kind, or options that have no meaning. Every kernel
/// that [`crate::kernel::lower`] makes can be translated.
pub fn translate(
    vertex: Option<Stage<'_>>,
    pixel: Option<Stage<'_>>,
    options: &Options,
) -> Result<Translation, TranslateError> {
    check(vertex.as_ref(), pixel.as_ref(), options)?;
    let varyings = Varyings::new(vertex.as_ref(), pixel.as_ref(), options);
    let vertex = vertex
        .as_ref()
        .map(|stage| Part::new(stage, options, &varyings));
    let pixel = pixel
        .as_ref()
        .map(|stage| Part::new(stage, options, &varyings));
    let parts: Vec<&Part<'_>> = vertex.iter().chain(&pixel).collect();
    let bindings: Vec<Binding> = parts
        .iter()
        .flat_map(|part| part.bindings(options))
        .collect();
    let mut sections = vec![heading(&parts, &bindings, options)];
    for part in &parts {
        sections.extend(part.uniform_structure());
    }
    sections.extend(declarations(&bindings));
    if let Some(vertex) = &vertex {
        sections.extend(vertex::input_structure(vertex.stage.kernel));
    }
    sections.extend(varyings.structure());
    if let Some(pixel) = &pixel {
        let writes_depth = pixel.reflection.writes_depth;
        sections.extend(pixel::output_structure(writes_depth).map(String::from));
    }
    sections.extend(observed_variables(&parts, options));
    let mut helpers = Helpers::default();
    parts.iter().for_each(|part| helpers.add(&part.helpers));
    sections.extend(Some(helpers.text()).filter(|text| !text.is_empty()));
    sections.extend(parts.iter().map(|part| part.function.clone()));
    Ok(Translation {
        source: sections.join("\n"),
        reflection: Reflection {
            inputs: vertex.as_ref().map_or(Vec::new(), Part::inputs),
            varyings: varyings.list(),
            position: varyings.position,
            vertex: vertex.as_ref().map(|part| part.reflection.clone()),
            pixel: pixel.as_ref().map(|part| part.reflection.clone()),
            bindings,
            baked: options.clone(),
        },
    })
}

/// What registers are left in that are looked at, and the switch that keeps pixels.
fn observed_variables(parts: &[&Part<'_>], options: &Options) -> Option<String> {
    let observed = options.observed.as_ref()?;
    let mut lines = String::new();
    for part in parts {
        let count = observed.of(part.kind()).len();
        let name = Observed::variable(part.kind());
        if count > 0 {
            lines.push_str(&format!("var<private> {name}: array<vec4f, {count}>;\n"));
        }
        if part.reflection.discards {
            lines.push_str("var<private> keep: bool;\n");
        }
    }
    (!lines.is_empty()).then_some(lines)
}

fn check(
    vertex: Option<&Stage<'_>>,
    pixel: Option<&Stage<'_>>,
    options: &Options,
) -> Result<(), TranslateError> {
    if vertex.is_none() && pixel.is_none() {
        return Err(TranslateError::Nothing);
    }
    for (stage, place) in [(vertex, ShaderKind::Vertex), (pixel, ShaderKind::Pixel)] {
        let version = stage.map(|stage| stage.kernel.version);
        if let Some(version) = version.filter(|version| version.kind() != place) {
            return Err(TranslateError::WrongKind { place, version });
        }
    }
    if options.clip_planes > 6 {
        return Err(TranslateError::ClipPlanes(options.clip_planes));
    }
    let (vertex, pixel) = (&options.vertex_entry, &options.pixel_entry);
    match [vertex, pixel]
        .into_iter()
        .find(|name| !is_entry_name(name))
    {
        None if vertex == pixel => Err(TranslateError::EntryPoint(vertex.clone())),
        None => Ok(()),
        Some(name) => Err(TranslateError::EntryPoint(name.clone())),
    }
}

/// Names that end in `_main` are neither reserved words nor names that a translation uses itself.
fn is_entry_name(name: &str) -> bool {
    let letters = |c: char| c.is_ascii_alphanumeric() || c == '_';
    name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(letters)
        && name.ends_with("_main")
        && name.len() <= 200
}

/// One translated stage.
struct Part<'a> {
    stage: &'a Stage<'a>,
    function: String,
    block: Block,
    helpers: Helpers,
    reflection: StageReflection,
}

impl<'a> Part<'a> {
    fn new(stage: &'a Stage<'a>, options: &'a Options, varyings: &Varyings) -> Self {
        let mut body = Body::new(stage, options, varyings.sets);
        body.block.clip_planes = options.clip_planes.into();
        let kind = stage.kernel.version.kind();
        let (head, entry) = match kind {
            ShaderKind::Vertex => (vertex::entry(&mut body, varyings), &options.vertex_entry),
            ShaderKind::Pixel => (pixel::entry(&mut body, varyings), &options.pixel_entry),
        };
        let discards = kind == ShaderKind::Pixel && body.discards();
        let reflection = StageReflection {
            entry: entry.clone(),
            version: stage.program.version,
            constants: uniform_constants(&body),
            relative: body.is_relative(),
            definitions: definitions(&body),
            point_size: !stage
                .kernel
                .written(crate::kernel::Slot::POINT_SIZE)
                .is_empty(),
            writes_depth: kind == ShaderKind::Pixel && pixel::writes_depth(stage.kernel, options),
            discards,
        };
        let (text, block, helpers) = body.finish();
        Self {
            stage,
            function: [&head, text.as_str(), "}\n"].concat(),
            block,
            helpers,
            reflection,
        }
    }

    fn kind(&self) -> ShaderKind {
        self.stage.kernel.version.kind()
    }

    /// Name of the uniform block and of its structure, and its binding.
    fn block_name(&self) -> (&'static str, &'static str, u32) {
        match self.kind() {
            ShaderKind::Vertex => ("vs", "VertexUniforms", 0),
            ShaderKind::Pixel => ("ps", "PixelUniforms", 1),
        }
    }

    fn uniform_structure(&self) -> Option<String> {
        let (fields, _) = self.block.fields();
        let (_, structure, _) = self.block_name();
        (!fields.is_empty()).then(|| {
            let mut text = format!("struct {structure} {{\n");
            for f in &fields {
                let about = f.field.about();
                _ = writeln!(text, "    {}: {}, // {about}", f.name, f.wgsl_type);
            }
            text + "}\n"
        })
    }

    fn bindings(&self, options: &Options) -> Vec<Binding> {
        let mut bindings = Vec::new();
        let (fields, size) = self.block.fields();
        if !fields.is_empty() {
            let (name, _, binding) = self.block_name();
            let stage = self.kind();
            bindings.push(Binding {
                group: 0,
                binding,
                name: name.into(),
                resource: Resource::Uniform {
                    stage,
                    fields,
                    size,
                },
            });
        }
        let sampled = self.stage.kernel.stages();
        for stage in (0..8u8).filter(|stage| sampled >> stage & 1 == 1) {
            let state = &options.stages[usize::from(stage)];
            let dimension = match state.texture {
                None => continue,
                Some(TextureKind::Texture2D) => Dimension::D2,
                Some(TextureKind::Volume) => Dimension::D3,
                Some(TextureKind::Cube) if state.seamless && !state.is_by_hand() => Dimension::Cube,
                Some(TextureKind::Cube) => Dimension::D2Array,
            };
            let is_array = dimension == Dimension::D2Array;
            let clamps = [is_array, is_array, false];
            let first = 2 * u32::from(stage);
            let sampler = ("sampler", Resource::Sampler { stage, clamps });
            let resources = std::iter::once(("texture", Resource::Texture { stage, dimension }))
                .chain((!state.is_by_hand()).then_some(sampler));
            for (binding, (what, resource)) in (first..).zip(resources) {
                bindings.push(Binding {
                    group: 1,
                    binding,
                    name: format!("{what}{stage}"),
                    resource,
                });
            }
        }
        bindings
    }

    fn inputs(&self) -> Vec<VertexInput> {
        let declared = |register: u32| {
            let mut declarations = self.stage.program.declarations();
            let found = declarations.find(|dcl| dcl.register.index == register)?;
            Some((found.usage, found.usage_index))
        };
        vertex::inputs(self.stage.kernel)
            .map(|register| VertexInput {
                register,
                usage: declared(register),
            })
            .collect()
    }
}

/// The numbers of the constants that come from the uniform block.
fn uniform_constants(body: &Body<'_>) -> Vec<Range<u32>> {
    if body.is_relative() {
        return std::iter::once(0..body.block.constants).collect();
    }
    let kernel = body.stage.kernel;
    let mut numbers: Vec<u32> = (kernel.constants())
        .filter(|index| body.constant(*index) == Constant::Uniform && body.names_constant(*index))
        .collect();
    numbers.sort_unstable();
    numbers.dedup();
    let mut ranges: Vec<Range<u32>> = Vec::new();
    for number in numbers {
        match ranges.last_mut() {
            Some(range) if range.end == number => range.end += 1,
            _ => ranges.push(number..number + 1),
        }
    }
    ranges
}

fn definitions(body: &Body<'_>) -> Vec<Definition> {
    let kernel = body.stage.kernel;
    let mut found: Vec<Definition> = Vec::new();
    // The last definition of a register counts.
    for (register, value) in kernel.definitions.iter().rev() {
        if found
            .iter()
            .all(|definition| definition.register != *register)
        {
            found.push(Definition {
                register: *register,
                value: bound_value(kernel.version.kind(), *value),
                in_uniform: body.constant(*register) == Constant::Uniform,
            });
        }
    }
    found.sort_by_key(|definition| definition.register);
    found
}

/// The comment at the top: what was translated and what is to be bound where.
fn heading(parts: &[&Part<'_>], bindings: &[Binding], options: &Options) -> String {
    let mut text = String::with_capacity(1024);
    for (i, part) in parts.iter().enumerate() {
        let before = if i == 0 { "// " } else { " and " };
        let version = part.stage.program.version;
        _ = write!(text, "{before}{version} {}", Lines::new(part.stage).name());
        let model = part.stage.kernel.model;
        if model != Model::Float {
            _ = write!(text, " with the numbers of {model}");
        }
    }
    text.push_str(", translated by texcrd.\n");
    if !bindings.is_empty() {
        text.push_str("//\n// What binds where:\n");
    }
    for binding in bindings {
        let (group, number, name) = (binding.group, binding.binding, &binding.name);
        _ = write!(text, "//   group {group}, binding {number}: {name}, ");
        _ = match &binding.resource {
            Resource::Uniform { stage, size, .. } => {
                let name = match stage {
                    ShaderKind::Vertex => "vertex",
                    ShaderKind::Pixel => "pixel",
                };
                _ = writeln!(text, "uniform block of the {name} shader, {size} bytes");
                let of_stage = parts.iter().filter(|part| part.kind() == *stage);
                let mut moved = of_stage
                    .flat_map(|part| &part.reflection.definitions)
                    .filter(|definition| definition.in_uniform);
                // Whoever fills the block reads this first.
                moved.try_for_each(
                    |Definition {
                         register, value, ..
                     }| {
                        let [x, y, z, w] = value;
                        writeln!(
                            text,
                            "//     c{register} is {x:?}, {y:?}, {z:?}, {w:?} by its def"
                        )
                    },
                )
            }
            Resource::Texture { stage, dimension } => {
                let about = match dimension {
                    Dimension::D2 => "2D texture",
                    Dimension::D2Array => "cube as six layers +X, -X, +Y, -Y, +Z, -Z",
                    Dimension::Cube => "cube",
                    Dimension::D3 => "volume",
                };
                writeln!(text, "{about} of stage {stage}")
            }
            Resource::Sampler { stage, clamps } => {
                let axes: String = ("uvw".chars().zip(clamps))
                    .filter(|(_, c)| **c)
                    .map(|(a, _)| a)
                    .collect();
                let clamps = if axes.is_empty() { "" } else { ", clamps " };
                writeln!(text, "sampler of stage {stage}{clamps}{axes}")
            }
        };
    }
    if options.points != Points::None && parts.iter().any(|part| part.kind() == ShaderKind::Vertex)
    {
        text.push_str(
            "// Points: vertex buffers step per instance, a triangle strip of 4 vertices each.\n",
        );
    }
    text
}

/// The variables that are bound.
fn declarations(bindings: &[Binding]) -> Option<String> {
    let mut lines = String::new();
    for b in bindings {
        let (space, of) = match &b.resource {
            Resource::Uniform { stage, .. } => (
                "<uniform>",
                match stage {
                    ShaderKind::Vertex => "VertexUniforms",
                    ShaderKind::Pixel => "PixelUniforms",
                },
            ),
            Resource::Texture { dimension, .. } => ("", dimension.wgsl()),
            Resource::Sampler { .. } => ("", "sampler"),
        };
        let (group, binding, name) = (b.group, b.binding, &b.name);
        _ = writeln!(
            lines,
            "@group({group}) @binding({binding}) var{space} {name}: {of};"
        );
    }
    (!lines.is_empty()).then_some(lines)
}
