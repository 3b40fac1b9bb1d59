//! The language itself: names, help, repetition, completion, whatever is typed.

use super::*;
use crate::debug::expression::function_names;
use crate::debug::stops::Occurrence;
use crate::debug::text::Style;
use proptest::prelude::*;
use std::collections::BTreeSet;
use table::COMMANDS;

/// A line for every command, in an order in which each can be done; those that need a picture are refused here and done in `scenes`.
const EXAMPLES: [&str; 47] = [
    "help",
    "echo text",
    "step",
    "reverse-step",
    "next",
    "reverse-next",
    "finish",
    "reverse-finish",
    "until 4",
    "reverse-until 3",
    "advance 4",
    "start",
    "goto 4",
    "frame",
    "break 5",
    "tbreak 5",
    "dprintf 4,\"x\"",
    "watch r0.r",
    "catch nan",
    "uncatch nan",
    "disable 1",
    "enable 1",
    "condition 1 r0.r > 2",
    "ignore 1 3",
    "hits 1 % 2",
    "delete",
    "continue",
    "reverse-continue",
    "print r0",
    "display r0",
    "undisplay",
    "info all",
    "list",
    "where",
    "why r0",
    "set v0.r = 1",
    "diff",
    "unset",
    "export json",
    "up 1",
    "down 1",
    "quad",
    "show r0@4",
    "history",
    "pixel 1,1",
    "vertex 1",
    "quit",
];

#[test]
fn every_command_is_done() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    let mut done = BTreeSet::new();
    for line in EXAMPLES {
        let word = line.split(' ').next().unwrap();
        done.insert(table::find(word).unwrap().name);
        let reply = talk.console.execute(&mut talk.session, line);
        let of_pictures =
            ["up", "down", "quad", "show", "history", "pixel", "vertex"].contains(&word);
        assert_eq!(reply.failed, of_pictures, "{line}: {}", reply.text);
        assert_eq!(reply.quit, word == "quit");
    }
    let all: BTreeSet<&str> = COMMANDS.iter().map(|command| command.name).collect();
    assert_eq!(done, all);
}

#[test]
fn every_name_is_one_commands_and_has_help() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    let mut names = BTreeSet::new();
    for command in &COMMANDS {
        for name in std::iter::once(&command.name).chain(command.aliases) {
            assert!(names.insert(*name), "{name} stands twice");
            assert_eq!(table::find(name).unwrap().name, command.name);
            assert!(talk.say(&format!("help {name}")).starts_with(command.name));
        }
        assert!(
            talk.say("help").contains(&format!("\n  {} ", command.name)),
            "{}",
            command.name
        );
    }
    assert_eq!(command_help().count(), COMMANDS.len());
    assert!(command_help().all(|help| !help.summary.is_empty()));
    // What help says of other lists is all of them.
    let help = talk.say("help print");
    assert!(function_names().all(|name| help.contains(name)), "{help}");
    for command in ["until", "reverse-until", "catch", "uncatch"] {
        let help = talk.say(&format!("help {command}"));
        assert!(
            Occurrence::all().all(|what| help.contains(what.name())),
            "{help}"
        );
    }
    let help = talk.say("help info");
    let told = info::TOPICS
        .iter()
        .filter(|topic| topic.name != "watchpoints");
    assert!(
        told.into_iter().all(|topic| help.contains(topic.name)),
        "{help}"
    );
    talk.fails("help glub", "no command");
}

#[test]
fn beginnings_do_as_long_as_they_are_clear() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    assert!(talk.say("ste").contains("3 mul"));
    assert!(talk.say("reverse-st").contains("3 mul"));
    talk.fails(
        "reverse",
        "`reverse` can be reverse-step, reverse-next, reverse-continue",
    );
    talk.fails("un", "`un` can be until, uncatch, undisplay, unset");
    talk.fails("setp", "did you mean `step`?");
    talk.fails("brake 4", "did you mean `break`?");
    talk.fails("conitnue", "did you mean `continue`?");
    talk.fails("glub", "`glub` is no command; `help` lists them");
    talk.fails("/x", "is no command");
    talk.fails("finish now", "takes nothing");
    talk.fails(&"x".repeat(5000), "too long");
}

#[test]
fn an_empty_line_repeats_what_moves_or_looks() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    talk.is("", "");
    talk.say("step");
    talk.is("# a remark, which is not repeated", "");
    assert!(talk.say("  ").contains("4 add_sat"));
    talk.say("break 4");
    // A second breakpoint would be no help.
    talk.is("", "");
    talk.say("p r0.r");
    talk.is("", "r0.r = 1\n");
}

#[test]
fn lines_are_completed() {
    let owned = Owned::new(PAIR);
    let session = owned.session(&PAIR_VALUES);
    let console = Console::new();
    let complete = |line: &str| console.complete(&session, line);
    assert_eq!(complete("reverse-s"), ["reverse-step"]);
    assert_eq!(complete("de"), ["delete"]);
    assert_eq!(complete("info c"), ["constants"]);
    assert_eq!(complete("until n"), ["nan"]);
    assert_eq!(complete("export m"), ["markdown"]);
    assert_eq!(complete("help unse"), ["unset"]);
    assert_eq!(complete("p/x c"), ["c0", "c1", "cmp", "cnd"]);
    assert_eq!(complete("print 1-v"), ["v0"]);
    assert_eq!(complete("why r0, r"), ["r0", "rcp", "rsq"]);
    assert_eq!(complete("finish "), [""; 0]);
    assert_eq!(complete("glub x"), [""; 0]);
    assert_eq!(complete("").len(), COMMANDS.len());
    assert_eq!(Console::word_start("print 1-v"), 8);
    assert_eq!(Console::word_start("  reverse-s"), 2);
    assert_eq!(Console::word_start("p é"), 2);
}

#[test]
fn answers_have_styles() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    let text = talk.console.execute(&mut talk.session, "step 2").text;
    let styles: Vec<Style> = text
        .lines
        .iter()
        .flat_map(|line| &line.pieces)
        .map(|piece| piece.style)
        .collect();
    for style in [Style::Changed, Style::Marked, Style::Remarkable, Style::Dim] {
        assert!(styles.contains(&style), "{style:?}");
    }
    // 0.5, 0.25 and 0.5 of 255: 127.5 to even, 63.75.
    assert!(styles.contains(&Style::Swatch([128, 64, 128])));
}

/// Words of the language, sensible and not.
fn word() -> impl Strategy<Value = String> {
    let names = COMMANDS
        .iter()
        .flat_map(|command| std::iter::once(command.name).chain(command.aliases.iter().copied()));
    let mut words: Vec<String> = names.map(str::to_string).collect();
    let arguments = [
        "r0",
        "r0.rg",
        "c1",
        "c[a0.x + 1]",
        "v0",
        "t0",
        "oPos.x",
        "depth",
        "1",
        "2",
        "99",
        "-1",
        "4294967296",
        "@1",
        "@9",
        "vs:2",
        "ps:4",
        "test:3",
        "if",
        "r0.r > 0.5",
        "=",
        "1, 0, 0",
        ",\"{r0}\"",
        ",",
        "/x",
        "/",
        "nan",
        "sample",
        "json",
        "csv file",
        "all",
        "registers",
        "%",
        "== 2",
        "a.png",
        "r0@3",
        "é",
        "{",
        "\"",
        "(",
        "0,0",
        "",
    ];
    words.extend(arguments.map(str::to_string));
    prop::sample::select(words)
}

proptest! {
    /// Whatever is typed is done or refused.
    #[test]
    fn no_line_panics(
        lines in prop::collection::vec(prop::collection::vec(word(), 0..5), 0..12),
        text in ".{0,30}",
        pixel: bool,
    ) {
        let (listing, values) = if pixel { (PAIR, PAIR_VALUES) } else { (TROUBLE, TROUBLE_VALUES) };
        let owned = Owned::new(listing);
        let mut session = owned.session(&values);
        let mut console = Console::new();
        for words in &lines {
            let line = words.join(" ");
            let _ = console.execute(&mut session, &line);
            let _ = console.execute(&mut session, &words.concat());
            let _ = console.complete(&session, &line);
        }
        let _ = console.execute(&mut session, &text);
        let _ = console.complete(&session, &text);
        // Wherever one is now, one can go on from there.
        prop_assert!(!console.execute(&mut session, "where").failed);
    }
}
