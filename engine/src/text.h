// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// text.h - words that a person wrote.
#pragma once

#include <string_view>

namespace vsprite::detail {

inline constexpr std::string_view kBlank = " \t\r";

/// Without blanks before and after.
constexpr std::string_view trim(std::string_view text) noexcept {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

}  // namespace vsprite::detail
