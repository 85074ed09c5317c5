// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// net.frag - the net of light on gravel, stones and wood; multiplied into the tank behind the fish.
//
// Inputs: common.frag; backdrop, whose alpha says how much of the net falls where; caustics, a tile
// by caustics.frag; time, seconds. Output: a factor, about 0.6..4, linear.
uniform sampler2D backdrop;
uniform sampler2D caustics;
uniform float time;

float net_at(vec2 turns) {
  const float kSize = 128.0;
  return texture(caustics, (fract(turns) * (kSize - 1.0) + 0.5) / kSize).r;
}

void main() {
  vec2 p = tank_at(pixel);
  float share = texture(backdrop, pixel / frame_size).a;
  // On the gravel the net lies in perspective, on what stands up from it, upright.
  float w = 110.0 / max(p.y - 500.0, 56.0);
  vec2 g = vec2((p.x - 640.0) * w, 900.0 * w) / 290.0;
  g.y += max(556.0 - p.y, 0.0) * 0.011;
  // Two sheets of waves; where both focus there is light.
  float net = min(net_at(g + vec2(0.011, 0.017) * time),
                  net_at(g * 0.83 + vec2(-0.019, 0.008) * time + 0.37));
  color = vec4(vec3(1.0 + share * (3.0 * net - 0.40)), 1.0);
}
