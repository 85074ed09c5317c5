// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// stone.frag - one broken boulder, sunk a little into the gravel. Drawn once for every size of the
// window, from back to front.
//
// Inputs: common.frag; scene; place = (centre x, centre y, half width, half height), tank pixels;
// look = (seed, moss 0..1, water in between, brightness). Output: rgb linear; alpha = how much of
// the light net falls on it.
uniform vec4 place;
uniform vec4 look;

// Height of the stone's face above its outline, in units of its half height; below 0: outside.
float face(vec2 d) {
  vec2 e = vec2(d.x, d.y > 0.0 ? d.y * 1.7 : d.y);
  float slab = max(abs(e.x) * 0.92 + e.y * 0.18, abs(e.y) * 0.96 - e.x * 0.12);
  float r = mix(length(e), slab, 0.45);
  r += 0.34 * (noise(d * 1.9 + look.x) - 0.5) + 0.15 * (noise(d * 4.7 + look.x * 1.7) - 0.5);
  return 1.0 - r;
}
float relief(vec2 d) {
  vec2 q = d * 2.3 + look.x * 3.1;
  float ridges = 1.0 - abs(2.0 * fbm(q) - 1.0);
  return sqrt(max(face(d), 0.0)) + 0.30 * ridges * ridges + 0.10 * fbm(q * 4.0);
}

void main() {
  vec2 p = tank_at(pixel);
  vec4 behind = scene_at(pixel);
  vec2 d = (p - place.xy) / place.zw;
  float f = face(d);
  float cover = smoothstep(0.0, 2.0 / place.w, f);
  float e = 0.03;
  float h = relief(d);
  vec2 slope = vec2(relief(d + vec2(e, 0.0)) - h, relief(d + vec2(0.0, e)) - h) / e;
  vec3 n = normalize(vec3(-slope.x, slope.y, 0.85));
  float sky = 0.5 + 0.5 * n.y;
  float lit = 0.06 + 0.16 * sky + 0.95 * max(dot(n, kLight), 0.0);
  vec2 q = d * place.zw / 40.0 + look.x * 9.0;
  vec3 c = mix(vec3(0.050, 0.044, 0.038), vec3(0.190, 0.158, 0.120), fbm(q));
  c = mix(c, vec3(0.24, 0.17, 0.105), 0.5 * smoothstep(0.5, 0.7, fbm(q * 0.6 + 9.0)));
  float vein = smoothstep(0.0, 0.035, abs(fbm(q * 0.55 + 4.0) - 0.48));
  c *= 0.45 + 0.55 * vein;
  float green = look.y * smoothstep(0.30, 0.72, n.y + 0.7 * (fbm(q * 1.4 + 2.0) - 0.5));
  c = mix(c, vec3(0.026, 0.066, 0.010) * (0.5 + 1.2 * noise(q * 8.0)), green);
  float foot = 0.18 + 0.82 * smoothstep(0.62, -0.25, d.y);
  c *= lit * foot * look.w;
  color = vec4(mix(behind.rgb, through_water(c, look.z, p), cover),
               mix(behind.a, 0.30 * max(n.y + 0.25, 0.0) * foot, cover));
}
