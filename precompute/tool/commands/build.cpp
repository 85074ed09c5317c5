// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// build and its five stages.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tool/cast_file.h"
#include "tool/commands/verbs.h"
#include "tool/preview.h"
#include "tool/report.h"
#ifdef VSPRITE_WINDOW
#include "window/key.h"
#endif
#ifdef VSPRITE_MPI
#include "tool/ranks.h"
#endif

namespace vsprite {
namespace {

namespace fs = std::filesystem;

constexpr int kSegment = 0, kPack = 4;

/// Where a run reads and writes.
struct Places {
  std::string film, work, pack;
};

/// A file is replaced by its like alone, one that begins with the same bytes, or is empty: a film
/// that was named as the output by mistake stays. Errors: BadSetting.
Result<void> check_output(const std::string& path, std::string_view begin, const char* what) {
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) == 0) return {};
  std::string found(begin.size(), '\0');
  std::ifstream(path, std::ios::binary)
      .read(found.data(), static_cast<std::streamsize>(found.size()));
  if (found == begin) return {};
  return Error{ErrorCode::BadSetting, path + ": is there already, is no " + what +
                                          " and stays: name another file with -o"};
}

Result<Places> find_places(const Settings& settings, int first) {
  const bool needs_film = first == kSegment;
  const std::string& operand = settings.film;
  std::error_code error;
  if (operand.empty() && (needs_film || settings.work.empty()))
    return Error{ErrorCode::BadSetting, needs_film
                                            ? "a film is due: `vsprite build FILM`"
                                            : "a work folder is due: FILM, PACK or --work DIR"};
  if (needs_film && fs::is_directory(operand, error)) {
    const auto clips = find_clips(operand);
    if (!clips) return clips.error();
  }
  if (needs_film && fs::path(operand).extension() == ".vsp")
    return Error{ErrorCode::BadFormat, operand + ": is a pack, a film is due: `vsprite play " +
                                           shell_word(operand) + "` plays a pack as it is"};
  if (needs_film && !fs::exists(operand, error)) {
    const auto pictures = is_picture_source(operand)
                              ? find_pictures(operand)
                              : Result<std::vector<std::string>>(std::vector<std::string>{});
    if (!pictures) return pictures.error();
    if (pictures->empty() || pictures->front() == operand)
      return Error{ErrorCode::NotFound, operand + ": no such file"};
  }
  const std::string work = find_work_folder(settings.work, operand, settings.output);
  return Places{needs_film ? operand : "", work, find_pack_path(work, operand, settings.output)};
}

Result<std::vector<StageOutcome>> run_range(const Places& places, const Settings& settings,
                                            Console& console, int first, int last,
                                            const Sharing& sharing) {
  if (last == kPack)
    if (auto free = check_output(places.pack, "\x89VSP", "pack"); !free) return free.error();
  auto project = Project::open(places.work, first == kSegment);
  if (!project) return project.error();
  if (last == kPack) {
    const fs::path pack(places.pack);
    const std::string folder = pack.parent_path().string();
    remove_stale_temporaries(folder.empty() ? "." : folder, pack.filename().string() + ".tmp.");
  }
  StageRun run{*project, settings, places.film, places.pack, console.listener()};
  run.sharing = sharing;
  return run_stages(run, first, last);
}

/// Runs `first`, and under mpirun in the first process alone.
Result<int> run_shared(const Settings& settings,
                       const std::function<Result<int>(const Sharing&)>& first) {
#ifdef VSPRITE_MPI
  return run_over_ranks(find_work_folder(settings.work, settings.film, settings.output),
                        settings.jobs, first);
#else
  (void)settings;
  return first({});
#endif
}

/// Where the pictures lie that show what was cut out, and what was left out.
std::string pictures_text(const Places& places, const StageOutcome& segment) {
  std::error_code error;
  const std::string sheet = places.work + "/contact.png";
  if (!fs::exists(sheet, error)) return {};
  const bool left_out = !segment.result.value("dropped", Json::object()).empty();
  return "look at " + sheet + (left_out ? " and " + places.work + "/dropped" : "") + "\n";
}

Result<int> run_one(const Settings& settings, Console& console, int stage, const Sharing& sharing) {
  const auto places = find_places(settings, stage);
  if (!places) return places.error();
  const auto outcomes = run_range(*places, settings, console, stage, stage, sharing);
  if (!outcomes) return outcomes.error();
  console.text(build_text(*outcomes) +
               (stage == kSegment ? pictures_text(*places, outcomes->front()) : ""));
  console.document(build_json(*outcomes));
  if (stage == kPack)
    console.next("vsprite play " + shell_word(places->pack));
  else
    console.next("vsprite " + std::string(kStages[stage + 1]) + " --work " +
                 shell_word(places->work));
  return 0;
}

Result<int> run_all(const Settings& settings, Console& console, const Sharing& sharing) {
  const auto places = find_places(settings, kSegment);
  if (!places) return places.error();
  const auto outcomes = run_range(*places, settings, console, kSegment, kPack, sharing);
  if (!outcomes) return outcomes.error();
  console.text(places->film + " -> " + places->pack + (settings.draft ? ", a draft" : "") + "\n\n" +
               build_text(*outcomes) + "\n" + pictures_text(*places, outcomes->front()));
  console.document(build_json(*outcomes));
  console.next("vsprite play " + shell_word(places->pack));
  return 0;
}

Result<int> run_preview(const Settings& settings, Console& console) {
  const auto places = find_places(settings, kSegment);
  if (!places) return places.error();
  if (is_cast(places->film))
    return Error{ErrorCode::BadFormat,
                 places->film + ": is a cast, with --preview a film is due: one of its clips"};
  const std::string output = settings.output.empty()
                                 ? fs::path(settings.film).stem().string() + ".preview.png"
                                 : settings.output;
  if (auto free = check_output(output, "\x89PNG", "PNG file"); !free) return free.error();
  const auto made = preview_film(settings, places->film, output);
  if (!made) return made.error();
  if (settings.subject != "only" && settings.subject != "largest")
    console.remark("the preview shows the largest part of each frame: which is number " +
                   settings.subject + " is known once the whole film was followed");
  std::string text = "background: " + (*made)["background"].get<std::string>() + "\n";
  text += "  frame  parts  area px^2\n";
  for (const Json& row : (*made)["rows"]) {
    char line[80];
    std::snprintf(line, sizeof line, "%7d%7d%11.0f%s\n", row["frame"].get<int>(),
                  row["parts"].get<int>(), row.value("area", 0.0),
                  row.value("cut_by_border", false) ? "  cut by the border" : "");
    text += line;
  }
  console.text(text + "written: " + output + "\n");
  console.document(*made);
  Settings next = settings;
  next.output.clear();
  console.next("vsprite build " + shell_word(settings.film) + options_text(next, "build"));
  return 0;
}

#ifdef VSPRITE_WINDOW
Result<int> run_window(const Settings& settings, Console& console) {
  const auto places = find_places(settings, kSegment);
  if (!places) return places.error();
  if (is_cast(places->film))
    return Error{ErrorCode::BadFormat,
                 places->film + ": is a cast, with --window a film is due: one of its clips"};
  auto background = background_of(settings);
  if (!background) return background.error();
  KeyWindowOptions options;
  options.background = std::move(*background);
  premultiply(options.background);
  options.headless = settings.headless;
  options.frames = settings.headless && settings.frames == 0 ? 10 : settings.frames;
  options.screenshot = settings.record;
  options.saved = [&console](const std::string& what) { console.remark(what); };
  const auto choice = key_window(settings, options);
  if (!choice) return choice.error();
  if (choice->run) return run_one(choice->settings, console, kSegment, {});
  const std::string command = key_command(choice->settings);
  console.text(command + "\n");
  console.document({{"film", settings.film}, {"command", command}});
  return 0;
}
#else
Result<int> run_window(const Settings&, Console&) {
  return Error{
      ErrorCode::Unavailable,
      "this vsprite was built without windows: look at what a setting does with --preview N"};
}
#endif

}  // namespace

Result<int> run_segment(const Settings& s, Console& c) {
  if (s.window) return run_window(s, c);
  return s.preview > 0 ? run_preview(s, c) : run_stage_verb(s, c, kSegment);
}
Result<int> run_stage_verb(const Settings& s, Console& c, int stage) {
  return run_shared(s, [&](const Sharing& sharing) { return run_one(s, c, stage, sharing); });
}
Result<int> run_transitions(const Settings& s, Console& c) {
  return run_stage_verb(s, c, stage_index("transitions"));
}
Result<int> run_solve(const Settings& s, Console& c) {
  return run_stage_verb(s, c, stage_index("solve"));
}
Result<int> run_pack(const Settings& s, Console& c) { return run_stage_verb(s, c, kPack); }
Result<int> run_build(const Settings& s, Console& c) {
  return run_shared(s, [&](const Sharing& sharing) { return run_all(s, c, sharing); });
}

}  // namespace vsprite
