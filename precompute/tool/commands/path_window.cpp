// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// path --window: a path drawn by hand, and saved as a script.
#include <filesystem>

#include "tool/commands/path_parts.h"
#include "tool/path_edit.h"
#ifdef VSPRITE_WINDOW
#include "vsprite/pack.h"
#include "window/path.h"
#endif

namespace vsprite {

#ifdef VSPRITE_WINDOW
namespace {

namespace fs = std::filesystem;

struct Drawn {
  std::vector<Vec2> points;
  std::string head;
};
/// The script as it is, or nothing where there is none yet.
Result<Drawn> read_script(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return Drawn{};
  const auto text = read_file(path);
  if (!text) return text.error();
  auto points = parse_path(*text, path);
  if (!points) return points.error();
  return Drawn{std::move(*points), head_of_path(*text)};
}

}  // namespace

Result<int> draw_path(const Settings& settings, Console& console) {
  const std::string script = settings.script.empty() ? "path.txt" : settings.script;
  if (fs::path(script).extension() == ".toml")
    return Error{ErrorCode::BadSetting,
                 "--window --script " + script +
                     ": a window draws paths, one `x y` a line, not scenes: another name is due"};
  const auto drawn = read_script(script);
  if (!drawn) return drawn.error();
  const auto sprite = load_pack(settings.film);
  if (!sprite) return sprite.error();
  Settings asked = settings;
  if (drawn->points.empty() && asked.size.empty()) asked.size = "960x540";
  const float body = sprite->data().body_length;
  auto stage = make_stage(asked, drawn->points, 2 * body);
  if (!stage) return stage.error();
  if (settings.plane == "ground")
    return Error{ErrorCode::BadSetting, "--window --plane ground: a window draws on the screen"};
  const auto own = floor_of_pack(settings);
  if (!own) return own.error();
  const auto floor = floor_of_picture(settings, *own, *stage);
  if (!floor) return floor.error();
  stage->picture.floor = *floor;
  PathWindowOptions options;
  options.script = script;
  options.head = drawn->head;
  options.picture = stage->picture;
  options.backdrop = &stage->backdrop;
  options.weights = weights_of(settings, *sprite);
  options.beam = settings.beam;
  options.jobs = settings.jobs;
  options.headless = settings.headless;
  options.frames = settings.headless && settings.frames == 0 ? 60 : settings.frames;
  options.screenshot = settings.record;
  options.saved = [&console](const std::string& what) { console.remark(what); };
  PathEdit edit(drawn->points);
  if (auto shown = path_window(*sprite, edit, options); !shown) return shown.error();
  std::string text = script + ": " + std::to_string(edit.points().size()) + " points\n";
  if (!edit.is_saved()) {
    const std::string spare = script + ".unsaved";
    if (auto wrote = write_file(spare, format_path(edit.points(), drawn->head)); !wrote)
      return wrote.error();
    text = script + ": not saved; what was drawn lies in " + spare + "\n";
  }
  console.text(text);
  console.document(
      {{"script", script}, {"points", edit.points().size()}, {"saved", edit.is_saved()}});
  console.next("vsprite path " + shell_word(settings.film) + " --script " + shell_word(script) +
               " -o path.mp4");
  return 0;
}
#else
Result<int> draw_path(const Settings&, Console&) {
  return Error{ErrorCode::Unavailable,
               "this vsprite was built without windows: write the path, a line `x y` a point, and "
               "give it with --script FILE"};
}
#endif

}  // namespace vsprite
