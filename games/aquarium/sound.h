// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// sound.h - bubbles, a bite, the end of a round: made in code at the start, mixed in the callback.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "vsprite/window.h"
#include "world.h"

namespace aquarium {

enum class Tone : std::uint8_t { Bubble, Bite, Dainty, Splash, Tick, Start, End };
inline constexpr std::size_t kToneCount = 7;

/// The recordings, mono at `rate`: no file, no device needed.
std::array<std::vector<float>, kToneCount> make_tones(int rate);

/// Mixes tones over a quiet stream of bubbles. `play` and `set_muted` may be called while another
/// thread is in `fill`; nothing locks.
class Mixer {
 public:
  explicit Mixer(int rate);
  void play(Tone tone, float gain, float pitch) noexcept;
  void set_muted(bool muted) noexcept { muted_.store(muted, std::memory_order_relaxed); }
  /// Adds nothing above 1 in size; called by the sound thread.
  void fill(std::span<float> out) noexcept;

 private:
  struct Order {
    Tone tone = Tone::Bubble;
    float gain = 0;
    float pitch = 1;
  };
  struct Voice {
    const std::vector<float>* tone = nullptr;
    float at = 0;
    float gain = 0;
    float pitch = 1;
  };
  void start(const Order& order) noexcept;

  std::array<std::vector<float>, kToneCount> tones_;
  int rate_;
  std::array<Order, 32> orders_;  ///< a ring: the game writes at `written_`, the mixer reads
  std::atomic<std::uint32_t> written_{0};
  std::uint32_t read_ = 0;
  std::atomic<bool> muted_{false};
  std::array<Voice, 16> voices_{};
  Random dice_{7};
  int until_bubble_ = 0;
  float loudness_ = 0;  ///< fades in and out, so that M does not click
  float hum_ = 0, low_ = 0;
};

/// The device and its mixer. Without a device nothing sounds and nothing fails.
class Sound {
 public:
  void open();
  void notice(const World& world) noexcept;
  void set_muted(bool muted) noexcept { mixer_.set_muted(muted); }

 private:
  static constexpr int kRate = 48000;
  Mixer mixer_{kRate};
  vsprite::Audio audio_;  ///< last: its destructor stops the callback before the mixer goes
};

}  // namespace aquarium
