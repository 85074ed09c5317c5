// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// wall.frag - the far end of the tank: open water, then ridges and weeds, soft as far things are.
// Drawn once for every size of the window.
//
// Inputs: common.frag. Output: rgb linear; alpha 0: the light net does not reach it.

void main() {
  vec2 p = tank_at(pixel);
  vec3 c = water_at(p);
  for (int k = 0; k < 3; ++k) {
    float depth = 1.25 - 0.30 * float(k);
    float seed = float(k) * 31.7;
    float x = p.x / (250.0 - 40.0 * float(k)) + seed;
    float side = abs(p.x - 660.0) / 640.0;
    float ridge = 588.0 - (100.0 - 16.0 * float(k)) * fbm(vec2(x, seed)) -
                  120.0 * side * side * fbm(vec2(x * 1.7, seed + 4.0));
    float blade = noise(vec2(p.x / 7.0 + seed + 5.0 * sin(p.y / 60.0 + seed), seed));
    float patches = smoothstep(0.42, 0.75, noise(vec2(p.x / 130.0 + seed, 2.0 + seed)));
    float weed = (blade - 0.25) * 230.0 * patches;
    float soft = 16.0 - 4.0 * float(k);
    float rock = smoothstep(ridge - soft, ridge + soft, p.y);
    float plant = smoothstep(-soft, soft, p.y - ridge + weed) * (1.0 - rock);
    c = mix(c, through_water(vec3(0.020, 0.075, 0.016), depth * 0.75, p), plant * 0.75);
    vec3 face = vec3(0.075, 0.07, 0.06) * (0.75 + 0.5 * fbm(p / 60.0 + seed));
    c = mix(c, through_water(face, depth, p), rock);
  }
  color = vec4(c, 0.0);
}
