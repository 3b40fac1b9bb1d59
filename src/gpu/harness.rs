//! Entry points that run the functions of a translation for one invocation a pixel.

use std::fmt::Write as _;

use crate::wgsl::{Observed, Reflection, StageReflection, Translation};

const VERTEX: &str = "invocation_vertex";
const PIXEL: &str = "invocation_pixel";
/// Locations of what goes to the pixel stage beside the varyings, which end at 12.
const ROW: u32 = 13;
const SEEN: u32 = 14;
const W: u32 = 15;

/// What is drawn of an invocation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Look {
    /// The colour, as one pixel.
    Color,
    /// Several pixels in place of it: see [`Rows`].
    Registers,
}

/// The pixels of an invocation, from the left.
///
/// Where there is a pixel shader the first one is white if the pixel is not discarded, and the second one has what the
/// shader returns. Then come the registers of the vertex shader and those of the pixel shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rows {
    /// Where the registers of the vertex shader begin.
    pub(super) vertex: usize,
    /// Where those of the pixel shader begin.
    pub(super) pixel: usize,
    /// How many pixels there are.
    pub(super) count: usize,
}

impl Rows {
    /// Whether the first two pixels are those of a pixel shader.
    pub(super) fn has_pixel(self) -> bool {
        self.vertex >= 2
    }

    pub(super) fn of(translation: &Translation, look: Look) -> Self {
        let reflection = &translation.reflection;
        let has_pixel = reflection.pixel.is_some();
        let none = Observed::default();
        let observed = reflection.baked.observed.as_ref().unwrap_or(&none);
        let (vertex, pixel) = match look {
            Look::Color => {
                return Self {
                    vertex: 1,
                    pixel: 1,
                    count: 1,
                };
            }
            Look::Registers => (observed.vertex.len(), observed.pixel.len()),
        };
        let first = if has_pixel { 2 } else { 0 };
        Self {
            vertex: first,
            pixel: first + vertex,
            count: (first + vertex + pixel).max(1),
        }
    }
}

/// The locations that the attributes of an invocation are fed to: registers of the vertex shader, or varyings.
pub(super) fn locations(reflection: &Reflection) -> Vec<u32> {
    match reflection.vertex {
        Some(_) => reflection
            .inputs
            .iter()
            .map(|input| input.register)
            .collect(),
        None => reflection
            .varyings
            .iter()
            .map(|varying| varying.location)
            .collect(),
    }
}

/// The translation with entry points. Every pixel of a picture of this size is a primitive of its own, whose values
/// are constant; instance i of a draw begins at pixel i times the number of rows.
pub(super) fn with_entries(
    translation: &Translation,
    look: Look,
    [width, height]: [u32; 2],
) -> Translation {
    let rows = Rows::of(translation, look);
    let reflection = &translation.reflection;
    let mut source = translation.source.clone();
    source.push('\n');
    // Writing to a text does not fail.
    let _ = interface(&mut source, reflection);
    let _ = vertex_entry(&mut source, reflection, rows, [width, height]);
    let _ = pixel_entry(&mut source, reflection, rows, look);
    let mut complete = translation.clone();
    complete.source = source;
    let named = |stage: &Option<StageReflection>, entry: &str| {
        let any = stage
            .as_ref()
            .or(reflection.vertex.as_ref())
            .or(reflection.pixel.as_ref());
        any.map(|stage| StageReflection {
            entry: entry.into(),
            ..stage.clone()
        })
    };
    complete.reflection.vertex = named(&reflection.vertex, VERTEX);
    complete.reflection.pixel = named(&reflection.pixel, PIXEL);
    complete
}

fn type_of(components: usize) -> String {
    match components {
        1 => "f32".into(),
        count => format!("vec{count}f"),
    }
}

/// What goes in without a vertex shader, and what goes from stage to stage. Nothing is interpolated, so that infinities
/// and NaN pass as well.
fn interface(text: &mut String, reflection: &Reflection) -> std::fmt::Result {
    if reflection.vertex.is_none() && !reflection.varyings.is_empty() {
        writeln!(text, "struct InvocationInput {{")?;
        for varying in &reflection.varyings {
            writeln!(
                text,
                "    @location({}) {}: vec4f,",
                varying.location, varying.name
            )?;
        }
        writeln!(text, "}}\n")?;
    }
    writeln!(
        text,
        "struct Invocation {{\n    @builtin(position) place: vec4f,"
    )?;
    for varying in &reflection.varyings {
        let (location, name, of) = (varying.location, &varying.name, type_of(varying.components));
        writeln!(
            text,
            "    @location({location}) @interpolate(flat) {name}: {of},"
        )?;
    }
    writeln!(text, "    @location({ROW}) @interpolate(flat) row: u32,")?;
    // The place of the pixel has a w of 1; this is 1 over that of the position.
    writeln!(
        text,
        "    @location({W}) @interpolate(flat) inverse_w: f32,"
    )?;
    writeln!(
        text,
        "    @location({SEEN}) @interpolate(flat) seen: vec4f,\n}}\n"
    )
}

fn vertex_entry(
    text: &mut String,
    reflection: &Reflection,
    rows: Rows,
    [width, height]: [u32; 2],
) -> std::fmt::Result {
    let fed = !locations(reflection).is_empty();
    let input = match (&reflection.vertex, fed) {
        (_, false) => "",
        (Some(_), true) => ", in: VertexInput",
        (None, true) => ", in: InvocationInput",
    };
    writeln!(
        text,
        "@vertex\nfn {VERTEX}(@builtin(vertex_index) corner: u32, @builtin(instance_index) i: u32{input}) -> Invocation {{"
    )?;
    writeln!(text, "    var out: Invocation;\n    var depth = 0.0;")?;
    match &reflection.vertex {
        Some(stage) => {
            let arguments = if fed { "in" } else { "" };
            writeln!(text, "    let shaded = {}({arguments});", stage.entry)?;
            // Nothing is clipped: a depth beyond the ends is taken to them, as is one that is no number.
            writeln!(text, "    let z = shaded.position.z / shaded.position.w;")?;
            writeln!(
                text,
                "    depth = select(select(0.0, z, z > 0.0), 1.0, z >= 1.0);"
            )?;
            for varying in &reflection.varyings {
                writeln!(text, "    out.{0} = shaded.{0};", varying.name)?;
            }
        }
        None => {
            for varying in &reflection.varyings {
                let kept: String = "xyzw".chars().take(varying.components).collect();
                writeln!(text, "    out.{0} = in.{0}.{kept};", varying.name)?;
            }
        }
    }
    writeln!(text, "    out.row = corner / 3u;")?;
    let w = match &reflection.vertex {
        Some(_) => "1.0 / shaded.position.w",
        None => "1.0",
    };
    writeln!(text, "    out.inverse_w = {w};")?;
    if rows.pixel > rows.vertex {
        let (first, end) = (rows.vertex, rows.pixel);
        writeln!(text, "    if out.row >= {first}u && out.row < {end}u {{")?;
        writeln!(
            text,
            "        out.seen = {}[out.row - {first}u];\n    }}",
            Observed::VERTEX
        )?;
    }
    // A triangle around the centre of the pixel that reaches no other centre.
    writeln!(
        text,
        "    let pixel = i * {}u + out.row;
    let inside = array(vec2f(0.5, 0.125), vec2f(0.875, 0.875), vec2f(0.125, 0.875))[corner % 3u];
    let at = (vec2f(f32(pixel % {width}u), f32(pixel / {width}u)) + inside) / vec2f({width}.0, {height}.0);
    out.place = vec4f(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, depth, 1.0);
    return out;
}}
",
        rows.count
    )
}

fn pixel_entry(
    text: &mut String,
    reflection: &Reflection,
    rows: Rows,
    look: Look,
) -> std::fmt::Result {
    let Some(stage) = &reflection.pixel else {
        return writeln!(
            text,
            "@fragment\nfn {PIXEL}(in: Invocation) -> @location(0) vec4f {{\n    return in.seen;\n}}"
        );
    };
    let result = match stage.writes_depth {
        true => "PixelOutput",
        false => "@location(0) vec4f",
    };
    writeln!(text, "@fragment\nfn {PIXEL}(in: Invocation) -> {result} {{")?;
    let mut argument = "";
    if reflection.position || !reflection.varyings.is_empty() {
        argument = "varyings";
        writeln!(text, "    var varyings: Varyings;")?;
        if reflection.position {
            writeln!(
                text,
                "    varyings.position = vec4f(in.place.xyz, in.inverse_w);"
            )?;
        }
        for varying in &reflection.varyings {
            writeln!(text, "    varyings.{0} = in.{0};", varying.name)?;
        }
    }
    if stage.discards && look == Look::Registers {
        writeln!(text, "    keep = in.row != 0u;")?;
    }
    writeln!(text, "    let shaded = {}({argument});", stage.entry)?;
    if look == Look::Color {
        return writeln!(text, "    return shaded;\n}}");
    }
    let color = match stage.writes_depth {
        true => "shaded.color",
        false => "shaded",
    };
    writeln!(text, "    var seen = in.seen;")?;
    writeln!(
        text,
        "    if in.row == 0u {{\n        seen = vec4f(1.0);\n    }}"
    )?;
    writeln!(
        text,
        "    if in.row == 1u {{\n        seen = {color};\n    }}"
    )?;
    if rows.count > rows.pixel {
        let first = rows.pixel;
        writeln!(text, "    if in.row >= {first}u {{")?;
        writeln!(
            text,
            "        seen = {}[in.row - {first}u];\n    }}",
            Observed::PIXEL
        )?;
    }
    match stage.writes_depth {
        true => writeln!(text, "    return PixelOutput(seen, shaded.depth);\n}}"),
        false => writeln!(text, "    return seen;\n}}"),
    }
}
