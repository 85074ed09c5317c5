// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/project.h"

#include <algorithm>
#include <filesystem>

namespace vsprite {
namespace {

namespace fs = std::filesystem;

/// Listens to a parse only for the place where it stops.
struct FaultFinder : nlohmann::json_sax<Json> {
  std::size_t at = 0;
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(string_t&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception&) override {
    at = position;
    return false;
  }
};

std::string line_and_column(const std::string& text, std::size_t at) {
  const std::string_view before = std::string_view(text).substr(0, at > 0 ? at - 1 : 0);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto newline = before.rfind('\n');
  const std::size_t column =
      before.size() - (newline == std::string_view::npos ? 0 : newline + 1) + 1;
  return std::to_string(line) + ":" + std::to_string(column);
}

Error not_segmented(const std::string& folder) {
  return {ErrorCode::NotFound,
          folder + ": no film has been segmented here: run `vsprite segment FILM --work " + folder +
              "`"};
}

std::string with_extension(const std::string& path, const char* extension) {
  return fs::path(path).replace_extension(extension).string();
}

std::string without_trailing_slash(std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  return path;
}

}  // namespace

Result<Project> Project::open(const std::string& folder, bool create) {
  Project project;
  project.folder_ = folder;
  std::error_code error;
  if (!create && !fs::is_directory(folder, error)) return not_segmented(folder);
  if (create) {
    if (fs::exists(folder, error) && !fs::is_directory(folder, error))
      return Error{ErrorCode::CannotCreate,
                   folder + ": a file stands where the work folder is due"};
    if (auto made = make_folder(folder); !made) return made.error();
  }
  auto lock = FolderLock::take(folder);
  if (!lock) return lock.error();
  project.lock_ = std::move(*lock);
  for (const char* sub : {"", "/sprites", "/keyed", "/pairs"})
    remove_stale_temporaries(folder + sub);
  if (auto read = project.read_manifest(); !read) return read.error();
  return project;
}

Result<Project> Project::look(const std::string& folder) {
  Project project;
  project.folder_ = folder;
  std::error_code error;
  if (!fs::is_directory(folder, error)) return not_segmented(folder);
  if (auto read = project.read_manifest(); !read) return read.error();
  return project;
}

Result<void> Project::read_manifest() {
  const std::string name = path("manifest.json");
  const auto text = read_file(name);
  if (!text && text.error().code == ErrorCode::NotFound) return {};
  if (!text) return text.error();
  manifest_ = Json::parse(*text, nullptr, false);
  const bool fits =
      manifest_.is_object() && (!manifest_.contains("stages") || manifest_["stages"].is_object());
  if (fits) return {};
  FaultFinder finder;
  Json::sax_parse(*text, &finder);
  return Error{ErrorCode::CorruptData, name + ":" + line_and_column(*text, finder.at) +
                                           ": damaged: delete it, and the stages run again"};
}

Result<void> Project::write_manifest() const {
  return write_file(path("manifest.json"), manifest_.dump(2) + "\n");
}

std::string Project::sprite_path(int sample) const {
  std::string digits = std::to_string(sample);
  if (digits.size() < 6) digits.insert(0, 6 - digits.size(), '0');
  return path("sprites/" + digits + ".png");
}

const Json* Project::record(const std::string& stage) const {
  const auto stages = manifest_.find("stages");
  if (stages == manifest_.end()) return nullptr;
  const auto found = stages->find(stage);
  return found == stages->end() || !found->is_object() ? nullptr : &*found;
}

bool Project::is_current(const StageKey& key) const {
  const Json* found = record(key.name);
  return found != nullptr && found->value("tool", Json()) == kToolVersion &&
         found->value("settings", Json()) == key.settings &&
         found->value("inputs", Json()) == key.inputs;
}

Result<void> Project::begin_stage(const std::string& stage) {
  if (record(stage) == nullptr) return {};
  manifest_["stages"].erase(stage);
  return write_manifest();
}

Result<void> Project::finish_stage(const StageKey& key, const std::string& output,
                                   const Json& result) {
  const Json entry = {{"tool", kToolVersion},
                      {"settings", key.settings},
                      {"inputs", key.inputs},
                      {"output", output},
                      {"result", result}};
  // Records stand in pipeline order, whatever order they were made in.
  Json stages = Json::object();
  for (const char* stage : kStages) {
    if (key.name == stage)
      stages[stage] = entry;
    else if (const Json* kept = record(stage))
      stages[stage] = *kept;
  }
  manifest_["format"] = 1;
  manifest_["stages"] = std::move(stages);
  return write_manifest();
}

Result<FilmFacts> Project::film() const {
  const Json* segment = record("segment");
  if (segment == nullptr) return not_segmented(folder_);
  Json result = segment->value("result", Json());
  if (!result.is_object()) result = Json::object();
  const Json fps = result.value("fps", Json::array());
  const bool fits = fps.is_array() && fps.size() == 2 && fps[0].is_number_unsigned() &&
                    fps[1].is_number_unsigned() && fps[0] > 0 && fps[1] > 0 &&
                    result.value("film", Json()).is_string();
  if (!fits)
    return Error{ErrorCode::CorruptData,
                 path("manifest.json") +
                     ": stages.segment.result names no film and frame rate: delete "
                     "the file, and the stages run again"};
  return FilmFacts{result["film"], fps[0], fps[1]};
}

Result<std::vector<SampleRow>> Project::samples() const {
  const auto text = read_file(path("samples.csv"));
  if (!text && text.error().code == ErrorCode::NotFound) return not_segmented(folder_);
  if (!text) return text.error();
  return parse_samples(*text, path("samples.csv"));
}

Result<Classifier> Project::classifier() const {
  const auto text = read_file(path("classifier.toml"));
  if (!text && text.error().code == ErrorCode::NotFound)
    return Error{
        ErrorCode::NotFound,
        path("classifier.toml") + ": no such file: run `vsprite train --work " + folder_ + "`"};
  if (!text) return text.error();
  return parse_classifier(*text, path("classifier.toml"));
}

Result<TransitionFile> Project::transitions(std::size_t samples) const {
  const auto bytes = read_file(path("transitions.bin"));
  if (!bytes && bytes.error().code == ErrorCode::NotFound)
    return Error{ErrorCode::NotFound, path("transitions.bin") +
                                          ": no such file: run `vsprite transitions --work " +
                                          folder_ + "`"};
  if (!bytes) return bytes.error();
  return parse_transitions(*bytes, path("transitions.bin"), samples);
}

Result<ValueFile> Project::values(std::size_t samples) const {
  const auto bytes = read_file(path("values.bin"));
  if (!bytes && bytes.error().code == ErrorCode::NotFound)
    return Error{ErrorCode::NotFound,
                 path("values.bin") + ": no such file: run `vsprite solve --work " + folder_ + "`"};
  if (!bytes) return bytes.error();
  return parse_values(*bytes, path("values.bin"), samples);
}

Result<std::string> Project::sprites_sum() const {
  const auto rows = samples();
  if (!rows) return rows.error();
  const auto table = hash_file(path("samples.csv"));
  if (!table) return table.error();
  std::string sums = hex64(*table);
  for (const SampleRow& row : *rows) {
    if (row.mirror_of >= 0) continue;
    const auto sum = hash_file(sprite_path(row.sample));
    if (!sum && sum.error().code == ErrorCode::NotFound)
      return Error{ErrorCode::CorruptData,
                   sprite_path(row.sample) + ": the picture of sample " +
                       std::to_string(row.sample) +
                       " is missing: `vsprite segment FILM --force segment` cuts all anew"};
    if (!sum) return sum.error();
    sums += hex64(*sum);
  }
  return hex64(hash_bytes(sums));
}

Result<std::string> Project::file_sum(const std::string& name) const {
  const auto sum = hash_file(path(name));
  if (!sum) return sum.error();
  return hex64(*sum);
}

std::string find_work_folder(const std::string& work, const std::string& operand,
                             const std::string& output) {
  if (!work.empty()) return without_trailing_slash(work);
  if (!output.empty()) return with_extension(output, ".work");
  const std::string name = without_trailing_slash(operand);
  std::error_code error;
  if (fs::is_directory(name, error) && !is_film_folder(name)) return name;
  if (fs::path(name).extension() == ".vsp") return with_extension(name, ".work");
  return fs::path(name).stem().string() + ".work";
}

std::string find_pack_path(const std::string& work_folder, const std::string& operand,
                           const std::string& output) {
  if (!output.empty()) return output;
  std::error_code error;
  const std::string name = without_trailing_slash(operand);
  if (fs::path(name).extension() == ".vsp") return name;
  if (!name.empty() && !fs::is_directory(name, error))
    return fs::path(name).stem().string() + ".vsp";
  return with_extension(work_folder, ".vsp");
}

}  // namespace vsprite
