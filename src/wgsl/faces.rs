//! Functions for the faces of a cube: which one a direction meets, and where.

use super::helper::Detail;

pub(super) const CUBE_FACE: &str = "\
// The face of a cube that a direction meets: +X, -X, +Y, -Y, +Z, -Z; among equals z comes before y and y before x.
fn cube_face(direction: vec3f) -> u32 {
    let a = abs(direction);
    if a.z >= a.y && a.z >= a.x {
        return select(4u, 5u, direction.z < 0.0);
    }
    if a.y >= a.x {
        return select(2u, 3u, direction.y < 0.0);
    }
    return select(0u, 1u, direction.x < 0.0);
}
";

pub(super) const ALONG_FACE: &str = "\
// A direction along a face of a cube: to the right, down and outwards.
fn along_face(face: u32, d: vec3f) -> vec3f {
    switch face {
        case 0u: { return vec3f(-d.z, -d.y, d.x); }
        case 1u: { return vec3f(d.z, -d.y, -d.x); }
        case 2u: { return vec3f(d.x, d.z, d.y); }
        case 3u: { return vec3f(d.x, -d.z, -d.y); }
        case 4u: { return vec3f(d.x, -d.y, d.z); }
        default: { return vec3f(-d.x, -d.y, -d.z); }
    }
}
";

pub(super) const ON_FACE: &str = "\
// Where a direction meets the plane of a face, 0 to 1 to the right and down; far away where it points past the plane.
fn on_face(face: u32, direction: vec3f) -> vec2f {
    let at = along_face(face, direction);
    let a = abs(direction);
    let distance = max(at.z, max(a.x, max(a.y, a.z)) / 1048576.0);
    return select((at.xy / distance + 1.0) / 2.0, vec2f(0.5), distance == 0.0);
}
";

pub(super) const OUT_OF_FACE: &str = "\
// The direction that leads so far to the right, down and out of a face of a cube.
fn out_of_face(face: u32, p: vec3f) -> vec3f {
    switch face {
        case 0u: { return vec3f(p.z, -p.y, -p.x); }
        case 1u: { return vec3f(-p.z, -p.y, p.x); }
        case 2u: { return vec3f(p.x, p.z, p.y); }
        case 3u: { return vec3f(p.x, -p.z, -p.y); }
        case 4u: { return vec3f(p.x, -p.y, p.z); }
        default: { return vec3f(-p.x, -p.y, -p.z); }
    }
}
";

pub(super) const ACROSS_EDGE: &str = "\
// The texel behind one edge of a face of a cube, n texels wide, and its face: in whole numbers, of half texels.
fn across_edge(face: u32, i: vec2i, n: i32) -> vec3i {
    let direction = out_of_face(face, vec3f(vec2f(2 * i + 1 - n), f32(n)));
    let to = cube_face(direction);
    let at = vec3i(along_face(to, direction));
    let place = (at.xy + at.z) * n / (2 * at.z);
    return vec3i(clamp(place, vec2i(), vec2i(n - 1)), i32(to));
}
";

/// The line with the step in a face of a cube to the neighbouring pixel along x or y of the screen, which is its name.
pub(super) fn face_step(direction: char) -> String {
    let d = format!("dpd{direction}Fine");
    format!(
        "    let {direction} = face_step(face, at, direction, {d}(direction), {d}(at), {d}(f32(face)));\n"
    )
}

// Which of the two pixels asks is told by whose face the other one has.
pub(super) const FACE_STEP: &str = "\
// The step in a face from a pixel to its neighbour, from derivatives. One on another face is looked for in the plane of this one.
fn face_step(face: u32, at: vec2f, direction: vec3f, d: vec3f, d_at: vec2f, d_face: f32) -> vec2f {
    if d_face == 0.0 {
        return d_at;
    }
    let is_ahead = f32(cube_face(direction + d)) - f32(face) == d_face;
    return on_face(face, select(direction - d, direction + d, is_ahead)) - at;
}
";

/// The function of this name, which samples a cube whose faces are filtered one by one.
pub(super) fn sample_faces(name: &str, detail: Detail) -> String {
    let (parameter, about) = match detail {
        Detail::Plain => ("", ""),
        Detail::Bias => (", bias: f32", " with a bias of the level of detail"),
        Detail::LevelZero => ("", ", level 0"),
    };
    let (steps, call, last) = match detail {
        Detail::LevelZero => (String::new(), "textureSampleLevel", "0.0"),
        Detail::Plain => (face_steps(), "textureSampleGrad", "x, y"),
        Detail::Bias => (
            face_steps(),
            "textureSampleGrad",
            "exp2(bias) * x, exp2(bias) * y",
        ),
    };
    format!(
        "// A cube as Direct3D 8 filters it, each face for itself{about}.\n\
         fn {name}(faces: texture_2d_array<f32>, clamped: sampler, direction: vec3f{parameter}) -> vec4f {{\n    \
             let face = cube_face(direction);\n    \
             let at = on_face(face, direction);\n\
             {steps}    \
             return {call}(faces, clamped, at, face, {last});\n}}\n"
    )
}

fn face_steps() -> String {
    ['x', 'y'].map(face_step).concat()
}
