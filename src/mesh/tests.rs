//! What every mesh must hold, checked on every built-in shape, and cases worked out by hand.

use std::collections::HashMap;

use glam::{Mat4, Vec2, Vec3, Vec4};

use super::*;

fn all_shapes() -> Vec<(&'static str, Mesh)> {
    let shapes = [
        ("sphere", Shape::Sphere(Sphere::default())),
        ("torus", Shape::Torus(Torus::default())),
        (
            "box",
            Shape::Box(Cuboid {
                size: [1.0, 2.0, 3.0],
                inside: false,
                segments: 3,
            }),
        ),
        (
            "room",
            Shape::Box(Cuboid {
                size: [4.0, 2.0, 3.0],
                inside: true,
                segments: 1,
            }),
        ),
        (
            "plane",
            Shape::Plane(Plane {
                width: 2.0,
                height: 3.0,
                columns: 3,
                rows: 2,
            }),
        ),
        (
            "cylinder",
            Shape::Cylinder(Cylinder {
                stacks: 2,
                ..Cylinder::default()
            }),
        ),
        ("knot", Shape::Knot(Knot::default())),
        ("chest", Shape::Chest(Chest::default())),
        (
            "window_frame",
            Shape::WindowFrame(WindowFrame {
                mullions: 1,
                transoms: 2,
                ..WindowFrame::default()
            }),
        ),
    ];
    shapes
        .into_iter()
        .map(|(name, shape)| (name, shape.build().unwrap()))
        .collect()
}

fn triangles(mesh: &Mesh) -> impl Iterator<Item = [usize; 3]> + '_ {
    mesh.indices()
        .chunks_exact(3)
        .map(|t| [t[0] as usize, t[1] as usize, t[2] as usize])
}

#[test]
fn frames_are_orthonormal_and_not_mirrored() {
    for (name, mesh) in all_shapes() {
        for i in 0..mesh.vertex_count() {
            let (n, t, b) = (mesh.normals()[i], mesh.tangents()[i], mesh.bitangents()[i]);
            for v in [n, t, b] {
                assert!((v.length() - 1.0).abs() < 1e-5, "{name} {i}");
            }
            assert!(
                n.dot(t).abs() < 1e-5 && n.dot(b).abs() < 1e-5 && t.dot(b).abs() < 1e-5,
                "{name} {i}"
            );
            assert!(t.cross(b).dot(n) > 0.999, "{name} {i}");
        }
    }
}

/// Clockwise from outside means that the cross product points where the normals do: the derivation stands at the top of
/// the room.
#[test]
fn triangles_run_clockwise_seen_from_the_side_of_their_normals() {
    for (name, mesh) in all_shapes() {
        for corners in triangles(&mesh) {
            let [a, b, c] = corners.map(|i| mesh.positions()[i]);
            let face = (b - a).cross(c - a).normalize();
            for i in corners {
                assert!(
                    face.dot(mesh.normals()[i]) > 0.5,
                    "{name} {corners:?} {face} {}",
                    mesh.normals()[i]
                );
            }
        }
    }
}

#[test]
fn tangents_follow_the_texture_coordinates() {
    for (name, mesh) in all_shapes() {
        // The knot leaves the twist out by design.
        for corners in triangles(&mesh).filter(|_| name != "knot") {
            let [p, q, r] = corners.map(|i| mesh.positions()[i]);
            let [s, t, w] = corners.map(|i| mesh.texcoords()[i]);
            let (d1, d2) = (t - s, w - s);
            let determinant = d1.perp_dot(d2);
            assert!(determinant > 0.0, "{name} {corners:?}");
            let along_u = ((q - p) * d2.y - (r - p) * d1.y).normalize();
            let along_v = ((r - p) * d1.x - (q - p) * d2.x).normalize();
            let mean = |list: &[Vec3]| corners.map(|i| list[i]).iter().sum::<Vec3>().normalize();
            assert!(
                along_u.dot(mean(mesh.tangents())) > 0.7,
                "{name} {corners:?}"
            );
            assert!(
                along_v.dot(mean(mesh.bitangents())) > 0.7,
                "{name} {corners:?}"
            );
        }
    }
}

#[test]
fn normals_point_outwards() {
    let outward = |mesh: &Mesh, from: fn(Vec3) -> Vec3| {
        mesh.positions()
            .iter()
            .zip(mesh.normals())
            .map(|(p, n)| (*p - from(*p)).dot(*n))
            .fold(f32::MAX, f32::min)
    };
    // Every point of a sphere of radius 1 is its own normal, and every point of the tube lies 0.35 from its middle circle.
    assert!(outward(&Sphere::default().build().unwrap(), |_| Vec3::ZERO) > 0.99999);
    let middle = |p: Vec3| Vec3::new(p.x, 0.0, p.z).normalize();
    assert!((outward(&Torus::default().build().unwrap(), middle) - 0.35).abs() < 1e-5);
    assert_eq!(
        outward(&Cuboid::default().build().unwrap(), |_| Vec3::ZERO),
        0.5
    );
    let room = Cuboid {
        inside: true,
        ..Cuboid::default()
    }
    .build()
    .unwrap();
    assert!(
        room.positions()
            .iter()
            .zip(room.normals())
            .all(|(p, n)| p.dot(*n) == -0.5)
    );
    assert!((outward(&Cylinder::default().build().unwrap(), |_| Vec3::ZERO) - 0.5).abs() < 1e-6);
}

/// Vertices minus edges plus triangles after welding equal positions; every edge must have two triangles that run along
/// it in opposite directions.
fn euler(mesh: &Mesh) -> i64 {
    let mut points: HashMap<[i64; 3], usize> = HashMap::new();
    let weld: Vec<usize> = mesh
        .positions()
        .iter()
        .map(|p| {
            let next = points.len();
            *points
                .entry(p.to_array().map(|c| (f64::from(c) * 1e5).round() as i64))
                .or_insert(next)
        })
        .collect();
    let mut edges: HashMap<(usize, usize), i32> = HashMap::new();
    for corners in triangles(mesh) {
        let [a, b, c] = corners.map(|i| weld[i]);
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((from, to)).or_insert(0) += 1;
        }
    }
    for ((from, to), count) in &edges {
        assert_eq!(
            (*count, edges.get(&(*to, *from))),
            (1, Some(&1)),
            "edge {from}-{to} is open"
        );
    }
    points.len() as i64 - edges.len() as i64 / 2 + mesh.triangle_count() as i64
}

#[test]
fn closed_shapes_are_closed() {
    // Euler: 2 for what is a sphere to a topologist, 0 for a ring.
    for (expected, mesh) in [
        (
            2,
            Sphere {
                slices: 7,
                stacks: 5,
                ..Sphere::default()
            }
            .build(),
        ),
        (
            2,
            Cuboid {
                segments: 3,
                ..Cuboid::default()
            }
            .build(),
        ),
        (
            2,
            Cuboid {
                inside: true,
                ..Cuboid::default()
            }
            .build(),
        ),
        (
            2,
            Cylinder {
                slices: 9,
                stacks: 2,
                ..Cylinder::default()
            }
            .build(),
        ),
        (
            0,
            Torus {
                segments: 9,
                tube_segments: 5,
                ..Torus::default()
            }
            .build(),
        ),
        (
            0,
            Knot {
                segments: 60,
                tube_segments: 5,
                ..Knot::default()
            }
            .build(),
        ),
    ] {
        assert_eq!(euler(&mesh.unwrap()), expected);
    }
}

#[test]
fn texture_coordinates_stay_in_the_unit_square() {
    for (name, mesh) in all_shapes()
        .into_iter()
        .filter(|(name, _)| *name != "window_frame")
    {
        let inside = |t: &Vec2| t.min_element() >= 0.0 && t.max_element() <= 1.0;
        assert!(mesh.texcoords().iter().all(inside), "{name}");
    }
}

#[test]
fn plane_by_hand() {
    let mesh = Plane {
        width: 2.0,
        height: 4.0,
        ..Plane::default()
    }
    .build()
    .unwrap();
    assert_eq!(mesh.positions()[0], Vec3::new(-1.0, 2.0, 0.0));
    assert_eq!(mesh.texcoords()[0], Vec2::ZERO);
    assert_eq!(mesh.positions()[3], Vec3::new(1.0, -2.0, 0.0));
    assert_eq!(mesh.texcoords()[3], Vec2::ONE);
    assert_eq!(
        (mesh.normals()[0], mesh.tangents()[0], mesh.bitangents()[0]),
        (Vec3::NEG_Z, Vec3::X, Vec3::NEG_Y)
    );
    assert_eq!(
        mesh.value(Attribute::Texcoord, 3),
        Some(Vec4::new(1.0, 1.0, 0.0, 1.0))
    );
    assert_eq!(mesh.value(Attribute::Color, 0), Some(Vec4::ONE));
    assert_eq!(mesh.value(Attribute::Position, 4), None);
}

#[test]
fn parameters_have_limits() {
    let rejected = |mesh: Result<Mesh, MeshError>, field: &str| match mesh {
        Err(MeshError::Parameter { name, .. }) => assert_eq!(name, field),
        other => panic!("{field}: {other:?}"),
    };
    rejected(
        Sphere {
            slices: 2,
            ..Sphere::default()
        }
        .build(),
        "slices",
    );
    rejected(
        Sphere {
            stacks: MAX_SEGMENTS + 1,
            ..Sphere::default()
        }
        .build(),
        "stacks",
    );
    rejected(
        Sphere {
            radius: f32::NAN,
            ..Sphere::default()
        }
        .build(),
        "radius",
    );
    rejected(
        Torus {
            tube: 2.0,
            ..Torus::default()
        }
        .build(),
        "tube",
    );
    rejected(
        Cuboid {
            size: [1.0, 0.0, 1.0],
            ..Cuboid::default()
        }
        .build(),
        "size",
    );
    rejected(
        Cuboid {
            segments: u32::MAX,
            ..Cuboid::default()
        }
        .build(),
        "segments",
    );
    rejected(
        Plane {
            columns: 0,
            ..Plane::default()
        }
        .build(),
        "columns",
    );
    rejected(
        Knot {
            p: 2,
            q: 4,
            ..Knot::default()
        }
        .build(),
        "p",
    );
    rejected(
        Knot {
            q: 17,
            ..Knot::default()
        }
        .build(),
        "q",
    );
    rejected(
        WindowFrame {
            mullions: 65,
            ..WindowFrame::default()
        }
        .build(),
        "mullions",
    );
    rejected(
        Chest {
            segments: 3,
            ..Chest::default()
        }
        .build(),
        "segments",
    );
    // Six faces of 1025² vertices are more than a mesh may have.
    let big = Cuboid {
        segments: MAX_SEGMENTS,
        ..Cuboid::default()
    }
    .build();
    assert_eq!(
        big,
        Err(MeshError::TooMany {
            what: "vertices",
            found: 6 * 1025 * 1025,
            limit: MAX_VERTICES
        })
    );
    assert!(
        Sphere {
            slices: MAX_SEGMENTS,
            stacks: MAX_SEGMENTS,
            ..Sphere::default()
        }
        .build()
        .is_ok()
    );
}

#[test]
fn lists_are_checked() {
    let data = || MeshData {
        positions: vec![Vec3::ZERO, Vec3::Y, Vec3::X],
        indices: vec![0, 1, 2],
        ..MeshData::default()
    };
    assert_eq!(
        Mesh::new(MeshData {
            indices: vec![0, 1],
            ..data()
        }),
        Err(MeshError::IndexCount(2))
    );
    assert_eq!(
        Mesh::new(MeshData {
            indices: vec![0, 1, 3],
            ..data()
        }),
        Err(MeshError::IndexRange {
            at: 2,
            index: 3,
            vertices: 3
        })
    );
    assert!(matches!(
        Mesh::new(MeshData {
            normals: vec![Vec3::X],
            ..data()
        }),
        Err(MeshError::Length {
            attribute: Attribute::Normal,
            expected: 3,
            found: 1
        })
    ));
    let positions = vec![Vec3::ZERO, Vec3::new(f32::INFINITY, 0.0, 0.0), Vec3::X];
    assert_eq!(
        Mesh::new(MeshData {
            positions,
            ..data()
        }),
        Err(MeshError::NotFinite {
            attribute: Attribute::Position,
            vertex: 1
        })
    );
    assert!(Mesh::new(MeshData::default()).is_ok());
}

#[test]
fn missing_frames_are_finite_even_for_degenerate_triangles() {
    // By hand: y × x = -z. Without texture coordinates the tangent is arbitrary; with huge or equal positions all stays unit.
    let flat = Mesh::new(MeshData {
        positions: vec![Vec3::ZERO, Vec3::Y, Vec3::X],
        indices: vec![0, 1, 2],
        ..MeshData::default()
    });
    assert_eq!(flat.unwrap().normals(), [Vec3::NEG_Z; 3]);
    for size in [0.0, 1e-38, 1.0, 3e38] {
        for texcoords in [
            vec![],
            vec![Vec2::splat(f32::MAX); 3],
            vec![Vec2::ZERO, Vec2::new(0.0, 1e-38), Vec2::X],
        ] {
            let positions = vec![Vec3::ZERO, Vec3::Y * size, Vec3::X * size];
            let mesh = Mesh::new(MeshData {
                positions,
                texcoords,
                indices: vec![0, 1, 2],
                ..MeshData::default()
            })
            .unwrap();
            for v in mesh
                .normals()
                .iter()
                .chain(mesh.tangents())
                .chain(mesh.bitangents())
            {
                assert!((v.length() - 1.0).abs() < 1e-5, "{size} {v}");
            }
        }
    }
}

#[test]
fn tangents_from_texture_coordinates_by_hand() {
    // A square facing -Z whose u grows upwards and whose v grows to the right: tangent +Y, bitangent +X, and mirrored,
    // since Y × X = -Z is the normal only if the picture is not: here it is not mirrored.
    let mesh = Mesh::new(MeshData {
        positions: vec![Vec3::ZERO, Vec3::Y, Vec3::X],
        texcoords: vec![Vec2::ZERO, Vec2::X, Vec2::Y],
        indices: vec![0, 1, 2],
        ..MeshData::default()
    })
    .unwrap();
    assert_eq!(
        (mesh.tangents()[0], mesh.bitangents()[0]),
        (Vec3::Y, Vec3::X)
    );
    // With v turned round the picture is mirrored and the bitangent follows it: T × B = -N.
    let mesh = Mesh::new(MeshData {
        positions: vec![Vec3::ZERO, Vec3::Y, Vec3::X],
        texcoords: vec![Vec2::ZERO, Vec2::X, Vec2::NEG_Y],
        indices: vec![0, 1, 2],
        ..MeshData::default()
    })
    .unwrap();
    assert_eq!(
        (mesh.tangents()[0], mesh.bitangents()[0]),
        (Vec3::Y, Vec3::NEG_X)
    );
}

#[test]
fn transforms() {
    let mesh = Sphere {
        slices: 8,
        stacks: 4,
        ..Sphere::default()
    }
    .build()
    .unwrap();
    let moved = mesh
        .transformed(
            Mat4::from_translation(Vec3::X * 5.0) * Mat4::from_scale(Vec3::new(1.0, 2.0, -3.0)),
        )
        .unwrap();
    for (p, n) in moved.positions().iter().zip(moved.normals()) {
        // The gradient of x² + (y/2)² + (z/3)² around the new middle.
        let d = *p - Vec3::X * 5.0;
        assert!(n.dot(Vec3::new(d.x, d.y / 4.0, d.z / 9.0).normalize()) > 0.9999);
    }
    for corners in triangles(&moved) {
        let [a, b, c] = corners.map(|i| moved.positions()[i]);
        assert!(
            (b - a).cross(c - a).dot(a - Vec3::X * 5.0) > 0.0,
            "mirroring must keep the front outside"
        );
    }
    assert_eq!(
        mesh.transformed(Mat4::from_scale(Vec3::new(1.0, 0.0, 1.0))),
        Err(MeshError::Singular)
    );
    assert_eq!(mesh.transformed(Mat4::NAN), Err(MeshError::Singular));
    let both = Mesh::merge([&mesh, &moved]).unwrap();
    assert_eq!(both.vertex_count(), 2 * mesh.vertex_count());
    assert_eq!(
        both.indices()[mesh.indices().len()],
        moved.indices()[0] + mesh.vertex_count() as u32
    );
    let halved = mesh.with_texcoords(Vec2::new(-0.5, 0.5), Vec2::X).unwrap();
    assert_eq!(halved.texcoords()[1], Vec2::new(1.0 - 0.5 / 8.0, 0.0));
    assert_eq!(halved.tangents()[1], -mesh.tangents()[1]);
}

#[test]
fn attribute_names() {
    for (attribute, name) in Attribute::ALL {
        assert_eq!(name.parse(), Ok(attribute));
        assert_eq!(attribute.to_string(), name);
    }
    let message = "Normal".parse::<Attribute>().unwrap_err().to_string();
    assert_eq!(
        message,
        "`Normal` is no mesh attribute; there are position, normal, tangent, bitangent, texcoord, color, specular, texcoord1, texcoord2, texcoord3, \
         texcoord4, texcoord5, texcoord6, texcoord7"
    );
}

#[test]
fn chest_stands_on_the_floor_with_its_lock_in_front() {
    let mesh = Chest::default().build().unwrap();
    // Foot of the vault 0.492, vault 0.28, strap 0.018, rivet 0.001 + 0.015: 0.806.
    let low = mesh.positions().iter().copied().reduce(Vec3::min).unwrap();
    let high = mesh.positions().iter().copied().reduce(Vec3::max).unwrap();
    assert!(
        low.y.abs() < 0.003 && (high.y - 0.806).abs() < 1e-3,
        "{low} {high}"
    );
    let (lock_low, lock_high) = ChestRegion::Lock.corners();
    let lock: Vec<usize> = (0..mesh.vertex_count())
        .filter(|i| {
            mesh.texcoords()[*i].cmpge(lock_low).all()
                && mesh.texcoords()[*i].cmple(lock_high).all()
        })
        .collect();
    assert_eq!(lock.len(), 4);
    assert!(
        lock.iter()
            .all(|i| mesh.normals()[*i] == Vec3::NEG_Z && mesh.positions()[*i].z < -0.35)
    );
}

#[cfg(feature = "scene")]
mod obj;
