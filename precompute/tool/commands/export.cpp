// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/export.h"

#include <cstdio>
#include <filesystem>

#include "tool/commands/verbs.h"
#include "tool/files.h"
#include "tool/page.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

std::string megabytes(std::size_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f MB", static_cast<double>(bytes) / 1e6);
  return text;
}

Result<int> export_page(const Settings& settings, Console& console) {
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

Result<int> export_folder(const Settings& settings, Console& console) {
  const auto format = find_export_format(settings.to);
  if (!format) return format.error();
  const auto sprite = load_pack(settings.film);
  if (!sprite) return sprite.error();
  const std::string folder = settings.output.empty()
                                 ? fs::path(settings.film).stem().string() + "-" + settings.to
                                 : settings.output;
  const StageListener listener = console.listener();
  listener.begin("export");
  auto choice = choose_for_export(*sprite, settings.samples, settings.seed, settings.jobs);
  if (!choice)
    return Error{choice.error().code,
                 settings.film + ": " + choice.error().message + ": raise --samples, or 0 for all"};
  if (auto made = make_folder(folder); !made) return made.error();
  const auto wrote = (*format)->write({*sprite, std::move(*choice), folder, listener.progress});
  if (!wrote) return wrote.error();
  listener.end("export", false);
  Json document = *wrote;
  document["to"] = settings.to;
  console.text(folder + ": " + std::to_string(document["samples"].get<std::size_t>()) +
               " samples of " + std::to_string(sprite->samples().size()) +
               ", character.json steers them\n");
  console.document(document);
  console.next("vsprite play " + shell_word(settings.film));
  return 0;
}

}  // namespace

Result<int> run_export(const Settings& settings, Console& console) {
  if (settings.film.empty())
    return Error{ErrorCode::BadSetting, "a pack is due: `vsprite export PACK --to html`"};
  if (settings.to.empty())
    return Error{ErrorCode::BadSetting, "--to is due: html, table or png-seq"};
  return settings.to == "html" ? export_page(settings, console) : export_folder(settings, console);
}

}  // namespace vsprite
