// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/scene_script.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "similarity/features.h"
#include "tool/report.h"
#include "tool/toml_table.h"

namespace vsprite {
namespace {

using Kind = SceneTerm::Kind;

struct KindName {
  const char* name;
  Kind kind;
};
constexpr KindName kKinds[] = {{"location", Kind::Location}, {"path", Kind::Path},
                               {"heading", Kind::Heading},   {"speed", Kind::Speed},
                               {"pose", Kind::Pose},         {"region", Kind::Region},
                               {"clear", Kind::KeepClear},   {"meet", Kind::Meet}};

std::string kind_list() {
  std::string out;
  for (const KindName& k : kKinds) out += (out.empty() ? "" : ", ") + std::string(k.name);
  return out;
}

SceneScript::Term take_term(TomlTable& from) {
  SceneScript::Term out;
  SceneTerm& t = out.term;
  out.kind = from.word("kind", {});
  const auto* known = std::find_if(std::begin(kKinds), std::end(kKinds),
                                   [&](const KindName& k) { return out.kind == k.name; });
  if (known == std::end(kKinds)) {
    from.complain("kind", "`" + out.kind + "`: one of " + kind_list() + " is due");
    return out;
  }
  t.kind = known->kind;
  t.weight = from.number("weight", 1.0, 0, 1e6);
  out.from = from.number("from", 0.0, 0, 3600);
  out.to = from.number("to", 3600.0, 0, 3600);
  if (out.to <= out.from) from.complain("to", "it ends before it begins: `to` after `from` is due");
  switch (t.kind) {
    case Kind::Location:
      t.at = from.point("at");
      t.radius = from.number("radius", 0.0, 0, 30000);
      break;
    case Kind::Path:
      t.points = from.points("points", false, "point");
      break;
    case Kind::Heading:
      t.angle = from.number("angle_deg", {}, -360, 360) * kPi / 180;
      if (t.angle > kPi) t.angle -= 2 * kPi;
      if (t.angle < -kPi) t.angle += 2 * kPi;
      break;
    case Kind::Speed:
      t.speed = from.number("speed", {}, 0, 100000);
      break;
    case Kind::Pose:
      t.sample = static_cast<std::uint32_t>(from.number("sample", {}, 0, 4294967294.0));
      break;
    case Kind::Region:
      t.low = from.point("low");
      t.high = from.point("high");
      if (t.low.x > t.high.x || t.low.y > t.high.y)
        from.complain("high", "low [left, top] and high [right, bottom] are due");
      break;
    case Kind::KeepClear:
    case Kind::Meet:
      out.with = from.word("with", {});
      t.distance = from.number("distance", {}, 0, 30000);
      break;
  }
  return out;
}

SceneScript::Part take_part(TomlTable& from, const std::string& file, std::optional<Error>& error) {
  SceneScript::Part out;
  out.name = from.word("name", {});
  out.pack = from.word("pack", "");
  out.start = from.point("start");
  for (const toml::table* table : from.tables("term")) {
    TomlTable term(*table, file, error);
    out.terms.push_back(take_term(term));
    term.done();
  }
  return out;
}

std::uint32_t to_tick(double seconds, double fps, std::uint32_t most) {
  return static_cast<std::uint32_t>(
      std::min(std::ceil(seconds * fps - 1e-9), static_cast<double>(most)));
}

std::string term_name(const SceneScript& script, const TermReport& report) {
  const auto& part = script.parts[report.role];
  return part.name + ", term " + std::to_string(report.term + 1) + " (" +
         part.terms[report.term].kind + ")";
}

/// What a term's largest value means in px, degrees or its own measure; a term is met below this.
struct Shortfall {
  double value = 0;
  const char* unit = "";
  bool is_met = true;
};
Shortfall shortfall(const Scene& scene, const TermReport& r) {
  const SceneRole& role = scene.roles[r.role];
  const double body = std::max(1.0, double{role.sprite->data().body_length});
  switch (role.terms[r.term].kind) {
    case Kind::Heading:
      return {r.worst * 180 / kPi, "degrees off", r.worst <= kPi / 4};
    case Kind::Pose:
      return {r.worst * 30, "film frames off", r.worst <= 3.0 / 30};
    case Kind::Speed:
      return {std::sqrt(r.worst), "of the usual slow speed off", r.worst <= 1};
    default: {
      // A path's value holds its angle, in radians, beside the squared distance.
      const double off = std::sqrt(r.worst) * body;
      return {off, "px off", off <= body / 2};
    }
  }
}

}  // namespace

Result<SceneScript> parse_scene(const std::string& text, const std::string& name) {
  const auto parsed = parse_toml(text, name);
  if (!parsed) return parsed.error();
  std::optional<Error> error;
  TomlTable from(*parsed, name, error);
  SceneScript out;
  out.seconds = from.number("seconds", {}, 0.1, 3600);
  out.made_for = from.word("for", "");
  if (parsed->contains("size")) {
    const Vec2 size = from.point("size");
    out.width = static_cast<int>(size.x);
    out.height = static_cast<int>(size.y);
    if (out.width < 2 || out.height < 2 || out.width > 16384 || out.height > 16384)
      from.complain(*parsed->get("size"), "size", "2 to 16384 px a side are due");
  }
  std::set<std::string> names;
  for (const toml::table* table : from.tables("sprite")) {
    TomlTable part(*table, name, error);
    out.parts.push_back(take_part(part, name, error));
    part.done();
    if (!names.insert(out.parts.back().name).second)
      from.complain(*table, "name", "two sprites of one name");
  }
  from.done();
  if (error) return *error;
  if (out.parts.empty())
    return Error{ErrorCode::BadContent, name + ": a scene without a sprite: [[sprite]] is due"};
  return out;
}

Result<Scene> make_scene(const SceneScript& script, const std::vector<const Sprite*>& sprites,
                         const std::string& name) {
  Scene scene;
  const double fps = sprites[0]->fps();
  scene.ticks = std::max(1u, to_tick(script.seconds, fps, UINT32_MAX));
  for (std::size_t r = 0; r < sprites.size(); ++r) {
    const auto& part = script.parts[r];
    if (sprites[r]->fps() != fps)
      return Error{ErrorCode::BadContent, name + ": " + part.name + ": a pack of " +
                                              fixed_text(sprites[r]->fps(), 2) +
                                              " frames a second beside one of " +
                                              fixed_text(fps, 2) + ": one rate is due"};
    SceneRole role{.sprite = sprites[r], .start = part.start, .terms = {}};
    for (const auto& written : part.terms) {
      SceneTerm term = written.term;
      term.from = to_tick(written.from, fps, scene.ticks);
      term.to = to_tick(written.to, fps, scene.ticks);
      if (!written.with.empty()) {
        const auto other = std::find_if(script.parts.begin(), script.parts.end(),
                                        [&](const auto& p) { return p.name == written.with; });
        if (other == script.parts.end() || other->name == part.name)
          return Error{ErrorCode::BadContent,
                       name + ": " + part.name + ": with = \"" + written.with +
                           "\": the name of another sprite of the scene is due"};
        term.other = static_cast<std::uint32_t>(other - script.parts.begin());
      }
      role.terms.push_back(std::move(term));
    }
    scene.roles.push_back(std::move(role));
  }
  if (auto checked = check_scene(scene); !checked)
    return Error{checked.error().code, name + ": " + checked.error().message};
  return scene;
}

std::vector<Vec2> places_of(const SceneScript& script) {
  std::vector<Vec2> out;
  for (const auto& part : script.parts) {
    out.push_back(part.start);
    for (const auto& t : part.terms) {
      if (t.term.kind == Kind::Location) out.push_back(t.term.at);
      if (t.term.kind == Kind::Region) out.insert(out.end(), {t.term.low, t.term.high});
      out.insert(out.end(), t.term.points.begin(), t.term.points.end());
    }
  }
  return out;
}

std::string scene_text(const SceneScript& script, const Scene& scene, const SceneResult& result) {
  const double fps = scene.roles[0].sprite->fps();
  std::string out = "  " + std::to_string(scene.ticks) + " frames (" +
                    fixed_text(scene.ticks / fps, 1) + " s), cost " + fixed_text(result.cost, 3) +
                    ", " + std::to_string(result.proposals) + " proposals, " +
                    std::to_string(result.accepted) + " accepted\n";
  for (const TermReport& r : result.terms) {
    const Shortfall s = shortfall(scene, r);
    out += "  " + term_name(script, r) + ": cost " + fixed_text(r.cost, 3) + ", at worst " +
           fixed_text(s.value, 1) + " " + s.unit + " at " + fixed_text(r.worst_tick / fps, 2) +
           " s" + (s.is_met ? "" : ": NOT MET") + "\n";
  }
  return out;
}

Json scene_json(const SceneScript& script, const Scene& scene, const SceneResult& result) {
  const double fps = scene.roles[0].sprite->fps();
  Json terms = Json::array(), sprites = Json::array();
  for (const TermReport& r : result.terms) {
    const Shortfall s = shortfall(scene, r);
    terms.push_back({{"sprite", script.parts[r.role].name},
                     {"term", r.term + 1},
                     {"kind", script.parts[r.role].terms[r.term].kind},
                     {"cost", r.cost},
                     {"worst", s.value},
                     {"unit", s.unit},
                     {"worst_seconds", r.worst_tick / fps},
                     {"met", s.is_met}});
  }
  for (std::size_t r = 0; r < result.clips.size(); ++r)
    sprites.push_back({{"name", script.parts[r].name}, {"cost", result.clips[r].cost}});
  return {{"frames", scene.ticks},
          {"cost", result.cost},
          {"proposals", result.proposals},
          {"accepted", result.accepted},
          {"terms", terms},
          {"sprites", sprites},
          {"motion_seconds", scene.ticks / fps}};
}

Json scene_places(const SceneScript& script, const Scene& scene, const SceneResult& result,
                  const PathPicture& picture) {
  Json sprites = Json::array();
  for (std::size_t r = 0; r < result.clips.size(); ++r) {
    Json one = clip_json(*scene.roles[r].sprite, result.clips[r], picture);
    sprites.push_back({{"name", script.parts[r].name}, {"ticks", std::move(one["ticks"])}});
  }
  return {{"fps", scene.roles[0].sprite->fps()},
          {"size", {picture.width, picture.height}},
          {"origin", {picture.origin.x, picture.origin.y}},
          {"cost", result.cost},
          {"sprites", sprites}};
}

Result<std::vector<std::vector<std::uint32_t>>> read_places(const std::string& text,
                                                            const Scene& scene,
                                                            const std::string& name) {
  const auto bad = [&](const std::string& what) {
    return Error{ErrorCode::BadContent, name + ": " + what};
  };
  const Json file = Json::parse(text, nullptr, false);
  if (!file.is_object() || !file.contains("sprites") || !file["sprites"].is_array())
    return bad("not what `path SCENE.toml -o FILE.json` writes: `sprites` is due");
  if (file["sprites"].size() != scene.roles.size())
    return bad("sprites: " + std::to_string(file["sprites"].size()) + ", where the scene has " +
               std::to_string(scene.roles.size()));
  std::vector<std::vector<std::uint32_t>> out(scene.roles.size());
  for (std::size_t r = 0; r < out.size(); ++r) {
    const Json& one = file["sprites"][r];
    if (!one.is_object() || !one.contains("ticks") || !one["ticks"].is_array() ||
        one["ticks"].empty())
      return bad("sprites: ticks are due");
    const auto samples = scene.roles[r].sprite->samples();
    const Json& ticks = one["ticks"];
    for (std::size_t k = 0; k < ticks.size(); k += samples[out[r].back()].duration) {
      const Json* sample =
          ticks[k].is_object() && ticks[k].contains("sample") ? &ticks[k]["sample"] : nullptr;
      if (sample == nullptr || !sample->is_number_unsigned() ||
          sample->get<std::uint64_t>() >= samples.size() ||
          !samples[sample->get<std::size_t>()].kept)
        return bad("sprite " + std::to_string(r + 1) + ", frame " + std::to_string(k) +
                   ": no sample of this pack");
      const auto next = sample->get<std::uint32_t>();
      if (!out[r].empty() &&
          !std::isfinite(scene.roles[r].sprite->transition_cost(out[r].back(), next)))
        return bad("sprite " + std::to_string(r + 1) + ", frame " + std::to_string(k) +
                   ": this pack has no transition to it");
      out[r].push_back(next);
    }
  }
  return out;
}

std::string scene_csv(const SceneResult& result) {
  std::string out = "frame,sprite,sample,x,y,cost\n";
  for (std::size_t r = 0; r < result.clips.size(); ++r)
    for (std::size_t k = 0; k < result.clips[r].ticks.size(); ++k) {
      const ClipTick& t = result.clips[r].ticks[k];
      out += std::to_string(k) + "," + std::to_string(r) + "," + std::to_string(t.sample) + "," +
             fixed_text(static_cast<double>(t.position.x) / kFixedOne, 3) + "," +
             fixed_text(static_cast<double>(t.position.y) / kFixedOne, 3) + "," +
             fixed_text(t.cost, 6) + "\n";
    }
  return out;
}

}  // namespace vsprite
