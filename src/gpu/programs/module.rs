//! The module of a batch.

use super::Program;
use super::text::{Renamed, before_return, embedded, items};
use crate::isa::ShaderKind;
use crate::kernel::Slot;
use crate::texture::{Sampler, Texture};
use crate::wgsl::{Dimension, Resource, Translation};
use std::collections::BTreeSet;
use std::fmt::Write;

/// A texture as the module sees it: the same texture may be seen as a cube and as six layers.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) texture: &'a Texture,
    pub(super) sampler: Sampler,
    pub(super) dimension: Dimension,
    pub(super) clamps: [bool; 3],
}

/// The bindings of group 0. Textures follow, with their samplers.
pub(super) const BLOCKS: u32 = 0;
pub(super) const VIEWS: u32 = 1;

/// A batch as text, and what lies where.
pub(super) struct Module<'a> {
    pub(super) source: String,
    /// The uniform blocks of all programs.
    pub(super) blocks: Vec<u8>,
    /// The most registers that a program reads.
    pub(super) inputs: usize,
    /// The vertex buffer: for each pixel the number of its program, that of the result which it shows, and the registers.
    pub(super) pixels: Vec<u8>,
    pub(super) views: Vec<View<'a>>,
    /// What each program leaves behind, in the order of the results.
    pub(super) results: Vec<Vec<Kept>>,
}

/// One vector of the results.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kept {
    /// A register.
    Register(Slot),
    /// 1 where the pixel was not discarded.
    Alive,
}

/// The names of the entry points.
pub(super) const VERTEX_ENTRY: &str = "batch_vertex";
pub(super) const FRAGMENT_ENTRY: &str = "batch_main";

/// The module that draws into a picture of this width, one pixel an invocation and result.
pub(super) fn module<'a>(programs: &[Program<'a>], invocations: usize, width: u32) -> Module<'a> {
    let mut writer = Writer {
        helpers: BTreeSet::new(),
        functions: String::new(),
        members: String::new(),
        calls: String::new(),
        module: Module {
            source: String::new(),
            blocks: Vec::new(),
            inputs: 0,
            pixels: Vec::new(),
            views: Vec::new(),
            results: Vec::new(),
        },
    };
    let read: Vec<_> = programs.iter().map(|p| reads(p.translation)).collect();
    writer.module.inputs = read.iter().map(Vec::len).max().unwrap_or(0);
    for (number, (program, read)) in programs.iter().zip(read).enumerate() {
        writer.program(number, program, &read);
        writer.pixels(number, program, &read, invocations);
    }
    writer.finish(width)
}

struct Writer<'a> {
    helpers: BTreeSet<String>,
    functions: String,
    /// The members of the structure of uniform blocks.
    members: String,
    /// The body of the entry point.
    calls: String,
    module: Module<'a>,
}

impl<'a> Writer<'a> {
    fn program(&mut self, number: usize, program: &Program<'a>, read: &[Read]) {
        let translation = program.translation;
        let renamed = self.bindings(number, program);
        let entry = entry(translation);
        for item in items(&translation.source) {
            if item.starts_with("@group") {
                continue;
            }
            let own = item.starts_with(['s', '@']) || item.starts_with("fn constant_at");
            let mut text = embedded(&item, number, entry, &renamed);
            if !own {
                // The same text in all translations.
                self.helpers.insert(text);
                continue;
            }
            if item.starts_with('@') && program.point_size {
                text = before_return(&text, "point_size = oPts;");
            }
            self.functions.push_str(&text);
            self.functions.push('\n');
        }
        self.call(number, program, read, entry);
    }

    /// Names of what the program has bound.
    fn bindings(&mut self, number: usize, program: &Program<'a>) -> Vec<Renamed<'a>> {
        let mut renamed = Vec::new();
        for binding in &program.translation.reflection.bindings {
            let instead = match &binding.resource {
                block @ Resource::Uniform { stage, .. } => {
                    let of = match stage {
                        ShaderKind::Vertex => "VertexUniforms",
                        ShaderKind::Pixel => "PixelUniforms",
                    };
                    let _ = writeln!(self.members, "    @align(16) p{number}: {of}_{number},");
                    let blocks = &mut self.module.blocks;
                    blocks.resize(blocks.len().next_multiple_of(16), 0);
                    blocks.extend(program.uniforms.block(block));
                    format!("blocks.p{number}")
                }
                Resource::Texture { stage, .. } => match self.view(program, *stage) {
                    Some(view) => format!("view{view}"),
                    None => continue,
                },
                Resource::Sampler { stage, .. } => match self.view(program, *stage) {
                    Some(view) => format!("sampler{view}"),
                    None => continue,
                },
            };
            renamed.push(Renamed {
                name: &binding.name,
                instead,
            });
        }
        renamed
    }

    /// The number of the view that a stage has.
    fn view(&mut self, program: &Program<'a>, number: u8) -> Option<usize> {
        let bindings = &program.translation.reflection.bindings;
        let dimension = bindings.iter().find_map(|binding| match binding.resource {
            Resource::Texture { stage, dimension } if stage == number => Some(dimension),
            _ => None,
        })?;
        let clamps = bindings.iter().find_map(|binding| match binding.resource {
            Resource::Sampler { stage, clamps } if stage == number => Some(clamps),
            _ => None,
        });
        // What is read texel by texel has none.
        let clamps = clamps.unwrap_or_default();
        let (texture, sampler) = program.textures.get(usize::from(number)).copied()??;
        let same = |view: &View<'_>| {
            std::ptr::eq(view.texture, texture)
                && (view.sampler, view.dimension, view.clamps) == (sampler, dimension, clamps)
        };
        let views = &mut self.module.views;
        Some(views.iter().position(same).unwrap_or_else(|| {
            views.push(View {
                texture,
                sampler,
                dimension,
                clamps,
            });
            views.len() - 1
        }))
    }

    /// The function that runs the shader with the inputs of a pixel and gives one of the results.
    fn call(&mut self, number: usize, program: &Program<'a>, read: &[Read], entry: &str) {
        let reflection = &program.translation.reflection;
        let kind = kind(program.translation);
        let mut text = format!("fn run_{number}(pixel: Pixel) -> vec4f {{\n");
        let structure = match kind {
            ShaderKind::Vertex => "VertexInput",
            ShaderKind::Pixel => "Varyings",
        };
        if !read.is_empty() {
            let _ = writeln!(text, "    var in: {structure}_{number};");
        }
        for (at, input) in read.iter().enumerate() {
            let swizzle = &"xyzw"[..input.components];
            let _ = writeln!(text, "    in.{} = pixel.i{at}.{swizzle};", input.name);
        }
        let argument = if read.is_empty() { "" } else { "in" };
        let _ = writeln!(text, "    let out = {entry}_{number}({argument});");
        let mut kept = Vec::new();
        let mut keep = |what: Kept, value: &str| {
            let _ = match kept.len() {
                0 => writeln!(text, "    var result = {value};"),
                n => writeln!(
                    text,
                    "    result = select(result, {value}, pixel.result == {n}u);"
                ),
            };
            kept.push(what);
        };
        match kind {
            ShaderKind::Pixel => {
                let pixel = reflection.pixel.as_ref();
                if pixel.is_some_and(|pixel| pixel.writes_depth) {
                    keep(Kept::Register(Slot::R0), "out.color");
                    keep(Kept::Register(Slot::DEPTH), "vec4f(out.depth)");
                } else {
                    keep(Kept::Register(Slot::R0), "out");
                }
                if pixel.is_some_and(|pixel| pixel.discards) {
                    keep(Kept::Alive, "vec4f(1.0)");
                }
            }
            ShaderKind::Vertex => {
                keep(Kept::Register(Slot::POSITION), "out.position");
                for varying in &reflection.varyings {
                    let Some(slot) = slot_of(varying.location, kind) else {
                        continue;
                    };
                    let value = match varying.components {
                        1 => format!("vec4f(out.{})", varying.name),
                        _ => format!("out.{}", varying.name),
                    };
                    keep(Kept::Register(slot), &value);
                }
                if program.point_size {
                    keep(Kept::Register(Slot::POINT_SIZE), "vec4f(point_size)");
                }
            }
        }
        text.push_str("    return result;\n}\n\n");
        self.functions.push_str(&text);
        let _ = writeln!(
            self.calls,
            "    if pixel.program == {number}u {{\n        color = run_{number}(pixel);\n    }}"
        );
        self.module.results.push(kept);
    }

    /// The pixels of a program: invocation after invocation, for each result.
    fn pixels(&mut self, number: usize, program: &Program<'a>, read: &[Read], invocations: usize) {
        let kept = self.module.results.last().map_or(0, Vec::len);
        let pixels = &mut self.module.pixels;
        for result in 0..kept {
            for invocation in 0..invocations {
                pixels.extend((number as u32).to_le_bytes());
                pixels.extend((result as u32).to_le_bytes());
                for at in 0..self.module.inputs {
                    let slot = read.get(at).and_then(|input| input.slot);
                    let values = program
                        .inputs
                        .iter()
                        .find(|(input, _)| Some(*input) == slot);
                    let value = values.and_then(|(_, values)| values.get(invocation));
                    let value = value.copied().unwrap_or_default();
                    pixels.extend(value.into_iter().flat_map(f32::to_le_bytes));
                }
            }
        }
    }

    fn finish(mut self, width: u32) -> Module<'a> {
        let mut source = String::new();
        if !self.members.is_empty() {
            let _ = write!(
                source,
                "struct Blocks {{\n{}}}\n@group(0) @binding({BLOCKS}) var<uniform> blocks: Blocks;\n",
                self.members
            );
        }
        for (number, view) in self.module.views.iter().enumerate() {
            let binding = VIEWS + 2 * number as u32;
            let _ = write!(
                source,
                "@group(0) @binding({binding}) var view{number}: {};\n\
                 @group(0) @binding({}) var sampler{number}: sampler;\n",
                view.dimension.wgsl(),
                binding + 1,
            );
        }
        source.push_str("var<private> point_size: f32;\n\n");
        let (mut taken, mut passed, mut copies) = (String::new(), String::new(), String::new());
        for i in 0..self.module.inputs {
            let location = FIRST_INPUT as usize + i;
            let _ = writeln!(taken, "    @location({location}) i{i}: vec4f,");
            let _ = writeln!(
                passed,
                "    @location({location}) @interpolate(flat) i{i}: vec4f,"
            );
            let _ = writeln!(copies, "    out.i{i} = in.i{i};");
        }
        let _ = write!(
            source,
            "struct Given {{
    @location(0) program: u32,
    @location(1) result: u32,
{taken}}}

struct Pixel {{
    @builtin(position) place: vec4f,
    @location(0) @interpolate(flat) program: u32,
    @location(1) @interpolate(flat) result: u32,
{passed}}}

// Every instance is a pixel of its own.
@vertex
fn {VERTEX_ENTRY}(@builtin(vertex_index) corner: u32, @builtin(instance_index) i: u32, in: Given) -> Pixel {{
    var out: Pixel;
    let pixel = vec2f(f32(i % {width}u + (corner & 1u)), f32(i / {width}u + (corner >> 1u)));
    let at = pixel / vec2f({width}.0, {}.0);
    out.place = vec4f(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, 0.0, 1.0);
    out.program = in.program;
    out.result = in.result;
{copies}    return out;
}}

",
            self.module.height(width),
        );
        for helper in &self.helpers {
            source.push_str(helper);
            source.push('\n');
        }
        source.push_str(&self.functions);
        let _ = write!(
            source,
            "@fragment\nfn {FRAGMENT_ENTRY}(pixel: Pixel) -> @location(0) vec4f {{\n    \
                 var color: vec4f;\n{}    return color;\n}}\n",
            self.calls
        );
        self.module.source = source;
        self.module
    }
}

/// The location of the first register among the attributes of a pixel.
pub(super) const FIRST_INPUT: u32 = 2;

impl Module<'_> {
    /// Bytes of the vertex buffer a pixel.
    pub(super) fn stride(&self) -> usize {
        8 + 16 * self.inputs
    }

    pub(super) fn pixel_count(&self) -> u32 {
        (self.pixels.len() / self.stride()) as u32
    }

    /// The height of the picture of this width.
    pub(super) fn height(&self, width: u32) -> u32 {
        self.pixel_count().div_ceil(width).max(1)
    }
}

/// A member of the structure that a function takes.
struct Read {
    name: String,
    slot: Option<Slot>,
    components: usize,
}

/// What the function of a translation takes.
fn reads(translation: &Translation) -> Vec<Read> {
    let reflection = &translation.reflection;
    let kind = kind(translation);
    match kind {
        ShaderKind::Vertex => (reflection.inputs.iter())
            .map(|input| Read {
                name: format!("v{}", input.register),
                slot: Slot::input(input.register as usize),
                components: 4,
            })
            .collect(),
        ShaderKind::Pixel => (reflection.varyings.iter())
            .map(|varying| Read {
                name: varying.name.clone(),
                slot: slot_of(varying.location, kind),
                components: varying.components,
            })
            .collect(),
    }
}

fn kind(translation: &Translation) -> ShaderKind {
    match translation.reflection.vertex {
        Some(_) => ShaderKind::Vertex,
        None => ShaderKind::Pixel,
    }
}

fn entry(translation: &Translation) -> &str {
    let reflection = &translation.reflection;
    let stage = reflection.vertex.as_ref().or(reflection.pixel.as_ref());
    stage.map_or("", |stage| &stage.entry)
}

/// The register that a varying is to the stage of this kind.
fn slot_of(location: u32, kind: ShaderKind) -> Option<Slot> {
    let location = location as usize;
    match (kind, location) {
        (ShaderKind::Pixel, 0..8) => Slot::texcoord(location),
        (ShaderKind::Pixel, 8..10) => Slot::input(location - 8),
        (ShaderKind::Vertex, 0..8) => Slot::texcoord_output(location),
        (ShaderKind::Vertex, 8..10) => Slot::color_output(location - 8),
        (ShaderKind::Vertex, 10) => Some(Slot::FOG),
        _ => None,
    }
}
