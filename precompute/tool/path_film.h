// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/path_film.h - scripted sprites drawn, sub-pixel and in linear light, into a film or
// pictures.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "film/video.h"
#include "tool/path_script.h"
#include "vsprite/image.h"

namespace vsprite {

/// One sprite's part. Borrows both.
struct FilmRole {
  const Sprite* sprite = nullptr;
  const Clip* clip = nullptr;
};

/// What lies behind the sprites: a picture, a film that is shown over and over, or nothing.
struct Backdrop {
  Image still;  ///< straight alpha; 0 x 0: none
  std::vector<Frame> film;
  double fps = 0;  ///< of `film`

  bool is_empty() const { return still.width == 0 && film.empty(); }
  int width() const { return film.empty() ? still.width : film[0].width; }
  int height() const { return film.empty() ? still.height : film[0].height; }
};
/// A picture (.png), else a film. Errors: those of read_png and FilmReader; LimitExceeded (a film
/// of more than 1.5 GB of frames).
Result<Backdrop> read_backdrop(const std::string& path);

/// Writes `path`: a film (vsprite/record.h; with alpha, but for .mp4, where there is no backdrop),
/// or pictures frame-00000.png ... into a folder, where `path` ends in `/` or is one. What was begun and not
/// finished is removed. `backdrop`: of the picture's size; empty: a plain ground (clear where the
/// format has alpha). Sprites are drawn from the one highest in the picture to the lowest.
/// `go_on` is asked before every frame; may be empty.
/// Errors: BadSetting (another ending), Unavailable (no ffmpeg), CannotCreate, CannotWrite,
/// Interrupted (`go_on` said no).
Result<void> write_path_film(const std::string& path, const std::vector<FilmRole>& roles,
                             const PathPicture& picture, const Backdrop& backdrop,
                             const std::function<void(double)>& progress,
                             const std::function<bool()>& go_on = {});

}  // namespace vsprite
