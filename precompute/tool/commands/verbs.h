// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// commands/verbs.h - what the tool can do: one row a verb, in pipeline order.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tool/commands/console.h"
#include "tool/settings.h"
#include "vsprite/result.h"

namespace vsprite {

struct Verb {
  std::string_view name;
  std::string_view operand;  ///< as in the usage line
  std::string_view summary;  ///< a sentence without full stop
  std::string_view example;  ///< one command line
  /// The process's exit code, or an error to be printed.
  Result<int> (*run)(const Settings&, Console&);
};

std::span<const Verb> all_verbs();
const Verb* find_verb(std::string_view name);

/// `vsprite` alone, and `vsprite help`.
std::string overview_screen();
/// `vsprite help VERB`.
std::string help_screen(const Verb& verb);

/// The command line after the verb. `asks_help` is set by --help. Errors: BadSetting; those of the
/// config file are BadContent, NotFound.
Result<Settings> parse_arguments(const Verb& verb, int count, char** arguments, bool& asks_help);

/// First word that is no verb. BadSetting, naming the nearest one.
Error unknown_verb(const std::string& word);

Result<int> run_segment(const Settings&, Console&);
Result<int> run_label(const Settings&, Console&);
Result<int> run_train(const Settings&, Console&);
Result<int> run_transitions(const Settings&, Console&);
Result<int> run_solve(const Settings&, Console&);
Result<int> run_points(const Settings&, Console&);
Result<int> run_fit(const Settings&, Console&);
Result<int> run_pack(const Settings&, Console&);
Result<int> run_build(const Settings&, Console&);
Result<int> run_play(const Settings&, Console&);
Result<int> run_steer(const Settings&, Console&);
Result<int> run_path(const Settings&, Console&);
Result<int> run_report(const Settings&, Console&);
Result<int> run_info(const Settings&, Console&);
Result<int> run_validate(const Settings&, Console&);
Result<int> run_dump(const Settings&, Console&);
Result<int> run_loops(const Settings&, Console&);
Result<int> run_export(const Settings&, Console&);
Result<int> run_doctor(const Settings&, Console&);

/// One stage of kStages, reported.
Result<int> run_stage_verb(const Settings&, Console&, int stage);

}  // namespace vsprite
