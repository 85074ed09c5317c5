// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/sprite.h - the immutable asset: filmed samples, which may follow which, and where to go
// next.
//
// A video sprite (Schoedl & Essa, NIPS 2000) is a set of samples i = 0..N-1, grouped in clips: a
// trimmed picture, an anchor and a velocity each. A transition i -> j costs T_ij >= 0 (0 for the
// natural successor). For every command l the film's own transitions were solved beforehand for the
// discounted cost to go,
//
//     V_i = min_j [p(T_ij) + G_j],    G_j = w a_j(l) + a V_j,     [NIPS section 4, eq. 2]
//
// where a_j is how far sample j goes off the command and p the price of a jump (T itself in the
// mode of the paper). `next[table][sample]` holds the minimiser, `go[table][sample]` G. A `Sprite`
// is loaded by load_pack (pack.h), never changes, and may be read by any number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/image.h"
#include "vsprite/result.h"
#include "vsprite/shadow.h"
#include "vsprite/tagged.h"

namespace vsprite {

/// "No sample": the next of a sample that no stage kept.
inline constexpr std::uint32_t kNoSample = 0xFFFFFFFFu;

/// One filmed frame of the subject. Lengths in pixels of the sample image ("sprite pixels").
struct Sample {
  Vec2 anchor;                 ///< px from the image's top left; drawn at the actor's position
  Vec2 velocity;               ///< px/s, smoothed inside the clip
  std::int32_t step_x = 0;     ///< displacement per tick, 1/65536 px: velocity / fps, rounded
  std::int32_t step_y = 0;     ///< the same, downwards
  float area = 0;              ///< sum of alpha / 255, px^2
  float scale = 1;             ///< sprite pixels per film pixel
  std::uint16_t width = 0;     ///< of the image; 0 if the sample was not kept
  std::uint16_t height = 0;    ///< of the image; 0 if the sample was not kept
  std::uint16_t duration = 1;  ///< ticks that the sample is shown, >= 1
  std::uint16_t tag = 0;       ///< index into Sprite::tags()
  std::uint32_t clip = 0;      ///< samples of one clip are neighbours in time
  std::uint32_t frame = 0;     ///< frame of the film, from 0
  std::uint32_t mirror_of = kNoSample;  ///< the sample of which this is the mirror image
  std::uint32_t kept = 0;               ///< 1 if transitions lead in and out, else 0
  /// T of leaving the next sample out (playing at double rate): (D_i,i+1 + D_i+1,i+2) / 2;
  /// infinity where the clip ends before.
  float skip_cost = std::numeric_limits<float>::infinity();
  /// Length of (step_x, step_y), 1/65536 px; filled in by load_pack and make_sprite.
  std::uint32_t step_length = 0;
};

/// A jump or a natural continuation out of some sample.
struct Transition {
  std::uint32_t to = 0;
  float cost = 0;  ///< T_ij >= 0; 1 is the classifier's threshold
};

/// Headings that a mode may hold tables for, evenly spread and clockwise from right: 8, 16 or 32.
inline constexpr std::uint32_t kMaxHeadings = 32;
inline constexpr std::int32_t kUnitOne = 1 << 30;  ///< the number 1 in the sines and cosines below

/// One way of steering (DESIGN: "paper", "responsive"): settings and the solved tables.
/// Table index = group * stages + stage. Groups are the headings, then none, then rest. A change of
/// command enters the last stage. In the mode "paper" stage k has k free steps left and one is
/// spent a sample; in "responsive" stage 1 turns, and is left for stage 0, which cruises, at the
/// first sample that goes the commanded way.
struct ControlMode {
  std::string name;
  float alpha = 0;         ///< discount a, 0 <= a < 1
  float w1 = 0;            ///< price of a radian off the command at stage 0, >= 0
  float turn_w1 = 0;       ///< the same while turning, >= 0
  float cap = 0;           ///< transitions dearer than this were left out
  float change_rate = 0;   ///< chance that the player changes the command, per sample, [0, 1)
  float speed_weight = 0;  ///< price of standing still, in radians, >= 0
  float skip_price = 0;    ///< a play-through costs this times its own T, squared, >= 0
  float exit_angle = 0;    ///< a sample within this many radians of the command has turned
  float dead_angle = 0;    ///< radians off the command that cost nothing
  std::int32_t bend_cos = kUnitOne;  ///< cosine and sine, in 2^-30, of the largest angle by which
  std::int32_t bend_sin = 0;         ///< the displacement is turned towards the command
  std::uint32_t stages = 1;          ///< K + 1, or 2
  std::uint32_t headings = kCompassCount;  ///< 8, 16 or 32
  std::uint32_t power = 1;                 ///< of T in the price of a jump: 1 or 2
  bool by_state = false;       ///< the last stage is left by `arrived`, not by counting samples
  bool plays_through = false;  ///< the next sample may be left out
  std::array<Direction, kDirectionCount>
      table_of{};                      ///< the command actually followed for each command:
                                       ///< itself where served, else a near one, else Rest
  std::uint32_t served = 0;            ///< bit d: direction d can be travelled
  std::uint32_t served_headings = 0;   ///< bit h: heading h can be travelled
  double residual = 0;                 ///< largest |TV - V| over all tables
  double error_bound = 0;              ///< residual / (1 - a)
  std::vector<std::uint32_t> next;     ///< (tables, N), kNoSample where the sample was not kept
  std::vector<float> go;               ///< (tables, N) G_j, >= 0; 0 where the sample was not kept
  std::vector<std::uint32_t> arrived;  ///< (N) if by_state: bit h, the sample goes along heading h

  std::size_t tables() const noexcept { return std::size_t{headings + 2} * stages; }
};

/// Everything that a pack is made of but the pictures. Plain data.
struct SpriteData {
  std::string name;
  std::uint32_t fps_numerator = 30;  ///< ticks per second = numerator / denominator
  std::uint32_t fps_denominator = 1;
  float body_length = 0;  ///< median longer side of the alpha >= 128 box, px
  std::vector<std::string> tags{""};
  std::vector<Sample> samples;  ///< (N)
  std::vector<std::uint32_t>
      row_start;  ///< (N + 1), ascending: transitions of i are [row_start[i], row_start[i+1])
  std::vector<Transition> transitions;  ///< each row ascending by `to`
  std::vector<ControlMode> modes;       ///< at least one; the first is the default
  std::uint32_t start_sample = 0;       ///< where every run starts: the first kept sample
  // Of a sprite with tags (tagged.h); empty in others.
  float action_tau = 0;              ///< price of a tick, > 0
  std::uint32_t action_horizon = 0;  ///< longest deadline with a table of its own, ticks
  std::vector<ActionTable> actions;  ///< ascending by tag
  std::vector<std::string> event_names;
  std::vector<SampleEvent> events;  ///< ascending
  std::vector<BodyBox> bodies;      ///< ascending by tag; every tag that a sample has, or none
  // Of a sprite built with its shadow (shadow.h).
  float shadow_scale = 2;             ///< sprite pixels per pixel of a shadow, > 0
  std::vector<FilmedShadow> shadows;  ///< ascending by sample
};

/// A loaded pack: the data above, and the pictures, decoded on demand from the file, which
/// stays open: replacing it by another does not disturb a loaded sprite, and cutting it short costs
/// pictures, not the process.
/// Movable, not copyable. All const members may be called from any number of threads.
class Sprite {
 public:
  Sprite(Sprite&&) noexcept;
  Sprite& operator=(Sprite&&) noexcept;
  ~Sprite();

  const SpriteData& data() const noexcept;
  std::span<const Sample> samples() const noexcept { return data().samples; }
  std::span<const Transition> transitions(std::uint32_t sample) const noexcept;
  double fps() const noexcept;
  /// True if `to` is the film's own continuation of `from`: the next sample of the same clip.
  bool is_natural(std::uint32_t from, std::uint32_t to) const noexcept;
  /// True if `to` is `from` played at double rate: the next sample but one of the same clip.
  bool is_skip(std::uint32_t from, std::uint32_t to) const noexcept;
  /// T of the jump from -> to; 0 for the natural successor, infinity if there is none.
  float transition_cost(std::uint32_t from, std::uint32_t to) const noexcept;
  /// Of the pack that it was loaded from: the sum over all its sections' sums; 0 if there is none.
  std::uint64_t identity() const noexcept;
  /// What a game may play by name, in the order of the tags.
  std::span<const Action> actions() const noexcept;
  /// True if `sample` is one at which its tag begins: kept, and its predecessor is not of it.
  bool is_first(std::uint32_t sample) const noexcept;
  /// Index into data().modes, or -1.
  int find_mode(std::string_view name) const noexcept;

  /// Decodes the premultiplied picture of a sample into `out` (its memory is reused).
  /// Empty (0 x 0) for a sample that was not kept and in a sprite from make_sprite.
  /// Errors: CorruptData (the frame's own sum does not fit), CannotRead, OutOfMemory. Pre: sample <
  /// N.
  Result<void> decode_frame(std::uint32_t sample, Image& out) const;

  /// How the pack holds the pictures: FrameCache::blocks hands out those of a GPU-ready one.
  bool has_blocks() const noexcept;

  /// Bytes of that picture in the pack, compressed; 0 where it is empty. Pre: sample < N.
  std::size_t picture_bytes(std::uint32_t sample) const noexcept;

  struct Impl;  ///< the engine's own
  const Impl& impl() const noexcept { return *impl_; }
  explicit Sprite(std::unique_ptr<Impl> impl) noexcept;

 private:
  std::unique_ptr<Impl> impl_;
};

/// A velocity in px/s as displacement per tick in 1/65536 px, rounded to nearest: `Sample::step_x`.
std::int32_t step_per_tick(float velocity, std::uint32_t fps_numerator,
                           std::uint32_t fps_denominator) noexcept;

/// Length of a displacement, rounded down.
std::uint32_t step_length(std::int32_t x, std::int32_t y) noexcept;

/// A sprite from data alone, checked as load_pack checks a file; its pictures are empty. For tools
/// that steer before a pack is written. Errors: CorruptData, OutOfMemory.
Result<Sprite> make_sprite(SpriteData data);

}  // namespace vsprite
