//! Opcodes by their mnemonics, through a hash table that the compiler makes of the rows: every word of a listing is looked
//! up, and is compared with one or two mnemonics instead of all.

use super::Opcode;
use super::opcode::OPCODES;

/// How many slots [`SLOTS`] has: more than twice as many as there are opcodes, so that few share one.
const COUNT: usize = 128;

/// Stands in a slot without an opcode; no row has this number.
const EMPTY: u8 = u8::MAX;

/// The length of the longest mnemonic.
const LONGEST: usize = {
    let (mut longest, mut row) = (0, 0);
    while row < OPCODES.len() {
        if OPCODES[row].mnemonic.len() > longest {
            longest = OPCODES[row].mnemonic.len();
        }
        row += 1;
    }
    longest
};

/// The numbers of the rows, each in the first slot that was free from that of its mnemonic on.
static SLOTS: [u8; COUNT] = {
    let mut slots = [EMPTY; COUNT];
    let mut row = 0;
    while row < OPCODES.len() {
        let mut slot = first_slot(OPCODES[row].mnemonic.as_bytes());
        while slots[slot] != EMPTY {
            slot = (slot + 1) % COUNT;
        }
        slots[slot] = row as u8;
        row += 1;
    }
    slots
};

/// The slot in which the search for a mnemonic begins; the same for letters of either case.
const fn first_slot(mnemonic: &[u8]) -> usize {
    let (mut hash, mut i) = (0u32, 0);
    while i < mnemonic.len() {
        hash = hash.wrapping_mul(33) ^ (mnemonic[i] | 0x20) as u32;
        i += 1;
    }
    (hash ^ hash >> 7) as usize % COUNT
}

impl Opcode {
    /// The opcode with this mnemonic, in any case of letters.
    pub fn from_mnemonic(mnemonic: impl AsRef<[u8]>) -> Option<Self> {
        let mnemonic = mnemonic.as_ref();
        if mnemonic.len() > LONGEST {
            return None;
        }
        let mut slot = first_slot(mnemonic);
        // Ends at an empty slot, of which there are more than of others.
        loop {
            let row = OPCODES.get(usize::from(*SLOTS.get(slot)?))?;
            if row.mnemonic.as_bytes().eq_ignore_ascii_case(mnemonic) {
                return Some(row.opcode);
            }
            slot = (slot + 1) % COUNT;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::isa::RegisterFile;

    #[test]
    fn every_mnemonic_is_found_and_nothing_else_is() {
        for opcode in Opcode::all() {
            let name = opcode.mnemonic();
            let upper = name.to_ascii_uppercase();
            assert_eq!(Opcode::from_mnemonic(name), Some(opcode));
            assert_eq!(Opcode::from_mnemonic(upper.as_str()), Some(opcode));
            // The parser asks for one or the other.
            assert_eq!(RegisterFile::named(name), None, "{name}");
            let known = |text: &str| Opcode::all().any(|op| op.mnemonic() == text);
            for at in 0..name.len() {
                for letter in [b'_', b'0', b'z', b'M', b'@', 0x80] {
                    let mut other = name.as_bytes().to_vec();
                    other[at] = letter;
                    let text = String::from_utf8_lossy(&other).to_ascii_lowercase();
                    let found = Opcode::from_mnemonic(&other);
                    assert_eq!(found.is_some(), known(&text), "{text}");
                }
                let shorter = Opcode::from_mnemonic(&name[..at]);
                assert_eq!(shorter.is_some(), known(&name[..at]), "{}", &name[..at]);
            }
        }
        let long = "m".repeat(1000);
        assert_eq!(Opcode::from_mnemonic(long), None);
        assert_eq!(Opcode::from_mnemonic(""), None);
    }
}
