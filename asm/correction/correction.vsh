; Hands normal, view direction and Brennan's correction to a pixel shader that reflects.
; v0       - Vertex Position
; v3       - Vertex Normal
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix (no scale)
; c8       - Position of the eye in the world
; c9       - C, where the cube map was taken; w: 1 / Radius of the room
vs.1.1
m4x4 oPos, v0, c0
m4x3 r0.xyz, v0, c4       ; P, position in the world
m3x3 oT0.xyz, v3, c4      ; N, the normal in the world
add  r1.xyz, c8, -r0      ; from the vertex to the eye
dp3  r1.w, r1, r1
rsq  r1.w, r1.w
mul  oT1.xyz, r1, r1.w    ; E, of length 1: R must have the length that the correction counts on
add  r2.xyz, r0, -c9      ; CP
mul  oT2.xyz, r2, c9.w    ; CP / Radius
