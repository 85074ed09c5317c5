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
#include "support/tiny_sprite.h"
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
  vsprite_close_sprite(&sprite);
  vsprite_close_keys(&keys);
  vsprite_close_frames(&frames);
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

template <class T>
T sized(std::uint32_t size = sizeof(T)) {
  T value{};
  value.struct_size = size;
  return value;
}

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
  auto info = sized<vsprite_info>(), small_info = sized<vsprite_info>(8);
  auto sample = sized<vsprite_sample>(), no_sample = sized<vsprite_sample>(0);
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
  EXPECT_GT(calls, 40);
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
