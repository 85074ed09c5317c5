// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/video.h - a film as a run of frames, as they were coded, decoded in a child process.
//
// A film carries brightness (Y) for every pixel and colour (Cb, Cr) for every 2 x 2 cell; the keyer
// wants exactly that, and blowing it up to RGB costs more than keying. So a Frame holds the planes.
//
// libavformat and libavcodec are called directly: OpenCV's VideoCapture hands out BGR only, and
// neither time stamps, nor rotation, colour tags, field order or the size of single frames can be
// reached through it. They run in a forked child with limits; frames arrive in shared memory. A
// decoder that crashes or hangs is this film's error, not ours. The container's frame count is a
// claim that is compared with what arrived, never trusted. Open films before other threads are
// started.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "film/source.h"
#include "vsprite/result.h"

namespace vsprite {

/// How Y, Cb, Cr are made of R, G, B (ITU-T H.273). Plain tags: they cross a socket.
enum class Matrix : std::uint8_t { Bt601, Bt709, Bt2020 };
enum class Siting : std::uint8_t { Unknown, Left, Center, TopLeft };  ///< of a cell's colour
enum class Transfer : std::uint8_t { Sdr, Hlg, Pq };

/// What the numbers of the planes mean.
struct Coding {
  Matrix matrix = Matrix::Bt601;
  bool full_range = false;  ///< Y 0..255 instead of 16..235, Cb and Cr 0..255 instead of 16..240
  Siting siting = Siting::Unknown;

  bool operator==(const Coding&) const = default;
};

/// One image as filmed: 8 bits, Y'CbCr 4:2:0, no padding. Odd sizes have a last half cell.
struct Frame {
  int width = 0;
  int height = 0;
  int index = 0;  ///< from 0, in the order of showing
  Coding coding;
  std::int64_t time = kNoTime;  ///< when it is shown, in FilmInfo's time base
  bool damaged = false;         ///< the decoder patched holes in it
  int lost_before = 0;          ///< frames missing before it, by the time stamps

  std::vector<std::uint8_t> y;       ///< (height, width)
  std::vector<std::uint8_t> cb, cr;  ///< (cell_height(), cell_width())
  /// (height, width, 4) straight alpha, as it was stored: of pictures, of films that carry coverage
  /// and where a matte lies beside the film; else empty. The planes hold it over black.
  std::vector<std::uint8_t> rgba;

  static constexpr std::int64_t kNoTime = INT64_MIN;
  int cell_width() const noexcept { return (width + 1) / 2; }
  int cell_height() const noexcept { return (height + 1) / 2; }
  /// Sizes the planes for `w` x `h` pixels; their contents are not specified.
  void resize(int w, int h);
};

struct FilmInfo {
  int width = 0;  ///< as shown
  int height = 0;
  std::uint32_t fps_numerator = 30;
  std::uint32_t fps_denominator = 1;
  int claimed_frames = 0;  ///< what the container says; 0 if it says nothing
  int counted_frames = 0;  ///< packets of the film

  std::uint32_t time_numerator = 1, time_denominator = 1;  ///< seconds a tick of Frame::time
  int rotation =
      0;  ///< degrees clockwise by which frames were turned, as a player does: 0, 90, 180, 270
  Transfer transfer = Transfer::Sdr;
  Coding coding;             ///< of the first frame
  std::string pixel_format;  ///< as libavutil names it: "yuv420p", "yuv420p10le", ...
  int bits = 8;              ///< of a sample as coded
  bool interlaced = false;
  bool has_alpha = false;  ///< the format has room for coverage; whether it is used, frames tell
  bool pictures = false;   ///< not a film but pictures in a row
};

class FilmReader {
 public:
  /// Errors: NotFound, CannotRead, BadFormat (no film), LimitExceeded (over 16,384 px a side),
  /// BadContent (the matte's size differs).
  static Result<FilmReader> open(const FilmSource& source);
  /// Reads about `count` runs of `length` consecutive frames, spread over the film, in order; told
  /// apart by Frame::index. Runs begin at key frames where there are enough of them. A film that
  /// ends early is no error. Errors: those of open().
  static Result<FilmReader> open_bursts(const FilmSource& source, int count, int length);
  /// Reads the source's range from the key frame before it on: to look at a place in a film at the
  /// cost of what lies between two key frames. No rate is kept and a film that ends early is no
  /// error; without time stamps all that comes before is decoded. Errors: those of open().
  static Result<FilmReader> open_range(const FilmSource& source);
  FilmReader(FilmReader&&) noexcept;
  FilmReader& operator=(FilmReader&&) noexcept;
  ~FilmReader();

  const FilmInfo& info() const noexcept;
  /// The next frame into `frame`; false at the end. Frames come at the film's rate, by their time
  /// stamps: what is missing is counted in Frame::lost_before, what is too much is passed over.
  /// Errors: DecoderFailed (died, hung for 30 s), CorruptData (the frame size changes; fewer frames
  /// than 0.98 x claimed - 2 arrived; the matte has fewer or more frames), OutOfMemory.
  Result<bool> read(Frame& frame);
  /// Frames that read() passed over because others stand for their time.
  int surplus() const noexcept;

 private:
  friend Result<std::vector<Frame>> sample_frames(const FilmSource& source, int wanted,
                                                  const std::function<bool(double)>& go_on);
  struct Impl;
  explicit FilmReader(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

/// About `wanted` frames, spread evenly over the film, in order, each with its index. Key frames
/// alone where there are enough of them (that costs next to nothing); otherwise the whole film is
/// decoded and nearly all of it dropped. Takes at most 400 MB: fewer frames of large pictures.
/// `go_on`, if any, is told the share that is done, and ends it where it says false.
/// Errors: those of open() and read(), but a film that ends early is none.
Result<std::vector<Frame>> sample_frames(const FilmSource& source, int wanted,
                                         const std::function<bool(double)>& go_on = {});

}  // namespace vsprite
