// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/record.h - films and screenshots of what was drawn.
//
// Frames go through a pipe to the `ffmpeg` program. The ending says what becomes of them:
//
//     .mp4    H.264, 4:2:0, without alpha
//     .mkv    FFV1, lossless, with alpha
//     .webm   VP9, 4:2:0, with alpha; loses a little of both
//     .apng   lossless, with alpha; plays for ever
//     .gif    256 colours of the whole film, clear where alpha is below 128; plays for ever
//
// Files are written beside their target and renamed: they appear complete, or not at all.
#pragma once

#include <memory>
#include <string>

#include "vsprite/image.h"
#include "vsprite/result.h"

namespace vsprite {

/// Writes one film. Movable; a writer that is destroyed before close() leaves no file.
class FilmWriter {
 public:
  FilmWriter() noexcept;
  FilmWriter(FilmWriter&&) noexcept;
  FilmWriter& operator=(FilmWriter&&) noexcept;
  ~FilmWriter();

  /// `path` has one of the endings above; another one stands for .mp4, whose odd sizes lose their
  /// last row or column (4:2:0 needs even ones).
  /// Errors: Unavailable (no `ffmpeg` on the PATH), CannotCreate, BadSetting (size under 2, fps <=
  /// 0).
  Result<void> open(const std::string& path, int width, int height, double fps);
  /// Straight alpha, ignored by .mp4. Pre: open; the picture has the film's size. Errors:
  /// CannotWrite.
  Result<void> add(ImageView frame);
  /// Waits for ffmpeg and renames. Errors: CannotWrite, with ffmpeg's last words.
  Result<void> close();
  bool is_open() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes a straight-alpha picture. Errors: CannotCreate, CannotWrite, OutOfMemory.
Result<void> save_png(const std::string& path, ImageView image);

/// For `--record FILE`: FILE.png keeps the last frame, FILE.mp4 all of them, "" nothing.
class Recorder {
 public:
  /// Errors: BadSetting (another ending), and those of FilmWriter::open.
  static Result<Recorder> open(const std::string& path, int width, int height, double fps);
  Result<void> add(Image frame);
  Result<void> close();
  bool is_open() const noexcept { return !path_.empty(); }

 private:
  std::string path_;
  FilmWriter film_;
  Image last_;
};

}  // namespace vsprite
