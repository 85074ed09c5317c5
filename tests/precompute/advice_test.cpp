// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/advice.h"

#include <gtest/gtest.h>

#include "support/tiny_sprite.h"
#include "tool/film_report.h"

namespace vsprite {
namespace {

// The tiny sprite, whose left-going clip may be left at its last sample only.
Sprite make_reluctant() {
  SpriteData data = testing::tiny_sprite_data();
  SpriteData cut = data;
  cut.transitions.clear();
  cut.row_start.assign(1, 0);
  for (std::uint32_t i = 0; i < data.samples.size(); ++i) {
    const bool left = testing::tiny_heading(i) == 4;
    const bool last = (i - 1) % testing::kTinyClip + 1 == testing::kTinyClip;
    for (std::uint32_t e = data.row_start[i]; e < data.row_start[i + 1]; ++e) {
      const Transition& t = data.transitions[e];
      if (!left || last || testing::tiny_heading(t.to) == 4) cut.transitions.push_back(t);
    }
    cut.row_start.push_back(static_cast<std::uint32_t>(cut.transitions.size()));
  }
  cut.modes.assign(1, testing::tiny::make_mode(cut, "responsive", 2, true));
  return *make_sprite(std::move(cut));
}

TEST(Advice, NamesTheTurnThatTheFilmLacks) {
  const Advice advice = make_advice(make_reluctant(), 0, 1);
  ASSERT_EQ(advice.turns.size(), 56u);
  double from_left = 0, others = 0;
  for (const TurnForecast& t : advice.turns) {
    EXPECT_GE(t.frames, 1);
    EXPECT_LT(t.frames, 60);
    EXPECT_GT(t.worst_cost, 0);
    EXPECT_EQ(t.filmed, 0) << "no clip turns";
    (t.from == Direction::Left ? from_left : others) += t.frames;
  }
  EXPECT_GT(from_left / 7, others / 49);
  ASSERT_FALSE(advice.film.empty());
  EXPECT_TRUE(advice.film[0].starts_with("turning from left to ")) << advice.film[0];
  EXPECT_NE(advice.film[0].find("film 20 s of left-to-"), std::string::npos);
}

TEST(Advice, CountsSecondsOfEveryHeading) {
  const Advice advice = make_advice(testing::tiny_sprite(), 1, 1);
  double seconds = advice.standing;
  for (std::size_t k = 0; k < kRoseSectors; ++k) {
    const RoseSector& s = advice.rose[k];
    EXPECT_NEAR(s.seconds, k % 2 == 0 ? 13 / 30.0 : 0, 1e-9) << k;
    EXPECT_NEAR(s.speed, s.seconds > 0 ? testing::kTinySpeed : 0, 0.01);
    seconds += s.seconds;
  }
  EXPECT_NEAR(seconds, (8 * 13 + 6) / 30.0, 1e-9);
}

TEST(Advice, OnePageHoldsItAllAndFetchesNothing) {
  const Sprite sprite = testing::tiny_sprite();
  FilmReport report{"responsive", make_advice(sprite, 1, 1), Classifier{}, {{"train", {}}}};
  report.records["train"] = {{"confusion", {{"true_accept", 7}}}, {"roc", Json::array()}};
  report.roc = "<svg id='curve'></svg>";
  report.dropped.push_back({"border", 12, 0.057, "PNG"});
  const auto page = report_html(sprite, report);
  ASSERT_TRUE(page) << page.error().message;
  for (const char* part : {"What to film next", "Frames to turn", "<svg", "Classifier", "Stages",
                           "id='curve'", "confusion: true accept", "border: 5.7 %"})
    EXPECT_NE(page->find(part), std::string::npos) << part;
  for (const char* part : {"http", "src='/", "<script"})
    EXPECT_EQ(page->find(part), std::string::npos) << part;
  EXPECT_EQ(report_json(sprite, report)["turns"].size(), 56u);
}

}  // namespace
}  // namespace vsprite
