// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "similarity/classifier.h"

#include <gtest/gtest.h>

#include "support/creature.h"

namespace vsprite {
namespace {

TEST(Labels, GiveBothClassesAndTheSameOnesForOneSeed) {
  const FeatureSet set = testing::make_creature(320, 80);
  const auto a = bootstrap_labels(set, 200, 5), b = bootstrap_labels(set, 200, 5);
  ASSERT_EQ(a.size(), b.size());
  int acceptable = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].i, b[k].i);
    EXPECT_EQ(a[k].j, b[k].j);
    EXPECT_LT(a[k].i, a[k].j);
    acceptable += a[k].acceptable;
    // One turn of 64 samples apart: a repeat, never a negative.
    EXPECT_TRUE(a[k].acceptable || (a[k].j - a[k].i) % 64 != 0);
  }
  EXPECT_GT(acceptable, 50);
  EXPECT_LT(acceptable, std::ssize(a));
}

TEST(Classifier, WeightsAreNeverNegativeAndItsOwnPairIsZero) {
  const FeatureSet set = testing::make_creature(320, 40);
  const auto training = train(set, bootstrap_labels(set, 400, 1), {});
  ASSERT_TRUE(training);
  for (double w : training->classifier.weights) EXPECT_GE(w, 0);
  EXPECT_GT(training->classifier.threshold, 0);
  EXPECT_EQ(training->classifier.distance(features(set, 3, 3)), 0);
  const Confusion& c = training->held_out;
  EXPECT_GT(c.true_accept + c.true_reject, 9 * (c.false_accept + c.false_reject));
}

TEST(Classifier, SaysWhichClassIsMissing) {
  const FeatureSet set = testing::make_creature(20, 20);
  const Label good{0, 1, true, false};
  const auto training = train(set, {&good, 1}, {});
  ASSERT_FALSE(training);
  EXPECT_EQ(training.error().code, ErrorCode::BadContent);
  EXPECT_NE(training.error().message.find("no unacceptable pair"), std::string::npos);
}

}  // namespace
}  // namespace vsprite
