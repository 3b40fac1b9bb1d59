//! The way of a colour into the target: fixed-function.md, 1, 12 and 13. What one pixel with one draw shows of it stands in
//! the conformance suite, which runs on both paths.

use super::*;

fn blended(state: &str) -> String {
    format!("[draw.state]\nalpha_blend = true\n{state}")
}

const ADDED: &str = "src_blend = \"one\"\ndest_blend = \"one\"";

fn shows(both: &mut Both<'_>, what: &str, keys: &str, draws: &[String], color: [u8; 4]) {
    let scene = scene([2, 2], keys, draws);
    both.shows(what, &scene, &[((1, 1), color)]);
}

#[test]
fn colours_are_limited_before_blending_and_rounded_after_it() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let grey = "clear = [0.5, 0.5, 0.5, 0.5]";
    // 2 · 0.75 is 1 before it is multiplied by what is there, 0.5.
    let quad = everywhere(colored(0.75, 0.75, 0.75, 0.75));
    let keys = format!(
        "ps_text = \"ps.1.1\\nadd r0, v0, v0\\n\"\n{}",
        blended("src_blend = \"destcolor\"\ndest_blend = \"zero\"")
    );
    shows(&mut both, "limited", grey, &[draw(&quad, &keys)], [128; 4]);
    // A tenth of a step less than a half is nothing each time; a tenth more is a whole step.
    for (part, expected) in [(0.4, 0), (0.6, 12)] {
        let step = part / 255.0;
        let quad = everywhere(colored(step, step, step, step));
        let draws: Vec<String> = (0..12).map(|_| draw(&quad, &blended(ADDED))).collect();
        shows(
            &mut both,
            "rounded",
            "clear = [0, 0, 0, 0]",
            &draws,
            [expected; 4],
        );
    }
    // The mask comes behind blending: green and alpha stay what they were.
    let quad = everywhere(colored(0.25, 0.25, 0.25, 0.25));
    let keys = blended(&format!("{ADDED}\ncolor_write = \"rb\""));
    shows(
        &mut both,
        "masked",
        grey,
        &[draw(&quad, &keys)],
        [191, 128, 191, 128],
    );
}

/// fixed-function.md, 13: in a target without alpha it reads 1, whatever it is cleared to and whatever is drawn.
#[test]
fn targets_without_alpha() {
    let device = crate::device();
    let mut both = Both::new(&device);
    let with = |format: &str| format!("format = \"{format}\"\nclear = [0, 0, 0, 0.25]");
    let (with_alpha, without) = (with("a8r8g8b8"), with("x8r8g8b8"));
    let quad = everywhere(colored(1.0, 1.0, 1.0, 0.5));
    // What is left of white: the alpha of the target, 1 less it, the smaller of 0.5 and 1 less it.
    for (factor, here, there) in [
        ("destalpha", 64, 255),
        ("invdestalpha", 191, 0),
        ("srcalphasat", 128, 0),
    ] {
        let keys = blended(&format!("src_blend = \"{factor}\"\ndest_blend = \"zero\""));
        let draws = || [draw(&quad, &keys)];
        // The alpha of the target is 0.5 times the factor, which is 1 for srcalphasat.
        let alpha = if factor == "srcalphasat" {
            128
        } else {
            here / 2
        };
        shows(
            &mut both,
            factor,
            &with_alpha,
            &draws(),
            [here, here, here, alpha],
        );
        shows(
            &mut both,
            factor,
            &without,
            &draws(),
            [there, there, there, 255],
        );
    }
    shows(&mut both, "drawn", &without, &[draw(&quad, "")], [255; 4]);
    shows(
        &mut both,
        "cleared",
        &without,
        &[draw(&[], "indices = []")],
        [0, 0, 0, 255],
    );
    // A render target without alpha is a texture whose alpha is 1.
    for (format, alpha) in [("a8r8g8b8", 128), ("x8r8g8b8", 255)] {
        let keys = format!(
            "draws = [\"shown\"]\n[targets.drawn]\nsize = 4\nformat = \"{format}\"\ndraws = [\"first\"]\n\
             [textures.drawn]\ntarget = \"drawn\""
        );
        let shader = "name = \"shown\"\nps_text = \"ps.1.1\\ntex t0\\nmov r0, t0.a\\n\"\n\
                      stages.0 = { texture = \"drawn\" }";
        let draws = [
            draw(&quad, "name = \"first\""),
            draw(&everywhere(on(0.0, 0.0)), shader),
        ];
        shows(&mut both, format, &keys, &draws, [alpha; 4]);
    }
}

/// fixed-function.md, 12: alpha as eight bits hold it.
#[test]
fn the_alpha_test() {
    let device = crate::device();
    let mut columns = Vec::new();
    let with = |alpha: f32| colored(1.0, 1.0, 1.0, alpha / 255.0);
    for (func, holds) in FUNCTIONS {
        // Less than, equal to and greater than 128, each as it is rounded.
        for (alphas, lit) in [[126.6, 127.4], [127.6, 128.4], [128.6, 129.4]]
            .into_iter()
            .zip(holds)
        {
            for alpha in alphas {
                let state = format!("alpha_test = true\nalpha_ref = 128\nalpha_func = \"{func}\"");
                columns.push(Column::new(format!("{func}, {alpha}"), lit).step(with(alpha), state));
            }
        }
    }
    for (reference, alpha, func, lit) in [
        (0, 0.0, "greater", false),
        (0, 0.4, "greater", false),
        (0, 0.6, "greater", true),
        (255, 254.4, "less", true),
        (255, 254.6, "less", false),
        (255, 900.0, "equal", true),
    ] {
        let state = format!("alpha_test = true\nalpha_ref = {reference}\nalpha_func = \"{func}\"");
        columns.push(Column::new(format!("{func}, {alpha}"), lit).step(with(alpha), state));
    }
    // The default function is always, and the default is off.
    let state = "alpha_test = true\nalpha_ref = 255";
    columns.push(Column::new("default function", true).step(with(0.0), state));
    let state = "alpha_func = \"never\"";
    columns.push(Column::new("off", true).step(with(0.0), state));
    Both::new(&device).columns("", &columns);
}
