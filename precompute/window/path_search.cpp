// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "window/path_search.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace vsprite::window {
namespace {

constexpr int kNarrow = 500;

}  // namespace

PathSearch::PathSearch(const Sprite& sprite, const PathWeights& weights, int width, int jobs)
    : sprite_(sprite), weights_(weights), width_(width), jobs_(jobs), thread_([this] { work(); }) {}

PathSearch::~PathSearch() {
  {
    const std::scoped_lock lock(guard_);
    ends_ = true;
    ++number_;
  }
  changed_.notify_one();
  thread_.join();
}

void PathSearch::ask(std::vector<Vec2> points) {
  {
    const std::scoped_lock lock(guard_);
    points_ = std::move(points);
    ++number_;
    is_asked_ = true;
    found_.reset();
    progress_ = 0;
  }
  changed_.notify_one();
}

std::optional<PathFound> PathSearch::take() {
  const std::scoped_lock lock(guard_);
  return std::exchange(found_, std::nullopt);
}

double PathSearch::progress() const {
  const std::scoped_lock lock(guard_);
  return progress_;
}

bool PathSearch::is_wanted(std::uint64_t number) const {
  const std::scoped_lock lock(guard_);
  return number == number_;
}

PathFound PathSearch::look(const std::vector<Vec2>& points, int width, std::uint64_t number) {
  using Clock = std::chrono::steady_clock;
  PathFound out;
  out.width = width;
  const auto path = PathCost::make(sprite_, points, weights_);
  if (!path) {
    out.error = path.error().message;
    return out;
  }
  const auto begun = Clock::now();
  SearchConfig config{.width = width, .jobs = jobs_};
  config.progress = [this, number](double share) {
    const std::scoped_lock lock(guard_);
    if (number == number_) progress_ = share;
  };
  config.go_on = [this, number] { return is_wanted(number); };
  auto clip = search_path(*path, config);
  out.seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  if (!clip) {
    out.error = clip.error().message;
    return out;
  }
  out.report = measure_clip(*path, *clip);
  out.clip = std::move(*clip);
  return out;
}

void PathSearch::work() {
  for (;;) {
    std::vector<Vec2> points;
    std::uint64_t number = 0;
    {
      std::unique_lock lock(guard_);
      changed_.wait(lock, [this] { return is_asked_ || ends_; });
      if (ends_) return;
      is_asked_ = false;
      points = points_;
      number = number_;
    }
    for (const int width : {std::min(kNarrow, width_), width_}) {
      PathFound found = look(points, width, number);
      const std::scoped_lock lock(guard_);
      if (number != number_) break;
      if (found.error.empty() || width == width_) found_ = std::move(found);
      progress_ = width == width_ ? -1 : 0;
      if (width == width_) break;
    }
  }
}

}  // namespace vsprite::window
