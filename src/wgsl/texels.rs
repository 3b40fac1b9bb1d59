//! Samples that the shader puts together itself, texel by texel: what a sampler of WebGPU cannot do, or not exactly.
//!
//! The functions do what [`crate::texture::sample_quads`] does, step by step: a texel by its numbers, a filter within a
//! level, the levels, and λ with the probes of an anisotropic filter.

use super::helper::Helper;
use super::options::StageOptions;
use crate::texture::{AddressMode, Filter, MipFilter, RATIO_SLACK, Sampler, TextureKind, Weights};

/// How texels are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Texels {
    shape: Shape,
    /// Of a cube always wrap, which it has not.
    address: [AddressMode; 3],
    /// Whether texels are bytes, filtered as numbers from 0 to 255.
    bytes: bool,
}

/// What a texture is bound as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Shape {
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
    texels: Texels,
    within: Within,
    mip: MipFilter,
    /// Whether levels are blended with weights of 8 bits.
    coarse: bool,
}

/// A whole sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct ByHand {
    mag: Filtered,
    min: Filtered,
    /// The most probes.
    most: u32,
    bias: bool,
    level_zero: bool,
}

impl StageOptions {
    /// Whether the shader puts samples together itself.
    pub(super) fn is_by_hand(&self) -> bool {
        let axes = match self.texture {
            None => return false,
            Some(TextureKind::Cube) => 0,
            Some(TextureKind::Texture2D) => 2,
            Some(TextureKind::Volume) => 3,
        };
        let unknown = |mode| matches!(mode, AddressMode::Border | AddressMode::MirrorOnce);
        let blends = self.mag.is_linear() || self.min.is_linear() || self.mip == MipFilter::Linear;
        // A sampler of WebGPU looks at λ behind the limits of the levels, and leaves open where halves go to.
        let other_limits = self.max_mip_level > 0 && self.mag.is_linear() != self.min.is_linear();
        let levels = match self.mip {
            MipFilter::None => false,
            MipFilter::Point => other_limits || self.lod_bias,
            MipFilter::Linear => other_limits,
        };
        self.address.into_iter().take(axes).any(unknown)
            || (self.weights == Weights::EightBits && blends)
            || self.most_probes() > 1
            || levels
    }

    fn most_probes(&self) -> u32 {
        match self.min {
            Filter::Anisotropic => self.max_anisotropy.clamp(1, *Sampler::ANISOTROPY.end()),
            _ => 1,
        }
    }

    /// The function that samples; none without a texture. Arguments: [`ByHand::takes`].
    pub(super) fn by_hand(&self, level_zero: bool) -> Option<ByHand> {
        let (shape, axes) = match self.texture? {
            TextureKind::Texture2D => (Shape::Flat, 2),
            TextureKind::Volume => (Shape::Volume, 3),
            TextureKind::Cube if self.seamless => (Shape::Seamless, 0),
            TextureKind::Cube => (Shape::Faces, 0),
        };
        let address = std::array::from_fn(|axis| match axis < axes {
            true => self.address[axis],
            false => AddressMode::Wrap,
        });
        let coarse = self.weights == Weights::EightBits;
        let filtered = |filter: Filter| Filtered {
            texels: Texels {
                shape,
                address,
                bytes: self.byte_texels,
            },
            within: match (filter.is_linear(), coarse) {
                (false, _) => Within::Point,
                (true, false) => Within::Linear,
                (true, true) => Within::Coarse,
            },
            mip: self.mip,
            coarse: coarse && self.mip == MipFilter::Linear,
        };
        let mag = filtered(self.mag);
        Some(match level_zero {
            true => ByHand {
                mag,
                min: mag,
                most: 1,
                bias: false,
                level_zero,
            },
            false => {
                let mut made = ByHand {
                    mag,
                    min: filtered(self.min),
                    most: self.most_probes(),
                    bias: self.lod_bias,
                    level_zero,
                };
                made.bias &= made.has_lambda();
                made
            }
        })
    }
}

impl Texels {
    fn is_cube(self) -> bool {
        matches!(self.shape, Shape::Faces | Shape::Seamless)
    }

    /// How many numbers a place has, beside the face.
    fn width(self) -> usize {
        match self.shape {
            Shape::Volume => 3,
            Shape::Flat | Shape::Faces | Shape::Seamless => 2,
        }
    }

    fn axes(self) -> impl Iterator<Item = (char, AddressMode)> {
        let count = if self.is_cube() { 0 } else { self.width() };
        "xyz".chars().zip(self.address).take(count)
    }

    fn has_border(self) -> bool {
        self.axes().any(|(_, mode)| mode == AddressMode::Border)
    }

    /// What tells the functions of these texels from others.
    fn suffix(self) -> String {
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
    fn texture(self) -> &'static str {
        match self.shape {
            Shape::Flat => "t: texture_2d<f32>",
            Shape::Volume => "t: texture_3d<f32>",
            Shape::Faces | Shape::Seamless => "t: texture_2d_array<f32>",
        }
    }

    /// `, face` where there are faces.
    fn face(self, text: &'static str) -> &'static str {
        if self.is_cube() { text } else { "" }
    }

    /// `, border` where there is one.
    fn border(self, text: &'static str) -> &'static str {
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
    fn word(self) -> &'static str {
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
                    in_level("min(first + 1, last)"),
                ),
            ),
            MipFilter::Point | MipFilter::None => (
                "The level nearest to λ, halves up",
                format!("    return {};\n", in_level("i32(level + 0.5)")),
            ),
        };
        format!(
            "// {about}, `largest` being the largest level that is read.\n\
             fn {}({}, at: vec{}f{}, lambda: f32, largest: i32{}) -> vec4f {{\n    \
                 let last = i32(textureNumLevels(t)) - 1;\n    \
                 let level = clamp(lambda, f32(min(largest, last)), f32(last));\n{rest}}}\n",
            self.name(),
            texels.texture(),
            texels.width(),
            texels.face(", face: u32"),
            texels.border(", border: vec4f"),
        )
    }

    /// What gives the value at a place, of a face where there are faces.
    fn call(self, at: &str, face: &str, lambda: &str) -> String {
        let face = match self.texels.is_cube() {
            true => format!(", {face}"),
            false => String::new(),
        };
        let border = self.texels.border(", border");
        match self.mip {
            MipFilter::None => format!("{}(t, {at}{face}, 0{border})", self.name()),
            _ => format!("{}(t, {at}{face}, {lambda}, largest{border})", self.name()),
        }
    }

    fn helper(self) -> Helper {
        match self.mip {
            MipFilter::None => Helper::Within(self.within, self.texels),
            _ => Helper::Filtered(self),
        }
    }
}

/// An argument of [`ByHand`], behind the texture and the coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Argument {
    Bias,
    /// The number of the largest level that is read.
    Largest,
    Border,
}

impl ByHand {
    /// What it takes behind the texture and the coordinates, in this order.
    pub(super) fn takes(self) -> impl Iterator<Item = Argument> {
        [
            (self.bias, Argument::Bias),
            (self.mag.mip != MipFilter::None, Argument::Largest),
            (self.mag.texels.has_border(), Argument::Border),
        ]
        .into_iter()
        .filter_map(|(is_taken, argument)| is_taken.then_some(argument))
    }

    /// Whether anything depends on derivatives.
    fn has_lambda(self) -> bool {
        !self.level_zero
            && (self.mag != self.min || self.most > 1 || self.mag.mip != MipFilter::None)
    }

    pub(super) fn name(self) -> String {
        let mut filters = self.mag.within.word().to_string();
        if self.mag != self.min {
            filters += &format!("_{}", self.min.within.word());
        }
        if self.most > 1 {
            filters += &format!("_{}_probes", self.most);
        }
        let mip = match self.mag.mip {
            MipFilter::None => "",
            MipFilter::Point => "_mip",
            MipFilter::Linear => "_mips",
        };
        let weights = match self.mag.coarse && filters == "point" {
            true => "_coarse",
            false => "",
        };
        let bias = if self.bias { "_bias" } else { "" };
        let zero = if self.level_zero { "_level_zero" } else { "" };
        let suffix = self.mag.texels.suffix();
        format!("sample_{filters}{weights}{mip}{bias}{zero}{suffix}")
    }

    pub(super) fn needs(self) -> Vec<Helper> {
        let mut needs = match self.level_zero {
            true => vec![Helper::Within(self.mag.within, self.mag.texels)],
            false => vec![self.mag.helper(), self.min.helper()],
        };
        if self.has_lambda() {
            needs.push(Helper::LevelOfDetail);
            if self.mag.texels.is_cube() {
                needs.push(Helper::FaceStep);
            }
        }
        if self.mag.texels.is_cube() {
            needs.extend([Helper::CubeFace, Helper::OnFace]);
            if self.most > 1 {
                needs.push(Helper::OutOfFace);
            }
        }
        needs
    }

    pub(super) fn text(self) -> String {
        let texels = self.mag.texels;
        let w = texels.width();
        let given = match texels.is_cube() {
            true => "direction: vec3f".to_string(),
            false => format!("at: vec{w}f"),
        };
        let parameters: String = (self.takes())
            .map(|argument| match argument {
                Argument::Bias => ", bias: f32",
                Argument::Largest => ", largest: i32",
                Argument::Border => ", border: vec4f",
            })
            .collect();
        let mut text = format!(
            "// {}\nfn {}({}, {given}{parameters}) -> vec4f {{\n",
            self.about(),
            self.name(),
            texels.texture(),
        );
        if texels.is_cube() {
            text +=
                "    let face = cube_face(direction);\n    let at = on_face(face, direction);\n";
        }
        let scale = if texels.bytes { " / 255.0" } else { "" };
        if self.has_lambda() {
            text += &self.with_lambda(scale);
        } else {
            let border = texels.border(", border");
            let value = match (self.level_zero, self.mag.mip) {
                (true, MipFilter::Point | MipFilter::Linear) => format!(
                    "{}(t, at{}, min(largest, i32(textureNumLevels(t)) - 1){border})",
                    self.mag.within.name(texels),
                    texels.face(", face"),
                ),
                _ => self.mag.call("at", "face", ""),
            };
            text += &format!("    return {value}{scale};\n");
        }
        text + "}\n"
    }

    fn about(self) -> String {
        let words = |filter: Filtered| match filter.within {
            Within::Point => "point",
            Within::Linear => "linear",
            Within::Coarse => "linear in steps of 1/256",
        };
        let within = match (self.mag.within == self.min.within, self.most) {
            (true, 1) => words(self.mag).to_string(),
            (_, 1) => format!(
                "{} magnified, {} minified",
                words(self.mag),
                words(self.min)
            ),
            (_, most) => format!(
                "{} magnified, minified {} with up to {most} probes",
                words(self.mag),
                words(self.min)
            ),
        };
        let between = match self.mag.mip {
            _ if self.level_zero => "",
            MipFilter::None => ", level 0",
            MipFilter::Point => ", the nearest level",
            MipFilter::Linear if self.mag.coarse => ", between levels in steps of 1/256",
            MipFilter::Linear => ", between levels",
        };
        format!("A sample, texel by texel: {within}{between}.")
    }

    fn with_lambda(self, scale: &str) -> String {
        let texels = self.mag.texels;
        let w = texels.width();
        let step = |d: char| match texels.is_cube() {
            true => face_step(d),
            false => format!("    let {d} = dpd{d}Fine(at);\n"),
        };
        let bias = if self.bias { " + bias" } else { "" };
        let mut text = format!(
            "{}{}    \
                 let size = vec{w}f(textureDimensions(t));\n    \
                 let xx = dot(x * size, x * size);\n    \
                 let yy = dot(y * size, y * size);\n    \
                 let lambda = level_of_detail(max(xx, yy)){bias};\n",
            step('x'),
            step('y'),
        );
        let mag = self.mag.call("at", "face", "lambda");
        if self.most == 1 {
            if self.mag != self.min {
                let min = self.min.call("at", "face", "lambda");
                text += &format!("    if lambda > 0.0 {{\n        return {min}{scale};\n    }}\n");
            }
            return text + &format!("    return {mag}{scale};\n");
        }
        text += &format!(
            "    if lambda <= 0.0 {{\n        return {mag}{scale};\n    }}\n    \
                 // As many probes along the longer derivative as it is longer than the other one.\n    \
                 let ratio = sqrt(max(xx, yy) / max(min(xx, yy), 1e-30));\n    \
                 let probes = clamp(ceil(ratio - {RATIO_SLACK:?}), 1.0, {}.0);\n    \
                 let along = select(y, x, xx >= yy);\n    \
                 var sum = vec4f();\n    \
                 for (var probe = 0.5; probe < probes; probe += 1.0) {{\n        \
                     let place = at + along * (probe / probes - 0.5);\n",
            self.most,
        );
        let (at, face) = match texels.is_cube() {
            false => ("place", ""),
            true => {
                text += "        let there = out_of_face(face, vec3f(2.0 * place - 1.0, 1.0));\n        \
                         let its_face = cube_face(there);\n";
                ("on_face(its_face, there)", "its_face")
            }
        };
        let min = self.min.call(at, face, "lambda - log2(probes)");
        text += &format!("        sum += {min};\n    }}\n    return sum / probes{scale};\n");
        text
    }
}

/// The line with the step in a face of a cube to the neighbouring pixel along x or y of the screen, which is its name.
pub(super) fn face_step(direction: char) -> String {
    let d = format!("dpd{direction}Fine");
    format!(
        "    let {direction} = face_step(face, at, direction, {d}(direction), {d}(at), {d}(f32(face)));\n"
    )
}

// Which of the two pixels asks is told by whose face the other one has.
pub(super) const FACE_STEP: &str = "\
// The step in a face from a pixel to its neighbour, from derivatives. One on another face is looked for in the plane of this one.
fn face_step(face: u32, at: vec2f, direction: vec3f, d: vec3f, d_at: vec2f, d_face: f32) -> vec2f {
    if d_face == 0.0 {
        return d_at;
    }
    let is_ahead = f32(cube_face(direction + d)) - f32(face) == d_face;
    return on_face(face, select(direction - d, direction + d, is_ahead)) - at;
}
";

pub(super) const BETWEEN: &str = "\
// From a to b.
fn between(a: vec4f, b: vec4f, f: f32) -> vec4f {
    return a + f * (b - a);
}
";

pub(super) const LEVEL_OF_DETAIL: &str = "\
// log2 of a length, of which the square is given; far below all levels where that is 0.
fn level_of_detail(square: f32) -> f32 {
    return select(0.5 * log2(square), -1e30, square == 0.0);
}
";

pub(super) const OUT_OF_FACE: &str = "\
// The direction that leads so far to the right, down and out of a face of a cube.
fn out_of_face(face: u32, p: vec3f) -> vec3f {
    switch face {
        case 0u: { return vec3f(p.z, -p.y, -p.x); }
        case 1u: { return vec3f(-p.z, -p.y, p.x); }
        case 2u: { return vec3f(p.x, p.z, p.y); }
        case 3u: { return vec3f(p.x, -p.z, -p.y); }
        case 4u: { return vec3f(p.x, -p.y, p.z); }
        default: { return vec3f(-p.x, -p.y, -p.z); }
    }
}
";

pub(super) const ACROSS_EDGE: &str = "\
// The texel behind one edge of a face of a cube, n texels wide, and its face: in whole numbers, of half texels.
fn across_edge(face: u32, i: vec2i, n: i32) -> vec3i {
    let direction = out_of_face(face, vec3f(vec2f(2 * i + 1 - n), f32(n)));
    let to = cube_face(direction);
    let at = vec3i(along_face(to, direction));
    let place = (at.xy + at.z) * n / (2 * at.z);
    return vec3i(clamp(place, vec2i(), vec2i(n - 1)), i32(to));
}
";
