//! Documents that are broken, long, or gone.

use super::*;
use std::time::{Duration, Instant};

const METHODS: [&str; 8] = [
    "hover",
    "completion",
    "signatureHelp",
    "definition",
    "references",
    "documentHighlight",
    "documentSymbol",
    "foldingRange",
];

/// Asks everything about a place.
fn ask_all(client: &mut Client, line: u32, character: u32) {
    for method in METHODS {
        client.at(method, line, character);
    }
}

#[test]
fn every_place_of_a_broken_document_can_be_asked_about() {
    for text in [
        "",
        "ps.1.1",
        "\u{feff}ps.1.1\nmov \u{e4}r0, v0",
        "ps.1.1\n#define A(\n#if\n#include\nA(\nmov r0, A(v0\n/* open",
        "vs.1.1\nmov oPos, c[a0.x + \nm4x4\n dcl_ v0\ndef c0, 1,\n+",
        "ps.1.1\rmov r0,v0\r\nmov r0.,_x2 , ; \u{1f600}",
        "asm { ps.1.1 mov r0, v0 } asm {",
        "char* s = \"ps.1.1\\n\" \"mov r0, v0.\\",
        "DWORD a[] = { 0xffff0101, 0x1, 0x0000ffff };",
        "ffff0101 0000ffff",
    ] {
        let mut client = Client::with(text);
        let lines: Vec<&str> = text.split(['\n', '\r']).collect();
        for (line, content) in lines.iter().enumerate() {
            for character in 0..=content.encode_utf16().count() + 1 {
                ask_all(&mut client, line as u32, character as u32);
            }
        }
        ask_all(&mut client, u32::MAX, u32::MAX);
        assert!(client.leave(), "{text}");
    }
}

#[test]
fn a_document_that_is_closed_while_it_is_asked_about_is_no_trouble() {
    let mut client = Client::new();
    let mut stream = Vec::new();
    let document = json!({ "uri": DOCUMENT, "languageId": "d3d8asm", "version": 1, "text": "ps.1.1\nmov r0, v0\n" });
    let id = json!({ "uri": DOCUMENT });
    for message in [
        json!({ "jsonrpc": "2.0", "method": "textDocument/didOpen", "params": { "textDocument": document } }),
        json!({ "jsonrpc": "2.0", "method": "textDocument/didClose", "params": { "textDocument": id } }),
        json!({ "jsonrpc": "2.0", "id": "x", "method": "textDocument/documentSymbol", "params": { "textDocument": id } }),
        json!({ "jsonrpc": "2.0", "method": "textDocument/didClose", "params": { "textDocument": id } }),
        json!({ "jsonrpc": "2.0", "method": "textDocument/didChange", "params": { "textDocument": id, "contentChanges": [{ "text": "" }] } }),
    ] {
        frame::write(&mut stream, message.to_string().as_bytes()).unwrap();
    }
    io::Write::write_all(client.input.as_mut().unwrap(), &stream).unwrap();
    let answer = client.response(&json!("x"));
    assert_eq!(answer["error"]["code"], -32602);
    assert!(client.leave());
}

#[test]
fn long_documents_are_answered_in_time() {
    // One line of many instructions, many lines, a bomb of macros, nothing but signs.
    let bomb: String = (1..30)
        .map(|i| format!("#define A{i} A{} A{}\n", i - 1, i - 1))
        .collect();
    for text in [
        format!("ps.1.1 {}", "mov r0, v0 ".repeat(20_000)),
        format!("vs.1.1\n{}", "m4x4 r0, v0, c0 ; x\n".repeat(10_000)),
        format!("ps.1.1\n{bomb}A29\nmov r0, v0\n"),
        format!("ps.1.1\n{}", "{}[](),,..".repeat(20_000)),
        "x".repeat((4 << 20) + 1),
    ] {
        let start = Instant::now();
        let mut client = Client::with(&text);
        client.diagnostics(DOCUMENT);
        ask_all(&mut client, 0, 8);
        client.of("formatting");
        let range = json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 99999, "character": 0 } });
        client.ask(
            "textDocument/inlayHint",
            json!({ "textDocument": { "uri": DOCUMENT }, "range": range }),
        );
        assert!(client.leave());
        // Unoptimised and on a machine with other things to do.
        let took = start.elapsed();
        assert!(took < Duration::from_secs(60), "{took:?} for {:.20}…", text);
    }
}
