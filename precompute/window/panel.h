// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// panel.h - how the panels of the tool's windows look.
#pragma once

#include <imgui.h>

#include <string>

#include "vsprite/geometry.h"

namespace vsprite::window {

inline const ImVec4 kFaint{0.60f, 0.66f, 0.70f, 1}, kText{0.91f, 0.94f, 0.95f, 1},
    kGood{0.24f, 0.72f, 0.52f, 1}, kBad{0.95f, 0.55f, 0.26f, 1};

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
