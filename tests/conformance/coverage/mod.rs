//! Whether the suite leaves anything out.
//!
//! What there is to test is read from the tables of the library: instructions, modifiers, masks, registers, formats, states, each
//! for every version that has it. A case counts for one of them only if it *notices* it: the case is spoiled in that one
//! point (a modifier taken away, a mask made wider, a comparison turned into another), and must fail then.
//!
//! `probe` spoils cases; each of the other files has one subject. Where no table but the specification says what there is
//! (`special`, `rules`), a table there says so, with the place.

mod instructions;
mod models;
mod modifiers;
mod probe;
mod registers;
mod rules;
mod special;
mod states;
mod textures;

use std::collections::BTreeSet;

/// What is still to be covered, by names that a person can read.
struct Checklist {
    subject: &'static str,
    open: BTreeSet<String>,
    all: usize,
}

impl Checklist {
    fn new(subject: &'static str, items: impl IntoIterator<Item = String>) -> Self {
        let open: BTreeSet<String> = items.into_iter().collect();
        let all = open.len();
        assert!(all > 0, "there is nothing to cover among {subject}");
        Self { subject, open, all }
    }

    /// Takes an item off the list if `covered` says so, which is asked only for items that are still on it.
    fn tick(&mut self, item: &str, covered: impl FnOnce() -> bool) {
        if self.open.contains(item) && covered() {
            self.open.remove(item);
        }
    }

    /// Fails with the list of what no case covers.
    fn finish(self) {
        let gaps: Vec<String> = self.open.into_iter().collect();
        assert!(
            gaps.is_empty(),
            "{} of {} {} are in no case that depends on them:\n{}",
            gaps.len(),
            self.all,
            self.subject,
            gaps.join("\n")
        );
        println!("{} {}", self.all, self.subject);
    }
}
