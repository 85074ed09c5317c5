// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// loops: the best seamless loop of every direction and tag, printed, and exported.
#include "control/loops.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>

#include "tool/commands/verbs.h"
#include "tool/export.h"
#include "tool/files.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

// A loop and what it is of.
struct Found {
  std::string name;
  SeamlessLoop loop;
  double seam = 0;
};

// What is looked for: a name, and the samples that the loop may show.
struct Wanted {
  std::string name;
  std::vector<std::uint8_t> allowed;
};

Result<LoopLength> parse_length(const std::string& text) {
  LoopLength length;
  const char* const end = text.data() + text.size();
  auto read = std::from_chars(text.data(), end, length.least);
  length.most = length.least;
  if (read.ec == std::errc{} && end - read.ptr > 2 && read.ptr[0] == '.' && read.ptr[1] == '.')
    read = std::from_chars(read.ptr + 2, end, length.most);
  if (read.ec != std::errc{} || read.ptr != end || length.least < 1 || length.most < length.least ||
      length.most > 1000)
    return Error{ErrorCode::BadSetting,
                 "--length " + text + ": ticks from 1 to 1000 are due, N or LEAST..MOST"};
  return length;
}

std::vector<std::uint8_t> samples_of_tag(const Sprite& sprite, std::size_t tag) {
  std::vector<std::uint8_t> out;
  for (const Sample& s : sprite.samples()) out.push_back(s.kept == 1 && s.tag == tag ? 1 : 0);
  return out;
}

// Every direction, rest and every named tag; or the one that --direction or --tag names.
Result<std::vector<Wanted>> what_is_wanted(const Settings& settings, const Sprite& sprite) {
  std::vector<Wanted> out;
  const bool all = settings.only_tag.empty() && settings.only_direction.empty();
  for (int d = 0; d < kDirectionCount; ++d) {
    const auto direction = static_cast<Direction>(d);
    const std::string name(direction_name(direction));
    if (direction != Direction::None && (all || name == settings.only_direction))
      out.push_back({name, samples_towards(sprite, direction)});
  }
  std::vector<std::string> names;
  for (std::size_t t = 0; t < sprite.data().tags.size(); ++t) {
    const std::string& tag = sprite.data().tags[t];
    if (tag.empty()) continue;
    names.push_back(tag);
    if (all || tag == settings.only_tag) out.push_back({tag, samples_of_tag(sprite, t)});
  }
  if (settings.only_tag.empty() ||
      std::find(names.begin(), names.end(), settings.only_tag) != names.end())
    return out;
  const std::string near = nearest_name(settings.only_tag, names);
  return Error{ErrorCode::BadSetting, "--tag " + settings.only_tag + ": " + settings.film +
                                          " has no such tag" +
                                          (near.empty() ? "" : ": did you mean `" + near + "`?")};
}

Json loop_json(const Found& found) {
  return {{"name", found.name},      {"ticks", found.loop.ticks}, {"jumps", found.loop.jumps},
          {"cost", found.loop.cost}, {"seam", found.seam},        {"samples", found.loop.samples}};
}

std::string loop_text(const Found& found) {
  char text[160];
  std::snprintf(text, sizeof text, "%-12s %4d ticks, %d jump%s of %.2f in all, seam %.2f\n",
                found.name.c_str(), found.loop.ticks, found.loop.jumps,
                found.loop.jumps == 1 ? "" : "s", found.loop.cost, found.seam);
  return text;
}

// The loops in a format of `export`: a smaller sprite of their samples, and one run each.
Result<Json> export_loops(const Settings& settings, const Sprite& sprite,
                          const std::vector<Found>& loops, const StageListener& listener) {
  const auto format = find_export_format(settings.to);
  if (!format) return format.error();
  ExportJob job{.film = sprite, .progress = listener.progress};
  job.godot = settings.godot == "3" ? 3 : 4;
  job.output = settings.output;
  if (job.output.empty()) job.output = fs::path(settings.film).stem().string() + "-loops";
  std::vector<std::uint8_t> shown(sprite.samples().size(), 0);
  for (const Found& found : loops)
    for (const std::uint32_t i : found.loop.samples) shown[i] = 1;
  job.choice = take_samples(sprite.data(), shown);
  for (const Found& found : loops) {
    PlayedRun run{found.name, {}, true, found.seam};
    std::replace(run.name.begin(), run.name.end(), '+', '-');
    for (const std::uint32_t i : found.loop.samples) {
      const auto at = std::lower_bound(job.choice.from.begin(), job.choice.from.end(), i);
      run.samples.push_back(static_cast<std::uint32_t>(at - job.choice.from.begin()));
    }
    job.runs.push_back(std::move(run));
  }
  if (auto made = make_folder(job.output); !made) return made.error();
  return (*format)->write(job);
}

}  // namespace

Result<int> run_loops(const Settings& settings, Console& console) {
  if (settings.film.empty()) return Error{ErrorCode::BadSetting, "a pack is due: PACK.vsp"};
  const auto length = parse_length(settings.length);
  if (!length) return length.error();
  if (!settings.to.empty()) {
    const auto format = find_export_format(settings.to);
    if (!format) return format.error();
    if ((*format)->need != ExportNeed::Runs)
      return Error{ErrorCode::BadSetting,
                   "--to " + settings.to + ": holds no loops: a sheet or a moving picture is due"};
  } else if (!settings.output.empty()) {
    return Error{ErrorCode::BadSetting, "-o " + settings.output + ": --to FORMAT is due with it"};
  }
  const auto sprite = load_pack(settings.film);
  if (!sprite) return sprite.error();
  const auto wanted = what_is_wanted(settings, *sprite);
  if (!wanted) return wanted.error();
  const StageListener listener = console.listener();
  listener.begin("loops");
  std::vector<Found> loops;
  std::string missing;
  for (const Wanted& want : *wanted) {
    auto loop = find_loop(*sprite, want.allowed, *length);
    if (!loop) {
      missing += (missing.empty() ? "" : ", ") + want.name;
      continue;
    }
    const auto seam = measure_seam(*sprite, *loop);
    if (!seam) return seam.error();
    loops.push_back({want.name, std::move(*loop), *seam});
  }
  if (loops.empty())
    return Error{ErrorCode::BadContent,
                 settings.film + ": no loop of " + settings.length + " ticks for " + missing +
                     ": another --length, or a film with more of it, is due"};
  Json document{{"length", settings.length}, {"loops", Json::array()}, {"missing", missing}};
  std::string text;
  for (const Found& found : loops) {
    text += loop_text(found);
    document["loops"].push_back(loop_json(found));
  }
  if (!missing.empty()) text += "none of that length: " + missing + "\n";
  if (!settings.to.empty()) {
    const auto wrote = export_loops(settings, *sprite, loops, listener);
    if (!wrote) return wrote.error();
    document["folder"] = (*wrote)["folder"];
    text += (*wrote)["folder"].get<std::string>() + ": " + settings.to + "\n";
  }
  listener.end("loops", false);
  console.text(text);
  console.document(document);
  if (settings.to.empty())
    console.next("vsprite loops " + shell_word(settings.film) + " --to apng");
  return 0;
}

}  // namespace vsprite
