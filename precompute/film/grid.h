// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/grid.h - pictures on the chroma grid, where one cell is 2 x 2 pixels.
//
// Films carry colour at half resolution (4:2:0), so the sum of Y over a cell and the cell's Cb, Cr
// are what the film really holds; everything that compares colours works here.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "film/video.h"

namespace vsprite::detail {

/// A rectangle of cells.
struct Window {
  int left = 0, top = 0, width = 0, height = 0;
  std::size_t cells() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// A run of cells of one row, [begin, end); empty where end <= begin.
struct Span {
  int begin = 0, end = 0;
  int size() const { return end > begin ? end - begin : 0; }
};

/// Sums of the four encoded pixels of a cell, 0..1020, one plane a channel: R, G, B. At an odd
/// right or lower edge the last pixel counts twice.
struct Grid {
  int left = 0, top = 0;  ///< where it lies on the film's grid
  int width = 0, height = 0;
  std::vector<std::uint16_t> plane[3];

  std::size_t cells() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/// Fills `grid` with the `spans` (one a row) of a part of a frame, or with a whole frame.
void make_grid(const Frame& frame, const Window& window, std::span<const Span> spans, Grid& grid);
void make_grid(const Frame& frame, Grid& grid);

/// A map of cells, 1 = in, row-major, of the given width and height.
struct Mask {
  int width = 0, height = 0;
  std::vector<std::uint8_t> in;

  Mask() = default;
  Mask(int w, int h)
      : width(w), height(h), in(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  std::uint8_t* row(int y) { return in.data() + static_cast<std::ptrdiff_t>(y) * width; }
  const std::uint8_t* row(int y) const {
    return in.data() + static_cast<std::ptrdiff_t>(y) * width;
  }
};

/// Square neighbourhoods of (2 radius + 1)^2 cells; outside counts as out (dilate), in (erode).
Mask dilate(const Mask& mask, int radius);
Mask erode(const Mask& mask, int radius);

/// Several of those in turn: larger by a radius above 0, smaller by one below.
Mask reshape(const Mask& mask, std::initializer_list<int> radii);

/// `dilate` and `erode` with octagons, near discs, of `radius` cells.
Mask dilate_disc(const Mask& mask, int radius);
Mask erode_disc(const Mask& mask, int radius);

/// `mask` and what of `room` it reaches in `steps` steps to the eight neighbours.
Mask grow_into(const Mask& room, const Mask& mask, int steps);

/// Sum over boxes of 2 radius + 1, `passes` times in both directions, divided by the box: near
/// Gaussian of variance passes ((2 radius + 1)^2 - 1) / 12. Outside is 0. `scratch` is working
/// room.
void blur(std::vector<float>& plane, int width, int height, int radius, int passes,
          std::vector<float>& scratch);

/// The run that holds all of each row within `reach` cells of it, above and below too.
void spans_of(const Mask& mask, int reach, std::vector<Span>& spans);

/// Labels of the 8-connected parts of `mask`, 1.. in the order of their first cell; 0 = out.
/// Returns their number.
int connected_parts(const Mask& mask, std::vector<int>& labels);

}  // namespace vsprite::detail
