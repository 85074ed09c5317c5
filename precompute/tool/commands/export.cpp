// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/export.h"

#include <cstdio>
#include <filesystem>

#include "tool/commands/verbs.h"
#include "tool/files.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

PackReader reader_of(const std::string& pack, const std::string& name) {
  return {pack.size(), name, [&pack](std::uint64_t offset, std::span<std::uint8_t> out) {
            pack.copy(reinterpret_cast<char*>(out.data()), out.size(),
                      static_cast<std::size_t>(offset));
            return true;
          }};
}

// Chooses the samples that a format wants, and lays down what is played.
Result<void> fill(ExportJob& job, ExportNeed need, const Settings& settings) {
  const bool as_filmed = settings.order == "film";
  if (need == ExportNeed::Runs && as_filmed && settings.samples == 0) {
    std::vector<std::uint8_t> kept;
    for (const Sample& s : job.film.samples()) kept.push_back(s.kept == 1 ? 1 : 0);
    job.choice = take_samples(job.film.data(), kept);
  } else {
    auto choice = choose_for_export(job.film, settings.samples, settings.seed, settings.jobs);
    if (!choice) return Error{choice.error().code, settings.film + ": " + choice.error().message};
    job.choice = std::move(*choice);
  }
  if (need == ExportNeed::Runs)
    job.runs = as_filmed ? film_runs(job.choice.data) : direction_runs(job.choice.data);
  return {};
}

std::string summary(const Json& wrote, const ExportFormat& format, const Sprite& sprite) {
  char text[64];
  if (format.need == ExportNeed::Pack) {
    std::snprintf(text, sizeof text, ": %.1f MB, ", static_cast<double>(wrote["bytes"]) / 1e6);
    std::string page = wrote["file"].get<std::string>() + text +
                       "opens by a double click, steered with arrow keys, W A S D or a finger\n";
    if (!wrote.contains("samples")) return page;
    const auto figure = [&](const char* key) {
      std::snprintf(text, sizeof text, "%.0f", wrote[key].get<double>());
      return std::string(text);
    };
    return page + figure("samples") + " samples of " + figure("samples_before") +
           " fit the budget, and turn in " + figure("turn_median") +
           " frames in the median where all turn in " + figure("turn_median_before") + "\n";
  }
  std::string runs = "character.json steers them";
  if (format.need == ExportNeed::Runs) {
    runs.clear();
    for (const Json& name : wrote["runs"])
      runs += (runs.empty() ? "" : ", ") + name.get<std::string>();
  }
  return wrote["folder"].get<std::string>() + ": " +
         std::to_string(wrote["samples"].get<std::size_t>()) + " samples of " +
         std::to_string(sprite.samples().size()) + ", " + runs + "\n";
}

}  // namespace

Result<int> run_export(const Settings& settings, Console& console) {
  if (settings.film.empty())
    return Error{ErrorCode::BadSetting, "a pack is due: `vsprite export PACK --to html`"};
  const auto format = find_export_format(settings.to);
  if (!format) return format.error();
  const ExportFormat& to = **format;
  // A page holds the pack itself: then it is read once, as a whole.
  const auto pack =
      to.need == ExportNeed::Pack ? read_file(settings.film) : Result<std::string>(std::string());
  if (!pack) return pack.error();
  const auto sprite = to.need == ExportNeed::Pack ? load_pack(reader_of(*pack, settings.film))
                                                  : load_pack(settings.film);
  if (!sprite) return sprite.error();
  const bool is_file = to.need == ExportNeed::Pack;
  const StageListener listener = console.listener();
  ExportJob job{.film = *sprite, .progress = listener.progress};
  job.godot = settings.godot == "3" ? 3 : 4;
  job.pack = settings.film;
  job.pack_bytes = *pack;
  job.seed = settings.seed;
  job.jobs = settings.jobs;
  job.page = settings.page;
  job.page_limit = settings.page_limit;
  job.output = !settings.output.empty()
                   ? settings.output
                   : fs::path(settings.film).stem().string() + (is_file ? "." : "-") + settings.to;
  listener.begin("export");
  if (!is_file) {
    if (auto made = make_folder(job.output); !made) return made.error();
    if (auto filled = fill(job, to.need, settings); !filled) return filled.error();
  }
  auto wrote = to.write(job);
  if (!wrote) return wrote.error();
  listener.end("export", false);
  (*wrote)["to"] = settings.to;
  console.text(summary(*wrote, to, *sprite));
  console.document(*wrote);
  if (!is_file) console.next("vsprite play " + shell_word(settings.film));
  return 0;
}

}  // namespace vsprite
