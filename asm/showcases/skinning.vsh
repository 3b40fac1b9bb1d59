; Palette skinning: each vertex is moved by two bones, which it picks from the constants by the address register.
;
; How high a vertex is on the tube says which: vertex streams of bone numbers and weights would be read here instead.
; v0       - Vertex Position on a tube along y
; v3       - Vertex Normal
; c0..c3   - View-Projection Matrix
; c4       - The way that light goes, of length 1: to the light is -c4
; c5       - x: bones for one unit of y; y: bones at y = 0; z: registers of a bone; w: light that is everywhere
; c6       - 0, 1, the last place between two bones, .5
; c7       - x, y: how often the texture is repeated
; c20...   - Bones, three registers each
vs.1.1
def c6, 0, 1, 2.999, 0.5
mov  r0, c5
mad  r0.x, v0.y, r0.x, r0.y ; the bone, with a fraction
max  r0.x, r0.x, c6.x
min  r0.x, r0.x, c6.z
mov  r1.y, r0.x
frc  r1.y, r1.y           ; the weight of the next bone
add  r2.x, r0.x, -r1.y    ; the bone
mul  r2.x, r2.x, r0.z
add  r2.x, r2.x, c6.w     ; whole numbers must not be rounded down to the one below
mov  a0.x, r2.x
m4x3 r3.xyz, v0, c[a0.x + 20]
m4x3 r4.xyz, v0, c[a0.x + 23]
m3x3 r5.xyz, v3, c[a0.x + 20]
m3x3 r6.xyz, v3, c[a0.x + 23]
add  r4.xyz, r4, -r3
mad  r3.xyz, r4, r1.y, r3 ; the position between both
mov  r3.w, c6.y
add  r6.xyz, r6, -r5
mad  r5.xyz, r6, r1.y, r5
dp3  r5.w, r5, r5
rsq  r5.w, r5.w
mul  r5.xyz, r5, r5.w     ; the normal between both
m4x4 oPos, r3, c0
dp3  r7.x, r5, -c4
max  r7.x, r7.x, c6.x
add  oD0, r7.x, r0.w
mul  oT0.xy, v7, c7
