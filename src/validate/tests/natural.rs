//! Listings as people write them who try a rule: each is told of once, under its rule, in its line.
//!
//! Many are the examples of the rule list made whole. The line is the one that whoever wrote the listing would point at.

use super::Marked;
use crate::policy::Dialect;

/// Rule, line, listing.
const LISTINGS: &str = "
B1 127: vs.1.1 | m4x4 oPos, v0, c0 | mov oD0, v5 *125
B1 130: vs.1.1 | mov r0, v0 *128 | m4x4 oPos, r0, c0
B2 6: ps.1.1 | tex t0 | tex t1 | tex t2 | tex t3 | tex t4 | mul r0, t0, t1
B2 6: ps.1.3 | tex t0 | tex t1 | tex t2 | tex t3 | texcoord t0 | mul r0, t0, t1 | mul r0, r0, t2 | mul r0, r0, t3
B2 6: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3tex t3, t0 | tex t4 | mov r0, t3
B3 11: ps.1.1 | tex t0 | mul r0, t0, v0 | add r0, r0, c0 | add r0, r0, c1 | add r0, r0, c2 | add r0, r0, c3 | add r0, r0, c4 | add r0, r0, c5 | add r0, r0, c6 | add r0, r0, c7
B3 6: ps.1.2 | dp4 r0, v0, c0 | dp4 r1, v0, c1 | dp4 r1, v0, c1 | dp4 r1, v0, c1 | mul r0, r0, r1
B4 8: ps.1.4 | texld r0, t0 | texld r1, t1 | texld r2, t2 | texld r3, t3 | texld r4, t4 | texld r5, t5 | texld r0, t0 | mul r0, r0, r1
B4 8: ps.1.4 | texld r0, t0 | texld r1, t1 | texld r2, t2 | texld r3, t3 | texld r4, t4 | texld r5, t5 | texcrd r0.rgb, t0 | phase | mov r0, v0
B5 11: ps.1.4 | texld r0, t0 | mul r0, r0, c0 *9 | phase | mov r0.a, v0
B5 12: ps.1.4 | texld r0, t0 | phase | mov r0.a, c0 | mul r0, r0, c0 *9
B6 7: ps.1.2 | tex t0 | dp4 r0, t0, c0 | dp4 r0, t0, c0 | dp4 r0, t0, c0 | dp4 r0, t0, c0 | dp4 r0, t0, c0
B7 6: ps.1.2 | tex t0 | cmp r0, t0, c0, c1 | cmp r1, t0, c0, c1 | cmp r0, r1, c0, c1 | cmp r1, r0, c0, c1 | mov r0, r1
B8 5: ps.1.4 | texld r0, t0 | texcrd r1.rgb, t1 | bem r1.rg, r1, r0 | bem r2.rg, r1, r0 | phase | mov r0, v0
B8 5: ps.1.4 | texcrd r0.rgb, t0 | bem r1.rg, c0, r0 | phase | bem r2.rg, c0, r0 | mov r0, v0
B9 8: ps.1.4 | texcrd r0.rgb, t0 | texcrd r1.rgb, t1 | texcrd r2.rgb, t2 | phase | texld r0, r0_dz | texld r1, r1_dz | texld r2, r2_dz | mul r0, r0, r1 | add r0, r0, r2
B10 5: ps.1.4 | texld r0, t0 | phase | texld r1, t1 | phase | mul r0, r1, v0
B10 7: ps.1.4 | texld r0, t0 | phase | texld r1, t1 | mul r0.rgb, r0, r1 | +mov r0.a, r1 | phase | mov r0.a, v0
S1 1: mov r0, v0 | ps.1.1
S1 1: tex t0 | ps.1.1 | mov r0, t0
S1 1: mov r0, v0
S1 2: ps.1.1 | ps.1.1 | tex t0 | mov r0, t0
S1 3: ps.1.1 | tex t0 | ps.1.1 | mov r0, t0
S1 1: def c0, 1, 1, 1, 1 | ps.1.1 | mov r0, c0
S1 4: ps.1.1 | tex t0 | mov r0, t0 | vs.1.1 | mov oPos, v0
S2 3: ps.1.1 | tex t0 | def c0, 1, 1, 1, 1 | mul r0, t0, c0
S2 3: vs.1.1 | m4x4 oPos, v0, c0 | def c9, 1, 1, 1, 1 | mov oD0, c9
S3 3: ps.1.1 | mov r0, v0 | tex t0
S3 4: ps.1.1 | tex t0 | mov r0, t0 | tex t1 | mul r0, r0, t1
S3 3: ps.1.3 | mov r0, v0 | texkill t0
S4 3: ps.1.4 | mov r0, c0 | texld r1, t0
S4 5: ps.1.4 | texld r0, t0 | phase | mov r0.a, c0 | texld r1, t1 | mul r0, r0, r1
S5 3: ps.1.1 | tex t0 | phase | mov r0, t0
S5 4: ps.1.3 | tex t0 | mov r0, t0 | phase
S5 3: vs.1.1 | m4x4 oPos, v0, c0 | phase
S6 1: ps.1.1 | tex t0 | mov r1, t0
S6 1: ps.1.4 | texld r1, t0 | mul r1, r1, c0
S6 1: ps.1.1 | tex t0
S6 1: ps.1.1
S6 1: ps.1.1 | tex t0 | mul r0.rgb, t0, v0
S7 1: ps.1.4 | texld r0, t0 | phase | mov r0.rgb, r0
S7 1: ps.1.4 | texld r0, t0 | phase | texld r1, t1 | mul r0.rgb, r0, r1
S8 1: vs.1.1 | mov oD0, v5
S8 1: vs.1.1 | dcl_position v0 | mov r0, v0
S8 1: vs.1.1
S9 3: vs.1.1 | mov r0, v0 | mov oPos.xyz, r0
S9 2: vs.1.1 | m4x3 oPos.xyz, v0, c0
S14 3: ps.1.1 | tex t0 | cmp r0, t0, c0, c1
S14 2: ps.1.1 | texld r0, t0 | mul r0, r0, v0
S14 2: ps.1.4 | tex t0 | mul r0, t0, v0
S14 3: vs.1.1 | m4x4 oPos, v0, c0 | lrp r0, c0, v1, v1
S14 3: ps.1.1 | tex t0 | max r0, t0, v0
S14 3: ps.1.4 | texld r0, t0 | rcp r0, r0.a
S14 3: vs.1.1 | m4x4 oPos, v0, c0 | tex t0
S14 2: ps.1.1 | m4x4 r0, v0, c0
S14 4: ps.1.2 | tex t0 | texm3x3pad t1, t0 | bem t2.rg, t0, t0 | mov r0, t0
S14 2: ps.1.1 | dcl_position v0 | mov r0, v0
S14 4: ps.1.0 | tex t0 | sub r0, t0, v0 | texm3x3 t1, t0
S14 5: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3 t3, t0 | mov r0, t3
S14 4: ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2depth t2, t0 | mov r0, t0
S14 3: ps.1.1 | tex t0 | texdp3 t1, t0 | mov r0, t1
S14 2: ps.1.4 | texcoord t0 | mov r0, t0
S14 3: ps.1.4 | texld r0, t0 | texbem t1, t0 | mov r0, r0
S14 2: ps.1.3 | texcrd r0.rgb, t0 | mov r0.a, c0
S14 3: vs.1.1 | m4x4 oPos, v0, c0 | texkill t0
O1 3: ps.1.1 | tex t0 | mov r2, t0 | mov r0, r2
O1 3: ps.1.4 | texld r0, t0 | mul r0, r0, c8
O1 2: ps.1.1 | tex t4 | mov r0, t4
O1 3: ps.1.1 | tex t0 | mul r0, t0, v2
O1 2: vs.1.1 | m4x4 oPos, v16, c0
O1 3: vs.1.1 | m4x4 oPos, v0, c0 | mov oD2, v5
O1 3: vs.1.1 | m4x4 oPos, v0, c0 | mov oT8, v5
O1 2: vs.1.1 | mov r12, v0 | m4x4 oPos, r12, c0
O1 3: vs.1.1 | m4x4 oPos, v0, c0 | mov a1.x, v0.x
O1 2: ps.1.4 | texld r6, t0 | mov r0, r6
O1 2: ps.1.4 | texld r0, t6 | mov r0, r0
O2 3: ps.1.1 | tex t0 | mov c0, t0 | mov r0, c0
O2 3: ps.1.1 | tex t0 | mov v0, t0 | mov r0, v0
O2 3: vs.1.1 | m4x4 oPos, v0, c0 | mov v1, v0
O2 2: vs.1.1 | m4x4 c0, v0, c4
O2 3: ps.1.1 | tex t0 | mov c0, t0
O3 3: vs.1.1 | m4x4 oPos, v0, c0 | mov r0, oD0
O3 3: vs.1.1 | m4x4 oPos, v0, c0 | mov oD0, oPos
O3 4: vs.1.1 | m4x4 oPos, v0, c0 | mov a0.x, v1.x | mov r0, a0.x
O3 3: vs.1.1 | m4x4 oPos, v0, c0 | mov oT0, oT1
O4 3: vs.1.0 | m4x4 oPos, v0, c0 | mov a0.x, v1.x
O4 3: vs.1.0 | m4x4 oPos, v0, c0 | mov r0, c[a0.x + 3]
O4 3: vs.1.0 | m4x4 oPos, v0, c0 | mov a0.x, v1.x | mov oD0, c[a0.x + 3]
O5 3: vs.1.1 | m4x4 oPos, v0, c0 | add a0.x, v1.x, v1.x
O5 3: vs.1.1 | m4x4 oPos, v0, c0 | mov a0, v1
O5 3: vs.1.1 | m4x4 oPos, v0, c0 | mov a0.y, v1
O5 3: vs.1.1 | m4x4 oPos, v0, c0 | mov oD0, c[a0.x]
O5 3: vs.1.1 | m4x4 oPos, v0, c0 | rcp a0.x, v1.x
O6 3: vs.1.1 | mov a0.x, v1.x | mov oPos, v[a0.x]
O6 4: vs.1.1 | m4x4 oPos, v0, c0 | mov a0.x, v1.x | mov oD0, r[a0.x]
O6 4: vs.1.1 | m4x4 oPos, v0, c0 | mov a0.x, v1.x | mov c[a0.x], v1
O6 4: vs.1.1 | m4x4 oPos, v0, c0 | mov a0.x, v1.x | mov oT[a0.x], v1
O6 4: vs.1.1 | m4x4 oPos, v0, c0 | mov a0.x, v1.x | mov oD0, c[a0.y]
O6 3: ps.1.1 | tex t0 | mov r0, c[a0.x]
O6 4: vs.1.1 | m4x4 oPos, v0, c0 | mov a0.x, v1.x | mov oD0, v0[a0.x]
O6 4: vs.1.1 | m4x4 oPos, v0, c0 | mov a0.x, v1.x | mov oD0, r0[a0.x]
O6 4: vs.1.1 | mov oPos, v0 | mov a0.x, v0.x | mov r0, c0[ a0 ]
O6 4: vs.1.1 | mov oPos, v0 | mov a0.x, v0.x | mov r0, c[r1.x]
O8 3: ps.1.4 | texld r0, t0 | mul r0, r0, t0
O8 3: ps.1.4 | texld r0, t0 | add t1, r0, r0 | mov r0, c0
O8 2: ps.1.4 | mov r0, t0
O9 3: ps.1.4 | texld r0, t0 | mul r0, r0, v0 | phase | mov r0.a, c0
O10 2: ps.1.1 | texbem t1, r0 | mov r0, t1
O10 3: ps.1.1 | tex t0 | texbem r1, t0 | mov r0, t0
O10 2: ps.1.1 | tex r0 | mov r0, r0
O10 3: ps.1.1 | tex t0 | texbem t1, v0 | mov r0, t1
O10 5: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3spec t3, t0, t1 | mov r0, t3
O10 5: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3spec t3, t0, r0 | mov r0, t3
O11 2: ps.1.4 | texld t0, t0 | mov r0, c0
O11 2: ps.1.4 | texld t0,t0
O11 2: ps.1.4 | texld r0, v0 | mov r0, r0
O11 2: ps.1.4 | texkill v0 | mov r0, c0
O11 2: ps.1.4 | texkill c0 | mov r0, c0
O12 2: ps.1.4 | texcrd r0.rgb, r1 | phase | mov r0.a, c0
O12 2: ps.1.4 | texcrd r0, t0 | mov r0.a, c0
O12 2: ps.1.4 | texcrd r0.rg, t0 | mov r0, c0
O12 2: ps.1.4 | texcrd t0.rgb, t1 | mov r0, c0
O12 2: ps.1.4 | texcrd r0.rgba, t0 | mov r0, c0
O12 2: ps.1.4 | texcrd r0.rgb, t0_dw.xyw | mov r0, c0
O13 3: ps.1.1 | tex t0 | texbem t1, c0 | mov r0, t1
O13 2: ps.1.4 | texld r0, c0 | mov r0, r0
O13 2: ps.1.4 | texcrd r0.rgb, c0 | mov r0, c0
O13 3: ps.1.1 | tex t0 | texm3x3pad t1, c0 | texm3x3pad t2, t0 | texm3x3tex t3, t0 | mov r0, t3
O14 4: ps.1.4 | texcrd r0.rgb, t0 | phase | texdepth r0 | mov r0, c0
O14 3: ps.1.4 | texcrd r5.rgb, t0 | texdepth r5 | phase | mov r0, c0
O14 2: ps.1.4 | texdepth r5 | phase | mov r0, c0
O14 3: ps.1.4 | phase | texdepth t0 | mov r0, c0
O15 4: ps.1.1 | tex t0 | mov r1, t0 | cnd r0, r1.a, t0, c0
O15 3: ps.1.1 | tex t0 | cnd r0, t0.a, t0, c0
O15 4: ps.1.1 | tex t0 | mov r0, t0 | cnd r0, r0, t0, c0
O15 4: ps.1.1 | tex t0 | mov r0, t0 | cnd r0, 1-r0.a, t0, c0
O15 4: ps.1.3 | tex t0 | mov r0, t0 | cnd r0, r0.b, t0, c0
O15 3: ps.1.1 | tex t0 | cnd r0, r1.a, t0, c0
O16 4: ps.1.1 | tex t0 | mov r0, t0 | cnd r0.r, r0.a, t0, c0
O16 4: ps.1.1 | tex t0 | mov r0, t0 | cnd r0.rg, r0.a, t0, c0
O17 5: ps.1.2 | tex t0 | tex t1 | mov r0, t0 | cmp r0, r0, t0, t1
O17 4: ps.1.3 | tex t0 | mov r0, t0 | cmp r0, t0, r0, c0
O18 3: ps.1.4 | texcrd r0.rgb, t0 | bem r1, c0, r0 | phase | mov r0, c0
O18 3: ps.1.4 | texcrd r0.rgb, t0 | bem r1.rgb, c0, r0 | phase | mov r0, c0
O18 4: ps.1.4 | texcrd r0.rgb, t0 | phase | bem r1.rg, c0, r0 | mov r0, c0
O18 3: ps.1.4 | texld r0, t0 | bem r1.rg, c0, r0 | mov r0, c0
O18 3: ps.1.4 | texcrd r0.rgb, t0 | bem r1.r, c0, r0 | phase | mov r0, c0
O19 2: vs.1.1 | m4x4 oPos, v0, -c0
O19 2: vs.1.1 | m4x4 oPos, v0, c0.wzyx
O19 3: vs.1.1 | m4x4 oPos, v0, c0 | m3x3 r0, v1, c4
O19 3: vs.1.1 | m4x4 oPos, v0, c0 | m4x3 oD0.x, v1, c4
O20 3: vs.1.1 | mov r0, v0 | m4x4 r0, r0, c0 | mov oPos, r0
O20 6: vs.1.1 | mov r0, v0 | mov r1, v0 | mov r2, v0 | mov r3, v0 | m4x4 r1, v0, r0 | mov oPos, r1
O21 3: vs.1.1 | m4x4 oPos, v0, c0 | rcp r0, v1
O21 4: vs.1.1 | m4x4 oPos, v0, c0 | mov r1, v1 | rcp r0, r1 | mov oD0, r0
O21 3: vs.1.1 | m4x4 oPos, v0, c0 | rsq r0.w, v1
O21 3: vs.1.1 | m4x4 oPos, v0, c0 | expp r0.x, v1.xy
O22 3: vs.1.1 | m4x4 oPos, v0, c0 | frc r0, v1
O22 3: vs.1.1 | m4x4 oPos, v0, c0 | frc r0.x, v1
O22 3: vs.1.1 | m4x4 oPos, v0, c0 | frc r0.xyz, v1
O23 3: vs.1.1 | m4x4 oPos, v0, c0 | mov_sat oD0, v5
O23 3: vs.1.1 | m4x4 oPos, v0, c0 | mov_sat oD0, r0
O23 3: vs.1.1 | m4x4 oPos, v0, c0 | mul_x2 oD0, v5, v5
O23 3: vs.1.1 | m4x4 oPos, v0, c0 | mov oD0, 1-v5
O23 3: vs.1.1 | m4x4 oPos, v0, c0 | mov oD0, v5_bx2
O23 3: vs.1.1 | m4x4 oPos, v0, c0 | mov oD0, v5_bias
O24 2: ps.1.4 | mov r0.yx, c0
O24 3: vs.1.1 | m4x4 oPos, v0, c0 | mov r0.yx, v0
O24 2: ps.1.1 | mov r0.bgr, v0
O24 3: vs.1.1 | m4x4 oPos, v0, c0 | mov r0.xx, v0
O24 3: vs.1.1 | m4x4 oPos, v0, c0 | mov r0.xg, v0
O24 3: vs.1.1 | m4x4 oPos, v0, c0 | mov r0.xyzwx, v0
O25 2: ps.1.1 | def r0, 1, 1, 1, 1 | mov r0, v0
O25 2: ps.1.1 | def c8, 1, 1, 1, 1 | mov r0, v0
O25 2: ps.1.1 | def c0, 1, 1, 1 | mov r0, c0
O25 2: ps.1.1 | def c0.rgb, 1, 1, 1, 1 | mov r0, c0
O25 2: ps.1.1 | def c0, 1, 1, 1, 1, 1 | mov r0, c0
O25 2: ps.1.1 | def -c0, 1, 1, 1, 1 | mov r0, c0
O25 2: ps.1.1 | def c0 | mov r0, c0
O25 2: ps.1.1 | def c0, r0, r1, r2, r3 | mov r0, c0
O25 2: ps.1.1 | def c0, 1 | mov r0, c0
O25 2: vs.1.1 | def c[a0.x], 1, 1, 1, 1 | mov oPos, v0
O26 2: vs.1.1 | m4x4 oPos, v0, c96
O26 2: vs.1.1 | m4x4 oPos, v0, c94
O26 3: vs.1.1 | m4x4 oPos, v0, c0 | mov oD0, c200
O26 3: vs.1.1 | m4x4 oPos, v0, c0 | mov oD0, c400
M1 3: ps.1.1 | tex t0 | mul_x8 r0, t0, v0
M1 3: ps.1.1 | tex t0 | mul_d4 r0, t0, v0
M1 3: ps.1.3 | tex t0 | mul_d8_sat r0, t0, v0
M1 3: ps.1.1 | tex t0 | mul r0, t0_x2, v0
M1 3: ps.1.1 | tex t0 | mul r0, t0_dz, v0
M2 2: ps.1.1 | tex_sat t0 | mov r0, t0
M2 2: ps.1.1 | tex_x2 t0 | mov r0, t0
M2 2: ps.1.4 | texld_sat r0, t0 | mov r0, r0
M2 3: ps.1.1 | tex t0 | texbem_x2 t1, t0 | mov r0, t1
M2 2: ps.1.4 | texcrd_sat r0.rgb, t0 | mov r0.a, c0
M3 3: ps.1.1 | tex t0 | texbem t1, t0_bx2 | mov r0, t1
M3 3: ps.1.1 | tex t0 | texreg2ar t1, 1-t0 | mov r0, t1
M3 3: ps.1.0 | tex t0 | texm3x2pad t1, t0_bias | texm3x2tex t2, t0 | mov r0, t2
M3 2: ps.1.4 | texld r0, t0_bx2 | mov r0, r0
M3 2: ps.1.4 | texld r0, -t0 | mov r0, r0
M3 3: ps.1.1 | tex t0 | texbem t1, -t0 | mov r0, t1
M4 3: ps.1.1 | tex t0 | mov r0, -1-t0
M4 3: ps.1.1 | tex t0 | mul r0, 1-t0_bx2, v0
M4 3: ps.1.1 | tex t0 | mov r0, 1--t0
M4 4: ps.1.1 | tex t0 | mov r1, t0 | mov r0, -1-r1
M4 3: ps.1.4 | texld r0, t0 | mov r0, 1-r0_bias
M5 3: ps.1.4 | texld r0, t0 | mul r0, r0, 1-c0
M5 3: ps.1.4 | texld r0, t0 | mul r0, r0, -c0
M5 3: ps.1.4 | texld r0, t0 | mul r0, r0, c0_bx2
M6 3: ps.1.1 | tex t0 | add r0, t0, -c1
M6 3: ps.1.1 | tex t0 | add r0, t0, 1-c1
M6 3: ps.1.3 | tex t0 | add r0, t0, c1_bx2
M7 3: ps.1.1 | tex t0 | mov r0.r, t0
M7 4: ps.1.1 | tex t0 | mov r0, t0 | mov r0.rg, c0
M7 4: ps.1.1 | tex t0 | mul r0.xyz, t0, v0 | mov r0.g, c0 | mov r0.a, c0
M8 3: ps.1.1 | tex t0 | dp3 r0.a, t0, v0
M8 4: ps.1.1 | tex t0 | mov r0, t0 | dp3 r0.a, t0, v0
M8 4: ps.1.1 | tex t0 | mov r0, t0 | dp3 r0.r, t0, v0
M9 3: ps.1.1 | tex t0 | mul r0.rgb, t0, v0.b
M9 3: ps.1.1 | tex t0 | mul r0, t0, v0.r
M9 3: ps.1.1 | tex t0 | mov r0, t0.rgb
M9 4: ps.1.0 | tex t0 | mov r0, t0 | mov r0.a, t0.b
M9 3: ps.1.1 | tex t0 | mul r0, t0.g, v0
M9 3: ps.1.1 | tex t0 | texbem t1, t0.a | mov r0, t1
M9 3: ps.1.3 | tex t0 | mul r0, t0, v0.bgra
M10 3: ps.1.4 | texld r0, t0 | mov r0, r0.yzx
M10 3: ps.1.4 | texld r1, t0 | mov r0, r1.yzx
M10 2: ps.1.4 | texld r0, t0.x | mov r0, r0
M10 2: ps.1.4 | texld r0, t0.xy | mov r0, r0
M10 2: ps.1.4 | texld r0, t0.yzx | mov r0, r0
M10 3: ps.1.4 | texld r0, t0 | mul r0, r0, c0.rg
M11 3: ps.1.4 | texld r0, t0.xyz | texcrd r1.rgb, t0.xyw | mov r0, r0
M11 3: ps.1.4 | texld r0, t0 | texld r1, t0_dw.xyw | mul r0, r0, r1
M11 4: ps.1.4 | texld r0, t0.xyz | phase | texld r1, t0.xyw | mov r0, r1
M12 2: ps.1.4 | texld r0, t0_dz | mov r0, r0
M12 2: ps.1.4 | texld r0, t0_dw | mov r0, r0
M12 2: ps.1.4 | texld r0, t0_dw.xyz | mov r0, r0
M12 4: ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, r0_dw.xyw | mov r0, r1
M12 3: ps.1.4 | texld r0, t0 | mov r0, r0_dz
M12 2: ps.1.4 | texcrd r0.rgb, t0_dz | mov r0.a, c0
M13 2: ps.1.1 | tex t0.rgb | mov r0, t0
M13 2: ps.1.1 | texcoord t0.rgb | mov r0, t0
M13 3: ps.1.1 | tex t0 | texbem t1.rg, t0 | mov r0, t1
M13 2: ps.1.4 | texld r0.rgb, t0 | mov r0, c0
M13 2: ps.1.4 | texld r0.rgb, t0 | mov r0, r0
R1 3: vs.1.1 | m4x4 oPos, v0, c0 | add r0, c4, c5
R1 3: vs.1.1 | m4x4 oPos, v0, c0 | mad oD0, v5, c4, c5
R1 3: vs.1.1 | m4x4 oPos, v0, c0 | add r0, c0, c1 | mov oD0, r0
R2 3: vs.1.1 | m4x4 oPos, v0, c0 | add oD0, v5, v6
R2 3: vs.1.1 | m4x4 oPos, v0, c0 | mad r0, v1, v2, v3
R4 3: ps.1.1 | tex t0 | mad r0, c0, c1, c2
R4 2: ps.1.4 | lrp r0, c0, c1, c2
R4 4: ps.1.1 | tex t0 | mad r0, t0, c0, c1 | mad r0, c0, c1, c2
R6 4: ps.1.0 | tex t0 | tex t1 | mul r0, t0, t1
R6 2: ps.1.0 | mul r0, v0, v1
R7 5: ps.1.1 | tex t0 | tex t1 | tex t2 | mad r0, t0, t1, t2
R11 4: ps.1.1 | tex t0 | mad r0.rgb, c0, c1, t0 | +mad r0.a, c2, c3, t0
R11 7: ps.1.3 | tex t0 | tex t1 | tex t2 | tex t3 | mul r0.rgb, t0, t1 | +mul r0.a, t2, t3
R11 4: ps.1.4 | texld r0, t0 | mad r0.rgb, c0, c1, r0 | +mad r0.a, c2, c3, r0
T1 3: ps.1.1 | tex t1 | tex t0 | mul r0, t0, t1
T1 3: ps.1.1 | texcoord t2 | tex t0 | tex t1 | mul r0, t0, t1 | mul r0, r0, t2
T1 4: ps.1.1 | tex t0 | tex t2 | tex t1 | mul r0, t0, t1 | mul r0, r0, t2
T2 3: ps.1.1 | tex t0 | tex t0 | mov r0, t0
T2 3: ps.1.1 | tex t0 | texcoord t0 | mov r0, t0
T2 4: ps.1.1 | tex t0 | tex t1 | tex t0 | mul r0, t0, t1
T3 2: ps.1.1 | texbem t0, t1 | mov r0, t0
T3 2: ps.1.1 | texbem t1, t0 | mov r0, t1
T3 3: ps.1.1 | tex t1 | texbem t0, t1 | mov r0, t0
T3 3: ps.1.1 | tex t0 | texreg2ar t1, t1 | mov r0, t1
T3 3: ps.1.1 | tex t0 | texbem t1, t2 | mov r0, t1
T3 3: ps.1.1 | tex t0 | texbem t1, t2 | tex t2 | mov r0, t1
T3 3: ps.1.1 | tex t0 | texm3x2pad t2, t1 | texm3x2tex t3, t1 | mov r0, t3
T4 4: ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t3, t0 | mov r0, t3
T4 4: ps.1.1 | tex t0 | texm3x2pad t1, t0 | tex t3 | mov r0, t3
T4 4: ps.1.1 | tex t0 | texm3x2pad t1, t0 | tex t2 | texm3x2tex t3, t0 | mov r0, t3
T4 3: ps.1.1 | tex t0 | texm3x2tex t2, t0 | mov r0, t2
T4 4: ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x3tex t2, t0 | mov r0, t2
T4 4: ps.1.3 | tex t0 | texm3x2pad t1, t0 | texm3x2depth t3, t0 | mov r0, t0
T5 4: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3tex t2, t0 | mov r0, t2
T5 4: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3tex t3, t0 | mov r0, t3
T5 3: ps.1.1 | tex t0 | texm3x3tex t3, t0 | mov r0, t3
T5 5: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | tex t3 | mov r0, t3
T5 4: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x2tex t2, t0 | mov r0, t2
T5 4: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t3, t0 | mov r0, t0
T6 5: ps.1.1 | tex t0 | tex t1 | texm3x2pad t2, t0 | texm3x2tex t3, t1 | mov r0, t3
T6 5: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3tex t3, t1 | mov r0, t3
T7 3: ps.1.1 | tex t0 | texm3x2pad t1, t0 | mov r0, t0
T7 3: ps.1.1 | tex t0 | texm3x3pad t1, t0 | mov r0, t0
T7 4: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | mov r0, t0
T7 3: ps.1.1 | tex t0 | texm3x2pad t1, t0 | mov r0, t1
T7 4: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | mov r0, t2
T8 6: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3tex t3, t0 | mul r0, t1, t3
T8 5: ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t2, t0 | mov r0, t1
T8 5: ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t2, t0 | texbem t3, t1 | mov r0, t3
T9 4: ps.1.1 | tex t0 | texbem t1, t0 | add r0, t1, t0
T9 4: ps.1.1 | tex t0 | texbem t1, t0 | texreg2ar t2, t0 | mov r0, t2
T9 4: ps.1.1 | tex t0 | texbem t1, t0 | mov r0, t0
T10 5: ps.1.3 | tex t0 | texm3x2pad t1, t0 | texm3x2depth t2, t0 | mov r0, t2
T10 5: ps.1.3 | tex t0 | texm3x2pad t1, t0 | texm3x2depth t2, t0 | texreg2ar t3, t2 | mov r0, t3
T11 4: ps.1.1 | tex t0 | texkill t1 | mul r0, t0, t1
T12 4: ps.1.1 | tex t0 | texbem t1, t0 | texreg2ar t2, t1 | mov r0, t2
T13 3: ps.1.4 | texld r0, t0 | texld r1, r0 | mov r0, r1
T13 4: ps.1.4 | texld r0, t0 | phase | texld r1, r2 | mov r0, r1
T13 5: ps.1.4 | texld r0, t0 | phase | texld r1, t1 | texld r2, r1 | mov r0, r2
T13 3: ps.1.4 | phase | texld r0, r0 | mov r0, r0
T13 4: ps.1.4 | mov r0.rg, c0 | phase | texld r1, r0 | mov r0, r1
T13 5: ps.1.4 | texld r0, t0 | phase | texld r0, t1 | texld r1, r0 | mov r0, r1
I1 2: ps.1.1 | add r0, r0, v0
I1 2: ps.1.1 | mul r0, r1, v0
I1 2: vs.1.1 | mov oPos, r0
I1 2: vs.1.1 | add r0, r0, v0 | mov oPos, r0
I1 3: vs.1.1 | mov r0.xyz, v0 | mov oPos, r0
I1 2: ps.1.4 | mul r0, r1, c0
I1 4: ps.1.1 | tex t0 | mov r1.rgb, t0 | mul r0, r1, t0
I2 4: ps.1.4 | texld r1, t0 | phase | mov r0, r1
I2 5: ps.1.4 | texld r1, t0 | phase | mov r0.rgb, r1 | mov r0.a, r1.a
I2 4: ps.1.4 | texld r0, t0 | phase | mul r0, r0, v0
I3 3: ps.1.4 | texcrd r0.rgb, t0 | mov r0, r0
I3 3: ps.1.4 | texcrd r0.rgb, t0 | mov r1, r0 | mov r0, r1
I3 3: ps.1.4 | texcrd r1.rg, t0_dw.xyw | mov r0, r1.b
I4 2: ps.1.1 | mov r0, t0
I4 3: ps.1.1 | tex t0 | mul r0, t0, t1
I5 5: ps.1.4 | texcrd r5.rgb, t0 | phase | texdepth r5 | mov r0, r5
I5 5: ps.1.4 | texld r5, t0 | phase | texdepth r5 | mul r0, r5.r, c0
C1 3: vs.1.1 | m4x4 oPos, v0, c0 | +mov oD0, v5
C1 2: vs.1.1 | +m4x4 oPos, v0, c0
C1 3: vs.1.1 | mov oPos, v0 | +add r0.w, v0, v0
C2 2: ps.1.1 | +mov r0, v0
C2 3: ps.1.1 | tex t0 | +mov r0, t0
C2 5: ps.1.1 | tex t0 | mov r0.rgb, t0 | +mov r0.a, t0 | +mul r0.rgb, r0, v0
C2 3: ps.1.1 | tex t0 | +mul r0.rgb, t0, v0 | +mov r0.a, t0
C2 5: ps.1.1 | tex t0 | mul r0.rgb, t0, v0 | +mov r0.a, t0 | +mov r1.a, t0
C2 4: ps.1.4 | texld r0, t0 | phase | +mov r0.a, c0
C3 4: ps.1.1 | tex t0 | mul r0, t0, v0 | +mov r1.a, t0
C3 4: ps.1.1 | tex t0 | mul r0.rgb, t0, v0 | +mov r0.rgb, t0 | mov r0.a, t0
C3 4: ps.1.1 | tex t0 | mul r0.a, t0, v0 | +mov r0.a, t0 | mov r0.rgb, t0
C3 4: ps.1.1 | tex t0 | mul r0.rgb, t0, v0 | +mov r0, t0
C4 4: ps.1.4 | texld r0, t0 | mul r0, r0, c0 | +mov r1.a, r0
C4 4: ps.1.4 | texld r0, t0 | mul r0.rg, r0, c0 | +mov r1.b, r0
C4 4: ps.1.4 | texld r0, t0 | mul r0.rgb, r0, c0 | +mov r0.ba, c0
C5 4: ps.1.0 | tex t0 | mul r0.rgb, t0, v0 | +mov r1.a, t0 | mov r0.a, r1
C5 4: ps.1.0 | tex t0 | mul r0.rgb, t0, v0 | +mov r1.a, t0
C6 3: ps.1.2 | tex t0 | dp4 r0.rgb, t0, c0 | +mov r0.a, t0
C6 4: ps.1.4 | texld r0, t0 | mov r0.rgb, r0 | +dp4 r0.a, r0, c0
C6 4: ps.1.1 | tex t0 | mov r0.rgb, t0 | +dp3 r0.a, t0, v0
C6 4: ps.1.4 | texld r0, t0 | mov r0.a, c0 | +bem r1.rg, c0, r0 | phase | mov r0, c0
C6 3: ps.1.4 | texld r0, t0 | bem r1.rg, c0, r0 | +mov r0.a, c0 | phase | mov r0, c0
C7 3: ps.1.1 | tex t0 | +tex t1 | mul r0, t0, t1
C7 4: ps.1.1 | tex t0 | mov r0, t0 | +nop
C7 2: ps.1.1 | +def c0, 1, 1, 1, 1 | mov r0, c0
C7 3: ps.1.4 | texld r0, t0 | +phase | mov r0, c0
C7 4: ps.1.1 | tex t0 | mov r0.rgb, t0 | +tex t1 | mov r0.a, t1
C7 2: ps.1.1 | +tex t0 | mov r0, t0
";

#[test]
fn one_fault_is_told_once_and_in_its_line() {
    let mut wrong = Vec::new();
    for row in LISTINGS.lines().filter(|row| !row.is_empty()) {
        let (head, listing) = row.split_once(": ").unwrap();
        let (id, line) = head.split_once(' ').unwrap();
        let marked = Marked::new(listing);
        let line_of = |at: u32| 1 + marked.0.text[..at as usize].matches('\n').count();
        let found = marked.judge(Dialect::D3d8);
        let said = found.iter().map(|d| (d.rule.id, line_of(d.span.start)));
        let said: Vec<_> = said.collect();
        if said != [(id, line.parse().unwrap())] {
            wrong.push(format!("{row}\n    {said:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
