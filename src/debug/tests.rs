#[cfg(feature = "scene")]
mod pixel;
mod stops;

use super::*;
use crate::diagnostic::SourceMap;
use crate::exec::{Machine, Trace};
use crate::generate::{self, Generated, Random, Textures};
use crate::isa::{Version, WriteMask};
use crate::kernel::{self, Kernel, Slot};
use crate::policy::Dialect;
use crate::program::Program;

/// A listing that owns what it points into.
pub(super) struct Owned {
    sources: SourceMap,
    program: Program,
    kernel: Kernel,
}

impl Owned {
    /// A listing that may break rules of the runtime, as long as it has a meaning.
    pub(super) fn new(text: &str) -> Self {
        let mut sources = SourceMap::new();
        let checked = crate::listing::check(sources.add("test", text).unwrap(), Dialect::Lenient);
        let program = checked.accepted().expect(text).clone();
        let kernel = kernel::lower(&program, &kernel::Options::default()).unwrap();
        Self {
            sources,
            program,
            kernel,
        }
    }

    pub(super) fn listing(&self) -> Listing<'_> {
        Listing {
            program: &self.program,
            kernel: &self.kernel,
            sources: &self.sources,
        }
    }

    /// A session with values given by name.
    pub(super) fn session(&self, values: &[(&str, &[f32])]) -> Session<'_> {
        let mut given = Given::default();
        for (name, numbers) in values {
            given.set(self.program.version, name, numbers).unwrap();
        }
        Session::new(Subject::Listing(ListingSubject {
            listing: self.listing(),
            given,
        }))
    }
}

/// The flags of all moments of the instruction on a line.
fn flags(session: &Session<'_>, line: usize) -> Flags {
    let run = session.run().unwrap();
    let instruction = run.listing.instructions_at(line).start;
    let moments = run
        .moments
        .iter()
        .filter(|m| m.instruction == Some(instruction));
    moments.fold(Flags::default(), |all, moment| all.or(moment.flags[0]))
}

#[test]
fn a_session_starts_at_the_first_instruction() {
    let owned = Owned::new("ps.1.1\ntex t0\nmul r0, v0, c0\n");
    let mut session = owned.session(&[("v0", &[0.5, 0.25, 2.0, 1.0]), ("c0", &[0.5])]);
    // Two inputs come before it: v0 and t0's coordinates.
    assert_eq!(session.position(), Position { run: 0, at: 2 });
    assert_eq!(session.next_instruction(), Some(0));
    while session.step() {}
    // 0.5·0.5, 0.25·0.5, 1·0.5 (clamped on the way in), 1·0.5
    assert_eq!(
        session.registers().slot(Slot::R0, 0),
        [0.25, 0.125, 0.5, 0.5]
    );
    assert_eq!(session.next_instruction(), None);
    let run = session.run().unwrap();
    assert_eq!(run.moments[0].flags[0].clamped, WriteMask::Z);
    assert_eq!(run.listing.text(1), "mul r0, v0, c0");
    assert_eq!(run.listing.line(1), 3);
}

#[test]
fn macros_are_stepped_by_rows_or_as_a_whole() {
    let owned = Owned::new("vs.1.1\nmov r0, v0\nm4x4 r0, r0, c0\nmov oPos, r0\n");
    let mut session =
        owned.session(&[("v0", &[1.0, 2.0, 3.0, 4.0]), ("c1", &[0.0, 1.0, 0.0, 0.0])]);
    assert!(session.next(Direction::Forward));
    let start = session.position();
    assert!(session.step());
    assert_eq!(session.next_instruction(), Some(1));
    assert!(!session.can_set(), "the rows write together");
    session.go_to(start);
    assert!(session.next(Direction::Forward));
    assert_eq!(session.next_instruction(), Some(2));
    // Row 1 is (0, 1, 0, 0): the second component.
    assert_eq!(session.registers().slot(Slot::R0, 0), [0.0, 2.0, 0.0, 0.0]);
    assert!(session.can_set());
    assert!(session.next(Direction::Backward));
    assert_eq!(session.position(), start);
}

#[test]
fn what_is_remarkable_is_flagged() {
    let owned = Owned::new(
        "ps.1.1\n\
         def c0, 0.75, -0.5, 0.25, 1\n\
         texcoord t0\n\
         add_sat r0, c0, c0\n\
         mov r1, t0\n",
    );
    let session = owned.session(&[("t0", &[1.5, 0.5, -1.0, 1.0])]);
    // texcoord clamps by itself: x and z.
    let xz = WriteMask::X.or(WriteMask::Z);
    assert_eq!(flags(&session, 3).clamped, xz);
    // 1.5, −1, 0.5, 2
    assert_eq!(
        flags(&session, 4).saturated,
        WriteMask::ALL.without(WriteMask::Z)
    );
    assert!(flags(&session, 5).is_empty());

    let owned = Owned::new(
        "vs.1.1\n\
         mov a0.x, v0.x\n\
         mov r0, c[a0.x + 1]\n\
         rcp r1, v1.x\n\
         mul r2, r1, r1\n\
         sub r3, r2, r2\n\
         mov oPos, r4\n",
    );
    let session = owned.session(&[("v0", &[300.0]), ("v1", &[0.0])]);
    assert!(flags(&session, 3).out_of_range);
    // 1/0, the largest number there is, is born here and only grows in the square; ∞ − ∞ makes NaN.
    assert_eq!(flags(&session, 4).infinite, WriteMask::ALL);
    assert!(flags(&session, 5).infinite.is_empty());
    assert_eq!(flags(&session, 6).nan, WriteMask::ALL);
    assert!(flags(&session, 7).uninitialised);
}

#[test]
fn phase_takes_the_alpha() {
    let owned = Owned::new("ps.1.4\nmov r1, c0\nphase\nmov r0.rgb, r1\n+mov r0.a, r1.a\n");
    let mut session = owned.session(&[]);
    let r1 = Slot::temp(1).unwrap();
    session.step();
    assert_eq!(session.registers().written(r1), WriteMask::ALL);
    session.step();
    assert_eq!(session.registers().written(r1), WriteMask::XYZ);
    session.back();
    assert_eq!(session.registers().written(r1), WriteMask::ALL);
    assert!(flags(&session, 5).uninitialised);
}

#[test]
fn a_value_set_by_hand_runs_on() {
    let owned = Owned::new("ps.1.1\nmov r0, c0\nadd r0, r0, r0\nadd r0, r0, c1\n");
    let mut session = owned.session(&[("c0", &[0.25]), ("c1", &[0.125])]);
    assert!(session.step());
    assert!(session.set(Target::Slot(Slot::R0), WriteMask::X, [[0.5; 4]; 4]));
    assert_eq!(
        session.registers().slot(Slot::R0, 0),
        [0.5, 0.25, 0.25, 0.25]
    );
    assert!(session.step());
    // A constant from here on: the next instruction reads it.
    assert!(session.set(Target::Constant(1), WriteMask::ALL, [[0.25; 4]; 4]));
    while session.step() {}
    // 2·0.5 + 0.25; 2·0.25 + 0.25
    assert_eq!(
        session.registers().slot(Slot::R0, 0),
        [1.25, 0.75, 0.75, 0.75]
    );
    // The old run: 2·0.25 + 0.125
    let old = &session.original().unwrap()[0];
    assert_eq!(old.registers(usize::MAX).slot(Slot::R0, 0), [0.625; 4]);
    // Stepping back undoes what was set, too.
    while session.back() {}
    assert_eq!(session.registers().constant(1), [0.125; 4]);
    // Something set earlier leaves what was set later in its place.
    assert!(session.set(Target::Constant(0), WriteMask::ALL, [[1.0; 4]; 4]));
    while session.step() {}
    assert_eq!(
        session.registers().slot(Slot::R0, 0),
        [1.25, 2.25, 2.25, 2.25]
    );
    session.unset();
    while session.step() {}
    assert_eq!(session.registers().slot(Slot::R0, 0), [0.625; 4]);
}

/// The first quad of a generated shader.
fn recorded<'a>(
    generated: &Generated,
    listing: Listing<'a>,
    environment: crate::exec::Environment<'a>,
) -> Run<'a> {
    let inputs = generated.inputs.iter().map(|(slot, values)| {
        let value: Quad = std::array::from_fn(|pixel| values[pixel]);
        Input {
            slot: *slot,
            source: InputSource::Given,
            raw: value,
            value,
        }
    });
    let invocation = Invocation {
        kind: RunKind::Listing,
        listing,
        environment,
        lane: 0,
        helpers: [false; 4],
        inputs: inputs.collect(),
    };
    record(invocation, &[])
}

#[test]
fn a_recording_is_the_interpreters_trace_and_goes_back_as_it_came() {
    let textures = Textures::new().unwrap();
    for (seed, version) in (0..40_u64).flat_map(|seed| Version::all().map(move |v| (seed, v))) {
        let options = generate::Options::new(version);
        let generated = generate::shader(&mut Random::new(seed), &options, &textures);
        let owned = Owned::new(&generated.listing);
        let kernel = generated.lower(&owned.program).unwrap();
        let listing = Listing {
            kernel: &kernel,
            ..owned.listing()
        };
        let environment = generated.environment(&kernel, &textures);
        let run = recorded(&generated, listing, environment.clone());

        let mut machine = Machine::<4>::new();
        generated.load(&mut machine, 0);
        let trace = Trace::record(&mut machine, &kernel, &environment, 2);
        let bits = |value: [f32; 4]| value.map(f32::to_bits);
        let steps = run
            .moments
            .iter()
            .filter(|m| matches!(m.event, Event::Step { .. }));
        let changes: Vec<_> = steps
            .filter_map(|m| Some((m.instruction?, m.change?)))
            .collect();
        assert_eq!(changes.len(), trace.changes.len(), "{}", generated.listing);
        for ((instruction, change), expected) in changes.iter().zip(&trace.changes) {
            assert_eq!(*instruction, expected.instruction);
            assert_eq!(change.target, Target::Slot(expected.slot));
            assert_eq!(
                bits(change.before[2]),
                bits(expected.before),
                "{}",
                generated.listing
            );
            assert_eq!(
                bits(change.after[2]),
                bits(expected.after),
                "{}",
                generated.listing
            );
        }
        // Every instruction is there, in order.
        let told: Vec<_> = run.moments.iter().filter_map(|m| m.instruction).collect();
        assert!(told.is_sorted());
        assert!((0..owned.program.instructions().count()).all(|i| told.contains(&i)));

        // All the way forward, and back: each state is met again, to the bit.
        let mut registers = run.initial.clone();
        let mut states = vec![image(&registers)];
        for moment in &run.moments {
            registers.apply(moment);
            states.push(image(&registers));
        }
        for (at, moment) in run.moments.iter().enumerate().rev() {
            assert_eq!(image(&registers), states[at + 1]);
            registers.undo(moment);
        }
        assert_eq!(image(&registers), states[0]);
    }
}

type Image = (Vec<u32>, Vec<WriteMask>, [bool; 4]);

/// Registers by their bits, so that NaN is like NaN.
fn image(registers: &Registers) -> Image {
    let slots: Vec<Slot> = Slot::all().collect();
    let numbers = slots.iter().flat_map(|slot| registers.quad(*slot));
    (
        numbers.flatten().map(f32::to_bits).collect(),
        slots.iter().map(|slot| registers.written(*slot)).collect(),
        registers.killed(),
    )
}
