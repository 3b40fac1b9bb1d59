; A ball as its own sprite's textures have it: its height towards the viewer, and its light.
; v0       - Vertex Position on a ball of radius 1
; v3       - Vertex Normal
; c0..c3   - World-View-Projection Matrix
; c4       - To the light
; c5       - 0, 1; z: light that is everywhere
vs.1.1
def c5, 0, 1, 0.25, 0
m4x4 oPos, v0, c0
mov  oD1.x, -v0.z         ; h: the viewer is at -z
mov  oD1.yzw, c5.y
dp3  r0.x, v3, c4
max  r0.x, r0.x, c5.x
add  oD0.xyz, r0.x, c5.z
mov  oD0.w, c5.y          ; opaque: beside the ball there is nothing
