//! Samples that the shader puts together itself, texel by texel: what a sampler of WebGPU cannot do, or not exactly. Here
//! is when it does, and λ with the probes of an anisotropic filter; `texels` has the rest.

use super::faces::face_step;
use super::helper::Helper;
use super::options::StageOptions;
use super::texels::{Filtered, Shape, Texels, Within};
use crate::texture::{AddressMode, Filter, MipFilter, RATIO_SLACK, Sampler, TextureKind, Weights};

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
        // Mirrored coordinates, as adapters make them, lie on the other side of an edge between two texels.
        let points = !(self.mag.is_linear() && self.min.is_linear());
        let unknown = |mode| match mode {
            AddressMode::Border | AddressMode::MirrorOnce => true,
            AddressMode::Mirror => points,
            AddressMode::Wrap | AddressMode::Clamp => false,
        };
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

/// An argument of [`ByHand`], behind the texture and the coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Argument {
    Bias,
    /// The largest and the smallest level that are read.
    Levels,
    Border,
}

impl ByHand {
    /// What it takes behind the texture and the coordinates, in this order.
    pub(super) fn takes(self) -> impl Iterator<Item = Argument> {
        [
            (self.bias, Argument::Bias),
            (self.mag.mip != MipFilter::None, Argument::Levels),
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
                Argument::Levels => ", levels: vec2f",
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
                    "{}(t, at{}, i32(levels.x){border})",
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

pub(super) const LEVEL_OF_DETAIL: &str = "\
// log2 of a length, of which the square is given; far below all levels where that is 0.
fn level_of_detail(square: f32) -> f32 {
    return select(0.5 * log2(square), -1e30, square == 0.0);
}
";
