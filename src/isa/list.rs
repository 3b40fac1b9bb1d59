//! Lists for people.

/// Words as a list for people: `a`, `a and b`, `a, b and c`.
pub(crate) fn enumerate<S: AsRef<str>>(words: &[S], last: &str) -> String {
    match words {
        [] => String::new(),
        [one] => one.as_ref().to_string(),
        [most @ .., end] => {
            let most: Vec<&str> = most.iter().map(AsRef::as_ref).collect();
            format!("{} {last} {}", most.join(", "), end.as_ref())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::isa::VersionSet;

    #[test]
    fn lists_are_written_as_people_do() {
        assert_eq!(enumerate::<&str>(&[], "or"), "");
        assert_eq!(enumerate(&["a", "b", "c"], "or"), "a, b or c");
        for (versions, text) in [
            (VersionSet::PS_1_2_TO_1_3, "ps.1.2 and ps.1.3"),
            (VersionSet::PS, "ps.1.0 to ps.1.4"),
            (VersionSet::ALL, "vs.1.0, vs.1.1 and ps.1.0 to ps.1.4"),
            (VersionSet::PS_1_4, "ps.1.4"),
            (VersionSet::NONE, ""),
        ] {
            assert_eq!(versions.to_string(), text);
        }
    }
}
