//! Vertex declarations.

use super::*;

/// The example of the specification, word by word, with one of everything else that there is.
const TOKENS: &str = "20000000 ; stream 0
    40020000                            ; register 0, type 2: three floats
    40020003                            ; register 3, three floats
    40040005                            ; register 5, type 4: a colour
    50010000                            ; four bytes left out
    40010007                            ; register 7, type 1: two floats
    00000000                            ; nothing
    2000000F                            ; stream 15
    4007000F                            ; register 15, type 7: four short integers
    30000000                            ; the tessellator
    60020003                            ; normals of register 0 (bits 23:20) to register 3
    60F20010                            ; normals of register 15 to register 16
    70010008                            ; surface parameters to register 8
    8200000A                            ; one constant (bits 28:25) from 10 on
    00000000 3F800000 7FC00001 80000000 ; 0, 1, a NaN, -0
    84000000                            ; two constants from 0 on
    3F000000 40000000 40400000 40800000 ; 0.5, 2, 3, 4
    40A00000 40C00000 40E00000 41000000 ; 5, 6, 7, 8
    A2000007 12345678 9ABCDEF0          ; an extension of two words (bits 28:24) with 7 in bits 23:0
    FFFFFFFF";

const TEXT: &str = "\
D3DVSD_STREAM(0),
D3DVSD_REG(D3DVSDE_POSITION, D3DVSDT_FLOAT3),
D3DVSD_REG(D3DVSDE_NORMAL, D3DVSDT_FLOAT3),
D3DVSD_REG(D3DVSDE_DIFFUSE, D3DVSDT_D3DCOLOR),
D3DVSD_SKIP(1),
D3DVSD_REG(D3DVSDE_TEXCOORD0, D3DVSDT_FLOAT2),
D3DVSD_NOP(),
D3DVSD_STREAM(15),
D3DVSD_REG(D3DVSDE_POSITION2, D3DVSDT_SHORT4),
D3DVSD_STREAM_TESS(),
D3DVSD_TESSNORMAL(D3DVSDE_POSITION, D3DVSDE_NORMAL),
D3DVSD_TESSNORMAL(D3DVSDE_POSITION2, D3DVSDE_NORMAL2),
D3DVSD_TESSUV(D3DVSDE_TEXCOORD1),
D3DVSD_CONST(10, 1),
    0x00000000, 0x3F800000, 0x7FC00001, 0x80000000, // c10 = 0.0, 1.0, NaN, -0.0
D3DVSD_CONST(0, 2),
    0x3F000000, 0x40000000, 0x40400000, 0x40800000, // c0 = 0.5, 2.0, 3.0, 4.0
    0x40A00000, 0x40C00000, 0x40E00000, 0x41000000, // c1 = 5.0, 6.0, 7.0, 8.0
D3DVSD_EXT(7, 2),
    0x12345678, 0x9ABCDEF0,
D3DVSD_END()
";

/// The words of a text.
#[track_caller]
fn read_words(text: &str) -> Vec<u32> {
    let mut sources = SourceMap::new();
    let input = read(&mut sources, "text", text.as_bytes())
        .unwrap()
        .unwrap();
    let [stream] = &input.streams[..] else {
        panic!("{input:?}");
    };
    assert_eq!(stream.fault, None);
    stream.words.clone()
}

#[test]
fn tokens_and_text() {
    let words = words(TOKENS);
    let (declaration, found) = Declaration::decode(&words);
    assert_eq!(found, []);
    assert_eq!(declaration.print(), TEXT);
    assert_eq!(declaration.encode().unwrap(), words);
    assert_eq!(read_words(TEXT), words);
    let spans: Vec<_> = declaration.elements.iter().map(|e| e.span).collect();
    // The first constant, of one token and four numbers, begins at token 13.
    assert_eq!((spans[13].start, spans[13].end), (13, 18));
}

/// As people write them: numbers for names, braces, other blanks, numbers for macros.
#[test]
fn other_spellings() {
    for text in [
        "{ D3DVSD_STREAM( 0 ),D3DVSD_REG(0,D3DVSDT_FLOAT3) , D3DVSD_END() };",
        "// a vertex\nD3DVSD_STREAM(0x0), /* here */ D3DVSD_REG( 0, 2 ),\n0xFFFFFFFF",
        "DWORD decl[] =\n{\n D3DVSD_STREAM(0), 1073872896, D3DVSD_END(),\n};",
    ] {
        assert_eq!(
            read_words(text),
            words("20000000 40020000 FFFFFFFF"),
            "{text}"
        );
    }
}

#[test]
fn types_and_meanings_have_their_numbers() {
    let types = [
        ("FLOAT1", 0, 4),
        ("FLOAT2", 1, 8),
        ("FLOAT3", 2, 12),
        ("FLOAT4", 3, 16),
        ("D3DCOLOR", 4, 4),
        ("UBYTE4", 5, 4),
        ("SHORT2", 6, 4),
        ("SHORT4", 7, 8),
    ];
    for (name, code, bytes) in types {
        let text = format!("D3DVSD_REG(0, D3DVSDT_{name}), D3DVSD_END()");
        let words = read_words(&text);
        assert_eq!(words[0], 0x4000_0000 | code << 16, "{name}");
        let (declaration, _) = Declaration::decode(&words);
        let ElementKind::Reg { data, .. } = declaration.elements[0].kind else {
            panic!("{declaration:?}");
        };
        assert_eq!(
            (data.name(), data.bytes()),
            (&*format!("D3DVSDT_{name}"), bytes)
        );
    }
    let registers = "POSITION BLENDWEIGHT BLENDINDICES NORMAL PSIZE DIFFUSE SPECULAR TEXCOORD0 TEXCOORD1 TEXCOORD2 \
                     TEXCOORD3 TEXCOORD4 TEXCOORD5 TEXCOORD6 TEXCOORD7 POSITION2 NORMAL2";
    for (number, name) in (0..).zip(registers.split_whitespace()) {
        let text = format!("D3DVSD_REG(D3DVSDE_{name}, D3DVSDT_FLOAT1), D3DVSD_END()");
        assert_eq!(read_words(&text)[0], 0x4000_0000 | number, "{name}");
    }
}

#[test]
fn broken_declarations() {
    for (tokens, expected) in [
        (
            "20000000 40020000",
            (
                "D1",
                2,
                "token 2 (byte 8): the declaration ends without D3DVSD_END, 0xFFFFFFFF",
            ),
        ),
        (
            "8400000A 00000000 00000000",
            (
                "D1",
                0,
                "token 0 (byte 0): the declaration ends in D3DVSD_CONST(10, 2), of which 2 of 8 words are there",
            ),
        ),
        (
            "20000000 40080000 FFFFFFFF",
            (
                "K19",
                1,
                "token 1 (byte 4): 0x40080000 is no token of a vertex declaration",
            ),
        ),
        (
            "20000010 FFFFFFFF",
            (
                "K19",
                0,
                "token 0 (byte 0): 0x20000010 is no token of a vertex declaration",
            ),
        ),
        (
            "20000000 C0000000 FFFFFFFF",
            (
                "K19",
                1,
                "token 1 (byte 4): 0xC0000000 is no token of a vertex declaration",
            ),
        ),
        (
            "20000000 82000080 FFFFFFFF",
            (
                "K19",
                1,
                "token 1 (byte 4): 0x82000080 is no token of a vertex declaration",
            ),
        ),
        (
            "20000000 FFFFFFFF 00000000",
            (
                "K3",
                2,
                "token 2 (byte 8): tokens behind D3DVSD_END: 1, which are not read",
            ),
        ),
    ] {
        let (_, found) = Declaration::decode(&words(tokens));
        assert_eq!(told(&found), [expected], "{tokens}");
    }
    let (_, found) = Declaration::decode(&vec![0; 1_000_000]);
    assert_eq!(told(&found)[0].0, "K13");
}

#[test]
fn rules_of_the_runtime() {
    let found = |text: &str| {
        let (declaration, found) = Declaration::decode(&read_words(text));
        assert_eq!(found, []);
        let found = declaration.check();
        let one = |d: Diagnostic| (d.rule.id, d.severity.name(), d.message);
        found.into_iter().map(one).collect::<Vec<_>>()
    };
    let row = |id, severity, message: &str| vec![(id, severity, message.to_string())];
    assert_eq!(
        found("D3DVSD_REG(15, 0), D3DVSD_CONST(95, 1), 0, 0, 0, 0, D3DVSD_END()"),
        []
    );
    assert_eq!(
        found("D3DVSD_REG(16, 0), D3DVSD_END()"),
        row("D2", "error", "a vertex shader has no register v16")
    );
    assert_eq!(
        found("D3DVSD_REG(4, 0), D3DVSD_REG(4, 1), D3DVSD_END()"),
        row("D3", "warning", "v4 is loaded a second time")
    );
    assert_eq!(
        found("D3DVSD_CONST(95, 2), 0, 0, 0, 0, 0, 0, 0, 0, D3DVSD_END()"),
        row("D4", "error", "c96 is above c95")
    );
    assert_eq!(
        found("D3DVSD_CONST(9, 0), D3DVSD_END()"),
        row("D4", "error", "no constant is loaded")
    );
}

#[test]
fn numbers_that_do_not_fit_are_refused() {
    let element = |kind| Declaration {
        elements: vec![Element {
            kind,
            span: Default::default(),
        }],
    };
    let message = |kind| element(kind).encode().unwrap_err()[0].message.clone();
    let expected = "the first number of D3DVSD_STREAM(16) is at most 15";
    assert_eq!(message(ElementKind::Stream(16)), expected);
    let values = vec![[0.0; 4]; 16];
    let expected = "the second number of D3DVSD_CONST(0, 16) is at most 15";
    assert_eq!(message(ElementKind::Const { address: 0, values }), expected);
}

/// What D5 says of one element each: the table of registers of the specification, and that normals are three floats.
#[test]
fn fixed_function() {
    for (element, expected) in [
        ("D3DVSD_REG(0, D3DVSDT_FLOAT3)", None),
        ("D3DVSD_REG(3, D3DVSDT_FLOAT3)", None),
        (
            "D3DVSD_REG(3, D3DVSDT_FLOAT4)",
            Some("D3DVSDE_NORMAL is loaded as D3DVSDT_FLOAT4"),
        ),
        ("D3DVSD_REG(15, D3DVSDT_FLOAT3)", None),
        (
            "D3DVSD_REG(16, D3DVSDT_FLOAT3)",
            Some("D3DVSDE_NORMAL2 is loaded from a stream"),
        ),
        (
            "D3DVSD_REG(17, D3DVSDT_FLOAT3)",
            Some("register 17 has no fixed meaning"),
        ),
        ("D3DVSD_TESSNORMAL(0, 3)", None),
        ("D3DVSD_TESSNORMAL(15, 16)", None),
        (
            "D3DVSD_TESSNORMAL(7, 3)",
            Some("normals are made of D3DVSDE_TEXCOORD0"),
        ),
        (
            "D3DVSD_TESSNORMAL(0, 5)",
            Some("normals go to D3DVSDE_DIFFUSE"),
        ),
        ("D3DVSD_TESSUV(14)", None),
        (
            "D3DVSD_TESSUV(6)",
            Some("surface parameters go to D3DVSDE_SPECULAR"),
        ),
    ] {
        let words = read_words(&format!("D3DVSD_STREAM(0), {element}, D3DVSD_END()"));
        let (declaration, found) = Declaration::decode(&words);
        assert_eq!(found, []);
        let found = declaration.check_fixed_function();
        let told: Vec<_> = told(&found);
        let expected: Vec<_> = expected
            .map(|message| ("D5", 1, message))
            .into_iter()
            .collect();
        assert_eq!(told, expected, "{element}");
    }
}

/// `def`s of a vertex shader as elements, worked out by hand: 0.5 is 0x3F000000, 1 is 0x3F800000, 2 is 0x40000000.
#[test]
fn constants_of_a_vertex_shader() {
    let listing = "vs.1.1\ndef c4, 0, 0.5, 1, 2\n;@comment 00000001\ndef c5, 1, 1, 1, 1\nmov oPos, v0\n\
                   def c9, 2, 0, 0, 0\ndef c8, 0, 0, 0, 0\n;@comment 00000002\n";
    let mut shader = program(listing);
    let declaration = take_constants(&mut shader).unwrap();
    let fragment = declaration.encode_fragment().unwrap();
    assert_eq!(
        fragment,
        words(
            "84000004 00000000 3F000000 3F800000 40000000 3F800000 3F800000 3F800000 3F800000
             82000009 40000000 00000000 00000000 00000000
             82000008 00000000 00000000 00000000 00000000"
        )
    );
    assert_eq!(
        encode(&shader).unwrap(),
        words("FFFE0101 0001FFFE 00000001 00000001 C00F0000 90E40000 0001FFFE 00000002 FFFF")
    );
    // A piece is no declaration, but can be read as one.
    assert_eq!(told(&Declaration::decode(&fragment).1)[0].0, "D1");
    let (again, found) = Declaration::decode_fragment(&fragment);
    assert_eq!(found, []);
    assert_eq!(read_words(&again.print_fragment()), fragment);
    put_constants(&mut shader, &again);
    assert_eq!(
        syntax::print(&shader),
        "vs.1.1\n;@comment 00000001\ndef c4, 0, 0.5, 1, 2\ndef c5, 1, 1, 1, 1\ndef c9, 2, 0, 0, 0\ndef c8, 0, 0, 0, 0\n\
         mov oPos, v0\n;@comment 00000002\n"
    );
}

/// Fifteen is the most that four bits count.
#[test]
fn many_constants_are_several_elements() {
    let defs: String = (0..17)
        .map(|at| format!("def c{at}, 1, 1, 1, 1\n"))
        .collect();
    let mut shader = program(&format!("vs.1.1\n{defs}mov oPos, v0\n"));
    let declaration = take_constants(&mut shader).unwrap();
    let fragment = declaration.encode_fragment().unwrap();
    // The first of 15 constants from 0, then 2 from 15.
    assert_eq!((fragment[0], fragment[61]), (0x9E00_0000, 0x8400_000F));
    assert_eq!(fragment.len(), 2 + 17 * 4);
}

#[test]
fn constants_that_have_no_element() {
    let mut shader = program("vs.1.1\ndef c128, 1, 1, 1, 1\nmov oPos, v0\n");
    let found = take_constants(&mut shader).unwrap_err();
    assert_eq!(told(&found), [("K18", 11, "D3DVSD_CONST cannot load c128")]);
    assert_eq!(shader.definitions().count(), 1);
    // Those of a pixel shader stay.
    let mut shader = program("ps.1.1\ndef c0, 1, 1, 1, 1\nmov r0, c0\n");
    assert_eq!(take_constants(&mut shader), Ok(Declaration::default()));
    assert_eq!(shader.definitions().count(), 1);
}
