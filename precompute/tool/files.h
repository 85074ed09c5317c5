// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/files.h - files that appear complete or not at all, their sums, and one writer at a time.
//
// A file is written beside its target as `NAME.tmp.PID`, synced, renamed, and its folder synced.
// What a killed process left behind is recognised by that name and removed by the next one.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "film/source.h"
#include "vsprite/result.h"

namespace vsprite {

/// The whole file. Errors: NotFound, CannotRead, OutOfMemory is left to the caller.
Result<std::string> read_file(const std::string& path);

/// `path` holds `bytes` afterwards, complete and synced, or what it held before.
/// Errors: CannotCreate, CannotWrite (also a full disk), naming the path.
Result<void> write_file(const std::string& path, std::string_view bytes);

/// The same without waiting for the disk, for what carries its own sum and can be made again: whole
/// when the process is killed, not when the power fails. Errors: those of write_file.
Result<void> write_scratch_file(const std::string& path, std::string_view bytes);

struct NamedBytes {
  std::string path;
  std::span<const std::uint8_t> bytes;
};

/// The same for many small files: all are written before the first one is waited for, which takes a
/// tenth of the time. Each is complete where it stands; one later sync_folder() makes their names
/// durable. Keeps a descriptor open for each: some hundred at most.
/// Errors: those of write_file.
Result<void> write_files(const std::vector<NamedBytes>& files);

/// Makes the names in `folder` durable. Errors: CannotWrite.
Result<void> sync_folder(const std::string& folder);

/// Makes `path` if it is not there; a missing folder above it is more likely a slip of the pen than
/// a wish. Errors: CannotCreate.
Result<void> make_folder(const std::string& path);

/// Removes the temporaries that dead processes left in `folder` (names that hold `.tmp.PID`; only
/// those that begin with `prefix`). Returns the names removed.
std::vector<std::string> remove_stale_temporaries(const std::string& folder,
                                                  const std::string& prefix = {});

/// True for `NAME.tmp.PID`, whose process may or may not live.
bool is_temporary_name(std::string_view name) noexcept;

/// XXH3-64 of a file's content, read in pieces. Errors: NotFound, CannotRead.
Result<std::uint64_t> hash_file(const std::string& path);
/// Of a film its hash_file; of several files the sum of their sums, in order.
/// Errors: those of hash_file and files_of.
Result<std::uint64_t> hash_source(const FilmSource& source);
std::uint64_t hash_bytes(std::string_view bytes) noexcept;
/// 16 lower-case hex digits.
std::string hex64(std::uint64_t value);

/// Held as long as the object lives; the kernel releases it when the process dies, however it dies.
class FolderLock {
 public:
  /// Errors: CannotCreate, InUse (`folder is in use by process N`).
  static Result<FolderLock> take(const std::string& folder);
  FolderLock() = default;
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&& other) noexcept;
  ~FolderLock();

 private:
  int descriptor_ = -1;
};

/// The other process that holds `folder`'s lock, or 0. Pre: this process does not hold it.
int lock_holder(const std::string& folder);

/// Little-endian bytes, appended and taken off again with every length checked.
class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void put_array(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  /// Room for so many bytes more, so that none is copied again.
  void reserve(std::size_t bytes) { bytes_.reserve(bytes_.size() + bytes); }
  std::string take() && { return std::move(bytes_); }
  const std::string& bytes() const noexcept { return bytes_; }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  /// False, and nothing taken, where too few bytes are left.
  template <class T>
  bool get(T& value) noexcept {
    static_assert(std::is_trivially_copyable_v<T>);
    if (rest_.size() < sizeof value) return false;
    rest_.copy(reinterpret_cast<char*>(&value), sizeof value);
    rest_.remove_prefix(sizeof value);
    return true;
  }
  /// `count` is checked against the bytes left before memory is taken.
  template <class T>
  bool get_array(std::vector<T>& values, std::uint64_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count > rest_.size() / sizeof(T)) return false;
    values.resize(static_cast<std::size_t>(count));
    rest_.copy(reinterpret_cast<char*>(values.data()), values.size() * sizeof(T));
    rest_.remove_prefix(values.size() * sizeof(T));
    return true;
  }
  std::string_view take(std::uint64_t count) noexcept {
    const auto piece = rest_.substr(0, static_cast<std::size_t>(count));
    rest_.remove_prefix(piece.size());
    return piece;
  }
  std::size_t left() const noexcept { return rest_.size(); }

 private:
  std::string_view rest_;
};

}  // namespace vsprite
