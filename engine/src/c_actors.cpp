// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Actors by the C interface: steered, stepped, made to act, moved by the game; and where they are.
#include "c_parts.h"

using namespace vsprite;
using namespace vsprite::c;

namespace {

struct ClearanceWorld {
  float (*clearance)(const void* world, float x, float y);
  const void* world;
};

float ask_clearance(const void* world, Vec2 position) {
  const auto* w = static_cast<const ClearanceWorld*>(world);
  return w->clearance(w->world, position.x, position.y);
}

vsprite_box to_c(const Box& b) noexcept { return {b.left, b.top, b.right, b.bottom}; }

vsprite_status check_play(const char* call, const vsprite_sprite* sprite, std::uint32_t action,
                          std::int32_t within) noexcept {
  if (!is_open(sprite)) return bad(call, kNoSprite);
  if (const vsprite_status wrong = check_action(call, *sprite->engine, action)) return wrong;
  return is_within(within) ? VSPRITE_OK : bad(call, kNotWithin);
}

}  // namespace

vsprite_status vsprite_make_actor(const vsprite_sprite* sprite, float x, float y,
                                  std::uint64_t seed, std::uint32_t mode, vsprite_actor* actor) {
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (actor == nullptr) return bad(__func__, kNoActor);
  if (!is_finite(x, y)) return bad(__func__, kNotFinite);
  const std::size_t modes = sprite->engine->data().modes.size();
  if (mode >= modes) return bad_index(__func__, "mode", mode, modes);
  const Actor made = make_actor(*sprite->engine, {x, y}, seed, static_cast<int>(mode));
  std::memcpy(actor, &made, sizeof made);
  return VSPRITE_OK;
}

vsprite_status vsprite_check_actor(const vsprite_sprite* sprite, const vsprite_actor* actor) {
  return with_actor(__func__, sprite, actor, [](const Sprite&, const Actor&) {});
}

vsprite_status vsprite_set_direction(const vsprite_sprite* sprite, vsprite_actor* actor,
                                     std::int32_t direction) {
  if (direction < 0 || direction >= kDirectionCount) return bad(__func__, "no such direction");
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    set_direction(s, a, static_cast<Direction>(direction));
  });
}

std::int32_t vsprite_direction_from_axes(std::int32_t x, std::int32_t y) {
  return static_cast<std::int32_t>(direction_from_axes((x > 0) - (x < 0), (y > 0) - (y < 0)));
}

vsprite_status vsprite_set_heading(const vsprite_sprite* sprite, vsprite_actor* actor, float x,
                                   float y) {
  if (!is_finite(x, y)) return bad(__func__, kNotFinite);
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    set_heading(s, a, {x, y});
  });
}

vsprite_status vsprite_set_target(const vsprite_sprite* sprite, vsprite_actor* actor, float x,
                                  float y, float arrive_radius) {
  if (!is_finite(x, y, arrive_radius) || arrive_radius < 0) return bad(__func__, kNotFinite);
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    set_target(s, a, {x, y}, arrive_radius);
  });
}

vsprite_status vsprite_step(const vsprite_sprite* sprite, vsprite_actor* actor) {
  return change_actor(__func__, sprite, actor, [](const Sprite& s, Actor& a) { step(s, a); });
}

vsprite_status vsprite_step_many(const vsprite_sprite* sprite, vsprite_actor* actors,
                                 std::size_t count) {
  if (!is_open(sprite)) return bad(__func__, kNoSprite);
  if (actors == nullptr && count > 0) return bad(__func__, kNoActor);
  std::array<Actor, 128> some;
  for (std::size_t i = 0; i < count; ++i) {
    copy_actors(some.data(), actors + i, 1);
    if (is_playable(*sprite->engine, some[0])) continue;
    return say(VSPRITE_BAD_ARGUMENT, "%s: actor %zu: %s", __func__, i, kStrange);
  }
  for (std::size_t at = 0; at < count;) {
    const std::size_t n = std::min(some.size(), count - at);
    copy_actors(some.data(), actors + at, n);
    step(*sprite->engine, std::span(some).first(n));
    std::memcpy(actors + at, some.data(), n * sizeof(Actor));
    at += n;
  }
  return VSPRITE_OK;
}

vsprite_status vsprite_step_wish(const vsprite_sprite* sprite, vsprite_actor* actor,
                                 const vsprite_wish* theirs) {
  vsprite_wish wish{};
  if (const vsprite_status wrong = take_in(__func__, theirs, wish)) return wrong;
  if (!is_finite(wish.slack) || wish.slack < 0) return bad(__func__, kNotFinite);
  if (wish.pace < 0 || wish.pace > 2) return bad(__func__, "no such pace");
  const ClearanceWorld world{wish.clearance, wish.world};
  StepWish asked;
  asked.slack = wish.slack;
  asked.pace = static_cast<Pace>(wish.pace);
  if (wish.clearance != nullptr) asked.clearance = ask_clearance;
  asked.world = &world;
  return change_actor(__func__, sprite, actor,
                      [&](const Sprite& s, Actor& a) { step(s, a, asked); });
}

vsprite_status vsprite_draw_position(const vsprite_sprite* sprite, const vsprite_actor* actor,
                                     float fraction, float* x, float* y) {
  if (x == nullptr || y == nullptr) return bad(__func__, kNoResult);
  if (!(fraction >= 0 && fraction <= 1)) return bad(__func__, kNotFinite);
  return with_actor(__func__, sprite, actor, [&](const Sprite& s, const Actor& a) {
    const Vec2 at = draw_position(s, a, fraction);
    *x = at.x;
    *y = at.y;
  });
}

vsprite_status vsprite_get_events(const vsprite_sprite* sprite, const vsprite_actor* actor,
                                  vsprite_tick_events* out) {
  std::uint32_t size = 0;
  if (const vsprite_status wrong = size_of(__func__, out, size)) return wrong;
  return with_actor(__func__, sprite, actor, [&](const Sprite& s, const Actor& a) {
    const TickEvents now = events_of(s, a);
    vsprite_tick_events events{};
    events.frame_shown = now.frame_shown ? 1 : 0;
    events.jump_taken = now.jump_taken ? 1 : 0;
    events.named_count = static_cast<std::uint32_t>(now.named.size());
    events.named = reinterpret_cast<const vsprite_sample_event*>(now.named.data());
    hand_out(events, size, out);
  });
}

// Actions.

vsprite_status vsprite_play(const vsprite_sprite* sprite, vsprite_actor* actor,
                            std::uint32_t action, std::int32_t within, std::int32_t hold) {
  if (const vsprite_status wrong = check_play(__func__, sprite, action, within)) return wrong;
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    play(s, a, static_cast<int>(action), within, hold != 0);
  });
}

vsprite_status vsprite_queue(const vsprite_sprite* sprite, vsprite_actor* actor,
                             std::uint32_t action, std::int32_t hold) {
  if (const vsprite_status wrong = check_play(__func__, sprite, action, kNoDeadline)) return wrong;
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    queue(s, a, static_cast<int>(action), hold != 0);
  });
}

vsprite_status vsprite_release(const vsprite_sprite* sprite, vsprite_actor* actor,
                               std::int32_t within) {
  if (!is_within(within)) return bad(__func__, kNotWithin);
  return change_actor(__func__, sprite, actor,
                      [&](const Sprite& s, Actor& a) { release(s, a, within); });
}

vsprite_status vsprite_cancel(const vsprite_sprite* sprite, vsprite_actor* actor) {
  return change_actor(__func__, sprite, actor, [](const Sprite& s, Actor& a) { cancel(s, a); });
}

// Who moves it.

vsprite_status vsprite_follow(const vsprite_sprite* sprite, vsprite_actor* actor, float x,
                              float y) {
  if (!is_finite(x, y)) return bad(__func__, kNotFinite);
  return change_actor(__func__, sprite, actor, [&](const Sprite& s, Actor& a) {
    follow(s, a, {x, y});
  });
}

vsprite_status vsprite_own_scaled(const vsprite_sprite* sprite, vsprite_actor* actor, float x,
                                  float y) {
  if (!is_factor(x, y)) return bad(__func__, kNotFinite);
  return change_actor(__func__, sprite, actor, [&](const Sprite&, Actor& a) {
    own_scaled(a, {x, y});
  });
}

vsprite_status vsprite_own_recorded(const vsprite_sprite* sprite, vsprite_actor* actor) {
  return change_actor(__func__, sprite, actor, [](const Sprite&, Actor& a) { own_recorded(a); });
}

// Where it is.

vsprite_status vsprite_body_box(const vsprite_sprite* sprite, const vsprite_actor* actor,
                                float scale, vsprite_box* box) {
  if (box == nullptr) return bad(__func__, kNoResult);
  if (!is_finite(scale) || scale <= 0) return bad(__func__, kNotFinite);
  return with_actor(__func__, sprite, actor,
                    [&](const Sprite& s, const Actor& a) { *box = to_c(body_box(s, a, scale)); });
}

vsprite_status vsprite_drawn_box(const vsprite_sprite* sprite, const vsprite_actor* actor,
                                 float scale, vsprite_box* box) {
  if (box == nullptr) return bad(__func__, kNoResult);
  if (!is_finite(scale) || scale <= 0) return bad(__func__, kNotFinite);
  return with_actor(__func__, sprite, actor,
                    [&](const Sprite& s, const Actor& a) { *box = to_c(drawn_box(s, a, scale)); });
}
