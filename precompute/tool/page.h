// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/page.h - a pack as a web page: the player of a page template (player.html, aquarium.html),
// made by a build with VSPRITE_WEB=ON, with the pack put into it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsprite/result.h"

namespace vsprite {

/// As data URIs take them.
std::string base64(std::span<const std::uint8_t> bytes);
/// As text and attributes of HTML hold it.
std::string escape_html(std::string_view text);

/// The template's text with the pack and the title in their places. `name`: of the template, stands
/// in messages. Errors: BadContent (a file that is no such template).
Result<std::string> make_page(const std::string& page, const std::string& name,
                              std::span<const std::uint8_t> pack, const std::string& title);

/// player.html beside the program: in ../share/vsprite of its folder, in a build tree and installed
/// alike. Errors: NotFound, with how to get it.
Result<std::string> find_player_page();

}  // namespace vsprite
