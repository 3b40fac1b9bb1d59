//! Lowering of the texture instructions.

use super::lower::{Lowering, Projection, stage};
use super::{Op, Operand, Place, Slot};
use crate::isa::{Opcode, SourceModifier, Swizzle, Version, WriteMask};
use crate::program::{Instruction, Source};

const COMPONENTS: [WriteMask; 3] = [WriteMask::X, WriteMask::Y, WriteMask::Z];

/// Lowers a texture instruction whose destination is register number `m` in `slot`.
///
/// `m` also numbers the stage and, before `ps.1.4`, the coordinate set.
pub(super) fn lower(
    lowering: &mut Lowering<'_>,
    instruction: &Instruction,
    m: usize,
    slot: Slot,
) -> Result<(), String> {
    if lowering.version == Version::Ps14 {
        return with_sources(lowering, instruction, m, slot);
    }
    let coordinates = texcoord(m)?;
    let sample = Op::Sample(stage(m));
    let mask = destination_mask(instruction);
    let result = instruction.result;
    let first = instruction.sources.first();
    let texel = |lowering: &Lowering<'_>| -> Result<Operand, String> {
        let source = first.ok_or("a source is missing")?;
        lowering.operand(source)
    };
    match instruction.opcode {
        Opcode::Tex => {
            let at = projected(lowering, m, coordinates);
            lowering.push_result(sample, slot, mask, vec![at], result);
        }
        Opcode::TexCoord => {
            let mut clamped = result;
            clamped.saturate = true;
            let sources = vec![Operand::slot(coordinates)];
            lowering.push_result(Op::Mov, slot, mask.and(WriteMask::XYZ), sources, clamped);
            let one = vec![Operand::literal(1.0)];
            lowering.push_result(Op::Mov, slot, mask.and(WriteMask::W), one, result);
        }
        Opcode::TexKill => {
            let sources = vec![Operand::slot(coordinates)];
            lowering.push(Op::Kill, slot, WriteMask::XYZ, sources);
        }
        Opcode::TexBem | Opcode::TexBeml => {
            let texel = texel(lowering)?;
            let at = projected(lowering, m, coordinates);
            let bump = Op::Bump(stage(m));
            lowering.push(bump, Slot::COORDINATES, WriteMask::XYZ, vec![at, texel]);
            let bumped = vec![Operand::slot(Slot::COORDINATES)];
            lowering.push_result(sample, slot, mask, bumped, result);
            if instruction.opcode == Opcode::TexBeml {
                let sources = vec![Operand::slot(slot), texel];
                lowering.push_result(Op::Luminance(stage(m)), slot, mask, sources, result);
            }
        }
        Opcode::TexReg2Ar | Opcode::TexReg2Gb | Opcode::TexReg2Rgb => {
            let mut texel = texel(lowering)?;
            texel.swizzle = match instruction.opcode {
                Opcode::TexReg2Ar => Swizzle::new([3, 0, 0, 0]),
                Opcode::TexReg2Gb => Swizzle::new([1, 2, 2, 2]),
                _ => Swizzle::IDENTITY,
            };
            lowering.push_result(sample, slot, mask, vec![texel], result);
        }
        Opcode::TexM3x2Pad | Opcode::TexM3x3Pad => {
            let texel = texel(lowering)?;
            row(lowering, coordinates, texel);
        }
        Opcode::TexM3x2Tex | Opcode::TexM3x3Tex => {
            let texel = texel(lowering)?;
            last_row(lowering, instruction.opcode, coordinates, texel)?;
            let at = vec![Operand::slot(Slot::ROW)];
            lowering.push_result(sample, slot, mask, at, result);
        }
        Opcode::TexM3x2Depth => {
            let texel = texel(lowering)?;
            last_row(lowering, instruction.opcode, coordinates, texel)?;
            let rows = vec![Operand::slot(Slot::ROW)];
            lowering.push(Op::Depth, Slot::DEPTH, WriteMask::X, rows);
        }
        Opcode::TexM3x3 => {
            let texel = texel(lowering)?;
            last_row(lowering, instruction.opcode, coordinates, texel)?;
            let rows = vec![Operand::slot(Slot::ROW)];
            lowering.push_result(Op::Mov, slot, mask.and(WriteMask::XYZ), rows, result);
            let one = vec![Operand::literal(1.0)];
            lowering.push_result(Op::Mov, slot, mask.and(WriteMask::W), one, result);
        }
        Opcode::TexM3x3Spec | Opcode::TexM3x3VSpec => {
            let texel = texel(lowering)?;
            last_row(lowering, instruction.opcode, coordinates, texel)?;
            let eye = match instruction.sources.get(1) {
                Some(constant) => lowering.operand(constant)?,
                None => eye(lowering, m)?,
            };
            let sources = vec![Operand::slot(Slot::ROW), eye];
            lowering.push(Op::Reflect, Slot::COORDINATES, WriteMask::XYZ, sources);
            let at = vec![Operand::slot(Slot::COORDINATES)];
            lowering.push_result(sample, slot, mask, at, result);
        }
        Opcode::TexDp3 => {
            let sources = vec![Operand::slot(coordinates), texel(lowering)?];
            lowering.push_result(Op::Dp3, slot, mask, sources, result);
        }
        Opcode::TexDp3Tex => {
            let sources = vec![Operand::slot(coordinates), texel(lowering)?];
            lowering.push(Op::Dp3, Slot::COORDINATES, WriteMask::X, sources);
            let zero = vec![Operand::literal(0.0)];
            let rest = WriteMask::XYZ.without(WriteMask::X);
            lowering.push(Op::Mov, Slot::COORDINATES, rest, zero);
            let at = vec![Operand::slot(Slot::COORDINATES)];
            lowering.push_result(sample, slot, mask, at, result);
        }
        other => return Err(format!("{} is no texture instruction", other.mnemonic())),
    }
    Ok(())
}

/// The texture instructions of `ps.1.4`, which name their coordinates.
fn with_sources(
    lowering: &mut Lowering<'_>,
    instruction: &Instruction,
    m: usize,
    slot: Slot,
) -> Result<(), String> {
    let mask = destination_mask(instruction);
    let result = instruction.result;
    match (instruction.opcode, instruction.sources.first()) {
        (Opcode::TexLd, Some(source)) => {
            let at = divided(lowering, source)?;
            lowering.push_result(Op::Sample(stage(m)), slot, mask, vec![at], result);
        }
        (Opcode::TexCrd, Some(source)) => {
            let at = divided(lowering, source)?;
            // Without a mask the old assembler took all four components; the alpha is not defined.
            let mask = mask.and(WriteMask::XYZ);
            lowering.push_result(Op::Mov, slot, mask, vec![at], result);
        }
        (Opcode::TexKill, None) => {
            lowering.push(Op::Kill, slot, WriteMask::XYZ, vec![Operand::slot(slot)]);
        }
        (Opcode::TexDepth, None) => {
            lowering.push(
                Op::Depth,
                Slot::DEPTH,
                WriteMask::X,
                vec![Operand::slot(slot)],
            );
        }
        (other, _) => return Err(format!("{} is no texture instruction", other.mnemonic())),
    }
    Ok(())
}

fn destination_mask(instruction: &Instruction) -> WriteMask {
    instruction.destination.map_or(WriteMask::ALL, |d| d.mask)
}

fn texcoord(m: usize) -> Result<Slot, String> {
    Slot::texcoord(m).ok_or_else(|| format!("there is no coordinate set {m}"))
}

/// The coordinates of a set, divided where the stage is projected.
fn projected(lowering: &mut Lowering<'_>, m: usize, coordinates: Slot) -> Operand {
    let projection = lowering.options.projection.get(m).copied();
    let op = match projection.unwrap_or_default() {
        Projection::None => return Operand::slot(coordinates),
        Projection::Third => Op::Project(2),
        Projection::Fourth => Op::Project(3),
    };
    let sources = vec![Operand::slot(coordinates)];
    lowering.push(op, Slot::COORDINATES, WriteMask::XYZ, sources);
    Operand::slot(Slot::COORDINATES)
}

/// The source of `texld` or `texcrd` after its divide; the division sees the register, not the selector.
fn divided(lowering: &mut Lowering<'_>, source: &Source) -> Result<Operand, String> {
    let op = match source.modifier {
        SourceModifier::Dz => Op::DivideZ,
        SourceModifier::Dw => Op::DivideW,
        _ => return lowering.operand(source),
    };
    let operand = lowering.operand(&Source {
        modifier: SourceModifier::None,
        swizzle: Swizzle::IDENTITY,
        ..*source
    })?;
    lowering.push(op, Slot::COORDINATES, WriteMask::XYZ, vec![operand]);
    Ok(Operand::slot(Slot::COORDINATES))
}

/// One more row of a matrix product.
fn row(lowering: &mut Lowering<'_>, coordinates: Slot, texel: Operand) {
    let mask = COMPONENTS[lowering.rows.min(2)];
    lowering.push(
        Op::Dp3,
        Slot::ROW,
        mask,
        vec![Operand::slot(coordinates), texel],
    );
    lowering.rows += 1;
}

/// The row that an instruction adds before it uses all of them.
fn last_row(
    lowering: &mut Lowering<'_>,
    opcode: Opcode,
    coordinates: Slot,
    texel: Operand,
) -> Result<(), String> {
    let before = match opcode {
        Opcode::TexM3x2Tex | Opcode::TexM3x2Depth => 1,
        _ => 2,
    };
    if lowering.rows != before {
        return Err(format!(
            "{} completes {before} rows, but {} came before it",
            opcode.mnemonic(),
            lowering.rows
        ));
    }
    row(lowering, coordinates, texel);
    lowering.rows = 0;
    Ok(())
}

/// The eye vector of `texm3x3vspec`: the fourth components of the three coordinate sets.
fn eye(lowering: &mut Lowering<'_>, m: usize) -> Result<Operand, String> {
    for (component, mask) in COMPONENTS.into_iter().enumerate() {
        let set = (m + component)
            .checked_sub(2)
            .ok_or("texm3x3vspec needs two coordinate sets before its own")?;
        let q = Operand::new(Place::Slot(texcoord(set)?), Swizzle::replicate(3));
        lowering.push(Op::Mov, Slot::EYE, mask, vec![q]);
    }
    Ok(Operand::slot(Slot::EYE))
}
