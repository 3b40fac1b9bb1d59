//! From a row of vertices, or of indices into them, to points, lines and triangles.

use std::fmt;

use super::names::named;

named! {
    /// `D3DPRIMITIVETYPE`: how vertices make up primitives.
    Topology, "topology" {
        /// Each vertex is a point.
        PointList = 1 "pointlist",
        /// Each two vertices are a line.
        LineList = 2 "linelist",
        /// Each vertex is joined to the one before it.
        LineStrip = 3 "linestrip",
        /// Each three vertices are a triangle.
        TriangleList = 4 "trianglelist",
        /// Triangle i is i, i+1, i+2, and for odd i: i, i+2, i+1, so that all wind the same way.
        TriangleStrip = 5 "trianglestrip",
        /// Triangle i is i+1, i+2, 0: flat shading takes vertex i+1, as Direct3D orders a fan.
        TriangleFan = 6 "trianglefan",
    }
}

/// Why a draw call was refused.
#[derive(Debug, Clone, PartialEq)]
pub enum DrawError {
    /// An index that names no vertex.
    IndexOutOfRange {
        /// Where in the row of indices.
        position: usize,
        /// The index.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// More vertices than an index can name.
    TooManyVertices {
        /// How many there are.
        vertices: usize,
    },
    /// A viewport whose depth range is not made of numbers.
    ViewportDepth {
        /// Its nearer end.
        min_z: f32,
        /// Its farther end.
        max_z: f32,
    },
}

impl fmt::Display for DrawError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::IndexOutOfRange {
                position,
                index,
                vertices,
            } => write!(
                f,
                "index {index} at position {position} is outside the {vertices} vertices"
            ),
            Self::TooManyVertices { vertices } => {
                write!(
                    f,
                    "{vertices} vertices are more than a 32-bit index can name"
                )
            }
            Self::ViewportDepth { min_z, max_z } => {
                write!(
                    f,
                    "the viewport's depth range from {min_z} to {max_z} is not a range of numbers"
                )
            }
        }
    }
}

impl std::error::Error for DrawError {}

/// The primitives of a draw call. Vertices left over at the end make none.
pub(super) struct Primitives<'a> {
    topology: Topology,
    indices: Option<&'a [u32]>,
    vertices: usize,
}

impl<'a> Primitives<'a> {
    /// Checks every index once, so that none has to be doubted later.
    pub(super) fn new(
        topology: Topology,
        vertices: usize,
        indices: Option<&'a [u32]>,
    ) -> Result<Self, DrawError> {
        if u32::try_from(vertices).is_err() {
            return Err(DrawError::TooManyVertices { vertices });
        }
        let out_of_range = |index: &u32| *index as usize >= vertices;
        if let Some(indices) = indices
            && let Some(position) = indices.iter().position(out_of_range)
        {
            return Err(DrawError::IndexOutOfRange {
                position,
                index: indices[position],
                vertices,
            });
        }
        Ok(Self {
            topology,
            indices,
            vertices,
        })
    }

    /// How many primitives there are.
    pub(super) fn len(&self) -> usize {
        let corners = self.indices.map_or(self.vertices, <[u32]>::len);
        match self.topology {
            Topology::PointList => corners,
            Topology::LineList => corners / 2,
            Topology::LineStrip => corners.saturating_sub(1),
            Topology::TriangleList => corners / 3,
            Topology::TriangleStrip | Topology::TriangleFan => corners.saturating_sub(2),
        }
    }

    /// The vertices of primitive `i`, which must be less than [`Self::len`]. A line repeats its last, a point its only one.
    #[inline(always)]
    pub(super) fn get(&self, i: usize) -> [u32; 3] {
        let corners = match self.topology {
            Topology::PointList => [i, i, i],
            Topology::LineList => [2 * i, 2 * i + 1, 2 * i + 1],
            Topology::LineStrip => [i, i + 1, i + 1],
            Topology::TriangleList => [3 * i, 3 * i + 1, 3 * i + 2],
            Topology::TriangleStrip if i % 2 == 1 => [i, i + 2, i + 1],
            Topology::TriangleStrip => [i, i + 1, i + 2],
            Topology::TriangleFan => [i + 1, i + 2, 0],
        };
        corners.map(|corner| match self.indices {
            Some(indices) => indices[corner],
            None => corner as u32,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(topology: Topology, vertices: usize, indices: Option<&[u32]>) -> Vec<[u32; 3]> {
        let primitives = Primitives::new(topology, vertices, indices).unwrap();
        (0..primitives.len()).map(|i| primitives.get(i)).collect()
    }

    #[test]
    fn vertices_are_grouped_as_direct3d_does() {
        assert_eq!(all(Topology::TriangleList, 7, None), [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(
            all(Topology::TriangleStrip, 5, None),
            [[0, 1, 2], [1, 3, 2], [2, 3, 4]]
        );
        assert_eq!(all(Topology::TriangleFan, 4, None), [[1, 2, 0], [2, 3, 0]]);
        assert_eq!(all(Topology::LineStrip, 3, None), [[0, 1, 1], [1, 2, 2]]);
        assert_eq!(all(Topology::LineList, 5, None), [[0, 1, 1], [2, 3, 3]]);
        assert_eq!(all(Topology::PointList, 2, None), [[0; 3], [1; 3]]);
        assert_eq!(
            all(Topology::TriangleList, 9, Some(&[8, 0, 4])),
            [[8, 0, 4]]
        );
        for topology in Topology::ALL {
            assert!(all(*topology, 0, None).is_empty());
        }
    }

    #[test]
    fn an_index_beyond_the_vertices_is_refused() {
        let result = Primitives::new(Topology::TriangleList, 3, Some(&[0, 1, 3]));
        assert_eq!(
            result.err(),
            Some(DrawError::IndexOutOfRange {
                position: 2,
                index: 3,
                vertices: 3
            })
        );
    }
}
