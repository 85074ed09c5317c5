// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/project.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "support/temp_folder.h"
#include "tool/settings.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

struct ProjectTest : ::testing::Test {
  testing::TempFolder temporary;
  const std::string folder_ = temporary.path();
};

SampleRow row(int sample) {
  SampleRow r;
  r.sample = sample;
  r.frame = 3 * sample;
  r.left = 0.1 + sample;
  r.width = 12.5;
  r.height = 1.0 / 3;
  r.velocity_x = -1e-7;
  r.source = "a \"film\", cut.mp4";
  return r;
}

TransitionFile table_of_three() {
  TransitionFile file;
  file.v0 = 12.5;
  file.costs.row_start = {0, 1, 2, 3};
  file.costs.transitions = {{1, 0.0f}, {2, 0.0f}, {0, 0.5f}};
  file.costs.kept = {1, 1, 1};
  file.pairs = {{0, 2, 0.25f}};
  file.skip_costs = {0.3f, HUGE_VALF, HUGE_VALF};
  return file;
}

TEST(SamplesCsv, ReadsBackBitForBit) {
  const std::vector<SampleRow> rows{row(0), row(1)};
  const std::string text = format_samples(rows);
  const auto read = parse_samples(text, "samples.csv");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(format_samples(*read), text);
  EXPECT_EQ((*read)[1].source, rows[1].source);
  EXPECT_EQ((*read)[1].height, rows[1].height);
}

TEST(SamplesCsv, NamesLineAndColumnOfASlip) {
  const std::string good = format_samples({row(0), row(1)});
  const auto slip = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.rfind(from), from.size(), to);
    const auto read = parse_samples(text, "w/samples.csv");
    return read ? std::string("no error") : read.error().message;
  };
  EXPECT_NE(slip("\n1,0,3,", "\n1,x,3,").find("w/samples.csv:3:3: clip is `x`"), std::string::npos);
  EXPECT_NE(slip("\n1,0,3,", "\n2,0,3,").find("w/samples.csv:3:1: sample is `2`"),
            std::string::npos);
  EXPECT_NE(slip("\n1,0,3,", "\n1,0,0,").find("frames must ascend"), std::string::npos);
  EXPECT_NE(slip("\n1,0,3,", "\n1,0,3,7,").find("18 columns where 17 are due"), std::string::npos);
  EXPECT_NE(slip("12.5", "nan").find("width is `nan`"), std::string::npos);
}

TEST(ClassifierFile, ReadsBackAndNamesASlip) {
  Training training;
  training.classifier.weights = {0.1, 0, 1.0 / 3, 2, 1e-9, 7};
  training.classifier.threshold = 3;
  const std::string text = format_classifier(training);
  const auto read = parse_classifier(text, "c.toml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->weights, training.classifier.weights);
  EXPECT_EQ(read->threshold, 3);
  const auto bad = parse_classifier("threshold = 1.0\n[weights]\nspeed = -2\n", "c.toml");
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::CorruptData);
  EXPECT_NE(bad.error().message.find("c.toml:3:"), std::string::npos) << bad.error().message;
}

TEST(TransitionFileTest, EveryTruncationAndEveryFlippedByteIsRefused) {
  const std::string bytes = format_transitions(table_of_three());
  const auto read = parse_transitions(bytes, "t.bin", 3);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(format_transitions(*read), bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(parse_transitions(bytes.substr(0, size), "t.bin", 3)) << size;
  EXPECT_FALSE(parse_transitions(bytes + "x", "t.bin", 3));
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string flipped = bytes;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    EXPECT_FALSE(parse_transitions(flipped, "t.bin", 3)) << at;
  }
  EXPECT_FALSE(parse_transitions(bytes, "t.bin", 4));
}

// Sums that are right say nothing about what a person or a script wrote.
TEST(TransitionFileTest, SaysWhatAnEditedTableHoldsAndWhatIsDue) {
  const auto fault = [](const std::function<void(TransitionFile&)>& edit) {
    TransitionFile file = table_of_three();
    edit(file);
    const auto read = parse_transitions(format_transitions(file), "w/transitions.bin", 3);
    EXPECT_EQ(read ? ErrorCode::Internal : read.error().code, ErrorCode::CorruptData);
    return read ? std::string("no error") : read.error().message;
  };
  const auto with = [](const std::string& what) {
    return "w/transitions.bin: " + what +
           ": make it again with `vsprite transitions --force transitions`";
  };
  EXPECT_EQ(fault([](auto& f) { f.costs.transitions[1].to = 3; }),
            with("sample 1 leads to sample 3 where 0 to 2 are due"));
  EXPECT_EQ(fault([](auto& f) { f.costs.transitions[2].cost = -0.5f; }),
            with("sample 2 leads to sample 0 at a cost of -0.5 where 0 or more is due"));
  EXPECT_EQ(fault([](auto& f) { f.costs.transitions[2].cost = NAN; }),
            with("sample 2 leads to sample 0 at a cost of nan where 0 or more is due"));
  EXPECT_EQ(fault([](auto& f) {
              f.costs.row_start = {0, 1, 1, 3};
            }),
            with("sample 1 leads nowhere where a kept one leads to one or more"));
  EXPECT_EQ(fault([](auto& f) {
              f.costs.row_start = {0, 2, 1, 3};
            }),
            with("the row of sample 1 ends at 1 where 2 or more is due"));
  EXPECT_EQ(fault([](auto& f) {
              f.costs.row_start = {1, 1, 2, 3};
            }),
            with("its rows run from 1 to 3 where 0 to 3 are due"));
  EXPECT_EQ(fault([](auto& f) {
              f.costs.row_start = {0, 1, 3, 3};
            }),
            with("sample 1 leads to sample 0 where a row ascends"));
  EXPECT_EQ(fault([](auto& f) { f.costs.kept[2] = 0; }),
            with("sample 1 leads to sample 2 where both were to be kept, and one was not"));
  EXPECT_EQ(fault([](auto& f) { f.costs.kept[0] = 7; }),
            with("sample 0 is kept 7 times where 0 or 1 is due"));
  EXPECT_EQ(fault([](auto& f) { f.v0 = 0; }), with("v0 is 0 where a speed above 0 is due"));
  EXPECT_EQ(fault([](auto& f) { f.skip_costs[1] = NAN; }),
            with("leaving out what follows sample 1 costs nan where 0 or more is due"));
  EXPECT_EQ(fault([](auto& f) { f.pairs[0].j = 3; }),
            with("it pairs samples 0 and 3 where two of 0 to 2 are due, the lower one first"));
}

TEST_F(ProjectTest, AStageIsCurrentUntilItsInputsOrSettingsChange) {
  const StageKey key{"solve", {{"alpha", 0.97}}, {{"transitions.bin", "00"}}};
  {
    auto project = Project::open(folder_, true);
    ASSERT_TRUE(project) << project.error().message;
    EXPECT_FALSE(project->is_current(key));
    ASSERT_TRUE(project->finish_stage(key, "11", {{"residual", 0.5}}));
  }
  auto project = Project::open(folder_, false);
  ASSERT_TRUE(project);
  EXPECT_TRUE(project->is_current(key));
  EXPECT_FALSE(project->is_current({"solve", {{"alpha", 0.98}}, key.inputs}));
  EXPECT_FALSE(project->is_current({"solve", key.settings, {{"transitions.bin", "01"}}}));
  ASSERT_TRUE(project->begin_stage("solve"));
  EXPECT_FALSE(project->is_current(key)) << "a stage that has begun must not pass for finished";
}

TEST_F(ProjectTest, ADamagedManifestIsNamedWithItsLine) {
  ASSERT_TRUE(write_file(folder_ + "/manifest.json", "{\n  \"stages\": {,}\n}\n"));
  const auto project = Project::open(folder_, false);
  ASSERT_FALSE(project);
  EXPECT_EQ(project.error().code, ErrorCode::CorruptData);
  EXPECT_NE(project.error().message.find("manifest.json:2:14"), std::string::npos)
      << project.error().message;
}

TEST_F(ProjectTest, RemovesWhatDeadProcessesLeftAndNothingElse) {
  ASSERT_TRUE(write_file(folder_ + "/values.bin.tmp.999999999", "x"));
  ASSERT_TRUE(write_file(folder_ + "/my.tmp.notes", "x"));
  ASSERT_TRUE(write_file(folder_ + "/other.tmp.1", "x"));  // process 1 lives
  ASSERT_TRUE(Project::open(folder_, false));
  EXPECT_FALSE(fs::exists(folder_ + "/values.bin.tmp.999999999"));
  EXPECT_TRUE(fs::exists(folder_ + "/my.tmp.notes"));
  EXPECT_TRUE(fs::exists(folder_ + "/other.tmp.1"));
}

TEST(Settings, TheNearestNameIsASlipOfTheFingerAway) {
  const std::vector<std::string> names{"alpha", "max-size", "jobs"};
  EXPECT_EQ(nearest_name("max-szie", names), "max-size");
  EXPECT_EQ(nearest_name("alhpa", names), "alpha");
  EXPECT_EQ(nearest_name("colour", names), "");
}

TEST(Settings, ADumpedConfigurationReadsBackAsItself) {
  Settings settings;
  ASSERT_TRUE(apply_assignment(settings, "alpha=0.5"));
  ASSERT_TRUE(apply_assignment(settings, "key=#102030"));
  Settings read;
  const auto applied = apply_config(read, dump_config(settings), "x.toml");
  ASSERT_TRUE(applied) << applied.error().message;
  EXPECT_EQ(dump_config(read), dump_config(settings));
  EXPECT_EQ(read.alpha, 0.5);
  EXPECT_FALSE(apply_assignment(settings, "alpha=1"));
  EXPECT_FALSE(apply_assignment(settings, "config=x"));
}

// What a verb takes and what is not as it was, in words that a shell hands over as they are.
TEST(Settings, SayTheOptionsThatRepeatThem) {
  Settings settings;
  EXPECT_EQ(options_text(settings, "segment"), "");
  for (const char* given :
       {"key=#102030", "edge=-1.25", "mirror=true", "matte=a \"b\" c's.mp4", "alpha=0.5", "seed=7"})
    ASSERT_TRUE(apply_assignment(settings, given)) << given;
  EXPECT_EQ(options_text(settings, "segment"),
            " --key '#102030' --edge -1.25 --matte 'a \"b\" c'\\''s.mp4' --mirror");
  EXPECT_EQ(options_text(settings, "solve"), " --alpha 0.5");
}

TEST(Settings, ClipBlackStaysBelowClipWhite) {
  Settings settings;
  EXPECT_EQ(*matte_of(settings), MatteConfig{});
  settings.clip_black = settings.clip_white = 0.5;
  ASSERT_FALSE(matte_of(settings));
  EXPECT_EQ(matte_of(settings).error().code, ErrorCode::BadSetting);
}

TEST(Places, FilmPackAndFolderLeadToTheSameWork) {
  EXPECT_EQ(find_work_folder("", "films/fish.mp4", ""), "fish.work");
  EXPECT_EQ(find_work_folder("", "films/fish.mp4", "out/f.vsp"), "out/f.work");
  EXPECT_EQ(find_work_folder("", "out/f.vsp", ""), "out/f.work");
  EXPECT_EQ(find_work_folder("here/", "out/f.vsp", ""), "here");
  EXPECT_EQ(find_pack_path("fish.work", "films/fish.mp4", ""), "fish.vsp");
  EXPECT_EQ(find_pack_path("out/f.work", "", ""), "out/f.vsp");
}

}  // namespace
}  // namespace vsprite
