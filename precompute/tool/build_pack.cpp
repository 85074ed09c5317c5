// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/build_pack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "control/actions.h"
#include "tool/budget.h"
#include "tool/report.h"
#include "tool/shadows.h"
#include "tool/stages.h"
#include "tool/views_file.h"
#include "vsprite/ground.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

std::uint16_t tag_index(std::vector<std::string>& tags, const std::string& tag) {
  const auto found = std::find(tags.begin(), tags.end(), tag);
  if (found != tags.end()) return static_cast<std::uint16_t>(found - tags.begin());
  tags.push_back(tag);
  return static_cast<std::uint16_t>(tags.size() - 1);
}

Sample make_sample(const SampleRow& row, const FilmFacts& film, bool kept) {
  const double scale = row.scale;
  Sample sample;
  sample.anchor = {static_cast<float>((row.anchor_x - row.left) * scale),
                   static_cast<float>((row.anchor_y - row.top) * scale)};
  sample.velocity = {static_cast<float>(row.velocity_x * scale),
                     static_cast<float>(row.velocity_y * scale)};
  sample.step_x = step_per_tick(sample.velocity.x, film.fps_numerator, film.fps_denominator);
  sample.step_y = step_per_tick(sample.velocity.y, film.fps_numerator, film.fps_denominator);
  sample.area = static_cast<float>(row.area * scale * scale);
  sample.scale = static_cast<float>(scale);
  sample.width =
      kept ? static_cast<std::uint16_t>(std::lround(row.width * scale)) : std::uint16_t{0};
  sample.height =
      kept ? static_cast<std::uint16_t>(std::lround(row.height * scale)) : std::uint16_t{0};
  sample.duration = static_cast<std::uint16_t>(row.duration);
  sample.clip = static_cast<std::uint32_t>(row.clip);
  sample.frame = static_cast<std::uint32_t>(row.frame);
  sample.mirror_of = row.mirror_of < 0 ? kNoSample : static_cast<std::uint32_t>(row.mirror_of);
  sample.kept = kept ? 1 : 0;
  return sample;
}

float median_side(const std::vector<Sample>& samples, std::span<const OpaqueBox> boxes) {
  std::vector<int> sides;
  for (std::size_t i = 0; i < samples.size() && i < boxes.size(); ++i)
    if (samples[i].kept == 1 && boxes[i].right > 0) sides.push_back(boxes[i].longer_side());
  if (sides.empty()) return 1;
  std::sort(sides.begin(), sides.end());
  const std::size_t half = sides.size() / 2;
  const int sum = sides.size() % 2 == 1 ? 2 * sides[half] : sides[half - 1] + sides[half];
  return static_cast<float>(sum) / 2;
}

std::vector<OpaqueBox> measure_bodies(PictureReader& reader, std::size_t count,
                                      Result<void>& state) {
  std::vector<OpaqueBox> boxes;
  for (std::size_t i = 0; i < count && state; ++i) {
    const auto picture = reader.picture(static_cast<int>(i));
    if (!picture)
      state = picture.error();
    else
      boxes.push_back(opaque_box(*picture));
  }
  return boxes;
}

// One box a tag: where 90 % of its pictures end, about the anchor.
std::vector<BodyBox> body_boxes(const SpriteData& data, std::span<const OpaqueBox> boxes) {
  std::vector<BodyBox> bodies;
  for (std::uint16_t tag = 0; tag < data.tags.size() && !boxes.empty(); ++tag) {
    std::array<std::vector<float>, 4> ends;
    bool has = false;
    for (std::size_t i = 0; i < data.samples.size(); ++i) {
      const Sample& s = data.samples[i];
      if (s.kept == 0 || s.tag != tag) continue;
      has = true;
      const OpaqueBox& box = boxes[i];
      if (box.right == 0) continue;
      ends[0].push_back(static_cast<float>(box.left) - s.anchor.x);
      ends[1].push_back(static_cast<float>(box.top) - s.anchor.y);
      ends[2].push_back(static_cast<float>(box.right) - s.anchor.x);
      ends[3].push_back(static_cast<float>(box.bottom) - s.anchor.y);
    }
    if (!has) continue;
    const auto end = [&](std::size_t side, std::size_t percent) {
      std::vector<float>& values = ends[side];
      if (values.empty()) return 0.0f;
      std::sort(values.begin(), values.end());
      return values[(values.size() - 1) * percent / 100];
    };
    bodies.push_back({tag, end(0, 5), end(1, 5), end(2, 95), end(3, 95)});
  }
  return bodies;
}

// What the cast says of a tag's box stands in the place of what was measured.
void set_bodies(const Json& cast, SpriteData& data) {
  for (const Json& clip : cast.is_array() ? cast : Json::array()) {
    if (!clip.contains("body")) continue;
    const auto side = [&](std::size_t k) { return clip["body"][k].get<float>(); };
    for (BodyBox& box : data.bodies)
      if (data.tags[box.tag] == clip.value("tag", ""))
        box = {box.tag, side(0), side(1), side(2), side(3)};
  }
}

// What the cast says happens at a film frame: at the sample that is shown then, and its mirror.
void add_events(const Json& cast, const std::vector<SampleRow>& rows, SpriteData& data) {
  for (const Json& clip : cast.is_array() ? cast : Json::array()) {
    if (!clip.contains("events")) continue;
    const std::string file = clip.value("file", "");
    const int first = clip["range"][0], last = clip["range"][1];
    for (const Json& event : clip["events"]) {
      const int frame = event["frame"];
      const std::string name = event["name"];
      std::int64_t shown = -1;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const SampleRow& row = rows[i];
        if (row.mirror_of >= 0 || row.source != file || row.frame < first || row.frame > last ||
            row.frame > frame)
          continue;
        if (shown < 0 || row.frame >= rows[static_cast<std::size_t>(shown)].frame)
          shown = static_cast<std::int64_t>(i);
      }
      if (shown < 0) continue;
      const auto known = std::find(data.event_names.begin(), data.event_names.end(), name);
      const auto index = static_cast<std::uint32_t>(known - data.event_names.begin());
      if (known == data.event_names.end()) data.event_names.push_back(name);
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (static_cast<std::int64_t>(i) == shown || rows[i].mirror_of == shown)
          data.events.push_back({static_cast<std::uint32_t>(i), index});
    }
  }
  std::sort(data.events.begin(), data.events.end());
  data.events.erase(std::unique(data.events.begin(), data.events.end()), data.events.end());
}

Json direction_json(const SpriteData& data, const DirectionReport& report) {
  Json entry = {{"name", direction_name(report.direction)},
                {"reachable", report.reachable},
                {"tracking_error_deg", nullptr},
                {"speed", report.speed}};
  if (report.tracking_error_deg) entry["tracking_error_deg"] = *report.tracking_error_deg;
  const std::string reason = unserved_reason(data, report);
  if (!reason.empty()) entry["reason"] = reason;
  return entry;
}

// The way to every tag of a cast. The pictures price what no transition leads to.
Result<void> add_actions(StageRun& run, const TransitionFile& file, SpriteData& data) {
  const ActionConfig config{.tau = run.settings.action_tau};
  if (data.tags.size() == 1 && data.tags.front().empty()) return {};
  if (!run.sprites) {
    auto loaded = load_sprites(run.project);
    if (!loaded) return loaded.error();
    run.sprites = std::move(*loaded);
  }
  const auto classifier = run.project.classifier();
  if (!classifier) return classifier.error();
  data.action_tau = static_cast<float>(config.tau);
  data.action_horizon = static_cast<std::uint32_t>(config.horizon);
  for (std::uint16_t tag = 0; tag < data.tags.size(); ++tag) {
    const auto firsts = first_samples(data.samples, tag);
    if (data.tags[tag].empty() || firsts.empty()) continue;
    const auto cuts = find_cuts(run.sprites->features, *classifier, data.samples, firsts);
    auto table = solve_action(file.costs, data.samples, tag, cuts, config);
    if (!table) return table.error();
    data.actions.push_back(std::move(*table));
  }
  return {};
}

// The floor on which the film was taken, in the sprite's pixels; no bytes where there was none.
Result<std::vector<std::uint8_t>> floor_bytes(const StageRun& run) {
  const Json* made = run.project.record("segment");
  const Json result = made == nullptr ? Json() : made->value("result", Json::object());
  if (!result.is_object() || !result.contains("floor")) return std::vector<std::uint8_t>{};
  const Json& floor = result["floor"];
  const auto number = [&floor](const char* key) { return floor.value(key, 0.0f); };
  const Ground ground{number("horizon"), number("ground_line"), number("center"), number("focal")};
  return encode_ground(scaled(ground, number("scale")));
}

// From the pack of all samples at `whole` to the one that is wanted.
Result<void> keep_budget(const StageRun& run, const std::string& whole, const FrameSource& pictures,
                         Json& result) {
  const double budget = run.settings.budget * 1e6;
  std::error_code error;
  if (static_cast<double>(fs::file_size(whole, error)) <= budget) {
    fs::rename(whole, run.pack, error);
    if (!error) return {};
    return Error{ErrorCode::CannotCreate, run.pack + ": " + error.message()};
  }
  const auto fitted = fit_pack(whole, run.pack,
                               {.bytes = budget,
                                .seed = run.settings.seed,
                                .jobs = run.settings.jobs,
                                .pictures = pictures});
  fs::remove(whole, error);
  if (!fitted)
    return Error{fitted.error().code,
                 run.pack + ": " + fitted.error().message + ": raise --budget"};
  const auto json = [](const PackMeasure& of) {
    return Json{{"bytes", of.bytes}, {"samples", of.samples}, {"turn_median", of.turn_median}};
  };
  result["budget"] = {{"whole", json(fitted->before)}, {"fitted", json(fitted->after)}};
  return {};
}

// What the stage has to say of the pack that it wrote.
Result<Json> measure_pack(const StageRun& run, Json result) {
  const auto sprite = load_pack(run.pack);
  if (!sprite) return sprite.error();
  std::error_code error;
  result["pack_bytes"] = fs::file_size(run.pack, error);
  const auto info = read_pack_info(run.pack);
  if (!info) return info.error();
  if (info->loss) result["loss"] = loss_json(*info->loss);
  result["body_length"] = sprite->data().body_length;
  result["directions"] = Json::array();
  for (const DirectionReport& report : measure_directions(*sprite, 0, run.settings.seed))
    result["directions"].push_back(direction_json(sprite->data(), report));
  return result;
}

}  // namespace

Result<SpriteData> make_sprite_data(const FilmFacts& film, const std::vector<SampleRow>& rows,
                                    const TransitionFile& file, const ValueFile& values,
                                    std::span<const OpaqueBox> boxes) {
  const CostTable& costs = file.costs;
  SpriteData data;
  data.name = fs::path(film.name).stem().string();
  data.fps_numerator = film.fps_numerator;
  data.fps_denominator = film.fps_denominator;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    data.samples.push_back(make_sample(rows[i], film, costs.kept[i] == 1));
    data.samples.back().tag = tag_index(data.tags, rows[i].tag);
    if (i < file.skip_costs.size()) data.samples.back().skip_cost = file.skip_costs[i];
  }
  const auto first = std::find(costs.kept.begin(), costs.kept.end(), std::uint8_t{1});
  if (first == costs.kept.end())
    return Error{ErrorCode::BadContent,
                 film.name + ": no sample was kept: film longer, or label more pairs"};
  data.start_sample = static_cast<std::uint32_t>(first - costs.kept.begin());
  data.row_start = costs.row_start;
  data.transitions = costs.transitions;
  data.body_length = median_side(data.samples, boxes);
  data.bodies = body_boxes(data, boxes);
  for (const Solution& solution : values.modes) data.modes.push_back(solution.mode);
  return data;
}

std::string unserved_reason(const SpriteData& data, const DirectionReport& report) {
  if (report.reachable) return {};
  const Vec2 unit = unit_vector(report.direction);
  const double least = measure_speeds(data.samples).moving;
  int moving = 0, toward = 0, kept = 0;
  double fastest = 0;
  for (const Sample& sample : data.samples) {
    const double speed = std::sqrt(double{sample.velocity.x} * sample.velocity.x +
                                   double{sample.velocity.y} * sample.velocity.y);
    fastest = std::max(fastest, speed);
    if (speed <= least) continue;
    ++moving;
    const double along =
        (double{sample.velocity.x} * unit.x + double{sample.velocity.y} * unit.y) / speed;
    if (along < 0.7071) continue;
    ++toward;
    kept += sample.kept == 1;
  }
  const std::string way(direction_name(report.direction));
  const auto frames = [](int n) {
    return std::to_string(n) + (n == 1 ? " sample moves" : " samples move");
  };
  const auto whole = [](double speed) { return std::to_string(std::lround(speed)); };
  if (moving == 0)
    return "it only sways: " + whole(fastest) + " px/s at most, and " + whole(least) +
           " count as moving";
  if (toward == 0) return "the film never moves " + way + ": film some seconds of it";
  if (kept == 0)
    return frames(toward) +
           " that way, but no smooth jump leads to them and back: film more ways in and out";
  if (report.speed < least)
    return frames(kept) + " that way, but none for long: it only sways, and gets on at " +
           whole(report.speed) + " px/s where " + whole(least) + " count as moving";
  return frames(kept) +
         " that way, but no run of them keeps to it: film more of it, with turns into it and out "
         "of it";
}

Result<Json> write_pack(StageRun& run) {
  const auto film = run.project.film();
  if (!film) return film.error();
  const auto rows = run.project.samples();
  if (!rows) return rows.error();
  const auto file = run.project.transitions(rows->size());
  if (!file) return file.error();
  const auto values = run.project.values(rows->size());
  if (!values) return values.error();

  PictureReader reader(run.project, *rows);
  Result<void> state;
  const std::vector<OpaqueBox> boxes =
      run.sprites ? run.sprites->boxes : measure_bodies(reader, rows->size(), state);
  if (!state) return state.error();
  auto data = make_sprite_data(*film, *rows, *file, *values, boxes);
  if (!data) return data.error();
  if (auto added = add_actions(run, *file, *data); !added) return added.error();
  if (auto added = add_shadows(run.project, *rows, *data); !added) return added.error();
  if (const Json* made = run.project.record("segment")) {
    const Json cast = made->value("result", Json::object()).value("cast", Json());
    add_events(cast, *rows, *data);
    set_bodies(cast, *data);
  }

  PictureReader pictures(run.project, *rows);
  const double count = static_cast<double>(rows->size());
  const FrameSource source = [&](std::uint32_t sample) {
    if (run.listener.progress) run.listener.progress(sample / count);
    return pictures.picture(static_cast<int>(sample));
  };
  auto floor = floor_bytes(run);
  if (!floor) return floor.error();
  auto puppets = puppet_sections(run.project.folder());
  if (!puppets) return puppets.error();
  const PackExtra extras[] = {{"GRND", std::move(*floor)},
                              {"PUPT", std::move(puppets->puppets)},
                              {"PSET", std::move(puppets->sets)}};
  const bool fits = run.settings.budget == 0;
  const PictureForm form =
      run.settings.pictures == "gpu" ? PictureForm::Blocks : PictureForm::Exact;
  const std::string path = fits ? run.pack : run.pack + ".tmp.whole";
  if (auto saved = save_pack(path, *data, source, extras, form); !saved) return saved.error();

  Json result = Json::object();
  if (auto kept = fits ? Result<void>() : keep_budget(run, path, source, result); !kept)
    return kept.error();
  return measure_pack(run, std::move(result));
}

}  // namespace vsprite
