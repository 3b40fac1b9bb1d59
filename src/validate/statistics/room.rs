//! Where a shader is at a limit, and where it leaves room: read ports and pairs.

use super::super::listing::Listing;
use super::super::{budgets, pairing, ports};
use crate::diagnostic::Span;
use crate::isa::RegisterFile;

/// Instructions that read as many registers of a file as may be read at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FullPorts {
    /// The file.
    pub file: RegisterFile,
    /// How many registers of it may be read at once.
    pub allowed: u32,
    /// Whether these are pairs, both halves of which share their ports, or single instructions.
    pub pairs: bool,
    /// The instructions, or the pairs from the first half to the second.
    pub places: Vec<Span>,
}

/// Two neighbours that could be a pair: the rules allow it, and the second does not read what the first writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PossiblePair {
    /// The first instruction.
    pub first: Span,
    /// The second one, before which the `+` would stand.
    pub second: Span,
    /// Arithmetic slots that the pair takes less than the two.
    pub saves: u32,
}

/// Where ports are full, by file; single instructions before pairs. Files whose ports cannot run out are left out.
pub(super) fn full_ports(listing: &Listing) -> Vec<FullPorts> {
    let mut full: Vec<FullPorts> = Vec::new();
    let mut add = |file: RegisterFile, allowed: usize, pairs: bool, place: Span| {
        let same = |f: &&mut FullPorts| f.file == file && f.pairs == pairs;
        match full.iter_mut().find(same) {
            Some(found) => found.places.push(place),
            None => full.push(FullPorts {
                file,
                allowed: allowed as u32,
                pairs,
                places: vec![place],
            }),
        }
    };
    for group in listing.groups() {
        for line in group {
            for (file, allowed) in ports::full_of_instruction(listing, line) {
                add(file, allowed, false, line.instruction.span);
            }
        }
        if let [first, second] = group {
            let place = first.instruction.span.to(second.instruction.span);
            for (file, allowed) in ports::full_of_pair(listing, first, second) {
                add(file, allowed, true, place);
            }
        }
    }
    full.sort_by_key(|f| (f.file as u8, f.pairs));
    full
}

/// Pairs that could be, from the top on.
pub(super) fn possible_pairs(listing: &Listing) -> Vec<PossiblePair> {
    let mut pairs = Vec::new();
    let mut taken = false;
    for two in listing.lines.windows(2) {
        let [first, second] = two else { continue };
        let could = !taken && pairing::could_pair(listing, first, second);
        taken = could;
        if could {
            let [apart, joined] = [budgets::slots_apart(two), budgets::slots_joined(two)];
            pairs.push(PossiblePair {
                first: first.instruction.span,
                second: second.instruction.span,
                saves: apart.saturating_sub(joined),
            });
        }
    }
    pairs
}
