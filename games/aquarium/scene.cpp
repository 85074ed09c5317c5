// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The tank from back to front: water, then weeds and fish by depth, food, sparks, the near weeds.
#include "scene.h"

#include <array>
#include <cmath>
#include <string>

#include "shaders/aquarium.h"

namespace aquarium {

namespace glsl = vsprite::shaders::aquarium;
using vsprite::BlendMode;
using vsprite::Color;
using vsprite::Effect;
using vsprite::Layer;
using vsprite::Rect;
using vsprite::Renderer;
using vsprite::Result;
using vsprite::Shape;
using vsprite::Uniform;
using vsprite::Vec2;

namespace {

constexpr int kNetSize = 128;  // pixels of the caustics tile
constexpr float kSparkSeconds = 1.1f;

/// A boulder: where it lies, and its look (seed, moss, water in between, brightness).
struct Stone {
  float x, y, half_width, half_height;
  std::array<float, 4> look;
};
constexpr std::array<Stone, 2> kStonesBehindWood{{
    {1105, 596, 122, 112, {3, 0.5f, 0.15f, 1.1f}},
    {200, 606, 134, 98, {1, 0.6f, 0.15f, 1.1f}},
}};
constexpr std::array<Stone, 6> kStonesBeforeWood{{
    {66, 650, 132, 100, {2, 0.45f, 0.08f, 1.1f}},
    {1228, 642, 120, 92, {5, 0.35f, 0.08f, 1.1f}},
    {336, 652, 66, 42, {7, 0.20f, 0.07f, 1.2f}},
    {982, 650, 58, 38, {8, 0.20f, 0.07f, 1.2f}},
    {1066, 668, 36, 24, {9, 0.0f, 0.05f, 1.6f}},
    {408, 668, 30, 20, {4, 0.0f, 0.05f, 1.5f}},
}};
constexpr std::array<float, 24> kShades{1105, 596, 122, 112, 200, 606, 134, 98, 66,  650, 132, 100,
                                        1228, 642, 120, 92,  336, 652, 66,  42, 982, 650, 58,  38};

/// Frame pixels that cover a box of the tank; nothing if it lies outside.
Rect frame_area(const View& view, Box box, int width, int height) {
  const auto x = [&](float v) {
    return std::clamp(static_cast<int>(v * view.scale + view.offset.x), 0, width);
  };
  const auto y = [&](float v) {
    return std::clamp(static_cast<int>(v * view.scale + view.offset.y), 0, height);
  };
  const int left = x(box.left);
  const int top = y(box.top);
  return {left, top, std::min(x(box.right) + 1, width) - left,
          std::min(y(box.bottom) + 1, height) - top};
}

Uniform view_uniform(const View& view) {
  return Uniform("view", view.offset.x, view.offset.y, view.scale);
}

float unit_hash(int a, int b) {
  Random dice{static_cast<std::uint64_t>(a) * 7919u + static_cast<std::uint64_t>(b) * 104729u + 1u};
  return dice.between(0, 1);
}

}  // namespace

const char* quality_name(Quality quality) noexcept {
  constexpr std::array<const char*, 3> kNames{"low", "middle", "high"};
  return kNames[static_cast<std::size_t>(quality)];
}

float resolution_of(Quality quality, int window_height) noexcept {
  constexpr std::array<float, 3> kLines{400, 540, 1e9f};
  const float lines = kLines[static_cast<std::size_t>(quality)];
  return std::min(1.0f, lines / static_cast<float>(std::max(1, window_height)));
}

Result<Scene> Scene::make(Renderer& renderer) {
  Scene scene;
  const auto compile = [&](Effect& effect, const char* name, const std::string& text) {
    Result<Effect> made = renderer.make_effect(name, text);
    if (made) effect = *made;
    return made;
  };
  const std::string common(glsl::common_frag);
  struct Source {
    Effect* effect;
    const char* name;
    std::string text;
  };
  const std::array<Source, 7> sources{{
      {&scene.wall_, "aquarium/wall.frag", common + std::string(glsl::wall_frag)},
      {&scene.gravel_, "aquarium/gravel.frag", common + std::string(glsl::gravel_frag)},
      {&scene.stone_, "aquarium/stone.frag", common + std::string(glsl::stone_frag)},
      {&scene.wood_, "aquarium/wood.frag", common + std::string(glsl::wood_frag)},
      {&scene.caustics_, "aquarium/caustics.frag", std::string(glsl::caustics_frag)},
      {&scene.light_effect_, "aquarium/light.frag", common + std::string(glsl::light_frag)},
      {&scene.water_, "aquarium/water.frag", std::string(glsl::water_frag)},
  }};
  for (const Source& source : sources) {
    const Result<Effect> made = compile(*source.effect, source.name, source.text);
    if (!made) return made.error();
  }
  const Result<Layer> net = renderer.make_layer(kNetSize, kNetSize, vsprite::LayerFormat::Bytes);
  if (!net) return net.error();
  scene.net_ = *net;
  return scene;
}

void Scene::notice(const vsprite::Sprite& sprite, const World& world, float seconds, int fade) {
  fades_.resize(world.fish.size());
  for (std::size_t i = 0; i < fades_.size(); ++i)
    vsprite::follow(sprite, world.fish[i].actor, fades_[i], fade);
  for (const Event& event : world.events) sparks_.push_back({event, seconds});
  std::erase_if(sparks_, [&](const Spark& s) { return seconds - s.born > kSparkSeconds; });
}

void Scene::draw_backdrop(Renderer& renderer) {
  const int width = renderer.width();
  const int height = renderer.height();
  renderer.free_layer(backdrop_);
  const Result<Layer> made = renderer.make_layer(width, height);
  backdrop_ = made ? *made : Layer{};
  backdrop_width_ = width;
  backdrop_height_ = height;

  const Uniform view = view_uniform(view_);
  const auto area = [&](Box box) {
    return vsprite::EffectPass{frame_area(view_, box, width, height), BlendMode::Replace};
  };
  const auto put = [&](const Stone& s) {
    const std::array<float, 4> place{s.x, s.y, s.half_width, s.half_height};
    const vsprite::EffectPass pass = area({s.x - 1.5f * s.half_width, s.y - 1.5f * s.half_height,
                                           s.x + 1.5f * s.half_width, s.y + 1.3f * s.half_height});
    if (pass.area.width <= 0 || pass.area.height <= 0) return;
    renderer.run_effect(
        stone_, std::array{view, Uniform("place", place, 4), Uniform("look", s.look, 4)}, pass);
  };
  renderer.begin_layer(backdrop_);
  renderer.run_effect(wall_, {&view, 1}, {{}, BlendMode::Replace});
  renderer.run_effect(gravel_, std::array{view, Uniform("stones", kShades, 4)},
                      area({-1e5f, 552, 1e5f, 1e5f}));
  for (const Stone& stone : kStonesBehindWood) put(stone);
  renderer.run_effect(wood_, {&view, 1}, area({-60, 290, 530, 690}));
  for (const Stone& stone : kStonesBeforeWood) put(stone);
  renderer.end_layer();
}

/// All light that moves, at a part of the resolution: it is soft, and costs most of a pixel's time.
void Scene::draw_light(Renderer& renderer, float seconds) {
  constexpr int part = 3;
  const int width = std::max(1, renderer.width() / part);
  const int height = std::max(1, renderer.height() / part);
  if (width != light_width_ || height != light_height_) {
    renderer.free_layer(light_);
    const Result<Layer> made = renderer.make_layer(width, height, vsprite::LayerFormat::Bytes);
    light_ = made ? *made : Layer{};
    light_width_ = width;
    light_height_ = height;
  }
  const Uniform time("time", std::fmod(seconds, 3600.0f));
  renderer.begin_layer(net_);
  renderer.run_effect(caustics_, {&time, 1}, {{}, BlendMode::Replace});
  renderer.end_layer();

  const float x = static_cast<float>(width) / static_cast<float>(renderer.width());
  const float y = static_cast<float>(height) / static_cast<float>(renderer.height());
  const View small{view_.scale * x, {view_.offset.x * x, view_.offset.y * y}};
  renderer.begin_layer(light_);
  renderer.run_effect(light_effect_,
                      std::array{view_uniform(small), time, Uniform("caustics", net_)},
                      {{}, BlendMode::Replace});
  renderer.end_layer();
}

void Scene::draw_far(Renderer& renderer, vsprite::FrameCache& frames, const Moment& moment) {
  // Fish lie in the world from near to far (the player's first); weeds of their depth go first.
  float far = 9;
  for (std::size_t k = moment.world.fish.size(); k-- > 1;) {
    const Fish& fish = moment.world.fish[k];
    draw_plants(renderer, moment, far, fish.depth);
    draw_fish(renderer, frames, moment, k);
    far = fish.depth;
  }
  draw_plants(renderer, moment, far, 0);
}

void Scene::draw_plants(Renderer& renderer, const Moment& moment, float far, float near) {
  vertices_.clear();
  for (const Plant& plant : plants_) {
    if (plant.depth > far || plant.depth <= near) continue;
    grow_plant(plant, moment.seconds, wakes_, 1 / view_.scale, vertices_);
  }
  renderer.set_camera(camera_of(view_));
  renderer.draw_triangles(vertices_);
}

void Scene::draw_fish(Renderer& renderer, vsprite::FrameCache& frames, const Moment& moment,
                      std::size_t which) const {
  const Fish& fish = moment.world.fish[which];
  const Vec2 at = place_of(fish);
  // Its shade on the gravel: wider and fainter the higher it swims.
  const float ground = 690 - 95 * fish.depth;
  const float height = std::max(0.0f, (ground - at.y) / kTankHeight);
  const float half = 0.40f * moment.sprite.data().body_length * fish.scale;
  Shape shade;
  shade.center = {at.x + 0.10f * (ground - at.y), ground};
  shade.half_size = {half * (1 + height), 0.17f * half * (1 + height)};
  shade.radius = shade.half_size.y;
  shade.feather = shade.half_size.y * 1.6f;
  shade.color = {0.0f, 0.01f, 0.015f, (0.42f - 0.30f * fish.depth) * std::exp(-3.2f * height)};
  renderer.set_camera(camera_of(view_));
  renderer.draw_shape(shade);

  vsprite::SpriteDraw look;
  const float light = shimmer(at, moment.seconds);
  // Red is lost first, as everywhere under water.
  look.tint = {(1 - 0.42f * fish.depth) * light, (1 - 0.10f * fish.depth) * light, 0.97f * light,
               1};
  look.fog = water_at(at);
  // Between two ticks draw_actor knows the film's own way; a glide goes on beside it.
  const Vec2 glide = glide_of(moment.sprite, fish);
  look.position = {glide.x * moment.fraction, glide.y * moment.fraction};
  look.fog_amount = std::min(0.85f, 0.03f + 0.66f * fish.depth);
  renderer.set_camera(camera_of(view_, fish.scale));
  const vsprite::ActorFade fade = which < fades_.size() ? fades_[which] : vsprite::ActorFade{};
  vsprite::draw_actor(renderer, moment.sprite, frames, fish.actor, fade, moment.fraction, look);
}

void Scene::draw_food(Renderer& renderer, const Moment& moment) const {
  renderer.set_camera(camera_of(view_));
  for (const Flake& flake : moment.world.flakes) {
    const float fresh = smooth_step(0, 8, static_cast<float>(flake.age));
    const float fade = 1 - smooth_step(90, 150, static_cast<float>(flake.rested));
    const float roll = static_cast<float>(flake.age) * 0.05f + 6.28f * flake.phase;
    const float moving = flake.rested == 0 ? moment.fraction : 0.0f;
    const Vec2 at{flake.at.x, flake.at.y + flake.fall * moving};
    const float light = 0.35f + shimmer(at, moment.seconds);
    Shape halo = vsprite::disc(at, 1.2f * flake.size, {1.0f, 0.62f, 0.25f, 0.10f * fade * fresh});
    halo.feather = 2.2f * flake.size;
    halo.blend = BlendMode::Add;
    if (flake.dainty) {
      halo.color = {1.0f, 0.55f, 0.15f, 0.34f * fade * fresh};
      halo.feather = 3.4f * flake.size;
    }
    renderer.draw_shape(halo);
    Shape chip;
    chip.center = at;
    const float turn = 0.45f + 0.55f * std::abs(std::cos(roll));
    chip.half_size = {flake.size, flake.size * 0.62f * turn};
    chip.radius = chip.half_size.y;
    chip.angle = roll * 0.6f;
    chip.color = flake.dainty ? Color{1.0f, 0.42f, 0.06f, fade * fresh}
                              : Color{0.62f, 0.20f, 0.045f, fade * fresh};
    chip.color = scaled(chip.color, light);
    renderer.draw_shape(chip);
    Shape glint = chip;
    glint.center = {at.x - 0.2f * flake.size, at.y - 0.18f * flake.size * turn};
    glint.half_size = {flake.size * 0.5f, flake.size * 0.24f * turn};
    glint.radius = glint.half_size.y;
    glint.color = {1.0f * light, 0.66f * light, 0.32f * light, 0.75f * fade * fresh};
    renderer.draw_shape(glint);
  }
}

void Scene::draw_sparks(Renderer& renderer, float seconds) {
  renderer.set_camera(camera_of(view_));
  for (const Spark& spark : sparks_) {
    const float age = (seconds - spark.born) / kSparkSeconds;
    if (age < 0 || age > 1) continue;
    const float fade = (1 - age) * (1 - age);
    const Vec2 at = spark.event.at;
    if (spark.event.kind == EventKind::Splash) {
      Shape ring;
      ring.center = {at.x, 7};
      ring.half_size = {8 + 60 * age, 2 + 7 * age};
      ring.radius = ring.half_size.y;
      ring.outline = 1.4f;
      ring.color = {0.8f, 1.0f, 1.0f, 0.55f * fade};
      renderer.draw_shape(ring);
    }
    if (spark.event.kind != EventKind::Bite && spark.event.kind != EventKind::Stolen) continue;
    const bool mine = spark.event.kind == EventKind::Bite;
    const int count = mine ? 14 : 5;
    for (int k = 0; k < count; ++k) {
      const int salt = static_cast<int>(at.x * 13 + at.y * 7);
      const float turn =
          6.2832f * (static_cast<float>(k) + unit_hash(salt, k)) / static_cast<float>(count);
      const float way = (mine ? 62.0f : 26.0f) * (0.4f + 0.6f * unit_hash(k, salt)) * (1 - fade);
      const Vec2 p{at.x + way * std::cos(turn), at.y + way * std::sin(turn) - 14 * age};
      Shape dot = vsprite::disc(p, (mine ? 3.4f : 2.2f) * (1 - age) + 0.4f,
                                {1.0f, 0.72f, 0.30f, (mine ? 0.9f : 0.4f) * fade});
      dot.feather = 3;
      dot.blend = BlendMode::Add;
      renderer.draw_shape(dot);
    }
    if (!mine) continue;
    const float size = 20 + 4.0f * static_cast<float>(spark.event.combo);
    std::string text = "+";
    text += std::to_string(spark.event.points);
    vsprite::TextStyle style{
        size, {1, 0.93f, 0.72f, std::min(1.0f, 2.2f * (1 - age))}, 1.5f, vsprite::Align::Center};
    renderer.draw_text(text, {at.x, at.y - 46 - 34 * age}, style);
  }
}

void Scene::draw_bubbles(Renderer& renderer, float seconds, bool near) const {
  // Strings of bubbles from three places in the gravel: bubble k of a string leaves every `period`.
  struct Source {
    float x, y, period, size;
    bool near;
  };
  constexpr std::array<Source, 4> kSources{{{506, 596, 0.42f, 3.2f, false},
                                            {946, 640, 0.9f, 5.0f, true},
                                            {262, 500, 1.7f, 4.0f, false},
                                            {1190, 560, 0.6f, 3.0f, false}}};
  renderer.set_camera(camera_of(view_));
  for (std::size_t s = 0; s < kSources.size(); ++s) {
    const Source& source = kSources[s];
    if (source.near != near) continue;
    const int newest = static_cast<int>(seconds / source.period);
    for (int k = std::max(0, newest - 24); k <= newest; ++k) {
      const int salt = static_cast<int>(s) * 1000 + k;
      const float age = seconds - static_cast<float>(k) * source.period;
      if (unit_hash(salt, 1) < 0.35f) continue;  // strings have gaps
      const float size = source.size * (0.45f + 0.9f * unit_hash(salt, 2));
      const float rise = (58 + 9 * size) * age;
      const float y = source.y - rise;
      if (y < 10) continue;
      const float grown = size * (1 + 0.35f * rise / kTankHeight);
      const float wobble = std::sin(3.1f * age + 6.28f * unit_hash(salt, 3));
      const Vec2 at{source.x + 7 * wobble + 10 * (unit_hash(salt, 4) - 0.5f) + 0.02f * rise, y};
      const Color water = water_at(at);
      const Color rim = mix(water, {0.75f, 0.95f, 0.95f, 1}, 0.45f);
      Shape body = vsprite::disc(at, grown, {rim.r, rim.g, rim.b, 0.16f});
      renderer.draw_shape(body);
      body.outline = std::max(0.8f, 0.22f * grown);
      body.color.a = 0.55f;
      renderer.draw_shape(body);
      renderer.draw_shape(vsprite::disc({at.x - 0.34f * grown, at.y - 0.36f * grown}, 0.26f * grown,
                                        {0.95f, 1, 1, 0.85f}));
    }
  }
}

void Scene::draw_motes(Renderer& renderer, float seconds) const {
  renderer.set_camera(camera_of(view_));
  for (int k = 0; k < 64; ++k) {
    const float near = unit_hash(k, 5);
    const float x0 = unit_hash(k, 6) * 1400 - 60;
    const float y0 = unit_hash(k, 7) * 640 + 40;
    const float drift = seconds * (3 + 7 * unit_hash(k, 8));
    const float x = std::fmod(x0 + drift, 1400.0f) - 60 + 9 * std::sin(0.4f * seconds + x0);
    const float y = y0 + 16 * std::sin(0.23f * seconds + 6.28f * unit_hash(k, 9));
    const float twinkle = std::max(0.0f, shimmer({x, y}, seconds) - 0.55f);
    Shape mote = vsprite::disc({x, y}, 0.7f + 1.3f * near * near,
                               {0.55f, 0.85f, 0.80f, (0.10f + 0.34f * near) * twinkle});
    mote.feather = 0.8f + 3.5f * near * near;
    mote.blend = BlendMode::Add;
    renderer.draw_shape(mote);
  }
}

void Scene::draw(Renderer& renderer, vsprite::FrameCache& frames, const Moment& moment,
                 bool settled) {
  view_ = make_view(renderer.width(), renderer.height());
  const bool resized = renderer.width() != backdrop_width_ || renderer.height() != backdrop_height_;
  if (backdrop_.id < 0 || (resized && settled)) draw_backdrop(renderer);
  wakes_.clear();
  for (const Fish& fish : moment.world.fish) {
    const Vec2 v = moment.sprite.samples()[fish.actor.sample].velocity;
    if (fish.depth < 0.4f) wakes_.push_back({place_of(fish), {v.x * fish.scale, v.y * fish.scale}});
  }

  draw_light(renderer, moment.seconds);
  renderer.run_effect(water_, std::array{Uniform("backdrop", backdrop_), Uniform("light", light_)},
                      {{}, BlendMode::Replace});
  draw_far(renderer, frames, moment);
  draw_bubbles(renderer, moment.seconds, false);
  draw_food(renderer, moment);
  draw_fish(renderer, frames, moment, 0);
  draw_sparks(renderer, moment.seconds);
  draw_bubbles(renderer, moment.seconds, true);
  draw_motes(renderer, moment.seconds);
  draw_plants(renderer, moment, 0, -9);
  renderer.set_camera({});
}

}  // namespace aquarium
