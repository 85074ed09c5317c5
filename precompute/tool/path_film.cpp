// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/path_film.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "film/color.h"
#include "tool/files.h"
#include "vsprite/compose.h"
#include "vsprite/record.h"
#include "vsprite/stream.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

/// Takes frames: a film, or numbered pictures. Leaves nothing behind unless it is closed.
class FrameSink {
 public:
  FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;
  ~FrameSink() {
    std::error_code error;
    for (std::size_t k = 0; k < count_; ++k) fs::remove(picture_path(k), error);
    if (made_folder_) fs::remove(folder_, error);  // only if it is empty
  }
  Result<void> open(const std::string& path, const PathPicture& picture, double fps) {
    std::error_code error;
    if (path.back() == '/' || fs::is_directory(path, error)) {
      folder_ = path;
      made_folder_ = !fs::exists(path, error);
      return make_folder(path);
    }
    return film_.open(path, picture.width, picture.height, fps);
  }
  Result<void> add(const Image& straight) {
    if (film_.is_open()) return film_.add(straight);
    return save_png(picture_path(count_++), straight);
  }
  Result<void> close() {
    count_ = 0;
    made_folder_ = false;
    return film_.is_open() ? film_.close() : Result<void>{};
  }

 private:
  std::string picture_path(std::size_t k) const {
    char name[40];
    std::snprintf(name, sizeof name, "frame-%05zu.png", k);
    return (fs::path(folder_) / name).string();
  }
  FilmWriter film_;
  std::string folder_;
  bool made_folder_ = false;
  std::size_t count_ = 0;
};

bool has_ending(const std::string& path, const char* ending) {
  return fs::path(path).extension() == ending;
}

/// Hands out the ground of every frame, premultiplied.
class BackdropFrames {
 public:
  BackdropFrames(const std::string& path, const PathPicture& picture, const Backdrop& backdrop,
                 double fps)
      : backdrop_(backdrop), fps_(fps) {
    if (!backdrop.film.empty()) return;
    still_ = backdrop.still;
    premultiply(still_);
    if (!backdrop.is_empty()) return;
    const std::uint8_t opaque = has_ending(path, ".mp4") ? 255 : 0;
    still_ = make_image(picture.width, picture.height, 156, 196, 216, opaque);
  }
  Image at(std::size_t tick) const {
    if (backdrop_.film.empty()) return still_;
    const double frame = std::floor(static_cast<double>(tick) * backdrop_.fps / fps_ + 1e-6);
    return to_image(backdrop_.film[static_cast<std::size_t>(frame) % backdrop_.film.size()]);
  }

 private:
  const Backdrop& backdrop_;
  double fps_;
  Image still_;
};

bool is_full(const Image& image) {
  for (std::size_t a = 3; a < image.rgba.size(); a += 4)
    if (image.rgba[a] != 255) return false;
  return true;
}

void draw_tick(Image& canvas, const std::vector<FilmRole>& roles,
               std::vector<std::unique_ptr<FrameCache>>& caches, std::size_t tick,
               const PathPicture& picture) {
  std::vector<std::size_t> order;
  for (std::size_t r = 0; r < roles.size(); ++r)
    if (tick < roles[r].clip->ticks.size()) order.push_back(r);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return roles[a].clip->ticks[tick].position.y < roles[b].clip->ticks[tick].position.y;
  });
  // Shadows lie on the ground: none falls on a sprite.
  for (const bool is_shadow : {true, false})
    for (const std::size_t r : order) {
      const ClipTick& t = roles[r].clip->ticks[tick];
      const Sprite& sprite = *roles[r].sprite;
      const Vec2 place = picture.place(t.position);
      const Vec2 at{place.x - picture.origin.x, place.y - picture.origin.y};
      const DrawOptions options{.scale = picture.scale(t.position)};
      if (is_shadow)
        draw_shadow(canvas, sprite, t.sample, at, options);
      else
        draw_sample(canvas, caches[r]->frame(t.sample), sprite.samples()[t.sample], at, options);
    }
}

}  // namespace

Result<Backdrop> read_backdrop(const std::string& path) {
  Backdrop out;
  if (has_ending(path, ".png")) {
    auto image = read_png(path);
    if (!image) return image.error();
    out.still = std::move(*image);
    return out;
  }
  auto reader = FilmReader::open(path);
  if (!reader) return reader.error();
  const FilmInfo& info = reader->info();
  out.fps = static_cast<double>(info.fps_numerator) / info.fps_denominator;
  constexpr std::size_t kMost = std::size_t{3} << 29;
  for (std::size_t bytes = 0;;) {
    Frame frame;
    const auto more = reader->read(frame);
    if (!more) return more.error();
    if (!*more) break;
    bytes += frame.y.size() + frame.cb.size() + frame.cr.size();
    if (bytes > kMost)
      return Error{ErrorCode::LimitExceeded,
                   path + ": more than 1.5 GB of frames: a shorter or smaller film is due"};
    out.film.push_back(std::move(frame));
  }
  if (out.film.empty()) return Error{ErrorCode::BadContent, path + ": a film without a frame"};
  return out;
}

Result<void> write_path_film(const std::string& path, const std::vector<FilmRole>& roles,
                             const PathPicture& picture, const Backdrop& backdrop,
                             const std::function<void(double)>& progress,
                             const std::function<bool()>& go_on) {
  FrameSink sink;
  const double fps = roles[0].sprite->fps();
  if (auto opened = sink.open(path, picture, fps); !opened) return opened;
  const BackdropFrames ground(path, picture, backdrop, fps);
  std::vector<std::unique_ptr<FrameCache>> caches;
  std::size_t count = 0;
  for (const FilmRole& role : roles) {
    caches.push_back(std::make_unique<FrameCache>(*role.sprite));
    count = std::max(count, role.clip->ticks.size());
  }
  const auto stopped = [&] { return go_on && !go_on(); };
  const Error interrupted{ErrorCode::Interrupted, path + ": interrupted, nothing is written"};
  for (std::size_t tick = 0; tick < count; ++tick) {
    if (stopped()) return interrupted;
    Image canvas = ground.at(tick);
    draw_tick(canvas, roles, caches, tick, picture);
    if (!is_full(canvas)) unpremultiply(canvas);
    if (auto added = sink.add(canvas); !added) return stopped() ? interrupted : added;
    if (progress) progress(static_cast<double>(tick + 1) / static_cast<double>(count));
  }
  if (auto closed = sink.close(); !closed) return stopped() ? interrupted : closed;
  return {};
}

}  // namespace vsprite
