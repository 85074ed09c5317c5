// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Frames to the `ffmpeg` program through a pipe; its own words, kept in a temporary file, explain a
// failure.
#include "vsprite/record.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

extern char** environ;

namespace vsprite {
namespace {

/// Does `program` stand in a folder of PATH?
bool is_on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string_view rest = path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
  while (!rest.empty()) {
    const std::size_t end = rest.find(':');
    const std::string file = std::string(rest.substr(0, end)) + "/" + program;
    struct stat info {};
    if (::stat(file.c_str(), &info) == 0 && S_ISREG(info.st_mode) &&
        ::access(file.c_str(), X_OK) == 0) {
      return true;
    }
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  return false;
}

/// While alive, writing to a pipe whose reader has gone is an error, not the end of the process:
/// SIGPIPE is blocked in this thread, and one that came in between is taken away.
class PipeGuard {
 public:
  PipeGuard() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~PipeGuard() {
    if (!was_pending_) {
      const timespec now{};
      while (sigtimedwait(&pipe_, nullptr, &now) == -1 && errno == EINTR) {
      }
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  PipeGuard(const PipeGuard&) = delete;
  PipeGuard& operator=(const PipeGuard&) = delete;

 private:
  sigset_t pipe_{}, before_{};
  bool was_pending_ = false;
};

bool write_all(int file, const std::uint8_t* data, std::size_t size) {
  while (size > 0) {
    const ssize_t done = ::write(file, data, size);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    data += done;
    size -= static_cast<std::size_t>(done);
  }
  return true;
}

/// The last line of a log that says something.
std::string last_line(const std::string& path) {
  std::string text(4096, '\0');
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return {};
  const off_t size = ::lseek(file, 0, SEEK_END);
  const off_t from = size > 4096 ? size - 4096 : 0;
  const ssize_t got = ::pread(file, text.data(), text.size(), from);
  ::close(file);
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == '.')) {
    text.pop_back();
  }
  const std::size_t line = text.rfind('\n');
  return line == std::string::npos ? text : text.substr(line + 1);
}

/// Beside `path`, so that it can be renamed, and of this process alone.
std::string beside(const std::string& path, const char* ending) {
  return path + "." + std::to_string(::getpid()) + ending;
}

bool ends_with(const std::string& text, std::string_view ending) {
  return text.size() >= ending.size() &&
         text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

/// What a film's ending stands for: ffmpeg's words for it.
struct FilmKind {
  std::string_view ending;
  bool has_alpha;
  bool halves_colour;  ///< one colour for four pixels: clear ones must not be black
  bool cuts_alpha;     ///< a pixel is opaque or clear
  std::vector<std::string> words;
};

std::optional<FilmKind> kind_of(const std::string& path) {
  // A GIF has 256 colours, one of them clear: the palette is that of the whole film, and not
  // dithered, since dots that change with every frame are seen more than a step between two shades.
  // (-gifflags 0: ffmpeg 5.1's own savings lose opaque pixels of films with clear ones.)
  const FilmKind kinds[] = {{".mp4",
                             false,
                             false,
                             false,
                             {"-c:v", "libx264", "-preset", "veryfast", "-crf", "16", "-pix_fmt",
                              "yuv420p", "-movflags", "+faststart", "-f", "mp4"}},
                            {".mkv",
                             true,
                             false,
                             false,
                             {"-c:v", "ffv1", "-level", "3", "-pix_fmt", "bgra", "-f", "matroska"}},
                            {".webm",
                             true,
                             true,
                             false,
                             {"-c:v", "libvpx-vp9", "-pix_fmt", "yuva420p", "-crf", "18", "-b:v",
                              "0", "-auto-alt-ref", "0", "-cpu-used", "3", "-f", "webm"}},
                            {".apng",
                             true,
                             false,
                             false,
                             {"-c:v", "apng", "-pix_fmt", "rgba", "-plays", "0", "-f", "apng"}},
                            {".gif",
                             true,
                             false,
                             true,
                             {"-filter_complex",
                              "split[a][b];[a]palettegen=reserve_transparent=1[p];"
                              "[b][p]paletteuse=dither=none:alpha_threshold=128",
                              "-gifflags", "0", "-loop", "0", "-f", "gif"}}};
  for (const FilmKind& kind : kinds)
    if (ends_with(path, kind.ending)) return kind;
  return {};
}

/// Gives clear pixels of straight-alpha rows the colour of the nearest one in their row, and rows
/// without one that of the row before: what is coded for several pixels at once then has the
/// colour of those that are seen.
void spread_colours(std::vector<std::uint8_t>& rgba, int width) {
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(width);
  const auto fill_row = [&](std::uint8_t* p) {
    const std::uint8_t* last = nullptr;
    for (std::size_t x = 0, from = 0; x <= row; x += 4) {
      if (x < row && p[x + 3] == 0) continue;
      for (std::size_t k = from; k < x; k += 4) {  // a clear stretch [from, x)
        const bool left = last != nullptr && (x == row || k - from < x - k);
        if (!left && x == row) return false;
        std::memcpy(p + k, left ? last : p + x, 3);
      }
      if (x < row) last = p + x;
      from = x + 4;
    }
    return true;
  };
  const std::size_t rows = rgba.size() / row;
  std::size_t first = rows;  // that has a colour
  for (std::size_t y = 0; y < rows; ++y) {
    if (fill_row(rgba.data() + y * row)) {
      first = std::min(first, y);
    } else if (first < rows) {
      for (std::size_t x = 0; x < row; x += 4)
        std::memcpy(rgba.data() + y * row + x, rgba.data() + (y - 1) * row + x, 3);
    }
  }
  for (std::size_t y = 0; first < rows && y < first; ++y)
    for (std::size_t x = 0; x < row; x += 4)
      std::memcpy(rgba.data() + y * row + x, rgba.data() + first * row + x, 3);
}

Error system_error(ErrorCode code, const std::string& path, const char* what) {
  return {code, path + ": " + what + ": " + std::strerror(errno)};
}

}  // namespace

struct FilmWriter::Impl {
  std::string path, part, log;
  FilmKind kind;
  int width = 0, height = 0, channels = 3, pipe = -1;
  pid_t child = -1;
  std::vector<std::uint8_t> row_bytes;

  ~Impl() { abandon(); }
  Result<void> start(double fps);
  int wait_for_child();
  void abandon();
  Error failed(const std::string& what) const {
    const std::string words = last_line(log);
    return {ErrorCode::CannotWrite,
            path + ": " + what + (words.empty() ? std::string() : ": " + words)};
  }
};

Result<void> FilmWriter::Impl::start(double fps) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    return system_error(ErrorCode::CannotCreate, path, "no pipe to ffmpeg");
  }
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  char rate[32];
  std::snprintf(rate, sizeof rate, "%.6f", fps);
  std::vector<std::string> words = {"ffmpeg",   "-nostdin", "-loglevel",
                                    "error",    "-y",       "-f",
                                    "rawvideo", "-pix_fmt", channels == 4 ? "rgba" : "rgb24",
                                    "-s",       size,       "-r",
                                    rate,       "-i",       "pipe:0",
                                    "-an"};
  words.insert(words.end(), kind.words.begin(), kind.words.end());
  for (const char* word : {"-fflags", "+bitexact", "-flags:v", "+bitexact"}) words.push_back(word);
  words.push_back(part);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
#ifdef __EMSCRIPTEN__
  const int failure = ENOSYS;  // a browser starts no programs
#else
  const int failure = ::posix_spawnp(&child, "ffmpeg", &actions, nullptr, argv.data(), environ);
#endif
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[0]);
  if (failure != 0) {
    ::close(ends[1]);
    child = -1;
    errno = failure;
    return system_error(ErrorCode::CannotCreate, path, "ffmpeg could not be started");
  }
  pipe = ends[1];
  return {};
}

int FilmWriter::Impl::wait_for_child() {
  if (pipe >= 0) ::close(std::exchange(pipe, -1));
  int status = -1;
  if (child > 0) {
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  }
  child = -1;
  return status;
}

void FilmWriter::Impl::abandon() {
  if (child > 0) {
    ::kill(child, SIGKILL);
    wait_for_child();
  }
  if (!part.empty()) ::unlink(part.c_str());
  if (!log.empty()) ::unlink(log.c_str());
}

FilmWriter::FilmWriter() noexcept = default;
FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;
FilmWriter& FilmWriter::operator=(FilmWriter&&) noexcept = default;
FilmWriter::~FilmWriter() = default;
bool FilmWriter::is_open() const noexcept { return impl_ != nullptr; }

Result<void> FilmWriter::open(const std::string& path, int width, int height, double fps) {
  impl_.reset();
  if (width < 2 || height < 2 || !(fps > 0)) {
    return Error{ErrorCode::BadSetting, path + ": a film of " + std::to_string(width) + " x " +
                                            std::to_string(height) + " at " + std::to_string(fps) +
                                            " frames/s: 2 x 2 and more than 0 are due"};
  }
  if (!is_on_path("ffmpeg")) {
    return Error{ErrorCode::Unavailable,
                 path +
                     ": writing a film needs the program ffmpeg, which is not on the PATH: "
                     "install it (apt install ffmpeg), or record to a .png"};
  }
  auto impl = std::make_unique<Impl>();
  impl->path = path;
  auto kind = kind_of(path);
  impl->kind = kind ? std::move(*kind) : *kind_of(".mp4");
  impl->channels = impl->kind.has_alpha ? 4 : 3;
  impl->width = impl->kind.has_alpha ? width : width & ~1;
  impl->height = impl->kind.has_alpha ? height : height & ~1;
  const std::string part = beside(path, ".part");
  const int trial = ::open(part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (trial < 0) return system_error(ErrorCode::CannotCreate, path, "cannot create the film");
  ::close(trial);
  impl->part = part;
  impl->log = beside(path, ".log");
  if (auto started = impl->start(fps); !started) return started;
  impl_ = std::move(impl);
  return {};
}

Result<void> FilmWriter::add(ImageView frame) {
  Impl& m = *impl_;
  if (m.pipe < 0) return m.failed("ffmpeg stopped early");
  m.row_bytes.resize(std::size_t(m.width) * std::size_t(m.height) * std::size_t(m.channels));
  std::uint8_t* out = m.row_bytes.data();
  for (int y = 0; y < m.height; ++y) {
    const std::uint8_t* in = frame.pixel(0, y);
    for (int x = 0; x < m.width; ++x, in += 4, out += m.channels)
      std::memcpy(out, in, static_cast<std::size_t>(m.channels));
  }
  if (m.kind.cuts_alpha)
    for (std::size_t a = 3; a < m.row_bytes.size(); a += 4)
      m.row_bytes[a] = m.row_bytes[a] < 128 ? 0 : 255;
  if (m.kind.halves_colour) spread_colours(m.row_bytes, m.width);
  const PipeGuard guard;
  if (write_all(m.pipe, m.row_bytes.data(), m.row_bytes.size())) return {};
  m.wait_for_child();
  return m.failed("ffmpeg stopped early");
}

Result<void> FilmWriter::close() {
  if (!impl_) return {};
  const std::unique_ptr<Impl> m = std::move(impl_);
  const int status = m->wait_for_child();
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return m->failed("ffmpeg failed");
  if (::rename(m->part.c_str(), m->path.c_str()) != 0) {
    return system_error(ErrorCode::CannotWrite, m->path, "cannot rename the finished film");
  }
  return {};
}

Result<void> save_png(const std::string& path, ImageView image) {
  Result<std::vector<std::uint8_t>> bytes = encode_png(image);
  if (!bytes) return std::move(bytes).error();
  const std::string part = beside(path, ".part");
  const int file = ::open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) return system_error(ErrorCode::CannotCreate, path, "cannot create the picture");
  const bool written = write_all(file, bytes->data(), bytes->size());
  if ((::close(file) != 0) | !written || ::rename(part.c_str(), path.c_str()) != 0) {
    Error error = system_error(ErrorCode::CannotWrite, path, "cannot write the picture");
    ::unlink(part.c_str());
    return error;
  }
  return {};
}

Result<Recorder> Recorder::open(const std::string& path, int width, int height, double fps) {
  Recorder recorder;
  if (ends_with(path, ".mp4")) {
    if (auto opened = recorder.film_.open(path, width, height, fps); !opened) {
      return std::move(opened).error();
    }
  } else if (!path.empty() && !ends_with(path, ".png")) {
    return Error{ErrorCode::BadSetting,
                 "--record " + path + ": the name of a .mp4 (film) or .png (last frame) is due"};
  }
  recorder.path_ = path;
  return recorder;
}

Result<void> Recorder::add(Image frame) {
  if (film_.is_open()) return film_.add(frame);
  last_ = std::move(frame);
  return {};
}

Result<void> Recorder::close() {
  if (film_.is_open()) return film_.close();
  if (path_.empty() || last_.width == 0) return {};
  return save_png(path_, last_);
}

}  // namespace vsprite
