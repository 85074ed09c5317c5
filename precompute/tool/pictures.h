// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/pictures.h - the sprites of a work folder, read ahead by all threads, handed out in order.
#pragma once

#include <cstdint>
#include <optional>
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

/// The longer side of the box of pixels with alpha >= 128; 0 if there is none.
int body_side(const Image& picture) noexcept;

/// What train, transitions and pack need of the pictures, read once.
struct LoadedSprites {
  FeatureSet features;
  std::vector<int> body_sides;  ///< (N) px
};
Result<LoadedSprites> load_sprites(const Project& project);

}  // namespace vsprite
