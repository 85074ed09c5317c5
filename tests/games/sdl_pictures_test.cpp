// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include <SDL.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "support/gl_stage.h"
#include "support/temp_folder.h"
#include "support/tiny_sprite.h"
#include "vsprite/compose.h"
#include "vsprite/pack.h"
#include "vsprite/sdl.h"

namespace vsprite {
namespace {

constexpr int kWidth = 96, kHeight = 80;

/// Drawn into by SDL's own software renderer, or by OpenGL on the offscreen driver.
class SdlStage {
 public:
  explicit SdlStage(bool opengl) {
    SDL_SetHint(SDL_HINT_VIDEODRIVER, opengl ? "offscreen" : "dummy");
    SDL_SetHint(SDL_HINT_RENDER_DRIVER, opengl ? "opengl" : "software");
    if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0) return;
    window_ = SDL_CreateWindow("t", 0, 0, kWidth, kHeight,
                               opengl ? Uint32{SDL_WINDOW_OPENGL} : Uint32{0});
    if (window_ != nullptr) renderer_ = SDL_CreateRenderer(window_, -1, 0);
  }
  ~SdlStage() {
    if (renderer_ != nullptr) SDL_DestroyRenderer(renderer_);
    if (window_ != nullptr) SDL_DestroyWindow(window_);
    SDL_Quit();
    SDL_ClearHints();
  }
  SDL_Renderer* renderer() const { return renderer_; }
  void clear() const {
    SDL_SetRenderDrawColor(renderer_, 40, 60, 90, 255);
    SDL_RenderClear(renderer_);
  }
  Image read() const {
    Image image = make_image(kWidth, kHeight, 0, 0, 0);
    SDL_RenderReadPixels(renderer_, nullptr, SDL_PIXELFORMAT_RGBA32, image.rgba.data(), 4 * kWidth);
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    return image;
  }

 private:
  SDL_Window* window_ = nullptr;
  SDL_Renderer* renderer_ = nullptr;
};

class SdlPicturesTest : public ::testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    const SpriteData data = testing::tiny_sprite_data();
    const auto picture = [&](std::uint32_t i) -> Result<Image> {
      return testing::tiny_picture(data, i);
    };
    ASSERT_TRUE(save_pack(folder_.file("tiny.vsp"), data, picture));
    sprite_.emplace(*load_pack(folder_.file("tiny.vsp")));
    frames_.emplace(*sprite_, std::size_t{1} << 20);
    stage_.emplace(GetParam());
    if (stage_->renderer() == nullptr) GTEST_SKIP() << SDL_GetError();
  }
  /// The sample by the compositor, as SDL counts light.
  Image due(std::uint32_t sample, Vec2 at) {
    Image canvas = make_image(kWidth, kHeight, 40, 60, 90);
    draw_sample(canvas, frames_->frame(sample), sprite_->samples()[sample], at,
                {.blend = Blend::Encoded});
    return canvas;
  }
  testing::TempFolder folder_;
  std::optional<Sprite> sprite_;
  std::optional<FrameCache> frames_;
  std::optional<SdlStage> stage_;
};

TEST_P(SdlPicturesTest, DrawsTheCompositorsPicture) {
  SdlPictures pictures(stage_->renderer());
  EXPECT_EQ(pictures.is_premultiplied(), GetParam());
  EXPECT_EQ(pictures.note().empty(), GetParam());
  Actor actor = make_actor(*sprite_, {40, 30});
  for (std::uint32_t phase = 0; phase < 4; ++phase) {
    actor.sample = testing::tiny_sample(0, phase);
    // The software renderer draws whole pixels: the corner has to lie on one.
    const Vec2 anchor = sprite_->samples()[actor.sample].anchor;
    const Vec2 at{20 + anchor.x + (GetParam() ? 0.25f : 0.0f),
                  30 + anchor.y + (GetParam() ? 0.5f : 0.0f)};
    actor.position = to_position(at);
    stage_->clear();
    EXPECT_TRUE(pictures.draw(*sprite_, *frames_, actor)) << SDL_GetError();
    EXPECT_LE(testing::largest_difference(stage_->read(), due(actor.sample, at)), 3) << phase;
  }
}

TEST_P(SdlPicturesTest, FadesAJumpWithoutADip) {
  SdlPictures pictures(stage_->renderer());
  Actor actor = make_actor(*sprite_, {40, 30});
  ActorFade fade;
  actor.sample = testing::tiny_sample(0, 3);
  follow(*sprite_, actor, fade);
  actor.sample = testing::tiny_sample(4, 4);
  follow(*sprite_, actor, fade, 3);
  ASSERT_FLOAT_EQ(fade_share(fade), 0.75f);
  stage_->clear();
  EXPECT_TRUE(pictures.draw(*sprite_, *frames_, actor, fade));
  const Image seen = stage_->read();
  // At the anchor both are opaque: a quarter of one, three quarters of the other.
  const Image now = due(actor.sample, {40, 30}), before = due(fade.before, {40, 30});
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t at = (30 * kWidth + 40) * 4 + c;
    EXPECT_NEAR(seen.rgba[at], 0.25 * now.rgba[at] + 0.75 * before.rgba[at], 3);
  }
}

TEST_P(SdlPicturesTest, KeepsWithinItsBudgetAndStartsAnew) {
  constexpr std::size_t kBudget = 8000;  // of pictures of some 2.4 kB
  SdlPictures pictures(stage_->renderer(), kBudget);
  Actor actor = make_actor(*sprite_, {40, 30});
  for (std::uint32_t i = 1; i < testing::kTinySamples; ++i) {
    actor.sample = i;
    EXPECT_TRUE(pictures.draw(*sprite_, *frames_, actor));
    EXPECT_LE(pictures.texture_bytes(), kBudget);
  }
  EXPECT_GT(pictures.texture_bytes(), 0u);
  pictures.clear();
  EXPECT_EQ(pictures.texture_bytes(), 0u);
  stage_->clear();
  EXPECT_TRUE(pictures.draw(*sprite_, *frames_, actor));
  EXPECT_LE(testing::largest_difference(stage_->read(), due(actor.sample, {40, 30})), 3);
}

TEST_P(SdlPicturesTest, SaysWhyThereIsNoTexture) {
  SdlPictures pictures(stage_->renderer());
  EXPECT_EQ(pictures.texture(*sprite_, *frames_, 0), nullptr);  // was not kept
  EXPECT_STREQ(SDL_GetError(), "sample 0 has no picture: it was not kept, or is damaged");
}

INSTANTIATE_TEST_SUITE_P(Renderers, SdlPicturesTest, ::testing::Values(false, true),
                         [](const auto& p) { return p.param ? "OpenGL" : "Software"; });

}  // namespace
}  // namespace vsprite
