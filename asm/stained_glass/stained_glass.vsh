; Sample vertex shader which outputs a 3x3 orthogonal transform which
; takes you from world space to tangent space. The result is stored in
; output tex coords 1,2, and 3. Tex coord 4 stores a view vector which
; can be used in a reflect operation.
; Tex coordinate 5 stores a scaled version of the centroid to vertex
; vector that is used as a correction factor for environment mapping.
; This sample expects the incoming vertex data to be set up as follows:
; v0       - Vertex Position
; v3       - Vertex Normal
; v8       - Vertex Tangent U
; v9       - Vertex Tangent V
; This sample expects the constant store to be set up in the following manner:
; c1       - Color of material
; c12..c15 - World Matrix
; c16..c19 - Composite World-View-Projection Matrix
; c20..c23 - Env Transform Matrix (object to world or view coord transform
;            (depends on type of env mapping you want to do) )
; c28      - ModelSpace Camera Position
; c95      - 0, .5, 1, 2
vs.1.0
def c94, 0.18f, 0.18f, 0.18f, 0.18f ; Scalar for cube map adjustment
                                    ; = roughly 1/Radius of environment map.
; OutPos = ObjSpacePos * Composite World-View-Projection Matrix
m4x4 oPos, v0, c16
mov  oT0.xy, v7           ; passthrough texcoord 0 for bump map addressing
; derive per vertex eye vector using camera position
add  r8, c28, -v0         ; view direction
m3x3 r9, r8, c20          ; transform view vector from object space to env space
dp3  r11.x, r9, r9        ; magnitude^2
rsq  r11.y, r11.x         ; 1/mag
mul  oT4.xyz, r9, r11.y   ; normalize
; upper 3x3 of world matrix by upper tangent space transposed
dp3  oT1.x, c20, v8
dp3  oT1.y, c20, v9
dp3  oT1.z, c20, v3
dp3  oT2.x, c21, v8
dp3  oT2.y, c21, v9
dp3  oT2.z, c21, v3
dp3  oT3.x, c22, v8
dp3  oT3.y, c22, v9
dp3  oT3.z, c22, v3
; Calculate an adjustment amount to account for cube map center not
; being at this object's center.
m3x3 r0, v0, c12          ; Object->World space position without translation.
mul  oT5, r0, c94.w       ; Scale by 1/appoximate scene size
