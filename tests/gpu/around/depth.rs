//! Depth and stencil: fixed-function.md, 14. Small experiments, one a pixel.

use super::*;

/// Gives the pixel the depth t0.r / t0.g.
const DEPTH: &str = "ps.1.4\\ntexcrd r5.rgb, t0\\nphase\\ntexdepth r5\\nmov r0, v0\\n";
/// Discards the pixel where t0 is negative.
const KILL: &str = "ps.1.1\\ntexkill t0\\nmov r0, v0\\n";

/// A vertex at a depth whose shader sets another one.
fn sets(depth: f32, z: f32) -> Vertex {
    Vertex {
        t: [depth, 1.0, 0.0, 1.0],
        ..deep(z)
    }
}

#[test]
fn depth_tests() {
    let device = crate::device();
    let mut columns = Vec::new();
    for (name, holds) in FUNCTIONS {
        for (z, lit) in [0.25, 0.5, 0.75].into_iter().zip(holds) {
            let state = format!("z_func = \"{name}\"");
            columns.push(Column::new(format!("{name} at {z}"), lit).step(deep(z), state));
        }
    }
    // 0.25 where 0.5 was, then 0.4: it passes unless 0.25 was written.
    let behind = |name, lit| Column::new(name, lit);
    let (first, second) = (deep(0.25), deep(0.4));
    columns.extend([
        behind("written", false).unseen(first, "").step(second, ""),
        behind("z_write", true)
            .unseen(first, "z_write = false")
            .step(second, ""),
        behind("z_enable writes nothing", true)
            .unseen(first, "z_enable = false")
            .step(second, ""),
        behind("z_enable tests nothing", true).step(deep(0.75), "z_enable = false"),
        // The default is lessequal.
        behind("default, equal", true).step(deep(0.5), ""),
        behind("default, greater", false).step(deep(0.51), ""),
    ]);
    Both::new(&device).columns("clear_depth = 0.5", &columns);
}

/// What is behind a draw that leaves its depth alone: whether something at this depth is seen.
fn then(column: Column, z: f32) -> Column {
    column.step(deep(z), "z_func = \"less\"")
}

#[test]
fn depths_of_the_viewport_and_the_bias() {
    let device = crate::device();
    let step = 1.0 / 65535.0;
    let mut columns = Vec::new();
    let ranged = |name: &'static str, lit: bool, range: &'static str, z: f32, seen: f32| {
        let column = Column::new(name, lit).unseen(deep(z), "").ranged(range);
        then(column, seen)
    };
    columns.extend([
        // 0.25 + 0.5·0.25 = 0.375
        ranged(
            "before a range",
            true,
            "min_z = 0.25, max_z = 0.5",
            0.5,
            0.374,
        ),
        ranged(
            "behind a range",
            false,
            "min_z = 0.25, max_z = 0.5",
            0.5,
            0.376,
        ),
        // 1 - 0.25
        ranged(
            "before a turned one",
            true,
            "min_z = 1, max_z = 0",
            0.25,
            0.749,
        ),
        ranged(
            "behind a turned one",
            false,
            "min_z = 1, max_z = 0",
            0.25,
            0.751,
        ),
        // Clipping is by z and w, whatever the range.
        ranged(
            "beyond the far plane",
            true,
            "min_z = 0.25, max_z = 0.5",
            1.25,
            0.9,
        ),
    ]);
    // Something at a depth, then something behind it that a bias of so many steps brings before it, or does not.
    for depth in [0.125_f32, 0.9] {
        for bias in [1, 16] {
            for (more, lit) in [(-0.5, true), (0.5, false)] {
                let z = depth + (bias as f32 + more) * step;
                let name = format!("bias {bias} at {z}");
                let column = Column::new(name, lit).unseen(deep(depth), "");
                let state = format!("z_bias = {bias}\nz_func = \"less\"");
                columns.push(column.step(deep(z), state));
            }
        }
    }
    // Taken to 0, and no further.
    let near = || Column::new("bias near the eye", true).unseen(deep(0.0), "");
    columns.push(near().step(deep(8.0 * step), "z_bias = 16\nz_func = \"equal\""));
    // A depth that the shader sets knows neither range nor bias, and is taken into 0 to 1.
    let own = |name: &'static str, lit: bool, depth: f32, state: &str, range, seen: f32| {
        let column = Column::new(name, lit).unseen(sets(depth, 0.75), state);
        then(column.shaded(DEPTH).ranged(range), seen)
    };
    columns.extend([
        own("before the shader's", true, 0.25, "", "", 0.249),
        own("behind the shader's", false, 0.25, "", "", 0.251),
        own("no bias", true, 0.25, "z_bias = 16", "", 0.25 - 8.0 * step),
        own("no range", false, 0.25, "", "min_z = 0.5, max_z = 1", 0.251),
        own(
            "no range, before it",
            true,
            0.25,
            "",
            "min_z = 0.5, max_z = 1",
            0.249,
        ),
        own("below 0", false, -3.0, "", "", 0.0),
        own("beyond 1", true, 7.0, "", "", 0.999),
        own("beyond 1, behind it", false, 7.0, "", "", 1.0),
    ]);
    // Tested with that depth, too: 0.25 is behind 0.2, though the primitive is before it.
    let tested = Column::new("the shader's is tested", false).unseen(deep(0.2), "");
    columns.push(tested.step(sets(0.25, 0.1), "").shaded(DEPTH));
    Both::new(&device).columns("", &columns);
}

/// Points and lines are biased as well.
#[test]
fn bias_of_points_and_lines() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let z = 0.125 + 8.0 / 65535.0;
    for (topology, ends) in [
        ("pointlist", vec![on(4.0, 4.0)]),
        ("linelist", vec![on(4.0, 4.0), on(5.0, 4.0)]),
    ] {
        let ends: Vec<Vertex> = ends.into_iter().map(|v| Vertex { z, ..v }).collect();
        for (bias, color) in [(16, [255; 4]), (0, [255, 0, 0, 255])] {
            let front = Vertex {
                z: 0.125,
                ..colored(1.0, 0.0, 0.0, 1.0)
            };
            let keys = format!("topology = \"{topology}\"\n[draw.state]\nz_bias = {bias}");
            let draws = [draw(&everywhere(front), ""), draw(&ends, &keys)];
            let scene = scene([SIDE; 2], "", &draws);
            both.shows(&format!("{topology}, {bias}"), &scene, &[((4, 4), color)]);
        }
    }
}

/// What does not pass the shader or the alpha test leaves neither depth nor stencil.
#[test]
fn discarded_pixels_leave_nothing() {
    let device = crate::device();
    let mut columns = Vec::new();
    let killed = |kept: bool| Vertex {
        t: [if kept { 1.0 } else { -1.0 }, 0.0, 0.0, 1.0],
        ..deep(0.25)
    };
    let clear = |alpha: f32| Vertex {
        diffuse: [1.0, 1.0, 1.0, alpha],
        ..deep(0.25)
    };
    let alpha = "alpha_test = true\nalpha_func = \"greater\"";
    for kept in [true, false] {
        let alphas = clear(if kept { 1.0 } else { 0.0 });
        let name = |what: &str| format!("{what}, kept: {kept}");
        // Something behind it is seen where it left no depth.
        let column = Column::new(name("texkill, depth"), !kept).unseen(killed(kept), "");
        columns.push(then(column.shaded(KILL), 0.5));
        let column = Column::new(name("alpha, depth"), !kept).unseen(alphas, alpha);
        columns.push(then(column, 0.5));
        // The stencil value is 0 where it left none; a failed depth test counts, too.
        for (operation, z) in [("pass", 0.25), ("z_fail", 0.75), ("fail", 0.25)] {
            let func = if operation == "fail" {
                "never"
            } else {
                "always"
            };
            let stencil =
                format!("stencil = {{ func = \"{func}\", ref = 7, {operation} = \"replace\" }}");
            let untouched = "z_enable = false\nstencil = { func = \"equal\", ref = 0 }";
            let at = |vertex: Vertex| Vertex { z, ..vertex };
            let column = Column::new(name(&format!("texkill, {operation}")), !kept);
            let column = column.unseen(at(killed(kept)), &stencil).shaded(KILL);
            columns.push(column.step(deep(0.5), untouched));
            let column = Column::new(name(&format!("alpha, {operation}")), !kept);
            let column = column.unseen(at(alphas), &format!("{alpha}\n{stencil}"));
            columns.push(column.step(deep(0.5), untouched));
        }
    }
    Both::new(&device).columns("clear_depth = 0.625", &columns);
}

/// After a draw with some stencil states, whether the value is this one.
fn holds(name: String, stencil: &str, z: f32, expected: u8) -> Column {
    let test = format!("z_enable = false\nstencil = {{ func = \"equal\", ref = {expected} }}");
    let state = format!("stencil = {{ {stencil} }}");
    (Column::new(name, true).unseen(deep(z), &state)).step(deep(0.5), test)
}

#[test]
fn stencil_operations() {
    let device = crate::device();
    let mut both = Both::new(&device);
    // The stored value is f0, the reference 35.
    let mut columns = Vec::new();
    for (operation, expected) in [
        ("keep", 0xf0),
        ("zero", 0),
        ("replace", 0x35),
        ("incrsat", 0xf1),
        ("decrsat", 0xef),
        ("invert", 0x0f),
        ("incr", 0xf1),
        ("decr", 0xef),
    ] {
        for (outcome, func, z) in [
            ("pass", "always", 0.25),
            ("z_fail", "always", 0.75),
            ("fail", "never", 0.25),
        ] {
            // The other two outcomes would clear the value.
            let others = ["pass", "z_fail", "fail"]
                .into_iter()
                .filter(|o| *o != outcome);
            let others: String = others.map(|o| format!(", {o} = \"zero\"")).collect();
            let stencil =
                format!("func = \"{func}\", ref = 0x35, {outcome} = \"{operation}\"{others}");
            columns.push(holds(
                format!("{operation}, {outcome}"),
                &stencil,
                z,
                expected,
            ));
        }
    }
    columns.extend([
        // f0 with the lower half of 35.
        holds(
            "write mask".into(),
            "ref = 0x35, pass = \"replace\", write_mask = 0x0f",
            0.25,
            0xf5,
        ),
        // Of 32 bits eight count.
        holds(
            "long mask".into(),
            "ref = 0x135, pass = \"replace\", write_mask = 0xffffff0f",
            0.25,
            0xf5,
        ),
        holds(
            "off".into(),
            "enable = false, ref = 0x35, pass = \"replace\"",
            0.25,
            0xf0,
        ),
        holds("defaults".into(), "ref = 0x35", 0.25, 0xf0),
    ]);
    both.columns("clear_stencil = 0xf0\nclear_depth = 0.5", &columns);
    for (stored, operation, expected) in [
        (255, "incrsat", 255),
        (255, "incr", 0),
        (0, "decrsat", 0),
        (0, "decr", 255),
    ] {
        let stencil = format!("pass = \"{operation}\"");
        let column = holds(format!("{operation} of {stored}"), &stencil, 0.25, expected);
        both.columns(&format!("clear_stencil = {stored}"), &[column]);
    }
}

#[test]
fn stencil_tests() {
    let device = crate::device();
    let mut columns = Vec::new();
    // The reference stands on the left: 4, 5 and 6 against 5.
    for (name, expected) in FUNCTIONS {
        for (reference, lit) in (4..=6).zip(expected) {
            let state = format!("stencil = {{ func = \"{name}\", ref = {reference} }}");
            let name = format!("{name} of {reference}");
            columns.push(Column::new(name, lit).step(deep(0.5), state));
        }
    }
    // Through a mask of 6 the value is 4, and so are 4 and c; 2 is less.
    for (reference, equal, less) in [(4, true, false), (0xc, true, false), (2, false, true)] {
        for (func, lit) in [("equal", equal), ("less", less)] {
            let state = format!("stencil = {{ func = \"{func}\", ref = {reference}, mask = 6 }}");
            let name = format!("{func} of {reference} through a mask");
            columns.push(Column::new(name, lit).step(deep(0.5), state));
        }
    }
    Both::new(&device).columns("clear_stencil = 5", &columns);
}
