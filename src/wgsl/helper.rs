//! The functions that a translation may need, as they stand in it.

use super::by_hand::{self, ByHand};
use super::faces;
use super::number::{LARGEST, SMALLEST_NORMAL};
use super::texels::{self, Filtered, Texels, Within};
use crate::policy::{Model, OfZero};
use crate::texture::AddressMode;
use std::collections::BTreeSet;

/// A function, or a family of functions that differ in their number of components. What another one calls stands
/// before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Helper {
    /// Product of vectors with this many components (1: numbers).
    MulZero(usize),
    /// Dot product of vectors with this many components, written out.
    Dot(usize),
    /// The same with [`Helper::MulZero`].
    DotZero(usize),
    Infinity,
    Rcp(OfZero),
    Rsq(OfZero),
    Log2(OfZero),
    PartialPrecision,
    ExpP,
    LogP(OfZero),
    /// `ieee`: 0 times infinity is NaN.
    Lit {
        of_zero: OfZero,
        ieee: bool,
    },
    /// Of this many coordinates.
    Divide(usize),
    Mirror,
    /// Relative addressing of this many constants.
    ConstantAt(u32),
    CubeFace,
    AlongFace,
    OnFace,
    FaceStep,
    OutOfFace,
    AcrossEdge,
    /// A cube whose faces are filtered one by one.
    SampleFaces(Detail),
    Between,
    LevelOfDetail,
    /// The number of a texel under an address mode.
    Index(AddressMode),
    Texel(Texels),
    Within(Within, Texels),
    Filtered(Filtered),
    ByHand(ByHand),
    /// Numbers of a model, vectors with this many components.
    Held(Model, usize),
    /// The same of numbers that may be NaN.
    HeldAny(Model, usize),
    LinearFog,
    FogFactor,
    Address,
}

/// How the level of detail of a sample is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Detail {
    /// From the coordinates.
    Plain,
    /// From the coordinates and a bias.
    Bias,
    /// It is level 0.
    LevelZero,
}

impl Helper {
    /// Its name.
    pub(super) fn name(self) -> String {
        let counted = |name: &str, width: usize| match width {
            1 => name.to_string(),
            _ => format!("{name}{width}"),
        };
        match self {
            Self::MulZero(width) => counted("mul_zero", width),
            Self::Dot(width) => counted("dp", width),
            Self::DotZero(width) => format!("dp{width}_zero"),
            Self::Infinity => "infinity".into(),
            Self::Rcp(_) => "rcp".into(),
            Self::Rsq(_) => "rsq".into(),
            Self::Log2(_) => "log2_abs".into(),
            Self::PartialPrecision => "partial_precision".into(),
            Self::ExpP => "expp".into(),
            Self::LogP(_) => "logp".into(),
            Self::Lit { .. } => "lit".into(),
            Self::Divide(2) => "divide".into(),
            Self::Divide(width) => format!("divide{width}"),
            Self::Mirror => "mirror".into(),
            Self::ConstantAt(_) => "constant_at".into(),
            Self::CubeFace => "cube_face".into(),
            Self::AlongFace => "along_face".into(),
            Self::OnFace => "on_face".into(),
            Self::FaceStep => "face_step".into(),
            Self::OutOfFace => "out_of_face".into(),
            Self::AcrossEdge => "across_edge".into(),
            Self::SampleFaces(detail) => match detail {
                Detail::Plain => "sample_faces".into(),
                Detail::Bias => "sample_faces_bias".into(),
                Detail::LevelZero => "sample_faces_level_zero".into(),
            },
            Self::Between => "between".into(),
            Self::LevelOfDetail => "level_of_detail".into(),
            Self::Index(mode) => texels::index_text(mode).0.into(),
            Self::Texel(texels) => texels.name(),
            Self::Within(filter, texels) => filter.name(texels),
            Self::Filtered(filter) => filter.name(),
            Self::ByHand(sample) => sample.name(),
            Self::Held(model, 1) => model.name().into(),
            Self::Held(model, width) => format!("{model}_vec{width}"),
            Self::HeldAny(model, 1) => format!("{model}_or_0"),
            Self::HeldAny(model, width) => format!("{model}_or_0_vec{width}"),
            Self::LinearFog => "linear_fog".into(),
            Self::FogFactor => "fog_factor".into(),
            Self::Address => "address".into(),
        }
    }

    /// What it calls.
    fn needs(self) -> Vec<Helper> {
        match self {
            Self::DotZero(width) => vec![Self::MulZero(width)],
            Self::ExpP => vec![Self::PartialPrecision],
            Self::LogP(of_zero) => vec![Self::Log2(of_zero), Self::PartialPrecision],
            Self::HeldAny(model, width) => vec![Self::Held(model, width)],
            Self::Lit { of_zero, .. } => vec![Self::Log2(of_zero)],
            Self::Rcp(OfZero::Infinity)
            | Self::Rsq(OfZero::Infinity)
            | Self::Log2(OfZero::Infinity) => vec![Self::Infinity],
            Self::OnFace => vec![Self::AlongFace],
            Self::AcrossEdge => vec![Self::CubeFace, Self::AlongFace, Self::OutOfFace],
            Self::FaceStep => vec![Self::CubeFace, Self::OnFace],
            Self::SampleFaces(Detail::LevelZero) => vec![Self::CubeFace, Self::OnFace],
            Self::SampleFaces(Detail::Plain | Detail::Bias) => vec![Self::FaceStep],
            Self::Texel(texels) => texels.needs(),
            Self::Within(filter, texels) => filter.needs(texels),
            Self::Filtered(filter) => filter.needs(),
            Self::ByHand(sample) => sample.needs(),
            _ => Vec::new(),
        }
    }

    fn text(self) -> String {
        match self {
            Self::MulZero(width) => mul_zero(&self.name(), width),
            Self::Dot(width) => format!(
                "// The dot product, summed from left to right.\n\
                 fn {}(a: vec{width}f, b: vec{width}f) -> f32 {{\n    return {};\n}}\n",
                self.name(),
                sum(width, |c| format!("a.{c} * b.{c}")),
            ),
            Self::DotZero(width) => format!(
                "// The dot product of {name}.\n\
                 fn {}(a: vec{width}f, b: vec{width}f) -> f32 {{\n    let p = {name}(a, b);\n    return {};\n}}\n",
                self.name(),
                sum(width, |c| format!("p.{c}")),
                name = Self::MulZero(width).name(),
            ),
            Self::ConstantAt(count) => format!(
                "// The constant of this number; 0 outside of the constants there are.\n\
                 fn constant_at(index: i32) -> vec4f {{\n    \
                     if index < 0 || index >= {count} {{\n        return vec4f();\n    }}\n    \
                     return vs.c[index];\n}}\n"
            ),
            Self::Infinity => INFINITY.into(),
            Self::Rcp(of_zero) => format!(
                "// 1 / x; {} where x is 0.\n\
                 fn rcp(x: f32) -> f32 {{\n    \
                     return select(1.0 / x, {}, abs(x) < {SMALLEST_NORMAL});\n}}\n",
                words(of_zero),
                number_of(of_zero),
            ),
            Self::Rsq(of_zero) => format!(
                "// 1 / √|x|; {} where x is 0.\n\
                 fn rsq(x: f32) -> f32 {{\n    \
                     return select(inverseSqrt(abs(x)), {}, abs(x) < {SMALLEST_NORMAL});\n}}\n",
                words(of_zero),
                number_of(of_zero),
            ),
            Self::Log2(of_zero) => format!(
                "// log2 |x|; minus {} where x is 0.\n\
                 fn log2_abs(x: f32) -> f32 {{\n    \
                     return select(log2(abs(x)), -{}, abs(x) < {SMALLEST_NORMAL});\n}}\n",
                words(of_zero),
                number_of(of_zero),
            ),
            Self::LogP(of_zero) => format!(
                "// Exponent and mantissa of |x|, log2 |x| in partial precision, 1.\n\
                 fn logp(x: f32) -> vec4f {{\n    \
                     let v = abs(x);\n    \
                     if v < {SMALLEST_NORMAL} {{\n        return vec4f(-{least}, 1.0, -{least}, 1.0);\n    }}\n    \
                     let bits = bitcast<u32>(v);\n    \
                     if bits >= 0x7f800000u {{\n        return vec4f(v, select(1.0, v, bits > 0x7f800000u), v, 1.0); // infinity and NaN\n    }}\n    \
                     let exponent = f32(i32(bits >> 23u) - 127);\n    \
                     let mantissa = bitcast<f32>((bits & 0x007fffffu) | 0x3f800000u);\n    \
                     return vec4f(exponent, mantissa, partial_precision(log2_abs(v)), 1.0);\n}}\n",
                least = number_of(of_zero),
            ),
            Self::ExpP => format!(
                "// 2 to the power of ⌊x⌋, x - ⌊x⌋, 2 to the power of x in partial precision, 1.\n\
                 fn expp(x: f32) -> vec4f {{\n    \
                     let fraction = select(x - floor(x), 0.0, abs(x) > {LARGEST});\n    \
                     return vec4f(exp2(floor(x)), fraction, partial_precision(exp2(x)), 1.0);\n}}\n"
            ),
            Self::PartialPrecision => PARTIAL_PRECISION.into(),
            Self::Lit { ieee, .. } => lit(ieee),
            Self::Divide(width) => divide(&self.name(), width),
            Self::Mirror => MIRROR.into(),
            Self::CubeFace => faces::CUBE_FACE.into(),
            Self::AlongFace => faces::ALONG_FACE.into(),
            Self::OnFace => faces::ON_FACE.into(),
            Self::FaceStep => faces::FACE_STEP.into(),
            Self::OutOfFace => faces::OUT_OF_FACE.into(),
            Self::AcrossEdge => faces::ACROSS_EDGE.into(),
            Self::SampleFaces(detail) => faces::sample_faces(&self.name(), detail),
            Self::Between => texels::BETWEEN.into(),
            Self::LevelOfDetail => by_hand::LEVEL_OF_DETAIL.into(),
            Self::Index(mode) => texels::index_text(mode).1.into(),
            Self::Texel(texels) => texels.text(),
            Self::Within(filter, texels) => filter.text(texels),
            Self::Filtered(filter) => filter.text(),
            Self::ByHand(sample) => sample.text(),
            Self::Held(model, width) => held(&self.name(), model, width),
            Self::HeldAny(model, width) => held_any(&self.name(), model, width),
            Self::LinearFog => LINEAR_FOG.into(),
            Self::FogFactor => FOG_FACTOR.into(),
            Self::Address => ADDRESS.into(),
        }
    }
}

/// What stands for infinity where 0 is divided by, in words.
fn words(of_zero: OfZero) -> &'static str {
    match of_zero {
        OfZero::Largest => "the largest number",
        OfZero::Infinity => "infinity",
    }
}

/// The same as WGSL.
fn number_of(of_zero: OfZero) -> &'static str {
    match of_zero {
        OfZero::Largest => LARGEST,
        OfZero::Infinity => "infinity()",
    }
}

fn sum(width: usize, term: impl Fn(char) -> String) -> String {
    let terms: Vec<String> = "xyzw".chars().take(width).map(term).collect();
    terms.join(" + ")
}

fn mul_zero(name: &str, width: usize) -> String {
    let (of, zero, or) = match width {
        1 => ("f32".to_string(), "0.0".to_string(), "||"),
        _ => (format!("vec{width}f"), format!("vec{width}f()"), "|"),
    };
    format!(
        "// a * b, but 0 times anything is 0, also times infinity.\n\
         fn {name}(a: {of}, b: {of}) -> {of} {{\n    \
             return select(a * b, {zero}, (a == {zero}) {or} (b == {zero}));\n}}\n"
    )
}

const INFINITY: &str = "\
// Infinity, which no expression of constants may be.
fn infinity() -> f32 {
    var bits = 0x7f800000u;
    return bitcast<f32>(bits);
}
";

const PARTIAL_PRECISION: &str = "\
// x without its eight lowest bits.
fn partial_precision(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) & 0xffffff00u);
}
";

fn lit(ieee: bool) -> String {
    let power = "exp2(exponent * log2_abs(n_h))";
    let specular = match ieee {
        true => power.to_string(),
        false => format!("select({power}, 1.0, exponent == 0.0)"),
    };
    format!(
        "// Lighting coefficients from N·L, N·H and the power of the specular term.\n\
         fn lit(n_l: f32, n_h: f32, power: f32) -> vec4f {{\n    \
             let is_nan = (bitcast<u32>(power) & 0x7fffffffu) > 0x7f800000u;\n    \
             let exponent = select(clamp(power, -127.99609, 127.99609), 0.0, is_nan);\n    \
             let specular = {specular};\n    \
             let diffuse = select(0.0, n_l, n_l > 0.0);\n    \
             return vec4f(1.0, diffuse, select(0.0, specular, n_l > 0.0 && n_h > 0.0), 1.0);\n}}\n"
    )
}

fn divide(name: &str, width: usize) -> String {
    let (of, one) = match width {
        1 => ("f32".to_string(), "1.0".to_string()),
        _ => (format!("vec{width}f"), format!("vec{width}f(1.0)")),
    };
    format!(
        "// Coordinates over their divisor; 1 where that is 0.\n\
         fn {name}(x: {of}, y: f32) -> {of} {{\n    \
             return select(x / y, {one}, y == 0.0);\n}}\n"
    )
}

const MIRROR: &str = "\
// e mirrored at n, which need not have unit length; -e where n is 0.
fn mirror(n: vec3f, e: vec3f) -> vec3f {
    let square = dot(n, n);
    return select(2.0 * dot(n, e) / square, 0.0, square == 0.0) * n - e;
}
";

const FOG_FACTOR: &str = "\
// How clear it is, 0 to 1; NaN is clear.
fn fog_factor(f: f32) -> f32 {
    let is_nan = (bitcast<u32>(f) & 0x7fffffffu) > 0x7f800000u;
    return select(saturate(f), 1.0, is_nan);
}
";

// 2147483520 is the largest number of 32 bits that i32 has as well.
const ADDRESS: &str = "\
// x rounded down to the nearest integer that there is; 0 for NaN.
fn address(x: f32) -> i32 {
    let is_nan = (bitcast<u32>(x) & 0x7fffffffu) > 0x7f800000u;
    let whole = i32(clamp(floor(x), -2147483648.0, 2147483520.0));
    return select(select(whole, 2147483647, x >= 2147483648.0), 0, is_nan);
}
";

const LINEAR_FOG: &str = "\
// How clear it is at a distance between the start and the end of fog; a step where both are in one place.
fn linear_fog(distance: f32, start: f32, end: f32) -> f32 {
    return select((end - distance) / (end - start), f32(distance < end), start == end);
}
";

fn held(name: &str, model: Model, width: usize) -> String {
    let (of, steps) = (model.most(), model.steps().unwrap_or(1.0));
    let (kind, least, greatest) = match width {
        1 => ("f32".to_string(), format!("-{of:?}"), format!("{of:?}")),
        _ => {
            let kind = format!("vec{width}f");
            (
                kind.clone(),
                format!("{kind}(-{of:?})"),
                format!("{kind}({of:?})"),
            )
        }
    };
    format!(
        "// x as the registers of {model} hold it: -{of} to {of} in steps of 1/{steps}.\n\
         fn {name}(x: {kind}) -> {kind} {{\n    \
             return floor(clamp(x, {least}, {greatest}) * {steps:?} + 0.5) / {steps:?};\n}}\n"
    )
}

fn held_any(name: &str, model: Model, width: usize) -> String {
    let (float, whole) = match width {
        1 => ("f32".to_string(), "u32".to_string()),
        _ => (format!("vec{width}f"), format!("vec{width}u")),
    };
    let finite = Helper::Held(model, width).name();
    format!(
        "// The same; NaN, which they cannot hold, is 0.\n\
         fn {name}(x: {float}) -> {float} {{\n    \
             let is_nan = (bitcast<{whole}>(x) & {whole}(0x7fffffffu)) > {whole}(0x7f800000u);\n    \
             return select({finite}(x), {float}(), is_nan);\n}}\n"
    )
}

/// The functions that a translation needs.
#[derive(Clone, Debug, Default)]
pub(super) struct Helpers(BTreeSet<Helper>);

impl Helpers {
    /// Notes that a function is needed, with all that it calls, and gives its name.
    pub(super) fn call(&mut self, helper: Helper) -> String {
        for needed in helper.needs() {
            self.call(needed);
        }
        self.0.insert(helper);
        helper.name()
    }

    /// Takes over what another stage needs.
    pub(super) fn add(&mut self, other: &Self) {
        self.0.extend(&other.0);
    }

    /// The functions, one after the other.
    pub(super) fn text(&self) -> String {
        let texts: Vec<String> = self.0.iter().map(|helper| helper.text()).collect();
        texts.join("\n")
    }
}
