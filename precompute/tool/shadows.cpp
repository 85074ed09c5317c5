// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/shadows.h"

#include <charconv>
#include <cmath>
#include <filesystem>

#include "tool/pictures.h"
#include "vsprite/sprite.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kColumns = "sample,width,height,anchor_x,anchor_y";
constexpr const char* kTable = "shadows.csv";

// One number and the comma or the line's end behind it.
template <class Number>
bool take_number(std::string_view& line, Number& value, bool is_last) {
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc{}) return false;
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  if (is_last) return line.empty();
  if (!line.starts_with(',')) return false;
  line.remove_prefix(1);
  return true;
}

bool parse_row(std::string_view line, ShadowRow& row) {
  return take_number(line, row.sample, false) && take_number(line, row.width, false) &&
         take_number(line, row.height, false) && take_number(line, row.anchor_x, false) &&
         take_number(line, row.anchor_y, true) && row.width > 0 && row.height > 0 &&
         std::isfinite(row.anchor_x) && std::isfinite(row.anchor_y);
}

}  // namespace

ShadowRow row_of(int sample, const CutShadow& shadow) {
  return {sample, shadow.image.width, shadow.image.height, shadow.anchor_x, shadow.anchor_y};
}

std::string shadow_path(const Project& project, int sample) {
  const fs::path sprite = project.sprite_path(sample);
  return project.path(kShadowFolder) + "/" + sprite.filename().string();
}

bool has_shadows(const Project& project) {
  std::error_code error;
  return fs::exists(project.path(kTable), error);
}

void remove_shadows(const Project& project) {
  std::error_code ignored;
  fs::remove(project.path(kTable), ignored);
  fs::remove_all(project.path(kShadowFolder), ignored);
}

Result<void> write_shadows(const Project& project, const std::vector<ShadowRow>& rows) {
  if (auto synced = sync_folder(project.path(kShadowFolder)); !synced) return synced;
  std::string out = std::string(kColumns) + "\n";
  for (const ShadowRow& row : rows)
    out += std::to_string(row.sample) + "," + std::to_string(row.width) + "," +
           std::to_string(row.height) + "," + number_text(row.anchor_x) + "," +
           number_text(row.anchor_y) + "\n";
  return write_file(project.path(kTable), out);
}

Result<std::vector<ShadowRow>> read_shadows(const Project& project) {
  std::vector<ShadowRow> rows;
  if (!has_shadows(project)) return rows;
  const std::string path = project.path(kTable);
  const auto text = read_file(path);
  if (!text) return text.error();
  int number = 0;
  for (std::size_t begin = 0; begin < text->size();) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    std::string_view line(text->data() + begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);  // saved by a spreadsheet
    begin = end + 1;
    const auto wrong = [&](const std::string& due) {
      return Error{ErrorCode::CorruptData, path + ":" + std::to_string(number) + ": " + due};
    };
    if (++number == 1) {
      if (line != kColumns)
        return wrong("the first line must name the columns " + std::string(kColumns));
      continue;
    }
    if (line.empty()) continue;
    ShadowRow row;
    if (!parse_row(line, row))
      return wrong("`" + std::string(line) +
                   "` where five numbers are due: " + std::string(kColumns));
    if (row.sample < 0 || (!rows.empty() && row.sample <= rows.back().sample))
      return wrong("sample " + std::to_string(row.sample) + ": samples must ascend");
    rows.push_back(row);
  }
  return rows;
}

Result<Image> read_shadow(const Project& project, const ShadowRow& row) {
  const std::string path = shadow_path(project, row.sample);
  auto image = read_png(path);
  if (!image) {
    const bool missing = image.error().code == ErrorCode::NotFound;
    return missing ? Error{ErrorCode::CorruptData, image.error().message} : image.error();
  }
  if (image->width == row.width && image->height == row.height) return image;
  const auto size = [](int w, int h) { return std::to_string(w) + "x" + std::to_string(h); };
  return Error{ErrorCode::CorruptData,
               path + ": " + size(image->width, image->height) + " px where shadows.csv says " +
                   size(row.width, row.height) + ": keep the size when retouching"};
}

Result<std::string> shadows_sum(const Project& project) {
  const auto rows = read_shadows(project);
  if (!rows) return rows.error();
  const auto table = hash_file(project.path(kTable));
  if (!table) return table.error();
  std::string sums = hex64(*table);
  for (const ShadowRow& row : *rows) {
    const std::string path = shadow_path(project, row.sample);
    const auto sum = hash_file(path);
    if (!sum && sum.error().code == ErrorCode::NotFound)
      return Error{ErrorCode::CorruptData,
                   path + ": the shadow of sample " + std::to_string(row.sample) +
                       " is missing: take its line out of shadows.csv, or `vsprite segment --force "
                       "segment` cuts all anew"};
    if (!sum) return sum.error();
    sums += hex64(*sum);
  }
  return hex64(hash_bytes(sums));
}

Result<void> add_shadows(const Project& project, const std::vector<SampleRow>& rows,
                         SpriteData& data) {
  const auto shadows = read_shadows(project);
  if (!shadows) return shadows.error();
  std::vector<const ShadowRow*> of(rows.size(), nullptr);
  for (const ShadowRow& shadow : *shadows)
    if (static_cast<std::size_t>(shadow.sample) < of.size())
      of[static_cast<std::size_t>(shadow.sample)] = &shadow;
  data.shadow_scale = kShadowScale;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int mirror_of = rows[i].mirror_of;
    const ShadowRow* shadow = of[mirror_of < 0 ? i : static_cast<std::size_t>(mirror_of)];
    if (shadow == nullptr || data.samples[i].kept == 0) continue;
    auto image = read_shadow(project, *shadow);
    if (!image) return image.error();
    Vec2 anchor{static_cast<float>(shadow->anchor_x), static_cast<float>(shadow->anchor_y)};
    if (mirror_of >= 0) {
      flip(*image);
      anchor.x = static_cast<float>(image->width) - anchor.x;
    }
    if (auto added = add_shadow(data, static_cast<std::uint32_t>(i), *image, anchor); !added)
      return added;
  }
  return {};
}

}  // namespace vsprite
