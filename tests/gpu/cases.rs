//! Shader unit tests on the GPU.

use crate::suite::cases;
use texcrd::case::{Case, Invocation, OnGpu, Quantity, Verdict, Wrong, judge, observe};
use texcrd::scene::{DirectoryResolver, LoadOptions};

fn case(text: &str) -> Case {
    let resolver = DirectoryResolver::new(env!("CARGO_MANIFEST_DIR"));
    let case = Case::load(
        "case.toml",
        text.as_bytes(),
        &resolver,
        &LoadOptions::default(),
    );
    case.unwrap_or_else(|error| panic!("{error}"))
}

/// Runs a case on both and fails if one does not give what is expected.
fn passes(gpu: &mut OnGpu<'_>, text: &str) {
    let case = case(text);
    let runs = [case.check(), gpu.check(&case).expect("the GPU runs")];
    for (verdicts, on) in runs.iter().zip(["CPU", "GPU"]) {
        for (invocation, verdict) in case.invocations.iter().zip(verdicts) {
            let line = invocation.line;
            assert_eq!(
                *verdict,
                Verdict::Passed,
                "line {line} on the {on} of\n{text}"
            );
        }
    }
}

/// Every case gives on the GPU what it expects; and were any of its numbers another one, it would fail. That holds for a
/// change by a twentieth, of the number or of 1 if that is more: no tolerance that is worked out hides more.
#[test]
fn the_suite_passes_and_would_fail() {
    let Some(device) = crate::device() else {
        return;
    };
    let mut gpu = OnGpu::new(&device);
    let (mut failures, mut numbers) = (String::new(), 0);
    for (path, case) in cases() {
        let observed = match gpu.observe(&case) {
            Ok(observed) => observed,
            Err(error) => {
                failures.push_str(&format!("{path}: {error}\n"));
                continue;
            }
        };
        for (invocation, observed) in case.invocations.iter().zip(&observed) {
            let run = observe(&case, invocation);
            let verdict = judge(invocation, observed, |quantity, c| run.origin(quantity, c));
            if verdict != Verdict::Passed {
                let line = invocation.line;
                failures.push_str(&format!("{path}:{line}: {verdict:#?}\n"));
            }
            for other in wrong_expectations(invocation) {
                numbers += 1;
                let verdict = judge(&other, observed, |_, _| None);
                assert!(
                    !verdict.passes(),
                    "{path}: {:?} passes as well",
                    other.expect
                );
            }
        }
    }
    assert!(failures.is_empty(), "{failures}");
    // More than 1200 cases expect more than ten numbers each.
    assert!(numbers > 12_000, "only {numbers}");
}

/// The invocation with one thing changed that it expects, for each.
fn wrong_expectations(invocation: &Invocation) -> Vec<Invocation> {
    let mut all = Vec::new();
    let mut plain = invocation.clone();
    plain.accept.clear();
    if let Some(killed) = plain.expect.killed {
        let mut other = plain.clone();
        other.expect.killed = Some(!killed);
        all.push(other);
    }
    for (i, value) in plain.expect.values.iter().enumerate() {
        for (component, number) in value.components.iter().enumerate() {
            let step = 0.05 * number.abs().max(1.0);
            let changed = match number.is_finite() {
                true if f64::from(step) <= 2.0 * plain.tolerance => continue,
                true => number + step,
                false => 0.0,
            };
            let mut other = plain.clone();
            other.expect.values[i].components[component] = changed;
            all.push(other);
        }
    }
    all
}

/// What is wrong on the GPU is told as on the CPU, down to the line that wrote it.
#[test]
fn a_wrong_expectation_fails() {
    let Some(device) = crate::device() else {
        return;
    };
    let case = case(
        "ps = \"ps.1.1\\nmov r0, v0\\nmul r0.a, v0, c0\"
         ps_constants.c0 = [0, 0, 0, 0.5]
         inputs.v0 = [0.5, 0.25, 0, 0.5]
         expect.r0 = [0.5, 0.25, 0, 0.5]",
    );
    let verdicts = OnGpu::new(&device).check(&case).expect("the GPU runs");
    let [Verdict::Failed(wrong)] = verdicts.as_slice() else {
        panic!("{verdicts:?}");
    };
    let [
        Wrong::Number {
            quantity,
            component,
            actual,
            origin,
            ..
        },
    ] = wrong.as_slice()
    else {
        panic!("{wrong:?}");
    };
    assert_eq!(
        (quantity.to_string(), *component, *actual),
        ("r0".into(), 3, 0.25)
    );
    assert_eq!(origin.as_ref().map(|origin| origin.line), Some(3));
}

/// Constants that change from invocation to invocation, a `def` among them; more invocations than a row of the picture
/// has pixels. i/512 and 1 − i/512 are exact.
#[test]
fn many_invocations_with_constants_of_their_own() {
    let Some(device) = crate::device() else {
        return;
    };
    let mut text = String::from("ps = \"ps.1.1\\ndef c1, 1, 1, 1, 1\\nsub r0, c1, c0\"\n");
    for i in 0..300 {
        let x = f64::from(i) / 512.0;
        text.push_str(&format!("[[invocation]]\nps_constants.c0 = {x:?}\n"));
        let one = match i % 3 {
            0 => {
                text.push_str("ps_constants.c1 = 0.5\n");
                0.5
            }
            _ => 1.0,
        };
        let left = one - x;
        text.push_str(&format!("expect.r0 = [{left}, {left}, {left}, {left}]\n"));
    }
    passes(&mut OnGpu::new(&device), &text);
}

/// Both shaders, registers of both, the depth, and what stands in the target, in one case. 0.5/2 = 0.25 of depth; the
/// vertex writes 2 into oD0.x, which reaches the pixel as 1.
#[test]
fn both_shaders_at_once() {
    let Some(device) = crate::device() else {
        return;
    };
    let text = r#"
        vs = """
        vs.1.1
        mov oPos, v0
        mov oD0, v1
        mov oT3, v2
        mov oT1.xy, v2.zwzw
        mov oFog.x, v1.w
        mov oPts.x, c95.y
        mov a0.x, v1.x
        """
        ps = """
        ps.1.1
        texcoord t1
        mul r1, v0, c0
        mov r0, r1
        """
        vs_constants.c95 = [0, 7, 0, 0]
        ps_constants.c0 = [1, 0.5, 0.5, 1]
        inputs.v0 = [-5, 9, 0.5, 2]
        inputs.v1 = [2, 0.5, 1, 0.25]
        inputs.v2 = [0.125, 0.25, 0.375, 0.5]
        state.fog = { color = [0, 1, 0] }
        [expect]
        oPos = [-5, 9, 0.5, 2]
        oD0 = [1, 0.5, 1, 0.25]
        oT3 = [0.125, 0.25, 0.375, 0.5]
        oT1 = [0.375, 0.5]
        oFog = 0.25
        oPts = 7
        a0 = 2
        t1 = [0.375, 0.5]
        r1 = [1, 0.25, 0.5, 0.25]
        r0 = [1, 0.25, 0.5, 0.25]
        killed = false
        depth = 0.25
        # A quarter of the colour, three quarters of fog.
        frame = [0.25, 0.8125, 0.125, 0.25]
    "#;
    passes(&mut OnGpu::new(&device), text);
}

/// A discarded pixel has registers all the same, and leaves the target alone.
#[test]
fn registers_of_discarded_pixels() {
    let Some(device) = crate::device() else {
        return;
    };
    let text = r#"
        ps = """
        ps.1.1
        texkill t1
        add r1, v0, v0
        mov r0, r1
        """
        clear = [0, 1, 1, 0]
        inputs.v0 = [0.25, 0.5, 0, 0.25]
        expect.r0 = [0.5, 1, 0, 0.5]
        expect.r1 = [0.5, 1, 0, 0.5]
        [[invocation]]
        inputs.t1 = [1, -1, 1]
        expect.killed = true
        expect.frame = [0, 1, 1, 0]
        [[invocation]]
        inputs.t1 = [1, 0, 1]
        expect.killed = false
        expect.frame = [0.5, 1, 0, 0.5]
    "#;
    passes(&mut OnGpu::new(&device), text);
}

/// The depth that the shader gives counts for a discarded pixel too: 1/2 by `texdepth`, which divides red by green.
#[test]
fn the_depth_of_a_discarded_pixel() {
    let Some(device) = crate::device() else {
        return;
    };
    let text = "ps = \"ps.1.4\\ntexcrd r5.rgb, t0\\nphase\\ntexdepth r5\\ntexkill t1\\nmov r0, v0\"
         inputs.t0 = [1, 2, 0]
         inputs.t1 = [-1, 2, 0]
         expect = { depth = 0.5, killed = true }";
    passes(&mut OnGpu::new(&device), text);
}

/// Mip levels, filters, a border and a cube in one listing. Stage 0: level 1 of two, as `max_mip_level` says. Stage 1:
/// halfway between two columns. Stage 2: the border, two texels beside the edge. Stage 3: −Z in the middle.
#[test]
fn samplers_of_all_kinds() {
    let Some(device) = crate::device() else {
        return;
    };
    let text = r#"
        ps = """
        ps.1.4
        texld r0, t0
        texld r1, t1
        texld r2, t2
        texld r3, t3
        add r0, r0, r1
        add r0, r0, r2
        add r0, r0, r3
        """
        [textures.0]
        format = "rgba32f"
        size = [2, 1]
        texels = [[9, 9, 9, 9], [9, 9, 9, 9]]
        mips = [[[0.5, 0, 0, 0]]]
        [samplers.0]
        mip = "point"
        max_mip_level = 1
        [textures.1]
        format = "rgba32f"
        size = [2, 1]
        texels = [[0, 0, 0, 0], [0, 0.5, 0, 0]]
        [samplers.1]
        filter = "linear"
        [textures.2]
        size = [1, 1]
        texels = [[1, 1, 1, 1]]
        [samplers.2]
        address = "border"
        border = [0, 0, 0.25, 0]
        [textures.3]
        kind = "cube"
        format = "rgba32f"
        size = [1, 1]
        texels = [[8, 8, 8, 8], [8, 8, 8, 8], [8, 8, 8, 8], [8, 8, 8, 8], [8, 8, 8, 8], [0, 0, 0, 0.125]]
        [inputs]
        t0 = [0.25, 0.5]
        t1 = [0.5, 0.5]
        t2 = [2.5, 0.5]
        t3 = [0.25, 0.25, -1]
        [expect]
        r1 = [0, 0.25, 0, 0]
        r0 = [0.5, 0.25, 0.25, 0.125]
    "#;
    passes(&mut OnGpu::new(&device), text);
    let case = case(text);
    let observed = OnGpu::new(&device).observe(&case).expect("the GPU runs");
    // The filter of stage 1 may be off by 1/256 of 0.5, a point filter by nothing.
    let filtered = observed[0]
        .values
        .iter()
        .find(|value| value.quantity.to_string() == "r1");
    let slack = filtered.expect("it was asked for").slack;
    assert!(slack[1] >= 0.5 / 256.0 && slack[1] < 0.005, "{slack:?}");
    assert!(
        observed[0]
            .values
            .iter()
            .all(|value| value.quantity != Quantity::Frame)
    );
}
