// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/work_files.h - what stands between the stages, as files that people and scripts can read.
//
// samples.csv and classifier.toml are text and may be edited: a slip is answered with its line and
// column. transitions.bin and values.bin are little-endian: eight bytes of magic, u32 version, u32
// zero, the counts, the arrays, and an XXH3-64 sum of all before it, checked before anything is
// used.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "control/solve.h"
#include "film/extract.h"
#include "similarity/classifier.h"
#include "similarity/transitions.h"
#include "vsprite/result.h"

namespace vsprite {

/// Of transitions.bin and values.bin. 2: skip costs; values of several modes.
inline constexpr std::uint32_t kTableVersion = 2;

inline constexpr const char* kSampleColumns =
    "sample,clip,frame,left,top,width,height,anchor_x,anchor_y,velocity_x,velocity_y,area,source,"
    "tag,"
    "duration,scale,mirror_of";

std::string format_samples(const std::vector<SampleRow>& rows);
/// Errors: CorruptData, as `path:line:column: ...`.
Result<std::vector<SampleRow>> parse_samples(const std::string& text, const std::string& path);

/// `moved`: the designer's move of the line (train.h); 1 is not written.
std::string format_classifier(const Training& training, double moved = 1);
/// The move is part of the threshold. Errors: CorruptData, as `path:line:column: ...`.
Result<Classifier> parse_classifier(const std::string& text, const std::string& path,
                                    double* moved = nullptr);

/// transitions.bin: u64 samples, u64 transitions, u64 pairs; f64 v0, px/s; row_start u32[samples +
/// 1]; (u32 to, f32 cost)[transitions]; u8 kept[samples]; (u32 i, u32 j, f32 distance)[pairs];
/// f32 skip[samples].
struct TransitionFile {
  CostTable costs;
  std::vector<PairDistance> pairs;  ///< accepted, ascending
  double v0 = 0;                    ///< film px/s: below this speed a heading means little
  std::vector<float> skip_costs;    ///< T of leaving the next sample out; or infinity
};
std::string format_transitions(const TransitionFile& file);
/// `samples`: as many as samples.csv has. Errors: CorruptData.
Result<TransitionFile> parse_transitions(const std::string& bytes, const std::string& path,
                                         std::size_t samples);

/// values.bin: u64 samples, u64 modes; a mode: its settings in the order of ControlMode, then next
/// u32, go f32 and values f32, (tables, samples) each, and where it is left by state arrived
/// u32[samples].
struct ValueFile {
  std::vector<Solution> modes;  ///< the first is the default
  /// Pre: it holds the mode.
  const Solution* find(const std::string& name) const;
};
/// Gives the memory of a table back as soon as it is in the text.
std::string format_values(ValueFile file);
Result<ValueFile> parse_values(const std::string& bytes, const std::string& path,
                               std::size_t samples);

/// Shortest text that reads back as the same double.
std::string number_text(double value);

}  // namespace vsprite
