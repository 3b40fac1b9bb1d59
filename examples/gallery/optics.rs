//! The laws: reflection, refraction, and how much of each.

use glam::DVec3;

/// The direction in which a ray goes on that meets a mirror. `normal` has length 1.
pub(crate) fn reflect(incident: DVec3, normal: DVec3) -> DVec3 {
    incident - 2.0 * incident.dot(normal) * normal
}

/// Snell's law: the direction in which a ray goes on through a surface. Both vectors have length 1 and the normal points to
/// where the ray comes from; `ratio` is the index of refraction there divided by that beyond. None: total reflection.
pub(crate) fn refract(incident: DVec3, normal: DVec3, ratio: f64) -> Option<DVec3> {
    let cosine = -incident.dot(normal);
    let beyond = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    (beyond >= 0.0).then(|| ratio * incident + (ratio * cosine - beyond.sqrt()) * normal)
}

/// Fresnel's equations: the share of unpolarised light that a surface reflects. `cosine` is that of the angle of incidence,
/// `index` the index of refraction beyond divided by that before.
pub(crate) fn fresnel(cosine: f64, index: f64) -> f64 {
    let sine = (1.0 - cosine * cosine).max(0.0) / (index * index);
    if sine >= 1.0 {
        return 1.0;
    }
    let beyond = (1.0 - sine).sqrt();
    let across = (cosine - index * beyond) / (cosine + index * beyond);
    let along = (index * cosine - beyond) / (index * cosine + beyond);
    f64::midpoint(across * across, along * along)
}
