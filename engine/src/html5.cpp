// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Window and Audio in a browser, by Emscripten's html5.h: WebGL 2 in the page's element #canvas.
// The game's loop stays a loop: swap() gives the page back to the browser until its next frame
// (-sASYNCIFY).
#include <emscripten.h>
#include <emscripten/html5.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "vsprite/window.h"

// clang-format off
extern "C" {
// Frames come at the display's rate, and none while the page is hidden.
EM_ASYNC_JS(void, vsprite_next_frame, (), {
  await new Promise(requestAnimationFrame);
  ++vsprite.frames;
});

// Browsers keep quiet until the player has touched something.
EM_JS(int, vsprite_open_sound, (int rate, void* self), {
  const Context = window.AudioContext || window.webkitAudioContext;
  if (!Context) return 0;
  const count = 1024;
  const samples = _malloc(4 * count);
  const context = new Context({sampleRate: rate});
  const node = context.createScriptProcessor(count, 0, 1);
  node.onaudioprocess = event => {
    _vsprite_fill_sound(self, samples, count);
    event.outputBuffer.getChannelData(0).set(
        HEAPF32.subarray(samples >> 2, (samples >> 2) + count));
  };
  node.connect(context.destination);
  const wake = () => context.resume();
  for (const kind of ["keydown", "pointerdown", "touchend"]) addEventListener(kind, wake);
  Module.vspriteSound = {context, node, samples, wake};
  return 1;
});
EM_JS(void, vsprite_close_sound, (), {
  const {context, node, samples, wake} = Module.vspriteSound;
  for (const kind of ["keydown", "pointerdown", "touchend"]) removeEventListener(kind, wake);
  node.disconnect();
  context.close();
  _free(samples);
});
}
// clang-format on

namespace vsprite {
namespace {

constexpr const char* kCanvas = "#canvas";
constexpr double kMostDensity = 2;  // finer than two pixels a CSS pixel nobody sees, but all pay

struct SteeringKey {
  const char* code;  // place on the keyboard: W A S D lie together on every layout
  Key key;
  bool arrow;
};
constexpr SteeringKey kSteering[] = {
    {"ArrowLeft", Key::Left, true}, {"ArrowRight", Key::Right, true}, {"ArrowUp", Key::Up, true},
    {"ArrowDown", Key::Down, true}, {"KeyA", Key::Left, false},       {"KeyD", Key::Right, false},
    {"KeyW", Key::Up, false},       {"KeyS", Key::Down, false}};

/// KeyCode of the browser's name, 0 if it is none of ours.
int key_code(const char* name) {
  if (name[0] != 0 && name[1] == 0) {
    const char c = name[0];
    return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c;
  }
  if (std::strcmp(name, "Enter") == 0) return kKeyEnter;
  if (std::strcmp(name, "Escape") == 0) return kKeyEscape;
  if (std::strcmp(name, "F1") == 0) return kKeyF1;
  return 0;
}

}  // namespace

struct Window::Impl {
  WindowConfig config;
  EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = 0;
  Input input, shown;  // as events come, and as pump() handed it out
  bool held_by_arrow[4] = {};
  bool held_by_letter[4] = {};
  std::uint64_t pad_buttons = 0;
  int finger = -1;  // that leads
  int width = 0, height = 0;
  float scale = 1;
  double start = 0;

  ~Impl();
  Result<void> make();
  void listen(bool on);
  void measure();
  bool handle_key(int type, const EmscriptenKeyboardEvent& key);
  bool handle_mouse(int type, const EmscriptenMouseEvent& mouse);
  bool handle_touch(int type, const EmscriptenTouchEvent& touch);
  void handle_focus(bool gained);
  void sample_pads();
  void point_at(double x, double y) {
    input.pointer = {static_cast<float>(x) * scale, static_cast<float>(y) * scale};
  }
  void press(bool down) {
    input.pointer_held = down;
    input.pointer_pressed = input.pointer_pressed || down;
  }
};

Window::Impl::~Impl() {
  if (context == 0) return;
  listen(false);
  emscripten_webgl_destroy_context(context);
}

Result<void> Window::Impl::make() {
  EmscriptenWebGLContextAttributes wanted;
  emscripten_webgl_init_context_attributes(&wanted);
  wanted.majorVersion = 2;
  wanted.alpha = wanted.depth = wanted.stencil = wanted.antialias = false;
  wanted.enableExtensionsByDefault = true;  // half floats to draw into
  context = emscripten_webgl_create_context(kCanvas, &wanted);
  if (context <= 0) {
    context = 0;
    return Error{
        ErrorCode::Unavailable,
        "window: WebGL 2 is due, and this browser does not offer it: update the browser, or "
        "turn on hardware acceleration in its settings"};
  }
  emscripten_webgl_make_context_current(context);
  listen(true);
  emscripten_set_window_title(config.title.c_str());
  start = emscripten_get_now();
  measure();
  return {};
}

void Window::Impl::listen(bool on) {
  const auto key = [](int type, const EmscriptenKeyboardEvent* event, void* self) -> EM_BOOL {
    return static_cast<Impl*>(self)->handle_key(type, *event);
  };
  const auto mouse = [](int type, const EmscriptenMouseEvent* event, void* self) -> EM_BOOL {
    return static_cast<Impl*>(self)->handle_mouse(type, *event);
  };
  const auto touch = [](int type, const EmscriptenTouchEvent* event, void* self) -> EM_BOOL {
    return static_cast<Impl*>(self)->handle_touch(type, *event);
  };
  const auto focus = [](int type, const EmscriptenFocusEvent*, void* self) -> EM_BOOL {
    static_cast<Impl*>(self)->handle_focus(type == EMSCRIPTEN_EVENT_FOCUS);
    return false;
  };
  const auto hidden = [](int, const EmscriptenVisibilityChangeEvent* event, void* self) -> EM_BOOL {
    if (event->hidden) static_cast<Impl*>(self)->handle_focus(false);
    return false;
  };
  const char* const kWindow = EMSCRIPTEN_EVENT_TARGET_WINDOW;
  const em_key_callback_func on_key = on ? +key : nullptr;
  const em_mouse_callback_func on_mouse = on ? +mouse : nullptr;
  const em_touch_callback_func on_touch = on ? +touch : nullptr;
  const em_focus_callback_func on_focus = on ? +focus : nullptr;
  const em_visibilitychange_callback_func on_hidden = on ? +hidden : nullptr;
  emscripten_set_keydown_callback(kWindow, this, false, on_key);
  emscripten_set_keyup_callback(kWindow, this, false, on_key);
  emscripten_set_mousedown_callback(kCanvas, this, false, on_mouse);
  emscripten_set_mousemove_callback(kWindow, this, false, on_mouse);
  emscripten_set_mouseup_callback(kWindow, this, false, on_mouse);
  emscripten_set_touchstart_callback(kCanvas, this, false, on_touch);
  emscripten_set_touchmove_callback(kCanvas, this, false, on_touch);
  emscripten_set_touchend_callback(kCanvas, this, false, on_touch);
  emscripten_set_touchcancel_callback(kCanvas, this, false, on_touch);
  emscripten_set_focus_callback(kWindow, this, false, on_focus);
  emscripten_set_blur_callback(kWindow, this, false, on_focus);
  emscripten_set_visibilitychange_callback(this, false, on_hidden);
}

/// The canvas has as many pixels as it covers on the display.
void Window::Impl::measure() {
  double across = 0, down = 0;
  emscripten_get_element_css_size(kCanvas, &across, &down);
  const double density = std::min(emscripten_get_device_pixel_ratio(), kMostDensity);
  scale = static_cast<float>(density);
  const auto w = static_cast<int>(std::lround(across * density));
  const auto h = static_cast<int>(std::lround(down * density));
  if (w == width && h == height) return;
  width = w;
  height = h;
  emscripten_set_canvas_element_size(kCanvas, w, h);
}

bool Window::Impl::handle_key(int type, const EmscriptenKeyboardEvent& key) {
  const bool down = type == EMSCRIPTEN_EVENT_KEYDOWN;
  const bool chord = key.ctrlKey || key.altKey || key.metaKey;
  for (const SteeringKey& steer : kSteering) {
    if (std::strcmp(steer.code, key.code) != 0 || (chord && down)) continue;
    const int i = static_cast<int>(steer.key);
    (steer.arrow ? held_by_arrow : held_by_letter)[i] = down;
    input.keys.held[i] = held_by_arrow[i] || held_by_letter[i];
    return true;
  }
  const int code = chord ? 0 : key_code(key.key);
  if (code == 0) return false;  // the browser's own: F5, F11, Ctrl+W
  if (down && !key.repeat) input.pressed.push_back(code);
  return true;
}

bool Window::Impl::handle_mouse(int type, const EmscriptenMouseEvent& mouse) {
  point_at(mouse.targetX, mouse.targetY);
  if (type == EMSCRIPTEN_EVENT_MOUSEMOVE || mouse.button != 0) return false;
  press(type == EMSCRIPTEN_EVENT_MOUSEDOWN);
  return false;  // a click still gives the page the focus
}

bool Window::Impl::handle_touch(int type, const EmscriptenTouchEvent& touch) {
  const bool starts = type == EMSCRIPTEN_EVENT_TOUCHSTART;
  const bool moves = type == EMSCRIPTEN_EVENT_TOUCHMOVE;
  for (int i = 0; i < touch.numTouches; ++i) {
    const EmscriptenTouchPoint& point = touch.touches[i];
    if (!point.isChanged) continue;
    const auto id = static_cast<int>(point.identifier);
    if (starts && finger < 0) {
      finger = id;
      press(true);
    }
    if (finger != id) continue;
    point_at(point.targetX, point.targetY);
    if (starts || moves) continue;
    finger = -1;
    press(false);
  }
  return true;  // no scrolling, no zoom, no mouse events after it
}

void Window::Impl::handle_focus(bool gained) {
  input.focused = gained;
  if (gained) return;
  input.keys.release_all();
  std::fill_n(held_by_arrow, 4, false);
  std::fill_n(held_by_letter, 4, false);
  input.pointer_held = false;
  finger = -1;
}

/// Pads have no events in a browser: what the first one of the standard layout holds now.
void Window::Impl::sample_pads() {
  enum { kPadA = 0, kPadStart = 9, kPadUp = 12, kPadDown, kPadLeft, kPadRight };
  EmscriptenGamepadEvent pad{};
  bool found = false;
  if (emscripten_sample_gamepad_data() == EMSCRIPTEN_RESULT_SUCCESS) {
    for (int i = 0; i < emscripten_get_num_gamepads() && !found; ++i) {
      found = emscripten_get_gamepad_status(i, &pad) == EMSCRIPTEN_RESULT_SUCCESS &&
              pad.connected && std::strcmp(pad.mapping, "standard") == 0;
    }
  }
  if (!found) {
    input.stick = Direction::None;
    pad_buttons = 0;
    return;
  }
  std::uint64_t held = 0;
  for (int i = 0; i < std::min(pad.numButtons, 64); ++i) {
    if (pad.digitalButton[i]) held |= std::uint64_t{1} << i;
  }
  const auto holds = [&](int button) { return static_cast<int>(held >> button & 1u); };
  const Direction pressed =
      direction_from_axes(holds(kPadRight) - holds(kPadLeft), holds(kPadDown) - holds(kPadUp));
  const Vec2 stick{static_cast<float>(pad.axis[0]), static_cast<float>(pad.axis[1])};
  input.stick = pressed != Direction::None ? pressed : stick_direction(stick, input.stick);
  const std::uint64_t fresh = held & ~std::exchange(pad_buttons, held);
  if ((fresh >> kPadA & 1u) != 0) input.pressed.push_back(kKeyEnter);
  if ((fresh >> kPadStart & 1u) != 0) input.pressed.push_back('p');
}

Result<Window> Window::open(const WindowConfig& config) {
  auto impl = std::make_unique<Impl>();
  impl->config = config;
  if (auto made = impl->make(); !made) return std::move(made).error();
  return Window(std::move(impl));
}

Window::Window(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

bool Window::pump() {
  Impl& m = *impl_;
  m.sample_pads();
  m.measure();
  m.shown = m.input;
  m.input.pressed.clear();
  m.input.pointer_pressed = false;
  return !emscripten_is_webgl_context_lost(m.context);
}

const Input& Window::input() const noexcept { return impl_->shown; }

void Window::swap() {
  if (!impl_->config.headless) vsprite_next_frame();
}

void Window::toggle_full_screen() {
  EmscriptenFullscreenChangeEvent status{};
  emscripten_get_fullscreen_status(&status);
  if (status.isFullscreen) {
    emscripten_exit_fullscreen();
  } else {
    emscripten_request_fullscreen(kCanvas, true);
  }
}

void Window::set_title(const std::string& title) { emscripten_set_window_title(title.c_str()); }

int Window::width() const noexcept { return impl_->width; }
int Window::height() const noexcept { return impl_->height; }
float Window::pixel_scale() const noexcept { return impl_->scale; }
bool Window::headless() const noexcept { return impl_->config.headless; }
void* Window::handle() const noexcept { return nullptr; }
void* Window::gl_function(const char* name) { return emscripten_webgl_get_proc_address(name); }
double Window::seconds() const noexcept { return (emscripten_get_now() - impl_->start) / 1000; }

struct Audio::Impl {
  std::function<void(std::span<float>)> fill;
  bool open = false;
  ~Impl() {
    if (open) vsprite_close_sound();
  }
};

Audio::Audio() noexcept = default;
Audio::Audio(Audio&&) noexcept = default;
Audio& Audio::operator=(Audio&&) noexcept = default;
Audio::~Audio() = default;

bool Audio::open(std::function<void(std::span<float>)> fill, int rate) {
  impl_.reset();
  auto impl = std::make_unique<Impl>();
  impl->fill = std::move(fill);
  impl->open = vsprite_open_sound(rate, &impl->fill) != 0;
  if (!impl->open) return false;
  impl_ = std::move(impl);
  return true;
}

bool Audio::is_open() const noexcept { return impl_ != nullptr; }

}  // namespace vsprite

extern "C" EMSCRIPTEN_KEEPALIVE void vsprite_fill_sound(void* self, float* samples, int count) {
  (*static_cast<std::function<void(std::span<float>)>*>(self))(
      {samples, static_cast<std::size_t>(count)});
}
