// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Sprites a second beside SDL2's: the CPU compositor beside its software renderer, the renderer
// beside one batch of SDL_RenderGeometry on the same OpenGL driver. Everything in one run, without
// a display.
//
//     draw_bench --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
#include <SDL.h>
#include <benchmark/benchmark.h>

#include <array>
#include <optional>

#include "draw_scene.h"
#include "vsprite/compose.h"
#include "vsprite/draw.h"
#include "vsprite/window.h"

namespace vsprite::bench {
namespace {

void count_sprites(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * kPlaces);
}

/// The matte as SDL wants it: straight alpha, ARGB in a word.
SDL_Surface* make_surface(int columns, int rows) {
  SDL_Surface* surface = SDL_CreateRGBSurfaceWithFormat(0, columns * kSide, rows * kSide, 32,
                                                        SDL_PIXELFORMAT_ARGB8888);
  for (int i = 0; i < columns * rows; ++i) {
    Image image = mattes()[static_cast<std::size_t>(i)];
    unpremultiply(image);
    for (int y = 0; y < kSide; ++y) {
      auto* row = static_cast<std::uint8_t*>(surface->pixels) +
                  (i / columns * kSide + y) * surface->pitch + i % columns * kSide * 4;
      for (int x = 0; x < kSide; ++x) {
        const std::uint8_t* p = ImageView(image).pixel(x, y);
        row[4 * x] = p[2];
        row[4 * x + 1] = p[1];
        row[4 * x + 2] = p[0];
        row[4 * x + 3] = p[3];
      }
    }
  }
  return surface;
}

void BM_RivalSdlSoftware(benchmark::State& state) {
  SDL_Surface* canvas =
      SDL_CreateRGBSurfaceWithFormat(0, kFrameWidth, kFrameHeight, 32, SDL_PIXELFORMAT_ARGB8888);
  SDL_Renderer* renderer = SDL_CreateSoftwareRenderer(canvas);
  SDL_Surface* sheet = make_surface(8, 8);
  std::array<SDL_Texture*, kMattes> textures{};
  for (int i = 0; i < kMattes; ++i) {
    SDL_Surface* one =
        SDL_CreateRGBSurfaceWithFormat(0, kSide, kSide, 32, SDL_PIXELFORMAT_ARGB8888);
    SDL_SetSurfaceBlendMode(sheet, SDL_BLENDMODE_NONE);
    const SDL_Rect from{i % 8 * kSide, i / 8 * kSide, kSide, kSide};
    SDL_BlitSurface(sheet, &from, one, nullptr);
    textures[static_cast<std::size_t>(i)] = SDL_CreateTextureFromSurface(renderer, one);
    SDL_SetTextureBlendMode(textures[static_cast<std::size_t>(i)], SDL_BLENDMODE_BLEND);
    SDL_FreeSurface(one);
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const Vec2 at = places()[i];
      const SDL_Rect to{static_cast<int>(at.x), static_cast<int>(at.y), kSide, kSide};
      SDL_RenderCopy(renderer, textures[i % kMattes], nullptr, &to);
    }
    SDL_RenderFlush(renderer);
    benchmark::ClobberMemory();
  }
  for (SDL_Texture* texture : textures) SDL_DestroyTexture(texture);
  SDL_DestroyRenderer(renderer);
  SDL_FreeSurface(sheet);
  SDL_FreeSurface(canvas);
  count_sprites(state);
}
BENCHMARK(BM_RivalSdlSoftware)->Unit(benchmark::kMillisecond);

// Arguments: linear light (1) or encoded values (0), sub-pixel places (1) or whole pixels (0).
void BM_Compositor(benchmark::State& state) {
  Image canvas = make_image(kFrameWidth, kFrameHeight, 30, 60, 90);
  const DrawOptions options{.blend = state.range(0) != 0 ? Blend::LinearLight : Blend::Encoded};
  for (auto _ : state) {
    for (std::size_t i = 0; i < kPlaces; ++i) {
      Vec2 at = places()[i];
      if (state.range(1) == 0) at = {std::floor(at.x), std::floor(at.y)};
      draw_picture(canvas, mattes()[i % kMattes], at, options);
    }
    benchmark::ClobberMemory();
  }
  count_sprites(state);
}
BENCHMARK(BM_Compositor)
    ->ArgNames({"linear", "subpixel"})
    ->ArgsProduct({{0, 1}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

void BM_RivalSdlGeometry(benchmark::State& state) {
  SDL_SetHint(SDL_HINT_VIDEODRIVER, "offscreen");
  SDL_SetHint(SDL_HINT_RENDER_DRIVER, "opengl");
  SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, "1");  // bilinear, as ours
  SDL_InitSubSystem(SDL_INIT_VIDEO);
  SDL_Window* window =
      SDL_CreateWindow("rival", 0, 0, kFrameWidth, kFrameHeight, SDL_WINDOW_OPENGL);
  SDL_Renderer* renderer = SDL_CreateRenderer(window, -1, SDL_RENDERER_ACCELERATED);
  if (renderer == nullptr) {
    state.SkipWithError(SDL_GetError());
    return;
  }
  SDL_Surface* sheet = make_surface(8, 8);
  SDL_Texture* texture = SDL_CreateTextureFromSurface(renderer, sheet);
  SDL_SetTextureBlendMode(texture, SDL_BLENDMODE_BLEND);
  std::vector<SDL_Vertex> vertices;
  std::vector<int> indices;
  const auto build = [&] {
    vertices.clear();
    indices.clear();
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const Vec2 at = places()[i];
      const int first = static_cast<int>(vertices.size());
      const auto column = static_cast<float>(i % kMattes % 8),
                 row = static_cast<float>(i % kMattes / 8);
      for (int corner = 0; corner < 4; ++corner) {
        const auto x = static_cast<float>(corner & 1), y = static_cast<float>(corner >> 1);
        vertices.push_back({{at.x + x * kSide, at.y + y * kSide},
                            {255, 255, 255, 255},
                            {(column + x) / 8, (row + y) / 8}});
      }
      for (int k : {0, 1, 2, 2, 1, 3}) indices.push_back(first + k);
    }
  };
  const auto frame = [&] {
    SDL_SetRenderDrawColor(renderer, 30, 60, 90, 255);
    SDL_RenderClear(renderer);
    build();
    SDL_RenderGeometry(renderer, texture, vertices.data(), static_cast<int>(vertices.size()),
                       indices.data(), static_cast<int>(indices.size()));
    SDL_RenderPresent(renderer);
  };
  std::array<std::uint8_t, 4> pixel{};
  const SDL_Rect one{0, 0, 1, 1};
  for (auto _ : state) {
    frame();
    // Reading a pixel back waits for the driver.
    SDL_RenderReadPixels(renderer, &one, SDL_PIXELFORMAT_ARGB8888, pixel.data(), 4);
  }
  SDL_DestroyTexture(texture);
  SDL_FreeSurface(sheet);
  SDL_DestroyRenderer(renderer);
  SDL_DestroyWindow(window);
  SDL_QuitSubSystem(SDL_INIT_VIDEO);
  count_sprites(state);
}
BENCHMARK(BM_RivalSdlGeometry)->Unit(benchmark::kMillisecond)->UseRealTime();

// The whole frame: cleared, drawn at sub-pixel places, encoded, presented, and waited for.
void BM_Renderer(benchmark::State& state) {
  Result<Window> window =
      Window::open({.width = kFrameWidth, .height = kFrameHeight, .headless = true});
  if (!window) {
    state.SkipWithError(window.error().message.c_str());
    return;
  }
  Result<Renderer> renderer = make_renderer(Window::gl_function);
  if (!renderer) {
    state.SkipWithError(renderer.error().message.c_str());
    return;
  }
  const auto frame = [&] {
    renderer->begin_frame(kFrameWidth, kFrameHeight);
    renderer->clear(srgb(0x1e3c5a));
    for (std::size_t i = 0; i < kPlaces; ++i) {
      renderer->draw_sprite({.image = mattes()[i % kMattes],
                             .key = {1, static_cast<std::uint32_t>(i % kMattes)},
                             .position = places()[i]});
    }
    renderer->end_frame();
    window->swap();
  };
  frame();
  for (auto _ : state) {
    frame();
    renderer->wait();
  }
  count_sprites(state);
}
BENCHMARK(BM_Renderer)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace vsprite::bench

BENCHMARK_MAIN();
