// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Bilinear between texels that are linear premultiplied light; a shrunk picture is averaged over the
// pixel's footprint by TAPS x TAPS such samples (constants: a loop of unknown length costs software
// drivers more than the samples). With FADE two pictures are mixed before they are drawn, so that
// what is opaque in both stays opaque. With WRAP light of the backdrop reaches over the edge. Out: linear, premultiplied.
in vec2 texel;
flat in vec4 own;
flat in vec4 veil;
uniform sampler2D page;
#if TAPS > 1 || defined(FADE) || defined(WRAP)
flat in vec4 picture;
flat in vec4 fade;
uniform vec2 page_size;
#endif
#ifdef FADE
flat in vec4 old;
uniform sampler2D old_page;
uniform vec2 old_page_size;
#endif
#ifdef WRAP
flat in vec2 wrap;
uniform sampler2D backdrop;
uniform vec2 frame_size;
#endif
out vec4 color;

#if TAPS > 1 || defined(FADE) || defined(WRAP)
// Beyond half a texel lies the border of zeros: staying on it keeps neighbours out.
vec4 light_at(sampler2D from, vec2 from_size, vec4 rect, vec2 at) {
  return textureLod(from, (rect.xy + clamp(at, vec2(-0.5), rect.zw + 0.5)) / from_size, 0.0);
}
vec4 light_over(sampler2D from, vec2 from_size, vec4 rect, vec2 at, vec2 across, vec2 down) {
#if TAPS > 1
  vec4 sum = vec4(0.0);
  for (int j = 0; j < TAPS; ++j) {
    for (int i = 0; i < TAPS; ++i) {
      vec2 f = (vec2(i, j) + 0.5) / float(TAPS) - 0.5;
      sum += light_at(from, from_size, rect, at + f.x * across + f.y * down);
    }
  }
  return sum / float(TAPS * TAPS);
#else
  return light_at(from, from_size, rect, at);
#endif
}
#endif

void main() {
#if TAPS > 1 || defined(FADE) || defined(WRAP)
  vec2 across = dFdx(texel) * fade.z;
  vec2 down = dFdy(texel) * fade.z;
  vec4 light = light_over(page, page_size, picture, texel, across, down);
#ifdef FADE
  vec4 before = light_over(old_page, old_page_size, old, texel - fade.xy, across, down);
  light = mix(light, before, fade.w);
#endif
#else
  vec4 light = textureLod(page, texel, 0.0);
#endif
  color = light * own + light.a * veil;
#ifdef WRAP
  float cover = 0.0;
  for (int k = 0; k < 8; ++k) {
    float turn = 0.7853982 * float(k);
    vec2 away = vec2(cos(turn), sin(turn)) * wrap.y * (k % 2 == 0 ? 1.0 : 0.5);
    cover += light_at(page, page_size, picture, texel + away).a;
  }
  float edge = color.a * (1.0 - cover / 8.0);
  color.rgb += wrap.x * edge * textureLod(backdrop, gl_FragCoord.xy / frame_size, 0.0).rgb;
#endif
}
