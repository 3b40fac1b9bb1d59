//! Lines of listings, and conditions behind them.

use super::Fault;
use crate::debug::expression::Expression;
use crate::debug::run::{Listing, Run};
use crate::debug::session::{Position, Session};
use crate::isa::ShaderKind;

/// An instruction of one of the listings of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    pub(super) kind: ShaderKind,
    pub(super) instruction: usize,
}

/// The two letters of a kind of shader.
pub(super) fn kind_name(kind: ShaderKind) -> &'static str {
    match kind {
        ShaderKind::Vertex => "vs",
        ShaderKind::Pixel => "ps",
    }
}

/// The listing of a kind of shader; that of the run where one is, if it is of this kind.
pub(super) fn listing<'s>(session: &'s Session<'_>, kind: ShaderKind) -> Option<Listing<'s>> {
    let here = session.run().into_iter().chain(session.runs());
    let mut listings = here.map(|run| run.listing);
    listings.find(|listing| listing.kind() == kind)
}

/// Reads `12`, `vs:12`, `ps:12`, `FILE:12`, or nothing for the instruction that comes next.
pub(super) fn place(session: &Session<'_>, text: &str) -> Result<Place, Fault> {
    let run = session.run().ok_or("there is no run")?;
    let text = text.trim();
    if text.is_empty() {
        let instruction = session
            .next_instruction()
            .ok_or("no instruction comes next: this is the end of the run")?;
        let kind = run.listing.kind();
        return Ok(Place { kind, instruction });
    }
    let (listing, line) = match text.rsplit_once(':') {
        None => (run.listing, text),
        Some((name, line)) => (named(session, name.trim())?, line.trim()),
    };
    let line: usize = (line.parse())
        .map_err(|_| format!("`{text}` is no line: write 12, vs:12, ps:12 or FILE:12"))?;
    let instructions = listing.instructions_at(line);
    if instructions.is_empty() {
        let kind = kind_name(listing.kind());
        return Err(format!("{kind}: no instruction stands on line {line} or below").into());
    }
    Ok(Place {
        kind: listing.kind(),
        instruction: instructions.start,
    })
}

/// The listing of a name: `vs`, `ps`, a file.
fn named<'s>(session: &'s Session<'_>, name: &str) -> Result<Listing<'s>, Fault> {
    for kind in [ShaderKind::Vertex, ShaderKind::Pixel] {
        if name.eq_ignore_ascii_case(kind_name(kind)) {
            let missing = format!("there is no {name} here");
            return listing(session, kind).ok_or_else(|| missing.into());
        }
    }
    let fits = |run: &&Run<'_>| {
        file_name(&run.listing).is_some_and(|file| {
            let before = file.strip_suffix(name);
            before.is_some_and(|before| before.is_empty() || before.ends_with(['/', '\\']))
        })
    };
    let found = session.runs().iter().find(fits);
    let known = session
        .runs()
        .iter()
        .filter_map(|run| file_name(&run.listing));
    found.map(|run| run.listing).ok_or_else(|| {
        let mut known: Vec<&str> = known.collect();
        known.dedup();
        format!(
            "`{name}` is no listing here; there are {}",
            known.join(", ")
        )
        .into()
    })
}

/// The name of the file that a listing stands in.
pub(super) fn file_name<'s>(listing: &Listing<'s>) -> Option<&'s str> {
    let at = listing.sources.locate(listing.program.span)?;
    Some(at.file)
}

/// `vs:12`: where an instruction stands, the kind named.
pub(super) fn text(session: &Session<'_>, place: Place) -> String {
    let listing = listing(session, place.kind);
    let line = listing.map_or(0, |listing| listing.line(place.instruction));
    format!("{}:{line}", kind_name(place.kind))
}

/// Where an instruction is about to run: in the run where one is, or else in the first that has it.
pub(super) fn position(session: &Session<'_>, place: Place) -> Option<Position> {
    let here = session.position().run;
    let numbers = std::iter::once(here).chain(0..session.runs().len());
    numbers.into_iter().find_map(|number| {
        let run = session.runs().get(number)?;
        let of_place = run.listing.kind() == place.kind;
        let mut moments = run.moments.iter();
        let at = moments.position(|m| m.instruction == Some(place.instruction))?;
        of_place.then_some(Position { run: number, at })
    })
}

/// Splits `12 if r0.x > 1` into what stands before the `if` and the condition.
pub(super) fn condition(text: &str) -> Result<(&str, Option<Expression>), Fault> {
    let word = |at: usize| {
        let blank = |c: Option<char>| c.is_none_or(char::is_whitespace);
        let behind = text.get(at + 2..).and_then(|rest| rest.chars().next());
        let open = behind == Some('(');
        blank(text.get(..at).and_then(|before| before.chars().next_back()))
            && (blank(behind) || open)
    };
    let found = text.match_indices("if").find(|(at, _)| word(*at));
    let Some((at, _)) = found else {
        return Ok((text, None));
    };
    let condition = text.get(at + 2..).unwrap_or("").parse()?;
    Ok((text.get(..at).unwrap_or("").trim_end(), Some(condition)))
}
