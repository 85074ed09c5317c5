// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "similarity/joins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <queue>
#include <tuple>

#include "similarity/transitions.h"

namespace vsprite {
namespace {

// Samples first..last, one after the other, all of one tag.
struct Run {
  int first = 0, last = 0;
  std::string tag;
};

const std::string& tag_of(const FeatureSet& set, int i) {
  return set.rows[static_cast<std::size_t>(i)].tag;
}

std::vector<Run> find_runs(const FeatureSet& set) {
  std::vector<Run> runs;
  for (int i = 0; i < static_cast<int>(set.rows.size()); ++i) {
    const std::string& tag = tag_of(set, i);
    if (tag.empty()) continue;
    if (!runs.empty() && follows(set, i - 1, i) && runs.back().last == i - 1 &&
        runs.back().tag == tag) {
      runs.back().last = i;
    } else {
      runs.push_back({i, i, tag});
    }
  }
  return runs;
}

// T_ij with what exists of it: both halves, one, or the two samples themselves.
class Price {
 public:
  Price(const FeatureSet& set, const Classifier& classifier, const Run& from, const Run& to)
      : from_(from), to_(to), width_(to.last - to.first + 1) {
    for (int i = from.first; i <= from.last; ++i) {
      for (int j = to.first; j <= to.last; ++j) {
        distance_.push_back(classifier.distance(features(set, i, j)));
      }
    }
  }
  float operator()(int i, int j) const {
    const bool next = i<from_.last, before = j> to_.first;
    if (next && before) return (at(i, j - 1) + at(i + 1, j)) / 2;
    if (next) return at(i + 1, j);
    return before ? at(i, j - 1) : at(i, j);
  }

 private:
  float at(int i, int j) const {
    return distance_[static_cast<std::size_t>((i - from_.first) * width_ + j - to_.first)];
  }
  const Run &from_, &to_;
  int width_;
  std::vector<float> distance_;
};

using Offer = std::tuple<float, std::uint32_t, std::uint32_t>;  // cost, from, to; cheapest first

// The cheapest way from one run to another anywhere, to its first sample, and from its last.
struct Ways {
  Offer any, to_first, from_last, ends;
};

Ways find_ways(const FeatureSet& set, const Classifier& classifier, const Run& from, const Run& to,
               int min_back) {
  const Price price(set, classifier, from, to);
  const Offer none{std::numeric_limits<float>::infinity(), 0, 0};
  Ways ways{none, none, none, none};
  for (int i = from.first; i <= from.last; ++i) {
    const int shortest = shortest_jump_back(set, i, min_back);
    for (int j = to.first; j <= to.last; ++j) {
      const bool same = from.first == to.first;
      if (same && (j > i || i - j < shortest)) continue;
      const Offer offer{price(i, j), static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)};
      ways.any = std::min(ways.any, offer);
      if (j == to.first) ways.to_first = std::min(ways.to_first, offer);
      if (i == from.last) ways.from_last = std::min(ways.from_last, offer);
      if (j == to.first && i == from.last) ways.ends = offer;
    }
  }
  return ways;
}

using Edges = std::vector<std::vector<std::uint32_t>>;

// Cheapest offers without which a sample of the runs is not reached from `root` (Prim's order).
std::vector<Offer> missing_offers(const Edges& edges, const std::vector<Offer>& offers,
                                  std::uint32_t root) {
  std::vector<std::vector<Offer>> at(edges.size());
  for (const Offer& offer : offers) at[std::get<1>(offer)].push_back(offer);
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> open;
  std::vector<std::uint8_t> seen(edges.size(), 0);
  const auto flood = [&](std::uint32_t from) {
    std::vector<std::uint32_t> stack{from};
    seen[from] = 1;
    while (!stack.empty()) {
      const std::uint32_t i = stack.back();
      stack.pop_back();
      for (const std::uint32_t to : edges[i]) {
        if (!seen[to]) seen[to] = 1, stack.push_back(to);
      }
      for (const Offer& offer : at[i]) open.push(offer);
    }
  };
  std::vector<Offer> missing;
  flood(root);
  while (!open.empty()) {
    const Offer offer = open.top();
    open.pop();
    const std::uint32_t to = std::get<2>(offer);
    if (seen[to]) continue;
    missing.push_back(offer);
    flood(to);
  }
  return missing;
}

void turn_round(Edges& edges, std::vector<Offer>& offers) {
  Edges back(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (const std::uint32_t to : edges[i]) back[to].push_back(static_cast<std::uint32_t>(i));
  }
  edges = std::move(back);
  for (Offer& offer : offers) std::swap(std::get<1>(offer), std::get<2>(offer));
}

}  // namespace

int shortest_jump_back(const FeatureSet& set, int i, int min_back) {
  const std::string& tag = tag_of(set, i);
  if (tag.empty()) return min_back;
  int first = i, last = i;
  while (first > i - 2 * min_back && follows(set, first - 1, first) &&
         tag_of(set, first - 1) == tag)
    --first;
  while (last < i + 2 * min_back && follows(set, last, last + 1) && tag_of(set, last + 1) == tag)
    ++last;
  return std::clamp((last - first + 1) / 2, 1, min_back);
}

std::vector<TagJoin> find_joins(const FeatureSet& set, const Classifier& classifier,
                                const CostTable& graph, int min_back) {
  const std::vector<Run> runs = find_runs(set);
  if (runs.empty()) return {};
  const std::size_t n = set.rows.size();
  Edges edges(n);
  std::map<std::pair<std::string, std::string>, bool> accepted;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::uint32_t e = graph.row_start[i]; e < graph.row_start[i + 1]; ++e) {
      const std::uint32_t to = graph.transitions[e].to;
      edges[i].push_back(to);
      accepted[{set.rows[i].tag, set.rows[to].tag}] = true;
    }
  }
  std::map<std::pair<std::string, std::string>, Offer> cheapest;
  std::vector<Offer> offers, chosen;
  for (const Run& from : runs) {
    for (const Run& to : runs) {
      const Ways ways = find_ways(set, classifier, from, to, min_back);
      for (const Offer& way : {ways.any, ways.to_first, ways.from_last, ways.ends}) {
        if (std::isfinite(std::get<0>(way))) offers.push_back(way);
      }
      if (from.tag == to.tag || accepted.contains({from.tag, to.tag})) continue;
      const auto [at, fresh] = cheapest.try_emplace({from.tag, to.tag}, ways.any);
      if (!fresh) at->second = std::min(at->second, ways.any);
    }
  }
  const auto choose = [&](const Offer& offer) {
    chosen.push_back(offer);
    edges[std::get<1>(offer)].push_back(std::get<2>(offer));
  };
  for (const auto& [tags, offer] : cheapest) choose(offer);
  const auto root = static_cast<std::uint32_t>(runs.front().first);
  for (const Offer& offer : missing_offers(edges, offers, root)) choose(offer);
  turn_round(edges, offers);
  for (auto [cost, to, from] : missing_offers(edges, offers, root))
    chosen.push_back({cost, from, to});

  std::vector<TagJoin> joins;
  for (const auto& [cost, from, to] : chosen) {
    joins.push_back({from, to, cost, set.rows[from].tag, set.rows[to].tag});
  }
  const auto key = [](const TagJoin& j) { return std::tie(j.from, j.to); };
  std::sort(joins.begin(), joins.end(),
            [&](const TagJoin& a, const TagJoin& b) { return key(a) < key(b); });
  joins.erase(std::unique(joins.begin(), joins.end(),
                          [&](const TagJoin& a, const TagJoin& b) { return key(a) == key(b); }),
              joins.end());
  return joins;
}

std::string describe(const TagJoin& join) {
  const int tenths = static_cast<int>(std::lround(10 * static_cast<double>(join.cost)));
  return join.from_tag + " -> " + join.to_tag + " joined at " + std::to_string(tenths / 10) + "." +
         std::to_string(tenths % 10) + " x the threshold" +
         (join.cost > 1 ? ": film " + join.from_tag + " going over into " + join.to_tag : "");
}

}  // namespace vsprite
