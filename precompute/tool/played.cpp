// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/played.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "vsprite/policy.h"

namespace vsprite {
namespace {

// A name that no run has yet.
std::string fresh_name(std::string name, std::map<std::string, int>& taken) {
  std::replace(name.begin(), name.end(), '+', '-');
  const int count = ++taken[name];
  return count == 1 ? name : fresh_name(name + "-" + std::to_string(count), taken);
}

std::vector<PlayedRun> runs_as_filmed(const SpriteData& data, bool named_only,
                                      std::map<std::string, int>& taken) {
  std::vector<PlayedRun> runs;
  const Sample* before = nullptr;
  for (std::uint32_t i = 0; i < data.samples.size(); ++i) {
    const Sample& s = data.samples[i];
    const std::string& tag = data.tags[s.tag];
    const bool wanted = s.kept == 1 && !(named_only && tag.empty());
    if (wanted && (before == nullptr || before->clip != s.clip || before->tag != s.tag))
      runs.push_back({fresh_name(tag.empty() ? "film" : tag, taken), {}, false, {}});
    if (wanted) runs.back().samples.push_back(i);
    before = wanted ? &s : nullptr;
  }
  return runs;
}

}  // namespace

std::vector<std::uint32_t> most_travelled_loop(const std::vector<std::uint32_t>& next) {
  constexpr std::uint32_t kUnseen = 0, kOnTheWay = 1;
  // Which loop a sample leads into, 2 and up; `heads` are samples of the loops.
  std::vector<std::uint32_t> into(next.size(), kUnseen), heads, way;
  std::vector<std::size_t> led;
  for (std::uint32_t start = 0; start < next.size(); ++start) {
    if (next[start] == kNoSample) continue;
    way.clear();
    std::uint32_t at = start;
    for (; into[at] == kUnseen; at = next[at]) {
      into[at] = kOnTheWay;
      way.push_back(at);
    }
    if (into[at] == kOnTheWay) {
      heads.push_back(at);
      led.push_back(0);
    }
    const std::uint32_t loop =
        into[at] == kOnTheWay ? static_cast<std::uint32_t>(heads.size()) + 1 : into[at];
    for (const std::uint32_t i : way) into[i] = loop;
    led[loop - 2] += way.size();
  }
  std::vector<std::uint32_t> out;
  if (heads.empty()) return out;
  const auto best = std::max_element(led.begin(), led.end()) - led.begin();
  const std::uint32_t head = heads[static_cast<std::size_t>(best)];
  std::uint32_t at = head;
  do {
    out.push_back(at);
    at = next[at];
  } while (at != head);
  std::rotate(out.begin(), std::min_element(out.begin(), out.end()), out.end());
  return out;
}

std::vector<PlayedRun> direction_runs(const SpriteData& data) {
  std::vector<PlayedRun> runs;
  std::map<std::string, int> taken;
  const ControlMode& mode = data.modes.front();
  const auto n = static_cast<std::ptrdiff_t>(data.samples.size());
  for (int d = 0; d < kDirectionCount; ++d) {
    if (d < kCompassCount && (mode.served >> d & 1u) == 0) continue;
    const auto direction = static_cast<Direction>(d);
    // Stage 0 is where a command that stands stays.
    const auto table = static_cast<std::ptrdiff_t>(group_of(mode, direction) * mode.stages);
    auto loop =
        most_travelled_loop({mode.next.begin() + table * n, mode.next.begin() + (table + 1) * n});
    if (!loop.empty())
      runs.push_back(
          {fresh_name(std::string(direction_name(direction)), taken), std::move(loop), true, {}});
  }
  auto tags = runs_as_filmed(data, true, taken);
  std::move(tags.begin(), tags.end(), std::back_inserter(runs));
  return runs;
}

std::vector<PlayedRun> film_runs(const SpriteData& data) {
  std::map<std::string, int> taken;
  return runs_as_filmed(data, false, taken);
}

int Canvas::left(const Sample& s) const noexcept {
  return static_cast<int>(std::lround(static_cast<float>(width) / 2 - s.anchor.x));
}
int Canvas::top(const Sample& s) const noexcept {
  return static_cast<int>(std::lround(static_cast<float>(height) / 2 - s.anchor.y));
}

Canvas canvas_of(const SpriteData& data, const std::vector<PlayedRun>& runs) {
  Canvas canvas;
  for (const PlayedRun& run : runs) {
    for (const std::uint32_t i : run.samples) {
      const Sample& s = data.samples[i];
      const Canvas origin{0, 0};
      const int x = origin.left(s), y = origin.top(s);
      canvas.width = std::max({canvas.width, -2 * x, 2 * (x + s.width)});
      canvas.height = std::max({canvas.height, -2 * y, 2 * (y + s.height)});
    }
  }
  return canvas;
}

}  // namespace vsprite
