// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/label_session.h - one sitting of a person who says which jumps look right; no window.
//
// A pair is shown with the classifier's guess, the person agrees or does not, the answer is on the
// disk before the next pair appears, and the classifier has learned from it. Undo goes back to the
// first answer ever given in this folder, redo forward again.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "similarity/ask.h"
#include "tool/labels.h"
#include "tool/settings.h"
#include "vsprite/image.h"

namespace vsprite {

/// What is to be judged: may sample j stand where sample i stands?
struct ShownPair {
  int i = 0, j = 0;
  float distance = 0;  ///< D by what is known so far
  bool at_random = false;
  std::optional<bool> taken_back;  ///< what an undone answer had said
  bool guess_smooth() const noexcept { return distance <= 1; }
};

struct LabelProgress {
  int goal = 0;                 ///< questions of this sitting
  int answered = 0;             ///< of these
  int smooth = 0, jumps = 0;    ///< pairs answered in this folder, ever
  int agreed = 0, guessed = 0;  ///< of all guesses ever, how many were right
  FalseAccepts random;          ///< of the guesses about pairs that chance picked
};

class LabelSession {
 public:
  /// Borrows all four. Errors: BadContent (too few samples to ask about), those of the work folder.
  static Result<LabelSession> open(const Project& project, const SampleNames& names,
                                   LabelStore& store, const Settings& settings);

  /// None: everything that could be asked has been.
  const std::optional<ShownPair>& current() const noexcept { return current_; }
  /// The answer about the current pair, durable on return; then the next pair is current.
  /// Pre: a pair is current. Errors: CannotWrite, InUse; the pair stays.
  Result<void> answer(bool smooth);
  /// Another pair instead; this one comes again in another sitting.
  void skip();
  /// False if there is nothing to undo, or redo. Errors: those of answer.
  Result<bool> undo();
  Result<bool> redo();

  const LabelProgress& progress() const noexcept { return progress_; }
  const FeatureSet& features() const noexcept { return set_; }
  /// Straight alpha; mirrored samples come mirrored. Errors: CorruptData.
  Result<Image> picture(int sample) const;

 private:
  LabelSession(const Project& project, const SampleNames& names, LabelStore& store, FeatureSet set);
  Result<void> learn();
  void ask();
  void show_again(const Answer& answer);

  const Project* project_;
  const SampleNames* names_;
  LabelStore* store_;
  FeatureSet set_;
  AskConfig config_;
  LabelledPairs film_;  ///< the film's own labels
  Classifier classifier_;
  std::vector<Candidate> pool_;
  std::map<std::pair<int, int>, int> in_pool_;
  std::vector<std::uint8_t> answered_, skipped_;  ///< (pool)
  std::optional<ShownPair> current_;
  LabelProgress progress_;
};

}  // namespace vsprite
