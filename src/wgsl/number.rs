//! Numbers as WGSL text.

/// A finite number in the shortest form that reads back to the same bits. Infinities and NaN have no literal: `None`.
pub(super) fn literal(value: f32) -> Option<String> {
    if !value.is_finite() {
        return None;
    }
    let text = format!("{value:?}");
    // A literal without suffix is read as a 64-bit float first, which must not lie beyond the 32-bit ones or half way
    // between two of them.
    let wide: f64 = text.parse().unwrap_or(f64::NAN);
    if wide.abs() > f64::from(f32::MAX) {
        let sign = if value < 0.0 { "-" } else { "" };
        return Some(format!("{sign}{LARGEST}"));
    }
    if (wide as f32).to_bits() == value.to_bits() {
        Some(text)
    } else {
        Some(format!("{text}f"))
    }
}

/// The largest finite number. The shortest form, 3.4028235e38, lies beyond it.
pub(super) const LARGEST: &str = "3.4028234e38";

/// The smallest number that is not denormal.
pub(super) const SMALLEST_NORMAL: &str = "1.1754944e-38";

/// A vector of four numbers as an expression that is evaluated when the shader is compiled, or `None` if one of them is
/// infinite or NaN.
pub(super) fn vector(value: [f32; 4]) -> Option<String> {
    let [x, y, z, w] = value.map(literal);
    let (x, y, z, w) = (x?, y?, z?, w?);
    if x == y && y == z && z == w {
        return Some(format!("vec4f({x})"));
    }
    Some(format!("vec4f({x}, {y}, {z}, {w})"))
}

/// The bits of four numbers as a vector of integers.
pub(super) fn bits(value: [f32; 4]) -> String {
    let [x, y, z, w] = value.map(|number| format!("{:#010x}", number.to_bits()));
    format!("vec4u({x}, {y}, {z}, {w})")
}
