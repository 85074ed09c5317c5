// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/budget.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "control/choose.h"
#include "control/response.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

// What a sample takes of each section (engine/PACK.md).
constexpr std::size_t kPerSample = 60 + 24 + 4;  // SAMP, FIDX, a start of a row
constexpr std::size_t kPerTransition = 8;
constexpr std::size_t kPerEntry = 8;           // of a table: next, go
constexpr std::size_t kPerAction = 20;         // and 4 for every deadline
constexpr std::size_t kPerShadow = 24;         // and its picture
constexpr std::size_t kSectionCost = 32 + 64;  // entry of the table, gap before the section
constexpr std::array<std::string_view, 7> kWhole = {"META", "EVNT", "BODY", "GRND",
                                                    "PUPT", "PSET", "LOSS"};
constexpr std::array<std::string_view, 3> kExtras = {"GRND", "PUPT", "PSET"};

constexpr double kGoalSeconds = 825;  // 300 goals, as `steer --bench` sets a seed

// Bytes that do not depend on which samples stay.
double fixed_bytes(const PackInfo& info, const SpriteData& data) {
  double bytes = 64;
  for (const PackSection& section : info.sections) {
    bytes += kSectionCost;
    if (std::count(kWhole.begin(), kWhole.end(), section.name) > 0)
      bytes += static_cast<double>(section.bytes);
  }
  for (const ControlMode& mode : data.modes)
    bytes += 128 + 4 + static_cast<double>(mode.name.size());
  return bytes + 16 + 8 + 8 * static_cast<double>(data.actions.size());
}

std::vector<double> sample_bytes(const Sprite& sprite) {
  const SpriteData& data = sprite.data();
  std::size_t rows = kPerSample;
  for (const ControlMode& mode : data.modes)
    rows += kPerEntry * mode.tables() + (mode.by_state ? 4 : 0);
  rows += data.actions.size() * (kPerAction + 4 * data.action_horizon);
  std::vector<double> bytes;
  for (std::uint32_t i = 0; i < data.samples.size(); ++i)
    bytes.push_back(static_cast<double>(rows + sprite.picture_bytes(i)));
  for (const FilmedShadow& shadow : data.shadows)
    bytes[shadow.sample] += static_cast<double>(kPerShadow + shadow.picture.size());
  return bytes;
}

double turn_median(const Sprite& sprite, std::uint64_t seed) {
  const KeyScript goals = random_script(kGoalSeconds, 1.5, 4, sprite.fps(), seed);
  const auto frames = static_cast<std::uint64_t>(kGoalSeconds * sprite.fps());
  return measure_steering(sprite, 0, goals, frames, seed).turn_median;
}

Result<PackMeasure> measure(const Sprite& sprite, const std::string& path, std::uint64_t seed) {
  PackMeasure of;
  std::error_code error;
  of.bytes = std::filesystem::file_size(path, error);
  if (error) return Error{ErrorCode::CannotRead, path + ": " + error.message()};
  for (const Sample& s : sprite.samples()) of.samples += s.kept;
  of.turn_median = turn_median(sprite, seed);
  return of;
}

}  // namespace

Result<BudgetOutcome> fit_pack(const std::string& from, const std::string& to,
                               const BudgetConfig& config) {
  const auto sprite = load_pack(from);
  if (!sprite) return sprite.error();
  const auto info = read_pack_info(from);
  if (!info) return info.error();
  BudgetOutcome outcome;
  const auto before = measure(*sprite, from, config.seed);
  if (!before) return before.error();
  outcome.before = *before;

  const double fixed = fixed_bytes(*info, sprite->data());
  const ChoiceConfig choice_config{.limit = std::max(1.0, config.bytes - fixed),
                                   .weights = sample_bytes(*sprite),
                                   .transition_weight = kPerTransition,
                                   .seed = config.seed,
                                   .jobs = config.jobs};
  const auto choice = choose_samples(sprite->data(), choice_config);
  if (!choice) return choice.error();

  std::vector<PackExtra> extras;
  for (const std::string_view name : kExtras) {
    auto bytes = load_extra(from, name);
    if (!bytes) return bytes.error();
    extras.push_back({std::string(name), std::move(*bytes)});
  }
  const PictureForm form = sprite->has_blocks() ? PictureForm::Blocks : PictureForm::Exact;
  const FrameSource pictures = [&](std::uint32_t sample) -> Result<Image> {
    if (config.pictures) return config.pictures(choice->from[sample]);
    Image image;
    if (auto ok = sprite->decode_frame(choice->from[sample], image); !ok) return ok.error();
    unpremultiply(image);
    return image;
  };
  if (auto saved = save_pack(to, choice->data, pictures, extras, form); !saved)
    return saved.error();
  const auto smaller = load_pack(to);
  if (!smaller) return smaller.error();
  const auto after = measure(*smaller, to, config.seed);
  if (!after) return after.error();
  outcome.after = *after;
  return outcome;
}

}  // namespace vsprite
