//! The treasure chest.

use glam::{DVec3, Mat4, Vec2, Vec3};

use super::shape::{Vertex, fraction, segments};
use super::{Cuboid, Mesh, MeshData, MeshError, Plane, Sphere, Torus};

/// The parts of the one texture that the chest wears (`chest` among the texture generators): upper left and lower right
/// corner of each in texture coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ChestRegion {
    /// Planks that lie one above the other, grain along u: the upper half.
    Wood,
    /// Dark iron of bands, rivets and handles: the lower left quarter.
    Iron,
    /// Plain brass.
    Brass,
    /// The lock plate as one upright picture, keyhole included.
    Lock,
    /// The dark gap between body and lid.
    Dark,
}

impl ChestRegion {
    /// Every region.
    pub const ALL: [Self; 5] = [Self::Wood, Self::Iron, Self::Brass, Self::Lock, Self::Dark];

    /// Upper left and lower right corner.
    pub fn corners(self) -> (Vec2, Vec2) {
        let (left, top, right, bottom) = match self {
            Self::Wood => (0.0, 0.0, 1.0, 0.5),
            Self::Iron => (0.0, 0.5, 0.5, 1.0),
            Self::Brass => (0.5, 0.5, 0.75, 0.75),
            Self::Lock => (0.75, 0.5, 1.0, 0.75),
            Self::Dark => (0.5, 0.75, 1.0, 1.0),
        };
        (Vec2::new(left, top), Vec2::new(right, bottom))
    }
}

/// A closed treasure chest: a body of planks, a vaulted lid, iron bands with rivets, corner posts, a brass lock and ring handles.
///
/// It stands on y = 0 around the Y axis and its front, with the lock, faces -Z. It is 1.2 wide, 0.7 deep and 0.77
/// high, fittings apart; scale it with [`Mesh::transformed`]. All vertex colours are white: the parts differ by the region
/// of one texture that they use, see [`ChestRegion`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "scene",
    derive(serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct Chest {
    /// Segments over the vault of the lid, 4 to [`super::MAX_SEGMENTS`]. Default 24.
    pub segments: u32,
    /// Whether there are rivets. Default yes.
    pub rivets: bool,
}

impl Default for Chest {
    fn default() -> Self {
        Self {
            segments: 24,
            rivets: true,
        }
    }
}

const WIDTH: f64 = 1.2;
const DEPTH: f64 = 0.7;
const BODY: f64 = 0.42;
const GAP: f64 = 0.012;
const RIM: f64 = 0.06;
/// Height of the vault above the rim of the lid.
const VAULT: f64 = 0.28;
/// Where the vault begins.
const VAULT_FOOT: f64 = BODY + GAP + RIM;
/// How far level bands stand out.
const BAND: f64 = 0.012;
/// How far the planks end below the bands: planks and band in one plane would fight for each pixel.
const RECESS: f64 = 0.004;
/// How far straps stand out: a little more, so that no strap lies in one plane with a band.
const STRAP: f64 = 0.018;
const STRAP_WIDTH: f64 = 0.08;
/// Middle of the straps, from the middle of the chest to its right end.
const STRAPS: [f64; 4] = [-0.565, -0.24, 0.24, 0.565];

impl Chest {
    /// Makes the mesh.
    ///
    /// # Errors
    /// A field outside its limits.
    pub fn build(&self) -> Result<Mesh, MeshError> {
        let steps = segments("chest", "segments", self.segments, 4)?;
        let mut parts = Parts(Vec::new());
        let half = WIDTH * 0.5;
        parts.block(
            ChestRegion::Wood,
            DVec3::new(0.0, BODY * 0.5, 0.0),
            DVec3::new(WIDTH, BODY - 2.0 * RECESS, DEPTH),
        )?;
        let gap = DVec3::new(WIDTH - 0.03, 0.05, DEPTH - 0.03);
        parts.block(
            ChestRegion::Dark,
            DVec3::new(0.0, BODY + GAP * 0.5, 0.0),
            gap,
        )?;
        for (y, height) in [
            (0.035, 0.07),
            (BODY - 0.025, 0.05),
            (BODY + GAP + RIM * 0.5, RIM),
        ] {
            let size = DVec3::new(WIDTH + 2.0 * BAND, height, DEPTH + 2.0 * BAND);
            parts.block(ChestRegion::Iron, DVec3::new(0.0, y, 0.0), size)?;
        }
        parts.add(
            ChestRegion::Wood,
            Mesh::new(vault(steps, -half, half, 0.0, None))?,
        )?;
        for (i, x) in STRAPS.into_iter().enumerate() {
            let (left, right) = (x - STRAP_WIDTH * 0.5, x + STRAP_WIDTH * 0.5);
            // The outer straps reach round the ends of the chest.
            let outer = i == 0 || i + 1 == STRAPS.len();
            let (grow, inner) = if outer { (STRAP, -0.05) } else { (0.0, 0.0) };
            let (left, right) = (
                left - if i == 0 { grow } else { 0.0 },
                right + if i > 0 { grow } else { 0.0 },
            );
            parts.add(
                ChestRegion::Iron,
                Mesh::new(vault(steps, left, right, STRAP, Some(inner)))?,
            )?;
            let (center, width) = ((left + right) * 0.5, right - left);
            if outer {
                for z in [-1.0, 1.0] {
                    let at =
                        DVec3::new(center, BODY * 0.5, z * (DEPTH * 0.5 + STRAP - width * 0.5));
                    parts.block(
                        ChestRegion::Iron,
                        at,
                        DVec3::new(width, BODY - 0.004, width),
                    )?;
                }
            } else {
                let size = DVec3::new(width, BODY - 0.004, DEPTH + 2.0 * STRAP);
                parts.block(ChestRegion::Iron, DVec3::new(center, BODY * 0.5, 0.0), size)?;
            }
        }
        if self.rivets {
            parts.rivets()?;
        }
        parts.fittings()?;
        Mesh::merge(&parts.0)
    }
}

/// Parts that already carry the texture coordinates of their region.
struct Parts(Vec<Mesh>);

impl Parts {
    /// Adds a part whose texture coordinates run from 0 to 1, laid into its region with a margin against bleeding.
    fn add(&mut self, region: ChestRegion, part: Mesh) -> Result<(), MeshError> {
        let (low, high) = region.corners();
        let margin = (high - low) * 0.02;
        self.0
            .push(part.with_texcoords(high - low - margin * 2.0, low + margin)?);
        Ok(())
    }

    fn placed(&mut self, region: ChestRegion, part: &Mesh, matrix: Mat4) -> Result<(), MeshError> {
        self.add(region, part.transformed(matrix)?)
    }

    fn block(&mut self, region: ChestRegion, center: DVec3, size: DVec3) -> Result<(), MeshError> {
        let part = Cuboid {
            size: size.as_vec3().to_array(),
            ..Cuboid::default()
        }
        .build()?;
        self.placed(region, &part, Mat4::from_translation(center.as_vec3()))
    }

    fn rivets(&mut self) -> Result<(), MeshError> {
        let head = Sphere {
            radius: 0.015,
            slices: 10,
            stacks: 6,
        }
        .build()?;
        let mut rivet = |at: DVec3| {
            self.placed(
                ChestRegion::Iron,
                &head,
                Mat4::from_translation(at.as_vec3()),
            )
        };
        for x in STRAPS {
            for z in [-1.0, 1.0] {
                for y in [0.035, 0.13, 0.21, 0.29, BODY - 0.025] {
                    rivet(DVec3::new(x, y, z * (DEPTH * 0.5 + STRAP)))?;
                }
            }
            for step in 1..12 {
                let (normal, position) = on_vault(fraction(step, 12), STRAP);
                rivet(position + DVec3::X * x + normal * 0.001)?;
            }
        }
        for x in [-0.4, 0.4, -0.32, 0.32, -0.48, 0.48] {
            rivet(DVec3::new(x, BODY + GAP + RIM * 0.5, -DEPTH * 0.5 - BAND))?;
        }
        Ok(())
    }

    fn fittings(&mut self) -> Result<(), MeshError> {
        let front = -DEPTH * 0.5;
        // Plate on the body, hasp over the gap from the lid, and the picture of the lock a hair in front of the plate.
        self.block(
            ChestRegion::Brass,
            DVec3::new(0.0, 0.305, front - 0.012),
            DVec3::new(0.24, 0.25, 0.036),
        )?;
        let picture = Plane {
            width: 0.24,
            height: 0.25,
            ..Plane::default()
        }
        .build()?;
        let at = Vec3::new(0.0, 0.305, (front - 0.0325) as f32);
        self.placed(ChestRegion::Lock, &picture, Mat4::from_translation(at))?;
        self.block(
            ChestRegion::Brass,
            DVec3::new(0.0, 0.46, front - 0.018),
            DVec3::new(0.1, 0.15, 0.048),
        )?;
        let ring = Torus {
            radius: 0.075,
            tube: 0.013,
            segments: 24,
            tube_segments: 10,
        }
        .build()?;
        for side in [-1.0, 1.0] {
            let x = side * (WIDTH * 0.5 + 0.02);
            // The ring hangs flat against the end of the chest: its axis turns from Y to X.
            let turned = Mat4::from_translation(Vec3::new(x as f32, 0.22, 0.0))
                * Mat4::from_rotation_z(std::f32::consts::FRAC_PI_2);
            self.placed(ChestRegion::Iron, &ring, turned)?;
            self.block(
                ChestRegion::Iron,
                DVec3::new(x, 0.295, 0.0),
                DVec3::new(0.05, 0.05, 0.09),
            )?;
        }
        Ok(())
    }
}

/// Normal and position (x = 0) on the half ellipse of the lid, raised by `raise`; v = 0 is the foot at the back, 0.5 the top.
fn on_vault(v: f64, raise: f64) -> (DVec3, DVec3) {
    let (a, b) = (DEPTH * 0.5 + raise, VAULT + raise);
    let (sin, cos) = (v * std::f64::consts::PI).sin_cos();
    let normal = DVec3::new(0.0, sin / b, cos / a).normalize_or(DVec3::Y);
    (normal, DVec3::new(0.0, VAULT_FOOT + b * sin, a * cos))
}

/// The vault of the lid from `left` to `right`, raised by `raise`, with walls at its two ends: down to the middle of the
/// lid's foot, or down to where `inner` would raise the vault. Below the wood (negative) such walls hang over the ends of the
/// lid, and get an inner side.
fn vault(steps: u32, left: f64, right: f64, raise: f64, inner: Option<f64>) -> MeshData {
    let mut data = MeshData::default();
    let mut shell = |raise: f64, [start, end]: [f64; 2], front: f64| {
        data.patch(1, steps, |i, j| {
            let v = fraction(j, steps);
            let (normal, position) = on_vault(v, raise);
            Vertex {
                position: position + DVec3::X * if i == 0 { start } else { end },
                normal: normal * front,
                tangent: DVec3::X * front,
                texcoord: Vec2::new(i as f32, v as f32),
            }
        });
    };
    shell(raise, [left, right], 1.0);
    if let Some(inner) = inner.filter(|inner| *inner < 0.0) {
        shell(inner, [right, left], -1.0);
    }
    for (x, side) in [(left, -1.0), (right, 1.0)] {
        data.patch(steps, 1, |i, j| {
            // Going up from the back and then outwards turns around +X; the other end needs the other way.
            let v = fraction(if side > 0.0 { i } else { steps - i }, steps);
            let inner = inner.map_or(DVec3::Y * VAULT_FOOT, |inner| on_vault(v, inner).1);
            let position = if j == 0 { inner } else { on_vault(v, raise).1 };
            Vertex {
                position: position + DVec3::X * x,
                normal: DVec3::X * side,
                tangent: DVec3::Z * side,
                texcoord: Vec2::new(
                    (0.5 + side * position.z / (DEPTH + 2.0 * raise)) as f32,
                    (1.0 - (position.y - VAULT_FOOT) / (VAULT + raise)) as f32,
                ),
            }
        });
    }
    data
}
