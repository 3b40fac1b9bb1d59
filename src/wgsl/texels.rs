//! Functions that read texels: one by its numbers, a filter within a level, a filter between levels. They do what
//! [`crate::texture::sample_quads`] does, step by step.

use super::helper::Helper;
use crate::texture::{AddressMode, MipFilter};

/// How texels are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Texels {
    pub(super) shape: Shape,
    /// Of axes that the texture does not have always wrap.
    pub(super) address: [AddressMode; 3],
    /// Whether texels are bytes, filtered as numbers from 0 to 255.
    pub(super) bytes: bool,
}

/// What a texture is bound as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Shape {
    Flat,
    Volume,
    /// A cube whose faces end at their edges.
    Faces,
    /// A cube whose faces go on behind their edges.
    Seamless,
}

/// A filter within a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Within {
    Point,
    Linear,
    /// Linear with weights of 8 bits.
    Coarse,
}

/// A filter within and between levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Filtered {
    pub(super) texels: Texels,
    pub(super) within: Within,
    pub(super) mip: MipFilter,
    /// Whether levels are blended with weights of 8 bits.
    pub(super) coarse: bool,
}

impl Texels {
    pub(super) fn is_cube(self) -> bool {
        matches!(self.shape, Shape::Faces | Shape::Seamless)
    }

    /// How many numbers a place has, beside the face.
    pub(super) fn width(self) -> usize {
        match self.shape {
            Shape::Volume => 3,
            Shape::Flat | Shape::Faces | Shape::Seamless => 2,
        }
    }

    fn axes(self) -> impl Iterator<Item = (char, AddressMode)> {
        let count = if self.is_cube() { 0 } else { self.width() };
        "xyz".chars().zip(self.address).take(count)
    }

    pub(super) fn has_border(self) -> bool {
        self.axes().any(|(_, mode)| mode == AddressMode::Border)
    }

    /// What tells the functions of these texels from others.
    pub(super) fn suffix(self) -> String {
        let mut text = match self.shape {
            Shape::Flat => String::new(),
            Shape::Volume => "_volume".into(),
            Shape::Faces => "_faces".into(),
            Shape::Seamless => "_cube".into(),
        };
        let modes: Vec<AddressMode> = self.axes().map(|(_, mode)| mode).collect();
        let all_same = modes.windows(2).all(|pair| pair[0] == pair[1]);
        for mode in modes.iter().take(if all_same { 1 } else { modes.len() }) {
            text += &format!("_{mode}");
        }
        if self.bytes {
            text += "_bytes";
        }
        text
    }

    /// The texture as a parameter.
    pub(super) fn texture(self) -> &'static str {
        match self.shape {
            Shape::Flat => "t: texture_2d<f32>",
            Shape::Volume => "t: texture_3d<f32>",
            Shape::Faces | Shape::Seamless => "t: texture_2d_array<f32>",
        }
    }

    /// `, face` where there are faces.
    pub(super) fn face(self, text: &'static str) -> &'static str {
        if self.is_cube() { text } else { "" }
    }

    /// `, border` where there is one.
    pub(super) fn border(self, text: &'static str) -> &'static str {
        if self.has_border() { text } else { "" }
    }

    pub(super) fn name(self) -> String {
        format!("texel{}", self.suffix())
    }

    pub(super) fn needs(self) -> Vec<Helper> {
        match self.shape {
            Shape::Faces => Vec::new(),
            Shape::Seamless => vec![Helper::AcrossEdge],
            Shape::Flat | Shape::Volume => {
                let modes = self.axes().map(|(_, mode)| mode);
                modes.filter_map(index_function).collect()
            }
        }
    }

    pub(super) fn text(self) -> String {
        let number = |texel: String| match self.bytes {
            true => format!("round(255.0 * {texel})"),
            false => texel,
        };
        let about = if self.bytes { ", 0 to 255" } else { "" };
        let head = format!(
            "fn {}({}, i: vec{w}i{}, level: i32{}) -> vec4f {{\n",
            self.name(),
            self.texture(),
            self.face(", face: u32"),
            self.border(", border: vec4f"),
            w = self.width(),
        );
        match self.shape {
            Shape::Faces => format!(
                "// A texel of a face of a cube{about}; outside the nearest one inside.\n{head}    \
                     let last = vec2i(textureDimensions(t, level)) - 1;\n    \
                     return {};\n}}\n",
                number("textureLoad(t, clamp(i, vec2i(), last), face, level)".into()),
            ),
            Shape::Seamless => format!(
                "// A texel of a face of a cube{about}; beyond an edge the neighbour's, beyond a corner the mean of three.\n\
                 {head}    \
                     let n = i32(textureDimensions(t, level).x);\n    \
                     let inside = clamp(i, vec2i(), vec2i(n - 1));\n    \
                     let own = {own};\n    \
                     if all(i == inside) {{\n        return own;\n    }}\n    \
                     if any(i == inside) {{\n        \
                         let there = across_edge(face, i, n);\n        \
                         return {there};\n    }}\n    \
                     let beside = across_edge(face, vec2i(i.x, inside.y), n);\n    \
                     let above = across_edge(face, vec2i(inside.x, i.y), n);\n    \
                     return (own + {beside} + {above}) / 3.0;\n}}\n",
                own = number("textureLoad(t, inside, face, level)".into()),
                there = number("textureLoad(t, there.xy, there.z, level)".into()),
                beside = number("textureLoad(t, beside.xy, beside.z, level)".into()),
                above = number("textureLoad(t, above.xy, above.z, level)".into()),
            ),
            Shape::Flat | Shape::Volume => {
                let place: Vec<String> = self
                    .axes()
                    .map(|(axis, mode)| match index_function(mode) {
                        Some(function) => format!("{}(i.{axis}, n.{axis})", function.name()),
                        None => format!("clamp(i.{axis}, 0, n.{axis} - 1)"),
                    })
                    .collect();
                let modes: Vec<String> = (self.axes())
                    .zip("uvw".chars())
                    .map(|((_, mode), axis)| format!("{axis} {mode}"))
                    .collect();
                let w = self.width();
                let texel = number("textureLoad(t, place, level)".into());
                let value = match self.has_border() {
                    false => texel,
                    true => {
                        let outside: Vec<String> = (self.axes())
                            .filter(|(_, mode)| *mode == AddressMode::Border)
                            .map(|(axis, _)| format!("place.{axis} != i.{axis}"))
                            .collect();
                        let border = if self.bytes {
                            "255.0 * border"
                        } else {
                            "border"
                        };
                        format!("select({texel}, {border}, {})", outside.join(" || "))
                    }
                };
                format!(
                    "// A texel{about}, by its number on each axis: {}.\n{head}    \
                         let n = vec{w}i(textureDimensions(t, level));\n    \
                         let place = vec{w}i({});\n    \
                         return {value};\n}}\n",
                    modes.join(", "),
                    place.join(", "),
                )
            }
        }
    }
}

/// The function that brings the number of a texel inside; none where `clamp` does.
fn index_function(mode: AddressMode) -> Option<Helper> {
    match mode {
        AddressMode::Clamp | AddressMode::Border => None,
        AddressMode::Wrap | AddressMode::Mirror | AddressMode::MirrorOnce => {
            Some(Helper::Index(mode))
        }
    }
}

/// Name and text of the function of an address mode.
pub(super) fn index_text(mode: AddressMode) -> (&'static str, &'static str) {
    match mode {
        AddressMode::Mirror => (
            "mirrored",
            "// The number of a texel among n, every other repetition backwards.\n\
             fn mirrored(i: i32, n: i32) -> i32 {\n    \
                 let k = (i % (2 * n) + 2 * n) % (2 * n);\n    \
                 return min(k, 2 * n - 1 - k);\n}\n",
        ),
        AddressMode::MirrorOnce => (
            "mirrored_once",
            "// The number of a texel among n, mirrored at 0, the last one beyond.\n\
             fn mirrored_once(i: i32, n: i32) -> i32 {\n    \
                 return min(select(i, -1 - i, i < 0), n - 1);\n}\n",
        ),
        AddressMode::Wrap | AddressMode::Clamp | AddressMode::Border => (
            "wrapped",
            "// The number of a texel among n, again and again.\n\
             fn wrapped(i: i32, n: i32) -> i32 {\n    return (i % n + n) % n;\n}\n",
        ),
    }
}

impl Within {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Linear => "linear",
            Self::Coarse => "coarse",
        }
    }

    pub(super) fn name(self, texels: Texels) -> String {
        format!("{}{}", self.word(), texels.suffix())
    }

    pub(super) fn needs(self, texels: Texels) -> Vec<Helper> {
        match self {
            Self::Point => vec![Helper::Texel(texels)],
            Self::Linear | Self::Coarse => vec![Helper::Between, Helper::Texel(texels)],
        }
    }

    pub(super) fn text(self, texels: Texels) -> String {
        let w = texels.width();
        let (texel, face, border) = (
            texels.name(),
            texels.face(", face"),
            texels.border(", border"),
        );
        let head = format!(
            "fn {}({}, at: vec{w}f{}, level: i32{}) -> vec4f {{\n",
            self.name(texels),
            texels.texture(),
            texels.face(", face: u32"),
            texels.border(", border: vec4f"),
        );
        let size = format!("vec{w}f(textureDimensions(t, level))");
        // As far as numbers of texels and those of their neighbours are whole floats and fit into 32 bits.
        let reach = |x: &str| format!("clamp({x}, vec{w}f(-{FAR}), vec{w}f({FAR}))");
        if self == Self::Point {
            return format!(
                "// The texel of a level that a place lies in.\n{head}    \
                     let i = vec{w}i({});\n    \
                     return {texel}(t, i{face}, level{border});\n}}\n",
                reach(&format!("floor(at * {size})")),
            );
        }
        let (about, share) = match self {
            Self::Coarse => (
                ", in steps of 1/256",
                "floor((x - floor(x)) * 256.0 + 0.5) / 256.0",
            ),
            _ => ("", "x - floor(x)"),
        };
        let tap = |x: u8, y: u8, z: u8| match (x, y, z) {
            (0, 0, 0) => format!("{texel}(t, i{face}, level{border})"),
            _ if w == 2 => format!("{texel}(t, i + vec2i({x}, {y}){face}, level{border})"),
            _ => format!("{texel}(t, i + vec3i({x}, {y}, {z}){face}, level{border})"),
        };
        let row = |y, z| format!("between({}, {}, f.x)", tap(0, y, z), tap(1, y, z));
        let plane = |z: u8, names: [&str; 2]| {
            format!(
                "    let {} = {};\n    let {} = {};\n",
                names[0],
                row(0, z),
                names[1],
                row(1, z)
            )
        };
        let rest = match w {
            2 => format!(
                "{}    return between(upper, lower, f.y);\n",
                plane(0, ["upper", "lower"])
            ),
            _ => format!(
                "{}{}    \
                     return between(between(upper, lower, f.y), between(next_upper, next_lower, f.y), f.z);\n",
                plane(0, ["upper", "lower"]),
                plane(1, ["next_upper", "next_lower"]),
            ),
        };
        format!(
            "// The texels of a level around a place, by the nearness of their centres{about}.\n{head}    \
                 let x = {};\n    \
                 let i = vec{w}i(floor(x));\n    \
                 let f = {share};\n{rest}}}\n",
            reach(&format!("at * {size} - 0.5")),
        )
    }
}

/// The largest number of a texel that is told apart, as in [`crate::texture`].
const FAR: &str = "1073741824.0";

impl Filtered {
    pub(super) fn name(self) -> String {
        let (within, suffix) = (self.within.word(), self.texels.suffix());
        match self.mip {
            MipFilter::None => format!("{within}{suffix}"),
            MipFilter::Point => format!("{within}_mip{suffix}"),
            MipFilter::Linear if self.coarse && self.within == Within::Point => {
                format!("{within}_coarse_mips{suffix}")
            }
            MipFilter::Linear => format!("{within}_mips{suffix}"),
        }
    }

    pub(super) fn needs(self) -> Vec<Helper> {
        let mut needs = vec![Helper::Within(self.within, self.texels)];
        if self.mip == MipFilter::Linear {
            needs.push(Helper::Between);
        }
        needs
    }

    /// The function by the name of its own, which there is for the filters between levels.
    pub(super) fn text(self) -> String {
        let texels = self.texels;
        let (face, border) = (texels.face(", face"), texels.border(", border"));
        let within = self.within.name(texels);
        let in_level = |level: &str| format!("{within}(t, at{face}, {level}{border})");
        let (about, rest) = match self.mip {
            MipFilter::Linear => (
                "The two levels that λ lies between",
                format!(
                    "    let first = i32(level);\n    \
                         let f = {};\n    \
                         let near = {};\n    \
                         if f == 0.0 {{\n        return near;\n    }}\n    \
                         return between(near, {}, f);\n",
                    match self.coarse {
                        true => "floor((level - f32(first)) * 256.0 + 0.5) / 256.0",
                        false => "level - f32(first)",
                    },
                    in_level("first"),
                    in_level("min(first + 1, i32(levels.y))"),
                ),
            ),
            MipFilter::Point | MipFilter::None => (
                "The level nearest to λ, halves up",
                format!("    return {};\n", in_level("i32(level + 0.5)")),
            ),
        };
        format!(
            "// {about}; `levels` are the largest and the smallest that are read.\n\
             fn {}({}, at: vec{}f{}, lambda: f32, levels: vec2f{}) -> vec4f {{\n    \
                 let level = clamp(lambda, levels.x, levels.y);\n{rest}}}\n",
            self.name(),
            texels.texture(),
            texels.width(),
            texels.face(", face: u32"),
            texels.border(", border: vec4f"),
        )
    }

    /// What gives the value at a place, of a face where there are faces.
    pub(super) fn call(self, at: &str, face: &str, lambda: &str) -> String {
        let face = match self.texels.is_cube() {
            true => format!(", {face}"),
            false => String::new(),
        };
        let border = self.texels.border(", border");
        match self.mip {
            MipFilter::None => format!("{}(t, {at}{face}, 0{border})", self.name()),
            _ => format!("{}(t, {at}{face}, {lambda}, levels{border})", self.name()),
        }
    }

    pub(super) fn helper(self) -> Helper {
        match self.mip {
            MipFilter::None => Helper::Within(self.within, self.texels),
            _ => Helper::Filtered(self),
        }
    }
}

pub(super) const BETWEEN: &str = "\
// From a to b.
fn between(a: vec4f, b: vec4f, f: f32) -> vec4f {
    return a + f * (b - a);
}
";
