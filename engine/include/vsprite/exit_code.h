// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/exit_code.h - for programs: what to return to the caller for an Error.
#pragma once

#include "vsprite/result.h"

namespace vsprite {

/// The words of sysexits.h where it has one.
inline int exit_code(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::BadSetting:
      return 2;
    case ErrorCode::BadFormat:
    case ErrorCode::UnsupportedVersion:
    case ErrorCode::CorruptData:
    case ErrorCode::LimitExceeded:
    case ErrorCode::BadContent:
      return 3;
    case ErrorCode::NotFound:
    case ErrorCode::CannotRead:
      return 66;
    case ErrorCode::Internal:
      return 70;
    case ErrorCode::OutOfMemory:
      return 71;
    case ErrorCode::CannotCreate:
      return 73;
    case ErrorCode::CannotWrite:
      return 74;
    case ErrorCode::InUse:
      return 75;
    case ErrorCode::Interrupted:
      return 130;
    case ErrorCode::DecoderFailed:
    case ErrorCode::Unavailable:
      return 1;
  }
  return 70;
}

}  // namespace vsprite
