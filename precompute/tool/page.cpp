// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/page.h"

#include <filesystem>

namespace vsprite {
namespace {

constexpr std::string_view kPackPlace = "@VSPRITE_PACK@";
constexpr std::string_view kTitlePlace = "@VSPRITE_TITLE@";

}  // namespace

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t three = std::uint32_t{bytes[at]} << 16;
    if (at + 1 < bytes.size()) three |= std::uint32_t{bytes[at + 1]} << 8;
    if (at + 2 < bytes.size()) three |= bytes[at + 2];
    for (unsigned k = 0; k < 4; ++k)
      out += at + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63u];
  }
  return out;
}

std::string escape_html(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += c;
  }
  return out;
}

Result<std::string> make_page(const std::string& page, const std::string& name,
                              std::span<const std::uint8_t> pack, const std::string& title) {
  const std::size_t pack_at = page.find(kPackPlace), title_at = page.find(kTitlePlace);
  if (pack_at == std::string::npos || title_at == std::string::npos || title_at > pack_at)
    return Error{ErrorCode::BadContent,
                 name + ": is no page for a pack, the place " + std::string(kPackPlace) +
                     " is due in it: player.html of a build with VSPRITE_WEB=ON"};
  const std::size_t after_title = title_at + kTitlePlace.size();
  return page.substr(0, title_at) + escape_html(title) +
         page.substr(after_title, pack_at - after_title) + base64(pack) +
         page.substr(pack_at + kPackPlace.size());
}

Result<std::string> find_player_page() {
  std::error_code ignored;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const auto page = program.parent_path().parent_path() / "share" / "vsprite" / "player.html";
  if (std::filesystem::is_regular_file(page, ignored)) return page.string();
  return Error{ErrorCode::NotFound,
               page.string() +
                   ": no such file: it is made by a build with VSPRITE_WEB=ON (apt install "
                   "emscripten), or name another page with --template FILE"};
}

}  // namespace vsprite
