// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/path_film.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "tool/files.h"
#include "vsprite/compose.h"
#include "vsprite/record.h"
#include "vsprite/stream.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

/// Takes frames: a film, or numbered pictures.
class FrameSink {
 public:
  Result<void> open(const std::string& path, const PathPicture& picture, double fps) {
    std::error_code error;
    if (path.back() == '/' || fs::is_directory(path, error)) {
      folder_ = path;
      return make_folder(path);
    }
    return film_.open(path, picture.width, picture.height, fps);
  }
  Result<void> add(const Image& straight) {
    if (film_.is_open()) return film_.add(straight);
    char name[40];
    std::snprintf(name, sizeof name, "frame-%05zu.png", count_++);
    return save_png((fs::path(folder_) / name).string(), straight);
  }
  Result<void> close() { return film_.close(); }

 private:
  FilmWriter film_;
  std::string folder_;
  std::size_t count_ = 0;
};

bool has_ending(const std::string& path, const char* ending) {
  return fs::path(path).extension() == ending;
}

/// The ground of every frame, premultiplied.
Image ground(const std::string& path, const PathPicture& picture, const Image& backdrop) {
  if (backdrop.width > 0) {
    Image out = backdrop;
    premultiply(out);
    return out;
  }
  const std::uint8_t opaque = has_ending(path, ".mp4") ? 255 : 0;
  return make_image(picture.width, picture.height, 156, 196, 216, opaque);
}

bool is_full(const Image& image) {
  for (std::size_t a = 3; a < image.rgba.size(); a += 4)
    if (image.rgba[a] != 255) return false;
  return true;
}

void draw_tick(Image& canvas, const std::vector<FilmRole>& roles,
               std::vector<std::unique_ptr<FrameCache>>& caches, std::size_t tick, Vec2 origin) {
  std::vector<std::size_t> order;
  for (std::size_t r = 0; r < roles.size(); ++r)
    if (tick < roles[r].clip->ticks.size()) order.push_back(r);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return roles[a].clip->ticks[tick].position.y < roles[b].clip->ticks[tick].position.y;
  });
  for (const std::size_t r : order) {
    const ClipTick& t = roles[r].clip->ticks[tick];
    const Vec2 at = to_pixels(t.position);
    draw_sample(canvas, caches[r]->frame(t.sample), roles[r].sprite->samples()[t.sample],
                {at.x - origin.x, at.y - origin.y});
  }
}

}  // namespace

Result<void> write_path_film(const std::string& path, const std::vector<FilmRole>& roles,
                             const PathPicture& picture, const Image& backdrop,
                             const std::function<void(double)>& progress) {
  FrameSink sink;
  if (auto opened = sink.open(path, picture, roles[0].sprite->fps()); !opened) return opened;
  const Image empty = ground(path, picture, backdrop);
  const bool is_opaque = is_full(empty);
  std::vector<std::unique_ptr<FrameCache>> caches;
  std::size_t count = 0;
  for (const FilmRole& role : roles) {
    caches.push_back(std::make_unique<FrameCache>(*role.sprite));
    count = std::max(count, role.clip->ticks.size());
  }
  for (std::size_t tick = 0; tick < count; ++tick) {
    Image canvas = empty;
    draw_tick(canvas, roles, caches, tick, picture.origin);
    if (!is_opaque) unpremultiply(canvas);
    if (auto added = sink.add(canvas); !added) return added;
    if (progress) progress(static_cast<double>(tick + 1) / static_cast<double>(count));
  }
  return sink.close();
}

}  // namespace vsprite
