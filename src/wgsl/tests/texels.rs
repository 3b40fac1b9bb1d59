//! Samples that are put together texel by texel: when, and that what is written is valid.

use super::support::{Shader, validate};
use crate::texture::{AddressMode, Filter, MipFilter, TextureKind, Weights};
use crate::wgsl::{Options, Resource, StageOptions, Translation};

fn translated(stage: StageOptions, level_zero: bool) -> Translation {
    let options = Options {
        stages: [stage; 8],
        level_zero,
        ..Options::default()
    };
    let translation = Shader::new("ps.1.1\ntex t0\nmov r0, t0\n").translate(&options);
    validate(&translation.source);
    translation
}

fn has_sampler(translation: &Translation) -> bool {
    let mut bindings = translation.reflection.bindings.iter();
    bindings.any(|binding| matches!(binding.resource, Resource::Sampler { .. }))
}

/// Whether a stage has a sampler; both the WGSL and the reflection must say so.
fn is_by_hand(change: impl FnOnce(&mut StageOptions)) -> bool {
    let mut stage = StageOptions::default();
    change(&mut stage);
    let translation = translated(stage, false);
    let by_hand = translation.source.contains("textureLoad(");
    assert_eq!(has_sampler(&translation), !by_hand);
    assert_eq!(translation.source.contains("sampler0"), !by_hand);
    by_hand
}

/// The list in the documentation of `StageOptions`, line by line.
#[test]
fn samplers_are_given_up_where_they_cannot_do_it() {
    let plain = |_: &mut StageOptions| {};
    assert!(!is_by_hand(plain));
    assert!(is_by_hand(|s| s.address[1] = AddressMode::Border));
    assert!(is_by_hand(|s| s.address[0] = AddressMode::MirrorOnce));
    // A mirrored coordinate on the edge of a texel is on the wrong side of it, which a linear filter does not mind.
    assert!(!is_by_hand(|s| s.address[0] = AddressMode::Mirror));
    assert!(is_by_hand(|s| {
        (s.address[0], s.min) = (AddressMode::Mirror, Filter::Point);
    }));
    // 2D textures have no third axis, cubes none at all.
    assert!(!is_by_hand(|s| s.address[2] = AddressMode::Border));
    assert!(!is_by_hand(|s| {
        s.texture = Some(TextureKind::Cube);
        s.address = [AddressMode::Border; 3];
    }));
    assert!(is_by_hand(|s| s.weights = Weights::EightBits));
    assert!(!is_by_hand(|s| {
        s.weights = Weights::EightBits;
        (s.mag, s.min) = (Filter::Point, Filter::Point);
    }));
    assert!(is_by_hand(|s| {
        s.weights = Weights::EightBits;
        (s.mag, s.min, s.mip) = (Filter::Point, Filter::Point, MipFilter::Linear);
    }));
    assert!(!is_by_hand(|s| s.min = Filter::Anisotropic));
    assert!(is_by_hand(|s| {
        (s.min, s.max_anisotropy) = (Filter::Anisotropic, 2);
    }));
    // Anisotropic filters are for minification only.
    assert!(!is_by_hand(|s| {
        (s.mag, s.max_anisotropy) = (Filter::Anisotropic, 2);
    }));
    let limited = |s: &mut StageOptions| {
        (s.max_mip_level, s.mip) = (1, MipFilter::Linear);
    };
    assert!(!is_by_hand(limited));
    assert!(is_by_hand(|s| {
        limited(s);
        s.mag = Filter::Point;
    }));
    assert!(is_by_hand(|s| {
        (s.lod_bias, s.mip) = (true, MipFilter::Point);
    }));
    assert!(!is_by_hand(|s| {
        (s.lod_bias, s.mip) = (true, MipFilter::Linear);
    }));
}

#[test]
fn a_border_is_a_texel_like_others() {
    let stage = StageOptions {
        address: [AddressMode::Border, AddressMode::Mirror, AddressMode::Wrap],
        byte_texels: true,
        ..StageOptions::default()
    };
    let source = translated(stage, false).source;
    for line in [
        "    return select(round(255.0 * textureLoad(t, place, level)), 255.0 * border, place.x != i.x);",
        "    let place = vec2i(clamp(i.x, 0, n.x - 1), mirrored(i.y, n.y));",
        "    return linear_border_mirror_bytes(t, at, 0, border) / 255.0;",
        "sample_linear_border_mirror_bytes(texture0, in.t0.xy, ps.border0)",
    ] {
        assert!(source.contains(line), "{line}\n{source}");
    }
    // Nothing depends on the level of detail.
    assert!(!source.contains("dpdx"), "{source}");
}

/// Probes by the rule: their number is the ratio of the derivatives rounded up, at most eight here.
#[test]
fn probes_are_a_loop() {
    let stage = StageOptions {
        min: Filter::Anisotropic,
        mip: MipFilter::Linear,
        max_anisotropy: 8,
        lod_bias: true,
        max_mip_level: 2,
        ..StageOptions::default()
    };
    let source = translated(stage, false).source;
    for line in [
        "clamp(ceil(ratio - 0.0009765625), 1.0, 8.0);",
        "for (var probe = 0.5; probe < probes; probe += 1.0) {",
        "let place = at + along * (probe / probes - 0.5);",
        "sum += linear_mips_wrap(t, place, lambda - log2(probes), levels);",
        "(texture0, in.t0.xy, ps.lod_bias0, ps.levels0)",
    ] {
        assert!(source.contains(line), "{line}\n{source}");
    }
}

/// All that there is together, once: names do not clash, calls have what they want, types fit.
#[test]
fn every_combination_is_valid() {
    let kinds = TextureKind::ALL.iter();
    let mut states = Vec::new();
    for kind in kinds {
        for address in AddressMode::ALL {
            for mag in [Filter::Point, Filter::Linear] {
                for min in Filter::ALL {
                    for mip in MipFilter::ALL {
                        states.push((*kind, *address, mag, *min, *mip));
                    }
                }
            }
        }
    }
    // The other switches differ from one combination to the next, in turn.
    for (number, (kind, address, mag, min, mip)) in states.into_iter().enumerate() {
        let is = |bit: u32| number >> bit & 1 == 1;
        for level_zero in [false, true] {
            let stage = StageOptions {
                texture: Some(kind),
                seamless: is(0),
                address: [address, AddressMode::Clamp, address],
                mag,
                min,
                mip,
                max_mip_level: u32::from(is(3)),
                max_anisotropy: 16,
                lod_bias: is(1),
                byte_texels: is(2),
                weights: match is(4) {
                    true => Weights::EightBits,
                    false => Weights::Full,
                },
                ..StageOptions::default()
            };
            let source = translated(stage, level_zero).source;
            assert!(!(level_zero && source.contains("dpd")), "{source}");
        }
    }
}

/// Stages that are sampled in different ways each have functions of their own, and those that are alike share them.
#[test]
fn stages_share_functions() {
    let mut options = Options::default();
    for (stage, mode) in [
        (0, AddressMode::Border),
        (1, AddressMode::MirrorOnce),
        (2, AddressMode::Border),
    ] {
        options.stages[stage].address = [mode; 3];
    }
    let listing =
        "ps.1.4\ntexld r0, t0\ntexld r1, t1\ntexld r2, t2\nadd r0, r0, r1\nadd r0, r0, r2\n";
    let source = Shader::new(listing).translate(&options).source;
    validate(&source);
    assert_eq!(source.matches("fn texel_border(").count(), 1, "{source}");
    assert_eq!(source.matches("fn texel_mirror_once(").count(), 1);
    assert_eq!(source.matches("fn between(").count(), 1);
}
