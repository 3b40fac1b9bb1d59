; Reflection per vertex: the environment in the direction in which the view ray leaves each vertex.
; v0       - Vertex Position
; v3       - Vertex Normal
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix (no scale)
; c8       - Position of the eye in the world
vs.1.1
m4x4 oPos, v0, c0
m4x3 r0.xyz, v0, c4       ; position in the world
m3x3 r1.xyz, v3, c4       ; N, the normal in the world
add  r2.xyz, r0, -c8      ; I, the incident ray: from the eye to the vertex
; R = I - 2 N (N.I); the length of I does not matter to a cube map
dp3  r3.w, r1, r2         ; N.I
add  r3.w, r3.w, r3.w
mad  oT0.xyz, -r3.w, r1, r2
