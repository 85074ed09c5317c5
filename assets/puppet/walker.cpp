// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Two walkers of soft strips (arms, legs) and quads (trunk, head), seen from the side. A strip's
// control points lie in pairs along its bone, so that a knee bends without a crease. Each character
// is one picture of the parts laid apart; poses are outlines alone.
#include <cmath>
#include <numbers>

#include "puppet/art.h"
#include "puppet/brush.h"

namespace vsprite::puppet_art {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

struct Build {
  float torso, thigh, shin, upper, fore, neck, head, leg, arm, waist;  // lengths, then widths, px
};
constexpr Build kJohn{92, 58, 58, 44, 42, 12, 62, 27, 19, 56};
constexpr Build kJayne{80, 54, 52, 38, 37, 12, 64, 23, 15, 46};

// Angles in radians from straight down; positive swings forwards (to the right).
struct Joints {
  Vec2 hip;
  float lean = 0, nod = 0;
  float thigh[2]{}, knee[2]{}, foot[2]{}, upper[2]{}, elbow[2]{};  // near, far
};

Vec2 along(Vec2 from, float angle, float length) {
  return {from.x + length * std::sin(angle), from.y + length * std::cos(angle)};
}

constexpr float kShoeApart = 32;  // px below its leg, on the picture

void pair_at(Path& out, Vec2 at, float angle, float width) {  // across the bone
  const Vec2 side{std::cos(angle) * width / 2, -std::sin(angle) * width / 2};
  out.push_back({at.x - side.x, at.y - side.y});
  out.push_back({at.x + side.x, at.y + side.y});
}

// Sections of a bone of two parts, with a margin at both ends; 2 x 7 points.
void strip(Path& out, Vec2 from, float a, float b, float first, float second, float width,
           float tail) {
  const float w = width * 1.5f;
  pair_at(out, along(from, a, -width * 0.7f), a, w);
  pair_at(out, along(from, a, first * 0.45f), a, w);
  pair_at(out, along(from, a, first * 0.82f), a * 0.8f + b * 0.2f, w);
  const Vec2 joint = along(from, a, first);
  pair_at(out, along(joint, b, second * 0.18f), a * 0.2f + b * 0.8f, w);
  pair_at(out, along(joint, b, second * 0.6f), b, w);
  pair_at(out, along(joint, b, second), b, w);
  pair_at(out, along(joint, b, second + tail), b, w);
}

struct Part {
  int first, count, depth;
};
// Far arm, far leg, near leg, trunk, head, near arm; then feet go with their legs.
constexpr int kStrip = 14, kFoot = 4, kTrunk = 8, kHead = 8;

// Where the parts lie: posed, or laid apart.
Path place(const Build& b, const Joints& j, const Vec2* apart) {
  Path out;
  const Vec2 neck = along(j.hip, j.lean + kPi, b.torso);
  const auto base = [&](int part, Vec2 posed) { return apart ? apart[part] : posed; };
  const auto leg = [&](int side, int part) {
    const float a = apart ? 0 : j.thigh[side], k = apart ? 0 : j.thigh[side] - j.knee[side];
    const Vec2 hip = base(part, j.hip);
    strip(out, hip, a, k, b.thigh, b.shin, b.leg, b.leg * 0.35f);
    Vec2 ankle = along(along(hip, a, b.thigh), k, b.shin);
    if (apart) ankle.y += kShoeApart;
    const float f = (apart ? 0 : j.foot[side]) + kPi / 2;  // along the sole, forwards
    for (const float l : {-15.0f, 33.0f}) pair_at(out, along({ankle.x, ankle.y + 3}, f, l), f, 34);
  };
  const auto arm = [&](int side, int part) {
    const float a = apart ? 0 : j.upper[side], e = apart ? 0 : j.upper[side] + j.elbow[side];
    const Vec2 shoulder = base(part, along(neck, j.lean, 12));
    strip(out, shoulder, a, e, b.upper, b.fore, b.arm, 22);
  };
  arm(1, 0), leg(1, 1), leg(0, 2);
  const Vec2 hip = base(3, j.hip);
  const float lean = apart ? 0 : j.lean;
  for (const float l : {-26.0f, b.torso * 0.3f, b.torso * 0.7f, b.torso + 12})
    pair_at(out, along(hip, lean + kPi, l), lean + kPi, b.waist * 1.7f);
  const Vec2 chin = base(4, neck);
  const float nod = (apart ? 0 : j.nod) + kPi;
  for (const float l : {-14.0f, b.head * 0.3f, b.head * 0.8f, b.head * 1.5f})
    pair_at(out, along(chin, nod, l), nod, b.head * 1.9f);
  arm(0, 5);
  return out;
}

void quads(std::vector<Face>& faces, int first, int count) {
  for (int k = 0; k + 3 < count; k += 2) {
    const auto p = static_cast<std::uint32_t>(first + k);
    faces.push_back({{p, p + 1, p + 3, p + 2}, 4});
  }
}

void add_mesh(ViewSet& set) {
  int first = 0;
  float depth = 0;
  for (const int count : {kStrip, kStrip, kFoot, kStrip, kFoot, kTrunk, kHead, kStrip}) {
    quads(set.faces, first, count);
    set.depth.insert(set.depth.end(), static_cast<std::size_t>(count), depth);
    first += count;
    depth += 1;
  }
}

// --- pictures

constexpr Vec2 kJohnApart[6] = {{40, 40}, {110, 40}, {190, 40}, {300, 150}, {420, 130}, {500, 40}};

struct Cloth {
  std::uint32_t skin, skin_dark, top, top_dark, leg, leg_dark, shoe, hair, hair_light, line;
};
constexpr Cloth kJohnCloth{0xf2c49a, 0xd9976c, 0x3f79b5, 0x2b5585, 0x4a4a5e,
                           0x34343f, 0x8a4a2c, 0x5d3a24, 0x7c5334, 0x33241f};
constexpr Cloth kJayneCloth{0xf7d0ae, 0xdf9f7c, 0xd9577c, 0xb23a60, 0xf7d0ae,
                            0xdf9f7c, 0x7a3f8c, 0xd9942f, 0xf2bf5a, 0x4a2530};

Path limb(Vec2 top, float w0, float w1, float w2, float first, float second) {
  return smooth({{top.x - w0 / 2, top.y},
                 {top.x - w1 / 2, top.y + first},
                 {top.x - w2 / 2, top.y + first + second},
                 {top.x, top.y + first + second + w2 * 0.45f},
                 {top.x + w2 / 2, top.y + first + second},
                 {top.x + w1 / 2, top.y + first},
                 {top.x + w0 / 2, top.y},
                 {top.x, top.y - w0 * 0.5f}});
}

void paint_limb(Canvas& c, const Path& shape, std::uint32_t from, std::uint32_t to,
                std::uint32_t line, Vec2 at, float w) {
  c.fill(shape, fade(from, to, {at.x + w / 2, at.y}, {at.x - w / 2, at.y}));
  c.outline(shape, line, 2.5f);
}

std::uint32_t dimmed(std::uint32_t rgb) {  // the far side lies in shade
  std::uint32_t out = 0;
  for (int s = 0; s <= 16; s += 8)
    out |= static_cast<std::uint32_t>(static_cast<float>(rgb >> s & 255u) * 0.74f) << s;
  return out;
}

void paint_leg(Canvas& c, Vec2 hip, const Build& b, const Cloth& k, bool bare, bool far) {
  const auto tone = [&](std::uint32_t rgb) { return far ? dimmed(rgb) : rgb; };
  const Vec2 end{hip.x, hip.y + b.thigh + b.shin}, ankle{end.x, end.y + kShoeApart};
  const float w = b.leg;
  const Path shoe = smooth({{ankle.x - 13, ankle.y - 4},
                            {ankle.x + 8, ankle.y - 7},
                            {ankle.x + 27, ankle.y + 3},
                            {ankle.x + 30, ankle.y + 12},
                            {ankle.x + 4, ankle.y + 14},
                            {ankle.x - 13, ankle.y + 12}});
  const Path shape = limb(hip, w, w * 0.86f, w * (bare ? 0.58f : 0.76f), b.thigh, b.shin);
  paint_limb(c, shape, tone(k.leg), tone(k.leg_dark), k.line, hip, w);
  if (bare)
    c.fill(stroke({{hip.x, end.y - 26}, {hip.x, end.y - 2}}, w * 0.72f),
           flat(tone(0xffffff), 0.85f));
  c.fill(shoe,
         fade(tone(k.shoe), tone(dimmed(k.shoe)), {ankle.x, ankle.y - 7}, {ankle.x, ankle.y + 14}));
  c.outline(shoe, k.line, 2.5f);
}

void paint_arm(Canvas& c, Vec2 at, const Build& b, const Cloth& k, bool far) {
  const auto tone = [&](std::uint32_t rgb) { return far ? dimmed(rgb) : rgb; };
  const float w = b.arm;
  const Vec2 hand{at.x, at.y + b.upper + b.fore + 7};
  const Path palm = smooth({{hand.x - 7, hand.y - 8},
                            {hand.x + 7, hand.y - 8},
                            {hand.x + 9, hand.y + 5},
                            {hand.x, hand.y + 12},
                            {hand.x - 8, hand.y + 4}});
  c.fill(palm, fade(tone(k.skin), tone(k.skin_dark), {hand.x + 8, hand.y}, {hand.x - 8, hand.y}));
  c.outline(palm, k.line, 2.2f);
  paint_limb(c, limb(at, w, w * 0.92f, w * 0.76f, b.upper, b.fore - 4), tone(k.top),
             tone(k.top_dark), k.line, at, w);
}

void paint_head(Canvas& c, Vec2 chin, const Build& b, const Cloth& k, bool long_hair) {
  const float r = b.head * 0.5f;
  const Vec2 m{chin.x + 3, chin.y - r * 1.12f};
  c.fill(stroke({{chin.x - 2, chin.y + 10}, {chin.x - 1, chin.y - 14}}, 17), flat(k.skin_dark));
  if (long_hair) {
    const Path back = smooth({{m.x - 4, m.y - r * 1.18f},
                              {m.x - r * 1.18f, m.y - r * 0.5f},
                              {m.x - r * 1.35f, m.y + r * 0.6f},
                              {m.x - r * 1.1f, m.y + r * 1.35f},
                              {m.x - r * 0.45f, m.y + r * 1.05f},
                              {m.x - 2, m.y}});
    c.fill(back, fade(k.hair_light, k.hair, {m.x, m.y - r}, {m.x - r, m.y + r}));
    c.outline(back, k.line, 2.5f);
  }
  const Path face = smooth({{m.x - r * 0.95f, m.y - r * 0.1f},
                            {m.x - r * 0.5f, m.y - r},
                            {m.x + r * 0.4f, m.y - r},
                            {m.x + r * 0.92f, m.y - r * 0.35f},
                            {m.x + r * 0.95f, m.y + r * 0.02f},
                            {m.x + r * 1.14f, m.y + r * 0.24f},
                            {m.x + r * 0.93f, m.y + r * 0.36f},
                            {m.x + r * 0.86f, m.y + r * 0.72f},
                            {m.x + r * 0.4f, m.y + r * 1.02f},
                            {m.x - r * 0.35f, m.y + r * 0.85f}});
  c.fill(face, fade(k.skin, k.skin_dark, {m.x + r * 0.3f, m.y}, {m.x - r * 1.3f, m.y + r}));
  c.shade(face, glow(0xe86a58, {m.x + r * 0.45f, m.y + r * 0.42f}, r * 0.36f, 0.45f));
  c.outline(face, k.line, 2.5f);
  c.fill(ellipse({m.x + r * 0.56f, m.y - r * 0.06f}, r * 0.1f, r * 0.17f), flat(0x2b2222));
  c.fill(ellipse({m.x + r * 0.59f, m.y - r * 0.12f}, r * 0.035f, r * 0.05f), flat(0xffffff));
  c.fill(stroke(smooth_line({{m.x + r * 0.4f, m.y - r * 0.32f},
                             {m.x + r * 0.58f, m.y - r * 0.38f},
                             {m.x + r * 0.76f, m.y - r * 0.3f}}),
                3.2f),
         flat(k.hair));
  c.fill(stroke(smooth_line({{m.x + r * 0.5f, m.y + r * 0.58f},
                             {m.x + r * 0.66f, m.y + r * 0.64f},
                             {m.x + r * 0.82f, m.y + r * 0.54f}}),
                2.4f),
         flat(0x9c3f3f));
  const Path ear = ellipse({m.x - r * 0.22f, m.y + r * 0.14f}, r * 0.16f, r * 0.24f, -0.15f);
  const Path cap = long_hair ? smooth({{m.x + r * 0.86f, m.y - r * 0.55f},
                                       {m.x + r * 0.5f, m.y - r * 1.16f},
                                       {m.x - r * 0.4f, m.y - r * 1.2f},
                                       {m.x - r * 1.14f, m.y - r * 0.4f},
                                       {m.x - r * 1.02f, m.y + r * 0.5f},
                                       {m.x - r * 0.4f, m.y + r * 0.1f},
                                       {m.x + r * 0.1f, m.y - r * 0.5f}})
                             : smooth({{m.x + r * 0.94f, m.y - r * 0.5f},
                                       {m.x + r * 0.72f, m.y - r * 1.06f},
                                       {m.x - r * 0.2f, m.y - r * 1.22f},
                                       {m.x - r * 1.06f, m.y - r * 0.5f},
                                       {m.x - r * 0.9f, m.y + r * 0.42f},
                                       {m.x - r * 0.42f, m.y + r * 0.2f},
                                       {m.x - r * 0.2f, m.y - r * 0.42f},
                                       {m.x + r * 0.4f, m.y - r * 0.58f}});
  if (!long_hair)
    c.fill(ear, fade(k.skin, k.skin_dark, {m.x, m.y}, {m.x - r * 0.4f, m.y})),
        c.outline(ear, k.line, 2);
  c.fill(cap, fade(k.hair_light, k.hair, {m.x + r * 0.4f, m.y - r * 1.2f}, {m.x - r * 0.8f, m.y}));
  c.outline(cap, k.line, 2.5f);
}

void paint_trunk(Canvas& c, Vec2 hip, const Build& b, const Cloth& k, bool skirt) {
  const float w = b.waist, t = b.torso;
  const Path shape = smooth({{hip.x - w * 0.42f, hip.y + 14},
                             {hip.x - w * 0.4f, hip.y - t * 0.4f},
                             {hip.x - w * 0.42f, hip.y - t * 0.86f},
                             {hip.x, hip.y - t - 2},
                             {hip.x + w * 0.42f, hip.y - t * 0.84f},
                             {hip.x + w * 0.46f, hip.y - t * 0.45f},
                             {hip.x + w * 0.4f, hip.y + 14},
                             {hip.x, hip.y + 18}});
  c.fill(shape, fade(k.top, k.top_dark, {hip.x + w * 0.4f, hip.y - t}, {hip.x - w * 0.5f, hip.y}));
  c.outline(shape, k.line, 2.5f);
  if (skirt) {
    const Path cloth = smooth({{hip.x - w * 0.4f, hip.y - 14},
                               {hip.x + w * 0.4f, hip.y - 14},
                               {hip.x + w * 0.68f, hip.y + 20},
                               {hip.x, hip.y + 24},
                               {hip.x - w * 0.68f, hip.y + 20}});
    c.fill(cloth, fade(0x6b4fa0, 0x4d3678, {hip.x, hip.y - 14}, {hip.x - 20, hip.y + 24}));
    c.outline(cloth, k.line, 2.5f);
  } else {
    c.shade(stroke({{hip.x - w * 0.5f, hip.y + 8}, {hip.x + w * 0.5f, hip.y + 8}}, 12),
            flat(k.leg));
    c.fill(stroke({{hip.x - w * 0.4f, hip.y + 1}, {hip.x + w * 0.42f, hip.y + 1}}, 6),
           flat(0x5a3a22));
  }
  c.fill(stroke(smooth_line({{hip.x - 4, hip.y - t + 4},
                             {hip.x + 9, hip.y - t + 8},
                             {hip.x + 17, hip.y - t + 3}}),
                5),
         flat(0xffffff, 0.85f));
}

Image paint_parts(const Build& b, const Cloth& k, bool jayne) {
  Canvas c(560, 240);
  paint_arm(c, kJohnApart[0], b, k, true);
  paint_leg(c, kJohnApart[1], b, k, jayne, true);
  paint_leg(c, kJohnApart[2], b, k, jayne, false);
  paint_trunk(c, kJohnApart[3], b, k, jayne);
  paint_head(c, kJohnApart[4], b, k, jayne);
  paint_arm(c, kJohnApart[5], b, k, false);
  return c.picture();
}

// --- movement

Joints walking(const Build& b, double phase) {
  Joints j;
  const auto wave = [&](double shift) {
    return static_cast<float>(std::sin(2 * std::numbers::pi * (phase + shift)));
  };
  for (int side = 0; side < 2; ++side) {
    const double shift = side == 0 ? 0 : 0.5;
    j.thigh[side] = 0.44f * wave(shift) + 0.06f;
    const float swing = wave(shift + 0.22);  // bends most while the leg comes forwards
    j.knee[side] = 0.16f + 0.52f * (swing > 0 ? swing * swing : 0) +
                   0.10f * wave(shift + 0.5) * wave(shift + 0.5);
    j.foot[side] = 0.55f * (j.thigh[side] - j.knee[side]) + 0.14f;
    j.upper[side] = -0.5f * wave(shift) - 0.05f;
    j.elbow[side] = 0.42f + 0.22f * -wave(shift);
  }
  j.lean = -0.05f, j.nod = 0.02f * wave(0.1);
  j.hip = {150, 196 - 4 * static_cast<float>(std::cos(4 * std::numbers::pi * phase))};
  // Her hip is lower: feet stay on one ground.
  j.hip.y += (kJohn.thigh + kJohn.shin) - (b.thigh + b.shin);
  return j;
}

Joints jumping(double time) {
  const auto t = static_cast<float>(time);
  const auto bump = [&](float at, float width) {
    return std::exp(-(t - at) * (t - at) / (width * width));
  };
  Joints j;
  const float crouch = bump(0, 0.17f) + 0.85f * bump(1, 0.17f), air = bump(0.5f, 0.22f);
  for (int side = 0; side < 2; ++side) {
    j.thigh[side] = 0.95f * crouch + (side == 0 ? 0.75f : 0.25f) * air;
    j.knee[side] = 1.55f * crouch + (side == 0 ? 1.15f : 0.85f) * air + 0.06f;
    j.foot[side] = 0.2f * crouch - 0.7f * air;
    j.upper[side] = -0.9f * bump(0, 0.2f) + 2.3f * air + 0.5f * bump(1, 0.2f) +
                    0.05f * static_cast<float>(side);
    j.elbow[side] = 0.35f + 0.3f * air;
  }
  j.lean = -0.42f * crouch - 0.05f;
  j.nod = -0.1f * crouch + 0.08f * air;
  j.hip = {150 + 60 * (t - 0.5f),
           200 + 34 * crouch - 118 * 4 * t * (1 - t) * (0.25f + 0.75f * air)};
  return j;
}

View pose(const Build& b, const Joints& joints) {
  View view;
  view.points = place(b, joints, nullptr);
  return view;
}

void add_picture(View& view, const Build& b, const Cloth& k, bool jayne) {
  view.picture = paint_parts(b, k, jayne);
  view.texture_points = place(b, {}, kJohnApart);
}

}  // namespace

View draw_walk(double phase) {
  View view = pose(kJohn, walking(kJohn, phase));
  view.at = {std::cos(2 * std::numbers::pi * phase), std::sin(2 * std::numbers::pi * phase)};
  return view;
}

ViewSet walk_views() {
  ViewSet set;
  set.name = "john";
  set.parameters = {{"cosine", -1, 1, 0}, {"sine", -1, 1, 0}};
  set.allow_folds = true;
  add_mesh(set);
  for (int k = 0; k < 5; ++k) {
    set.views.push_back(draw_walk(k / 5.0));
    set.views.back().name = "view " + std::to_string(k + 1);
  }
  add_picture(set.views[0], kJohn, kJohnCloth, false);
  set.views[0].name = "john.png";
  Character jayne{
      .name = "jayne", .view = pose(kJayne, walking(kJayne, 0)), .like = 0, .modulate = false};
  add_picture(jayne.view, kJayne, kJayneCloth, true);
  jayne.view.name = "jayne.png";
  set.characters.push_back(std::move(jayne));
  return set;
}

View draw_jump(double time) {
  View view = pose(kJohn, jumping(time));
  view.at = {time};
  return view;
}

ViewSet jump_views() {
  ViewSet set;
  set.name = "jump";
  set.parameters = {{"time", 0, 1, 0}};
  set.allow_folds = true;
  add_mesh(set);
  for (const double t : {0.0, 0.2, 0.3, 0.5, 0.7, 0.8, 1.0}) {
    set.views.push_back(draw_jump(t));
    set.views.back().name = "view " + std::to_string(set.views.size());
  }
  add_picture(set.views[0], kJohn, kJohnCloth, false);
  set.views[0].name = "john.png";
  return set;
}

}  // namespace vsprite::puppet_art
