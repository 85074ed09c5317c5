// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/keyed.h - keyed frames on disk, 64 to a file, between keying and cutting.
//
// A film is followed as a whole before a sprite can be cut (its size comes from the largest one),
// so the keyed frames wait in `keyed/000012.bin`, compressed. A chunk that stands is complete and
// has its sum: a segmentation that was killed keys at most one chunk again.
#pragma once

#include <string>
#include <vector>

#include "film/extract.h"
#include "tool/project.h"

namespace vsprite {

inline constexpr int kChunkFrames = 64;

/// `ground`: with the ground line of each blob.
FrameSummary summary_of(const KeyedFrame& frame, bool ground);

/// A keyed frame as bytes, its pictures compressed. Pure: any thread.
std::string pack_keyed(const KeyedFrame& frame);

class KeyedStore {
 public:
  /// Chunks made from anything but `origin` (a sum over film and settings) are removed.
  /// Errors: CannotCreate, CannotWrite.
  static Result<KeyedStore> open(const Project& project, const std::string& origin);

  /// The chunk's frames; nothing where it is absent or damaged (it is then keyed again).
  std::optional<std::vector<KeyedFrame>> read(int chunk) const;
  /// `frames`: from pack_keyed, in order. Errors: CannotCreate, CannotWrite.
  Result<void> write(int chunk, const std::vector<std::string>& frames) const;

  /// True if pictures cut for exactly this extraction may be kept; otherwise takes note of it after
  /// `clear` has removed what stands. Errors: those of `clear`, CannotWrite.
  Result<bool> resume_cutting(const std::string& extraction,
                              const std::function<Result<void>()>& clear) const;
  /// Removes everything.
  void remove() const;

 private:
  std::string folder_;
};

}  // namespace vsprite
