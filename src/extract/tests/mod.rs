//! Shaders in files of other languages. Names and places were worked out by hand.

use super::*;
use crate::policy::Dialect;
use std::collections::BTreeMap;

fn opened(text: &str) -> (SourceMap, File) {
    let mut sources = SourceMap::new();
    sources.add("before", "ps.1.4\n").unwrap();
    let file = open(
        &mut sources,
        "host",
        text.into(),
        &preprocess::Options::default(),
    )
    .unwrap();
    (sources, file)
}

/// Rule, line and column of everything that is said of all shaders.
fn told(text: &str) -> Vec<(&'static str, usize, usize)> {
    let (mut sources, file) = opened(text);
    let mut all = file.diagnostics.clone();
    for shader in &file.shaders {
        all.extend(
            check(&mut sources, shader, &listing::Options::default())
                .unwrap()
                .diagnostics,
        );
    }
    let place = |d: &Diagnostic| {
        let at = sources.locate(d.span).unwrap();
        assert_eq!(at.file, "host");
        (d.rule.id, at.line, at.column)
    };
    all.iter().map(place).collect()
}

fn listing_of(sources: &SourceMap, shader: &Shader) -> String {
    match &shader.text {
        Text::Listing { text, .. } => sources.text(*text).into_owned(),
        Text::Tokens(stream) => format!("{:08X?}", stream.words),
    }
}

const EFFECT: &str = "\
texture Base < string name = \"base.dds\"; >;
vertexshader Shared < string what = \"shared\"; > = decl
{
    stream 0;
    float v0[3];
} asm
{
    vs.1.1
    ; a brace in a comment }
    mov oPos, v0
    mov oD0, c[CV_ONE]
};
technique Water < int i = 1; >
{
    pass P0
    {
        VertexShader = asm { vs.1.1
            mov oPos, v0 };
        PixelShader = asm
        {
            ps.1.1
            mov r0, v9
        };
    }
    pass { PixelShader = asm { ps.1.1
        mov r0, v0 }; }
}
technique { pass Only { PixelShader = asm { ps.1.1
 add r0, v0 }; } }
";

#[test]
fn blocks_of_an_effect() {
    let (sources, file) = opened(&EFFECT.replace("CV_ONE", "4"));
    assert_eq!(file.form, Form::Effect);
    let names = [
        "Shared",
        "Water/P0/VertexShader",
        "Water/P0/PixelShader",
        "Water/2/PixelShader",
        "2/Only/PixelShader",
    ];
    assert_eq!(file.names(), names);
    assert_eq!(
        listing_of(&sources, &file.shaders[1]),
        " vs.1.1\n            mov oPos, v0 "
    );
    assert_eq!(
        told(&EFFECT.replace("CV_ONE", "4")),
        [("O1", 22, 21), ("P10", 29, 2)]
    );
    for (wanted, found) in [
        ("Shared", vec![0]),
        ("2", vec![1]),
        ("Water", vec![1, 2, 3]),
        ("Water/P0", vec![1, 2]),
        ("water/p0/pixelshader", vec![2]),
        ("6", vec![]),
        ("0", vec![]),
        ("W", vec![]),
    ] {
        assert_eq!(file.find(wanted), found, "{wanted}");
    }
}

#[test]
fn an_effect_is_preprocessed_as_a_whole() {
    let text = format!("#define CV_ONE 4\n#if 0\n{EFFECT}#endif\n#if 1\n{EFFECT}#endif\n");
    let (mut sources, file) = opened(&text);
    assert_eq!((file.shaders.len(), file.diagnostics.len()), (5, 0));
    let checked = check(&mut sources, &file.shaders[0], &listing::Options::default()).unwrap();
    let program = checked.accepted().unwrap();
    let last = program.instructions().last().unwrap();
    assert_eq!(last.sources[0].register.index, 4);
    // The second copy begins in line 34.
    assert_eq!(sources.locate(last.span).unwrap().line, 34 + 10);
    // Without the macro there is one error, at its name: line 11, behind `    mov oD0, c[`.
    let found = told(EFFECT);
    assert!(found.contains(&("P16", 11, 15)), "{found:?}");
    // If a file is missing, which may define it, there is only a warning.
    let found = told(&format!("#include \"consts.h\"\n{EFFECT}"));
    assert_eq!(
        found,
        [
            ("P28", 1, 10),
            ("P33", 12, 5),
            ("O1", 23, 21),
            ("P10", 30, 2)
        ]
    );
}

#[test]
fn strings_of_c() {
    let text = "#include <d3d8.h>\n\
        // \"ps.1.1 in a comment\"\n\
        const char *profile = \"vs_1_1\", c = '\"';\n\
        static const char g_PS[] =\n\
        \x20   \"ps.1.1 // my \\\"shader\\\"\\n\"\n\
        \x20   \"tex t0\\n\"   /* sample */\n\
        \x20   \"mul r0, t0, v9\\n\";\n\
        const char* all[] = { \"ps.1.1\\nmov r0, v0\\n\", \"\", \"vs.1.1\\r\\n\\tmov oPos, v0\\n\" \"mov oD0, \\x63\\060\" };\n\
        int x = 5; void f() { g(\"  ; x\\n ps.1.1\\n mov r0, vl\\n\"); }\n\
        auto raw = R\"x(ps.1.1\nmov r0, \"\n)x\";\n\
        const char *k = \"vs.1.1\\n\\\n    mov oPos, r12\\n\";\n";
    let (sources, file) = opened(text);
    assert_eq!(file.form, Form::Source);
    assert_eq!(file.names(), ["g_PS", "all[0]", "all[2]", "4", "raw", "k"]);
    assert_eq!(file.find("all"), [1, 2]);
    assert_eq!(
        listing_of(&sources, &file.shaders[0]),
        "ps.1.1 // my \"shader\"\ntex t0\nmul r0, t0, v9\n"
    );
    assert_eq!(
        listing_of(&sources, &file.shaders[2]),
        "vs.1.1\r\n\tmov oPos, v0\nmov oD0, c0"
    );
    let found = told(text);
    // v9 behind `    "mul r0, t0, `; vl behind `int x = 5; void f() { g("  ; x\n ps.1.1\n mov r0, `; the quote in the raw
    // string; r12 in the continued line. oPos is written from what is never set (no error of its own line).
    for expected in [("O1", 7, 18), ("P13", 9, 51), ("O1", 14, 15)] {
        assert!(found.contains(&expected), "{expected:?} in {found:?}");
    }
    assert!(
        found.iter().any(|f| f.1 == 11 && f.0.starts_with('P')),
        "{found:?}"
    );
}

#[test]
fn repairs_in_strings() {
    let text = "const char *s = \"ps.1.1\\n\\tmov r0, vl\\n\";\n";
    let (mut sources, file) = opened(text);
    let found = check(&mut sources, &file.shaders[0], &listing::Options::default()).unwrap();
    let host = sources.file_of(file.span.start).unwrap();
    let (fixed, count) = syntax::apply_fixes(&sources, host, &found.diagnostics);
    assert_eq!(
        (String::from_utf8(fixed).unwrap(), count),
        (text.replace("vl", "v1"), 1)
    );
}

#[test]
fn arrays_and_strings_in_one_file() {
    let text = "DWORD dwPS[] = { 0xffff0101, 0x00000001, 0x800f0000, 0x90e40000, 0x0000ffff };\n\
        const char *s = \"ps.1.1\\nmov r0, v1\\n\";\n";
    let (mut sources, file) = opened(text);
    assert_eq!(
        (file.form, file.names()),
        (Form::Source, vec!["dwPS".to_string(), "s".to_string()])
    );
    for (shader, index) in file.shaders.iter().zip([0, 1]) {
        let checked = check(&mut sources, shader, &listing::Options::default()).unwrap();
        let program = checked.accepted().unwrap();
        assert_eq!(
            program.instructions().next().unwrap().sources[0]
                .register
                .index,
            index
        );
    }
}

#[test]
fn what_a_file_is() {
    let form = |text: &str| opened(text).1.form;
    for listing in [
        "ps.1.1\nmov r0, v0 ; asm { ps.1.1 mov r0, v0 }",
        "; \"ps.1.1\\n mov\"\n#define A 1\nps.1.1\nmov r0, v0",
        "",
        "mov r0, v0",
        "p5.1.1\nmov r0, v0",
        "char *profile = \"ps_1_1\";",
    ] {
        assert_eq!(form(listing), Form::Listing, "{listing}");
    }
    assert_eq!(form("int main() { asm { mov eax, 1 } }"), Form::Source);
    assert_eq!(form("x = asm { mov r0, v0 }"), Form::Effect);
    assert_eq!(form("asm { ; x\n ps.1.1 mov r0, v0 }"), Form::Effect);
    assert_eq!(form("ffff0101 0000ffff"), Form::Tokens(bytecode::Form::Hex));
    let binary = File {
        ..open(
            &mut SourceMap::new(),
            "b",
            [1, 1, 0xFF, 0xFF, 0xFF, 0xFF, 0, 0].to_vec(),
            &preprocess::Options::default(),
        )
        .unwrap()
    };
    assert_eq!(binary.form, Form::Tokens(bytecode::Form::Binary));
}

#[test]
fn shaders_of_the_same_name_are_told_apart() {
    let text = "a = asm { ps.1.1 mov r0, v0 }; a = asm { ps.1.1 mov r0, v1 };";
    assert_eq!(opened(text).1.names(), ["a", "a#2"]);
}

/// Included files and definitions reach listings of all kinds; d3d9 judges them all.
#[test]
fn options_reach_every_shader() {
    let files: BTreeMap<String, Vec<u8>> = [("c.h".to_string(), b"#define C c2\n".to_vec())].into();
    let definitions = ["OUT=r0".parse().unwrap()];
    let preprocess = preprocess::Options {
        definitions: &definitions,
        resolver: &files,
    };
    for text in [
        "#include \"c.h\"\nps.1.1\nmov OUT, C\n",
        "#include \"c.h\"\nx = asm { ps.1.1 mov OUT, C };",
        "char *s = \"#include \\\"c.h\\\"\\nps.1.1\\nmov OUT, C\\n\";",
    ] {
        let mut sources = SourceMap::new();
        let file = open(&mut sources, "host", text.into(), &preprocess).unwrap();
        let options = listing::Options {
            dialect: Dialect::D3d9,
            preprocess,
            ..Default::default()
        };
        let checked = check(&mut sources, &file.shaders[0], &options).unwrap();
        let program = checked.accepted().expect(text);
        assert_eq!(
            program.instructions().next().unwrap().sources[0]
                .register
                .index,
            2
        );
    }
}

proptest::proptest! {
    /// No file may panic or hang, whatever its braces and quotes do.
    #[test]
    fn soups(words in proptest::collection::vec(0..WORDS.len(), 0..80)) {
        let text: String = words.iter().map(|w| WORDS[*w]).collect();
        let (mut sources, file) = opened(&text);
        for shader in &file.shaders {
            let checked = check(&mut sources, shader, &listing::Options::default()).unwrap();
            for d in &checked.diagnostics {
                assert!(sources.locate(d.span).is_some());
                sources.notes(d.span);
            }
        }
        file.find("1");
    }
}

const WORDS: [&str; 30] = [
    "asm",
    " { ",
    " } ",
    "ps.1.1\n",
    "vs.1.1 ",
    "mov r0, v0\n",
    "\"",
    "\"ps.1.1\\n mov r0, v0\"",
    "technique ",
    "pass ",
    "T",
    " = ",
    ";",
    "<",
    ">",
    "[",
    "]",
    "'",
    "\\",
    "\\x4",
    "\n",
    "#define A B\n",
    "#if 0\n",
    "#endif\n",
    "//",
    "/*",
    "*/",
    "R\"(",
    ")\"",
    "x[] = {0xffff0101, 0x0000ffff};",
];

#[test]
fn strings_that_lines_are_continued_between() {
    let text = "const char Shader[] =\n\t\"; first a comment\\n\"\\\n\t\"\\n\" \\\n\t// between\n\t\"ps.1.1\\n\"\\\n\"mov r0, v9\\n\";\n";
    let (sources, file) = opened(text);
    assert_eq!(file.names(), ["Shader"]);
    assert_eq!(
        listing_of(&sources, &file.shaders[0]),
        "; first a comment\n\nps.1.1\nmov r0, v9\n"
    );
    assert_eq!(told(text), [("O1", 6, 10)]);
}

#[test]
fn strings_that_only_name_versions() {
    let text = "\
        Compile(\"vs_1_1\", \"ps_1_4\\n\");\n\
        set(\"profiles\", \"vs_1_1 arbvp1 glslv\");\n\
        test(\"PS_1_4 with two of them\");\n\
        names = { \"vs_out[10]\", \"ps_1_0 and up\\n\" };\n\
        real = \"ps.1.1 mov r0, v0\";\n\
        begun = \"ps.1.1\\nmovv r0, v0\";\n";
    let (_, file) = opened(text);
    assert_eq!(file.names(), ["real", "begun"]);
    assert_eq!(told(text), [("P8", 6, 18)]);
}

#[test]
fn files_of_other_languages_without_a_shader() {
    let texts = [
        "#include <windows.h>\nint main() { return D3DXCompile(\"vs_1_1\"); }\n",
        "float4 Main() : POSITION { return 0; }\ntechnique T { pass P { VertexShader = compile vs_1_1 Main(); } }\n",
    ];
    for text in texts {
        assert_eq!(told(text), [("P1", 1, 1)], "{text}");
        assert!(matches!(format(text.as_bytes()), Layout::Nothing(_)));
    }
    // Damaged listings.
    for text in [
        "; { in a comment }\nmov r0, v0\n",
        "{\nps.1.1\nmov r0, v0\n}\n",
    ] {
        let (_, file) = opened(text);
        assert_eq!(
            (file.form, file.shaders.len()),
            (Form::Listing, 1),
            "{text}"
        );
    }
}

#[test]
fn macros_that_listings_do_not_have_are_no_errors_of_their_hosts() {
    let text = "#define trace(args...) f(args)\n#define more(...) g(__VA_ARGS__)\n\
        pixelshader p = asm { ps.1.1\n mov r0, v0 };\n";
    assert_eq!(told(text), []);
}

#[test]
fn directives_between_strings() {
    let text = "\
        const char first[] = \"ps.1.1\\n\"\n\
        #ifdef FOG\n\
        \"mov r0, v1\\n\"\n\
        #endif\n\
        # if 0 // never\n\
        \"mul r0, r0, v9\\n\"\n\
        #if 1\n\
        #endif\n\
        #else\n\
        \"mul r0, r0, v0\\n\";\n\
        #endif\n\
        const char second[] =\n\
        #if defined(A)\n\
        \"ps.1.1\\nmov r0, v0\\n\"\n\
        #elif B\n\
        \"ps.1.1\\nmov r0, c1\\n\"\n\
        #endif\n\
        ;\n\
        const char third[] = \"ps.1.1\\nmov r0, v0\\n\"\n\
        #if A\n\
        \"mul r0, r0, c0\\n\"\n\
        #else\n\
        \"mul r0, r0, c1\\n\"\n\
        #endif\n\
        \"mul r0, r0, c2\\n\";\n";
    let (sources, file) = opened(text);
    assert_eq!(file.names(), ["first", "second", "second#2", "third"]);
    let listings: Vec<_> = file
        .shaders
        .iter()
        .map(|s| listing_of(&sources, s))
        .collect();
    assert_eq!(
        listings,
        [
            "ps.1.1\nmov r0, v1\nmul r0, r0, v0\n",
            "ps.1.1\nmov r0, v0\n",
            "ps.1.1\nmov r0, c1\n",
            "ps.1.1\nmov r0, v0\nmul r0, r0, c0\nmul r0, r0, c2\n",
        ]
    );
}

#[test]
fn conditions_within_each_other_take_no_time() {
    let nested = "\"a\"\n#if 0\n".repeat(20_000);
    let closed = format!("{nested}{}", "#endif\n".repeat(20_000));
    let elses = "\"a\"\n#else\n".repeat(20_000);
    for text in [nested, closed, elses] {
        let begun = std::time::Instant::now();
        host::scan(text.as_bytes());
        // A second where each condition is gone through once, hours where all of them are for each.
        assert!(begun.elapsed().as_secs() < 60);
    }
}

#[test]
fn shaders_of_later_models_beside_others() {
    let text = "s = \"ps_2_0\\ndcl t0\\n\";\nDWORD v[] = { 0xFFFE0300, 0x0000FFFF };\n\
        t = \"vs_2_x\\nmov oPos, v0\\n\"; u = \"ps.1.1\\nmov r0, v0\\n\";\n";
    let (sources, file) = opened(text);
    assert_eq!(file.names(), ["u"]);
    let place = |d: &Diagnostic| {
        let at = sources.locate(d.span).unwrap();
        (d.rule.id, d.severity, at.line, at.column)
    };
    let places: Vec<_> = file.diagnostics.iter().map(place).collect();
    let warning = crate::diagnostic::Severity::Warning;
    assert_eq!(
        places,
        [
            ("P3", warning, 1, 6),
            ("S13", warning, 2, 15),
            ("P3", warning, 3, 6)
        ]
    );
    // Where there is no other, it is what is wrong with the file.
    assert_eq!(told("s = \"ps_2_0\\ndcl t0\\n\";\n"), [("P3", 1, 6)]);
}

#[test]
fn lines_that_end_in_a_carriage_return_alone() {
    assert_eq!(
        told("; water\rps.1.1\rtex t0 ; base\rmul r0, t0, t4\r"),
        [("O1", 4, 13)]
    );
    let laid_out = format(b"ps.1.1\rmov r0,v0\r");
    assert_eq!(laid_out, Layout::Done(b"ps.1.1\nmov r0, v0\n".to_vec()));
    // Not in tokens.
    let words = [
        0xFFFF_0101_u32,
        0x51,
        0xA00F_0000,
        0x0D0D_0D0D,
        0,
        0,
        0,
        0xFFFF,
    ];
    let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).collect();
    let mut sources = SourceMap::new();
    let file = open(&mut sources, "a", bytes, &preprocess::Options::default()).unwrap();
    let Text::Tokens(stream) = &file.shaders[0].text else {
        panic!("tokens are expected");
    };
    assert_eq!(stream.words, words);
}
