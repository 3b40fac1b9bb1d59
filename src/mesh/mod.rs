//! Meshes: triangle lists with the attributes that a Direct3D 8 vertex shader is fed, the built-in shapes, and Wavefront OBJ.
//!
//! Conventions, which are those of Direct3D 8:
//! - left-handed coordinates: +X right, +Y up, +Z away from a viewer who looks along +Z;
//! - the front of a triangle is the side from which its corners run clockwise. With the usual component formula of the cross
//!   product this is the side to which `(p1 - p0) × (p2 - p0)` points: seen from -Z, (-1,1,0), (1,1,0), (1,-1,0) run
//!   clockwise, and (2,0,0) × (2,-2,0) = (0,0,-4) points at the viewer;
//! - texture coordinates start at the top left, u grows to the right and v downwards, so that `tangent × bitangent = normal`
//!   wherever the picture is not mirrored.

mod attribute;
mod chest;
mod frame;
#[cfg(feature = "scene")]
mod obj;
mod shape;
mod solid;
mod window;

#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use glam::{Mat3, Mat4, Vec2, Vec3, Vec4};

pub use attribute::{Attribute, UnknownAttribute};
pub use chest::{Chest, ChestRegion};
#[cfg(feature = "scene")]
pub use obj::{MAX_OBJ_BYTES, ObjOptions};
pub use shape::{MAX_SEGMENTS, Shape};
pub use solid::{Cuboid, Cylinder, Knot, Plane, Sphere, Torus};
pub use window::WindowFrame;

/// Most vertices a mesh may have (2²¹).
pub const MAX_VERTICES: usize = 1 << 21;

/// Most triangles a mesh may have (2²²).
pub const MAX_TRIANGLES: usize = 1 << 22;

/// Why a mesh could not be made. Its `Display` text is a sentence for people.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum MeshError {
    /// An attribute list has another length than the list of positions.
    Length {
        /// The attribute.
        attribute: Attribute,
        /// How many values there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// The number of indices is not a multiple of three.
    IndexCount(usize),
    /// An index names a vertex that is not there.
    IndexRange {
        /// Where in the index list, from 0.
        at: usize,
        /// The index.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A value is infinite or not a number.
    NotFinite {
        /// The attribute.
        attribute: Attribute,
        /// The vertex, from 0.
        vertex: usize,
    },
    /// More vertices or triangles than [`MAX_VERTICES`] or [`MAX_TRIANGLES`].
    TooMany {
        /// "vertices" or "triangles".
        what: &'static str,
        /// How many were asked for.
        found: usize,
        /// How many are allowed.
        limit: usize,
    },
    /// A parameter of a built-in shape is outside what the shape allows.
    Parameter {
        /// The shape's name.
        shape: &'static str,
        /// The parameter's name.
        name: &'static str,
        /// What is wrong and what is allowed.
        rule: String,
    },
    /// The matrix of [`Mesh::transformed`] is singular or not finite.
    Singular,
    /// An OBJ file cannot be read.
    Obj {
        /// The line, from 1; 0 when the file as a whole is meant.
        line: usize,
        /// What is wrong.
        what: String,
    },
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length {
                attribute,
                expected,
                found,
            } => {
                write!(
                    f,
                    "the mesh has {expected} positions but {found} values of `{attribute}`"
                )
            }
            Self::IndexCount(n) => write!(
                f,
                "{n} indices do not make whole triangles: the number must be a multiple of 3"
            ),
            Self::IndexRange {
                at,
                index,
                vertices,
            } => {
                write!(
                    f,
                    "index {at} names vertex {index}, but the mesh has {vertices} vertices"
                )
            }
            Self::NotFinite { attribute, vertex } => {
                write!(
                    f,
                    "`{attribute}` of vertex {vertex} is infinite or not a number"
                )
            }
            Self::TooMany { what, found, limit } => write!(
                f,
                "the mesh would have {found} {what}; at most {limit} are allowed"
            ),
            Self::Parameter { shape, name, rule } => write!(f, "mesh `{shape}`: `{name}` {rule}"),
            Self::Singular => write!(
                f,
                "a mesh cannot be transformed by a matrix that is singular or not finite"
            ),
            Self::Obj { line: 0, what } => write!(f, "OBJ file: {what}"),
            Self::Obj { line, what } => write!(f, "OBJ file, line {line}: {what}"),
        }
    }
}

impl std::error::Error for MeshError {}

/// The raw lists from which [`Mesh::new`] makes a mesh. All but `positions` and `indices` may be left empty.
#[derive(Debug, Clone, Default)]
pub struct MeshData {
    /// One position a vertex, object space.
    pub positions: Vec<Vec3>,
    /// Empty, or one a vertex, of any length; a zero vector asks for the smooth normal.
    pub normals: Vec<Vec3>,
    /// Empty, or one a vertex: direction of increasing u.
    pub tangents: Vec<Vec3>,
    /// Empty, or one a vertex: direction of increasing v.
    pub bitangents: Vec<Vec3>,
    /// Empty (all zero), or one a vertex.
    pub texcoords: Vec<Vec2>,
    /// Empty (all white), or one a vertex.
    pub colors: Vec<Vec4>,
    /// The specular colour and coordinate sets 1 to 7, as vertex registers hold them, each empty or one a vertex; of
    /// [`Attribute::Texcoord`] what goes beyond `texcoords`: of its values only the third and fourth component count.
    pub more: BTreeMap<Attribute, Vec<Vec4>>,
    /// Three a triangle, clockwise seen from the front.
    pub indices: Vec<u32>,
}

/// An indexed triangle list. Whoever holds one can rely on this: all lists have one value a vertex, every index names a
/// vertex, every number is finite, and normal, tangent and bitangent of a vertex are unit vectors at right angles.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    tangents: Vec<Vec3>,
    bitangents: Vec<Vec3>,
    texcoords: Vec<Vec2>,
    colors: Vec<Vec4>,
    more: BTreeMap<Attribute, Vec<Vec4>>,
    indices: Vec<u32>,
}

impl Mesh {
    /// Checks the lists and completes them.
    ///
    /// Missing normals (or those of length zero) become smooth ones: the sum of the area-weighted face normals around the
    /// position, also across texture seams. Missing tangents come from the derivatives of the texture coordinates. Given
    /// vectors are normalised and made orthogonal: normals first, then the tangent, then the bitangent, which keeps only its side.
    ///
    /// # Errors
    /// Lists of unequal length, indices out of range or not a multiple of three, values that are not finite, too many
    /// vertices or triangles.
    pub fn new(data: MeshData) -> Result<Self, MeshError> {
        let MeshData {
            positions,
            mut normals,
            tangents,
            bitangents,
            mut texcoords,
            mut colors,
            mut more,
            indices,
        } = data;
        let count = positions.len();
        check_size(count, indices.len())?;
        if !indices.len().is_multiple_of(3) {
            return Err(MeshError::IndexCount(indices.len()));
        }
        if let Some((at, &index)) = indices
            .iter()
            .enumerate()
            .find(|(_, i)| **i as usize >= count)
        {
            return Err(MeshError::IndexRange {
                at,
                index,
                vertices: count,
            });
        }
        check(Attribute::Position, &positions, count, |p| p.is_finite())?;
        if normals.is_empty() {
            normals = vec![Vec3::ZERO; count];
        }
        if texcoords.is_empty() {
            texcoords = vec![Vec2::ZERO; count];
        }
        if colors.is_empty() {
            colors = vec![Vec4::ONE; count];
        }
        check(Attribute::Normal, &normals, count, |n| n.is_finite())?;
        check(Attribute::Texcoord, &texcoords, count, |t| t.is_finite())?;
        check(Attribute::Color, &colors, count, |c| c.is_finite())?;
        more.retain(|attribute, values| attribute.is_further() && !values.is_empty());
        for (attribute, values) in &more {
            check(*attribute, values, count, |v| v.is_finite())?;
        }
        frame::complete_normals(&positions, &indices, &mut normals);
        let (tangents, bitangents) = if tangents.is_empty() {
            frame::from_texcoords(&positions, &normals, &texcoords, &indices)
        } else {
            check(Attribute::Tangent, &tangents, count, |t| t.is_finite())?;
            if !bitangents.is_empty() {
                check(Attribute::Bitangent, &bitangents, count, |t| t.is_finite())?;
            }
            frame::orthonormal(&normals, &tangents, &bitangents)
        };
        Ok(Self {
            positions,
            normals,
            tangents,
            bitangents,
            texcoords,
            colors,
            more,
            indices,
        })
    }

    /// How many vertices there are.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// How many triangles there are.
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }

    /// Positions, one a vertex.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Unit normals, one a vertex.
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Unit tangents (direction of increasing u), one a vertex.
    pub fn tangents(&self) -> &[Vec3] {
        &self.tangents
    }

    /// Unit bitangents (direction of increasing v), one a vertex.
    pub fn bitangents(&self) -> &[Vec3] {
        &self.bitangents
    }

    /// Texture coordinates, one a vertex.
    pub fn texcoords(&self) -> &[Vec2] {
        &self.texcoords
    }

    /// Colours, one a vertex; white unless given.
    pub fn colors(&self) -> &[Vec4] {
        &self.colors
    }

    /// Three indices a triangle, each smaller than [`Mesh::vertex_count`].
    pub fn indices(&self) -> &[u32] {
        &self.indices
    }

    /// The attribute of a vertex as a vertex register holds it: what the mesh does not store is filled up from
    /// (0, 0, 0, 1), as Direct3D does for streams of fewer components. `None` if there is no such vertex.
    pub fn value(&self, attribute: Attribute, vertex: usize) -> Option<Vec4> {
        match attribute {
            Attribute::Position => self.positions.get(vertex).map(|p| p.extend(1.0)),
            Attribute::Normal => self.normals.get(vertex).map(|n| n.extend(1.0)),
            Attribute::Tangent => self.tangents.get(vertex).map(|t| t.extend(1.0)),
            Attribute::Bitangent => self.bitangents.get(vertex).map(|b| b.extend(1.0)),
            Attribute::Texcoord => self.texcoords.get(vertex).map(|t| {
                let rest = self.further(attribute, vertex).unwrap_or(Vec4::W);
                Vec4::new(t.x, t.y, rest.z, rest.w)
            }),
            Attribute::Color => self.colors.get(vertex).copied(),
            Attribute::Specular => self
                .further(attribute, vertex)
                .or_else(|| self.colors.get(vertex).map(|_| Vec4::ZERO)),
            _ => self
                .further(attribute, vertex)
                .or_else(|| self.value(Attribute::Texcoord, vertex)),
        }
    }

    fn further(&self, attribute: Attribute, vertex: usize) -> Option<Vec4> {
        self.more.get(&attribute)?.get(vertex).copied()
    }

    /// [`Mesh::value`] of every vertex, in order.
    pub fn stream(&self, attribute: Attribute) -> Vec<Vec4> {
        (0..self.vertex_count())
            .filter_map(|i| self.value(attribute, i))
            .collect()
    }

    /// The mesh moved by an affine matrix (column vectors, `glam`'s own convention; a projective last row is ignored).
    ///
    /// Normals follow the inverse transpose. A matrix that mirrors also turns the triangles round, so that the front stays
    /// the outside; the texture is then mirrored.
    ///
    /// # Errors
    /// A singular or non-finite matrix, or positions that leave the range of `f32`.
    pub fn transformed(&self, matrix: Mat4) -> Result<Self, MeshError> {
        let linear = Mat3::from_mat4(matrix);
        let determinant = linear.determinant();
        let normal_matrix = linear.inverse().transpose();
        if !matrix.is_finite() || determinant == 0.0 || !normal_matrix.is_finite() {
            return Err(MeshError::Singular);
        }
        let mut indices = self.indices.clone();
        if determinant < 0.0 {
            for triangle in indices.chunks_exact_mut(3) {
                triangle.swap(1, 2);
            }
        }
        Self::new(MeshData {
            positions: self
                .positions
                .iter()
                .map(|p| matrix.transform_point3(*p))
                .collect(),
            normals: self.normals.iter().map(|n| normal_matrix * *n).collect(),
            tangents: self.tangents.iter().map(|t| linear * *t).collect(),
            bitangents: self.bitangents.iter().map(|b| linear * *b).collect(),
            texcoords: self.texcoords.clone(),
            colors: self.colors.clone(),
            more: self.more.clone(),
            indices,
        })
    }

    /// The mesh with every texture coordinate multiplied by `scale` and then moved by `offset`: how a texture is repeated
    /// over a wall, or a part of a mesh laid into a region of an atlas. A negative scale mirrors and turns the tangents round.
    ///
    /// # Errors
    /// A scale of zero, or coordinates that are not finite.
    pub fn with_texcoords(&self, scale: Vec2, offset: Vec2) -> Result<Self, MeshError> {
        if scale.x == 0.0 || scale.y == 0.0 {
            return Err(MeshError::Parameter {
                shape: "mesh",
                name: "scale",
                rule: "must not be zero".to_owned(),
            });
        }
        let mut mesh = self.clone();
        for texcoord in &mut mesh.texcoords {
            *texcoord = *texcoord * scale + offset;
        }
        check(
            Attribute::Texcoord,
            &mesh.texcoords,
            mesh.positions.len(),
            |t| t.is_finite(),
        )?;
        for (list, sign) in [
            (&mut mesh.tangents, scale.x.signum()),
            (&mut mesh.bitangents, scale.y.signum()),
        ] {
            for vector in list {
                *vector *= sign;
            }
        }
        Ok(mesh)
    }

    /// The mesh with one colour (red, green, blue, alpha; not clamped) at every vertex.
    ///
    /// # Errors
    /// A colour that is not finite.
    pub fn with_color(&self, color: Vec4) -> Result<Self, MeshError> {
        if !color.is_finite() {
            return Err(MeshError::NotFinite {
                attribute: Attribute::Color,
                vertex: 0,
            });
        }
        let mut mesh = self.clone();
        mesh.colors.fill(color);
        Ok(mesh)
    }

    /// One mesh that holds all triangles of the parts, in order. Nothing is welded.
    ///
    /// # Errors
    /// More vertices or triangles together than a mesh may have.
    pub fn merge<'a>(parts: impl IntoIterator<Item = &'a Self>) -> Result<Self, MeshError> {
        let mut whole = Self {
            positions: Vec::new(),
            normals: Vec::new(),
            tangents: Vec::new(),
            bitangents: Vec::new(),
            texcoords: Vec::new(),
            colors: Vec::new(),
            more: BTreeMap::new(),
            indices: Vec::new(),
        };
        let parts: Vec<&Self> = parts.into_iter().collect();
        let further: BTreeSet<Attribute> = parts
            .iter()
            .flat_map(|part| part.more.keys().copied())
            .collect();
        for part in parts {
            let base = whole.positions.len();
            check_size(
                base + part.positions.len(),
                whole.indices.len() + part.indices.len(),
            )?;
            // Never past the range: MAX_VERTICES is far below 2³².
            let base = base as u32;
            whole.positions.extend_from_slice(&part.positions);
            whole.normals.extend_from_slice(&part.normals);
            whole.tangents.extend_from_slice(&part.tangents);
            whole.bitangents.extend_from_slice(&part.bitangents);
            whole.texcoords.extend_from_slice(&part.texcoords);
            whole.colors.extend_from_slice(&part.colors);
            for attribute in &further {
                let values = whole.more.entry(*attribute).or_default();
                values.extend(part.stream(*attribute));
            }
            whole.indices.extend(part.indices.iter().map(|i| i + base));
        }
        Ok(whole)
    }
}

fn check_size(vertices: usize, indices: usize) -> Result<(), MeshError> {
    for (what, found, limit) in [
        ("vertices", vertices, MAX_VERTICES),
        ("triangles", indices / 3, MAX_TRIANGLES),
    ] {
        if found > limit {
            return Err(MeshError::TooMany { what, found, limit });
        }
    }
    Ok(())
}

fn check<T>(
    attribute: Attribute,
    values: &[T],
    expected: usize,
    finite: impl Fn(&T) -> bool,
) -> Result<(), MeshError> {
    if values.len() != expected {
        return Err(MeshError::Length {
            attribute,
            expected,
            found: values.len(),
        });
    }
    match values.iter().position(|v| !finite(v)) {
        Some(vertex) => Err(MeshError::NotFinite { attribute, vertex }),
        None => Ok(()),
    }
}
