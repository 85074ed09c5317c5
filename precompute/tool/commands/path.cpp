// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// path: a sprite along a drawn path, searched, measured, and filmed.
#include <chrono>
#include <filesystem>

#include "control/response.h"
#include "tool/commands/verbs.h"
#include "tool/path_film.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

/// An ending that nothing is written for is found before the search, not after it.
Result<void> check_output(const std::string& path) {
  std::error_code error;
  if (path.empty() || path.back() == '/' || fs::is_directory(path, error)) return {};
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".mp4" || ending == ".mkv" || ending == ".json") return {};
  return Error{ErrorCode::BadSetting,
               "-o " + path +
                   ": a name in .mp4, .mkv (with alpha) or .json is due, or a folder "
                   "for PNG pictures, ending in `/`"};
}

struct Ground {
  PathPicture picture;
  Image backdrop;  ///< empty: plain
  bool is_given = false;
};

Result<Ground> ground_of(const Settings& settings, const std::vector<Vec2>& points,
                         const Sprite& sprite) {
  Ground out;
  if (!settings.backdrop.empty()) {
    auto image = read_png(settings.backdrop);
    if (!image) return image.error();
    out.backdrop = std::move(*image);
    out.picture = {out.backdrop.width, out.backdrop.height, {}};
    out.is_given = true;
  } else if (!settings.size.empty()) {
    const auto size = parse_size(settings.size);
    if (!size) return size.error();
    out.picture = {(*size)[0], (*size)[1], {}};
    out.is_given = true;
  } else {
    out.picture = picture_around(points, sprite.data().body_length);
  }
  return out;
}

PathWeights weights_of(const Settings& settings, const Sprite& sprite) {
  const SpeedScale speeds = measure_speeds(sprite.samples());
  const double usual = speeds.usual > 0 ? speeds.usual : speeds.moving;
  const double body = std::max(1.0, double{sprite.data().body_length});
  PathWeights weights;
  weights.w1 = settings.path_w1;
  weights.w2 = settings.w2 / (body * body);
  weights.tau = settings.tau;
  weights.usual_speed = usual;
  weights.v0 = 0.35 * usual;
  weights.least_speed = weights.v0 / 4;
  return weights;
}

Result<void> write_outputs(const Settings& settings, const Sprite& sprite, const Clip& clip,
                           const Ground& ground, const StageListener& listener) {
  if (!settings.trace.empty())
    if (auto wrote = write_file(settings.trace, clip_csv(clip)); !wrote) return wrote;
  const std::string& path = settings.output;
  if (path.empty()) return {};
  if (fs::path(path).extension() == ".json")
    return write_file(path, clip_json(sprite, clip, ground.picture).dump(1) + "\n");
  listener.begin("film");
  const auto wrote =
      write_path_film(path, {{&sprite, &clip}}, ground.picture, ground.backdrop, listener.progress);
  if (wrote) listener.end("film", false);
  return wrote;
}

}  // namespace

Result<int> run_path(const Settings& settings, Console& console) {
  if (settings.film.empty()) return Error{ErrorCode::BadSetting, "a pack is due: PACK.vsp"};
  if (settings.script.empty())
    return Error{ErrorCode::BadSetting, "--script FILE is due: the path, one point `x y` a line"};
  if (auto checked = check_output(settings.output); !checked) return checked.error();
  const auto sprite = load_pack(settings.film);
  if (!sprite) return sprite.error();
  const auto text = read_file(settings.script);
  if (!text) return text.error();
  const auto points = parse_path(*text, settings.script);
  if (!points) return points.error();
  auto path = PathCost::make(*sprite, *points, weights_of(settings, *sprite));
  if (!path) return Error{path.error().code, settings.script + ": " + path.error().message};
  const auto ground = ground_of(settings, *points, *sprite);
  if (!ground) return ground.error();
  if (ground->is_given)
    if (auto inside = check_inside(*points, ground->picture, settings.script); !inside)
      return inside.error();

  const StageListener listener = console.listener();
  listener.begin("search");
  const auto begun = std::chrono::steady_clock::now();
  const auto clip = search_path(
      *path, {.width = settings.beam, .jobs = settings.jobs, .progress = listener.progress});
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  if (!clip) return Error{clip.error().code, settings.script + ": " + clip.error().message};
  listener.end("search", false);
  if (auto wrote = write_outputs(settings, *sprite, *clip, *ground, listener); !wrote)
    return wrote.error();
  const ClipReport report = measure_clip(*path, *clip);
  console.text(path_text(*sprite, *clip, report, seconds));
  console.document(path_json(*sprite, *clip, report, seconds));
  if (settings.output.empty())
    console.next("vsprite path " + shell_word(settings.film) + " --script " +
                 shell_word(settings.script) + " -o path.mp4");
  else
    console.next("vsprite play " + shell_word(settings.film));
  return 0;
}

}  // namespace vsprite
