// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Three passes over the summaries: what lies still beside something that moves is no subject; the
// subject is followed by place and size; then every frame's fate, by how parts merge and part.
#include "film/subject.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace vsprite {
namespace {

constexpr double kLikeSize = 0.4;      // a second part this large against the first is a rival
constexpr double kRivalShare = 0.2;    // of the frames; more make the film one of several subjects
constexpr double kSpeck = 0.1;         // of the usual area; smaller is no subject
constexpr double kAreaJump = 3;        // from one frame to the next: another part, or a cut
constexpr double kSwell = 1.25;        // more than its usual area: something has joined it
constexpr double kStillSeconds = 3;    // a part that stays this long beside another one is a thing
constexpr double kStillShift = 1.5;    // px that its centre may wander meanwhile
constexpr double kStillArea = 1.15;    // and its area
constexpr double kBody = 0.3;          // of the usual area: a part that can hide the subject
constexpr double kHiddenSeconds = 10;  // longer than this no part covers the subject
constexpr double kTrust = 0.3;         // of a frame's motion in the velocity of a part
constexpr int kCoast = 15;             // frames that a part out of sight moves on as it did
constexpr int kNearBorder = 4;         // who left is looked for as far off as after these frames
constexpr int kForget = 60;            // frames that another part is remembered, gone or mixed

using detail::distance;
using detail::median;

double longer_side(const Blob& blob) { return std::max(blob.box.width, blob.box.height); }

double unlike(double a, double b) { return a > b ? a / b : b / a; }

// Pixels between two boxes; 0 where they meet.
int gap(const Rect& a, const Rect& b) {
  const int x = std::max({a.x - (b.x + b.width), b.x - (a.x + a.width), 0});
  const int y = std::max({a.y - (b.y + b.height), b.y - (a.y + a.height), 0});
  return std::max(x, y);
}

std::string at_text(const Blob& blob) {
  return "(" + std::to_string(static_cast<int>(blob.anchor_x)) + ", " +
         std::to_string(static_cast<int>(blob.anchor_y)) + ")";
}

std::uint32_t bit(std::size_t blob) { return blob < 32 ? 1u << blob : 0u; }

// ---- things that lie about ----

struct Thing {
  Blob first;  // as it was first seen: a thing that creeps is none
  int latest = -1;
  int seen = 0, beside = 0;  // frames in which it was seen, and in which something else was too
  std::vector<std::pair<int, std::uint32_t>> places = {};  // frame, bit
};

void settle(const Thing& thing, double fps, std::vector<std::uint32_t>& still) {
  if (thing.seen < kStillSeconds * fps || 2 * thing.beside < thing.seen) return;
  for (const auto& [frame, mark] : thing.places) still[static_cast<std::size_t>(frame)] |= mark;
}

// A part that keeps its place and size for seconds while another one of some size is there.
std::vector<std::uint32_t> find_still(std::span<const FrameSummary> frames, double fps) {
  std::vector<std::uint32_t> still(frames.size());
  std::vector<Thing> open;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto& blobs = frames[f].blobs;
    for (std::size_t b = 0; b < blobs.size() && b < 32; ++b) {
      auto same = std::find_if(open.begin(), open.end(), [&](const Thing& t) {
        return t.latest < static_cast<int>(f) && distance(t.first, blobs[b]) < kStillShift &&
               unlike(t.first.area, blobs[b].area) < kStillArea;
      });
      if (same == open.end()) same = open.insert(open.end(), Thing{.first = blobs[b]});
      Thing& thing = *same;
      thing.latest = static_cast<int>(f);
      ++thing.seen;
      const bool other = std::any_of(blobs.begin(), blobs.end(), [&](const Blob& o) {
        return &o != &blobs[b] && !o.touches_border && o.area > kSpeck * blobs[b].area;
      });
      thing.beside += other;
      thing.places.emplace_back(static_cast<int>(f), bit(b));
    }
    // What lay long enough is known again after the subject stood before it.
    std::erase_if(open, [&](const Thing& t) {
      return t.seen < kStillSeconds * fps && t.latest + fps < static_cast<double>(f);
    });
  }
  for (const Thing& t : open) settle(t, fps, still);
  return still;
}

// ---- following ----

using Still = std::vector<std::uint32_t>;

bool lies(const Still& still, std::size_t frame, std::size_t blob) {
  return (still[frame] & bit(blob)) != 0;
}

// The usual area is that of the largest part that is whole in the picture.
double usual_area(std::span<const FrameSummary> frames, const Still& still) {
  std::vector<double> whole, cut;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    bool first = true;
    for (std::size_t b = 0; b < frames[f].blobs.size(); ++b) {
      if (lies(still, f, b)) continue;
      const Blob& blob = frames[f].blobs[b];
      if (first) cut.push_back(blob.area);
      first = false;
      // A crumb beside a subject that the border cuts is not what is usually whole.
      if (blob.touches_border || blob.area < kSpeck * cut.back()) continue;
      whole.push_back(blob.area);
      break;
    }
  }
  return median(whole.empty() ? cut : whole);
}

// A part is the subject if it is not a speck; the largest one, unless another of like size or of
// more usual size lies nearer to where the subject was.
void follow_largest(std::span<const FrameSummary> frames, Track& track) {
  const Blob* last = nullptr;
  const double usual = track.usual_area;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Blob* choice = nullptr;
    for (std::size_t b = 0; b < frames[f].blobs.size(); ++b) {
      const Blob& blob = frames[f].blobs[b];
      if (blob.area < kSpeck * usual || lies(track.still, f, b)) continue;
      if (!choice) {
        choice = &blob;
        continue;
      }
      const bool nearer = !last || distance(blob, *last) < distance(*choice, *last);
      const bool fits = blob.area > kLikeSize * choice->area ||
                        unlike(choice->area, usual) > 2 * unlike(blob.area, usual);
      if (nearer && fits) choice = &blob;
    }
    track.blob[f] = choice;
    if (choice && unlike(choice->area, usual) < kAreaJump) last = choice;
  }
}

// One of several that are followed at once, so that none is taken for another.
struct Mover {
  Blob alone;             // as it was last seen by itself; the anchor moves on while it is not
  const Blob* seen;       // the part that it was last seen in
  double vx = 0, vy = 0;  // px a frame
  int lost = 0;           // frames since it was last seen,
  int mixed = 0;          // or since it was last seen by itself
};

// Steps a frame: `part` is what it is seen in, perhaps together with others.
void move_on(Mover& mover, const Blob* part, bool by_itself) {
  Blob& alone = mover.alone;
  if (part && by_itself) {
    const double share = mover.mixed > 0 ? 0 : kTrust;
    mover.vx += share * (part->anchor_x - alone.anchor_x - mover.vx);
    mover.vy += share * (part->anchor_y - alone.anchor_y - mover.vy);
    alone = *part;
    mover.mixed = 0;
  } else {
    const bool coasts = ++mover.mixed <= kCoast;
    alone.anchor_x += coasts ? mover.vx : part ? part->anchor_x - mover.seen->anchor_x : 0;
    alone.anchor_y += coasts ? mover.vy : part ? part->anchor_y - mover.seen->anchor_y : 0;
  }
  mover.lost = part ? 0 : mover.lost + 1;
  if (part) mover.seen = part;
}

// The part of each mover (null: out of sight): the likest pairs of mover and part first; then who
// is out of sight is in what swelled at its place, and for a while wholly before or behind it.
std::vector<const Blob*> seen_in(const std::vector<Mover>& movers,
                                 const std::vector<const Blob*>& parts, const Track& track) {
  struct Pair {
    double cost;
    std::size_t mover;
    const Blob* part;
  };
  std::vector<Pair> pairs;
  for (std::size_t m = 0; m < movers.size(); ++m) {
    const Mover& mover = movers[m];
    // Out of sight it is looked for farther off the longer it is gone; over the border, near there.
    const int most = mover.seen->touches_border ? kNearBorder : 20;
    const double reach = track.body * (1 + 0.5 * std::min(mover.lost, most));
    const double due = m == 0 ? track.usual_area : mover.alone.area;
    for (const Blob* part : parts) {
      if (unlike(part->area, due) > kAreaJump || distance(*part, *mover.seen) > reach) continue;
      const double x = part->anchor_x - mover.alone.anchor_x - mover.vx;
      const double y = part->anchor_y - mover.alone.anchor_y - mover.vy;
      pairs.push_back({std::hypot(x, y) * unlike(part->area, mover.alone.area), m, part});
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.cost < b.cost; });
  std::vector<const Blob*> seen(movers.size());
  for (const Pair& pair : pairs)
    if (!seen[pair.mover] && std::find(seen.begin(), seen.end(), pair.part) == seen.end())
      seen[pair.mover] = pair.part;
  const auto own = seen;
  for (std::size_t m = 0; m < movers.size(); ++m)
    for (std::size_t o = 0; o < movers.size() && !seen[m]; ++o) {
      if (!own[o] || gap(own[o]->box, movers[m].seen->box) > 0) continue;
      const bool still_in = movers[m].seen == movers[o].seen && movers[m].mixed <= kForget;
      if (still_in || own[o]->area > kSwell * movers[o].alone.area) seen[m] = own[o];
    }
  return seen;
}

// From the frame in which it was pointed at, both ways, as are all others of like size: a part that
// was there beside it is never taken for it.
void follow_pointed(std::span<const FrameSummary> frames, std::size_t start, const Blob& seed,
                    int step, Track& track) {
  std::vector<Mover> movers = {{.alone = seed, .seen = &seed}};  // the first one is the subject
  for (auto f = static_cast<std::ptrdiff_t>(start);
       f >= 0 && f < static_cast<std::ptrdiff_t>(frames.size()); f += step) {
    const auto at = static_cast<std::size_t>(f);
    std::vector<const Blob*> parts;
    for (std::size_t b = 0; b < frames[at].blobs.size(); ++b) {
      const Blob& blob = frames[at].blobs[b];
      if (!lies(track.still, at, b) && kAreaJump * blob.area > track.usual_area)
        parts.push_back(&blob);
    }
    const auto seen = seen_in(movers, parts, track);
    const auto by_itself = [&](std::size_t m) {
      return std::count(seen.begin(), seen.end(), seen[m]) == 1;
    };
    for (std::size_t m = 0; m < movers.size(); ++m) move_on(movers[m], seen[m], by_itself(m));
    track.blob[at] = seen[0];
    track.mixed[at] = seen[0] && !by_itself(0);
    // Who comes while the subject is out of sight may be the subject, unless that left elsewhere.
    const Mover& subject = movers[0];
    if (subject.lost == 0 || (subject.seen->touches_border && subject.lost > kNearBorder))
      for (const Blob* part : parts)
        if (std::find(seen.begin(), seen.end(), part) == seen.end())
          movers.push_back({.alone = *part, .seen = part});
    movers.erase(std::remove_if(movers.begin() + 1, movers.end(),
                                [](const Mover& m) { return m.lost > kForget; }),
                 movers.end());
  }
}

void measure_body(Track& track) {
  std::vector<double> sides;
  for (const Blob* blob : track.blob)
    if (blob && !blob->touches_border) sides.push_back(longer_side(*blob));
  track.body = std::max(median(sides), 8.0);
}

// ---- fates ----

// Pixels between a box and the nearest border of the film.
int margin(const Rect& box, int width, int height) {
  return std::min({box.x, box.y, width - (box.x + box.width), height - (box.y + box.height)});
}

// What is near the subject in one frame and gone into it in the next. What vanishes elsewhere has
// not gone into it.
const Blob* merged_part(const FrameSummary& before, const Blob& subject_before,
                        const FrameSummary& now, const Blob& subject, double speck, double usual) {
  // A tail that parts from its body and joins it again is no other body: the whole stays usual.
  if (subject.area < kSwell * std::max(subject_before.area, usual)) return nullptr;
  for (const Blob& part : before.blobs) {
    if (&part == &subject_before || part.area < (part.touches_border ? speck : kBody * usual))
      continue;
    if (subject.area < subject_before.area + 0.5 * part.area && !part.touches_border) continue;
    if (gap(part.box, subject.box) > 0) continue;
    const bool remains = std::any_of(now.blobs.begin(), now.blobs.end(), [&](const Blob& b) {
      return &b != &subject && unlike(b.area, part.area) < 2 &&
             distance(b, part) < longer_side(part);
    });
    if (!remains) return &part;
  }
  return nullptr;
}

// How parts meet the subject and leave it again.
class Meeting {
 public:
  Meeting(std::span<const FrameSummary> frames, const Track& track, double fps, int width,
          int height)
      : frames_(frames), track_(track), fps_(fps), width_(width), height_(height) {}

  std::vector<Fate> fates() {
    std::vector<Fate> fates;
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const Blob* blob = track_.blob[f];
      if (blob && state_ == Fate::Kept) begin(f, *blob);
      if (blob && state_ != Fate::Kept && over(f, *blob)) state_ = Fate::Kept;
      // What lasts so long is no meeting: the subject has grown, or was never whole before.
      if (state_ != Fate::Kept && static_cast<double>(f - since_) > kHiddenSeconds * fps_) {
        for (std::size_t k = since_; k < f; ++k) fates[k] = alone(k);
        state_ = Fate::Kept;
      }
      fates.push_back(blob && state_ != Fate::Kept ? state_ : alone(f));
    }
    return fates;
  }

 private:
  Fate alone(std::size_t f) const {
    const Blob* blob = track_.blob[f];
    if (!blob) return Fate::Empty;
    if (blob->touches_border) return Fate::Border;
    return track_.mixed[f] ? Fate::Hidden : Fate::Kept;
  }

  void begin(std::size_t f, const Blob& blob) {
    const Blob* before = f > 0 ? track_.blob[f - 1] : nullptr;
    if (!before || before->touches_border) return;
    const Blob* part = merged_part(frames_[f - 1], *before, frames_[f], blob,
                                   kSpeck * track_.usual_area, track_.usual_area);
    // A subject walks up to the border; what joins it to the border in one frame is something else.
    const bool leapt = blob.touches_border &&
                       blob.area > kSwell * std::max(before->area, track_.usual_area) &&
                       margin(before->box, width_, height_) > 0.5 * track_.body;
    if (!part && !leapt) return;
    state_ = leapt || part->touches_border || blob.touches_border ? Fate::Touched : Fate::Hidden;
    since_ = f;
    hand_.reset();
    area_ = std::max(before->area, track_.usual_area);
  }

  bool over(std::size_t f, const Blob& blob) {
    const bool joined = blob.touches_border && state_ == Fate::Touched;
    if (joined || blob.area > kSwell * area_) {
      hand_.reset();
      return false;
    }
    if (state_ == Fate::Hidden) return true;
    // A hand that let go is still in the way of the next clip until it has left: the part that came
    // off the subject is followed. What moves at the border elsewhere is none of its business.
    const Blob* hand = nullptr;
    const Rect& from = hand_ ? *hand_ : blob.box;
    for (const Blob& b : frames_[f].blobs)
      if (&b != &blob && b.touches_border && b.area > kSpeck * track_.usual_area &&
          gap(b.box, from) <= 2 * track_.body && (!hand || gap(b.box, from) < gap(hand->box, from)))
        hand = &b;
    if (hand) hand_ = hand->box;
    return !hand;
  }

  std::span<const FrameSummary> frames_;
  const Track& track_;
  double fps_;
  int width_, height_;
  Fate state_ = Fate::Kept;
  std::size_t since_ = 0;
  double area_ = 0;
  std::optional<Rect> hand_;  // where what let go of the subject was last seen
};

Error no_subject(std::size_t frames) {
  return {ErrorCode::BadContent, "no subject: nothing differs from the screen in " +
                                     std::to_string(frames) + (frames == 1 ? " frame" : " frames") +
                                     "; due: one subject before a steady background"};
}

Error several(std::span<const FrameSummary> frames, const Rivals& rivals) {
  return {ErrorCode::BadContent,
          "several subjects of like size in " + std::to_string(rivals.frames) + " of " +
              std::to_string(rivals.present) + " frames, in frame " +
              std::to_string(frames[static_cast<std::size_t>(rivals.position)].index) + " at " +
              at_text(rivals.parts[0]) + " and " + at_text(rivals.parts[1]) +
              "; due: one subject, or --subject largest or its number"};
}

// What reaches in over the border is no rival.
std::vector<Blob> like_parts(const FrameSummary& frame, std::uint32_t still, double least) {
  std::vector<Blob> parts;
  for (std::size_t b = 0; b < frame.blobs.size(); ++b) {
    const Blob& blob = frame.blobs[b];
    if (blob.area > least && !blob.touches_border && (still & bit(b)) == 0) parts.push_back(blob);
  }
  return parts;
}

Rivals rivals_of(std::span<const FrameSummary> frames, const Track& track) {
  Rivals rivals;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (!track.blob[f]) continue;
    ++rivals.present;
    const double least = kLikeSize * std::max(track.blob[f]->area, track.usual_area);
    auto parts = like_parts(frames[f], track.still[f], least);
    if (parts.size() < 2) continue;
    ++rivals.frames;
    if (parts.size() <= rivals.parts.size()) continue;
    rivals.position = static_cast<int>(f);
    rivals.parts = std::move(parts);
  }
  if (rivals.frames <= kRivalShare * rivals.present) rivals = {};
  return rivals;
}

Track largest_track(std::span<const FrameSummary> frames, double fps) {
  Track track;
  track.blob.resize(frames.size());
  track.mixed.resize(frames.size());
  track.still = find_still(frames, fps);
  track.usual_area = usual_area(frames, track.still);
  follow_largest(frames, track);
  measure_body(track);
  return track;
}

}  // namespace

double detail::median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double detail::distance(const Blob& a, const Blob& b) {
  const double x = a.anchor_x - b.anchor_x;
  const double y = a.anchor_y - b.anchor_y;
  return std::sqrt(x * x + y * y);
}

const char* fate_name(Fate fate) noexcept {
  constexpr const char* kNames[kFateCount] = {"kept",    "duplicate", "empty", "border",
                                              "touched", "hidden",    "short"};
  return kNames[static_cast<std::size_t>(fate)];
}

Rivals find_rivals(std::span<const FrameSummary> frames, double fps) {
  return rivals_of(frames, largest_track(frames, fps));
}

Result<Track> follow_subject(std::span<const FrameSummary> frames, double fps, int width,
                             int height, SubjectChoice choice) {
  if (frames.empty()) return Error{ErrorCode::BadContent, "no subject: the film has no frames"};
  Track track = largest_track(frames, fps);
  if (std::all_of(track.blob.begin(), track.blob.end(), [](const Blob* b) { return !b; }))
    return no_subject(frames.size());
  if (choice.number != SubjectChoice::kLargest) {
    const Rivals rivals = rivals_of(frames, track);
    const auto shown = static_cast<int>(rivals.parts.size());
    if (rivals.position >= 0 && choice.number == SubjectChoice::kOnly)
      return several(frames, rivals);
    if (choice.number > std::max(shown, 1))
      return Error{ErrorCode::BadContent, "--subject " + std::to_string(choice.number) +
                                              ": the film shows " +
                                              std::to_string(std::max(shown, 1)) + " of like size"};
    if (choice.number > 0 && shown > 1) {
      const Blob& seed = rivals.parts[static_cast<std::size_t>(choice.number - 1)];
      const auto start = static_cast<std::size_t>(rivals.position);
      track.usual_area = seed.area;
      track.body = std::max(longer_side(seed), 8.0);
      follow_pointed(frames, start, seed, 1, track);
      follow_pointed(frames, start, seed, -1, track);
      measure_body(track);
    }
  }
  track.fate = Meeting(frames, track, fps, width, height).fates();
  return track;
}

}  // namespace vsprite
