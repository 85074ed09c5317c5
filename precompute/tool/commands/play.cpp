// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "window/play.h"

#include <csignal>
#include <filesystem>

#include "tool/cast_file.h"
#include "tool/commands/verbs.h"
#include "vsprite/pack.h"
#include "vsprite/show.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

/// True where the film was segmented in full before: a draft would throw that away.
bool stands_in_full(const Settings& settings) {
  const auto project =
      Project::look(find_work_folder(settings.work, settings.film, settings.output));
  const Json* record = project ? project->record("segment") : nullptr;
  if (record == nullptr) return false;
  const Json made = record->value("settings", Json::object());
  if (is_cast(settings.film)) return !made.value("draft", true) && made.contains("cast");
  const auto sum = hash_source(source_of(settings, settings.film));
  if (!sum) return false;
  const Json inputs = record->value("inputs", Json::object());
  return !made.value("draft", true) && inputs.value("film", Json()) == hex64(*sum);
}

/// A pack as it is; a film is built first, as a draft where it was never built in full, into the
/// current folder, where `build` would put it.
Result<std::string> pack_of(const Settings& settings, Console& console) {
  if (settings.film.empty())
    return Error{ErrorCode::BadSetting, "a pack or a film is due: `vsprite play FILM`"};
  std::error_code error;
  if (!fs::exists(settings.film, error) && !is_picture_source(settings.film))
    return Error{ErrorCode::NotFound, settings.film + ": no such file"};
  const bool folder = fs::is_directory(settings.film, error) && !is_film_folder(settings.film);
  if (!folder && fs::path(settings.film).extension() != ".vsp") {
    Settings build = settings;
    build.json = false;
    build.draft |= !stands_in_full(settings);
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
  options.fade = parse_fade(settings.fade).value_or(kFadeAuto);
  options.title = fs::path(*pack).stem().string();
  options.watched = *pack;
  options.tell = [&console](const std::string& what) { console.listener().note(what); };
  // The window closes itself on an interrupt; nothing is left to keep.
  std::signal(SIGINT, SIG_DFL);
  if (auto played = play_window(*sprite, options); !played) return played.error();
  console.next("vsprite steer " + shell_word(*pack));
  return 0;
}

}  // namespace vsprite
