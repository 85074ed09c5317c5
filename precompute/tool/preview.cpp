// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/preview.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "film/contact.h"
#include "film/matte.h"
#include "film/plate.h"
#include "film/video.h"
#include "tool/files.h"

namespace vsprite {
namespace {

Json row_of(const KeyedFrame& keyed) {
  Json row = {{"frame", keyed.index}, {"parts", keyed.blobs.size()}};
  if (keyed.blobs.empty()) return row;
  const Blob& blob = keyed.blobs[0];
  row["area"] = blob.area;
  row["x"] = blob.anchor_x;
  row["y"] = blob.anchor_y;
  row["cut_by_border"] = blob.touches_border;
  return row;
}

}  // namespace

Result<Image> background_of(const Settings& settings) {
  if (settings.background.starts_with("#")) {
    const auto color = parse_key(settings.background);
    if (!color) return color.error();
    return Image{1, 1, {color->red, color->green, color->blue, 255}};
  }
  return read_png(settings.background);
}

Result<Json> preview_film(const Settings& settings, const std::string& film,
                          const std::string& output) {
  const auto key = parse_key(settings.key);
  if (!key) return key.error();
  const auto matte = matte_of(settings);
  if (!matte) return matte.error();
  ContactConfig config;
  config.overview = true;
  auto background = background_of(settings);
  if (!background) return background.error();
  config.background = std::move(*background);
  auto sampled =
      sample_frames(source_of(settings, film), std::max(key->sample_count, settings.preview));
  if (!sampled) return sampled.error();
  const auto screen = measure_screen(*sampled, *key);
  if (!screen) return Error{screen.error().code, film + ": " + screen.error().message};

  const std::size_t count = std::min(static_cast<std::size_t>(settings.preview), sampled->size());
  std::vector<Frame> frames;
  for (std::size_t k = 0; k < count; ++k)
    frames.push_back(std::move((*sampled)[(2 * k + 1) * sampled->size() / (2 * count)]));
  std::vector<KeyedFrame> keyed(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
    keyed[k] = Keyer(*screen, *matte).key(frames[k], nullptr);
  });
  const auto png = encode_png(make_contact_sheet(frames, keyed, config));
  if (!png) return png.error();
  if (auto wrote = write_file(output, {reinterpret_cast<const char*>(png->data()), png->size()});
      !wrote)
    return wrote.error();
  Json rows = Json::array();
  for (const KeyedFrame& frame : keyed) rows.push_back(row_of(frame));
  return Json{
      {"film", film}, {"background", screen->reason}, {"sheet", output}, {"rows", std::move(rows)}};
}

}  // namespace vsprite
