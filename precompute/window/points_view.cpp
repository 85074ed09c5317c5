// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The points window: a view with its points and mesh, the character beside it, words, buttons and
// sliders on the right. Pictures are drawn by the renderer, in linear light; words by Dear ImGui.
#include "window/points_view.h"

#include <algorithm>
#include <cmath>

#include "tool/report.h"
#include "window/panel.h"

namespace vsprite::window {
namespace {

constexpr float kSide = 330, kGap = 12, kReach = 11;
constexpr std::uint64_t kViewKey = 1;

/// The size of a sheet; one without a picture is as large as the first that has one.
Vec2 size_of(const PointsEdit& edit, std::size_t sheet) {
  const Image* picture = &edit.sheet(sheet).picture;
  for (std::size_t k = 0; k < edit.sheet_count() && picture->width == 0; ++k)
    picture = &edit.sheet(k).picture;
  if (picture->width == 0) return {400, 400};
  return {static_cast<float>(picture->width), static_cast<float>(picture->height)};
}

void show_help() {
  constexpr const char* kRows[][2] = {{"click", "a point more, in every view"},
                                      {"drag a point", "moves it in this view"},
                                      {"right click", "takes a point out"},
                                      {"Ctrl+click", "takes a face out"},
                                      {"F", "flips the edge under the mouse"},
                                      {"M", "mesh: kept, made anew"},
                                      {"G", "mesh: shown, hidden"},
                                      {"T", "points: of picture, of pose"},
                                      {"arrows", "move the point by 1 px"},
                                      {"PgUp, PgDn", "another view"},
                                      {"wheel", "nearer, further"},
                                      {"Space", "play, stop"},
                                      {"U, Ctrl+Z", "undo"},
                                      {"R, Ctrl+Y", "redo"},
                                      {"Delete", "the selected point"},
                                      {"S, Ctrl+S", "save"},
                                      {"Escape", "end"}};
  for (const auto& row : kRows) {
    ImGui::TextColored(kText, "%s", row[0]);
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.42f);
    ImGui::TextColored(kFaint, "%s", row[1]);
  }
}

Color hue_of(bool own) { return own ? srgb(0xf0a030, 0.9f) : srgb(0x2f8fa8, 0.9f); }

}  // namespace

void PointsView::lay_out(const Renderer& r, const PointsEdit& edit, const PointsLook& look,
                         float ui) {
  const int gap = static_cast<int>(kGap * ui), side = static_cast<int>(kSide * ui);
  const int rest = std::max(r.width() - side - 3 * gap, 4);
  const int width = rest * 58 / 100, height = std::max(r.height() - 2 * gap, 2);
  area_ = {gap, gap, width, height};
  preview_ = {2 * gap + width, gap, rest - width, height};
  side_ = {r.width() - side, 0, side, r.height()};
  const Vec2 size = size_of(edit, look.sheet);
  const float fits =
      std::min(static_cast<float>(area_.width) / size.x, static_cast<float>(area_.height) / size.y);
  scale_ = fits * look.zoom;
  reach_ = kReach * ui / scale_;
  const Vec2 middle = look.zoom > 1 ? look.middle : Vec2{size.x / 2, size.y / 2};
  corner_ = {
      static_cast<float>(area_.x) + static_cast<float>(area_.width) / 2 - scale_ * middle.x,
      static_cast<float>(area_.y) + static_cast<float>(area_.height) / 2 - scale_ * middle.y};
}

Vec2 PointsView::to_window(Vec2 p) const {
  return {corner_.x + scale_ * p.x, corner_.y + scale_ * p.y};
}
Vec2 PointsView::to_view(Vec2 w) const {
  return {(w.x - corner_.x) / scale_, (w.y - corner_.y) / scale_};
}

void PointsView::draw_view(Renderer& r, const PointsEdit& edit, const PointsLook& look) {
  const Vec2 size = size_of(edit, look.sheet);
  r.draw_shape(box(to_window({0, 0}), to_window(size), srgb(0xb9c1c7)));
  pictures_.resize(edit.sheet_count());
  Image& picture = pictures_[look.sheet];
  if (edit.sheet(look.sheet).picture.width == 0) return;
  if (picture.width == 0) {
    picture = edit.sheet(look.sheet).picture;
    premultiply(picture);
  }
  SpriteDraw draw;
  draw.image = picture;
  draw.key = {kViewKey, static_cast<std::uint32_t>(look.sheet)};
  draw.position = to_window({0, 0});
  draw.scale = scale_;
  // Where the pose is placed the picture only hints.
  if (look.layer == PointLayer::Pose && edit.has_pose(look.sheet)) draw.tint.a = 0.35f;
  r.draw_sprite(draw);
}

void PointsView::draw_mesh(Renderer& r, const PointsEdit& edit, const PointsLook& look, float ui) {
  if (!look.mesh) return;
  const auto& points = edit.points(look.sheet, look.layer);
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const Face& face : edit.faces())
    for (std::uint32_t c = 0; c < face.count; ++c)
      edges.insert(std::minmax(face.corners[c], face.corners[(c + 1) % face.count]));
  for (const auto& [a, b] : edges)
    r.draw_shape(
        line(to_window(points[a]), to_window(points[b]), 1.5f * ui, hue_of(edit.has_own_faces())));
}

void PointsView::draw_points(Renderer& r, const PointsEdit& edit, const PointsLook& look,
                             float ui) {
  const auto& points = edit.points(look.sheet, look.layer);
  const bool dense = points.size() > 150;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const bool is_chosen = look.selected == k || edit.held() == k || look.over == k;
    const float radius = (is_chosen ? 7.0f : dense ? 3.0f : 4.5f) * ui;
    r.draw_shape(disc(to_window(points[k]), radius + 1.5f * ui, srgb(0x12181c, 0.8f)));
    r.draw_shape(disc(to_window(points[k]), radius,
                      srgb(look.selected == k ? 0xf0a030
                           : is_chosen        ? 0x3db885
                                              : 0xffffff)));
  }
  const auto named = edit.held() ? edit.held() : look.over ? look.over : look.selected;
  if (!named || *named >= points.size()) return;
  const Vec2 at = to_window(points[*named]);
  r.draw_shape(disc({at.x + 18 * ui, at.y - 18 * ui}, 13 * ui, srgb(0x12181c, 0.75f)));
  r.draw_text(std::to_string(*named + 1), {at.x + 18 * ui, at.y - 26 * ui},
              {.size = 15 * ui, .align = Align::Center});
}

void PointsView::take_mouse(PointsEdit& edit, PointsLook& look, float ui) {
  const ImGuiIO& io = ImGui::GetIO();
  const Vec2 mouse{io.MousePos.x * io.DisplayFramebufferScale.x,
                   io.MousePos.y * io.DisplayFramebufferScale.y};
  look.mouse = to_view(mouse);
  look.over.reset();
  if (edit.held()) {
    const Vec2 size = size_of(edit, look.sheet);
    edit.move({std::clamp(look.mouse.x, -size.x, 2 * size.x),
               std::clamp(look.mouse.y, -size.y, 2 * size.y)});
    if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) edit.drop();
    return;
  }
  look.is_over = !io.WantCaptureMouse && mouse.x >= static_cast<float>(area_.x) &&
                 mouse.y >= static_cast<float>(area_.y) &&
                 mouse.x <= static_cast<float>(area_.x + area_.width) &&
                 mouse.y <= static_cast<float>(area_.y + area_.height);
  if (!look.is_over) return;
  if (io.MouseWheel != 0) {  // the place under the mouse stays there
    const Vec2 size = size_of(edit, look.sheet);
    if (look.zoom <= 1) look.middle = {size.x / 2, size.y / 2};
    const float zoom = std::clamp(look.zoom * std::pow(1.25f, io.MouseWheel), 1.0f, 32.0f);
    const float kept = look.zoom / zoom;
    look.middle = {look.mouse.x + kept * (look.middle.x - look.mouse.x),
                   look.mouse.y + kept * (look.middle.y - look.mouse.y)};
    look.zoom = zoom;
  }
  if (ImGui::IsMouseDown(ImGuiMouseButton_Middle) && look.zoom > 1) {
    look.middle.x -= io.MouseDelta.x * io.DisplayFramebufferScale.x / scale_;
    look.middle.y -= io.MouseDelta.y * io.DisplayFramebufferScale.y / scale_;
  }
  look.over = edit.point_at(look.sheet, look.layer, look.mouse, kReach * ui / scale_);
  const auto say = [&](const Result<void>& done) {
    if (!done) look.said = done.error().message;
    if (done) look.said.clear();
    return static_cast<bool>(done);
  };
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Right) && look.over) {
    if (say(edit.erase(*look.over))) look.selected.reset();
    look.over.reset();
  }
  if (!ImGui::IsMouseClicked(ImGuiMouseButton_Left)) return;
  if (io.KeyCtrl) {
    if (const auto face = edit.face_at(look.sheet, look.layer, look.mouse))
      say(edit.cut_face(*face));
    return;
  }
  if (!look.over) {
    if (!say(edit.add(look.sheet, look.layer, look.mouse))) return;
    look.over = edit.point_count() - 1;
  }
  look.selected = look.over;
  edit.take(look.sheet, look.layer, *look.over);
}

std::optional<PointsAction> PointsView::draw_side(PointsEdit& edit, PuppetPreview& preview,
                                                  PointsLook& look, float ui) const {
  std::optional<PointsAction> clicked;
  begin_panel("side", side_);
  ImGui::SetWindowFontScale(1.2f);
  ImGui::TextColored(kText, "%s", title_.c_str());
  ImGui::SetWindowFontScale(1);
  line_of(kFaint,
          edit.sheet(look.sheet).name + (edit.has_pose(look.sheet) ? look.layer == PointLayer::Pose
                                                                         ? ": points of the pose"
                                                                         : ": points of the picture"
                                                                   : ""));
  const float spacing = ImGui::GetStyle().ItemSpacing.x;
  const float whole = ImGui::GetContentRegionAvail().x;
  const int a_row = std::max(1, static_cast<int>((whole + spacing) / (34 * ui + spacing)));
  ImGui::BeginChild("views",
                    {0, (edit.sheet_count() > static_cast<std::size_t>(a_row) ? 80 : 40) * ui});
  for (std::size_t k = 0; k < edit.sheet_count(); ++k) {
    if (k % static_cast<std::size_t>(a_row) != 0) ImGui::SameLine();
    const bool is_here = k == look.sheet;
    if (is_here) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4{0.20f, 0.52f, 0.66f, 1});
    if (ImGui::Button(std::to_string(k + 1).c_str(), {34 * ui, 30 * ui})) look.sheet = k;
    if (is_here) ImGui::PopStyleColor();
  }
  ImGui::EndChild();
  line_of(kText, std::to_string(edit.point_count()) + " points, " +
                     std::to_string(edit.faces().size()) + " faces" +
                     (edit.has_own_faces() ? ", kept" : "") +
                     (edit.is_saved() ? "" : "; not saved"));
  const float half = (whole - spacing) / 2, height = 32 * ui;
  const auto button = [&](const char* label, PointsAction action, bool first) {
    if (!first) ImGui::SameLine();
    if (ImGui::Button(label, {half, height})) clicked = action;
  };
  button("Undo  (U)", PointsAction::Undo, true);
  button("Redo  (R)", PointsAction::Redo, false);
  button(edit.has_own_faces() ? "Mesh anew  (M)" : "Keep mesh  (M)", PointsAction::Mesh, true);
  button("Save  (S)", PointsAction::Save, false);
  ImGui::Separator();
  if (!preview.puppets().empty()) {
    if (ImGui::Button(preview.playing ? "Stop" : "Play", {60 * ui, 0}))
      clicked = PointsAction::Play;
    for (std::size_t k = 0; preview.puppets().size() > 1 && k < preview.puppets().size(); ++k) {
      ImGui::SameLine();
      if (ImGui::RadioButton(preview.puppets()[k].name.c_str(), preview.shown == k))
        preview.shown = k;
    }
    const Puppet& puppet = preview.puppets()[0];
    for (std::size_t d = 0; d < puppet.parameters.size() && d < preview.parameters.size(); ++d) {
      const PuppetParameter& p = puppet.parameters[d];
      ImGui::SetNextItemWidth(-1);
      const double high = p.period > 0 ? p.low + p.period : p.high;
      // The name stands in the slider; a % in it is no format.
      std::string format;
      for (const char c : p.name) format += c == '%' ? std::string("%%") : std::string(1, c);
      if (ImGui::SliderScalar(("##" + std::to_string(d)).c_str(), ImGuiDataType_Double,
                              &preview.parameters[d], &p.low, &high, (format + "  %.2f").c_str(),
                              ImGuiSliderFlags_NoInput))
        preview.playing = false;
    }
  }
  if (!preview.fault().empty()) line_of(kBad, preview.fault());
  ImGui::Separator();
  if (!look.said.empty()) line_of(kText, look.said);
  if (look.help)
    show_help();
  else
    line_of(kFaint, "Click for a point, drag it to its landmark. F1 lists the keys.");
  ImGui::End();
  return clicked;
}

std::optional<PointsAction> PointsView::draw(Renderer& r, PointsEdit& edit, PuppetPreview& preview,
                                             PointsLook& look, float ui) {
  look.sheet = std::min(look.sheet, edit.sheet_count() - 1);
  if (look.selected && *look.selected >= edit.point_count()) look.selected.reset();
  if (look.over && *look.over >= edit.point_count()) look.over.reset();
  lay_out(r, edit, look, ui);
  r.clear(srgb(0x1a2126));
  draw_view(r, edit, look);
  draw_mesh(r, edit, look, ui);
  draw_points(r, edit, look, ui);
  // What a view drawn large covers of its neighbour.
  const float right = static_cast<float>(preview_.x + preview_.width);
  r.draw_shape(box({static_cast<float>(area_.x + area_.width), 0},
                   {right + kGap * ui, static_cast<float>(r.height())}, srgb(0x1a2126)));
  r.draw_shape(box({static_cast<float>(preview_.x), static_cast<float>(preview_.y)},
                   {right, static_cast<float>(preview_.y + preview_.height)}, srgb(0xe8e2d6), 8));
  preview.draw(r, preview_);
  const auto clicked = draw_side(edit, preview, look, ui);
  take_mouse(edit, look, ui);
  return clicked;
}

}  // namespace vsprite::window
