//! Which faces of a cube the lanes meet.

use crate::texture::cube::CUBE_FACES;

/// Where directions meet the faces.
#[derive(Clone, Debug)]
pub(super) struct Met<const N: usize> {
    pub(super) face: [u32; N],
    /// In the face, 0 to 1.
    pub(super) u: [f32; N],
    pub(super) v: [f32; N],
}

impl<const N: usize> Default for Met<N> {
    fn default() -> Self {
        Self {
            face: [0; N],
            u: [0.0; N],
            v: [0.0; N],
        }
    }
}

/// As [`direction_to_face`](crate::texture::direction_to_face). Lanes without a direction are marked as odd, and if
/// derivatives are wanted, which are those of one plane, so are lanes of quads that meet several faces.
#[inline(always)]
pub(super) fn find<const N: usize>(
    met: &mut Met<N>,
    coords: [&[f32; N]; 3],
    odd: &mut [u32; N],
    derivatives: bool,
) {
    let [x, y, z] = coords;
    for l in 0..N {
        let direction = [x[l], y[l], z[l]];
        let [x, y, z] = direction.map(f32::abs);
        let on_z = (z >= y) & (z >= x);
        let on_y = y >= x;
        let axis = if on_z { 2 } else { u32::from(on_y) };
        let largest = if on_z {
            z
        } else if on_y {
            y
        } else {
            x
        };
        let along = if on_z {
            direction[2]
        } else if on_y {
            direction[1]
        } else {
            direction[0]
        };
        let face = axis * 2 + u32::from(along < 0.0);
        let (mut sc, mut tc) = (0.0, 0.0);
        for (number, axes) in (0..).zip(&CUBE_FACES) {
            sc = if face == number {
                axes.sc.of(direction)
            } else {
                sc
            };
            tc = if face == number {
                axes.tc.of(direction)
            } else {
                tc
            };
        }
        met.face[l] = face;
        met.u[l] = (sc / largest + 1.0) / 2.0;
        met.v[l] = (tc / largest + 1.0) / 2.0;
        // NaN and infinity too, wherever they are.
        let sum = x + y + z;
        odd[l] |= (u32::from(sum < f32::INFINITY) ^ 1) | u32::from(largest == 0.0);
    }
    if derivatives {
        let quads = met.face.as_chunks::<4>().0.iter();
        for (face, odd) in quads.zip(odd.as_chunks_mut::<4>().0) {
            let [a, b, c, d] = *face;
            let several = (a ^ b) | (a ^ c) | (a ^ d);
            for odd in odd {
                *odd |= several;
            }
        }
    }
}
