//! Arithmetic alone, as 32-bit floats: what a pixel shader leaves in `r0`, drawn into a float target, against the
//! interpreter.

use texcrd::diagnostic::SourceMap;
use texcrd::exec::{Environment, Machine, bind_constants};
use texcrd::gpu::{Device, InvocationInputs, Invocations, Shading};
use texcrd::kernel::{self, Kernel, Slot, lower};
use texcrd::listing;
use texcrd::policy::Dialect;
use texcrd::program::Program;
use texcrd::raster::RenderState;
use texcrd::semantics::saturate;
use texcrd::wgsl::{Observed, Options, Stage, translate};

/// How many inputs each listing is run with.
const COUNT: usize = 500;

/// One operation a component, so that there is no order to be changed: WGSL guarantees sums, products and comparisons to
/// be correctly rounded, and modifiers and shifts are products with powers of two and sums with one rounding.
const EXACT: [&str; 14] = [
    "mov r0, t0",
    "add r0, t0, t1",
    "sub r0, t0, t1",
    "mul r0, t0, t1",
    "mul r0.rgb, t0, t1\n+mov r0.a, t0.b",
    "add_x2 r0, t0, t1",
    "add_d2 r0, t0, t1",
    "mul_x4_sat r0, t0, t1",
    "mov_sat r0, t0",
    "mov r0, -t0",
    "cmp r0, t0, t1, t2",
    "cnd r0, t0, t1, t2",
    "mov r0, t0.a",
    "add r0.rb, t0, t1\nmov r0.ga, t2",
];

/// Several operations: compilers may contract a product and a sum into one rounding, or put sums in another order. Every
/// rounding then differs by half a unit of a term at most; the terms together stay below 8, four roundings below 2⁻¹⁹.
const COMPOUND: [&str; 12] = [
    "mad r0, t0, t1, t2",
    "lrp r0, t0, t1, t2",
    "dp3 r0, t0, t1",
    "dp4 r0, t0, t1",
    "dp3_sat r0, t0, t1",
    "mov r0, 1-t0",
    "mov r0, t0_bias",
    "mov r0, t0_bx2",
    "mul r0, t0_bx2, t1_x2",
    "mad_x2 r0, t0, t1_bias, -t2",
    "sub r1, t0, t1\nmul r1, r1, c0\nadd r0, r1, t2",
    "dp3 r1, t0, t1\nmul r2, r1.r, c1\nmad r0, r2, c2, t0",
];
const BOUND: f32 = 8.0 * 4.0 / (1 << 24) as f32;

/// A listing of ps.1.4 around some instructions. There inputs go through registers: t0 to t2 become r3 to r5.
fn around(body: &str) -> String {
    let mut text = String::from("ps.1.4\ndef c2, 0.3, -0.7, 0.9, -0.1\n");
    for i in 0..3 {
        // Three components: the fourth of a coordinate set cannot be had in ps.1.4, it comes from a colour.
        text.push_str(&format!("texcrd r{}.rgb, t{i}\n", i + 3));
    }
    text.push_str("phase\nmov r3.a, v0.r\nmov r4.a, v0.g\nmov r5.a, v0.b\n");
    let mut body = body.to_owned();
    for i in 0..3 {
        body = body.replace(&format!("t{i}"), &format!("r{}", i + 3));
    }
    text.push_str(&body);
    text.push('\n');
    text
}

fn read(text: &str, sources: &mut SourceMap) -> (Program, Kernel) {
    let file = sources.add("listing", text.as_bytes().to_vec());
    let checked = listing::check(file.expect("the listing is short"), Dialect::default());
    let Some(program) = checked.accepted() else {
        panic!("{text}\n{:?}", checked.diagnostics);
    };
    let kernel = lower(program, &kernel::Options::default()).expect("what is accepted is lowered");
    (program.clone(), kernel)
}

/// Numbers from −1 to 1 that repeat from run to run (a linear congruence, Knuth's MMIX constants), none so small that a
/// product would be denormal.
fn inputs() -> Vec<InvocationInputs> {
    let mut state = 20_020_501_u64;
    let mut next = || {
        state =
            (state.wrapping_mul(6_364_136_223_846_793_005)).wrapping_add(1_442_695_040_888_963_407);
        let unit = (state >> 40) as f32 / (1 << 24) as f32;
        let value = 2.0 * unit - 1.0;
        if value.abs() < 1e-6 { 0.5 } else { value }
    };
    (0..COUNT)
        .map(|_| InvocationInputs {
            texcoords: std::array::from_fn(|_| std::array::from_fn(|_| next())),
            colors: std::array::from_fn(|_| std::array::from_fn(|_| next().abs())),
            ..InvocationInputs::default()
        })
        .collect()
}

fn constants(kernel: &Kernel) -> Vec<[f32; 4]> {
    let set = [(0, [0.75, -0.5, 0.1, 1.0]), (1, [-1.0, 0.33, 0.66, 0.2])];
    bind_constants(kernel, &set)
}

fn on_cpu(kernel: &Kernel, input: &InvocationInputs) -> Option<[f32; 4]> {
    let mut machine = Machine::<1>::new();
    for (i, value) in input.texcoords.iter().enumerate() {
        machine.load(Slot::texcoord(i)?, *value);
    }
    for (i, value) in input.colors.iter().enumerate() {
        machine.load(Slot::input(i)?, value.map(saturate));
    }
    let environment = Environment {
        constants: constants(kernel),
        ..Environment::default()
    };
    machine.run(kernel, &environment);
    (!machine.killed()[0]).then(|| machine.lane(Slot::R0, 0))
}

fn on_gpu(
    device: &Device,
    (program, kernel): (&Program, &Kernel),
    source: &SourceMap,
    inputs: &[InvocationInputs],
) -> Vec<Option<[f32; 4]>> {
    let stage = Stage {
        program,
        kernel,
        source,
    };
    let options = Options {
        exact_dots: true,
        observed: Some(Observed::default()),
        ..Options::default()
    };
    let translation = translate(None, Some(stage), &options).expect("what is lowered translates");
    let constants = constants(kernel);
    let inputs: Vec<InvocationInputs> = (inputs.iter())
        .map(|input| InvocationInputs {
            pixel_constants: constants.clone(),
            ..input.clone()
        })
        .collect();
    let shading = Shading {
        translation: &translation,
        stages: Default::default(),
        state: &RenderState::default(),
    };
    let seen = Invocations::new(device).registers(&shading, &inputs);
    let seen = seen.expect("the GPU shades").into_iter();
    seen.map(|seen| (!seen.killed).then_some(seen.color))
        .collect()
}

/// Runs listings on both and hands every pair of numbers over.
fn each_pair(listings: &[&str], mut check: impl FnMut(&str, usize, f32, f32)) {
    let Some(device) = crate::device() else {
        return;
    };
    let inputs = inputs();
    for body in listings {
        let mut sources = SourceMap::new();
        let (program, kernel) = read(&around(body), &mut sources);
        let results = on_gpu(&device, (&program, &kernel), &sources, &inputs);
        assert_eq!(results.len(), inputs.len());
        for (number, (gpu, input)) in results.iter().zip(&inputs).enumerate() {
            let cpu = on_cpu(&kernel, input);
            assert_eq!(cpu.is_some(), gpu.is_some(), "{body}: kill, {input:?}");
            for (a, b) in cpu.iter().flatten().zip(gpu.iter().flatten()) {
                check(body, number, *a, *b);
            }
        }
    }
}

#[test]
fn single_operations_are_equal_to_the_bit() {
    each_pair(&EXACT, |body, number, cpu, gpu| {
        // The sign of zero is left to the GPU.
        assert!(
            cpu == gpu,
            "{body}, input {number}: {cpu} on the CPU, {gpu} on the GPU"
        );
    });
}

#[test]
fn compound_expressions_are_within_their_roundings() {
    let (mut equal, mut all, mut worst) = (0, 0, 0.0f32);
    each_pair(&COMPOUND, |body, number, cpu, gpu| {
        let off = (cpu - gpu).abs();
        assert!(
            off <= BOUND,
            "{body}, input {number}: {cpu} on the CPU, {gpu} on the GPU, {off:e} apart"
        );
        all += 1;
        equal += usize::from(off == 0.0);
        worst = worst.max(off);
    });
    println!("{equal} of {all} equal, the others at most {worst:e} apart");
}

const TEXKILL: &str = "ps.1.4\ntexcrd r0.rgb, t1\ntexkill t0\nmov r0.a, v0.a\n";

#[test]
fn texkill_takes_the_same_pixels_out() {
    let mut seen = [0; 2];
    let Some(device) = crate::device() else {
        return;
    };
    let inputs = inputs();
    let mut sources = SourceMap::new();
    let (program, kernel) = read(TEXKILL, &mut sources);
    let results = on_gpu(&device, (&program, &kernel), &sources, &inputs);
    for (gpu, input) in results.iter().zip(&inputs) {
        // The rule itself: a pixel is out if one of x, y, z is below 0.
        let out = input.texcoords[0][..3].iter().any(|x| *x < 0.0);
        assert_eq!(gpu.is_none(), out, "{input:?}");
        seen[usize::from(out)] += 1;
    }
    assert!(seen.iter().all(|count| *count > 20), "{seen:?}");
}
