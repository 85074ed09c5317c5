// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/ground.h - a floor seen in perspective: where a place on it lies in the picture, and how
// large what stands there is drawn.
//
// A level camera sees the floor from a height. Sizes in the picture grow with the distance of the
// feet from the horizon h, and are those of the sprite on one line, the ground line y0:
//
//     s = (y - h) / (y0 - h)                 scale of what stands at screen height y
//     x_g = (x - c) / s                      right of the middle c of the picture
//     y_g = f (1 - 1 / s)                    0 on the ground line, > 0 nearer, < 0 further away
//
// f is the camera's focal length; near the line a step of (y0 - h) / f in the picture is a step of
// 1 on the floor. Straight lines stay straight. A sprite filmed on a floor
// (`vsprite build --horizon`) lives on the ground plane: its samples have one size and its
// velocities are those on the floor, so actors, tables and paths work as on any other plane, and
// only drawing asks this header where that is and how large.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/result.h"

namespace vsprite {

/// A floor. Pixels of the picture that is drawn, in which the sprite has its own size on the line.
struct Ground {
  float horizon = 0;  ///< y
  float line = 1;     ///< y, > horizon
  float center = 0;   ///< x below the camera: the middle of the picture
  float focal = 1;    ///< px, > 0: about 0.8 widths of a phone's film
};

inline constexpr float kNearest = 64;  ///< largest scale: nearer is drawn as there

/// s at a place on the ground plane, in (0, kNearest].
float scale_at(const Ground& ground, Vec2 on_ground) noexcept;
/// Where a place on the ground plane lies in the picture.
Vec2 to_screen(const Ground& ground, Vec2 on_ground) noexcept;
/// The place on the ground plane under a point of the picture; the horizon and what lies above it
/// count as the furthest that is drawn, a scale of 1/1024.
Vec2 to_ground(const Ground& ground, Vec2 on_screen) noexcept;
/// All lengths times `factor`: the same floor in another size of picture. Pre: factor > 0.
Ground scaled(const Ground& ground, float factor) noexcept;

/// The floor of the pack at `path`, in the sprite's pixels; none is no error.
/// Errors: those of load_pack that concern the section; CorruptData.
Result<std::optional<Ground>> load_ground(const std::string& path);
/// The bytes of a section GRND, for save_pack. Errors: CorruptData (numbers that load_ground would
/// refuse).
Result<std::vector<std::uint8_t>> encode_ground(const Ground& ground);

}  // namespace vsprite
