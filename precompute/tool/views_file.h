// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/views_file.h - VIEWS.toml: the views of a character, its parameters and control points.
//
//     name = "face"
//     texture = "blend"                  # views mixed, or "choose": the best one alone
//     kernel = "thin-plate"              # all may be left out: linear, gaussian, thin-plate,
//     degree = 1                         # multiquadric; "none", 0 or 1
//     width = 1.0                        # of gaussian and multiquadric, where a parameter's range
//     ridge = 0.0                        # is 1; above 0 for noisy examples
//     centers = 4                        # HyperBF: so many centres for all views, which then are
//     training = "gradient"              # met only nearly; they and the norm are trained, "random"
//     steps = 400                        # is a search that keeps some worse tries (Metropolis) by
//     temperature = 0.01                 # its temperature, a share of the error
//     seed = 1
//     depth = [0, 0, 1]                  # of each point, larger is nearer; a view may have its own
//     triangles = [[1, 2, 3]]            # points are counted from 1; without triangles and quads
//     quads = [[1, 2, 3, 4]]             # the mesh is made
//
//     [[parameter]]
//     name = "rotation"
//     low = 0
//     high = 60
//     period = 0                         # above 0: cyclic
//
//     [[view]]
//     file = "face_1.png"                # PNG with alpha, beside this file; may be left out
//     at = [0, 0]                        # one number a parameter
//     points = [[12.5, 40.0], [30, 41]]  # px
//     texture_points = [[12, 40]]        # where the picture shows its parts apart
//
//     [[link]]                           # a limb: its angles are the parameters
//     name = "upper"
//     first = 1                          # its points
//     last = 20
//     pivot = 1                          # points: where it turns, where it points to
//     end = 10
//     parent = "body"                    # an earlier link
//
//     [[set]]                            # where no smooth map joins all views, two sets or more:
//     name = "arm up"                    # one answers until the parameters leave its hull, then
//     views = [1, 2, 3]                  # one that it joins; views may share their parameters
//     joins = ["arm down"]               # with those of another set; left out: all that have a
//                                        # view in common with it
//
//     [[character]]                      # moved by parallel deformation
//     name = "jayne"
//     file = "jayne.png"
//     points = [[10, 12]]
//     like = 1                           # the view in the same pose
//     modulate = false                   # true: the movement grows with the ratio of their sizes
#pragma once

#include <string>

#include "synthesis/puppet_fit.h"

namespace vsprite {

/// The text of a file of views. Errors: those of read_file; BadContent (a picture or another
/// binary file).
Result<std::string> read_views_text(const std::string& path);

/// `text` was read from `path`; pictures are read from beside it.
/// Errors: BadContent (file, line, key, what is due), those of read_png, those of check_views.
Result<ViewSet> parse_views(const std::string& text, const std::string& path);

/// The same for an editor: points may be missing, and no view is checked.
Result<ViewSet> parse_draft_views(const std::string& text, const std::string& path);

/// A pack of puppets and nothing else: its samples are the first one's views, one after the other.
/// Pre: at least one puppet. Errors: those of save_pack and encode_puppets.
Result<void> save_puppet_pack(const std::string& path, const std::vector<Puppet>& puppets);

/// What `fit --work` leaves in a work folder. Errors: those of encode_puppets and write_file.
Result<void> write_puppets(const std::string& work, const std::vector<Puppet>& puppets);

/// The sections PUPT and PSET from there, checked; each may be empty.
struct PuppetSections {
  std::vector<std::uint8_t> puppets, sets;
};
/// Errors: CorruptData, those of read_file.
Result<PuppetSections> puppet_sections(const std::string& work);

}  // namespace vsprite
