// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/pictures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vsprite {
namespace {

constexpr int kBatch = 64;

int image_side(double film_side, double scale) {
  return static_cast<int>(std::lround(film_side * scale));
}

}  // namespace

void flip(Image& image) {
  for (int y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<std::array<std::uint8_t, 4>*>(image.rgba.data()) +
                static_cast<std::ptrdiff_t>(y) * image.width;
    std::reverse(row, row + image.width);
  }
}

// A mirrored sample has no picture of its own.
Result<Image> read_sprite(const Project& project, const SampleRow& row) {
  const bool mirrored = row.mirror_of >= 0;
  const std::string path = project.sprite_path(mirrored ? row.mirror_of : row.sample);
  Result<Image> image = read_png(path);
  if (!image) {
    // A picture that samples.csv names is content of the folder, not the user's operand.
    const bool missing = image.error().code == ErrorCode::NotFound;
    return missing ? Error{ErrorCode::CorruptData, image.error().message} : image.error();
  }
  const int width = image_side(row.width, row.scale), height = image_side(row.height, row.scale);
  if (image->width == width && image->height == height) {
    if (mirrored) flip(*image);
    return image;
  }
  const auto size = [](int w, int h) { return std::to_string(w) + "x" + std::to_string(h); };
  return Error{ErrorCode::CorruptData, path + ": " + size(image->width, image->height) +
                                           " px where samples.csv says " + size(width, height) +
                                           ": keep the size when retouching"};
}

PictureReader::PictureReader(const Project& project, const std::vector<SampleRow>& rows)
    : project_(project), rows_(rows) {}

void PictureReader::read_batch(int first) {
  const int count = std::min<int>(kBatch, static_cast<int>(rows_.size()) - first);
  first_ = first;
  batch_.assign(static_cast<std::size_t>(count), Result<Image>(Image{}));
  tbb::parallel_for(0, count, [&](int i) {
    batch_[static_cast<std::size_t>(i)] =
        read_sprite(project_, rows_[static_cast<std::size_t>(first + i)]);
  });
}

Result<Image> PictureReader::picture(int sample) {
  if (sample < first_ || sample >= first_ + static_cast<int>(batch_.size())) read_batch(sample);
  return std::move(batch_[static_cast<std::size_t>(sample - first_)]);
}

OpaqueBox opaque_box(const Image& picture) noexcept {
  OpaqueBox box{picture.width, picture.height, 0, 0};
  for (int y = 0; y < picture.height; ++y) {
    const std::uint8_t* row =
        picture.rgba.data() + static_cast<std::ptrdiff_t>(y) * picture.width * 4;
    for (int x = 0; x < picture.width; ++x) {
      if (row[4 * x + 3] < 128) continue;
      box.left = std::min(box.left, x), box.right = std::max(box.right, x + 1);
      box.top = std::min(box.top, y), box.bottom = std::max(box.bottom, y + 1);
    }
  }
  return box.right == 0 ? OpaqueBox{} : box;
}

FeatureScale trained_scale(const Project& project) {
  const Json* record = project.record("train");
  if (record == nullptr || !record->contains("settings")) return FeatureScale::Raw;
  return feature_scale((*record)["settings"].value("features", "raw"));
}

FeatureScale feature_scale(std::string_view name) noexcept {
  return name == "per-area" ? FeatureScale::PerArea : FeatureScale::Raw;
}

Result<LoadedSprites> load_sprites(const Project& project) {
  const auto rows = project.samples();
  if (!rows) return rows.error();
  const auto film = project.film();
  if (!film) return film.error();
  LoadedSprites loaded;
  std::optional<Error> fault;
  PictureReader reader(project, *rows);
  const auto next = [&](int sample) {
    Result<Image> picture = fault ? Result<Image>(*fault) : reader.picture(sample);
    if (!picture) {
      fault = picture.error();  // the rest is blank and thrown away
      picture = Image{1, 1, {0, 0, 0, 0}};
    }
    loaded.boxes.push_back(opaque_box(*picture));
    return std::move(*picture);
  };
  loaded.features = make_feature_set(*rows, film->fps(), FeatureSet{}.grid, next);
  if (fault) return *fault;
  loaded.features.scale = trained_scale(project);
  return loaded;
}

}  // namespace vsprite
