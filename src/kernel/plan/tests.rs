//! What is left out, and what is put together.

use super::*;
use crate::diagnostic::SourceMap;
use crate::kernel::{Options, lower};
use crate::syntax;

fn plan(listing: &str) -> Plan {
    let mut sources = SourceMap::new();
    let parsed = syntax::parse(sources.add("test", listing).unwrap());
    Plan::new(&lower(&parsed.program.unwrap(), &Options::default()).unwrap())
}

/// The operations that are done for every batch, each with how often.
fn ops(listing: &str) -> Vec<(RowOp, usize)> {
    let plan = plan(listing);
    let steps = plan.steps[plan.once..].iter();
    steps
        .map(|step| (step.op, plan.items(step).count()))
        .collect()
}

#[test]
fn what_nobody_reads_is_left_out() {
    // Of the product in r1 only x is read, and r2 not at all.
    let listing = "vs.1.1\nmul r1, v0, v1\nadd r2, v0, v1\nadd oPos, r1.x, v1\n";
    assert_eq!(ops(listing), [(RowOp::Mul, 1), (RowOp::Add, 4)]);
}

#[test]
fn moves_are_reads_of_another_row() {
    let listing =
        "ps.1.4\ntexcrd r1.rgb, t0\nmov r2.rgb, r1\nmul r0.rgb, r2, r1\n+mov r0.a, c0.a\n";
    assert_eq!(ops(listing), [(RowOp::Mul, 3)]);
    // What moved is loaded as it would have been written: without denormal numbers.
    assert!(plan(listing).inputs.iter().all(|input| input.flushed));
    assert_eq!(plan(listing).once, 1);
}

#[test]
fn what_follows_from_constants_is_computed_once() {
    let listing = "vs.1.1\nmul r0, c0, c1\nadd r0, r0, c2\nmul oPos, v0, r0\n";
    let plan = plan(listing);
    let ops: Vec<_> = plan.steps.iter().map(|step| step.op).collect();
    assert_eq!(ops, [RowOp::Mul, RowOp::Add, RowOp::Mul]);
    assert_eq!(plan.once, 2);
}

#[test]
fn the_same_is_computed_once() {
    use crate::isa::SourceModifier::Bx2;
    // Three rows of a matrix read the same normal; the third component of the first is read twice.
    let listing = "ps.1.4\ntexld r0, t0\ntexcrd r1.rgb, t1\ntexcrd r2.rgb, t2\ndp3 r3.r, r1, r0_bx2\ndp3 r3.g, r2, r0_bx2\n\
                   dp3 r3.b, r1, r0_bx2\nmov r0.rgb, r3\n+mov r0.a, r0.a\n";
    let expected = [
        (RowOp::Sample(0), 1),
        (RowOp::Modify(Bx2), 3),
        (RowOp::Dp3, 2),
    ];
    assert_eq!(ops(listing), expected);
}

#[test]
fn signs_become_differences() {
    let listing = "vs.1.1\nadd r0, v0, -v1\nadd oPos, -v2, r0\n";
    assert_eq!(ops(listing), [(RowOp::Sub, 4), (RowOp::Sub, 4)]);
}

/// No step writes a row that it reads, and no row that is read later is written in between.
#[test]
fn rows_hold_until_they_were_read() {
    use crate::generate::{self, Random, Textures};
    use crate::isa::Version;
    let textures = Textures::new().unwrap();
    for seed in 0..200 {
        let version = Version::all()
            .nth(seed as usize % Version::all().count())
            .unwrap();
        let options = generate::Options::new(version);
        let shader = generate::shader(&mut Random::new(seed), &options, &textures);
        let plan = Plan::new(&shader.lower(&shader.program).unwrap());
        for step in &plan.steps {
            let items: Vec<_> = plan.items(step).collect();
            assert!(!items.is_empty());
            let written = items.iter().flat_map(|(results, _)| results.iter());
            for row in written.filter(|row| **row != NO_ROW) {
                assert!((*row as usize) < plan.rows);
                assert!(items.iter().all(|(_, sources)| !sources.contains(row)));
            }
        }
    }
}
