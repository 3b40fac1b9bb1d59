//! Completion: what the version has, and may stand at this place.

use super::analysis::{Analysis, Shader};
use super::client::Client;
use super::documents::Document;
use super::macros;
use super::words::{self, Kind, Line, Statement};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::ops::Range;
use texcrd::explain;
use texcrd::isa::modifier::{ResultSuffix, SATURATION, SHIFTS};
use texcrd::isa::opcode::{ModifierRule, Pairing, SourceShape};
use texcrd::isa::register::Access;
use texcrd::isa::{
    Class, FileSet, Form, Opcode, RegisterFile, ShaderKind, SourceModifier, Version, WriteMask,
};
use texcrd::program::{Instruction, Statement as Read, Usage, letters};
use texcrd::validate::UseKind;

/// Numbers of the protocol.
const FUNCTION: u8 = 3;
const VARIABLE: u8 = 6;
const MODULE: u8 = 9;
const PROPERTY: u8 = 10;
const KEYWORD: u8 = 14;
const CONSTANT: u8 = 21;

/// Directives that listings have.
const DIRECTIVES: [&str; 10] = [
    "define", "elif", "else", "endif", "error", "if", "ifdef", "ifndef", "include", "undef",
];

/// What is offered.
struct Item {
    label: String,
    kind: u8,
    detail: String,
    /// What is written, in the place of what is replaced.
    text: String,
    /// The same with places to fill in.
    snippet: Option<String>,
    /// What documentation is asked for later.
    data: Value,
    /// Whether it comes before the others.
    first: bool,
}

impl Item {
    fn new(label: impl Into<String>, kind: u8, detail: impl Into<String>) -> Self {
        let label = label.into();
        Self {
            text: label.clone(),
            label,
            kind,
            detail: detail.into(),
            snippet: None,
            data: Value::Null,
            first: false,
        }
    }
}

/// A place in a shader.
struct Place<'a> {
    text: &'a str,
    analysis: &'a Analysis,
    shader: &'a Shader,
    version: Version,
    line: &'a Line,
    offset: usize,
}

/// What may stand at a byte of a document.
pub(super) fn complete(
    analysis: &Analysis,
    document: &Document,
    offset: usize,
    client: &Client,
) -> Value {
    let (items, replaced) = found(analysis, document, offset).unwrap_or_default();
    let range = document.lines.range(document.text.as_bytes(), &replaced);
    let one = |(number, item): (usize, Item)| {
        let snippet = item.snippet.filter(|_| client.snippets);
        let mut told = json!({
            "label": item.label,
            "kind": item.kind,
            "detail": item.detail,
            "filterText": item.text,
            "sortText": format!("{}{number:04}", u8::from(!item.first)),
            "insertTextFormat": if snippet.is_some() { 2 } else { 1 },
            "textEdit": { "range": range, "newText": snippet.unwrap_or(item.text) },
        });
        if !item.data.is_null() {
            told["data"] = item.data;
        }
        told
    };
    let items: Vec<Value> = items.into_iter().enumerate().map(one).collect();
    json!({ "isIncomplete": false, "items": items })
}

/// An item with its documentation, of what [`complete`] said.
pub(super) fn resolve(mut item: Value, client: &Client) -> Value {
    let name = |name: &str| {
        item.pointer(&format!("/data/{name}"))
            .and_then(Value::as_str)
    };
    let version = name("version").and_then(|name| Version::all().find(|v| v.name() == name));
    let page = (name("instruction").and_then(Opcode::from_mnemonic))
        .map(|opcode| explain::instruction(opcode, version))
        .or_else(|| Some(explain::declaration(Usage::from_name(name("usage")?)?)))
        .or_else(|| {
            let (file, index) = RegisterFile::named(name("register")?)?;
            Some(explain::register(file, Some(index), version))
        })
        .or_else(|| {
            Some(explain::modifier(SourceModifier::from_text(
                "",
                name("source")?,
            )?))
        })
        .or_else(|| {
            let suffix = name("result")?;
            let row = ResultSuffix::all().find(|row| row.suffix == suffix)?;
            Some(explain::result(row))
        });
    if let Some(page) = page {
        item["documentation"] = client.markup(&client.page(&page));
    }
    item
}

/// What may stand there, and what it replaces.
fn found(
    analysis: &Analysis,
    document: &Document,
    offset: usize,
) -> Option<(Vec<Item>, Range<usize>)> {
    if !analysis.ours {
        return None;
    }
    let text = &document.text;
    let shader = analysis.shader_at(offset).filter(|shader| shader.listing)?;
    let line = words::line_at(text, &shader.region, analysis.in_strings(), offset);
    if line.in_comment(text, offset) {
        return None;
    }
    let touched = line.touched(offset).and_then(|at| line.tokens.get(at));
    let word = touched.filter(|token| !matches!(token.kind, Kind::Sign(_)));
    let replaced = word.map_or(offset..offset, |token| token.at.clone());
    if line.is_directive() {
        return directive(analysis, &line, text, offset).map(|items| (items, replaced));
    }
    let Some(program) = &shader.program else {
        return versions(text, shader, offset);
    };
    let version_at = analysis.editable(program.version_span);
    if version_at.is_some_and(|at| offset <= at.end) {
        return None;
    }
    let place = Place {
        text,
        analysis,
        shader,
        version: program.version,
        line: &line,
        offset,
    };
    place.found(replaced)
}

/// Versions, where nothing but comments stands before the place.
fn versions(text: &str, shader: &Shader, offset: usize) -> Option<(Vec<Item>, Range<usize>)> {
    let before = text.get(shader.region.start..offset)?;
    let start = before
        .rfind(|c: char| c.is_whitespace() || c == '"')
        .map_or(0, |at| at + 1);
    let code = |line: &str| {
        let line = line.trim().trim_start_matches('"');
        !(line.is_empty()
            || line.starts_with(';')
            || line.starts_with("//")
            || line.starts_with('#'))
    };
    if before.get(..start)?.lines().any(code) {
        return None;
    }
    let one = |version: Version| Item::new(version.name(), MODULE, explain::version(version).title);
    let items = Version::all().map(one).collect();
    Some((items, shader.region.start + start..offset))
}

fn directive(analysis: &Analysis, line: &Line, text: &str, offset: usize) -> Option<Vec<Item>> {
    let name = line.tokens.get(1).filter(|token| token.kind == Kind::Word);
    let Some(name) = name.filter(|name| name.at.end < offset) else {
        let behind = line
            .tokens
            .first()
            .is_some_and(|hash| hash.at.end <= offset);
        let one = |name: &&str| Item::new(*name, KEYWORD, "directive");
        return behind.then(|| DIRECTIVES.iter().map(one).collect());
    };
    matches!(
        name.text(text),
        "if" | "ifdef" | "ifndef" | "elif" | "undef"
    )
    .then(|| macro_items(analysis))
}

fn macro_items(analysis: &Analysis) -> Vec<Item> {
    let mut seen = BTreeSet::new();
    let mut items = Vec::new();
    for definition in macros::all(analysis) {
        if seen.insert(definition.word.clone()) {
            let first = definition.text.lines().next().unwrap_or_default();
            let kind = if definition.arguments {
                FUNCTION
            } else {
                CONSTANT
            };
            items.push(Item::new(
                definition.word,
                kind,
                first.chars().take(80).collect::<String>(),
            ));
        }
    }
    items
}

impl Place<'_> {
    fn found(&self, replaced: Range<usize>) -> Option<(Vec<Item>, Range<usize>)> {
        let statements = self.line.statements(self.text);
        let here = statements
            .iter()
            .rev()
            .find(|s| s.mnemonic.start < self.offset || s.mnemonic.end <= self.offset);
        let Some(statement) = here else {
            return Some((self.instructions(&replaced), replaced));
        };
        if self.offset <= statement.mnemonic.end {
            let word = self
                .text
                .get(statement.mnemonic.clone())
                .unwrap_or_default();
            let items = match word.contains('_') && statement.opcode != Opcode::Dcl {
                true => self.result_modifiers(statement, word),
                false => self.instructions(&replaced),
            };
            return Some((items, replaced));
        }
        self.operand(statement, replaced)
    }

    /// Instructions that the version has, with the modifiers that are there already.
    fn instructions(&self, replaced: &Range<usize>) -> Vec<Item> {
        let token = self
            .line
            .tokens
            .iter()
            .position(|t| t.at.start >= replaced.start);
        let before = token.unwrap_or(self.line.tokens.len()).checked_sub(1);
        let pair = before
            .and_then(|at| self.line.tokens.get(at))
            .is_some_and(|t| t.is('+'));
        // Where operands stand already, only the mnemonic is written.
        let behind = self
            .line
            .tokens
            .iter()
            .find(|t| t.at.start >= replaced.end.max(self.offset));
        let bare = behind.is_some_and(|token| {
            words::mnemonic(token.text(self.text)).is_none() && !token.is('+')
        });
        let mut items = Vec::new();
        for opcode in Opcode::all() {
            let Some(form) = opcode.form(self.version) else {
                continue;
            };
            if (pair && form.pairing == Pairing::Never) || !self.may_follow(opcode, form) {
                continue;
            }
            if opcode == Opcode::Dcl {
                items.extend(usages());
                continue;
            }
            let mut item = Item::new(opcode.mnemonic(), KEYWORD, form.formula);
            let operands = explain::operand_names(opcode, form);
            let places = operands
                .iter()
                .enumerate()
                .map(|(i, name)| format!("${{{}:{name}}}", i + 1));
            let places: Vec<String> = places.collect();
            if !bare && !places.is_empty() {
                item.snippet = Some(format!("{} {}", opcode.mnemonic(), places.join(", ")));
            }
            item.data = json!({ "instruction": opcode.mnemonic(), "version": self.version.name() });
            items.push(item);
        }
        if !pair {
            items.extend(macro_items(self.analysis));
        }
        items
    }

    /// Whether an instruction may stand behind those before the place: declarations first, then texture instructions, `phase`
    /// once.
    fn may_follow(&self, opcode: Opcode, form: &Form) -> bool {
        let Some(program) = &self.shader.program else {
            return true;
        };
        let before = |statement: &&Read| {
            let end = self.analysis.written(statement.span()).map(|at| at.end);
            end.is_some_and(|end| end < self.offset)
        };
        let instructions: Vec<&Instruction> = (program.statements.iter().take_while(before))
            .filter_map(|statement| match statement {
                Read::Instruction(instruction) => Some(instruction),
                Read::Def(_) | Read::Dcl(_) => None,
            })
            .collect();
        let computes = |i: &&&Instruction| {
            let class = i.opcode.form(self.version).map(|form| form.class);
            class == Some(Class::Arithmetic) && i.opcode != Opcode::Nop
        };
        let since = instructions
            .iter()
            .rposition(|i| i.opcode == Opcode::Phase)
            .map_or(0, |at| at + 1);
        match form.class {
            Class::Declaration => instructions.is_empty(),
            Class::Texture => !instructions.iter().skip(since).any(|i| computes(&i)),
            Class::Phase => !program.instructions().any(|i| i.opcode == opcode),
            Class::Arithmetic => true,
        }
    }

    fn result_modifiers(&self, statement: &Statement, word: &str) -> Vec<Item> {
        let form = statement.opcode.form(self.version);
        let takes = |form: &Form| form.class == Class::Arithmetic && form.destination.is_some();
        if self.version.kind() == ShaderKind::Vertex || !form.is_some_and(takes) {
            return Vec::new();
        }
        // Those that are complete stay, the one that is being typed is replaced.
        let typed = (self.offset - statement.mnemonic.start).min(word.len());
        let kept = word
            .get(..typed)
            .and_then(|typed| typed.get(..typed.rfind('_')?))
            .unwrap_or(word);
        let has = |row: &ResultSuffix| kept.ends_with(row.suffix);
        let (saturated, shifted) = (has(&SATURATION), SHIFTS.iter().any(has));
        let one = |row: &ResultSuffix| {
            let mut item = Item::new(row.suffix, PROPERTY, row.formula);
            item.text = format!("{kept}{}", row.suffix);
            item.data = json!({ "result": row.suffix });
            item
        };
        let fits = |row: &&ResultSuffix| {
            row.versions.contains(self.version) && !saturated && (row.shift == 0 || !shifted)
        };
        ResultSuffix::all().filter(fits).map(one).collect()
    }

    /// What may stand in the operand that the place lies in.
    fn operand(
        &self,
        statement: &Statement,
        replaced: Range<usize>,
    ) -> Option<(Vec<Item>, Range<usize>)> {
        let tokens = self.line.tokens.get(statement.operands.clone())?;
        let behind = tokens.partition_point(|t| t.at.start < self.offset);
        let before = tokens.get(..behind)?;
        let comma = before.iter().rposition(|t| t.is(',')).map(|at| at + 1);
        let number = before.iter().filter(|t| t.is(',')).count();
        let typed = before.get(comma.unwrap_or(0)..)?;
        let form = statement.opcode.form(self.version)?;
        let all = usize::from(form.destination.is_some()) + form.sources.len();
        if typed
            .last()
            .is_some_and(|last| last.at.end < self.offset && !matches!(last.kind, Kind::Sign(_)))
            || all == 0
        {
            // Behind a whole operand a comma comes, or the next instruction.
            let whole = number + 1 >= all.max(1) && statement.opcode != Opcode::Def;
            return whole.then(|| (self.instructions(&replaced), replaced));
        }
        let is_destination = form.destination.is_some() && number == 0;
        let source = form
            .sources
            .get(number.wrapping_sub(usize::from(form.destination.is_some())));
        if typed.iter().any(|t| t.is('[') || t.is(']'))
            && !typed.iter().any(|t| t.is('.') && t.at.end == self.offset)
        {
            return None;
        }
        let last_dot = typed.iter().rposition(|t| t.is('.'));
        let dot = last_dot.filter(|at| typed.len() - at <= 2);
        if let Some(dot) = dot {
            let register = typed.get(dot.checked_sub(1)?)?.text(self.text);
            let items = match source {
                _ if is_destination => self.masks(form, register),
                Some(shape) => self.selectors(statement, form, shape),
                None => Vec::new(),
            };
            let start = typed.get(dot)?.at.end;
            return Some((items, start..replaced.end.max(start)));
        }
        let word = typed
            .last()
            .filter(|t| t.kind == Kind::Word)
            .map(|t| t.text(self.text));
        if let (Some(word), Some(shape)) = (word, source)
            && let Some(base) = word.find('_').and_then(|at| word.get(..at))
            && words::register(base).is_some()
            && !is_destination
        {
            let negated = typed.first().is_some_and(|t| t.is('-'));
            return Some((self.source_modifiers(shape, base, negated), replaced));
        }
        let files = match (is_destination, form.destination, source) {
            (true, Some(shape), _) => shape.files,
            (_, _, Some(shape)) => shape.files,
            _ => return None,
        };
        let mut items = self.registers(files, is_destination, statement.opcode);
        if !is_destination || statement.opcode != Opcode::Def {
            items.extend(macro_items(self.analysis));
        }
        Some((items, replaced))
    }

    fn registers(&self, files: FileSet, is_destination: bool, opcode: Opcode) -> Vec<Item> {
        let uses = self.shader.uses();
        let named: BTreeSet<(RegisterFile, u32)> = uses
            .iter()
            .map(|u| (u.register.file, u.register.index))
            .collect();
        let defined: BTreeSet<u32> = (uses.iter())
            .filter(|u| u.kind == UseKind::Define)
            .map(|u| u.register.index)
            .collect();
        let declares = matches!(opcode, Opcode::Def | Opcode::Dcl);
        let mut items = Vec::new();
        for file in files.iter() {
            let access = file.access(self.version);
            let fits = match is_destination {
                // `texkill` of ps.1.4 looks at coordinates where others write.
                true => declares || access != Access::Read || opcode == Opcode::TexKill,
                false => access != Access::Write,
            };
            if !fits || (file == RegisterFile::Input && self.in_first_phase()) {
                continue;
            }
            for index in 0..file.count(self.version) {
                let mut item = Item::new(file.register_name(index), VARIABLE, file.row().name);
                if file == RegisterFile::Addr {
                    item.label = "a0.x".to_string();
                    item.text.clone_from(&item.label);
                }
                if file == RegisterFile::Const && defined.contains(&index) {
                    item.detail = "constant with a def".to_string();
                }
                item.data = json!({ "register": file.register_name(index), "version": self.version.name() });
                item.first = named.contains(&(file, index));
                items.push(item);
            }
            let addressed = RegisterFile::Addr.count(self.version) > 0 && !is_destination;
            if file == RegisterFile::Const && addressed {
                let mut item = Item::new("c[a0.x]", VARIABLE, "constant by the address register");
                item.snippet = Some("c[a0.x + ${1:0}]".to_string());
                items.push(item);
            }
        }
        items
    }

    /// Whether the place lies before the `phase` of the shader.
    fn in_first_phase(&self) -> bool {
        let program = self.shader.program.as_ref();
        let phase =
            program.and_then(|program| program.instructions().find(|i| i.opcode == Opcode::Phase));
        let at = phase.and_then(|phase| self.analysis.written(phase.span));
        at.is_some_and(|at| self.offset < at.start)
    }

    fn masks(&self, form: &Form, register: &str) -> Vec<Item> {
        let Some(shape) = form.destination.filter(|shape| shape.written) else {
            return Vec::new();
        };
        let letters = letters(self.version.kind());
        let address =
            words::register(register).is_some_and(|((file, _), _)| file == RegisterFile::Addr);
        let fits =
            |mask: &WriteMask| shape.masks.contains(*mask) && (!address || *mask == WriteMask::X);
        let masks: Vec<WriteMask> = (1..=15).map(WriteMask::from_bits).filter(fits).collect();
        let one = |mask: WriteMask| {
            let text: String = mask.components().filter_map(|c| letters.get(c)).collect();
            Item::new(text, PROPERTY, "write mask")
        };
        masks.into_iter().map(one).collect()
    }

    /// Selectors of a source, as `validate` has them for pixel shaders; swizzles of a vertex shader.
    fn selectors(&self, statement: &Statement, form: &Form, shape: &SourceShape) -> Vec<Item> {
        let all = letters(self.version.kind());
        let [_, _, blue, alpha] = all.map(String::from);
        let single = || all.map(String::from).to_vec();
        let tokens = self
            .line
            .tokens
            .get(statement.operands.clone())
            .unwrap_or(&[]);
        let to_alpha = tokens
            .get(2)
            .is_some_and(|mask| mask.text(self.text).eq_ignore_ascii_case("a"))
            && tokens.get(1).is_some_and(|t| t.is('.'));
        let texts = match (self.version, form.class, shape.modifiers) {
            (_, _, ModifierRule::Matrix) => Vec::new(),
            (Version::Ps14, Class::Texture, _) => vec!["xyz".to_string(), "xyw".to_string()],
            (_, Class::Texture, _) => Vec::new(),
            (Version::Ps14, ..) => single(),
            (version, ..) if version.kind() == ShaderKind::Vertex => {
                let mut swizzles = single();
                swizzles.extend(["xy", "xyz", "zxyw", "yzxw"].map(String::from));
                swizzles
            }
            (Version::Ps10, ..) => vec![alpha],
            _ if to_alpha => vec![blue, alpha],
            _ => vec![alpha],
        };
        texts
            .into_iter()
            .map(|text| Item::new(text, PROPERTY, "selector"))
            .collect()
    }

    fn source_modifiers(&self, shape: &SourceShape, register: &str, negated: bool) -> Vec<Item> {
        let takes = |modifier: &SourceModifier| {
            let row = modifier.row();
            let prefix = if negated { "-" } else { "" };
            row.prefix == prefix
                && !row.suffix.is_empty()
                && match shape.modifiers {
                    ModifierRule::Arithmetic => row.arithmetic.contains(self.version),
                    ModifierRule::Bx2(versions) => {
                        *modifier == SourceModifier::Bx2 && versions.contains(self.version)
                    }
                    ModifierRule::Coordinates => row.coordinates.contains(self.version),
                    ModifierRule::Matrix | ModifierRule::Plain => false,
                }
        };
        let one = |modifier: SourceModifier| {
            let row = modifier.row();
            let mut item = Item::new(row.suffix, PROPERTY, row.formula);
            item.text = format!("{register}{}", row.suffix);
            item.data = json!({ "source": row.suffix });
            item
        };
        SourceModifier::all().filter(takes).map(one).collect()
    }
}

/// `dcl_position` and its kin, with the register that Direct3D 8 gives the element.
fn usages() -> Vec<Item> {
    let one = |(usage, name): (Usage, &str)| {
        let mut item = Item::new(format!("dcl_{name}"), KEYWORD, "vertex element");
        let register = usage
            .default_register(0)
            .map_or("v".to_string(), |r| format!("v{r}"));
        item.snippet = Some(format!("dcl_{name} ${{1:{register}}}"));
        item.data = json!({ "usage": name });
        item
    };
    Usage::all().map(one).collect()
}
