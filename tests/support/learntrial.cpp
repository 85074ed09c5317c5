// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// learntrial WORK [STRIPS.png [count [w1 [cap]]]] - what a film teaches: labels, classifier,
// transitions, tables and how they steer, printed; film strips of jumps and of a turn to look at.
// WORK: a work folder whose stage `segment` has run. `-` for no strips.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>

#include "control/response.h"
#include "control/solve.h"
#include "similarity/features.h"
#include "similarity/label.h"
#include "similarity/transitions.h"
#include "tool/pictures.h"
#include "tool/project.h"
#include "vsprite/actor.h"
#include "vsprite/random.h"

using namespace vsprite;

namespace {

struct Film {
  double fps = 30;
  std::vector<SampleRow> rows;
  std::vector<Image> pictures;
};

int fail(const Error& error) {
  std::fprintf(stderr, "learntrial: error: %s\n", error.message.c_str());
  return 1;
}

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Result<Film> load_film(const std::string& folder) {
  const auto project = Project::look(folder);
  if (!project) return project.error();
  const auto facts = project->film();
  if (!facts) return facts.error();
  auto rows = project->samples();
  if (!rows) return rows.error();
  Film film{facts->fps(), std::move(*rows), {}};
  PictureReader reader(*project, film.rows);
  for (int i = 0; i < static_cast<int>(film.rows.size()); ++i) {
    auto picture = reader.picture(i);
    if (!picture) return picture.error();
    film.pictures.push_back(std::move(*picture));
  }
  return film;
}

// The picture of a sample, aligned at its anchor in a square of `side`, over a mid grey.
void paint(const Film& film, std::size_t i, int side, Image& sheet, int left, int top) {
  const SampleRow& r = film.rows[i];
  const Image& image = film.pictures[i];
  const int dx = left + side / 2 - static_cast<int>((r.anchor_x - r.left) * r.scale);
  const int dy = top + side / 2 - static_cast<int>((r.anchor_y - r.top) * r.scale);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int u = x + dx, v = y + dy;
      if (u < left || v < top || u >= left + side || v >= top + side) continue;
      const std::uint8_t* p = image.rgba.data() + 4 * (y * image.width + x);
      std::uint8_t* q = sheet.rgba.data() + 4 * (v * sheet.width + u);
      for (int k = 0; k < 3; ++k)
        q[k] = static_cast<std::uint8_t>((p[k] * p[3] + 150 * (255 - p[3])) / 255);
    }
  }
}

SpriteData sprite_data(const Film& film, const CostTable& costs, const Solution& solution) {
  SpriteData data;
  data.fps_numerator = static_cast<std::uint32_t>(film.fps * 1000);
  data.fps_denominator = 1000;
  data.start_sample = kNoSample;
  for (std::size_t i = 0; i < film.rows.size(); ++i) {
    const SampleRow& r = film.rows[i];
    Sample s;
    const double scale = r.scale;
    s.velocity = {static_cast<float>(r.velocity_x * scale),
                  static_cast<float>(r.velocity_y * scale)};
    s.step_x = step_per_tick(s.velocity.x, data.fps_numerator, data.fps_denominator);
    s.step_y = step_per_tick(s.velocity.y, data.fps_numerator, data.fps_denominator);
    s.area = static_cast<float>(r.area * scale * scale);
    s.duration = static_cast<std::uint16_t>(r.duration);
    s.clip = static_cast<std::uint32_t>(r.clip);
    s.frame = static_cast<std::uint32_t>(r.frame);
    s.kept = costs.kept[i];
    s.width = s.kept ? static_cast<std::uint16_t>(film.pictures[i].width) : std::uint16_t{0};
    s.height = s.kept ? static_cast<std::uint16_t>(film.pictures[i].height) : std::uint16_t{0};
    if (s.kept && data.start_sample == kNoSample) data.start_sample = static_cast<std::uint32_t>(i);
    data.samples.push_back(s);
  }
  data.row_start = costs.row_start;
  data.transitions = costs.transitions;
  data.modes.push_back(solution.mode);
  return data;
}

// What a player sees: jumps of an hour of random steering out of moving samples, cheapest first
// (i-1, i | j, j+1, then i+1 as filmed), then a turn from right to left, every second tick.
void write_strips(const Film& film, const FeatureSet& set, const Sprite& sprite, const char* path,
                  int count) {
  struct Jump {
    double cost;
    std::size_t i, j;
  };
  std::vector<TraceRow> trace;
  measure_steering(sprite, 0, random_script(3600, 1.5, 4, film.fps, 1), 100000, 1, &trace);
  std::vector<Jump> all, jumps;
  for (std::size_t t = 1; t < trace.size(); ++t) {
    const std::size_t i = trace[t - 1].sample;
    const bool moves = static_cast<double>(set.samples[i].speed) > set.moving_speed;
    if (trace[t].cost > 0 && moves) all.push_back({trace[t].cost, i, trace[t].sample});
  }
  Random random{7};
  for (int k = 0; k < count && !all.empty(); ++k) jumps.push_back(all[random.below(all.size())]);
  std::sort(jumps.begin(), jumps.end(),
            [](const Jump& a, const Jump& b) { return a.cost < b.cost; });
  constexpr int kPer = 5, kColumns = 2, kTurnRows = 3;
  const int side = std::min(200, static_cast<int>(set.cell * set.grid * film.rows[0].scale) + 2);
  const int rows = (count + kColumns - 1) / kColumns, wide = kPer * side + 12;
  Image sheet{kColumns * wide, (rows + kTurnRows) * (side + 4), {}};
  sheet.rgba.assign(4u * static_cast<std::size_t>(sheet.width * sheet.height), 150);
  for (std::size_t p = 3; p < sheet.rgba.size(); p += 4) sheet.rgba[p] = 255;
  for (int k = 0; k < static_cast<int>(jumps.size()); ++k) {
    const Jump& jump = jumps[static_cast<std::size_t>(k)];
    const int left = k / rows * wide, top = k % rows * (side + 4);
    const std::size_t shown[kPer] = {jump.i > 0 ? jump.i - 1 : 0, jump.i, jump.j,
                                     std::min(jump.j + 1, film.rows.size() - 1), jump.i + 1};
    for (int c = 0; c < kPer; ++c) paint(film, shown[c], side, sheet, left + c * side, top);
    std::printf("  strip %2d: %5zu -> %5zu T %.2f\n", k, jump.i, jump.j, jump.cost);
  }
  measure_steering(sprite, 0, *parse_key_script("0 right; 4 left", film.fps), 300, 1, &trace);
  const auto key = trace.size() - 300 + static_cast<std::size_t>(4 * film.fps);
  for (int k = 0; k < kTurnRows * kColumns * kPer; ++k) {
    const TraceRow& row = trace[std::min(key + 2 * static_cast<std::size_t>(k), trace.size() - 1)];
    const int per_row = kColumns * kPer;
    paint(film, row.sample, side, sheet, k % per_row * side, (rows + k / per_row) * (side + 4));
  }
  const auto png = encode_png(sheet);
  if (!png) return;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(png->data()), static_cast<std::streamsize>(png->size()));
}

void print_sprite(const Sprite& sprite) {
  for (const DirectionReport& d : measure_directions(sprite, 0, 1)) {
    std::printf("  %-10s %s error %5.1f deg speed %6.1f px/s\n",
                std::string(direction_name(d.direction)).c_str(), d.reachable ? "ok" : "--",
                d.tracking_error_deg.value_or(-1), d.speed);
  }
  double start = seconds();
  const auto frames = static_cast<std::uint64_t>(3600 * sprite.fps());
  const SteerReport steer =
      measure_steering(sprite, 0, random_script(3600, 1.5, 4, sprite.fps(), 1), frames, 1);
  std::printf(
      "steer 1 h (%.2f s): to turn median %.1f p95 %.1f of %d, unfinished %d; T mean %.3f p99 %.3f "
      "max %.3f; %.2f jumps/s; freezes %llu\n",
      seconds() - start, steer.turn_median, steer.turn_p95, steer.turns, steer.unfinished,
      steer.cost_mean, steer.cost_p99, steer.cost_max, steer.jumps_per_second,
      static_cast<unsigned long long>(steer.freezes));
  for (const char* keys : {"0 none", "0 right; 4 rest"}) {
    std::vector<TraceRow> trace;
    const SteerReport r =
        measure_steering(sprite, 0, *parse_key_script(keys, sprite.fps()), 900, 1, &trace);
    std::map<std::uint32_t, int> seen;
    double speed = 0;
    for (std::size_t t = 600; t < trace.size(); ++t) {
      ++seen[trace[t].sample];
      const Vec2 v = sprite.samples()[trace[t].sample].velocity;
      speed += std::sqrt(static_cast<double>(v.x * v.x + v.y * v.y)) / 300;
    }
    std::printf("'%s': last 300 ticks %zu samples, %.2f jumps/s, mean speed %.1f px/s\n", keys,
                seen.size(), r.jumps_per_second, speed);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  auto loaded = load_film(argv[1]);
  if (!loaded) return fail(loaded.error());
  const Film film = std::move(*loaded);
  double start = seconds();
  const FeatureSet set = make_feature_set(film.rows, film.fps, kDefaultGrid, [&](int i) {
    return film.pictures[static_cast<std::size_t>(i)];
  });
  std::printf(
      "%zu samples, %d clips, cell %.2f px, moving %.1f px/s, v0 %.1f px/s, scale %.2f (%.2f s)\n",
      film.rows.size(), film.rows.back().clip + 1, set.cell, set.moving_speed, set.v0,
      film.rows[0].scale, seconds() - start);
  start = seconds();
  const auto labels = bootstrap_labels(set, 4000, 1);
  const auto training = train(set, labels, {});
  if (!training) return fail(training.error());
  const Confusion& c = training->held_out;
  std::printf("%zu labels: accept right %d wrong %d, reject right %d wrong %d (%.2f s)\n",
              labels.size(), c.true_accept, c.false_accept, c.true_reject, c.false_reject,
              seconds() - start);
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    std::printf(
        "  %-10s weight x sd / threshold %.3f  sd %.3g\n", kFeatureNames[k],
        training->classifier.weights[k] * training->spread[k] / training->classifier.threshold,
        training->spread[k]);
  }
  start = seconds();
  TransitionStats stats;
  const auto pairs = accepted_pairs(set, training->classifier, 0, &stats.compared);
  const double compare_seconds = seconds() - start;
  start = seconds();
  const auto costs = make_cost_table(set, pairs, {}, stats);
  std::printf("%zu pairs compared %.2f %% accepted %.2f %% (%.2f s), ",
              static_cast<std::size_t>(stats.pairs),
              100.0 * static_cast<double>(stats.compared) / static_cast<double>(stats.pairs),
              100.0 * static_cast<double>(stats.accepted) / static_cast<double>(stats.pairs),
              compare_seconds);
  if (!costs) return fail(costs.error());
  std::printf("%zu transitions, kept %d, clip end %d, dead end %d, unreachable %d (%.2f s)\n",
              static_cast<std::size_t>(stats.transitions), stats.kept, stats.lost_clip_end,
              stats.lost_dead_end, stats.lost_unreachable, seconds() - start);
  for (const std::string& reason : stats.reasons) std::printf("  %s\n", reason.c_str());
  SolveConfig config;
  if (argc > 4) config.w1 = std::atof(argv[4]);
  if (argc > 5) config.cap = std::atof(argv[5]);
  std::vector<Vec2> velocities;
  for (const FeatureSample& s : set.samples) velocities.push_back({s.velocity_x, s.velocity_y});
  start = seconds();
  const auto solution = solve(*costs, velocities, set.v0, config);
  if (!solution) return fail(solution.error());
  std::printf("w1 %.3f, residual %.2g, bound %.2g (%.2f s)\n", solution->mode.w1,
              solution->mode.residual, solution->mode.error_bound, seconds() - start);
  auto sprite = make_sprite(sprite_data(film, *costs, *solution));
  if (!sprite) return fail(sprite.error());
  print_sprite(*sprite);
  if (argc > 2 && argv[2][0] != '-')
    write_strips(film, set, *sprite, argv[2], argc > 3 ? std::atoi(argv[3]) : 20);
  return 0;
}
