// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The stage `solve`: both modes, each measured with the engine's own actor before anybody relies on
// what it serves.
#include <algorithm>
#include <bit>

#include "control/joint.h"
#include "control/reach.h"
#include "tool/build_pack.h"
#include "tool/stages.h"

namespace vsprite {
namespace {

// Everything that both modes are solved from.
struct SolveInput {
  FilmFacts film;
  std::vector<SampleRow> rows;
  TransitionFile file;
  std::vector<Vec2> velocities;
  std::vector<std::uint16_t> durations;
  Motion motion() const { return {velocities, file.skip_costs, file.v0}; }
};

Result<SolveInput> read_input(StageRun& run) {
  auto film = run.project.film();
  if (!film) return film.error();
  auto rows = run.project.samples();
  if (!rows) return rows.error();
  auto file = run.project.transitions(rows->size());
  if (!file) return file.error();
  SolveInput input{std::move(*film), std::move(*rows), std::move(*file), {}, {}};
  std::vector<std::string> tags;
  for (const SampleRow& row : input.rows) {
    input.velocities.push_back(
        {static_cast<float>(row.velocity_x), static_cast<float>(row.velocity_y)});
    input.durations.push_back(static_cast<std::uint16_t>(row.duration));
    tags.push_back(row.tag);
  }
  input.file.costs.needed = needed_transitions(input.file.costs, tags);
  return input;
}

// Headings solved, and of the eight directions those that may be served: two and four are every
// fourth and every second of the eight.
int heading_count(const Settings& settings) {
  return settings.directions == "16" ? 16 : settings.directions == "32" ? 32 : kCompassCount;
}
std::uint32_t wanted_directions(const Settings& settings) {
  return settings.directions == "2" ? 0x11u : settings.directions == "4" ? 0x55u : 0xFFu;
}

// Runs a mode and narrows what it serves to what it was seen to travel.
Result<void> measure_mode(const SolveInput& input, const Settings& settings, Solution& solution) {
  auto data = make_sprite_data(input.film, input.rows, input.file, {}, {});
  if (!data) return data.error();
  data->modes.push_back(solution.mode);
  const auto sprite = make_sprite(std::move(*data));
  if (!sprite) return sprite.error();
  serve(*sprite, 0, settings.seed, wanted_directions(settings), solution.mode);
  return {};
}

// What an edit of transitions.bin may have done to the kept samples; they are solved all the same.
Json part_reasons(const CostTable& costs) {
  const Components parts = find_components(costs);
  std::vector<std::uint8_t> holds_kept(parts.count, 0);
  for (std::size_t i = 0; i < costs.kept.size(); ++i)
    if (costs.kept[i] != 0) holds_kept[parts.of[i]] = 1;
  const auto count = std::count(holds_kept.begin(), holds_kept.end(), std::uint8_t{1});
  if (count < 2) return Json::array();
  return Json::array(
      {"the kept samples fall into " + std::to_string(count) +
       " parts, without a way from each to every other: a sprite goes where its own part does, " +
       "`vsprite transitions --force transitions` keeps one part"});
}

Spread spread_of(const StageRun& run, const SolveInput& input, const SolveOrder& order) {
  if (!run.sharing.spread) return {};
  return run.sharing.spread(input.file.costs, input.motion(), order);
}

Result<Solution> solve_paper(const SolveInput& input, const StageRun& run) {
  const Settings& settings = run.settings;
  const SolveConfig config{.alpha = settings.alpha,
                           .w1 = settings.w1,
                           .cap = settings.cap,
                           .free_steps = settings.free_steps,
                           .headings = heading_count(settings),
                           .iterate = settings.solver == "iterate"};
  auto solution = solve(input.file.costs, input.velocities, input.file.v0, config, settings.jobs,
                        spread_of(run, input, {.paper = config}));
  if (!solution) return solution;
  if (auto ok = measure_mode(input, settings, *solution); !ok) return ok.error();
  return solution;
}

// `expected`: headings that the player may command. What turns out not to be served is not
// expected either, and the problem is solved again without it.
Result<Solution> solve_responsive(const SolveInput& input, const StageRun& run,
                                  std::uint32_t expected) {
  const Settings& settings = run.settings;
  const int headings = heading_count(settings);
  const bool play_through = settings.play_through == "on";
  JointConfig config{.alpha = settings.response_alpha,
                     .cruise_w1 = settings.cruise_w1,
                     .turn_w1 = settings.turn_w1,
                     .cap = settings.response_cap,
                     .change_rate = std::min(0.5, settings.change_rate / input.film.fps()),
                     .speed_weight = settings.speed_weight,
                     .play_through = play_through,
                     .skip_price = settings.skip_price,
                     .bend_deg = settings.bend,
                     .exit_deg = settings.exit_angle,
                     .headings = headings};
  if (config.cap == 0) {
    config.cap = choose_cap(input.file.costs, input.motion(), input.durations, expected, headings,
                            play_through);
  }
  for (int round = 0;; ++round) {
    auto solution =
        solve_joint(input.file.costs, input.motion(), config, expected, settings.jobs,
                    spread_of(run, input, {.is_joint = true, .joint = config, .served = expected}));
    if (!solution) return solution;
    if (auto ok = measure_mode(input, settings, *solution); !ok) return ok.error();
    const std::uint32_t served = solution->mode.served_headings;
    if (round > 0 || (served & expected) == expected) return solution;
    expected &= served;
  }
}

Json mode_result(const ControlMode& mode) {
  return {{"alpha", mode.alpha},
          {"w1", mode.w1},
          {"cap", mode.cap},
          {"tables", mode.tables()},
          {"directions", std::popcount(mode.served & 0xFFu)},
          {"residual", mode.residual},
          {"error_bound", mode.error_bound}};
}

}  // namespace

Json solve_settings(const Settings& s) {
  return {{"alpha", s.alpha},
          {"w1", s.w1},
          {"cap", s.cap},
          {"free-steps", s.free_steps},
          {"solver", s.solver},
          {"directions", s.directions},
          {"response-alpha", s.response_alpha},
          {"response-cap", s.response_cap},
          {"cruise-w1", s.cruise_w1},
          {"turn-w1", s.turn_w1},
          {"change-rate", s.change_rate},
          {"speed-weight", s.speed_weight},
          {"play-through", s.play_through},
          {"skip-price", s.skip_price},
          {"bend", s.bend},
          {"exit", s.exit_angle},
          {"seed", s.seed},
          {"format", kTableVersion}};
}

Result<Json> solve_tables(StageRun& run) {
  const auto input = read_input(run);
  if (!input) return input.error();
  auto paper = solve_paper(*input, run);
  if (!paper) return Error{paper.error().code, run.project.folder() + ": " + paper.error().message};
  auto responsive = solve_responsive(*input, run, paper->mode.served_headings);
  if (!responsive)
    return Error{responsive.error().code, run.project.folder() + ": " + responsive.error().message};
  Json result = mode_result(paper->mode);
  result["free_steps"] = run.settings.free_steps;
  result["responsive"] = mode_result(responsive->mode);
  result["reasons"] = part_reasons(input->file.costs);
  ValueFile values;
  values.modes.push_back(std::move(*responsive));
  values.modes.push_back(std::move(*paper));
  if (auto wrote = write_file(run.project.path("values.bin"), format_values(std::move(values)));
      !wrote)
    return wrote.error();
  return result;
}

}  // namespace vsprite
