//! Whole listings, programs that no text can say, and programs that nobody would write.

use super::program;
use crate::diagnostic::{Severity, SourceMap, Span};
use crate::isa::{
    Opcode, RegisterFile, ResultModifier, SourceModifier, Swizzle, Version, WriteMask,
};
use crate::policy::Dialect;
use crate::program::{Def, Destination, Instruction, Program, Register, Source, Statement};
use crate::validate::{statistics, validate, validate_around};

const PIXEL: &str = include_str!("../../../asm/stained_glass/stained_glass.psh");
const VERTEX: &str = include_str!("../../../asm/stained_glass/stained_glass.vsh");

#[test]
fn the_pixel_listing_of_the_article_is_accepted_without_a_word() {
    for dialect in Dialect::all() {
        assert_eq!(validate(&program(PIXEL), dialect), []);
    }
}

#[test]
fn the_vertex_listing_of_the_article_departs_in_three_places() {
    let mut map = SourceMap::new();
    let file = map.add("stained_glass.vsh", VERTEX).unwrap();
    let program = crate::syntax::parse(file).program.unwrap();
    let found = validate(&program, Dialect::D3d8);
    assert!(found.iter().all(|d| d.severity == Severity::Warning));
    let said: Vec<_> = found
        .iter()
        .map(|d| (d.rule.id, map.text(d.span).into_owned()))
        .collect();
    // Two m3x3 without their mask; then all of r0 is read, of which m3x3 wrote xyz only.
    let want = [("O19", "r9"), ("O19", "r0"), ("I1", "r0")];
    assert_eq!(said, want.map(|(id, text)| (id, text.to_string())));
    assert!(found[2].message.starts_with("r0.w"));
}

#[test]
fn what_follows_from_damage_is_not_told() {
    // The third line is damaged: it wrote r0.rgb, the first half of the pair.
    let text = "ps.1.1\ntex t0\n??? r0.rgb, t0, v0\n+mov r0.a, t0\nmul r0, r0, t1\n";
    let mut map = SourceMap::new();
    let readable = text.replace("??? r0.rgb, t0, v0", "                  ");
    let program = crate::syntax::parse(map.add("listing", readable).unwrap());
    let program = program.program.unwrap();
    let at = text.find("???").unwrap() as u32;
    let damage = Span::new(at, at + 18);
    let ids = |unread: &[(Span, Option<Register>)]| {
        let found = validate_around(&program, Dialect::D3d8, unread);
        found.iter().map(|d| d.rule.id).collect::<Vec<_>>()
    };
    assert_eq!(ids(&[]), ["C2", "I1", "I4"]);
    let r0 = Register::new(RegisterFile::Temp, 0);
    assert_eq!(ids(&[(damage, Some(r0))]), ["I4"]);
    // Nobody knows what it wrote.
    assert_eq!(ids(&[(damage, None)]), [""; 0]);
}

fn instruction(
    opcode: Opcode,
    destination: Option<Destination>,
    sources: Vec<Source>,
) -> Instruction {
    Instruction {
        opcode,
        co_issue: false,
        result: ResultModifier::NONE,
        destination,
        sources,
        span: Span::new(10, 20),
        mnemonic_span: Span::new(10, 13),
    }
}

fn destination(file: RegisterFile, index: u32) -> Destination {
    Destination {
        register: Register::new(file, index),
        mask: WriteMask::ALL,
        span: Span::new(14, 16),
    }
}

fn source(file: RegisterFile, index: u32) -> Source {
    Source {
        register: Register::new(file, index),
        swizzle: Swizzle::IDENTITY,
        modifier: SourceModifier::None,
        span: Span::new(18, 20),
    }
}

/// `mov oPos, v0` and these instructions.
fn vertex_shader(instructions: Vec<Instruction>) -> Program {
    let position = instruction(
        Opcode::Mov,
        Some(destination(RegisterFile::RastOut, 0)),
        vec![source(RegisterFile::Input, 0)],
    );
    let all = std::iter::once(position).chain(instructions);
    Program {
        version: Version::Vs11,
        version_span: Span::new(0, 6),
        statements: all.map(Statement::Instruction).collect(),
        comments: Vec::new(),
        span: Span::new(0, 20),
    }
}

fn judged(program: &Program) -> Vec<(&'static str, Span)> {
    let found = validate(program, Dialect::D3d8);
    found.iter().map(|d| (d.rule.id, d.span)).collect()
}

#[test]
fn only_constants_are_relative() {
    // O6: mov r0, v[a0.x]
    let mut relative = source(RegisterFile::Input, 0);
    relative.register.relative = true;
    let to_r0 = Some(destination(RegisterFile::Temp, 0));
    let mut address = destination(RegisterFile::Addr, 0);
    address.mask = WriteMask::X;
    let load = instruction(
        Opcode::Mov,
        Some(address),
        vec![source(RegisterFile::Input, 0)],
    );
    let read = instruction(Opcode::Mov, to_r0, vec![relative]);
    let shader = vertex_shader(vec![load.clone(), read]);
    assert_eq!(judged(&shader), [("O6", Span::new(18, 20))]);
    // mov r[a0.x], v0
    let mut to = destination(RegisterFile::Temp, 0);
    to.register.relative = true;
    let write = instruction(Opcode::Mov, Some(to), vec![source(RegisterFile::Input, 0)]);
    let shader = vertex_shader(vec![load, write]);
    assert_eq!(judged(&shader), [("O6", Span::new(14, 16))]);
}

#[test]
fn vertex_shaders_have_no_modifiers_of_pixel_shaders() {
    // O23: mov_x2_sat r0, v0 and mov r0, 1-v0
    let to_r0 = Some(destination(RegisterFile::Temp, 0));
    let mut saturated = instruction(Opcode::Mov, to_r0, vec![source(RegisterFile::Input, 0)]);
    saturated.result = ResultModifier {
        shift: 1,
        saturate: true,
    };
    let shader = vertex_shader(vec![saturated]);
    assert_eq!(judged(&shader), [("O23", Span::new(10, 13))]);
    let message = &validate(&shader, Dialect::D3d8)[0].message;
    assert_eq!(message, "vs.1.1 has no _x2_sat");
    let mut complement = source(RegisterFile::Input, 0);
    complement.modifier = SourceModifier::Complement;
    let shader = vertex_shader(vec![instruction(Opcode::Mov, to_r0, vec![complement])]);
    assert_eq!(judged(&shader), [("O23", Span::new(18, 20))]);
}

#[test]
fn a_definition_is_no_half_of_a_pair() {
    let shader = Program {
        version: Version::Ps11,
        version_span: Span::new(0, 6),
        comments: Vec::new(),
        statements: vec![
            Statement::Def(Def {
                register: Register::new(RegisterFile::Const, 0),
                value: [0.0; 4],
                co_issue: true,
                span: Span::new(7, 9),
                register_span: Span::new(8, 9),
            }),
            Statement::Instruction(instruction(
                Opcode::Mov,
                Some(destination(RegisterFile::Temp, 0)),
                vec![source(RegisterFile::Const, 0)],
            )),
        ],
        span: Span::new(0, 20),
    };
    assert_eq!(judged(&shader), [("C7", Span::new(7, 9))]);
}

#[test]
fn nothing_that_can_be_built_brings_the_validator_down() {
    // Every opcode in every version with operands from every file, far numbers, too few and too many sources.
    for version in Version::all() {
        let mut statements = Vec::new();
        for opcode in Opcode::all() {
            for (i, file) in RegisterFile::all().enumerate() {
                for index in [0, 5, 4096, u32::MAX] {
                    let mut from = source(file, index);
                    from.register.relative = i % 2 == 1;
                    from.modifier = SourceModifier::from_code((index % 11) as u8).unwrap();
                    let sources = vec![from; i % 5];
                    let mut line = instruction(opcode, Some(destination(file, index)), sources);
                    line.co_issue = i % 3 == 1;
                    line.result.shift = i8::MIN;
                    statements.push(Statement::Instruction(line.clone()));
                    line.destination = None;
                    statements.push(Statement::Instruction(line));
                }
            }
        }
        let shader = Program {
            version,
            version_span: Span::default(),
            statements,
            comments: Vec::new(),
            span: Span::default(),
        };
        for dialect in Dialect::all() {
            assert!(!validate(&shader, dialect).is_empty());
        }
        assert_eq!(statistics(&shader).version, version);
    }
}

#[test]
fn a_rule_that_is_broken_everywhere_is_told_a_hundred_times() {
    let text = format!("ps.1.1\n{}", "mov c0, v0\n".repeat(50_000));
    let found = validate(&program(&text), Dialect::D3d8);
    let of = |id| found.iter().filter(|d| d.rule.id == id).count();
    assert_eq!((of("O2"), of("B3"), found.len()), (100, 1, 101));
}

fn stages(statistics: &crate::validate::Statistics) -> Vec<u32> {
    statistics.stages.iter().map(|s| s.stage).collect()
}

#[test]
fn statistics_count_slots_registers_and_stages() {
    let pixel = statistics(&program(PIXEL));
    let slots: Vec<_> = pixel
        .phases
        .iter()
        .map(|p| {
            (
                p.arithmetic.used,
                p.arithmetic.allowed,
                p.texture.used,
                p.texture.allowed,
            )
        })
        .collect();
    // Counted by hand: 6 texture and 5 arithmetic instructions, phase, 4 texture instructions, mul and one pair.
    assert_eq!(slots, [(5, 8, 6, 6), (2, 8, 4, 6)]);
    // Samples r0 before and r2 to r5 after phase.
    assert_eq!(stages(&pixel), [0, 2, 3, 4, 5]);
    assert_eq!(pixel.coordinate_sets, [0, 1, 2, 3, 4, 5]);
    let numbers = |s: &crate::validate::Statistics, file| {
        let usage = s.files.iter().find(|f| f.file == file).unwrap();
        usage.numbers.clone()
    };
    assert_eq!(numbers(&pixel, RegisterFile::Const), [0]);
    assert_eq!(numbers(&pixel, RegisterFile::Temp), [0, 1, 2, 3, 4, 5]);

    let vertex = statistics(&program(VERTEX));
    // m4x4 4, mov, add, m3x3 3, dp3, rsq, mul, nine dp3, m3x3 3, mul.
    let used = 4 + 1 + 1 + 3 + 1 + 1 + 1 + 9 + 3 + 1;
    assert_eq!(vertex.phases.len(), 1);
    assert_eq!(vertex.phases[0].arithmetic.used, used);
    assert_eq!(vertex.phases[0].arithmetic.allowed, 128);
    // Rows of the matrices: c12 to c14, c16 to c19, c20 to c22; then c28 and c94.
    let constants = [12, 13, 14, 16, 17, 18, 19, 20, 21, 22, 28, 94];
    assert_eq!(numbers(&vertex, RegisterFile::Const), constants);
    assert_eq!(numbers(&vertex, RegisterFile::Input), [0, 3, 7, 8, 9]);
    assert_eq!(
        numbers(&vertex, RegisterFile::TexCrdOut),
        [0, 1, 2, 3, 4, 5]
    );
    assert!(!vertex.relative);

    // Stages of the old versions are those of the destinations; texreg2ar reads no coordinates of its own.
    let old = "ps.1.1\ntex t0\ntexreg2ar t1, t0\ntexcoord t2\nmov r0, t1";
    let old = statistics(&program(old));
    assert_eq!(
        (stages(&old), old.coordinate_sets),
        (vec![0, 1], vec![0, 2])
    );
    let relative = statistics(&program("vs.1.1\nmov a0.x, v0\nmov oPos, c[a0.x]"));
    assert!(relative.relative);
}
