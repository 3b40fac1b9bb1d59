//! Pages of what `--model` and `--policy` choose.

use super::page::{Fact, Page};
use crate::policy::{Aspect, Model, Policies, Policy};

/// What the hardware models are, aspect by aspect.
pub fn models() -> Page {
    let mut page = Page::new(
        "models",
        "hardware models: the numbers that pixel shaders compute with",
    );
    page.paragraph("Written `--model NAME`; the first is what is done without. Vertex shaders compute with 32-bit floats under every model.");
    let about = |model: Model| Fact::new(model.name(), model.about());
    page.facts(Model::all().map(about).collect());
    for aspect in Aspect::all() {
        page.heading(aspect.name);
        let of = |model: Model| Fact::new(model.name(), aspect.of(model));
        page.facts(Model::all().map(of).collect());
    }
    page.see = names(Model::all().map(Model::name), "policies");
    page
}

/// What one hardware model does.
pub fn model(model: Model) -> Page {
    let mut page = Page::new(model.name(), "hardware model");
    page.paragraph(model.about());
    let written = match model == Model::default() {
        true => format!("--model {model}; the default"),
        false => format!("--model {model}"),
    };
    page.facts(vec![Fact::new("written", written)]);
    let of = |aspect: &Aspect| Fact::new(aspect.name, aspect.of(model));
    page.facts(Aspect::all().map(of).collect());
    let others = Model::all().filter(|other| *other != model);
    page.see = names(others.map(Model::name), "models");
    page
}

/// The numeric choices, each with its values.
pub fn policies() -> Page {
    let mut page = Page::new(
        "policies",
        "numeric choices: what instructions do where documents and hardware did not agree",
    );
    page.paragraph("Written `--policy NAME=VALUE`, as often as need be.");
    for policy in Policy::all() {
        page.heading(policy.name);
        page.paragraph(policy.about);
        page.facts(values(policy));
        page.paragraph(policy.why);
    }
    page.see = names(Policy::all().map(|policy| policy.name), "models");
    page
}

/// One numeric choice.
pub fn policy(policy: &Policy) -> Page {
    let mut page = Page::new(policy.name, "numeric choice");
    page.paragraph(policy.about);
    page.facts(values(policy));
    page.paragraph(policy.why);
    let value = policy.values().last().map_or("", |value| value.name);
    page.facts(vec![
        Fact::new("written", format!("--policy {}={value}", policy.name)),
        Fact::new("default", policy.get(&Policies::default())),
    ]);
    let others = Policy::all().filter(|other| other.name != policy.name);
    page.see = names(others.map(|other| other.name), "policies");
    page
}

/// The values of a choice, each with what it means.
fn values(policy: &Policy) -> Vec<Fact> {
    let default = policy.get(&Policies::default());
    let fact = |value: crate::policy::PolicyValue| {
        let text = match value.name == default {
            true => format!("{} The default.", value.about),
            false => value.about.to_string(),
        };
        Fact::new(value.name, text)
    };
    policy.values().into_iter().map(fact).collect()
}

fn names(of: impl Iterator<Item = &'static str>, last: &'static str) -> Vec<String> {
    of.chain([last]).map(str::to_string).collect()
}
