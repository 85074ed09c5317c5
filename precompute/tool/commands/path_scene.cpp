// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// path --script SCENE.toml: sprites on cue, by replacement search, until its seconds are spent.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>

#include "tool/commands/path_parts.h"
#include "tool/report.h"
#include "tool/scene_script.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

/// The packs of a scene, each loaded once.
struct Packs {
  std::vector<std::string> paths;
  std::vector<std::unique_ptr<Sprite>> loaded;
  std::vector<const Sprite*> of_part;
  const Sprite* of_operand = nullptr;  ///< null where no part plays it
};
Result<Packs> load_packs(const SceneScript& script, const Settings& settings) {
  Packs out;
  const fs::path folder = fs::path(settings.script).parent_path();
  for (const auto& part : script.parts) {
    const std::string path = part.pack.empty() ? settings.film : (folder / part.pack).string();
    const auto at = std::find(out.paths.begin(), out.paths.end(), path) - out.paths.begin();
    if (at == static_cast<std::ptrdiff_t>(out.paths.size())) {
      auto sprite = load_pack(path);
      if (!sprite) return sprite.error();
      out.paths.push_back(path);
      out.loaded.push_back(std::make_unique<Sprite>(std::move(*sprite)));
    }
    out.of_part.push_back(out.loaded[static_cast<std::size_t>(at)].get());
    if (part.pack.empty()) out.of_operand = out.of_part.back();
  }
  const std::string& name = out.of_part[0]->data().name;
  if (!script.made_for.empty() && script.made_for != name)
    return Error{ErrorCode::BadContent, settings.script + ": written for the pack `" +
                                            script.made_for + "`, but " + out.paths[0] + " is `" +
                                            name + "`: that pack is due, or a line `for` less"};
  return out;
}

/// The search, as the command line wants it, and how the cost fell.
class Watch {
 public:
  Watch(const Settings& settings, Console& console)
      : settings_(settings), console_(console), listener_(console.listener()) {}

  SceneResult search(const Scene& scene, std::vector<std::vector<std::uint32_t>> start) {
    // A beam has no best so far: an interrupt ends it as it ends everything else.
    std::optional<InterruptNote> note;
    if (settings_.search != "beam") note.emplace();
    listener_.begin("search");
    ReplaceConfig config{.seed = settings_.seed, .start = std::move(start)};
    if (settings_.proposals > 0) config.proposals = settings_.proposals;
    config.go_on = [this](std::uint64_t proposals, double cost) { return look(proposals, cost); };
    SceneResult result = settings_.search == "beam" ? scene_beam(scene, settings_.beam)
                                                    : replace_search(scene, config);
    stopped = note && InterruptNote::is_set();
    seconds = seconds_since(begun_);
    curve.push_back({{"seconds", seconds}, {"proposals", result.proposals}, {"cost", result.cost}});
    listener_.end("search", false);
    return result;
  }

  Json curve = Json::array();
  double seconds = 0;
  bool stopped = false;

 private:
  bool look(std::uint64_t proposals, double cost) {
    const double now = seconds_since(begun_);
    // Points lie ever further apart, and only where the cost has fallen.
    if (curve.empty() || (now >= 1.2 * last_ + 0.02 && cost < cost_)) {
      curve.push_back({{"seconds", now}, {"proposals", proposals}, {"cost", cost}});
      last_ = now;
      cost_ = cost;
      if (now >= shown_ + 1) {
        console_.remark(fixed_text(now, 1) + " s: cost " + fixed_text(cost, 3));
        shown_ = now;
      }
    }
    const bool by_count = settings_.proposals > 0;
    listener_.progress(by_count ? static_cast<double>(proposals) /
                                      static_cast<double>(settings_.proposals)
                                : std::min(1.0, now / settings_.seconds));
    return !InterruptNote::is_set() && (by_count || now < settings_.seconds);
  }

  const Settings& settings_;
  Console& console_;
  StageListener listener_;
  Clock::time_point begun_ = Clock::now();
  double last_ = 0, cost_ = 0, shown_ = 0;
};

/// What the beam can be compared on.
Result<void> check_beam(const Scene& scene, const std::string& name) {
  if (scene.roles.size() != 1)
    return Error{ErrorCode::BadContent, name + ": --search beam takes one sprite, not " +
                                            std::to_string(scene.roles.size())};
  for (const SceneTerm& term : scene.roles[0].terms)
    if (term.kind == SceneTerm::Kind::Path)
      return Error{ErrorCode::BadContent,
                   name + ": --search beam takes no term `path`: a path of its own has its beam"};
  for (const Sample& s : scene.roles[0].sprite->samples())
    if (s.kept && s.duration != 1)
      return Error{
          ErrorCode::BadContent,
          name + ": --search beam takes a pack whose samples are shown for one frame each"};
  return {};
}

std::vector<std::string> unmet(const Json& document) {
  std::vector<std::string> out;
  for (const Json& term : document["terms"])
    if (!term["met"].get<bool>())
      out.push_back(term["sprite"].get<std::string>() + ", term " +
                    std::to_string(term["term"].get<int>()) + " (" +
                    term["kind"].get<std::string>() +
                    ") is not met: " + fixed_text(term["worst"].get<double>(), 1) + " " +
                    term["unit"].get<std::string>() + " at " +
                    fixed_text(term["worst_seconds"].get<double>(), 2) + " s");
  return out;
}

}  // namespace

Result<int> run_scene(const Settings& settings, const std::string& text, Console& console) {
  auto script = parse_scene(text, settings.script);
  if (!script) return script.error();
  const auto packs = load_packs(*script, settings);
  if (!packs) return packs.error();
  const auto scene = make_scene(*script, packs->of_part, settings.script);
  if (!scene) return scene.error();
  Settings asked = settings;
  if (asked.size.empty() && script->width > 0)
    asked.size = std::to_string(script->width) + "x" + std::to_string(script->height);
  // On a floor a scene's places are those on it.
  const auto own = floor_of_pack(settings);
  if (!own) return own.error();
  std::vector<Vec2> spots = places_of(*script);
  if (*own) spots = mapped(std::move(spots), **own, to_screen);
  auto stage = make_stage(asked, spots, packs->of_part[0]->data().body_length);
  if (!stage) return stage.error();
  const auto floor = floor_of_picture(settings, *own, *stage);
  if (!floor) return floor.error();
  stage->picture.floor = *floor;
  std::vector<std::vector<std::uint32_t>> start;
  if (!settings.resume.empty()) {
    const auto places = read_file(settings.resume);
    if (!places) return places.error();
    auto samples = read_places(*places, *scene, settings.resume);
    if (!samples) return samples.error();
    start = std::move(*samples);
  }

  if (settings.search == "beam")
    if (auto fits = check_beam(*scene, settings.script); !fits) return fits.error();
  Watch watch(settings, console);
  const SceneResult result = watch.search(*scene, std::move(start));
  Json document = scene_json(*script, *scene, result);
  document["seconds"] = watch.seconds;
  document["curve"] = watch.curve;
  for (const std::string& line : unmet(document)) console.remark(line);

  if (!settings.trace.empty())
    if (auto wrote = write_file(settings.trace, scene_csv(result)); !wrote) return wrote.error();
  if (fs::path(settings.output).extension() == ".json") {
    const Json places = scene_places(*script, *scene, result, stage->picture);
    if (auto wrote = write_file(settings.output, places.dump(1) + "\n"); !wrote)
      return wrote.error();
  } else if (fs::path(settings.output).extension() == ".vsp") {
    std::vector<PackClip> clips;
    for (std::size_t r = 0; r < result.clips.size(); ++r)
      if (script->parts[r].pack.empty())
        clips.push_back(to_pack_clip(*packs->of_part[r], result.clips[r], script->parts[r].name));
    if (clips.empty())
      return Error{ErrorCode::BadContent,
                   settings.script + ": no sprite of the pack that is to hold it"};
    if (auto wrote = write_pack_clips(settings, *packs->of_operand, std::move(clips)); !wrote)
      return wrote.error();
  } else {
    std::vector<FilmRole> roles;
    for (std::size_t r = 0; r < result.clips.size(); ++r)
      roles.push_back({packs->of_part[r], &result.clips[r]});
    if (auto wrote = write_film(asked, roles, *stage, console); !wrote) return wrote.error();
  }
  console.text(scene_text(*script, *scene, result));
  console.document(document);
  return watch.stopped ? 130 : 0;
}

}  // namespace vsprite
