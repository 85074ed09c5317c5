// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Plain POSIX calls: streams hide short writes, failed syncs and the reason of both.
#include "tool/files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

namespace vsprite {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemporaryMark = ".tmp.";
constexpr const char* kLockName = "lock";

std::string reason() { return std::strerror(errno); }

std::string parent_of(const std::string& path) {
  const std::string parent = fs::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

/// A descriptor that closes itself.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  int get() const noexcept { return value_; }
  int release() noexcept { return std::exchange(value_, -1); }

 private:
  int value_;
};

/// The process number behind the mark, or -1.
long temporary_owner(std::string_view name) noexcept {
  const auto mark = name.rfind(kTemporaryMark);
  if (mark == std::string_view::npos || mark == 0) return -1;
  const std::string_view digits = name.substr(mark + kTemporaryMark.size());
  long owner = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), owner);
  if (error != std::errc{} || owner <= 0) return -1;
  // The engine's writer appends a counter to its process number: `NAME.tmp.PID.3`.
  return end == digits.data() + digits.size() || *end == '.' ? owner : -1;
}

bool write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::string_view text_of(std::span<const std::uint8_t> bytes) noexcept {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// A file that is written beside its name and takes the name when it is complete. Gone if it never
/// was.
class TemporaryFile {
 public:
  explicit TemporaryFile(std::string path)
      : path_(std::move(path)),
        temporary_(path_ + std::string(kTemporaryMark) +
                   std::to_string(static_cast<long>(::getpid()))) {}
  TemporaryFile(TemporaryFile&& other) noexcept
      : path_(std::move(other.path_)),
        temporary_(std::exchange(other.temporary_, {})),
        descriptor_(std::exchange(other.descriptor_, -1)) {}
  TemporaryFile& operator=(TemporaryFile&&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }

  Result<void> write(std::string_view bytes) {
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
      temporary_.clear();
      return Error{ErrorCode::CannotCreate, path_ + ": cannot be created: " + reason()};
    }
    if (!write_all(descriptor_, bytes)) return failed("written");
    return {};
  }
  /// Waits until the disk has it.
  Result<void> sync() {
    if (::fsync(descriptor_) != 0) return failed("synced");
    return close();
  }
  Result<void> close() {
    if (::close(std::exchange(descriptor_, -1)) != 0) return failed("closed");
    return {};
  }
  Result<void> rename_into_place() {
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) return failed("renamed into place");
    temporary_.clear();
    return {};
  }

 private:
  Error failed(const char* what) const {
    return {ErrorCode::CannotWrite, path_ + ": cannot be " + what + ": " + reason()};
  }

  std::string path_, temporary_;
  int descriptor_ = -1;
};

}  // namespace

Result<std::string> read_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    if (errno == ENOENT) return Error{ErrorCode::NotFound, path + ": no such file"};
    return Error{ErrorCode::CannotRead, path + ": cannot be opened: " + reason()};
  }
  struct stat status {};
  std::string bytes;
  if (::fstat(file.get(), &status) == 0 && S_ISREG(status.st_mode))
    bytes.reserve(static_cast<std::size_t>(status.st_size));
  char piece[1 << 16];
  for (;;) {
    const ssize_t got = ::read(file.get(), piece, sizeof piece);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return Error{ErrorCode::CannotRead, path + ": cannot be read: " + reason()};
    if (got == 0) return bytes;
    bytes.append(piece, static_cast<std::size_t>(got));
  }
}

Result<void> write_file(const std::string& path, std::string_view bytes) {
  TemporaryFile file(path);
  if (auto written = file.write(bytes); !written) return written.error();
  if (auto synced = file.sync(); !synced) return synced.error();
  if (auto placed = file.rename_into_place(); !placed) return placed.error();
  return sync_folder(parent_of(path));
}

Result<void> write_scratch_file(const std::string& path, std::string_view bytes) {
  TemporaryFile file(path);
  if (auto written = file.write(bytes); !written) return written.error();
  if (auto closed = file.close(); !closed) return closed.error();
  return file.rename_into_place();
}

Result<void> write_files(const std::vector<NamedBytes>& files) {
  std::vector<TemporaryFile> open;
  open.reserve(files.size());
  for (const NamedBytes& file : files) {
    open.emplace_back(file.path);
    if (auto written = open.back().write(text_of(file.bytes)); !written) return written.error();
  }
  // All are on their way to the disk before the first one is waited for.
  for (TemporaryFile& file : open)
    if (auto synced = file.sync(); !synced) return synced.error();
  for (TemporaryFile& file : open)
    if (auto placed = file.rename_into_place(); !placed) return placed.error();
  return {};
}

Result<void> sync_folder(const std::string& folder) {
  const Descriptor descriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // Some file systems cannot sync a folder and say so with EINVAL: nothing is left to do there.
  if (descriptor.get() < 0 || (::fsync(descriptor.get()) != 0 && errno != EINVAL))
    return Error{ErrorCode::CannotWrite, folder + ": cannot be synced: " + reason()};
  return {};
}

Result<void> make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directory(path, error);
  const fs::path above =
      fs::path(path.ends_with('/') ? path.substr(0, path.size() - 1) : path).parent_path();
  if (error == std::errc::no_such_file_or_directory)
    return Error{ErrorCode::CannotCreate,
                 path + ": cannot be created: there is no folder " + above.string()};
  if (error)
    return Error{ErrorCode::CannotCreate, path + ": cannot be created: " + error.message()};
  return {};
}

bool is_temporary_name(std::string_view name) noexcept { return temporary_owner(name) > 0; }

std::vector<std::string> remove_stale_temporaries(const std::string& folder,
                                                  const std::string& prefix) {
  std::vector<std::string> removed;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    const long owner = temporary_owner(name);
    if (owner <= 0 || name.compare(0, prefix.size(), prefix) != 0) continue;
    const bool alive =
        owner != ::getpid() && (::kill(static_cast<pid_t>(owner), 0) == 0 || errno == EPERM);
    std::error_code ignored;
    if (!alive && fs::remove(entry.path(), ignored)) removed.push_back(name);
  }
  return removed;
}

Result<std::uint64_t> hash_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) {
    if (errno == ENOENT) return Error{ErrorCode::NotFound, path + ": no such file"};
    return Error{ErrorCode::CannotRead, path + ": cannot be opened: " + reason()};
  }
  const std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(),
                                                                              XXH3_freeState);
  XXH3_64bits_reset(state.get());
  std::vector<char> piece(1 << 18);
  for (;;) {
    const ssize_t got = ::read(file.get(), piece.data(), piece.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return Error{ErrorCode::CannotRead, path + ": cannot be read: " + reason()};
    if (got == 0) return XXH3_64bits_digest(state.get());
    XXH3_64bits_update(state.get(), piece.data(), static_cast<std::size_t>(got));
  }
}

Result<std::uint64_t> hash_source(const FilmSource& source) {
  const auto files = files_of(source);
  if (!files) return files.error();
  if (files->size() == 1) return hash_file(files->front());
  std::string sums;
  for (const std::string& file : *files) {
    const auto sum = hash_file(file);
    if (!sum) return sum.error();
    sums += hex64(*sum);
  }
  return hash_bytes(sums);
}

std::uint64_t hash_bytes(std::string_view bytes) noexcept {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::string hex64(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t digit = 16; digit-- > 0; value >>= 4)
    text[digit] = "0123456789abcdef"[value & 15];
  return text;
}

// A record lock, not flock: a forked decoder must not go on holding it after its parent was killed.
Result<FolderLock> FolderLock::take(const std::string& folder) {
  const std::string path = folder + "/" + kLockName;
  Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (file.get() < 0)
    return Error{ErrorCode::CannotCreate, path + ": cannot be created: " + reason()};
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (::fcntl(file.get(), F_SETLK, &whole) != 0) {
    if (errno != EACCES && errno != EAGAIN)
      return Error{ErrorCode::CannotCreate, path + ": cannot be locked: " + reason()};
    return Error{ErrorCode::InUse, folder + ": the folder is in use by process " +
                                       std::to_string(lock_holder(folder)) +
                                       ": wait for it to end, or name another one with --work"};
  }
  FolderLock lock;
  lock.descriptor_ = file.release();
  return lock;
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

int lock_holder(const std::string& folder) {
  const std::string path = folder + "/" + kLockName;
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (file.get() < 0 || ::fcntl(file.get(), F_GETLK, &whole) != 0) return 0;
  return whole.l_type == F_UNLCK ? 0 : static_cast<int>(whole.l_pid);
}

}  // namespace vsprite
