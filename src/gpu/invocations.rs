//! A pixel shader alone, with inputs that are given, and its result as 32-bit floats.

use super::buffers::filled;
use super::picture::{Picture, depth_format};
use super::pipeline::Pipelines;
use super::state::fixed_state;
use super::{Device, GpuError, Uniforms, VertexLayout};
use crate::raster::{CullMode, RenderState, Topology};
use crate::wgsl::{Reflection, Resource, StageReflection, Translation};

/// Inputs of one invocation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelInput {
    /// `t0` to `t7`.
    pub texcoords: [[f32; 4]; 8],
    /// `v0` and `v1`. They are taken into 0 to 1.
    pub colors: [[f32; 4]; 2],
}

/// The width of the picture that the results are drawn into.
const WIDTH: u32 = 256;
/// The most invocations of one call.
const MOST: usize = 1 << 20;
/// What results are drawn over, one after the other: a pixel that shows both was not written.
const CLEARS: [f64; 2] = [0.25, 0.75];

/// Runs a pixel shader once for each input. The result is `r0`, not clamped; none where the pixel was discarded.
///
/// The shader must have been translated alone, and must not sample: derivatives are 0, and no texture is bound. Every
/// pixel is a primitive of its own with w = 1, so that its inputs reach the shader as they are.
///
/// # Errors
/// [`GpuError::Limit`] on a device that cannot draw into 32-bit floats, and for more than 2²⁰ inputs;
/// [`GpuError::Unsupported`] for a translation with a vertex shader or with textures; and what the device reports.
pub fn shade_pixels(
    device: &Device,
    translation: &Translation,
    uniforms: &Uniforms<'_>,
    inputs: &[PixelInput],
) -> Result<Vec<Option<[f32; 4]>>, GpuError> {
    if !device.adapter().float_targets || inputs.len() > MOST {
        let what = format!("{} results as 32-bit floats", inputs.len());
        let limit = match device.adapter().float_targets {
            true => format!("at most {MOST}"),
            false => "it cannot draw into 32-bit floats".into(),
        };
        return Err(GpuError::Limit { what, limit });
    }
    let reflection = &translation.reflection;
    let is_uniform = |resource: &Resource| matches!(resource, Resource::Uniform { .. });
    let bound = &reflection.bindings;
    if reflection.vertex.is_some() || !bound.iter().all(|b| is_uniform(&b.resource)) {
        return Err(GpuError::Unsupported {
            draw: "invocations".into(),
            state: "a vertex shader or a texture".into(),
        });
    }
    if inputs.is_empty() {
        return Ok(Vec::new());
    }
    let count = inputs.len() as u32;
    let size = [WIDTH, count.div_ceil(WIDTH)];
    let linked = with_vertex_stage(translation, size);
    let depth = depth_format(device, false);
    let mut state = RenderState {
        cull: CullMode::None,
        ..RenderState::default()
    };
    state.depth.enable = false;
    let fixed = fixed_state(&state, Topology::PointList, depth, false).map_err(|state| {
        GpuError::Unsupported {
            draw: "invocations".into(),
            state,
        }
    })?;
    let format = wgpu::TextureFormat::Rgba32Float;
    let layout = VertexLayout::instances(&locations(reflection));
    let mut pipelines = Pipelines::default();
    let pipeline = pipelines.get(device, &linked, layout, fixed, format)?;
    let buffers: Vec<_> = (bound.iter())
        .map(|binding| {
            let block = uniforms.block(&binding.resource);
            (
                binding.binding,
                filled(device, &block, wgpu::BufferUsages::UNIFORM),
            )
        })
        .collect();
    let entries: Vec<_> = (buffers.iter())
        .map(|(binding, buffer)| wgpu::BindGroupEntry {
            binding: *binding,
            resource: buffer.as_entire_binding(),
        })
        .collect();
    let group = |number: usize, entries: &[wgpu::BindGroupEntry<'_>]| {
        device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.groups[number],
            entries,
        })
    };
    let groups = [group(0, &entries), group(1, &[])];
    let vertices = filled(
        device,
        &instances(reflection, inputs),
        wgpu::BufferUsages::VERTEX,
    );
    let picture = Picture::new(device, size, format, depth);
    let mut pictures = Vec::with_capacity(CLEARS.len());
    for clear in CLEARS {
        let mut encoder = device.device.create_command_encoder(&Default::default());
        let mut commands = picture.begin(&mut encoder, [clear; 4]);
        commands.set_pipeline(&pipeline.pipeline);
        for (number, group) in (0..).zip(&groups) {
            commands.set_bind_group(number, group, &[]);
        }
        commands.set_vertex_buffer(0, vertices.slice(..));
        commands.draw(0..4, 0..count);
        drop(commands);
        pictures.push(floats(&picture.read(device, encoder)?));
    }
    let results = pictures[0].iter().zip(&pictures[1]);
    let written = results.map(|(first, second)| {
        let bare = [(first, CLEARS[0]), (second, CLEARS[1])];
        let unwritten = bare
            .iter()
            .all(|(texel, clear)| **texel == [*clear as f32; 4]);
        (!unwritten).then_some(*first)
    });
    Ok(written.take(inputs.len()).collect())
}

fn floats(bytes: &[u8]) -> Vec<[f32; 4]> {
    let number = |b: &[u8]| f32::from_le_bytes([b[0], b[1], b[2], b[3]]);
    let texel = |b: &[u8]| std::array::from_fn(|i| number(&b[4 * i..4 * i + 4]));
    bytes.chunks_exact(16).map(texel).collect()
}

/// The locations that instances feed: those of the varyings, and one more so that there is always something.
fn locations(reflection: &Reflection) -> Vec<u32> {
    let mut locations: Vec<u32> = (reflection.varyings.iter())
        .map(|varying| varying.location)
        .collect();
    locations.push(15);
    locations
}

/// The content of the vertex buffer.
fn instances(reflection: &Reflection, inputs: &[PixelInput]) -> Vec<u8> {
    let locations = locations(reflection);
    let value = |input: &PixelInput, location: u32| match location {
        0..=7 => input.texcoords[location as usize],
        8 | 9 => input.colors[location as usize - 8],
        _ => [1.0; 4],
    };
    inputs
        .iter()
        .flat_map(|input| {
            locations
                .iter()
                .map(move |location| value(input, *location))
        })
        .flatten()
        .flat_map(f32::to_le_bytes)
        .collect()
}

/// The translation with a vertex stage that puts each instance into a pixel of its own.
fn with_vertex_stage(translation: &Translation, [width, height]: [u32; 2]) -> Translation {
    const ENTRY: &str = "invocation_main";
    let varyings = &translation.reflection.varyings;
    let (mut taken, mut passed, mut copies) = (String::new(), String::new(), String::new());
    for varying in varyings {
        let (name, location) = (&varying.name, varying.location);
        let (of, swizzle) = match varying.components {
            1 => ("f32".to_owned(), ".x"),
            2 => ("vec2f".to_owned(), ".xy"),
            3 => ("vec3f".to_owned(), ".xyz"),
            _ => ("vec4f".to_owned(), ""),
        };
        let flat = if varying.flat {
            " @interpolate(flat)"
        } else {
            ""
        };
        taken.push_str(&format!("    @location({location}) {name}: vec4f,\n"));
        passed.push_str(&format!("    @location({location}){flat} {name}: {of},\n"));
        copies.push_str(&format!("    out.{name} = in.{name}{swizzle};\n"));
    }
    let source = format!(
        "{}
struct InvocationInput {{
{taken}    @location(15) unused: vec4f,
}}

struct InvocationOutput {{
    @builtin(position) place: vec4f,
{passed}}}

@vertex
fn {ENTRY}(@builtin(vertex_index) corner: u32, @builtin(instance_index) i: u32, in: InvocationInput) -> InvocationOutput {{
    var out: InvocationOutput;
    let pixel = vec2f(f32(i % {width}u + (corner & 1u)), f32(i / {width}u + (corner >> 1u)));
    let at = pixel / vec2f({width}.0, {height}.0);
    out.place = vec4f(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, 0.0, 1.0);
{copies}    return out;
}}
",
        translation.source
    );
    let mut linked = translation.clone();
    linked.source = source;
    linked.reflection.vertex = linked
        .reflection
        .pixel
        .clone()
        .map(|pixel| StageReflection {
            entry: ENTRY.into(),
            ..pixel
        });
    linked
}
