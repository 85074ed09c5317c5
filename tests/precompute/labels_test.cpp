// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/labels.h"

#include <gtest/gtest.h>

#include "support/creature.h"
#include "support/temp_folder.h"
#include "tool/label_session.h"
#include "tool/train.h"

namespace vsprite {
namespace {

constexpr const char* kFilm = "00112233445566aa";

/// A work folder that says it was segmented from one film.
struct LabelsTest : ::testing::Test {
  testing::TempFolder temporary;
  Result<Project> project_ = Project::open(temporary.path(), false);
  const FeatureSet set_ = testing::make_creature(320, 80);

  void SetUp() override {
    ASSERT_TRUE(project_);
    const Json result{{"film", "f.mp4"}, {"fps", {30, 1}}};
    ASSERT_TRUE(project_->finish_stage({"segment", {}, {{"film", kFilm}}}, "0", result));
  }
  SampleNames names() { return *SampleNames::of(*project_, set_.rows); }
  LabelStore store() { return std::move(*LabelStore::open(project_->path("labels.sqlite"))); }
  Answer about(int i, int j, bool acceptable) {
    return {names().name(i), names().name(j), acceptable, false, -1};
  }
};

TEST_F(LabelsTest, TheLastOfTwoThatDisagreeCountsAndBothAreSaidSo) {
  const std::vector<Answer> given{about(3, 90, true), about(5, 91, true), about(90, 3, false)};
  const PersonLabels person = resolve(given, names());
  ASSERT_EQ(person.labels.size(), 2u);
  EXPECT_EQ(person.labels[0].i, 3);
  EXPECT_FALSE(person.labels[0].acceptable);
  EXPECT_EQ(person.repeated, 1);
  EXPECT_EQ(person.disagreeing, 1);
}

TEST_F(LabelsTest, OfSamplesThatAreGoneAreKeptAndCounted) {
  std::vector<Answer> given{about(3, 90, true), about(4, 95, false)};
  given[0].a.frame = 99999;
  given[1].b.film = "ffffffffffffffff";
  ASSERT_TRUE(store().add(given));
  const auto person = read_person_labels(*project_, names());
  ASSERT_TRUE(person);
  EXPECT_EQ(person->gone, 2);
  EXPECT_TRUE(person->labels.empty());
  EXPECT_EQ(store().answers()->size(), 2u);
}

TEST_F(LabelsTest, OutliveANewNumberingOfTheSamples) {
  const Answer given = about(100, 200, true);
  std::vector<SampleRow> fewer(set_.rows.begin() + 50, set_.rows.end());
  for (std::size_t k = 0; k < fewer.size(); ++k) fewer[k].sample = static_cast<int>(k);
  const PersonLabels person = resolve({given}, *SampleNames::of(*project_, fewer));
  ASSERT_EQ(person.labels.size(), 1u);
  EXPECT_EQ(person.labels[0].i, 50);
  EXPECT_EQ(person.labels[0].j, 150);
}

TEST_F(LabelsTest, CsvReadsBackAsItWasWritten) {
  std::vector<Answer> given{about(3, 90, true), about(5, 91, false)};
  given[1].guess = 0.1 + 0.2;
  given[1].at_random = given[1].b.mirrored = true;
  const auto parsed = parse_answers(format_answers(given), "a.csv", names());
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(parsed->answers, given);
}

TEST_F(LabelsTest, CsvWithNumbersLeavesOutWhatNoPersonGave) {
  const auto parsed = parse_answers(
      "acceptable,j,i,by_person\r\n1,90,3,1\r\n# a remark\n0,91,5,0\n", "a.csv", names());
  ASSERT_TRUE(parsed) << parsed.error().message;
  EXPECT_EQ(parsed->answers, std::vector<Answer>{about(3, 90, true)});
  EXPECT_EQ(parsed->passed_over, 1);
}

TEST_F(LabelsTest, CsvNamesLineAndColumnOfASlip) {
  const auto slip = [&](const std::string& text) {
    const auto parsed = parse_answers(text, "a.csv", names());
    return parsed ? std::string("no error") : parsed.error().message;
  };
  EXPECT_EQ(slip("i,j,acceptable\n3,90,1\n3,320,1\n").find("a.csv:3:3: j: `320`"), 0u);
  EXPECT_EQ(slip("i,j,acceptable\n3,90,maybe\n").find("a.csv:2:6: acceptable"), 0u);
  EXPECT_EQ(slip("i,j,acceptable\n7,7,1\n").find("a.csv:2:3: j: a sample with itself"), 0u);
  EXPECT_EQ(slip("i,j,acceptable\n7,1\n").find("a.csv:2:1: 2 columns"), 0u);
  EXPECT_EQ(slip("a,b\n").find("a.csv:1:1: the first line must name"), 0u);
  EXPECT_EQ(slip("").find("a.csv:1:1: "), 0u);
}

TEST_F(LabelsTest, APersonsAnswerReplacesTheFilmsOwn) {
  const auto film = bootstrap_labels(set_, 200, 1);
  const Answer other = about(film[0].i, film[0].j, !film[0].acceptable);
  const auto merged = merge_labels(film, resolve({other}, names()));
  EXPECT_EQ(merged.size(), film.size());
  EXPECT_EQ(merged.back().acceptable, !film[0].acceptable);
  EXPECT_TRUE(merged.back().by_person);
}

TEST_F(LabelsTest, ChangeTheKeyOfTrainOnlyWhereTheyCount) {
  const auto key = [&] {
    StageKey made{"train", {}, {}};
    EXPECT_TRUE(add_labels_to_key(*project_, {}, made));
    return made.inputs.dump() + made.settings.dump();
  };
  ASSERT_TRUE(write_file(project_->path("samples.csv"), format_samples(set_.rows)));
  const std::string without = key();
  ASSERT_TRUE(store().answers());
  EXPECT_EQ(key(), without);  // an empty database is none
  const Answer one = about(3, 90, true);
  ASSERT_TRUE(store().add({&one, 1}));
  const std::string with = key();
  EXPECT_NE(with, without);
  ASSERT_TRUE(store().add({&one, 1}));
  EXPECT_EQ(key(), with);
}

}  // namespace
}  // namespace vsprite
