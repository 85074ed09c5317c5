// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// aquarium - steers a filmed goldfish through a tank, after food.
#include <array>
#include <cinttypes>
#include <cstdio>
#include <optional>
#include <utility>

#include "arguments.h"
#include "best.h"
#include "hud.h"
#include "options.h"
#include "scene.h"
#include "sound.h"
#include "vsprite/session.h"
#include "vsprite/vsprite.h"

namespace aquarium {
namespace {

using vsprite::Direction;
using vsprite::PackWatch;
using vsprite::Result;
using vsprite::Session;
using vsprite::Sprite;

/// The size of the frame, and whether it has held long enough to be worth a new backdrop.
class SizeWatch {
 public:
  bool settled(int width, int height, double now) {
    if (width != width_ || height != height_) changed_ = now;
    width_ = width;
    height_ = height;
    return now - changed_ > 0.25;
  }

 private:
  int width_ = 0, height_ = 0;
  double changed_ = -1;
};

/// A coarser picture when most frames of half a second take longer than a tick. It never goes back
/// up by itself: a picture that changes to and fro is worse than a coarse one.
class QualityKeeper {
 public:
  explicit QualityKeeper(std::optional<Quality> fixed)
      : automatic_(!fixed), quality_(fixed.value_or(Quality::High)) {}
  Quality update(FrameTimes& times) {
    constexpr std::size_t kFrames = 16;
    if (automatic_ && quality_ != Quality::Low && times.count() >= kFrames &&
        times.slower_than(30, kFrames) > 12) {
      quality_ = static_cast<Quality>(static_cast<int>(quality_) - 1);
      times.clear();
    }
    return quality_;
  }

 private:
  bool automatic_;
  Quality quality_;
};

class Game {
 public:
  Game(Sprite sprite, PackWatch watch, Session& session, Scene scene, const Options& options,
       std::uint64_t seed, int fade)
      : sprite_(std::move(sprite)),
        watch_(std::move(watch)),
        session_(session),
        scene_(std::move(scene)),
        frames_(std::in_place, sprite_),
        fade_(fade),
        keeper_(session.window().headless() && !options.quality ? Quality::High : options.quality),
        world_(make_world(sprite_, seed, options.others)) {
    hud_.muted = options.mute;
    if (session_.window().headless()) return;
    best_path_ = best_score_path();
    hud_.best = load_best_score(best_path_);
    sound_.set_muted(options.mute);
    sound_.open();
  }

  void frame() {
    take_rebuilt();
    take_keys();
    while (session_.next_tick()) tick();
    draw();
    session_.show();
  }

  const World& world() const { return world_; }
  const FrameTimes& frame_times() const { return hud_.frame_times; }
  Quality quality() const { return scene_.quality(); }

 private:
  void take_rebuilt() {
    auto rebuilt = vsprite::games::take_rebuilt(watch_, "aquarium", sprite_.fps());
    if (!rebuilt) return;
    for (Fish& fish : world_.fish) fish.actor = carry_over(sprite_, *rebuilt, fish.actor);
    scene_.forget_fades();
    forget(session_.renderer(), sprite_);
    frames_.reset();
    sprite_ = std::move(*rebuilt);
    frames_.emplace(sprite_);
  }

  void take_keys() {
    const vsprite::Input& input = session_.input();
    if (input.was_pressed(vsprite::kKeyEscape)) session_.close();
    if (input.was_pressed(vsprite::kKeyF1)) hud_.overlay = !hud_.overlay;
    if (input.was_pressed('m')) {
      hud_.muted = !hud_.muted;
      sound_.set_muted(hud_.muted);
    }
    const bool lost = !input.focused && focused_ && !session_.is_scripted();
    focused_ = input.focused;
    if (input.was_pressed('p')) set_paused(!world_.paused);
    if (lost && world_.phase == Phase::Playing) set_paused(true);
    const bool again = input.was_pressed(vsprite::kKeyEnter) || input.was_pressed(' ');
    if (world_.paused && again) set_paused(false);
    const bool tapped =
        input.pointer_pressed && world_.phase == Phase::Over && world_.phase_ticks > 30;
    start_ = start_ || again || tapped;
  }

  void set_paused(bool paused) {
    world_.paused = paused;
    session_.set_paused(paused);
  }

  Input read_input() {
    Input input;
    input.direction = session_.direction();
    input.start = std::exchange(start_, false);
    const vsprite::Input& player = session_.input();
    if (session_.is_scripted()) return input;
    if (player.pointer_held && input.direction == Direction::None) {
      const vsprite::Renderer& renderer = session_.renderer();
      const View view = make_view(renderer.width(), renderer.height());
      const vsprite::Vec2 p = renderer.frame_from_window(player.pointer);
      input.target = {(p.x - view.offset.x) / view.scale, (p.y - view.offset.y) / view.scale};
    } else if (input.direction == Direction::None) {
      input.direction = Direction::Rest;  // let go: the fish slows down instead of leaving
    }
    return input;
  }

  void tick() {
    const vsprite::Actor before = world_.fish[0].actor;
    session_.play_actions(sprite_, world_.fish[0].actor);
    step(sprite_, world_, read_input());
    const vsprite::Actor& after = world_.fish[0].actor;
    if (after.tick != before.tick)  // a pause shows the last one
      hud_.transition_cost = vsprite::shown_cost(sprite_, before.sample, after);
    const auto now = static_cast<float>(session_.seconds());
    scene_.notice(sprite_, world_, now, fade_);
    sound_.notice(world_);
    for (const Event& event : world_.events) {
      if (event.kind == EventKind::Start && first_start_ < 0) first_start_ = now;
      if (event.kind == EventKind::End) keep_best();
    }
  }

  void keep_best() {
    hud_.new_best = world_.score > hud_.best;
    if (!hud_.new_best) return;
    hud_.best = world_.score;
    save_best_score(best_path_, world_.score);
  }

  void draw() {
    vsprite::Renderer& renderer = session_.renderer();
    const double now = session_.window().seconds();
    if (shown_ > 0) hud_.frame_times.add(static_cast<float>(1000 * (now - shown_)));
    shown_ = now;
    const auto seconds = static_cast<float>(session_.seconds());
    const Moment moment{sprite_, world_, session_.fraction(), seconds};
    hud_.hint_seconds = first_start_ < 0 ? -1 : seconds - first_start_;
    scene_.set_quality(keeper_.update(hud_.frame_times));
    session_.set_resolution(resolution_of(scene_.quality(), session_.window().height()));
    const bool settled =
        session_.window().headless() || size_.settled(renderer.width(), renderer.height(), now);
    scene_.draw(renderer, *frames_, moment, settled);
    draw_hud(renderer, moment, hud_, scene_.quality());
  }

  Sprite sprite_;
  PackWatch watch_;
  Session& session_;
  Scene scene_;
  std::optional<vsprite::FrameCache> frames_;
  int fade_;
  QualityKeeper keeper_;
  World world_;
  HudState hud_;
  Sound sound_;
  SizeWatch size_;
  std::string best_path_;
  bool focused_ = true;
  bool start_ = false;
  float first_start_ = -1;
  double shown_ = 0;
};

Result<void> play(const vsprite::games::Arguments& arguments, const Options& options) {
  PackWatch watch(arguments.pack);
  Result<Sprite> sprite = vsprite::load_pack(arguments.pack);
  if (!sprite) return sprite.error();
  vsprite::SessionConfig config =
      vsprite::games::session_config("aquarium", sprite->fps(), arguments, &*sprite);
  config.width = options.width;
  config.height = options.height;
  if (options.quality) config.resolution = resolution_of(*options.quality, options.height);
  config.renderer = {.dither = true};
  Result<Session> session = Session::open(config);
  if (!session) return session.error();
  Result<Scene> scene = Scene::make(session->renderer());
  if (!scene) return scene.error();
  Game game(std::move(*sprite), std::move(watch), *session, std::move(*scene), options,
            arguments.seed, arguments.fade);
  while (session->next_frame()) game.frame();
  if (arguments.headless || arguments.frames > 0) {
    constexpr std::array<const char*, 3> kPhases{"ready", "playing", "over"};
    const World& world = game.world();
    std::printf("%" PRIu64 " ticks, %s, score %d, %d flakes, states %016" PRIx64 "\n", world.tick,
                kPhases[static_cast<std::size_t>(world.phase)], world.score, world.eaten,
                states_hash(world));
    const int steered = std::max(1, world.steered_ticks);
    std::printf("the glass turned the fish in %.1f %% of the ticks of play\n",
                100.0 * world.refused_ticks / steered);
  }
  if (!arguments.headless && arguments.frames > 0) {
    std::printf("quality %s, frame %.1f ms, worst %.1f, on %s\n", quality_name(game.quality()),
                static_cast<double>(game.frame_times().mean(FrameTimes::kCount)),
                static_cast<double>(game.frame_times().worst()),
                session->renderer().device().c_str());
  }
  return session->finish();
}

}  // namespace
}  // namespace aquarium

int main(int argc, char** argv) {
  vsprite::Result<aquarium::Options> options = aquarium::take_own_options(argc, argv);
  if (!options) {
    std::fprintf(stderr, "aquarium: error: %s\n", options.error().message.c_str());
    return vsprite::exit_code(options.error().code);
  }
  bool help = false;
  const int code = vsprite::games::run(
      static_cast<int>(options->rest.size()), options->rest.data(), "aquarium",
      aquarium::find_bundled_pack(),
      [&](const auto& arguments) { return aquarium::play(arguments, *options); });
  for (const std::string_view word : options->rest) help = help || word == "--help" || word == "-h";
  if (help && code == 0) std::fputs(aquarium::kOwnUsage, stdout);
  return code;
}
