// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/input.h - held keys to a direction, and key scripts: `0.0 right; 2.5 right+up; 4.0 none`.
// An entry may also play an action (action.h): `1.5 play jump 4; 2.0 release; 3 hold wave; 4
// cancel`, the number being the deadline in ticks.
//
// Input comes from events into the engine's own state, so that a run can be recorded and replayed.
// A script entry at t seconds acts from tick ceil(t * fps); of several in one tick the last counts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/result.h"

namespace vsprite {

enum class Key : std::uint8_t { Left, Right, Up, Down };

/// Which of the four direction keys are held. Opposite keys cancel; two held keys are a diagonal.
struct KeyState {
  bool held[4] = {};
  void press(Key key) noexcept { held[static_cast<int>(key)] = true; }
  void release(Key key) noexcept { held[static_cast<int>(key)] = false; }
  /// Call on loss of focus: no key may stay stuck.
  void release_all() noexcept { *this = {}; }
  Direction direction() const noexcept;
};

struct ScriptEntry {
  std::uint64_t tick = 0;
  Direction direction = Direction::None;
};

/// What a script does with actions.
struct ScriptAction {
  enum class Verb : std::uint8_t { Play, Hold, Queue, Release, Cancel };
  std::uint64_t tick = 0;
  Verb verb = Verb::Play;
  int within = -1;   ///< ticks, 0..65535; -1: no deadline
  std::string name;  ///< of Play, Hold, Queue
};

struct Actor;
class Sprite;

/// Entries in ascending order of tick.
struct KeyScript {
  std::vector<ScriptEntry> entries;
  std::vector<ScriptAction> actions;  ///< of several in one tick all count, in their order
  /// The direction in force at `tick`; None before the first entry.
  Direction at(std::uint64_t tick) const noexcept;
};

/// Parses entries separated by ';' or new lines; '#' starts a comment. `fps` > 0.
/// Errors: BadSetting, naming the entry.
Result<KeyScript> parse_key_script(std::string_view text, double fps);
/// `script` names an existing file (read), or is the script itself.
Result<KeyScript> load_key_script(const std::string& script, double fps);

/// Errors: BadSetting, naming an action that the sprite does not have.
Result<void> check_key_script(const Sprite& sprite, const KeyScript& script);
/// Does what the script says of actions at `tick`; call it beside `at`. A name that the sprite does
/// not have does nothing.
void play_script(const Sprite& sprite, const KeyScript& script, std::uint64_t tick,
                 Actor& actor) noexcept;

}  // namespace vsprite
