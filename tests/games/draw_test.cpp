#pragma GCC diagnostic ignored "-Wconversion"
#include <gtest/gtest.h>
#include "support/tiny_sprite.h"
#include "vsprite/compose.h"
#include "vsprite/draw.h"
#include "vsprite/record.h"
#include "vsprite/sdl.h"
#include "vsprite/pack.h"
using namespace vsprite; namespace vt = vsprite::testing;
TEST(Draw, Trial) {
  auto w = Window::open({.width=640,.height=480,.headless=true});
  ASSERT_TRUE(w) << w.error().message;
  auto r = make_renderer();
  ASSERT_TRUE(r) << r.error().message;
  printf("%s\n", r->device().c_str());
  r->begin_frame(900, 620);
  r->clear(srgb(0x203040));
  std::string s;
  for (int i = 32; i < 127; ++i) { s += char(i); if (i % 32 == 31) s += '\n'; }
  s += "\n\u2190\u2191\u2192\u2193 \u00b0\u00b1\u00d7\u2026\u00b7\u2013\u2014 \u00e9";
  r->draw_text(s, {10, 10}, {.size = 40});
  r->draw_text("The quick brown fox jumps over the lazy dog. 0123456789 sample 1234 cost 0.31 (F1)\n"
               "stage 3  table right+down*6+2  frame 16.7 ms  [P] pause  {M} mute  50% @ a_b #7 & more!", {10, 230}, {.size = 16});
  r->draw_text("The quick brown fox jumps over the lazy dog. 0123456789\nHAMSTERS & GOLDFISH: Press arrow keys", {10, 270}, {.size = 24});
  r->draw_text("small 12 px: The quick brown fox jumps over 0123456789", {10, 330}, {.size = 12, .color=srgb(0xffe080)});
  r->draw_text("Score 12", {890, 330}, {.size = 64, .align = Align::Right});
  r->draw_shape(box({20, 420}, {80, 480}, srgb(0xffffff, 0.8f), 10));
  auto o = box({100, 420}, {160, 480}, srgb(0xffffff, 0.8f), 10); o.outline = 3; r->draw_shape(o);
  r->draw_shape(disc({200, 450}, 30, srgb(0xff4040)));
  auto g = disc({280, 450}, 20, srgb(0xffe0a0)); g.feather = 20; r->draw_shape(g);
  r->draw_shape(line({320, 420}, {400, 480}, 6, srgb(0x40ff80)));
  Vec2 tri[] = {{420, 480}, {450, 420}, {480, 480}};
  r->draw_polygon(tri, srgb(0xffffff));
  auto d = vt::tiny_sprite_data();
  for (int i = 0; i < 8; ++i) {
    Image p = vt::tiny_picture(d, vt::tiny_sample(i, 3)); premultiply(p);
    r->draw_sprite({.image = p, .position = {520.f + 45.f * i, 450}, .anchor = d.samples[4].anchor, .scale = 1.f + .3f*i});
    r->draw_sprite({.image = p, .position = {520.f + 45.f * i, 520}, .anchor = d.samples[4].anchor, .scale = 1.f - .1f*i, .angle = .3f * i});
  }
  r->end_frame(640, 480);
  Image img = r->read_pixels();
  ASSERT_EQ(img.width, 900);
  ASSERT_TRUE(save_png("/tmp/draw_trial.png", img));
  ASSERT_TRUE(save_pack("/tmp/tiny.vsp", d, [&](std::uint32_t i) -> Result<Image> { return vt::tiny_picture(d, i); }));
}
