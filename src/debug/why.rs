//! The backward slice: which moments made a value.

use super::moment::{Event, Read, Target};
use super::run::Run;
use crate::isa::WriteMask;
use crate::kernel::{Op, Place, Slot, Step};
use std::collections::BTreeMap;

/// A moment that a value depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cause {
    /// The moment, by its number in the run.
    pub moment: usize,
    /// The components that it wrote and the value depends on.
    pub mask: WriteMask,
}

/// Everything that made a value.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Slice {
    /// The moments, in the order of the run.
    pub causes: Vec<Cause>,
    /// The constants, and the components of them, as they were when the run began.
    pub constants: Vec<(u32, WriteMask)>,
    /// The inputs; their moments are among the causes.
    pub inputs: Vec<(Slot, WriteMask)>,
    /// Registers that nothing had written.
    pub unwritten: Vec<(Slot, WriteMask)>,
}

/// What made the components of a register or constant that stand there after the first `at` moments of a run, for the pixel that
/// is looked at.
///
/// Operands that could not have made a difference are left out: a factor beside a factor of zero, the source that `cmp`, `cnd`, or
/// `lrp` at one of its ends did not take, the one that `min` or `max` left behind.
pub fn why(run: &Run<'_>, at: usize, target: Target, mask: WriteMask) -> Slice {
    let mut needed = Needed(BTreeMap::new());
    needed.add(target, mask);
    let mut slice = Slice::default();
    for (number, moment) in run.moments.iter().enumerate().take(at).rev() {
        let Some(change) = &moment.change else {
            continue;
        };
        let hit = needed.take(change.target, change.mask);
        if hit.is_empty() {
            continue;
        }
        slice.causes.push(Cause {
            moment: number,
            mask: hit,
        });
        match &moment.event {
            Event::Step { step, reads, .. } => {
                if let Some(step) = run.listing.kernel.steps.get(*step) {
                    needed.add_reads(step, reads, hit, run.lane);
                }
            }
            Event::Input(_) => {
                slice
                    .inputs
                    .extend(change.target.slot().map(|slot| (slot, hit)));
            }
            // The clamp passes on what was there.
            Event::Taken | Event::Merge(_) => needed.add(change.target, hit),
            Event::Nothing | Event::Set => {}
        }
    }
    slice.causes.reverse();
    slice.inputs.reverse();
    for (target, mask) in needed.0 {
        match target {
            Target::Constant(index) => slice.constants.push((index, mask)),
            Target::Slot(slot) => slice.unwritten.push((slot, mask)),
        }
    }
    slice
}

/// What is still to be explained.
struct Needed(BTreeMap<Target, WriteMask>);

impl Needed {
    fn add(&mut self, target: Target, mask: WriteMask) {
        if !mask.is_empty() {
            let place = self.0.entry(target).or_default();
            *place = place.or(mask);
        }
    }

    /// The needed components among those written; they are explained then.
    fn take(&mut self, target: Target, written: WriteMask) -> WriteMask {
        let Some(mask) = self.0.get_mut(&target) else {
            return WriteMask::NONE;
        };
        let hit = mask.and(written);
        *mask = mask.without(written);
        if mask.is_empty() {
            self.0.remove(&target);
        }
        hit
    }

    fn add_reads(&mut self, step: &Step, reads: &[Read], written: WriteMask, lane: usize) {
        for c in written.components() {
            let deciding = deciding(step.op, reads, c, lane);
            for (i, read) in reads.iter().enumerate() {
                if !deciding.get(i).copied().unwrap_or(true) {
                    continue;
                }
                let components = read.operand.swizzle.reads(slots_read(step.op, i, c));
                match read.operand.place {
                    Place::Slot(slot) => self.add(Target::Slot(slot), components),
                    Place::Constant(index) => self.add(Target::Constant(index), components),
                    Place::Relative(_) => {
                        self.add(Target::Slot(Slot::ADDRESS), WriteMask::X);
                        if let Some(index) = read.relative[lane & 3] {
                            self.add(Target::Constant(index), components);
                        }
                    }
                    Place::Literal(_) => {}
                }
            }
        }
    }
}

/// The slots of source `i` that one component of the result follows from.
fn slots_read(op: Op, i: usize, component: usize) -> WriteMask {
    let only = WriteMask::from_bits;
    match (op, i, component) {
        // 1, max(x, 0), a power of y if x is positive, 1
        (Op::Lit, _, 0 | 3) => WriteMask::NONE,
        (Op::Lit, _, 1) => WriteMask::X,
        // 1, y·y, z of the first, w of the second
        (Op::Dst, _, 0) | (Op::Dst, 0, 3) | (Op::Dst, 1, 2) => WriteMask::NONE,
        (Op::Dst, _, c) => WriteMask::component(c),
        // The last one is 1.
        (Op::ExpP | Op::LogP, _, 3) => WriteMask::NONE,
        (Op::DivideZ, _, c) => WriteMask::component(c).and(WriteMask::XY).or(WriteMask::Z),
        (Op::DivideW, _, c) => WriteMask::component(c).and(WriteMask::XY).or(only(0b1000)),
        (Op::Project(by), _, c) => {
            let by = WriteMask::component(by.into());
            WriteMask::component(c).and(WriteMask::XYZ).or(by)
        }
        (Op::Bump(_), 0, c) => WriteMask::component(c),
        (Op::Bump(_), _, 2 | 3) => WriteMask::NONE,
        _ => op.slots_read(i, WriteMask::component(component)),
    }
}

/// The first source, and the second or the third.
fn either(second: bool) -> [bool; 3] {
    [true, second, !second]
}

/// Which sources could have made a difference to a component.
fn deciding(op: Op, reads: &[Read], component: usize, lane: usize) -> [bool; 3] {
    let value = |i: usize| {
        reads
            .get(i)
            .map_or(0.0, |read| read.values[lane & 3][component])
    };
    let [a, b] = [value(0), value(1)];
    let factors = match (a == 0.0, b == 0.0) {
        (true, false) => [true, false],
        (false, true) => [false, true],
        _ => [true, true],
    };
    match op {
        Op::Mul => [factors[0], factors[1], false],
        Op::Mad => [factors[0], factors[1], true],
        Op::Lrp if a == 0.0 => [true, false, true],
        Op::Lrp if a == 1.0 => [true, true, false],
        // With NaN the comparison is false, as it is in the instruction.
        Op::Cmp => either(a >= 0.0),
        Op::Cnd => either(a > 0.5),
        Op::Min if a != b => [a < b, b <= a || a.is_nan() || b.is_nan(), false],
        Op::Max if a != b => [a >= b, b > a || a.is_nan() || b.is_nan(), false],
        _ => [true; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::debug::tests::Owned;

    fn lines(text: &str, values: &[(&str, &[f32])], mask: WriteMask) -> (Vec<usize>, Slice) {
        let owned = Owned::new(text);
        let session = owned.session(values);
        let run = &session.runs()[0];
        let slice = why(run, usize::MAX, Target::Slot(Slot::R0), mask);
        let lines = slice
            .causes
            .iter()
            .filter_map(|c| run.moments[c.moment].instruction);
        (lines.map(|i| run.listing.line(i)).collect(), slice)
    }

    #[test]
    fn only_what_the_component_follows_from_is_told() {
        let text = "ps.1.1\n\
                    mov r0, c0\n\
                    mov r1, c1\n\
                    mul r1.rgb, r1, v0\n\
                    +mov r1.a, c2\n\
                    add r0.rgb, r0, r1\n";
        let (found, slice) = lines(text, &[("v0", &[0.5]), ("c1", &[1.0])], WriteMask::X);
        assert_eq!(found, [2, 3, 4, 6]);
        assert_eq!(slice.constants, [(0, WriteMask::X), (1, WriteMask::X)]);
        assert_eq!(slice.inputs, [(Slot::input(0).unwrap(), WriteMask::X)]);
        // Alpha was only moved.
        let (found, slice) = lines(text, &[], WriteMask::component(3));
        assert_eq!(
            (found, slice.constants),
            (vec![2], vec![(0, WriteMask::component(3))])
        );
    }

    #[test]
    fn what_made_no_difference_is_left_out() {
        let text = "ps.1.4\n\
                    mov r1, c1\n\
                    mov r2, c2\n\
                    mov r3, c3\n\
                    mul r2, r1, r2\n\
                    cmp r0, r3, r2, r1\n";
        // c1 is 0: neither c2 nor, since c3 is positive, the way through r1 alone matters.
        let (found, slice) = lines(text, &[("c2", &[0.5]), ("c3", &[0.5])], WriteMask::X);
        assert_eq!(found, [2, 4, 5, 6]);
        assert_eq!(slice.constants, [(1, WriteMask::X), (3, WriteMask::X)]);
    }

    #[test]
    fn an_address_is_a_reason_too() {
        let text = "vs.1.1\nmov a0.x, v0.y\nmov r0, c[a0.x + 1].w\nmov oPos, r0\n";
        let (found, slice) = lines(text, &[("v0", &[0.0, 2.0])], WriteMask::X);
        assert_eq!(found, [2, 3]);
        assert_eq!(slice.constants, [(3, WriteMask::component(3))]);
        assert_eq!(slice.inputs, [(Slot::input(0).unwrap(), WriteMask::Y)]);
    }

    #[test]
    fn what_nothing_wrote_is_told() {
        let (found, slice) = lines("ps.1.1\nmov r0, r1\n", &[], WriteMask::X);
        assert_eq!(
            (found, slice.unwritten),
            (vec![2], vec![(Slot::temp(1).unwrap(), WriteMask::X)])
        );
    }
}
