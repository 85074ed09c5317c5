// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace vsprite::detail {
namespace {

std::string reason(int error_number) { return std::generic_category().message(error_number); }

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

// Removes PATH.tmp.PID.SERIAL of processes that are gone: what a killed writer left behind.
void remove_stale_temporaries(const std::string& path) {
  namespace fs = std::filesystem;
  const std::string prefix = fs::path(path).filename().string() + ".tmp.";
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder_of(path), ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const char* end = name.data() + name.size();
    pid_t writer = 0;
    const auto [after, error] = std::from_chars(name.data() + prefix.size(), end, writer);
    if (error != std::errc() || after == end || *after != '.' || writer <= 0) continue;
    if (::kill(writer, 0) != 0 && errno == ESRCH) ::unlink(entry.path().c_str());
  }
}

}  // namespace

Result<ByteSource> ByteSource::open(const std::string& path) {
  // Without O_NONBLOCK opening a pipe would wait for its other end.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    const int error = errno;
    const bool missing = error == ENOENT || error == ENOTDIR;
    return Error{missing ? ErrorCode::NotFound : ErrorCode::CannotRead,
                 path + ": " + (missing ? "no such file" : "cannot be opened: " + reason(error))};
  }
  ByteSource source;
  source.file_ = file;
  source.name_ = path;
  struct stat status {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) {
    return Error{ErrorCode::CannotRead,
                 path + (S_ISDIR(status.st_mode) ? ": is a folder, a file was due"
                                                 : ": is not an ordinary file")};
  }
  source.size_ = static_cast<std::uint64_t>(status.st_size);
  return source;
}

ByteSource ByteSource::borrow(std::span<const std::uint8_t> bytes, std::string name) {
  ByteSource source;
  source.memory_ = bytes;
  source.size_ = bytes.size();
  source.name_ = std::move(name);
  return source;
}

ByteSource ByteSource::call(PackReader reader) {
  ByteSource source;
  source.size_ = reader.bytes;
  source.name_ = std::move(reader.name);
  source.read_ = std::move(reader.read);
  return source;
}

ByteSource::ByteSource(ByteSource&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      memory_(other.memory_),
      read_(std::move(other.read_)),
      size_(other.size_),
      name_(std::move(other.name_)) {}

ByteSource& ByteSource::operator=(ByteSource&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(memory_, other.memory_);
  std::swap(read_, other.read_);
  std::swap(size_, other.size_);
  std::swap(name_, other.name_);
  return *this;
}

ByteSource::~ByteSource() {
  if (file_ >= 0) ::close(file_);
}

Result<void> ByteSource::read(std::uint64_t offset, std::span<std::uint8_t> out) const {
  assert(offset <= size_ && out.size() <= size_ - offset);
  if (read_) {
    if (out.empty() || read_(offset, out)) return {};
    return Error{ErrorCode::CannotRead, name_ + ": its reader failed at byte " +
                                            std::to_string(offset) + " of " +
                                            std::to_string(size_)};
  }
  if (file_ < 0) {
    if (!out.empty()) std::memcpy(out.data(), memory_.data() + offset, out.size());
    return {};
  }
  std::size_t done = 0;
  while (done < out.size()) {
    const ssize_t got =
        ::pread(file_, out.data() + done, out.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return Error{ErrorCode::CannotRead, name_ + ": cannot be read: " + reason(errno)};
    if (got == 0) {
      return Error{ErrorCode::CannotRead, name_ + ": has become shorter while it was in use"};
    }
    done += static_cast<std::size_t>(got);
  }
  return {};
}

Result<std::vector<std::uint8_t>> read_file(const std::string& path, std::uint64_t limit) {
  auto source = ByteSource::open(path);
  if (!source) return source.error();
  if (source->size() > limit) {
    return Error{ErrorCode::LimitExceeded, path + ": " + std::to_string(source->size()) +
                                               " bytes, at most " + std::to_string(limit) +
                                               " are read"};
  }
  std::vector<std::uint8_t> bytes;
  try {
    bytes.resize(source->size());
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, path + ": out of memory"};
  }
  if (auto read = source->read(0, bytes); !read) return read.error();
  return bytes;
}

Result<FileWriter> FileWriter::create(const std::string& path) {
  remove_stale_temporaries(path);
  static std::atomic<unsigned> serial{0};  // two threads may write the same path
  FileWriter writer;
  writer.path_ = path;
  writer.temporary_ = path + ".tmp." + std::to_string(::getpid()) + "." +
                      std::to_string(serial.fetch_add(1, std::memory_order_relaxed));
  writer.file_ = ::open(writer.temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (writer.file_ < 0) {
    const int error = errno;
    return Error{ErrorCode::CannotCreate, path + ": cannot be created: " + reason(error)};
  }
  return writer;
}

FileWriter::FileWriter(FileWriter&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      path_(std::move(other.path_)),
      temporary_(std::move(other.temporary_)) {}

FileWriter::~FileWriter() {
  if (file_ < 0) return;
  ::close(file_);
  ::unlink(temporary_.c_str());
}

Error FileWriter::failure(const std::string& what, int error_number) const {
  return Error{ErrorCode::CannotWrite, path_ + ": " + what + " failed: " + reason(error_number)};
}

Result<void> FileWriter::write(std::uint64_t offset, std::span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t put = ::pwrite(file_, bytes.data() + done, bytes.size() - done,
                                 static_cast<off_t>(offset + done));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) {
      const int error = errno;
      return failure(
          "writing " + std::to_string(bytes.size()) + " bytes at " + std::to_string(offset), error);
    }
    done += static_cast<std::size_t>(put);
  }
  return {};
}

Result<void> FileWriter::finish() {
  if (::fsync(file_) != 0) return failure("syncing", errno);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) return failure("renaming", errno);
  ::close(std::exchange(file_, -1));
  const int folder = ::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return {};
  const int synced = ::fsync(folder);
  const int error = errno;
  ::close(folder);
  // Some file systems cannot sync a folder; the rename stands all the same.
  if (synced != 0 && error != EINVAL) return failure("syncing the folder", error);
  return {};
}

}  // namespace vsprite::detail
