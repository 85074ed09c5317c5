// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/cast_file.h - a cast: many short clips that together are one character.
//
//     match = true              # one scale and mean colour for all; true where left out
//
//     [[clip]]                  # the first clip is what the others are matched to
//     file = "idle.mp4"         # a film; relative to this file
//     tag = "idle"              # the action; a cast never loses a tag
//
//     [[clip]]
//     file = "walk.mp4"
//     frames = [12, 107]        # first and last film frame, from 0; all where left out
//     tag = "walk"
//     key = "#20c040"           # its own background, as --key says it
//     mirror = true             # also the other way round
//     velocity = [140, 0]       # of a subject that walks in place: px/s of its film, right, down
//     body = [-18, -60, 18, 0]  # its tag's box to collide with (vsprite/body.h): left, top, right,
//                               # bottom, px of the pack's pictures from the anchor
//     events = [{ frame = 31, name = "step" }]   # what a game hears of (vsprite/events.h)
//     match = false             # this one as it was filmed
#pragma once

#include <array>
#include <climits>
#include <optional>
#include <string>
#include <vector>

#include "vsprite/result.h"

namespace vsprite {

/// What happens at a film frame of a clip.
struct CastEvent {
  int frame = 0;
  std::string name;
  std::string at;  ///< where it stands: `path:line:column`
};

struct CastClip {
  std::string file;                               ///< as the cast names it
  std::string path;                               ///< that the file is read from
  int first = 0;                                  ///< film frame
  int last = INT_MAX;                             ///< film frame, >= first
  std::string tag;                                ///< empty: none
  std::string key;                                ///< empty: the setting
  std::string subject;                            ///< empty: the setting
  std::string matte;                              ///< read from there; empty: the clip is keyed
  double fps = 0;                                 ///< of a picture sequence; 0: the setting
  std::optional<bool> mirror;                     ///< empty: the setting
  std::optional<std::array<double, 2>> velocity;  ///< px/s of its film; empty: as it moved
  std::optional<std::array<double, 4>> body;      ///< of its tag; empty: as measured
  bool match = true;
  std::vector<CastEvent> events;
};

/// True where `path` ends in `.toml`.
bool is_cast_file(const std::string& path);
/// True where `path` is a cast: such a file, or a folder of films and of folders of pictures.
bool is_cast(const std::string& path);

/// At least one clip. `path` names the text in messages, and its folder is where files are looked
/// for. Errors: BadContent as `path:line:column: ...`; NotFound (a file that is not there).
Result<std::vector<CastClip>> parse_cast(const std::string& text, const std::string& path);
/// The same from the file. Of a folder: its clips in natural order, untagged and unmatched, since
/// they are of one shoot. Errors: also NotFound, CannotRead.
Result<std::vector<CastClip>> read_cast(const std::string& path);

}  // namespace vsprite
