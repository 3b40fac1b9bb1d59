//! The conversation itself, as the protocol has it.

use super::*;

#[test]
fn a_client_comes_and_goes() {
    let mut client = Client::silent();
    let greeting = client.ask("initialize", json!({ "capabilities": {} }));
    assert_eq!(greeting["serverInfo"]["name"], "texcrd");
    // What nobody says is counted in units of UTF-16.
    assert_eq!(greeting["capabilities"]["positionEncoding"], "utf-16");
    assert_eq!(
        client.refused("initialize", json!({ "capabilities": {} })),
        -32600
    );
    assert!(client.leave());
}

#[test]
fn nothing_is_done_before_and_behind() {
    let mut client = Client::silent();
    client.notify(
        "textDocument/didOpen",
        json!({ "textDocument": { "uri": DOCUMENT, "text": "x" } }),
    );
    assert_eq!(client.refused("textDocument/hover", json!({})), -32002);
    assert_eq!(client.refused("shutdown", Value::Null), -32002);
    client.ask("initialize", json!({ "capabilities": {} }));
    // What came before was dropped.
    let params = json!({ "textDocument": { "uri": DOCUMENT } });
    assert_eq!(
        client.refused("textDocument/documentSymbol", params.clone()),
        -32602
    );
    client.ask("shutdown", Value::Null);
    assert_eq!(
        client.refused("textDocument/documentSymbol", params),
        -32600
    );
    assert_eq!(client.refused("shutdown", Value::Null), -32600);
    client.notify("exit", Value::Null);
    assert!(client.gone());
}

#[test]
fn who_goes_without_a_word_is_told_apart() {
    let client = Client::new();
    assert!(!client.gone());
    let mut client = Client::new();
    client.notify("exit", Value::Null);
    assert!(!client.gone());
    // The protocol has `exit` end a server that was never initialized.
    let mut client = Client::silent();
    client.notify("exit", Value::Null);
    assert!(!client.gone());
}

#[test]
fn what_is_unknown_is_refused_or_passed_over() {
    let mut client = Client::new();
    assert_eq!(client.refused("textDocument/dance", json!({})), -32601);
    assert_eq!(client.refused("$/dance", json!({})), -32601);
    client.notify("$/setTrace", json!({ "value": "off" }));
    client.notify("workspace/dance", json!(3));
    assert_eq!(
        client.refused("textDocument/hover", json!({ "textDocument": 3 })),
        -32602
    );
    assert_eq!(client.refused("textDocument/hover", Value::Null), -32602);
    assert!(client.leave());
}

#[test]
fn what_is_cancelled_while_it_waits_is_not_done() {
    let mut client = Client::with(&"mov r0, v0\n".repeat(2000));
    // All three come in one piece, so that the second waits while the first is done.
    let mut stream = Vec::new();
    let params = json!({ "textDocument": { "uri": DOCUMENT } });
    for message in [
        json!({ "jsonrpc": "2.0", "id": "one", "method": "textDocument/documentSymbol", "params": params }),
        json!({ "jsonrpc": "2.0", "id": "two", "method": "textDocument/documentSymbol", "params": params }),
        json!({ "jsonrpc": "2.0", "id": "three", "method": "textDocument/documentSymbol", "params": params }),
        json!({ "jsonrpc": "2.0", "method": "$/cancelRequest", "params": { "id": "three" } }),
        json!({ "jsonrpc": "2.0", "method": "$/cancelRequest", "params": { "id": "nobody" } }),
    ] {
        frame::write(&mut stream, message.to_string().as_bytes()).unwrap();
    }
    io::Write::write_all(client.input.as_mut().unwrap(), &stream).unwrap();
    let mut answers = BTreeMap::new();
    while answers.len() < 3 {
        let message = client.receive().unwrap();
        if let Some(id) = message["id"].as_str() {
            let id = id.to_string();
            assert!(answers.insert(id, message).is_none(), "one answer each");
        }
    }
    assert!(answers["one"].get("error").is_none());
    // Whether the server had begun with it is not known; if not, it says so.
    let code = &answers["three"]["error"]["code"];
    assert!(code.is_null() || code == -32800, "{code}");
    assert!(client.leave());
}

#[test]
fn what_is_no_message_does_no_harm() {
    let mut client = Client::new();
    for (text, code) in [
        ("{", -32700),
        ("[]", -32600),
        ("{\"id\":[],\"method\":\"x\"}", -32600),
    ] {
        frame::write(client.input.as_mut().unwrap(), text.as_bytes()).unwrap();
        let answer = client.response(&Value::Null);
        assert_eq!(answer["error"]["code"], code, "{text}");
    }
    assert!(client.leave());
}

#[test]
fn encodings_are_those_of_the_client() {
    for (encodings, expected, column) in [
        (json!(["utf-8", "utf-16"]), "utf-8", 15),
        (json!(["utf-32", "utf-8"]), "utf-32", 12),
        (json!(["ucs-2"]), "utf-16", 13),
    ] {
        let mut client = Client::silent();
        let capabilities = json!({
            "general": { "positionEncodings": encodings },
            "textDocument": { "publishDiagnostics": { "versionSupport": true } },
        });
        let greeting = client.ask("initialize", json!({ "capabilities": capabilities }));
        assert_eq!(greeting["capabilities"]["positionEncoding"], expected);
        // r9 stands behind a comment with one character of four bytes and two units of UTF-16.
        client.open(DOCUMENT, "d3d8asm", "ps.1.1\nmov /* \u{1f600} */ r9, v0");
        let found = client.diagnostics(DOCUMENT);
        let of_r9 = found.iter().find(|d| d["code"] == "O1").unwrap();
        assert_eq!(of_r9["range"]["start"]["character"], column);
        assert!(client.leave());
    }
}

#[test]
fn settings_come_with_hello_or_later() {
    let listing = "ps.1.1\nmov r0, v0.b\n";
    let errors = |found: &[Value]| found.iter().filter(|d| d["severity"] == 1).count();
    let mut client = Client::like(json!({ "dialect": "lenient" }), able());
    client.open(DOCUMENT, "d3d8asm", listing);
    assert_eq!(errors(&client.diagnostics(DOCUMENT)), 0);
    client.notify(
        "workspace/didChangeConfiguration",
        json!({ "settings": { "texcrd": { "dialect": "d3d8" } } }),
    );
    assert_eq!(errors(&client.diagnostics(DOCUMENT)), 1);
    client.notify(
        "workspace/didChangeConfiguration",
        json!({ "settings": { "dialect": "d3d7" } }),
    );
    let shown = client.receive().unwrap();
    assert_eq!(shown["method"], "window/showMessage");
    assert!(
        shown["params"]["message"]
            .as_str()
            .unwrap()
            .contains("d3d7")
    );
    assert!(client.leave());
}

#[test]
fn settings_are_asked_for_where_that_can_be() {
    let mut capabilities = able();
    capabilities["workspace"]["configuration"] = json!(true);
    capabilities["workspace"]["didChangeWatchedFiles"] = json!({ "dynamicRegistration": true });
    let mut client = Client::like(Value::Null, capabilities);
    let registration = client.receive().unwrap();
    assert_eq!(registration["method"], "client/registerCapability");
    client.send(&json!({ "jsonrpc": "2.0", "id": registration["id"], "result": null }));
    let question = client.receive().unwrap();
    assert_eq!(question["method"], "workspace/configuration");
    client.open(
        DOCUMENT,
        "d3d8asm",
        "ps.1.1\n#ifdef FOG\nmov r0, v0\n#endif\n",
    );
    assert_eq!(told(&client.diagnostics(DOCUMENT)).len(), 1);
    client.send(
        &json!({ "jsonrpc": "2.0", "id": question["id"], "result": [{ "defines": ["FOG"] }] }),
    );
    assert!(client.diagnostics(DOCUMENT).is_empty());
    assert!(client.leave());
}
