//! Which registers a program reads and writes, operand by operand.

use super::listing::Listing;
use crate::diagnostic::Span;
use crate::isa::{RegisterFile, WriteMask};
use crate::program::{Program, Register, Statement};

/// What a statement does with a register.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum UseKind {
    /// `def` gives a constant its value.
    Define,
    /// `dcl` says which vertex element an input holds.
    Declare,
    /// An instruction reads it.
    Read,
    /// An instruction writes it.
    Write,
}

/// A register in a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Use {
    /// The register; of a relative operand the offset from `a0.x`.
    pub register: Register,
    /// The components that are read, those that have an effect on the result; or those that get a value.
    pub components: WriteMask,
    /// What is done with them.
    pub kind: UseKind,
    /// The operand. The rows of a matrix share the one that names the first of them; of a `dcl` it is all of it.
    pub span: Span,
    /// The number of the statement in [`Program::statements`].
    pub statement: usize,
    /// The number of what runs at once, an instruction or a pair, in order: its reads come before its writes. That of the
    /// next instruction for `def` and `dcl`.
    pub group: usize,
}

/// Every use of a register in the order of the text, reads of an instruction before what it writes.
///
/// Works on programs that break rules, too. An operand whose file the instruction cannot take is no use. The time is linear in
/// the length of the program.
pub fn uses(program: &Program) -> Vec<Use> {
    let listing = Listing::new(program, &[]);
    let mut lines = listing.lines.iter().peekable();
    let mut uses = Vec::new();
    let mut groups = 0;
    for (statement, of) in program.statements.iter().enumerate() {
        let mut add = |register, components, kind, span, group| {
            uses.push(Use {
                register,
                components,
                kind,
                span,
                statement,
                group,
            });
        };
        let all = WriteMask::ALL;
        let instruction = match of {
            Statement::Def(def) => {
                add(
                    def.register,
                    all,
                    UseKind::Define,
                    def.register_span,
                    groups,
                );
                continue;
            }
            Statement::Dcl(dcl) => {
                add(dcl.register, all, UseKind::Declare, dcl.span, groups);
                continue;
            }
            Statement::Instruction(instruction) => instruction,
        };
        let Some(line) = lines.next() else { continue };
        groups += usize::from(!line.joined);
        let group = groups - 1;
        for read in listing.reads(line) {
            if read.register.relative && read.row == 0 {
                let address = Register::new(RegisterFile::Addr, 0);
                add(address, WriteMask::X, UseKind::Read, read.span, group);
            }
            let components = read.components;
            add(read.register, components, UseKind::Read, read.span, group);
        }
        let Some(destination) = instruction.destination else {
            continue;
        };
        let only_looked_at = line
            .form
            .and_then(|form| form.destination)
            .filter(|shape| !shape.written);
        if let Some((register, components)) = line.writes() {
            let span = destination.span;
            add(register, components, UseKind::Write, span, group);
        } else if only_looked_at.is_some_and(|shape| !shape.files.contains(RegisterFile::Temp)) {
            // `texkill` before ps.1.4 looks at coordinates that come in.
            let (register, span) = (destination.register, destination.span);
            add(register, WriteMask::XYZ, UseKind::Read, span, group);
        }
    }
    uses
}

/// The writes that gave the components of a read their values, the last one first: the read's own group not counted. With
/// components that nothing has written the list is shorter.
pub fn origins<'u>(uses: &'u [Use], read: &Use) -> Vec<&'u Use> {
    let mut open = read.components;
    let mut found = Vec::new();
    let before = uses.partition_point(|u| u.group < read.group);
    for earlier in uses.get(..before).unwrap_or(&[]).iter().rev() {
        if open.is_empty() {
            break;
        }
        let writes = earlier.kind == UseKind::Write && earlier.register == read.register;
        if writes && !earlier.components.and(open).is_empty() {
            open = open.without(earlier.components);
            found.push(earlier);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::super::tests::program;
    use super::*;

    fn told(text: &str) -> Vec<String> {
        let program = program(text);
        let one = |u: &Use| {
            let components = u.components.text(program.letters());
            format!("{} {:?} {}{components}", u.group, u.kind, u.register)
        };
        uses(&program).iter().map(one).collect()
    }

    #[test]
    fn each_operand_is_a_use_of_the_components_that_count() {
        // Worked out by hand: dp3 reads three components, the mask of mov one, a pair is one group.
        let found = told(
            "ps.1.1 def c0, 1, 0, 0, 1 tex t0 dp3 r0.rgb, t0, c0 +mov r0.a, t0 mul r0, r0, v0.a",
        );
        let expected = [
            "0 Define c0",
            "0 Write t0",
            "1 Read t0.rgb",
            "1 Read c0.rgb",
            "1 Write r0.rgb",
            "1 Read t0.a",
            "1 Write r0.a",
            "2 Read r0",
            "2 Read v0.a",
            "2 Write r0",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn matrices_read_their_rows_and_relative_operands_the_address() {
        let found =
            told("vs.1.1 dcl_position v0 mov a0.x, c9.x m3x2 r0.xy, v0, c4 mov oPos, c[a0.x + 2]");
        let expected = [
            "0 Declare v0",
            "0 Read c9.x",
            "0 Write a0.x",
            "1 Read v0.xyz",
            "1 Read c4.xyz",
            "1 Read c5.xyz",
            "1 Write r0.xy",
            "2 Read a0.x",
            "2 Read c[a0.x + 2]",
            "2 Write oPos",
        ];
        assert_eq!(found, expected);
    }

    #[test]
    fn texkill_reads_what_it_looks_at() {
        assert_eq!(told("ps.1.1 texkill t1"), ["0 Read t1.rgb"]);
        assert_eq!(told("ps.1.4 texkill r1"), ["0 Read r1.rgb"]);
    }

    #[test]
    fn origins_are_the_last_writes_of_the_components() {
        let text = "ps.1.1 mov r0, v0 mov r0.rgb, v1 +mov r0.a, r0 add r1.a, r0, r0";
        let program = program(text);
        let uses = uses(&program);
        let reads: Vec<&Use> = (uses.iter())
            .filter(|u| u.kind == UseKind::Read && u.register.file == RegisterFile::Temp)
            .collect();
        let statements = |read: &Use| -> Vec<usize> {
            origins(&uses, read).iter().map(|u| u.statement).collect()
        };
        // The second half of the pair reads what stood there before the pair.
        assert_eq!(statements(reads[0]), [0]);
        assert_eq!(statements(reads[1]), [2]);
    }
}
