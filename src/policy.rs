//! Choices that a person makes about how a listing is judged and run, as plain values.

use std::fmt;
use std::str::FromStr;

/// By whose rules a listing is judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Dialect {
    /// What the Direct3D 8 runtime accepted, with a warning where its own documents forbade it.
    #[default]
    D3d8,
    /// What the assembler and the runtime of Direct3D 9 accepted of these versions.
    D3d9,
    /// Whatever has a meaning: a listing is refused only for what cannot be run.
    Lenient,
}

/// Every dialect with its name on the command line.
static DIALECTS: [(Dialect, &str); 3] = [
    (Dialect::D3d8, "d3d8"),
    (Dialect::D3d9, "d3d9"),
    (Dialect::Lenient, "lenient"),
];

impl Dialect {
    /// Every dialect, the default first.
    pub fn all() -> impl Iterator<Item = Dialect> {
        DIALECTS.iter().map(|(dialect, _)| *dialect)
    }

    /// The name on the command line: `d3d8`, `d3d9`, `lenient`.
    pub fn name(self) -> &'static str {
        DIALECTS[self as usize].1
    }
}

impl fmt::Display for Dialect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name that no dialect has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownDialect {
    /// The name as it was given.
    pub name: String,
}

impl fmt::Display for UnknownDialect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<&str> = Dialect::all().map(Dialect::name).collect();
        write!(
            f,
            "there is no dialect `{}`; it is one of {}",
            self.name,
            names.join(", ")
        )
    }
}

impl std::error::Error for UnknownDialect {}

impl FromStr for Dialect {
    type Err = UnknownDialect;

    /// The dialect of this name, in any case of letters.
    fn from_str(name: &str) -> Result<Self, UnknownDialect> {
        Self::all()
            .find(|d| d.name().eq_ignore_ascii_case(name))
            .ok_or_else(|| UnknownDialect { name: name.into() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dialects_are_read_by_the_name_they_print() {
        for name in ["d3d8", "d3d9", "lenient"] {
            assert_eq!(name.parse::<Dialect>().unwrap().to_string(), name);
        }
        assert_eq!("D3D9".parse(), Ok(Dialect::D3d9));
        assert_eq!(Dialect::default(), Dialect::D3d8);
        let unknown = "d3d7".parse::<Dialect>().unwrap_err().to_string();
        assert!(unknown.contains("d3d7") && unknown.contains("d3d8, d3d9, lenient"));
    }
}
