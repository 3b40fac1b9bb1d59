//! What is asked for, on small listings. The expected places are counted in the texts by hand.

use super::*;

/// Line 0 has the version, 1 a `def`, 2 to 6 instructions.
const LISTING: &str = "ps.1.1\ndef c0, 1, 0.5, 0, 1\ntex t0\nmov r0.rgb, t0\n+mov r0.a, v0\nmul_sat r1, r0, c0\nadd r0, r1, r0 ; sum\n";

fn places(found: &Value) -> Vec<String> {
    found
        .as_array()
        .unwrap()
        .iter()
        .map(|one| range(&one["range"]))
        .collect()
}

#[test]
fn diagnostics_follow_the_typing() {
    let mut client = Client::with("ps.1.1\n1rp r0, v0, v1, c0\nmov r9, v0\n");
    let found = client.diagnostics(DOCUMENT);
    // `1rp` is no instruction (P8); ps.1.1 has r0 and r1 (O1).
    assert_eq!(told(&found), ["P8 1 1:0-1:3", "O1 1 2:4-2:6"]);
    assert_eq!(found[0]["source"], "texcrd");
    let message = found[0]["message"].as_str().unwrap();
    for part in ["`1rp` is no instruction", "\nhelp: ", "\nrule: "] {
        assert!(message.contains(part), "{message}");
    }
    let one = |line: u32, from: u32, to: u32, text: &str| {
        let at = |character| json!({ "line": line, "character": character });
        json!({ "range": { "start": at(from), "end": at(to) }, "text": text })
    };
    client.change(DOCUMENT, json!([one(1, 0, 3, "lrp"), one(2, 5, 6, "0")]));
    assert_eq!(client.diagnostics(DOCUMENT), Vec::<Value>::new());
    client.change(
        DOCUMENT,
        json!([{ "text": "ps.1.1\r\nmov r9, v0\r\nmov r0, v0\r\n" }]),
    );
    assert_eq!(told(&client.diagnostics(DOCUMENT)), ["O1 1 1:4-1:6"]);
    client.notify(
        "textDocument/didClose",
        json!({ "textDocument": { "uri": DOCUMENT } }),
    );
    client.versions.clear();
    assert!(client.diagnostics(DOCUMENT).is_empty());
    assert!(client.leave());
}

#[test]
fn other_languages_are_left_alone_unless_shaders_are_in_them() {
    let mut client = Client::new();
    for (uri, language, text, count) in [
        (
            "file:///a.txt",
            "plaintext",
            "A text about mov and r9.\n",
            0,
        ),
        (
            "file:///b.vsh",
            "glsl",
            "void main() { gl_Position = x; }\n",
            0,
        ),
        ("file:///c.rs", "rust", "fn main() {}\n", 0),
        (
            "file:///d.txt",
            "plaintext",
            "ps.1.1\nmov r9, v0\nmov r0, v0\n",
            1,
        ),
        (
            "file:///e.cpp",
            "cpp",
            "const char* s =\n  \"ps.1.1\\n\"\n  \"mov r9, v0\\n\" \"mov r0, v0\\n\";\n",
            1,
        ),
        (
            "file:///f.fx",
            "",
            "technique T { pass P { PixelShader = asm {\nps.1.1\nmov r9, v0\nmov r0, v0\n}; } }\n",
            1,
        ),
    ] {
        client.open(uri, language, text);
        let found = client.diagnostics(uri);
        assert_eq!(found.len(), count, "{uri}: {found:?}");
    }
    assert_eq!(
        client.ask(
            "textDocument/documentSymbol",
            json!({ "textDocument": { "uri": "file:///c.rs" } })
        ),
        json!([])
    );
    assert!(client.leave());
}

#[test]
fn diagnostics_in_strings_and_effects_stand_where_they_are_written() {
    let mut client = Client::new();
    let text = "const char* s =\n  \"ps.1.1\\n\"\n  \"mov r9, v0\\n\" \"mov r0, v0\\n\";\n";
    client.open("file:///e.cpp", "cpp", text);
    assert_eq!(told(&client.diagnostics("file:///e.cpp")), ["O1 1 2:7-2:9"]);
    let text = "#define DST r9\ntechnique T { pass P { PixelShader = asm {\nps.1.1\nmov DST, v0\nmov r0, v0\n}; } }\n";
    client.open("file:///f.fx", "", text);
    let found = client.diagnostics("file:///f.fx");
    assert_eq!(told(&found), ["O1 1 3:4-3:7"]);
    let related = &found[0]["relatedInformation"][0];
    assert_eq!(range(&related["location"]["range"]), "0:12-0:14");
    assert!(related["message"].as_str().unwrap().contains("DST"));
    assert!(client.leave());
}

#[test]
fn included_files_are_those_that_are_open_before_those_on_disk() {
    let text = b"#define FROM_DISK v1\n; \xe4\xe4\nmov r0, r1 ; never written\n";
    let folder = Folder::new(&[("disk.inc", text)]);
    let mut client = Client::new();
    client.document = folder.uri("a.psh");
    let document = &client.document.clone();
    client.open(
        document,
        "d3d8asm",
        "ps.1.1\n#include \"disk.inc\"\nmov r0, FROM_DISK\n",
    );
    // What is wrong in the file is told there, bytes of other encodings counted as one character.
    let file = &folder.uri("disk.inc");
    assert_eq!(told(&client.diagnostics(file)), ["I1 1 2:8-2:10"]);
    assert!(client.diagnostics(document).is_empty());
    client.open(file, "d3d8asm", "#define FROM_DISK r7\n");
    // The file is open now, and has another fault; it is no shader by itself.
    let found = client.diagnostics(document);
    assert_eq!(told(&found), ["O1 1 2:8-2:17"]);
    let related = &found[0]["relatedInformation"][0];
    assert_eq!(related["location"]["uri"], *file);
    assert_eq!(range(&related["location"]["range"]), "0:18-0:20");
    assert!(client.diagnostics(file).is_empty());
    client.change(file, json!([{ "text": "#define FROM_DISK v0\n" }]));
    // The document has not changed, what it includes has.
    assert!(client.diagnostics(document).is_empty());
    let include = client.at("definition", 1, 12);
    assert_eq!(include[0]["uri"], *file);
    let defined = client.at("definition", 2, 10);
    assert_eq!(
        (&defined[0]["uri"], range(&defined[0]["range"])),
        (&json!(file), "0:8-0:17".to_string())
    );
    client.change(
        document,
        json!([{ "text": "ps.1.1\n#include \"none.inc\"\nmov r0, v0\n" }]),
    );
    assert_eq!(told(&client.diagnostics(document)).len(), 1);
    assert!(client.leave());
}

#[test]
fn hovers_say_what_stands_there() {
    let mut client = Client::with(LISTING);
    let mut hover = |line, character| {
        let hover = client.at("hover", line, character);
        let text = hover["contents"]["value"]
            .as_str()
            .unwrap_or_default()
            .to_string();
        (
            text,
            if hover.is_null() {
                String::new()
            } else {
                range(&hover["range"])
            },
        )
    };
    let (version, at) = hover(0, 3);
    assert!(
        version.contains("ps.1.1") && at == "0:0-0:6",
        "{version} {at}"
    );
    let (mul, at) = hover(5, 1);
    assert!(mul.contains("s0 \\* s1") && at == "5:0-5:7", "{mul} {at}");
    let (sat, at) = hover(5, 5);
    assert!(sat.contains("_sat") && at == "5:3-5:7", "{sat} {at}");
    // r0 was written by both halves of the pair, c0 by its def.
    let (r0, at) = hover(5, 13);
    assert!(
        r0.contains("line 4: `mov r0.rgb, t0`") && r0.contains("line 5: `+mov r0.a, v0`"),
        "{r0}"
    );
    assert_eq!(at, "5:12-5:14");
    let (c0, _) = hover(5, 17);
    assert!(c0.contains("line 2: `def c0, 1, 0.5, 0, 1`"), "{c0}");
    // What is written is told with who reads it.
    let (r1, _) = hover(5, 8);
    assert!(r1.contains("line 7: `add r0, r1, r0`"), "{r1}");
    // Comments say nothing, nor does the end of the text.
    assert_eq!(hover(6, 18).0, "");
    assert_eq!(hover(99, 0).0, "");
    assert!(client.leave());
}

#[test]
fn definitions_are_what_gives_the_value() {
    let mut client = Client::with(LISTING);
    assert_eq!(places(&client.at("definition", 5, 17)), ["1:4-1:6"]);
    // The read of all of r0 has two writes, the last one first.
    assert_eq!(
        places(&client.at("definition", 5, 13)),
        ["4:5-4:9", "3:4-3:10"]
    );
    assert_eq!(places(&client.at("definition", 3, 12)), ["2:4-2:6"]);
    assert!(client.at("definition", 2, 1).is_null());
    assert_eq!(places(&client.at("references", 6, 12)).len(), 5);
    assert!(client.leave());
}

#[test]
fn highlights_tell_reads_from_writes() {
    let mut client = Client::with(LISTING);
    let found = client.at("documentHighlight", 5, 13);
    let shown: Vec<String> = (found.as_array().unwrap().iter())
        .map(|one| format!("{} {}", one["kind"], range(&one["range"])))
        .collect();
    // 3 writes, 2 reads.
    assert_eq!(
        shown,
        [
            "3 3:4-3:10",
            "3 4:5-4:9",
            "2 5:12-5:14",
            "3 6:4-6:6",
            "2 6:12-6:14"
        ]
    );
    assert!(client.leave());
}

#[test]
fn what_macros_do_stands_where_they_are_used() {
    let mut client = Client::with(
        "ps.1.1\n#define COPY(a) mov r0, a\n#define IN v0\nCOPY(IN)\nadd r0, r0, IN_bias\n",
    );
    let found = client.at("documentHighlight", 4, 8);
    let shown: Vec<String> = (found.as_array().unwrap().iter())
        .map(|one| format!("{} {}", one["kind"], range(&one["range"])))
        .collect();
    assert_eq!(shown, ["3 3:0-3:8", "3 4:4-4:6", "2 4:8-4:10"]);
    let hover = client.at("hover", 4, 13);
    let text = hover["contents"]["value"].as_str().unwrap();
    assert!(
        text.contains("#define IN v0") && text.contains("line 3"),
        "{text}"
    );
    assert_eq!(range(&hover["range"]), "4:12-4:14");
    assert_eq!(places(&client.at("definition", 3, 2)), ["1:8-1:12"]);
    assert_eq!(places(&client.at("definition", 3, 6)), ["2:8-2:10"]);
    assert!(client.leave());
}

#[test]
fn symbols_and_folds_are_the_parts_of_a_file() {
    let text = "ps.1.4 ; one\ndef c0, 1, 0, 0, 1\ntexld r0, t0\nmov r1, c0\nphase\nmov r0, r0\n; a\n; b\n#ifdef X\nnop\n#endif\n";
    let mut client = Client::with(text);
    let symbols = client.of("documentSymbol");
    assert_eq!(symbols.as_array().unwrap().len(), 1);
    let shader = &symbols[0];
    assert_eq!(
        (&shader["name"], range(&shader["selectionRange"])),
        (&json!("ps.1.4"), "0:0-0:6".into())
    );
    let names: Vec<&str> = (shader["children"].as_array().unwrap().iter())
        .map(|c| c["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["c0", "first phase", "second phase"]);
    assert_eq!(shader["children"][0]["detail"], "1, 0, 0, 1");
    assert_eq!(range(&shader["children"][1]["range"]), "2:0-3:10");
    let folds = client.of("foldingRange");
    let shown: Vec<String> = (folds.as_array().unwrap().iter())
        .map(|f| {
            format!(
                "{} {}-{}",
                f["kind"].as_str().unwrap(),
                f["startLine"],
                f["endLine"]
            )
        })
        .collect();
    assert_eq!(
        shown,
        ["region 2-3", "region 4-5", "region 8-10", "comment 6-7"]
    );
    let effect = "technique A\n{ pass B\n{\nPixelShader = asm {\nps.1.1\nmov r0, v0\n};\n}\n}\n";
    client.open("file:///e.fx", "", effect);
    let params = json!({ "textDocument": { "uri": "file:///e.fx" } });
    let symbols = client.ask("textDocument/documentSymbol", params.clone());
    assert_eq!(
        (&symbols[0]["name"], &symbols[0]["detail"]),
        (&json!("A/B/PixelShader"), &json!("ps.1.1"))
    );
    let folds = client.ask("textDocument/foldingRange", params);
    assert_eq!(
        (&folds[0]["startLine"], &folds[0]["endLine"]),
        (&json!(3), &json!(5))
    );
    assert!(client.leave());
}

#[test]
fn hints_count_slots() {
    let text =
        "vs.1.1\ndcl_position v0\nm4x4 oPos, v0, c0\n#define F frc r0.xy, v0\nF\nmov oD0, r0.x\n";
    let labels = |client: &mut Client| -> Vec<String> {
        let range = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 99, "character": 0 } });
        let params = json!({ "textDocument": { "uri": DOCUMENT }, "range": range });
        let found = client.ask("textDocument/inlayHint", params);
        let one = |hint: &Value| {
            let position = &hint["position"];
            format!(
                "{}:{} {}",
                position["line"],
                position["character"],
                hint["label"].as_str().unwrap()
            )
        };
        found.as_array().unwrap().iter().map(one).collect()
    };
    let mut client = Client::with(text);
    // m4x4 takes four slots, frc three, mov one.
    assert_eq!(
        labels(&mut client),
        ["0:6 8/128 slots", "2:17 4 slots", "4:1 3 slots"]
    );
    for (which, expected) in [
        (
            "running",
            vec![
                "0:6 8/128 slots",
                "2:17 4 slots, 4/128",
                "4:1 3 slots, 7/128",
                "5:13 8/128",
            ],
        ),
        ("off", vec![]),
    ] {
        client.notify(
            "workspace/didChangeConfiguration",
            json!({ "settings": { "inlayHints": which } }),
        );
        assert_eq!(labels(&mut client), expected);
    }
    let mut client = Client::with(
        "ps.1.4\ntexld r0, t0\ntexcrd r1.rgb, t1\nmov r2, r0\nphase\nmul r0, r0, r1\n+mov r0.a, r2.a\n",
    );
    assert_eq!(
        labels(&mut client),
        [
            "0:6 2/6 texture, 1/8 arithmetic",
            "4:5 0/6 texture, 1/8 arithmetic"
        ]
    );
}

#[test]
fn actions_repair() {
    let text = "ps.1.1\n1rp r0, v0, v1, c0\nmov rl, v0\nmov r9, v0\n";
    let mut client = Client::with(text);
    let actions = |client: &mut Client, line: u32, only: Value| {
        let at = json!({ "line": line, "character": 0 });
        let end = json!({ "line": line, "character": 20 });
        let params = json!({
            "textDocument": { "uri": DOCUMENT },
            "range": { "start": at, "end": end },
            "context": { "diagnostics": [], "only": only },
        });
        let found = client.ask("textDocument/codeAction", params);
        found.as_array().unwrap().clone()
    };
    let quick = actions(&mut client, 1, json!(["quickfix"]));
    assert_eq!(quick.len(), 1);
    assert_eq!(
        (&quick[0]["title"], &quick[0]["isPreferred"]),
        (&json!("Replace `1rp` by `lrp`"), &json!(true))
    );
    assert_eq!(quick[0]["diagnostics"][0]["code"], "P8");
    let change = &quick[0]["edit"]["documentChanges"][0];
    assert_eq!(
        change["textDocument"],
        json!({ "uri": DOCUMENT, "version": 1 })
    );
    assert!(applied(text, &change["edits"]).starts_with("ps.1.1\nlrp r0, "));
    // r9 has no repair.
    assert!(actions(&mut client, 3, json!(["quickfix"])).is_empty());
    for only in [
        json!(["source.fixAll"]),
        json!(["source"]),
        json!(["source.fixAll.texcrd"]),
    ] {
        let all = actions(&mut client, 3, only);
        assert_eq!(all.len(), 1);
        let fixed = applied(text, &all[0]["edit"]["documentChanges"][0]["edits"]);
        assert_eq!(
            fixed,
            "ps.1.1\nlrp r0, v0, v1, c0\nmov r1, v0\nmov r9, v0\n"
        );
    }
    assert!(actions(&mut client, 1, json!(["refactor"])).is_empty());
    assert_eq!(actions(&mut client, 1, Value::Null).len(), 2);
    assert!(client.leave());
}

#[test]
fn clients_of_few_gifts_get_what_they_understand() {
    let mut client = Client::like(Value::Null, json!({}));
    client.open(DOCUMENT, "d3d8asm", LISTING);
    let params = json!({
        "textDocument": { "uri": DOCUMENT },
        "range": { "start": { "line": 0, "character": 0 }, "end": { "line": 9, "character": 0 } },
        "context": { "diagnostics": [] },
    });
    assert_eq!(client.ask("textDocument/codeAction", params), json!([]));
    assert_eq!(client.at("hover", 5, 1)["contents"]["kind"], "plaintext");
    let symbols = client.of("documentSymbol");
    assert_eq!(symbols[1]["containerName"], symbols[0]["name"]);
    assert_eq!(range(&symbols[1]["location"]["range"]), "1:0-1:20");
    assert!(client.leave());
}

#[test]
fn formatting_changes_lines_that_need_it() {
    let text = "ps.1.1\nmov   r0,v0\nadd r0, r0, v0\nmul r0 ,r0,v0\n";
    let mut client = Client::with(text);
    let edits = client.of("formatting");
    assert_eq!(
        applied(text, &edits),
        "ps.1.1\nmov r0, v0\nadd r0, r0, v0\nmul r0, r0, v0\n"
    );
    let range =
        json!({ "start": { "line": 3, "character": 0 }, "end": { "line": 3, "character": 5 } });
    let params = json!({ "textDocument": { "uri": DOCUMENT }, "range": range, "options": {} });
    let edits = client.ask("textDocument/rangeFormatting", params);
    assert_eq!(
        applied(text, &edits),
        "ps.1.1\nmov   r0,v0\nadd r0, r0, v0\nmul r0, r0, v0\n"
    );
    client.open(
        "file:///x.cpp",
        "cpp",
        "const char* s = \"ps.1.1\\nmov   r0,v0\";\n",
    );
    let params = json!({ "textDocument": { "uri": "file:///x.cpp" }, "options": {} });
    assert_eq!(client.ask("textDocument/formatting", params), json!([]));
    assert!(client.leave());
}
