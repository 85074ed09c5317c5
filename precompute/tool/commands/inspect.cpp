// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// info, validate and steer: what a pack holds, whether it is whole, how it answers.
#include <array>
#include <cmath>
#include <filesystem>

#include "control/response.h"
#include "tool/commands/verbs.h"
#include "tool/report.h"
#include "vsprite/actor.h"
#include "vsprite/pack.h"
#include "vsprite/puppet.h"
#include "vsprite/replay.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

constexpr double kDefaultSeconds = 12;
constexpr std::uint64_t kBenchSeeds = 10;
constexpr std::uint64_t kFollowTicks = 50000;

Result<Sprite> load_operand(const Settings& settings) {
  if (settings.film.empty()) return Error{ErrorCode::BadSetting, "a pack is due: PACK.vsp"};
  return load_pack(settings.film);
}

Result<KeyScript> script_of(const Settings& settings, double fps, std::uint64_t frames) {
  // Without a script: another direction every second or two, from the seed.
  if (settings.keys.empty())
    return random_script(static_cast<double>(frames) / fps, 1, 2, fps, settings.seed);
  auto script = load_key_script(settings.keys, fps);
  std::error_code error;
  if (!script && fs::is_regular_file(settings.keys, error))
    return Error{ErrorCode::BadContent, settings.keys + ": " + script.error().message};
  return script;
}

}  // namespace

Result<int> run_info(const Settings& settings, Console& console) {
  const auto sprite = load_operand(settings);
  if (!sprite) return sprite.error();
  const auto info = read_pack_info(settings.film);
  if (!info) return info.error();
  const auto puppets = load_puppets(settings.film);
  if (!puppets) return puppets.error();
  std::string text = info_text(settings.film, *sprite, *info);
  Json document = info_json(*sprite, *info);
  document["puppets"] = Json::array();
  for (const Puppet& puppet : *puppets) {
    text += "puppet " + puppet_line(puppet);
    document["puppets"].push_back(puppet_json(puppet));
  }
  console.text(text);
  console.document(document);
  console.next("vsprite play " + shell_word(settings.film));
  return 0;
}

Result<int> run_validate(const Settings& settings, Console& console) {
  if (settings.film.empty()) return Error{ErrorCode::BadSetting, "a pack is due: PACK.vsp"};
  const auto issues = verify_pack(settings.film);
  if (!issues) return issues.error();
  std::string text, first_error;
  Json list = Json::array();
  for (const PackIssue& issue : *issues) {
    if (issue.severity == "error" && first_error.empty()) first_error = issue.code;
    text += issue.severity + ": " +
            (issue.section.empty() ? std::string("header") : issue.section) + " at byte " +
            std::to_string(issue.offset) + ": " + issue.message + "\n";
    list.push_back({{"code", issue.code},
                    {"severity", issue.severity},
                    {"section", issue.section},
                    {"offset", issue.offset},
                    {"message", issue.message}});
  }
  console.remark(first_error.empty() ? "next: vsprite steer " + shell_word(settings.film)
                                     : "next: vsprite pack makes it anew from its work folder");
  console.text(text + (first_error.empty() ? "OK" : "INVALID: " + first_error) + "\n");
  console.document({{"valid", first_error.empty()}, {"issues", list}});
  return first_error.empty() ? 0 : 3;
}

namespace {

Result<int> run_bench(const Settings& settings, const Sprite& sprite, Console& console) {
  BenchConfig config;
  config.jobs = settings.jobs;
  for (std::uint64_t k = 0; k < kBenchSeeds; ++k)
    config.seeds.push_back(1000 * settings.seed + k + 1);
  Result<KeyScript> script = KeyScript{};
  if (!settings.keys.empty()) {
    const double last = settings.frames > 0 ? settings.frames / sprite.fps() : config.seconds;
    script = script_of(settings, sprite.fps(), static_cast<std::uint64_t>(last * sprite.fps()));
    if (!script) return script.error();
    config.script = &*script;
    config.seconds = last;
  }
  const StageListener listener = console.listener();
  if (listener.begin) listener.begin("bench");
  const auto result = measure_curves(sprite, config, listener.progress);
  if (!result)  // every setting is the pack's
    return Error{ErrorCode::BadContent, settings.film + ": " + result.error().message};
  if (listener.end) listener.end("bench", false);
  if (!settings.output.empty()) {
    const std::string svg = curves_svg(*result, sprite.data().name);
    if (auto wrote = write_file(settings.output, svg); !wrote) return wrote.error();
  }
  const std::vector<ActionReport> actions = measure_actions(sprite);
  const FollowReport follow = measure_following(sprite, 0, kFollowTicks, settings.seed);
  Json document = bench_json(*result);
  if (!actions.empty()) document["actions"] = actions_json(actions);
  document["follow"] = follow_json(follow);
  console.text(bench_text(*result, sprite.fps()) + follow_text(follow) + actions_text(actions));
  console.document(document);
  console.next("vsprite play " + shell_word(settings.film));
  return 0;
}

// Makes the run of a script once more, noting what is done to the actor.
Result<void> record_run(const Settings& settings, const Sprite& sprite, int mode,
                        const KeyScript& script, std::uint64_t frames) {
  using Kind = ReplayCommand::Kind;
  std::array<Actor, 1> actor{make_actor(sprite, {}, settings.seed, mode)};
  ReplayRecorder recorder(sprite, actor);
  for (std::uint64_t tick = 0; tick < frames; ++tick) {
    const Direction wanted = script.at(tick);
    if (wanted != actor[0].direction)
      recorder.command(sprite, actor, {.kind = Kind::Direction, .direction = wanted});
    for (const ReplayCommand& command : commands_at(sprite, script, tick))
      recorder.command(sprite, actor, command);
    step(sprite, actor);
    recorder.tick(actor);
  }
  return save_replay(settings.record, recorder.replay());
}

Result<int> run_again(const Settings& settings, const Sprite& sprite, Console& console) {
  const auto replay = load_replay(settings.replay, sprite);
  if (!replay) return replay.error();
  std::vector<Actor> actors;
  StateHash hash;
  const auto divergence = run_replay(sprite, *replay, actors, &hash);
  const bool same_pack = replay->sprite == sprite.identity();
  Json document = {{"frames", replay->hashes.size()},     {"actors", actors.size()},
                   {"commands", replay->commands.size()}, {"same_pack", same_pack},
                   {"states_hash", hex64(hash.digest())}, {"divergence", nullptr}};
  if (divergence)
    document["divergence"] = {{"tick", divergence->tick},
                              {"recorded", hex64(divergence->recorded)},
                              {"found", hex64(divergence->found)}};
  console.document(document);
  if (divergence)
    return Error{ErrorCode::BadContent,
                 settings.replay + ": goes another way at tick " +
                     std::to_string(divergence->tick) + ": states " + hex64(divergence->found) +
                     ", recorded " + hex64(divergence->recorded) +
                     (same_pack ? std::string() : ": it was recorded with another pack")};
  console.text("  " + std::to_string(replay->hashes.size()) + " frames as recorded, states " +
               hex64(hash.digest()) + "\n");
  console.next("vsprite play " + shell_word(settings.film));
  return 0;
}

}  // namespace

Result<int> run_steer(const Settings& settings, Console& console) {
  const auto sprite = load_operand(settings);
  if (!sprite) return sprite.error();
  if (settings.bench) return run_bench(settings, *sprite, console);
  if (!settings.replay.empty()) return run_again(settings, *sprite, console);
  const int mode = settings.mode.empty() ? 0 : sprite->find_mode(settings.mode);
  if (mode < 0)
    return Error{ErrorCode::BadContent, settings.film + ": it holds no mode `" + settings.mode +
                                            "`: use --mode " + sprite->data().modes.front().name};
  const std::uint64_t frames =
      settings.frames > 0 ? static_cast<std::uint64_t>(settings.frames)
                          : static_cast<std::uint64_t>(std::ceil(kDefaultSeconds * sprite->fps()));
  const auto script = script_of(settings, sprite->fps(), frames);
  if (!script) return script.error();
  if (auto known = check_key_script(*sprite, *script); !known) return known.error();
  if (!settings.record.empty())
    if (auto kept = record_run(settings, *sprite, mode, *script, frames); !kept)
      return kept.error();
  std::vector<TraceRow> trace;
  const SteerReport report = measure_steering(*sprite, mode, *script, frames, settings.seed,
                                              settings.trace.empty() ? nullptr : &trace);
  if (!settings.trace.empty())
    if (auto wrote = write_file(settings.trace, trace_csv(trace)); !wrote) return wrote.error();
  console.text(steer_text(report, sprite->fps()));
  console.document(steer_json(report));
  console.next("vsprite play " + shell_word(settings.film));
  return 0;
}

}  // namespace vsprite
