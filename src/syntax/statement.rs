//! Statements: instructions, and what is left of damaged ones.

use super::lexer::{Kind, Token};
use super::list::List;
use super::names::{self, Found, Name, ResultSuffix};
use super::parser::{Parser, Stray};
use super::report::{counted, names as listed, quote};
use super::rules;
use crate::diagnostic::{Diagnostic, Fix, Span};
use crate::isa::{Opcode, ResultModifier, ShaderKind};
use crate::program::{Instruction, Statement};
use crate::rules::model;

/// What stands before the operands of a statement.
#[derive(Clone, Copy)]
pub(super) struct Head {
    pub(super) opcode: Opcode,
    pub(super) result: ResultModifier,
    pub(super) co_issue: bool,
    /// The first token of the mnemonic.
    pub(super) token: Token,
    /// The mnemonic with its suffixes.
    pub(super) span: Span,
    /// Whether something in it was reported that cannot be repaired.
    pub(super) damaged: bool,
}

/// How many damaged statements end the reading: with names missing, most of them are not reported.
const MOST_DAMAGED: usize = 1000;

impl Parser<'_> {
    /// Reads statements to the end of the text, or of what is read of it.
    pub(super) fn statements(&mut self) {
        let mut plus: Option<Token> = None;
        while !self.reports.full() && self.damaged.len() < MOST_DAMAGED {
            let token = self.peek();
            match token.kind {
                Kind::Plus => {
                    self.bump();
                    if plus.is_some() {
                        while self.peek().kind == Kind::Plus {
                            self.bump();
                        }
                        let span = self.span_from(token);
                        let message = "a second `+` before one instruction";
                        let help = "only two instructions run together: write one `+`";
                        self.error(&rules::CO_ISSUE, span, message, help);
                    }
                    plus = Some(token);
                    continue;
                }
                Kind::End => {
                    if let Some(plus) = plus {
                        let message = "no instruction follows this `+`";
                        let help = "write the second instruction of the pair, or remove the `+`";
                        self.error(&rules::CO_ISSUE, self.span(plus), message, help);
                    }
                    break;
                }
                Kind::Version => {
                    let message = format!(
                        "{} begins a second shader in one listing",
                        self.quoted(token)
                    );
                    let help = "give each shader a file of its own; what follows is not read";
                    self.error(&model::S1, self.span(token), message, help);
                    // Nothing can be concluded from what is missing: it may stand in what is not read.
                    self.damage(self.span_of(token, self.token(self.tokens.len())), None);
                    break;
                }
                Kind::Word => self.word_statement(token, plus.is_some()),
                _ if self.names_missing => self.unknown_line(),
                _ => self.stray_text(false),
            }
            plus = None;
        }
        self.match_lost_with_strays();
    }

    /// A line that may be an instruction once the preprocessor has seen it.
    fn unknown_line(&mut self) {
        let first = self.peek();
        self.skip_line();
        self.damage(self.span_from(first), None);
    }

    fn word_statement(&mut self, token: Token, co_issue: bool) {
        let (stem, _) = self.stem(token);
        let next = self.token(self.at + 1);
        let alone = next.first;
        // Disassemblers leave such lines behind.
        if self.word(token).eq_ignore_ascii_case("debug") && !co_issue {
            return self.skip_line();
        }
        if self.lost_space(token, co_issue) {
            return;
        }
        if let Some(opcode) = self.mnemonic(token) {
            // `tex ld r0, t0`: two words that are one mnemonic.
            let operand = !alone && self.begins_operand(self.at + 1);
            let whole = operand && opcode.form(self.version).is_some();
            if !whole && !alone && self.split_mnemonic(token, co_issue) {
                return;
            }
            // `add the two together`: prose that begins with a mnemonic.
            let prose = !alone
                && next.kind == Kind::Word
                && !operand
                && self.words_of_prose(self.at + 1) > 1;
            return if prose {
                self.stray_text(false);
            } else {
                self.instruction(token, stem, co_issue);
            };
        }
        if self.split_mnemonic(token, co_issue) {
            return;
        }
        let operand_follows = next.kind == Kind::Word && self.begins_operand(self.at + 1);
        let register = self.registers(token);
        if let Found::Exact(Name::Register(..) | Name::TooLarge) = register {
            let separated = matches!(next.kind, Kind::Comma | Kind::Dot | Kind::Open);
            return if !separated && self.words_of_prose(self.at) > 0 {
                self.stray_text(false);
            } else {
                self.lost_mnemonic(co_issue);
            };
        }
        if let Found::Exact(Name::File(_)) = register
            && next.kind == Kind::Open
        {
            return self.lost_mnemonic(co_issue);
        }
        if operand_follows || alone {
            if let Found::Misread(..) = names::opcode(stem, self.version) {
                return self.instruction(token, stem, co_issue);
            }
            if let Some(meant) = names::joined_suffixes(self.word(token)) {
                self.bump();
                let message = format!("the underscore in {} is lost", self.quoted(token));
                self.misread(&rules::RESULT_SUFFIX, self.span(token), message, &meant);
                let (stem, suffixes) = meant.split_at(meant.find('_').unwrap_or(meant.len()));
                return self.body(token, stem, suffixes, co_issue);
            }
        }
        if let Found::Misread(..) = register
            && matches!(next.kind, Kind::Comma | Kind::Dot)
            && !next.first
        {
            return self.lost_mnemonic(co_issue);
        }
        let foreign = names::foreign_mnemonic(stem);
        if next.kind == Kind::Colon && !next.first && foreign.is_none() {
            let message = format!("{} is a label, and Direct3D 8 has none", self.quoted(token));
            let span = self.span_of(token, next);
            self.report(Diagnostic::error(&rules::INSTRUCTION, span, message));
            self.at += 2;
        } else if operand_follows
            || foreign.is_some() && (alone || self.words_of_prose(self.at) < 2)
        {
            self.unknown_instruction(token, stem, foreign);
        } else if self.names_missing {
            self.unknown_line();
        } else if alone && let [near] = names::near_mnemonics(stem, self.version)[..] {
            self.unknown_instruction(token, near, None);
        } else {
            self.stray_text(false);
        }
    }

    /// `mulr0.rgb, …`: a mnemonic and a register without the blank between them, if only one division of the word is
    /// that.
    fn lost_space(&mut self, token: Token, co_issue: bool) -> bool {
        const LONGEST: usize = 32;
        let word = self.word(token);
        let next = self.token(self.at + 1);
        let operands = matches!(next.kind, Kind::Comma | Kind::Dot | Kind::Open) && !next.first;
        if !operands || word.len() > LONGEST || self.is_register(token) {
            return false;
        }
        let divides = |&at: &usize| {
            let Some((mnemonic, register)) = word.split_at_checked(at) else {
                return false;
            };
            let mut parts = mnemonic.split('_');
            let stem = parts.next().and_then(Opcode::from_mnemonic);
            let suffixes = parts.all(|s| names::exact_result_suffix(&format!("_{s}")).is_some());
            let named = match names::exact_register(register) {
                Some(Name::Register(file, index)) => index < file.count(self.version),
                Some(Name::File(_)) => next.kind == Kind::Open,
                _ => false,
            };
            named && suffixes && stem.is_some_and(|op| op.form(self.version).is_some())
        };
        let divisions: Vec<usize> = (1..word.len()).filter(divides).collect();
        let [at] = divisions[..] else {
            return false;
        };
        let (mnemonic, register) = word.split_at(at);
        let message = format!("no blank stands between `{mnemonic}` and `{register}`");
        let meant = format!("{mnemonic} {register}");
        self.misread(&rules::INSTRUCTION, self.span(token), message, &meant);
        self.split_token(at);
        let stem = mnemonic.split('_').next().unwrap_or(mnemonic);
        let mnemonic = self.peek();
        self.instruction(mnemonic, stem, co_issue);
        true
    }

    /// `dp 3 r0, …`: a mnemonic with a blank in it, if what follows is its operands.
    fn split_mnemonic(&mut self, token: Token, co_issue: bool) -> bool {
        let next = self.token(self.at + 1);
        if next.first || !matches!(next.kind, Kind::Word | Kind::Number) || self.is_register(next) {
            return false;
        }
        let joined = [self.word(token), self.word(next)].concat();
        let (stem, suffixes) = joined.split_at(joined.find('_').unwrap_or(joined.len()));
        let Some(opcode) = Opcode::from_mnemonic(stem) else {
            return false;
        };
        let known = |s: &str| names::exact_result_suffix(&format!("_{s}")).is_some();
        if self.word(token).contains('_') || !suffixes.split('_').skip(1).all(known) {
            return false;
        }
        let count = match opcode {
            Opcode::Dcl => return false,
            // A register and four numbers.
            Opcode::Def => 5,
            _ => names::operand_count(opcode),
        };
        let behind = self.at + 2;
        let fits = match count {
            0 => self.token(behind).first,
            _ => !self.token(behind).first && self.count_operands(behind) == count,
        };
        if opcode.form(self.version).is_none() || !fits {
            return false;
        }
        self.at = behind;
        let span = self.span_of(token, next);
        let message = format!("a blank splits the mnemonic `{joined}`");
        self.misread(&rules::INSTRUCTION, span, message, &joined);
        let whole = Token {
            end: next.end,
            ..token
        };
        self.body(whole, stem, suffixes, co_issue);
        true
    }

    /// A word in the place of a mnemonic that is none.
    fn unknown_instruction(&mut self, token: Token, stem: &str, foreign: Option<&str>) {
        self.bump();
        let span = self.span(token);
        let quoted = self.quoted(token);
        let near = names::near_mnemonics(stem, self.version);
        if self.names_missing && foreign.is_none() && near.is_empty() {
            // A macro may stand here.
        } else if let Some(owner) = foreign {
            let message = format!("{quoted} is an instruction of {owner}");
            let help = format!("{} does not have it", self.version);
            self.error(&rules::INSTRUCTION, span, message, &help);
        } else {
            let message = format!("{quoted} is no instruction");
            let mut report = Diagnostic::error(&rules::INSTRUCTION, span, message);
            if !near.is_empty() {
                report =
                    report.with_help(format!("did you mean {}?", listed(near.iter().copied())));
            }
            if let [only] = near[..] {
                let suffixes = self
                    .word(token)
                    .find('_')
                    .map_or("", |at| &self.word(token)[at..]);
                report = report.with_fix(Fix {
                    span,
                    replacement: format!("{only}{suffixes}"),
                    certain: false,
                });
            }
            self.report(report);
        }
        // Its operands may be damaged too.
        let destination = if self.begins_operand(self.at) {
            self.operand_list(None).destination()
        } else {
            self.at = self.line_end(self.at);
            None
        };
        self.damage(self.span_from(token), destination);
    }

    /// An instruction whose mnemonic is in the next word.
    fn instruction(&mut self, token: Token, stem: &str, co_issue: bool) {
        self.bump();
        let suffixes = self.word(token).get(stem.len()..).unwrap_or("");
        self.body(token, stem, suffixes, co_issue);
    }

    /// An instruction behind its mnemonic.
    fn body(&mut self, token: Token, stem: &str, suffixes: &str, co_issue: bool) {
        let start = self.base + token.start;
        let opcode = match names::opcode(stem, self.version) {
            Found::Exact(opcode) => opcode,
            Found::Misread(opcode, meant) => {
                let span = Span::new(start, start + stem.len() as u32);
                let message = format!("{} is no instruction", quote(stem.as_bytes()));
                self.misread(&rules::INSTRUCTION, span, message, &meant);
                opcode
            }
            Found::No => return,
        };
        let mut head = Head {
            opcode,
            result: ResultModifier::NONE,
            co_issue,
            token,
            span: self.span(token),
            damaged: false,
        };
        if opcode == Opcode::Dcl {
            return self.declaration(head, suffixes.strip_prefix('_').unwrap_or(suffixes));
        }
        self.result_suffixes(&mut head, suffixes);
        match opcode {
            Opcode::Def => self.definition(head),
            _ => self.operands(head),
        }
    }

    fn result_suffixes(&mut self, head: &mut Head, suffixes: &str) {
        let mut at = self.base + head.token.end.saturating_sub(suffixes.len() as u32);
        let mut shifted = false;
        let mut rest = suffixes;
        while !rest.is_empty() {
            let next = rest.bytes().skip(1).position(|b| b == b'_');
            let (part, others) = rest.split_at(next.map_or(rest.len(), |length| length + 1));
            let span = Span::new(at, at + part.len() as u32);
            (at, rest) = (span.end, others);
            self.result_suffix(head, part, span, &mut shifted);
        }
        // `mul x2 r0, …`: the underscore is lost.
        while let next = self.peek()
            && next.kind == Kind::Word
            && !next.first
            && next.stem.register.is_none()
            && self.token(self.at + 1).kind != Kind::Comma
            && let word = self.word(next).trim_start_matches('_')
            && names::result_suffix_stem(word).is_some()
        {
            let stem = format!("_{word}");
            let before = self.previous();
            self.bump();
            let span = Span::new(self.base + before.end, self.base + next.end);
            let message = format!("the underscore before {} is lost", self.quoted(next));
            self.misread(
                &rules::RESULT_SUFFIX,
                span,
                message,
                &stem.to_ascii_lowercase(),
            );
            self.result_suffix(head, &stem, span, &mut shifted);
            head.span = self.span_from(head.token);
        }
        if head.result == ResultModifier::NONE || head.damaged {
            return;
        }
        let mnemonic = head.opcode.mnemonic();
        let (rule, message, help) = match head.opcode {
            Opcode::Def | Opcode::Phase | Opcode::Nop => (
                &rules::RESULT_SUFFIX,
                format!("`{mnemonic}` takes no suffix: it computes nothing"),
                format!("write `{mnemonic}` alone"),
            ),
            _ if self.version.kind() == ShaderKind::Vertex => (
                &model::O23,
                format!("{} has no {}", self.version, head.result.text()),
                "a vertex shader computes it with further instructions: max and min clamp, mul and add scale"
                    .to_string(),
            ),
            _ => return,
        };
        head.damaged = true;
        self.error(rule, head.span, message, &help);
    }

    /// One suffix of a mnemonic, underscore included.
    fn result_suffix(&mut self, head: &mut Head, text: &str, span: Span, shifted: &mut bool) {
        if head.damaged {
            return;
        }
        let suffix = match names::result_suffix(text) {
            Found::Exact(suffix) => suffix,
            Found::Misread(suffix, meant) => {
                let message = format!("{} is no suffix of a mnemonic", quote(text.as_bytes()));
                self.misread(&rules::RESULT_SUFFIX, span, message, &meant);
                suffix
            }
            Found::No => {
                head.damaged = true;
                let message = format!("{} is no suffix of a mnemonic", quote(text.as_bytes()));
                let help = match text.to_ascii_lowercase().as_str() {
                    "_pp" | "_centroid" => "it belongs to later shader models".to_string(),
                    _ => {
                        let all = names::result_suffixes().map(|(_, suffix)| suffix);
                        format!("the suffixes are {}", listed(all))
                    }
                };
                self.error(&rules::RESULT_SUFFIX, span, message, &help);
                return;
            }
        };
        let twice = match suffix {
            ResultSuffix::Saturate => std::mem::replace(&mut head.result.saturate, true),
            ResultSuffix::Shift(shift) => {
                head.result.shift = shift;
                std::mem::replace(shifted, true)
            }
        };
        if !twice {
            return;
        }
        head.damaged = true;
        let message = match suffix {
            ResultSuffix::Saturate => "`_sat` stands twice",
            ResultSuffix::Shift(_) => "two shifts on one instruction",
        };
        let help = "one instruction takes one shift and one _sat";
        self.error(&rules::RESULT_SUFFIX, span, message, help);
    }

    /// The operands of an instruction that is neither `def` nor `dcl`.
    fn operands(&mut self, head: Head) {
        let count = names::operand_count(head.opcode);
        if count == 0 {
            return self.keep(head, &List::default());
        }
        if !self.begins_operands() {
            return self.no_operands(head, count);
        }
        let list = self.operand_list(Some(count));
        let destination = list.destination();
        let written = list.operands.len();
        if list.broken || (list.damaged() && written != count) {
            // What is wrong was said; a wrong number of operands follows from it.
            self.damage(self.span_from(head.token), destination);
        } else if written != count {
            self.wrong_count(&head, count, &list);
            self.damage(self.span_from(head.token), destination);
        } else {
            self.keep(head, &list);
        }
    }

    /// Whether what follows a mnemonic is meant as its operands.
    pub(super) fn begins_operands(&self) -> bool {
        let next = self.peek();
        if next.first {
            return self.begins_operand(self.at);
        }
        match next.kind {
            Kind::Word => self.mnemonic(next).is_none(),
            Kind::Minus | Kind::Dash | Kind::Number | Kind::Open | Kind::Dot | Kind::Comma => true,
            Kind::Plus | Kind::End | Kind::Version | Kind::Close | Kind::Colon | Kind::Junk => {
                false
            }
        }
    }

    /// A mnemonic without operands.
    pub(super) fn no_operands(&mut self, head: Head, count: usize) {
        let message = format!(
            "no operands follow `{}`, which takes {}",
            head.opcode.mnemonic(),
            count
        );
        let help = "they may be lost, or have slipped to another line";
        let report = self.error(&rules::OPERAND_COUNT, head.span, message, help);
        self.damage(head.span, None);
        self.strays.push(Stray {
            opcode: head.opcode,
            line: head.token.line,
            report,
        });
        let next = self.peek();
        if !next.first && matches!(next.kind, Kind::Close | Kind::Colon | Kind::Junk) {
            self.skip_line();
        }
    }

    fn wrong_count(&mut self, head: &Head, count: usize, list: &List) {
        let written = list.operands.len();
        let form = head.opcode.row().forms.first();
        let sources = form.map_or(0, |f| f.sources.len());
        let parts = match sources {
            0 => String::new(),
            _ => format!(" (a destination and {})", counted(sources, "source")),
        };
        let message = format!(
            "`{}` takes {}{parts}, but {written} {} written",
            head.opcode.mnemonic(),
            counted(count, "operand"),
            if written == 1 { "is" } else { "are" },
        );
        let span = self.span_from(head.token);
        let mut report = Diagnostic::error(&rules::OPERAND_COUNT, span, message);
        let takers = self.takers(list);
        if let Some(at) = self.semicolon_for_comma(count.saturating_sub(written)) {
            let help = "the `;` behind them may stand for a comma: what follows it is the rest of the operands";
            report = report.with_help(help).with_fix(Fix {
                span: at,
                replacement: ",".to_string(),
                certain: false,
            });
        } else if !takers.is_empty() {
            report = report.with_help(format!(
                "instructions of {} that take these operands: {}",
                self.version,
                listed(takers.iter().map(|op| op.mnemonic()))
            ));
        }
        self.report(report);
    }

    /// The `;` behind the last token, if the comment that it begins is exactly the `missing` operands.
    fn semicolon_for_comma(&self, missing: usize) -> Option<Span> {
        const LONGEST: usize = 200;
        let end = self.previous().end;
        let rest = self.text.get(end as usize..)?;
        let rest = rest.get(..LONGEST.min(rest.len()))?;
        let line = rest.split(|b| *b == b'\n').next()?;
        let blanks = line.iter().take_while(|b| b.is_ascii_whitespace()).count();
        let comment = line.get(blanks..)?.strip_prefix(b";")?;
        let comment = std::str::from_utf8(comment).ok()?;
        let comment = comment.split(';').next()?.split("//").next()?;
        let is_operand = |text: &str| {
            let text = text.trim().trim_start_matches("1-").trim_start_matches('-');
            let name = text.split(['.', '_']).next().unwrap_or("");
            matches!(names::exact_register(name), Some(Name::Register(..)))
                && text
                    .bytes()
                    .all(|b| b.is_ascii_alphanumeric() || matches!(b, b'.' | b'_'))
        };
        let operands: Vec<&str> = comment.split(',').collect();
        let at = self.base + end + blanks as u32;
        (operands.len() == missing && operands.into_iter().all(is_operand))
            .then(|| Span::new(at, at + 1))
    }

    /// Adds an instruction to the program, or reports what its operands cannot be.
    fn keep(&mut self, head: Head, list: &List) {
        let span = self.span_from(head.token);
        let mut operands = list.operands.iter();
        let mut whole = !head.damaged;
        let destination = operands.next().and_then(|first| {
            let destination = self.destination(first);
            whole &= destination.is_some();
            destination
        });
        let mut sources = Vec::with_capacity(operands.len());
        for operand in operands {
            match self.source(operand) {
                Some(source) => sources.push(source),
                None => whole = false,
            }
        }
        if !whole {
            return self.damage(span, list.destination());
        }
        self.statements.push(Statement::Instruction(Instruction {
            opcode: head.opcode,
            co_issue: head.co_issue,
            result: head.result,
            destination,
            sources,
            span,
            mnemonic_span: head.span,
        }));
    }
}
