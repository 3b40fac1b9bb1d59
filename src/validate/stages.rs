//! T1 to T12 and I4: the texture registers of `ps.1.0` to `ps.1.3`, which are stages, coordinates and results at once.

use super::listing::{Line, Listing, Read};
use super::report::Report;
use crate::diagnostic::Span;
use crate::isa::{Opcode, RegisterFile, WriteMask};
use crate::program::Register;
use crate::rules::model::Code;

pub(super) fn check(listing: &Listing, report: &mut Report) {
    if !listing.has_texture_stages() {
        return;
    }
    stages_increase(listing, report);
    // A row that could not be read is no missing row.
    let broken = match listing.hides_texture_instructions() {
        true => [true; STAGES],
        false => matrices_are_whole(listing, report),
    };
    contents_are_readable(listing, &broken, report);
}

/// The number of the `t#` that a texture instruction names as its destination, which is its stage.
fn stage(line: &Line) -> Option<u32> {
    let register = line.instruction.destination?.register;
    (line.is_texture() && register.file == RegisterFile::Texture).then_some(register.index)
}

/// T1, T2.
fn stages_increase(listing: &Listing, report: &mut Report) {
    let mut last: Option<(u32, &Line)> = None;
    let mut users: [Option<&Line>; STAGES] = [None; STAGES];
    // What goes beyond the number of stages is told by B2.
    let stages = listing.version.row().texture_slots as usize;
    for line in listing.lines.iter().filter(|l| l.is_texture()).take(stages) {
        let (Some(stage), Some(destination)) = (stage(line), line.instruction.destination) else {
            continue;
        };
        let user = users.get_mut(stage as usize);
        let same = user.and_then(|user| user.replace(line));
        // What is told of one is not told again of those behind it.
        let last = last.replace((stage, line));
        let Some((before, earlier)) = last.filter(|(before, _)| stage <= *before) else {
            continue;
        };
        if listing
            .reads(line)
            .iter()
            .any(|read| is_no_lower(read, stage))
        {
            continue; // T3 speaks of what it reads, which follows from the order.
        }
        // texkill writes nothing; whether it takes part in the order is not written down.
        let kills = |l: &Line| l.instruction.opcode == Opcode::TexKill;
        let (code, message) = match same {
            Some(same) => (
                Code::T2,
                format!("stage {stage} is used by {} before", same.mnemonic()),
            ),
            None => (
                Code::T1,
                format!(
                    "{} t{stage} stands behind {} t{before}",
                    line.mnemonic(),
                    earlier.mnemonic()
                ),
            ),
        };
        let code = if kills(line) || kills(same.unwrap_or(earlier)) {
            Code::T1Kill
        } else {
            code
        };
        report.breach(
            code,
            destination.span,
            message,
            "each t# is the destination of one texture instruction, in the order t0, t1, t2, t3",
        );
    }
}

/// The part of a matrix that a texture instruction is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Row {
    /// A pad of a matrix of so many rows.
    Pad(u32),
    /// The last row.
    Last(u32),
}

fn row(opcode: Opcode) -> Option<Row> {
    Some(match opcode {
        Opcode::TexM3x2Pad => Row::Pad(2),
        Opcode::TexM3x2Tex | Opcode::TexM3x2Depth => Row::Last(2),
        Opcode::TexM3x3Pad => Row::Pad(3),
        Opcode::TexM3x3Tex | Opcode::TexM3x3Spec | Opcode::TexM3x3VSpec | Opcode::TexM3x3 => {
            Row::Last(3)
        }
        _ => return None,
    })
}

/// A matrix whose last row has not come yet.
struct Open<'a> {
    rows: u32,
    pads: u32,
    /// The stage of the last pad.
    stage: u32,
    /// The source of the first pad.
    source: Option<Register>,
    last: &'a Line<'a>,
    /// Whether its first pad stands where another row was awaited, which was told.
    told: bool,
}

impl Open<'_> {
    /// Marks the stages of its pads.
    fn mark(&self, stages: &mut [bool; STAGES]) {
        for pad in 0..self.pads {
            let stage = self.stage.checked_sub(pad);
            if let Some(stage) = stage.and_then(|s| stages.get_mut(s as usize)) {
                *stage = true;
            }
        }
    }
}

/// T4, T5, T6, T7. Returns the stages whose pads belong to no whole matrix.
fn matrices_are_whole(listing: &Listing, report: &mut Report) -> [bool; STAGES] {
    let mut open: Option<Open> = None;
    let mut broken = [false; STAGES];
    // Rows of the matrix that was broken off last, of which the last one may still come.
    let mut missed = None;
    for line in &listing.lines {
        if line.form.is_none() {
            // An instruction of another version may have been the row that is awaited.
            open.take().inspect(|open| open.mark(&mut broken));
            continue;
        }
        if line.is_arithmetic() {
            open.take()
                .inspect(|open| left_open(open, &mut broken, report));
            continue;
        }
        let Some(stage) = stage(line) else { continue };
        let source = line.instruction.sources.first().map(|s| s.register);
        let row = row(line.instruction.opcode);
        let continues = open.as_ref().is_some_and(|o| {
            let rows = match row {
                Some(Row::Pad(rows)) if o.pads + 1 < o.rows => rows,
                Some(Row::Last(rows)) if o.pads + 1 == o.rows => rows,
                _ => 0,
            };
            rows == o.rows && Some(stage) == o.stage.checked_add(1)
        });
        match (open.take(), row) {
            (Some(before), Some(row)) if continues => {
                if source != before.source {
                    sources_differ(&before, line, report);
                }
                if matches!(row, Row::Pad(_)) {
                    open = Some(Open {
                        pads: before.pads + 1,
                        stage,
                        last: line,
                        ..before
                    });
                }
            }
            (before, row) => {
                // A pad that goes nowhere is one fault, whatever stands in the place of the row it waits for.
                let told = before.is_some();
                if let Some(before) = before {
                    interrupted(&before, line, &mut broken, report);
                    missed = Some(before.rows);
                }
                match row {
                    Some(Row::Pad(rows)) => {
                        open = Some(Open {
                            rows,
                            pads: 1,
                            stage,
                            source,
                            last: line,
                            told,
                        });
                    }
                    Some(Row::Last(rows)) if !told && missed.take() != Some(rows) => {
                        without_pads(line, rows, stage, report);
                    }
                    _ => {}
                }
            }
        }
    }
    open.inspect(|open| left_open(open, &mut broken, report));
    broken
}

/// The rule on matrices of so many rows.
fn matrix_code(rows: u32) -> Code {
    if rows == 2 { Code::T4 } else { Code::T5 }
}

/// What has to stand at the stage behind a pad.
fn awaited(open: &Open) -> String {
    let stage = open.stage.saturating_add(1);
    match (open.rows, open.pads) {
        (2, _) => format!("texm3x2tex t{stage} (in ps.1.3 also texm3x2depth)"),
        (_, 1) => format!("texm3x3pad t{stage}"),
        _ => format!(
            "texm3x3tex, texm3x3spec or texm3x3vspec t{stage} (from ps.1.2 on also texm3x3)"
        ),
    }
}

fn interrupted(open: &Open, line: &Line, broken: &mut [bool; STAGES], report: &mut Report) {
    open.mark(broken);
    if open.told {
        return;
    }
    let stage = line.instruction.destination.map(|d| d.register.to_string());
    report.breach(
        matrix_code(open.rows),
        line.instruction.mnemonic_span,
        format!(
            "{} t{} is followed by {} {}",
            open.last.mnemonic(),
            open.stage,
            line.mnemonic(),
            stage.unwrap_or_default()
        ),
        format!("{} has to follow", awaited(open)),
    );
}

fn without_pads(line: &Line, rows: u32, stage: u32, report: &mut Report) {
    let pads = rows - 1;
    let help = match (stage.checked_sub(pads), rows) {
        (None, _) => format!("it needs {pads} lower stages for its pads"),
        (Some(first), 2) => format!("texm3x2pad t{first} stands right before it"),
        (Some(first), _) => {
            format!(
                "texm3x3pad t{first} and texm3x3pad t{} stand right before it",
                first + 1
            )
        }
    };
    report.breach(
        matrix_code(rows),
        line.instruction.mnemonic_span,
        format!("{} t{stage} has no pads before it", line.mnemonic()),
        help,
    );
}

fn left_open(open: &Open, broken: &mut [bool; STAGES], report: &mut Report) {
    open.mark(broken);
    if open.told {
        return;
    }
    report.breach(
        Code::T7,
        open.last.instruction.mnemonic_span,
        format!(
            "{} t{} is the last texture instruction; its matrix is not complete",
            open.last.mnemonic(),
            open.stage
        ),
        format!("{} has to follow", awaited(open)),
    );
}

fn sources_differ(open: &Open, line: &Line, report: &mut Report) {
    let (Some(source), Some(first)) = (line.instruction.sources.first(), open.source) else {
        return;
    };
    let files = [source.register.file, first.file];
    if files != [RegisterFile::Texture; 2] {
        return; // O10 and O13 speak of other files.
    }
    report.breach(
        Code::T6,
        source.span,
        format!(
            "this row of the matrix reads {}, the first reads {first}",
            source.register
        ),
        "the documents know matrices that read one t# only; each row reads its own here",
    );
}

/// Why a `t#` holds what it holds.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Origin {
    /// A texture instruction; whether it read another `t#`.
    Texture {
        dependent: bool,
    },
    Pad,
    Depth,
    Kill,
}

/// What is known of one `t#`.
#[derive(Clone, Copy)]
struct Content {
    origin: Option<Origin>,
    /// Components that hold a value.
    written: WriteMask,
    /// Components that `texbem` has read and nothing has overwritten since.
    bumped: WriteMask,
    /// Whether something was said of this register already.
    told: bool,
}

const STAGES: usize = 8;

/// T3, T8 to T12, I4.
fn contents_are_readable(listing: &Listing, broken: &[bool; STAGES], report: &mut Report) {
    let mut contents = [Content {
        origin: None,
        written: WriteMask::NONE,
        bumped: WriteMask::NONE,
        told: false,
    }; STAGES];
    for group in listing.groups() {
        // Both halves of a pair read before either writes.
        for line in group {
            let is_register =
                |r: &&Read| r.register.file == RegisterFile::Texture && listing.exists(r.register);
            for read in listing.reads(line).iter().filter(is_register) {
                if listing.hides_write(read.register, read.span) {
                    continue;
                }
                let index = read.register.index;
                let Some(content) = contents.get_mut(index as usize) else {
                    continue;
                };
                match stage(line) {
                    Some(stage) => texture_reads(line, stage, read, content, report),
                    None => arithmetic_reads(listing, line, read, content, report),
                }
            }
        }
        for line in group {
            written(line, broken, &mut contents);
        }
    }
}

/// Whether a register is that of a pad of the matrix that a line is a row of.
fn is_own_pad(line: &Line, stage: u32, register: Register) -> bool {
    let rows = match row(line.instruction.opcode) {
        Some(Row::Pad(rows) | Row::Last(rows)) => rows,
        None => 0,
    };
    register.index < stage && stage - register.index < rows
}

/// Whether a texture instruction of a stage reads a `t#` that cannot come before it.
fn is_no_lower(read: &Read, stage: u32) -> bool {
    read.register.file == RegisterFile::Texture && read.register.index >= stage
}

/// T3, T12, and what both kinds of reader share.
fn texture_reads(line: &Line, stage: u32, read: &Read, content: &mut Content, report: &mut Report) {
    let (name, register, span) = (line.mnemonic(), read.register, read.span);
    let bumps = matches!(line.instruction.opcode, Opcode::TexBem | Opcode::TexBeml);
    if is_no_lower(read, stage) {
        report.breach(
            Code::T3,
            span,
            format!("{name} t{stage} reads {register}, which is not of a lower number"),
            "a texture instruction reads what an earlier stage has left",
        );
        return;
    }
    if content.origin.is_none() && content.written.is_empty() {
        if !std::mem::replace(&mut content.told, true) {
            report.breach(
                Code::T3,
                span,
                format!("{name} reads {register}, which no texture instruction has written before"),
                format!("put tex {register} before it"),
            );
        }
    } else if content.origin == Some(Origin::Pad) && is_own_pad(line, stage, register) {
        // T6 speaks of a row that reads what another row of its matrix has left.
    } else if !unreadable(span, register, content, report) {
        if content.origin == Some(Origin::Texture { dependent: true }) {
            report.breach(
                Code::T12,
                span,
                format!("{name} reads {register}, which itself depends on another texture"),
                "not all hardware of the time could do it; here it is computed as written",
            );
        }
        if !bumps {
            read_after_bump(read, content, report);
        }
    }
    if bumps {
        content.bumped = WriteMask::ALL;
    }
}

/// I4, and what both kinds of reader share.
fn arithmetic_reads(
    listing: &Listing,
    line: &Line,
    read: &Read,
    content: &mut Content,
    report: &mut Report,
) {
    let (register, span) = (read.register, read.span);
    if content.written.contains(read.components) || unreadable(span, register, content, report) {
        read_after_bump(read, content, report);
        return;
    }
    if std::mem::replace(&mut content.told, true) || content.origin.is_some() {
        return;
    }
    let missing = read.components.without(content.written);
    report.breach(
        Code::I4,
        span,
        format!(
            "{} reads {}, which nothing has written before",
            line.mnemonic(),
            listing.name(register, missing)
        ),
        format!(
            "tex {register} samples a texture, texcoord {register} takes the coordinates themselves"
        ),
    );
}

/// T8, T10, T11. Returns whether the register cannot be read.
fn unreadable(span: Span, register: Register, content: &mut Content, report: &mut Report) -> bool {
    let (code, message, help) = match content.origin {
        Some(Origin::Pad) => (
            Code::T8,
            format!("{register} is the destination of a pad and holds nothing that can be read"),
            "read the t# of the last row of the matrix",
        ),
        Some(Origin::Depth) => (
            Code::T10,
            format!("{register} has been used up by texm3x2depth"),
            "the result is the depth of the pixel and in no register",
        ),
        Some(Origin::Kill) => (
            Code::T11,
            format!("{register} is the operand of texkill and holds nothing defined"),
            "texkill looks at the coordinates; use another stage for a texture",
        ),
        _ => return false,
    };
    if !std::mem::replace(&mut content.told, true) {
        report.breach(code, span, message, help);
    }
    true
}

/// T9.
fn read_after_bump(read: &Read, content: &mut Content, report: &mut Report) {
    if content.bumped.and(read.components).is_empty() || std::mem::replace(&mut content.told, true)
    {
        return;
    }
    report.breach(
        Code::T9,
        read.span,
        format!(
            "{} is read again after texbem or texbeml has read it",
            read.register
        ),
        "sample the bump map a second time in another stage to read it",
    );
}

/// What a line leaves in its `t#`.
fn written(line: &Line, broken: &[bool; STAGES], contents: &mut [Content; STAGES]) {
    if let Some(stage) = stage(line)
        && let Some(content) = contents.get_mut(stage as usize)
    {
        let opcode = line.instruction.opcode;
        let dependent = !line.instruction.sources.is_empty();
        let (origin, written) = match (row(opcode), opcode) {
            (Some(Row::Pad(_)), _) => (Origin::Pad, WriteMask::NONE),
            (_, Opcode::TexM3x2Depth) => (Origin::Depth, WriteMask::NONE),
            // What an earlier instruction has left there is still there.
            (_, Opcode::TexKill) if content.origin.is_some() => return,
            (_, Opcode::TexKill) => (Origin::Kill, WriteMask::NONE),
            _ => (Origin::Texture { dependent }, WriteMask::ALL),
        };
        content.origin = Some(origin);
        content.written = written;
        // Of the pad of a matrix that is not whole enough was said.
        content.told |= origin == Origin::Pad && broken.get(stage as usize) == Some(&true);
        return;
    }
    if let Some((register, mask)) = line.writes()
        && register.file == RegisterFile::Texture
        && let Some(content) = contents.get_mut(register.index as usize)
    {
        content.written = content.written.or(mask);
        content.bumped = content.bumped.without(mask);
        if content.written == WriteMask::ALL {
            content.origin = Some(Origin::Texture { dependent: false });
        }
    }
}
