// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/atlas.h - pictures of a pack side by side on pages that any engine takes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "vsprite/image.h"
#include "vsprite/sprite.h"

namespace vsprite {

inline constexpr int kAtlasSide = 2048;  ///< px, of a page at most
inline constexpr int kAtlasGap = 1;      ///< px around a picture: a filter finds no neighbour

struct AtlasPlace {
  int page = 0, x = 0, y = 0;
};
struct AtlasPage {
  int width = 0, height = 0;
};
struct Atlas {
  std::vector<AtlasPlace> places;  ///< (n)
  std::vector<AtlasPage> pages;
};

/// Shelves, the tallest pictures first. Errors: LimitExceeded (a picture larger than a page).
Result<Atlas> arrange_atlas(const std::string& name, const std::vector<Sample>& samples);

/// A picture of the pack with straight alpha. Errors: those of decode_frame.
Result<Image> straight_picture(const Sprite& film, std::uint32_t sample);

/// Copies a picture's pixels into a canvas that holds it whole; nothing is mixed.
void put_picture(Image& canvas, const Image& picture, int left, int top);

/// Writes page-0.png, page-1.png ... into `folder`. `from`: (n) the pack's sample of each place.
/// Errors: CannotCreate, CannotWrite, those of decode_frame.
Result<void> write_atlas(const Sprite& film, const std::vector<std::uint32_t>& from,
                         const Atlas& atlas, const std::string& folder,
                         const std::function<void(double)>& progress);

/// "page-0.png"; "sample-000012.png" with six digits.
std::string numbered_png(const char* stem, std::size_t number, int digits = 1);

}  // namespace vsprite
