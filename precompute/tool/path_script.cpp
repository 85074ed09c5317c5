// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/path_script.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tool/report.h"

namespace vsprite {
namespace {

/// The words of a line up to its comment.
std::vector<std::string_view> words_of(std::string_view line) {
  line = line.substr(0, line.find('#'));
  std::vector<std::string_view> words;
  constexpr std::string_view kBlank = " \t\r";
  for (std::size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kBlank, end);
  }
  return words;
}

bool read_number(std::string_view word, float& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc{} && end == word.data() + word.size() && std::isfinite(value);
}

std::string shown(std::string_view line) {
  std::string out;
  for (const char c : line.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return out;
}

std::string place(double value) { return fixed_text(value, 3); }

Json spread(double median, double p95, double most, double unit) {
  return {{"median", median / unit}, {"p95", p95 / unit}, {"max", most / unit}};
}

}  // namespace

Result<std::vector<Vec2>> parse_path(const std::string& text, const std::string& name) {
  std::vector<Vec2> points;
  std::string_view rest = text;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const auto words = words_of(line);
    if (words.empty()) continue;
    Vec2 point;
    if (words.size() != 2 || !read_number(words[0], point.x) || !read_number(words[1], point.y))
      return Error{ErrorCode::BadContent, name + ":" + std::to_string(line_number) + ": `" +
                                              shown(line) +
                                              "`: two finite numbers are due, x and y in px"};
    points.push_back(point);
  }
  return points;
}

Vec2 PathPicture::place(Position at) const {
  return floor ? to_screen(*floor, to_pixels(at)) : to_pixels(at);
}
float PathPicture::scale(Position at) const {
  return floor ? scale_at(*floor, to_pixels(at)) : 1.0f;
}

PathPicture picture_around(const std::vector<Vec2>& points, float body_length) {
  Vec2 low = points[0], high = points[0];
  for (const Vec2& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const float margin = std::max(body_length, 1.0f);
  PathPicture out;
  out.origin = {std::floor(low.x - margin), std::floor(low.y - margin)};
  // Even: every film format takes it.
  out.width = (static_cast<int>(std::ceil(high.x + margin - out.origin.x)) + 1) & ~1;
  out.height = (static_cast<int>(std::ceil(high.y + margin - out.origin.y)) + 1) & ~1;
  return out;
}

Result<void> check_inside(const std::vector<Vec2>& points, const PathPicture& picture,
                          const std::string& name) {
  Vec2 low = points[0], high = points[0];
  for (const Vec2& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const bool is_outside = high.x < 0 || high.y < 0 || low.x > static_cast<float>(picture.width) ||
                          low.y > static_cast<float>(picture.height);
  if (!is_outside) return {};
  return Error{ErrorCode::BadContent,
               name + ": the path lies outside the picture: x " + place(double{low.x}) + " to " +
                   place(double{high.x}) + ", y " + place(double{low.y}) + " to " +
                   place(double{high.y}) + ", where 0 to " + std::to_string(picture.width) +
                   " and 0 to " + std::to_string(picture.height) + " are due"};
}

std::string path_text(const Sprite& sprite, const Clip& clip, const ClipReport& r, double seconds) {
  const double body = std::max(1.0, double{sprite.data().body_length});
  const double length = static_cast<double>(clip.ticks.size()) / sprite.fps();
  std::string out = "  " + std::to_string(clip.ticks.size()) + " frames (" + fixed_text(length, 1) +
                    " s), found in " + fixed_text(seconds, 2) + " s, " +
                    fixed_text(length / std::max(seconds, 1e-9), 1) + " times real time\n";
  out += "  cost                    " + fixed_text(clip.cost, 3) + "\n";
  out += "  off the path            median " + fixed_text(r.deviation_median, 1) + " px, 95 % " +
         fixed_text(r.deviation_p95, 1) + " px, largest " + fixed_text(r.deviation_max, 1) +
         " px (" + fixed_text(r.deviation_median / body, 2) + ", " +
         fixed_text(r.deviation_p95 / body, 2) + ", " + fixed_text(r.deviation_max / body, 2) +
         " body lengths)\n";
  out += "  over 45 degrees off     " + std::to_string(r.off_course) + " frames\n";
  out += "  transition cost         mean " + fixed_text(r.transition_mean, 4) + ", 99 % " +
         fixed_text(r.transition_p99, 3) + ", largest " + fixed_text(r.transition_max, 3) + "\n";
  out += "  jumps a second          " + fixed_text(static_cast<double>(r.jumps) / length, 2) + "\n";
  return out;
}

Json path_json(const Sprite& sprite, const Clip& clip, const ClipReport& r, double seconds) {
  const double body = std::max(1.0, double{sprite.data().body_length});
  const double length = static_cast<double>(clip.ticks.size()) / sprite.fps();
  return {{"frames", clip.ticks.size()},
          {"cost", clip.cost},
          {"deviation_px", spread(r.deviation_median, r.deviation_p95, r.deviation_max, 1)},
          {"deviation_body", spread(r.deviation_median, r.deviation_p95, r.deviation_max, body)},
          {"over_45_degrees", r.off_course},
          {"transition_cost",
           {{"mean", r.transition_mean}, {"p99", r.transition_p99}, {"max", r.transition_max}}},
          {"jumps_per_second", static_cast<double>(r.jumps) / length},
          {"motion_seconds", length},
          {"seconds", seconds},
          {"realtime_factor", length / std::max(seconds, 1e-9)}};
}

std::string clip_csv(const Clip& clip) {
  std::string out = "frame,sample,x,y,segment,cost\n";
  for (std::size_t k = 0; k < clip.ticks.size(); ++k) {
    const ClipTick& t = clip.ticks[k];
    out += std::to_string(k) + "," + std::to_string(t.sample) + "," +
           place(static_cast<double>(t.position.x) / kFixedOne) + "," +
           place(static_cast<double>(t.position.y) / kFixedOne) + "," + std::to_string(t.segment) +
           "," + fixed_text(t.cost, 6) + "\n";
  }
  return out;
}

Json clip_json(const Sprite& sprite, const Clip& clip, const PathPicture& picture) {
  Json ticks = Json::array();
  for (const ClipTick& t : clip.ticks) {
    ticks.push_back({{"sample", t.sample},
                     {"x", static_cast<double>(t.position.x) / kFixedOne},
                     {"y", static_cast<double>(t.position.y) / kFixedOne}});
    if (!picture.floor) continue;
    const Vec2 at = picture.place(t.position);
    ticks.back()["x"] = at.x;
    ticks.back()["y"] = at.y;
    ticks.back()["scale"] = picture.scale(t.position);
  }
  return {{"fps", sprite.fps()},
          {"size", {picture.width, picture.height}},
          {"origin", {picture.origin.x, picture.origin.y}},
          {"ticks", ticks}};
}

}  // namespace vsprite
