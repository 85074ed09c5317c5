// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tiny_pack FILE [N|acting] - writes the tiny sprite as a pack, for the tests that run whole
// programs; or a pack of N samples of 2 x 2 px that go right and round, for those of what many
// samples do; or the tiny sprite with actions.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "support/naive_actions.h"
#include "support/tiny_sprite.h"
#include "vsprite/pack.h"

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) return 2;
  const bool acts = argc == 3 && std::string_view(argv[2]) == "acting";
  const bool is_long = argc == 3 && !acts;
  const auto count = static_cast<std::uint32_t>(is_long ? std::atoi(argv[2]) : 0);
  const vsprite::SpriteData data = acts      ? vsprite::testing::acting_sprite_data()
                                   : is_long ? vsprite::testing::long_sprite_data(count)
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
