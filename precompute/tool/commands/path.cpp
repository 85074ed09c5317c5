// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// path: a sprite along a drawn path, searched, measured, and filmed.
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>

#include "control/response.h"
#include "tool/commands/path_parts.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

/// An ending that nothing is written for is found before the search, not after it.
Result<void> check_output(const std::string& path) {
  std::error_code error;
  if (path.empty() || path.back() == '/' || fs::is_directory(path, error)) return {};
  const std::string ending = fs::path(path).extension().string();
  for (const char* known : {".mp4", ".mkv", ".webm", ".apng", ".gif", ".json", ".vsp"})
    if (ending == known) return {};
  return Error{
      ErrorCode::BadSetting,
      "-o " + path +
          ": a name in .mp4, .mkv, .webm, .apng or .gif (those four with alpha), .json or .vsp "
          "(the pack, with the run in it) is due, or a folder for PNG pictures, ending in `/`"};
}

Result<void> write_outputs(const Settings& settings, const Sprite& sprite, const Clip& clip,
                           const Stage& stage, Console& console) {
  if (!settings.trace.empty())
    if (auto wrote = write_file(settings.trace, clip_csv(clip)); !wrote) return wrote;
  if (fs::path(settings.output).extension() == ".json")
    return write_file(settings.output, clip_json(sprite, clip, stage.picture).dump(1) + "\n");
  if (fs::path(settings.output).extension() == ".vsp") {
    const std::string name = fs::path(settings.script).stem().string();
    return write_pack_clips(
        settings, sprite,
        {to_pack_clip(sprite, clip, settings.clip.empty() ? name : settings.clip)});
  }
  return write_film(settings, {{&sprite, &clip}}, stage, console);
}

Result<int> follow_path(const Settings& settings, const std::string& text, Console& console) {
  const auto sprite = load_pack(settings.film);
  if (!sprite) return sprite.error();
  const auto points = parse_path(text, settings.script);
  if (!points) return points.error();
  auto path = PathCost::make(*sprite, *points, weights_of(settings, *sprite));
  if (!path) return Error{path.error().code, settings.script + ": " + path.error().message};
  const auto own = floor_of_pack(settings);
  if (!own) return own.error();
  // A picture whose size is not given lies around the path, as it is seen on the pack's own floor.
  const bool on_ground = settings.plane == "ground";
  std::vector<Vec2> shown = *own && on_ground ? mapped(*points, **own, to_screen) : *points;
  auto stage = make_stage(settings, shown, sprite->data().body_length);
  if (!stage) return stage.error();
  const auto floor = floor_of_picture(settings, *own, *stage);
  if (!floor) return floor.error();
  if (*floor && on_ground) shown = mapped(*points, **floor, to_screen);
  if (*floor && !on_ground) {
    for (const Vec2& p : *points)
      if (p.y <= (*floor)->horizon)
        return Error{ErrorCode::BadContent,
                     settings.script + ": a point at y = " + std::to_string(std::lround(p.y)) +
                         " lies above the horizon at " +
                         std::to_string(std::lround((*floor)->horizon)) +
                         ": points on the floor below it are due"};
    path =
        PathCost::make(*sprite, mapped(*points, **floor, to_ground), weights_of(settings, *sprite));
    if (!path) return Error{path.error().code, settings.script + ": " + path.error().message};
  }
  stage->picture.floor = *floor;
  if (stage->is_given)
    if (auto inside = check_inside(shown, stage->picture, settings.script); !inside)
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
  if (auto wrote = write_outputs(settings, *sprite, *clip, *stage, console); !wrote)
    return wrote.error();
  const ClipReport report = measure_clip(*path, *clip);
  console.text(path_text(*sprite, *clip, report, seconds));
  console.document(path_json(*sprite, *clip, report, seconds));
  return 0;
}

volatile std::sig_atomic_t interrupts = 0;
void note_interrupt(int) {
  interrupts = interrupts + 1;
  if (interrupts > 1) std::_Exit(130);
}
void (*before_int)(int) = SIG_DFL;
void (*before_term)(int) = SIG_DFL;

}  // namespace

InterruptNote::InterruptNote() {
  interrupts = 0;
  before_int = std::signal(SIGINT, note_interrupt);
  before_term = std::signal(SIGTERM, note_interrupt);
}
InterruptNote::~InterruptNote() {
  std::signal(SIGINT, before_int);
  std::signal(SIGTERM, before_term);
}
bool InterruptNote::is_set() noexcept { return interrupts != 0; }

PathWeights weights_of(const Settings& settings, const Sprite& sprite) {
  const SpeedScale speeds = measure_speeds(sprite.samples());
  const double usual = speeds.usual > 0 ? speeds.usual : speeds.moving;
  const double body = std::max(1.0, double{sprite.data().body_length});
  PathWeights weights;
  weights.w1 = settings.path_w1;
  weights.w2 = settings.w2 / (body * body);
  weights.tau = settings.tau;
  weights.usual_speed = usual;
  weights.v0 = usual_v0(speeds);
  weights.least_speed = weights.v0 / 4;
  return weights;
}

Result<std::optional<Ground>> floor_of_pack(const Settings& settings) {
  if (settings.plane == "none") return std::optional<Ground>();
  return load_ground(settings.film);
}

Result<std::optional<Ground>> floor_of_picture(const Settings& settings,
                                               const std::optional<Ground>& own,
                                               const Stage& stage) {
  const FloorChoice choice = floor_of(settings);
  if (settings.plane == "none" || !choice.is_there()) return own;
  if (choice.fitted || !(choice.line > *choice.horizon) || !stage.is_given)
    return Error{ErrorCode::BadSetting,
                 "--horizon " + settings.horizon +
                     ": beside a --backdrop or --size, --horizon Y and --ground-line Y below it "
                     "are due"};
  const auto width = static_cast<float>(stage.picture.width);
  return std::optional<Ground>(
      Ground{static_cast<float>(*choice.horizon), static_cast<float>(choice.line), width / 2,
             choice.focal > 0 ? static_cast<float>(choice.focal) : 0.8f * width});
}

std::vector<Vec2> mapped(std::vector<Vec2> points, const Ground& floor,
                         Vec2 (*map)(const Ground&, Vec2) noexcept) {
  for (Vec2& p : points) p = map(floor, p);
  return points;
}

Result<Stage> make_stage(const Settings& settings, const std::vector<Vec2>& points,
                         float body_length) {
  Stage out;
  out.is_given = true;
  if (!settings.backdrop.empty()) {
    auto backdrop = read_backdrop(settings.backdrop);
    if (!backdrop) return backdrop.error();
    out.backdrop = std::move(*backdrop);
    out.picture = {out.backdrop.width(), out.backdrop.height(), {}};
  } else if (!settings.size.empty()) {
    const auto size = parse_size(settings.size);
    if (!size) return size.error();
    out.picture = {(*size)[0], (*size)[1], {}};
  } else {
    out.picture = picture_around(points, body_length);
    out.is_given = false;
    if (!settings.output.empty() && fs::path(settings.output).extension() != ".json" &&
        (out.picture.width > 16384 || out.picture.height > 16384))
      return Error{ErrorCode::BadContent,
                   settings.script + ": a picture around it is " +
                       std::to_string(out.picture.width) + " x " +
                       std::to_string(out.picture.height) +
                       ": at most 16384 px a side can be drawn; --size WxH shows a part"};
  }
  return out;
}

Result<void> write_film(const Settings& settings, const std::vector<FilmRole>& roles,
                        const Stage& stage, Console& console) {
  if (settings.output.empty()) return {};
  const StageListener listener = console.listener();
  listener.begin("film");
  const InterruptNote note;
  auto wrote = write_path_film(settings.output, roles, stage.picture, stage.backdrop,
                               listener.progress, [] { return !InterruptNote::is_set(); });
  if (wrote) listener.end("film", false);
  return wrote;
}

PackClip to_pack_clip(const Sprite& sprite, const Clip& clip, std::string name) {
  PackClip out{.name = std::move(name), .start = clip.ticks[0].position, .samples = {}};
  for (std::size_t t = 0; t < clip.ticks.size(); t += sprite.samples()[out.samples.back()].duration)
    out.samples.push_back(clip.ticks[t].sample);
  return out;
}

Result<void> write_pack_clips(const Settings& settings, const Sprite& sprite,
                              std::vector<PackClip> clips) {
  auto all = load_clips(settings.film, sprite);
  if (!all) return all.error();
  for (PackClip& clip : clips) {
    std::erase_if(*all, [&](const PackClip& old) { return old.name == clip.name; });
    all->push_back(std::move(clip));
  }
  return save_clips(settings.film, settings.output, *all);
}

Result<int> run_path(const Settings& settings, Console& console) {
  if (settings.film.empty()) return Error{ErrorCode::BadSetting, "a pack is due: PACK.vsp"};
  if (settings.window) return draw_path(settings, console);
  if (settings.script.empty())
    return Error{ErrorCode::BadSetting,
                 "--script FILE is due: a path, one point `x y` a line, or a scene (.toml)"};
  if (auto checked = check_output(settings.output); !checked) return checked.error();
  const auto text = read_file(settings.script);
  if (!text) return text.error();
  const bool is_scene = fs::path(settings.script).extension() == ".toml";
  auto done =
      is_scene ? run_scene(settings, *text, console) : follow_path(settings, *text, console);
  if (!done) return done;
  if (settings.output.empty())
    console.next("vsprite path " + shell_word(settings.film) + " --script " +
                 shell_word(settings.script) + " -o path.mp4");
  else
    console.next("vsprite play " + shell_word(settings.film));
  return done;
}

}  // namespace vsprite
