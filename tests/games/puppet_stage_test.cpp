// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "puppet/art.h"
#include "stage.h"

namespace vsprite::puppet {
namespace {

const std::vector<Puppet>& puppets() {
  static const std::vector<Puppet> all = [] {
    std::vector<Puppet> out;
    for (const ViewSet& set : {puppet_art::face_views(), puppet_art::walk_views(),
                               puppet_art::jump_views(), puppet_art::arm_views()}) {
      auto fitted = fit_puppets(set);
      for (Puppet& p : *fitted) out.push_back(std::move(p));
    }
    return out;
  }();
  return all;
}

Stage stage_of(Scene scene) {
  Stage stage(*find_cast(puppets(), "x.vsp"));
  stage.scene = scene;
  return stage;
}

void run(Stage& stage, int ticks, const Held& keys) {
  for (int k = 0; k < ticks; ++k) stage.step(keys);
}

Vec2 low(const Character& c) {
  Vec2 lowest{0, -1e9f};
  for (const Vec2 p : c.pose.points)
    if (c.at.y + c.scale * p.y > lowest.y)
      lowest = {c.at.x + c.scale * p.x, c.at.y + c.scale * p.y};
  return lowest;
}

TEST(PuppetStage, NamesThePuppetThatIsNotThere) {
  const std::vector<Puppet> some(puppets().begin(), puppets().begin() + 3);
  const auto cast = find_cast(some, "x.vsp");
  ASSERT_FALSE(cast);
  EXPECT_NE(cast.error().message.find("x.vsp: no puppet `jump`"), std::string::npos);
}

TEST(PuppetStage, ArrowsTurnTheFaceAndItsMoodAndStopAtTheDrawings) {
  Stage stage = stage_of(Scene::Face);
  run(stage, 200, {1, 1, std::nullopt});
  EXPECT_EQ(stage.face(), (Vec2{1, 1}));
  run(stage, 200, {-1, 0, std::nullopt});
  EXPECT_EQ(stage.face(), (Vec2{0, 1}));
  EXPECT_EQ(stage.characters(Scene::Face)[0].pose.outside, 0);
}

TEST(PuppetStage, BothWalkOnTheGroundTheSameWay) {
  Stage stage = stage_of(Scene::Walk);
  const auto& who = stage.characters(Scene::Walk);
  ASSERT_EQ(who.size(), 2u);
  const float before = stage.walked();
  for (int k = 0; k < 120; ++k) {
    stage.step({1, 0, std::nullopt});
    for (const Character& c : who) EXPECT_NEAR(low(c).y, kGround + kSole, 0.1f);
  }
  EXPECT_GT(stage.walked() - before, 200);
  run(stage, 120, {0, 1, std::nullopt});
  const float stopped = stage.walked();
  run(stage, 10, {0, 1, std::nullopt});
  EXPECT_EQ(stage.walked(), stopped);
}

TEST(PuppetStage, AJumpLeavesTheGroundAndComesBackWithoutALeap) {
  Stage stage = stage_of(Scene::Jump);
  const Character& john = stage.characters(Scene::Jump)[0];
  run(stage, 60, {});
  const Vec2 start = low(john);
  EXPECT_NEAR(start.y, kGround + kSole, 0.1f);
  float highest = start.y, most = 0;
  for (int k = 0; k < 150; ++k) {
    const Vec2 before = john.at;
    stage.step({0, k == 0 ? -1.0f : 0.0f, std::nullopt});
    highest = std::min(highest, low(john).y);
    most = std::max(most, std::hypot(john.at.x - before.x, john.at.y - before.y));
  }
  EXPECT_LT(highest, start.y - 80);
  EXPECT_LT(most, 24);
  EXPECT_NEAR(low(john).y, start.y, 3);
  EXPECT_GT(low(john).x, start.x + 30);
}

TEST(PuppetStage, TheHandGoesToThePointAndTheShoulderStays) {
  Stage stage = stage_of(Scene::Arm);
  const Character& arm = stage.characters(Scene::Arm)[0];
  for (const Vec2 target : {Vec2{760, 420}, Vec2{700, 200}, Vec2{820, 560}}) {
    run(stage, 120, {0, 0, target});
    EXPECT_NEAR(stage.hand().x, target.x, 12) << target.x << ", " << target.y;
    EXPECT_NEAR(stage.hand().y, target.y, 12) << target.x << ", " << target.y;
    EXPECT_NEAR(arm.at.x + arm.scale * arm.pose.points[18].x, kShoulder.x, 0.01f);
    EXPECT_NEAR(arm.at.y + arm.scale * arm.pose.points[18].y, kShoulder.y, 0.01f);
  }
  run(stage, 120, {0, 0, Vec2{1270, 380}});  // out of reach: it points there
  EXPECT_NEAR(stage.hand().y, kShoulder.y, 14);
}

// Behind the back, where no drawn pose gets: the hand is as near as any pose would bring it.
TEST(PuppetStage, TheHandComesAsNearAsTheDrawingsLetIt) {
  Stage stage = stage_of(Scene::Arm);
  for (const Vec2 target : {Vec2{500, 620}, Vec2{640, 390}, Vec2{60, 700}, Vec2{540, 30}}) {
    float nearest = 1e9f;
    for (int k = 0; k < 64; ++k) {  // poses on the way to points all around
      const float angle = 0.0982f * static_cast<float>(k), r = k % 2 ? 150.0f : 400.0f;
      run(stage, 120,
          {0, 0, Vec2{kShoulder.x + r * std::cos(angle), kShoulder.y + r * std::sin(angle)}});
      nearest = std::min(nearest, std::hypot(stage.hand().x - target.x, stage.hand().y - target.y));
    }
    run(stage, 120, {0, 0, target});
    EXPECT_LT(std::hypot(stage.hand().x - target.x, stage.hand().y - target.y), nearest + 12)
        << target.x << ", " << target.y;
  }
}

}  // namespace
}  // namespace vsprite::puppet
