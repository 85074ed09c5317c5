// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Actors as pictures of a Renderer: which picture, where, and what still fades out of it.
#include <cstdint>

#include "vsprite/draw.h"

namespace vsprite {
namespace {

TextureKey key_of(const Sprite& sprite, std::uint32_t sample) {
  return {reinterpret_cast<std::uintptr_t>(&sprite.data()), sample};
}

}  // namespace

void draw_actor(Renderer& renderer, const Sprite& sprite, FrameCache& frames, const Actor& actor,
                float fraction, const SpriteDraw& look) {
  draw_actor(renderer, sprite, frames, actor, ActorFade{}, fraction, look);
}

void draw_actor(Renderer& renderer, const Sprite& sprite, FrameCache& frames, const Actor& actor,
                const ActorFade& fade, float fraction, const SpriteDraw& look) {
  SpriteDraw s = look;
  const Vec2 at = draw_position(sprite, actor, fraction);
  s.position = {at.x + look.position.x, at.y + look.position.y};
  s.anchor = sprite.samples()[actor.sample].anchor;
  s.key = key_of(sprite, actor.sample);
  const float share = fade_share(fade, fraction);
  if (share > 0) {
    s.fade.share = share;
    s.fade.anchor = sprite.samples()[fade.before].anchor;
    s.fade.key = key_of(sprite, fade.before);
    if (!renderer.is_cached(s.fade.key)) s.fade.image = frames.frame(fade.before);
  }
  if (!renderer.is_cached(s.key)) s.image = frames.frame(actor.sample);
  renderer.draw_sprite(s);
  frames.look_ahead(actor);
}

}  // namespace vsprite
