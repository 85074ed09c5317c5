// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "vsprite/geometry.h"

namespace vsprite::capture {
namespace {

constexpr double kSlow = 30;  // px/s

/// Counts half turns of yaw: the sign of cos(yaw) changes while the fish is there.
void count_turns(const GoldfishFilm& film, FilmStatistics& s) {
  for (int k = 1; k < film.frame_count(); ++k) {
    const FishPose &a = film.pose(k - 1), &b = film.pose(k);
    if (a.away || b.away) continue;
    s.fastest_pitch = std::max(s.fastest_pitch, std::abs(b.pitch - a.pitch) * 57.29577951308232);
    const auto from = static_cast<std::size_t>(a.heading < 0 ? 8 : a.heading);
    const auto to = static_cast<std::size_t>(b.heading < 0 ? 8 : b.heading);
    if (from != to) ++s.turns[from][to];
    if ((std::cos(a.yaw) > 0) != (std::cos(b.yaw) > 0)) {
      ++s.facing_turns;
      if (std::sin(b.yaw) > 0) ++s.towards_camera;
    }
  }
}

}  // namespace

FilmStatistics measure(const GoldfishFilm& film) {
  FilmStatistics s;
  std::vector<double> speeds;
  bool was_visible = false;
  s.frames = film.frame_count();
  for (int k = 0; k < s.frames; ++k) {
    const FishBounds bounds = film.bounds(k);
    if (bounds.visible && !was_visible) ++s.entries;
    was_visible = bounds.visible;
    if (!bounds.visible) ++s.empty;
    if (bounds.touches_border) ++s.cut;
    if (!bounds.visible || bounds.touches_border) continue;
    ++s.whole;
    const FishPose& p = film.pose(k);
    const double speed = std::hypot(p.velocity_x, p.velocity_y);
    if (speed < kSlow) {
      ++s.slow;
      continue;
    }
    speeds.push_back(speed);
    const Direction d =
        nearest_direction({static_cast<float>(p.velocity_x), static_cast<float>(p.velocity_y)});
    ++s.sector[static_cast<std::size_t>(d)];
  }
  std::sort(speeds.begin(), speeds.end());
  constexpr std::array<double, 5> part = {0.05, 0.25, 0.5, 0.75, 0.95};
  for (std::size_t i = 0; i < part.size() && !speeds.empty(); ++i) {
    s.speed[i] = speeds[static_cast<std::size_t>(part[i] * static_cast<double>(speeds.size() - 1))];
  }
  count_turns(film, s);
  return s;
}

std::string statistics_text(const GoldfishFilm& film) {
  const FilmStatistics s = measure(film);
  std::string text;
  char line[160];
  const auto add = [&](auto... values) {
    std::snprintf(line, sizeof line, values...);
    text += line;
  };
  const auto share = [&](int n) { return 100.0 * n / std::max(1, s.whole); };
  add("frames            %d (%.1f s at %g a second)\n", s.frames, s.frames / film.fps(),
      film.fps());
  add("fish whole        %d (%.1f %%), cut by the border %d, not there %d, comes in %d times\n",
      s.whole, 100.0 * s.whole / s.frames, s.cut, s.empty, s.entries);
  add("speed             5 %% %.0f, 25 %% %.0f, median %.0f, 75 %% %.0f, 95 %% %.0f px/s\n",
      s.speed[0], s.speed[1], s.speed[2], s.speed[3], s.speed[4]);
  add("fastest pitch     %.1f degrees a frame\n", s.fastest_pitch);
  add("left-right turns  %d, of which %d towards the camera\n", s.facing_turns, s.towards_camera);
  add("\n%-12s frames   share    turns to:  R  RD   D  LD   L  LU   U  RU rest\n", "travelled");
  for (std::size_t d = 0; d < 9; ++d) {
    const std::string name(d < 8 ? direction_name(static_cast<Direction>(d)) : "rest (slow)");
    const int count = d < 8 ? s.sector[d] : s.slow;
    add("%-12s %6d %6.1f %%             ", name.c_str(), count, share(count));
    for (const int turns : s.turns[d]) add("%3d ", turns);
    text += "\n";
  }
  return text;
}

}  // namespace vsprite::capture
