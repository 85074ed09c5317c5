// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/decoder.h - the child process that decodes, and what it says on the socket: one Hello, then
// a FrameHead for each frame, whose planes (Y, Cb, Cr, RGBA if it has them, no padding) lie in the
// ring (film/ring.h), then a FrameHead of kind End. It hears a byte for each frame that it may
// send.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "film/source.h"
#include "film/video.h"

namespace vsprite::detail {

enum class Kind : std::int32_t { Film, NoFilm, Frame, End, Damaged };

struct Hello {
  Kind kind = Kind::NoFilm;
  std::int32_t width = 0, height = 0;
  std::int32_t claimed_frames = 0;
  std::int32_t counted_frames = 0;  ///< packets found
  std::int32_t rotation = 0;
  std::int32_t bits = 8;
  double fps = 0;
  std::uint32_t time_numerator = 1, time_denominator = 1;
  Coding coding;
  Transfer transfer = Transfer::Sdr;
  std::uint8_t interlaced = 0, has_alpha = 0, pictures = 0;
  std::uint8_t claims_time = 0;  ///< the claim is of seconds, not of frames
  char fault[256] = {};          ///< of NoFilm, where there is more to say
  char pixel_format[32] = {};
};

struct FrameHead {
  Kind kind = Kind::End;
  std::int32_t width = 0, height = 0;
  std::int32_t index = 0;
  std::int64_t time = Frame::kNoTime;
  Coding coding;
  std::uint8_t damaged = 0, has_rgba = 0;
};

/// Which frames are sent, of those that the source admits. Sought: every one of the source's range,
/// decoded from the key frame before it on.
struct Selection {
  enum Mode { Every, Sought, KeyFrames, Spread, Bursts } mode = Every;
  int wanted = 0;         ///< of the last three: about how many frames, or runs of them
  int length = 1;         ///< of Bursts: frames in a run
  bool by_count = false;  ///< whatever is a key frame: for two films side by side
};

inline constexpr int kExitNoMemory = 71;

/// "1920 x 1080".
inline std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

/// The child's ends.
struct Channel {
  int socket, memory;
};

/// Runs in the child, between fork and _exit; `parent` is who forked it.
[[noreturn]] void decode_in_child(Channel channel, pid_t parent, const FilmSource& source,
                                  const Selection& selection);

}  // namespace vsprite::detail
