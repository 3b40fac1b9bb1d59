//! Arithmetic to the last bit: compound expressions in units in the last place.
//!
//! WGSL lets a compiler contract a product and a sum, and put sums and products in another order. SPIR-V can forbid both:
//! the translation goes through `naga` to SPIR-V, every operation on floats is decorated with `NoContraction`, and the
//! module is passed through `wgpu` as it is. What is left of a difference is the precision of the operations themselves:
//!
//! | operation | Vulkan | Mesa's software adapter, as measured |
//! | --- | --- | --- |
//! | sum, difference, product, comparison, floor | correctly rounded | the same |
//! | quotient | 2.5 ULP | correctly rounded |
//! | inverse square root | 2 ULP | as 1 / √x, both rounded |
//! | `exp2` | 3 + 2·abs(x) ULP | 3 ULP |
//! | `log2` | 3 ULP; 2⁻²¹ within 0.5 to 2 | the same |
//!
//! A device that takes no SPIR-V is held to the bounds of WGSL instead, and the tests say so.

use std::borrow::Cow;

use naga::back::spv;
use naga::valid::{Capabilities, ValidationFlags, Validator};
use texcrd::diagnostic::SourceMap;
use texcrd::exec::{Environment, Machine, bind_constants};
use texcrd::generate::{self, Generated, INVOCATIONS, Random, Textures, Weights};
use texcrd::gpu::wgpu;
use texcrd::gpu::{Batch, Device, GpuError, Program, Results, StageUniforms, Uniforms};
use texcrd::isa::{Opcode, ShaderKind, Version};
use texcrd::kernel::{self, Kernel, Slot, lower};
use texcrd::listing;
use texcrd::matching::{self, Subject};
use texcrd::policy::Dialect;
use texcrd::raster::RenderState;
use texcrd::wgsl::{self, Stage, Translation, translate};

/// The device that the other tests use, opened so that it takes SPIR-V; none if it cannot, or if tests are switched off.
fn exact_device() -> Option<Device> {
    let usual = crate::device()?;
    let mut description = wgpu::InstanceDescriptor::new_without_display_handle();
    description.backends = wgpu::Backends::VULKAN;
    description.flags = wgpu::InstanceFlags::empty();
    let instance = wgpu::Instance::new(description);
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::VULKAN));
    let adapter = (adapters.into_iter())
        .filter(|adapter| {
            adapter
                .features()
                .contains(wgpu::Features::PASSTHROUGH_SHADERS)
        })
        .find(|adapter| adapter.get_info().name == usual.adapter().name);
    let Some(adapter) = adapter else {
        println!(
            "{} takes no SPIR-V: nothing is exact there",
            usual.adapter()
        );
        return None;
    };
    let request = wgpu::DeviceDescriptor {
        required_features: wgpu::Features::PASSTHROUGH_SHADERS,
        required_limits: adapter.limits(),
        ..Default::default()
    };
    let opened = pollster::block_on(adapter.request_device(&request));
    let (device, queue) = opened.expect("an adapter gives a device with its own features");
    Some(Device::of(&adapter, device, queue))
}

/// SPIR-V with `NoContraction` on every operation on floats. How many there are comes with it.
fn without_contraction(words: &[u32]) -> (Vec<u32>, usize) {
    const HEADER: usize = 5;
    const DECORATE: u32 = 71;
    const NO_CONTRACTION: u32 = 42;
    // OpTypeVoid is the first of the types, which come behind the decorations.
    const FIRST_TYPE: u32 = 19;
    const LAST_TYPE: u32 = 39;
    // OpFNegate, OpFAdd, OpFSub, OpFMul, OpFDiv, OpFRem, OpFMod, and the products of vectors and matrices up to OpDot.
    let of_floats = |opcode: u32| matches!(opcode, 127 | 129 | 131 | 133 | 136 | 140..=148);
    let mut decorations = Vec::new();
    let mut place = None;
    let mut at = HEADER;
    while let Some(first) = words.get(at) {
        let (opcode, length) = (first & 0xffff, (first >> 16) as usize);
        if (FIRST_TYPE..=LAST_TYPE).contains(&opcode) {
            place.get_or_insert(at);
        }
        if of_floats(opcode) {
            // The type of the result comes first, then its number.
            decorations.extend([3 << 16 | DECORATE, words[at + 2], NO_CONTRACTION]);
        }
        at += length.max(1);
    }
    let place = place.expect("a module has types");
    let mut all = words.to_vec();
    let count = decorations.len() / 3;
    all.splice(place..place, decorations);
    (all, count)
}

/// Makes a module of SPIR-V that nobody looks at on the way.
#[allow(unsafe_code)]
fn passed_through(device: &Device, words: &[u32], entries: [&str; 2]) -> wgpu::ShaderModule {
    let entry = |name: &str| wgpu::PassthroughShaderEntryPoint {
        name: Cow::Owned(name.to_owned()),
        workgroup_size: (0, 0, 0),
    };
    let description = wgpu::ShaderModuleDescriptorPassthrough {
        entry_points: entries.map(entry).to_vec().into(),
        spirv: Some(Cow::Borrowed(words)),
        ..Default::default()
    };
    // SAFETY: the driver is handed SPIR-V that was not checked by `wgpu`. It is what `naga` wrote of a module that `naga`
    // validated, with all runtime checks of the writer's defaults, and with one more decoration on results that the same
    // module computes, in the place where the specification wants decorations. The bindings are those of the pipeline
    // layout, because groups and bindings are written into SPIR-V as they stand in WGSL, and entry points keep their names.
    unsafe {
        device
            .device()
            .create_shader_module_passthrough(description)
    }
}

/// Runs a batch with every operation in its order.
fn run_exactly(device: &Device, batch: &Batch<'_>) -> Result<Vec<Results>, GpuError> {
    let module = naga::front::wgsl::parse_str(batch.source()).expect("the WGSL is read");
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .expect("the WGSL is valid");
    let options = spv::Options {
        flags: spv::WriterFlags::empty(),
        ..Default::default()
    };
    let words = spv::write_vec(&module, &info, &options, None).expect("SPIR-V is written");
    let (words, decorated) = without_contraction(&words);
    assert!(decorated > 0, "nothing to be held in its order");
    let module = passed_through(device, &words, batch.entries());
    batch.run_module(device, &module)
}

/// How many floats lie between two, the second counted; none where only one is NaN. Both zeros are one, as are all numbers
/// that are not normal, which may be flushed.
fn ulps(a: f32, b: f32) -> Option<u64> {
    let place = |x: f32| {
        let bits = i64::from(x.to_bits() & 0x7fff_ffff);
        let size = (bits - i64::from(f32::MIN_POSITIVE.to_bits() - 1)).max(0);
        if x.is_sign_negative() { -size } else { size }
    };
    match (a.is_nan(), b.is_nan()) {
        (true, true) => Some(0),
        (false, false) => Some(place(a).abs_diff(place(b))),
        _ => None,
    }
}

#[test]
fn ulps_are_counted() {
    assert_eq!(ulps(1.0, 1.0 + f32::EPSILON), Some(1));
    assert_eq!(ulps(1.0, 1.0 - f32::EPSILON / 2.0), Some(1));
    assert_eq!(ulps(0.0, -0.0), Some(0));
    assert_eq!(ulps(1e-40, -0.0), Some(0));
    assert_eq!(ulps(f32::MIN_POSITIVE, 0.0), Some(1));
    assert_eq!(ulps(-f32::MIN_POSITIVE, f32::MIN_POSITIVE), Some(2));
    // 2²³ floats from one power of two to the next.
    assert_eq!(ulps(2.0, 4.0), Some(1 << 23));
    assert_eq!(ulps(f32::NAN, 1.0), None);
}

/// What a listing of the table below may differ by.
#[derive(Clone, Copy)]
enum Allowed {
    /// Sums, products, comparisons: nothing.
    Nothing,
    /// This many units on a device that only keeps what Vulkan promises; none on Mesa's software adapter.
    Quotients(u64),
    /// This many units.
    Ulps(u64),
    /// A relative error.
    Relative(f64),
    /// An absolute error and units, whichever is more.
    Absolute(f64, u64),
}

const VERTEX: &[(&str, Allowed)] = &[
    ("mad oPos, r3, r4, r5", Allowed::Nothing),
    ("dp3 oPos, r3, r4", Allowed::Nothing),
    ("dp4 oPos, r3, r4", Allowed::Nothing),
    ("dp4 oPos, r3.wzyx, -r4", Allowed::Nothing),
    ("m4x4 oPos, r3, c4", Allowed::Nothing),
    ("m3x4 oPos, r3, c4", Allowed::Nothing),
    ("m4x3 oPos.xyz, r3, c4\nmov oPos.w, r4", Allowed::Nothing),
    ("m3x2 oPos.xy, r3, c4\nmov oPos.zw, r4", Allowed::Nothing),
    ("dst oPos, r3, r4", Allowed::Nothing),
    ("frc oPos.xy, r3\nmov oPos.zw, r4", Allowed::Nothing),
    (
        "sub r0, r3, r4\nmul r0, r0, r5.x\nmad oPos, r5, r5.x, r0",
        Allowed::Nothing,
    ),
    (
        "mul r0, r3, r5\nmul r1, r4, r5\nadd oPos, r0, r1",
        Allowed::Nothing,
    ),
    ("mul r0, r3, r4\nsub oPos, r0, r0.w", Allowed::Nothing),
    (
        "slt r0, r3, r4\nsge r1, r3, r5\nmad oPos, r0, r1, r3",
        Allowed::Nothing,
    ),
    (
        "mov a0.x, r3.x\nmad oPos, c[a0.x + 1], r3, r4",
        Allowed::Nothing,
    ),
    ("rcp oPos, r3.x", Allowed::Quotients(3)),
    // Two roundings of the interpreter are worth 1.5 of a unit, Vulkan allows 2.
    ("rsq oPos, r3.x", Allowed::Quotients(4)),
    ("expp oPos.xyw, r3.x\nmov oPos.z, r4", Allowed::Nothing),
    ("logp oPos.xyw, r3.x\nmov oPos.z, r4", Allowed::Nothing),
    // 3 + 2·|x| units with |x| below 1.
    ("exp oPos, r3.x", Allowed::Ulps(5)),
    // Vulkan: 3 units, or 2⁻²¹ near to 1.
    ("log oPos, r3.x", Allowed::Absolute(1.0 / 2_097_152.0, 3)),
    // Partial results drop eight bits: two values that are five units apart may fall on either side of a step of 256.
    ("expp oPos, r3.x", Allowed::Ulps(256)),
    (
        "logp oPos, r3.x",
        Allowed::Absolute(1.0 / 2_097_152.0 + 1.0 / 65_536.0, 256),
    ),
    // 2 to the power of w·log2(y), with y from 10⁻⁶ and w from 0 to 1, so that the logarithm is above −20. Relative errors:
    // 3 units of 20 in the logarithm, 3·2⁻¹⁹·ln 2 = 4.0e-6; its product, rounded on both paths, 2·2⁻²⁰·ln 2 = 1.3e-6; the
    // exponential's 3 + 2·20 units, 43·2⁻²³ = 5.1e-6.
    ("lit oPos, r3", Allowed::Relative(1.04e-5)),
];

const PIXEL: &[(&str, Allowed)] = &[
    ("mad r0, r3, r4, r5", Allowed::Nothing),
    ("lrp r0, r3, r4, r5", Allowed::Nothing),
    ("lrp_x4_sat r0, 1-r3, r4_bx2, r5_x2", Allowed::Nothing),
    ("dp3 r0, r3, r4", Allowed::Nothing),
    ("dp4 r0, r3, r4", Allowed::Nothing),
    ("dp3_sat r0, r3_bx2, r4_bx2", Allowed::Nothing),
    ("mov r0, 1-r3", Allowed::Nothing),
    ("mov r0, r3_bias", Allowed::Nothing),
    ("mov r0, -r3_bx2", Allowed::Nothing),
    ("mul_d8 r0, r3_bx2, r4_x2", Allowed::Nothing),
    ("mad_x2 r0, r3, r4_bias, -r5", Allowed::Nothing),
    (
        "sub r1, r3, r4\nmul r1, r1, c0\nadd r0, r1, r5",
        Allowed::Nothing,
    ),
    (
        "dp3 r1, r3, r4\nmul r2, r1.r, c1\nmad r0, r2, c2, r3",
        Allowed::Nothing,
    ),
    (
        "mul r1, r3, r5\nmul r2, r4, r5\nadd r0, r1, -r2",
        Allowed::Nothing,
    ),
    (
        "cmp r1, r3, r4, r5\ncnd r2, r4, r3, r5\nmad_d2 r0, r1, r2, r1",
        Allowed::Nothing,
    ),
];

/// An instruction of a vertex shader reads one `v#` only.
const VERTEX_PROLOGUE: &str = "vs.1.1\nmov r3, v0\nmov r4, v1\nmov r5, v2\n";

/// Coordinate sets in r3 to r5; the fourth component, which no coordinate set gives in ps.1.4, is a colour.
const PIXEL_PROLOGUE: &str = "\
ps.1.4
def c2, 0.3, -0.7, 0.9, -0.1
texcrd r3.rgb, t0
texcrd r4.rgb, t1
texcrd r5.rgb, t2
phase
mov r3.a, v0.r
mov r4.a, v0.g
mov r5.a, v0.b
";

/// Numbers from −1 to 1 with all their bits, none so small that a product of three would not be normal.
fn inputs(count: usize) -> Vec<(Slot, Vec<[f32; 4]>)> {
    let mut random = Random::new(2002);
    let mut number = |low: f32| {
        let x = random.between(low, 1.0);
        if x.abs() < 1e-6 { 0.5 } else { x }
    };
    let mut of = |slots: Vec<Option<Slot>>, low: f32| -> Vec<(Slot, Vec<[f32; 4]>)> {
        let vectors = |slot: Slot| {
            let values = (0..count).map(|_| std::array::from_fn(|_| number(low)));
            (slot, values.collect())
        };
        slots.into_iter().flatten().map(vectors).collect()
    };
    let mut all = of((0..3).map(Slot::texcoord).collect(), -1.0);
    // As colours of pixels from 0 to 1.
    all.extend(of(vec![Slot::input(0)], 0.0));
    all.extend(of((1..3).map(Slot::input).collect(), -1.0));
    all
}

/// A listing that is ready for both paths.
struct Ready {
    kernel: Kernel,
    translation: Translation,
    constants: Vec<[f32; 4]>,
}

fn ready(text: &str) -> Ready {
    let mut sources = SourceMap::new();
    let file = sources.add("listing", text.as_bytes().to_vec());
    let checked = listing::check(file.expect("the listing is short"), Dialect::default());
    let Some(program) = checked.accepted() else {
        panic!("{text}\n{:?}", checked.diagnostics);
    };
    let kernel = lower(program, &kernel::Options::default()).expect("what is accepted is lowered");
    let stage = Stage {
        program,
        kernel: &kernel,
        source: &sources,
    };
    let (vertex, pixel) = match kernel.version.kind() {
        ShaderKind::Vertex => (Some(stage), None),
        ShaderKind::Pixel => (None, Some(stage)),
    };
    let options = wgsl::Options {
        exact_dots: true,
        half_pixel: false,
        level_zero: true,
        ..wgsl::Options::default()
    };
    let translation = translate(vertex, pixel, &options).expect("what is lowered translates");
    let mut random = Random::new(1);
    let set: Vec<_> = (0..8)
        .filter(|number| *number != 2)
        .map(|number| (number, std::array::from_fn(|_| random.between(-1.0, 1.0))))
        .collect();
    let constants = bind_constants(&kernel, &set);
    Ready {
        kernel,
        translation,
        constants,
    }
}

fn on_cpu(ready: &Ready, inputs: &[(Slot, Vec<[f32; 4]>)], invocation: usize) -> [f32; 4] {
    let mut machine = Machine::<1>::new();
    for (slot, values) in inputs {
        machine.load(*slot, values[invocation]);
    }
    let environment = Environment {
        constants: ready.constants.clone(),
        ..Environment::default()
    };
    machine.run(&ready.kernel, &environment);
    match ready.kernel.version.kind() {
        ShaderKind::Vertex => machine.lane(Slot::POSITION, 0),
        ShaderKind::Pixel => machine.lane(Slot::R0, 0),
    }
}

/// Whether a pair of numbers is near enough, on Mesa's software adapter or another.
fn is_near(cpu: f32, gpu: f32, allowed: Allowed, software: bool) -> bool {
    let off = ulps(cpu, gpu).unwrap_or(u64::MAX);
    let absolute = (f64::from(cpu) - f64::from(gpu)).abs();
    match allowed {
        Allowed::Nothing => off == 0,
        Allowed::Quotients(_) if software => off == 0,
        Allowed::Quotients(most) | Allowed::Ulps(most) => off <= most,
        Allowed::Relative(most) => absolute <= most * f64::from(cpu).abs(),
        Allowed::Absolute(most, ulps) => absolute <= most || off <= ulps,
    }
}

#[test]
fn compound_expressions_are_equal_in_units_in_the_last_place() {
    let Some(device) = exact_device() else {
        return;
    };
    let software = device.adapter().name.contains("llvmpipe");
    const COUNT: usize = 500;
    let inputs = inputs(COUNT);
    let vertex = VERTEX
        .iter()
        .map(|(body, allowed)| (format!("{VERTEX_PROLOGUE}{body}\n"), *allowed));
    let pixel = PIXEL
        .iter()
        .map(|(body, allowed)| (format!("{PIXEL_PROLOGUE}{body}\n"), *allowed));
    let listings: Vec<_> = vertex.chain(pixel).collect();
    let all: Vec<Ready> = listings.iter().map(|(text, _)| ready(text)).collect();
    let state = RenderState::default();
    let programs: Vec<Program<'_>> = (all.iter())
        .map(|ready| Program {
            translation: &ready.translation,
            uniforms: Uniforms {
                constants: &ready.constants,
                state: &state,
                viewport: [1.0; 2],
                stages: [StageUniforms::default(); 8],
            },
            textures: [None; 8],
            inputs: (inputs.iter())
                .map(|(slot, values)| (*slot, values.as_slice()))
                .collect(),
            point_size: false,
        })
        .collect();
    // Some at a time: a compiler takes more than twice as long for twice as much.
    for (number, some) in programs.chunks(8).enumerate() {
        let results = run_exactly(&device, &Batch::new(some, COUNT)).expect("the GPU runs");
        let some = all.iter().zip(&listings).skip(8 * number);
        for ((ready, (text, allowed)), results) in some.zip(&results) {
            let (_, values) = &results.outputs[0];
            assert_eq!(values.len(), COUNT);
            let mut worst = 0;
            for (invocation, gpu) in values.iter().enumerate() {
                let cpu = on_cpu(ready, &inputs, invocation);
                for (a, b) in cpu.into_iter().zip(*gpu) {
                    let near = is_near(a, b, *allowed, software);
                    assert!(
                        near,
                        "{text}: {a:?} on the CPU, {b:?} on the GPU, {:?} ULP",
                        ulps(a, b)
                    );
                    worst = worst.max(ulps(a, b).unwrap_or(u64::MAX));
                }
            }
            if worst > 0 {
                println!("{worst} ULP: {}", text.lines().last().unwrap_or_default());
            }
        }
    }
}

/// A generated shader of arithmetic alone, without what no device computes exactly.
fn arithmetic(version: Version, seed: u64, software: bool, textures: &Textures) -> Subject {
    let rounded = [
        Opcode::Exp,
        Opcode::ExpP,
        Opcode::Log,
        Opcode::LogP,
        Opcode::Lit,
    ];
    let quotients = [Opcode::Rcp, Opcode::Rsq];
    let out = quotients.into_iter().filter(|_| !software).chain(rounded);
    let options = generate::Options {
        weights: Weights {
            opcodes: out.map(|opcode| (opcode, 0)).collect(),
            textures: 0,
            // The translation below writes definitions into the text, which nothing from outside may replace.
            contested: 0,
            ..Weights::default()
        },
        ..generate::Options::new(version)
    };
    let generated = generate::shader(&mut Random::new(seed), &options, textures);
    Subject {
        generated,
        translation: wgsl::Options {
            exact_dots: true,
            overridable_definitions: false,
            ..Subject::new(generate::Options::new(version), seed, textures).translation
        },
        options,
    }
}

/// What the interpreter leaves behind, colours and fog from 0 to 1 as vertex shaders pass them on.
fn expected(generated: &Generated, slot: Slot, component: usize, invocation: usize) -> f32 {
    let outcome = generated
        .outcomes
        .iter()
        .find(|outcome| outcome.slot == slot);
    let value = outcome.expect("what is compared is an outcome").values[invocation][component];
    let color = (0..2).any(|i| Slot::color_output(i) == Some(slot));
    if color || slot == Slot::FOG {
        value.clamp(0.0, 1.0)
    } else {
        value
    }
}

#[test]
fn generated_arithmetic_is_equal_to_the_bit() {
    let textures = Textures::new().expect("textures of sizes that fit");
    const EACH: u64 = 32;
    let Some(device) = exact_device() else {
        // Held to the bounds of WGSL at least.
        let Some(device) = crate::device() else {
            return;
        };
        for version in Version::all() {
            let some: Vec<_> = (0..EACH)
                .map(|seed| arithmetic(version, seed, false, &textures))
                .collect();
            let compared =
                matching::compare(&device, &some, &textures, None).expect("the GPU runs");
            assert!(
                compared.iter().all(|c| c.differences.is_empty()),
                "{version}"
            );
        }
        return;
    };
    let software = device.adapter().name.contains("llvmpipe");
    let mut numbers = 0;
    for version in Version::all() {
        let some: Vec<_> = (0..EACH)
            .map(|seed| arithmetic(version, seed, software, &textures))
            .collect();
        for some in some.chunks(16) {
            let run = |batch: &Batch<'_>| run_exactly(&device, batch);
            let results =
                matching::run_together(some, &textures, None, &run).expect("the GPU runs");
            for (subject, results) in some.iter().zip(&results) {
                let generated = &subject.generated;
                assert_eq!(results.killed, [false; INVOCATIONS]);
                for outcome in &generated.outcomes {
                    let found = results
                        .outputs
                        .iter()
                        .find(|(slot, _)| *slot == outcome.slot);
                    let (slot, values) = found.expect("every outcome comes back");
                    for (invocation, gpu) in values.iter().enumerate() {
                        for component in outcome.mask.components() {
                            let a = expected(generated, *slot, component, invocation);
                            let b = gpu[component];
                            assert_eq!(
                                ulps(a, b),
                                Some(0),
                                "{slot:?}.{component}: {a:?} on the CPU, {b:?} on the GPU\n{}",
                                generated.listing
                            );
                            numbers += 1;
                        }
                    }
                }
            }
        }
    }
    // Four invocations of four components at least.
    assert!(numbers > 7 * EACH * 16, "{numbers}");
    println!("{numbers} numbers, all equal");
}
