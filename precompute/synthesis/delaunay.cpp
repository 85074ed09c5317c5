// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Bowyer and Watson's insertion, with a walk to the triangle that holds the new point. Points are
// taken to whole 1/1024 px, so that the tests for turn and circle are exact (128-bit integers).

#include "synthesis/delaunay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>

namespace vsprite {
namespace {

__extension__ using Wide = __int128;

struct Site {
  std::int64_t x = 0, y = 0;
};

Wide turn(const Site& a, const Site& b, const Site& c) {
  return static_cast<Wide>(b.x - a.x) * (c.y - a.y) - static_cast<Wide>(b.y - a.y) * (c.x - a.x);
}

// > 0: d lies inside the circle through a, b, c, which turn clockwise on the screen.
bool in_circle(const Site& a, const Site& b, const Site& c, const Site& d) {
  const auto row = [&](const Site& p) {
    const Wide x = p.x - d.x, y = p.y - d.y;
    return std::array<Wide, 3>{x, y, x * x + y * y};
  };
  const auto p = row(a), q = row(b), r = row(c);
  // Coordinates below 2^31: sums of six products of four stay below 2^127.
  return p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) +
             p[2] * (q[0] * r[1] - q[1] * r[0]) >
         0;
}

struct Triangle {
  std::array<int, 3> corner{};
  std::array<int, 3> across{-1, -1, -1};  // the neighbour opposite to each corner
  bool alive = true;
};

class Mesh {
 public:
  explicit Mesh(std::vector<Site> sites) : sites_(std::move(sites)) {
    const int n = static_cast<int>(sites_.size());
    constexpr std::int64_t kFar = std::int64_t{1} << 30;
    sites_.insert(sites_.end(), {{-kFar, -kFar}, {kFar, -kFar}, {0, kFar}});
    triangles_.push_back({{n, n + 1, n + 2}, {-1, -1, -1}, true});
  }

  void insert(int site) {
    const int first = find(sites_[at(site)]);
    std::vector<int> cavity{first};
    triangles_[at(first)].alive = false;
    struct Rim {
      int from, to, outside;
    };
    std::vector<Rim> rim;
    for (std::size_t k = 0; k < cavity.size(); ++k) {
      const Triangle t = triangles_[at(cavity[k])];
      for (std::size_t i = 0; i < 3; ++i) {
        const int other = t.across[i];
        if (other >= 0 && !triangles_[at(other)].alive) continue;
        if (other >= 0 && holds(triangles_[at(other)], site)) {
          triangles_[at(other)].alive = false;
          cavity.push_back(other);
        } else {
          rim.push_back({t.corner[(i + 1) % 3], t.corner[(i + 2) % 3], other});
        }
      }
    }
    // A neighbour that joined the cavity later still stands in the rim: its edges are inside.
    std::erase_if(rim,
                  [&](const Rim& r) { return r.outside >= 0 && !triangles_[at(r.outside)].alive; });
    std::map<int, int> starting;
    const int base = static_cast<int>(triangles_.size());
    for (std::size_t k = 0; k < rim.size(); ++k) {
      triangles_.push_back({{site, rim[k].from, rim[k].to}, {rim[k].outside, -1, -1}, true});
      starting[rim[k].from] = base + static_cast<int>(k);
      if (rim[k].outside >= 0)
        relink(rim[k].outside, rim[k].from, rim[k].to, base + static_cast<int>(k));
    }
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const int next = starting[rim[k].to];
      triangles_[at(base + static_cast<int>(k))].across[1] = next;
      triangles_[at(next)].across[2] = base + static_cast<int>(k);
    }
    last_ = base;
  }

  std::vector<Face> faces(int sites) const {
    std::vector<Face> out;
    for (const Triangle& t : triangles_) {
      if (!t.alive || *std::max_element(t.corner.begin(), t.corner.end()) >= sites) continue;
      Face face;
      for (std::size_t i = 0; i < 3; ++i) face.corners[i] = static_cast<std::uint32_t>(t.corner[i]);
      out.push_back(face);
    }
    return out;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  bool holds(const Triangle& t, int site) const {
    return in_circle(sites_[at(t.corner[0])], sites_[at(t.corner[1])], sites_[at(t.corner[2])],
                     sites_[at(site)]);
  }
  void relink(int triangle, int from, int to, int neighbour) {
    Triangle& t = triangles_[at(triangle)];
    for (std::size_t i = 0; i < 3; ++i)
      if (t.corner[i] != from && t.corner[i] != to) t.across[i] = neighbour;
  }
  int find(const Site& p) const {
    int now = last_;
    for (std::size_t steps = 0; steps < triangles_.size(); ++steps) {
      const Triangle& t = triangles_[at(now)];
      int next = -1;
      for (std::size_t i = 0; i < 3 && next < 0; ++i)
        if (turn(sites_[at(t.corner[(i + 1) % 3])], sites_[at(t.corner[(i + 2) % 3])], p) < 0)
          next = t.across[i];
      if (next < 0) break;
      now = next;
    }
    return now;
  }

  std::vector<Site> sites_;
  std::vector<Triangle> triangles_;
  int last_ = 0;
};

}  // namespace

std::vector<Face> triangulate(std::span<const Vec2> points) {
  std::vector<Site> sites;
  for (const Vec2 p : points)
    sites.push_back({std::llround(double{p.x} * 1024), std::llround(double{p.y} * 1024)});
  // Along rows of 64 px, there and back: the walk to the next point is short.
  std::vector<int> order(sites.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) {
    const Site& s = sites[static_cast<std::size_t>(i)];
    const std::int64_t row = s.y >> 16;
    return std::array<std::int64_t, 3>{row, row % 2 == 0 ? s.x : -s.x, s.y};
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  Mesh mesh(sites);
  for (std::size_t k = 0; k < order.size(); ++k)
    if (k == 0 || key(order[k]) != key(order[k - 1])) mesh.insert(order[k]);
  return mesh.faces(static_cast<int>(sites.size()));
}

}  // namespace vsprite
