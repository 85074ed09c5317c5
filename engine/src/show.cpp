// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// An actor's picture and place, and the cross-fade over its jumps: the sequel's way of hiding what
// the classifier let pass (Schoedl & Essa, SCA 2002), with the old run playing on.
#include "vsprite/show.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vsprite {
namespace {

bool is_jump(const Sprite& sprite, std::uint32_t from, std::uint32_t to) noexcept {
  return from != to && !sprite.is_natural(from, to) && !sprite.is_skip(from, to);
}

// The run that was left goes on as it was filmed, and stands at its end.
void play_on(const Sprite& sprite, ActorFade& fade) noexcept {
  ++fade.held;
  if (fade.held < sprite.samples()[fade.before].duration) return;
  if (!sprite.is_natural(fade.before, fade.before + 1)) return;
  ++fade.before;
  fade.held = 0;
}

}  // namespace

std::optional<int> parse_fade(std::string_view text) noexcept {
  if (text == "auto") return kFadeAuto;
  if (text == "off") return kFadeOff;
  const int ticks = text.size() == 1 ? text[0] - '0' : 0;
  if (ticks < kLeastFade || ticks > kMostFade) return std::nullopt;
  return ticks;
}

int fade_length(float cost) noexcept {
  constexpr float kDearest = 3;
  if (cost <= 1) return kFadeOff;
  const float part = cost < kDearest ? (cost - 1) / (kDearest - 1) : 1.0f;  // NaN: as a cut
  return kLeastFade + static_cast<int>(std::lround(part * (kMostFade - kLeastFade)));
}

void follow(const Sprite& sprite, const Actor& actor, ActorFade& fade, int ticks) noexcept {
  const std::uint32_t last = std::exchange(fade.shown, actor.sample);
  if (fade.before != kNoSample && ++fade.passed >= fade.length) fade.before = kNoSample;
  if (fade.before != kNoSample) play_on(sprite, fade);
  if (ticks == kFadeOff || last == kNoSample || !is_jump(sprite, last, actor.sample)) return;
  const int length = ticks > 0 ? std::clamp(ticks, kLeastFade, kMostFade)
                               : fade_length(sprite.transition_cost(last, actor.sample));
  if (length == 0 || fade_share(fade) > 0.5f) return;
  fade.before = last;
  fade.held = sprite.samples()[last].duration;  // its time is up: the next one is due
  play_on(sprite, fade);
  fade.length = static_cast<std::uint8_t>(length);
  fade.passed = 0;
}

float fade_share(const ActorFade& fade, float fraction) noexcept {
  if (fade.before == kNoSample) return 0;
  const float t = static_cast<float>(fade.passed) + fraction;
  return std::max(0.0f, 1 - (t + 1) / (static_cast<float>(fade.length) + 1));
}

ActorPicture actor_picture(const Sprite& sprite, FrameCache& frames, const Actor& actor,
                           float fraction) noexcept {
  const Vec2 at = draw_position(sprite, actor, fraction);
  const Vec2 anchor = sprite.samples()[actor.sample].anchor;
  const ActorPicture out{
      frames.frame(actor.sample), {at.x - anchor.x, at.y - anchor.y}, actor.sample};
  frames.look_ahead(actor);
  return out;
}

}  // namespace vsprite
