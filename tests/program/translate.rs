//! `translate`, and what commands that need a GPU say about their arguments.

use super::{folder, texcrd};

const VERTEX: &str = "asm/stained_glass/stained_glass.vsh";
const PIXEL: &str = "asm/stained_glass/stained_glass.psh";

#[test]
fn a_pair_becomes_one_module() {
    let ran = texcrd(&["translate", VERTEX, PIXEL]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    for part in ["@vertex", "@fragment", "fn vs_main", "fn ps_main", "// "] {
        assert!(ran.out.contains(part), "{part}\n{}", ran.out);
    }
}

#[test]
fn the_contract_names_kinds_of_textures() {
    let ran = texcrd(&["translate", PIXEL, "--texture", "3=cube", "--reflect"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    let contract: serde_json::Value = serde_json::from_str(&ran.out).expect("it is JSON");
    assert_eq!(contract["pixel"]["version"], "ps.1.4");
    assert_eq!(contract["vertex"], serde_json::Value::Null);
    let bindings = contract["bindings"].as_array().expect("a list");
    let dimension = |stage: u64| {
        let of_stage = |b: &&serde_json::Value| b["kind"] == "texture" && b["stage"] == stage;
        bindings
            .iter()
            .find(of_stage)
            .map(|b| b["dimension"].clone())
    };
    // A cube of Direct3D 8 is six faces that do not know of each other.
    assert_eq!(dimension(3), Some("2d-array".into()));
    assert_eq!(dimension(2), Some("2d".into()));
    assert_eq!(dimension(1), None);
}

#[test]
fn what_was_guessed_or_has_no_effect_is_said() {
    // The listing reads its maps 2 and 4 with directions that it computed.
    let guessed = texcrd(&["translate", PIXEL]);
    assert_eq!(guessed.status, 0, "{}", guessed.err);
    for stage in [2, 4] {
        let note = format!("stage {stage}: taken for a 2D texture");
        assert!(guessed.err.contains(&note), "{}", guessed.err);
    }
    let told = texcrd(&[
        "translate",
        PIXEL,
        "--texture",
        "2=cube",
        "--texture",
        "4=cube",
        "--texture",
        "7=cube",
    ]);
    assert_eq!(told.status, 0, "{}", told.err);
    for stage in [2, 4] {
        let note = format!("stage {stage}:");
        assert!(!told.err.contains(&note), "{}", told.err);
    }
    assert!(told.err.contains("stage 7 is not read"), "{}", told.err);
}

#[test]
fn glsl_has_a_file_a_stage() {
    let refused = texcrd(&["translate", VERTEX, PIXEL, "--to", "glsl"]);
    assert_eq!(refused.status, 2);
    assert!(refused.err.contains("one file a stage"), "{}", refused.err);
    let folder = folder("translate_glsl");
    let out = folder.join("glass");
    let ran = texcrd(&[
        "translate",
        VERTEX,
        PIXEL,
        "--to",
        "glsl",
        "-o",
        &out.to_string_lossy(),
    ]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    for extension in ["vert", "frag"] {
        let text = std::fs::read_to_string(out.with_extension(extension));
        assert!(text.expect("the file is there").starts_with("#version"));
    }
}

/// Each switch leaves its mark where the documentation of the translation says, and none without a shader to work on.
#[test]
fn states_are_baked_in() {
    let folder = folder("translate_states_are_baked_in");
    let path = |name: &str, text: &str| {
        let path = folder.join(name);
        std::fs::write(&path, text).expect("a file can be written");
        path.to_string_lossy().into_owned()
    };
    let vertex = path(
        "a.vsh",
        "vs.1.1\nmov oPos, v0\nmov oT0, v1\nmov oD0, v2\nmov oPts.x, v3.x\n",
    );
    let pixel = path("a.psh", "ps.1.1\ntex t0\nmul r0, t0, v0\n");
    for (switches, mark) in [
        (&["--projected", "0"][..], "in.t0.w"),
        (
            &["--texture", "0=cube", "--seamless", "0"],
            "texture0: texture_cube<f32>",
        ),
        (&["--address", "0=border"], "border"),
        (
            &["--address", "0=border", "--filter", "0=point"],
            "fn sample_point_border",
        ),
        (
            &["--address", "0=mirror_once", "--mip", "0=linear"],
            "fn sample_linear_mips_mirror_once",
        ),
        (
            &["--filter", "0=anisotropic", "--max-anisotropy", "0=4"],
            "1.0, 4.0)",
        ),
        (&["--lod-bias", "0"], "lod_bias"),
        (&["--flat-shading"], "@interpolate(flat"),
        (&["--points", "sprites"], "@builtin(vertex_index)"),
        (&["--clip-planes", "2"], "clip_plane"),
        (&["--fog", "linear"], "fog"),
        (&["--alpha-test", "less"], "alpha_ref"),
    ] {
        let translated = |switches: &[&str]| {
            let ran = texcrd(&[&["translate", &vertex, &pixel], switches].concat());
            assert_eq!(ran.status, 0, "{switches:?}: {}", ran.err);
            ran.out
        };
        let text = translated(switches);
        assert!(text.contains(mark), "{switches:?}:\n{text}");
        assert!(!translated(&[]).contains(mark), "{mark} is always there");
    }
    for (file, switches, message) in [
        (&vertex, &["--projected", "0"][..], "needs a pixel shader"),
        (&pixel, &["--clip-planes", "1"], "needs a vertex shader"),
        (&pixel, &["--address", "9=wrap"], "stages 0 to 7"),
        (&pixel, &["--max-anisotropy", "0=17"], "1 to 16"),
        (
            &pixel,
            &["--filter", "0=cubic"],
            "point, linear, anisotropic",
        ),
        (&vertex, &["--mip", "0=point"], "needs a pixel shader"),
        (&pixel, &["--clip-planes", "7"], "7"),
    ] {
        let ran = texcrd(&[&["translate", file.as_str()], switches].concat());
        assert_eq!(ran.status, 2, "{switches:?}: {}", ran.err);
        assert!(ran.err.contains(message), "{switches:?}: {}", ran.err);
    }
}

/// Neither half of a pair is written where the other cannot be, and no listing is written over.
#[test]
fn nothing_is_lost() {
    let folder = folder("translate_nothing_is_lost");
    let out = folder.join("glass");
    std::fs::create_dir_all(out.with_extension("frag")).expect("a folder can be made");
    let path = out.to_string_lossy();
    let ran = texcrd(&["translate", VERTEX, PIXEL, "--to", "glsl", "-o", &path]);
    assert_eq!(ran.status, 2, "{}", ran.err);
    assert!(!out.with_extension("vert").exists());
    let listing = folder.join("only.psh");
    std::fs::write(&listing, "ps.1.1\nmov r0, v0\n").expect("a file can be written");
    let path = listing.to_string_lossy();
    let ran = texcrd(&["translate", &path, "-o", &path]);
    assert_eq!(ran.status, 2, "{}", ran.err);
    let kept = std::fs::read_to_string(&listing).expect("it is there");
    assert_eq!(kept, "ps.1.1\nmov r0, v0\n");
}

#[test]
fn what_does_not_fit_together_is_refused() {
    for (arguments, status, message) in [
        (
            &["translate", PIXEL, PIXEL][..],
            2,
            "one is a vertex and one a pixel shader",
        ),
        (&["translate", PIXEL, "--to", "cg"], 2, "no language"),
        (
            &["translate", PIXEL, "--texture", "9=cube"],
            2,
            "stages 0 to 7",
        ),
        (
            &[
                "translate",
                PIXEL,
                "--texture",
                "2=cube",
                "--texture",
                "2=2d",
            ],
            2,
            "twice",
        ),
        (
            &["translate", VERTEX, "--alpha-test", "less"],
            2,
            "--alpha-test needs a pixel shader",
        ),
        (
            &["run", "x.toml", "-o", "x.png", "--adapter", "0"],
            2,
            "only with --on gpu",
        ),
    ] {
        let ran = texcrd(arguments);
        assert_eq!(ran.status, status, "{arguments:?}: {}", ran.err);
        assert!(ran.err.contains(message), "{arguments:?}: {}", ran.err);
    }
}
