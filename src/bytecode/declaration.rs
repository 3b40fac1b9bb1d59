//! Vertex declarations: arrays of `D3DVSD_` tokens, which say where the elements of a vertex come from.

use super::macros::{self, DATA_TYPES, Macro, Misfit};
use super::report::{Reports, tokens};
use super::{MOST_ITEMS, MOST_TOKENS, rules};
use crate::diagnostic::{Diagnostic, Span};
use crate::isa::register::VERTEX_CONSTANTS;
use crate::rules::model;

/// A vertex declaration, without the token that ends it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Declaration {
    /// Its elements in order.
    pub elements: Vec<Element>,
}

/// An element of a vertex declaration.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// What it is.
    pub kind: ElementKind,
    /// Where it stands; in tokens if it was decoded.
    pub span: Span,
}

/// What an element of a vertex declaration does. Data lie in a vertex in the order of the elements, without gaps but for
/// [`ElementKind::Skip`].
#[derive(Clone, Debug, PartialEq)]
pub enum ElementKind {
    /// `D3DVSD_NOP()`: nothing.
    Nop,
    /// `D3DVSD_STREAM(n)`: what follows comes from stream n, 0 to 15, from its beginning.
    Stream(u8),
    /// `D3DVSD_STREAM_TESS()`: what follows comes from the tessellator.
    StreamTess,
    /// `D3DVSD_REG(register, type)`: loads a register, 0 to 31.
    Reg {
        /// The register.
        register: u8,
        /// What is loaded.
        data: DataType,
    },
    /// `D3DVSD_SKIP(n)`: leaves n times four bytes out, 0 to 15.
    Skip(u8),
    /// `D3DVSD_TESSNORMAL(from, to)`: the tessellator makes normals.
    TessNormal {
        /// The register of the positions that they are made of, 0 to 15.
        from: u8,
        /// The register that they go to, 0 to 31.
        to: u8,
    },
    /// `D3DVSD_TESSUV(register)`: the tessellator makes surface parameters, for a register from 0 to 31.
    TessUv(u8),
    /// `D3DVSD_CONST(address, count)` and four numbers for each: loads constants when the shader is set.
    Const {
        /// The first constant, 0 to 127.
        address: u8,
        /// The constants, at most 15.
        values: Vec<[f32; 4]>,
    },
    /// The token of extensions, which no documented extension uses, with what belongs to it.
    Ext {
        /// Bits 23:0.
        info: u32,
        /// What follows, at most 31 words.
        words: Vec<u32>,
    },
}

/// A type of vertex data (`D3DVSDT_…`). Components that it does not have are 0, and 1 for w.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DataType {
    /// One number.
    Float1,
    /// Two numbers.
    Float2,
    /// Three numbers.
    Float3,
    /// Four numbers.
    Float4,
    /// Blue, green, red and alpha as bytes, for 0 to 1.
    D3dColor,
    /// Four bytes, for 0 to 255.
    UByte4,
    /// Two signed 16-bit integers.
    Short2,
    /// Four signed 16-bit integers.
    Short4,
}

impl DataType {
    const ALL: [Self; 8] = [
        Self::Float1,
        Self::Float2,
        Self::Float3,
        Self::Float4,
        Self::D3dColor,
        Self::UByte4,
        Self::Short2,
        Self::Short4,
    ];

    /// The name in `d3d8types.h`.
    pub fn name(self) -> &'static str {
        DATA_TYPES[self as usize].0
    }

    /// How many bytes a vertex has of it.
    pub fn bytes(self) -> u32 {
        DATA_TYPES[self as usize].1
    }
}

impl ElementKind {
    /// The macro of its first token, with the arguments.
    fn head(&self) -> (&'static Macro, Vec<u32>) {
        match self {
            Self::Nop => (&macros::NOP, vec![]),
            Self::Stream(number) => (&macros::STREAM, vec![(*number).into()]),
            Self::StreamTess => (&macros::STREAM_TESS, vec![]),
            Self::Reg { register, data } => (&macros::REG, vec![(*register).into(), *data as u32]),
            Self::Skip(count) => (&macros::SKIP, vec![(*count).into()]),
            Self::TessNormal { from, to } => {
                (&macros::TESSNORMAL, vec![(*from).into(), (*to).into()])
            }
            Self::TessUv(register) => (&macros::TESSUV, vec![(*register).into()]),
            Self::Const { address, values } => {
                (&macros::CONST, vec![(*address).into(), values.len() as u32])
            }
            Self::Ext { info, words } => (&macros::EXT, vec![*info, words.len() as u32]),
        }
    }

    /// What follows its first token.
    fn rest(&self) -> Vec<u32> {
        match self {
            Self::Const { values, .. } => values.iter().flatten().map(|v| v.to_bits()).collect(),
            Self::Ext { words, .. } => words.clone(),
            _ => Vec::new(),
        }
    }

    /// The element with this macro and these arguments, and how many words belong to it; those are still missing.
    fn of(of: &'static Macro, [a, b]: [u32; 2]) -> (Self, usize) {
        let byte = |argument: u32| argument as u8;
        let kind = |kind| (kind, 0);
        // The macros are statics, one of each.
        let is = |other: &'static Macro| std::ptr::eq(of, other);
        match () {
            () if is(&macros::STREAM) => kind(Self::Stream(byte(a))),
            () if is(&macros::STREAM_TESS) => kind(Self::StreamTess),
            () if is(&macros::REG) => {
                let data = DataType::ALL.get(b as usize).copied();
                let (register, data) = (byte(a), data.unwrap_or(DataType::Float1));
                kind(Self::Reg { register, data })
            }
            () if is(&macros::SKIP) => kind(Self::Skip(byte(a))),
            () if is(&macros::TESSNORMAL) => kind(Self::TessNormal {
                from: byte(a),
                to: byte(b),
            }),
            () if is(&macros::TESSUV) => kind(Self::TessUv(byte(a))),
            () if is(&macros::CONST) => {
                let (address, values) = (byte(a), Vec::new());
                (Self::Const { address, values }, b as usize * 4)
            }
            () if is(&macros::EXT) => {
                let (info, words) = (a, Vec::new());
                (Self::Ext { info, words }, b as usize)
            }
            () => kind(Self::Nop),
        }
    }

    /// The same with the words behind its first token.
    fn with(mut self, rest: &[u32]) -> Self {
        match &mut self {
            Self::Const { values, .. } => {
                let (numbers, _) = rest.as_chunks::<4>();
                *values = numbers.iter().map(|v| v.map(f32::from_bits)).collect();
            }
            Self::Ext { words, .. } => *words = rest.to_vec(),
            _ => {}
        }
        self
    }
}

impl Declaration {
    /// Whether a stream begins as a vertex declaration does: with a token of one that is no `D3DVSD_NOP`, nor its end unless
    /// that is all.
    pub(super) fn begins(words: &[u32]) -> bool {
        let mut rest = words.iter().skip_while(|word| **word == 0);
        let known = |word: &u32| {
            let mut all = macros::DECLARATION.iter();
            all.any(|m| m.arguments(*word).is_some())
        };
        let first = rest.next().filter(|word| known(word));
        first.is_some_and(|word| macros::END.arguments(*word).is_none() || rest.next().is_none())
    }

    /// Reads a declaration from its tokens, with everything that is wrong with them. The spans of both count tokens.
    pub fn decode(words: &[u32]) -> (Self, Vec<Diagnostic>) {
        Self::read(words, true)
    }

    /// As [`Self::decode`], of a piece, which may lack its end: what the assembler of Direct3D 8 gave back for constants.
    pub fn decode_fragment(words: &[u32]) -> (Self, Vec<Diagnostic>) {
        Self::read(words, false)
    }

    fn read(words: &[u32], whole: bool) -> (Self, Vec<Diagnostic>) {
        let mut declaration = Self::default();
        let mut reports = Reports::default();
        let mut at = 0;
        while !reports.full() {
            let Some(&word) = words.get(at).filter(|_| at < MOST_TOKENS) else {
                if !whole && at == words.len() {
                    break;
                }
                let message = "the declaration ends without D3DVSD_END, 0xFFFFFFFF";
                reports.error(&model::D1, at, message, "");
                break;
            };
            if declaration.elements.len() == MOST_ITEMS {
                let message = format!("more than {MOST_ITEMS} elements");
                reports.error(&rules::LONG, at, &message, "");
                break;
            }
            if macros::END.arguments(word).is_some() {
                let rest = words.len() - at - 1;
                if rest > 0 {
                    let message = format!("tokens behind D3DVSD_END: {rest}, which are not read");
                    reports.warning(&rules::BEHIND, at + 1, &message, "");
                }
                break;
            }
            let found = macros::DECLARATION
                .iter()
                .find_map(|m| Some((*m, m.arguments(word)?)));
            let Some((of, arguments)) = found else {
                let message = format!("0x{word:08X} is no token of a vertex declaration");
                let help = match word >> 28 {
                    4 if word & 0x0008_0000 != 0 => {
                        "vertex data of types above 7 came with Direct3D 9"
                    }
                    _ => "",
                };
                reports.error(&rules::ELEMENT, at, &message, help);
                at += 1;
                continue;
            };
            let (kind, length) = ElementKind::of(of, arguments);
            let Some(rest) = words.get(at + 1..at + 1 + length) else {
                let message = format!(
                    "the declaration ends in {}, of which {} of {length} words are there",
                    of.text(&arguments),
                    words.len() - at - 1
                );
                reports.error(&model::D1, at, &message, "");
                break;
            };
            declaration.elements.push(Element {
                kind: kind.with(rest),
                span: tokens(at, at + 1 + length),
            });
            at += 1 + length;
        }
        (declaration, reports.finish())
    }

    /// The tokens of the declaration, with the one that ends it.
    ///
    /// # Errors
    /// Elements whose numbers do not fit their fields.
    pub fn encode(&self) -> Result<Vec<u32>, Vec<Diagnostic>> {
        let mut words = self.encode_fragment()?;
        words.extend(macros::END.token(&[]));
        Ok(words)
    }

    /// As [`Self::encode`], without the token that ends it: to stand within another declaration.
    ///
    /// # Errors
    /// As [`Self::encode`].
    pub fn encode_fragment(&self) -> Result<Vec<u32>, Vec<Diagnostic>> {
        let mut words = Vec::new();
        let mut faults = Vec::new();
        for element in &self.elements {
            let (of, arguments) = element.kind.head();
            match of.token(&arguments) {
                Ok(token) => {
                    words.push(token);
                    words.extend(element.kind.rest());
                }
                Err(Misfit::Count(_)) => {}
                Err(Misfit::Argument(at, most)) => {
                    let which = if at == 0 { "first" } else { "second" };
                    let message = format!(
                        "the {which} number of {} is at most {most}",
                        of.text(&arguments)
                    );
                    faults.push(Diagnostic::error(&rules::NO_TOKEN, element.span, message));
                }
            }
        }
        match faults.is_empty() {
            true => Ok(words),
            false => Err(faults),
        }
    }

    /// What a device of Direct3D 8 refuses of it beside a vertex shader, with the spans of the elements.
    pub fn check(&self) -> Vec<Diagnostic> {
        self.judge(|element| match element.kind {
            ElementKind::Reg { register, .. } if register > 15 => {
                let message = format!("a vertex shader has no register v{register}");
                Some(Diagnostic::error(&model::D2, element.span, message))
            }
            _ => None,
        })
    }

    /// What is wrong with it where there is no vertex shader: the fixed-function pipeline takes each register for what
    /// its `D3DVSDE_` name says.
    pub fn check_fixed_function(&self) -> Vec<Diagnostic> {
        self.judge(|element| {
            let (message, help) = misuse(&element.kind)?;
            let report = Diagnostic::warning(&model::D5, element.span, message);
            Some(report.with_help(help))
        })
    }

    /// The rules that hold in any case, with what else is said of an element.
    fn judge(&self, other: impl Fn(&Element) -> Option<Diagnostic>) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        let mut loaded = [false; 32];
        for element in &self.elements {
            let Element { kind, span } = element;
            let odd = other(element);
            match kind {
                ElementKind::Reg { register, .. } => {
                    let loaded = loaded.get_mut(usize::from(*register));
                    let twice = loaded.is_some_and(|loaded| std::mem::replace(loaded, true));
                    if twice && odd.is_none() {
                        let message = format!("v{register} is loaded a second time");
                        let report = Diagnostic::warning(&model::D3, *span, message);
                        found.push(report.with_help("the last one wins"));
                    }
                }
                ElementKind::Const { address, values } => {
                    let end = u32::from(*address) + values.len() as u32;
                    if values.is_empty() || end > VERTEX_CONSTANTS {
                        let message = match values.is_empty() {
                            true => "no constant is loaded".to_string(),
                            false => format!("c{} is above c{}", end - 1, VERTEX_CONSTANTS - 1),
                        };
                        found.push(Diagnostic::error(&model::D4, *span, message));
                    }
                }
                _ => {}
            }
            found.extend(odd);
        }
        found
    }

    /// The declaration as it stands in a C source, one element a line, the end included: what [`super::read`] takes.
    /// Constants are written by their bits, with the numbers behind them in a comment.
    pub fn print(&self) -> String {
        let mut text = self.print_fragment();
        text += &macros::END.text(&[]);
        text.push('\n');
        text
    }

    /// As [`Self::print`], without the end: to stand within another declaration.
    pub fn print_fragment(&self) -> String {
        let mut text = String::new();
        for Element { kind, .. } in &self.elements {
            let (of, arguments) = kind.head();
            text += &format!("{},\n", of.text(&arguments));
            let values: &[[f32; 4]] = match kind {
                ElementKind::Const { values, .. } => values,
                _ => &[],
            };
            for (at, line) in kind.rest().chunks(4).enumerate() {
                text += "   ";
                for word in line {
                    text += &format!(" 0x{word:08X},");
                }
                if let (Some(value), Some(first)) = (values.get(at), arguments.first()) {
                    let value = value.map(|v| format!("{v:?}")).join(", ");
                    text += &format!(" // c{} = {value}", first + at as u32);
                }
                text.push('\n');
            }
        }
        text
    }
}

/// The registers that the fixed-function pipeline takes for positions, for normals, and for texture coordinates.
const POSITIONS: [u8; 2] = [0, 15];
const NORMALS: [u8; 2] = [3, 16];
const COORDINATES: std::ops::RangeInclusive<u8> = 7..=14;

/// What the fixed-function pipeline could not do with an element, and what stands there instead.
fn misuse(kind: &ElementKind) -> Option<(String, &'static str)> {
    let named = |register: u8| {
        macros::meaning(register).map_or_else(|| format!("register {register}"), str::to_string)
    };
    let [normal, second_normal] = NORMALS;
    match *kind {
        ElementKind::Reg { register, data } => match register {
            _ if register == normal && data != DataType::Float3 => Some((
                format!("{} is loaded as {}", named(register), data.name()),
                "the fixed-function pipeline takes normals as D3DVSDT_FLOAT3",
            )),
            _ if register == second_normal => Some((
                format!("{} is loaded from a stream", named(register)),
                "only the tessellator makes it",
            )),
            _ if macros::meaning(register).is_none() => Some((
                format!("register {register} has no fixed meaning"),
                "D3DVSDE_POSITION to D3DVSDE_POSITION2, 0 to 15, have one",
            )),
            _ => None,
        },
        ElementKind::TessNormal { from, to } => {
            if !POSITIONS.contains(&from) {
                let message = format!("normals are made of {}", named(from));
                return Some((message, "they are made of positions"));
            }
            let message = format!("normals go to {}", named(to));
            let fits = NORMALS.contains(&to);
            (!fits).then_some((message, "normals are D3DVSDE_NORMAL and D3DVSDE_NORMAL2"))
        }
        ElementKind::TessUv(register) => {
            let message = format!("surface parameters go to {}", named(register));
            let fits = COORDINATES.contains(&register);
            (!fits).then_some((message, "they are D3DVSDE_TEXCOORD0 to D3DVSDE_TEXCOORD7"))
        }
        _ => None,
    }
}
