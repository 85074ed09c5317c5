// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "window/key_job.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "film/color.h"

namespace vsprite::window {
namespace {

constexpr std::int64_t kRoom = std::int64_t{256} << 20;  // bytes of frames beside the samples
constexpr int kBefore = 2, kAfter = 5;                  // fetched with a frame: the next steps

std::int64_t bytes_of(const Frame& frame) {
  return static_cast<std::int64_t>(frame.y.size() + 2 * frame.cb.size() + frame.rgba.size());
}

}  // namespace

KeyJob::KeyJob(FilmSource source) : source_(std::move(source)), thread_([this] { work(); }) {}

KeyJob::~KeyJob() {
  {
    const std::scoped_lock lock(guard_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void KeyJob::ask(const KeyWish& wish) {
  {
    const std::scoped_lock lock(guard_);
    wish_ = wish;
    shown_.reset();
    if (state_.phase == KeyPhase::Idle) state_.phase = KeyPhase::Keying;
  }
  changed_.notify_all();
}

std::optional<KeyShown> KeyJob::take() {
  const std::scoped_lock lock(guard_);
  return std::exchange(shown_, std::nullopt);
}

KeyState KeyJob::state() const {
  const std::scoped_lock lock(guard_);
  return state_;
}

void KeyJob::wait() {
  std::unique_lock lock(guard_);
  changed_.wait(lock, [this] { return is_done_ || (state_.phase == KeyPhase::Idle && !wish_); });
}

void KeyJob::set_phase(KeyPhase phase, double share) {
  const std::scoped_lock lock(guard_);
  state_.phase = phase;
  state_.share = share;
}

// The frames on which `segment` measures the background: of others it would find another one.
bool KeyJob::read_samples() {
  auto samples = sample_frames(source_, KeyConfig{}.sample_count, [this](double share) {
    const std::scoped_lock lock(guard_);
    state_.share = share;
    return !ends_;
  });
  std::optional<Error> fault;
  if (!samples)
    fault = samples.error();
  else
    samples_ = std::move(*samples);
  if (!fault && samples_.empty())
    fault = Error{ErrorCode::BadContent, source_.path + ": no frames"};
  const std::scoped_lock lock(guard_);
  if (fault) {
    state_.error = fault;
    return false;
  }
  for (const Frame& frame : samples_) state_.frames.push_back(frame.index);
  state_.film_frames = samples_.back().index + 1;
  return true;
}

// One frame more to be shown, while nothing else is to be done.
void KeyJob::read_more() {
  Frame frame;
  const auto more = reader_->read(frame);
  if (!more || !*more) {
    reader_.reset();
    return;
  }
  const int index = frame.index;
  const std::scoped_lock lock(guard_);
  state_.film_frames = std::max(state_.film_frames, index + 1);
  auto& frames = state_.frames;
  const auto place = std::lower_bound(frames.begin(), frames.end(), index);
  if (index % stride_ != 0 || (place != frames.end() && *place == index)) return;
  frames.insert(place, index);
  between_.emplace(index, std::move(frame));
}

bool KeyJob::is_wanted(const KeyWish& wish) const {
  const std::scoped_lock lock(guard_);
  return wish_ == wish && !ends_;
}

// The frame itself, where one beside it was shown.
void KeyJob::fetch(const KeyWish& wish) {
  FilmSource source = source_;
  source.first = std::max(source_.first, wish.frame - kBefore);
  source.end = std::min(source_.end, wish.frame + kAfter + 1);
  if (source.first >= source.end) return;
  auto reader = FilmReader::open_range(source);
  if (!reader) return;
  about_.clear();
  for (Frame frame; is_wanted(wish);) {
    const auto more = reader->read(frame);
    if (!more || !*more) break;
    const int index = frame.index;
    about_.emplace(index, std::move(frame));
  }
}

void KeyJob::hand_out(KeyShown shown) {
  const std::scoped_lock lock(guard_);
  if (wish_ == shown.wish) shown_ = std::move(shown);
}

const Frame& KeyJob::nearest(int index) const {
  const Frame* best = &samples_[0];
  const auto look = [&](const Frame& frame) {
    if (std::abs(frame.index - index) < std::abs(best->index - index)) best = &frame;
  };
  for (const Frame& frame : samples_) look(frame);
  for (const auto* frames : {&between_, &about_}) {
    const auto after = frames->lower_bound(index);
    if (after != frames->end()) look(after->second);
    if (after != frames->begin()) look(std::prev(after)->second);
  }
  return *best;
}

const Result<ScreenModel>& KeyJob::model_of(const std::string& key) {
  const auto known = std::find_if(models_.begin(), models_.end(),
                                  [&](const auto& model) { return model.first == key; });
  if (known != models_.end()) {
    std::rotate(known, std::next(known), models_.end());
    return models_.back().second;
  }
  set_phase(KeyPhase::Measuring);
  if (models_.size() > 1) models_.erase(models_.begin());
  const auto config = parse_key(key);
  models_.emplace_back(
      key, config ? measure_screen(samples_, *config) : Result<ScreenModel>(config.error()));
  set_phase(KeyPhase::Keying);
  return models_.back().second;
}

KeyShown KeyJob::show(const KeyWish& wish) {
  using Clock = std::chrono::steady_clock;
  KeyShown out;
  out.wish = wish;
  const Frame& frame = nearest(wish.frame);
  out.keyed.index = frame.index;
  out.film = to_image(frame);
  const auto& screen = model_of(wish.key);
  if (!screen) {
    out.error = screen.error().message;
    return out;
  }
  const auto begun = Clock::now();
  out.keyed = Keyer(*screen, wish.matte).key(frame, nullptr);
  out.seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  out.background = screen->reason;
  std::copy_n(screen->color, 3, out.color);
  out.is_keyed = screen->kind != KeyKind::None && screen->kind != KeyKind::Alpha;
  out.has_tint = out.is_keyed && screen->key >= 0;
  return out;
}

void KeyJob::work() {
  bool goes_on = read_samples();
  if (goes_on) {
    if (auto reader = FilmReader::open(source_)) {
      const FilmInfo& info = reader->info();
      const std::int64_t all = bytes_of(samples_[0]) * std::max(info.claimed_frames, 1);
      stride_ = static_cast<int>((all + kRoom - 1) / kRoom);
      const std::scoped_lock lock(guard_);
      state_.film_frames =
          std::max(state_.film_frames, std::min(info.counted_frames, source_.end));
      reader_.emplace(std::move(*reader));
    }
    set_phase(KeyPhase::Idle);
    changed_.notify_all();
  }
  while (goes_on) {
    std::optional<KeyWish> wish;
    {
      std::unique_lock lock(guard_);
      if (!reader_) changed_.wait(lock, [this] { return wish_ || ends_; });
      if (ends_) break;
      wish = wish_;
    }
    if (!wish) {
      read_more();
      continue;
    }
    set_phase(KeyPhase::Keying);
    KeyShown shown = show(*wish);
    shown.is_final = shown.keyed.index == wish->frame;
    const bool is_final = shown.is_final;
    hand_out(std::move(shown));
    if (!is_final) {
      fetch(*wish);
      if (is_wanted(*wish)) hand_out(show(*wish));
    }
    const std::scoped_lock lock(guard_);
    if (wish_ == wish) {
      wish_.reset();
      state_.phase = KeyPhase::Idle;
    }
    changed_.notify_all();
  }
  const std::scoped_lock lock(guard_);
  is_done_ = true;
  changed_.notify_all();
}

}  // namespace vsprite::window
