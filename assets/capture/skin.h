// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// capture/skin.h - colour and relief of the goldfish's body, over (along, from back to belly).
#pragma once

#include <vector>

#include "vec.h"

namespace vsprite::capture {

struct SkinPoint {
  Vec3 albedo;            ///< linear R G B
  float bump_along = 0;   ///< slope of the relief towards the tail
  float bump_across = 0;  ///< and towards the belly
  float gloss = 0;        ///< strength of the highlight, 0 .. 1
};

/// Tabulated once; bilinear between.
class Skin {
 public:
  Skin();
  SkinPoint at(float along, float across) const;

 private:
  static constexpr int kColumns = 768, kRows = 256;
  std::vector<SkinPoint> points_;
};

}  // namespace vsprite::capture
