// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/cut.h"

#include <algorithm>
#include <cmath>

namespace vsprite::detail {
namespace {

constexpr float kUnit = 64;  // of a capacity: a 64th of a nat

// -ln x / 64ths by the exponent and a line between: off by 0.06 at most, the same everywhere.
int cost_of(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // 0.5..1
  return static_cast<int>(static_cast<double>(kUnit) * 0.6931 * (2 - 2 * mantissa - exponent));
}

}  // namespace

void SubjectColors::add(int red, int green, int blue) {
  ++counts_[color_step(red, green, blue)];
  ++all_;
}

std::vector<std::int16_t> SubjectColors::costs() const {
  constexpr std::uint64_t kFewest = 400;
  if (all_ < kFewest) return {};
  // Smoothed by 1 2 1 along each channel: 64 times the counts.
  std::vector<double> smooth(counts_.begin(), counts_.end());
  for (const std::size_t step : {std::size_t{1}, std::size_t{16}, std::size_t{256}}) {
    const std::vector<double> in = smooth;
    for (std::size_t i = 0; i < in.size(); ++i) {
      const std::size_t place = i / step % 16;
      smooth[i] = 2 * in[i] + in[place > 0 ? i - step : i] + in[place < 15 ? i + step : i];
    }
  }
  // A fifth is for colours that were not seen. The plate's own density at its peak, of a Gaussian
  // of three code values a channel, is cost 0.
  constexpr double kPeak = 0.0635 / 27;
  std::vector<std::int16_t> costs;
  for (const double count : smooth) {
    const double share = 0.8 * count / (64.0 * static_cast<double>(all_)) + 0.2 / 4096;
    costs.push_back(static_cast<std::int16_t>(std::max(cost_of(share / 4096 / kPeak), 0)));
  }
  return costs;
}

GridCut::GridCut(int width, int height) : stride_(width + 2) {
  const std::ptrdiff_t s = stride_;
  const std::ptrdiff_t steps[8] = {1, s - 1, s, s + 1, -1, 1 - s, -s, -s - 1};
  std::copy(steps, steps + 8, step_);
  const std::size_t n = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2);
  residual_.assign(8 * n, 0);
  terminal_.assign(n, 0);
  tree_.assign(n, kFree);
  active_.assign(n, 0);
  parent_.assign(n, kNone);
  stamp_.assign(n, 0);
  depth_.assign(n, 0);
}

void GridCut::add_terminal(int x, int y, int capacity) { terminal_[at(x, y)] += capacity; }

void GridCut::set_edge(int x, int y, int way, int capacity) {
  const std::size_t node = at(x, y);
  residual(node, way) = capacity;
  residual(beside(node, way), opposite(way)) = capacity;
}

void GridCut::activate(std::size_t node) {
  if (active_[node]) return;
  active_[node] = 1;
  queue_.push_back(node);
}

// True where the trees meet: over the edge `way` from `from`, which is the source's.
bool GridCut::grow(std::size_t node, std::size_t& from, int& way) {
  for (int w = 0; w < 8; ++w) {
    if (onwards(node, w) <= 0) continue;
    const std::size_t other = beside(node, w);
    if (tree_[other] == kFree) {
      tree_[other] = tree_[node];
      parent_[other] = static_cast<std::int8_t>(opposite(w));
      stamp_[other] = stamp_[node];
      depth_[other] = depth_[node] + 1;
      activate(other);
    } else if (tree_[other] != tree_[node]) {
      const bool forwards = tree_[node] == kSource;
      from = forwards ? node : other;
      way = forwards ? w : opposite(w);
      return true;
    } else if (stamp_[other] <= stamp_[node] && depth_[other] > depth_[node] + 1) {
      parent_[other] = static_cast<std::int8_t>(opposite(w));
      stamp_[other] = stamp_[node];
      depth_[other] = depth_[node] + 1;
    }
  }
  return false;
}

void GridCut::augment(std::size_t from, int way) {
  const std::size_t to = beside(from, way);
  int flow = residual(from, way);
  std::size_t node = from;
  for (; parent_[node] != kTerminal; node = beside(node, parent_[node]))
    flow = std::min(flow, residual(beside(node, parent_[node]), opposite(parent_[node])));
  flow = std::min(flow, terminal_[node]);
  for (node = to; parent_[node] != kTerminal; node = beside(node, parent_[node]))
    flow = std::min(flow, residual(node, parent_[node]));
  flow = std::min(flow, -terminal_[node]);

  const auto push = [&](std::size_t a, int w) {
    residual(a, w) -= flow;
    residual(beside(a, w), opposite(w)) += flow;
    return residual(a, w) == 0;
  };
  const auto cut_off = [&](std::size_t orphan) {
    parent_[orphan] = kNone;
    orphans_.push_back(orphan);
  };
  push(from, way);
  for (node = from; parent_[node] != kTerminal;) {
    const std::size_t above = beside(node, parent_[node]);
    if (push(above, opposite(parent_[node]))) cut_off(node);
    node = above;
  }
  if ((terminal_[node] -= flow) == 0) cut_off(node);
  for (node = to; parent_[node] != kTerminal;) {
    const std::size_t above = beside(node, parent_[node]);
    if (push(node, parent_[node])) cut_off(node);
    node = above;
  }
  if ((terminal_[node] += flow) == 0) cut_off(node);
}

// Steps to the terminal; -1 where the way ends at an orphan. Marks the way, so that it is not gone
// twice in one adoption.
int GridCut::origin(std::size_t node) {
  int steps = 0;
  std::size_t n = node;
  for (;; ++steps, n = beside(n, parent_[n])) {
    if (stamp_[n] == now_) {
      steps += static_cast<int>(depth_[n]);
      break;
    }
    if (parent_[n] == kTerminal) {
      stamp_[n] = now_;
      depth_[n] = 0;
      break;
    }
    if (parent_[n] == kNone) return -1;
  }
  int left = steps;
  for (n = node; stamp_[n] != now_; n = beside(n, parent_[n])) {
    stamp_[n] = now_;
    depth_[n] = static_cast<std::uint32_t>(left--);
  }
  return steps;
}

void GridCut::adopt() {
  while (!orphans_.empty()) {
    const std::size_t orphan = orphans_.back();
    orphans_.pop_back();
    int best = -1;
    int least = 1 << 30;
    for (int w = 0; w < 8; ++w) {
      const std::size_t other = beside(orphan, w);
      if (tree_[other] != tree_[orphan] || parent_[other] == kNone) continue;
      if (onwards(other, opposite(w)) <= 0) continue;
      const int steps = origin(other);
      if (steps >= 0 && steps < least) least = steps, best = w;
    }
    if (best >= 0) {
      parent_[orphan] = static_cast<std::int8_t>(best);
      stamp_[orphan] = now_;
      depth_[orphan] = static_cast<std::uint32_t>(least + 1);
      continue;
    }
    for (int w = 0; w < 8; ++w) {
      const std::size_t other = beside(orphan, w);
      if (tree_[other] != tree_[orphan]) continue;
      if (onwards(other, opposite(w)) > 0) activate(other);
      if (parent_[other] == opposite(w)) {
        parent_[other] = kNone;
        orphans_.push_back(other);
      }
    }
    tree_[orphan] = kFree;
  }
}

void GridCut::solve() {
  for (std::size_t n = 0; n < terminal_.size(); ++n) {
    if (terminal_[n] == 0) continue;
    tree_[n] = terminal_[n] > 0 ? kSource : kSink;
    parent_[n] = kTerminal;
    activate(n);
  }
  while (head_ < queue_.size()) {
    const std::size_t node = queue_[head_];
    std::size_t from = 0;
    int way = 0;
    if (tree_[node] != kFree && grow(node, from, way)) {
      ++now_;
      augment(from, way);
      adopt();
      continue;  // the node may find more
    }
    active_[node] = 0;
    ++head_;
  }
}

namespace {

constexpr float kSmooth = 5;  // nats, cost of an edge through even colour
constexpr float kLeastSmooth = 0.3f;
constexpr float kEdge = 10;       // code values that make an edge of the picture
constexpr float kPlateEdge = 5;   // and one of the plate
constexpr float kOutlier = 15;    // nats, of what the plate does not explain
constexpr float kUnknown = 10;    // nats, where the plate was never seen
constexpr float kMoved = 2;       // nats, for what is the plate a cell away
constexpr float kShaded = 2;      // nats, for what is the plate in shade
constexpr float kDarkest = 0.5f;  // share of the light that a shadow leaves
constexpr int kMixed = 9 * 64;    // at most, of the colours of what is mixed all through
constexpr int kSure = 1 << 20;    // a capacity above all others together

struct Cells {
  const ScreenModel& screen;
  const Silhouette& s;

  int width() const { return (screen.width + 1) / 2; }
  int height() const { return (screen.height + 1) / 2; }
  std::size_t window(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(s.window.width) +
           static_cast<std::size_t>(x);
  }
  std::size_t film(int x, int y) const {
    return static_cast<std::size_t>(s.window.top + y) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(s.window.left + x);
  }
  float shift(int p, int x, int y) const {
    return static_cast<float>(
        s.drift.at(p, scaled(s.window.left + x, width()), scaled(s.window.top + y, height())));
  }
};

// How far the cell is from the plate at (u, v), squared, in units of the noise.
float away(const Cells& c, std::size_t i, const float (&shift)[3], std::size_t plate, float noise) {
  float d[3];
  for (int p = 0; p < 3; ++p)
    d[p] = 0.25f * static_cast<float>(c.s.grid.plane[p][i]) - c.screen.cells[p][plate] - shift[p];
  return distance_squared(d[0], d[1], d[2]) / (2 * noise * noise);
}

// -ln of how likely the plate is to look like the cell.
float plate_cost(const Cells& c, int x, int y, float noise, bool thin) {
  const std::size_t i = c.window(x, y);
  const float shift[3] = {c.shift(0, x, y), c.shift(1, x, y), c.shift(2, x, y)};
  float least = std::min(away(c, i, shift, c.film(x, y), noise), kOutlier);
  if (least <= kMoved) return least;
  const int gx = c.s.window.left + x;
  const int gy = c.s.window.top + y;
  for (int v = std::max(gy - 1, 0); v <= std::min(gy + 1, c.height() - 1); ++v)
    for (int u = std::max(gx - 1, 0); u <= std::min(gx + 1, c.width() - 1); ++u)
      least = std::min(
          least, kMoved + away(c, i, shift,
                               static_cast<std::size_t>(v) * static_cast<std::size_t>(c.width()) +
                                   static_cast<std::size_t>(u),
                               noise));
  if (thin) return least;
  // C = s B in linear light: what is left of C, against the plate's own light.
  float cb = 0, bb = 0;
  for (int p = 0; p < 3; ++p) {
    cb += c.s.frame[p][i] * c.s.plate[p][i];
    bb += c.s.plate[p][i] * c.s.plate[p][i];
  }
  const float share = bb > 0 ? cb / bb : 0;
  if (share > kDarkest && share < 1) {
    float rest = 0;
    for (int p = 0; p < 3; ++p) {
      const float r = c.s.frame[p][i] - share * c.s.plate[p][i];
      rest += r * r;
    }
    least = std::min(least, kShaded + 4 * (1 - share) + 200 * rest / bb);
  }
  return least;
}

// In 64ths of a nat: above 0 the cell is rather subject.
int odds_of(const Cells& c, int x, int y, float noise, bool thin) {
  const std::size_t i = c.window(x, y);
  const auto& sums = c.s.grid.plane;
  const std::uint8_t witness = c.screen.witness[c.film(x, y)];
  const float cost = witness == kInvented ? kUnknown : plate_cost(c, x, y, noise, thin);
  const int subject = c.screen.subject_cost[color_step(sums[0][i], sums[1][i], sums[2][i])];
  const int odds = static_cast<int>(kUnit * cost) - (thin ? std::min(subject, kMixed) : subject);
  return witness == kOccupied ? std::max(odds, static_cast<int>(kUnit)) : odds;
}

// What it costs that one of two neighbours is subject and the other is not.
int seam_of(const Cells& c, int x, int y, int u, int v, bool thin) {
  const std::size_t i = c.window(x, y);
  const std::size_t j = c.window(u, v);
  float d[3], b[3];
  for (int p = 0; p < 3; ++p) {
    d[p] = 0.25f * static_cast<float>(c.s.grid.plane[p][i] - c.s.grid.plane[p][j]);
    b[p] = c.screen.cells[p][c.film(x, y)] - c.screen.cells[p][c.film(u, v)];
  }
  const float z = std::max(c.s.rough[i], c.s.rough[j]) / c.screen.threshold;
  const float own = distance_squared(b[0], b[1], b[2]) / (kPlateEdge * kPlateEdge);
  const float edge =
      distance_squared(d[0], d[1], d[2]) / (1 + own / (1 + z * z * z * z)) / (2 * kEdge * kEdge);
  const float length = x != u && y != v ? 0.7071f : 1.0f;
  const float smooth = thin ? 0.0f : kSmooth / ((1 + edge) * (1 + edge));
  return static_cast<int>(kUnit * length * (smooth + kLeastSmooth));
}

// Drops parts of less than a two-hundredth of `whole` cells; 0: of the largest. Returns that whole.
int drop_parts(Mask& mask, int whole) {
  std::vector<int> labels;
  std::vector<int> size(static_cast<std::size_t>(connected_parts(mask, labels)) + 1);
  for (const int label : labels) ++size[static_cast<std::size_t>(label)];
  size[0] = 0;
  if (whole == 0) whole = *std::max_element(size.begin(), size.end());
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (size[static_cast<std::size_t>(labels[i])] < whole / 200) mask.in[i] = 0;
  return whole;
}

// Leaves in the wind, and places where the subject looks just like the plate.
void clean(Mask& mask) {
  const int largest = drop_parts(mask, 0);
  if (largest == 0) return;
  for (std::uint8_t& in : mask.in) in ^= 1;
  drop_parts(mask, largest);
  for (std::uint8_t& in : mask.in) in ^= 1;
}

}  // namespace

void cut_out(const ScreenModel& screen, Silhouette& s) {
  Window box;  // of the mask and what it may grow into, and a cell more
  if (!find_box(s.mask, box)) return;
  const int left = std::max(box.left - kCutReach - 1, 0);
  const int top = std::max(box.top - kCutReach - 1, 0);
  const int right = std::min(box.left + box.width + kCutReach + 1, s.window.width);
  const int bottom = std::min(box.top + box.height + kCutReach + 1, s.window.height);
  const Cells cells{screen, s};
  Mask reach = dilate(s.mask, kCutReach);
  for (int y = top; y < bottom; ++y) {
    const Span span = s.spans[static_cast<std::size_t>(y)];
    for (int x = left; x < right; ++x) {
      if (s.mask.row(y)[x]) continue;
      // Outside the spans nothing is known. Before a plate that is all like the subject nothing
      // tells it from its reflection: what stands out there is all there is.
      const std::size_t cell = cells.film(x, y);
      const bool alike = !screen.unlike[cell] && screen.witness[cell] == kBare;
      if (x < span.begin || x >= span.end || alike) reach.row(y)[x] = 0;
    }
  }
  // Tails, of which no cell has the subject's own colour; shadows are broad.
  Mask thin = reshape(s.mask, {-2, 2});
  for (std::size_t i = 0; i < thin.in.size(); ++i) thin.in[i] = s.mask.in[i] & (thin.in[i] ^ 1);
  const float noise = 1.5f * std::max(screen.whole_noise(), 2.0f);
  GridCut graph(right - left, bottom - top);
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) {
      if (!reach.row(y)[x]) {
        graph.add_terminal(x - left, y - top, -kSure);
        continue;
      }
      graph.add_terminal(x - left, y - top, odds_of(cells, x, y, noise, thin.row(y)[x] != 0));
      for (int way = 0; way < 4; ++way) {
        const int u = way == 0 ? x + 1 : x + way - 2;
        const int v = way == 0 ? y : y + 1;
        if (u >= left && u < right && v < bottom && reach.row(v)[u])
          graph.set_edge(x - left, y - top, way,
                         seam_of(cells, x, y, u, v, thin.row(y)[x] || thin.row(v)[u]));
      }
    }
  graph.solve();
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      s.mask.row(y)[x] = graph.with_source(x - left, y - top) ? 1 : 0;
  clean(s.mask);
}

}  // namespace vsprite::detail
