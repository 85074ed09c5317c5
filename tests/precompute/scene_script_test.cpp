// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/scene_script.h"

#include <gtest/gtest.h>

#include "support/tiny_sprite.h"

namespace vsprite {
namespace {

const std::string kHead = "seconds = 2\n[[sprite]]\nname = \"a\"\nstart = [5, 6]\n";

std::string complaint(const std::string& text) {
  const auto parsed = parse_scene(text, "s.toml");
  return parsed ? "" : parsed.error().message;
}

TEST(SceneScript, ReadsSecondsAndPixelsAndNames) {
  const auto script = parse_scene(
      kHead +
          "[[sprite.term]]\nkind = \"meet\"\nwith = \"b\"\ndistance = 30\nfrom = 0.5\nto = 1.5\n"
          "[[sprite]]\nname = \"b\"\nstart = [50, 6]\n"
          "[[sprite.term]]\nkind = \"heading\"\nangle_deg = 270\nweight = 2\n",
      "s.toml");
  ASSERT_TRUE(script) << script.error().message;
  const Sprite sprite = testing::tiny_sprite();
  const auto scene = make_scene(*script, {&sprite, &sprite}, "s.toml");
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->ticks, 60u);
  EXPECT_EQ(scene->roles[0].terms[0].from, 15u);
  EXPECT_EQ(scene->roles[0].terms[0].to, 45u);
  EXPECT_EQ(scene->roles[0].terms[0].other, 1u);
  EXPECT_NEAR(scene->roles[1].terms[0].angle, -3.14159265 / 2, 1e-6);
  EXPECT_EQ(scene->roles[1].start, (Vec2{50, 6}));
}

TEST(SceneScript, SaysWhereItIsWrongAndWhatIsDue) {
  EXPECT_EQ(complaint("seconds = \n").rfind("s.toml:1: not TOML", 0), 0u);
  EXPECT_EQ(complaint("seconds = -1\n" + kHead.substr(12)),
            "s.toml:1: seconds: a number from 0 to 3600 is due");
  EXPECT_EQ(complaint("seconds = 2\n"), "s.toml: a scene without a sprite: [[sprite]] is due");
  EXPECT_EQ(complaint(kHead + "pak = \"x\"\n"), "s.toml:5: pak: not known here; is `pack` meant?");
  EXPECT_EQ(complaint(kHead + "[[sprite.term]]\nkind = \"fly\"\n"),
            "s.toml:5: kind: `fly`: one of location, path, heading, speed, pose, region, clear, "
            "meet is due");
  EXPECT_EQ(complaint(kHead + "[[sprite.term]]\nkind = \"location\"\nat = [nan, 1]\n"),
            "s.toml:7: at: [x, y] in px, each from -30000 to 30000, is due");
  EXPECT_EQ(complaint(kHead + "[[sprite.term]]\nkind = \"speed\"\n"),
            "s.toml:5: speed: it is missing here and is due");
  EXPECT_NE(complaint(kHead + "[[sprite]]\nname = \"a\"\nstart = [1, 1]\n").find("one name"),
            std::string::npos);
}

TEST(SceneScript, AnotherSpriteAndAnotherPackAreNamed) {
  const Sprite sprite = testing::tiny_sprite();
  const auto fails = [&](const std::string& term) {
    const auto script = parse_scene(kHead + "[[sprite.term]]\n" + term, "s.toml");
    const auto scene = make_scene(*script, {&sprite}, "s.toml");
    return scene ? "" : scene.error().message;
  };
  EXPECT_NE(fails("kind = \"clear\"\nwith = \"c\"\ndistance = 9\n").find("with = \"c\""),
            std::string::npos);
  EXPECT_NE(fails("kind = \"pose\"\nsample = 99999\n").find("is the scene for another pack?"),
            std::string::npos);
}

TEST(SceneScript, PlacesAreReadBackAsTheyWereWritten) {
  const Sprite sprite = testing::tiny_sprite();
  const auto script = parse_scene(kHead, "s.toml");
  const auto scene = make_scene(*script, {&sprite}, "s.toml");
  const SceneResult result = replace_search(*scene, {.proposals = 200});
  const std::string text = scene_places(*script, *scene, result, {}).dump();
  const auto samples = read_places(text, *scene, "p.json");
  ASSERT_TRUE(samples) << samples.error().message;
  const SceneResult again = replace_search(*scene, {.proposals = 0, .start = *samples});
  EXPECT_EQ(again.cost, result.cost);
  EXPECT_FALSE(read_places("[]", *scene, "p.json"));
  EXPECT_FALSE(read_places("{\"sprites\":[{\"ticks\":[{\"sample\":0}]}]}", *scene, "p.json"));
}

}  // namespace
}  // namespace vsprite
