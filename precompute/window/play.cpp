// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The loop of the play window: commands in, ticks made, the camera kept on the character.
#include "window/play.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "vsprite/action.h"
#include "vsprite/record.h"
#include "vsprite/reload.h"
#include "vsprite/session.h"
#include "window/play_view.h"

namespace vsprite {
namespace {

using window::PlayState;

bool is_served(const ControlMode& mode, int direction) {
  return (mode.served >> direction & 1u) != 0;
}

/// "up, right+up": the directions that cannot be steered.
std::string unserved_names(const ControlMode& mode) {
  std::string names;
  for (int d = 0; d < kCompassCount; ++d) {
    if (is_served(mode, d)) continue;
    names += (names.empty() ? "" : ", ");
    names += direction_name(static_cast<Direction>(d));
  }
  return names;
}

std::string warning_line(const ControlMode& mode) {
  if ((mode.served & 0xFFu) == 0)
    return "plays by itself: no direction can be travelled in this film";
  const std::string names = unserved_names(mode);
  return names.empty() ? names : "not in this film: " + names;
}

std::string instead_of(const ControlMode& mode, Direction direction) {
  const Direction followed = mode.table_of[static_cast<std::size_t>(direction)];
  if (followed == Direction::Rest) return "rests instead";
  if (followed == Direction::None) return "carries on by itself instead";
  return std::string(direction_name(followed)) + " is followed instead";
}

std::string notice_of(const ControlMode& mode, Direction command) {
  const int d = static_cast<int>(command);
  if (d >= kCompassCount || is_served(mode, d)) return {};
  return std::string(direction_name(command)) + ": not in this film, " + instead_of(mode, command);
}

Result<int> find_mode(const Sprite& sprite, const std::string& name) {
  const int index = name.empty() ? 0 : sprite.find_mode(name);
  if (index >= 0) return index;
  std::string known;
  for (const ControlMode& mode : sprite.data().modes) {
    known += (known.empty() ? "" : ", ") + mode.name;
  }
  return Error{ErrorCode::BadSetting,
               "mode " + name + ": no such mode in this pack, it has " + known};
}

/// A key's action shows within a quarter of a second or so.
constexpr int kActionTicks = 8;

/// So that a body takes about a quarter of the window's height, in steps that keep pixels even.
float fitting_zoom(const Sprite& sprite, int height) {
  const float body = std::max(sprite.data().body_length, 8.0f);
  const float wanted = 0.26f * static_cast<float>(height) / body;
  return wanted >= 1 ? std::min(std::floor(wanted * 2) / 2, 4.0f) : std::max(wanted, 0.1f);
}

class Play {
 public:
  Play(const Sprite& sprite, Session& session, const PlayOptions& options, int mode,
       KeyScript script)
      : sprite_(&sprite),
        session_(session),
        options_(options),
        frames_(std::in_place, sprite),
        script_(std::move(script)) {
    state_.actor = make_actor(sprite, {}, options.seed, mode);
    state_.zoom = fitting_zoom(sprite, options.height);
    state_.overlay = options.overlay;
    state_.hint = session.is_scripted() ? 0.0f : 1.0f;
    state_.costs.fill(-1);
    describe();
    if (still_) state_.hint = 0;
    if (!options.watched.empty()) watch_.emplace(options.watched);
  }

  void frame() {
    if (watch_) take_rebuilt();
    read_keys();
    state_.has_target = session_.input().pointer_held && !session_.is_scripted();
    while (session_.next_tick()) tick();
    follow();
  }
  PlayState& state() { return state_; }
  const Sprite& sprite() const { return *sprite_; }
  FrameCache& frames() { return *frames_; }

 private:
  void describe();
  void take_rebuilt();
  void read_keys();
  void command();
  void tick();
  void rebase();
  void follow();

  const Sprite* sprite_;
  std::optional<Sprite> rebuilt_;  // what sprite_ points to, once the pack was rebuilt
  Session& session_;
  const PlayOptions& options_;
  std::optional<FrameCache> frames_;
  std::optional<PackWatch> watch_;
  KeyScript script_;  // its actions; the session steers by it
  PlayState state_;
  bool still_ = false;
  double last_seconds_ = 0;
};

// What the window says about the pack.
void Play::describe() {
  const SpriteData& data = sprite().data();
  const ControlMode& mode = data.modes[state_.actor.mode];
  state_.title = !options_.title.empty() ? options_.title : data.name;
  state_.subtitle = "mode " + mode.name + " \u00b7 " + std::to_string(data.samples.size()) +
                    " samples \u00b7 " + std::to_string(std::lround(sprite().fps())) + " frames/s";
  state_.warning = warning_line(mode);
  still_ = (mode.served & 0xFFu) == 0;
}

void Play::take_rebuilt() {
  Result<std::optional<Sprite>> rebuilt = watch_->poll();
  if (rebuilt && !*rebuilt) return;
  if (rebuilt && (*rebuilt)->fps() != sprite().fps())
    rebuilt =
        Error{ErrorCode::BadContent,
              options_.watched + ": its ticks are no longer as long as they were: start again"};
  if (!rebuilt) {
    state_.warning = "the old pack plays on: " + rebuilt.error().message;
    if (options_.tell) options_.tell(state_.warning);
    return;
  }
  Sprite& fresh = **rebuilt;
  state_.actor = carry_over(sprite(), fresh, state_.actor);
  state_.fade = {};
  forget(session_.renderer(), sprite());
  frames_.reset();
  rebuilt_ = std::move(fresh);
  sprite_ = &*rebuilt_;
  frames_.emplace(*sprite_);
  describe();
  if (options_.tell) options_.tell(options_.watched + " was rebuilt, and is taken over");
}

void Play::read_keys() {
  const Input& input = session_.input();
  for (const int key : input.pressed) {
    if (key == kKeyEscape) session_.close();
    if (key == 'p') session_.set_paused(!session_.is_paused());
    if (key == ' ' && session_.is_paused()) session_.advance_one();
    if (key == kKeyF1) state_.overlay = !state_.overlay;
    if (key == 'b') state_.ground = (state_.ground + 1) % window::kGroundCount;
    if (key == '+' || key == '=') state_.zoom = std::min(state_.zoom * 1.25f, 8.0f);
    if (key == '-') state_.zoom = std::max(state_.zoom / 1.25f, 0.1f);
    const int action = key - '1';  // the actions of a cast, in the order of its tags
    if (action >= 0 && action < std::min(9, static_cast<int>(sprite().actions().size())))
      play(sprite(), state_.actor, action, kActionTicks);
    if (key == 'r') release(sprite(), state_.actor, kActionTicks);
    if (key == 'c') cancel(sprite(), state_.actor);
  }
}

void Play::command() {
  if (state_.has_target) {
    const Renderer& r = session_.renderer();
    const Vec2 at = r.frame_from_window(session_.input().pointer);
    state_.target = {
        state_.camera.x + (at.x - 0.5f * static_cast<float>(r.width())) / state_.zoom,
        state_.camera.y + (at.y - 0.5f * static_cast<float>(r.height())) / state_.zoom};
    set_target(sprite(), state_.actor, state_.target, 0.4f * sprite().data().body_length);
  } else {
    set_direction(sprite(), state_.actor, session_.direction());
  }
  state_.command = state_.actor.direction;
  const ControlMode& mode = sprite().data().modes[state_.actor.mode];
  state_.notice = still_ ? std::string() : notice_of(mode, state_.command);
}

void Play::tick() {
  command();
  play_script(sprite(), script_, session_.tick(), state_.actor);
  const std::uint32_t before = state_.actor.sample;
  step(sprite(), state_.actor);
  vsprite::follow(sprite(), state_.actor, state_.fade, options_.fade);
  if (options_.after_tick) options_.after_tick(state_.actor);
  float& cost = state_.costs[state_.cost_head];
  state_.cost_head = (state_.cost_head + 1) % window::kHistory;
  cost = -1;
  if (state_.actor.jumped != 0) {
    cost = state_.last_cost = shown_cost(sprite(), before, state_.actor);
    ++state_.jumps;
  }
  if (state_.hint < 1 || state_.command != Direction::None) {
    state_.hint = std::max(0.0f, state_.hint - 2 / static_cast<float>(sprite().fps()));
  }
  rebase();
}

/// The world is a torus of many grid cells, so that a float holds every place exactly enough.
void Play::rebase() {
  const std::int64_t period = std::int64_t{4} * window::grid_spacing(sprite()) * kFixedOne;
  const auto shift = [&](std::int64_t& position, float& camera) {
    if (std::abs(position) < 16 * period) return;
    const std::int64_t by = position / period * period;
    position -= by;
    camera -= static_cast<float>(by / kFixedOne);
  };
  shift(state_.actor.position.x, state_.camera.x);
  shift(state_.actor.position.y, state_.camera.y);
}

/// The camera goes where the character is with a time constant of 0.35 s.
void Play::follow() {
  const double now = session_.seconds();
  const double elapsed = std::clamp(now - last_seconds_, 0.0, 0.2);
  last_seconds_ = now;
  const auto part = static_cast<float>(1 - std::exp(-elapsed / 0.35));
  const Vec2 at = draw_position(sprite(), state_.actor, session_.fraction());
  state_.camera.x += part * (at.x - state_.camera.x);
  state_.camera.y += part * (at.y - state_.camera.y);
}

}  // namespace

std::string describe_directions(const Sprite& sprite, const std::string& mode) {
  const Result<int> index = find_mode(sprite, mode);
  if (!index) return {};
  const ControlMode& control = sprite.data().modes[static_cast<std::size_t>(*index)];
  if ((control.served & 0xFFu) == 0) {
    return "no direction can be steered, because the film holds no travel that can be kept up; the "
           "character plays by itself\n";
  }
  std::string lines;
  for (int d = 0; d < kCompassCount; ++d) {
    const auto direction = static_cast<Direction>(d);
    if (is_served(control, d)) continue;
    lines += std::string(direction_name(direction)) +
             ": the film holds no travel this way that can be kept up, " +
             instead_of(control, direction) + "\n";
  }
  return lines;
}

Result<void> play_window(const Sprite& sprite, const PlayOptions& options) {
  const Result<int> mode = find_mode(sprite, options.mode);
  if (!mode) return mode.error();
  Result<KeyScript> script =
      options.keys.empty() ? KeyScript{} : load_key_script(options.keys, sprite.fps());
  if (!script) return script.error();
  if (auto known = check_key_script(sprite, *script); !known) return known.error();
  const std::string name = options.title.empty() ? sprite.data().name : options.title;
  Result<Session> session = Session::open({.title = "vsprite play " + name,
                                           .width = options.width,
                                           .height = options.height,
                                           .fps = sprite.fps(),
                                           .headless = options.headless,
                                           .frames = options.frames,
                                           .keys = options.keys,
                                           .record = options.record,
                                           .renderer = {.dither = true}});
  if (!session) return session.error();
  Result<window::PlayView> view = window::PlayView::make(session->renderer());
  if (!view) return view.error();
  Play run(sprite, *session, options, *mode, std::move(*script));
  while (session->next_frame()) {
    run.frame();
    view->draw(*session, run.sprite(), run.frames(), run.state());
    session->show();
  }
  if (!options.screenshot.empty()) {
    const Image picture = session->renderer().read_pixels();
    if (picture.width > 0) {
      if (auto saved = save_png(options.screenshot, picture); !saved) return saved;
    }
  }
  return session->finish();
}

}  // namespace vsprite
