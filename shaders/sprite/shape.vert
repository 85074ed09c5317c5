// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One rounded box per instance.
// place: centre, half size     form: cos and sin of the angle, corner radius, outline width
// edge: x feather beyond one pixel     tint: linear light, straight alpha     all lengths frame pixels
layout(location = 0) in vec4 place;
layout(location = 1) in vec4 form;
layout(location = 2) in vec4 edge;
layout(location = 3) in vec4 tint;
uniform vec2 frame_size;
out vec2 local;
flat out vec2 half_size;
flat out vec3 shape;  // radius, outline, feather
flat out vec4 shape_tint;

void main() {
  vec2 corner = 2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0;
  local = corner * (place.zw + edge.x + 1.0);
  vec2 at = place.xy + vec2(form.x * local.x - form.y * local.y, form.y * local.x + form.x * local.y);
  gl_Position = vec4(2.0 * at / frame_size - 1.0, 0.0, 1.0);
  half_size = place.zw;
  shape = vec3(form.zw, edge.x);
  shape_tint = tint;
}
