// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "tool/cast.h"
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

/// "1 clip", "1,234 clips".
std::string count_text(const Json& result, const char* name, const char* one) {
  return count_text(result, name) + " " + one + (count_of(result, name) == 1 ? "" : "s");
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

std::string confusion_text(const Json& c) {
  return "smooth " + count_text(c, "true_accept") + " accepted, " + count_text(c, "false_reject") +
         " rejected; not smooth " + count_text(c, "false_accept") + " accepted, " +
         count_text(c, "true_reject") + " rejected";
}

/// Whose labels they are stands first; how far they can be trusted follows.
std::vector<std::string> train_lines(const Json& r) {
  std::vector<std::string> lines;
  const std::int64_t person = count_of(r, "by_person");
  if (person == 0) {
    lines.push_back(count_text(r, "labels") + " pairs labelled by the film (bootstrap), " +
                    count_text(r, "acceptable") + " of them smooth");
  } else {
    lines.push_back(count_text(r, "by_person") + " pairs labelled by a person; the film's own " +
                    std::to_string(count_of(r, "labels") - person) + " (bootstrap) weigh " +
                    count_text(r, "film_labels_worth") + " answers");
    lines.push_back("held-out answers: " + confusion_text(r.value("confusion_by_person", Json())));
  }
  lines.push_back("held-out pairs: " + confusion_text(r.value("confusion", Json::object())));
  std::string weights;
  const Json shares = r.value("weight_shares", Json::object());
  for (const auto& [name, share] : shares.items())
    weights += (weights.empty() ? "" : ", ") + name + " " + fixed_text(real_of(share, "mean"), 2) +
               " +- " + fixed_text(real_of(share, "sd"), 2);
  if (!weights.empty()) lines.push_back("weight x sd over the folds: " + weights);
  if (const Json e = r.value("false_accepts", Json::object()); count_of(e, "accepted") > 0)
    lines.push_back("drawn at random: " + count_text(e, "wrong") + " of " +
                    count_text(e, "accepted") + " accepted pairs were called a jump; at most " +
                    fixed_text(100 * real_of(e, "likely_at_most"), 1) + " % in the film");
  if (r.contains("moved"))
    lines.push_back("threshold moved to " + fixed_text(real_of(r, "moved"), 3));
  const std::string odd =
      counted(r.value("answers", Json::object()),
              {{"gone", "about samples that are not here (kept, not used)"},
               {"repeated", "superseded by a later one"},
               {"disagreeing", "of these said the opposite (the last counts)"}});
  if (!odd.empty()) lines.push_back("answers: " + odd);
  for (const Json& warning : r.value("label_warnings", Json::array()))
    if (warning.is_string()) lines.push_back(warning.get<std::string>());
  return lines;
}

std::string loss_text(const Json& loss) {
  const auto ratio = [&](const char* key) {
    return loss[key].is_number() ? fixed_text(loss[key].get<double>(), 1) + " dB" : "exact";
  };
  return "colour " + ratio("colour_psnr_db") + ", alpha " + ratio("alpha_psnr_db") + " PSNR";
}

/// What a smaller pack costs.
std::string budget_text(const Json& r) {
  const Json whole = r.value("whole", Json::object()), fitted = r.value("fitted", Json::object());
  return "of " + bytes_text(static_cast<std::uint64_t>(count_of(whole, "bytes"))) + " and " +
         count_text(whole, "samples") + " samples " + count_text(fitted, "samples") +
         " stay; frames to turn in the median: " + fixed_text(real_of(whole, "turn_median"), 0) +
         " before, " + fixed_text(real_of(fitted, "turn_median"), 0) + " now";
}

/// What joins the tags of a cast, each pair of tags once, at its cheapest; inside a tag only what
/// is dear.
std::vector<std::string> join_lines(const Json& r) {
  std::vector<std::string> lines;
  std::map<std::pair<std::string, std::string>, std::pair<double, std::string>> cheapest;
  for (const Json& join : r.value("joins", Json::array())) {
    const std::string from = join.value("from_tag", ""), to = join.value("to_tag", "");
    const double cost = real_of(join, "cost");
    if (from == to && cost <= 1) continue;
    const std::pair offer(cost, join.value("text", ""));
    const auto [at, fresh] = cheapest.try_emplace({from, to}, offer);
    at->second = std::min(at->second, offer);
  }
  for (const auto& [tags, join] : cheapest) lines.push_back(join.second);
  return lines;
}

std::vector<std::string> stage_lines(const StageOutcome& stage) {
  const Json& r = stage.result;
  std::vector<std::string> lines;
  const auto add_reasons = [&] {
    for (const Json& reason : r.value("reasons", Json::array()))
      if (reason.is_string()) lines.push_back(reason.get<std::string>());
  };
  if (stage.name == "segment") {
    lines.push_back(count_text(r, "frames", "frame") + " -> " + count_text(r, "samples", "sample") +
                    " in " + count_text(r, "clips", "clip") + ", " +
                    count_text(r, "duplicates", "duplicate"));
    lines.push_back("background: " + r.value("background", ""));
    const std::string dropped = counted(r, {{"dropped_border", "cut by the border"},
                                            {"dropped_empty", "without the subject"},
                                            {"dropped_touched", "touched by something"},
                                            {"dropped_hidden", "with the subject hidden"},
                                            {"dropped_short", "in clips that are too short"}});
    if (!dropped.empty()) lines.push_back("left out: " + dropped);
    const Json pictures = r.value("dropped", Json::object());
    for (const auto& [reason, shown] : pictures.items())
      lines.push_back("  " + fixed_text(100 * real_of(shown, "share"), 1) + " % " + reason +
                      ", for instance frame " + count_text(shown, "frame") + ": " +
                      shown.value("picture", ""));
    const std::string time =
        counted(r, {{"cuts", count_of(r, "cuts") == 1 ? "cut" : "cuts"},
                    {"missing", count_of(r, "missing") == 1 ? "frame that the camera left out"
                                                            : "frames that the camera left out"}});
    if (!time.empty()) lines.push_back("found: " + time);
    for (const Json& clip : r.value("cast", Json::array()))
      if (const std::string line = describe_matching(clip); !line.empty())
        lines.push_back("matched " + line);
    lines.push_back("noise of the velocity " + fixed_text(real_of(r, "velocity_noise"), 1) +
                    " px/s");
    for (const Json& warning : r.value("warnings", Json::array()))
      lines.push_back("warning: " + warning.get<std::string>());
  } else if (stage.name == "train") {
    lines = train_lines(r);
  } else if (stage.name == "transitions") {
    lines.push_back(count_text(r, "pairs") + " pairs, " + count_text(r, "accepted") +
                    " accepted -> " + count_text(r, "transitions") + " transitions among " +
                    count_text(r, "kept") + " samples");
    const std::string lost = counted(r, {{"lost_clip_end", "at the end of a clip"},
                                         {"lost_dead_end", "without a way on"},
                                         {"lost_unreachable", "without a way in"}});
    if (!lost.empty()) lines.push_back("lost: " + lost);
    add_reasons();
    for (const std::string& join : join_lines(r)) lines.push_back(join);
  } else if (stage.name == "solve") {
    const auto line = [&](const char* name, const Json& mode) {
      char text[200];
      std::snprintf(text, sizeof text,
                    "%s: %s tables, alpha %.4g, w1 %.3g, cap %.3g; values exact to %.2g", name,
                    count_text(mode, "tables").c_str(), real_of(mode, "alpha"), real_of(mode, "w1"),
                    real_of(mode, "cap"), real_of(mode, "error_bound"));
      lines.push_back(text);
    };
    if (r.contains("responsive")) line("responsive", r["responsive"]);
    line("paper", r);
    add_reasons();
  } else if (stage.name == "pack") {
    lines.push_back(bytes_text(static_cast<std::uint64_t>(count_of(r, "pack_bytes"))));
    if (r.contains("budget")) lines.push_back(budget_text(r["budget"]));
    if (r.contains("loss")) lines.push_back("pictures for the GPU: " + loss_text(r["loss"]));
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
  Json out = {{"mode", mode.name}, {"alpha", mode.alpha}, {"w1", mode.w1}, {"cap", mode.cap}};
  if (mode.by_state) {
    out["turn_w1"] = mode.turn_w1;
    out["change_rate"] = mode.change_rate;
    out["speed_weight"] = mode.speed_weight;
    out["play_through"] = mode.plays_through;
    out["skip_price"] = mode.skip_price;
    out["exit_deg"] = mode.exit_angle * 180 / kPi;
    out["bend_deg"] = mode.dead_angle * 180 / kPi;
  } else {
    out["free_steps"] = mode.stages - 1;
  }
  out["headings"] = mode.headings;
  out["directions"] = direction_list(mode);
  out["tables"] = mode.tables();
  out["residual"] = mode.residual;
  out["error_bound"] = mode.error_bound;
  return out;
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

Json puppet_json(const Puppet& puppet) {
  Json parameters = Json::array();
  for (const PuppetParameter& p : puppet.parameters)
    parameters.push_back(
        {{"name", p.name}, {"low", p.low}, {"high", p.high}, {"period", p.period}});
  return {{"name", puppet.name},          {"points", puppet.point_count()},
          {"faces", puppet.faces.size()}, {"views", puppet.views.size()},
          {"links", puppet.links.size()}, {"kernel", kernel_name(puppet.net.kernel)},
          {"sets", puppet.sets.size()},   {"centers", puppet.net.center_count()},
          {"parameters", parameters}};
}

std::string puppet_line(const Puppet& puppet) {
  return puppet.name + ": " + std::to_string(puppet.point_count()) + " control points, " +
         std::to_string(puppet.faces.size()) + " faces, " + std::to_string(puppet.views.size()) +
         " pictures, kernel " + std::string(kernel_name(puppet.net.kernel)) +
         (puppet.sets.empty() ? ", " + std::to_string(puppet.net.center_count()) + " centers\n"
                              : ", " + std::to_string(puppet.sets.size()) + " sets of views\n");
}

Json loss_json(const PackLoss& loss) {
  const auto ratio = [](double db) { return std::isfinite(db) ? Json(db) : Json(); };
  return {{"colour_psnr_db", ratio(loss.colour)}, {"alpha_psnr_db", ratio(loss.alpha)}};
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
  out["bodies"] = Json::array();
  for (const BodyBox& b : data.bodies)
    out["bodies"].push_back(
        {{"tag", data.tags[b.tag]}, {"box", {b.left, b.top, b.right, b.bottom}}});
  out["sections"] = sections;
  if (info.loss) out["loss"] = loss_json(*info.loss);
  return out;
}

std::string info_text(const std::string& path, const Sprite& sprite, const PackInfo& info) {
  const SpriteData& data = sprite.data();
  const auto size = largest_picture(data);
  std::string out = path + ": " + data.name + ", version " + std::to_string(info.major) + "." +
                    std::to_string(info.minor) + ", " + bytes_text(info.bytes) + "\n";
  out += "  " + std::to_string(data.samples.size()) + " samples (" +
         std::to_string(kept_count(data)) + " kept) in " + std::to_string(clip_count(data)) +
         (clip_count(data) == 1 ? " clip" : " clips") + ", at most " + std::to_string(size[0]) +
         "x" + std::to_string(size[1]) + " px, body length " +
         fixed_text(double{data.body_length}, 1) + " px\n";
  out += "  " + std::to_string(data.transitions.size()) + " transitions, " +
         fixed_text(sprite.fps(), 2) + " ticks a second\n";
  for (const ControlMode& mode : data.modes) {
    std::string served;
    for (int d = 0; d < kCompassCount; ++d)
      if (mode.served >> d & 1u)
        served +=
            (served.empty() ? "" : ", ") + std::string(direction_name(static_cast<Direction>(d)));
    char text[300];
    std::snprintf(text, sizeof text, "  mode %s: alpha %.4g, w1 %.3g, cap %.3g", mode.name.c_str(),
                  double{mode.alpha}, double{mode.w1}, double{mode.cap});
    out += text;
    if (mode.by_state) {
      std::snprintf(text, sizeof text,
                    ", turning w1 %.3g, expects a change in %.3g of the samples, bends up to %.3g "
                    "degrees%s",
                    double{mode.turn_w1}, double{mode.change_rate},
                    double{mode.dead_angle} * 180 / kPi,
                    mode.plays_through ? ", plays through" : "");
    } else {
      std::snprintf(text, sizeof text, ", K = %u", mode.stages - 1);
    }
    out += text;
    std::snprintf(text, sizeof text, ", error bound %.2g\n", mode.error_bound);
    out += text;
    out += "    serves " +
           (served.empty() ? std::string("no direction: it plays by itself") : served) + "\n";
  }
  for (const BodyBox& b : data.bodies) {
    char text[400];
    std::snprintf(text, sizeof text, "  body of %s: [%.4g, %.4g, %.4g, %.4g] px from the anchor\n",
                  data.tags[b.tag].empty() ? "all" : data.tags[b.tag].c_str(), double{b.left},
                  double{b.top}, double{b.right}, double{b.bottom});
    out += text;
  }
  if (info.loss) out += "  pictures for the GPU: " + loss_text(loss_json(*info.loss)) + "\n";
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
  out["first_change"] = {{"median", nullptr}, {"p95", nullptr}};
  if (report.turns > 0)
    out["first_change"] = {{"median", report.first_change_median},
                           {"p95", report.first_change_p95}};
  out["turns"] = report.turns;
  out["unfinished"] = report.unfinished;
  out["transition_cost"] = {
      {"mean", report.cost_mean}, {"p99", report.cost_p99}, {"max", report.cost_max}};
  out["jumps_per_second"] = report.jumps_per_second;
  out["freezes"] = report.freezes;
  out["speed"] = report.speed;
  out["travel_share"] = report.travel_share;
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
           " unfinished; the picture answers after " + fixed_text(report.first_change_median, 0) +
           ", 95 % " + fixed_text(report.first_change_p95, 0) + "\n";
  out += "  transition cost         mean " + fixed_text(report.cost_mean, 4) + ", 99 % " +
         fixed_text(report.cost_p99, 3) + ", largest " + fixed_text(report.cost_max, 3) + "\n";
  out += "  jumps a second          " + fixed_text(report.jumps_per_second, 2) + "\n";
  if (report.travel_share != 0)
    out += "  along the command       " + fixed_text(100 * report.travel_share, 0) +
           " % of the way, at " + fixed_text(report.speed, 0) + " px/s\n";
  out += "  freezes                 " + std::to_string(report.freezes) + "\n";
  return out;
}

Json bench_json(const BenchResult& result) {
  Json curves = Json::array(), floor = Json::array();
  for (const CurvePoint& p : result.curves) {
    const Json settings = p.mode == "paper" ? Json{{"alpha", p.paper.alpha},
                                                   {"w1", p.paper.w1},
                                                   {"cap", p.paper.cap},
                                                   {"free_steps", p.paper.free_steps}}
                                            : Json{{"alpha", p.joint.alpha},
                                                   {"cap", p.joint.cap},
                                                   {"turn_w1", p.joint.turn_w1},
                                                   {"cruise_w1", p.joint.cruise_w1},
                                                   {"change_rate", p.joint.change_rate},
                                                   {"speed_weight", p.joint.speed_weight},
                                                   {"play_through", p.joint.play_through},
                                                   {"skip_price", p.joint.skip_price},
                                                   {"bend_deg", p.joint.bend_deg},
                                                   {"exit_deg", p.joint.exit_deg}};
    curves.push_back(
        {{"mode", p.mode},
         {"settings", settings},
         {"default", p.is_default},
         {"frames_to_turn", {{"median", p.turn_median}, {"p95", p.turn_p95}}},
         {"first_change", {{"median", p.first_change_median}, {"p95", p.first_change_p95}}},
         {"turns", p.turns},
         {"unfinished", p.unfinished},
         {"transition_cost", {{"mean", p.cost_mean}, {"p99", p.cost_p99}, {"max", p.cost_max}}},
         {"jumps_per_second", p.jumps_per_second},
         {"tracking_error_deg", {{"mean", p.tracking_mean}, {"worst", p.tracking_worst}}},
         {"speed_ratio", p.speed_ratio},
         {"travel_share", {{"fast", p.share_fast}, {"slow", p.share_slow}}}});
  }
  for (const Reach& r : result.floor) {
    Json entry = {{"cap", r.cap}, {"median", nullptr}, {"connected", r.connected}};
    if (std::isfinite(r.floor)) entry["median"] = r.floor;
    floor.push_back(entry);
  }
  return {{"curves", curves}, {"floor", floor}};
}

std::string bench_text(const BenchResult& result, double fps) {
  std::string out =
      "                                      frames to turn    transition cost   jumps   angle off "
      " "
      "speed  share along\n"
      "  mode        cap    w1 (turn/cruise) median p95 unfin.  mean  99 %        a sec  mean "
      "worst "
      " kept   fast slow\n";
  char line[300];
  for (const CurvePoint& p : result.curves) {
    const bool paper = p.mode == "paper";
    char weight[40];
    if (paper)
      std::snprintf(weight, sizeof weight, "%g", p.paper.w1);
    else
      std::snprintf(weight, sizeof weight, "%g/%.3g", p.joint.turn_w1, p.joint.cruise_w1);
    std::snprintf(line, sizeof line,
                  "%s %-11s %-5.3g  %-16s %6.1f %4.0f %5d  %.4f %.3f    %6.2f %6.1f %5.1f  %5.2f  "
                  "%5.2f %.2f\n",
                  p.is_default ? "*" : " ", p.mode.c_str(), paper ? p.paper.cap : p.joint.cap,
                  weight, p.turn_median, p.turn_p95, p.unfinished, p.cost_mean, p.cost_p99,
                  p.jumps_per_second, p.tracking_mean, p.tracking_worst, p.speed_ratio,
                  p.share_fast, p.share_slow);
    out += line;
  }
  out += "  * as the sprite was built; one frame is " + fixed_text(1000 / fps, 1) + " ms\n\n";
  out +=
      "  cap    frames to the first sample that goes there (median)   moving samples connected\n";
  for (const Reach& r : result.floor) {
    std::snprintf(line, sizeof line, "  %-5.2f  %-10s %55.1f %%\n", r.cap,
                  std::isfinite(r.floor) ? fixed_text(r.floor, 0).c_str() : "never",
                  100 * r.connected);
    out += line;
  }
  return out;
}

std::string actions_text(const std::vector<ActionReport>& reports) {
  if (reports.empty()) return {};
  std::string out =
      "\naction          within  frames to it: median  95 %  most   its jumps: sum  dearest  95 %  "
      " "
      "beyond the threshold\n";
  for (const ActionReport& r : reports) {
    char line[200];
    std::snprintf(
        line, sizeof line, "%-16s %5s %21.0f %5.0f %5.0f %17.2f %8.2f %5.2f %10.0f %% of %llu%s\n",
        r.tag.c_str(), r.within < 0 ? "none" : std::to_string(r.within).c_str(), r.frames_median,
        r.frames_p95, r.frames_max, r.cost_mean, r.worst_mean, r.worst_p95, 100 * r.cut_share,
        static_cast<unsigned long long>(r.states), r.late > 0 ? ", some LATE" : "");
    out += line;
  }
  return out;
}

Json actions_json(const std::vector<ActionReport>& reports) {
  Json list = Json::array();
  for (const ActionReport& r : reports) {
    Json entry = {{"tag", r.tag}, {"within", nullptr}, {"states", r.states}, {"late", r.late}};
    if (r.within >= 0) entry["within"] = r.within;
    entry["frames"] = {{"median", r.frames_median}, {"p95", r.frames_p95}, {"max", r.frames_max}};
    entry["transition_cost"] = {{"mean", r.cost_mean}, {"p95", r.cost_p95}, {"max", r.cost_max}};
    entry["dearest_jump"] = {{"mean", r.worst_mean}, {"p95", r.worst_p95}};
    entry["beyond_threshold"] = r.cut_share;
    list.push_back(std::move(entry));
  }
  return list;
}

std::string follow_text(const FollowReport& r) {
  if (r.ticks == 0) return "\nmoved by the game: nothing in it moves\n";
  return "\nmoved by the game: the feet slide by " + fixed_text(100 * r.slip_median, 1) +
         " % of the speed (median; 95 %: " + fixed_text(100 * r.slip_p95, 0) +
         "), at most a tenth in " + fixed_text(100 * r.within_tenth, 0) + " % of " +
         std::to_string(r.ticks) + " ticks; drawn " + fixed_text(r.trail_median, 2) +
         " body lengths from where the game has it (95 %: " + fixed_text(r.trail_p95, 2) +
         "); transition cost mean " + fixed_text(r.cost_mean, 3) + ", 99 % " +
         fixed_text(r.cost_p99, 2) + ", " + fixed_text(r.jumps_per_second, 1) + " jumps a second\n";
}

Json follow_json(const FollowReport& r) {
  return {{"ticks", r.ticks},
          {"slip", {{"median", r.slip_median}, {"p95", r.slip_p95}}},
          {"within_tenth", r.within_tenth},
          {"trail_body", {{"median", r.trail_median}, {"p95", r.trail_p95}}},
          {"transition_cost", {{"mean", r.cost_mean}, {"p99", r.cost_p99}}},
          {"jumps_per_second", r.jumps_per_second}};
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
