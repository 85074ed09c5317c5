// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/loops.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "control/response.h"
#include "vsprite/compose.h"

namespace vsprite {
namespace {

constexpr double kHalfSector = 0.39269908169872414;  // 22.5 degrees
constexpr std::uint32_t kNoNode = 0xFFFFFFFFu;

// The cheapest known way to be at a sample at a tick.
struct Node {
  std::uint32_t sample, before;
  double cost;
};

class LoopSearch {
 public:
  LoopSearch(const Sprite& sprite, const std::vector<std::uint8_t>& allowed, LoopLength length)
      : sprite_(sprite), allowed_(allowed), length_(length), n_(allowed.size()) {
    slots_.resize((static_cast<std::size_t>(length.most) + 1) * n_, kNoNode);
    ticks_.resize(static_cast<std::size_t>(length.most) + 1);
  }

  std::optional<SeamlessLoop> run() {
    std::vector<std::uint8_t> is_target(n_, 0);
    for (std::uint32_t i = 0; i < n_; ++i)
      if (allowed_[i] != 0)
        for (const Transition& way : sprite_.transitions(i))
          if (!sprite_.is_natural(i, way.to)) is_target[way.to] = 1;
    for (std::uint32_t s = 0; s < n_; ++s)
      if (allowed_[s] != 0 && is_target[s] != 0) search_from(s);
    return std::move(best_);
  }

 private:
  void search_from(std::uint32_t start) {
    nodes_.assign(1, {start, kNoNode, 0});
    ticks_[0].assign(1, 0);
    for (std::size_t t = 0; t < static_cast<std::size_t>(length_.most); ++t) {
      for (const std::uint32_t k : ticks_[t]) {
        const Node node = nodes_[k];
        const std::size_t then = t + sprite_.samples()[node.sample].duration;
        if (node.cost >= bound_ || then > static_cast<std::size_t>(length_.most)) continue;
        if (node.sample + 1 < n_ && sprite_.is_natural(node.sample, node.sample + 1))
          offer(start, then, {node.sample + 1, k, node.cost});
        for (const Transition& way : sprite_.transitions(node.sample))
          if (!sprite_.is_natural(node.sample, way.to))
            offer(start, then, {way.to, k, node.cost + double{way.cost}});
      }
    }
    for (std::size_t t = 1; t < ticks_.size(); ++t) {
      for (const std::uint32_t k : ticks_[t]) slots_[t * n_ + nodes_[k].sample] = kNoNode;
      ticks_[t].clear();
    }
  }

  void offer(std::uint32_t start, std::size_t tick, const Node& node) {
    if (allowed_[node.sample] == 0 || !(node.cost < bound_)) return;
    if (node.sample == start && tick >= static_cast<std::size_t>(length_.least))
      take(node, static_cast<int>(tick));
    std::uint32_t& slot = slots_[tick * n_ + node.sample];
    if (slot == kNoNode) {
      slot = static_cast<std::uint32_t>(nodes_.size());
      ticks_[tick].push_back(slot);
      nodes_.push_back(node);
    } else if (node.cost < nodes_[slot].cost) {
      nodes_[slot] = node;  // of a later tick than all that were gone on from
    }
  }

  // The way back from a closing step, which leads to the start again.
  void take(const Node& closing, int ticks) {
    SeamlessLoop loop;
    for (std::uint32_t k = closing.before; k != kNoNode; k = nodes_[k].before)
      loop.samples.push_back(nodes_[k].sample);
    std::reverse(loop.samples.begin(), loop.samples.end());
    loop.ticks = ticks;
    loop.cost = bound_ = closing.cost;
    best_ = std::move(loop);
  }

  const Sprite& sprite_;
  const std::vector<std::uint8_t>& allowed_;
  const LoopLength length_;
  const std::size_t n_;
  double bound_ = std::numeric_limits<double>::infinity();
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> slots_;               // (most + 1, N) into nodes_
  std::vector<std::vector<std::uint32_t>> ticks_;  // nodes of each tick
  std::optional<SeamlessLoop> best_;
};

// Counts the jumps, and turns the loop so that the dearest closes it.
void begin_behind_the_seam(const Sprite& sprite, SeamlessLoop& loop) {
  const std::size_t m = loop.samples.size();
  float dearest = -1;
  std::size_t first = 0;
  for (std::size_t k = 0; k < m; ++k) {
    const std::uint32_t from = loop.samples[k], to = loop.samples[(k + 1) % m];
    if (sprite.is_natural(from, to)) continue;
    ++loop.jumps;
    const float cost = sprite.transition_cost(from, to);
    if (cost > dearest) {
      dearest = cost;
      first = (k + 1) % m;
    }
  }
  std::rotate(loop.samples.begin(), loop.samples.begin() + static_cast<std::ptrdiff_t>(first),
              loop.samples.end());
}

// Mean difference of two pictures, anchor on anchor, 0..255.
Result<double> difference(const Sprite& sprite, std::uint32_t a, std::uint32_t b) {
  Image pictures[2];
  const Sample* samples[2] = {&sprite.samples()[a], &sprite.samples()[b]};
  int left = 0, top = 0, right = 1, bottom = 1, x[2], y[2];
  for (int k = 0; k < 2; ++k) {
    if (auto ok = sprite.decode_frame(k == 0 ? a : b, pictures[k]); !ok) return ok.error();
    x[k] = -static_cast<int>(std::lround(samples[k]->anchor.x));
    y[k] = -static_cast<int>(std::lround(samples[k]->anchor.y));
    left = std::min(left, x[k]), right = std::max(right, x[k] + pictures[k].width);
    top = std::min(top, y[k]), bottom = std::max(bottom, y[k] + pictures[k].height);
  }
  const auto value = [&](int k, int px, int py, int channel) {
    const int u = px - x[k], v = py - y[k];
    const bool inside = u >= 0 && v >= 0 && u < pictures[k].width && v < pictures[k].height;
    return inside ? int{ImageView(pictures[k]).pixel(u, v)[channel]} : 0;
  };
  std::uint64_t sum = 0;
  for (int py = top; py < bottom; ++py)
    for (int px = left; px < right; ++px)
      for (int channel = 0; channel < 4; ++channel)
        sum += static_cast<std::uint64_t>(
            std::abs(value(0, px, py, channel) - value(1, px, py, channel)));
  return static_cast<double>(sum) / (4.0 * (right - left) * (bottom - top));
}

}  // namespace

std::optional<SeamlessLoop> find_loop(const Sprite& sprite,
                                      const std::vector<std::uint8_t>& allowed, LoopLength length) {
  auto loop = LoopSearch(sprite, allowed, length).run();
  if (loop) begin_behind_the_seam(sprite, *loop);
  return loop;
}

std::vector<std::uint8_t> samples_towards(const Sprite& sprite, Direction direction) {
  const double least = usual_v0(measure_speeds(sprite.samples())) / 4;
  const Vec2 unit = unit_vector(direction);
  std::vector<std::uint8_t> out;
  for (const Sample& s : sprite.samples()) {
    const double along =
        double{s.velocity.x} * double{unit.x} + double{s.velocity.y} * double{unit.y};
    const double across =
        double{s.velocity.x} * double{unit.y} - double{s.velocity.y} * double{unit.x};
    const bool moves = std::hypot(double{s.velocity.x}, double{s.velocity.y}) >= least;
    const bool fits = direction == Direction::Rest
                          ? !moves
                          : moves && std::abs(std::atan2(across, along)) <= kHalfSector;
    out.push_back(s.kept == 1 && fits ? 1 : 0);
  }
  return out;
}

Result<double> measure_seam(const Sprite& sprite, const SeamlessLoop& loop) {
  std::vector<double> own;
  double worst = 0;
  for (std::size_t k = 0; k < loop.samples.size(); ++k) {
    const std::uint32_t from = loop.samples[k], to = loop.samples[(k + 1) % loop.samples.size()];
    const auto apart = difference(sprite, from, to);
    if (!apart) return apart.error();
    if (sprite.is_natural(from, to))
      own.push_back(*apart);
    else
      worst = std::max(worst, *apart);
  }
  double usual = 0;
  if (!own.empty()) {
    std::nth_element(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(own.size() / 2),
                     own.end());
    usual = own[own.size() / 2];
  }
  return (worst + 0.5) / (usual + 0.5);
}

}  // namespace vsprite
