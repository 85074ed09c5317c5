// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// commands/path_parts.h - what following a path and playing a scene share.
#pragma once

#include "control/path_cost.h"
#include "tool/commands/verbs.h"
#include "tool/path_film.h"
#include "vsprite/clip.h"

namespace vsprite {

/// While alive, an interrupt is noted instead of ending the process; a second one ends it.
class InterruptNote {
 public:
  InterruptNote();
  ~InterruptNote();
  InterruptNote(const InterruptNote&) = delete;
  InterruptNote& operator=(const InterruptNote&) = delete;
  static bool is_set() noexcept;
};

/// The picture that is drawn: the backdrop's, else --size, else around `points`.
struct Stage {
  PathPicture picture;
  Backdrop backdrop;
  bool is_given = false;  ///< its size was asked for
};
/// Errors: those of read_backdrop; BadSetting.
Result<Stage> make_stage(const Settings& settings, const std::vector<Vec2>& points,
                         float body_length);

/// The floor on which the pack's film was taken; none with --plane none. Errors: those of
/// load_ground.
Result<std::optional<Ground>> floor_of_pack(const Settings& settings);
/// The floor of the picture: that of --horizon, else the pack's. Errors: BadSetting.
Result<std::optional<Ground>> floor_of_picture(const Settings& settings,
                                               const std::optional<Ground>& own,
                                               const Stage& stage);
/// Each point by to_ground or to_screen.
std::vector<Vec2> mapped(std::vector<Vec2> points, const Ground& floor,
                         Vec2 (*map)(const Ground&, Vec2) noexcept);

/// The film or pictures of `settings.output`, where it asks for one.
Result<void> write_film(const Settings& settings, const std::vector<FilmRole>& roles,
                        const Stage& stage, Console& console);

/// Copies the pack of the command line to `settings.output`, with `clips` beside or in place of
/// those it has. Errors: those of load_clips and save_clips.
Result<void> write_pack_clips(const Settings& settings, const Sprite& sprite,
                              std::vector<PackClip> clips);
/// A found run as the pack holds it.
PackClip to_pack_clip(const Sprite& sprite, const Clip& clip, std::string name);

/// The weights of equation 1 that the settings ask for.
PathWeights weights_of(const Settings& settings, const Sprite& sprite);

/// The verb `path` with --window: a path is drawn.
Result<int> draw_path(const Settings& settings, Console& console);
/// The verb `path` where its script is a scene.
Result<int> run_scene(const Settings& settings, const std::string& text, Console& console);

}  // namespace vsprite
