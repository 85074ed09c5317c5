// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// key_job.h - the keyer behind the key window: in a thread of its own, where frames are read, the
// background is measured and one frame is keyed as it was last asked for.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "film/matte.h"
#include "film/plate.h"
#include "film/video.h"

namespace vsprite::window {

/// A frame, and how it is to be keyed.
struct KeyWish {
  int frame = 0;  ///< of the film; the nearest that is held is taken until it was fetched
  std::string key = "auto";
  MatteConfig matte{};
  bool operator==(const KeyWish&) const = default;
};

/// What came of it.
struct KeyShown {
  KeyWish wish;
  Image film;              ///< the frame as it is, opaque
  KeyedFrame keyed;        ///< its index is that of the frame taken
  std::string background;  ///< what was measured, in words
  float color[3] = {};     ///< of the background, R G B, 0..255
  bool has_tint = false;   ///< the background is a coloured screen
  bool is_keyed = false;   ///< the film brings no alpha of its own
  double seconds = 0;      ///< of keying the frame
  bool is_final = true;    ///< false: a frame beside the one asked for, which is being fetched
  std::string error{};     ///< why there is no matte; empty
};

enum class KeyPhase { Reading, Measuring, Keying, Idle };

struct KeyState {
  KeyPhase phase = KeyPhase::Reading;
  double share = 0;            ///< of Reading, 0..1
  std::vector<int> frames;     ///< that can be shown, in order
  int film_frames = 0;         ///< of the film, as far as it is known
  std::optional<Error> error;  ///< of the film as a whole
};

class KeyJob {
 public:
  explicit KeyJob(FilmSource source);
  KeyJob(const KeyJob&) = delete;
  KeyJob& operator=(const KeyJob&) = delete;
  ~KeyJob();  ///< waits for a measurement that runs: a second or two of a large film

  /// Another frame or other settings: what was asked before is forgotten.
  void ask(const KeyWish& wish);
  /// Handed out once. None: nothing new.
  std::optional<KeyShown> take();
  KeyState state() const;
  /// Returns once nothing is to be done.
  void wait();

 private:
  void work();
  bool read_samples();
  void read_more();
  void fetch(const KeyWish& wish);
  bool is_wanted(const KeyWish& wish) const;
  void hand_out(KeyShown shown);
  KeyShown show(const KeyWish& wish);
  const Frame& nearest(int index) const;
  const Result<ScreenModel>& model_of(const std::string& key);
  void set_phase(KeyPhase phase, double share = 0);

  // Of the thread alone.
  const FilmSource source_;
  std::vector<Frame> samples_;    ///< that `segment` measures the background on
  std::map<int, Frame> between_;  ///< as many of the others as there is room for
  std::map<int, Frame> about_;    ///< and those about the frame last asked for
  std::optional<FilmReader> reader_;
  int stride_ = 1;
  std::vector<std::pair<std::string, Result<ScreenModel>>> models_;  ///< the last two asked for

  mutable std::mutex guard_;
  std::condition_variable changed_;
  std::optional<KeyWish> wish_;
  std::optional<KeyShown> shown_;
  KeyState state_;
  bool ends_ = false, is_done_ = false;
  std::thread thread_;
};

}  // namespace vsprite::window
