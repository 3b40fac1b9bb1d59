//! What a shader is run with, beside its inputs.

use crate::isa::register::VERTEX_CONSTANTS;
use crate::isa::{RegisterFile, ShaderKind};
use crate::kernel::{Kernel, MOST_VERTEX_CONSTANTS};
use crate::policy::DefLifetime;
use crate::semantics::{self, BumpState};
use crate::texture::{Sampler, Texture};

/// How many texture stages there are.
pub const STAGES: usize = 8;

/// The textures, their states and the constants that are set while a shader runs.
#[derive(Clone, Debug, Default)]
pub struct Environment<'a> {
    /// The constants as [`bind_constants`] made them. Numbers beyond the end read (0, 0, 0, 0).
    pub constants: Vec<[f32; 4]>,
    /// The texture stages.
    pub stages: [Stage<'a>; STAGES],
}

/// One texture stage.
#[derive(Clone, Debug, Default)]
pub struct Stage<'a> {
    /// The texture; a stage without one samples opaque black.
    pub texture: Option<&'a Texture>,
    /// How it is sampled.
    pub sampler: Sampler,
    /// The bump mapping states.
    pub bump: BumpState,
}

/// The constant registers of a kernel when it runs.
///
/// Direct3D 8 loads what a shader defines itself when the shader is set, and what a program sets comes after that:
/// `set` replaces definitions, unless the kernel's [`Policies::def`](crate::policy::Policies::def) says that they always
/// hold. What nobody sets is (0, 0, 0, 0). Pixel shader constants are clamped to −1…1.
/// Numbers in `set` beyond the registers there are have no effect.
pub fn bind_constants(kernel: &Kernel, set: &[(u32, [f32; 4])]) -> Vec<[f32; 4]> {
    bind_constants_over(kernel, &[], set)
}

/// The same where shaders before this one have left something in the registers: it is there until this shader defines the
/// register or it is set. Where definitions always hold, they belong to their shader alone, and nothing is left.
pub fn bind_constants_over(
    kernel: &Kernel,
    left: &[(u32, [f32; 4])],
    set: &[(u32, [f32; 4])],
) -> Vec<[f32; 4]> {
    let kind = kernel.version.kind();
    let count = match kind {
        // A listing that names more than every device has gets what it names, and what is set can be addressed.
        ShaderKind::Vertex => (kernel.constants())
            .chain(set.iter().map(|(index, _)| *index))
            .filter(|index| *index < MOST_VERTEX_CONSTANTS)
            .fold(VERTEX_CONSTANTS, |count, index| count.max(index + 1)),
        ShaderKind::Pixel => RegisterFile::Const.count(kernel.version),
    };
    let mut constants = vec![[0.0; 4]; count as usize];
    let own = kernel.definitions.as_slice();
    let (left, first, last) = match kernel.policies.def {
        DefLifetime::WhenSet => (left, own, set),
        DefLifetime::Always => ([].as_slice(), set, own),
    };
    for (index, value) in left.iter().chain(first).chain(last) {
        if let Some(constant) = constants.get_mut(*index as usize) {
            *constant = match kind {
                ShaderKind::Vertex => *value,
                ShaderKind::Pixel => value.map(semantics::constant),
            };
        }
    }
    constants
}

/// Whether bound constants of a kernel differ from what it defines itself.
pub fn overrides_definitions(kernel: &Kernel, bound: &[[f32; 4]]) -> bool {
    let own = bind_constants(kernel, &[]);
    (kernel.definitions.iter()).any(|(register, _)| {
        let of = |constants: &[[f32; 4]]| {
            let value = constants.get(*register as usize).copied();
            value.unwrap_or_default().map(f32::to_bits)
        };
        of(&own) != of(bound)
    })
}
