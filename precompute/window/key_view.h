// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// key_view.h - what the key window shows, and what the mouse changes.
#pragma once

#include <optional>
#include <string>

#include "tool/settings.h"
#include "vsprite/draw.h"
#include "window/key_job.h"

namespace vsprite::window {

enum class KeyAction {
  Other,
  Copy,
  Pick,
  Measure,
  Reset,
  Ground,
  Matte,
  Back,
  On,
  More,
  Less,
  First,
  Second,
  Third,
  Fourth,
  Save,
  Clipboard,
  Run,
  Help,
  Quit
};

/// One of the four corrections.
struct KeySlider {
  const char* name;   ///< of the option
  const char* title;  ///< what it is for
  double Settings::*field;
  double low, high, step;
  const char* format;
  /// Where nothing is corrected.
  double neutral() const {
    static const Settings kUntouched;
    return kUntouched.*field;
  }
};
inline constexpr int kKeySliders = 4;
extern const KeySlider kSliders[kKeySliders];
/// Within the slider's range, in whole steps, clip-black below clip-white.
void set_slider(Settings& settings, int slider, double value);

inline constexpr int kKeyGrounds = 5;

/// What the window knows.
struct KeyLook {
  Settings settings[2];              ///< A and B
  int slot = 0;                      ///< that is shown
  std::optional<KeyShown> shown[2];  ///< of each; not always of its latest settings
  int frame = 0;                     ///< that is asked for
  KeyState state;
  int ground = 0;
  bool matte = false;    ///< coverage as grey instead of the cut-out
  bool picking = false;  ///< the next click takes the screen's colour
  int slider = 0;        ///< that keys change
  float split = 0.5f;    ///< share of the picture that shows the film
  bool split_given = false;
  float zoom = 1;
  Vec2 center{0.5f, 0.5f};  ///< share of the frame that lies in the middle of the picture
  bool help = false;
  std::string said;
};

class KeyView {
 public:
  explicit KeyView(const Image& background) : background_(background) {}
  /// Draws all of it, and lets the mouse change settings, frame, split and zoom.
  /// Pre: between begin_frame and end_frame, and in a frame of Dear ImGui.
  std::optional<KeyAction> draw(Renderer& renderer, KeyLook& look, float ui);

 private:
  void lay_out(const Renderer& renderer, const KeyLook& look, float ui);
  void follow_subject(KeyLook& look) const;
  void draw_picture(Renderer& renderer, const KeyLook& look, float ui);
  void draw_ground(Renderer& renderer, const KeyLook& look);
  void draw_cut_out(Renderer& renderer, const KeyLook& look);
  void take_mouse(KeyLook& look, float ui);
  void draw_names(const KeyLook& look, float ui) const;
  std::optional<KeyAction> draw_side(KeyLook& look, float ui) const;
  void draw_time(KeyLook& look, float ui) const;
  Vec2 to_film(Vec2 window) const;

  const Image& background_;
  Rect area_{}, side_{}, time_{};  ///< window px
  Vec2 corner_{};                  ///< of the frame, window px
  float scale_ = 1;                ///< window px a film px
  int width_ = 0, height_ = 0;     ///< of the film
  bool dragging_split_ = false, moving_ = false;
  Image cut_;  ///< what is uploaded: premultiplied, or the matte
  KeyWish drawn_{};
  bool drawn_matte_ = false, has_drawn_ = false;
  int drawn_frame_ = -1, drawn_columns_ = -1;
};

}  // namespace vsprite::window
