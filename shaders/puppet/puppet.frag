// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Backward mapping: the pixel's weights in its face (affine, or the inverse of the bilinear map), from
// those its place in every view, from the views' shares its light: linear, premultiplied.
// shares: of the views, texels of each puppet     page: the views     places: for each view its control points, texels of the page, then its rectangle
flat in vec4 places_ab, places_cd;
flat in vec4 points;
flat in vec4 kind;
flat in vec4 depths;
in vec4 nearby;
uniform sampler2D page, places, shares;
uniform vec2 page_size;
uniform float view_count, point_count;
out vec4 color;

vec2 a, b, c, d;

float cross2(vec2 p, vec2 q) { return p.x * q.y - p.y * q.x; }

vec4 texel_of(sampler2D words, float index) {
  int k = int(index + 0.5);
  return texelFetch(words, ivec2(k & 1023, k >> 10), 0);
}

vec4 affine(vec2 p) {
  vec2 u = b - a, v = c - a, h = p - a;
  float area = cross2(u, v);
  float wb = cross2(h, v) / area, wc = cross2(u, h) / area;
  return vec4(1.0 - wb - wc, wb, wc, 0.0);
}

// p = (1-s)(1-t) a + s (1-t) b + s t c + (1-s) t d.
bool try_t(float t, vec2 e, vec2 f, vec2 g, vec2 h, inout vec4 w) {
  vec2 along = e + g * t;
  float s = abs(along.x) > abs(along.y) ? (h.x - f.x * t) / along.x : (h.y - f.y * t) / along.y;
  const float slack = 1e-3;
  if (!(t >= -slack && t <= 1.0 + slack && s >= -slack && s <= 1.0 + slack)) return false;
  w = vec4((1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t);
  return true;
}

void bilinear(vec2 p, inout vec4 w) {
  vec2 e = b - a, f = d - a, g = a - b + c - d, h = p - a;
  float k2 = cross2(g, f), k1 = cross2(e, f) + cross2(h, g), k0 = cross2(h, e);
  if (abs(k2) < 1e-6 * abs(k1)) {
    try_t(-k0 / k1, e, f, g, h, w);
    return;
  }
  float square = k1 * k1 - 4.0 * k0 * k2;
  if (square < 0.0) return;
  float r = -0.5 * (k1 + (k1 < 0.0 ? -sqrt(square) : sqrt(square)));  // the stable pair of roots
  if (r != 0.0 && try_t(k0 / r, e, f, g, h, w)) return;
  try_t(r / k2, e, f, g, h, w);
}

void main() {
  a = places_ab.xy, b = places_ab.zw, c = places_cd.xy, d = places_cd.zw;
  vec2 pixel = gl_FragCoord.xy;
  vec4 w = nearby;
  if (kind.y < 0.5) w = affine(pixel);
  else if (kind.z > 0.5) bilinear(pixel, w);

  vec4 light = vec4(0.0);
  for (float v = 0.0; v < view_count; v += 1.0) {
    float share = view_count < 1.5 ? 1.0 : texel_of(shares, kind.x + v).x;
    if (share <= 0.0) continue;
    float row = v * (point_count + 1.0);
    vec2 at = w.x * texel_of(places, row + points.x).xy + w.y * texel_of(places, row + points.y).xy +
              w.z * texel_of(places, row + points.z).xy;
    if (kind.y > 0.5) at += w.w * texel_of(places, row + points.w).xy;
    // A border of nothing lies round each view.
    vec4 rect = texel_of(places, row + point_count);
    light += share * textureLod(page, clamp(at, rect.xy - 0.5, rect.zw + 0.5) / page_size, 0.0);
  }
  if (light.a <= 0.0) discard;
  color = light;
  gl_FragDepth = 1.0 - (kind.w + floor(dot(w, depths) + 0.5)) * exp2(-23.0);
}
