// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// scene.h - draws the tank: water and light, weeds, fish by depth, food, bubbles, sparks.
//
// It reads the world and never changes it. What only decorates (bubbles, motes, sparks) is a
// function of time and of the events it was told, so that a replay looks the same.
#pragma once

#include <optional>
#include <vector>

#include "light.h"
#include "plants.h"
#include "vsprite/draw.h"
#include "vsprite/show.h"
#include "vsprite/stream.h"
#include "world.h"

namespace aquarium {

/// How fine the picture is: of the moving light, of the weeds and, at Low, of the whole frame.
enum class Quality : std::uint8_t { Low, Middle, High };
const char* quality_name(Quality quality) noexcept;
/// The share of a window's height and width that the frame has.
float resolution_of(Quality quality, int window_height) noexcept;

/// What is drawn, and when: `fraction` of a tick after the world's last step.
struct Moment {
  const vsprite::Sprite& sprite;
  const World& world;
  float fraction = 0;
  float seconds = 0;  ///< since the game began; drives water, light and weeds
};

class Scene {
 public:
  /// Compiles the effects. Errors: those of Renderer::make_effect and make_layer.
  static vsprite::Result<Scene> make(vsprite::Renderer& renderer);

  /// Call after every tick: turns the world's events into sparks and rings, jumps into fades of
  /// `fade` ticks (show.h).
  void notice(const vsprite::Sprite& sprite, const World& world, float seconds, int fade);
  /// Call when the pack was rebuilt: fades name samples of the old one.
  void forget_fades() { fades_.clear(); }
  /// Draws the tank into the frame that has begun. The backdrop is drawn anew once a changed size
  /// has held for a moment (`settled`), until then the old one is stretched.
  void draw(vsprite::Renderer& renderer, vsprite::FrameCache& frames, const Moment& moment,
            bool settled);
  void set_quality(Quality quality) { quality_ = quality; }
  Quality quality() const { return quality_; }

 private:
  struct Spark {
    Event event;
    float born = 0;
  };
  void draw_backdrop(vsprite::Renderer& renderer);
  void draw_light(vsprite::Renderer& renderer, float seconds);
  void draw_far(vsprite::Renderer& renderer, vsprite::FrameCache& frames, const Moment& moment);
  void draw_plants(vsprite::Renderer& renderer, const Moment& moment, float far, float near);
  void draw_fish(vsprite::Renderer& renderer, vsprite::FrameCache& frames, const Moment& moment,
                 std::size_t which) const;
  void draw_food(vsprite::Renderer& renderer, const Moment& moment) const;
  void draw_sparks(vsprite::Renderer& renderer, float seconds);
  void draw_bubbles(vsprite::Renderer& renderer, float seconds, bool near) const;
  void draw_motes(vsprite::Renderer& renderer, float seconds) const;

  vsprite::Effect wall_, gravel_, stone_, wood_, caustics_, light_effect_, water_;
  vsprite::Layer backdrop_, net_, light_;
  int backdrop_width_ = 0, backdrop_height_ = 0;
  int light_width_ = 0, light_height_ = 0;
  Quality quality_ = Quality::High;
  View view_;
  std::vector<Plant> plants_ = make_plants();
  std::vector<Wake> wakes_;
  std::vector<vsprite::Vertex> vertices_;
  std::vector<Spark> sparks_;
  std::vector<vsprite::ActorFade> fades_;  ///< of World::fish
};

}  // namespace aquarium
