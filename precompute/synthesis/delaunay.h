// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// synthesis/delaunay.h - the mesh between control points where nobody drew one.
#pragma once

#include <span>
#include <vector>

#include "vsprite/puppet.h"

namespace vsprite {

/// The Delaunay triangles of the points, clockwise on the screen, in an order that depends on
/// nothing but them. None where all lie on a line. Points at the same place: only one is used.
/// Bowyer (1981) and Watson (1981); O(n sqrt n) for scattered points.
std::vector<Face> triangulate(std::span<const Vec2> points);

}  // namespace vsprite
