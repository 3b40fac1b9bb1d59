//! The listing: breakpoints, the next instruction, the one just done, the cursor.

use super::{Screen, clean, put};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};
use texcrd::debug::{Session, Style};
use texcrd::diagnostic::SourceFile;
use texcrd::isa::Opcode;
use texcrd::program::Instruction;
use texcrd::validate::statistics;

/// The text that the place is in.
pub(in crate::tui) struct Page<'a> {
    file: &'a SourceFile,
    /// How many lines it has.
    pub lines: usize,
    /// The lines of the instructions in it, by their numbers in the program; 0 for those of other texts.
    pub instructions: Vec<usize>,
}

impl<'a> Page<'a> {
    /// The text with the next instruction; at the end of a run the one of the last.
    pub(in crate::tui) fn of(session: &Session<'a>) -> Option<Self> {
        let listing = session.run()?.listing;
        let next = session
            .next_instruction()
            .and_then(|i| listing.instruction(i));
        let here = next.or_else(|| listing.program.instructions().last());
        let start = here.map_or(listing.program.span.start, |i| i.span.start);
        let file = listing.sources.file_of(start)?;
        let line = |instruction: &Instruction| {
            let inside = file.span().start <= instruction.span.start
                && instruction.span.start < file.span().end;
            let found = listing.sources.locate(instruction.span).filter(|_| inside);
            found.map_or(0, |at| at.line)
        };
        let instructions = listing.program.instructions().map(line).collect();
        let last = file.line_at(file.bytes().len() as u32);
        // A text that ends with the end of a line has no line behind it.
        let lines = last - usize::from(last > 1 && file.line(last).is_empty());
        Some(Self {
            file,
            lines,
            instructions,
        })
    }

    /// The line of an instruction, if it is on the page.
    pub(in crate::tui) fn line_of(&self, instruction: usize) -> Option<usize> {
        let line = self.instructions.get(instruction).copied();
        line.filter(|line| *line > 0)
    }
}

/// The first line that is shown: the cursor in the middle, no empty rows that could be full.
pub(in crate::tui) fn top(rows: usize, lines: usize, cursor: usize) -> usize {
    let most = (lines + 1).saturating_sub(rows).max(1);
    cursor.saturating_sub(rows / 2).clamp(1, most)
}

/// Draws the pane; gives the budget of the phase for its heading.
pub(super) fn draw(screen: &Screen<'_, '_>, buf: &mut Buffer, area: Rect) -> String {
    let (session, model, theme) = (screen.session, screen.model, screen.theme);
    let (Some(run), Some(page)) = (session.run(), Page::of(session)) else {
        return String::new();
    };
    let next = session.next_instruction();
    let next_line = next.and_then(|next| page.line_of(next));
    let done = session.last_moment().and_then(|moment| moment.instruction);
    let done_line = done.and_then(|done| page.line_of(done));
    let kind = run.listing.kind();
    let breakpoint = |line: usize| {
        let mut here = screen
            .console
            .stops
            .breakpoints
            .iter()
            .filter(|breakpoint| {
                breakpoint.kind == kind && page.line_of(breakpoint.instruction) == Some(line)
            });
        let first = here.next()?;
        let enabled = first.action.enabled || here.any(|other| other.action.enabled);
        Some(if enabled { "●" } else { "○" })
    };
    let digits = page.lines.to_string().len().max(3);
    let first = top(usize::from(area.height), page.lines, model.cursor);
    for (row, line) in (first..=page.lines)
        .take(usize::from(area.height))
        .enumerate()
    {
        let text = clean(&String::from_utf8_lossy(page.file.line(line)));
        let (mark, meaning) = if next_line == Some(line) {
            ("->", Style::Marked)
        } else if done_line == Some(line) {
            (" *", Style::Changed)
        } else {
            ("  ", Style::Plain)
        };
        let here = model.cursor == line;
        let look = theme.style(&meaning);
        let number = theme.style(if here { &Style::Strong } else { &Style::Dim });
        put(
            buf,
            area,
            row,
            Line::from(vec![
                Span::styled(breakpoint(line).unwrap_or(" "), theme.style(&Style::Error)),
                Span::styled(mark, look),
                Span::styled(format!("{line:>digits$}"), number),
                Span::raw(if here { "›" } else { " " }),
                Span::styled(text, look),
            ]),
        );
        if here && screen.has_focus(super::Pane::Listing) {
            let row = Rect::new(area.x, area.y + row as u16, area.width, 1);
            buf.set_style(row, theme.cursor());
        }
    }
    budget(session)
}

/// What the phase of the place uses of what it may.
fn budget(session: &Session<'_>) -> String {
    let Some(run) = session.run() else {
        return String::new();
    };
    let program = run.listing.program;
    let statistics = statistics(program);
    let count = program.instructions().count();
    let before = program
        .instructions()
        .take(session.next_instruction().unwrap_or(count));
    let phase = before.filter(|i| i.opcode == Opcode::Phase).count();
    let phases = statistics.phases.len();
    let Some(slots) = statistics.phases.get(phase.min(phases.saturating_sub(1))) else {
        return String::new();
    };
    let arithmetic = slots.arithmetic;
    if slots.texture.allowed == 0 {
        return format!("slots {}/{}", arithmetic.used, arithmetic.allowed);
    }
    let name = if phases > 1 {
        format!("phase {}: ", phase + 1)
    } else {
        String::new()
    };
    format!(
        "{name}tex {}/{} arith {}/{}",
        slots.texture.used, slots.texture.allowed, arithmetic.used, arithmetic.allowed
    )
}

#[cfg(test)]
mod tests {
    use super::top;

    #[test]
    fn the_cursor_stays_in_sight() {
        // 10 rows over 30 lines: line 15 is sixth; the first and the last page are full.
        assert_eq!(top(10, 30, 15), 10);
        assert_eq!(top(10, 30, 2), 1);
        assert_eq!(top(10, 30, 30), 21);
        assert_eq!(top(10, 5, 4), 1);
        assert_eq!(top(0, 0, 1), 1);
    }
}
