// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// label: a person's answers, from the window or from a file, and back into a file.
#include "tool/commands/verbs.h"
#include "tool/labels.h"
#include "tool/report.h"
#ifdef VSPRITE_WINDOW
#include "tool/label_session.h"
#include "window/label.h"
#endif

namespace vsprite {
namespace {

std::string plural(std::size_t count, const char* one) {
  return std::to_string(count) + " " + one + (count == 1 ? "" : "s");
}

std::string summary(const PersonLabels& person) {
  std::size_t smooth = 0;
  for (const Label& label : person.labels) smooth += label.acceptable;
  std::string out = plural(person.labels.size(), "pair") +
                    " answered in all: " + std::to_string(smooth) + " smooth, " +
                    std::to_string(person.labels.size() - smooth) + " visible jumps\n";
  if (person.repeated > 0)
    out += plural(static_cast<std::size_t>(person.repeated), "answer") +
           " superseded by a later one about the same pair, of these " +
           std::to_string(person.disagreeing) + " said the opposite: the last counts\n";
  if (person.gone > 0)
    out += plural(static_cast<std::size_t>(person.gone), "answer") +
           " about samples that are not here (another film, or frames that are no samples any "
           "more): kept, not used\n";
  return out;
}

Json summary_json(const PersonLabels& person) {
  std::size_t smooth = 0;
  for (const Label& label : person.labels) smooth += label.acceptable;
  return {
      {"answers", person.answers},   {"pairs", person.labels.size()},     {"acceptable", smooth},
      {"repeated", person.repeated}, {"disagreeing", person.disagreeing}, {"gone", person.gone}};
}

/// The answers of a file, all or none. Returns what to say about it.
Result<std::string> take_answers(const std::string& path, const SampleNames& names,
                                 LabelStore& store, Json& document) {
  const auto text = read_file(path);
  if (!text) return text.error();
  const auto parsed = parse_answers(*text, path, names);
  if (!parsed) return parsed.error();
  if (auto added = store.add(parsed->answers); !added) return added.error();
  document["added"] = parsed->answers.size();
  document["passed_over"] = parsed->passed_over;
  std::string out = path + ": " + plural(parsed->answers.size(), "answer") + " taken";
  if (parsed->passed_over > 0)
    out += ", " + plural(static_cast<std::size_t>(parsed->passed_over), "row") +
           " that no person gave passed over";
  return out + "\n";
}

Result<void> ask_in_window([[maybe_unused]] const Project& project,
                           [[maybe_unused]] const SampleNames& names,
                           [[maybe_unused]] LabelStore& store,
                           [[maybe_unused]] const Settings& settings,
                           [[maybe_unused]] Console& console) {
#ifdef VSPRITE_WINDOW
  auto session = LabelSession::open(project, names, store, settings);
  if (!session) return session.error();
  LabelWindowOptions options;
  options.bind = settings.bind;
  options.headless = settings.headless;
  options.frames = settings.headless && settings.frames == 0 ? 60 : settings.frames;
  options.screenshot = settings.record;
  if (settings.verbose)
    options.kept = [&console](const std::string& what) { console.remark("kept: " + what); };
  return label_window(*session, options);
#else
  return Error{ErrorCode::Unavailable,
               "this vsprite was built without windows: give the answers with --answers FILE"};
#endif
}

}  // namespace

Result<int> run_label(const Settings& settings, Console& console) {
  if (settings.film.empty() && settings.work.empty())
    return Error{ErrorCode::BadSetting, "a work folder is due: FILM, PACK or --work DIR"};
  const std::string work = find_work_folder(settings.work, settings.film, settings.output);
  auto project = Project::open(work, false);
  if (!project) return project.error();
  const auto rows = project->samples();
  if (!rows) return rows.error();
  const auto names = SampleNames::of(*project, *rows);
  if (!names) return names.error();
  auto store = LabelStore::open(project->path("labels.sqlite"));
  if (!store) return store.error();

  Json document = Json::object();
  std::string text;
  if (!settings.answers.empty()) {
    const auto taken = take_answers(settings.answers, *names, *store, document);
    if (!taken) return taken.error();
    text += *taken;
  }
  if (settings.answers.empty() && settings.export_file.empty())
    if (auto asked = ask_in_window(*project, *names, *store, settings, console); !asked)
      return asked.error();
  const auto answers = store->answers();
  if (!answers) return answers.error();
  if (!settings.export_file.empty()) {
    if (auto wrote = write_file(settings.export_file, format_answers(*answers)); !wrote)
      return wrote.error();
    text += settings.export_file + ": " + plural(answers->size(), "answer") + " written\n";
  }
  const PersonLabels person = resolve(*answers, *names);
  document.update(summary_json(person));
  console.text(text + summary(person));
  console.document(document);
  console.next("vsprite train --work " + shell_word(work));
  return 0;
}

}  // namespace vsprite
