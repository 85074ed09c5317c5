// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Body coordinates: s along the spine (0 nose, 1 tail root, beyond: the tail fin), `up` towards the
// back, `side` towards the flank that the camera sees when the fish faces right.
#include "fish_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vsprite::capture {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kCameraDistance = 1500;  // px; a long lens
constexpr float kCameraTilt = 0.11f;     // radians, looking down a little

/// A smooth curve through evenly or unevenly spaced knots (Catmull-Rom in value, linear in place).
template <std::size_t N>
float curve(const std::array<float, N>& at, const std::array<float, N>& value, float s) {
  if (s <= at[0]) return value[0];
  if (s >= at[N - 1]) return value[N - 1];
  std::size_t i = 0;
  while (s > at[i + 1]) ++i;
  const float h = at[i + 1] - at[i], t = (s - at[i]) / h;
  const auto slope = [&](std::size_t k) {
    const std::size_t a = k == 0 ? 0 : k - 1, b = k + 1 == N ? k : k + 1;
    return (value[b] - value[a]) / (at[b] - at[a]);
  };
  const float t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * value[i] + (t3 - 2 * t2 + t) * h * slope(i) +
         (3 * t2 - 2 * t3) * value[i + 1] + (t3 - t2) * h * slope(i + 1);
}

constexpr std::array<float, 12> kAt = {0,    .015f, .05f, .11f, .2f,  .32f,
                                       .45f, .58f,  .7f,  .82f, .92f, 1};
constexpr std::array<float, 12> kTop = {.008f, .042f, .076f, .118f, .168f, .208f,
                                        .218f, .196f, .155f, .108f, .076f, .072f};
constexpr std::array<float, 12> kBottom = {.008f, .044f, .080f, .122f, .164f, .198f,
                                           .210f, .196f, .158f, .105f, .072f, .068f};
constexpr std::array<float, 12> kWidth = {.008f, .038f, .064f, .090f, .115f, .128f,
                                          .128f, .110f, .080f, .048f, .026f, .016f};

float top(float s) { return curve(kAt, kTop, s); }
float bottom(float s) { return curve(kAt, kBottom, s); }
float width(float s) { return curve(kAt, kWidth, s); }

/// The bent axis: places and frames at even steps of s, in px, x right, y up, z towards the camera.
class Spine {
 public:
  explicit Spine(const FishPose& pose);
  struct Frame {
    Vec3 place, forward, up, side;
  };
  Frame at(float s) const;
  Vec3 point(float s, float up, float side) const {
    const Frame f = at(s);
    return f.place + kBodyLength * up * f.up + kBodyLength * side * f.side;
  }

 private:
  static constexpr int kSteps = 64;
  static constexpr float kEnd = 1.6f;
  std::array<Frame, kSteps + 1> frames_;
};

Spine::Spine(const FishPose& pose) {
  const auto yaw = static_cast<float>(std::remainder(pose.yaw, 2 * std::numbers::pi));
  const auto pitch = static_cast<float>(pose.pitch);
  const Vec3 forward{std::cos(pitch) * std::cos(yaw), std::sin(pitch),
                     std::cos(pitch) * std::sin(yaw)};
  const Vec3 up{-std::sin(pitch) * std::cos(yaw), std::cos(pitch),
                -std::sin(pitch) * std::sin(yaw)};
  const Vec3 side{-std::sin(yaw), 0, std::cos(yaw)};
  const auto phase = static_cast<float>(pose.tail_phase - std::floor(pose.tail_phase));
  const auto amplitude = static_cast<float>(pose.tail_amplitude);
  const auto bend = static_cast<float>(pose.bend), arch = static_cast<float>(pose.arch);
  for (int i = 0; i <= kSteps; ++i) {
    const float s = kEnd * static_cast<float>(i) / kSteps;
    const float grown = std::min(s, 1.25f);
    const float wave =
        amplitude * (0.06f + 0.5f * grown * grown) * std::sin(2 * kPi * (phase - 0.85f * s));
    const float reach = kCentre - std::min(s, 1.3f);
    const float sideways = bend * reach + wave, lift = arch * reach;
    Frame& f = frames_[static_cast<std::size_t>(i)];
    f.forward = normalized(std::cos(sideways) * std::cos(lift) * forward +
                           std::sin(sideways) * side + std::sin(lift) * up);
    f.up = normalized(up - dot(up, f.forward) * f.forward);
    f.side = cross(f.forward, f.up);
  }
  // Integrate from the nose on, then shift so that the body's centre is the origin.
  constexpr float step = kBodyLength * kEnd / kSteps;
  frames_[0].place = {};
  for (std::size_t i = 1; i <= kSteps; ++i) {
    const Vec3 mean = 0.5f * (frames_[i - 1].forward + frames_[i].forward);
    frames_[i].place = frames_[i - 1].place - step * mean;
  }
  const Vec3 origin = at(kCentre).place;
  for (Frame& f : frames_) f.place = f.place - origin;
}

Spine::Frame Spine::at(float s) const {
  const float p = std::clamp(s / kEnd, 0.0f, 0.9999f) * kSteps;
  const auto i = static_cast<std::size_t>(p);
  const float t = p - static_cast<float>(i);
  const Frame &a = frames_[i], &b = frames_[i + 1];
  return {mix(a.place, b.place, t), mix(a.forward, b.forward, t), mix(a.up, b.up, t),
          mix(a.side, b.side, t)};
}

/// Body coordinates in px to the film: the camera's tilt, its perspective, the fish's place.
class Camera {
 public:
  explicit Camera(const FishPose& pose)
      : x_(static_cast<float>(pose.x)), y_(static_cast<float>(pose.y)) {}
  static Vec3 tilted(Vec3 p) {
    static const float c = std::cos(kCameraTilt), s = std::sin(kCameraTilt);
    return {p.x, c * p.y - s * p.z, c * p.z + s * p.y};
  }
  Vec3 project(Vec3 p) const {
    const Vec3 q = tilted(p);
    const float scale = 1 / (1 - q.z / kCameraDistance);
    return {x_ + scale * q.x, y_ - scale * q.y, q.z};
  }

 private:
  float x_, y_;
};

/// Appends sheets of (n + 1) x (m + 1) vertices and their triangles; `place(u, v)` in px, y up.
class Builder {
 public:
  Builder(const FishPose& pose, Mesh& mesh) : camera_(pose), mesh_(mesh) {}

  template <class Place>
  void sheet(int n, int m, Place place, Material material, int rays);

 private:
  /// Normals from the neighbours on the sheet, then film coordinates.
  void finish(std::size_t first, int n, int m, bool wraps);

  Camera camera_;
  Mesh& mesh_;
};

/// Takes the same sheets, but keeps only some of their points.
class Outliner {
 public:
  Outliner(const FishPose& pose, std::vector<Vec3>& points) : camera_(pose), points_(points) {}

  template <class Place>
  void sheet(int n, int m, Place place, Material material, int) {
    if (material == Material::Eye) return;
    const int rows = material == Material::Body ? n / 4 : 4, columns = m / 2;
    float u, v;
    for (int i = 0; i <= rows; ++i) {
      for (int j = 0; j <= columns; ++j) {
        points_.push_back(
            camera_.project(place(static_cast<float>(i) / static_cast<float>(rows),
                                  static_cast<float>(j) / static_cast<float>(columns), u, v)));
      }
    }
  }

 private:
  Camera camera_;
  std::vector<Vec3>& points_;
};

void Builder::finish(std::size_t first, int n, int m, bool wraps) {
  const auto index = [&](int i, int j) {
    return first + static_cast<std::size_t>(i * (m + 1) + j);
  };
  const auto place = [&](int i, int j) {
    const Vertex& p = mesh_.vertices[index(i, j)];
    return Vec3{p.x, p.y, p.z};
  };
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= m; ++j) {
      const int before = j > 0 ? j - 1 : (wraps ? m - 1 : 0);
      const int after = j < m ? j + 1 : (wraps ? 1 : m);
      const Vec3 along = place(std::min(i + 1, n), j) - place(std::max(i - 1, 0), j);
      const Vec3 across = place(i, after) - place(i, before);
      Vertex& vertex = mesh_.vertices[index(i, j)];
      vertex.normal = Camera::tilted(normalized(cross(along, across)));
      vertex.tangent = Camera::tilted(normalized(along));
    }
  }
  for (std::size_t k = first; k < mesh_.vertices.size(); ++k) {
    Vertex& p = mesh_.vertices[k];
    const Vec3 q = camera_.project({p.x, p.y, p.z});
    p.x = q.x, p.y = q.y, p.z = q.z;
  }
}

template <class Place>
void Builder::sheet(int n, int m, Place place, Material material, int rays) {
  const std::size_t first = mesh_.vertices.size();
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= m; ++j) {
      Vertex vertex;
      const Vec3 p = place(static_cast<float>(i) / static_cast<float>(n),
                           static_cast<float>(j) / static_cast<float>(m), vertex.u, vertex.v);
      vertex.x = p.x, vertex.y = p.y, vertex.z = p.z;
      mesh_.vertices.push_back(vertex);
    }
  }
  auto& list = material == Material::Fin ? mesh_.fins : mesh_.opaque;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const auto a =
          static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(i * (m + 1) + j);
      const auto b = a + static_cast<std::uint32_t>(m + 1);
      list.push_back({{a, b, a + 1}, material, static_cast<std::uint8_t>(rays)});
      list.push_back({{a + 1, b, b + 1}, material, static_cast<std::uint8_t>(rays)});
    }
  }
  finish(first, n, m, material != Material::Fin);
}

template <class Sheets>
void add_body(const Spine& spine, Sheets& builder) {
  builder.sheet(
      72, 40,
      [&](float along, float around, float& u, float& v) {
        const float s = along * (0.35f * along + 0.65f);  // finer at the head
        const float angle = 2 * kPi * around;             // from the back, over the camera's side
        const float height = std::cos(angle) > 0 ? top(s) : bottom(s);
        u = s;
        v = around <= 0.5f ? 2 * around : 2 - 2 * around;
        // The section is an ellipse that narrows a little towards the back.
        const float narrow = 1 - 0.10f * std::max(0.0f, std::cos(angle));
        return spine.point(s, height * std::cos(angle), narrow * width(s) * std::sin(angle));
      },
      Material::Body, 0);
}

template <class Sheets>
void add_eye(const Spine& spine, Sheets& builder, float side) {
  constexpr float s = 0.118f, high = 0.026f, radius = 0.040f;
  const Spine::Frame f = spine.at(s);
  const Vec3 centre = spine.point(s, high, side * (width(s) * 0.93f - 0.010f));
  const Vec3 axis = normalized(side * f.side + 0.22f * f.forward + 0.10f * f.up);
  const Vec3 a = normalized(cross(f.up, axis)), b = cross(axis, a);
  builder.sheet(
      8, 20,
      [&](float out, float around, float& u, float& v) {
        const float polar = 0.04f + out * 1.31f, turn = 2 * kPi * around;
        u = out;
        v = around;
        const Vec3 radial = std::cos(turn) * a + std::sin(turn) * b;
        return centre +
               kBodyLength * radius * (0.72f * std::cos(polar) * axis + std::sin(polar) * radial);
      },
      Material::Eye, 0);
}

/// Phase of the tail beat in radians.
float beat(const FishPose& pose) {
  return 2 * kPi * static_cast<float>(pose.tail_phase - std::floor(pose.tail_phase));
}

template <class Sheets>
void add_tail_fin(const Spine& spine, const FishPose& pose, Sheets& builder) {
  const float phase = beat(pose),
              amplitude = 0.35f + 0.65f * static_cast<float>(pose.tail_amplitude);
  const float spread = 0.80f - 0.10f * static_cast<float>(pose.tail_amplitude) +
                       0.08f * static_cast<float>(pose.hover);
  builder.sheet(
      12, 36,
      [&](float u_in, float across, float& u, float& v) {
        u = u_in;
        v = across;
        const float lobe = 2 * across - 1;  // -1 below .. 1 above
        const float rim = std::abs(lobe);
        // Deep fork, rounded tips, a slightly scalloped edge.
        const float past_tip = std::max(0.0f, rim - 0.66f) / 0.34f;
        float length = 0.215f + 0.36f * std::pow(rim, 1.35f);
        length *= 1 - 0.46f * past_tip * past_tip * past_tip;
        length *= 1 + 0.015f * std::sin(34 * lobe) + (lobe > 0 ? 0.05f : 0.0f);
        const float angle = spread * lobe;
        const float back = length * u * std::cos(angle);
        const float up =
            0.062f * lobe * (1 + 0.2f * u) + length * u * std::sin(angle) * (1.12f - 0.30f * u);
        const float sway = 0.075f * amplitude * u * u * std::sin(phase - 5.6f - 1.9f * rim) +
                           0.042f * u * u * std::sin(phase - 2.0f - 4.5f * lobe);
        return spine.point(0.965f + back, up, sway);
      },
      Material::Fin, 19);
}

template <class Sheets>
void add_dorsal_fin(const Spine& spine, const FishPose& pose, Sheets& builder) {
  const float phase = beat(pose), fast = 1 - static_cast<float>(pose.hover);
  builder.sheet(
      8, 28,
      [&](float u_in, float along, float& u, float& v) {
        u = u_in;
        v = along;
        const float base = 0.33f + 0.42f * along;
        float length = 0.215f * smoothstep(-0.10f, 0.22f, along) * (1 - 0.60f * along * along);
        length *= (1 + 0.03f * std::sin(26 * along)) * (1 - 0.14f * fast);
        const float lean = 0.62f + 0.28f * along + 0.16f * fast;  // radians from upright
        const float sway = u * u *
                           (0.05f * std::sin(phase - 4.5f * base - 1.2f) +
                            0.018f * std::sin(2 * phase - 9 * along));
        const float back = length * u * std::sin(lean) * (0.8f + 0.35f * u);
        return spine.point(base + back, 0.95f * top(base) + length * u * std::cos(lean), sway);
      },
      Material::Fin, 15);
}

template <class Sheets>
void add_anal_fin(const Spine& spine, const FishPose& pose, Sheets& builder) {
  const float phase = beat(pose);
  builder.sheet(
      8, 12,
      [&](float u_in, float along, float& u, float& v) {
        u = u_in;
        v = along;
        const float base = 0.74f + 0.12f * along;
        const float length = 0.215f * (0.50f + 0.50f * std::sin(kPi * (0.16f + 0.80f * along)));
        const float lean = 0.72f + 0.42f * along;
        const float sway = u * u * 0.06f * std::sin(phase - 5.0f * base - 1.5f);
        const float back = length * u * std::sin(lean) * (0.85f + 0.3f * u);
        return spine.point(base + back, -0.92f * bottom(base) - length * u * std::cos(lean), sway);
      },
      Material::Fin, 7);
}

template <class Sheets>
void add_pelvic_fin(const Spine& spine, const FishPose& pose, Sheets& builder, float side) {
  const float phase = beat(pose), hover = static_cast<float>(pose.hover);
  const float splay = 0.34f + 0.30f * hover + 0.16f * std::sin(phase + 0.6f * side);
  builder.sheet(
      8, 12,
      [&](float u_in, float across, float& u, float& v) {
        u = u_in;
        v = across;
        const float angle = 0.46f + 0.72f * across;  // below the axis, towards the tail
        const float length = 0.22f * (0.66f + 0.34f * std::sin(kPi * (0.12f + 0.8f * across)));
        const float out = side * (0.058f + length * u * std::sin(splay * (0.7f + 0.4f * u)));
        const float r = length * u * std::cos(splay);
        return spine.point(0.47f + 0.03f * across + r * std::cos(angle),
                           -0.178f - r * std::sin(angle), out);
      },
      Material::Fin, 7);
}

template <class Sheets>
void add_pectoral_fin(const Spine& spine, const FishPose& pose, Sheets& builder, float side) {
  const float phase = beat(pose), hover = static_cast<float>(pose.hover);
  const float swing =
      0.42f + 0.40f * hover + (0.16f + 0.42f * hover) * std::sin(phase + 0.9f * side);
  builder.sheet(
      8, 14,
      [&](float u_in, float across, float& u, float& v) {
        u = u_in;
        v = across;
        const float angle = 0.05f + 0.95f * across;
        const float length = 0.245f * (0.52f + 0.48f * std::sin(kPi * (0.1f + 0.85f * across)));
        const float bow = swing * (0.75f + 0.35f * u) - 0.25f * across * hover;
        const float out = side * (0.105f + length * u * std::sin(bow));
        const float r = length * u * std::cos(bow);
        return spine.point(0.275f + 0.012f * across + r * std::cos(angle),
                           -0.085f - 0.03f * across - r * std::sin(angle), out);
      },
      Material::Fin, 8);
}

template <class Sheets>
void add_fish(const FishPose& pose, Sheets& builder) {
  const Spine spine(pose);
  add_body(spine, builder);
  for (const float side : {-1.0f, 1.0f}) add_eye(spine, builder, side);
  add_tail_fin(spine, pose, builder);
  add_dorsal_fin(spine, pose, builder);
  add_anal_fin(spine, pose, builder);
  for (const float side : {-1.0f, 1.0f}) {
    add_pelvic_fin(spine, pose, builder, side);
    add_pectoral_fin(spine, pose, builder, side);
  }
}

}  // namespace

void outline_fish(const FishPose& pose, std::vector<Vec3>& points) {
  points.clear();
  Outliner outliner(pose, points);
  add_fish(pose, outliner);
}

void build_fish(const FishPose& pose, Mesh& mesh) {
  mesh.vertices.clear();
  mesh.opaque.clear();
  mesh.fins.clear();
  Builder builder(pose, mesh);
  add_fish(pose, builder);
  const auto depth = [&](const Triangle& t) {
    return mesh.vertices[t.corner[0]].z + mesh.vertices[t.corner[1]].z +
           mesh.vertices[t.corner[2]].z;
  };
  std::stable_sort(mesh.fins.begin(), mesh.fins.end(),
                   [&](const Triangle& a, const Triangle& b) { return depth(a) < depth(b); });
}

FishPose between(const FishPose& a, const FishPose& b, double t) {
  if (a.away || b.away) return a;
  FishPose p = a;
  const auto blend = [&](double FishPose::*member) {
    p.*member = a.*member + t * (b.*member - a.*member);
  };
  for (auto member :
       {&FishPose::x, &FishPose::y, &FishPose::yaw, &FishPose::pitch, &FishPose::bend,
        &FishPose::arch, &FishPose::tail_phase, &FishPose::tail_amplitude, &FishPose::hover}) {
    blend(member);
  }
  return p;
}

}  // namespace vsprite::capture
