//! Listings to modules, and modules through `naga`.

use crate::diagnostic::SourceMap;
use crate::kernel::{self, Kernel};
use crate::program::{Program, Statement};
use crate::wgsl::{Options, Stage, Translation, translate};
use crate::{isa::ShaderKind, syntax};

/// A listing, parsed and lowered.
pub(super) struct Shader {
    pub(super) program: Program,
    pub(super) kernel: Kernel,
    source: SourceMap,
}

impl Shader {
    pub(super) fn new(listing: &str) -> Self {
        Self::projected(listing, &kernel::Options::default())
    }

    pub(super) fn projected(listing: &str, options: &kernel::Options) -> Self {
        let mut source = SourceMap::new();
        let parsed = syntax::parse(source.add("listing", listing).unwrap());
        assert!(
            parsed.diagnostics.is_empty(),
            "{listing}\n{:?}",
            parsed.diagnostics
        );
        let program = parsed.program.unwrap();
        let kernel = kernel::lower(&program, options).unwrap();
        Self {
            program,
            kernel,
            source,
        }
    }

    /// Gives every constant that is defined another value.
    pub(super) fn redefine(&mut self, value: [f32; 4]) {
        for statement in &mut self.program.statements {
            if let Statement::Def(def) = statement {
                def.value = value;
            }
        }
        for (_, defined) in &mut self.kernel.definitions {
            *defined = value;
        }
    }

    pub(super) fn stage(&self) -> Stage<'_> {
        Stage {
            program: &self.program,
            kernel: &self.kernel,
            source: &self.source,
        }
    }

    pub(super) fn translate(&self, options: &Options) -> Translation {
        let stage = Some(self.stage());
        let result = match self.kernel.version.kind() {
            ShaderKind::Vertex => translate(stage, None, options),
            ShaderKind::Pixel => translate(None, stage, options),
        };
        result.unwrap()
    }
}

/// Parses and validates WGSL.
pub(super) fn validate(source: &str) -> naga::Module {
    let module = match naga::front::wgsl::parse_str(source) {
        Ok(module) => module,
        Err(error) => panic!("{}\n{source}", error.emit_to_string(source)),
    };
    let mut validator = naga::valid::Validator::new(
        naga::valid::ValidationFlags::all(),
        naga::valid::Capabilities::empty(),
    );
    if let Err(error) = validator.validate(&module) {
        panic!("{}\n{source}", error.emit_to_string(source));
    }
    module
}

/// Translates a listing and validates what comes out.
pub(super) fn valid(listing: &str, options: &Options) -> Translation {
    let translation = Shader::new(listing).translate(options);
    validate(&translation.source);
    translation
}

/// The same for a linked pair.
pub(super) fn valid_pair(vertex: &Shader, pixel: &Shader, options: &Options) -> Translation {
    let translation = translate(Some(vertex.stage()), Some(pixel.stage()), options).unwrap();
    validate(&translation.source);
    translation
}

/// The functions of a module with their whole text, in order; entry points included.
pub(super) fn functions(source: &str) -> Vec<(String, String)> {
    let starts = source.match_indices("\nfn ").map(|(at, _)| at + 1);
    starts
        .map(|at| {
            let text = &source[at..];
            let end = text.find("\n}\n").unwrap();
            let name = text["fn ".len()..].split('(').next().unwrap();
            (name.to_string(), text[..end].to_string())
        })
        .collect()
}

/// The numbers and texts of the comments that quote lines.
pub(super) fn quoted(function: &str) -> Vec<(usize, String)> {
    (function.lines())
        .filter_map(|line| {
            let (number, text) = line.trim_start().strip_prefix("// ")?.split_once(": ")?;
            Some((number.parse().ok()?, text.to_string()))
        })
        .collect()
}

/// What is true of every translation: each line of the listing is quoted once and in order, and no function is there
/// that nobody calls.
pub(super) fn check_form(listing: &str, entry: &str, source: &str) {
    let functions = functions(source);
    let (_, text) = functions.iter().find(|(name, _)| name == entry).unwrap();
    let lines = listing.lines().map(|line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        words.join(" ")
    });
    let expected: Vec<(usize, String)> = (1..)
        .zip(lines)
        .filter(|(_, line)| !line.is_empty())
        .collect();
    assert_eq!(quoted(text), expected, "{source}");
    for (name, _) in functions
        .iter()
        .filter(|(name, _)| !name.ends_with("_main"))
    {
        let calls = source.matches(&format!("{name}(")).count();
        assert!(calls > 1, "nobody calls {name}\n{source}");
    }
}
