// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/puppet.h - a character made of a few views: parameters in, a picture out.
//
// A network (rbf.h), fitted by `vsprite fit`, predicts where the control points of a drawing lie
// for parameters that nobody drew (pose, expression, phase of a walk). Between the points lies a
// mesh, textured from characteristic views: triangles by the affine map, quads by the bilinear one,
// always backwards from the canvas, so that there are no holes and no cracks [Poggio & Brunelli
// 1992, sections 2.1-2.2]. The barycentre's own motion is kept apart from the motion about it. A
// puppet made by parallel deformation moves another character by the same network [eq. 5]:
//
//     O'_B(t) = R'_B + m [O_B(t) - R_B]          m = 1, or the ratio of their sizes
//
// Links (arms, legs) are predicted in their own frames, then turned and put where their joints are
// [Darrell 1998]: a limb turns without shrinking, and the network does only what is left.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vsprite/geometry.h"
#include "vsprite/image.h"
#include "vsprite/rbf.h"
#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct PuppetParameter {
  std::string name;  ///< 1..255 bytes
  double low = 0;    ///< what the examples span
  double high = 1;
  double period = 0;  ///< > 0: cyclic
};

/// A triangle or a quad: indices of control points, in order round it.
struct Face {
  std::array<std::uint32_t, 4> corners{};
  std::uint32_t count = 3;  ///< 3 or 4
  friend bool operator==(const Face&, const Face&) = default;
};

/// A view that is drawn from.
struct PuppetView {
  Image picture;             ///< premultiplied
  std::vector<Vec2> points;  ///< (P) where its control points lie in the picture, px
  std::vector<float> light;  ///< linear premultiplied RGBA, made by make_puppet
};

inline constexpr std::size_t kMostSets = 64;

/// A rigid part: points [first, first + count), turned about its pivot.
struct PuppetLink {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::int32_t parent = -1;     ///< an earlier link, or -1: the body
  std::uint32_t parameter = 0;  ///< its angle from its parent, radians clockwise
};

/// Everything a puppet is. Plain data, immutable once made; any number of threads may read it.
/// The network's outputs: 2 P coordinates, x then y, about the barycentre (of a link: about its
/// pivot, in its own direction); 2 of the barycentre; P depths, larger is nearer; V shares of the
/// views; 2 for each link, its pivot in its parent's frame.
struct Puppet {
  std::string name;
  std::vector<PuppetParameter> parameters;  ///< (D)
  std::vector<Face> faces;                  ///< at equal depth later ones lie on top
  RbfNetwork net;                           ///< where there are sets: the first one's
  std::vector<ExampleSet> sets;   ///< none, or 2..kMostSets whose networks answer in turn (rbf.h)
  RbfNetwork view_map;            ///< from 2 P coordinates to V scores; of one view: not used
  std::vector<PuppetView> views;  ///< (V), at least one
  bool blends = true;             ///< views are mixed by their shares; else the best alone
  std::vector<PuppetLink> links;  ///< none, or all points in order
  std::vector<Vec2> offset;       ///< (P) R'_B - m R_B; empty: the prototype itself
  double motion = 1;              ///< m

  std::size_t point_count() const noexcept { return views.empty() ? 0 : views[0].points.size(); }
};

/// Checks that all parts fit together. Errors: CorruptData, naming the part.
Result<Puppet> make_puppet(Puppet parts);

/// A configuration. Kept by the caller and reused, so that posing never allocates.
struct PuppetPose {
  std::vector<Vec2> points;     ///< (P) about `center`, px
  std::vector<float> depth;     ///< (P)
  std::vector<float> shares;    ///< (V) of the views, sum 1
  Vec2 center;                  ///< the barycentre's own place
  double outside = 0;           ///< how far the parameters lay outside the examples' hull
  int set = -1;                 ///< of the puppet's sets the one that answered, kept while it can
  std::vector<double> scratch;  ///< the network's outputs
  std::vector<double> shape;    ///< (2 P), the view map's inputs
};
PuppetPose make_pose(const Puppet& puppet);

/// The pose for these parameters (D), clamped to the hull of the examples. Cost: a `predict`.
/// Where there are sets, the pose before in `pose` says which may answer (choose_set).
/// Pre: `pose` came from make_pose of this puppet, or of one with the same network.
void pose_puppet(const Puppet& puppet, std::span<const double> parameters,
                 PuppetPose& pose) noexcept;

/// Working memory of render_puppet, reused.
struct PuppetPainter {
  std::vector<float> light, depth;
  std::vector<std::uint32_t> order;
  std::vector<float> keys;
};

/// Draws a pose into `canvas` (premultiplied; what was there stays behind it), the barycentre at
/// `center`, `scale` canvas px a puppet px. Depth decides pixel by pixel where parts overlap.
void render_puppet(const Puppet& puppet, const PuppetPose& pose, PuppetPainter& painter,
                   Image& canvas, Vec2 center, float scale = 1);

/// Angles (radians, clockwise from +x) with which a chain of two links of these lengths, fixed at
/// `shoulder`, reaches for `target`; beyond reach it points there [Darrell 1998, Appendix A].
/// Of two solutions the one nearer to `bend` > 0 (elbow angle positive) or < 0.
struct ArmReach {
  double shoulder = 0;  ///< of the upper link
  double elbow = 0;     ///< of the lower link, from the upper one
};
ArmReach reach_for(Vec2 shoulder, Vec2 target, double upper, double lower, int bend) noexcept;

/// The bytes of a section PUPT, and back; safe on any bytes. Errors: CorruptData, OutOfMemory.
Result<std::vector<std::uint8_t>> encode_puppets(std::span<const Puppet> puppets);
Result<std::vector<Puppet>> decode_puppets(std::span<const std::uint8_t> bytes,
                                           const std::string& name);

/// The bytes of a section PSET, the example sets of these puppets (no bytes: none has any), and
/// back, into puppets that were decoded from the section PUPT beside it. Errors: as above.
Result<std::vector<std::uint8_t>> encode_puppet_sets(std::span<const Puppet> puppets);
Result<void> decode_puppet_sets(std::span<const std::uint8_t> bytes, const std::string& name,
                                std::span<Puppet> puppets);

/// The puppets of the pack at `path`, in the order of the file; none is no error.
/// Errors: those of load_pack; CorruptData.
Result<std::vector<Puppet>> load_puppets(const std::string& path);
/// Writes the pack at `from` with these puppets, in place of those it has, to `to` (which may be
/// `from`): everything else stays byte for byte. Errors: as save_clips.
Result<void> save_puppets(const std::string& from, const std::string& to,
                          std::span<const Puppet> puppets);

}  // namespace vsprite
