// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tiny_pack FILE [N|acting] - writes the tiny sprite as a pack, for the tests that run whole
// programs; or a pack of N samples of 2 x 2 px that go right and round, for those of what many
// samples do; or the tiny sprite with actions.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "support/naive_actions.h"
#include "support/tiny_sprite.h"
#include "vsprite/pack.h"

namespace {

vsprite::SpriteData long_run(std::uint32_t n) {
  vsprite::SpriteData data = vsprite::testing::tiny_sprite_data();
  vsprite::Sample sample = data.samples[1];
  sample.width = sample.height = 2;
  sample.anchor = {1, 1};
  data.tags = {""};
  data.samples.assign(n, sample);
  data.row_start.assign(1, 0);
  data.transitions.clear();
  data.start_sample = 0;
  vsprite::ControlMode mode = data.modes[0];
  mode.stages = 1;
  mode.served = mode.served_headings = 1;
  mode.table_of.fill(vsprite::Direction::Right);
  std::vector<std::uint32_t> next;
  for (std::uint32_t i = 0; i < n; ++i) {
    data.samples[i].frame = i;
    if (i + 2 >= n) data.samples[i].skip_cost = std::numeric_limits<float>::infinity();
    const bool last = i + 1 == n;
    data.transitions.push_back({last ? 0 : i + 1, last ? 0.1f : 0.0f});
    data.row_start.push_back(i + 1);
    next.push_back(data.transitions.back().to);
  }
  mode.next.clear();
  for (std::size_t t = 0; t < mode.tables(); ++t)
    mode.next.insert(mode.next.end(), next.begin(), next.end());
  mode.go.assign(mode.next.size(), 0);
  data.modes.assign(1, mode);
  return data;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) return 2;
  const bool acts = argc == 3 && std::string_view(argv[2]) == "acting";
  const bool is_long = argc == 3 && !acts;
  const vsprite::SpriteData data = acts ? vsprite::testing::acting_sprite_data()
                                   : is_long
                                       ? long_run(static_cast<std::uint32_t>(std::atoi(argv[2])))
                                       : vsprite::testing::tiny_sprite_data();
  const auto picture = [&](std::uint32_t sample) -> vsprite::Result<vsprite::Image> {
    if (is_long) return vsprite::Image{2, 2, std::vector<std::uint8_t>(16, 200)};
    return vsprite::testing::tiny_picture(data, sample);
  };
  const vsprite::Result<void> saved = vsprite::save_pack(argv[1], data, picture);
  if (saved) return 0;
  std::fprintf(stderr, "%s\n", saved.error().message.c_str());
  return 1;
}
