//! The body of an entry point: what the lines of a listing became.

use super::constants::{self, Constant, bound_value};
use super::expression::{Expression, Value, construct};
use super::helper::Helpers;
use super::layout::{Block, Field};
use super::listing::Lines;
use super::magnitude::{Magnitudes, Outcome};
use super::together;
use super::{Observed, Options, ShownPixels, Stage};
use crate::isa::operand::{RGBA, XYZW};
use crate::isa::{ShaderKind, WriteMask};
use crate::kernel::{Kernel, Op, Operand, Place, SLOT_COUNT, Slot, Step};
use crate::program::Statement;
use crate::raster::Compare;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{Display, Write};

/// A write that waits until the steps beside it have read.
pub(super) struct Pending<'k> {
    pub(super) step: &'k Step,
    pub(super) value: Value,
    outcome: Outcome,
}

/// Writes the steps of one kernel.
pub(super) struct Body<'a> {
    pub(super) stage: &'a Stage<'a>,
    pub(super) options: &'a Options,
    pub(super) block: Block,
    pub(super) helpers: Helpers,
    pub(super) magnitudes: Magnitudes,
    /// Components of each varying, by coordinate set; pixel stage only.
    varying_widths: [usize; 8],
    /// The components that each slot has in the WGSL; 0 if it is not used.
    widths: [usize; SLOT_COUNT],
    read: [WriteMask; SLOT_COUNT],
    /// Whether constants are addressed relatively, which takes all of them from the uniform block.
    pub(super) relative: bool,
    /// Names that `let` has taken.
    names: BTreeSet<String>,
    killing: bool,
    discards: bool,
    /// Whether the register that is shown stands in a `let` while the shader goes on.
    pub(super) captured: bool,
    /// The lines so far.
    text: String,
}

/// The slots of source `i` that an operation uses when it writes these components and the textures have these shapes.
pub(super) fn slots_read(op: Op, mask: WriteMask, i: usize, options: &Options) -> WriteMask {
    match op {
        Op::Sample(stage) => match options.stages[usize::from(stage) & 7].coordinates() {
            0 => WriteMask::NONE,
            2 => WriteMask::XY,
            _ => WriteMask::XYZ,
        },
        op => op.slots_read(i, mask),
    }
}

/// The components of every slot that a kernel reads when the textures have these shapes.
pub(super) fn components_read(kernel: &Kernel, options: &Options) -> [WriteMask; SLOT_COUNT] {
    let mut read = [WriteMask::NONE; SLOT_COUNT];
    let observed = options.observed.iter();
    for slot in observed.flat_map(|observed| observed.of(kernel.version.kind())) {
        read[slot.index()] = WriteMask::ALL;
    }
    if let Some(shown) = (options.show).filter(|_| kernel.version.kind() == ShaderKind::Pixel) {
        read[shown.slot.index()] = WriteMask::ALL;
    }
    for step in &kernel.steps {
        let mask = kept(kernel, options, step);
        if mask.is_empty() && step.op != Op::Kill {
            continue;
        }
        for (i, operand) in step.sources.iter().enumerate() {
            if let Place::Slot(slot) = operand.place {
                let components = operand.swizzle.reads(slots_read(step.op, mask, i, options));
                read[slot.index()] = read[slot.index()].or(components);
            }
        }
    }
    read
}

impl<'a> Body<'a> {
    pub(super) fn new(
        stage: &'a Stage<'a>,
        options: &'a Options,
        varying_widths: [usize; 8],
    ) -> Self {
        let kernel = stage.kernel;
        let read = components_read(kernel, options);
        let mut used = read;
        for step in &kernel.steps {
            if step.op != Op::Kill {
                let at = step.destination.index();
                used[at] = used[at].or(kept(kernel, options, step));
            }
        }
        let mut widths = used.map(width_of);
        widths[Slot::COORDINATES.index()] = width_of(read[Slot::COORDINATES.index()]);
        for scalar in [Slot::FOG, Slot::POINT_SIZE, Slot::ADDRESS, Slot::DEPTH] {
            widths[scalar.index()] = widths[scalar.index()].min(1);
        }
        let kind = kernel.version.kind();
        match kind {
            ShaderKind::Pixel => widths[Slot::R0.index()] = 4,
            ShaderKind::Vertex => {
                for color in (0..2)
                    .filter_map(Slot::color_output)
                    .chain([Slot::POSITION])
                {
                    let width = &mut widths[color.index()];
                    *width = if *width > 0 { 4 } else { 0 };
                }
            }
        }
        let mut body = Self {
            stage,
            options,
            block: Block::default(),
            helpers: Helpers::default(),
            magnitudes: Magnitudes::new(kernel, BTreeMap::new(), options),
            varying_widths,
            widths,
            read,
            relative: { kernel.steps.iter() }
                .any(|step| step.sources.iter().any(constants::is_relative)),
            names: BTreeSet::new(),
            killing: false,
            discards: false,
            captured: false,
            text: String::new(),
        };
        let known: BTreeMap<u32, [f32; 4]> = (kernel.definitions.iter())
            .filter(|(index, _)| body.constant(*index) == Constant::Defined)
            .map(|(index, value)| (*index, bound_value(kind, *value)))
            .collect();
        body.magnitudes = Magnitudes::new(kernel, known, options);
        let uniform = |index: &u32| body.constant(*index) == Constant::Uniform;
        let named = kernel
            .constants()
            .filter(uniform)
            .map(|index| index + 1)
            .max();
        if body.relative {
            body.widths[Slot::ADDRESS.index()] = 1;
        }
        body.block.constants = match body.relative {
            true => body.constant_count(),
            false => named.unwrap_or(0),
        };
        body
    }

    pub(super) fn kind(&self) -> ShaderKind {
        self.stage.kernel.version.kind()
    }

    /// The components that a slot has in the WGSL; 0 if nothing writes or reads it.
    pub(super) fn width(&self, slot: Slot) -> usize {
        match slot.texcoord_index() {
            Some(set) => self.varying_widths[set],
            None if slot.input_index().is_some() => 4,
            None => self.widths[slot.index()],
        }
    }

    /// Whether the alpha test lets nothing through.
    pub(super) fn discards_all(&self) -> bool {
        self.options.alpha_test == Some(Compare::Never) && self.shown().is_none()
    }

    /// Whether it matters in the end what `texkill` says.
    pub(super) fn asks_for_kill(&self) -> bool {
        let all = (self.shown()).is_some_and(|shown| shown.pixels == ShownPixels::All);
        self.stage.kernel.kills() && !all && !self.discards_all()
    }

    pub(super) fn name(&self, slot: Slot) -> String {
        let mut name = slot.name(self.kind());
        let from_outside = slot.texcoord_index().is_some()
            || (slot.input_index().is_some() && self.kind() == ShaderKind::Vertex);
        if from_outside {
            name.insert_str(0, "in.");
        }
        name
    }

    pub(super) fn letters(&self, slot: Slot) -> [char; 4] {
        let coordinates = slot.texcoord_index().is_some() || slot.is_internal();
        match self.kind() {
            ShaderKind::Pixel if !coordinates => RGBA,
            _ => XYZW,
        }
    }

    /// Notes that the pixel may be taken out.
    pub(super) fn note_discard(&mut self) {
        self.discards = true;
    }

    pub(super) fn discards(&self) -> bool {
        self.discards
    }

    /// Where the next line will stand.
    pub(super) fn mark(&self) -> usize {
        self.text.len()
    }

    /// Puts an empty line at a mark.
    pub(super) fn insert_blank(&mut self, mark: usize) {
        self.text.insert(mark, '\n');
    }

    /// Adds a line. Only empty ones are not indented.
    pub(super) fn push(&mut self, line: impl Display) {
        const INDENTATION: &str = "    ";
        self.text.push_str(INDENTATION);
        let start = self.text.len();
        // A text takes everything.
        _ = write!(self.text, "{line}");
        if self.text.len() == start {
            self.text.truncate(start - INDENTATION.len());
        }
        self.text.push('\n');
    }

    /// A field of the uniform block.
    pub(super) fn uniform(&mut self, field: Field) -> String {
        self.block.use_field(field);
        let block = match self.kind() {
            ShaderKind::Vertex => "vs.",
            ShaderKind::Pixel => "ps.",
        };
        [block, &field.name()].concat()
    }

    /// The lines and what they need.
    pub(super) fn finish(self) -> (String, Block, Helpers) {
        (self.text, self.block, self.helpers)
    }

    /// Everything between the head of the function and its outputs.
    pub(super) fn statements(&mut self) {
        let (program, kernel) = (self.stage.program, self.stage.kernel);
        let mut lines = Lines::new(self.stage);
        lines.up_to(program.version_span, &mut |line| self.push(line));
        self.declarations();
        let mut steps = kernel.steps.as_slice();
        let on_the_way = self.shown_on_the_way();
        let end = match on_the_way {
            None => self.shown().map_or(usize::MAX, |shown| shown.instructions),
            Some(_) => usize::MAX,
        };
        let captured = |number| on_the_way.filter(|shown| shown.instructions == number);
        if let Some(shown) = captured(0) {
            self.capture(shown.slot, &[]);
        }
        let loads = steps.iter().take_while(|step| is_load(step)).count();
        for load in steps[..loads].iter().filter(|load| load.origin < end) {
            self.step(load, &mut Vec::new());
        }
        steps = &steps[loads..];
        let mut pending = Vec::new();
        let mut number = 0;
        for statement in &program.statements {
            if number == end && matches!(statement, Statement::Instruction(_)) {
                return self.commit(&mut pending);
            }
            lines.up_to(statement.span(), &mut |line| self.push(line));
            match statement {
                Statement::Def(def) => self.definition(def),
                Statement::Dcl(_) => {}
                Statement::Instruction(_) => {
                    let count = steps
                        .iter()
                        .take_while(|step| step.origin == number)
                        .count();
                    let (own, rest) = steps.split_at(count);
                    self.instruction(own, &mut pending);
                    steps = rest;
                    number += 1;
                    if let Some(shown) = captured(number) {
                        self.capture(shown.slot, &pending);
                    }
                }
            }
        }
        self.commit(&mut pending);
        lines.rest(&mut |line| self.push(line));
    }

    /// Leaves the registers that are looked at where they can be seen.
    pub(super) fn observe(&mut self) {
        let Some(observed) = &self.options.observed else {
            return;
        };
        let variable = Observed::variable(self.kind());
        for (number, slot) in observed.of(self.kind()).iter().enumerate() {
            let name = self.name(*slot);
            let value = match self.width(*slot) {
                0 => "vec4f()".to_string(),
                1 if *slot == Slot::ADDRESS => format!("vec4f(f32({name}))"),
                1 => format!("vec4f({name})"),
                4 => name,
                width => {
                    let zeros = vec!["0.0"; 4 - width].join(", ");
                    format!("vec4f({name}, {zeros})")
                }
            };
            self.push(format!("{variable}[{number}] = {value};"));
        }
    }

    /// The registers, and what pixel shaders read through a clamp.
    fn declarations(&mut self) {
        let kernel = self.stage.kernel;
        if self.kind() == ShaderKind::Pixel {
            for color in (0..2).filter_map(Slot::input) {
                if !self.read[color.index()].is_empty() {
                    let name = self.name(color);
                    let color = self.color(&name);
                    self.push(format_args!("let {name} = {};", color.text));
                }
            }
            let named: BTreeSet<u32> = (kernel.constants())
                .filter(|index| self.names_constant(*index))
                .filter(|index| self.constant(*index) == Constant::Uniform)
                .collect();
            for index in named {
                let field = self.uniform(Field::Constants);
                let constant = self.uniform_constant(index, &field);
                self.push(format_args!("let c{index} = {};", constant.text));
            }
        }
        for slot in Slot::all() {
            let width = self.widths[slot.index()];
            let from_outside = slot.input_index().is_some() || slot.texcoord_index().is_some();
            if width == 0 || from_outside {
                continue;
            }
            let name = self.name(slot);
            let preset = (kernel.presets.iter()).find(|(preset, _)| *preset == slot);
            match (width, preset) {
                (1, _) if slot == Slot::ADDRESS => self.push(format_args!("var {name}: i32;")),
                (1, _) => self.push(format_args!("var {name}: f32;")),
                (_, Some((_, value))) if *value == [1.0; 4] => {
                    self.push(format_args!("var {name} = vec{width}f(1.0);"));
                }
                _ => self.push(format_args!("var {name}: vec{width}f;")),
            }
        }
        if self.asks_for_kill() {
            self.push("var killed = false;");
        }
    }

    fn instruction(&mut self, steps: &'a [Step], pending: &mut Vec<Pending<'a>>) {
        let mut rest = steps;
        while !rest.is_empty() {
            let (own, others) = rest.split_at(together::count(rest).max(1));
            match own {
                [_, _, ..] if pending.is_empty() => self.together(own),
                _ => own.iter().for_each(|step| self.step(step, pending)),
            }
            rest = others;
        }
    }

    fn step(&mut self, step: &'a Step, pending: &mut Vec<Pending<'a>>) {
        if let Op::Kill = step.op {
            let asked = self.asks_for_kill();
            if !asked {
                return;
            }
            let tested = self.operand(step, 0, WriteMask::XYZ).spread(3);
            let before = if self.killing { "killed || " } else { "" };
            self.push(format_args!(
                "killed = {before}any({} < vec3f());",
                tested.text
            ));
            self.killing = true;
            return;
        }
        let mask = kept(self.stage.kernel, self.options, step);
        if mask.is_empty() {
            return;
        }
        if mask != step.mask {
            let narrowed = Step {
                mask,
                ..step.clone()
            };
            return self.unheld(&narrowed);
        }
        let overlaps = pending.iter().any(|p| {
            p.step.destination == step.destination && !p.step.mask.and(step.mask).is_empty()
        });
        if step.held || overlaps {
            let outcome = self.magnitudes.outcome(step);
            let value = self.value(step);
            let value = self.finished(step, value).whole();
            let name = self.free_name(step);
            self.push(format_args!("let {name} = {};", value.text));
            let value = Value::Whole(Expression::new(name, value.width));
            pending.push(Pending {
                step,
                value,
                outcome,
            });
            if !step.held {
                self.commit(pending);
            }
            return;
        }
        self.unheld(step);
        self.commit(pending);
    }

    /// A step that is written at once.
    fn unheld(&mut self, step: &Step) {
        let outcome = self.magnitudes.outcome(step);
        match step.op {
            Op::Sample(stage) => self.sample(step, stage),
            _ => {
                let value = self.value(step);
                let value = self.finished(step, value);
                self.assign(step.destination, step.mask, value);
            }
        }
        self.magnitudes.write(step, outcome);
    }

    fn commit(&mut self, pending: &mut Vec<Pending<'a>>) {
        for write in pending.drain(..) {
            self.assign(write.step.destination, write.step.mask, write.value);
            self.magnitudes.write(write.step, write.outcome);
        }
    }

    /// A name for a value that waits: that of the register with the components, and a number if need be.
    fn free_name(&mut self, step: &Step) -> String {
        let letters = self.letters(step.destination);
        let components: String = step.mask.components().map(|c| letters[c]).collect();
        let base = format!("{}_{components}", self.name(step.destination));
        let mut name = base.clone();
        let mut number = 2;
        while !self.names.insert(name.clone()) {
            name = format!("{base}_{number}");
            number += 1;
        }
        name
    }

    /// Assigns a value to some components of a slot. WGSL assigns to one component or to all, so that everything
    /// between writes the others back.
    pub(super) fn assign(&mut self, slot: Slot, mask: WriteMask, value: Value) {
        let (name, width, letters) = (self.name(slot), self.width(slot), self.letters(slot));
        let components: Vec<usize> = mask.components().collect();
        let count = components.len();
        if width == 1 {
            let value = value.whole().text;
            return self.push(format_args!("{name} = {value};"));
        }
        if let [only] = components.as_slice() {
            let value = value.whole().text;
            return self.push(format_args!("{name}.{} = {value};", letters[*only]));
        }
        if count == width {
            let value = value.whole().spread(width).text;
            return self.push(format_args!("{name} = {value};"));
        }
        let (Some(&first), Some(&last)) = (components.first(), components.last()) else {
            return;
        };
        let keep = |range: std::ops::Range<usize>| -> Option<String> {
            let kept: String = range.map(|c| letters[c]).collect();
            (!kept.is_empty()).then(|| [&name, ".", &kept].concat())
        };
        if last + 1 - first == count {
            let written = match value {
                Value::Whole(whole) => vec![whole.spread(count).text],
                Value::Parts(parts) => parts.into_iter().map(|part| part.text).collect(),
            };
            let parts = keep(0..first)
                .into_iter()
                .chain(written)
                .chain(keep(last + 1..width));
            let all = construct(parts.collect(), width);
            return self.push(format_args!("{name} = {};", all.text));
        }
        let value = value.whole().spread(count).text;
        let together: String = components.iter().map(|c| letters[*c]).collect();
        self.push("{");
        self.push(format_args!("    let {together} = {value};"));
        for (part, component) in components.iter().enumerate() {
            self.push(format_args!(
                "    {name}.{} = {together}.{};",
                letters[*component], XYZW[part]
            ));
        }
        self.push("}");
    }
}

/// The components that a step writes and that are not lost: of coordinates those that its instruction uses in the end,
/// of outputs with one component that one.
pub(super) fn kept(kernel: &Kernel, options: &Options, step: &Step) -> WriteMask {
    match step.destination {
        Slot::COORDINATES => step
            .mask
            .and(coordinates_used(kernel, options, step.origin)),
        Slot::FOG => step.mask.and(WriteMask::component(kernel.fog_component)),
        Slot::POINT_SIZE => step
            .mask
            .and(WriteMask::component(kernel.point_size_component)),
        _ => step.mask,
    }
}

/// The components of the coordinates that an instruction computes and then samples at or hands on.
fn coordinates_used(kernel: &Kernel, options: &Options, origin: usize) -> WriteMask {
    let computed = Place::Slot(Slot::COORDINATES);
    let first = kernel.steps.partition_point(|step| step.origin < origin);
    let own = kernel.steps[first..]
        .iter()
        .take_while(|step| step.origin == origin);
    own.filter(|step| step.destination != Slot::COORDINATES)
        .flat_map(|step| {
            let sources = step.sources.iter().enumerate();
            sources
                .filter(|(_, s)| s.place == computed)
                .map(|(i, s)| s.swizzle.reads(slots_read(step.op, step.mask, i, options)))
        })
        .fold(WriteMask::NONE, WriteMask::or)
}

/// Vectors that hold these components; a single x takes two, so that it can be named.
fn width_of(used: WriteMask) -> usize {
    used.components().last().map_or(0, |last| (last + 1).max(2))
}

/// Whether a step loads coordinates into a texture register before the first instruction.
fn is_load(step: &Step) -> bool {
    let texture = (0..4).any(|i| Slot::texture(i) == Some(step.destination));
    let coordinates = |operand: &Operand| {
        (0..8).any(|i| Slot::texcoord(i).map(Place::Slot) == Some(operand.place))
    };
    step.op == Op::Mov
        && step.mask == WriteMask::ALL
        && texture
        && step.sources.iter().all(coordinates)
}
