// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/shadow.h - the shadow that the subject cast when it was filmed.
//
// Where the film shows s times what its background shows without the subject (linear light, every
// channel alike), the shade there is
//
//     a = 1 - s
//
// `vsprite build --shadow` measures it, and the pack holds it sample by sample: a black picture
// whose coverage is a. Drawn "over", in linear light, it darkens any ground as it darkened the
// film's. It goes under the sprite's picture, anchor on anchor, enlarged by `shadow_scale`;
// draw_actor (draw.h) and vsprite_draw_actor (c_api.h) do so where the pack has one. Under the
// subject itself nothing was seen: there the shade is 0.
#pragma once

#include <cstdint>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/image.h"
#include "vsprite/result.h"

namespace vsprite {

struct SpriteData;
class Sprite;

/// The shadow of one sample, compressed. Its pixels are `SpriteData::shadow_scale` of the sprite's.
struct FilmedShadow {
  std::uint32_t sample = 0;
  Vec2 anchor;                        ///< of the subject, px from this picture's top left
  std::uint16_t width = 0;            ///< >= 1
  std::uint16_t height = 0;           ///< >= 1
  std::vector<std::uint8_t> picture;  ///< as a picture of FRAM (engine/PACK.md)
};

/// Appends the shadow of `sample`, which is a kept one and greater than that of the last shadow.
/// `shade`: its alpha counts, 1 to 65535 px a side, at most 2^24 pixels. Errors: CorruptData (of
/// another size), OutOfMemory.
Result<void> add_shadow(SpriteData& data, std::uint32_t sample, const Image& shade, Vec2 anchor);

/// Null: the sample has none. O(log of the shadows).
const FilmedShadow* find_shadow(const Sprite& sprite, std::uint32_t sample) noexcept;

/// Fills `out` (its memory is reused): premultiplied, black. False: damaged, or out of memory.
bool decode_shadow(const FilmedShadow& shadow, Image& out) noexcept;

}  // namespace vsprite
