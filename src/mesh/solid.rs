//! The plain geometric shapes. Normals are exact and tangents follow the parametrisation.

use glam::{DVec3, Vec2};

use super::shape::{Rectangle, Vertex, fraction, length, segments, turn};
use super::{Mesh, MeshData, MeshError};

/// A sphere around the origin. v runs from the north pole (+Y) to the south pole; u = 0.5 faces the viewer (-Z).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "scene",
    derive(serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Sphere {
    /// Radius, above 0. Default 1.
    pub radius: f32,
    /// Segments around the axis, 3 to [`super::MAX_SEGMENTS`]. Default 48.
    pub slices: u32,
    /// Segments from pole to pole, 2 to [`super::MAX_SEGMENTS`]. Default 24.
    pub stacks: u32,
}

impl Default for Sphere {
    fn default() -> Self {
        Self {
            radius: 1.0,
            slices: 48,
            stacks: 24,
        }
    }
}

/// Direction out of the Y axis, and of growing u, at a step of a turn that has u = 0.5 at -Z.
fn around(step: u32, steps: u32) -> (DVec3, DVec3) {
    let (sin, cos) = turn(step, steps);
    (DVec3::new(-sin, 0.0, cos), DVec3::new(-cos, 0.0, -sin))
}

impl Sphere {
    /// Makes the mesh.
    ///
    /// # Errors
    /// A field outside its limits.
    pub fn build(&self) -> Result<Mesh, MeshError> {
        let radius = length("sphere", "radius", self.radius)?;
        let slices = segments("sphere", "slices", self.slices, 3)?;
        let stacks = segments("sphere", "stacks", self.stacks, 2)?;
        let mut data = MeshData::default();
        data.patch(slices, stacks, |i, j| {
            let (out, tangent) = around(i, slices);
            let (sin, cos) = (fraction(j, stacks) * std::f64::consts::PI).sin_cos();
            // The sine of the rounded π is not zero; the pole must be one point.
            let sin = if j == 0 || j == stacks { 0.0 } else { sin };
            let normal = out * sin + DVec3::Y * cos;
            Vertex {
                position: normal * radius,
                normal,
                tangent,
                texcoord: Vec2::new(fraction(i, slices) as f32, fraction(j, stacks) as f32),
            }
        });
        Mesh::new(data)
    }
}

/// A ring around the Y axis. u runs around the axis; v runs around the tube, with v = 0.5 on the outer equator.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "scene",
    derive(serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Torus {
    /// Distance of the middle of the tube from the axis, above 0. Default 1.
    pub radius: f32,
    /// Radius of the tube, above 0 and at most `radius`. Default 0.35.
    pub tube: f32,
    /// Segments around the axis, 3 to [`super::MAX_SEGMENTS`]. Default 64.
    pub segments: u32,
    /// Segments around the tube, 3 to [`super::MAX_SEGMENTS`]. Default 32.
    pub tube_segments: u32,
}

impl Default for Torus {
    fn default() -> Self {
        Self {
            radius: 1.0,
            tube: 0.35,
            segments: 64,
            tube_segments: 32,
        }
    }
}

impl Torus {
    /// Makes the mesh.
    ///
    /// # Errors
    /// A field outside its limits.
    pub fn build(&self) -> Result<Mesh, MeshError> {
        let radius = length("torus", "radius", self.radius)?;
        let tube = length("torus", "tube", self.tube)?;
        if tube > radius {
            let rule = format!("is {tube}; it must not exceed `radius` ({radius})");
            return Err(MeshError::Parameter {
                shape: "torus",
                name: "tube",
                rule,
            });
        }
        let columns = segments("torus", "segments", self.segments, 3)?;
        let rows = segments("torus", "tube_segments", self.tube_segments, 3)?;
        let mut data = MeshData::default();
        data.patch(columns, rows, |i, j| {
            let (out, tangent) = around(i, columns);
            // From the inner equator over the top: the angle π - 2πv has this sine and the negated cosine.
            let (sin, cos) = turn(j, rows);
            let normal = out * -cos + DVec3::Y * sin;
            Vertex {
                position: out * radius + normal * tube,
                normal,
                tangent,
                texcoord: Vec2::new(fraction(i, columns) as f32, fraction(j, rows) as f32),
            }
        });
        Mesh::new(data)
    }
}

/// A box around the origin. Every face shows the whole texture, upright on the four sides; the top and the bottom face have
/// the edge nearest to the viewer (-Z) at the bottom and at the top of the texture.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "scene",
    derive(serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Cuboid {
    /// Size along x, y and z, each above 0. Default 1, 1, 1.
    pub size: [f32; 3],
    /// Whether the faces look inwards, as the walls of a room do. Default no.
    pub inside: bool,
    /// Segments along each edge, 1 to [`super::MAX_SEGMENTS`]. Default 1.
    pub segments: u32,
}

impl Default for Cuboid {
    fn default() -> Self {
        Self {
            size: [1.0; 3],
            inside: false,
            segments: 1,
        }
    }
}

/// Normal and tangent of the six faces of a box seen from outside; `normal × tangent` points down in the picture.
const FACES: [(DVec3, DVec3); 6] = [
    (DVec3::NEG_Z, DVec3::X),
    (DVec3::Z, DVec3::NEG_X),
    (DVec3::X, DVec3::Z),
    (DVec3::NEG_X, DVec3::NEG_Z),
    (DVec3::Y, DVec3::X),
    (DVec3::NEG_Y, DVec3::X),
];

impl Cuboid {
    /// Makes the mesh.
    ///
    /// # Errors
    /// A field outside its limits.
    pub fn build(&self) -> Result<Mesh, MeshError> {
        let [x, y, z] = self.size;
        let size = DVec3::new(
            length("box", "size", x)?,
            length("box", "size", y)?,
            length("box", "size", z)?,
        );
        let count = segments("box", "segments", self.segments, 1)?;
        let mut data = MeshData::default();
        for (normal, tangent) in FACES {
            // Turning the tangent with the normal keeps the picture readable from inside.
            let side = if self.inside { -1.0 } else { 1.0 };
            data.rectangle(&Rectangle {
                center: normal * size * 0.5,
                normal: normal * side,
                tangent: tangent * side,
                width: (tangent * size).length(),
                height: (normal.cross(tangent) * size).length(),
                columns: count,
                rows: count,
            });
        }
        Mesh::new(data)
    }
}

/// A rectangle in the plane z = 0 around the origin whose front faces the viewer (normal -Z). Texture coordinate (0,0) is
/// at the top left (-X, +Y), (1,1) at the bottom right.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "scene",
    derive(serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Plane {
    /// Size along x, above 0. Default 1.
    pub width: f32,
    /// Size along y, above 0. Default 1.
    pub height: f32,
    /// Segments along x, 1 to [`super::MAX_SEGMENTS`]. Default 1.
    pub columns: u32,
    /// Segments along y, 1 to [`super::MAX_SEGMENTS`]. Default 1.
    pub rows: u32,
}

impl Default for Plane {
    fn default() -> Self {
        Self {
            width: 1.0,
            height: 1.0,
            columns: 1,
            rows: 1,
        }
    }
}

impl Plane {
    /// Makes the mesh.
    ///
    /// # Errors
    /// A field outside its limits.
    pub fn build(&self) -> Result<Mesh, MeshError> {
        let mut data = MeshData::default();
        data.rectangle(&Rectangle {
            center: DVec3::ZERO,
            normal: DVec3::NEG_Z,
            tangent: DVec3::X,
            width: length("plane", "width", self.width)?,
            height: length("plane", "height", self.height)?,
            columns: segments("plane", "columns", self.columns, 1)?,
            rows: segments("plane", "rows", self.rows, 1)?,
        });
        Mesh::new(data)
    }
}

/// A cylinder around the Y axis and the origin. u runs around as on the sphere, v from top to bottom; the caps show the disc
/// inscribed in the texture.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "scene",
    derive(serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Cylinder {
    /// Radius, above 0. Default 0.5.
    pub radius: f32,
    /// Height, above 0. Default 1.
    pub height: f32,
    /// Segments around the axis, 3 to [`super::MAX_SEGMENTS`]. Default 48.
    pub slices: u32,
    /// Segments along the axis, 1 to [`super::MAX_SEGMENTS`]. Default 1.
    pub stacks: u32,
    /// Whether the ends are closed. Default yes.
    pub capped: bool,
}

impl Default for Cylinder {
    fn default() -> Self {
        Self {
            radius: 0.5,
            height: 1.0,
            slices: 48,
            stacks: 1,
            capped: true,
        }
    }
}

impl Cylinder {
    /// Makes the mesh.
    ///
    /// # Errors
    /// A field outside its limits.
    pub fn build(&self) -> Result<Mesh, MeshError> {
        let radius = length("cylinder", "radius", self.radius)?;
        let height = length("cylinder", "height", self.height)?;
        let slices = segments("cylinder", "slices", self.slices, 3)?;
        let stacks = segments("cylinder", "stacks", self.stacks, 1)?;
        let mut data = MeshData::default();
        data.patch(slices, stacks, |i, j| {
            let (normal, tangent) = around(i, slices);
            let v = fraction(j, stacks);
            Vertex {
                position: normal * radius + DVec3::Y * ((0.5 - v) * height),
                normal,
                tangent,
                texcoord: Vec2::new(fraction(i, slices) as f32, v as f32),
            }
        });
        if self.capped {
            for normal in [DVec3::Y, DVec3::NEG_Y] {
                let down = normal.cross(DVec3::X);
                let vertex = |out: DVec3| Vertex {
                    position: out * radius + normal * (height * 0.5),
                    normal,
                    tangent: DVec3::X,
                    texcoord: Vec2::new(
                        (0.5 + 0.5 * out.x) as f32,
                        (0.5 + 0.5 * out.dot(down)) as f32,
                    ),
                };
                let center = data.push(vertex(DVec3::ZERO));
                for i in 0..slices {
                    // `around` runs clockwise seen from below, hence the other way for the top.
                    let (first, second) = if normal.y > 0.0 {
                        (i + 1, i)
                    } else {
                        (i, i + 1)
                    };
                    let a = data.push(vertex(around(first, slices).0));
                    let b = data.push(vertex(around(second, slices).0));
                    data.triangle([center, a, b]);
                }
            }
        }
        Mesh::new(data)
    }
}

/// A tube along a (p, q) torus knot: p times around the Y axis, q times around the tube of the torus it lies on. u runs along
/// the knot, v around the tube. The tangents follow the knot and leave out the twist of the tube.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "scene",
    derive(serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Knot {
    /// Turns around the axis, 1 to 16, without a common divisor with `q`. Default 2.
    pub p: u32,
    /// Turns around the tube of the torus, 1 to 16. Default 3.
    pub q: u32,
    /// Distance of the middle of the torus from the axis, above 0. Default 1.
    pub radius: f32,
    /// Radius of the torus on which the knot lies, above 0, less than `radius`. Default 0.45.
    pub torus_tube: f32,
    /// Radius of the knot's own tube, above 0. Default 0.18.
    pub tube: f32,
    /// Segments along the knot, 3 to [`super::MAX_SEGMENTS`]. Default 256.
    pub segments: u32,
    /// Segments around the tube, 3 to [`super::MAX_SEGMENTS`]. Default 24.
    pub tube_segments: u32,
}

impl Default for Knot {
    fn default() -> Self {
        Self {
            p: 2,
            q: 3,
            radius: 1.0,
            torus_tube: 0.45,
            tube: 0.18,
            segments: 256,
            tube_segments: 24,
        }
    }
}

impl Knot {
    /// Makes the mesh.
    ///
    /// # Errors
    /// A field outside its limits.
    pub fn build(&self) -> Result<Mesh, MeshError> {
        let error = |name, rule: String| {
            Err(MeshError::Parameter {
                shape: "knot",
                name,
                rule,
            })
        };
        for (name, value) in [("p", self.p), ("q", self.q)] {
            if !(1..=16).contains(&value) {
                return error(name, format!("is {value}; it must be 1 to 16"));
            }
        }
        if common_divisor(self.p, self.q) != 1 {
            return error(
                "p",
                format!(
                    "({}) has a common divisor with `q` ({}), so this is no single knot",
                    self.p, self.q
                ),
            );
        }
        let radius = length("knot", "radius", self.radius)?;
        let inner = length("knot", "torus_tube", self.torus_tube)?;
        let tube = length("knot", "tube", self.tube)?;
        if inner >= radius {
            return error(
                "torus_tube",
                format!("is {inner}; it must be less than `radius` ({radius})"),
            );
        }
        let columns = segments("knot", "segments", self.segments, 3)?;
        let rows = segments("knot", "tube_segments", self.tube_segments, 3)?;
        let mut data = MeshData::default();
        data.patch(columns, rows, |i, j| {
            let (out, along) = around(i * self.p, columns);
            let (sin, cos) = turn(i * self.q, columns);
            // The knot lies on a torus, so the normal of the torus is at right angles to the knot, and it closes on itself:
            // with the direction of the knot it makes an exact frame that needs no correction at the seam.
            let torus_normal = out * cos + DVec3::Y * sin;
            let around_tube = out * -sin + DVec3::Y * cos;
            let direction = (along * ((radius + inner * cos) * f64::from(self.p))
                + around_tube * (inner * f64::from(self.q)))
            .normalize_or(along);
            let (tube_sin, tube_cos) = turn(j, rows);
            let normal = torus_normal * tube_cos + torus_normal.cross(direction) * tube_sin;
            Vertex {
                position: out * radius + torus_normal * inner + normal * tube,
                normal,
                tangent: direction,
                texcoord: Vec2::new(fraction(i, columns) as f32, fraction(j, rows) as f32),
            }
        });
        Mesh::new(data)
    }
}

fn common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { common_divisor(b, a % b) }
}
