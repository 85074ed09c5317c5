// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/pictures.h - the sprites of a work folder, read ahead by all threads, handed out in order.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "similarity/features.h"
#include "tool/project.h"
#include "vsprite/image.h"

namespace vsprite {

/// Straight-alpha pictures of samples.csv, decoded in batches; memory stays that of one batch.
class PictureReader {
 public:
  PictureReader(const Project& project, const std::vector<SampleRow>& rows);

  /// Pre: samples are asked for in ascending order.
  /// Errors: CorruptData (missing, damaged, or of another size than its row says).
  Result<Image> picture(int sample);

 private:
  void read_batch(int first);

  const Project& project_;
  const std::vector<SampleRow>& rows_;
  int first_ = 0;
  std::vector<Result<Image>> batch_;
};

/// The straight-alpha picture of one sample, mirrored where the sample is.
/// Errors: CorruptData (missing, damaged, or of another size than its row says).
Result<Image> read_sprite(const Project& project, const SampleRow& row);

/// Exchanges left and right.
void flip(Image& image);

/// The pixels with alpha >= 128 lie in columns left..right - 1 and rows top..bottom - 1.
struct OpaqueBox {
  int left = 0, top = 0, right = 0, bottom = 0;  ///< all 0 if there is none
  int longer_side() const noexcept { return std::max(right - left, bottom - top); }
};
OpaqueBox opaque_box(const Image& picture) noexcept;

/// What train, transitions and pack need of the pictures, read once.
struct LoadedSprites {
  FeatureSet features;
  std::vector<OpaqueBox> boxes;  ///< (N) px
};
Result<LoadedSprites> load_sprites(const Project& project);

/// `raw` or `per-area`, as --features says it.
FeatureScale feature_scale(std::string_view name) noexcept;
/// In which features the classifier of the work folder was trained: weights mean nothing in others.
/// Loaded sprites are in it.
FeatureScale trained_scale(const Project& project);

}  // namespace vsprite
