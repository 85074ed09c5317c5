// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The parent's end: what the decoder (film/decoder.h) sends, and what became of it.
#include "film/video.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <new>

#include "film/color.h"
#include "film/decoder.h"
#include "film/pacer.h"
#include "film/ring.h"

namespace vsprite {

using detail::FrameHead;
using detail::Hello;
using detail::kExitNoMemory;
using detail::Kind;
using detail::Selection;
using detail::size_text;

void Frame::resize(int w, int h) {
  width = w;
  height = h;
  y.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  cb.resize(static_cast<std::size_t>(cell_width()) * static_cast<std::size_t>(cell_height()));
  cr.resize(cb.size());
}

namespace {

constexpr int kMaxSide = 16384;
constexpr int kHangMs = 30'000;

// The nearest rate in common use, else thousandths of a frame a second.
void set_rate(double fps, FilmInfo& info) {
  struct Rate {
    std::uint32_t numerator, denominator;
  };
  constexpr Rate kCommon[] = {{24000, 1001},  {24, 1},  {25, 1},       {30000, 1001}, {30, 1},
                              {48, 1},        {50, 1},  {60000, 1001}, {60, 1},       {100, 1},
                              {120000, 1001}, {120, 1}, {240, 1},      {15, 1},       {10, 1},
                              {12, 1},        {20, 1}};
  if (!(fps > 0.01) || !(fps < 10'000)) return;  // the container says nothing: 30
  double nearest = 6e-3;  // a short last frame or a phone's clock shifts the mean by as much
  bool found = false;
  for (const Rate r : kCommon) {
    const double ratio = std::abs(fps * r.denominator / r.numerator - 1);
    if (ratio >= nearest) continue;
    nearest = ratio;
    info.fps_numerator = r.numerator;
    info.fps_denominator = r.denominator;
    found = true;
  }
  if (found) return;
  info.fps_numerator = static_cast<std::uint32_t>(fps * 1000 + 0.5);
  info.fps_denominator = 1000;
}

std::string signal_name(int signal) {
  const char* short_name = sigabbrev_np(signal);
  return short_name ? std::string("SIG") + short_name : "signal " + std::to_string(signal);
}

enum class Pulled { All, Closed, Hung };

struct OwnedFd {
  int fd;
  explicit OwnedFd(int of) : fd(of) {}
  OwnedFd(const OwnedFd&) = delete;
  OwnedFd& operator=(const OwnedFd&) = delete;
  ~OwnedFd() {
    if (fd >= 0) close(fd);
  }
};

}  // namespace

struct FilmReader::Impl {
  std::string path;
  FilmInfo info;
  int fd = -1;  // the socket to the child
  detail::Ring ring{};
  pid_t child = -1;
  int next = 0;              // index of the frame to come
  bool ended = false;        // all frames were handed out
  bool whole = true;         // every frame of the file is due
  bool consecutive = true;   // no frame is left out, from the first that is due
  bool claims_time = false;  // the container claims seconds: lost frames count
  int lost = 0, surplus = 0;
  Pacer pacer{};
  std::unique_ptr<Impl> matte;
  Frame coverage;  // the matte's frame

  ~Impl() { stop(); }

  Result<void> start(const FilmSource& source, const Selection& selection);
  Result<void> start_matte(const FilmSource& source, const Selection& selection);
  /// The next frame that the child sends; false at the end.
  Result<bool> next_frame(Frame& frame);
  Result<bool> pull_frame(const FrameHead& head, Frame& frame);
  Result<bool> pull_coverage(bool more, Frame& frame);

  // Ends and reaps the child; returns its wait status, or 0 if there was none.
  int stop() {
    if (fd >= 0) close(fd);
    fd = -1;
    int status = 0;
    if (child > 0) {
      kill(child, SIGKILL);
      while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
    }
    child = -1;
    return status;
  }

  // Waits for the child's own end (it closed the socket, so it is near), for the reason of its
  // death.
  int reap() {
    int status = 0;
    for (int tries = 0; tries < 500; ++tries) {
      const pid_t done = waitpid(child, &status, WNOHANG);
      if (done == child) {
        child = -1;
        stop();
        return status;
      }
      poll(nullptr, 0, 10);
    }
    return stop();
  }

  Pulled pull(void* data, std::size_t size) {
    char* at = static_cast<char*>(data);
    while (size > 0) {
      pollfd ready{fd, POLLIN, 0};
      const int events = poll(&ready, 1, kHangMs);
      if (events < 0 && errno == EINTR) continue;
      if (events <= 0) return Pulled::Hung;
      const ssize_t n = ::read(fd, at, size);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return Pulled::Closed;
      at += n;
      size -= static_cast<std::size_t>(n);
    }
    return Pulled::All;
  }

  // Lets the child fill so many more slots; where it is dead, the next pull will tell.
  void grant(int slots) {
    const std::string bytes(static_cast<std::size_t>(slots), 'g');
    [[maybe_unused]] const ssize_t sent = send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }

  Error failure(Pulled how) {
    const std::string where = " at frame " + std::to_string(next);
    if (how == Pulled::Hung) {
      stop();
      return {ErrorCode::DecoderFailed, path + ": decoder hung" + where + ": no frame for " +
                                            std::to_string(kHangMs / 1000) +
                                            " s; re-encode the film, for instance with ffmpeg"};
    }
    const int status = reap();
    if (WIFEXITED(status) && WEXITSTATUS(status) == kExitNoMemory)
      return {ErrorCode::OutOfMemory, path + ": decoder ran out of memory" + where +
                                          ": more than 4 GiB wanted; scale the film down"};
    const std::string why =
        WIFSIGNALED(status) ? signal_name(WTERMSIG(status))
                            : "exit " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : 0);
    return {ErrorCode::DecoderFailed, path + ": decoder crashed" + where + " (" + why +
                                          "); re-encode the film, for instance with ffmpeg"};
  }

  Result<bool> finish() {
    ended = true;
    reap();
    if (whole && next + (claims_time ? lost - surplus : 0) < 0.98 * info.claimed_frames - 2)
      return Error{ErrorCode::CorruptData, path + ": film ends early: " + std::to_string(next) +
                                               " frames decoded, " +
                                               std::to_string(info.claimed_frames) +
                                               " due by its header; copy it again or re-encode it"};
    return false;
  }
};

namespace {

Result<void> check_file(const std::string& path) {
  struct stat file {};
  if (path.empty() || stat(path.c_str(), &file) != 0) {
    if (!path.empty() && is_picture_source(path) && (errno == ENOENT || errno == ENOTDIR)) {
      if (const auto found = find_pictures(path); !found) return found.error();
      if (path.find_first_of("*?%") != std::string::npos) return {};
    }
    if (path.empty() || errno == ENOENT || errno == ENOTDIR)
      return Error{ErrorCode::NotFound, path + ": no such file; give the path of a film"};
    return Error{ErrorCode::CannotRead, path + ": cannot be read: " + std::strerror(errno)};
  }
  if (S_ISDIR(file.st_mode)) {
    if (const auto found = find_pictures(path); !found) return found.error();
  }
  if (access(path.c_str(), R_OK) != 0)
    return Error{ErrorCode::CannotRead, path + ": cannot be read: " + std::strerror(errno)};
  return {};
}

}  // namespace

// Forks the decoder and hears its Hello.
Result<void> FilmReader::Impl::start(const FilmSource& source, const Selection& selection) {
  if (auto checked = check_file(source.path); !checked) return checked.error();
  path = source.path;
  consecutive = selection.mode == Selection::Every;
  whole = consecutive && source.first == 0 && source.end == INT_MAX;
  int ends[2];
  const OwnedFd memory(memfd_create("frames", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (memory.fd < 0 || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    return Error{ErrorCode::CannotRead,
                 path + ": no way to a decoder process: " + std::strerror(errno)};
  const pid_t parent = getpid();
  child = fork();
  if (child == 0) detail::decode_in_child({ends[1], memory.fd}, parent, source, selection);
  close(ends[1]);
  fd = ends[0];
  if (child < 0)
    return Error{ErrorCode::CannotRead, path + ": no decoder process: " + std::strerror(errno)};

  Hello hello{};
  if (const Pulled how = pull(&hello, sizeof hello); how != Pulled::All) return failure(how);
  if (hello.kind != Kind::Film)
    return Error{
        ErrorCode::BadFormat,
        hello.fault[0] != 0
            ? std::string(hello.fault)
            : path + ": no film: not one frame" +
                  (source.first > 0 ? " from " + std::to_string(source.first) + " on" : "") +
                  " can be decoded; due: a video file such as MP4"};
  if (hello.width < 1 || hello.height < 1 || hello.width > kMaxSide || hello.height > kMaxSide)
    return Error{ErrorCode::LimitExceeded,
                 path + ": frames of " + size_text(hello.width, hello.height) +
                     " px; due: at most " + std::to_string(kMaxSide) + " px a side"};
  if (!ring.make(memory.fd, hello.width, hello.height))
    return Error{ErrorCode::OutOfMemory, path + ": frames of " +
                                             size_text(hello.width, hello.height) +
                                             " px: no memory for them: " + std::strerror(errno)};
  grant(ring.slots());
  info.width = hello.width;
  info.height = hello.height;
  info.claimed_frames = hello.claimed_frames;
  info.counted_frames = hello.counted_frames;
  info.time_numerator = hello.time_numerator;
  info.time_denominator = hello.time_denominator;
  info.rotation = hello.rotation;
  info.transfer = hello.transfer;
  info.coding = hello.coding;
  info.pixel_format = hello.pixel_format;
  info.bits = hello.bits;
  info.interlaced = hello.interlaced != 0;
  info.has_alpha = hello.has_alpha != 0;
  info.pictures = hello.pictures != 0;
  claims_time = hello.claims_time != 0;
  set_rate(hello.fps, info);
  if (info.pictures) {
    info.time_numerator = info.fps_denominator;
    info.time_denominator = info.fps_numerator;
  }
  pacer = Pacer(info);
  return source.matte.empty() ? Result<void>{} : start_matte(source, selection);
}

Result<void> FilmReader::Impl::start_matte(const FilmSource& source, const Selection& selection) {
  FilmSource other = source;
  other.path = source.matte;
  other.matte.clear();
  matte = std::make_unique<Impl>();
  if (auto started = matte->start(other, selection); !started) return started;
  if (matte->info.width != info.width || matte->info.height != info.height)
    return Error{ErrorCode::BadContent, matte->path + ": the matte is " +
                                            size_text(matte->info.width, matte->info.height) +
                                            " px, the film " + size_text(info.width, info.height) +
                                            "; due: one size"};
  info.has_alpha = true;
  return {};
}

// The planes that lie in the next slot.
Result<bool> FilmReader::Impl::pull_frame(const FrameHead& head, Frame& frame) {
  if (head.width != info.width || head.height != info.height) {
    stop();
    return Error{ErrorCode::CorruptData,
                 path + ": frame " + std::to_string(next) + " is " +
                     size_text(head.width, head.height) + " px, the first " +
                     size_text(info.width, info.height) +
                     "; due: one size throughout; cut the film where the size changes"};
  }
  try {
    frame.resize(head.width, head.height);
    frame.rgba.resize(head.has_rgba != 0 ? 4 * frame.y.size() : 0);
  } catch (const std::bad_alloc&) {
    stop();
    return Error{
        ErrorCode::OutOfMemory,
        path + ": a frame of " + size_text(head.width, head.height) + " px does not fit in memory"};
  }
  const std::uint8_t* from = ring.next();
  for (auto* plane : {&frame.y, &frame.cb, &frame.cr, &frame.rgba}) {
    std::copy_n(from, plane->size(), plane->data());
    from += plane->size();
  }
  grant(1);
  frame.index = head.index;
  frame.coding = head.coding;
  frame.time = head.time;
  frame.damaged = head.damaged != 0;
  ++next;
  return true;
}

Result<bool> FilmReader::Impl::next_frame(Frame& frame) {
  if (ended || fd < 0) return false;
  FrameHead head{};
  if (const Pulled how = pull(&head, sizeof head); how != Pulled::All) return failure(how);
  if (head.kind == Kind::Damaged) {
    Hello hello{};
    pull(hello.fault, sizeof hello.fault);
    stop();
    return Error{ErrorCode::CorruptData, hello.fault};
  }
  const auto more = head.kind == Kind::End ? finish() : pull_frame(head, frame);
  return more && matte ? pull_coverage(*more, frame) : more;
}

// The matte's brightness becomes the coverage of the frame.
Result<bool> FilmReader::Impl::pull_coverage(bool more, Frame& frame) {
  const auto covered = matte->next_frame(coverage);
  if (!covered) return covered;
  if (*covered != more || (more && coverage.index != frame.index)) {
    stop();
    return Error{ErrorCode::CorruptData,
                 matte->path + ": the matte has " + (*covered ? "more" : "fewer") +
                     " frames than the film: " + std::to_string(more ? matte->next : next) +
                     " are in both; due: a frame for each"};
  }
  if (!more) return false;
  if (frame.rgba.empty()) frame.rgba = to_image(frame).rgba;
  const int black = coverage.coding.full_range ? 0 : 16,
            range = coverage.coding.full_range ? 255 : 219;
  for (std::size_t i = 0; i < coverage.y.size(); ++i)
    frame.rgba[4 * i + 3] = static_cast<std::uint8_t>(
        std::clamp(((coverage.y[i] - black) * 510 + range) / (2 * range), 0, 255));
  return true;
}

Result<FilmReader> FilmReader::open(const FilmSource& source) {
  auto impl = std::make_unique<Impl>();
  if (auto started = impl->start(source, {}); !started) return started.error();
  return FilmReader(std::move(impl));
}

Result<FilmReader> FilmReader::open_bursts(const FilmSource& source, int count, int length) {
  auto impl = std::make_unique<Impl>();
  const Selection selection{Selection::Bursts, count, length, !source.matte.empty()};
  if (auto started = impl->start(source, selection); !started) return started.error();
  return FilmReader(std::move(impl));
}

Result<FilmReader> FilmReader::open_range(const FilmSource& source) {
  auto impl = std::make_unique<Impl>();
  if (auto started = impl->start(source, {Selection::Sought}); !started) return started.error();
  return FilmReader(std::move(impl));
}

Result<bool> FilmReader::read(Frame& frame) {
  Impl& film = *impl_;
  for (;;) {
    const auto more = film.next_frame(frame);
    if (!more || !*more) return more;
    const int lost = film.consecutive ? film.pacer.lost_before(frame.time) : 0;
    frame.lost_before = std::max(lost, 0);
    film.lost += frame.lost_before;
    if (lost >= 0) return true;
    ++film.surplus;
  }
}

int FilmReader::surplus() const noexcept { return impl_->surplus; }

Result<std::vector<Frame>> sample_frames(const FilmSource& source, int wanted,
                                         const std::function<bool(double)>& go_on) {
  constexpr std::int64_t kRoom = std::int64_t{400} << 20;
  constexpr std::size_t kLeast = 16;
  std::vector<Frame> frames;
  for (const auto mode : {Selection::KeyFrames, Selection::Spread}) {
    FilmReader::Impl film;
    if (auto started = film.start(source, {mode, wanted, 1, !source.matte.empty()}); !started)
      return started.error();
    const std::int64_t bytes =
        (film.info.has_alpha ? 11 : 3) * std::int64_t{film.info.width} * film.info.height / 2;
    const auto room = std::max<std::int64_t>(kRoom / std::max<std::int64_t>(bytes, 1), 16);
    int stride = 1;
    if (room < wanted) stride = static_cast<int>((wanted + room - 1) / room);
    frames.clear();
    for (Frame frame;;) {
      const auto more = film.next_frame(frame);
      if (!more) return more.error();
      if (!*more) break;
      if ((film.next - 1) % stride == 0) frames.push_back(frame);
      if (go_on && !go_on(std::min(1.0, 1.0 * film.next / wanted))) return frames;
    }
    if (frames.size() >= std::min(kLeast, static_cast<std::size_t>(wanted) / 2)) break;
  }
  return frames;
}

FilmReader::FilmReader(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
FilmReader::FilmReader(FilmReader&&) noexcept = default;
FilmReader& FilmReader::operator=(FilmReader&&) noexcept = default;
FilmReader::~FilmReader() = default;
const FilmInfo& FilmReader::info() const noexcept { return impl_->info; }

}  // namespace vsprite
