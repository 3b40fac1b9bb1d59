//! Choices that a person makes about how a listing is judged and run, as plain values.

mod named;
mod numeric;

pub use named::UnknownName;
use named::named;
pub use numeric::{
    DefLifetime, LogpLayout, OfZero, Policies, Policy, PolicyValue, ScalarSlot, WrongPolicy,
    ZeroProduct,
};

named! {
    /// By whose rules a listing is judged.
    Dialect "dialect";
    D3d8 "d3d8" "What the Direct3D 8 runtime accepted, with a warning where its own documents forbade it.",
    D3d9 "d3d9" "What the assembler and the runtime of Direct3D 9 accepted of these versions.",
    Lenient "lenient" "Whatever has a meaning: a listing is refused only for what cannot be run.",
}

named! {
    /// With which numbers pixel shaders compute: the hardware model.
    ///
    /// Vertex shaders compute with 32-bit floats under every model, and so do the coordinates of texture instructions.
    /// A model is a way to compute, not a rule: a shader of a version that the part never had runs all the same, as it
    /// would with such numbers.
    Model "hardware model";
    Float "float" "32-bit floats without a range, as on the parts of Direct3D 9.",
    Gf3 "gf3" "Steps of 1/255 from -1 to 1, as in the combiners of the GeForce 3 and 4 (ps.1.1 to ps.1.3).",
    R200 "r200" "Steps of 1/4096 from -8 to 8, as in the Radeon 8500 (ps.1.4).",
}

impl Model {
    /// The largest magnitude of a number; infinite for floats.
    pub const fn most(self) -> f32 {
        match self {
            Self::Float => f32::INFINITY,
            Self::Gf3 => 1.0,
            Self::R200 => 8.0,
        }
    }

    /// How many steps there are from 0 to 1; none for floats.
    pub const fn steps(self) -> Option<f32> {
        match self {
            Self::Float => None,
            Self::Gf3 => Some(255.0),
            Self::R200 => Some(4096.0),
        }
    }

    /// Whether filters of textures have weights of 8 bits, as those of the time had.
    pub const fn has_coarse_filters(self) -> bool {
        !matches!(self, Self::Float)
    }

    /// Whether a signed texel is code / 2^(bits − 1) rather than max(code / (2^(bits − 1) − 1), −1).
    pub const fn has_lopsided_texels(self) -> bool {
        matches!(self, Self::Gf3)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_are_read_by_the_name_they_print() {
        for name in ["d3d8", "d3d9", "lenient"] {
            assert_eq!(name.parse::<Dialect>().unwrap().to_string(), name);
        }
        for name in ["float", "gf3", "r200"] {
            assert_eq!(name.parse::<Model>().unwrap().to_string(), name);
        }
        assert_eq!("D3D9".parse(), Ok(Dialect::D3d9));
        assert_eq!(Dialect::default(), Dialect::D3d8);
        assert_eq!(Model::default(), Model::Float);
        let unknown = "d3d7".parse::<Dialect>().unwrap_err().to_string();
        assert!(unknown.contains("d3d7") && unknown.contains("d3d8, d3d9, lenient"));
        let unknown = "nv20".parse::<Model>().unwrap_err().to_string();
        assert!(unknown.contains("hardware model `nv20`") && unknown.contains("float, gf3, r200"));
    }
}
