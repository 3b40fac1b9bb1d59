; Hands normal and view direction to a pixel shader that refracts.
; v0       - Vertex Position
; v3       - Vertex Normal
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix (no scale)
; c8       - Position of the eye in the world
vs.1.1
m4x4 oPos, v0, c0
m3x3 oT0.xyz, v3, c4      ; N, the normal in the world
m4x3 r0.xyz, v0, c4       ; position in the world
add  r1.xyz, c8, -r0      ; from the vertex to the eye
dp3  r1.w, r1, r1
rsq  r1.w, r1.w
mul  oT1.xyz, r1, r1.w    ; E, of length 1: here its length counts
