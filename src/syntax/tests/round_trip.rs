//! What is printed reads back.

use super::*;
use crate::diagnostic::Span;
use crate::isa::modifier::SHIFTS;
use crate::isa::{
    Opcode, RegisterFile, ResultModifier, ShaderKind, SourceModifier, Swizzle, Version, WriteMask,
};
use crate::program::{Dcl, Def, Destination, Register, Source, Statement, Usage};
use crate::syntax::{print, print_instruction};
use proptest::prelude::*;

const HERE: Span = Span::new(0, 0);

fn registers() -> impl Strategy<Value = Register> {
    let files: Vec<_> = RegisterFile::all().collect();
    let one = (proptest::sample::select(files), 0..100_u32, any::<bool>());
    one.prop_map(|(file, index, relative)| match file {
        RegisterFile::RastOut => Register::new(file, index % 3),
        RegisterFile::Const => Register {
            file,
            index,
            relative,
        },
        _ => Register::new(file, index),
    })
}

fn sources(kind: ShaderKind) -> impl Strategy<Value = Source> {
    let modifiers: Vec<_> = SourceModifier::all()
        .filter(|m| {
            kind == ShaderKind::Pixel || m.row().suffix.is_empty() && m.row().prefix != "1-"
        })
        .collect();
    let modifiers = proptest::sample::select(modifiers);
    (registers(), any::<u8>(), modifiers).prop_map(|(register, swizzle, modifier)| Source {
        register,
        swizzle: Swizzle::from_byte(swizzle),
        modifier,
        span: HERE,
    })
}

fn masks() -> impl Strategy<Value = WriteMask> {
    (1_u8..16).prop_map(WriteMask::from_bits)
}

fn results(kind: ShaderKind, opcode: Opcode) -> BoxedStrategy<ResultModifier> {
    if kind == ShaderKind::Vertex || matches!(opcode, Opcode::Nop | Opcode::Phase) {
        return Just(ResultModifier::NONE).boxed();
    }
    let shifts: Vec<_> = SHIFTS.iter().map(|row| row.shift).chain([0]).collect();
    (proptest::sample::select(shifts), any::<bool>())
        .prop_map(|(shift, saturate)| ResultModifier { shift, saturate })
        .boxed()
}

fn instructions(kind: ShaderKind) -> impl Strategy<Value = Statement> {
    let opcodes: Vec<_> = Opcode::all()
        .filter(|op| !matches!(op, Opcode::Def | Opcode::Dcl))
        .collect();
    proptest::sample::select(opcodes).prop_flat_map(move |opcode| {
        let form = &opcode.row().forms[0];
        let count = form.sources.len();
        let has_destination = form.destination.is_some();
        (
            results(kind, opcode),
            any::<bool>(),
            (registers(), masks()),
            proptest::collection::vec(sources(kind), count),
        )
            .prop_map(move |(result, co_issue, (register, mask), sources)| {
                Statement::Instruction(Instruction {
                    opcode,
                    co_issue,
                    result,
                    destination: has_destination.then_some(Destination {
                        register,
                        mask,
                        span: HERE,
                    }),
                    sources,
                    span: HERE,
                    mnemonic_span: HERE,
                })
            })
    })
}

fn statements(kind: ShaderKind) -> impl Strategy<Value = Statement> {
    let number = any::<f32>().prop_filter("a NaN is not equal to itself", |v| !v.is_nan());
    let defs = (
        registers(),
        proptest::array::uniform4(number),
        any::<bool>(),
    );
    let defs = defs.prop_map(|(register, value, co_issue)| {
        Statement::Def(Def {
            register,
            value,
            co_issue,
            span: HERE,
            register_span: HERE,
        })
    });
    let usages: Vec<_> = Usage::all().map(|(usage, _)| usage).collect();
    let dcls = (
        proptest::sample::select(usages),
        0_u8..16,
        registers(),
        masks(),
    );
    let dcls = dcls.prop_map(|(usage, usage_index, register, mask)| {
        Statement::Dcl(Dcl {
            usage,
            usage_index,
            register,
            mask,
            span: HERE,
        })
    });
    prop_oneof![8 => instructions(kind), 1 => defs, 1 => dcls]
}

fn programs() -> impl Strategy<Value = Program> {
    let versions: Vec<_> = Version::all().collect();
    proptest::sample::select(versions).prop_flat_map(|version| {
        proptest::collection::vec(statements(version.kind()), 0..20).prop_map(move |statements| {
            Program {
                version,
                version_span: HERE,
                statements,
                comments: Vec::new(),
                span: HERE,
            }
        })
    })
}

/// The same shader with every span empty.
fn without_spans(mut program: Program) -> Program {
    program.version_span = HERE;
    program.span = HERE;
    for statement in &mut program.statements {
        match statement {
            Statement::Instruction(i) => {
                (i.span, i.mnemonic_span) = (HERE, HERE);
                i.destination.iter_mut().for_each(|d| d.span = HERE);
                i.sources.iter_mut().for_each(|s| s.span = HERE);
            }
            Statement::Def(d) => (d.span, d.register_span) = (HERE, HERE),
            Statement::Dcl(d) => d.span = HERE,
        }
    }
    program
}

proptest! {
    #[test]
    fn what_is_printed_reads_back(program in programs()) {
        let text = print(&program);
        let parsed = read(&text).1;
        prop_assert_eq!(&parsed.diagnostics, &[], "{}", text);
        prop_assert_eq!(without_spans(parsed.program.unwrap()), program);
    }
}

#[test]
fn the_canonical_form() {
    let text = "PS_1_4 DEF c0, 0.9f, 1e-9, 0.50, -0.0 MUL_SAT_X2 r0.xyz, 1 - r1.wwww, c [ 0 ].yzzz \
                +MOV r0.a, -r2_bx2.xyzw texld r1, t0_da.rga phase nop";
    let printed = "ps.1.4\n\
                   def c0, 0.9, 1e-9, 0.5, -0\n\
                   mul_x2_sat r0.rgb, 1-r1.a, c0.gb\n\
                   +mov r0.a, -r2_bx2\n\
                   texld r1, t0_dw.rga\n\
                   phase\n\
                   nop\n";
    assert_eq!(print(&accepted(text)), printed);
    let text =
        "vs_1_1 dcl_texcoord0 v7 dcl_color1 v6.xy m4x4 OPOS, v0, c[12] mov r0.rg, -c12[a0.x + 1].r";
    let printed = "vs.1.1\n\
                   dcl_texcoord v7\n\
                   dcl_color1 v6.xy\n\
                   m4x4 oPos, v0, c12\n\
                   mov r0.xy, -c[a0.x + 13].x\n";
    assert_eq!(print(&accepted(text)), printed);
    let i = only("ps.1.1\n+add_d2 r0.a, r1, v0");
    assert_eq!(
        print_instruction(&i, ShaderKind::Pixel),
        "+add_d2 r0.a, r1, v0"
    );
}
