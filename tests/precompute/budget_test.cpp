// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/budget.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "support/naive_actions.h"
#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "vsprite/action.h"
#include "vsprite/ground.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

class Budget : public ::testing::Test {
 protected:
  void save(SpriteData data) {
    for (ControlMode& mode : data.modes) mode.exit_angle = 0.4f;
    const auto picture = [&](std::uint32_t i) -> Result<Image> {
      return testing::tiny_picture(data, i);
    };
    const PackExtra extras[] = {{"GRND", *encode_ground({1, 2, 3, 4})}, {"GAME", {1, 2, 3}}};
    ASSERT_TRUE(save_pack(whole_, data, picture, extras));
  }
  double bytes(const std::string& path) {
    return static_cast<double>(std::filesystem::file_size(path));
  }
  const testing::TempFolder room_;
  const std::string whole_ = room_.file("whole.vsp"), small_ = room_.file("small.vsp");
};

TEST_F(Budget, ThePackIsSmallEnoughAndStillGoesEveryWay) {
  save(testing::tiny_sprite_data());
  const double due = 0.7 * bytes(whole_);
  const auto outcome = fit_pack(whole_, small_, {.bytes = due, .jobs = 1});
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_LE(bytes(small_), due);
  EXPECT_EQ(static_cast<double>(outcome->after.bytes), bytes(small_));
  EXPECT_LT(outcome->after.samples, outcome->before.samples);
  EXPECT_GT(outcome->after.turn_median, 0);
  EXPECT_TRUE(verify_pack(small_)->empty());
  const Sprite small = *load_pack(small_);
  EXPECT_EQ(small.data().modes[0].served & 0xFFu, 0xFFu);
  EXPECT_EQ((*load_ground(small_))->horizon, 1);
  EXPECT_TRUE(load_extra(small_, "GAME")->empty()) << "it may name samples";
}

TEST_F(Budget, PicturesStayAsTheyWere) {
  save(testing::tiny_sprite_data());
  ASSERT_TRUE(fit_pack(whole_, small_, {.bytes = 0.8 * bytes(whole_), .jobs = 1}));
  const Sprite whole = *load_pack(whole_), small = *load_pack(small_);
  Image before, after;
  for (std::uint32_t k = 0, i = 0; k < small.samples().size(); ++k) {
    while (whole.samples()[i].frame != small.samples()[k].frame) ++i;
    ASSERT_TRUE(whole.decode_frame(i, before) && small.decode_frame(k, after));
    EXPECT_EQ(before.rgba, after.rgba) << k;
  }
}

TEST_F(Budget, ActionsAreThereAndLeadToTheirTags) {
  save(testing::acting_sprite_data());
  ASSERT_TRUE(fit_pack(whole_, whole_, {.bytes = 0.9 * bytes(whole_), .jobs = 1}));
  const Sprite small = *load_pack(whole_);
  ASSERT_FALSE(small.actions().empty());
  for (std::size_t a = 0; a < small.actions().size(); ++a) {
    Actor actor = make_actor(small);
    play(small, actor, static_cast<int>(a), 4);
    bool has_shown = false;
    for (int tick = 0; tick < 4; ++tick) {
      step(small, actor);
      has_shown |= is_showing_action(actor);
    }
    EXPECT_TRUE(has_shown) << small.actions()[a].name;
  }
}

TEST_F(Budget, TooSmallABudgetIsRefusedAndNothingIsWritten) {
  save(testing::tiny_sprite_data());
  const auto refused = fit_pack(whole_, small_, {.bytes = 100, .jobs = 1});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::BadContent);
  EXPECT_NE(refused.error().message.find("every direction and tag"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(small_));
}

}  // namespace
}  // namespace vsprite
