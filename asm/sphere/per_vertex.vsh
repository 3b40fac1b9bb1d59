; The reflected ray, and where it meets the sphere of the environment, per vertex.
;
; With p = CP / Radius and R of length 1 the ray p + t R is on the sphere of radius 1 where
; t = -p.R + sqrt((p.R)^2 + 1 - p.p), and p + t R is the direction from the centre to that point.
; v0       - Vertex Position
; v3       - Vertex Normal
; c0..c3   - World-View-Projection Matrix
; c4..c7   - World Matrix (no scale)
; c8       - Position of the eye in the world
; c9       - C, where the cube map was taken; w: 1 / Radius of the environment
; c10      - 1
vs.1.1
def c10, 1, 1, 1, 1
m4x4 oPos, v0, c0
m4x3 r0.xyz, v0, c4       ; P, position in the world
m3x3 r1.xyz, v3, c4       ; N, the normal in the world
add  r2.xyz, r0, -c8      ; from the eye to the vertex
dp3  r2.w, r2, r2
rsq  r2.w, r2.w
mul  r2.xyz, r2, r2.w     ; I, of length 1
dp3  r3.w, r1, r2
add  r3.w, r3.w, r3.w
mad  r2.xyz, -r3.w, r1, r2 ; R = I - 2 N (N.I)
add  r0.xyz, r0, -c9
mul  r0.xyz, r0, c9.w     ; p
dp3  r3.x, r0, r2         ; p.R
dp3  r3.y, r0, r0         ; p.p
mad  r3.z, r3.x, r3.x, -r3.y
add  r3.z, r3.z, c10.x    ; D = (p.R)^2 - p.p + 1
rsq  r3.w, r3.z
mul  r3.z, r3.z, r3.w     ; sqrt(D)
add  r3.z, r3.z, -r3.x    ; t
mad  oT0.xyz, r3.z, r2, r0 ; p + t R
