// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// NIPS section 3.2, exact and without looking at most candidates. A tick is four passes over the
// sequences that move on (parents), in tiles:
//
//   leave    each parent's place, and what it has paid: B. Dearer than the best that arrived: gone
//   guess    successors are sorted by what they add, E. Count B + E <= guess, in buckets by cost
//   cut      the width-th smallest cost, exactly, inside its bucket; how many of its equals stay
//   emit     survivors, in the order of parents and of E
//
// The guess is the previous tick's spread and a little more; if it was too low it is doubled.
#include "control/search.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <memory>
#include <numeric>
#include <span>
#include <string>

#include "similarity/features.h"

namespace vsprite {
namespace {

constexpr std::size_t kTile = 4096;  // parents
constexpr int kBucketBits = 10;
constexpr std::size_t kBuckets = std::size_t{1} << kBucketBits;
constexpr std::size_t kStride = 16;              // of the parents that the guess is made from
constexpr std::uint32_t kEndOfRow = UINT32_MAX;  // dearer than any successor
constexpr std::uint64_t kMostSpread = kEndOfRow - 1;
constexpr std::size_t kRowBudget = std::size_t{1} << 25;   // sorted successors kept
constexpr std::size_t kNodeBudget = std::size_t{1} << 20;  // back-pointers before a clean-up
constexpr std::uint32_t kNoNode = UINT32_MAX;

int bucket_shift(std::uint64_t limit) {
  return std::max(0, static_cast<int>(std::bit_width(limit)) - kBucketBits);
}

// Successors of a sample for one direction of the path, ascending by (E, sample):
// E << 32 | sample, then an end mark.
class SuccessorRows {
 public:
  explicit SuccessorRows(const PathCost& path)
      : path_(&path), rows_(path.direction_count()), angles_(path.direction_count()) {
    const auto count = static_cast<std::uint32_t>(path.sprite().samples().size());
    for (std::uint32_t i = 0; i < count; ++i)
      longest_ = std::max(longest_, path.sprite().transitions(i).size());
  }
  std::size_t longest() const { return longest_; }

  const std::uint64_t* find(std::uint32_t sample, std::uint32_t direction) const {
    return rows_[direction].empty() ? nullptr : rows_[direction][sample];
  }
  // `segment`: one of that direction.
  const std::uint64_t* make(std::uint32_t sample, std::uint32_t direction, std::uint32_t segment) {
    auto& row = rows_[direction];
    auto& angles = angles_[direction];
    if (row.empty()) {
      row.assign(path_->sprite().samples().size(), nullptr);
      angles.resize(row.size());
      for (std::uint32_t i = 0; i < row.size(); ++i) angles[i] = path_->angle_cost(i, segment);
    }
    const auto edges = path_->sprite().transitions(sample);
    std::uint64_t* out = take(edges.size() + 1);
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const std::uint64_t cost =
          std::uint64_t{PathCost::transition_cost(edges[k].cost)} + angles[edges[k].to];
      out[k] = std::min<std::uint64_t>(cost, kEndOfRow - 1) << 32 | edges[k].to;
    }
    std::sort(out, out + edges.size());
    out[edges.size()] = std::uint64_t{kEndOfRow} << 32 | kNoSample;
    return row[sample] = out;
  }
  // Between ticks: forgets all rows where they have grown too many.
  void trim() {
    if (used_ < kRowBudget) return;
    used_ = 0;
    blocks_.clear();
    left_ = 0;
    for (auto& row : rows_) row = {};
    for (auto& angles : angles_) angles = {};
  }

 private:
  std::uint64_t* take(std::size_t count) {
    constexpr std::size_t kBlock = std::size_t{1} << 18;
    if (left_ < count) {
      left_ = std::max(kBlock, count);
      blocks_.push_back(std::make_unique_for_overwrite<std::uint64_t[]>(left_));
      next_ = blocks_.back().get();
    }
    left_ -= count;
    used_ += count;
    return std::exchange(next_, next_ + count);
  }
  const PathCost* path_;
  std::vector<std::vector<const std::uint64_t*>> rows_;  // (direction, sample)
  std::vector<std::vector<std::uint32_t>> angles_;       // (direction, sample) w1 a
  std::vector<std::unique_ptr<std::uint64_t[]>> blocks_;
  std::uint64_t* next_ = nullptr;
  std::size_t left_ = 0, used_ = 0, longest_ = 0;
};

// How every sequence came about: a tree, children after their parents.
class History {
 public:
  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  struct Node {
    std::uint32_t parent, sample;
    Node() {}  // every one is set: nothing to clear
    Node(std::uint32_t from, std::uint32_t shown) : parent(from), sample(shown) {}
  };
  explicit History(std::size_t width) { nodes_.reserve(kNodeBudget + width); }
  // Room for `count` more nodes, all of them to be set; the first.
  Node* grow(std::size_t count) {
    nodes_.resize(nodes_.size() + count);
    return nodes_.data() + nodes_.size() - count;
  }
  bool is_full() const { return nodes_.size() >= budget_; }
  std::vector<std::uint32_t> trace(std::uint32_t node) const {
    std::vector<std::uint32_t> out;
    for (; node != kNoNode; node = nodes_[node].parent) out.push_back(nodes_[node].sample);
    std::reverse(out.begin(), out.end());
    return out;
  }
  // Keeps what leads to a node in `leaves`; returns the new number of every old one.
  std::vector<std::uint32_t> clean(const std::vector<std::uint32_t>& leaves) {
    std::vector<std::uint32_t> renumbered(nodes_.size(), 0);
    for (const std::uint32_t leaf : leaves) renumbered[leaf] = 1;
    for (std::size_t n = nodes_.size(); n-- > 0;)
      if (nodes_[n].parent != kNoNode) renumbered[nodes_[n].parent] |= renumbered[n];
    std::uint32_t next = 0;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      if (!renumbered[n]) continue;
      const std::uint32_t parent = nodes_[n].parent;
      nodes_[next].parent = parent == kNoNode ? kNoNode : renumbered[parent];
      nodes_[next].sample = nodes_[n].sample;
      renumbered[n] = next++;
    }
    nodes_.resize(next);
    budget_ = std::max(kNodeBudget, std::size_t{2} * next);
    return renumbered;
  }

 private:
  std::vector<Node> nodes_;
  std::size_t budget_ = kNodeBudget;
};

struct Sequence {
  PathState state;
  std::uint32_t node = 0;
};

// A sequence that has left its sample.
struct Parent {
  PathState state;  // `cost` without the next sample's
  Cost rank = 0;    // B: the same with the estimate of what is left
  std::uint32_t node = 0;
  std::uint32_t count = 0;  // successors under the guess
  const std::uint64_t* row = nullptr;
};

// One tile's share of a tick.
struct Tile {
  std::vector<Parent> store;  // grows, never shrinks: parents are written in place
  std::span<Parent> parents;
  Cost least = kNoCost;    // of B
  Cost arrived = kNoCost;  // cheapest that arrived
  std::uint32_t arrived_node = kNoNode;
  bool has_new = false;  // of its parents, one has no row yet
  std::uint32_t furthest = 0, furthest_segment = 0;
  std::uint64_t evaluated = 0;
  std::vector<std::uint32_t> room;    // grows, never shrinks
  std::span<std::uint32_t> costs;     // of successors under the guess, less the tick's least B
  std::vector<std::uint32_t> inside;  // those in the bucket of the cut
  bool is_whole = true;               // nothing lies beyond the guess
  std::array<std::uint32_t, kBuckets> buckets{};
  std::size_t below = 0, equal = 0;  // costs under the cut, at the cut
  std::size_t first = 0, ties = 0;   // where its survivors go; how many at the cut stay
};

class Beam {
 public:
  Beam(const PathCost& path, const SearchConfig& config, SearchStats& stats)
      : path_(path),
        config_(config),
        stats_(stats),
        width_(static_cast<std::size_t>(config.width)),
        arena_(config.jobs > 0 ? config.jobs : tbb::task_arena::automatic),
        rows_(path),
        history_(width_),
        pools_(path.longest_duration() + 1) {}

  Result<Clip> run();

 private:
  template <class Work>
  void each_tile(const Work& work);
  void seed();
  bool take_tick();
  void leave(std::size_t index);
  void make_rows();
  void guess(Tile& tile, std::uint32_t limit, int shift) const;
  std::uint64_t expect_spread();
  void choose();
  void find_cut(std::uint64_t total, int shift);
  void emit(const Tile& tile, History::Node* nodes);
  void put_back();
  void clean_history();
  void report();
  Error nobody_arrived() const;

  const PathCost& path_;
  const SearchConfig& config_;
  SearchStats& stats_;
  std::size_t width_;
  tbb::task_arena arena_;
  SuccessorRows rows_;
  History history_;
  std::vector<std::vector<Sequence>> pools_;  // by the tick in which their sample ends, modulo
  std::vector<Sequence> moving_, beam_;
  std::vector<Tile> tiles_;
  Tile sampled_;
  std::size_t tile_count_ = 0;
  std::uint64_t tick_ = 0;
  Cost least_ = 0;                  // smallest B of the tick
  std::uint64_t spread_ = 1 << 18;  // last cut, less the smallest B
  std::uint32_t cut_ = 0;
  std::size_t survivors_ = 0;
  std::uint32_t first_node_ = 0;
  Cost best_ = kNoCost;
  std::uint32_t best_node_ = kNoNode;
  std::uint32_t furthest_ = 0, furthest_segment_ = 0;
  std::uint64_t furthest_tick_ = 0;
};

template <class Work>
void Beam::each_tile(const Work& work) {
  if (tile_count_ == 1 || config_.jobs == 1) {
    for (std::size_t t = 0; t < tile_count_; ++t) work(t);
    return;
  }
  arena_.execute([&] { tbb::parallel_for(std::size_t{0}, tile_count_, work); });
}

void Beam::seed() {
  const auto samples = path_.sprite().samples();
  for (std::uint32_t i = 0; i < samples.size(); ++i)
    if (samples[i].kept) beam_.push_back({path_.seed(i), 0});
  if (beam_.size() > width_) {
    // The cut by (cost, sample), the order by sample.
    std::vector<std::pair<Cost, std::uint32_t>> order;
    for (const Sequence& s : beam_) order.emplace_back(s.state.cost, s.state.sample);
    const auto last = order.begin() + static_cast<std::ptrdiff_t>(width_) - 1;
    std::nth_element(order.begin(), last, order.end());
    std::erase_if(beam_, [limit = *last](const Sequence& s) {
      return std::pair(s.state.cost, s.state.sample) > limit;
    });
  }
  History::Node* nodes = history_.grow(beam_.size());
  for (std::uint32_t n = 0; n < beam_.size(); ++n) {
    beam_[n].node = n;
    nodes[n] = {kNoNode, beam_[n].state.sample};
  }
  put_back();
}

// The sequences whose sample ends with this tick; false if there are none now or later.
bool Beam::take_tick() {
  const auto is_empty = [](const auto& pool) { return pool.empty(); };
  if (std::all_of(pools_.begin(), pools_.end(), is_empty)) return false;
  ++tick_;
  auto& pool = pools_[tick_ % pools_.size()];
  moving_.swap(pool);
  if (beam_.empty()) beam_.swap(pool);  // past sequences: memory that need not be made anew
  pool.clear();
  tile_count_ = (moving_.size() + kTile - 1) / kTile;
  if (tiles_.size() < tile_count_) tiles_.resize(tile_count_);
  return true;
}

void Beam::leave(std::size_t index) {
  Tile& tile = tiles_[index];
  if (tile.store.empty()) tile.store.resize(kTile);
  tile.arrived = kNoCost;
  tile.evaluated = 0;
  const Cost dearest = best_;
  const PathSegment* segments = path_.segments().data();
  Cost least = kNoCost;
  bool has_new = false;
  std::uint32_t furthest = 0, furthest_segment = 0;
  Parent* parent = tile.store.data();
  const auto moving = std::span(moving_).subspan(index * kTile);
  for (const Sequence& s : moving.first(std::min(moving.size(), kTile))) {
    const PathEnd how = path_.leave(s.state, parent->state);
    if (how == PathEnd::Dropped || parent->state.cost >= dearest) continue;
    if (how == PathEnd::Arrived) [[unlikely]] {
      if (parent->state.cost >= tile.arrived) continue;
      tile.arrived = parent->state.cost;
      tile.arrived_node = s.node;
      continue;
    }
    const PathState& at = parent->state;
    parent->node = s.node;
    parent->row = rows_.find(at.sample, segments[at.segment].direction);
    parent->rank = at.cost + path_.estimate(at);
    has_new |= parent->row == nullptr;
    furthest_segment = at.arc > furthest ? at.segment : furthest_segment;
    furthest = std::max(furthest, at.arc);
    least = std::min(least, parent->rank);
    ++parent;
  }
  tile.least = least;
  tile.has_new = has_new;
  tile.furthest = furthest;
  tile.furthest_segment = furthest_segment;
  tile.parents = {tile.store.data(), parent};
}

void Beam::make_rows() {
  for (std::size_t t = 0; t < tile_count_; ++t) {
    if (!tiles_[t].has_new) continue;
    for (Parent& parent : tiles_[t].parents) {
      if (parent.row != nullptr) continue;
      const PathState& s = parent.state;
      const std::uint32_t direction = path_.segments()[s.segment].direction;
      parent.row = rows_.find(s.sample, direction);
      if (parent.row == nullptr) parent.row = rows_.make(s.sample, direction, s.segment);
    }
  }
}

// All successors that cost at most `limit` more than the tick's least B.
void Beam::guess(Tile& tile, std::uint32_t limit, int shift) const {
  constexpr std::size_t kAhead = 12;  // parents whose rows are fetched early
  tile.buckets.fill(0);
  tile.is_whole = true;
  std::size_t count = 0;
  const std::size_t parents = tile.parents.size();
  for (std::size_t k = 0; k < parents; ++k) {
    Parent& parent = tile.parents[k];
    __builtin_prefetch(tile.parents[std::min(k + kAhead, parents - 1)].row);
    if (tile.room.size() < count + rows_.longest())
      tile.room.resize(2 * tile.room.size() + rows_.longest() + kTile);
    const std::uint64_t* row = parent.row;
    std::uint32_t* out = tile.room.data() + count;
    const auto paid = static_cast<std::uint64_t>(parent.rank - least_);
    while (paid + (*row >> 32) <= limit) {
      const auto cost = static_cast<std::uint32_t>(paid + (*row++ >> 32));
      *out++ = cost;
      ++tile.buckets[cost >> shift];
    }
    parent.count = static_cast<std::uint32_t>(row - parent.row);
    count += parent.count;
    tile.is_whole &= *row >> 32 == kEndOfRow;
  }
  tile.costs = {tile.room.data(), count};
  tile.evaluated += count + parents;
}

// How far above the least B the cut will lie, from every kStride-th parent; rather too far.
std::uint64_t Beam::expect_spread() {
  sampled_.store.clear();
  std::size_t k = 0;
  for (std::size_t t = 0; t < tile_count_; ++t) {
    for (; k < tiles_[t].parents.size(); k += kStride)
      sampled_.store.push_back(tiles_[t].parents[k]);
    k -= tiles_[t].parents.size();
  }
  sampled_.parents = sampled_.store;
  const std::size_t due = width_ / kStride + width_ / kStride / 16 + 16;
  for (std::uint64_t limit = spread_ + spread_ / 4;; limit *= 2) {
    limit = std::min(limit, kMostSpread);
    const int shift = bucket_shift(limit);
    guess(sampled_, static_cast<std::uint32_t>(limit), shift);
    if (sampled_.costs.size() < due && !sampled_.is_whole && limit < kMostSpread) continue;
    std::size_t bucket = 0, sum = 0;
    while (bucket + 1 < kBuckets && sum < due) sum += sampled_.buckets[bucket++];
    return std::min(limit, static_cast<std::uint64_t>(bucket) << shift);
  }
}

void Beam::choose() {
  for (std::uint64_t limit = expect_spread();; limit += limit / 2 + 1) {
    limit = std::min(limit, kMostSpread);
    const int shift = bucket_shift(limit);
    each_tile([&](std::size_t t) { guess(tiles_[t], static_cast<std::uint32_t>(limit), shift); });
    std::uint64_t total = 0;
    bool is_whole = true;
    for (std::size_t t = 0; t < tile_count_; ++t) {
      total += tiles_[t].costs.size();
      is_whole &= tiles_[t].is_whole;
    }
    if (total < width_ && !is_whole && limit < kMostSpread) continue;
    find_cut(total, shift);
    return;
  }
}

// The costs of a bucket; few are in it, so sixteen are looked at together.
void find_inside(std::span<const std::uint32_t> costs, int shift, std::uint32_t bucket,
                 std::vector<std::uint32_t>& inside) {
  constexpr std::size_t kRun = 16;
  inside.clear();
  for (std::size_t at = 0; at < costs.size(); at += kRun) {
    const auto run = costs.subspan(at, std::min(kRun, costs.size() - at));
    std::uint32_t any = 0;
    for (const std::uint32_t cost : run) any |= cost >> shift == bucket ? 1u : 0u;
    if (any == 0) continue;
    for (const std::uint32_t cost : run)
      if (cost >> shift == bucket) inside.push_back(cost);
  }
}

// The width-th smallest cost of all; per tile, how many lie below it and where they go.
void Beam::find_cut(std::uint64_t total, int shift) {
  std::size_t equals = SIZE_MAX;  // that may stay
  cut_ = UINT32_MAX;
  if (total > width_) {
    std::array<std::uint64_t, kBuckets> sum{};
    for (std::size_t t = 0; t < tile_count_; ++t)
      for (std::size_t b = 0; b < kBuckets; ++b) sum[b] += tiles_[t].buckets[b];
    std::uint32_t bucket = 0;
    std::uint64_t before = 0;
    while (before + sum[bucket] < width_) before += sum[bucket++];
    each_tile([&](std::size_t t) {
      Tile& tile = tiles_[t];
      find_inside(tile.costs, shift, bucket, tile.inside);
      tile.below =
          std::accumulate(tile.buckets.begin(), tile.buckets.begin() + bucket, std::size_t{0});
    });
    std::vector<std::uint32_t> inside;
    for (std::size_t t = 0; t < tile_count_; ++t)
      inside.insert(inside.end(), tiles_[t].inside.begin(), tiles_[t].inside.end());
    const auto last = inside.begin() + static_cast<std::ptrdiff_t>(width_ - before - 1);
    std::nth_element(inside.begin(), last, inside.end());
    cut_ = *last;
    before += static_cast<std::uint64_t>(
        std::count_if(inside.begin(), inside.end(), [this](auto c) { return c < cut_; }));
    equals = static_cast<std::size_t>(width_ - before);
    spread_ = std::max<std::uint64_t>(cut_, 1);
  }
  survivors_ = 0;
  for (std::size_t t = 0; t < tile_count_; ++t) {
    Tile& tile = tiles_[t];
    if (total > width_) {
      for (const std::uint32_t cost : tile.inside) tile.below += cost < cut_;
      tile.equal =
          static_cast<std::size_t>(std::count(tile.inside.begin(), tile.inside.end(), cut_));
    } else {
      tile.below = tile.costs.size();
      tile.equal = 0;
    }
    tile.ties = std::min(tile.equal, equals);
    equals -= tile.ties;
    tile.first = survivors_;
    survivors_ += tile.below + tile.ties;
  }
}

void Beam::emit(const Tile& tile, History::Node* nodes) {
  const std::uint32_t cut = cut_;
  std::size_t ties = tile.ties;
  const std::uint32_t* cost = tile.costs.data();
  Sequence* child = beam_.data() + tile.first;
  History::Node* node = nodes + tile.first;
  auto number = first_node_ + static_cast<std::uint32_t>(tile.first);
  for (const Parent& parent : tile.parents) {
    const std::uint32_t* const end = cost + parent.count;
    // A row ascends: what follows the first that is too dear is so too.
    for (const std::uint64_t* row = parent.row; cost != end && *cost <= cut; ++cost, ++row) {
      if (*cost == cut) {
        if (ties == 0) break;
        --ties;
      }
      const auto sample = static_cast<std::uint32_t>(*row);
      child->state = parent.state;
      child->state.cost += static_cast<Cost>(*row >> 32);
      child->state.sample = sample;
      child->node = number++;
      *node++ = {parent.node, sample};
      ++child;
    }
    cost = end;
  }
}

void Beam::put_back() {
  if (config_.survivors) {
    std::vector<PathState> states;
    for (const Sequence& s : beam_) states.push_back(s.state);
    config_.survivors(states);
  }
  if (pools_.size() == 2) return beam_.swap(pools_[(tick_ + 1) % 2]);
  const auto samples = path_.sprite().samples();
  for (const Sequence& s : beam_)
    pools_[(tick_ + samples[s.state.sample].duration) % pools_.size()].push_back(s);
}

void Beam::clean_history() {
  std::vector<std::uint32_t> leaves;
  for (const auto& pool : pools_)
    for (const Sequence& s : pool) leaves.push_back(s.node);
  if (best_node_ != kNoNode) leaves.push_back(best_node_);
  const auto renumbered = history_.clean(leaves);
  for (auto& pool : pools_)
    for (Sequence& s : pool) s.node = renumbered[s.node];
  if (best_node_ != kNoNode) best_node_ = renumbered[best_node_];
}

Error Beam::nobody_arrived() const {
  char text[300];
  std::snprintf(
      text, sizeof text,
      "no sequence of samples arrives at the end of the path: the furthest came to segment "
      "%u of %zu, %.0f of %.0f px, after %.1f s: a wider beam, a lower price of distance or "
      "a higher price of time may help, and so may film of that direction",
      furthest_segment_ + 1, path_.segments().size(), furthest_ / 64.0, path_.length(),
      static_cast<double>(furthest_tick_) / path_.sprite().fps());
  return {ErrorCode::BadContent, text};
}

void Beam::report() {
  for (std::size_t t = 0; t < tile_count_; ++t) {
    const Tile& tile = tiles_[t];
    stats_.evaluated += tile.evaluated;
    if (tile.furthest > furthest_) {
      furthest_ = tile.furthest;
      furthest_segment_ = tile.furthest_segment;
      furthest_tick_ = tick_;
    }
  }
  ++stats_.ticks;
  if (config_.progress) config_.progress(furthest_ / 64.0 / path_.length());
}

Result<Clip> Beam::run() {
  seed();
  while (take_tick()) {
    if (config_.go_on && !config_.go_on())
      return Error{ErrorCode::Interrupted, "interrupted: no run was found yet"};
    rows_.trim();
    each_tile([this](std::size_t t) { leave(t); });
    least_ = kNoCost;
    for (std::size_t t = 0; t < tile_count_; ++t) {
      least_ = std::min(least_, tiles_[t].least);
      if (tiles_[t].arrived >= best_) continue;
      best_ = tiles_[t].arrived;
      best_node_ = tiles_[t].arrived_node;
    }
    if (least_ == kNoCost) continue;
    make_rows();
    choose();
    first_node_ = history_.size();
    History::Node* nodes = history_.grow(survivors_);
    beam_.resize(survivors_);
    each_tile([this, nodes](std::size_t t) { emit(tiles_[t], nodes); });
    put_back();
    if (history_.is_full()) clean_history();
    report();
  }
  if (best_node_ == kNoNode) return nobody_arrived();
  return make_clip(path_, history_.trace(best_node_));
}

Position placed(const PathCost& path, std::int32_t x, std::int32_t y) {
  const Position origin = to_position(path.origin());
  return {origin.x + x, origin.y + y};
}

}  // namespace

Clip make_clip(const PathCost& path, const std::vector<std::uint32_t>& samples) {
  Clip clip;
  std::int32_t x = 0, y = 0;
  std::uint32_t segment = 0;
  Cost total = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const std::uint32_t sample = samples[k];
    float jump = k == 0 ? 0 : path.sprite().transition_cost(samples[k - 1], sample);
    const std::uint32_t duration = path.sprite().samples()[sample].duration;
    for (std::uint32_t t = 0; t < duration; ++t) {
      Cost cost = path.angle_cost(sample, segment) + Cost{PathCost::transition_cost(jump)};
      if (!clip.ticks.empty()) cost += path.deviation_cost(x, y, segment);
      total += cost;
      clip.ticks.push_back({sample, placed(path, x, y), segment, jump, path.angle(sample, segment),
                            path.distance(x, y, segment), static_cast<double>(cost) / kCostOne});
      jump = 0;
      if (path.move(sample, x, y, segment) != PathEnd::OnTheWay) {
        k = samples.size();
        break;
      }
    }
  }
  clip.cost = static_cast<double>(total) / kCostOne;
  return clip;
}

ClipReport measure_clip(const PathCost& path, const Clip& clip) {
  ClipReport report;
  std::vector<double> deviations, costs;
  for (std::size_t k = 0; k < clip.ticks.size(); ++k) {
    const ClipTick& tick = clip.ticks[k];
    deviations.push_back(tick.deviation);
    costs.push_back(static_cast<double>(tick.transition));
    report.transition_mean += costs.back() / static_cast<double>(clip.ticks.size());
    report.off_course += tick.angle > kPi / 4;
    report.jumps += k > 0 && tick.sample != clip.ticks[k - 1].sample &&
                    !path.sprite().is_natural(clip.ticks[k - 1].sample, tick.sample);
  }
  std::sort(deviations.begin(), deviations.end());
  std::sort(costs.begin(), costs.end());
  const std::size_t n = deviations.size();
  report.deviation_median = (deviations[(n - 1) / 2] + deviations[n / 2]) / 2;
  report.deviation_p95 = deviations[(n * 95 + 99) / 100 - 1];
  report.deviation_max = deviations.back();
  report.transition_p99 = costs[(n * 99 + 99) / 100 - 1];
  report.transition_max = costs.back();
  return report;
}

Result<Clip> search_path(const PathCost& path, const SearchConfig& config, SearchStats* stats) {
  SearchStats scratch;
  return Beam(path, config, stats != nullptr ? *stats : scratch).run();
}

}  // namespace vsprite
