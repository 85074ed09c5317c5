// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The play window, back to front: floor, target, character, keys, words, overlay.
#include "window/play_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "shaders/play.h"
#include "vsprite/policy.h"

namespace vsprite::window {
namespace {

struct Ink {
  Color text, faint, warning, panel;
};

Ink ink_of(int ground) {
  if (ground == 2) {
    return {srgb(0xe8eef2), srgb(0x9aa7b0), srgb(0xffc46b), srgb(0x20282e, 0.85f)};
  }
  return {srgb(0x1d2830), srgb(0x4a5963), srgb(0x8a3c00), srgb(0xf6f9fb, 0.85f)};
}

Color faded(Color color, float amount) {
  color.a *= amount;
  return color;
}

std::string number(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// Does `direction` ask for this arrow key?
bool holds(Direction direction, Direction key) {
  const Vec2 d = unit_vector(direction), k = unit_vector(key);
  return d.x * k.x + d.y * k.y > 0.5f;
}

struct KeyPlace {
  Direction direction;
  float x, y;  // in key widths
};
constexpr std::array<KeyPlace, 4> kKeys = {{{Direction::Left, -1.12f, 0},
                                            {Direction::Down, 0, 0},
                                            {Direction::Right, 1.12f, 0},
                                            {Direction::Up, 0, -1.12f}}};

/// The four arrow keys as on a keyboard; `middle` is that of the lower middle one.
void draw_keys(Renderer& r, Vec2 middle, float size, const ControlMode& mode, Direction held,
               float amount) {
  for (const KeyPlace& key : kKeys) {
    const bool lit = holds(held, key.direction);
    const bool served = (mode.served >> static_cast<int>(key.direction) & 1u) != 0;
    const Vec2 c{middle.x + key.x * size, middle.y + key.y * size};
    const float half = 0.5f * size, sink = lit ? 0.05f * size : 0;
    const Vec2 top_left{c.x - half, c.y - half}, bottom_right{c.x + half, c.y + half};
    const Vec2 below{top_left.x, top_left.y + 0.07f * size};
    r.draw_shape(box(below, {bottom_right.x, bottom_right.y + 0.09f * size},
                     srgb(0x3c4a54, 0.55f * amount), 0.2f * size));
    const Color cap = lit ? srgb(0xffb347) : served ? srgb(0xfbfdfe) : srgb(0xc3cace);
    r.draw_shape(box({top_left.x, top_left.y + sink}, {bottom_right.x, bottom_right.y + sink},
                     faded(cap, amount), 0.2f * size));
    const Vec2 u = unit_vector(key.direction);
    const float t = 0.2f * size;
    const std::array<Vec2, 3> arrow = {
        {{c.x + u.x * t, c.y + u.y * t + sink},
         {c.x - u.x * t * 0.8f - u.y * t, c.y - u.y * t * 0.8f + u.x * t + sink},
         {c.x - u.x * t * 0.8f + u.y * t, c.y - u.y * t * 0.8f - u.x * t + sink}}};
    r.draw_polygon(arrow, faded(srgb(0x24323c), (served ? 0.9f : 0.3f) * amount));
  }
}

void draw_target(Renderer& r, const PlayState& s) {
  if (!s.has_target) return;
  Shape ring = disc(s.target, 10 / s.zoom, srgb(0xe0702a, 0.9f));
  ring.outline = 2.5f / s.zoom;
  r.draw_shape(ring);
  r.draw_shape(disc(s.target, 2.5f / s.zoom, srgb(0xe0702a, 0.9f)));
}

/// Commanded direction (orange) and the sample's velocity (blue), from the anchor.
void draw_arrows(Renderer& r, const Sprite& sprite, const PlayState& s, Vec2 at) {
  const auto arrow = [&](Vec2 by, Color color) {
    const float length = std::sqrt(by.x * by.x + by.y * by.y);
    if (length < 2) return;
    const Vec2 u{by.x / length, by.y / length};
    const Vec2 tip{at.x + by.x, at.y + by.y};
    const float h = 9 / s.zoom;
    r.draw_shape(line(at, {tip.x - u.x * h, tip.y - u.y * h}, 3 / s.zoom, color));
    const std::array<Vec2, 3> head = {
        {tip,
         {tip.x - u.x * 1.6f * h - u.y * 0.8f * h, tip.y - u.y * 1.6f * h + u.x * 0.8f * h},
         {tip.x - u.x * 1.6f * h + u.y * 0.8f * h, tip.y - u.y * 1.6f * h - u.x * 0.8f * h}}};
    r.draw_polygon(head, color);
  };
  const Vec2 u = unit_vector(s.command);
  const float reach = 0.9f * std::max(sprite.data().body_length, 30.0f);
  arrow({u.x * reach, u.y * reach}, srgb(0xe0702a, 0.9f));
  const Vec2 v = sprite.samples()[s.actor.sample].velocity;
  arrow({v.x * 0.5f, v.y * 0.5f}, srgb(0x1f6fc4, 0.9f));
}

std::string overlay_text(Session& session, const Sprite& sprite, const FrameCache& frames,
                         const PlayState& s) {
  const SpriteData& data = sprite.data();
  const Sample& sample = data.samples[s.actor.sample];
  const ControlMode& mode = data.modes[s.actor.mode];
  const auto followed = direction_of(mode, s.actor.table / mode.stages);
  const float speed =
      std::sqrt(sample.velocity.x * sample.velocity.x + sample.velocity.y * sample.velocity.y);
  const std::string tag = data.tags[sample.tag];
  std::string text;
  const auto row = [&](const char* name, const std::string& value) {
    text += name;
    text += '\t' + value + '\n';
  };
  row("sample", std::to_string(s.actor.sample) + " of " + std::to_string(data.samples.size()) +
                    (tag.empty() ? "" : ", " + tag));
  row("film", "frame " + std::to_string(sample.frame) + ", clip " + std::to_string(sample.clip));
  row("command", std::string(direction_name(s.command)));
  row("follows", std::string(direction_name(followed)));
  row("stage", std::to_string(s.actor.stage) + " of " + std::to_string(mode.stages - 1) +
                   ", table " + std::to_string(s.actor.table));
  row("last jump",
      number("cost %.2f", double{s.last_cost}) + ", " + std::to_string(s.jumps) + " so far");
  row("speed", number("%.0f px/s", double{speed}));
  row("tick", std::to_string(s.actor.tick) + number(", %.1f a second", sprite.fps()));
  row("frame",
      number("%.1f ms", session.frame_ms()) + number(", drawn in %.1f", session.work_ms()));
  row("pictures",
      number("%.1f MB decoded", static_cast<double>(frames.stats().bytes) / 1e6) +
          number(", %.0f new", static_cast<double>(session.renderer().stats().uploads)));
  row("decoded", number("%.0f ahead", static_cast<double>(frames.stats().ahead)) +
                     number(", %.0f missed", static_cast<double>(frames.stats().misses)));
  return text;
}

void draw_columns(Renderer& r, std::string_view text, Vec2 at, float size, float indent,
                  const Ink& ink) {
  while (!text.empty()) {
    const std::string_view row = text.substr(0, text.find('\n'));
    text.remove_prefix(row.size() + 1);
    const std::size_t tab = row.find('\t');
    r.draw_text(row.substr(0, tab), at, {.size = size, .color = ink.faint});
    r.draw_text(row.substr(tab + 1), {at.x + indent, at.y}, {.size = size, .color = ink.text});
    at.y += 1.25f * size;
  }
}

/// A bar a tick: how dear the jumps were; the line is the classifier's threshold, 1.
void draw_history(Renderer& r, const PlayState& s, Vec2 at, float width, float height,
                  const Ink& ink) {
  const float bar = width / static_cast<float>(kHistory);
  constexpr float kMost = 1.25f;
  for (std::size_t i = 0; i < kHistory; ++i) {
    const float cost = s.costs[(s.cost_head + i) % kHistory];
    const float x = at.x + bar * static_cast<float>(i);
    const float h = cost < 0 ? 1.5f : std::max(3.0f, height * std::min(cost / kMost, 1.0f));
    const Color color = cost < 0   ? faded(ink.faint, 0.5f)
                        : cost > 1 ? srgb(0xc03028)
                                   : srgb(0x1f6fc4);
    r.draw_shape(box({x, at.y + height - h}, {x + bar * 0.8f, at.y + height}, color));
  }
  const float y = at.y + height * (1 - 1 / kMost);
  r.draw_shape(box({at.x, y - 0.5f}, {at.x + width, y + 0.5f}, faded(ink.warning, 0.5f)));
}

void draw_overlay(Session& session, const Sprite& sprite, FrameCache& frames, const PlayState& s,
                  float ui, const Ink& ink) {
  Renderer& r = session.renderer();
  const float size = 16 * ui, width = 340 * ui, pad = 14 * ui;
  const std::string text = overlay_text(session, sprite, frames, s);
  const auto rows = static_cast<float>(std::count(text.begin(), text.end(), '\n'));
  const float chart = 56 * ui;
  const float height = rows * 1.25f * size + chart + 3.4f * size + 2 * pad;
  const Vec2 from{static_cast<float>(r.width()) - width - 16 * ui, 16 * ui};
  r.draw_shape(box(from, {from.x + width, from.y + height}, ink.panel, 8 * ui));
  Vec2 at{from.x + pad, from.y + pad};
  draw_columns(r, text, at, size, 92 * ui, ink);
  at.y += rows * 1.25f * size + 0.6f * size;
  draw_history(r, s, at, width - 2 * pad, chart, ink);
  at.y += chart + 0.3f * size;
  r.draw_text("cost of jumps, last 150 ticks; line: threshold", at,
              {.size = 13 * ui, .color = ink.faint});
  r.draw_text(r.device(), {at.x, at.y + 18 * ui}, {.size = 13 * ui, .color = ink.faint});
}

void draw_words(Session& session, const PlayState& s, float ui, const Ink& ink) {
  Renderer& r = session.renderer();
  const auto width = static_cast<float>(r.width()), height = static_cast<float>(r.height());
  r.draw_text(s.title, {20 * ui, 14 * ui}, {.size = 30 * ui, .color = ink.text});
  r.draw_text(s.subtitle, {20 * ui, 50 * ui}, {.size = 16 * ui, .color = ink.faint});
  r.draw_text(s.warning, {20 * ui, 74 * ui}, {.size = 16 * ui, .color = ink.warning});
  r.draw_text("F1 details   B ground   + \u2013 zoom   P pause   F11 full screen   Esc quit",
              {20 * ui, height - 34 * ui}, {.size = 16 * ui, .color = ink.faint});
  if (!s.notice.empty()) {
    r.draw_text(s.notice, {0.5f * width, 0.80f * height},
                {.size = 20 * ui, .color = ink.warning, .align = Align::Center});
  }
  if (session.is_paused()) {
    r.draw_text("paused", {0.5f * width, 0.14f * height},
                {.size = 40 * ui, .color = ink.text, .align = Align::Center});
    r.draw_text("P goes on, Space makes one step", {0.5f * width, 0.14f * height + 46 * ui},
                {.size = 18 * ui, .color = ink.faint, .align = Align::Center});
  }
}

}  // namespace

int grid_spacing(const Sprite& sprite) noexcept {
  const float body = sprite.data().body_length;
  return std::clamp(static_cast<int>(body * 0.5f), 16, 256);
}

Result<PlayView> PlayView::make(Renderer& renderer) {
  PlayView view;
  Result<Effect> floor = renderer.make_effect("floor", shaders::play::floor_frag);
  if (!floor) return std::move(floor).error();
  view.floor_ = *floor;
  return view;
}

void PlayView::draw(Session& session, const Sprite& sprite, FrameCache& frames,
                    const PlayState& s) {
  Renderer& r = session.renderer();
  const auto width = static_cast<float>(r.width()), height = static_cast<float>(r.height());
  const std::array<Uniform, 3> uniforms = {
      Uniform("kind", static_cast<float>(s.ground)),
      Uniform("camera", s.camera.x, s.camera.y, s.zoom),
      Uniform("spacing", static_cast<float>(grid_spacing(sprite)))};
  r.run_effect(floor_, uniforms, {.blend = BlendMode::Replace});

  r.set_camera({.origin = s.camera, .scale = s.zoom, .offset = {0.5f * width, 0.5f * height}});
  draw_target(r, s);
  const float fraction = session.is_paused() ? 0 : session.fraction();
  draw_actor(r, sprite, frames, s.actor, s.fade, fraction);
  if (s.overlay) draw_arrows(r, sprite, s, draw_position(sprite, s.actor, fraction));
  r.set_camera({});

  const Ink ink = ink_of(s.ground);
  const float ui = std::max(0.6f, std::min(height / 720, width / 960));
  const ControlMode& mode = sprite.data().modes[s.actor.mode];
  if (s.hint > 0) {
    draw_keys(r, {0.5f * width, height - 92 * ui}, 58 * ui, mode, s.command, s.hint);
  } else if (session.is_scripted()) {
    draw_keys(r, {width - 84 * ui, height - 40 * ui}, 34 * ui, mode, s.command, 1);
  }
  draw_words(session, s, ui, ink);
  if (s.overlay) draw_overlay(session, sprite, frames, s, ui, ink);
}

}  // namespace vsprite::window
