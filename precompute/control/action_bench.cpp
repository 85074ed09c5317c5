// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/action_bench.h"

#include <algorithm>

#include "vsprite/action.h"

namespace vsprite {
namespace {

// A way that took longer would be a defect; it is counted as late.
constexpr int kMostTicks = 100000;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}
double percentile(std::vector<double> values, std::size_t percent) {
  std::sort(values.begin(), values.end());
  return values[(values.size() * percent + 99) / 100 - 1];
}
double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

struct Way {
  int ticks = 0;
  double sum = 0, worst = 0;
};

// `first_of`: the tag whose first samples end the way.
Way walk(const Sprite& sprite, Actor actor, int action, std::uint16_t tag, int within) {
  Way way;
  const auto shows = [&] {
    return sprite.samples()[actor.sample].tag == tag && sprite.is_first(actor.sample);
  };
  if (shows()) return way;
  play(sprite, actor, action, within);
  while (way.ticks < kMostTicks) {
    const std::uint32_t before = actor.sample;
    step(sprite, actor);
    ++way.ticks;
    const double cost = double{shown_cost(sprite, before, actor)};
    way.sum += cost;
    way.worst = std::max(way.worst, cost);
    if (shows()) return way;
  }
  return way;
}

ActionReport measure(const Sprite& sprite, int mode, int action, std::uint16_t tag, int within) {
  ActionReport report;
  report.tag = sprite.data().tags[tag];
  report.within = within;
  std::vector<double> frames, costs, worst;
  std::uint64_t cuts = 0;
  for (std::uint32_t i = 0; i < sprite.samples().size(); ++i) {
    if (sprite.samples()[i].kept == 0) continue;
    Actor actor = make_actor(sprite, {}, 0, mode);
    actor.sample = i;
    const Way way = walk(sprite, actor, action, tag, within);
    frames.push_back(way.ticks);
    costs.push_back(way.sum);
    worst.push_back(way.worst);
    cuts += way.worst > 1;
    report.late += within >= 0 ? way.ticks > std::max(within, 1) : way.ticks >= kMostTicks;
  }
  report.states = frames.size();
  report.frames_median = median(frames);
  report.frames_p95 = percentile(frames, 95);
  report.frames_max = percentile(frames, 100);
  report.cost_mean = mean(costs);
  report.cost_p95 = percentile(costs, 95);
  report.cost_max = percentile(costs, 100);
  report.worst_mean = mean(worst);
  report.worst_p95 = percentile(worst, 95);
  report.cut_share = static_cast<double>(cuts) / static_cast<double>(frames.size());
  return report;
}

}  // namespace

std::vector<ActionReport> measure_actions(const Sprite& sprite, int mode) {
  std::vector<ActionReport> reports;
  for (const ActionTable& table : sprite.data().actions) {
    const int action = find_action(sprite, sprite.data().tags[table.tag]);
    for (const int within : kBenchDeadlines)
      reports.push_back(measure(sprite, mode, action, table.tag, within));
  }
  return reports;
}

}  // namespace vsprite
