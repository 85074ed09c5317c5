// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Measures the screen from frames spread over the film. A screen of one colour is the mode of the
// colour histogram, then a robust quadratic over the picture, then a robust mean per pixel of what
// lies near that surface: the prior survives a subject that rests in one place for most of the
// film, where a plain temporal median shows the subject. A standing camera has the median instead,
// and behind what rests the colour that continues the rest (film/behind.h).
#include "film/plate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "film/behind.h"
#include "film/color.h"
#include "film/coverage.h"
#include "film/light.h"
#include "film/measure_subject.h"
#include "film/silhouette.h"
#include "film/sum_over.h"

namespace vsprite {
namespace {

using detail::Grid;
using detail::Mask;
using detail::sum_over;
using detail::Surface;
using detail::SurfaceFit;

// Luma and the two colour differences of encoded red, green, blue: invertible, so a sum as good as
// any; what matters is that colour is apart from brightness.
struct Ycc {
  float y, cb, cr;
};

Ycc ycc(float r, float g, float b) {
  const float y = 0.114f * b + 0.587f * g + 0.299f * r;
  return {y, 0.564f * (b - y), 0.713f * (r - y)};
}

Ycc cell_ycc(const Grid& grid, std::size_t i) {
  return ycc(0.25f * grid.plane[0][i], 0.25f * grid.plane[1][i], 0.25f * grid.plane[2][i]);
}

// 1.4826 x median of |r| over a histogram of quarter code values.
class Spread {
 public:
  Spread& operator+=(const Spread& other) {
    for (std::size_t i = 0; i < 1024; ++i) bins_[i] += other.bins_[i];
    count_ += other.count_;
    return *this;
  }
  void add(double r) {
    const double bin = std::abs(r) * 4;
    ++bins_[bin < 1023 ? static_cast<std::size_t>(bin) : 1023];
    ++count_;
  }
  double sigma() const {
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < 1024; ++i) {
      const std::uint64_t before = seen;
      seen += bins_[i];
      if (2 * seen >= count_ && bins_[i] > 0) {
        const double part = (0.5 * static_cast<double>(count_) - static_cast<double>(before)) /
                            static_cast<double>(bins_[i]);
        return 1.4826 * 0.25 * (static_cast<double>(i) + part);
      }
    }
    return 0;
  }

 private:
  std::uint64_t bins_[1024] = {};
  std::uint64_t count_ = 0;
};

// Of Y, Cb, Cr.
struct Spreads {
  Spread of[3];
  void add(const Ycc& d) {
    of[0].add(static_cast<double>(d.y));
    of[1].add(static_cast<double>(d.cb));
    of[2].add(static_cast<double>(d.cr));
  }
  Spreads& operator+=(const Spreads& other) {
    for (int p = 0; p < 3; ++p) of[p] += other.of[p];
    return *this;
  }
};

struct LumaCounts {
  std::uint64_t of[256] = {}, count = 0;
  void add(float y) {
    ++of[std::clamp(static_cast<int>(y + 0.5f), 0, 255)];
    ++count;
  }
  /// 0 of none.
  int median() const {
    std::uint64_t seen = 0;
    int y = 0;
    while (2 * (seen += of[y]) < count) ++y;
    return y;
  }
};

struct ScreenColor {
  double cb = 0, cr = 0, y = 0;
};

// The most frequent colour of all samples: mode of the smoothed (Cb, Cr) histogram, median luma.
ScreenColor most_frequent_color(const std::vector<Grid>& grids) {
  std::vector<std::uint32_t> bins(64 * 64);
  const auto bin = [](float c) { return std::clamp(static_cast<int>((c + 128) / 4), 0, 63); };
  for (const Grid& grid : grids)
    for (std::size_t i = 0; i < grid.cells(); i += 3) {
      const Ycc c = cell_ycc(grid, i);
      ++bins[static_cast<std::size_t>(64 * bin(c.cb) + bin(c.cr))];
    }
  int best_cb = 1;
  int best_cr = 1;
  std::uint64_t best = 0;
  for (int i = 1; i < 63; ++i)
    for (int j = 1; j < 63; ++j) {
      std::uint64_t sum = 0;
      for (int a = -1; a <= 1; ++a)
        for (int b = -1; b <= 1; ++b) sum += bins[static_cast<std::size_t>(64 * (i + a) + j + b)];
      sum += bins[static_cast<std::size_t>(64 * i + j)];
      if (sum > best) {
        best = sum;
        best_cb = i;
        best_cr = j;
      }
    }
  ScreenColor color;
  LumaCounts luma;
  for (const Grid& grid : grids)
    for (std::size_t i = 0; i < grid.cells(); i += 3) {
      const Ycc c = cell_ycc(grid, i);
      if (std::abs(bin(c.cb) - best_cb) > 1 || std::abs(bin(c.cr) - best_cr) > 1) continue;
      color.cb += static_cast<double>(c.cb);
      color.cr += static_cast<double>(c.cr);
      luma.add(c.y);
    }
  color.cb /= static_cast<double>(std::max<std::uint64_t>(luma.count, 1));
  color.cr /= static_cast<double>(std::max<std::uint64_t>(luma.count, 1));
  color.y = luma.median();
  return color;
}

// Median luma of the cells of the screen's colour; -1: there are none.
int level_of(const Grid& grid, const ScreenColor& color) {
  constexpr double kReach = 6;
  LumaCounts luma;
  for (std::size_t i = 0; i < grid.cells(); i += 7) {
    const Ycc c = cell_ycc(grid, i);
    if (std::abs(static_cast<double>(c.cb) - color.cb) > kReach ||
        std::abs(static_cast<double>(c.cr) - color.cr) > kReach)
      continue;
    luma.add(c.y);
  }
  return luma.count > 0 ? luma.median() : -1;
}

// The frames that a surface is fitted to: all, or, where the film has several exposures, those of
// the most usual one, whose luma `color` then has. The others differ from it by their drift.
std::vector<const Grid*> usual_frames(const std::vector<Grid>& grids, ScreenColor& color) {
  constexpr int kSteady = 16;  // code values between the darkest and the lightest
  std::vector<int> levels(grids.size());
  tbb::parallel_for(std::size_t{0}, grids.size(),
                    [&](std::size_t f) { levels[f] = level_of(grids[f], color); });
  const auto [darkest, lightest] = std::minmax_element(levels.begin(), levels.end());
  const bool steady = *lightest - *darkest <= kSteady;
  int usual = 0;
  std::ptrdiff_t most = 0;
  const auto near = [](int level) {
    return [level](int other) { return std::abs(other - level) <= kSteady / 4; };
  };
  for (const int level : levels)
    if (const auto count = std::count_if(levels.begin(), levels.end(), near(level));
        level >= 0 && count > most)
      usual = level, most = count;
  const bool all = steady || 4 * most < static_cast<std::ptrdiff_t>(grids.size());
  std::vector<const Grid*> chosen;
  for (std::size_t f = 0; f < grids.size(); ++f)
    if (all || near(usual)(levels[f])) chosen.push_back(&grids[f]);
  if (!all) color.y = usual;
  return chosen;
}

// A quadratic over the picture for Y, Cb, Cr, and how far bare screen lies from it.
struct ScreenSurface {
  Surface ycc;
  double sigma[3] = {};
  double share = 0;  // of all samples within reach of the surface

  std::array<double, 3> at(double u, double v) const {
    return {ycc.at(0, u, v), ycc.at(1, u, v), ycc.at(2, u, v)};
  }
  /// `middle`: the surface there.
  bool near(const Ycc& c, const std::array<double, 3>& middle) const {
    const float value[3] = {c.y, c.cb, c.cr};
    for (std::size_t p = 0; p < 3; ++p)
      if (std::abs(static_cast<double>(value[p]) - middle[p]) >= 4 * sigma[p] + 2) return false;
    return true;
  }
};

// Cells between two that are looked at: `least` of a picture of 640 pixels, more of a larger one.
int stride_of(const Grid& grid, int least) { return std::max(least, least * grid.width / 320); }

ScreenSurface fit_surface(const std::vector<const Grid*>& grids, const ScreenColor& color) {
  ScreenSurface s;
  s.ycc.coefficient[0][0] = color.y;
  s.ycc.coefficient[1][0] = color.cb;
  s.ycc.coefficient[2][0] = color.cr;
  s.sigma[0] = 14;  // the first reach: 58 in luma, 12 in colour
  s.sigma[1] = s.sigma[2] = 2.5;
  const int step = stride_of(*grids[0], 3);
  for (int round = 0; round < 6; ++round) {
    SurfaceFit fit;
    Spread spread[3];
    std::uint64_t kept = 0;
    std::uint64_t seen = 0;
    for (const Grid* grid : grids)
      for (int y = 1; y < grid->height; y += step)
        for (int x = 1; x < grid->width; x += step) {
          const Ycc c =
              cell_ycc(*grid, static_cast<std::size_t>(y) * static_cast<std::size_t>(grid->width) +
                                  static_cast<std::size_t>(x));
          const double u = detail::scaled(x, grid->width);
          const double v = detail::scaled(y, grid->height);
          ++seen;
          const auto middle = s.at(u, v);
          if (!s.near(c, middle)) continue;
          ++kept;
          const double value[3] = {c.y, c.cb, c.cr};
          fit.add(u, v, value);
          for (int p = 0; p < 3; ++p) spread[p].add(value[p] - middle[static_cast<std::size_t>(p)]);
        }
    s.share = static_cast<double>(kept) / static_cast<double>(std::max<std::uint64_t>(seen, 1));
    if (kept == 0) return s;
    // The spread about the surface before; the first round's is about a constant.
    if (round > 0)
      for (int p = 0; p < 3; ++p) s.sigma[p] = spread[p].sigma();
    fit.solve(s.ycc);
  }
  return s;
}

// What a cell looks like when bare: its centre per plane (R, G, B code values) and, per frame,
// where.
struct Bare {
  std::vector<float> centre[3];
  std::vector<Mask> in;  // one a frame
  double sigma[3] = {};  // Y, Cb, Cr of single samples about the centre
  double steady = 0;     // share of samples near their centre
};

// Median over time of each cell, of the samples that what `admit` makes for the cell admits.
template <class Admit>
void find_centres(const std::vector<Grid>& grids, Bare& bare, Admit admit,
                  std::vector<std::uint8_t>& known) {
  const std::size_t cells = grids[0].cells();
  known.assign(cells, 1);
  for (auto& centre : bare.centre) centre.assign(cells, 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells, 4096), [&](const auto& range) {
    std::vector<std::uint16_t> values[3];
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      for (auto& v : values) v.clear();
      const auto admitted = admit(i);
      for (const Grid& grid : grids)
        if (admitted(grid))
          for (int p = 0; p < 3; ++p) values[p].push_back(grid.plane[p][i]);
      if (values[0].size() * 25 < grids.size() || values[0].empty()) {
        known[i] = 0;
        continue;
      }
      const auto middle = static_cast<std::ptrdiff_t>(values[0].size() / 2);
      for (int p = 0; p < 3; ++p) {
        std::nth_element(values[p].begin(), values[p].begin() + middle, values[p].end());
        bare.centre[p][i] = 0.25f * values[p][static_cast<std::size_t>(middle)];
      }
    }
  });
}

Ycc from_centre(const Bare& bare, const Grid& grid, std::size_t i) {
  return ycc(0.25f * grid.plane[0][i] - bare.centre[0][i],
             0.25f * grid.plane[1][i] - bare.centre[1][i],
             0.25f * grid.plane[2][i] - bare.centre[2][i]);
}

// Bare samples lie within 3.5 sigma + 1 of the centre and so do all their neighbours: the erosion
// keeps motion blur and bleeding colour out of the plate.
// `most`: no larger a sigma is believed. Where the subject covers half of all samples the spread is
// its own.
void find_bare(const std::vector<Grid>& grids, const double (&most)[3], Bare& bare) {
  const auto spread = sum_over<Spreads>(grids.size(), [&](std::size_t f, Spreads& sum) {
    for (std::size_t i = 0; i < grids[f].cells(); i += 5) sum.add(from_centre(bare, grids[f], i));
  });
  float reach[3];
  for (int p = 0; p < 3; ++p) {
    bare.sigma[p] = std::min(spread.of[p].sigma(), most[p]);
    reach[p] = static_cast<float>(3.5 * bare.sigma[p] + 1);
  }
  bare.in.resize(grids.size());
  const auto near = sum_over<std::uint64_t>(grids.size(), [&](std::size_t f, std::uint64_t& sum) {
    const Grid& grid = grids[f];
    Mask mask(grid.width, grid.height);
    for (std::size_t i = 0; i < grid.cells(); ++i) {
      const Ycc d = from_centre(bare, grid, i);
      mask.in[i] =
          std::abs(d.y) < reach[0] && std::abs(d.cb) < reach[1] && std::abs(d.cr) < reach[2] ? 1
                                                                                             : 0;
      // Steadiness asks for more than noise, a change that a person would see, but not for more
      // than any camera's noise.
      if (std::abs(d.y) < std::clamp(reach[0], 12.0f, 24.0f) &&
          std::abs(d.cb) < std::clamp(reach[1], 6.0f, 12.0f) &&
          std::abs(d.cr) < std::clamp(reach[2], 6.0f, 12.0f))
        ++sum;
    }
    bare.in[f] = erode(mask, 2);
  });
  bare.steady = static_cast<double>(near) /
                (static_cast<double>(grids.size()) * static_cast<double>(grids[0].cells()));
}

// Means of the bare samples, per cell and per pixel; the centre where nothing was bare.
void average_bare(std::span<const Frame> frames, const std::vector<Grid>& grids, const Bare& bare,
                  ScreenModel& screen) {
  const std::size_t cells = grids[0].cells();
  std::vector<std::uint16_t> count(cells);
  std::vector<std::uint32_t> sums[3];
  for (int p = 0; p < 3; ++p) sums[p].assign(cells, 0);
  const std::size_t row = static_cast<std::size_t>(screen.width);
  std::vector<std::uint32_t> luma(frames[0].y.size());
  std::vector<std::uint32_t> blue(cells);
  std::vector<std::uint32_t> red(cells);
  tbb::parallel_for(0, grids[0].height, [&](int cy) {
    const auto begin = static_cast<std::size_t>(cy) * static_cast<std::size_t>(grids[0].width);
    const auto end = begin + static_cast<std::size_t>(grids[0].width);
    for (std::size_t f = 0; f < frames.size(); ++f) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!bare.in[f].in[i]) continue;
        ++count[i];
        for (int p = 0; p < 3; ++p) sums[p][i] += grids[f].plane[p][i];
        blue[i] += frames[f].cb[i];
        red[i] += frames[f].cr[i];
      }
      const std::uint8_t* in = bare.in[f].row(cy);
      for (int y = 2 * cy; y < std::min(2 * cy + 2, screen.height); ++y)
        for (int x = 0; x < screen.width; ++x) {
          const std::size_t at = static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x);
          if (in[x / 2]) luma[at] += frames[f].y[at];
        }
    }
  });
  std::size_t hidden = 0;
  Frame& plate = screen.plate;
  plate.resize(screen.width, screen.height);
  plate.coding = frames[0].coding;
  screen.luma.resize(plate.y.size());
  const YccOfRgb to_ycc = ycc_of_rgb(plate.coding);
  const auto mean = [](std::uint32_t sum, std::uint32_t n) {
    return static_cast<std::uint8_t>((sum + n / 2) / n);
  };
  for (int p = 0; p < 3; ++p) screen.cells[p].resize(cells);
  std::vector<std::uint8_t> centre_luma(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    for (int p = 0; p < 3; ++p)
      screen.cells[p][i] =
          count[i] ? 0.25f * static_cast<float>(sums[p][i]) / count[i] : bare.centre[p][i];
    if (count[i]) {
      plate.cb[i] = mean(blue[i], count[i]);
      plate.cr[i] = mean(red[i], count[i]);
      continue;
    }
    ++hidden;
    const auto codes = to_ycc.codes(bare.centre[0][i], bare.centre[1][i], bare.centre[2][i]);
    centre_luma[i] = codes[0];
    plate.cb[i] = codes[1];
    plate.cr[i] = codes[2];
  }
  screen.hidden = static_cast<float>(static_cast<double>(hidden) / static_cast<double>(cells));
  for (int y = 0; y < screen.height; ++y)
    for (int x = 0; x < screen.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(grids[0].width) +
          static_cast<std::size_t>(x / 2);
      const std::size_t at = static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x);
      plate.y[at] = count[i] ? mean(luma[at], count[i]) : centre_luma[i];
      screen.luma[at] = static_cast<std::uint16_t>(
          count[i] ? (64 * luma[at] + count[i] / 2u) / count[i] : 64u * centre_luma[i]);
    }
  screen.cell_luma.resize(cells);
  const int gw = grids[0].width;
  for (int cy = 0; cy < grids[0].height; ++cy)
    for (int cx = 0; cx < gw; ++cx) {
      std::uint32_t sum = 0;
      for (int k = 0; k < 4; ++k)
        sum +=
            screen
                .luma[static_cast<std::size_t>(std::min(2 * cy + k / 2, screen.height - 1)) * row +
                      static_cast<std::size_t>(std::min(2 * cx + k % 2, screen.width - 1))];
      screen.cell_luma[static_cast<std::size_t>(cy) * static_cast<std::size_t>(gw) +
                       static_cast<std::size_t>(cx)] = static_cast<std::uint16_t>((sum + 32) / 64);
    }
  // From 64 Y to linear light.
  const auto& light = detail::linear_of_sums();
  for (std::uint16_t& value : screen.luma) {
    const float code = 4 * (static_cast<float>(value) / 64 - to_ycc.black) / to_ycc.luma;
    const float bounded = std::clamp(code, 0.0f, 1019.99f);
    const auto low = static_cast<std::size_t>(bounded);
    value = static_cast<std::uint16_t>(
        65535 * (light[low] + (light[low + 1] - light[low]) * (bounded - static_cast<float>(low))) +
        0.5f);
  }
}

// Noise of the bare screen about the plate and the frame's own drift, by median: what is left of
// the subject does not count.
void measure_noise(std::span<const Frame> frames, const std::vector<Grid>& grids, const Bare& bare,
                   ScreenModel& screen) {
  const auto spread = sum_over<Spreads>(grids.size(), [&](std::size_t f, Spreads& sum) {
    const Grid& grid = grids[f];
    const Surface drift = detail::fit_drift(screen, frames[f], 9);
    const int step = stride_of(grid, 2);
    for (int y = 1; y < grid.height; y += step)
      for (int x = 1; x < grid.width; x += step) {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) +
                              static_cast<std::size_t>(x);
        if (!bare.in[f].in[i]) continue;
        const double u = detail::scaled(x, grid.width);
        const double v = detail::scaled(y, grid.height);
        float d[3];
        for (int p = 0; p < 3; ++p)
          d[p] =
              0.25f * grid.plane[p][i] - screen.cells[p][i] - static_cast<float>(drift.at(p, u, v));
        sum.add(ycc(d[0], d[1], d[2]));
      }
  });
  for (int p = 0; p < 3; ++p) screen.noise[p] = static_cast<float>(spread.of[p].sigma());
  screen.threshold = std::clamp(8 * screen.whole_noise(), 9.0f, 24.0f);
}

// Median of each channel over the plate.
void measure_color(ScreenModel& screen) {
  for (int c = 0; c < 3; ++c) {
    std::vector<float> values = screen.cells[c];
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    screen.color[c] = *middle;
  }
}

// The colour difference in which the screen is strong, -1 if it is too grey for one. Warm ones have
// to be stronger: wood and skin are not screens.
int choose_key(const float (&color)[3]) {
  float light[3];
  for (int c = 0; c < 3; ++c)
    light[c] = detail::linear_of_sums()[static_cast<std::size_t>(
        std::clamp(4 * color[c] + 0.5f, 0.0f, 1020.0f))];
  int best = -1;
  float strength = 0.02f;
  const float largest = std::max({light[0], light[1], light[2]});
  for (int key = 0; key < detail::kKeyCount; ++key) {
    const bool warm = key == 0 || key == 5;
    const float k = detail::key_strength(key, light[0], light[1], light[2]);
    if (k > strength && k > (warm ? 0.45f : 0.25f) * largest) {
      strength = k;
      best = key;
    }
  }
  return best;
}

std::string percent(double share) {
  return std::to_string(static_cast<int>(100 * share + 0.5)) + " %";
}

std::string color_text(const float (&color)[3]) {
  char text[16];
  std::snprintf(text, sizeof text, "#%02X%02X%02X", static_cast<unsigned>(color[0] + 0.5f),
                static_cast<unsigned>(color[1] + 0.5f), static_cast<unsigned>(color[2] + 0.5f));
  return text;
}

// The encoded colour at the surface's middle.
void surface_color(const ScreenSurface& s, float (&color)[3]) {
  const double y = s.ycc.at(0, 0, 0);
  const double b = y + s.ycc.at(1, 0, 0) / 0.564;
  const double r = y + s.ycc.at(2, 0, 0) / 0.713;
  const double g = (y - 0.114 * b - 0.299 * r) / 0.587;
  const double rgb[3] = {r, g, b};
  for (int c = 0; c < 3; ++c) color[c] = static_cast<float>(std::clamp(rgb[c], 0.0, 255.0));
}

void model_colored(std::span<const Frame> frames, const std::vector<Grid>& grids,
                   const ScreenSurface& surface, ScreenModel& screen) {
  Bare bare;
  std::vector<std::uint8_t> known;
  const int w = grids[0].width;
  const int h = grids[0].height;
  const auto place = [&](std::size_t i) {
    const int x = static_cast<int>(i % static_cast<std::size_t>(w));
    const int y = static_cast<int>(i / static_cast<std::size_t>(w));
    return std::pair{detail::scaled(x, w), detail::scaled(y, h)};
  };
  find_centres(
      grids, bare,
      [&](std::size_t i) {
        const auto [u, v] = place(i);
        return [&surface, i, middle = surface.at(u, v)](const Grid& grid) {
          return surface.near(cell_ycc(grid, i), middle);
        };
      },
      known);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i]) continue;
    const auto [u, v] = place(i);
    const double y = surface.ycc.at(0, u, v);
    const double b = y + surface.ycc.at(1, u, v) / 0.564;
    const double r = y + surface.ycc.at(2, u, v) / 0.713;
    bare.centre[0][i] = static_cast<float>(r);
    bare.centre[1][i] = static_cast<float>((y - 0.114 * b - 0.299 * r) / 0.587);
    bare.centre[2][i] = static_cast<float>(b);
  }
  find_bare(grids, surface.sigma, bare);
  average_bare(frames, grids, bare, screen);
  measure_noise(frames, grids, bare, screen);
  measure_color(screen);
  screen.kind = KeyKind::Color;
  screen.key = choose_key(screen.color);
}

constexpr double kAnySigma[3] = {255, 255, 255};

Result<ScreenModel> model_standing(std::span<const Frame> frames, const std::vector<Grid>& grids,
                                   double least_steady, ScreenModel screen) {
  Bare bare;
  std::vector<std::uint8_t> known;
  find_centres(
      grids, bare, [](std::size_t) { return [](const Grid&) { return true; }; }, known);
  find_bare(grids, kAnySigma, bare);
  const double noise =
      std::sqrt(bare.sigma[0] * bare.sigma[0] +
                2 * (bare.sigma[1] * bare.sigma[1] + bare.sigma[2] * bare.sigma[2]));
  Mask invented;
  if (detail::look_behind(grids, static_cast<float>(noise), bare.centre, invented)) {
    find_bare(grids, kAnySigma, bare);
  }
  if (bare.steady < least_steady)
    return Error{ErrorCode::BadContent,
                 "no steady background: no colour fills the picture and " +
                     percent(1 - bare.steady) +
                     " of it differs from its own median over time; due: a screen of one colour or "
                     "a camera that stands still, its exposure locked"};
  average_bare(frames, grids, bare, screen);
  measure_noise(frames, grids, bare, screen);
  measure_color(screen);
  screen.kind = KeyKind::Plate;
  screen.witness = std::move(invented.in);
  screen.witness.resize(bare.centre[0].size());
  screen.reason =
      "plate: the camera stands, " + percent(bare.steady) + " of the picture stays as it is";
  return screen;
}

}  // namespace

float ScreenModel::whole_noise() const noexcept {
  return std::sqrt(noise[0] * noise[0] + 2 * (noise[1] * noise[1] + noise[2] * noise[2]));
}

Result<KeyConfig> parse_key(const std::string& text) {
  KeyConfig config;
  if (text == "auto") return config;
  if (text == "plate") {
    config.kind = KeyKind::Plate;
    return config;
  }
  if (text == "alpha") {
    config.kind = KeyKind::Alpha;
    return config;
  }
  if (text == "none") {
    config.kind = KeyKind::None;
    return config;
  }
  if (text.size() == 7 && text[0] == '#' &&
      text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos) {
    const unsigned long value = std::stoul(text.substr(1), nullptr, 16);
    config.kind = KeyKind::Color;
    config.red = static_cast<std::uint8_t>(value >> 16);
    config.green = static_cast<std::uint8_t>(value >> 8 & 255);
    config.blue = static_cast<std::uint8_t>(value & 255);
    config.color_given = true;
    return config;
  }
  return Error{ErrorCode::BadSetting,
               "key: '" + text + "' is unknown; due: auto, plate, alpha, none or #RRGGBB"};
}

Result<ScreenModel> measure_screen(std::span<const Frame> frames, const KeyConfig& config) {
  if (frames.empty()) return Error{ErrorCode::BadContent, "no frames to measure the screen on"};
  ScreenModel screen;
  screen.width = frames[0].width;
  screen.height = frames[0].height;
  if (config.kind == KeyKind::None) {
    screen.kind = KeyKind::None;
    screen.reason = "none: the whole frame is the subject, as asked";
    return screen;
  }
  const bool asked = config.kind == KeyKind::Alpha;
  if (asked && frames[0].rgba.empty())
    return Error{ErrorCode::BadContent,
                 "no alpha: its format has no room for coverage; due: PNG, ProRes 4444, VP9 with "
                 "alpha or the like, or --matte FILE"};
  if (asked || (config.kind == KeyKind::Auto && detail::carries_coverage(frames)))
    return detail::coverage_model(frames);
  std::vector<Grid> grids(frames.size());
  tbb::parallel_for(std::size_t{0}, frames.size(),
                    [&](std::size_t f) { detail::make_grid(frames[f], grids[f]); });

  if (config.kind != KeyKind::Plate) {
    ScreenColor color;
    if (config.color_given) {
      const Ycc given = ycc(config.red, config.green, config.blue);
      color = {static_cast<double>(given.cb), static_cast<double>(given.cr),
               static_cast<double>(given.y)};
    } else {
      color = most_frequent_color(grids);
    }
    const ScreenSurface surface = fit_surface(usual_frames(grids, color), color);
    float rgb[3];
    surface_color(surface, rgb);
    const bool keyed = choose_key(rgb) >= 0 && surface.share > 0.3 && surface.sigma[0] < 14;
    const bool plain = surface.share > 0.5 && surface.sigma[0] < 4;
    if (config.color_given && surface.share < 0.05)
      return Error{ErrorCode::BadContent,
                   "no screen of the colour asked for: " + percent(surface.share) +
                       " of the picture is near it; due: 5 % at least"};
    if (config.color_given || keyed || plain) {
      model_colored(frames, grids, surface, screen);
      screen.reason = std::string(keyed ? "coloured" : "plain") + " screen " +
                      color_text(screen.color) + ": " + percent(surface.share) +
                      " of the picture lies near one smooth surface";
      detail::measure_subject(frames, screen);
      return screen;
    }
  }
  auto standing = model_standing(frames, grids, config.kind == KeyKind::Plate ? 0.4 : 0.75, screen);
  if (standing) detail::measure_subject(frames, *standing);
  return standing;
}

}  // namespace vsprite
