//! With which numbers a case computes, where it says so.

use crate::policy::Policy;
use crate::scene::error::{Problems, rules};
use crate::scene::files::Files;
use crate::scene::section::Section;

/// Reads `model` and `policies`: what a case says of them holds, whatever else it is loaded with.
pub(super) fn computing(s: &mut Section<'_>, files: &mut Files<'_>, problems: &mut Problems) {
    let options = files.options_mut();
    options.model = s.named("model", options.model, problems);
    let Some(mut table) = s.table("policies", problems) else {
        return;
    };
    for node in table.rest() {
        let (key, span) = (node.key.clone(), node.key_span);
        let Some(value) = node.read::<String>(problems) else {
            continue;
        };
        if let Err(wrong) = options.policies.set(&format!("{key}={}", value.value)) {
            let known = Policy::named(&key).is_some();
            let (rule, span) = match known {
                true => (&rules::VALUE, value.span),
                false => (&rules::KEY, span),
            };
            problems.error(rule, span, wrong.to_string());
        }
    }
}
