// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/label_store.h - a person's answers, in labels.sqlite.
//
//     answers(id, film_a, frame_a, mirrored_a, film_b, frame_b, mirrored_b, acceptable, at_random,
//             guess, taken_back)          application_id 'vspl', user_version 1
//
// Answers are only ever added, in the order they were given; of two about one pair the last counts.
// A sample is named by what was filmed - the film's hash, the frame, mirrored or not - never by its
// number: answers outlive a new segmentation. Undo marks the newest answer as taken back, redo the
// oldest of those as given again; both go back to the first answer ever, in any later session. A
// new answer ends what could be redone.
//
// Every call that changes something is one transaction, and on the disk when it returns.
#pragma once

#include <compare>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vsprite/result.h"

struct sqlite3;

namespace vsprite {

/// A sample, by what was filmed.
struct SampleName {
  std::string film;  ///< 16 hex digits: hash of the clip's file
  int frame = 0;     ///< film frame, from 0
  bool mirrored = false;
  auto operator<=>(const SampleName&) const = default;
};

struct Answer {
  SampleName a, b;
  bool acceptable = false;
  bool at_random = false;  ///< chance had picked the pair (ask.h)
  double guess = -1;       ///< D when it was asked; < 0: nobody guessed
  friend bool operator==(const Answer&, const Answer&) = default;
};

class LabelStore {
 public:
  /// Makes the file if it is not there. Errors: CannotCreate, CannotRead, BadFormat (another
  /// program's file), CorruptData, UnsupportedVersion (made by a newer vsprite), InUse.
  static Result<LabelStore> open(const std::string& path);

  /// Those that were not taken back, oldest first. Errors: CorruptData, CannotRead.
  Result<std::vector<Answer>> answers() const;
  /// All or none. Errors: CannotWrite (a full disk: says that earlier answers are kept), InUse.
  Result<void> add(std::span<const Answer> answers);
  /// The answer that was taken back, or given again; none if there is nothing to undo, or redo.
  Result<std::optional<Answer>> undo();
  Result<std::optional<Answer>> redo();

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept;
  };
  LabelStore(std::string path, std::unique_ptr<sqlite3, Close> database);
  Error fault(const char* doing) const;
  Error damaged(const std::string& how) const;
  Result<void> run(const char* sql);
  template <class Change>
  Result<void> transaction(Change change);
  Result<void> prepare();
  Result<void> check_whole();
  Result<std::vector<Answer>> select(const char* sql) const;
  Result<void> insert(std::span<const Answer> answers);
  Result<std::optional<Answer>> mark(const char* find, const char* update);

  std::string path_;
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace vsprite
