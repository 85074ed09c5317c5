// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// capture/fish_model.h - the goldfish as triangles, from its pose.
//
// A spine bends in the plane of swimming (the turn plus a wave that runs to the tail) and in the
// plane of symmetry; elliptical sections along it make the body, and thin sheets of rays the fins.
// Lengths inside are in units of the body from nose to tail root.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "goldfish.h"
#include "vec.h"

namespace vsprite::capture {

enum class Material : std::uint8_t { Body, Eye, Fin };

struct Vertex {
  float x = 0, y = 0, z = 0;  ///< film px, x right, y down, z towards the camera
  Vec3 normal;                ///< unit, x right, y up, z towards the camera
  Vec3 tangent;               ///< body: unit, towards the tail
  float u = 0, v = 0;         ///< body: along, from back (0) to belly (1); fin: along a ray, across
};

struct Triangle {
  std::array<std::uint32_t, 3> corner;
  Material material;
  std::uint8_t rays = 0;  ///< fin: rays over v = 0..1
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<Triangle> opaque;  ///< body and eyes
  std::vector<Triangle> fins;    ///< back to front
};

inline constexpr float kBodyLength = 112;  ///< px from nose to tail root
inline constexpr float kCentre = 0.45f;    ///< where the body's centre lies along it

/// Replaces the content of `mesh`.
void build_fish(const FishPose& pose, Mesh& mesh);

/// The same fish as a few hundred points of its surface in film px, z towards the camera: within a
/// pixel of its extent, at a twentieth of the price.
void outline_fish(const FishPose& pose, std::vector<Vec3>& points);

/// The pose `t` of the way from a to b (angles are unwrapped).
FishPose between(const FishPose& a, const FishPose& b, double t);

}  // namespace vsprite::capture
