// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Stretches a layer over the area. In and out: linear, premultiplied.
uniform sampler2D layer;
uniform vec4 area;

void main() { color = texture(layer, (pixel - area.xy) / area.zw); }
