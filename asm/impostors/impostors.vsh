; Prepares the intersection of the reflected ray with two billboards, each of which lies across an axis of the world.
;
; A ray P + t R meets the plane z = Z at t = (Z - P.z) / R.z. What u is there, u = a x + o, is
; (u(P) R.z + a (Z - P.z) R.x) / R.z: two products and a division, which the sampler does.
; v0       - Vertex Position
; v3       - Vertex Normal
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix (no scale)
; c8       - Position of the eye in the world
; c9       - Floor, the plane y = 0: u = x * c9.x + c9.z, v = z * c9.y + c9.w
; c10      - Statue, the plane z = Z: u = x * c10.x + c10.z, v = y * c10.y + c10.w
; c11      - x: Z; y: c10.x, which is c10.y, too; z: 1
vs.1.1
m4x4 oPos, v0, c0
m4x3 r0.xyz, v0, c4       ; P, position in the world
m3x3 oT0.xyz, v3, c4      ; N
add  r1.xyz, c8, -r0
dp3  r1.w, r1, r1
rsq  r1.w, r1.w
mul  oT1.xyz, r1, r1.w    ; E, of length 1
mov  r2, c9
mad  oT2.xy, r0.xzzz, r2.xyyy, r2.zwww ; u(P), v(P) on the floor
mov  r3, c11
mov  oT2.z, r3.z          ; 1
mul  r4.xy, r0.y, c9
mov  oT3.xy, -r4          ; a (0 - P.y)
add  r4.z, r3.x, -r0.z
mul  oT3.z, r4.z, r3.y    ; a (Z - P.z)
mov  r5, c10
mad  oT4.xy, r0.xyyy, r5.xyyy, r5.zwww ; u(P), v(P) on the statue's billboard
mov  oT4.z, r3.z          ; 1
