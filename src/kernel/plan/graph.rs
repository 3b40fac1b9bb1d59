//! Components as values: each is computed once and never changes.

use super::{RowFinish, RowOp};
use crate::isa::{ResultModifier, SourceModifier};
use crate::kernel::Slot;
use crate::policy::Model;
use std::collections::HashMap;

/// One result of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Value {
    pub(super) node: usize,
    /// Which of the results of the node.
    pub(super) part: u8,
}

/// Where values come from.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Node {
    /// A component of a slot that is loaded from outside; with denormal numbers taken to zero or as it is.
    Input {
        slot: Slot,
        component: u8,
        flushed: bool,
    },
    /// A component of a constant.
    Constant(u32, u8),
    /// A number, by its bits.
    Literal(u32),
    /// What an operation makes of others.
    Computed {
        op: RowOp,
        sources: Vec<Value>,
        finish: RowFinish,
        writes: Model,
    },
}

/// All values of a shader in the order in which they can be computed.
#[derive(Default)]
pub(super) struct Graph {
    pub(super) nodes: Vec<Node>,
    /// The instruction that each node came from.
    pub(super) origins: Vec<usize>,
    known: HashMap<Node, usize>,
    facts: Vec<Facts>,
    /// What is left at the end.
    pub(super) outputs: Vec<(Slot, [Option<Value>; 4])>,
    /// The instruction that is being added.
    pub(super) origin: usize,
}

/// What is known of a value without knowing it.
#[derive(Clone, Copy, Default)]
struct Facts {
    /// It is no denormal number.
    normal: bool,
    /// It lies on a step of this model.
    held: Option<Model>,
    /// It is the same in all lanes and all batches of a draw.
    uniform: bool,
}

impl Graph {
    fn facts(&self, value: Value) -> Facts {
        self.facts.get(value.node).copied().unwrap_or_default()
    }

    /// Whether all results of a node are the same in all lanes and all batches of a draw.
    pub(super) fn is_uniform(&self, node: usize) -> bool {
        self.facts.get(node).is_some_and(|facts| facts.uniform)
    }

    fn add(&mut self, node: Node, facts: Facts) -> Value {
        let next = self.nodes.len();
        let place = *self.known.entry(node.clone()).or_insert(next);
        if place == next {
            self.nodes.push(node);
            self.facts.push(facts);
            self.origins.push(self.origin);
        }
        Value {
            node: place,
            part: 0,
        }
    }

    pub(super) fn input(&mut self, slot: Slot, component: u8, flushed: bool) -> Value {
        let facts = Facts {
            normal: flushed,
            ..Facts::default()
        };
        self.add(
            Node::Input {
                slot,
                component,
                flushed,
            },
            facts,
        )
    }

    pub(super) fn constant(&mut self, index: u32, component: u8) -> Value {
        let facts = Facts {
            uniform: true,
            ..Facts::default()
        };
        self.add(Node::Constant(index, component), facts)
    }

    pub(super) fn literal(&mut self, number: f32) -> Value {
        let facts = Facts {
            normal: !number.is_subnormal(),
            uniform: true,
            held: None,
        };
        self.add(Node::Literal(number.to_bits()), facts)
    }

    /// A value as a step reads it: behind a source modifier, as numbers of a model.
    pub(super) fn operand(&mut self, model: Model, modifier: SourceModifier, of: Value) -> Value {
        let as_it_is = matches!(
            modifier,
            SourceModifier::None | SourceModifier::Dz | SourceModifier::Dw
        );
        let op = match model {
            Model::Float if as_it_is => return of,
            _ if as_it_is && self.facts(of).held == Some(model) => return of,
            Model::Float => RowOp::Modify(modifier),
            model => RowOp::Operand(model, modifier),
        };
        self.computed(op, vec![of], RowFinish::Keep, Model::Float)
    }

    /// The result of a step behind its result modifier, as numbers of a model.
    pub(super) fn result(
        &mut self,
        op: RowOp,
        mut sources: Vec<Value>,
        modifier: ResultModifier,
        writes: Model,
    ) -> Value {
        let mut op = op;
        // IEEE 754: a + (−b) and a − b are the same number.
        match (op, self.negated(&sources, 1), self.negated(&sources, 0)) {
            (RowOp::Add, Some(b), _) => {
                op = RowOp::Sub;
                sources[1] = b;
            }
            (RowOp::Add, None, Some(a)) => {
                op = RowOp::Sub;
                sources = vec![sources[1], a];
            }
            (RowOp::Sub, Some(b), _) => {
                op = RowOp::Add;
                sources[1] = b;
            }
            _ => {}
        }
        let plain = modifier == ResultModifier::NONE;
        if op == RowOp::Mov
            && plain
            && let Some(&source) = sources.first()
        {
            let facts = self.facts(source);
            let fits = writes == Model::Float || facts.held == Some(writes);
            if fits && facts.normal {
                return source;
            }
            if writes == Model::Float
                && let Some(Node::Input {
                    slot, component, ..
                }) = self.nodes.get(source.node)
            {
                let (slot, component) = (*slot, *component);
                return self.input(slot, component, true);
            }
        }
        let finish = match plain {
            true if self.is_normal(op, &sources) => RowFinish::Keep,
            true => RowFinish::Flush,
            false => RowFinish::Full(modifier),
        };
        self.computed(op, sources, finish, writes)
    }

    /// What source `i` is the negative of, as floats.
    fn negated(&self, sources: &[Value], i: usize) -> Option<Value> {
        match self.nodes.get(sources.get(i)?.node)? {
            Node::Computed {
                op: RowOp::Modify(SourceModifier::Negate),
                sources,
                ..
            } => sources.first().copied(),
            _ => None,
        }
    }

    /// Whether a result cannot be a denormal number.
    fn is_normal(&self, op: RowOp, sources: &[Value]) -> bool {
        let given = sources.iter().all(|source| self.facts(*source).normal);
        match op {
            RowOp::Slt | RowOp::Sge | RowOp::Address => true,
            // One of the sources; a fraction is the source itself or a multiple of its last bit.
            RowOp::Mov | RowOp::Min | RowOp::Max | RowOp::Frc => given,
            RowOp::Cnd | RowOp::Cmp => {
                (sources.iter().skip(1)).all(|source| self.facts(*source).normal)
            }
            _ => false,
        }
    }

    pub(super) fn computed(
        &mut self,
        op: RowOp,
        sources: Vec<Value>,
        finish: RowFinish,
        writes: Model,
    ) -> Value {
        let of = |value: &Value| self.facts(*value);
        let normal = match op {
            _ if writes != Model::Float || finish != RowFinish::Keep => true,
            RowOp::Operand(..) => true,
            RowOp::Modify(modifier) => match modifier {
                // Sums with a half or one are multiples of 2⁻²⁵, or far from zero.
                SourceModifier::Bias
                | SourceModifier::BiasNegate
                | SourceModifier::Bx2
                | SourceModifier::Bx2Negate
                | SourceModifier::Complement => true,
                _ => sources.iter().all(|source| of(source).normal),
            },
            _ => self.is_normal(op, &sources),
        };
        let held = match op {
            RowOp::Operand(model, SourceModifier::None) => Some(model),
            _ => Some(writes).filter(|writes| *writes != Model::Float),
        };
        let facts = Facts {
            normal,
            held,
            uniform: !matches!(op, RowOp::Sample(_) | RowOp::Kill)
                && sources.iter().all(|source| of(source).uniform),
        };
        let node = Node::Computed {
            op,
            sources,
            finish,
            writes,
        };
        self.add(node, facts)
    }
}
