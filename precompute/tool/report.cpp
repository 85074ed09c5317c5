// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/report.h"

#include <algorithm>
#include <cstdio>

#include "vsprite/geometry.h"

namespace vsprite {
namespace {

std::string padded(const std::string& text, std::size_t width, bool right = false) {
  if (text.size() >= width) return text;
  const std::string space(width - text.size(), ' ');
  return right ? space + text : text + space;
}

std::string count_text(const Json& result, const char* name) {
  const auto found = result.find(name);
  if (found == result.end() || !found->is_number()) return "?";
  std::string digits = std::to_string(found->get<std::int64_t>());
  for (std::size_t at = digits.size(); at > 3 && digits.size() > 4;) digits.insert(at -= 3, ",");
  return digits;
}

std::int64_t count_of(const Json& result, const char* name) {
  const auto found = result.find(name);
  return found == result.end() || !found->is_number() ? 0 : found->get<std::int64_t>();
}

double real_of(const Json& result, const char* name) {
  const auto found = result.find(name);
  return found == result.end() || !found->is_number() ? 0 : found->get<double>();
}

/// "a, b and c" of the parts that are not nothing.
std::string counted(const Json& result,
                    std::initializer_list<std::pair<const char*, const char*>> parts) {
  std::string out;
  for (const auto& [name, text] : parts) {
    if (count_of(result, name) == 0) continue;
    out += (out.empty() ? "" : ", ") + count_text(result, name) + " " + text;
  }
  return out;
}

std::vector<std::string> stage_lines(const StageOutcome& stage) {
  const Json& r = stage.result;
  std::vector<std::string> lines;
  if (stage.name == "segment") {
    lines.push_back(count_text(r, "frames") + " frames -> " + count_text(r, "samples") +
                    " samples in " + count_text(r, "clips") + " clips, " +
                    count_text(r, "duplicates") + " duplicates");
    const std::string dropped = counted(r, {{"dropped_border", "cut by the border"},
                                            {"dropped_empty", "without the subject"},
                                            {"dropped_touched", "touched by something"},
                                            {"dropped_hidden", "with the subject hidden"},
                                            {"dropped_short", "in clips that are too short"}});
    if (!dropped.empty()) lines.push_back("left out: " + dropped);
    const std::string time =
        counted(r, {{"cuts", "cuts"}, {"missing", "frames that the camera dropped"}});
    if (!time.empty()) lines.push_back("found: " + time);
    lines.push_back("noise of the velocity " + fixed_text(real_of(r, "velocity_noise"), 1) +
                    " px/s");
  } else if (stage.name == "train") {
    const Json c = r.value("confusion", Json::object());
    lines.push_back(count_text(r, "labels") + " pairs labelled by the film, " +
                    count_text(r, "acceptable") + " of them smooth");
    lines.push_back("held-out pairs: smooth " + count_text(c, "true_accept") + " accepted, " +
                    count_text(c, "false_reject") + " rejected; not smooth " +
                    count_text(c, "false_accept") + " accepted, " + count_text(c, "true_reject") +
                    " rejected");
  } else if (stage.name == "transitions") {
    lines.push_back(count_text(r, "pairs") + " pairs, " + count_text(r, "accepted") +
                    " accepted -> " + count_text(r, "transitions") + " transitions among " +
                    count_text(r, "kept") + " samples");
    const std::string lost = counted(r, {{"lost_clip_end", "at the end of a clip"},
                                         {"lost_dead_end", "without a way on"},
                                         {"lost_unreachable", "without a way in"}});
    if (!lost.empty()) lines.push_back("lost: " + lost);
    for (const Json& reason : r.value("reasons", Json::array()))
      if (reason.is_string()) lines.push_back(reason.get<std::string>());
  } else if (stage.name == "solve") {
    char text[160];
    std::snprintf(text, sizeof text, "%s tables, alpha %g, w1 %g, cap %g; values exact to %.2g",
                  count_text(r, "tables").c_str(), real_of(r, "alpha"), real_of(r, "w1"),
                  real_of(r, "cap"), real_of(r, "error_bound"));
    lines.push_back(text);
  } else if (stage.name == "pack") {
    lines.push_back(bytes_text(static_cast<std::uint64_t>(count_of(r, "pack_bytes"))));
  }
  return lines;
}

std::string directions_text(const Json& directions) {
  std::string out = "\n  direction    angle off   speed px/s\n";
  bool any = false;
  for (const Json& d : directions) {
    out += "  " + padded(d.value("name", ""), 13);
    if (d.value("reachable", false)) {
      const Json angle = d.value("tracking_error_deg", Json());
      out += padded(angle.is_number() ? fixed_text(angle.get<double>(), 1) : "-", 9, true) +
             padded(fixed_text(real_of(d, "speed"), 0), 13, true) + "\n";
    } else {
      out += "cannot be served: " +
             d.value("reason", std::string("the sprite does not travel that way")) + "\n";
    }
    any |= d.value("reachable", false);
  }
  if (!any)
    out += "\n  no direction can be steered: the pack is good, and its character plays by itself\n";
  return out;
}

Json direction_list(const ControlMode& mode) {
  Json list = Json::array();
  for (int d = 0; d < kCompassCount; ++d)
    if (mode.served >> d & 1u) list.push_back(direction_name(static_cast<Direction>(d)));
  return list;
}

Json mode_json(const ControlMode& mode) {
  return {{"mode", mode.name},
          {"alpha", mode.alpha},
          {"w1", mode.w1},
          {"cap", mode.cap},
          {"free_steps", mode.stages - 1},
          {"directions", direction_list(mode)},
          {"tables", kDirectionCount * mode.stages},
          {"residual", mode.residual},
          {"error_bound", mode.error_bound}};
}

std::array<int, 2> largest_picture(const SpriteData& data) {
  std::array<int, 2> size{};
  for (const Sample& sample : data.samples) {
    size[0] = std::max<int>(size[0], sample.width);
    size[1] = std::max<int>(size[1], sample.height);
  }
  return size;
}

std::uint32_t clip_count(const SpriteData& data) {
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < data.samples.size(); ++i)
    count += i == 0 || data.samples[i].clip != data.samples[i - 1].clip;
  return count;
}

std::size_t kept_count(const SpriteData& data) {
  return static_cast<std::size_t>(std::count_if(data.samples.begin(), data.samples.end(),
                                                [](const Sample& s) { return s.kept == 1; }));
}

}  // namespace

std::string fixed_text(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string bytes_text(std::uint64_t bytes) {
  if (bytes < 1000) return std::to_string(bytes) + " bytes";
  if (bytes < 1000000) return fixed_text(static_cast<double>(bytes) / 1e3, 1) + " kB";
  return fixed_text(static_cast<double>(bytes) / 1e6, 1) + " MB";
}

std::string build_text(const std::vector<StageOutcome>& outcomes) {
  std::string out = "  stage         seconds   peak MB  what came out\n";
  for (const StageOutcome& stage : outcomes) {
    out += "  " + padded(stage.name, 13);
    out += padded(stage.skipped ? "as is" : fixed_text(stage.seconds, 1), 8, true);
    out += padded(fixed_text(stage.peak_rss_mb, 0), 10, true) + "  ";
    const std::string indent(35, ' ');
    bool first = true;
    for (const std::string& line : stage_lines(stage)) {
      out += (first ? "" : indent) + line + "\n";
      first = false;
    }
    if (first) out += "\n";
  }
  for (const StageOutcome& stage : outcomes)
    if (stage.name == "pack" && stage.result.contains("directions"))
      out += directions_text(stage.result["directions"]);
  return out;
}

Json build_json(const std::vector<StageOutcome>& outcomes) {
  Json out = {{"stages", Json::array()}};
  for (const StageOutcome& stage : outcomes) {
    out["stages"].push_back({{"name", stage.name},
                             {"seconds", stage.seconds},
                             {"peak_rss_mb", stage.peak_rss_mb},
                             {"skipped", stage.skipped}});
    for (const auto& [name, value] : stage.result.items()) out[name] = value;
  }
  return out;
}

Json info_json(const Sprite& sprite, const PackInfo& info) {
  const SpriteData& data = sprite.data();
  Json tags = Json::array(), modes = Json::array(), sections = Json::array();
  for (const std::string& tag : data.tags)
    if (!tag.empty()) tags.push_back(tag);
  for (const ControlMode& mode : data.modes) modes.push_back(mode_json(mode));
  for (const PackSection& section : info.sections)
    sections.push_back(
        {{"name", section.name}, {"offset", section.offset}, {"bytes", section.bytes}});
  Json out = {{"version", std::to_string(info.major) + "." + std::to_string(info.minor)},
              {"name", data.name},
              {"samples", data.samples.size()},
              {"kept", kept_count(data)},
              {"clips", clip_count(data)},
              {"tags", tags},
              {"transitions", data.transitions.size()},
              {"fps", sprite.fps()},
              {"size", largest_picture(data)},
              {"body_length", data.body_length},
              {"modes", modes}};
  const int paper = sprite.find_mode("paper");
  if (paper >= 0) {
    const Json named = mode_json(data.modes[static_cast<std::size_t>(paper)]);
    for (const auto& [name, value] : named.items()) out[name] = value;
  }
  out["bytes"] = info.bytes;
  out["sections"] = sections;
  return out;
}

std::string info_text(const std::string& path, const Sprite& sprite, const PackInfo& info) {
  const SpriteData& data = sprite.data();
  const auto size = largest_picture(data);
  std::string out = path + ": " + data.name + ", version " + std::to_string(info.major) + "." +
                    std::to_string(info.minor) + ", " + bytes_text(info.bytes) + "\n";
  out += "  " + std::to_string(data.samples.size()) + " samples (" +
         std::to_string(kept_count(data)) + " kept) in " + std::to_string(clip_count(data)) +
         " clips, at most " + std::to_string(size[0]) + "x" + std::to_string(size[1]) +
         " px, body length " + fixed_text(double{data.body_length}, 1) + " px\n";
  out += "  " + std::to_string(data.transitions.size()) + " transitions, " +
         fixed_text(sprite.fps(), 2) + " ticks a second\n";
  for (const ControlMode& mode : data.modes) {
    std::string served;
    for (int d = 0; d < kCompassCount; ++d)
      if (mode.served >> d & 1u)
        served +=
            (served.empty() ? "" : ", ") + std::string(direction_name(static_cast<Direction>(d)));
    char text[200];
    std::snprintf(text, sizeof text,
                  "  mode %s: alpha %g, w1 %g, cap %g, K = %u, error bound %.2g\n",
                  mode.name.c_str(), double{mode.alpha}, double{mode.w1}, double{mode.cap},
                  mode.stages - 1, mode.error_bound);
    out += text;
    out += "    serves " +
           (served.empty() ? std::string("no direction: it plays by itself") : served) + "\n";
  }
  for (const PackSection& section : info.sections)
    out += "  section " + section.name + "  " + bytes_text(section.bytes) + "\n";
  return out;
}

Json steer_json(const SteerReport& report) {
  Json out = {{"frames", report.frames},
              {"states_hash", hex64(report.states_hash)},
              {"tracking_error_deg", nullptr}};
  if (report.tracking_error_deg) out["tracking_error_deg"] = *report.tracking_error_deg;
  out["frames_to_turn"] = {{"median", nullptr}, {"p95", nullptr}};
  if (report.turns > 0)
    out["frames_to_turn"] = {{"median", report.turn_median}, {"p95", report.turn_p95}};
  out["turns"] = report.turns;
  out["unfinished"] = report.unfinished;
  out["transition_cost"] = {
      {"mean", report.cost_mean}, {"p99", report.cost_p99}, {"max", report.cost_max}};
  out["jumps_per_second"] = report.jumps_per_second;
  out["freezes"] = report.freezes;
  return out;
}

std::string steer_text(const SteerReport& report, double fps) {
  std::string out = "  " + std::to_string(report.frames) + " frames (" +
                    fixed_text(static_cast<double>(report.frames) / fps, 1) + " s), states " +
                    hex64(report.states_hash) + "\n";
  if (report.tracking_error_deg)
    out += "  angle off the command   " + fixed_text(*report.tracking_error_deg, 1) + " degrees\n";
  if (report.turns > 0)
    out += "  frames to turn          median " + fixed_text(report.turn_median, 1) + " (" +
           fixed_text(1000 * report.turn_median / fps, 0) + " ms), 95 % " +
           fixed_text(report.turn_p95, 1) + " (" + fixed_text(1000 * report.turn_p95 / fps, 0) +
           " ms); " + std::to_string(report.unfinished) + " of " + std::to_string(report.turns) +
           " unfinished\n";
  out += "  transition cost         mean " + fixed_text(report.cost_mean, 4) + ", 99 % " +
         fixed_text(report.cost_p99, 3) + ", largest " + fixed_text(report.cost_max, 3) + "\n";
  out += "  jumps a second          " + fixed_text(report.jumps_per_second, 2) + "\n";
  out += "  freezes                 " + std::to_string(report.freezes) + "\n";
  return out;
}

std::string trace_csv(const std::vector<TraceRow>& rows) {
  std::string out = "frame,sample,x,y,direction,table,cost\n";
  for (const TraceRow& row : rows)
    out += std::to_string(row.frame) + "," + std::to_string(row.sample) + "," + number_text(row.x) +
           "," + number_text(row.y) + "," + std::string(direction_name(row.direction)) + "," +
           std::to_string(row.table) + "," + number_text(row.cost) + "\n";
  return out;
}

}  // namespace vsprite
