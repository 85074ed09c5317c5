// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// hello - the smallest game: a filmed character that goes where the arrow keys say.
#include <optional>

#include "arguments.h"
#include "vsprite/session.h"
#include "vsprite/vsprite.h"
#include "wrap.h"

using namespace vsprite;

namespace {

Result<void> run_hello(const games::Arguments& arguments) {
  PackWatch watch(arguments.pack);
  Result<Sprite> sprite = load_pack(arguments.pack);
  if (!sprite) return sprite.error();
  Result<Session> session =
      Session::open(games::session_config("hello", sprite->fps(), arguments, &*sprite));
  if (!session) return session.error();

  Renderer& screen = session->renderer();
  std::optional<FrameCache> frames(*sprite);
  Actor actor = make_actor(*sprite, {640, 360}, arguments.seed);
  ActorFade fade;
  while (session->next_frame()) {
    if (auto rebuilt = games::take_rebuilt(watch, "hello", sprite->fps())) {
      actor = carry_over(*sprite, *rebuilt, actor);
      fade = {};
      forget(screen, *sprite);
      frames.reset();
      *sprite = std::move(*rebuilt);
      frames.emplace(*sprite);
    }
    while (session->next_tick()) {
      set_direction(*sprite, actor, session->direction());
      session->play_actions(*sprite, actor);
      step(*sprite, actor);
      follow(*sprite, actor, fade, arguments.fade);
      games::wrap(*sprite, actor, screen.width(), screen.height());
    }
    screen.clear(srgb(0x9cc4d8));
    draw_actor(screen, *sprite, *frames, actor, fade, session->fraction());
    session->show();
    if (session->input().was_pressed(kKeyEscape)) session->close();
  }
  return session->finish();
}

}  // namespace

int main(int argc, char** argv) {
  return games::run(argc, argv, "hello", "build/goldfish.vsp",
                    [](const games::Arguments& arguments) { return run_hello(arguments); });
}
