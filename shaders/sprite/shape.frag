// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Coverage of a rounded box from its signed distance, lengths in frame pixels. Out: linear, premultiplied.
in vec2 local;
flat in vec2 half_size;
flat in vec3 shape;
flat in vec4 shape_tint;
out vec4 color;

void main() {
  vec2 q = abs(local) - half_size + shape.x;
  float d = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - shape.x;
  if (shape.y > 0.0) d = abs(d + 0.5 * shape.y) - 0.5 * shape.y;
  float coverage = clamp(0.5 - d / (1.0 + shape.z), 0.0, 1.0);
  float a = shape_tint.a * coverage;
  color = vec4(shape_tint.rgb * a, a);
}
