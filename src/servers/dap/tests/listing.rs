//! Conversations about listings. Every number is a sum of few powers of two, and was worked out by hand.

use super::*;

/// With `VALUES`: r0.rgb = 0.5, 1, 0.25; r1 = 0.25, −0.5, 0.25, 0.25; r0.rgb = 1.25, −0.25, 0.375, clamped to 1, 0, 0.375; r0.a = 0.25.
const LISTING: &str = "ps.1.4\n\
                       def c0, 0.5, -0.5, 1, 0.25\n\
                       texcrd r0.rgb, t0 ; line 3\n\
                       mul r1.rgb, r0, c0\n\
                       +mov r1.a, c0\n\
                       add_sat r0.rgb, r1, c1 ; line 6\n\
                       mov r0.a, r1\n";

fn launch(folder: &Folder) -> Value {
    let set = json!({ "t0": [0.5, 1, 0.25, 1], "c1": [1, 0.25, 0.125, 0] });
    json!({ "program": folder.path("a.psh"), "set": set })
}

fn folder() -> Folder {
    Folder::new(&[("a.psh", LISTING)])
}

#[test]
fn from_hello_to_good_bye() {
    let folder = folder();
    let mut client = Client::new();
    let heard = client.done("launch", launch(&folder));
    assert_eq!(heard.told(), ["initialized"]);

    // Line 1 has no instruction, nor has line 2: line 3 is the next. The last condition is none.
    let breakpoints = json!([
        { "line": 1 },
        { "line": 6, "condition": "r1.a == 0.25", "logMessage": "r1 is {r1}" },
        { "line": 7, "condition": "r1.a >" },
        { "line": 8 },
    ]);
    let source = json!({ "path": folder.path("a.psh") });
    let body = client.body(
        "setBreakpoints",
        json!({ "source": source, "breakpoints": breakpoints }),
    );
    let set = &body["breakpoints"];
    let verified: Vec<&Value> = (0..4).map(|i| &set[i]["verified"]).collect();
    assert_eq!(verified, [true, true, false, false]);
    assert_eq!((&set[0]["line"], &set[1]["line"]), (&json!(3), &json!(6)));
    assert!(text(&set[2]["message"]).contains("r1.a >"));
    let body = client.body(
        "setExceptionBreakpoints",
        json!({ "filters": ["clamp", "flood"] }),
    );
    assert_eq!(
        body["breakpoints"],
        json!([{ "verified": true }, { "verified": false, "message": "there is no filter `flood`" }])
    );
    client.refused("next", json!({ "threadId": 1 }), "configurationDone");
    let heard = client.done("configurationDone", json!({}));
    assert_eq!(heard.told(), ["stopped: entry"]);
    assert_eq!(client.place(), (3, "ps.1.4 shader".to_string()));
    assert_eq!(
        client.body("threads", json!({}))["threads"],
        json!([{ "id": 1, "name": "shader" }])
    );

    // What is given, and what is not yet written.
    assert_eq!(client.value("Inputs", "t0"), "0.5, 1, 0.25, 1");
    assert_eq!(client.value("Constants", "c0"), "0.5, -0.5, 1, 0.25");
    assert_eq!(client.value("Constants", "c1"), "1, 0.25, 0.125, 0");
    assert_eq!(
        client.value("Constants", "others"),
        "6 that the shader does not read"
    );
    assert_eq!(client.value("Registers", "r0"), "0, 0, 0, 0 ← not written");

    let heard = client.done("next", json!({ "threadId": 1 }));
    assert_eq!(heard.told(), ["stopped: step"]);
    assert_eq!(client.place().0, 4);
    assert_eq!(
        client.value("Registers", "r0"),
        "0.5, 1, 0.25, 0 ← a not written, changed"
    );
    // A pair is two instructions; the first writes when the second has been computed.
    client.done("next", json!({ "threadId": 1 }));
    client.done("stepBack", json!({ "threadId": 1 }));
    assert_eq!(client.place().0, 4);

    // The log point speaks, the clamp in its line stops behind it.
    let heard = client.done("continue", json!({ "threadId": 1 }));
    assert_eq!(heard.told(), ["output", "stopped: exception"]);
    assert_eq!(
        heard.events[0]["body"]["output"],
        "r1 is 0.25, -0.5, 0.25, 0.25\n"
    );
    assert_eq!(heard.events[0]["body"]["line"], 6);
    assert_eq!(client.place().0, 7);
    assert_eq!(
        client.value("Registers", "r0"),
        "1, 0, 0.375, 0 ← a not written, changed"
    );
    assert_eq!(
        client.value("Registers", "r1"),
        "0.25, -0.5, 0.25, 0.25 ← changed"
    );
    let body = client.body("exceptionInfo", json!({ "threadId": 1 }));
    assert_eq!(body["exceptionId"], "clamp");
    assert_eq!(body["details"]["message"], "line 6: add_sat r0.rgb, r1, c1");
    assert_eq!(body["details"]["evaluateName"], "r0");

    // To the end of the recording, where the results can be looked at; then back to the breakpoint, and to the beginning.
    let heard = client.done("stepOut", json!({ "threadId": 1 }));
    assert_eq!(heard.told(), ["stopped: step"]);
    assert_eq!(client.place(), (7, "ps.1.4 shader, at its end".to_string()));
    assert_eq!(client.value("Outputs", "r0"), "1, 0, 0.375, 0.25 ← changed");
    client.body("setExceptionBreakpoints", json!({ "filters": [] }));
    let heard = client.done("reverseContinue", json!({ "threadId": 1 }));
    assert_eq!(heard.told(), ["output", "stopped: breakpoint"]);
    assert_eq!(
        heard.events[1]["body"]["hitBreakpointIds"],
        json!([set[0]["id"]])
    );
    assert_eq!(client.place().0, 3);
    let heard = client.done("reverseContinue", json!({ "threadId": 1 }));
    assert_eq!(heard.events[0]["body"]["description"], "At the beginning");
    assert_eq!(client.place(), (3, "ps.1.4 shader, inputs".to_string()));

    let heard = client.done("terminate", json!({}));
    assert_eq!(heard.told(), ["terminated"]);
    client.done("disconnect", json!({}));
}

#[test]
fn values_are_shown_in_hex_and_with_their_kind() {
    let folder = folder();
    let mut client = Client::new();
    client.launched(launch(&folder));
    let reference = client.scope("Inputs");
    let arguments = json!({ "variablesReference": reference, "format": { "hex": true } });
    let body = client.body("variables", arguments);
    let t0 = &body["variables"][0];
    // 0.5 = 2^-1, 1 = 2^0, 0.25 = 2^-2: exponents 126, 127, 125 behind the sign.
    assert_eq!(
        t0["value"],
        "0x3f000000, 0x3f800000, 0x3e800000, 0x3f800000"
    );
    assert_eq!(
        (&t0["type"], &t0["evaluateName"]),
        (&json!("float4"), &json!("t0"))
    );
    let components = client.values(t0["variablesReference"].as_i64().unwrap());
    let pairs = [("r", "0.5"), ("g", "1"), ("b", "0.25"), ("a", "1")];
    let pairs: Vec<_> = pairs
        .map(|(name, value)| (name.to_string(), value.to_string()))
        .into();
    assert_eq!(components, pairs);
    assert_eq!(client.watch("c0.gr + 1"), "0.5, 1.5");
    let arguments = json!({ "expression": "c0", "context": "hover", "format": { "hex": true } });
    let body = client.body("evaluate", arguments);
    assert_eq!(
        body["result"],
        "0x3f000000, 0xbf000000, 0x3f800000, 0x3e800000"
    );
    assert_eq!(
        (&body["type"], &body["namedVariables"]),
        (&json!("float4"), &json!(4))
    );
    client.refused(
        "evaluate",
        json!({ "expression": "c0.x +", "context": "watch" }),
        "c0.x +",
    );
}

#[test]
fn constants_that_the_shader_has_nothing_to_do_with_come_in_pages() {
    let text = "vs.1.1\nmov a0.x, v0.x\nmov oPos, c[a0.x + 2]\n";
    let folder = Folder::new(&[("a.vsh", text)]);
    let mut client = Client::new();
    let set = json!({ "v0": [1, 0, 0, 1], "c40": 0.5 });
    client.launched(json!({ "program": folder.path("a.vsh"), "set": set }));
    let scope = client.scope("Constants");
    let body = client.body("variables", json!({ "variablesReference": scope }));
    let variables = body["variables"].as_array().unwrap();
    // c3 is read, c40 is set; a device has 96.
    let names: Vec<&Value> = variables.iter().map(|variable| &variable["name"]).collect();
    assert_eq!(names, ["c3", "c40", "others"]);
    let others = &variables[2];
    assert_eq!(
        (&others["indexedVariables"], &others["namedVariables"]),
        (&json!(94), &Value::Null)
    );
    let reference = others["variablesReference"].clone();
    let page =
        json!({ "variablesReference": reference, "filter": "indexed", "start": 2, "count": 3 });
    let body = client.body("variables", page);
    let names: Vec<&Value> = body["variables"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| &v["name"])
        .collect();
    // c0, c1, c2, c4, c5 …
    assert_eq!(names, ["c2", "c4", "c5"]);
    let none = json!({ "variablesReference": reference, "filter": "named" });
    assert_eq!(client.body("variables", none)["variables"], json!([]));
    let all = json!({ "variablesReference": reference, "start": 90, "count": 0 });
    assert_eq!(
        client.body("variables", all)["variables"]
            .as_array()
            .unwrap()
            .len(),
        4
    );
}

#[test]
fn what_is_set_runs_on_and_is_marked() {
    let folder = folder();
    let mut client =
        Client::like(json!({ "adapterID": "texcrd", "supportsInvalidatedEvent": true }));
    client.launched(launch(&folder));
    client.done("next", json!({ "threadId": 1 }));
    let registers = client.scope("Registers");
    // One component, as it was shown, marks and all.
    let values = client.body("variables", json!({ "variablesReference": registers }));
    let r0 = values["variables"][0]["variablesReference"].clone();
    let set = json!({ "variablesReference": r0, "name": "g", "value": "0x3f000000 ← changed" });
    let heard = client.done("setVariable", set);
    assert!(text(&heard.response["body"]["value"]).starts_with("0.5"));
    assert_eq!(heard.told(), ["invalidated"]);
    assert_eq!(
        client.value("Registers", "r0"),
        "0.5, 0.5, 0.25, 0 ← a not written, changed"
    );
    // A whole register, and a constant by an expression.
    let set = json!({ "variablesReference": registers, "name": "r0", "value": "1, 0.5, 0.25, 0" });
    client.done("setVariable", set);
    client.done(
        "setExpression",
        json!({ "expression": "c1.b", "value": "c0.r + 0.125" }),
    );
    assert_eq!(client.watch("c1"), "1, 0.25, 0.625, 0");
    for (value, why) in [("1, 2", "2"), ("much", "much"), ("", ""), ("1,,2", ",")] {
        let set = json!({ "variablesReference": registers, "name": "r0", "value": value });
        client.refused("setVariable", set, why);
    }
    client.refused(
        "setVariable",
        json!({ "variablesReference": registers, "name": "r9", "value": "1" }),
        "r9",
    );
    client.refused(
        "setExpression",
        json!({ "expression": "r0 + 1", "value": "1" }),
        "r0 + 1",
    );
    // r1 = 1·0.5, 0.5·−0.5, 0.25·1, 0.25; with c1 1.5, 0, 0.875: clamped to 1.
    client.done("stepOut", json!({ "threadId": 1 }));
    assert_eq!(client.watch("r1"), "0.5, -0.25, 0.25, 0.25");
    assert_eq!(client.watch("r0"), "1, 0, 0.875, 0.25");
}

#[test]
fn a_register_can_be_watched() {
    let folder = folder();
    let mut client = Client::new();
    client.launched(launch(&folder));
    let body = client.body("dataBreakpointInfo", json!({ "name": "r0.a" }));
    assert_eq!(
        (&body["description"], &body["accessTypes"]),
        (&json!("r0.a"), &json!(["write"]))
    );
    let id = body["dataId"].clone();
    let asked = json!([{ "dataId": id, "accessType": "write" }, { "dataId": id, "accessType": "read" }, { "dataId": "r0" }]);
    let body = client.body("setDataBreakpoints", json!({ "breakpoints": asked }));
    let verified = (0..3)
        .map(|i| &body["breakpoints"][i]["verified"])
        .collect::<Vec<_>>();
    assert_eq!(verified, [true, false, false]);
    let heard = client.done("continue", json!({ "threadId": 1 }));
    assert_eq!(heard.told(), ["stopped: data breakpoint"]);
    // Only the last instruction writes the alpha of r0.
    assert_eq!(client.place().1, "ps.1.4 shader, at its end");
    let heard = client.done("continue", json!({ "threadId": 1 }));
    assert_eq!(heard.told(), ["exited", "terminated"]);
    assert_eq!(
        client.body("dataBreakpointInfo", json!({ "name": "r0 + 1" }))["dataId"],
        Value::Null
    );
}

#[test]
fn places_are_counted_as_the_client_counts() {
    let folder = folder();
    let mut client =
        Client::like(json!({ "adapterID": "x", "linesStartAt1": false, "columnsStartAt1": false }));
    let mut arguments = launch(&folder);
    arguments["stopOnEntry"] = json!(false);
    client.done("launch", arguments);
    let source = json!({ "path": folder.path("a.psh") });
    // Line 5 from 0 is line 6 from 1.
    let set = json!({ "source": source, "breakpoints": [{ "line": 5 }] });
    let body = client.body("setBreakpoints", set);
    assert_eq!(body["breakpoints"][0]["line"], 5);
    assert_eq!(body["breakpoints"][0]["column"], 0);
    assert_eq!(
        client.done("configurationDone", json!({})).told(),
        ["stopped: breakpoint"]
    );
    assert_eq!(client.place().0, 5);
    let body = client.body(
        "breakpointLocations",
        json!({ "source": source, "line": 2, "endLine": 4 }),
    );
    let lines = body["breakpoints"]
        .as_array()
        .unwrap()
        .iter()
        .map(|at| &at["line"]);
    assert_eq!(lines.collect::<Vec<_>>(), [2, 3, 4]);
    let body = client.body("gotoTargets", json!({ "source": source, "line": 6 }));
    assert_eq!(
        (&body["targets"][0]["label"], &body["targets"][0]["line"]),
        (&json!("mov r0.a, r1"), &json!(6))
    );
    let heard = client.done(
        "goto",
        json!({ "threadId": 1, "targetId": body["targets"][0]["id"] }),
    );
    assert_eq!(heard.told(), ["stopped: goto"]);
    assert_eq!(client.place().0, 6);
    // A target is gone with the stop that it belonged to.
    client.refused("goto", json!({ "threadId": 1, "targetId": 1 }), "target");
}

#[test]
fn breakpoints_that_come_before_the_program_find_their_place_in_it() {
    let folder = folder();
    let mut client = Client::new();
    let source = json!({ "path": folder.path("a.psh") });
    let body = client.body(
        "setBreakpoints",
        json!({ "source": source, "breakpoints": [{ "line": 2 }] }),
    );
    assert_eq!(
        (
            &body["breakpoints"][0]["verified"],
            &body["breakpoints"][0]["reason"]
        ),
        (&json!(false), &json!("pending"))
    );
    let heard = client.done("launch", launch(&folder));
    assert_eq!(heard.told(), ["breakpoint: changed", "initialized"]);
    let told = &heard.events[0]["body"]["breakpoint"];
    assert_eq!(
        (&told["id"], &told["verified"], &told["line"]),
        (&body["breakpoints"][0]["id"], &json!(true), &json!(3))
    );
}

#[test]
fn a_restart_reads_the_listing_again() {
    let folder = folder();
    let mut client = Client::new();
    client.done("launch", launch(&folder));
    let source = json!({ "path": folder.path("a.psh") });
    client.body(
        "setBreakpoints",
        json!({ "source": source, "breakpoints": [{ "line": 6 }] }),
    );
    client.done("configurationDone", json!({}));
    client.done("continue", json!({ "threadId": 1 }));
    let heard = client.done("restart", json!({}));
    assert_eq!(heard.told(), ["stopped: entry"]);
    assert_eq!(client.place().0, 3);
    // With another configuration; the breakpoint is still there.
    let mut arguments = launch(&folder);
    (arguments["stopOnEntry"], arguments["set"]["t0"]) = (json!(false), json!([0, 0, 0, 0]));
    let heard = client.done("restart", json!({ "arguments": arguments }));
    assert_eq!(heard.told(), ["stopped: breakpoint"]);
    assert_eq!(client.watch("r0.rgb"), "0, 0, 0");
    // A configuration that is wrong leaves everything as it is.
    client.refused(
        "restart",
        json!({ "arguments": { "program": folder.path("b.psh") } }),
        "b.psh",
    );
    assert_eq!(client.place().0, 6);
}

#[test]
fn what_is_wrong_with_a_listing_is_told_with_its_place() {
    let broken = "ps.1.1\nmov r0, c0\nmul r0, r0, r9\n";
    let folder = Folder::new(&[("broken.psh", broken), ("a.psh", LISTING)]);
    let mut client = Client::new();
    let program = folder.path("broken.psh");
    let heard = client.ask("launch", json!({ "program": program }));
    assert_eq!(heard.response["success"], false);
    assert_eq!(heard.response["body"]["error"]["showUser"], true);
    assert!(text(&heard.response["message"]).contains("broken.psh:3: "));
    assert_eq!(heard.told(), ["output"]);
    let body = &heard.events[0]["body"];
    assert_eq!(
        (&body["category"], &body["line"]),
        (&json!("stderr"), &json!(3))
    );
    assert!(text(&body["output"]).contains("r9"));
    assert_eq!(body["source"]["path"], program);
    for (launch, words) in [
        (json!({}), "program"),
        (json!({ "program": program, "pixel": [1, 2] }), "pixel"),
        (json!({ "program": folder.path("none.psh") }), "none.psh"),
        (json!({ "program": program, "dialect": "latin" }), "latin"),
        (json!({ "program": program, "model": "nv20" }), "r200"),
        (json!({ "program": folder.path("none.toml") }), "pixel"),
    ] {
        client.refused("launch", launch, words);
    }
    let set = json!({ "q0": [1] });
    client.refused(
        "launch",
        json!({ "program": folder.path("a.psh"), "set": set }),
        "q0",
    );
    let thread = json!({ "threadId": 1 });
    client.refused("stackTrace", thread, "nothing is launched");
    // Nothing is lost: another one can be launched.
    assert_eq!(
        told(&client.launched(launch(&folder))),
        ["initialized", "stopped: entry"]
    );
}

#[test]
fn listings_include_files_and_live_in_effects() {
    let effect = "technique T {\n pass P {\n  VertexShader = asm {\n   vs.1.1\n   mov oPos, v0\n  };\n  PixelShader = asm {\n   \
                  ps.1.1\n   mov r0, COLOR\n  };\n }\n}\n";
    let folder = Folder::new(&[
        (
            "a.psh",
            "#include \"names.h\"\nps.1.1\nmov r0, COLOR\nmov r0, GLOW\n",
        ),
        ("names.h", "#define COLOR c1\n"),
        ("b.fx", effect),
        ("scene.toml", ""),
    ]);
    // The macro of the file leads back to line 3 of the listing, the one of the launch to line 4.
    let mut client = Client::new();
    let launch =
        json!({ "program": folder.path("a.psh"), "defines": ["GLOW=v0"], "set": { "c1": [0.5] } });
    client.done("launch", launch);
    client.done("configurationDone", json!({}));
    assert_eq!(client.place(), (3, "ps.1.1 shader".to_string()));
    client.done("next", json!({ "threadId": 1 }));
    assert_eq!(client.place(), (4, "ps.1.1 shader".to_string()));

    let with = |shader: &str| json!({ "program": folder.path("b.fx"), "shader": shader, "defines": ["COLOR=c1"] });
    let mut client = Client::new();
    client.done("launch", with("2"));
    client.done("configurationDone", json!({}));
    assert_eq!(client.place(), (9, "ps.1.1 shader".to_string()));

    let mut client = Client::new();
    client.refused(
        "launch",
        json!({ "program": folder.path("b.fx") }),
        "several shaders",
    );
    client.refused(
        "launch",
        with("glow"),
        "there is no shader `glow`; it is one of",
    );
    let of_a_scene =
        json!({ "program": folder.path("scene.toml"), "pixel": [0, 0], "shader": "1" });
    client.refused("launch", of_a_scene, "`shader` is for listings");
    client.refused(
        "launch",
        json!({ "program": folder.path("a.psh"), "defines": ["1=2"] }),
        "1=2",
    );
}

#[test]
fn a_program_that_is_not_debugged_runs_through() {
    let folder = folder();
    let mut client = Client::new();
    let mut arguments = launch(&folder);
    arguments["noDebug"] = json!(true);
    client.done("launch", arguments);
    let source = json!({ "path": folder.path("a.psh") });
    client.body(
        "setBreakpoints",
        json!({ "source": source, "breakpoints": [{ "line": 6 }] }),
    );
    let heard = client.done("configurationDone", json!({}));
    assert_eq!(heard.told(), ["output", "exited", "terminated"]);
    let output = text(&heard.events[0]["body"]["output"]);
    assert!(output.contains("1, 0, 0.375, 0.25"), "{output}");
}

#[test]
fn the_console_takes_expressions_and_commands() {
    let folder = folder();
    let mut client = Client::new();
    client.launched(launch(&folder));
    let repl = |line: &str| json!({ "expression": line, "context": "repl" });
    assert_eq!(client.body("evaluate", repl("c0.r * 2"))["result"], "1");
    client.refused("evaluate", repl("r9"), "r9");
    client.refused("evaluate", repl("break here"), "here");
    // A command that moves is a stop for the client.
    let heard = client.done("evaluate", repl("next"));
    assert_eq!(heard.told(), ["stopped: step"]);
    assert_eq!(client.place().0, 4);
    // What is set by command is marked.
    assert_eq!(
        client.done("evaluate", repl("set r0.g = 0.5")).told(),
        ["stopped: step"]
    );
    assert_eq!(
        client.value("Registers", "r0"),
        "0.5, 0.5, 0.25, 0 ← a not written, changed"
    );
    // A breakpoint of the client can be deleted by command; one by command stands beside those of the client.
    let source = json!({ "path": folder.path("a.psh") });
    let set = json!({ "source": source, "breakpoints": [{ "line": 6 }] });
    let id = client.body("setBreakpoints", set)["breakpoints"][0]["id"].clone();
    client.done("evaluate", repl("break 7"));
    let heard = client.done("evaluate", repl(&format!("delete {id}")));
    assert_eq!(heard.told(), ["breakpoint: removed"]);
    assert_eq!(heard.events[0]["body"]["breakpoint"]["id"], id);
    client.body(
        "setBreakpoints",
        json!({ "source": source, "breakpoints": [] }),
    );
    assert_eq!(
        client.done("continue", json!({ "threadId": 1 })).told(),
        ["stopped: breakpoint"]
    );
    assert_eq!(client.place().0, 7);
    assert_eq!(client.done("evaluate", repl("quit")).told(), ["terminated"]);
}

#[test]
fn lines_are_completed_where_the_caret_is() {
    let folder = folder();
    let mut client = Client::new();
    client.launched(launch(&folder));
    // Columns count from 1; the caret stands behind the text.
    let targets = client.body(
        "completions",
        json!({ "text": "print c0 + r", "column": 13 }),
    )["targets"]
        .clone();
    let r1 = json!({ "label": "r1", "start": 12, "length": 1 });
    assert!(targets.as_array().unwrap().contains(&r1), "{targets}");
    let targets =
        client.body("completions", json!({ "text": "rev", "column": 4 }))["targets"].clone();
    let reverse = json!({ "label": "reverse-continue", "start": 1, "length": 3 });
    assert!(targets.as_array().unwrap().contains(&reverse), "{targets}");
    let targets = client.body(
        "completions",
        json!({ "text": "x\nab", "line": 2, "column": 1 }),
    )["targets"]
        .clone();
    assert!(!targets.as_array().unwrap().is_empty());
}

/// 128/255 squared is 64.25/255, written as 64/255 = 0.2509804; twice of it, as an expression, is a float. c0 is set to 1, and the
/// definition holds under the policy: 0.25.
#[test]
fn listings_run_with_models_and_policies() {
    let listing = "ps.1.1\ndef c0, 0.25, 0, 0, 1\nmul r0, v0, v0\nmov r1, c0\nadd r0, r0, r1\n";
    let folder = Folder::new(&[("a.psh", listing)]);
    let mut client = Client::new();
    let launch = json!({
        "program": folder.path("a.psh"), "model": "gf3", "policies": { "def": "always" },
        "set": { "v0": [0.5], "c0": [1] },
    });
    client.done("launch", launch);
    client.done("configurationDone", json!({}));
    client.done("next", json!({ "threadId": 1 }));
    assert_eq!(
        client.value("Registers", "r0"),
        "0.2509804, 0.2509804, 0.2509804, 0.2509804 ← changed"
    );
    let twice = json!({ "expression": "r0.r * 2", "context": "hover" });
    assert_eq!(client.body("evaluate", twice)["result"], "0.5019608");
    client.done("next", json!({ "threadId": 1 }));
    assert_eq!(
        client.value("Registers", "r1"),
        "0.2509804, 0, 0, 1 ← changed"
    );
    let mut client = Client::new();
    for (policies, words) in [
        (json!({ "def": "never" }), "when-set, always"),
        (json!({ "rcp": "0" }), "rcp-zero"),
    ] {
        let launch = json!({ "program": folder.path("a.psh"), "policies": policies });
        client.refused("launch", launch, words);
    }
}
