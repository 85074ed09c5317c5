// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// maze - the paper's fish: it swims through a maze by script until somebody takes the keys, and
// then has to eat everything in it.
#include <cmath>
#include <cstdio>
#include <optional>

#include "arguments.h"
#include "maze.h"
#include "vsprite/clip.h"
#include "vsprite/session.h"
#include "vsprite/vsprite.h"

using namespace vsprite;
using namespace vsprite::maze;

namespace {

constexpr double kIdle = 12;  // s without a key until the script takes over again

struct World {
  std::vector<Corridor> corridors = make_corridors();
  std::vector<Vec2> food = make_food(corridors);
  bool is_played = false;
  double idle = 0, seconds = 0;  // since the last key; of play
  std::size_t goal = 1;          // without a clip: the corner that is swum to
};

// By script: the pack's clip, or, where it has none, from corner to corner by the tables.
struct Attract {
  std::optional<PackClip> clip;
  ClipPlayer player;
};

// The sprite of any pack swims in a maze of its own size: `unit` maze px are one sprite px.
float unit_of(const Sprite& sprite) {
  return sprite.data().body_length > 0 ? kBody / sprite.data().body_length : 1;
}
Vec2 in_maze(Position p, float unit) {
  const Vec2 px = to_pixels(p);
  return {px.x * unit, px.y * unit};
}
Position in_sprite(Vec2 p, float unit) { return to_position({p.x / unit, p.y / unit}); }

void begin(World& world, Attract& attract, const Sprite& sprite, Actor& actor, std::uint64_t seed) {
  world = {};
  if (attract.clip) attract.player = start_clip(*attract.clip);
  const Position start = in_sprite(kScript[0], unit_of(sprite));
  actor = make_actor(sprite, to_pixels(start), seed);
}

// One tick of the actor, held in the corridors; what it swims over is eaten.
void swim(World& world, const Sprite& sprite, Actor& actor) {
  const float unit = unit_of(sprite);
  const Vec2 from = in_maze(actor.position, unit);
  step(sprite, actor);
  const Vec2 to = in_maze(actor.position, unit), free = slide(world.corridors, from, to);
  if (!(free == to)) actor.position = in_sprite(free, unit);
  eat(world.food, free);
}

void attract_tick(World& world, Attract& attract, const Sprite& sprite, Actor& actor) {
  if (attract.clip) {
    const PackClip& clip = *attract.clip;
    if (!step(sprite, clip, attract.player)) attract.player = start_clip(clip);
    actor.sample = clip.samples[attract.player.index];
    actor.position = attract.player.position;
    return;
  }
  const Vec2 goal = kScript[world.goal], at = in_maze(actor.position, unit_of(sprite));
  if (std::hypot(goal.x - at.x, goal.y - at.y) < kReach)
    world.goal = (world.goal + 1) % kScript.size();
  set_target(sprite, actor, to_pixels(in_sprite(goal, unit_of(sprite))), 1);
  swim(world, sprite, actor);
}

void play_tick(World& world, const Sprite& sprite, Actor& actor, Direction direction) {
  world.idle = direction == Direction::None ? world.idle + 1 / sprite.fps() : 0;
  if (!world.food.empty()) world.seconds += 1 / sprite.fps();
  set_direction(sprite, actor, direction);
  swim(world, sprite, actor);
}

void draw_maze(Renderer& screen, const World& world) {
  screen.clear(srgb(0x2f4858));
  for (const Corridor& c : world.corridors)
    screen.draw_shape(line(c.from, c.to, 2 * kWall + 16, srgb(0x1f3440)));
  for (const Corridor& c : world.corridors)
    screen.draw_shape(line(c.from, c.to, 2 * kWall, srgb(0x9cc4d8)));
  for (const Vec2 p : world.food) screen.draw_shape(disc(p, 9, srgb(0xd9822b)));
}

void draw_words(Renderer& screen, const World& world, std::size_t all) {
  char text[80];
  if (!world.is_played)
    std::snprintf(text, sizeof text, "an arrow key takes the fish");
  else if (world.food.empty())
    std::snprintf(text, sizeof text, "all eaten in %.1f s", world.seconds);
  else
    std::snprintf(text, sizeof text, "%zu of %zu  %.0f s", all - world.food.size(), all,
                  world.seconds);
  screen.draw_text(text, {static_cast<float>(screen.width()) / 2, 12},
                   {.size = 24, .color = srgb(0xffffff), .align = Align::Center});
}

Camera camera_for(const Renderer& screen) {
  const auto width = static_cast<float>(screen.width()),
             height = static_cast<float>(screen.height());
  const float scale = std::min(width / kSize.x, (height - 48) / kSize.y);
  return {.scale = scale,
          .offset = {(width - scale * kSize.x) / 2, 48 + (height - 48 - scale * kSize.y) / 2}};
}

Result<void> run_maze(const games::Arguments& arguments) {
  const Result<Sprite> sprite = load_pack(arguments.pack);
  if (!sprite) return sprite.error();
  Result<std::vector<PackClip>> clips = load_clips(arguments.pack, *sprite);
  if (!clips) return clips.error();
  Result<Session> session =
      Session::open(games::session_config("maze", sprite->fps(), arguments, &*sprite));
  if (!session) return session.error();

  Renderer& screen = session->renderer();
  FrameCache frames(*sprite);
  World world;
  Attract attract;
  for (PackClip& clip : *clips)
    if (clip.name == "maze") attract.clip = std::move(clip);
  Actor actor;
  ActorFade fade;
  begin(world, attract, *sprite, actor, arguments.seed);
  const std::size_t all = world.food.size();
  while (session->next_frame()) {
    while (session->next_tick()) {
      const Direction direction = session->direction();
      if (!world.is_played && direction != Direction::None) {
        begin(world, attract, *sprite, actor, arguments.seed);
        world.is_played = true;
      }
      if (world.is_played) {
        session->play_actions(*sprite, actor);
        play_tick(world, *sprite, actor, direction);
      } else {
        attract_tick(world, attract, *sprite, actor);
      }
      if (world.is_played && world.idle > kIdle)
        begin(world, attract, *sprite, actor, arguments.seed);
      follow(*sprite, actor, fade, arguments.fade);
    }
    screen.set_camera(camera_for(screen));
    draw_maze(screen, world);
    const float unit = unit_of(*sprite);
    const Vec2 at = draw_position(*sprite, actor, world.is_played ? session->fraction() : 0);
    draw_actor(screen, *sprite, frames, actor, fade, world.is_played ? session->fraction() : 0,
               {.position = {at.x * (unit - 1), at.y * (unit - 1)}, .scale = unit});
    screen.set_camera({});
    draw_words(screen, world, all);
    session->show();
    if (session->input().was_pressed(kKeyEscape)) session->close();
  }
  return session->finish();
}

}  // namespace

int main(int argc, char** argv) {
  return games::run(argc, argv, "maze", "build/goldfish.vsp",
                    [](const games::Arguments& arguments) { return run_maze(arguments); });
}
