// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Bilinear between texels that are linear premultiplied light; a shrunk picture is averaged over the
// pixel's footprint by up to 4 x 4 such samples. Out: linear, premultiplied.
in vec2 texel;
flat in vec4 picture;
flat in vec4 picture_tint;
flat in vec4 picture_fog;
uniform sampler2D page;
uniform vec2 page_size;
out vec4 color;

void main() {
  vec2 across = dFdx(texel);
  vec2 down = dFdy(texel);
  float reach = max(length(across), length(down));
  int taps = int(clamp(ceil(reach - 0.02), 1.0, 4.0));
  vec4 sum = vec4(0.0);
  for (int j = 0; j < taps; ++j) {
    for (int i = 0; i < taps; ++i) {
      vec2 f = (vec2(i, j) + 0.5) / float(taps) - 0.5;
      // Beyond half a texel lies the border of zeros: staying on it keeps neighbours out.
      vec2 at = clamp(texel + f.x * across + f.y * down, vec2(-0.5), picture.zw + 0.5);
      sum += textureLod(page, (picture.xy + at) / page_size, 0.0);
    }
  }
  vec4 light = sum / float(taps * taps);
  light.rgb *= picture_tint.rgb;
  light.rgb = mix(light.rgb, picture_fog.rgb * light.a, picture_fog.a);
  color = light * picture_tint.a;
}
