/* SPDX-FileCopyrightText: 2026 the vsprite authors
   SPDX-License-Identifier: MIT

   steer PACK SCRIPT FRAMES [PICTURE.png] - a character in plain C, steered by a key script: prints
   the hash of its states, and draws where it ends. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "vsprite/c_api.h"

static int failed(void) { return fprintf(stderr, "steer: error: %s\n", vsprite_last_error()), 1; }

int main(int argc, char** argv) {
  vsprite_sprite* sprite = NULL;
  vsprite_frames* frames = NULL;
  vsprite_keys* keys = NULL;
  vsprite_hash* hash = NULL;
  vsprite_canvas* canvas = NULL;
  vsprite_actor actor;
  uint64_t states = 0;
  if (argc < 4) return puts("usage: steer PACK \"0 right; 2 down\" FRAMES [PICTURE.png]"), 2;
  if (vsprite_load_pack(argv[1], &sprite) || vsprite_load_keys(sprite, argv[2], &keys) ||
      vsprite_make_frames(sprite, 0, &frames) || vsprite_make_hash(&hash) ||
      vsprite_make_actor(sprite, 0, 0, 0, 0, &actor))
    return failed();
  for (long frame = strtol(argv[3], NULL, 10); frame > 0; --frame) {
    if (vsprite_apply_keys(keys, &actor) || vsprite_step(sprite, &actor)) return failed();
    vsprite_add_to_hash(hash, &actor);
  }
  vsprite_get_hash(hash, &states);
  printf("%016" PRIx64 "\n", states);
  actor.x = 320 * 65536, actor.y = 180 * 65536; /* the middle of the picture */
  if (argc > 4 &&
      (vsprite_make_canvas(640, 360, 0x9CC4D8, &canvas) ||
       vsprite_draw_actor(canvas, frames, &actor, 0, 1) || vsprite_save_canvas(canvas, argv[4])))
    return failed();
  vsprite_close_canvas(&canvas), vsprite_close_hash(&hash), vsprite_close_keys(&keys);
  vsprite_close_frames(&frames), vsprite_close_sprite(&sprite);
  return 0;
}
