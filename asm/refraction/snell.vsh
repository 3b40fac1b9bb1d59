; Refraction per vertex, by Snell's law: T = e I + (e c - sqrt(1 - e^2 (1 - c^2))) N with c = -I.N.
; v0       - Vertex Position
; v3       - Vertex Normal
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix (no scale)
; c8       - Position of the eye in the world
; c9       - e, e^2, 1 - e^2, where e = index of refraction outside / inside
vs.1.1
m4x4 oPos, v0, c0
m4x3 r0.xyz, v0, c4       ; position in the world
m3x3 r1.xyz, v3, c4       ; N, the normal in the world
add  r2.xyz, r0, -c8      ; from the eye to the vertex
dp3  r2.w, r2, r2
rsq  r2.w, r2.w
mul  r2.xyz, r2, r2.w     ; I, of length 1
dp3  r3.x, r1, -r2        ; c
mul  r3.y, r3.x, r3.x     ; c^2
mov  r4, c9
mad  r3.y, r3.y, r4.y, r4.z ; k = e^2 c^2 + 1 - e^2; it is never below 0 on the way into glass
rsq  r3.z, r3.y
mul  r3.y, r3.y, r3.z     ; sqrt(k)
mad  r3.x, r4.x, r3.x, -r3.y ; e c - sqrt(k)
mul  r2.xyz, r2, r4.x     ; e I
mad  oT0.xyz, r3.x, r1, r2 ; T
