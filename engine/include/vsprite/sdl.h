// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/sdl.h - for games that use SDL2 themselves: the SDL_Window behind a Window, and actors as
// textures of an SDL_Renderer. The one header that names SDL, opt-in.
//
//     SdlPictures pictures(renderer);
//     ...
//     SDL_RenderClear(renderer);
//     pictures.draw(sprite, frames, actor);
//     SDL_RenderPresent(renderer);
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "vsprite/actor.h"
#include "vsprite/show.h"
#include "vsprite/sprite.h"
#include "vsprite/stream.h"
#include "vsprite/window.h"

struct SDL_Renderer;
struct SDL_Texture;
struct SDL_Window;

namespace vsprite {

inline SDL_Window* sdl_window(const Window& window) noexcept {
  return static_cast<SDL_Window*>(window.handle());
}

/// The pictures of sprites as textures of one SDL_Renderer, which must outlive it. The thread of
/// that renderer only. SDL mixes encoded values: edges look a little harder than with a Renderer.
class SdlPictures {
 public:
  /// `budget`: bytes of textures that are kept; those unused for longest go first.
  explicit SdlPictures(SDL_Renderer* renderer, std::size_t budget = std::size_t{64} << 20);
  ~SdlPictures();
  SdlPictures(const SdlPictures&) = delete;
  SdlPictures& operator=(const SdlPictures&) = delete;

  /// Draws an actor where it is, `fraction` of a tick after its last step, between pixels too; the
  /// renderer's scale, viewport and target apply. Over a jump the new picture is drawn, and what is
  /// left of the old one over it. False if SDL makes no texture: SDL_GetError says why.
  bool draw(const Sprite& sprite, FrameCache& frames, const Actor& actor,
            const ActorFade& fade = {}, float fraction = 0);
  /// The picture of a sample with a clear border of one pixel, blend mode set; null as above. To be
  /// used before the next call of draw or texture, which may destroy it.
  SDL_Texture* texture(const Sprite& sprite, FrameCache& frames, std::uint32_t sample);
  /// Destroys all textures: after SDL_RENDER_DEVICE_RESET, or before a Sprite goes.
  void clear();

  /// True if the renderer can blend premultiplied pixels (SDL_ComposeCustomBlendMode). If not, as
  /// with SDL's own software renderer, textures hold straight alpha, and `note` is a sentence that
  /// says so.
  bool is_premultiplied() const noexcept;
  const std::string& note() const noexcept;
  std::size_t texture_bytes() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vsprite
