//! Source modifiers, result modifiers, selectors, swizzles and write masks.

use super::Checklist;
use super::probe::{Line, instruction_set, lines, title};
use texcrd::isa::modifier::SHIFTS;
use texcrd::isa::opcode::ModifierRule;
use texcrd::isa::{
    Class, MaskSet, Opcode, RegisterFile, ResultModifier, ShaderKind, SourceModifier, Swizzle,
    Version, WriteMask,
};
use texcrd::program::Source;

/// The modifiers that a source of an instruction takes in a version.
fn source_modifiers(version: Version, opcode: Opcode, i: usize) -> Vec<SourceModifier> {
    let Some(source) = opcode.form(version).and_then(|form| form.sources.get(i)) else {
        return Vec::new();
    };
    // The condition of `cnd` before ps.1.4 is r0.a and nothing else (limits.md, O15).
    if opcode == Opcode::Cnd && version != Version::Ps14 && i == 0 {
        return Vec::new();
    }
    let all = SourceModifier::all().filter(|modifier| *modifier != SourceModifier::None);
    let takes = |modifier: &SourceModifier| match source.modifiers {
        ModifierRule::Arithmetic => modifier.row().arithmetic.contains(version),
        ModifierRule::Bx2(versions) => {
            *modifier == SourceModifier::Bx2 && versions.contains(version)
        }
        // r# is divided by its third component, t# by its fourth (modifiers.md, 2); texcrd reads no r#.
        ModifierRule::Coordinates => {
            let needs = match modifier {
                SourceModifier::Dz => RegisterFile::Temp,
                _ => RegisterFile::Texture,
            };
            modifier.row().coordinates.contains(version) && source.files.contains(needs)
        }
        ModifierRule::Matrix | ModifierRule::Plain => false,
    };
    all.filter(takes)
        .filter(|modifier| is_visible(opcode, i, *modifier))
        .collect()
}

/// Twice a number has its sign, which is all that the first source of `cmp` is asked for; `rsq` and logarithms take the absolute value.
fn is_visible(opcode: Opcode, i: usize, modifier: SourceModifier) -> bool {
    let sign_only = opcode == Opcode::Cmp && i == 0;
    let absolute = matches!(opcode, Opcode::Rsq | Opcode::Log | Opcode::LogP);
    !(sign_only && modifier == SourceModifier::X2 || absolute && modifier == SourceModifier::Negate)
}

fn text(modifier: SourceModifier) -> String {
    format!("{}x{}", modifier.row().prefix, modifier.row().suffix)
}

fn without_modifier(line: &Line<'_>, i: usize) -> bool {
    line.notices(|instruction| instruction.sources[i].modifier = SourceModifier::None)
}

#[test]
fn every_source_modifier_of_every_source() {
    let item = |title: &str, i: usize, modifier| format!("{title}: s{i} {}", text(modifier));
    let wanted = instruction_set().flat_map(|(version, opcode)| {
        (0..3).flat_map(move |i| {
            let modifiers = source_modifiers(version, opcode, i).into_iter();
            modifiers.map(move |modifier| item(&title(version, opcode), i, modifier))
        })
    });
    let mut list = Checklist::new("source modifiers", wanted);
    for line in lines() {
        for (i, source) in line.instruction.sources.iter().enumerate() {
            list.tick(&item(&line.title(), i, source.modifier), || {
                without_modifier(&line, i)
            });
        }
    }
    list.finish();
}

/// Every shift, alone and saturated, and saturation alone.
fn result_modifiers(version: Version) -> Vec<ResultModifier> {
    let shifts = std::iter::once(0).chain(SHIFTS.iter().map(|row| row.shift));
    shifts
        .flat_map(|shift| [false, true].map(|saturate| ResultModifier { shift, saturate }))
        .filter(|result| *result != ResultModifier::NONE && result.exists_in(version))
        .collect()
}

#[test]
fn every_result_modifier_of_every_instruction() {
    let item = |title: &str, result: ResultModifier| format!("{title}{}", result.text());
    let takes = |(version, opcode): &(Version, Opcode)| {
        let form = opcode.form(*version);
        let computes = |form: &texcrd::isa::Form| {
            form.class == Class::Arithmetic && form.destination.is_some()
        };
        version.kind() == ShaderKind::Pixel && form.is_some_and(computes)
    };
    let wanted = instruction_set()
        .filter(takes)
        .flat_map(|(version, opcode)| {
            let results = result_modifiers(version).into_iter();
            results.map(move |result| item(&title(version, opcode), result))
        });
    let mut list = Checklist::new("result modifiers", wanted);
    for line in lines() {
        let result = line.instruction.result;
        list.tick(&item(&line.title(), result), || {
            let shift = result.shift == 0 || line.notices(|i| i.result.shift = 0);
            let saturate = !result.saturate || line.notices(|i| i.result.saturate = false);
            shift && saturate
        });
    }
    list.finish();
}

/// The letters that a selector of arithmetic may be (modifiers.md, 3).
fn selectors(version: Version) -> &'static [u8] {
    match version {
        Version::Vs10 | Version::Vs11 => &[],
        Version::Ps10 => &[3],
        Version::Ps11 | Version::Ps12 | Version::Ps13 => &[2, 3],
        Version::Ps14 => &[0, 1, 2, 3],
    }
}

#[test]
fn every_selector_under_every_modifier() {
    let item = |version: Version, selector: u8, modifier| {
        let letter = ['r', 'g', 'b', 'a'][usize::from(selector)];
        format!("{version} {}.{letter}", text(modifier))
    };
    let arithmetic = |version: Version| {
        SourceModifier::all().filter(move |m| m.row().arithmetic.contains(version))
    };
    let wanted = Version::all().flat_map(|version| {
        let all = selectors(version).iter();
        all.flat_map(move |s| arithmetic(version).map(move |m| item(version, *s, m)))
    });
    let mut list = Checklist::new("selectors", wanted);
    for line in lines().filter(|line| line.kind() == ShaderKind::Pixel) {
        for (i, source) in line.instruction.sources.iter().enumerate() {
            let Some(selector) = source.swizzle.replicated() else {
                continue;
            };
            list.tick(&item(line.version, selector, source.modifier), || {
                let plain = source.modifier == SourceModifier::None;
                let selected = line.notices(|i2| i2.sources[i].swizzle = Swizzle::IDENTITY);
                selected && (plain || without_modifier(&line, i))
            });
        }
    }
    list.finish();
}

/// `texld` and `texcrd` of .xyz and .xyw, divided or not, from each file that they read.
#[test]
fn every_selector_of_coordinates() {
    // instructions.md, 7.1
    let wanted = [
        "texld t#.xyz",
        "texld t#.xyw",
        "texld t#_dw.xyw",
        "texld r#.xyz",
        "texld r#_dz.xyz",
        "texcrd t#.xyz",
        "texcrd t#.xyw",
        "texcrd t#_dw.xyw",
    ];
    let mut list = Checklist::new(
        "selectors of coordinates",
        wanted.iter().map(ToString::to_string),
    );
    for line in lines() {
        let [source] = line.instruction.sources[..] else {
            continue;
        };
        let letters = match source.swizzle {
            Swizzle::XYWW => "xyw",
            // Without a selector it is .xyz.
            _ => "xyz",
        };
        let Source {
            register, modifier, ..
        } = source;
        let (mnemonic, file) = (line.opcode().mnemonic(), register.file.row().prefix);
        let suffix = modifier.row().suffix;
        list.tick(&format!("{mnemonic} {file}#{suffix}.{letters}"), || {
            let other = match source.swizzle {
                Swizzle::XYWW => Swizzle::IDENTITY,
                _ => Swizzle::XYWW,
            };
            // What is divided has no third component that a selector could choose.
            match modifier {
                SourceModifier::None => line.notices(|i| i.sources[0].swizzle = other),
                _ => without_modifier(&line, 0),
            }
        });
    }
    list.finish();
}

/// Every slot of a swizzle reads every component, in every vertex instruction some source is swizzled, and scalar instructions
/// read any component.
#[test]
fn every_swizzle_of_vertex_shaders() {
    let letters = ['x', 'y', 'z', 'w'];
    let slot = |version: Version, slot: usize, component: usize| {
        format!(
            "{version} slot {} reads {}",
            letters[slot], letters[component]
        )
    };
    let source = |title: &str, i: usize| format!("{title}: s{i} swizzled");
    let scalar = |title: &str, component: usize| format!("{title} of .{}", letters[component]);
    let vertex = || Version::all().filter(|version| version.kind() == ShaderKind::Vertex);
    let mut wanted: Vec<String> = vertex()
        .flat_map(|version| (0..16).map(move |n| slot(version, n / 4, n % 4)))
        .collect();
    for (version, opcode) in instruction_set().filter(|(v, _)| v.kind() == ShaderKind::Vertex) {
        let form = opcode.form(version).expect("it has one");
        for (i, shape) in form.sources.iter().enumerate() {
            if shape.modifiers == ModifierRule::Arithmetic {
                wanted.push(source(&title(version, opcode), i));
            }
        }
        if form.sources.len() == 1 && form.slots_read(0, WriteMask::NONE) == WriteMask::W {
            wanted.extend((0..4).map(|component| scalar(&title(version, opcode), component)));
        }
    }
    let mut list = Checklist::new("swizzles", wanted);
    for line in lines().filter(|line| line.kind() == ShaderKind::Vertex) {
        for (i, read) in line.instruction.sources.iter().enumerate() {
            let swizzle = read.swizzle;
            if swizzle == Swizzle::IDENTITY {
                continue;
            }
            let plain = || line.notices(|i2| i2.sources[i].swizzle = Swizzle::IDENTITY);
            list.tick(&source(&line.title(), i), plain);
            for (component, read) in swizzle.slots().into_iter().enumerate() {
                list.tick(&slot(line.version, component, usize::from(read)), || {
                    let mut slots = swizzle.slots();
                    slots[component] = (read + 1) % 4;
                    line.notices(|i2| i2.sources[i].swizzle = Swizzle::new(slots))
                });
            }
            if let Some(component) = swizzle.replicated() {
                list.tick(&scalar(&line.title(), usize::from(component)), || {
                    let other = Swizzle::replicate((component + 1) % 4);
                    line.notices(|i2| i2.sources[i].swizzle = other)
                });
            }
        }
    }
    list.finish();
}

/// A mask is seen if no component can be left out and none can be added.
fn mask_is_seen(line: &Line<'_>) -> bool {
    let mask = line.mask();
    let set = |mask: WriteMask| {
        line.notices(|instruction| {
            if let Some(destination) = &mut instruction.destination {
                destination.mask = mask;
            }
        })
    };
    let narrower = mask
        .components()
        .all(|c| set(mask.without(WriteMask::component(c))));
    // Macros and texture instructions write no other components than those of their mask.
    let form = line.opcode().form(line.version).expect("it has one");
    let mut others = WriteMask::ALL.without(mask);
    if line.opcode() == Opcode::Bem {
        // It stands in the first phase, at whose end alpha is lost.
        others = others.without(WriteMask::W);
    }
    let wider = || {
        others
            .components()
            .all(|c| set(mask.or(WriteMask::component(c))))
    };
    narrower && (form.class == Class::Texture || form.rows > 0 || wider())
}

/// Where only some masks are allowed, each of every instruction; else each of every file that is written.
#[test]
fn every_write_mask() {
    let letters = ['x', 'y', 'z', 'w'];
    let of_opcode = |title: &str, mask: WriteMask| format!("{title}{}", mask.text(letters));
    let of_file = |version: Version, file: RegisterFile, mask: WriteMask| {
        format!("{version} {}#{}", file.row().prefix, mask.text(letters))
    };
    let mut wanted = Vec::new();
    for (version, opcode) in instruction_set() {
        let form = opcode.form(version).expect("it has one");
        let Some(shape) = form.destination.filter(|shape| {
            shape.written && form.class != Class::Declaration && opcode != Opcode::TexM3x2Depth
        }) else {
            continue;
        };
        // A pad leaves a row, not a register.
        let pad = matches!(opcode, Opcode::TexM3x2Pad | Opcode::TexM3x3Pad);
        // Where only one mask is allowed there is nothing to tell.
        if shape.masks != MaskSet::ANY && shape.masks != MaskSet::FULL && !pad {
            let masks = shape.masks.iter();
            wanted.extend(masks.map(|mask| of_opcode(&title(version, opcode), mask)));
        }
        // oPos is written whole, and in parts by the cases of `rules`; a0.x, oFog and oPts are single numbers.
        let files = [
            RegisterFile::Temp,
            RegisterFile::AttrOut,
            RegisterFile::TexCrdOut,
        ];
        for file in files.into_iter().filter(|file| shape.files.contains(*file)) {
            if shape.masks == MaskSet::ANY {
                wanted.extend(shape.masks.iter().map(|mask| of_file(version, file, mask)));
            }
        }
    }
    let mut list = Checklist::new("write masks", wanted);
    for line in lines() {
        let Some(destination) = line.instruction.destination else {
            continue;
        };
        let mut seen = None;
        let mut seen = || *seen.get_or_insert_with(|| mask_is_seen(&line));
        list.tick(&of_opcode(&line.title(), destination.mask), &mut seen);
        let file = destination.register.file;
        list.tick(&of_file(line.version, file, destination.mask), &mut seen);
    }
    list.finish();
}
