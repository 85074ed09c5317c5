// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// A head as an ellipsoid that turns about its upright axis; features lie on it. The outlines drawn
// here are also the control points.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "puppet/art.h"
#include "puppet/brush.h"

namespace vsprite::puppet_art {
namespace {

constexpr float kA = 100, kB = 128, kC = 80;  // half axes: across, up, forwards
constexpr Vec2 kCenter{160, 186};
constexpr int kKnots = 28;  // of the outlines of face and hair
constexpr std::uint32_t kSkin = 0xf6c9a0, kSkinDark = 0xdd9670, kLine = 0x5a3227, kHair = 0x8a4b2a,
                        kHairLight = 0xb8733c, kHairDark = 0x5f2f1c;

class Head {
 public:
  Head(double rotation, double expression)
      : turn_(static_cast<float>(rotation * std::numbers::pi / 180)),
        anger_(static_cast<float>(expression)) {}

  // A point of the surface; `out` px in front of it.
  Vec2 at(float u, float v, float out = 0) const {
    const float rest = 1 - u * u / (kA * kA) - v * v / (kB * kB);
    const float w = kC * std::sqrt(std::max(0.0f, rest)) + out;
    return {kCenter.x + u * std::cos(turn_) + w * std::sin(turn_), kCenter.y + v};
  }
  // The silhouette: narrower cheek on the far side, the back of the head comes into view.
  Vec2 rim(float angle, float grow = 1) const {
    const float c = std::cos(angle), s = std::sin(angle);
    const float half = std::hypot(kA * std::cos(turn_), kC * std::sin(turn_)) + 3;
    const float jaw = s > 0 ? 1 - 0.26f * s * s * s : 1;
    const float back = c < 0 ? 1 + 0.10f * std::sin(turn_) * (s < 0.5f ? 1 : 0.6f) : 1;
    const float chin = s > 0 ? 12 * std::sin(turn_) * s * s : 0;
    return {kCenter.x + grow * half * c * jaw * back + chin, kCenter.y + grow * kB * s};
  }
  Path outline(float grow, int knots) const {
    Path out;
    for (int k = 0; k < knots; ++k)
      out.push_back(rim(
          2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(knots), grow));
    return out;
  }
  float mix(float calm, float angry) const { return calm + anger_ * (angry - calm); }

  // side -1: left in the picture.
  Path eye(float side, float grow = 1) const {
    const float height = mix(21, 11), width = 21, tilt = mix(0, 6);
    Path out;
    for (int k = 0; k < 8; ++k) {
      const float a = std::numbers::pi_v<float> * static_cast<float>(k) / 4;
      const float x = std::cos(a), y = std::sin(a);
      const float lid = y < 0 ? tilt * (1 - side * -x) : 0;  // anger lowers the inner lid
      out.push_back(at(side * 41 + grow * width * x, -18 + grow * height * y + lid));
    }
    return out;
  }
  Vec2 pupil(float side) const { return at(side * 41 - mix(0, 2) * side, -17 + mix(0, 2), 2); }
  Path brow(float side) const {
    Path out;
    for (int k = 0; k < 5; ++k) {
      const float part = static_cast<float>(k) / 4;  // from the inner end outwards
      const float arch = std::sin(part * std::numbers::pi_v<float>) * mix(13, 6);
      const float v = mix(-57, -36 - 17 * part) - arch + mix(4, 3) * part;
      out.push_back(at(side * (17 + 50 * part - mix(0, 6) * (1 - part)), v, 3));
    }
    return out;
  }
  Path nose() const {
    return {at(-4, -8, 8), at(-6, 14, 16), at(-15, 30, 6), at(-5, 37, 18),
            at(7, 36, 18), at(15, 30, 6),  at(6, 14, 18),  at(4, -8, 8)};
  }
  Path mouth(float grow = 1) const {
    const float width = mix(19, 36), up = mix(20, 8), down = mix(25, 9), corner = mix(0, 9);
    Path out;
    for (int k = 0; k < 12; ++k) {
      const float a = std::numbers::pi_v<float> * static_cast<float>(k) / 6;
      const float x = std::cos(a), y = std::sin(a);
      out.push_back(at(grow * width * x, 69 + grow * (y < 0 ? up : down) * y + corner * x * x, 2));
    }
    return out;
  }
  Path ear(float side) const {
    const float x = side * 97, depth = -8;
    const auto place = [&](float du, float v) {
      return Vec2{kCenter.x + (x + du * side) * std::cos(turn_) + depth * std::sin(turn_) +
                      du * 0.9f * std::sin(turn_) * side,
                  kCenter.y + v};
    };
    return {place(-8, -22), place(4, -32), place(11, -22),
            place(10, 0),   place(5, 20),  place(-6, 22)};
  }
  // The hair's edge over the forehead, from left to right.
  Path fringe() const {
    Path out;
    const float edge[7][2] = {{-92, 2},  {-84, -42}, {-58, -78}, {-18, -86},
                              {22, -70}, {62, -74},  {90, -18}};
    for (const auto& p : edge) out.push_back(at(p[0], p[1], 5));
    return out;
  }
  Path hair_top() const {
    Path out;
    for (int k = 0; k <= 8; ++k) {
      const float a = std::numbers::pi_v<float> * (1.03f + 0.94f * static_cast<float>(k) / 8);
      out.push_back(rim(a, 1.13f));
    }
    return out;
  }
  // The hair's outline behind the face.
  Path hair_back() const {
    Path out = outline(1.13f, kKnots);
    for (std::size_t k = 0; k < out.size(); ++k) {
      const float low =
          std::sin(2 * std::numbers::pi_v<float> * static_cast<float>(k) / kKnots) - 0.3f;
      out[k].y -= 40 * std::max(0.0f, low);
    }
    return out;
  }
  // Of strand k = 1..6: from the crown to the fringe.
  Path strand(std::size_t k) const {
    const Vec2 a = hair_top()[k + 1], b = fringe()[k];
    return {{a.x, a.y + 8}, {0.5f * (a.x + b.x) - 10, 0.5f * (a.y + b.y) - 4}, b};
  }
  Path neck() const {
    const float s = 8 * std::sin(turn_);
    return {{kCenter.x - 40 - s, 270},
            {kCenter.x + 38 - s, 270},
            {kCenter.x + 44, 352},
            {kCenter.x - 46, 352}};
  }
  float anger() const { return anger_; }
  float turn() const { return turn_; }

 private:
  float turn_, anger_;
};

void append(Path& to, const Path& more) { to.insert(to.end(), more.begin(), more.end()); }

Path control_points(const Head& head) {
  Path out = head.outline(1.0f, kKnots);
  append(out, head.hair_back());
  append(out, head.outline(1.24f, kKnots));
  for (const float side : {-1.0f, 1.0f}) {
    append(out, head.eye(side));
    out.push_back(head.pupil(side));
    append(out, head.brow(side));
  }
  append(out, head.nose());
  append(out, head.mouth());
  append(out, head.fringe());
  append(out, head.ear(-1));
  const Path neck = head.neck();
  for (const auto& [top, low] : {std::pair{neck[0], neck[3]}, {neck[1], neck[2]}})
    out.push_back({top.x + 0.55f * (low.x - top.x), top.y + 0.55f * (low.y - top.y)});
  out.push_back(head.at(-62, 38)), out.push_back(head.at(62, 38));
  append(out, {{60, 356}, {260, 356}, {kCenter.x - 50, 330}, {kCenter.x + 48, 330}});
  return out;
}

void draw_ear(Canvas& canvas, const Path& knots) {
  const Path shape = smooth(knots);
  canvas.fill(shape, flat(kSkin));
  Path inner;
  Vec2 middle{};
  for (const Vec2 p : knots) middle = {middle.x + p.x / 6, middle.y + p.y / 6};
  for (const Vec2 p : knots)
    inner.push_back({middle.x + 0.5f * (p.x - middle.x), middle.y + 0.55f * (p.y - middle.y)});
  canvas.fill(smooth(inner), flat(kSkinDark, 0.7f));
  canvas.outline(shape, kLine, 3);
}

void draw_eye(Canvas& canvas, const Head& head, float side) {
  const Path shape = smooth(head.eye(side));
  Canvas* on = &canvas;
  on->fill(smooth(head.eye(side, 1.25f)), flat(kSkinDark, 0.35f));
  on->fill(shape, fade(0xdfe6ee, 0xffffff, head.eye(side)[6], head.eye(side)[2]));
  const Vec2 pupil = head.pupil(side);
  const float squeeze =
      std::max(0.45f, std::cos(head.turn() + std::asin(side * 0.41f) * 0.8f - 0.15f * side));
  const float iris = head.mix(10.5f, 9), high = std::min(iris, head.mix(12, 9));
  on->fill(ellipse(pupil, iris * squeeze, high),
           fade(0x2f6f8f, 0x59a7bd, {pupil.x, pupil.y - 9}, {pupil.x, pupil.y + 9}));
  on->fill(ellipse(pupil, 5 * squeeze, 5.5f), flat(0x1d1c24));
  on->fill(ellipse({pupil.x - 3 * squeeze, pupil.y - 4}, 2.6f, 2.8f), flat(0xffffff, 0.95f));
  const Path lid = head.eye(side);
  on->fill(stroke(smooth_line({lid[4], lid[5], lid[6], lid[7], lid[0]}), 4.5f), flat(kLine));
  on->fill(stroke(smooth_line({lid[0], lid[1], lid[2], lid[3], lid[4]}), 2), flat(kLine, 0.7f));
}

void draw_mouth(Canvas& canvas, const Head& head) {
  const Path lips = smooth(head.mouth(1.0f));
  canvas.fill(lips, flat(0x6e2430));
  const Path inner = head.mouth(0.86f);
  const float low = inner[3].y, high = inner[9].y, x = inner[3].x;
  // Gritted teeth in anger, a tongue in astonishment.
  Path teeth = {inner[0], inner[1], inner[2], inner[3], inner[4],  inner[5],
                inner[6], inner[7], inner[8], inner[9], inner[10], inner[11]};
  canvas.fill(smooth(teeth), flat(0xfff6ea, std::clamp(1.6f * head.anger() - 0.3f, 0.0f, 1.0f)));
  const float grit = std::clamp(1.6f * head.anger() - 0.5f, 0.0f, 1.0f);
  canvas.fill(
      stroke({inner[6], {0.5f * (inner[0].x + inner[6].x), 0.5f * (low + high)}, inner[0]}, 1.6f),
      flat(kLine, 0.6f * grit));
  canvas.fill(ellipse({x, low - 7}, 0.32f * std::abs(inner[0].x - inner[6].x), 8),
              flat(0xd9606a, std::clamp(1 - 1.8f * head.anger(), 0.0f, 1.0f)));
  canvas.outline(lips, 0x7c2f35, 3.5f);
}

void draw_hair_front(Canvas& canvas, const Head& head) {
  Path hair = smooth_line(head.hair_top());
  const Path fringe = smooth_line(head.fringe());
  hair.insert(hair.end(), fringe.rbegin(), fringe.rend());
  const Vec2 top = head.rim(-std::numbers::pi_v<float> / 2, 1.13f);
  canvas.fill(hair, fade(kHairLight, kHair, top, {top.x, top.y + 120}));
  for (std::size_t k = 1; k < 7; ++k) {
    canvas.shade(stroke(smooth_line(head.strand(k)), 3, 1),
                 flat(k % 2 ? kHairDark : kHairLight, 0.5f));
  }
  canvas.fill(stroke(fringe, 3), flat(kHairDark));
  canvas.fill(stroke(smooth_line(head.hair_top()), 3.5f), flat(kHairDark));
}

Image paint_face(const Head& head) {
  Canvas canvas(320, 360);
  // Back of the hair, neck and shoulders.
  const Path back = head.hair_back();
  canvas.fill(smooth(back), fade(kHair, kHairDark, {160, 60}, {160, 300}));
  canvas.outline(smooth(back), kHairDark, 3.5f);
  const Path neck = head.neck();
  canvas.fill(neck, fade(0xc9835f, kSkinDark, {160, 285}, {160, 340}));
  canvas.fill(
      smooth({{62, 352}, {88, 333}, {122, 322}, {160, 342}, {198, 322}, {234, 333}, {258, 352}}),
      fade(0x3f7c86, 0x2f5f70, {160, 320}, {160, 356}));
  // The face.
  const Path face = smooth(head.outline(1.0f, kKnots));
  canvas.fill(face, fade(0xffdcb8, kSkin, {160, 90}, {160, 300}));
  canvas.shade(face, {.from = kSkinDark,
                      .to = kSkinDark,
                      .start = {kCenter.x + 14 + 40 * std::sin(head.turn()), 175},
                      .radius = 165,
                      .alpha = 0,
                      .alpha_end = 0.75f});
  canvas.outline(face, kLine, 3.5f);
  draw_ear(canvas, head.ear(-1));  // hair covers the other one
  for (const float side : {-1.0f, 1.0f}) {
    const Vec2 cheek = head.at(side * 54, 34);
    canvas.shade(face, glow(0xe8705a, cheek, 30, 0.38f + 0.2f * head.anger()));
    draw_eye(canvas, head, side);
    canvas.fill(stroke(smooth_line(head.brow(side)), 10, 5), flat(kHairDark));
  }
  const Path nose = head.nose();
  canvas.shade(smooth(nose), flat(kSkinDark, 0.35f));
  canvas.fill(stroke(smooth_line({nose[6], nose[5], nose[4], nose[3], nose[2]}), 2.5f),
              flat(kLine, 0.8f));
  canvas.fill(ellipse({nose[3].x + 3, nose[3].y - 10}, 5, 4), flat(0xffffff, 0.4f));
  const float frown = std::clamp(2 * head.anger() - 0.8f, 0.0f, 1.0f);
  for (const float side : {-1.0f, 1.0f})
    canvas.fill(stroke(smooth_line({head.at(side * 5, -50, 3), head.at(side * 4, -40, 3),
                                    head.at(side * 6, -30, 3)}),
                       2.5f),
                flat(kLine, 0.7f * frown));
  draw_mouth(canvas, head);
  draw_hair_front(canvas, head);
  return canvas.picture();
}

}  // namespace

View draw_face(double rotation, double expression) {
  const Head head(rotation, expression);
  View view;
  view.at = {rotation, expression};
  view.picture = paint_face(head);
  view.points = control_points(head);
  return view;
}

ViewSet face_views() {
  ViewSet set;
  set.name = "face";
  set.parameters = {{"rotation", 0, 36, 0}, {"expression", 0, 1, 0}};
  const double corners[5][2] = {{0, 0}, {36, 0}, {18, 0.5}, {0, 1}, {36, 1}};
  for (const auto& at : corners) {
    set.views.push_back(draw_face(at[0], at[1]));
    set.views.back().name = "face_" + std::to_string(set.views.size()) + ".png";
  }
  return set;
}

}  // namespace vsprite::puppet_art
