//! Every generator is checked for what it claims; the normal map against arithmetic by hand.

use super::*;

fn draw(name: &str, size: [u32; 2]) -> RgbaImage {
    Request {
        size: Some(size),
        ..Request::new(name)
    }
    .draw()
    .unwrap()
}

#[test]
fn every_generator_is_deterministic_and_has_the_asked_size() {
    for generator in GENERATORS {
        let first = draw(generator.name, [64, 48]);
        assert_eq!(first.dimensions(), (64, 48), "{}", generator.name);
        assert!(
            first == draw(generator.name, [64, 48]),
            "{}",
            generator.name
        );
        assert!(first.pixels().all(|p| p.0[3] == 255), "{}", generator.name);
        draw(generator.name, [1, 1]);
        draw(generator.name, [1, 300]);
    }
}

#[test]
fn the_seed_changes_what_is_random() {
    for name in [
        "bricks",
        "stone",
        "planks",
        "plaster",
        "chest",
        "stained_glass_base",
        "stained_glass_gloss",
    ] {
        let other = Request {
            size: Some([64, 64]),
            seed: Some(2),
            ..Request::new(name)
        }
        .draw()
        .unwrap();
        assert!(draw(name, [64, 64]) != other, "{name}");
    }
}

/// The mean difference between neighbouring columns, per channel: the one between the last and the first, and the others'
/// largest.
fn seam(picture: &RgbaImage) -> (f64, f64) {
    let (width, height) = picture.dimensions();
    let step = |a: u32, b: u32| {
        let sum: i32 = (0..height)
            .flat_map(|y| (0..3).map(move |c| (c, y)))
            .map(|(c, y)| {
                (i32::from(picture.get_pixel(a, y).0[c]) - i32::from(picture.get_pixel(b, y).0[c]))
                    .abs()
            })
            .sum();
        f64::from(sum) / f64::from(height)
    };
    let inner = (1..width).map(|x| step(x - 1, x)).fold(0.0, f64::max);
    (step(width - 1, 0), inner)
}

#[test]
fn seamless_pictures_have_no_seam() {
    let seamless = GENERATORS.iter().filter(|g| g.doc.contains("Seamless"));
    let mut count = 0;
    for generator in seamless {
        let picture = draw(generator.name, [256, 256]);
        for picture in [image::imageops::rotate90(&picture), picture] {
            let (across, inner) = seam(&picture);
            assert!(
                across <= inner,
                "{}: {across} at the seam, {inner} inside",
                generator.name
            );
        }
        count += 1;
    }
    assert_eq!(count, 7);
    // The measure finds a seam where there is one: 255 in three channels against steps of about one.
    let (across, inner) = seam(&image::imageops::rotate90(&draw("gradient", [256, 256])));
    assert!(across > 700.0 && inner < 10.0, "{across} {inner}");
}

#[test]
fn normal_map_of_a_ramp_by_hand() {
    // A rise of 0.1 a texel along x and a height of 10 texels: slope 1, so n = (-1, 0, 1)/√2 = (-0.7071, 0, 0.7071).
    // Stored: 0.14645 · 255 = 37.3, 0.5 · 255 = 127.5 (up: 128), 0.85355 · 255 = 217.7.
    let ramp = |f: fn(usize, usize) -> usize| {
        let heights = (0..64).map(|i| f(i % 8, i / 8) as f32 * 0.1).collect();
        HeightField::new([8, 8], heights).unwrap()
    };
    let along_u = ramp(|x, _| x).normal_map(10.0, false);
    assert_eq!(along_u.get_pixel(4, 4).0, [37, 128, 218, 255]);
    // At the edge the field goes on level: half the difference. n = (-0.5, 0, 1)/1.1180 = (-0.4472, 0, 0.8944).
    // Stored: 0.27639 · 255 = 70.5 (just below: 70), 0.94721 · 255 = 241.5 (241.54: 242).
    let [r, g, b, _] = along_u.get_pixel(0, 4).0;
    assert_eq!((r, g, b), (70, 128, 242));
    let along_v = ramp(|_, y| y).normal_map(10.0, false);
    assert_eq!(along_v.get_pixel(4, 4).0, [128, 37, 218, 255]);
    // Wrapped, the edge sees the cliff: (0.1 - 0.7) / 2 · 10 = -3, so n = (3, 0, 1)/√10: 0.97434 · 255 = 248.5 (248.46),
    // 0.65811 · 255 = 167.8.
    assert_eq!(
        ramp(|x, _| x).normal_map(10.0, true).get_pixel(0, 4).0,
        [248, 128, 168, 255]
    );
    assert!(
        draw("flat_normal", [3, 3])
            .pixels()
            .all(|p| p.0 == [128, 128, 255, 255])
    );
    assert_eq!(HeightField::new([2, 2], vec![0.0; 3]), None);
}

#[test]
fn the_three_maps_of_the_window_agree() {
    let size = [256, 320];
    let [base, gloss] = ["stained_glass_base", "stained_glass_gloss"].map(|n| draw(n, size));
    let relief = stained_glass_height(size, 1).to_image();
    let window = glass::Window::new(size, 1);
    let (mut lead, mut glass) = (0, 0);
    for (x, y, texel) in base.enumerate_pixels() {
        let (u, v) = (
            (x as f32 + 0.5) / size[0] as f32,
            (y as f32 + 0.5) / size[1] as f32,
        );
        let cover = window.lead(&window.spot(u, v));
        let shine = gloss.get_pixel(x, y).0[0];
        let height = relief.get_pixel(x, y).0[0];
        if cover == 1.0 {
            lead += 1;
            assert!(
                texel.0[..3].iter().all(|c| *c < 64),
                "lead is dark at {x},{y}: {texel:?}"
            );
            assert_eq!(shine, 13, "lead does not shine at {x},{y}");
            let middle = window.spot(u, v).to_lead < 0.001;
            assert!(
                !middle || height > 220,
                "lead is raised at {x},{y}: {height}"
            );
        } else if cover == 0.0 {
            glass += 1;
            assert!(shine > 160, "glass shines at {x},{y}: {shine}");
            assert!(height < 200, "glass lies deep at {x},{y}: {height}");
        }
    }
    assert!(lead > 5_000 && glass > 40_000, "{lead} {glass}");
}

#[test]
fn bad_requests_are_explained() {
    let message = |request: Request| request.draw().unwrap_err().to_string();
    assert!(
        message(Request::new("brick"))
            .contains("no texture generator `brick`; there are solid, checker")
    );
    let bricks = Request::new("bricks");
    assert_eq!(
        message(Request {
            size: Some([0, 5]),
            ..bricks.clone()
        }),
        "generator `bricks`: `size` is 0 by 5; each must be 1 to 4096"
    );
    assert!(
        message(Request {
            size: Some([64, u32::MAX]),
            ..bricks.clone()
        })
        .contains("1 to 4096")
    );
    assert!(
        message(Request {
            cells: Some([300, 1]),
            ..bricks.clone()
        })
        .contains("1 to 256")
    );
    assert!(
        message(Request {
            relief: Some(0.5),
            ..bricks.clone()
        })
        .contains("not a parameter")
    );
    assert!(
        message(Request {
            colors: vec![[f32::NAN; 4]],
            ..bricks.clone()
        })
        .contains("outside 0 to 1")
    );
    assert!(
        message(Request {
            colors: vec![[0.0; 4]; 3],
            ..bricks
        })
        .contains("takes 2")
    );
    assert!(
        message(Request {
            cells: Some([2, 2]),
            ..Request::new("solid")
        })
        .contains("not a parameter")
    );
    assert!(
        toml::from_str::<Request>("generate = \"solid\"\ncolour = 1")
            .unwrap_err()
            .to_string()
            .contains("colour")
    );
    let request: Request =
        toml::from_str("generate = \"solid\"\nsize = [2, 1]\ncolors = [[1.0, 0.0, 0.2, 0.0]]")
            .unwrap();
    assert_eq!(
        request.draw().unwrap().as_raw(),
        &[255, 0, 51, 0, 255, 0, 51, 0]
    );
}

#[test]
fn checker_and_gradient_by_hand() {
    let checker = Request {
        size: Some([4, 2]),
        cells: Some([2, 1]),
        ..Request::new("checker")
    }
    .draw()
    .unwrap();
    // 0.9 · 255 = 229.5 (up: 230), 0.15 · 255 = 38.25.
    assert_eq!(
        (0..4)
            .map(|x| checker.get_pixel(x, 1).0[0])
            .collect::<Vec<_>>(),
        [230, 230, 38, 38]
    );
    // Texel centres of two rows lie at 1/4 and 3/4: 0.75 · 255 = 191.25 and 0.25 · 255 = 63.75.
    let gradient = draw("gradient", [1, 2]);
    assert_eq!(
        (gradient.get_pixel(0, 0).0[0], gradient.get_pixel(0, 1).0[0]),
        (191, 64)
    );
}
