// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// atlas.h - where cached pictures lie on the texture pages. Knows no GPU.
//
// A page is filled shelf by shelf. When no page has room and the budget is spent, the page that
// went unused longest is emptied: a film plays on, so its pictures leave together as they came.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "vsprite/draw.h"
#include "vsprite/geometry.h"

namespace vsprite::detail {

struct KeyHash {
  std::size_t operator()(const TextureKey& key) const noexcept {
    return std::size_t(
        (key.sprite ^ (std::uint64_t{key.sample} << 32 | (key.sample + key.variant))) *
        0x9E3779B97F4A7C15u);
  }
};

/// What the texels of a page are.
enum class PageForm : std::uint8_t {
  Halves,  ///< four half floats
  Blocks   ///< BC3; pictures lie at multiples of 4
};
constexpr std::size_t texel_bytes(PageForm form) { return form == PageForm::Halves ? 8 : 1; }

/// A box without its corners, texels of a picture.
struct Octagon {
  float left = 0, top = 0, right = 0, bottom = 0;
  std::array<float, 4> cuts{};  ///< along either side, clockwise from the top left
};

struct AtlasSlot {
  int page = 0;
  Rect rect;
  Octagon outline{};  ///< beyond it the picture is clear
  Octagon core{};     ///< in it everything is opaque; empty: nothing is known
};

class Atlas {
 public:
  Atlas(int page_side, int max_side, std::size_t budget)
      : page_side_(page_side), max_side_(max_side), budget_(budget) {}

  /// Counts as a use of its page.
  std::optional<AtlasSlot> find(const TextureKey& key) noexcept;
  void set_shape(const TextureKey& key, const Octagon& outline, const Octagon& core) {
    slots_[key].outline = outline;
    slots_[key].core = core;
  }
  bool has(const TextureKey& key) const noexcept { return slots_.count(key) != 0; }

  /// What became of the page of a new slot.
  enum class Page { Same, New, Emptied };
  struct Placed {
    AtlasSlot slot;
    Page page = Page::Same;
  };
  /// Nothing if the picture is larger than any page can be.
  std::optional<Placed> insert(const TextureKey& key, int width, int height,
                               PageForm form = PageForm::Halves);
  void forget(std::uint64_t sprite);

  int page_width(int page) const noexcept { return pages_[static_cast<std::size_t>(page)].width; }
  int page_height(int page) const noexcept { return pages_[static_cast<std::size_t>(page)].height; }
  std::size_t bytes() const noexcept { return bytes_; }

 private:
  struct Shelf {
    int y = 0, height = 0, used = 0;
  };
  struct PageState {
    int width = 0, height = 0, filled = 0;
    PageForm form = PageForm::Halves;
    std::uint64_t last_use = 0;
    std::vector<Shelf> shelves;
    std::vector<TextureKey> keys;

    std::size_t bytes() const {
      return std::size_t(width) * std::size_t(height) * texel_bytes(form);
    }
  };
  std::optional<Rect> place(PageState& page, int width, int height);

  int page_side_, max_side_;
  std::size_t budget_, bytes_ = 0;
  std::uint64_t clock_ = 0;
  std::vector<PageState> pages_;
  std::unordered_map<TextureKey, AtlasSlot, KeyHash> slots_;
};

}  // namespace vsprite::detail
