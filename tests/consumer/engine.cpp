// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// stranger PACK - steers to the right for 60 ticks and prints the hash of the states.
#include <vsprite/vsprite.h>

#include <cinttypes>
#include <cstdio>

int main(int argc, char** argv) {
  const auto sprite = vsprite::load_pack(argc > 1 ? argv[1] : "");
  if (!sprite) return std::fprintf(stderr, "%s\n", sprite.error().message.c_str()), 1;
  vsprite::FrameCache frames(*sprite);
  vsprite::Actor actor = vsprite::make_actor(*sprite);
  vsprite::StateHash hash;
  for (int tick = 0; tick < 60; ++tick) {
    vsprite::set_direction(*sprite, actor, vsprite::Direction::Right);
    vsprite::step(*sprite, actor);
    frames.look_ahead(actor);
    hash.add(actor);
  }
  if (frames.frame(actor.sample).width == 0) return 1;
  std::printf("%016" PRIx64 "\n", hash.digest());
}
