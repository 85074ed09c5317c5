// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/export.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tool/atlas.h"
#include "tool/budget.h"
#include "tool/files.h"
#include "tool/page.h"
#include "tool/settings.h"
#include "vsprite/actor.h"
#include "vsprite/policy.h"
#include "vsprite/record.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

Json pages_json(const Atlas& atlas) {
  Json pages = Json::array();
  for (std::size_t p = 0; p < atlas.pages.size(); ++p)
    pages.push_back({{"file", numbered_png("page", p)},
                     {"width", atlas.pages[p].width},
                     {"height", atlas.pages[p].height}});
  return pages;
}

Result<Json> write_table(const ExportJob& job) {
  const auto atlas = arrange_atlas(job.choice.data.name, job.choice.data.samples);
  if (!atlas) return atlas.error();
  if (auto wrote = write_atlas(job.film, job.choice.from, *atlas, job.output, job.progress); !wrote)
    return wrote.error();
  std::vector<Json> places;
  for (const AtlasPlace& at : atlas->places)
    places.push_back({{"page", at.page}, {"x", at.x}, {"y", at.y}});
  Json document = character_json(job.choice.data, places);
  document["pages"] = pages_json(*atlas);
  if (auto wrote = write_json(job, "character.json", document); !wrote) return wrote.error();
  return export_report(job, job.choice.from.size(), atlas->pages.size());
}

Result<Json> write_png_sequence(const ExportJob& job) {
  std::vector<Json> places;
  const std::size_t count = job.choice.from.size();
  for (std::size_t k = 0; k < count; ++k) {
    const auto picture = straight_picture(job.film, job.choice.from[k]);
    if (!picture) return picture.error();
    const std::string name = numbered_png("sample", k, 6);
    if (auto saved = save_png((fs::path(job.output) / name).string(), *picture); !saved)
      return saved.error();
    places.push_back({{"file", name}});
    if (job.progress) job.progress(static_cast<double>(k + 1) / static_cast<double>(count));
  }
  const Json document = character_json(job.choice.data, places);
  if (auto wrote = write_json(job, "character.json", document); !wrote) return wrote.error();
  return export_report(job, count, 0);
}

std::string megabytes(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f MB", bytes / 1e6);
  return text;
}

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

// The pack with so few samples that it takes `bytes`, through a file beside the output.
Result<std::string> smaller_pack(const ExportJob& job, double bytes, Json& report) {
  const std::string path = job.output + ".tmp." + std::to_string(getpid());
  const auto fitted =
      fit_pack(job.pack, path, {.bytes = bytes, .seed = job.seed, .jobs = job.jobs});
  auto pack = fitted ? read_file(path) : Result<std::string>(fitted.error());
  std::error_code ignored;
  fs::remove(path, ignored);
  if (!fitted && fitted.error().code == ErrorCode::BadContent)
    return Error{ErrorCode::BadContent, fitted.error().message + ": raise --budget"};
  if (!pack) return pack.error();
  report["samples"] = fitted->after.samples;
  report["samples_before"] = fitted->before.samples;
  report["turn_median"] = fitted->after.turn_median;
  report["turn_median_before"] = fitted->before.turn_median;
  return pack;
}

Result<Json> write_page(const ExportJob& job) {
  const auto place = job.page.empty() ? find_player_page() : job.page;
  if (!place) return place.error();
  const auto text = read_file(*place);
  if (!text) return text.error();
  const std::string& title = job.film.data().name;
  auto page = make_page(*text, *place, bytes_of(job.pack_bytes), title);
  if (!page) return page.error();
  Json report{{"file", job.output}, {"bytes", 0}, {"pack_bytes", job.pack_bytes.size()}};
  const double limit = job.page_limit * 1e6;
  if (static_cast<double>(page->size()) > limit) {
    // In base64 three bytes take four.
    const double frame = static_cast<double>(page->size()) -
                         std::ceil(static_cast<double>(job.pack_bytes.size()) / 3) * 4;
    if (frame >= limit)
      return Error{ErrorCode::LimitExceeded, *place + ": takes " + megabytes(frame) +
                                                 " without a pack, at most " + megabytes(limit) +
                                                 " are wanted: raise --budget"};
    const auto pack = smaller_pack(job, std::floor((limit - frame) / 4) * 3, report);
    if (!pack) return pack.error();
    report["pack_bytes"] = pack->size();
    page = make_page(*text, *place, bytes_of(*pack), title);
    if (!page) return page.error();
  }
  report["bytes"] = page->size();
  if (auto wrote = write_file(job.output, *page); !wrote) return wrote.error();
  return report;
}

constexpr ExportFormat kFormats[] = {
    {"html", ExportNeed::Pack, write_page},
    {"table", ExportNeed::Samples, write_table},
    {"png-seq", ExportNeed::Samples, write_png_sequence},
    {"sheet+aseprite-json", ExportNeed::Runs, write_aseprite},
    {"texturepacker-json", ExportNeed::Runs, write_texture_packer},
    {"godot-tres", ExportNeed::Runs, write_godot},
    {"apng", ExportNeed::Runs, write_apngs},
    {"gif", ExportNeed::Runs, write_gifs},
    {"webm", ExportNeed::Runs, write_webms},
    {"mkv-ffv1", ExportNeed::Runs, write_ffv1s},
};

// One command's tables in one mode, made by the engine's own step.
struct CommandTable {
  std::vector<std::uint32_t> next;   // (stages, n): stage * n + sample
  std::vector<std::int64_t> dx, dy;  // (n) 1/65536 px a tick
};

CommandTable command_table(const Sprite& sprite, int mode, std::uint32_t group) {
  const auto n = static_cast<std::uint32_t>(sprite.samples().size());
  const std::uint32_t stages = sprite.data().modes[static_cast<std::size_t>(mode)].stages;
  CommandTable table;
  for (std::uint32_t stage = 0; stage < stages; ++stage) {
    for (std::uint32_t i = 0; i < n; ++i) {
      Actor actor = make_actor(sprite, {}, 0, mode);
      actor.sample = i;
      actor.shown = sprite.samples()[i].duration;
      actor.group = actor.bent = static_cast<std::uint8_t>(group);
      actor.stage = static_cast<std::uint8_t>(stage);
      step(sprite, actor);
      table.next.push_back(actor.stage * n + actor.sample);
      if (stage > 0) continue;
      table.dx.push_back(actor.position.x);
      table.dy.push_back(actor.position.y);
    }
  }
  return table;
}

Json mode_json(const Sprite& sprite, int m) {
  const ControlMode& mode = sprite.data().modes[static_cast<std::size_t>(m)];
  Json json = {{"stages", mode.stages}, {"follow", Json::array()}, {"served", Json::array()}};
  for (const char* key : {"next", "dx", "dy"}) json[key] = Json::array();
  for (int d = 0; d < kDirectionCount; ++d) {
    const Direction followed = mode.table_of[static_cast<std::size_t>(d)];
    json["follow"].push_back(static_cast<int>(followed));
    if (d < kCompassCount) json["served"].push_back((mode.served >> d & 1u) != 0);
    CommandTable table = command_table(sprite, m, group_of(mode, static_cast<Direction>(d)));
    json["next"].push_back(std::move(table.next));
    json["dx"].push_back(std::move(table.dx));
    json["dy"].push_back(std::move(table.dy));
  }
  return json;
}

}  // namespace

std::span<const ExportFormat> export_formats() { return kFormats; }

std::string export_names() {
  std::string all;
  for (const ExportFormat& format : kFormats)
    all += (all.empty() ? "" : "|") + std::string(format.name);
  return all;
}

Result<const ExportFormat*> find_export_format(const std::string& name) {
  std::vector<std::string> names;
  for (const ExportFormat& format : kFormats) {
    if (format.name == name) return &format;
    names.emplace_back(format.name);
  }
  const std::string near = nearest_name(name, names);
  return Error{ErrorCode::BadSetting,
               (name.empty() ? std::string("--to is due") : "--to " + name + ": no such format") +
                   (near.empty() ? ": " + export_names() : ": did you mean `" + near + "`?")};
}

double fps_of(const SpriteData& data) {
  return static_cast<double>(data.fps_numerator) / data.fps_denominator;
}

Json export_report(const ExportJob& job, std::size_t samples, std::optional<std::size_t> pages) {
  Json report{{"samples", samples}};
  if (pages) report["pages"] = *pages;
  for (const PlayedRun& run : job.runs) report["runs"].push_back(run.name);
  report["folder"] = job.output;
  return report;
}

Result<void> write_json(const ExportJob& job, const std::string& name, const Json& document) {
  return write_file((fs::path(job.output) / name).string(),
                    document.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n");
}

Result<SampleChoice> choose_for_export(const Sprite& sprite, int limit, std::uint64_t seed,
                                       int jobs) {
  SpriteData data = sprite.data();
  for (ControlMode& mode : data.modes) mode.plays_through = false;
  ChoiceConfig config{.seed = seed, .jobs = jobs};
  config.limit = limit > 0 ? limit : static_cast<double>(data.samples.size());
  auto choice = choose_samples(data, config);
  if (choice) return choice;
  if (choice.error().code == ErrorCode::BadSetting)
    return Error{ErrorCode::BadContent,
                 data.name + ": its tables are none that were solved from a film"};
  const bool too_few = limit > 0 && choice.error().code == ErrorCode::BadContent;
  return Error{choice.error().code,
               choice.error().message + (too_few ? ": raise --samples, or 0 for all" : "")};
}

Json character_json(const SpriteData& data, const std::vector<Json>& places) {
  Json out = {{"format", "vsprite-table"},
              {"version", 1},
              {"name", data.name},
              {"fps", fps_of(data)},
              {"unit", 65536},
              {"body_length", data.body_length},
              {"tags", data.tags},
              {"start", data.start_sample},
              {"default_mode", data.modes.front().name},
              {"directions", Json::array()},
              {"boxes", Json::array()},
              {"events", Json::array()},
              {"samples", Json::array()},
              {"modes", Json::object()}};
  for (int d = 0; d < kDirectionCount; ++d)
    out["directions"].push_back(direction_name(static_cast<Direction>(d)));
  for (const BodyBox& box : data.bodies)
    out["boxes"].push_back({{"tag", box.tag},
                            {"left", box.left},
                            {"top", box.top},
                            {"right", box.right},
                            {"bottom", box.bottom}});
  for (const SampleEvent& event : data.events)
    out["events"].push_back({{"sample", event.sample}, {"name", data.event_names[event.name]}});
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    const Sample& s = data.samples[i];
    Json sample = places[i];
    sample["w"] = s.width;
    sample["h"] = s.height;
    sample["anchor_x"] = s.anchor.x;
    sample["anchor_y"] = s.anchor.y;
    sample["velocity_x"] = s.velocity.x;
    sample["velocity_y"] = s.velocity.y;
    sample["duration"] = s.duration;
    sample["tag"] = s.tag;
    sample["frame"] = s.frame;
    out["samples"].push_back(std::move(sample));
  }
  const auto sprite = make_sprite(data);
  for (int m = 0; sprite && m < static_cast<int>(data.modes.size()); ++m)
    out["modes"][data.modes[static_cast<std::size_t>(m)].name] = mode_json(*sprite, m);
  return out;
}

}  // namespace vsprite
