// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The decoder child and the pipe to it. The child is forked, not executed: it needs no program of
// its own, and it ends with _exit, so that nothing of the parent's is torn down twice. Records on
// the pipe: one Hello, then a FrameHead and its pixels for each frame, then a FrameHead of kind
// End.
#include "film/video.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <optional>

#include "film/coded_size.h"

namespace vsprite {
namespace {

constexpr int kMaxSide = 16384;
constexpr int kHangMs = 30'000;
constexpr int kPipeBytes = 1 << 20;
constexpr rlim_t kChildBytes = rlim_t{4} << 30;  // beyond what the parent had mapped
constexpr int kExitNoMemory = 71;

// Containers in which people keep films. Without the list FFmpeg plays text files as ANSI art and
// follows play lists to other files.
constexpr char kCaptureOptions[] =
    "protocol_whitelist;file|format_whitelist;mov,mp4,m4a,3gp,3g2,mj2,matroska,webm,avi,mpegts,"
    "mpeg,"
    "mpegvideo,flv,ogg,asf,gif,yuv4mpegpipe,nut,h264,hevc,m4v,ivf,mxf,dv,rm,swf,obu,apng,webp_pipe";

enum class Kind : std::int32_t { Film, NoFilm, Frame, Resized, End, OutOfMemory };

struct Hello {
  Kind kind;
  std::int32_t width, height, count;
  double fps;
};

struct FrameHead {
  Kind kind;
  std::int32_t width, height;
};

// --- child ---------------------------------------------------------------------------------------

bool write_all(int fd, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = write(fd, at, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

void send_frame(int fd, const cv::Mat& image) {
  const FrameHead head{Kind::Frame, image.cols, image.rows};
  if (!write_all(fd, &head, sizeof head)) _exit(0);
  const std::size_t row = static_cast<std::size_t>(image.cols) * 3;
  if (image.isContinuous()) {
    if (!write_all(fd, image.data, row * static_cast<std::size_t>(image.rows))) _exit(0);
    return;
  }
  for (int y = 0; y < image.rows; ++y)
    if (!write_all(fd, image.ptr(y), row)) _exit(0);
}

// Leaves the child with nothing of the parent's but the pipe, and a bound on its memory.
void isolate(int& out, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);
  std::signal(SIGINT, SIG_IGN);  // the parent decides when work ends
  for (int s : {SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    std::signal(s, SIG_DFL);
  const int null = open("/dev/null", O_RDWR);
  for (int fd : {0, 1, 2}) dup2(null, fd);
  if (out != 3) dup2(out, 3);
  out = 3;
  close_range(4, ~0u, 0);
  rlimit limit{};
  rlim_t mapped = 0;
  if (std::FILE* statm = std::fopen("/proc/self/statm", "r")) {
    unsigned long pages = 0;
    if (std::fscanf(statm, "%lu", &pages) == 1)
      mapped = rlim_t{pages} * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
    std::fclose(statm);
  }
  limit.rlim_cur = limit.rlim_max = mapped + kChildBytes;
  setrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = limit.rlim_max = 0;
  setrlimit(RLIMIT_CORE, &limit);
}

// Reads the film's packets beside its frames, undecoded. Packet k is looked at before frame k is
// decoded: where the size changes the coding starts anew, so that k is the same for both.
class SizeWatch {
 public:
  explicit SizeWatch(const std::string& name) : packets_(name, cv::CAP_FFMPEG) {
    open_ = packets_.isOpened() && packets_.set(cv::CAP_PROP_FORMAT, -1);
  }
  /// The next packet's size where it differs from the first one's.
  std::optional<detail::CodedSize> changed() {
    if (!open_ || !packets_.read(packet_) || !packet_.isContinuous()) return std::nullopt;
    const auto size = detail::find_coded_size({packet_.data, packet_.total() * packet_.elemSize()});
    if (!size) return std::nullopt;
    if (!first_) first_ = size;
    return *size == *first_ ? std::nullopt : size;
  }

 private:
  cv::VideoCapture packets_;
  cv::Mat packet_;
  std::optional<detail::CodedSize> first_;
  bool open_ = false;
};

void decode(int out, const std::string& path) {
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 1);
  setenv("OPENCV_FFMPEG_CAPTURE_OPTIONS", kCaptureOptions, 1);
  cv::setNumThreads(1);
  // A name with a colon must not be taken for a protocol.
  const std::string name = path.front() == '/' ? path : "./" + path;
  cv::VideoCapture capture(name, cv::CAP_FFMPEG);
  cv::Mat image;
  if (!capture.isOpened() || !capture.read(image) || image.type() != CV_8UC3) {
    const Hello none{Kind::NoFilm, 0, 0, 0, 0};
    write_all(out, &none, sizeof none);
    return;
  }
  const double count = capture.get(cv::CAP_PROP_FRAME_COUNT);
  const bool sane = count >= 1 && count < 1e9;
  const Hello hello{Kind::Film, image.cols, image.rows, sane ? static_cast<int>(count) : 0,
                    capture.get(cv::CAP_PROP_FPS)};
  if (!write_all(out, &hello, sizeof hello)) return;
  SizeWatch watch(name);
  watch.changed();
  do {
    send_frame(out, image);
    if (const auto size = watch.changed()) {
      const FrameHead resized{Kind::Resized, size->width, size->height};
      write_all(out, &resized, sizeof resized);
      return;
    }
  } while (capture.read(image) && image.type() == CV_8UC3);
  const FrameHead end{Kind::End, 0, 0};
  write_all(out, &end, sizeof end);
}

[[noreturn]] void child_main(int out, pid_t parent, const std::string& path) {
  isolate(out, parent);
  int status = 0;
  try {
    decode(out, path);
  } catch (const std::bad_alloc&) {
    status = kExitNoMemory;
  } catch (const cv::Exception& e) {
    status = e.code == cv::Error::StsNoMem ? kExitNoMemory : 70;
  } catch (...) {
    status = 70;
  }
  _exit(status);
}

// --- parent --------------------------------------------------------------------------------------

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

}  // namespace

struct FilmReader::Impl {
  std::string path;
  FilmInfo info;
  int fd = -1;
  pid_t child = -1;
  int next = 0;        // index of the frame to come
  bool ended = false;  // all frames were handed out

  ~Impl() { stop(); }

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

  // Waits for the child's own end (the pipe is closed, so it is near), for the reason of its death.
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
    if (next < 0.98 * info.claimed_frames - 2)
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
    if (path.empty() || errno == ENOENT || errno == ENOTDIR)
      return Error{ErrorCode::NotFound, path + ": no such file; give the path of a film"};
    return Error{ErrorCode::CannotRead, path + ": cannot be read: " + std::strerror(errno)};
  }
  if (S_ISDIR(file.st_mode))
    return Error{ErrorCode::CannotRead, path + ": is a folder; give the path of a film"};
  if (access(path.c_str(), R_OK) != 0)
    return Error{ErrorCode::CannotRead, path + ": cannot be read: " + std::strerror(errno)};
  return {};
}

}  // namespace

Result<FilmReader> FilmReader::open(const std::string& path) {
  if (auto checked = check_file(path); !checked) return checked.error();
  auto impl = std::make_unique<Impl>();
  impl->path = path;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    return Error{ErrorCode::CannotRead, path + ": no pipe to a decoder: " + std::strerror(errno)};
  fcntl(ends[1], F_SETPIPE_SZ, kPipeBytes);  // a refusal costs speed only
  const pid_t parent = getpid();
  impl->child = fork();
  if (impl->child == 0) child_main(ends[1], parent, path);
  close(ends[1]);
  impl->fd = ends[0];
  if (impl->child < 0)
    return Error{ErrorCode::CannotRead, path + ": no decoder process: " + std::strerror(errno)};

  Hello hello{};
  if (const Pulled how = impl->pull(&hello, sizeof hello); how != Pulled::All)
    return impl->failure(how);
  if (hello.kind != Kind::Film)
    return Error{ErrorCode::BadFormat,
                 path + ": no film: not one frame can be decoded; due: a video file such as MP4"};
  if (hello.width < 1 || hello.height < 1 || hello.width > kMaxSide || hello.height > kMaxSide)
    return Error{ErrorCode::LimitExceeded, path + ": frames of " + std::to_string(hello.width) +
                                               " x " + std::to_string(hello.height) +
                                               " px; due: at most " + std::to_string(kMaxSide) +
                                               " px a side"};
  impl->info.width = hello.width;
  impl->info.height = hello.height;
  impl->info.claimed_frames = hello.count;
  set_rate(hello.fps, impl->info);
  return FilmReader(std::move(impl));
}

Result<bool> FilmReader::read(Frame& frame) {
  Impl& film = *impl_;
  if (film.ended || film.fd < 0) return false;
  FrameHead head{};
  if (const Pulled how = film.pull(&head, sizeof head); how != Pulled::All)
    return film.failure(how);
  if (head.kind == Kind::End) return film.finish();
  if (head.kind == Kind::Resized || head.width != film.info.width ||
      head.height != film.info.height) {
    film.stop();
    return Error{ErrorCode::CorruptData,
                 film.path + ": frame " + std::to_string(film.next) + " is " +
                     std::to_string(head.width) + " x " + std::to_string(head.height) +
                     " px, the first " + std::to_string(film.info.width) + " x " +
                     std::to_string(film.info.height) +
                     "; due: one size throughout; cut the film where the size changes"};
  }
  const std::size_t bytes =
      static_cast<std::size_t>(head.width) * static_cast<std::size_t>(head.height) * 3;
  try {
    frame.bgr.resize(bytes);
  } catch (const std::bad_alloc&) {
    film.stop();
    return Error{ErrorCode::OutOfMemory, film.path + ": a frame of " + std::to_string(bytes) +
                                             " bytes does not fit in memory"};
  }
  if (const Pulled how = film.pull(frame.bgr.data(), bytes); how != Pulled::All)
    return film.failure(how);
  frame.width = head.width;
  frame.height = head.height;
  frame.index = film.next++;
  return true;
}

FilmReader::FilmReader(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
FilmReader::FilmReader(FilmReader&&) noexcept = default;
FilmReader& FilmReader::operator=(FilmReader&&) noexcept = default;
FilmReader::~FilmReader() = default;
const FilmInfo& FilmReader::info() const noexcept { return impl_->info; }

}  // namespace vsprite
