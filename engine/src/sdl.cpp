// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Window and Audio by SDL2: the one file of the engine that calls it.
#include <SDL.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include "vsprite/window.h"

namespace vsprite {
namespace {

/// False where a Linux machine shows neither a sound card nor a sound server: ALSA would look for
/// one all the same, and complain on stderr line after line.
bool sound_is_likely() {
#ifdef __linux__
  std::error_code ignored;
  if (std::filesystem::exists("/dev/snd", ignored)) return true;
  if (std::getenv("PULSE_SERVER") != nullptr) return true;
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  if (runtime == nullptr) return false;
  return std::filesystem::exists(std::string(runtime) + "/pulse/native", ignored) ||
         std::filesystem::exists(std::string(runtime) + "/pipewire-0", ignored);
#else
  return true;
#endif
}

/// SDL's parts are counted by SDL itself: every window and sound device takes its own.
struct Subsystem {
  Uint32 flags = 0;
  bool start(Uint32 wanted) {
    if (SDL_InitSubSystem(wanted) != 0) return false;
    flags |= wanted;
    return true;
  }
  ~Subsystem() {
    if (flags != 0) SDL_QuitSubSystem(flags);
  }
};

bool steering_key(SDL_Scancode code, Key& key) {
  switch (code) {
    case SDL_SCANCODE_LEFT:
    case SDL_SCANCODE_A:
      key = Key::Left;
      return true;
    case SDL_SCANCODE_RIGHT:
    case SDL_SCANCODE_D:
      key = Key::Right;
      return true;
    case SDL_SCANCODE_UP:
    case SDL_SCANCODE_W:
      key = Key::Up;
      return true;
    case SDL_SCANCODE_DOWN:
    case SDL_SCANCODE_S:
      key = Key::Down;
      return true;
    default:
      return false;
  }
}

int key_code(SDL_Keycode code) {
  if (code > 0 && code < 128) return code;
  if (code == SDLK_KP_ENTER) return kKeyEnter;
  if (code >= SDLK_F1 && code <= SDLK_F12) return kKeyF1 + (code - SDLK_F1);
  return 0;
}

Error no_display(const char* reason) {
  return {ErrorCode::Unavailable, std::string("window: no display could be opened (") + reason +
                                      "): run inside a desktop session, or add --headless"};
}

Error no_opengl(const char* reason) {
  return {ErrorCode::Unavailable,
          std::string("window: OpenGL 3.3 is due, and this display does not offer it (") + reason +
              "): update the graphics driver, or install libgl1-mesa-dri"};
}

}  // namespace

struct Window::Impl {
  Subsystem video, pads;
  SDL_Window* window = nullptr;
  SDL_GLContext context = nullptr;
  WindowConfig config;
  Input input;
  std::vector<SDL_GameController*> controllers;
  bool held_by_arrow[4] = {};  // a direction is held while either of its two keys is
  bool held_by_letter[4] = {};
  bool dpad[4] = {};
  Vec2 stick;
  int width = 0, height = 0;
  float scale = 1;
  bool open = true;
  Uint64 start = 0;

  ~Impl();
  Result<void> make();
  bool make_context(Uint32 flags, int profile, int minor);
  void measure();
  void handle(const SDL_Event& event);
  void handle_key(const SDL_KeyboardEvent& key);
  void handle_window(const SDL_WindowEvent& event);
  void handle_pad_button(const SDL_ControllerButtonEvent& event);
  void release_all();
  void toggle_full_screen() {
    const bool full = (SDL_GetWindowFlags(window) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0;
    SDL_SetWindowFullscreen(window, full ? 0 : Uint32{SDL_WINDOW_FULLSCREEN_DESKTOP});
  }
  void update_stick();
  void point_at(int x, int y) { input.pointer = {float(x) * scale, float(y) * scale}; }
  void close_pad(SDL_JoystickID id);
};

Window::Impl::~Impl() {
  for (SDL_GameController* pad : controllers) SDL_GameControllerClose(pad);
  if (context != nullptr) SDL_GL_DeleteContext(context);
  if (window != nullptr) SDL_DestroyWindow(window);
}

Result<void> Window::Impl::make() {
  if (config.headless) {
    SDL_SetHint(SDL_HINT_VIDEODRIVER, "offscreen");
    SDL_SetHint(SDL_HINT_AUDIODRIVER, "dummy");
  }
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // Ctrl-C ends the program, as everywhere
  SDL_SetHint(SDL_HINT_VIDEO_HIGHDPI_DISABLED, "0");
  if (!video.start(SDL_INIT_VIDEO)) return no_display(SDL_GetError());
  // Where nothing else works SDL draws into memory unasked: a game that nobody can see or close.
  const std::string driver = SDL_GetCurrentVideoDriver();
  const bool unseen = driver == "offscreen" || driver == "dummy" || driver == "evdev";
  if (unseen && !config.headless && SDL_getenv("SDL_VIDEODRIVER") == nullptr) {
    return no_display("neither X11 nor Wayland answers");
  }
  SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
  SDL_GL_SetAttribute(SDL_GL_DEPTH_SIZE, 0);
  Uint32 flags = SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI;
  if (config.full_screen) flags |= SDL_WINDOW_FULLSCREEN_DESKTOP;
  const auto core = [&] { return make_context(flags, SDL_GL_CONTEXT_PROFILE_CORE, 3); };
  const auto es = [&] { return make_context(flags, SDL_GL_CONTEXT_PROFILE_ES, 0); };
  if (!(config.es ? es() : core())) {
    const std::string reason = SDL_GetError();
    if (!(config.es ? core() : es())) return no_opengl(reason.c_str());
  }
  // Adaptive sync where there is one; else plain, else none (software drivers).
  const bool sync = config.vsync && !config.headless;
  if (!sync || SDL_GL_SetSwapInterval(-1) != 0) SDL_GL_SetSwapInterval(sync ? 1 : 0);
  pads.start(SDL_INIT_GAMECONTROLLER);  // a machine without pads is in order
  start = SDL_GetPerformanceCounter();
  measure();
  return {};
}

/// A window and an OpenGL 3.x context of that profile.
bool Window::Impl::make_context(Uint32 flags, int profile, int minor) {
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, profile);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, minor);
  window = SDL_CreateWindow(config.title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                            config.width, config.height, flags);
  if (window != nullptr) context = SDL_GL_CreateContext(window);
  if (context != nullptr) return true;
  if (window != nullptr) SDL_DestroyWindow(window);
  window = nullptr;
  return false;
}

void Window::Impl::measure() {
  int units = 0, ignored = 0;
  SDL_GL_GetDrawableSize(window, &width, &height);
  SDL_GetWindowSize(window, &units, &ignored);
  if (units > 0 && width > 0) scale = static_cast<float>(width) / static_cast<float>(units);
}

void Window::Impl::release_all() {
  input.keys.release_all();
  std::fill_n(held_by_arrow, 4, false);
  std::fill_n(held_by_letter, 4, false);
  input.pointer_held = false;
}

void Window::Impl::handle_key(const SDL_KeyboardEvent& key) {
  const bool down = key.type == SDL_KEYDOWN;
  if (key.repeat != 0) return;
  Key steer{};
  if (steering_key(key.keysym.scancode, steer) &&
      (key.keysym.mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI)) == 0) {
    const bool arrow = key.keysym.sym >= SDLK_RIGHT && key.keysym.sym <= SDLK_UP;
    const int i = static_cast<int>(steer);
    (arrow ? held_by_arrow : held_by_letter)[i] = down;
    input.keys.held[i] = held_by_arrow[i] || held_by_letter[i];
    return;
  }
  const int code = key_code(key.keysym.sym);
  if (!down || code == 0) return;
  if (code == kKeyF11 || (code == kKeyEnter && (key.keysym.mod & KMOD_ALT) != 0)) {
    toggle_full_screen();
    return;
  }
  input.pressed.push_back(code);
}

void Window::Impl::handle_window(const SDL_WindowEvent& event) {
  switch (event.event) {
    case SDL_WINDOWEVENT_FOCUS_LOST:
      release_all();
      input.focused = false;
      break;
    case SDL_WINDOWEVENT_FOCUS_GAINED:
      input.focused = true;
      break;
    case SDL_WINDOWEVENT_CLOSE:
      open = false;
      break;
    default:
      break;
  }
}

void Window::Impl::handle_pad_button(const SDL_ControllerButtonEvent& event) {
  const bool down = event.state == SDL_PRESSED;
  switch (event.button) {
    case SDL_CONTROLLER_BUTTON_DPAD_LEFT:
      dpad[int(Key::Left)] = down;
      break;
    case SDL_CONTROLLER_BUTTON_DPAD_RIGHT:
      dpad[int(Key::Right)] = down;
      break;
    case SDL_CONTROLLER_BUTTON_DPAD_UP:
      dpad[int(Key::Up)] = down;
      break;
    case SDL_CONTROLLER_BUTTON_DPAD_DOWN:
      dpad[int(Key::Down)] = down;
      break;
    case SDL_CONTROLLER_BUTTON_START:
      if (down) input.pressed.push_back('p');
      break;
    case SDL_CONTROLLER_BUTTON_A:
      if (down) input.pressed.push_back(kKeyEnter);
      break;
    default:
      break;
  }
  update_stick();
}

void Window::Impl::update_stick() {
  const int x = int(dpad[int(Key::Right)]) - int(dpad[int(Key::Left)]);
  const int y = int(dpad[int(Key::Down)]) - int(dpad[int(Key::Up)]);
  const Direction pressed = direction_from_axes(x, y);
  input.stick = pressed != Direction::None ? pressed : stick_direction(stick, input.stick);
}

void Window::Impl::close_pad(SDL_JoystickID id) {
  SDL_GameController* pad = SDL_GameControllerFromInstanceID(id);
  if (pad == nullptr) return;
  controllers.erase(std::remove(controllers.begin(), controllers.end(), pad), controllers.end());
  SDL_GameControllerClose(pad);
  stick = {};
  std::fill_n(dpad, 4, false);
  input.stick = Direction::None;
}

void Window::Impl::handle(const SDL_Event& event) {
  constexpr float kFullStick = 32767;
  switch (event.type) {
    case SDL_QUIT:
      open = false;
      break;
    case SDL_KEYDOWN:
    case SDL_KEYUP:
      handle_key(event.key);
      break;
    case SDL_WINDOWEVENT:
      handle_window(event.window);
      break;
    case SDL_MOUSEMOTION:
      point_at(event.motion.x, event.motion.y);
      break;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
      if (event.button.button != SDL_BUTTON_LEFT) break;
      point_at(event.button.x, event.button.y);
      input.pointer_held = event.type == SDL_MOUSEBUTTONDOWN;
      input.pointer_pressed = input.pointer_pressed || input.pointer_held;
      break;
    case SDL_CONTROLLERDEVICEADDED:
      if (SDL_GameController* pad = SDL_GameControllerOpen(event.cdevice.which)) {
        controllers.push_back(pad);
      }
      break;
    case SDL_CONTROLLERDEVICEREMOVED:
      close_pad(event.cdevice.which);
      break;
    case SDL_CONTROLLERBUTTONDOWN:
    case SDL_CONTROLLERBUTTONUP:
      handle_pad_button(event.cbutton);
      break;
    case SDL_CONTROLLERAXISMOTION:
      if (event.caxis.axis == SDL_CONTROLLER_AXIS_LEFTX) stick.x = event.caxis.value / kFullStick;
      if (event.caxis.axis == SDL_CONTROLLER_AXIS_LEFTY) stick.y = event.caxis.value / kFullStick;
      update_stick();
      break;
    default:
      break;
  }
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
  m.input.pressed.clear();
  m.input.pointer_pressed = false;
  SDL_Event event;
  while (SDL_PollEvent(&event) != 0) m.handle(event);
  m.measure();
  return m.open;
}

const Input& Window::input() const noexcept { return impl_->input; }
void Window::swap() { SDL_GL_SwapWindow(impl_->window); }

void Window::toggle_full_screen() { impl_->toggle_full_screen(); }

void Window::set_title(const std::string& title) {
  SDL_SetWindowTitle(impl_->window, title.c_str());
}

int Window::width() const noexcept { return impl_->width; }
int Window::height() const noexcept { return impl_->height; }
float Window::pixel_scale() const noexcept { return impl_->scale; }
bool Window::headless() const noexcept { return impl_->config.headless; }
void* Window::handle() const noexcept { return impl_->window; }

void* Window::gl_function(const char* name) { return SDL_GL_GetProcAddress(name); }

double Window::seconds() const noexcept {
  return static_cast<double>(SDL_GetPerformanceCounter() - impl_->start) /
         static_cast<double>(SDL_GetPerformanceFrequency());
}

struct Audio::Impl {
  Subsystem audio;
  SDL_AudioDeviceID device = 0;
  std::function<void(std::span<float>)> fill;
  ~Impl() {
    if (device != 0) SDL_CloseAudioDevice(device);
  }
  static void call(void* self, Uint8* bytes, int length) {
    const std::size_t count = static_cast<std::size_t>(length) / sizeof(float);
    static_cast<Impl*>(self)->fill({reinterpret_cast<float*>(bytes), count});
  }
};

Audio::Audio() noexcept = default;
Audio::Audio(Audio&&) noexcept = default;
Audio& Audio::operator=(Audio&&) noexcept = default;
Audio::~Audio() = default;

bool Audio::open(std::function<void(std::span<float>)> fill, int rate) {
  impl_.reset();
  auto impl = std::make_unique<Impl>();
  if (!sound_is_likely()) SDL_SetHint(SDL_HINT_AUDIODRIVER, "dummy");
  if (!impl->audio.start(SDL_INIT_AUDIO)) return false;
  impl->fill = std::move(fill);
  SDL_AudioSpec want{};
  want.freq = rate;
  want.format = AUDIO_F32SYS;
  want.channels = 1;
  want.samples = 1024;
  want.callback = &Impl::call;
  want.userdata = impl.get();
  impl->device = SDL_OpenAudioDevice(nullptr, 0, &want, nullptr, 0);
  if (impl->device == 0) return false;
  SDL_PauseAudioDevice(impl->device, 0);
  impl_ = std::move(impl);
  return true;
}

bool Audio::is_open() const noexcept { return impl_ != nullptr; }

}  // namespace vsprite
