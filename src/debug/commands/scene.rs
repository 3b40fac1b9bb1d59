//! What only a scene has: other pixels and vertices, the history of a pixel, registers over the whole frame.

use super::{Arguments, Console, Outcome};
use crate::debug::session::Session;
use crate::debug::text::Text;

#[cfg(feature = "scene")]
pub(super) use of_scenes::{history, pixel, show, touched, vertex};
#[cfg(not(feature = "scene"))]
pub(super) use without::{history, pixel, show, touched, vertex};

/// Why a listing has none of this.
const BY_HAND: &str = "a listing with values set by hand has no picture: debug a scene for that";

#[cfg(feature = "scene")]
mod of_scenes {
    use super::*;
    use crate::debug::commands::merge::stored_line;
    use crate::debug::commands::{Effect, Fault, Reply};
    use crate::debug::pixel::{PixelSubject, VertexSubject, Which};
    use crate::debug::subject::Subject;
    use crate::debug::text::{Line, Style};
    use crate::isa::ShaderKind;
    use crate::raster::Look;
    use crate::scene::{Output, PixelEvent, Rendering, ShowExpression};

    /// The scene of a session as it was rendered.
    fn rendering<'a>(session: &Session<'a>) -> Result<&'a Rendering<'a>, Fault> {
        match session.subject() {
            Subject::Listing(_) => Err(BY_HAND.into()),
            Subject::Pixel(subject) => Ok(subject.rendering()),
            Subject::Vertex(subject) => Ok(subject.rendering()),
        }
    }

    /// Goes on with another subject.
    fn replace<'a>(
        console: &mut Console,
        session: &mut Session<'a>,
        subject: Subject<'a>,
    ) -> Outcome {
        session.replace(subject);
        console.left.clear();
        Ok(console.greeting(session).into())
    }

    /// `pixel X,Y [DRAW]`
    pub(in crate::debug::commands) fn pixel(
        console: &mut Console,
        session: &mut Session<'_>,
        arguments: &Arguments<'_>,
    ) -> Outcome {
        let wrong = || Fault("write it as pixel 320,240, or pixel 320,240 DRAW".to_string());
        let (x, rest) = arguments.text.split_once(',').ok_or_else(wrong)?;
        let rest = rest.trim();
        let end = rest.find(char::is_whitespace).unwrap_or(rest.len());
        let (y, draw) = rest.split_at(end);
        let number = |text: &str| text.trim().parse::<u32>().map_err(|_| wrong());
        let pixel = [number(x)?, number(y)?];
        let which = Which {
            draw: Some(draw.trim().to_string()).filter(|draw| !draw.is_empty()),
            primitive: None,
        };
        let subject = PixelSubject::new(rendering(session)?, pixel, &which);
        let subject = subject.map_err(|why| why.to_string())?;
        replace(console, session, Subject::Pixel(subject))
    }

    /// `vertex N [DRAW]`
    pub(in crate::debug::commands) fn vertex(
        console: &mut Console,
        session: &mut Session<'_>,
        arguments: &Arguments<'_>,
    ) -> Outcome {
        let mut words = arguments.words();
        let number = words.next().and_then(|word| word.parse().ok());
        let number = number.ok_or("write it as vertex 17, or vertex 17 DRAW")?;
        let here = match session.subject() {
            Subject::Pixel(subject) => subject.draw().map(|draw| draw.name),
            Subject::Vertex(subject) => Some(subject.draw().name),
            Subject::Listing(_) => None,
        };
        let draw = words.next().or(here);
        let subject = VertexSubject::new(rendering(session)?, number, draw);
        let subject = subject.map_err(|why| why.to_string())?;
        replace(console, session, Subject::Vertex(subject))
    }

    /// `show r2@12 [FILE.png]`: registers over the whole frame.
    pub(in crate::debug::commands) fn show(
        _: &mut Console,
        session: &mut Session<'_>,
        arguments: &Arguments<'_>,
    ) -> Outcome {
        let rendering = rendering(session)?;
        let draw = match session.subject() {
            Subject::Pixel(subject) => subject.draw(),
            Subject::Vertex(subject) => Some(subject.draw()),
            Subject::Listing(_) => None,
        };
        let draw = draw.ok_or("there is no draw")?;
        let (mut names, mut tiles, mut path) = (Vec::new(), Vec::new(), None);
        for word in arguments.words() {
            if word.ends_with(".png") {
                path = Some(word.to_string());
                continue;
            }
            let text = match is_temporary(word) {
                true => format!("{word}{}", here(session)),
                false => word.to_string(),
            };
            let expression: ShowExpression = text.parse().map_err(|why| format!("{why}"))?;
            let shown = expression.tiles(rendering.scene(), draw, Look::default(), false);
            tiles.extend(shown.map_err(|why| why.to_string())?);
            names.push(text);
        }
        if tiles.is_empty() {
            return Err(
                "show which register? `show r2@12`, `show r2` here, `show all sheet.png`".into(),
            );
        }
        let path = path.unwrap_or_else(|| match names.as_slice() {
            [name] => format!("{name}.png"),
            _ => "sheet.png".to_string(),
        });
        let draw = draw.name.to_string();
        Ok(Reply {
            effect: Some(Effect::Picture { draw, tiles, path }),
            ..Reply::default()
        })
    }

    /// Whether a word names a register that holds something else on each line: no line stands with it, and it is no input or output.
    fn is_temporary(word: &str) -> bool {
        !word.contains('@') && word.starts_with(['r', 'R', 't', 'T'])
    }

    /// `@12` behind the instruction of the pixel shader that ran last; nothing elsewhere and at the end.
    fn here(session: &Session<'_>) -> String {
        let (Some(run), Some(last)) = (session.run(), session.last_moment()) else {
            return String::new();
        };
        match last.instruction {
            Some(number) if run.listing.kind() == ShaderKind::Pixel => {
                format!("@{}", run.listing.line(number))
            }
            _ => String::new(),
        }
    }

    /// `history [N]`: what touched the pixel, or another of these primitives.
    pub(in crate::debug::commands) fn history(
        console: &mut Console,
        session: &mut Session<'_>,
        arguments: &Arguments<'_>,
    ) -> Outcome {
        let subject = match session.subject() {
            Subject::Pixel(subject) => subject,
            Subject::Listing(_) => return Err(BY_HAND.into()),
            Subject::Vertex(_) => return Err("a vertex has no history: `pixel X,Y` has".into()),
        };
        if !arguments.text.is_empty() {
            let number = arguments.text.parse::<usize>().ok();
            let event = number.and_then(|number| number.checked_sub(1));
            let other = event.and_then(|event| subject.with_event(event));
            let most = subject.history().events.len();
            let wrong = || {
                format!(
                    "`{}` is none of 1 to {most}, the numbers of `history`",
                    arguments.text
                )
            };
            let other = other.ok_or_else(wrong)?;
            return replace(console, session, Subject::Pixel(other));
        }
        let history = subject.history();
        let mut text = Text::default();
        let clear = Line::from(format!("{:<40}", "      clear"));
        text.line(clear.joined(stored_line(&history.clear)));
        if history.left_out > 0 {
            text.line(Line::styled(
                format!("      ({} more before)", history.left_out),
                Style::Dim,
            ));
        }
        for (number, event) in history.events.iter().enumerate() {
            let mark = if number == subject.event() { "->" } else { "" };
            let head = format!(
                "{mark:<3}{:>2} {:<34}",
                number + 1,
                format!("{}, {}", name(subject, event), event.merge.fate().name())
            );
            text.line(Line::from(head).joined(stored_line(&event.merge.after)));
        }
        Ok(text.into())
    }

    /// `pane, primitive 12`
    fn name(subject: &PixelSubject<'_>, event: &PixelEvent) -> String {
        let pass = subject.rendering().pass(Output::Picture);
        let draw = pass.and_then(|pass| pass.draws.get(event.draw));
        let draw = draw.map_or("", |draw| draw.name);
        format!("{draw}, primitive {}", event.fragment.primitive)
    }

    /// For the greeting: which primitive of how many is debugged.
    pub(in crate::debug::commands) fn touched(session: &Session<'_>) -> Text {
        let mut text = Text::default();
        match session.subject() {
            Subject::Listing(_) => {}
            Subject::Pixel(subject) => {
                let events = &subject.history().events;
                let Some(event) = events.get(subject.event()) else {
                    return text;
                };
                let words = format!(
                    "   draw {}, {}",
                    name(subject, event),
                    event.merge.fate().name()
                );
                let more = match events.len() {
                    1 => String::new(),
                    count => format!("   ({count} primitives touch this pixel: `history`)"),
                };
                text.line(Line::from(words).and(more, Style::Dim));
            }
            Subject::Vertex(subject) => text.line(format!("   draw {}", subject.draw().name)),
        }
        text
    }
}

#[cfg(not(feature = "scene"))]
mod without {
    use super::*;

    pub(in crate::debug::commands) fn pixel(
        _: &mut Console,
        _: &mut Session<'_>,
        _: &Arguments<'_>,
    ) -> Outcome {
        Err(BY_HAND.into())
    }

    pub(in crate::debug::commands) use pixel as vertex;

    pub(in crate::debug::commands) use pixel as history;

    pub(in crate::debug::commands) use pixel as show;

    pub(in crate::debug::commands) fn touched(_: &Session<'_>) -> Text {
        Text::default()
    }
}
