//! `--show`: which register to picture.

use std::str::FromStr;
use texcrd::isa::{RegisterFile, Version};
use texcrd::kernel::Slot;
use texcrd::program::Register;
use texcrd::raster::View;

/// A register at a place of a listing, such as `r2@12`, `r0.a` or `oT5`.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Show {
    file: RegisterFile,
    index: u32,
    /// The component that is shown as grey; none: x, y and z as a colour.
    component: Option<usize>,
    /// The line of the listing after which the register is looked at; none: at the end.
    pub(super) line: Option<usize>,
}

impl FromStr for Show {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong =
            || format!("`{text}` is no register at a line: write r2@12, r0.a, t5, v0 or oT5");
        let (register, line) = match text.split_once('@') {
            Some((register, line)) => (register, Some(line.parse().map_err(|_| wrong())?)),
            None => (text, None),
        };
        let (name, component) = match register.split_once('.') {
            Some((name, letter)) => {
                let at = |letters: &str| letters.find(letter).filter(|_| letter.len() == 1);
                (name, Some(at("xyzw").or(at("rgba")).ok_or_else(wrong)?))
            }
            None => (register, None),
        };
        // Files whose prefix begins another's come last.
        let files = [
            RegisterFile::TexCrdOut,
            RegisterFile::AttrOut,
            RegisterFile::Temp,
            RegisterFile::Texture,
            RegisterFile::Input,
        ];
        let (file, index) = files
            .into_iter()
            .find_map(|file| {
                let (prefix, index) = name.split_at_checked(file.row().prefix.len())?;
                let fits = prefix.eq_ignore_ascii_case(file.row().prefix);
                Some((file, index.parse().ok().filter(|_| fits)?))
            })
            .ok_or_else(wrong)?;
        Ok(Self {
            file,
            index,
            component,
            line,
        })
    }
}

impl Show {
    /// Where a pixel shader of this version has the register. Outputs of the vertex shader are shown as they reach
    /// the pixel: interpolated.
    pub(super) fn slot(&self, version: Version) -> Result<Slot, String> {
        let index = self.index as usize;
        let (slot, whose) = match self.file {
            RegisterFile::TexCrdOut => (Slot::texcoord(index), "a vertex shader".to_string()),
            RegisterFile::AttrOut => {
                let color = Slot::input(index).filter(|_| index < 2);
                (color, "a vertex shader".to_string())
            }
            file => (
                Slot::of(Register::new(file, self.index), version),
                version.to_string(),
            ),
        };
        slot.ok_or_else(|| format!("{whose} has no {}", self.file.register_name(self.index)))
    }

    /// What of the register is shown.
    pub(super) fn view(&self, magnitude: bool) -> View {
        match self.component {
            Some(component) => View::Component(component),
            None if magnitude => View::Magnitude,
            None => View::Color,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn show(text: &str) -> Show {
        text.parse().unwrap()
    }

    #[test]
    fn registers_and_places() {
        assert_eq!(show("r2@12").line, Some(12));
        assert_eq!(show("r2@12").slot(Version::Ps14).ok(), Slot::temp(2));
        assert!(show("r5").slot(Version::Ps11).is_err());
        assert!(show("oT9").slot(Version::Ps14).is_err());
        assert_eq!(show("oT5").slot(Version::Ps14).ok(), Slot::texcoord(5));
        assert_eq!(show("t1").slot(Version::Ps14).ok(), Slot::texcoord(1));
        assert_eq!(show("t1").slot(Version::Ps11).ok(), Slot::texture(1));
        assert_eq!(show("OD1.a").slot(Version::Ps11).ok(), Slot::input(1));
        assert_eq!(show("oD1.a").view(true), View::Component(3));
        assert_eq!(show("r0").view(true), View::Magnitude);
    }

    #[test]
    fn everything_else_is_refused() {
        for text in [
            "", "r", "x0", "r2@", "r2@x", "r0.q", "r0.xy", "c0", "oPos", "oD2.x.y", "é0",
        ] {
            let parsed = text.parse::<Show>();
            assert!(parsed.is_err(), "{text}: {parsed:?}");
        }
    }
}
