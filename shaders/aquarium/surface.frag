// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// surface.frag - the underside of the water's surface: a mirror that ripples, brighter towards the
// lamp.
//
// Inputs: common.frag; caustics, a tile by caustics.frag; time, seconds. Output: linear,
// premultiplied: light with little cover.
uniform sampler2D caustics;
uniform float time;

float net_at(vec2 turns) {
  const float kSize = 128.0;
  return texture(caustics, (fract(turns) * (kSize - 1.0) + 0.5) / kSize).g;
}

void main() {
  vec2 p = tank_at(pixel);
  float u = 30.0 / max(84.0 - p.y, 6.0);  // distance to the place seen, over its height
  vec2 s = vec2((p.x - 560.0) * u / 260.0, u * 3.2);
  float ripple = net_at(s * vec2(1.0, 0.8) + vec2(0.02, 0.05) * time) *
                 net_at(s * vec2(0.61, 1.1) - vec2(0.03, -0.04) * time + 0.5);
  float near = smoothstep(80.0, 8.0, p.y);
  float lamp = exp(-pow((p.x - 500.0) / 480.0, 2.0));
  float veil = 0.30 * near * near * (0.3 + 0.7 * lamp);
  vec3 light = vec3(0.36, 0.66, 0.64) * ripple * near * (0.18 + 0.82 * lamp);
  color = vec4(light + veil * vec3(0.24, 0.55, 0.57), veil);
}
