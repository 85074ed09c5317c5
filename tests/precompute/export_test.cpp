// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// What other engines get, played by the players that come with it.
#include "tool/export.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "tool/files.h"
#include "vsprite/actor.h"
#include "vsprite/image.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

using testing::TempFolder;

constexpr int kTicks = 1200, kHeld = 17;

int direction_at(int tick) { return (tick / kHeld * 7 + tick / 200) % kDirectionCount; }

class Export : public ::testing::Test {
 protected:
  void SetUp() override {
    SpriteData data = testing::tiny_sprite_data();
    for (ControlMode& mode : data.modes) mode.exit_angle = 0.4f;
    const auto picture = [&](std::uint32_t i) -> Result<Image> {
      return testing::tiny_picture(data, i);
    };
    ASSERT_TRUE(save_pack(room_.file("tiny.vsp"), data, picture));
    sprite_.emplace(*load_pack(room_.file("tiny.vsp")));
    auto choice = choose_for_export(*sprite_, 70, 1, 1);
    ASSERT_TRUE(choice) << choice.error().message;
    choice_ = std::move(*choice);
  }
  ExportJob job(const std::string& folder) const {
    return {.film = *sprite_,
            .choice = choice_,
            .runs = direction_runs(choice_.data),
            .output = folder};
  }
  Result<Json> write(const std::string& format) {
    return (*find_export_format(format))->write(job(room_.path()));
  }
  // The engine's own run of the chosen samples: sample, x and y in 1/65536 px, a line a tick.
  std::string engine_run(const std::string& mode) const {
    const auto sprite = make_sprite(choice_.data);
    Actor actor = make_actor(*sprite, {}, 0, sprite->find_mode(mode));
    std::string lines;
    for (int tick = 0; tick < kTicks; ++tick) {
      set_direction(*sprite, actor, static_cast<Direction>(direction_at(tick)));
      step(*sprite, actor);
      lines += std::to_string(actor.sample) + " " + std::to_string(actor.position.x) + " " +
               std::to_string(actor.position.y) + "\n";
    }
    return lines;
  }
  // Runs a player's program; what it printed.
  std::string output_of(const std::string& program, const std::string& name,
                        const std::string& text) const {
    EXPECT_TRUE(write_file(room_.file(name), text));
    const std::string command = "cd '" + room_.path() + "' && " + program + " " + name + " >out";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return *read_file(room_.file("out"));
  }

  TempFolder room_;
  std::optional<Sprite> sprite_;
  SampleChoice choice_;
};

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) == 0;
}

const std::string kPlayers = VSPRITE_SOURCE_DIR "/assets/players/";

TEST_F(Export, TheJavaScriptPlayerShowsTheEnginesFrames) {
  if (!has_program("node")) GTEST_SKIP() << "no node here";
  ASSERT_TRUE(write("table"));
  for (const std::string mode : {"paper", "responsive"}) {
    const std::string program =
        "const { Character } = require('" + kPlayers + "vsprite.js');\n" +
        "const data = JSON.parse(require('fs').readFileSync('character.json'));\n" +
        "const c = new Character(data, '" + mode + "');\nlet out = '';\n" + "for (let t = 0; t < " +
        std::to_string(kTicks) + "; t++) {\n  c.steer((Math.floor(t / " + std::to_string(kHeld) +
        ") * 7 + Math.floor(t / 200)) % 10);\n  c.tick();\n" +
        "  out += `${c.sample()} ${c.x * 65536} ${c.y * 65536}\\n`;\n}\n" +
        "process.stdout.write(out);\n";
    EXPECT_EQ(output_of("node", "run.js", program), engine_run(mode)) << mode;
  }
}

// A JSON document as a Lua expression.
std::string lua_of(const Json& json) {
  if (json.is_array()) {
    std::string out = "{";
    for (const Json& entry : json) out += lua_of(entry) + ",";
    return out + "}";
  }
  if (!json.is_object()) return json.dump();
  std::string out = "{";
  for (const auto& [key, value] : json.items()) out += "[\"" + key + "\"]=" + lua_of(value) + ",";
  return out + "}";
}

TEST_F(Export, TheLuaPlayerShowsTheEnginesFrames) {
  if (!has_program("luajit")) GTEST_SKIP() << "no luajit here";
  ASSERT_TRUE(write("table"));
  const Json data = Json::parse(*read_file(room_.file("character.json")));
  for (const std::string mode : {"paper", "responsive"}) {
    const std::string program =
        "local Character = dofile('" + kPlayers + "vsprite.lua')\nlocal data = " + lua_of(data) +
        "\nlocal c = Character.new(data, '" + mode + "')\nfor t = 0, " +
        std::to_string(kTicks - 1) + " do\n  c:steer((math.floor(t / " + std::to_string(kHeld) +
        ") * 7 + math.floor(t / 200)) % 10)\n  c:tick()\n" +
        "  print(string.format('%d %d %d', c:sample(), c.x * 65536, c.y * 65536))\nend\n";
    EXPECT_EQ(output_of("luajit", "run.lua", program), engine_run(mode)) << mode;
  }
}

TEST_F(Export, EveryPictureStandsInItsPageAsItIsInThePack) {
  ASSERT_TRUE(write("table"));
  const Json data = Json::parse(*read_file(room_.file("character.json")));
  ASSERT_EQ(data["samples"].size(), choice_.from.size());
  for (std::size_t k = 0; k < choice_.from.size(); ++k) {
    const Json& s = data["samples"][k];
    const auto page = read_png(room_.file(data["pages"][s["page"].get<std::size_t>()]["file"]));
    ASSERT_TRUE(page);
    EXPECT_LE(std::max(page->width, page->height), 2048);
    Image due;
    ASSERT_TRUE(sprite_->decode_frame(choice_.from[k], due));
    unpremultiply(due);
    ASSERT_EQ(s["w"], due.width);
    ASSERT_EQ(s["h"], due.height);
    const int left = s["x"], top = s["y"];
    for (int y = 0; y < due.height; ++y)
      EXPECT_TRUE(std::equal(due.rgba.begin() + 4 * y * due.width,
                             due.rgba.begin() + 4 * (y + 1) * due.width,
                             page->rgba.begin() + 4 * ((top + y) * page->width + left)));
  }
}

TEST_F(Export, APngForEverySample) {
  ASSERT_TRUE(write("png-seq"));
  const Json data = Json::parse(*read_file(room_.file("character.json")));
  for (const Json& s : data["samples"]) {
    const auto picture = read_png(room_.file(s["file"]));
    ASSERT_TRUE(picture);
    EXPECT_EQ(s["w"], picture->width);
  }
}

// A held direction ends in its run, and stays in it.
TEST_F(Export, TheRunOfADirectionIsWhatTheEnginePlays) {
  const auto sprite = make_sprite(choice_.data);
  for (const PlayedRun& run : direction_runs(choice_.data)) {
    if (!run.loops) continue;
    Actor actor = make_actor(*sprite);
    actor.sample = run.samples.front();
    std::string name = run.name;
    std::replace(name.begin(), name.end(), '-', '+');
    set_direction(*sprite, actor, *parse_direction(name));
    actor.stage = 0;
    actor.shown = sprite->samples()[actor.sample].duration;
    for (std::size_t k = 1; k <= 2 * run.samples.size(); ++k) {
      step(*sprite, actor);
      ASSERT_EQ(actor.sample, run.samples[k % run.samples.size()]) << run.name << " " << k;
      actor.shown = sprite->samples()[actor.sample].duration;
    }
  }
}

TEST(Played, OfSeveralLoopsTheOneIntoWhichMostSamplesLead) {
  // 0 <-> 1; 2 -> 3 -> 4 -> 2, and 5, 6 lead into it; 7 is not there.
  EXPECT_EQ(most_travelled_loop({1, 0, 3, 4, 2, 4, 5, kNoSample}),
            (std::vector<std::uint32_t>{2, 3, 4}));
  EXPECT_EQ(most_travelled_loop({0}), std::vector<std::uint32_t>{0});
  EXPECT_TRUE(most_travelled_loop({kNoSample}).empty());
}

TEST_F(Export, FilmRunsHoldEverySampleOnceInFilmOrder) {
  std::vector<std::uint32_t> all;
  for (const PlayedRun& run : film_runs(choice_.data))
    all.insert(all.end(), run.samples.begin(), run.samples.end());
  ASSERT_EQ(all.size(), choice_.from.size());
  for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(all[k], k);
}

// A character whose pictures fill several pages: a run is never divided while a page can hold it.
TEST_F(Export, RunsAreDealtOutToPagesWhole) {
  for (Sample& s : choice_.data.samples) s.width = s.height = 600;
  ExportJob big = job(room_.path());
  big.runs.resize(2);
  std::size_t due = 0;
  for (const PlayedRun& run : big.runs) due += run.samples.size();
  const auto wrote = write_aseprite(big);
  ASSERT_TRUE(wrote) << wrote.error().message;
  EXPECT_GT((*wrote)["pages"], 1);
  std::size_t frames = 0, most = 0;
  for (std::size_t p = 0; p < (*wrote)["pages"]; ++p) {
    const Json page = Json::parse(*read_file(room_.file("page-" + std::to_string(p) + ".json")));
    frames += page["frames"].size();
    for (const Json& tag : page["meta"]["frameTags"])
      most = std::max(most, tag["to"].get<std::size_t>() - tag["from"].get<std::size_t>() + 1);
    for (const Json& frame : page["frames"]) {
      EXPECT_LE(frame["frame"]["x"].get<int>() + 600, 2048);
      EXPECT_LE(frame["frame"]["y"].get<int>() + 600, 2048);
    }
  }
  EXPECT_EQ(frames, due);
  EXPECT_LE(most, 9u);  // three times three to a page
}

TEST(ExportFormats, AWrongNameIsAnsweredWithTheNearest) {
  const auto format = find_export_format("tabel");
  ASSERT_FALSE(format);
  EXPECT_EQ(format.error().code, ErrorCode::BadSetting);
  EXPECT_NE(format.error().message.find("`table`"), std::string::npos);
}

TEST_F(Export, ThereIsNoSpriteWithoutSamplesToExport) {
  SpriteData data = testing::tiny_sprite_data();
  for (Sample& s : data.samples) s.kept = 0;
  const auto none_kept = make_sprite(data);
  ASSERT_FALSE(none_kept);
  EXPECT_NE(none_kept.error().message.find("is not a kept sample"), std::string::npos);
  data.samples.clear();
  EXPECT_FALSE(make_sprite(data));
}

TEST_F(Export, AFolderThatIsNotThereCannotBeWritten) {
  const auto wrote = (*find_export_format("table"))->write(job(room_.file("absent/folder")));
  ASSERT_FALSE(wrote);
  EXPECT_EQ(wrote.error().code, ErrorCode::CannotCreate);
}

}  // namespace
}  // namespace vsprite
