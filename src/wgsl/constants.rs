//! Where the constants of a shader come from.

use super::body::Body;
use super::helper::Helper;
use super::layout::Field;
use super::number;
use crate::isa::register::VERTEX_CONSTANTS;
use crate::isa::{RegisterFile, ShaderKind};
use crate::kernel::{Operand, Place};
use crate::program::Def;
use crate::semantics;

/// Where a constant comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Constant {
    /// The `def` of the shader.
    Defined,
    /// The uniform block.
    Uniform,
    /// There is no such constant: it reads 0.
    Missing,
}

impl Body<'_> {
    /// Whether constants are addressed relatively, which takes all of them from the uniform block.
    pub(super) fn is_relative(&self) -> bool {
        self.relative
    }

    /// How many constant registers there are.
    pub(super) fn constant_count(&self) -> u32 {
        let kernel = self.stage.kernel;
        match self.kind() {
            ShaderKind::Pixel => RegisterFile::Const.count(kernel.version),
            ShaderKind::Vertex => (kernel.definitions.iter())
                .map(|(index, _)| index + 1)
                .fold(VERTEX_CONSTANTS, u32::max),
        }
    }

    /// Where a constant comes from.
    pub(super) fn constant(&self, index: u32) -> Constant {
        let mut definitions = self.stage.kernel.definitions.iter();
        let defined = definitions.any(|(defined, _)| *defined == index);
        if defined && !self.options.overridable_definitions && !self.relative {
            Constant::Defined
        } else if index < self.constant_count() {
            Constant::Uniform
        } else {
            Constant::Missing
        }
    }

    /// Whether a step names a constant.
    pub(super) fn names_constant(&self, index: u32) -> bool {
        let operands = self
            .stage
            .kernel
            .steps
            .iter()
            .flat_map(|step| &step.sources);
        { operands }.any(|operand| operand.place == Place::Constant(index))
    }

    /// A constant that the shader defines. The last definition of a register counts.
    pub(super) fn definition(&mut self, def: &Def) {
        let index = def.register.index;
        let last = (self.stage.program.definitions())
            .filter(|d| d.register.index == index)
            .last();
        if last.is_none_or(|last| last.span != def.span)
            || !(self.names_constant(index) || self.relative)
        {
            return;
        }
        if self.constant(index) != Constant::Defined {
            let where_it_is = "is in the uniform block: whoever fills that puts this value there.";
            return self.push(format!("// c{index} {where_it_is}"));
        }
        let bound = bound_value(self.kind(), def.value);
        if bound != def.value && !def.value.iter().any(|x| x.is_nan()) {
            self.push("// Constants of pixel shaders are clamped to -1…1.");
        }
        let value = self.defined_value(index, def.value);
        if value != bound && !bound.iter().any(|x| x.is_nan()) {
            let model = self.stage.kernel.model;
            self.push(format_args!("// As the registers of {model} hold them."));
        }
        let line = match number::vector(value) {
            // Two constants in one expression are computed by the compiler, which refuses results that overflow.
            Some(text) if self.meets_constants(index) && value.iter().any(|v| v.abs() > 64.0) => {
                format!("let c{index} = {text};")
            }
            Some(text) => format!("const c{index} = {text};"),
            None => {
                // Infinities and NaN exist at run time only.
                self.push(format!("var c{index}_bits = {};", number::bits(value)));
                format!("let c{index} = bitcast<vec4f>(c{index}_bits);")
            }
        };
        self.push(line);
    }

    /// Whether some step computes with this constant and nothing but constants.
    fn meets_constants(&self, index: u32) -> bool {
        let constant = |operand: &Operand| match operand.place {
            Place::Constant(index) => self.constant(index) == Constant::Defined,
            Place::Literal(_) => true,
            Place::Slot(_) | Place::Relative(_) => false,
        };
        self.stage.kernel.steps.iter().any(|step| {
            let named = (step.sources.iter()).any(|s| s.place == Place::Constant(index));
            let constants = step.sources.iter().filter(|s| constant(s)).count();
            named && (constants > 1 || step.sources.len() == 1)
        })
    }

    pub(super) fn constant_letters(&self) -> [char; 4] {
        crate::program::letters(self.kind())
    }

    pub(super) fn constant_name(&mut self, index: u32) -> String {
        match (self.constant(index), self.kind()) {
            (Constant::Missing, _) => "vec4f()".into(),
            (Constant::Uniform, ShaderKind::Vertex) => {
                self.uniform(Field::Constants) + "[" + &index.to_string() + "]"
            }
            (Constant::Uniform | Constant::Defined, _) => RegisterFile::Const.register_name(index),
        }
    }

    pub(super) fn relative_constant(&mut self, offset: u32) -> String {
        self.block.use_field(Field::Constants);
        let function = (self.helpers).call(Helper::ConstantAt(self.block.constants));
        // Numbers beyond the range of the address register lie outside of the constants as well.
        match i32::try_from(offset) {
            Ok(0) => format!("{function}(a0)"),
            Ok(offset) => format!("{function}(a0 + {offset})"),
            Err(_) => format!("{function}(-1)"),
        }
    }
}

/// The value of a defined constant as the shader sees it.
pub(super) fn bound_value(kind: ShaderKind, value: [f32; 4]) -> [f32; 4] {
    match kind {
        ShaderKind::Vertex => value,
        ShaderKind::Pixel => value.map(semantics::constant),
    }
}

/// Whether an operand goes through the address register.
pub(super) fn is_relative(operand: &Operand) -> bool {
    matches!(operand.place, Place::Relative(_))
}
