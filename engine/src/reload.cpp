// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// A file is told from another by its number, size and date: a rename brings another number, a
// rewriting another date.
#include "vsprite/reload.h"

#include <sys/stat.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include "memory.h"
#include "pack_format.h"

namespace vsprite {

namespace {

using Rebuilt = Result<std::optional<Sprite>>;

// Every byte of the file, and what it holds. Ends early, with some error, once `stops`.
Rebuilt check_and_load(const std::string& path, const std::atomic<bool>& stops) {
  const auto source = detail::ByteSource::open(path);
  if (!source) return source.error();
  auto issues =
      verify_pack(PackReader{.bytes = source->size(),
                             .name = path,
                             .read = [&](std::uint64_t offset, std::span<std::uint8_t> out) {
                               return !stops && source->read(offset, out);
                             }});
  if (!issues) return issues.error();
  auto sprite = load_pack(path);  // what the tables hold is said with its own code
  if (!sprite) return sprite.error();
  if (!issues->empty()) {
    const PackIssue& first = issues->front();
    const std::string section = first.section.empty() ? "" : first.section + ": ";
    return Error{ErrorCode::CorruptData, path + ": " + section + first.message};
  }
  return std::optional<Sprite>(std::move(*sprite));
}

}  // namespace

// One file's check, by a thread where one can be had.
struct PackWatch::Check {
  explicit Check(std::string file) : path(std::move(file)) {
#if VSPRITE_THREADS
    try {
      thread = std::thread([this, memory = detail::current_memory()] {
        const detail::MemoryScope scope(memory);
        run();
      });
      return;
    } catch (const std::system_error&) {
      // The machine has none to give.
    }
#endif
    run();
  }
  ~Check() {
    stops = true;
    if (thread.joinable()) thread.join();
  }
  void run() {
    try {
      result = check_and_load(path, stops);
    } catch (const std::bad_alloc&) {
      result = Error{ErrorCode::OutOfMemory, path + ": out of memory while checking it"};
    }
    is_done = true;
  }

  std::string path;
  Rebuilt result = std::optional<Sprite>();
  std::atomic<bool> is_done = false, stops = false;
  std::thread thread;
};

PackWatch::PackWatch(std::string path) : path_(std::move(path)) { known_ = seen_ = look(); }
PackWatch::PackWatch(PackWatch&&) noexcept = default;
PackWatch& PackWatch::operator=(PackWatch&&) noexcept = default;
PackWatch::~PackWatch() = default;

PackWatch::Stamp PackWatch::look() const noexcept {
  struct stat status {};
  if (::stat(path_.c_str(), &status) != 0) return {};
  return {static_cast<std::int64_t>(status.st_dev), static_cast<std::int64_t>(status.st_ino),
          std::int64_t{status.st_size}, std::int64_t{status.st_mtim.tv_sec},
          std::int64_t{status.st_mtim.tv_nsec}};
}

Result<std::optional<Sprite>> PackWatch::poll() {
  const Stamp before = std::exchange(seen_, look());
  if (check_ == nullptr && seen_ != known_ && seen_ == before && seen_ != Stamp{}) {
    known_ = seen_;
    check_ = std::make_unique<Check>(path_);
  }
  if (check_ == nullptr || !check_->is_done) return std::optional<Sprite>();
  return std::move(std::exchange(check_, nullptr)->result);
}

namespace {

// The sample of `to` that is most like sample `i` of `from`.
std::uint32_t counterpart(const Sprite& from, std::uint32_t i, const Sprite& to) {
  const Sample& old = from.samples()[i];
  const std::string& tag = from.data().tags[old.tag];
  std::uint32_t best = to.data().start_sample;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (std::uint32_t j = 0; j < to.samples().size(); ++j) {
    const Sample& s = to.samples()[j];
    if (s.kept == 0 || to.data().tags[s.tag] != tag) continue;
    // The same frame first, then as it was mirrored, then in its clip.
    const bool is_turned = (s.mirror_of == kNoSample) != (old.mirror_of == kNoSample);
    const std::int64_t off = std::abs(std::int64_t{s.frame} - std::int64_t{old.frame});
    const std::int64_t distance = 4 * off + 2 * is_turned + (s.clip != old.clip);
    if (distance < least) least = distance, best = j;
  }
  return best;
}

}  // namespace

Actor carry_over(const Sprite& from, const Sprite& to, const Actor& actor) noexcept {
  const int mode = to.find_mode(from.data().modes[actor.mode].name);
  Actor now = make_actor(to, {}, 0, mode < 0 ? 0 : mode);
  now.position = actor.position;
  now.tick = actor.tick;
  now.random = actor.random;
  now.owner = actor.owner;
  now.drive_x = actor.drive_x;
  now.drive_y = actor.drive_y;
  now.offset_x = actor.offset_x;
  now.offset_y = actor.offset_y;
  now.sample = counterpart(from, actor.sample, to);
  if (actor.direction != now.direction) set_direction(to, now, actor.direction);
  return now;
}

}  // namespace vsprite
