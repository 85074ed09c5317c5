// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The one file that sees CLI11: it splits the words, the settings table says what they mean.
#include <CLI/CLI.hpp>
#include <deque>
#include <filesystem>

#include "tool/commands/verbs.h"

namespace vsprite {
namespace {

/// What stood on the command line for one option.
struct Given {
  const Option* option;
  std::vector<std::string> values;
  bool flag = false;
};

Error unknown_word(const Verb& verb, const std::string& word) {
  if (word.size() < 2 || word[0] != '-')
    return {ErrorCode::BadSetting, "`" + word + "` is one operand too many: `vsprite " +
                                       std::string(verb.name) + " " + std::string(verb.operand) +
                                       "` is due"};
  std::error_code ignored;
  if (std::filesystem::exists(word, ignored))
    return {ErrorCode::BadSetting,
            "no option is called `" + word + "`: the file is " + shell_word(word)};
  const std::string name = word.substr(0, word.find('='));
  std::vector<std::string> names;
  for (const Option& option : all_options())
    if (takes(option, verb.name)) names.push_back("--" + std::string(option.name));
  const std::string near = nearest_name(name, names);
  return {ErrorCode::BadSetting,
          "no option is called `" + name + "`: " +
              (near.empty() ? "`vsprite help " + std::string(verb.name) + "` lists them"
                            : "did you mean `" + near + "`?")};
}

/// "--max-size: a value is missing; due: --max-size PX, 16..4096, such as --max-size 256".
std::string value_missing(const Option& option) {
  const std::string name = "--" + std::string(option.name);
  std::string text = name + ": a value is missing; due: " + name + " " + std::string(option.value);
  if (!option.range.empty()) text += ", " + std::string(option.range);
  if (!option.fallback.empty()) text += ", such as " + name + " " + std::string(option.fallback);
  return text;
}

void add_options(CLI::App& app, const Verb& verb, std::deque<Given>& given) {
  for (const Option& option : all_options()) {
    if (!takes(option, verb.name)) continue;
    Given& entry = given.emplace_back(Given{&option, {}, false});
    std::string names = "--" + std::string(option.name);
    if (option.letter != 0) names = std::string("-") + option.letter + "," + names;
    if (option.value.empty())
      app.add_flag(names, entry.flag);
    else
      app.add_option(names, entry.values)->expected(1)->allow_extra_args(false)->take_all();
  }
}

Result<void> apply_given(const std::deque<Given>& given, Settings& settings) {
  for (const Given& entry : given) {
    if (entry.flag)
      if (auto set = entry.option->set(settings, "true"); !set) return set;
    for (const std::string& value : entry.values)
      if (auto set = entry.option->set(settings, value); !set) return set;
  }
  return {};
}

}  // namespace

Result<Settings> parse_arguments(const Verb& verb, int count, char** arguments, bool& asks_help) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  std::deque<Given> given;
  std::string operand;
  app.add_flag("-h,--help", asks_help);
  app.add_option("operand", operand);
  add_options(app, verb, given);
  try {
    std::vector<std::string> words(arguments, arguments + count);
    std::reverse(words.begin(), words.end());
    app.parse(std::move(words));
  } catch (const CLI::ArgumentMismatch& fault) {
    const std::string what = fault.what();  // "--name: ..."
    for (const Given& entry : given)
      if (what.starts_with("--" + std::string(entry.option->name) + ":"))
        return Error{ErrorCode::BadSetting, value_missing(*entry.option)};
    return Error{ErrorCode::BadSetting, what};
  } catch (const CLI::ParseError& fault) {
    return Error{ErrorCode::BadSetting, std::string(fault.what())};
  }
  if (asks_help) return Settings{};
  for (const std::string& word : app.remaining())
    if (word != "--") return unknown_word(verb, word);  // what follows `--` is no option

  // The file gives way to --set, and both to the options themselves.
  Settings first;
  if (auto applied = apply_given(given, first); !applied) return applied.error();
  Settings settings;
  if (!first.config.empty()) {
    const auto text = read_file(first.config);
    if (!text) return text.error();
    if (auto applied = apply_config(settings, *text, first.config); !applied)
      return applied.error();
  }
  for (const std::string& assignment : first.set)
    if (auto applied = apply_assignment(settings, assignment); !applied) return applied.error();
  if (auto applied = apply_given(given, settings); !applied) return applied.error();
  settings.film = operand;
  return settings;
}

}  // namespace vsprite
