//! The hardware models on the GPU: cases with numbers worked out by hand, and many numbers on both paths.

use texcrd::case::{Case, OnGpu, Verdict, observe};
use texcrd::policy::Model;
use texcrd::scene::{DirectoryResolver, LoadOptions};

fn case(model: Model, text: &str) -> Case {
    let resolver = DirectoryResolver::new(env!("CARGO_MANIFEST_DIR"));
    let options = LoadOptions {
        model,
        ..LoadOptions::default()
    };
    let case = Case::load("case.toml", text.as_bytes(), &resolver, &options);
    case.unwrap_or_else(|error| panic!("{error}"))
}

/// Runs a case on both paths and fails if one does not give what is expected.
fn passes(gpu: &mut OnGpu<'_>, model: Model, text: &str) {
    let case = case(model, text);
    let on_gpu = gpu.check(&case).expect("the GPU runs");
    for (verdicts, on) in [(case.check(), "CPU"), (on_gpu, "GPU")] {
        for verdict in verdicts {
            assert_eq!(verdict, Verdict::Passed, "{model} on the {on}\n{text}");
        }
    }
}

/// Steps by hand: 128/255 squared is 64.25/255, and 64/255 is 0.2509804; 0.3 is 1229/4096 = 0.3000488, its square 368.75,
/// so 369/4096 = 0.0900879.
#[test]
fn products_land_on_steps() {
    let Some(device) = crate::device() else {
        return;
    };
    let mut gpu = OnGpu::new(&device);
    let product = |expected: &str| {
        format!(
            "ps = \"ps.1.1\\nmul r0, v0, v0\"\ninputs.v0 = [0.5, 0.3, 1, 0]\nexpect.r0 = {expected}\ntol = 0.0000002"
        )
    };
    passes(&mut gpu, Model::Float, &product("[0.25, 0.09, 1, 0]"));
    passes(
        &mut gpu,
        Model::Gf3,
        &product("[0.2509804, 0.09019608, 1, 0]"),
    );
    passes(&mut gpu, Model::R200, &product("[0.25, 0.0900879, 1, 0]"));
}

/// A texel −128 of `v8u8` is −1 under every model, 127 is 1 or 127/128. texbem moves (0.5, 0.5) by half of (du, dv) in a
/// texture of two texels: du = 1 comes to 1.0, which wraps to the first one, 127/128 stays in the second.
#[test]
fn signed_texels_of_the_geforce_do_not_reach_one() {
    let Some(device) = crate::device() else {
        return;
    };
    let mut gpu = OnGpu::new(&device);
    let text = |expected: &str| {
        format!(
            r#"
            ps = """
            ps.1.1
            tex t0
            texbem t1, t0
            mov r0, t1
            """
            textures.0 = {{ format = "v8u8", size = [1, 1], raw = [0x007f] }}
            textures.1 = {{ size = [2, 1], texels = [[1, 0, 0, 1], [0, 1, 0, 1]] }}
            stages.1 = {{ bump_mat = [0.5, 0, 0, 0] }}
            inputs.t1 = [0.5, 0.5]
            expect.r0 = {expected}
            "#
        )
    };
    passes(&mut gpu, Model::Float, &text("[1, 0, 0, 1]"));
    passes(&mut gpu, Model::R200, &text("[1, 0, 0, 1]"));
    passes(&mut gpu, Model::Gf3, &text("[0, 1, 0, 1]"));
}

/// Filter weights: x = 2u − 0.5 = 0.3 is 76.8/256, so 77/256 = 0.30078; of that 76.699/255 under gf3 is 77/255, and 1232/4096
/// under r200.
#[test]
fn weights_have_eight_bits() {
    let Some(device) = crate::device() else {
        return;
    };
    let mut gpu = OnGpu::new(&device);
    let text = |expected: f64| {
        format!(
            r#"
            ps = """
            ps.1.4
            texld r0, t0
            mul r0, r0, c0
            """
            textures.0 = {{ size = [2, 1], texels = [[0, 0, 0, 0], [1, 1, 1, 1]] }}
            samplers.0 = {{ filter = "linear", address = "clamp" }}
            ps_constants.c0 = 1
            inputs.t0 = [0.4, 0.5]
            expect.r0 = {expected}
            tol = 0.00001
            "#
        )
    };
    passes(&mut gpu, Model::Float, &text(0.3));
    passes(&mut gpu, Model::Gf3, &text(77.0 / 255.0));
    passes(&mut gpu, Model::R200, &text(1232.0 / 4096.0));
}

/// Numbers without a pattern through all arithmetic, on both paths: they are the same to the step. Adapters that contract
/// products and sums may round some ties the other way.
#[test]
fn both_paths_agree_on_steps() {
    let Some(device) = crate::device() else {
        return;
    };
    let mut gpu = OnGpu::new(&device);
    let mut state = 7_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24)
    };
    let ps_1_2 = "ps.1.2\\ntexcoord t0\\ntexcoord t1\\nmad_x2 r0, t0, v0, -v1\\nmul r1, r0_bx2, 1-t1\\nlrp r0, v0, r1, r0_bias\\ndp3_d2 t1.rgb, r0, r1_bx2\\ncmp t0, r1, t1, r0\\nadd r0, t0, c0";
    let ps_1_4 = "ps.1.4\\ntexcrd r0.rgb, t0\\ntexcrd r1.rgb, t1\\nphase\\nmov r0.a, v0\\nmov r1.a, v1\\nmad_x8 r2, r0, r1_bx2, -v1\\nmul_d4 r3, r2_x2, 1-r1\\nlrp r0, v0, r2, r3_bias\\ndp4 r4, r0, r2\\nadd r0, r4, r0\\ncnd r0, r0, r2, r3";
    for (listing, constants) in [(ps_1_2, "c0"), (ps_1_4, "c1")] {
        let mut text = format!("ps = \"{}\"\n", listing);
        for _ in 0..500 {
            text.push_str("[[invocation]]\nexpect.r0 = 0\n");
            for register in ["v0", "v1", "t0", "t1"] {
                let numbers: Vec<String> = (0..4)
                    .map(|_| {
                        format!(
                            "{:.6}",
                            if register.starts_with('v') {
                                random()
                            } else {
                                4.0 * random() - 2.0
                            }
                        )
                    })
                    .collect();
                text.push_str(&format!("inputs.{register} = [{}]\n", numbers.join(", ")));
            }
            text.push_str(&format!(
                "ps_constants.{constants} = {:.6}\n",
                2.0 * random() - 1.0
            ));
        }
        for model in [Model::Gf3, Model::R200] {
            let case = case(model, &text);
            let seen = gpu.observe(&case).expect("the GPU runs");
            let (mut apart, mut all) = (0, 0);
            for (invocation, seen) in case.invocations.iter().zip(&seen) {
                let numbers = |observed: &texcrd::case::Observed| observed.values[0].numbers;
                let (cpu, gpu) = (numbers(&observe(&case, invocation).observed), numbers(seen));
                for (cpu, gpu) in cpu.into_iter().zip(gpu) {
                    all += 1;
                    apart += usize::from((cpu - gpu).abs() > 1e-5);
                    let steps = cpu * model.steps().expect("steps");
                    assert!((steps - steps.round()).abs() < 1e-3, "{model}: {cpu}");
                }
            }
            assert!(
                all == 2000 && apart <= all / 500,
                "{model}: {apart} of {all} apart"
            );
        }
    }
}
