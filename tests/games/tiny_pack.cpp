// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tiny_pack FILE - writes the tiny sprite as a pack, for the tests that run whole programs.
#include <cstdio>

#include "support/tiny_sprite.h"
#include "vsprite/pack.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const vsprite::SpriteData data = vsprite::testing::tiny_sprite_data();
  const auto picture = [&](std::uint32_t sample) -> vsprite::Result<vsprite::Image> {
    return vsprite::testing::tiny_picture(data, sample);
  };
  const vsprite::Result<void> saved = vsprite::save_pack(argv[1], data, picture);
  if (saved) return 0;
  std::fprintf(stderr, "%s\n", saved.error().message.c_str());
  return 1;
}
