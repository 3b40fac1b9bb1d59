//! `debug`: scripts of commands, and the article's listings against arithmetic done by hand.

use super::{Ran, folder, texcrd, texcrd_with_input};
use std::collections::BTreeMap;
use std::fs;

const VERTEX: &str = "asm/stained_glass/stained_glass.vsh";
const PIXEL: &str = "asm/stained_glass/stained_glass.psh";

/// What a step changes: a register, the first of its components that is written (0 to 3), and values from there on.
type Change = (&'static str, usize, &'static [f64]);

/// The registers after every step hold what is worked out by hand.
///
/// `steps` holds a command each with what it changes, and with the registers whose alpha is lost. All registers and outputs are
/// asked for after each and compared with what all changes so far come to; a component that nothing has written is a dash.
fn every_step_is(listing: &str, settings: &[&str], steps: &[(&str, &[Change], &[&str])]) {
    let mut script = String::new();
    for (command, ..) in steps {
        script.push_str(&format!("{command}\ninfo registers\ninfo outputs\n"));
    }
    let mut arguments = vec!["debug", listing, "--script", "-"];
    for setting in settings {
        arguments.extend(["--set", setting]);
    }
    let Ran { status, out, err } = texcrd_with_input(&arguments, script.as_bytes());
    assert_eq!(status, 0, "{err}");
    let answers: Vec<&str> = out.split("(texcrd) ").skip(1).collect();
    assert_eq!(answers.len(), 3 * steps.len(), "{out}");
    let mut expected: BTreeMap<&str, [Option<f64>; 4]> = BTreeMap::new();
    for ((command, changes, lost), answers) in steps.iter().zip(answers.chunks(3)) {
        assert!(answers[0].starts_with(command), "{}", answers[0]);
        for (register, first, values) in *changes {
            let register = expected.entry(register).or_default();
            for (place, value) in register[*first..].iter_mut().zip(*values) {
                *place = Some(*value);
            }
        }
        for register in *lost {
            expected.entry(register).or_default()[3] = None;
        }
        let mut told = BTreeMap::new();
        for row in answers[1].lines().skip(1).chain(answers[2].lines().skip(1)) {
            let (name, values) = row.trim().split_once(' ').expect("a name and values");
            told.insert(name, values.trim());
        }
        for (name, values) in &told {
            let expected = expected.get(name).copied().unwrap_or_default();
            let values: Vec<&str> = values.split(", ").collect();
            assert_eq!(values.len(), 4, "{name}");
            for (value, expected) in values.iter().zip(expected) {
                let Some(expected) = expected else {
                    assert_eq!(*value, "-", "{name} after `{command}`: {values:?}");
                    continue;
                };
                let value: f64 = value.parse().expect("a number");
                // A handful of roundings of numbers around 1 to 24 bits; the values by hand are decimal.
                let near = (value - expected).abs() <= 1e-6 * expected.abs().max(1.0);
                assert!(
                    near,
                    "{name} is {values:?} after `{command}` in {}",
                    answers[0]
                );
            }
        }
        assert!(
            expected.keys().all(|name| told.contains_key(name)),
            "{told:?}"
        );
    }
}

/// Position (1, 2, 3), normal (0, 0, −1), tangents x and y, a camera at (7, 2, −5); a projection that doubles x and y; an
/// environment transform that halves; c15 and fourth columns that must not count.
#[test]
fn every_step_of_the_vertex_shader() {
    let settings = [
        "v0=1,2,3,1",
        "v3=0,0,-1",
        "v7=0.25,0.75",
        "v8=1,0,0",
        "v9=0,1,0",
        "c12=1,0,0,5",
        "c13=0,1,0,6",
        "c14=0,0,1,7",
        "c15=9,9,9,9",
        "c16=2,0,0,0",
        "c17=0,2,0,0",
        "c18=0,0,0.5,1",
        "c19=0,0,1,0",
        "c20=0.5,0,0,9",
        "c21=0,0.5,0,9",
        "c22=0,0,0.5,9",
        "c28=7,2,-5,1",
    ];
    every_step_is(
        VERTEX,
        &settings,
        &[
            // m4x4 oPos, v0, c16: 2·1; 2·2; 0.5·3 + 1·1; 1·3
            ("step", &[("oPos", 0, &[2.0])], &[]),
            ("step", &[("oPos", 1, &[4.0])], &[]),
            ("step", &[("oPos", 2, &[2.5])], &[]),
            ("step", &[("oPos", 3, &[3.0])], &[]),
            // mov oT0.xy, v7
            ("step", &[("oT0", 0, &[0.25, 0.75])], &[]),
            // add r8, c28, -v0: 7 − 1, 2 − 2, −5 − 3, 1 − 1
            ("step", &[("r8", 0, &[6.0, 0.0, -8.0, 0.0])], &[]),
            // m3x3 r9, r8, c20: half of it
            ("step", &[("r9", 0, &[3.0])], &[]),
            ("step", &[("r9", 1, &[0.0])], &[]),
            ("step", &[("r9", 2, &[-4.0])], &[]),
            // dp3 r11.x, r9, r9: 9 + 0 + 16
            ("step", &[("r11", 0, &[25.0])], &[]),
            // rsq r11.y, r11.x: 1/√25
            ("step", &[("r11", 1, &[0.2])], &[]),
            // mul oT4.xyz, r9, r11.y: (3, 0, −4)/5
            ("step", &[("oT4", 0, &[0.6, 0.0, -0.8])], &[]),
            // dp3 of the rows (0.5, 0, 0), (0, 0.5, 0), (0, 0, 0.5) with both tangents and the normal
            ("step", &[("oT1", 0, &[0.5])], &[]),
            ("step", &[("oT1", 1, &[0.0])], &[]),
            ("step", &[("oT1", 2, &[0.0])], &[]),
            ("step", &[("oT2", 0, &[0.0])], &[]),
            ("step", &[("oT2", 1, &[0.5])], &[]),
            ("step", &[("oT2", 2, &[0.0])], &[]),
            ("step", &[("oT3", 0, &[0.0])], &[]),
            ("step", &[("oT3", 1, &[0.0])], &[]),
            ("step", &[("oT3", 2, &[-0.5])], &[]),
            // m3x3 r0, v0, c12: the position, as the rows are those of the identity
            ("step", &[("r0", 0, &[1.0])], &[]),
            ("step", &[("r0", 1, &[2.0])], &[]),
            ("step", &[("r0", 2, &[3.0])], &[]),
            // mul oT5, r0, c94.w: times 0.18; r0.w holds the 0 that temporaries begin with
            ("step", &[("oT5", 0, &[0.18, 0.36, 0.54, 0.0])], &[]),
        ],
    );
}

/// A listing alone has no textures, and samples opaque black: what a texture would hold is set by hand after each sample.
#[test]
fn every_step_of_the_pixel_shader() {
    let settings = [
        "t0=0.25,0.75",
        "t1=1,0.5,0.25",
        "t2=0,1,-0.25",
        "t3=0.5,0,-1",
        "t4=0.25,0.5,-0.75",
        "t5=0.125,0.25,0.5",
    ];
    every_step_is(
        PIXEL,
        &settings,
        &[
            // texld r0, t0; then a normal straight up, (0, 0, 1) as bytes hold it
            ("step", &[("r0", 0, &[0.0, 0.0, 0.0, 1.0])], &[]),
            (
                "set r0 = 0.5, 0.5, 1, 1",
                &[("r0", 0, &[0.5, 0.5, 1.0, 1.0])],
                &[],
            ),
            // texcrd of the eye, the rows of the matrix, the correction
            ("step", &[("r1", 0, &[0.25, 0.5, -0.75])], &[]),
            ("step", &[("r4", 0, &[1.0, 0.5, 0.25])], &[]),
            ("step", &[("r2", 0, &[0.0, 1.0, -0.25])], &[]),
            ("step", &[("r3", 0, &[0.5, 0.0, -1.0])], &[]),
            ("step", &[("r5", 0, &[0.125, 0.25, 0.5])], &[]),
            // dp3 with r0_bx2 = (0, 0, 1): the third component of each row
            ("step", &[("r4", 0, &[0.25])], &[]),
            ("step", &[("r4", 1, &[-0.25])], &[]),
            ("step", &[("r4", 2, &[-1.0])], &[]),
            // lrp r2.rgb, c0.r, -r1, -r4: 0.9·−0.25 + 0.1·−0.25; 0.9·−0.5 + 0.1·0.25; 0.9·0.75 + 0.1·1
            ("step", &[("r2", 0, &[-0.25, -0.425, 0.775])], &[]),
            // add r2.rgb, r5, r2
            ("step", &[("r2", 0, &[-0.125, -0.175, 1.275])], &[]),
            // phase takes the only alpha that was written
            ("step", &[], &["r0"]),
            // texld r2, r2; reflected light
            ("step", &[("r2", 0, &[0.0, 0.0, 0.0, 1.0])], &[]),
            (
                "set r2 = 0.5, 0.25, 1, 1",
                &[("r2", 0, &[0.5, 0.25, 1.0, 1.0])],
                &[],
            ),
            // texld r3, t0; the colour of the glass
            ("step", &[("r3", 0, &[0.0, 0.0, 0.0, 1.0])], &[]),
            (
                "set r3 = 0.5, 0.75, 0.25, 0.5",
                &[("r3", 0, &[0.5, 0.75, 0.25, 0.5])],
                &[],
            ),
            // texld r4, r4; diffuse light
            ("step", &[("r4", 0, &[0.0, 0.0, 0.0, 1.0])], &[]),
            (
                "set r4 = 0.5, 0.25, 0.125, 1",
                &[("r4", 0, &[0.5, 0.25, 0.125, 1.0])],
                &[],
            ),
            // texld r5, t0; gloss
            ("step", &[("r5", 0, &[0.0, 0.0, 0.0, 1.0])], &[]),
            (
                "set r5 = 0.25, 0.5, 1, 1",
                &[("r5", 0, &[0.25, 0.5, 1.0, 1.0])],
                &[],
            ),
            // mul r1.rgb, r5, r2: 0.25·0.5, 0.5·0.25, 1·1
            ("step", &[("r1", 0, &[0.125, 0.125, 1.0])], &[]),
            // mad r0.rgb, r3, r4_x2, r1: 0.5·1 + 0.125, 0.75·0.5 + 0.125, 0.25·0.25 + 1
            ("step", &[("r0", 0, &[0.625, 0.5, 1.0625])], &[]),
            // +mov r0.a, r3
            ("step", &[("r0", 3, &[0.5])], &[]),
        ],
    );
}

/// A script is answered as if it were typed: each command behind the prompt, its answer below.
#[test]
fn scripts_read_like_a_session() {
    let folder = folder("debug_script");
    let path = |name: &str| {
        folder
            .join(name)
            .to_str()
            .expect("a readable path")
            .to_string()
    };
    let listing = path("half.psh");
    fs::write(&listing, "ps.1.1\nmul r0, v0, c0\n").expect("a listing");
    let script = path("script.txt");
    let text = format!(
        "# half of it\nstep\n\np r0.r\nexport csv {}\nquit\nnever\n",
        path("out.csv")
    );
    fs::write(&script, text).expect("a script");
    let ran = texcrd(&[
        "debug", &listing, "--set", "v0=1", "--set", "c0=0.5", "-x", "p v0.r", "--script", &script,
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let expected = format!(
        "listing: ps.1.1, {listing}\n\
         ->    2 mul r0, v0, c0\n\
         (texcrd) p v0.r\n\
         v0.r = 1\n\
         (texcrd) # half of it\n\
         (texcrd) step\n      \
         2 mul r0, v0, c0\n        \
         r0           = 0.5, 0.5, 0.5, 0.5   (first write)\n\
         -> end of listing\n        \
         r0           = 0.5, 0.5, 0.5, 0.5\n\
         (texcrd)\n\
         this is the end\n\
         -> end of listing\n        \
         r0           = 0.5, 0.5, 0.5, 0.5\n\
         (texcrd) p r0.r\n\
         r0.r = 0.5\n\
         (texcrd) export csv {out}\n\
         written: {out}\n\
         (texcrd) quit\n",
        out = path("out.csv")
    );
    assert_eq!(ran.out, expected);
    let csv = fs::read_to_string(path("out.csv")).expect("the export");
    assert!(
        csv.ends_with(
            "listing,1,2,\"mul r0, v0, c0\",r0,rgba,0,0,0,0,0.5,0.5,0.5,0.5,rgba,\
             \"v0 = 1, 1, 1, 1; c0 = 0.5, 0.5, 0.5, 0.5\",,,,,,\n"
        ),
        "{csv}"
    );
}

#[test]
fn a_command_that_fails_ends_a_script_and_its_line_is_told() {
    let ran = texcrd_with_input(&["debug", PIXEL, "--script", "-"], b"step\np r9\nstep\n");
    assert_eq!(ran.status, 1);
    assert!(
        ran.err
            .contains("<stdin>:2: ps.1.4 has no r9; it has r0 to r5"),
        "{}",
        ran.err
    );
    assert!(ran.out.ends_with("(texcrd) p r9\n"), "{}", ran.out);
    let ran = texcrd(&["debug", PIXEL, "-x", "glub"]);
    assert_eq!(ran.status, 1);
    assert!(
        ran.err.contains("--command: `glub` is no command"),
        "{}",
        ran.err
    );
    // Standard input without a terminal is a script, too.
    let ran = texcrd_with_input(&["debug", PIXEL], b"s\n");
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(
        ran.out.contains("(texcrd) s\n      3 texld r0, t0\n"),
        "{}",
        ran.out
    );
    // The listing from standard input.
    let ran = texcrd_with_input(&["debug", "-", "-x", "finish"], b"ps.1.1\nmov r0, c0\n");
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(
        ran.out.ends_with("r0           = 0, 0, 0, 0\n"),
        "{}",
        ran.out
    );
    // A listing is never written over.
    let ran = texcrd(&["debug", PIXEL, "-x", &format!("export csv {PIXEL}")]);
    assert_eq!(ran.status, 1);
    assert!(ran.err.contains("this file is read"), "{}", ran.err);
}

#[test]
fn what_does_not_fit_together_is_usage() {
    let usage = |arguments: &[&str], why: &str| {
        let ran = texcrd_with_input(arguments, b"");
        assert_eq!(ran.status, 2, "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(why), "{arguments:?}: {}", ran.err);
    };
    usage(
        &["debug", PIXEL, "--pixel", "1,1"],
        "--pixel: only of a scene",
    );
    usage(&["debug", PIXEL, "--draw", "x"], "--draw: only of a scene");
    usage(&["debug", PIXEL, "--set", "v0"], "write it as v0=1,2,3,4");
    usage(
        &["debug", PIXEL, "--set", "r0=1"],
        "v#, t# and c# can be set",
    );
    usage(&["debug", PIXEL, "--script", "nowhere.txt"], "nowhere.txt");
    usage(
        &["debug", "-", "--script", "-"],
        "standard input is the listing already",
    );
    usage(&["debug", "scene.toml", "--pixel", "1"], "write 640,480");
    usage(
        &["debug", "scene.toml", "--set", "c0=1"],
        "only of a listing",
    );
    usage(&["debug", "nowhere.psh"], "nowhere.psh");
    let ran = texcrd_with_input(&["debug", "-", "-x", "s"], b"ps.1.1\nglub r0\n");
    assert_eq!(ran.status, 1);
}

/// A scene of a rectangle over the left half, in the colour of c0.
#[test]
fn a_pixel_and_a_vertex_of_a_scene() {
    let (scene, _) = super::run::scene(
        "debug_scene",
        &[
            ("scene.toml", super::run::HALF),
            ("half.vsh", super::run::HALF_VS),
        ],
    );
    let ran = texcrd(&[
        "debug",
        &scene,
        "--pixel",
        "1,1",
        "-x",
        "info runs",
        "-x",
        "history",
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.out.starts_with("pixel 1,1: ps.1.1, "), "{}", ran.out);
    assert!(ran.out.contains("draw half, primitive "), "{}", ran.out);
    let ran = texcrd(&[
        "debug", &scene, "--vertex", "1", "--draw", "half", "-x", "s",
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    // The second corner of the rectangle.
    assert!(
        ran.out
            .contains("oPos         = 0, 1, 0.5, 1   (first write)\n"),
        "{}",
        ran.out
    );
    let ran = texcrd(&["debug", &scene, "--pixel", "6,1"]);
    assert_eq!(ran.status, 1);
    assert!(ran.err.contains("nothing is drawn at 6,1"), "{}", ran.err);
    let ran = texcrd(&["debug", &scene, "--pixel", "8,1"]);
    assert_eq!(ran.status, 1);
    assert!(
        ran.err.contains("outside of the 8x4 picture"),
        "{}",
        ran.err
    );
}

/// The sessions of the user's page are real: what they say is what the program says, but for the numbers, whose last digits are
/// those of one machine.
#[test]
fn the_sessions_of_the_page_are_real() {
    let page = fs::read_to_string("docs/debug.md").expect("the page");
    let mut sessions = 0;
    for block in page.split("```console\n$ texcrd debug ").skip(1) {
        let block = block.split("```").next().expect("a block");
        let (command, expected) = block.split_once('\n').expect("a command and its answers");
        let mut arguments = vec!["debug"];
        // Words, and texts between quotes.
        for (number, part) in command.split('\'').enumerate() {
            match number % 2 {
                0 => arguments.extend(part.split_whitespace()),
                _ => arguments.push(part),
            }
        }
        let script: String = (expected.lines())
            .filter_map(|line| line.strip_prefix("(texcrd)"))
            .map(|line| format!("{}\n", line.trim()))
            .collect();
        let script = if arguments.contains(&"-x") {
            ""
        } else {
            &script
        };
        let ran = texcrd_with_input(&arguments, script.as_bytes());
        assert_eq!(ran.status, 0, "{command}: {}", ran.err);
        assert_eq!(
            without_numbers(&ran.out),
            without_numbers(expected),
            "{command}"
        );
        sessions += 1;
    }
    assert!(sessions >= 3, "{sessions}");
}

/// A text with `#` in place of every number of several digits.
fn without_numbers(text: &str) -> String {
    let mut out = String::new();
    let mut number = String::new();
    for c in text.chars().chain(['\n']) {
        if c.is_ascii_digit() || (c == '.' && !number.is_empty()) {
            number.push(c);
            continue;
        }
        out.push_str(if number.len() > 2 { "#" } else { &number });
        number.clear();
        out.push(c);
    }
    out
}
