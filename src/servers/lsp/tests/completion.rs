//! Completion and signatures: what the tables of the versions allow, and nothing else. `|` is where the person types.

use super::*;

/// A client at the mark of a text, and the text without it.
fn typed(text: &str) -> (Client, String, u32, u32) {
    let at = text.find('|').unwrap();
    let before = &text[..at];
    let line = before.matches('\n').count() as u32;
    let column = before.len() - before.rfind('\n').map_or(0, |at| at + 1);
    let text = text.replacen('|', "", 1);
    (Client::with(&text), text, line, column as u32)
}

fn items(text: &str) -> Vec<Value> {
    let (mut client, _, line, column) = typed(text);
    let found = client.at("completion", line, column);
    assert!(client.leave());
    found["items"].as_array().unwrap().clone()
}

fn labels(text: &str) -> Vec<String> {
    items(text)
        .iter()
        .map(|item| item["label"].as_str().unwrap().to_string())
        .collect()
}

/// The text after an item has been taken.
fn taken(text: &str, label: &str) -> String {
    let all = items(text);
    let item = all.iter().find(|item| item["label"] == label).unwrap();
    applied(&text.replacen('|', "", 1), &json!([item["textEdit"]]))
}

#[test]
fn an_empty_file_begins_with_a_version() {
    let versions = [
        "vs.1.0", "vs.1.1", "ps.1.0", "ps.1.1", "ps.1.2", "ps.1.3", "ps.1.4",
    ];
    assert_eq!(labels("|"), versions);
    assert_eq!(labels("; a comment\n  p|"), versions);
    assert_eq!(taken("; a comment\nps.1|", "ps.1.4"), "; a comment\nps.1.4");
    assert!(labels("; a |").is_empty());
    assert!(labels("mov r0, v0\n|").is_empty());
}

#[test]
fn instructions_are_those_of_the_version_where_they_may_stand() {
    let first = labels("ps.1.1\n|");
    for has in ["tex", "texbem", "mov", "def", "lrp"] {
        assert!(first.contains(&has.to_string()), "{has}");
    }
    // texld and phase are of ps.1.4, cmp of ps.1.2, m4x4 of vertex shaders.
    for has_not in ["texld", "phase", "cmp", "m4x4", "dcl_position"] {
        assert!(!first.contains(&has_not.to_string()), "{has_not}");
    }
    // Texture instructions and declarations come first.
    let later = labels("ps.1.1\ntex t0\nmov r0, t0\n|\n");
    assert!(later.contains(&"mad".to_string()));
    assert!(!later.contains(&"tex".to_string()) && !later.contains(&"def".to_string()));
    // In ps.1.4 a second phase has them again.
    let second = labels("ps.1.4\ntexld r0, t0\nmov r1, r0\nphase\n|\n");
    assert!(second.contains(&"texld".to_string()) && !second.contains(&"phase".to_string()));
    // A pair has no dp4.
    let pair = labels("ps.1.4\nmov r0.rgb, c0\n+ |");
    assert!(pair.contains(&"mov".to_string()) && !pair.contains(&"dp4".to_string()));
    assert!(labels("vs.1.1\n|").contains(&"dcl_position".to_string()));
}

#[test]
fn instructions_bring_places_for_their_operands() {
    assert_eq!(
        taken("ps.1.1\nma|", "mad"),
        "ps.1.1\nmad ${1:d}, ${2:s0}, ${3:s1}, ${4:s2}"
    );
    // Not where operands stand already.
    assert_eq!(
        taken("ps.1.1\nad| r0, v0, v1", "add"),
        "ps.1.1\nadd r0, v0, v1"
    );
    assert_eq!(
        taken("vs.1.1\ndcl_n|", "dcl_normal"),
        "vs.1.1\ndcl_normal ${1:v3}"
    );
}

#[test]
fn modifiers_are_those_of_the_version() {
    // ps.1.1 has _x2, _x4, _d2 and _sat; ps.1.4 has _x8, _d4 and _d8 too.
    assert_eq!(
        labels("ps.1.1\nmul_| r0, v0, v1"),
        ["_x2", "_x4", "_d2", "_sat"]
    );
    assert_eq!(
        labels("ps.1.4\nmul_|"),
        ["_x2", "_x4", "_x8", "_d2", "_d4", "_d8", "_sat"]
    );
    assert_eq!(labels("ps.1.4\nmul_x2_|"), ["_sat"]);
    assert!(labels("vs.1.1\nmul_|").is_empty() && labels("ps.1.1\ntex_|").is_empty());
    assert_eq!(
        taken("ps.1.1\nmul_s| r0, v0, v1", "_sat"),
        "ps.1.1\nmul_sat r0, v0, v1"
    );
    assert_eq!(labels("ps.1.1\nmov r0, v0_|"), ["_bias", "_bx2"]);
    assert_eq!(labels("ps.1.4\nmov r0, v0_|"), ["_bias", "_bx2", "_x2"]);
    assert_eq!(labels("ps.1.4\ntexld r0, t0_|"), ["_dz", "_dw"]);
    assert_eq!(
        taken("ps.1.1\nmov r0, -v0_b|", "_bx2"),
        "ps.1.1\nmov r0, -v0_bx2"
    );
}

#[test]
fn registers_fit_the_operand() {
    // Arithmetic of ps.1.1 writes r# and t#, and reads v# and c# too.
    assert_eq!(
        labels("ps.1.1\nmov |"),
        ["r0", "r1", "t0", "t1", "t2", "t3"]
    );
    let sources = labels("ps.1.1\nmov r0, |");
    assert_eq!(sources.len(), 2 + 2 + 8 + 4);
    assert_eq!(labels("ps.1.1\ntex |"), ["t0", "t1", "t2", "t3"]);
    assert_eq!(
        labels("ps.1.4\ntexcrd |"),
        ["r0", "r1", "r2", "r3", "r4", "r5"]
    );
    assert_eq!(
        labels("ps.1.4\ntexcrd r0.rgb, |"),
        ["t0", "t1", "t2", "t3", "t4", "t5"]
    );
    // Colours cannot be read in the first phase.
    let first = labels("ps.1.4\nmov r0, |\nphase\nmov r0, v0\n");
    assert!(!first.contains(&"v0".to_string()) && first.contains(&"c0".to_string()));
    let outputs = labels("vs.1.1\nmov |");
    for has in ["oPos", "oFog", "oD1", "oT7", "a0.x", "r11"] {
        assert!(outputs.contains(&has.to_string()), "{has}");
    }
    assert!(!outputs.contains(&"v0".to_string()));
    assert!(!labels("vs.1.0\nmov |").contains(&"a0.x".to_string()));
    assert!(labels("vs.1.1\nmov oPos, |").contains(&"c[a0.x]".to_string()));
    assert_eq!(labels("ps.1.1\ndef |").len(), 8);
    assert_eq!(labels("vs.1.1\ndcl_position |").len(), 16);
    assert_eq!(taken("ps.1.1\nmov r0, 1-v|", "v1"), "ps.1.1\nmov r0, 1-v1");
    // Behind a whole operand nothing stands but a comma.
    assert!(labels("ps.1.1\nmov r0 |").is_empty());
    // Numbers are not offered.
    assert!(labels("ps.1.1\ndef c0, |").is_empty());
}

#[test]
fn masks_and_selectors_are_those_of_the_instruction() {
    assert_eq!(labels("ps.1.1\nmov r0.|, v0"), ["rgb", "a", "rgba"]);
    assert_eq!(labels("ps.1.1\nmov r0, v0.|"), ["a"]);
    assert_eq!(labels("ps.1.1\nmov r0.a, v0.|"), ["b", "a"]);
    assert_eq!(labels("ps.1.4\nmov r0, c0.|"), ["r", "g", "b", "a"]);
    assert_eq!(labels("ps.1.4\ntexld r0, t0.|"), ["xyz", "xyw"]);
    assert_eq!(labels("vs.1.1\nfrc r0.|, v0"), ["y", "xy"]);
    assert_eq!(labels("vs.1.1\nmov a0.|, c0"), ["x"]);
    assert_eq!(
        taken("ps.1.1\nmov r0.r|, v0", "rgb"),
        "ps.1.1\nmov r0.rgb, v0"
    );
}

#[test]
fn directives_and_macros() {
    assert!(labels("ps.1.1\n#|").contains(&"include".to_string()));
    assert_eq!(taken("ps.1.1\n#inc|", "include"), "ps.1.1\n#include");
    let text = "#define FOG v0\n#define F(a) mov r0, a\nps.1.1\n";
    assert_eq!(labels(&format!("{text}#ifdef |")), ["FOG", "F"]);
    let sources = labels(&format!("{text}mov r0, |"));
    assert!(sources.contains(&"FOG".to_string()));
    let folder = Folder::new(&[("names.inc", b"#define SCALE(a) mul r0, r0, a\n")]);
    let mut client = Client::new();
    client.document = folder.uri("a.psh");
    let document = client.document.clone();
    client.open(&document, "d3d8asm", "#include \"names.inc\"\nps.1.1\n");
    let found = client.at("completion", 2, 0);
    let items = found["items"].as_array().unwrap();
    assert!(items.iter().any(|item| item["label"] == "SCALE"));
}

#[test]
fn documentation_comes_when_it_is_asked_for() {
    let (mut client, _, line, column) = typed("ps.1.4\n|");
    let found = client.at("completion", line, column);
    let item = found["items"]
        .as_array()
        .unwrap()
        .iter()
        .find(|i| i["label"] == "lrp")
        .unwrap()
        .clone();
    let resolved = client.ask("completionItem/resolve", item);
    let text = resolved["documentation"]["value"].as_str().unwrap();
    assert!(text.contains("s0 \\* s1 + (1 - s0) \\* s2"), "{text}");
    let nothing = client.ask(
        "completionItem/resolve",
        json!({ "label": "x", "data": { "register": 3 } }),
    );
    assert!(nothing.get("documentation").is_none());
    assert!(client.leave());
}

#[test]
fn effects_and_strings_have_completion_in_their_shaders_only() {
    let mut client = Client::new();
    let effect = "technique T { pass P { PixelShader = asm {\nps.1.1\nmov r0, \n}; } }\n";
    client.open(DOCUMENT, "hlsl", effect);
    assert_eq!(
        client.at("completion", 2, 8)["items"]
            .as_array()
            .unwrap()
            .len(),
        16
    );
    assert_eq!(client.at("completion", 0, 3)["items"], json!([]));
    let source = "const char* s = \"ps.1.1\\n\"\n  \"mov \\n\";\nint mov;\n";
    client.open(DOCUMENT, "cpp", source);
    assert_eq!(
        client.at("completion", 1, 7)["items"]
            .as_array()
            .unwrap()
            .len(),
        6
    );
    assert_eq!(client.at("completion", 2, 8)["items"], json!([]));
    assert!(client.leave());
}

#[test]
fn signatures_say_which_operand_is_typed() {
    let active = |text: &str| {
        let (mut client, _, line, column) = typed(text);
        let found = client.at("signatureHelp", line, column);
        assert!(client.leave());
        (
            found["signatures"][0]["label"].clone(),
            found["activeParameter"].clone(),
        )
    };
    assert_eq!(
        active("ps.1.1\nmad |"),
        (json!("mad d, s0, s1, s2"), json!(0))
    );
    assert_eq!(
        active("ps.1.1\nmad r0, v0, |, c0"),
        (json!("mad d, s0, s1, s2"), json!(2))
    );
    assert_eq!(active("ps.1.1\ntex t0 ; |"), (Value::Null, Value::Null));
    assert_eq!(active("ps.1.1\n|"), (Value::Null, Value::Null));
}
