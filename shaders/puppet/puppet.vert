// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One face of a puppet per instance, a strip of four vertices.
// ab, cd: where its corners lie, frame pixels (of a triangle d is c)     depth: of each, in steps of the
// puppet's slice     corners: control points     face: x first texel of the puppet's shares, y 0
// triangle, 1 quad cut along its corners 0 and 2, 2 along 1 and 3, z 1: turned the same way at every
// corner, w depth of the slice
layout(location = 0) in vec4 ab;
layout(location = 1) in vec4 cd;
layout(location = 2) in vec4 depth;
layout(location = 3) in vec4 corners;
layout(location = 4) in vec4 face;
uniform vec2 frame_size;
flat out vec4 places_ab, places_cd;
flat out vec4 points;
flat out vec4 kind;
flat out vec4 depths;
out vec4 nearby;  // affine weights within the triangle at hand

void main() {
  places_ab = ab, places_cd = cd, points = corners, kind = face, depths = depth;
  int corner = gl_VertexID;
  if (face.y > 1.5) corner = corner == 2 ? 3 : corner == 3 ? 2 : corner;       // 0 1 3 2
  else if (face.y > 0.5) corner = corner == 0 ? 1 : corner == 1 ? 0 : corner;  // 1 0 2 3
  vec2 at = corner == 0 ? ab.xy : corner == 1 ? ab.zw : corner == 2 ? cd.xy : cd.zw;
  nearby = vec4(corner == 0, corner == 1, corner == 2, corner == 3);
  gl_Position = vec4(2.0 * at / frame_size - 1.0, 0.0, 1.0);
}
