; A mirror with bumps: the same as without, and the view direction in the space of the normal map.
; v0       - Vertex Position
; v3, v8, v9 - Normal, Tangent U, Tangent V
; v7       - Texture Coordinates of the normal map
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix
; c8       - Position of the eye in the mesh's own space
; c12..c15 - View-Projection Matrix of the mirrored camera
; c16      - .5, -.5; z, w: half a texel of its picture
; c17      - What everything on the picture is scaled by, to stay among small numbers
vs.1.1
m4x4 oPos, v0, c0
mov  oT0.xy, v7
m4x4 r0, v0, c4           ; position in the world
m4x4 r1, r0, c12          ; on the mirrored picture, -w..w
mul  r1, r1, c17
mul  r2.xy, r1, c16
mad  r2.xy, r1.w, c16.x, r2
mov  r3, c16
mad  oT1.xy, r1.w, r3.zwww, r2
mov  oT1.zw, r1.w
add  r4.xyz, c8, -v0      ; to the eye
dp3  r4.w, r4, r4
rsq  r4.w, r4.w
mul  r4.xyz, r4, r4.w     ; E, of length 1
dp3  oT2.x, r4, v8
dp3  oT2.y, r4, v9
dp3  oT2.z, r4, v3
