//! The table is whole, in order, and every example does what the table says of it.

use super::{Case, Entry, Example, Group, RETIRED, all, find};
use crate::bytecode::{self, Declaration, StreamKind};
use crate::diagnostic::{Diagnostic, Severity, SourceMap, Span};
use crate::listing;
use crate::policy::Dialect;

/// How many rules each group of the rule list has: the last number of each of its tables, counted by hand.
const NUMBERS: [(char, usize); 11] = [
    ('B', 11),
    ('S', 14),
    ('O', 26),
    ('M', 13),
    ('R', 11),
    ('T', 13),
    ('I', 7),
    ('C', 8),
    ('D', 5),
    ('P', 33),
    ('K', 20),
];

#[test]
fn every_rule_has_its_row_and_every_row_its_place() {
    let ids: Vec<&str> = all().map(|entry| entry.rule.id).collect();
    let retired = |id: &String| RETIRED.iter().any(|(old, _)| old == id);
    let wanted = NUMBERS.iter().flat_map(|(letter, last)| {
        let ids = (1..=*last).map(move |n| format!("{letter}{n}"));
        ids.filter(|id| !retired(id))
    });
    assert_eq!(ids, wanted.collect::<Vec<_>>());
    for (old, new) in RETIRED {
        assert_eq!(find(old).unwrap().rule.id, new);
    }
    assert_eq!(find("b3").unwrap().rule.id, "B3");
    assert!(find("B99").is_none());
    for (i, group) in Group::all().enumerate() {
        assert_eq!(group as usize, i);
        assert!(
            all().any(|entry| entry.group() == group && entry.rule.id.starts_with(group.letter()))
        );
    }
}

#[test]
fn rows_are_written_for_people() {
    for entry in all() {
        let id = entry.rule.id;
        assert!(entry.rule.rule.ends_with('.'), "{id}");
        assert!(entry.note.is_empty() || entry.note.ends_with('.'), "{id}");
        assert!(entry.cases.iter().all(|case| !case.when.is_empty()), "{id}");
        assert_eq!(entry.breaks.is_empty(), entry.keeps.is_empty(), "{id}");
        // A rule of the shader model without an example says why.
        let shown = !entry.breaks.is_empty() || !entry.note.is_empty();
        let model = !matches!(entry.group(), Group::Text | Group::Tokens);
        assert!(shown || !model, "{id}");
        // What only Direct3D 9 refuses says why.
        let severity = |dialect| {
            let cases = entry.cases.iter().map(move |case| case.severity(dialect));
            std::iter::once(entry.severity(dialect)).chain(cases)
        };
        let mut both = severity(Dialect::D3d8).zip(severity(Dialect::D3d9));
        let only_later = both.any(|(first, later)| first < later);
        assert!(!only_later || entry.note.contains("Direct3D 9"), "{id}");
        // What nobody says has no example.
        let said = Dialect::all().any(|dialect| entry.severity(dialect).is_some());
        assert!(said || entry.breaks.is_empty(), "{id}");
    }
}

#[test]
fn a_lenient_reader_refuses_nothing_that_a_strict_one_takes() {
    for entry in all() {
        let severities = Dialect::all().map(|dialect| entry.severity(dialect));
        let cases = entry
            .cases
            .iter()
            .map(|case| Dialect::all().map(|dialect| case.severity(dialect)));
        for one in
            std::iter::once(severities.collect::<Vec<_>>()).chain(cases.map(Iterator::collect))
        {
            let [first, later, lenient] = one[..] else {
                unreachable!()
            };
            assert!(lenient <= first && first <= later, "{}", entry.rule.id);
        }
    }
}

/// What is said of the example of a rule, which is a listing, a declaration or a stream of tokens.
fn judge(id: &str, text: &str, dialect: Dialect) -> (Vec<Diagnostic>, u32) {
    let mut sources = SourceMap::new();
    if let Some(input) = bytecode::read(&mut sources, "example", text.as_bytes()).unwrap() {
        let stream = &input.streams[0];
        let mut found = match stream.kind {
            StreamKind::Shader => bytecode::decode(&stream.words).diagnostics,
            StreamKind::Declaration => {
                let (declaration, mut found) = Declaration::decode(&stream.words);
                found.extend(match id {
                    "D5" => declaration.check_fixed_function(),
                    _ => declaration.check(),
                });
                found
            }
        };
        // Spans count tokens; nothing in the text is marked.
        found.iter_mut().for_each(|d| d.span = Span::default());
        return (found, 0);
    }
    let file = sources.add("example", text).unwrap().span();
    let options = listing::Options {
        dialect,
        ..Default::default()
    };
    (
        listing::read(&mut sources, file, &options).diagnostics,
        file.start,
    )
}

/// Holds an example to what is to be said of it: severity by dialect, at its marks.
fn hold(
    id: &str,
    written: &str,
    severity: impl Fn(Dialect) -> Option<Severity>,
    wrong: &mut Vec<String>,
) {
    let example = Example::new(written);
    for dialect in Dialect::all() {
        let (found, base) = judge(id, &example.text, dialect);
        // The inputs of these shaders are declared beside them, as they were for Direct3D 8, what they load they need
        // not use, and some show what only vs.1.0 and ps.1.0 have.
        let aside = ["S11", "S13", "P23"]
            .into_iter()
            .filter(|other| *other != id);
        let aside: Vec<&str> = aside.collect();
        let found = found.iter().filter(|d| !aside.contains(&d.rule.id));
        let got: Vec<_> = found
            .clone()
            .map(|d| (d.rule.id, d.severity, d.span))
            .collect();
        let mut want = Vec::new();
        for mark in &example.marks {
            let span = Span::new(base + mark.start, base + mark.end);
            want.extend(severity(dialect).map(|severity| (id, severity, span)));
        }
        let tokens = example.marks.is_empty() && !got.is_empty();
        if tokens {
            want.extend(severity(dialect).map(|severity| (id, severity, Span::default())));
        }
        if got != want {
            let said: Vec<_> = found
                .map(|d| (d.rule.id, d.severity, d.span, &d.message))
                .collect();
            wrong.push(format!(
                "{id} in {dialect}: {written}\n    {said:?}\n    instead of {want:?}"
            ));
        }
    }
}

#[test]
fn examples_break_their_rule_alone_or_nothing() {
    let mut wrong = Vec::new();
    for Entry {
        rule,
        breaks,
        keeps,
        cases,
        ..
    } in all()
    {
        let entry = find(rule.id).unwrap();
        if !breaks.is_empty() {
            hold(
                rule.id,
                breaks,
                |dialect| entry.severity(dialect),
                &mut wrong,
            );
            hold(rule.id, keeps, |_| None, &mut wrong);
            let tokens = Example::new(breaks).marks.is_empty();
            assert!(
                !tokens
                    || !judge(rule.id, &Example::new(breaks).text, Dialect::D3d8)
                        .0
                        .is_empty(),
                "{}",
                rule.id
            );
            assert!(Example::new(keeps).marks.is_empty(), "{}", rule.id);
        }
        for Case { breaks, .. } in cases.iter().filter(|case| !case.breaks.is_empty()) {
            let case = cases.iter().find(|case| case.breaks == *breaks).unwrap();
            hold(
                rule.id,
                breaks,
                |dialect| case.severity(dialect),
                &mut wrong,
            );
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
