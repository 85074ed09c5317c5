// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One face of a puppet per instance, a strip of four vertices.
// corners: control points; a triangle's fourth is -1     face: x first texel of the pose, y 0 triangle,
// 1 quad cut along its corners 0 and 2, 2 along 1 and 3, z 1: turned the same way at every corner,
// w depth of the puppet's slice
// pose: for every control point x, y frame pixels, z depth in steps of the slice; then the views' shares
layout(location = 0) in vec4 corners;
layout(location = 1) in vec4 face;
uniform vec2 frame_size;
uniform sampler2D pose;
flat out vec4 points;
flat out vec4 kind;
flat out vec2 a, b, c, d;
flat out vec4 depths;
out vec4 nearby;  // affine weights within the triangle at hand

vec4 pose_at(float point) {
  int k = int(face.x + point + 0.5);
  return texelFetch(pose, ivec2(k & 1023, k >> 10), 0);
}

void main() {
  points = vec4(corners.xyz, max(corners.w, 0.0));
  kind = face;
  vec4 p0 = pose_at(points.x), p1 = pose_at(points.y), p2 = pose_at(points.z);
  vec4 p3 = face.y > 0.5 ? pose_at(points.w) : p2;
  a = p0.xy, b = p1.xy, c = p2.xy, d = p3.xy;
  depths = vec4(p0.z, p1.z, p2.z, face.y > 0.5 ? p3.z : 0.0);
  int corner = gl_VertexID;
  if (face.y > 1.5) corner = corner == 2 ? 3 : corner == 3 ? 2 : corner;       // 0 1 3 2
  else if (face.y > 0.5) corner = corner == 0 ? 1 : corner == 1 ? 0 : corner;  // 1 0 2 3
  vec2 at = corner == 0 ? a : corner == 1 ? b : corner == 2 ? c : d;
  nearby = vec4(corner == 0, corner == 1, corner == 2, corner == 3);
  gl_Position = vec4(2.0 * at / frame_size - 1.0, 0.0, 1.0);
}
