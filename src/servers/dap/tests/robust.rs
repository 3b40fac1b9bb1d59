//! Whatever comes, the adapter answers or ends.

use super::*;

/// Every request that is served.
const COMMANDS: [&str; 33] = [
    "attach",
    "breakpointLocations",
    "completions",
    "configurationDone",
    "continue",
    "dance",
    "dataBreakpointInfo",
    "disconnect",
    "evaluate",
    "exceptionInfo",
    "goto",
    "gotoTargets",
    "initialize",
    "launch",
    "loadedSources",
    "next",
    "pause",
    "restart",
    "restartFrame",
    "reverseContinue",
    "scopes",
    "setBreakpoints",
    "setDataBreakpoints",
    "setExceptionBreakpoints",
    "setExpression",
    "setVariable",
    "source",
    "stackTrace",
    "stepBack",
    "stepIn",
    "stepOut",
    "terminate",
    "variables",
];

#[test]
fn broken_messages_are_passed_over() {
    let mut stream = Vec::new();
    for message in [
        "",
        "{",
        "[]",
        "null",
        "7",
        "{\"seq\":1}",
        "{\"type\":\"request\"}",
        "{\"type\":\"response\"}",
        "\u{0}",
    ] {
        frame::write(&mut stream, message.as_bytes()).unwrap();
    }
    let hello = json!({ "seq": 5, "type": "request", "command": "initialize" });
    frame::write(&mut stream, hello.to_string().as_bytes()).unwrap();
    stream.extend(b"Content-Length: 12\r\n\r\n{");
    let messages = messages(&said(&stream));
    // A response is no fault, although nobody asked.
    let outputs = messages.iter().filter(|m| m["event"] == "output").count();
    assert_eq!(outputs, 9);
    let response = messages.iter().find(|m| m["type"] == "response").unwrap();
    assert_eq!(
        (&response["request_seq"], &response["success"]),
        (&json!(5), &json!(true))
    );
}

#[test]
fn deep_json_is_refused() {
    let mut stream = Vec::new();
    frame::write(&mut stream, "[".repeat(1 << 20).as_bytes()).unwrap();
    assert_eq!(messages(&said(&stream))[0]["event"], "output");
}

#[test]
fn requests_with_odd_arguments_are_answered() {
    let folder = Folder::new(&[("a.vsh", "vs.1.1\nm4x4 oPos, v0, c0\nmov oD0, v5\n")]);
    let path = folder.path("a.vsh");
    let odd = [
        Value::Null,
        json!([]),
        json!({}),
        json!(7),
        json!({ "threadId": -1, "frameId": i64::MIN, "variablesReference": i64::MAX, "targetId": i64::MIN, "source": {}, "line": i64::MIN,
            "sourceReference": i64::MIN, "name": "", "value": "", "expression": "", "text": "", "column": i64::MIN, "breakpoints": [], "filters": [] }),
        json!({ "threadId": 1, "frameId": 1, "variablesReference": 1, "targetId": 1, "source": { "path": path }, "line": i64::MAX,
            "endLine": i64::MIN, "sourceReference": i64::MAX, "name": "r0", "value": "ä", "expression": "((((", "text": "ä", "column": 2,
            "breakpoints": [{ "line": i64::MAX, "column": i64::MIN, "dataId": "pixel s0 1", "hitCondition": "% 0" }], "filters": [""],
            "start": i64::MIN, "count": i64::MAX, "startFrame": i64::MAX, "levels": i64::MIN, "context": "repl" }),
        json!({ "frameId": 1, "variablesReference": 1, "name": "oPos", "value": "1e99", "expression": "oPos", "breakpoints": [{ "line": 0, "dataId": "ä" }],
            "filters": ["nan", "nan"], "source": { "sourceReference": 9 }, "line": 0, "granularity": "galaxy", "targetId": 0, "text": "", "column": 0 }),
    ];
    for command in COMMANDS {
        for arguments in &odd {
            let mut client = Client::new();
            client.ask(command, arguments.clone());
            if command == "disconnect" {
                continue;
            }
            let mut client = Client::new();
            client.launched(json!({ "program": path }));
            client.ask("scopes", json!({ "frameId": 1 }));
            client.ask(command, arguments.clone());
            if command == "disconnect" {
                continue;
            }
            // It is still there.
            client.done("threads", json!({}));
        }
    }
}

#[test]
fn no_step_leads_out_of_the_recording() {
    let folder = Folder::new(&[("a.vsh", "vs.1.1\nm4x4 oPos, v0, c0\n")]);
    let mut client = Client::new();
    client.launched(json!({ "program": folder.path("a.vsh") }));
    for granularity in ["statement", "line", "instruction"] {
        for command in ["stepBack", "next", "stepIn", "stepOut"] {
            for _ in 0..7 {
                let heard = client.done(
                    command,
                    json!({ "threadId": 1, "granularity": granularity }),
                );
                assert_eq!(heard.told(), ["stopped: step"], "{command}");
            }
        }
    }
    assert_eq!(client.place().1, "vs.1.1 shader, at its end");
    assert_eq!(
        client.done("continue", json!({ "threadId": 1 })).told(),
        ["exited", "terminated"]
    );
}
