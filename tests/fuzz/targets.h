// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// targets.h - what is fuzzed: functions that must return, whatever bytes they are given. libFuzzer
// drives them (VSPRITE_FUZZ=ON, clang); fuzz_replay runs the committed corpus with any compiler.
#pragma once

#include <cstdint>
#include <span>

namespace vsprite::fuzz {

/// Verifies, loads, steers for 200 ticks, decodes and draws. Aborts if verifying finds nothing in a
/// pack that then does not load or has a damaged picture.
void fuzz_pack(std::span<const std::uint8_t> bytes);
/// Decodes a PNG; what was decoded must survive a round trip.
void fuzz_frame(std::span<const std::uint8_t> bytes);
void fuzz_png(std::span<const std::uint8_t> bytes);
/// Reads a section of puppets, poses and draws them; written again they must be the same bytes.
void fuzz_puppet(std::span<const std::uint8_t> bytes);
/// Reads a section of example sets for a puppet of one parameter, and poses it.
void fuzz_sets(std::span<const std::uint8_t> bytes);
/// Parses a key script; its entries must come out in ascending order.
void fuzz_script(std::span<const std::uint8_t> bytes);

/// Puts right the sums and sizes of a mutated pack, so that mutations get past them. Returns the
/// new size, at most `capacity`.
std::size_t repair_pack(std::uint8_t* bytes, std::size_t size, std::size_t capacity);

}  // namespace vsprite::fuzz
