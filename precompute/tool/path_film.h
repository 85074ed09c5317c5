// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/path_film.h - scripted sprites drawn, sub-pixel and in linear light, into a film or
// pictures.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tool/path_script.h"
#include "vsprite/image.h"

namespace vsprite {

/// One sprite's part. Borrows both.
struct FilmRole {
  const Sprite* sprite = nullptr;
  const Clip* clip = nullptr;
};

/// Writes `path`: .mp4 (H.264), .mkv (FFV1, with alpha where there is no backdrop), .json (places),
/// or pictures frame-00000.png ... into a folder, where `path` ends in `/` or is one.
/// `backdrop`: straight alpha, of the picture's size; empty: a plain ground (clear where the format
/// has alpha). Sprites are drawn from the one highest in the picture to the lowest.
/// Errors: BadSetting (another ending), Unavailable (no ffmpeg), CannotCreate, CannotWrite.
Result<void> write_path_film(const std::string& path, const std::vector<FilmRole>& roles,
                             const PathPicture& picture, const Image& backdrop,
                             const std::function<void(double)>& progress);

}  // namespace vsprite
