// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The C interface over the public C++ headers: arguments are checked here, then the engine is
// called. In this file errors and the library itself; one file for each group of calls beside it.
#include <cstdarg>
#include <cstdio>

#include "c_api_text.h"
#include "c_parts.h"

namespace vsprite::c {
namespace {

// The only state outside of handles.
thread_local char last_error[512] = "";

vsprite_status code_of(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::NotFound:
      return VSPRITE_NOT_FOUND;
    case ErrorCode::CannotRead:
      return VSPRITE_CANNOT_READ;
    case ErrorCode::CannotCreate:
      return VSPRITE_CANNOT_CREATE;
    case ErrorCode::CannotWrite:
      return VSPRITE_CANNOT_WRITE;
    case ErrorCode::InUse:
      return VSPRITE_IN_USE;
    case ErrorCode::BadFormat:
      return VSPRITE_BAD_FORMAT;
    case ErrorCode::UnsupportedVersion:
      return VSPRITE_UNSUPPORTED_VERSION;
    case ErrorCode::CorruptData:
      return VSPRITE_CORRUPT_DATA;
    case ErrorCode::LimitExceeded:
      return VSPRITE_LIMIT_EXCEEDED;
    case ErrorCode::BadContent:
      return VSPRITE_BAD_CONTENT;
    case ErrorCode::BadSetting:
      return VSPRITE_BAD_SETTING;
    case ErrorCode::DecoderFailed:
      return VSPRITE_DECODER_FAILED;
    case ErrorCode::Unavailable:
      return VSPRITE_UNAVAILABLE;
    case ErrorCode::OutOfMemory:
      return VSPRITE_OUT_OF_MEMORY;
    case ErrorCode::Interrupted:
      return VSPRITE_INTERRUPTED;
    case ErrorCode::Internal:
      return VSPRITE_INTERNAL;
  }
  return VSPRITE_INTERNAL;
}

}  // namespace

vsprite_status say(vsprite_status code, const char* format, ...) noexcept {
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(last_error, sizeof last_error, format, values);
  va_end(values);
  return code;
}

vsprite_status fail(const Error& error) noexcept {
  return say(code_of(error.code), "%s", error.message.c_str());
}

vsprite_status bad(const char* call, const char* what) noexcept {
  return say(VSPRITE_BAD_ARGUMENT, "%s: %s", call, what);
}

vsprite_status bad_index(const char* call, const char* what, std::uint64_t index,
                         std::uint64_t count) noexcept {
  return say(VSPRITE_BAD_ARGUMENT, "%s: %s %llu of %llu", call, what,
             static_cast<unsigned long long>(index), static_cast<unsigned long long>(count));
}

}  // namespace vsprite::c

using namespace vsprite;
using namespace vsprite::c;

std::uint32_t vsprite_version(void) {
  return VSPRITE_VERSION_MAJOR << 16 | VSPRITE_VERSION_MINOR << 8 | VSPRITE_VERSION_PATCH;
}

const char* vsprite_last_error(void) { return last_error; }

const char* vsprite_status_name(vsprite_status status) {
  static constexpr const char* kNames[] = {
      "OK",          "NOT_FOUND",   "CANNOT_READ",         "CANNOT_CREATE", "CANNOT_WRITE",
      "IN_USE",      "BAD_FORMAT",  "UNSUPPORTED_VERSION", "CORRUPT_DATA",  "LIMIT_EXCEEDED",
      "BAD_CONTENT", "BAD_SETTING", "DECODER_FAILED",      "UNAVAILABLE",   "OUT_OF_MEMORY",
      "INTERRUPTED", "INTERNAL",    "BAD_ARGUMENT"};
  return status >= 0 && status <= VSPRITE_BAD_ARGUMENT ? kNames[status] : "?";
}

const char* vsprite_cdef(void) { return detail::kDeclarations; }
