// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/stages.h - the five stages over a work folder: run, or skipped because nothing has changed.
#pragma once

#include <climits>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "control/joint.h"
#include "similarity/transitions.h"
#include "tool/pictures.h"
#include "tool/project.h"
#include "tool/settings.h"

namespace vsprite {

/// Where a stage reports to; all may be empty.
struct StageListener {
  std::function<void(const std::string& stage)> begin;
  std::function<void(double fraction)> progress;  ///< 0..1, from one thread at a time
  std::function<void(const std::string& text)> note;
  std::function<void(const std::string& stage, bool skipped)> end;
};

/// One stage's line in the report.
struct StageOutcome {
  std::string name;
  double seconds = 0;
  /// Of this process during the stage, and of the largest decoder child where one worked in it.
  double peak_rss_mb = 0;
  bool skipped = false;
  Json result = Json::object();  ///< its figures, also where it was skipped
};

/// Finds all pairs within a finder's limit, ascending; accepted_pairs() where it is empty.
using PairSearch = std::function<Result<std::vector<PairDistance>>(
    const PairFinder& finder, const TileStore& store, std::uint64_t* compared,
    const std::function<void(double)>& progress)>;

/// A solve as it is ordered from other processes.
struct SolveOrder {
  bool is_joint = false;
  SolveConfig paper{};
  JointConfig joint{};
  std::uint32_t served = 0;  ///< of solve_joint()
};

/// How a run shares its work with other processes (ranks.h). Empty: it does all itself.
struct Sharing {
  PairSearch search;
  /// Starts the same solve in the others; what it returns is due in solve() or solve_joint() at
  /// once.
  std::function<Spread(const CostTable& costs, const Motion& motion, const SolveOrder& order)>
      spread;
};

/// What a run works on. `film` is empty where the film is not at hand: segment must then be
/// current.
struct StageRun {
  Project& project;
  const Settings& settings;
  std::string film;
  std::string pack;
  StageListener listener;
  int first_frame = 0, end_frame = INT_MAX;  ///< of the film, where a cast names some of it
  Sharing sharing = {};
  std::optional<LoadedSprites> sprites = {};    ///< read once, used by several stages
  std::optional<std::string> sprites_sum = {};  ///< likewise
};

/// Runs the stages `first`..`last` of kStages, by index. Stops at the first error: everything that
/// earlier stages made still stands.
Result<std::vector<StageOutcome>> run_stages(StageRun& run, int first, int last);
/// Index into kStages. Pre: it is one of them.
int stage_index(std::string_view name);

/// `--draft`: every second frame, and no picture larger than this, px.
inline constexpr int kDraftStride = 2, kDraftSize = 128;

/// film -> sprites/*.png, samples.csv, contact.png (segment.cpp). `origin`: sum over film and
/// settings.
Result<Json> segment_film(StageRun& run, const std::string& origin);

/// What the stage `segment` depends on in every kind of film and in a cast.
Json segment_settings(const Settings& settings);
/// What the stage `solve` depends on, beside its inputs.
Json solve_settings(const Settings& settings);
/// T and velocities -> values.bin: both modes, and which directions each serves (control.cpp).
Result<Json> solve_tables(StageRun& run);

/// T, V and pictures -> the pack (build_pack.h), measured on the way.
Result<Json> write_pack(StageRun& run);

/// The settings that `transitions` goes by.
TransitionConfig transition_config(const Settings& settings);

}  // namespace vsprite
