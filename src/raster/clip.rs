//! Clipping in clip space, before the division by w.
//!
//! Near, far and user planes are exact. In x and y only a guard band is clipped, far outside of any target: what lies
//! between the viewport's edge and the band is left to the scissor, so that shared edges keep their end points.

use glam::Vec4;

use super::pixel::LANES;
use super::state::Viewport;
use super::vertices::Row;

/// How far from the origin screen coordinates may be, in pixels.
///
/// Twice the largest target; and small enough that the edge functions of `setup` cannot overflow.
pub(super) const GUARD: f64 = 32768.0;

/// The smallest w that is kept. Its size does not matter: together with the guard band nothing of positive size on the
/// screen comes so near the eye.
const SMALLEST_W: f64 = 1e-30;

/// The shares of a primitive's own vertices, in order.
pub(super) const SHARES: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];

/// A corner of what is left after clipping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ClipVertex {
    /// In clip space.
    pub(super) position: [f64; 4],
    /// The share of the second and of the third vertex of the primitive; the rest is the first's.
    pub(super) shares: [f64; 2],
    /// Whether it is a vertex of the primitive, not a cut.
    pub(super) original: bool,
}

/// A half-space of clip space: dot product plus offset is at least 0.
#[derive(Debug, Clone, Copy)]
struct Plane {
    normal: [f64; 4],
    offset: f64,
}

impl Plane {
    #[inline(always)]
    fn distance(&self, p: &[f64; 4]) -> f64 {
        let n = &self.normal;
        n[0] * p[0] + n[1] * p[1] + n[2] * p[2] + n[3] * p[3] + self.offset
    }
}

/// The planes of a draw call.
pub(super) struct Clipper {
    planes: Vec<Plane>,
    /// Whether nothing is cut off what lies within the view: there are no planes of the user's.
    keeps_view: bool,
}

impl Clipper {
    /// Of [`Self::outside`]: a position that is not finite. There are at most 7 + 6 planes.
    pub(super) const BROKEN: u16 = 1 << 15;

    pub(super) fn new(viewport: &Viewport, user: &[Option<Vec4>]) -> Self {
        let through_origin = |normal| Plane {
            normal,
            offset: 0.0,
        };
        let (half_width, half_height) = (
            f64::from(viewport.width) / 2.0,
            f64::from(viewport.height) / 2.0,
        );
        let center_x = f64::from(viewport.x) + half_width;
        let center_y = f64::from(viewport.y) + half_height;
        let mut planes = vec![
            Plane {
                normal: [0.0, 0.0, 0.0, 1.0],
                offset: -SMALLEST_W,
            },
            through_origin([0.0, 0.0, 1.0, 0.0]),
            through_origin([0.0, 0.0, -1.0, 1.0]),
            // The guard band: the viewport transform, solved for -GUARD ≤ screen ≤ GUARD.
            through_origin([half_width, 0.0, 0.0, GUARD + center_x]),
            through_origin([-half_width, 0.0, 0.0, GUARD - center_x]),
            through_origin([0.0, -half_height, 0.0, GUARD + center_y]),
            through_origin([0.0, half_height, 0.0, GUARD - center_y]),
        ];
        let keeps_view = user.iter().all(Option::is_none)
            && half_width.max(half_height) <= GUARD - center_x.max(center_y);
        planes.extend(
            user.iter()
                .flatten()
                .map(|plane| through_origin(plane.to_array().map(f64::from))),
        );
        Self { planes, keeps_view }
    }

    /// On which planes' outer sides the vertices of a block are, a bit a plane, from their x, y, z and w; [`Self::BROKEN`] of
    /// positions that are not finite. What has no bit at any of its vertices is kept by [`Self::clip`] as it is, and nothing
    /// is of what has the same one at all of them.
    #[inline(always)]
    pub(super) fn outside(&self, positions: &[Row; 4]) -> [u16; LANES] {
        let [xs, ys, zs, ws] = positions;
        let mut outside = [0; LANES];
        for lane in 0..LANES {
            let of = [xs[lane], ys[lane], zs[lane], ws[lane]];
            let finite =
                of[0].is_finite() & of[1].is_finite() & of[2].is_finite() & of[3].is_finite();
            outside[lane] = if finite { 0 } else { Self::BROKEN };
        }
        for (number, plane) in self.planes.iter().enumerate() {
            let bit = 1 << number;
            for lane in 0..LANES {
                let of = [xs[lane], ys[lane], zs[lane], ws[lane]];
                // A plane of NaN keeps nothing.
                let inside = plane.distance(&of.map(f64::from)) >= 0.0;
                outside[lane] |= if inside { 0 } else { bit };
            }
        }
        outside
    }

    /// What is left of a primitive: its corners in order, none if nothing is. One corner is a point, two are a line, three
    /// a triangle. Positions that are not finite leave nothing.
    pub(super) fn clip(&self, corners: &[Vec4], kept: &mut Vec<ClipVertex>) {
        kept.clear();
        if corners.iter().any(|corner| !corner.is_finite()) {
            return;
        }
        kept.extend(
            corners
                .iter()
                .zip(SHARES)
                .map(|(corner, shares)| ClipVertex {
                    position: corner.to_array().map(f64::from),
                    shares,
                    original: true,
                }),
        );
        // Most primitives lie within the view. A NaN does not.
        let in_view = |p: &Vec4| {
            p.x.abs() <= p.w
                && p.y.abs() <= p.w
                && p.z >= 0.0
                && p.z <= p.w
                && f64::from(p.w) >= SMALLEST_W
        };
        if self.keeps_view && corners.iter().all(in_view) {
            return;
        }
        for plane in &self.planes {
            let inside = |corner: &ClipVertex| plane.distance(&corner.position) >= 0.0;
            if !kept.iter().all(inside) {
                *kept = cut(kept, plane);
            }
        }
    }
}

/// The part of a polygon, a line or a point on the inner side of a plane.
fn cut(corners: &[ClipVertex], plane: &Plane) -> Vec<ClipVertex> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (i, corner) in corners.iter().enumerate() {
        let distance = plane.distance(&corner.position);
        if distance >= 0.0 {
            kept.push(*corner);
        }
        // A line has one edge only, where a polygon returns to its first corner.
        let next = match corners.get(i + 1) {
            Some(next) => next,
            None if corners.len() > 2 => &corners[0],
            None => break,
        };
        let next_distance = plane.distance(&next.position);
        // From the inner to the outer end, whichever comes first: the neighbour on the other side of an edge walks it the
        // other way round and must find the same point.
        if distance >= 0.0 && next_distance < 0.0 {
            kept.push(between(corner, next, distance / (distance - next_distance)));
        } else if distance < 0.0 && next_distance >= 0.0 {
            kept.push(between(
                next,
                corner,
                next_distance / (next_distance - distance),
            ));
        }
    }
    kept
}

fn between(from: &ClipVertex, to: &ClipVertex, t: f64) -> ClipVertex {
    let mix = |a: f64, b: f64| a + (b - a) * t;
    ClipVertex {
        position: std::array::from_fn(|i| mix(from.position[i], to.position[i])),
        shares: std::array::from_fn(|i| mix(from.shares[i], to.shares[i])),
        original: false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clip(clipper: &Clipper, corners: &[Vec4]) -> Vec<ClipVertex> {
        let mut kept = Vec::new();
        clipper.clip(corners, &mut kept);
        kept
    }

    fn clipper() -> Clipper {
        Clipper::new(&Viewport::full(64, 64), &[])
    }

    #[test]
    fn what_is_inside_stays_as_it_is() {
        let corners = [
            Vec4::new(0.0, 0.0, 0.5, 1.0),
            Vec4::new(9.0, 0.0, 0.5, 1.0),
            Vec4::new(0.0, 9.0, 0.5, 1.0),
        ];
        let kept = clip(&clipper(), &corners);
        assert_eq!(kept.len(), 3);
        assert_eq!(kept[2].shares, [0.0, 1.0]);
        assert!(kept.iter().all(|corner| corner.original));
    }

    #[test]
    fn a_line_through_the_near_plane_is_cut_where_z_is_zero() {
        // By hand: z from -1 to 3, so a quarter of the way; x = 1, w = 2 + (6 - 2) / 4 = 3.
        let kept = clip(
            &clipper(),
            &[
                Vec4::new(0.0, 0.0, -1.0, 2.0),
                Vec4::new(4.0, 0.0, 3.0, 6.0),
            ],
        );
        assert_eq!(kept.len(), 2);
        assert_eq!(kept[0].position, [1.0, 0.0, 0.0, 3.0]);
        assert_eq!(kept[0].shares, [0.25, 0.0]);
        assert_eq!(kept[1].shares, [1.0, 0.0]);
    }

    #[test]
    fn one_corner_behind_the_eye_makes_four() {
        let kept = clip(
            &clipper(),
            &[
                Vec4::new(0.0, 1.0, -1.0, -0.5),
                Vec4::new(1.0, -1.0, 0.5, 1.0),
                Vec4::new(-1.0, -1.0, 0.5, 1.0),
            ],
        );
        assert_eq!(kept.len(), 4);
        assert!(
            kept.iter()
                .all(|corner| corner.position[2] >= 0.0 && corner.position[3] > 0.0)
        );
    }

    #[test]
    fn nothing_is_left_of_what_is_outside_or_no_number() {
        let behind = [Vec4::new(0.0, 0.0, 2.0, 1.0); 3];
        assert!(clip(&clipper(), &behind).is_empty());
        assert!(clip(&clipper(), &[Vec4::ZERO; 3]).is_empty());
        assert!(clip(&clipper(), &[Vec4::new(f32::NAN, 0.0, 0.5, 1.0)]).is_empty());
        assert!(clip(&clipper(), &[Vec4::new(0.0, f32::INFINITY, 0.5, 1.0)]).is_empty());
    }

    #[test]
    fn a_user_plane_cuts_in_clip_space() {
        let plane = Some(Vec4::new(1.0, 0.0, 0.0, 0.0));
        let clipper = Clipper::new(&Viewport::full(64, 64), &[None, plane]);
        let kept = clip(
            &clipper,
            &[
                Vec4::new(-1.0, 0.0, 0.5, 1.0),
                Vec4::new(1.0, 0.0, 0.5, 1.0),
            ],
        );
        assert_eq!(kept[0].position, [0.0, 0.0, 0.5, 1.0]);
        // A plane of NaN keeps nothing rather than everything.
        let clipper = Clipper::new(&Viewport::full(64, 64), &[Some(Vec4::NAN)]);
        assert!(clip(&clipper, &[Vec4::new(0.0, 0.0, 0.5, 1.0)]).is_empty());
    }
}
