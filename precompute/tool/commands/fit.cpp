// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// fit: drawn or photographed views -> puppets, in a pack of their own or in a work folder.
#include <filesystem>

#include "tool/commands/verbs.h"
#include "tool/files.h"
#include "tool/report.h"
#include "tool/views_file.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

}  // namespace

Result<int> run_fit(const Settings& settings, Console& console) {
  if (settings.film.empty())
    return Error{ErrorCode::BadSetting, "a file of views is due: VIEWS.toml"};
  if (settings.output.empty() && settings.work.empty())
    return Error{ErrorCode::BadSetting, "-o PACK or --work DIR is due"};
  const auto text = read_views_text(settings.film);
  if (!text) return text.error();
  const auto set = parse_views(*text, settings.film);
  if (!set) return set.error();
  const auto puppets = fit_puppets(*set);
  // A kernel without its degree stands in the file, not on the command line.
  if (!puppets) {
    const ErrorCode code = puppets.error().code;
    return Error{code == ErrorCode::BadSetting ? ErrorCode::BadContent : code,
                 settings.film + ": " + puppets.error().message};
  }

  if (!settings.output.empty())
    if (auto wrote = save_puppet_pack(settings.output, *puppets); !wrote) return wrote.error();
  if (!settings.work.empty()) {
    std::error_code error;
    if (!fs::is_directory(settings.work, error))
      return Error{ErrorCode::NotFound, settings.work + ": no such work folder"};
    const auto lock = FolderLock::take(settings.work);
    if (!lock) return lock.error();
    if (auto wrote = write_puppets(settings.work, *puppets); !wrote) return wrote.error();
  }
  Json list = Json::array();
  std::string lines;
  for (const Puppet& puppet : *puppets) {
    list.push_back(puppet_json(puppet));
    lines += puppet_line(puppet);
  }
  const double error = fit_error(*set, (*puppets)[0]);
  if (set->hyper) lines += "its points miss the views by " + fixed_text(error, 2) + " px (rms)\n";
  console.text(lines);
  console.document({{"puppets", list}, {"fit_error", error}});
  console.next(settings.output.empty() ? "vsprite pack --work " + shell_word(settings.work)
                                       : "vsprite info " + shell_word(settings.output));
  return 0;
}

}  // namespace vsprite
