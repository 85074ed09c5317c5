// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/cast_file.h"

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "film/source.h"
#include "tool/files.h"
#include "tool/settings.h"
#include "tool/work_files.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostClips = 1000, kLongestTag = 64, kMostEvents = 100000;
constexpr double kFastest = 1e6, kFarthest = 1e5;

bool fits_tag(const std::string& tag) {
  return tag.size() <= kLongestTag && std::all_of(tag.begin(), tag.end(), [](unsigned char c) {
           return c > 0x20 && c != 0x7f && c != '"' && c != ',';
         });
}

/// One table of the file; the first fault that it meets is the one that is told.
class Table {
 public:
  Table(const toml::table& table, std::string path, std::vector<std::string> known)
      : table_(table), path_(std::move(path)) {
    for (const auto& [key, node] : table) {
      const std::string name(key.str());
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      const std::string near = nearest_name(name, known);
      fail(key.source(),
           "unknown key `" + name + "`" +
               (near.empty() ? "; due are " + listed(known) : "; did you mean `" + near + "`?"));
    }
  }

  void text(const char* name, std::string& value) {
    if (const toml::node* node = table_.get(name)) {
      const auto found = node->value_exact<std::string>();
      found ? void(value = *found) : due(*node, name, "a text in quotes");
    }
  }
  /// True where it stands there.
  bool flag(const char* name, bool& value) {
    const toml::node* node = table_.get(name);
    if (!node) return false;
    const auto found = node->value_exact<bool>();
    found ? void(value = *found) : due(*node, name, "true or false");
    return true;
  }
  void number(const char* name, double low, double high, double& value) {
    const toml::node* node = table_.get(name);
    if (!node) return;
    const auto found = node->value<double>();
    if (found && *found >= low && *found <= high)
      value = *found;
    else
      due(*node, name, "a number from " + number_text(low) + " to " + number_text(high));
  }
  /// N numbers, `low` <= each <= `high`; false where there are none.
  template <std::size_t N>
  bool numbers(const char* name, double low, double high, bool whole, const std::string& what,
               std::array<double, N>& values) {
    const toml::node* node = table_.get(name);
    if (!node) return false;
    const toml::array* array = node->as_array();
    bool fits = array && array->size() == N;
    for (std::size_t k = 0; fits && k < N; ++k) {
      const auto found = array->get(k)->value<double>();
      fits = found && *found >= low && *found <= high && (!whole || std::floor(*found) == *found);
      if (fits) values[k] = *found;
    }
    if (!fits) due(*node, name, what);
    return true;
  }
  /// Tables of a frame within first..last and a name.
  void events(const char* name, int first, int last, std::vector<CastEvent>& values) {
    const toml::node* node = table_.get(name);
    if (!node) return;
    const toml::array* array = node->as_array();
    bool fits = array != nullptr && array->size() <= kMostEvents;
    for (std::size_t k = 0; fits && k < array->size(); ++k) {
      const toml::table* entry = array->get(k)->as_table();
      const auto frame = entry ? (*entry)["frame"].value_exact<std::int64_t>() : std::nullopt;
      const auto text = entry ? (*entry)["name"].value_exact<std::string>() : std::nullopt;
      fits = frame && text && entry->size() == 2 && *frame >= first && *frame <= last &&
             !text->empty() && fits_tag(*text);
      if (fits) values.push_back({static_cast<int>(*frame), *text, place(entry->source())});
    }
    if (!fits)
      due(*node, name,
          "a list of frames of the clip, each with a name without spaces, such as [{ frame = 31, "
          "name = \"step\" }],");
  }
  void due(const toml::node& node, const char* name, const std::string& what) {
    fail(node.source(), std::string(name) + ": " + what + " is due");
  }
  void fail(const std::string& name, const std::string& what) {
    const toml::node* node = table_.get(name);
    fail(node ? node->source() : table_.source(), what);
  }
  void fail(const toml::source_region& at, const std::string& what) {
    if (problem_.empty()) problem_ = place(at) + ": " + what;
  }
  const std::string& problem() const { return problem_; }

 private:
  std::string place(const toml::source_region& at) const {
    return path_ + ":" + std::to_string(at.begin.line) + ":" + std::to_string(at.begin.column);
  }
  static std::string listed(const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
    return out;
  }
  const toml::table& table_;
  std::string path_, problem_;
};

void check_setting(Table& table, const char* name, const std::string& value) {
  Settings scratch;
  if (value.empty()) return;
  if (auto set = find_option(name)->set(scratch, value); !set)
    table.fail(name, set.error().message);
}

CastClip read_clip(Table& table, const fs::path& folder, bool match) {
  CastClip clip;
  clip.match = match;
  table.text("file", clip.file);
  table.text("tag", clip.tag);
  table.text("key", clip.key);
  table.text("subject", clip.subject);
  table.text("matte", clip.matte);
  table.number("fps", 1, 1000, clip.fps);
  table.flag("match", clip.match);
  bool mirror = false;
  if (table.flag("mirror", mirror)) clip.mirror = mirror;
  std::array<double, 2> pair{};
  if (table.numbers("velocity", -kFastest, kFastest, false,
                    "two numbers, px/s to the right and down, such as [140, 0]", pair))
    clip.velocity = pair;
  std::array<double, 4> body{};
  constexpr const char* kBody =
      "left, top, right and bottom, px from the anchor, such as [-18, -60, 18, 0],";
  if (table.numbers("body", -kFarthest, kFarthest, false, kBody, body)) {
    clip.body = body;
    if (body[0] > body[2] || body[1] > body[3])
      table.fail("body",
                 "body: its right end lies left of its left one, or its bottom above its top");
  }
  constexpr const char* kFrames =
      "the first and the last film frame, whole numbers from 0 upwards, such as [12, 107]";
  if (table.numbers("frames", 0, 1e9, true, kFrames, pair)) {
    clip.first = static_cast<int>(pair[0]), clip.last = static_cast<int>(pair[1]);
    if (clip.last < clip.first)
      table.fail("frames", "frames: the last, " + std::to_string(clip.last) +
                               ", comes before the first, " + std::to_string(clip.first));
  }
  table.events("events", clip.first, clip.last, clip.events);
  if (clip.file.empty()) table.fail("file", "a clip without a file: `file = \"walk.mp4\"` is due");
  if (is_cast_file(clip.file))
    table.fail("file", "file: a film is due, " + clip.file + " is a cast");
  if (!fits_tag(clip.tag))
    table.fail("tag",
               "tag: up to 64 letters, digits and signs without spaces are due, such as "
               "\"walk\" or \"jump.start\"");
  check_setting(table, "key", clip.key);
  check_setting(table, "subject", clip.subject);
  clip.path = (folder / clip.file).string();
  if (!clip.matte.empty()) clip.matte = (folder / clip.matte).string();
  return clip;
}

}  // namespace

bool is_cast_file(const std::string& path) { return fs::path(path).extension() == ".toml"; }

Result<std::vector<CastClip>> parse_cast(const std::string& text, const std::string& path) {
  const toml::parse_result parsed = toml::parse(text);
  if (!parsed) {
    const auto& at = parsed.error().source().begin;
    return Error{ErrorCode::BadContent,
                 path + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) +
                     ": not TOML: " + std::string(parsed.error().description())};
  }
  const toml::table& root = parsed.table();
  Table head(root, path, {"match", "clip"});
  bool match = true;
  head.flag("match", match);
  const toml::array* list = root.get("clip") ? root.get("clip")->as_array() : nullptr;
  const bool tables = list && !list->empty() && list->size() <= kMostClips &&
                      std::all_of(list->begin(), list->end(),
                                  [](const toml::node& node) { return node.is_table(); });
  if (head.problem().empty() && !tables)
    return Error{ErrorCode::BadContent, path + ": a cast lists its clips, 1 to " +
                                            std::to_string(kMostClips) +
                                            ": `[[clip]]`, below it `file = \"walk.mp4\"`"};
  if (!head.problem().empty()) return Error{ErrorCode::BadContent, head.problem()};
  std::vector<CastClip> clips;
  for (const toml::node& node : *list) {
    Table table(*node.as_table(), path,
                {"file", "frames", "tag", "key", "subject", "mirror", "velocity", "body", "match",
                 "matte", "fps", "events"});
    clips.push_back(read_clip(table, fs::path(path).parent_path(), match));
    const CastClip& last = clips.back();
    for (const CastClip& clip : clips)
      if (last.body && clip.body && clip.tag == last.tag && *clip.body != *last.body)
        table.fail("body", "body: another clip of the tag `" + last.tag + "` has another one");
    if (!table.problem().empty()) return Error{ErrorCode::BadContent, table.problem()};
    std::error_code error;
    for (const std::string& file : {clips.back().path, clips.back().matte})
      if (!file.empty() && !fs::exists(file, error) && !is_picture_source(file))
        return Error{ErrorCode::NotFound, file + ": no such file; " + path + ":" +
                                              std::to_string(node.source().begin.line) +
                                              " names it"};
  }
  return clips;
}

bool is_cast(const std::string& path) {
  if (is_cast_file(path)) return true;
  if (!is_film_folder(path)) return false;
  const auto clips = find_clips(path);
  return clips && clips->front() != path;
}

Result<std::vector<CastClip>> read_cast(const std::string& path) {
  if (!is_cast_file(path)) {
    const auto files = find_clips(path);
    if (!files) return files.error();
    std::vector<CastClip> clips;
    for (const std::string& file : *files) {
      CastClip clip;
      clip.file = fs::path(file).filename().string();
      clip.path = file;
      clip.match = false;
      clips.push_back(std::move(clip));
    }
    return clips;
  }
  const auto text = read_file(path);
  if (!text) return text.error();
  return parse_cast(*text, path);
}

}  // namespace vsprite
