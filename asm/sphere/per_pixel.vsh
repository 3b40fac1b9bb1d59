; Hands the two passes of the exact intersection what they need at each pixel.
; v0       - Vertex Position
; v3       - Vertex Normal
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix (no scale)
; c8       - Position of the eye in the world
; c9       - C, where the cube map was taken; w: 1 / Radius of the environment
; c10      - .5, -.5
; c11      - x, y: half a pixel of the picture, as a part of it
vs.1.1
def c10, 0.5, -0.5, 0, 0
m4x4 r4, v0, c0
mov  oPos, r4
m4x3 r0.xyz, v0, c4       ; P, position in the world
m3x3 oT0.xyz, v3, c4      ; N, the normal in the world
add  r1.xyz, c8, -r0      ; from the vertex to the eye
dp3  r1.w, r1, r1
rsq  r1.w, r1.w
mul  oT1.xyz, r1, r1.w    ; E, of length 1
add  r2.xyz, r0, -c9
mul  oT2.xyz, r2, c9.w    ; p = CP / Radius
; where the pixel is in a picture of the same size: ((x / w + 1) / 2, (1 - y / w) / 2), and half a pixel on, to its texel's centre
mul  r5.xy, r4.xyyy, c10.xyyy
mad  r5.xy, r4.w, c10.x, r5
mad  oT3.xy, r4.w, c11, r5
mov  oT3.zw, r4.w
