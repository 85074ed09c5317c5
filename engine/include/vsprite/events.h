// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/events.h - what happened in the last tick, asked for after the step.
//
//     step(sprite, actor);
//     const TickEvents now = events_of(sprite, actor);
//     for (const SampleEvent& e : now.named) if (e.name == foot_down) play_sound();
//
// Nothing is called back, queued or allocated: events follow from the actor's state alone, so that
// a replayed or rolled back run has the same ones.
#pragma once

#include <span>
#include <string_view>

#include "vsprite/actor.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct TickEvents {
  bool frame_shown = false;            ///< another picture than in the tick before
  bool jump_taken = false;             ///< and not the film's own continuation: cross-fade it
  std::span<const SampleEvent> named;  ///< of what was shown, also of a sample that was left out
};

/// Pre: at least one step was made. O(log events).
TickEvents events_of(const Sprite& sprite, const Actor& actor) noexcept;

/// Index into SpriteData::event_names, or -1.
int find_event(const Sprite& sprite, std::string_view name) noexcept;

}  // namespace vsprite
