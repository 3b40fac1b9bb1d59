//! What pixel shaders are given, and fog.

use super::*;

/// Shows the specular colour.
const SPECULAR: &str = "ps.1.1\\nmov r0, v1\\n";
/// Shows the first three coordinates, without alpha.
const COORDINATES: &str = "ps.1.4\\ntexcrd r0.rgb, t0\\nmov r0.a, c0.a\\n";
/// A quarter of them.
const QUARTER: &str = "ps.1.4\\ndef c1, 0.25, 0.25, 0.25, 0\\ntexcrd r0.rgb, t0\\nmul r0.rgb, r0, c1\\n+mov r0.a, c1.a\\n";
/// The first two, divided by the fourth.
const DIVIDED: &str = "ps.1.4\\ntexcrd r0.rg, t0_dw.xyw\\nmov r0.ba, c0\\n";

/// A triangle over the upper left half of the screen whose second corner, on the right, has other values than the others.
fn differing(first: Vertex, second: Vertex) -> [Vertex; 3] {
    let at = |at, like| Vertex { at, ..like };
    [
        at([0.0, 0.0], first),
        at([16.0, 0.0], second),
        at([0.0, 16.0], first),
    ]
}

/// A vertex whose colours, coordinates and fog are this number.
fn of(value: f32, w: f32) -> Vertex {
    Vertex {
        diffuse: [value; 4],
        specular: [value; 4],
        t: [value, value, value, 1.0],
        fog: value,
        w,
        ..on(0.0, 0.0)
    }
}

/// fixed-function.md, 3. Half way on the screen between w = 1 and w = 3 is (1/2 · 1/3)/(1/2 · 1 + 1/2 · 1/3) = 1/4 of the way.
#[test]
fn perspective() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let triangle = differing(of(0.0, 1.0), of(1.0, 3.0));
    let mut shows = |what: &str, vertices: &[Vertex], keys: &str, color: [u8; 4]| {
        let scene = scene([SIDE; 2], "", &[draw(vertices, keys)]);
        both.shows(what, &scene, &[((8, 0), color)]);
    };
    // 0.25 · 255 = 63.75
    shows("diffuse", &triangle, "", [64; 4]);
    shows(
        "specular",
        &triangle,
        &format!("ps_text = \"{SPECULAR}\""),
        [64; 4],
    );
    let coordinates = format!("ps_text = \"{COORDINATES}\"");
    shows("coordinates", &triangle, &coordinates, [64, 64, 64, 0]);
    // The fourth is 1.5 there, the first 0.75.
    let corner = |t, w| Vertex { t, ..of(0.0, w) };
    let four = differing(
        corner([0.0, 0.0, 0.0, 1.0], 1.0),
        corner([3.0, 1.5, 0.0, 3.0], 3.0),
    );
    let divided = format!("ps_text = \"{DIVIDED}\"");
    // 0.75/1.5 and 0.375/1.5
    shows("the fourth coordinate", &four, &divided, [128, 64, 0, 0]);
    let red = |vertex: Vertex| Vertex {
        diffuse: [1.0, 0.0, 0.0, 1.0],
        ..vertex
    };
    let fogged = triangle.map(red);
    let fog = |keys: &str| format!("[draw.state]\nfog = {{ color = [0, 1, 0]{keys} }}");
    // A quarter of red, three of green.
    shows("fog", &fogged, &fog(""), [64, 191, 0, 255]);
    // Depth is linear on the screen: 1 - 0.5.
    let deep = |z: f32, w: f32| {
        red(Vertex {
            z,
            w,
            ..on(0.0, 0.0)
        })
    };
    let sloping = differing(deep(0.0, 1.0), deep(1.0, 3.0));
    let by_depth = fog(", table = \"linear\"");
    shows("depth", &sloping, &by_depth, [128, 128, 0, 255]);
    // w is 1.5: (3 - 1.5)/3.
    let by_w = fog(", table = \"linear\", end = 3, distance = \"w\"");
    shows("w", &sloping, &by_w, [128, 128, 0, 255]);
}

/// fixed-function.md, 3: colours and fog are taken into 0 to 1 at the vertex. Half way between -1 and 3 would be 1; between 0
/// and 1 it is 1/2. Coordinates are not.
#[test]
fn limits_at_the_vertex() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let triangle = differing(of(-1.0, 1.0), of(3.0, 1.0));
    let mut shows = |what: &str, keys: &str, at: (u32, u32), color: [u8; 4]| {
        let scene = scene([SIDE; 2], "", &[draw(&triangle, keys)]);
        both.shows(what, &scene, &[(at, color)]);
    };
    shows("diffuse", "", (8, 0), [128; 4]);
    shows(
        "specular",
        &format!("ps_text = \"{SPECULAR}\""),
        (8, 0),
        [128; 4],
    );
    // -1 + 3/4 · 4 = 2, of which a quarter is seen.
    let quarter = format!("ps_text = \"{QUARTER}\"");
    shows("coordinates", &quarter, (12, 0), [128, 128, 128, 0]);
    let red = triangle.map(|vertex| Vertex {
        diffuse: [1.0, 0.0, 0.0, 1.0],
        ..vertex
    });
    let fog = draw(&red, "[draw.state]\nfog = { color = [0, 1, 0] }");
    let scene = scene([SIDE; 2], "", &[fog]);
    both.shows("fog", &scene, &[((8, 0), [128, 128, 0, 255])]);
}

/// fixed-function.md, 2.3: both colours of the first vertex of a triangle or line; coordinates and fog are interpolated.
#[test]
fn flat_shading() {
    let device = crate::device();
    let mut both = Both::new(&device);
    // Vertex i has (i + 1)/8.
    let numbered = |i: u8, x: f32, y: f32| Vertex {
        at: [x, y],
        ..of(f32::from(i + 1) / 8.0, 1.0)
    };
    let strip = [
        numbered(0, 0.0, 0.0),
        numbered(1, 8.0, 0.0),
        numbered(2, 0.0, 8.0),
        numbered(3, 8.0, 8.0),
    ];
    // 1/8, 2/8 and 3/8 of 255.
    let [first, second, third] = [[32; 4], [64; 4], [96; 4]];
    let all = strip.as_slice();
    let (list, line) = (&all[..3], &all[2..]);
    for shader in [DIFFUSE, SPECULAR] {
        for (topology, vertices, at, color) in [
            ("trianglelist", list, (2, 2), first),
            ("trianglestrip", all, (2, 2), first),
            // Triangle 1 of a strip begins with vertex 1, and so does triangle 0 of a fan.
            ("trianglestrip", all, (6, 6), second),
            ("trianglefan", list, (2, 2), second),
            ("linelist", line, (4, 8), third),
            ("linestrip", line, (4, 8), third),
        ] {
            let keys = format!(
                "ps_text = \"{shader}\"\ntopology = \"{topology}\"\n[draw.state]\nshade = \"flat\""
            );
            let scene = scene([SIDE; 2], "", &[draw(vertices, &keys)]);
            both.shows(topology, &scene, &[(at, color)]);
        }
    }
    // (1 + x/8 + 2·y/8)/8 at (2, 2): 1.75/8 of 255 is 55.8.
    let keys = format!("ps_text = \"{COORDINATES}\"\n[draw.state]\nshade = \"flat\"");
    let coordinates = scene([SIDE; 2], "", &[draw(list, &keys)]);
    both.shows("coordinates", &coordinates, &[((2, 2), [56, 56, 56, 0])]);
    let white = [strip[0], strip[1], strip[2]].map(|vertex| Vertex {
        diffuse: [1.0; 4],
        ..vertex
    });
    let keys = "[draw.state]\nshade = \"flat\"\nfog = { color = [0, 0, 0] }";
    let fog = scene([SIDE; 2], "", &[draw(&white, keys)]);
    both.shows("fog", &fog, &[((2, 2), [56, 56, 56, 255])]);
    // Gouraud is the default.
    let plain = scene([SIDE; 2], "", &[draw(list, "")]);
    both.shows("gouraud", &plain, &[((2, 2), [56; 4])]);
}

/// fixed-function.md, 15.
#[test]
fn sprites() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let vertex = Vertex {
        at: [4.0, 4.0],
        ..of(0.5, 1.0)
    };
    // From 2 to 6 are 0 to 1: pixel 3 is a quarter, pixel 5 three quarters. The third and fourth are 0.
    for (sprite, color) in [("true", [64, 191, 0, 0]), ("false", [128, 128, 128, 0])] {
        let keys = format!(
            "topology = \"pointlist\"\nps_text = \"{COORDINATES}\"\n[draw.state]\npoint_size = 4\npoint_sprite = {sprite}"
        );
        let scene = scene([SIDE; 2], "", &[draw(&[vertex], &keys)]);
        both.shows(sprite, &scene, &[((3, 5), color)]);
    }
}

/// fixed-function.md, 11: where the distance comes from. w is 2, the depth 0.25: (4 - 2)/4 = 0.5 or (4 - 0.25)/4 = 0.9375.
#[test]
fn distances_of_fog() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let vertex = Vertex {
        z: 0.25,
        w: 2.0,
        ..on(0.0, 0.0)
    };
    let fog = |more: &str| {
        let fog = format!("[draw.state]\nfog = {{ table = \"linear\", end = 4{more} }}");
        draw(&everywhere(vertex), &fog)
    };
    let projection = |last: &str| {
        format!("[camera]\nprojection = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, {last}]]\n")
    };
    // The fourth column is (0, 0, 1, 0), (0, 0, 0, 1), (0, 0, 0, 2).
    let [perspective, parallel, scaled] =
        ["1], [0, 0, -1, 0", "0], [0, 0, 0.5, 1", "0], [0, 0, 0, 2"].map(projection);
    let (w, z) = ([128, 128, 128, 255], [239, 239, 239, 255]);
    for (camera, more, color) in [
        ("", "", z),
        (perspective.as_str(), "", w),
        (parallel.as_str(), "", z),
        (scaled.as_str(), "", w),
        ("[camera]\nfov = 60\n", "", w),
        (perspective.as_str(), ", distance = \"z\"", z),
        ("", ", distance = \"w\"", w),
    ] {
        let scene = scene([2, 2], camera, &[fog(more)]);
        both.shows(&format!("{camera}{more}"), &scene, &[((1, 1), color)]);
    }
    // The depth of the viewport: 0.5 + 0.25·0.5 = 0.625, so (4 - 0.625)/4 = 0.84375 of 255, 215.2.
    let keys = "[draw.state]\nfog = { table = \"linear\", end = 4 }\nviewport = { min_z = 0.5 }";
    let ranged = scene([2, 2], "", &[draw(&everywhere(vertex), keys)]);
    both.shows("a range", &ranged, &[((1, 1), [215, 215, 215, 255])]);
    // And the same where the shader sets another depth: t0.r/t0.g = 1.
    let own = Vertex {
        t: [1.0, 1.0, 0.0, 1.0],
        ..vertex
    };
    let shader = "ps.1.4\\ntexcrd r5.rgb, t0\\nphase\\ntexdepth r5\\nmov r0, v0\\n";
    let keys = format!("ps_text = \"{shader}\"\n{keys}");
    let own = scene([2, 2], "", &[draw(&everywhere(own), &keys)]);
    both.shows(
        "a depth of its own",
        &own,
        &[((1, 1), [215, 215, 215, 255])],
    );
}

/// fixed-function.md, 11: an oFog that is not written is full fog, and a table ignores what is written.
#[test]
fn fog_of_vertices_and_of_tables() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let unwritten = "vs_text = \"vs.1.1\\nmov oPos, v0\\nmov oD0, v1\\n\"\n";
    let fog = |keys: &str| format!("[draw.state]\nfog = {{ color = [0.2, 0.4, 0.6]{keys} }}");
    let clear = Vertex {
        fog: 0.0,
        ..deep(0.0)
    };
    for (what, keys, vertex, color) in [
        (
            "unwritten",
            format!("{unwritten}{}", fog("")),
            deep(0.5),
            [51, 102, 153, 255],
        ),
        ("a table", fog(", table = \"exp\""), clear, [255; 4]),
        (
            "the vertex mode",
            fog(", vertex = \"linear\""),
            deep(0.5),
            [255; 4],
        ),
        ("off", fog(", enable = false"), clear, [255; 4]),
    ] {
        let scene = scene([2, 2], "", &[draw(&everywhere(vertex), &keys)]);
        both.shows(what, &scene, &[((1, 1), color)]);
    }
}

/// fixed-function.md, 5 and 6.
#[test]
fn stages() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let texture = "ps_text = \"ps.1.1\\ntex t0\\nmov r0, t0\\n\"\n";
    let unbound = scene(
        [2, 2],
        "clear = [1, 1, 1, 0]",
        &[draw(&everywhere(on(0.0, 0.0)), texture)],
    );
    both.shows("nothing bound", &unbound, &[((1, 1), [0, 0, 0, 255])]);
    // u is 0.5625 everywhere, q goes from 1 to 3: 0.5625 is in texel 2; half way q is 1.5, and 0.375 is in texel 1.
    let columns = "[textures.columns]\nsize = [4, 1]\n\
                   texels = [[0, 0, 0, 1], [1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1]]\n";
    let corner = |q: f32, w: f32| Vertex {
        t: [0.5625, 0.5, 0.0, q],
        w,
        ..on(0.0, 0.0)
    };
    let triangle = differing(corner(1.0, 1.0), corner(3.0, 3.0));
    for (projected, color) in [("true", [255, 0, 0, 255]), ("false", [0, 255, 0, 255])] {
        let stage = format!("stages.0 = {{ texture = \"columns\", projected = {projected} }}");
        let scene = scene(
            [SIDE; 2],
            columns,
            &[draw(&triangle, &format!("{texture}{stage}"))],
        );
        both.shows(
            projected,
            &scene,
            &[((0, 0), [0, 255, 0, 255]), ((8, 0), color)],
        );
    }
}
