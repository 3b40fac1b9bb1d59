//! Hardware models: with which numbers pixel shaders compute.

use super::named;

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

/// One thing in which models differ, for whoever lists them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Aspect {
    /// What it is.
    pub name: &'static str,
    /// What becomes of it, in the order of [`Model::all`].
    of: [&'static str; 3],
}

impl Aspect {
    /// Everything in which models differ.
    pub fn all() -> impl Iterator<Item = &'static Aspect> {
        ASPECTS.iter()
    }

    /// What a model makes of it.
    pub const fn of(&self, model: Model) -> &'static str {
        let [float, gf3, r200] = self.of;
        match model {
            Model::Float => float,
            Model::Gf3 => gf3,
            Model::R200 => r200,
        }
    }
}

const fn aspect(name: &'static str, of: [&'static str; 3]) -> Aspect {
    Aspect { name, of }
}

const AS_IT_IS: &str = "as it is";
const ON_STEP: &str = "clamped, nearest step";

static ASPECTS: &[Aspect] = &[
    aspect(
        "numbers",
        ["32-bit floats", "steps of 1/255", "steps of 1/4096"],
    ),
    aspect("range", ["none", "-1 to 1", "-8 to 8"]),
    aspect(
        "part",
        [
            "the parts of Direct3D 9 and everything after them",
            "GeForce 3 and 4 Ti: register combiners, 9 bits (ps.1.1 to ps.1.3)",
            "Radeon 8500: 16 bits (ps.1.4)",
        ],
    ),
    aspect(
        "result of arithmetic, behind the shift",
        [AS_IT_IS, ON_STEP, ON_STEP],
    ),
    aspect("between product and sum, before the shift", ["nothing"; 3]),
    aspect(
        "what arithmetic reads of v#, c#, t#, r#",
        [AS_IT_IS, ON_STEP, ON_STEP],
    ),
    aspect("1-x", ["1 - x", "1 - (x in 0 to 1)", "1 - x"]),
    aspect("x_bias", ["x - 0.5", "max(0, x) - 0.5", "x - 0.5"]),
    aspect("x_bx2", ["2 * x - 1", "2 * max(0, x) - 1", "2 * x - 1"]),
    aspect(
        "what texture instructions leave in a register",
        [AS_IT_IS, AS_IT_IS, ON_STEP],
    ),
    aspect(
        "coordinates, dot products of texm3x#, depth, texkill",
        ["floats"; 3],
    ),
    aspect("factor of texbeml", [AS_IT_IS, "in 0 to 1", AS_IT_IS]),
    aspect(
        "signed texels of b bits",
        [
            "max(code / (2^(b-1) - 1), -1)",
            "code / 2^(b-1)",
            "max(code / (2^(b-1) - 1), -1)",
        ],
    ),
    aspect(
        "weights of linear filters, between levels too",
        ["32 bits", "steps of 1/256", "steps of 1/256"],
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// The page of the models has the same rows, in its own typography.
    #[test]
    fn the_documentation_tells_the_same() {
        let page = include_str!("../../docs/models.md");
        let plain = |text: &str| {
            let text = text.replace(['`', '\\', ' '], "");
            let text = text
                .replace('−', "-")
                .replace("…", "to")
                .replace(['·', '*'], "");
            text.to_lowercase()
        };
        let page = plain(page);
        for aspect in Aspect::all() {
            for model in Model::all() {
                let told = plain(aspect.of(model));
                assert!(page.contains(&told), "{} of {model}: {told}", aspect.name);
            }
        }
    }
}
