// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/report.h - what a run made, as a table for people and as JSON for scripts. Makes text only.
#pragma once

#include <string>
#include <vector>

#include "control/action_bench.h"
#include "control/bench.h"
#include "control/follow_bench.h"
#include "control/response.h"
#include "tool/stages.h"
#include "vsprite/pack.h"
#include "vsprite/puppet.h"
#include "vsprite/sprite.h"

namespace vsprite {

/// Stage table, what was dropped and why, held-out pairs, directions.
std::string build_text(const std::vector<StageOutcome>& outcomes);
/// The row `build` of the table in DESIGN section 4, with each stage's own figures beside.
Json build_json(const std::vector<StageOutcome>& outcomes);

std::string info_text(const std::string& path, const Sprite& sprite, const PackInfo& info);
Json info_json(const Sprite& sprite, const PackInfo& info);
/// dB; null where nothing was lost.
Json loss_json(const PackLoss& loss);
Json puppet_json(const Puppet& puppet);
/// One line: name, control points, faces, pictures, kernel.
std::string puppet_line(const Puppet& puppet);

std::string steer_text(const SteerReport& report, double fps);
Json steer_json(const SteerReport& report);
std::string bench_text(const BenchResult& result, double fps);
Json bench_json(const BenchResult& result);
std::string actions_text(const std::vector<ActionReport>& reports);
Json actions_json(const std::vector<ActionReport>& reports);
std::string follow_text(const FollowReport& report);
Json follow_json(const FollowReport& report);
std::string trace_csv(const std::vector<TraceRow>& rows);

/// "8.2 MB", "912 bytes".
std::string bytes_text(std::uint64_t bytes);
/// Fixed number of decimals.
std::string fixed_text(double value, int decimals);

}  // namespace vsprite
