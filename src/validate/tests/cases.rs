//! For every rule a listing that breaks it alone, with the place in braces, and one next to it that breaks nothing.

use super::Marked;
use crate::policy::Dialect;
use crate::validate::RULES;

/// `ID:` a listing that breaks the rule at the braces and no other; `ID ok:` one that breaks none.
const CASES: &str = "
B1: vs.1.1 | m4x4 oPos, v0, c0 | mov r0, v0 *124 | {mov} r1, v0
B1: vs.1.1 | mov oPos, v0 | exp r0, v0.x *12 | frc r0.xy, v0 *2 | {m3x2} r0.xy, v0, c0
B1 ok: vs.1.1 | m4x4 oPos, v0, c0 | mov r0, v0 *124
B1 ok: vs.1.1 | def c0, 0, 0, 0, 0 | mov oPos, v0 | exp r0, v0.x *12 | frc r0.xy, v0 *2 | nop
B2: ps.1.1 | tex t0 | tex t1 | tex t2 | tex t3 | {tex} t3 | mov r0, t0
B2 ok: ps.1.1 | tex t0 | tex t1 | tex t2 | tex t3 | mov r0, t0
B3: ps.1.1 | mul r0, v0, v0 *8 | {mul} r0, v0, v0
B3: ps.1.2 | cmp r0, v0, v1, v1 *3 | mul r0, v0, v0 *2 | {mul} r0, v0, v0
B3: ps.1.1 | tex t0 | texbeml t1, t0 | mul r0, t1, v0 *7 | {mul} r0, t1, v0
B3 ok: ps.1.1 | mul r0, v0, v0 *7 | mul r0.rgb, v0, v0 | +mov r0.a, v0
B3 ok: ps.1.1 | nop *9 | mul r0, v0, v0 *8
B4: ps.1.4 | texld r0, t0 *6 | {texld} r0, t0
B4 ok: ps.1.4 | texld r0, t0 *6 | phase | texld r0, t0 *6
B5: ps.1.4 | mul r0, c0, c0 *8 | {mul} r0, c0, c0
B5: ps.1.4 | bem r0.rg, c0, c1 | mul r0, c0, c0 *6 | {mul} r0, c0, c0 | phase | mov r0, c0
B5 ok: ps.1.4 | mul r0, c0, c0 *8 | phase | mul r0, c0, c0 *8
B6: ps.1.2 | dp4 r0, c0, c1 *4 | {dp4} r0, c0, c1
B6 ok: ps.1.2 | dp4 r0, c0, c1 *4
B6 ok: ps.1.4 | dp4 r0, c0, c1 *5
B7: ps.1.3 | cmp r0, c0, c1, c1 *3 | {cmp} r0, c0, c1, c1
B7 ok: ps.1.3 | cmp r0, c0, c1, c1 *3
B8: ps.1.4 | bem r0.rg, c0, c1 | {bem} r1.rg, c0, c1 | phase | mov r0, c0
B8 ok: ps.1.4 | bem r0.rg, c0, c1 | phase | mov r0, c0
B9: ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, r0_dz *2 | texld r3, {r0_dz} | mov r0, r3
B9 ok: ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, r0_dz *2 | texld r3, r0 | mov r0, r3
B10: ps.1.4 | phase | {phase} | mov r0, c0
B10 ok: ps.1.4 | phase | mov r0, c0
S2: ps.1.1 | tex t0 | {def c0, 0, 0, 0, 0} | def c1, 0, 0, 0, 0 | mul r0, t0, c0
S2 ok: ps.1.1 | def c0, 0, 0, 0, 0 | tex t0 | mul r0, t0, c0
S3: ps.1.1 | mov r0, v0 | {tex} t0 | tex t1 | mov r0, t0
S3 ok: ps.1.1 | nop | tex t0 | tex t1 | mov r0, t0
S4: ps.1.4 | mov r0, c0 | {texld} r1, t0
S4 ok: ps.1.4 | mov r0, c0 | phase | texld r0, t0
S5: ps.1.3 | {phase} | mov r0, v0
S5 ok: ps.1.4 | phase | mov r0, v0
S6: {ps.1.1} | mov r1, v0
S6: {ps.1.1} | mov r0.rgb, v0
S6 ok: ps.1.1 | mov r0.rgb, v0 | +mov r0.a, v0
S7: {ps.1.4} | texld r0, t0 | phase | mov r0.rgb, c0
S7 ok: ps.1.4 | texld r0, t0 | phase | mov r0.a, c0
S8: {vs.1.1} | mov oD0, v0
S8 ok: vs.1.1 | mov oPos, v0
S9: vs.1.1 | mov {oPos.xyz}, v0
S9 ok: vs.1.1 | mov oPos.xyz, v0 | mov oPos.w, c0
S9 ok: vs.1.1 | dp4 oPos.x, v0, c0 | dp4 oPos.y, v0, c1 | dp4 oPos.z, v0, c2 | dp4 oPos.w, v0, c3
S10 d3d9: vs.1.1 | mov oPos, v0 | mov {oT1}, v7
S10 d3d9: vs.1.1 | mov oPos, v0 | mov {oT0.y}, v7
S10 d3d9 ok: vs.1.1 | mov oPos, v0 | mov oT0.y, v7 | mov oT0.x, v7 | mov oT1, v7
S14: ps.1.1 | tex t0 | {cmp} r0, t0, c0, c1
S14 ok: ps.1.2 | tex t0 | cmp r0, t0, c0, c1
O1: ps.1.1 | mov {r2}, v0 | mov r0, v0
O1: ps.1.4 | mov r0, {c8}
O1: vs.1.1 | mov r9, v0 | mov r10, v0 | mov r11, v0 | m4x4 oPos, v0, {r9}
O1 ok: ps.1.1 | mov r1, v0 | mov r0, v0
O1 ok: ps.1.4 | mov r0, c7
O2: ps.1.1 | mov {c0}, v0 | mov r0, v0
O2: vs.1.1 | mov {v0}, c0 | mov oPos, v0
O2 ok: ps.1.1 | mov r0, v0
O3: vs.1.1 | mov oPos, v0 | mov r0, {oD0}
O3: ps.1.3 | mov r0, v0 | cnd r0, {a0.a}, v0, v1
O3 ok: vs.1.1 | mov oPos, v0 | mov oD0, v0
O4: vs.1.0 | mov oPos, v0 | mov r0, {c[a0.x]}
O4: vs.1.0 | mov oPos, v0 | mov {a0.x}, v1.x
O4 ok: vs.1.1 | mov oPos, v0 | mov a0.x, v1.x | mov r0, c[a0.x]
O5: vs.1.1 | mov oPos, v0 | add {a0.x}, v0, v0
O5: vs.1.1 | mov oPos, v0 | mov {a0}, v0
O5: vs.1.1 | mov oPos, v0 | mov r0, {c[a0.x + 2]} | mov r0, c[a0.x + 2]
O5 ok: vs.1.1 | mov oPos, v0 | mov a0.x, v0 | mov r0, c[a0.x + 2]
O6 built: vs.1.1
O6 ok: vs.1.1 | mov oPos, v0 | mov a0.x, v0 | mov r0, -c[a0.x + 2].wzyx
O8: ps.1.4 | mul r0, c0, {t0}
O8: ps.1.4 | mov {t0}, c0 | mov r0, c0
O8 ok: ps.1.1 | tex t0 | mul r0, c0, t0
O9: ps.1.4 | mul r0, c0, {v0} | phase | mov r0, c0
O9 ok: ps.1.4 | mul r0, c0, c0 | phase | mov r0, v0
O9 ok: ps.1.4 | mul r0, c0, v0
O10: ps.1.1 | tex t0 | texbem t1, {r0} | mov r0, t1
O10: ps.1.1 | tex {r0} | mov r0, v0
O10 ok: ps.1.1 | tex t0 | texbem t1, t0 | mov r0, t1
O11: ps.1.4 | texld {t0}, t0 | mov r0, c0
O11: ps.1.4 | texcrd r0.rgb, t0 | texld r1, {r0} | phase | mov r0, c0
O11 ok: ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, r0 | mov r0, r1
O12: ps.1.4 | texcrd {r1.r}, t0 | mov r0, c0
O12: ps.1.4 | texcrd {r1}, t0 | mov r0, c0
O12: ps.1.4 | texcrd {r1.rgb}, t0_dw.xyw | mov r0, c0
O12: ps.1.4 | texcrd r1.rgb, {r2} | mov r0, c0
O12 ok: ps.1.4 | texcrd r1.rgb, t0 | texcrd r2.rg, t1_dw.xyw | mov r0, c0
O13: ps.1.4 | texld r0, {c0}
O13: ps.1.1 | tex t0 | texbem t1, {c0} | mov r0, t1
O13 ok: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3spec t3, t0, c0 | mov r0, t3
O14: ps.1.4 | texcrd r0.rgb, t0 | phase | texdepth {r0} | mov r0, c0
O14: ps.1.4 | texcrd r5.rgb, t0 | texdepth {r5} | phase | mov r0, c0
O14 ok: ps.1.4 | texcrd r5.rgb, t0 | phase | texdepth r5 | mov r0, c0
O15: ps.1.1 | mov r1, v0 | cnd r0, {r1.a}, v0, v1
O15: ps.1.1 | mov r0, v0 | cnd r0, {r0}, v0, v1
O15 ok: ps.1.1 | mov r0, v0 | cnd r0, r0.a, v0, v1
O15 ok: ps.1.4 | mov r1, c0 | cnd r0, r1, c0, c1
O16: ps.1.1 | mov r0, v0 | cnd {r0.r}, r0.a, v0, v1
O16 ok: ps.1.1 | mov r0, v0 | cnd r0.rgb, r0.a, v0, v1
O17: ps.1.2 | mov r0, v0 | cmp r0, {r0}, v0, v1
O17 ok: ps.1.2 | mov r1, v0 | cmp r0, r1, v0, v1
O17 ok: ps.1.4 | mov r0, c0 | cmp r0, r0, c0, c1
O18: ps.1.4 | bem {r0.rgb}, c0, c1 | phase | mov r0, c0
O18: ps.1.4 | {bem} r0.rg, c0, c1 | mov r0, c0
O18 ok: ps.1.4 | bem r0.rg, c0, c1 | phase | mov r0, c0
O19: vs.1.1 | m4x4 oPos, v0, {-c0}
O19: vs.1.1 | mov oPos, v0 | m3x3 {r0}, v0, c0
O19 ok: vs.1.1 | m4x4 oPos, -v0.wzyx, c0 | m3x3 r0.xyz, v0, c0
O20: vs.1.1 | mov r0, v0 | m4x4 r0, {r0}, c0 | mov oPos, r0
O20 ok: vs.1.1 | mov r0, v0 | m4x4 r1, r0, c0 | mov oPos, r1
O21: vs.1.1 | mov oPos, v0 | rcp r0, {v0}
O21 ok: vs.1.1 | mov oPos, v0 | rcp r0, v0.w | logp r0, -v0.y
O22: vs.1.1 | mov oPos, v0 | frc {r0}, v0
O22 ok: vs.1.1 | mov oPos, v0 | frc r0.xy, v0 | frc r0.y, v0
O23 built: vs.1.1
O23 ok: vs.1.1 | mov oPos, -v0
O25: ps.1.1 | def {c8}, 0, 0, 0, 0 | mov r0, v0
O25: ps.1.1 | def {r0}, 0, 0, 0, 0 | mov r0, v0
O25 ok: ps.1.1 | def c7, 0, 0, 0, 0 | mov r0, v0
O26: vs.1.1 | mov oPos, {c96}
O26: vs.1.1 | m4x4 oPos, v0, {c93}
O26: vs.1.1 | mov oPos, {c300}
O26 ok: vs.1.1 | def c95, 0, 0, 0, 0 | m4x4 oPos, v0, c92
M1: ps.1.1 | {mul_x8} r0, v0, v0
M1: ps.1.1 | mul r0, v0, {v0_x2}
M1 ok: ps.1.1 | mul_x4 r0, v0, v0
M1 ok: ps.1.4 | mul_x8_sat r0, v0, v0_x2
M2: ps.1.1 | {tex_sat} t0 | mov r0, t0
M2 ok: ps.1.1 | tex t0 | mov_sat r0, t0
M3: ps.1.1 | tex t0 | texbem t1, {t0_bx2} | mov r0, t1
M3: ps.1.1 | tex t0 | texm3x2pad t1, {1-t0} | texm3x2tex t2, t0 | mov r0, t2
M3: ps.1.4 | texld r0, {t0_bx2}
M3 ok: ps.1.1 | tex t0 | texm3x2pad t1, t0_bx2 | texm3x2tex t2, t0_bx2 | mov r0, t2
M5: ps.1.4 | mul r0, c1, {1-c0}
M5 ok: ps.1.4 | mov r0, c0 | mul r0, c1, 1-r0
M6: ps.1.1 | add r0, v0, {-c1}
M6 ok: ps.1.1 | sub r0, v0, c1
M7: ps.1.1 | mov r0, v0 | mov {r0.r}, c0
M7 ok: ps.1.1 | mov r0, v0 | mov r0.a, c0
M7 ok: ps.1.4 | mov r0, v0 | mov r0.r, c0
M8: ps.1.1 | mov r0, v0 | dp3 {r0.a}, v0, v1
M8 ok: ps.1.1 | mov r0, v0 | dp3 r0.rgb, v0, v1
M9: ps.1.1 | mul r0, v1, {v0.b}
M9: ps.1.0 | mov r0, v0 | mov r0.a, {v0.b}
M9: ps.1.1 | mov r0, {v0.r}
M9 ok: ps.1.1 | mul r0, v1, v0.a | mov r0.a, v0.b
M10: ps.1.4 | mov r0, {c0.gbr}
M10: ps.1.4 | texld r0, {t0.x}
M10: ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, {r0.xyw} | mov r0, r1
M10 ok: ps.1.4 | texld r0, t0.xyz | texld r1, t1.xyw | mov r0, c0.g
M11: ps.1.4 | texld r0, t0.xyz | texcrd r1.rgb, {t0.xyw}
M11: ps.1.4 | texld r0, t0 | phase | texld r0, {t0_dw.xyw}
M11 ok: ps.1.4 | texld r0, t0_dw.xyw | texcrd r1.rgb, t0.xyw | texld r2, t1
M12: ps.1.4 | texld r0, {t0_dz}
M12: ps.1.4 | texld r0, {t0_dw}
M12: ps.1.4 | mov r1, c0 | mov r0, {r1_dz}
M12 ok: ps.1.4 | texld r0, t0_dw.xyw | texcrd r1.rgb, t1 | phase | texld r0, r1_dz
M13: ps.1.1 | tex {t0.rgb} | mov r0, t0
M13 ok: ps.1.1 | tex t0 | mov r0, t0
R1: vs.1.1 | mov oPos, v0 | add r0, c0, {c1}
R1: vs.1.1 | mov a0.x, v0 | mov oPos, v0 | add r0, c2, {c[a0.x + 2]}
R1: vs.1.1 | m4x4 oPos, c8, {c0}
R1 ok: vs.1.1 | mov oPos, v0 | add r0, c0.x, -c0.y
R2: vs.1.1 | mov oPos, v0 | add r0, v0, {v1}
R2: vs.1.1 | m4x4 oPos, v0, {v1}
R2 ok: vs.1.1 | mov oPos, v0 | mad r0, v0, c0, v0
R4: ps.1.1 | mad r0, c0, c1, {c2}
R4 ok: ps.1.1 | mad r0, c0, c1, c0
R6: ps.1.0 | tex t0 | tex t1 | mul r0, t0, {t1}
R6: ps.1.0 | mul r0, v0, {v1}
R6 ok: ps.1.0 | tex t0 | mad r0, t0, v0, t0.a
R7: ps.1.1 | tex t0 | tex t1 | tex t2 | mad r0, t0, t1, {t2}
R7 ok: ps.1.2 | tex t0 | tex t1 | tex t2 | mad r0, t0, t1, t2
R11: ps.1.1 | mad r0.rgb, c0, c1, v0 | +mad r0.a, c2, {c3}, v0
R11 ok: ps.1.1 | mad r0.rgb, c0, c1, v0 | +mad r0.a, c2, c1, v0
T1: ps.1.1 | tex t1 | tex {t0} | mov r0, t0
T1: ps.1.1 | tex t0 | tex {t0} | mov r0, t0
T1: ps.1.1 | tex t0 | texkill {t0} | mov r0, t0
T1 ok: ps.1.1 | tex t0 | tex t3 | mov r0, t0
T3: ps.1.1 | tex t1 | texbem t2, {t0} | mov r0, t2
T3: ps.1.1 | tex t0 | texbem t1, {t2} | tex t2 | mov r0, t2
T3 ok: ps.1.1 | tex t0 | texbem t2, t0 | mov r0, t2
T4: ps.1.1 | tex t0 | texm3x2pad t1, t0 | {tex} t2 | mov r0, t2
T4: ps.1.1 | tex t0 | texm3x2pad t1, t0 | {texm3x2tex} t3, t0 | mov r0, t3
T4: ps.1.1 | tex t0 | {texm3x2tex} t1, t0 | mov r0, t1
T4 ok: ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t2, t0 | tex t3 | mov r0, t2
T5: ps.1.1 | tex t0 | texm3x3pad t1, t0 | {texm3x3tex} t2, t0 | mov r0, t2
T5: ps.1.1 | tex t0 | {texm3x3vspec} t3, t0 | mov r0, t3
T5 ok: ps.1.1 | tex t0 | texm3x3pad t1, t0 | texm3x3pad t2, t0 | texm3x3vspec t3, t0 | mov r0, t3
T6: ps.1.1 | tex t0 | tex t1 | texm3x2pad t2, t0 | texm3x2tex t3, {t1} | mov r0, t3
T6 ok: ps.1.1 | tex t0 | tex t1 | texm3x2pad t2, t0 | texm3x2tex t3, t0 | mov r0, t3
T7: ps.1.1 | tex t0 | {texm3x2pad} t1, t0 | mov r0, t0
T7 ok: ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t2, t0 | mov r0, t0
T8: ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t2, t0 | mul r0, {t1}, t1
T8 ok: ps.1.1 | tex t0 | texm3x2pad t1, t0 | texm3x2tex t2, t0 | mov t1, v0 | mov r0, t1
T9: ps.1.1 | tex t0 | texbem t1, t0 | add r0, t1, {t0}
T9 ok: ps.1.1 | tex t0 | texbem t1, t0 | texbeml t2, t0 | add r0, t1, t2
T9 ok: ps.1.1 | tex t0 | texbem t1, t0 | mov t0, v0 | add r0, t1, t0
T10: ps.1.3 | tex t0 | texm3x2pad t1, t0 | texm3x2depth t2, t0 | mov r0, {t2}
T10 ok: ps.1.3 | tex t0 | texm3x2pad t1, t0 | texm3x2depth t2, t0 | mov r0, t0
T11: ps.1.1 | tex t0 | texkill t1 | mov r0, {t1}
T11 ok: ps.1.1 | tex t0 | texkill t1 | mov r0, t0
T12: ps.1.1 | tex t0 | texbem t1, t0 | texreg2ar t2, {t1} | mov r0, t2
T12 ok: ps.1.1 | tex t0 | tex t1 | texreg2ar t2, t1 | mov r0, t2
T13: ps.1.4 | texcrd r0.rgb, t0 | phase | texld r1, {r2} | mov r0, r1
T13: ps.1.4 | texcrd r0.rg, t0_dw.xyw | phase | texld r1, {r0} | mov r0, r1
T13: ps.1.4 | texld r0, t0 | phase | texld r1, t1 | texld r2, {r1} | mov r0, r2
T13: ps.1.4 | texcrd r0.rgb, t0 | texld r1, {r0} | mov r0, r1
T13 ok: ps.1.4 | texcrd r0.rgb, t0 | phase | texld r0, r0
I1: ps.1.1 | add r0, {r0}, v0
I1: vs.1.1 | m3x3 r0.xyz, v0, c0 | mov oPos, {r0} | mov oT0, r0
I1: ps.1.1 | mov r0.rgb, v0 | +mov r0.a, {r0.a}
I1 ok: ps.1.1 | mov r0.rgb, v0 | +mov r0.a, v0 | mul r0, r0, r0
I1 ok: vs.1.1 | m3x3 r0.xyz, v0, c0 | mov oPos, v0 | mov oT0.xyz, r0 | dp3 oT1.x, r0, r0
I1 ok: vs.1.1 | mov oPos, v0 | mov r0.x, v0 | mov oFog, r0 | mov oPts, r0
I2: ps.1.4 | texld r0, t0 | phase | mov r0, {r0}
I2 ok: ps.1.4 | texld r0, t0 | phase | mov r0.rgb, r0 | +mov r0.a, c0
I3: ps.1.4 | texcrd r1.rgb, t0 | mov r0, {r1}
I3: ps.1.4 | texcrd r1.rg, t0_dw.xyw | mov r0, {r1.b}
I3 ok: ps.1.4 | texcrd r1.rgb, t0 | mov r1.a, c0 | mov r0, r1
I4: ps.1.1 | mov r0, {t0} | mul r0, r0, t0
I4 ok: ps.1.1 | texcoord t0 | mov r0, t0
I4 ok: ps.1.1 | mov t0, v0 | mov r0, t0
I5: ps.1.4 | texcrd r5.rgb, t0 | phase | texdepth r5 | mul r0, c0, {r5.r}
I5 ok: ps.1.4 | texcrd r5.rgb, t0 | phase | texdepth r5 | mov r5, c0 | mov r0, r5
C1: vs.1.1 | mov oPos, v0 | +{mov} r0, v0
C1 ok: vs.1.1 | mov oPos, v0 | mov r0, v0
C2: ps.1.1 | +{mov} r0, v0
C2: ps.1.1 | tex t0 | +{mov} r0, t0
C2: ps.1.1 | mov r0.rgb, v0 | +mov r0.a, v0 | +{mov} r0.rgb, v1
C2 ok: ps.1.1 | mov r0.rgb, v0 | +mov r0.a, v0
C3: ps.1.1 | mov r0, v0 | +mov {r1.a}, v0
C3 ok: ps.1.1 | mov r0.a, v0 | +mov r0.rgb, v1
C4: ps.1.4 | mov r0, c0 | +mov {r1.a}, c0
C4 ok: ps.1.4 | mov r0, c0 | mov r0.rg, c1 | +mov r1.a, c1
C5: ps.1.0 | mov r0, v0 | mul r0.rgb, v0, v0 | +mov {r1.a}, v0
C5 ok: ps.1.1 | mov r0, v0 | mul r0.rgb, v0, v0 | +mov r1.a, v0
C6: ps.1.4 | mov r0, c0 | mov r0.a, c1 | +{dp4} r0.rgb, c0, c1
C6: ps.1.4 | mov r0, c0 | mov r0.rgb, c1 | +{dp3} r0.a, c0, c1
C6 ok: ps.1.4 | mov r0, c0 | mov r0.a, c1 | +dp3 r0.rgb, c0, c1
C7: ps.1.1 | tex t0 | +{tex} t1 | mov r0, t0
C7: ps.1.1 | mov r0, v0 | +{nop}
C7 ok: ps.1.1 | tex t0 | tex t1 | mov r0, t0
";

/// The cases: identifier, dialect, whether nothing may be said, listing.
fn cases() -> impl Iterator<Item = (&'static str, Dialect, bool, &'static str)> {
    let lines = CASES.lines().filter(|l| !l.is_empty());
    lines.filter_map(|line| {
        let (head, listing) = line.split_once(':').unwrap();
        let words: Vec<&str> = head.split(' ').collect();
        let dialect = if words.contains(&"d3d9") {
            Dialect::D3d9
        } else {
            Dialect::D3d8
        };
        // What no text can say is built in `listings`.
        let built = words.contains(&"built");
        (!built).then_some((words[0], dialect, words.contains(&"ok"), listing.trim()))
    })
}

#[test]
fn listings_break_the_rule_that_they_are_made_to_break() {
    let mut wrong = Vec::new();
    for (id, dialect, ok, line) in cases() {
        let listing = Marked::new(line);
        let found = listing.judge(dialect);
        let want: Vec<_> = listing.marks.iter().map(|m| (id, *m)).collect();
        assert_eq!(want.is_empty(), ok, "{id}: {line}");
        let got: Vec<_> = found.iter().map(|d| (d.rule.id, d.span)).collect();
        if got != want {
            let said: Vec<_> = found
                .iter()
                .map(|d| (d.rule.id, d.span, &d.message))
                .collect();
            wrong.push(format!("{id}: {line}\n    {said:?} instead of {want:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_rule_has_a_listing_on_either_side() {
    for rule in RULES {
        let mut heads = CASES.lines().filter_map(|l| Some(l.split_once(':')?.0));
        let bad = heads.any(|h| h.starts_with(&format!("{} ", rule.id)) && !h.ends_with("ok"))
            || CASES.contains(&format!("\n{}: ", rule.id));
        let ok = cases().any(|(id, _, ok, _)| id == rule.id && ok);
        assert!(bad && ok, "{}", rule.id);
    }
    for (id, ..) in cases() {
        assert!(RULES.iter().any(|r| r.id == id), "{id} is no rule");
    }
}

#[test]
fn every_message_is_written_for_people() {
    for (id, dialect, _, line) in cases() {
        for found in Marked::new(line).judge(dialect) {
            let help = found.help.unwrap_or_default();
            assert!(
                !found.message.is_empty() && !help.is_empty(),
                "{id}: {line}"
            );
            let both = format!("{} {help}", found.message);
            // No placeholder, no doubled blank, no unnamed mask.
            for hole in ["  ", "{", "Some(", " ,", "does not write ;"] {
                assert!(!both.contains(hole), "{id}: {both}");
            }
            assert!(
                !found.message.ends_with('.') && !help.ends_with('.'),
                "{both}"
            );
        }
    }
}
