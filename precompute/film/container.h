// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/container.h - a film file as libavformat and libavcodec see it. Used in the decoder's child
// process alone: out of memory is std::bad_alloc there.
#pragma once

#include <memory>
#include <new>
#include <string>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include "film/decoder.h"

namespace vsprite::detail {

struct Free {
  void operator()(AVFormatContext* p) const { avformat_close_input(&p); }
  void operator()(AVCodecContext* p) const { avcodec_free_context(&p); }
  void operator()(AVPacket* p) const { av_packet_free(&p); }
  void operator()(AVFrame* p) const { av_frame_free(&p); }
  void operator()(SwsContext* p) const { sws_freeContext(p); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

inline void check_memory(int error) {
  if (error == AVERROR(ENOMEM)) throw std::bad_alloc();
}

template <class T>
T* need(T* made) {
  if (!made) throw std::bad_alloc();
  return made;
}

// A film and its decoder.
class Film {
 public:
  /// False: there is no film in the file.
  bool open(const std::string& path);
  AVStream& stream() const { return *format_->streams[stream_]; }
  AVFormatContext& format() const { return *format_; }
  AVCodecContext& decoder() const { return *decoder_; }

  /// The next packet of the film; false at the end.
  bool next_packet(AVPacket& packet) {
    for (;;) {
      av_packet_unref(&packet);
      const int got = av_read_frame(format_.get(), &packet);
      check_memory(got);
      if (got < 0) return false;
      if (packet.stream_index == stream_) return true;
    }
  }
  /// The next frame of the packets that `wanted` admits; false at the end. A picture that cannot be
  /// decoded is passed over: the count of frames will tell.
  template <class Wanted>
  bool next_frame(AVFrame& frame, Wanted wanted) {
    for (int lost = 0; lost < 1 << 20;) {
      const int got = avcodec_receive_frame(decoder_.get(), &frame);
      check_memory(got);
      if (got >= 0) return true;
      if (got == AVERROR_EOF) return false;
      lost += ended_ ? 1 : 0;
      if (!ended_) feed(wanted);
    }
    return false;
  }

 private:
  template <class Wanted>
  void feed(Wanted wanted) {
    while (!waits_) {
      ended_ = !next_packet(*packet_);
      if (ended_ || wanted(*packet_)) break;
    }
    const int sent = avcodec_send_packet(decoder_.get(), ended_ ? nullptr : packet_.get());
    check_memory(sent);
    waits_ = sent == AVERROR(EAGAIN);
  }

  Owned<AVFormatContext> format_;
  Owned<AVCodecContext> decoder_;
  Owned<AVPacket> packet_{need(av_packet_alloc())};
  int stream_ = -1;
  bool waits_ = false;  // the packet at hand was not taken yet
  bool ended_ = false;  // there are no more packets
};

/// The film's packets, undecoded: when each is shown, and which of them stand for key frames.
struct Outline {
  std::vector<std::int64_t> times;  ///< of every shown frame, sorted; kNoTime where there is none
  std::vector<std::int64_t> keys;   ///< of the key frames, in the order of the file
};
/// Empty where there is no film.
Outline outline_of(const std::string& path);

/// What the numbers of a decoded frame mean.
Coding coding_of(const AVFrame& frame);
Transfer transfer_of(const AVFrame& frame);
bool has_alpha(const AVFrame& frame);

/// What is known after the first frame.
Hello describe(const Film& film, const Outline& outline, const AVFrame& first);

}  // namespace vsprite::detail
