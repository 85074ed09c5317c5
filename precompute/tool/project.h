// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/project.h - the work folder: what each stage made, from what, and whether it still holds.
//
//     sprites/000123.png  samples.csv  classifier.toml  transitions.bin  values.bin  manifest.json
//
// A stage's record in manifest.json names its settings, the XXH3-64 sums of its inputs and of what
// it made. A stage is skipped when settings, inputs and tool version are those of its record.
// Before a stage writes anything its record is taken out of the manifest, and it is put back last:
// a build that was killed anywhere goes on from the last finished stage, or chunk of frames.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "film/extract.h"
#include "tool/files.h"
#include "tool/work_files.h"
#include "vsprite/result.h"

namespace vsprite {

using Json = nlohmann::ordered_json;

/// Pipeline order.
inline constexpr const char* kStages[] = {"segment", "train", "transitions", "solve", "pack"};

/// What a stage depends on.
struct StageKey {
  std::string name;
  Json settings = Json::object();
  Json inputs = Json::object();  ///< name -> sum
};

/// What the manifest says about the film.
struct FilmFacts {
  std::string name;  ///< file name without folders
  std::uint32_t fps_numerator = 30, fps_denominator = 1;
  double fps() const noexcept { return static_cast<double>(fps_numerator) / fps_denominator; }
};

class Project {
 public:
  /// Takes the lock, removes what killed processes left, reads the manifest. `create` makes the
  /// folder. Errors: NotFound, CannotCreate, InUse, CorruptData (manifest.json, with line and
  /// column).
  static Result<Project> open(const std::string& folder, bool create);
  /// Reads without a lock and removes nothing: for verbs that only look.
  static Result<Project> look(const std::string& folder);

  const std::string& folder() const noexcept { return folder_; }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string sprite_path(int sample) const;

  /// The record of a finished stage, or null.
  const Json* record(const std::string& stage) const;
  /// True where the record fits `key`.
  bool is_current(const StageKey& key) const;
  /// Takes the record out. Errors: CannotWrite.
  Result<void> begin_stage(const std::string& stage);
  /// Puts the record in. `output`: sum of what the stage made; `result`: its figures.
  Result<void> finish_stage(const StageKey& key, const std::string& output, const Json& result);

  /// Errors: NotFound (no stage `segment` has finished here), CorruptData.
  Result<FilmFacts> film() const;
  Result<std::vector<SampleRow>> samples() const;
  Result<Classifier> classifier() const;
  Result<TransitionFile> transitions(std::size_t samples) const;
  Result<ValueFile> values(std::size_t samples) const;

  /// Sum over samples.csv and the content of every picture that it names.
  /// Errors: NotFound (names the missing picture), CannotRead, CorruptData.
  Result<std::string> sprites_sum() const;
  /// Sum of one file of the folder. Errors: NotFound, CannotRead.
  Result<std::string> file_sum(const std::string& name) const;

 private:
  Result<void> read_manifest();
  Result<void> write_manifest() const;

  std::string folder_;
  FolderLock lock_;
  Json manifest_ = Json::object();
};

/// Where the work folder is: `work` if given; a folder itself; for `x.vsp` its `x.work`; for a film
/// the folder that `build` without -o would use.
std::string find_work_folder(const std::string& work, const std::string& operand,
                             const std::string& output);
/// The pack that belongs to a work folder or film: `output` if given.
std::string find_pack_path(const std::string& work_folder, const std::string& operand,
                           const std::string& output);

/// XXH3-64 of the settings and the tool's version.
inline constexpr const char* kToolVersion = "0.1.0";

}  // namespace vsprite
