// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Linear premultiplied light to sRGB (IEC 61966-2-1). straight: 1 for files (straight alpha), 0 for
// windows (over black). dither: height of the noise, in steps of 1/255.
in vec2 place;
uniform sampler2D frame;
uniform float straight;
uniform float dither;
out vec4 color;

void main() {
  vec4 light = texture(frame, place);
  if (straight > 0.5 && light.a > 0.0) light.rgb /= light.a;
  vec3 l = clamp(light.rgb, 0.0, 1.0);
  vec3 e = mix(12.92 * l, 1.055 * pow(l, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, l));
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  e += (noise - 0.5) * dither / 255.0;
  color = vec4(e, straight > 0.5 ? clamp(light.a, 0.0, 1.0) : 1.0);
}
