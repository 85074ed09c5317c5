// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <filesystem>

#include "tool/commands/verbs.h"
#include "tool/files.h"
#include "tool/page.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

std::string megabytes(std::size_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) / 1e6);
  return text;
}

}  // namespace

Result<int> run_export(const Settings& settings, Console& console) {
  namespace fs = std::filesystem;
  if (settings.film.empty())
    return Error{ErrorCode::BadSetting, "a pack is due: `vsprite export PACK --to html`"};
  if (settings.to.empty()) return Error{ErrorCode::BadSetting, "--to is due: html"};
  const auto sprite = load_pack(settings.film);
  if (!sprite) return sprite.error();
  const auto pack = read_file(settings.film);
  if (!pack) return pack.error();
  const auto place = settings.page.empty() ? find_player_page() : settings.page;
  if (!place) return place.error();
  const auto text = read_file(*place);
  if (!text) return text.error();
  const auto page =
      make_page(*text, *place, {reinterpret_cast<const std::uint8_t*>(pack->data()), pack->size()},
                sprite->data().name);
  if (!page) return page.error();
  if (static_cast<double>(page->size()) > settings.page_limit * 1e6)
    return Error{ErrorCode::LimitExceeded,
                 settings.film + ": a page of " + megabytes(page->size()) +
                     " would come of it, at most " +
                     megabytes(static_cast<std::size_t>(settings.page_limit * 1e6)) +
                     " are wanted: build the sprite smaller (--max-size 128), or raise --limit"};
  const std::string output =
      settings.output.empty() ? fs::path(settings.film).stem().string() + ".html" : settings.output;
  if (auto wrote = write_file(output, *page); !wrote) return wrote.error();
  console.text(output + ": " + megabytes(page->size()) +
               ", opens by a double click, steered with arrow keys, " + "W A S D or a finger\n");
  console.document({{"file", output},
                    {"to", settings.to},
                    {"bytes", page->size()},
                    {"pack_bytes", pack->size()}});
  return 0;
}

}  // namespace vsprite
