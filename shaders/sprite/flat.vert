// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Triangles. place: xy frame pixels     tint: linear light, straight alpha
layout(location = 0) in vec4 place;
layout(location = 1) in vec4 tint;
uniform vec2 frame_size;
out vec4 flat_tint;

void main() {
  gl_Position = vec4(2.0 * place.xy / frame_size - 1.0, 0.0, 1.0);
  flat_tint = vec4(tint.rgb * tint.a, tint.a);
}
