// vs.1.0 listing and ps.1.4 listing, translated by texcrd.
//
// What binds where:
//   group 0, binding 0: vs, uniform block of the vertex shader, 480 bytes
//   group 1, binding 0: texture0, 2D texture of stage 0
//   group 1, binding 1: sampler0, sampler of stage 0
//   group 1, binding 4: texture2, cube as six layers +X, -X, +Y, -Y, +Z, -Z of stage 2
//   group 1, binding 5: sampler2, sampler of stage 2, clamps uv
//   group 1, binding 6: texture3, 2D texture of stage 3
//   group 1, binding 7: sampler3, sampler of stage 3
//   group 1, binding 8: texture4, cube of stage 4
//   group 1, binding 9: sampler4, sampler of stage 4
//   group 1, binding 10: texture5, 2D texture of stage 5
//   group 1, binding 11: sampler5, sampler of stage 5

struct VertexUniforms {
    c: array<vec4f, 29>, // c0, c1, …
    viewport: vec2f, // width and height in pixels
}

@group(0) @binding(0) var<uniform> vs: VertexUniforms;
@group(1) @binding(0) var texture0: texture_2d<f32>;
@group(1) @binding(1) var sampler0: sampler;
@group(1) @binding(4) var texture2: texture_2d_array<f32>;
@group(1) @binding(5) var sampler2: sampler;
@group(1) @binding(6) var texture3: texture_2d<f32>;
@group(1) @binding(7) var sampler3: sampler;
@group(1) @binding(8) var texture4: texture_cube<f32>;
@group(1) @binding(9) var sampler4: sampler;
@group(1) @binding(10) var texture5: texture_2d<f32>;
@group(1) @binding(11) var sampler5: sampler;

struct VertexInput {
    @location(0) v0: vec4f,
    @location(3) v3: vec4f,
    @location(7) v7: vec4f,
    @location(8) v8: vec4f,
    @location(9) v9: vec4f,
}

struct Varyings {
    @builtin(position) position: vec4f,
    @location(0) t0: vec2f,
    @location(1) t1: vec3f,
    @location(2) t2: vec3f,
    @location(3) t3: vec3f,
    @location(4) t4: vec3f,
    @location(5) t5: vec3f,
}

// 1 / √|x|; the largest number where x is 0.
fn rsq(x: f32) -> f32 {
    return select(inverseSqrt(abs(x)), 3.4028234e38, abs(x) < 1.1754944e-38);
}

// The face of a cube that a direction meets: +X, -X, +Y, -Y, +Z, -Z; among equals z comes before y and y before x.
fn cube_face(direction: vec3f) -> u32 {
    let a = abs(direction);
    if a.z >= a.y && a.z >= a.x {
        return select(4u, 5u, direction.z < 0.0);
    }
    if a.y >= a.x {
        return select(2u, 3u, direction.y < 0.0);
    }
    return select(0u, 1u, direction.x < 0.0);
}

// A direction along a face of a cube: to the right, down and outwards.
fn along_face(face: u32, d: vec3f) -> vec3f {
    switch face {
        case 0u: { return vec3f(-d.z, -d.y, d.x); }
        case 1u: { return vec3f(d.z, -d.y, -d.x); }
        case 2u: { return vec3f(d.x, d.z, d.y); }
        case 3u: { return vec3f(d.x, -d.z, -d.y); }
        case 4u: { return vec3f(d.x, -d.y, d.z); }
        default: { return vec3f(-d.x, -d.y, -d.z); }
    }
}

// Where a direction meets the plane of a face, 0 to 1 to the right and down; far away where it points past the plane.
fn on_face(face: u32, direction: vec3f) -> vec2f {
    let at = along_face(face, direction);
    let a = abs(direction);
    let distance = max(at.z, max(a.x, max(a.y, a.z)) / 1048576.0);
    return select((at.xy / distance + 1.0) / 2.0, vec2f(0.5), distance == 0.0);
}

// The step in a face from a pixel to its neighbour, from derivatives. One on another face is looked for in the plane of this one.
fn face_step(face: u32, at: vec2f, direction: vec3f, d: vec3f, d_at: vec2f, d_face: f32) -> vec2f {
    if d_face == 0.0 {
        return d_at;
    }
    let is_ahead = f32(cube_face(direction + d)) - f32(face) == d_face;
    return on_face(face, select(direction - d, direction + d, is_ahead)) - at;
}

// A cube as Direct3D 8 filters it, each face for itself.
fn sample_faces(faces: texture_2d_array<f32>, clamped: sampler, direction: vec3f) -> vec4f {
    let face = cube_face(direction);
    let at = on_face(face, direction);
    let x = face_step(face, at, direction, dpdxFine(direction), dpdxFine(at), dpdxFine(f32(face)));
    let y = face_step(face, at, direction, dpdyFine(direction), dpdyFine(at), dpdyFine(f32(face)));
    return textureSampleGrad(faces, clamped, at, face, x, y);
}

@vertex
fn vs_main(in: VertexInput) -> Varyings {
    // 1: ; Sample vertex shader which outputs a 3x3 orthogonal transform which
    // 2: ; takes you from world space to tangent space. The result is stored in
    // 3: ; output tex coords 1,2, and 3. Tex coord 4 stores a view vector which
    // 4: ; can be used in a reflect operation.
    // 5: ; Tex coordinate 5 stores a scaled version of the centroid to vertex
    // 6: ; vector that is used as a correction factor for environment mapping.
    // 7: ; This sample expects the incoming vertex data to be set up as follows:
    // 8: ; v0 - Vertex Position
    // 9: ; v3 - Vertex Normal
    // 10: ; v8 - Vertex Tangent U
    // 11: ; v9 - Vertex Tangent V
    // 12: ; This sample expects the constant store to be set up in the following manner:
    // 13: ; c1 - Color of material
    // 14: ; c12..c15 - World Matrix
    // 15: ; c16..c19 - Composite World-View-Projection Matrix
    // 16: ; c20..c23 - Env Transform Matrix (object to world or view coord transform
    // 17: ; (depends on type of env mapping you want to do) )
    // 18: ; c28 - ModelSpace Camera Position
    // 19: ; c95 - 0, .5, 1, 2
    // 20: vs.1.0
    var r0: vec4f;
    var r8: vec4f;
    var r9: vec3f;
    var r11: vec2f;
    var oPos: vec4f;
    var oT0: vec2f;
    var oT1: vec3f;
    var oT2: vec3f;
    var oT3: vec3f;
    var oT4: vec3f;
    var oT5: vec4f;
    // 21: def c94, 0.18f, 0.18f, 0.18f, 0.18f ; Scalar for cube map adjustment
    const c94 = vec4f(0.18);
    // 22: ; = roughly 1/Radius of environment map.
    // 23: ; OutPos = ObjSpacePos * Composite World-View-Projection Matrix
    // 24: m4x4 oPos, v0, c16
    oPos = vec4f(
        dot(in.v0, vs.c[16]),
        dot(in.v0, vs.c[17]),
        dot(in.v0, vs.c[18]),
        dot(in.v0, vs.c[19]),
    );
    // 25: mov oT0.xy, v7 ; passthrough texcoord 0 for bump map addressing
    oT0 = in.v7.xy;
    // 26: ; derive per vertex eye vector using camera position
    // 27: add r8, c28, -v0 ; view direction
    r8 = vs.c[28] - in.v0;
    // 28: m3x3 r9, r8, c20 ; transform view vector from object space to env space
    r9 = vec3f(dot(r8.xyz, vs.c[20].xyz), dot(r8.xyz, vs.c[21].xyz), dot(r8.xyz, vs.c[22].xyz));
    // 29: dp3 r11.x, r9, r9 ; magnitude^2
    r11.x = dot(r9, r9);
    // 30: rsq r11.y, r11.x ; 1/mag
    r11.y = rsq(r11.x);
    // 31: mul oT4.xyz, r9, r11.y ; normalize
    oT4 = r9 * r11.y;
    // 32: ; upper 3x3 of world matrix by upper tangent space transposed
    // 33: dp3 oT1.x, c20, v8
    oT1.x = dot(vs.c[20].xyz, in.v8.xyz);
    // 34: dp3 oT1.y, c20, v9
    oT1.y = dot(vs.c[20].xyz, in.v9.xyz);
    // 35: dp3 oT1.z, c20, v3
    oT1.z = dot(vs.c[20].xyz, in.v3.xyz);
    // 36: dp3 oT2.x, c21, v8
    oT2.x = dot(vs.c[21].xyz, in.v8.xyz);
    // 37: dp3 oT2.y, c21, v9
    oT2.y = dot(vs.c[21].xyz, in.v9.xyz);
    // 38: dp3 oT2.z, c21, v3
    oT2.z = dot(vs.c[21].xyz, in.v3.xyz);
    // 39: dp3 oT3.x, c22, v8
    oT3.x = dot(vs.c[22].xyz, in.v8.xyz);
    // 40: dp3 oT3.y, c22, v9
    oT3.y = dot(vs.c[22].xyz, in.v9.xyz);
    // 41: dp3 oT3.z, c22, v3
    oT3.z = dot(vs.c[22].xyz, in.v3.xyz);
    // 42: ; Calculate an adjustment amount to account for cube map center not
    // 43: ; being at this object's center.
    // 44: m3x3 r0, v0, c12 ; Object->World space position without translation.
    r0 = vec4f(
        dot(in.v0.xyz, vs.c[12].xyz),
        dot(in.v0.xyz, vs.c[13].xyz),
        dot(in.v0.xyz, vs.c[14].xyz),
        r0.w,
    );
    // 45: mul oT5, r0, c94.w ; Scale by 1/appoximate scene size
    oT5 = r0 * c94.w;

    var out: Varyings;
    // Direct3D 8 has pixel centres at whole coordinates: half a pixel to the right and down.
    let shift = vec2f(1.0, -1.0) / vs.viewport;
    out.position = vec4f(oPos.xy + shift * oPos.w, oPos.zw);
    out.t0 = oT0;
    out.t1 = oT1;
    out.t2 = oT2;
    out.t3 = oT3;
    out.t4 = oT4;
    out.t5 = oT5.xyz;
    return out;
}

@fragment
fn ps_main(in: Varyings) -> @location(0) vec4f {
    // 1: ps.1.4
    var r0: vec4f;
    var r1: vec3f;
    var r2: vec4f;
    var r3: vec4f;
    var r4: vec4f;
    var r5: vec4f;
    // 2: def c0, 0.9f, 0.0f, 0.0f, 0.0f
    const c0 = vec4f(0.9, 0.0, 0.0, 0.0);
    // 3: texld r0, t0 ; Look up normal map.
    r0 = textureSample(texture0, sampler0, in.t0);
    // 4: texcrd r1.rgb, t4 ; Eye vector
    r1 = in.t4;
    // 5: texcrd r4.rgb, t1 ; 1st row of environment matrix
    r4 = vec4f(in.t1, r4.a);
    // 6: texcrd r2.rgb, t2 ; 2nd row of environment matrix
    r2 = vec4f(in.t2, r2.a);
    // 7: texcrd r3.rgb, t3 ; 3rd row of environment matrix
    r3 = vec4f(in.t3, r3.a);
    // 8: texcrd r5.rgb, t5 ; Cube map position adjustment
    r5 = vec4f(in.t5, r5.a);
    // 9: dp3 r4.r, r4, r0_bx2 ; 1st row of matrix multiply
    r4.r = dot(r4.rgb, 2.0 * r0.rgb - 1.0);
    // 10: dp3 r4.g, r2, r0_bx2 ; 2nd row of matrix multiply
    r4.g = dot(r2.rgb, 2.0 * r0.rgb - 1.0);
    // 11: dp3 r4.b, r3, r0_bx2 ; 3rd row of matrix multiply
    r4.b = dot(r3.rgb, 2.0 * r0.rgb - 1.0);
    // 12: lrp r2.rgb, c0.r, -r1, -r4 ; Refract by c0 = index of refraction fudge factor
    r2 = vec4f(c0.r * -r1 - (1.0 - c0.r) * r4.rgb, r2.a);
    // 13: add r2.rgb, r5, r2 ; Adjust for cube map center
    r2 = vec4f(r5.rgb + r2.rgb, r2.a);
    // 14: phase
    // 15: texld r2, r2 ; Sample cubic reflection map
    r2 = sample_faces(texture2, sampler2, r2.xyz);
    // 16: texld r3, t0 ; Sample base map
    r3 = textureSample(texture3, sampler3, in.t0);
    // 17: texld r4, r4 ; Sample cubic diffuse map
    r4 = textureSample(texture4, sampler4, r4.xyz);
    // 18: texld r5, t0 ; Sample gloss map
    r5 = textureSample(texture5, sampler5, in.t0);
    // 19: mul r1.rgb, r5, r2 ; Specular = Gloss*Reflection
    r1 = r5.rgb * r2.rgb;
    // 20: mad r0.rgb, r3, r4_x2, r1 ; Base*Diffuse + Specular
    r0 = vec4f(r3.rgb * (2.0 * r4.rgb) + r1, r0.a);
    // 21: +mov r0.a, r3
    r0.a = r3.a;
    return r0;
}
