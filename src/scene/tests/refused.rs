//! Listings in scenes, files that cannot be had, and files that are meant to do harm.

use super::broken::{DRAW, MESH, lines};
use super::*;
use crate::scene::{DirectoryResolver, Resolver};

#[test]
fn what_is_wrong_with_a_listing_stands_at_the_listing() {
    let text = |ps: &str| format!("{MESH}[[draw]]\nmesh = \"m\"\nvs = \"flat.vsh\"\n{ps}\n");
    let from_file = lines(&text("ps = \"broken.psh\""));
    assert!(
        from_file[0].starts_with("broken.psh:3:1: error[P"),
        "{from_file:#?}"
    );
    // A file that two draws use is reported once.
    let twice = format!(
        "{}{}",
        text("ps = \"broken.psh\""),
        text("ps = \"broken.psh\"").replace(MESH, "")
    );
    assert_eq!(lines(&twice), from_file);
    let inline = lines(&text("ps_text = \"ps.1.1\\nmov r9, c0\\n\""));
    let place = "draw `1`, `ps_text`:2:5: error[";
    assert!(
        inline.iter().any(|line| line.starts_with(place)),
        "{inline:#?}"
    );
}

/// Files lie beside the listing that includes them.
#[test]
fn listings_include_files() {
    let text = format!("{MESH}[[draw]]\nmesh = \"m\"\nvs = \"flat.vsh\"\nps = \"sub/a.psh\"\n");
    let found = lines(&text);
    let starts = |line: &str| found.iter().any(|found| found.starts_with(line));
    assert!(starts("sub/b.inc:3:8: error[O1]"), "{found:#?}");
    assert!(
        starts("sub/a.psh:3:10: error[P28]: `none.inc` cannot be read"),
        "{found:#?}"
    );
    let errors = found.iter().filter(|line| line.contains(": error["));
    assert_eq!(errors.count(), 2, "{found:#?}");
}

#[test]
fn warnings_do_not_refuse() {
    let scene = loaded(&format!(
        "{MESH}[[draw]]\nmesh = \"m\"\nvs = \"flat.vsh\"\nps = \"stage0.psh\"\nstate.fog = {{ vertex = \"linear\" }}\n"
    ));
    let messages: Vec<_> = scene
        .warnings()
        .iter()
        .map(|d| (d.rule.id, d.message.as_str()))
        .collect();
    assert!(
        messages.contains(&(
            "F12",
            "the pixel shader samples stage 0, which has no texture: opaque black"
        )),
        "{messages:?}"
    );
    assert!(messages.iter().any(|(id, _)| *id == "F13"), "{messages:?}");
    // Opaque black it is.
    let picture = scene
        .render(
            &RenderOptions {
                size: Some([1, 1]),
                show: None,
            },
            &|_| {},
        )
        .unwrap();
    assert_eq!(pixels(&picture), [[0, 0, 0, 255]]);
}

#[test]
fn hostile_files_are_refused_quickly() {
    let deep = format!("x = {}", "[".repeat(200_000));
    let keys = format!("{} = 1", vec!["a"; 100_000].join("."));
    let tables = format!("{}\n", "[[draw]]\n".repeat(5000));
    for text in [
        deep,
        keys,
        tables,
        "[".repeat(100_000),
        "a = {".repeat(100_000),
    ] {
        assert!(load(&text).is_err());
    }
    // Names as long as the file, and as many wrong ones as fit.
    let long = "a".repeat(2_000_000);
    let names: String = (0..100_000).map(|i| format!("\"x{i}\",")).collect();
    let keys: String = (0..100_000).map(|i| format!("x{i} = 1\n")).collect();
    let (names, keys) = (
        format!("draws = [{names}]\n{MESH}{DRAW}"),
        format!("{keys}{MESH}{DRAW}"),
    );
    for text in [
        format!("{long} = 1"),
        format!("{MESH}{DRAW}name = 1\n[draw.{long}]"),
        names,
        keys,
    ] {
        let error = load(&text).unwrap_err();
        assert!(error.diagnostics.len() <= 101 && error.to_string().len() < 200_000);
    }
    // 100 targets of six faces that draw the same 1000 times.
    let again = "\"1\",".repeat(1000);
    let targets: String = (0..100)
        .map(|i| format!("[targets.t{i}]\nkind = \"cube\"\nsize = 1\ndraws = [{again}]\n"))
        .collect();
    let error = load(&format!("{targets}{MESH}{DRAW}"))
        .unwrap_err()
        .to_string();
    assert!(error.contains("600001 draws; at most 32768"), "{error}");
    let options = LoadOptions::default();
    let not_text = Scene::load("s", b"size = [1, 1]\n# \xff", &files(), &options).unwrap_err();
    assert!(
        not_text
            .to_string()
            .starts_with("s:2:3: error[F1]: this is not UTF-8"),
        "{not_text}"
    );
    let long = Scene::load("s", &vec![b'\n'; 5 << 20], &files(), &options).unwrap_err();
    assert!(long.to_string().starts_with("s:1:1: error[F11]"), "{long}");
}

#[test]
fn a_folder_as_resolver() {
    let text = format!(
        "{MESH}[[draw]]\nmesh = \"m\"\nvs = \"no such file.vsh\"\nps = \"no such file.psh\"\n"
    );
    let resolver = DirectoryResolver::new("no such folder");
    let error = Scene::load("s", text.as_bytes(), &resolver, &LoadOptions::default()).unwrap_err();
    let name = std::path::Path::new("no such folder").join("no such file.vsh");
    let start = format!("s:5:6: error[F7]: `{}` cannot be read: ", name.display());
    assert!(error.to_string().starts_with(&start), "{error}");
    let manifest = DirectoryResolver::new(env!("CARGO_MANIFEST_DIR"));
    assert!(
        manifest
            .read("Cargo.toml")
            .unwrap()
            .starts_with(b"[package]")
    );
}

proptest::proptest! {
    #[test]
    fn no_text_panics(text in "[a-z\\[\\]{}=\", \n.0-9-]{0,200}") {
        let _ = load(&text);
    }

    /// A scene with one byte changed is refused or rendered.
    #[test]
    fn no_damage_panics(at in 0usize..400, byte in 32u8..127) {
        let mut text = format!(
            "size = [2, 2]\n[camera]\nposition = [0, 0, -3]\n{MESH}{DRAW}vs_constants.c0 = \"world_view_projection\"\n\
             stages.0.texture = \"t\"\n[textures.t]\ntexels = [[1], [0]]\nsize = [2, 1]\n[targets.x]\nsize = 2\ndraws = [\"1\"]\n"
        )
        .into_bytes();
        let at = at % text.len();
        text[at] = byte;
        let scene = Scene::load("s", &text, &files(), &LoadOptions::default());
        if let Ok(scene) = scene {
            let small = RenderOptions { size: Some([2, 2]), show: None };
            let _ = scene.render(&small, &|_| {});
        }
    }
}

/// `max_anisotropy` is 1 until it is set: a filter that would need more is told of, one that has it is not.
#[test]
fn anisotropy_that_does_nothing_is_told() {
    let with = |stage: &str| {
        let scene = loaded(&format!(
            "{MESH}[textures.t]\nsize = [1, 1]\ntexels = [[1]]\n[[draw]]\nmesh = \"m\"\nvs = \"flat.vsh\"\n\
             ps = \"stage0.psh\"\nstages.0 = {{ texture = \"t\", {stage} }}\n"
        ));
        let told = scene.warnings().iter();
        told.filter(|warning| warning.message.contains("`max_anisotropy` is 1"))
            .count()
    };
    assert_eq!(with("filter = \"anisotropic\""), 1);
    assert_eq!(with("min = \"anisotropic\", mag = \"point\""), 1);
    for quiet in [
        "filter = \"anisotropic\", max_anisotropy = 8",
        "filter = \"anisotropic\", max_anisotropy = 1",
        "mag = \"anisotropic\"",
        "filter = \"gaussiancubic\"",
    ] {
        assert_eq!(with(quiet), 0, "{quiet}");
    }
}
