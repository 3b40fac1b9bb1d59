; Shows a cube map unfolded: the square of each face, on the screen already, is textured with the directions to it.
; v0       - Position on the screen
; v3       - Direction to the corner of the face
vs.1.1
mov oPos, v0
mov oT0.xyz, v3           ; straight across the square, as a face of a cube is
