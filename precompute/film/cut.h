// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/cut.h - which cells before a standing plate are subject, decided for all of them together.
//
// Where the subject has the colour of what is behind it, the distance to the plate says nothing:
// shirts get holes, hair before a tree goes. The labels x of the cells are those of least
//
//     sum_i U_i(x_i) + sum_ij V_ij [x_i != x_j]
//
// U: -ln of how likely the cell's colour is for the plate there (as it is, moved by a cell, or in
// shade) and for the subject (its colours over the film). V: smaller where the picture has an edge
// that the plate has not (Sun et al., "Background Cut", 2006). Found exactly, as the minimum cut of
// a graph (Boykov and Kolmogorov, 2004), in integers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "film/silhouette.h"

namespace vsprite::detail {

/// The number of a colour in 16 steps a channel, of the sums of four encoded pixels.
inline std::size_t color_step(int red, int green, int blue) {
  const auto step = [](int sum) { return static_cast<std::size_t>(std::min(sum / 64, 15)); };
  return 256 * step(red) + 16 * step(green) + step(blue);
}

/// What colours the subject has.
class SubjectColors {
 public:
  /// `sums` of four encoded pixels, R, G, B.
  void add(int red, int green, int blue);
  /// For each color_step -ln of its likelihood, in 64ths; empty where too little was seen.
  std::vector<std::int16_t> costs() const;

 private:
  std::vector<std::uint32_t> counts_ = std::vector<std::uint32_t>(4096);
  std::uint64_t all_ = 0;
};

/// Corrects the silhouette's mask, by at most `kCutReach` cells, where its edge or a hole of it
/// follows no edge of the picture, and leaves out small parts. Pre: screen.subject_cost is not
/// empty. Cost: about a microsecond and 60 bytes a cell of the mask's box.
void cut_out(const ScreenModel& screen, Silhouette& silhouette);
inline constexpr int kCutReach = 6;

/// The minimum cut of a grid of nodes with eight neighbours.
class GridCut {
 public:
  GridCut(int width, int height);
  /// Capacity from the source (above 0) or to the sink; adds to what is there.
  void add_terminal(int x, int y, int capacity);
  /// Between (x, y) and its neighbour `way` of 0..3: right, below left, below, below right. Both
  /// directions. Pre: the neighbour exists.
  void set_edge(int x, int y, int way, int capacity);
  /// Finds the smallest source side that any minimum cut has.
  void solve();
  bool with_source(int x, int y) const { return tree_[at(x, y)] == kSource; }

 private:
  enum : std::uint8_t { kFree, kSource, kSink };
  static constexpr std::int8_t kNone = -1, kTerminal = 8;

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(x + 1);
  }
  std::size_t beside(std::size_t node, int way) const {
    return node + static_cast<std::size_t>(step_[way]);  // wraps where the step is negative
  }
  static int opposite(int way) { return way ^ 4; }
  int& residual(std::size_t node, int way) {
    return residual_[8 * node + static_cast<unsigned>(way)];
  }
  /// What may still flow over the edge, away from the terminal that `node` belongs to.
  int onwards(std::size_t node, int way) {
    return tree_[node] == kSource ? residual(node, way)
                                  : residual(beside(node, way), opposite(way));
  }
  void activate(std::size_t node);
  bool grow(std::size_t node, std::size_t& from, int& way);
  void augment(std::size_t from, int way);
  void adopt();
  int origin(std::size_t node);

  int stride_;
  std::ptrdiff_t step_[8];
  std::vector<int> residual_, terminal_;
  std::vector<std::uint8_t> tree_, active_;
  std::vector<std::int8_t> parent_;
  std::vector<std::uint32_t> stamp_, depth_;
  std::uint32_t now_ = 0;
  std::vector<std::size_t> queue_, orphans_;
  std::size_t head_ = 0;
};

}  // namespace vsprite::detail
