// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Linear premultiplied light to sRGB (IEC 61966-2-1), pixel by pixel. With FILE defined the result has
// straight alpha, without it it lies over black, for windows. With DITHER noise of one step of 1/255 is
// added.
in vec2 place;
uniform sampler2D frame;
uniform vec2 frame_size;
out vec4 color;

// 1.055 l^(1/2.4) - 0.055 within 0.009 / 255, from square roots: a power costs software drivers dearly.
vec3 encoded(vec3 l) {
  vec3 s = sqrt(l);
  vec3 q = sqrt(s);
  vec3 curve = 0.081313 * l - 0.3354503 * s * q + 1.122629 * s + 0.1961573 * q - 0.0646144;
  return mix(12.92 * l, curve, step(0.0031308, l));
}

void main() {
  vec4 light = texelFetch(frame, ivec2(place * frame_size), 0);
#ifdef FILE
  light.rgb /= max(light.a, 1.0 / 4096.0);
#endif
  vec3 e = encoded(clamp(light.rgb, 0.0, 1.0));
#ifdef DITHER
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  e += (noise - 0.5) / 255.0;
#endif
#ifdef FILE
  color = vec4(e, clamp(light.a, 0.0, 1.0));
#else
  color = vec4(e, 1.0);
#endif
}
