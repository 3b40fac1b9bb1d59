//! From the steps of a kernel to values.

use super::graph::{Graph, Value};
use super::{RowFinish, RowOp};
use crate::isa::{ShaderKind, WriteMask};
use crate::kernel::{Kernel, Op, Operand, Place, SLOT_COUNT, Slot, Step};
use crate::policy::Model;

/// Runs a kernel on values instead of numbers.
pub(super) fn build(kernel: &Kernel) -> Graph {
    let mut builder = Builder {
        graph: Graph::default(),
        registers: vec![[None; 4]; SLOT_COUNT],
    };
    for (slot, value) in &kernel.presets {
        for (component, number) in value.iter().enumerate() {
            let value = builder.graph.literal(*number);
            builder.write(*slot, component, value);
        }
    }
    let mut held: Vec<(Slot, usize, Value)> = Vec::new();
    for step in &kernel.steps {
        builder.graph.origin = step.origin;
        let results = builder.step(step);
        held.extend(results);
        if !step.held {
            for (slot, component, value) in held.drain(..) {
                builder.write(slot, component, value);
            }
        }
    }
    for (slot, component, value) in held {
        builder.write(slot, component, value);
    }
    builder.finish(kernel)
}

struct Builder {
    graph: Graph,
    /// What each component of each register holds; nothing where it was neither preset nor written.
    registers: Vec<[Option<Value>; 4]>,
}

impl Builder {
    fn write(&mut self, slot: Slot, component: usize, value: Value) {
        if let Some(place) =
            (self.registers.get_mut(slot.index())).and_then(|register| register.get_mut(component))
        {
            *place = Some(value);
        }
    }

    fn read(&mut self, slot: Slot, component: usize) -> Value {
        let known = self.registers.get(slot.index());
        if let Some(value) = known.and_then(|register| *register.get(component)?) {
            return value;
        }
        match slot.input_index().or(slot.texcoord_index()) {
            Some(_) => self.graph.input(slot, component as u8, false),
            None => self.graph.literal(0.0),
        }
    }

    /// What slot `k` of source `i` of a step reads.
    fn source(&mut self, step: &Step, i: usize, k: usize) -> Value {
        let Some(Operand {
            place,
            swizzle,
            modifier,
        }) = step.sources.get(i).copied()
        else {
            return self.graph.literal(0.0);
        };
        let component = swizzle.slot(k);
        let value = match place {
            Place::Slot(slot) => self.read(slot, component),
            Place::Constant(index) => self.graph.constant(index, component as u8),
            Place::Literal(number) => self.graph.literal(number),
            Place::Relative(offset) => {
                let address = self.read(Slot::ADDRESS, 0);
                let op = RowOp::Relative(offset, component as u8);
                self.graph
                    .computed(op, vec![address], RowFinish::Keep, Model::Float)
            }
        };
        self.graph.operand(step.reads, modifier, value)
    }

    /// Adds what a step computes; gives what goes where.
    fn step(&mut self, step: &Step) -> Vec<(Slot, usize, Value)> {
        let components: Vec<usize> = step.mask.components().collect();
        let results: Vec<Value> = match step.op {
            Op::Mov => self.each(step, RowOp::Mov, 1),
            Op::Add => self.each(step, RowOp::Add, 2),
            Op::Sub => self.each(step, RowOp::Sub, 2),
            Op::Mul => self.each(step, RowOp::Mul, 2),
            Op::Mad => self.each(step, RowOp::Mad, 3),
            Op::Lrp => self.each(step, RowOp::Lrp, 3),
            Op::Min => self.each(step, RowOp::Min, 2),
            Op::Max => self.each(step, RowOp::Max, 2),
            Op::Slt => self.each(step, RowOp::Slt, 2),
            Op::Sge => self.each(step, RowOp::Sge, 2),
            Op::Frc => self.each(step, RowOp::Frc, 1),
            Op::Floor => self.each(step, RowOp::Address, 1),
            Op::Cnd => self.each(step, RowOp::Cnd, 3),
            Op::Cmp => self.each(step, RowOp::Cmp, 3),
            Op::Dp3 => self.one(step, RowOp::Dp3, &places(3)),
            Op::Dp4 => self.one(step, RowOp::Dp4, &places(4)),
            Op::Rcp => self.one(step, RowOp::Rcp, &[(0, 0)]),
            Op::Rsq => self.one(step, RowOp::Rsq, &[(0, 0)]),
            Op::Exp => self.one(step, RowOp::Exp, &[(0, 0)]),
            Op::Log => self.one(step, RowOp::Log, &[(0, 0)]),
            Op::ExpP => self.parts(step, |k| match k {
                3 => Part::Number(1.0),
                k => Part::Of(RowOp::ExpP(k as u8), &[(0, 0)]),
            }),
            Op::LogP => self.parts(step, |k| match k {
                3 => Part::Number(1.0),
                k => Part::Of(RowOp::LogP(k as u8), &[(0, 0)]),
            }),
            Op::Lit => self.parts(step, |k| match k {
                1 => Part::Of(RowOp::LitDiffuse, &[(0, 0)]),
                2 => Part::Of(RowOp::LitSpecular, &[(0, 0), (0, 1), (0, 3)]),
                _ => Part::Number(1.0),
            }),
            Op::Dst => self.parts(step, |k| match k {
                0 => Part::Number(1.0),
                1 => Part::Of(RowOp::Mul, &[(0, 1), (1, 1)]),
                2 => Part::Of(RowOp::Mov, &[(0, 2)]),
                _ => Part::Of(RowOp::Mov, &[(1, 3)]),
            }),
            Op::DivideZ => self.parts(step, |k| match k {
                0 => Part::Of(RowOp::Divide, &[(0, 0), (0, 2)]),
                1 => Part::Of(RowOp::Divide, &[(0, 1), (0, 2)]),
                _ => Part::Number(0.0),
            }),
            Op::DivideW => self.parts(step, |k| match k {
                0 => Part::Of(RowOp::Divide, &[(0, 0), (0, 3)]),
                1 => Part::Of(RowOp::Divide, &[(0, 1), (0, 3)]),
                _ => Part::Number(0.0),
            }),
            Op::Project(by) => {
                let by = self.source(step, 0, usize::from(by) & 3);
                let values: Vec<_> = (components.iter())
                    .map(|k| vec![self.source(step, 0, *k), by])
                    .collect();
                self.results(step, RowOp::Divide, values)
            }
            Op::Bump(stage) => self.parts(step, |k| match k {
                0 | 1 => Part::Of(
                    RowOp::Bump(stage, k as u8),
                    &[(0, 0), (0, 1), (1, 0), (1, 1)],
                ),
                2 => Part::Of(RowOp::Mov, &[(0, 2)]),
                _ => Part::Of(RowOp::Mov, &[(0, 3)]),
            }),
            Op::Luminance(stage) => {
                let luminance = self.source(step, 1, 2);
                let values: Vec<_> = (components.iter())
                    .map(|k| vec![self.source(step, 0, *k), luminance])
                    .collect();
                self.results(step, RowOp::Luminance(stage, step.reads), values)
            }
            Op::Reflect => self.several(step, RowOp::Reflect, &places(3)),
            Op::Sample(stage) => {
                self.several(step, RowOp::Sample(stage), &[(0, 0), (0, 1), (0, 2)])
            }
            Op::Depth => self.parts(step, |k| match k {
                0 => Part::Of(RowOp::Depth, &[(0, 0), (0, 1)]),
                _ => Part::Number(0.0),
            }),
            Op::Kill => {
                for k in WriteMask::XYZ.components() {
                    let value = self.source(step, 0, k);
                    let plain = RowFinish::Keep;
                    self.graph
                        .computed(RowOp::Kill, vec![value], plain, Model::Float);
                }
                return Vec::new();
            }
        };
        (components.into_iter().zip(results))
            .map(|(component, value)| (step.destination, component, value))
            .collect()
    }

    /// The same operation for each component of the mask, of the same component of every source.
    fn each(&mut self, step: &Step, op: RowOp, sources: usize) -> Vec<Value> {
        let values = (step.mask.components())
            .map(|k| (0..sources).map(|i| self.source(step, i, k)).collect())
            .collect();
        self.results(step, op, values)
    }

    fn results(&mut self, step: &Step, op: RowOp, sources: Vec<Vec<Value>>) -> Vec<Value> {
        (sources.into_iter())
            .map(|sources| self.graph.result(op, sources, step.result, step.writes))
            .collect()
    }

    /// One number for every component.
    fn one(&mut self, step: &Step, op: RowOp, sources: &[(usize, usize)]) -> Vec<Value> {
        let sources = (sources.iter())
            .map(|(i, k)| self.source(step, *i, *k))
            .collect();
        let value = (self.graph).result(op, sources, step.result, step.writes);
        vec![value; step.mask.count() as usize]
    }

    /// A node with as many results as components, of which those of the mask are used.
    fn several(&mut self, step: &Step, op: RowOp, sources: &[(usize, usize)]) -> Vec<Value> {
        let sources = (sources.iter())
            .map(|(i, k)| self.source(step, *i, *k))
            .collect();
        let Value { node, .. } = (self.graph).result(op, sources, step.result, step.writes);
        (step.mask.components())
            .map(|k| match k < op.results() {
                true => Value {
                    node,
                    part: k as u8,
                },
                false => self.graph.literal(0.0),
            })
            .collect()
    }

    /// Another operation for each component.
    fn parts(&mut self, step: &Step, of: impl Fn(usize) -> Part) -> Vec<Value> {
        (step.mask.components())
            .map(|k| {
                let (op, sources) = match of(k) {
                    Part::Number(number) => (RowOp::Mov, vec![self.graph.literal(number)]),
                    Part::Of(op, sources) => {
                        let source = |(i, k): &(usize, usize)| self.source(step, *i, *k);
                        (op, sources.iter().map(source).collect())
                    }
                };
                self.graph.result(op, sources, step.result, step.writes)
            })
            .collect()
    }

    /// Notes what the shader leaves.
    fn finish(mut self, kernel: &Kernel) -> Graph {
        let left: Vec<Slot> = match kernel.version.kind() {
            ShaderKind::Pixel if kernel.writes_depth() => vec![Slot::R0, Slot::DEPTH],
            ShaderKind::Pixel => vec![Slot::R0],
            ShaderKind::Vertex => (Slot::all())
                .filter(|slot| slot.is_output() && !slot.is_internal())
                .collect(),
        };
        for slot in left {
            let components = std::array::from_fn(|component| {
                // Of the depth there is one component only.
                (slot != Slot::DEPTH || component == 0).then(|| self.read(slot, component))
            });
            self.graph.outputs.push((slot, components));
        }
        self.graph
    }
}

/// A component of a result: a number, or an operation of these slots of these sources.
enum Part {
    Number(f32),
    Of(RowOp, &'static [(usize, usize)]),
}

/// The first `count` slots of the first source, and then those of the second.
fn places(count: usize) -> Vec<(usize, usize)> {
    (0..2)
        .flat_map(|i| (0..count).map(move |k| (i, k)))
        .collect()
}
