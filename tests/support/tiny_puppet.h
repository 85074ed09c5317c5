// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tiny_puppet.h - puppets of a few faces, whose networks say what the test wants.
#pragma once

#include <array>
#include <vector>

#include "vsprite/compose.h"
#include "vsprite/puppet.h"
#include "vsprite/random.h"

namespace vsprite::testing {

// A network without centres: always these outputs, plus `slope` times the one parameter.
inline RbfNetwork straight(std::vector<double> constant, std::vector<double> slope) {
  RbfNetwork net;
  net.kernel = Kernel::Gaussian, net.degree = 1, net.dims = 1;
  net.outputs = static_cast<int>(constant.size());
  net.polynomial = std::move(constant);
  net.polynomial.insert(net.polynomial.end(), slope.begin(), slope.end());
  return net;
}

inline Puppet still_puppet(Image picture, const std::vector<Vec2>& points,
                           std::vector<Face> faces) {
  Puppet puppet;
  puppet.name = "still";
  puppet.parameters = {{"t", 0, 1, 0}};
  std::vector<double> out;
  for (const Vec2 p : points) out.insert(out.end(), {double{p.x}, double{p.y}});
  out.insert(out.end(), {0, 0});              // barycentre
  out.insert(out.end(), points.size(), 0.0);  // depth
  out.push_back(1);                           // share of the one view
  puppet.net = straight(out, std::vector<double>(out.size(), 0));
  puppet.views.push_back({std::move(picture), points, {}});
  puppet.faces = std::move(faces);
  return *make_puppet(std::move(puppet));
}

inline PuppetPose posed(const Puppet& puppet, double t) {
  PuppetPose pose = make_pose(puppet);
  pose_puppet(puppet, std::array{t}, pose);
  return pose;
}

inline Image speckles(int side) {
  Image image = make_image(side, side, 0, 0, 0);
  Random random{5};
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    if (i % 4 != 3) image.rgba[i] = static_cast<std::uint8_t>(random.below(256));
  return image;
}

/// A square of half-covered glass, 96 px wide: triangles and quads side by side, corners moved at
/// random.
inline Puppet glass_puppet() {
  constexpr int kCells = 6;
  std::vector<Vec2> points;
  std::vector<Face> faces;
  Random random{11};
  for (int y = 0; y <= kCells; ++y)
    for (int x = 0; x <= kCells; ++x) {
      const bool rim = x == 0 || y == 0 || x == kCells || y == kCells;
      const auto jitter = [&] { return rim ? 0.0f : static_cast<float>(random.unit() * 8 - 4); };
      points.push_back(
          {static_cast<float>(x * 16) + jitter(), static_cast<float>(y * 16) + jitter()});
    }
  for (std::uint32_t y = 0; y < kCells; ++y)
    for (std::uint32_t x = 0; x < kCells; ++x) {
      const std::uint32_t a = y * (kCells + 1) + x, b = a + 1, c = b + kCells + 1, d = c - 1;
      if ((x + y) % 2 == 0) {
        faces.push_back({{a, b, c, d}, 4});
      } else {
        faces.push_back({{a, b, c}, 3}), faces.push_back({{a, c, d}, 3});
      }
    }
  const Image glass = make_image(96, 96, 64, 64, 64, 128);
  return still_puppet(glass, points, faces);
}

/// One picture, a parameter from 0 to 10: the first set answers from 0 to 6 with its barycentre at
/// height 0, the second from 4 to 10 at 100.
inline Puppet puppet_of_two_sets() {
  Puppet puppet = still_puppet(speckles(8), {{0, 0}, {8, 0}, {8, 8}, {0, 8}}, {{{0, 1, 2, 3}, 4}});
  puppet.parameters[0].high = 10;
  const std::size_t height = 2 * puppet.point_count() + 1;
  const auto set = [&](double low, double high, double at, std::uint32_t other) {
    ExampleSet out{puppet.net, {(low + high) / 2}, {other}};
    out.net.hull = {low, high};
    out.net.polynomial[height] = at;
    return out;
  };
  puppet.sets = {set(0, 6, 0, 1), set(4, 10, 100, 0)};
  puppet.net = puppet.sets[0].net;
  return *make_puppet(std::move(puppet));
}

}  // namespace vsprite::testing
