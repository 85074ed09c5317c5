// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/export.h - a pack for programs that know nothing of this one (precompute/EXPORTS.md).
//
// A format is a name and a function that fills a folder; `export_formats` is the list of them.
// Before it is called the samples are chosen (control/choose.h) and solved again.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "control/choose.h"
#include "tool/project.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// What is exported. Borrows `film`.
struct ExportJob {
  const Sprite& film;                    ///< the whole pack, which has the pictures
  SampleChoice choice;                   ///< `choice.from` are samples of `film`
  std::string output;                    ///< the folder, which exists
  std::function<void(double)> progress;  ///< 0..1; may be empty
};

struct ExportFormat {
  std::string_view name;     ///< as --to says it
  std::string_view summary;  ///< half a sentence
  /// Returns what it wrote, for --json. Errors: CannotCreate, CannotWrite, LimitExceeded, those of
  /// decode_frame.
  Result<Json> (*write)(const ExportJob& job);
};
std::span<const ExportFormat> export_formats();
/// Errors: BadSetting, naming the nearest one.
Result<const ExportFormat*> find_export_format(const std::string& name);

/// The samples of a pack, at most `limit` (0: all that are kept), solved again. Play-through is
/// left out of the tables: a plain table cannot make up for the sample that it leaves out.
/// Errors: those of choose_samples().
Result<SampleChoice> choose_for_export(const Sprite& sprite, int limit, std::uint64_t seed,
                                       int jobs);

/// The whole character as tables; "format": "vsprite-table". `places`: one object a sample, where
/// its picture is.
Json character_json(const SpriteData& data, const std::vector<Json>& places);

}  // namespace vsprite
