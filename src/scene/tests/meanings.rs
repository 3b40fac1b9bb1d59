//! Constants against matrices worked out by hand.

use super::*;

/// The first eight vertex constants of a scene whose only draw sets them like this.
fn constants(set: &str) -> Vec<[f32; 4]> {
    let scene = loaded(&format!(
        r#"
size = [200, 100]
time = 2.5
light_direction = [0, 0, -4]
[camera]
position = [0, 0, -5]
look_at = [0, 0, 7]
fov = 90
near = 1
far = 3
[meshes.m]
shape = "plane"
[[draw]]
mesh = "m"
vs_text = "vs.1.1\nm4x4 oPos, v0, c0\n"
ps = "c0.psh"
world = {{ scale = 2, translate = [1, 2, 3] }}
[draw.vs_constants]
{set}
"#
    ));
    let passes = scene.passes([200, 100]);
    passes[0].draws[0].vertex_constants[..8].to_vec()
}

fn near(actual: &[[f32; 4]], expected: &[[f32; 4]]) {
    let pairs = actual.iter().flatten().zip(expected.iter().flatten());
    for (a, e) in pairs {
        assert!((a - e).abs() < 1e-5, "{actual:?} instead of {expected:?}");
    }
}

#[test]
fn matrices_are_uploaded_transposed() {
    // In Direct3D's row vectors, World = [2 0 0 0 | 0 2 0 0 | 0 0 2 0 | 1 2 3 1] and View moves by (0, 0, 5).
    // Projection: cot(45°) = 1, divided by the aspect of 2 for x; zf/(zf - zn) = 3/2; -zn·zf/(zf - zn) = -3/2:
    // [1/2 0 0 0 | 0 1 0 0 | 0 0 3/2 1 | 0 0 -3/2 0].
    // World·View has the last row 1 2 8 1, and World·View·Projection is
    // [1 0 0 0 | 0 2 0 0 | 0 0 3 2 | 1/2 2 12 - 3/2 8]. Registers are its columns.
    near(
        &constants("c0 = \"world_view_projection\"\nc4 = \"world\""),
        &[
            [1.0, 0.0, 0.0, 0.5],
            [0.0, 2.0, 0.0, 2.0],
            [0.0, 0.0, 3.0, 10.5],
            [0.0, 0.0, 2.0, 8.0],
            [2.0, 0.0, 0.0, 1.0],
            [0.0, 2.0, 0.0, 2.0],
            [0.0, 0.0, 2.0, 3.0],
            [0.0, 0.0, 0.0, 1.0],
        ],
    );
    near(
        &constants("c0 = \"world_view\"\nc4 = \"view_projection\""),
        &[
            [2.0, 0.0, 0.0, 1.0],
            [0.0, 2.0, 0.0, 2.0],
            [0.0, 0.0, 2.0, 8.0],
            [0.0, 0.0, 0.0, 1.0],
            [0.5, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 1.5, 6.0],
            [0.0, 0.0, 1.0, 5.0],
        ],
    );
}

#[test]
fn inverses_and_transposes() {
    // World⁻¹ halves and moves by (-1/2, -1, -3/2).
    near(
        &constants("c0 = \"inverse_world\"\nc4 = \"transpose_world\""),
        &[
            [0.5, 0.0, 0.0, -0.5],
            [0.0, 0.5, 0.0, -1.0],
            [0.0, 0.0, 0.5, -1.5],
            [0.0, 0.0, 0.0, 1.0],
            [2.0, 0.0, 0.0, 0.0],
            [0.0, 2.0, 0.0, 0.0],
            [0.0, 0.0, 2.0, 0.0],
            [1.0, 2.0, 3.0, 1.0],
        ],
    );
    near(
        &constants("c0 = { meaning = \"inverse_transpose_world\", registers = 3 }\nc3 = 9"),
        &[
            [0.5, 0.0, 0.0, 0.0],
            [0.0, 0.5, 0.0, 0.0],
            [0.0, 0.0, 0.5, 0.0],
            [9.0; 4],
        ],
    );
}

#[test]
fn vectors_and_numbers() {
    // The camera in object space: (0 - 1, 0 - 2, -5 - 3) / 2.
    near(
        &constants(
            "c0 = \"camera_position\"\nc1 = \"object_camera_position\"\nc2 = \"light_direction\"\n\
             c3 = \"object_light_direction\"\nc4 = \"time\"\nc5 = \"target_size\"\nc6 = 0.5\nc7 = [1, 2]",
        ),
        &[
            [0.0, 0.0, -5.0, 1.0],
            [-0.5, -1.0, -4.0, 1.0],
            [0.0, 0.0, -1.0, 0.0],
            [0.0, 0.0, -1.0, 0.0],
            [2.5; 4],
            [200.0, 100.0, 0.005, 0.01],
            [0.5; 4],
            [1.0, 2.0, 0.0, 0.0],
        ],
    );
    // A matrix written out is uploaded as one by name.
    near(
        &constants("c1 = [[1, 2, 3, 4], [5, 6, 7, 8], [9, 10, 11, 12], [13, 14, 15, 16]]"),
        &[
            [0.0; 4],
            [1.0, 5.0, 9.0, 13.0],
            [2.0, 6.0, 10.0, 14.0],
            [3.0, 7.0, 11.0, 15.0],
            [4.0, 8.0, 12.0, 16.0],
        ],
    );
}

/// The registers of `world` for a transform.
fn world(transform: &str) -> Vec<[f32; 4]> {
    let scene = loaded(&format!(
        "[meshes.m]\nshape = \"plane\"\n[[draw]]\nmesh = \"m\"\nvs_text = \"vs.1.1\\nm4x4 oPos, v0, c0\\n\"\n\
         ps = \"c0.psh\"\nworld = {transform}\nvs_constants.c0 = \"world\"\n"
    ));
    scene.passes([1, 1])[0].draws[0].vertex_constants[..4].to_vec()
}

#[test]
fn transforms() {
    // Direct3D's rotation about y is [c 0 -s | 0 1 0 | s 0 c] for row vectors: at 90° x goes to -z, and z to x.
    near(
        &world("{ rotate = [0, 90, 0] }"),
        &[
            [0.0, 0.0, 1.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, 1.0],
        ],
    );
    // About x first, [1 0 0 | 0 c s | 0 -s c]: y goes to z, and then about y to x; z goes to -y and stays there;
    // x stays and then goes to -z. Before that x is doubled, and after it everything moves.
    near(
        &world("{ scale = [2, 1, 1], rotate = [90, 90, 0], translate = [5, 6, 7] }"),
        &[
            [0.0, 1.0, 0.0, 5.0],
            [0.0, 0.0, -1.0, 6.0],
            [-2.0, 0.0, 0.0, 7.0],
            [0.0, 0.0, 0.0, 1.0],
        ],
    );
    // About z, [c s 0 | -s c 0 | 0 0 1]: x goes to y.
    near(
        &world("{ rotate = [0, 0, 90] }")[..2],
        &[[0.0, -1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]],
    );
    near(
        &world("[[1, 2, 3, 4], [0, 1, 0, 0], [0, 0, 1, 0], [7, 8, 9, 1]]"),
        &[
            [1.0, 0.0, 0.0, 7.0],
            [2.0, 1.0, 0.0, 8.0],
            [3.0, 0.0, 1.0, 9.0],
            [4.0, 0.0, 0.0, 1.0],
        ],
    );
}

#[test]
fn every_name_of_a_meaning_is_read() {
    let names = crate::scene::constants::Meaning::names();
    // Six matrices with four prefixes, and six vectors.
    assert_eq!(names.len(), 30);
    for name in names {
        constants(&format!("c0 = \"{name}\""));
    }
}

#[test]
fn def_is_replaced_by_what_the_scene_sets() {
    let scene = loaded(
        "[meshes.m]\nshape = \"plane\"\n[[draw]]\nmesh = \"m\"\nvs = \"flat.vsh\"\n\
         ps_text = \"ps.1.1\\ndef c0, 0.5, 0, 0, 0\\ndef c1, 0.5, 0, 0, 0\\nmov r0, c0\\n\"\nps_constants.c1 = 3\n",
    );
    let constants = scene.passes([1, 1])[0].draws[0].pixel_constants.clone();
    // Pixel shader constants are clamped to 1.
    assert_eq!(constants[..2], [[0.5, 0.0, 0.0, 0.0], [1.0; 4]]);
}

#[test]
fn table_fog_takes_z_or_w_by_the_projection() {
    use crate::raster::FogDistance;
    let distance = |camera: &str| {
        let scene = loaded(&format!(
            "{camera}\n[meshes.m]\nshape = \"plane\"\n[[draw]]\nmesh = \"m\"\nvs = \"flat.vsh\"\nps = \"c0.psh\"\n\
             state.fog = {{ table = \"linear\" }}\n"
        ));
        scene.passes([1, 1])[0].draws[0].state.fog.distance
    };
    assert_eq!(distance(""), FogDistance::Z);
    assert_eq!(distance("[camera]"), FogDistance::W);
}
