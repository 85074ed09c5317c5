// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Sounds of small bodies of water. A bubble rings like a mass on a spring (Minnaert 1933): a sine
// that decays, and rises a little as the bubble nears the surface.
#include "sound.h"

#include <algorithm>
#include <cmath>

namespace aquarium {

namespace {

constexpr float kTwoPi = 6.2831853f;

/// A sine from `low` to `high` hertz that dies away in about `seconds`.
std::vector<float> chirp(int rate, float seconds, float low, float high, float sharpness) {
  std::vector<float> out(static_cast<std::size_t>(seconds * static_cast<float>(rate)));
  float turn = 0;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const float t = static_cast<float>(k) / static_cast<float>(out.size());
    turn += (low + (high - low) * t * t) / static_cast<float>(rate);
    const float attack = std::min(1.0f, t * 40);
    out[k] = attack * std::exp(-sharpness * t) * std::sin(kTwoPi * turn);
  }
  if (!out.empty()) out.back() = 0;
  return out;
}

void mix_in(std::vector<float>& into, const std::vector<float>& what, float at_seconds, float gain,
            int rate) {
  const auto start = static_cast<std::size_t>(at_seconds * static_cast<float>(rate));
  into.resize(std::max(into.size(), start + what.size()));
  for (std::size_t k = 0; k < what.size(); ++k) into[start + k] += gain * what[k];
}

/// A struck glass: a tone with two overtones that die sooner.
std::vector<float> bell(int rate, float seconds, float hertz) {
  std::vector<float> out = chirp(rate, seconds, hertz, hertz, 5.5f);
  mix_in(out, chirp(rate, 0.6f * seconds, 2.76f * hertz, 2.76f * hertz, 7), 0, 0.28f, rate);
  mix_in(out, chirp(rate, 0.3f * seconds, 5.4f * hertz, 5.4f * hertz, 8), 0, 0.10f, rate);
  return out;
}

std::vector<float> bite(int rate, float pitch) {
  std::vector<float> out = chirp(rate, 0.09f, 380 * pitch, 820 * pitch, 4);
  mix_in(out, chirp(rate, 0.12f, 620 * pitch, 1250 * pitch, 5), 0.055f, 0.7f, rate);
  return out;
}

std::vector<float> melody(int rate, std::span<const float> notes, float beat) {
  std::vector<float> out;
  for (std::size_t k = 0; k < notes.size(); ++k)
    mix_in(out, bell(rate, 1.1f, notes[k]), beat * static_cast<float>(k), 0.5f, rate);
  return out;
}

}  // namespace

std::array<std::vector<float>, kToneCount> make_tones(int rate) {
  constexpr std::array<float, 3> kStart{523.25f, 659.25f, 783.99f};
  constexpr std::array<float, 5> kEnd{783.99f, 659.25f, 698.46f, 783.99f, 1046.5f};
  std::array<std::vector<float>, kToneCount> tones;
  const auto put = [&](Tone tone, std::vector<float> sound) {
    tones[static_cast<std::size_t>(tone)] = std::move(sound);
  };
  put(Tone::Bubble, chirp(rate, 0.11f, 520, 760, 5));
  put(Tone::Bite, bite(rate, 1));
  std::vector<float> dainty = bite(rate, 1.2f);
  mix_in(dainty, bell(rate, 0.7f, 1318.5f), 0.05f, 0.35f, rate);
  put(Tone::Dainty, std::move(dainty));
  put(Tone::Splash, chirp(rate, 0.07f, 900, 300, 6));
  put(Tone::Tick, bell(rate, 0.25f, 880));
  put(Tone::Start, melody(rate, kStart, 0.11f));
  put(Tone::End, melody(rate, kEnd, 0.16f));
  return tones;
}

Mixer::Mixer(int rate) : tones_(make_tones(rate)), rate_(rate) {}

void Mixer::play(Tone tone, float gain, float pitch) noexcept {
  const std::uint32_t at = written_.load(std::memory_order_relaxed);
  orders_[at % orders_.size()] = {tone, gain, pitch};
  written_.store(at + 1, std::memory_order_release);
}

void Mixer::start(const Order& order) noexcept {
  const auto idle = std::find_if(voices_.begin(), voices_.end(),
                                 [](const Voice& v) { return v.tone == nullptr; });
  if (idle == voices_.end()) return;
  *idle = {&tones_[static_cast<std::size_t>(order.tone)], 0, order.gain, order.pitch};
}

void Mixer::fill(std::span<float> out) noexcept {
  const std::uint32_t written = written_.load(std::memory_order_acquire);
  if (written - read_ > orders_.size())
    read_ = written - static_cast<std::uint32_t>(orders_.size());
  for (; read_ != written; ++read_) start(orders_[read_ % orders_.size()]);
  const float wanted = muted_.load(std::memory_order_relaxed) ? 0.0f : 1.0f;
  for (float& sample : out) {
    if (--until_bubble_ <= 0) {
      until_bubble_ = static_cast<int>(dice_.between(0.05f, 0.55f) * static_cast<float>(rate_));
      start({Tone::Bubble, dice_.between(0.015f, 0.06f), dice_.between(0.6f, 2.2f)});
    }
    hum_ += 0.0025f * (dice_.between(-1, 1) - hum_);  // the pump behind the glass: noise, made dull
    low_ += 0.01f * (hum_ - low_);
    float sum = 0.5f * low_;
    for (Voice& voice : voices_) {
      if (voice.tone == nullptr) continue;
      const auto k = static_cast<std::size_t>(voice.at);
      if (k + 1 >= voice.tone->size()) {
        voice.tone = nullptr;
        continue;
      }
      const float part = voice.at - static_cast<float>(k);
      sum += voice.gain * ((*voice.tone)[k] * (1 - part) + (*voice.tone)[k + 1] * part);
      voice.at += voice.pitch;
    }
    loudness_ += 0.0008f * (wanted - loudness_);
    sample = std::clamp(loudness_ * sum, -1.0f, 1.0f);
  }
}

void Sound::open() {
  audio_.open([this](std::span<float> out) { mixer_.fill(out); }, kRate);
}

void Sound::notice(const World& world) noexcept {
  for (const Event& event : world.events) {
    const float pitch = 1 + 0.09f * static_cast<float>(event.combo);
    switch (event.kind) {
      case EventKind::Bite:
        mixer_.play(event.points >= 30 * event.combo ? Tone::Dainty : Tone::Bite, 0.42f, pitch);
        break;
      case EventKind::Stolen:
        mixer_.play(Tone::Bite, 0.12f, 0.7f);
        break;
      case EventKind::Splash:
        mixer_.play(Tone::Splash, 0.10f, 1);
        break;
      case EventKind::LastSeconds:
        mixer_.play(Tone::Tick, 0.16f, 1);
        break;
      case EventKind::Start:
        mixer_.play(Tone::Start, 0.35f, 1);
        break;
      case EventKind::End:
        mixer_.play(Tone::End, 0.40f, 1);
        break;
    }
  }
}

}  // namespace aquarium
