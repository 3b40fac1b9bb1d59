; Sprites that face the viewer, and the two rows from which each of their pixels gets its depth.
;
; A point of a sprite that is h nearer than its middle has the view distance z - h, and with the projection's a and b the depth
; (a (z - h) + b) / (z - h). The texture gives h as a part of the radius R, and 1: both rows are linear in them.
; v0       - Middle of the sprite
; v5       - Color
; v7       - Corner, 0..1
; c0..c3   - World-View Matrix
; c4..c7   - Projection Matrix; c6 is (0, 0, a, b)
; c8       - 2 R, -2 R, -R, R
; c9       - 0, .5
vs.1.1
def c9, 0, 0.5, 0, 0
m4x4 r0, v0, c0           ; the middle before the viewer
add  r1.xy, v7, -c9.y
mul  r1.xy, r1, c8        ; to the corner
mov  r2, r0
add  r2.xy, r2, r1
m4x4 oPos, r2, c4
mov  oT0.xy, v7
dp4  r3.y, r0, c6         ; a z + b
mov  r4, c8
mul  r3.x, r4.z, c6.z     ; -R a
mov  r3.z, c9.x
mov  oT1.xyz, r3          ; (h, 1, .) by this row: the z of the pixel
mov  r4.y, r0.z
mov  r4.x, r4.z
mov  r4.z, c9.x
mov  oT2.xyz, r4          ; and its w
mov  oT3.xy, v7
mov  oD0, v5
