//! Both ways to sample leave the same bits. What those are is tested with the way for one quad.

use proptest::prelude::*;

use super::*;
use crate::texture::sample::detail::log2;
use crate::texture::{Filter, Format, MipFilter};

const N: usize = 32;

fn texture(kind: TextureKind, format: Format, size: [u32; 3], mips: bool, seed: u32) -> Texture {
    let mut state = seed | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        (state % 256) as f32 / 255.0
    };
    let mut levels = Vec::new();
    let mut edges = size;
    loop {
        let count = edges.iter().product::<u32>() as usize * kind.face_count();
        let level: Vec<[f32; 4]> = (0..count)
            .map(|_| std::array::from_fn(|_| next()))
            .collect();
        levels.push(level);
        if !mips || edges == [1; 3] {
            break;
        }
        edges = edges.map(|edge| (edge / 2).max(1));
    }
    Texture::from_texels(kind, format, size, &levels).unwrap()
}

/// Lanes that walk over the texture evenly, some of them disturbed, some no numbers at all.
fn coordinates() -> impl Strategy<Value = [[f32; N]; 3]> {
    let number = prop_oneof![
        20 => -3.0f32..3.0,
        2 => -1e-3f32..1e-3,
        1 => prop::sample::select(vec![0.0, -0.0, 1.0, -1.0, 0.5, f32::NAN, f32::INFINITY, -f32::INFINITY, 1e30, -4e6, 5e6, 1e-42]),
    ];
    let start = [-2.0f32..2.0, -2.0f32..2.0, -2.0f32..2.0];
    let step = prop_oneof![Just(0.0f32), 1e-4f32..1e-2, 0.01f32..0.4];
    let disturbed = prop::collection::vec((0..3usize, 0..N, number), 0..4);
    (start, step, -1.0f32..1.0, disturbed).prop_map(|(start, step, slope, disturbed)| {
        let mut coords: [[f32; N]; 3] = std::array::from_fn(|axis| {
            std::array::from_fn(|l| {
                let x = (l / 4 * 2 + l % 2) as f32;
                let y = (l % 4 / 2) as f32;
                let along = [x + slope * y, y - slope * x, 0.3 * x];
                start[axis] + step * along[axis]
            })
        });
        for (axis, lane, value) in disturbed {
            coords[axis][lane] = value;
        }
        coords
    })
}

fn samplers() -> impl Strategy<Value = Sampler> {
    let filter = || prop::sample::select(Filter::ALL);
    let mode = || prop::sample::select(AddressMode::ALL);
    (
        ([mode(), mode(), mode()], filter(), filter()),
        prop::sample::select(MipFilter::ALL),
        prop_oneof![Just(0.0f32), -3.0f32..3.0, Just(f32::NAN)],
        (0u32..4, 1u32..5),
        (any::<bool>(), any::<bool>()),
    )
        .prop_map(
            |(
                (address, mag, min),
                mip,
                lod_bias,
                (max_mip_level, max_anisotropy),
                (seamless, coarse),
            )| {
                Sampler {
                    address,
                    mag,
                    min,
                    mip,
                    lod_bias,
                    max_mip_level,
                    max_anisotropy,
                    border: [0.25, 0.5, 0.75, 1.0],
                    seamless,
                    weights: if coarse {
                        Weights::EightBits
                    } else {
                        Weights::Full
                    },
                }
            },
        )
}

fn textures() -> impl Strategy<Value = Texture> {
    let shape = prop_oneof![
        4 => (prop::sample::select(vec![1u32, 2, 5, 8, 13, 16]), prop::sample::select(vec![1u32, 3, 4, 8]))
            .prop_map(|(x, y)| (TextureKind::Texture2D, [x, y, 1])),
        4 => prop::sample::select(vec![1u32, 2, 5, 8]).prop_map(|n| (TextureKind::Cube, [n, n, 1])),
        1 => Just((TextureKind::Volume, [4, 2, 3])),
    ];
    let format = prop::sample::select(vec![Format::Rgba8, Format::Rgba32F, Format::V8U8]);
    (shape, format, any::<bool>(), any::<u32>())
        .prop_map(|((kind, size), format, mips, seed)| texture(kind, format, size, mips, seed))
}

/// NaN is one number here.
fn bits(rows: &[[f32; N]; 4]) -> [[u32; N]; 4] {
    let bits = |x: &f32| if x.is_nan() { u32::MAX } else { x.to_bits() };
    std::array::from_fn(|c| std::array::from_fn(|l| bits(&rows[c][l])))
}

fn quad_by_quad(texture: &Texture, sampler: &Sampler, coords: &[[f32; N]; 3]) -> [[f32; N]; 4] {
    let mut expected = [[0.0; N]; 4];
    for first in (0..N).step_by(4) {
        let mut quad = [[0.0; 4]; 4];
        let own = coords.map(|row| std::array::from_fn(|i| row[first + i]));
        sample_quads(Some(texture), sampler, &own, &mut quad);
        for (row, quad) in expected.iter_mut().zip(quad) {
            row[first..first + 4].copy_from_slice(&quad);
        }
    }
    expected
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn many_lanes_read_what_each_quad_reads(
        texture in textures(),
        sampler in samplers(),
        coords in coordinates(),
    ) {
        let mut found = [[0.0; N]; 4];
        sample_quads(Some(&texture), &sampler, &coords, &mut found);
        prop_assert_eq!(bits(&found), bits(&quad_by_quad(&texture, &sampler, &coords)));
    }

    /// A second texture of the same shape, with another border and other texels, read where the first one was.
    #[test]
    fn places_serve_every_texture_of_the_same_shape(
        (kind, size) in prop::sample::select(vec![(TextureKind::Texture2D, [8, 5, 1]), (TextureKind::Cube, [4, 4, 1])]),
        sampler in samplers(),
        coords in coordinates(),
        simd in prop::sample::select(Simd::ALL.to_vec()),
    ) {
        let [first, second] = [1, 2].map(|seed| texture(kind, Format::Rgba8, size, true, seed));
        let other = Sampler { border: [1.0, 0.0, 0.5, 0.0], ..sampler };
        // NaN equals nothing, so that such a bias is shared with nobody.
        prop_assert_eq!(share_places((&first, &sampler), (&second, &other)), !sampler.lod_bias.is_nan());
        let mut places = Places::default();
        let mut memory = Memory::default();
        for (texture, sampler, found) in [(&first, &sampler, false), (&second, &other, true)] {
            let mut out = [[7.0; N]; 4];
            simd.run(Sample {
                texture,
                sampler,
                coords: coords.each_ref(),
                lanes: N,
                places: &mut places,
                memory: &mut memory,
                found,
                channels: [true; 4],
                out: &mut out,
            });
            prop_assert_eq!(bits(&out), bits(&quad_by_quad(texture, sampler, &coords)));
        }
    }
}

#[test]
fn places_are_shared_only_where_everything_but_texels_is_the_same() {
    let texture = |size| texture(TextureKind::Texture2D, Format::Rgba8, size, true, 3);
    let (a, b) = (texture([8, 4, 1]), texture([8, 8, 1]));
    let sampler = Sampler::default();
    assert!(!share_places((&a, &sampler), (&b, &sampler)));
    let linear = Sampler {
        mag: Filter::Linear,
        ..sampler
    };
    assert!(!share_places((&a, &sampler), (&a, &linear)));
}

/// Against the logarithm in double precision.
#[test]
fn logarithms() {
    for exponent in -126..=127 {
        let power = f32::from_bits(((exponent + 127) as u32) << 23);
        assert_eq!(log2(power), exponent as f32);
    }
    assert_eq!(log2(0.0), f32::NEG_INFINITY);
    assert_eq!(log2(f32::INFINITY), f32::INFINITY);
    // Every 977th number that is normal.
    for bits in (0x0080_0000..0x7f80_0000).step_by(977) {
        let x = f32::from_bits(bits);
        let exact = f64::from(x).log2();
        let error = (f64::from(log2(x)) - exact).abs();
        // 2⁻²³, and half a unit in the last place of what is larger than 2.
        let most = 1.2e-7 + exact.abs() * 6e-8;
        assert!(error <= most, "{x:e}: {error:e}");
    }
}
