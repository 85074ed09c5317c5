// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/stages.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "control/flip.h"
#include "tool/cast.h"
#include "tool/cast_file.h"
#include "tool/shadows.h"
#include "tool/tiles.h"
#include "tool/train.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

/// Everything about one stage, so that run_stages needs no special cases.
struct Stage {
  Result<StageKey> (*key)(StageRun&);
  Result<Json> (*work)(StageRun&);
  /// Sum of what it made, as it stands now.
  Result<std::string> (*output)(StageRun&);
  /// A person may have edited what it made: it then stands, and is never overwritten unasked.
  bool editable;
};

// ---- sums of inputs ----

Result<Json> sums(StageRun& run, const std::vector<const char*>& names) {
  Json inputs = Json::object();
  for (const char* name : names) {
    const bool sprites = std::string_view(name) == "sprites";
    if (sprites && run.sprites_sum) {
      inputs[name] = *run.sprites_sum;
      continue;
    }
    const auto sum = sprites ? run.project.sprites_sum() : run.project.file_sum(name);
    if (!sum) return sum.error();
    if (sprites) run.sprites_sum = *sum;
    inputs[name] = *sum;
  }
  return inputs;
}

Result<StageKey> key_of(StageRun& run, const char* stage, Json settings,
                        const std::vector<const char*>& inputs) {
  auto found = sums(run, inputs);
  if (!found) return found.error();
  return StageKey{stage, std::move(settings), std::move(*found)};
}

Result<LoadedSprites*> sprites_of(StageRun& run) {
  if (!run.sprites) {
    auto loaded = load_sprites(run.project);
    if (!loaded) return loaded.error();
    run.sprites = std::move(*loaded);
  }
  return &*run.sprites;
}

// ---- segment ----

Result<StageKey> segment_key(StageRun& run) {
  if (is_cast(run.film)) return cast_key(run);
  const Settings& s = run.settings;
  const FilmSource source = source_of(s, run.film);
  const auto sum = hash_source(source);
  if (!sum) return sum.error();
  StageKey key{"segment", segment_settings(s), {{"film", hex64(*sum)}}};
  key.settings["matte"] = !s.matte.empty();
  key.settings["fps"] = is_picture_source(run.film) ? s.fps : 0;
  key.settings["range"] = {run.first_frame, run.end_frame};
  return key;
}

Result<Json> segment(StageRun& run) {
  run.sprites.reset();
  run.sprites_sum.reset();
  if (is_cast(run.film)) return segment_cast(run);
  const auto key = segment_key(run);
  if (!key) return key.error();
  const Json origin = {
      {"tool", kToolVersion}, {"settings", key->settings}, {"inputs", key->inputs}};
  return segment_film(run, hex64(hash_bytes(origin.dump())));
}

Result<std::string> segment_output(StageRun& run) {
  auto sum = run.project.sprites_sum();
  if (!sum || !has_shadows(run.project)) return sum;
  const auto shadows = shadows_sum(run.project);
  if (!shadows) return shadows.error();
  return *sum + *shadows;
}

// ---- train ----

Result<StageKey> train_key(StageRun& run) {
  const Settings& s = run.settings;
  auto key = key_of(run, "train",
                    {{"pairs", s.pairs},
                     {"folds", s.folds},
                     {"false-accept-cost", s.false_accept_cost},
                     {"features", s.features},
                     {"seed", s.seed}},
                    {"sprites"});
  if (!key) return key;
  if (auto added = add_labels_to_key(run.project, s, *key); !added) return added.error();
  return key;
}

Result<Json> train_classifier(StageRun& run) {
  const auto sprites = sprites_of(run);
  if (!sprites) return sprites.error();
  FeatureSet& set = (*sprites)->features;
  set.scale = feature_scale(run.settings.features);
  return train_folder(run.project, set, run.settings);
}

Result<std::string> train_output(StageRun& run) { return run.project.file_sum("classifier.toml"); }

// ---- transitions ----

Result<StageKey> transitions_key(StageRun& run) {
  const auto present = run.project.classifier();  // also tells a damaged file from an absent one
  if (!present) return present.error();
  return key_of(
      run, "transitions",
      {{"max-per-sample", run.settings.max_per_sample},
       {"min-back", run.settings.min_back},
       {"minima", run.settings.minima},
       {"near-miss", run.settings.near_miss},
       {"flip", run.settings.flip},
       {"flip-price", run.settings.flip_price},
       {"features", trained_scale(run.project) == FeatureScale::PerArea ? "per-area" : "raw"}},
      {"sprites", "classifier.toml"});
}

// A long search says what it needs and keeps its tiles.
Result<std::vector<PairDistance>> find_pairs(StageRun& run, const FeatureSet& set,
                                             const Classifier& classifier, float limit,
                                             std::uint64_t& compared) {
  const PairFinder finder(set, classifier, limit);
  const std::uint64_t n = set.samples.size();
  TileStore store;
  if (n * (n - 1) / 2 > kLongSearch) {
    const auto needs = foresee(finder, set.samples.size());
    if (!needs)
      return Error{needs.error().code, run.project.folder() + ": " + needs.error().message};
    if (run.listener.note) run.listener.note(*needs);
    const auto inputs = sums(run, {"sprites", "classifier.toml"});
    if (!inputs) return inputs.error();
    const Json key = {{"tool", kToolVersion},
                      {"inputs", *inputs},
                      {"scale", set.scale == FeatureScale::PerArea},
                      {"limit", limit}};
    store = keep_tiles(run.project.path("pairs"), hash_bytes(key.dump()));
  }
  if (run.sharing.search)
    return run.sharing.search(finder, store, &compared, run.listener.progress);
  return accepted_pairs(finder, run.settings.jobs, store, &compared, run.listener.progress);
}

// Whether mirror images are joined at a set price; `auto`: where the film holds no turn, or without
// them (null) no endless run.
Result<bool> wants_flips(const Settings& settings, std::span<const SampleRow> rows,
                         const CostTable* costs) {
  const bool mirrored = !rows.empty() && rows.back().mirror_of >= 0;
  if (settings.flip == "cut" && !mirrored)
    return Error{
        ErrorCode::BadSetting,
        "transitions: flip is cut, but the samples are not mirrored; use --mirror with it"};
  if (!mirrored || settings.flip != "auto") return settings.flip == "cut";
  return costs == nullptr || !turns_by_itself(rows, costs->kept);
}

Result<Json> find_transitions(StageRun& run) {
  const auto classifier = run.project.classifier();
  if (!classifier) return classifier.error();
  const auto sprites = sprites_of(run);
  if (!sprites) return sprites.error();
  const FeatureSet& set = (*sprites)->features;
  TransitionFile file;
  TransitionStats stats;
  file.v0 = set.v0;
  const TransitionConfig config = transition_config(run.settings);
  auto pairs = find_pairs(run, set, *classifier, 1 + config.near_miss, stats.compared);
  if (!pairs) return pairs.error();
  file.pairs = std::move(*pairs);
  auto costs = make_cost_table(set, file.pairs, config, stats, &*classifier);
  const auto flips = wants_flips(run.settings, set.rows, costs ? &*costs : nullptr);
  if (!flips) return flips.error();
  if (*flips) {
    TransitionStats afresh;
    afresh.compared = stats.compared;
    stats = afresh;
    add_flips(set.rows, static_cast<float>(run.settings.flip_price), file.pairs);
    costs = make_cost_table(set, file.pairs, config, stats, &*classifier);
  }
  if (!costs) return Error{costs.error().code, run.project.folder() + ": " + costs.error().message};
  file.costs = std::move(*costs);
  file.skip_costs = skip_costs(set, *classifier, file.costs.kept);
  if (auto wrote = write_file(run.project.path("transitions.bin"), format_transitions(file));
      !wrote)
    return wrote.error();
  std::error_code ignored;
  fs::remove_all(run.project.path("pairs"), ignored);
  Json joins = Json::array();
  for (const TagJoin& join : stats.joins)
    joins.push_back({{"from", join.from},
                     {"to", join.to},
                     {"from_tag", join.from_tag},
                     {"to_tag", join.to_tag},
                     {"cost", join.cost},
                     {"text", describe(join)}});
  return Json{{"pairs", stats.pairs},
              {"compared", stats.compared},
              {"accepted", stats.accepted},
              {"near_misses", stats.near_misses},
              {"transitions", stats.transitions},
              {"jumps_per_second", stats.jumps_per_second},
              {"flips", *flips},
              {"kept", stats.kept},
              {"lost_clip_end", stats.lost_clip_end},
              {"lost_dead_end", stats.lost_dead_end},
              {"lost_unreachable", stats.lost_unreachable},
              {"reasons", stats.reasons},
              {"joins", joins}};
}

Result<std::string> transitions_output(StageRun& run) {
  return run.project.file_sum("transitions.bin");
}

// ---- solve (control.cpp) ----

Result<StageKey> solve_key(StageRun& run) {
  const auto samples = run.project.samples();
  if (!samples) return samples.error();
  const auto present = run.project.transitions(samples->size());
  if (!present) return present.error();
  return key_of(run, "solve", solve_settings(run.settings), {"samples.csv", "transitions.bin"});
}

Result<std::string> solve_output(StageRun& run) { return run.project.file_sum("values.bin"); }

// ---- pack ----

Result<StageKey> pack_key(StageRun& run) {
  const auto samples = run.project.samples();
  if (!samples) return samples.error();
  const auto present = run.project.values(samples->size());
  if (!present) return present.error();
  const Json* made = run.project.record("segment");
  const Json cast = made ? made->value("result", Json::object()).value("cast", Json()) : Json();
  Json events = Json::array(), bodies = Json::array();
  for (const Json& clip : cast.is_array() ? cast : Json::array()) {
    if (clip.contains("events")) events.push_back(clip["events"]);
    if (clip.contains("body")) bodies.push_back({clip["tag"], clip["body"]});
  }
  const Json settings = {{"events", events},
                         {"bodies", bodies},
                         {"seed", run.settings.seed},
                         {"action-tau", run.settings.action_tau},
                         {"budget", run.settings.budget},
                         {"pictures", run.settings.pictures}};
  std::vector<const char*> inputs{"sprites", "transitions.bin", "values.bin"};
  for (const char* name : {"puppets.bin", "puppet_sets.bin"})
    if (std::filesystem::exists(run.project.path(name))) inputs.push_back(name);
  auto key = key_of(run, "pack", settings, inputs);
  if (!key || !has_shadows(run.project)) return key;
  const auto shadows = shadows_sum(run.project);
  if (!shadows) return shadows.error();
  key->inputs["shadows"] = *shadows;
  return key;
}

Result<std::string> pack_output(StageRun& run) {
  const auto sum = hash_file(run.pack);
  if (!sum) return sum.error();
  return hex64(*sum);
}

constexpr Stage kTable[] = {
    {segment_key, segment, segment_output, true},
    {train_key, train_classifier, train_output, true},
    {transitions_key, find_transitions, transitions_output, false},
    {solve_key, solve_tables, solve_output, false},
    {pack_key, write_pack, pack_output, false},
};

// ---- running ----

bool forced(const Settings& settings, const std::string& stage) {
  for (const std::string& name : settings.force)
    if (name == stage || name == "all") return true;
  return false;
}

/// Whether the stage has to run. An edited result stands as long as nothing else asks for the
/// stage.
Result<bool> is_due(StageRun& run, const Stage& stage, const StageKey& key) {
  if (forced(run.settings, key.name)) return true;
  const Json* record = run.project.record(key.name);
  if (record == nullptr) return true;
  const auto output = stage.output(run);
  const bool as_made = output && record->value("output", Json()) == *output;
  if (run.project.is_current(key)) {
    if (as_made || (output && stage.editable)) return false;
    if (stage.editable) return output.error();  // a file of it is missing or damaged: named
    if (output && run.listener.note)
      run.listener.note("what it made has changed since: made again");
    return true;
  }
  if (output && !as_made && stage.editable)
    return Error{
        ErrorCode::BadContent,
        run.project.folder() + ": what `" + key.name +
            "` made was edited by hand, and now its input or settings have changed: --force " +
            key.name + " makes it anew and loses the edits"};
  return true;
}

/// The high-water mark of this process, counted from here on where the kernel allows it.
void reset_peak_memory() {
  if (std::FILE* file = std::fopen("/proc/self/clear_refs", "w")) {
    std::fputs("5", file);
    std::fclose(file);
  }
}

double peak_memory_mb() {
  if (std::FILE* file = std::fopen("/proc/self/status", "r")) {
    char line[256];
    long kilobytes = 0;
    while (std::fgets(line, sizeof line, file) != nullptr)
      if (std::strncmp(line, "VmHWM:", 6) == 0) kilobytes = std::atol(line + 6);
    std::fclose(file);
    if (kilobytes > 0) return static_cast<double>(kilobytes) / 1024;
  }
  struct rusage usage {};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// What the children that have ended needed: processor time in microseconds, memory of the largest.
struct ChildUsage {
  std::int64_t microseconds = 0;
  double peak_mb = 0;
};

ChildUsage child_usage() {
  struct rusage usage {};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return {.microseconds = std::int64_t{usage.ru_utime.tv_sec} * 1'000'000 + usage.ru_utime.tv_usec,
          .peak_mb = static_cast<double>(usage.ru_maxrss) / 1024};
}

Result<StageOutcome> run_stage(StageRun& run, int index) {
  const Stage& stage = kTable[index];
  StageOutcome outcome;
  outcome.name = kStages[index];
  reset_peak_memory();
  const ChildUsage before = child_usage();
  const auto begin = std::chrono::steady_clock::now();
  const auto key = stage.key(run);
  if (!key) return key.error();
  const auto due = is_due(run, stage, *key);
  if (!due) return due.error();
  outcome.skipped = !*due;
  if (*due) {
    // A segmentation may refuse its film: its record goes when the first sprite does.
    if (index > 0)
      if (auto begun = run.project.begin_stage(outcome.name); !begun) return begun.error();
    auto result = stage.work(run);
    if (!result) return result.error();
    const auto output = stage.output(run);
    if (!output) return output.error();
    if (auto done = run.project.finish_stage(*key, *output, *result); !done) return done.error();
  }
  if (const Json* record = run.project.record(outcome.name))
    outcome.result = record->value("result", Json::object());
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  outcome.peak_rss_mb = peak_memory_mb();
  const ChildUsage after = child_usage();
  if (after.microseconds > before.microseconds) outcome.peak_rss_mb += after.peak_mb;
  return outcome;
}

}  // namespace

Json segment_settings(const Settings& s) {
  return {
      {"key", s.key},         {"max-size", s.draft ? std::min(s.max_size, kDraftSize) : s.max_size},
      {"draft", s.draft},     {"subject", s.subject},
      {"anchor", s.anchor},   {"mirror", s.mirror},
      {"smooth", s.smooth},   {"min-clip", s.min_clip},
      {"horizon", s.horizon}, {"ground-line", s.ground_line},
      {"focal", s.focal},     {"clip-black", s.clip_black},
      {"edge", s.edge},       {"clip-white", s.clip_white},
      {"despill", s.despill}, {"shadow", s.shadow}};
}

TransitionConfig transition_config(const Settings& settings) {
  TransitionConfig config;
  config.max_per_sample = settings.max_per_sample;
  config.min_back = settings.min_back;
  config.minima = settings.minima == "on";
  config.near_miss = static_cast<float>(settings.near_miss);
  return config;
}

int stage_index(std::string_view name) {
  int index = 0;
  while (name != kStages[index]) ++index;
  return index;
}

Result<std::vector<StageOutcome>> run_stages(StageRun& run, int first, int last) {
  std::vector<StageOutcome> outcomes;
  for (int index = first; index <= last; ++index) {
    if (run.listener.begin) run.listener.begin(kStages[index]);
    auto outcome = run_stage(run, index);
    if (!outcome) return outcome.error();
    if (run.listener.end) run.listener.end(kStages[index], outcome->skipped);
    outcomes.push_back(std::move(*outcome));
    // What a finished segmentation kept for its own resumption is of no use any more.
    std::error_code ignored;
    if (index == 0) fs::remove_all(run.project.path("keyed"), ignored);
  }
  return outcomes;
}

}  // namespace vsprite
