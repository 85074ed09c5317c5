// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/scene_script.h - a scene as people write it, in seconds and pixels, and what came of it.
//
//     seconds = 8                  how long
//     size = [640, 480]            of the picture; default: the backdrop's, else around all places
//     for = "goldfish"             name of the pack it was written for; another one is refused
//
//     [[sprite]]                   one or more; drawn from the highest to the lowest in the picture
//     name = "fish"
//     pack = "goldfish.vsp"        beside the script; default: the pack of the command line
//     start = [320, 240]
//
//     [[sprite.term]]              any number; their weighted sum is what is searched for
//     kind = "location"            location, path, heading, speed, pose, region, clear or meet
//     at = [320, 240]              what each kind takes: README, "Scripted motion"
//     weight = 1
//     from = 0                     seconds; default: from the beginning ...
//     to = 4                       ... to the end
#pragma once

#include <string>
#include <vector>

#include "control/replace.h"
#include "tool/path_script.h"

namespace vsprite {

struct SceneScript {
  struct Term {
    SceneTerm term;  ///< `from`, `to` and `other` are not set yet
    std::string kind, with;
    double from = 0, to = 1e9;  ///< seconds
  };
  struct Part {
    std::string name, pack;
    Vec2 start;
    std::vector<Term> terms;
  };
  double seconds = 0;
  int width = 0, height = 0;  ///< 0: not said
  std::string made_for;       ///< empty: any pack
  std::vector<Part> parts;
};

/// Errors: BadContent, naming file, line, what was found and what is due.
Result<SceneScript> parse_scene(const std::string& text, const std::string& name);

/// `sprites`: one a part, all of one frame rate. Errors: BadContent, naming `name`.
Result<Scene> make_scene(const SceneScript& script, const std::vector<const Sprite*>& sprites,
                         const std::string& name);

/// Every place that the script names, for the picture around it.
std::vector<Vec2> places_of(const SceneScript& script);

/// What is short of being met: a term's largest value and its second. Lines for people.
std::string scene_text(const SceneScript& script, const Scene& scene, const SceneResult& result);
Json scene_json(const SceneScript& script, const Scene& scene, const SceneResult& result);
/// Where every sprite is, for other programs and for --resume.
Json scene_places(const SceneScript& script, const Scene& scene, const SceneResult& result,
                  const PathPicture& picture);
/// The samples of each sprite in a file of scene_places. Errors: BadContent, naming file and field.
Result<std::vector<std::vector<std::uint32_t>>> read_places(const std::string& text,
                                                            const Scene& scene,
                                                            const std::string& name);
/// frame,sprite,sample,x,y,cost
std::string scene_csv(const SceneResult& result);

}  // namespace vsprite
