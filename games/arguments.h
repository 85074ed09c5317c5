// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// arguments.h - the command line that all games share, and what `main` returns for an error.
#pragma once

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "vsprite/exit_code.h"
#include "vsprite/reload.h"
#include "vsprite/result.h"
#include "vsprite/session.h"
#include "vsprite/show.h"

namespace vsprite::games {

struct Arguments {
  std::string pack;
  bool headless = false;
  bool full_screen = false;
  std::uint64_t frames = 0;  ///< ticks; 0: until closed
  std::string keys;          ///< script or its file
  std::string record;        ///< .mp4 or .png
  std::uint64_t seed = 0;
  int fade = kFadeAuto;  ///< ticks over a jump
  bool help = false;
};

inline constexpr const char* kUsage =
    "usage: %s [PACK] [options]      PACK: a .vsp file made by `vsprite build` (%s)\n\n"
    "  --headless       no window: draws into memory, one frame a tick\n"
    "  --frames N       ends after N ticks of the film\n"
    "  --keys SCRIPT    \"0.0 right; 2.5 play jump 4; 4.0 none\", or a file with one entry a line\n"
    "  --record FILE    .mp4: a film of the run; .png: its last frame\n"
    "  --seed N         another course of chance (0)\n"
    "  --fade LENGTH    of the cross-fade over a jump: auto (by its cost), off, or 2 to 6 ticks "
    "(auto)\n"
    "  --full-screen    as F11 does later\n\n"
    "arrow keys, W A S D or a game pad steer; F11 full screen, Esc quits\n";

inline Result<std::uint64_t> parse_count(std::string_view option, std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size() && !text.empty()) return value;
  return Error{ErrorCode::BadSetting, std::string(option) + ": " +
                                          (text.empty() ? "nothing" : std::string(text)) +
                                          " was given, a whole number is due"};
}

inline Result<Arguments> parse_arguments(int argc, char** argv, const std::string& default_pack) {
  Arguments out;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const auto next = [&] { return i + 1 < argc ? std::string(argv[++i]) : std::string(); };
    if (word == "--help" || word == "-h") {
      out.help = true;
    } else if (word == "--headless") {
      out.headless = true;
    } else if (word == "--full-screen") {
      out.full_screen = true;
    } else if (word == "--keys" || word == "--record") {
      std::string& value = word == "--keys" ? out.keys : out.record;
      value = next();
      if (value.empty()) {
        return Error{ErrorCode::BadSetting, std::string(word) + ": nothing was given, a " +
                                                (word == "--keys" ? "script" : "file name") +
                                                " is due"};
      }
    } else if (word == "--fade") {
      const std::optional<int> length = parse_fade(next());
      if (!length) {
        return Error{ErrorCode::BadSetting, "--fade " + std::string(i < argc ? argv[i] : "") +
                                                ": auto, off or a number from 2 to 6 is due"};
      }
      out.fade = *length;
    } else if (word == "--frames" || word == "--seed") {
      Result<std::uint64_t> value = parse_count(word, next());
      if (!value) return std::move(value).error();
      (word == "--frames" ? out.frames : out.seed) = *value;
    } else if (word.size() > 1 && word[0] == '-') {
      return Error{ErrorCode::BadSetting, std::string(word) + ": no such option, see --help"};
    } else if (out.pack.empty()) {
      out.pack = word;
    } else {
      return Error{ErrorCode::BadSetting, std::string(word) + ": one pack is due, two were given"};
    }
  }
  if (out.pack.empty()) out.pack = default_pack;
  return out;
}

/// What the arguments say about a run.
inline SessionConfig session_config(const char* title, double fps, const Arguments& arguments,
                                    const Sprite* sprite = nullptr) {
  return {.title = title,
          .fps = fps,
          .headless = arguments.headless,
          .full_screen = arguments.full_screen,
          .frames = arguments.frames,
          .keys = arguments.keys,
          .sprite = sprite,
          .record = arguments.record};
}

/// A rebuilt pack, to be taken over before the next frame; says on stderr what came of it.
inline std::optional<Sprite> take_rebuilt(PackWatch& watch, const char* name, double fps) {
  Result<std::optional<Sprite>> rebuilt = watch.poll();
  if (rebuilt && !*rebuilt) return std::nullopt;
  if (rebuilt && (*rebuilt)->fps() != fps)
    rebuilt = Error{ErrorCode::BadContent, "its ticks are no longer as long as they were"};
  if (!rebuilt) {
    std::fprintf(stderr, "%s: the old pack plays on: %s\n", name, rebuilt.error().message.c_str());
    return std::nullopt;
  }
  std::fprintf(stderr, "%s: the pack was rebuilt, and is taken over\n", name);
  return std::move(*rebuilt);
}

/// The whole of a game's main: parses, plays, says what went wrong. `play` is a lambda: a page
/// cannot wait for its next frame in what is called by a pointer (engine/page.cmake).
template <class Play>
int run(int argc, char** argv, const char* name, const std::string& default_pack, Play play) {
  static_assert(!std::is_pointer_v<Play>);
  const Result<Arguments> arguments = parse_arguments(argc, argv, default_pack);
  if (arguments && arguments->help) {
    std::printf(kUsage, name, default_pack.c_str());
    return 0;
  }
  Result<void> done;
  if (arguments) {
    done = play(*arguments);
  } else {
    done = arguments.error();
  }
  if (done) return 0;
  std::string message = done.error().message;
  if (done.error().code == ErrorCode::NotFound && arguments && arguments->pack == default_pack) {
    message += " (./play makes the bundled one; or name a pack: " + std::string(name) + " PACK)";
  }
  std::fprintf(stderr, "%s: error: %s\n", name, message.c_str());
  return exit_code(done.error().code);
}

}  // namespace vsprite::games
