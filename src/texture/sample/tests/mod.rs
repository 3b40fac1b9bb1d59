//! Expected values are worked out by hand from section 7 of the specification.

mod anisotropic;

use proptest::prelude::*;

use super::*;
use crate::texture::Format;
use crate::texture::TextureKind::{Cube, Texture2D, Volume};

/// A row of texels whose red is given; the other channels are 0.
fn row(reds: &[f32]) -> Texture {
    let texels: Vec<_> = reds.iter().map(|&red| [red, 0.0, 0.0, 0.0]).collect();
    Texture::from_texels(
        Texture2D,
        Format::Rgba32F,
        [reds.len() as u32, 1, 1],
        &[texels],
    )
    .unwrap()
}

/// Levels of 8×8, 4×4, 2×2, 1×1 texels; red is the number of the level.
fn numbered_levels() -> Texture {
    let levels: Vec<Vec<[f32; 4]>> = (0..4)
        .map(|l| vec![[l as f32, 0.0, 0.0, 0.0]; 64 >> (2 * l)])
        .collect();
    Texture::from_texels(Texture2D, Format::Rgba32F, [8, 8, 1], &levels).unwrap()
}

fn both(filter: Filter) -> Sampler {
    Sampler {
        mag: filter,
        min: filter,
        ..Sampler::default()
    }
}

fn red(texture: &Texture, sampler: &Sampler, u: f32) -> f32 {
    sample_at(Some(texture), sampler, [u, 0.5, 0.5], 0.0)[0]
}

/// Expected numbers: shares rounded to 1/256 by hand.
#[test]
fn weights_of_eight_bits_round_the_shares() {
    let texture = row(&[0.0, 1.0]);
    let sampler = Sampler {
        weights: Weights::EightBits,
        ..both(Filter::Linear)
    };
    // x = 2u − 0.5 = 0.3: 76.8/256 → 77/256; 0.501 / 256 rounds up, 0.499 / 256 down to the first texel alone.
    for (x, share) in [(0.3, 77.0), (0.501 / 256.0, 1.0), (0.499 / 256.0, 0.0)] {
        let u = (x + 0.5) / 2.0;
        assert!(
            (red(&texture, &sampler, u) - share / 256.0).abs() < 1e-7,
            "{x}"
        );
    }
    // λ = 0.4: 102.4/256 of the second level.
    let sampler = Sampler {
        mip: MipFilter::Linear,
        ..sampler
    };
    let between = sample_at(Some(&numbered_levels()), &sampler, [0.5; 3], 0.4)[0];
    assert_eq!(between, 102.0 / 256.0);
    let levels = footprint(&numbered_levels(), &sampler, [0.5; 3], 0.4).levels;
    assert_eq!(levels, [(0, 154.0 / 256.0), (1, 102.0 / 256.0)]);
}

#[test]
fn no_texture_reads_black_and_opaque() {
    let mut out = [[7.0; 4]; 4];
    sample_quads(None, &Sampler::default(), &[[0.5; 4]; 3], &mut out);
    assert_eq!(out, [[0.0; 4], [0.0; 4], [0.0; 4], [1.0; 4]]);
    assert_eq!(
        sample_at(None, &Sampler::default(), [0.0; 3], 0.0),
        [0.0, 0.0, 0.0, 1.0]
    );
}

#[test]
fn address_modes_by_index() {
    // n = 4 and n = 3; indices −7 … 8, from the formulas of section 7.1.
    let modes = [
        (
            AddressMode::Wrap,
            4,
            [1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0],
        ),
        (
            AddressMode::Wrap,
            3,
            [2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2],
        ),
        (
            AddressMode::Mirror,
            4,
            [1, 2, 3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 2, 1, 0, 0],
        ),
        (
            AddressMode::Mirror,
            3,
            [0, 0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0, 0, 1, 2],
        ),
        (
            AddressMode::Clamp,
            4,
            [0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3],
        ),
        (
            AddressMode::Border,
            4,
            [-1, -1, -1, -1, -1, -1, -1, 0, 1, 2, 3, -1, -1, -1, -1, -1],
        ),
        (
            AddressMode::MirrorOnce,
            4,
            [3, 3, 3, 3, 2, 1, 0, 0, 1, 2, 3, 3, 3, 3, 3, 3],
        ),
    ];
    for (mode, n, expected) in modes {
        let found: Vec<i32> = (-7..9).map(|i| address(i, n, mode)).collect();
        assert_eq!(found, expected, "{mode} {n}");
    }
}

#[test]
fn point_takes_the_texel_that_holds_the_coordinate() {
    let texture = row(&[1.0, 2.0, 3.0, 4.0]);
    let sampler = both(Filter::Point);
    for (u, expected) in [
        (0.0, 1.0),
        (0.249, 1.0),
        (0.25, 2.0),
        (0.999, 4.0),
        (1.0, 1.0),
        (-0.01, 4.0),
        (2.3, 2.0),
    ] {
        assert_eq!(red(&texture, &sampler, u), expected, "u = {u}");
    }
}

#[test]
fn linear_weighs_by_distance_from_texel_centres() {
    let texture = row(&[10.0, 20.0, 40.0, 80.0]);
    let mut sampler = both(Filter::Linear);
    // u·4 − 0.5: 0.125 → 0 (a centre); 0.25 → 0.5; 0.3125 → 0.75.
    for (u, expected) in [
        (0.125, 10.0),
        (0.25, 15.0),
        (0.3125, 17.5),
        (0.375, 20.0),
        (0.5, 30.0),
    ] {
        assert_eq!(red(&texture, &sampler, u), expected, "u = {u}");
    }
    // u = 0 lies between texels −1 and 0, u = 1 between 3 and 4: half of each.
    for (mode, left, right) in [
        (AddressMode::Wrap, 45.0, 45.0),
        (AddressMode::Mirror, 10.0, 80.0),
        (AddressMode::Clamp, 10.0, 80.0),
        (AddressMode::MirrorOnce, 10.0, 80.0),
        (AddressMode::Border, 7.0, 42.0),
    ] {
        sampler.address[0] = mode;
        sampler.border[0] = 4.0;
        assert_eq!(
            [red(&texture, &sampler, 0.0), red(&texture, &sampler, 1.0)],
            [left, right],
            "{mode}"
        );
    }
}

#[test]
fn bilinear_and_trilinear_in_a_volume() {
    let bytes: Vec<u8> = [0u8, 100, 40, 200].iter().flat_map(|&v| [v; 4]).collect();
    let texture = Texture::from_rgba8(2, 2, &bytes).unwrap();
    let sampler = Sampler {
        address: [AddressMode::Clamp; 3],
        ..both(Filter::Linear)
    };
    // fx = 0.25, fy = 0.5: rows 25 and 80, mean 52.5.
    let value = sample_at(Some(&texture), &sampler, [0.375, 0.5, 9.0], 0.0);
    assert_eq!(value, [52.5 / 255.0; 4]);

    let texels: Vec<_> = (0..8).map(|i| [(1 << i) as f32; 4]).collect();
    let volume = Texture::from_texels(Volume, Format::Rgba32F, [2, 2, 2], &[texels]).unwrap();
    // The middle: the mean of 1, 2, 4, … 128 = 255/8.
    assert_eq!(
        sample_at(Some(&volume), &sampler, [0.5; 3], 0.0),
        [31.875; 4]
    );
    // w = 0.25 is the first slice's centre: (1 + 2 + 4 + 8)/4.
    assert_eq!(
        sample_at(Some(&volume), &sampler, [0.5, 0.5, 0.25], 0.0),
        [3.75; 4]
    );
}

#[test]
fn border_keeps_the_values_of_channels_that_the_format_lacks() {
    let sampler = Sampler {
        address: [AddressMode::Border; 3],
        border: [0.2, 0.4, 0.6, 0.8],
        ..Sampler::default()
    };
    for (format, expected) in [
        (Format::A8R8G8B8, [0.2, 0.4, 0.6, 0.8]),
        (Format::X8R8G8B8, [0.2, 0.4, 0.6, 1.0]),
        (Format::L8, [0.2, 0.4, 0.6, 1.0]),
        (Format::V8U8, [0.2, 0.4, 1.0, 1.0]),
        (Format::Q8W8V8U8, [0.2, 0.4, 0.6, 0.8]),
        (Format::A8, [0.0, 0.0, 0.0, 0.8]),
    ] {
        let texture = Texture::from_texels(Texture2D, format, [1, 1, 1], &[[[0.0; 4]]]).unwrap();
        assert_eq!(
            sample_at(Some(&texture), &sampler, [1.5, 0.5, 0.0], 0.0),
            expected,
            "{format}"
        );
    }
}

/// Border colours come from bytes: each must come through the codes of packed texels unchanged.
#[test]
fn border_bytes_are_exact() {
    let texture = Texture::from_rgba8(1, 1, &[0; 4]).unwrap();
    for byte in 0..=255u8 {
        let border = [f32::from(byte) / 255.0; 4];
        let sampler = Sampler {
            address: [AddressMode::Border; 3],
            border,
            ..Sampler::default()
        };
        assert_eq!(
            sample_at(Some(&texture), &sampler, [-0.5, 0.5, 0.0], 0.0),
            border
        );
    }
}

#[test]
fn mip_levels_by_lambda() {
    let texture = numbered_levels();
    let read = |sampler: &Sampler, lod| sample_at(Some(&texture), sampler, [0.5, 0.5, 0.0], lod)[0];
    let mut sampler = Sampler::default();
    assert_eq!(read(&sampler, 2.0), 0.0);
    sampler.mip = MipFilter::Point;
    // Halves round up; below 0 and above the last level clamps.
    for (lod, level) in [
        (-3.0, 0.0),
        (0.49, 0.0),
        (0.5, 1.0),
        (1.49, 1.0),
        (1.5, 2.0),
        (2.5, 3.0),
        (99.0, 3.0),
    ] {
        assert_eq!(read(&sampler, lod), level, "λ = {lod}");
    }
    sampler.mip = MipFilter::Linear;
    for (lod, level) in [
        (-3.0, 0.0),
        (0.25, 0.25),
        (1.0, 1.0),
        (2.75, 2.75),
        (3.5, 3.0),
        (f32::INFINITY, 3.0),
    ] {
        assert_eq!(read(&sampler, lod), level, "λ = {lod}");
    }
    assert_eq!(read(&sampler, f32::NAN), 0.0);
    sampler.max_mip_level = 2;
    assert_eq!([read(&sampler, 0.0), read(&sampler, 2.5)], [2.0, 2.5]);
    sampler.max_mip_level = 9;
    assert_eq!(read(&sampler, 0.0), 3.0);
}

#[test]
fn lambda_chooses_between_mag_and_min() {
    let texture = row(&[0.0, 1.0]);
    let sampler = Sampler {
        mag: Filter::Linear,
        min: Filter::Point,
        ..Sampler::default()
    };
    // u = 0.4: x = 0.3 linear; the first texel by point.
    let at = |lod| sample_at(Some(&texture), &sampler, [0.4, 0.5, 0.0], lod)[0];
    assert!((at(0.0) - 0.3).abs() < 1e-6);
    assert_eq!(at(0.01), 0.0);
}

#[test]
fn lambda_of_known_quads() {
    let texture = numbered_levels();
    let mut sampler = Sampler::default();
    let near = |a: f32, b: f32| (a - b).abs() < 1e-6;
    let lod = |sampler: &Sampler, quad| details(&texture, sampler, &quad).map(|d| d.lambda());
    // A step of 2/8 in u is two texels, one of 1/8 in v is one: the longer counts, λ = 1.
    let across = [
        [0.0; 3],
        [0.25, 0.0, 9.0],
        [0.0, 0.125, 0.0],
        [0.25, 0.125, 0.0],
    ];
    assert_eq!(lod(&sampler, across), [1.0; 4]);
    // Rows of 2 and 4 texels, columns of 4 and √(6² + 4²) = √52 texels.
    let crooked = [[0.5; 3], [0.75, 0.5, 0.5], [0.5, 0.0, 0.5], [0.0; 3]];
    let [a, b, c, d] = lod(&sampler, crooked);
    assert_eq!([a, c], [2.0; 2]);
    assert!([b, d].into_iter().all(|lod| near(lod, 0.5 * 52f32.log2())));
    // A slanted step of 3 and 4 texels is 5 long; the third pixel has no step at all.
    let slanted = [[0.0; 3], [0.375, 0.5, 0.0], [0.0; 3], [0.0; 3]];
    let [a, b, c, d] = lod(&sampler, slanted);
    assert!([a, b, d].into_iter().all(|lod| near(lod, 5f32.log2())));
    assert_eq!(c, f32::NEG_INFINITY);
    sampler.lod_bias = -0.5;
    assert_eq!(lod(&sampler, across), [0.5; 4]);

    let cube = Texture::from_texels(Cube, Format::L8, [4, 4, 1], &[[[0.0; 4]; 96]]).unwrap();
    let lod = |quad| details(&cube, &Sampler::default(), &quad).map(|d| d.lambda());
    // On +Z from (0,0,1) to (0.5,0,1): sc 0 → 0.5, u by 0.25, one texel: λ = 0; the same direction longer is the same.
    let quad = [
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 2.0],
        [0.0, 0.0, 3.0],
        [2.0, 0.0, 4.0],
    ];
    assert_eq!(lod(quad), [0.0; 4]);
    // Across the edge to +X. On the plane of +Z: from sc = 1 to (1.5, 0, 1), sc = 1.5, again one texel. On that of +X the
    // second pixel is at sc = −2/3 and the first at −1: u by 1/6, two thirds of a texel.
    let quad = [
        [1.0, 0.0, 1.0],
        [3.0, 0.0, 2.0],
        [1.0, 0.0, 1.0],
        [3.0, 0.0, 2.0],
    ];
    let [a, b, c, d] = lod(quad);
    assert_eq!([a, c], [0.0; 2]);
    assert!(
        [b, d]
            .into_iter()
            .all(|lod| near(lod, (2.0f32 / 3.0).log2()))
    );
}

#[test]
fn quads_give_levels_and_lone_lanes_have_none() {
    let texture = numbered_levels();
    let sampler = Sampler {
        mip: MipFilter::Point,
        ..Sampler::default()
    };
    // Lanes 0 to 3: steps of four texels, level 2. Lanes 4 to 7: steps of one texel, level 0. Lane 8 is alone.
    let mut coords = [[0.0; 9]; 3];
    coords[0][..8].copy_from_slice(&[0.0, 0.5, 0.0, 0.5, 0.0, 0.125, 0.0, 0.125]);
    coords[1][..8].copy_from_slice(&[0.0, 0.0, 0.5, 0.5, 0.0, 0.0, 0.125, 0.125]);
    let mut out = [[9.0; 9]; 4];
    sample_quads(Some(&texture), &sampler, &coords, &mut out);
    assert_eq!(out[0], [2.0, 2.0, 2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let sampler = Sampler {
        max_mip_level: 1,
        lod_bias: 5.0,
        ..sampler
    };
    let mut out = [[9.0; 1]; 4];
    sample_quads(Some(&texture), &sampler, &[[0.5]; 3], &mut out);
    assert_eq!(out[0], [1.0]);
}

/// A cube of 2×2 faces; red is the face number, green 1 in the right column, blue 1 in the lower row.
fn small_cube() -> Texture {
    let texels: Vec<_> = (0..24)
        .map(|i| [(i / 4) as f32, (i % 2) as f32, (i / 2 % 2) as f32, 1.0])
        .collect();
    Texture::from_texels(Cube, Format::Rgba32F, [2, 2, 1], &[texels]).unwrap()
}

#[test]
fn cube_filters_stay_inside_the_face_unless_seamless() {
    let cube = small_cube();
    let mut sampler = both(Filter::Linear);
    sampler.address = [AddressMode::Border; 3];
    // The right edge of +Z (4), at its vertical middle, taken as +Z because of the tie: u = 1, x = 1.5.
    let edge = [1.0, 0.0, 1.0];
    assert_eq!(
        sample_at(Some(&cube), &sampler, edge, 0.0),
        [4.0, 1.0, 0.5, 1.0]
    );
    sampler.seamless = true;
    // Half of +Z's right column (4, 1, ·), half of +X's left column (0, 0, ·), both rows.
    assert_eq!(
        sample_at(Some(&cube), &sampler, edge, 0.0),
        [2.0, 0.5, 0.5, 1.0]
    );
    // The corner of +Z, +X and +Y: four corner taps of ¼ each, the missing one the mean of the three others: together
    // a third each. +Z's texel (4, 1, 0), +X's (0, 0, 0), +Y's lower right (2, 1, 1).
    let corner = sample_at(Some(&cube), &sampler, [1.0, 1.0, 1.0], 0.0);
    for (got, want) in corner.into_iter().zip([2.0, 2.0 / 3.0, 1.0 / 3.0, 1.0]) {
        assert!((got - want).abs() < 1e-6, "{corner:?}");
    }
    // The middle of a face needs no neighbour.
    assert_eq!(
        sample_at(Some(&cube), &sampler, [0.0, 0.0, -3.0], 0.0),
        [5.0, 0.5, 0.5, 1.0]
    );
}

#[test]
fn footprints_name_texels_and_shares() {
    let texture = numbered_levels();
    let sampler = Sampler {
        mip: MipFilter::Linear,
        ..both(Filter::Linear)
    };
    // λ = 2.25: three quarters of the 2×2 level, a quarter of the 1×1 level (wrapped: always the one texel).
    let print = footprint(&texture, &sampler, [0.25, 0.5, 0.0], 2.25);
    assert_eq!(print.levels, [(2, 0.75), (3, 0.25)]);
    let of_level = |level| print.taps.iter().filter(move |tap| tap.level == level);
    // x = 0 exactly: one column; y = 0.5: two rows.
    let taps: Vec<_> = of_level(2).map(|tap| (tap.texel, tap.weight)).collect();
    assert_eq!(taps, [(Some([0, 0, 0]), 0.375), (Some([0, 1, 0]), 0.375)]);
    assert!(of_level(3).all(|tap| tap.texel == Some([0, 0, 0])));
    assert_eq!(of_level(3).map(|tap| tap.weight).sum::<f32>(), 0.25);

    let sampler = Sampler {
        address: [AddressMode::Border; 3],
        ..Sampler::default()
    };
    let print = footprint(&texture, &sampler, [-0.1, 0.5, 0.0], 0.0);
    assert_eq!(
        print.taps,
        [Tap {
            face: 0,
            level: 0,
            texel: None,
            weight: 1.0
        }]
    );

    let sampler = Sampler {
        seamless: true,
        ..both(Filter::Linear)
    };
    let print = footprint(&small_cube(), &sampler, [1.0, 0.0, 1.0], 0.0);
    assert_eq!((print.face, print.uvw), (4, [1.0, 0.5, 0.0]));
    let faces: Vec<_> = print
        .taps
        .iter()
        .map(|tap| (tap.face, tap.weight))
        .collect();
    assert_eq!(faces, [(4, 0.25), (0, 0.25), (4, 0.25), (0, 0.25)]);
}

#[test]
fn nan_is_zero_and_infinity_is_far() {
    let texture = row(&[1.0, 2.0, 3.0]);
    let mut sampler = both(Filter::Point);
    assert_eq!(red(&texture, &sampler, f32::NAN), 1.0);
    sampler.address = [AddressMode::Clamp; 3];
    assert_eq!(red(&texture, &sampler, f32::INFINITY), 3.0);
    assert_eq!(red(&texture, &sampler, f32::NEG_INFINITY), 1.0);
    assert_eq!(red(&texture, &sampler, f32::MAX), 3.0);
    sampler.mag = Filter::Linear;
    assert_eq!(red(&texture, &sampler, f32::INFINITY), 3.0);
    // NaN is u = 0: the left edge.
    assert_eq!(red(&texture, &sampler, f32::NAN), 1.0);
}

fn any_sampler() -> BoxedStrategy<Sampler> {
    let modes = [
        AddressMode::Wrap,
        AddressMode::Mirror,
        AddressMode::Clamp,
        AddressMode::Border,
        AddressMode::MirrorOnce,
    ];
    let filter = || prop::sample::select(Filter::ALL);
    let mips = prop::sample::select(vec![MipFilter::None, MipFilter::Point, MipFilter::Linear]);
    let address = prop::array::uniform3(prop::sample::select(modes.to_vec()));
    (
        address,
        filter(),
        filter(),
        mips,
        any::<f32>(),
        0u32..6,
        0u32..20,
        0u8..4,
    )
        .prop_map(
            |(address, mag, min, mip, lod_bias, max_mip_level, max_anisotropy, flags)| Sampler {
                address,
                mag,
                min,
                mip,
                lod_bias,
                max_mip_level,
                max_anisotropy,
                border: [0.5; 4],
                seamless: flags & 1 == 1,
                weights: if flags & 2 == 2 {
                    Weights::EightBits
                } else {
                    Weights::Full
                },
            },
        )
        .boxed()
}

fn any_coord() -> BoxedStrategy<f32> {
    prop_oneof![
        -3.0f32..3.0,
        any::<f32>(),
        Just(f32::NAN),
        Just(f32::INFINITY),
        Just(f32::NEG_INFINITY)
    ]
    .boxed()
}

proptest! {
    /// Filters average: whatever the coordinate, the result lies between the smallest and the largest texel, and
    /// equals the sum over the footprint.
    #[test]
    fn results_stay_within_the_texels(
        sampler in any_sampler(),
        kind in prop::sample::select(vec![Texture2D, Cube, Volume]),
        packed: bool,
        edge in 1u32..6,
        quads in prop::array::uniform3(prop::array::uniform8(any_coord())),
        lod in any::<f32>(),
    ) {
        let size = [edge, edge, if kind == Volume { 3 } else { 1 }];
        let count = (edge * edge * size[2]) as usize * kind.face_count();
        // Red, green, blue and alpha from 51/255 to 204/255: 0.2 to 0.8.
        let texels: Vec<_> = (0..count).map(|i| [0, 1, 2, 3].map(|c| 0.2 + 0.1 * ((i + c) % 7) as f32)).collect();
        let format = if packed { Format::Rgba8 } else { Format::Rgba32F };
        let mut texture = Texture::from_texels(kind, format, size, &[texels]).unwrap();
        texture.generate_mips().unwrap();
        let mut out = [[0.0; 8]; 4];
        sample_quads(Some(&texture), &sampler, &quads, &mut out);
        for value in out.into_iter().flatten() {
            prop_assert!((0.199..=0.801).contains(&value), "{value}");
        }
        let coord = quads.map(|lane| lane[0]);
        let quad = std::array::from_fn(|lane| quads.map(|lanes| lanes[lane]));
        for detail in [Detail::from(lod), details(&texture, &sampler, &quad)[0]] {
            let value = sample_at(Some(&texture), &sampler, coord, detail);
            let print = footprint(&texture, &sampler, coord, detail);
            let mut sum = [0.0f32; 4];
            for tap in &print.taps {
                let texel = match tap.texel {
                    Some([x, y, z]) => texture.texel(tap.face, tap.level, x, y, z).unwrap(),
                    None => sampler.border,
                };
                for (sum, value) in sum.iter_mut().zip(texel) {
                    *sum += tap.weight * value;
                }
            }
            for (a, b) in value.into_iter().zip(sum) {
                prop_assert!((a - b).abs() < 1e-5, "{value:?} {sum:?}");
            }
        }
    }
}
