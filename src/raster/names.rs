//! The states whose values have names: one table each, from which the type, its number in Direct3D, its name and the
//! reader of that name come.

use std::fmt;

/// A name that no value of a state has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownName {
    /// What the name should have been, such as `blend factor`.
    pub kind: &'static str,
    /// The name as given.
    pub name: String,
    /// Every name that would have been understood.
    pub known: &'static [&'static str],
}

impl fmt::Display for UnknownName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "`{}` is no {}; it is one of {}",
            self.name,
            self.kind,
            self.known.join(", ")
        )
    }
}

impl std::error::Error for UnknownName {}

/// Declares an enumeration from one table of variant, number in Direct3D 8 and lower-case name.
macro_rules! named {
    (
        $(#[$about:meta])*
        $type:ident, $kind:literal {
            $( $(#[$row_about:meta])* $variant:ident = $number:literal $name:literal, )+
        }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum $type {
            $( $(#[$row_about])* $variant = $number, )+
        }

        impl $type {
            /// Every value, in the order of the Direct3D numbers.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];
            /// The lower-case Direct3D names, in the order of [`Self::ALL`].
            pub const NAMES: &'static [&'static str] = &[$($name),+];

            /// The lower-case Direct3D name.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)+
                }
            }

            /// The number that Direct3D 8 gives this value.
            pub fn number(self) -> u32 {
                self as u32
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str(self.name())
            }
        }

        impl std::str::FromStr for $type {
            type Err = $crate::raster::names::UnknownName;

            /// Reads the lower-case Direct3D name.
            ///
            /// # Errors
            ///
            /// [`UnknownName`](crate::raster::UnknownName) if no value is called that.
            fn from_str(text: &str) -> Result<Self, Self::Err> {
                match text {
                    $($name => Ok(Self::$variant),)+
                    _ => Err($crate::raster::names::UnknownName {
                        kind: $kind,
                        name: text.to_owned(),
                        known: Self::NAMES,
                    }),
                }
            }
        }
    };
}

pub(super) use named;
