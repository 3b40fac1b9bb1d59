//! Deterministic noise from an integer hash: the same on every machine, seamless over the unit square.

/// Scatters three integers over 32 bits; multiplications by odd numbers and shifts, so nothing is lost on the way.
pub(super) fn hash(x: u32, y: u32, seed: u32) -> u32 {
    let mut h = x
        .wrapping_mul(0x9E37_79B1)
        .wrapping_add(y.wrapping_mul(0x85EB_CA77))
        .wrapping_add(seed.wrapping_mul(0xC2B2_AE3D));
    for _ in 0..2 {
        h ^= h >> 15;
        h = h.wrapping_mul(0x2C1B_3C6D);
        h ^= h >> 13;
    }
    h ^ (h >> 16)
}

/// A number from 0 up to but not including 1.
pub(super) fn random(x: u32, y: u32, seed: u32) -> f32 {
    // 24 bits are what an f32 holds exactly.
    (hash(x, y, seed) >> 8) as f32 / 16_777_216.0
}

/// Smooth noise, 0 to 1, on a lattice of `cells` per unit that repeats every unit.
pub(super) fn value(u: f32, v: f32, cells: [u32; 2], seed: u32) -> f32 {
    let (x, y) = (u * cells[0] as f32, v * cells[1] as f32);
    let (x0, y0) = (x.floor(), y.floor());
    let fade = |t: f32| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let (fx, fy) = (fade(x - x0), fade(y - y0));
    let wrap = |c: f32, n: u32| (c as i64).rem_euclid(i64::from(n.max(1))) as u32;
    let at = |dx: f32, dy: f32| random(wrap(x0 + dx, cells[0]), wrap(y0 + dy, cells[1]), seed);
    let top = mix(at(0.0, 0.0), at(1.0, 0.0), fx);
    mix(top, mix(at(0.0, 1.0), at(1.0, 1.0), fx), fy)
}

/// The sum of `octaves` of [`value`], each twice as fine and half as strong; 0 to 1, around 0.5.
pub(super) fn fractal(u: f32, v: f32, cells: [u32; 2], octaves: u32, seed: u32) -> f32 {
    let (mut sum, mut total, mut weight) = (0.0, 0.0, 1.0);
    for octave in 0..octaves {
        let cells = cells.map(|c| c << octave);
        sum += weight * value(u, v, cells, seed.wrapping_add(octave.wrapping_mul(0x51)));
        total += weight;
        weight *= 0.5;
    }
    sum / total
}

/// Linear interpolation.
pub(super) fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// 0 below `low`, 1 above `high`, smooth between.
pub(super) fn smooth(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
