//! What can be written is written.

use super::*;
use crate::isa::modifier::SHIFTS;
use crate::isa::register::{OFOG, OPOS, OPTS};
use crate::isa::{Class, ResultModifier, SourceModifier, Swizzle, VersionSet};
use crate::program::Instruction;

const SEEDS: u64 = 1500;

/// Every comparable shader of a version.
fn all(version: Version) -> Vec<Generated> {
    let textures = Textures::new().unwrap();
    let options = Options::new(version);
    (0..SEEDS)
        .map(|seed| made(seed, &options, &textures))
        .collect()
}

fn instructions(shaders: &[Generated]) -> impl Iterator<Item = &Instruction> {
    shaders.iter().flat_map(|s| s.program.instructions())
}

#[test]
fn every_form_mask_modifier_and_shift_occurs() {
    for version in Version::all() {
        let shaders = all(version);
        for opcode in Opcode::all() {
            let Some(form) = opcode.form(version) else {
                continue;
            };
            if form.class == Class::Declaration {
                continue;
            }
            let with: Vec<_> = instructions(&shaders)
                .filter(|i| i.opcode == opcode)
                .collect();
            assert!(
                with.len() >= 10,
                "{version} {}: {}",
                opcode.mnemonic(),
                with.len()
            );
            let arithmetic = form.class == Class::Arithmetic;
            if let Some(shape) = form.destination.filter(|_| arithmetic) {
                for mask in shape.masks.iter() {
                    let there = with.iter().any(|i| i.destination.unwrap().mask == mask);
                    assert!(there, "{version} {} {mask}", opcode.mnemonic());
                }
            }
        }
        let pixel = version.kind() == ShaderKind::Pixel;
        for modifier in SourceModifier::all() {
            let row = modifier.row();
            let has = row.arithmetic.and(row.coordinates).contains(version);
            let there = instructions(&shaders)
                .flat_map(|i| &i.sources)
                .any(|s| s.modifier == modifier);
            assert_eq!(has, there, "{version} {modifier:?}");
        }
        for row in &SHIFTS {
            for saturate in [false, true] {
                let result = ResultModifier {
                    shift: row.shift,
                    saturate,
                };
                let there = instructions(&shaders).any(|i| i.result == result);
                assert_eq!(
                    row.versions.contains(version),
                    there,
                    "{version} {result:?}"
                );
            }
        }
        assert_eq!(pixel, instructions(&shaders).any(|i| i.result.saturate));
        let defines = |s: &Generated| s.program.definitions().next().is_some();
        assert!(shaders.iter().any(defines) && !shaders.iter().all(defines));
    }
}

#[test]
fn pairs_occur_with_either_half_first() {
    for version in VersionSet::PS.iter() {
        let shaders = all(version);
        for alpha_first in [false, true] {
            let pairs = shaders.iter().any(|s| {
                let all: Vec<_> = s.program.instructions().collect();
                all.windows(2).any(|w| {
                    w[1].co_issue && (w[0].destination.unwrap().mask == WriteMask::W) == alpha_first
                })
            });
            assert!(pairs, "{version} {alpha_first}");
        }
        let crosses = instructions(&shaders).filter(|i| i.co_issue).count();
        assert!(crosses > 300, "{version}: {crosses}");
    }
}

#[test]
fn vertex_shaders_write_every_output_and_use_the_address_register() {
    for version in VersionSet::VS.iter() {
        let shaders = all(version);
        let written = |file: RegisterFile, index: u32| {
            let to = Register::new(file, index);
            instructions(&shaders).any(|i| i.destination.is_some_and(|d| d.register == to))
        };
        for index in [OPOS, OFOG, OPTS] {
            assert!(written(RegisterFile::RastOut, index), "{index}");
        }
        assert!((0..2).all(|i| written(RegisterFile::AttrOut, i)));
        assert!((0..8).all(|i| written(RegisterFile::TexCrdOut, i)));
        assert!((0..12).all(|i| written(RegisterFile::Temp, i)));
        let has_address = version == Version::Vs11;
        assert_eq!(written(RegisterFile::Addr, 0), has_address);
        // With a0.x within ±8, c[a0.x + 95] may lie above and c[a0.x] below what there is.
        let (mut inside, mut outside) = (0, 0);
        for shader in shaders.iter() {
            let kernel = shader.lower(&shader.program).unwrap();
            let textures = Textures::new().unwrap();
            let environment = shader.environment(&kernel, &textures);
            let mut machine = Machine::<INVOCATIONS>::new();
            shader.load(&mut machine, 0);
            machine.run(&kernel, &environment);
            let a0 = machine.lane(Slot::ADDRESS, 0)[0] as i64;
            let relative = instructions(std::slice::from_ref(shader))
                .flat_map(|i| &i.sources)
                .filter(|s| s.register.relative);
            for source in relative {
                match a0 + i64::from(source.register.index) {
                    0..96 => inside += 1,
                    _ => outside += 1,
                }
            }
        }
        assert_eq!(
            inside > 50 && outside > 50,
            has_address,
            "{inside} {outside}"
        );
        assert_eq!(inside > 0 || outside > 0, has_address, "{inside} {outside}");
    }
}

#[test]
fn phases_dependent_reads_and_kinds_of_textures_occur() {
    let shaders = all(Version::Ps14);
    let phases = instructions(&shaders)
        .filter(|i| i.opcode == Opcode::Phase)
        .count() as u64;
    assert!((SEEDS / 2..SEEDS * 4 / 5).contains(&phases), "{phases}");
    let loads = |what: &dyn Fn(&crate::program::Source) -> bool| {
        let loads = instructions(&shaders).filter(|i| i.opcode == Opcode::TexLd);
        loads.filter(|i| what(&i.sources[0])).count()
    };
    assert!(loads(&|s| s.register.file == RegisterFile::Temp) > 100);
    assert!(loads(&|s| s.modifier == SourceModifier::Dz) > 10);
    assert!(loads(&|s| s.modifier == SourceModifier::Dw) > 10);
    for swizzle in [Swizzle::XYZZ, Swizzle::XYWW] {
        assert!(loads(&|s| s.swizzle == swizzle) > 10);
    }
    for version in VersionSet::PS.iter() {
        let shaders = all(version);
        for kind in [
            TextureKind::Texture2D,
            TextureKind::Cube,
            TextureKind::Volume,
        ] {
            let sampled = shaders.iter().filter(|s| {
                let stages = s.lower(&s.program).unwrap().stages();
                (0..STAGES).any(|i| stages & (1 << i) != 0 && s.stages[i].kind == kind)
            });
            let sampled = sampled.count();
            assert!(sampled > 30, "{version} {kind}: {sampled}");
        }
        for killed in [false, true] {
            assert!(
                shaders.iter().any(|s| s.killed[0] == killed),
                "{version} {killed}"
            );
        }
    }
}
