// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// doctor: what is missing on this machine, or broken in a film, a pack or a work folder - and what
// to do about it. Changes nothing.
#include "tool/commands/doctor.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "tool/cast.h"
#include "tool/commands/verbs.h"
#include "tool/pictures.h"
#include "tool/project.h"
#include "tool/report.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

// ---- the machine ----

bool on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string folders = path != nullptr ? path : "";
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    if (::access((folders.substr(begin, end - begin) + "/" + program).c_str(), X_OK) == 0)
      return true;
    begin = end + 1;
  }
  return false;
}

void check_machine(const std::string& folder, Findings& findings) {
  if (on_path("ffmpeg"))
    findings.push_back({"machine", kOk, "the program ffmpeg is there, for recording films", {}});
  else
    findings.push_back({"machine", kWarning,
                        "the program ffmpeg is missing: films cannot be recorded",
                        "apt install ffmpeg"});
  const auto pages = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
                     static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  constexpr double kGigabyte = 1e9;
  findings.push_back({"machine", pages < 2 * kGigabyte ? kWarning : kOk,
                      fixed_text(pages / kGigabyte, 1) + " GB of memory, " +
                          std::to_string(::sysconf(_SC_NPROCESSORS_ONLN)) + " processors",
                      pages < 2 * kGigabyte ? "lower --max-size and --jobs" : ""});
  std::error_code error;
  const auto space = fs::space(folder, error);
  const double free_bytes = static_cast<double>(space.available);
  if (!error)
    findings.push_back(
        {"machine", free_bytes < kGigabyte ? kWarning : kOk,
         fixed_text(free_bytes / kGigabyte, 1) + " GB free in " + folder,
         free_bytes < kGigabyte ? "make room, or name another place with --work" : ""});
  const bool display =
      std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (!display)
    findings.push_back({"machine", kWarning, "no display: `play` opens no window here",
                        "use `vsprite play --headless --record FILE.mp4`"});
}

// ---- a film, a pack ----

void check_pack(const std::string& path, Findings& findings) {
  const auto issues = verify_pack(path);
  if (!issues) {
    findings.push_back({"pack", kBroken, issues.error().message, "make it anew: vsprite pack"});
    return;
  }
  if (issues->empty()) findings.push_back({"pack", kOk, path + ": whole, every byte checked", {}});
  for (const PackIssue& issue : *issues)
    findings.push_back({"pack", issue.severity == "error" ? kBroken : kWarning,
                        path + ": " + issue.message, "make it anew: vsprite pack"});
}

// ---- a work folder ----

void check_leftovers(const Project& project, Findings& findings) {
  std::error_code error;
  for (const char* sub : {"", "/sprites", "/keyed"})
    for (const auto& entry : fs::directory_iterator(project.folder() + sub, error))
      if (is_temporary_name(entry.path().filename().string()))
        findings.push_back({"work", kWarning,
                            entry.path().string() + ": left by a process that was stopped",
                            "nothing: the next run removes it"});
  if (fs::exists(project.path("keyed"), error))
    findings.push_back({"work", kWarning,
                        project.path("keyed") + ": a segmentation was stopped on its way",
                        "run the same `vsprite segment` or `build` again: it goes on from there"});
}

void check_pictures(const Project& project, const std::vector<SampleRow>& rows,
                    Findings& findings) {
  constexpr int kNamed = 5;
  int broken = 0;
  PictureReader reader(project, rows);
  std::set<std::string> known;
  for (const SampleRow& row : rows) {
    known.insert(fs::path(project.sprite_path(row.sample)).filename().string());
    if (row.mirror_of >= 0) continue;
    const auto picture = reader.picture(row.sample);
    if (!picture && ++broken <= kNamed)
      findings.push_back(
          {"work", kBroken, picture.error().message,
           "put the picture back, or cut all anew: vsprite segment FILM --force segment"});
  }
  if (broken > kNamed)
    findings.push_back({"work", kBroken,
                        std::to_string(broken - kNamed) + " more pictures are missing or damaged",
                        "vsprite segment FILM --force segment"});
  if (broken == 0)
    findings.push_back(
        {"work", kOk, std::to_string(rows.size()) + " samples, every picture is there", {}});
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(project.path("sprites"), error)) {
    const std::string name = entry.path().filename().string();
    if (known.count(name) == 0 && !is_temporary_name(name))
      findings.push_back({"work", kWarning,
                          entry.path().string() + ": no row of samples.csv names it", "remove it"});
  }
}

/// A stage's record against the folder as it stands.
void check_stage(const Project& project, const char* stage, const std::string& sprites,
                 bool earlier_due, Findings& findings, bool& due) {
  const std::string remedy =
      "vsprite " + std::string(stage) +
      (std::string_view(stage) == "segment" ? " FILM" : " --work " + shell_word(project.folder()));
  const Json* record = project.record(stage);
  if (record == nullptr) {
    due = true;
    findings.push_back({"work", kWarning, std::string(stage) + ": has not finished here", remedy});
    return;
  }
  std::string changed;
  const Json inputs = record->value("inputs", Json::object());
  for (const auto& [name, sum] : inputs.items()) {
    if (std::string_view(stage) == "segment") break;  // films may have gone, their sprites stay
    const auto now = name == "sprites" ? Result<std::string>(sprites) : project.file_sum(name);
    if (!now || sum != *now) changed += (changed.empty() ? "" : ", ") + name;
  }
  if (!changed.empty() || earlier_due) {
    due = true;
    findings.push_back({"work", kWarning,
                        std::string(stage) + ": out of date" +
                            (changed.empty() ? "" : ", changed since: " + changed),
                        remedy});
    return;
  }
  findings.push_back({"work", kOk, std::string(stage) + ": up to date", {}});
}

template <class T>
void check_file(const Result<T>& file, Findings& findings, const char* remedy) {
  if (file || file.error().code == ErrorCode::NotFound) return;  // absence is the stage's finding
  const bool said = file.error().message.find("`vsprite ") != std::string::npos;
  findings.push_back({"work", kBroken, file.error().message, said ? "" : remedy});
}

/// `filmed`: a film is looked at, and its folder beside it: that nothing is cut yet is no fault.
void check_work(const std::string& folder, bool filmed, Findings& findings) {
  if (const int holder = lock_holder(folder); holder > 0)
    findings.push_back({"work", kWarning, folder + ": in use by process " + std::to_string(holder),
                        "wait for it to end"});
  const auto project = Project::look(folder);
  if (!project) {
    findings.push_back({"work", kBroken, project.error().message, "vsprite build FILM"});
    return;
  }
  check_leftovers(*project, findings);
  const auto rows = project->samples();
  if (!rows) {
    const bool absent = rows.error().code == ErrorCode::NotFound;
    findings.push_back(
        {"work", absent && filmed ? kWarning : kBroken, rows.error().message,
         absent ? "vsprite build FILM; what an interrupted run had finished is not done again"
                : "mend the line, or cut all anew: vsprite segment FILM --force segment"});
    return;
  }
  check_pictures(*project, *rows, findings);
  check_file(project->classifier(), findings,
             "mend the line, or train anew: vsprite train --force train");
  check_file(project->transitions(rows->size()), findings,
             "vsprite transitions --force transitions");
  check_file(project->values(rows->size()), findings, "vsprite solve --force solve");
  const auto sum = project->sprites_sum();
  bool due = false;
  for (const char* stage : kStages)
    check_stage(*project, stage, sum ? *sum : "", due, findings, due);
}

/// A film, or every clip of a cast.
void check_films(const Settings& settings, const std::string& path, Findings& findings,
                 Json& measures) {
  if (!is_cast(path)) return check_film(settings, path, findings, measures);
  const auto clips = read_cast(path);
  if (!clips) {
    findings.push_back({"cast", kBroken, clips.error().message, "mend that line"});
    return;
  }
  measures = Json::array();
  for (const CastClip& clip : *clips) {
    Json one;
    check_film(clip_settings(settings, clip), clip.path, findings, one);
    measures.push_back(std::move(one));
  }
}

}  // namespace

Result<int> run_doctor(const Settings& settings, Console& console) {
  Findings findings;
  std::error_code error;
  const std::string& operand = settings.film;
  if (!operand.empty() && !fs::exists(operand, error) && !is_picture_source(operand))
    return Error{ErrorCode::NotFound, operand + ": no such file or folder"};
  if (!settings.work.empty() && !fs::is_directory(settings.work, error))
    return Error{ErrorCode::NotFound, settings.work + ": no such folder"};
  check_machine(".", findings);
  const bool folder = fs::is_directory(operand, error) && !is_film_folder(operand);
  const bool pack = !folder && fs::path(operand).extension() == ".vsp";
  if (pack) check_pack(operand, findings);
  Json measures;
  if (!operand.empty() && !folder && !pack) check_films(settings, operand, findings, measures);
  if (!operand.empty() || !settings.work.empty()) {
    const std::string work = find_work_folder(settings.work, operand, {});
    if (folder || !settings.work.empty() || fs::is_directory(work, error))
      check_work(work, !operand.empty() && !folder && !pack, findings);
  }

  std::string text,
      next = operand.empty() ? "vsprite build FILM" : "vsprite build " + shell_word(operand);
  bool broken = false;
  Json list = Json::array();
  for (const Finding& finding : findings) {
    broken |= finding.state == kBroken;
    text += std::string(finding.state) + ": " + finding.message +
            (finding.remedy.empty() ? "" : "\n    -> " + finding.remedy) + "\n";
    list.push_back({{"name", finding.name},
                    {"state", finding.state},
                    {"message", finding.message},
                    {"remedy", finding.remedy}});
  }
  const std::string made =
      find_pack_path(find_work_folder(settings.work, operand, {}), operand, {});
  if (broken || (operand.empty() && settings.work.empty()))
    next = pack || folder || operand.empty() ? "vsprite build FILM" : next;
  else if (fs::exists(made, error))
    next = "vsprite play " + shell_word(made);
  console.text(text);
  Json document = {{"ok", !broken}, {"findings", list}};
  if (!measures.is_null()) document["film"] = measures;
  console.document(document);
  console.next(next);
  return broken ? 3 : 0;
}

}  // namespace vsprite
