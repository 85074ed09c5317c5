// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include <SDL.h>
#include <gtest/gtest.h>

#include <optional>

#include "support/gl_stage.h"
#include "vsprite/compose.h"
#include "vsprite/draw.h"
#include "vsprite/window.h"

namespace vsprite {
namespace {

TEST(Stick, IsNothingInTheDeadZone) {
  EXPECT_EQ(stick_direction({0.24f, 0}, Direction::None), Direction::None);
  EXPECT_EQ(stick_direction({0.17f, 0.17f}, Direction::None), Direction::None);
  EXPECT_EQ(stick_direction({0.26f, 0}, Direction::None), Direction::Right);
  EXPECT_EQ(stick_direction({0.22f, 0}, Direction::Right), Direction::Right);  // not yet let go
  EXPECT_EQ(stick_direction({0.19f, 0}, Direction::Right), Direction::None);
}

TEST(Stick, HasEightSectorsAndKeepsOneAFewDegreesPastItsBorder) {
  // tan 22.5 degrees = 0.414; tan 27.5 = 0.521
  EXPECT_EQ(stick_direction({1, 0.40f}, Direction::None), Direction::Right);
  EXPECT_EQ(stick_direction({1, 0.43f}, Direction::None), Direction::RightDown);
  EXPECT_EQ(stick_direction({1, 0.50f}, Direction::Right), Direction::Right);
  EXPECT_EQ(stick_direction({1, 0.54f}, Direction::Right), Direction::RightDown);
  EXPECT_EQ(stick_direction({-0.7f, -0.7f}, Direction::Right), Direction::LeftUp);
}

class WindowTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Result<Window> window = Window::open({.width = 320, .height = 240, .headless = true});
    if (!window) GTEST_SKIP() << window.error().message;
    window_.emplace(std::move(*window));
    window_->pump();
  }
  void send_key(SDL_Scancode code, bool down, bool repeat = false) {
    SDL_Event event{};
    event.type = down ? SDL_KEYDOWN : SDL_KEYUP;
    event.key.repeat = repeat;
    event.key.keysym.scancode = code;
    event.key.keysym.sym = SDL_GetKeyFromScancode(code);
    SDL_PushEvent(&event);
  }
  const Input& after_pump() {
    window_->pump();
    return window_->input();
  }
  std::optional<Window> window_;
};

TEST_F(WindowTest, TwoHeldKeysAreADiagonalAndOppositesCancel) {
  send_key(SDL_SCANCODE_RIGHT, true);
  send_key(SDL_SCANCODE_W, true);
  EXPECT_EQ(after_pump().direction(), Direction::RightUp);
  send_key(SDL_SCANCODE_DOWN, true);
  EXPECT_EQ(after_pump().direction(), Direction::Right);
  send_key(SDL_SCANCODE_RIGHT, false);
  send_key(SDL_SCANCODE_W, false);
  EXPECT_EQ(after_pump().direction(), Direction::Down);
}

TEST_F(WindowTest, ADirectionIsHeldWhileEitherOfItsKeysIs) {
  send_key(SDL_SCANCODE_LEFT, true);
  send_key(SDL_SCANCODE_A, true);
  send_key(SDL_SCANCODE_LEFT, false);
  EXPECT_EQ(after_pump().direction(), Direction::Left);
  send_key(SDL_SCANCODE_A, false);
  EXPECT_EQ(after_pump().direction(), Direction::None);
}

TEST_F(WindowTest, LosingTheFocusReleasesEveryKey) {
  send_key(SDL_SCANCODE_UP, true);
  EXPECT_EQ(after_pump().direction(), Direction::Up);
  SDL_Event event{};
  event.type = SDL_WINDOWEVENT;
  event.window.event = SDL_WINDOWEVENT_FOCUS_LOST;
  SDL_PushEvent(&event);
  EXPECT_EQ(after_pump().direction(), Direction::None);
  EXPECT_FALSE(window_->input().focused);
}

TEST_F(WindowTest, AKeyIsPressedOnceHoweverLongItIsHeld) {
  send_key(SDL_SCANCODE_P, true);
  EXPECT_TRUE(after_pump().was_pressed('p'));
  send_key(SDL_SCANCODE_P, true, true);
  EXPECT_FALSE(after_pump().was_pressed('p'));
  send_key(SDL_SCANCODE_F1, true);
  send_key(SDL_SCANCODE_ESCAPE, true);
  EXPECT_TRUE(after_pump().was_pressed(kKeyF1));
  EXPECT_TRUE(window_->input().was_pressed(kKeyEscape));
}

TEST_F(WindowTest, IsOpenUntilItIsAskedToClose) {
  EXPECT_TRUE(window_->pump());
  SDL_Event event{};
  event.type = SDL_QUIT;
  SDL_PushEvent(&event);
  EXPECT_FALSE(window_->pump());
}

TEST_F(WindowTest, APadMayComeSteerAndGo) {
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");  // memory windows have no focus
  const int index = SDL_JoystickAttachVirtual(
      SDL_JOYSTICK_TYPE_GAMECONTROLLER, SDL_CONTROLLER_AXIS_MAX, SDL_CONTROLLER_BUTTON_MAX, 0);
  if (index < 0) GTEST_SKIP() << "no virtual joystick: " << SDL_GetError();
  after_pump();  // opens it
  SDL_Joystick* pad = SDL_JoystickFromInstanceID(SDL_JoystickGetDeviceInstanceID(index));
  ASSERT_NE(pad, nullptr);
  const auto push = [&](int x, int y) {
    SDL_JoystickSetVirtualAxis(pad, SDL_CONTROLLER_AXIS_LEFTX, static_cast<Sint16>(x));
    SDL_JoystickSetVirtualAxis(pad, SDL_CONTROLLER_AXIS_LEFTY, static_cast<Sint16>(y));
    SDL_GameControllerUpdate();
    return after_pump().direction();
  };
  EXPECT_EQ(push(5000, -4000), Direction::None);
  EXPECT_EQ(push(24000, -24000), Direction::RightUp);
  EXPECT_EQ(push(0, 0), Direction::None);
  SDL_JoystickSetVirtualButton(pad, SDL_CONTROLLER_BUTTON_DPAD_DOWN, SDL_PRESSED);
  SDL_GameControllerUpdate();
  EXPECT_EQ(after_pump().direction(), Direction::Down);
  push(-30000, 0);
  SDL_JoystickDetachVirtual(index);
  EXPECT_EQ(after_pump().direction(), Direction::None);
}

TEST(Gles, DrawsTheSameAsDesktopOpenGl) {
  SDL_SetHint(SDL_HINT_VIDEODRIVER, "offscreen");
  ASSERT_EQ(SDL_InitSubSystem(SDL_INIT_VIDEO), 0) << SDL_GetError();
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_ES);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 0);
  SDL_Window* window = SDL_CreateWindow("es", 0, 0, 64, 64, SDL_WINDOW_OPENGL);
  SDL_GLContext context = window != nullptr ? SDL_GL_CreateContext(window) : nullptr;
  if (context != nullptr) {
    Result<Renderer> renderer = make_renderer(Window::gl_function);
    ASSERT_TRUE(renderer) << renderer.error().message;
    EXPECT_EQ(renderer->device().rfind("OpenGL ES", 0), 0u) << renderer->device();
    Image canvas = make_image(64, 64, 40, 60, 90);
    const Image picture = make_image(20, 20, 200, 100, 50, 128);
    draw_picture(canvas, picture, {10.25f, 20.5f});
    renderer->begin_frame(64, 64);
    renderer->clear(srgb(0x283c5a));
    renderer->draw_sprite({.image = picture, .position = {10.25f, 20.5f}});
    renderer->end_frame();
    EXPECT_LE(testing::largest_difference(renderer->read_pixels(), canvas), 2);
  }
  SDL_GL_DeleteContext(context);
  SDL_DestroyWindow(window);
  SDL_QuitSubSystem(SDL_INIT_VIDEO);
  if (context == nullptr) GTEST_SKIP() << "no OpenGL ES 3 here: " << SDL_GetError();
}

TEST(Sound, OpensOrSaysThatThereIsNone) {
  SDL_SetHint(SDL_HINT_AUDIODRIVER, "dummy");
  Audio audio;
  const bool opened =
      audio.open([](std::span<float> out) { std::fill(out.begin(), out.end(), 0.0f); });
  EXPECT_EQ(audio.is_open(), opened);
}

}  // namespace
}  // namespace vsprite
