// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/coded_size.h - the frame size that a packet of coded video declares.
//
// OpenCV 4.6 keeps the first frame's size for ever: later frames of another size come out cropped
// or scaled, with every property as before. The packets themselves tell.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace vsprite::detail {

struct CodedSize {
  int width = 0, height = 0;  ///< px; in H.264 less what is cropped
  friend bool operator==(const CodedSize&, const CodedSize&) = default;
};

/// The size in the first sequence header of the packet: H.264 and H.265 with start codes, MPEG-1
/// and -2, JPEG. Nothing where the packet holds no header; safe on any bytes.
std::optional<CodedSize> find_coded_size(std::span<const std::uint8_t> packet);

}  // namespace vsprite::detail
