// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/commands/verbs.h"
#include "vsprite/vsprite.h"

namespace vsprite {
namespace {

constexpr Verb kVerbs[] = {
    {"segment", "FILM|CAST.toml", "film -> mattes, sprites, velocities",
     "vsprite segment hamster.mp4 --key '#2060c0' --max-size 128", run_segment},
    {"label", "FILM|PACK|--work DIR", "say which jumps look right, in a window or from a file",
     "vsprite label --work hamster.work --pairs 200", run_label},
    {"train", "FILM|PACK|--work DIR", "labelled pairs of sprites -> classifier",
     "vsprite train --work hamster.work --threshold 0.8", run_train},
    {"transitions", "FILM|PACK|--work DIR", "classifier -> which frame may follow which",
     "vsprite transitions --work hamster.work --max-per-sample 50", run_transitions},
    {"solve", "FILM|PACK|--work DIR", "transitions -> cost tables of both modes",
     "vsprite solve --work hamster.work --turn-w1 1.5 --directions 16", run_solve},
    {"points", "VIEWS.toml",
     "place the control points of views, in a window, from an SVG or by a script",
     "vsprite points face.toml --window", run_points},
    {"fit", "VIEWS.toml", "views and control points -> puppets, in a pack or a work folder",
     "vsprite fit face.toml -o face.vsp", run_fit},
    {"pack", "FILM|PACK|--work DIR", "all of it -> one file",
     "vsprite pack --work hamster.work -o hamster.vsp", run_pack},
    {"build", "FILM|CAST.toml",
     "segment, train, transitions, solve, pack; what stands is not done again",
     "vsprite build hamster.mp4 -o hamster.vsp", run_build},
#ifdef VSPRITE_WINDOW
    {"play", "PACK|FILM|CAST.toml", "a window in which the character answers keys, pad and mouse",
     "vsprite play hamster.vsp", run_play},
#endif
    {"steer", "PACK", "drive it without a window, and measure how it answers",
     "vsprite steer hamster.vsp --keys \"0 right; 2.5 right+up; 4 none\" --frames 300", run_steer},
    {"path", "PACK --script FILE", "follow a drawn path, and film it",
     "vsprite path hamster.vsp --script maze.txt -o maze.mp4", run_path},
    {"info", "PACK", "what a pack contains", "vsprite info hamster.vsp --json", run_info},
    {"report", "PACK|--work DIR", "one page about a character, and what to film next",
     "vsprite report hamster.vsp -o hamster.html", run_report},
    {"validate", "PACK", "check a pack, byte by byte", "vsprite validate hamster.vsp",
     run_validate},
    {"loops", "PACK", "the smoothest loop of every direction and tag, for engines that only play",
     "vsprite loops hamster.vsp --length 24 --direction right --to gif -o hamster-right",
     run_loops},
    {"export", "PACK --to FORMAT",
     "a character for other places: a web page, tables, sprite sheets, moving pictures",
     "vsprite export hamster.vsp --to table --samples 600 -o hamster", run_export},
    {"dump", "FILM|PACK|--work DIR", "the numbers behind a sprite, as npy or csv",
     "vsprite dump --work hamster.work --what transitions --format npy -o t.npy", run_dump},
    {"doctor", "[FILM|PACK|--work DIR]",
     "what a film is worth before it is built; what is missing here, or broken in a work folder",
     "vsprite doctor hamster.mp4", run_doctor},
};

std::string padded(std::string text, std::size_t width) {
  if (text.size() < width) text.resize(width, ' ');
  return text;
}

std::string option_line(const Option& option) {
  std::string name =
      option.letter != 0 ? std::string("-") + option.letter + ", " : std::string("    ");
  name += "--" + std::string(option.name);
  if (!option.value.empty()) name += " " + std::string(option.value);
  std::string line =
      "  " + padded(name, 28) + (name.size() >= 28 ? "  " : "") + std::string(option.help);
  std::string extra;
  if (!option.range.empty()) extra += std::string(option.range);
  if (!option.fallback.empty())
    extra += (extra.empty() ? "default " : "; default ") + std::string(option.fallback);
  if (!extra.empty()) line += "\n" + std::string(30, ' ') + "(" + extra + ")";
  return line + "\n";
}

}  // namespace

std::span<const Verb> all_verbs() { return kVerbs; }

const Verb* find_verb(std::string_view name) {
  for (const Verb& verb : kVerbs)
    if (verb.name == name) return &verb;
  return nullptr;
}

std::string overview_screen() {
  std::string screen =
      "vsprite " VSPRITE_VERSION
      " - turns bluescreen video into a playable sprite\n"
      "\n"
      "usage: vsprite build FILM -o PACK          everything, with settings measured from the "
      "film\n"
      "       vsprite build CAST.toml -o PACK     many short clips as one character\n"
      "       vsprite <command> [options]         one step; the work folder is --work DIR "
      "(FILM.work)\n"
      "\n"
      "in this order:\n"
      "  segment      film -> mattes, sprites, velocities           --key auto  --preview N  "
      "--draft\n"
      "  label        say which jumps look right (optional)         --pairs N (500)  --answers "
      "FILE\n"
      "  train        labels -> classifier                          --threshold X  --folds N (5)\n"
      "  transitions  classifier -> which frame may follow which    --max-per-sample N (100)\n"
      "  solve        transitions -> cost tables, both modes        --turn-w1 W (0.8)  "
      "--free-steps "
      "K (5)\n"
      "  pack         all of it -> one file                         -o FILE.vsp\n"
      "\n"
      "at any time:\n";
#ifdef VSPRITE_WINDOW
  screen += "  play    steer it in a window    ";
#else
  screen += "  ";
#endif
  screen +=
      "steer     drive it without a window\n"
      "  info    what a pack contains    validate  check a pack, byte by byte\n"
      "  dump    the numbers, as npy/csv doctor    what is wrong here\n"
      "  path    follow a drawn path     report    what to film next, as a page\n"
      "  export  for web, other engines  points    place control points over drawn views\n"
      "  fit     drawn views -> puppets  loops     the smoothest loop of a length\n"
      "\n"
      "common:  --jobs N  --seed N  --config FILE.toml  --json  --quiet  --progress MODE  "
      "--version  "
      "help <command>\n";
  return screen;
}

std::string help_screen(const Verb& verb) {
  const std::string name(verb.name);
  std::string screen = "vsprite " + name + " - " + std::string(verb.summary) +
                       "\n\nusage: vsprite " + name + " " + std::string(verb.operand) +
                       " [options]\n\noptions:\n";
  for (const Option& option : all_options())
    if (option.verbs != "*" && takes(option, verb.name)) screen += option_line(option);
  screen += "\ncommon:\n";
  for (const Option& option : all_options())
    if (option.verbs == "*") screen += option_line(option);
  return screen + "\nexample:\n  " + std::string(verb.example) + "\n";
}

Error unknown_verb(const std::string& word) {
  std::vector<std::string> names{"help"};
  for (const Verb& verb : kVerbs) names.emplace_back(verb.name);
  const std::string near = nearest_name(word, names);
  return {ErrorCode::BadSetting, "no command is called `" + word + "`: " +
                                     (near.empty() ? std::string("`vsprite` alone lists them")
                                                   : "did you mean `" + near + "`?")};
}

}  // namespace vsprite
