// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// report: one page about a pack, and what to film next.
#include <filesystem>

#include "tool/commands/verbs.h"
#include "tool/film_report.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

// What the work folder knows beyond the pack, if it stands.
void look_into_folder(const std::string& folder, FilmReport& report) {
  const auto project = Project::look(folder);
  if (!project) return;
  if (auto classifier = project->classifier()) report.classifier = *classifier;
  for (const char* stage : {"segment", "train", "transitions"}) {
    if (const Json* record = project->record(stage))
      report.records[stage] = record->value("result", Json::object());
  }
  if (auto roc = read_file(project->path("roc.svg"))) report.roc = std::move(*roc);
  if (auto contact = read_file(project->path("contact.png"))) report.contact = std::move(*contact);
  const Json segment = report.records.value("segment", Json::object());
  const Json dropped = segment.value("dropped", Json::object());
  for (const auto& [reason, found] : dropped.items()) {
    if (!found.is_object()) continue;
    auto png = read_file(project->path(found.value("picture", "")));
    if (png)
      report.dropped.push_back(
          {reason, found.value("frame", 0), found.value("share", 0.0), std::move(*png)});
  }
}

}  // namespace

Result<int> run_report(const Settings& settings, Console& console) {
  const std::string folder = find_work_folder(settings.work, settings.film, {});
  if (settings.film.empty() && settings.work.empty())
    return Error{ErrorCode::BadSetting, "a pack is due: PACK.vsp"};
  const std::string pack = find_pack_path(folder, settings.film, {});
  const auto sprite = load_pack(pack);
  if (!sprite) return sprite.error();
  const int mode = settings.mode.empty() ? 0 : sprite->find_mode(settings.mode);
  if (mode < 0)
    return Error{ErrorCode::BadContent, pack + ": it holds no mode `" + settings.mode +
                                            "`: use --mode " + sprite->data().modes.front().name};
  FilmReport report;
  report.mode = sprite->data().modes[static_cast<std::size_t>(mode)].name;
  report.advice = make_advice(*sprite, mode, settings.seed);
  look_into_folder(folder, report);
  const std::string output =
      settings.output.empty() ? fs::path(pack).stem().string() + ".html" : settings.output;
  const auto page = report_html(*sprite, report);
  if (!page) return page.error();
  if (auto wrote = write_file(output, *page); !wrote) return wrote.error();
  console.text(report_text(*sprite, report) + "  page: " + output + "\n");
  Json document = report_json(*sprite, report);
  document["page"] = output;
  console.document(document);
  console.next("vsprite play " + shell_word(pack));
  return 0;
}

}  // namespace vsprite
