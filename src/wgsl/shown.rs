//! A register that is shown in place of the colour.

use super::body::{Body, Pending};
use super::expression::construct;
use super::{Shown, ShownPixels};
use crate::isa::ShaderKind;
use crate::kernel::Slot;

/// The name of what is shown while the shader goes on.
const SHOWN: &str = "shown";

impl Body<'_> {
    /// The register that a pixel shader returns in place of its colour.
    pub(super) fn shown(&self) -> Option<Shown> {
        (self.options.show).filter(|_| self.kind() == ShaderKind::Pixel)
    }

    /// The register that is shown while the shader goes on, for what becomes of the pixel is decided behind it.
    pub(super) fn shown_on_the_way(&self) -> Option<Shown> {
        let kernel = self.stage.kernel;
        let decides = kernel.kills() || kernel.writes_depth();
        self.shown()
            .filter(|shown| decides && shown.pixels != ShownPixels::All)
    }

    /// The register that is shown, with all four components.
    pub(super) fn shown_content(&self, slot: Slot) -> String {
        if self.captured {
            return SHOWN.to_owned();
        }
        // Registers that only vertex shaders have are 0 here.
        let absent = slot == Slot::ADDRESS || (2..16).any(|i| Slot::input(i) == Some(slot));
        let width = if absent { 0 } else { self.width(slot) };
        let name = Some(self.name(slot)).filter(|_| width > 0);
        let missing = std::iter::repeat_n("0.0".to_string(), 4_usize.saturating_sub(width));
        let parts: Vec<String> = name.into_iter().chain(missing).collect();
        match parts.as_slice() {
            [whole] => whole.clone(),
            _ => construct(parts, 4).text,
        }
    }

    /// Keeps the register that is shown as it is now. Writes that wait count, but go on waiting.
    pub(super) fn capture(&mut self, slot: Slot, pending: &[Pending<'_>]) {
        let own = || {
            pending
                .iter()
                .filter(|write| write.step.destination == slot)
        };
        let name = self.name(slot);
        let waits = own().next().is_some();
        if waits {
            self.push(format_args!("let before_{SHOWN} = {name};"));
        }
        for write in own() {
            self.assign(slot, write.step.mask, write.value.clone());
        }
        let content = self.shown_content(slot);
        self.push(format_args!("let {SHOWN} = {content};"));
        if waits {
            self.push(format_args!("{name} = before_{SHOWN};"));
        }
        self.captured = true;
    }
}
