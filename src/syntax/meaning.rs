//! What an operand means in its place: as a destination, as a source.

use super::names;
use super::operand::{Written, WrittenRegister};
use super::parser::Parser;
use super::report::quote;
use super::rules;
use crate::isa::{SourceModifier, Swizzle, WriteMask};
use crate::program::{Destination, Source, letters};
use crate::rules::model;

impl Parser<'_> {
    /// The operand as a destination; `None` if it was reported.
    pub(super) fn destination(&mut self, operand: &Written) -> Option<Destination> {
        let Written::Register(written) = operand else {
            self.no_number(operand);
            return None;
        };
        if written.damaged {
            return None;
        }
        if !written.prefix.is_empty() || !written.suffix.is_empty() {
            let message = "a destination takes no source modifier";
            let help = "modify the result with a suffix of the mnemonic";
            self.error(&rules::SOURCE_MODIFIER, written.span, message, help);
            return None;
        }
        let mask = mask(written);
        if !written.components.is_none_or(|c| c.in_order()) {
            let meant = match mask.text(letters(self.version.kind())) {
                text if text.is_empty() => "no mask".to_string(),
                text => format!("`{text}`"),
            };
            let text = self.text_of(written.components_span);
            let message = format!("{} is no write mask", quote(text));
            let help = format!("a mask names components in order and none twice: {meant}");
            self.error(&model::O24, written.components_span, message, &help);
            return None;
        }
        Some(Destination {
            register: written.register,
            mask,
            span: written.span,
        })
    }

    /// The operand as a source; `None` if it was reported.
    pub(super) fn source(&mut self, operand: &Written) -> Option<Source> {
        let Written::Register(written) = operand else {
            self.no_number(operand);
            return None;
        };
        if written.damaged {
            return None;
        }
        let Some(modifier) = SourceModifier::from_text(written.prefix, written.suffix) else {
            let message = format!(
                "`{}` and `{}` do not go together",
                written.prefix, written.suffix
            );
            let (rule, help) = match written.prefix {
                "1-" => (
                    &model::M4,
                    "`1-` goes with no other modifier; compute one of them into a register first",
                ),
                _ => (
                    &rules::SOURCE_MODIFIER,
                    "a division goes with no minus sign",
                ),
            };
            self.error(rule, written.span, message, help);
            return None;
        };
        let plain = matches!(modifier, SourceModifier::None | SourceModifier::Negate);
        if !plain && !names::has_source_suffixes(self.version) {
            let text = [written.prefix, written.suffix].concat();
            let message = format!("`{text}` is a modifier of pixel shaders");
            let help = "a source of a vertex shader takes only `-`";
            self.error(&model::O23, written.span, message, help);
            return None;
        }
        Some(Source {
            register: written.register,
            swizzle: swizzle(written),
            modifier,
            span: written.span,
        })
    }

    fn no_number(&mut self, operand: &Written) {
        if let Written::Number(span) = *operand {
            let message = "a number stands where a register should";
            let help = "define a constant with `def` and name it here";
            self.error(&rules::REGISTER, span, message, help);
        }
    }
}

/// The swizzle that the letters of an operand mean.
pub(super) fn swizzle(written: &WrittenRegister) -> Swizzle {
    let components = written.components.as_ref();
    components
        .and_then(|components| Swizzle::from_components(components.list()))
        .unwrap_or(Swizzle::IDENTITY)
}

/// The components that a destination names, in whatever order.
pub(super) fn mask(written: &WrittenRegister) -> WriteMask {
    match &written.components {
        None => WriteMask::ALL,
        Some(components) => components
            .list()
            .iter()
            .map(|c| WriteMask::component((*c).into()))
            .fold(WriteMask::NONE, WriteMask::or),
    }
}
