//! Scopes and what is in them.

use super::adapter::{Adapter, View};
use super::protocol::{
    Answer, Handled, PresentationHint, Refusal, Scope, Scopes, SetExpressionArguments,
    SetVariableArguments, Valued, Variable, Variables, VariablesArguments,
};
use super::{adapter, values};
use texcrd::debug::{RunKind, Target, Value};
use texcrd::isa::WriteMask;
use texcrd::kernel::{Place, Slot};

/// What the client can ask for the content of; the numbers count from 1.
#[derive(Debug, Default)]
pub(super) struct Containers(Vec<Container>);

/// Something with variables in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Container {
    /// A scope of a run, for one pixel of the quad.
    Scope { run: usize, part: Part, lane: usize },
    /// The constants that the shader has nothing to do with.
    Constants { run: usize },
    /// The components of a register.
    Register {
        run: usize,
        target: Target,
        lane: usize,
    },
    /// A texture stage.
    Stage { run: usize, stage: usize },
    /// What an expression came to: the bits, and how many numbers.
    Numbers { bits: [u32; 4], count: usize },
}

/// A scope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Registers,
    Inputs,
    Constants,
    Textures,
    Outputs,
    Internal,
    Quad,
}

/// A variable, before the client has a number for what is in it.
pub(super) struct Item {
    pub name: String,
    pub value: String,
    pub kind: &'static str,
    /// What is in it, and how many named and how many numbered variables.
    pub content: Option<(Container, usize, usize)>,
    /// As expressions name it.
    pub evaluate: Option<String>,
    /// What is written to when it is set.
    pub place: Option<(Target, WriteMask)>,
}

/// A register that can be set or watched.
pub(super) struct Settable {
    pub target: Target,
    pub mask: WriteMask,
    /// Both, as expressions name them.
    pub name: String,
}

impl Containers {
    /// The most that are remembered at one stop.
    const MOST: usize = 1 << 16;

    /// The number of a container; 0, nothing, if there are too many.
    pub(super) fn reference(&mut self, container: Container) -> i64 {
        let known = self.0.iter().position(|other| *other == container);
        let number = match known {
            Some(number) => number + 1,
            None if self.0.len() < Self::MOST => {
                self.0.push(container);
                self.0.len()
            }
            None => 0,
        };
        number as i64
    }

    fn get(&self, reference: i64) -> Result<Container, Refusal> {
        let number = usize::try_from(reference.saturating_sub(1)).ok();
        let found = number.and_then(|number| self.0.get(number)).copied();
        found.ok_or_else(|| Refusal::here("there are no such variables any more"))
    }
}

impl Item {
    /// Something that is only read.
    pub(super) fn fact(name: &str, value: impl Into<String>) -> Self {
        Self {
            name: name.to_string(),
            value: value.into(),
            kind: "",
            content: None,
            evaluate: None,
            place: None,
        }
    }
}

impl Adapter<'_, '_> {
    pub(super) fn scopes(&mut self, frame: i64) -> Handled {
        let view = self.view_of(Some(frame))?;
        let (run, lane) = (view.number, view.run.lane);
        let parts = [
            ("Registers", Part::Registers, Some("registers")),
            ("Inputs", Part::Inputs, Some("arguments")),
            ("Constants", Part::Constants, None),
            ("Textures", Part::Textures, None),
            ("Outputs", Part::Outputs, Some("returnValue")),
            ("Within instructions", Part::Internal, None),
            ("Quad", Part::Quad, None),
        ];
        let mut scopes = Vec::new();
        for (name, part, presentation_hint) in parts {
            let container = Container::Scope { run, part, lane };
            let count = self.items(container, false)?.len();
            let always = !matches!(part, Part::Internal | Part::Quad);
            if count == 0 && !always {
                continue;
            }
            scopes.push(Scope {
                name,
                presentation_hint,
                variables_reference: self.containers.reference(container),
                named_variables: count,
                expensive: false,
            });
        }
        Ok(Answer::of(&Scopes { scopes }))
    }

    pub(super) fn variables(&mut self, arguments: &VariablesArguments) -> Handled {
        let container = self.containers.get(arguments.variables_reference)?;
        let hex = arguments.format.and_then(|f| f.hex).unwrap_or(false);
        let items = self.items(container, hex)?;
        let indexed = matches!(container, Container::Constants { .. });
        let wanted = match arguments.filter.as_deref() {
            Some("indexed") => indexed,
            Some("named") => !indexed,
            _ => true,
        };
        let number = |number: Option<i64>| number.and_then(|n| usize::try_from(n).ok());
        let first = number(arguments.start).unwrap_or(0);
        let most = number(arguments.count)
            .filter(|n| *n > 0)
            .unwrap_or(usize::MAX);
        let page = items.into_iter().filter(|_| wanted).skip(first).take(most);
        let page: Vec<Item> = page.collect();
        let variables = page.into_iter().map(|item| self.variable(item)).collect();
        Ok(Answer::of(&Variables { variables }))
    }

    fn variable(&mut self, item: Item) -> Variable {
        let read_only = (item.place.is_none()).then_some("readOnly");
        let (reference, named, indexed) = match item.content {
            Some((container, named, indexed)) => {
                let reference = self.containers.reference(container);
                (reference, Some(named), Some(indexed))
            }
            None => (0, None, None),
        };
        Variable {
            name: item.name,
            value: item.value,
            kind: Some(item.kind).filter(|kind| self.client.types && !kind.is_empty()),
            presentation_hint: Some(PresentationHint {
                kind: "data",
                attributes: read_only.into_iter().collect(),
            }),
            evaluate_name: item.evaluate,
            variables_reference: reference,
            named_variables: named.filter(|n| *n > 0),
            indexed_variables: indexed.filter(|n| *n > 0),
        }
    }

    /// What is in a container, now.
    fn items(&self, container: Container, hex: bool) -> Result<Vec<Item>, Refusal> {
        let seen = |run| {
            let view = self.view(run);
            view.ok_or_else(|| Refusal::here("there are no such variables any more"))
        };
        match container {
            Container::Scope { run, part, lane } => {
                let view = seen(run)?;
                Ok(self.part(&view, part, lane, hex))
            }
            Container::Constants { run } => {
                let view = seen(run)?;
                let (_, others) = constants(&view);
                let register = |index: &u32| {
                    self.register(&view, Target::Constant(*index), view.run.lane, hex)
                };
                Ok(others.iter().map(register).collect())
            }
            Container::Register { run, target, lane } => {
                let view = seen(run)?;
                let register = |c| {
                    let mask = WriteMask::component(c);
                    let whole = self.masked(&view, target, mask, lane, hex);
                    let letters = texcrd::program::letters(view.run.listing.kind());
                    Item {
                        name: letters[c & 3].to_string(),
                        ..whole
                    }
                };
                Ok((0..4).map(register).collect())
            }
            Container::Stage { run, stage } => Ok(super::textures::stage(&seen(run)?, stage, hex)),
            Container::Numbers { bits, count } => {
                let names = ["0", "1", "2", "3"].into_iter().zip(bits).take(count);
                let number = |(name, bits)| {
                    let value = Value::scalar(f32::from_bits(bits));
                    Item::fact(name, values::with_marks(&value, hex, &[]))
                };
                Ok(names.map(number).collect())
            }
        }
    }

    /// What is in a scope.
    fn part(&self, view: &View<'_>, part: Part, lane: usize, hex: bool) -> Vec<Item> {
        let kernel = view.run.listing.kernel;
        let slots = |part: Part| {
            let in_use = move |slot: &Slot| {
                let known = [kernel.written(*slot), kernel.read(*slot)];
                part_of(*slot) == part
                    && (known.iter().any(|mask| !mask.is_empty())
                        || !view.registers.written(*slot).is_empty())
            };
            let slots = Slot::all().filter(in_use);
            slots.map(|slot| self.register(view, Target::Slot(slot), lane, hex))
        };
        match part {
            Part::Registers | Part::Inputs | Part::Internal => slots(part).collect(),
            Part::Constants => {
                let (own, others) = constants(view);
                let own = own.into_iter();
                let mut items: Vec<Item> = own
                    .map(|index| self.register(view, Target::Constant(index), lane, hex))
                    .collect();
                if !others.is_empty() {
                    let content = Container::Constants { run: view.number };
                    let text = format!("{} that the shader does not read", others.len());
                    items.push(Item {
                        content: Some((content, 0, others.len())),
                        ..Item::fact("others", text)
                    });
                }
                items
            }
            Part::Textures => super::textures::stages(view, hex),
            Part::Outputs => {
                let mut items = Vec::new();
                if view.run.listing.kind() == texcrd::isa::ShaderKind::Pixel {
                    items.push(self.register(view, Target::Slot(Slot::R0), lane, hex));
                }
                items.extend(slots(Part::Outputs));
                if kernel.kills() {
                    let killed = view.registers.killed()[lane & 3];
                    items.push(Item {
                        evaluate: Some("killed".to_string()),
                        ..Item::fact("killed", killed.to_string())
                    });
                }
                items
            }
            Part::Quad => self.quad(view),
        }
    }

    /// The four pixels that are shaded together, each with its registers.
    fn quad(&self, view: &View<'_>) -> Vec<Item> {
        let RunKind::Pixel { pixel } = view.run.kind else {
            return Vec::new();
        };
        let pixel_item = |lane: usize| {
            // Column and row of a pixel of the quad from those of the one that is looked at.
            let place = |axis: usize| {
                let [here, own] = [lane, view.run.lane].map(|lane| (lane >> axis & 1) as u32);
                (pixel[axis] + here).saturating_sub(own)
            };
            let about = match (lane == view.run.lane, view.run.helpers[lane & 3]) {
                (true, _) => "the pixel that is debugged",
                (false, true) => "a helper: outside of the primitive, shaded for differences only",
                (false, false) => "a neighbour",
            };
            let content = Container::Scope {
                run: view.number,
                part: Part::Registers,
                lane,
            };
            let count = self.part(view, Part::Registers, lane, false).len();
            Item {
                content: Some((content, count, 0)),
                ..Item::fact(&format!("{},{}", place(0), place(1)), about)
            }
        };
        (0..4).map(pixel_item).collect()
    }

    /// A register with all the components that mean something.
    fn register(&self, view: &View<'_>, target: Target, lane: usize, hex: bool) -> Item {
        let mask = match target {
            Target::Slot(slot) => values::components(slot, view.run.listing.kernel),
            Target::Constant(_) => WriteMask::ALL,
        };
        let item = self.masked(view, target, mask, lane, hex);
        let content = Container::Register {
            run: view.number,
            target,
            lane,
        };
        Item {
            content: (mask == WriteMask::ALL).then_some((content, 4, 0)),
            name: values::name(target, &view.run.listing),
            ..item
        }
    }

    /// Components of a register, with what is to be said about them.
    fn masked(
        &self,
        view: &View<'_>,
        target: Target,
        mask: WriteMask,
        lane: usize,
        hex: bool,
    ) -> Item {
        let lane = lane & 3;
        let listing = &view.run.listing;
        let now = view.registers.target(target)[lane];
        let mut marks = Vec::new();
        if let Target::Slot(slot) = target {
            let missing = mask.without(view.registers.written(slot));
            let which = missing.text(texcrd::program::letters(listing.kind()));
            match missing {
                WriteMask::NONE => {}
                all if all == mask => marks.push("not written".to_string()),
                _ => marks.push(format!("{} not written", which.trim_start_matches('.'))),
            }
        }
        if let Some((run, before)) = &self.before
            && *run == view.number
            && *run == self.session.position().run
        {
            let before = before.target(target)[lane];
            let differs = |c: usize| before[c].to_bits() != now[c].to_bits();
            if mask.components().any(differs) {
                marks.push("changed".to_string());
            }
        }
        let name = values::name(target, listing);
        let evaluate = values::masked(&name, target, mask, listing.kind());
        let value = values::picked(now, mask);
        let internal = target
            .slot()
            .is_some_and(|slot| slot.is_internal() && slot != Slot::DEPTH);
        Item {
            name,
            value: values::with_marks(&value, hex, &marks),
            kind: match value.count {
                1 => "float",
                _ => "float4",
            },
            content: None,
            // Expressions look at the pixel that is debugged.
            evaluate: (lane == view.run.lane && !internal).then_some(evaluate),
            place: (lane == view.run.lane && !internal).then_some((target, mask)),
        }
    }

    /// The register that a variable of a container is; `None` if it is none.
    ///
    /// # Errors
    /// There is no such variable.
    pub(super) fn settable(
        &self,
        reference: i64,
        name: &str,
    ) -> Result<Option<(View<'_>, Settable)>, Refusal> {
        let container = self.containers.get(reference)?;
        let items = self.items(container, false)?;
        let unknown = || Refusal::request(format!("there is no `{name}` among these"));
        let item = items
            .into_iter()
            .find(|item| item.name == name)
            .ok_or_else(unknown)?;
        let run = match container {
            Container::Scope { run, .. }
            | Container::Register { run, .. }
            | Container::Constants { run }
            | Container::Stage { run, .. } => run,
            Container::Numbers { .. } => return Ok(None),
        };
        let Some(((target, mask), view)) = item.place.zip(self.view(run)) else {
            return Ok(None);
        };
        let kind = view.run.listing.kind();
        let settable = Settable {
            target,
            mask,
            name: values::masked(&values::name(target, &view.run.listing), target, mask, kind),
        };
        Ok(Some((view, settable)))
    }

    pub(super) fn set_variable(&mut self, arguments: &SetVariableArguments) -> Handled {
        let found = self.settable(arguments.variables_reference, &arguments.name)?;
        let (view, place) = found.ok_or_else(|| {
            Refusal::here(format!(
                "`{}` is told by the debugger; it cannot be set",
                arguments.name
            ))
        })?;
        let run = view.number;
        let hex = arguments.format.and_then(|f| f.hex).unwrap_or(false);
        self.set(run, place, &arguments.value, hex)
    }

    pub(super) fn set_expression(&mut self, arguments: &SetExpressionArguments) -> Handled {
        let view = self.view_of(arguments.frame_id)?;
        let written = adapter::expression(&arguments.expression)?;
        let target = written.target_here(&view.scope(view.run.lane));
        let (target, mask) = target.ok_or_else(|| {
            Refusal::text(format!("`{written}` is no register; it cannot be set"))
        })?;
        let run = view.number;
        let place = Settable {
            target,
            mask,
            name: written.to_string(),
        };
        let hex = arguments.format.and_then(|f| f.hex).unwrap_or(false);
        self.set(run, place, &arguments.value, hex)
    }

    /// Writes to a register of the run that one is in, as the command does it.
    fn set(&mut self, run: usize, place: Settable, text: &str, hex: bool) -> Handled {
        let (target, mask) = (place.target, place.mask);
        let view = self.view_of(None)?;
        if run != view.number {
            let message = "this frame is at its end; restart it to set something in it";
            return Err(Refusal::here(message));
        }
        let lane = view.run.lane;
        let before = (run, view.registers.clone().into_owned());
        let command = format!("set {} = {}", place.name, values::written(text));
        let reply = self.wanted.console.execute(&mut self.session, &command);
        if reply.failed {
            return Err(Refusal::text(reply.text.to_string().trim_end()));
        }
        self.before = Some(before);
        let container = Container::Register { run, target, lane };
        let whole = mask == WriteMask::ALL;
        let reference = whole.then(|| self.containers.reference(container));
        let now = self.session.registers().target(target)[lane & 3];
        let value = values::picked(now, mask);
        let set = Valued {
            value: Some(values::with_marks(&value, hex, &["changed".to_string()])),
            kind: self
                .client
                .types
                .then_some(if whole { "float4" } else { "float" }),
            variables_reference: reference.unwrap_or(0),
            named_variables: whole.then_some(4),
            ..Valued::default()
        };
        Ok(Answer::then(&set, self.invalidated()))
    }
}

/// The scope that a register is shown in.
fn part_of(slot: Slot) -> Part {
    if slot.input_index().is_some() || slot.texcoord_index().is_some() {
        Part::Inputs
    } else if slot.is_output() {
        Part::Outputs
    } else if slot.is_internal() {
        Part::Internal
    } else {
        Part::Registers
    }
}

/// The constants that a run has to do with: named, read through `a0.x`, or not zero; and the others.
fn constants(view: &View<'_>) -> (Vec<u32>, Vec<u32>) {
    let kernel = view.run.listing.kernel;
    let relative = view
        .run
        .moments
        .iter()
        .flat_map(|moment| match &moment.event {
            texcrd::debug::Event::Step { reads, .. } => reads.as_slice(),
            _ => &[],
        });
    let relative = relative.filter(|read| matches!(read.operand.place, Place::Relative(_)));
    let named: std::collections::BTreeSet<u32> = (kernel.constants())
        .chain(relative.flat_map(|read| read.relative.into_iter().flatten()))
        .collect();
    let all = 0..view.registers.constant_count() as u32;
    all.partition(|index| {
        let value = view.registers.constant(*index);
        named.contains(index) || value.iter().any(|x| *x != 0.0)
    })
}
