// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// control/search.h - a sequence of samples that follows a drawn path (NIPS section 3.2).
//
// Every kept sample is a seed at the path's first point. Tick by tick all sequences take every
// transition, and the `width` cheapest go on; the first tick's are all seeds. The result is the
// cheapest sequence that arrives at the end of the last segment; the search ends when none in the
// beam can become cheaper.
//
// The beam is exact: the survivors are those that sorting all candidates would leave, ties by
// (parent, sample), where parents keep the order in which they were made. Most candidates are never
// looked at: what a successor adds depends on the sample and the segment's direction alone, so each
// sample's successors are sorted once, and a sequence hands them out until one is too dear. (One
// that is 4,095 thresholds dearer than the cheapest is dropped at any width.)
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "control/path_cost.h"
#include "vsprite/result.h"

namespace vsprite {

struct SearchConfig {
  int width = 50000;  ///< sequences kept a tick, 1..10,000,000
  int jobs = 0;       ///< threads, 0 = all; the result does not depend on it
  std::function<void(double)> progress =
      {};  ///< share of the path behind the furthest; may be empty
  /// Asked every tick; false ends the search without a result. May be empty.
  std::function<bool()> go_on = {};
  /// Shown every tick's survivors, in order; for tests, may be empty.
  std::function<void(std::span<const PathState>)> survivors = {};
};

/// One shown tick.
struct ClipTick {
  std::uint32_t sample = 0;
  Position position;          ///< of the anchor
  std::uint32_t segment = 0;  ///< being followed
  float transition = 0;       ///< T of the jump that brought the sample; 0 otherwise
  double angle = 0;           ///< a(i, l), radians
  double deviation = 0;       ///< to the segment, from its start to its end, px
  double cost = 0;            ///< C of this tick
};

/// A scripted run of samples.
struct Clip {
  std::vector<ClipTick> ticks;
  double cost = 0;  ///< sum of C
};

/// What the search did, for tests and benchmarks.
struct SearchStats {
  std::uint64_t ticks = 0;
  std::uint64_t evaluated = 0;  ///< successors looked at
};

/// Errors: BadContent (no sequence arrives: says where the last ones were dropped), Interrupted
/// (`go_on` said no).
Result<Clip> search_path(const PathCost& path, const SearchConfig& config,
                         SearchStats* stats = nullptr);

/// The ticks of a sequence of samples that begins at the path's first point; stops at its end.
/// Pre: each sample is a successor of the one before.
Clip make_clip(const PathCost& path, const std::vector<std::uint32_t>& samples);

/// How well a clip does: per tick, distance in px to the segment being followed.
struct ClipReport {
  double deviation_median = 0, deviation_p95 = 0, deviation_max = 0;  ///< px
  std::size_t off_course = 0;  ///< ticks whose a(i, l) is over 45 degrees
  std::size_t jumps = 0;
  double transition_mean = 0, transition_p99 = 0, transition_max = 0;  ///< T over all ticks
};
/// Pre: the clip has a tick.
ClipReport measure_clip(const PathCost& path, const Clip& clip);

}  // namespace vsprite
