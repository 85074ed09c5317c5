// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The sequel's idea; the moves are our own (its text is not at hand): a detour along one
// direction's table that rejoins the old sequence, a cut that leaves a piece out, a new end, a new
// beginning. Half of the directions lead towards what a term wants, now or later. A change that
// costs a little is taken now and then, ever less; the best is kept aside.
#include "control/replace.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "control/response.h"
#include "similarity/features.h"
#include "vsprite/policy.h"
#include "vsprite/random.h"

namespace vsprite {
namespace {

constexpr std::uint64_t kTurn = 100;      // proposals before the next sprite's turn
constexpr std::size_t kLongestPart = 60;  // samples
constexpr std::size_t kWindow = 75;       // samples of the old sequence that a part may rejoin
constexpr double kWarmth = 0.5;           // how much worse is taken at first, at most
constexpr double kCooling = 3000;         // proposals until half of it

using Kind = SceneTerm::Kind;

struct Point {
  double x = 0, y = 0;
};
double length(Point a) { return std::sqrt(a.x * a.x + a.y * a.y); }
double squared(double v) { return v * v; }

Point point_of(Position p) {
  return {static_cast<double>(p.x) / kFixedOne, static_cast<double>(p.y) / kFixedOne};
}

// One sprite's sequence, laid out in time and space.
struct Course {
  std::vector<std::uint32_t> samples;  // as shown one after the other
  std::vector<std::uint32_t> at_tick;  // index into `samples`, a tick
  std::vector<Position> places;        // a tick
  double cost = 0;                     // T and this role's terms
};

class Role {
 public:
  Role(const SceneRole& role, std::uint32_t ticks) : role_(role), ticks_(ticks) {
    const SpeedScale speeds = measure_speeds(role.sprite->samples());
    v0_ = 0.35 * (speeds.usual > 0 ? speeds.usual : speeds.moving);
    body_ = std::max(1.0, static_cast<double>(role.sprite->data().body_length));
    mode_ = std::max(0, role.sprite->find_mode("paper"));
    for (const Sample& s : sprite().samples()) {
      const Point v{static_cast<double>(s.velocity.x), static_cast<double>(s.velocity.y)};
      motions_.push_back({angle_of(v.x, v.y), length(v)});
    }
    for (const SceneTerm& term : role.terms) {
      paths_.emplace_back();
      if (term.kind != Kind::Path) continue;
      auto path = PathCost::make(sprite(), term.points, {.v0 = v0_});
      paths_.back().push_back(std::move(*path));
    }
  }

  const Sprite& sprite() const { return *role_.sprite; }
  const std::vector<SceneTerm>& terms() const { return role_.terms; }
  std::uint32_t ticks() const { return ticks_; }

  std::uint32_t follow(std::uint32_t sample, Direction direction) const {
    const Policy policy = make_policy(sprite(), mode_);
    const ControlMode& mode = sprite().data().modes[static_cast<std::size_t>(mode_)];
    const Direction table = mode.table_of[static_cast<std::size_t>(direction)];
    return next_sample(policy, table_index(policy, group_of(mode, table), 0), sample);
  }

  // Trims or continues `samples` to the scene's length, and places them.
  Course lay_out(std::vector<std::uint32_t> samples) const {
    Course course;
    course.samples = std::move(samples);
    Position place = to_position(role_.start);
    for (std::size_t k = 0; course.at_tick.size() < ticks_; ++k) {
      if (k == course.samples.size())
        course.samples.push_back(follow(course.samples.back(), Direction::None));
      const Sample& s = sprite().samples()[course.samples[k]];
      for (std::uint32_t t = 0; t < s.duration && course.at_tick.size() < ticks_; ++t) {
        course.at_tick.push_back(static_cast<std::uint32_t>(k));
        course.places.push_back(place);
        place = {place.x + s.step_x, place.y + s.step_y};
      }
    }
    course.samples.resize(course.at_tick.back() + std::size_t{1});
    return course;
  }

  // What a term says of a place alone.
  double place_value(const SceneTerm& term, Point p) const {
    if (term.kind == Kind::Location) {
      const Point off{p.x - static_cast<double>(term.at.x), p.y - static_cast<double>(term.at.y)};
      return squared(std::max(0.0, length(off) - term.radius) / body_);
    }
    const double x =
        p.x - std::clamp(p.x, static_cast<double>(term.low.x), static_cast<double>(term.high.x));
    const double y =
        p.y - std::clamp(p.y, static_cast<double>(term.low.y), static_cast<double>(term.high.y));
    return (x * x + y * y) / squared(body_);
  }
  // What a term says of a sample alone.
  double sample_value(const SceneTerm& term, std::uint32_t sample) const {
    const Motion& m = motions_[sample];
    if (term.kind == Kind::Heading) {
      double turn = std::fabs(m.heading - term.angle);
      if (turn > kPi) turn = 2 * kPi - turn;
      const double trust = std::min(1.0, m.speed / v0_);
      return trust * turn + (1 - trust) * kPi;
    }
    if (term.kind == Kind::Speed) return squared((m.speed - term.speed) / v0_);
    const Sample &a = sprite().samples()[sample], &b = sprite().samples()[term.sample];
    if (a.clip != b.clip) return 1;
    const double apart = std::fabs(static_cast<double>(a.frame) - static_cast<double>(b.frame));
    return std::min(apart, 30.0) / 30;
  }
  double pair_value(const SceneTerm& term, Point p, Point other) const {
    const double apart = length({p.x - other.x, p.y - other.y});
    const double missing =
        term.kind == Kind::KeepClear ? term.distance - apart : apart - term.distance;
    return squared(std::max(0.0, missing) / body_);
  }
  static bool is_place(Kind kind) { return kind == Kind::Location || kind == Kind::Region; }
  static bool is_pair(Kind kind) { return kind == Kind::KeepClear || kind == Kind::Meet; }

  template <class Each>
  static void each_value(const Each& each, std::uint32_t tick, double value) {
    each(tick, value, value);
  }
  // A term over a course, tick by tick, to `each(tick, value, what is reported as the worst)`.
  template <class Each>
  void value(std::size_t index, const Course& course, const std::vector<Course>& all,
             const Each& each) const {
    const SceneTerm& term = role_.terms[index];
    const std::uint32_t end = std::min(term.to, ticks_);
    if (term.kind == Kind::Path) return path_value(paths_[index].front(), term, course, each);
    for (std::uint32_t t = term.from; t < end; ++t) {
      const Point p = point_of(course.places[t]);
      if (is_pair(term.kind))
        each_value(each, t, pair_value(term, p, point_of(all[term.other].places[t])));
      else if (is_place(term.kind))
        each_value(each, t, place_value(term, p));
      else
        each_value(each, t, sample_value(term, course.samples[course.at_tick[t]]));
    }
  }

  double cost(const Course& course, const std::vector<Course>& all) const {
    double sum = 0;
    for (std::size_t k = 1; k < course.samples.size(); ++k)
      sum +=
          static_cast<double>(sprite().transition_cost(course.samples[k - 1], course.samples[k]));
    for (std::size_t i = 0; i < role_.terms.size(); ++i)
      value(i, course, all,
            [&](std::uint32_t, double v, double) { sum += role_.terms[i].weight * v; });
    return sum;
  }

 private:
  struct Motion {
    double heading, speed;
  };

  // Segments are passed in order, as in search.h; beyond the end its last point counts.
  template <class Each>
  void path_value(const PathCost& path, const SceneTerm& term, const Course& course,
                  const Each& each) const {
    const Position origin = to_position(path.origin());
    const auto segments = path.segments();
    std::uint32_t l = 0;
    for (std::uint32_t t = term.from; t < std::min(term.to, ticks_); ++t) {
      const double x = static_cast<double>(course.places[t].x - origin.x);
      const double y = static_cast<double>(course.places[t].y - origin.y);
      const auto along = [&](const PathSegment& s) {
        return (x - s.x) * s.unit_x + (y - s.y) * s.unit_y;
      };
      while (l + 1 < segments.size() && along(segments[l]) >= segments[l].length) ++l;
      const PathSegment& s = segments[l];
      const double on = std::clamp(along(s), 0.0, s.length);
      const Point off{x - s.x - on * s.unit_x, y - s.y - on * s.unit_y};
      const bool is_over = along(s) >= s.length;
      const double apart = squared(length(off) / kPathUnit / body_);
      each(t, apart + (is_over ? 0 : path.angle(course.samples[course.at_tick[t]], l)), apart);
    }
  }

  const SceneRole& role_;
  std::uint32_t ticks_;
  double v0_ = 1, body_ = 1;
  int mode_ = 0;
  std::vector<Motion> motions_;
  std::vector<std::vector<PathCost>> paths_;  // (terms), one where the term is a path
};

// Draws changes of one course.
class Proposer {
 public:
  Proposer(const Role& role, Random& random) : role_(role), random_(random) {
    for (std::uint32_t i = 0; i < role.sprite().samples().size(); ++i)
      if (role.sprite().samples()[i].kept) kept_.push_back(i);
  }

  std::uint32_t any_sample() { return kept_[random_.below(kept_.size())]; }

  std::vector<std::uint32_t> draw(const Course& course) {
    const std::size_t n = course.samples.size(), at = random_.below(n);
    switch (random_.below(8)) {
      case 0:
        return fresh_start(course);
      case 1:
      case 2:
        return cut(course, at);
      case 3:
      case 4:
        return fresh_end(course, at);
      default:
        return detour(course, at);
    }
  }

 private:
  using Samples = std::vector<std::uint32_t>;

  // Half of the time towards what one of the terms wants, now or later.
  Direction direction(const Course& course, std::size_t at) {
    const auto anywhere = static_cast<Direction>(random_.below(kDirectionCount));
    if (random_.below(2) == 0 || role_.terms().empty()) return anywhere;
    const SceneTerm& term = role_.terms()[random_.below(role_.terms().size())];
    const auto tick = static_cast<std::uint32_t>(
        std::lower_bound(course.at_tick.begin(), course.at_tick.end(), at) -
        course.at_tick.begin());
    if (tick >= term.to) return anywhere;
    const Vec2 p = to_pixels(course.places[std::min<std::size_t>(tick, course.places.size() - 1)]);
    if (term.kind == Kind::Location) return nearest_direction({term.at.x - p.x, term.at.y - p.y});
    if (term.kind == Kind::Region)
      return nearest_direction(
          {(term.low.x + term.high.x) / 2 - p.x, (term.low.y + term.high.y) / 2 - p.y});
    if (term.kind != Kind::Path) return anywhere;
    const Vec2 next = ahead_on(term.points, p);
    return nearest_direction({next.x - p.x, next.y - p.y});
  }
  // A body length further on the path than its place nearest to `p`.
  Vec2 ahead_on(const std::vector<Vec2>& points, Vec2 p) const {
    Vec2 best = points.back();
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t k = 1; k < points.size(); ++k) {
      const Vec2 a = points[k - 1], d{points[k].x - a.x, points[k].y - a.y};
      const float square = d.x * d.x + d.y * d.y;
      if (square <= 0) continue;
      const float t = std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / square, 0.0f, 1.0f);
      const Vec2 off{a.x + t * d.x - p.x, a.y + t * d.y - p.y};
      const float apart = off.x * off.x + off.y * off.y;
      if (apart >= least) continue;
      least = apart;
      const float on = t + std::max(1.0f, role_.sprite().data().body_length) / std::sqrt(square);
      best = {a.x + on * d.x, a.y + on * d.y};
    }
    return best;
  }
  // The cheapest way from `sample` into old[first, last), or `last`.
  std::size_t rejoin(std::uint32_t sample, const Samples& old, std::size_t first,
                     std::size_t last) const {
    std::size_t best = last;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t b = first; b < last; ++b) {
      const float cost = role_.sprite().transition_cost(sample, old[b]);
      if (cost < least) {
        least = cost;
        best = b;
      }
    }
    return best;
  }
  Samples joined(Samples head, const Samples& old, std::size_t from) const {
    head.insert(head.end(), old.begin() + static_cast<std::ptrdiff_t>(from), old.end());
    return head;
  }
  Samples head_of(const Course& course, std::size_t at) const {
    return {course.samples.begin(), course.samples.begin() + static_cast<std::ptrdiff_t>(at) + 1};
  }

  Samples detour(const Course& course, std::size_t at) {
    const Samples& old = course.samples;
    Samples head = head_of(course, at);
    const Direction way = direction(course, at);
    const std::size_t due = 1 + random_.below(kLongestPart);
    for (std::size_t k = 0; k < due + kLongestPart; ++k) {
      head.push_back(role_.follow(head.back(), way));
      if (k < due || k % 4 != 0) continue;
      const std::size_t last = std::min(old.size(), at + k + kWindow);
      const std::size_t back = rejoin(head.back(), old, std::min(at + 1, last), last);
      if (back < last) return joined(std::move(head), old, back);
    }
    return head;  // the rest plays on by itself
  }
  Samples cut(const Course& course, std::size_t at) {
    const Samples& old = course.samples;
    const std::size_t skip = 2 + random_.below(kWindow);
    const std::size_t first = std::min(at + skip, old.size());
    const std::size_t last = std::min(first + 10, old.size());
    const std::size_t back = rejoin(old[at], old, first, last);
    return back < last ? joined(head_of(course, at), old, back) : old;
  }
  Samples fresh_end(const Course& course, std::size_t at) {
    Samples head = head_of(course, at);
    while (head.size() < course.samples.size() + kLongestPart) {
      const Direction way = direction(course, std::min(head.size(), course.samples.size()) - 1);
      const std::size_t end = head.size() + 10 + random_.below(2 * kLongestPart);
      while (head.size() < end) head.push_back(role_.follow(head.back(), way));
    }
    return head;
  }
  Samples fresh_start(const Course& course) {
    const Samples& old = course.samples;
    Samples head{any_sample()};
    const std::size_t last = std::min(old.size(), kWindow);
    for (std::size_t k = 0; k < kLongestPart; ++k) {
      const std::size_t back = rejoin(head.back(), old, 0, last);
      if (back < last) return joined(std::move(head), old, back);
      head.push_back(role_.follow(head.back(), direction(course, 0)));
    }
    return old;
  }

  const Role& role_;
  Random& random_;
  Samples kept_;
};

double total_cost(const std::vector<Role>& roles, const std::vector<Course>& courses) {
  double sum = 0;
  for (std::size_t r = 0; r < roles.size(); ++r) sum += roles[r].cost(courses[r], courses);
  return sum;
}

SceneResult result_of(const std::vector<Role>& roles, const std::vector<Course>& courses) {
  SceneResult out;
  for (std::size_t r = 0; r < roles.size(); ++r) {
    Clip clip;
    const Course& course = courses[r];
    for (std::size_t t = 0; t < course.places.size(); ++t) {
      ClipTick tick;
      const std::uint32_t k = course.at_tick[t];
      tick.sample = course.samples[k];
      tick.position = course.places[t];
      if (k > 0 && (t == 0 || course.at_tick[t - 1] != k))
        tick.transition = roles[r].sprite().transition_cost(course.samples[k - 1], tick.sample);
      tick.cost = static_cast<double>(tick.transition);
      clip.cost += tick.cost;
      clip.ticks.push_back(tick);
    }
    for (std::size_t i = 0; i < roles[r].terms().size(); ++i) {
      TermReport report{.role = r, .term = i};
      roles[r].value(i, course, courses, [&](std::uint32_t t, double v, double shown) {
        report.cost += roles[r].terms()[i].weight * v;
        clip.ticks[t].cost += roles[r].terms()[i].weight * v;
        if (shown <= report.worst) return;
        report.worst = shown;
        report.worst_tick = t;
      });
      clip.cost += report.cost;
      out.terms.push_back(report);
    }
    out.clips.push_back(std::move(clip));
  }
  out.cost = total_cost(roles, courses);
  return out;
}

std::vector<Role> make_roles(const Scene& scene) {
  std::vector<Role> roles;
  for (const SceneRole& role : scene.roles) roles.emplace_back(role, scene.ticks);
  return roles;
}

Error bad_term(std::size_t role, std::size_t term, const std::string& what) {
  return {ErrorCode::BadContent, "sprite " + std::to_string(role + 1) + ", term " +
                                     std::to_string(term + 1) + ": " + what};
}

Result<void> check_term(const Scene& scene, std::size_t r, std::size_t i) {
  const SceneTerm& term = scene.roles[r].terms[i];
  const Sprite& sprite = *scene.roles[r].sprite;
  for (const double v :
       {term.weight, static_cast<double>(term.at.x), static_cast<double>(term.at.y), term.radius,
        term.angle, term.speed, term.distance, static_cast<double>(term.low.x),
        static_cast<double>(term.low.y), static_cast<double>(term.high.x),
        static_cast<double>(term.high.y)})
    if (!std::isfinite(v)) return bad_term(r, i, "a number that is not finite");
  if (term.weight < 0) return bad_term(r, i, "a weight of 0 or more is due");
  if (Role::is_pair(term.kind) && (term.other >= scene.roles.size() || term.other == r))
    return bad_term(r, i,
                    "names sprite " + std::to_string(term.other + 1) + ": another of the " +
                        std::to_string(scene.roles.size()) + " is due");
  const bool is_there =
      term.sample < sprite.samples().size() && sprite.samples()[term.sample].kept != 0;
  if (term.kind == Kind::Pose && !is_there)
    return bad_term(r, i,
                    "sample " + std::to_string(term.sample) + " is not in " + sprite.data().name +
                        ": is the scene for another pack?");
  if (term.kind == Kind::Path)
    if (const auto path = PathCost::make(sprite, term.points, {}); !path)
      return bad_term(r, i, path.error().message);
  return {};
}

}  // namespace

Result<void> check_scene(const Scene& scene) {
  if (scene.roles.empty()) return Error{ErrorCode::BadContent, "a scene without a sprite"};
  if (scene.ticks == 0) return Error{ErrorCode::BadContent, "a scene of 0 s"};
  for (std::size_t r = 0; r < scene.roles.size(); ++r) {
    if (!std::isfinite(scene.roles[r].start.x) || !std::isfinite(scene.roles[r].start.y))
      return Error{ErrorCode::BadContent,
                   "sprite " + std::to_string(r + 1) + ": starts nowhere (not finite)"};
    for (std::size_t i = 0; i < scene.roles[r].terms.size(); ++i)
      if (auto checked = check_term(scene, r, i); !checked) return checked;
  }
  return {};
}

SceneResult replace_search(const Scene& scene, const ReplaceConfig& config) {
  const std::vector<Role> roles = make_roles(scene);
  Random random{config.seed};
  std::vector<Proposer> proposers;
  std::vector<Course> courses;
  for (std::size_t r = 0; r < roles.size(); ++r) {
    proposers.emplace_back(roles[r], random);
    courses.push_back(roles[r].lay_out(config.start.empty()
                                           ? std::vector{roles[r].sprite().data().start_sample}
                                           : config.start[r]));
  }
  double cost = total_cost(roles, courses), best_cost = cost;
  std::vector<Course> best = courses;
  std::uint64_t k = 0, accepted = 0;
  for (; k < config.proposals; ++k) {
    if (k % kTurn == 0 && config.go_on && !config.go_on(k, best_cost)) break;
    const std::size_t r = k / kTurn % roles.size();
    Course course = roles[r].lay_out(proposers[r].draw(courses[r]));
    std::swap(course, courses[r]);
    const double after = total_cost(roles, courses);
    const double warmth = kWarmth / (1 + static_cast<double>(k) / kCooling);
    const double luck = random.unit();
    if (after > cost + warmth * luck * luck * luck) {
      std::swap(course, courses[r]);
      continue;
    }
    ++accepted;
    cost = after;
    if (cost >= best_cost) continue;
    best_cost = cost;
    best = courses;
  }
  SceneResult out = result_of(roles, best);
  out.proposals = k;
  out.accepted = accepted;
  return out;
}

SceneResult scene_beam(const Scene& scene, int width) {
  struct Step {
    double cost;
    Position place;
    std::uint32_t sample, parent;
  };
  const std::vector<Role> roles = make_roles(scene);
  const Role& role = roles[0];
  const Sprite& sprite = role.sprite();
  const auto wish = [&](std::uint32_t tick, bool of_place, std::uint32_t sample, Position place) {
    double sum = 0;
    for (const SceneTerm& term : role.terms()) {
      if (tick < term.from || tick >= term.to || Role::is_place(term.kind) != of_place) continue;
      sum += term.weight *
             (of_place ? role.place_value(term, point_of(place)) : role.sample_value(term, sample));
    }
    return sum;
  };
  std::vector<std::vector<Step>> ticks(1);
  for (std::uint32_t i = 0; i < sprite.samples().size(); ++i) {
    const Position start = to_position(scene.roles[0].start);
    if (sprite.samples()[i].kept)
      ticks[0].push_back({wish(0, false, i, start) + wish(0, true, i, start), start, i, 0});
  }
  std::vector<double> by_sample(sprite.samples().size());
  std::vector<Step> now;  // some 75 times what is kept of it
  for (std::uint32_t t = 1; t < scene.ticks; ++t) {
    for (std::uint32_t i = 0; i < by_sample.size(); ++i) by_sample[i] = wish(t, false, i, {});
    const std::vector<Step>& before = ticks.back();
    now.clear();
    for (std::uint32_t p = 0; p < before.size(); ++p) {
      const Sample& s = sprite.samples()[before[p].sample];
      const Position place{before[p].place.x + s.step_x, before[p].place.y + s.step_y};
      const double paid = before[p].cost + wish(t, true, 0, place);
      for (const Transition& e : sprite.transitions(before[p].sample))
        now.push_back({paid + static_cast<double>(e.cost) + by_sample[e.to], place, e.to, p});
    }
    const auto less = [](const Step& a, const Step& b) {
      return std::tie(a.cost, a.parent, a.sample) < std::tie(b.cost, b.parent, b.sample);
    };
    if (now.size() > static_cast<std::size_t>(width)) {
      std::nth_element(now.begin(), now.begin() + width, now.end(), less);
      now.resize(static_cast<std::size_t>(width));
    }
    ticks.emplace_back(now.begin(), now.end());
  }
  std::uint32_t at = 0;
  for (std::uint32_t k = 0; k < ticks.back().size(); ++k)
    if (ticks.back()[k].cost < ticks.back()[at].cost) at = k;
  std::vector<std::uint32_t> samples(scene.ticks);
  for (std::uint32_t t = scene.ticks; t-- > 0; at = ticks[t][at].parent)
    samples[t] = ticks[t][at].sample;
  return result_of(roles, {role.lay_out(std::move(samples))});
}

}  // namespace vsprite
