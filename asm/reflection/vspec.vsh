; Gives texm3x3vspec what it wants: the way from tangent space to the world in three rows, and the eye vector in their w.
; v0       - Vertex Position
; v3       - Vertex Normal
; v7       - Texture Coordinates of the normal map
; v8       - Vertex Tangent U
; v9       - Vertex Tangent V
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix (no scale)
; c8       - Position of the eye in the world
vs.1.1
m4x4 oPos, v0, c0
mov  oT0.xy, v7
dp3  oT1.x, v8, c4        ; row x of the world matrix by tangent, bitangent and normal
dp3  oT1.y, v9, c4
dp3  oT1.z, v3, c4
dp3  oT2.x, v8, c5        ; row y
dp3  oT2.y, v9, c5
dp3  oT2.z, v3, c5
dp3  oT3.x, v8, c6        ; row z
dp3  oT3.y, v9, c6
dp3  oT3.z, v3, c6
m4x3 r0.xyz, v0, c4       ; position in the world
add  r0.xyz, c8, -r0      ; E, from the vertex to the eye
mov  oT1.w, r0.x
mov  oT2.w, r0.y
mov  oT3.w, r0.z
