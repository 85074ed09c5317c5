// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// puppet_sheets FOLDER: the memo's figures 2, 3, 6 and 7 and the arm, as contact sheets. Framed
// pictures are the examples.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "puppet/art.h"
#include "vsprite/compose.h"

namespace {

using namespace vsprite;

constexpr std::uint8_t kPaper[3] = {244, 240, 232};

class Sheet {
 public:
  Sheet(int columns, int rows, int width, int height)
      : width_(width),
        height_(height),
        canvas_(make_image(columns * width, rows * height, kPaper[0], kPaper[1], kPaper[2])) {}

  void cell(const Puppet& puppet, const std::vector<double>& at, int column, int row, Vec2 shift,
            float scale, bool framed, bool own_path) {
    if (framed) frame(column, row);
    PuppetPose pose = make_pose(puppet);
    pose_puppet(puppet, at, pose);
    const Vec2 corner{static_cast<float>(column * width_), static_cast<float>(row * height_)};
    const Vec2 center = own_path ? pose.center : Vec2{};
    Image one = make_image(width_, height_, 0, 0, 0, 0);
    render_puppet(puppet, pose, painter_, one,
                  {scale * center.x + shift.x, scale * center.y + shift.y}, scale);
    draw_picture(canvas_, one, corner);
  }
  bool write(const std::string& path) const {
    const auto bytes = encode_png(canvas_);
    std::ofstream file(path, std::ios::binary);
    if (bytes)
      file.write(reinterpret_cast<const char*>(bytes->data()),
                 static_cast<std::streamsize>(bytes->size()));
    return bytes && file.good();
  }

 private:
  void frame(int column, int row) {
    const Image red = make_image(width_ - 8, height_ - 8, 201, 96, 62),
                paper = make_image(width_ - 14, height_ - 14, kPaper[0], kPaper[1], kPaper[2]);
    const auto x = static_cast<float>(column * width_), y = static_cast<float>(row * height_);
    draw_picture(canvas_, red, {x + 4, y + 4});
    draw_picture(canvas_, paper, {x + 7, y + 7});
  }
  int width_, height_;
  Image canvas_;
  PuppetPainter painter_;
};

std::vector<double> phase(double p) {
  return {std::cos(2 * std::numbers::pi * p), std::sin(2 * std::numbers::pi * p)};
}

bool face_sheet(const std::string& folder) {
  const auto puppets = fit_puppets(puppet_art::face_views());
  if (!puppets) return std::fprintf(stderr, "%s\n", puppets.error().message.c_str()), false;
  Sheet sheet(5, 5, 176, 198);
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column) {
      const bool corner = (row == 0 || row == 4) && (column == 0 || column == 4);
      sheet.cell((*puppets)[0], {9.0 * column, row / 4.0}, column, row, {0, 0}, 0.55f,
                 corner || (row == 2 && column == 2), true);
    }
  return sheet.write(folder + "/face.png");
}

bool walk_sheets(const std::string& folder) {
  const auto puppets = fit_puppets(puppet_art::walk_views());
  if (!puppets) return std::fprintf(stderr, "%s\n", puppets.error().message.c_str()), false;
  for (std::size_t who = 0; who < 2; ++who) {
    Sheet sheet(7, 2, 180, 250);
    for (int k = 0; k < 14; ++k) {
      const double p = k / 14.0;
      bool example = false;
      for (int e = 0; e < 5; ++e) example |= std::lround(14 * e / 5.0) == k;
      // The examples lie at fifths; the nearest of the 14 frames are shown at the fifth itself.
      double at = p;
      if (example) at = std::round(5 * p) / 5;
      sheet.cell((*puppets)[who], phase(at), k % 7, k / 7, {-22, -2}, 0.75f,
                 who == 0 ? example : k == 0, true);
    }
    if (!sheet.write(folder + (who == 0 ? "/john.png" : "/jayne.png"))) return false;
  }
  return true;
}

bool jump_sheet(const std::string& folder) {
  const auto puppets = fit_puppets(puppet_art::jump_views());
  if (!puppets) return std::fprintf(stderr, "%s\n", puppets.error().message.c_str()), false;
  Sheet sheet(11, 1, 196, 352);
  for (int k = 0; k <= 10; ++k)
    sheet.cell((*puppets)[0], {k / 10.0}, k, 0, {-30, 84}, 0.75f,
               k != 1 && k != 4 && k != 6 && k != 9, true);
  return sheet.write(folder + "/jump.png");
}

bool arm_sheet(const std::string& folder) {
  const auto puppets = fit_puppets(puppet_art::arm_views());
  if (!puppets) return std::fprintf(stderr, "%s\n", puppets.error().message.c_str()), false;
  Sheet sheet(5, 3, 230, 230);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 5; ++column)
      sheet.cell((*puppets)[0], {-2.6 + row * 2.0, -2.3 + 2.3 * column / 4.0}, column, row, {1, 1},
                 0.38f, false, true);
  return sheet.write(folder + "/arm.png");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: puppet_sheets FOLDER\n", stderr);
    return 2;
  }
  std::error_code error;
  std::filesystem::create_directories(argv[1], error);
  const std::string folder = argv[1];
  bool good = face_sheet(folder);
  good &= walk_sheets(folder);
  good &= jump_sheet(folder);
  good &= arm_sheet(folder);
  return good ? 0 : 74;
}
