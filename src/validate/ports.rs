//! R1 to R11: how many registers of a file an instruction may read.

use super::listing::{Line, Listing, Read};
use super::report::Report;
use crate::diagnostic::Span;
use crate::isa::enumerate;
use crate::isa::{RegisterFile, Version};
use crate::program::Register;
use crate::rules::model::Code;

/// How many registers of a file both halves of a pair may read together (Direct3D 8.1: instruction pairing).
const PORTS_OF_A_PAIR: usize = 3;

/// How many registers of a file an instruction reads.
struct Limit {
    code: Code,
    file: RegisterFile,
    ports: usize,
}

/// The files whose ports can run out.
fn limits(listing: &Listing) -> Vec<Limit> {
    let limit = |file: RegisterFile| {
        Some(Limit {
            code: code(file, listing.version)?,
            file,
            ports: file.read_ports(listing.version) as usize,
        })
    };
    RegisterFile::all().filter_map(limit).collect()
}

pub(super) fn check(listing: &Listing, report: &mut Report) {
    let limits = limits(listing);
    for group in listing.groups() {
        let mut halves_fit = true;
        for line in group {
            halves_fit &= instruction_fits(listing, line, &limits, report);
        }
        if let ([first, second], true) = (group, halves_fit && listing.is_pixel()) {
            pair_fits(listing, first, second, report);
        }
    }
}

/// The registers of a file among reads, each once, with the place where it was first read.
fn distinct<'a>(
    reads: impl Iterator<Item = &'a Read>,
    file: RegisterFile,
) -> Vec<(Register, Span)> {
    let mut found: Vec<(Register, Span)> = Vec::new();
    for read in reads.filter(|r| r.register.file == file) {
        if found.iter().all(|(register, _)| *register != read.register) {
            found.push((read.register, read.span));
        }
    }
    found
}

/// Whether a file is read more than `ports` times at all.
fn may_exceed<'a>(
    reads: impl IntoIterator<Item = &'a Read>,
    file: RegisterFile,
    ports: usize,
) -> bool {
    let mut of_file = reads.into_iter().filter(|r| r.register.file == file);
    of_file.nth(ports).is_some()
}

fn names(registers: &[(Register, Span)]) -> String {
    let names: Vec<String> = registers.iter().map(|(r, _)| r.to_string()).collect();
    enumerate(&names, "and")
}

/// R1, R2, R4, R6, R7. Returns whether all files are within their ports.
fn instruction_fits(listing: &Listing, line: &Line, limits: &[Limit], report: &mut Report) -> bool {
    let reads = listing.reads(line);
    let rows = line.form.map_or(1, |form| form.rows.max(1));
    let mut fits = true;
    for &Limit { code, file, ports } in limits {
        if !may_exceed(reads, file, ports) {
            continue;
        }
        let mut found = (0..rows).map(|row| read_by_row(line, reads, row, file));
        let Some(over) = found.find(|found| found.len() > ports) else {
            continue;
        };
        fits = false;
        let span = over.get(ports).map_or(line.instruction.span, |o| o.1);
        let row = if rows > 1 { "a row of " } else { "" };
        let prefix = file.row().prefix;
        report.breach(
            code,
            span,
            format!(
                "{row}{} reads {}; in {} an instruction reads {} {prefix}#",
                line.mnemonic(),
                names(&over),
                listing.version,
                number(ports),
            ),
            help(listing, file),
        );
    }
    fits
}

/// The registers of a file that a row of a line reads. Each row of a matrix is an instruction of its own, which reads
/// the vector and its own row.
fn read_by_row(line: &Line, reads: &[Read], row: u32, file: RegisterFile) -> Vec<(Register, Span)> {
    let of_row = |r: &&Read| r.row == row || is_vector_of_matrix(line, r);
    distinct(reads.iter().filter(of_row), file)
}

/// The files of which an instruction reads as many registers as it may, with how many these are.
pub(super) fn full_of_instruction(listing: &Listing, line: &Line) -> Vec<(RegisterFile, usize)> {
    let reads = listing.reads(line);
    let rows = line.form.map_or(1, |form| form.rows.max(1));
    let full = |limit: &Limit| {
        (0..rows).any(|row| read_by_row(line, reads, row, limit.file).len() == limit.ports)
    };
    let files = limits(listing).into_iter().filter(full);
    files.map(|limit| (limit.file, limit.ports)).collect()
}

/// The files of which the halves of a pair read as many registers as they may together.
pub(super) fn full_of_pair(
    listing: &Listing,
    first: &Line,
    second: &Line,
) -> Vec<(RegisterFile, usize)> {
    let files = read_by_pair(listing, first, second, PORTS_OF_A_PAIR - 1);
    let full = files.filter(|(_, found)| found.len() == PORTS_OF_A_PAIR);
    full.map(|(file, _)| (file, PORTS_OF_A_PAIR)).collect()
}

/// Whether the halves of a pair read no more registers than they may together.
pub(super) fn pair_is_within(listing: &Listing, first: &Line, second: &Line) -> bool {
    let mut files = read_by_pair(listing, first, second, PORTS_OF_A_PAIR);
    files.all(|(_, found)| found.len() <= PORTS_OF_A_PAIR)
}

/// The registers that a pair reads, of the files that it reads more than `least` times. Files that have no more
/// registers than ports are left out.
fn read_by_pair<'a>(
    listing: &'a Listing,
    first: &'a Line,
    second: &'a Line,
    least: usize,
) -> impl Iterator<Item = (RegisterFile, Vec<(Register, Span)>)> + 'a {
    let reads = || listing.reads(first).iter().chain(listing.reads(second));
    let many = move |file: &RegisterFile| {
        file.count(listing.version) as usize > PORTS_OF_A_PAIR && may_exceed(reads(), *file, least)
    };
    let files = RegisterFile::all().filter(many);
    files.map(move |file| (file, distinct(reads(), file)))
}

/// Whether a read is the vector that every row of a matrix macro multiplies.
fn is_vector_of_matrix(line: &Line, read: &Read) -> bool {
    let vector = line.instruction.sources.first();
    vector.is_some_and(|s| s.span == read.span && s.register == read.register)
}

fn number(n: usize) -> String {
    match n {
        1 => "one".to_string(),
        2 => "two".to_string(),
        3 => "three".to_string(),
        n => n.to_string(),
    }
}

fn help(listing: &Listing, file: RegisterFile) -> String {
    match (file, listing.version) {
        (RegisterFile::Texture, Version::Ps10) => {
            "mov one of them to r# first; ps.1.1 reads two t#".to_string()
        }
        (RegisterFile::Texture, Version::Ps11) => {
            "mov one of them to r# first; ps.1.2 reads three t#".to_string()
        }
        (RegisterFile::Input, Version::Ps10) => {
            "mov one of them to r# first; ps.1.1 reads two v#".to_string()
        }
        _ => "mov one of them to r# first".to_string(),
    }
}

/// The rule that holds for a file; `None` where the number of sources or registers keeps it by itself.
fn code(file: RegisterFile, version: Version) -> Option<Code> {
    use RegisterFile::{Const, Input, Texture};
    Some(match (file, version) {
        (Const, Version::Vs10 | Version::Vs11) => Code::R1,
        (Input, Version::Vs10 | Version::Vs11) => Code::R2,
        (Const, _) => Code::R4,
        (Texture | Input, Version::Ps10) => Code::R6,
        (Texture, Version::Ps11) => Code::R7,
        _ => return None,
    })
}

/// R11.
fn pair_fits(listing: &Listing, first: &Line, second: &Line, report: &mut Report) {
    for (file, found) in read_by_pair(listing, first, second, PORTS_OF_A_PAIR) {
        let Some((_, span)) = found.get(PORTS_OF_A_PAIR) else {
            continue;
        };
        report.breach(
            Code::R11,
            *span,
            format!(
                "this pair reads {}; {} reads three {}# in a pair",
                names(&found),
                listing.version,
                file.row().prefix
            ),
            "leave the + out, so that each instruction reads by itself",
        );
    }
}
