// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// emscripten_std.h - what C++20 has and the standard library of Debian 12's Emscripten has not.
// Included before every file of a web build by its compiler options, and nowhere else.
#pragma once

#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <memory>
#include <string>
#include <type_traits>
#include <version>

namespace std {

#ifndef __cpp_lib_bit_cast
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}
#endif

#ifndef __cpp_lib_smart_ptr_for_overwrite
/// Arrays alone.
template <class Array>
unique_ptr<Array> make_unique_for_overwrite(size_t count) {
  return unique_ptr<Array>(new remove_extent_t<Array>[count]);
}
#endif

#ifndef __cpp_lib_to_chars
/// Decimal numbers.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  if (first == last || !((*first >= '0' && *first <= '9') || *first == '.' || *first == '-')) {
    return {first, errc::invalid_argument};
  }
  string text(first, last);
  text.resize(min(text.find_first_not_of("0123456789.eE+-"), text.size()));  // no 0x, no inf
  char* end = nullptr;
  errno = 0;
  const double read = strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  const char* after = first + (end - text.c_str());
  if (errno == ERANGE) return {after, errc::result_out_of_range};
  value = read;
  return {after, errc()};
}
#endif

}  // namespace std
