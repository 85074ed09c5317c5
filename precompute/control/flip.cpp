// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/flip.h"

#include <algorithm>
#include <tuple>

namespace vsprite {

void add_flips(std::span<const SampleRow> rows, float price, std::vector<PairDistance>& pairs) {
  const auto place = [](const PairDistance& p) { return std::tie(p.i, p.j); };
  const auto before = [&](const PairDistance& a, const PairDistance& b) {
    return place(a) < place(b);
  };
  std::vector<PairDistance> flips;
  for (const SampleRow& row : rows) {
    if (row.mirror_of < 0) continue;
    const auto a = static_cast<std::uint32_t>(row.mirror_of);
    const auto b = static_cast<std::uint32_t>(row.sample);
    flips.push_back({std::min(a, b), std::max(a, b), price});
  }
  std::sort(flips.begin(), flips.end(), before);
  std::vector<PairDistance> all;
  all.reserve(pairs.size() + flips.size());
  std::merge(pairs.begin(), pairs.end(), flips.begin(), flips.end(), std::back_inserter(all),
             before);
  pairs.clear();
  for (const PairDistance& p : all) {
    if (!pairs.empty() && place(pairs.back()) == place(p)) {
      pairs.back().distance = std::min(pairs.back().distance, p.distance);
    } else {
      pairs.push_back(p);
    }
  }
}

bool turns_by_itself(std::span<const SampleRow> rows, std::span<const std::uint8_t> kept) {
  return std::any_of(rows.begin(), rows.end(), [&](const SampleRow& row) {
    return row.mirror_of >= 0 && kept[static_cast<std::size_t>(row.sample)] != 0 &&
           kept[static_cast<std::size_t>(row.mirror_of)] != 0;
  });
}

}  // namespace vsprite
