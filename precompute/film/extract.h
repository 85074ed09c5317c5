// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/extract.h - one subject followed through the film: clips, anchors, velocities, samples.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "film/floor.h"
#include "film/matte.h"
#include "film/subject.h"
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

struct ExtractConfig {
  int max_size = 256;  ///< px, longest side of the largest sprite image, 16..4096
  double sigma = 1.2;  ///< frames, Gaussian that smooths positions before central differences, 0..8
  int min_clip = 8;    ///< frames; shorter clips are dropped
  int max_repeats = 3;  ///< more duplicates in a row start a new clip
  SubjectChoice subject = {};
  bool ground = false;     ///< anchor: true = ground line below the centroid; needs `ground`
  FloorChoice floor = {};  ///< where there is one, `ground` is due
  bool mirror = false;     ///< mirrored samples N + i follow
  int stride = 1;          ///< film frames from one summary to the next (a draft leaves out)
  int width = 1 << 20, height = 1 << 20;  ///< of the film, px
};

struct Extraction {
  std::vector<SampleRow> rows;
  std::vector<int> labels;     ///< (rows) blob label to cut out of the keyed frame
  std::vector<int> positions;  ///< (rows) index into the summaries
  std::vector<Fate> fates;     ///< (summaries)
  std::vector<int> followed;   ///< (summaries) the subject's blob, an index; -1: none
  int clips = 0;
  int cuts = 0;      ///< clips that begin with a leap of the subject or the picture
  int missing = 0;   ///< frames that the camera left out, by the time stamps
  double scale = 1;  ///< image pixels per film pixel; with a floor: on its ground line
  std::optional<Ground>
      floor;  ///< then velocities are those on it, and rows have scales of their own
  double velocity_noise = 0;  ///< px/s, rms of the part removed by smoothing

  int count(Fate fate) const noexcept;
};

/// Follows the subject (film/subject.h); drops duplicates and frames of no use; splits clips where
/// the subject leaves, is touched or hidden, or where the film cuts. `fps`: of the film. `sources`:
/// file name of each summary's film, without folders. Errors: those of follow_subject; BadContent
/// (nothing left, with the reason and what to do); those of find_floor.
Result<Extraction> extract(std::span<const FrameSummary> frames, double fps,
                           const std::function<std::string(int)>& source,
                           const ExtractConfig& config);
/// The same for one film.
Result<Extraction> extract(std::span<const FrameSummary> frames, double fps,
                           const std::string& source, const ExtractConfig& config);

/// The rows as they are written and used from here on: where there is a floor all of them in its
/// places and of one scale, as if each had been filmed on the ground line.
std::vector<SampleRow> rows_on_floor(const Extraction& extraction);

/// The row of the mirror image of `row`: left and right exchanged about its anchor.
SampleRow mirrored(const SampleRow& row, int sample, int clip);

/// Ground line of each blob of a keyed frame, film px: below it lies a
/// five-thousandth of the blob, by where the columns of its coverage fall below a half.
std::vector<double> ground_lines(const KeyedFrame& frame);

/// Cuts one sample's picture out of its keyed frame: straight alpha, area-averaged in linear light
/// to row.scale. The result's size is row.width * scale by row.height * scale, whole pixels.
Image cut_sample(const KeyedFrame& frame, int label, const SampleRow& row);

/// A sample's shadow: black with the shade as coverage, half as many pixels a side as its picture
/// has for the same length.
struct CutShadow {
  Image image;                        ///< empty: there is none
  double anchor_x = 0, anchor_y = 0;  ///< of the sample, px of this image
};
/// Cuts it out of a frame keyed with MatteConfig::shadow, with a clear border of one pixel.
CutShadow cut_shadow(const KeyedFrame& frame, int label, const SampleRow& row);

}  // namespace vsprite
