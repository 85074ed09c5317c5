// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// water.frag - the tank behind the fish: the backdrop, and light shafts from the moving surface.
//
// Inputs: common.frag; backdrop, drawn by wall, gravel, wood and stone; caustics, a tile by
// caustics.frag; time, seconds. Output: linear light, opaque.
uniform sampler2D backdrop;
uniform sampler2D caustics;
uniform float time;

float net_at(vec2 turns) {
  const float kSize = 128.0;
  return texture(caustics, (fract(turns) * (kSize - 1.0) + 0.5) / kSize).g;
}

void main() {
  vec2 p = tank_at(pixel);
  vec3 c = texture(backdrop, pixel / frame_size).rgb;
  // Shafts fan out from a lamp above the surface, left of the middle.
  vec2 ray = p - vec2(470.0, -520.0);
  float a = ray.x / ray.y;
  float shaft = net_at(vec2(a * 0.42 + 0.013 * time, 0.021 * time)) *
                net_at(vec2(a * 0.97 - 0.017 * time, 0.4 + 0.013 * time));
  float fade = exp(-max(p.y, 0.0) / 360.0) * smoothstep(1.2, 0.2, abs(a));
  color = vec4(c + vec3(0.22, 0.44, 0.42) * shaft * fade * 0.55, 1.0);
}
