// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// In and out: linear, premultiplied.
in vec4 flat_tint;
out vec4 color;

void main() { color = flat_tint; }
