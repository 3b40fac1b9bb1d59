//! Choices of which every value has a name.

use std::fmt;

/// A name that no value of a choice has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownName {
    /// What it should have been the name of.
    pub what: &'static str,
    /// The name as it was given.
    pub name: String,
    /// The names that there are.
    pub known: Vec<&'static str>,
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, known) = (self.what, self.known.join(", "));
        // Names come from files and command lines: a whole megabyte of one helps nobody in a message.
        let name: String = self.name.chars().take(60).collect();
        write!(f, "there is no {what} `{name}`; it is one of {known}")
    }
}

impl std::error::Error for UnknownName {}

/// Declares a choice: an enum of which every value has a name and a sentence about it, the default first.
macro_rules! named {
    (
        $(#[$doc:meta])* $type:ident $what:literal;
        $first:ident $first_name:literal $first_about:literal,
        $($variant:ident $name:literal $about:literal,)*
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum $type {
            #[doc = $first_about]
            #[default]
            $first,
            $(#[doc = $about] $variant,)*
        }

        impl $type {
            /// What the choice is called in messages.
            pub const WHAT: &'static str = $what;

            /// Every value, the default first.
            pub fn all() -> impl Iterator<Item = Self> {
                [Self::$first, $(Self::$variant),*].into_iter()
            }

            /// The name on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    Self::$first => $first_name,
                    $(Self::$variant => $name,)*
                }
            }

            /// What the value means, in a sentence.
            pub const fn about(self) -> &'static str {
                match self {
                    Self::$first => $first_about,
                    $(Self::$variant => $about,)*
                }
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.name())
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::policy::UnknownName;

            /// The value of this name, in any case of letters.
            fn from_str(name: &str) -> Result<Self, Self::Err> {
                let unknown = || $crate::policy::UnknownName {
                    what: $what,
                    name: name.into(),
                    known: Self::all().map(Self::name).collect(),
                };
                Self::all()
                    .find(|value| value.name().eq_ignore_ascii_case(name))
                    .ok_or_else(unknown)
            }
        }
    };
}
pub(super) use named;
