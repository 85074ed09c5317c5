// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One sprite per instance: a box without its clear corners, eight vertices of a strip.
// place: xy frame pixels of the picture's top left corner, z width of the footprint in pixels, w share
// of the other picture     axes: frame pixels per texel, along x and y     rect, other: x, y, width,
// height in the page, texels     box: what is covered (or, by the sign of order.z, hidden), texels of
// the picture     cuts: off its corners, clockwise from the top left     shift: xy of the other
// picture's corner, texels, z share of the backdrop's light, w its reach, texels     tint, fog: linear
layout(location = 0) in vec4 place;
layout(location = 1) in vec4 axes;
layout(location = 2) in vec4 rect;
layout(location = 3) in vec4 tint;
layout(location = 4) in vec4 fog;
layout(location = 5) in vec4 box;
layout(location = 6) in vec4 cuts;
layout(location = 7) in vec4 other;
layout(location = 8) in vec4 shift;
uniform vec2 frame_size;
uniform vec2 page_size;
// Depth of the first instance, from one to the next; 1, or -1: a box that is all opaque.
uniform vec3 order;
out vec2 texel;  // within the picture; where one sample is taken, of the page, 0..1
#if TAPS > 1 || defined(FADE) || defined(WRAP)
flat out vec4 picture;
#endif
flat out vec4 own;    // color = light own + light.a veil
flat out vec4 veil;
#if TAPS > 1 || defined(FADE) || defined(WRAP)
flat out vec4 fade;  // shift, footprint, share
#endif
#ifdef FADE
flat out vec4 old;
#endif
#ifdef WRAP
flat out vec2 wrap;  // share, reach
#endif

void main() {
  // A pixel's footprint reaches half a texel, or half a pixel where the picture is shrunk, past the edge.
  vec2 size = vec2(length(axes.xy), length(axes.zw));
  vec2 pad = vec2(0.5);
#if TAPS > 1
  pad += 0.75 * place.z / max(min(size, vec2(1.0)), vec2(0.01));
#endif
  pad *= order.z;
  vec2 low = box.xy - pad, high = box.zw + pad;
  // In pairs from the top down, as a strip goes.
  int k = gl_VertexID;
  vec2 at = low;
  if (k == 0) at = vec2(low.x + cuts.x, low.y);
  else if (k == 1) at = vec2(high.x - cuts.y, low.y);
  else if (k == 2) at = vec2(low.x, low.y + cuts.x);
  else if (k == 3) at = vec2(high.x, low.y + cuts.y);
  else if (k == 4) at = vec2(low.x, high.y - cuts.w);
  else if (k == 5) at = vec2(high.x, high.y - cuts.z);
  else if (k == 6) at = vec2(low.x + cuts.w, high.y);
  else at = vec2(high.x - cuts.z, high.y);
  vec2 point = place.xy + axes.xy * at.x + axes.zw * at.y;
  gl_Position = vec4(2.0 * point / frame_size - 1.0, order.x + order.y * float(gl_InstanceID), 1.0);
  own = vec4(tint.rgb * (1.0 - fog.a), 1.0) * tint.a;
  veil = vec4(fog.rgb * fog.a * tint.a, 0.0);
#ifdef FADE
  old = other;
#endif
#ifdef WRAP
  wrap = shift.zw;
#endif
#if TAPS > 1 || defined(FADE) || defined(WRAP)
  picture = rect;
  fade = vec4(shift.xy, place.zw);
  texel = at;
#else
  texel = (rect.xy + at) / page_size;
#endif
}
