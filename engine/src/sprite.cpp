// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The immutable asset: checking what playing relies on, looking up costs, decoding pictures.
#include "vsprite/sprite.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "bulk.h"
#include "pack_format.h"
#include "sections.h"

namespace vsprite {
namespace detail {

bool is_natural(const SpriteData& data, std::uint32_t from, std::uint32_t to) noexcept {
  return to == from + 1 && data.samples[to].clip == data.samples[from].clip;
}

const Transition* find_transition(const SpriteData& data, std::uint32_t from,
                                  std::uint32_t to) noexcept {
  const auto* first = data.transitions.data() + data.row_start[from];
  const auto* last = data.transitions.data() + data.row_start[from + 1];
  const auto* found = std::lower_bound(
      first, last, to, [](const Transition& t, std::uint32_t sample) { return t.to < sample; });
  return found != last && found->to == to ? found : nullptr;
}

namespace {

bool is_skip(const SpriteData& data, std::uint32_t from, std::uint32_t to) {
  return to == from + 2 && std::isfinite(data.samples[from].skip_cost);
}

std::string number(std::uint64_t value) { return std::to_string(value); }

Check check_text(const std::string& text, std::string_view section, const std::string& what) {
  const bool control = std::any_of(text.begin(), text.end(), [](char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
  });
  if (text.size() <= kMaxText && !control) return {};
  return finding("text", section, 0,
                 what + (control ? ": holds a control character"
                                 : ": " + number(text.size()) + " bytes, at most 255 are due"));
}

Check check_meta(const SpriteData& data) {
  const std::size_t n = data.samples.size();
  if (n == 0 || n > kMaxSamples) {
    return finding("sample-count", "META", 0,
                   number(n) + " samples, 1 to " + number(kMaxSamples) + " are due");
  }
  if (data.fps_numerator == 0 || data.fps_denominator == 0) {
    return finding("fps", "META", 0,
                   "rate of " + number(data.fps_numerator) + "/" + number(data.fps_denominator) +
                       " ticks a second, more than 0 is due");
  }
  if (!std::isfinite(data.body_length) || data.body_length < 0) {
    return finding("body-length", "META", 0, "body length is not a finite number of pixels >= 0");
  }
  if (data.tags.empty() || data.tags.size() > kMaxTags) {
    return finding("tag-count", "META", 0,
                   number(data.tags.size()) + " tags, 1 to " + number(kMaxTags) + " are due");
  }
  if (Check bad = check_text(data.name, "META", "name")) return bad;
  for (std::size_t t = 0; t < data.tags.size(); ++t) {
    if (Check bad = check_text(data.tags[t], "META", "tag " + number(t))) return bad;
  }
  if (data.start_sample >= n || data.samples[data.start_sample].kept != 1) {
    return finding("start-sample", "META", 0,
                   "start sample " + number(data.start_sample) + " is not a kept sample");
  }
  return {};
}

Check check_sample(const SpriteData& data, std::size_t i) {
  const Sample& s = data.samples[i];
  const auto bad = [i](std::string_view code, const std::string& found,
                       ErrorCode error = ErrorCode::CorruptData) {
    return finding(code, "SAMP", 0, "sample " + number(i) + ": " + found, error);
  };
  const bool finite = std::isfinite(s.anchor.x) && std::isfinite(s.anchor.y) &&
                      std::isfinite(s.velocity.x) && std::isfinite(s.velocity.y) &&
                      std::isfinite(s.area) && std::isfinite(s.scale);
  if (!finite) return bad("sample-value", "holds a number that is not finite");
  if (s.area < 0 || s.scale <= 0) {
    return bad("sample-range", "area below 0 or scale not above 0");
  }
  if (s.duration < 1) return bad("duration", "duration 0, at least 1 is due");
  if (s.tag >= data.tags.size()) {
    return bad("tag-index", "tag " + number(s.tag) + " of " + number(data.tags.size()));
  }
  if (s.mirror_of != kNoSample && s.mirror_of >= data.samples.size()) {
    return bad("mirror-index",
               "mirror of sample " + number(s.mirror_of) + " of " + number(data.samples.size()));
  }
  if (s.kept > 1) {
    return bad("kept-flag", "kept is " + number(s.kept) + ", 0 or 1 is due");
  }
  if (std::uint64_t{s.width} * s.height > kMaxPixels) {
    return bad("picture-size",
               "picture of " + number(s.width) + " x " + number(s.height) + " pixels, at most " +
                   number(kMaxPixels) + " pixels are due",
               ErrorCode::LimitExceeded);
  }
  if (!(s.skip_cost >= 0)) return bad("skip-cost", "the cost of leaving out the next is not >= 0");
  const bool can_skip = i + 2 < data.samples.size() && data.samples[i + 2].clip == s.clip &&
                        s.kept != 0 && data.samples[i + 2].kept != 0;
  if (std::isfinite(s.skip_cost) && !can_skip) {
    return bad("skip-cost", "the next but one does not belong to the same clip, or was not kept");
  }
  return {};
}

// One byte a sample: looked up for every entry of every table.
std::vector<std::uint8_t> kept_of(const SpriteData& data) {
  std::vector<std::uint8_t> kept;
  kept.reserve(data.samples.size());
  for (const Sample& s : data.samples) kept.push_back(s.kept != 0 ? 1 : 0);
  return kept;
}

// A job for either half of the samples; what the first half finds comes first.
template <class Job>
Check check_halves(std::uint64_t bytes, std::uint32_t count, const Job& job) {
  Check bad[2];
  run_halves(bytes, count, [&](std::uint32_t first, std::uint32_t last) {
    bad[last == count ? 1 : 0] = job(first, last);
  });
  return bad[0] ? bad[0] : bad[1];
}

// Without a branch for each; check_row says what is wrong.
bool is_good_row(const SpriteData& data, std::span<const std::uint8_t> kept, std::uint32_t i) {
  const auto n = static_cast<std::uint32_t>(kept.size());
  const auto row = std::span(data.transitions)
                       .subspan(data.row_start[i], data.row_start[i + 1] - data.row_start[i]);
  unsigned all = row.empty() ? 1u : kept[i];
  std::int64_t before = -1;
  for (const Transition& t : row) {
    const bool finite = t.cost >= 0 && t.cost <= std::numeric_limits<float>::max();
    all &= unsigned{t.to > before} & unsigned{finite} & kept[std::min(t.to, n - 1)] &
           unsigned{t.to < n};
    before = t.to;
  }
  return all != 0;
}

Check check_row(const SpriteData& data, std::span<const std::uint8_t> kept, std::uint32_t i) {
  const auto row = [&](std::string_view code, const std::string& what) {
    return finding(code, "TRAN", 0, "transitions of sample " + number(i) + ": " + what);
  };
  std::int64_t before = -1;
  for (std::uint32_t k = data.row_start[i]; k < data.row_start[i + 1]; ++k) {
    const Transition& t = data.transitions[k];
    if (t.to >= kept.size()) {
      return row("transition-index", "to sample " + number(t.to) + " of " + number(kept.size()));
    }
    if (t.to <= before) return row("transition-order", "not in ascending order");
    if (!std::isfinite(t.cost) || t.cost < 0) {
      return row("transition-cost",
                 "the cost to sample " + number(t.to) + " is not a finite number >= 0");
    }
    if (kept[i] == 0 || kept[t.to] == 0) {
      return row("transition-kept", "from or to a sample that was not kept");
    }
    before = t.to;
  }
  return {};
}

Check check_transitions(const SpriteData& data) {
  const std::size_t n = data.samples.size();
  const auto& row = data.row_start;
  const bool ends = row.size() == n + 1 && row.front() == 0 &&
                    row.back() == data.transitions.size() &&
                    data.transitions.size() <= kMaxTransitions;
  if (!ends || !std::is_sorted(row.begin(), row.end())) {
    return finding(
        "row-order", "TRAN", 0,
        "the row starts do not ascend from 0 to the number of transitions, one a sample");
  }
  const std::vector<std::uint8_t> kept = kept_of(data);
  return check_halves(data.transitions.size() * sizeof(Transition), static_cast<std::uint32_t>(n),
                      [&](std::uint32_t first, std::uint32_t last) -> Check {
                        for (std::uint32_t i = first; i < last; ++i)
                          if (!is_good_row(data, kept, i)) return check_row(data, kept, i);
                        return {};
                      });
}

Check check_mode_settings(const ControlMode& mode, const std::string& what) {
  if (mode.name.empty()) return finding("mode-name", "CTRL", 0, what + "has no name");
  if (Check bad = check_text(mode.name, "CTRL", what + "name")) return bad;
  if (!(mode.alpha >= 0 && mode.alpha < 1)) {
    return finding("alpha", "CTRL", 0, what + "alpha is not in [0, 1)");
  }
  if (!(std::isfinite(mode.w1) && mode.w1 >= 0)) {
    return finding("w1", "CTRL", 0, what + "w1 is not a finite number >= 0");
  }
  if (!(mode.cap >= 0)) return finding("cap", "CTRL", 0, what + "cap is not a number >= 0");
  const auto is_number = [](float value) { return std::isfinite(value) && value >= 0; };
  if (!is_number(mode.turn_w1) || !is_number(mode.speed_weight) || !is_number(mode.skip_price) ||
      !is_number(mode.exit_angle) || !is_number(mode.dead_angle) ||
      !(mode.change_rate >= 0 && mode.change_rate < 1)) {
    return finding("mode-setting", "CTRL", 0, what + "a setting is not a finite number >= 0");
  }
  if (mode.power != 1 && mode.power != 2) {
    return finding("power", "CTRL", 0, what + "power " + number(mode.power) + ", 1 or 2 is due");
  }
  // cos^2 + sin^2 = 1 within the rounding of the two, and less than a right angle.
  const double cosine = mode.bend_cos, sine = mode.bend_sin, one = kUnitOne;
  if (!(cosine > 0 && sine >= 0 &&
        std::fabs(cosine * cosine + sine * sine - one * one) < 4 * one)) {
    return finding("bend", "CTRL", 0, what + "bend is not a cosine and a sine");
  }
  if (mode.headings != 8 && mode.headings != 16 && mode.headings != 32) {
    return finding("headings", "CTRL", 0,
                   what + number(mode.headings) + " headings, 8, 16 or 32 are due");
  }
  if (mode.stages < 1 || mode.stages > kMaxTables || mode.tables() > kMaxTables) {
    return finding("stages", "CTRL", 0,
                   what + number(mode.stages) + " stages of " + number(mode.headings) +
                       " headings, 1 to " + number(kMaxTables / (mode.headings + 2)) + " are due");
  }
  if (mode.by_state && mode.stages != 2) {
    return finding("switching", "CTRL", 0,
                   what + number(mode.stages) + " stages that are left by state, 2 are due");
  }
  if (mode.headings < kMaxHeadings && mode.served_headings >> mode.headings != 0) {
    return finding("served", "CTRL", 0, what + "serves headings beyond the last");
  }
  for (Direction d : mode.table_of) {
    if (static_cast<int>(d) >= kDirectionCount) {
      return finding("table-of", "CTRL", 0,
                     what + "follows direction " + number(static_cast<unsigned>(d)) + " of 10");
    }
  }
  if (mode.served >> kDirectionCount != 0) {
    return finding("served", "CTRL", 0, what + "serves directions beyond the tenth");
  }
  const bool bounds = std::isfinite(mode.residual) && mode.residual >= 0 &&
                      std::isfinite(mode.error_bound) && mode.error_bound >= 0;
  if (!bounds) {
    return finding("residual", "CTRL", 0,
                   what + "residual or error bound is not a finite number >= 0");
  }
  return {};
}

// What is wrong with an entry of next; empty: nothing.
Check check_entry(const SpriteData& data, const ControlMode& mode, std::size_t table,
                  std::uint32_t from, const std::string& what) {
  const std::size_t n = data.samples.size();
  const std::uint32_t to = mode.next[table * n + from];
  const auto bad = [&](std::string_view code, const std::string& found) {
    return finding(code, "CTRL", 0,
                   what + "table " + number(table) + ", sample " + number(from) + ": " + found);
  };
  if (data.samples[from].kept == 0) {
    if (to == kNoSample) return {};
    return bad("next-unkept", "was not kept but has a next");
  }
  if (to >= n) return bad("next-index", "next is sample " + number(to) + " of " + number(n));
  if (data.samples[to].kept == 0)
    return bad("next-kept", "next is sample " + number(to) + ", which was not kept");
  const bool skips = mode.plays_through && is_skip(data, from, to);
  if (is_natural(data, from, to) || skips || find_transition(data, from, to) != nullptr) return {};
  return bad("next-transition",
             "next is sample " + number(to) + ", but there is no such transition");
}

// A sample at a time: all that it may lead to is marked with its number, then every table's entry
// is looked up. check_entry says what is wrong.
Check check_entries(const SpriteData& data, const ControlMode& mode,
                    std::span<const std::uint8_t> kept, const std::string& what,
                    std::uint32_t first, std::uint32_t last) {
  const auto n = static_cast<std::uint32_t>(kept.size());
  const auto tables = static_cast<std::uint32_t>(mode.tables());
  std::vector<std::uint32_t> led_from(n, kNoSample);
  const auto mark = [&](std::uint32_t i) {
    for (std::uint32_t k = data.row_start[i]; k < data.row_start[i + 1]; ++k)
      led_from[data.transitions[k].to] = i;
    if (i + 1 < n && kept[i + 1] != 0 && is_natural(data, i, i + 1)) led_from[i + 1] = i;
    if (mode.plays_through && is_skip(data, i, i + 2)) led_from[i + 2] = i;
  };
  Check bad;
  for_each_sample(mode, n, first, last, [&](std::uint32_t i, const std::uint32_t* next) {
    if (bad) return;
    unsigned all = 1;
    if (kept[i] != 0) {
      mark(i);
      for (std::uint32_t t = 0; t < tables; ++t)
        all &= unsigned{led_from[std::min(next[t], n - 1)] == i} & unsigned{next[t] < n};
    } else {
      for (std::uint32_t t = 0; t < tables; ++t) all &= unsigned{next[t] == kNoSample};
    }
    for (std::uint32_t t = 0; all == 0 && t < tables && !bad; ++t)
      bad = check_entry(data, mode, t, i, what);
  });
  return bad;
}

// Every kept sample must lead to a kept one along a transition that exists.
Check check_next(const SpriteData& data, const ControlMode& mode,
                 std::span<const std::uint8_t> kept, const std::string& what) {
  const std::size_t n = data.samples.size(), tables = mode.tables();
  if (mode.next.size() != tables * n || mode.go.size() != tables * n ||
      mode.arrived.size() != (mode.by_state ? n : 0)) {
    return finding("next-size", "CTRL", 0,
                   what + number(mode.next.size()) + " entries of next, " + number(tables * n) +
                       " are due, and as many of go");
  }
  return check_halves(4 * tables * n, static_cast<std::uint32_t>(n),
                      [&](std::uint32_t first, std::uint32_t last) {
                        return check_entries(data, mode, kept, what, first, last);
                      });
}

Check check_costs(const ControlMode& mode, std::span<const std::uint8_t> kept,
                  const std::string& what, std::uint32_t first, std::uint32_t last) {
  const std::size_t n = kept.size();
  for (std::size_t table = first; table < last; ++table) {
    const std::span<const float> go = std::span(mode.go).subspan(table * n, n);
    const auto is_good = [&](std::size_t i) {  // finite, >= 0; 0 where the sample was not kept
      const float most = kept[i] != 0 ? std::numeric_limits<float>::max() : 0.0f;
      return int{go[i] >= 0} & int{go[i] <= most};
    };
    int all = 1;
    for (std::size_t i = 0; i < n; ++i) all &= is_good(i);
    if (all != 0) continue;
    std::size_t bad = 0;
    while (is_good(bad) != 0) ++bad;
    return finding("go", "CTRL", 0,
                   what + "table " + number(table) + ", sample " + number(bad) +
                       ": the cost to go is not a finite number >= 0, or not 0 for a sample that "
                       "was not kept");
  }
  return {};
}

// What is compared when a game asks for variety or clearance.
Check check_go(const ControlMode& mode, std::span<const std::uint8_t> kept,
               const std::string& what) {
  const auto tables = static_cast<std::uint32_t>(mode.tables());
  if (Check bad =
          check_halves(4 * mode.go.size(), tables, [&](std::uint32_t first, std::uint32_t last) {
            return check_costs(mode, kept, what, first, last);
          }))
    return bad;
  for (std::size_t i = 0; i < mode.arrived.size(); ++i) {
    if (mode.headings == kMaxHeadings || mode.arrived[i] >> mode.headings == 0) continue;
    return finding("arrived", "CTRL", 0,
                   what + "sample " + number(i) + " goes along a heading beyond the last");
  }
  return {};
}

Check check_modes(const SpriteData& data) {
  if (data.modes.empty() || data.modes.size() > kMaxModes) {
    return finding("mode-count", "CTRL", 0,
                   number(data.modes.size()) + " modes, 1 to " + number(kMaxModes) + " are due");
  }
  const std::vector<std::uint8_t> kept = kept_of(data);
  for (std::size_t m = 0; m < data.modes.size(); ++m) {
    const std::string what = "mode " + number(m) + ": ";
    if (Check bad = check_mode_settings(data.modes[m], what)) return bad;
    if (Check bad = check_next(data, data.modes[m], kept, what)) return bad;
    if (Check bad = check_go(data.modes[m], kept, what)) return bad;
    for (std::size_t other = 0; other < m; ++other) {
      if (data.modes[other].name == data.modes[m].name) {
        return finding("mode-name", "CTRL", 0, what + "has the name of mode " + number(other));
      }
    }
  }
  return {};
}

}  // namespace

namespace {

// Moving: faster than a quarter of the 95th percentile of speed.
std::uint32_t usual_step(std::span<const Sample> samples) {
  std::vector<std::uint32_t> steps;
  for (const Sample& s : samples)
    if (s.kept != 0) steps.push_back(s.step_length);
  if (steps.empty()) return 0;
  const auto fast = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 95 / 100);
  std::nth_element(steps.begin(), fast, steps.end());
  const std::uint32_t least = *fast / 4;
  const auto first = std::partition(steps.begin(), steps.end(),
                                    [least](std::uint32_t step) { return step <= least; });
  if (first == steps.end()) return 0;
  const auto middle = first + (steps.end() - first) / 2;
  std::nth_element(first, middle, steps.end());
  return *middle;
}

// Over a stride or so of the clip, so that it does not swing with every step of a leg.
std::vector<std::uint32_t> pace_of(std::span<const Sample> samples) {
  constexpr std::size_t kReach = 6;
  std::vector<std::uint32_t> pace(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::uint64_t sum = 0, count = 0;
    const std::size_t last = std::min(samples.size() - 1, i + kReach);
    for (std::size_t j = i < kReach ? 0 : i - kReach; j <= last; ++j) {
      if (samples[j].clip != samples[i].clip) continue;
      sum += samples[j].step_length;
      ++count;
    }
    pace[i] = static_cast<std::uint32_t>(sum / count);
  }
  return pace;
}

}  // namespace

Finding finding(std::string_view code, std::string_view section, std::uint64_t offset,
                std::string message, ErrorCode error) {
  return {error, {std::string(code), "error", std::string(section), offset, std::move(message)}};
}

Check check_sprite_data(const SpriteData& data) {
  if (Check bad = check_meta(data)) return bad;
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    if (Check bad = check_sample(data, i)) return bad;
  }
  if (Check bad = check_transitions(data)) return bad;
  if (Check bad = check_modes(data)) return bad;
  return check_optional(data);
}

void complete(Sprite::Impl& impl) {
  for (Sample& s : impl.data.samples) s.step_length = step_length(s.step_x, s.step_y);
  impl.usual_step = usual_step(impl.data.samples);
  impl.pace = pace_of(impl.data.samples);
  for (const ControlMode& mode : impl.data.modes)
    impl.ticks.push_back(make_tick_table(impl.data, mode));
  impl.action_list = list_actions(impl.data);
}

Check check_picture_sizes(const SpriteData& data) {
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    const Sample& s = data.samples[i];
    const bool has_picture = s.width != 0 && s.height != 0;
    const bool no_picture = s.width == 0 && s.height == 0;
    if (s.kept == 1 ? has_picture : no_picture) continue;
    return finding("picture-size", "SAMP", 0,
                   "sample " + number(i) + ": picture of " + number(s.width) + " x " +
                       number(s.height) + " pixels for a sample that was " +
                       (s.kept == 1 ? "kept" : "not kept"));
  }
  return {};
}

}  // namespace detail

Sprite::Sprite(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Sprite::Sprite(Sprite&&) noexcept = default;
Sprite& Sprite::operator=(Sprite&&) noexcept = default;
Sprite::~Sprite() = default;

const SpriteData& Sprite::data() const noexcept { return impl_->data; }

std::span<const Transition> Sprite::transitions(std::uint32_t sample) const noexcept {
  const SpriteData& d = impl_->data;
  return {d.transitions.data() + d.row_start[sample],
          d.row_start[sample + 1] - d.row_start[sample]};
}

double Sprite::fps() const noexcept {
  return static_cast<double>(impl_->data.fps_numerator) / impl_->data.fps_denominator;
}

bool Sprite::is_natural(std::uint32_t from, std::uint32_t to) const noexcept {
  return to < impl_->data.samples.size() && detail::is_natural(impl_->data, from, to);
}

bool Sprite::is_skip(std::uint32_t from, std::uint32_t to) const noexcept {
  return detail::is_skip(impl_->data, from, to);
}

float Sprite::transition_cost(std::uint32_t from, std::uint32_t to) const noexcept {
  if (is_natural(from, to)) return 0;
  if (is_skip(from, to)) return impl_->data.samples[from].skip_cost;
  const Transition* found = detail::find_transition(impl_->data, from, to);
  return found ? found->cost : std::numeric_limits<float>::infinity();
}

int Sprite::find_mode(std::string_view name) const noexcept {
  const auto& modes = impl_->data.modes;
  for (std::size_t m = 0; m < modes.size(); ++m) {
    if (modes[m].name == name) return static_cast<int>(m);
  }
  return -1;
}

namespace {

// Borrows a decoder from the sprite's idle ones, so that any number of threads may decode at once
// and none takes its memory anew each time.
class BorrowedCodec {
 public:
  explicit BorrowedCodec(const Sprite::Impl& impl) : impl_(impl) {
    const std::lock_guard lock(impl.mutex);
    if (impl.idle.empty()) {
      codec_ = std::make_unique<detail::FrameCodec>();
      impl.idle.reserve(++impl.codecs);  // so that giving back cannot fail
    } else {
      codec_ = std::move(impl.idle.back());
      impl.idle.pop_back();
    }
  }
  BorrowedCodec(const BorrowedCodec&) = delete;
  BorrowedCodec& operator=(const BorrowedCodec&) = delete;
  ~BorrowedCodec() {
    const std::lock_guard lock(impl_.mutex);
    impl_.idle.push_back(std::move(codec_));
  }
  detail::FrameCodec* operator->() { return codec_.get(); }

 private:
  const Sprite::Impl& impl_;
  std::unique_ptr<detail::FrameCodec> codec_;
};

// Into an Image or a TrimmedImage.
template <typename Picture>
Result<void> decode(const Sprite::Impl& impl, std::uint32_t sample, Picture& out) {
  const Sample& s = impl.data.samples[sample];
  try {
    if (impl.frames.empty() || s.kept == 0) {
      out.width = out.height = 0;
      out.rgba.clear();
      if constexpr (requires { out.blocks; }) out.blocks.clear();
      return {};
    }
    const detail::FrameEntry& entry = impl.frames[sample];
    BorrowedCodec codec(impl);
    const auto bytes = codec->input(entry.bytes);
    if (auto read = impl.source.read(impl.fram_offset + entry.offset, bytes); !read) {
      return read.error();
    }
    if (detail::hash_bytes(bytes) == entry.sum && codec->decode(s.width, s.height, out)) return {};
    return Error{ErrorCode::CorruptData, impl.source.name() + ": picture of sample " +
                                             std::to_string(sample) + " is damaged"};
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory,
                 "out of memory for the picture of sample " + std::to_string(sample)};
  }
}

}  // namespace

Result<void> Sprite::decode_frame(std::uint32_t sample, Image& out) const {
  assert(sample < impl_->data.samples.size());
  return decode(*impl_, sample, out);
}

bool Sprite::has_blocks() const noexcept { return impl_->has_blocks; }

std::size_t Sprite::picture_bytes(std::uint32_t sample) const noexcept {
  assert(sample < impl_->data.samples.size());
  return impl_->frames.empty() ? 0 : impl_->frames[sample].bytes;
}

Result<void> Sprite::Impl::decode_trimmed(std::uint32_t sample, detail::TrimmedImage& out) const {
  return decode(*this, sample, out);
}

Result<Sprite> make_sprite(SpriteData data) {
  try {
    if (detail::Check bad = detail::check_sprite_data(data)) {
      return Error{bad->error, bad->issue.section + ": " + bad->issue.message};
    }
    auto impl = std::make_unique<Sprite::Impl>();
    impl->data = std::move(data);
    detail::complete(*impl);
    return Sprite(std::move(impl));
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, "out of memory for a sprite"};
  }
}

std::uint32_t step_length(std::int32_t x, std::int32_t y) noexcept {
  const auto ax = static_cast<std::uint64_t>(std::abs(std::int64_t{x}));
  const auto ay = static_cast<std::uint64_t>(std::abs(std::int64_t{y}));
  const std::uint64_t square = ax * ax + ay * ay;  // at most 2^63
  // The double root is right to one unit; the rest is exact.
  auto root = static_cast<std::uint64_t>(std::sqrt(static_cast<double>(square)));
  while (root * root > square) --root;
  while ((root + 1) * (root + 1) <= square) ++root;
  return static_cast<std::uint32_t>(root);
}

std::int32_t step_per_tick(float velocity, std::uint32_t fps_numerator,
                           std::uint32_t fps_denominator) noexcept {
  const double step = static_cast<double>(velocity) * fps_denominator / fps_numerator * kFixedOne;
  constexpr double kMost = 2147483647.0;
  const double rounded = std::floor(step + 0.5);
  if (!(std::fabs(rounded) < kMost))
    return rounded > 0 ? 2147483647 : rounded < 0 ? -2147483647 : 0;
  return static_cast<std::int32_t>(rounded);
}

}  // namespace vsprite
