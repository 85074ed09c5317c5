// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Shelf packing with page-wise least-recently-used eviction.
#include "atlas.h"

#include <algorithm>
#include <utility>

namespace vsprite::detail {

std::optional<AtlasSlot> Atlas::find(const TextureKey& key) noexcept {
  const auto found = slots_.find(key);
  if (found == slots_.end()) return std::nullopt;
  pages_[static_cast<std::size_t>(found->second.page)].last_use = ++clock_;
  return found->second;
}

std::optional<Rect> Atlas::place(PageState& page, int width, int height) {
  if (width > page.width) return std::nullopt;
  Shelf* best = nullptr;  // the lowest shelf that is high enough wastes least
  for (Shelf& shelf : page.shelves) {
    const bool fits = shelf.height >= height && page.width - shelf.used >= width;
    if (fits && (best == nullptr || shelf.height < best->height)) best = &shelf;
  }
  const bool wasteful = best != nullptr && best->height > height + height / 2 + 8;
  if ((best == nullptr || wasteful) && page.height - page.filled >= height) {
    page.shelves.push_back({page.filled, height, 0});
    page.filled += height;
    best = &page.shelves.back();
  }
  if (best == nullptr) return std::nullopt;
  const Rect rect{best->used, best->y, width, height};
  best->used += width;
  return rect;
}

std::optional<Atlas::Placed> Atlas::insert(const TextureKey& key, int width, int height,
                                           PageForm form) {
  const int inner_width = width, inner_height = height;
  if (form == PageForm::Blocks) {
    width = (width + 3) / 4 * 4;
    height = (height + 3) / 4 * 4;
  }
  if (width > max_side_ || height > max_side_) return std::nullopt;
  const auto enter = [&](std::size_t index, const Rect& rect, Page page) {
    pages_[index].last_use = ++clock_;
    pages_[index].keys.push_back(key);
    const AtlasSlot slot{static_cast<int>(index), {rect.x, rect.y, inner_width, inner_height}};
    slots_[key] = slot;
    return Placed{slot, page};
  };
  for (std::size_t i = pages_.size(); i-- > 0;) {
    if (pages_[i].form != form) continue;
    if (const auto rect = place(pages_[i], width, height)) return enter(i, *rect, Page::Same);
  }
  const int page_width = std::max(page_side_, width);
  const int page_height = std::max(page_side_, height);
  PageState fresh;
  fresh.width = page_width;
  fresh.height = page_height;
  fresh.form = form;
  if (pages_.size() < 2 || bytes_ + fresh.bytes() <= budget_) {
    bytes_ += fresh.bytes();
    pages_.push_back(std::move(fresh));
    return enter(pages_.size() - 1, *place(pages_.back(), width, height), Page::New);
  }
  // The oldest page goes; one that is too small or of the other form is made anew.
  // One whose place the budget has room for comes first.
  const auto rank = [&](const PageState& page) {
    return std::pair(bytes_ - page.bytes() + fresh.bytes() > budget_, page.last_use);
  };
  std::size_t oldest = 0;
  for (std::size_t i = 1; i < pages_.size(); ++i) {
    if (rank(pages_[i]) < rank(pages_[oldest])) oldest = i;
  }
  PageState& page = pages_[oldest];
  for (const TextureKey& gone : page.keys) {
    const auto found = slots_.find(gone);
    if (found != slots_.end() && found->second.page == static_cast<int>(oldest))
      slots_.erase(found);
  }
  page.keys.clear();
  page.shelves.clear();
  page.filled = 0;
  Page what = Page::Emptied;
  if (page.width < width || page.height < height || page.form != form) {
    bytes_ += fresh.bytes() - page.bytes();
    page.width = page_width;
    page.height = page_height;
    page.form = form;
    what = Page::New;
  }
  return enter(oldest, *place(page, width, height), what);
}

void Atlas::forget(std::uint64_t sprite) {
  std::erase_if(slots_, [&](const auto& entry) { return entry.first.sprite == sprite; });
}

}  // namespace vsprite::detail
