// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/action.h - plays what the film holds by name: `play(sprite, actor, "jump", 4)`.
//
// A played action leads the actor from the sample that it shows to the first sample of a tag, along
// the smoothest way (tagged.h), and through the tag; then the actor is steered again, by whatever
// was commanded meanwhile. A deadline of n ticks is kept: at the latest the n-th step after play()
// shows the tag, with `within` 0 the very next one, by a cut where nothing smoother comes in time
// (draw it with a cross-fade). An action of phases shows jump.start, then jump.air until release(),
// then jump.end.
//
//     const int jump = find_action(sprite, "jump");     // once
//     if (pressed) play(sprite, actor, jump, 4);        // any time between two steps
//     if (landed) release(sprite, actor);
//
// All of it lies in the bytes of the actor. Nothing here allocates or fails.
#pragma once

#include <string_view>

#include "vsprite/actor.h"
#include "vsprite/sprite.h"

namespace vsprite {

inline constexpr int kNoDeadline = -1;

/// Actor::play. The lowest two bits are the phase: Action::kStart, kAir, kEnd.
inline constexpr std::uint8_t kPlayPhase = 3;
inline constexpr std::uint8_t kPlayApproach = 4;   ///< on the way to the first sample of the phase
inline constexpr std::uint8_t kPlayHold = 8;       ///< a tag without phases lasts until release()
inline constexpr std::uint8_t kPlayReleased = 16;  ///< nothing is held any longer
inline constexpr std::uint8_t kPlayQueuedHold = 32;  ///< kPlayHold of what is queued

/// Index into Sprite::actions(), or -1.
int find_action(const Sprite& sprite, std::string_view name) noexcept;

/// Plays an action now, instead of what is played; what was queued is forgotten. `within`: ticks,
/// 0..65535, or kNoDeadline: the way that is cheapest altogether. `hold`: a tag without phases is
/// looped inside itself, or where the film does not allow that its last sample held, until
/// release(). Pre: 0 <= action < sprite.actions().size().
void play(const Sprite& sprite, Actor& actor, int action, int within = kNoDeadline,
          bool hold = false) noexcept;
/// The same by name; false, and nothing is done, where the sprite has no such action.
bool play(const Sprite& sprite, Actor& actor, std::string_view name, int within = kNoDeadline,
          bool hold = false) noexcept;

/// Plays an action once the present one is over (at once where there is none). One can wait; a
/// later one takes its place.
void queue(const Sprite& sprite, Actor& actor, int action, bool hold = false) noexcept;

/// Ends what is held: jump.air goes over into jump.end, of which the first sample shows within so
/// many ticks; a held tag without phases ends with the sample that is shown.
void release(const Sprite& sprite, Actor& actor, int within = kNoDeadline) noexcept;

/// Back to steering with the next sample; forgets what is queued.
void cancel(const Sprite& sprite, Actor& actor) noexcept;

/// True from the step that shows the first sample of the action until it is over.
inline bool is_showing_action(const Actor& actor) noexcept {
  return actor.action != 0 &&
         ((actor.play & kPlayApproach) == 0 || (actor.play & kPlayPhase) != Action::kStart);
}

}  // namespace vsprite
