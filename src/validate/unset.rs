//! I7: constants that nothing sets, which is known only where a shader is run.

use super::listing::{Listing, Read};
use super::report::Report;
use crate::diagnostic::Diagnostic;
use crate::isa::{RegisterFile, enumerate};
use crate::policy::Dialect;
use crate::program::Program;
use crate::rules::model::Code;
use std::collections::HashSet;

/// Warns of each constant that a vertex shader reads though neither a `def` nor `set`, the numbers of the constants that
/// are set beside the shader, gives it a value: it reads 0. Nothing is said of pixel shaders, for which the rule list has
/// no such rule, nor of constants that are addressed relative to `a0.x`.
pub fn unset_constants(program: &Program, set: impl IntoIterator<Item = u32>) -> Vec<Diagnostic> {
    let listing = Listing::new(program, &[]);
    let mut report = Report::new(Dialect::default());
    if listing.is_pixel() {
        return report.finish();
    }
    let defined = program.definitions().map(|d| d.register);
    let defined = defined
        .filter(|r| r.file == RegisterFile::Const)
        .map(|r| r.index);
    let mut known: HashSet<u32> = defined.chain(set).collect();
    for line in &listing.lines {
        let mut is_new = |read: &&Read| {
            let register = read.register;
            let constant = register.file == RegisterFile::Const && !register.relative;
            constant && known.insert(register.index)
        };
        let reads = listing.reads(line).iter();
        let reads: Vec<&Read> = reads.filter(|read| is_new(read)).collect();
        // The rows of a matrix are one operand.
        for operand in reads.chunk_by(|a, b| a.span == b.span) {
            let names: Vec<String> = operand.iter().map(|r| r.register.to_string()).collect();
            let Some(first) = names.first() else { continue };
            report.breach(
                Code::I7,
                operand
                    .first()
                    .map_or(line.instruction.span, |read| read.span),
                format!(
                    "nothing sets {}: what is read is 0",
                    enumerate(&names, "and")
                ),
                format!("set it beside the shader, or define it, such as def {first}, 1, 0, 0, 0"),
            );
        }
    }
    report.finish()
}
