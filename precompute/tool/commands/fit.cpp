// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// fit: drawn or photographed views -> puppets, in a pack of their own or in a work folder.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tool/commands/verbs.h"
#include "tool/files.h"
#include "tool/report.h"
#include "tool/views_file.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

// A pack needs samples: the drawn views themselves, one after the other in a ring.
SpriteData ring_of_views(const Puppet& puppet) {
  SpriteData data;
  data.name = puppet.name;
  const auto count = static_cast<std::uint32_t>(puppet.views.size());
  data.row_start.assign(1, 0);
  for (std::uint32_t v = 0; v < count; ++v) {
    const Image& picture = puppet.views[v].picture;
    Sample sample;
    sample.width = static_cast<std::uint16_t>(picture.width);
    sample.height = static_cast<std::uint16_t>(picture.height);
    sample.anchor = {static_cast<float>(picture.width) / 2, static_cast<float>(picture.height) / 2};
    sample.clip = v, sample.frame = v, sample.kept = 1;
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
      sample.area += static_cast<float>(picture.rgba[i]) / 255;
    data.body_length = std::max(
        {data.body_length, static_cast<float>(picture.width), static_cast<float>(picture.height)});
    data.samples.push_back(sample);
    data.transitions.push_back({(v + 1) % count, 0});
    data.row_start.push_back(v + 1);
  }
  ControlMode mode;
  mode.name = "paper";
  mode.table_of.fill(Direction::Rest);
  for (std::size_t t = 0; t < mode.tables(); ++t)
    for (std::uint32_t v = 0; v < count; ++v) mode.next.push_back((v + 1) % count);
  mode.go.assign(mode.next.size(), 0);
  data.modes.push_back(std::move(mode));
  return data;
}

Result<void> write_pack_of(const std::string& path, const std::vector<Puppet>& puppets) {
  const FrameSource frames = [&](std::uint32_t sample) -> Result<Image> {
    Image picture = puppets[0].views[sample].picture;
    unpremultiply(picture);
    return picture;
  };
  if (auto saved = save_pack(path, ring_of_views(puppets[0]), frames); !saved) return saved;
  return save_puppets(path, path, puppets);
}

Json puppet_json(const Puppet& puppet) {
  Json parameters = Json::array();
  for (const PuppetParameter& p : puppet.parameters)
    parameters.push_back(
        {{"name", p.name}, {"low", p.low}, {"high", p.high}, {"period", p.period}});
  return {{"name", puppet.name},          {"points", puppet.point_count()},
          {"faces", puppet.faces.size()}, {"views", puppet.views.size()},
          {"links", puppet.links.size()}, {"kernel", kernel_name(puppet.net.kernel)},
          {"parameters", parameters}};
}

}  // namespace

Result<int> run_fit(const Settings& settings, Console& console) {
  if (settings.film.empty())
    return Error{ErrorCode::BadSetting, "a file of views is due: VIEWS.toml"};
  if (settings.output.empty() && settings.work.empty())
    return Error{ErrorCode::BadSetting, "-o PACK or --work DIR is due"};
  const auto text = read_file(settings.film);
  if (!text) return text.error();
  const auto set = parse_views(*text, settings.film);
  if (!set) return set.error();
  const auto puppets = fit_puppets(*set);
  // A kernel without its degree stands in the file, not on the command line.
  if (!puppets) {
    const ErrorCode code = puppets.error().code;
    return Error{code == ErrorCode::BadSetting ? ErrorCode::BadContent : code,
                 settings.film + ": " + puppets.error().message};
  }

  if (!settings.output.empty())
    if (auto wrote = write_pack_of(settings.output, *puppets); !wrote) return wrote.error();
  if (!settings.work.empty()) {
    std::error_code error;
    if (!fs::is_directory(settings.work, error))
      return Error{ErrorCode::NotFound, settings.work + ": no such work folder"};
    const auto lock = FolderLock::take(settings.work);
    if (!lock) return lock.error();
    const auto bytes = encode_puppets(*puppets);
    if (!bytes) return bytes.error();
    const std::string_view view(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    if (auto wrote = write_file(settings.work + "/puppets.bin", view); !wrote) return wrote.error();
  }
  Json list = Json::array();
  std::string lines;
  for (const Puppet& puppet : *puppets) {
    list.push_back(puppet_json(puppet));
    lines += puppet.name + ": " + std::to_string(puppet.point_count()) + " control points, " +
             std::to_string(puppet.faces.size()) + " faces, " +
             std::to_string(puppet.views.size()) + " pictures, kernel " +
             std::string(kernel_name(puppet.net.kernel)) + "\n";
  }
  console.text(lines);
  console.document({{"puppets", list}});
  console.next(settings.output.empty() ? "vsprite pack --work " + shell_word(settings.work)
                                       : "vsprite info " + shell_word(settings.output));
  return 0;
}

}  // namespace vsprite
