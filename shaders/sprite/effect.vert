// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// A rectangle: area is x, y, width, height in frame pixels.
uniform vec4 area;
uniform vec2 frame_size;
out vec2 pixel;  // frame pixels, y down

void main() {
  pixel = area.xy + area.zw * vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * pixel / frame_size - 1.0, 0.0, 1.0);
}
