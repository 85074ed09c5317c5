// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The loop of the label window: keys become actions, an action is done before anything is drawn.
#include "window/label.h"

#include <SDL.h>
#include <SDL_opengl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>
#include <imgui_impl_sdl.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

#include "vsprite/draw.h"
#include "vsprite/record.h"
#include "vsprite/sdl.h"
#include "window/label_view.h"

namespace vsprite {
namespace {

using window::LabelAction;
using window::LabelKeys;
using window::LabelLook;

constexpr double kShortestFrame = 1.0 / 61;
constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/TTF/DejaVuSans.ttf"};

/// Dear ImGui over a window of ours. It sees the events that the window takes, and hands on the
/// keys in the order in which they were pressed.
class Overlay {
 public:
  explicit Overlay(Window& window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // writes no file of its own
    const float scale = ui_scale(window);
    std::error_code ignored;
    for (const char* font : kFonts)
      if (io.Fonts->Fonts.empty() && std::filesystem::exists(font, ignored))
        io.Fonts->AddFontFromFileTTF(font, 17 * scale);
    style(scale);
    ImGui_ImplSDL2_InitForOpenGL(sdl_window(window), SDL_GL_GetCurrentContext());
    ImGui_ImplOpenGL3_Init();
    SDL_AddEventWatch(&Overlay::watch, this);
  }
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;
  ~Overlay() {
    SDL_DelEventWatch(&Overlay::watch, this);
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplSDL2_Shutdown();
    ImGui::DestroyContext();
  }

  static float ui_scale(const Window& window) {
    const float fits = std::min(static_cast<float>(window.height()) / 760,
                                static_cast<float>(window.width()) / 1280);
    return std::clamp(std::max(fits, window.pixel_scale()), 0.75f, 3.0f);
  }
  void begin() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplSDL2_NewFrame();
    ImGui::NewFrame();
  }
  void end() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }
  std::vector<int> take_keys() { return std::exchange(keys_, {}); }

 private:
  static int watch(void* self, SDL_Event* event) {
    ImGui_ImplSDL2_ProcessEvent(event);
    if (event->type == SDL_KEYDOWN && event->key.repeat == 0)
      static_cast<Overlay*>(self)->keys_.push_back(event->key.keysym.sym);
    return 0;
  }
  static void style(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& s = ImGui::GetStyle();
    s.WindowRounding = 0;
    s.WindowBorderSize = 0;
    s.FrameRounding = 6;
    s.GrabRounding = 5;
    s.WindowPadding = {16, 16};
    s.FramePadding = {10, 6};
    s.ItemSpacing = {8, 8};
    s.Colors[ImGuiCol_WindowBg] = {0.137f, 0.172f, 0.196f, 1};
    s.Colors[ImGuiCol_FrameBg] = {0.09f, 0.117f, 0.137f, 1};
    s.Colors[ImGuiCol_FrameBgHovered] = {0.12f, 0.15f, 0.17f, 1};
    s.Colors[ImGuiCol_SliderGrab] = {0.36f, 0.62f, 0.74f, 1};
    s.ScaleAllSizes(scale);
  }

  std::vector<int> keys_;
};

/// What the window shows, words and all.
Result<void> save_window(const Window& window, const std::string& path) {
  Image picture{window.width(), window.height(), {}};
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(picture.width);
  picture.rgba.resize(row * static_cast<std::size_t>(picture.height));
  const auto read_pixels =
      reinterpret_cast<decltype(&glReadPixels)>(Window::gl_function("glReadPixels"));
  read_pixels(0, 0, picture.width, picture.height, GL_RGBA, GL_UNSIGNED_BYTE, picture.rgba.data());
  for (std::size_t a = 0, b = static_cast<std::size_t>(picture.height); a + 1 < b--; ++a)
    std::swap_ranges(picture.rgba.begin() + static_cast<std::ptrdiff_t>(a * row),
                     picture.rgba.begin() + static_cast<std::ptrdiff_t>((a + 1) * row),
                     picture.rgba.begin() + static_cast<std::ptrdiff_t>(b * row));
  for (std::size_t at = 3; at < picture.rgba.size(); at += 4) picture.rgba[at] = 255;
  return save_png(path, picture);
}

class Sitting {
 public:
  Sitting(LabelSession& session, LabelKeys keys, const LabelWindowOptions& options)
      : session_(session), keys_(keys), options_(options), view_(session) {}

  Result<void> run(Window& window, Renderer& renderer);

 private:
  Result<void> act(LabelAction action);
  Result<void> answer(bool smooth);
  Result<void> step_back(bool undo);

  LabelSession& session_;
  LabelKeys keys_;
  const LabelWindowOptions& options_;
  window::LabelView view_;
  LabelLook look_;
  bool closed_ = false;
};

Result<void> Sitting::answer(bool smooth) {
  if (!session_.current()) return {};
  const auto pair = *session_.current();
  if (auto kept = session_.answer(smooth); !kept) return kept;
  const std::string what = std::to_string(pair.i) + "," + std::to_string(pair.j) +
                           (smooth ? " smooth" : " visible jump");
  if (options_.kept) options_.kept(what);
  look_.said = "Saved: " + std::string(smooth ? "smooth" : "a visible jump") + ".";
  return view_.show();
}

Result<void> Sitting::step_back(bool undo) {
  const auto done = undo ? session_.undo() : session_.redo();
  if (!done) return done.error();
  look_.said = *done ? (undo ? "Taken back." : "Given again.")
                     : (undo ? "There is nothing to undo." : "There is nothing to redo.");
  return *done ? view_.show() : Result<void>();
}

Result<void> Sitting::act(LabelAction action) {
  const bool guess = session_.current() && session_.current()->guess_smooth();
  switch (action) {
    case LabelAction::Accept:
      return answer(guess);
    case LabelAction::Flip:
      return answer(!guess);
    case LabelAction::Undo:
    case LabelAction::Redo:
      return step_back(action == LabelAction::Undo);
    case LabelAction::Skip:
      session_.skip();
      look_.said = "Passed over.";
      return view_.show();
    case LabelAction::Slower:
    case LabelAction::Faster: {
      const float by = action == LabelAction::Faster ? 1.25f : 0.8f;
      look_.speed = std::clamp(look_.speed * by, window::kSlowest, window::kFastest);
      return {};
    }
    case LabelAction::Background:
      look_.ground = (look_.ground + 1) % window::kLabelGrounds;
      return {};
    case LabelAction::Help:
      look_.help = !look_.help;
      return {};
    case LabelAction::Quit:
      closed_ = true;
      return {};
  }
  return {};
}

Result<void> Sitting::run(Window& window, Renderer& renderer) {
  Overlay overlay(window);
  if (auto shown = view_.show(); !shown) return shown;
  double last = window.seconds();
  for (int drawn = 0; window.pump() && !closed_; ++drawn) {
    if (options_.frames > 0 && drawn >= options_.frames) break;
    for (const int key : overlay.take_keys())
      if (const auto action = keys_.action_of(key))
        if (auto done = act(*action); !done) return done;
    const double now = window.seconds();
    const double passed = options_.headless ? 1.0 / 60 : std::min(now - last, 0.1);
    last = now;
    renderer.begin_frame(window.width(), window.height());
    overlay.begin();
    const auto clicked = view_.draw(renderer, keys_, look_, passed, Overlay::ui_scale(window));
    renderer.end_frame(window.width(), window.height());
    overlay.end();
    const bool last_picture = options_.frames > 0 && drawn + 1 == options_.frames;
    if (last_picture && !options_.screenshot.empty())
      if (auto saved = save_window(window, options_.screenshot); !saved) return saved;
    window.swap();
    if (clicked)
      if (auto done = act(*clicked); !done) return done;
    const double spent = window.seconds() - now;
    if (!options_.headless && spent < kShortestFrame)
      std::this_thread::sleep_for(std::chrono::duration<double>(kShortestFrame - spent));
  }
  return {};
}

}  // namespace

Result<void> label_window(LabelSession& session, const LabelWindowOptions& options) {
  auto keys = LabelKeys::parse(options.bind);
  if (!keys) return keys.error();
  auto window = Window::open({.title = "vsprite label",
                              .width = options.width,
                              .height = options.height,
                              .headless = options.headless});
  if (!window)
    return Error{window.error().code,
                 window.error().message + "; or give the answers without one: --answers FILE"};
  auto renderer = make_renderer(Window::gl_function);
  if (!renderer) return renderer.error();
  return Sitting(session, *keys, options).run(*window, *renderer);
}

}  // namespace vsprite
