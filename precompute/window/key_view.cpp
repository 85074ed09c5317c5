// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The key window: the frame in one picture, film on the left of a line that can be dragged, what is
// cut out on its right; the time below, settings and words beside.
#include "window/key_view.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tool/report.h"
#include "window/key.h"
#include "window/panel.h"

namespace vsprite::window {

const KeySlider kSliders[kKeySliders] = {
    {"clip-black", "Clip black: haze and shadow off", &Settings::clip_black, 0, 0.9, 0.01, "%.2f"},
    {"clip-white", "Clip white: holes closed", &Settings::clip_white, 0.1, 1, 0.01, "%.2f"},
    {"edge", "Edge: inwards, outwards", &Settings::edge, -8, 4, 0.25, "%.2f px"},
    {"despill", "Despill: the screen's tint off", &Settings::despill, 0, 2, 0.05, "%.2f"}};

void set_slider(Settings& settings, int slider, double value) {
  const KeySlider& s = kSliders[slider];
  // To whole hundredths, as the command line shows them.
  const double steps = std::round(std::clamp(value, s.low, s.high) / s.step);
  double& field = settings.*s.field;
  field = std::round(100 * steps * s.step) / 100;
  constexpr double kApart = 0.01;
  if (s.field == &Settings::clip_black)
    field = std::min(field, std::round(100 * (settings.clip_white - kApart)) / 100);
  if (s.field == &Settings::clip_white)
    field = std::max(field, std::round(100 * (settings.clip_black + kApart)) / 100);
}

namespace {

constexpr float kSide = 352, kTime = 64, kGap = 10;
constexpr std::uint64_t kFilmKey = 1, kCutKey = 2, kBackKey = 3;
constexpr float kReach = 8;  // of the dividing line, window px at a scale of 1

constexpr Ground kGrounds[kKeyGrounds] = {
    {"game", 0x9cc4d8, 0x9cc4d8}, kSquares, kWhite, kGrey, kBlack};

bool button(const char* label, float width, float height, bool on = false) {
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, {0.20f, 0.52f, 0.66f, 1});
  const bool clicked = ImGui::Button(label, {width, height});
  if (on) ImGui::PopStyleColor();
  return clicked;
}

void show_help() {
  constexpr const char* kRows[][2] = {{"Left, Right", "one frame"},
                                      {"1 2 3 4", "choose a slider"},
                                      {"Up, Down", "move it; double click: as measured"},
                                      {"R", "all four as measured"},
                                      {"E", "pick the screen's colour"},
                                      {"U", "measure it (auto)"},
                                      {"Tab", "A, B"},
                                      {"X", "copy this one to the other"},
                                      {"G, M", "background, matte"},
                                      {"wheel, drag", "zoom, move"},
                                      {"S", "save this cut-out as PNG"},
                                      {"C", "copy the command line"},
                                      {"Enter", "cut the whole film"},
                                      {"Escape", "end"}};
  for (const auto& row : kRows) {
    ImGui::TextColored(kText, "%s", row[0]);
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.34f);
    ImGui::TextColored(kFaint, "%s", row[1]);
  }
}

// Words over the picture, readable on every ground.
void caption(ImVec2 at, const std::string& words) {
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  const ImVec2 size = ImGui::CalcTextSize(words.c_str());
  list.AddRectFilled({at.x - 7, at.y - 4}, {at.x + size.x + 7, at.y + size.y + 4},
                     IM_COL32(16, 22, 26, 190), 5);
  list.AddText(at, IM_COL32(240, 244, 246, 255), words.c_str());
}

void show_state(const KeyLook& look) {
  const ImVec4 busy{0.20f, 0.52f, 0.66f, 1};
  const auto bar = [&](double share, const char* words) {
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, busy);
    ImGui::ProgressBar(static_cast<float>(share), {-1, 0}, words);
    ImGui::PopStyleColor();
  };
  const auto& shown = look.shown[look.slot];
  if (look.state.phase == KeyPhase::Reading)
    bar(look.state.share, "reading the film");
  else if (look.state.phase == KeyPhase::Measuring)
    bar(std::fmod(0.7 * ImGui::GetTime(), 1.0), "measuring the background");
  else if (look.state.phase == KeyPhase::Keying)
    bar(1, "keying");
  else if (shown && shown->error.empty())
    line_of(kFaint, "Keyed in " + fixed_text(1000 * shown->seconds, 1) + " ms");
}

Image grey_of(const Image& straight) {
  Image out = straight;
  for (std::size_t i = 0; i < out.rgba.size(); i += 4) {
    std::fill_n(out.rgba.data() + i, 3, straight.rgba[i + 3]);
    out.rgba[i + 3] = 255;
  }
  return out;
}

/// The mean colour about a pixel, as --key takes it.
std::string color_at(const Image& film, Vec2 place) {
  constexpr int kAround = 4;
  const int x = static_cast<int>(place.x), y = static_cast<int>(place.y);
  int sum[3] = {}, count = 0;
  for (int v = std::max(y - kAround, 0); v <= std::min(y + kAround, film.height - 1); ++v)
    for (int u = std::max(x - kAround, 0); u <= std::min(x + kAround, film.width - 1); ++u) {
      const std::uint8_t* p = ImageView(film).pixel(u, v);
      for (int c = 0; c < 3; ++c) sum[c] += p[c];
      ++count;
    }
  char text[16] = "auto";
  if (count > 0)
    std::snprintf(text, sizeof text, "#%02X%02X%02X", sum[0] / count, sum[1] / count,
                  sum[2] / count);
  return text;
}

}  // namespace

void KeyView::lay_out(const Renderer& r, const KeyLook& look, float ui) {
  const int side = static_cast<int>(kSide * ui), time = static_cast<int>(kTime * ui),
            gap = static_cast<int>(kGap * ui);
  area_ = {gap, gap, std::max(r.width() - side - 2 * gap, 2),
           std::max(r.height() - time - 2 * gap, 2)};
  side_ = {r.width() - side, 0, side, r.height()};
  time_ = {0, r.height() - time, r.width() - side, time};
  if (const auto& shown = look.shown[look.slot]) {
    width_ = shown->film.width;
    height_ = shown->film.height;
  }
  if (width_ == 0) return;
  const auto wide = static_cast<float>(area_.width), high = static_cast<float>(area_.height);
  const auto film_wide = static_cast<float>(width_), film_high = static_cast<float>(height_);
  scale_ = look.zoom * std::min(wide / film_wide, high / film_high);
  corner_ = {static_cast<float>(area_.x) + 0.5f * wide - scale_ * look.center.x * film_wide,
             static_cast<float>(area_.y) + 0.5f * high - scale_ * look.center.y * film_high};
}

// The line lies in the middle of the subject until it is dragged elsewhere.
void KeyView::follow_subject(KeyLook& look) const {
  const auto& shown = look.shown[look.slot];
  if (look.split_given || !shown || shown->keyed.blobs.empty()) return;
  const float x = corner_.x + scale_ * static_cast<float>(shown->keyed.blobs[0].anchor_x);
  look.split =
      std::clamp((x - static_cast<float>(area_.x)) / static_cast<float>(area_.width), 0.0f, 1.0f);
}

Vec2 KeyView::to_film(Vec2 w) const {
  return {(w.x - corner_.x) / scale_, (w.y - corner_.y) / scale_};
}

void KeyView::draw_ground(Renderer& r, const KeyLook& look) {
  const float left = std::max(corner_.x, 0.0f), top = std::max(corner_.y, 0.0f);
  const float right = std::min(corner_.x + scale_ * static_cast<float>(width_),
                               static_cast<float>(r.width())),
              bottom = std::min(corner_.y + scale_ * static_cast<float>(height_),
                                static_cast<float>(r.height()));
  const Ground& ground = kGrounds[look.ground];
  std::uint32_t plain = look.matte ? 0x000000 : ground.light;
  if (!look.matte && look.ground == 0 && background_.width == 1)
    plain = static_cast<std::uint32_t>(background_.rgba[0] << 16 | background_.rgba[1] << 8 |
                                       background_.rgba[2]);
  r.draw_shape(box({left, top}, {right, bottom}, srgb(plain)));
  if (look.matte) return;
  if (look.ground == 0 && background_.width > 1) {
    // Stretched over the frame in one direction, and its middle taken in the other.
    const float scale =
        scale_ * std::max(static_cast<float>(width_) / static_cast<float>(background_.width),
                          static_cast<float>(height_) / static_cast<float>(background_.height));
    const int columns = std::min(background_.width,
                                 static_cast<int>(scale_ * static_cast<float>(width_) / scale)),
              rows = std::min(background_.height,
                              static_cast<int>(scale_ * static_cast<float>(height_) / scale));
    const int x = (background_.width - columns) / 2, y = (background_.height - rows) / 2;
    SpriteDraw draw;
    draw.image =
        ImageView(ImageView(background_).pixel(x, y), columns, rows, 4 * background_.width);
    draw.key = {kBackKey, 0};
    draw.position = corner_;
    draw.scale = scale;
    r.draw_sprite(draw);
  }
  draw_squares(r, ground, {left, top}, {right, bottom}, 16);
}

void KeyView::draw_cut_out(Renderer& r, const KeyLook& look) {
  const KeyShown& shown = *look.shown[look.slot];
  if (!has_drawn_ || drawn_ != shown.wish || drawn_matte_ != look.matte) {
    has_drawn_ = true;
    drawn_ = shown.wish;
    drawn_matte_ = look.matte;
    cut_ = look.matte ? grey_of(shown.keyed.straight) : shown.keyed.straight;
    if (!look.matte) premultiply(cut_);
    r.forget(kCutKey);
  }
  if (cut_.width == 0) return;
  SpriteDraw draw;
  draw.image = cut_;
  draw.key = {kCutKey, 0};
  draw.position = {corner_.x + scale_ * static_cast<float>(shown.keyed.crop.x),
                   corner_.y + scale_ * static_cast<float>(shown.keyed.crop.y)};
  draw.scale = scale_;
  r.draw_sprite(draw);
}

void KeyView::draw_picture(Renderer& r, const KeyLook& look, float ui) {
  const auto& shown = look.shown[look.slot];
  if (!shown) return;
  draw_ground(r, look);
  draw_cut_out(r, look);
  const float divide = static_cast<float>(area_.x) + look.split * static_cast<float>(area_.width);
  const bool whole = look.picking || !shown->error.empty();
  const int columns =
      whole ? width_ : std::clamp(static_cast<int>(std::lround(to_film({divide, 0}).x)), 0, width_);
  if (columns != drawn_columns_ || shown->keyed.index != drawn_frame_) r.forget(kFilmKey);
  drawn_columns_ = columns;
  drawn_frame_ = shown->keyed.index;
  if (columns > 0) {
    SpriteDraw draw;
    draw.image = ImageView(shown->film.rgba.data(), columns, height_, 4 * width_);
    draw.key = {kFilmKey, 0};
    draw.position = corner_;
    draw.scale = scale_;
    r.draw_sprite(draw);
  }
  if (whole) return;
  const float top = std::max(static_cast<float>(area_.y), corner_.y),
              bottom = std::min(static_cast<float>(area_.y + area_.height),
                                corner_.y + scale_ * static_cast<float>(height_));
  r.draw_shape(line({divide, top}, {divide, bottom}, 4 * ui, srgb(0x12181c, 0.6f)));
  r.draw_shape(line({divide, top}, {divide, bottom}, 1.5f * ui, srgb(0xf2f6f8)));
  r.draw_shape(disc({divide, 0.5f * (top + bottom)}, 9 * ui, srgb(0x12181c, 0.7f)));
  r.draw_shape(disc({divide, 0.5f * (top + bottom)}, 7 * ui, srgb(0xf2f6f8)));
}

void KeyView::take_mouse(KeyLook& look, float ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const Vec2 mouse{io.MousePos.x * io.DisplayFramebufferScale.x,
                   io.MousePos.y * io.DisplayFramebufferScale.y};
  const bool is_down = ImGui::IsMouseDown(ImGuiMouseButton_Left);
  if (dragging_split_)
    look.split = std::clamp(
        (mouse.x - static_cast<float>(area_.x)) / static_cast<float>(area_.width), 0.0f, 1.0f);
  if (moving_) {
    look.center.x -=
        io.MouseDelta.x * io.DisplayFramebufferScale.x / (scale_ * static_cast<float>(width_));
    look.center.y -=
        io.MouseDelta.y * io.DisplayFramebufferScale.y / (scale_ * static_cast<float>(height_));
    look.center = {std::clamp(look.center.x, 0.0f, 1.0f), std::clamp(look.center.y, 0.0f, 1.0f)};
  }
  if (!is_down) dragging_split_ = moving_ = false;
  const bool is_over = !io.WantCaptureMouse && width_ > 0 &&
                       mouse.x >= static_cast<float>(area_.x) &&
                       mouse.y >= static_cast<float>(area_.y) &&
                       mouse.x < static_cast<float>(area_.x + area_.width) &&
                       mouse.y < static_cast<float>(area_.y + area_.height);
  if (!is_over || !look.shown[look.slot]) return;
  if (io.MouseWheel != 0) {
    const Vec2 at = to_film(mouse);
    const float before = look.zoom;
    look.zoom = std::clamp(look.zoom * std::pow(1.25f, io.MouseWheel), 1.0f, 32.0f);
    // What is under the pointer stays there.
    const float keep = before / look.zoom;
    const Vec2 share{at.x / static_cast<float>(width_), at.y / static_cast<float>(height_)};
    look.center = {std::clamp(share.x + (look.center.x - share.x) * keep, 0.0f, 1.0f),
                   std::clamp(share.y + (look.center.y - share.y) * keep, 0.0f, 1.0f)};
    if (look.zoom <= 1) look.center = {0.5f, 0.5f};
  }
  if (!ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return;
  if (look.picking) {
    look.settings[look.slot].key = color_at(look.shown[look.slot]->film, to_film(mouse));
    look.picking = false;
    return;
  }
  const float divide = static_cast<float>(area_.x) + look.split * static_cast<float>(area_.width);
  dragging_split_ = std::abs(mouse.x - divide) < kReach * ui;
  look.split_given |= dragging_split_;
  moving_ = !dragging_split_;
}

void KeyView::draw_names(const KeyLook& look, float ui) const {
  const auto& shown = look.shown[look.slot];
  const float top = std::max(static_cast<float>(area_.y), corner_.y) + 10 * ui;
  const float left = static_cast<float>(area_.x) + 12 * ui;
  if (!shown) return;
  if (!shown->error.empty()) return caption({left, top}, shown->error);
  if (look.picking) {
    const ImGuiIO& io = ImGui::GetIO();
    const std::string color =
        color_at(shown->film, to_film({io.MousePos.x * io.DisplayFramebufferScale.x,
                                       io.MousePos.y * io.DisplayFramebufferScale.y}));
    caption({left, top}, "Click on the bare screen: " + color);
    return;
  }
  const float divide = static_cast<float>(area_.x) + look.split * static_cast<float>(area_.width);
  if (look.split > 0.1f) caption({left, top}, "film");
  const std::string name = std::string(look.matte ? "matte, " : "cut out, ") + "AB"[look.slot];
  if (look.split < 0.88f) caption({divide + 14 * ui, top}, name);
}

std::optional<KeyAction> KeyView::draw_side(KeyLook& look, float ui) const {
  std::optional<KeyAction> clicked;
  Settings& settings = look.settings[look.slot];
  const auto& shown = look.shown[look.slot];
  begin_panel("side", side_);
  const float all = ImGui::GetContentRegionAvail().x, gap = ImGui::GetStyle().ItemSpacing.x;
  const float half = (all - gap) / 2, height = 30 * ui;
  if (look.help) {
    ImGui::TextColored(kText, "Keys");
    show_help();
    line_of(kFaint, "F1 again: back to the settings.");
    ImGui::End();
    return clicked;
  }
  if (button("A  (Tab)", half, height, look.slot == 0) && look.slot != 0)
    clicked = KeyAction::Other;
  ImGui::SameLine();
  if (button("B  (Tab)", half, height, look.slot == 1) && look.slot != 1)
    clicked = KeyAction::Other;
  // The screen.
  const bool given = settings.key.starts_with("#");
  ImVec4 swatch{0.2f, 0.2f, 0.2f, 1};
  if (shown && shown->error.empty())
    swatch = {shown->color[0] / 255, shown->color[1] / 255, shown->color[2] / 255, 1};
  ImGui::ColorButton("##screen", swatch,
                     ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                     {height, height});
  ImGui::SameLine();
  const float rest = ImGui::GetContentRegionAvail().x;
  if (button("Pick its colour  (E)", rest * 0.6f, height, look.picking || given))
    clicked = KeyAction::Pick;
  ImGui::SameLine();
  if (button("Auto  (U)", -1, height, settings.key == "auto")) clicked = KeyAction::Measure;
  line_of(kFaint,
          shown && shown->error.empty() ? shown->background : "Background: " + settings.key);
  // The sliders.
  for (int k = 0; k < kKeySliders; ++k) {
    const KeySlider& s = kSliders[k];
    const bool acts = !shown || !shown->error.empty() ||
                      (s.field == &Settings::despill ? shown->has_tint : shown->is_keyed);
    const double value = settings.*s.field;
    ImGui::TextColored(k == look.slider ? kText : kFaint, "%d", k + 1);
    ImGui::SameLine();
    ImGui::TextColored(k == look.slider || value != s.neutral() ? kText : kFaint, "%s", s.title);
    ImGui::BeginDisabled(!acts);
    ImGui::SetNextItemWidth(-1);
    auto shown_value = static_cast<float>(value);
    const std::string id = std::string("##") + s.name;
    if (ImGui::SliderFloat(id.c_str(), &shown_value, static_cast<float>(s.low),
                           static_cast<float>(s.high), s.format, ImGuiSliderFlags_NoInput)) {
      set_slider(settings, k, static_cast<double>(shown_value));
      look.slider = k;
    }
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
      set_slider(settings, k, s.neutral());
    ImGui::EndDisabled();
  }
  if (button("As measured  (R)", half, height)) clicked = KeyAction::Reset;
  ImGui::SameLine();
  if (button("Copy to other  (X)", half, height)) clicked = KeyAction::Copy;
  const std::string over = std::string("Over ") + kGrounds[look.ground].name + "  (G)";
  if (button(over.c_str(), half, height)) clicked = KeyAction::Ground;
  ImGui::SameLine();
  if (button("Matte  (M)", half, height, look.matte)) clicked = KeyAction::Matte;
  ImGui::Separator();
  show_state(look);
  line_of(kText, key_command(settings));
  if (button("Copy  (C)", half, height)) clicked = KeyAction::Clipboard;
  ImGui::SameLine();
  if (button("Cut film  (Enter)", half, height)) clicked = KeyAction::Run;
  line_of(kText, look.said);
  line_of(
      kFaint,
      "The line between film and cut-out can be dragged; the wheel zooms, a drag moves. F1 lists "
      "the keys, Escape ends.");
  ImGui::End();
  return clicked;
}

void KeyView::draw_time(KeyLook& look, float) const {
  begin_panel("time", time_);
  ImGui::SetNextItemWidth(-1);
  const int last = std::max(look.state.film_frames - 1, 1);
  int frame = look.frame;
  const std::string text = look.state.frames.empty()
                               ? std::string("nothing to show yet")
                               : "frame %d of " + std::to_string(look.state.film_frames);
  if (ImGui::SliderInt("##frame", &frame, 0, last, text.c_str(), ImGuiSliderFlags_NoInput))
    look.frame = frame;
  ImGui::End();
}

std::optional<KeyAction> KeyView::draw(Renderer& r, KeyLook& look, float ui) {
  lay_out(r, look, ui);
  follow_subject(look);
  r.clear(srgb(0x1a2126));
  draw_picture(r, look, ui);
  const auto clicked = draw_side(look, ui);
  draw_time(look, ui);
  draw_names(look, ui);
  take_mouse(look, ui);
  return clicked;
}

}  // namespace vsprite::window
