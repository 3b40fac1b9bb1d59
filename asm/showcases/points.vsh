; Points that are larger the nearer they are.
; v0       - Vertex Position
; v3       - Vertex Normal, from which the color is made
; c0..c3   - World-View-Projection Matrix
; c4       - x: the size in pixels at distance 1; y: .5
vs.1.1
m4x4 r0, v0, c0
mov  oPos, r0
rcp  r1.x, r0.w
mul  oPts.x, r1.x, c4.x
mov  r2, c4
mad  oD0, v3, r2.y, r2.y
