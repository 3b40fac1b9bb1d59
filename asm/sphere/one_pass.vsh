; Prepares a pixel shader of ps.1.1 that takes the root per pixel: p + t R = sqrt(D) R + (p - (p.R) R) is linear in the root.
;
; The root is read from a texture with D for its coordinate, and texm3x3tex multiplies what was read, (root, ., 1), by the
; rows (R.x, 0, q.x), (R.y, 0, q.y), (R.z, 0, q.z), where q = p - (p.R) R.
; v0       - Vertex Position
; v3       - Vertex Normal
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix (no scale)
; c8       - Position of the eye in the world
; c9       - C, where the cube map was taken; w: 1 / Radius of the environment
; c10      - 0, 1, .5
vs.1.1
def c10, 0, 1, 0.5, 0
m4x4 oPos, v0, c0
m4x3 r0.xyz, v0, c4       ; P, position in the world
m3x3 r1.xyz, v3, c4       ; N, the normal in the world
add  r2.xyz, r0, -c8      ; from the eye to the vertex
dp3  r2.w, r2, r2
rsq  r2.w, r2.w
mul  r2.xyz, r2, r2.w     ; I, of length 1
dp3  r3.w, r1, r2
add  r3.w, r3.w, r3.w
mad  r2.xyz, -r3.w, r1, r2 ; R = I - 2 N (N.I)
add  r0.xyz, r0, -c9
mul  r0.xyz, r0, c9.w     ; p
dp3  r3.x, r0, r2         ; p.R
dp3  r3.y, r0, r0         ; p.p
mad  r3.z, r3.x, r3.x, -r3.y
add  oT0.x, r3.z, c10.y   ; D = (p.R)^2 - p.p + 1
mov  oT0.y, c10.z
mad  r4.xyz, -r3.x, r2, r0 ; q
mov  oT1.x, r2.x
mov  oT1.y, c10.x
mov  oT1.z, r4.x
mov  oT2.x, r2.y
mov  oT2.y, c10.x
mov  oT2.z, r4.y
mov  oT3.x, r2.z
mov  oT3.y, c10.x
mov  oT3.z, r4.z
