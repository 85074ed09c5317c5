// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What runs every tick takes no memory.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "support/naive_actions.h"
#include "support/tiny_puppet.h"
#include "support/tiny_sprite.h"
#include "vsprite/action.h"
#include "vsprite/actor.h"
#include "vsprite/compose.h"
#include "vsprite/events.h"
#include "vsprite/input.h"
#include "vsprite/owner.h"
#include "vsprite/replay.h"

namespace {
std::atomic<long> allocations{0};
}

// Not inlined: the compiler would see malloc where new is due, and warn.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size ? size : 1)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size ? size : 1);
}
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace vsprite {
namespace {

TEST(Allocation, ATickTakesNoMemory) {
  const Sprite sprite = testing::tiny_sprite();
  const KeyScript script = *parse_key_script("0 right; 2 left+up; 5 rest; 7 none", sprite.fps());
  Image picture = testing::tiny_picture(sprite.data(), 1);
  premultiply(picture);
  Image canvas = make_checkerboard(64, 64);
  const long before = allocations;
  Actor actor = make_actor(sprite, {32, 32}, 0, 1);
  StateHash hash;
  for (std::uint64_t tick = 0; tick < 300; ++tick) {
    if (tick < 200) {
      set_direction(sprite, actor, script.at(tick));
    } else {
      set_target(sprite, actor, {500, -80}, 10);
    }
    if (tick % 3 == 0) {
      step(sprite, actor, StepWish{.slack = 0.3f});
    } else {
      step(sprite, actor);
    }
    hash.add(actor);
    draw_sample(canvas, picture, sprite.samples()[actor.sample],
                draw_position(sprite, actor, 0.5f));
  }
  EXPECT_EQ(allocations, before);
  EXPECT_NE(hash.digest(), 0u);
}

TEST(Allocation, ActionsEventsAndOwnersTakeNone) {
  const Sprite sprite = *make_sprite(testing::acting_sprite_data());
  const KeyScript script =
      *parse_key_script("0 play jump 4; 1 release 2; 2 hold wave; 3 cancel", 30);
  const long before = allocations;
  Actor actor = make_actor(sprite, {}, 0, 1);
  std::size_t events = 0;
  for (std::uint64_t tick = 0; tick < 300; ++tick) {
    play_script(sprite, script, tick, actor);
    if (tick > 150) follow(sprite, actor, {50, static_cast<float>(tick % 90) - 45});
    if (tick > 250) own_scaled(actor, {2, 2});
    step(sprite, actor);
    events += events_of(sprite, actor).named.size() + hash_states({&actor, 1}) % 2;
  }
  EXPECT_EQ(allocations, before);
}

TEST(Allocation, PosingAndDrawingAPuppetTakesNone) {
  const Puppet puppet = testing::glass_puppet();
  PuppetPose pose = make_pose(puppet);
  const Puppet two_sets = testing::puppet_of_two_sets();
  PuppetPose between = make_pose(two_sets);
  PuppetPainter painter;
  Image canvas = make_checkerboard(64, 64);
  render_puppet(puppet, pose, painter, canvas, {8, 8});  // the painter takes what it needs once
  const long before = allocations;
  for (int tick = 0; tick < 50; ++tick) {
    pose_puppet(puppet, std::array{tick / 50.0}, pose);
    pose_puppet(two_sets, std::array{tick / 5.0}, between);
    render_puppet(puppet, pose, painter, canvas, {8, 8}, 0.5f);
    (void)reach_for({0, 0}, {static_cast<float>(tick), 4}, 20, 20, -1);
  }
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace vsprite
