// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/sender.h - decoded frames into the ring: upright, 8-bit 4:2:0, plain dynamic range; with
// their own RGBA beside it where they have coverage or are pictures. In the decoder's child alone.
#pragma once

#include "film/container.h"
#include "film/ring.h"
#include "vsprite/image.h"

namespace vsprite::detail {

/// Writes all of it; ends the process where nobody reads any more.
void send(int fd, const void* data, std::size_t size);

class Sender {
 public:
  /// Frames of the size that `hello` names have room in the ring; of others the head alone is sent.
  Sender(const Channel& channel, const Hello& hello) : channel_(channel), hello_(hello) {}
  void send_frame(const AVFrame& frame, int index);
  /// Straight alpha.
  void send_picture(const Image& picture, int index, std::int64_t time);

 private:
  /// The slot of the next frame, once it is granted; null where `head` is of another size.
  std::uint8_t* claim(const FrameHead& head);
  const AVFrame& convert(const AVFrame& frame, AVPixelFormat to, bool full_range);
  void send_coverage(const AVFrame& frame, FrameHead head);
  void send_mapped(const AVFrame& frame, FrameHead head);
  void send_planes(const FrameHead& head, const std::uint8_t* const (&planes)[3],
                   const std::ptrdiff_t (&strides)[3], int width, int height);

  Channel channel_;
  Hello hello_;
  Ring ring_;
  Owned<SwsContext> scaler_;
  Owned<AVFrame> made_{need(av_frame_alloc())};
};

}  // namespace vsprite::detail
