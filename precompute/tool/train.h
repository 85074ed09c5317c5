// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/train.h - the stage `train` over a work folder: labels in, classifier.toml and roc.svg out.
//
// Learned from are the film's own labels, and a person's answers where labels.sqlite holds any. The
// designer may move the line: with `moved` = 0.8 a pair is smooth where the learned D <= 0.8, and D
// is given in the moved unit everywhere else. The move is kept in classifier.toml and outlives new
// answers; what it would do is shown first.
#pragma once

#include <string>
#include <vector>

#include "tool/labels.h"
#include "tool/settings.h"

namespace vsprite {

/// The move to use: the setting `threshold`, else what classifier.toml holds, else 1.
double move_of(const Project& project, const Settings& settings);

/// Adds to the stage's key what is not always there: the move, and the answers that count.
/// Errors: those of labels.sqlite.
Result<void> add_labels_to_key(const Project& project, const Settings& settings, StageKey& key);

/// Trains, writes the files, returns the figures. Errors: BadContent, BadSetting, CannotWrite.
Result<Json> train_folder(const Project& project, const FeatureSet& set, const Settings& settings);

/// What the line at `move` gives; nothing is written.
struct MoveRow {
  double move = 1;
  std::uint64_t accepted = 0, transitions = 0;
  int kept = 0;              ///< samples in the strongly connected part; 0: no endless run is left
  double accepted_bad = 0;   ///< of the held-out visible jumps, share accepted
  double accepted_good = 0;  ///< of the held-out smooth pairs, share accepted
  FalseAccepts random;       ///< the same of the answers that chance picked
};
struct MovePreview {
  std::vector<MoveRow> rows;  ///< ascending: some usual moves, the saved one, the one asked for
  double saved = 1, asked = 1;
  bool by_person = false;  ///< the shares are over a person's answers
};
Result<MovePreview> preview_move(const Project& project, const FeatureSet& set,
                                 const Settings& settings);
std::string move_text(const MovePreview& preview);
Json move_json(const MovePreview& preview);

/// The curve as a picture, 480 x 480: smooth pairs accepted over visible jumps accepted.
std::string roc_svg(const HeldOut& checked);

}  // namespace vsprite
