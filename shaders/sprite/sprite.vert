// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One sprite per instance, four corners of a strip.
// place: xy frame pixels of the picture's top left corner     axes: frame pixels per texel, along x and y
// rect: x, y, width, height of the picture in the page, texels     tint, fog: linear light
layout(location = 0) in vec4 place;
layout(location = 1) in vec4 axes;
layout(location = 2) in vec4 rect;
layout(location = 3) in vec4 tint;
layout(location = 4) in vec4 fog;
uniform vec2 frame_size;
out vec2 texel;  // within the picture
flat out vec4 picture;
flat out vec4 picture_tint;
flat out vec4 picture_fog;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  // A pixel's footprint reaches half a texel, or half a pixel where the picture is shrunk, past the edge.
  vec2 size = vec2(length(axes.xy), length(axes.zw));
  vec2 pad = vec2(0.5) + 0.75 / max(min(size, vec2(1.0)), vec2(0.01));
  texel = mix(-pad, rect.zw + pad, corner);
  vec2 at = place.xy + axes.xy * texel.x + axes.zw * texel.y;
  gl_Position = vec4(2.0 * at / frame_size - 1.0, 0.0, 1.0);
  picture = rect;
  picture_tint = tint;
  picture_fog = fog;
}
