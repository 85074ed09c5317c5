// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The window of `vsprite play` as a program of its own, for pages: a pack and nothing else. At its
// end it says what the player did, as a key script, and the states that came of it, so that
// `vsprite steer PACK --keys SCRIPT --frames N` can be held against it.
#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <string>
#include <string_view>

#include "vsprite/actor.h"
#include "vsprite/exit_code.h"
#include "vsprite/pack.h"
#include "window/play.h"

namespace vsprite {
namespace {

constexpr const char* kUsage =
    "usage: player PACK [--mode NAME] [--keys SCRIPT] [--frames N] [--seed N] [--headless]\n"
    "example: player mouse.vsp --keys \"0 right; 2 none\" --frames 90\n";

struct Arguments {
  std::string pack;
  PlayOptions play;
  bool help = false;
};

Result<Arguments> parse(int argc, char** argv) {
  Arguments out;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    const auto next = [&] { return i + 1 < argc ? std::string(argv[++i]) : std::string(); };
    const auto number = [&](std::uint64_t& value) {
      const std::string text = next();
      const char* end = text.data() + text.size();
      const auto read = std::from_chars(text.data(), end, value);
      return !text.empty() && read.ec == std::errc() && read.ptr == end;
    };
    bool ok = true;
    if (word == "--help" || word == "-h")
      out.help = true;
    else if (word == "--headless")
      out.play.headless = true;
    else if (word == "--mode")
      out.play.mode = next();
    else if (word == "--keys")
      out.play.keys = next();
    else if (word == "--frames")
      ok = number(out.play.frames);
    else if (word == "--seed")
      ok = number(out.play.seed);
    else if (out.pack.empty() && word.substr(0, 1) != "-")
      out.pack = word;
    else
      return Error{ErrorCode::BadSetting, std::string(word) + ": no such option, see --help"};
    if (!ok) return Error{ErrorCode::BadSetting, std::string(word) + ": a whole number is due"};
  }
  if (out.pack.empty() && !out.help)
    return Error{ErrorCode::BadSetting, "a pack is due, see --help"};
  return out;
}

/// The commands of a run as a key script: an entry's time lies half a tick before the tick from
/// which it acts.
class Diary {
 public:
  explicit Diary(double fps) : fps_(fps) {}
  void add(const Actor& actor) {
    states_.add(actor);
    if (actor.direction != last_) {
      const double seconds = std::max(0.0, (static_cast<double>(ticks_) - 0.5) / fps_);
      char entry[64];
      std::snprintf(entry, sizeof entry, "%s%.4f %s", script_.empty() ? "" : "; ", seconds,
                    std::string(direction_name(actor.direction)).c_str());
      script_ += entry;
      last_ = actor.direction;
    }
    ++ticks_;
  }
  void print() const {
    std::printf("%" PRIu64 " ticks, states %016" PRIx64 "\nkeys %s\n", ticks_, states_.digest(),
                script_.c_str());
  }

 private:
  double fps_;
  StateHash states_;
  std::uint64_t ticks_ = 0;
  Direction last_ = Direction::None;
  std::string script_;
};

Result<void> run(const Arguments& arguments) {
  const Result<Sprite> sprite = load_pack(arguments.pack);
  if (!sprite) return sprite.error();
  Diary diary(sprite->fps());
  PlayOptions play = arguments.play;
  play.after_tick = [&](const Actor& actor) { diary.add(actor); };
  if (auto played = play_window(*sprite, play); !played) return played;
  diary.print();
  return {};
}

}  // namespace
}  // namespace vsprite

int main(int argc, char** argv) {
  using namespace vsprite;
  const Result<Arguments> arguments = parse(argc, argv);
  if (arguments && arguments->help) {
    std::fputs(kUsage, stdout);
    return 0;
  }
  const Result<void> done = arguments ? run(*arguments) : Result<void>(arguments.error());
  if (done) return 0;
  std::fprintf(stderr, "player: error: %s\n", done.error().message.c_str());
  return exit_code(done.error().code);
}
