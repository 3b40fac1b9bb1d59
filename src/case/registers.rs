//! The tables of a case whose keys are registers.

use toml::de::DeValue;

use super::read::Scope;
use super::{Expectation, Expected, Quantity};
use crate::scene::draw::numbered;
use crate::scene::error::{Problems, advice, rules};
use crate::scene::section::{At, Node, Section};

/// One to four numbers, the rest from `fill`; a single number without a list fills all four components.
pub(super) fn register(
    node: Node<'_>,
    fill: [f32; 4],
    problems: &mut Problems,
) -> Option<[f32; 4]> {
    if let DeValue::Integer(_) | DeValue::Float(_) = node.value.get_ref() {
        return node.read::<f32>(problems).map(|at| [at.value; 4]);
    }
    let numbers = components(node, 4, problems)?;
    let mut register = fill;
    for (component, number) in register.iter_mut().zip(numbers) {
        *component = number;
    }
    Some(register)
}

/// A list of one to `most` numbers.
fn components(node: Node<'_>, most: usize, problems: &mut Problems) -> Option<Vec<f32>> {
    if !matches!(node.value.get_ref(), DeValue::Array(_)) {
        let expected = match most {
            1 => "a number".to_owned(),
            _ => format!("a number, or a list of one to {most}"),
        };
        node.refuse(&expected, problems);
        return None;
    }
    let key = node.key.clone();
    let At { value, span } = node.read::<Vec<f32>>(problems)?;
    if (1..=most).contains(&value.len()) {
        return Some(value);
    }
    let count = value.len();
    let message = match most {
        1 => format!("`{key}` has {count} numbers; it is a single one"),
        _ => format!("`{key}` has {count} numbers; a register has one to {most}"),
    };
    problems.error(&rules::VALUE, span, message);
    None
}

/// Constants by number, as they follow in the file; those given twice hold what is written last.
pub(super) fn constants(
    s: &mut Section<'_>,
    key: &'static str,
    count: u32,
    problems: &mut Problems,
) -> Vec<(u32, [f32; 4])> {
    let mut constants = Vec::new();
    let Some(mut table) = s.table(key, problems) else {
        return constants;
    };
    for node in table.rest() {
        let Some(number) = numbered(&node.key, "c", count as usize) else {
            let message = format!("{} has no register `{}`", table.title, node.key);
            let help = Some(format!("there are `c0` to `c{}`", count - 1));
            problems.error_with(&rules::KEY, node.key_span, message, help);
            continue;
        };
        if let Some(value) = register(node, [0.0; 4], problems) {
            constants.push((number as u32, value));
        }
    }
    constants
}

/// A table like `expect`.
pub(super) fn expectation(
    mut table: Section<'_>,
    scope: &Scope,
    problems: &mut Problems,
) -> Expectation {
    let mut expectation = Expectation::default();
    for node in table.rest() {
        if node.key.eq_ignore_ascii_case("killed") {
            expectation.killed = node.read(problems).map(|at| at.value);
            continue;
        }
        let found = (scope.quantities.iter().copied())
            .find(|quantity| quantity.to_string().eq_ignore_ascii_case(&node.key));
        let Some(quantity) = found else {
            // Without its listing it cannot be said what the case may expect.
            if scope.known {
                let names: Vec<String> = (scope.quantities.iter().map(Quantity::to_string))
                    .chain(["killed".to_owned()])
                    .collect();
                let message = format!("{} has no `{}`", table.title, node.key);
                let help = advice(&node.key, names.iter().map(String::as_str));
                problems.error_with(&rules::KEY, node.key_span, message, help);
            }
            continue;
        };
        let most = quantity.components();
        let number = matches!(
            node.value.get_ref(),
            DeValue::Integer(_) | DeValue::Float(_)
        );
        let components = if number {
            node.read::<f32>(problems).map(|at| vec![at.value; most])
        } else {
            components(node, most, problems)
        };
        if let Some(components) = components {
            expectation.values.push(Expected {
                quantity,
                components,
            });
        }
    }
    expectation
}
