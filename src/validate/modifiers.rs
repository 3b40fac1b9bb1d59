//! M1 to M13: modifiers, selectors and write masks of pixel shaders; O23, their absence from vertex shaders.

use super::listing::{Line, Listing, Phase};
use super::operands::is_condition_of_cnd;
use super::report::Report;
use crate::isa::enumerate;
use crate::isa::opcode::{DestinationShape, ModifierRule};
use crate::isa::{
    Class, Form, Opcode, RegisterFile, ResultModifier, SourceModifier, Swizzle, Version, WriteMask,
};
use crate::program::Source;
use crate::rules::model::Code;

pub(super) fn check(listing: &Listing, report: &mut Report) {
    for (line, form) in listing.known() {
        if listing.is_pixel() {
            result_modifier(listing, line, form, report);
            write_mask(listing, line, form, report);
            for (i, source) in line.instruction.sources.iter().enumerate() {
                if let Some(shape) = form.sources.get(i)
                    // What may be asked by cnd is O15, but a division would have no meaning at all.
                    && (!is_condition_of_cnd(listing.version, line, i) || divides(source.modifier))
                {
                    source_modifier(listing, line, form, shape.modifiers, source, report);
                    selector(listing, line, form, source, report);
                }
            }
        } else {
            vertex_modifiers(listing, line, report);
        }
    }
    if listing.version == Version::Ps14 {
        coordinates_agree(listing, report);
    }
}

/// O23.
fn vertex_modifiers(listing: &Listing, line: &Line, report: &mut Report) {
    let version = listing.version;
    if line.instruction.result != ResultModifier::NONE {
        report.breach(
            Code::O23,
            line.instruction.mnemonic_span,
            format!("{version} has no {}", line.instruction.result.text()),
            "clamp with min and max, scale with mul; oD# and oFog are clamped to 0…1 anyway",
        );
    }
    for source in &line.instruction.sources {
        let row = source.modifier.row();
        if !row.arithmetic.contains(version) {
            report.breach(
                Code::O23,
                source.span,
                format!("{version} has no {}", written(source.modifier)),
                format!("compute {} with an instruction of its own", row.formula),
            );
        }
    }
}

/// A source modifier as it is written: `_bx2`, `1-`, `-…_bias`.
fn written(modifier: SourceModifier) -> String {
    let row = modifier.row();
    match (row.prefix, row.suffix) {
        ("-", "") => "minus sign".to_string(),
        (prefix, "") => prefix.to_string(),
        ("", suffix) => suffix.to_string(),
        (prefix, suffix) => format!("{prefix}…{suffix}"),
    }
}

/// M1, M2 on results.
fn result_modifier(listing: &Listing, line: &Line, form: &Form, report: &mut Report) {
    let result = line.instruction.result;
    if result == ResultModifier::NONE {
        return;
    }
    let span = line.instruction.mnemonic_span;
    if form.class != Class::Arithmetic || form.destination.is_none() {
        report.breach(
            Code::M2,
            span,
            format!("{} takes no {}", line.mnemonic(), result.text()),
            "put it on the arithmetic instruction that uses the result",
        );
    } else if !result.exists_in(listing.version) {
        let help = match result.shift_row() {
            Some(row) => format!(
                "{} is for {}; _x2, _x4 and _d2 are for all pixel shaders",
                row.suffix, row.versions
            ),
            None => "a result is scaled by 8, 4, 2, 1/2, 1/4 or 1/8".to_string(),
        };
        report.breach(
            Code::M1,
            span,
            format!("{} has no {}", listing.version, scale(result)),
            help,
        );
    }
}

/// A scale as its suffix, or as a number where there is none.
fn scale(result: ResultModifier) -> String {
    result.shift_row().map_or_else(
        || format!("scale of 2^{}", result.shift),
        |row| row.suffix.to_string(),
    )
}

/// M7, M8, M13, O16; the masks of `bem` and `texcrd` are in `operands`.
fn write_mask(listing: &Listing, line: &Line, form: &Form, report: &mut Report) {
    let (Some(destination), Some(shape)) = (line.instruction.destination, form.destination) else {
        return;
    };
    if shape.masks.contains(destination.mask) {
        return;
    }
    let code = match (line.instruction.opcode, form.class) {
        (Opcode::Bem | Opcode::TexCrd, _) => return,
        (_, Class::Texture) => Code::M13,
        // Of one in a pair C6 speaks.
        (Opcode::Dp3, _) if line.paired && destination.mask.has(3) => return,
        (Opcode::Dp3, _) => Code::M8,
        (Opcode::Cnd, _) => Code::O16,
        _ => Code::M7,
    };
    let (name, version) = (line.mnemonic(), listing.version);
    let mask = listing.mask(destination.mask);
    let message = match shape.written {
        true => format!("{name} of {version} does not write {mask}"),
        false => format!("{name} writes nothing and takes no mask"),
    };
    let help = match code {
        Code::M13 if !shape.written => format!("write {}", destination.register),
        Code::M13 => "leave the mask out; all four components are written".to_string(),
        _ => format!(
            "write {}; ps.1.4 writes any components",
            allowed_masks(listing, shape)
        ),
    };
    report.breach(code, destination.span, message, help);
}

/// The masks of a form, for people.
pub(super) fn allowed_masks(listing: &Listing, shape: DestinationShape) -> String {
    let masks: Vec<String> = shape.masks.iter().map(|m| listing.mask(m)).collect();
    enumerate(&masks, "or")
}

/// M1 on sources, M3, M5, M6, M12.
fn source_modifier(
    listing: &Listing,
    line: &Line,
    form: &Form,
    rule: ModifierRule,
    source: &Source,
    report: &mut Report,
) {
    let modifier = source.modifier;
    if modifier == SourceModifier::None {
        return;
    }
    let version = listing.version;
    if divides(modifier) {
        division(version, line, source, report);
        return;
    }
    let text = written(modifier);
    if form.class == Class::Texture {
        let takes = match rule {
            ModifierRule::Bx2(versions) => {
                modifier == SourceModifier::Bx2 && versions.contains(version)
            }
            _ => false,
        };
        if !takes {
            report.breach(
                Code::M3,
                source.span,
                format!("{} of {version} takes no {text}", line.mnemonic()),
                texture_modifiers(rule),
            );
        }
        return;
    }
    let row = modifier.row();
    if !row.arithmetic.contains(version) {
        report.breach(
            Code::M1,
            source.span,
            match row.suffix {
                "" => format!("{version} has no {text} on a source"),
                // The minus sign is not what is missing.
                suffix => format!("{version} has no `{suffix}` on a source"),
            },
            format!("only {} has it", row.arithmetic),
        );
    } else if source.register.file == RegisterFile::Const {
        on_a_constant(listing, source, report);
    }
}

fn divides(modifier: SourceModifier) -> bool {
    modifier.row().divides.is_some()
}

/// What a texture instruction takes instead.
fn texture_modifiers(rule: ModifierRule) -> String {
    match rule {
        ModifierRule::Bx2(versions) if versions.iter().count() > 0 => {
            format!("only _bx2, in {}", versions)
        }
        ModifierRule::Bx2(_) => "its source is read as it is, signed formats as signed".to_string(),
        ModifierRule::Coordinates => "only r#_dz, or t#_dw with .xyw".to_string(),
        _ => "leave it out".to_string(),
    }
}

/// M12, and M1 where the version cannot divide. Nothing but the coordinates of a texture instruction is divided.
fn division(version: Version, line: &Line, source: &Source, report: &mut Report) {
    let modifier = source.modifier;
    let row = modifier.row();
    if !row.coordinates.contains(version) {
        report.breach(
            Code::M1Divide,
            source.span,
            format!("{version} has no `{}` on a source", row.suffix),
            format!("only {} has it", row.coordinates),
        );
        return;
    }
    let file = source.register.file;
    let fits = match modifier {
        SourceModifier::Dz => {
            line.instruction.opcode == Opcode::TexLd && file == RegisterFile::Temp
        }
        _ => line.is_texture() && file == RegisterFile::Texture && source.swizzle == Swizzle::XYWW,
    };
    if fits {
        return;
    }
    let message = match modifier {
        SourceModifier::Dz => format!(
            "{} cannot divide {} by its third component",
            line.mnemonic(),
            source.register
        ),
        _ if line.is_texture() && file == RegisterFile::Texture => {
            format!("{}_dw is read without .xyw", source.register)
        }
        _ => format!(
            "{} cannot divide {} by its fourth component",
            line.mnemonic(),
            source.register
        ),
    };
    let code = match line.is_texture() {
        true => Code::M12,
        false => Code::M12Arithmetic,
    };
    report.breach(
        code,
        source.span,
        message,
        "texld reads r#_dz; texld and texcrd read t#_dw.xyw",
    );
}

/// M5, M6.
fn on_a_constant(listing: &Listing, source: &Source, report: &mut Report) {
    let register = source.register;
    let text = written(source.modifier);
    if listing.version == Version::Ps14 {
        report.breach(
            Code::M5,
            source.span,
            format!("ps.1.4 takes no {text} on {register}"),
            format!(
                "store {} in a constant of its own, or mov it to r# first",
                source
                    .modifier
                    .row()
                    .formula
                    .replace('x', &register.to_string())
            ),
        );
    } else {
        report.breach(
            Code::M6,
            source.span,
            format!("{text} on the constant {register} is not defined by the documents"),
            "it is computed here as for any register; a constant of its own is safe everywhere",
        );
    }
}

/// M9, M10.
fn selector(listing: &Listing, line: &Line, form: &Form, source: &Source, report: &mut Report) {
    let swizzle = source.swizzle;
    // The divided coordinates have their selector in M12, the condition of cnd in O15.
    if swizzle == Swizzle::IDENTITY || divides(source.modifier) {
        return;
    }
    let letters = listing.program.letters();
    let one = swizzle.replicated();
    let (fits, code, help) = match (listing.version, form.class) {
        (Version::Ps14, Class::Texture) => {
            let coordinates = swizzle == Swizzle::XYZZ
                || (swizzle == Swizzle::XYWW && source.register.file == RegisterFile::Texture);
            (
                coordinates,
                Code::M10,
                "it reads t# as .xyz or .xyw, r# as .xyz",
            )
        }
        (Version::Ps14, _) => (
            one.is_some(),
            Code::M10,
            "it reads one of .r, .g, .b, .a, or all as they are",
        ),
        (_, Class::Texture) => (false, Code::M9, "texture instructions read all of a t#"),
        (version, _) => {
            let to_alpha = line
                .instruction
                .destination
                .is_some_and(|d| d.mask == WriteMask::W);
            let blue = one == Some(2) && version != Version::Ps10 && to_alpha;
            let help = match (one, version) {
                (Some(2), Version::Ps10) => "it reads .a; ps.1.1 has .b too, for a result in .a",
                (Some(2), _) => ".b goes with a result in .a only; .a with any",
                (None, _) if swizzle == Swizzle::XYZZ => {
                    "leave it out; the write mask says which components are used"
                }
                _ => "it reads .a, and from ps.1.1 on .b for a result in .a; ps.1.4 has all four",
            };
            (one == Some(3) || blue, Code::M9, help)
        }
    };
    if !fits {
        report.breach(
            code,
            source.span,
            format!(
                "{} of {} does not read {}{}",
                line.mnemonic(),
                listing.version,
                source.register,
                swizzle.text(letters)
            ),
            help,
        );
    }
}

/// M11. Reading differently within a phase is worse than across phases; each register is named once.
fn coordinates_agree(listing: &Listing, report: &mut Report) {
    const SETS: usize = 8;
    let mut first: [Option<(bool, Phase)>; SETS] = [None; SETS];
    let mut told = [false; SETS];
    for (line, form) in listing.known() {
        let sources = line.instruction.sources.iter();
        for source in sources.filter(|s| s.register.file == RegisterFile::Texture) {
            let at = source.register.index as usize;
            let (true, Some(seen), Some(told)) = (
                form.class == Class::Texture,
                first.get_mut(at),
                told.get_mut(at),
            ) else {
                continue;
            };
            let with_w = source.swizzle == Swizzle::XYWW;
            let (before, phase) = *seen.get_or_insert((with_w, line.phase));
            if before == with_w || *told {
                continue;
            }
            *told = true;
            let (code, place) = if phase == line.phase {
                (Code::M11, "")
            } else {
                (Code::M11Phases, " in the other phase")
            };
            let letters = |w| if w { ".xyw" } else { ".xyz" };
            report.breach(
                code,
                source.span,
                format!(
                    "{} is read as {} here and as {} before{place}",
                    source.register,
                    letters(with_w),
                    letters(before)
                ),
                "read it the same way everywhere, or pass the coordinates twice",
            );
        }
    }
}
