// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "stage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsprite::puppet {
namespace {

constexpr auto kTick = static_cast<float>(1 / kTicksPerSecond);
constexpr double kTau = 2 * std::numbers::pi;
// Control points of the arm's drawings: shoulder and elbow, elbow and wrist; the fist's middle lies
// beyond the wrist.
constexpr std::size_t kUpperJoint = 18, kUpperEnd = 19, kForeJoint = 38, kForeEnd = 39;
constexpr double kFist = 22;
constexpr double kShoulderRange[2] = {-2.6, 1.4}, kElbowRange[2] = {-2.3, 0};
constexpr float kAcross = 1400;  // px until somebody comes back on the other side

float approach(float value, float goal, float most) {
  return value + std::clamp(goal - value, -most, most);
}

void pose_walk(const Puppet& puppet, double phase, PuppetPose& pose) {
  pose_puppet(puppet, std::array{std::cos(kTau * phase), std::sin(kTau * phase)}, pose);
}

double distance(Vec2 a, Vec2 b) { return std::hypot(double{a.x} - b.x, double{a.y} - b.y); }

float lowest(const PuppetPose& pose) {
  float y = -1e9f;
  for (const Vec2 p : pose.points) y = std::max(y, p.y);
  return y;
}

// Where its lowest point comes to lie.
float standing_y(const Character& c, float height) {
  return kGround + kSole - c.scale * (lowest(c.pose) + height);
}

// The turn of `angle` that is nearest to the middle of a range, within it.
double within(double angle, const double (&range)[2]) {
  const double middle = (range[0] + range[1]) / 2;
  angle -= kTau * std::floor((angle - middle) / kTau + 0.5);
  return std::clamp(angle, range[0], range[1]);
}

// Angles within the examples' ranges for a hand as near to `target` as may be: with the shoulder as
// it ought to be, or at either end of its range, the elbow turns the forearm to the target.
ArmReach nearest_reach(Vec2 target, double upper, double fore) {
  const ArmReach free = reach_for(kShoulder, target, upper, fore, -1);
  ArmReach best;
  double least = HUGE_VAL;
  for (const double shoulder :
       {within(free.shoulder, kShoulderRange), kShoulderRange[0], kShoulderRange[1]}) {
    const double x = kShoulder.x + upper * std::cos(shoulder),
                 y = kShoulder.y + upper * std::sin(shoulder);
    const double elbow = within(std::atan2(target.y - y, target.x - x) - shoulder, kElbowRange);
    const double off = std::hypot(x + fore * std::cos(shoulder + elbow) - target.x,
                                  y + fore * std::sin(shoulder + elbow) - target.y);
    if (off < least - 1e-6) least = off, best = {shoulder, elbow};
  }
  return best;
}

// px that the ground goes back under the foot that stands on it, in one cycle.
float measure_stride(const Puppet& puppet) {
  constexpr int kSteps = 60;
  PuppetPose before = make_pose(puppet), now = make_pose(puppet);
  double gone = 0;
  for (int k = 0; k < kSteps; ++k) {
    pose_walk(puppet, static_cast<double>(k) / kSteps, before);
    pose_walk(puppet, static_cast<double>(k + 1) / kSteps, now);
    const auto foot =
        static_cast<std::size_t>(std::max_element(before.points.begin(), before.points.end(),
                                                  [](Vec2 a, Vec2 b) { return a.y < b.y; }) -
                                 before.points.begin());
    gone += double{before.points[foot].x} + before.center.x - now.points[foot].x - now.center.x;
  }
  return static_cast<float>(std::abs(gone));
}

}  // namespace

Result<Cast> find_cast(const std::vector<Puppet>& puppets, const std::string& pack) {
  Cast cast;
  const auto find = [&](const char* name, const Puppet*& out, std::size_t parameters) {
    for (const Puppet& p : puppets)
      if (p.name == name && p.parameters.size() == parameters) out = &p;
    return out != nullptr;
  };
  const char* missing = !find("face", cast.face, 2)     ? "face"
                        : !find("john", cast.john, 2)   ? "john"
                        : !find("jayne", cast.jayne, 2) ? "jayne"
                        : !find("jump", cast.jump, 1)   ? "jump"
                        : !find("arm", cast.arm, 2)     ? "arm"
                                                        : nullptr;
  if (missing == nullptr && cast.arm->point_count() <= kForeEnd) missing = "arm";
  if (missing == nullptr) return cast;
  return Error{ErrorCode::BadContent,
               pack + ": no puppet `" + missing +
                   "` is in it, due are the drawings of this game: draw_puppets PACK.vsp makes it"};
}

Held held(Direction direction) noexcept {
  constexpr int kX[8] = {1, 1, 0, -1, -1, -1, 0, 1}, kY[8] = {0, 1, 1, 1, 0, -1, -1, -1};
  const auto k = static_cast<std::size_t>(direction);
  if (k >= 8) return {};
  return {static_cast<float>(kX[k]), static_cast<float>(kY[k]), std::nullopt};
}

Stage::Stage(const Cast& cast) : cast_(cast) {
  all(Scene::Face) = {{cast.face, make_pose(*cast.face), {}, 1.5f}};
  all(Scene::Walk) = {{cast.john, make_pose(*cast.john), {}, 1.25f},
                      {cast.jayne, make_pose(*cast.jayne), {}, 1.25f}};
  all(Scene::Jump) = {{cast.jump, make_pose(*cast.jump), {}, 1.25f}};
  all(Scene::Arm) = {{cast.arm, make_pose(*cast.arm), {}, 1.5f}};
  target_pose_ = make_pose(*cast.jump);
  stride_ = measure_stride(*cast.john) * 1.25f;
  PuppetPose arm = make_pose(*cast.arm);
  pose_puppet(*cast.arm, std::array{0.0, -1.0}, arm);
  upper_ = 1.5 * distance(arm.points[kUpperJoint], arm.points[kUpperEnd]);
  fore_ = 1.5 * (distance(arm.points[kForeJoint], arm.points[kForeEnd]) + kFist);
  pose_puppet(*cast.jump, std::array{0.0}, target_pose_);
  ground_y_ = lowest(target_pose_) + target_pose_.center.y;
  pose_puppet(*cast.jump, std::array{0.2}, all(Scene::Jump)[0].pose);
  for (const Scene each : {Scene::Jump, Scene::Walk, Scene::Arm, Scene::Face})
    scene = each, step({});
}

void Stage::step(const Held& keys) noexcept {
  if (scene == Scene::Face) step_face(keys);
  if (scene == Scene::Walk) step_walk(keys);
  if (scene == Scene::Jump) step_jump(keys);
  if (scene == Scene::Arm) step_arm(keys);
}

void Stage::step_face(const Held& keys) noexcept {
  turn_ = approach(turn_, 1.1f * keys.x, 6 * kTick);
  mood_ = approach(mood_, 1.1f * keys.y, 6 * kTick);
  rotation_ = std::clamp(rotation_ + turn_ * kTick, 0.0f, 1.0f);
  expression_ = std::clamp(expression_ + mood_ * kTick, 0.0f, 1.0f);
  Character& c = all(Scene::Face)[0];
  const auto& p = cast_.face->parameters;
  pose_puppet(*c.puppet,
              std::array{p[0].low + double{rotation_} * (p[0].high - p[0].low),
                         p[1].low + double{expression_} * (p[1].high - p[1].low)},
              c.pose);
  c.at = {400 + c.scale * c.pose.center.x, 60 + c.scale * c.pose.center.y};
}

void Stage::step_walk(const Held& keys) noexcept {
  const float goal = keys.x != 0 ? 0.95f * keys.x : keys.y != 0 ? 0 : 0.6f;
  pace_ = approach(pace_, goal, 1.5f * kTick);
  phase_ += pace_ * kTick;
  walked_ += pace_ * kTick * stride_;
  phase_ -= std::floor(phase_);
  float x = 420;
  for (Character& c : all(Scene::Walk)) {
    pose_walk(*c.puppet, double{phase_}, c.pose);
    c.at = {x, standing_y(c, 0)};
    x += 400;
  }
}

void Stage::step_jump(const Held& keys) noexcept {
  Character& c = all(Scene::Jump)[0];
  constexpr float kCrouch = 0.22f, kAir = 0.95f, kRest = 0.2f;
  if (flight_ < 0 && keys.y < 0) flight_ = 0;
  if (flight_ >= 0) {
    flight_ += kTick;
    time_ = flight_ < kCrouch ? kRest * (1 - flight_ / kCrouch)
                              : std::min(1.0f, (flight_ - kCrouch) / kAir);
  } else {
    time_ = approach(time_, keys.y > 0 ? 0 : kRest, 1.2f * kTick);
  }
  pose_puppet(*c.puppet, std::array{double{time_}}, target_pose_);
  const float landed_at = target_pose_.center.x;
  if (flight_ > kCrouch + kAir + 0.15f) {
    // Where he has come down he stands up again.
    flight_ = -1, time_ = kRest;
    pose_puppet(*c.puppet, std::array{double{time_}}, target_pose_);
    ground_x_ += c.scale * (landed_at - target_pose_.center.x);
    if (ground_x_ > kAcross - 100) ground_x_ -= kAcross;
  }
  // The body follows: no pose comes from one tick to the next.
  constexpr float kFollow = 0.3f;
  for (std::size_t i = 0; i < c.pose.points.size(); ++i) {
    Vec2& p = c.pose.points[i];
    const Vec2 q = target_pose_.points[i];
    p = {p.x + kFollow * (q.x - p.x), p.y + kFollow * (q.y - p.y)};
  }
  c.pose.center = target_pose_.center;
  const bool is_up = flight_ > kCrouch && flight_ < kCrouch + kAir;
  const float height =
      is_up ? std::max(0.0f, ground_y_ - lowest(target_pose_) - target_pose_.center.y) : 0;
  c.at = {ground_x_ + c.scale * (c.pose.center.x - 90), standing_y(c, height)};
}

void Stage::step_arm(const Held& keys) noexcept {
  if (keys.pointer) target_ = *keys.pointer;
  target_ = {std::clamp(target_.x + 420 * keys.x * kTick, 0.0f, kStage.x),
             std::clamp(target_.y + 420 * keys.y * kTick, 0.0f, kStage.y)};
  // Appendix A: the shoulder stays, the hand goes to the point; beyond reach it points there.
  // Where no pose that was drawn gets there, the one whose hand comes nearest is taken.
  const ArmReach reach = nearest_reach(target_, upper_, fore_);
  constexpr double kFollow = 0.18;
  shoulder_ += kFollow * (reach.shoulder - shoulder_);
  elbow_ += kFollow * (reach.elbow - elbow_);
  Character& c = all(Scene::Arm)[0];
  pose_puppet(*c.puppet, std::array{shoulder_, elbow_}, c.pose);
  const Vec2 joint = c.pose.points[kUpperJoint];
  c.at = {kShoulder.x - c.scale * joint.x, kShoulder.y - c.scale * joint.y};
}

Vec2 Stage::hand() const noexcept {
  const Character& c = characters(Scene::Arm)[0];
  const Vec2 elbow = c.pose.points[kForeJoint], wrist = c.pose.points[kForeEnd];
  const auto more = static_cast<float>(kFist / std::max(1.0, distance(elbow, wrist)));
  return {c.at.x + c.scale * (wrist.x + more * (wrist.x - elbow.x)),
          c.at.y + c.scale * (wrist.y + more * (wrist.y - elbow.y))};
}

}  // namespace vsprite::puppet
