//! Rules of the specification that no table of the library has, and what people hit with these shaders: each with the cases that hold
//! it.

use super::probe::PROBES;

/// A rule: its place, what it says, and the cases; `*` stands for any version.
const RULES: &[(&str, &str, &[&str])] = &[];

#[test]
fn every_rule_has_its_cases() {
    let mut gaps = String::new();
    for (place, rule, files) in RULES {
        for file in *files {
            let (before, after) = file.split_once('*').unwrap_or((file, ""));
            let found = PROBES.iter().any(|probe| {
                let stem = probe.path.rsplit_once('.').map_or("", |(stem, _)| stem);
                stem.starts_with(before)
                    && stem.ends_with(after)
                    && (file.contains('*') || stem == *file)
            });
            if !found {
                gaps.push_str(&format!("{place}: {rule}: no {file}\n"));
            }
        }
    }
    assert!(gaps.is_empty(), "{gaps}");
}
