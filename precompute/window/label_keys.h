// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// label_keys.h - which key does what in the label window, and how to change it: "accept=a flip=s".
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "vsprite/result.h"

namespace vsprite::window {

enum class LabelAction { Accept, Flip, Undo, Redo, Skip, Slower, Faster, Background, Help, Quit };
inline constexpr int kLabelActionCount = 10;

struct LabelActionInfo {
  std::string_view name;  ///< as in --bind
  std::string_view key;   ///< SDL's name of the usual key
  std::string_view help;  ///< half a sentence
};
const LabelActionInfo& info_of(LabelAction action) noexcept;

/// One key an action, none twice.
class LabelKeys {
 public:
  /// `text`: ACTION=KEY, separated by spaces, commas or semicolons; the others keep their keys. A
  /// key is a letter, a digit, or one of SDL's names without spaces: Space, Return, Left, F5.
  /// Errors: BadSetting.
  static Result<LabelKeys> parse(const std::string& text);
  std::optional<LabelAction> action_of(int key_code) const noexcept;  ///< SDL_Keycode
  std::string key_name(LabelAction action) const;

 private:
  std::array<int, kLabelActionCount> codes_{};
};

}  // namespace vsprite::window
