//! Normals and tangent frames: computed where they are missing, made orthonormal where they are given.

use std::collections::HashMap;

use glam::{DVec3, Vec2, Vec3};

/// Double precision, so that no product of finite `f32` coordinates overflows or vanishes.
fn unit(v: DVec3) -> Option<Vec3> {
    v.try_normalize().map(DVec3::as_vec3)
}

/// The corners of every triangle as vertex numbers; the caller has checked the indices.
fn triangles(indices: &[u32]) -> impl Iterator<Item = [usize; 3]> {
    indices
        .chunks_exact(3)
        .map(|t| [t[0] as usize, t[1] as usize, t[2] as usize])
}

/// Normalises every normal; those of length zero become the smooth normal of their position, or +Y where no triangle gives one.
pub(super) fn complete_normals(positions: &[Vec3], indices: &[u32], normals: &mut [Vec3]) {
    let mut missing = false;
    for normal in normals.iter_mut() {
        *normal = unit(normal.as_dvec3()).unwrap_or(Vec3::ZERO);
        missing |= *normal == Vec3::ZERO;
    }
    if !missing {
        return;
    }
    // By position and not by vertex: a texture seam doubles vertices but is no edge of the surface. Adding 0.0 joins -0 and 0.
    let key = |p: Vec3| (p + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut sums: HashMap<[u32; 3], DVec3> = HashMap::new();
    for [a, b, c] in triangles(indices) {
        let [pa, pb, pc] = [a, b, c].map(|i| positions[i].as_dvec3());
        // Its length is twice the area, which is the weight.
        let face = (pb - pa).cross(pc - pa);
        for i in [a, b, c] {
            *sums.entry(key(positions[i])).or_insert(DVec3::ZERO) += face;
        }
    }
    for (normal, position) in normals.iter_mut().zip(positions) {
        if *normal == Vec3::ZERO {
            *normal = sums
                .get(&key(*position))
                .copied()
                .and_then(unit)
                .unwrap_or(Vec3::Y);
        }
    }
}

/// Tangents and bitangents from the derivatives of the position by u and v, weighted by area around each vertex.
///
/// Triangles whose texture coordinates lie on a line say nothing and are left out; a vertex that hears nothing gets some
/// tangent at right angles to its normal, always the same one.
pub(super) fn from_texcoords(
    positions: &[Vec3],
    normals: &[Vec3],
    texcoords: &[Vec2],
    indices: &[u32],
) -> (Vec<Vec3>, Vec<Vec3>) {
    let mut along_u = vec![DVec3::ZERO; positions.len()];
    let mut along_v = vec![DVec3::ZERO; positions.len()];
    for corners in triangles(indices) {
        let [p0, p1, p2] = corners.map(|i| positions[i].as_dvec3());
        let [t0, t1, t2] = corners.map(|i| texcoords[i].as_dvec2());
        let (e1, e2, d1, d2) = (p1 - p0, p2 - p0, t1 - t0, t2 - t0);
        let determinant = d1.perp_dot(d2);
        if determinant == 0.0 {
            continue;
        }
        // Only the directions count: the size of a derivative tells how the texture is scaled, not how much surface agrees.
        let weight = e1.cross(e2).length() * determinant.signum();
        let u = (e1 * d2.y - e2 * d1.y).normalize_or_zero() * weight;
        let v = (e2 * d1.x - e1 * d2.x).normalize_or_zero() * weight;
        for i in corners {
            along_u[i] += u;
            along_v[i] += v;
        }
    }
    normals
        .iter()
        .zip(along_u.iter().zip(&along_v))
        .map(|(n, (u, v))| basis(*n, *u, Some(*v)))
        .unzip()
}

/// Makes given tangents orthonormal. Without bitangents (an empty list) they are `normal × tangent`.
pub(super) fn orthonormal(
    normals: &[Vec3],
    tangents: &[Vec3],
    bitangents: &[Vec3],
) -> (Vec<Vec3>, Vec<Vec3>) {
    normals
        .iter()
        .zip(tangents)
        .enumerate()
        .map(|(i, (n, t))| basis(*n, t.as_dvec3(), bitangents.get(i).map(|b| b.as_dvec3())))
        .unzip()
}

/// Gram–Schmidt: the tangent against the unit normal; the bitangent is then one of two vectors, and `v` says which.
fn basis(normal: Vec3, u: DVec3, v: Option<DVec3>) -> (Vec3, Vec3) {
    let n = normal.as_dvec3().normalize_or(DVec3::Y);
    // Before projecting: the rest of a vector parallel to the normal is rounding noise.
    let flat = |d: DVec3| {
        let d = d.normalize_or_zero();
        let rest = d - n * n.dot(d);
        (rest.length() > 1e-5).then(|| rest.normalize())
    };
    let v = v.and_then(flat);
    let tangent = flat(u)
        .or_else(|| v.map(|v| v.cross(n)))
        .unwrap_or_else(|| {
            if n.x.abs() < 0.9 {
                n.cross(DVec3::X).cross(n)
            } else {
                n.cross(DVec3::Y).cross(n)
            }
            .normalize()
        });
    let side = n.cross(tangent);
    let mirrored = v.is_some_and(|v| v.dot(side) < 0.0);
    (
        tangent.as_vec3(),
        if mirrored { -side } else { side }.as_vec3(),
    )
}
