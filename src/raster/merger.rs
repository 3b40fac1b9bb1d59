//! The output merger: fog, alpha test, depth and stencil test, blending, colour write mask.

use super::pixel::{Attribute, LANES, PixelBatch, PixelResult};
use super::state::{
    BlendFactor, BlendOp, BlendState, ColorMask, Compare, FogDistance, FogMode, RenderState,
    StencilOp,
};
use super::target::{ColorFormat, TILE, Target, TargetTooLarge, Tile};
use super::{fog_unit, unit};

/// Red, green, blue and alpha of the four pixels of a quad.
type QuadColor = [[f32; 4]; 4];

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

/// Where a quad lies in its tile: the place of its first pixel.
#[inline]
fn tile_offset(x: i32, y: i32) -> usize {
    // Coordinates of quads are never negative, being within the scissor.
    let within = |v: i32| v as u32 % TILE;
    (within(y) * TILE + within(x)) as usize
}

/// The places of the four pixels of a quad in its tile. A quad never leaves its tile, whose side is even.
#[inline]
fn tile_pixels(x: i32, y: i32) -> [usize; 4] {
    let at = tile_offset(x, y);
    [at, at + 1, at + TILE as usize, at + TILE as usize + 1]
}

/// The depth and stencil test of a quad, with their writes. Returns which of the pixels in `mask` pass.
#[inline]
pub(super) fn depth_stencil(
    tile: &mut Tile,
    state: &RenderState,
    x: i32,
    y: i32,
    z: &[f32; 4],
    mask: u8,
) -> u8 {
    if !state.depth.enable && !state.stencil.enable {
        return mask;
    }
    let mut passed = 0;
    for (i, at) in tile_pixels(x, y).into_iter().enumerate() {
        if mask >> i & 1 == 0 {
            continue;
        }
        let depth = &mut tile.depth[at];
        let depth_passes = || !state.depth.enable || state.depth.func.passes(z[i], *depth);
        let passes = if state.stencil.enable {
            stencil(&mut tile.stencil[at], state, depth_passes)
        } else {
            depth_passes()
        };
        if passes {
            passed |= 1 << i;
            if state.depth.enable && state.depth.write {
                *depth = z[i];
            }
        }
    }
    passed
}

/// Which of the pixels in `mask` pass the depth test as things stand. Writes nothing.
#[inline]
pub(super) fn depth_only(
    tile: &Tile,
    state: &RenderState,
    x: i32,
    y: i32,
    z: &[f32; 4],
    mask: u8,
) -> u8 {
    if !state.depth.enable {
        return mask;
    }
    let passes = |i: usize, at: usize| u8::from(state.depth.func.passes(z[i], tile.depth[at])) << i;
    let at = tile_pixels(x, y);
    (0..4).fold(0, |passed, i| passed | passes(i, at[i])) & mask
}

fn stencil(stored: &mut u8, state: &RenderState, depth_passes: impl Fn() -> bool) -> bool {
    let stencil = &state.stencil;
    let mask = stencil.mask;
    let (passes, op) = if !stencil
        .func
        .passes(stencil.reference & mask, *stored & mask)
    {
        (false, stencil.fail)
    } else if !depth_passes() {
        (false, stencil.depth_fail)
    } else {
        (true, stencil.pass)
    };
    let new = match op {
        StencilOp::Keep => *stored,
        StencilOp::Zero => 0,
        StencilOp::Replace => stencil.reference,
        StencilOp::IncrSat => stored.saturating_add(1),
        StencilOp::DecrSat => stored.saturating_sub(1),
        StencilOp::Invert => !*stored,
        StencilOp::Incr => stored.wrapping_add(1),
        StencilOp::Decr => stored.wrapping_sub(1),
    };
    *stored = *stored & !stencil.write_mask | new & stencil.write_mask;
    passes
}

/// Puts a shaded batch into its tile, quad after quad in drawing order. Returns how many pixels were written.
pub(super) fn merge(
    tile: &mut Tile,
    format: ColorFormat,
    state: &RenderState,
    timing: DepthTiming,
    batch: &PixelBatch,
    shaded: &PixelResult,
) -> u64 {
    let mut written = 0;
    for quad in 0..batch.quads {
        let lane = 4 * quad;
        let live = |killed: bool| {
            let is = |i: usize| batch.live[lane + i] && shaded.killed[lane + i] == killed;
            (0..4).fold(0, |mask, i| mask | u8::from(is(i)) << i)
        };
        let mut mask = live(false);
        if !shaded.shows_killed.is_empty() {
            show_killed(tile, state, timing, batch, shaded, lane, live(true));
        }
        if mask == 0 {
            continue;
        }
        // r0 leaves the shader as a colour of 0 to 1; fog and blending come after that.
        let mut color = quad_color(&shaded.color, lane);
        if state.alpha_test.enable {
            let test = &state.alpha_test;
            let passes = |i: usize| test.func.passes(to_byte(color[3][i]), test.reference);
            mask &= (0..4).fold(0, |kept, i| kept | u8::from(passes(i)) << i);
        }
        let (x, y) = (batch.x[lane], batch.y[lane]);
        if let DepthTiming::Late { .. } = timing {
            let z = late_depths(timing, batch, shaded, lane);
            mask = depth_stencil(tile, state, x, y, &z, mask);
        }
        if mask == 0 {
            continue;
        }
        written += u64::from(mask.count_ones());
        let pixels = tile_pixels(x, y);
        fog(&mut color, state, batch, lane);
        put(&mut tile.color, format, state, pixels, mask, color);
        for (number, plane) in tile.more.iter_mut().enumerate() {
            let own = shaded.more.get(number).map(|own| {
                let mut own = quad_color(own, lane);
                fog(&mut own, state, batch, lane);
                own
            });
            put(plane, format, state, pixels, mask, own.unwrap_or(color));
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
) {
    if state.blend.enable {
        let stored = pixels.map(|at| stored[at]);
        let target: QuadColor =
            std::array::from_fn(|c| std::array::from_fn(|i| f32::from(stored[i][c]) / 255.0));
        color = blend(&state.blend, &color, &target);
    }
    let whole = format == ColorFormat::A8R8G8B8 && state.color_mask == ColorMask::ALL;
    for (i, at) in pixels.into_iter().enumerate() {
        if mask >> i & 1 == 0 {
            continue;
        }
        if whole {
            stored[at] = color.map(|channel| to_byte(channel[i]));
            continue;
        }
        for (channel, stored) in stored[at].iter_mut().enumerate() {
            // Without an alpha channel there is a constant 1, which nothing changes.
            if state.color_mask.writes(channel)
                && !(channel == 3 && format == ColorFormat::X8R8G8B8)
            {
                *stored = to_byte(color[channel][i]);
            }
        }
    }
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
    let mut seen = depth_only(tile, state, x, y, &z, killed);
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

/// Mixes fog into the colours of the quad whose first lane this is.
#[inline]
fn fog(color: &mut QuadColor, state: &RenderState, batch: &PixelBatch, lane: usize) {
    if !state.fog.enable {
        return;
    }
    let clear: [f32; 4] = std::array::from_fn(|i| fog_factor(state, batch, lane + i));
    for (channel, fog) in color.iter_mut().zip(state.fog.color) {
        for (value, clear) in channel.iter_mut().zip(clear) {
            *value = clear * *value + (1.0 - clear) * unit(fog);
        }
    }
}

/// A shaded pixel on its own, before the merger.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LonePixel {
    /// `r0`.
    pub color: [f32; 4],
    /// Whether `texkill` took it out.
    pub killed: bool,
    /// The depth of the primitive, 0 to 1. Table fog uses it, whatever the shader replaces it with.
    pub z: f32,
    /// The depth that the shader replaces it with.
    pub replaced_z: Option<f32>,
    /// The w of the position.
    pub w: f32,
    /// The fog factor of the vertices, 0 to 1.
    pub fog: f32,
}

/// What stands in the target after a [`LonePixel`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Merged {
    /// The colour in 0 to 1 before it is rounded to the steps of a target.
    pub exact: [f32; 4],
    /// The colour as a target of 8 bits a channel stores it.
    pub stored: [u8; 4],
    /// Whether the pixel reached the target: it was not killed, and no test rejected it.
    pub written: bool,
}

/// Takes one pixel through fog, alpha test, depth and stencil test, blending and the colour write mask, into a target
/// with alpha whose colour is `clear` (taken into 0 to 1), whose depth is 1 and whose stencil value is 0.
///
/// # Errors
/// [`TargetTooLarge`], if the one pixel of the target should be too much.
pub fn merge_lone(
    state: &RenderState,
    pixel: &LonePixel,
    clear: [f32; 4],
) -> Result<Merged, TargetTooLarge> {
    let clear = clear.map(unit);
    let mut target = Target::new(1, 1, ColorFormat::A8R8G8B8)?;
    target.clear(Some(clear.map(to_byte)), Some(1.0), Some(0));
    let mut batch = PixelBatch::empty();
    batch.place(0, 0, 0, 1, &[pixel.z; 4]);
    batch.quads = 1;
    batch.w = [pixel.w; LANES];
    batch.fog = [pixel.fog; LANES];
    let mut shaded = PixelResult::new();
    shaded.color = pixel.color.map(|channel| [channel; LANES]);
    shaded.killed = [pixel.killed; LANES];
    shaded.depth = [pixel.replaced_z.unwrap_or(pixel.z); LANES];
    let timing = DepthTiming::Late {
        reject: false,
        replaced: true,
    };
    let mut written = 0;
    if let Some(tile) = target.tiles_mut().first_mut() {
        written = merge(tile, ColorFormat::A8R8G8B8, state, timing, &batch, &shaded);
    }
    let mut exact = clear;
    if written > 0 {
        let mut color = pixel.color.map(|channel| [unit(channel); 4]);
        fog(&mut color, state, &batch, 0);
        if state.blend.enable {
            color = blend(&state.blend, &color, &clear.map(|channel| [channel; 4]));
        }
        for (channel, value) in exact.iter_mut().enumerate() {
            if state.color_mask.writes(channel) {
                *value = color[channel][0];
            }
        }
    }
    let stored = target.color(0, 0).unwrap_or_default();
    Ok(Merged {
        exact,
        stored,
        written: written > 0,
    })
}

/// 0 to 1 as 0 to 255, to the nearest (of two equally near ones the even).
#[inline]
pub(super) fn to_byte(value: f32) -> u8 {
    // A float of 2^23 or more holds no fractions, so the addition rounds, and leaves the integer in the lowest bits.
    (value * 255.0 + 8_388_608.0).to_bits() as u8
}

/// How much of the pixel's own colour is left, 0 to 1.
#[inline]
fn fog_factor(state: &RenderState, batch: &PixelBatch, lane: usize) -> f32 {
    let fog = &state.fog;
    let distance = match fog.distance {
        FogDistance::Z => batch.z[lane],
        FogDistance::W => batch.w[lane],
    };
    let factor = match fog.table {
        FogMode::None => batch.fog[lane],
        FogMode::Exp => (-distance * fog.density).exp(),
        FogMode::Exp2 => (-(distance * fog.density).powi(2)).exp(),
        // Both ends in one place divide by zero: a step then.
        FogMode::Linear if fog.start == fog.end => f32::from(u8::from(distance < fog.end)),
        FogMode::Linear => (fog.end - distance) / (fog.end - fog.start),
    };
    fog_unit(factor)
}

/// Source and target, joined; in 0 to 1.
fn blend(state: &BlendState, source: &QuadColor, target: &QuadColor) -> QuadColor {
    let (source_factor, target_factor) = match state.source {
        // These two say it for both sides.
        BlendFactor::BothSrcAlpha => (BlendFactor::SrcAlpha, BlendFactor::InvSrcAlpha),
        BlendFactor::BothInvSrcAlpha => (BlendFactor::InvSrcAlpha, BlendFactor::SrcAlpha),
        factor => (factor, state.destination),
    };
    std::array::from_fn(|channel| {
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
        match state.op {
            BlendOp::Add => join(|s, d| s + d),
            BlendOp::Subtract => join(|s, d| s - d),
            BlendOp::RevSubtract => join(|s, d| d - s),
            BlendOp::Min => std::array::from_fn(|i| source[channel][i].min(target[channel][i])),
            BlendOp::Max => std::array::from_fn(|i| source[channel][i].max(target[channel][i])),
        }
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
