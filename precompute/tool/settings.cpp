// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/settings.h"

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <deque>
#include <numeric>

#include "film/plate.h"
#include "tool/export.h"

namespace vsprite {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  std::string out(text, end);
  return out.find_first_of(".e") == std::string::npos ? out + ".0" : out;
}

Error bad(std::string_view name, const std::string& text, const std::string& due) {
  return {ErrorCode::BadSetting, "--" + std::string(name) + " " + text + ": " + due + " is due"};
}

/// The name, default and range of a number stand here once; text for people is made from them.
struct Row {
  std::vector<Option> options;
  std::deque<std::string> texts;  ///< owns what the views show

  std::string_view keep(std::string text) {
    texts.push_back(std::move(text));
    return texts.back();
  }

  Option& text(std::string_view name, std::string_view value, std::string Settings::*field,
               std::string_view help, std::string_view verbs, std::string_view range = {}) {
    const auto set = [name, field, range](Settings& s, const std::string& v) -> Result<void> {
      if (!range.empty()) {
        const std::string list = "|" + std::string(range) + "|";
        if (v.empty() || v.find('|') != std::string::npos ||
            list.find("|" + v + "|") == std::string::npos)
          return bad(name, v, "one of " + std::string(range));
      }
      s.*field = v;
      return {};
    };
    const Settings defaults;
    options.push_back({name, 0, value, help, keep(defaults.*field), range, verbs, true, set,
                       [field](const Settings& s) { return quoted(s.*field); }});
    return options.back();
  }

  template <class Int>
  Option& whole(std::string_view name, std::string_view value, Int Settings::*field, Int low,
                Int high, std::string_view help, std::string_view verbs) {
    const auto set = [name, field, low, high](Settings& s, const std::string& v) -> Result<void> {
      Int parsed{};
      const auto [end, error] = std::from_chars(v.data(), v.data() + v.size(), parsed);
      if (error != std::errc{} || end != v.data() + v.size() || parsed < low || parsed > high)
        return bad(name, v,
                   "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
      s.*field = parsed;
      return {};
    };
    const Settings defaults;
    options.push_back({name, 0, value, help, keep(std::to_string(defaults.*field)),
                       keep(std::to_string(low) + ".." + std::to_string(high)), verbs, true, set,
                       [field](const Settings& s) { return std::to_string(s.*field); }});
    return options.back();
  }

  /// `low` <= value <= `high`, or < `high` where `open`.
  Option& real(std::string_view name, std::string_view value, double Settings::*field, double low,
               double high, bool open, std::string_view help, std::string_view verbs) {
    const auto set = [=](Settings& s, const std::string& v) -> Result<void> {
      double parsed = 0;
      const auto [end, error] = std::from_chars(v.data(), v.data() + v.size(), parsed);
      const bool in = parsed >= low && (open ? parsed < high : parsed <= high);
      if (error != std::errc{} || end != v.data() + v.size() || !std::isfinite(parsed) || !in)
        return bad(name, v,
                   "a number from " + number(low) + (open ? " to below " : " to ") + number(high));
      s.*field = parsed;
      return {};
    };
    const Settings defaults;
    options.push_back({name, 0, value, help, keep(number(defaults.*field)),
                       keep(number(low) + ".." + (open ? "<" : "") + number(high)), verbs, true,
                       set, [field](const Settings& s) { return number(s.*field); }});
    return options.back();
  }

  Option& flag(std::string_view name, bool Settings::*field, std::string_view help,
               std::string_view verbs) {
    const auto set = [name, field](Settings& s, const std::string& v) -> Result<void> {
      if (v != "true" && v != "false") return bad(name, v, "true or false");
      s.*field = v == "true";
      return {};
    };
    options.push_back({name, 0, {}, help, {}, {}, verbs, true, set, [field](const Settings& s) {
                         return std::string(s.*field ? "true" : "false");
                       }});
    return options.back();
  }

  Option& list(std::string_view name, std::string_view value,
               std::vector<std::string> Settings::*field, std::string_view help,
               std::string_view verbs, std::string_view range) {
    Option& option = text(name, value, &Settings::film, help, verbs, range);
    const auto check = option.set;
    option.set = [check, field](Settings& s, const std::string& v) -> Result<void> {
      Settings scratch;
      if (auto checked = check(scratch, v); !checked) return checked;
      (s.*field).push_back(v);
      return {};
    };
    option.get = [](const Settings&) { return std::string("\"\""); };
    option.in_config = false;
    return option;
  }
};

constexpr std::string_view kSegment = " segment build play ";
constexpr std::string_view kKeying = " segment build play doctor ";
constexpr std::string_view kTrain = " train build play ";
constexpr std::string_view kTransitions = " transitions build play ";
constexpr std::string_view kSolve = " solve build play ";

void add_stage_options(Row& t) {
  t.text("key", "KEY", &Settings::key,
         "background: auto, plate (standing camera), alpha (the film's own), none, or #RRGGBB",
         kKeying);
  t.options.back().set = [](Settings& s, const std::string& v) -> Result<void> {
    if (const auto parsed = parse_key(v); !parsed) return parsed.error();
    s.key = v;
    return {};
  };
  t.real(
      "clip-black", "A", &Settings::clip_black, 0, 0.9, false,
      "so much coverage becomes none, and what is above is stretched: takes haze and shadows off",
      kKeying);
  t.real("clip-white", "A", &Settings::clip_white, 0.1, 1, false,
         "so much coverage becomes all: closes holes and thin places", kKeying);
  t.real("edge", "PX", &Settings::edge, -8, 4, false,
         "moves the edge, film px: below 0 inwards, off a rim of screen; above 0 outwards",
         kKeying);
  t.real("despill", "X", &Settings::despill, 0, 2, false,
         "a coloured screen's tint: 0 stays, 1 goes where the subject nearby has none, 2 goes "
         "everywhere",
         kKeying);
  t.flag("shadow", &Settings::shadow,
         "the soft shadow that the subject casts too, as a picture below each sprite", kSegment);
  t.text("matte", "FILE", &Settings::matte,
         "film or pictures beside the film whose brightness is the coverage: nothing is keyed",
         kKeying);
  t.real("fps", "RATE", &Settings::fps, 1, 1000, false,
         "pictures a second where the film is a row of pictures", kKeying);
  t.flag("draft", &Settings::draft,
         "every second frame, pictures of at most 128 px: a first look in a third of the time",
         kSegment);
  t.text("subject", "WHICH", &Settings::subject,
         "only (refuses several), largest, or its number in the picture of a refusal", kSegment);
  t.options.back().set = [](Settings& s, const std::string& v) -> Result<void> {
    int number = 0;
    const auto [end, error] = std::from_chars(v.data(), v.data() + v.size(), number);
    const bool counts =
        error == std::errc{} && end == v.data() + v.size() && number >= 1 && number <= 32;
    if (v != "only" && v != "largest" && !counts)
      return bad("subject", v, "only, largest or a number from 1 to 32");
    s.subject = v;
    return {};
  };
  t.text("anchor", "POINT", &Settings::anchor,
         "what stands on the spot: the body's centre, or the ground below it", kSegment,
         "centroid|ground");
  t.text("horizon", "Y|fit", &Settings::horizon,
         "it walks on a floor whose horizon lies at y, film px (path: of the picture), or is found "
         "by its size near and far: near and far become one size",
         " segment build play path ");
  t.options.back().set = [](Settings& s, const std::string& v) -> Result<void> {
    double y = 0;
    const auto [end, error] = std::from_chars(v.data(), v.data() + v.size(), y);
    const bool counts =
        error == std::errc{} && end == v.data() + v.size() && y >= -100000 && y <= 100000;
    if (!v.empty() && v != "fit" && !counts)
      return bad("horizon", v, "fit or a number from -100000 to 100000");
    s.horizon = v;
    return {};
  };
  t.real("ground-line", "Y", &Settings::ground_line, 0, 100000, false,
         "with --horizon: where its size counts, px; 0 = the feet nearest to the camera",
         " segment build play path ");
  t.real("focal", "PX", &Settings::focal, 0, 1000000, false,
         "with --horizon: focal length of the camera, px; 0 = 0.8 widths of the picture",
         " segment build play path ");
  t.flag("mirror", &Settings::mirror, "mirrored samples too: a film to the right also goes left",
         kSegment);
  t.whole("preview", "N", &Settings::preview, 0, 200,
          "no sprites, but N frames spread over the film on one contact sheet", " segment ");
  t.options.back().in_config = false;
  t.flag("window", &Settings::window,
         "pick the screen's colour and move four sliders over any frame, before the film is cut",
         " segment ")
      .in_config = false;
  t.text("background", "FILE|#RRGGBB", &Settings::background,
         "with --preview, --window: the game's background, a PNG or a colour", " segment ");
  t.options.back().set = [](Settings& s, const std::string& v) -> Result<void> {
    const auto color = v.starts_with("#") ? parse_key(v) : Result<KeyConfig>(KeyConfig{});
    if (!color || v.empty()) return bad("background", v, "a PNG file or #RRGGBB");
    s.background = v;
    return {};
  };
  t.whole("max-size", "PX", &Settings::max_size, 16, 4096,
          "longest side of the largest sprite picture, px", kSegment);
  t.real("smooth", "FRAMES", &Settings::smooth, 0, 8, false,
         "sigma of the Gaussian that smooths positions before velocities, frames", kSegment);
  t.whole("min-clip", "FRAMES", &Settings::min_clip, 2, 1000, "shorter clips are dropped, frames",
          kSegment);
  t.whole("pairs", "N", &Settings::pairs, 50, 1000000, "labelled pairs taken from the film",
          kTrain);
  t.text("features", "SCALE", &Settings::features,
         "how samples differ: as in the paper, or free of scale (film with near and far)", kTrain,
         "raw|per-area");
  t.whole("folds", "N", &Settings::folds, 2, 20, "parts for held-out testing", kTrain);
  t.real("false-accept-cost", "X", &Settings::false_accept_cost, 1, 1000, false,
         "price of a visible jump, in rejected good ones", kTrain);
  t.real("threshold", "X", &Settings::threshold, 0, 10, false,
         "moves the line: 0.8 allows 0.8 of the learned difference; 0 = as saved, at first 1. "
         "`train` shows what it would do, and takes it with --save",
         kTrain);
  t.flag("save", &Settings::save, "with --threshold: take it", " train ").in_config = false;
  t.whole("max-per-sample", "N", &Settings::max_per_sample, 1, 10000,
          "cheapest transitions kept out of a sample", kTransitions);
  t.whole("min-back", "SAMPLES", &Settings::min_back, 1, 1000,
          "shortest jump backwards inside a clip, samples", kTransitions);
  t.text("minima", "WHETHER", &Settings::minima,
         "of a run of near-identical jumps keep the cheapest only", kTransitions, "on|off");
  t.real("near-miss", "D", &Settings::near_miss, 0, 10, false,
         "also take pairs this far beyond the threshold, at three times their price", kTransitions);
  t.text("flip", "HOW", &Settings::flip,
         "with --mirror, how it turns round: as filmed, by a cut to its mirror image, or that only "
         "where the film holds no turn",
         kTransitions, "film|cut|auto");
  t.real("flip-price", "D", &Settings::flip_price, 0, 1, false,
         "difference that such a cut counts as; 1 = the threshold", kTransitions);
  t.text("directions", "N", &Settings::directions,
         "headings to serve; auto = those of the eight that the film holds", kSolve,
         "auto|2|4|8|16|32");
  t.text("solver", "METHOD", &Settings::solver,
         "mode paper: policy iteration, or the paper's own iteration (slow, the same tables)",
         kSolve, "policy|iterate");
  t.real("alpha", "A", &Settings::alpha, 0, 1, true,
         "mode paper: discount of the future, per sample", kSolve);
  t.real("w1", "W", &Settings::w1, 0, 1000, false,
         "mode paper: price of a radian off the command; 0 = from the film", kSolve);
  t.real("cap", "T", &Settings::cap, 0.001, 1000, false,
         "mode paper: dearer transitions are not used; 1 = the classifier's threshold", kSolve);
  t.whole("free-steps", "K", &Settings::free_steps, 0, 10,
          "mode paper: transitions without a motion constraint after a change of direction",
          kSolve);
  t.real("response-alpha", "A", &Settings::response_alpha, 0, 1, true,
         "mode responsive: discount of the future, per sample", kSolve);
  t.real("response-cap", "T", &Settings::response_cap, 0, 1000, false,
         "mode responsive: dearer transitions are not used; 0 = the lowest that still turns",
         kSolve);
  t.real("turn-w1", "W", &Settings::turn_w1, 0, 1000, false,
         "mode responsive: price of a radian off the command while turning", kSolve);
  t.real("cruise-w1", "W", &Settings::cruise_w1, 0, 1000, false,
         "mode responsive: the same once it goes that way", kSolve);
  t.real("exit", "DEG", &Settings::exit_angle, 1, 90, false,
         "mode responsive: a sample so near the command has turned, degrees", kSolve);
  t.real("action-tau", "T", &Settings::action_tau, 0.001, 100, false,
         "casts: price of a tick on the way to a tag, in transition costs", " pack build play ");
  t.real(
      "budget", "MB", &Settings::budget, 0, 8000, false,
      "largest pack: frames are left out in the order in which control loses least; 0 = all stay",
      " pack build play ");
  t.text("pictures", "FORM", &Settings::pictures,
         "of the pack: exact, or gpu: lossy, half the bytes, drawn by a graphics card as they lie",
         " pack build play ", "exact|gpu");
  t.real("change-rate", "RATE", &Settings::change_rate, 0, 10, false,
         "mode responsive: changes of command to expect, a second; 0 = expect none", kSolve);
  t.real("speed-weight", "RAD", &Settings::speed_weight, 0, 100, false,
         "mode responsive: price of slowness, in radians off the command", kSolve);
  t.text("play-through", "WHETHER", &Settings::play_through,
         "mode responsive: the next sample may be left out (double rate)", kSolve, "on|off");
  t.real("skip-price", "X", &Settings::skip_price, 0, 100, false,
         "mode responsive: price of that, in transition costs of its own", kSolve);
  t.real("bend", "DEG", &Settings::bend, 0, 45, false,
         "mode responsive: the path may differ so much from the picture's heading, degrees",
         kSolve);
}

void add_label_options(Row& t) {
  t.whole("pairs", "N", &Settings::questions, 1, 1000000, "questions of one sitting", " label ")
      .in_config = false;
  t.text("answers", "FILE", &Settings::answers,
         "no window: take the answers of a CSV file, `i,j,acceptable` or as --export writes it",
         " label ")
      .in_config = false;
  t.text("export", "FILE", &Settings::export_file, "no window: write all answers as CSV", " label ")
      .in_config = false;
  t.text("bind", "KEYS", &Settings::bind,
         "other keys in the window, e.g. \"accept=a flip=s undo=u\"; F1 there lists them",
         " label ");
}

void add_use_options(Row& t) {
  t.text(
      "keys", "SCRIPT", &Settings::keys,
      "held directions and actions by seconds: \"0.0 right; 2.5 play jump 4\", or a file of them",
      " steer play ");
  t.whole("frames", "N", &Settings::frames, 0, 1000000000,
          "ticks to run; 0 = 12 s (steer), for ever (play and windows)",
          " steer play label path points segment ");
  t.text("mode", "MODE", &Settings::mode,
         "which solved tables; default: the pack's own (steer), paper (dump)",
         " steer dump play report ", "paper|responsive");
  t.text("trace", "FILE", &Settings::trace, "one line a tick, as CSV", " steer path ");
  t.flag("bench", &Settings::bench,
         "all modes over a grid of settings, ten random runs each; -o FILE.svg draws the curves",
         " steer ");
  t.text(
      "fade", "LENGTH", &Settings::fade,
      "ticks over which a jump is cross-faded; auto: only those dearer than the threshold, by cost",
      " play ", "auto|off|2|3|4|5|6");
  t.flag("headless", &Settings::headless, "no window: play the keys and end",
         " play label path points segment ");
  t.text(
      "record", "FILE", &Settings::record,
      "film of the run (.mp4) or last picture (.png); steer: the run itself, for --replay (.vsr)",
      " play label steer path points segment ");
  t.text("replay", "FILE", &Settings::replay,
         "makes a recorded run again; exit 3 at the first tick that comes out otherwise",
         " steer ");
  t.text("what", "WHAT", &Settings::what, "which numbers", " dump ",
         "samples|labels|features|distances|transitions|values");
  t.text("format", "FORMAT", &Settings::format, "how they are written", " dump ", "csv|npy");
  t.text("pairs", "FILE", &Settings::pair_file,
         "with --what features: a file of pairs to compare, `i,j` a line", " dump ")
      .in_config = false;
}

void add_export_options(Row& t) {
  t.text("to", "FORMAT", &Settings::to,
         "a web page; a folder of atlas pages and tables; sheets or moving pictures of what each "
         "direction plays",
         " export loops ", t.keep(export_names()))
      .in_config = false;
  t.whole("samples", "N", &Settings::samples, 0, 1000000,
          "all but html: at most so many, chosen so that control loses least; 0 = all", " export ")
      .in_config = false;
  t.text("order", "ORDER", &Settings::order,
         "sheets and moving pictures: the loop that each direction plays, or clips as filmed",
         " export ", "directions|film");
  t.text("godot", "VERSION", &Settings::godot, "godot-tres: of which Godot", " export loops ",
         "4|3");
  t.text("length", "TICKS", &Settings::length,
         "how long a loop is: N, or LEAST..MOST, of which the smoothest is taken", " loops ");
  t.text("direction", "DIRECTION", &Settings::only_direction, "of this direction alone", " loops ",
         "right|right+down|down|left+down|left|left+up|up|right+up|rest")
      .in_config = false;
  t.text("tag", "NAME", &Settings::only_tag, "of this tag alone", " loops ").in_config = false;
  t.text("template", "FILE", &Settings::page,
         "html: the page that takes the pack; default: player.html of the installation",
         " export ");
  t.real("budget", "MB", &Settings::page_limit, 0.01, 1000, false,
         "html: largest page; samples are left out in the order in which control loses least",
         " export ")
      .in_config = false;
}

void add_points_options(Row& t) {
  t.flag("window", &Settings::window,
         "place and drag the points over the views, and see the character move under sliders",
         " points ")
      .in_config = false;
  t.text("script", "FILE", &Settings::script,
         "edits, one a line: move VIEW POINT X Y; add VIEW X Y; erase POINT; mesh; automatic; "
         "cut FACE; flip A B; undo; redo",
         " points ")
      .in_config = false;
  t.text("import", "FILE", &Settings::import_file,
         "an SVG: the nodes of its paths, in order, become the points of --view", " points ")
      .in_config = false;
  t.whole("view", "N", &Settings::view, 1, 100000,
          "which view, from 1; characters come after the views", " points ")
      .in_config = false;
}

void add_path_options(Row& t) {
  t.text("script", "FILE", &Settings::script,
         "a path: one point `x y` a line, output px; or a scene (.toml)", " path ");
  t.flag("window", &Settings::window,
         "draw the path in a window, over the backdrop, and see the sprite follow; saves it to "
         "--script (path.txt)",
         " path ")
      .in_config = false;
  t.text("backdrop", "FILE", &Settings::backdrop,
         "picture (.png) behind the sprite, or a film that is shown over and over", " path ");
  t.text(
      "size", "WxH", &Settings::size,
      "of the film, px; default: the backdrop's, else the path's box and a body length around it",
      " path ");
  t.options.back().set = [](Settings& s, const std::string& v) -> Result<void> {
    if (!v.empty())
      if (const auto parsed = parse_size(v); !parsed) return parsed.error();
    s.size = v;
    return {};
  };
  t.whole("beam", "N", &Settings::beam, 1, 10000000, "sequences kept a tick", " path ");
  t.real("w1", "W", &Settings::path_w1, 0, 1000, false,
         "price of a radian off the path's direction, a tick", " path ")
      .in_config = false;
  t.real("w2", "W", &Settings::w2, 0, 1000000, false,
         "price of a body length off the path, squared, a tick", " path ");
  t.real("tau", "W", &Settings::tau, 0, 1000, false,
         "price of a tick: looks ahead to the end; 0 = the paper's form", " path ");
  t.real("seconds", "S", &Settings::seconds, 0.01, 1000000, false,
         "scene: seconds of search; Ctrl-C ends it early and keeps the best so far", " path ");
  t.whole<std::uint64_t>("proposals", "N", &Settings::proposals, 0, UINT64_MAX,
                         "scene: stop after so many instead: the same N and seed give the same "
                         "result; 0 = by --seconds",
                         " path ");
  t.text("search", "HOW", &Settings::search,
         "scene: replace looks ahead; beam (of --beam) does not: for comparison, one sprite",
         " path ", "replace|beam");
  t.text("plane", "PLANE", &Settings::plane,
         "pack with a floor: the path's points lie on the screen or on the ground; none = flat",
         " path ", "screen|ground|none");
  t.text("clip", "NAME", &Settings::clip,
         "with -o OTHER.vsp: what the run is called in the pack; default: the script's name",
         " path ");
  t.text("resume", "FILE.json", &Settings::resume,
         "scene: start from the places that an earlier run wrote", " path ");
}

void add_common_options(Row& t) {
  t.text("output", "FILE", &Settings::output, "the file to write (most exports: the folder)",
         " segment build fit pack export loops dump play steer path report ")
      .letter = 'o';
  t.text("work", "DIR", &Settings::work,
         "work folder; default: the pack's path with .work for .vsp",
         " segment label train transitions solve fit pack build play dump doctor report ");
  t.list("force", "STAGE", &Settings::force, "run this stage again, whatever stands there",
         " segment train transitions solve pack build play ",
         "segment|train|transitions|solve|pack|all");
  t.whole("jobs", "N", &Settings::jobs, 0, 1024,
          "threads, 0 = all; the result does not depend on it", "*");
  t.whole<std::uint64_t>("seed", "N", &Settings::seed, 0, UINT64_MAX,
                         "seed of everything drawn at random", "*");
  t.text("config", "FILE", &Settings::config, "TOML file in which every option can stand", "*")
      .in_config = false;
  t.list("set", "KEY=VALUE", &Settings::set, "one option, as in the config file", "*", {});
  t.flag("dump-config", &Settings::dump_config, "print the settings as TOML and end", "*")
      .in_config = false;
  t.flag("json", &Settings::json, "stdout is one JSON document", "*");
  t.flag("quiet", &Settings::quiet, "errors only", "*");
  t.flag("verbose", &Settings::verbose, "more about each step", "*");
  t.text("progress", "MODE", &Settings::progress, "how progress is shown", "*",
         "auto|bar|lines|json|none");
}

Row make_table() {
  Row t;
  add_stage_options(t);
  add_label_options(t);
  add_use_options(t);
  add_export_options(t);
  add_points_options(t);
  add_path_options(t);
  add_common_options(t);
  return t;
}

std::string unknown_key(std::string_view key) {
  std::vector<std::string> names;
  for (const Option& option : all_options()) names.emplace_back(option.name);
  const std::string near = nearest_name(key, names);
  return "no setting is called `" + std::string(key) + "`" +
         (near.empty() ? std::string(": vsprite build --dump-config lists them")
                       : ": did you mean `" + near + "`");
}

/// A TOML scalar as the text that the command line would carry.
std::string scalar_text(const toml::node& node) {
  if (const auto* s = node.as_string()) return s->get();
  if (const auto* i = node.as_integer()) return std::to_string(i->get());
  if (const auto* b = node.as_boolean()) return b->get() ? "true" : "false";
  if (const auto* f = node.as_floating_point()) return number(f->get());
  return {};
}

}  // namespace

std::span<const Option> all_options() {
  static const Row table = make_table();
  return table.options;
}

bool takes(const Option& option, std::string_view verb) {
  return option.verbs == "*" ||
         option.verbs.find(" " + std::string(verb) + " ") != std::string_view::npos;
}

const Option* find_option(std::string_view name) {
  for (const Option& option : all_options())
    if (option.name == name) return &option;
  return nullptr;
}

FilmSource source_of(const Settings& settings, const std::string& film) {
  FilmSource source(film);
  source.matte = settings.matte;
  source.fps = settings.fps;
  return source;
}

Result<MatteConfig> matte_of(const Settings& settings) {
  if (settings.clip_black >= settings.clip_white)
    return bad("clip-black", number(settings.clip_black),
               "less than the " + number(settings.clip_white) + " of --clip-white");
  MatteConfig config;
  config.clip_black = static_cast<float>(settings.clip_black);
  config.clip_white = static_cast<float>(settings.clip_white);
  config.edge = static_cast<float>(settings.edge);
  config.despill = static_cast<float>(settings.despill);
  config.shadow = settings.shadow;
  return config;
}

FloorChoice floor_of(const Settings& settings) {
  FloorChoice choice;
  choice.fitted = settings.horizon == "fit";
  double y = 0;
  const std::string& text = settings.horizon;
  if (!text.empty() && !choice.fitted &&
      std::from_chars(text.data(), text.data() + text.size(), y).ec == std::errc{})
    choice.horizon = y;
  choice.line = settings.ground_line;
  choice.focal = settings.focal;
  return choice;
}

Result<std::array<int, 2>> parse_size(const std::string& text) {
  std::array<int, 2> size{};
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, size[0]);
  const bool has_x = first.ec == std::errc{} && first.ptr != end && *first.ptr == 'x';
  const auto last = std::from_chars(has_x ? first.ptr + 1 : end, end, size[1]);
  const auto fits = [](int side) { return side >= 2 && side <= 16384; };
  if (!has_x || last.ec != std::errc{} || last.ptr != end || !fits(size[0]) || !fits(size[1]))
    return bad("size", text, "WxH, two whole numbers from 2 to 16384,");
  return size;
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_edits = name.size() / 3 + 2;  // beyond that it is no slip of the finger
  for (const std::string& candidate : candidates) {
    std::vector<std::size_t> row(candidate.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= name.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= candidate.size(); ++j) {
        const std::size_t replaced = diagonal + (name[i - 1] != candidate[j - 1] ? 1 : 0);
        diagonal = row[j];
        row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
      }
    }
    if (row.back() < best_edits) {
      best_edits = row.back();
      best = candidate;
    }
  }
  return best;
}

namespace {

std::string shell_quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of(
                                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                          "0123456789_-./+:,@%") == std::string::npos;
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

std::string shell_word(const std::string& path) {
  return shell_quoted(path.starts_with('-') ? "./" + path : path);
}

std::string options_text(const Settings& settings, std::string_view verb) {
  const Settings defaults;
  std::string out;
  for (const Option& option : all_options()) {
    if (option.verbs == "*" || !takes(option, verb) || !option.in_config) continue;
    std::string value = option.get(settings);
    if (value == option.get(defaults)) continue;
    out += " --" + std::string(option.name);
    if (option.value.empty()) continue;
    if (value.starts_with('"')) {
      std::string plain;
      for (std::size_t i = 1; i + 1 < value.size(); ++i) plain += value[value[i] == '\\' ? ++i : i];
      value = std::move(plain);
    }
    out += " " + shell_quoted(value);
  }
  return out;
}

Result<void> apply_config(Settings& settings, const std::string& text, const std::string& path) {
  const auto place = [&path](const toml::source_position& at) {
    return path + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) + ": ";
  };
  const toml::parse_result parsed = toml::parse(text);
  if (!parsed)
    return Error{ErrorCode::BadContent, place(parsed.error().source().begin) + "not TOML: " +
                                            std::string(parsed.error().description())};
  for (const auto& [key, node] : parsed.table()) {
    const std::string where = place(key.source().begin);
    const Option* option = find_option(key.str());
    if (option == nullptr || !option->in_config)
      return Error{ErrorCode::BadContent, where + unknown_key(key.str())};
    if (!node.is_value())
      return Error{ErrorCode::BadContent, where + std::string(key.str()) +
                                              ": a single value is due, not a table or array"};
    if (const auto set = option->set(settings, scalar_text(node)); !set)
      return Error{ErrorCode::BadContent, where + set.error().message};
  }
  return {};
}

Result<void> apply_assignment(Settings& settings, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos)
    return Error{ErrorCode::BadSetting, "--set " + assignment + ": KEY=VALUE is due"};
  const std::string key = assignment.substr(0, equals);
  const Option* option = find_option(key);
  if (option == nullptr || !option->in_config)
    return Error{ErrorCode::BadSetting, "--set " + assignment + ": " + unknown_key(key)};
  return option->set(settings, assignment.substr(equals + 1));
}

std::string dump_config(const Settings& settings) {
  std::string out = "# vsprite settings; every option of the command line can stand here\n";
  for (const Option& option : all_options()) {
    if (!option.in_config) continue;
    out += "\n# " + std::string(option.help);
    if (!option.range.empty()) out += " (" + std::string(option.range) + ")";
    const std::string value = option.get(settings);
    out += "\n" + std::string(value == "\"\"" ? "# " : "") + std::string(option.name) + " = " +
           value + "\n";
  }
  return out;
}

}  // namespace vsprite
