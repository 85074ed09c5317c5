// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/extract.h - one subject followed through the film: clips, anchors, velocities, samples.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "film/matte.h"
#include "vsprite/image.h"
#include "vsprite/result.h"

namespace vsprite {

/// A row of samples.csv. Place and anchor in film pixels, velocity in film pixels per second.
struct SampleRow {
  int sample = 0;
  int clip = 0;
  int frame = 0;                 ///< film frame, from 0
  double left = 0, top = 0;      ///< of the image's top left corner
  double width = 0, height = 0;  ///< image size / scale
  double anchor_x = 0, anchor_y = 0;
  double velocity_x = 0, velocity_y = 0;
  double area = 0;     ///< sum of alpha / 255, film px^2
  std::string source;  ///< file name of the film, without folders
  std::string tag;     ///< empty: none
  int duration = 1;    ///< film frames
  double scale = 1;    ///< image pixels per film pixel
  int mirror_of = -1;
};

/// What is kept of a keyed frame while the film is being followed (small: a few hundred bytes).
struct FrameSummary {
  int index = 0;
  std::vector<Blob> blobs;
  double difference = 0;
};

struct ExtractConfig {
  int max_size = 256;  ///< px, longest side of the largest sprite image, 16..4096
  double sigma = 1.2;  ///< frames, Gaussian that smooths positions before central differences, 0..8
  int min_clip = 8;    ///< frames; shorter clips are dropped
  int max_repeats = 3;  ///< more duplicates in a row start a new clip
};

struct Extraction {
  std::vector<SampleRow> rows;
  std::vector<int> labels;  ///< (rows) blob label to cut out of the keyed frame
  int frames = 0, duplicates = 0, clips = 0;
  int dropped_border = 0, dropped_empty = 0, dropped_short = 0;
  double velocity_noise = 0;  ///< px/s, rms of the part removed by smoothing
};

/// Follows the largest connected part; drops duplicates and frames that touch the border; splits
/// clips where the subject leaves or the film cuts. Errors: BadContent (no subject; several
/// subjects of like size, with where and when; nothing left, with the reason and what to do).
Result<Extraction> extract(std::span<const FrameSummary> frames, double fps,
                           const std::string& source, const ExtractConfig& config);

/// Cuts one sample's picture out of its keyed frame: straight alpha, area-averaged in linear light
/// to row.scale. The result's size is row.width * scale by row.height * scale, whole pixels.
Image cut_sample(const KeyedFrame& frame, int label, const SampleRow& row);

}  // namespace vsprite
