// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/show.h - what an actor looks like now: its picture, where it goes, and what is left of
// the picture before a jump.
//
// For games that draw with a renderer of their own: one call gives premultiplied pixels and a
// place.
//
//     const ActorPicture p = actor_picture(sprite, frames, actor, fraction);
//     my_renderer.blend_premultiplied(p.pixels, p.top_left.x, p.top_left.y);
//
// Cross-fade. A jump shows a picture that the film never showed after the one before. For a few
// ticks both are mixed, anchor on anchor: the run that was left plays on and gives way,
//
//     C(t) = (1 - s) C_new(t) + s C_old(t),   s = 1 - (t + 1) / (n + 1),   t in [0, n]
//
// with t the ticks since the jump and C premultiplied, so that what is opaque in both stays opaque.
// Natural continuation and play-through are the film itself and never fade. The state stands beside
// the Actor and not in it: it decides nothing, and a game that does not fade keeps none.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "vsprite/actor.h"
#include "vsprite/geometry.h"
#include "vsprite/image.h"
#include "vsprite/sprite.h"
#include "vsprite/stream.h"

namespace vsprite {

/// How many ticks a jump is faded over: so many, or by what it costs.
inline constexpr int kFadeOff = 0;
inline constexpr int kFadeAuto = -1;
inline constexpr int kLeastFade = 2, kMostFade = 6;
/// "auto", "off", "2" .. "6": what a player or a designer types. Empty: anything else.
std::optional<int> parse_fade(std::string_view text) noexcept;

/// What is left of the run before the last jump. Plain state, copied and restored with its Actor.
struct ActorFade {
  std::uint32_t shown = kNoSample;   ///< by the actor when it was last followed
  std::uint32_t before = kNoSample;  ///< the sample that fades out; kNoSample: none does
  std::uint16_t held = 0;            ///< ticks that `before` has been shown
  std::uint8_t length = 0;           ///< n, ticks
  std::uint8_t passed = 0;           ///< whole ticks since the jump, < n while it fades
};

/// The length of the fade over a jump of cost T under kFadeAuto: 0 up to the classifier's threshold
/// (T <= 1: it was judged to look right as it is, and a mix of two poses shows more than the jump),
/// then 2 ticks, growing to 6 for a join of T = 3 or more and for a cut (infinity).
int fade_length(float cost) noexcept;

/// Call it after every step (and after whatever else shows another sample). `ticks`: kFadeOff,
/// kFadeAuto, or 2..6 for every jump; other numbers are taken as the nearest of these. A jump
/// during a fade starts a new one once the old picture has half of the mix or less; before that the
/// old one goes on. O(log of a row of transitions) at a jump, else O(1); never allocates.
/// Pre: `fade` was made ({}) for this sprite.
void follow(const Sprite& sprite, const Actor& actor, ActorFade& fade,
            int ticks = kFadeAuto) noexcept;

/// s: what the picture of `fade.before` has of the mix, `fraction` in [0, 1) of a tick after the
/// last step; 0 if nothing fades.
float fade_share(const ActorFade& fade, float fraction = 0) noexcept;

/// A picture and its place.
struct ActorPicture {
  ImageView pixels;          ///< premultiplied sRGB RGBA; empty if the pack's picture is damaged
  Vec2 top_left;             ///< where its corner goes, game pixels, not rounded
  std::uint32_t sample = 0;  ///< names the picture, for a cache of textures
};

/// The picture of an actor, `fraction` in [0, 1) of a tick after its last step, and has the next
/// ones decoded ahead. `pixels` is valid as FrameCache::frame says: until the next call but one.
ActorPicture actor_picture(const Sprite& sprite, FrameCache& frames, const Actor& actor,
                           float fraction = 0) noexcept;

}  // namespace vsprite
