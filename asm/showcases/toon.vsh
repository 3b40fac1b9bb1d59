; Gives texdp3tex the light in the space of the normal map.
; v0       - Vertex Position
; v3, v8, v9 - Normal, Tangent U, Tangent V
; v7       - Texture Coordinates
; c0..c3   - World-View-Projection Matrix
; c4       - The way that light goes, of length 1, in the mesh's own space: to the light is -c4
; c5       - x, y: how often the normal map is repeated
vs.1.1
m4x4 oPos, v0, c0
mul  oT0.xy, v7, c5
mov  r0, c4
dp3  oT1.x, v8, -r0
dp3  oT1.y, v9, -r0
dp3  oT1.z, v3, -r0
