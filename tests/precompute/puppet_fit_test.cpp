// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "synthesis/puppet_fit.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>

#include "puppet/art.h"
#include "synthesis/delaunay.h"
#include "vsprite/compose.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

double worst(const PuppetPose& pose, const std::vector<Vec2>& due) {
  double most = 0;
  for (std::size_t i = 0; i < due.size(); ++i)
    most = std::max(most, std::hypot(double{pose.points[i].x} + pose.center.x - due[i].x,
                                     double{pose.points[i].y} + pose.center.y - due[i].y));
  return most;
}

PuppetPose pose_at(const Puppet& puppet, const std::vector<double>& at) {
  PuppetPose pose = make_pose(puppet);
  pose_puppet(puppet, at, pose);
  return pose;
}

TEST(PuppetFit, IsExactAtTheExamples) {
  for (const ViewSet& set :
       {puppet_art::face_views(), puppet_art::walk_views(), puppet_art::jump_views()}) {
    const auto puppets = fit_puppets(set);
    ASSERT_TRUE(puppets) << puppets.error().message;
    for (const View& view : set.views)
      EXPECT_LE(worst(pose_at(puppets->at(0), view.at), view.points), 0.01) << view.name;
  }
}

TEST(PuppetFit, PutsLinksWhereTheyWereAndKeepsTheirLengthBetween) {
  const ViewSet set = puppet_art::arm_views();
  const auto puppets = fit_puppets(set);
  ASSERT_TRUE(puppets) << puppets.error().message;
  const Puppet& arm = puppets->at(0);
  EXPECT_LE(worst(pose_at(arm, {-2.6, -1.2}), set.views[1].points), 0.05);
  // Between the examples the upper arm is as long as in them, which no interpolation of places is.
  for (double a = -2.5; a < 1.4; a += 0.3) {
    const View truth = puppet_art::draw_arm(a, -0.6);
    EXPECT_LE(worst(pose_at(arm, {a, -0.6}), truth.points), 4.0) << a;
    const PuppetPose pose = pose_at(arm, {a, -0.6});
    const Vec2 p = pose.points[18], q = pose.points[19];
    EXPECT_NEAR(std::hypot(q.x - p.x, q.y - p.y), 120, 0.1);
  }
}

// No transparent pixel within the elbow, at any angle inside the hull.
TEST(PuppetFit, LeavesNoFissureAtTheElbow) {
  const auto puppets = fit_puppets(puppet_art::arm_views());
  PuppetPainter painter;
  for (double e = -2.3; e <= 0; e += 0.23) {
    const PuppetPose pose = pose_at(puppets->at(0), {-0.6, e});
    Image canvas = make_image(600, 600, 0, 0, 0, 0);
    render_puppet(puppets->at(0), pose, painter, canvas, pose.center);
    const Vec2 elbow{pose.points[19].x + pose.center.x, pose.points[19].y + pose.center.y};
    for (int dy = -16; dy <= 16; ++dy)
      for (int dx = -16; dx <= 16; ++dx) {
        if (dx * dx + dy * dy > 256) continue;
        const int x = static_cast<int>(elbow.x) + dx, y = static_cast<int>(elbow.y) + dy;
        ASSERT_GE(canvas.rgba[static_cast<std::size_t>(4 * (y * 600 + x) + 3)], 250)
            << e << " at " << dx << "," << dy;
      }
  }
}

// Equation 5: O'_B(t) = R'_B + m [O_B(t) - R_B].
TEST(PuppetFit, MovesAnotherCharacterByParallelDeformation) {
  for (const bool modulate : {false, true}) {
    ViewSet set = puppet_art::walk_views();
    set.characters[0].modulate = modulate;
    const auto puppets = fit_puppets(set);
    ASSERT_TRUE(puppets) << puppets.error().message;
    const Puppet &john = puppets->at(0), &jayne = puppets->at(1);
    const std::vector<double> at{0.3, -0.4};
    const PuppetPose o = pose_at(john, at), r = pose_at(john, set.views[0].at),
                     p = pose_at(jayne, at), q = pose_at(jayne, set.views[0].at);
    EXPECT_EQ(jayne.motion == 1, !modulate);
    for (std::size_t i = 0; i < o.points.size(); ++i) {
      EXPECT_NEAR(p.points[i].x - q.points[i].x, jayne.motion * (o.points[i].x - r.points[i].x),
                  1e-3);
      EXPECT_NEAR(p.points[i].y - q.points[i].y, jayne.motion * (o.points[i].y - r.points[i].y),
                  1e-3);
    }
  }
}

TEST(PuppetFit, ChoosesTheViewThatFitsTheConfiguration) {
  ViewSet set = puppet_art::face_views();
  set.blends = false;
  const auto puppets = fit_puppets(set);
  ASSERT_TRUE(puppets) << puppets.error().message;
  const auto chosen = [&](double rotation, double expression) {
    const auto shares = pose_at(puppets->at(0), {rotation, expression}).shares;
    return std::max_element(shares.begin(), shares.end()) - shares.begin();
  };
  EXPECT_EQ(chosen(3, 0.05), 0);
  EXPECT_EQ(chosen(33, 0.1), 1);
  EXPECT_EQ(chosen(19, 0.45), 2);
  EXPECT_EQ(chosen(3, 0.95), 3);
  EXPECT_EQ(chosen(34, 0.9), 4);
}

TEST(PuppetFit, StopsAtTheHullOfItsExamples) {
  const auto puppets = fit_puppets(puppet_art::face_views());
  const PuppetPose inside = pose_at(puppets->at(0), {36, 1}),
                   outside = pose_at(puppets->at(0), {95, 4});
  EXPECT_EQ(inside.outside, 0);
  EXPECT_GT(outside.outside, 0.5);
  EXPECT_NEAR(outside.points[0].x, inside.points[0].x, 1e-3);
}

TEST(PuppetFit, NamesWhatIsWrongWithTheViews) {
  const auto message = [](const std::function<void(ViewSet&)>& spoil) {
    ViewSet set = puppet_art::face_views();
    spoil(set);
    const auto puppets = fit_puppets(set);
    if (puppets) return std::string("fitted");
    EXPECT_EQ(puppets.error().code, ErrorCode::BadContent);
    return puppets.error().message;
  };
  const auto says = [](const std::string& text, const char* what) {
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  says(message([](ViewSet& s) { s.views[2].picture = make_image(10, 10, 0, 0, 0); }), "10 x 10 px");
  says(message([](ViewSet& s) { s.views[1].points.pop_back(); }), "every view needs all of them");
  says(message([](ViewSet& s) { s.views[1].points[7] = s.views[1].points[3]; }),
       "control points 4 and 8");
  says(message([](ViewSet& s) {
         for (auto& view : s.views)
           for (std::size_t i = 0; i < view.points.size(); ++i)
             view.points[i] = {static_cast<float>(i), static_cast<float>(i)};
       }),
       "on one line");
  says(message([](ViewSet& s) { s.views[1].at = s.views[0].at; }), "same parameters as face_1.png");
  says(message([](ViewSet& s) { s.views.resize(1); }), "at least two are due");
  says(message([](ViewSet& s) { s.views[3].at[0] = 70; }), "rotation = 70 lies outside 0 to 36");
  says(message([](ViewSet& s) { s.views[3].at[0] = std::nan(""); }), "rotation is not a number");
  says(message([](ViewSet& s) { s.views[3].points[5].x = std::nanf(""); }), "control point 6");
  says(message([](ViewSet& s) {
         s.faces = {{{0, 5, 10}, 3}}, std::swap(s.views[2].points[5], s.views[2].points[10]);
       }),
       "folded over");
}

TEST(PuppetFit, TakesTenThousandControlPoints) {
  ViewSet set;
  set.name = "many", set.parameters = {{"t", 0, 1, 0}};
  for (int v = 0; v < 3; ++v) {
    View view{.name = "v", .picture = make_image(400, 400, 90, 90, 90), .at = {v / 2.0}};
    Random same{9};
    for (int i = 0; i < 10000; ++i)
      view.points.push_back(
          {static_cast<float>(same.unit() * 400 + v), static_cast<float>(same.unit() * 400)});
    set.views.push_back(std::move(view));
  }
  const auto puppets = fit_puppets(set);
  ASSERT_TRUE(puppets) << puppets.error().message;
  EXPECT_GT(puppets->at(0).faces.size(), 19000u);
}

// Fewer centres than views: near the views, never on them, and no farther for other units.
TEST(PuppetFit, MeetsTheViewsNearlyWithFewerCenters) {
  ViewSet set = puppet_art::face_views();
  EXPECT_LT(fit_error(set, fit_puppets(set)->at(0)), 1e-9);
  for (const HyperTraining training : {HyperTraining::Gradient, HyperTraining::RandomSearch}) {
    set.hyper = HyperConfig{.centers = 3, .training = training, .steps = 0};
    set.rbf = RbfConfig{.kernel = Kernel::Gaussian, .degree = 0, .width = 0.5};
    const double before = fit_error(set, fit_puppets(set)->at(0));
    set.hyper->steps = 300;
    const auto fitted = fit_puppets(set);
    ASSERT_TRUE(fitted) << fitted.error().message;
    EXPECT_EQ(fitted->at(0).net.center_count(), 3);
    const double after = fit_error(set, fitted->at(0));
    EXPECT_GT(after, 1e-6);
    EXPECT_LT(after, 0.8 * before);
    ViewSet large = set;  // the same in thousandths of a degree
    large.parameters[0].high *= 1000;
    for (View& view : large.views) view.at[0] *= 1000;
    EXPECT_NEAR(fit_error(large, fit_puppets(large)->at(0)), after, 0.02 * after);
  }
}

// A square that hangs high from 0 to 6 and low from 4 to 10: no map joins all its views.
ViewSet high_and_low() {
  ViewSet set{.name = "square", .parameters = {{"x", 0, 10, 0}}};
  for (const auto& [x, y] : {std::pair{0.0f, 0.0f},
                             {3.0f, 0.0f},
                             {6.0f, 0.0f},
                             {4.0f, 50.0f},
                             {6.0f, 50.0f},
                             {10.0f, 50.0f}})
    set.views.push_back({.name = "view",
                         .picture = make_image(20, 90, 9, 9, 9),
                         .at = {x},
                         .points = {{x, y}, {x + 9, y}, {x + 9, y + 9}, {x, y + 9}}});
  set.sets = {{"high", {0, 1, 2}, {1}}, {"low", {3, 4, 5}, {0}}};
  return set;
}

TEST(PuppetFit, JoinsTheViewsOfASetAndNoOthers) {
  const ViewSet set = high_and_low();
  const auto fitted = fit_puppets(set);
  ASSERT_TRUE(fitted) << fitted.error().message;
  const Puppet& puppet = fitted->at(0);
  EXPECT_LT(fit_error(set, puppet), 1e-9);
  EXPECT_EQ(puppet.sets[1].median, std::vector<double>{6});
  PuppetPose pose = make_pose(puppet);
  const auto top = [&](double x) {
    pose_puppet(puppet, std::array{x}, pose);
    return pose.points[0].y + pose.center.y;
  };
  for (const double x : {1.0, 4.5, 6.0}) EXPECT_NEAR(top(x), 0, 1e-4) << x;
  for (const double x : {6.5, 6.0, 4.0}) EXPECT_NEAR(top(x), 50, 1e-4) << x;
  EXPECT_NEAR(top(3.9), 0, 1e-4);
}

TEST(PuppetFit, NamesWhatIsWrongWithSets) {
  const auto fault = [](const auto& spoil) {
    ViewSet set = high_and_low();
    spoil(set);
    const auto checked = check_views(set);
    EXPECT_TRUE(checked || checked.error().code == ErrorCode::BadContent);
    return checked ? std::string() : checked.error().message;
  };
  const auto expect = [&](const auto& spoil, const char* words) {
    EXPECT_NE(fault(spoil).find(words), std::string::npos) << fault(spoil);
  };
  expect([](ViewSet& s) { s.sets.clear(); }, "has the same parameters");
  expect([](ViewSet& s) { s.sets[0].views.push_back(4); }, "has the same parameters");
  expect([](ViewSet& s) { s.sets.pop_back(); }, "sets of views: 1, none or 2 to 64 are due");
  expect([](ViewSet& s) { s.sets[1].views = {3}; }, "set low: at least two views are due");
  expect([](ViewSet& s) { s.sets[1].views = {3, 4}; }, "stands in no set");
  expect([](ViewSet& s) { s.parameters[0].period = 10; }, "a parameter that is not cyclic");
}

// Every triangle's circle is empty; together they fill the hull.
TEST(Delaunay, TrianglesHaveEmptyCirclesAndFillTheHull) {
  Random random{2};
  std::vector<Vec2> points{{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  for (int i = 0; i < 80; ++i)
    points.push_back(
        {static_cast<float>(random.unit() * 100), static_cast<float>(random.unit() * 100)});
  double area = 0;
  for (const Face& f : triangulate(points)) {
    const Vec2 a = points[f.corners[0]], b = points[f.corners[1]], c = points[f.corners[2]];
    const double twice = double{b.x - a.x} * (c.y - a.y) - double{b.y - a.y} * (c.x - a.x);
    EXPECT_GT(twice, 0);
    area += twice / 2;
    const double bx = double{b.x} - a.x, by = double{b.y} - a.y, cx = double{c.x} - a.x,
                 cy = double{c.y} - a.y;
    const double d = 2 * twice, ux = (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / d,
                 uy = (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / d;
    for (const Vec2 p : points)
      EXPECT_GT(std::hypot(p.x - a.x - ux, p.y - a.y - uy), std::hypot(ux, uy) - 0.05);
  }
  EXPECT_NEAR(area, 10000, 1);
  EXPECT_TRUE(triangulate(std::vector<Vec2>{{0, 0}, {1, 1}, {2, 2}}).empty());
}

}  // namespace
}  // namespace vsprite
