//! The other languages through validators of their own.

use super::tools::{Input, Tool, skipped};
use super::translations::{self, Named};
use texcrd::isa::ShaderKind;
use texcrd::languages::{Language, write};

/// All translations in a language. The extension is the one of a stage where the language has one file a stage.
fn written(language: Language, extensions: [&'static str; 2]) -> Vec<Input> {
    let mut inputs = Vec::new();
    for named in translations::all() {
        let shaders = write(&named.translation, language);
        for shader in shaders.unwrap_or_else(|error| panic!("{}: {error}", named.name)) {
            let extension = match shader.stage {
                Some(ShaderKind::Vertex) | None => extensions[0],
                Some(ShaderKind::Pixel) => extensions[1],
            };
            inputs.push(Input {
                name: named.name.clone(),
                extension,
                content: shader.code.bytes().to_vec(),
            });
        }
    }
    inputs
}

#[test]
fn spirv_val_takes_the_spirv() {
    let arguments = ["--target-env", "vulkan1.0"];
    let Some(validator) = Tool::find("TEXCRD_SPIRV_VAL", "spirv-val", &arguments, 1) else {
        return skipped(
            "no `spirv-val` checks the SPIR-V",
            "It is in Debian's spirv-tools.",
        );
    };
    validator.accept_all("spirv", &written(Language::Spirv, ["spv"; 2]));
}

#[test]
fn glslang_takes_the_glsl() {
    let Some(validator) = Tool::find("TEXCRD_GLSLANG", "glslangValidator", &[], 50) else {
        return skipped(
            "no `glslangValidator` checks the GLSL",
            "It is in Debian's glslang-tools.",
        );
    };
    validator.accept_all("glsl", &written(Language::Glsl, ["vert", "frag"]));
}

/// Microsoft's own compiler is in no package of Debian, npm or PyPI; glslang reads HLSL too. It takes a tenth of a second
/// for each, so it sees every eighth translation only.
#[test]
fn glslang_takes_the_hlsl() {
    let whole = |named: &Named| write(&named.translation, Language::Hlsl);
    for (stage, entry) in [("vert", "vs_main"), ("frag", "ps_main")] {
        // It checks HLSL only on the way to SPIR-V.
        let nowhere = if cfg!(windows) { "NUL" } else { "/dev/null" };
        let arguments = ["-D", "-V", "-S", stage, "-e", entry, "-o", nowhere];
        let Some(validator) = Tool::find("TEXCRD_GLSLANG", "glslangValidator", &arguments, 1)
        else {
            return skipped(
                "no `glslangValidator` checks the HLSL",
                "It is in Debian's glslang-tools.",
            );
        };
        let has_stage = |named: &&Named| {
            let reflection = &named.translation.reflection;
            let stages = reflection.vertex.iter().chain(&reflection.pixel);
            { stages }.any(|stage| stage.entry == entry)
        };
        let inputs: Vec<Input> = (translations::all().iter())
            .filter(has_stage)
            .step_by(8)
            .map(|named| Input {
                name: named.name.clone(),
                extension: "hlsl",
                content: whole(named).unwrap()[0].code.bytes().to_vec(),
            })
            .collect();
        validator.accept_all(&format!("hlsl_{stage}"), &inputs);
    }
}

/// Apple's compiler is for its own systems only: here it is only tested that there is something to compile.
#[test]
fn all_becomes_msl() {
    for input in written(Language::Msl, ["metal"; 2]) {
        let text = String::from_utf8(input.content).unwrap();
        assert!(text.contains("#include <metal_stdlib>"), "{}", input.name);
    }
}
