//! From the WGSL of a translation to other shading languages, through `naga`.
//!
//! | language | what comes out | where things are bound |
//! | --- | --- | --- |
//! | SPIR-V 1.0 | one module with all entry points | descriptor sets and bindings are the groups and bindings of the WGSL |
//! | GLSL ES 3.10 | one text a stage | uniform block binding 0 (vertex), 1 (pixel); combined sampler of texture stage n at unit n |
//! | HLSL, shader model 5.1 | one text with all entry points | spaces and registers are the groups and bindings of the WGSL; samplers come from a heap |
//! | MSL 2.0 | one text with all entry points | uniform block at buffer 0 (vertex), 1 (pixel); texture and sampler of stage n at index n |
//!
//! The SPIR-V and the GLSL turn y round as their users expect it of WebGPU's clip space.

use std::fmt;
use std::str::FromStr;

use naga::back::{glsl, hlsl, msl, spv};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use crate::isa::ShaderKind;
use crate::wgsl::{Resource, StageReflection, Translation};

/// A language that translations can be written in, beside WGSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// SPIR-V, as words.
    Spirv,
    /// The OpenGL Shading Language.
    Glsl,
    /// The High-Level Shading Language of later Direct3D.
    Hlsl,
    /// The Metal Shading Language.
    Msl,
}

impl Language {
    /// All languages.
    pub const ALL: [Self; 4] = [Self::Spirv, Self::Glsl, Self::Hlsl, Self::Msl];

    /// Its name on the command line: `spirv`, `glsl`, `hlsl`, `msl`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Spirv => "spirv",
            Self::Glsl => "glsl",
            Self::Hlsl => "hlsl",
            Self::Msl => "msl",
        }
    }
}

impl fmt::Display for Language {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Language {
    type Err = String;

    /// Reads a name, in capital or small letters.
    fn from_str(text: &str) -> Result<Self, String> {
        let known = |language: &Self| language.name().eq_ignore_ascii_case(text);
        Self::ALL.into_iter().find(known).ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            format!("`{text}` is no language to translate into: wgsl, {names}")
        })
    }
}

/// A shader in another language.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// The stage, where a language has one file a stage; else none.
    pub stage: Option<ShaderKind>,
    /// The shader.
    pub code: Code,
}

/// The content of a shader file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Code {
    /// Text.
    Text(String),
    /// SPIR-V, as a file holds it: little-endian words.
    Binary(Vec<u8>),
}

impl Code {
    /// What a file holds.
    pub fn bytes(&self) -> &[u8] {
        match self {
            Self::Text(text) => text.as_bytes(),
            Self::Binary(bytes) => bytes,
        }
    }
}

/// Why a translation cannot be written in another language.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LanguageError {
    /// `naga` does not take the WGSL, which is a fault of this crate.
    Invalid(String),
    /// The language cannot express something.
    Inexpressible {
        /// The language.
        language: Language,
        /// What, in the words of `naga`.
        what: String,
    },
}

impl fmt::Display for LanguageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid(why) => write!(f, "the WGSL is not valid: {why}"),
            Self::Inexpressible { language, what } => {
                write!(f, "this cannot be expressed in {language}: {what}")
            }
        }
    }
}

impl std::error::Error for LanguageError {}

/// The module of a translation, validated.
fn parse(source: &str) -> Result<(naga::Module, ModuleInfo), LanguageError> {
    let module = naga::front::wgsl::parse_str(source)
        .map_err(|error| LanguageError::Invalid(error.emit_to_string(source)))?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
        .validate(&module)
        .map_err(|error| LanguageError::Invalid(error.emit_to_string(source)))?;
    Ok((module, info))
}

/// Has `naga` read and validate the WGSL of a translation.
///
/// # Errors
/// [`LanguageError::Invalid`], which would be a fault of this crate.
pub fn validate(translation: &Translation) -> Result<(), LanguageError> {
    parse(&translation.source).map(|_| ())
}

/// Writes a translation in another language: one shader, or for GLSL one a stage, the vertex stage first.
///
/// # Errors
/// [`LanguageError`].
pub fn write(translation: &Translation, language: Language) -> Result<Vec<Written>, LanguageError> {
    let (module, info) = parse(&translation.source)?;
    let cannot = |what: String| LanguageError::Inexpressible { language, what };
    let whole = |code| vec![Written { stage: None, code }];
    match language {
        Language::Spirv => {
            let options = spv::Options {
                flags: spv::WriterFlags::ADJUST_COORDINATE_SPACE
                    | spv::WriterFlags::LABEL_VARYINGS
                    | spv::WriterFlags::DEBUG,
                ..Default::default()
            };
            let words = spv::write_vec(&module, &info, &options, None)
                .map_err(|error| cannot(error.to_string()))?;
            let bytes = words.iter().flat_map(|word| word.to_le_bytes()).collect();
            Ok(whole(Code::Binary(bytes)))
        }
        Language::Hlsl => {
            let options = hlsl::Options::default();
            let pipeline = hlsl::PipelineOptions::default();
            let mut text = String::new();
            hlsl::Writer::new(&mut text, &options, &pipeline)
                .write(&module, &info, None)
                .map_err(|error| cannot(error.to_string()))?;
            Ok(whole(Code::Text(text)))
        }
        Language::Msl => {
            let options = msl_options(translation);
            let pipeline = msl::PipelineOptions::default();
            let (text, written) = msl::write_string(&module, &info, &options, &pipeline)
                .map_err(|error| cannot(error.to_string()))?;
            for name in written.entry_point_names {
                name.map_err(|error| cannot(error.to_string()))?;
            }
            Ok(whole(Code::Text(text)))
        }
        Language::Glsl => stages(translation)
            .map(|(kind, stage)| {
                let text = glsl_text(translation, &module, &info, kind, stage).map_err(cannot)?;
                Ok(Written {
                    stage: Some(kind),
                    code: Code::Text(text),
                })
            })
            .collect(),
    }
}

/// The stages that a translation has, the vertex stage first.
fn stages(translation: &Translation) -> impl Iterator<Item = (ShaderKind, &StageReflection)> {
    let reflection = &translation.reflection;
    let vertex = reflection.vertex.iter().map(|s| (ShaderKind::Vertex, s));
    vertex.chain(reflection.pixel.iter().map(|s| (ShaderKind::Pixel, s)))
}

/// The places of all bindings in languages that number each kind of resource for itself.
fn numbered(
    translation: &Translation,
) -> impl Iterator<Item = (naga::ResourceBinding, &Resource, u8)> {
    let bindings = translation.reflection.bindings.iter();
    bindings.map(|binding| {
        let number = match &binding.resource {
            Resource::Uniform { stage, .. } => match stage {
                ShaderKind::Vertex => 0,
                ShaderKind::Pixel => 1,
            },
            Resource::Texture { stage, .. } | Resource::Sampler { stage, .. } => *stage,
        };
        let place = naga::ResourceBinding {
            group: binding.group,
            binding: binding.binding,
        };
        (place, &binding.resource, number)
    })
}

fn glsl_text(
    translation: &Translation,
    module: &naga::Module,
    info: &ModuleInfo,
    kind: ShaderKind,
    stage: &StageReflection,
) -> Result<String, String> {
    let options = glsl::Options {
        binding_map: numbered(translation)
            .map(|(place, _, number)| (place, number))
            .collect(),
        ..Default::default()
    };
    let pipeline = glsl::PipelineOptions {
        shader_stage: match kind {
            ShaderKind::Vertex => naga::ShaderStage::Vertex,
            ShaderKind::Pixel => naga::ShaderStage::Fragment,
        },
        entry_point: stage.entry.clone(),
        multiview: None,
    };
    let mut text = String::new();
    let policies = Default::default();
    glsl::Writer::new(&mut text, module, info, &options, &pipeline, policies)
        .and_then(|mut writer| writer.write())
        .map_err(|error| error.to_string())?;
    Ok(text)
}

fn msl_options(translation: &Translation) -> msl::Options {
    let resources: msl::EntryPointResources = msl::EntryPointResources {
        resources: numbered(translation)
            .map(|(place, resource, number)| {
                let mut target = msl::BindTarget::default();
                match resource {
                    Resource::Uniform { .. } => target.buffer = Some(number),
                    Resource::Texture { .. } => target.texture = Some(number),
                    Resource::Sampler { .. } => {
                        target.sampler = Some(msl::BindSamplerTarget::Resource(number));
                    }
                }
                (place, target)
            })
            .collect(),
        ..Default::default()
    };
    msl::Options {
        lang_version: (2, 0),
        per_entry_point_map: stages(translation)
            .map(|(_, stage)| (stage.entry.clone(), resources.clone()))
            .collect(),
        fake_missing_bindings: false,
        ..Default::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::SourceMap;
    use crate::kernel::{Options as Lowering, lower};
    use crate::policy::Dialect;
    use crate::wgsl::{Options, Stage, translate};

    const VERTEX: &str = "vs.1.1\nm4x4 oPos, v0, c0\nmov oT0, v7\nmov oD0, c8\n";
    const PIXEL: &str = "ps.1.1\ndef c0, 0.5, 1, 0.25, 1\ntex t0\nmul r0, t0, c0\nadd r0, r0, c1\n";

    fn pair() -> Translation {
        let mut sources = SourceMap::new();
        let mut read = |name: &str, text: &str| {
            let file = sources.add(name, text.as_bytes().to_vec()).unwrap();
            let checked = crate::listing::check(file, Dialect::default());
            let program = checked.accepted().unwrap().clone();
            let kernel = lower(&program, &Lowering::default()).unwrap();
            (program, kernel)
        };
        let (vertex, pixel) = (read("pair.vsh", VERTEX), read("pair.psh", PIXEL));
        let stage = |(program, kernel)| Stage {
            program,
            kernel,
            source: &sources,
        };
        let vertex = stage((&vertex.0, &vertex.1));
        let pixel = stage((&pixel.0, &pixel.1));
        translate(Some(vertex), Some(pixel), &Options::default()).unwrap()
    }

    fn text(written: &Written) -> &str {
        std::str::from_utf8(written.code.bytes()).unwrap()
    }

    #[test]
    fn a_pair_in_every_language() {
        let pair = pair();
        validate(&pair).unwrap();
        let spirv = write(&pair, Language::Spirv).unwrap();
        // The magic number of SPIR-V.
        assert_eq!(spirv[0].code.bytes()[..4], [0x03, 0x02, 0x23, 0x07]);
        let glsl = write(&pair, Language::Glsl).unwrap();
        let kinds: Vec<_> = glsl.iter().map(|written| written.stage).collect();
        assert_eq!(kinds, [Some(ShaderKind::Vertex), Some(ShaderKind::Pixel)]);
        assert!(text(&glsl[1]).starts_with("#version 310 es"));
        assert!(text(&glsl[1]).contains("binding = 0) uniform highp sampler2D"));
        let hlsl = write(&pair, Language::Hlsl).unwrap();
        assert!(text(&hlsl[0]).contains("SV_Target0"));
        let msl = write(&pair, Language::Msl).unwrap();
        assert!(text(&msl[0]).contains("[[sampler(0)]]"));
        assert!(text(&msl[0]).contains("[[buffer(1)]]"));
    }

    #[test]
    fn names_read_back() {
        for language in Language::ALL {
            assert_eq!(language.to_string().to_uppercase().parse(), Ok(language));
        }
        assert!(
            "cg".parse::<Language>()
                .unwrap_err()
                .contains("wgsl, spirv, glsl")
        );
    }
}
