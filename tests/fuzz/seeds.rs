//! What mutations start from: valid shaders of every version, and files in which shaders stand.

use texcrd::bytecode;
use texcrd::generate::{Options, Random, Textures, shader};
use texcrd::isa::Version;

/// How many shaders of each version are generated.
const EACH: u64 = 6;

/// What is mutated.
pub struct Seeds {
    /// Listings, effects, sources of C, tokens as text.
    pub texts: Vec<Vec<u8>>,
    /// Streams of shaders and of vertex declarations.
    pub streams: Vec<Vec<u32>>,
}

impl Default for Seeds {
    /// The same seeds every time.
    fn default() -> Self {
        let mut texts: Vec<Vec<u8>> = TEXTS.iter().map(|text| text.as_bytes().to_vec()).collect();
        texts.push(SCANNED.to_vec());
        let mut streams: Vec<Vec<u32>> = vec![STREAM.to_vec(), DECLARATION.to_vec()];
        let Ok(textures) = Textures::new() else {
            return Self { texts, streams };
        };
        for version in Version::all() {
            for seed in 0..EACH {
                // Shaders that executors may part on cost less to make.
                let options = Options {
                    comparable: false,
                    ..Options::new(version)
                };
                let made = shader(&mut Random::new(seed), &options, &textures);
                streams.extend(bytecode::encode(&made.program));
                texts.push(made.listing.into_bytes());
            }
        }
        let hex = streams.iter().take(8).map(|words| bytecode::to_hex(words));
        texts.extend(hex.map(String::into_bytes));
        Self { texts, streams }
    }
}

/// A listing as a scanner read it, with the errors that scanners make.
const SCANNED: &[u8] = include_bytes!("../../asm/stained_glass/scanned/stained_glass.psh");

/// Files with everything that the grammars have.
const TEXTS: [&str; 9] = [
    include_str!("../../asm/stained_glass/stained_glass.vsh"),
    include_str!("../../asm/stained_glass/stained_glass.psh"),
    include_str!("../../asm/stained_glass/room.psh"),
    "// lit\r\nvs.1.1\r\n#define POS \\\n v0\n#define DOT(d, a, b) dp3 d, a, b\n#include \"own.h\"\n\
     dcl_position0 v0\ndcl_texcoord7 v15.xyz\ndef c95, 1.0f, -2e-3, .5, 0x7F800000\n\
     mov a0.x, v0.x\n#if defined(FOG) && FOG > 1 || !0\nmov oFog.x, c[a0.x + 3 + 4].w\n#elif 2 == 2\nmov a0.x, POS.x\n#else\n#error no\n\
     #endif\nDOT(r0, POS, c[12])\nsub r1.xy, -r0, c[a0.x]\nm4x4 oPos, v0, c0 ; position\nmov oT0.xy, v7\n\n\
     #line 7 \"x.vsh\"\n#undef POS\n/* end */ mov oD0, c95\n",
    "ps.1.4\ndef c0, 1, 0, 0.5, 1\n;@comment \"CTAB\" 0000001C\n;@        \"a\\n\" FFFF0101\ntexld r0, t0.xyw\n\
     texcrd r1.rg, t1_dw.xyw\nphase\ntexld r2, r0_dz\nmad_x2_sat r1.rgb, r0_bx2, c0, -r1\n+mov r1.a, 1-r2.b\n\
     cmp_d8 r0, -r1_bias, r2, c0\n",
    "texture T;\ntechnique First\n{\n  pass P0\n  {\n    Texture[0] = <T>;\n    VertexShader = asm\n    {\n      vs.1.1\n\
     \x20     #define R r0\n      mov R, v0\n      mov oPos, R\n    };\n    PixelShader = asm { ps.1.1 tex t0 mov r0, t0 };\n\
     \x20 }\n}\n",
    "#include <d3d8.h>\nconst char shader[] =\n  \"ps.1.3\\n\" // first\n  \"tex t0 \\x3b comment\\n\"\n\
     \x20 \"texm3x2depth t1, t0\\n\"\n  \"mov r0, \\\n t0\\n\";\nstatic const char *two[] = { \"vs.1.0\\nmov oPos, v0\\n\", \"a\" };\n",
    "/* x */ DWORD dwPS[4] = { 0xffff0101, 0x0, 0xffff };\nDWORD b[] = { D3DPS_VERSION(1, 1), D3DPS_END() };\n\
     DWORD decl[] = { D3DVSD_STREAM(0), D3DVSD_REG(D3DVSDE_NORMAL, D3DVSDT_FLOAT3), D3DVSD_END() };\n",
    "D3DVSD_STREAM(0), D3DVSD_REG(D3DVSDE_NORMAL, 2), D3DVSD_SKIP(1), D3DVSD_CONST(1, 1), 0, 1, 2, 3,\n\
     D3DVSD_TESSNORMAL(0, 3), D3DVSD_TESSUV(7), D3DVSD_EXT(5, 1), 0xFFFFFFFF, D3DVSD_NOP(), D3DVSD_END()",
];

/// A stream with a comment, a definition, a pair and two phases.
#[rustfmt::skip]
const STREAM: [u32; 34] = [
    0xFFFF_0104, 0x0002_FFFE, 0x4241_5443, 0x0000_1C0A, 0x51, 0xA00F_0000, 0x3F80_0000, 0, 0x8000_0000, 0x7FC0_0001,
    0x42, 0x800F_0000, 0xB0E4_0000, 0x40, 0x8007_0001, 0xB0E4_0001, 0x04, 0x8117_0001, 0x84E4_0000, 0xA0E4_0000,
    0x81E4_0001, 0xFFFD, 0x42, 0x800F_0002, 0x89E4_0001, 0x05, 0x8007_0000, 0x80E4_0002, 0x90E4_0000, 0x4000_0001,
    0x8008_0000, 0x90E4_0000, 0xFFFE, 0xFFFF,
];

/// A vertex declaration with an element of every kind.
#[rustfmt::skip]
const DECLARATION: [u32; 19] = [
    0x2000_0000, 0x4002_0000, 0x4002_0003, 0x4004_0005, 0x5001_0000, 0x4001_0007, 0x2000_0001, 0x8200_000A, 0, 0x3F80_0000,
    0, 0x3F80_0000, 0x6032_0004, 0x7001_0008, 0x3000_0000, 0, 0xA100_0005, 0xABCD_EF01, 0xFFFF_FFFF,
];
