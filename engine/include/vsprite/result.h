// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/result.h - what a function returns that may meet bad data, files or devices.
//
// `Result<T>` holds a value or an `Error`; its member names are those of std::expected. Nothing in
// the engine throws across its boundary. A caller's broken precondition is an assert, never an
// Error.
#pragma once

#include <cassert>
#include <new>
#include <string>
#include <utility>
#include <variant>

namespace vsprite {

/// What went wrong. A closed list: programs may switch on it.
enum class ErrorCode {
  NotFound,            ///< no such file or name
  CannotRead,          ///< the file is there, reading it failed
  CannotCreate,        ///< a file or folder cannot be made
  CannotWrite,         ///< writing, syncing or renaming failed (also a full disk)
  InUse,               ///< another process holds it
  BadFormat,           ///< not the kind of file that was due
  UnsupportedVersion,  ///< the right kind of file, of a version that this build does not read
  CorruptData,         ///< the right kind of file with damaged or contradictory content
  LimitExceeded,       ///< larger than the documented limit
  BadContent,          ///< well-formed, but not usable for the purpose (no subject in a film)
  BadSetting,          ///< a user's setting is out of range or unknown
  DecoderFailed,       ///< the decoder child died or hung
  Unavailable,         ///< a device, driver or program is missing on this machine
  OutOfMemory,
  Interrupted,  ///< stopped by the user; finished work is kept
  Internal,     ///< a defect of ours
};

/// One sentence for a person: names the file and the field, what was found and what was due.
/// No full stop at the end.
struct Error {
  ErrorCode code;
  std::string message;
};

/// A value or an Error.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool has_value() const noexcept { return state_.index() == 0; }
  explicit operator bool() const noexcept { return has_value(); }

  /// Pre: has_value().
  T& value() & noexcept { return *std::get_if<0>(&state_); }
  const T& value() const& noexcept { return *std::get_if<0>(&state_); }
  T&& value() && noexcept { return std::move(*std::get_if<0>(&state_)); }
  T& operator*() & noexcept { return value(); }
  const T& operator*() const& noexcept { return value(); }
  T&& operator*() && noexcept { return std::move(*this).value(); }
  T* operator->() noexcept { return std::get_if<0>(&state_); }
  const T* operator->() const noexcept { return std::get_if<0>(&state_); }

  /// Pre: !has_value().
  Error& error() & noexcept { return *std::get_if<1>(&state_); }
  const Error& error() const& noexcept { return *std::get_if<1>(&state_); }
  Error&& error() && noexcept { return std::move(*std::get_if<1>(&state_)); }

 private:
  std::variant<T, Error> state_;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)), failed_(true) {}

  bool has_value() const noexcept { return !failed_; }
  explicit operator bool() const noexcept { return !failed_; }
  Error& error() & noexcept { return error_; }
  const Error& error() const& noexcept { return error_; }
  Error&& error() && noexcept { return std::move(error_); }

 private:
  Error error_{ErrorCode::Internal, {}};
  bool failed_ = false;
};

}  // namespace vsprite
