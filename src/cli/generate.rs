//! `texcrd generate`: prints a random valid shader.

use super::computing::Computing;
use super::{Failure, Outcome};
use clap::Args;
use texcrd::generate::{Options, Random, Textures, Weights, shader};
use texcrd::isa::Version;
use texcrd::policy::Policies;

/// Prints a random valid shader. The same seed gives the same shader again.
#[derive(Args)]
#[command(disable_version_flag = true)]
pub(super) struct Arguments {
    /// Version of the shader, such as vs.1.1 or ps.1.4
    #[arg(long, value_name = "VERSION", default_value = "ps.1.4", value_parser = version)]
    version: Version,
    /// Which of the shaders of the version
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Allow infinities, NaN and results that depend on rounding
    #[arg(long)]
    wild: bool,
    #[command(flatten)]
    computing: Computing,
}

/// How often what occurs: with another slot for scalar instructions there are some that leave it open.
pub(super) fn weights(computing: &Computing) -> Weights {
    let usual = Weights::default();
    match computing.policies().scalar == Policies::default().scalar {
        true => usual,
        false => Weights {
            bare_scalars: 30,
            ..usual
        },
    }
}

/// The value parser of `--version`.
pub(super) fn version(text: &str) -> Result<Version, String> {
    let fits = |v: &Version| v.name().eq_ignore_ascii_case(&text.replace('_', "."));
    Version::all().find(fits).ok_or_else(|| {
        let names: Vec<_> = Version::all().map(Version::name).collect();
        format!("it is one of {}", names.join(", "))
    })
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let options = Options {
        comparable: !arguments.wild,
        model: arguments.computing.model(),
        policies: arguments.computing.policies(),
        weights: weights(&arguments.computing),
        ..Options::new(arguments.version)
    };
    let textures =
        Textures::with_model(options.model).map_err(|e| Failure::Input(e.to_string()))?;
    let made = shader(&mut Random::new(arguments.seed), &options, &textures);
    super::print(&made.listing)
}
