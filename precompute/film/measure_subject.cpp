// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/measure_subject.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "film/cut.h"
#include "film/lanes.h"
#include "film/light.h"
#include "film/silhouette.h"
#include "film/sum_over.h"

namespace vsprite::detail {
namespace {

// Where a standing plate is of the subject's own colour, the mouse before the dark wall, its shadow
// and reflection differ from it as much as it does.
void mark_unlike(const float (&subject)[3], ScreenModel& screen) {
  const float least = kUnlike * screen.subject_contrast;
  screen.unlike.resize(screen.cells[0].size());
  for (std::size_t i = 0; i < screen.unlike.size(); ++i) {
    const float away =
        distance_squared(subject[0] - screen.cells[0][i], subject[1] - screen.cells[1][i],
                         subject[2] - screen.cells[2][i]);
    screen.unlike[i] = away > least * least ? 1 : 0;
  }
}

// The colours of what stands out as the subject does: its shadow is fainter. A plate of such a
// colour where the subject was about in a quarter of the frames may be the subject.
void learn_colors(std::span<const Frame> frames, ScreenModel& screen) {
  constexpr int kLikely = 480;  // of a colour that the subject has
  SubjectColors colors;
  Silhouette s;
  const int width = (screen.width + 1) / 2;
  std::vector<std::uint16_t> visits(screen.cells[0].size());
  int seen = 0;
  for (const Frame& frame : frames) {
    find_silhouette(screen, frame, s);
    if (s.empty) continue;
    ++seen;
    const Mask inside = erode(s.mask, 1);
    const Mask near = dilate(s.mask, kCutReach);
    for (int y = 0; y < inside.height; ++y)
      for (int x = 0; x < inside.width; ++x) {
        const auto i = static_cast<std::size_t>(y * inside.width + x);
        const auto cell = static_cast<std::size_t>((s.window.top + y) * width + s.window.left + x);
        visits[cell] += near.in[i];
        if (inside.in[i] &&
            (s.contrast[i] > 0.5f * screen.subject_contrast || screen.witness[cell] == kInvented))
          colors.add(s.grid.plane[0][i], s.grid.plane[1][i], s.grid.plane[2][i]);
      }
  }
  screen.subject_cost = colors.costs();
  for (std::size_t i = 0; i < visits.size() && !screen.subject_cost.empty(); ++i) {
    const auto sum = [&](int p) {
      return static_cast<int>(4 * std::clamp(screen.cells[p][i], 0.0f, 255.0f));
    };
    if (4 * visits[i] > seen && screen.subject_cost[color_step(sum(0), sum(1), sum(2))] < kLikely)
      screen.witness[i] = kOccupied;
  }
}

// Histograms of what stands out, of one frame or of all.
struct SubjectFigures {
  static constexpr float kKeySteps = 50;  // of v, and of the distance to the plate without a key
  static constexpr float kDistanceSteps = 200;

  std::vector<std::uint32_t> strengths = std::vector<std::uint32_t>(400);
  std::vector<std::uint32_t> contrasts = std::vector<std::uint32_t>(512);
  std::vector<std::uint64_t> colors[3] = {  // sums of four, by contrast
      std::vector<std::uint64_t>(512), std::vector<std::uint64_t>(512),
      std::vector<std::uint64_t>(512)};
  std::uint64_t strength_count = 0, contrast_count = 0;
  std::vector<int> areas;  // of the largest part of each frame, in any order

  void add_frame(const ScreenModel& screen, const Frame& frame);
  SubjectFigures& operator+=(const SubjectFigures& other);

 private:
  void add_strengths(const ScreenModel& screen, const Silhouette& s);
};

SubjectFigures& SubjectFigures::operator+=(const SubjectFigures& other) {
  const auto sum = [](auto& to, const auto& from) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus<>());
  };
  sum(strengths, other.strengths);
  sum(contrasts, other.contrasts);
  for (int p = 0; p < 3; ++p) sum(colors[p], other.colors[p]);
  strength_count += other.strength_count;
  contrast_count += other.contrast_count;
  areas.insert(areas.end(), other.areas.begin(), other.areas.end());
  return *this;
}

void SubjectFigures::add_frame(const ScreenModel& screen, const Frame& frame) {
  Silhouette s;
  find_silhouette(screen, frame, s);
  if (s.empty) return;
  std::vector<int> labels;
  const int parts = connected_parts(s.mask, labels);
  std::vector<int> size(static_cast<std::size_t>(parts) + 1);
  for (const int label : labels) ++size[static_cast<std::size_t>(label)];
  areas.push_back(*std::max_element(size.begin() + 1, size.end()));
  const Mask inside = erode(s.mask, 1);
  for (std::size_t i = 0; i < inside.in.size(); ++i) {
    if (!inside.in[i]) continue;
    const auto of = std::min(static_cast<std::size_t>(s.contrast[i]), contrasts.size() - 1);
    ++contrasts[of];
    ++contrast_count;
    for (std::size_t p = 0; p < 3; ++p) colors[p][of] += s.grid.plane[p][i];
  }
  if (screen.kind != KeyKind::Plate) add_strengths(screen, s);
}

// How strong its colours are against the key.
void SubjectFigures::add_strengths(const ScreenModel& screen, const Silhouette& s) {
  const Mask deep = erode(s.mask, 4);
  std::vector<float> away(deep.in.size());
  if (screen.key < 0)
    lanes().distance({s.frame[0].data(), s.frame[1].data(), s.frame[2].data()},
                     {s.plate[0].data(), s.plate[1].data(), s.plate[2].data()}, away.size(),
                     away.data());
  for (std::size_t i = 0; i < deep.in.size(); ++i) {
    if (!deep.in[i]) continue;
    if (screen.key < 0) {
      ++strengths[static_cast<std::size_t>(std::min(away[i] * kDistanceSteps, 399.0f))];
      ++strength_count;
      continue;
    }
    const float full = key_strength(screen.key, s.plate[0][i], s.plate[1][i], s.plate[2][i]);
    if (!(full > 0.02f)) continue;
    const float v =
        1 - key_strength(screen.key, s.frame[0][i], s.frame[1][i], s.frame[2][i]) / full;
    ++strengths[static_cast<std::size_t>(std::clamp(v * kKeySteps, 0.0f, 399.0f))];
    ++strength_count;
  }
}

}  // namespace

void measure_subject(std::span<const Frame> frames, ScreenModel& screen) {
  prepare_model(screen);
  auto [strengths, contrasts, colors, strength_count, contrast_count, areas] =
      sum_over<SubjectFigures>(frames.size(), [&](std::size_t f, SubjectFigures& sum) {
        sum.add_frame(screen, frames[f]);
      });
  std::uint64_t seen = 0;
  std::size_t bin = 0;
  while (bin < 399 && 10 * (seen += strengths[bin]) < 9 * strength_count) ++bin;
  if (strength_count > 0)
    screen.key_normaliser =
        (static_cast<float>(bin) + 0.5f) /
        (screen.key >= 0 ? SubjectFigures::kKeySteps : SubjectFigures::kDistanceSteps);
  if (screen.key >= 0) screen.key_normaliser = std::max(1.0f, screen.key_normaliser);
  // Half of all cells reach the usual contrast. Before a standing camera it is half of all contrast
  // that does: shadows and reflections are faint, however wide.
  std::vector<std::uint64_t> weights(contrasts.begin(), contrasts.end());
  std::uint64_t whole = 0;
  if (screen.kind == KeyKind::Plate)
    for (std::size_t k = 0; k < contrasts.size(); ++k) weights[k] *= k;
  for (const std::uint64_t weight : weights) whole += weight;
  seen = 0;
  bin = 0;
  while (bin < contrasts.size() - 1 && 2 * (seen += weights[bin]) < whole) ++bin;
  screen.subject_contrast = static_cast<float>(bin);
  if (screen.kind == KeyKind::Plate && contrast_count > 0) {
    float subject[3];
    for (int p = 0; p < 3; ++p) {
      double sum = 0;
      double count = 0;
      for (std::size_t k = bin; k < contrasts.size(); ++k) {
        sum += static_cast<double>(colors[p][k]);
        count += contrasts[k];
      }
      subject[p] = static_cast<float>(0.25 * sum / count);
    }
    mark_unlike(subject, screen);
    learn_colors(frames, screen);
  }
  if (areas.empty()) return;
  std::nth_element(areas.begin(), areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2),
                   areas.end());
  const double side = std::sqrt(static_cast<double>(areas[areas.size() / 2]));
  screen.opening = std::max(1, static_cast<int>(0.1 * side + 0.5));
}

}  // namespace vsprite::detail
