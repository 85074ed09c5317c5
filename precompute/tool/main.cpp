// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The tool `vsprite`: film in, playable sprite out. Finds the verb, reads its options, runs it, and
// turns whatever went wrong into one sentence and an exit code.
#include <tbb/global_control.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <thread>

#include "tool/commands/verbs.h"
#include "vsprite/exit_code.h"
#include "vsprite/vsprite.h"

namespace {

using namespace vsprite;

/// Every file appears by renaming, so that stopping anywhere keeps what is finished: the process
/// may end at once. Only calls that are allowed in a handler.
pid_t the_tool = 0;

void on_interrupt(int) {
  if (::getpid() != the_tool) ::_exit(130);  // a decoder child goes quietly
  constexpr char message[] =
      "\nvsprite: interrupted: finished work is kept, the same command goes on from there\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, message, sizeof message - 1);
  ::_exit(130);
}

int fail(Console& console, const Error& error) {
  console.error(error);
  return exit_code(error.code);
}

int run_verb(const Verb& verb, int count, char** arguments) {
  const std::string name(verb.name);
  Settings bare;
  for (int i = 0; i < count; ++i) bare.json |= std::string_view(arguments[i]) == "--json";
  Console plain(name, bare);
  bool asks_help = false;
  const auto settings = parse_arguments(verb, count, arguments, asks_help);
  if (!settings) return fail(plain, settings.error());
  if (asks_help) return std::fputs(help_screen(verb).c_str(), stdout) < 0 ? 74 : 0;
  if (settings->dump_config) return std::fputs(dump_config(*settings).c_str(), stdout) < 0 ? 74 : 0;

  std::optional<tbb::global_control> threads;
  if (settings->jobs > 0)
    threads.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(settings->jobs));
  Console console(name, *settings);
  try {
    const auto result = verb.run(*settings, console);
    return result ? *result : fail(console, result.error());
  } catch (const std::bad_alloc&) {
    return fail(console, {ErrorCode::OutOfMemory,
                          "out of memory: close other programs, or lower --max-size or --jobs"});
  } catch (const std::exception& defect) {
    return fail(console,
                {ErrorCode::Internal, std::string("a defect of vsprite itself: ") + defect.what()});
  }
}

int run_help(int count, char** words) {
  if (count == 0) return std::fputs(overview_screen().c_str(), stdout) < 0 ? 74 : 0;
  if (const Verb* verb = find_verb(words[0]))
    return std::fputs(help_screen(*verb).c_str(), stdout) < 0 ? 74 : 0;
  Console console("help", {});
  return fail(console, unknown_verb(words[0]));
}

int run(int count, char** words) {
  if (count == 0) return run_help(0, words);
  const std::string first = words[0];
  if (first == "help" || first == "--help" || first == "-h") return run_help(count - 1, words + 1);
  if (first == "--version") return std::puts("vsprite " VSPRITE_VERSION) < 0 ? 74 : 0;
  if (const Verb* verb = find_verb(first)) return run_verb(*verb, count - 1, words + 1);
  Console console({}, {});
  if (first[0] == '-')
    return fail(console,
                {ErrorCode::BadSetting,
                 "`" + first + "` stands where a command is due: `vsprite` alone lists them"});
  return fail(console, unknown_verb(first));
}

}  // namespace

int main(int argc, char** argv) {
  the_tool = ::getpid();
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  const int code = run(argc - 1, argv + 1);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::fputs("vsprite: error: standard output: cannot be written\n", stderr);
    return code == 0 ? 74 : code;
  }
  return code;
}
