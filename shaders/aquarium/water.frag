// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// water.frag - the tank behind the fish: backdrop, light net on the gravel, surface, light shafts.
//
// Inputs: common.frag; backdrop, drawn by wall, gravel, wood and stone; caustics, a tile by
// caustics.frag; time, seconds. Output: linear light, opaque.
uniform sampler2D backdrop;
uniform sampler2D caustics;
uniform float time;

vec2 net_at(vec2 turns) {
  vec2 size = vec2(textureSize(caustics, 0));
  return texture(caustics, (fract(turns) * (size - 1.0) + 0.5) / size).rg;
}

void main() {
  vec2 p = tank_at(pixel);
  vec4 base = texture(backdrop, pixel / frame_size);
  vec3 c = base.rgb;

  // The net on gravel and stones: two sheets of waves, the darker one counts.
  float w = 110.0 / max(p.y - 500.0, 56.0);
  vec2 g = vec2((p.x - 640.0) * w, 900.0 * w) / 290.0;
  g.y += p.y < 556.0 ? (556.0 - p.y) * 0.011 : 0.0;
  float net = min(net_at(g + vec2(0.011, 0.017) * time).r,
                  net_at(g * 0.83 + vec2(-0.019, 0.008) * time + 0.37).r);
  c *= 1.0 + base.a * (4.2 * net - 0.40);

  // Shafts fan out from a lamp above the surface, left of the middle.
  vec2 ray = p - vec2(470.0, -520.0);
  float a = ray.x / ray.y;
  float shaft = net_at(vec2(a * 0.42 + 0.013 * time, 0.021 * time)).g *
                net_at(vec2(a * 0.97 - 0.017 * time, 0.4 + 0.013 * time)).g;
  float fade = exp(-max(p.y, 0.0) / 360.0) * smoothstep(1.2, 0.2, abs(a));
  c += vec3(0.22, 0.44, 0.42) * shaft * fade * 0.55;

  // The underside of the surface: a mirror that ripples, brighter towards the lamp.
  float u = 30.0 / max(84.0 - p.y, 6.0);
  vec2 s = vec2((p.x - 560.0) * u / 260.0, u * 3.2);
  float ripple = net_at(s * vec2(1.0, 0.8) + vec2(0.02, 0.05) * time).g *
                 net_at(s * vec2(0.61, 1.1) - vec2(0.03, -0.04) * time + 0.5).g;
  float near = smoothstep(80.0, 8.0, p.y);
  float lamp = exp(-pow((p.x - 500.0) / 480.0, 2.0));
  c += vec3(0.36, 0.66, 0.64) * ripple * near * (0.18 + 0.82 * lamp);
  c = mix(c, vec3(0.24, 0.55, 0.57), 0.30 * near * near * (0.3 + 0.7 * lamp));
  color = vec4(c, 1.0);
}
