// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/plate.h - what the picture looks like without the subject.
//
// The screen's colour and spread are measured from sampled frames of the film: a robust surface
// where the screen has one colour, a robust temporal estimate per pixel where the camera stands.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "film/video.h"
#include "vsprite/result.h"

namespace vsprite {

enum class KeyKind {
  Auto,   ///< measured; the reason is reported
  Color,  ///< a screen of one colour (blue, green, black, white, ...), given or measured
  Plate,  ///< a standing camera before anything
  Alpha,  ///< the film brings its own coverage
  None    ///< the film has no background to remove: the whole frame is the subject
};

struct KeyConfig {
  KeyKind kind = KeyKind::Auto;
  std::uint8_t red = 0, green = 0, blue = 0;  ///< for Color when `color_given`
  bool color_given = false;
  int sample_count = 50;  ///< frames looked at, spread over the film, 8..200
};

/// Parses `auto`, `plate`, `alpha`, `none` or `#RRGGBB`. Errors: BadSetting.
Result<KeyConfig> parse_key(const std::string& text);

/// Seen bare; never bare and filled in; the subject itself perhaps, which was always about there.
enum PlateWitness : std::uint8_t { kBare, kInvented, kOccupied };

/// The background, per pixel, and how much it varies. Immutable once made.
struct ScreenModel {
  KeyKind kind = KeyKind::Color;
  std::string reason;  ///< why this kind: one sentence for the report
  int width = 0, height = 0;
  Frame plate;
  float color[3] = {};  ///< median screen colour, R G B, 0..255
  float noise[3] = {};  ///< rms over time of the bare screen, Y Cb Cr, code values

  // What the keyer works with. A cell is 2 x 2 pixels; planes are R, G, B as in Grid.
  std::vector<float> cells[3];           ///< mean of the plate, encoded, code values
  std::vector<float> linear[3];          ///< the same in linear light
  std::vector<float> slope[3];           ///< of the transfer there, linear light a code value
  std::vector<std::uint16_t> cell_luma;  ///< sum of four Y of the plate
  std::vector<std::uint16_t> luma;       ///< of each pixel, linear light x 65535
  float threshold = 9;                   ///< code values: what differs less is screen
  int key = -1;  ///< index of the colour difference that marks the screen, -1: none
  /// The subject's usual key strength, >= 1 (film/unmix.h); without a key its usual distance from
  /// the plate, linear light.
  float key_normaliser = 1;
  float subject_contrast = 0;  ///< the subject's usual distance from the plate, code values
  /// Of cells: 1 where the plate looks unlike the subject; empty: everywhere. Elsewhere a faint
  /// difference may as well be its shadow or reflection (kind Plate).
  std::vector<std::uint8_t> unlike;
  /// What each colour (16 steps of R, G, B) costs as the subject's, 64ths of a nat (film/cut.h);
  /// empty: it is not known (all kinds but Plate).
  std::vector<std::int16_t> subject_cost;
  /// Of cells, with subject_cost: what the plate says there, a PlateWitness.
  std::vector<std::uint8_t> witness;
  int opening = 2;   ///< cells, radius that removes tail and fins from the anchor's mask
  float hidden = 0;  ///< share of the plate that was never seen bare, 0..1

  /// `noise` of luma and colour together, as distances weigh them.
  float whole_noise() const noexcept;
};

/// Measures the screen. `frames`: 8 or more, spread over the film. Errors: BadContent (no steady
/// background can be found; says what was seen and what to do). Cost: some 40 ms a frame of 1080p,
/// spread over the threads of the arena that it is called in; the result does not depend on them.
Result<ScreenModel> measure_screen(std::span<const Frame> frames, const KeyConfig& config);

}  // namespace vsprite
