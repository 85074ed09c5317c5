// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The path window: the picture with backdrop, path and sprite, the time below it, words and
// buttons beside. Pictures are drawn by the renderer, in linear light; words by Dear ImGui.
#include "window/path_view.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "film/color.h"
#include "tool/report.h"
#include "window/panel.h"

namespace vsprite::window {
namespace {

constexpr float kSide = 340, kTime = 64, kGap = 14;
constexpr float kPointReach = 12, kSegmentReach = 8;  // window px at a scale of 1
constexpr std::uint64_t kSpriteKey = 1, kGroundKey = 2;

bool button(const char* label, float width, float height) {
  return ImGui::Button(label, {width, height});
}

void show_found(const PathFound& found, const Sprite& sprite) {
  if (!found.error.empty()) return line_of(kBad, found.error);
  const double body = std::max(1.0, double{sprite.data().body_length});
  const double length = static_cast<double>(found.clip.ticks.size()) / sprite.fps();
  const ClipReport& r = found.report;
  line_of(kText, std::to_string(found.clip.ticks.size()) + " frames, " + fixed_text(length, 1) +
                     " s; cost " + fixed_text(found.clip.cost, 2));
  line_of(kText, "Off the path, in body lengths: median " +
                     fixed_text(r.deviation_median / body, 2) + ", 95 % " +
                     fixed_text(r.deviation_p95 / body, 2) + ", largest " +
                     fixed_text(r.deviation_max / body, 2));
  line_of(r.off_course > 0 ? kBad : kText,
          std::to_string(r.off_course) + " frames over 45 degrees off its direction");
  line_of(kText, fixed_text(static_cast<double>(r.jumps) / length, 1) + " jumps a second");
  line_of(kFaint, "Beam of " + std::to_string(found.width) + ", found in " +
                      fixed_text(found.seconds, 2) + " s");
}

void show_help() {
  constexpr const char* kRows[][2] = {{"click", "a point more at the end"},
                                      {"click on the line", "a point in between"},
                                      {"drag a point", "moves it"},
                                      {"right click", "takes a point out"},
                                      {"Delete", "the selected point"},
                                      {"Space", "play, stop"},
                                      {"Left, Right", "one frame"},
                                      {"U, Ctrl+Z", "undo"},
                                      {"R, Ctrl+Y", "redo"},
                                      {"C", "begin anew"},
                                      {"S, Ctrl+S", "save"},
                                      {"Escape", "end"}};
  for (const auto& row : kRows) {
    ImGui::TextColored(kText, "%s", row[0]);
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.45f);
    ImGui::TextColored(kFaint, "%s", row[1]);
  }
}

}  // namespace

PathView::PathView(const Sprite& sprite, const PathWindowOptions& options)
    : sprite_(sprite), options_(options), frames_(sprite) {
  if (options.backdrop == nullptr || options.backdrop->still.width == 0) return;
  still_ = options.backdrop->still;
  premultiply(still_);
}

Vec2 PathView::to_window(Vec2 p) const {
  return {static_cast<float>(picture_.x) + (p.x - options_.picture.origin.x) * scale_,
          static_cast<float>(picture_.y) + (p.y - options_.picture.origin.y) * scale_};
}
Vec2 PathView::to_script(Vec2 w) const {
  const PathPicture& p = options_.picture;
  const float x = (w.x - static_cast<float>(picture_.x)) / scale_,
              y = (w.y - static_cast<float>(picture_.y)) / scale_;
  return {std::clamp(x, 0.0f, static_cast<float>(p.width)) + p.origin.x,
          std::clamp(y, 0.0f, static_cast<float>(p.height)) + p.origin.y};
}

void PathView::lay_out(const Renderer& r, float ui) {
  const int gap = static_cast<int>(kGap * ui), side = static_cast<int>(kSide * ui),
            time = static_cast<int>(kTime * ui);
  const int width = std::max(r.width() - side - 2 * gap, 2),
            height = std::max(r.height() - time - 2 * gap, 2);
  scale_ = std::min(static_cast<float>(width) / static_cast<float>(options_.picture.width),
                    static_cast<float>(height) / static_cast<float>(options_.picture.height));
  picture_.width = static_cast<int>(scale_ * static_cast<float>(options_.picture.width));
  picture_.height = static_cast<int>(scale_ * static_cast<float>(options_.picture.height));
  picture_.x = gap + (width - picture_.width) / 2;
  picture_.y = gap + (height - picture_.height) / 2;
  side_ = {r.width() - side, 0, side, r.height()};
  time_ = {0, r.height() - time, r.width() - side, time};
}

void PathView::draw_ground(Renderer& r, double tick) {
  const Vec2 low{static_cast<float>(picture_.x), static_cast<float>(picture_.y)};
  r.draw_shape(
      box(low,
          {low.x + static_cast<float>(picture_.width), low.y + static_cast<float>(picture_.height)},
          srgb(0x9cc4d8)));
  const Backdrop* backdrop = options_.backdrop;
  if (backdrop != nullptr && !backdrop->film.empty()) {
    const double at = std::floor(std::floor(tick) * backdrop->fps / sprite_.fps() + 1e-6);
    const auto frame = static_cast<std::size_t>(at) % backdrop->film.size();
    if (frame != shown_) {
      still_ = to_image(backdrop->film[frame]);
      r.forget(kGroundKey);
    }
    shown_ = frame;
  }
  if (still_.width == 0) return;
  SpriteDraw draw;
  draw.image = still_;
  draw.key = {kGroundKey, 0};
  draw.position = low;
  draw.scale = scale_;
  r.draw_sprite(draw);
}

void PathView::draw_path(Renderer& r, const PathEdit& edit, const PathLook& look, float ui) const {
  const std::vector<Vec2>& points = edit.points();
  for (std::size_t k = 1; k < points.size(); ++k)
    r.draw_shape(
        line(to_window(points[k - 1]), to_window(points[k]), 5 * ui, srgb(0x12181c, 0.5f)));
  for (std::size_t k = 1; k < points.size(); ++k)
    r.draw_shape(line(to_window(points[k - 1]), to_window(points[k]), 2.5f * ui, srgb(0xffffff)));
  // Where it has been, and where it will be.
  if (look.found)
    for (std::size_t t = 1; t < look.found->clip.ticks.size(); ++t) {
      const auto& ticks = look.found->clip.ticks;
      const bool is_past = static_cast<double>(t) <= look.tick;
      r.draw_shape(line(to_window(options_.picture.place(ticks[t - 1].position)),
                        to_window(options_.picture.place(ticks[t].position)), 2 * ui,
                        srgb(0xd9622b, is_past ? 1.0f : 0.35f)));
    }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool is_chosen = look.selected == k || edit.held() == k;
    const bool dense = points.size() > 60 && k > 0 && k + 1 < points.size();
    const float radius = (dense && !is_chosen ? 3.5f : is_chosen ? 9.0f : 7.0f) * ui;
    const std::uint32_t color = is_chosen ? 0xf0a030 : k == 0 ? 0x3db885 : 0xffffff;
    r.draw_shape(disc(to_window(points[k]), radius + 1.5f * ui, srgb(0x12181c, 0.8f)));
    r.draw_shape(disc(to_window(points[k]), radius, srgb(color)));
  }
}

void PathView::draw_sprite(Renderer& r, const PathLook& look) {
  if (!look.found || look.found->clip.ticks.empty()) return;
  const auto& ticks = look.found->clip.ticks;
  const ClipTick& t = ticks[std::min(static_cast<std::size_t>(look.tick), ticks.size() - 1)];
  SpriteDraw draw;
  draw.image = frames_.frame(t.sample);
  draw.key = {kSpriteKey, t.sample};
  draw.position = to_window(options_.picture.place(t.position));
  draw.anchor = sprite_.samples()[t.sample].anchor;
  draw.scale = scale_ * options_.picture.scale(t.position);
  r.draw_sprite(draw);
}

void PathView::take_mouse(PathEdit& edit, PathLook& look, float ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const Vec2 mouse{io.MousePos.x * io.DisplayFramebufferScale.x,
                   io.MousePos.y * io.DisplayFramebufferScale.y};
  if (edit.held()) {
    edit.move(to_script(mouse));
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) edit.drop();
    return;
  }
  const bool is_over = !io.WantCaptureMouse && mouse.x >= static_cast<float>(picture_.x) &&
                       mouse.y >= static_cast<float>(picture_.y) &&
                       mouse.x <= static_cast<float>(picture_.x + picture_.width) &&
                       mouse.y <= static_cast<float>(picture_.y + picture_.height);
  if (!is_over) return;
  const Vec2 at = to_script(mouse);
  const auto point = edit.point_at(at, kPointReach * ui / scale_);
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Right) && point) {
    edit.erase(*point);
    look.selected.reset();
  }
  if (!ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return;
  std::size_t index = edit.points().size();
  if (point) {
    index = *point;
  } else {
    if (const auto segment = edit.segment_at(at, kSegmentReach * ui / scale_)) index = *segment + 1;
    edit.insert(index, at);
  }
  edit.take(index);
  look.selected = index;
}

std::optional<PathAction> PathView::draw_side(const PathEdit& edit, PathLook& look,
                                              float ui) const {
  std::optional<PathAction> clicked;
  begin_panel("side", side_);
  ImGui::SetWindowFontScale(1.2f);
  ImGui::TextColored(kText, "Draw where it goes");
  ImGui::SetWindowFontScale(1);
  line_of(kFaint, "Click for a point, drag it, click on the line for one in between.");
  ImGui::Dummy({0, 4 * ui});
  line_of(kText, std::to_string(edit.points().size()) + " points" +
                     (edit.is_saved() ? "" : ", not saved"));
  const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  const float height = 34 * ui;
  if (button("Undo  (U)", half, height)) clicked = PathAction::Undo;
  ImGui::SameLine();
  if (button("Redo  (R)", half, height)) clicked = PathAction::Redo;
  if (button("Begin anew  (C)", half, height)) clicked = PathAction::Clear;
  ImGui::SameLine();
  if (button("Save  (S)", half, height)) clicked = PathAction::Save;
  ImGui::Dummy({0, 4 * ui});
  ImGui::Separator();
  if (edit.points().size() < 2) {
    line_of(kFaint, "Two points make a path.");
  } else {
    const bool is_done = look.progress < 0;
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, is_done ? kGood : ImVec4{0.20f, 0.52f, 0.66f, 1});
    ImGui::ProgressBar(is_done ? 1.0f : static_cast<float>(look.progress), {-1, 0},
                       is_done ? "found" : "searching");
    ImGui::PopStyleColor();
    if (look.found) show_found(*look.found, sprite_);
  }
  ImGui::Separator();
  if (!look.said.empty()) line_of(kText, look.said);
  if (look.help)
    show_help();
  else
    line_of(kFaint, "F1 lists the keys, Escape ends.");
  ImGui::End();
  return clicked;
}

void PathView::draw_time(PathLook& look, float ui) const {
  const std::size_t count = look.found ? look.found->clip.ticks.size() : 0;
  begin_panel("time", time_);
  if (button(look.playing ? "Stop" : "Play", 70 * ui, 0)) look.playing = !look.playing;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  int tick = static_cast<int>(look.tick);
  const std::string text = count == 0 ? std::string("nothing to show yet")
                                      : "%d of " + std::to_string(count) + "   " +
                                            fixed_text(look.tick / sprite_.fps(), 2) + " s";
  const int last = count == 0 ? 0 : static_cast<int>(count) - 1;
  if (ImGui::SliderInt("##tick", &tick, 0, std::max(last, 1), text.c_str(),
                       ImGuiSliderFlags_NoInput)) {
    look.tick = std::min(tick, last);
    look.playing = false;
  }
  ImGui::End();
}

std::optional<PathAction> PathView::draw(Renderer& r, PathEdit& edit, PathLook& look,
                                         double seconds, float ui) {
  lay_out(r, ui);
  const std::size_t count = look.found ? look.found->clip.ticks.size() : 0;
  if (look.playing) look.tick += seconds * sprite_.fps();
  if (look.tick >= static_cast<double>(count)) look.tick = 0;
  r.clear(srgb(0x1a2126));
  draw_ground(r, look.tick);
  draw_path(r, edit, look, ui);
  draw_sprite(r, look);
  const auto clicked = draw_side(edit, look, ui);
  draw_time(look, ui);
  take_mouse(edit, look, ui);
  return clicked;
}

}  // namespace vsprite::window
