//! How shaders compute, as the command line says it.

use texcrd::isa::Version;
use texcrd::kernel;
use texcrd::policy::{Dialect, Model, Policies, Policy, WrongPolicy};
use texcrd::program::Program;
use texcrd::scene::{LoadOptions, Scene};

/// With what numbers shaders compute.
#[derive(clap::Args)]
pub(super) struct Computing {
    /// The numbers that pixel shaders compute with: those of float (32 bits), gf3 (GeForce 3, steps of 1/255 from -1 to 1)
    /// or r200 (Radeon 8500, steps of 1/4096 from -8 to 8). docs/models.md says more.
    #[arg(long, value_name = "MODEL", default_value_t)]
    model: Model,
    #[command(flatten)]
    choices: Choices,
}

/// The same for commands that put several models side by side.
#[derive(clap::Args)]
pub(super) struct Several {
    /// The numbers that pixel shaders compute with: those of float (32 bits), gf3 (GeForce 3, steps of 1/255 from -1 to 1)
    /// or r200 (Radeon 8500, steps of 1/4096 from -8 to 8); several with commas between them are put side by side.
    /// docs/models.md says more.
    #[arg(long = "model", value_name = "MODEL", value_delimiter = ',', default_values_t = [Model::default()])]
    models: Vec<Model>,
    #[command(flatten)]
    choices: Choices,
}

/// Numeric choices.
#[derive(clap::Args)]
struct Choices {
    #[arg(long = "policy", value_name = "NAME=VALUE", value_parser = setting, help = settings())]
    settings: Vec<String>,
}

/// What can be set, the default first.
fn settings() -> String {
    let settings: Vec<String> = Policy::all()
        .map(|policy| {
            let values: Vec<&str> = policy.values().iter().map(|value| value.name).collect();
            format!("{}={}", policy.name, values.join("|"))
        })
        .collect();
    format!(
        "What instructions do where documents and hardware did not agree: {}. The first is what is done without; \
         docs/models.md says more. May be given several times",
        settings.join(", ")
    )
}

/// The value parser of `--policy`: a setting that can be made.
fn setting(text: &str) -> Result<String, WrongPolicy> {
    Policies::default().set(text).map(|()| text.to_string())
}

impl Choices {
    fn policies(&self) -> Policies {
        let mut policies = Policies::default();
        for setting in &self.settings {
            // They have been looked at when they were read.
            let _ = policies.set(setting);
        }
        policies
    }

    fn lowering(&self, model: Model) -> kernel::Options {
        kernel::Options {
            model,
            policies: self.policies(),
            ..kernel::Options::default()
        }
    }

    fn loading(&self, model: Model, dialect: Dialect) -> LoadOptions {
        LoadOptions {
            dialect,
            model,
            policies: self.policies(),
        }
    }
}

impl Computing {
    /// What a listing that stands by itself is lowered with.
    pub(super) fn lowering(&self) -> kernel::Options {
        self.choices.lowering(self.model)
    }

    /// What a scene or a case is loaded with.
    pub(super) fn loading(&self, dialect: Dialect) -> LoadOptions {
        self.choices.loading(self.model, dialect)
    }

    /// The hardware model.
    pub(super) fn model(&self) -> Model {
        self.model
    }

    /// The numeric choices.
    pub(super) fn policies(&self) -> Policies {
        self.choices.policies()
    }
}

impl Several {
    /// The models, each once, in the order in which they were named.
    pub(super) fn models(&self) -> Vec<Model> {
        let mut models = Vec::new();
        for model in &self.models {
            if !models.contains(model) {
                models.push(*model);
            }
        }
        models
    }

    /// As [`Computing::lowering`], for one of the models.
    pub(super) fn lowering(&self, model: Model) -> kernel::Options {
        self.choices.lowering(model)
    }

    /// As [`Computing::loading`], for one of the models.
    pub(super) fn loading(&self, model: Model, dialect: Dialect) -> LoadOptions {
        self.choices.loading(model, dialect)
    }
}

/// Says that a shader runs with numbers that its version never had.
pub(super) fn note(model: Model, programs: &[&Program]) {
    let later = programs
        .iter()
        .any(|program| program.version == Version::Ps14);
    if later && model == Model::Gf3 {
        anstream::eprintln!(
            "note: no part with the numbers of gf3 had ps.1.4; it runs with them all the same"
        );
    }
}

/// The same of the shaders of a scene.
pub(super) fn note_scene(model: Model, scene: &Scene) {
    let passes = scene.passes(scene.size());
    let draws = passes.iter().flat_map(|pass| &pass.draws);
    let programs: Vec<&Program> = draws.map(|draw| &*draw.pixel.program).collect();
    note(model, &programs);
}
