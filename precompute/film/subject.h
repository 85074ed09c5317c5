// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/subject.h - which part of every frame is the subject, and why a frame is of no use.
//
// The subject is followed from frame to frame by place and size. What touches it from outside, what
// hides it and what merely lies about is told from it by how parts come, merge and part again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "film/matte.h"
#include "vsprite/result.h"

namespace vsprite {

/// What is kept of a keyed frame while the film is being followed (small: a few hundred bytes).
struct FrameSummary {
  int index = 0;                    ///< film frame
  std::vector<Blob> blobs;          ///< largest first
  double difference = 0;            ///< KeyedFrame::difference
  std::vector<double> ground = {};  ///< (blobs) ground line, film px; empty where not asked for
  int lost_before = 0;              ///< frames missing before it, by the time stamps
};

/// What becomes of a frame.
enum class Fate : std::uint8_t {
  Kept,
  Duplicate,  ///< repeats the frame before, which is shown for longer
  Empty,      ///< no subject
  Border,     ///< the subject is cut by the frame's border
  Touched,    ///< something came in over the border and touches the subject, or has not left yet
  Hidden,     ///< another part covers or touches the subject
  Short       ///< usable, in a clip that is too short
};
inline constexpr int kFateCount = 7;
/// Names for tables and files: "kept", "duplicate", "empty", "border", "touched", "hidden",
/// "short".
const char* fate_name(Fate fate) noexcept;

/// Which part is the subject.
struct SubjectChoice {
  static constexpr int kOnly = 0;      ///< the only one; several of like size are refused
  static constexpr int kLargest = -1;  ///< the largest, whatever else is there
  int number = kOnly;                  ///< or N >= 1: number N in the picture of find_rivals
};

/// The subject through the film.
struct Track {
  std::vector<const Blob*> blob;     ///< (frames) into the summaries; null where there is none
  std::vector<Fate> fate;            ///< (frames) Kept, Empty, Border, Touched or Hidden
  std::vector<std::uint32_t> still;  ///< (frames) bit b: blob b is a thing that came and lies still
  std::vector<std::uint8_t> mixed;   ///< (frames) 1: its blob is another one of several too
  double usual_area = 0;             ///< px^2, median of the whole subject
  double body = 8;                   ///< px, usual longer side
};

/// Several parts of like size, where they show best.
struct Rivals {
  int position = -1;        ///< index into the summaries: the frame that shows most of them whole
  std::vector<Blob> parts;  ///< in that frame, of like size; number k is parts[k - 1]
  int frames = 0;           ///< that show more than one
  int present = 0;          ///< that show a subject at all
};
/// Empty (`position` -1) where the film has one subject. `fps`: frames a second of the summaries.
Rivals find_rivals(std::span<const FrameSummary> frames, double fps);

/// Errors: BadContent (no subject; several of like size and kOnly, with where and when; a number
/// that the picture does not show). `width`, `height`: of the film.
Result<Track> follow_subject(std::span<const FrameSummary> frames, double fps, int width,
                             int height, SubjectChoice choice);

namespace detail {

/// The middle value, the upper one of an even count; 0 of none.
double median(std::vector<double> values);
/// Between the anchors, px.
double distance(const Blob& a, const Blob& b);

}  // namespace detail
}  // namespace vsprite
