/* SPDX-FileCopyrightText: 2026 the vsprite authors
   SPDX-License-Identifier: MIT

   stranger PACK - steers to the right for 60 ticks and prints the hash of the states. */
#include <inttypes.h>
#include <stdio.h>
#include <vsprite/c_api.h>

int main(int argc, char** argv) {
  vsprite_sprite* sprite = NULL;
  vsprite_hash* hash = NULL;
  vsprite_actor actor;
  uint64_t states = 0;
  int tick;
  if (vsprite_load_pack(argc > 1 ? argv[1] : "", &sprite) || vsprite_make_hash(&hash) ||
      vsprite_make_actor(sprite, 0, 0, 0, 0, &actor))
    return fprintf(stderr, "%s\n", vsprite_last_error()), 1;
  for (tick = 0; tick < 60; ++tick) {
    vsprite_set_direction(sprite, &actor, VSPRITE_RIGHT);
    vsprite_step(sprite, &actor);
    vsprite_add_to_hash(hash, &actor);
  }
  vsprite_get_hash(hash, &states);
  printf("%016" PRIx64 "\n", states);
  vsprite_close_hash(&hash);
  vsprite_close_sprite(&sprite);
  return 0;
}
