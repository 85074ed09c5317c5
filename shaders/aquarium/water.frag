// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// water.frag - the tank behind the fish: the backdrop, and the light that moves over it.
//
// Inputs: backdrop, drawn by wall, gravel, wood and stone, of the size of the frame except while a
// window is dragged; its alpha is how much of the net falls where. light, by light.frag. Output:
// linear light, opaque.
uniform sampler2D backdrop;
uniform sampler2D light;

void main() {
  vec4 still = texelFetch(backdrop, ivec2(pixel * vec2(textureSize(backdrop, 0)) / frame_size), 0);
  vec4 moving = texture(light, pixel / frame_size);
  moving *= moving;
  vec3 c = still.rgb * (1.0 + still.a * (9.0 * moving.a - 0.40));
  c += vec3(0.22, 0.44, 0.42) * moving.r;
  // The underside of the surface hides a little of what is behind it.
  c += vec3(1.08, 1.98, 1.92) * moving.g + (vec3(0.24, 0.55, 0.57) - c) * moving.b;
  color = vec4(c, 1.0);
}
