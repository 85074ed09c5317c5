// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// puppet - characters of a few drawings: a face, a walk and who it was given to, a jump, an arm.
#include <cmath>
#include <filesystem>
#include <map>

#include "arguments.h"
#include "stage.h"
#include "vsprite/session.h"
#include "vsprite/vsprite.h"

using namespace vsprite;
using namespace vsprite::puppet;

namespace {

constexpr int kKeyTab = 9;
struct Words {
  const char *title, *hint;
};
constexpr std::array<Words, kSceneCount> kWords = {{
    {"a face from five drawings", "left, right: turn it     up: astonishment   down: anger"},
    {"five poses of John, one picture of Jayne",
     "right: walk on     left: walk back     down: stop"},
    {"a jump from seven poses", "up: jump     down: crouch"},
    {"an arm of two links", "the mouse, or the arrows, lead the hand"},
}};

using Skins = std::map<const Puppet*, PuppetSkin>;

void draw_ground(Renderer& screen, float walked) {
  screen.draw_shape(box({-2000, kGround}, {4000, 1600}, srgb(0xd9cbb0)));
  screen.draw_shape(box({-2000, kGround}, {4000, kGround + 3}, srgb(0xa8946c)));
  for (int k = -6; k < 24; ++k) {  // pebbles and grass go by
    const float x = static_cast<float>(k) * 88 - std::fmod(walked, 88.0f);
    const auto stone = static_cast<int>(std::floor(walked / 88)) + k;
    const auto size = static_cast<float>(5 + (stone * 37 % 7 + 7) % 7);
    screen.draw_shape(
        {.center = {x, kGround + 34 + static_cast<float>((stone * 53 % 60 + 60) % 60)},
         .half_size = {size * 1.8f, size},
         .radius = size,
         .color = srgb(0xc2b08c)});
  }
}

void draw_shadow(Renderer& screen, float x, float width, float strength) {
  screen.draw_shape({.center = {x, kGround + 4},
                     .half_size = {width, 9},
                     .radius = 9,
                     .feather = 14,
                     .color = srgb(0x5a4a30, strength)});
}

// Where the face stands among its five drawings.
void draw_pad(Renderer& screen, const Stage& stage, const Puppet& face) {
  constexpr Vec2 kCorner{960, 200};
  constexpr float kSide = 200;
  screen.draw_shape(box({kCorner.x - 18, kCorner.y - 18},
                        {kCorner.x + kSide + 18, kCorner.y + kSide + 18}, srgb(0xffffff), 16));
  const auto place = [&](double x, double y) {
    return Vec2{kCorner.x + kSide * static_cast<float>(x),
                kCorner.y + kSide * static_cast<float>(y)};
  };
  const auto& p = face.parameters;
  for (std::size_t k = 0; k + 1 < face.net.centers.size(); k += 2)
    screen.draw_shape(disc(place((face.net.centers[k] - p[0].low) / (p[0].high - p[0].low),
                                 (face.net.centers[k + 1] - p[1].low) / (p[1].high - p[1].low)),
                           8, srgb(0xc9603e)));
  screen.draw_shape(
      disc(place(double{stage.face().x}, double{stage.face().y}), 13, srgb(0x2f6b7a)));
  const TextStyle small{.size = 18, .color = srgb(0x6b5f4d), .align = Align::Center};
  screen.draw_text("astonished", {kCorner.x + kSide / 2, kCorner.y - 52}, small);
  screen.draw_text("angry", {kCorner.x + kSide / 2, kCorner.y + kSide + 28}, small);
  screen.draw_text("turned \xe2\x86\x92", {kCorner.x + kSide / 2, kCorner.y + kSide + 56}, small);
}

// Whose arm it is, softly shaded as the arm is.
void draw_torso(Renderer& screen) {
  const Color ink = srgb(0x3a2a20), skin = srgb(0xe9b189), shade = srgb(0xd2966b),
              hair = srgb(0x6b4227);
  const auto at = [](float x, float y) { return Vec2{kShoulder.x + x, kShoulder.y + y}; };
  const auto soft = [&](Vec2 center, Vec2 half_size, Color color) {
    screen.draw_shape({.center = center,
                       .half_size = half_size,
                       .radius = std::min(half_size.x, half_size.y),
                       .feather = 24,
                       .color = color});
  };
  screen.draw_shape(box(at(-104, -96), at(-40, -20), shade, 24));
  screen.draw_shape(box(at(-190, -46), at(44, 420), srgb(0x3a7a6c), 56));
  screen.draw_shape(disc(at(-84, -160), 78, hair));
  screen.draw_shape(disc(at(2, -136), 10, skin));
  screen.draw_shape(disc(at(-66, -144), 66, skin));
  screen.draw_shape(box(at(-130, -222), at(-26, -188), hair, 17));  // the fringe
  screen.draw_shape(box(at(-136, -206), at(-104, -146), hair, 16));
  screen.draw_shape(disc(at(-98, -138), 13, shade));
  screen.draw_shape(disc(at(-96, -138), 10, skin));
  screen.draw_shape(disc(at(-36, -148), 6, ink));
  screen.draw_shape(line(at(-48, -168), at(-26, -170), 5, hair));
  screen.draw_shape(line(at(-36, -110), at(-26, -105), 4, srgb(0x9c4a3a)));
  screen.draw_shape(line(at(-26, -105), at(-14, -110), 4, srgb(0x9c4a3a)));
  soft(at(-56, -118), {18, 14}, srgb(0xe07060, 0.35f));
}

void draw_scene(Renderer& screen, const Stage& stage, const Skins& skins, const Puppet& face) {
  const Scene scene = stage.scene;
  screen.clear(srgb(scene == Scene::Face ? 0xf0e6d6 : 0xdcebee));
  if (scene == Scene::Face) draw_pad(screen, stage, face);
  if (scene == Scene::Walk || scene == Scene::Jump)
    draw_ground(screen, scene == Scene::Walk ? stage.walked() : 0);
  for (const Character& c : stage.characters(scene)) {
    if (scene == Scene::Walk) draw_shadow(screen, c.at.x, 62, 0.35f);
    if (scene == Scene::Jump) {
      const float height = std::max(0.0f, kGround - c.at.y - 150) / 300;
      draw_shadow(screen, c.at.x, 62 - 24 * std::min(1.0f, height), 0.35f);
    }
  }
  if (scene == Scene::Arm) {
    draw_torso(screen);
    screen.draw_shape(disc(stage.target(), 26, srgb(0xd0493f)));
    screen.draw_shape(disc({stage.target().x - 8, stage.target().y - 9}, 7, srgb(0xffffff, 0.6f)));
  }
  for (const Character& c : stage.characters(scene))
    screen.draw_puppet(*c.puppet, c.pose, skins.at(c.puppet), c.at, c.scale);
}

void draw_words(Renderer& screen, Scene scene) {
  const Words& words = kWords[static_cast<std::size_t>(scene)];
  const Color ink = srgb(0x4a4034);
  screen.draw_text(words.title, {40, 28}, {.size = 30, .color = ink});
  const Vec2 size = measure_text(words.hint, {.size = 20});
  screen.draw_shape(box({26, 666}, {54 + size.x, 706}, srgb(0xffffff, 0.7f), 20));
  screen.draw_text(words.hint, {40, 674}, {.size = 20, .color = ink});
  for (int k = 0; k < kSceneCount; ++k) {
    const float x = 1080 + 46 * static_cast<float>(k);
    const bool is_here = k == static_cast<int>(scene);
    screen.draw_shape(disc({x, 46}, 18, is_here ? srgb(0x2f6b7a) : srgb(0xffffff, 0.7f)));
    screen.draw_text(std::to_string(k + 1), {x, 36},
                     {.size = 20, .color = is_here ? srgb(0xffffff) : ink, .align = Align::Center});
  }
}

Camera camera_for(const Renderer& screen) {
  const auto width = static_cast<float>(screen.width()),
             height = static_cast<float>(screen.height());
  const float scale = std::max(0.01f, std::min(width / kStage.x, height / kStage.y));
  return {.scale = scale,
          .offset = {(width - scale * kStage.x) / 2, (height - scale * kStage.y) / 2}};
}

void change_scene(Stage& stage, const Input& input) {
  for (int k = 0; k < kSceneCount; ++k)
    if (input.was_pressed('1' + k)) stage.scene = static_cast<Scene>(k);
  if (input.was_pressed(kKeyTab))
    stage.scene = static_cast<Scene>((static_cast<int>(stage.scene) + 1) % kSceneCount);
}

// In stage px, if the mouse has moved or is held.
std::optional<Vec2> pointer_of(Session& session, Vec2& last) {
  const Vec2 now = session.input().pointer;
  if (now == last && !session.input().pointer_held) return std::nullopt;
  last = now;
  const Vec2 at = session.renderer().frame_from_window(now);
  const Camera camera = camera_for(session.renderer());
  return Vec2{(at.x - camera.offset.x) / camera.scale, (at.y - camera.offset.y) / camera.scale};
}

Result<void> run_puppet(const games::Arguments& arguments, int scene) {
  const Result<std::vector<Puppet>> puppets = load_puppets(arguments.pack);
  if (!puppets) return puppets.error();
  const Result<Cast> cast = find_cast(*puppets, arguments.pack);
  if (!cast) return cast.error();
  Result<Session> session =
      Session::open(games::session_config("puppet", kTicksPerSecond, arguments));
  if (!session) return session.error();

  Renderer& screen = session->renderer();
  Skins skins;
  for (const Puppet& puppet : *puppets) {
    const Result<PuppetSkin> skin = screen.make_skin(puppet);
    if (!skin) return skin.error();
    skins[&puppet] = *skin;
  }
  Stage stage(*cast);
  stage.scene = static_cast<Scene>(scene - 1);
  Vec2 pointer = session->input().pointer;
  while (session->next_frame()) {
    change_scene(stage, session->input());
    Held keys;
    const std::optional<Vec2> reach = pointer_of(*session, pointer);
    while (session->next_tick()) {
      keys = held(session->direction());
      keys.pointer = reach;
      stage.step(keys);
    }
    screen.set_camera(camera_for(screen));
    draw_scene(screen, stage, skins, *cast->face);
    draw_words(screen, stage.scene);
    session->show();
    if (session->input().was_pressed(kKeyEscape)) session->close();
  }
  return session->finish();
}

// puppets.vsp, which the build draws: here, or beside or above the program.
std::string find_pack() {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path folder = program.parent_path();
  for (const std::filesystem::path& place :
       {std::filesystem::path("puppets.vsp"), folder / "puppets.vsp",
        folder.parent_path() / "puppets.vsp"})
    if (std::filesystem::is_regular_file(place, ignored)) return place.string();
  return "puppets.vsp";
}

}  // namespace

int main(int argc, char** argv) {
  // --scene is this game's own; the rest is every game's.
  int scene = 1;
  std::vector<char*> rest;
  for (int i = 0; i < argc; ++i) {
    if (std::string_view(argv[i]) != "--scene") {
      if (std::string_view(argv[i]) == "--help" || std::string_view(argv[i]) == "-h")
        std::printf("puppet: PACK is one of draw_puppets; --scene N opens with scene 1 to 4\n\n");
      rest.push_back(argv[i]);
      continue;
    }
    const std::string_view number = i + 1 < argc ? argv[++i] : "nothing";
    if (number.size() != 1 || number[0] < '1' || number[0] > '4') {
      std::fprintf(stderr, "puppet: error: --scene: %s was given, a number from 1 to 4 is due\n",
                   std::string(number).c_str());
      return 2;
    }
    scene = number[0] - '0';
  }
  return games::run(static_cast<int>(rest.size()), rest.data(), "puppet", find_pack(),
                    [&](const games::Arguments& a) { return run_puppet(a, scene); });
}
