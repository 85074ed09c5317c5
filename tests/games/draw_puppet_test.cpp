// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Puppets on the GPU against render_puppet.
#include <gtest/gtest.h>

#include "puppet/art.h"
#include "support/gl_stage.h"
#include "support/tiny_puppet.h"
#include "vsprite/compose.h"
#include "vsprite/draw.h"
#include "vsprite/puppet.h"

namespace vsprite {
namespace {

constexpr int kWidth = 460, kHeight = 420;

struct Difference {
  int most = 0;
  int pixels = 0;  // off by more than 3 of 255
};

class DrawPuppet : public testing::GlTest {
 protected:
  Image seen(const Puppet& puppet, const PuppetPose& pose, Vec2 at, float scale) {
    const Result<PuppetSkin> skin = renderer().make_skin(puppet);
    EXPECT_TRUE(skin) << skin.error().message;
    renderer().begin_frame(kWidth, kHeight);
    renderer().clear(srgb(0x283c5a));
    renderer().draw_puppet(puppet, pose, *skin, at, scale);
    renderer().end_frame();
    renderer().free_skin(*skin);
    return renderer().read_pixels();
  }
  Difference compare(const Puppet& puppet, const PuppetPose& pose, Vec2 at, float scale) {
    Image due = make_image(kWidth, kHeight, 40, 60, 90);
    PuppetPainter painter;
    render_puppet(puppet, pose, painter, due, at, scale);
    const Image is = seen(puppet, pose, at, scale);
    Difference out;
    for (std::size_t i = 0; i < due.rgba.size(); i += 4) {
      int most = 0;
      for (std::size_t c = 0; c < 3; ++c)
        most = std::max(most, std::abs(int{due.rgba[i + c]} - int{is.rgba[i + c]}));
      out.most = std::max(out.most, most);
      out.pixels += most > 3;
    }
    return out;
  }
};

TEST_F(DrawPuppet, IsTheSoftwarePathsPictureForEveryCharacter) {
  for (const ViewSet& set : {puppet_art::face_views(), puppet_art::walk_views(),
                             puppet_art::jump_views(), puppet_art::arm_views()}) {
    const auto puppets = fit_puppets(set);
    ASSERT_TRUE(puppets) << puppets.error().message;
    for (const Puppet& puppet : *puppets)
      for (const double share : {0.0, 0.3, 0.77}) {
        std::vector<double> at;
        for (const PuppetParameter& p : puppet.parameters)
          at.push_back(p.low + share * (p.high - p.low));
        PuppetPose pose = make_pose(puppet);
        pose_puppet(puppet, at, pose);
        const Difference d = compare(puppet, pose, {190.4f, 170.3f}, 0.9f);
        // A pixel whose depth or edge is decided by the last bit may fall to the other side.
        EXPECT_LE(d.pixels, 8) << puppet.name << " at " << share << ", most " << d.most;
      }
  }
}

TEST_F(DrawPuppet, MapsBilinearQuadsAsTheSoftwareDoes) {
  const std::vector<Vec2> square{{0, 0}, {64, 0}, {64, 64}, {0, 64}};
  const Puppet puppet = testing::still_puppet(testing::speckles(64), square, {{{0, 1, 2, 3}, 4}});
  PuppetPose pose = testing::posed(puppet, 0);
  pose.points = {{10, 5}, {330, 60}, {250, 300}, {40, 200}};  // a trapezium of no kind
  EXPECT_LE(compare(puppet, pose, {3, 4}, 1).pixels, 0);
  pose.points = {{10, 5}, {330, 60}, {120, 90}, {40, 250}};  // not convex
  EXPECT_LE(compare(puppet, pose, {3, 4}, 1).pixels, 0);
  pose.points = {{330, 60}, {10, 5}, {40, 200}, {250, 300}};  // turned over
  EXPECT_LE(compare(puppet, pose, {3, 4}, 1).pixels, 0);
}

// Glass of half coverage shows a pixel that two faces claim, and one that none does.
TEST_F(DrawPuppet, HasNoCracksAndNoOverlapsAlongSharedEdges) {
  const Puppet puppet = testing::glass_puppet();
  PuppetPose pose = testing::posed(puppet, 0);
  const std::vector<Vec2> start = pose.points;
  for (const float turn : {0.05f, 0.31f, -0.2f}) {
    for (std::size_t i = 0; i < start.size(); ++i) {
      const Vec2 p = start[i];
      pose.points[i] = {80 + p.x * 2.9f - p.y * turn, 50 + p.x * turn + p.y * 2.93f};
    }
    const Image is = seen(puppet, pose, {}, 1);
    const std::uint32_t inside = testing::color_at(is, 200, 200);
    EXPECT_NE(inside, testing::color_at(is, 2, 2));
    for (int y = 150; y < 260; ++y)
      for (int x = 150; x < 300; ++x)
        ASSERT_EQ(testing::color_at(is, x, y), inside) << x << "," << y;
  }
}

TEST_F(DrawPuppet, DepthDecidesWithinAPuppetAndTheOrderOfCallsBetweenTwo) {
  const std::vector<Vec2> two{{0, 0},   {40, 0},  {40, 40}, {0, 40},
                              {10, 10}, {50, 10}, {50, 50}, {10, 50}};
  Image halves = make_image(80, 40, 255, 0, 0);
  for (int y = 0; y < 40; ++y)
    for (int x = 40; x < 80; ++x) halves.rgba[static_cast<std::size_t>(4 * (y * 80 + x))] = 0;
  Puppet puppet =
      testing::still_puppet(std::move(halves), two, {{{0, 1, 2, 3}, 4}, {{4, 5, 6, 7}, 4}});
  puppet.views[0].points = {{0, 0},  {40, 0}, {40, 40}, {0, 40},
                            {40, 0}, {80, 0}, {80, 40}, {40, 40}};
  PuppetPose pose = testing::posed(puppet, 0);
  const auto skin = renderer().make_skin(puppet);
  ASSERT_TRUE(skin);
  const auto at = [&](int x, int y) { return testing::color_at(renderer().read_pixels(), x, y); };
  renderer().begin_frame(120, 80);
  pose.depth = {1, 1, 1, 1, 0, 0, 0, 0};  // red lies in front
  renderer().draw_puppet(puppet, pose, *skin, {});
  renderer().end_frame();
  EXPECT_EQ(at(25, 25), 0xff0000u);
  // They pierce each other: red is nearer on the left, black on the right.
  pose.depth = {1, 0, 0, 1, 0, 1, 1, 0};
  renderer().begin_frame(120, 80);
  renderer().draw_puppet(puppet, pose, *skin, {});
  renderer().end_frame();
  EXPECT_EQ(at(12, 25), 0xff0000u);
  EXPECT_EQ(at(38, 25), 0x000000u);
  // 1,100 puppets are more than the slices of depth; the last one lies on top.
  renderer().begin_frame(120, 80);
  pose.depth.assign(8, 0);
  for (int k = 0; k < 1100; ++k)
    renderer().draw_puppet(puppet, pose, *skin, {k == 1099 ? 11.0f : 0});
  renderer().end_frame();
  EXPECT_EQ(at(17, 25), 0xff0000u);
  EXPECT_EQ(at(30, 25), 0x000000u);
  EXPECT_LE(renderer().stats().batches, 6u);
}

TEST_F(DrawPuppet, StandsBetweenShapesAndUnderTheCamera) {
  const std::vector<Vec2> square{{0, 0}, {16, 0}, {16, 16}, {0, 16}};
  const Puppet puppet =
      testing::still_puppet(make_image(16, 16, 0, 255, 0), square, {{{0, 1, 2, 3}, 4}});
  const auto skin = renderer().make_skin(puppet);
  ASSERT_TRUE(skin);
  renderer().begin_frame(100, 100);
  renderer().draw_shape(box({0, 0}, {100, 100}, srgb(0xff0000)));
  renderer().set_camera({.scale = 2, .offset = {10, 20}});
  renderer().draw_puppet(puppet, testing::posed(puppet, 0), *skin, {5, 5});
  renderer().set_camera({});
  renderer().draw_shape(box({40, 0}, {100, 100}, srgb(0x0000ff)));
  renderer().end_frame();
  const Image is = renderer().read_pixels();
  EXPECT_EQ(testing::color_at(is, 22, 32), 0x00ff00u);
  EXPECT_EQ(testing::color_at(is, 18, 32), 0xff0000u);
  EXPECT_EQ(testing::color_at(is, 45, 32), 0x0000ffu);
  renderer().free_skin(*skin);
  renderer().begin_frame(100, 100);  // a freed skin draws nothing
  renderer().draw_puppet(puppet, testing::posed(puppet, 0), *skin, {5, 5});
  renderer().end_frame();
  EXPECT_EQ(testing::color_at(renderer().read_pixels(), 10, 10), 0u);
}

}  // namespace
}  // namespace vsprite
