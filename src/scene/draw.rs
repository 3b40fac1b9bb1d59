//! `[[draw]]`.

use std::collections::BTreeMap;

use glam::Mat4;

use super::constants::{Constant, constants};
use super::error::{Problems, advice, rules};
use super::files::Files;
use super::section::{At, Section};
use super::shader::{self, Shader};
use super::state::{States, bump, sampler, state};
use super::transform::transform;
use crate::exec::STAGES;
use crate::isa::register::VERTEX_CONSTANTS;
use crate::isa::{RegisterFile, Version};
use crate::kernel::{Options, Projection, Slot};
use crate::mesh::Attribute;
use crate::program::{Program, Usage};
use crate::raster::{FogDistance, RenderState, Topology};
use crate::semantics::BumpState;
use crate::texture::{Filter, Sampler, Weights};

/// Which attribute of the mesh feeds each input register `v0` to `v15`; one that nothing feeds reads (0, 0, 0, 1).
pub type Declaration = [Option<Attribute>; 16];

/// The declaration of the article that `asm/stained_glass` comes from: what feeds the registers when nothing else is said.
pub(super) const DEFAULT_DECLARATION: [(usize, Attribute); 6] = [
    (0, Attribute::Position),
    (3, Attribute::Normal),
    (5, Attribute::Color),
    (7, Attribute::Texcoord),
    (8, Attribute::Tangent),
    (9, Attribute::Bitangent),
];

/// The names of a scene and the numbers behind them.
pub(super) type Names = BTreeMap<String, usize>;

/// What a draw may refer to.
pub(super) struct Known<'a> {
    pub(super) meshes: &'a Names,
    pub(super) textures: &'a Names,
    pub(super) targets: &'a Names,
}

/// One draw call, before it is known into what it draws.
#[derive(Clone, Debug)]
pub(super) struct Draw {
    pub(super) name: String,
    pub(super) mesh: usize,
    pub(super) topology: Topology,
    /// Which vertices of the mesh, in which order, if the draw says so itself.
    pub(super) indices: Option<At<Vec<u32>>>,
    pub(super) world: Mat4,
    pub(super) declaration: Declaration,
    pub(super) vertex: Shader,
    pub(super) pixel: Shader,
    pub(super) vertex_constants: Vec<Constant>,
    pub(super) pixel_constants: Vec<Constant>,
    pub(super) stages: [Stage; STAGES],
    pub(super) state: RenderState,
    /// The distance of table fog, if the projection does not decide it.
    pub(super) fog_distance: Option<FogDistance>,
}

/// One texture stage of a draw.
#[derive(Clone, Debug, Default)]
pub(super) struct Stage {
    pub(super) texture: Option<usize>,
    pub(super) sampler: Sampler,
    pub(super) bump: BumpState,
    projected: bool,
}

/// Finds a name, or reports it.
pub(super) fn find(
    names: &Names,
    what: &str,
    name: &At<String>,
    problems: &mut Problems,
) -> Option<usize> {
    let found = names.get(&name.value).copied();
    if found.is_none() && !problems.full() {
        let message = format!("there is no {what} `{}`", name.value);
        let help = advice(&name.value, names.keys().map(String::as_str));
        problems.error_with(&rules::NAME, name.span, message, help);
    }
    found
}

/// Reads a draw. Its name has been taken out already.
pub(super) fn read(
    name: String,
    mut section: Section<'_>,
    known: &Known<'_>,
    files: &mut Files<'_>,
    problems: &mut Problems,
) -> Option<Draw> {
    let s = &mut section;
    if !s.has("mesh") {
        s.missing("a `mesh`", problems);
    }
    let mesh = s
        .at::<String>("mesh", problems)
        .and_then(|name| find(known.meshes, "mesh", &name, problems));
    let topology = s.named("topology", Topology::TriangleList, problems);
    let indices = s.at::<Vec<u32>>("indices", problems);
    if let Some(At { span, .. }) = indices.as_ref().filter(|_| topology == Topology::PointList) {
        let message = "points are drawn without `indices`, as Direct3D 8 draws them";
        problems.error(&rules::VALUE, *span, message);
    }
    let world = s.node("world").and_then(|node| transform(node, problems));
    let vertex = shader::read(s, &shader::VERTEX, files, problems);
    let pixel = shader::read(s, &shader::PIXEL, files, problems);
    let declared = s
        .table("declaration", problems)
        .map(|table| declaration(table, problems));
    let vertex_constants = s.table("vs_constants", problems);
    let vertex_constants = vertex_constants.map_or_else(Vec::new, |table| {
        constants(table, VERTEX_CONSTANTS, problems)
    });
    let pixel_constants = s.table("ps_constants", problems);
    let pixel_constants = pixel_constants.map_or_else(Vec::new, |table| {
        constants(table, RegisterFile::Const.count(Version::Ps14), problems)
    });
    let (stages, read_stages) = s
        .table("stages", problems)
        .map(|table| stages(table, known, files.weights(), problems))
        .unwrap_or_default();
    let States {
        state,
        fog_distance,
    } = s
        .table("state", problems)
        .map(|table| state(table, problems))
        .unwrap_or_default();
    let span = s.span;
    section.finish(problems);

    let options = Options {
        projection: std::array::from_fn(|i| match stages.get(i) {
            // Coordinates that come from a vertex shader are divided by the fourth component whatever the count says.
            Some(stage) if stage.projected => Projection::Fourth,
            _ => Projection::None,
        }),
        ..files.lowering()
    };
    let (vertex, pixel) = (vertex?, pixel?);
    let declaration = declared.unwrap_or_else(|| default_declaration(&vertex.value));
    let lowered_vertex = shader::lowered(&vertex, &files.lowering(), problems);
    let lowered_pixel = shader::lowered(&pixel, &options, problems);
    let (vertex_shader, pixel_shader) = (lowered_vertex?, lowered_pixel?);
    for (register, attribute) in declaration.iter().enumerate() {
        let read = Slot::input(register).is_some_and(|v| !vertex_shader.kernel.read(v).is_empty());
        if attribute.is_none() && read {
            let message =
                format!("the vertex shader reads v{register}, which nothing feeds: (0, 0, 0, 1)");
            problems.warning(&rules::UNFED, vertex.span, message);
        }
    }
    let sampled = pixel_shader.kernel.stages();
    for (number, stage) in stages.iter().enumerate() {
        // A name that is wrong has been reported.
        let empty = stage.texture.is_none() && !read_stages[number];
        if empty && sampled >> number & 1 == 1 {
            let message = format!(
                "the pixel shader samples stage {number}, which has no texture: opaque black"
            );
            problems.warning(&rules::UNBOUND, span, message);
        }
    }
    Some(Draw {
        name,
        mesh: mesh?,
        topology,
        indices,
        world: world.unwrap_or(Mat4::IDENTITY),
        declaration,
        vertex: vertex_shader,
        pixel: pixel_shader,
        vertex_constants,
        pixel_constants,
        stages,
        state,
        fog_distance,
    })
}

/// The number of a key made of a prefix, in any case, and a number below `count`, such as `v3`.
pub(crate) fn numbered(key: &str, prefix: &str, count: usize) -> Option<usize> {
    let (first, digits) = key.split_at_checked(prefix.len())?;
    if !first.eq_ignore_ascii_case(prefix) {
        return None;
    }
    let plain = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    plain
        .then(|| digits.parse().ok())
        .flatten()
        .filter(|number| *number < count)
}

fn declaration(mut section: Section<'_>, problems: &mut Problems) -> Declaration {
    let mut declaration: Declaration = [None; 16];
    for node in section.rest() {
        let Some(register) = numbered(&node.key, "v", declaration.len()) else {
            let message = format!("{} has no register `{}`", section.title, node.key);
            let help = Some("there are `v0` to `v15`".to_owned());
            problems.error_with(&rules::KEY, node.key_span, message, help);
            continue;
        };
        let Some(name) = node.read::<String>(problems) else {
            continue;
        };
        match name.value.parse::<Attribute>() {
            Ok(attribute) => declaration[register] = Some(attribute),
            Err(error) => {
                let help = advice(&name.value, Attribute::ALL.iter().map(|(_, name)| *name));
                problems.error_with(&rules::NAME, name.span, error.to_string(), help);
            }
        }
    }
    declaration
}

/// What a listing declares itself in the later dialect (`dcl_position v0`), or else that of the article.
fn default_declaration(program: &Program) -> Declaration {
    let mut declaration: Declaration = [None; 16];
    let mut any = false;
    for dcl in program.declarations() {
        any = true;
        let attribute = match (dcl.usage, dcl.usage_index) {
            (Usage::Position, 0) => Some(Attribute::Position),
            (Usage::Normal, 0) => Some(Attribute::Normal),
            (Usage::Tangent, 0) => Some(Attribute::Tangent),
            (Usage::Binormal, 0) => Some(Attribute::Bitangent),
            (Usage::TexCoord, set) => Attribute::TEXCOORDS.get(set as usize).copied(),
            (Usage::Color, 0) => Some(Attribute::Color),
            (Usage::Color, 1) => Some(Attribute::Specular),
            _ => None,
        };
        if let Some(place) = declaration.get_mut(dcl.register.index as usize) {
            *place = attribute;
        }
    }
    if !any {
        for (register, attribute) in DEFAULT_DECLARATION {
            declaration[register] = Some(attribute);
        }
    }
    declaration
}

/// The stages, and for each whether the file speaks of its texture.
fn stages(
    mut section: Section<'_>,
    known: &Known<'_>,
    weights: Weights,
    problems: &mut Problems,
) -> ([Stage; STAGES], [bool; STAGES]) {
    let mut stages: [Stage; STAGES] = Default::default();
    let mut named = [false; STAGES];
    for node in section.rest() {
        let Some(number) = numbered(&node.key, "", STAGES) else {
            let message = format!("{} has no stage `{}`", section.title, node.key);
            let help = Some(format!("there are `0` to `{}`", STAGES - 1));
            problems.error_with(&rules::KEY, node.key_span, message, help);
            continue;
        };
        let title = section.inner_title(&node.key);
        let place = node.key_span;
        let Some(mut table) = node.into_section(title, problems) else {
            continue;
        };
        let anisotropy_given = table.has("max_anisotropy");
        named[number] = table.has("texture");
        let texture = table.at::<String>("texture", problems);
        stages[number] = Stage {
            texture: texture.and_then(|name| texture_number(&name, known, problems)),
            sampler: sampler(&mut table, weights, problems),
            bump: bump(&mut table, problems),
            projected: table.or("projected", false, problems),
        };
        if stages[number].sampler.min == Filter::Anisotropic && !anisotropy_given {
            let message = format!(
                "stage {number} is filtered as linear: `max_anisotropy` is 1, as in Direct3D 8, until it is set"
            );
            problems.warning(&rules::IDLE, place, message);
        }
        table.finish(problems);
    }
    (stages, named)
}

fn texture_number(name: &At<String>, known: &Known<'_>, problems: &mut Problems) -> Option<usize> {
    let is_target = known.targets.contains_key(&name.value);
    if is_target && !known.textures.contains_key(&name.value) {
        let name_text = &name.value;
        let message = format!("`{name_text}` is a render target, not a texture");
        let help = format!(
            "a texture shows what it holds: [textures.{name_text}] with target = \"{name_text}\""
        );
        problems.error_with(&rules::NAME, name.span, message, Some(help));
        return None;
    }
    find(known.textures, "texture", name, problems)
}
