//! The macros of `d3d8types.h` that make tokens, one row each: what arrays in C sources hold.

/// How an argument of a macro is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Naming {
    /// As a number.
    Number,
    /// As the fixed meaning of a vertex register, where it has one.
    Register,
    /// As a type of vertex data.
    Data,
}

/// An argument of a macro.
#[derive(Debug)]
struct Field {
    /// Its lowest bit in the token.
    shift: u32,
    /// Its largest value.
    most: u32,
    naming: Naming,
}

/// A macro of `d3d8types.h` that makes one token.
#[derive(Debug)]
pub struct Macro {
    name: &'static str,
    /// The token with all arguments 0.
    base: u32,
    fields: &'static [Field],
    /// Arguments that show it.
    shown: &'static [u32],
    meaning: &'static str,
}

const fn number(shift: u32, bits: u32) -> Field {
    Field {
        shift,
        most: (1 << bits) - 1,
        naming: Naming::Number,
    }
}

const fn register(shift: u32, bits: u32) -> Field {
    Field {
        naming: Naming::Register,
        ..number(shift, bits)
    }
}

const fn data(shift: u32) -> Field {
    Field {
        shift,
        most: DATA_TYPES.len() as u32 - 1,
        naming: Naming::Data,
    }
}

const fn row(
    name: &'static str,
    base: u32,
    fields: &'static [Field],
    shown: &'static [u32],
    meaning: &'static str,
) -> Macro {
    Macro {
        name,
        base,
        fields,
        shown,
        meaning,
    }
}

pub(super) static NOP: Macro = row(
    "D3DVSD_NOP",
    0,
    &[],
    &[],
    "Stands for nothing in a vertex declaration.",
);
pub(super) static STREAM: Macro = row(
    "D3DVSD_STREAM",
    0x2000_0000,
    &[number(0, 4)],
    &[0],
    "What follows in the vertex declaration comes from this stream, 0 to 15, from the beginning of its vertices.",
);
pub(super) static STREAM_TESS: Macro = row(
    "D3DVSD_STREAM_TESS",
    0x3000_0000,
    &[],
    &[],
    "What follows in the vertex declaration comes from the tessellator.",
);
pub(super) static REG: Macro = row(
    "D3DVSD_REG",
    0x4000_0000,
    &[register(0, 5), data(16)],
    &[3, 2],
    "Loads a register with the next data of the stream, of the type that is named; components that the type does not have are 0, w is 1. \
     A vertex shader takes any element in any of v0 to v15; the names of the registers are their meaning without a shader.",
);
pub(super) static SKIP: Macro = row(
    "D3DVSD_SKIP",
    0x5000_0000,
    &[number(16, 4)],
    &[1],
    "Leaves out so many times four bytes of the stream.",
);
pub(super) static TESSNORMAL: Macro = row(
    "D3DVSD_TESSNORMAL",
    0x6002_0000,
    &[register(20, 4), register(0, 5)],
    &[0, 3],
    "The tessellator makes normals of the positions in the first register and puts them into the second.",
);
pub(super) static TESSUV: Macro = row(
    "D3DVSD_TESSUV",
    0x7001_0000,
    &[register(0, 5)],
    &[7],
    "The tessellator puts the parameters of the surface into this register.",
);
pub(super) static CONST: Macro = row(
    "D3DVSD_CONST",
    0x8000_0000,
    &[number(0, 7), number(25, 4)],
    &[10, 1],
    "Loads constants when the shader is set: the first argument is the number of the first, the second how many, 1 to 15; four floats for \
     each follow as words.",
);
/// The header names the fields of this token, but has no macro for it.
pub(super) static EXT: Macro = row(
    "D3DVSD_EXT",
    0xA000_0000,
    &[number(0, 24), number(24, 5)],
    &[0, 1],
    "An extension, which no document uses; the second argument counts the words that follow.",
);
pub(super) static END: Macro = row(
    "D3DVSD_END",
    0xFFFF_FFFF,
    &[],
    &[],
    "Ends a vertex declaration.",
);

/// What every macro of a vertex declaration begins with.
pub(super) const PREFIX: &str = "D3DVSD_";

/// The macros of vertex declarations. No token is that of two.
pub(super) static DECLARATION: [&Macro; 10] = [
    &NOP,
    &STREAM,
    &STREAM_TESS,
    &REG,
    &SKIP,
    &TESSNORMAL,
    &TESSUV,
    &CONST,
    &EXT,
    &END,
];

/// The macros of shaders.
static SHADER: [Macro; 4] = [
    row(
        "D3DVS_VERSION",
        0xFFFE_0000,
        &[number(8, 8), number(0, 8)],
        &[1, 1],
        "Begins the tokens of a vertex shader of this version.",
    ),
    row(
        "D3DPS_VERSION",
        0xFFFF_0000,
        &[number(8, 8), number(0, 8)],
        &[1, 4],
        "Begins the tokens of a pixel shader of this version.",
    ),
    row(
        "D3DVS_END",
        0xFFFF,
        &[],
        &[],
        "Ends the tokens of a vertex shader.",
    ),
    row(
        "D3DPS_END",
        0xFFFF,
        &[],
        &[],
        "Ends the tokens of a pixel shader.",
    ),
];

/// The types of vertex data by number, with how many bytes a vertex has of them.
pub(super) const DATA_TYPES: [(&str, u32); 8] = [
    ("D3DVSDT_FLOAT1", 4),
    ("D3DVSDT_FLOAT2", 8),
    ("D3DVSDT_FLOAT3", 12),
    ("D3DVSDT_FLOAT4", 16),
    ("D3DVSDT_D3DCOLOR", 4),
    ("D3DVSDT_UBYTE4", 4),
    ("D3DVSDT_SHORT2", 4),
    ("D3DVSDT_SHORT4", 8),
];

/// The meanings of vertex registers by number.
const REGISTERS: [&str; 17] = [
    "D3DVSDE_POSITION",
    "D3DVSDE_BLENDWEIGHT",
    "D3DVSDE_BLENDINDICES",
    "D3DVSDE_NORMAL",
    "D3DVSDE_PSIZE",
    "D3DVSDE_DIFFUSE",
    "D3DVSDE_SPECULAR",
    "D3DVSDE_TEXCOORD0",
    "D3DVSDE_TEXCOORD1",
    "D3DVSDE_TEXCOORD2",
    "D3DVSDE_TEXCOORD3",
    "D3DVSDE_TEXCOORD4",
    "D3DVSDE_TEXCOORD5",
    "D3DVSDE_TEXCOORD6",
    "D3DVSDE_TEXCOORD7",
    "D3DVSDE_POSITION2",
    "D3DVSDE_NORMAL2",
];

/// What the fixed-function pipeline takes a register for, if it has a meaning there.
pub(super) fn meaning(register: u8) -> Option<&'static str> {
    REGISTERS.get(usize::from(register)).copied()
}

/// The number that a name of the header stands for.
pub(super) fn constant(name: &str) -> Option<u32> {
    let register = REGISTERS.iter().position(|n| *n == name);
    let data = || DATA_TYPES.iter().position(|(n, _)| *n == name);
    register.or_else(data).map(|at| at as u32)
}

/// The input register that a name of the header stands for, in any case of letters.
pub(crate) fn register_named(name: &str) -> Option<u32> {
    let at = REGISTERS.iter().position(|n| n.eq_ignore_ascii_case(name));
    at.map(|at| at as u32)
}

/// The macro of this name.
pub(super) fn named(name: &str) -> Option<&'static Macro> {
    Macro::all().find(|m| m.name == name)
}

/// Why a macro makes no token.
pub(super) enum Misfit {
    /// It takes another number of arguments: this one.
    Count(usize),
    /// The argument at this place is too large: at most this fits.
    Argument(usize, u32),
}

impl Macro {
    /// Every macro, those of vertex declarations first.
    pub fn all() -> impl Iterator<Item = &'static Macro> {
        DECLARATION.iter().copied().chain(&SHADER)
    }

    /// Its name, such as `D3DVSD_REG`.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// What its token says, in sentences.
    pub fn meaning(&self) -> &'static str {
        self.meaning
    }

    /// One of its uses as C has it, and the token that it makes.
    pub fn example(&self) -> (String, u32) {
        // The arguments are those of the table, which fit.
        let token = self.token(self.shown).unwrap_or(self.base);
        (self.text(self.shown), token)
    }

    /// What its arguments may be called: the names of the header for types of data, with the bytes that a vertex has of them.
    pub fn types(&self) -> impl Iterator<Item = (&'static str, u32)> {
        let takes = self.fields.iter().any(|field| field.naming == Naming::Data);
        DATA_TYPES.into_iter().filter(move |_| takes)
    }

    /// The token that it makes of these arguments.
    pub(super) fn token(&self, arguments: &[u32]) -> Result<u32, Misfit> {
        if arguments.len() != self.fields.len() {
            return Err(Misfit::Count(self.fields.len()));
        }
        let mut token = self.base;
        for (at, (field, argument)) in self.fields.iter().zip(arguments).enumerate() {
            if *argument > field.most {
                return Err(Misfit::Argument(at, field.most));
            }
            token |= argument << field.shift;
        }
        Ok(token)
    }

    /// The arguments of which it makes this token, 0 where it takes fewer than two.
    pub(super) fn arguments(&self, token: u32) -> Option<[u32; 2]> {
        let mut arguments = [0; 2];
        let mut rest = token;
        for (field, argument) in self.fields.iter().zip(&mut arguments) {
            *argument = token >> field.shift & mask(field);
            rest &= !(mask(field) << field.shift);
            if *argument > field.most {
                return None;
            }
        }
        // The bits of the base lie outside of all fields, but for those of a token without any.
        (rest == self.base).then_some(arguments)
    }

    /// The macro with its arguments as C has it.
    pub(super) fn text(&self, arguments: &[u32]) -> String {
        let one = |(field, argument): (&Field, &u32)| {
            let name = match field.naming {
                Naming::Number => None,
                Naming::Register => REGISTERS.get(*argument as usize).copied(),
                Naming::Data => DATA_TYPES.get(*argument as usize).map(|(name, _)| *name),
            };
            name.map_or_else(|| argument.to_string(), str::to_string)
        };
        let arguments: Vec<String> = self.fields.iter().zip(arguments).map(one).collect();
        format!("{}({})", self.name, arguments.join(", "))
    }
}

/// The bits of a field in the lowest place: a type has one more than its values need.
fn mask(field: &Field) -> u32 {
    match field.naming {
        Naming::Data => 0xF,
        Naming::Number | Naming::Register => field.most,
    }
}
