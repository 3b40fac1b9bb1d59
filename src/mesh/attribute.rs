//! What a mesh stores of each vertex.

use std::fmt;
use std::str::FromStr;

/// What a vertex stream can be fed from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Attribute {
    /// Position in object space, 3 components.
    Position,
    /// Unit normal, pointing to the front, 3 components.
    Normal,
    /// Unit direction in which u grows, 3 components.
    Tangent,
    /// Unit direction in which v grows, 3 components.
    Bitangent,
    /// Texture coordinate, (0,0) at the top left, 4 components: (u, v, 0, 1) unless the mesh has more than two.
    Texcoord,
    /// Colour, red, green, blue and alpha, 4 components.
    Color,
    /// The second colour, 4 components; transparent black unless given.
    Specular,
    /// Coordinate set 1, 4 components. This and the following: [`Self::Texcoord`] in a mesh that does not have it.
    Texcoord1,
    /// Coordinate set 2, 4 components.
    Texcoord2,
    /// Coordinate set 3, 4 components.
    Texcoord3,
    /// Coordinate set 4, 4 components.
    Texcoord4,
    /// Coordinate set 5, 4 components.
    Texcoord5,
    /// Coordinate set 6, 4 components.
    Texcoord6,
    /// Coordinate set 7, 4 components.
    Texcoord7,
}

impl Attribute {
    /// Every attribute with the name that scene files use.
    pub const ALL: [(Self, &'static str); 14] = [
        (Self::Position, "position"),
        (Self::Normal, "normal"),
        (Self::Tangent, "tangent"),
        (Self::Bitangent, "bitangent"),
        (Self::Texcoord, "texcoord"),
        (Self::Color, "color"),
        (Self::Specular, "specular"),
        (Self::Texcoord1, "texcoord1"),
        (Self::Texcoord2, "texcoord2"),
        (Self::Texcoord3, "texcoord3"),
        (Self::Texcoord4, "texcoord4"),
        (Self::Texcoord5, "texcoord5"),
        (Self::Texcoord6, "texcoord6"),
        (Self::Texcoord7, "texcoord7"),
    ];

    /// The coordinate sets by number.
    pub const TEXCOORDS: [Self; 8] = [
        Self::Texcoord,
        Self::Texcoord1,
        Self::Texcoord2,
        Self::Texcoord3,
        Self::Texcoord4,
        Self::Texcoord5,
        Self::Texcoord6,
        Self::Texcoord7,
    ];

    /// Whether a mesh stores it as it is given, four numbers a vertex, or not at all.
    pub(super) fn is_further(self) -> bool {
        self == Self::Specular || Self::TEXCOORDS.contains(&self)
    }

    /// How many components the mesh stores; a vertex register fills up the rest from (0, 0, 0, 1).
    pub fn components(self) -> usize {
        match self {
            Self::Position | Self::Normal | Self::Tangent | Self::Bitangent => 3,
            _ => 4,
        }
    }
}

impl fmt::Display for Attribute {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = Self::ALL
            .iter()
            .find(|(a, _)| a == self)
            .map_or("", |(_, n)| n);
        f.pad(name)
    }
}

/// The text is not the name of an [`Attribute`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownAttribute(String);

impl fmt::Display for UnknownAttribute {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<&str> = Attribute::ALL.iter().map(|(_, n)| *n).collect();
        write!(
            f,
            "`{}` is no mesh attribute; there are {}",
            self.0,
            names.join(", ")
        )
    }
}

impl std::error::Error for UnknownAttribute {}

impl FromStr for Attribute {
    type Err = UnknownAttribute;

    /// Reads a lower-case name of [`Attribute::ALL`].
    fn from_str(text: &str) -> Result<Self, UnknownAttribute> {
        Self::ALL
            .iter()
            .find(|(_, name)| *name == text)
            .map(|(attribute, _)| *attribute)
            .ok_or_else(|| UnknownAttribute(text.to_owned()))
    }
}
