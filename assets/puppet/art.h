// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// art.h - the drawings of games/puppet, and the truth between them: every pose can be drawn at any
// parameter, so that what a network makes of five of them can be measured.
#pragma once

#include "synthesis/puppet_fit.h"

namespace vsprite::puppet_art {

/// A face, 320 x 360 px: rotation 0..36 degrees to the right, expression 0 (astonishment) to 1
/// (anger).
View draw_face(double rotation, double expression);
/// Five drawings [memo, Fig. 3].
ViewSet face_views();

/// John walking at a phase of 0..1: cosine and sine of it are the parameters. The picture shows his
/// parts apart.
View draw_walk(double phase);
/// Five of 14 frames [Fig. 6], and Jayne from one picture [Fig. 7].
ViewSet walk_views();

/// John jumping, from a crouch (0) over the air to his feet (1) [Fig. 2].
View draw_jump(double time);
ViewSet jump_views();

/// An arm of two links: shoulder and elbow in radians, clockwise; muscles swell with the elbow.
View draw_arm(double shoulder, double elbow);
ViewSet arm_views();

}  // namespace vsprite::puppet_art
