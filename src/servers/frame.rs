//! Messages in a stream: a header with `Content-Length`, an empty line, so many bytes.

use std::fmt;
use std::io::{self, BufRead, Read, Write};

/// The longest message that is read, in bytes (16 MiB). Editors send none that is near it.
const LONGEST: u64 = 16 << 20;

/// The longest line of a header, in bytes.
const LONGEST_LINE: u64 = 4096;

/// The most lines of a header.
const MOST_LINES: usize = 32;

/// Why no message could be read.
#[derive(Debug)]
pub(super) enum Broken {
    /// This message is lost; the next one can be read.
    Message(String),
    /// Where the next message begins is not known any more.
    Stream(String),
}

impl fmt::Display for Broken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Message(why) | Self::Stream(why) => f.write_str(why),
        }
    }
}

impl From<io::Error> for Broken {
    fn from(error: io::Error) -> Self {
        Self::Stream(error.to_string())
    }
}

/// Reads the next message; `None` at the end of the stream.
///
/// # Errors
/// [`Broken`].
pub(super) fn read(input: &mut impl BufRead) -> Result<Option<Vec<u8>>, Broken> {
    let Some(length) = header(input)? else {
        return Ok(None);
    };
    if length > LONGEST {
        let skipped = io::copy(&mut input.take(length), &mut io::sink())?;
        let why = format!("a message of {length} bytes is too long");
        return Err(match skipped == length {
            true => Broken::Message(why),
            false => Broken::Stream(why),
        });
    }
    // Memory is taken as bytes come, not as the header promises them.
    let mut message = Vec::new();
    let got = input.take(length).read_to_end(&mut message)?;
    if got as u64 != length {
        let why = format!("the stream ends within a message: {got} bytes of {length}");
        return Err(Broken::Stream(why));
    }
    Ok(Some(message))
}

/// Reads a header; the length of what follows, or `None` at the end of the stream.
fn header(input: &mut impl BufRead) -> Result<Option<u64>, Broken> {
    let mut length = None;
    for number in 0..MOST_LINES {
        let mut line = Vec::new();
        input.take(LONGEST_LINE).read_until(b'\n', &mut line)?;
        let Some(text) = line.strip_suffix(b"\n") else {
            if line.is_empty() && number == 0 {
                return Ok(None);
            }
            let why = "the stream ends within a header, or its line is too long";
            return Err(Broken::Stream(why.to_string()));
        };
        let text = String::from_utf8_lossy(text.strip_suffix(b"\r").unwrap_or(text));
        if text.is_empty() {
            let missing = || Broken::Stream("a header has no Content-Length".to_string());
            return length.map(Some).ok_or_else(missing);
        }
        let wrong = || Broken::Stream(format!("`{}` is no line of a header", text.escape_debug()));
        let (name, value) = text.split_once(':').ok_or_else(wrong)?;
        if name.trim().eq_ignore_ascii_case("Content-Length") {
            length = Some(value.trim().parse().map_err(|_| wrong())?);
        }
    }
    Err(Broken::Stream("a header does not end".to_string()))
}

/// Writes a message and sends it off.
///
/// # Errors
/// What the stream says.
pub(super) fn write(output: &mut impl Write, message: &[u8]) -> io::Result<()> {
    write!(output, "Content-Length: {}\r\n\r\n", message.len())?;
    output.write_all(message)?;
    output.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(mut stream: &[u8]) -> (Vec<String>, Option<Broken>) {
        let mut messages = Vec::new();
        loop {
            match read(&mut stream) {
                Ok(Some(message)) => messages.push(String::from_utf8(message).unwrap()),
                Ok(None) => return (messages, None),
                Err(Broken::Message(why)) => messages.push(format!("lost: {why}")),
                Err(broken) => return (messages, Some(broken)),
            }
        }
    }

    #[test]
    fn messages_come_back_as_they_were_written() {
        let mut stream = Vec::new();
        for message in ["{}", "", "ä\n\r\n"] {
            write(&mut stream, message.as_bytes()).unwrap();
        }
        assert!(stream.starts_with(b"Content-Length: 2\r\n\r\n{}Content-Length: 0\r\n\r\n"));
        let (messages, broken) = all(&stream);
        assert_eq!(messages, ["{}", "", "ä\n\r\n"]);
        assert!(broken.is_none());
    }

    #[test]
    fn headers_may_have_other_lines_and_any_case() {
        let stream = b"Content-Type: application/json\r\ncontent-length:  2 \r\n\r\n[]Content-Length: 1\n\n7";
        assert_eq!(all(stream).0, ["[]", "7"]);
    }

    #[test]
    fn a_broken_stream_ends_and_takes_no_memory() {
        for stream in [
            b"\r\n".as_slice(),
            b"{}",
            b"hello\r\n\r\n",
            b"Content-Type: x\r\n\r\n",
            b"Content-Length: -1\r\n\r\n",
            b"Content-Length: 1e3\r\n\r\n",
            b"Content-Length: 99999999999999999999999\r\n\r\n",
            b"Content-Length: 2\r\n",
            b"Content-Length: 5\r\n\r\n{}",
            b"Content-Length: 18446744073709551615\r\n\r\n{}",
            b"\xff\xfe: \r\n\r\n",
        ] {
            let (messages, broken) = all(stream);
            assert!(messages.is_empty(), "{messages:?}");
            assert!(broken.is_some(), "{stream:?}");
        }
        let endless = b"a: b\r\n".repeat(100);
        assert!(matches!(all(&endless).1, Some(Broken::Stream(_))));
        let long = vec![b'x'; 1 << 16];
        assert!(matches!(all(&long).1, Some(Broken::Stream(_))));
    }

    #[test]
    fn what_follows_a_message_that_is_too_long_is_read() {
        let mut stream = format!("Content-Length: {}\r\n\r\n", LONGEST + 1).into_bytes();
        stream.extend(vec![b' '; LONGEST as usize + 1]);
        write(&mut stream, b"{}").unwrap();
        let (messages, broken) = all(&stream);
        assert_eq!(messages.len(), 2);
        assert!(messages[0].starts_with("lost: a message of 16777217 bytes"));
        assert_eq!((messages[1].as_str(), broken.is_none()), ("{}", true));
    }
}
