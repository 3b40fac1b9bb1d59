//! Plots as SVG.

use std::fmt::Write;

/// A line of a plot.
pub(crate) struct Line {
    pub(crate) name: String,
    pub(crate) points: Vec<[f64; 2]>,
}

/// What stands at an axis, and how far it goes from 0.
pub(crate) struct Axis {
    pub(crate) name: &'static str,
    pub(crate) end: f64,
    pub(crate) step: f64,
    /// What stands at a number of it.
    pub(crate) label: fn(f64) -> String,
}

const SIZE: [f64; 2] = [640.0, 400.0];
/// Left, top, right and bottom of the field of lines.
const FIELD: [f64; 4] = [64.0, 16.0, 624.0, 344.0];
const COLORS: [&str; 5] = ["#0b6fb8", "#c8431f", "#3a8f3a", "#8a4fb0", "#8a6d1f"];

/// Draws lines above one horizontal axis.
pub(crate) fn plot(across: &Axis, up: &Axis, lines: &[Line]) -> String {
    let [left, top, right, bottom] = FIELD;
    let x = |value: f64| left + value / across.end * (right - left);
    let y = |value: f64| bottom - (value / up.end).min(1.0) * (bottom - top);
    let [width, height] = SIZE;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"13\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    let mut put = |text: std::fmt::Arguments<'_>| {
        // Nothing can go wrong when a string is written to.
        let _ = writeln!(svg, "{text}");
    };
    for number in 0..=(across.end / across.step) as u32 {
        let value = f64::from(number) * across.step;
        let (at, below) = (x(value), bottom + 18.0);
        put(format_args!(
            "<path d=\"M{at:.1} {top}V{bottom}\" stroke=\"#dddddd\"/>\
             <text x=\"{at:.1}\" y=\"{below}\" text-anchor=\"middle\">{}</text>",
            (across.label)(value)
        ));
    }
    for number in 0..=(up.end / up.step) as u32 {
        let value = f64::from(number) * up.step;
        let (at, before) = (y(value), left - 8.0);
        put(format_args!(
            "<path d=\"M{left} {at:.1}H{right}\" stroke=\"#dddddd\"/>\
             <text x=\"{before}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            at + 4.0,
            (up.label)(value)
        ));
    }
    let middle = f64::midpoint(left, right);
    put(format_args!(
        "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
        height - 10.0,
        across.name
    ));
    let middle = f64::midpoint(top, bottom);
    put(format_args!(
        "<text transform=\"translate(18 {middle}) rotate(-90)\" text-anchor=\"middle\">{}</text>",
        up.name
    ));
    for (number, line) in lines.iter().enumerate() {
        let color = COLORS[number % COLORS.len()];
        let points: Vec<_> = (line.points.iter())
            .map(|[across, up]| format!("{:.1},{:.1}", x(*across), y(*up)))
            .collect();
        let points = points.join(" ");
        let row = top + 20.0 + 18.0 * number as f64;
        let (from, to, text) = (left + 14.0, left + 38.0, left + 44.0);
        put(format_args!(
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"2\"/>\n\
             <path d=\"M{from} {row}H{to}\" stroke=\"{color}\" stroke-width=\"2\"/>\
             <text x=\"{text}\" y=\"{}\">{}</text>",
            row + 4.0,
            line.name
        ));
    }
    svg.push_str("</svg>\n");
    svg
}
