// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "window/label_keys.h"

#include <SDL_keyboard.h>

#include <algorithm>

namespace vsprite::window {
namespace {

constexpr std::array<LabelActionInfo, kLabelActionCount> kActions = {{
    {"accept", "Space", "the guess is right"},
    {"flip", "F", "the guess is wrong"},
    {"undo", "U", "take the last answer back"},
    {"redo", "R", "give it again"},
    {"skip", "S", "another pair instead"},
    {"slower", "-", "play slower"},
    {"faster", "=", "play faster"},
    {"background", "B", "another background"},
    {"help", "F1", "these keys"},
    {"quit", "Escape", "end; every answer is saved"},
}};

Error bad(const std::string& word, const std::string& due) {
  return {ErrorCode::BadSetting, "--bind " + word + ": " + due};
}

std::string action_names() {
  std::string out;
  for (const LabelActionInfo& action : kActions)
    out += (out.empty() ? "" : ", ") + std::string(action.name);
  return out;
}

}  // namespace

const LabelActionInfo& info_of(LabelAction action) noexcept {
  return kActions[static_cast<std::size_t>(action)];
}

Result<LabelKeys> LabelKeys::parse(const std::string& text) {
  LabelKeys keys;
  for (std::size_t k = 0; k < kActions.size(); ++k)
    keys.codes_[k] = SDL_GetKeyFromName(std::string(kActions[k].key).c_str());
  constexpr const char* kBetween = " ,;\t\n";
  for (std::size_t at = text.find_first_not_of(kBetween); at != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
    const std::string word = text.substr(at, end - at);
    at = text.find_first_not_of(kBetween, end);
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals);
    const auto action = std::find_if(kActions.begin(), kActions.end(),
                                     [&](const LabelActionInfo& a) { return a.name == name; });
    if (equals == std::string::npos || action == kActions.end())
      return bad(word, "ACTION=KEY is due, ACTION one of " + action_names());
    const std::string key = word.substr(equals + 1);
    const SDL_Keycode code = SDL_GetKeyFromName(key.c_str());
    if (code == SDLK_UNKNOWN)
      return bad(word,
                 "no key is called `" + key +
                     "`: a letter, a digit, Space, Return, Left, F5 or another name of SDL's");
    keys.codes_[static_cast<std::size_t>(action - kActions.begin())] = code;
  }
  for (std::size_t a = 0; a < kActions.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (keys.codes_[a] == keys.codes_[b])
        return bad(text, std::string(SDL_GetKeyName(keys.codes_[a])) + " would both " +
                             std::string(kActions[b].name) + " and " +
                             std::string(kActions[a].name) + ": one key for each is due");
  return keys;
}

std::optional<LabelAction> LabelKeys::action_of(int key_code) const noexcept {
  const auto found = std::find(codes_.begin(), codes_.end(), key_code);
  if (found == codes_.end()) return std::nullopt;
  return static_cast<LabelAction>(found - codes_.begin());
}

std::string LabelKeys::key_name(LabelAction action) const {
  return SDL_GetKeyName(codes_[static_cast<std::size_t>(action)]);
}

}  // namespace vsprite::window
