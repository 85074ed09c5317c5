// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "window/overlay.h"

#include <SDL.h>
#include <SDL_opengl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>
#include <imgui_impl_sdl.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "vsprite/record.h"

namespace vsprite::window {
namespace {

constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/TTF/DejaVuSans.ttf"};

void set_style(float scale) {
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

}  // namespace

Overlay::Overlay(Window& window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // writes no file of its own
  const float scale = ui_scale(window);
  std::error_code ignored;
  for (const char* font : kFonts)
    if (io.Fonts->Fonts.empty() && std::filesystem::exists(font, ignored))
      io.Fonts->AddFontFromFileTTF(font, 17 * scale);
  set_style(scale);
  ImGui_ImplSDL2_InitForOpenGL(sdl_window(window), SDL_GL_GetCurrentContext());
  ImGui_ImplOpenGL3_Init();
  SDL_AddEventWatch(&Overlay::watch, this);
}

Overlay::~Overlay() {
  SDL_DelEventWatch(&Overlay::watch, this);
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplSDL2_Shutdown();
  ImGui::DestroyContext();
}

float Overlay::ui_scale(const Window& window) {
  const float fits = std::min(static_cast<float>(window.height()) / 760,
                              static_cast<float>(window.width()) / 1280);
  return std::clamp(std::max(fits, window.pixel_scale()), 0.75f, 3.0f);
}

void Overlay::begin() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplSDL2_NewFrame();
  ImGui::NewFrame();
}

void Overlay::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

int Overlay::watch(void* self, SDL_Event* event) {
  ImGui_ImplSDL2_ProcessEvent(event);
  if (event->type == SDL_KEYDOWN && event->key.repeat == 0)
    static_cast<Overlay*>(self)->keys_.push_back(event->key.keysym.sym);
  return 0;
}

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

Result<void> run_scene(Window& window, Renderer& renderer, Scene& scene,
                       const LoopOptions& options) {
  constexpr double kShortestFrame = 1.0 / 61;
  Overlay overlay(window);
  double last = window.seconds();
  for (int drawn = 0; window.pump() && !scene.is_closed(); ++drawn) {
    if (options.frames > 0 && drawn >= options.frames) break;
    for (const int key : overlay.take_keys())
      if (auto done = scene.press(key); !done) return done;
    const double now = window.seconds();
    const double passed = options.headless ? 1.0 / 60 : std::min(now - last, 0.1);
    last = now;
    renderer.begin_frame(window.width(), window.height());
    overlay.begin();
    scene.draw(renderer, passed, Overlay::ui_scale(window));
    renderer.end_frame(window.width(), window.height());
    overlay.end();
    const bool last_picture = options.frames > 0 && drawn + 1 == options.frames;
    if (last_picture && !options.screenshot.empty())
      if (auto saved = save_window(window, options.screenshot); !saved) return saved;
    window.swap();
    if (auto done = scene.act_on_click(); !done) return done;
    const double spent = window.seconds() - now;
    if (!options.headless && spent < kShortestFrame)
      std::this_thread::sleep_for(std::chrono::duration<double>(kShortestFrame - spent));
  }
  return {};
}

}  // namespace vsprite::window
