//! Constructs of the language, each with its words.

use super::*;
use crate::listing;

const CONSTRUCTS: &str = include_str!("constructs.txt");

/// Version, listing and the words between version and end.
fn constructs() -> impl Iterator<Item = (String, Vec<u32>)> {
    let lines = CONSTRUCTS.lines().filter(|line| !line.starts_with('#'));
    lines.map(|line| {
        let (version, rest) = line.split_once(" | ").unwrap();
        let (text, words) = rest.rsplit_once(" | ").unwrap();
        let text = text.replace("\\\\", "\u{1}").replace("\\n", "\n");
        let text = text.replace("\\t", "\t").replace('\u{1}', "\\");
        let words = words
            .split(' ')
            .map(|w| u32::from_str_radix(w, 16).unwrap());
        (format!("{version}\n{text}\n"), words.collect())
    })
}

fn words_of(text: &str) -> Vec<u32> {
    let mut sources = SourceMap::new();
    let file = sources.add("a", text).unwrap().span();
    let options = listing::Options {
        unchecked: true,
        ..Default::default()
    };
    let read = listing::read(&mut sources, file, &options);
    let program = read.accepted();
    let program = program.unwrap_or_else(|| panic!("{text}: {:?}", read.diagnostics));
    encode(program).unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

#[test]
fn listings_become_these_words() {
    let mut count = 0;
    for (text, expected) in constructs() {
        let words = words_of(&text);
        let inner = &words[1..words.len() - 1];
        assert_eq!(inner, expected, "{text}\n{inner:08X?}\n{expected:08X?}");
        count += 1;
    }
    assert!(count > 500, "{count}");
}

/// Back to a listing, and to the same words.
#[test]
fn these_words_become_listings() {
    for (text, expected) in constructs() {
        let words = words_of(&text);
        let decoded = decode(&words);
        let program = decoded.program.unwrap();
        let printed = crate::syntax::print(&program);
        assert_eq!(
            words_of(&printed)[1..=expected.len()],
            expected,
            "{text}{printed}"
        );
    }
}
