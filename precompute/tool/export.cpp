// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/export.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numeric>

#include "tool/files.h"
#include "tool/settings.h"
#include "vsprite/actor.h"
#include "vsprite/policy.h"
#include "vsprite/record.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

constexpr int kPageSide = 2048;
constexpr int kGap = 1;  // px around a picture, so that a filter finds nothing of its neighbour

// Where a picture lies in the atlas.
struct Place {
  int page = 0, x = 0, y = 0;
};
struct Page {
  int width = 0, height = 0;
};
struct Atlas {
  std::vector<Place> places;  // (n)
  std::vector<Page> pages;
};

// Shelves: the tallest first, one beside the other, then the next row, then the next page.
Result<Atlas> arrange(const SpriteData& data) {
  Atlas atlas;
  atlas.places.resize(data.samples.size());
  std::vector<std::size_t> order(data.samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return data.samples[a].height > data.samples[b].height;
  });
  int x = kGap, y = kGap, shelf = 0;
  atlas.pages.push_back({});
  for (const std::size_t i : order) {
    const int width = data.samples[i].width, height = data.samples[i].height;
    if (width + 2 * kGap > kPageSide || height + 2 * kGap > kPageSide)
      return Error{ErrorCode::LimitExceeded, data.name + ": a picture of " + std::to_string(width) +
                                                 "x" + std::to_string(height) +
                                                 " px, a page holds " +
                                                 std::to_string(kPageSide - 2 * kGap) +
                                                 ": build it with a smaller --max-size"};
    if (x + width + kGap > kPageSide) x = kGap, y += shelf + kGap, shelf = 0;
    if (y + height + kGap > kPageSide) {
      atlas.pages.push_back({});
      x = y = kGap, shelf = 0;
    }
    atlas.places[i] = {static_cast<int>(atlas.pages.size()) - 1, x, y};
    x += width + kGap;
    shelf = std::max(shelf, height);
    atlas.pages.back().width = std::max(atlas.pages.back().width, x);
    atlas.pages.back().height = std::max(atlas.pages.back().height, y + height + kGap);
  }
  return atlas;
}

std::string numbered(const char* stem, std::size_t number, int digits) {
  char name[64];
  std::snprintf(name, sizeof name, "%s-%0*zu.png", stem, digits, number);
  return name;
}

Result<Image> straight_picture(const ExportJob& job, std::size_t k) {
  Image image;
  if (auto ok = job.film.decode_frame(job.choice.from[k], image); !ok) return ok.error();
  unpremultiply(image);
  return image;
}

// The pages as page-0.png ... in the folder.
Result<void> write_pages(const ExportJob& job, const Atlas& atlas) {
  std::size_t done = 0;
  for (std::size_t p = 0; p < atlas.pages.size(); ++p) {
    const Page& page = atlas.pages[p];
    Image canvas{page.width, page.height,
                 std::vector<std::uint8_t>(std::size_t{4} * static_cast<std::size_t>(page.width) *
                                           static_cast<std::size_t>(page.height))};
    for (std::size_t k = 0; k < atlas.places.size(); ++k) {
      const Place& at = atlas.places[k];
      if (static_cast<std::size_t>(at.page) != p) continue;
      const auto picture = straight_picture(job, k);
      if (!picture) return picture.error();
      for (int row = 0; row < picture->height; ++row)
        std::copy_n(picture->rgba.begin() + std::ptrdiff_t{4} * row * picture->width,
                    4 * picture->width,
                    canvas.rgba.begin() + std::ptrdiff_t{4} * ((at.y + row) * page.width + at.x));
      if (job.progress)
        job.progress(static_cast<double>(++done) / static_cast<double>(atlas.places.size()));
    }
    const std::string path = (fs::path(job.output) / numbered("page", p, 1)).string();
    if (auto saved = save_png(path, canvas); !saved) return saved;
  }
  return {};
}

Json pages_json(const Atlas& atlas) {
  Json pages = Json::array();
  for (std::size_t p = 0; p < atlas.pages.size(); ++p)
    pages.push_back({{"file", numbered("page", p, 1)},
                     {"width", atlas.pages[p].width},
                     {"height", atlas.pages[p].height}});
  return pages;
}

Result<void> write_json(const ExportJob& job, const std::string& name, const Json& document) {
  return write_file((fs::path(job.output) / name).string(),
                    document.dump(-1, ' ', true, Json::error_handler_t::replace) + "\n");
}

Json report(const ExportJob& job, std::size_t pages) {
  return {{"samples", job.choice.from.size()}, {"pages", pages}, {"folder", job.output}};
}

Result<Json> write_table(const ExportJob& job) {
  const auto atlas = arrange(job.choice.data);
  if (!atlas) return atlas.error();
  if (auto wrote = write_pages(job, *atlas); !wrote) return wrote.error();
  std::vector<Json> places;
  for (const Place& at : atlas->places)
    places.push_back({{"page", at.page}, {"x", at.x}, {"y", at.y}});
  Json document = character_json(job.choice.data, places);
  document["pages"] = pages_json(*atlas);
  if (auto wrote = write_json(job, "character.json", document); !wrote) return wrote.error();
  return report(job, atlas->pages.size());
}

Result<Json> write_png_sequence(const ExportJob& job) {
  std::vector<Json> places;
  const std::size_t count = job.choice.from.size();
  for (std::size_t k = 0; k < count; ++k) {
    const auto picture = straight_picture(job, k);
    if (!picture) return picture.error();
    const std::string name = numbered("sample", k, 6);
    if (auto saved = save_png((fs::path(job.output) / name).string(), *picture); !saved)
      return saved.error();
    places.push_back({{"file", name}});
    if (job.progress) job.progress(static_cast<double>(k + 1) / static_cast<double>(count));
  }
  const Json document = character_json(job.choice.data, places);
  if (auto wrote = write_json(job, "character.json", document); !wrote) return wrote.error();
  return report(job, 0);
}

constexpr ExportFormat kFormats[] = {
    {"table", "atlas pages and character.json: one lookup a frame steers it", write_table},
    {"png-seq", "one PNG a sample, and the same character.json", write_png_sequence},
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

Result<const ExportFormat*> find_export_format(const std::string& name) {
  std::vector<std::string> names;
  std::string all;
  for (const ExportFormat& format : kFormats) {
    if (format.name == name) return &format;
    names.emplace_back(format.name);
    all += (all.empty() ? "" : ", ") + names.back();
  }
  const std::string near = nearest_name(name, names);
  return Error{
      ErrorCode::BadSetting,
      (name.empty() ? std::string("--to FORMAT is due") : "--to " + name + ": no such format") +
          (near.empty() ? ": " + all : ": did you mean `" + near + "`?")};
}

Result<SampleChoice> choose_for_export(const Sprite& sprite, int limit, std::uint64_t seed,
                                       int jobs) {
  SpriteData data = sprite.data();
  for (ControlMode& mode : data.modes) mode.plays_through = false;
  ChoiceConfig config{.seed = seed, .jobs = jobs};
  config.limit = limit > 0 ? limit : static_cast<double>(data.samples.size());
  return choose_samples(data, config);
}

Json character_json(const SpriteData& data, const std::vector<Json>& places) {
  Json out = {{"format", "vsprite-table"},
              {"version", 1},
              {"name", data.name},
              {"fps", static_cast<double>(data.fps_numerator) / data.fps_denominator},
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
