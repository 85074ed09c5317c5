// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The whole viewport. flip: 1 where the target's first row is the bottom one (windows), else 0.
uniform float flip;
out vec2 place;  // 0..1 of the frame, y down

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  place = vec2(corner.x, mix(corner.y, 1.0 - corner.y, flip));
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
