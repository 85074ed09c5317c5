// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Pictures by the C interface: decoded ones, and drawing without a graphics library.
#include "c_parts.h"
#include "vsprite/compose.h"
#include "vsprite/record.h"

using namespace vsprite;
using namespace vsprite::c;
using detail::MemoryScope;

namespace {

constexpr std::uint64_t kDefaultBudget = std::uint64_t{64} << 20;
constexpr std::uint32_t kMostSide = 16384;

vsprite_status check_colour(const char* call, std::uint32_t colour) noexcept {
  return colour <= VSPRITE_CLEAR ? VSPRITE_OK : bad(call, "0xRRGGBB or VSPRITE_CLEAR is due");
}

Image plain_image(std::uint32_t width, std::uint32_t height, std::uint32_t colour) {
  return make_image(static_cast<int>(width), static_cast<int>(height),
                    static_cast<std::uint8_t>(colour >> 16), static_cast<std::uint8_t>(colour >> 8),
                    static_cast<std::uint8_t>(colour), colour == VSPRITE_CLEAR ? 0 : 255);
}

// The fade of C is the fade of C++, field by field.
#define VSPRITE_SAME(field) offsetof(vsprite_fade, field) == offsetof(ActorFade, field)
static_assert(sizeof(vsprite_fade) == sizeof(ActorFade) && VSPRITE_SAME(shown) &&
              VSPRITE_SAME(before) && VSPRITE_SAME(held) && VSPRITE_SAME(length) &&
              VSPRITE_SAME(passed));
#undef VSPRITE_SAME

vsprite_status read_fade(const char* call, const Sprite& sprite, const vsprite_fade* theirs,
                         ActorFade& fade) noexcept {
  if (theirs == nullptr) return bad(call, "a fade is due, null was found");
  std::memcpy(static_cast<void*>(&fade), theirs, sizeof fade);
  const auto is_sample = [&](std::uint32_t s) {
    return s == kNoSample || s < sprite.samples().size();
  };
  const bool is_known =
      is_sample(fade.shown) && is_sample(fade.before) &&
      (fade.before == kNoSample || (fade.length <= kMostFade && fade.passed < fade.length));
  return is_known ? VSPRITE_OK : bad(call, "the fade is in a state that this sprite does not know");
}

vsprite_shown shown_of(const Sprite& sprite, ImageView pixels, std::uint32_t sample, Vec2 at,
                       float opacity) noexcept {
  const Vec2 anchor = sprite.samples()[sample].anchor;
  vsprite_shown shown{};
  shown.sample = sample;
  shown.width = static_cast<std::uint32_t>(pixels.width);
  shown.height = static_cast<std::uint32_t>(pixels.height);
  shown.stride = static_cast<std::uint32_t>(pixels.stride);
  shown.rgba = pixels.rgba;
  shown.left = at.x - anchor.x;
  shown.top = at.y - anchor.y;
  shown.opacity = opacity;
  return shown;
}

}  // namespace

vsprite_status vsprite_make_frames(vsprite_sprite* sprite, std::uint64_t budget,
                                   vsprite_frames** frames) {
  if (frames == nullptr) return bad(__func__, kNoResult);
  *frames = nullptr;
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  return guarded([&] {
    const MemoryScope scope(sprite->memory);
    if (budget == 0) budget = kDefaultBudget;
    *frames = new vsprite_frames(sprite, static_cast<std::size_t>(budget));
    sprite->users.fetch_add(1, std::memory_order_relaxed);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_close_frames(vsprite_frames** frames) {
  return close_user(__func__, frames);
}

vsprite_status vsprite_get_picture(vsprite_frames* frames, std::uint32_t sample,
                                   vsprite_picture* out) {
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  const auto samples = frames->sprite->engine->samples();
  if (sample >= samples.size()) return bad_index(__func__, "sample", sample, samples.size());
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const MemoryScope scope(frames->sprite->memory);
  const ImageView view = frames->cache.frame(sample);
  hand_out(vsprite_picture{.struct_size = size,
                           .width = static_cast<std::uint32_t>(view.width),
                           .height = static_cast<std::uint32_t>(view.height),
                           .stride = static_cast<std::uint32_t>(view.stride),
                           .rgba = view.rgba,
                           .anchor_x = samples[sample].anchor.x,
                           .anchor_y = samples[sample].anchor.y},
           size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_get_shadow(vsprite_frames* frames, std::uint32_t sample,
                                  vsprite_picture* out, float* scale) {
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  const Sprite& engine = *frames->sprite->engine;
  if (sample >= engine.samples().size())
    return bad_index(__func__, "sample", sample, engine.samples().size());
  if (scale == nullptr) return bad(__func__, kNoResult);
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const MemoryScope scope(frames->sprite->memory);
  vsprite_picture picture{};
  picture.struct_size = size;
  *scale = engine.data().shadow_scale;
  const FilmedShadow* shadow = find_shadow(engine, sample);
  if (shadow != nullptr && decode_shadow(*shadow, frames->shadow)) {
    const ImageView view = frames->shadow;
    picture.width = static_cast<std::uint32_t>(view.width);
    picture.height = static_cast<std::uint32_t>(view.height);
    picture.stride = static_cast<std::uint32_t>(view.stride);
    picture.rgba = view.rgba;
    picture.anchor_x = shadow->anchor.x;
    picture.anchor_y = shadow->anchor.y;
  }
  hand_out(picture, size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_look_ahead(vsprite_frames* frames, const vsprite_actor* theirs) {
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  Actor actor;
  if (const vsprite_status wrong = read_actor(__func__, *frames->sprite->engine, theirs, actor))
    return wrong;
  const MemoryScope scope(frames->sprite->memory);
  frames->cache.look_ahead(actor);
  return VSPRITE_OK;
}

vsprite_status vsprite_get_frames_stats(const vsprite_frames* frames, vsprite_frames_stats* out) {
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const FrameCacheStats& s = frames->cache.stats();
  hand_out(vsprite_frames_stats{size, s.hits, s.misses, s.ahead, s.damaged, s.bytes}, size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_hit(vsprite_frames* frames, const vsprite_actor* theirs, float x, float y,
                           float scale, std::int32_t alpha, std::int32_t* is_hit) {
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  if (is_hit == nullptr) return bad(__func__, kNoResult);
  if (!is_finite(x, y, scale) || scale <= 0 || alpha < 0 || alpha > 255)
    return bad(__func__, kNotFinite);
  const Sprite& engine = *frames->sprite->engine;
  Actor actor;
  if (const vsprite_status wrong = read_actor(__func__, engine, theirs, actor)) return wrong;
  const MemoryScope scope(frames->sprite->memory);
  const ImageView picture = frames->cache.frame(actor.sample);
  *is_hit = hit(engine, actor, picture, {x, y}, scale, static_cast<std::uint8_t>(alpha)) ? 1 : 0;
  return VSPRITE_OK;
}

// Showing.

vsprite_status vsprite_start_fade(vsprite_fade* fade) {
  if (fade == nullptr) return bad(__func__, kNoResult);
  const ActorFade none;
  std::memcpy(fade, &none, sizeof none);
  return VSPRITE_OK;
}

vsprite_status vsprite_follow_jumps(const vsprite_sprite* sprite, const vsprite_actor* theirs,
                                    vsprite_fade* theirs_too, std::int32_t ticks) {
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (ticks != kFadeAuto && ticks != kFadeOff && (ticks < kLeastFade || ticks > kMostFade))
    return bad(__func__, "0, 2 to 6 or -1 ticks are due");
  Actor actor;
  ActorFade fade;
  if (const vsprite_status wrong = read_actor(__func__, *sprite->engine, theirs, actor))
    return wrong;
  if (const vsprite_status wrong = read_fade(__func__, *sprite->engine, theirs_too, fade))
    return wrong;
  follow(*sprite->engine, actor, fade, ticks);
  std::memcpy(theirs_too, &fade, sizeof fade);
  return VSPRITE_OK;
}

vsprite_status vsprite_show(vsprite_frames* frames, const vsprite_actor* theirs,
                            const vsprite_fade* theirs_too, float fraction, vsprite_shown* shown,
                            vsprite_shown* fading) {
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  if (!(fraction >= 0 && fraction <= 1)) return bad(__func__, kNotFinite);
  const Sprite& engine = *frames->sprite->engine;
  Actor actor;
  ActorFade fade;
  std::uint32_t size = 0, fading_size = 0;
  if (const vsprite_status wrong = read_actor(__func__, engine, theirs, actor)) return wrong;
  if (const vsprite_status wrong = size_of(__func__, shown, size)) return wrong;
  if ((theirs_too == nullptr) != (fading == nullptr))
    return bad(__func__, "a fade and a place for its picture are due, or neither");
  if (fading != nullptr) {
    if (const vsprite_status wrong = read_fade(__func__, engine, theirs_too, fade)) return wrong;
    if (const vsprite_status wrong = size_of(__func__, fading, fading_size)) return wrong;
  }
  const MemoryScope scope(frames->sprite->memory);
  const Vec2 at = draw_position(engine, actor, fraction);
  const float share = fade_share(fade, fraction);
  if (share > 0 && engine.samples()[fade.before].width > 0)
    hand_out(shown_of(engine, frames->cache.frame(fade.before), fade.before, at, share),
             fading_size, fading);
  else if (fading != nullptr)
    hand_out(vsprite_shown{}, fading_size, fading);
  hand_out(shown_of(engine, frames->cache.frame(actor.sample), actor.sample, at, 1), size, shown);
  frames->cache.look_ahead(actor);
  return VSPRITE_OK;
}

// Drawing without a graphics library.

vsprite_status vsprite_make_canvas(std::uint32_t width, std::uint32_t height, std::uint32_t colour,
                                   vsprite_canvas** canvas) {
  if (canvas == nullptr) return bad(__func__, kNoResult);
  *canvas = nullptr;
  if (width < 1 || width > kMostSide || height < 1 || height > kMostSide)
    return bad(__func__, "1 to 16384 px a side are due");
  if (const vsprite_status wrong = check_colour(__func__, colour)) return wrong;
  return guarded([&] {
    auto handle = std::make_unique<vsprite_canvas>();
    handle->image = plain_image(width, height, colour);
    *canvas = handle.release();
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_close_canvas(vsprite_canvas** canvas) {
  return close_handle(__func__, canvas, [](vsprite_canvas* c) { delete c; });
}

vsprite_status vsprite_clear_canvas(vsprite_canvas* canvas, std::uint32_t colour) {
  if (!is_open(canvas)) return bad(__func__, kNoCanvas);
  if (const vsprite_status wrong = check_colour(__func__, colour)) return wrong;
  return guarded([&] {
    canvas->image = plain_image(static_cast<std::uint32_t>(canvas->image.width),
                                static_cast<std::uint32_t>(canvas->image.height), colour);
    return VSPRITE_OK;
  });
}

vsprite_status vsprite_draw_actor(vsprite_canvas* canvas, vsprite_frames* frames,
                                  const vsprite_actor* theirs, float fraction, float scale) {
  if (!is_open(canvas)) return bad(__func__, kNoCanvas);
  if (!is_open(frames)) return bad(__func__, kNoFrames);
  if (!(fraction >= 0 && fraction <= 1) || !(scale > 0 && scale <= 1000))
    return bad(__func__, kNotFinite);
  const Sprite& engine = *frames->sprite->engine;
  Actor actor;
  if (const vsprite_status wrong = read_actor(__func__, engine, theirs, actor)) return wrong;
  const MemoryScope scope(frames->sprite->memory);
  DrawOptions options;
  options.scale = scale;
  const Vec2 at = draw_position(engine, actor, fraction);
  draw_shadow(canvas->image, engine, actor.sample, at, options);
  draw_sample(canvas->image, frames->cache.frame(actor.sample), engine.samples()[actor.sample], at,
              options);
  return VSPRITE_OK;
}

vsprite_status vsprite_get_canvas(const vsprite_canvas* canvas, vsprite_picture* out) {
  if (!is_open(canvas)) return bad(__func__, kNoCanvas);
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  const ImageView view = canvas->image;
  vsprite_picture picture{};
  picture.width = static_cast<std::uint32_t>(view.width);
  picture.height = static_cast<std::uint32_t>(view.height);
  picture.stride = static_cast<std::uint32_t>(view.stride);
  picture.rgba = view.rgba;
  hand_out(picture, size, out);
  return VSPRITE_OK;
}

vsprite_status vsprite_save_canvas(const vsprite_canvas* canvas, const char* path) {
  if (!is_open(canvas)) return bad(__func__, kNoCanvas);
  if (path == nullptr) return bad(__func__, kNoPath);
  return guarded([&]() -> vsprite_status {
    Image straight = canvas->image;
    unpremultiply(straight);
    const Result<void> saved = save_png(path, straight);
    return saved ? VSPRITE_OK : fail(saved.error());
  });
}
