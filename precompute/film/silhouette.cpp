// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Exposure drift, distance to the plate, shadows, and the cleaned map of what is left.
#include "film/silhouette.h"

#include <algorithm>
#include <cmath>

#include "film/color.h"
#include "film/cut.h"
#include "film/light.h"
#include "hwy/cache_control.h"

namespace vsprite::detail {

float key_strength(int key, float r, float g, float b) noexcept {
  switch (key) {
    case 0:
      return r - std::max(g, b);
    case 1:
      return g - std::max(r, b);
    case 2:
      return b - std::max(r, g);
    case 3:
      return std::min(g, b) - r;
    case 4:
      return std::min(r, b) - g;
    case 5:
      return std::min(r, g) - b;
    default:
      return 0;
  }
}

void SurfaceFit::add(double x, double y, const double (&value)[3]) {
  const double term[6] = {1, x, y, x * x, x * y, y * y};
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) normal_[i][j] += term[i] * term[j];
    for (int p = 0; p < 3; ++p) right_[p][i] += term[i] * value[p];
  }
  ++count_;
}

// Cholesky of the 6 x 6 normal equations, a little ridge on all but the constant.
bool SurfaceFit::solve(Surface& surface) const {
  surface = Surface{};
  if (count_ == 0) return false;
  for (int p = 0; p < 3; ++p) surface.coefficient[p][0] = right_[p][0] / count_;
  if (count_ < 60) return false;
  double l[6][6] = {};
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = normal_[j][i] + (i == j && i > 0 ? 1e-4 * count_ : 0.0);
      for (int k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i == j) {
        if (!(sum > 1e-9 * count_)) return false;
        l[i][i] = std::sqrt(sum);
      } else {
        l[i][j] = sum / l[j][j];
      }
    }
  for (int p = 0; p < 3; ++p) {
    double z[6];
    for (int i = 0; i < 6; ++i) {
      z[i] = right_[p][i];
      for (int k = 0; k < i; ++k) z[i] -= l[i][k] * z[k];
      z[i] /= l[i][i];
    }
    for (int i = 5; i >= 0; --i) {
      for (int k = i + 1; k < 6; ++k) z[i] -= l[k][i] * z[k];
      z[i] /= l[i][i];
    }
    std::copy(z, z + 6, surface.coefficient[p]);
  }
  return true;
}

namespace {

// Cells spread over the frame and their distance from the plate.
struct DriftSample {
  double u, v;
  float residual[3];
};

std::vector<DriftSample> sample_drift(const ScreenModel& screen, const Frame& frame, int step) {
  std::vector<DriftSample> samples;
  const RgbOfYcc m = rgb_of_ycc(frame.coding);
  const int w = frame.cell_width();
  const int h = frame.cell_height();
  const auto luma = [&](int x, int y) {
    return static_cast<int>(frame.y[static_cast<std::size_t>(std::min(y, frame.height - 1)) *
                                        static_cast<std::size_t>(frame.width) +
                                    static_cast<std::size_t>(std::min(x, frame.width - 1))]);
  };
  for (int y = step / 2; y < h; y += step)
    for (int x = step / 2; x < w; x += step) {
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
      const int sum = luma(2 * x, 2 * y) + luma(2 * x + 1, 2 * y) + luma(2 * x, 2 * y + 1) +
                      luma(2 * x + 1, 2 * y + 1);
      const auto rgb = m.sums(sum, frame.cb[i], frame.cr[i], 4);
      DriftSample s{scaled(x, w), scaled(y, h), {}};
      for (std::size_t p = 0; p < 3; ++p)
        s.residual[p] = 0.25f * static_cast<float>(rgb[p]) - screen.cells[p][i];
      samples.push_back(s);
    }
  return samples;
}

// None, or, where less than a quarter of the samples lies within `reach` of none and more of their
// median, that: another exposure.
Surface first_drift(const std::vector<DriftSample>& samples, float reach) {
  const auto count_near = [&](const float(&middle)[3]) {
    return std::count_if(samples.begin(), samples.end(), [&](const DriftSample& s) {
      return distance_squared(s.residual[0] - middle[0], s.residual[1] - middle[1],
                              s.residual[2] - middle[2]) < reach * reach;
    });
  };
  Surface drift;
  const auto still = count_near({0, 0, 0});
  if (samples.empty() || 4 * still >= static_cast<std::ptrdiff_t>(samples.size())) return drift;
  float middle[3];
  std::vector<float> values(samples.size());
  for (int p = 0; p < 3; ++p) {
    std::transform(samples.begin(), samples.end(), values.begin(),
                   [p](const DriftSample& s) { return s.residual[p]; });
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    middle[p] = *half;
  }
  if (count_near(middle) > still)
    for (int p = 0; p < 3; ++p) drift.coefficient[p][0] = static_cast<double>(middle[p]);
  return drift;
}

}  // namespace

// The residual of the sure background, some thousand cells of it, in four rounds. Each round
// believes what lies near the round before.
Surface fit_drift(const ScreenModel& screen, const Frame& frame, float reach) {
  const int step = std::max(4, frame.cell_width() / 32);
  const auto samples = sample_drift(screen, frame, step);
  Surface drift = first_drift(samples, 4 * reach);
  std::vector<std::uint8_t> believed(samples.size()), before;
  for (const float limit : {4 * reach, 2 * reach, reach, reach}) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const DriftSample& s = samples[i];
      float left[3];
      for (int p = 0; p < 3; ++p)
        left[p] = static_cast<float>(static_cast<double>(s.residual[p]) - drift.at(p, s.u, s.v));
      believed[i] = distance_squared(left[0], left[1], left[2]) < limit * limit ? 1 : 0;
    }
    if (believed == before) continue;  // the same surface again
    before = believed;
    SurfaceFit fit;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (const auto& [r, g, b] = samples[i].residual; believed[i])
        fit.add(samples[i].u, samples[i].v,
                {static_cast<double>(r), static_cast<double>(g), static_cast<double>(b)});
    // Too little screen in sight: the film's plate stands.
    if (fit.count() * 20 < static_cast<int>(samples.size())) return Surface{};
    fit.solve(drift);
  }
  return drift;
}

void blur3(const std::vector<float>& map, int width, int height, std::vector<float>& out) {
  const std::vector<float> zeros(static_cast<std::size_t>(width));
  out.resize(map.size());
  for (int y = 0; y < height; ++y)
    lanes().blur3(rows_around(map, width, height, y, zeros), width, 0, width,
                  out.data() + static_cast<std::ptrdiff_t>(y) * width);
}

KeyShape shape_of(int key) noexcept {
  const int main = std::max(key, 0) % 3;
  return {main, (main + 1) % 3, (main + 2) % 3, key < 3};
}

void prepare_model(ScreenModel& screen) {
  const auto& light = linear_of_sums();
  for (int p = 0; p < 3; ++p) {
    const std::size_t n = screen.cells[p].size();
    screen.linear[p].resize(n);
    screen.slope[p].resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const float code = std::clamp(4 * screen.cells[p][i], 0.0f, 1020.0f);
      const std::size_t low = std::min(static_cast<std::size_t>(code), std::size_t{1019});
      screen.linear[p][i] =
          light[low] + (light[low + 1] - light[low]) * (code - static_cast<float>(low));
      const std::size_t above = std::min(low + 4, std::size_t{1020});
      const std::size_t below = low > 4 ? low - 4 : 0;
      screen.slope[p][i] = 4 * (light[above] - light[below]) / static_cast<float>(above - below);
    }
  }
}

namespace {

constexpr int kBlockWide = 32;  // cells
constexpr int kBlockHigh = 4;
constexpr int kWindowMargin = 8;
constexpr int kFewest = 3;  // different cells that make a block worth a look

// Limits of every block of a row: those of the silhouette less what smoothing may add, about the
// frame's own drift.
void set_limits(const ScreenModel& screen, const YccOfRgb& m, const Surface& drift, double v,
                int width, std::vector<RowLimits>& limits) {
  const RowTerms red = row_of(drift, 0, v);
  const RowTerms green = row_of(drift, 1, v);
  const RowTerms blue = row_of(drift, 2, v);
  const auto whole = [](float x) {
    return static_cast<std::int16_t>(std::clamp(x < 0 ? x - 0.5f : x + 0.5f, -2000.0f, 2000.0f));
  };
  const std::int16_t limit_y = whole(4 * m.luma * 0.6f * screen.threshold);
  const std::int16_t limit_c = whole(m.color * 0.45f * screen.threshold);
  const RowScale scale = scale_of(0, width);
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const int middle = std::min(static_cast<int>(k) * kBlockWide + kBlockWide / 2, width - 1);
    const float u = scale.first + scale.step * static_cast<float>(middle);
    const auto at = [u](const RowTerms& t) { return t.a + u * (t.b + u * t.c); };
    const float r = at(red);
    const float b = at(blue);
    const float y = m.red * r + m.green * at(green) + m.blue * b;
    limits[k] = {whole(4 * m.luma * y), limit_y, whole(m.color * (b - y) / (2 - 2 * m.blue)),
                 whole(m.color * (r - y) / (2 - 2 * m.red)), limit_c};
  }
}

// The blocks that differ from the plate, with a margin: their rectangle, and a run of cells for
// each of its rows. Most blocks of most frames end here.
void find_window(const ScreenModel& screen, const Frame& frame, Silhouette& s) {
  const int w = frame.cell_width();
  const int h = frame.cell_height();
  const YccOfRgb m = ycc_of_rgb(screen.plate.coding);
  std::vector<RowLimits> limits(static_cast<std::size_t>((w + kBlockWide - 1) / kBlockWide));
  std::vector<int> counts(limits.size());
  std::vector<Span> blocks(static_cast<std::size_t>((h + kBlockHigh - 1) / kBlockHigh));
  Span all{w, 0};
  int top = h;
  int bottom = 0;
  for (int y = 0; y < h; y += kBlockHigh) {
    set_limits(screen, m, s.drift, scaled(std::min(y + kBlockHigh / 2, h - 1), h), w, limits);
    std::fill(counts.begin(), counts.end(), 0);
    for (int row = y; row < std::min(y + kBlockHigh, h); ++row) {
      const std::size_t cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(w);
      const std::uint8_t* first = frame.y.data() + static_cast<std::size_t>(2 * row) *
                                                       static_cast<std::size_t>(frame.width);
      const std::uint8_t* second = 2 * row + 1 < frame.height ? first + frame.width : first;
      lanes().count_different(first, second, frame.cb.data() + cell, frame.cr.data() + cell,
                              screen.cell_luma.data() + cell, screen.plate.cb.data() + cell,
                              screen.plate.cr.data() + cell, frame.width / 2, kBlockWide,
                              limits.data(), counts.data());
    }
    Span span{w, 0};
    for (std::size_t k = 0; k < counts.size(); ++k) {
      if (counts[k] < kFewest) continue;
      const int x = static_cast<int>(k) * kBlockWide;
      span = {std::min(span.begin, std::max(x - kWindowMargin, 0)),
              std::min(x + kBlockWide + kWindowMargin, w)};
    }
    blocks[static_cast<std::size_t>(y / kBlockHigh)] = span;
    if (span.size() == 0) continue;
    all = {std::min(all.begin, span.begin), std::max(all.end, span.end)};
    top = std::min(top, y);
    bottom = y + kBlockHigh;
  }
  s.window = {};
  if (all.size() == 0) return;
  top = std::max(top - kWindowMargin, 0);
  s.window = {all.begin, top, all.size(), std::min(bottom + kWindowMargin, h) - top};
  s.spans.assign(static_cast<std::size_t>(s.window.height), {});
  for (int y = 0; y < s.window.height; ++y) {
    Span span{w, 0};
    const int first = std::max(top + y - kWindowMargin, 0) / kBlockHigh;
    const int last = std::min(top + y + kWindowMargin, h - 1) / kBlockHigh;
    for (int k = first; k <= last; ++k) {
      const Span& block = blocks[static_cast<std::size_t>(k)];
      if (block.size()) span = {std::min(span.begin, block.begin), std::max(span.end, block.end)};
    }
    if (span.size())
      s.spans[static_cast<std::size_t>(y)] = {span.begin - all.begin, span.end - all.begin};
  }
}

// The window's spans in linear light, and the contrast of each cell to the frame's own plate.
void look_closely(const ScreenModel& screen, const Frame& frame, Silhouette& s) {
  make_grid(frame, s.window, s.spans, s.grid);
  const std::size_t n = s.window.cells();
  for (int p = 0; p < 3; ++p) {
    s.frame[p].resize(n);
    s.plate[p].resize(n);
  }
  s.rough.assign(n, 0);
  const int w = frame.cell_width();
  for (int y = 0; y < s.window.height; ++y) {
    const Span span = s.spans[static_cast<std::size_t>(y)];
    if (span.size() == 0) continue;
    const RowScale u = scale_of(s.window.left + span.begin, w);
    const double v = scaled(s.window.top + y, frame.cell_height());
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(s.window.width) +
                           static_cast<std::size_t>(span.begin);
    const std::size_t from =
        static_cast<std::size_t>(s.window.top + y) * static_cast<std::size_t>(w) +
        static_cast<std::size_t>(s.window.left + span.begin);
    const RowTerms drift[3] = {row_of(s.drift, 0, v), row_of(s.drift, 1, v), row_of(s.drift, 2, v)};
    const std::uint16_t* sums[3];
    const float* plate[3];
    // Short runs of many maps: the next row's are asked for ahead.
    if (y + 1 < s.window.height)
      for (const auto* maps : {&screen.cells, &screen.linear, &screen.slope})
        for (const std::vector<float>& map : *maps)
          for (int x = 0; x < span.size(); x += 16)
            hwy::Prefetch(map.data() + from + static_cast<std::size_t>(w + x));
    for (int p = 0; p < 3; ++p) {
      sums[p] = s.grid.plane[p].data() + at;
      plate[p] = screen.cells[p].data() + from;
      lanes().look_up(linear_of_sums().data(), sums[p], span.size(), s.frame[p].data() + at);
      lanes().shift(screen.linear[p].data() + from, screen.slope[p].data() + from, drift[p], u,
                    span.size(), s.plate[p].data() + at);
    }
    lanes().contrast(sums, plate, drift, u, span.size(), s.rough.data() + at);
    if (screen.key < 0) continue;
    const float* c[3] = {s.frame[0].data() + at, s.frame[1].data() + at, s.frame[2].data() + at};
    const float* b[3] = {s.plate[0].data() + at, s.plate[1].data() + at, s.plate[2].data() + at};
    lanes().forgive_shadows(c, b, static_cast<std::size_t>(span.size()), s.rough.data() + at);
  }
}

// Without a key faint differences are shadows, reflections and the codec's smear: they count only
// within three cells of what stands out as the subject does. Before a plate that is like it they
// count only beside that, and no shadow or reflection stands out by more than such a plate does.
void drop_faint(const ScreenModel& screen, Silhouette& s) {
  const float floor = screen.kind == KeyKind::Color ? 1.3f : 2.0f;  // plain screens are quieter
  const float least = std::max(floor * screen.threshold, 0.2f * screen.subject_contrast);
  const auto above = [&s](float contrast) {
    Mask mask(s.mask.width, s.mask.height);
    lanes().above(s.contrast.data(), contrast, mask.in.size(), mask.in.data());
    return mask;
  };
  const auto join = [](const Mask& more, Mask& mask) {
    lanes().spread_into(more.in.data(), more.in.size(), true, mask.in.data());
  };
  const auto leave_unlike = [&](Mask& mask) {
    for (int y = 0; y < s.window.height && !screen.unlike.empty(); ++y)
      lanes().spread_into(
          screen.unlike.data() +
              static_cast<std::ptrdiff_t>(s.window.top + y) * ((screen.width + 1) / 2) +
              s.window.left,
          static_cast<std::size_t>(s.window.width), false, mask.row(y));
  };
  Mask strong = above(least);
  leave_unlike(strong);
  join(above(std::max(least, kUnlike * screen.subject_contrast)), strong);
  Mask near = dilate(strong, 3);
  leave_unlike(near);
  join(dilate(strong, 1), near);
  // What is lighter than a plain screen is no shadow of anything.
  for (int y = 0; y < s.window.height && screen.kind == KeyKind::Color; ++y) {
    const Span span = s.spans[static_cast<std::size_t>(y)];
    for (int x = span.begin; x < span.end; ++x) {
      const auto i = static_cast<std::size_t>(y * s.window.width + x);
      const float away = s.frame[0][i] + s.frame[1][i] + s.frame[2][i] - s.plate[0][i] -
                         s.plate[1][i] - s.plate[2][i];
      if (away > 0) near.in[i] = 1;
    }
  }
  lanes().spread_into(near.in.data(), near.in.size(), false, s.mask.in.data());
}

}  // namespace

bool find_box(const Mask& mask, Window& box) {
  int left = mask.width;
  int right = 0;
  int top = mask.height;
  int bottom = 0;
  for (int y = 0; y < mask.height; ++y) {
    const std::uint8_t* row = mask.row(y);
    const std::uint8_t* end = row + mask.width;
    const std::uint8_t* first = std::find(row, end, 1);
    if (first == end) continue;
    const std::uint8_t* last = end;
    while (!last[-1]) --last;
    left = std::min(left, static_cast<int>(first - row));
    right = std::max(right, static_cast<int>(last - row));
    top = std::min(top, y);
    bottom = y + 1;
  }
  box = {left, top, right - left, bottom - top};
  return right > left;
}

void find_silhouette(const ScreenModel& screen, const Frame& frame, Silhouette& s) {
  s.empty = true;
  s.drift = fit_drift(screen, frame, screen.threshold);
  find_window(screen, frame, s);
  s.mask = Mask(s.window.width, s.window.height);
  if (s.window.cells() == 0) return;
  look_closely(screen, frame, s);
  const std::size_t n = s.window.cells();
  blur3(s.rough, s.window.width, s.window.height, s.contrast);
  lanes().above(s.contrast.data(), screen.threshold, n, s.mask.in.data());
  if (screen.key < 0) drop_faint(screen, s);
  s.mask = reshape(s.mask, {-1, 1, 2, -2});
  if (!screen.subject_cost.empty()) cut_out(screen, s);
  if (!find_box(s.mask, s.box)) return;
  s.box.left += s.window.left;
  s.box.top += s.window.top;
  s.empty = false;
}

}  // namespace vsprite::detail
