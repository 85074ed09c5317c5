// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/commands/console.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "tool/report.h"
#include "vsprite/exit_code.h"

namespace vsprite {
namespace {

constexpr int kBarWidth = 30;

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

std::string eta_text(double seconds) {
  const int whole = static_cast<int>(seconds + 0.5);
  char text[32];
  std::snprintf(text, sizeof text, "%d:%02d", whole / 60, whole % 60);
  return text;
}

}  // namespace

Console::Console(std::string verb, const Settings& settings)
    : verb_(std::move(verb)),
      json_(settings.json),
      quiet_(settings.quiet),
      verbose_(settings.verbose),
      mode_(Mode::Lines) {
  const std::string& asked = settings.progress;
  if (asked == "none" || (quiet_ && asked == "auto"))
    mode_ = Mode::None;
  else if (asked == "json")
    mode_ = Mode::JsonLines;
  else if (asked == "bar" || (asked == "auto" && ::isatty(STDERR_FILENO) == 1 && !is_set("CI")))
    mode_ = Mode::Bar;
}

void Console::text(const std::string& result) {
  if (!json_ && !quiet_) std::fputs(result.c_str(), stdout);
}

void Console::document(const Json& result) {
  if (json_)
    std::fputs((result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n").c_str(), stdout);
}

void Console::next(const std::string& command) {
  if (!quiet_) std::fprintf(json_ ? stderr : stdout, "next: %s\n", command.c_str());
}

void Console::remark(const std::string& message) {
  clear_bar();
  if (!quiet_) std::fprintf(stderr, "vsprite %s: %s\n", verb_.c_str(), message.c_str());
}

void Console::error(const Error& error) {
  clear_bar();
  // Red helps a person to find it; a pipe or NO_COLOR gets none.
  const bool color = ::isatty(STDERR_FILENO) == 1 && !is_set("NO_COLOR");
  const std::string verb = verb_.empty() ? "" : " " + verb_;
  std::fprintf(stderr, "vsprite%s: %serror:%s %s\n", verb.c_str(), color ? "\x1b[31m" : "",
               color ? "\x1b[0m" : "", error.message.c_str());
  document({{"error",
             {{"code", code_name(error.code)},
              {"exit", exit_code(error.code)},
              {"message", error.message}}}});
}

StageListener Console::listener() {
  return {.begin = [this](const std::string& stage) { begin_stage(stage); },
          .progress = [this](double fraction) { show_progress(fraction); },
          .note =
              [this](const std::string& text) {
                if (verbose_) remark(stage_ + ": " + text);
              },
          .end = [this](const std::string& stage, bool skipped) { end_stage(stage, skipped); }};
}

void Console::begin_stage(const std::string& stage) {
  stage_ = stage;
  begun_ = std::chrono::steady_clock::now();
  shown_ = -1;
  show_progress(0);
}

void Console::show_progress(double fraction) {
  const std::lock_guard lock(guard_);
  const int percent = static_cast<int>(100 * fraction);
  const int grain = mode_ == Mode::Bar ? 1 : 10;
  if (mode_ == Mode::None || (shown_ >= 0 && percent / grain <= shown_ / grain)) return;
  shown_ = percent;
  const double spent =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  const double left = fraction > 0.01 ? spent * (1 - fraction) / fraction : 0;
  if (mode_ == Mode::JsonLines) {
    const Json line = {{"stage", stage_}, {"fraction", fraction}, {"eta_seconds", left}};
    std::fprintf(stderr, "%s\n", line.dump().c_str());
  } else if (mode_ == Mode::Lines) {
    // A line for every tenth of a stage that is over in a moment helps nobody.
    if (percent > 0 && spent > 2)
      std::fprintf(stderr, "%s: %d %%\n", stage_.c_str(), percent / 10 * 10);
  } else {
    const int full = percent * kBarWidth / 100;
    std::string bar(static_cast<std::size_t>(full), '=');
    bar.resize(kBarWidth, ' ');
    std::fprintf(stderr, "\r%-12s [%s] %3d %%  %s left \x1b[K", stage_.c_str(), bar.c_str(),
                 percent, left > 0 ? eta_text(left).c_str() : "-:--");
  }
}

void Console::end_stage(const std::string& stage, bool skipped) {
  clear_bar();
  if (mode_ == Mode::None) return;
  const double spent =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  if (mode_ == Mode::JsonLines) {
    const Json line = {{"stage", stage}, {"fraction", 1}, {"skipped", skipped}, {"seconds", spent}};
    std::fprintf(stderr, "%s\n", line.dump().c_str());
  } else if (skipped) {
    std::fprintf(stderr, "%s: up to date\n", stage.c_str());
  } else {
    std::fprintf(stderr, "%s: %s s\n", stage.c_str(), fixed_text(spent, 1).c_str());
  }
}

void Console::clear_bar() {
  if (mode_ == Mode::Bar) std::fputs("\r\x1b[K", stderr);
}

const char* code_name(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::NotFound:
      return "not-found";
    case ErrorCode::CannotRead:
      return "cannot-read";
    case ErrorCode::CannotCreate:
      return "cannot-create";
    case ErrorCode::CannotWrite:
      return "cannot-write";
    case ErrorCode::InUse:
      return "in-use";
    case ErrorCode::BadFormat:
      return "bad-format";
    case ErrorCode::UnsupportedVersion:
      return "unsupported-version";
    case ErrorCode::CorruptData:
      return "corrupt-data";
    case ErrorCode::LimitExceeded:
      return "limit-exceeded";
    case ErrorCode::BadContent:
      return "bad-content";
    case ErrorCode::BadSetting:
      return "bad-setting";
    case ErrorCode::DecoderFailed:
      return "decoder-failed";
    case ErrorCode::Unavailable:
      return "unavailable";
    case ErrorCode::OutOfMemory:
      return "out-of-memory";
    case ErrorCode::Interrupted:
      return "interrupted";
    case ErrorCode::Internal:
      return "internal";
  }
  return "internal";
}

}  // namespace vsprite
