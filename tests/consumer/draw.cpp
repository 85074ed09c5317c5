// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// stranger PACK - draws three frames without a display.
#include <vsprite/session.h>
#include <vsprite/vsprite.h>

#include <cstdio>

using namespace vsprite;

int main(int argc, char** argv) {
  const auto sprite = load_pack(argc > 1 ? argv[1] : "");
  if (!sprite) return std::fprintf(stderr, "%s\n", sprite.error().message.c_str()), 1;
  auto session =
      Session::open({.title = "stranger", .fps = sprite->fps(), .headless = true, .frames = 3});
  if (!session) return std::fprintf(stderr, "%s\n", session.error().message.c_str()), 1;
  FrameCache frames(*sprite);
  Actor actor = make_actor(*sprite, {640, 360});
  int shown = 0;
  while (session->next_frame()) {
    while (session->next_tick()) step(*sprite, actor);
    session->renderer().clear(srgb(0x9cc4d8));
    draw_actor(session->renderer(), *sprite, frames, actor, session->fraction());
    session->show();
    ++shown;
  }
  std::printf("%d frames\n", shown);
  return session->finish() ? 0 : 1;
}
