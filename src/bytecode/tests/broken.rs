//! Streams that are no shaders: what is said, and of which token.

use super::*;

/// What is told of a stream, a line each: severity, rule, token, message.
fn told_of(tokens: &str) -> String {
    let decoded = decode(&words(tokens));
    let lines = decoded.diagnostics.iter().map(|d| {
        let letter = d.severity.name();
        format!("{letter} {} {}\n", d.rule.id, d.message)
    });
    lines.collect()
}

#[track_caller]
fn broken(tokens: &str, expected: &str) {
    assert_eq!(told_of(tokens), expected, "{tokens}");
    // Each is told of the token that its message names.
    for d in decode(&words(tokens)).diagnostics {
        let at = format!("token {} (byte {}): ", d.span.start, d.span.start * 4);
        assert!(d.message.starts_with(&at), "{d:?}");
    }
}

#[test]
fn versions() {
    for (token, help) in [
        ("FFFE0200", "it is that of a later shader model"),
        ("FFFF0300", "it is that of a later shader model"),
        (
            "FFFE0102",
            "vertex shaders have the versions 1.0 and 1.1, pixel shaders 1.0 to 1.4",
        ),
        (
            "FFFF0105",
            "vertex shaders have the versions 1.0 and 1.1, pixel shaders 1.0 to 1.4",
        ),
        (
            "0401FFFF",
            "the bytes of each token stand in the wrong order: the lowest comes first",
        ),
        ("43425844", "it begins a shader of Direct3D 10 or later"),
        (
            "FEFF0901",
            "it begins a compiled effect, in which shaders are embedded",
        ),
        (
            "00000000",
            "a stream begins with 0xFFFE0100 or 0xFFFE0101, or with 0xFFFF0100 to 0xFFFF0104",
        ),
    ] {
        broken(
            &format!("{token} 00000000 12345678"),
            &format!("error S13 token 0 (byte 0): 0x{token} is no version\n"),
        );
        let decoded = decode(&words(token));
        assert_eq!(decoded.diagnostics[0].help.as_deref(), Some(help));
        assert!(decoded.program.is_none());
    }
    broken("", "error S13 token 0 (byte 0): the stream is empty\n");
}

#[test]
fn streams_that_are_cut_short() {
    broken(
        "FFFF0101",
        "error S12 token 1 (byte 4): the stream ends without the end token\n",
    );
    broken(
        "FFFF0101 00000042 B00F0000",
        "error S12 token 3 (byte 12): the stream ends without the end token\n",
    );
    broken(
        "FFFF0101 00000004 800F0000 80E40000",
        "error S12 token 4 (byte 16): the stream ends in `mad`: 2 of 4 operand tokens are there\n",
    );
    // A `def` at the end: the end token is taken for one of its numbers.
    broken(
        "FFFF0101 00000051 A00F0000 3F800000 0000FFFF",
        "error S12 token 5 (byte 20): the stream ends in `def`, which has 2 numbers instead of 4\n",
    );
    broken(
        "FFFF0101 00000051",
        "error S12 token 2 (byte 8): the stream ends in `def`: 0 of 5 operand tokens are there\n",
    );
    broken(
        "FFFF0101 0005FFFE 00000000 0000FFFF",
        "error K12 token 1 (byte 4): this comment has 5 tokens, but only 2 are left\n",
    );
    broken(
        "FFFF0101 7FFFFFFE",
        "error K12 token 1 (byte 4): this comment has 32767 tokens, but only 0 are left\n",
    );
}

#[test]
fn opcodes_that_do_not_exist() {
    // What follows is read again from the next token without bit 31.
    broken(
        "FFFF0101 0000004B B00F0001 B0E40000 00000001 800F0000 B0E40000 0000FFFF",
        "error K4 token 1 (byte 4): 0x004B of 0x0000004B is no instruction of ps.1.1\n",
    );
    broken(
        "FFFE0101 00000020 00001234 0000FFFF",
        "error K4 token 1 (byte 4): 0x0020 of 0x00000020 is no instruction of vs.1.1\n\
         error K4 token 2 (byte 8): 0x1234 of 0x00001234 is no instruction of vs.1.1\n",
    );
    broken(
        "FFFE0101 00000042 B00F0000 0000FFFF",
        "error K4 token 1 (byte 4): 0x0042 of 0x00000042 is no instruction of vs.1.1\n",
    );
    let decoded = decode(&words("FFFE0101 00000020 80000000 00000000 0000FFFF"));
    let help = decoded.diagnostics[0].help.as_deref();
    assert_eq!(help, Some("it belongs to later shader models"));
    // The rest is there.
    assert_eq!(syntax::print(&decoded.program.unwrap()), "vs.1.1\nnop\n");
}

#[test]
fn wrong_numbers_of_operands() {
    broken(
        "FFFF0104 00000042 800F0000 00000001 800F0000 80E40000 0000FFFF",
        "error K6 token 3 (byte 12): 0x00000001 stands where operand 2 of `texld` should, but bit 31 is clear\n",
    );
    broken(
        "FFFF0101 00000042 B00F0000 B0E40000 B0E40001 0000FFFF",
        "error K5 token 3 (byte 12): 0xB0E40000 stands where an instruction should, but bit 31 makes it an operand\n",
    );
    let decoded = decode(&words("FFFF0101 00000042 B00F0000 B0E40000 0000FFFF"));
    let help = decoded.diagnostics[0].help.as_deref();
    assert_eq!(help, Some("`tex` before it has 1 operand in ps.1.1"));
}

#[test]
fn registers_that_do_not_exist() {
    broken(
        "FFFF0101 00000001 C00F0000 B0E40000 0000FFFF",
        "error K7 token 2 (byte 8): register type 4 of 0xC00F0000 is none of a pixel shader\n",
    );
    broken(
        "FFFE0101 00000001 800F0000 F0E40000 0000FFFF",
        "error K7 token 3 (byte 12): register type 7 of 0xF0E40000 is none of a vertex shader\n",
    );
    // Bit 11 makes it type 10 of a later shader model: 2 and 8.
    broken(
        "FFFF0101 00000001 800F0000 A0E40800 0000FFFF",
        "error K7 token 3 (byte 12): register type 10 of 0xA0E40800 is none of a pixel shader\n",
    );
    broken(
        "FFFE0101 00000001 C00F0003 90E40000 0000FFFF",
        "error K7 token 2 (byte 8): rasterizer output 3 of 0xC00F0003 does not exist\n",
    );
}

/// Numbers beyond the counts of registers.md, section 1, in every place of a register.
#[test]
fn registers_that_the_version_does_not_have() {
    for (version, token, name) in [
        ("ps.1.1", "800F0005", "r5"),
        ("ps.1.4", "800F0009", "r9"),
        ("ps.1.3", "B00F0004", "t4"),
        ("ps.1.4", "B00F0006", "t6"),
        ("ps.1.0", "900F0002", "v2"),
        ("ps.1.4", "A00F000F", "c15"),
        ("vs.1.1", "800F000C", "r12"),
        ("vs.1.1", "900F0010", "v16"),
        ("vs.1.1", "B00F0001", "a1"),
        ("vs.1.0", "D00F0002", "oD2"),
        ("vs.1.0", "E00F0008", "oT8"),
    ] {
        let first = crate::isa::Version::all().find(|v| v.name() == version);
        let first = first.unwrap().token();
        let message = format!("names `{name}`, which {version} does not have");
        broken(
            &format!("{first:08X} 00000001 {token} A0E40000 0000FFFF"),
            &format!("error K7 token 2 (byte 8): 0x{token} {message}\n"),
        );
        let source = token.replacen("0F", "E4", 1);
        broken(
            &format!("{first:08X} 00000001 800F0000 {source} 0000FFFF"),
            &format!("error K7 token 3 (byte 12): 0x{source} {message}\n"),
        );
        // The assembler took a `def` of any constant.
        let told = match name {
            "c15" => String::new(),
            _ => format!("error K7 token 2 (byte 8): 0x{token} {message}\n"),
        };
        broken(
            &format!("{first:08X} 00000051 {token} 00000000 00000000 00000000 00000000 0000FFFF"),
            &told,
        );
    }
    broken(
        "FFFE0101 0000001F 80000000 900F0010 0000FFFF",
        "error K7 token 3 (byte 12): 0x900F0010 names `v16`, which vs.1.1 does not have\n",
    );
    // Devices differ in their constants, and what vs.1.0 lacks of a0 is the validator's: both can be assembled.
    broken("FFFE0100 00000001 B0010000 A0E407FF 0000FFFF", "");
}

#[test]
fn bits_of_operands_that_mean_nothing() {
    broken(
        "FFFF0101 00000001 80000000 B0E40000 0000FFFF",
        "error K8 token 2 (byte 8): the write mask of 0x80000000, bits 19:16, is empty\n",
    );
    broken(
        "FFFF0101 00000051 A0070000 00000000 00000000 00000000 00000000 0000FFFF",
        "error K8 token 2 (byte 8): `def` sets a whole register, but 0xA0070000 masks it\n",
    );
    broken(
        "FFFF0101 00000001 802F0000 B0E40000 0000FFFF",
        "error K9 token 2 (byte 8): 0x802F0000 modifies the result in a way that a pixel shader has not: bits 27:24 \
         hold 0, 23:20 hold 2\n",
    );
    broken(
        "FFFF0101 00000001 840F0000 B0E40000 0000FFFF",
        "error K9 token 2 (byte 8): 0x840F0000 modifies the result in a way that a pixel shader has not: bits 27:24 \
         hold 4, 23:20 hold 0\n",
    );
    broken(
        "FFFE0101 00000001 801F0000 90E40000 0000FFFF",
        "error K9 token 2 (byte 8): 0x801F0000 modifies the result in a way that a vertex shader has not: bits 27:24 \
         hold 0, 23:20 hold 1\n",
    );
    broken(
        "FFFF0101 00000001 800F0000 BBE40000 0000FFFF",
        "error K9 token 3 (byte 12): source modifier 11 of 0xBBE40000, bits 27:24, is none of a pixel shader\n",
    );
    broken(
        "FFFE0101 00000001 800F0000 94E40000 0000FFFF",
        "error K9 token 3 (byte 12): source modifier 4 of 0x94E40000, bits 27:24, is none of a vertex shader\n",
    );
    broken(
        "FFFF0101 00000051 A10F0000 00000000 00000000 00000000 00000000 0000FFFF",
        "error K9 token 2 (byte 8): 0xA10F0000 modifies the result of a declaration\n",
    );
    broken(
        "FFFE0101 00000001 800F2000 90E40000 0000FFFF",
        "error K10 token 2 (byte 8): bit 13 of 0x800F2000 makes a destination relative to a0.x\n",
    );
    broken(
        "FFFE0101 00000001 800F0000 90E42000 0000FFFF",
        "error K10 token 3 (byte 12): bit 13 of 0x90E42000 makes `v0` relative to a0.x\n",
    );
    broken(
        "FFFF0101 00000001 800F0000 A0E42003 0000FFFF",
        "error K10 token 3 (byte 12): bit 13 of 0xA0E42003 makes `c3` relative to a0.x\n",
    );
    broken(
        "FFFE0101 0000001F 8000000E 900F0000 0000FFFF",
        "error K17 token 2 (byte 8): 0x8000000E is no usage of a vertex element\n",
    );
    broken(
        "FFFE0101 0000001F 80000040 900F0000 0000FFFF",
        "error K17 token 2 (byte 8): 0x80000040 is no usage of a vertex element\n",
    );
    broken(
        "FFFE0101 4000001F 80000000 900F0000 0000FFFF",
        "error K9 token 1 (byte 4): bit 30 of 0x4000001F makes a pair, which a vertex shader does not have\n",
    );
    broken(
        "FFFE0101 00000001 800F0000 90E40000 40000001 800F0001 90E40000 0000FFFF",
        "error K9 token 4 (byte 16): bit 30 of 0x40000001 makes a pair, which a vertex shader does not have\n",
    );
}

/// What the runtime passed over is a warning; it is read, and not written again.
#[test]
fn bits_that_were_ignored() {
    let tokens = "FFFF0101 02000001 800F0000 B0E4C000 0000FFFF";
    broken(
        tokens,
        "warning K11 token 1 (byte 4): bits 29:16 of 0x02000001 are not clear; they are ignored, and not written again\n\
         warning K11 token 3 (byte 12): bits 15:14 of 0xB0E4C000 are not clear; they are ignored, and not written again\n",
    );
    let program = decode(&words(tokens)).program.unwrap();
    assert_eq!(syntax::print(&program), "ps.1.1\nmov r0, t0\n");
    let tokens = "FFFF0101 00000000 0000FFFF 00000000 00000000";
    broken(
        tokens,
        "warning K3 token 3 (byte 12): 2 tokens behind the end token, which are not read\n",
    );
    assert_eq!(decode(&words(tokens)).length, 3);
    let tokens = "FFFE0101 00000003 800F0000 90E40000 A0E40000 0000FFFF";
    broken(
        tokens,
        "warning K16 token 1 (byte 4): no assembler wrote this token, `sub`, into a vertex shader\n",
    );
    let program = decode(&words(tokens)).program.unwrap();
    assert_eq!(syntax::print(&program), "vs.1.1\nsub r0, v0, c0\n");
}

/// Everything is told at once, up to a hundred and the word that there is more.
#[test]
fn all_errors_at_once() {
    broken(
        "FFFF0101 00000001 80000000 BBE40000 00000042 80000000 0000FFFF 00000000",
        "error K8 token 2 (byte 8): the write mask of 0x80000000, bits 19:16, is empty\n\
         error K9 token 3 (byte 12): source modifier 11 of 0xBBE40000, bits 27:24, is none of a pixel shader\n\
         error K8 token 5 (byte 20): the write mask of 0x80000000, bits 19:16, is empty\n\
         warning K3 token 7 (byte 28): 1 token behind the end token, which are not read\n",
    );
    let mut words = vec![0x7777; 1000];
    words[0] = 0xFFFF_0101;
    let decoded = decode(&words);
    let told = told(&decoded.diagnostics);
    assert_eq!(told.len(), 101);
    assert_eq!((told[99].0, told[99].1), ("K4", 100));
    assert_eq!((told[100].0, told[100].1), ("K20", 101));
}

#[test]
fn streams_without_end_are_given_up() {
    // `nop` a million times, and a comment after another.
    let mut words = vec![0; 1_000_000];
    words[0] = 0xFFFF_0101;
    let decoded = decode(&words);
    assert_eq!(told(&decoded.diagnostics)[0].0, "K13");
    assert_eq!(decoded.program.unwrap().statements.len(), MOST_ITEMS);
    let mut words: Vec<u32> = [0x0007_FFFE, 0, 0, 0, 0, 0, 0, 0].repeat(125_000);
    words[0] = 0xFFFF_0101;
    let decoded = decode(&words);
    let told = told(&decoded.diagnostics);
    assert_eq!((told.len(), told[0].0), (1, "K13"), "{told:?}");
    assert!(decoded.length <= MOST_TOKENS);
}
