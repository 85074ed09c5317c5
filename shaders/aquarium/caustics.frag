// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// caustics.frag - one tile of the light net that a moving surface throws, drawn small every frame.
//
// Inputs: time, seconds. The tile repeats after frame_size - 1 pixels, so that a sampler without
// wrapping meets no seam. Output: red = light relative to the mean, 0..3, over 3; green = its square
// root, a softer net. No colour space: these are factors.
uniform float time;

const float kTurn = 6.2831853;

void main() {
  vec2 uv = (pixel - 0.5) / (frame_size - 1.0);
  vec2 p = uv * kTurn;
  vec2 q = p;
  float t = time * 0.55 + 23.0;
  float sum = 0.0;
  // Waves bend the coordinates of waves: where many rays meet, the denominator is small.
  for (int n = 0; n < 4; ++n) {
    float tn = t * (1.0 - 3.5 / float(n + 1));
    q = p + vec2(cos(tn - q.x) + sin(tn + q.y), sin(tn - q.y) + cos(tn + q.x));
    sum += 0.81 / length(1.0 / vec2(sin(q.x + tn), cos(q.y + tn)));
  }
  sum = 1.17 - pow(sum / 4.0, 1.4);
  float net = min(pow(abs(sum), 8.0), 3.0) / 3.0;
  color = vec4(net, sqrt(net), 0.0, 1.0);
}
