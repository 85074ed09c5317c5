// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The stroke font. A line is 26 units high: 3 above the capitals, which reach from 0 to 16 (the
// baseline), then 5 for descenders and 2 of air; small letters begin at 6.
//
// A glyph is a list of strokes. A point is two characters, x and y, digits to base 36. A stroke is
// a polyline; after '~' its inner points are controls of a quadratic spline through the middles of
// its legs (the ends are met); after '@' the spline is closed; a single point is a dot.
#include "font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace vsprite::detail {
namespace {

constexpr float kLine = 26;
constexpr float kTop = 3;
constexpr float kGap = 5;          // between the boxes of neighbours
constexpr float kStroke = 0.085f;  // stroke width against the line height
constexpr std::string_view kUnknown = "00a0ag0g00";

constexpr std::array<std::string_view, 95> kAscii = {
    "",                                  // space
    "000b 0g",                           // !
    "0004 4044",                         // "
    "301g 806g 0595 0b9b",               // #
    "~93800008989g1g0d 505g",            // $
    "@00505606 @8adadg8g b02g",          // %
    "~ag24208085090g8gaa",               // &
    "0004",                              // '
    "~40040e4i",                         // (
    "~00444e0i",                         // )
    "414b 0488 8408",                    // *
    "454d 0989",                         // +
    "1g0j",                              // ,
    "0969",                              // -
    "0g",                                // .
    "800i",                              // /
    "@00909g0g",                         // 0
    "13505g 1g9g",                       // 1
    "~0401a1a60g 0g9g",                  // 2
    "~0310909737 ~37a7ag0g0d",           // 3
    "7g700b9b",                          // 4
    "801007 ~0736a5ag0g0d",              // 5
    "~8270000b @06969g0g",               // 6
    "00903g",                            // 7
    "@10808717 @07979g0g",               // 8
    "@00909a0a ~1e2g9g95",               // 9
    "07 0g",                             // :
    "17 1g0j",                           // ;
    "84098e",                            // <
    "0686 0c8c",                         // =
    "04890e",                            // >
    "~0300909747 4b 4g",                 // ?
    "~cg0g00f0fdbdb5 @45b5bd4d",         // @
    "0g60cg 2aaa",                       // A
    "000g ~003090983808 ~0838a8ag3g0g",  // B
    "~b3a0000gagbd",                     // C
    "000g ~0040c0cg4g0g",                // D
    "90000g9g 0878",                     // E
    "90000g 0878",                       // F
    "~b3a0000gbgb9 b969",                // G
    "000g b0bg 08b8",                    // H
    "000g",                              // I
    "~707b7g0g0c",                       // J
    "000g 9009 479g",                    // K
    "000g8g",                            // L
    "0g006ac0cg",                        // M
    "0g00bgb0",                          // N
    "@00d0dg0g",                         // O
    "000g ~0030a0a93909",                // P
    "@00d0dg0g 8bdh",                    // Q
    "000g ~0030a0a93909 59ag",           // R
    "~a3900008a8ag0g0c",                 // S
    "00a0 505g",                         // T
    "~000a0gbgbab0",                     // U
    "006gc0",                            // V
    "004g82cgg0",                        // W
    "00bg b00g",                         // X
    "0068c0 686g",                       // Y
    "00a00gag",                          // Z
    "40000i4i",                          // [
    "008i",                              // backslash
    "00404i0i",                          // ]
    "064086",                            // ^
    "0iai",                              // _
    "0023",                              // `
    "@06868g0g 868g",                    // a
    "000g @06868g0g",                    // b
    "~7766060g6g7f",                     // c
    "808g @06868g0g",                    // d
    "0b8b ~8b86060g7g8e",                // e
    "~6020252g 0656",                    // f
    "@06868g0g ~868g8l1l0j",             // g
    "000g ~0b06868b8g",                  // h
    "060g 01",                           // i
    "~363g3l0l 31",                      // j
    "000g 760d 3a8g",                    // k
    "~000d0g3g",                         // l
    "060g ~0b06666b6g ~6b66c6cbcg",      // m
    "060g ~0b06868b8g",                  // n
    "@06969g0g",                         // o
    "060l @06868g0g",                    // p
    "868l @06868g0g",                    // q
    "060g ~0b0656",                      // r
    "~7866060b7b7g0g0e",                 // s
    "~202b2g6g 0656",                    // t
    "~060b0g8g8b 868g",                  // u
    "064g86",                            // v
    "063g67 679gc6",                     // w
    "068g 860g",                         // x
    "064g 862l",                         // y
    "06760g7g",                          // z
    "~40202809 ~092a2i4i",               // {
    "000i",                              // |
    "~00202849 ~492a2i0i",               // }
    "~0a277da8",                         // ~
};

struct Extra {
  char32_t character;
  std::string_view strokes;
};
constexpr std::array<Extra, 11> kExtras = {{
    {U'\u00b0', "@00505505"},
    {U'\u00b1', "434b 0787 0f8f"},
    {U'\u00b7', "09"},
    {U'\u00d7', "058d 850d"},
    {U'\u2013', "0999"},
    {U'\u2014', "09f9"},
    {U'\u2026', "0g 5g ag"},
    {U'\u2190', "e909 54095e"},
    {U'\u2191', "5g52 0752a7"},
    {U'\u2192', "09e9 94e99e"},
    {U'\u2193', "525g 0b5gab"},
}};

std::string_view strokes_of(char32_t character) noexcept {
  if (character >= 32 && character < 127) return kAscii[character - 32];
  for (const Extra& extra : kExtras) {
    if (extra.character == character) return extra.strokes;
  }
  return kUnknown;
}

int digit(char c) noexcept { return c <= '9' ? c - '0' : c - 'a' + 10; }

/// The rightmost control point: the width of the glyph's box in units.
float glyph_width(char32_t character) noexcept {
  if (character == U' ') return 4;
  if (character >= U'0' && character <= U'9') return 9;  // figures stand in columns
  int right = 0;
  bool is_x = true;
  for (const char c : strokes_of(character)) {
    if (c == ' ' || c == '~' || c == '@') continue;
    if (is_x) right = std::max(right, digit(c));
    is_x = !is_x;
  }
  return static_cast<float>(right);
}

using Polyline = std::vector<Vec2>;

Vec2 middle(Vec2 a, Vec2 b) noexcept { return {0.5f * (a.x + b.x), 0.5f * (a.y + b.y)}; }

void add_curve(Polyline& line, Vec2 from, Vec2 control, Vec2 to) {
  constexpr int kSteps = 12;
  for (int i = 1; i <= kSteps; ++i) {
    const float t = static_cast<float>(i) / kSteps;
    const float a = (1 - t) * (1 - t), b = 2 * t * (1 - t), c = t * t;
    line.push_back({a * from.x + b * control.x + c * to.x, a * from.y + b * control.y + c * to.y});
  }
}

Polyline flatten(std::span<const Vec2> p, char kind) {
  Polyline line;
  const std::size_t n = p.size();
  if (kind == '@') {
    line.push_back(middle(p[n - 1], p[0]));
    for (std::size_t i = 0; i < n; ++i) {
      add_curve(line, line.back(), p[i], middle(p[i], p[(i + 1) % n]));
    }
  } else if (kind == '~' && n > 2) {
    line.push_back(p[0]);
    for (std::size_t i = 1; i + 1 < n; ++i) {
      add_curve(line, line.back(), p[i], i + 2 == n ? p[n - 1] : middle(p[i], p[i + 1]));
    }
  } else {
    line.assign(p.begin(), p.end());
  }
  return line;
}

/// All strokes of a glyph, in pixels from the pen.
std::vector<Polyline> outline(char32_t character, float line_height) {
  const float unit = line_height / kLine;
  std::vector<Polyline> lines;
  std::string_view text = strokes_of(character);
  while (!text.empty()) {
    const std::string_view stroke = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), stroke.size() + 1));
    const char kind = stroke.empty() ? ' ' : stroke[0];
    std::vector<Vec2> points;
    for (std::size_t i = kind == '~' || kind == '@'; i + 1 < stroke.size(); i += 2) {
      const float x = static_cast<float>(digit(stroke[i]));
      const float y = static_cast<float>(digit(stroke[i + 1]));
      points.push_back({(x + kGap / 2) * unit, (y + kTop) * unit});
    }
    if (!points.empty()) lines.push_back(flatten(points, kind));
  }
  return lines;
}

float pen_radius(float line_height, float weight) noexcept {
  return std::max(0.5f * kStroke * line_height * weight, 0.45f);
}

float distance_squared(Vec2 p, Vec2 a, Vec2 b) noexcept {
  const float dx = b.x - a.x, dy = b.y - a.y;
  const float length = dx * dx + dy * dy;
  const float t = length > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / length : 0;
  const float s = std::clamp(t, 0.0f, 1.0f);
  const float x = p.x - a.x - s * dx, y = p.y - a.y - s * dy;
  return x * x + y * y;
}

float distance(Vec2 p, std::span<const Polyline> lines, float dot_growth) noexcept {
  float least = 1e9f;
  for (const Polyline& line : lines) {
    if (line.size() == 1) {
      const float d = std::sqrt(distance_squared(p, line[0], line[0])) - dot_growth;
      least = std::min(least, d > 0 ? d * d : 0.0f);
    }
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      least = std::min(least, distance_squared(p, line[i], line[i + 1]));
    }
  }
  return std::sqrt(least);
}

}  // namespace

char32_t take_character(std::string_view& text) noexcept {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80 ? 1 : first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0x80 || first < 0xC2 || first > 0xF4 || text.size() < length) {
    text.remove_prefix(1);
    return first < 0x80 ? first : U'\uFFFD';
  }
  char32_t code = first & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) {
      text.remove_prefix(i);
      return U'\uFFFD';
    }
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  text.remove_prefix(length);
  return code;
}

float glyph_advance(char32_t character) noexcept { return (glyph_width(character) + kGap) / kLine; }

Rect glyph_box(char32_t character, float line_height, float weight) noexcept {
  const float unit = line_height / kLine;
  const float reach = 1.3f * pen_radius(line_height, weight) + 1;
  const int left = static_cast<int>(std::floor(kGap / 2 * unit - reach));
  const int right = static_cast<int>(std::ceil((kGap / 2 + glyph_width(character)) * unit + reach));
  const int top = static_cast<int>(std::floor(kTop * unit - reach));
  const int bottom = static_cast<int>(std::ceil((kTop + 21) * unit + reach));
  return {left, top, right - left, bottom - top};
}

Image draw_glyph(char32_t character, float line_height, float weight) {
  const Rect box = glyph_box(character, line_height, weight);
  const std::vector<Polyline> lines = outline(character, line_height);
  const float radius = pen_radius(line_height, weight);
  Image image{box.width, box.height, {}};
  image.rgba.assign(std::size_t(box.width) * std::size_t(box.height) * 4, 0);
  if (lines.empty()) return image;
  std::uint8_t* out = image.rgba.data();
  for (int y = 0; y < box.height; ++y) {
    for (int x = 0; x < box.width; ++x, out += 4) {
      const Vec2 p{static_cast<float>(box.x + x) + 0.5f, static_cast<float>(box.y + y) + 0.5f};
      const float coverage =
          std::clamp(radius + 0.5f - distance(p, lines, 0.3f * radius), 0.0f, 1.0f);
      std::fill_n(out, 4, static_cast<std::uint8_t>(coverage * 255 + 0.5f));
    }
  }
  return image;
}

}  // namespace vsprite::detail
