// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/labels.h - a person's answers as labels of this work folder's samples, and as CSV.
//
// The CSV that `label --export` writes names samples by what was filmed:
//
//     film_a,frame_a,mirrored_a,film_b,frame_b,mirrored_b,acceptable,at_random,guess
//
// `label --answers` reads it, and as well the form with this folder's sample numbers that `dump
// --what labels` writes: i,j,acceptable[,by_person]. Columns may stand in any order; lines that
// begin with # and rows that no person gave (by_person 0) are passed over.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "similarity/classifier.h"
#include "tool/label_store.h"
#include "tool/project.h"

namespace vsprite {

/// Numbers and names of a work folder's samples.
class SampleNames {
 public:
  /// Errors: NotFound, CorruptData (no stage `segment` has finished here).
  static Result<SampleNames> of(const Project& project, const std::vector<SampleRow>& rows);
  /// Pre: 0 <= sample < size().
  const SampleName& name(int sample) const { return names_[static_cast<std::size_t>(sample)]; }
  std::optional<int> find(const SampleName& name) const;
  int size() const { return static_cast<int>(names_.size()); }

 private:
  std::vector<SampleName> names_;
  std::map<SampleName, int> numbers_;
};

/// A person's answers as they count: i < j, one label a pair, in the order of the first answer.
struct PersonLabels {
  std::vector<Label> labels;
  int answers = 0;
  int gone = 0;          ///< about samples that do not exist here (any more): kept, not used
  int repeated = 0;      ///< superseded by a later one about the same pair
  int disagreeing = 0;   ///< of these, those that said the opposite
  FalseAccepts guesses;  ///< of those that chance picked: what was guessed against what was said
};
PersonLabels resolve(const std::vector<Answer>& answers, const SampleNames& names);

/// The answers in the folder's labels.sqlite; none where there is no such file.
Result<PersonLabels> read_person_labels(const Project& project, const SampleNames& names);

/// The film's labels, without those whose pair a person has answered, then the person's.
std::vector<Label> merge_labels(std::vector<Label> film, const PersonLabels& person);

/// All labels of the folder: bootstrapped ones and answers. What `train` learns from.
struct FolderLabels {
  std::vector<Label> labels;
  PersonLabels person;
};
Result<FolderLabels> folder_labels(const Project& project, const FeatureSet& set, int pairs,
                                   std::uint64_t seed);

std::string format_answers(const std::vector<Answer>& answers);

struct ParsedAnswers {
  std::vector<Answer> answers;
  int passed_over = 0;  ///< rows that no person gave
};
/// Errors: BadContent, as `path:line:column: ...`.
Result<ParsedAnswers> parse_answers(const std::string& text, const std::string& path,
                                    const SampleNames& names);

}  // namespace vsprite
