//! The output merger: fog, alpha test, depth and stencil test, blending, colour write mask.

use super::pixel::{Attribute, PixelBatch, PixelResult};
use super::plain::{bits, depth_alone, depth_only, is_plain, number_in_tile, put_plain};
use super::record::{
    AlphaTested, BlendWeight, Blended, ColorWritten, DepthTested, FogSource, Fogged, Nobody,
    StencilTested, Watcher,
};
use super::state::{
    BlendFactor, BlendOp, BlendState, Compare, FogDistance, FogMode, FogState, RenderState,
    StencilOp, StencilState,
};
use super::target::{ColorFormat, Tile};
use super::{fog_unit, unit};

/// Red, green, blue and alpha of the four pixels of a quad.
pub(super) type QuadColor = [[f32; 4]; 4];

/// One of the four.
#[inline]
fn pixel_of(color: &QuadColor, pixel: usize) -> [f32; 4] {
    std::array::from_fn(|channel| color[channel][pixel])
}

/// When pixels meet the depth and stencil tests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum DepthTiming {
    /// Before shading: nothing after it can take a pixel out or change its depth.
    Early,
    /// After shading.
    Late {
        /// Whether a pixel that fails the depth test as things stand before shading is sure to fail it afterwards.
        reject: bool,
        /// Whether the shader's depth counts.
        replaced: bool,
    },
}

impl DepthTiming {
    pub(super) fn of(state: &RenderState, writes_depth: bool, may_kill: bool) -> Self {
        if !writes_depth && !may_kill && !state.alpha_test.enable {
            return Self::Early;
        }
        // With these comparisons a write only ever makes the test harder; without writes nothing changes.
        let harder = matches!(
            state.depth.func,
            Compare::Never
                | Compare::Less
                | Compare::LessEqual
                | Compare::Greater
                | Compare::GreaterEqual
        );
        Self::Late {
            reject: !writes_depth && !state.stencil.enable && (harder || !state.depth.write),
            replaced: writes_depth,
        }
    }
}

/// The places of the four pixels of a quad in its tile.
#[inline(always)]
fn tile_pixels(x: i32, y: i32) -> [usize; 4] {
    let at = 4 * number_in_tile::<4>(x, y);
    [at, at + 1, at + 2, at + 3]
}

/// The depth and stencil test of a quad, with their writes. Returns which of the pixels in `mask` pass.
#[inline(always)]
pub(super) fn depth_stencil(
    tile: &mut Tile,
    state: &RenderState,
    (x, y): (i32, i32),
    z: &[f32; 4],
    mask: u8,
    watcher: &mut impl Watcher,
) -> u8 {
    if !state.depth.enable && !state.stencil.enable {
        return mask;
    }
    if !state.stencil.enable && !watcher.watches() {
        return depth_alone(tile, state, (x, y), z, mask);
    }
    let mut passed = 0;
    for (i, at) in tile_pixels(x, y).into_iter().enumerate() {
        if mask >> i & 1 == 0 {
            continue;
        }
        let incoming = z[i];
        let depth = &mut tile.depth[at];
        let stored = *depth;
        let depth_passes = !state.depth.enable || state.depth.func.passes(incoming, stored);
        let stencil_passes = !state.stencil.enable
            || stencil(
                &mut tile.stencil[at],
                &state.stencil,
                depth_passes,
                1 << i,
                watcher,
            );
        if stencil_passes && depth_passes {
            passed |= 1 << i;
            if state.depth.enable && state.depth.write {
                *depth = incoming;
            }
        }
        if state.depth.enable && stencil_passes {
            let after = *depth;
            watcher.note(1 << i, |record, _| {
                record.depth = Some(DepthTested {
                    incoming,
                    stored,
                    func: state.depth.func,
                    passed: depth_passes,
                    write: state.depth.write,
                    after,
                });
            });
        }
    }
    passed
}

/// The stencil test of the pixel in `mask`, with what it does to the stored value. Returns whether it is passed.
#[inline]
fn stencil(
    stored: &mut u8,
    state: &StencilState,
    depth_passes: bool,
    mask: u8,
    watcher: &mut impl Watcher,
) -> bool {
    let before = *stored;
    let passed = (state.func).passes(state.reference & state.mask, before & state.mask);
    let op = match (passed, depth_passes) {
        (false, _) => state.fail,
        (true, false) => state.depth_fail,
        (true, true) => state.pass,
    };
    let new = match op {
        StencilOp::Keep => before,
        StencilOp::Zero => 0,
        StencilOp::Replace => state.reference,
        StencilOp::IncrSat => before.saturating_add(1),
        StencilOp::DecrSat => before.saturating_sub(1),
        StencilOp::Invert => !before,
        StencilOp::Incr => before.wrapping_add(1),
        StencilOp::Decr => before.wrapping_sub(1),
    };
    let after = before & !state.write_mask | new & state.write_mask;
    *stored = after;
    watcher.note(mask, |record, _| {
        record.stencil = Some(StencilTested {
            stored: before,
            reference: state.reference,
            mask: state.mask,
            func: state.func,
            passed,
            op,
            write_mask: state.write_mask,
            after,
        });
    });
    passed
}

/// Puts a shaded batch into its tile, quad after quad in drawing order. Returns how many pixels were written.
///
/// Whoever watches one pixel must be given batches of one quad.
#[inline(always)]
pub(super) fn merge(
    tile: &mut Tile,
    format: ColorFormat,
    state: &RenderState,
    timing: DepthTiming,
    batch: &PixelBatch,
    shaded: &PixelResult,
    watcher: &mut impl Watcher,
) -> u64 {
    if !watcher.watches() && is_plain(tile, format, state, timing, shaded) {
        return put_plain(tile, batch, shaded);
    }
    let mut written = 0;
    for quad in 0..batch.quads {
        let lane = 4 * quad;
        let replaced = matches!(timing, DepthTiming::Late { replaced: true, .. });
        // r0 leaves the shader as a colour of 0 to 1; fog and blending come after that.
        let mut color = quad_color(&shaded.color, lane);
        watcher.note(0xf, |record, i| {
            record.shaded = shaded.color.map(|channel| channel[lane + i]);
            record.clamped = pixel_of(&color, i);
            record.replaced_depth = replaced.then(|| shaded.depth[lane + i]);
            record.killed = shaded.killed[lane + i];
        });
        let live = |killed: bool| {
            let is = |i: usize| batch.live[lane + i] && shaded.killed[lane + i] == killed;
            bits(&std::array::from_fn(is))
        };
        let mut mask = live(false);
        if !shaded.shows_killed.is_empty() {
            show_killed(tile, state, timing, batch, shaded, lane, live(true));
        }
        if mask == 0 {
            continue;
        }
        if state.alpha_test.enable {
            let test = &state.alpha_test;
            let passes = |i: usize| test.func.passes(to_byte(color[3][i]), test.reference);
            let passed: u8 = bits(&std::array::from_fn(passes));
            watcher.note(mask, |record, i| {
                record.alpha_test = Some(AlphaTested {
                    alpha: to_byte(color[3][i]),
                    func: test.func,
                    reference: test.reference,
                    passed: passed >> i & 1 == 1,
                });
            });
            mask &= passed;
        }
        let at = (batch.x[lane], batch.y[lane]);
        if let DepthTiming::Late { .. } = timing {
            let z = late_depths(timing, batch, shaded, lane);
            mask = depth_stencil(tile, state, at, &z, mask, watcher);
        }
        if mask == 0 {
            continue;
        }
        written += u64::from(mask.count_ones());
        let pixels = tile_pixels(at.0, at.1);
        fog(&mut color, &state.fog, batch, lane, mask, watcher);
        put(&mut tile.color, format, state, pixels, mask, color, watcher);
        for (number, plane) in tile.more.iter_mut().enumerate() {
            let own = shaded.more.get(number).map(|own| {
                let mut own = quad_color(own, lane);
                fog(&mut own, &state.fog, batch, lane, mask, &mut Nobody);
                own
            });
            let color = own.unwrap_or(color);
            put(plane, format, state, pixels, mask, color, &mut Nobody);
        }
    }
    written
}

/// The colours of the quad whose first lane this is, each in 0 to 1.
#[inline]
fn quad_color(color: &Attribute, lane: usize) -> QuadColor {
    std::array::from_fn(|c| std::array::from_fn(|i| unit(color[c][lane + i])))
}

/// The depths of a quad as the tests after the shader take them.
#[inline]
fn late_depths(
    timing: DepthTiming,
    batch: &PixelBatch,
    shaded: &PixelResult,
    lane: usize,
) -> [f32; 4] {
    let z = match timing {
        DepthTiming::Late { replaced: true, .. } => &shaded.depth,
        _ => &batch.z,
    };
    std::array::from_fn(|i| unit(z[lane + i]))
}

/// Blends a quad's colours with what a plane of its tile holds, and writes those of the pixels in `mask`.
#[inline]
fn put(
    stored: &mut [[u8; 4]],
    format: ColorFormat,
    state: &RenderState,
    pixels: [usize; 4],
    mask: u8,
    mut color: QuadColor,
    watcher: &mut impl Watcher,
) {
    if state.blend.enable {
        let stored = pixels.map(|at| stored[at]);
        let target: QuadColor =
            std::array::from_fn(|c| std::array::from_fn(|i| f32::from(stored[i][c]) / 255.0));
        let source = color;
        color = blend(&state.blend, &source, &target);
        watcher.note(mask, |record, i| {
            record.blend = Some(Blended {
                source: pixel_of(&source, i),
                target: pixel_of(&target, i),
                weights: weights(&state.blend, &source, &target, i),
                op: state.blend.op,
                result: pixel_of(&color, i),
            });
        });
    }
    // Without an alpha channel there is a constant 1, which nothing changes.
    let mask_of_target = format.written(state.color_mask);
    let writes = |channel: usize| mask_of_target.writes(channel);
    let whole = (0..4).all(writes);
    for (i, at) in pixels.into_iter().enumerate() {
        if mask >> i & 1 == 0 {
            continue;
        }
        if whole {
            stored[at] = color.map(|channel| to_byte(channel[i]));
            continue;
        }
        for (channel, stored) in stored[at].iter_mut().enumerate() {
            if writes(channel) {
                *stored = to_byte(color[channel][i]);
            }
        }
    }
    watcher.note(mask, |record, i| {
        let color = pixel_of(&color, i);
        record.write = Some(ColorWritten {
            color,
            bytes: color.map(to_byte),
            mask: state.color_mask,
            written: std::array::from_fn(writes),
        });
    });
}

/// Puts killed pixels into the planes that show them, where depth and stencil would let them through.
fn show_killed(
    tile: &mut Tile,
    state: &RenderState,
    timing: DepthTiming,
    batch: &PixelBatch,
    shaded: &PixelResult,
    lane: usize,
    killed: u8,
) {
    let (x, y) = (batch.x[lane], batch.y[lane]);
    let z = late_depths(timing, batch, shaded, lane);
    let pixels = tile_pixels(x, y);
    let mut seen = bits(&depth_only(tile, state, (x, y), &z)) & killed;
    if state.stencil.enable {
        let stencil = &state.stencil;
        let reference = stencil.reference & stencil.mask;
        for (i, at) in pixels.into_iter().enumerate() {
            if !(stencil.func).passes(reference, tile.stencil[at] & stencil.mask) {
                seen &= !(1 << i);
            }
        }
    }
    for number in &shaded.shows_killed {
        let plane = match number.checked_sub(1) {
            None => Some(&mut tile.color),
            Some(further) => tile.more.get_mut(further),
        };
        let color = quad_color(shaded.plane(*number), lane);
        if let Some(plane) = plane {
            for (i, at) in (pixels.into_iter().enumerate()).filter(|(i, _)| seen >> i & 1 == 1) {
                plane[at] = color.map(|channel| to_byte(channel[i]));
            }
        }
    }
}

/// Mixes fog into the colours of the quad whose first lane this is. `mask`: the pixels that count.
#[inline]
pub(super) fn fog(
    color: &mut QuadColor,
    state: &FogState,
    batch: &PixelBatch,
    lane: usize,
    mask: u8,
    watcher: &mut impl Watcher,
) {
    if !state.enable {
        return;
    }
    let clear: [f32; 4] = std::array::from_fn(|i| fog_unit(fog_factor(state, batch, lane + i)));
    let before = *color;
    for (channel, fog) in color.iter_mut().zip(state.color) {
        for (value, clear) in channel.iter_mut().zip(clear) {
            *value = clear * *value + (1.0 - clear) * unit(fog);
        }
    }
    watcher.note(mask, |record, i| {
        let rgb = |color: &QuadColor| std::array::from_fn(|channel| color[channel][i]);
        record.fog = Some(Fogged {
            source: match state.table {
                FogMode::None => FogSource::Vertex,
                mode => FogSource::Table {
                    mode,
                    kind: state.distance,
                    distance: fog_distance(state, batch, lane + i),
                },
            },
            factor: fog_factor(state, batch, lane + i),
            clear: clear[i],
            color: state.color.map(unit),
            before: rgb(&before),
            after: rgb(color),
        });
    });
}

/// 0 to 1 as 0 to 255, to the nearest (of two equally near ones the even).
#[inline(always)]
pub(super) fn to_byte(value: f32) -> u8 {
    // A float of 2^23 or more holds no fractions, so the addition rounds, and leaves the integer in the lowest bits.
    (value * 255.0 + 8_388_608.0).to_bits() as u8
}

/// The distance that table fog uses.
#[inline]
fn fog_distance(fog: &FogState, batch: &PixelBatch, lane: usize) -> f32 {
    match fog.distance {
        FogDistance::Z => batch.z[lane],
        FogDistance::W => batch.w[lane],
    }
}

/// How much of the pixel's own colour is left, not yet taken into 0 to 1.
#[inline]
fn fog_factor(fog: &FogState, batch: &PixelBatch, lane: usize) -> f32 {
    let distance = fog_distance(fog, batch, lane);
    match fog.table {
        FogMode::None => batch.fog[lane],
        FogMode::Exp => (-distance * fog.density).exp(),
        FogMode::Exp2 => (-(distance * fog.density).powi(2)).exp(),
        // Both ends in one place divide by zero: a step then.
        FogMode::Linear if fog.start == fog.end => f32::from(u8::from(distance < fog.end)),
        FogMode::Linear => (fog.end - distance) / (fog.end - fog.start),
    }
}

/// The factors of source and target that count.
#[inline]
fn factors(state: &BlendState) -> [BlendFactor; 2] {
    match state.source {
        // These two say it for both sides.
        BlendFactor::BothSrcAlpha => [BlendFactor::SrcAlpha, BlendFactor::InvSrcAlpha],
        BlendFactor::BothInvSrcAlpha => [BlendFactor::InvSrcAlpha, BlendFactor::SrcAlpha],
        factor => [factor, state.destination],
    }
}

/// Source and target, joined; in 0 to 1.
pub(super) fn blend(state: &BlendState, source: &QuadColor, target: &QuadColor) -> QuadColor {
    let [source_factor, target_factor] = factors(state);
    let mut joined = *source;
    for (channel, joined) in joined.iter_mut().enumerate() {
        let join = |op: fn(f32, f32) -> f32| {
            let (of_source, of_target) = (
                factor(source_factor, channel, source, target),
                factor(target_factor, channel, source, target),
            );
            std::array::from_fn(|i| {
                unit(op(
                    source[channel][i] * of_source[i],
                    target[channel][i] * of_target[i],
                ))
            })
        };
        *joined = match state.op {
            BlendOp::Add => join(|s, d| s + d),
            BlendOp::Subtract => join(|s, d| s - d),
            BlendOp::RevSubtract => join(|s, d| d - s),
            BlendOp::Min => std::array::from_fn(|i| source[channel][i].min(target[channel][i])),
            BlendOp::Max => std::array::from_fn(|i| source[channel][i].max(target[channel][i])),
        };
    }
    joined
}

/// What [`blend`] multiplies both sides of a pixel by, if it does.
fn weights(
    state: &BlendState,
    source: &QuadColor,
    target: &QuadColor,
    pixel: usize,
) -> Option<[BlendWeight; 2]> {
    let multiplies = !matches!(state.op, BlendOp::Min | BlendOp::Max);
    multiplies.then(|| {
        factors(state).map(|side| BlendWeight {
            factor: side,
            value: std::array::from_fn(|channel| factor(side, channel, source, target)[pixel]),
        })
    })
}

/// The factor of one channel, for the four pixels.
#[inline]
fn factor(factor: BlendFactor, channel: usize, source: &QuadColor, target: &QuadColor) -> [f32; 4] {
    let rest = |values: &[f32; 4]| values.map(|value| 1.0 - value);
    match factor {
        BlendFactor::Zero => [0.0; 4],
        BlendFactor::One => [1.0; 4],
        BlendFactor::SrcColor => source[channel],
        BlendFactor::InvSrcColor => rest(&source[channel]),
        // As the factor of the target the two combined ones have no meaning of their own: what their names say of alpha.
        BlendFactor::SrcAlpha | BlendFactor::BothSrcAlpha => source[3],
        BlendFactor::InvSrcAlpha | BlendFactor::BothInvSrcAlpha => rest(&source[3]),
        BlendFactor::DestAlpha => target[3],
        BlendFactor::InvDestAlpha => rest(&target[3]),
        BlendFactor::DestColor => target[channel],
        BlendFactor::InvDestColor => rest(&target[channel]),
        BlendFactor::SrcAlphaSat if channel == 3 => [1.0; 4],
        BlendFactor::SrcAlphaSat => std::array::from_fn(|i| source[3][i].min(1.0 - target[3][i])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Red and alpha of source and target; all results below are worked out from these by hand.
    const SOURCE: [f32; 4] = [0.75, 0.0, 0.0, 0.25];
    const TARGET: [f32; 4] = [0.125, 0.0, 0.0, 0.625];

    /// Red and alpha.
    fn blended(source: BlendFactor, destination: BlendFactor, op: BlendOp) -> (f32, f32) {
        let state = BlendState {
            enable: true,
            source,
            destination,
            op,
        };
        let result = blend(&state, &SOURCE.map(|v| [v; 4]), &TARGET.map(|v| [v; 4]));
        (result[0][2], result[3][2])
    }

    #[test]
    fn every_factor_on_either_side() {
        // Factor; red and alpha of it.
        let factors = [
            (BlendFactor::Zero, 0.0, 0.0),
            (BlendFactor::One, 1.0, 1.0),
            (BlendFactor::SrcColor, 0.75, 0.25),
            (BlendFactor::InvSrcColor, 0.25, 0.75),
            (BlendFactor::SrcAlpha, 0.25, 0.25),
            (BlendFactor::InvSrcAlpha, 0.75, 0.75),
            (BlendFactor::DestAlpha, 0.625, 0.625),
            (BlendFactor::InvDestAlpha, 0.375, 0.375),
            (BlendFactor::DestColor, 0.125, 0.625),
            (BlendFactor::InvDestColor, 0.875, 0.375),
            // min(0.25, 1 - 0.625)
            (BlendFactor::SrcAlphaSat, 0.25, 1.0),
        ];
        for (factor, red, alpha) in factors {
            assert_eq!(
                blended(factor, BlendFactor::Zero, BlendOp::Add),
                (0.75 * red, 0.25 * alpha),
                "source {factor}"
            );
            assert_eq!(
                blended(BlendFactor::Zero, factor, BlendOp::Add),
                (0.125 * red, 0.625 * alpha),
                "target {factor}"
            );
        }
    }

    #[test]
    fn the_two_factors_that_speak_for_both_sides() {
        // 0.75 · 0.25 + 0.125 · 0.75 and 0.25 · 0.25 + 0.625 · 0.75
        let expected = (0.28125, 0.53125);
        assert_eq!(
            blended(BlendFactor::BothSrcAlpha, BlendFactor::One, BlendOp::Add),
            expected
        );
        // 0.75 · 0.75 + 0.125 · 0.25 and 0.25 · 0.75 + 0.625 · 0.25
        let expected = (0.59375, 0.34375);
        assert_eq!(
            blended(
                BlendFactor::BothInvSrcAlpha,
                BlendFactor::Zero,
                BlendOp::Add
            ),
            expected
        );
    }

    #[test]
    fn every_operation() {
        let one = BlendFactor::One;
        assert_eq!(blended(one, one, BlendOp::Add), (0.875, 0.875));
        assert_eq!(blended(one, one, BlendOp::Subtract), (0.625, 0.0));
        assert_eq!(blended(one, one, BlendOp::RevSubtract), (0.0, 0.375));
        // Without the factors.
        let zero = BlendFactor::Zero;
        assert_eq!(blended(zero, zero, BlendOp::Min), (0.125, 0.25));
        assert_eq!(blended(zero, zero, BlendOp::Max), (0.75, 0.625));
    }

    #[test]
    fn rounding_to_8_bits_finds_every_value_back() {
        for byte in 0..=255_u8 {
            let exact = f32::from(byte) / 255.0;
            assert_eq!(to_byte(exact), byte);
            assert_eq!(to_byte((f32::from(byte) + 0.49).min(255.0) / 255.0), byte);
            assert_eq!(to_byte((f32::from(byte) - 0.49).max(0.0) / 255.0), byte);
        }
    }
}
