//! What a tree comes to.

use super::function::{Body, Function, truth};
use super::value::Value;
use super::{Binary, ExpressionError, Kind, Name, Node, Scope, range_text};
use crate::debug::moment::Target;
use crate::isa::{RegisterFile, ShaderKind};
use crate::isa::{ResultModifier, SourceModifier};
use crate::kernel::{MOST_VERTEX_CONSTANTS, Slot};
use crate::semantics::{self, Finish};

type Evaluated = Result<Value, ExpressionError>;

/// The value of a part of an expression. It nests no deeper than an expression has tokens.
pub(super) fn value(node: &Node, scope: &Scope<'_>) -> Evaluated {
    match &node.kind {
        Kind::Number(number) => Ok(Value::scalar(*number)),
        Kind::Name(name) => {
            named(*name, scope).map_err(|why| ExpressionError::new(node.at.clone(), why))
        }
        Kind::Indexed(index) => {
            // The whole part, as `mov a0.x` takes it.
            let number = semantics::address(single(index, scope)?) as i64;
            let index = u32::try_from(number).ok();
            Ok(Value::vector(
                index.map_or([0.0; 4], |index| scope.registers.constant(index)),
            ))
        }
        Kind::Swizzle(inner, components) => swizzle(inner, components, scope),
        Kind::Modifier(inner, modifier) => Ok(modify(value(inner, scope)?, *modifier)),
        Kind::Negate(inner) => Ok(value(inner, scope)?.map(|x| -x)),
        Kind::Not(inner) => Ok(Value::scalar(truth(!value(inner, scope)?.is_true()))),
        Kind::Binary(operator, left, right) => binary(node, *operator, left, right, scope),
        Kind::Call(function, arguments) => call(node, function, arguments, scope),
        Kind::List(parts) => list(node, parts, scope),
    }
}

fn named(name: Name, scope: &Scope<'_>) -> Result<Value, String> {
    if name == Name::Killed {
        let killed = scope.registers.killed()[scope.lane & 3];
        return Ok(Value::scalar(truth(killed)));
    }
    let listing = &scope.run.listing;
    match name.target_here(scope)? {
        Target::Constant(index) => {
            let count = scope.registers.constant_count() as u32;
            // Vertex shaders may name constants that only some devices have; they read 0.
            let most = match listing.kind() {
                ShaderKind::Vertex => count.max(MOST_VERTEX_CONSTANTS),
                ShaderKind::Pixel => count,
            };
            if index >= most {
                let version = listing.program.version;
                let there = range_text(|i| RegisterFile::Const.register_name(i), most);
                return Err(format!("{version} has no c{index}; it has {there}"));
            }
            Ok(Value::vector(scope.registers.constant(index)))
        }
        Target::Slot(Slot::DEPTH) => {
            if !listing.kernel.writes_depth() {
                return Err("this shader writes no depth".to_string());
            }
            Ok(Value::scalar(
                scope.registers.slot(Slot::DEPTH, scope.lane)[0],
            ))
        }
        Target::Slot(slot) => Ok(Value::vector(scope.registers.slot(slot, scope.lane))),
    }
}

/// A value of one component.
fn single(node: &Node, scope: &Scope<'_>) -> Result<f32, ExpressionError> {
    let value = value(node, scope)?;
    if value.count == 1 {
        return Ok(value.numbers[0]);
    }
    let message = format!(
        "one number should stand here, not {} components",
        value.count
    );
    Err(ExpressionError::new(node.at.clone(), message))
}

fn swizzle(inner: &Node, components: &[u8], scope: &Scope<'_>) -> Evaluated {
    let value = value(inner, scope)?;
    let mut numbers = [0.0; 4];
    for (number, component) in numbers.iter_mut().zip(components) {
        let component = usize::from(*component);
        if component >= value.count {
            let message = format!(
                "this has {}, and no {}",
                components_text(value.count),
                ["first", "second", "third", "fourth"][component & 3]
            );
            return Err(ExpressionError::new(inner.at.clone(), message));
        }
        *number = value.numbers[component & 3];
    }
    Ok(Value {
        numbers,
        count: components.len().clamp(1, 4),
    })
}

/// The divide modifiers give two components, as they do in `texcrd`.
fn modify(value: Value, modifier: SourceModifier) -> Value {
    let divisor = match modifier {
        SourceModifier::Dz => 2,
        SourceModifier::Dw => 3,
        _ => return value.map(|x| semantics::modify(modifier, x)),
    };
    // Of `.xyw` the third is the divisor, too: the last component fills the slots behind it.
    let divisor = value.numbers[divisor.min(value.count - 1)];
    let divided = value.map(|x| semantics::divide(x, divisor));
    Value {
        count: value.count.min(2),
        ..divided
    }
}

fn components_text(count: usize) -> String {
    match count {
        1 => "one component".to_string(),
        count => format!("{count} components"),
    }
}

fn binary(
    node: &Node,
    operator: Binary,
    left: &Node,
    right: &Node,
    scope: &Scope<'_>,
) -> Evaluated {
    let a = value(left, scope)?;
    // What stands behind a decided condition is not looked at, as in C.
    match operator {
        Binary::And if !a.is_true() => return Ok(Value::scalar(0.0)),
        Binary::Or if a.is_true() => return Ok(Value::scalar(1.0)),
        _ => {}
    }
    let b = value(right, scope)?;
    if let Binary::And | Binary::Or = operator {
        return Ok(Value::scalar(truth(b.is_true())));
    }
    let [a, b] = widened(node, [a, b])?;
    Ok(each(a.count, |c| {
        let (x, y) = (a.numbers[c], b.numbers[c]);
        match operator {
            Binary::Or | Binary::And => 0.0,
            Binary::Equal => truth(x == y),
            Binary::Unequal => truth(x != y),
            Binary::Less => semantics::slt(x, y),
            Binary::Greater => semantics::slt(y, x),
            Binary::GreaterEqual => semantics::sge(x, y),
            Binary::LessEqual => semantics::sge(y, x),
            Binary::Add => finish(x + y),
            Binary::Subtract => finish(x - y),
            Binary::Multiply => finish(semantics::mul(x, y)),
            Binary::Divide => finish(x / y),
        }
    }))
}

/// Results lose their denormal numbers, as those of instructions do.
fn finish(x: f32) -> f32 {
    Finish::new(ResultModifier::NONE).apply(x)
}

fn each(count: usize, f: impl Fn(usize) -> f32) -> Value {
    let mut numbers = [0.0; 4];
    for (c, number) in numbers.iter_mut().enumerate().take(count) {
        *number = f(c);
    }
    Value { numbers, count }
}

/// Single numbers for as many components as the others have.
fn widened<const N: usize>(node: &Node, values: [Value; N]) -> Result<[Value; N], ExpressionError> {
    let count = values.iter().map(|value| value.count).max().unwrap_or(1);
    for value in &values {
        if value.count != 1 && value.count != count {
            let message = format!(
                "{} do not fit {}",
                components_text(value.count),
                components_text(count)
            );
            return Err(ExpressionError::new(node.at.clone(), message));
        }
    }
    Ok(values.map(|value| value.widened(count)))
}

/// The sum of products from left to right.
pub(super) fn dot(a: &Value, b: &Value, count: usize) -> f32 {
    let products =
        (a.numbers.iter().zip(&b.numbers).take(count)).map(|(x, y)| semantics::mul(*x, *y));
    // Not from 0: −0 stays.
    products.reduce(|sum, product| sum + product).unwrap_or(0.0)
}

fn call(node: &Node, function: &Function, arguments: &[Node], scope: &Scope<'_>) -> Evaluated {
    let argument = |i: usize| match arguments.get(i) {
        Some(argument) => value(argument, scope),
        None => Err(ExpressionError::new(
            node.at.clone(),
            "an argument is missing",
        )),
    };
    match function.body {
        Body::One(f) => Ok(argument(0)?.map(|x| finish(f(x)))),
        Body::Whole(f) => Ok(f(argument(0)?).map(finish)),
        Body::Two(f) => {
            let [a, b] = widened(node, [argument(0)?, argument(1)?])?;
            Ok(each(a.count, |c| finish(f(a.numbers[c], b.numbers[c]))))
        }
        Body::Three(f) => {
            let [a, b, c] = widened(node, [argument(0)?, argument(1)?, argument(2)?])?;
            Ok(each(a.count, |i| {
                finish(f(a.numbers[i], b.numbers[i], c.numbers[i]))
            }))
        }
        Body::Dot(count) => {
            let wide = |i: usize| {
                let value = argument(i)?;
                if value.count != 1 && value.count < count {
                    let at = arguments
                        .get(i)
                        .map_or(0..0, |argument| argument.at.clone());
                    let message = format!(
                        "{} takes {count} components; this has {}",
                        function.name, value.count
                    );
                    return Err(ExpressionError::new(at, message));
                }
                Ok(value.widened(count))
            };
            Ok(Value::scalar(finish(dot(&wide(0)?, &wide(1)?, count))))
        }
    }
}

fn list(node: &Node, parts: &[Node], scope: &Scope<'_>) -> Evaluated {
    let mut numbers = [0.0; 4];
    let mut count = 0;
    for part in parts {
        let value = value(part, scope)?;
        for number in value.numbers.iter().take(value.count) {
            let Some(place) = numbers.get_mut(count) else {
                let message = "more than four components are put together";
                return Err(ExpressionError::new(node.at.clone(), message));
            };
            *place = *number;
            count += 1;
        }
    }
    Ok(Value { numbers, count })
}
