// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// hello_sdl - hello in a game that owns its SDL window and renderer: vsprite only hands out
// textures.
#include <SDL.h>

#include <optional>

#include "arguments.h"
#include "vsprite/record.h"
#include "vsprite/sdl.h"
#include "vsprite/vsprite.h"
#include "wrap.h"

using namespace vsprite;

namespace {

Direction held_keys() {
  const Uint8* down = SDL_GetKeyboardState(nullptr);
  return direction_from_axes(down[SDL_SCANCODE_RIGHT] - down[SDL_SCANCODE_LEFT],
                             down[SDL_SCANCODE_DOWN] - down[SDL_SCANCODE_UP]);
}

Result<void> run(const games::Arguments& arguments) {
  PackWatch watch(arguments.pack);
  Result<Sprite> sprite = load_pack(arguments.pack);
  if (!sprite) return sprite.error();
  const Result<KeyScript> script = load_key_script(arguments.keys, sprite->fps());
  if (!script) return script.error();
  if (auto known = check_key_script(*sprite, *script); !known) return known.error();
  if (arguments.headless) SDL_SetHint(SDL_HINT_VIDEODRIVER, "dummy");
  SDL_Window* window = nullptr;
  SDL_Renderer* renderer = nullptr;
  if (SDL_Init(SDL_INIT_VIDEO) != 0 ||
      SDL_CreateWindowAndRenderer(1280, 720, SDL_WINDOW_RESIZABLE, &window, &renderer) != 0)
    return Error{ErrorCode::Unavailable, std::string("window: ") + SDL_GetError()};
  Result<Recorder> film = Recorder::open(arguments.record, 1280, 720, sprite->fps());
  if (!film) return film.error();

  std::optional<FrameCache> frames(*sprite);
  SdlPictures pictures(renderer);
  Actor actor = make_actor(*sprite, {640, 360}, arguments.seed);
  ActorFade fade;
  const std::uint64_t ticks = arguments.headless && arguments.frames == 0 ? 300 : arguments.frames;
  for (bool open = true; open && (ticks == 0 || actor.tick < ticks);) {
    for (SDL_Event event; SDL_PollEvent(&event) != 0;) {
      if (event.type == SDL_QUIT) open = false;
      if (event.type == SDL_RENDER_DEVICE_RESET) pictures.clear();
    }
    if (auto rebuilt = games::take_rebuilt(watch, "hello_sdl", sprite->fps())) {
      actor = carry_over(*sprite, *rebuilt, actor);
      fade = {};
      pictures.clear();
      frames.reset();
      *sprite = std::move(*rebuilt);
      frames.emplace(*sprite);
    }
    set_direction(*sprite, actor, arguments.keys.empty() ? held_keys() : script->at(actor.tick));
    play_script(*sprite, *script, actor.tick, actor);
    step(*sprite, actor);
    follow(*sprite, actor, fade, arguments.fade);
    games::wrap(*sprite, actor, 1280, 720);
    SDL_SetRenderDrawColor(renderer, 0x9c, 0xc4, 0xd8, 0xff);
    SDL_RenderClear(renderer);
    pictures.draw(*sprite, *frames, actor, fade);
    if (film->is_open()) {
      Image shot = make_image(1280, 720, 0, 0, 0);
      SDL_RenderReadPixels(renderer, nullptr, SDL_PIXELFORMAT_RGBA32, shot.rgba.data(), 4 * 1280);
      if (auto added = film->add(std::move(shot)); !added) return added;
    }
    SDL_RenderPresent(renderer);
    if (!arguments.headless) SDL_Delay(static_cast<Uint32>(1000 / sprite->fps()));
  }
  return film->is_open() ? film->close() : Result<void>{};
}

}  // namespace

int main(int argc, char** argv) {
  const int code =
      vsprite::games::run(argc, argv, "hello_sdl", "build/goldfish.vsp",
                          [](const games::Arguments& arguments) { return run(arguments); });
  SDL_Quit();
  return code;
}
