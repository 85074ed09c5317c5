// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/cast.h - the stage `segment` of a cast: each clip for itself, then all as one sprite set.
//
// Every clip is segmented in a work folder of its own, clips/00-walk and so on, and is skipped
// there while its film and settings are the same. Then the clips are matched (film/match.h),
// numbered through, and their pictures written to sprites/. In samples.csv "film pixels" are the
// first clip's, `source` is the file as the cast names it, and mirrored samples follow all others.
#pragma once

#include <string>

#include "tool/cast_file.h"
#include "tool/stages.h"

namespace vsprite {

/// What a clip is segmented with: the settings, and over them what the cast says of it.
Settings clip_settings(const Settings& settings, const CastClip& clip);

/// What the stage depends on. Errors: those of read_cast and hash_source, and BadSetting (--matte).
Result<StageKey> cast_key(StageRun& run);

/// Errors: those of the first clip that cannot be used, after the others were segmented.
Result<Json> segment_cast(StageRun& run);

/// `walk (walk.mp4): scale x 0.80, colour x 1.10 1.08 1.11, 24 to 30 frames a second`; empty where
/// nothing was changed. `clip`: an entry of the stage's figures.
std::string describe_matching(const Json& clip);

}  // namespace vsprite
