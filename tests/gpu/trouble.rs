//! What happens where there is no GPU, or no longer one, or one that is too small.

use std::collections::BTreeMap;
use std::process::Command;

use texcrd::gpu::{GpuError, Renderer};
use texcrd::scene::{LoadOptions, RenderOptions, Scene};

/// One white triangle.
fn scene(state: &str) -> Scene {
    let text = format!(
        "size = [8, 8]\n[meshes.one]\npositions = [[-1, 1, 0.5], [1, 1, 0.5], [-1, -1, 0.5]]\n\
         [[draw]]\nname = \"one\"\nmesh = \"one\"\nvs_text = \"vs.1.1\\nmov oPos, v0\"\n\
         ps_text = \"ps.1.1\\ndef c0, 1, 1, 1, 1\\nmov r0, c0\"\nstate = {{ {state} }}\n"
    );
    let files = BTreeMap::<String, Vec<u8>>::new();
    match Scene::load(
        "scene.toml",
        text.as_bytes(),
        &files,
        &LoadOptions::default(),
    ) {
        Ok(scene) => scene,
        Err(error) => panic!("{error}"),
    }
}

#[test]
fn a_lost_device_is_an_error_from_then_on() {
    let Some(device) = crate::device() else {
        return;
    };
    let scene = scene("");
    let mut renderer = Renderer::new(&device);
    let before = renderer.render(&scene, &RenderOptions::default(), &|_| ());
    // The upper left half of the picture is white.
    let before = before.expect("the device is there");
    assert_eq!(before.get_pixel(1, 1).0, [255; 4]);
    device.device().destroy();
    for _ in 0..2 {
        let after = renderer.render(&scene, &RenderOptions::default(), &|_| ());
        assert!(matches!(after, Err(GpuError::Lost(_))), "{after:?}");
    }
}

#[test]
fn a_picture_larger_than_the_device_can_hold() {
    let Some(device) = crate::device() else {
        return;
    };
    let most = device.device().limits().max_texture_dimension_2d;
    let options = RenderOptions {
        size: Some([most + 1, 1]),
        show: None,
    };
    let drawn = Renderer::new(&device).render(&scene(""), &options, &|_| ());
    assert!(matches!(drawn, Err(GpuError::Limit { .. })), "{drawn:?}");
}

#[test]
fn a_state_that_webgpu_has_not() {
    let Some(device) = crate::device() else {
        return;
    };
    let drawn = Renderer::new(&device).render(
        &scene("fill = \"point\""),
        &RenderOptions::default(),
        &|_| (),
    );
    let Err(GpuError::Unsupported { draw, state }) = drawn else {
        panic!("{drawn:?}");
    };
    assert_eq!(draw, "one");
    assert!(state.contains("point"), "{state}");
}

/// This program's own tests, with an environment of their own.
fn tests_with(name: &str, value: &str) -> (bool, String) {
    let program = std::env::current_exe().expect("a test has a program");
    let run = Command::new(program)
        .args([
            "--exact",
            "trouble::a_state_that_webgpu_has_not",
            "--nocapture",
        ])
        .env_remove("TEXCRD_GPU")
        .env(name, value)
        .output()
        .expect("the program starts");
    let said = [run.stdout, run.stderr].concat();
    (run.status.success(), String::from_utf8_lossy(&said).into())
}

#[test]
fn only_the_switch_skips_and_it_says_so() {
    let (passed, said) = tests_with("TEXCRD_GPU", "off");
    assert!(passed && said.contains("SKIPPED: TEXCRD_GPU=off"), "{said}");
    if crate::device().is_some() {
        let (passed, said) = tests_with("TEXCRD_GPU", "of");
        assert!(passed && !said.contains("SKIPPED"), "{said}");
    }
}

/// No backend is left: the tests fail, and say what to install.
#[test]
fn without_an_adapter_tests_fail_and_say_what_to_install() {
    let (passed, said) = tests_with("WGPU_BACKEND", "none");
    assert!(!passed, "{said}");
    assert!(
        said.contains("apt-get install mesa-vulkan-drivers"),
        "{said}"
    );
    assert!(said.contains("TEXCRD_GPU=off"), "{said}");
}
