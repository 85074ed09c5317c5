// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Weeds as ribbons: a middle line, a half width and two tones along it, edges faded over a pixel.
#include "plants.h"

#include <array>
#include <cmath>

namespace aquarium {

using vsprite::Color;
using vsprite::Vec2;
using vsprite::Vertex;

namespace {

constexpr std::size_t kMostNodes = 12;

/// A place on the middle line of a ribbon.
struct Node {
  Vec2 at;
  float half = 0;  ///< half the width, tank px
  Color left;
  Color right;
};

struct Ribbon {
  std::array<Node, kMostNodes> nodes;
  std::size_t count = 0;
};

/// Everything that a blade needs to know about its surroundings.
struct Water {
  float time = 0;
  float depth = 0;
  float feather = 1;
  bool coarse = false;  ///< few pixels to draw on: fewer nodes
  std::span<const Wake> wakes;
};

Vec2 normal_at(const Ribbon& ribbon, std::size_t k) {
  const Vec2 a = ribbon.nodes[k == 0 ? 0 : k - 1].at;
  const Vec2 b = ribbon.nodes[std::min(k + 1, ribbon.count - 1)].at;
  const Vec2 d{b.x - a.x, b.y - a.y};
  const float length = std::max(0.001f, std::sqrt(d.x * d.x + d.y * d.y));
  return {-d.y / length, d.x / length};
}

void quad(std::vector<Vertex>& out, const Vertex& a, const Vertex& b, const Vertex& c,
          const Vertex& d) {
  out.insert(out.end(), {a, b, c, c, b, d});
}

/// Five points across a node: faded edge, edge, middle, edge, faded edge.
std::array<Vertex, 5> across(const Ribbon& ribbon, std::size_t k, float feather) {
  const Node& node = ribbon.nodes[k];
  const Vec2 n = normal_at(ribbon, k);
  const auto at = [&](float way) { return Vec2{node.at.x + n.x * way, node.at.y + n.y * way}; };
  const Color middle = mix(node.left, node.right, 0.5f);
  Color out_left = node.left;
  Color out_right = node.right;
  out_left.a = out_right.a = 0;
  return {Vertex{at(-node.half - feather), out_left}, Vertex{at(-node.half), node.left},
          Vertex{at(0), middle}, Vertex{at(node.half), node.right},
          Vertex{at(node.half + feather), out_right}};
}

/// For stalks and grass of a few pixels: a bright middle between two faded edges.
void append_thin(const Ribbon& ribbon, float feather, std::vector<Vertex>& out) {
  const auto points = [&](std::size_t k) {
    const Node& node = ribbon.nodes[k];
    const Vec2 n = normal_at(ribbon, k);
    const float way = node.half + 0.7f * feather;
    Color left = node.left;
    Color right = node.right;
    left.a = right.a = 0;
    return std::array<Vertex, 3>{Vertex{{node.at.x - n.x * way, node.at.y - n.y * way}, left},
                                 Vertex{node.at, mix(node.left, node.right, 0.5f)},
                                 Vertex{{node.at.x + n.x * way, node.at.y + n.y * way}, right}};
  };
  std::array<Vertex, 3> before = points(0);
  for (std::size_t k = 1; k < ribbon.count; ++k) {
    const std::array<Vertex, 3> here = points(k);
    quad(out, before[0], before[1], here[0], here[1]);
    quad(out, before[1], before[2], here[1], here[2]);
    before = here;
  }
}

/// Wide ribbons get a crisp body; those of a few pixels need no more than half the triangles.
void append(const Ribbon& ribbon, float feather, std::vector<Vertex>& out) {
  float widest = 0;
  for (std::size_t k = 0; k < ribbon.count; ++k) widest = std::max(widest, ribbon.nodes[k].half);
  if (widest < 2.5f * feather) return append_thin(ribbon, feather, out);
  std::array<Vertex, 5> before = across(ribbon, 0, feather);
  for (std::size_t k = 1; k < ribbon.count; ++k) {
    const std::array<Vertex, 5> here = across(ribbon, k, feather);
    for (std::size_t s = 0; s + 1 < here.size(); ++s)
      quad(out, before[s], before[s + 1], here[s], here[s + 1]);
    before = here;
  }
}

/// Sideways displacement at height `u` (0 foot .. 1 tip) of a blade that stands at `at`.
float sway(const Water& water, Vec2 at, float u, float height, float phase) {
  const float swell = std::sin(0.7f * water.time + 0.006f * at.x + phase * 0.6f - 1.9f * u);
  const float flutter = std::sin(1.9f * water.time + phase - 3.4f * u);
  float way = height * std::pow(u, 1.5f) * (0.085f * swell + 0.022f * flutter + 0.035f);
  for (const Wake& wake : water.wakes) {
    const float x = at.x - wake.at.x;
    const float y = at.y - wake.at.y;
    const float near = std::exp(-(x * x + y * y) / (110.0f * 110.0f));
    way += u * near * (0.16f * wake.velocity.x + 0.20f * x);
  }
  return way;
}

Color in_water(Color c, const Water& water, Vec2 at, float light) {
  return through_water(scaled(c, light * shimmer(at, water.time)), std::max(0.0f, water.depth), at);
}

/// A blade from `foot` upwards, `lean` to the side; widest at a third of its height.
Ribbon make_blade(const Plant& plant, const Water& water, Vec2 foot, float height, float lean,
                  float half, float phase, std::size_t nodes = kMostNodes) {
  Ribbon ribbon;
  ribbon.count = water.coarse ? (nodes + 3) / 2 : nodes;
  for (std::size_t k = 0; k < ribbon.count; ++k) {
    const float u = static_cast<float>(k) / static_cast<float>(ribbon.count - 1);
    Vec2 at{foot.x + lean * u * u, foot.y - height * u * (1 - 0.12f * u)};
    at.x += sway(water, at, u, height, phase);
    const float taper = std::min(1.0f, 0.55f + 2.0f * u) * std::sqrt(std::max(0.0f, 1 - u * u * u));
    const Color c = mix(plant.base, plant.tip, u);
    const float twist = 0.22f * std::sin(phase * 3 + 4.5f * u + 0.5f * water.time);
    const float dark = 0.35f + 0.65f * smooth_step(0.0f, 0.45f, u);
    ribbon.nodes[k] = {at, half * taper, in_water(c, water, at, dark * (0.80f + twist)),
                       in_water(c, water, at, dark * (1.12f - twist))};
  }
  return ribbon;
}

/// A leaf from `root` along `along` (its length is that of the leaf), hanging a little at the tip.
void append_leaf(const Plant& plant, const Water& water, Vec2 root, Vec2 along, float half, float u,
                 std::vector<Vertex>& out) {
  Ribbon leaf;
  leaf.count = water.coarse ? 3 : 4;
  const Color c = mix(plant.base, plant.tip, u);
  const float length = std::sqrt(along.x * along.x + along.y * along.y);
  for (std::size_t k = 0; k < leaf.count; ++k) {
    const float t = static_cast<float>(k) / static_cast<float>(leaf.count - 1);
    const Vec2 at{root.x + along.x * t, root.y + along.y * t + 0.22f * length * t * t};
    const float width = half * 2.6f * std::sqrt(t) * (1 - t) + (k == 0 ? 0.6f : 0.0f);
    const float light = 0.75f + 0.35f * t;
    leaf.nodes[k] = {at, width, in_water(c, water, at, light * (along.x > 0 ? 1.22f : 0.78f)),
                     in_water(c, water, at, light * (along.x > 0 ? 0.78f : 1.22f))};
  }
  append(leaf, water.feather, out);
}

void grow_ribbons(const Plant& plant, const Water& water, Random dice, std::vector<Vertex>& out) {
  for (int k = 0; k < plant.count; ++k) {
    const Vec2 foot{plant.foot.x + dice.between(-1, 1) * plant.spread,
                    plant.foot.y + dice.between(-5, 5)};
    const float height = plant.height * dice.between(0.55f, 1.0f);
    const float lean = dice.between(-0.22f, 0.22f) * plant.height;
    const float half = plant.height * dice.between(0.009f, 0.015f) + 1.2f;
    append(make_blade(plant, water, foot, height, lean, half, dice.between(0, 6.28f)),
           water.feather, out);
  }
}

void grow_stems(const Plant& plant, const Water& water, Random dice, std::vector<Vertex>& out) {
  for (int k = 0; k < plant.count; ++k) {
    const Vec2 foot{plant.foot.x + dice.between(-1, 1) * plant.spread,
                    plant.foot.y + dice.between(-4, 4)};
    const float height = plant.height * dice.between(0.6f, 1.0f);
    const float phase = dice.between(0, 6.28f);
    const float lean = dice.between(-0.15f, 0.15f) * plant.height;
    const Ribbon stem = make_blade(plant, water, foot, height, lean, 1.6f, phase, 8);
    append_thin(stem, water.feather, out);
    const int pairs = std::max(5, static_cast<int>(height / 16));
    for (int p = 1; p <= pairs; ++p) {
      const float u = static_cast<float>(p) / static_cast<float>(pairs);
      const float place = u * static_cast<float>(stem.count - 1);
      const auto low = std::min(static_cast<std::size_t>(place), stem.count - 2);
      const float part = place - static_cast<float>(low);
      const Vec2 a = stem.nodes[low].at;
      const Vec2 b = stem.nodes[low + 1].at;
      const Vec2 at{a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part};
      const float size = plant.height * 0.115f * (1.15f - 0.6f * u) * dice.between(0.8f, 1.15f) + 3;
      const float lift = -0.30f - 0.75f * u + 0.10f * std::sin(1.3f * water.time + phase + 5 * u);
      append_leaf(plant, water, at, {size, size * lift}, 0.24f * size, u, out);
      append_leaf(plant, water, at, {-size, size * lift}, 0.24f * size, u, out);
    }
  }
}

void grow_sword(const Plant& plant, const Water& water, Random dice, std::vector<Vertex>& out) {
  for (int k = 0; k < plant.count; ++k) {
    const float side = plant.count > 1
                           ? 2.0f * static_cast<float>(k) / static_cast<float>(plant.count - 1) - 1
                           : 0.0f;
    const float reach = plant.height * (1 - 0.35f * side * side) * dice.between(0.75f, 1.0f);
    const float phase = dice.between(0, 6.28f);
    Ribbon leaf;
    leaf.count = water.coarse ? 9 : kMostNodes;
    for (std::size_t n = 0; n < leaf.count; ++n) {
      const float u = static_cast<float>(n) / static_cast<float>(leaf.count - 1);
      const float out_way = side * plant.spread * (0.25f * u + 0.95f * u * u);
      const float droop = 0.42f * std::abs(side) * u * u * u;
      Vec2 at{plant.foot.x + out_way, plant.foot.y - reach * (u - droop)};
      at.x += 0.6f * sway(water, at, u, reach, phase);
      const float stalk = smooth_step(0.22f, 0.45f, u);
      const float blade = std::sqrt(std::max(0.0f, 1 - std::pow(std::abs(2.1f * u - 1.25f), 2.4f)));
      const float half = 1.6f + stalk * reach * 0.085f * (u < 1 ? blade : 0.0f);
      const Color c = mix(plant.base, plant.tip, 0.25f + 0.75f * u);
      const float tone = side < 0 ? 1.25f : 0.72f;
      const float dark = 0.35f + 0.65f * smooth_step(0.0f, 0.4f, u);
      leaf.nodes[n] = {at, half, in_water(c, water, at, dark * tone),
                       in_water(c, water, at, dark * (1.97f - tone))};
    }
    append(leaf, water.feather, out);
  }
}

void grow_tuft(const Plant& plant, const Water& water, Random dice, std::vector<Vertex>& out) {
  for (int k = 0; k < plant.count; ++k) {
    const float x = dice.between(-1, 1);
    const Vec2 foot{plant.foot.x + x * plant.spread, plant.foot.y + dice.between(-7, 7)};
    const float height = plant.height * dice.between(0.45f, 1.0f) * (1 - 0.5f * x * x);
    append_thin(make_blade(plant, water, foot, height, dice.between(-0.6f, 0.6f) * height, 2.0f,
                           dice.between(0, 6.28f), 6),
                water.feather, out);
  }
}

}  // namespace

std::vector<Plant> make_plants() {
  const Color dark{0.010f, 0.045f, 0.010f, 1};
  const Color grass{0.075f, 0.260f, 0.035f, 1};
  const Color lime{0.200f, 0.430f, 0.060f, 1};
  const Color olive{0.110f, 0.200f, 0.030f, 1};
  const Color wine{0.420f, 0.060f, 0.050f, 1};
  const Color wine_dark{0.060f, 0.040f, 0.015f, 1};
  const Color moss{0.030f, 0.080f, 0.012f, 1};
  using K = PlantKind;
  const Color shade{0.004f, 0.018f, 0.005f, 1};
  // clang-format off
  return {
      // kind, foot, height, depth, spread, count, base, tip, seed
      {K::Ribbons, {545, 574}, 290, 0.85f, 44, 11, dark, grass, 11},
      {K::Ribbons, {900, 572}, 360, 0.85f, 74, 15, dark, grass, 12},
      {K::Stems, {715, 572}, 120, 0.90f, 60, 7, dark, grass, 13},
      {K::Ribbons, {1010, 584}, 440, 0.48f, 50, 14, dark, lime, 14},
      {K::Stems, {612, 586}, 104, 0.55f, 50, 7, dark, olive, 15},
      {K::Ribbons, {84, 590}, 450, 0.40f, 74, 18, dark, grass, 16},
      {K::Stems, {1148, 598}, 260, 0.30f, 62, 9, wine_dark, wine, 17},
      {K::Ribbons, {1244, 610}, 500, 0.22f, 40, 13, dark, lime, 18},
      {K::Sword, {884, 618}, 140, 0.24f, 96, 11, moss, lime, 19},
      {K::Stems, {22, 628}, 240, 0.16f, 44, 7, moss, grass, 20},
      {K::Sword, {424, 642}, 100, 0.14f, 76, 11, moss, grass, 21},
      {K::Tuft, {286, 694}, 50, 0.04f, 90, 44, moss, lime, 22},
      {K::Tuft, {1010, 692}, 44, 0.04f, 80, 38, moss, lime, 23},
      {K::Tuft, {700, 634}, 24, 0.26f, 60, 26, moss, grass, 24},
      {K::Tuft, {560, 612}, 18, 0.40f, 40, 18, moss, grass, 29},
      // close to the glass: dark, in front of the fish
      {K::Ribbons, {-14, 770}, 470, -0.1f, 52, 8, shade, {0.020f, 0.075f, 0.014f, 1}, 25},
      {K::Sword, {1266, 764}, 270, -0.1f, 150, 11, shade, {0.024f, 0.085f, 0.014f, 1}, 26},
      {K::Tuft, {86, 748}, 78, -0.1f, 130, 40, shade, {0.030f, 0.095f, 0.014f, 1}, 27},
      {K::Tuft, {1150, 748}, 66, -0.1f, 140, 40, shade, {0.030f, 0.095f, 0.014f, 1}, 28},
  };
  // clang-format on
}

void grow_plant(const Plant& plant, float time, std::span<const Wake> wakes, float pixel,
                std::vector<Vertex>& out) {
  // Things close to the glass and far away are out of focus: their edges are softer.
  const float blur = plant.depth < 0 ? 3.0f : 1 + 2.0f * plant.depth;
  const Water water{time, plant.depth, pixel * blur, pixel > 1.2f, wakes};
  const Random dice{plant.seed};
  switch (plant.kind) {
    case PlantKind::Ribbons:
      return grow_ribbons(plant, water, dice, out);
    case PlantKind::Stems:
      return grow_stems(plant, water, dice, out);
    case PlantKind::Sword:
      return grow_sword(plant, water, dice, out);
    case PlantKind::Tuft:
      return grow_tuft(plant, water, dice, out);
  }
}

}  // namespace aquarium
