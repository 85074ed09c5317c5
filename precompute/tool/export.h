// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/export.h - a pack for programs that know nothing of this one (precompute/EXPORTS.md).
//
// A format is a name and a function that fills a folder or a file; `export_formats` is the one list
// of them. Before it is called the samples are chosen (control/choose.h) and solved again, and what
// is played is laid down (tool/played.h), where the format wants it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "control/choose.h"
#include "tool/played.h"
#include "tool/project.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// What is exported. Borrows `film`.
struct ExportJob {
  const Sprite& film;                      ///< the whole pack, which has the pictures
  SampleChoice choice{};                   ///< `choice.from` are samples of `film`
  std::vector<PlayedRun> runs{};           ///< of samples of `choice`
  std::string output{};                    ///< the folder, which exists; or the file
  std::function<void(double)> progress{};  ///< 0..1; may be empty
  int godot = 4;                           ///< 3 or 4
  std::string pack{};                      ///< html: the pack's name
  std::string_view pack_bytes{};           ///< html: all of the pack
  std::string page{};                      ///< html: the template; empty: the installation's
  double page_limit = 10;                  ///< html: MB; samples are left out where it is more
  std::uint64_t seed = 1;                  ///< html: by which they are chosen
  int jobs = 0;                            ///< html: threads for that
};

/// What a format is made from.
enum class ExportNeed { Pack, Samples, Runs };

struct ExportFormat {
  std::string_view name;  ///< as --to says it
  ExportNeed need;        ///< Pack: writes one file; the others: a folder
  /// Returns what it wrote, for --json. Errors: CannotCreate, CannotWrite, LimitExceeded,
  /// Unavailable (no ffmpeg), those of decode_frame.
  Result<Json> (*write)(const ExportJob& job);
};
std::span<const ExportFormat> export_formats();
/// "html|table|...", as the options' table holds it.
std::string export_names();
/// Errors: BadSetting, naming the nearest one.
Result<const ExportFormat*> find_export_format(const std::string& name);

/// The samples of a pack, at most `limit` (0: all that are kept), solved again. Play-through is
/// left out of the tables: a plain table cannot make up for the sample that it leaves out.
/// Errors: BadContent (a pack that was not made from a film), those of choose_samples().
Result<SampleChoice> choose_for_export(const Sprite& sprite, int limit, std::uint64_t seed,
                                       int jobs);

/// The whole character as tables; "format": "vsprite-table". `places`: one object a sample, where
/// its picture is.
Json character_json(const SpriteData& data, const std::vector<Json>& places);

// The formats. Pages and a description of their pictures:
Result<Json> write_aseprite(const ExportJob& job);
Result<Json> write_texture_packer(const ExportJob& job);
Result<Json> write_godot(const ExportJob& job);
// One moving picture a run, and runs.json:
Result<Json> write_apngs(const ExportJob& job);
Result<Json> write_gifs(const ExportJob& job);
Result<Json> write_webms(const ExportJob& job);
Result<Json> write_ffv1s(const ExportJob& job);

/// Ticks a second.
double fps_of(const SpriteData& data);
/// What was written, for --json: the runs' names where there are any, the folder.
Json export_report(const ExportJob& job, std::size_t samples,
                   std::optional<std::size_t> pages = std::nullopt);
/// Writes a JSON document into the job's folder. Errors: those of write_file.
Result<void> write_json(const ExportJob& job, const std::string& name, const Json& document);

}  // namespace vsprite
