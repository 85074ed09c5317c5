// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/video.h - a film as a run of frames, decoded once, in order, in a child process.
//
// OpenCV's FFmpeg backend runs in a forked child with limits; frames arrive over a pipe. A decoder
// that crashes or hangs is this film's error, not ours. The container's frame count is a claim that
// is compared with what arrived, never trusted. Open films before other threads are started.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "vsprite/result.h"

namespace vsprite {

/// One image as filmed: (height, width) BGR, 8 bits, no padding.
struct Frame {
  int width = 0;
  int height = 0;
  int index = 0;  ///< from 0, in the order of decoding
  std::vector<std::uint8_t> bgr;
};

struct FilmInfo {
  int width = 0;
  int height = 0;
  std::uint32_t fps_numerator = 30;
  std::uint32_t fps_denominator = 1;
  int claimed_frames = 0;  ///< what the container says; 0 if it says nothing
};

class FilmReader {
 public:
  /// Errors: NotFound, CannotRead, BadFormat (no film), LimitExceeded (over 16,384 px a side).
  static Result<FilmReader> open(const std::string& path);
  FilmReader(FilmReader&&) noexcept;
  FilmReader& operator=(FilmReader&&) noexcept;
  ~FilmReader();

  const FilmInfo& info() const noexcept;
  /// The next frame into `frame`; false at the end. Errors: DecoderFailed (died, hung for 30 s),
  /// CorruptData (the frame size changes, told from the packets of H.264, H.265, MPEG-1, MPEG-2
  /// and JPEG films; fewer frames than 0.98 x claimed - 2 arrived), OutOfMemory.
  Result<bool> read(Frame& frame);

 private:
  struct Impl;
  explicit FilmReader(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsprite
