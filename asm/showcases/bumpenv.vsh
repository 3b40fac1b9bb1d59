; Water over tiles: coordinates of the waves, and of the ground below.
; v0       - Vertex Position
; v7       - Texture Coordinates
; c0..c3   - World-View-Projection Matrix
; c4       - x: how often the waves are repeated; y: how often the ground
vs.1.1
m4x4 oPos, v0, c0
mul  oT0.xy, v7, c4.x
mul  oT1.xy, v7, c4.y
