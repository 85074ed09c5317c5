// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The child is forked, not executed: it needs no program of its own, and it ends with _exit, so
// that nothing of the parent's is torn down twice.
#include "film/decoder.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>

#include "film/container.h"
#include "film/sender.h"

namespace vsprite::detail {
namespace {

constexpr rlim_t kChildBytes = rlim_t{4} << 30;  // beyond what the parent had mapped

// Leaves the child with nothing of the parent's but the channel, and a bound on its memory.
void isolate(Channel& channel, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);
  std::signal(SIGINT, SIG_IGN);  // the parent decides when work ends
  for (int s : {SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    std::signal(s, SIG_DFL);
  const Channel high{fcntl(channel.socket, F_DUPFD, 16), fcntl(channel.memory, F_DUPFD, 16)};
  channel = {3, 4};
  dup2(high.socket, channel.socket);
  dup2(high.memory, channel.memory);
  const int null = open("/dev/null", O_RDWR);
  for (int fd : {0, 1, 2}) dup2(null, fd);
  close_range(5, ~0u, 0);
  rlimit limit{};
  rlim_t mapped = 0;
  if (std::FILE* statm = std::fopen("/proc/self/statm", "r")) {
    unsigned long pages = 0;
    if (std::fscanf(statm, "%lu", &pages) == 1)
      mapped = rlim_t{pages} * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
    std::fclose(statm);
  }
  limit.rlim_cur = limit.rlim_max = mapped + kChildBytes;
  setrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = limit.rlim_max = 0;
  setrlimit(RLIMIT_CORE, &limit);
}

// `wanted` of the things first..end-1, spread evenly: the middles of as many equal parts.
std::vector<bool> spread(std::size_t first, std::size_t end, std::size_t count, int wanted) {
  first = std::min(first, count), end = std::min(end, count);
  std::vector<bool> chosen(count);
  const std::size_t room = end > first ? end - first : 0;
  if (room <= static_cast<std::size_t>(wanted)) {
    for (std::size_t i = first; i < end; ++i) chosen[i] = true;
    return chosen;
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(wanted); ++k)
    chosen[first + (2 * k + 1) * room / (2 * static_cast<std::size_t>(wanted))] = true;
  return chosen;
}

// Runs of `length` begin at the chosen frames; none runs into the next.
void lengthen(std::vector<bool>& chosen, int length, int end) {
  for (int i = static_cast<int>(chosen.size()) - 1; i >= 0; --i)
    for (int k = 1; chosen[static_cast<std::size_t>(i)] && k < length && i + k < end; ++k)
      if (const auto next = static_cast<std::size_t>(i + k); next < chosen.size())
        chosen[next] = true;
}

class Choice {
 public:
  Choice(const Outline& outline, const FilmSource& source, const Selection& selection)
      : mode_(selection.mode),
        length_(selection.length),
        first_(source.first),
        end_(source.end),
        outline_(outline) {
    const auto& times = outline_.times;
    const bool timed = !times.empty() && times.front() != Frame::kNoTime;
    if (mode_ == Selection::Sought && timed) find_start();
    if (is_whole_range()) return;
    const bool whole = first_ == 0 && end_ == INT_MAX;
    // The key frames are sorted by place; those of the range alone are counted.
    std::vector<int> places;
    for (const std::int64_t key : outline_.keys) places.push_back(timed ? index_of(key) : 0);
    const auto within = [this](int place) { return place >= first_ && place < end_; };
    const auto from = static_cast<std::size_t>(std::find_if(places.begin(), places.end(), within) -
                                               places.begin());
    const auto count =
        static_cast<std::size_t>(std::count_if(places.begin(), places.end(), within));
    const bool few = selection.by_count || (!timed && !whole) ||
                     static_cast<int>(count) < std::min(selection.wanted, kLeastKeyFrames);
    by_keys_ = mode_ != Selection::Spread && !few;
    if (by_keys_) key_chosen_ = spread(from, from + count, places.size(), selection.wanted);
    if (mode_ == Selection::KeyFrames && few) mode_ = Selection::Spread;
    if (by_keys_) return;
    chosen_ = spread(static_cast<std::size_t>(first_), static_cast<std::size_t>(end_), times.size(),
                     selection.wanted);
    if (mode_ == Selection::Bursts) lengthen(chosen_, length_, end_);
  }
  bool keys_only() const { return mode_ == Selection::KeyFrames; }
  bool admits(const AVPacket& packet) {
    if (start_ != Frame::kNoTime && !started_) {
      started_ = (packet.flags & AV_PKT_FLAG_KEY) != 0 && packet.pts == start_;
      if (!started_) return false;
    }
    if (!by_keys_) return true;
    const bool shown = (packet.flags & AV_PKT_FLAG_DISCARD) == 0;
    const bool key = (packet.flags & AV_PKT_FLAG_KEY) != 0 && shown;
    if (key && key_chosen_[std::min(key_++, key_chosen_.size() - 1)]) {
      left_ = mode_ == Selection::Bursts ? length_ + kReordered : 1;
      begin_ = index_of(packet.pts);
    } else if (key && mode_ == Selection::KeyFrames) {
      left_ = 0;
    }
    if (mode_ == Selection::KeyFrames && !key) return false;
    if (left_ == 0) return false;
    if (mode_ == Selection::Bursts && key) begins_.push_back(begin_);
    left_ -= shown ? 1 : 0;
    return true;
  }
  /// Whether the frame, the `count`-th decoded, is to be sent, and its number in the film.
  bool sends(const AVFrame& frame, int count, int& index) const {
    index = count;
    if (start_ != Frame::kNoTime && frame.best_effort_timestamp != AV_NOPTS_VALUE)
      index = index_of(frame.best_effort_timestamp);
    if (is_whole_range()) return index >= first_ && index < end_;
    if (!by_keys_)
      return static_cast<std::size_t>(count) < chosen_.size() &&
             chosen_[static_cast<std::size_t>(count)];
    if (frame.best_effort_timestamp != AV_NOPTS_VALUE)
      index = index_of(frame.best_effort_timestamp);
    if (mode_ == Selection::KeyFrames) return true;
    // Behind the run's end frames come with holes between: those that they refer to are not read.
    return std::any_of(begins_.begin(), begins_.end(),
                       [&](int begin) { return index >= begin && index < begin + length_; });
  }
  /// Nothing from frame `index` on is sent.
  bool is_over(int index) const { return !by_keys_ && index >= end_; }

 private:
  static constexpr int kLeastKeyFrames = 24;
  static constexpr int kReordered = 6;  // packets that may stand before an earlier frame's
  bool is_whole_range() const { return mode_ == Selection::Every || mode_ == Selection::Sought; }
  // The last key frame that is shown no later than the first frame wanted; what is shown before it
  // may lack what it refers to.
  void find_start() {
    const auto& times = outline_.times;
    if (first_ >= static_cast<int>(times.size())) return;
    for (const std::int64_t key : outline_.keys)
      if (key <= times[static_cast<std::size_t>(first_)]) start_ = std::max(start_, key);
  }
  int index_of(std::int64_t time) const {
    return static_cast<int>(std::lower_bound(outline_.times.begin(), outline_.times.end(), time) -
                            outline_.times.begin());
  }

  Selection::Mode mode_;
  int length_, first_, end_;
  bool by_keys_ = false;
  const Outline& outline_;
  std::vector<bool> chosen_, key_chosen_;
  std::size_t key_ = 0;
  std::int64_t start_ = Frame::kNoTime;  // of Sought: decoding begins with this key frame
  bool started_ = false;
  int left_ = 0, begin_ = 0;
  std::vector<int> begins_;
};

void send_end(int out) {
  const FrameHead end;
  send(out, &end, sizeof end);
}

void decode_film(const Channel& channel, const FilmSource& source, const Selection& selection) {
  const int out = channel.socket;
  av_log_set_level(AV_LOG_QUIET);
  const Outline outline = outline_of(source.path);
  Choice choice(outline, source, selection);
  const auto admits = [&choice](const AVPacket& packet) { return choice.admits(packet); };
  Film film;
  const Owned<AVFrame> frame(need(av_frame_alloc()));
  Hello hello;
  const bool opened = film.open(source.path);
  if (opened && choice.keys_only()) film.decoder().skip_frame = AVDISCARD_NONKEY;
  if (!opened || !film.next_frame(*frame, admits)) return send(out, &hello, sizeof hello);
  hello = describe(film, outline, *frame);
  send(out, &hello, sizeof hello);
  Sender sender(channel, hello);
  int count = 0;
  do {
    int index = 0;
    const bool sent = choice.sends(*frame, count++, index);
    if (choice.is_over(index)) break;
    if (sent) sender.send_frame(*frame, index);
    av_frame_unref(frame.get());
  } while (film.next_frame(*frame, admits));
  send_end(out);
}

// The number at the end of a picture's name; -1 where there is none.
std::int64_t number_of(const std::string& path) {
  std::size_t end = path.rfind('.');
  if (end == std::string::npos) end = path.size();
  std::size_t begin = end;
  while (begin > 0 && path[begin - 1] >= '0' && path[begin - 1] <= '9') --begin;
  if (begin == end || end - begin > 15) return -1;
  return std::stoll(path.substr(begin, end - begin));
}

// Pictures that are numbered upwards are shown at their number, so that a lost one leaves a gap;
// others one after the other.
std::vector<std::int64_t> times_of(const std::vector<std::string>& pictures) {
  std::vector<std::int64_t> numbers, places;
  bool numbered = true;
  for (const std::string& picture : pictures) {
    const std::int64_t number = number_of(picture);
    numbered = numbered && number >= 0 && (numbers.empty() || number > numbers.back());
    numbers.push_back(number);
    places.push_back(static_cast<std::int64_t>(places.size()));
  }
  return numbered ? numbers : places;
}

template <std::size_t N>
void put_text(char (&to)[N], const std::string& text) {
  std::strncpy(to, text.c_str(), N - 1);
}

void decode_pictures(const Channel& channel, const FilmSource& source, const Selection& selection) {
  const int out = channel.socket;
  Hello hello;
  const auto pictures = find_pictures(source.path);
  if (!pictures) {
    put_text(hello.fault, pictures.error().message);
    return send(out, &hello, sizeof hello);
  }
  const auto count = static_cast<int>(pictures->size());
  auto chosen = std::vector<bool>(pictures->size(), true);
  if (selection.mode != Selection::Every && selection.mode != Selection::Sought)
    chosen = spread(static_cast<std::size_t>(source.first), static_cast<std::size_t>(source.end),
                    pictures->size(), selection.wanted);
  if (selection.mode == Selection::Bursts) lengthen(chosen, selection.length, source.end);
  const auto times = times_of(*pictures);
  std::optional<Sender> sender;
  for (int i = source.first; i < std::min(count, source.end); ++i) {
    if (!chosen[static_cast<std::size_t>(i)]) continue;
    const std::string& name = (*pictures)[static_cast<std::size_t>(i)];
    auto picture = read_png(name);
    if (!picture && picture.error().code == ErrorCode::OutOfMemory) throw std::bad_alloc();
    if (hello.kind == Kind::NoFilm) {
      if (!picture) {
        put_text(hello.fault, picture.error().message);
        return send(out, &hello, sizeof hello);
      }
      hello.kind = Kind::Film;
      hello.width = picture->width;
      hello.height = picture->height;
      hello.claimed_frames = hello.counted_frames = count;
      hello.pictures = hello.has_alpha = 1;
      hello.fps = source.fps > 0 ? source.fps : 30;
      hello.coding = {Matrix::Bt601, true, Siting::Center};
      put_text(hello.pixel_format, "png");
      send(out, &hello, sizeof hello);
      sender.emplace(channel, hello);
    }
    if (picture && (picture->width != hello.width || picture->height != hello.height))
      picture = Error{ErrorCode::BadContent,
                      name + ": " + size_text(picture->width, picture->height) + " px, the first " +
                          size_text(hello.width, hello.height) + "; due: one size"};
    if (!picture) {
      FrameHead head;
      head.kind = Kind::Damaged;
      send(out, &head, sizeof head);
      put_text(hello.fault, picture.error().message);
      send(out, hello.fault, sizeof hello.fault);
      return;
    }
    sender->send_picture(*picture, i, times[static_cast<std::size_t>(i)]);
  }
  if (hello.kind == Kind::NoFilm) return send(out, &hello, sizeof hello);
  send_end(out);
}

}  // namespace

void decode_in_child(Channel channel, pid_t parent, const FilmSource& source,
                     const Selection& selection) {
  isolate(channel, parent);
  int status = 0;
  try {
    if (is_picture_source(source.path))
      decode_pictures(channel, source, selection);
    else
      decode_film(channel, source, selection);
  } catch (const std::bad_alloc&) {
    status = kExitNoMemory;
  } catch (...) {
    status = 70;
  }
  _exit(status);
}

}  // namespace vsprite::detail
