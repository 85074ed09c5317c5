// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "control/bench.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "similarity/features.h"
#include "vsprite/actor.h"

namespace vsprite {
namespace {

constexpr double kFast[2] = {0.3, 0.7}, kSlow[2] = {1.5, 4};  // s between changes

// Settings went through single precision; as people write them.
double round_to(double value) { return std::round(value * 1e5) / 1e5; }

// What the solvers need, read off a loaded sprite.
struct Material {
  CostTable costs;
  std::vector<Vec2> velocities;
  std::vector<float> skip_costs;
  std::vector<std::uint16_t> durations;
  double v0 = 0, usual = 0;
  std::uint32_t served = 0;
  Motion motion() const { return {velocities, skip_costs, v0}; }
};

Material read_material(const Sprite& sprite) {
  const SpriteData& data = sprite.data();
  Material m;
  m.costs.row_start = data.row_start;
  m.costs.transitions = data.transitions;
  std::vector<std::string> tags;
  for (const Sample& s : data.samples) {
    tags.push_back(data.tags[s.tag]);
    m.costs.kept.push_back(static_cast<std::uint8_t>(s.kept));
    m.velocities.push_back(s.velocity);
    m.skip_costs.push_back(s.skip_cost);
    m.durations.push_back(s.duration);
  }
  m.costs.needed = needed_transitions(m.costs, tags);
  const SpeedScale speeds = measure_speeds(data.samples);
  m.usual = speeds.usual;
  m.v0 = usual_v0(speeds);
  m.served = data.modes.front().served & 0xFFu;
  return m;
}

// One grid: every combination that is worth a point of a curve.
std::vector<CurvePoint> make_grid(const Sprite& sprite) {
  std::vector<CurvePoint> grid;
  const auto& modes = sprite.data().modes;
  const auto add = [&](const CurvePoint& point) { grid.push_back(point); };
  CurvePoint point;
  point.mode = "paper";
  for (const ControlMode& mode : modes) {
    if (mode.by_state || mode.headings != 8) continue;
    point.paper = paper_config(mode);
    point.is_default = true;
    add(point);
    point.is_default = false;
    break;
  }
  for (const double cap : {0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    for (const double w1 : {0.04, 0.06, 0.08, 0.12, 0.15, 0.2, 0.3, 0.45, 0.6, 1.0, 1.5, 2.5}) {
      point.paper.cap = cap;
      point.paper.w1 = w1;
      add(point);
    }
  }
  point = {};
  point.mode = "responsive";
  for (const ControlMode& mode : modes) {
    if (!mode.by_state || mode.headings != 8) continue;
    point.joint = joint_config(mode);
    point.is_default = true;
    add(point);
    point.is_default = false;
    break;
  }
  const JointConfig base = point.joint;
  const double ratio = base.cruise_w1 > 0 ? base.turn_w1 / base.cruise_w1 : 10;
  for (const double cap : {0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    for (const double turn : {0.1, 0.2, 0.3, 0.5, 0.8, 1.2, 2.0, 4.0}) {
      point.joint.cap = cap;
      point.joint.turn_w1 = turn;
      point.joint.cruise_w1 = turn / ratio;
      add(point);
    }
  }
  return grid;
}

Result<Solution> solve_point(const Material& m, const CurvePoint& point) {
  if (point.mode == "paper") return solve(m.costs, m.velocities, m.v0, point.paper, 1);
  return solve_joint(m.costs, m.motion(), point.joint, m.served, 1);
}

Result<void> measure_point(const Sprite& sprite, const Material& m, const BenchConfig& config,
                           CurvePoint& point) {
  auto solution = solve_point(m, point);
  if (!solution) return solution.error();
  SpriteData data = sprite.data();
  ControlMode& mode = solution->mode;
  mode.served = m.served;
  mode.served_headings = m.served;
  mode.table_of = sprite.data().modes.front().table_of;
  data.modes.assign(1, std::move(mode));
  const auto trial = make_sprite(std::move(data));
  if (!trial) return trial.error();
  const double fps = trial->fps();

  SteerTally tally, fast;
  const auto run = [&](const KeyScript& script, double seconds, std::uint64_t seed,
                       SteerTally& into) {
    const auto frames = static_cast<std::uint64_t>(std::ceil(seconds * fps));
    tally_steering(*trial, 0, script, frames, seed, into);
  };
  if (config.script != nullptr) {
    run(*config.script, config.seconds, 1, tally);
  }
  for (const std::uint64_t seed : config.seeds) {
    if (config.script == nullptr)
      run(random_script(config.seconds, kSlow[0], kSlow[1], fps, seed), config.seconds, seed,
          tally);
    const double part = config.seconds / 4;
    run(random_script(part, kFast[0], kFast[1], fps, seed), part, seed, fast);
  }
  const SteerReport report = tally.report(fps);
  point.turn_median = report.turn_median;
  point.turn_p95 = report.turn_p95;
  point.first_change_median = report.first_change_median;
  point.first_change_p95 = report.first_change_p95;
  point.turns = report.turns;
  point.unfinished = report.unfinished;
  point.cost_mean = report.cost_mean;
  point.cost_p99 = report.cost_p99;
  point.cost_max = report.cost_max;
  point.jumps_per_second = report.jumps_per_second;
  point.share_slow = report.travel_share;
  point.share_fast = fast.report(fps).travel_share;
  point.speed_ratio = m.usual > 0 ? report.speed / m.usual : 0;
  int reached = 0;
  for (const DirectionReport& d : measure_directions(*trial, 0, 1)) {
    if ((m.served >> static_cast<int>(d.direction) & 1u) == 0) continue;
    const double error = d.raw_error_deg;
    point.tracking_mean += error;
    point.tracking_worst = std::max(point.tracking_worst, error);
    ++reached;
  }
  if (reached > 0) point.tracking_mean /= reached;
  return {};
}

}  // namespace

SolveConfig paper_config(const ControlMode& mode) {
  return {.alpha = round_to(static_cast<double>(mode.alpha)),
          .w1 = round_to(static_cast<double>(mode.w1)),
          .cap = round_to(static_cast<double>(mode.cap)),
          .free_steps = static_cast<int>(mode.stages) - 1,
          .headings = static_cast<int>(mode.headings)};
}

JointConfig joint_config(const ControlMode& mode) {
  const double exit_deg = round_to(static_cast<double>(mode.exit_angle) * 180 / kPi);
  return {.alpha = round_to(static_cast<double>(mode.alpha)),
          .cruise_w1 = round_to(static_cast<double>(mode.w1)),
          .turn_w1 = round_to(static_cast<double>(mode.turn_w1)),
          .cap = round_to(static_cast<double>(mode.cap)),
          .change_rate = static_cast<double>(mode.change_rate),
          .speed_weight = round_to(static_cast<double>(mode.speed_weight)),
          .play_through = mode.plays_through,
          .skip_price = round_to(static_cast<double>(mode.skip_price)),
          .bend_deg = round_to(static_cast<double>(mode.dead_angle) * 180 / kPi),
          .exit_deg = exit_deg > 0 ? exit_deg : JointConfig{}.exit_deg,
          .headings = static_cast<int>(mode.headings)};
}

Result<BenchResult> measure_curves(const Sprite& sprite, const BenchConfig& config,
                                   const std::function<void(double)>& progress) {
  const Material material = read_material(sprite);
  BenchResult result;
  result.curves = config.grid.empty() ? make_grid(sprite) : config.grid;
  const std::size_t count = result.curves.size();
  std::mutex mutex;
  std::size_t done = 0;
  std::optional<Error> error;
  tbb::task_arena arena(config.jobs > 0 ? config.jobs : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
      auto ok = measure_point(sprite, material, config, result.curves[k]);
      const std::scoped_lock lock(mutex);
      if (!ok && !error) error = ok.error();
      ++done;
      if (progress) progress(static_cast<double>(done) / static_cast<double>(count));
    });
  });
  if (error) return *error;
  for (int twentieths = 6; twentieths <= 20; ++twentieths) {
    result.floor.push_back(measure_reach(material.costs, material.motion(), material.durations,
                                         material.served, kCompassCount, twentieths / 20.0, true));
  }
  return result;
}

namespace {

// One diagram: each mode's points, its lower envelope as a line, the default ringed.
class Plot {
 public:
  Plot(double left, double top, double x_max, double y_max, std::string x_name, std::string y_name)
      : left_(left), top_(top), x_max_(x_max), y_max_(y_max) {
    out_ += "<g transform='translate(" + text(left) + " " + text(top) + ")'>";
    for (int k = 0; k <= 5; ++k) {
      const double x = kWidth * k / 5, y = kHeight - kHeight * k / 5;
      out_ += "<path class='grid' d='M" + text(x) + " 0V" + text(kHeight) + "M0 " + text(y) + "H" +
              text(kWidth) + "'/>";
      out_ += label(x, kHeight + 16, "middle", tick(x_max * k / 5));
      out_ += label(-6, y + 4, "end", tick(y_max * k / 5));
    }
    out_ += label(kWidth / 2, kHeight + 36, "middle", x_name);
    out_ += "<text transform='translate(-40 " + text(kHeight / 2) +
            ") rotate(-90)' text-anchor='middle'>" + y_name + "</text>";
  }
  void dot(double x, double y, const std::string& style, double radius) {
    if (x > x_max_ || y > y_max_) return;
    out_ += "<circle class='" + style + "' cx='" + text(px(x)) + "' cy='" + text(py(y)) + "' r='" +
            text(radius) + "'/>";
  }
  // Best y so far from left to right, as steps.
  void envelope(std::vector<std::pair<double, double>> points, const std::string& style) {
    std::sort(points.begin(), points.end());
    std::string path;
    double best = y_max_;
    for (const auto& [x, y] : points) {
      if (x > x_max_ || y >= best) continue;
      path += path.empty() ? "M" + text(px(x)) + " " + text(py(y))
                           : "H" + text(px(x)) + "V" + text(py(y));
      best = y;
    }
    if (!path.empty())
      out_ += "<path class='line " + style + "' d='" + path + "H" + text(kWidth) + "'/>";
  }
  std::string finish() { return out_ + "</g>\n"; }

  static constexpr double kWidth = 380, kHeight = 260;

 private:
  static std::string text(double value) {
    std::string digits = std::to_string(std::round(value * 10) / 10);
    digits.resize(digits.size() - 5);
    return digits;
  }
  static std::string tick(double value) {
    std::string digits = std::to_string(std::round(value * 100) / 100);
    digits.resize(digits.size() - 4);
    while (digits.back() == '0') digits.pop_back();
    if (digits.back() == '.') digits.pop_back();
    return digits;
  }
  static std::string label(double x, double y, const char* anchor, const std::string& what) {
    return "<text x='" + text(x) + "' y='" + text(y) + "' text-anchor='" + anchor + "'>" + what +
           "</text>";
  }
  double px(double x) const { return x / x_max_ * kWidth; }
  double py(double y) const { return kHeight - y / y_max_ * kHeight; }
  double left_, top_, x_max_, y_max_;
  std::string out_;
};

std::string diagram(const BenchResult& result, double left, double y_max, bool over_p99) {
  const double x_max = over_p99 ? 1.0 : 0.2;
  Plot plot(left, 46, x_max, y_max,
            over_p99 ? "transition cost, 99th percentile" : "transition cost, mean of all frames",
            "film frames to turn, median");
  for (const char* mode : {"paper", "responsive"}) {
    std::vector<std::pair<double, double>> points;
    for (const CurvePoint& p : result.curves) {
      if (p.mode != mode) continue;
      const double x = over_p99 ? p.cost_p99 : p.cost_mean;
      const bool tracks = p.tracking_worst <= 30;
      if (tracks) points.push_back({x, p.turn_median});
      plot.dot(x, p.turn_median, std::string(mode) + (tracks ? "" : " lost"), 2.2);
      if (p.is_default) plot.dot(x, p.turn_median, std::string("ring ") + mode, 6);
    }
    plot.envelope(points, mode);
  }
  if (over_p99) {
    std::vector<std::pair<double, double>> floor;
    for (const Reach& r : result.floor) floor.push_back({r.cap, r.floor});
    plot.envelope(floor, "floor");
  }
  return plot.finish();
}

}  // namespace

std::string curves_svg(const BenchResult& result, const std::string& title) {
  double y_max = 10;
  for (const CurvePoint& p : result.curves)
    if (p.tracking_worst <= 30) y_max = std::max(y_max, p.turn_median);
  y_max = std::min(50.0, std::ceil(y_max / 10) * 10);
  std::string name;
  for (const char c : title) name += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return "<svg xmlns='http://www.w3.org/2000/svg' width='940' height='380' viewBox='0 0 940 380' "
         "font-family='sans-serif' font-size='12' fill='#333'>\n<style>.grid{stroke:#ddd;fill:none}"
         ".paper{fill:#b4472c}.responsive{fill:#1f6fb4}.lost{opacity:.25}"
         ".line{fill:none;stroke-width:2}.line.paper{stroke:#b4472c}"
         ".line.responsive{stroke:#1f6fb4}.line.floor{stroke:#888;stroke-dasharray:4 4}"
         ".ring{fill:none;stroke-width:2}.ring.paper{stroke:#b4472c}"
         ".ring.responsive{stroke:#1f6fb4}</style>\n"
         "<rect width='940' height='380' fill='#fff'/>"
         "<text x='60' y='22' font-size='15' font-weight='bold'>" +
         name + ": response against smoothness</text>" +
         "<text x='60' y='38'><tspan fill='#b4472c'>paper</tspan>, <tspan "
         "fill='#1f6fb4'>responsive</tspan>: lines are the best at no higher cost, rings the "
         "defaults, pale dots lose their way; dashed: velocity floor by cap</text>\n" +
         diagram(result, 60, y_max, true) + diagram(result, 520, y_max, false) + "</svg>\n";
}

}  // namespace vsprite
