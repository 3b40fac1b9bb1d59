//! The opcodes of every version, and what has no token.

use super::*;
use crate::isa::tests::{opcodes, versions};
use crate::isa::{RegisterFile, ResultModifier, ShaderKind, SourceModifier, WriteMask};
use crate::program::{Comment, Register, Statement};

/// The specification's list of instructions, line by line: each, in each of its versions, has its number, and behind it
/// a token for each operand. Operands are c1, c2 … here, which every version has: file 2, all components.
#[test]
fn every_instruction_of_every_version() {
    let mut seen = 0;
    for row in opcodes::rows() {
        let [name, number, group, _, counts, ..] = row[..] else {
            panic!("{row:?}");
        };
        let number = u32::from_str_radix(number, 16).unwrap();
        let (destinations, sources) = counts.split_once('+').unwrap();
        let (destinations, sources): (u32, u32) =
            (destinations.parse().unwrap(), sources.parse().unwrap());
        for version in versions(group) {
            // The two that are declarations have operands of their own.
            let (line, operands) = match name {
                "def" => (
                    "def c1, 1, 2, 0.5, -1".to_string(),
                    words("A00F0001 3F800000 40000000 3F000000 BF800000"),
                ),
                "dcl" => ("dcl_normal v3".to_string(), words("80000003 900F0003")),
                _ => {
                    let count = destinations + sources;
                    let names: Vec<_> = (1..=count).map(|i| format!("c{i}")).collect();
                    let mask = |i| {
                        if i <= destinations {
                            0xA00F_0000
                        } else {
                            0xA0E4_0000
                        }
                    };
                    let tokens = (1..=count).map(|i| mask(i) | i).collect();
                    (format!("{name} {}", names.join(", ")), tokens)
                }
            };
            let mut tokens = vec![version.token(), number];
            tokens.extend(operands);
            tokens.push(END);
            let listing = format!("{version}\n{}\n", line.trim_end());
            let mut printed = listing.clone();
            if name == "sub" && version.kind() == ShaderKind::Vertex {
                // Written as an addition of what is negated: source modifier 1.
                tokens[1..].copy_from_slice(&[2, 0xA00F_0001, 0xA0E4_0002, 0xA1E4_0003, END]);
                printed = format!("{version}\nadd c1, c2, -c3\n");
            }
            assert_eq!(assembled(&listing), tokens, "{listing}");
            assert_eq!(listed(&tokens), printed);
            seen += 1;
        }
    }
    // Counted by hand in the list: 27 instructions of both vertex shader versions, 10 of all five of pixel shaders, `def` of
    // all seven; 10 texture instructions and two more of 1.0 to 1.3, 4 of 1.2 and 1.3; `dp4` and `cmp`
    // of three versions, and of one texm3x2depth, texcrd, texld, texdepth, bem and phase.
    let rest = 3 + 3 + 1 + 1 + 1 + 1 + 1 + 1;
    assert_eq!(seen, 27 * 2 + 10 * 5 + 7 + 12 * 4 + 4 * 2 + rest);
}

/// The message of what has no token, with the rule.
#[track_caller]
fn refused(program: &Program) -> String {
    let found = encode(program).unwrap_err();
    assert!(found.iter().all(|d| d.rule.id == "K18"), "{found:?}");
    let messages: Vec<_> = found.into_iter().map(|d| d.message).collect();
    messages.join("; ")
}

#[test]
fn what_has_no_token_is_refused() {
    for (listing, message) in [
        ("ps.1.4\ntex t0", "`tex` has no token in ps.1.4"),
        ("ps.1.1\ntexld r0, t0", "`texld` has no token in ps.1.1"),
        ("ps.1.1\ntexcrd r0, t0", "`texcrd` has no token in ps.1.1"),
        (
            "vs.1.1\ntexcoord t0",
            "`texcoord` has no token in vs.1.1; `t0` has no token: a vertex shader has no such register",
        ),
        (
            "vs.1.1\nmov r0, t0",
            "`t0` has no token: a vertex shader has no such register",
        ),
        (
            "ps.1.1\nmov r0, oT0",
            "`oT0` has no token: a pixel shader has no such register",
        ),
        (
            "ps.1.1\nmov r0, r2048",
            "`r2048` has no token: the number of a register has 11 bits",
        ),
        ("ps.1.1\nmov r0, c[a0.x + 1]", "`c[a0.x + 1]` has no token"),
        (
            "vs.1.1\nmov c[a0.x + 1], r0",
            "a destination that is relative to `a0.x` has no token",
        ),
    ] {
        assert_eq!(refused(&program(listing)), message, "{listing}");
    }
    // `tex` has the number of `texld` there, which is said.
    let help = encode(&program("ps.1.4\ntex t0")).unwrap_err()[0]
        .help
        .clone();
    assert_eq!(help.unwrap(), "its number, 0x42, is that of `texld` there");
}

/// Programs that no text gives, but a library can make.
#[test]
fn what_no_listing_says_is_refused() {
    let changed = |listing: &str, change: &dyn Fn(&mut crate::program::Instruction)| {
        let mut program = program(listing);
        let Some(Statement::Instruction(i)) = program.statements.first_mut() else {
            panic!("no instruction");
        };
        change(i);
        refused(&program)
    };
    let saturated = ResultModifier {
        shift: 0,
        saturate: true,
    };
    let message = changed("vs.1.1\nmov r0, v0", &|i| i.result = saturated);
    assert_eq!(message, "`_sat` has no token here, in a vertex shader");
    let message = changed("ps.1.1\nnop", &|i| i.result = saturated);
    assert_eq!(message, "`_sat` has no token here, in a pixel shader");
    let message = changed("vs.1.1\nmov r0, v0", &|i| {
        i.sources[0].modifier = SourceModifier::Bx2;
    });
    assert_eq!(message, "`v0_bx2` has no token in a vertex shader");
    let message = changed("ps.1.1\nmov r0, v0", &|i| {
        i.sources.clear();
    });
    assert_eq!(message, "`mov` with these operands has no token");
    let message = changed("ps.1.1\nmov r0, v0", &|i| {
        i.destination.as_mut().unwrap().mask = WriteMask::NONE;
    });
    assert_eq!(message, "a destination without components has no token");
    let message = changed("vs.1.1\nmov r0, v0", &|i| {
        i.sources[0].register = Register::new(RegisterFile::RastOut, 3);
    });
    assert_eq!(
        message,
        "`o3` has no token: the number of a register has 11 bits"
    );
    let mut long = program("ps.1.1\nnop");
    long.comments.push(Comment {
        before: 1,
        words: vec![0; Comment::MOST_WORDS + 1],
        span: crate::diagnostic::Span::default(),
    });
    let message = "a comment of 32768 tokens has no token: at most 32767 fit";
    assert_eq!(refused(&long), message);
    long.comments[0].words.pop();
    assert_eq!(encode(&long).unwrap().len(), 1 + 1 + 1 + 32767 + 1);
}

#[test]
fn shaders_longer_than_a_stream_are_refused() {
    let mut long = program("ps.1.1\nnop");
    let nop = long.statements[0].clone();
    long.statements = vec![nop; MOST_ITEMS];
    assert_eq!(encode(&long).unwrap().len(), MOST_ITEMS + 2);
    long.statements.push(long.statements[0].clone());
    let found = encode(&long).unwrap_err();
    assert_eq!((found.len(), found[0].rule.id), (1, "K13"));
}
