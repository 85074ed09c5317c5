// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/svg_points.h - control points that were placed in a drawing program.
#pragma once

#include <string>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/result.h"

namespace vsprite {

/// The nodes of all paths (also lines, polylines and polygons) of an SVG, path after path in the
/// order of the file, in px of a picture of this size: the drawing's page lies over the picture.
/// Only nodes count: how a curve or an arc bends between two of them does not. The closing of a
/// path adds no node, and neither does a last node that lies on the first. What is not displayed,
/// or only defined (<defs>, <clipPath>, <mask>, <symbol>, <pattern>, <marker>), is left out.
/// Errors: BadContent (no SVG; path data that is none, with the path's id; a page of another shape
/// than the picture; no path).
Result<std::vector<Vec2>> parse_svg_points(const std::string& text, const std::string& path,
                                           int width, int height);

}  // namespace vsprite
