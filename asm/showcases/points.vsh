; Points that are larger the nearer they are.
; v0       - Vertex Position
; v3       - Vertex Normal, from which the color is made
; v7       - Texture Coordinates, 0..1: where one is 1 the mesh closes, and has the vertices of 0 once more
; c0..c3   - World-View-Projection Matrix
; c4       - x: the size in pixels at distance 1; y: .5; z: 1
vs.1.1
m4x4 r0, v0, c0
mov  oPos, r0
rcp  r1.x, r0.w
mul  oPts.x, r1.x, c4.x   ; pixels
mov  r2, c4
mad  r3, v3, r2.y, r2.y   ; -1..1 to 0..1
slt  r4.xy, v7, c4.z      ; 1 for a vertex that is not there twice
mul  r4.x, r4.x, r4.y
mul  oD0, r3, r4.x        ; light that is added twice would be twice as bright
