// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// capture/goldfish.h - the bundled film and its exact truth.
//
// A goldfish swims before a blue screen. The whole film follows from one seed: its motion is
// simulated once (choreography.h), after which any frame can be rendered alone, in any order and on
// any thread, with the same numbers as in the film. Per pixel, in linear light,
//
//     C = alpha F + (1 - alpha) B,      film = round(sRGB(C) + sensor noise)
//
// where alpha is the exact average of the fish's coverage over the pixel and the open shutter.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "vsprite/image.h"

namespace vsprite::capture {

/// What the fish does in the middle of a frame's exposure. Pixels, x right, y down.
struct FishPose {
  double x = 0, y = 0;    ///< the body's centre (0.45 of the way from nose to tail root), projected
  double velocity_x = 0;  ///< px/s, central differences of (x, y); 0 while the fish is away
  double velocity_y = 0;
  double speed = 0;           ///< px/s through the water
  double yaw = 0;             ///< radians, unwrapped: 0 faces right, pi/2 the camera, pi left
  double pitch = 0;           ///< radians, positive = nose up
  double bend = 0;            ///< radians from nose to tail root, sideways, into the turn
  double arch = 0;            ///< the same, in the fish's plane of symmetry
  double tail_phase = 0;      ///< tail beats since the film's start
  double tail_amplitude = 0;  ///< 0 .. 1
  double hover = 0;           ///< 0 under way .. 1 standing, paddling with the pectoral fins
  int heading = -1;           ///< commanded compass heading, clockwise from right; -1 rest
  bool away = false;          ///< between leaving the frame and coming back
};

/// Where the fish shows in the picture, fins and motion blur included.
struct FishBounds {
  double left = 0, top = 0, right = 0, bottom = 0;
  bool visible = false;         ///< some of it lies inside the frame
  bool touches_border = false;  ///< some of it lies outside, and some inside
};

/// One frame and what went into it; all arrays are (height, width) rows top to bottom.
struct TruthFrame {
  int width = 0, height = 0;
  std::vector<float> alpha;       ///< (h, w) 0 .. 1
  std::vector<float> foreground;  ///< (h, w, 3) linear R G B, 0 where alpha is 0
  std::vector<float> plate;       ///< (h, w, 3) linear R G B
  Image composite;                ///< what goes to the encoder, alpha 255
  double centroid_x = 0;          ///< alpha-weighted mean of the pixel centres: the position that a
  double centroid_y = 0;          ///< matte can show (the body's centre is in FishPose)
  double area = 0;                ///< sum of alpha, px^2
};

class GoldfishFilm {
 public:
  GoldfishFilm();
  ~GoldfishFilm();
  GoldfishFilm(GoldfishFilm&&) noexcept;
  GoldfishFilm& operator=(GoldfishFilm&&) noexcept;

  int width() const noexcept { return 640; }
  int height() const noexcept { return 480; }
  double fps() const noexcept { return 30.0; }
  int frame_count() const noexcept;

  /// Pre: 0 <= frame < frame_count(), here and below. Free.
  const FishPose& pose(int frame) const noexcept;
  /// A fraction of a millisecond; generous by a pixel.
  FishBounds bounds(int frame) const;
  /// About a tenth of a second; reuses the memory of `out`. Any number of threads.
  void render(int frame, TruthFrame& out) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsprite::capture
