//! Expected texts are put together by hand from the values that are given and the arithmetic of the listings.

mod language;
#[cfg(feature = "scene")]
mod scenes;

use super::*;
use crate::debug::tests::Owned;

/// A pair whose first half saturates: 0.5 + 0.75 and 0.25 + 0.75 and 0.5 + 0.75.
const PAIR: &str = "ps.1.1\n\
    def c1, 0.75, 0.75, 0.75, 0.75\n\
    mul r0, v0, c0 ; half of blue\n\
    add_sat r0.rgb, r0, c1\n\
    +mov r0.a, v0\n";

const PAIR_VALUES: [(&str, &[f32]); 2] = [
    ("v0", &[0.5, 0.25, 1.0, 0.5]),
    ("c0", &[1.0, 1.0, 0.5, 1.0]),
];

/// Infinity, NaN, a constant out of range, something never written.
const TROUBLE: &str = "vs.1.1\n\
    mov a0.x, v0.x\n\
    mov r0, c[a0.x + 2]\n\
    rcp r1.x, v1.x\n\
    mul r1.x, r1.x, r1.x\n\
    sub r2.x, r1.x, r1.x\n\
    m4x4 oPos, v0, c0\n\
    add oD0, r2.x, r3.y\n";

const TROUBLE_VALUES: [(&str, &[f32]); 2] = [("v0", &[300.0]), ("v1", &[0.0])];

/// A console with its session.
struct Talk<'a> {
    console: Console,
    session: Session<'a>,
}

impl<'a> Talk<'a> {
    fn new(session: Session<'a>) -> Self {
        Self {
            console: Console::new(),
            session,
        }
    }

    /// What is answered to a line that can be done.
    #[track_caller]
    fn say(&mut self, line: &str) -> String {
        let reply = self.console.execute(&mut self.session, line);
        assert!(!reply.failed, "{line}: {}", reply.text);
        reply.text.to_string()
    }

    /// A line is answered with a text.
    #[track_caller]
    fn is(&mut self, line: &str, expected: &str) {
        assert_eq!(self.say(line), expected, "{line}");
    }

    /// What is answered to a line that cannot be done holds a text.
    #[track_caller]
    fn fails(&mut self, line: &str, expected: &str) {
        let reply = self.console.execute(&mut self.session, line);
        let text = reply.text.to_string();
        assert!(reply.failed, "{line}: {text}");
        assert!(text.contains(expected), "{line}: {text}");
        assert_eq!(reply.text.lines[0].pieces[0].style, Style::Error);
    }
}

#[test]
fn steps_tell_what_changed_and_where_one_is() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    let greeting = talk.console.greeting(&talk.session).to_string();
    assert_eq!(greeting, "listing: ps.1.1, test\n->    3 mul r0, v0, c0\n");
    talk.is(
        "step",
        "      3 mul r0, v0, c0\n        \
         r0           = 0.5, 0.25, 0.5, 0.5   (first write)\n\
         ->    4 add_sat r0.rgb, r0, c1\n",
    );
    talk.is(
        "s",
        "      4 add_sat r0.rgb, r0, c1\n        \
         r0.rgb       = 1, 1, 1   (was 0.5, 0.25, 0.5)\n        \
         r0.rb was saturated to 0…1\n\
         ->    5 +mov r0.a, v0\n",
    );
    talk.is(
        "back",
        "      4 add_sat r0.rgb, r0, c1   undone\n        \
         r0.rgb       = 0.5, 0.25, 0.5   (was 1, 1, 1)\n\
         ->    4 add_sat r0.rgb, r0, c1\n",
    );
    talk.is(
        "step 9",
        "this is the end\n      \
         4 add_sat r0.rgb, r0, c1\n        \
         r0.rgb       = 1, 1, 1   (was 0.5, 0.25, 0.5)\n        \
         r0.rb was saturated to 0…1\n      \
         5 +mov r0.a, v0\n        \
         r0.a         = 0.5   (as before)\n\
         -> end of listing\n        \
         r0           = 1, 1, 1, 0.5\n",
    );
    talk.is("start", "listing: ps.1.1, test\n->    3 mul r0, v0, c0\n");
    talk.is(
        "back",
        "   input undone\n        \
         v0           = 0, 0, 0, 0   (was 0.5, 0.25, 1, 0.5)\n\
         -> input v0\n"
            .replace("input undone", "input   undone")
            .as_str(),
    );
    talk.is(
        "step",
        "   input\n        \
         v0           = 0.5, 0.25, 1, 0.5   given\n\
         ->    3 mul r0, v0, c0\n",
    );
    talk.is("goto 5", "->    5 +mov r0.a, v0\n");
    talk.is("goto @0", "-> input v0\n");
    talk.fails("goto @99", "@0 to @4");
    talk.is("reverse-step", "this is the beginning\n-> input v0\n");
    assert!(talk.say("where").contains("moment 0 of 4"));
}

#[test]
fn macros_are_one_instruction_or_their_parts() {
    let owned = Owned::new(TROUBLE);
    let mut talk = Talk::new(owned.session(&TROUBLE_VALUES));
    talk.is("goto 7", "->    7 m4x4 oPos, v0, c0   (part 1 of 4)\n");
    // v0 is 300 in all components, c0 to c3 are 0.
    talk.is(
        "step",
        "      7 m4x4 oPos, v0, c0\n        \
         oPos.x       = 0   (first write)\n\
         ->    7 m4x4 oPos, v0, c0   (part 2 of 4)\n",
    );
    // Nothing waits here, as no row reads what another writes: a value can be set in between.
    assert!(talk.say("set r0 = 1").ends_with("(part 2 of 4)\n"));
    talk.say("unset");
    talk.is(
        "next",
        "      7 m4x4 oPos, v0, c0\n        \
         oPos.yzw     = 0, 0, 0   (first write)\n\
         ->    8 add oD0, r2.x, r3.y\n",
    );
    talk.is(
        "rn",
        "      7 m4x4 oPos, v0, c0   undone\n        \
         oPos         = 0, 0, 0, 0   (as before)\n\
         ->    7 m4x4 oPos, v0, c0   (part 1 of 4)\n",
    );
}

#[test]
fn rows_that_wait_for_each_other_are_not_parted() {
    let owned = Owned::new("vs.1.1\nmov r0, v0\nm4x4 r0, r0, c0\nmov oPos, r0\n");
    let mut talk = Talk::new(owned.session(&[]));
    talk.say("step 2");
    talk.fails("set r0 = 1", "not between the parts of an instruction");
}

#[test]
fn one_runs_to_what_happens() {
    let owned = Owned::new(TROUBLE);
    let mut talk = Talk::new(owned.session(&TROUBLE_VALUES));
    talk.is(
        "until range",
        "stopped at range\n      \
         3 mov r0, c[a0.x + 2]\n        \
         r0           = 0, 0, 0, 0   (first write)\n        \
         c[a0.x + 2] is out of range: it reads 0, 0, 0, 0\n\
         ->    4 rcp r1.x, v1.x\n",
    );
    // 1/0 is the largest number; its square overflows, and ∞ − ∞ is NaN.
    talk.is(
        "until inf",
        "stopped at inf\n      \
         4 rcp r1.x, v1.x\n        \
         r1.x         = 3.4028235e38   (first write)\n        \
         r1.x became infinite\n\
         ->    5 mul r1.x, r1.x, r1.x\n",
    );
    talk.is(
        "u nan",
        "stopped at nan\n      \
         6 sub r2.x, r1.x, r1.x\n        \
         r2.x         = NaN   (first write)\n        \
         r2.x became NaN\n\
         ->    7 m4x4 oPos, v0, c0   (part 1 of 4)\n",
    );
    assert!(
        talk.say("until uninit")
            .contains("r3.y is read, and nothing has written it\n")
    );
    assert!(
        talk.say("reverse-until nan")
            .ends_with("->    6 sub r2.x, r1.x, r1.x\n")
    );
    assert!(talk.say("ru 3").ends_with("->    3 mov r0, c[a0.x + 2]\n"));
    assert!(
        talk.say("advance vs:5")
            .ends_with("->    5 mul r1.x, r1.x, r1.x\n")
    );
    assert!(
        talk.say("until test:7")
            .ends_with("->    7 m4x4 oPos, v0, c0   (part 1 of 4)\n")
    );
    assert!(talk.say("until sample").starts_with("this is the end\n"));
    assert!(talk.say("reverse-finish").ends_with("-> input v0\n"));
    assert!(
        talk.say("finish")
            .ends_with("oD0          = NaN, NaN, NaN, NaN\n")
    );
    talk.fails("until 99", "no instruction stands on line 99");
    talk.fails("until glub", "uninit");
    talk.fails("advance ps:3", "there is no ps here");
    talk.fails("advance other.vsh:3", "there are test");
    talk.fails("advance", "which line");
    talk.fails("step -1", "no number of times");
}

#[test]
fn breakpoints_stop_under_conditions_and_are_counted() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    talk.is(
        "b 4 if r0.r > 1",
        "breakpoint 1 at ps:4  add_sat r0.rgb, r0, c1\n",
    );
    talk.is("tb 5", "temporary breakpoint 2 at ps:5  +mov r0.a, v0\n");
    talk.is(
        "dprintf 4,\"r0 is {r0.rg}\"",
        "log point 3 at ps:4  add_sat r0.rgb, r0, c1\n",
    );
    talk.is("watch r0.a if r0.r == 1", "watchpoint 4: r0.a\n");
    talk.is(
        "info break",
        "  1  breakpoint  ps:4  add_sat r0.rgb, r0, c1   if r0.r > 1\n  \
           2  temporary   ps:5  +mov r0.a, v0\n  \
           3  log point   ps:4  add_sat r0.rgb, r0, c1   \"r0 is {r0.rg}\"\n  \
           4  watchpoint  r0.a   if r0.r == 1\n",
    );
    // r0.r is 0.5 on line 4, so that only the message is written there.
    assert!(talk.say("c").starts_with("r0 is 0.5, 0.25\nbreakpoint 2\n"));
    assert!(talk.say("info b").lines().count() == 3);
    assert!(talk.say("c").starts_with("this is the end\n"));
    talk.is("cond 1 r0.r < 1", "1 stops only if r0.r < 1\n");
    assert!(
        talk.say("rc")
            .starts_with("r0 is 0.5, 0.25\nbreakpoint 1\n")
    );
    talk.is("cond 1", "1 stops always\n");
    talk.is("ignore 1 1", "1 passes over its first 1 hit\n");
    talk.say("start");
    assert!(talk.say("c").contains("this is the end\n"));
    talk.is("hits 1 == 1", "1 stops at hit 1 only\n");
    talk.say("start");
    assert!(talk.say("c").contains("breakpoint 1\n"));
    talk.is("disable 1 3", "disabled: 1, 3\n");
    talk.say("start");
    talk.is("delete 4", "deleted: 4\n");
    assert!(talk.say("c").starts_with("this is the end\n"));
    talk.is("enable", "enabled: 1, 3\n");
    talk.is("catch clamp nan", "caught: clamp, nan\n");
    talk.say("start");
    talk.is("d", "deleted: 1, 3\n");
    assert!(talk.say("c").starts_with("stopped at clamp\n"));
    talk.is("uncatch clamp", "caught: nan\n");
    talk.is("uncatch", "nothing is caught\n");
    talk.is(
        "info watchpoints",
        "there are no breakpoints and watchpoints\n",
    );
    // Every component of the mask counts: the green of r0 changes in the pair.
    talk.say("goto 4");
    talk.is("watch r0.g", "watchpoint 5: r0.g\n");
    assert!(talk.say("c").starts_with("watchpoint 5: r0.g\n"));
    talk.fails("delete 9", "no breakpoint or watchpoint 9");
    talk.fails("delete x", "no number");
    talk.fails("watch r0.r + 1", "watch takes a register");
    talk.fails("watch r9", "ps.1.1 has no r9");
    talk.fails("break 99", "no instruction stands");
    talk.fails("break 4 if r0.q", "components are");
    talk.fails("dprintf 4", "write it as");
    talk.fails("dprintf 4,\"{r0\"", "`}` is missing");
    talk.fails("hits 5 x", "no hit count");
    talk.fails("condition", "write it as");
    talk.fails("ignore 5 x", "write it as");
    talk.fails("catch glub", "what can be caught is nan, inf");
}

#[test]
fn a_temporary_breakpoint_ends_steps() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    talk.say("tbreak 4");
    assert!(talk.say("step 5").starts_with("breakpoint 1\n"));
    talk.is("info b", "there are no breakpoints and watchpoints\n");
    talk.say("goto 5");
    talk.is("break", "breakpoint 2 at ps:5  +mov r0.a, v0\n");
    talk.say("finish");
    talk.fails("break", "no instruction comes next");
}

#[test]
fn expressions_are_printed_and_displayed() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    talk.is("p v0.rg * 2", "v0.rg * 2 = 1, 0.5\n");
    talk.is("p/x v0.r", "v0.r = 0x3f000000\n");
    talk.is("print/c v0", "v0 = #8040ff\n");
    // 0.5·255 = 127.5, to even; 0.5·4096
    talk.is("p/q v0.r", "v0.r = gf3 128/255; r200 2048/4096\n");
    talk.is(
        "display/c r0",
        "  1: r0 = #000000   (nothing has written r0)\n",
    );
    talk.is("display a0.x", "  2: a0.x: ps.1.1 has no a0\n");
    // 0.25 is 63.75/255.
    assert!(
        talk.say("step")
            .ends_with("r0, c1\n  1: r0 = #804080\n  2: a0.x: ps.1.1 has no a0\n")
    );
    talk.is("undisplay 2", "1 left\n");
    talk.is("display", "  1: r0 = #804080\n");
    talk.is("info display", "  1: r0 = #804080\n");
    talk.is("undisplay", "0 left\n");
    talk.is("info display", "   nothing is displayed\n");
    talk.fails("p/d v0", "/x the 32 bits");
    talk.fails("p", "print what");
    talk.fails("p r0 +", "ends where");
    talk.fails("step/x", "step takes no format");
    talk.fails("undisplay 7", "no number of a display");
}

#[test]
fn lines_are_listed() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    talk.say("break 4");
    let all = "      1 ps.1.1\n      \
                     2 def c1, 0.75, 0.75, 0.75, 0.75\n\
               ->    3 mul r0, v0, c0 ; half of blue\n  \
               *   4 add_sat r0.rgb, r0, c1\n      \
                     5 +mov r0.a, v0\n";
    talk.is("list", all);
    talk.fails("list", "the listing has 5 lines");
    talk.say("step");
    assert!(talk.say("l").contains("->*   4 add_sat"));
    assert!(talk.say("list 5").contains("5 +mov"));
}

#[test]
fn info_tells_what_there_is() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    talk.is("info registers", "   r0    -, -, -, -\n");
    talk.say("step");
    talk.is("i r", "   r0    0.5, 0.25, 0.5, 0.5\n");
    talk.is(
        "info constants",
        "   c0    1, 1, 0.5, 1\n   c1    0.75, 0.75, 0.75, 0.75   def\n",
    );
    talk.is("info inputs", "   v0    0.5, 0.25, 1, 0.5   given\n");
    talk.is("info outputs", "   r0    0.5, 0.25, 0.5, 0.5\n");
    talk.is("info textures", "   the shader samples none\n");
    talk.is("info phase", "   ps.1.1 has one phase\n");
    // A pair takes one slot.
    talk.is(
        "info budget",
        "   2 of 8 arithmetic slots, 0 of 4 texture slots\n",
    );
    talk.is("info line", "->    4 add_sat r0.rgb, r0, c1\n");
    talk.is("info runs", "->  1  listing: ps.1.1, test, 4 moments\n");
    talk.is("frame", "->  1  listing: ps.1.1, test, 4 moments\n");
    let all = talk.say("info all");
    assert!(all.starts_with("registers\n   r0") && all.contains("\nbudget\n"));
    assert!(talk.say("info").contains("info constants"));
    talk.fails("info glub", "no topic of info");
    talk.fails("info constannts", "did you mean `constants`?");
    talk.fails("frame 2", "no run");
    talk.fails("up", "no run comes before");
    talk.fails("down", "no run comes behind");

    // Coordinates are there before anything is sampled.
    let owned = Owned::new("ps.1.1\ntex t0\nmov r0, t0\n");
    let mut talk = Talk::new(owned.session(&[("t0", &[0.5])]));
    talk.is("p t0.r", "t0.r = 0.5\n");
    talk.is("p r0.ra", "r0.ra = 0, 0   (nothing has written r0.ra)\n");

    let owned = Owned::new("ps.1.4\ntexld r0, t0\nphase\nmov r0, r0\n");
    let mut talk = Talk::new(owned.session(&[]));
    talk.is("info phase", "   first phase; `phase` stands on line 3\n");
    talk.is("info textures", "   stage 0: no texture, opaque black\n");
    assert!(
        talk.say("next")
            .contains("stage 0: no texture, opaque black\n")
    );
    assert!(talk.say("next").contains("r0.a is lost at `phase`\n"));
    talk.is("info registers", "   r0    0, 0, 0, -\n");
    talk.is("info phase", "   second phase; `phase` stands on line 3\n");
    talk.is(
        "info budget",
        "   phase 1: 0 of 8 arithmetic slots, 1 of 6 texture slots\n   \
            phase 2: 1 of 8 arithmetic slots, 0 of 6 texture slots\n",
    );

    let owned = Owned::new(TROUBLE);
    let mut talk = Talk::new(owned.session(&[("c7", &[3.0])]));
    // m4x4 names four; relative operands may read all that are set.
    let constants = talk.say("info constants");
    assert!(
        constants.contains("   c3    0, 0, 0, 0\n   c7    3, 3, 3, 3\n"),
        "{constants}"
    );
    // mov, mov, rcp, mul, sub, 4 rows, add
    talk.is("info budget", "   10 of 128 slots\n");
}

#[test]
fn values_are_set_and_both_runs_told_apart() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    talk.fails("diff", "nothing is set by hand");
    talk.fails("unset", "nothing is set by hand");
    talk.say("step");
    talk.is(
        "set r0.rg = 0.125, 0",
        "        r0.rg        = 0.125, 0   (was 0.5, 0.25)\n\
         ->    4 add_sat r0.rgb, r0, c1\n",
    );
    // 0.125 + 0.75 and 0 + 0.75; blue as before.
    talk.is(
        "diff",
        "listing: ps.1.1, test\n   \
            set r0.rg = 0.125, 0\n   \
            they part at      4 add_sat r0.rgb, r0, c1\n        \
         r0.rgb       = 0.875, 0.75, 1   (old run: 1, 1, 1)\n   \
            results\n        \
         r0           = 0.875, 0.75, 1, 0.5   (old run: 1, 1, 1, 0.5)\n",
    );
    talk.is("unset", "1 forgotten\n->    4 add_sat r0.rgb, r0, c1\n");
    // Four numbers give the mask its own, one fills it; a constant can be set, too.
    talk.is(
        "set r0.b = (1, 2, 3, 4)",
        "        r0.b         = 3   (was 0.5)\n->    4 add_sat r0.rgb, r0, c1\n",
    );
    talk.is("set c1 = v0.r / 2", "        c1           = 0.25, 0.25, 0.25, 0.25   (was 0.75, 0.75, 0.75, 0.75)\n->    4 add_sat r0.rgb, r0, c1\n");
    // 0.5 + 0.25, 0.25 + 0.25, 3 + 0.25 saturated
    assert!(
        talk.say("finish")
            .ends_with("r0           = 0.75, 0.5, 1, 0.5\n")
    );
    // Constants of a pixel shader lie in −1…1.
    assert!(
        talk.say("set c0 = 2")
            .contains("c0           = 1, 1, 1, 1   (was 1, 1, 0.5, 1)\n        clamped to −1…1")
    );
    talk.fails("set r0.rg = 1, 2, 3", "2 components are set to 3 numbers");
    talk.fails("set r0", "write it as");
    talk.fails("set r9 = 1", "ps.1.1 has no r9");
    talk.fails("set 1 = 1", "no register");
}

#[test]
fn why_names_the_instructions_and_what_they_read() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    talk.say("finish");
    talk.is(
        "why r0.r",
        "   input\n        \
         v0.r         = 0.5   given\n      \
         3 mul r0, v0, c0\n        \
         r0.r         = 0.5   from v0.r = 0.5, c0.r = 1\n      \
         4 add_sat r0.rgb, r0, c1\n        \
         r0.r         = 1   from r0.r = 0.5, c1.r = 0.75\n        \
         r0.rb was saturated to 0…1\n   \
            r0.r = 1\n",
    );
    assert!(talk.say("w").ends_with("   r0 = 1, 1, 1, 0.5\n"));
    talk.say("start");
    talk.is("why c0", "c0 = 1, 1, 0.5, 1: no instruction has made it\n");
    assert!(
        talk.say("why r0.g")
            .starts_with("        r0.g was never written\n")
    );
    talk.fails("why r0 + 1", "no register with components");
    talk.fails("quad", "only a pixel of a scene");

    let owned = Owned::new(TROUBLE);
    let mut talk = Talk::new(owned.session(&[("v0", &[1.0]), ("c3", &[5.0])]));
    talk.say("until 4");
    // The constant that the address names, and where the address comes from.
    let why = talk.say("why r0.y");
    assert!(why.contains("c[a0.x + 2].y (c3) = 5"), "{why}");
    assert!(why.contains("mov a0.x, v0.x"), "{why}");
    talk.fails("why", "why what");
}

#[test]
fn everything_can_be_exported() {
    let owned = Owned::new(PAIR);
    let mut talk = Talk::new(owned.session(&PAIR_VALUES));
    // Of the first write all components are new; the pair writes over them.
    talk.is(
        "export csv",
        "run,moment,line,text,register,components,\
         before_x,before_y,before_z,before_w,after_x,after_y,after_z,after_w,\
         first_write,reads,stage,u,v,w,level,remarks\n\
         listing,0,,input,v0,rgba,0,0,0,0,0.5,0.25,1,0.5,rgba,,,,,,,\n\
         listing,1,3,\"mul r0, v0, c0\",r0,rgba,0,0,0,0,0.5,0.25,0.5,0.5,rgba,\
         \"v0 = 0.5, 0.25, 1, 0.5; c0 = 1, 1, 0.5, 1\",,,,,,\n\
         listing,2,4,\"add_sat r0.rgb, r0, c1\",r0,rgb,0.5,0.25,0.5,0.5,1,1,1,0.5,,\
         \"r0.rgb = 0.5, 0.25, 0.5; c1.rgb = 0.75, 0.75, 0.75\",,,,,,r0.rb was saturated to 0…1\n\
         listing,3,5,\"+mov r0.a, v0\",r0,a,1,1,1,0.5,1,1,1,0.5,,v0.a = 0.5,,,,,,\n",
    );
    talk.is(
        "export json",
        "{\"runs\": [\n  \
         {\"run\": \"listing\", \"version\": \"ps.1.1\", \"moments\": [\n    \
         {\"text\": \"input\", \"register\": \"v0\", \"components\": \"rgba\", \"before\": [0, 0, 0, 0], \"after\": [0.5, 0.25, 1, 0.5], \
         \"first_write\": \"rgba\"},\n    \
         {\"line\": 3, \"text\": \"mul r0, v0, c0\", \"register\": \"r0\", \"components\": \"rgba\", \"before\": [0, 0, 0, 0], \"after\": [0.5, 0.25, 0.5, 0.5], \
         \"first_write\": \"rgba\", \"reads\": [\"v0 = 0.5, 0.25, 1, 0.5\", \"c0 = 1, 1, 0.5, 1\"]},\n    \
         {\"line\": 4, \"text\": \"add_sat r0.rgb, r0, c1\", \"register\": \"r0\", \"components\": \"rgb\", \"before\": [0.5, 0.25, 0.5, 0.5], \"after\": [1, 1, 1, 0.5], \
         \"reads\": [\"r0.rgb = 0.5, 0.25, 0.5\", \"c1.rgb = 0.75, 0.75, 0.75\"], \"remarks\": [\"r0.rb was saturated to 0…1\"]},\n    \
         {\"line\": 5, \"text\": \"+mov r0.a, v0\", \"register\": \"r0\", \"components\": \"a\", \"before\": [1, 1, 1, 0.5], \"after\": [1, 1, 1, 0.5], \
         \"reads\": [\"v0.a = 0.5\"]}\n  ]}\n]}\n",
    );
    talk.is(
        "export md",
        "## listing: ps.1.1, test\n\n\
         | line | instruction | register | value | from | remarks |\n\
         | ---: | --- | --- | --- | --- | --- |\n\
         |  | `input` | v0 | 0.5, 0.25, 1, 0.5 |  |  |\n\
         | 3 | `mul r0, v0, c0` | r0 | 0.5, 0.25, 0.5, 0.5 | v0 = 0.5, 0.25, 1, 0.5, c0 = 1, 1, 0.5, 1 |  |\n\
         | 4 | `add_sat r0.rgb, r0, c1` | r0.rgb | 1, 1, 1 | r0.rgb = 0.5, 0.25, 0.5, c1.rgb = 0.75, 0.75, 0.75 | r0.rb was saturated to 0…1 |\n\
         | 5 | `+mov r0.a, v0` | r0.a | 0.5 | v0.a = 0.5 |  |\n",
    );
    let reply = talk
        .console
        .execute(&mut talk.session, "export csv some run.csv");
    let Some(Effect::Write { path, text }) = reply.effect else {
        panic!("{:?}", reply.effect);
    };
    assert_eq!(path, "some run.csv");
    assert_eq!(text.lines().count(), 5);
    talk.fails("export", "json, csv or markdown");
    talk.fails("export xml", "no format");

    // JSON has no NaN: it stands as a text.
    let owned = Owned::new(TROUBLE);
    let mut talk = Talk::new(owned.session(&TROUBLE_VALUES));
    let json = talk.say("export json");
    assert!(
        json.contains(
            "\"components\": \"x\", \"before\": [0, 0, 0, 0], \"after\": [\"NaN\", 0, 0, 0]"
        ),
        "{json}"
    );
}
