//! What the terminal says that it can.
//!
//! It is asked at most once, before anything else reads from it, and has a limited time. The last question is one that every
//! terminal answers, so that those that know nothing of pictures cost no waiting.

use std::time::Duration;

/// What the terminal answered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::tui) struct Answers {
    /// It knows kitty's graphics.
    pub kitty: bool,
    /// It knows sixels.
    pub sixel: bool,
    /// Width and height of a cell in pixels.
    pub cell: Option<[u16; 2]>,
    /// It has answered the last question.
    pub complete: bool,
}

/// May a picture of one pixel be sent (kitty)? How many pixels has a cell? Which terminal is this?
const QUESTIONS: &str = "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[16t\x1b[c";

/// No answer is longer, all together.
const MOST: usize = 4096;

/// Asks the terminal on standard input and output, which must be in raw mode, and waits at most so long.
#[cfg(unix)]
pub(in crate::tui) fn ask(patience: Duration) -> Answers {
    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    use std::io::Write;
    use std::time::Instant;

    let mut out = std::io::stdout().lock();
    let sent = out
        .write_all(QUESTIONS.as_bytes())
        .and_then(|()| out.flush());
    let mut heard = Vec::new();
    let end = Instant::now() + patience;
    while sent.is_ok() && heard.len() < MOST && !parse(&heard).complete {
        let left = end.saturating_duration_since(Instant::now());
        let Ok(left) = Timespec::try_from(left) else {
            break;
        };
        let stdin = rustix::stdio::stdin();
        let mut fds = [PollFd::new(&stdin, PollFlags::IN)];
        let mut bytes = [0; 256];
        match poll(&mut fds, Some(&left)) {
            Ok(0) => break,
            Ok(_) => match rustix::io::read(stdin, &mut bytes) {
                Ok(0) => break,
                Ok(count) => heard.extend_from_slice(&bytes[..count]),
                Err(rustix::io::Errno::INTR) => {}
                Err(_) => break,
            },
            Err(rustix::io::Errno::INTR) => {}
            Err(_) => break,
        }
    }
    parse(&heard)
}

/// Consoles of Windows are not asked.
#[cfg(not(unix))]
pub(in crate::tui) fn ask(_: Duration) -> Answers {
    let _ = (QUESTIONS, MOST, parse);
    Answers::default()
}

/// Reads what has come so far. Keys that were pressed in between are lost.
fn parse(heard: &[u8]) -> Answers {
    let text = String::from_utf8_lossy(heard);
    let mut answers = Answers::default();
    for part in text.split('\x1b') {
        if let Some(graphics) = part.strip_prefix("_Gi=31;") {
            answers.kitty |= graphics.starts_with("OK");
        } else if let Some(attributes) =
            (part.strip_prefix("[?")).and_then(|rest| Some(rest.split_once('c')?.0))
        {
            // Attribute 4 is sixel graphics.
            answers.sixel |= attributes.split(';').skip(1).any(|number| number == "4");
            answers.complete = true;
        } else if let Some(size) =
            (part.strip_prefix("[6;")).and_then(|rest| Some(rest.split_once('t')?.0))
        {
            let parsed = size.split_once(';');
            let parsed = parsed.and_then(|(h, w)| Some([w.parse().ok()?, h.parse().ok()?]));
            answers.cell = parsed.or(answers.cell);
        }
    }
    answers
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Answers as the documents of xterm ("Device Attributes", "Window manipulation") and of kitty's graphics have them.
    #[test]
    fn answers_are_understood() {
        let kitty = parse(b"\x1b_Gi=31;OK\x1b\\\x1b[6;20;9t\x1b[?62;c");
        let expected = Answers {
            kitty: true,
            sixel: false,
            cell: Some([9, 20]),
            complete: true,
        };
        assert_eq!(kitty, expected);
        assert!(parse(b"\x1b[?63;1;2;4;6c").sixel);
        // A VT100 with graphics says 1;2; the first number is the class of the terminal, 4 there is not sixel.
        assert!(!parse(b"\x1b[?4;2c").sixel);
        assert!(!parse(b"\x1b_Gi=31;ENOTSUPPORTED\x1b\\\x1b[?1;2c").kitty);
        let half = parse(b"\x1b[6;20;9t\x1b[?62;4");
        assert!(!half.complete && !half.sixel && half.cell == Some([9, 20]));
        assert_eq!(parse(b"jj\xff\x1b[6;999999;t\x1b[A"), Answers::default());
    }
}
