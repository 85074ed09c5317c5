// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The ground that a character is tried on. kind: 0 a pale floor with a grid that moves with the world,
// 1 a checkerboard, 2 nearly black, 3 white. camera: world px at the frame's middle, frame px per world
// px in z. spacing: of the grid, world px. Out: linear, opaque.
uniform float kind;
uniform vec3 camera;
uniform float spacing;

// Coverage of lines `width` frame pixels wide, every `step_size` world pixels.
float grid(vec2 world, float step_size, float width) {
  vec2 to_line = abs(fract(world / step_size + 0.5) - 0.5) * step_size * camera.z;
  vec2 cover = clamp(0.5 + 0.5 * width - to_line, 0.0, 1.0);
  return max(cover.x, cover.y);
}

void main() {
  vec2 middle = 0.5 * frame_size;
  vec2 world = camera.xy + (pixel - middle) / camera.z;
  vec2 off = (pixel - middle) / frame_size.y;
  vec3 light;
  if (kind < 0.5) {
    light = mix(vec3(0.74, 0.78, 0.80), vec3(0.53, 0.58, 0.62), clamp(pixel.y / frame_size.y, 0.0, 1.0));
    light *= 1.06 - 0.34 * dot(off, off);
    light *= 1.0 - 0.09 * grid(world, spacing, 1.0) - 0.15 * grid(world, 4.0 * spacing, 1.6);
  } else if (kind < 1.5) {
    vec2 cell = floor(world / (0.5 * spacing));
    light = vec3(mod(cell.x + cell.y, 2.0) < 0.5 ? 0.60 : 0.32);
  } else if (kind < 2.5) {
    light = vec3(0.010, 0.012, 0.016) + 0.006 * grid(world, spacing, 1.0);
  } else {
    light = vec3(1.0) - 0.10 * grid(world, spacing, 1.0);
  }
  color = vec4(light, 1.0);
}
