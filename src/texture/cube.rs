//! The faces of a cube texture: which face a direction meets, and where.

use super::sample::finite;

/// One of the six axis directions: component `axis` (0 x, 1 y, 2 z), negated if `negative`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SignedAxis {
    /// 0, 1 or 2.
    pub axis: usize,
    /// Whether the direction points down the axis.
    pub negative: bool,
}

/// The directions in which a face's coordinates grow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FaceAxes {
    /// To the right in the face.
    pub sc: SignedAxis,
    /// Down in the face.
    pub tc: SignedAxis,
    /// Out of the cube through the face.
    pub ma: SignedAxis,
}

const fn plus(axis: usize) -> SignedAxis {
    SignedAxis {
        axis,
        negative: false,
    }
}
const fn minus(axis: usize) -> SignedAxis {
    SignedAxis {
        axis,
        negative: true,
    }
}

/// Direct3D's faces +X, −X, +Y, −Y, +Z, −Z: a face's texel is met by `sc`, `tc` (each over `ma`) from −1 to 1.
pub const CUBE_FACES: [FaceAxes; 6] = [
    FaceAxes {
        sc: minus(2),
        tc: minus(1),
        ma: plus(0),
    },
    FaceAxes {
        sc: plus(2),
        tc: minus(1),
        ma: minus(0),
    },
    FaceAxes {
        sc: plus(0),
        tc: plus(2),
        ma: plus(1),
    },
    FaceAxes {
        sc: plus(0),
        tc: minus(2),
        ma: minus(1),
    },
    FaceAxes {
        sc: plus(0),
        tc: minus(1),
        ma: plus(2),
    },
    FaceAxes {
        sc: minus(0),
        tc: minus(1),
        ma: minus(2),
    },
];

impl SignedAxis {
    /// The component of `vector` along this direction.
    #[inline(always)]
    pub(super) fn of<T: Copy + std::ops::Neg<Output = T>>(self, vector: [T; 3]) -> T {
        let value = vector[self.axis];
        if self.negative { -value } else { value }
    }

    /// Sets the component along this direction.
    #[inline(always)]
    fn set<T: std::ops::Neg<Output = T>>(self, vector: &mut [T; 3], value: T) {
        vector[self.axis] = if self.negative { -value } else { value };
    }
}

/// The face (0 to 5) that a direction meets, and u, v (0 to 1, v down) in it.
///
/// The component of largest magnitude decides; among equals z comes before y and y before x. The zero vector is taken
/// as the middle of +Z. A NaN component counts as 0, an infinite one as the largest finite number.
#[inline]
pub fn direction_to_face(direction: [f32; 3]) -> (usize, [f32; 2]) {
    let direction = direction.map(finite);
    let [x, y, z] = direction.map(f32::abs);
    let axis = if z >= y && z >= x {
        2
    } else if y >= x {
        1
    } else {
        0
    };
    let face = axis * 2 + usize::from(direction[axis] < 0.0);
    let axes = &CUBE_FACES[face];
    let ma = axes.ma.of(direction);
    if ma == 0.0 {
        return (face, [0.5; 2]);
    }
    let [sc, tc] = [axes.sc, axes.tc].map(|axis| axis.of(direction) / ma);
    (face, [(sc + 1.0) / 2.0, (tc + 1.0) / 2.0])
}

/// The direction through u, v (0 to 1, v down) of a face (0 to 5, others wrap), not normalised: its largest component is ±1.
pub fn face_to_direction(face: usize, [u, v]: [f32; 2]) -> [f32; 3] {
    let axes = &CUBE_FACES[face % 6];
    let mut direction = [0.0; 3];
    axes.sc.set(&mut direction, 2.0 * u - 1.0);
    axes.tc.set(&mut direction, 2.0 * v - 1.0);
    axes.ma.set(&mut direction, 1.0);
    direction
}

/// Where a direction meets the plane of a face that it may miss, in u, v; for the derivatives of a quad whose pixels
/// fall on several faces. A direction beside or behind the plane is bent so that it meets it, 2^20 faces away at most.
pub(super) fn project_onto(face: usize, direction: [f32; 3]) -> [f32; 2] {
    let axes = &CUBE_FACES[face];
    let direction = direction.map(finite);
    let largest = direction.map(f32::abs).into_iter().fold(0.0, f32::max);
    let ma = axes.ma.of(direction).max(largest / 1_048_576.0);
    if ma == 0.0 {
        return [0.5; 2];
    }
    [axes.sc, axes.tc].map(|axis| (axis.of(direction) / ma + 1.0) / 2.0)
}

/// The texels that stand for one outside a face of `n`×`n` texels: one across an edge, three around a corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct AcrossEdge {
    places: [(usize, [usize; 2]); 3],
    count: usize,
}

impl AcrossEdge {
    /// Face and x, y of each.
    #[inline]
    pub(super) fn places(&self) -> &[(usize, [usize; 2])] {
        &self.places[..self.count]
    }
}

/// The texel (`x`, `y`) of a face, each −1 to n, looked up across the edge of the face where it lies outside.
pub(super) fn across_edge(face: usize, [x, y]: [i32; 2], n: i32) -> AcrossEdge {
    let inside = |i: i32| i.clamp(0, n - 1);
    let outside = |i: i32| i != inside(i);
    let own = (face, [inside(x) as usize, inside(y) as usize]);
    match (outside(x), outside(y)) {
        (false, false) => AcrossEdge {
            places: [own; 3],
            count: 1,
        },
        (true, false) | (false, true) => AcrossEdge {
            places: [neighbour(face, [x, y], n); 3],
            count: 1,
        },
        (true, true) => {
            let beside = neighbour(face, [x, inside(y)], n);
            let above = neighbour(face, [inside(x), y], n);
            AcrossEdge {
                places: [own, beside, above],
                count: 3,
            }
        }
    }
}

/// The direction through the centre of a texel just outside one edge, projected onto the face that it meets. In whole
/// numbers (a face is 2n wide, its plane n away): in floats the row next to the edge could be missed on large faces.
fn neighbour(face: usize, [x, y]: [i32; 2], n: i32) -> (usize, [usize; 2]) {
    let n = i64::from(n);
    let centre = |i: i32| 2 * i64::from(i) + 1 - n;
    let axes = &CUBE_FACES[face];
    let mut direction = [0i64; 3];
    axes.sc.set(&mut direction, centre(x));
    axes.tc.set(&mut direction, centre(y));
    axes.ma.set(&mut direction, n);
    // Only the outer coordinate is larger than n, so that the largest is never shared.
    let axis = (0..3)
        .max_by_key(|&axis| direction[axis].abs())
        .unwrap_or(0);
    let target = axis * 2 + usize::from(direction[axis] < 0);
    let axes = &CUBE_FACES[target];
    let ma = axes.ma.of(direction);
    let place = [axes.sc, axes.tc].map(|axis| {
        let texel = (axis.of(direction) + ma) * n / (2 * ma);
        texel.clamp(0, n - 1) as usize
    });
    (target, place)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions and results worked out from the table of section 8 of the specification.
    #[test]
    fn six_faces() {
        let cases = [
            // +X: sc = −rz = 0.5, tc = −ry = −0.25.
            ([1.0, 0.25, -0.5], 0, [0.75, 0.375]),
            // −X: sc = +rz, tc = −ry.
            ([-1.0, 0.25, -0.5], 1, [0.25, 0.375]),
            // +Y: sc = +rx, tc = +rz.
            ([0.25, 1.0, -0.5], 2, [0.625, 0.25]),
            // −Y: sc = +rx, tc = −rz.
            ([0.25, -1.0, -0.5], 3, [0.625, 0.75]),
            // +Z: sc = +rx, tc = −ry. Twice the length changes nothing.
            ([0.5, -1.0, 2.0], 4, [0.625, 0.75]),
            // −Z: sc = −rx, tc = −ry.
            ([0.5, -1.0, -2.0], 5, [0.375, 0.75]),
        ];
        for (direction, face, place) in cases {
            assert_eq!(direction_to_face(direction), (face, place), "{direction:?}");
            let back = face_to_direction(face, place);
            let scale = direction.map(f32::abs).into_iter().fold(0.0, f32::max);
            assert_eq!(back.map(|c| c * scale), direction);
        }
    }

    #[test]
    fn ties_prefer_z_then_y() {
        assert_eq!(direction_to_face([1.0, 1.0, 1.0]).0, 4);
        assert_eq!(direction_to_face([-1.0, -1.0, -1.0]).0, 5);
        assert_eq!(direction_to_face([1.0, -1.0, 0.5]).0, 3);
        assert_eq!(direction_to_face([1.0, 0.5, -1.0]).0, 5);
        assert_eq!(direction_to_face([0.0, 0.0, 0.0]), (4, [0.5, 0.5]));
    }

    #[test]
    fn nan_counts_as_zero_and_infinity_as_large() {
        assert_eq!(direction_to_face([f32::NAN, 2.0, 1.0]), (2, [0.5, 0.75]));
        assert_eq!(
            direction_to_face([f32::NEG_INFINITY, 2.0, 1.0]),
            (1, [0.5, 0.5])
        );
        // Two infinite components are equal: z wins, sc = 1.
        assert_eq!(
            direction_to_face([f32::INFINITY, 0.0, f32::INFINITY]),
            (4, [1.0, 0.5])
        );
    }

    #[test]
    fn neighbours_across_edges() {
        // Right of +Z (its right edge is +X): the left column of +X, same row, since both run along −y.
        assert_eq!(across_edge(4, [8, 3], 8).places(), &[(0, [0, 3])]);
        // Left of +Z: the right column of −X.
        assert_eq!(across_edge(4, [-1, 3], 8).places(), &[(1, [7, 3])]);
        // Above +Z: the lower row of +Y, same column.
        assert_eq!(across_edge(4, [3, -1], 8).places(), &[(2, [3, 7])]);
        // Above +X: +Y's right column; +X runs to the right along −z, +Y down along +z: backwards.
        assert_eq!(across_edge(0, [2, -1], 8).places(), &[(2, [7, 5])]);
        // Above −Z: the upper row of +Y, columns backwards.
        assert_eq!(across_edge(5, [2, -1], 8).places(), &[(2, [5, 0])]);
        // The corner of +Z, right and above: its own texel, +X's and +Y's.
        assert_eq!(
            across_edge(4, [8, -1], 8).places(),
            &[(4, [7, 0]), (0, [0, 0]), (2, [7, 7])]
        );
        assert_eq!(across_edge(4, [2, 2], 8).places(), &[(4, [2, 2])]);
    }

    #[test]
    fn every_edge_leads_back_where_it_came_from() {
        for n in [1, 2, 3, 16384] {
            for face in 0..6 {
                for i in [0, 1, n / 2, n - 1] {
                    let i = i.min(n - 1);
                    for (place, own) in [
                        ([-1, i], [0, i]),
                        ([n, i], [n - 1, i]),
                        ([i, -1], [i, 0]),
                        ([i, n], [i, n - 1]),
                    ] {
                        let [(other, [x, y])] = *across_edge(face, place, n).places() else {
                            panic!()
                        };
                        assert_ne!(other / 2, face / 2);
                        let (x, y) = (x as i32, y as i32);
                        let back = [[-1, y], [n, y], [x, -1], [x, n]].into_iter().any(|step| {
                            let near = step[0].abs_diff(x) + step[1].abs_diff(y) == 1;
                            near && across_edge(other, step, n).places()
                                == [(face, own.map(|c| c as usize))]
                        });
                        assert!(back, "face {face} n {n} {place:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn projections_onto_a_missed_face_stay_finite() {
        for direction in [
            [1.0, 0.0, 0.0],
            [0.0, 0.0, -1.0],
            [f32::MAX, 1.0, f32::MAX],
            [0.0; 3],
            [1e-45, 0.0, 0.0],
        ] {
            assert!(
                project_onto(4, direction).into_iter().all(|c| !c.is_nan()),
                "{direction:?}"
            );
        }
        // On the face it is the same as the face's own coordinate.
        assert_eq!(project_onto(4, [0.5, -1.0, 2.0]), [0.625, 0.75]);
        // A neighbour's direction at 45° and more: sc/ma = 3/1 → u = 2.
        assert_eq!(project_onto(4, [3.0, 0.0, 1.0]), [2.0, 0.5]);
    }
}
