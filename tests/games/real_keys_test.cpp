// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Keys as a person presses them: a real X server (xvfb-run), keys sent to it by xdotool.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "vsprite/draw.h"
#include "vsprite/window.h"

namespace vsprite {
namespace {

/// Pumps until `wanted` holds, at most four seconds.
template <class Condition>
bool soon(Window& window, Condition wanted) {
  for (const double end = window.seconds() + 4; window.seconds() < end;) {
    window.pump();
    if (wanted(window.input())) return true;
    window.swap();
  }
  return false;
}

void xdotool(const std::string& words) {
  const int code = std::system(("xdotool " + words).c_str());
  ASSERT_EQ(code, 0) << "xdotool " << words;
}

TEST(RealKeys, SteerAWindow) {
  Result<Window> window = Window::open({.title = "real keys", .width = 320, .height = 240});
  if (!window) GTEST_SKIP() << window.error().message;
  const Result<Renderer> renderer = make_renderer(Window::gl_function);
  ASSERT_TRUE(renderer) << renderer.error().message;
  const auto is = [](Direction d) {
    return [d](const Input& input) { return input.direction() == d; };
  };
  soon(*window, [](const Input& input) { return input.focused; });
  xdotool("search --sync --name '^real keys$' windowfocus --sync");
  xdotool("keydown Right");
  EXPECT_TRUE(soon(*window, is(Direction::Right)));
  xdotool("keydown Up");
  EXPECT_TRUE(soon(*window, is(Direction::RightUp)));
  xdotool("keyup Right keyup Up");
  EXPECT_TRUE(soon(*window, is(Direction::None)));
  xdotool("key p");
  EXPECT_TRUE(soon(*window, [](const Input& input) { return input.was_pressed('p'); }));
  xdotool("mousemove 400 300 mousedown 1");
  EXPECT_TRUE(soon(*window, [](const Input& input) { return input.pointer_held; }));
  xdotool("mouseup 1");
  EXPECT_TRUE(soon(*window, [](const Input& input) { return !input.pointer_held; }));
}

}  // namespace
}  // namespace vsprite
