// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// synthesis/puppet_fit.h - from drawn or photographed views to puppets (vsprite/puppet.h).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "synthesis/rbf_fit.h"
#include "vsprite/puppet.h"

namespace vsprite {

/// One example: parameters, and where the control points lie.
struct View {
  std::string name;                    ///< of its file, or "view 3": what messages call it
  Image picture{};                     ///< straight alpha; 0 x 0: an example of shape alone
  std::vector<double> at{};            ///< (D)
  std::vector<Vec2> points{};          ///< (P) of the pose, px
  std::vector<Vec2> texture_points{};  ///< (P) of the picture, where it shows the parts apart;
                                       ///< empty: `points`
  std::vector<float> depth{};          ///< (P) or empty: those of the set
};

/// A rigid part of a limb, given by its joints [Darrell 1998, "Image Analysis"].
struct LinkMark {
  std::string name;
  int first = 0, count = 0;  ///< its control points
  int parent = -1;           ///< an earlier link
  int pivot = 0, end = 0;    ///< control points: where it turns, and where it points to
};

/// Another character, moved by parallel deformation from one picture.
struct Character {
  std::string name;
  View view{};            ///< `at` is not used
  int like = 0;           ///< the prototype's view in the same pose
  bool modulate = false;  ///< the movement grows with the ratio of their sizes
};

/// Views that one smooth map joins, of more that none does (rbf.h, ExampleSet).
struct SetMark {
  std::string name;
  std::vector<int> views{};  ///< two or more
  std::vector<int> joins{};  ///< the sets that may be entered from this one
};

struct ViewSet {
  std::string name;
  std::vector<PuppetParameter> parameters{};  ///< (D); with links: one a link, found by itself
  std::vector<View> views{};
  std::vector<Face>
      faces{};  ///< empty: Delaunay of the first picture's points, for each link apart
  std::vector<float> depth{};  ///< (P) or empty: 0
  std::vector<LinkMark> links{};
  std::vector<Character> characters{};
  std::optional<RbfConfig> rbf{};      ///< absent: choose_config
  std::optional<HyperConfig> hyper{};  ///< HyperBF, its `rbf` not used; absent: a centre a view
  std::vector<SetMark> sets{};         ///< none: one network for all views; else two or more
  bool blends = true;
  bool allow_folds = false;
};

/// Thin-plate of degree 1 where the views (of every set) allow it, else linear of degree 0; each
/// parameter scaled to [0, 1].
RbfConfig choose_config(const ViewSet& set);

/// The faces of the set, or those that are made where it has none: Delaunay triangles of the first
/// picture's points, for each link apart, that show something in a picture. Without a picture or
/// three points: none.
std::vector<Face> make_mesh(const ViewSet& set);

/// The examples that the network learns: see Puppet for the outputs. Pre: the set was checked.
Examples puppet_examples(const ViewSet& set);

/// What makes a set unfit: views of different sizes, missing, coincident or collinear control
/// points, equal parameters, a single view, parameters outside their range, folded faces, numbers
/// that are none. Errors: BadContent, naming view and point, counted from 1.
Result<void> check_views(const ViewSet& set);

/// Root mean square, px, of what the fitted prototype misses its views' control points by (the
/// mean of both coordinates); 0 up to rounding where every view has its centre and there is no
/// ridge. Pre: `puppet` was fitted to this set.
double fit_error(const ViewSet& set, const Puppet& puppet);

/// The prototype, then its characters. Errors: those of check_views and fit_rbf.
Result<std::vector<Puppet>> fit_puppets(const ViewSet& set);

}  // namespace vsprite
