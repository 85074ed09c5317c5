// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// wood.frag - a root of driftwood: bowed, tapering limbs with bark. Drawn once for every size of
// the window.
//
// Inputs: common.frag; scene. Output: rgb linear; alpha = how much of the light net falls on it.

struct Limb {
  float reach;   // distance from the middle line / radius
  float along;   // tank pixels
  float side;    // -1..1 across
  float up;      // how far this side looks up
  float radius;  // tank pixels
};

void grow(inout Limb best, vec2 p, vec2 a, vec2 b, float ra, float rb, float bow) {
  vec2 ab = b - a;
  float t = clamp(dot(p - a, ab) / dot(ab, ab), 0.0, 1.0);
  vec2 n = normalize(vec2(-ab.y, ab.x));
  vec2 c = p - a - ab * t - n * bow * 4.0 * t * (1.0 - t);
  float r = mix(ra, rb, pow(t, 0.8));
  float reach = length(c) / r;
  if (reach < best.reach) best = Limb(reach, t * length(ab), dot(c, n) / r, -c.y / r, r);
}

void main() {
  vec2 p = tank_at(pixel);
  vec4 behind = scene_at(pixel);
  vec2 q = p + 15.0 * (vec2(noise(p / 47.0), noise(p / 43.0 + 8.0)) - 0.5) +
           6.0 * (vec2(noise(p / 15.0), noise(p / 14.0 + 3.0)) - 0.5);
  Limb best = Limb(9.0, 0.0, 0.0, 0.0, 20.0);
  grow(best, q, vec2(70, 630), vec2(292, 486), 40.0, 23.0, -26.0);
  grow(best, q, vec2(276, 500), vec2(440, 340), 25.0, 5.0, 24.0);
  grow(best, q, vec2(214, 530), vec2(232, 352), 22.0, 4.5, -18.0);
  grow(best, q, vec2(296, 486), vec2(482, 470), 17.0, 3.0, -22.0);
  grow(best, q, vec2(212, 446), vec2(150, 334), 9.0, 2.0, 12.0);
  grow(best, q, vec2(372, 440), vec2(366, 322), 9.0, 2.0, -10.0);
  grow(best, q, vec2(396, 470), vec2(462, 412), 7.0, 1.8, 9.0);
  grow(best, q, vec2(150, 590), vec2(16, 520), 22.0, 7.0, 16.0);
  grow(best, q, vec2(250, 520), vec2(316, 600), 24.0, 13.0, 10.0);
  float cover = smoothstep(1.0, 1.0 - 1.6 / best.radius, best.reach);
  float grain = fbm(vec2(best.along / 38.0, best.side * 3.2 + best.along / 190.0));
  float fine = noise(vec2(best.along / 10.0, best.side * 17.0));
  float groove = smoothstep(0.30, 0.48, grain);
  float lit = 0.10 + 0.90 * smoothstep(-0.75, 0.95, best.up + 0.9 * (grain - 0.5));
  vec3 c = mix(vec3(0.034, 0.016, 0.008), vec3(0.190, 0.098, 0.042), grain * 0.6 + fine * 0.4);
  c *= 0.35 + 0.65 * groove;
  float moss = smoothstep(0.30, 0.85, best.up) * smoothstep(0.42, 0.60, noise(p / 31.0));
  c = mix(c, vec3(0.040, 0.110, 0.018) * (0.5 + fine), 0.75 * moss);
  float rim = smoothstep(1.02, 0.6, best.reach);
  c *= lit * (0.35 + 0.65 * rim) * smoothstep(690.0, 520.0, p.y) * 1.5;
  color = vec4(mix(behind.rgb, through_water(c, 0.09, p), cover),
               mix(behind.a, 0.5 * max(best.up, 0.0), cover));
}
