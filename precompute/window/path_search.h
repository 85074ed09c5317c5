// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// path_search.h - the search behind the path window: in a thread of its own, begun anew whenever
// the path changes; first a narrow beam, so that there is something to see, then the wide one.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "control/search.h"

namespace vsprite::window {

/// What was found for the path last asked for.
struct PathFound {
  Clip clip;          ///< empty where none was found
  ClipReport report;  ///< of it
  std::string error;  ///< why there is none; empty
  int width = 0;      ///< of the beam
  double seconds = 0;
};

class PathSearch {
 public:
  PathSearch(const Sprite& sprite, const PathWeights& weights, int width, int jobs);
  PathSearch(const PathSearch&) = delete;
  PathSearch& operator=(const PathSearch&) = delete;
  ~PathSearch();  ///< ends the search first

  /// Another path: what was being searched is given up, what was found for it is forgotten.
  void ask(std::vector<Vec2> points);
  /// Handed out once. None: nothing new.
  std::optional<PathFound> take();
  /// Share of the path behind the furthest; below 0: nothing is being searched.
  double progress() const;

 private:
  void work();
  PathFound look(const std::vector<Vec2>& points, int width, std::uint64_t number);
  bool is_wanted(std::uint64_t number) const;

  const Sprite& sprite_;
  const PathWeights weights_;
  const int width_, jobs_;
  mutable std::mutex guard_;
  std::condition_variable changed_;
  std::vector<Vec2> points_;
  std::uint64_t number_ = 0;  ///< of the path asked for
  bool is_asked_ = false, ends_ = false;
  double progress_ = -1;
  std::optional<PathFound> found_;
  std::thread thread_;
};

}  // namespace vsprite::window
