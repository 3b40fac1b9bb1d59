//! The same thing said in several ways, as far as it can mean nothing else.

use super::*;

/// A case of a pixel shader whose colour is `v0`, with these lines, passes.
#[track_caller]
fn mov_passes(lines: &str) {
    passes(&format!("{MOV}{lines}"));
}

/// A case that samples `[textures.0]` at its first texel, which is red, passes.
#[track_caller]
fn red(lines: &str, texture: &str) {
    let ps = "ps = \"ps.1.1\\ntex t0\\nmov r0, t0\"\ninputs.t0 = [0.25, 0.25, 0.25, 1]\n";
    passes(&format!(
        "{ps}expect.r0 = [1, 0, 0, 1]\n{lines}\n[textures.0]\n{texture}\n"
    ));
}

#[test]
fn registers_may_be_written_in_capitals() {
    mov_passes("inputs.V0 = [0.5, 0.25]\nexpect.R0 = [0.5, 0.25, 0, 1]\nexpect.Killed = false\n");
    let ps = "ps = \"ps.1.1\\ntexcoord t0\\nadd r0, t0, c1\"\n";
    passes(&format!(
        "{ps}inputs.T0 = 0.5\nps_constants.C1 = 0.25\nexpect.T0 = [0.5, 0.5, 0.5, 1]\nexpect.r0 = [0.75, 0.75, 0.75, 1.25]\n"
    ));
}

#[test]
fn names_may_be_the_constants_of_direct3d() {
    // 0.5 is stored as 128 of 255, which is 128 or less but not less.
    for (name, drawn) in [
        ("lessequal", 1),
        ("LESSEQUAL", 1),
        ("less_equal", 1),
        ("D3DCMP_LESSEQUAL", 1),
        ("D3DCMP_LESS", 0),
    ] {
        mov_passes(&format!(
            "inputs.v0 = [1, 1, 1, 0.5]\nstate = {{ alpha_test = true, alpha_func = \"{name}\", alpha_ref = 128 }}\n\
             expect.frame = [{drawn}, {drawn}, {drawn}]\n"
        ));
    }
    // Half of white and half of black, with only red and green written.
    mov_passes(
        "inputs.v0 = [1, 1, 1, 0.5]\nexpect.frame = [0.5, 0.5, 0]\nclear = [0, 0, 0, 1]\n\
         [state]\nalpha_blend = true\nsrc_blend = \"D3DBLEND_SRCALPHA\"\ndest_blend = \"Inv_Src_Alpha\"\n\
         color_write = \"RG\"\nblend_op = \"D3DBLENDOP_ADD\"\ncull = \"D3DCULL_NONE\"\n",
    );
    for name in ["mirror_once", "mirroronce", "D3DTADDRESS_MIRRORONCE"] {
        // Half a texel before the first, in the mirror, is the first.
        let sampler = format!("samplers.0.address = \"{name}\"\ninputs.t0 = [-0.25, 0.25]\n");
        let ps = "ps = \"ps.1.1\\ntex t0\\nmov r0, t0\"\nexpect.r0 = [1, 0, 0]\n";
        passes(&format!(
            "{ps}{sampler}[textures.0]\nsize = [2, 1]\ntexels = [[1], [0]]\n"
        ));
    }
    for filter in ["anisotropic", "D3DTEXF_ANISOTROPIC", "LINEAR"] {
        red(
            &format!("samplers.0 = {{ filter = \"{filter}\", mip = \"D3DTEXF_POINT\" }}"),
            "format = \"D3DFMT_A8R8G8B8\"\nkind = \"2D\"\nsize = [1, 1]\nraw = [0xffff0000]",
        );
    }
    refused(
        &format!("{MOV}expect.r0 = 1\nstate.alpha_func = \"D3DCMP_SMALLER\"\n"),
        "`D3DCMP_SMALLER` is no comparison; it is one of never, less,",
    );
    refused(
        &format!("{MOV}expect.r0 = 1\nstate.alpha_func = \"é_less\"\n"),
        "`é_less` is no comparison",
    );
}

#[test]
fn colours_are_lists_or_one_number() {
    let never = "state = { alpha_test = true, alpha_func = \"never\" }\n";
    mov_passes(&format!("{never}clear = 0.5\nexpect.frame = 0.5\n"));
    // Alpha is 0 where nothing is said.
    mov_passes(&format!(
        "{never}clear = [0, 1, 0]\nexpect.frame = [0, 1, 0, 0]\n"
    ));
    refused(
        &format!("{MOV}expect.r0 = 1\nclear = [0, 1]\n"),
        "there are 2 entries where 4 must be",
    );
    // f = 0.5: half of white and half of the fog.
    for color in ["[0, 1, 0]", "[0, 1, 0, 0.25]"] {
        mov_passes(&format!(
            "inputs.v0 = 1\ninputs.v1 = [0, 0, 0, 0.5]\nstate.fog = {{ color = {color} }}\nexpect.frame = [0.5, 1, 0.5, 1]\n"
        ));
    }
    refused(
        &format!("{MOV}expect.r0 = 1\nstate.fog.color = [1, 1, 1, 1, 1]\n"),
        "there are 5 entries where 3 must be",
    );
    let border = "samplers.0 = { address = \"border\", border = 0.5 }\ninputs.t0 = [2, 2]\n";
    passes(&format!(
        "ps = \"ps.1.1\\ntex t0\\nmov r0, t0\"\nexpect.r0 = 0.5\n{border}[textures.0]\nsize = [1, 1]\ntexels = [[1]]\n"
    ));
}

#[test]
fn a_single_table_is_a_list_of_one() {
    for accept in ["accept = { r0 = 0.5 }", "accept = [{ r0 = 0.5 }]"] {
        let case = loaded(&format!("{MOV}inputs.v0 = 0.5\nexpect.r0 = 1\n{accept}\n"));
        assert_eq!(case.check(), [Verdict::Accepted(0)]);
    }
    mov_passes("[invocation]\ninputs.v0 = 0.5\nexpect.r0 = 0.5\n");
    refused(
        &format!("{MOV}expect.r0 = 1\naccept = 1\n"),
        "`accept` must be a list of tables like `expect`, not a number",
    );
}

#[test]
fn texels_may_stand_in_rows_and_faces() {
    red("", "size = [2, 2]\ntexels = [[[1], [0]], [[0], [0]]]");
    red(
        "samplers.0 = { mip = \"point\", max_mip_level = 1 }",
        "size = [2, 2]\ntexels = [[[0], [0]], [[0], [0]]]\nmips = [[[[1]]]]",
    );
    for size in ["1", "[1]", "[1, 1]"] {
        let face = "[[[1]]]";
        red(
            "",
            &format!(
                "kind = \"cube\"\nsize = {size}\ntexels = [{face}, {face}, {face}, {face}, {face}, {face}]"
            ),
        );
    }
    // A number is a texel of one component.
    red("", "size = [2, 1]\ntexels = [1, 0]");
    refused(
        "ps = \"ps.1.1\\ntex t0\\nmov r0, t0\"\nexpect.r0 = 1\n[textures.0]\nsize = [1, 1]\ntexels = [1, 0, 0, 1]\n",
        "level 0 needs 1 texels, 4 given",
    );
    refused(
        "ps = \"ps.1.1\\ntex t0\\nmov r0, t0\"\nexpect.r0 = 1\n[textures.0]\nsize = [2, 1]\ntexels = [[[1]], 1]\n",
        "invalid type: integer `1`, expected a sequence",
    );
    refused(
        "ps = \"ps.1.1\\ntex t0\\nmov r0, t0\"\nexpect.r0 = 1\n[textures.0]\nsize = 2\ntexels = [1]\n",
        "`size`: invalid type: integer `2`",
    );
}

#[test]
fn a_bump_matrix_may_be_two_rows() {
    for matrix in ["[1, 2, 3, 4]", "[[1, 2], [3, 4]]"] {
        let case = loaded(&format!(
            "{MOV}expect.r0 = 1\nstages.1.bump_mat = {matrix}\n"
        ));
        assert_eq!(case.stages[1].bump.matrix, [1.0, 2.0, 3.0, 4.0]);
    }
    refused(
        &format!("{MOV}expect.r0 = 1\nstages.1.bump_mat = [[1, 2, 3], [4]]\n"),
        "there are 3 entries where 2 must be",
    );
}

#[test]
fn what_is_said_to_readers_is_passed_over() {
    mov_passes(
        "description = \"a\"\ncomment = \"b\"\nnote = [\"c\"]\nsource = \"d\"\nvs = \"\"\nvs_file = \"\"\n\
         [[invocation]]\nname = \"e\"\ncomment = \"f\"\ninputs.v0 = 1\nexpect.r0 = 1\n",
    );
}

#[test]
fn json_may_have_null_and_the_numbers_of_its_writers() {
    let text = "{\"vs\": null, \"ps\": \"ps.1.1\\nmov r0, v0\", \"inputs\": {\"v0\": 1}, \"accept\": null,\n\
                \"expect\": {\"r0\": 1, \"depth\": null, \"killed\": null}}";
    let case = load("case.json", text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(case.check(), [Verdict::Passed]);
    let vertex = |numbers: &str| {
        format!(
            "{{\"vs\": \"vs.1.1\\nmov oPos, v0\\nmov oT0, v1\", \"inputs\": {{\"v1\": {numbers}}}, \
             \"expect\": {{\"oT0\": [\"inf\", \"-inf\", \"nan\"]}}}}"
        )
    };
    for numbers in [
        "[Infinity, -Infinity, NaN]",
        "[\"Infinity\", \"-Infinity\", \"NaN\"]",
    ] {
        let case = load("case.json", &vertex(numbers)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(case.check(), [Verdict::Passed]);
    }
    for (numbers, said) in [
        ("[null]", "`null` has no meaning in a list"),
        ("[inf]", "`inf` is no JSON"),
        ("[-Inf]", "`-Inf` is no JSON"),
        ("[Infinit]", "`Infinit` is no JSON"),
    ] {
        let error = load("case.json", &vertex(numbers)).expect_err("a problem");
        assert!(error.contains(said), "{error}");
    }
}

/// A picture of two by one, red and blue, as uncompressed TGA.
fn tga() -> Vec<u8> {
    let mut bytes = vec![0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 1, 0, 32, 0x28];
    bytes.extend([0, 0, 255, 128, 255, 0, 0, 128]);
    bytes
}

#[test]
fn a_picture_takes_the_format_that_is_asked_for() {
    let files: BTreeMap<String, Vec<u8>> = [("red.tga".to_owned(), tga())].into();
    let load = |format: &str, alpha: &str| {
        let text = format!(
            "ps = \"ps.1.1\\ntex t0\\nmov r0, t0\"\ninputs.t0 = [0.25, 0.5]\nexpect.r0 = [1, 0, 0, {alpha}]\n\
             [textures.0]\nfile = \"red.tga\"\nformat = \"{format}\"\nsize = [2, 1]\n"
        );
        Case::load(
            "case.toml",
            text.as_bytes(),
            &files,
            &LoadOptions::default(),
        )
    };
    // 128 of 255, and 1 where the format has no alpha.
    for (format, alpha) in [
        ("rgba8", "0.5019608"),
        ("a8r8g8b8", "0.5019608"),
        ("x8r8g8b8", "1"),
    ] {
        let case = load(format, alpha).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(
            case.stages[0].texture.as_ref().unwrap().format().name(),
            format
        );
        assert_eq!(case.check(), [Verdict::Passed], "{format}");
    }
    for format in ["v8u8", "dxt1", "rgba32f"] {
        let error = load(format, "1").expect_err("a problem").to_string();
        assert!(error.contains("the format of the file is rgba8"), "{error}");
    }
}
