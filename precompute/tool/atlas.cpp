// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Shelves: the tallest first, one beside the other, then the next row, then the next page.
#include "tool/atlas.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numeric>

#include "vsprite/compose.h"
#include "vsprite/record.h"

namespace vsprite {

Result<Atlas> arrange_atlas(const std::string& name, const std::vector<Sample>& samples) {
  Atlas atlas;
  atlas.places.resize(samples.size());
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return samples[a].height > samples[b].height;
  });
  int x = kAtlasGap, y = kAtlasGap, shelf = 0;
  atlas.pages.push_back({});
  for (const std::size_t i : order) {
    const int width = samples[i].width, height = samples[i].height;
    if (width + 2 * kAtlasGap > kAtlasSide || height + 2 * kAtlasGap > kAtlasSide)
      return Error{ErrorCode::LimitExceeded,
                   name + ": a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                       " px, a page holds " + std::to_string(kAtlasSide - 2 * kAtlasGap) +
                       ": build it with a smaller --max-size"};
    if (x + width + kAtlasGap > kAtlasSide) x = kAtlasGap, y += shelf + kAtlasGap, shelf = 0;
    if (y + height + kAtlasGap > kAtlasSide) {
      atlas.pages.push_back({});
      x = y = kAtlasGap, shelf = 0;
    }
    atlas.places[i] = {static_cast<int>(atlas.pages.size()) - 1, x, y};
    x += width + kAtlasGap;
    shelf = std::max(shelf, height);
    atlas.pages.back().width = std::max(atlas.pages.back().width, x);
    atlas.pages.back().height = std::max(atlas.pages.back().height, y + height + kAtlasGap);
  }
  return atlas;
}

std::string numbered_png(const char* stem, std::size_t number, int digits) {
  char name[64];
  std::snprintf(name, sizeof name, "%s-%0*zu.png", stem, digits, number);
  return name;
}

Result<Image> straight_picture(const Sprite& film, std::uint32_t sample) {
  Image image;
  if (auto ok = film.decode_frame(sample, image); !ok) return ok.error();
  unpremultiply(image);
  return image;
}

void put_picture(Image& canvas, const Image& picture, int left, int top) {
  for (int row = 0; row < picture.height; ++row)
    std::copy_n(picture.rgba.begin() + std::ptrdiff_t{4} * row * picture.width, 4 * picture.width,
                canvas.rgba.begin() +
                    std::ptrdiff_t{4} * (std::ptrdiff_t{top + row} * canvas.width + left));
}

Result<void> write_atlas(const Sprite& film, const std::vector<std::uint32_t>& from,
                         const Atlas& atlas, const std::string& folder,
                         const std::function<void(double)>& progress) {
  std::size_t done = 0;
  for (std::size_t p = 0; p < atlas.pages.size(); ++p) {
    const AtlasPage& page = atlas.pages[p];
    Image canvas = make_image(page.width, page.height, 0, 0, 0, 0);
    for (std::size_t k = 0; k < atlas.places.size(); ++k) {
      const AtlasPlace& at = atlas.places[k];
      if (static_cast<std::size_t>(at.page) != p) continue;
      const auto picture = straight_picture(film, from[k]);
      if (!picture) return picture.error();
      put_picture(canvas, *picture, at.x, at.y);
      if (progress)
        progress(static_cast<double>(++done) / static_cast<double>(atlas.places.size()));
    }
    const auto path = std::filesystem::path(folder) / numbered_png("page", p);
    if (auto saved = save_png(path.string(), canvas); !saved) return saved;
  }
  return {};
}

}  // namespace vsprite
