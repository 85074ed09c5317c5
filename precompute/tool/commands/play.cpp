// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "window/play.h"

#include <csignal>
#include <filesystem>

#include "tool/commands/verbs.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

/// A pack as it is; a film is built first, into the current folder, where `build` would put it.
Result<std::string> pack_of(const Settings& settings, Console& console) {
  if (settings.film.empty())
    return Error{ErrorCode::BadSetting, "a pack or a film is due: `vsprite play FILM`"};
  std::error_code error;
  if (!fs::exists(settings.film, error))
    return Error{ErrorCode::NotFound, settings.film + ": no such file"};
  const bool folder = fs::is_directory(settings.film, error);
  if (!folder && fs::path(settings.film).extension() != ".vsp") {
    Settings build = settings;
    build.json = false;
    if (auto built = run_build(build, console); !built) return built.error();
  }
  return find_pack_path(find_work_folder({}, settings.film, settings.output), settings.film,
                        settings.output);
}

}  // namespace

Result<int> run_play(const Settings& settings, Console& console) {
  const auto pack = pack_of(settings, console);
  if (!pack) return pack.error();
  const auto sprite = load_pack(*pack);
  if (!sprite) return sprite.error();
  if (!settings.mode.empty() && sprite->find_mode(settings.mode) < 0)
    return Error{ErrorCode::BadContent, *pack + ": it holds no mode `" + settings.mode +
                                            "`: use --mode " + sprite->data().modes.front().name};
  console.text(describe_directions(*sprite, settings.mode));
  PlayOptions options;
  options.mode = settings.mode;
  options.headless = settings.headless;
  options.frames = static_cast<std::uint64_t>(settings.frames);
  options.keys = settings.keys;
  options.record = settings.record;
  options.seed = settings.seed;
  options.title = fs::path(*pack).stem().string();
  // The window closes itself on an interrupt; nothing is left to keep.
  std::signal(SIGINT, SIG_DFL);
  if (auto played = play_window(*sprite, options); !played) return played.error();
  console.next("vsprite steer " + shell_word(*pack));
  return 0;
}

}  // namespace vsprite
