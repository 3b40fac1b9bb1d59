; Fog that lies on the ground: it grows with the distance and thins out with the height.
; v0       - Vertex Position
; v3       - Vertex Normal
; v7       - Texture Coordinates
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix
; c8       - The way that light goes, of length 1: to the light is -c8
; c9       - x: how much fog a unit of distance has on the ground; y: how fast it thins out; z: light that is everywhere; w: 1
vs.1.1
m4x4 r0, v0, c0
mov  oPos, r0
mov  oT0.xy, v7
m4x3 r1.xyz, v0, c4       ; position in the world
m3x3 r2.xyz, v3, c4
dp3  r2.w, r2, -c8
max  r2.w, r2.w, -r2.w    ; lit from either side
mov  r3, c9
mad  oD0, r2.w, c9.z, r3.z
mul  r4.x, r1.y, -r3.y
exp  r4.x, r4.x           ; 2^(-height * thinning)
mul  r4.x, r4.x, r3.x
mul  r4.x, r4.x, r0.w     ; fog on the way
exp  oFog.x, -r4.x        ; what is left of the surface's own light: 1 is clear
