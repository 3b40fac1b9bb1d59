; Lights a surface from one point, at every vertex: the room around the pane.
; v0       - Vertex Position
; v3       - Vertex Normal
; v7       - Texture Coordinates
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix
; c8       - Position of the lamp in the world; w: how fast its light falls off with the square of the distance
; c9       - Color of the lamp
; c10      - Light that is everywhere
; c11      - 0, .5, 1, 2
vs.1.1
def c11, 0, 0.5, 1, 2
m4x4 oPos, v0, c0
mov  oT0.xy, v7
m4x3 r0.xyz, v0, c4       ; position in the world
m3x3 r1.xyz, v3, c4       ; normal in the world
dp3  r1.w, r1, r1
rsq  r1.w, r1.w
mul  r1.xyz, r1, r1.w
add  r2.xyz, c8, -r0      ; to the lamp
dp3  r2.w, r2, r2         ; distance^2
rsq  r3.w, r2.w
mul  r2.xyz, r2, r3.w
dp3  r3.x, r1, r2         ; N.L
max  r3.x, r3.x, c11.x
mov  r4, c8
mad  r3.y, r2.w, r4.w, c11.z
rcp  r3.y, r3.y           ; 1 / (1 + falloff * distance^2)
mul  r3.x, r3.x, r3.y
mul  r5, r3.x, c9
add  oD0, r5, c10
