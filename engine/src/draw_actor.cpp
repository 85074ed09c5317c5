// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Actors as pictures of a Renderer: which picture, where, and what still fades out of it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "vsprite/draw.h"

namespace vsprite {
namespace {

TextureKey key_of(const Sprite& sprite, std::uint32_t sample) {
  return {reinterpret_cast<std::uintptr_t>(&sprite.data()), sample};
}

// The picture that is shown and the one that fades out of it; pixels, or blocks, only where
// `is_there` says no.
template <class IsThere>
SpriteDraw sprite_of(const ActorDraw& a, float fraction, bool takes_blocks,
                     const IsThere& is_there) {
  SpriteDraw s = a.look;
  const Sprite& sprite = *a.sprite;
  const Vec2 at = draw_position(sprite, *a.actor, fraction);
  s.position = {at.x + a.look.position.x, at.y + a.look.position.y};
  s.anchor = sprite.samples()[a.actor->sample].anchor;
  s.key = key_of(sprite, a.actor->sample);
  const auto fetch = [&](std::uint32_t sample, auto& into) {
    if (is_there(into.key)) return;
    if (takes_blocks) into.blocks = a.frames->blocks(sample);
    if (into.blocks.bytes == nullptr) into.image = a.frames->frame(sample);
  };
  const float share = a.fade != nullptr ? fade_share(*a.fade, fraction) : 0.0f;
  if (share > 0) {
    s.fade.share = share;
    s.fade.anchor = sprite.samples()[a.fade->before].anchor;
    s.fade.key = key_of(sprite, a.fade->before);
    fetch(a.fade->before, s.fade);
  }
  fetch(a.actor->sample, s);
  return s;
}

// The shadow that was filmed with a sample, `share` of it.
void draw_filmed(Renderer& renderer, const ActorDraw& a, std::uint32_t sample, float fraction,
                 float share) {
  constexpr std::uint32_t kShadows = 1u << 31;  // beyond all samples
  const FilmedShadow* shadow = find_shadow(*a.sprite, sample);
  if (shadow == nullptr || !(share > 0)) return;
  const Vec2 at = draw_position(*a.sprite, *a.actor, fraction);
  SpriteDraw s{.key = key_of(*a.sprite, kShadows | sample),
               .position = {at.x + a.look.position.x, at.y + a.look.position.y},
               .anchor = shadow->anchor,
               .scale = a.look.scale * a.sprite->data().shadow_scale,
               .angle = a.look.angle,
               .mirror = a.look.mirror,
               .tint = {1, 1, 1, a.look.tint.a * share}};
  Image picture;
  if (!renderer.is_cached(reduced_key(s.key, s.scale * renderer.camera().scale))) {
    if (!decode_shadow(*shadow, picture)) return;
    s.image = picture;
  }
  renderer.draw_sprite(s);
}

void draw_filmed(Renderer& renderer, const ActorDraw& a, float fraction) {
  if (a.sprite->data().shadows.empty()) return;
  const float share = a.fade != nullptr ? fade_share(*a.fade, fraction) : 0.0f;
  draw_filmed(renderer, a, a.actor->sample, fraction, 1 - share);
  if (share > 0) draw_filmed(renderer, a, a.fade->before, fraction, share);
}

void draw_one(Renderer& renderer, const ActorDraw& a, float fraction) {
  // Blocks are drawn as they are, whatever the scale.
  const bool takes_blocks = renderer.takes_blocks() && a.sprite->has_blocks();
  const float scale = takes_blocks ? 1 : a.look.scale * renderer.camera().scale;
  renderer.draw_sprite(sprite_of(a, fraction, takes_blocks, [&](const TextureKey& key) {
    return renderer.is_cached(reduced_key(key, scale));
  }));
  a.frames->look_ahead(*a.actor);
}

}  // namespace

void draw_actor(Renderer& renderer, const Sprite& sprite, FrameCache& frames, const Actor& actor,
                float fraction, const SpriteDraw& look) {
  const ActorDraw one{&sprite, &frames, &actor, nullptr, look};
  draw_filmed(renderer, one, fraction);
  draw_one(renderer, one, fraction);
}

void draw_actor(Renderer& renderer, const Sprite& sprite, FrameCache& frames, const Actor& actor,
                const ActorFade& fade, float fraction, const SpriteDraw& look) {
  const ActorDraw one{&sprite, &frames, &actor, &fade, look};
  draw_filmed(renderer, one, fraction);
  draw_one(renderer, one, fraction);
}

void forget(Renderer& renderer, const Sprite& sprite) { renderer.forget(key_of(sprite, 0).sprite); }

void draw_actors(Renderer& renderer, std::span<const ActorDraw> actors, float fraction,
                 const Shadow* shadow) {
  for (const ActorDraw& a : actors) {
    draw_filmed(renderer, a, fraction);
    if (shadow == nullptr || !a.sprite->data().shadows.empty()) continue;
    const auto is_there = [&](const TextureKey& key) {
      return renderer.is_cached(shadow_key(key, *shadow));
    };
    renderer.draw_shadow(sprite_of(a, fraction, false, is_there), *shadow);
  }
  std::vector<std::pair<float, const ActorDraw*>> order;
  order.reserve(actors.size());
  for (const ActorDraw& a : actors) {
    const bool given = !std::isnan(a.depth);
    order.emplace_back(
        given ? a.depth : draw_position(*a.sprite, *a.actor, fraction).y + a.look.position.y, &a);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& entry : order) draw_one(renderer, *entry.second, fraction);
}

}  // namespace vsprite
