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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_turns_what_goes_into_it() {
        // Down and to the right onto a floor: up and to the right.
        let gone = reflect(DVec3::new(0.6, -0.8, 0.0), DVec3::Y);
        assert!((gone - DVec3::new(0.6, 0.8, 0.0)).length() < 1e-12);
    }

    #[test]
    fn snells_law() {
        // sin 30° = 0.5 becomes 0.5 / 1.25 = 0.4.
        let incident = DVec3::new(0.5, -0.75f64.sqrt(), 0.0);
        let gone =
            refract(incident, DVec3::Y, 1.0 / 1.25).expect("into glass there is always a way");
        assert!((gone.x - 0.4).abs() < 1e-12 && (gone.length() - 1.0).abs() < 1e-12);
        // Out of glass 0.9 would become 1.125: total reflection.
        let flat = DVec3::new(0.9, -0.19f64.sqrt(), 0.0);
        assert_eq!(refract(flat, DVec3::Y, 1.25), None);
    }

    #[test]
    fn how_much_is_reflected() {
        // Straight on: ((1 - 1.5) / (1 + 1.5))^2 = 0.04. Along the surface: everything.
        assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-12);
        assert!((fresnel(0.0, 1.5) - 1.0).abs() < 1e-12);
    }
}
