// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/settings.h - every option of the tool: one table for the command line, the config file,
// help.
//
// An option has one name everywhere: `--max-size 128`, `--set max-size=128`, `max-size = 128` in a
// TOML file. The command line wins over --set, --set over the file, the file over the default.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "film/floor.h"
#include "film/matte.h"
#include "film/source.h"
#include "vsprite/result.h"

namespace vsprite {

struct Settings {
  // Where.
  std::string film;    ///< the verb's operand: film, pack or work folder
  std::string output;  ///< -o
  std::string work;    ///< --work
  std::string config;  ///< --config

  // Making a sprite.
  std::string key = "auto";
  double clip_black = 0;
  double clip_white = 1;
  double edge = 0;  ///< px
  double despill = 1;
  bool shadow = false;
  std::string matte;  ///< a film or pictures whose brightness is the coverage; empty: none
  double fps = 30;    ///< of pictures
  int max_size = 256;
  bool draft = false;
  std::string subject = "only";
  std::string anchor = "centroid";
  std::string horizon;     ///< empty: no floor
  double ground_line = 0;  ///< 0: the nearest feet
  double focal = 0;        ///< 0: 0.8 widths
  bool mirror = false;
  double smooth = 1.2;
  int min_clip = 8;
  int pairs = 3000;
  int folds = 5;
  double false_accept_cost = 10;
  double threshold = 0;  ///< the designer's move of the line; 0: as saved
  bool save = false;
  int max_per_sample = 100;
  int min_back = 15;
  std::string features = "raw";
  std::string minima = "off";
  double near_miss = 0;
  std::string flip = "auto";
  double flip_price = 0.4;
  double alpha = 0.97;
  double w1 = 0.6;
  double cap = 0.8;
  int free_steps = 5;
  std::string solver = "policy";
  std::string directions = "auto";
  double response_alpha = 0.985;
  double response_cap = 0;  ///< 0: by reachability
  double cruise_w1 = 0.2;
  double turn_w1 = 0.8;
  double change_rate = 0.35;  ///< a second
  double speed_weight = 0.3;
  std::string play_through = "off";
  double skip_price = 1;
  double bend = 15;
  double exit_angle = 25;
  double action_tau = 0.05;  ///< price of a tick on the way to a tag
  double budget = 0;         ///< MB of the pack; 0: all samples
  std::string pictures = "exact";

  // Looking before building.
  int preview = 0;  ///< frames on the contact sheet; 0: none is asked for
  std::string background = "#9cc4d8";

  // Playing it.
  std::string keys;
  int frames = 0;    ///< 0: the verb's own default
  std::string mode;  ///< empty: the verb's own default
  std::string trace;
  bool bench = false;
  std::string record;
  std::string replay;
  bool headless = false;
  std::string fade = "auto";

  // Labelling.
  int questions = 500;
  std::string answers;
  std::string export_file;
  std::string bind;

  // Scripting it.
  std::string script;
  std::string backdrop;
  std::string size;
  int beam = 50000;
  double path_w1 = 0.2;
  double w2 = 8;
  double tau = 0.1;
  double seconds = 10;
  std::string to;                    ///< export: what it becomes
  std::string page;                  ///< export: the template; empty: the installation's
  double page_limit = 10;            ///< MB
  int samples = 256;                 ///< export: at most; 0: all
  std::string order = "directions";  ///< export: what is played where nothing is steered
  std::string godot = "4";
  std::string length = "20..40";     ///< loops: ticks
  std::string only_tag;              ///< loops: empty: all
  std::string only_direction;        ///< loops: empty: all
  std::uint64_t proposals = 0;       ///< 0: as many as the seconds allow
  std::string resume;
  std::string clip;
  std::string plane = "screen";
  std::string search = "replace";
  bool window = false;
  std::string import_file;  ///< points: an SVG
  int view = 1;             ///< points: from 1, characters after the views

  // Looking into it.
  std::string what;
  std::string format = "csv";
  std::string pair_file;

  // How.
  int jobs = 0;
  std::uint64_t seed = 1;
  std::vector<std::string> force;
  std::vector<std::string> set;
  std::string progress = "auto";
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool dump_config = false;
};

/// One row of the table.
struct Option {
  std::string_view name;      ///< without dashes
  char letter;                ///< short form, or 0
  std::string_view value;     ///< placeholder with the unit, e.g. "PX"; empty: a switch
  std::string_view help;      ///< half a sentence
  std::string_view fallback;  ///< the default, as text; empty: none
  std::string_view range;     ///< "16..4096", "a|b|c", or empty
  std::string_view verbs;     ///< " segment build "; "*" = every verb
  bool in_config;             ///< may stand in a config file
  std::function<Result<void>(Settings&, const std::string&)> set;  ///< BadSetting
  std::function<std::string(const Settings&)> get;                 ///< as TOML
};

/// The table, in the order of the help screens.
std::span<const Option> all_options();
bool takes(const Option& option, std::string_view verb);
const Option* find_option(std::string_view name);

/// "1280x720" as {width, height}, 2..16384 each. Errors: BadSetting.
Result<std::array<int, 2>> parse_size(const std::string& text);

/// `film` with what the settings say about it.
FilmSource source_of(const Settings& settings, const std::string& film);

/// How the settings change what is keyed. Errors: BadSetting (clip-black is not below clip-white).
Result<MatteConfig> matte_of(const Settings& settings);

/// What the settings know of the floor.
FloorChoice floor_of(const Settings& settings);

/// The candidate with the fewest edits, or empty if none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// The options of `verb` that differ from their defaults as words of a command line,
/// ` --key '#2060c0' --edge -1.0`; of those that may stand in a config file and are not of every
/// verb.
std::string options_text(const Settings& settings, std::string_view verb);

/// A path as a shell and the command line take it back: quoted where due, never an option.
std::string shell_word(const std::string& path);

/// Applies `key = value` of a TOML text. Errors: BadContent, naming file, line and column.
Result<void> apply_config(Settings& settings, const std::string& text, const std::string& path);
/// Applies one `key=value`. Errors: BadSetting.
Result<void> apply_assignment(Settings& settings, const std::string& assignment);
/// Every option that may stand in a config file, as TOML with comments.
std::string dump_config(const Settings& settings);

}  // namespace vsprite
