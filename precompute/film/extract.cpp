// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Follows the subject from frame to frame, then works on runs of frames: where the subject is whole
// and moves on without a jump is a clip. Duplicates: a frame that differs from the one before by
// far less than its neighbours do, while the subject moves. While it rests nothing is called a
// duplicate: near-identical frames are then what the animal does, and all of them stay samples.
#include "film/extract.h"

#include <algorithm>
#include <cmath>

#include "film/light.h"

namespace vsprite {
namespace {

constexpr double kLikeSize = 0.4;    // a second part this large against the first is a rival
constexpr double kRivalShare = 0.2;  // of the frames; more make the film one of several subjects
constexpr double kSpeck = 0.1;       // of the usual area; smaller is no subject
constexpr int kDuplicateReach = 8;   // frames either side that a difference is held against
constexpr double kDuplicateRatio = 0.25;
constexpr double kMoving = 0.25;  // px a frame over the reach; slower is rest
constexpr double kAreaJump = 3;   // from one frame to the next: a cut

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double distance(const Blob& a, const Blob& b) {
  const double x = a.anchor_x - b.anchor_x;
  const double y = a.anchor_y - b.anchor_y;
  return std::sqrt(x * x + y * y);
}

double longer_side(const Blob& blob) { return std::max(blob.box.width, blob.box.height); }

std::string at_text(const Blob& blob) {
  std::string text = "(";
  text += std::to_string(static_cast<int>(blob.anchor_x)) + ", ";
  return text + std::to_string(static_cast<int>(blob.anchor_y)) + ")";
}

// The subject's blob in each frame, null where there is none.
struct Track {
  std::vector<const Blob*> blob;
  double usual_area = 0;
  double body = 0;  // usual longer side, px
};

// The usual area is that of the largest part that is whole in the picture. A part is the subject if
// it is not a speck against that; the largest one, unless another of like size or of more usual
// size lies nearer to where the subject was.
Track follow(std::span<const FrameSummary> frames) {
  Track track;
  std::vector<double> areas;
  std::vector<double> cut_areas;
  for (const FrameSummary& frame : frames) {
    for (const Blob& blob : frame.blobs) {
      if (blob.touches_border) continue;
      areas.push_back(blob.area);
      break;
    }
    if (!frame.blobs.empty()) cut_areas.push_back(frame.blobs[0].area);
  }
  track.usual_area = median(areas.empty() ? cut_areas : areas);
  const auto unlike = [&](const Blob& blob) {
    return std::max(blob.area / track.usual_area, track.usual_area / blob.area);
  };
  const Blob* last = nullptr;
  std::vector<double> sides;
  for (const FrameSummary& frame : frames) {
    const Blob* choice = nullptr;
    for (const Blob& blob : frame.blobs) {
      if (blob.area < kSpeck * track.usual_area) continue;
      if (!choice) {
        choice = &blob;
        continue;
      }
      const bool nearer = !last || distance(blob, *last) < distance(*choice, *last);
      const bool fits = blob.area > kLikeSize * choice->area || unlike(*choice) > 2 * unlike(blob);
      if (nearer && fits) choice = &blob;
    }
    track.blob.push_back(choice);
    if (choice && unlike(*choice) < kAreaJump) last = choice;
    if (choice && !choice->touches_border) sides.push_back(longer_side(*choice));
  }
  track.body = std::max(median(sides), 8.0);
  return track;
}

Result<void> check_single(std::span<const FrameSummary> frames, const Track& track) {
  int present = 0;
  int rivals = 0;
  const FrameSummary* first = nullptr;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (!track.blob[f]) continue;
    ++present;
    const auto& blobs = frames[f].blobs;
    if (blobs.size() < 2 || blobs[1].area <= kLikeSize * track.blob[f]->area ||
        blobs[1].area <= kLikeSize * track.usual_area)
      continue;
    if (rivals++ == 0) first = &frames[f];
  }
  if (present == 0)
    return Error{ErrorCode::BadContent, "no subject: nothing differs from the screen in " +
                                            std::to_string(frames.size()) +
                                            " frames; due: one subject before a steady background"};
  if (rivals > kRivalShare * present)
    return Error{ErrorCode::BadContent,
                 "several subjects of like size in " + std::to_string(rivals) + " of " +
                     std::to_string(present) + " frames, first in frame " +
                     std::to_string(first->index) + " at " + at_text(first->blobs[0]) + " and " +
                     at_text(first->blobs[1]) + "; due: one subject; cut or mask the film"};
  return {};
}

// 1 where a frame repeats the one before.
std::vector<std::uint8_t> find_duplicates(std::span<const FrameSummary> frames,
                                          const Track& track) {
  const int n = static_cast<int>(frames.size());
  std::vector<std::uint8_t> repeats(frames.size());
  std::vector<double> near;
  for (int f = 1; f < n; ++f) {
    const Blob* here = track.blob[static_cast<std::size_t>(f)];
    const Blob* before = track.blob[static_cast<std::size_t>(f - 1)];
    if (!here || !before) continue;
    near.clear();
    const Blob* first = nullptr;
    const Blob* last = nullptr;
    int span = 0;
    for (int k = std::max(f - kDuplicateReach, 1); k <= std::min(f + kDuplicateReach, n - 1); ++k) {
      const Blob* other = track.blob[static_cast<std::size_t>(k)];
      if (!other) continue;
      near.push_back(frames[static_cast<std::size_t>(k)].difference);
      if (!first) first = other;
      last = other;
      ++span;
    }
    // Moving: by the way made over the reach, not by one step, which for a duplicate is nil.
    if (!first || span < 4 || distance(*first, *last) < kMoving * span) continue;
    if (frames[static_cast<std::size_t>(f)].difference < kDuplicateRatio * median(near))
      repeats[static_cast<std::size_t>(f)] = 1;
  }
  return repeats;
}

struct Kept {
  int frame;  // index into the summaries
  int duration;
};

using Clip = std::vector<Kept>;

std::vector<Clip> split_clips(std::span<const FrameSummary> frames, const Track& track,
                              const std::vector<std::uint8_t>& repeats, const ExtractConfig& config,
                              Extraction& result) {
  std::vector<Clip> clips;
  bool open = false;
  int run = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Blob* blob = track.blob[f];
    if (!blob || blob->touches_border) {
      ++(blob ? result.dropped_border : result.dropped_empty);
      open = false;
      continue;
    }
    if (open) {
      const Blob& before = *track.blob[f - 1];
      const bool jump = distance(*blob, before) > track.body;
      const bool swell =
          blob->area > kAreaJump * before.area || before.area > kAreaJump * blob->area;
      if (jump || swell) open = false;
    }
    if (open && repeats[f]) {
      ++result.duplicates;
      if (++run <= config.max_repeats) {
        ++clips.back().back().duration;
      } else {
        open = false;
      }
      continue;
    }
    run = 0;
    if (!open) clips.emplace_back();
    open = true;
    clips.back().push_back({static_cast<int>(f), 1});
  }
  std::erase_if(clips, [&](const Clip& clip) {
    const bool drop = static_cast<int>(clip.size()) < std::max(config.min_clip, 2);
    if (drop) result.dropped_short += static_cast<int>(clip.size());
    return drop;
  });
  return clips;
}

// Smooths to variance sigma^2 frames^2 by repeated [a, 1 - 2a, a], a <= 1/4: near Gaussian, no exp.
// Ends are extended along a straight line, so that steady motion stays as it is.
void smooth(std::vector<double>& x, double sigma) {
  const double variance = sigma * sigma;
  const int passes = static_cast<int>(std::ceil(2 * variance));
  if (passes == 0 || x.size() < 3) return;
  const double a = variance / (2.0 * passes);
  std::vector<double> next = x;
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
      next[i] = x[i] + a * (x[i - 1] - 2 * x[i] + x[i + 1]);
    x = next;
  }
}

std::vector<double> central_differences(const std::vector<double>& x) {
  std::vector<double> v(x.size());
  const std::size_t n = x.size();
  for (std::size_t i = 1; i + 1 < n; ++i) v[i] = 0.5 * (x[i + 1] - x[i - 1]);
  if (n > 1) {
    v[0] = x[1] - x[0];
    v[n - 1] = x[n - 1] - x[n - 2];
  }
  return v;
}

double rounded(double value, double steps) { return std::floor(value * steps + 0.5) / steps; }

// Velocities in film time: positions of dropped duplicates lie on the line between their
// neighbours.
void set_velocities(const Track& track, const Clip& clip, double fps, double sigma,
                    std::span<SampleRow> rows, double& squares) {
  const int first = clip.front().frame;
  const int count = clip.back().frame - first + 1;
  for (int axis = 0; axis < 2; ++axis) {
    const auto place = [&](const Kept& k) {
      const Blob& blob = *track.blob[static_cast<std::size_t>(k.frame)];
      return axis == 0 ? blob.anchor_x : blob.anchor_y;
    };
    std::vector<double> x(static_cast<std::size_t>(count));
    for (std::size_t k = 0; k < clip.size(); ++k) {
      const int at = clip[k].frame - first;
      x[static_cast<std::size_t>(at)] = place(clip[k]);
      if (k + 1 == clip.size()) break;
      const int gap = clip[k + 1].frame - clip[k].frame;
      for (int t = 1; t < gap; ++t)
        x[static_cast<std::size_t>(at + t)] =
            place(clip[k]) + (place(clip[k + 1]) - place(clip[k])) * t / gap;
    }
    const std::vector<double> raw = central_differences(x);
    smooth(x, sigma);
    const std::vector<double> v = central_differences(x);
    for (std::size_t k = 0; k < clip.size(); ++k) {
      const auto at = static_cast<std::size_t>(clip[k].frame - first);
      (axis == 0 ? rows[k].velocity_x : rows[k].velocity_y) = rounded(v[at] * fps, 1000);
      squares += (raw[at] - v[at]) * fps * ((raw[at] - v[at]) * fps);
    }
  }
}

// One scale for the film: the longest side of the largest image, margins included, fits.
double film_scale(const Track& track, const std::vector<Clip>& clips, int max_size) {
  int longest = 1;
  for (const Clip& clip : clips)
    for (const Kept& kept : clip) {
      const Rect& box = track.blob[static_cast<std::size_t>(kept.frame)]->box;
      longest = std::max({longest, box.width, box.height});
    }
  return longest + 2 <= max_size ? 1.0 : static_cast<double>(max_size - 2) / longest;
}

SampleRow make_row(const FrameSummary& frame, const Blob& blob, double scale) {
  SampleRow row;
  row.frame = frame.index;
  row.scale = scale;
  row.left = blob.box.x - 1 / scale;
  row.top = blob.box.y - 1 / scale;
  row.width = (std::ceil(blob.box.width * scale - 1e-6) + 2) / scale;
  row.height = (std::ceil(blob.box.height * scale - 1e-6) + 2) / scale;
  row.anchor_x = rounded(blob.anchor_x, 1000);
  row.anchor_y = rounded(blob.anchor_y, 1000);
  row.area = rounded(blob.area, 1000);
  return row;
}

Error nothing_left(const Extraction& result, const ExtractConfig& config) {
  return {ErrorCode::BadContent,
          "no clip of " + std::to_string(config.min_clip) + " samples is left: " +
              std::to_string(result.frames) + " frames, " + std::to_string(result.dropped_empty) +
              " without a subject, " + std::to_string(result.dropped_border) +
              " with the subject cut by the frame's border, " +
              std::to_string(result.dropped_short) +
              " in shorter clips; film the subject whole, for longer"};
}

}  // namespace

Result<Extraction> extract(std::span<const FrameSummary> frames, double fps,
                           const std::string& source, const ExtractConfig& config) {
  if (frames.empty()) return Error{ErrorCode::BadContent, "no subject: the film has no frames"};
  const Track track = follow(frames);
  if (auto single = check_single(frames, track); !single) return single.error();
  Extraction result;
  result.frames = static_cast<int>(frames.size());
  const auto repeats = find_duplicates(frames, track);
  const auto clips = split_clips(frames, track, repeats, config, result);
  if (clips.empty()) return nothing_left(result, config);
  result.clips = static_cast<int>(clips.size());
  const double scale = film_scale(track, clips, config.max_size);
  double squares = 0;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const std::size_t first = result.rows.size();
    for (const Kept& kept : clips[c]) {
      const auto f = static_cast<std::size_t>(kept.frame);
      SampleRow row = make_row(frames[f], *track.blob[f], scale);
      row.sample = static_cast<int>(result.rows.size());
      row.clip = static_cast<int>(c);
      row.source = source;
      row.duration = kept.duration;
      result.rows.push_back(std::move(row));
      result.labels.push_back(track.blob[f]->label);
    }
    set_velocities(track, clips[c], fps, config.sigma, std::span(result.rows).subspan(first),
                   squares);
  }
  result.velocity_noise =
      rounded(std::sqrt(squares / static_cast<double>(result.rows.size())), 1000);
  return result;
}

namespace {

// The film pixels under one image pixel, along one axis: from, to (outside), and the shares of the
// first and the last.
struct Reach {
  int from, to;
  float first, last;
};

Reach reach_of(double start, double step, int index, int origin, int size) {
  const double low = std::clamp(start + index * step - origin, 0.0, static_cast<double>(size));
  const double high =
      std::clamp(start + (index + 1) * step - origin, 0.0, static_cast<double>(size));
  Reach r{static_cast<int>(low), static_cast<int>(std::ceil(high)), 0, 0};
  r.first = static_cast<float>(std::min(high, r.from + 1.0) - low);
  r.last = static_cast<float>(high - (r.to - 1));
  return r;
}

float share_of(const Reach& r, int at) {
  return at == r.from ? r.first : at == r.to - 1 ? r.last : 1.0f;
}

}  // namespace

Image cut_sample(const KeyedFrame& frame, int label, const SampleRow& row) {
  Image image;
  image.width = static_cast<int>(row.width * row.scale + 0.5);
  image.height = static_cast<int>(row.height * row.scale + 0.5);
  image.rgba.assign(
      4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), 0);
  const auto& light = detail::linear_of_sums();
  const double step = 1 / row.scale;
  const auto whole = static_cast<float>(step * step);
  const auto crop_width = static_cast<std::size_t>(frame.crop.width);
  for (int v = 0; v < image.height; ++v) {
    const Reach rows = reach_of(row.top, step, v, frame.crop.y, frame.crop.height);
    for (int u = 0; u < image.width; ++u) {
      const Reach columns = reach_of(row.left, step, u, frame.crop.x, frame.crop.width);
      float sum[3] = {};
      float cover = 0;
      const std::uint8_t* only = nullptr;  // the pixel, where it is just one
      for (int y = rows.from; y < rows.to; ++y)
        for (int x = columns.from; x < columns.to; ++x) {
          const std::size_t at =
              static_cast<std::size_t>(y) * crop_width + static_cast<std::size_t>(x);
          if (frame.labels[at] != label) continue;
          only = frame.straight.rgba.data() + 4 * at;
          const float weight = share_of(rows, y) * share_of(columns, x) * only[3];
          cover += weight;
          for (int p = 0; p < 3; ++p)
            sum[p] += weight * light[static_cast<std::size_t>(4 * only[p])];
        }
      if (!(cover > 0)) continue;
      std::uint8_t* out = image.rgba.data() +
                          4 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(u));
      if (row.scale == 1) {
        std::copy(only, only + 4, out);
        continue;
      }
      const auto alpha = static_cast<int>(cover / whole + 0.5f);
      if (alpha == 0) continue;
      out[3] = static_cast<std::uint8_t>(std::min(alpha, 255));
      for (int p = 0; p < 3; ++p) out[p] = detail::encoded_of(sum[p] / cover);
    }
  }
  return image;
}

}  // namespace vsprite
