// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// gravel.frag - the bed of the tank in perspective: fine gravel with river pebbles strewn on it.
// Drawn once for every size of the window, over wall.frag.
//
// Inputs: common.frag; scene; stones[6] = (centre x, centre y, half width, half height), tank
// pixels: what throws a shade. Output: rgb linear; alpha = how much of the light net falls on it.
uniform vec4 stones[6];

const float kHorizon = 500.0;  // where the bed would meet infinity
const float kBack = 566.0;     // where it meets the back wall

vec3 stone_colour(float r) {
  vec3 c = mix(vec3(0.21, 0.145, 0.09), vec3(0.34, 0.27, 0.20), fract(r * 7.0));
  c = mix(c, vec3(0.115, 0.11, 0.11), step(0.62, r));
  c = mix(c, vec3(0.27, 0.125, 0.065), step(0.80, r));
  c = mix(c, vec3(0.56, 0.52, 0.45), step(0.92, r));
  return c;
}

// Round pebbles seen from above, one a cell: colour, and coverage in alpha. `share` of the cells
// hold one, `fill` is its size.
vec4 pebbles(vec2 p, float share, float fill, float sharp) {
  vec2 cell = floor(p), f = fract(p);
  float best = 9.0;
  vec2 nearest = vec2(0), id = vec2(0);
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) {
      vec2 at = vec2(x, y), h = hash2(cell + at);
      vec2 d = at + 0.5 + 0.6 * (h - 0.5) - f;
      float turn = 6.28 * h.y;
      d = mat2(cos(turn), sin(turn), -sin(turn), cos(turn)) * d * vec2(0.86, 1.22);
      float r = dot(d, d) * (0.8 + 0.5 * h.x) + 9.0 * step(share, hash(cell + at + 5.3));
      if (r < best) { best = r; nearest = at + 0.5 + 0.6 * (h - 0.5) - f; id = cell + at; }
    }
  float s = sqrt(best) / fill;
  vec3 n = normalize(vec3(-nearest.x * 2.2, 1.15 - 0.8 * s * s, nearest.y * 2.2));
  vec3 c = stone_colour(hash(id + 3.1)) * (0.78 + 0.44 * noise(p * 6.0 + id));
  float lit = 0.22 + 1.05 * max(dot(n, kLight), 0.0);
  float shine = pow(max(dot(n, vec3(-0.2, 0.93, 0.3)), 0.0), 18.0) * 0.10 * sharp;
  float rim = smoothstep(1.0, 0.70, s);
  return vec4((c * lit + shine) * (0.25 + 0.75 * rim), smoothstep(1.03, 0.93, s));
}

vec3 bed(vec2 p) {
  float w = 110.0 / max(p.y - kHorizon, 60.0);
  vec2 g = vec2((p.x - 640.0) * w, 900.0 * w);
  g.y += 18.0 * sin(g.x * 0.006 + 0.8) + 10.0 * sin(g.x * 0.017);
  float sharp = smoothstep(560.0, 700.0, p.y);
  vec4 under = pebbles(g / 11.0 + 3.7, 1.0, 0.72, sharp);
  vec4 fine = pebbles(g / 13.0, 1.0, 0.56, sharp);
  float share = 0.20 + 0.45 * smoothstep(0.4, 0.7, noise(g / 240.0));
  vec4 large = pebbles(g / 40.0 + 7.3, share, 0.45, sharp);
  vec3 c = under.rgb * 0.30;
  c = mix(c, fine.rgb, fine.a);
  vec4 shadow = pebbles(g / 40.0 + 7.3 + vec2(-0.10, 0.10), share, 0.50, sharp);
  c *= 1.0 - 0.55 * shadow.a;
  c = mix(c, large.rgb, large.a);
  return c * (0.55 + 0.85 * fbm(g / 170.0));
}

void main() {
  vec2 p = tank_at(pixel);
  vec4 behind = scene_at(pixel);
  float edge = kBack + 5.0 * sin(p.x / 97.0) + 4.0 * sin(p.x / 41.0);
  float cover = smoothstep(edge - 7.0, edge + 10.0, p.y);
  float shade = 1.0;
  for (int k = 0; k < 6; ++k) {
    vec2 foot = stones[k].xy + vec2(0.20, 0.62) * stones[k].zw;
    vec2 d = (p - foot) / (stones[k].zw * vec2(1.25, 0.42));
    shade *= 1.0 - 0.78 * exp(-1.5 * dot(d, d));
  }
  float s = 0.30 / view.z;  // two samples a pixel: pebbles are small
  vec3 c = 0.5 * (bed(p + vec2(s, s)) + bed(p - vec2(s, s))) * shade * vec3(1.0, 0.90, 0.74) * 1.05;
  float far = clamp((706.0 - p.y) / (706.0 - kBack), 0.0, 1.0);
  float depth = 0.05 + 0.95 * far * far;
  color = vec4(mix(behind.rgb, through_water(c, depth, p), cover),
               cover * exp(-2.4 * depth) * (0.25 + 0.75 * shade));
}
