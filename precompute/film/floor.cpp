// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/floor.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace vsprite {
namespace {

constexpr std::size_t kMostSights = 400;  // of whose pairs slopes are taken
constexpr double kLeastGrowth = 1.15;     // nearest height over furthest
constexpr double kLeastDepth = 0.02;      // feet below the horizon, of those of the nearest

std::string px(double value) { return std::to_string(std::lround(value)); }

double middle(std::vector<double>& values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Error no_fit(const std::string& what) {
  return {ErrorCode::BadContent,
          "--horizon fit: " + what +
              ": due: film in which it walks toward the camera and away, or --horizon Y"};
}

Result<double> fit_horizon(std::span<const Standing> sights) {
  std::vector<Standing> some;
  const std::size_t stride = (sights.size() + kMostSights - 1) / kMostSights;
  for (std::size_t k = 0; k < sights.size(); k += stride) some.push_back(sights[k]);
  std::sort(some.begin(), some.end(), [](const Standing& a, const Standing& b) {
    return a.feet != b.feet ? a.feet < b.feet : a.height < b.height;
  });
  // Slopes of near pairs are noise: only those a third of the way apart count.
  const double least = (some.back().feet - some.front().feet) / 3;
  if (!(least > 0)) return no_fit("the subject's feet stay at y = " + px(some[0].feet));
  std::vector<double> slopes, rests;
  for (std::size_t a = 0; a < some.size(); ++a)
    for (std::size_t b = a + 1; b < some.size(); ++b)
      if (some[b].feet - some[a].feet >= least)
        slopes.push_back((some[b].height - some[a].height) / (some[b].feet - some[a].feet));
  const double slope = middle(slopes);
  for (const Standing& s : some) rests.push_back(s.height - slope * s.feet);
  const double rest = middle(rests);
  const double far = slope * some.front().feet + rest, near = slope * some.back().feet + rest;
  if (!(slope > 0) || !(far > 0) || near < kLeastGrowth * far)
    return no_fit("the subject keeps its size, " + px(far) +
                  " px with its feet at y = " + px(some.front().feet) + " and " + px(near) +
                  " px at y = " + px(some.back().feet));
  return -rest / slope;
}

}  // namespace

FloorPlace on_floor(const Ground& ground, double x, double y) {
  const double horizon = static_cast<double>(ground.horizon),
               focal = static_cast<double>(ground.focal);
  const double s = (y - horizon) / (static_cast<double>(ground.line) - horizon);
  return {(x - static_cast<double>(ground.center)) / s, focal * (1 - 1 / s), s};
}

Result<Ground> find_floor(std::span<const Standing> sights, const FloorChoice& choice, int width) {
  if (sights.empty()) return Error{ErrorCode::BadContent, "no subject stands on the floor"};
  double horizon = choice.horizon.value_or(0);
  if (choice.fitted) {
    const auto fitted = fit_horizon(sights);
    if (!fitted) return fitted.error();
    horizon = *fitted;
  }
  const auto by_feet = [](const Standing& a, const Standing& b) { return a.feet < b.feet; };
  const auto [far, near] = std::minmax_element(sights.begin(), sights.end(), by_feet);
  const double line = choice.line > 0 ? choice.line : near->feet;
  if (line <= horizon)
    return Error{ErrorCode::BadContent, "the ground line at y = " + px(line) +
                                            " lies above the horizon at " + px(horizon) +
                                            ": one below it is due"};
  if (far->feet - horizon < kLeastDepth * (near->feet - horizon) || far->feet <= horizon)
    return Error{ErrorCode::BadContent, "the subject's feet come to y = " + px(far->feet) +
                                            ", at the horizon at " + px(horizon) +
                                            " or above it: a smaller --horizon is due"};
  return Ground{static_cast<float>(horizon), static_cast<float>(line),
                static_cast<float>(width) / 2,
                static_cast<float>(choice.focal > 0 ? choice.focal : 0.8 * width)};
}

}  // namespace vsprite
