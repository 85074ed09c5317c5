// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// common.frag - stands before every effect of the tank: the view, noise, and the water in between.
//
// Inputs: view = (offset x, offset y, scale): frame pixel = tank pixel * scale + offset. Tank
// pixels: 1280 x 720, y down, surface at 0. All colours linear.
uniform vec3 view;

vec2 tank_at(vec2 frame_pixel) { return (frame_pixel - view.xy) / view.z; }

float hash(vec2 p) {
  p = fract(p * vec2(123.34, 456.21));
  p += dot(p, p + 45.32);
  return fract(p.x * p.y);
}
vec2 hash2(vec2 p) { return vec2(hash(p), hash(p + 17.7)); }

float noise(vec2 p) {
  vec2 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x),
             mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
}
float fbm(vec2 p) {
  float sum = 0.0, weight = 0.5;
  for (int k = 0; k < 4; ++k) {
    sum += weight * noise(p);
    p = mat2(1.6, 1.2, -1.2, 1.6) * p;
    weight *= 0.5;
  }
  return sum;
}

// Towards the lamp above the surface, left of the middle, in front of the stones.
const vec3 kLight = vec3(-0.36, 0.86, 0.36);

// The colour of open water, by height.
vec3 water_at(vec2 p) {
  float h = clamp(p.y / 720.0, -0.3, 1.3);
  vec3 c = mix(vec3(0.085, 0.43, 0.50), vec3(0.012, 0.160, 0.260), smoothstep(-0.1, 0.45, h));
  c = mix(c, vec3(0.004, 0.052, 0.092), smoothstep(0.35, 1.0, h));
  float middle = (p.x - 540.0) / 700.0;
  return c * (0.42 + 0.70 * exp(-middle * middle));
}

// What is left of a colour behind `depth` of water: red is lost first.
vec3 through_water(vec3 c, float depth, vec2 p) {
  vec3 clear = exp(-depth * vec3(2.6, 1.15, 1.0));
  return c * clear + water_at(p) * (1.0 - clear);
}
