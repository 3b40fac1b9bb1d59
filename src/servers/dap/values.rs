//! Registers and numbers as a person reads and writes them.

use texcrd::debug::{Format, Listing, Target, Value};
use texcrd::isa::{RegisterFile, ShaderKind, Version, WriteMask};
use texcrd::kernel::{Kernel, Slot};

/// What stands between a value and what is to be said about it.
const MARK: &str = " ← ";

/// A register as expressions name it: texture coordinates of `ps.1.0` to `ps.1.3` are `tc#`, since `t#` is what was sampled.
pub(super) fn name(target: Target, listing: &Listing<'_>) -> String {
    let version = listing.program.version;
    match target {
        Target::Constant(index) => RegisterFile::Const.register_name(index),
        Target::Slot(slot) => match slot.texcoord_index() {
            Some(index) if version != Version::Ps14 => format!("tc{index}"),
            _ => slot.name(version.kind()),
        },
    }
}

/// The components of a register that mean something.
pub(super) fn components(slot: Slot, kernel: &Kernel) -> WriteMask {
    match slot {
        Slot::ADDRESS | Slot::DEPTH => WriteMask::X,
        Slot::FOG => WriteMask::component(kernel.fog_component),
        Slot::POINT_SIZE => WriteMask::component(kernel.point_size_component),
        _ => WriteMask::ALL,
    }
}

/// A register's components as expressions name them.
pub(super) fn masked(name: &str, target: Target, mask: WriteMask, kind: ShaderKind) -> String {
    if mask == WriteMask::ALL || target == Target::Slot(Slot::DEPTH) {
        return name.to_string();
    }
    format!("{name}{}", mask.text(texcrd::program::letters(kind)))
}

/// Numbers as the client wants them.
pub(super) fn format(hex: bool) -> Format {
    match hex {
        true => Format::Hex,
        false => Format::Float,
    }
}

/// The components of a mask, in their order.
pub(super) fn picked(numbers: [f32; 4], mask: WriteMask) -> Value {
    let mut value = Value {
        numbers: [0.0; 4],
        count: 0,
    };
    for c in mask.components() {
        value.numbers[value.count & 3] = numbers[c];
        value.count += 1;
    }
    value
}

/// A value with what is to be said about it behind it.
pub(super) fn with_marks(value: &Value, hex: bool, marks: &[String]) -> String {
    let mut text = value.text(format(hex));
    let numbers = value.components();
    let born = [
        ("NaN", numbers.iter().any(|x| x.is_nan())),
        ("infinite", numbers.iter().any(|x| x.abs() >= f32::MAX)),
    ];
    let born = born.into_iter().filter(|(_, is)| *is);
    let marks: Vec<&str> = (marks.iter().map(String::as_str))
        .chain(born.map(|(mark, _)| mark))
        .collect();
    if !marks.is_empty() {
        text.push_str(MARK);
        text.push_str(&marks.join(", "));
    }
    text
}

/// What a person wants in a register, as commands take it: what was shown can be edited and come back with its marks, or as the
/// 32 bits of each number.
pub(super) fn written(text: &str) -> String {
    let text = text.split(MARK.trim()).next().unwrap_or_default().trim();
    match numbers(text) {
        Some(value) => value.text(Format::Float),
        None => text.to_string(),
    }
}

/// One to four numbers with commas between them.
fn numbers(text: &str) -> Option<Value> {
    let mut value = Value {
        numbers: [0.0; 4],
        count: 0,
    };
    for part in text.split(',') {
        *value.numbers.get_mut(value.count)? = number(part.trim())?;
        value.count += 1;
    }
    Some(value)
}

fn number(text: &str) -> Option<f32> {
    let bits = text.strip_prefix("0x").or(text.strip_prefix("0X"));
    match bits {
        Some(bits) => u32::from_str_radix(bits, 16).ok().map(f32::from_bits),
        None => text.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_from_what_is_shown() {
        for numbers in [
            [1.0, -0.5, 1e-30, 3e38],
            [f32::INFINITY, f32::NAN, -0.0, f32::MAX],
        ] {
            let value = Value::vector(numbers);
            for hex in [false, true] {
                let shown = with_marks(&value, hex, &["changed".to_string()]);
                let text = shown.split(MARK).next().unwrap();
                let back = super::numbers(text).unwrap();
                assert_eq!(
                    back.numbers.map(f32::to_bits),
                    numbers.map(f32::to_bits),
                    "{shown}"
                );
            }
        }
        assert_eq!(super::numbers("1, 2, 3, 4, 5"), None);
        assert_eq!(super::numbers(""), None);
        assert_eq!(super::numbers("0x100000000"), None);
    }

    #[test]
    fn what_is_remarkable_is_said() {
        let text = |numbers| with_marks(&Value::vector(numbers), false, &[]);
        assert_eq!(text([1.0, 0.25, 0.0, -2.0]), "1, 0.25, 0, -2");
        assert!(text([1.0, f32::NAN, 0.0, 0.0]).ends_with(" ← NaN"));
        // What rcp of 0 gives.
        assert!(text([f32::MAX, 0.0, 0.0, 0.0]).ends_with(" ← infinite"));
    }
}
