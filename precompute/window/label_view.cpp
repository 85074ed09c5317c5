// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The label window: the jump in the middle, its two frames above, guess, keys and rates beside.
// Pictures are drawn by the renderer, in linear light; words and buttons by Dear ImGui over them.
#include "window/label_view.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "window/panel.h"

namespace vsprite::window {
namespace {

constexpr int kBefore = 12, kAfter = 12;  // samples shown around the cut
constexpr double kPause = 8;              // film frames on the last picture
constexpr float kSide = 372, kGap = 14, kStill = 0.36f;

constexpr Ground kGrounds[kLabelGrounds] = {
    kSquares, kWhite, kGrey, kBlack, {"water", 0x4f93ad, 0x478aa5}};

/// Duplicates of a frame were dropped, and the sample before them is shown for as long.
void append(const FeatureSet& set, int sample, Vec2 place, PlayedJump& jump, double& time) {
  time += set.rows[static_cast<std::size_t>(sample)].duration;
  jump.frames.push_back({sample, place, time});
}

void cover(const FeatureSet& set, PlayedJump& jump) {
  jump.low = {1e9f, 1e9f};
  jump.high = {-1e9f, -1e9f};
  for (const PlayedFrame& f : jump.frames) {
    const SampleRow& row = set.rows[static_cast<std::size_t>(f.sample)];
    const auto left = f.place.x + static_cast<float>(row.left - row.anchor_x);
    const auto top = f.place.y + static_cast<float>(row.top - row.anchor_y);
    jump.low = {std::min(jump.low.x, left), std::min(jump.low.y, top)};
    jump.high = {std::max(jump.high.x, left + static_cast<float>(row.width)),
                 std::max(jump.high.y, top + static_cast<float>(row.height))};
  }
}

Vec2 anchor_of(const FeatureSet& set, int sample) {
  const SampleRow& row = set.rows[static_cast<std::size_t>(sample)];
  return {static_cast<float>(row.anchor_x), static_cast<float>(row.anchor_y)};
}

/// Film px to screen px so that `size` fits into `area`.
float fitting(const Rect& area, Vec2 size) {
  const float room = 0.92f;
  return std::min({room * static_cast<float>(area.width) / std::max(size.x, 1.0f),
                   room * static_cast<float>(area.height) / std::max(size.y, 1.0f), 4.0f});
}

ImU32 faded(std::uint32_t rgb, int alpha) {
  return IM_COL32(rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255, alpha);
}

/// Words over the pictures, readable on every ground.
void caption(Vec2 at, const std::string& text) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  list.AddRectFilled({at.x - 7, at.y - 4}, {at.x + size.x + 7, at.y + size.y + 4},
                     IM_COL32(18, 24, 28, 190), 5);
  list.AddText({at.x, at.y}, faded(0xe8eef0, 255), text.c_str());
}

std::string percent(int part, int whole) {
  return whole > 0 ? std::to_string((100 * part + whole / 2) / whole) + " %" : "-";
}

/// A wide button with its key on the right.
bool key_button(const std::string& label, const std::string& key, const ImVec4& color,
                float height) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushStyleColor(ImGuiCol_Button, {color.x * 0.62f, color.y * 0.62f, color.z * 0.62f, 1});
  ImGui::PushStyleColor(ImGuiCol_ButtonHovered,
                        {color.x * 0.75f, color.y * 0.75f, color.z * 0.75f, 1});
  ImGui::PushStyleColor(ImGuiCol_ButtonActive, color);
  ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0, 0.5f});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {18, 6});
  const bool clicked = ImGui::Button(label.c_str(), {-1, height});
  const float right = ImGui::GetItemRectMax().x;
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor(3);
  const ImVec2 size = ImGui::CalcTextSize(key.c_str());
  const ImVec2 corner{right - size.x - 20, at.y + (height - size.y) / 2 - 3};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {right - 8, corner.y + size.y + 6}, IM_COL32(12, 16, 19, 150), 4);
  list.AddText({corner.x + 6, corner.y + 3}, faded(0xffffff, 230), key.c_str());
  return clicked;
}

void show_help(const LabelKeys& keys) {
  for (int k = 0; k < kLabelActionCount; ++k) {
    const auto action = static_cast<LabelAction>(k);
    ImGui::TextColored(kText, "%s", keys.key_name(action).c_str());
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.24f);
    ImGui::TextColored(kFaint, "%s", std::string(info_of(action).help).c_str());
  }
  line_of(kFaint, "Other keys: --bind \"accept=a flip=s\"");
}

void show_guess(const ShownPair& pair) {
  const bool smooth = pair.guess_smooth();
  ImGui::TextColored(kFaint, "My guess");
  ImGui::SetWindowFontScale(1.45f);
  ImGui::TextColored(smooth ? kGood : kBad, smooth ? "smooth" : "a visible jump");
  ImGui::SetWindowFontScale(1);
  ImGui::TextColored(kFaint, "D = %.2f; the line lies at 1", double{pair.distance});
  if (pair.taken_back)
    line_of(kText,
            std::string("You had said: ") + (*pair.taken_back ? "smooth" : "a visible jump"));
}

void show_rates(const LabelProgress& p) {
  const float share =
      std::min(1.0f, static_cast<float>(p.answered) / static_cast<float>(std::max(p.goal, 1)));
  const std::string done = std::to_string(p.answered) + " of " + std::to_string(p.goal);
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, {0.20f, 0.52f, 0.66f, 1});
  ImGui::ProgressBar(share, {-1, 0}, done.c_str());
  ImGui::PopStyleColor();
  line_of(kFaint, "In this folder " + std::to_string(p.smooth + p.jumps) + " pairs: " +
                      std::to_string(p.smooth) + " smooth, " + std::to_string(p.jumps) + " jumps");
  ImGui::Spacing();
  if (p.guessed == 0) return line_of(kFaint, "How good my guesses are shows after some answers.");
  line_of(kText, "Guesses right: " + percent(p.agreed, p.guessed) + "  (" +
                     std::to_string(p.agreed) + " of " + std::to_string(p.guessed) +
                     ", most of them doubtful on purpose)");
  const FalseAccepts& r = p.random;
  if (r.accepted > 0)
    line_of(kText, "Jumps let through: " + percent(r.wrong, r.accepted) + "  (" +
                       std::to_string(r.wrong) + " of " + std::to_string(r.accepted) +
                       " drawn at random; at most " +
                       std::to_string(std::lround(100 * likely_at_most(r.wrong, r.accepted))) +
                       " % in the film)");
  if (r.refused > 0)
    line_of(kText, "Smooth ones missed: " + percent(r.missed, r.refused) + "  (" +
                       std::to_string(r.missed) + " of " + std::to_string(r.refused) + ")");
}

}  // namespace

PlayedJump make_jump(const FeatureSet& set, int from, int to) {
  PlayedJump jump;
  double time = 0;
  int first = from;
  while (from - first < kBefore && first > 0 && follows(set, first - 1, first)) --first;
  for (int s = first; s <= from; ++s) append(set, s, anchor_of(set, s), jump, time);
  jump.cut = time;
  const Vec2 shift{anchor_of(set, from).x - anchor_of(set, to).x,
                   anchor_of(set, from).y - anchor_of(set, to).y};
  const int last = static_cast<int>(set.rows.size()) - 1;
  int s = to < last && follows(set, to, to + 1) ? to + 1 : to;
  for (int shown = 0; shown < kAfter; ++shown) {
    const Vec2 anchor = anchor_of(set, s);
    append(set, s, {anchor.x + shift.x, anchor.y + shift.y}, jump, time);
    if (s >= last || !follows(set, s, s + 1)) break;
    ++s;
  }
  jump.length = time + kPause;
  cover(set, jump);
  return jump;
}

Result<void> LabelView::show() {
  pictures_.clear();
  at_ = 0;
  playing_ = 0;
  if (!session_.current()) return {};
  const int i = session_.current()->i, j = session_.current()->j;
  jumps_[0] = make_jump(session_.features(), i, j);
  jumps_[1] = make_jump(session_.features(), j, i);
  for (const PlayedJump& jump : jumps_) {
    for (const PlayedFrame& frame : jump.frames) {
      if (pictures_.count(frame.sample) > 0) continue;
      auto picture = session_.picture(frame.sample);
      if (!picture) return picture.error();
      premultiply(*picture);
      pictures_.emplace(frame.sample, std::move(*picture));
    }
  }
  return {};
}

void LabelView::draw_ground(Renderer& r, const Rect& area, int ground) const {
  const Ground& g = kGrounds[ground];
  const Vec2 low{static_cast<float>(area.x), static_cast<float>(area.y)};
  const Vec2 high{low.x + static_cast<float>(area.width), low.y + static_cast<float>(area.height)};
  r.draw_shape(box(low, high, srgb(g.light), 6));
  draw_squares(r, g, low, high, 32);
}

void LabelView::draw_sample(Renderer& r, int sample, Vec2 at, float scale) const {
  const auto found = pictures_.find(sample);
  if (found == pictures_.end()) return;
  const SampleRow& row = session_.features().rows[static_cast<std::size_t>(sample)];
  SpriteDraw draw;
  draw.image = found->second;
  draw.key = {1, static_cast<std::uint32_t>(sample)};
  draw.position = at;
  draw.anchor = {static_cast<float>((row.anchor_x - row.left) * row.scale),
                 static_cast<float>((row.anchor_y - row.top) * row.scale)};
  draw.scale = scale / static_cast<float>(row.scale);
  r.draw_sprite(draw);
}

/// One of the two frames, its picture in the middle of the panel.
void LabelView::draw_still(Renderer& r, const Rect& area, int sample, float scale,
                           int ground) const {
  draw_ground(r, area, ground);
  const SampleRow& row = session_.features().rows[static_cast<std::size_t>(sample)];
  const Vec2 middle{static_cast<float>(area.x) + 0.5f * static_cast<float>(area.width),
                    static_cast<float>(area.y) + 0.5f * static_cast<float>(area.height)};
  const Vec2 off{static_cast<float>(row.anchor_x - row.left - row.width / 2),
                 static_cast<float>(row.anchor_y - row.top - row.height / 2)};
  draw_sample(r, sample, {middle.x + scale * off.x, middle.y + scale * off.y}, scale);
}

void LabelView::draw_loop(Renderer& r, const Rect& area, const LabelLook& look, double seconds) {
  draw_ground(r, area, look.ground);
  at_ += seconds * session_.features().fps * static_cast<double>(look.speed);
  if (at_ >= jumps_[playing_].length) {
    playing_ = 1 - playing_;
    at_ = 0;
  }
  const PlayedJump& jump = jumps_[playing_];
  const auto shown = std::find_if(jump.frames.begin(), jump.frames.end(),
                                  [&](const PlayedFrame& f) { return f.until > at_; });
  const PlayedFrame& frame = shown == jump.frames.end() ? jump.frames.back() : *shown;
  // One scale for both ways, so that nothing swells between them.
  float scale = 4;
  for (const PlayedJump& one : jumps_)
    scale = std::min(scale, fitting(area, {one.high.x - one.low.x, one.high.y - one.low.y}));
  const Vec2 middle{static_cast<float>(area.x) + 0.5f * static_cast<float>(area.width),
                    static_cast<float>(area.y) + 0.5f * static_cast<float>(area.height)};
  draw_sample(r, frame.sample,
              {middle.x + scale * (frame.place.x - 0.5f * (jump.low.x + jump.high.x)),
               middle.y + scale * (frame.place.y - 0.5f * (jump.low.y + jump.high.y))},
              scale);
  // Where the cut is, and how far the loop has come.
  const float left = static_cast<float>(area.x) + 16,
              right = static_cast<float>(area.x + area.width) - 16,
              y = static_cast<float>(area.y + area.height) - 16;
  const double moving = jump.length - kPause;
  const auto x = [&](double t) {
    return left + (right - left) * static_cast<float>(std::min(t / moving, 1.0));
  };
  r.draw_shape(vsprite::line({left, y}, {right, y}, 4, srgb(0x12181c, 0.45f)));
  r.draw_shape(vsprite::line({left, y}, {x(at_), y}, 4, srgb(0xf2f6f8, 0.9f)));
  r.draw_shape(vsprite::line({x(jump.cut), y - 8}, {x(jump.cut), y + 8}, 3, srgb(0xf08c42)));
}

std::optional<LabelAction> LabelView::draw_side(const Rect& area, const LabelKeys& keys,
                                                LabelLook& look, float ui) const {
  std::optional<LabelAction> clicked;
  const auto button = [&](LabelAction action, const char* label, const ImVec4& color,
                          float height) {
    if (key_button(label, keys.key_name(action), color, height * ui)) clicked = action;
  };
  ImGui::SetNextWindowPos({static_cast<float>(area.x), static_cast<float>(area.y)});
  ImGui::SetNextWindowSize({static_cast<float>(area.width), static_cast<float>(area.height)});
  ImGui::Begin("side", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  ImGui::SetWindowFontScale(1.2f);
  ImGui::TextColored(kText, "Would anyone see this cut?");
  ImGui::SetWindowFontScale(1);
  line_of(kFaint,
          "The subject is cut from one place of the film to another, where the bar is orange.");
  ImGui::Dummy({0, 6 * ui});
  const auto& pair = session_.current();
  if (pair) {
    show_guess(*pair);
    ImGui::Dummy({0, 4 * ui});
    const bool smooth = pair->guess_smooth();
    button(LabelAction::Accept, smooth ? "Right, it is smooth" : "Right, it is visible",
           smooth ? kGood : kBad, 50);
    button(LabelAction::Flip, smooth ? "Wrong, it is visible" : "Wrong, it is smooth",
           smooth ? kBad : kGood, 50);
  } else {
    line_of(kGood, "Everything that could teach something has been asked.");
  }
  const ImVec4 plain{0.36f, 0.43f, 0.48f, 1};
  button(LabelAction::Undo, "Undo", plain, 32);
  button(LabelAction::Redo, "Redo", plain, 32);
  button(LabelAction::Skip, "Cannot say, another", plain, 32);
  ImGui::Dummy({0, 6 * ui});
  ImGui::SetNextItemWidth(-1);
  const std::string speed = keys.key_name(LabelAction::Slower) + " slower    %.2f x    faster " +
                            keys.key_name(LabelAction::Faster);
  ImGui::SliderFloat("##speed", &look.speed, kSlowest, kFastest, speed.c_str(),
                     ImGuiSliderFlags_Logarithmic);
  button(LabelAction::Background, kGrounds[look.ground].name, plain, 32);
  ImGui::Separator();
  show_rates(session_.progress());
  ImGui::Separator();
  if (look.help)
    show_help(keys);
  else
    line_of(kFaint, (look.said.empty() ? std::string() : look.said + "\n") +
                        "Every answer is saved at once. " + keys.key_name(LabelAction::Help) +
                        " lists the keys, " + keys.key_name(LabelAction::Quit) + " ends.");
  ImGui::End();
  return clicked;
}

std::optional<LabelAction> LabelView::draw(Renderer& r, const LabelKeys& keys, LabelLook& look,
                                           double seconds, float ui) {
  r.clear(srgb(0x1a2126));
  const int gap = static_cast<int>(kGap * ui), side = static_cast<int>(kSide * ui);
  const int width = std::max(r.width() - side - 3 * gap, 2 * gap + 2), height = r.height();
  const int still = static_cast<int>(kStill * static_cast<float>(height));
  const Rect first{gap, gap, (width - gap) / 2, still};
  const Rect second{gap + first.width + gap, gap, first.width, still};
  const Rect loop{gap, 2 * gap + still, 2 * first.width + gap, height - 3 * gap - still};
  if (const auto& pair = session_.current()) {
    const auto& rows = session_.features().rows;
    const SampleRow &a = rows[static_cast<std::size_t>(pair->i)],
                    &b = rows[static_cast<std::size_t>(pair->j)];
    const Vec2 size{static_cast<float>(std::max(a.width, b.width)),
                    static_cast<float>(std::max(a.height, b.height))};
    const float scale = fitting(first, size);
    draw_still(r, first, pair->i, scale, look.ground);
    draw_still(r, second, pair->j, scale, look.ground);
    draw_loop(r, loop, look, seconds);
    const auto corner = [](const Rect& area) {
      return Vec2{static_cast<float>(area.x) + 16, static_cast<float>(area.y) + 12};
    };
    caption(corner(first), "A   frame " + std::to_string(a.frame));
    caption(corner(second), "B   frame " + std::to_string(b.frame));
    caption(corner(loop), playing_ == 0 ? "A, then on from B" : "B, then on from A");
  }
  return draw_side({width + 2 * gap, 0, r.width() - width - 2 * gap, height}, keys, look, ui);
}

}  // namespace vsprite::window
