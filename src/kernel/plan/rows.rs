//! From values to rows: what nobody needs is left out, the same operation on several components becomes one step, and rows
//! are used again when nobody reads them any more.

use super::graph::{Graph, Node, Value};
use super::{Input, NO_ROW, Plan, Row, RowOp, RowStep, Uniform, UniformValue};
use crate::kernel::Kernel;
use std::collections::HashMap;

/// Turns a graph into a plan.
pub(super) fn place(kernel: &Kernel, graph: &Graph) -> Plan {
    let needed = needed(graph);
    let mut order: Vec<usize> = (0..graph.nodes.len())
        .filter(|node| needed[*node].iter().any(|part| *part))
        .collect();
    // What is the same everywhere comes first, and both parts stay in order.
    order.sort_by_key(|node| !graph.is_uniform(*node));
    let steps = grouped(graph, &order);
    let mut rows = Rows::new(graph, &steps);
    let mut plan = Plan {
        policies: kernel.policies,
        rows: 0,
        uniforms: Vec::new(),
        inputs: Vec::new(),
        steps: Vec::new(),
        once: 0,
        operands: Vec::new(),
        outputs: Vec::new(),
        kind: kernel.version.kind(),
    };
    for &node in &order {
        let value = match &graph.nodes[node] {
            Node::Constant(index, component) => UniformValue::Constant(*index, *component),
            Node::Literal(bits) => UniformValue::Literal(f32::from_bits(*bits)),
            _ => continue,
        };
        let row = rows.take(Value { node, part: 0 });
        plan.uniforms.push(Uniform { row, value });
    }
    for &node in &order {
        if let Node::Input {
            slot,
            component,
            flushed,
        } = graph.nodes[node]
        {
            let row = rows.take(Value { node, part: 0 });
            plan.inputs.push(Input {
                row,
                slot,
                component,
                flushed,
            });
        }
    }
    plan.inputs
        .sort_by_key(|input| (input.slot, input.component, input.flushed));
    let mut coordinates: HashMap<&[Value], usize> = HashMap::new();
    for (time, members) in steps.iter().enumerate() {
        let Some(Node::Computed {
            op,
            finish,
            writes,
            sources: first_sources,
        }) = members.first().map(|node| &graph.nodes[*node])
        else {
            continue;
        };
        let place = match op {
            RowOp::Sample(_) => {
                let next = coordinates.len();
                *coordinates.entry(first_sources).or_insert(next)
            }
            _ => 0,
        };
        let first = plan.operands.len();
        for &node in members {
            for part in 0..op.results() as u8 {
                let row = match needed[node][usize::from(part)] {
                    true => rows.take(Value { node, part }),
                    false => NO_ROW,
                };
                plan.operands.push(row);
            }
            for source in sources(graph, node) {
                plan.operands.push(rows.of(*source));
            }
        }
        // Only now: no step writes a row that it reads.
        rows.free_after(time);
        if graph.is_uniform(members[0]) {
            plan.once = plan.steps.len() + 1;
        }
        plan.steps.push(RowStep {
            op: *op,
            finish: *finish,
            writes: *writes,
            operands: first..plan.operands.len(),
            origin: graph.origins[members[0]],
            place,
        });
    }
    plan.outputs = (graph.outputs.iter())
        .map(|(slot, values)| {
            (
                *slot,
                values.map(|value| value.map_or(NO_ROW, |v| rows.of(v))),
            )
        })
        .collect();
    plan.rows = rows.count as usize;
    plan
}

fn sources(graph: &Graph, node: usize) -> &[Value] {
    match graph.nodes.get(node) {
        Some(Node::Computed { sources, .. }) => sources,
        _ => &[],
    }
}

/// Which results of each node lead to an output or discard a pixel.
fn needed(graph: &Graph) -> Vec<[bool; 4]> {
    let mut needed = vec![[false; 4]; graph.nodes.len()];
    let outputs = graph.outputs.iter().flat_map(|(_, values)| values);
    for value in outputs.flatten() {
        needed[value.node][usize::from(value.part)] = true;
    }
    for node in (0..graph.nodes.len()).rev() {
        let Node::Computed { op, .. } = &graph.nodes[node] else {
            continue;
        };
        needed[node][0] |= *op == RowOp::Kill;
        if needed[node].contains(&true) {
            for source in sources(graph, node) {
                needed[source.node][usize::from(source.part)] = true;
            }
        }
    }
    needed
}

/// The computed nodes, those together that follow each other and do the same to different rows.
fn grouped(graph: &Graph, order: &[usize]) -> Vec<Vec<usize>> {
    let mut steps: Vec<Vec<usize>> = Vec::new();
    for &node in order {
        let Node::Computed {
            op, finish, writes, ..
        } = &graph.nodes[node]
        else {
            continue;
        };
        // A sample stands for itself: what it shares with others is not the operation.
        let sample = matches!(op, RowOp::Sample(_));
        let joins = !sample
            && steps.last().is_some_and(|members| {
                let alike = members.first().is_some_and(|first| {
                matches!(&graph.nodes[*first], Node::Computed { op: o, finish: f, writes: w, .. }
                    if (o, f, w) == (op, finish, writes))
                    && graph.is_uniform(*first) == graph.is_uniform(node)
            });
                alike && !(sources(graph, node).iter()).any(|source| members.contains(&source.node))
            });
        match steps.last_mut() {
            Some(members) if joins => members.push(node),
            _ => steps.push(vec![node]),
        }
    }
    steps
}

/// Which value lies in which row.
struct Rows {
    /// The row of each result of each node.
    places: Vec<[Row; 4]>,
    /// The values that are read for the last time by each step.
    last: Vec<Vec<Value>>,
    free: Vec<Row>,
    count: Row,
}

impl Rows {
    fn new(graph: &Graph, steps: &[Vec<usize>]) -> Self {
        // Outputs are read when all is over; what is computed once must outlive the first run.
        let mut reader: Vec<[Option<usize>; 4]> = vec![[None; 4]; graph.nodes.len()];
        let once = (steps.iter())
            .take_while(|members| members.first().is_some_and(|n| graph.is_uniform(*n)))
            .count();
        for (time, members) in steps.iter().enumerate() {
            for source in members.iter().flat_map(|node| sources(graph, *node)) {
                let forever = time >= once && graph.is_uniform(source.node);
                reader[source.node][usize::from(source.part)] =
                    Some(if forever { usize::MAX } else { time });
            }
        }
        for value in graph
            .outputs
            .iter()
            .flat_map(|(_, values)| values)
            .flatten()
        {
            reader[value.node][usize::from(value.part)] = Some(usize::MAX);
        }
        let mut last = vec![Vec::new(); steps.len()];
        for (node, readers) in reader.iter().enumerate() {
            for (part, time) in (0..).zip(readers) {
                if let Some(list) = time.and_then(|time| last.get_mut(time)) {
                    list.push(Value { node, part });
                }
            }
        }
        Self {
            places: vec![[NO_ROW; 4]; graph.nodes.len()],
            last,
            free: Vec::new(),
            count: 0,
        }
    }

    /// A row for a value.
    fn take(&mut self, value: Value) -> Row {
        let row = self.free.pop().unwrap_or_else(|| {
            self.count += 1;
            self.count - 1
        });
        self.places[value.node][usize::from(value.part)] = row;
        row
    }

    fn of(&self, value: Value) -> Row {
        self.places[value.node][usize::from(value.part)]
    }

    /// Frees what no step behind this one reads.
    fn free_after(&mut self, time: usize) {
        for value in self.last.get(time).into_iter().flatten() {
            self.free
                .push(self.places[value.node][usize::from(value.part)]);
        }
    }
}
