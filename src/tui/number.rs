//! Numbers in little room.

/// The most characters that [`short`] takes.
pub(super) const WIDTH: usize = 7;

/// A number in at most [`WIDTH`] characters: as many decimals as there is room for, up to four, or a power of ten.
pub(super) fn short(x: f32) -> String {
    let size = x.abs();
    if x.is_nan() {
        return "NaN".to_string();
    }
    if x.is_infinite() || x == 0.0 {
        // Zero keeps its sign: 1/−0 is not 1/0.
        return format!("{x}");
    }
    if (1e-3..99999.5).contains(&size) {
        let decimals = [9.99995, 99.9995, 999.995, 9999.95];
        let decimals = decimals.iter().filter(|end| size < **end).count();
        return format!("{x:.decimals$}");
    }
    let precise = format!("{x:.1e}");
    if precise.len() <= WIDTH {
        precise
    } else {
        format!("{x:.0e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_to_what_fits() {
        let shown = [
            (0.25, "0.2500"),
            (-0.12346, "-0.1235"),
            (9.99996, "10.000"),
            (-12.3456, "-12.346"),
            (1024.0, "1024.0"),
            (-99999.0, "-99999"),
            (123_456.0, "1.2e5"),
            (-1.5e-7, "-1.5e-7"),
            (-1.6e-12, "-2e-12"),
            (0.0, "0"),
            (-0.0, "-0"),
            (f32::NAN, "NaN"),
            (f32::NEG_INFINITY, "-inf"),
        ];
        for (number, text) in shown {
            assert_eq!(short(number), text);
        }
    }

    #[test]
    fn every_number_fits() {
        for bits in (0..=u32::MAX).step_by(99_991) {
            let number = f32::from_bits(bits);
            let text = short(number);
            assert!(text.len() <= WIDTH, "{number:e}: {text}");
        }
    }
}
