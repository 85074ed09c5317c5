// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Pictures as SDL textures, least recently used out first.
#include <SDL.h>

#include <cmath>
#include <cstring>
#include <list>
#include <map>
#include <utility>

#include "vsprite/sdl.h"

namespace vsprite {
namespace {

constexpr int kBorder = 1;  // clear pixels, so that an edge between pixels is soft

}  // namespace

struct SdlPictures::Impl {
  using Key = std::pair<const SpriteData*, std::uint32_t>;
  struct Entry {
    Key key;
    SDL_Texture* texture;
    std::size_t bytes;
  };
  using Entries = std::list<Entry>;

  SDL_Renderer* renderer;
  std::size_t budget;
  std::size_t bytes = 0;
  Entries entries{};  // the newest in front
  std::map<Key, Entries::iterator> by_key{};
  Image staging{};
  bool premultiplied = true;
  std::string note{};

  void probe();
  SDL_Texture* make(ImageView picture);
  void drop_until(std::size_t most);
};

namespace {

SDL_BlendMode premultiplied_over() {
  return SDL_ComposeCustomBlendMode(SDL_BLENDFACTOR_ONE, SDL_BLENDFACTOR_ONE_MINUS_SRC_ALPHA,
                                    SDL_BLENDOPERATION_ADD, SDL_BLENDFACTOR_ONE,
                                    SDL_BLENDFACTOR_ONE_MINUS_SRC_ALPHA, SDL_BLENDOPERATION_ADD);
}

}  // namespace

void SdlPictures::Impl::probe() {
  SDL_Texture* trial =
      SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGBA32, SDL_TEXTUREACCESS_STATIC, 1, 1);
  if (trial == nullptr) return;
  premultiplied = SDL_SetTextureBlendMode(trial, premultiplied_over()) == 0;
  SDL_DestroyTexture(trial);
  if (premultiplied) return;
  SDL_RendererInfo info{};
  SDL_GetRendererInfo(renderer, &info);
  note = std::string("SDL's renderer \"") + (info.name != nullptr ? info.name : "") +
         "\" cannot blend premultiplied pixels: textures hold straight alpha, and edges between "
         "pixels are less exact";
}

SDL_Texture* SdlPictures::Impl::make(ImageView picture) {
  staging.width = picture.width + 2 * kBorder;
  staging.height = picture.height + 2 * kBorder;
  const std::size_t row = 4 * static_cast<std::size_t>(staging.width);
  staging.rgba.assign(row * static_cast<std::size_t>(staging.height), 0);
  for (int y = 0; y < picture.height; ++y) {
    std::memcpy(staging.rgba.data() + static_cast<std::size_t>(y + kBorder) * row + 4 * kBorder,
                picture.pixel(0, y), 4 * static_cast<std::size_t>(picture.width));
  }
  if (!premultiplied) unpremultiply(staging);
  SDL_Texture* texture = SDL_CreateTexture(renderer, SDL_PIXELFORMAT_RGBA32,
                                           SDL_TEXTUREACCESS_STATIC, staging.width, staging.height);
  if (texture == nullptr) return nullptr;
  SDL_SetTextureBlendMode(texture, premultiplied ? premultiplied_over() : SDL_BLENDMODE_BLEND);
  SDL_SetTextureScaleMode(texture, SDL_ScaleModeLinear);
  if (SDL_UpdateTexture(texture, nullptr, staging.rgba.data(), 4 * staging.width) == 0)
    return texture;
  SDL_DestroyTexture(texture);
  return nullptr;
}

void SdlPictures::Impl::drop_until(std::size_t most) {
  while (bytes > most && !entries.empty()) {
    SDL_DestroyTexture(entries.back().texture);
    bytes -= entries.back().bytes;
    by_key.erase(entries.back().key);
    entries.pop_back();
  }
}

SdlPictures::SdlPictures(SDL_Renderer* renderer, std::size_t budget)
    : impl_(new Impl{renderer, budget}) {
  impl_->probe();
}

SdlPictures::~SdlPictures() { clear(); }

void SdlPictures::clear() { impl_->drop_until(0); }
bool SdlPictures::is_premultiplied() const noexcept { return impl_->premultiplied; }
const std::string& SdlPictures::note() const noexcept { return impl_->note; }
std::size_t SdlPictures::texture_bytes() const noexcept { return impl_->bytes; }

SDL_Texture* SdlPictures::texture(const Sprite& sprite, FrameCache& frames, std::uint32_t sample) {
  Impl& m = *impl_;
  const Impl::Key key{&sprite.data(), sample};
  if (const auto found = m.by_key.find(key); found != m.by_key.end()) {
    m.entries.splice(m.entries.begin(), m.entries, found->second);
    return found->second->texture;
  }
  const ImageView picture = frames.frame(sample);
  if (picture.width == 0) {
    SDL_SetError("sample %u has no picture: it was not kept, or is damaged",
                 static_cast<unsigned>(sample));
    return nullptr;
  }
  SDL_Texture* made = m.make(picture);
  if (made == nullptr) return nullptr;
  const std::size_t bytes = m.staging.rgba.size();
  m.drop_until(m.budget > bytes ? m.budget - bytes : 0);
  m.entries.push_front({key, made, bytes});
  m.by_key[key] = m.entries.begin();
  m.bytes += bytes;
  return made;
}

bool SdlPictures::draw(const Sprite& sprite, FrameCache& frames, const Actor& actor,
                       const ActorFade& fade, float fraction) {
  const Vec2 at = draw_position(sprite, actor, fraction);
  const auto put = [&](std::uint32_t sample, float share) {
    SDL_Texture* picture = texture(sprite, frames, sample);
    if (picture == nullptr) return false;
    const auto part = static_cast<Uint8>(std::lround(255 * share));
    const Uint8 colour = impl_->premultiplied ? part : 255;
    SDL_SetTextureAlphaMod(picture, part);
    SDL_SetTextureColorMod(picture, colour, colour, colour);
    int width = 0, height = 0;
    SDL_QueryTexture(picture, nullptr, nullptr, &width, &height);
    const Vec2 anchor = sprite.samples()[sample].anchor;
    const SDL_FRect place{at.x - anchor.x - kBorder, at.y - anchor.y - kBorder,
                          static_cast<float>(width), static_cast<float>(height)};
    return SDL_RenderCopyF(impl_->renderer, picture, nullptr, &place) == 0;
  };
  bool done = put(actor.sample, 1);
  const float share = fade_share(fade, fraction);
  if (share > 0 && sprite.samples()[fade.before].width > 0) done = put(fade.before, share) && done;
  frames.look_ahead(actor);
  return done;
}

}  // namespace vsprite
