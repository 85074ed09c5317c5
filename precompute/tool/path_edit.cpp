// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/path_edit.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace vsprite {
namespace {

float distance(Vec2 a, Vec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

float distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d{b.x - a.x, b.y - a.y};
  const float square = d.x * d.x + d.y * d.y;
  const float t = square > 0 ? ((p.x - a.x) * d.x + (p.y - a.y) * d.y) / square : 0;
  const float on = std::clamp(t, 0.0f, 1.0f);
  return distance(p, {a.x + on * d.x, a.y + on * d.y});
}

std::string tenth(float value) {
  char text[32];
  const double rounded = std::round(static_cast<double>(value) * 10) / 10 + 0.0;  // no -0
  return {text, std::to_chars(text, text + sizeof text, rounded).ptr};
}

}  // namespace

void PathEdit::remember() {
  before_.push_back(points_);
  after_.clear();
}

void PathEdit::insert(std::size_t index, Vec2 point) {
  drop();
  remember();
  points_.insert(points_.begin() + static_cast<std::ptrdiff_t>(index), point);
  fresh_ = true;
}

void PathEdit::erase(std::size_t index) {
  drop();
  remember();
  points_.erase(points_.begin() + static_cast<std::ptrdiff_t>(index));
}

void PathEdit::clear() {
  drop();
  if (points_.empty()) return;
  remember();
  points_.clear();
}

void PathEdit::take(std::size_t index) {
  const bool is_new = fresh_;
  drop();
  held_ = index;
  moved_ = is_new;  // the insert is remembered already
}

void PathEdit::move(Vec2 point) {
  if (!held_ || points_[*held_] == point) return;
  if (!moved_) remember();
  moved_ = true;
  points_[*held_] = point;
}

void PathEdit::drop() {
  held_.reset();
  moved_ = fresh_ = false;
}

bool PathEdit::undo() {
  drop();
  if (before_.empty()) return false;
  after_.push_back(std::move(points_));
  points_ = std::move(before_.back());
  before_.pop_back();
  return true;
}

bool PathEdit::redo() {
  drop();
  if (after_.empty()) return false;
  before_.push_back(std::move(points_));
  points_ = std::move(after_.back());
  after_.pop_back();
  return true;
}

std::optional<std::size_t> PathEdit::point_at(Vec2 at, float reach) const {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const float apart = distance(points_[k], at);
    if (apart > reach) continue;
    reach = apart;
    best = k;
  }
  return best;
}

std::optional<std::size_t> PathEdit::segment_at(Vec2 at, float reach) const {
  std::optional<std::size_t> best;
  for (std::size_t k = 1; k < points_.size(); ++k) {
    const float apart = distance(at, points_[k - 1], points_[k]);
    if (apart > reach) continue;
    reach = apart;
    best = k - 1;
  }
  return best;
}

std::string format_path(const std::vector<Vec2>& points, const std::string& head) {
  std::string out = head;
  for (const Vec2& p : points) out += tenth(p.x) + " " + tenth(p.y) + "\n";
  return out;
}

std::string head_of_path(const std::string& text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t first = text.find_first_not_of(" \t\r", at);
    if (first == std::string::npos || (text[first] != '#' && text[first] != '\n')) break;
    const std::size_t end = text.find('\n', first);
    if (end == std::string::npos) break;
    at = end + 1;
  }
  return text.substr(0, at);
}

}  // namespace vsprite
