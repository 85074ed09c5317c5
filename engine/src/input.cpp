// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Held keys to a direction, and scripts of them.
#include "vsprite/input.h"

#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "file.h"
#include "text.h"
#include "vsprite/action.h"

namespace vsprite {
namespace {

using detail::kBlank;
using detail::trim;

constexpr std::uint64_t kMostScriptBytes = std::uint64_t{16} << 20;
constexpr double kMostSeconds = 1e9;

// What a person wrote, short enough for a message and without control characters.
std::string quoted_word(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string out(text.substr(0, kMost));
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  return '"' + out + (text.size() > kMost ? "...\"" : "\"");
}

// ceil(t * fps), where a product within a millionth of a whole number is that number: 0.07 s at
// 100 ticks a second are 7 ticks, though the doubles multiply to 7.000000000000001.
std::uint64_t tick_of(double seconds, double fps) {
  const double exact = seconds * fps;
  const double near = std::floor(exact + 0.5);
  return static_cast<std::uint64_t>(std::fabs(exact - near) < 1e-6 ? near : std::ceil(exact));
}

std::string_view take_word(std::string_view& text) {
  const std::string_view word = text.substr(0, std::min(text.find_first_of(kBlank), text.size()));
  text = trim(text.substr(word.size()));
  return word;
}

// The words after the time, where the first says that they are about an action.
std::optional<ScriptAction> parse_action(std::string_view words, bool& fits) {
  using Verb = ScriptAction::Verb;
  constexpr std::pair<std::string_view, Verb> kVerbs[] = {{"play", Verb::Play},
                                                          {"hold", Verb::Hold},
                                                          {"queue", Verb::Queue},
                                                          {"release", Verb::Release},
                                                          {"cancel", Verb::Cancel}};
  const std::string_view first = take_word(words);
  for (const auto& [name, verb] : kVerbs) {
    if (name != first) continue;
    ScriptAction action;
    action.verb = verb;
    const bool is_named = verb != Verb::Release && verb != Verb::Cancel;
    if (is_named) action.name = take_word(words);
    fits = !is_named || !action.name.empty();
    if (!words.empty() && verb != Verb::Queue && verb != Verb::Cancel) {
      const std::string_view number = take_word(words);
      const auto [end, error] =
          std::from_chars(number.data(), number.data() + number.size(), action.within);
      fits = fits && error == std::errc() && end == number.data() + number.size() &&
             action.within >= 0 && action.within <= 65535;
    }
    fits = fits && words.empty();
    return action;
  }
  return std::nullopt;
}

Result<void> parse_entry(std::string_view entry, double fps, const std::string& where,
                         KeyScript& script) {
  const auto bad = [&](const std::string& what) {
    return Error{ErrorCode::BadSetting, where + " " + quoted_word(entry) + ": " + what};
  };
  const std::size_t blank = std::min(entry.find_first_of(kBlank), entry.size());
  const std::string_view time = entry.substr(0, blank);
  const std::string_view name = trim(entry.substr(blank));
  double seconds = 0;
  const auto [end, error] = std::from_chars(time.data(), time.data() + time.size(), seconds);
  if (error != std::errc() || end != time.data() + time.size()) {
    return bad("no time " + quoted_word(time) +
               ", seconds and a direction are due, as in \"2.5 right\"");
  }
  if (!(seconds >= 0 && seconds <= kMostSeconds)) {
    return bad("time " + quoted_word(time) + ", 0 to 1000000000 seconds are due");
  }
  if (name.empty())
    return bad("no direction, seconds and a direction are due, as in \"2.5 right\"");
  bool fits = false;
  if (auto action = parse_action(name, fits)) {
    if (!fits)
      return bad(
          "an action, its name and perhaps the ticks that it may take are due, as in \"2.5 "
          "play jump 4\", \"3 hold wave\", \"3.5 queue jump\", \"4 release\", \"5 cancel\"");
    action->tick = tick_of(seconds, fps);
    script.actions.push_back(std::move(*action));
    return {};
  }
  const std::optional<Direction> direction = parse_direction(name);
  if (!direction) {
    return bad("unknown direction " + quoted_word(name) +
               ", due one of right, left, up, down, a pair such as right+up, none, rest; or play, "
               "hold, queue, release, cancel");
  }
  script.entries.push_back({tick_of(seconds, fps), *direction});
  return {};
}

Result<KeyScript> parse(std::string_view text, double fps, const std::string& name) {
  KeyScript script;
  int number = 0;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    std::string_view rest = line.substr(0, line.find('#'));
    while (!rest.empty()) {
      const std::string_view part = rest.substr(0, rest.find(';'));
      rest.remove_prefix(std::min(part.size() + 1, rest.size()));
      const std::string_view entry = trim(part);
      if (entry.empty()) continue;
      auto parsed = parse_entry(entry, fps, name + ": entry " + std::to_string(++number), script);
      if (!parsed) return parsed.error();
    }
  }
  std::stable_sort(script.entries.begin(), script.entries.end(),
                   [](const ScriptEntry& a, const ScriptEntry& b) { return a.tick < b.tick; });
  std::stable_sort(script.actions.begin(), script.actions.end(),
                   [](const ScriptAction& a, const ScriptAction& b) { return a.tick < b.tick; });
  return script;
}

bool is_file(const std::string& path) {
  struct stat status {};
  return path.find('\0') == std::string::npos && ::stat(path.c_str(), &status) == 0 &&
         !S_ISDIR(status.st_mode);
}

Result<KeyScript> parse_named(std::string_view text, double fps, const std::string& name) {
  assert(fps > 0);
  try {
    return parse(text, fps, name);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, name + ": out of memory"};
  }
}

}  // namespace

Direction KeyState::direction() const noexcept {
  const auto is_held = [this](Key key) { return int{held[static_cast<int>(key)]}; };
  return direction_from_axes(is_held(Key::Right) - is_held(Key::Left),
                             is_held(Key::Down) - is_held(Key::Up));
}

Direction KeyScript::at(std::uint64_t tick) const noexcept {
  const auto after =
      std::upper_bound(entries.begin(), entries.end(), tick,
                       [](std::uint64_t t, const ScriptEntry& entry) { return t < entry.tick; });
  return after == entries.begin() ? Direction::None : std::prev(after)->direction;
}

Result<KeyScript> parse_key_script(std::string_view text, double fps) {
  return parse_named(text, fps, "key script");
}

Result<KeyScript> load_key_script(const std::string& script, double fps) {
  if (is_file(script)) {
    auto bytes = detail::read_file(script, kMostScriptBytes);
    if (!bytes) return bytes.error();
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    return parse_named(text, fps, script);
  }
  // One word can be no script: it must have been meant as a file's name.
  const bool one_word = !script.empty() && script.find_first_of(" \t\n;#") == std::string::npos;
  if (one_word) {
    return Error{ErrorCode::NotFound,
                 script + ": no such file, and no key script such as \"0.0 right; 2.5 right+up\""};
  }
  return parse_named(script, fps, "key script");
}

Result<void> check_key_script(const Sprite& sprite, const KeyScript& script) {
  for (const ScriptAction& action : script.actions) {
    if (action.name.empty() || find_action(sprite, action.name) >= 0) continue;
    std::string known;
    for (const Action& a : sprite.actions()) known += (known.empty() ? "" : ", ") + a.name;
    return Error{ErrorCode::BadSetting,
                 "key script: no action " + quoted_word(action.name) + ", " +
                     (known.empty() ? "the pack has none: tags of a cast make them"
                                    : "the pack has " + known)};
  }
  return {};
}

void play_script(const Sprite& sprite, const KeyScript& script, std::uint64_t tick,
                 Actor& actor) noexcept {
  using Verb = ScriptAction::Verb;
  auto at =
      std::lower_bound(script.actions.begin(), script.actions.end(), tick,
                       [](const ScriptAction& action, std::uint64_t t) { return action.tick < t; });
  for (; at != script.actions.end() && at->tick == tick; ++at) {
    if (at->verb == Verb::Cancel) cancel(sprite, actor);
    if (at->verb == Verb::Release) release(sprite, actor, at->within);
    if (at->verb == Verb::Play) play(sprite, actor, at->name, at->within);
    if (at->verb == Verb::Hold) play(sprite, actor, at->name, at->within, true);
    const int queued = at->verb == Verb::Queue ? find_action(sprite, at->name) : -1;
    if (queued >= 0) queue(sprite, actor, queued);
  }
}

}  // namespace vsprite
