// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// light.frag - all light that moves in the tank, drawn small every frame and read by water.frag:
// shafts from the surface, its rippling underside, and the net on whatever stands in the water.
//
// Inputs: common.frag; caustics, a tile by caustics.frag; time, seconds. Output: square roots, so
// that bytes are fine enough in the dark: red = shafts, green = underside / 3, blue = its veil,
// alpha = net / 3.
uniform sampler2D caustics;
uniform float time;

vec2 net_at(vec2 turns) {
  const float kSize = 128.0;
  return texture(caustics, (fract(turns) * (kSize - 1.0) + 0.5) / kSize).rg * vec2(3.0, 1.7320508);
}

// Shafts fan out from a lamp above the surface, left of the middle.
float shafts(vec2 p) {
  vec2 ray = p - vec2(470.0, -520.0);
  float a = ray.x / ray.y;
  float shaft = net_at(vec2(a * 0.42 + 0.013 * time, 0.021 * time)).g *
                net_at(vec2(a * 0.97 - 0.017 * time, 0.4 + 0.013 * time)).g;
  return 0.55 * shaft * exp(-max(p.y, 0.0) / 360.0) * smoothstep(1.2, 0.2, abs(a));
}

// A mirror that ripples, brighter towards the lamp: its light, and how much it hides.
vec2 underside(vec2 p) {
  float u = 30.0 / max(84.0 - p.y, 6.0);  // distance to the place seen, over its height
  vec2 s = vec2((p.x - 560.0) * u / 260.0, u * 3.2);
  float ripple = net_at(s * vec2(1.0, 0.8) + vec2(0.02, 0.05) * time).g *
                 net_at(s * vec2(0.61, 1.1) - vec2(0.03, -0.04) * time + 0.5).g;
  float near = smoothstep(80.0, 8.0, p.y);
  float lamp = exp(-pow((p.x - 500.0) / 480.0, 2.0));
  return vec2(ripple * near * (0.18 + 0.82 * lamp), 0.30 * near * near * (0.3 + 0.7 * lamp));
}

// On the gravel the net lies in perspective, on what stands up from it, upright. Two sheets of
// waves; where both focus there is light.
float net(vec2 p) {
  float w = 110.0 / max(p.y - 500.0, 56.0);
  vec2 g = vec2((p.x - 640.0) * w, 900.0 * w) / 290.0;
  g.y += max(556.0 - p.y, 0.0) * 0.011;
  return min(net_at(g + vec2(0.011, 0.017) * time).r,
             net_at(g * 0.83 + vec2(-0.019, 0.008) * time + 0.37).r);
}

void main() {
  vec2 p = tank_at(pixel);
  vec2 top = p.y < 82.0 ? underside(p) : vec2(0.0);
  float bottom = p.y > 300.0 ? net(p) : 0.13;  // where nothing stands, its mean
  color = sqrt(vec4(shafts(p), top.x / 3.0, top.y, bottom / 3.0));
}
