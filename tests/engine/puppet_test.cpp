// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "vsprite/puppet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/pack_bytes.h"
#include "support/temp_folder.h"
#include "support/tiny_puppet.h"
#include "vsprite/compose.h"
#include "vsprite/pack.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

using testing::glass_puppet;
using testing::posed;
using testing::speckles;
using testing::still_puppet;
using testing::straight;

Image draw(const Puppet& puppet, const PuppetPose& pose, int width, int height, Vec2 at = {}) {
  Image canvas = make_image(width, height, 0, 0, 0, 0);
  PuppetPainter painter;
  render_puppet(puppet, pose, painter, canvas, at);
  return canvas;
}

TEST(Puppet, DrawsItsPictureExactlyWhereNothingMoves) {
  const Image picture = speckles(32);
  const std::vector<Vec2> corners{{0, 0}, {32, 0}, {32, 32}, {0, 32}};
  for (const std::vector<Face>& faces :
       {std::vector<Face>{{{0, 1, 2, 3}, 4}}, {{{0, 1, 2}, 3}, {{0, 2, 3}, 3}}}) {
    const Puppet puppet = still_puppet(picture, corners, faces);
    const Image drawn = draw(puppet, posed(puppet, 0), 32, 32);
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
      ASSERT_NEAR(drawn.rgba[i], picture.rgba[i], 1) << i;
  }
}

// Half-covered glass shows a pixel that two faces claim, and one that none does. Triangles and
// quads side by side, corners moved at random.
TEST(Puppet, HasNoCracksAndNoOverlapsAlongSharedEdges) {
  const Puppet puppet = glass_puppet();
  PuppetPose pose = posed(puppet, 0);
  for (Vec2& p : pose.points) p = {3 + p.x * 0.9f + p.y * 0.05f, 2 + p.y * 0.93f};
  const Image drawn = draw(puppet, pose, 110, 110);
  for (int y = 8; y < 84; ++y)
    for (int x = 14; x < 84; ++x)
      ASSERT_EQ(drawn.rgba[static_cast<std::size_t>(4 * (y * 110 + x) + 3)], 128) << x << "," << y;
}

// The colour of a ramp tells where in the picture a canvas pixel came from.
TEST(Puppet, MapsQuadsByTheInverseOfTheBilinearMap) {
  Image ramp = make_image(256, 256, 0, 0, 0);
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 256; ++x) {
      std::uint8_t* p = &ramp.rgba[static_cast<std::size_t>(4 * (y * 256 + x))];
      p[0] = static_cast<std::uint8_t>(x), p[1] = static_cast<std::uint8_t>(y);
    }
  const Puppet puppet =
      still_puppet(ramp, {{0, 0}, {256, 0}, {256, 256}, {0, 256}}, {{{0, 1, 2, 3}, 4}});
  PuppetPose pose = posed(puppet, 0);
  const std::vector<Vec2> q{{10, 20}, {170, 5}, {190, 180}, {30, 120}};
  pose.points = q;
  const Image drawn = draw(puppet, pose, 200, 200);
  for (const Vec2 at : {Vec2{0.2f, 0.3f}, {0.5f, 0.5f}, {0.8f, 0.35f}, {0.4f, 0.9f}}) {
    const float s = at.x, t = at.y;
    const auto mix = [&](float a, float b, float c, float d) {
      return (1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d;
    };
    const int x = static_cast<int>(mix(q[0].x, q[1].x, q[2].x, q[3].x)),
              y = static_cast<int>(mix(q[0].y, q[1].y, q[2].y, q[3].y));
    const std::uint8_t* p = &drawn.rgba[static_cast<std::size_t>(4 * (y * 200 + x))];
    EXPECT_NEAR(p[0], 256 * s, 3);
    EXPECT_NEAR(p[1], 256 * t, 3);
  }
}

TEST(Puppet, HidesWhatLiesBehindPixelByPixel) {
  Image halves = make_image(20, 10, 255, 0, 0);
  for (int y = 0; y < 10; ++y)
    for (int x = 10; x < 20; ++x) {
      std::uint8_t* p = &halves.rgba[static_cast<std::size_t>(4 * (y * 20 + x))];
      p[0] = 0, p[1] = 255;
    }
  const std::vector<Vec2> texture{{0, 0},  {9, 0},  {9, 10},  {0, 10},
                                  {11, 0}, {20, 0}, {20, 10}, {11, 10}};
  const Puppet puppet = still_puppet(halves, texture, {{{0, 1, 2, 3}, 4}, {{4, 5, 6, 7}, 4}});
  PuppetPose pose = posed(puppet, 0);
  for (std::size_t i = 0; i < 8; ++i)  // both on one place; red comes nearer to the right
    pose.points[i] = {i % 4 == 1 || i % 4 == 2 ? 40.0f : 0.0f, i % 4 >= 2 ? 40.0f : 0.0f};
  pose.depth = {0, 2, 2, 0, 1, 1, 1, 1};
  const Image drawn = draw(puppet, pose, 40, 40);
  const auto red = [&](int x) { return drawn.rgba[static_cast<std::size_t>(4 * (20 * 40 + x))]; };
  EXPECT_EQ(red(8), 0);
  EXPECT_EQ(red(32), 255);
}

TEST(Puppet, TurnsLinksAboutTheirJoints) {
  Puppet puppet;
  puppet.name = "arm";
  puppet.parameters = {{"upper", -3, 3, 0}};
  puppet.views.push_back({make_image(4, 4, 9, 9, 9), std::vector<Vec2>(6, Vec2{1, 1}), {}});
  puppet.links = {{0, 3, -1, 0}, {3, 3, 0, 0}};
  std::vector<double> out{0, 0, 10, 0, 10, 1, 0, 0, 5, 0, 5, 1};  // both along +x
  out.insert(out.end(), {0, 0, 0, 0, 0, 0, 0, 0, 1});
  out.insert(out.end(), {100, 50, 10, 0});  // shoulder; elbow at the upper link's end
  puppet.net = straight(out, std::vector<double>(out.size(), 0));
  const Puppet made = *make_puppet(std::move(puppet));
  const PuppetPose pose = posed(made, std::numbers::pi / 2);
  EXPECT_NEAR(pose.points[1].x, 100, 1e-4);
  EXPECT_NEAR(pose.points[1].y, 60, 1e-4);
  EXPECT_NEAR(pose.points[3].x, 100, 1e-4);
  EXPECT_NEAR(pose.points[3].y, 60, 1e-4);
  EXPECT_NEAR(pose.points[4].x, 95, 1e-4);
  EXPECT_NEAR(pose.points[4].y, 60, 1e-4);
}

TEST(Puppet, ReachesWhereItCanAndPointsWhereItCannot) {
  Random random{3};
  for (int k = 0; k < 200; ++k) {
    const Vec2 target{static_cast<float>(random.unit() * 400 - 200),
                      static_cast<float>(random.unit() * 400 - 200)};
    const ArmReach r = reach_for({0, 0}, target, 90, 70, k % 2 == 0 ? 1 : -1);
    const double x = 90 * std::cos(r.shoulder) + 70 * std::cos(r.shoulder + r.elbow),
                 y = 90 * std::sin(r.shoulder) + 70 * std::sin(r.shoulder + r.elbow);
    const double far = std::hypot(target.x, target.y), due = std::clamp(far, 20.0, 160.0);
    EXPECT_NEAR(x, target.x * due / far, 1e-3);
    EXPECT_NEAR(y, target.y * due / far, 1e-3);
    EXPECT_EQ(r.elbow >= 0, k % 2 == 0);
  }
}

TEST(Puppet, ComesBackFromItsBytesAndFromNoOthers) {
  const std::vector<Vec2> corners{{0, 0}, {32, 0}, {32, 32}, {0, 32}};
  const Puppet puppet = still_puppet(speckles(32), corners, {{{0, 1, 2, 3}, 4}});
  const auto bytes = encode_puppets({&puppet, 1});
  ASSERT_TRUE(bytes);
  const auto back = decode_puppets(*bytes, "x.vsp");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->at(0).views[0].picture.rgba, puppet.views[0].picture.rgba);
  EXPECT_EQ(*encode_puppets(*back), *bytes);
  for (std::size_t n = 0; n < bytes->size(); ++n)
    ASSERT_FALSE(decode_puppets(std::span(*bytes).first(n), "x.vsp")) << n;
  auto longer = *bytes;
  longer.push_back(0);
  EXPECT_FALSE(decode_puppets(longer, "x.vsp"));
}

TEST(Puppet, NamesThePartThatDoesNotFit) {
  Puppet puppet = still_puppet(speckles(8), {{0, 0}, {8, 0}, {8, 8}}, {{{0, 1, 2}, 3}});
  puppet.faces.push_back({{0, 1, 9}, 3});
  const auto made = make_puppet(std::move(puppet));
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::CorruptData);
  EXPECT_NE(made.error().message.find("control point 9"), std::string::npos);
}

TEST(Hull, ClampsToTheNearestPointAndLeavesTheInsideAlone) {
  RbfNetwork net;
  net.dims = 2, net.outputs = 1, net.degree = -1;
  net.hull = {0, 0, 4, 0, 4, 4, 0, 4, 2, 2};
  const auto clamped = [&](double x, double y) {
    std::array at{x, y};
    clamp_to_hull(net, at);
    return at;
  };
  EXPECT_EQ(clamped(1.25, 3.5), (std::array{1.25, 3.5}));
  EXPECT_NEAR(clamped(6, 2)[0], 4, 1e-9);
  EXPECT_NEAR(clamped(6, 2)[1], 2, 1e-9);
  EXPECT_NEAR(clamped(-1, -3)[0], 0, 1e-9);
  EXPECT_NEAR(clamped(-1, -3)[1], 0, 1e-9);
  Random random{1};
  for (int k = 0; k < 500; ++k) {  // against the box's own clamp
    const double x = random.unit() * 12 - 4, y = random.unit() * 12 - 4;
    EXPECT_NEAR(clamped(x, y)[0], std::clamp(x, 0.0, 4.0), 1e-7);
    EXPECT_NEAR(clamped(x, y)[1], std::clamp(y, 0.0, 4.0), 1e-7);
  }
}

// Two sets that overlap on [4, 6]: inside the overlap the one that answered before is kept.
TEST(ExampleSets, KeepTheirAnswerUntilItsHullIsLeft) {
  const auto set = [](double low, double high, std::uint32_t other) {
    ExampleSet out;
    out.net.dims = 1, out.net.outputs = 1, out.net.degree = -1;
    out.net.hull = {low, high};
    out.median = {(low + high) / 2};
    out.joins = {other};
    return out;
  };
  const std::vector<ExampleSet> sets{set(0, 6, 1), set(4, 10, 0)};
  const auto choose = [&](double x, int before) { return choose_set(sets, std::array{x}, before); };
  EXPECT_EQ(choose(4.5, -1), 0);
  EXPECT_EQ(choose(5.5, 0), 0);
  EXPECT_EQ(choose(6.5, 0), 1);
  EXPECT_EQ(choose(4.5, 1), 1);
  EXPECT_EQ(choose(3.5, 1), 0);
  EXPECT_EQ(choose(12, 1), 1);
}

using testing::puppet_of_two_sets;

// Between 4 and 6 either set has an answer: the one that gave the last.
TEST(PuppetSets, AnswerForAsLongAsTheirHullHoldsTheParameters) {
  const Puppet puppet = puppet_of_two_sets();
  PuppetPose pose = make_pose(puppet);
  const auto height = [&](double x) {
    pose_puppet(puppet, std::array{x}, pose);
    return pose.center.y;
  };
  EXPECT_EQ(height(5), 0);  // the nearer median's; both are: the first
  EXPECT_EQ(height(2), 0);
  EXPECT_EQ(height(5.9), 0);
  EXPECT_EQ(height(6.5), 100);
  EXPECT_EQ(height(4.1), 100);
  EXPECT_EQ(height(3.5), 0);
  EXPECT_EQ(height(-2), 0);
  EXPECT_EQ(pose.outside, 2);
  pose.set = -1;  // a pose that is new knows nothing
  EXPECT_EQ(height(7), 100);
}

TEST(PuppetSets, ComeBackFromTheirBytesAndFromNoOthers) {
  const std::vector<Puppet> puppets{testing::glass_puppet(), puppet_of_two_sets()};
  const auto bytes = encode_puppet_sets(puppets);
  ASSERT_TRUE(bytes);
  std::vector<Puppet> back{testing::glass_puppet(), puppet_of_two_sets()};
  back[1].sets.clear();
  ASSERT_TRUE(decode_puppet_sets(*bytes, "x.vsp", back));
  EXPECT_TRUE(back[0].sets.empty());
  ASSERT_EQ(back[1].sets.size(), 2u);
  EXPECT_EQ(*encode_puppet_sets(back), *bytes);
  for (std::size_t n = 0; n < bytes->size(); ++n)
    ASSERT_FALSE(decode_puppet_sets(std::span(*bytes).first(n), "x.vsp", back)) << n;
  auto longer = *bytes;
  longer.push_back(0);
  EXPECT_FALSE(decode_puppet_sets(longer, "x.vsp", back));
  EXPECT_TRUE(encode_puppet_sets({back.data(), 1})->empty());
}

TEST(PuppetSets, NamesThePartThatDoesNotFit) {
  const auto fault = [](const auto& spoil) {
    Puppet parts = puppet_of_two_sets();
    spoil(parts);
    const auto bytes = encode_puppet_sets({&parts, 1});
    std::vector<Puppet> into{puppet_of_two_sets()};
    const auto read = decode_puppet_sets(*bytes, "x.vsp", into);
    EXPECT_TRUE(read || read.error().code == ErrorCode::CorruptData);
    return read ? std::string() : read.error().message;
  };
  const auto expect = [&](const auto& spoil, const char* words) {
    EXPECT_NE(fault(spoil).find(words), std::string::npos) << fault(spoil);
  };
  EXPECT_EQ(fault([](Puppet&) {}), "");
  expect([](Puppet& p) { p.sets.resize(1); }, "x.vsp: PSET: puppet still: 1 example sets");
  expect([](Puppet& p) { p.sets[1].joins = {2}; }, "example set 1 joins set 2");
  expect([](Puppet& p) { p.sets[0].net.hull.clear(); }, "example set 0 has no hull");
  expect([](Puppet& p) { p.sets[0].median = {1, 2}; }, "a median of other parameters");
  expect([](Puppet& p) { p.sets[0].median = {std::nan("")}; }, "a median that is not finite");
  expect([](Puppet& p) { p.sets[1].net.polynomial.pop_back(); }, "polynomial has");
  expect([](Puppet& p) { p.sets[1].net = p.sets[1].net, p.sets[1].net.width = 0; }, "width");
  expect(
      [](Puppet& p) {
        p.sets[1].net = testing::straight({1, 2}, {0, 0});
        p.sets[1].net.hull = {0, 1};
      },
      "a network of other parameters and control points");
}

TEST(PuppetSets, RefuseBytesOfPuppetsThatAreNotThere) {
  const std::vector<Puppet> puppets{puppet_of_two_sets()};
  auto bytes = *encode_puppet_sets(puppets);
  std::vector<Puppet> into{puppet_of_two_sets()};
  bytes[4] = 1;  // of the second puppet
  EXPECT_FALSE(decode_puppet_sets(bytes, "x.vsp", into));
  bytes[4] = 0;
  auto twice = bytes;
  twice[0] = 2;
  twice.insert(twice.end(), bytes.begin() + 4, bytes.end());  // of the same puppet again
  const auto read = decode_puppet_sets(twice, "x.vsp", into);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("puppet 0 after 1 of 1"), std::string::npos);
  bytes[3] = 0xff;  // more puppets than bytes
  EXPECT_FALSE(decode_puppet_sets(bytes, "x.vsp", into));
}

// A build that knows no section PSET plays the first set.
TEST(PuppetSets, LieInASectionOfTheirOwnBesideTheSamePuppets) {
  const testing::TempFolder folder;
  const std::string from = folder.file("from.vsp"), to = folder.file("to.vsp");
  testing::write_bytes(from, testing::tiny_pack_bytes());
  const std::vector<Puppet> puppets{puppet_of_two_sets()};
  ASSERT_TRUE(save_puppets(from, to, puppets));
  EXPECT_TRUE(verify_pack(to)->empty());
  const auto loaded = load_puppets(to);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->at(0).sets.size(), 2u);
  Puppet plain = puppet_of_two_sets();
  plain.sets.clear();
  EXPECT_EQ(*load_extra(to, "PUPT"), *encode_puppets({&plain, 1}));
  ASSERT_TRUE(save_puppets(to, to, {&plain, 1}));
  EXPECT_TRUE(load_extra(to, "PSET")->empty());
  EXPECT_TRUE(load_puppets(to)->at(0).sets.empty());
  ASSERT_TRUE(save_puppets(to, to, {}));
  EXPECT_EQ(testing::read_bytes(to), testing::read_bytes(from));
}

}  // namespace
}  // namespace vsprite
