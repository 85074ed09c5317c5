// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// train: the stage itself, or what another threshold would give.
#include "tool/train.h"

#include "tool/commands/verbs.h"
#include "tool/pictures.h"

namespace vsprite {

namespace {

constexpr int kTrain = 1;

Result<int> show_move(const Settings& settings, Console& console) {
  if (settings.film.empty() && settings.work.empty())
    return Error{ErrorCode::BadSetting, "a work folder is due: FILM, PACK or --work DIR"};
  const std::string work = find_work_folder(settings.work, settings.film, settings.output);
  const auto project = Project::look(work);
  if (!project) return project.error();
  const auto sprites = load_sprites(*project);
  if (!sprites) return sprites.error();
  const auto preview = preview_move(*project, sprites->features, settings);
  if (!preview) return preview.error();
  console.text(move_text(*preview) + "  nothing was written: --save takes it\n");
  console.document(move_json(*preview));
  console.next("vsprite train --work " + shell_word(work) + " --threshold " +
               number_text(settings.threshold) + " --save");
  return 0;
}

}  // namespace

Result<int> run_train(const Settings& settings, Console& console) {
  if (settings.save && settings.threshold == 0)
    return Error{ErrorCode::BadSetting, "--save takes a threshold: --threshold X --save is due"};
  if (settings.threshold > 0 && !settings.save) return show_move(settings, console);
  return run_stage_verb(settings, console, kTrain);
}

}  // namespace vsprite
