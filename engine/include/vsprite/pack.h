// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// vsprite/pack.h - the one file that a game loads (.vsp), both directions side by side.
//
// Little-endian; a header, a table of sections with 64-bit offsets and XXH3-64 sums, then the
// sections; specified in engine/PACK.md. Every pack from 1.0 on is read by this build and by all
// later ones; sections that a build does not know are skipped. A newer major version is refused
// with UnsupportedVersion.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vsprite/result.h"
#include "vsprite/sprite.h"

namespace vsprite {

inline constexpr std::uint16_t kPackMajor = 1;
inline constexpr std::uint16_t kPackMinor = 1;  ///< 1: GPU-ready pictures; packs without stay 1.0

/// Reads header and tables and checks every count before memory is taken, every index, order and
/// range. Pictures stay in the file, which remains open, and are checked when decoded. The file is
/// read, not mapped: whoever cuts a mapped file short kills the process that touches the lost page
/// (SIGBUS), while a read just fails, and costs pictures. Cost: O(tables), about 1 ms a MB; tables of
/// 4 MB and more are read and checked by two threads, if there are two, which have ended when it
/// returns.
/// Errors: NotFound, CannotRead, BadFormat, UnsupportedVersion, CorruptData, LimitExceeded,
/// OutOfMemory.
Result<Sprite> load_pack(const std::string& path);

/// A pack that lies elsewhere: in memory, in an archive, behind a network.
struct PackReader {
  std::uint64_t bytes = 0;  ///< of the whole pack
  std::string name;         ///< for messages
  /// Fills `out` with the bytes from `offset` on, all of which lie inside `bytes`; false where that
  /// is not possible. Called by the thread that opens the pack, later by any that decodes a picture,
  /// by several at once; must not throw.
  std::function<bool(std::uint64_t offset, std::span<std::uint8_t> out)> read;
};
/// The same from there; the sprite keeps the reader. Errors: those of load_pack.
Result<Sprite> load_pack(PackReader reader);

/// Hands out the straight-alpha picture of a kept sample; called once each, in ascending order.
using FrameSource = std::function<Result<Image>(std::uint32_t sample)>;

/// How a pack holds its pictures.
enum class PictureForm : std::uint8_t {
  Exact,  ///< lossless, a fifth to a quarter of the RGBA bytes
  Blocks  ///< lossy, an eighth: BC3 blocks that a GPU samples as they are (BlockView)
};

/// A section that is read apart from the sprite: a floor (encode_ground), puppets (encode_puppets),
/// or one of a game's own.
struct PackExtra {
  std::string name;  ///< four capital letters, of no section that save_pack writes by itself
  std::vector<std::uint8_t> bytes;
};

/// Writes a pack: `path` appears complete and synced, or not at all. The same data give the same
/// bytes. One picture is in memory at a time. `extras` follow the pictures as they are; those
/// without bytes are left out. Exact pictures make a pack of version 1.0. Temporaries that killed
/// writers of the same path left behind are removed. Errors: CannotCreate, CannotWrite, CorruptData
/// (`data` contradicts itself), OutOfMemory, and whatever `frames` returns.
Result<void> save_pack(const std::string& path, const SpriteData& data, const FrameSource& frames,
                       std::span<const PackExtra> extras = {},
                       PictureForm form = PictureForm::Exact);
/// The bytes of the first section of that name; empty: there is none. Errors: those of load_pack
/// that concern header and section.
Result<std::vector<std::uint8_t>> load_extra(const std::string& path, std::string_view name);

/// One finding of verify_pack.
struct PackIssue {
  std::string code;          ///< stable name: "bad-magic", "section-sum", "frame-sum", ...
  std::string severity;      ///< "error" or "warning"
  std::string section;       ///< four letters, or empty for the header
  std::uint64_t offset = 0;  ///< bytes from the start of the file
  std::string message;
};

/// Checks every byte, pictures included. An empty list means valid. Safe on any bytes. Stops at the
/// first wrong table, after all wrong sums, or after 1,000 findings.
/// Errors (as opposed to issues): NotFound, CannotRead, OutOfMemory.
Result<std::vector<PackIssue>> verify_pack(const std::string& path);
Result<std::vector<PackIssue>> verify_pack(PackReader reader);

/// What a file holds, for people.
struct PackSection {
  std::string name;
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};
/// How far the pictures are from those that were written, as peak signal-to-noise ratios over all
/// pixels that are not clear, dB; infinite where nothing was lost.
struct PackLoss {
  double colour = 0;  ///< premultiplied red, green and blue
  double alpha = 0;
};
struct PackInfo {
  std::uint16_t major = 0, minor = 0;
  std::uint64_t bytes = 0;
  std::vector<PackSection> sections;
  std::optional<PackLoss> loss;  ///< of a pack of PictureForm::Blocks
};
/// Errors as load_pack.
Result<PackInfo> read_pack_info(const std::string& path);

}  // namespace vsprite
