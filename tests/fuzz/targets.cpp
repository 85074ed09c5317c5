// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "fuzz/targets.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "pack_format.h"
#include "support/tiny_puppet.h"
#include "vsprite/puppet.h"
#include "vsprite/vsprite.h"

namespace vsprite::fuzz {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

void play(const Sprite& sprite) {
  Image canvas = make_checkerboard(48, 48);
  FrameCache cache(sprite, 100'000);
  for (std::size_t mode = 0; mode < sprite.data().modes.size(); ++mode) {
    Actor actor = make_actor(sprite, {24, 24}, 0, static_cast<int>(mode));
    StateHash hash;
    for (int tick = 0; tick < 200; ++tick) {
      if (tick % 7 == 0) set_direction(sprite, actor, static_cast<Direction>(tick / 7 % 10));
      if (tick > 150) set_target(sprite, actor, {100, -30}, 5);
      step(sprite, actor);
      hash.add(actor);
      require(sprite.samples()[actor.sample].kept == 1);
    }
    const Sample& sample = sprite.samples()[actor.sample];
    draw_shadow(canvas, sprite, actor.sample, {24, 24});
    draw_sample(canvas, cache.frame(actor.sample), sample, {24, 24});
  }
}

}  // namespace

void fuzz_pack(std::span<const std::uint8_t> bytes) {
  const auto issues = detail::verify_pack_from(detail::ByteSource::borrow(bytes, "fuzz.vsp"));
  auto sprite = detail::load_pack_from(detail::ByteSource::borrow(bytes, "fuzz.vsp"));
  const bool valid = issues && issues->empty();
  require(!valid || sprite.has_value());
  if (!sprite) return;
  play(*sprite);
  Image image;
  for (std::uint32_t i = 0; i < sprite->samples().size(); ++i) {
    const bool decoded = sprite->decode_frame(i, image).has_value();
    require(decoded || !valid);
  }
  for (const FilmedShadow& shadow : sprite->data().shadows) {
    const bool decoded = decode_shadow(shadow, image);
    require(decoded || !valid);
  }
}

// Width and height, then the compressed picture; every instruction set must agree about it.
void fuzz_frame(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 2) return;
  const int width = bytes[0] + 1, height = bytes[1] + 1;
  static const int targets = static_cast<int>(detail::frame_targets().size());
  detail::FrameCodec codec;
  Image first, image;
  for (int target = 0; target < targets; ++target) {
    detail::use_frame_target(target);
    const auto to = codec.input(bytes.size() - 2);
    std::copy(bytes.begin() + 2, bytes.end(), to.begin());
    if (!codec.decode(width, height, target == 0 ? first : image)) return;
    require(target == 0 || image.rgba == first.rgba);
  }
  detail::TrimmedImage trimmed;
  std::copy(bytes.begin() + 2, bytes.end(), codec.input(bytes.size() - 2).begin());
  require(codec.decode(width, height, trimmed));
  detail::expand(trimmed, image);
  require(image.rgba == first.rgba);
  const auto again = codec.encode(first);
  const std::vector<std::uint8_t> copy(again.begin(), again.end());
  std::copy(copy.begin(), copy.end(), codec.input(copy.size()).begin());
  require(codec.decode(width, height, image) && image.rgba == first.rgba);
}

void fuzz_png(std::span<const std::uint8_t> bytes) {
  const auto image = decode_png(bytes, "fuzz.png");
  if (!image || image->rgba.size() > 1u << 20) return;
  const auto again = encode_png(*image);
  require(again && decode_png(*again, "again")->rgba == image->rgba);
}

void fuzz_puppet(std::span<const std::uint8_t> bytes) {
  const auto puppets = decode_puppets(bytes, "fuzz.vsp");
  if (!puppets) return require(!puppets.error().message.empty());
  PuppetPainter painter;
  Image canvas = make_checkerboard(24, 24);
  for (const Puppet& puppet : *puppets) {
    if (puppet.faces.size() > 1000) continue;
    PuppetPose pose = make_pose(puppet);
    for (const double share : {-1.0, 0.5}) {
      std::vector<double> at;
      for (const PuppetParameter& p : puppet.parameters)
        at.push_back(p.low + share * (p.high - p.low));
      pose_puppet(puppet, at, pose);
      render_puppet(puppet, pose, painter, canvas, {4, 4});
    }
  }
  const auto again = encode_puppets(*puppets);
  require(again.has_value());
  const auto back = decode_puppets(*again, "again");
  require(back && *encode_puppets(*back) == *again);
}

void fuzz_sets(std::span<const std::uint8_t> bytes) {
  std::vector<Puppet> puppets{testing::puppet_of_two_sets()};
  const auto read = decode_puppet_sets(bytes, "fuzz.vsp", puppets);
  if (!read) return require(!read.error().message.empty());
  PuppetPose pose = make_pose(puppets[0]);
  for (const double x : {5.0, -1e9, 9.0, 1e9, 3.0}) pose_puppet(puppets[0], std::array{x}, pose);
  const auto again = encode_puppet_sets(puppets);
  require(again.has_value());
  require(decode_puppet_sets(*again, "again", puppets) && *encode_puppet_sets(puppets) == *again);
}

void fuzz_script(std::span<const std::uint8_t> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto script = parse_key_script(text, 30);
  if (!script) return require(!script.error().message.empty());
  const auto& entries = script->entries;
  require(std::is_sorted(entries.begin(), entries.end(),
                         [](const auto& a, const auto& b) { return a.tick < b.tick; }));
  for (const ScriptEntry& entry : entries) (void)script->at(entry.tick);
}

namespace {

template <class T>
T get(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}
template <class T>
void put(std::uint8_t* at, T value) {
  std::memcpy(at, &value, sizeof value);
}

// The sums of pictures inside FRAM, by the index as it stands.
void repair_frames(std::span<std::uint8_t> index, std::span<std::uint8_t> frames) {
  for (std::size_t at = 0; at + detail::kFrameBytes <= index.size(); at += detail::kFrameBytes) {
    const auto offset = get<std::uint64_t>(index.data() + at);
    const std::uint64_t bytes = get<std::uint32_t>(index.data() + at + 8);
    if (bytes == 0 || offset > frames.size() || bytes > frames.size() - offset) continue;
    put(index.data() + at + 16, detail::hash_bytes(frames.subspan(offset, bytes)));
  }
}

}  // namespace

std::size_t repair_pack(std::uint8_t* bytes, std::size_t size, std::size_t) {
  if (size < detail::kHeaderBytes) return size;
  std::copy(detail::kMagic.begin(), detail::kMagic.end(), bytes);
  put(bytes + 8, kPackMajor);
  put(bytes + 10, kPackMinor);
  put(bytes + 16, std::uint64_t{size});
  const std::size_t count = std::min<std::size_t>(
      get<std::uint32_t>(bytes + 12), (size - detail::kHeaderBytes) / detail::kEntryBytes);
  const auto section = [&](std::size_t s) -> std::span<std::uint8_t> {
    const std::uint8_t* entry = bytes + detail::kHeaderBytes + s * detail::kEntryBytes;
    const auto offset = get<std::uint64_t>(entry + 8);
    const auto length = get<std::uint64_t>(entry + 16);
    if (offset > size || length > size - offset) return {};
    return {bytes + offset, static_cast<std::size_t>(length)};
  };
  if (count >= 2) repair_frames(section(count - 2), section(count - 1));
  for (std::size_t s = 0; s < count; ++s) {
    put(bytes + detail::kHeaderBytes + s * detail::kEntryBytes + 24,
        detail::hash_bytes(section(s)));
  }
  put(bytes + 24, std::uint64_t{0});
  put(bytes + 24, detail::hash_bytes({bytes, detail::kHeaderBytes + count * detail::kEntryBytes}));
  return size;
}

}  // namespace vsprite::fuzz
