//! OBJ files: small ones whose meaning is worked out by hand, and broken ones.

use super::*;

fn read(text: &str) -> Result<Mesh, MeshError> {
    Mesh::from_obj(text.as_bytes(), ObjOptions::default())
}

/// A unit square in the plane z = 2 whose front faces +Z in right-handed coordinates, counter-clockwise.
const SQUARE: &str =
    "o a\nv 0 0 2\nv 1 0 2\nv 1 1 2\nv 0 1 2\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\ng x\nusemtl none\n";

#[test]
fn quads_and_handedness() {
    let mesh = read(&format!("{SQUARE}f 1/1 2/2 3/3 4/4\n")).unwrap();
    assert_eq!((mesh.vertex_count(), mesh.triangle_count()), (4, 2));
    // z is negated, so the front that faced +Z faces -Z; the texture is upright, v downwards.
    assert!(mesh.positions().iter().all(|p| p.z == -2.0));
    assert_eq!(mesh.normals(), [Vec3::NEG_Z; 4]);
    assert_eq!(
        mesh.texcoords(),
        [Vec2::new(0.0, 1.0), Vec2::ONE, Vec2::X, Vec2::ZERO]
    );
    assert_eq!(
        (mesh.tangents()[0], mesh.bitangents()[0]),
        (Vec3::X, Vec3::NEG_Y)
    );
    let [a, b, c] = [0, 1, 2].map(|i| mesh.positions()[mesh.indices()[i] as usize]);
    assert!((b - a).cross(c - a).z < 0.0);
}

#[test]
fn taken_as_it_is() {
    let options = ObjOptions {
        right_handed: false,
        v_up: false,
    };
    let mesh = Mesh::from_obj(format!("{SQUARE}f 1/1 2/2 3/3 4/4\n").as_bytes(), options).unwrap();
    assert_eq!(mesh.positions()[2], Vec3::new(1.0, 1.0, 2.0));
    assert_eq!(mesh.texcoords()[2], Vec2::ONE);
    assert_eq!(mesh.normals()[0], Vec3::Z);
}

#[test]
fn negative_indices_and_continued_lines() {
    let positive = read(&format!("{SQUARE}f 1/1 2/2 3/3 4/4\n")).unwrap();
    assert_eq!(
        read(&format!("{SQUARE}f -4/-4 -3/-3 \\\n -2/-2 -1/-1 # back\n")).unwrap(),
        positive
    );
}

#[test]
fn corners_without_normal_or_texture_coordinate() {
    let mesh = read(&format!("{SQUARE}vn 1 0 0\nf 1//1 2/2 3 4/4/1\n")).unwrap();
    // Vertex order is order of use: 1//1, 2/2, 3, 4/4/1. A given normal stays, a missing one is that of the square.
    assert_eq!(mesh.normals(), [Vec3::X, Vec3::NEG_Z, Vec3::NEG_Z, Vec3::X]);
    assert_eq!(
        mesh.texcoords(),
        [Vec2::ZERO, Vec2::ONE, Vec2::ZERO, Vec2::ZERO]
    );
    let bare = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").unwrap();
    assert_eq!(bare.texcoords(), [Vec2::ZERO; 3]);
}

#[test]
fn smooth_normals_ignore_texture_seams() {
    // Two faces of a roof share an edge by position; the texture coordinates split its vertices.
    let roof = "v 0 0 -1\nv 0 0 1\nv -1 -1 -1\nv -1 -1 1\nv 1 -1 -1\nv 1 -1 1\nvt 0 0\nvt 1 0\nvt 1 1\n\
                f 1/1 3/2 4/3 2/1\nf 1/2 2/3 6/1 5/2\n";
    let mesh = read(roof).unwrap();
    for (p, n) in mesh.positions().iter().zip(mesh.normals()) {
        if p.x == 0.0 {
            // The two slopes lean to opposite sides by the same angle, so the ridge's normal is the vertical.
            assert!((*n - Vec3::Y).length() < 1e-6, "{p} {n}");
        }
    }
}

#[test]
fn colours_only_if_every_vertex_has_one() {
    let mesh = read("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3").unwrap();
    assert_eq!(mesh.colors()[1], Vec4::new(0.0, 1.0, 0.0, 1.0));
    let mesh = read("v 0 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3").unwrap();
    assert_eq!(mesh.colors(), [Vec4::ONE; 3]);
}

#[test]
fn bad_files_name_the_line() {
    for (text, line, part) in [
        ("", 0, "no face"),
        ("\u{0}\u{1}\u{fffd}PNG", 0, "no face"),
        ("v 0 0 0\n", 0, "no face"),
        ("v 0 0 0\nf 1 1\nf 1 1 1\n", 2, "at least 3 corners"),
        (
            "v 0 0 0\nf 1 1 2\n",
            2,
            "`2` names `v` number 2, but the file has 1",
        ),
        ("v 0 0 0\nf 1 1 0\n", 2, "number 0"),
        ("v 0 0 0\nf 1 1 -2\n", 2, "number -2"),
        (
            "v 0 0 0\nvt 0 0\n\nf 1/9223372036854775807 1 1\n",
            4,
            "`vt`",
        ),
        (
            "v 0 0 0\nvt 0 0\n\nf 1/-9223372036854775808 1 1\n",
            4,
            "`vt`",
        ),
        (
            "v 0 0 0\nvt 0 0\nvn 0 0 1\nf 1/1/1/1 1 1\n",
            4,
            "more than the three",
        ),
        ("v 0 0 0\nf a b c\n", 2, "`a` is no corner"),
        ("v 0 0 0\nf /1 1 1\n", 2, "no corner"),
        ("# x\nv 0 zero 0\nf 1 1 1\n", 2, "position"),
        ("v 0 0\nf 1 1 1\n", 1, "position"),
        ("v 0 0 0\nvn 1 2\nf 1 1 1\n", 2, "normal"),
        ("v 0 0 0 0\nf 1 1 1\n", 1, "zero"),
    ] {
        match read(text) {
            Err(MeshError::Obj { line: found, what }) => {
                assert_eq!(found, line, "{text:?}: {what}");
                assert!(what.contains(part), "{text:?}: {what}");
            }
            other => panic!("{text:?}: {other:?}"),
        }
    }
    let infinite = read("v 0 0 0\nv 1 0 inf\nv 0 1 0\nf 1 2 3");
    assert_eq!(
        infinite,
        Err(MeshError::NotFinite {
            attribute: Attribute::Position,
            vertex: 1
        })
    );
}

#[test]
fn scene_tables() {
    let shape: Shape = toml::from_str("shape = \"torus\"\nradius = 2.0").unwrap();
    assert_eq!(
        shape,
        Shape::Torus(Torus {
            radius: 2.0,
            ..Torus::default()
        })
    );
    assert_eq!(
        toml::from_str::<Shape>("shape = \"window_frame\"").unwrap(),
        Shape::WindowFrame(WindowFrame::default())
    );
    assert!(
        toml::from_str::<Shape>("shape = \"torus\"\nradios = 2.0")
            .unwrap_err()
            .to_string()
            .contains("radios")
    );
    assert!(
        toml::from_str::<Shape>("shape = \"taurus\"")
            .unwrap_err()
            .to_string()
            .contains("taurus")
    );
}
