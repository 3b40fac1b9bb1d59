//! What words mean: versions, mnemonics with their suffixes, registers, component letters.

use super::confuse::{digits_of, distance, only_reading, readings, reads_as};
use crate::isa::modifier::{SATURATION, SHIFTS};
use crate::isa::operand::{RGBA, XYZW};
use crate::isa::register::{number, rast_out};
use crate::isa::{Opcode, RegisterFile, ShaderKind, SourceModifier, Version};
use crate::program::Usage;

/// A name as it was found.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Found<T> {
    /// Written so.
    Exact(T),
    /// Written otherwise, but it can be nothing else; with the text that was meant.
    Misread(T, String),
    /// No name, or more than one could be meant.
    No,
}

impl<T> Found<T> {
    fn of(exact: Option<T>, reading: impl FnOnce() -> Option<(T, String)>) -> Self {
        match exact {
            Some(found) => Self::Exact(found),
            None => reading().map_or(Self::No, |(found, name)| Self::Misread(found, name)),
        }
    }
}

// --- versions ---

/// How a version instruction is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum VersionText {
    /// As it should be.
    Exact(Version),
    /// Dots and underscores mixed.
    Mixed(Version),
    /// Misread, but it can be no other.
    Misread(Version),
    /// No version of Direct3D 8.
    Unknown,
}

/// Reads a version; `Unknown` also for text that is none at all.
pub(super) fn version(text: &[u8]) -> VersionText {
    let text = text.to_ascii_lowercase();
    let Ok(text) = std::str::from_utf8(&text) else {
        return VersionText::Unknown;
    };
    let underscores = |v: Version| v.name().replace('.', "_");
    if let Some(v) = Version::all().find(|v| text == v.name() || text == underscores(*v)) {
        return VersionText::Exact(v);
    }
    let is_separator = |c: char| matches!(c, '.' | '_' | ',' | '-' | ' ' | '\t');
    let bare = |text: &str| text.replace(is_separator, "");
    let bare_text = bare(text);
    let names = || Version::all().map(|v| (v, bare(v.name())));
    if let Some((v, _)) = names().find(|(_, name)| *name == bare_text) {
        let mixed = text.len() == v.name().len()
            && text.chars().filter(|c| is_separator(*c)).count() == 2
            && !text.contains([' ', ',', '-', '\t']);
        return if mixed {
            VersionText::Mixed(v)
        } else {
            VersionText::Misread(v)
        };
    }
    // Only the digits and the s are read by their shape: p and v are what tells the kinds apart.
    match only_reading(&bare_text, names()) {
        Some((v, _)) => VersionText::Misread(v),
        None => VersionText::Unknown,
    }
}

// --- mnemonics ---

/// The opcode of a mnemonic without suffixes.
pub(super) fn opcode(stem: &str, version: Version) -> Found<Opcode> {
    let all = |here: bool| {
        Opcode::all()
            .filter(move |op| op.form(version).is_some() == here && *op != Opcode::Dcl)
            .map(|op| (op, op.mnemonic().to_string()))
    };
    Found::of(Opcode::from_mnemonic(stem), || {
        only_reading(stem, all(true)).or_else(|| only_reading(stem, all(false)))
    })
}

/// Mnemonics of the version that differ from the word by a slip of the hand.
pub(super) fn near_mnemonics(stem: &str, version: Version) -> Vec<&'static str> {
    let most = if stem.len() > 4 { 2 } else { 1 };
    let near = |here: bool| -> Vec<&'static str> {
        Opcode::all()
            .filter(|op| op.form(version).is_some() == here && *op != Opcode::Dcl)
            .map(Opcode::mnemonic)
            .filter(|name| name.len() > 2 && distance(stem, name) <= most)
            .take(4)
            .collect()
    };
    let here = near(true);
    if here.is_empty() { near(false) } else { here }
}

/// How many operands an opcode has, the destination included. It is the same in every version that has it.
pub(super) fn operand_count(opcode: Opcode) -> usize {
    opcode.row().forms.first().map_or(0, |form| {
        usize::from(form.destination.is_some()) + form.sources.len()
    })
}

/// A suffix of a mnemonic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ResultSuffix {
    /// `_x2` … `_d8`
    Shift(i8),
    /// `_sat`
    Saturate,
}

/// The suffixes of mnemonics with their text, underscore included.
pub(super) fn result_suffixes() -> impl Iterator<Item = (ResultSuffix, &'static str)> {
    let shifts = SHIFTS
        .iter()
        .map(|row| (ResultSuffix::Shift(row.shift), row.suffix));
    shifts.chain([(ResultSuffix::Saturate, SATURATION.suffix)])
}

/// The result suffix of this text, underscore included.
pub(super) fn exact_result_suffix(text: &str) -> Option<ResultSuffix> {
    let mut all = result_suffixes();
    let (suffix, _) = all.find(|(_, name)| name.eq_ignore_ascii_case(text))?;
    Some(suffix)
}

/// The result suffix that this word is without its underscore.
pub(super) fn result_suffix_stem(word: &str) -> Option<ResultSuffix> {
    let stem = |name: &'static str| name.strip_prefix('_').unwrap_or(name);
    let mut all = result_suffixes();
    let (suffix, _) = all.find(|(_, name)| stem(name).eq_ignore_ascii_case(word))?;
    Some(suffix)
}

/// The result suffix that this text is or can only be a misreading of.
pub(super) fn result_suffix(text: &str) -> Found<ResultSuffix> {
    let named = |(suffix, name): (_, &str)| (suffix, name.to_string());
    Found::of(exact_result_suffix(text), || {
        only_reading(text, result_suffixes().map(named))
    })
}

/// `mulx2` → `mul_x2`: a mnemonic whose suffixes have lost their underscores.
pub(super) fn joined_suffixes(word: &str) -> Option<String> {
    const LONGEST: usize = 24;
    if word.len() > LONGEST {
        return None;
    }
    let mut stem = word.to_ascii_lowercase();
    let mut tail = String::new();
    while Opcode::from_mnemonic(&stem).is_none() {
        let lost = |(_, suffix): (_, &str)| -> Option<String> {
            stem.strip_suffix(suffix.trim_start_matches('_'))
                .filter(|rest| !rest.is_empty())
                .map(|rest| {
                    tail = format!("{suffix}{tail}");
                    rest.trim_end_matches('_').to_string()
                })
        };
        stem = result_suffixes().find_map(lost)?;
    }
    (!tail.is_empty()).then(|| stem + &tail)
}

/// Instructions of later shader models and of the Xbox, which people try.
const FOREIGN_MNEMONICS: [(&str, &[&str]); 2] = [
    (
        "a later shader model",
        &[
            "abs", "break", "call", "callnz", "crs", "defb", "defi", "dp2add", "dsx", "dsy",
            "else", "endif", "endloop", "endrep", "if", "ifc", "label", "loop", "mova", "nrm",
            "pow", "ret", "setp", "sgn", "sincos", "texldb", "texldd", "texldl", "texldp",
        ],
    ),
    (
        "the Xbox",
        &["dph", "rcc", "xdd", "xdm", "xfc", "xmma", "xmmc"],
    ),
];

/// Where an instruction belongs that Direct3D 8 does not have.
pub(crate) fn foreign_mnemonic(stem: &str) -> Option<&'static str> {
    let has = |names: &[&str]| names.iter().any(|n| n.eq_ignore_ascii_case(stem));
    FOREIGN_MNEMONICS
        .iter()
        .find(|(_, names)| has(names))
        .map(|(owner, _)| *owner)
}

// --- registers ---

/// A word that names a register.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Name {
    /// A register by its number.
    Register(RegisterFile, u32),
    /// The letters alone: `c` of `c[12]`.
    File(RegisterFile),
    /// A number that no register can have.
    TooLarge,
}

/// The register that a word names, whether the version has it or not.
pub(super) fn exact_register(stem: impl AsRef<[u8]>) -> Option<Name> {
    let stem = stem.as_ref();
    match RegisterFile::parts(stem) {
        Some((file, [])) => Some(Name::File(file)),
        Some((file, digits)) => Some(match number(digits) {
            Some(number) => Name::Register(file, number),
            None => Name::TooLarge,
        }),
        None => Some(Name::Register(RegisterFile::RastOut, rast_out(stem)?)),
    }
}

/// What a word names up to its first underscore, whatever stands around it. It is found once, because a parser asks for
/// it again and again.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stem {
    /// How many bytes stand before the first underscore.
    pub(super) length: u32,
    pub(super) opcode: Option<Opcode>,
    pub(super) register: Option<Name>,
}

impl Stem {
    /// What no word names.
    pub(super) const NONE: Self = Self {
        length: 0,
        opcode: None,
        register: None,
    };

    pub(super) fn of(word: &[u8]) -> Self {
        let length = word.iter().position(|b| *b == b'_').unwrap_or(word.len());
        let stem = word.get(..length).unwrap_or(word);
        let register = exact_register(stem);
        Self {
            length: length as u32,
            // No register is a mnemonic, which a test of `isa` holds.
            opcode: match register {
                None => Opcode::from_mnemonic(stem),
                Some(_) => None,
            },
            register,
        }
    }
}

/// The register that a word names or can only be a misreading of, among those of the version.
pub(super) fn register(stem: &str, version: Version) -> Found<Name> {
    Found::of(exact_register(stem), || {
        only_reading(stem, registers_of(version))
    })
}

/// The registers that a word can be a misreading of, among those of the version; a few.
pub(super) fn possible_registers(stem: &str, version: Version) -> Vec<String> {
    const MOST: usize = 4;
    let found = readings(stem, registers_of(version)).map(|(_, name)| name);
    found.take(MOST).collect()
}

/// The registers of a version with their names.
fn registers_of(version: Version) -> impl Iterator<Item = (Name, String)> {
    RegisterFile::all().flat_map(move |file| {
        (0..file.count(version)).map(move |i| (Name::Register(file, i), file.register_name(i)))
    })
}

/// The whole numbers that a word with letters for digits can be.
pub(super) fn whole_numbers(word: &str) -> Vec<String> {
    let mut meant = digit_readings(word);
    meant.retain(|number| number.parse::<u32>().is_ok());
    meant
}

/// What a word is when its letters stand for digits; a few readings.
pub(super) fn digit_readings(word: &str) -> Vec<String> {
    const LONGEST: usize = 24;
    const MOST: usize = 4;
    if word.len() > LONGEST {
        return Vec::new();
    }
    let mut meant = vec![String::new()];
    for letter in word.chars() {
        let readings = digits_of(letter);
        meant = meant
            .iter()
            .flat_map(|begun| readings.iter().map(move |r| format!("{begun}{r}")))
            .take(MOST)
            .collect();
    }
    meant
}

/// What a register of a later shader model is for.
pub(super) fn foreign_register(stem: &str) -> Option<&'static str> {
    let stem = stem.to_ascii_lowercase();
    if matches!(stem.as_str(), "odepth" | "vpos" | "vface" | "al") {
        return Some("a register of later shader models");
    }
    let numbered = |prefix: &str| {
        stem.strip_prefix(prefix)
            .is_some_and(|n| !n.is_empty() && n.len() < 4 && n.bytes().all(|b| b.is_ascii_digit()))
    };
    [
        ("s", "a sampler register of later shader models; Direct3D 8 takes the stage from the number of t# or r#"),
        ("b", "a boolean register of later shader models"),
        ("i", "an integer register of later shader models"),
        ("p", "a predicate register of later shader models"),
        ("oc", "a colour output of later shader models; here a pixel shader leaves its result in r0"),
        ("o", "an output register of later shader models; here they are called oPos, oFog, oPts, oD# and oT#"),
    ]
    .into_iter()
    .find(|(prefix, _)| numbered(prefix))
    .map(|(_, what)| what)
}

// --- suffixes and letters of operands ---

/// The source suffix of this text, underscore included, in its first spelling.
pub(super) fn source_suffix(text: &str) -> Found<&'static str> {
    let all = || SourceModifier::suffixes().map(|s| (s, s.to_string()));
    let exact = SourceModifier::suffixes().find(|s| s.eq_ignore_ascii_case(text));
    Found::of(exact, || only_reading(text, all()))
}

/// Whether a word is a suffix without its underscore.
pub(super) fn is_source_suffix_stem(word: &str) -> bool {
    let stem = |suffix: &'static str| suffix.strip_prefix('_').unwrap_or(suffix);
    SourceModifier::suffixes().any(|s| stem(s).eq_ignore_ascii_case(word))
}

/// One to four components in the order in which they are written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Components {
    list: [u8; 4],
    count: u8,
}

impl Components {
    /// With one more; the same if there are four.
    fn with(mut self, component: u8) -> Self {
        if let Some(slot) = self.list.get_mut(usize::from(self.count)) {
            *slot = component;
            self.count += 1;
        }
        self
    }

    /// Their numbers, 0 to 3.
    pub(super) fn list(&self) -> &[u8] {
        self.list.get(..usize::from(self.count)).unwrap_or(&[])
    }

    /// Whether they stand in order and none twice, as in a write mask.
    pub(super) fn in_order(&self) -> bool {
        self.list().is_sorted_by(|a, b| a < b)
    }
}

/// Component letters behind a dot: up to four components.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Letters {
    /// As written.
    Exact(Components),
    /// Misread; what they can be, with the text that was meant.
    Misread(Vec<(Components, String)>),
    /// Letters of both sets.
    Mixed,
    /// More than four.
    TooMany,
    /// `stpq` and `uvwq`, which other languages have.
    OtherLanguage,
    /// No component letters.
    No,
}

/// Reads the letters behind a dot.
pub(super) fn letters(text: &str) -> Letters {
    let exact = |set: [char; 4]| {
        text.bytes()
            .try_fold(Components::default(), |begun, letter| {
                let letter = letter.to_ascii_lowercase();
                let at = set.iter().position(|c| *c == char::from(letter))?;
                Some(begun.with(at as u8))
            })
    };
    let sets = [XYZW, RGBA];
    let in_sets = |c: char| sets.iter().flatten().any(|s| s.eq_ignore_ascii_case(&c));
    if let Some(components) = sets.into_iter().find_map(exact) {
        return match text.len() {
            0 => Letters::No,
            1..=4 => Letters::Exact(components),
            _ => Letters::TooMany,
        };
    }
    if text.chars().all(in_sets) {
        return Letters::Mixed;
    }
    let readings: Vec<_> = sets
        .into_iter()
        .flat_map(|set| misread(text, set))
        .collect();
    if !readings.is_empty() {
        return Letters::Misread(readings);
    }
    if text
        .chars()
        .all(|c| "stpquvw".contains(c.to_ascii_lowercase()))
    {
        Letters::OtherLanguage
    } else {
        Letters::No
    }
}

/// The components of one set that a text can be a misreading of. A letter of the set is never misread; `vv` is two
/// letters or the `w` that a scanner has split.
fn misread(text: &str, set: [char; 4]) -> Vec<(Components, String)> {
    // Two letters for each of four components.
    const LONGEST: usize = 8;
    let mut whole = Vec::new();
    if text.len() > LONGEST || !text.is_ascii() {
        return whole;
    }
    let mut begun = vec![(text, Components::default(), String::new())];
    while let Some((rest, components, meant)) = begun.pop() {
        if rest.is_empty() {
            whole.push((components, meant));
            continue;
        }
        if components.list().len() == 4 {
            continue;
        }
        let one = rest.get(..1).unwrap_or("");
        let exact = set.iter().any(|c| one.eq_ignore_ascii_case(&c.to_string()));
        for (i, letter) in set.into_iter().enumerate().rev() {
            for length in [2, 1] {
                let (Some(part), Some(after)) = (rest.get(..length), rest.get(length..)) else {
                    continue;
                };
                let reads = if length == 1 && exact {
                    part.eq_ignore_ascii_case(&letter.to_string())
                } else {
                    reads_as(part, &letter.to_string())
                };
                if reads {
                    let components = components.with(i as u8);
                    begun.push((after, components, format!("{meant}{letter}")));
                }
            }
        }
    }
    whole
}

/// The usage of a `dcl` with its index: `texcoord0` is texture coordinates 0.
pub(super) fn usage(text: &str) -> Found<(Usage, Option<u8>)> {
    let stem = text.trim_end_matches(|c: char| c.is_ascii_digit());
    let index = text.strip_prefix(stem).unwrap_or("");
    // `None` for an index that is no declaration index; the caller reports it.
    let number = match index {
        "" => Some(0),
        _ => index.parse().ok().filter(|i| *i < 16),
    };
    let all = || Usage::all().map(|(usage, name)| (usage, name.to_string()));
    match Found::of(Usage::from_name(stem), || only_reading(stem, all())) {
        Found::Exact(usage) => Found::Exact((usage, number)),
        Found::Misread(usage, name) => Found::Misread((usage, number), name + index),
        Found::No => Found::No,
    }
}

/// Whether letters and kind allow a suffix on a source: vertex shaders have none.
pub(super) fn has_source_suffixes(version: Version) -> bool {
    version.kind() == ShaderKind::Pixel
}
