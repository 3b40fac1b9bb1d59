//! `explain`: pages, suggestions, JSON.

use super::texcrd;

#[test]
fn a_name_has_its_page() {
    let ran = texcrd(&["explain", "LRP"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    // The formula of the instruction list, the number of the token list.
    for part in [
        "lrp  linear interpolation\n",
        "d = s0 * s1 + (1 - s0) * s2\n",
        "0x12\n",
        "ps.1.0 to ps.1.4\n",
    ] {
        assert!(ran.out.contains(part), "{part} in\n{}", ran.out);
    }
    // In a pipe there are no colours, and 80 columns.
    assert!(!ran.out.contains('\u{1b}'));
    assert!(ran.out.lines().all(|line| line.chars().count() <= 80));
}

#[test]
fn several_names_and_one_version() {
    let ran = texcrd(&[
        "explain", "texkill", "mul_x2", "--in", "ps_1_4", "--", "-r0",
    ]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let heads = ["texkill  ", "mul  ", "_x2  ", "r0  ", "-  "];
    let mut rest = ran.out.as_str();
    for head in heads {
        let at = rest.find(head).expect(head);
        rest = &rest[at..];
    }
    // texkill of ps.1.4 looks at registers, that of the others at coordinates alone.
    assert!(ran.out.contains("d.r < 0") && !ran.out.contains("TC[m].u < 0"));
    let ran = texcrd(&["explain", "mul", "--in", "ps.2.0"]);
    assert_eq!(ran.status, 2);
    assert!(ran.err.contains("vs.1.0, vs.1.1, ps.1.0"), "{}", ran.err);
}

#[test]
fn an_unknown_name_brings_what_is_near() {
    let ran = texcrd(&["explain", "lpr", "mov", "qqqqqq"]);
    assert_eq!(ran.status, 1);
    // What is known is told all the same.
    assert!(ran.out.starts_with("mov  "), "{}", ran.out);
    for part in [
        "nothing called `lpr`; did you mean `lrp`?",
        "`qqqqqq`; `texcrd explain` lists",
    ] {
        assert!(ran.err.contains(part), "{part} in\n{}", ran.err);
    }
}

#[test]
fn a_rule_is_told_as_check_tells_it() {
    let ran = texcrd(&["explain", "B3"]);
    assert_eq!(ran.status, 0);
    for part in [
        "d3d8     error\n",
        "Breaks it\n",
        "Keeps it\n",
        "  error  line ",
    ] {
        assert!(ran.out.contains(part), "{part} in\n{}", ran.out);
    }
}

#[test]
fn without_a_name_there_is_a_list() {
    let ran = texcrd(&["explain"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    for name in [
        "texm3x3vspec,",
        "oFog,",
        "_bx2,",
        "ps.1.4\n",
        "M12,",
        "D3DVSD_REG,",
        "models, float, gf3, r200\n",
        "policies, zero-product, rcp-zero, scalar, logp, def\n",
    ] {
        assert!(ran.out.contains(name), "{name} in\n{}", ran.out);
    }
}

#[test]
fn programs_read_json() {
    let ran = texcrd(&["explain", "cmp", "_sat", "--format", "json"]);
    assert_eq!(ran.status, 0);
    let pages: Vec<serde_json::Value> = (ran.out.lines())
        .map(|line| serde_json::from_str(line).expect("one object a line"))
        .collect();
    let [cmp, sat] = &pages[..] else {
        panic!("{}", ran.out);
    };
    assert_eq!(cmp["name"], "cmp");
    assert_eq!(cmp["kind"], "instruction");
    assert_eq!(sat["kind"], "modifier");
    let facts = &cmp["parts"][1]["facts"];
    assert_eq!(facts[1], serde_json::json!(["token", "0x58"]));
}

#[test]
fn models_and_policies_are_told() {
    let ran = texcrd(&["explain", "policies"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    for part in ["zero-product", "when-set", "always", "--policy NAME=VALUE"] {
        assert!(ran.out.contains(part), "{part} in\n{}", ran.out);
    }
    let ran = texcrd(&["explain", "models", "gf3", "rcp-zero", "--format", "json"]);
    assert_eq!((ran.status, ran.err.as_str()), (0, ""));
    let kinds: Vec<String> = (ran.out.lines())
        .map(|line| {
            let page: serde_json::Value = serde_json::from_str(line).expect("an object a line");
            page["kind"].as_str().expect("a text").to_string()
        })
        .collect();
    assert_eq!(kinds, ["model", "model", "policy"]);
}
