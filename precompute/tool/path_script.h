// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/path_script.h - a drawn path as people write it, and what a run along it made.
//
// One point a line, `x y` in output pixels; `#` starts a comment; blank lines do not count.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/search.h"
#include "tool/project.h"
#include "vsprite/ground.h"

namespace vsprite {

/// Errors: BadContent, naming file, line and what was found.
Result<std::vector<Vec2>> parse_path(const std::string& text, const std::string& name);

/// Where a film of a path is: its size, and the place of (0, 0) of the script in it.
struct PathPicture {
  int width = 0, height = 0;
  Vec2 origin{};
  std::optional<Ground> floor{};  ///< seen in perspective: runs then count on the ground

  /// Where an anchor lies, and how large it is drawn there.
  Vec2 place(Position at) const;
  float scale(Position at) const;
};
/// The path's box and a body length around it.
PathPicture picture_around(const std::vector<Vec2>& points, float body_length);
/// Errors: BadContent (the box of the path lies wholly outside the picture).
Result<void> check_inside(const std::vector<Vec2>& points, const PathPicture& picture,
                          const std::string& name);

std::string path_text(const Sprite& sprite, const Clip& clip, const ClipReport& report,
                      double seconds);
/// The row `path` of the table in DESIGN section 4.
Json path_json(const Sprite& sprite, const Clip& clip, const ClipReport& report, double seconds);
/// frame,sample,x,y,segment,cost; frames and segments from 0.
std::string clip_csv(const Clip& clip);
/// Where the sprite is drawn, for other programs: fps, size, ticks[]{sample, x, y}; on a floor
/// `scale` too.
Json clip_json(const Sprite& sprite, const Clip& clip, const PathPicture& picture);

}  // namespace vsprite
