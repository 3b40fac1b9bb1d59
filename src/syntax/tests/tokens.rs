//! What only tokens hold: comments that belong to them, and numbers that have no digits.

use super::*;
use crate::program::Comment;
use crate::syntax::print;

/// The comments of a listing: the number of the statement behind each, and its words.
fn comments(text: &str) -> Vec<(usize, Vec<u32>)> {
    let comments = accepted(text).comments;
    let one = |c: Comment| (c.before, c.words);
    comments.into_iter().map(one).collect()
}

#[test]
fn comments_know_where_they_stand() {
    let text = ";@comment 00000001
        ps.1.1 ;@comment 00000002
        tex t0 ;@comment 00000003
        mov r0, ;@comment 00000004
        t0
        ;@comment
        +mov r0.a, v0
        ;@comment 00000005";
    // The one within an instruction goes behind it.
    let expected = [
        (0, vec![1]),
        (0, vec![2]),
        (1, vec![3]),
        (2, vec![4]),
        (2, vec![]),
        (3, vec![5]),
    ];
    assert_eq!(comments(text), expected);
}

#[test]
fn strings_are_bytes_filled_up_with_zeros() {
    // A is 41, B 42 …, the first in the lowest bits; a backslash is 5C, a quote 22, a line end 0A, a tab 09.
    let text = r#"ps.1.1 ;@comment "A" "ABCD" "ABCDE" "" "\\\"\n\t" 0000ABCD abcdef01"#;
    let expected = vec![
        0x0000_0041,
        0x4443_4241,
        0x4443_4241,
        0x0000_0045,
        0x090A_225C,
        0x0000_ABCD,
        0xABCD_EF01,
    ];
    assert_eq!(comments(text), [(0, expected)]);
}

#[test]
fn long_comments_take_several_lines() {
    let words = (0..20).collect::<Vec<u32>>();
    let mut program = accepted("ps.1.1\nmov r0, v0");
    let text = b"The quick brown fox jumps over the lazy dog, and over another lazy dog.!";
    let (chunks, _) = text.as_chunks::<4>();
    let letters: Vec<u32> = chunks.iter().map(|c| u32::from_le_bytes(*c)).collect();
    for words in [words, letters] {
        program.comments.push(Comment {
            before: 0,
            words,
            span: Default::default(),
        });
    }
    let printed = print(&program);
    let expected = "ps.1.1
;@comment 00000000 00000001 00000002 00000003 00000004 00000005 00000006 00000007
;@        00000008 00000009 0000000A 0000000B 0000000C 0000000D 0000000E 0000000F
;@        00000010 00000011 00000012 00000013
;@comment \"The quick brown fox jumps over the lazy dog, and over another la\"
;@        \"zy dog.!\"
mov r0, v0
";
    assert_eq!(printed, expected);
    let again = accepted(&printed);
    let words = |p: &Program| {
        p.comments
            .iter()
            .map(|c| c.words.clone())
            .collect::<Vec<_>>()
    };
    assert_eq!(words(&again), words(&program));
    // A line between ends a comment; what follows is one of a person.
    let text = "ps.1.1\n;@comment 00000001\n; so\n;@ 00000002\nmov r0, v0";
    assert_eq!(comments(text), [(0, vec![1])]);
}

#[test]
fn comments_that_are_no_tokens() {
    for (text, marked) in [
        (";@comment 123", "123"),
        (";@comment 0000000G", "0000000G"),
        (";@comment 00000001 xyz", "xyz"),
        (";@comment \"no end", "\""),
        (";@comment \"a\\qb\"", "\\"),
        (";@comment 00000001\n;@ 2\n", "2"),
    ] {
        assert_eq!(
            found(format!("ps.1.1\n{text}\nmov r0, v0")),
            [("P24", marked.to_string())],
            "{text}"
        );
    }
    let long = format!("ps.1.1\n;@comment {}", "00000000 ".repeat(0x8000));
    assert_eq!(found(long).len(), 1);
}

#[test]
fn numbers_by_their_bits() {
    let program = accepted("ps.1.1\ndef c0, 0x7F800000, 0XFF800000, 0x7fc00001, 1");
    let value = program
        .definitions()
        .next()
        .unwrap()
        .value
        .map(f32::to_bits);
    assert_eq!(value, [0x7F80_0000, 0xFF80_0000, 0x7FC0_0001, 0x3F80_0000]);
    assert_eq!(
        print(&program),
        "ps.1.1\ndef c0, 0x7F800000, 0xFF800000, 0x7FC00001, 1\n"
    );
    // Whatever has digits is written in them, and a sign is among the bits.
    assert_eq!(
        told("ps.1.1\ndef c0, 0x3F800000, -0x7F800000, 0, 0x10"),
        "2:9 P17 only infinities and NaNs are written by their bits (as a number this is 1.0)\n\
         2:22 P17 a sign stands before the bits of a number, which have their own (write 0xFF800000)\n\
         2:37 P17 `0x10` is no number (write it in digits with a point, such as 0.5 or -2)\n"
    );
}
