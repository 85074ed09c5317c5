// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The way of the background is found by least squares on the gradient (Lucas and Kanade), coarse to
// fine, with the subject's box left out; exposure and white balance from what is bare in both
// pictures; the rest from the matte.
#include "film/checkup.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vsprite {
namespace {

constexpr int kSmallWidth = 240;          // px, width of the pictures that are compared
constexpr double kTexture = 4;            // mean square gradient, the weaker direction, that tells
constexpr double kRepeatRatio = 0.25;     // of the run's median difference: a repeated frame
constexpr double kMovingSize = 0.25;      // of the subject's size, a second: it moves
constexpr double kLeastBare = 0.05;       // of the picture that two frames must share
constexpr int kNearBlack = 8, kFlat = 3;  // code values: of a bar above black, and within it
constexpr int kLit = 12;                  // code values off a bar: of the picture beside it
constexpr int kRinging = 6;               // px beside the step that a codec makes neither
constexpr double kAlongSide = 0.9;        // share of the side along which the picture begins
constexpr double kLikeSize = 0.4;         // a second part this large makes several

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto k = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

std::size_t at(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(x);
}

// A picture and its weights at one level of the pyramid.
struct Level {
  int width, height;
  std::vector<float> y;
  std::vector<std::uint8_t> bare;
};

Level halve(const Level& fine) {
  Level coarse{fine.width / 2, fine.height / 2, {}, {}};
  for (int v = 0; v < coarse.height; ++v)
    for (int u = 0; u < coarse.width; ++u) {
      float sum = 0;
      std::uint8_t bare = 1;
      for (int k = 0; k < 4; ++k) {
        const std::size_t i = at(2 * u + k % 2, 2 * v + k / 2, fine.width);
        sum += fine.y[i];
        bare = static_cast<std::uint8_t>(bare & fine.bare[i]);
      }
      coarse.y.push_back(sum / 4);
      coarse.bare.push_back(bare);
    }
  return coarse;
}

struct Shift {
  double x = 0, y = 0;
  bool textured = false;
};

// One Gauss-Newton step for b(p + d) + c = a(p); false where the pictures do not determine d.
bool refine(const Level& a, const Level& b, Shift& d) {
  double xx = 0, xy = 0, yy = 0, xr = 0, yr = 0, sx = 0, sy = 0, sr = 0;
  int n = 0;
  for (int v = 1; v + 1 < a.height; ++v)
    for (int u = 1; u + 1 < a.width; ++u) {
      const double px = u + d.x, py = v + d.y;
      const int iu = static_cast<int>(std::floor(px)), iv = static_cast<int>(std::floor(py));
      if (iu < 0 || iv < 0 || iu + 1 >= b.width || iv + 1 >= b.height) continue;
      const std::size_t i = at(u, v, a.width), j = at(iu, iv, b.width);
      const auto w = static_cast<std::size_t>(b.width);
      if (!(a.bare[i] & b.bare[j] & b.bare[j + 1] & b.bare[j + w] & b.bare[j + w + 1])) continue;
      const double fx = px - iu, fy = py - iv;
      const double value = (1 - fy) * ((1 - fx) * double{b.y[j]} + fx * double{b.y[j + 1]}) +
                           fy * ((1 - fx) * double{b.y[j + w]} + fx * double{b.y[j + w + 1]});
      const double gx = 0.5 * (double{a.y[i + 1]} - double{a.y[i - 1]});
      const double gy = 0.5 * (double{a.y[i + static_cast<std::size_t>(a.width)]} -
                               double{a.y[i - static_cast<std::size_t>(a.width)]});
      const double r = std::clamp(double{a.y[i]} - value, -40.0, 40.0);
      xx += gx * gx, xy += gx * gy, yy += gy * gy, xr += gx * r, yr += gy * r;
      sx += gx, sy += gy, sr += r;
      ++n;
    }
  if (n < 100) return false;
  // A change of exposure is no motion: the means go.
  xx -= sx * sx / n, xy -= sx * sy / n, yy -= sy * sy / n, xr -= sx * sr / n, yr -= sy * sr / n;
  const double half = 0.5 * (xx + yy);
  const double least = half - std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  d.textured = least / n > kTexture;
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-6)) return false;
  const double dx = (yy * xr - xy * yr) / determinant;
  const double dy = (xx * yr - xy * xr) / determinant;
  d.x += std::clamp(dx, -2.0, 2.0);
  d.y += std::clamp(dy, -2.0, 2.0);
  return true;
}

// The way of the background from `a` to `b`, px of level 0; nothing where too little is bare.
std::optional<Shift> find_shift(Level a, Level b) {
  std::vector<Level> as{std::move(a)}, bs{std::move(b)};
  while (as.back().width >= 60 && as.back().height >= 60 && as.size() < 4) {
    as.push_back(halve(as.back()));
    bs.push_back(halve(bs.back()));
  }
  Shift shift;
  for (std::size_t level = as.size(); level-- > 0;) {
    shift.x *= 2, shift.y *= 2;
    for (int round = 0; round < 5; ++round)
      if (!refine(as[level], bs[level], shift)) {
        if (level == 0) return std::nullopt;
        shift = {};
        break;
      }
  }
  return shift;
}

// Soft pixels for each pixel of outline.
double edge_width(const KeyedFrame& keyed, const Blob& blob) {
  int soft = 0, outline = 0;
  const Rect& crop = keyed.crop;
  const auto alpha = [&](int x, int y) {
    if (x < 0 || y < 0 || x >= crop.width || y >= crop.height) return 0;
    return static_cast<int>(keyed.straight.rgba[4 * at(x, y, crop.width) + 3]);
  };
  for (int y = blob.box.y - crop.y; y < blob.box.y + blob.box.height - crop.y; ++y)
    for (int x = blob.box.x - crop.x; x < blob.box.x + blob.box.width - crop.x; ++x) {
      if (keyed.labels[at(x, y, crop.width)] != blob.label) continue;
      const int a = alpha(x, y);
      soft += a > 25 && a < 230;
      outline += a >= 128 && (alpha(x - 1, y) < 128 || alpha(x + 1, y) < 128 ||
                              alpha(x, y - 1) < 128 || alpha(x, y + 1) < 128);
    }
  return outline > 0 ? static_cast<double>(soft) / outline : 0;
}

// Mean |Y - Y'| of two frames inside a box.
double difference(const Frame& a, const Frame& b, const Rect& box) {
  double sum = 0;
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x)
      sum += std::abs(a.y[at(x, y, a.width)] - b.y[at(x, y, b.width)]);
  return sum / std::max(box.width * box.height, 1);
}

// ---- bars ----

/// A side of a film: its lines, counted inwards, are rows or columns.
struct Side {
  bool rows, far;
  int begin, end;  // of each line
};

// Of pixel `k` of a line: by how many code values it is off the grey of brightness `black`.
int off_black(const Frame& frame, const Side& side, int line, int k, int black) {
  if (side.far) line = (side.rows ? frame.height : frame.width) - 1 - line;
  const int x = side.rows ? k : line, y = side.rows ? line : k;
  const std::size_t cell = at(x / 2, y / 2, frame.cell_width());
  return std::max({std::abs(frame.y[at(x, y, frame.width)] - black), std::abs(frame.cb[cell] - 128),
                   std::abs(frame.cr[cell] - 128)});
}

int black_lines(std::span<const Frame> frames, const Side& side, int black) {
  const int most = (side.rows ? frames[0].height : frames[0].width) / 2;
  int line = 0;
  const auto is_black = [&](const Frame& frame) {
    for (int k = side.begin; k < side.end; ++k)
      if (off_black(frame, side, line, k, black) > kFlat) return false;
    return true;
  };
  while (line < most && std::all_of(frames.begin(), frames.end(), is_black)) ++line;
  return line;
}

bool picture_begins(std::span<const Frame> frames, const Side& side, int line, int black) {
  std::vector<double> shares;
  for (const Frame& frame : frames) {
    int lit = 0;
    for (int k = side.begin; k < side.end; ++k)
      lit += off_black(frame, side, line, k, black) > kLit;
    shares.push_back(static_cast<double>(lit) / (side.end - side.begin));
  }
  return median(std::move(shares)) >= kAlongSide;
}

}  // namespace

std::string Bars::text() const {
  std::string sides;
  const auto add = [&sides](const char* side, int width) {
    if (width > 0)
      sides += std::string(sides.empty() ? "" : ", ") + side + " " + std::to_string(width) + " px";
  };
  add("top", top), add("bottom", bottom), add("left", left), add("right", right);
  return "black bars (" + sides + ")";
}

std::string Bars::crop(int width, int height) const {
  const auto within = [](int bar) { return bar > 0 ? (bar + 3) / 2 * 2 : 0; };
  const auto rest = [&within](int length, int near, int far) {
    return std::to_string((length - within(near) - within(far)) / 2 * 2);
  };
  return "crop=" + rest(width, left, right) + ":" + rest(height, top, bottom) + ":" +
         std::to_string(within(left)) + ":" + std::to_string(within(top));
}

Bars find_bars(std::span<const Frame> frames) {
  if (frames.empty()) return {};
  const Frame& first = frames[0];
  const int black = first.y[0], w = first.width, h = first.height;
  if (black > (first.coding.full_range ? 0 : 16) + kNearBlack) return {};
  Bars bars;
  bars.top = black_lines(frames, {true, false, 0, w}, black);
  bars.bottom = black_lines(frames, {true, true, 0, w}, black);
  const int begin = bars.top, end = h - bars.bottom;
  if (begin >= end) return {};
  bars.left = black_lines(frames, {false, false, begin, end}, black);
  bars.right = black_lines(frames, {false, true, begin, end}, black);
  const int from = bars.left, to = w - bars.right;
  if (from >= to) return {};
  const auto check = [&](int& bar, const Side& side) {
    const int most = std::min(bar + kRinging, side.rows ? h : w);
    if (bar < 2) bar = most;
    while (bar < most && !picture_begins(frames, side, bar, black)) ++bar;
    if (bar == most) bar = 0;
  };
  check(bars.top, {true, false, from, to});
  check(bars.bottom, {true, true, from, to});
  check(bars.left, {false, false, begin, end});
  check(bars.right, {false, true, begin, end});
  return bars;
}

double hole_share(const KeyedFrame& keyed, const Blob& blob) {
  const int w = blob.box.width + 2, h = blob.box.height + 2;
  std::vector<std::uint8_t> state(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  int solid = 0;
  for (int v = 1; v + 1 < h; ++v)
    for (int u = 1; u + 1 < w; ++u) {
      const std::size_t i = at(blob.box.x + u - 1 - keyed.crop.x, blob.box.y + v - 1 - keyed.crop.y,
                               keyed.crop.width);
      if (keyed.labels[i] != blob.label || keyed.straight.rgba[4 * i + 3] < 128) continue;
      state[at(u, v, w)] = 1;
      ++solid;
    }
  std::vector<std::pair<int, int>> open{{0, 0}};
  state[0] = 2;
  int reached = 1;
  while (!open.empty()) {
    const auto [u, v] = open.back();
    open.pop_back();
    const std::pair<int, int> next[] = {{u + 1, v}, {u - 1, v}, {u, v + 1}, {u, v - 1}};
    for (const auto& [x, y] : next) {
      if (x < 0 || y < 0 || x >= w || y >= h || state[at(x, y, w)] != 0) continue;
      state[at(x, y, w)] = 2;
      ++reached;
      open.emplace_back(x, y);
    }
  }
  const int holes = w * h - reached - solid;
  return solid + holes > 0 ? static_cast<double>(holes) / (solid + holes) : 0;
}

CheckupMeter::Small CheckupMeter::shrink(const Frame& frame, const KeyedFrame& keyed) {
  Small small;
  small.factor = std::max(frame.width / kSmallWidth, 1);
  small.width = frame.width / small.factor;
  small.height = frame.height / small.factor;
  const int f = small.factor;
  for (int v = 0; v < small.height; ++v)
    for (int u = 0; u < small.width; ++u) {
      int sum = 0;
      for (int y = v * f; y < (v + 1) * f; ++y)
        for (int x = u * f; x < (u + 1) * f; ++x) sum += frame.y[at(x, y, frame.width)];
      small.y.push_back(static_cast<float>(sum) / static_cast<float>(f * f));
      bool bare = true;
      for (const Blob& blob : keyed.blobs) {
        const int reach = 4 + blob.box.width / 8;
        bare = bare && (u * f < blob.box.x - reach || v * f < blob.box.y - reach ||
                        u * f > blob.box.x + blob.box.width + reach ||
                        v * f > blob.box.y + blob.box.height + reach);
      }
      small.bare.push_back(bare ? 1 : 0);
      const std::size_t cell = at(u * f / 2, v * f / 2, frame.cell_width());
      small.cb.push_back(frame.cb[cell]);
      small.cr.push_back(frame.cr[cell]);
    }
  return small;
}

CheckupMeter::Light CheckupMeter::compare_light(const Small& from, const Small& to) {
  std::vector<double> exposure, cb, cr;
  for (std::size_t i = 0; i < from.y.size(); ++i) {
    if (!(from.bare[i] & to.bare[i])) continue;
    exposure.push_back((double{to.y[i]} - double{from.y[i]}) / std::max(double{from.y[i]}, 8.0));
    cb.push_back(to.cb[i] - from.cb[i]);
    cr.push_back(to.cr[i] - from.cr[i]);
  }
  if (static_cast<double>(exposure.size()) < kLeastBare * static_cast<double>(from.y.size()))
    return {};
  // Colour is whole code values: means of what is left when the strangers at both ends are cut off.
  const auto middle = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    double sum = 0;
    const std::size_t begin = values.size() / 5, end = values.size() - begin;
    for (std::size_t i = begin; i < end; ++i) sum += values[i];
    return sum / static_cast<double>(end - begin);
  };
  return {middle(exposure), middle(cb), middle(cr)};
}

void CheckupMeter::add_subject(const Burst& burst) {
  const std::size_t begin = seen_.size();
  for (const KeyedFrame& keyed : burst.keyed) {
    Seen seen;
    if (!keyed.blobs.empty()) {
      const Blob& blob = keyed.blobs[0];
      seen.present = true;
      seen.whole = !blob.touches_border;
      seen.several = keyed.blobs.size() > 1 && keyed.blobs[1].area > kLikeSize * blob.area;
      seen.side = std::max(blob.box.width, blob.box.height);
      seen.area = blob.area;
      if (seen.whole) {
        seen.edge = edge_width(keyed, blob);
        seen.lost = hole_share(keyed, blob);
      }
    }
    seen_.push_back(seen);
  }
  // Velocity over five frames, so that a repeated one does not look like rest.
  for (std::size_t f = 0; f < burst.keyed.size(); ++f) {
    const std::size_t first = f >= 2 ? f - 2 : 0, last = std::min(f + 2, burst.keyed.size() - 1);
    if (last == first || !seen_[begin + first].whole || !seen_[begin + last].whole) continue;
    const Blob &a = burst.keyed[first].blobs[0], &b = burst.keyed[last].blobs[0];
    const double rate = fps_ / static_cast<double>(last - first);
    const double vx = (b.anchor_x - a.anchor_x) * rate, vy = (b.anchor_y - a.anchor_y) * rate;
    seen_[begin + f].speed = std::hypot(vx, vy);
    seen_[begin + f].heading = {static_cast<float>(vx), static_cast<float>(vy)};
  }
  std::vector<double> differences;
  for (std::size_t f = 1; f < burst.frames.size(); ++f)
    if (seen_[begin + f].present)
      differences.push_back(
          difference(burst.frames[f], burst.frames[f - 1], burst.keyed[f].blobs[0].box));
  if (differences.size() + 1 < burst.frames.size() || differences.size() < 4) return;
  const double usual = median(differences);
  const double way = seen_[begin + burst.frames.size() / 2].speed / fps_;
  if (way < 0.5) return;  // while it rests nothing is repeated
  moving_ += static_cast<int>(differences.size());
  for (const double d : differences) repeated_ += d < kRepeatRatio * usual;
}

void CheckupMeter::add_background(const Burst& burst) {
  std::optional<Small> before;
  for (std::size_t f = 0; f < burst.frames.size(); ++f) {
    Small small = shrink(burst.frames[f], burst.keyed[f]);
    if (before) {
      const auto level = [](const Small& s) { return Level{s.width, s.height, s.y, s.bare}; };
      if (const auto shift = find_shift(level(*before), level(small))) {
        ++looked_;
        textured_ += shift->textured;
        if (shift->textured) shakes_.push_back(std::hypot(shift->x, shift->y) * small.factor);
      }
      steps_.push_back(std::abs(compare_light(*before, small).exposure));
    }
    if (f == 0) {
      std::vector<double> bare;
      for (std::size_t i = 0; i < small.y.size(); ++i)
        if (small.bare[i]) bare.push_back(double{small.y[i]});
      if (!bare.empty())
        uneven_.push_back((quantile(bare, 0.9) - quantile(bare, 0.1)) /
                          std::max(median(bare), 1.0));
      firsts_.push_back(small);
    }
    before = std::move(small);
  }
}

void CheckupMeter::add(const Burst& burst) {
  if (burst.frames.empty()) return;
  add_subject(burst);
  add_background(burst);
  std::vector<double> gaps;
  for (std::size_t f = 1; f < burst.frames.size(); ++f)
    if (burst.frames[f].time != Frame::kNoTime && burst.frames[f - 1].time != Frame::kNoTime)
      gaps.push_back(static_cast<double>(burst.frames[f].time - burst.frames[f - 1].time) * tick_ *
                     fps_);
  gaps_ += static_cast<int>(gaps.size());
  for (const double gap : gaps) irregular_ += std::abs(gap - 1) > 0.25;
}

Checkup CheckupMeter::finish() const {
  Checkup c;
  c.frames = static_cast<int>(seen_.size());
  if (seen_.empty()) return c;
  // Against the run in the middle of the film.
  c.plain = 2 * textured_ < looked_ || looked_ == 0;
  c.camera_shake = median(shakes_);
  c.exposure_step = quantile(steps_, 0.98);
  c.unevenness = median(uneven_);
  const Small& middle = firsts_[firsts_.size() / 2];
  for (const Small& first : firsts_) {
    const Light light = compare_light(middle, first);
    c.exposure_shift = std::max(c.exposure_shift, std::abs(light.exposure));
    c.white_shift = std::max({c.white_shift, std::abs(light.cb), std::abs(light.cr)});
    if (c.plain) continue;
    const auto level = [](const Small& s) { return Level{s.width, s.height, s.y, s.bare}; };
    const auto shift = find_shift(level(middle), level(first));
    if (shift && shift->textured)
      c.camera_shift = std::max(c.camera_shift, std::hypot(shift->x, shift->y) * first.factor);
  }
  c.repeated = moving_ > 0 ? static_cast<double>(repeated_) / moving_ : 0;
  c.irregular = gaps_ > 0 ? static_cast<double>(irregular_) / gaps_ : 0;

  std::vector<double> sides, areas, lost, speeds, moving;
  for (const Seen& s : seen_) {
    c.present += s.present, c.whole += s.whole, c.several += s.several;
    if (s.whole) sides.push_back(s.side), areas.push_back(s.area), lost.push_back(s.lost);
    if (s.speed >= 0) speeds.push_back(s.speed);
  }
  const auto count = static_cast<double>(seen_.size());
  c.present /= count, c.whole /= count, c.several /= count;
  c.body = median(sides);
  c.lost = median(lost);
  if (speeds.empty()) return c;
  const double least =
      std::max(kMovingSize * quantile(speeds, 0.95), kMovingSize * std::sqrt(median(areas)));
  const double slow = quantile(speeds, 1.0 / 3), fast = quantile(speeds, 2.0 / 3);
  std::vector<double> slow_edges, fast_edges;
  for (const Seen& s : seen_) {
    if (s.speed < 0) continue;
    (s.speed <= slow ? slow_edges : fast_edges).push_back(s.edge);
    if (s.speed > slow && s.speed < fast) fast_edges.pop_back();
    if (s.speed <= least) {
      c.still += 1;
      continue;
    }
    moving.push_back(s.speed);
    c.headings[static_cast<std::size_t>(nearest_direction(s.heading))] += 1;
  }
  c.edge_slow = median(slow_edges);
  c.edge_fast = median(fast_edges);
  c.speed_usual = median(moving);
  c.speed_fast = quantile(moving, 0.95);
  c.still /= static_cast<double>(speeds.size());
  for (double& heading : c.headings) heading /= static_cast<double>(speeds.size());
  return c;
}

}  // namespace vsprite
