// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One hand-made hostile pack for every way in which a pack can lie with all its sums in order.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <set>
#include <sstream>

#include "support/naive_actions.h"
#include "support/pack_bytes.h"
#include "vsprite/actor.h"
#include "vsprite/compose.h"

namespace vsprite {
namespace {

using testing::ByteVector;
using testing::get_at;
using testing::PackParts;
using testing::put_at;

// Field offsets of PACK.md.
constexpr std::size_t kEntry0 = 64, kEntry1 = 96, kEntry2 = 128;
constexpr std::size_t sample_at(std::size_t i) { return 60 * i; }
constexpr std::size_t frame_at(std::size_t i) { return 24 * i; }
const std::size_t kRows = 8;
const std::size_t kTransitions = 8 + 4 * (testing::kTinySamples + 1);
constexpr std::size_t kModeFixed = 128;
constexpr std::size_t kNext = kModeFixed + 8;  // "paper", padded to 8
constexpr std::size_t kGo = kNext + std::size_t{4} * 40 * testing::kTinySamples;
constexpr std::uint32_t kHuge = 0xFFFFFFF0u;

using EditBytes = std::function<void(ByteVector&)>;
using EditParts = std::function<void(PackParts&)>;

// Damage to header or section table; its sum is made right afterwards.
ByteVector damage_header(const EditBytes& edit) {
  ByteVector bytes = testing::tiny_pack_bytes();
  edit(bytes);
  if (bytes.size() >= 64) testing::seal_header(bytes);
  return bytes;
}

// Damage to a section; all sums are made right afterwards.
ByteVector damage_section(const EditParts& edit,
                          const ByteVector& pack = testing::tiny_pack_bytes()) {
  PackParts parts = PackParts::split(pack);
  edit(parts);
  return parts.join();
}

// Replaces the last picture by other bytes that its own sum fits.
ByteVector replace_last_picture(const ByteVector& picture) {
  return damage_section([&](PackParts& p) {
    ByteVector& index = p["FIDX"].bytes;
    ByteVector& frames = p["FRAM"].bytes;
    const std::size_t last = frame_at(testing::kTinySamples - 1);
    frames.resize(get_at<std::uint64_t>(index, last));
    frames.insert(frames.end(), picture.begin(), picture.end());
    put_at(index, last + 8, static_cast<std::uint32_t>(picture.size()));
    put_at(index, last + 16, detail::hash_bytes(picture));
  });
}

ByteVector compressed(const Image& image) {
  detail::FrameCodec codec;
  const auto bytes = codec.encode(image);
  return {bytes.begin(), bytes.end()};
}

template <class T>
EditParts set(const char* section, std::size_t offset, T value) {
  return [=](PackParts& p) { put_at(p[section].bytes, offset, value); };
}

struct Hostile {
  const char* code;
  const char* message;  // part of it
  ByteVector bytes;
  bool loads = false;  // found by verifying only
};

std::vector<Hostile> header_packs() {
  return {
      {"too-short", "63 bytes", damage_header([](auto& b) { b.resize(63); })},
      {"bad-magic", "not a pack", damage_header([](auto& b) { b[4] = '\n'; })},
      {"version", "pack version 0.0", damage_header([](auto& b) { b[8] = 0; })},
      {"version", "pack version 2.0", damage_header([](auto& b) { b[8] = 2; })},
      {"version", "pack version 256.0", damage_header([](auto& b) {
         std::swap(b[8], b[9]);
         b[9] = 1;
       })},
      {"file-size", "its header says", damage_header([](auto& b) { b.push_back(0); })},
      {"file-size", "its header says 18446744073709551615",
       damage_header([](auto& b) { put_at(b, 16, ~std::uint64_t{0}); })},
      {"section-count", "4294967280 sections",
       damage_header([](auto& b) { put_at(b, 12, kHuge); })},
      {"section-count", "65 sections", damage_header([](auto& b) { put_at(b, 12, 65u); })},
      {"header-sum", "the sum of header",
       [] {
         ByteVector b = testing::tiny_pack_bytes();
         b[24] ^= 1;
         return b;
       }()},
      {"reserved", "reserved bytes", damage_header([](auto& b) { b[40] = 1; })},
      {"section-name", "four capital letters", damage_header([](auto& b) { b[kEntry0] = 'm'; })},
      {"section-version", "version 2", damage_header([](auto& b) { b[kEntry0 + 4] = 2; })},
      {"section-version", "flags 1", damage_header([](auto& b) { b[kEntry0 + 6] = 1; })},
      {"section-align", "no multiple of 64", damage_header([](auto& b) { b[kEntry1 + 8] += 8; })},
      {"section-bounds", "reach beyond",
       damage_header([](auto& b) { put_at(b, kEntry1 + 16, ~std::uint64_t{0}); })},
      {"section-bounds", "at 18446744073709551552", damage_header([](auto& b) {
         put_at(b, kEntry1 + 8, ~std::uint64_t{63});
         put_at(b, kEntry1 + 16, std::uint64_t{128});
       })},
      {"section-overlap", "before the end", damage_header([](auto& b) {
         put_at(b, kEntry1 + 8, get_at<std::uint64_t>(b, kEntry0 + 8));
       })},
      {"section-overlap", "starts at 0",
       damage_header([](auto& b) { put_at(b, kEntry0 + 8, std::uint64_t{0}); })},
      {"section-gap", "a gap after", damage_header([](auto& b) {
         put_at(b, kEntry2 + 8, get_at<std::uint64_t>(b, kEntry2 + 8) + 64);
       })},
      {"trailing-bytes", "ends before the file", damage_header([](auto& b) {
         b.insert(b.end(), 8, 0);
         put_at(b, 16, std::uint64_t{b.size()});
       })},
      {"section-missing", "SAMP: is missing", damage_header([](auto& b) { b[kEntry1] = 'X'; })},
      {"section-missing", "CTRL: is missing", damage_section([](auto& p) {
         p["CTRL"].name = "ZTRL";
         p["CTRL"].name = "ZTRL";
       })},
      {"section-twice", "SAMP: stands there twice",
       damage_header([](auto& b) { std::copy_n(b.begin() + kEntry1, 4, b.begin() + kEntry2); })},
      {"mode-count", "17 modes", damage_section([](auto& p) {
         const auto mode = p["CTRL"];
         for (int i = 0; i < 15; ++i) p.parts.insert(p.parts.begin() + 3, mode);
       })},
      {"section-sum", "META: the section's sum",
       [] {
         ByteVector b = testing::tiny_pack_bytes();
         b[get_at<std::uint64_t>(b, kEntry0 + 8)] ^= 1;
         return b;
       }()},
      {"padding", "before the section",
       [] {
         ByteVector b = testing::tiny_pack_bytes();
         b[get_at<std::uint64_t>(b, kEntry1 + 8) - 1] = 1;
         return b;
       }(),
       true},
  };
}

std::vector<Hostile> meta_packs() {
  return {
      {"meta-size", "need 32 bytes, 31",
       damage_section([](auto& p) { p["META"].bytes.resize(31); })},
      {"meta-size", "bytes too many",
       damage_section([](auto& p) { p["META"].bytes.push_back(0); })},
      {"reserved", "reserved bytes", damage_section(set<std::uint8_t>("META", 24, 1))},
      {"tag-count", "4294967280 tags", damage_section(set("META", 20, kHuge))},
      {"tag-count", "0 tags", damage_section([](auto& p) {
         put_at(p["META"].bytes, 20, 0u);
         p["META"].bytes.resize(38);
       })},
      {"text-size", "65535 bytes", damage_section(set<std::uint16_t>("META", 32, 65535))},
      {"text-size", "length is cut off", damage_section(set("META", 20, 3u))},
      {"text", "control character", damage_section(set<char>("META", 35, '\x1B'))},
      {"fps", "rate of 0/1", damage_section(set("META", 0, 0u))},
      {"body-length", "not a finite",
       damage_section(set("META", 8, std::numeric_limits<float>::infinity()))},
      {"start-sample", "start sample 0", damage_section(set("META", 12, 0u))},
      {"start-sample", "start sample 4294967280", damage_section(set("META", 12, kHuge))},
      {"samp-size", "0 samples: need 0", damage_section(set("META", 16, 0u))},
      {"samp-size", "4294967280 samples", damage_section(set("META", 16, kHuge))},
      {"sample-count", "0 samples, 1 to", damage_section([](auto& p) {
         put_at(p["META"].bytes, 16, 0u);
         p["SAMP"].bytes.clear();
         p["TRAN"].bytes.assign(12, 0);
         p["CTRL"].bytes.resize(kNext);
         p.parts[4].bytes.resize(kModeFixed + 12);
       })},
  };
}

std::vector<Hostile> sample_packs() {
  const float nan = std::nanf("");
  return {
      {"sample-value", "sample 3", damage_section(set("SAMP", sample_at(3), nan))},
      {"sample-range", "area below 0", damage_section(set("SAMP", sample_at(3) + 24, -1.0f))},
      {"sample-range", "scale", damage_section(set("SAMP", sample_at(3) + 28, 0.0f))},
      {"picture-size", "0 x 21", damage_section(set<std::uint16_t>("SAMP", sample_at(1) + 32, 0))},
      {"picture-size", "5 x 0", damage_section(set<std::uint16_t>("SAMP", sample_at(0) + 32, 5))},
      {"picture-size", "65535 x 65535", damage_section(set("SAMP", sample_at(3) + 32, ~0u))},
      {"duration", "sample 3", damage_section(set<std::uint16_t>("SAMP", sample_at(3) + 36, 0))},
      {"tag-index", "tag 2 of 2", damage_section(set<std::uint16_t>("SAMP", sample_at(3) + 38, 2))},
      {"mirror-index", "sample 103 of 103", damage_section(set("SAMP", sample_at(3) + 48, 103u))},
      {"skip-cost", "not >= 0", damage_section(set("SAMP", sample_at(3) + 56, -0.5f))},
      {"skip-cost", "not >= 0", damage_section(set("SAMP", sample_at(3) + 56, nan))},
      {"skip-cost", "same clip", damage_section(set("SAMP", sample_at(12) + 56, 0.5f))},
      {"skip-cost", "same clip", damage_section(set("SAMP", sample_at(101) + 56, 0.5f))},
      {"kept-flag", "kept is 2", damage_section(set("SAMP", sample_at(3) + 52, 2u))},
  };
}

std::vector<Hostile> transition_packs() {
  const float nan = std::nanf("");
  return {
      {"tran-size", "104 row starts", damage_section([](auto& p) { p["TRAN"].bytes.resize(40); })},
      {"tran-size", "4294967280 transitions", damage_section(set("TRAN", 0, std::uint64_t{kHuge}))},
      {"tran-size", "2305843009213693952 transitions",
       damage_section(set("TRAN", 0, std::uint64_t{1} << 61))},
      {"row-order", "row starts", damage_section(set("TRAN", kRows + 8, kHuge))},
      {"row-order", "row starts", damage_section(set("TRAN", kRows, 1u))},
      {"transition-index", "to sample 103", damage_section(set("TRAN", kTransitions, 103u))},
      {"transition-order", "ascending", damage_section(set("TRAN", kTransitions + 8, 2u))},
      {"transition-cost", "the cost to", damage_section(set("TRAN", kTransitions + 4, nan))},
      {"transition-cost", "the cost to", damage_section(set("TRAN", kTransitions + 4, -0.5f))},
      {"transition-kept", "not kept", damage_section(set("TRAN", kTransitions, 0u))},
  };
}

std::vector<Hostile> mode_packs() {
  const float nan = std::nanf("");
  return {
      {"ctrl-size", "need 128 bytes", damage_section([](auto& p) { p["CTRL"].bytes.resize(127); })},
      {"ctrl-size", "40 tables need", damage_section([](auto& p) { p["CTRL"].bytes.pop_back(); })},
      {"stages", "4294967280 stages", damage_section(set("CTRL", 12, kHuge))},
      {"text-size", "a name of 4294967280", damage_section(set("CTRL", 36, kHuge))},
      {"padding", "padding of the name", damage_section(set<char>("CTRL", kModeFixed + 7, 'x'))},
      {"reserved", "reserved bytes", damage_section(set<char>("CTRL", 127, 1))},
      {"mode-name", "has no name", damage_section([](auto& p) {
         ByteVector& mode = p["CTRL"].bytes;
         put_at(mode, 36, 0u);
         mode.erase(mode.begin() + kModeFixed, mode.begin() + kNext);
       })},
      {"alpha", "mode 0: alpha", damage_section(set("CTRL", 0, 1.0f))},
      {"alpha", "mode 0: alpha", damage_section(set("CTRL", 0, nan))},
      {"w1", "mode 0: w1", damage_section(set("CTRL", 4, -1.0f))},
      {"cap", "mode 0: cap", damage_section(set("CTRL", 8, nan))},
      {"stages", "0 stages", damage_section([](auto& p) {
         put_at(p["CTRL"].bytes, 12, 0u);
         p["CTRL"].bytes.resize(kNext);
       })},
      {"residual", "mode 0: residual",
       damage_section(set("CTRL", 16, std::numeric_limits<double>::quiet_NaN()))},
      {"stages", "26 stages of 8 headings", damage_section(set("CTRL", 12, 26u))},
      {"switching", "flags 4", damage_section(set<std::uint8_t>("CTRL", 50, 4))},
      {"switching", "4 stages that are left by state", damage_section([](auto& p) {
         put_at(p["CTRL"].bytes, 50, std::uint8_t{1});
         p["CTRL"].bytes.resize(p["CTRL"].bytes.size() + 4 * testing::kTinySamples);
       })},
      {"power", "power 3", damage_section(set<std::uint8_t>("CTRL", 51, 3))},
      {"headings", "9 headings", damage_section(set("CTRL", 52, 9u))},
      {"headings", "4294967280 headings", damage_section(set("CTRL", 52, kHuge))},
      {"served", "headings beyond the last", damage_section(set("CTRL", 56, 1u << 8))},
      {"mode-setting", "not a finite", damage_section(set("CTRL", 60, -1.0f))},
      {"mode-setting", "not a finite", damage_section(set("CTRL", 64, 1.0f))},
      {"mode-setting", "not a finite", damage_section(set("CTRL", 68, nan))},
      {"mode-setting", "not a finite", damage_section(set("CTRL", 72, nan))},
      {"mode-setting", "not a finite", damage_section(set("CTRL", 76, -1.0f))},
      {"mode-setting", "not a finite", damage_section(set("CTRL", 80, nan))},
      {"bend", "not a cosine", damage_section(set("CTRL", 84, 1 << 29))},
      {"bend", "not a cosine", damage_section(set("CTRL", 84, -(1 << 30)))},
      {"bend", "not a cosine", damage_section(set("CTRL", 88, 1 << 20))},
      {"go", "mode 0: table 0, sample 1", damage_section(set("CTRL", kGo + 4, -1.0f))},
      {"go", "mode 0: table 0, sample 0", damage_section(set("CTRL", kGo, 1.0f))},
      {"go", "mode 0: table 0, sample 3", damage_section(set("CTRL", kGo + 12, nan))},
      {"arrived", "sample 2 goes along", damage_section([](auto& p) {
         ByteVector& responsive = p.parts[4].bytes;
         put_at(responsive, responsive.size() - 4 * (testing::kTinySamples - 2), 1u << 8);
       })},
      {"next-transition", "no such transition", damage_section([](auto& p) {
         p.parts[4].bytes[50] = 1;  // a mode that plays through is told not to
       })},
      {"served", "beyond the tenth", damage_section(set("CTRL", 32, 1u << 10))},
      {"table-of", "direction 10 of 10", damage_section(set<std::uint8_t>("CTRL", 40 + 7, 10))},
      {"next-index", "next is sample 103", damage_section(set("CTRL", kNext + 4, 103u))},
      {"next-index", "next is sample 4294967295",
       damage_section(set("CTRL", kNext + 4, kNoSample))},
      {"next-kept", "which was not kept", damage_section(set("CTRL", kNext + 4, 0u))},
      {"next-unkept", "has a next", damage_section(set("CTRL", kNext, 1u))},
      {"next-transition", "no such transition", damage_section(set("CTRL", kNext + 4, 50u))},
  };
}

std::vector<Hostile> picture_packs() {
  const Sample last = testing::tiny_sprite_data().samples.back();
  Image picture{last.width, last.height, ByteVector(std::size_t{4} * last.width * last.height)};
  picture.rgba[0] = 200;  // where alpha is 0
  const ByteVector glare = compressed(picture);
  const auto not_a_picture = [&](const EditBytes& edit) {
    ByteVector bytes = glare;
    edit(bytes);
    return Hostile{"frame-decode", "not a picture", replace_last_picture(bytes), true};
  };
  // Form, three factors, head of the first row, its gap and count; one block at the end.
  return {
      not_a_picture([](auto& b) { b[0] = 2; }),
      not_a_picture([](auto& b) { b[1] = 9; }),
      not_a_picture([](auto& b) { b[4] = 255; }),
      not_a_picture([&](auto& b) { b[5] = static_cast<std::uint8_t>(last.width); }),
      not_a_picture([&](auto& b) { b[6] = static_cast<std::uint8_t>(last.width + 1); }),
      not_a_picture([](auto& b) { b[6] = 0; }),
      not_a_picture([](auto& b) { b.resize(12); }),
      not_a_picture([](auto& b) { b.pop_back(); }),
      not_a_picture([](auto& b) { b.push_back(0); }),
      not_a_picture([](auto& b) { b[b.size() - 9] |= 0xF0; }),
      {"fidx-size", "103 pictures", damage_section([](auto& p) { p["FIDX"].bytes.pop_back(); })},
      {"reserved", "picture 4", damage_section(set("FIDX", frame_at(4) + 12, 1u))},
      {"frame-kept", "none for a kept", damage_section(set("FIDX", frame_at(4) + 8, 0u))},
      {"frame-kept", "one for a sample not kept", damage_section(set("FIDX", frame_at(0) + 8, 1u))},
      {"frame-bounds", "due at", damage_section(set("FIDX", frame_at(4), std::uint64_t{0}))},
      {"frame-bounds", "4294967280 bytes", damage_section(set("FIDX", frame_at(4) + 8, kHuge))},
      {"frame-bounds", "the pictures end at",
       damage_section([](auto& p) { p["FRAM"].bytes.push_back(0); })},
      {"frame-sum", "picture of sample 4",
       damage_section(set("FIDX", frame_at(4) + 16, std::uint64_t{1})), true},
      {"frame-decode", "not a picture", replace_last_picture({1, 2, 3}), true},
      {"frame-colour", "greater than its alpha", replace_last_picture(glare), true},
  };
}

// The tiny sprite with every section that a pack may lack.
const ByteVector& acting_pack() {
  static const ByteVector bytes = [] {
    const testing::TempFolder folder;
    SpriteData data = testing::acting_sprite_data();
    data.event_names = {"step", "blink"};
    data.events = {{4, 0}, {9, 0}, {9, 1}};
    for (std::uint16_t tag = 0; tag < data.tags.size(); ++tag)
      data.bodies.push_back({tag, -5, -4, 6, 7});
    const std::string path = folder.file("tiny.vsp");
    const auto saved = save_pack(path, data, [&](std::uint32_t sample) {
      return Result<Image>(testing::tiny_picture(data, sample));
    });
    return saved ? testing::read_bytes(path) : ByteVector();
  }();
  return bytes;
}

// What a pack may lack: actions, events, boxes.
std::vector<Hostile> acting_packs() {
  constexpr std::size_t n = testing::kTinySamples;
  constexpr std::size_t value = 24, next = value + 4 * n, cut = value + 12 * n,
                        stay = value + 16 * n, in_time = value + 20 * n;
  const auto damaged = [](const EditParts& edit) { return damage_section(edit, acting_pack()); };
  return {
      {"action-size", "bytes are due", damaged([](auto& p) { p["ACTN"].bytes.pop_back(); })},
      {"action-size", "16 bytes are due", damaged([](auto& p) { p["ACTN"].bytes.resize(15); })},
      {"action-count", "0 tables", damaged(set("ACTN", 0, 0u))},
      {"action-count", "4294967280 deadlines", damaged(set("ACTN", 4, kHuge))},
      {"action-tau", "price of a tick", damaged(set("ACTN", 8, 0.0f))},
      {"reserved", "reserved bytes", damaged(set("ACTN", 12, 1u))},
      {"action-tag", "there are 6 tags", damaged(set<std::uint16_t>("ACTN", 16, 77))},
      {"action-tag", "do not ascend", damaged(set<std::uint16_t>("ACTN", in_time + 32 * n, 1))},
      {"action-kept", "not kept but leads", damaged(set("ACTN", next, 1u))},
      {"action-next", "no transition", damaged(set("ACTN", next + 20, 50u))},
      {"action-next", "no transition", damaged(set("ACTN", next + 20, kHuge))},
      {"action-value", "does not fall", damaged(set("ACTN", value + 20, 0.0f))},
      {"action-cut", "no first sample", damaged(set("ACTN", cut + 20, 6u))},
      {"action-stay", "not of the tag", damaged(set("ACTN", stay + 20, 6u))},
      {"action-deadline", "does not come in time", damaged(set("ACTN", in_time + 20, 6u))},
      {"event-size", "16 bytes are due", damaged([](auto& p) { p["EVNT"].bytes.resize(15); })},
      {"event-size", "4294967280 events", damaged(set("EVNT", 8, std::uint64_t{kHuge}))},
      {"event-name", "has name 2 of 2", damaged(set("EVNT", 20, 2u))},
      {"event-name", "each once", damaged([](auto& p) { p["EVNT"].bytes.back() = 7; })},
      {"event-sample", "at sample 103", damaged(set("EVNT", 16, 103u))},
      {"event-order", "ascending order", damaged(set("EVNT", 16, 102u))},
      {"body-size", "do not make", damaged([](auto& p) { p["BODY"].bytes.push_back(0); })},
      {"body-tag", "tag 77 of 6", damaged(set<std::uint16_t>("BODY", 8, 77))},
      {"body-tag", "has samples but no box", damaged([](auto& p) {
         put_at(p["BODY"].bytes, 0, 5u);
         p["BODY"].bytes.resize(8 + 5 * 20);
       })},
      {"body-box", "is not a box", damaged(set("BODY", 12, 9.0f))},
      {"section-twice", "more than once", damaged([](auto& p) { p.parts.push_back(p["BODY"]); })},
  };
}

// The tiny sprite with pictures for the GPU.
std::vector<Hostile> block_packs() {
  const testing::TempFolder folder;
  const SpriteData data = testing::tiny_sprite_data();
  const std::string path = folder.file("tiny.vsp");
  const auto picture = [&](std::uint32_t i) -> Result<Image> {
    return testing::tiny_picture(data, i);
  };
  EXPECT_TRUE(save_pack(path, data, picture, {}, PictureForm::Blocks));
  const ByteVector whole = testing::read_bytes(path);
  const auto damaged = [&](const EditParts& edit) { return damage_section(edit, whole); };
  const auto picture_byte = [&](std::size_t at, std::uint8_t value) {
    return damaged([=](PackParts& p) {  // of the first picture
      ByteVector& frames = p["FRAM"].bytes;
      frames[at] = value;
      const auto size = get_at<std::uint32_t>(p["FIDX"].bytes, frame_at(1) + 8);
      put_at(p["FIDX"].bytes, frame_at(1) + 16, detail::hash_bytes({frames.data(), size}));
    });
  };
  return {
      {"loss", "need 16 bytes", damaged([](auto& p) { p["LOSS"].bytes.pop_back(); })},
      {"loss", "from 0 to 65025", damaged(set("LOSS", 0, -1.0))},
      {"loss", "from 0 to 65025", damaged(set("LOSS", 8, std::nan("")))},
      {"section-twice", "more than once", damaged([](auto& p) { p.parts.push_back(p["LOSS"]); })},
      {"frame-decode", "not a picture", picture_byte(0, 3), true},
      {"frame-decode", "not a picture", picture_byte(1, 0xFF), true},
  };
}

// The tiny sprite with a filmed shadow.
std::vector<Hostile> shadow_packs() {
  const testing::TempFolder folder;
  SpriteData data = testing::tiny_sprite_data();
  const std::string path = folder.file("tiny.vsp");
  const auto picture = [&](std::uint32_t i) -> Result<Image> {
    return testing::tiny_picture(data, i);
  };
  EXPECT_TRUE(add_shadow(data, 1, make_image(6, 4, 0, 0, 0, 128), {3, 1}));
  EXPECT_TRUE(save_pack(path, data, picture));
  const ByteVector whole = testing::read_bytes(path);
  const auto damaged = [&](const EditParts& edit) { return damage_section(edit, whole); };
  return {
      {"shadow-size", "too many", damaged([](auto& p) { p["SHDW"].bytes.push_back(0); })},
      {"shadow-size", "are left", damaged([](auto& p) { p["SHDW"].bytes.pop_back(); })},
      {"shadow-value", "a scale above 0", damaged(set("SHDW", 4, 0.0f))},
      {"shadow-sample", "kept ones", damaged(set("SHDW", 8, 0xFFFFFFu))},
      {"shadow-picture", "not a black picture", damaged(set("SHDW", 32, std::uint8_t{0xFF})), true},
      {"section-twice", "more than once", damaged([](auto& p) { p.parts.push_back(p["SHDW"]); })},
  };
}

void expect_refused(const Hostile& hostile) {
  SCOPED_TRACE(std::string(hostile.code) + ": " + hostile.message);
  const auto issues = testing::verify_bytes(hostile.bytes);
  ASSERT_FALSE(issues.empty());
  EXPECT_EQ(issues[0].code, hostile.code);
  EXPECT_EQ(issues[0].severity, "error");
  const std::string message = issues[0].section + ": " + issues[0].message;
  EXPECT_NE(message.find(hostile.message), std::string::npos) << message;
  EXPECT_LE(issues[0].offset, hostile.bytes.size());
  const auto sprite = testing::load_bytes(hostile.bytes);
  ASSERT_EQ(sprite.has_value(), hostile.loads);
  if (!sprite) {
    EXPECT_EQ(sprite.error().message.find("tiny.vsp: "), 0u);
    EXPECT_NE(sprite.error().message.find(issues[0].message), std::string::npos);
    return;
  }
  Image image;
  for (std::uint32_t i = 0; i < testing::kTinySamples; ++i) (void)sprite->decode_frame(i, image);
}

using HostileList = std::vector<Hostile> (*)();
constexpr HostileList kLists[] = {header_packs,     meta_packs,  sample_packs,
                                  transition_packs, mode_packs,  picture_packs,
                                  acting_packs,     block_packs, shadow_packs};

class HostilePack : public ::testing::TestWithParam<HostileList> {};
TEST_P(HostilePack, IsRefusedWithItsOwnCode) {
  for (const Hostile& hostile : GetParam()()) expect_refused(hostile);
}
INSTANTIATE_TEST_SUITE_P(All, HostilePack, ::testing::ValuesIn(kLists));

// A pack of 9 GiB, of which only the header is there.
TEST(HostilePacks, MoreThanIsReadIsRefusedBeforeItIsRead) {
  ByteVector header(64, 0);
  std::copy(detail::kMagic.begin(), detail::kMagic.end(), header.begin());
  put_at(header, 8, kPackMajor);
  put_at(header, 16, std::uint64_t{9} << 30);
  const auto issues = verify_pack(
      {std::uint64_t{9} << 30, "large.vsp", [&](std::uint64_t offset, std::span<std::uint8_t> out) {
         if (offset + out.size() > header.size()) return false;
         std::copy_n(header.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
         return true;
       }});
  ASSERT_TRUE(issues && issues->size() == 1);
  EXPECT_EQ(issues->front().code, "file-limit");
}

// PACK.md promises these codes: each has a pack of its own, and no pack has a code beyond them.
TEST(HostilePacks, EveryCodeOfTheVerifierHasOne) {
  std::ifstream file(VSPRITE_SOURCE_DIR "/engine/PACK.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto begin = text.find("`too-short "), end = text.find('`', begin + 1);
  ASSERT_NE(begin, std::string::npos);
  std::istringstream words(text.substr(begin + 1, end - begin - 1));
  const std::set<std::string> promised{std::istream_iterator<std::string>(words), {}};
  std::set<std::string> found{"file-limit"};  // above
  std::size_t count = 1;
  for (const HostileList list : kLists)
    for (const Hostile& hostile : list()) found.insert(hostile.code), ++count;
  EXPECT_EQ(found, promised);
  EXPECT_GE(count, 60u);
}

}  // namespace
}  // namespace vsprite
