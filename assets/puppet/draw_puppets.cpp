// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// draw_puppets FOLDER: writes the drawings and their VIEWS.toml files, for `vsprite fit`.
// draw_puppets PACK.vsp: fits them all, for games/puppet.
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "puppet/art.h"
#include "tool/views_file.h"
#include "vsprite/exit_code.h"

namespace {

using namespace vsprite;

std::string list(const std::vector<Vec2>& points) {
  std::string out = "[";
  char text[64];
  for (const Vec2 p : points) {
    std::snprintf(text, sizeof text, "%s[%.2f, %.2f]", out.size() > 1 ? ", " : "", double{p.x},
                  double{p.y});
    out += text;
  }
  return out + "]";
}

template <class T>
std::string list(const std::vector<T>& numbers) {
  std::string out = "[";
  char text[64];
  for (const T n : numbers) {
    std::snprintf(text, sizeof text, "%s%.9g", out.size() > 1 ? ", " : "", static_cast<double>(n));
    out += text;
  }
  return out + "]";
}

bool write_png(const std::filesystem::path& path, const Image& picture) {
  const auto bytes = encode_png(picture);
  std::ofstream file(path, std::ios::binary);
  if (bytes)
    file.write(reinterpret_cast<const char*>(bytes->data()),
               static_cast<std::streamsize>(bytes->size()));
  return bytes && file.good();
}

bool write_view(const std::filesystem::path& folder, std::ofstream& toml, const View& view) {
  if (view.picture.width > 0) {
    toml << "file = \"" << view.name << "\"\n";
    if (!write_png(folder / view.name, view.picture)) return false;
  }
  toml << "points = " << list(view.points) << "\n";
  if (!view.texture_points.empty())
    toml << "texture_points = " << list(view.texture_points) << "\n";
  return true;
}

bool write_set(const std::filesystem::path& folder, const ViewSet& set) {
  std::ofstream toml(folder / (set.name + ".toml"));
  toml << "name = \"" << set.name << "\"\n";
  if (set.allow_folds) toml << "allow_folds = true\n";
  if (!set.depth.empty()) toml << "depth = " << list(set.depth) << "\n";
  for (const std::uint32_t corners : {3u, 4u}) {
    std::string rows;
    for (const Face& face : set.faces) {
      if (face.count != corners) continue;
      std::vector<double> row;
      for (std::uint32_t c = 0; c < corners; ++c) row.push_back(face.corners[c] + 1);
      rows += (rows.empty() ? "" : ", ") + list(row);
    }
    if (!rows.empty()) toml << (corners == 3 ? "triangles" : "quads") << " = [" << rows << "]\n";
  }
  for (const PuppetParameter& p : set.parameters)
    toml << "\n[[parameter]]\nname = \"" << p.name << "\"\nlow = " << p.low << "\nhigh = " << p.high
         << "\nperiod = " << p.period << "\n";
  for (const View& view : set.views) {
    toml << "\n[[view]]\n";
    if (!view.at.empty()) toml << "at = " << list(view.at) << "\n";
    if (!write_view(folder, toml, view)) return false;
  }
  for (const LinkMark& link : set.links) {
    toml << "\n[[link]]\nname = \"" << link.name << "\"\nfirst = " << link.first + 1
         << "\nlast = " << link.first + link.count << "\npivot = " << link.pivot + 1
         << "\nend = " << link.end + 1 << "\n";
    if (link.parent >= 0)
      toml << "parent = \"" << set.links[static_cast<std::size_t>(link.parent)].name << "\"\n";
  }
  for (const Character& c : set.characters) {
    toml << "\n[[character]]\nname = \"" << c.name << "\"\nlike = " << c.like + 1
         << "\nmodulate = " << (c.modulate ? "true" : "false") << "\n";
    if (!write_view(folder, toml, c.view)) return false;
  }
  return toml.good();
}

std::array<ViewSet, 4> all_sets() {
  return {puppet_art::face_views(), puppet_art::walk_views(), puppet_art::jump_views(),
          puppet_art::arm_views()};
}

Result<void> write_pack(const std::string& path) {
  std::vector<Puppet> all;
  for (const ViewSet& set : all_sets()) {
    auto puppets = fit_puppets(set);
    if (!puppets) return puppets.error();
    for (Puppet& puppet : *puppets) all.push_back(std::move(puppet));
  }
  return save_puppet_pack(path, all);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: draw_puppets FOLDER|PACK.vsp\n", stderr);
    return 2;
  }
  const std::filesystem::path folder(argv[1]);
  if (folder.extension() == ".vsp") {
    const auto wrote = write_pack(folder.string());
    if (!wrote) std::fprintf(stderr, "draw_puppets: error: %s\n", wrote.error().message.c_str());
    return wrote ? 0 : exit_code(wrote.error().code);
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  for (const ViewSet& set : all_sets())
    if (!write_set(folder, set)) {
      std::fprintf(stderr, "draw_puppets: error: %s cannot be written\n", argv[1]);
      return 74;
    }
  return 0;
}
