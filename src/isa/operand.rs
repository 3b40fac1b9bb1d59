//! Write masks and swizzles.

use std::fmt;

/// The letters of the four components in vertex shaders.
pub const XYZW: [char; 4] = ['x', 'y', 'z', 'w'];
/// The letters of the four components in pixel shaders.
pub const RGBA: [char; 4] = ['r', 'g', 'b', 'a'];

/// Which components an instruction writes: bit 0 is x (r), bit 3 is w (a).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct WriteMask(u8);

impl WriteMask {
    /// No component. No instruction has it; it is the start of a union.
    pub const NONE: Self = Self(0);
    /// `.x`
    pub const X: Self = Self(1);
    /// `.y`
    pub const Y: Self = Self(2);
    /// `.z`
    pub const Z: Self = Self(4);
    /// `.w`, `.a`
    pub const W: Self = Self(8);
    /// `.xy`, `.rg`
    pub const XY: Self = Self(3);
    /// `.xyz`, `.rgb`
    pub const XYZ: Self = Self(7);
    /// All four components; written as no mask.
    pub const ALL: Self = Self(15);

    /// The mask with these bits (x in bit 0). Higher bits are dropped.
    pub const fn from_bits(bits: u8) -> Self {
        Self(bits & 15)
    }

    /// The bits, x in bit 0.
    pub const fn bits(self) -> u8 {
        self.0
    }

    /// The mask of component `c` (0 to 3).
    pub const fn component(c: usize) -> Self {
        Self(1 << (c & 3))
    }

    /// Whether component `c` (0 to 3) is written.
    pub const fn has(self, c: usize) -> bool {
        self.0 & (1 << (c & 3)) != 0
    }

    /// Whether every component of `other` is in this mask.
    pub const fn contains(self, other: Self) -> bool {
        self.0 & other.0 == other.0
    }

    /// The components of both.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The components that are in both.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// The components of this mask that are not in the other.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether no component is in the mask.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// How many components are in the mask.
    pub const fn count(self) -> u32 {
        self.0.count_ones()
    }

    /// The components in order, as indices.
    pub fn components(self) -> impl Iterator<Item = usize> {
        (0..4).filter(move |&c| self.has(c))
    }

    /// The mask as text, with the dot, in the letters given; nothing for the full mask.
    pub fn text(self, letters: [char; 4]) -> String {
        if self == Self::ALL {
            return String::new();
        }
        std::iter::once('.')
            .chain(self.components().map(|c| letters[c]))
            .collect()
    }
}

impl fmt::Display for WriteMask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text(XYZW))
    }
}

/// A set of write masks: those that an instruction may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MaskSet(u16);

impl MaskSet {
    /// Every mask.
    pub const ANY: Self = Self(0xFFFE);
    /// Only the full mask, written as none.
    pub const FULL: Self = Self::of(&[WriteMask::ALL]);
    /// `.rgba`, `.rgb`, `.a`: what the colour and the alpha pipe of `ps.1.0` to `ps.1.3` write.
    pub const PIPES: Self = Self::of(&[WriteMask::ALL, WriteMask::XYZ, WriteMask::W]);

    /// The set of these masks.
    pub const fn of(masks: &[WriteMask]) -> Self {
        let mut bits = 0;
        let mut i = 0;
        while i < masks.len() {
            bits |= 1 << masks[i].0;
            i += 1;
        }
        Self(bits)
    }

    /// Whether the mask is in the set.
    pub const fn contains(self, mask: WriteMask) -> bool {
        self.0 & (1 << mask.0) != 0
    }

    /// The masks of the set.
    pub fn iter(self) -> impl Iterator<Item = WriteMask> {
        (1..16).map(WriteMask).filter(move |m| self.contains(*m))
    }
}

/// For each of the four slots of an operand, which component of the register it reads (0 to 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Swizzle([u8; 4]);

impl Swizzle {
    /// `.xyzw`; written as no swizzle.
    pub const IDENTITY: Self = Self([0, 1, 2, 3]);
    /// `.xyz`: coordinates of a texture read, the fourth slot repeats the third.
    pub const XYZZ: Self = Self([0, 1, 2, 2]);
    /// `.xyw`: coordinates of a projected texture read.
    pub const XYWW: Self = Self([0, 1, 3, 3]);

    /// The swizzle that reads these components. Values above 3 wrap around.
    pub const fn new(slots: [u8; 4]) -> Self {
        Self([slots[0] & 3, slots[1] & 3, slots[2] & 3, slots[3] & 3])
    }

    /// One component in all four slots.
    pub const fn replicate(component: u8) -> Self {
        Self::new([component; 4])
    }

    /// The swizzle of 1 to 4 components, the last repeated: `.xy` is `.xyyy`.
    pub fn from_components(components: &[u8]) -> Option<Self> {
        let last = *components.last()?;
        if components.len() > 4 || components.iter().any(|c| *c > 3) {
            return None;
        }
        let mut slots = [last; 4];
        slots[..components.len()].copy_from_slice(components);
        Some(Self(slots))
    }

    /// The component that slot `slot` (0 to 3) reads.
    pub const fn slot(self, slot: usize) -> usize {
        self.0[slot & 3] as usize
    }

    /// The components that all four slots read.
    pub const fn slots(self) -> [u8; 4] {
        self.0
    }

    /// The component that every slot reads, if it is the same.
    pub fn replicated(self) -> Option<u8> {
        let [x, y, z, w] = self.0;
        (x == y && y == z && z == w).then_some(x)
    }

    /// The components that are read when only the slots of `mask` are used.
    pub fn reads(self, mask: WriteMask) -> WriteMask {
        mask.components()
            .map(|slot| WriteMask::component(self.slot(slot)))
            .fold(WriteMask::NONE, WriteMask::or)
    }

    /// The swizzle byte of a source token: two bits a slot, x lowest.
    pub const fn byte(self) -> u8 {
        self.0[0] | self.0[1] << 2 | self.0[2] << 4 | self.0[3] << 6
    }

    /// The swizzle of a source token's swizzle byte.
    pub const fn from_byte(byte: u8) -> Self {
        Self::new([byte, byte >> 2, byte >> 4, byte >> 6])
    }

    /// The swizzle as text with the dot: trailing repeats collapsed, nothing for the identity.
    pub fn text(self, letters: [char; 4]) -> String {
        if self == Self::IDENTITY {
            return String::new();
        }
        let mut length = 4;
        while length > 1 && self.0[length - 1] == self.0[length - 2] {
            length -= 1;
        }
        std::iter::once('.')
            .chain((0..length).map(|i| letters[self.slot(i)]))
            .collect()
    }
}

impl fmt::Display for Swizzle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text(XYZW))
    }
}
