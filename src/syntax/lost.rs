//! Operands whose mnemonic is lost, and mnemonics whose operands are: columns of a page slip when it is scanned.

use super::lexer::{Kind, Token};
use super::list::List;
use super::meaning::{mask, swizzle};
use super::names;
use super::operand::Written;
use super::parser::{Lost, Parser};
use super::report::names as listed;
use super::rules;
use crate::diagnostic::{Diagnostic, Fix};
use crate::isa::opcode::{Class, ModifierRule, Slots, SourceShape};
use crate::isa::{Form, Opcode, RegisterFile, SourceModifier, Swizzle, WriteMask};

/// How many lines a mnemonic may stand away from the operands that it is offered for.
const NEAR: u32 = 8;

impl Parser<'_> {
    /// Operands at the start of a statement.
    pub(super) fn lost_mnemonic(&mut self, co_issue: bool) {
        let first = self.peek();
        let list = self.operand_list(None);
        let last = self.previous();
        let span = self.span_of(first, last);
        let destination = list.destination();
        self.damage(span, destination);
        if list.broken && list.operands.len() < 2 {
            return;
        }
        let message = "no mnemonic stands before these operands".to_string();
        let mut report = Diagnostic::error(&rules::MNEMONIC_LOST, span, message);
        let takers = self.takers(&list);
        let stray = self.stray_below(list.operands.len(), &takers);
        if let Some((plus, token)) = stray {
            let mnemonic = self.word(token);
            let plus = if plus && !co_issue { "+" } else { "" };
            report = report.with_help(format!(
                "`{plus}{mnemonic}`, which stands alone below them in line {}, takes them and has no others: it has slipped a line",
                token.line
            ));
            let operands = String::from_utf8_lossy(self.between(first, last)).into_owned();
            let between = self.text.get(last.end as usize..token.start as usize);
            let between = String::from_utf8_lossy(between.unwrap_or(&[])).into_owned();
            let between = between
                .trim_end()
                .trim_end_matches('+')
                .trim_end()
                .to_string();
            report = report.with_fix(Fix {
                span: self.span_of(first, token),
                replacement: format!("{plus}{mnemonic} {operands}{between}"),
                certain: false,
            });
        } else if let [only] = takers[..] {
            let help = format!(
                "only `{}` takes these operands in {}",
                only.mnemonic(),
                self.version
            );
            report = report.with_help(help).with_fix(Fix {
                span: span.at_start(),
                replacement: format!("{} ", only.mnemonic()),
                certain: !list.damaged(),
            });
        } else if takers.is_empty() {
            let help = format!("no instruction of {} takes them as they are", self.version);
            report = report.with_help(help);
        } else {
            report = report.with_help(format!(
                "instructions of {} that take them: {}",
                self.version,
                listed(takers.iter().map(|op| op.mnemonic()))
            ));
        }
        let report = self.report(report);
        self.lost.push(Lost {
            report: report.filter(|_| stray.is_none() && takers.len() > 1),
            line: first.line,
            destination,
            takers,
        });
    }

    /// Takes a mnemonic that stands alone on the next line, if it takes `count` operands and what follows it is not
    /// them. Before it comes whether a `+` stands before it.
    fn stray_below(&mut self, count: usize, takers: &[Opcode]) -> Option<(bool, Token)> {
        let plus = self.peek().kind == Kind::Plus;
        let at = self.at + usize::from(plus);
        let token = self.token(at);
        let opcode = self.mnemonic(token)?;
        let alone = (token.first || plus) && self.token(at + 1).first;
        let fits = names::operand_count(opcode) == count
            && (takers.contains(&opcode) || takers.is_empty());
        if !alone || !fits || self.count_operands(at + 1) == count {
            return None;
        }
        self.at = at + 1;
        Some((plus, token))
    }

    /// How many operands stand from token `at` on; 0 if none does.
    pub(super) fn count_operands(&self, at: usize) -> usize {
        if !self.begins_operand(at) {
            return 0;
        }
        let mut count = 1;
        let mut after_comma = false;
        for i in at + 1..at + 64 {
            let token = self.token(i);
            if token.kind == Kind::Comma {
                count += 1;
                after_comma = true;
                continue;
            }
            let ends = token.first && !after_comma || self.mnemonic(token).is_some();
            if ends || token.kind == Kind::End {
                break;
            }
            after_comma = false;
        }
        count
    }

    /// The instructions of the version that take these operands, the first as destination.
    pub(super) fn takers(&self, list: &List) -> Vec<Opcode> {
        let Some((first, rest)) = list.operands.split_first() else {
            return Vec::new();
        };
        if rest.len() == 4
            && rest.iter().all(|o| matches!(o, Written::Number(_)))
            && matches!(first, Written::Register(r) if r.register.file == RegisterFile::Const)
        {
            return vec![Opcode::Def];
        }
        let fits = |form: &Form| {
            form.class != Class::Declaration
                && form.sources.len() == rest.len()
                && form.destination.is_some_and(|shape| match first {
                    Written::Register(r) => {
                        shape.files.contains(r.register.file)
                            && r.prefix.is_empty()
                            && shape.masks.contains(mask(r))
                    }
                    Written::Number(_) => false,
                    Written::Damaged => true,
                })
                && form.sources.iter().zip(rest).all(|(s, o)| self.fits(s, o))
        };
        Opcode::all()
            .filter(|op| op.form(self.version).is_some_and(fits))
            .collect()
    }

    fn fits(&self, shape: &SourceShape, operand: &Written) -> bool {
        let written = match operand {
            Written::Register(written) => written,
            Written::Number(_) => return false,
            Written::Damaged => return true,
        };
        let Some(modifier) = SourceModifier::from_text(written.prefix, written.suffix) else {
            return false;
        };
        let swizzle = swizzle(written);
        let plain = modifier == SourceModifier::None;
        let modified = match shape.modifiers {
            ModifierRule::Arithmetic => modifier.row().arithmetic.contains(self.version),
            ModifierRule::Bx2(versions) => {
                plain || modifier == SourceModifier::Bx2 && versions.contains(self.version)
            }
            ModifierRule::Coordinates => plain || modifier.row().coordinates.contains(self.version),
            ModifierRule::Matrix => plain && swizzle == Swizzle::IDENTITY,
            ModifierRule::Plain => plain,
        };
        let scalar = shape.slots == Slots::Fixed(WriteMask::W);
        let one = swizzle == Swizzle::IDENTITY || swizzle.replicated().is_some();
        modified && shape.files.contains(written.register.file) && (!scalar || one)
    }

    /// Adds to each lost mnemonic what the rest of the listing says about it.
    pub(super) fn match_lost_with_strays(&mut self) {
        let mut hints: Vec<(usize, String)> = Vec::new();
        for stray in &self.strays {
            let fits = |lost: &&Lost| {
                lost.report.is_some()
                    && lost.takers.contains(&stray.opcode)
                    && lost.line.abs_diff(stray.line) <= NEAR
            };
            let distance = |lost: &&Lost| lost.line.abs_diff(stray.line);
            let Some(lost) = self.lost.iter().filter(fits).min_by_key(distance) else {
                continue;
            };
            let name = stray.opcode.mnemonic();
            if let (Some(of_lost), Some(of_stray)) = (lost.report, stray.report) {
                let hint = format!("a `{name}` without operands stands in line {}", stray.line);
                hints.push((of_lost, hint));
                let hint = format!("the operands in line {} have no mnemonic", lost.line);
                hints.push((of_stray, hint));
            }
        }
        for lost in &self.lost {
            if let (Some(report), Some((name, text))) = (lost.report, self.written_beside(lost)) {
                hints.push((report, format!("`{text}` is written by `{name}`")));
            }
        }
        for (report, hint) in hints {
            self.reports.add_help(report, &hint);
        }
    }

    /// The instruction that writes other components of the same register, if only one kind does.
    fn written_beside(&self, lost: &Lost) -> Option<(&'static str, String)> {
        // The result of a pixel shader and other temporaries are written by anything.
        let register = lost.destination?;
        if register.file == RegisterFile::Temp {
            return None;
        }
        let written = || {
            self.statements.iter().filter_map(|s| match s {
                crate::program::Statement::Instruction(i) => i
                    .destination
                    .filter(|d| d.register == register)
                    .map(|d| (i.opcode, d)),
                _ => None,
            })
        };
        let (opcode, destination) = written().next()?;
        let same = written().all(|(op, _)| op == opcode) && lost.takers.contains(&opcode);
        let letters = crate::program::letters(self.version.kind());
        same.then(|| {
            let text = format!("{register}{}", destination.mask.text(letters));
            (opcode.mnemonic(), text)
        })
    }
}
