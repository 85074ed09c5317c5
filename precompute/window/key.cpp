// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The loop of the key window: keys and mouse change one of two settings, whose frame is keyed anew.
#include "window/key.h"

#include <SDL_clipboard.h>
#include <SDL_keycode.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "tool/files.h"
#include "vsprite/draw.h"
#include "vsprite/record.h"
#include "vsprite/sdl.h"
#include "window/key_view.h"
#include "window/overlay.h"

namespace vsprite {
namespace {

using window::KeyAction;
using window::KeyLook;
using window::KeyShown;
using window::KeyWish;

std::optional<KeyAction> action_of(int key) {
  switch (key) {
    case SDLK_TAB:
      return KeyAction::Other;
    case SDLK_x:
      return KeyAction::Copy;
    case SDLK_e:
      return KeyAction::Pick;
    case SDLK_u:
      return KeyAction::Measure;
    case SDLK_r:
      return KeyAction::Reset;
    case SDLK_g:
      return KeyAction::Ground;
    case SDLK_m:
      return KeyAction::Matte;
    case SDLK_LEFT:
      return KeyAction::Back;
    case SDLK_RIGHT:
      return KeyAction::On;
    case SDLK_UP:
      return KeyAction::More;
    case SDLK_DOWN:
      return KeyAction::Less;
    case SDLK_1:
      return KeyAction::First;
    case SDLK_2:
      return KeyAction::Second;
    case SDLK_3:
      return KeyAction::Third;
    case SDLK_4:
      return KeyAction::Fourth;
    case SDLK_s:
      return KeyAction::Save;
    case SDLK_c:
      return KeyAction::Clipboard;
    case SDLK_RETURN:
    case SDLK_KP_ENTER:
      return KeyAction::Run;
    case SDLK_F1:
      return KeyAction::Help;
    case SDLK_ESCAPE:
      return KeyAction::Quit;
    default:
      return std::nullopt;
  }
}

class Keying : public window::Scene {
 public:
  Keying(const Settings& settings, const KeyWindowOptions& options)
      : options_(options), view_(options.background), job_(source_of(settings, settings.film)) {
    look_.settings[0] = look_.settings[1] = settings;
  }

  bool is_closed() const override { return closed_ || look_.state.error.has_value(); }
  Result<void> press(int key) override {
    if (const auto action = action_of(key)) act(*action);
    return {};
  }
  void draw(Renderer& renderer, double passed, float ui_scale) override;
  Result<void> act_on_click() override {
    if (clicked_) act(*clicked_);
    return {};
  }

  KeyChoice choice() const { return {look_.settings[look_.slot], runs_}; }
  const std::optional<Error>& error() const { return look_.state.error; }

 private:
  void act(KeyAction action);
  void step(int by);
  void save();
  void follow_job();
  KeyWish wish_of(int slot) const;

  const KeyWindowOptions& options_;
  window::KeyView view_;
  window::KeyJob job_;
  KeyLook look_;
  std::optional<KeyWish> asked_;
  int asked_slot_ = 0;
  std::optional<KeyAction> clicked_;
  bool has_frame_ = false;  ///< the first one was chosen
  bool closed_ = false, runs_ = false;
};

KeyWish Keying::wish_of(int slot) const {
  const Settings& settings = look_.settings[slot];
  return {look_.frame, settings.key, *matte_of(settings)};
}

void Keying::step(int by) {
  look_.frame = std::clamp(look_.frame + by, 0, std::max(look_.state.film_frames - 1, 0));
}

void Keying::save() {
  const auto& shown = look_.shown[look_.slot];
  if (!shown || !shown->is_final || shown->wish != wish_of(look_.slot) ||
      shown->keyed.straight.rgba.empty()) {
    look_.said = "There is nothing to save yet.";
    return;
  }
  // The whole frame, so that it lies where it lay in the film.
  const KeyedFrame& keyed = shown->keyed;
  Image whole{shown->film.width, shown->film.height,
              std::vector<std::uint8_t>(shown->film.rgba.size())};
  for (int y = 0; y < keyed.crop.height; ++y)
    std::copy_n(ImageView(keyed.straight).pixel(0, y), 4 * keyed.crop.width,
                whole.rgba.data() + 4 * ((keyed.crop.y + y) * whole.width + keyed.crop.x));
  const std::string path = std::filesystem::path(look_.settings[0].film).stem().string() + "." +
                           std::to_string(keyed.index) + ".png";
  const auto wrote = save_png(path, whole);
  look_.said = wrote ? "Saved: " + path : "Not saved: " + wrote.error().message;
  if (wrote && options_.saved)
    options_.saved("saved: " + path + "; " + key_command(look_.settings[look_.slot]));
}

void Keying::act(KeyAction action) {
  Settings& settings = look_.settings[look_.slot];
  look_.said.clear();
  switch (action) {
    case KeyAction::Other:
      look_.slot = 1 - look_.slot;
      break;
    case KeyAction::Copy:
      look_.settings[1 - look_.slot] = settings;
      look_.said = std::string("Copied to ") + "AB"[1 - look_.slot] + ".";
      break;
    case KeyAction::Pick:
      look_.picking = !look_.picking;
      break;
    case KeyAction::Measure:
      look_.picking = false;
      settings.key = "auto";
      break;
    case KeyAction::Reset:
      for (const window::KeySlider& slider : window::kSliders)
        settings.*slider.field = slider.neutral();
      break;
    case KeyAction::Ground:
      look_.matte = false;
      look_.ground = (look_.ground + 1) % window::kKeyGrounds;
      break;
    case KeyAction::Matte:
      look_.matte = !look_.matte;
      break;
    case KeyAction::Back:
    case KeyAction::On:
      step(action == KeyAction::On ? 1 : -1);
      break;
    case KeyAction::More:
    case KeyAction::Less: {
      const window::KeySlider& slider = window::kSliders[look_.slider];
      window::set_slider(
          settings, look_.slider,
          settings.*slider.field + (action == KeyAction::More ? slider.step : -slider.step));
      break;
    }
    case KeyAction::First:
    case KeyAction::Second:
    case KeyAction::Third:
    case KeyAction::Fourth:
      look_.slider = static_cast<int>(action) - static_cast<int>(KeyAction::First);
      break;
    case KeyAction::Save:
      save();
      break;
    case KeyAction::Clipboard:
      look_.said = SDL_SetClipboardText(key_command(settings).c_str()) == 0 ? "Copied."
                                                                            : "Cannot be copied.";
      break;
    case KeyAction::Run:
      runs_ = closed_ = true;
      break;
    case KeyAction::Help:
      look_.help = !look_.help;
      break;
    case KeyAction::Quit:
      closed_ = !look_.picking;
      look_.picking = false;
      break;
  }
}

// The one that is looked at first, then the other, so that changing over shows it at once.
void Keying::follow_job() {
  look_.state = job_.state();
  if (!has_frame_ && !look_.state.frames.empty()) {
    look_.frame = look_.state.frames[look_.state.frames.size() / 2];
    has_frame_ = true;
  }
  if (!has_frame_) return;
  if (auto shown = job_.take()) {
    if (shown->is_final) asked_.reset();
    look_.shown[asked_slot_] = std::move(shown);
  }
  for (const int slot : {look_.slot, 1 - look_.slot}) {
    const KeyWish wish = wish_of(slot);
    const auto& shown = look_.shown[slot];
    if (shown && shown->wish == wish && shown->is_final) continue;
    const auto& other = look_.shown[1 - slot];
    if (other && other->wish == wish && other->is_final) {
      look_.shown[slot] = other;
      continue;
    }
    if (asked_ && *asked_ == wish) return;
    // What was begun for the other one is given up only for what is looked at.
    if (asked_ && slot != look_.slot) return;
    asked_ = wish;
    asked_slot_ = slot;
    job_.ask(wish);
    return;
  }
}

void Keying::draw(Renderer& renderer, double, float ui_scale) {
  follow_job();
  if (options_.headless) {
    job_.wait();
    follow_job();
  }
  clicked_ = view_.draw(renderer, look_, ui_scale);
}

}  // namespace

std::string key_command(const Settings& settings) {
  // Without what only the window has.
  const Settings defaults;
  Settings cut = settings;
  cut.background = defaults.background;
  cut.frames = defaults.frames;
  cut.headless = defaults.headless;
  cut.record = defaults.record;
  return "vsprite segment " + shell_word(settings.film) + options_text(cut, "segment");
}

Result<KeyChoice> key_window(const Settings& settings, const KeyWindowOptions& options) {
  if (const auto matte = matte_of(settings); !matte) return matte.error();
  auto window = Window::open({.title = "vsprite segment",
                              .width = options.width,
                              .height = options.height,
                              .headless = options.headless});
  if (!window)
    return Error{window.error().code,
                 window.error().message + "; or look at --preview N, which needs no window"};
  auto renderer = make_renderer(Window::gl_function);
  if (!renderer) return renderer.error();
  Keying keying(settings, options);
  if (auto shown = window::run_scene(*window, *renderer, keying,
                                     {options.headless, options.frames, options.screenshot});
      !shown)
    return shown.error();
  if (keying.error()) return *keying.error();
  return keying.choice();
}

}  // namespace vsprite
