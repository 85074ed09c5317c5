// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Colour is brought to 4:2:0 here, in integers (BT.601, limited range, chroma averaged over 2 x 2),
// so that the encoder's input does not depend on the build of ffmpeg's scaler.
#include "film_writer.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

extern char** environ;

namespace vsprite::capture {
namespace {

std::vector<std::string> arguments(const FilmSettings& s, const std::string& part) {
  char crf[32];
  std::snprintf(crf, sizeof crf, "%g", s.crf);
  const std::string size = std::to_string(s.width) + "x" + std::to_string(s.height);
  return {"ffmpeg",
          "-v",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "yuv420p",
          "-s",
          size,
          "-r",
          std::to_string(s.fps),
          "-color_range",
          "tv",
          "-colorspace",
          "smpte170m",
          "-i",
          "pipe:0",
          "-an",
          "-c:v",
          "libx264",
          "-preset",
          "slow",
          "-crf",
          crf,
          "-threads",
          "1",
          "-x264-params",
          "threads=1:lookahead-threads=1:aq-mode=1:aq-strength=0.6",
          "-color_range",
          "tv",
          "-colorspace",
          "smpte170m",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "iec61966-2-1",
          "-chroma_sample_location",
          "center",
          "-map_metadata",
          "-1",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "-movflags",
          "+faststart",
          "-f",
          "mp4",
          part};
}

void to_planes(const Image& image, std::vector<std::uint8_t>& out) {
  const auto w = static_cast<std::size_t>(image.width), h = static_cast<std::size_t>(image.height);
  out.resize(w * h + 2 * (w / 2) * (h / 2));
  for (std::size_t i = 0; i < w * h; ++i) {
    const std::uint8_t* p = image.rgba.data() + 4 * i;
    out[i] =
        static_cast<std::uint8_t>(16 + ((16829 * p[0] + 33039 * p[1] + 6416 * p[2] + 32768) >> 16));
  }
  std::uint8_t* cb = out.data() + w * h;
  std::uint8_t* cr = cb + (w / 2) * (h / 2);
  for (std::size_t y = 0; y < h; y += 2) {
    for (std::size_t x = 0; x < w; x += 2) {
      int sum[3];
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint8_t* p = image.rgba.data() + 4 * (y * w + x) + c;
        sum[c] = p[0] + p[4] + p[4 * w] + p[4 * w + 4];
      }
      constexpr int half = 128 << 18, round = 1 << 17;
      *cb++ = static_cast<std::uint8_t>(
          (half - 9714 * sum[0] - 19070 * sum[1] + 28784 * sum[2] + round) >> 18);
      *cr++ = static_cast<std::uint8_t>(
          (half + 28784 * sum[0] - 24103 * sum[1] - 4681 * sum[2] + round) >> 18);
    }
  }
}

}  // namespace

Result<FilmWriter> FilmWriter::open(const std::string& path, const FilmSettings& settings) {
  signal(SIGPIPE, SIG_IGN);  // a dead encoder is an error from write(), not our end
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    return Error{ErrorCode::CannotCreate, "pipe to ffmpeg: " + std::string(std::strerror(errno))};
  }
  std::vector<std::string> words = arguments(settings, path + ".part");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
  pid_t child = -1;
  const int failed = posix_spawnp(&child, "ffmpeg", &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  if (failed != 0) {
    close(ends[1]);
    return Error{ErrorCode::Unavailable,
                 "the program ffmpeg, which writes films, was not found: install it (apt install "
                 "ffmpeg) and run this again"};
  }
  return FilmWriter(path, settings, ends[1], child);
}

FilmWriter::FilmWriter(FilmWriter&& other) noexcept
    : path_(std::move(other.path_)),
      settings_(other.settings_),
      pipe_(std::exchange(other.pipe_, -1)),
      child_(std::exchange(other.child_, -1)),
      planes_(std::move(other.planes_)) {}

FilmWriter::~FilmWriter() {
  if (pipe_ >= 0) close(pipe_);
  if (child_ > 0) {
    waitpid(child_, nullptr, 0);
    unlink((path_ + ".part").c_str());
  }
}

Result<void> FilmWriter::write(const Image& image) {
  to_planes(image, planes_);
  for (std::size_t done = 0; done < planes_.size();) {
    const ssize_t n = ::write(pipe_, planes_.data() + done, planes_.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      return Error{
          ErrorCode::CannotWrite,
          path_ + ": ffmpeg stopped before the film was complete; its own message stands above"};
    }
    done += static_cast<std::size_t>(n);
  }
  return {};
}

Result<void> FilmWriter::finish() {
  close(std::exchange(pipe_, -1));
  int status = 0;
  waitpid(std::exchange(child_, -1), &status, 0);
  const std::string part = path_ + ".part";
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    unlink(part.c_str());
    return Error{ErrorCode::CannotWrite,
                 path_ + ": ffmpeg could not write the film; its own message stands above"};
  }
  if (std::rename(part.c_str(), path_.c_str()) != 0) {
    return Error{ErrorCode::CannotWrite, path_ + ": " + std::strerror(errno)};
  }
  return {};
}

}  // namespace vsprite::capture
