//! Conversations about scenes.

use super::*;

/// One triangle that covers the picture: x = 2u − 1 and y = 1 − 2v of u, v from 0 to 2. Its colour at the corners is (u, v, 0, 1) / 2.
const SCENE: &str = r#"
size = [4, 4]
[meshes.m]
positions = [[-1, 1, 0.5], [3, 1, 0.5], [-1, -3, 0.5]]
texcoords = [[0, 0], [2, 0], [0, 2]]
indices = [0, 1, 2]
[[draw]]
name = "first"
mesh = "m"
vs = "a.vsh"
ps_text = """
ps.1.4
mov r0, v0
add r0.rgb, r0, c0
"""
state = { cull = "none" }
[draw.vs_constants]
c0 = [0.5, 0.5, 0, 1]
[draw.ps_constants]
c0 = [0.125, 0, 0, 0]
"#;

const VERTEX: &str = "vs.1.1\nmov oPos, v0\nmul oD0, v7, c0\n";

fn folder() -> Folder {
    Folder::new(&[("scene.toml", SCENE), ("a.vsh", VERTEX)])
}

#[test]
fn a_pixel_stands_on_its_vertices() {
    let folder = folder();
    let mut client = Client::new();
    let program = folder.path("scene.toml");
    // In Direct3D 8 the centre of pixel 1, 2 is (1, 2) of 4: u = 0.25, v = 0.5.
    client.done("launch", json!({ "program": program, "pixel": [1, 2] }));
    assert_eq!(
        client.done("configurationDone", json!({})).told(),
        ["stopped: entry"]
    );
    let body = client.body("stackTrace", json!({ "threadId": 1 }));
    assert_eq!(body["totalFrames"], 4);
    let frames = body["stackFrames"].as_array().unwrap();
    let names: Vec<String> = frames.iter().map(|frame| text(&frame["name"])).collect();
    assert!(
        names[0].starts_with("pixel shader of pixel 1,2"),
        "{names:?}"
    );
    assert!(
        names[1..]
            .iter()
            .all(|name| name.starts_with("vertex shader of vertex ")),
        "{names:?}"
    );
    assert_eq!(
        client.body("threads", json!({}))["threads"][0]["name"],
        "pixel 1,2"
    );
    // The pixel shader stands in the scene file: it has a number, and its lines count from its own first.
    let (source, line) = (&frames[0]["source"], &frames[0]["line"]);
    assert_eq!((&source["path"], line), (&Value::Null, &json!(2)));
    let number = source["sourceReference"].clone();
    let content = client.body("source", json!({ "sourceReference": number }));
    assert!(text(&content["content"]).contains("mov r0, v0"));
    assert_eq!(frames[1]["source"]["path"], folder.path("a.vsh"));

    // Shares of a third add up to 1 but for rounding, a few times 2^-24.
    let near = |value: &str, expected: [f32; 4]| {
        let numbers: Vec<f32> = value.split(", ").map(|x| x.parse().unwrap()).collect();
        let off = numbers.iter().zip(expected).map(|(x, y)| (x - y).abs());
        assert!(
            numbers.len() == 4 && off.fold(0.0, f32::max) < 1e-6,
            "{value}"
        );
    };
    near(&client.watch("v0"), [0.125, 0.25, 0.0, 1.0]);
    // Each frame has its own registers, at the end of its run.
    let mut corners = Vec::new();
    for frame in &frames[1..] {
        let arguments = json!({ "expression": "oD0", "frameId": frame["id"], "context": "watch" });
        corners.push(text(&client.body("evaluate", arguments)["result"]));
    }
    corners.sort();
    assert_eq!(corners, ["0, 0, 0, 1", "0, 1, 0, 1", "1, 0, 0, 1"]);

    // The four pixels of the quad: rows 2 and 3, columns 0 and 1.
    client.done("next", json!({ "threadId": 1 }));
    let quad = client.scope("Quad");
    let body = client.body("variables", json!({ "variablesReference": quad }));
    let pixels = body["variables"].as_array().unwrap().clone();
    let names: Vec<&Value> = pixels.iter().map(|pixel| &pixel["name"]).collect();
    assert_eq!(names, ["0,2", "1,2", "0,3", "1,3"]);
    assert_eq!(pixels[1]["value"], "the pixel that is debugged");
    let neighbour = client.values(pixels[0]["variablesReference"].as_i64().unwrap());
    let (name, value) = &neighbour[0];
    assert_eq!(name, "r0");
    near(value.split(" ←").next().unwrap(), [0.0, 0.25, 0.0, 1.0]);

    // A breakpoint in the text by its number; then through the merger to the end.
    client.done("stepBack", json!({ "threadId": 1 }));
    let set = json!({ "source": { "sourceReference": number }, "breakpoints": [{ "line": 3 }] });
    let body = client.body("setBreakpoints", set);
    assert_eq!(
        (
            &body["breakpoints"][0]["verified"],
            &body["breakpoints"][0]["line"]
        ),
        (&json!(true), &json!(3))
    );
    let heard = client.done("continue", json!({ "threadId": 1 }));
    assert_eq!(heard.told(), ["stopped: breakpoint"]);
    client.done("next", json!({ "threadId": 1 }));
    // 0.125 + 0.125
    near(&client.watch("r0"), [0.25, 0.25, 0.0, 1.0]);
    assert_eq!(
        client.done("continue", json!({ "threadId": 1 })).told(),
        ["exited", "terminated"]
    );
}

#[test]
fn a_breakpoint_in_the_vertex_shader_of_a_pixel_is_not_passed_by() {
    let folder = folder();
    let mut client = Client::new();
    let program = folder.path("scene.toml");
    client.done("launch", json!({ "program": program, "pixel": [0, 0] }));
    let source = json!({ "path": folder.path("a.vsh") });
    client.body(
        "setBreakpoints",
        json!({ "source": source, "breakpoints": [{ "line": 3 }] }),
    );
    client.done("configurationDone", json!({}));
    assert!(client.place().1.contains("(corner 1)"));
    for _ in 0..3 {
        assert_eq!(
            client.done("continue", json!({ "threadId": 1 })).told(),
            ["stopped: breakpoint"]
        );
        assert_eq!(client.place().0, 3);
    }
    // One place for each corner.
    let body = client.body("gotoTargets", json!({ "source": source, "line": 2 }));
    let targets = body["targets"].as_array().unwrap();
    assert_eq!(targets.len(), 3);
    assert!(text(&targets[0]["label"]).starts_with("mov oPos, v0 of vertex "));
    assert_eq!(
        client.done("continue", json!({ "threadId": 1 })).told(),
        ["exited", "terminated"]
    );
}

#[test]
fn a_scene_needs_something_to_look_at() {
    let folder = folder();
    let program = folder.path("scene.toml");
    let mut client = Client::new();
    for (launch, words) in [
        (json!({ "program": program }), "pixel"),
        (json!({ "program": program, "pixel": [4, 0] }), "4"),
        (
            json!({ "program": program, "pixel": [0, 0], "vertex": 0 }),
            "not both",
        ),
        (json!({ "program": program, "vertex": 3 }), "3"),
        (
            json!({ "program": program, "vertex": 0, "draw": "second" }),
            "second",
        ),
        (
            json!({ "program": program, "pixel": [0, 0], "set": { "c0": [1] } }),
            "set",
        ),
        (
            json!({ "program": program, "pixel": [0, 0], "size": [0, 0] }),
            "pixel",
        ),
    ] {
        client.refused("launch", launch, words);
    }
    // All of what is asked is asked again each time, so that files may change for a new client only.
    let mut client = Client::new();
    folder.write("a.vsh", "vs.1.1\nmov oPos, v0\nmov oD0, r99\n");
    let heard = client.ask("launch", json!({ "program": program, "pixel": [0, 0] }));
    assert!(
        text(&heard.response["message"]).contains("a.vsh:3: "),
        "{}",
        heard.response
    );
    assert!(
        heard
            .events
            .iter()
            .any(|event| event["body"]["source"]["path"] == folder.path("a.vsh"))
    );
}
