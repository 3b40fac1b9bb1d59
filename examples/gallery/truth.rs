//! The true ways of light: what a ray from the eye meets, and how it goes on from there.

use crate::optics::{fresnel, reflect, refract};
use crate::tree::Ray;
use crate::world::World;
use glam::DVec3;
use texcrd::exec::Stage;
use texcrd::texture::sample_at;

/// What reflects or refracts.
pub(crate) enum Body<'a> {
    /// The sphere itself, not its triangles.
    Ball { center: DVec3, radius: f64 },
    /// The triangles of the draw, with the normals of its vertices.
    Mesh {
        surface: World<'a>,
        /// A normal map.
        normals: Option<&'a Stage<'a>>,
    },
}

/// How light goes on where it meets the body.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Law {
    Mirror,
    /// A pane so thin that light goes straight on.
    Pane,
    /// A ball of glass: refracted where light enters, and again where it leaves.
    Glass {
        index: f64,
    },
    /// The same with an index for red, green and blue, and with Fresnel's share reflected at the first surface.
    Dispersion {
        indices: [f64; 3],
    },
}

/// One way on.
pub(crate) struct Path {
    /// The direction right behind the surface.
    pub(crate) first: DVec3,
    /// The way into the room, behind the last surface.
    pub(crate) last: Ray,
    /// Its share of red, green and blue.
    pub(crate) weight: DVec3,
}

/// A point of the body, and the normal to the side that the ray comes from.
pub(crate) struct Met {
    pub(crate) point: DVec3,
    pub(crate) normal: DVec3,
}

impl Body<'_> {
    /// Where a ray from outside first meets the body. Its direction has length 1.
    pub(crate) fn meet(&self, ray: &Ray) -> Option<Met> {
        match self {
            Self::Ball { center, radius } => {
                let from = ray.origin - *center;
                let half = from.dot(ray.direction);
                let root = half * half - from.length_squared() + radius * radius;
                let distance = -half - root.max(0.0).sqrt();
                if root < 0.0 || distance < 0.0 {
                    return None;
                }
                let point = ray.origin + distance * ray.direction;
                let normal = (point - *center) / *radius;
                Some(Met { point, normal })
            }
            Self::Mesh { surface, normals } => {
                let hit = surface.hit(ray)?;
                let at = surface.surface(&hit);
                let mut normal = at.normal;
                if let Some(stage) = normals {
                    let coordinates = at.texcoord.as_vec2();
                    let coordinates = [coordinates.x, coordinates.y, 0.0];
                    let texel = sample_at(stage.texture, &stage.sampler, coordinates, 0.0);
                    let [x, y, z, _] = texel.map(|part| 2.0 * f64::from(part) - 1.0);
                    normal = (x * at.tangent + y * at.bitangent + z * at.normal).normalize();
                }
                if at.normal.dot(ray.direction) > 0.0 {
                    normal = -normal;
                }
                Some(Met {
                    point: hit.point,
                    normal,
                })
            }
        }
    }
}

impl Law {
    /// The ways on of a ray that has met the body. Its direction has length 1.
    pub(crate) fn paths(self, body: &Body<'_>, ray: &Ray, met: &Met) -> Vec<Path> {
        let straight = |direction: DVec3, weight: DVec3| Path {
            first: direction,
            last: Ray {
                origin: met.point,
                direction,
            },
            weight,
        };
        match self {
            Self::Mirror => vec![straight(reflect(ray.direction, met.normal), DVec3::ONE)],
            Self::Pane => vec![straight(ray.direction, DVec3::ONE)],
            Self::Glass { index } => glass(body, ray, met, index, DVec3::ONE)
                .into_iter()
                .collect(),
            Self::Dispersion { indices } => {
                let shine = fresnel(-ray.direction.dot(met.normal), indices[1]);
                let colors = [DVec3::X, DVec3::Y, DVec3::Z];
                let through = indices
                    .into_iter()
                    .zip(colors)
                    .filter_map(|(index, color)| {
                        glass(body, ray, met, index, (1.0 - shine) * color)
                    });
                let off = straight(reflect(ray.direction, met.normal), DVec3::splat(shine));
                through.chain([off]).collect()
            }
        }
    }
}

/// The way through a body of glass. What is no ball is left where it was entered.
fn glass(body: &Body<'_>, ray: &Ray, met: &Met, index: f64, weight: DVec3) -> Option<Path> {
    let first = refract(ray.direction, met.normal, 1.0 / index)?;
    let mut last = Ray {
        origin: met.point,
        direction: first,
    };
    if let Body::Ball { center, .. } = body {
        let chord = -2.0 * (met.point - *center).dot(first);
        last.origin = met.point + chord * first;
        let inward = (*center - last.origin).normalize();
        last.direction = refract(first, inward, index)?;
    }
    Some(Path {
        first,
        last,
        weight,
    })
}
