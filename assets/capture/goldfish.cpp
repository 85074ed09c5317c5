// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
#include "goldfish.h"

#include <algorithm>
#include <cassert>

#include "choreography.h"
#include "fish_model.h"
#include "raster.h"
#include "screen.h"
#include "skin.h"

namespace vsprite::capture {
namespace {

constexpr std::uint64_t kScreenSeed = 8, kNoiseSeed = 51;
constexpr int kMoments = 4;       // pictures of the fish in one exposure
constexpr double kShutter = 0.5;  // of the time from frame to frame: 180 degrees

/// Film = alpha F + (1 - alpha) B, in place over a copy of the plate.
void composite(const Coverage& fish, int width, std::vector<float>& linear) {
  for (int y = 0; y < fish.box.height; ++y) {
    for (int x = 0; x < fish.box.width; ++x) {
      const auto from = static_cast<std::size_t>(y * fish.box.width + x);
      const auto to = static_cast<std::size_t>((fish.box.y + y) * width + fish.box.x + x);
      for (std::size_t c = 0; c < 3; ++c) {
        float& value = linear[3 * to + c];
        value = fish.colour[3 * from + c] + (1 - fish.alpha[from]) * value;
      }
    }
  }
}

void copy_truth(const Coverage& fish, TruthFrame& out) {
  double sum = 0, sum_x = 0, sum_y = 0;
  for (int y = 0; y < fish.box.height; ++y) {
    for (int x = 0; x < fish.box.width; ++x) {
      const auto from = static_cast<std::size_t>(y * fish.box.width + x);
      const auto to = static_cast<std::size_t>((fish.box.y + y) * out.width + fish.box.x + x);
      const float alpha = fish.alpha[from];
      if (alpha <= 0) continue;
      out.alpha[to] = alpha;
      for (std::size_t c = 0; c < 3; ++c) {
        out.foreground[3 * to + c] = fish.colour[3 * from + c] / alpha;
      }
      sum += alpha;
      sum_x += alpha * (fish.box.x + x + 0.5);
      sum_y += alpha * (fish.box.y + y + 0.5);
    }
  }
  out.area = sum;
  out.centroid_x = sum > 0 ? sum_x / sum : 0;
  out.centroid_y = sum > 0 ? sum_y / sum : 0;
}

}  // namespace

struct GoldfishFilm::Impl {
  std::vector<FishPose> poses;
  std::vector<float> plate;
  Surroundings around;
  Skin skin;

  /// The fish at a moment of a frame's exposure, which is centred on the frame's time.
  FishPose moment(int frame, int k) const {
    const auto at = [&](int f) -> const FishPose& {
      return poses[static_cast<std::size_t>(std::clamp(f, 0, static_cast<int>(poses.size()) - 1))];
    };
    const double t = kShutter * ((k + 0.5) / kMoments - 0.5);
    return t < 0 ? between(at(frame), at(frame - 1), -t) : between(at(frame), at(frame + 1), t);
  }
};

GoldfishFilm::GoldfishFilm() : impl_(std::make_unique<Impl>()) {
  impl_->poses = choreograph({}).poses;
  impl_->plate = paint_screen(width(), height(), kScreenSeed);
  impl_->around.screen = mean_colour(impl_->plate);
}

GoldfishFilm::~GoldfishFilm() = default;
GoldfishFilm::GoldfishFilm(GoldfishFilm&&) noexcept = default;
GoldfishFilm& GoldfishFilm::operator=(GoldfishFilm&&) noexcept = default;

int GoldfishFilm::frame_count() const noexcept { return static_cast<int>(impl_->poses.size()); }

const FishPose& GoldfishFilm::pose(int frame) const noexcept {
  assert(frame >= 0 && frame < frame_count());
  return impl_->poses[static_cast<std::size_t>(frame)];
}

FishBounds GoldfishFilm::bounds(int frame) const {
  FishBounds b{1e9, 1e9, -1e9, -1e9, false, false};
  std::vector<Vec3> points;
  for (const int k : {0, kMoments - 1}) {
    outline_fish(impl_->moment(frame, k), points);
    for (const Vec3& p : points) {
      b.left = std::min<double>(b.left, p.x - 1), b.right = std::max<double>(b.right, p.x + 1);
      b.top = std::min<double>(b.top, p.y - 1), b.bottom = std::max<double>(b.bottom, p.y + 1);
    }
  }
  const bool inside = b.left > 0 && b.top > 0 && b.right < width() && b.bottom < height();
  b.visible =
      !pose(frame).away && b.right > 0 && b.bottom > 0 && b.left < width() && b.top < height();
  b.touches_border = b.visible && !inside;
  return b;
}

void GoldfishFilm::render(int frame, TruthFrame& out) const {
  out.width = width();
  out.height = height();
  const auto pixels = static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  out.alpha.assign(pixels, 0);
  out.foreground.assign(3 * pixels, 0);
  out.plate.resize(3 * pixels);
  const float light = light_at(frame);
  std::transform(impl_->plate.begin(), impl_->plate.end(), out.plate.begin(),
                 [&](float b) { return light * b; });

  std::vector<float> linear = out.plate;
  Coverage fish;
  if (!pose(frame).away) {
    Surroundings around = impl_->around;
    around.light = light;
    std::vector<Mesh> moments(kMoments);
    for (int k = 0; k < kMoments; ++k) {
      build_fish(impl_->moment(frame, k), moments[static_cast<std::size_t>(k)]);
    }
    rasterize(moments, impl_->skin, around, width(), height(), fish);
    composite(fish, width(), linear);
  }
  copy_truth(fish, out);
  out.composite.width = width();
  out.composite.height = height();
  out.composite.rgba.assign(4 * pixels, 255);
  expose(linear, kNoiseSeed + static_cast<std::uint64_t>(frame), out.composite);
}

}  // namespace vsprite::capture
