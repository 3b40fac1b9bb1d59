//! From the bytes of a case to a [`Case`].

use toml::de::DeValue;

use super::computing::computing;
use super::registers::{constants, expectation, register};
use super::texture::bound;
use super::{Expectation, Invocation, Quantity, Stage, json};
use crate::diagnostic::Span;
use crate::exec::STAGES;
use crate::isa::register::VERTEX_CONSTANTS;
use crate::isa::{RegisterFile, Version};
use crate::kernel::{Options, Projection};
use crate::raster::{RenderState, Surface, Vertex};
use crate::scene::draw::numbered;
use crate::scene::error::{Problems, rules};
use crate::scene::files::Files;
use crate::scene::include::{parse, utf8};
use crate::scene::load::load;
use crate::scene::section::{At, Section};
use crate::scene::shader::{self, Keys, Named, lowered};
use crate::scene::state::{bump, sampler, state, surface};
use crate::scene::{LoadOptions, Resolver, Shader};

/// The largest absolute difference that passes where a case says nothing else.
pub const DEFAULT_TOLERANCE: f64 = 1e-6;

/// Most invocations of a case.
pub const MAX_INVOCATIONS: usize = 4096;

/// `vs` or `vs_file`.
const VERTEX: Keys = Keys {
    text: "vs",
    file: "vs_file",
    ..shader::VERTEX
};

/// `ps` or `ps_file`.
const PIXEL: Keys = Keys {
    text: "ps",
    file: "ps_file",
    ..shader::PIXEL
};

/// What an input holds of which nothing is said, and what fills up one of fewer than four numbers.
const INPUT: [f32; 4] = [0.0, 0.0, 0.0, 1.0];

impl super::Case {
    /// Reads a case and the files that it names. What begins with a brace, or is called `….json`, is JSON, anything
    /// else TOML.
    ///
    /// `name` is what messages call the file; `resolver` gives the files whose paths it writes.
    ///
    /// # Errors
    /// [`CaseError`](super::CaseError) with every problem that was found, in the case and in its listings.
    pub fn load(
        name: &str,
        bytes: &[u8],
        resolver: &dyn Resolver,
        options: &LoadOptions,
    ) -> Result<Self, Box<super::CaseError>> {
        let loaded = load(name, bytes, resolver, options, |files, problems| {
            let text = utf8(bytes, 0, problems)?;
            let is_json = text.trim_start().starts_with('{')
                || name
                    .rsplit('.')
                    .next()
                    .is_some_and(|e| e.eq_ignore_ascii_case("json"));
            if let Some(range) = listing_line(text) {
                let message = "this looks like a listing, not a case; a case names it with `vs_file` or `ps_file`, or has its text under `vs` or `ps`";
                problems.error(&rules::SYNTAX, problems.span(range), message);
                return None;
            }
            let table = if is_json {
                json::parse(text, problems)?
            } else {
                parse(bytes, 0, problems)?
            };
            let root = Section::outermost(name, table, problems);
            case(root, files, problems)
        })?;
        let mut case = loaded.value;
        for (invocation, span) in case.invocations.iter_mut().zip(case.places) {
            invocation.line = loaded.sources.locate(span).map_or(1, |at| at.line);
        }
        Ok(Self {
            name: case.name.unwrap_or_else(|| name.to_owned()),
            vertex: case.vertex,
            pixel: case.pixel,
            stages: case.stages,
            state: case.state,
            target: case.target,
            invocations: case.invocations,
            sources: loaded.sources,
            warnings: loaded.warnings,
        })
    }
}

/// The version with which a text begins that is a listing; comments may stand before it.
fn listing_line(text: &str) -> Option<std::ops::Range<usize>> {
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let word = line.trim();
        let comment = word.starts_with(';') || word.starts_with("//") || word.starts_with('#');
        if !word.is_empty() && !comment {
            let mut letters = word.bytes().map(|letter| letter.to_ascii_lowercase());
            let version = matches!(letters.next(), Some(b'v' | b'p'))
                && letters.next() == Some(b's')
                && matches!(letters.next(), Some(b'.' | b'_'))
                && letters.next().is_some_and(|letter| letter.is_ascii_digit());
            let first = start + line.len() - line.trim_start().len();
            return (version && !word.contains('=')).then_some(first..first + word.len());
        }
        start += line.len();
    }
    None
}

/// A case before the lines of its invocations are known.
struct Draft {
    name: Option<String>,
    vertex: Option<Shader>,
    pixel: Option<Shader>,
    stages: [Stage; STAGES],
    state: RenderState,
    target: Surface,
    invocations: Vec<Invocation>,
    places: Vec<Span>,
}

fn case(mut root: Section<'_>, files: &mut Files<'_>, problems: &mut Problems) -> Option<Draft> {
    let s = &mut root;
    let name: Option<String> = s.get("name", problems);
    remarks(s);
    computing(s, files, problems);
    let vertex = listing(s, &VERTEX, files, problems);
    let pixel = listing(s, &PIXEL, files, problems);
    // A listing that is refused is there all the same, for what else the case says.
    let given = |shader: &Given| !matches!(shader, Given::No);
    if !given(&vertex) && !given(&pixel) {
        s.missing("a shader: `vs`, `ps`, `vs_file` or `ps_file`", problems);
    }
    let mut stages: [Stage; STAGES] = Default::default();
    by_stage(s, "textures", problems, |stage, section, problems| {
        stages[stage].texture = bound(section, files, problems);
    });
    let weights = files.weights();
    by_stage(s, "samplers", problems, |stage, mut section, problems| {
        stages[stage].sampler = sampler(&mut section, weights, problems);
        section.finish(problems);
    });
    let mut projection = [Projection::None; STAGES];
    by_stage(s, "stages", problems, |stage, mut section, problems| {
        stages[stage].bump = bump(&mut section, problems);
        let projected = section.or("projected", false, problems);
        let count = section.ranged("count", 0..=4, 0, problems);
        section.finish(problems);
        if projected {
            projection[stage] = divisor(count, given(&vertex));
        }
    });
    let state = s
        .table("state", problems)
        .map(|table| state(table, problems).state)
        .unwrap_or_default();
    let target = surface(s, [0.0; 4], problems);

    let scope = Scope {
        has_vertex_shader: given(&vertex),
        quantities: Quantity::all(vertex.version(), pixel.version()),
        // Of a listing that is refused the version may not be known.
        known: vertex.is_known() && pixel.is_known(),
        has_depth: given(&vertex),
    };
    let base = Parts::read(s, &scope, problems);
    let mut invocations = Vec::new();
    let mut places = Vec::new();
    match s.node("invocation") {
        None => {
            places.push(s.span);
            invocations.extend(base.clone().invocation(None, s, &scope, problems));
        }
        Some(node) => {
            let list = node.into_tables("a list of tables, `[[invocation]]`", problems);
            for (node, number) in list.into_iter().zip(1..) {
                if number > MAX_INVOCATIONS {
                    let message = format!("a case has up to {MAX_INVOCATIONS} invocations");
                    problems.error(&rules::LIMIT, node.key_span, message);
                    break;
                }
                let Some(mut table) = node.into_section(format!("invocation {number}"), problems)
                else {
                    continue;
                };
                let name = table.get("name", problems);
                remarks(&mut table);
                let parts = Parts::read(&mut table, &scope, problems).over(&base);
                places.push(table.span);
                invocations.extend(parts.invocation(name, &table, &scope, problems));
                table.finish(problems);
            }
        }
    }
    root.finish(problems);
    let options = Options {
        projection,
        ..files.lowering()
    };
    let vertex = vertex.lowered(&files.lowering(), problems)?;
    let pixel = pixel.lowered(&options, problems)?;
    no_depth(&invocations, &scope, pixel.as_ref(), &places, problems);
    Some(Draft {
        name,
        vertex,
        pixel,
        stages,
        state,
        target,
        invocations,
        places,
    })
}

/// Takes out what a case says to those who read it.
fn remarks(s: &mut Section<'_>) {
    for key in ["description", "comment", "note", "source"] {
        s.node(key);
    }
}

/// Whether and how a case gives a kind of shader.
enum Given {
    /// It does not.
    No,
    /// It does, and the listing is refused.
    Refused,
    /// It does.
    Yes(Named),
}

impl Given {
    fn version(&self) -> Option<Version> {
        match self {
            Self::Yes(named) => Some(named.value.version),
            _ => None,
        }
    }

    fn is_known(&self) -> bool {
        !matches!(self, Self::Refused)
    }

    /// The shader, ready to run. The outer `None`: it is refused.
    fn lowered(&self, options: &Options, problems: &mut Problems) -> Option<Option<Shader>> {
        match self {
            Self::No => Some(None),
            Self::Refused => None,
            Self::Yes(named) => lowered(named, options, problems).map(Some),
        }
    }
}

fn listing(
    s: &mut Section<'_>,
    keys: &Keys,
    files: &mut Files<'_>,
    problems: &mut Problems,
) -> Given {
    // An empty text is no shader.
    let empty = |value: &DeValue<'_>| matches!(value, DeValue::String(s) if s.trim().is_empty());
    for key in [keys.text, keys.file] {
        if s.peek(key).is_some_and(empty) {
            s.node(key);
        }
    }
    if !s.has(keys.text) && !s.has(keys.file) {
        // The keys are known, though they are not there.
        s.node(keys.text);
        s.node(keys.file);
        return Given::No;
    }
    match shader::read(s, keys, files, problems) {
        Some(named) => Given::Yes(named),
        None => Given::Refused,
    }
}

/// Reads a table whose keys are the numbers of texture stages.
fn by_stage<'i>(
    s: &mut Section<'i>,
    key: &'static str,
    problems: &mut Problems,
    mut read: impl FnMut(usize, Section<'i>, &mut Problems),
) {
    let Some(mut table) = s.table(key, problems) else {
        return;
    };
    for node in table.rest() {
        let Some(stage) = numbered(&node.key, "", STAGES) else {
            let message = format!("{} has no stage `{}`", table.title, node.key);
            let help = Some(format!("there are `0` to `{}`", STAGES - 1));
            problems.error_with(&rules::KEY, node.key_span, message, help);
            continue;
        };
        let title = table.inner_title(&node.key);
        if let Some(section) = node.into_section(title, problems) {
            read(stage, section, problems);
        }
    }
}

/// What `D3DTTFF_PROJECTED` divides by. Coordinates of a vertex shader always by the fourth component; others as
/// measured on hardware, where `count` is `D3DTTFF_COUNT…` and the coordinates of a case have four components.
fn divisor(count: u32, has_vertex_shader: bool) -> Projection {
    match count {
        _ if has_vertex_shader => Projection::Fourth,
        1 | 2 => Projection::None,
        3 => Projection::Third,
        _ => Projection::Fourth,
    }
}

/// Refuses to expect a depth where there is none: without a vertex shader nothing has a position.
fn no_depth(
    invocations: &[Invocation],
    scope: &Scope,
    pixel: Option<&Shader>,
    places: &[Span],
    problems: &mut Problems,
) {
    if scope.has_depth || pixel.is_none_or(|pixel| pixel.kernel.writes_depth()) {
        return;
    }
    for (invocation, span) in invocations.iter().zip(places) {
        let mut values = invocation.expect.values.iter();
        if values.any(|value| value.quantity == Quantity::Depth) {
            let message = "nothing gives a `depth`: there is no vertex shader, and the pixel shader writes none";
            problems.error(&rules::VALUE, *span, message);
        }
    }
}

/// What the shaders of a case make of its keys.
pub(super) struct Scope {
    has_vertex_shader: bool,
    has_depth: bool,
    pub(super) quantities: Vec<Quantity>,
    /// Whether `quantities` is complete.
    pub(super) known: bool,
}

/// What both a case and its invocations may say.
#[derive(Clone, Default)]
struct Parts {
    vertex_inputs: Vec<(usize, [f32; 4])>,
    colors: Vec<(usize, [f32; 4])>,
    texcoords: Vec<(usize, [f32; 4])>,
    vertex_constants: Vec<(u32, [f32; 4])>,
    pixel_constants: Vec<(u32, [f32; 4])>,
    tolerance: Option<f64>,
    expect: Expectation,
    /// Whether there is something under `expect`, be it wrong.
    tried: bool,
    accept: Option<Vec<Expectation>>,
}

impl Parts {
    fn read(s: &mut Section<'_>, scope: &Scope, problems: &mut Problems) -> Self {
        let mut parts = Self::default();
        if let Some(table) = s.table("inputs", problems) {
            parts.inputs(table, scope, problems);
        }
        parts.vertex_constants = constants(s, "vs_constants", VERTEX_CONSTANTS, problems);
        let count = RegisterFile::Const.count(Version::Ps14);
        parts.pixel_constants = constants(s, "ps_constants", count, problems);
        if let Some(At { value, span }) = s.at::<f64>("tol", problems) {
            if value >= 0.0 && value.is_finite() {
                parts.tolerance = Some(value);
            } else {
                let message = format!("`tol` is {value}; a tolerance is 0 or more, and finite");
                problems.error(&rules::VALUE, span, message);
            }
        }
        parts.tried = s
            .peek("expect")
            .is_some_and(|value| !matches!(value, DeValue::Table(table) if table.is_empty()));
        if let Some(table) = s.table("expect", problems) {
            parts.expect = expectation(table, scope, problems);
        }
        if let Some(node) = s.node("accept") {
            let list = node.into_tables("a list of tables like `expect`", problems);
            let tables = list.into_iter().zip(1..).filter_map(|(node, number)| {
                let table = node.into_section(format!("result {number} of `accept`"), problems)?;
                Some(expectation(table, scope, problems))
            });
            parts.accept = Some(tables.collect());
        }
        parts
    }

    fn inputs(&mut self, mut table: Section<'_>, scope: &Scope, problems: &mut Problems) {
        for node in table.rest() {
            let (key, key_span) = (node.key.clone(), node.key_span);
            let v = numbered(&key, "v", if scope.has_vertex_shader { 16 } else { 2 });
            let t = numbered(&key, "t", if scope.has_vertex_shader { 0 } else { 6 });
            let list = match (v, t) {
                (Some(_), _) if scope.has_vertex_shader => &mut self.vertex_inputs,
                (Some(_), _) => &mut self.colors,
                (_, Some(_)) => &mut self.texcoords,
                _ => {
                    let message = format!("{} has no register `{key}`", table.title);
                    let help = if scope.has_vertex_shader {
                        "with a vertex shader there are `v0` to `v15`, its inputs"
                    } else {
                        "without a vertex shader there are `v0`, `v1` and `t0` to `t5`"
                    };
                    problems.error_with(&rules::KEY, key_span, message, Some(help.to_owned()));
                    continue;
                }
            };
            if let (Some(value), Some(number)) = (register(node, INPUT, problems), v.or(t)) {
                list.push((number, value));
            }
        }
    }

    /// These parts laid over those of the case.
    fn over(self, base: &Self) -> Self {
        fn joined<T: Clone>(base: &[T], own: Vec<T>) -> Vec<T> {
            // Later entries of a register replace earlier ones.
            base.iter().cloned().chain(own).collect()
        }
        Self {
            vertex_inputs: joined(&base.vertex_inputs, self.vertex_inputs),
            colors: joined(&base.colors, self.colors),
            texcoords: joined(&base.texcoords, self.texcoords),
            vertex_constants: joined(&base.vertex_constants, self.vertex_constants),
            pixel_constants: joined(&base.pixel_constants, self.pixel_constants),
            tolerance: self.tolerance.or(base.tolerance),
            expect: self.expect.over(&base.expect),
            tried: self.tried || base.tried,
            accept: self.accept.or_else(|| base.accept.clone()),
        }
    }

    fn invocation(
        self,
        name: Option<String>,
        s: &Section<'_>,
        scope: &Scope,
        problems: &mut Problems,
    ) -> Option<Invocation> {
        if self.expect.is_empty() {
            // What is expected of a listing that is refused has not been read.
            // A mistake in it, or in its name, is told by itself.
            if scope.known && !self.tried && !s.has_unknown() {
                s.missing("an `expect` with at least one register", problems);
            }
            return None;
        }
        let defaults = Vertex::default();
        let mut invocation = Invocation {
            name,
            line: 0,
            vertex_inputs: [INPUT; 16],
            // What a pixel shader sees of colours that nothing writes.
            colors: [defaults.diffuse.to_array(), defaults.specular.to_array()],
            texcoords: [INPUT; 8],
            vertex_constants: self.vertex_constants,
            pixel_constants: self.pixel_constants,
            tolerance: self.tolerance.unwrap_or(DEFAULT_TOLERANCE),
            accept: (self.accept.iter().flatten())
                .map(|other| other.over(&self.expect))
                .collect(),
            expect: self.expect,
        };
        fn lay(registers: &mut [[f32; 4]], given: Vec<(usize, [f32; 4])>) {
            for (number, value) in given {
                if let Some(register) = registers.get_mut(number) {
                    *register = value;
                }
            }
        }
        lay(&mut invocation.vertex_inputs, self.vertex_inputs);
        lay(&mut invocation.colors, self.colors);
        lay(&mut invocation.texcoords, self.texcoords);
        Some(invocation)
    }
}
