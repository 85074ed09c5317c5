// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/shadows.h - filmed shadows in the work folder, beside the sprites.
//
//     shadows/000123.png  shadows.csv
//
// Black pictures whose coverage is the shade, for the samples that cast one; a pixel of them is two
// of the sprite's. They may be retouched like the sprites. shadows.csv names their size and where
// the sample's anchor lies in them, px: `sample,width,height,anchor_x,anchor_y`.
#pragma once

#include <string>
#include <vector>

#include "film/extract.h"
#include "tool/project.h"

namespace vsprite {

inline constexpr const char* kShadowFolder = "shadows";
inline constexpr float kShadowScale = 2;  ///< sprite pixels a pixel

struct ShadowRow {
  int sample = 0;
  int width = 0, height = 0;
  double anchor_x = 0, anchor_y = 0;
};
ShadowRow row_of(int sample, const CutShadow& shadow);

std::string shadow_path(const Project& project, int sample);
/// True where the last segmentation looked for shadows.
bool has_shadows(const Project& project);
void remove_shadows(const Project& project);
/// shadows.csv, after the pictures. Errors: CannotCreate, CannotWrite.
Result<void> write_shadows(const Project& project, const std::vector<ShadowRow>& rows);
/// Ascending by sample; none where there is no such file.
/// Errors: CorruptData, as `path:line: ...`; CannotRead.
Result<std::vector<ShadowRow>> read_shadows(const Project& project);
/// Errors: CorruptData (missing, damaged, or of another size than its row says).
Result<Image> read_shadow(const Project& project, const ShadowRow& row);
/// Over the table and the pictures that it names. Errors: those of read_shadows, and CorruptData
/// (names the missing picture).
Result<std::string> shadows_sum(const Project& project);

/// The shadows of kept samples, mirrored ones too, go into `data`. Errors: those above,
/// OutOfMemory.
Result<void> add_shadows(const Project& project, const std::vector<SampleRow>& rows,
                         SpriteData& data);

}  // namespace vsprite
