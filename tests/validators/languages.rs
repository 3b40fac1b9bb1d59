//! The other languages through validators of their own.

use super::tools::{Input, Tool, skipped};
use super::translations;
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
