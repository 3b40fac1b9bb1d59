use super::*;
use crate::isa::ShaderKind;

const TEXT: &str = "ps.1.4\n\
    def c0, 0.5, 0.5, 0.5, 0.5\n\
    texcrd r0.rgb, t0\n\
    add r0.rgb, r0, c0\n\
    add r0.rgb, r0, c0\n\
    mov_sat r1.rgb, r0\n\
    phase\n\
    texld r2, r0\n\
    mov r0.rgb, r1\n\
    +mov r0.a, r2\n";

fn action(id: u32) -> Action {
    Action {
        id,
        enabled: true,
        ..Action::default()
    }
}

fn at_line(session: &Session<'_>, line: usize, action: Action) -> Breakpoint {
    let instruction = session.run().unwrap().listing.instructions_at(line).start;
    Breakpoint {
        kind: ShaderKind::Pixel,
        instruction,
        action,
    }
}

/// The line of the instruction that comes next; none at the end.
fn line(session: &Session<'_>) -> Option<usize> {
    let run = session.run()?;
    session.next_instruction().map(|i| run.listing.line(i))
}

fn watch(id: u32, mask: WriteMask) -> Watchpoint {
    let target = Target::Slot(Slot::R0);
    Watchpoint {
        kind: ShaderKind::Pixel,
        target,
        mask,
        action: action(id),
    }
}

#[test]
fn breakpoints_stop_before_their_line_in_both_directions() {
    let owned = Owned::new(TEXT);
    let mut session = owned.session(&[("t0", &[0.0])]);
    let stops = Stops {
        breakpoints: vec![
            at_line(&session, 5, action(1)),
            at_line(&session, 9, action(2)),
            at_line(
                &session,
                6,
                Action {
                    enabled: false,
                    ..action(3)
                },
            ),
        ],
        ..Stops::default()
    };
    let mut go = |direction| {
        let travel = session.travel(direction, &stops, &Until::End);
        (travel.reasons, line(&session))
    };
    use Direction::{Backward, Forward};
    assert_eq!(go(Forward), (vec![Reason::Breakpoint(1)], Some(5)));
    assert_eq!(go(Forward), (vec![Reason::Breakpoint(2)], Some(9)));
    assert_eq!(go(Forward), (vec![Reason::End], None));
    assert_eq!(go(Backward), (vec![Reason::Breakpoint(2)], Some(9)));
    assert_eq!(go(Backward), (vec![Reason::Breakpoint(1)], Some(5)));
    assert_eq!(go(Backward).0, [Reason::End]);
}

#[test]
fn conditions_and_counts() {
    let owned = Owned::new(TEXT);
    let session = owned.session(&[("t0", &[0.25])]);
    let when = |condition: &str, line| {
        let condition = Some(condition.parse().unwrap());
        let stops = Stops {
            breakpoints: vec![at_line(
                &session,
                line,
                Action {
                    condition,
                    ..action(1)
                },
            )],
            ..Stops::default()
        };
        session
            .clone()
            .travel(Direction::Forward, &stops, &Until::End)
            .reasons
    };
    // Before line 5 r0 is 0.25 + 0.5.
    assert_eq!(when("r0.r > 0.7", 5), [Reason::Breakpoint(1)]);
    assert_eq!(when("r0.r > 0.8", 5), [Reason::End]);
    // r0 changes three times before the last line: 0.25, 0.75, 1.25; then it becomes 1.
    let count = |hits: &str| {
        let hits = hits.parse().unwrap();
        let mut watchpoint = watch(7, WriteMask::X);
        watchpoint.action.hits = hits;
        let stops = Stops {
            watchpoints: vec![watchpoint],
            ..Stops::default()
        };
        let mut session = session.clone();
        let mut values = Vec::new();
        while session
            .travel(Direction::Forward, &stops, &Until::End)
            .reasons
            == [Reason::Watchpoint(7)]
        {
            values.push(session.registers().slot(Slot::R0, 0)[0]);
        }
        // Backwards the same hits stop, each before its change.
        let mut back = 0;
        while session
            .travel(Direction::Backward, &stops, &Until::End)
            .reasons
            == [Reason::Watchpoint(7)]
        {
            back += 1;
        }
        assert_eq!(back, values.len(), "{hits}");
        values
    };
    assert_eq!(count(">= 1"), [0.25, 0.75, 1.25, 1.0]);
    assert_eq!(count("2"), [0.75]);
    assert_eq!(count("> 2"), [1.25, 1.0]);
    assert_eq!(count("% 2"), [0.75, 1.0]);
    for wrong in ["", "x", "< 3", "% 0", "> 4294967295"] {
        assert!(wrong.parse::<HitCount>().is_err(), "{wrong}");
    }
}

#[test]
fn watchpoints_watch_components() {
    let owned = Owned::new(TEXT);
    let mut session = owned.session(&[("t0", &[0.0])]);
    let alpha = WriteMask::component(3);
    let stops = Stops {
        watchpoints: vec![watch(1, alpha)],
        ..Stops::default()
    };
    let travel = session.travel(Direction::Forward, &stops, &Until::End);
    assert_eq!(travel.reasons, [Reason::Watchpoint(1)]);
    // Alpha is written by the second half of the pair, which is the last moment: opaque black was sampled.
    assert_eq!(session.registers().slot(Slot::R0, 0)[3], 1.0);
    assert_eq!(line(&session), None);
    // Going back one stands right before the change.
    session.travel(Direction::Backward, &stops, &Until::End);
    assert_eq!(line(&session), Some(10));
    assert_eq!(session.registers().slot(Slot::R0, 0)[3], 0.0);
}

#[test]
fn one_can_run_until_something_happens() {
    let owned = Owned::new(TEXT);
    let mut session = owned.session(&[("t0", &[0.25])]);
    let mut until = |direction, occurrence| {
        let travel = session.travel(direction, &Stops::default(), &Until::Occurrence(occurrence));
        (travel.reasons, line(&session))
    };
    use Direction::{Backward, Forward};
    // 1.25 is saturated on line 6; the phase comes next.
    let clamp = vec![Reason::Occurrence(Occurrence::Clamp)];
    assert_eq!(until(Forward, Occurrence::Clamp), (clamp.clone(), Some(7)));
    let sample = vec![Reason::Occurrence(Occurrence::Sample)];
    assert_eq!(until(Forward, Occurrence::Sample), (sample, Some(9)));
    assert_eq!(until(Backward, Occurrence::Clamp), (clamp, Some(6)));
    assert_eq!(until(Forward, Occurrence::Nan), (vec![Reason::End], None));
    for occurrence in Occurrence::all() {
        assert_eq!(occurrence.name().parse(), Ok(occurrence));
    }
    assert!("black".parse::<Occurrence>().is_err());
}

#[test]
fn one_can_run_to_a_place() {
    let owned = Owned::new(TEXT);
    let mut session = owned.session(&[]);
    let instruction = session.run().unwrap().listing.instructions_at(8).start;
    let to = Until::Instruction {
        kind: ShaderKind::Pixel,
        instruction,
    };
    let travel = session.travel(Direction::Forward, &Stops::default(), &to);
    assert_eq!(
        (travel.reasons, line(&session)),
        (vec![Reason::Reached], Some(8))
    );
    let start = Position { run: 0, at: 1 };
    let travel = session.travel(
        Direction::Backward,
        &Stops::default(),
        &Until::Position(start),
    );
    assert_eq!(
        (travel.reasons, session.position()),
        (vec![Reason::Reached], start)
    );
    let travel = session.travel(Direction::Forward, &Stops::default(), &Until::RunEnd);
    assert_eq!(
        (travel.reasons, line(&session)),
        (vec![Reason::Reached], None)
    );
}

#[test]
fn log_points_write_and_go_on() {
    let owned = Owned::new(TEXT);
    let mut session = owned.session(&[("t0", &[0.25])]);
    let log = Some("r0 is {r0.r}".parse().unwrap());
    let stops = Stops {
        breakpoints: vec![
            at_line(
                &session,
                4,
                Action {
                    log: log.clone(),
                    ..action(1)
                },
            ),
            at_line(&session, 5, Action { log, ..action(2) }),
        ],
        ..Stops::default()
    };
    let travel = session.travel(Direction::Forward, &stops, &Until::End);
    let texts: Vec<_> = travel.logs.iter().map(|(_, text)| text.as_str()).collect();
    assert_eq!(
        (travel.reasons, texts),
        (vec![Reason::End], vec!["r0 is 0.25", "r0 is 0.75"])
    );
}
