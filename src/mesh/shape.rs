//! The built-in shapes by name, and what they share: patches and checks of parameters.

use glam::{DVec3, Vec2, Vec3};

use super::{
    Chest, Cuboid, Cylinder, Knot, Mesh, MeshData, MeshError, Plane, Sphere, Torus, WindowFrame,
};

/// Most segments a built-in shape may have in one direction.
pub const MAX_SEGMENTS: u32 = 1024;

/// A built-in mesh with its parameters. Read from a scene file (feature `scene`) it is a table whose key `shape` holds the
/// name in snake case and whose other keys are the fields of the shape, each with a default.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "scene",
    derive(serde::Deserialize),
    serde(tag = "shape", rename_all = "snake_case")
)]
pub enum Shape {
    /// A sphere.
    Sphere(Sphere),
    /// A ring.
    Torus(Torus),
    /// A box, seen from outside or from inside.
    Box(Cuboid),
    /// A rectangle that faces the viewer.
    Plane(Plane),
    /// A cylinder.
    Cylinder(Cylinder),
    /// A torus knot.
    Knot(Knot),
    /// A treasure chest.
    Chest(Chest),
    /// A window frame with bars.
    WindowFrame(WindowFrame),
}

impl Shape {
    /// Makes the mesh.
    ///
    /// # Errors
    /// A parameter outside the limits that its documentation gives.
    pub fn build(&self) -> Result<Mesh, MeshError> {
        match self {
            Self::Sphere(shape) => shape.build(),
            Self::Torus(shape) => shape.build(),
            Self::Box(shape) => shape.build(),
            Self::Plane(shape) => shape.build(),
            Self::Cylinder(shape) => shape.build(),
            Self::Knot(shape) => shape.build(),
            Self::Chest(shape) => shape.build(),
            Self::WindowFrame(shape) => shape.build(),
        }
    }
}

/// Checks that a length is a finite number above zero and small enough that no later product overflows.
pub(super) fn length(
    shape: &'static str,
    name: &'static str,
    value: f32,
) -> Result<f64, MeshError> {
    if value.is_finite() && value > 0.0 && value <= 1e9 {
        return Ok(f64::from(value));
    }
    Err(MeshError::Parameter {
        shape,
        name,
        rule: format!("is {value}; it must be above 0 and at most 1000000000"),
    })
}

/// Checks a number of segments.
pub(super) fn segments(
    shape: &'static str,
    name: &'static str,
    value: u32,
    least: u32,
) -> Result<u32, MeshError> {
    if (least..=MAX_SEGMENTS).contains(&value) {
        return Ok(value);
    }
    Err(MeshError::Parameter {
        shape,
        name,
        rule: format!("is {value}; it must be {least} to {MAX_SEGMENTS}"),
    })
}

/// Sine and cosine of `step / steps` of a full turn. The last step gives the same bits as the first, so seams are closed.
pub(super) fn turn(step: u32, steps: u32) -> (f64, f64) {
    (f64::from(step % steps) / f64::from(steps) * std::f64::consts::TAU).sin_cos()
}

/// A vertex of a built-in shape; its bitangent is `normal × tangent`.
pub(super) struct Vertex {
    pub(super) position: DVec3,
    pub(super) normal: DVec3,
    pub(super) tangent: DVec3,
    pub(super) texcoord: Vec2,
}

impl MeshData {
    /// Appends a vertex and gives its index.
    pub(super) fn push(&mut self, vertex: Vertex) -> u32 {
        let index = self.positions.len() as u32;
        self.positions.push(vertex.position.as_vec3());
        self.normals.push(vertex.normal.as_vec3());
        self.tangents.push(vertex.tangent.as_vec3());
        self.texcoords.push(vertex.texcoord);
        index
    }

    /// Appends a triangle, unless two of its corners lie at the same place, as at the pole of a sphere.
    pub(super) fn triangle(&mut self, corners: [u32; 3]) {
        let at = |i: u32| {
            self.positions
                .get(i as usize)
                .copied()
                .unwrap_or(Vec3::ZERO)
        };
        let [a, b, c] = corners.map(at);
        if a != b && b != c && c != a {
            self.indices.extend(corners);
        }
    }

    /// Appends a patch of `columns` × `rows` quads. `vertex(i, j)` is asked for i in 0..=columns and j in 0..=rows; the front
    /// is where (direction of growing i) × (direction of growing j) points, which is the normal if i follows u and j follows v.
    pub(super) fn patch(&mut self, columns: u32, rows: u32, vertex: impl Fn(u32, u32) -> Vertex) {
        let base = self.positions.len() as u32;
        for j in 0..=rows {
            for i in 0..=columns {
                self.push(vertex(i, j));
            }
        }
        let stride = columns + 1;
        for j in 0..rows {
            for i in 0..columns {
                let top_left = base + j * stride + i;
                let (top_right, bottom_left) = (top_left + 1, top_left + stride);
                self.triangle([top_left, top_right, bottom_left + 1]);
                self.triangle([top_left, bottom_left + 1, bottom_left]);
            }
        }
    }

    /// Appends a flat rectangle of size `width` × `height`, texture upright: `tangent` points to its right and
    /// `normal × tangent` down.
    pub(super) fn rectangle(&mut self, face: &Rectangle) {
        let down = face.normal.cross(face.tangent);
        self.patch(face.columns, face.rows, |i, j| {
            let (u, v) = (fraction(i, face.columns), fraction(j, face.rows));
            Vertex {
                position: face.center
                    + face.tangent * ((u - 0.5) * face.width)
                    + down * ((v - 0.5) * face.height),
                normal: face.normal,
                tangent: face.tangent,
                texcoord: Vec2::new(u as f32, v as f32),
            }
        });
    }
}

/// What [`MeshData::rectangle`] draws.
pub(super) struct Rectangle {
    pub(super) center: DVec3,
    pub(super) normal: DVec3,
    pub(super) tangent: DVec3,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) columns: u32,
    pub(super) rows: u32,
}

/// `step / steps`.
pub(super) fn fraction(step: u32, steps: u32) -> f64 {
    f64::from(step) / f64::from(steps)
}
