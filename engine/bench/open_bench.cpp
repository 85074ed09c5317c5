// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// From a file's name to its first picture on the screen (P6): load_pack, one picture decoded, drawn
// into memory by OpenGL until the driver is done. With the file in the system's cache, and thrown
// out of it before. With COPIES and OUT.vsp a large pack is written first: the film so many times
// over, each copy with its own transitions and tables.
//
//     open_bench goldfish.vsp                  opens it
//     open_bench goldfish.vsp 11 large.vsp     makes a pack of 1 GB, and opens that
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "vsprite/draw.h"
#include "vsprite/pack.h"
#include "vsprite/window.h"

namespace vsprite {
namespace {

constexpr int kWidth = 1280, kHeight = 720, kRounds = 9;

// Table by table: `values` (tables, N) so many times side by side.
template <class T, class Move>
std::vector<T> repeat(const std::vector<T>& values, std::size_t n, std::uint32_t copies,
                      const Move& move) {
  std::vector<T> out;
  out.reserve(values.size() * copies);
  for (std::size_t table = 0; table * n < values.size(); ++table)
    for (std::uint32_t c = 0; c < copies; ++c)
      for (std::size_t i = 0; i < n; ++i) out.push_back(move(values[table * n + i], c));
  return out;
}

SpriteData enlarge(const SpriteData& film, std::uint32_t copies) {
  const auto n = static_cast<std::uint32_t>(film.samples.size());
  const auto shift = [n](std::uint32_t sample, std::uint32_t c) {
    return sample == kNoSample ? sample : sample + c * n;
  };
  const auto same = [](auto value, std::uint32_t) { return value; };
  const std::uint32_t clips = film.samples.back().clip + 1;
  SpriteData out = film;
  out.samples = repeat(film.samples, n, copies, [&](Sample s, std::uint32_t c) {
    s.clip += c * clips;
    s.mirror_of = shift(s.mirror_of, c);
    return s;
  });
  out.row_start.assign(1, 0);
  out.transitions.clear();
  for (std::uint32_t c = 0; c < copies; ++c)
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t k = film.row_start[i]; k < film.row_start[i + 1]; ++k)
        out.transitions.push_back({shift(film.transitions[k].to, c), film.transitions[k].cost});
      out.row_start.push_back(static_cast<std::uint32_t>(out.transitions.size()));
    }
  for (ControlMode& mode : out.modes) {
    mode.next = repeat(mode.next, n, copies, shift);
    mode.go = repeat(mode.go, n, copies, same);
    mode.arrived = repeat(mode.arrived, n, copies, same);
  }
  out.actions.clear();
  out.events.clear();
  out.event_names.clear();
  return out;
}

Result<void> write_large(const Sprite& film, std::uint32_t copies, const std::string& path) {
  const auto n = static_cast<std::uint32_t>(film.samples().size());
  return save_pack(path, enlarge(film.data(), copies), [&](std::uint32_t i) -> Result<Image> {
    Image image;
    if (auto ok = film.decode_frame(i % n, image); !ok) return ok.error();
    unpremultiply(image);
    return image;
  });
}

double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

// Nothing of the file is in the system's cache any more.
bool forget_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY);
  if (file < 0) return false;
  const bool forgotten =
      ::fdatasync(file) == 0 && ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED) == 0;
  ::close(file);
  return forgotten;
}

Result<void> measure(Window& window, Renderer& renderer, const std::string& path, bool is_cold) {
  std::vector<double> opened, shown;
  for (int round = 0; round < kRounds; ++round) {
    if (is_cold && !forget_file(path)) return Error{ErrorCode::CannotRead, path + ": stays cached"};
    const auto begin = std::chrono::steady_clock::now();
    const auto sprite = load_pack(path);
    if (!sprite) return sprite.error();
    opened.push_back(since(begin));
    FrameCache frames(*sprite);
    const Actor actor = make_actor(*sprite, {640, 360});
    renderer.begin_frame(kWidth, kHeight);
    renderer.clear(srgb(0x9cc4d8));
    draw_actor(renderer, *sprite, frames, actor);
    renderer.end_frame();
    window.swap();
    renderer.wait();
    shown.push_back(since(begin));
    forget(renderer, *sprite);
  }
  std::sort(opened.begin(), opened.end());
  std::sort(shown.begin(), shown.end());
  std::printf(
      "%s: opened in %.1f ms (median %.1f), first picture on the screen after %.1f ms "
      "(median %.1f)\n",
      is_cold ? "out of the system's cache" : "in the system's cache", opened.front(),
      opened[kRounds / 2], shown.front(), shown[kRounds / 2]);
  return {};
}

Result<void> run(std::string path, int copies, const char* large) {
  if (large != nullptr) {
    const auto film = load_pack(path);
    if (!film) return film.error();
    if (auto wrote = write_large(*film, static_cast<std::uint32_t>(copies), large); !wrote)
      return wrote;
    path = large;
  }
  const auto info = read_pack_info(path);
  if (!info) return info.error();
  std::uint64_t pictures = 0;
  for (const PackSection& section : info->sections)
    if (section.name == "FRAM") pictures = section.bytes;
  Result<Window> window = Window::open({.width = kWidth, .height = kHeight, .headless = true});
  if (!window) return window.error();
  Result<Renderer> renderer = make_renderer(Window::gl_function);
  if (!renderer) return renderer.error();
  std::printf("%s: %.1f MB, %.1f of them tables, on %s\n", path.c_str(),
              static_cast<double>(info->bytes) / 1e6,
              static_cast<double>(info->bytes - pictures) / 1e6, renderer->device().c_str());
  for (const bool is_cold : {false, true})
    if (auto done = measure(*window, *renderer, path, is_cold); !done) return done;
  return {};
}

}  // namespace
}  // namespace vsprite

int main(int argc, char** argv) {
  const int copies = argc > 2 ? std::atoi(argv[2]) : 1;
  if ((argc != 2 && argc != 4) || copies < 1 || copies > 1000) {
    std::fprintf(stderr, "open_bench PACK [COPIES OUT.vsp]\n");
    return 2;
  }
  const auto done = vsprite::run(argv[1], copies, argc > 3 ? argv[3] : nullptr);
  if (done) return 0;
  std::fprintf(stderr, "open_bench: error: %s\n", done.error().message.c_str());
  return 3;
}
