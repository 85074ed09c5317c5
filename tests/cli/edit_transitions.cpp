// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// edit_transitions FILE SAMPLES WHAT - rewrites a transitions.bin, its sum set right again.
//
//     absent   the first transition leads beyond the last sample
//     nan      the first transition costs no number
//     islands  no transition leads from one half of the samples to the other
//     sink     none leads back from the second half
//
// A sample that has none left leads to the first kept one of its half.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "tool/files.h"
#include "tool/work_files.h"

using namespace vsprite;

namespace {

void part(CostTable& costs, std::uint32_t n, bool both) {
  const auto half_of = [n](std::uint32_t i) { return i < n / 2 ? 0u : 1u; };
  CostTable out;
  out.kept = costs.kept;
  out.row_start.assign(1, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::size_t before = out.transitions.size();
    for (std::uint32_t e = costs.row_start[i]; e < costs.row_start[i + 1]; ++e) {
      const Transition& t = costs.transitions[e];
      const bool forward = half_of(i) < half_of(t.to);
      if (half_of(i) == half_of(t.to) || (forward && !both)) out.transitions.push_back(t);
    }
    if (costs.kept[i] != 0 && out.transitions.size() == before) {
      std::uint32_t first = half_of(i) * (n / 2);
      while (costs.kept[first] == 0) ++first;
      out.transitions.push_back({first, 0.5f});
    }
    out.row_start.push_back(static_cast<std::uint32_t>(out.transitions.size()));
  }
  costs = std::move(out);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const std::string path = argv[1], what = argv[3];
  const auto bytes = read_file(path);
  if (!bytes) return 66;
  const auto n = static_cast<std::uint32_t>(std::atoi(argv[2]));
  auto file = parse_transitions(*bytes, path, n);
  if (!file) return std::fprintf(stderr, "%s\n", file.error().message.c_str()), 3;
  CostTable& costs = file->costs;
  if (what == "absent")
    costs.transitions.front().to = n;
  else if (what == "nan")
    costs.transitions.front().cost = std::numeric_limits<float>::quiet_NaN();
  else if (what == "islands" || what == "sink")
    part(costs, n, what == "islands");
  else
    return 2;
  return write_file(path, format_transitions(*file)) ? 0 : 74;
}
