//! The format, its errors, and what is told of wrong numbers.

mod forms;

use super::*;
use crate::scene::LoadOptions;
use std::collections::BTreeMap;

fn load(name: &str, text: &str) -> Result<Case, String> {
    let files: BTreeMap<String, Vec<u8>> = [
        ("mov.psh".to_owned(), b"ps.1.1\nmov r0, v0\n".to_vec()),
        ("broken.psh".to_owned(), b"ps.1.1\nmvo r0, v0\n".to_vec()),
    ]
    .into();
    Case::load(name, text.as_bytes(), &files, &LoadOptions::default())
        .map_err(|error| error.to_string())
}

fn loaded(text: &str) -> Case {
    load("case.toml", text).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn passes(text: &str) {
    for verdict in loaded(text).check() {
        assert_eq!(verdict, Verdict::Passed);
    }
}

/// What is wrong with the only invocation.
#[track_caller]
fn wrong(text: &str) -> Vec<Wrong> {
    match loaded(text).check().remove(0) {
        Verdict::Failed(wrong) => wrong,
        verdict => panic!("{verdict:?}"),
    }
}

/// The case is refused, and this is said about it.
#[track_caller]
fn refused(text: &str, said: &str) {
    let error = load("case.toml", text).expect_err("a problem");
    assert!(error.contains(said), "{error}");
}

const MOV: &str = "ps = \"ps.1.1\\nmov r0, v0\"\n";

const DOCUMENT: &str = include_str!("../../docs/cases.md");

#[test]
fn the_examples_of_the_document_pass() {
    for (kind, name) in [("```toml\n", "case.toml"), ("```json\n", "case.json")] {
        let examples: Vec<&str> = DOCUMENT.split(kind).skip(1).collect();
        assert_eq!(examples.len(), 1, "{kind}");
        let example = examples[0].split("```").next().unwrap();
        let case = load(name, example).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(case.check(), vec![Verdict::Passed; case.invocations.len()]);
        // What cannot fail shows nothing.
        let changed = example.replace("c0 = [0.5,", "c0 = [0.25,");
        let changed = changed.replace("\"c0\": [0.5,", "\"c0\": [0.25,");
        let case = load(name, &changed).unwrap_or_else(|error| panic!("{error}"));
        assert!(matches!(case.check()[0], Verdict::Failed(_)));
    }
}

/// The names between backquotes in the help of the problems of a case with a key `zzzzzzzz` in every table.
#[test]
fn every_key_is_described() {
    let unknown = "zzzzzzzz = 1\n";
    let text = format!(
        "{MOV}{unknown}[expect]\n{unknown}[textures.0]\ntexels = []\n{unknown}[samplers.0]\n{unknown}[stages.0]\n{unknown}\
         [[invocation]]\n{unknown}[state.fog]\n{unknown}"
    );
    let error = load("case.toml", &text).unwrap_err();
    let helps = error
        .lines()
        .filter_map(|line| line.strip_prefix("  help: there are "));
    let keys: std::collections::BTreeSet<&str> = helps
        .flat_map(|help| help.split('`').skip(1).step_by(2))
        .filter(|key| !key.starts_with('r') && !key.starts_with('t') || *key == "texels")
        .collect();
    assert!(keys.len() > 35, "{keys:?}");
    for key in keys {
        // `mipmaps` is described with scene files.
        let forms = [
            format!("`{key}`"),
            format!("`[{key}]`"),
            format!("`[[{key}]]`"),
        ];
        let described = forms.iter().any(|form| DOCUMENT.contains(form));
        assert!(described || key == "mipmaps", "`{key}` is not described");
    }
}

#[test]
fn json_and_toml_give_the_same_case() {
    let toml = loaded(
        "name = \"a \\u00e4\"\nps = \"ps.1.1\\ntex t0\\nmov r0, t0\"\ntol = 0.5\n\
         textures.0 = { format = \"rgba32f\", size = [1, 1], texels = [[inf, nan, -inf, -2e3]] }\n\
         expect = { r0 = [inf, nan, -inf, -2e3], killed = false }\n",
    );
    let json = load(
        "case.json",
        "{\"name\": \"a \\u00e4\", \"ps\": \"ps.1.1\\ntex t0\\nmov r0, t0\", \"tol\": 0.5,\n\
         \"textures\": {\"0\": {\"format\": \"rgba32f\", \"size\": [1, 1], \"texels\": [[\"inf\", \"nan\", \"-inf\", -2E+3]]}},\n\
         \"expect\": {\"r0\": [\"inf\", \"nan\", \"-inf\", -2000], \"killed\": false}}",
    )
    .unwrap();
    assert_eq!(toml.name, json.name);
    for case in [toml, json] {
        assert_eq!(case.invocations[0].tolerance, 0.5);
        assert_eq!(case.check(), [Verdict::Passed]);
    }
}

#[test]
fn broken_json_is_told_at_its_place() {
    for (text, said) in [
        (
            "{",
            "case.json:1:2: error[F1]: a key between quotes must stand here, not the end of the file",
        ),
        (
            "[]",
            "1:1: error[F1]: `{` must stand at the beginning of a JSON case, not `[`",
        ),
        (
            "{\"ps\" 1}",
            "1:7: error[F1]: `:` must stand behind a key, not `1`",
        ),
        (
            "{\"ps\": }",
            "1:8: error[F1]: a value must stand here, not `}`",
        ),
        ("{\"ps\": nul}", "`nul` is no JSON"),
        ("{\"ps\": [null]}", "`null` has no meaning in a list"),
        ("{\"tol\": 1.2.3}", "1:9: error[F1]: `1.2.3` is no number"),
        ("{\"ps\": \"a\\q\"}", "JSON has no such escape"),
        ("{\"ps\": \"\\ud800\"}", "this escape is no character"),
        ("{\"ps\": \"a\n\"}", "a text ends in its line"),
        ("{\"tol\": 1, \"tol\": 2}", "the key `tol` is given twice"),
        ("{\"tol\": 1} 2", "`2` stands behind the end"),
        (
            "{\n \"expct\": {}}",
            "2:2: error[F2]: case.json has no key `expct`",
        ),
    ] {
        let error = load("case.json", text).unwrap_err();
        assert!(error.contains(said), "{text}: {error}");
    }
    let deep = format!("{{\"a\": {}", "[".repeat(100_000));
    assert!(
        load("case.json", &deep)
            .unwrap_err()
            .contains("nest more than")
    );
}

#[test]
fn no_part_of_a_case_makes_it_panic() {
    let json = "{\"ps\": \"ps.1.1\\u0020\\nmov r0, v0\", \"expect\": {\"r0\": [1, -2.5e3, \"nan\", true]}}";
    let toml = format!("{MOV}[expect]\nr0 = [1, 2]\n[[invocation]]\ninputs.v0 = 1\n");
    for end in 0..json.len() {
        let _ = load("case.json", &json[..end]);
    }
    for end in 0..toml.len() {
        let _ = load("case.toml", &toml[..end]);
    }
}

#[test]
fn what_cannot_be_meant_is_refused() {
    refused(
        "expect.r0 = [1]\n",
        "needs a shader: `vs`, `ps`, `vs_file` or `ps_file`",
    );
    refused(MOV, "needs an `expect` with at least one register");
    refused(&format!("{MOV}expect.r2 = [1]\n"), "[expect] has no `r2`");
    refused(
        &format!("{MOV}expect.oPos = [1]\n"),
        "[expect] has no `oPos`",
    );
    refused(
        &format!("{MOV}expect.kiled = true\n"),
        "did you mean `killed`?",
    );
    refused(&format!("{MOV}expect.r0 = []\n"), "`r0` has 0 numbers");
    refused(
        &format!("{MOV}expect.r0 = [1, 2, 3, 4, 5]\n"),
        "`r0` has 5 numbers",
    );
    refused(
        &format!("{MOV}expect.depth = 1\n"),
        "nothing gives a `depth`",
    );
    refused(
        &format!("{MOV}expect.r0 = [1]\ninputs.v2 = [1]\n"),
        "[inputs] has no register `v2`",
    );
    refused(
        &format!("{MOV}expect.r0 = [1]\nps_constants.c8 = [1]\n"),
        "there are `c0` to `c7`",
    );
    refused(
        &format!("{MOV}expect.r0 = [1]\ntextures.8 = {{}}\n"),
        "[textures] has no stage `8`",
    );
    refused(
        &format!("{MOV}expect.r0 = [1]\ntol = -1\n"),
        "a tolerance is 0 or more",
    );
    refused(
        &format!("{MOV}expect.r0 = [1]\nstages.0.count = 5\n"),
        "`count` is 5",
    );
    refused(
        &format!("{MOV}expect.r0 = [1]\n[[invocation]]\nexpekt.r0 = [1]\n"),
        "invocation 1 has no key `expekt`",
    );
    refused(
        "ps = \"vs.1.1\\nmov oPos, v0\"\nexpect.r0 = [1]\n",
        "where a pixel shader must stand",
    );
    refused(
        "ps_file = \"broken.psh\"\nexpect.r0 = [1]\n",
        "broken.psh:2:1: error[",
    );
    refused(
        "ps_file = \"none.psh\"\nexpect.r0 = [1]\n",
        "`none.psh` cannot be read",
    );
    refused(
        "vs = \"vs.1.1\\nmov oPos, v0\"\ninputs.t0 = [1]\nexpect.r0 = [1]\n",
        "with a vertex shader there are `v0` to `v15`",
    );
    refused(
        &format!("{MOV}expect.r0 = [1]\ntextures.0.target = \"x\"\n"),
        "a case has no render targets",
    );
}

#[test]
fn listings_from_files_and_empty_ones() {
    passes(
        "vs = \"\"\nps_file = \"mov.psh\"\ninputs.v0 = [0.5, 0.25, 1, 0]\nexpect.r0 = [0.5, 0.25, 1, 0]\n",
    );
}

#[test]
fn inputs_that_are_missing() {
    // As if a vertex shader had not written them: diffuse 1, specular 0. Coordinates (0, 0, 0, 1).
    passes(
        "ps = \"ps.1.4\\ntexcrd r0.rgb, t0.xyw\\ntexcrd r1.rgb, t1\\nmov r2, v0\\nmov r3, v1\\nmov r0.a, v0.a\"\n\
         inputs.t1 = [5]\n[expect]\nr0 = [0, 0, 1, 1]\nr1 = [5, 0, 0]\nr2 = [1, 1, 1, 1]\nr3 = [0, 0, 0, 0]\n",
    );
    passes("ps = \"ps.1.1\\nmov r0, v0\"\ninputs.v0 = 0.5\nexpect.r0 = [0.5, 0.5, 0.5, 0.5]\n");
}

#[test]
fn invocations_are_laid_over_the_case() {
    let case = loaded(
        "ps = \"ps.1.1\\nmad r0, v0, c0, c1\"\ntol = 0.25\n\
         ps_constants = { c0 = [0.5, 0.5, 0.5, 0.5], c1 = [0, 0, 0, 0.25] }\nexpect.killed = false\n\
         [[invocation]]\nname = \"own constant\"\nps_constants.c0 = [1, 1, 1, 1]\nexpect.r0 = [1, 1, 1, 1.25]\n\
         [[invocation]]\ninputs.v0 = [0, 0, 0, 0]\ntol = 0\nexpect.r0 = [0, 0, 0, 0.25]\n",
    );
    assert_eq!(case.check(), [Verdict::Passed, Verdict::Passed]);
    let [first, second] = case.invocations.as_slice() else {
        panic!("two invocations");
    };
    assert_eq!(first.name.as_deref(), Some("own constant"));
    assert_eq!((first.line, second.line), (5, 9));
    assert_eq!((first.tolerance, second.tolerance), (0.25, 0.0));
    assert_eq!(second.expect.killed, Some(false));
}

#[test]
fn a_wrong_number_has_the_instruction_that_wrote_it_last() {
    let wrong = wrong(
        "ps = \"\"\"\nps.1.1\nmov r0, v0\nmov r0.rgb, c0\n+mov r0.a, c1\n\"\"\"\n\
         ps_constants = { c0 = [0.5], c1 = [0, 0, 0, 0.25] }\nexpect.r0 = [0.5, 1, 0, 0.75]\n",
    );
    let told: Vec<_> = wrong
        .iter()
        .map(|entry| match entry {
            Wrong::Number {
                component,
                expected,
                actual,
                difference,
                origin,
                ..
            } => {
                let origin = origin.as_ref().unwrap();
                let text = origin.text.as_str();
                (
                    *component,
                    *expected,
                    *actual,
                    *difference,
                    origin.line,
                    text,
                )
            }
            Wrong::Killed { .. } => panic!("{entry:?}"),
        })
        .collect();
    assert_eq!(
        told,
        [
            (1, 1.0, 0.0, 1.0, 3, "mov r0.rgb, c0"),
            (3, 0.75, 0.25, 0.5, 4, "+mov r0.a, c1"),
        ]
    );
}

#[test]
fn a_discarded_pixel_has_the_instruction_that_discarded_it() {
    let text = "ps = \"ps.1.1\\ntexkill t0\\nmov r0, v0\"\ninputs.t0 = [-1]\n";
    match wrong(&format!("{text}expect.killed = false\n")).as_slice() {
        [
            Wrong::Killed {
                expected: false,
                origin: Some(origin),
            },
        ] => {
            assert_eq!((origin.line, origin.text.as_str()), (2, "texkill t0"));
        }
        other => panic!("{other:?}"),
    }
    passes(&format!(
        "{text}expect.killed = true\nclear = [0.5, 0, 0, 1]\nexpect.frame = [0.5, 0, 0, 1]\n"
    ));
}

#[test]
fn a_wrong_frame_has_what_became_of_the_pixel() {
    let how = |keys: &str| {
        let text = format!("{MOV}inputs.v0 = [0.5, 0.5, 0.5, 0.25]\nexpect.frame = [0.75]\n{keys}");
        match wrong(&text).remove(0) {
            Wrong::Number { origin, .. } => origin.map(|origin| origin.how).unwrap_or_default(),
            other => panic!("{other:?}"),
        }
    };
    let behind = |what: &str| format!("{what}; r0 was written by");
    assert_eq!(how(""), "written by");
    let alpha = "state = { alpha_test = true, alpha_func = \"greater\", alpha_ref = 128 }";
    assert_eq!(how(alpha), behind("the alpha test rejected the pixel"));
    let depth = "state = { z_func = \"never\" }";
    assert_eq!(how(depth), behind("the depth test rejected the pixel"));
    let fog = "state = { fog = { color = [0, 0, 1] } }\ninputs.v1 = [0, 0, 0, 0.5]";
    assert_eq!(how(fog), behind("after fog"));
    let killed =
        "ps = \"ps.1.1\\ntexkill t0\\nmov r0, v0\"\ninputs.t0 = [-1]\nexpect.frame = [1]\n";
    match wrong(killed).remove(0) {
        Wrong::Number {
            origin: Some(origin),
            ..
        } => {
            assert_eq!((origin.how.as_str(), origin.line), ("discarded by", 2));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_mistake_in_an_expectation_is_told_alone() {
    for (keys, said) in [
        ("expect.r0 = [1, 2, 3, 4, 5]", "`r0` has 5 numbers"),
        ("expect.r0 = []", "`r0` has 0 numbers"),
        ("expekt.r0 = [1]", "did you mean `expect`?"),
        ("expect.r9 = [1]", "[expect] has no `r9`"),
        (
            "expect.r0 = \"1\"",
            "`r0` must be a number, or a list of one to 4, not a text",
        ),
        (
            "expect.frame = true",
            "`frame` must be a number, or a list of one to 4",
        ),
    ] {
        let error = load("case.toml", &format!("{MOV}{keys}\n")).expect_err("a problem");
        assert!(error.contains(said), "{error}");
        assert_eq!(error.matches("error[").count(), 1, "{error}");
    }
    refused(&format!("{MOV}[expect]\n"), "needs an `expect`");
    // A number without a list is all four.
    passes(&format!("{MOV}inputs.v0 = 0.5\nexpect.r0 = 0.5\n"));
    for tol in ["inf", "nan"] {
        refused(
            &format!("{MOV}expect.r0 = 1\ntol = {tol}\n"),
            "a tolerance is 0 or more, and finite",
        );
    }
    refused(
        &format!("{MOV}expect.r0 = 1\nsamplers.0.max_mip_level = -1\n"),
        "`max_mip_level` is -1; it must be 0 to 4294967295",
    );
    let error = load("a.vsh", "; a listing\n\nvs_1_1\nmov oPos, v0\n").expect_err("no case");
    assert!(
        error.contains("a.vsh:3:1: error[F1]: this looks like a listing"),
        "{error}"
    );
    assert_eq!(error.matches("error[").count(), 1, "{error}");
}

#[test]
fn outputs_of_the_vertex_shader_have_their_instruction_too() {
    let wrong = wrong(
        "vs = \"vs.1.1\\nmov oPos, v0\\nmov oFog.x, v0\"\nps = \"ps.1.1\\nmov r0, v0\"\ninputs.v0 = [0.5, 0, 4, 8]\n\
         expect = { oFog = 0.25, depth = 0.25, oT0 = [1], frame = [0, 1] }\n",
    );
    let lines: Vec<_> = wrong
        .iter()
        .map(|entry| match entry {
            Wrong::Number {
                quantity, origin, ..
            } => (
                quantity.to_string(),
                origin.as_ref().map(|origin| origin.line),
            ),
            Wrong::Killed { .. } => panic!("{entry:?}"),
        })
        .collect();
    let expected = [
        ("oFog", Some(3)),
        ("depth", Some(2)),
        ("oT0", None),
        ("frame", Some(2)),
    ];
    // The order is that of the file.
    assert_eq!(lines, expected.map(|(name, line)| (name.to_owned(), line)));
}

#[test]
fn tolerance_is_absolute_and_inclusive() {
    let text = format!("{MOV}inputs.v0 = [0.5, 0.5, 0.5, 0.5]\nexpect.r0 = [0.625]\n");
    // 0.625 - 0.5 = 0.125
    passes(&format!("tol = 0.125\n{text}"));
    assert_eq!(wrong(&format!("tol = 0.124\n{text}")).len(), 1);
    assert_eq!(wrong(&text).len(), 1);
    // 5e-7 is within the default, 2e-6 is not.
    passes(&format!(
        "{MOV}inputs.v0 = [0.5]\nexpect.r0 = [0.5000005]\n"
    ));
    assert_eq!(
        wrong(&format!("{MOV}inputs.v0 = [0.5]\nexpect.r0 = [0.500002]\n")).len(),
        1
    );
}

#[test]
fn special_numbers_agree_only_with_themselves() {
    let text = "vs = \"vs.1.1\\nmov oPos, v0\"\ninputs.v0 = [inf, nan, -inf, 0]\ntol = 1e30\n";
    passes(&format!("{text}expect.oPos = [inf, nan, -inf, -0.0]\n"));
    assert_eq!(
        wrong(&format!("{text}expect.oPos = [nan, inf, inf, nan]\n")).len(),
        4
    );
}

#[test]
fn another_accepted_result_passes_apart() {
    let text = format!(
        "{MOV}inputs.v0 = [0.5, 0.25, 0, 1]\nexpect = {{ r0 = [1], killed = false }}\naccept = [{{ r0 = [2] }}, {{ r0 = [0.5] }}]\n"
    );
    assert_eq!(loaded(&text).check(), [Verdict::Accepted(1)]);
    // What a result does not speak of must be as expected.
    let text = text.replace("killed = false", "killed = true");
    assert!(matches!(loaded(&text).check()[0], Verdict::Failed(_)));
}

#[test]
fn a_frame_agrees_as_computed_or_as_eight_bits_hold_it() {
    let text = format!("{MOV}inputs.v0 = [0.35, 0.5, 0, 1]\n");
    passes(&format!("{text}expect.frame = [0.35, 0.5, 0, 1]\n"));
    // 0.35·255 = 89.25, so 89; 0.5·255 = 127.5, the even one of 127 and 128
    passes(&format!(
        "{text}expect.frame = [0.34901961, 0.50196078, 0, 1]\n"
    ));
    assert_eq!(wrong(&format!("{text}expect.frame = [0.349]\n")).len(), 1);
}

#[test]
fn fog_without_a_vertex_shader_is_the_alpha_of_the_specular_colour() {
    // 0.25·1 + 0.75·0 in red, 0.75·1 in blue
    passes(&format!(
        "{MOV}state.fog = {{ color = [0, 0, 1] }}\ninputs = {{ v0 = [1, 0, 0, 1], v1 = [0, 0, 0, 0.25] }}\n\
         expect.frame = [0.25, 0, 0.75, 1]\n"
    ));
}

#[test]
fn a_texture_from_a_file_must_be_what_the_case_says() {
    let mut png = std::io::Cursor::new(Vec::new());
    let picture = image::RgbaImage::from_pixel(2, 1, image::Rgba([255, 0, 51, 255]));
    picture.write_to(&mut png, image::ImageFormat::Png).unwrap();
    let files: BTreeMap<String, Vec<u8>> = [("a.png".to_owned(), png.into_inner())].into();
    let load = |keys: &str| {
        let text = format!(
            "ps = \"ps.1.1\\ntex t0\\nmov r0, t0\"\nexpect.r0 = [1, 0, 0.2, 1]\ntextures.0 = {{ file = \"a.png\"{keys} }}\n"
        );
        Case::load(
            "case.toml",
            text.as_bytes(),
            &files,
            &LoadOptions::default(),
        )
        .map(|case| case.check())
        .map_err(|error| error.to_string())
    };
    assert_eq!(load(""), Ok(vec![Verdict::Passed]));
    assert_eq!(
        load(", kind = \"2d\", size = [2, 1]"),
        Ok(vec![Verdict::Passed])
    );
    assert!(
        load(", kind = \"cube\"")
            .unwrap_err()
            .contains("the kind of the file is 2d")
    );
    assert!(
        load(", size = [2, 2]")
            .unwrap_err()
            .contains("the size of the file is")
    );
    assert!(
        load(", format = \"v8u8\"")
            .unwrap_err()
            .contains("the format of the file is")
    );
}
