// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// commands/console.h - results to stdout, everything else to stderr, and how far a stage has come.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "tool/project.h"
#include "tool/settings.h"
#include "tool/stages.h"

namespace vsprite {

/// One run of the tool on its streams.
class Console {
 public:
  Console(std::string verb, const Settings& settings);

  /// For people, on stdout; nothing with --json or --quiet.
  void text(const std::string& result);
  /// The one document on stdout; nothing without --json.
  void document(const Json& result);
  /// The line that names the next useful command.
  void next(const std::string& command);
  /// A remark, on stderr; nothing with --quiet.
  void remark(const std::string& message);
  /// On stderr, and as a document with --json.
  void error(const Error& error);

  /// Shows stages as --progress asks.
  StageListener listener();

 private:
  enum class Mode { None, Bar, Lines, JsonLines };
  void begin_stage(const std::string& stage);
  void show_progress(double fraction);
  void end_stage(const std::string& stage, bool skipped);
  void clear_bar();

  std::string verb_;
  bool json_, quiet_, verbose_;
  Mode mode_;
  std::string stage_;
  std::chrono::steady_clock::time_point begun_;
  int shown_ = -1;    ///< percent
  std::mutex guard_;  ///< progress may come from any thread
};

/// Stable name for scripts: "bad-format", ...
const char* code_name(ErrorCode code) noexcept;

}  // namespace vsprite
