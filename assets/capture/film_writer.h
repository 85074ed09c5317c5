// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// capture/film_writer.h - pictures into a film file, through the program `ffmpeg`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vsprite/image.h"
#include "vsprite/result.h"

namespace vsprite::capture {

struct FilmSettings {
  int width = 0, height = 0;  ///< even
  int fps = 30;
  double crf = 22;  ///< x264's quality, 0 (best) .. 51
};

/// H.264 4:2:0 in MP4, one encoder thread, no times or names inside: the same pictures give the
/// same bytes with the same x264. Written beside `path`, renamed by finish().
class FilmWriter {
 public:
  /// Errors: Unavailable (no ffmpeg), CannotCreate.
  static Result<FilmWriter> open(const std::string& path, const FilmSettings& settings);
  FilmWriter(FilmWriter&& other) noexcept;
  FilmWriter& operator=(FilmWriter&&) = delete;
  ~FilmWriter();

  /// Pre: the image has the film's size. Errors: CannotWrite.
  Result<void> write(const Image& image);
  /// Errors: CannotWrite.
  Result<void> finish();

 private:
  FilmWriter(std::string path, FilmSettings settings, int pipe, int child)
      : path_(std::move(path)), settings_(settings), pipe_(pipe), child_(child) {}

  std::string path_;
  FilmSettings settings_;
  int pipe_ = -1;
  int child_ = -1;
  std::vector<std::uint8_t> planes_;
};

}  // namespace vsprite::capture
