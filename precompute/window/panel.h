// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// panel.h - how the panels of the tool's windows look.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "vsprite/draw.h"

namespace vsprite::window {

inline const ImVec4 kFaint{0.60f, 0.66f, 0.70f, 1}, kText{0.91f, 0.94f, 0.95f, 1},
    kGood{0.24f, 0.72f, 0.52f, 1}, kBad{0.95f, 0.55f, 0.26f, 1};

/// A background that a cut-out is judged over.
struct Ground {
  const char* name;
  std::uint32_t light, dark;  ///< 0xRRGGBB of its squares; the same: plain
};
inline constexpr Ground kSquares{"squares", 0xb9c1c7, 0xaab3ba},
    kWhite{"white", 0xf7f9fa, 0xf7f9fa}, kGrey{"grey", 0x808890, 0x808890},
    kBlack{"black", 0x101417, 0x101417};

/// The dark squares of `ground`, `side` window px wide, from `low` to `high`.
inline void draw_squares(Renderer& r, const Ground& ground, Vec2 low, Vec2 high, float side) {
  if (ground.light == ground.dark) return;
  for (int v = 0; low.y + static_cast<float>(v) * side < high.y; ++v)
    for (int u = v % 2; low.x + static_cast<float>(u) * side < high.x; u += 2) {
      const Vec2 at{low.x + static_cast<float>(u) * side, low.y + static_cast<float>(v) * side};
      r.draw_shape(box(at, {std::min(at.x + side, high.x), std::min(at.y + side, high.y)},
                       srgb(ground.dark)));
    }
}

/// Words that break at the panel's edge.
inline void line_of(const ImVec4& color, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

/// The window that covers `area`, and nothing else; ends with ImGui::End.
inline void begin_panel(const char* name, const Rect& area) {
  constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
  ImGui::SetNextWindowPos({static_cast<float>(area.x), static_cast<float>(area.y)});
  ImGui::SetNextWindowSize({static_cast<float>(area.width), static_cast<float>(area.height)});
  ImGui::Begin(name, nullptr, kPlain);
}

}  // namespace vsprite::window
