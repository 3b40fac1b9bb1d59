//! Opcodes: mnemonic, token, versions, operand counts, slots, classes, pairing.

use super::{version, versions};
use crate::isa::opcode::Pairing;
use crate::isa::{Class, Opcode, RegisterFile, Version};
use std::collections::BTreeSet;

/// Sections 1, 3 and 4 of the instruction list and section 3 of the token list, one line a mnemonic and group of
/// versions: mnemonic, token (hexadecimal), versions, class (A arithmetic, T texture, P phase, D declaration),
/// destinations+sources, arithmetic slots, texture slots, half of a pair (- never, c colour, e either).
const SPEC: &str = "
nop           0000 vs          A 0+0  1 0 -
nop           0000 ps          A 0+0  0 0 -
mov           0001 vs          A 1+1  1 0 -
mov           0001 ps          A 1+1  1 0 e
add           0002 vs          A 1+2  1 0 -
add           0002 ps          A 1+2  1 0 e
sub           0003 vs          A 1+2  1 0 -
sub           0003 ps          A 1+2  1 0 e
mad           0004 vs          A 1+3  1 0 -
mad           0004 ps          A 1+3  1 0 e
mul           0005 vs          A 1+2  1 0 -
mul           0005 ps          A 1+2  1 0 e
rcp           0006 vs          A 1+1  1 0 -
rsq           0007 vs          A 1+1  1 0 -
dp3           0008 vs          A 1+2  1 0 -
dp3           0008 ps          A 1+2  1 0 c
dp4           0009 vs          A 1+2  1 0 -
dp4           0009 ps.1.2-1.3  A 1+2  2 0 -
dp4           0009 ps.1.4      A 1+2  1 0 -
min           000A vs          A 1+2  1 0 -
max           000B vs          A 1+2  1 0 -
slt           000C vs          A 1+2  1 0 -
sge           000D vs          A 1+2  1 0 -
exp           000E vs          A 1+1 10 0 -
log           000F vs          A 1+1 10 0 -
lit           0010 vs          A 1+1  1 0 -
dst           0011 vs          A 1+2  1 0 -
lrp           0012 ps          A 1+3  1 0 e
frc           0013 vs          A 1+1  3 0 -
m4x4          0014 vs          A 1+2  4 0 -
m4x3          0015 vs          A 1+2  3 0 -
m3x4          0016 vs          A 1+2  4 0 -
m3x3          0017 vs          A 1+2  3 0 -
m3x2          0018 vs          A 1+2  2 0 -
dcl           001F vs          D 1+0  0 0 -
texcoord      0040 ps.1.0-1.3  T 1+0  0 1 -
texcrd        0040 ps.1.4      T 1+1  0 1 -
texkill       0041 ps          T 1+0  0 1 -
tex           0042 ps.1.0-1.3  T 1+0  0 1 -
texld         0042 ps.1.4      T 1+1  0 1 -
texbem        0043 ps.1.0-1.3  T 1+1  0 1 -
texbeml       0044 ps.1.0-1.3  T 1+1  1 1 -
texreg2ar     0045 ps.1.0-1.3  T 1+1  0 1 -
texreg2gb     0046 ps.1.0-1.3  T 1+1  0 1 -
texm3x2pad    0047 ps.1.0-1.3  T 1+1  0 1 -
texm3x2tex    0048 ps.1.0-1.3  T 1+1  0 1 -
texm3x3pad    0049 ps.1.0-1.3  T 1+1  0 1 -
texm3x3tex    004A ps.1.0-1.3  T 1+1  0 1 -
texm3x3spec   004C ps.1.0-1.3  T 1+2  0 1 -
texm3x3vspec  004D ps.1.0-1.3  T 1+1  0 1 -
expp          004E vs          A 1+1  1 0 -
logp          004F vs          A 1+1  1 0 -
cnd           0050 ps          A 1+3  1 0 e
def           0051 all         D 1+0  0 0 -
texreg2rgb    0052 ps.1.2-1.3  T 1+1  0 1 -
texdp3tex     0053 ps.1.2-1.3  T 1+1  0 1 -
texm3x2depth  0054 ps.1.3      T 1+1  0 1 -
texdp3        0055 ps.1.2-1.3  T 1+1  0 1 -
texm3x3       0056 ps.1.2-1.3  T 1+1  0 1 -
texdepth      0057 ps.1.4      T 1+0  0 1 -
cmp           0058 ps.1.2-1.3  A 1+3  2 0 e
cmp           0058 ps.1.4      A 1+3  1 0 e
bem           0059 ps.1.4      A 1+2  2 0 -
phase         FFFD ps.1.4      P 0+0  0 0 -
";

/// The lines of the list, in words.
pub(crate) fn rows() -> impl Iterator<Item = Vec<&'static str>> {
    SPEC.lines()
        .filter(|l| !l.is_empty())
        .map(|l| l.split_whitespace().collect())
}

#[test]
fn every_instruction_is_as_the_specification_lists_it() {
    let mut listed = BTreeSet::new();
    for row in rows() {
        let [name, token, group, class, counts, arithmetic, texture, pair] = row[..] else {
            panic!("{row:?}");
        };
        let token = u16::from_str_radix(token, 16).unwrap();
        for version in versions(group) {
            let at = format!("{name} in {version}");
            assert!(listed.insert((name, version)), "{at} is listed twice");
            let opcode = Opcode::from_mnemonic(name).expect(name);
            assert_eq!(opcode.mnemonic(), name);
            assert_eq!(opcode.row().token, token, "{at}");
            assert_eq!(Opcode::from_token(token, version), Some(opcode), "{at}");
            let form = opcode.form(version).expect(&at);
            let letter = match form.class {
                Class::Arithmetic => "A",
                Class::Texture => "T",
                Class::Phase => "P",
                Class::Declaration => "D",
            };
            assert_eq!(letter, class, "{at}");
            let operands = usize::from(form.destination.is_some());
            assert_eq!(format!("{operands}+{}", form.sources.len()), counts, "{at}");
            assert_eq!(form.arithmetic_slots.to_string(), arithmetic, "{at}");
            assert_eq!(form.texture_slots.to_string(), texture, "{at}");
            let half = match form.pairing {
                Pairing::Never => "-",
                Pairing::Color => "c",
                Pairing::Either => "e",
            };
            assert_eq!(half, pair, "{at}");
            assert!(!form.formula.is_empty(), "{at}");
        }
    }
    for opcode in Opcode::all() {
        for version in Version::all() {
            let here = listed.contains(&(opcode.mnemonic(), version));
            assert_eq!(opcode.form(version).is_some(), here, "{opcode:?} {version}");
            let forms = opcode.row().forms.iter();
            let many = forms.filter(|f| f.versions.contains(version)).count();
            assert!(many <= 1, "{opcode:?} has {many} forms in {version}");
        }
        assert_eq!(opcode.row().opcode, opcode, "the rows stand in order");
    }
}

/// Versions in which an instruction may stand so often and no oftener (limits B6, B7, B8, B10).
const MOST: &str = "
dp4   ps.1.2-1.3 4
cmp   ps.1.2-1.3 3
bem   ps.1.4     1
phase ps.1.4     1
";

#[test]
fn counts_of_single_instructions_are_limited_as_listed() {
    for opcode in Opcode::all() {
        for version in Version::all() {
            let Some(form) = opcode.form(version) else {
                continue;
            };
            let listed = MOST.lines().filter(|l| !l.is_empty()).find_map(|line| {
                let words: Vec<&str> = line.split_whitespace().collect();
                let hit = words[0] == opcode.mnemonic() && versions(words[1]).contains(&version);
                hit.then(|| words[2].parse::<u32>().unwrap())
            });
            assert_eq!(form.most, listed, "{opcode:?} {version}");
        }
    }
}

/// Which components of which source an instruction reads whatever its write mask is: mnemonic, versions, one word
/// a source (`mask`: those of the write mask), from the formulas of sections 2, 5, 6 and 7.
const READS: &str = "
mov vs mask
mad ps mask mask mask
rcp vs w
rsq vs w
exp vs w
log vs w
expp vs w
logp vs w
lit vs xyw
dst vs yz yw
frc vs mask
dp3 all xyz xyz
dp4 vs xyzw xyzw
dp4 ps.1.4 xyzw xyzw
dp4 ps.1.2-1.3 xyzw xyzw
m4x4 vs xyzw xyzw
m4x3 vs xyzw xyzw
m3x4 vs xyz xyz
m3x3 vs xyz xyz
m3x2 vs xyz xyz
cnd ps.1.0-1.3 w mask mask
cnd ps.1.4 mask mask mask
cmp ps.1.4 mask mask mask
lrp ps mask mask mask
bem ps.1.4 xy xy
texld ps.1.4 xyz
texcrd ps.1.4 xyz
texbem ps.1.0-1.3 xy
texbeml ps.1.0-1.3 xyz
texreg2ar ps.1.0-1.3 xw
texreg2gb ps.1.0-1.3 yz
texreg2rgb ps.1.2-1.3 xyz
texm3x2pad ps.1.0-1.3 xyz
texm3x2tex ps.1.0-1.3 xyz
texm3x2depth ps.1.3 xyz
texm3x3pad ps.1.0-1.3 xyz
texm3x3tex ps.1.0-1.3 xyz
texm3x3spec ps.1.0-1.3 xyz xyz
texm3x3vspec ps.1.0-1.3 xyz
texm3x3 ps.1.2-1.3 xyz
texdp3 ps.1.2-1.3 xyz
texdp3tex ps.1.2-1.3 xyz
";

#[test]
fn instructions_read_the_components_of_their_formulas() {
    use crate::isa::WriteMask;
    // A mask that no instruction reads of its own accord.
    let odd = WriteMask::from_bits(0b1110);
    for line in READS.lines().filter(|l| !l.is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let opcode = Opcode::from_mnemonic(words[0]).unwrap();
        for version in versions(words[1]) {
            let Some(form) = opcode.form(version) else {
                continue;
            };
            assert_eq!(form.sources.len(), words.len() - 2, "{line}");
            for (i, word) in words[2..].iter().enumerate() {
                let want = match *word {
                    "mask" => odd,
                    letters => letters
                        .chars()
                        .map(|c| WriteMask::component("xyzw".find(c).unwrap()))
                        .fold(WriteMask::NONE, WriteMask::or),
                };
                assert_eq!(form.slots_read(i, odd), want, "{line}: {version}");
            }
        }
    }
}

#[test]
fn matrix_macros_have_the_rows_and_masks_of_their_names() {
    for (name, rows, mask) in [
        ("m4x4", 4, 15),
        ("m4x3", 3, 7),
        ("m3x4", 4, 15),
        ("m3x3", 3, 7),
        ("m3x2", 2, 3),
    ] {
        let form = Opcode::from_mnemonic(name).unwrap();
        let form = form.form(version("vs.1.1")).unwrap();
        let masks: Vec<u8> = form
            .destination
            .unwrap()
            .masks
            .iter()
            .map(|m| m.bits())
            .collect();
        assert_eq!((form.rows, masks), (rows, vec![mask]), "{name}");
    }
}

/// The files that operands may name: mnemonic, versions, destination, sources (limits O5 to O15).
const FILES: &str = "
mov vs.1.0 r,oPos,oD,oT r,v,c
mov vs.1.1 r,a0,oPos,oD,oT r,v,c
add vs r,oPos,oD,oT r,v,c r,v,c
mul ps.1.0-1.3 r,t r,v,c,t r,v,c,t
mul ps.1.4 r r,v,c r,v,c
cnd ps.1.0-1.3 r,t r r,v,c,t r,v,c,t
bem ps.1.4 r r,c r,c
tex ps.1.0-1.3 t
texcoord ps.1.0-1.3 t
texkill ps.1.0-1.3 t
texkill ps.1.4 r,t
texbem ps.1.0-1.3 t t
texm3x3spec ps.1.0-1.3 t t c
texld ps.1.4 r r,t
texcrd ps.1.4 r t
texdepth ps.1.4 r
def all c
dcl vs v
";

#[test]
fn operands_take_the_files_that_are_listed() {
    let name = |file: RegisterFile| match file {
        RegisterFile::Addr => "a0",
        RegisterFile::RastOut => "oPos",
        RegisterFile::AttrOut => "oD",
        RegisterFile::TexCrdOut => "oT",
        RegisterFile::Temp => "r",
        RegisterFile::Input => "v",
        RegisterFile::Const => "c",
        RegisterFile::Texture => "t",
    };
    for line in FILES.lines().filter(|l| !l.is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        for version in versions(words[1]) {
            let form = Opcode::from_mnemonic(words[0]).unwrap().form(version);
            let form = form.unwrap();
            let sets = std::iter::once(form.destination.unwrap().files)
                .chain(form.sources.iter().map(|s| s.files));
            let sets: Vec<String> = sets
                .map(|set| set.iter().map(name).collect::<Vec<_>>().join(","))
                .collect();
            assert_eq!(sets, words[2..], "{line}: {version}");
        }
    }
}

#[test]
fn only_texkill_and_texdepth_look_at_their_destination() {
    for opcode in Opcode::all() {
        for form in opcode.row().forms {
            let looks = form.destination.is_some_and(|d| !d.written);
            let listed = matches!(opcode.mnemonic(), "texkill" | "texdepth");
            assert_eq!(looks, listed, "{opcode:?}");
        }
    }
}
