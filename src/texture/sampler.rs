//! The texture stage states that decide how a texture is read.

use std::fmt;

/// A name that none of the known ones equals.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownName {
    what: &'static str,
    name: String,
    known: Vec<&'static str>,
}

impl UnknownName {
    pub(super) fn new(
        what: &'static str,
        name: &str,
        known: impl Iterator<Item = &'static str>,
    ) -> Self {
        // Names come from files: a whole megabyte of one helps nobody in a message.
        Self {
            what,
            name: name.chars().take(60).collect(),
            known: known.collect(),
        }
    }
}

impl fmt::Display for UnknownName {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            out,
            "unknown {} `{}`: one of {}",
            self.what,
            self.name,
            self.known.join(", ")
        )
    }
}

impl std::error::Error for UnknownName {}

/// Whether a text is a name, in any case and with or without `_` between its words.
pub(super) fn is_name(text: &str, name: &str) -> bool {
    fn letters(text: &str) -> impl Iterator<Item = u8> {
        let letters = text.bytes().filter(|letter| *letter != b'_');
        letters.map(|letter| letter.to_ascii_lowercase())
    }
    letters(text).eq(letters(name))
}

/// Gives an enum its names: parsing, printing, the list of its members.
macro_rules! names {
    ($type:ty, $what:literal, $($variant:ident $name:literal),*) => {
        impl $type {
            /// Every member, in the order of the Direct3D numbers.
            pub const ALL: &'static [Self] = &[$(Self::$variant),*];
        }

        impl std::str::FromStr for $type {
            type Err = $crate::texture::UnknownName;

            fn from_str(name: &str) -> Result<Self, $crate::texture::UnknownName> {
                $(if $crate::texture::sampler::is_name(name, $name) {
                    return Ok(Self::$variant);
                })*
                Err($crate::texture::UnknownName::new($what, name, [$($name),*].into_iter()))
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                out.write_str(match self { $(Self::$variant => $name),* })
            }
        }
    };
}
pub(super) use names;

/// `D3DTSS_ADDRESSU`, `V`, `W`: which texel an index outside 0..n stands for. The rule is applied to each texel that
/// a filter reads. Cube textures ignore it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum AddressMode {
    /// `D3DTADDRESS_WRAP`: i mod n.
    #[default]
    Wrap,
    /// `D3DTADDRESS_MIRROR`: i mod 2n, the second half backwards.
    Mirror,
    /// `D3DTADDRESS_CLAMP`: the nearest texel inside.
    Clamp,
    /// `D3DTADDRESS_BORDER`: the border colour.
    Border,
    /// `D3DTADDRESS_MIRRORONCE`: mirrored at 0, then clamped.
    MirrorOnce,
}
names!(AddressMode, "address mode", Wrap "wrap", Mirror "mirror", Clamp "clamp", Border "border", MirrorOnce "mirror_once");

/// `D3DTSS_MAGFILTER`, `D3DTSS_MINFILTER`: how the texels of one level are combined.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum Filter {
    /// `D3DTEXF_POINT`: the texel that the coordinate lies in.
    #[default]
    Point,
    /// `D3DTEXF_LINEAR`: the two texels around the coordinate on each axis, weighted by nearness of their centres.
    Linear,
    /// `D3DTEXF_ANISOTROPIC`: where a texture is minified, linear probes along the longer derivative of the coordinates
    /// ([`Detail`](super::Detail)), at most [`Sampler::max_anisotropy`] of them. Magnified it is [`Self::Linear`].
    Anisotropic,
}
names!(Filter, "filter", Point "point", Linear "linear", Anisotropic "anisotropic");

impl Filter {
    /// Whether neighbouring texels are blended.
    pub fn is_linear(self) -> bool {
        self != Self::Point
    }
}

/// `D3DTSS_MIPFILTER`: how levels are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum MipFilter {
    /// `D3DTEXF_NONE`: always level 0.
    #[default]
    None,
    /// `D3DTEXF_POINT`: the nearest level, halves up.
    Point,
    /// `D3DTEXF_LINEAR`: the two nearest levels blended.
    Linear,
}
names!(MipFilter, "mip filter", None "none", Point "point", Linear "linear");

/// How exact the weights of linear filters are, those between mip levels included.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Weights {
    /// 32-bit floats.
    #[default]
    Full,
    /// Steps of 1/256, the nearest, halves up: what hardware of the time had.
    EightBits,
}

/// How a texture is read. The default is Direct3D 8's: wrap, point, point, no mip levels, anisotropy of at most 1, border
/// 0, 0, 0, 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampler {
    /// Address mode of u, v and w.
    pub address: [AddressMode; 3],
    /// Filter where a texel covers a pixel or more (λ ≤ 0).
    pub mag: Filter,
    /// Filter where a pixel covers more than a texel (λ > 0).
    pub min: Filter,
    /// How mip levels are chosen.
    pub mip: MipFilter,
    /// `D3DTSS_MIPMAPLODBIAS`, added to λ before anything is decided by it.
    pub lod_bias: f32,
    /// `D3DTSS_MAXMIPLEVEL`: the number of the largest level that may be read; 0 allows all.
    pub max_mip_level: u32,
    /// `D3DTSS_MAXANISOTROPY`: the most probes of [`Filter::Anisotropic`], [`Self::ANISOTROPY`]; what lies outside of it
    /// counts as the nearer end. With 1, the default, the filter is linear.
    pub max_anisotropy: u32,
    /// `D3DTSS_BORDERCOLOR` as r, g, b, a.
    pub border: [f32; 4],
    /// Whether filters on a cube reach across edges. Direct3D 8 parts stayed inside the face: false.
    pub seamless: bool,
    /// How exact the weights of linear filters are.
    pub weights: Weights,
}

impl Sampler {
    /// What [`Self::max_anisotropy`] may be.
    pub const ANISOTROPY: std::ops::RangeInclusive<u32> = 1..=16;

    /// How many probes a minified sample may have.
    pub(crate) fn most_probes(&self) -> u8 {
        match self.min {
            Filter::Anisotropic => self.max_anisotropy.clamp(1, *Self::ANISOTROPY.end()) as u8,
            Filter::Point | Filter::Linear => 1,
        }
    }
}

impl Default for Sampler {
    fn default() -> Self {
        Self {
            address: Default::default(),
            mag: Filter::Point,
            min: Filter::Point,
            mip: MipFilter::None,
            lod_bias: 0.0,
            max_mip_level: 0,
            max_anisotropy: 1,
            border: [0.0; 4],
            seamless: false,
            weights: Weights::Full,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_parse_and_print() {
        for name in ["wrap", "mirror", "clamp", "border", "mirror_once"] {
            assert_eq!(name.parse::<AddressMode>().unwrap().to_string(), name);
        }
        assert_eq!("LINEAR".parse(), Ok(Filter::Linear));
        assert_eq!("none".parse(), Ok(MipFilter::None));
        let message = "mirrored".parse::<AddressMode>().unwrap_err().to_string();
        assert_eq!(
            message,
            "unknown address mode `mirrored`: one of wrap, mirror, clamp, border, mirror_once"
        );
    }
}
