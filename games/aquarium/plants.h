// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// plants.h - weeds that sway: ribbons of triangles, grown anew every frame from a few numbers each.
#pragma once

#include <span>
#include <vector>

#include "light.h"
#include "vsprite/draw.h"

namespace aquarium {

enum class PlantKind : std::uint8_t { Ribbons, Stems, Sword, Tuft };

struct Plant {
  PlantKind kind = PlantKind::Ribbons;
  vsprite::Vec2 foot;   ///< tank px, on the gravel
  float height = 200;   ///< tank px
  float depth = 0.3f;   ///< of the water in between; below 0: close to the front glass
  float spread = 40;    ///< tank px, half the width of the foot
  int count = 8;        ///< blades, stems or leaves
  vsprite::Color base;  ///< linear, at the foot
  vsprite::Color tip;   ///< linear, at the top
  unsigned seed = 0;
};

/// A fish that brushes past: what bends the blades beside the current.
struct Wake {
  vsprite::Vec2 at;        ///< tank px
  vsprite::Vec2 velocity;  ///< tank px/s
};

/// The planting of the tank, from far to near.
std::vector<Plant> make_plants();

/// Appends the triangles of one plant in tank pixels; `pixel` tank px are one frame pixel (soft
/// edges; where they are large, fewer triangles do).
void grow_plant(const Plant& plant, float time, std::span<const Wake> wakes, float pixel,
                std::vector<vsprite::Vertex>& out);

}  // namespace aquarium
