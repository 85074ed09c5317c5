// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The HUD in its own units: as large as tank pixels, but never too small to read.
#include "hud.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>

namespace aquarium {

using vsprite::Align;
using vsprite::Color;
using vsprite::Renderer;
using vsprite::Shape;
using vsprite::TextStyle;
using vsprite::Vec2;

namespace {

constexpr Color kInk{0.93f, 0.98f, 0.97f, 1};
constexpr Color kGold{1.0f, 0.62f, 0.16f, 1};
constexpr Color kGlass{0.004f, 0.030f, 0.045f, 0.58f};

Color faded(Color c, float alpha) { return {c.r, c.g, c.b, c.a * alpha}; }

/// The frame in HUD units.
struct Page {
  float scale = 1;
  float width = 0;
  float height = 0;
};

Page make_page(const Renderer& renderer) {
  Page page;
  const View view = make_view(renderer.width(), renderer.height());
  const float least = std::clamp(static_cast<float>(renderer.height()) / 500, 0.60f, 0.80f);
  page.scale = std::clamp(view.scale, least, 4.0f);
  page.width = static_cast<float>(renderer.width()) / page.scale;
  page.height = static_cast<float>(renderer.height()) / page.scale;
  return page;
}

void text(Renderer& renderer, const std::string& words, Vec2 at, float size, Color color,
          Align align = Align::Left, float weight = 1.15f) {
  const Color shade{0, 0.02f, 0.03f, 0.55f * color.a};
  renderer.draw_text(words, {at.x + 0.06f * size, at.y + 0.07f * size},
                     {size, shade, weight, align});
  renderer.draw_text(words, at, {size, color, weight, align});
}

/// A key cap with its arrow; `pressed` 0..1 sinks and lights it.
void draw_cap(Renderer& renderer, Vec2 center, float half, Vec2 arrow, float pressed, float alpha) {
  const float sink = 4 * pressed;
  Shape shade =
      vsprite::box({center.x - half, center.y - half + 5}, {center.x + half, center.y + half + 8},
                   {0, 0.01f, 0.02f, 0.6f * alpha}, 12);
  shade.feather = 6;
  renderer.draw_shape(shade);
  const Vec2 c{center.x, center.y + sink};
  const Color side = mix({0.16f, 0.24f, 0.26f, 1}, {0.55f, 0.25f, 0.04f, 1}, pressed);
  const Color top = mix({0.80f, 0.90f, 0.90f, 1}, {1.0f, 0.66f, 0.22f, 1}, pressed);
  renderer.draw_shape(vsprite::box({c.x - half, c.y - half}, {c.x + half, center.y + half + 5},
                                   faded(side, 0.95f * alpha), 11));
  renderer.draw_shape(vsprite::box({c.x - half + 4, c.y - half + 2},
                                   {c.x + half - 4, c.y + half - 4}, faded(top, 0.96f * alpha), 8));
  const Vec2 side_way{-arrow.y, arrow.x};
  const auto corner = [&](float along, float across) {
    return Vec2{c.x + half * (arrow.x * along + side_way.x * across),
                c.y - 1 + half * (arrow.y * along + side_way.y * across)};
  };
  const Color ink{0.02f, 0.07f, 0.08f, alpha};
  renderer.draw_polygon(std::array{corner(0.52f, 0), corner(0.02f, 0.44f), corner(0.02f, -0.44f)},
                        ink);
  renderer.draw_shape(vsprite::line(corner(0.05f, 0), corner(-0.46f, 0), 0.26f * half, ink));
}

/// Up over left, down, right, as on every keyboard; they are pressed in turn until somebody does.
void draw_key_hints(Renderer& renderer, const Page& page, const Moment& moment,
                    const HudState& state) {
  const float gone = state.hint_seconds < 0 ? 0.0f : smooth_step(0, 0.5f, state.hint_seconds);
  if (gone >= 1) return;
  const float alpha = (1 - gone) * smooth_step(0.1f, 0.6f, moment.seconds);
  const float half = 27;
  const float gap = 2 * half + 8;
  const Vec2 middle{page.width / 2, page.height - 96 + 40 * gone};
  struct Cap {
    Vec2 place;
    Vec2 arrow;
  };
  const std::array<Cap, 4> caps{
      {{{0, -1}, {0, -1}}, {{1, 0}, {1, 0}}, {{0, 0}, {0, 1}}, {{-1, 0}, {-1, 0}}}};
  const float beat = std::fmod(moment.seconds / 0.55f, 4.0f);
  for (std::size_t k = 0; k < caps.size(); ++k) {
    const float since = beat - static_cast<float>(k);
    const float pressed = since >= 0 && since < 1 ? std::sin(3.1416f * since) : 0.0f;
    draw_cap(renderer, {middle.x + caps[k].place.x * gap, middle.y + caps[k].place.y * gap}, half,
             caps[k].arrow, pressed, alpha);
  }
}

void draw_score(Renderer& renderer, const World& world, const HudState& state) {
  renderer.draw_shape(vsprite::box({18, 16}, {210, 78}, kGlass, 31));
  Shape flake = vsprite::disc({50, 47}, 13, kGold);
  flake.half_size = {14, 10};
  flake.radius = 10;
  flake.angle = -0.5f;
  renderer.draw_shape(flake);
  flake.center = {47, 43};
  flake.half_size = {6, 3};
  flake.radius = 3;
  flake.color = {1, 0.86f, 0.6f, 0.9f};
  renderer.draw_shape(flake);
  text(renderer, std::to_string(world.score), {76, 26}, 40, kInk, Align::Left, 1.3f);
  if (state.best > 0)
    text(renderer, "best " + std::to_string(state.best), {36, 84}, 19, faded(kInk, 0.75f));
  for (int k = 0; k < kMaxCombo; ++k) {
    const bool lit = k < world.combo;
    if (world.combo < 2) break;
    renderer.draw_shape(vsprite::disc({232 + 19.0f * static_cast<float>(k), 47}, lit ? 7.0f : 4.0f,
                                      lit ? kGold : faded(kInk, 0.25f)));
  }
  if (world.combo >= 2)
    text(renderer, "\u00d7" + std::to_string(world.combo), {330, 30}, 32, kGold, Align::Left, 1.4f);
}

/// Seconds left in a ring of sixty marks.
void draw_clock(Renderer& renderer, const Page& page, const Moment& moment) {
  const World& world = moment.world;
  const int left = seconds_left(moment.sprite, world);
  const Vec2 c{page.width - 62, 62};
  const bool last = left <= 10;
  renderer.draw_shape(vsprite::disc(c, 44, kGlass));
  const float exact =
      static_cast<float>(world.round_ticks) / static_cast<float>(moment.sprite.fps());
  for (int k = 0; k < 60; ++k) {
    const float turn = 6.28319f * static_cast<float>(k) / 60 - 1.5708f;
    const Vec2 u{std::cos(turn), std::sin(turn)};
    const float lit = std::clamp(exact - static_cast<float>(k), 0.0f, 1.0f);
    const Color color = mix(faded(kInk, 0.14f), last ? kGold : faded(kInk, 0.92f), lit);
    renderer.draw_shape(vsprite::line({c.x + 35 * u.x, c.y + 35 * u.y},
                                      {c.x + 40 * u.x, c.y + 40 * u.y}, 2.2f, color));
  }
  const float beat = last ? 1 + 0.12f * std::max(0.0f, std::sin(6.28319f * exact)) : 1.0f;
  text(renderer, std::to_string(left), {c.x, c.y - 19 * beat}, 34 * beat, last ? kGold : kInk,
       Align::Center, 1.3f);
}

void dim(Renderer& renderer, const Page& page, float amount) {
  renderer.draw_shape(vsprite::box({0, 0}, {page.width, page.height}, {0, 0.012f, 0.02f, amount}));
}

/// A star of five points.
void draw_star(Renderer& renderer, Vec2 c, float radius, Color color) {
  for (int k = 0; k < 5; ++k) {
    const auto corner = [&](int step, float r) {
      const float turn = 6.28319f * static_cast<float>(step) / 10 - 1.5708f;
      return Vec2{c.x + r * std::cos(turn), c.y + r * std::sin(turn)};
    };
    renderer.draw_polygon(std::array{c, corner(2 * k - 1, 0.42f * radius), corner(2 * k, radius),
                                     corner(2 * k + 1, 0.42f * radius)},
                          color);
  }
  renderer.draw_shape(vsprite::disc(c, 0.41f * radius, color));  // over the seams
}

void draw_end(Renderer& renderer, const Page& page, const Moment& moment, const HudState& state) {
  const World& world = moment.world;
  const float age = static_cast<float>(world.phase_ticks) / static_cast<float>(moment.sprite.fps());
  const float in = smooth_step(0.1f, 0.7f, age);
  if (in <= 0) return;
  dim(renderer, page, 0.34f * in);
  const Vec2 c{page.width / 2, page.height * 0.46f - 24 * (1 - in)};
  Shape halo = vsprite::box({c.x - 232, c.y - 172}, {c.x + 232, c.y + 172},
                            {0, 0.01f, 0.015f, 0.5f * in}, 34);
  halo.feather = 30;
  renderer.draw_shape(halo);
  renderer.draw_shape(vsprite::box({c.x - 224, c.y - 164}, {c.x + 224, c.y + 164},
                                   {0.008f, 0.058f, 0.078f, 0.88f * in}, 28));
  Shape rim = vsprite::box({c.x - 224, c.y - 164}, {c.x + 224, c.y + 164},
                           {0.35f, 0.75f, 0.75f, 0.28f * in}, 28);
  rim.outline = 1.6f;
  renderer.draw_shape(rim);
  constexpr std::array<int, 3> kStars{120, 300, 600};
  for (int k = 0; k < 3; ++k) {
    const float pop = smooth_step(0.5f + 0.25f * static_cast<float>(k),
                                  0.8f + 0.25f * static_cast<float>(k), age);
    const Vec2 at{c.x + 74 * static_cast<float>(k - 1), c.y - 112 - (k == 1 ? 8.0f : 0.0f)};
    draw_star(renderer, at, 27, {0.05f, 0.12f, 0.14f, 0.9f * in});
    if (world.score >= kStars[static_cast<std::size_t>(k)])
      draw_star(renderer, at, 26 * pop * (1 + 0.25f * std::sin(3.1416f * pop)), faded(kGold, in));
  }
  text(renderer, std::to_string(world.score), {c.x, c.y - 74}, 92, faded(kInk, in), Align::Center,
       1.35f);
  const std::string eaten = std::to_string(world.eaten) + (world.eaten == 1 ? " flake" : " flakes");
  const std::string streak =
      world.best_combo > 1 ? "   best streak \u00d7" + std::to_string(world.best_combo) : "";
  text(renderer, eaten + streak, {c.x, c.y + 32}, 23, faded(kInk, 0.85f * in), Align::Center);
  if (state.new_best) {
    text(renderer, "new best!", {c.x, c.y + 66}, 26, faded(kGold, in), Align::Center, 1.4f);
  } else if (state.best > 0) {
    text(renderer, "best " + std::to_string(state.best), {c.x, c.y + 66}, 23,
         faded(kInk, 0.7f * in), Align::Center);
  }
  const float pulse = 0.5f + 0.5f * std::sin(4 * moment.seconds);
  renderer.draw_shape(vsprite::box({c.x - 132, c.y + 110}, {c.x - 42, c.y + 144},
                                   faded(mix({0.80f, 0.90f, 0.90f, 1}, kGold, 0.6f * pulse), in),
                                   9));
  renderer.draw_text("Enter", {c.x - 87, c.y + 116},
                     {22, {0.02f, 0.07f, 0.08f, in}, 1.3f, Align::Center});
  text(renderer, "swim again", {c.x - 26, c.y + 115}, 23, faded(kInk, in));
}

// `low`: the keys stand below what else is shown.
void draw_pause(Renderer& renderer, const Page& page, bool low) {
  dim(renderer, page, 0.40f);
  const Vec2 c{page.width / 2, page.height * 0.46f};
  renderer.draw_shape(vsprite::disc(c, 66, kGlass));
  for (const float side : {-1.0f, 1.0f})
    renderer.draw_shape(
        vsprite::box({c.x + side * 18 - 9, c.y - 30}, {c.x + side * 18 + 9, c.y + 30}, kInk, 5));
  text(renderer, "P  go on      Esc  quit      M  sound      F11  full screen",
       {c.x, low ? page.height - 56 : c.y + 122}, 24, faded(kInk, 0.9f), Align::Center);
}

void draw_speaker_off(Renderer& renderer, const Page& page) {
  const Vec2 c{page.width - 136, 62};
  renderer.draw_shape(vsprite::disc(c, 19, kGlass));
  const Color ink = faded(kInk, 0.85f);
  renderer.draw_polygon(
      std::array{Vec2{c.x - 8, c.y - 4}, Vec2{c.x - 3, c.y - 4}, Vec2{c.x + 4, c.y - 10},
                 Vec2{c.x + 4, c.y + 10}, Vec2{c.x - 3, c.y + 4}, Vec2{c.x - 8, c.y + 4}},
      ink);
  renderer.draw_shape(vsprite::line({c.x - 11, c.y + 11}, {c.x + 11, c.y - 11}, 2.6f, kGold));
}

std::string formatted(const char* format, double a, double b = 0) {
  std::array<char, 96> line{};
  std::snprintf(line.data(), line.size(), format, a, b);
  return line.data();
}

void draw_overlay(Renderer& renderer, const Moment& moment, const HudState& state,
                  Quality quality) {
  const vsprite::Actor& actor = moment.world.fish[0].actor;
  const vsprite::SpriteData& data = moment.sprite.data();
  const vsprite::Sample& sample = data.samples[actor.sample];
  const vsprite::ControlMode& mode = data.modes[actor.mode];
  const Guard& guard = moment.world.fish[0].guard;
  const FrameTimes& times = state.frame_times;
  const std::array<std::string, 9> lines{
      data.name + ", mode " + mode.name,
      formatted("sample %.0f of %.0f", actor.sample, static_cast<double>(data.samples.size())) +
          formatted(", film frame %.0f", sample.frame),
      "direction " + std::string(direction_name(actor.direction)) +
          (guard.active ? " (glass: " + std::string(direction_name(guard.wanted)) + " refused)"
                        : ""),
      formatted("stage %.0f, table %.0f", actor.stage, actor.table),
      formatted("transition cost %.3f", static_cast<double>(state.transition_cost)),
      formatted("velocity %.0f, %.0f px/s", static_cast<double>(sample.velocity.x),
                static_cast<double>(sample.velocity.y)),
      formatted("frame %.1f ms, worst %.1f", static_cast<double>(times.mean(60)),
                static_cast<double>(times.worst())),
      std::string("quality ") + quality_name(quality) +
          formatted(", %.0f x %.0f", renderer.width(), renderer.height()),
      renderer.device()};
  const float left = 20;
  const float top = 116;
  renderer.draw_shape(
      vsprite::box({left, top}, {left + 392, top + 300}, {0.002f, 0.016f, 0.024f, 0.74f}, 14));
  float y = top + 12;
  for (const std::string& line : lines) {
    renderer.draw_text(line, {left + 16, y}, {17, kInk, 1.1f, Align::Left});
    y += 22;
  }
  const float base = top + 288;
  const float height = 70;
  for (std::size_t k = 0; k < times.count(); ++k) {
    const float ms = times.at(k);
    const float tall = height * std::min(1.0f, ms / 50);
    const float x = left + 376 - 3.0f * static_cast<float>(k);
    const Color color = ms > 33.4f   ? Color{1, 0.28f, 0.12f, 1}
                        : ms > 17.5f ? kGold
                                     : Color{0.2f, 0.75f, 0.5f, 1};
    renderer.draw_shape(vsprite::box({x - 2.2f, base - tall}, {x, base}, faded(color, 0.9f)));
  }
  for (const float ms : {16.7f, 33.3f}) {
    const float line = base - height * ms / 50;
    renderer.draw_shape(
        vsprite::box({left + 16, line}, {left + 376, line + 1}, faded(kInk, 0.35f)));
  }
}

}  // namespace

void FrameTimes::add(float milliseconds) noexcept {
  ring_[next_] = milliseconds;
  next_ = (next_ + 1) % kCount;
  filled_ = std::min(filled_ + 1, kCount);
}

float FrameTimes::at(std::size_t age) const noexcept {
  return ring_[(next_ + kCount - 1 - age % kCount) % kCount];
}

float FrameTimes::mean(std::size_t last) const noexcept {
  const std::size_t n = std::min(last, filled_);
  float sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += at(k);
  return n == 0 ? 0 : sum / static_cast<float>(n);
}

std::size_t FrameTimes::slower_than(float milliseconds, std::size_t last) const noexcept {
  std::size_t slow = 0;
  for (std::size_t k = 0; k < std::min(last, filled_); ++k) slow += at(k) > milliseconds ? 1 : 0;
  return slow;
}

float FrameTimes::worst() const noexcept {
  float most = 0;
  for (std::size_t k = 0; k < filled_; ++k) most = std::max(most, at(k));
  return most;
}

void draw_hud(Renderer& renderer, const Moment& moment, const HudState& state, Quality quality) {
  const Page page = make_page(renderer);
  renderer.set_camera({{0, 0}, page.scale, {0, 0}});
  const World& world = moment.world;
  if (world.phase == Phase::Playing) {
    draw_score(renderer, world, state);
    draw_clock(renderer, page, moment);
  }
  draw_key_hints(renderer, page, moment, state);
  if (world.phase == Phase::Over) draw_end(renderer, page, moment, state);
  if (world.paused) draw_pause(renderer, page, state.overlay);
  if (state.muted) draw_speaker_off(renderer, page);
  if (state.overlay) draw_overlay(renderer, moment, state, quality);
  renderer.set_camera({});
}

}  // namespace aquarium
