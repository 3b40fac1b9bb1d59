; A mirror in the plane: where each point is in the picture that the mirrored camera took.
; v0       - Vertex Position
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix
; c12..c15 - View-Projection Matrix of the mirrored camera
; c16      - .5, -.5; z, w: half a texel of its picture
vs.1.1
m4x4 oPos, v0, c0
m4x4 r0, v0, c4           ; position in the world
m4x4 r1, r0, c12          ; on the mirrored picture, -w..w
; as texture coordinates 0..w: (x + w) / 2, (w - y) / 2, and to the centre of the texel
mul  r2.xy, r1, c16
mad  r2.xy, r1.w, c16.x, r2
mov  r3, c16
mad  oT0.xy, r1.w, r3.zwww, r2
mov  oT0.zw, r1.w
