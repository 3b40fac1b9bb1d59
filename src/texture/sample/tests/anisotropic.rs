//! Anisotropic filters. Numbers are worked out by hand from the rule in the documentation of [`Detail`].

use super::*;

/// Levels of 16×16 to 1×1 texels; red is the column and 100 for each level, green the row.
fn columns() -> Texture {
    let levels: Vec<Vec<[f32; 4]>> = (0..5)
        .map(|level| {
            let edge = 16 >> level;
            let texel = |i: usize| [(100 * level + i % edge) as f32, (i / edge) as f32, 0.0, 1.0];
            (0..edge * edge).map(texel).collect()
        })
        .collect();
    Texture::from_texels(Texture2D, Format::Rgba32F, [16, 16, 1], &levels).unwrap()
}

fn anisotropic(most: u32) -> Sampler {
    Sampler {
        min: Filter::Anisotropic,
        mag: Filter::Linear,
        mip: MipFilter::Linear,
        max_anisotropy: most,
        ..Sampler::default()
    }
}

/// A quad around (0.5, 0.5) whose first pixel has these derivatives, in texels of `edge`.
fn quad(x: [f32; 2], y: [f32; 2], edge: f32) -> [[f32; 3]; 4] {
    let at = |a: f32, b: f32| [0, 1].map(|i| 0.5 + (a * x[i] + b * y[i]) / edge);
    [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)].map(|[u, v]| [u, v, 0.5])
}

fn first(texture: &Texture, sampler: &Sampler, quad: [[f32; 3]; 4]) -> (Detail, [f32; 4]) {
    let detail = details(texture, sampler, &quad)[0];
    (detail, sample_at(Some(texture), sampler, quad[0], detail))
}

#[test]
fn probes_lie_along_the_longer_derivative() {
    let texture = columns();
    // 8 texels along u and 2 along v: λ = 3. Four probes, each of 2 texels: level 1, eight texels wide. They are an eighth
    // apart: u = 5/16, 7/16, 9/16, 11/16, where 8u − 0.5 = 2, 3, 4, 5: columns 102 to 105.
    let (detail, value) = first(
        &texture,
        &anisotropic(16),
        quad([8.0, 0.0], [0.0, 2.0], 16.0),
    );
    assert_eq!((detail.lambda(), detail.probes()), (3.0, 4));
    assert_eq!(value[..2], [103.5, 3.5]);
    let print = footprint(&texture, &anisotropic(16), [0.5; 3], detail);
    assert_eq!(print.levels, [(1, 1.0)]);
    let columns: Vec<_> = print.taps.iter().filter_map(|tap| tap.texel).collect();
    // v = 0.5 lies between rows 3 and 4.
    let expected = [2, 3, 4, 5].map(|x| [[x, 3, 0], [x, 4, 0]]);
    assert_eq!(columns, expected.as_flattened());
    assert!(print.taps.iter().all(|tap| tap.weight == 0.125));
    // The same turned by 90°: rows 2 to 5.
    let (_, value) = first(
        &texture,
        &anisotropic(16),
        quad([0.0, 2.0], [0.0, 8.0], 16.0),
    );
    assert_eq!(value[1], 3.5);
    // Slanted, 6 and 8 texels, and 5 at right angles to it: λ = log2 10, two probes of 5 texels.
    let (detail, _) = first(
        &texture,
        &anisotropic(16),
        quad([6.0, 8.0], [-4.0, 3.0], 16.0),
    );
    assert_eq!(detail.probes(), 2);
    assert!((detail.lambda() - 10f32.log2()).abs() < 1e-6);
    assert!((detail.level() - 5f32.log2()).abs() < 1e-6);
}

#[test]
fn the_most_probes_are_a_state() {
    let texture = columns();
    let of = |most: u32, x: f32, y: f32| {
        let (detail, value) = first(&texture, &anisotropic(most), quad([x, 0.0], [0.0, y], 16.0));
        (detail.probes(), detail.level(), value[0])
    };
    // Two probes of 4 texels: level 2, u = 3/8 and 5/8, where 4u − 0.5 = 1 and 2.
    assert_eq!(of(2, 8.0, 2.0), (2, 2.0, 201.5));
    // One: level 3 of two columns, in the middle between them; as a linear filter.
    assert_eq!(of(1, 8.0, 2.0), (1, 3.0, 300.5));
    assert_eq!(of(0, 8.0, 2.0), of(1, 8.0, 2.0));
    // 8 to 3 is 2.67: three probes. 8 to 1 is eight, also if 8 is a little more than that.
    assert_eq!(of(16, 8.0, 3.0).0, 3);
    assert_eq!(of(16, 8.0, 1.0).0, 8);
    assert_eq!(of(16, 8.000_01, 1.0).0, 8);
    assert_eq!(of(16, 8.01, 1.0).0, 9);
    // No more than 16, whatever is asked for and however narrow the strip.
    assert_eq!(of(99, 16.0, 0.5).0, 16);
    assert_eq!(of(16, 8.0, 0.0).0, 16);
}

/// Stripes of two rows, seen so that a pixel covers eight columns of one row: the linear filter sees grey, the anisotropic
/// one stripes.
#[test]
fn stripes_along_the_longer_derivative_stay() {
    let texels: Vec<_> = (0..256).map(|i| [(i / 32 % 2) as f32; 4]).collect();
    let mut texture =
        Texture::from_texels(Texture2D, Format::Rgba32F, [16, 16, 1], &[texels]).unwrap();
    texture.generate_mips().unwrap();
    let sampler = anisotropic(8);
    // Along u 8 texels, along v one: λ = 3, eight probes in level 0. v = 0.5 is the upper edge of row 8, which is the first
    // of a black stripe behind a white one; half a texel further is its middle, two further the middle of a white one's row.
    for (v, stripe) in [(0.5, 0.5), (17.0 / 32.0, 0.0), (21.0 / 32.0, 1.0)] {
        let moved = quad([8.0, 0.0], [0.0, 1.0], 16.0).map(|[u, w, _]| [u, w - 0.5 + v, 0.0]);
        assert_eq!(first(&texture, &sampler, moved).1[0], stripe, "v = {v}");
        // Level 3 has two rows, each of four stripes' mean.
        let linear = Sampler {
            min: Filter::Linear,
            ..sampler
        };
        assert_eq!(first(&texture, &linear, moved).1[0], 0.5);
    }
}

#[test]
fn the_bias_and_the_filters_between_levels() {
    let texture = columns();
    let strip = quad([8.0, 0.0], [0.0, 2.0], 16.0);
    // λ = 3 + 0.5 is λ of the strip, that of a probe is 1.5: half of level 1 (103.5) and half of level 2, where
    // 4u − 0.5 = 0.75, 1.25, 1.75, 2.25: 201.5.
    let mut sampler = Sampler {
        lod_bias: 0.5,
        ..anisotropic(16)
    };
    assert_eq!(first(&texture, &sampler, strip).1[0], 152.5);
    // The nearest level, halves up: 2.
    sampler.mip = MipFilter::Point;
    assert_eq!(first(&texture, &sampler, strip).1[0], 201.5);
    // Always level 0, where 16u − 0.5 = 4.5, 6.5, 8.5, 10.5: 7.5.
    sampler.mip = MipFilter::None;
    assert_eq!(first(&texture, &sampler, strip).1[0], 7.5);
    // No level before 3: two columns, and 2u − 0.5 = 0.125 to 0.875.
    sampler.mip = MipFilter::Linear;
    sampler.max_mip_level = 3;
    assert_eq!(first(&texture, &sampler, strip).1[0], 300.5);
    // λ = 3 − 3 is not above 0: magnified, whatever the ratio. One probe, in the middle between columns 7 and 8.
    sampler.max_mip_level = 0;
    sampler.lod_bias = -3.0;
    let (detail, value) = first(&texture, &sampler, strip);
    assert_eq!((detail.probes(), value[0]), (1, 7.5));
    // λ = 0.5 is minified though a probe's λ, −1.5, is not: the probes read level 0.
    sampler.lod_bias = -2.5;
    let (detail, value) = first(&texture, &sampler, strip);
    assert_eq!((detail.probes(), detail.level()), (4, -1.5));
    assert_eq!(value[0], 7.5);
}

#[test]
fn magnified_it_is_linear() {
    let texture = row(&[0.0, 1.0]);
    let sampler = Sampler {
        max_anisotropy: 16,
        ..both(Filter::Anisotropic)
    };
    // x = 2 · 0.4 − 0.5 = 0.3.
    assert!((red(&texture, &sampler, 0.4) - 0.3).abs() < 1e-6);
}

#[test]
fn probes_in_a_volume() {
    // Eight slices, numbered; 8 texels along w, 2 along u: four probes of 2 texels, in level 1 with slices 0.5, 2.5, ….
    let texels: Vec<_> = (0..512).map(|i| [(i / 64) as f32; 4]).collect();
    let mut texture = Texture::from_texels(Volume, Format::Rgba32F, [8, 8, 8], &[texels]).unwrap();
    texture.generate_mips().unwrap();
    let quad = [
        [0.5, 0.5, 0.5],
        [0.75, 0.5, 0.5],
        [0.5, 0.5, 1.5],
        [0.75, 0.5, 1.5],
    ];
    // w = 0.5 − 3/8, −1/8, 1/8, 3/8, that is 4w − 0.5 = 0, 1, 2, 3: 0.5, 2.5, 4.5, 6.5.
    let (detail, value) = first(&texture, &anisotropic(16), quad);
    assert_eq!((detail.probes(), detail.level(), value[0]), (4, 1.0, 3.5));
    let print = footprint(&texture, &anisotropic(16), quad[0], detail);
    let mut slices: Vec<_> = print.taps.iter().map(|tap| tap.texel.unwrap()[2]).collect();
    slices.dedup();
    assert_eq!(slices, [0, 1, 2, 3]);
}

#[test]
fn probes_on_a_cube_go_on_behind_its_edges() {
    // Faces of 4×4 texels; red is the face.
    let texels: Vec<_> = (0..96).map(|i| [(i / 16) as f32; 4]).collect();
    let cube = Texture::from_texels(Cube, Format::Rgba32F, [4, 4, 1], &[texels]).unwrap();
    // On +Z at the middle of the right edge, hardly inside: u by 1 (sc by 2), v by 1/2: λ = log2 4, two probes a quarter of a
    // face to the left and to the right: one on +Z, one on +X.
    let quad = [
        [0.99, 0.0, 1.0],
        [2.99, 0.0, 1.0],
        [0.99, 1.0, 1.0],
        [2.99, 1.0, 1.0],
    ];
    for seamless in [false, true] {
        let sampler = Sampler {
            seamless,
            ..anisotropic(16)
        };
        let (detail, value) = first(&cube, &sampler, quad);
        assert_eq!((detail.lambda().round(), detail.probes()), (2.0, 2));
        assert_eq!(value[0], 2.0, "the mean of faces 4 and 0");
        let print = footprint(&cube, &sampler, quad[0], detail);
        let mut faces: Vec<_> = print.taps.iter().map(|tap| tap.face).collect();
        faces.dedup();
        assert_eq!(faces, [4, 0]);
    }
    // Of two texels on the face itself: u by 1/2 and v by 1/4 around the middle, u = 3/8 and 5/8: texels 1 and 2.
    let texels: Vec<_> = (0..96).map(|i| [(i % 4) as f32; 4]).collect();
    let cube = Texture::from_texels(Cube, Format::Rgba32F, [4, 4, 1], &[texels]).unwrap();
    let quad = [
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [0.0, 0.5, 1.0],
        [1.0, 0.5, 1.0],
    ];
    let (detail, value) = first(&cube, &anisotropic(16), quad);
    assert_eq!((detail.lambda(), detail.probes(), value[0]), (1.0, 2, 1.5));
    let print = footprint(&cube, &anisotropic(16), quad[0], detail);
    let columns: Vec<_> = print.taps.iter().map(|tap| tap.texel.unwrap()[0]).collect();
    assert_eq!(columns, [1, 1, 2, 2]);
}

#[test]
fn weights_of_eight_bits_in_every_probe() {
    // 8 texels along u, none along v: two probes, 2 texels before and behind.
    let reds: Vec<f32> = (0..16).map(|i| f32::from(i == 4)).collect();
    let texture = row(&reds);
    let sampler = Sampler {
        weights: Weights::EightBits,
        ..anisotropic(2)
    };
    // x of the probes, 16 · (u ∓ 1/8) − 0.5, is 4.7504 and 8.7504; 0.7504 is 192.1/256, rounded to 192/256. Texel 4 has
    // the rest, 64/256, of the first probe.
    let u = 0.5 - 3.0 / 64.0 + 0.0004 / 16.0;
    let quad = [
        [u, 0.5, 0.0],
        [u + 0.5, 0.5, 0.0],
        [u, 0.5, 0.0],
        [u, 0.5, 0.0],
    ];
    let (detail, value) = first(&texture, &sampler, quad);
    assert_eq!(detail.probes(), 2);
    assert_eq!(value[0], (64.0 / 256.0) / 2.0);
}
