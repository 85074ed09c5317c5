// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// file.h - reading files at any offset, and writing them so that they appear whole or not at all.
//
// Files are read with pread, never mapped: when another program cuts a mapped file short, touching
// the lost page kills the process (SIGBUS); a read just comes back short.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "vsprite/pack.h"
#include "vsprite/result.h"

namespace vsprite::detail {

/// A regular file, bytes in memory that the caller keeps alive, or a caller's reader. Reading is
/// thread-safe.
class ByteSource {
 public:
  /// Errors: NotFound, CannotRead (also: not a regular file).
  static Result<ByteSource> open(const std::string& path);
  static ByteSource borrow(std::span<const std::uint8_t> bytes, std::string name);
  static ByteSource call(PackReader reader);
  ByteSource() = default;
  ByteSource(ByteSource&& other) noexcept;
  ByteSource& operator=(ByteSource&& other) noexcept;
  ~ByteSource();

  std::uint64_t size() const noexcept { return size_; }
  const std::string& name() const noexcept { return name_; }
  /// False for a caller's reader: it is called by the thread that opens the pack, and later by
  /// those that decode.
  bool is_shared() const noexcept { return !read_; }
  /// Errors: CannotRead (also when the file has become shorter). Pre: the range lies inside size().
  Result<void> read(std::uint64_t offset, std::span<std::uint8_t> out) const;

 private:
  int file_ = -1;
  std::span<const std::uint8_t> memory_;
  std::function<bool(std::uint64_t, std::span<std::uint8_t>)> read_;  // empty: one of the two above
  std::uint64_t size_ = 0;
  std::string name_;
};

/// The whole file. Errors: NotFound, CannotRead, LimitExceeded (more than `limit` bytes),
/// OutOfMemory.
Result<std::vector<std::uint8_t>> read_file(const std::string& path, std::uint64_t limit);

/// Writes beside `path` and renames at the end. Dropped without finish(), it leaves nothing behind.
class FileWriter {
 public:
  /// Errors: CannotCreate.
  static Result<FileWriter> create(const std::string& path);
  FileWriter(FileWriter&& other) noexcept;
  FileWriter& operator=(FileWriter&&) = delete;
  ~FileWriter();

  /// Errors: CannotWrite.
  Result<void> write(std::uint64_t offset, std::span<const std::uint8_t> bytes);
  /// Syncs the file, renames it to its path, syncs the folder. Errors: CannotWrite.
  Result<void> finish();

 private:
  FileWriter() = default;
  Error failure(const std::string& what, int error_number) const;
  int file_ = -1;
  std::string path_;
  std::string temporary_;
};

}  // namespace vsprite::detail
