// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The C interface, through the shared library; the C++ engine beside it is the static one.
#include "vsprite/c_api.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <regex>
#include <set>

#include "support/naive_actions.h"
#include "support/temp_folder.h"
#include "support/tiny_puppet.h"
#include "support/tiny_sprite.h"
#include "vsprite/puppet.h"
#include "vsprite/vsprite.h"

namespace vsprite {
namespace {

constexpr const char* kScript = "0 right; 0.7 right+up; 1.2 play jump 4; 2 release; 3 left; 4 rest";

void write_acting_pack(const std::string& path) {
  SpriteData data = testing::acting_sprite_data();
  data.event_names = {"flap", "land"};
  data.events = {{3, 0}, {5, 1}};
  const auto picture = [&](std::uint32_t sample) -> Result<Image> {
    return testing::tiny_picture(data, sample);
  };
  const Result<void> saved = save_pack(path, data, picture);
  ASSERT_TRUE(saved) << saved.error().message;
}

template <class T>
T sized(std::uint32_t size = sizeof(T)) {
  T value{};
  value.struct_size = size;
  return value;
}

class CApi : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ = folder_.file("acting.vsp");
    write_acting_pack(path_);
    ASSERT_EQ(vsprite_load_pack(path_.c_str(), &sprite_), VSPRITE_OK) << vsprite_last_error();
    ASSERT_EQ(vsprite_make_frames(sprite_, 0, &frames_), VSPRITE_OK);
    ASSERT_EQ(vsprite_load_keys(sprite_, kScript, &keys_), VSPRITE_OK) << vsprite_last_error();
    ASSERT_EQ(vsprite_make_hash(&hash_), VSPRITE_OK);
    ASSERT_EQ(vsprite_make_canvas(96, 64, 0x9CC4D8, &canvas_), VSPRITE_OK);
    ASSERT_EQ(vsprite_make_actor(sprite_, 30, 30, 7, 0, &actor_), VSPRITE_OK);
  }
  void TearDown() override {
    EXPECT_EQ(vsprite_close_sprite(&sprite_), VSPRITE_OK);  // the others keep it
    EXPECT_EQ(vsprite_close_canvas(&canvas_), VSPRITE_OK);
    EXPECT_EQ(vsprite_close_hash(&hash_), VSPRITE_OK);
    EXPECT_EQ(vsprite_close_keys(&keys_), VSPRITE_OK);
    EXPECT_EQ(vsprite_close_frames(&frames_), VSPRITE_OK);
  }
  vsprite_source source() const {
    vsprite_source s{};
    s.struct_size = sizeof s;
    s.path = path_.c_str();
    return s;
  }

  testing::TempFolder folder_;
  std::string path_;
  vsprite_sprite* sprite_ = nullptr;
  vsprite_frames* frames_ = nullptr;
  vsprite_keys* keys_ = nullptr;
  vsprite_hash* hash_ = nullptr;
  vsprite_canvas* canvas_ = nullptr;
  vsprite_actor actor_{};
};

TEST_F(CApi, MakesTheStatesOfTheEngine) {
  const Sprite sprite = *load_pack(path_);
  const KeyScript script = *parse_key_script(kScript, sprite.fps());
  Actor actor = make_actor(sprite, {30, 30}, 7, 0);
  StateHash hash;
  for (int tick = 0; tick < 300; ++tick) {
    set_direction(sprite, actor, script.at(actor.tick));
    play_script(sprite, script, actor.tick, actor);
    step(sprite, actor);
    hash.add(actor);
    ASSERT_EQ(vsprite_apply_keys(keys_, &actor_), VSPRITE_OK);
    ASSERT_EQ(vsprite_step(sprite_, &actor_), VSPRITE_OK);
    ASSERT_EQ(vsprite_add_to_hash(hash_, &actor_), VSPRITE_OK);
    ASSERT_EQ(std::memcmp(&actor, &actor_, sizeof actor), 0) << "tick " << tick;
  }
  std::uint64_t digest = 0;
  EXPECT_EQ(vsprite_get_hash(hash_, &digest), VSPRITE_OK);
  EXPECT_EQ(digest, hash.digest());
}

TEST_F(CApi, SaysWhatAPackHolds) {
  const Sprite sprite = *load_pack(path_);
  vsprite_info info{};
  info.struct_size = sizeof info;
  ASSERT_EQ(vsprite_get_info(sprite_, &info), VSPRITE_OK);
  EXPECT_EQ(info.samples, sprite.samples().size());
  EXPECT_EQ(info.modes, 2u);
  EXPECT_EQ(info.events, 2u);
  EXPECT_EQ(info.identity, sprite.identity());
  EXPECT_DOUBLE_EQ(info.fps, sprite.fps());
  std::uint32_t index = 99;
  ASSERT_EQ(vsprite_find(sprite_, VSPRITE_MODE, "responsive", &index), VSPRITE_OK);
  EXPECT_EQ(index, 1u);
  const char* name = nullptr;
  ASSERT_EQ(vsprite_get_name(sprite_, VSPRITE_EVENT, 1, &name), VSPRITE_OK);
  EXPECT_STREQ(name, "land");
  EXPECT_EQ(vsprite_find(sprite_, VSPRITE_ACTION, "fly", &index), VSPRITE_NOT_FOUND);
  EXPECT_NE(std::string(vsprite_last_error()).find("`fly`"), std::string::npos);
  EXPECT_STREQ(vsprite_status_name(VSPRITE_NOT_FOUND), "NOT_FOUND");
  EXPECT_STREQ(vsprite_status_name(VSPRITE_BAD_ARGUMENT), "BAD_ARGUMENT");
  EXPECT_STREQ(vsprite_status_name(99), "?");
}

TEST_F(CApi, HandsOutThePicturesOfTheEngine) {
  const Sprite sprite = *load_pack(path_);
  Image due;
  vsprite_picture picture{};
  picture.struct_size = sizeof picture;
  for (std::uint32_t s = 1; s < sprite.samples().size(); ++s) {
    ASSERT_TRUE(sprite.decode_frame(s, due));
    ASSERT_EQ(vsprite_get_picture(frames_, s, &picture), VSPRITE_OK);
    ASSERT_EQ(picture.width, static_cast<std::uint32_t>(due.width));
    ASSERT_EQ(std::memcmp(picture.rgba, due.rgba.data(), due.rgba.size()), 0) << "sample " << s;
    ASSERT_EQ(picture.anchor_x, sprite.samples()[s].anchor.x);
  }
}

TEST_F(CApi, HandsOutTheShadowThatWasFilmed) {
  float scale = 0;
  vsprite_picture picture{};
  picture.struct_size = sizeof picture;
  ASSERT_EQ(vsprite_get_shadow(frames_, 4, &picture, &scale), VSPRITE_OK);
  EXPECT_EQ(picture.width, 0u);  // this pack has none

  SpriteData data = testing::tiny_sprite_data();
  ASSERT_TRUE(add_shadow(data, 4, make_image(9, 5, 0, 0, 0, 77), {4, 1}));
  const testing::TempFolder folder;
  ASSERT_TRUE(save_pack(folder.file("s.vsp"), data, [&](std::uint32_t sample) {
    return Result<Image>(testing::tiny_picture(data, sample));
  }));
  vsprite_sprite* shaded = nullptr;
  vsprite_frames* frames = nullptr;
  ASSERT_EQ(vsprite_load_pack(folder.file("s.vsp").c_str(), &shaded), VSPRITE_OK);
  ASSERT_EQ(vsprite_make_frames(shaded, 0, &frames), VSPRITE_OK);
  ASSERT_EQ(vsprite_get_shadow(frames, 4, &picture, &scale), VSPRITE_OK);
  EXPECT_EQ(picture.width, 9u);
  EXPECT_EQ(picture.rgba[0], 0);
  EXPECT_EQ(picture.rgba[3], 77);
  EXPECT_EQ(picture.anchor_x, 4);
  EXPECT_EQ(scale, 2);
  EXPECT_EQ(vsprite_close_frames(&frames), VSPRITE_OK);
  EXPECT_EQ(vsprite_close_sprite(&shaded), VSPRITE_OK);
}

TEST_F(CApi, DrawsAndHitsTheCharacter) {
  ASSERT_EQ(vsprite_draw_actor(canvas_, frames_, &actor_, 0, 1), VSPRITE_OK);
  vsprite_picture picture{};
  picture.struct_size = sizeof picture;
  ASSERT_EQ(vsprite_get_canvas(canvas_, &picture), VSPRITE_OK);
  const std::uint8_t* ground = picture.rgba;
  const std::uint8_t* body = picture.rgba + 30 * picture.stride + 30 * 4;
  EXPECT_EQ(ground[0], 0x9C);
  EXPECT_NE(std::memcmp(ground, body, 3), 0);
  std::int32_t hit = 0;
  ASSERT_EQ(vsprite_hit(frames_, &actor_, 30, 30, 1, 128, &hit), VSPRITE_OK);
  EXPECT_EQ(hit, 1);
  ASSERT_EQ(vsprite_hit(frames_, &actor_, 60, 30, 1, 128, &hit), VSPRITE_OK);
  EXPECT_EQ(hit, 0);
  const std::string file = folder_.file("canvas.png");
  ASSERT_EQ(vsprite_save_canvas(canvas_, file.c_str()), VSPRITE_OK) << vsprite_last_error();
  EXPECT_GT(testing::read_bytes(file).size(), 100u);
}

TEST_F(CApi, RollsBackByCopyingBytes) {
  const vsprite_actor snapshot = actor_;
  for (int t = 0; t < 40; ++t) vsprite_apply_keys(keys_, &actor_), vsprite_step(sprite_, &actor_);
  const vsprite_actor end = actor_;
  actor_ = snapshot;
  for (int t = 0; t < 40; ++t) vsprite_apply_keys(keys_, &actor_), vsprite_step(sprite_, &actor_);
  EXPECT_EQ(std::memcmp(&end, &actor_, sizeof end), 0);
  EXPECT_EQ(end.tick, 40u);
}

TEST_F(CApi, StepsManyAsOne) {
  std::vector<vsprite_actor> many(300, actor_);
  for (std::size_t i = 0; i < many.size(); ++i)
    ASSERT_EQ(vsprite_set_direction(sprite_, &many[i], static_cast<int>(i % 10)), VSPRITE_OK);
  std::vector<vsprite_actor> one = many;
  for (int t = 0; t < 20; ++t) {
    ASSERT_EQ(vsprite_step_many(sprite_, many.data(), many.size()), VSPRITE_OK);
    for (auto& a : one) ASSERT_EQ(vsprite_step(sprite_, &a), VSPRITE_OK);
  }
  std::uint64_t a = 0, b = 1;
  vsprite_hash_actors(many.data(), many.size(), &a);
  vsprite_hash_actors(one.data(), one.size(), &b);
  EXPECT_EQ(a, b);
  const std::vector<vsprite_actor> before = many;
  many[299].sample = 0xFFFFFFFF;
  EXPECT_EQ(vsprite_step_many(sprite_, many.data(), many.size()), VSPRITE_BAD_ARGUMENT);
  EXPECT_EQ(std::memcmp(many.data(), before.data(), 299 * sizeof many[0]), 0) << "none may move";
}

// Recordings.

vsprite_command command_of(std::int32_t kind) {
  auto command = sized<vsprite_command>();
  command.kind = kind;
  command.direction = VSPRITE_LEFT_UP;
  command.within = 4;
  command.hold = 1;
  command.x = 2, command.y = -1, command.radius = 9;
  return command;
}

// Two actors, one by keys and one by every kind of command; their last states.
std::array<vsprite_actor, 2> record_two(vsprite_sprite* sprite, const vsprite_keys* keys,
                                        const std::string& path, int ticks) {
  std::array<vsprite_actor, 2> actors{};
  for (std::uint32_t k = 0; k < 2; ++k) vsprite_make_actor(sprite, 9, 9, k, k, &actors[k]);
  vsprite_recording* recording = nullptr;
  EXPECT_EQ(vsprite_make_recording(sprite, actors.data(), 2, &recording), VSPRITE_OK);
  for (int tick = 0; tick < ticks; ++tick) {
    EXPECT_EQ(vsprite_record_keys(recording, 0, &actors[0], keys), VSPRITE_OK);
    const vsprite_command command = command_of(tick / 7 % 10);
    if (tick % 7 == 0) {
      EXPECT_EQ(vsprite_record_command(recording, 1, &actors[1], &command), VSPRITE_OK)
          << vsprite_last_error();
    }
    EXPECT_EQ(vsprite_step_many(sprite, actors.data(), 2), VSPRITE_OK);
    EXPECT_EQ(vsprite_record_tick(recording, actors.data(), 2), VSPRITE_OK);
  }
  EXPECT_EQ(vsprite_save_recording(recording, path.c_str()), VSPRITE_OK) << vsprite_last_error();
  EXPECT_EQ(vsprite_close_recording(&recording), VSPRITE_OK);
  return actors;
}

TEST_F(CApi, ARecordedRunIsMadeAgainTickByTick) {
  const std::string path = folder_.file("run.vsr");
  const auto last = record_two(sprite_, keys_, path, 200);
  vsprite_replay* replay = nullptr;
  ASSERT_EQ(vsprite_load_replay(sprite_, path.c_str(), &replay), VSPRITE_OK);
  auto info = sized<vsprite_replay_info>();
  ASSERT_EQ(vsprite_get_replay(replay, &info), VSPRITE_OK);
  EXPECT_EQ(info.same_pack, 1u);
  EXPECT_EQ(info.ticks, 200u);
  EXPECT_EQ(info.actors, 2u);
  std::array<vsprite_actor, 2> now{};
  for (int run = 0; run < 2; ++run) {
    ASSERT_EQ(vsprite_start_replay(replay, now.data(), 2), VSPRITE_OK);
    EXPECT_EQ(now[0].tick, 0u);
    for (std::uint64_t tick = 0; tick < info.ticks; ++tick)
      ASSERT_EQ(vsprite_step_replay(replay, now.data(), 2), VSPRITE_OK) << vsprite_last_error();
    EXPECT_EQ(std::memcmp(now.data(), last.data(), sizeof now), 0);
    EXPECT_EQ(vsprite_step_replay(replay, now.data(), 2), VSPRITE_BAD_ARGUMENT) << "it has ended";
  }
  EXPECT_EQ(vsprite_close_replay(&replay), VSPRITE_OK);
}

TEST_F(CApi, KeysAreRecordedAsTheEngineRecordsThem) {
  const Sprite sprite = *load_pack(path_);
  const KeyScript script = *parse_key_script(kScript, sprite.fps());
  std::array<Actor, 1> due{make_actor(sprite, {30, 30}, 7)};
  ReplayRecorder recorder(sprite, due);
  vsprite_recording* recording = nullptr;
  ASSERT_EQ(vsprite_make_recording(sprite_, &actor_, 1, &recording), VSPRITE_OK);
  for (std::uint64_t tick = 0; tick < 150; ++tick) {
    if (script.at(tick) != due[0].direction)
      recorder.command(sprite, due, {.direction = script.at(tick)});
    for (const ReplayCommand& c : commands_at(sprite, script, tick))
      recorder.command(sprite, due, c);
    step(sprite, due);
    recorder.tick(due);
    ASSERT_EQ(vsprite_record_keys(recording, 0, &actor_, keys_), VSPRITE_OK);
    ASSERT_EQ(vsprite_step(sprite_, &actor_), VSPRITE_OK);
    ASSERT_EQ(vsprite_record_tick(recording, &actor_, 1), VSPRITE_OK);
  }
  const std::string ours = folder_.file("ours.vsr"), theirs = folder_.file("theirs.vsr");
  ASSERT_EQ(vsprite_save_recording(recording, ours.c_str()), VSPRITE_OK);
  ASSERT_TRUE(save_replay(theirs, recorder.replay()));
  EXPECT_EQ(testing::read_bytes(ours), testing::read_bytes(theirs));
  auto report = sized<vsprite_replay_report>();
  ASSERT_EQ(vsprite_run_replay(sprite_, ours.c_str(), &report), VSPRITE_OK);
  EXPECT_EQ(report.diverged_tick, 0u);
  EXPECT_EQ(vsprite_close_recording(&recording), VSPRITE_OK);
}

TEST_F(CApi, SaysWhereARecordedRunGoesAnotherWay) {
  const std::string path = folder_.file("run.vsr");
  record_two(sprite_, keys_, path, 40);
  const Sprite sprite = *load_pack(path_);
  Replay other = *load_replay(path, sprite);
  other.hashes[29] ^= 1;
  ASSERT_TRUE(save_replay(path, other));
  vsprite_replay* replay = nullptr;
  ASSERT_EQ(vsprite_load_replay(sprite_, path.c_str(), &replay), VSPRITE_OK);
  std::array<vsprite_actor, 2> now{};
  for (int tick = 1; tick <= 40; ++tick) {
    const vsprite_status status = vsprite_step_replay(replay, now.data(), 2);
    EXPECT_EQ(status, tick == 30 ? VSPRITE_BAD_CONTENT : VSPRITE_OK) << "tick " << tick;
  }
  EXPECT_NE(std::string(vsprite_last_error()).find("after tick 30 "), std::string::npos);
  EXPECT_EQ(vsprite_close_replay(&replay), VSPRITE_OK);
}

// Showing.

TEST_F(CApi, ShowsWhatTheEngineShowsAndFades) {
  const Sprite sprite = *load_pack(path_);
  FrameCache frames(sprite);
  ActorFade due;
  vsprite_fade fade;
  ASSERT_EQ(vsprite_start_fade(&fade), VSPRITE_OK);
  auto shown = sized<vsprite_shown>(), fading = shown;
  int faded = 0;
  for (int tick = 0; tick < 200; ++tick) {
    vsprite_set_direction(sprite_, &actor_, tick / 9 % 8);
    ASSERT_EQ(vsprite_step(sprite_, &actor_), VSPRITE_OK);
    ASSERT_EQ(vsprite_follow_jumps(sprite_, &actor_, &fade, 4), VSPRITE_OK);
    Actor actor;
    std::memcpy(static_cast<void*>(&actor), &actor_, sizeof actor);
    follow(sprite, actor, due, 4);
    ASSERT_EQ(std::memcmp(&due, &fade, sizeof due), 0) << "tick " << tick;
    ASSERT_EQ(vsprite_show(frames_, &actor_, &fade, 0.25f, &shown, &fading), VSPRITE_OK);
    const ActorPicture picture = actor_picture(sprite, frames, actor, 0.25f);
    ASSERT_EQ(shown.sample, picture.sample);
    ASSERT_EQ(shown.left, picture.top_left.x);
    ASSERT_EQ(shown.top, picture.top_left.y);
    ASSERT_EQ(shown.opacity, 1);
    ASSERT_EQ(shown.stride, static_cast<std::uint32_t>(picture.pixels.stride));
    ASSERT_EQ(std::memcmp(shown.rgba, picture.pixels.rgba, shown.stride * shown.height), 0);
    ASSERT_EQ(fading.opacity, fade_share(due, 0.25f));
    ASSERT_EQ(fading.width > 0, fading.opacity > 0);
    if (fading.width == 0) continue;
    ++faded;
    Image before;
    ASSERT_TRUE(sprite.decode_frame(due.before, before));
    ASSERT_EQ(fading.sample, due.before);
    ASSERT_EQ(std::memcmp(fading.rgba, before.rgba.data(), before.rgba.size()), 0);
  }
  EXPECT_GT(faded, 10);
  EXPECT_EQ(vsprite_show(frames_, &actor_, nullptr, 0, &shown, nullptr), VSPRITE_OK);
}

TEST_F(CApi, AClearCanvasHoldsThePremultipliedPicture) {
  ASSERT_EQ(vsprite_clear_canvas(canvas_, VSPRITE_CLEAR), VSPRITE_OK);
  auto picture = sized<vsprite_picture>();
  ASSERT_EQ(vsprite_get_canvas(canvas_, &picture), VSPRITE_OK);
  for (std::uint32_t k = 0; k < 4 * picture.width; ++k) ASSERT_EQ(picture.rgba[k], 0);
  ASSERT_EQ(vsprite_draw_actor(canvas_, frames_, &actor_, 0, 1), VSPRITE_OK);
  const std::string file = folder_.file("clear.png");
  ASSERT_EQ(vsprite_save_canvas(canvas_, file.c_str()), VSPRITE_OK);
  Image due = *read_png(file);
  premultiply(due);
  ASSERT_EQ(vsprite_get_canvas(canvas_, &picture), VSPRITE_OK);
  int covered = 0;
  for (std::size_t k = 0; k < due.rgba.size(); ++k) {
    EXPECT_NEAR(due.rgba[k], picture.rgba[k], 1) << k;
    covered += due.rgba[k] > 0;
  }
  EXPECT_GT(covered, 100);
}

// Puppets.

TEST_F(CApi, PosesAndDrawsThePuppetsOfAPack) {
  const std::string path = folder_.file("puppets.vsp");
  std::vector<Puppet> made;
  made.push_back(testing::glass_puppet());
  made[0].name = "glass";
  made.push_back(
      testing::still_puppet(testing::speckles(24), {{0, 0}, {24, 0}, {0, 24}}, {{{0, 1, 2}, 3}}));
  ASSERT_TRUE(save_puppets(path_, path, made));
  vsprite_puppets* puppets = nullptr;
  ASSERT_EQ(vsprite_load_puppets(path.c_str(), &puppets), VSPRITE_OK) << vsprite_last_error();
  std::uint32_t count = 0, still = 9;
  ASSERT_EQ(vsprite_count_puppets(puppets, &count), VSPRITE_OK);
  EXPECT_EQ(count, 2u);
  ASSERT_EQ(vsprite_find_puppet(puppets, "still", &still), VSPRITE_OK);
  EXPECT_EQ(still, 1u);
  auto info = sized<vsprite_puppet_info>();
  ASSERT_EQ(vsprite_get_puppet(puppets, still, &info), VSPRITE_OK);
  EXPECT_STREQ(info.name, "still");
  EXPECT_EQ(info.points, 3u);
  EXPECT_EQ(info.parameters, 1u);
  auto parameter = sized<vsprite_parameter>();
  ASSERT_EQ(vsprite_get_parameter(puppets, still, 0, &parameter), VSPRITE_OK);
  EXPECT_STREQ(parameter.name, "t");
  EXPECT_EQ(parameter.high, 1);
  const double value = 0.5;
  auto pose = sized<vsprite_pose>();
  ASSERT_EQ(vsprite_pose_puppet(puppets, still, &value, 1, &pose), VSPRITE_OK);
  EXPECT_EQ(pose.points, 3u);
  EXPECT_EQ(pose.xy[2], 24);
  for (std::uint32_t k = 0; k < count; ++k) {
    Image due = make_image(96, 64, 0x20, 0x40, 0x60);
    PuppetPainter painter;
    render_puppet(made[k], testing::posed(made[k], value), painter, due, {5, 6}, 1.5f);
    ASSERT_EQ(vsprite_clear_canvas(canvas_, 0x204060), VSPRITE_OK);
    ASSERT_EQ(vsprite_draw_puppet(canvas_, puppets, k, &value, 1, 5, 6, 1.5f), VSPRITE_OK);
    auto picture = sized<vsprite_picture>();
    ASSERT_EQ(vsprite_get_canvas(canvas_, &picture), VSPRITE_OK);
    EXPECT_EQ(std::memcmp(picture.rgba, due.rgba.data(), due.rgba.size()), 0) << "puppet " << k;
  }
  EXPECT_EQ(vsprite_close_puppets(&puppets), VSPRITE_OK);
  ASSERT_EQ(vsprite_load_puppets(path_.c_str(), &puppets), VSPRITE_OK) << "a pack without any";
  ASSERT_EQ(vsprite_count_puppets(puppets, &count), VSPRITE_OK);
  EXPECT_EQ(count, 0u);
  EXPECT_EQ(vsprite_close_puppets(&puppets), VSPRITE_OK);
}

TEST_F(CApi, ReachesAsTheEngineDoes) {
  const ArmReach due = reach_for({1, 2}, {9, 5}, 6, 5, -1);
  double shoulder = 0, elbow = 0;
  ASSERT_EQ(vsprite_reach_for(1, 2, 9, 5, 6, 5, -1, &shoulder, &elbow), VSPRITE_OK);
  EXPECT_EQ(shoulder, due.shoulder);
  EXPECT_EQ(elbow, due.elbow);
}

// Reading and memory of the caller's.

struct Shelf {
  std::vector<std::uint8_t> bytes;
  std::atomic<int> reads{0}, closed{0};
  int fails_at = -1;
  static std::int32_t read(void* user, std::uint64_t offset, void* out, std::size_t count) {
    auto* shelf = static_cast<Shelf*>(user);
    if (shelf->reads++ == shelf->fails_at) return 1;
    std::memcpy(out, shelf->bytes.data() + offset, count);
    return 0;
  }
  static void close(void* user) { ++static_cast<Shelf*>(user)->closed; }
  vsprite_source source() {
    return {sizeof(vsprite_source), nullptr, nullptr, bytes.size(), this, read, close};
  }
};

TEST_F(CApi, ReadsAPackThroughCallbacksAndFromMemory) {
  Shelf shelf;
  shelf.bytes = testing::read_bytes(path_);
  vsprite_source from = shelf.source();
  EXPECT_EQ(vsprite_verify_pack(&from, nullptr), VSPRITE_OK) << vsprite_last_error();
  EXPECT_EQ(shelf.closed, 1);
  vsprite_sprite* read = nullptr;
  ASSERT_EQ(vsprite_load_pack_from(&from, nullptr, &read), VSPRITE_OK) << vsprite_last_error();
  vsprite_frames* frames = nullptr;
  ASSERT_EQ(vsprite_make_frames(read, 0, &frames), VSPRITE_OK);
  EXPECT_EQ(vsprite_close_sprite(&read), VSPRITE_OK);
  EXPECT_EQ(read, nullptr);
  vsprite_picture picture{};
  picture.struct_size = sizeof picture;
  ASSERT_EQ(vsprite_get_picture(frames, 4, &picture), VSPRITE_OK);
  EXPECT_GT(picture.width, 0u);
  EXPECT_EQ(shelf.closed, 1) << "the frames still read";
  EXPECT_EQ(vsprite_close_frames(&frames), VSPRITE_OK);
  EXPECT_EQ(shelf.closed, 2);

  vsprite_source memory{};
  memory.struct_size = sizeof memory;
  memory.memory = shelf.bytes.data();
  memory.bytes = shelf.bytes.size();
  ASSERT_EQ(vsprite_load_pack_from(&memory, nullptr, &read), VSPRITE_OK) << vsprite_last_error();
  EXPECT_EQ(vsprite_close_sprite(&read), VSPRITE_OK);
  memory.bytes /= 2;
  EXPECT_EQ(vsprite_load_pack_from(&memory, nullptr, &read), VSPRITE_CORRUPT_DATA);
  EXPECT_EQ(read, nullptr);
  std::uint32_t issues = 0;
  EXPECT_EQ(vsprite_verify_pack(&memory, &issues), VSPRITE_CORRUPT_DATA);
  EXPECT_GE(issues, 1u);
}

TEST_F(CApi, AReaderThatFailsIsClosedAndSaid) {
  const std::vector<std::uint8_t> bytes = testing::read_bytes(path_);
  for (int at = 0; at < 8; ++at) {
    Shelf shelf;
    shelf.bytes = bytes;
    shelf.fails_at = at;
    vsprite_source from = shelf.source();
    vsprite_sprite* read = nullptr;
    EXPECT_EQ(vsprite_load_pack_from(&from, nullptr, &read), VSPRITE_CANNOT_READ) << "read " << at;
    EXPECT_NE(std::string(vsprite_last_error()).find("reader failed"), std::string::npos);
    EXPECT_EQ(shelf.closed, 1);
    EXPECT_EQ(read, nullptr);
  }
}

struct Pool {
  std::atomic<long> blocks{0}, taken{0}, bytes{0};
  long fails_at = -1;
  static void* allocate(void* user, std::size_t bytes, std::size_t alignment) {
    auto* pool = static_cast<Pool*>(user);
    if (pool->taken++ == pool->fails_at) return nullptr;
    ++pool->blocks;
    pool->bytes += static_cast<long>(bytes);
    return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  }
  static void release(void* user, void* memory, std::size_t bytes, std::size_t) {
    auto* pool = static_cast<Pool*>(user);
    --pool->blocks;
    pool->bytes -= static_cast<long>(bytes);
    std::free(memory);
  }
  vsprite_allocator calls() { return {sizeof(vsprite_allocator), this, allocate, release}; }
};

// Loads, steers, draws and decodes ahead; the code of the first call that failed.
vsprite_status use_all(const vsprite_source& from, Pool& pool) {
  const vsprite_allocator calls = pool.calls();
  vsprite_sprite* sprite = nullptr;
  vsprite_frames* frames = nullptr;
  vsprite_keys* keys = nullptr;
  vsprite_actor actor;
  vsprite_picture picture{};
  picture.struct_size = sizeof picture;
  vsprite_status status = vsprite_load_pack_from(&from, &calls, &sprite);
  if (status == VSPRITE_OK) status = vsprite_make_frames(sprite, 20000, &frames);
  if (status == VSPRITE_OK) status = vsprite_load_keys(sprite, kScript, &keys);
  if (status == VSPRITE_OK) status = vsprite_make_actor(sprite, 0, 0, 0, 1, &actor);
  for (int t = 0; t < 30 && status == VSPRITE_OK; ++t) {
    vsprite_apply_keys(keys, &actor);
    vsprite_step(sprite, &actor);
    vsprite_look_ahead(frames, &actor);
    status = vsprite_get_picture(frames, actor.sample, &picture);
  }
  vsprite_recording* recording = nullptr;
  if (status == VSPRITE_OK) status = vsprite_make_recording(sprite, &actor, 1, &recording);
  for (int t = 0; t < 9 && status == VSPRITE_OK; ++t) {
    status = vsprite_record_keys(recording, 0, &actor, keys);
    if (status == VSPRITE_OK) status = vsprite_record_tick(recording, &actor, 1);
  }
  vsprite_close_sprite(&sprite);
  vsprite_close_keys(&keys);
  vsprite_close_frames(&frames);
  vsprite_close_recording(&recording);
  return status;
}

TEST_F(CApi, TakesAllOfItsMemoryFromTheCallersAllocator) {
  Pool pool;
  const vsprite_source from = source();
  const vsprite_status status = use_all(from, pool);
  if (status == VSPRITE_UNAVAILABLE) GTEST_SKIP() << "this build takes no allocator";
  EXPECT_EQ(status, VSPRITE_OK) << vsprite_last_error();
  EXPECT_GT(pool.taken, 100);
  EXPECT_EQ(pool.blocks, 0);
  EXPECT_EQ(pool.bytes, 0);
}

TEST_F(CApi, WantOfMemoryIsACodeAndLeaksNothing) {
  Pool whole;
  const vsprite_source from = source();
  if (use_all(from, whole) == VSPRITE_UNAVAILABLE) GTEST_SKIP() << "this build takes no allocator";
  long refused = 0;
  for (long at = 0; at < whole.taken; at += 1 + at / 40) {
    Pool pool;
    pool.fails_at = at;
    const vsprite_status status = use_all(from, pool);
    // A picture that finds no memory is replaced by the last good one.
    EXPECT_TRUE(status == VSPRITE_OUT_OF_MEMORY || status == VSPRITE_OK) << vsprite_last_error();
    refused += status == VSPRITE_OUT_OF_MEMORY;
    ASSERT_EQ(pool.blocks, 0) << "allocation " << at;
  }
  EXPECT_GT(refused, 20);
}

// Structs of another size.

TEST_F(CApi, TakesAndFillsStructsOfALaterHeader) {
  struct Later {
    vsprite_info now;
    std::uint64_t more[4];
  } later;
  std::memset(&later, 0xFF, sizeof later);
  later.now.struct_size = sizeof later;
  ASSERT_EQ(vsprite_get_info(sprite_, &later.now), VSPRITE_OK);
  EXPECT_EQ(later.now.struct_size, sizeof later);
  for (const std::uint64_t unknown : later.more) EXPECT_EQ(unknown, 0u);

  struct LaterWish {
    vsprite_wish now;
    std::uint64_t more;
  } wish{};
  wish.now.struct_size = sizeof wish;
  EXPECT_EQ(vsprite_step_wish(sprite_, &actor_, &wish.now), VSPRITE_OK);
  wish.more = 1;
  EXPECT_EQ(vsprite_step_wish(sprite_, &actor_, &wish.now), VSPRITE_UNSUPPORTED_VERSION);
}

// Wrong arguments: every call, every argument, its code.

struct Wrong {
  const char* call;
  const char* what;
  vsprite_status due;
  vsprite_status found;
};

TEST_F(CApi, EveryWrongArgumentHasItsCode) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  constexpr vsprite_status kBad = VSPRITE_BAD_ARGUMENT;
  auto* other = reinterpret_cast<vsprite_sprite*>(frames_);  // a handle of another kind
  auto* no_frames = reinterpret_cast<vsprite_frames*>(sprite_);
  auto* no_keys = reinterpret_cast<vsprite_keys*>(sprite_);
  auto* no_hash = reinterpret_cast<vsprite_hash*>(canvas_);
  auto* no_canvas = reinterpret_cast<vsprite_canvas*>(hash_);
  vsprite_sprite* closed = nullptr;
  ASSERT_EQ(vsprite_load_pack(path_.c_str(), &closed), VSPRITE_OK);
  ASSERT_EQ(vsprite_close_sprite(&closed), VSPRITE_OK);
  vsprite_sprite* out = nullptr;
  vsprite_actor strange = actor_, a = actor_;
  strange.sample = 0;  // not kept
  std::uint32_t n = 0;
  std::uint64_t h = 0;
  float x = 0, y = 0;
  std::int32_t hit = 0;
  const char* name = nullptr;
  vsprite_box box{};
  vsprite_frames* f2 = nullptr;
  vsprite_keys* k2 = nullptr;
  vsprite_canvas* c2 = nullptr;
  vsprite_recording *recording = nullptr, *r2 = nullptr;
  vsprite_replay *replay = nullptr, *p2 = nullptr;
  vsprite_puppets *puppets = nullptr, *u2 = nullptr;
  vsprite_keys* other_keys = nullptr;
  const std::string run = folder_.file("run.vsr"), drawn = folder_.file("drawn.vsp");
  record_two(sprite_, keys_, run, 3);
  ASSERT_TRUE(save_puppets(path_, drawn, std::array{testing::glass_puppet()}));
  ASSERT_EQ(vsprite_make_recording(sprite_, &actor_, 1, &recording), VSPRITE_OK);
  ASSERT_EQ(vsprite_load_replay(sprite_, run.c_str(), &replay), VSPRITE_OK);
  ASSERT_EQ(vsprite_load_puppets(drawn.c_str(), &puppets), VSPRITE_OK);
  ASSERT_EQ(vsprite_load_pack(path_.c_str(), &out), VSPRITE_OK);
  ASSERT_EQ(vsprite_load_keys(out, "0 right", &other_keys), VSPRITE_OK);
  ASSERT_EQ(vsprite_close_sprite(&out), VSPRITE_OK);
  auto* no_recording = reinterpret_cast<vsprite_recording*>(replay);
  auto* no_replay = reinterpret_cast<vsprite_replay*>(recording);
  auto* no_puppets = reinterpret_cast<vsprite_puppets*>(canvas_);
  std::array<vsprite_actor, 2> two_actors{actor_, actor_};
  const auto shape = command_of(VSPRITE_DO_DIRECTION);
  auto no_kind = shape, no_direction = shape, bad_action = command_of(VSPRITE_DO_PLAY);
  auto bad_within = command_of(VSPRITE_DO_RELEASE), bad_radius = command_of(VSPRITE_DO_TARGET);
  auto bad_heading = command_of(VSPRITE_DO_HEADING), bad_factor = command_of(VSPRITE_DO_SCALED);
  auto late_play = command_of(VSPRITE_DO_PLAY), small_command = shape;
  no_kind.kind = 10;
  no_direction.direction = 10;
  bad_action.action = 77;
  bad_within.within = 65536;
  bad_radius.radius = -1;
  bad_heading.x = kNaN;
  bad_factor.y = 17;
  late_play.within = -2;
  small_command.struct_size = 4;
  auto run_info = sized<vsprite_replay_info>(), small_run = sized<vsprite_replay_info>(4);
  auto shown = sized<vsprite_shown>(), small_shown = sized<vsprite_shown>(4);
  auto puppet = sized<vsprite_puppet_info>(), small_puppet = sized<vsprite_puppet_info>(4);
  auto parameter = sized<vsprite_parameter>(), small_parameter = sized<vsprite_parameter>(4);
  auto pose = sized<vsprite_pose>(), small_pose = sized<vsprite_pose>(4);
  vsprite_fade fade{}, no_fade{};
  vsprite_start_fade(&fade);
  no_fade.before = 0xFFFFFFFE;
  vsprite_fade ended = fade;  // a length that no fade has
  ended.before = 1, ended.length = 200;
  const double half_way = 0.5, no_number = kNaN;
  double angle = 0;
  auto info = sized<vsprite_info>(), small_info = sized<vsprite_info>(8);
  auto sample = sized<vsprite_sample>(), no_sample = sized<vsprite_sample>(0);
  float scale = 0;
  auto picture = sized<vsprite_picture>(), huge = sized<vsprite_picture>(0xFFFFFFFF);
  auto stats = sized<vsprite_frames_stats>(), small_stats = sized<vsprite_frames_stats>(4);
  auto events = sized<vsprite_tick_events>(), no_events = sized<vsprite_tick_events>(0);
  auto wish = sized<vsprite_wish>(), small_wish = sized<vsprite_wish>(4);
  auto bad_slack = wish, bad_pace = wish;
  bad_slack.slack = -1;
  bad_pace.pace = 3;
  auto report = sized<vsprite_replay_report>(), small_report = sized<vsprite_replay_report>(1);
  vsprite_source path = source(), small = path, none = path, two = path;
  small.struct_size = 8;
  none.path = nullptr;
  two.memory = "x";
  vsprite_allocator whole{sizeof whole, nullptr, Pool::allocate, Pool::release};
  vsprite_allocator half = whole, small_allocator = whole;
  half.release = nullptr;
  small_allocator.struct_size = 12;
  struct {
    vsprite_source now;
    std::uint64_t more;
  } future{path, 5};
  future.now.struct_size = sizeof future;
  const std::string missing = folder_.file("missing.vsp"), text = folder_.file("text.vsp");
  testing::write_bytes(text, std::vector<std::uint8_t>(200, 'x'));
  const std::string no_folder = folder_.file("no/such.png");

#define WRONG(call, what, due, ...) \
  { #call, what, due, call(__VA_ARGS__) }
  const Wrong table[] = {
      WRONG(vsprite_load_pack, "path", kBad, nullptr, &out),
      WRONG(vsprite_load_pack, "result", kBad, path_.c_str(), nullptr),
      WRONG(vsprite_load_pack, "missing", VSPRITE_NOT_FOUND, missing.c_str(), &out),
      WRONG(vsprite_load_pack, "text", VSPRITE_BAD_FORMAT, text.c_str(), &out),
      WRONG(vsprite_load_pack, "folder", VSPRITE_CANNOT_READ, folder_.path().c_str(), &out),
      WRONG(vsprite_load_pack_from, "source", kBad, nullptr, nullptr, &out),
      WRONG(vsprite_load_pack_from, "size", kBad, &small, nullptr, &out),
      WRONG(vsprite_load_pack_from, "future", VSPRITE_UNSUPPORTED_VERSION, &future.now, nullptr,
            &out),
      WRONG(vsprite_load_pack_from, "nothing", kBad, &none, nullptr, &out),
      WRONG(vsprite_load_pack_from, "two", kBad, &two, nullptr, &out),
      WRONG(vsprite_load_pack_from, "half", kBad, &path, &half, &out),
      WRONG(vsprite_load_pack_from, "allocator", kBad, &path, &small_allocator, &out),
      WRONG(vsprite_load_pack_from, "result", kBad, &path, nullptr, nullptr),
      WRONG(vsprite_close_sprite, "null", kBad, nullptr),
      WRONG(vsprite_close_sprite, "kind", kBad, &other),
      WRONG(vsprite_verify_pack, "source", kBad, nullptr, &n),
      WRONG(vsprite_verify_pack, "nothing", kBad, &none, &n),
      WRONG(vsprite_verify_pack, "size", kBad, &small, &n),
      WRONG(vsprite_get_info, "sprite", kBad, nullptr, &info),
      WRONG(vsprite_get_info, "kind", kBad, other, &info),
      WRONG(vsprite_get_info, "result", kBad, sprite_, nullptr),
      WRONG(vsprite_get_info, "size", kBad, sprite_, &small_info),
      WRONG(vsprite_get_sample, "sprite", kBad, closed, 1, &sample),
      WRONG(vsprite_get_sample, "index", kBad, sprite_, 1000000, &sample),
      WRONG(vsprite_get_sample, "result", kBad, sprite_, 1, nullptr),
      WRONG(vsprite_get_sample, "size", kBad, sprite_, 1, &no_sample),
      WRONG(vsprite_get_name, "sprite", kBad, closed, VSPRITE_TAG, 0, &name),
      WRONG(vsprite_get_name, "kind", kBad, sprite_, 4, 0, &name),
      WRONG(vsprite_get_name, "kind", kBad, sprite_, -1, 0, &name),
      WRONG(vsprite_get_name, "index", kBad, sprite_, VSPRITE_TAG, 999, &name),
      WRONG(vsprite_get_name, "result", kBad, sprite_, VSPRITE_TAG, 0, nullptr),
      WRONG(vsprite_find, "sprite", kBad, closed, VSPRITE_TAG, "x", &n),
      WRONG(vsprite_find, "kind", kBad, sprite_, 7, "x", &n),
      WRONG(vsprite_find, "name", kBad, sprite_, VSPRITE_TAG, nullptr, &n),
      WRONG(vsprite_find, "result", kBad, sprite_, VSPRITE_TAG, "x", nullptr),
      WRONG(vsprite_find, "unknown", VSPRITE_NOT_FOUND, sprite_, VSPRITE_TAG, "x", &n),
      WRONG(vsprite_make_actor, "sprite", kBad, closed, 0, 0, 0, 0, &a),
      WRONG(vsprite_make_actor, "place", kBad, sprite_, kNaN, 0, 0, 0, &a),
      WRONG(vsprite_make_actor, "mode", kBad, sprite_, 0, 0, 0, 2, &a),
      WRONG(vsprite_make_actor, "result", kBad, sprite_, 0, 0, 0, 0, nullptr),
      WRONG(vsprite_check_actor, "sprite", kBad, closed, &a),
      WRONG(vsprite_check_actor, "actor", kBad, sprite_, nullptr),
      WRONG(vsprite_check_actor, "state", kBad, sprite_, &strange),
      WRONG(vsprite_set_direction, "sprite", kBad, closed, &a, 0),
      WRONG(vsprite_set_direction, "actor", kBad, sprite_, nullptr, 0),
      WRONG(vsprite_set_direction, "state", kBad, sprite_, &strange, 0),
      WRONG(vsprite_set_direction, "direction", kBad, sprite_, &a, 10),
      WRONG(vsprite_set_direction, "direction", kBad, sprite_, &a, -1),
      WRONG(vsprite_set_heading, "sprite", kBad, other, &a, 1, 0),
      WRONG(vsprite_set_heading, "actor", kBad, sprite_, nullptr, 1, 0),
      WRONG(vsprite_set_heading, "number", kBad, sprite_, &a, kInf, 0),
      WRONG(vsprite_set_target, "sprite", kBad, closed, &a, 1, 0, 1),
      WRONG(vsprite_set_target, "actor", kBad, sprite_, nullptr, 1, 0, 1),
      WRONG(vsprite_set_target, "number", kBad, sprite_, &a, 1, kNaN, 1),
      WRONG(vsprite_set_target, "radius", kBad, sprite_, &a, 1, 1, -1),
      WRONG(vsprite_step, "sprite", kBad, closed, &a),
      WRONG(vsprite_step, "kind", kBad, other, &a),
      WRONG(vsprite_step, "actor", kBad, sprite_, nullptr),
      WRONG(vsprite_step, "state", kBad, sprite_, &strange),
      WRONG(vsprite_step_many, "sprite", kBad, closed, &a, 1),
      WRONG(vsprite_step_many, "actors", kBad, sprite_, nullptr, 1),
      WRONG(vsprite_step_many, "state", kBad, sprite_, &strange, 1),
      WRONG(vsprite_step_many, "none", VSPRITE_OK, sprite_, nullptr, 0),
      WRONG(vsprite_step_wish, "sprite", kBad, closed, &a, &wish),
      WRONG(vsprite_step_wish, "actor", kBad, sprite_, nullptr, &wish),
      WRONG(vsprite_step_wish, "wish", kBad, sprite_, &a, nullptr),
      WRONG(vsprite_step_wish, "size", kBad, sprite_, &a, &small_wish),
      WRONG(vsprite_step_wish, "slack", kBad, sprite_, &a, &bad_slack),
      WRONG(vsprite_step_wish, "pace", kBad, sprite_, &a, &bad_pace),
      WRONG(vsprite_draw_position, "sprite", kBad, closed, &a, 0, &x, &y),
      WRONG(vsprite_draw_position, "actor", kBad, sprite_, nullptr, 0, &x, &y),
      WRONG(vsprite_draw_position, "fraction", kBad, sprite_, &a, 1.5f, &x, &y),
      WRONG(vsprite_draw_position, "fraction", kBad, sprite_, &a, kNaN, &x, &y),
      WRONG(vsprite_draw_position, "result", kBad, sprite_, &a, 0, nullptr, &y),
      WRONG(vsprite_draw_position, "result", kBad, sprite_, &a, 0, &x, nullptr),
      WRONG(vsprite_get_events, "sprite", kBad, closed, &a, &events),
      WRONG(vsprite_get_events, "actor", kBad, sprite_, nullptr, &events),
      WRONG(vsprite_get_events, "result", kBad, sprite_, &a, nullptr),
      WRONG(vsprite_get_events, "size", kBad, sprite_, &a, &no_events),
      WRONG(vsprite_play, "sprite", kBad, closed, &a, 0, -1, 0),
      WRONG(vsprite_play, "actor", kBad, sprite_, nullptr, 0, -1, 0),
      WRONG(vsprite_play, "action", kBad, sprite_, &a, 77, -1, 0),
      WRONG(vsprite_play, "within", kBad, sprite_, &a, 0, -2, 0),
      WRONG(vsprite_play, "within", kBad, sprite_, &a, 0, 65536, 0),
      WRONG(vsprite_queue, "sprite", kBad, closed, &a, 0, 0),
      WRONG(vsprite_queue, "actor", kBad, sprite_, nullptr, 0, 0),
      WRONG(vsprite_queue, "action", kBad, sprite_, &a, 77, 0),
      WRONG(vsprite_release, "sprite", kBad, closed, &a, -1),
      WRONG(vsprite_release, "actor", kBad, sprite_, nullptr, -1),
      WRONG(vsprite_release, "within", kBad, sprite_, &a, 70000),
      WRONG(vsprite_cancel, "sprite", kBad, closed, &a),
      WRONG(vsprite_cancel, "actor", kBad, sprite_, nullptr),
      WRONG(vsprite_follow, "sprite", kBad, closed, &a, 1, 1),
      WRONG(vsprite_follow, "actor", kBad, sprite_, nullptr, 1, 1),
      WRONG(vsprite_follow, "number", kBad, sprite_, &a, 1, kNaN),
      WRONG(vsprite_own_scaled, "sprite", kBad, closed, &a, 1, 1),
      WRONG(vsprite_own_scaled, "actor", kBad, sprite_, nullptr, 1, 1),
      WRONG(vsprite_own_scaled, "factor", kBad, sprite_, &a, 17, 1),
      WRONG(vsprite_own_scaled, "factor", kBad, sprite_, &a, 1, kNaN),
      WRONG(vsprite_own_recorded, "sprite", kBad, closed, &a),
      WRONG(vsprite_own_recorded, "actor", kBad, sprite_, nullptr),
      WRONG(vsprite_make_frames, "sprite", kBad, closed, 0, &f2),
      WRONG(vsprite_make_frames, "result", kBad, sprite_, 0, nullptr),
      WRONG(vsprite_close_frames, "null", kBad, nullptr),
      WRONG(vsprite_close_frames, "kind", kBad, &no_frames),
      WRONG(vsprite_get_picture, "frames", kBad, nullptr, 1, &picture),
      WRONG(vsprite_get_picture, "kind", kBad, no_frames, 1, &picture),
      WRONG(vsprite_get_picture, "index", kBad, frames_, 1000000, &picture),
      WRONG(vsprite_get_picture, "result", kBad, frames_, 1, nullptr),
      WRONG(vsprite_get_picture, "size", kBad, frames_, 1, &huge),
      WRONG(vsprite_get_shadow, "frames", kBad, nullptr, 1, &picture, &scale),
      WRONG(vsprite_get_shadow, "kind", kBad, no_frames, 1, &picture, &scale),
      WRONG(vsprite_get_shadow, "index", kBad, frames_, 1000000, &picture, &scale),
      WRONG(vsprite_get_shadow, "result", kBad, frames_, 1, &picture, nullptr),
      WRONG(vsprite_get_shadow, "size", kBad, frames_, 1, &huge, &scale),
      WRONG(vsprite_look_ahead, "frames", kBad, nullptr, &a),
      WRONG(vsprite_look_ahead, "actor", kBad, frames_, nullptr),
      WRONG(vsprite_look_ahead, "state", kBad, frames_, &strange),
      WRONG(vsprite_get_frames_stats, "frames", kBad, nullptr, &stats),
      WRONG(vsprite_get_frames_stats, "result", kBad, frames_, nullptr),
      WRONG(vsprite_get_frames_stats, "size", kBad, frames_, &small_stats),
      WRONG(vsprite_body_box, "sprite", kBad, closed, &a, 1, &box),
      WRONG(vsprite_body_box, "actor", kBad, sprite_, nullptr, 1, &box),
      WRONG(vsprite_body_box, "scale", kBad, sprite_, &a, 0, &box),
      WRONG(vsprite_body_box, "result", kBad, sprite_, &a, 1, nullptr),
      WRONG(vsprite_drawn_box, "sprite", kBad, closed, &a, 1, &box),
      WRONG(vsprite_drawn_box, "actor", kBad, sprite_, nullptr, 1, &box),
      WRONG(vsprite_drawn_box, "scale", kBad, sprite_, &a, kNaN, &box),
      WRONG(vsprite_drawn_box, "result", kBad, sprite_, &a, 1, nullptr),
      WRONG(vsprite_hit, "frames", kBad, nullptr, &a, 1, 1, 1, 128, &hit),
      WRONG(vsprite_hit, "actor", kBad, frames_, nullptr, 1, 1, 1, 128, &hit),
      WRONG(vsprite_hit, "number", kBad, frames_, &a, kNaN, 1, 1, 128, &hit),
      WRONG(vsprite_hit, "alpha", kBad, frames_, &a, 1, 1, 1, 256, &hit),
      WRONG(vsprite_hit, "result", kBad, frames_, &a, 1, 1, 1, 128, nullptr),
      WRONG(vsprite_load_keys, "sprite", kBad, closed, "0 right", &k2),
      WRONG(vsprite_load_keys, "script", kBad, sprite_, nullptr, &k2),
      WRONG(vsprite_load_keys, "result", kBad, sprite_, "0 right", nullptr),
      WRONG(vsprite_load_keys, "sideways", VSPRITE_BAD_SETTING, sprite_, "0 sideways", &k2),
      WRONG(vsprite_load_keys, "action", VSPRITE_BAD_SETTING, sprite_, "0 play fly", &k2),
      WRONG(vsprite_close_keys, "null", kBad, nullptr),
      WRONG(vsprite_close_keys, "kind", kBad, &no_keys),
      WRONG(vsprite_apply_keys, "keys", kBad, nullptr, &a),
      WRONG(vsprite_apply_keys, "kind", kBad, no_keys, &a),
      WRONG(vsprite_apply_keys, "actor", kBad, keys_, nullptr),
      WRONG(vsprite_apply_keys, "state", kBad, keys_, &strange),
      WRONG(vsprite_make_hash, "result", kBad, nullptr),
      WRONG(vsprite_close_hash, "null", kBad, nullptr),
      WRONG(vsprite_close_hash, "kind", kBad, &no_hash),
      WRONG(vsprite_add_to_hash, "hash", kBad, no_hash, &a),
      WRONG(vsprite_add_to_hash, "actor", kBad, hash_, nullptr),
      WRONG(vsprite_get_hash, "hash", kBad, nullptr, &h),
      WRONG(vsprite_get_hash, "result", kBad, hash_, nullptr),
      WRONG(vsprite_hash_actors, "actors", kBad, nullptr, 1, &h),
      WRONG(vsprite_hash_actors, "result", kBad, &a, 1, nullptr),
      WRONG(vsprite_run_replay, "sprite", kBad, closed, path_.c_str(), &report),
      WRONG(vsprite_run_replay, "path", kBad, sprite_, nullptr, &report),
      WRONG(vsprite_run_replay, "result", kBad, sprite_, path_.c_str(), nullptr),
      WRONG(vsprite_run_replay, "size", kBad, sprite_, path_.c_str(), &small_report),
      WRONG(vsprite_run_replay, "a pack", VSPRITE_BAD_FORMAT, sprite_, path_.c_str(), &report),
      WRONG(vsprite_start_fade, "result", kBad, nullptr),
      WRONG(vsprite_follow_jumps, "sprite", kBad, closed, &a, &fade, 2),
      WRONG(vsprite_follow_jumps, "actor", kBad, sprite_, nullptr, &fade, 2),
      WRONG(vsprite_follow_jumps, "state", kBad, sprite_, &strange, &fade, 2),
      WRONG(vsprite_follow_jumps, "fade", kBad, sprite_, &a, nullptr, 2),
      WRONG(vsprite_follow_jumps, "fade's state", kBad, sprite_, &a, &no_fade, 2),
      WRONG(vsprite_follow_jumps, "fade's length", kBad, sprite_, &a, &ended, 2),
      WRONG(vsprite_follow_jumps, "ticks", kBad, sprite_, &a, &fade, 1),
      WRONG(vsprite_follow_jumps, "ticks", kBad, sprite_, &a, &fade, 7),
      WRONG(vsprite_follow_jumps, "ticks", kBad, sprite_, &a, &fade, -2),
      WRONG(vsprite_show, "frames", kBad, no_frames, &a, nullptr, 0, &shown, nullptr),
      WRONG(vsprite_show, "actor", kBad, frames_, nullptr, nullptr, 0, &shown, nullptr),
      WRONG(vsprite_show, "state", kBad, frames_, &strange, nullptr, 0, &shown, nullptr),
      WRONG(vsprite_show, "fraction", kBad, frames_, &a, nullptr, kNaN, &shown, nullptr),
      WRONG(vsprite_show, "result", kBad, frames_, &a, nullptr, 0, nullptr, nullptr),
      WRONG(vsprite_show, "size", kBad, frames_, &a, nullptr, 0, &small_shown, nullptr),
      WRONG(vsprite_show, "no fade", kBad, frames_, &a, nullptr, 0, &shown, &shown),
      WRONG(vsprite_show, "no fading", kBad, frames_, &a, &fade, 0, &shown, nullptr),
      WRONG(vsprite_show, "fading's size", kBad, frames_, &a, &fade, 0, &shown, &small_shown),
      WRONG(vsprite_show, "fade's state", kBad, frames_, &a, &no_fade, 0, &shown, &shown),
      WRONG(vsprite_make_recording, "sprite", kBad, closed, &a, 1, &r2),
      WRONG(vsprite_make_recording, "actors", kBad, sprite_, nullptr, 1, &r2),
      WRONG(vsprite_make_recording, "state", kBad, sprite_, &strange, 1, &r2),
      WRONG(vsprite_make_recording, "none", kBad, sprite_, &a, 0, &r2),
      WRONG(vsprite_make_recording, "too many", kBad, sprite_, &a, std::size_t(-1), &r2),
      WRONG(vsprite_make_recording, "result", kBad, sprite_, &a, 1, nullptr),
      WRONG(vsprite_close_recording, "null", kBad, nullptr),
      WRONG(vsprite_close_recording, "kind", kBad, &no_recording),
      WRONG(vsprite_record_command, "recording", kBad, no_recording, 0, &a, &shape),
      WRONG(vsprite_record_command, "index", kBad, recording, 1, &a, &shape),
      WRONG(vsprite_record_command, "actor", kBad, recording, 0, nullptr, &shape),
      WRONG(vsprite_record_command, "state", kBad, recording, 0, &strange, &shape),
      WRONG(vsprite_record_command, "command", kBad, recording, 0, &a, nullptr),
      WRONG(vsprite_record_command, "size", kBad, recording, 0, &a, &small_command),
      WRONG(vsprite_record_command, "kind", kBad, recording, 0, &a, &no_kind),
      WRONG(vsprite_record_command, "direction", kBad, recording, 0, &a, &no_direction),
      WRONG(vsprite_record_command, "action", kBad, recording, 0, &a, &bad_action),
      WRONG(vsprite_record_command, "deadline", kBad, recording, 0, &a, &late_play),
      WRONG(vsprite_record_command, "within", kBad, recording, 0, &a, &bad_within),
      WRONG(vsprite_record_command, "radius", kBad, recording, 0, &a, &bad_radius),
      WRONG(vsprite_record_command, "number", kBad, recording, 0, &a, &bad_heading),
      WRONG(vsprite_record_command, "factor", kBad, recording, 0, &a, &bad_factor),
      WRONG(vsprite_record_keys, "recording", kBad, nullptr, 0, &a, keys_),
      WRONG(vsprite_record_keys, "index", kBad, recording, 1, &a, keys_),
      WRONG(vsprite_record_keys, "actor", kBad, recording, 0, nullptr, keys_),
      WRONG(vsprite_record_keys, "state", kBad, recording, 0, &strange, keys_),
      WRONG(vsprite_record_keys, "keys", kBad, recording, 0, &a, no_keys),
      WRONG(vsprite_record_keys, "other keys", kBad, recording, 0, &a, other_keys),
      WRONG(vsprite_record_tick, "recording", kBad, no_recording, &a, 1),
      WRONG(vsprite_record_tick, "actors", kBad, recording, nullptr, 1),
      WRONG(vsprite_record_tick, "count", kBad, recording, two_actors.data(), 2),
      WRONG(vsprite_record_tick, "state", kBad, recording, &strange, 1),
      WRONG(vsprite_save_recording, "recording", kBad, no_recording, "x.vsr"),
      WRONG(vsprite_save_recording, "path", kBad, recording, nullptr),
      WRONG(vsprite_save_recording, "folder", VSPRITE_CANNOT_CREATE, recording, no_folder.c_str()),
      WRONG(vsprite_load_replay, "sprite", kBad, closed, run.c_str(), &p2),
      WRONG(vsprite_load_replay, "path", kBad, sprite_, nullptr, &p2),
      WRONG(vsprite_load_replay, "result", kBad, sprite_, run.c_str(), nullptr),
      WRONG(vsprite_load_replay, "missing", VSPRITE_NOT_FOUND, sprite_, missing.c_str(), &p2),
      WRONG(vsprite_load_replay, "a pack", VSPRITE_BAD_FORMAT, sprite_, path_.c_str(), &p2),
      WRONG(vsprite_close_replay, "null", kBad, nullptr),
      WRONG(vsprite_close_replay, "kind", kBad, &no_replay),
      WRONG(vsprite_get_replay, "replay", kBad, no_replay, &run_info),
      WRONG(vsprite_get_replay, "result", kBad, replay, nullptr),
      WRONG(vsprite_get_replay, "size", kBad, replay, &small_run),
      WRONG(vsprite_start_replay, "replay", kBad, no_replay, two_actors.data(), 2),
      WRONG(vsprite_start_replay, "actors", kBad, replay, nullptr, 2),
      WRONG(vsprite_start_replay, "count", kBad, replay, two_actors.data(), 1),
      WRONG(vsprite_step_replay, "replay", kBad, nullptr, two_actors.data(), 2),
      WRONG(vsprite_step_replay, "actors", kBad, replay, nullptr, 2),
      WRONG(vsprite_step_replay, "count", kBad, replay, two_actors.data(), 3),
      WRONG(vsprite_load_puppets, "path", kBad, nullptr, &u2),
      WRONG(vsprite_load_puppets, "result", kBad, drawn.c_str(), nullptr),
      WRONG(vsprite_load_puppets, "missing", VSPRITE_NOT_FOUND, missing.c_str(), &u2),
      WRONG(vsprite_load_puppets, "text", VSPRITE_BAD_FORMAT, text.c_str(), &u2),
      WRONG(vsprite_close_puppets, "null", kBad, nullptr),
      WRONG(vsprite_close_puppets, "kind", kBad, &no_puppets),
      WRONG(vsprite_count_puppets, "puppets", kBad, no_puppets, &n),
      WRONG(vsprite_count_puppets, "result", kBad, puppets, nullptr),
      WRONG(vsprite_find_puppet, "puppets", kBad, nullptr, "still", &n),
      WRONG(vsprite_find_puppet, "name", kBad, puppets, nullptr, &n),
      WRONG(vsprite_find_puppet, "result", kBad, puppets, "still", nullptr),
      WRONG(vsprite_find_puppet, "unknown", VSPRITE_NOT_FOUND, puppets, "ghost", &n),
      WRONG(vsprite_get_puppet, "puppets", kBad, no_puppets, 0, &puppet),
      WRONG(vsprite_get_puppet, "index", kBad, puppets, 1, &puppet),
      WRONG(vsprite_get_puppet, "result", kBad, puppets, 0, nullptr),
      WRONG(vsprite_get_puppet, "size", kBad, puppets, 0, &small_puppet),
      WRONG(vsprite_get_parameter, "puppets", kBad, no_puppets, 0, 0, &parameter),
      WRONG(vsprite_get_parameter, "index", kBad, puppets, 1, 0, &parameter),
      WRONG(vsprite_get_parameter, "parameter", kBad, puppets, 0, 1, &parameter),
      WRONG(vsprite_get_parameter, "result", kBad, puppets, 0, 0, nullptr),
      WRONG(vsprite_get_parameter, "size", kBad, puppets, 0, 0, &small_parameter),
      WRONG(vsprite_pose_puppet, "puppets", kBad, no_puppets, 0, &half_way, 1, &pose),
      WRONG(vsprite_pose_puppet, "index", kBad, puppets, 1, &half_way, 1, &pose),
      WRONG(vsprite_pose_puppet, "values", kBad, puppets, 0, nullptr, 1, &pose),
      WRONG(vsprite_pose_puppet, "count", kBad, puppets, 0, &half_way, 2, &pose),
      WRONG(vsprite_pose_puppet, "number", kBad, puppets, 0, &no_number, 1, &pose),
      WRONG(vsprite_pose_puppet, "result", kBad, puppets, 0, &half_way, 1, nullptr),
      WRONG(vsprite_pose_puppet, "size", kBad, puppets, 0, &half_way, 1, &small_pose),
      WRONG(vsprite_draw_puppet, "canvas", kBad, no_canvas, puppets, 0, &half_way, 1, 0, 0, 1),
      WRONG(vsprite_draw_puppet, "puppets", kBad, canvas_, no_puppets, 0, &half_way, 1, 0, 0, 1),
      WRONG(vsprite_draw_puppet, "index", kBad, canvas_, puppets, 1, &half_way, 1, 0, 0, 1),
      WRONG(vsprite_draw_puppet, "values", kBad, canvas_, puppets, 0, nullptr, 1, 0, 0, 1),
      WRONG(vsprite_draw_puppet, "count", kBad, canvas_, puppets, 0, &half_way, 0, 0, 0, 1),
      WRONG(vsprite_draw_puppet, "number", kBad, canvas_, puppets, 0, &no_number, 1, 0, 0, 1),
      WRONG(vsprite_draw_puppet, "place", kBad, canvas_, puppets, 0, &half_way, 1, kInf, 0, 1),
      WRONG(vsprite_draw_puppet, "scale", kBad, canvas_, puppets, 0, &half_way, 1, 0, 0, 0),
      WRONG(vsprite_reach_for, "place", kBad, 0, kNaN, 1, 1, 1, 1, 1, &angle, &angle),
      WRONG(vsprite_reach_for, "target", kBad, 0, 0, 1, kInf, 1, 1, 1, &angle, &angle),
      WRONG(vsprite_reach_for, "upper", kBad, 0, 0, 1, 1, 0, 1, 1, &angle, &angle),
      WRONG(vsprite_reach_for, "lower", kBad, 0, 0, 1, 1, 1, kNaN, 1, &angle, &angle),
      WRONG(vsprite_reach_for, "bend", kBad, 0, 0, 1, 1, 1, 1, 0, &angle, &angle),
      WRONG(vsprite_reach_for, "result", kBad, 0, 0, 1, 1, 1, 1, 1, nullptr, &angle),
      WRONG(vsprite_reach_for, "result", kBad, 0, 0, 1, 1, 1, 1, 1, &angle, nullptr),
      WRONG(vsprite_make_canvas, "colour", kBad, 1, 1, 0xFF9CC4D8, &c2),
      WRONG(vsprite_clear_canvas, "colour", kBad, canvas_, 0x1000001),
      WRONG(vsprite_make_canvas, "width", kBad, 0, 1, 0, &c2),
      WRONG(vsprite_make_canvas, "height", kBad, 1, 16385, 0, &c2),
      WRONG(vsprite_make_canvas, "result", kBad, 1, 1, 0, nullptr),
      WRONG(vsprite_close_canvas, "null", kBad, nullptr),
      WRONG(vsprite_close_canvas, "kind", kBad, &no_canvas),
      WRONG(vsprite_clear_canvas, "canvas", kBad, no_canvas, 0),
      WRONG(vsprite_draw_actor, "canvas", kBad, nullptr, frames_, &a, 0, 1),
      WRONG(vsprite_draw_actor, "frames", kBad, canvas_, no_frames, &a, 0, 1),
      WRONG(vsprite_draw_actor, "actor", kBad, canvas_, frames_, nullptr, 0, 1),
      WRONG(vsprite_draw_actor, "fraction", kBad, canvas_, frames_, &a, -1, 1),
      WRONG(vsprite_draw_actor, "scale", kBad, canvas_, frames_, &a, 0, kInf),
      WRONG(vsprite_get_canvas, "canvas", kBad, nullptr, &picture),
      WRONG(vsprite_get_canvas, "result", kBad, canvas_, nullptr),
      WRONG(vsprite_get_canvas, "size", kBad, canvas_, &huge),
      WRONG(vsprite_save_canvas, "canvas", kBad, nullptr, "x.png"),
      WRONG(vsprite_save_canvas, "path", kBad, canvas_, nullptr),
      WRONG(vsprite_save_canvas, "folder", VSPRITE_CANNOT_CREATE, canvas_, no_folder.c_str()),
  };
#undef WRONG
  std::set<std::string> tried;
  for (const Wrong& wrong : table) {
    EXPECT_EQ(wrong.found, wrong.due) << wrong.call << ", " << wrong.what;
    tried.insert(wrong.call);
  }
  EXPECT_EQ(std::memcmp(&a, &actor_, sizeof a), 0) << "a call that failed moved the actor";
  // None is missing from the table.
  const std::string declared = vsprite_cdef();
  const std::regex call("vsprite_status (vsprite_[a-z_]+)\\(");
  int calls = 0;
  for (std::sregex_iterator at(declared.begin(), declared.end(), call), end; at != end; ++at) {
    ++calls;
    EXPECT_TRUE(tried.count((*at)[1]) == 1) << (*at)[1] << " is not tried";
  }
  EXPECT_GT(calls, 70);
  EXPECT_EQ(vsprite_close_recording(&recording), VSPRITE_OK);
  EXPECT_EQ(vsprite_close_replay(&replay), VSPRITE_OK);
  EXPECT_EQ(vsprite_close_puppets(&puppets), VSPRITE_OK);
  EXPECT_EQ(vsprite_close_keys(&other_keys), VSPRITE_OK);
}

TEST_F(CApi, BytesFromAStrangerAreRefusedOrPlayed) {
  std::mt19937 random(5);
  int played = 0;
  for (int round = 0; round < 20000; ++round) {
    vsprite_actor a = actor_;
    auto* bytes = reinterpret_cast<unsigned char*>(&a);
    for (unsigned k = 0; k <= random() % 3; ++k)
      bytes[random() % sizeof a] = static_cast<unsigned char>(random());
    if (vsprite_check_actor(sprite_, &a) != VSPRITE_OK) continue;
    ++played;
    vsprite_set_direction(sprite_, &a, static_cast<int>(random() % 10));
    for (int t = 0; t < 5; ++t) ASSERT_EQ(vsprite_step(sprite_, &a), VSPRITE_OK);
  }
  EXPECT_GT(played, 1000);
}

}  // namespace
}  // namespace vsprite
