// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// random_film.h - a ring of samples with random jumps and velocities, for control problems.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "similarity/transitions.h"
#include "vsprite/random.h"
#include "vsprite/sprite.h"

namespace vsprite::testing {

// A ring of n samples with random jumps; the last sample was not kept.
inline CostTable random_costs(std::uint32_t n, Random& random) {
  CostTable costs;
  costs.row_start.assign(1, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      if (j == (i + 1) % n)
        costs.transitions.push_back({j, 0});
      else if (random.below(5) == 0)
        costs.transitions.push_back({j, static_cast<float>(0.2 + random.unit())});
    }
    costs.row_start.push_back(static_cast<std::uint32_t>(costs.transitions.size()));
  }
  costs.row_start.push_back(costs.row_start.back());
  costs.kept.assign(n, 1);
  costs.kept.push_back(0);
  return costs;
}

/// n samples i -> i + 1 (cyclic, cost 0), a fifth of all other jumps at 0.2..1.2; the last sample,
/// number n, was not kept. Leaving a sample out costs 0.3..0.8.
struct RandomFilm {
  CostTable costs;
  std::vector<Vec2> velocities;
  std::vector<float> skip_costs;

  RandomFilm(std::uint32_t n, std::uint64_t seed) {
    Random random{seed};
    costs = random_costs(n, random);
    for (std::uint32_t i = 0; i <= n; ++i) {
      velocities.push_back({static_cast<float>(100 * random.unit() - 50),
                            static_cast<float>(100 * random.unit() - 50)});
      const auto skip = static_cast<float>(0.3 + 0.5 * random.unit());
      skip_costs.push_back(i + 2 < n ? skip : std::numeric_limits<float>::infinity());
    }
  }

  SpriteData data(const ControlMode& mode) const {
    SpriteData out;
    out.name = "random";
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      Sample s;
      s.velocity = velocities[i];
      s.step_x = step_per_tick(s.velocity.x, 30, 1);
      s.step_y = step_per_tick(s.velocity.y, 30, 1);
      s.area = 100;
      s.kept = costs.kept[i];
      s.width = s.height = s.kept != 0 ? std::uint16_t{10} : std::uint16_t{0};
      s.skip_cost = skip_costs[i];
      out.samples.push_back(s);
    }
    out.row_start = costs.row_start;
    out.transitions = costs.transitions;
    out.modes.push_back(mode);
    return out;
  }
};

}  // namespace vsprite::testing
