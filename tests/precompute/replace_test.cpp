// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/replace.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/tiny_sprite.h"

namespace vsprite {
namespace {

using Kind = SceneTerm::Kind;

SceneTerm location(Vec2 at, double weight, std::uint32_t from, std::uint32_t to) {
  return {.kind = Kind::Location, .weight = weight, .from = from, .to = to, .at = at};
}
// Wait at the centre, be gone from tick 60 on.
Scene falling(const Sprite& sprite) {
  return {.ticks = 120,
          .roles = {{.sprite = &sprite,
                     .start = {100, 100},
                     .terms = {location({100, 100}, 0.2, 0, 60),
                               location({180, 100}, 4, 60, UINT32_MAX)}}}};
}
Scene crossing(const Sprite& sprite) {
  const auto role = [&](Vec2 start, Vec2 goal, std::uint32_t other) {
    SceneTerm clear{.kind = Kind::KeepClear, .weight = 20, .other = other, .distance = 30};
    return SceneRole{
        .sprite = &sprite, .start = start, .terms = {location(goal, 1, 100, UINT32_MAX), clear}};
  };
  return {.ticks = 140, .roles = {role({0, 50}, {160, 50}, 1), role({160, 50}, {0, 50}, 0)}};
}
double apart(const SceneResult& r, std::size_t tick) {
  const Vec2 a = to_pixels(r.clips[0].ticks[tick].position);
  const Vec2 b = to_pixels(r.clips[1].ticks[tick].position);
  return std::hypot(a.x - b.x, a.y - b.y);
}

TEST(Replace, IsGoneBeforeItFalls) {
  const Sprite sprite = testing::tiny_sprite();
  const SceneResult r = replace_search(falling(sprite), {.proposals = 20000});
  ASSERT_EQ(r.clips[0].ticks.size(), 120u);
  EXPECT_GT(to_pixels(r.clips[0].ticks[60].position).x, 140);
  EXPECT_LT(to_pixels(r.clips[0].ticks[10].position).x, 140);
}

TEST(Replace, TheSameSeedAndCountGiveTheSameAndMoreIsNeverWorse) {
  const Sprite sprite = testing::tiny_sprite();
  const Scene scene = falling(sprite);
  const SceneResult a = replace_search(scene, {.seed = 5, .proposals = 2000});
  const SceneResult b = replace_search(scene, {.seed = 5, .proposals = 2000});
  EXPECT_EQ(a.cost, b.cost);
  for (std::size_t t = 0; t < scene.ticks; ++t)
    ASSERT_EQ(a.clips[0].ticks[t].sample, b.clips[0].ticks[t].sample);
  EXPECT_LE(replace_search(scene, {.seed = 5, .proposals = 8000}).cost, a.cost);
}

TEST(Replace, GoesOnFromAnEarlierResult) {
  const Sprite sprite = testing::tiny_sprite();
  const Scene scene = falling(sprite);
  const SceneResult a = replace_search(scene, {.seed = 5, .proposals = 3000});
  std::vector<std::uint32_t> samples;
  for (std::size_t t = 0; t < scene.ticks;) {
    samples.push_back(a.clips[0].ticks[t].sample);
    t += sprite.samples()[samples.back()].duration;
  }
  EXPECT_NEAR(replace_search(scene, {.proposals = 0, .start = {samples}}).cost, a.cost, 1e-9);
  EXPECT_LE(replace_search(scene, {.seed = 9, .proposals = 3000, .start = {samples}}).cost, a.cost);
}

TEST(Replace, StopsWhenAskedAndGivesTheBestSoFar) {
  const Sprite sprite = testing::tiny_sprite();
  double said = 0;
  const SceneResult r =
      replace_search(falling(sprite), {.go_on = [&](std::uint64_t k, double cost) {
                       said = cost;
                       return k < 1000;
                     }});
  EXPECT_EQ(r.proposals, 1000u);
  EXPECT_NEAR(r.cost, said, 1e-9);
}

TEST(Replace, EveryShownSampleIsASuccessorAndTheCostIsTheSumOfItsParts) {
  const Sprite sprite = testing::tiny_sprite();
  const SceneResult r = replace_search(falling(sprite), {.proposals = 5000});
  double sum = 0;
  const auto& ticks = r.clips[0].ticks;
  for (std::size_t t = 0; t < ticks.size(); ++t) {
    sum += ticks[t].cost;
    if (t > 0 && ticks[t].sample != ticks[t - 1].sample) {
      EXPECT_TRUE(std::isfinite(sprite.transition_cost(ticks[t - 1].sample, ticks[t].sample)));
    }
  }
  EXPECT_NEAR(sum, r.cost, 1e-6);
}

TEST(Replace, TwoCrossWithoutTouching) {
  const Sprite sprite = testing::tiny_sprite();
  const SceneResult r = replace_search(crossing(sprite), {.proposals = 40000});
  double least = 1e9;
  for (std::size_t t = 0; t < 140; ++t) least = std::min(least, apart(r, t));
  EXPECT_GT(least, 25);
  EXPECT_GT(to_pixels(r.clips[0].ticks.back().position).x, 120);
  EXPECT_LT(to_pixels(r.clips[1].ticks.back().position).x, 40);
}

// Each term alone, on the clip that the sprite plays by itself, by its definition.
TEST(Replace, TermsMeanWhatTheirDefinitionsSay) {
  const Sprite sprite = testing::tiny_sprite();
  const double body = std::max(1.0, double{sprite.data().body_length});
  const auto cost = [&](SceneTerm term) {
    term.to = 1;
    const Scene scene{.ticks = 1, .roles = {{.sprite = &sprite, .start = {7, 9}, .terms = {term}}}};
    return replace_search(scene, {.proposals = 0, .start = {{testing::tiny_sample(2, 0)}}}).cost;
  };
  EXPECT_NEAR(cost({.kind = Kind::Location, .weight = 3, .at = {7, 9.0f + 12}, .radius = 2}),
              3 * 100 / (body * body), 1e-6);
  EXPECT_NEAR(cost({.kind = Kind::Heading, .angle = 0}), 3.14159265 / 2, 1e-5);
  EXPECT_NEAR(cost({.kind = Kind::Speed, .speed = testing::kTinySpeed}), 0, 1e-9);
  EXPECT_NEAR(cost({.kind = Kind::Pose, .sample = testing::tiny_sample(2, 6)}), 6.0 / 30, 1e-9);
  EXPECT_NEAR(cost({.kind = Kind::Pose, .sample = testing::tiny_sample(3, 0)}), 1, 1e-9);
  EXPECT_NEAR(cost({.kind = Kind::Region, .low = {10, 0}, .high = {20, 20}}), 9 / (body * body),
              1e-6);
  EXPECT_NEAR(cost({.kind = Kind::Path, .points = {{7, 4}, {7, 100}}}), 0, 1e-6);
}

TEST(Replace, NamesTheTermThatIsWrong) {
  const Sprite sprite = testing::tiny_sprite();
  Scene scene = falling(sprite);
  EXPECT_TRUE(check_scene(scene));
  scene.roles[0].terms[1] = {.kind = Kind::Pose, .sample = 100000};
  const auto pose = check_scene(scene);
  ASSERT_FALSE(pose);
  EXPECT_NE(pose.error().message.find("sprite 1, term 2: sample 100000 is not in"),
            std::string::npos);
  scene.roles[0].terms[1] = {.kind = Kind::Meet, .other = 0};
  EXPECT_FALSE(check_scene(scene));
  scene.roles[0].terms[1] = location({std::numeric_limits<float>::quiet_NaN(), 0}, 1, 0, 9);
  EXPECT_FALSE(check_scene(scene));
  EXPECT_FALSE(check_scene({}));
}

}  // namespace
}  // namespace vsprite
