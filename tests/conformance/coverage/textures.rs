//! Textures: kinds, formats, address modes, filters, faces, stages, and the states of a stage.

use super::Checklist;
use super::probe::{Line, PROJECTED, instruction_set, lines, projection, title};
use texcrd::case::Case;
use texcrd::isa::{Opcode, ShaderKind, Version};
use texcrd::kernel::{Op, Place, Projection};
use texcrd::texture::{
    AddressMode, Filter, Format, MipFilter, Sampler, Texture, TextureKind, sample_at,
};

/// The stage that an instruction samples.
fn sampled(line: &Line<'_>) -> Option<usize> {
    let steps = &line.shader.kernel.steps;
    let mut own = steps.iter().filter(|step| step.origin == line.number);
    own.find_map(|step| match step.op {
        Op::Sample(stage) => Some(usize::from(stage)),
        _ => None,
    })
}

/// Every instruction that samples, with its stage, of cases that depend on what it gives.
fn samples() -> impl Iterator<Item = (Line<'static>, usize)> {
    lines()
        .filter_map(|line| Some((line, sampled(&line)?)))
        .filter(|(line, _)| line.is_seen())
}

fn kinds(opcode: Opcode) -> &'static [Option<TextureKind>] {
    use TextureKind::{Cube, Texture2D, Volume};
    // instructions.md, 6 and 7: by the number of coordinates that the instruction makes. Nothing bound is a texture too.
    match opcode {
        Opcode::Tex | Opcode::TexLd | Opcode::TexReg2Rgb | Opcode::TexBem | Opcode::TexBeml => {
            &[Some(Texture2D), Some(Cube), Some(Volume), None]
        }
        Opcode::TexM3x3Tex | Opcode::TexM3x3Spec | Opcode::TexM3x3VSpec => {
            &[Some(Cube), Some(Volume), None]
        }
        _ => &[Some(Texture2D), None],
    }
}

#[test]
fn every_kind_of_texture_in_every_instruction() {
    let item = |title: &str, kind: Option<TextureKind>| match kind {
        Some(kind) => format!("{title} from {kind}"),
        None => format!("{title} where nothing is bound"),
    };
    let mut opcodes: Vec<Opcode> = samples().map(|(line, _)| line.opcode()).collect();
    opcodes.sort_unstable();
    opcodes.dedup();
    let wanted = instruction_set()
        .filter(|(_, opcode)| opcodes.contains(opcode))
        .flat_map(|(version, opcode)| {
            let kinds = kinds(opcode).iter();
            kinds.map(move |kind| item(&title(version, opcode), *kind))
        });
    let mut list = Checklist::new("textures of instructions", wanted);
    for (line, stage) in samples() {
        let texture = line.probe.case.stages[stage].texture.as_ref();
        list.tick(&item(&line.title(), texture.map(Texture::kind)), || true);
    }
    list.finish();
}

#[test]
fn every_stage_of_every_version() {
    let item = |version: Version, stage: usize| format!("{version} stage {stage}");
    let stages = |version| texcrd::isa::RegisterFile::Texture.count(version) as usize;
    let pixel = Version::all().filter(|version| version.kind() == ShaderKind::Pixel);
    let wanted = pixel.flat_map(|version| (0..stages(version)).map(move |s| item(version, s)));
    let mut list = Checklist::new("stages", wanted);
    for (line, stage) in samples() {
        let bound = line.probe.case.stages[stage].texture.is_some();
        list.tick(&item(line.version, stage), || bound);
    }
    list.finish();
}

/// The ends of each channel: what a format makes of -1 and of 1. A channel that the format lacks has only one.
fn ends(format: Format) -> [[f32; 4]; 2] {
    match format {
        // The third component of a unit vector is computed.
        Format::CxV8U8 => [[-1.0, -1.0, 0.0, 1.0], [1.0; 4]],
        _ if format.is_compressed() => [[0.0; 4], [1.0; 4]],
        _ => [-1.0, 1.0].map(|number| {
            let (kind, texels) = (TextureKind::Texture2D, [[[number; 4]]]);
            let texture = Texture::from_texels(kind, format, [1, 1, 1], &texels);
            let texture = texture.expect("a texture of one texel");
            texture.texel(0, 0, 0, 0, 0).expect("its texel")
        }),
    }
}

/// Both ends of every channel of every format, and a number between them.
#[test]
fn every_channel_of_every_format() {
    let item = |format: Format, channel: usize, what: &str| {
        format!("{format} {}: {what}", ['r', 'g', 'b', 'a'][channel])
    };
    const NAMES: [&str; 3] = ["lowest", "highest", "between"];
    let wanted = Format::all().flat_map(|format| {
        let [low, high] = ends(format);
        (0..4).flat_map(move |channel| {
            let names = match format {
                // Floats have no ends.
                Format::Rgba32F => 2..3,
                // Neither has what the format lacks; one bit has nothing between.
                _ if low[channel] == high[channel] => 0..1,
                Format::A1R5G5B5 | Format::Dxt1 if channel == 3 => 0..2,
                _ => 0..3,
            };
            names.map(move |what| item(format, channel, NAMES[what]))
        })
    });
    let mut list = Checklist::new("ends of channels of formats", wanted.collect::<Vec<_>>());
    for (line, stage) in samples() {
        let Some(texture) = &line.probe.case.stages[stage].texture else {
            continue;
        };
        let format = texture.format();
        let [low, high] = ends(format);
        for (channel, number) in results(&line, stage) {
            let what = match number {
                _ if format == Format::Rgba32F => NAMES[2],
                _ if number == low[channel] => NAMES[0],
                _ if number == high[channel] => NAMES[1],
                _ => NAMES[2],
            };
            list.tick(&item(format, channel, what), || true);
        }
    }
    list.finish();
}

/// The numbers that a line samples in invocations that depend on them, with their channels.
fn results(line: &Line<'_>, stage: usize) -> Vec<(usize, f32)> {
    let state = &line.probe.case.stages[stage];
    let steps = &line.shader.kernel.steps;
    let reads = line.probe.reads(line.kind());
    let mut all = Vec::new();
    for channel in 0..4 {
        for invocation in line.matters(channel) {
            let own = reads.iter().filter(|(of, step, _)| {
                let step = &steps[*step];
                *of == invocation
                    && step.origin == line.number
                    && step.op == Op::Sample(stage as u8)
            });
            for (_, _, [at, ..]) in own {
                let [u, v, w, _] = *at;
                let texel = match &state.texture {
                    Some(texture) => {
                        sample_at(Some(texture), &state.sampler, [u, v, w], f32::NEG_INFINITY)
                    }
                    None => continue,
                };
                all.push((channel, texel[channel]));
            }
        }
    }
    all
}

/// Whether a case fails when a sampler is changed like this.
fn notices_sampler(line: &Line<'_>, stage: usize, spoil: impl FnOnce(&mut Sampler)) -> bool {
    line.probe
        .notices(|case: &mut Case| spoil(&mut case.stages[stage].sampler))
}

/// The filters that differ where a pixel is alone: an anisotropic one magnifies as a linear one.
const MAGNIFYING: [Filter; 2] = [Filter::Point, Filter::Linear];

/// Every address mode on every axis under every filter, told apart from every other; on a cube all of them give the same.
#[test]
fn every_address_mode() {
    let item = |mode: AddressMode, axis: usize, filter: Filter, other: AddressMode| {
        format!(
            "{mode} along {} under {filter}, told from {other}",
            ['u', 'v', 'w'][axis]
        )
    };
    let on_cube = |mode: AddressMode| format!("{mode} on a cube");
    let mut wanted: Vec<String> = AddressMode::ALL.iter().map(|mode| on_cube(*mode)).collect();
    for mode in AddressMode::ALL {
        for other in AddressMode::ALL.iter().filter(|other| *other != mode) {
            for axis in 0..3 {
                for filter in MAGNIFYING {
                    wanted.push(item(*mode, axis, filter, *other));
                }
            }
        }
    }
    let mut list = Checklist::new("address modes", wanted);
    for (line, stage) in samples() {
        let state = &line.probe.case.stages[stage];
        let (modes, filter) = (state.sampler.address, state.sampler.mag);
        match state.texture.as_ref().map(Texture::kind) {
            Some(TextureKind::Cube) => {
                // Where a mode could show, a filter reaches across an edge.
                list.tick(&on_cube(modes[0]), || filter == Filter::Linear);
            }
            Some(_) => {
                for (axis, mode) in modes.into_iter().enumerate() {
                    for other in AddressMode::ALL {
                        list.tick(&item(mode, axis, filter, *other), || {
                            notices_sampler(&line, stage, |sampler| sampler.address[axis] = *other)
                        });
                    }
                }
            }
            None => {}
        }
    }
    list.finish();
}

/// What magnifies, on every kind of texture; a pixel alone has nothing that would be made smaller.
#[test]
fn every_filter_and_state_of_a_sampler() {
    let kinds = TextureKind::ALL;
    let filter = |kind: TextureKind, filter: Filter| format!("{filter} filter on {kind}");
    let mip = |mip: MipFilter| format!("mip filter {mip}");
    let mut wanted: Vec<String> = MipFilter::ALL.iter().map(|m| mip(*m)).collect();
    wanted.extend(
        kinds
            .iter()
            .flat_map(|kind| Filter::ALL.iter().map(|f| filter(*kind, *f))),
    );
    for kind in kinds.iter().filter(|kind| **kind != TextureKind::Cube) {
        wanted.push(format!("border on {kind}"));
    }
    wanted.extend([
        "seamless".into(),
        "with seams".into(),
        "max_mip_level".into(),
    ]);
    let mut list = Checklist::new("states of samplers", wanted);
    for (line, stage) in samples() {
        let state = &line.probe.case.stages[stage];
        let (Some(texture), sampler) = (&state.texture, state.sampler) else {
            continue;
        };
        let changed = |spoil: &dyn Fn(&mut Sampler)| notices_sampler(&line, stage, spoil);
        let other = match sampler.mag {
            Filter::Point => Filter::Linear,
            _ => Filter::Point,
        };
        list.tick(&filter(texture.kind(), sampler.mag), || {
            changed(&|s| s.mag = other)
        });
        let other = match sampler.mip {
            MipFilter::None => MipFilter::Point,
            _ => MipFilter::None,
        };
        list.tick(&mip(sampler.mip), || changed(&|s| s.mip = other));
        list.tick("max_mip_level", || changed(&|s| s.max_mip_level = 0));
        list.tick(&format!("border on {}", texture.kind()), || {
            changed(&|s| s.border = [0.9, 0.8, 0.7, 0.6])
        });
        let seams = if sampler.seamless {
            "seamless"
        } else {
            "with seams"
        };
        list.tick(seams, || changed(&|s| s.seamless = !s.seamless));
    }
    list.finish();
}

/// Every element of the bump matrix and the two numbers of luminance, in every instruction that has them.
#[test]
fn every_bump_state() {
    const STATES: [&str; 6] = [
        "m00",
        "m01",
        "m10",
        "m11",
        "luminance scale",
        "luminance offset",
    ];
    let states = |opcode: Opcode| match opcode {
        Opcode::TexBem | Opcode::Bem => &STATES[..4],
        Opcode::TexBeml => &STATES[..],
        _ => &STATES[..0],
    };
    let item = |title: &str, state: &str| format!("{title} {state}");
    let wanted = instruction_set().flat_map(|(version, opcode)| {
        let states = states(opcode).iter();
        states.map(move |state| item(&title(version, opcode), state))
    });
    let mut list = Checklist::new("bump states", wanted);
    for line in lines() {
        let Some(destination) = line.instruction.destination else {
            continue;
        };
        let stage = destination.register.index as usize;
        for (i, state) in states(line.opcode()).iter().enumerate() {
            list.tick(&item(&line.title(), state), || {
                // A point filter may give the same texel at one other number, not at all of them.
                [0.0, 0.5, -0.375].into_iter().any(|number| {
                    line.probe.notices(|case| {
                        let bump = &mut case.stages[stage].bump;
                        match i {
                            0..4 => bump.matrix[i] = number,
                            4 => bump.luminance_scale = number,
                            _ => bump.luminance_offset = number,
                        }
                    })
                })
            });
        }
    }
    list.finish();
}

/// `D3DTTFF_PROJECTED`: what divides in every instruction that heeds it.
#[test]
fn every_projection() {
    let item = |title: &str, by: Projection| format!("{title} divided by {by:?}");
    let wanted = instruction_set()
        .filter(|(_, opcode)| PROJECTED.contains(opcode))
        .flat_map(|(version, opcode)| {
            [Projection::Third, Projection::Fourth].map(|by| item(&title(version, opcode), by))
        });
    let mut list = Checklist::new("projections", wanted);
    for line in lines().filter(|line| PROJECTED.contains(&line.opcode())) {
        let Some(by) = projection(&line.shader.kernel, line.number) else {
            continue;
        };
        list.tick(&item(&line.title(), by), || {
            // The division becomes a copy.
            line.notices_steps(|step| {
                if matches!(step.op, Op::DivideZ | Op::DivideW | Op::Project(_)) {
                    step.op = Op::Mov;
                }
            })
        });
    }
    list.finish();
}

/// Every face of a cube at its middle, on each of its edges and corners, and where the largest components tie.
#[test]
fn every_face_edge_and_corner_of_a_cube() {
    let name = |face: usize, place: &str| format!("face {face}, {place}");
    let mut wanted = Vec::new();
    for face in 0..6 {
        let inside = [
            "left",
            "right",
            "upper",
            "lower",
            "upper left",
            "upper right",
            "lower left",
            "lower right",
        ];
        wanted.extend(inside.map(|place| name(face, place)));
    }
    // Each of the twelve edges and eight corners of the cube itself, by the signs of the direction.
    let signs = || (0..27i32).map(|n| [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1]);
    let ties = signs().filter(|signs| signs.iter().filter(|sign| **sign != 0).count() >= 2);
    wanted.extend(ties.map(|signs| format!("tie {signs:?}")));
    let mut list = Checklist::new("places on a cube", wanted);
    for (line, stage) in samples() {
        let state = &line.probe.case.stages[stage];
        if state.texture.as_ref().map(Texture::kind) != Some(TextureKind::Cube) {
            continue;
        }
        let steps = &line.shader.kernel.steps;
        let seen: Vec<usize> = (0..4).flat_map(|channel| line.matters(channel)).collect();
        for (invocation, step, [at, ..]) in line.probe.reads(line.kind()) {
            let step = &steps[step];
            let own = step.origin == line.number && step.op == Op::Sample(stage as u8);
            if !own || !seen.contains(&invocation) {
                continue;
            }
            let direction = [at[0], at[1], at[2]];
            let largest = direction.iter().fold(0f32, |most, c| most.max(c.abs()));
            let tied = direction.map(|c| {
                if c.abs() == largest {
                    c.signum() as i32
                } else {
                    0
                }
            });
            list.tick(&format!("tie {tied:?}"), || true);
            let (face, [u, v]) = texcrd::texture::direction_to_face(direction);
            let rows = [(v < 0.25, "upper"), (v > 0.75, "lower")];
            let columns = [(u < 0.25, "left"), (u > 0.75, "right")];
            let of =
                |places: [(bool, &'static str); 2]| places.into_iter().find(|p| p.0).map(|p| p.1);
            let words: Vec<&str> = [of(rows), of(columns)].into_iter().flatten().collect();
            list.tick(&name(face, &words.join(" ")), || true);
        }
    }
    list.finish();
}

/// Coordinates of dependent reads come from a register, others from a set.
#[test]
fn dependent_reads_are_read_from_registers() {
    let dependent = lines().filter(|line| {
        let steps = &line.shader.kernel.steps;
        steps.iter().any(|step| {
            step.origin == line.number
                && matches!(step.op, Op::Sample(_))
                && step.sources.iter().any(
                    |s| matches!(s.place, Place::Slot(slot) if slot.texcoord_index().is_none()),
                )
        })
    });
    assert!(dependent.count() > 20);
}
