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

constexpr int kDuplicateReach = 8;  // frames either side that a difference is held against
constexpr double kDuplicateRatio = 0.25;
constexpr double kMoving = 0.25;      // px a frame over the reach; slower is rest
constexpr double kAreaJump = 3;       // from one frame to the next: a cut
constexpr std::size_t kCutReach = 8;  // frames either side that a change of look is held against
constexpr double kCutRatio = 6;
constexpr double kCutFloor = 20;  // code values
constexpr double kGroundShare = 0.0002;
constexpr double kHalf = 127.5;
constexpr std::ptrdiff_t kGroundReach = 2;  // frames either side of the ground line's median

using detail::distance;
using detail::median;

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
  int time;  // frames since the clip began, those left out or dropped counted
};

using Clip = std::vector<Kept>;

// The subject leaps, swells or changes its look from one frame to the next.
bool cuts(std::span<const FrameSummary> frames, const Track& track, std::size_t f) {
  const Blob& blob = *track.blob[f];
  const Blob& before = *track.blob[f - 1];
  if (distance(blob, before) > track.body) return true;
  if (blob.area > kAreaJump * before.area || before.area > kAreaJump * blob.area) return true;
  std::vector<double> near;
  for (std::size_t k = f > kCutReach ? f - kCutReach : 1;
       k < std::min(f + kCutReach, frames.size()); ++k)
    if (k != f && track.blob[k]) near.push_back(frames[k].difference);
  return near.size() >= kCutReach && frames[f].difference > kCutFloor &&
         frames[f].difference > kCutRatio * median(near);
}

std::vector<Clip> split_clips(std::span<const FrameSummary> frames, const Track& track,
                              const std::vector<std::uint8_t>& repeats, const ExtractConfig& config,
                              Extraction& result) {
  std::vector<Clip> clips;
  bool open = false;
  int run = 0, time = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    Fate& fate = result.fates[f];
    fate = track.fate[f];
    if (fate != Fate::Kept) {
      open = false;
      continue;
    }
    // The time of frames that the camera left out goes to the sample before, as a duplicate's does.
    const int lost = frames[f].lost_before;
    result.missing += lost;
    if (open && (cuts(frames, track, f) || lost > config.max_repeats)) {
      ++result.cuts;
      open = false;
    }
    if (open) clips.back().back().duration += lost;
    time = open ? time + 1 + lost : 0;
    if (open && repeats[f]) {
      fate = Fate::Duplicate;
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
    clips.back().push_back({static_cast<int>(f), 1, time});
  }
  std::erase_if(clips, [&](const Clip& clip) {
    const bool drop = static_cast<int>(clip.size()) < std::max(config.min_clip, 2);
    if (drop)
      for (const Kept& kept : clip)
        result.fates[static_cast<std::size_t>(kept.frame)] = Fate::Short;
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
void set_velocities(const Clip& clip, double fps, double sigma, const std::optional<Ground>& floor,
                    std::span<SampleRow> rows, double& squares) {
  const int count = clip.back().time + 1;
  for (int axis = 0; axis < 2; ++axis) {
    const auto place = [&](std::size_t k) {
      if (floor) {
        const FloorPlace at = on_floor(*floor, rows[k].anchor_x, rows[k].anchor_y);
        return axis == 0 ? at.x : at.y;
      }
      return axis == 0 ? rows[k].anchor_x : rows[k].anchor_y;
    };
    std::vector<double> x(static_cast<std::size_t>(count));
    for (std::size_t k = 0; k < clip.size(); ++k) {
      x[static_cast<std::size_t>(clip[k].time)] = place(k);
      if (k + 1 == clip.size()) break;
      const int gap = clip[k + 1].time - clip[k].time;
      for (int t = 1; t < gap; ++t)
        x[static_cast<std::size_t>(clip[k].time + t)] =
            place(k) + (place(k + 1) - place(k)) * t / gap;
    }
    const std::vector<double> raw = central_differences(x);
    smooth(x, sigma);
    const std::vector<double> v = central_differences(x);
    for (std::size_t k = 0; k < clip.size(); ++k) {
      const auto at = static_cast<std::size_t>(clip[k].time);
      (axis == 0 ? rows[k].velocity_x : rows[k].velocity_y) = rounded(v[at] * fps, 1000);
      squares += (raw[at] - v[at]) * fps * ((raw[at] - v[at]) * fps);
    }
  }
}

// The ground line of every frame in a clip, without the flicker of single frames: the median of as
// many frames of the clip on either side, so that steady motion stays as it is, at the ends too.
std::vector<double> steady_ground(std::span<const FrameSummary> frames, const Track& track,
                                  const std::vector<Clip>& clips) {
  std::vector<double> steady(frames.size(), 0.0);
  for (const Clip& clip : clips) {
    std::vector<double> lines;
    for (const Kept& kept : clip) {
      const auto f = static_cast<std::size_t>(kept.frame);
      const auto blob = static_cast<std::size_t>(track.blob[f] - frames[f].blobs.data());
      lines.push_back(blob < frames[f].ground.size() ? frames[f].ground[blob] : 0.0);
    }
    const auto count = static_cast<std::ptrdiff_t>(lines.size());
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      const auto reach = std::min({kGroundReach, k, count - 1 - k});
      steady[static_cast<std::size_t>(clip[static_cast<std::size_t>(k)].frame)] =
          median({lines.begin() + k - reach, lines.begin() + k + reach + 1});
    }
  }
  return steady;
}

// The floor that the film shows or the settings know.
Result<Ground> floor_of(const std::vector<double>& ground, const Track& track,
                        const std::vector<Clip>& clips, const ExtractConfig& config) {
  std::vector<Standing> sights;
  for (const Clip& clip : clips)
    for (const Kept& kept : clip) {
      const auto f = static_cast<std::size_t>(kept.frame);
      sights.push_back({ground[f], std::sqrt(track.blob[f]->area)});
    }
  return find_floor(sights, config.floor, config.width);
}

// One scale for the film: the longest side of the largest image, margins included, fits. `depth`:
// how large the subject is in a frame, 1 on the ground line.
double film_scale(const Track& track, const std::vector<Clip>& clips, int max_size,
                  const std::function<double(int)>& depth) {
  double longest = 1;
  for (const Clip& clip : clips)
    for (const Kept& kept : clip) {
      const Rect& box = track.blob[static_cast<std::size_t>(kept.frame)]->box;
      longest = std::max(longest, std::max(box.width, box.height) / depth(kept.frame));
    }
  return longest + 2 <= max_size ? 1.0 : (max_size - 2) / longest;
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
  std::string why;
  const std::pair<Fate, const char*> kReasons[] = {
      {Fate::Empty, " without a subject, "},
      {Fate::Border, " with the subject cut by the frame's border, "},
      {Fate::Touched, " with something that touches it, "},
      {Fate::Hidden, " with the subject hidden, "},
      {Fate::Short, " in shorter clips, "}};
  for (const auto& [fate, text] : kReasons)
    if (result.count(fate) > 0) why += std::to_string(result.count(fate)) + text;
  why.resize(why.size() - std::min<std::size_t>(why.size(), 2));
  return {ErrorCode::BadContent, "no clip of " + std::to_string(config.min_clip) +
                                     " samples is left: " + std::to_string(result.fates.size()) +
                                     (result.fates.size() == 1 ? " frame, " : " frames, ") + why +
                                     "; film the subject whole, for longer, from a stand"};
}

void add_mirrored(Extraction& result) {
  const std::size_t count = result.rows.size();
  for (std::size_t i = 0; i < count; ++i) {
    const SampleRow& row = result.rows[i];
    result.rows.push_back(mirrored(row, static_cast<int>(count + i), row.clip + result.clips));
    result.labels.push_back(result.labels[i]);
    result.positions.push_back(result.positions[i]);
  }
}

}  // namespace

int Extraction::count(Fate fate) const noexcept {
  return static_cast<int>(std::count(fates.begin(), fates.end(), fate));
}

std::vector<SampleRow> rows_on_floor(const Extraction& extraction) {
  std::vector<SampleRow> rows = extraction.rows;
  if (!extraction.floor) return rows;
  for (SampleRow& row : rows) {
    const FloorPlace at = on_floor(*extraction.floor, row.anchor_x, row.anchor_y);
    const double left = (row.anchor_x - row.left) / at.scale,
                 top = (row.anchor_y - row.top) / at.scale;
    row.anchor_x = rounded(at.x, 1000), row.anchor_y = rounded(at.y, 1000);
    row.left = row.anchor_x - left, row.top = row.anchor_y - top;
    row.width /= at.scale, row.height /= at.scale;
    row.area = rounded(row.area / (at.scale * at.scale), 1000);
    row.scale = extraction.scale;
  }
  return rows;
}

SampleRow mirrored(const SampleRow& row, int sample, int clip) {
  SampleRow other = row;
  other.sample = sample;
  other.clip = clip;
  other.left = 2 * row.anchor_x - row.left - row.width;
  other.velocity_x = row.velocity_x == 0 ? 0 : -row.velocity_x;
  other.mirror_of = row.sample;
  return other;
}

std::vector<double> ground_lines(const KeyedFrame& frame) {
  std::vector<double> lines;
  const auto width = static_cast<std::size_t>(frame.crop.width);
  for (const Blob& blob : frame.blobs) {
    const int left = blob.box.x, right = left + blob.box.width;
    const int top = blob.box.y, bottom = top + blob.box.height;
    // Where each column's coverage falls below a half for the last time: a soft skirt of little
    // coverage moves that by less than a pixel, however wide it is.
    std::vector<double> ends;
    std::vector<std::uint8_t> ended(static_cast<std::size_t>(blob.box.width));
    std::vector<int> below(ended.size());
    const double due = kGroundShare * blob.area;
    double sum = 0;
    const auto beyond = [&](double y) { return sum - y * static_cast<double>(ends.size()); };
    for (int y = bottom - 1; y >= top && (ends.empty() || beyond(y + 1.5) < due); --y) {
      const std::size_t start = static_cast<std::size_t>(y - frame.crop.y) * width;
      for (int x = left; x < right; ++x) {
        const auto column = static_cast<std::size_t>(x - left);
        const std::size_t at = start + static_cast<std::size_t>(x - frame.crop.x);
        if (ended[column]) continue;
        const int alpha = frame.labels[at] == blob.label ? frame.straight.rgba[4 * at + 3] : 0;
        if (alpha > kHalf) {
          ends.push_back(y + 0.5 + (alpha - kHalf) / (alpha - below[column]));
          sum += ends.back();
          ended[column] = 1;
        }
        below[column] = alpha;
      }
    }
    std::sort(ends.begin(), ends.end(), std::greater<>());
    double line = bottom;
    sum = 0;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      sum += ends[k];
      line = (sum - due) / static_cast<double>(k + 1);
      if (k + 1 < ends.size() && line >= ends[k + 1]) break;
    }
    lines.push_back(line);
  }
  return lines;
}

Result<Extraction> extract(std::span<const FrameSummary> frames, double fps,
                           const std::function<std::string(int)>& source,
                           const ExtractConfig& config) {
  const double rate = fps / config.stride;
  const auto track = follow_subject(frames, rate, config.width, config.height, config.subject);
  if (!track) return track.error();
  Extraction result;
  result.fates.resize(frames.size());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const Blob* blob = track->blob[f];
    result.followed.push_back(blob ? static_cast<int>(blob - frames[f].blobs.data()) : -1);
  }
  const auto repeats = find_duplicates(frames, *track);
  const auto clips = split_clips(frames, *track, repeats, config, result);
  if (clips.empty()) return nothing_left(result, config);
  result.clips = static_cast<int>(clips.size());
  const std::vector<double> ground = steady_ground(frames, *track, clips);
  if (config.floor.is_there()) {
    const auto floor = floor_of(ground, *track, clips, config);
    if (!floor) return floor.error();
    result.floor = *floor;
  }
  const auto depth = [&](int frame) {
    return result.floor ? on_floor(*result.floor, 0, ground[static_cast<std::size_t>(frame)]).scale
                        : 1.0;
  };
  result.scale = film_scale(*track, clips, config.max_size, depth);
  double squares = 0;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const std::size_t first = result.rows.size();
    for (const Kept& kept : clips[c]) {
      const auto f = static_cast<std::size_t>(kept.frame);
      SampleRow row = make_row(frames[f], *track->blob[f], result.scale / depth(kept.frame));
      if (config.ground) row.anchor_y = rounded(ground[f], 1000);
      row.sample = static_cast<int>(result.rows.size());
      row.clip = static_cast<int>(c);
      row.source = source(static_cast<int>(f));
      row.duration = kept.duration * config.stride;
      result.rows.push_back(std::move(row));
      result.labels.push_back(track->blob[f]->label);
      result.positions.push_back(kept.frame);
    }
    set_velocities(clips[c], rate, config.sigma, result.floor,
                   std::span(result.rows).subspan(first), squares);
  }
  result.velocity_noise =
      rounded(std::sqrt(squares / static_cast<double>(result.rows.size())), 1000);
  if (config.mirror) add_mirrored(result);
  return result;
}

Result<Extraction> extract(std::span<const FrameSummary> frames, double fps,
                           const std::string& source, const ExtractConfig& config) {
  return extract(
      frames, fps, [&source](int) { return source; }, config);
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
  const auto width = static_cast<std::size_t>(image.width);
  image.rgba.assign(4 * width * static_cast<std::size_t>(image.height), 0);
  float light[256];
  for (std::size_t code = 0; code < 256; ++code) light[code] = detail::linear_of_sums()[4 * code];
  const auto& codes = detail::encoded_of_steps();
  const double step = 1 / row.scale;
  const auto whole = static_cast<float>(step * step);
  const auto crop_width = static_cast<std::size_t>(frame.crop.width);
  std::vector<Reach> across;
  for (int u = 0; u < image.width; ++u)
    across.push_back(reach_of(row.left, step, u, frame.crop.x, frame.crop.width));

  // Means are separable. For each column of the image red, green, blue and the cover, which lanes
  // add at once: of one row of the film, summed once though two rows of the image may share it, and
  // of all rows under one of the image.
  std::vector<float> of_row(4 * width), of_rows(4 * width);
  int summed = -1;
  const auto sum_row = [&](int y) {
    const std::size_t at = static_cast<std::size_t>(y) * crop_width;
    const std::uint8_t* labels = frame.labels.data() + at;
    const std::uint8_t* pixels = frame.straight.rgba.data() + 4 * at;
    for (std::size_t u = 0; u < width; ++u) {
      float sum[4] = {};
      for (int x = across[u].from; x < across[u].to; ++x) {
        if (labels[x] != label) continue;
        const std::uint8_t* pixel = pixels + 4 * x;
        const float weight = share_of(across[u], x) * pixel[3];
        const float terms[4] = {light[pixel[0]], light[pixel[1]], light[pixel[2]], 1};
        for (int p = 0; p < 4; ++p) sum[p] += weight * terms[p];
      }
      std::copy_n(sum, 4, of_row.data() + 4 * u);
    }
    summed = y;
  };
  for (int v = 0; v < image.height; ++v) {
    const Reach rows = reach_of(row.top, step, v, frame.crop.y, frame.crop.height);
    std::fill(of_rows.begin(), of_rows.end(), 0.0f);
    for (int y = rows.from; y < rows.to; ++y) {
      if (y != summed) sum_row(y);
      const float share = share_of(rows, y);
      for (std::size_t i = 0; i < of_rows.size(); ++i) of_rows[i] += share * of_row[i];
    }
    std::uint8_t* out = image.rgba.data() + 4 * static_cast<std::size_t>(v) * width;
    for (std::size_t u = 0; u < width; ++u, out += 4) {
      const float* sum = of_rows.data() + 4 * u;
      const float cover = sum[3];
      const auto alpha = static_cast<int>(cover / whole + 0.5f);
      if (alpha == 0) continue;
      out[3] = static_cast<std::uint8_t>(std::min(alpha, 255));
      for (int p = 0; p < 3; ++p) out[p] = detail::encoded_of(sum[p] / cover, codes);
    }
  }
  return image;
}

CutShadow cut_shadow(const KeyedFrame& frame, int label, const SampleRow& row) {
  CutShadow out;
  const Rect& cells = frame.shade_cells;
  const auto at = [&cells](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.width) +
           static_cast<std::size_t>(x);
  };
  int left = cells.width, top = cells.height, right = 0, bottom = 0;
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x) {
      if (frame.shade_labels[at(x, y)] != label || frame.shade[at(x, y)] == 0) continue;
      left = std::min(left, x), right = std::max(right, x + 1);
      top = std::min(top, y), bottom = std::max(bottom, y + 1);
    }
  if (right <= left) return out;
  const double step = 1 / row.scale;  // cells a pixel: both count half the film's and the picture's
  Image& image = out.image;
  image.width = static_cast<int>(std::ceil((right - left) * row.scale - 1e-6)) + 2;
  image.height = static_cast<int>(std::ceil((bottom - top) * row.scale - 1e-6)) + 2;
  image.rgba.assign(
      4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height), 0);
  out.anchor_x = rounded((row.anchor_x / 2 - (cells.x + left)) * row.scale + 1, 1000);
  out.anchor_y = rounded((row.anchor_y / 2 - (cells.y + top)) * row.scale + 1, 1000);
  for (int v = 0; v < image.height; ++v) {
    const Reach rows = reach_of(top - step, step, v, 0, cells.height);
    for (int u = 0; u < image.width; ++u) {
      const Reach columns = reach_of(left - step, step, u, 0, cells.width);
      float sum = 0;
      for (int y = rows.from; y < rows.to; ++y)
        for (int x = columns.from; x < columns.to; ++x)
          if (frame.shade_labels[at(x, y)] == label)
            sum += share_of(rows, y) * share_of(columns, x) * frame.shade[at(x, y)];
      image.rgba[4 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                      static_cast<std::size_t>(u)) +
                 3] =
          static_cast<std::uint8_t>(std::min(sum / static_cast<float>(step * step) + 0.5f, 255.0f));
    }
  }
  return out;
}

}  // namespace vsprite
