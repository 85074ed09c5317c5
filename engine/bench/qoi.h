// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// qoi.h - the Quite OK Image format (version 1.0 of its one-page specification), both directions,
// as a rival for frame_bench: RGBA in and out, without header and end marker.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "vsprite/image.h"

namespace vsprite::bench {

struct QoiPixel {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  bool operator==(const QoiPixel&) const = default;
};

inline std::size_t qoi_slot(QoiPixel p) {
  return (p.r * 3u + p.g * 5u + p.b * 7u + p.a * 11u) % 64;
}

inline std::vector<std::uint8_t> encode_qoi(const Image& image) {
  std::vector<std::uint8_t> out;
  const auto put = [&](int byte) { out.push_back(static_cast<std::uint8_t>(byte)); };
  std::array<QoiPixel, 64> seen{};
  seen.fill({0, 0, 0, 0});
  QoiPixel before;
  int run = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    QoiPixel p;
    std::memcpy(&p, &image.rgba[i], 4);
    if (p == before) {
      if (++run == 62) put(0xC0 | (run - 1)), run = 0;
      continue;
    }
    if (run > 0) put(0xC0 | (run - 1)), run = 0;
    QoiPixel& slot = seen[qoi_slot(p)];
    const auto change = [](int to, int from) { return static_cast<std::int8_t>(to - from); };
    const int dr = change(p.r, before.r), dg = change(p.g, before.g), db = change(p.b, before.b);
    const int rg = change(dr, dg), bg = change(db, dg);
    const auto within = [](int v, int half) { return v >= -half && v < half; };
    if (slot == p) {
      put(static_cast<int>(qoi_slot(p)));
    } else if (p.a != before.a) {
      put(0xFF), put(p.r), put(p.g), put(p.b), put(p.a);
    } else if (within(dr, 2) && within(dg, 2) && within(db, 2)) {
      put(0x40 | (dr + 2) << 4 | (dg + 2) << 2 | (db + 2));
    } else if (within(dg, 32) && within(rg, 8) && within(bg, 8)) {
      put(0x80 | (dg + 32)), put((rg + 8) << 4 | (bg + 8));
    } else {
      put(0xFE), put(p.r), put(p.g), put(p.b);
    }
    slot = before = p;
  }
  if (run > 0) put(0xC0 | (run - 1));
  out.resize(out.size() + 8);  // so that reading a whole pixel needs no look at the end
  return out;
}

/// Into an image of the right size. False: the bytes end too soon.
inline bool decode_qoi(std::span<const std::uint8_t> bytes, Image& image) {
  std::array<QoiPixel, 64> seen{};
  seen.fill({0, 0, 0, 0});
  QoiPixel p;
  const std::uint8_t *at = bytes.data(), *end = bytes.data() + bytes.size() - 8;
  int run = 0;
  for (std::uint8_t *to = image.rgba.data(), *stop = to + image.rgba.size(); to != stop; to += 4) {
    if (run > 0) {
      --run;
    } else {
      if (at >= end) return false;
      const unsigned tag = *at++;
      if (tag >= 0xFE) {
        std::memcpy(&p, at, tag == 0xFF ? 4 : 3);
        at += tag == 0xFF ? 4 : 3;
      } else if (tag < 0x40) {
        p = seen[tag];
      } else if (tag < 0x80) {
        p.r = static_cast<std::uint8_t>(p.r + (tag >> 4 & 3) - 2);
        p.g = static_cast<std::uint8_t>(p.g + (tag >> 2 & 3) - 2);
        p.b = static_cast<std::uint8_t>(p.b + (tag & 3) - 2);
      } else if (tag < 0xC0) {
        const unsigned green = (tag & 63) - 32, rest = *at++;
        p.r = static_cast<std::uint8_t>(p.r + green + (rest >> 4) - 8);
        p.g = static_cast<std::uint8_t>(p.g + green);
        p.b = static_cast<std::uint8_t>(p.b + green + (rest & 15) - 8);
      } else {
        run = static_cast<int>(tag & 63);
      }
      seen[qoi_slot(p)] = p;
    }
    std::memcpy(to, &p, 4);
  }
  return true;
}

}  // namespace vsprite::bench
