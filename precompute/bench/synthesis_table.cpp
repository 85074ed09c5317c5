// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// synthesis_table [FOLDER]: how far off made views are, for each kernel beside linear interpolation
// and the nearest view; the truth is drawn. With FOLDER also the memo's Fig. 8 as pictures.
//
// Every subject is given a grid of views. "left out": each view whose parameters lie inside the
// hull of the others is predicted from the others. "between": 60 seeded parameters, all views.
// Points: root mean square, px; pictures: mean absolute difference of premultiplied RGBA over the
// box of both, percent of full scale.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>

#include "puppet/art.h"
#include "puppet/brush.h"
#include "support/wire_cube.h"
#include "synthesis/delaunay.h"
#include "vsprite/compose.h"
#include "vsprite/random.h"

namespace {

using namespace vsprite;
using namespace vsprite::puppet_art;

// A subject: a set of views, and the truth at any parameter.
struct Subject {
  std::string name;
  ViewSet set;
  std::function<View(const std::vector<double>&)> truth;
  std::function<std::vector<double>(Random&)> somewhere;
};

// A textured box, turned and tilted: a rendered 3-D object in perspective.
View draw_box(double yaw, double pitch) {
  const auto project = [&](double x, double y, double z) {
    const double xx = std::cos(yaw) * x - std::sin(yaw) * z,
                 zz = std::cos(yaw) * z + std::sin(yaw) * x;
    const double yy = std::cos(pitch) * y - std::sin(pitch) * zz,
                 d = std::cos(pitch) * zz + std::sin(pitch) * y;
    const double s = 420 / (5 + d);
    return Vec2{static_cast<float>(150 + s * xx), static_cast<float>(150 + s * yy)};
  };
  View view;
  view.at = {yaw, pitch};
  Canvas canvas(300, 300);
  const std::uint32_t colors[3][2] = {
      {0xd98a3d, 0xf6d08a}, {0x4f86b8, 0xbcd9ee}, {0x7a9a4e, 0xd7e6b0}};
  // Faces towards the viewer: front (z = -1), left (x = -1 turns into view), top (y = -1).
  for (int f = 0; f < 3; ++f) {
    const auto at = [&](double u, double v) {
      return f == 0 ? project(u, v, -1) : f == 1 ? project(1, v, u) : project(u, -1, -v);
    };
    canvas.fill({at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)}, flat(colors[f][0]));
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        if ((i + j) % 2 == 0) {
          const double u = -1 + 0.5 * i, v = -1 + 0.5 * j;
          canvas.fill({at(u, v), at(u + 0.5, v), at(u + 0.5, v + 0.5), at(u, v + 0.5)},
                      flat(colors[f][1]));
        }
    for (int i = 0; i <= 4; ++i)
      for (int j = 0; j <= 4; ++j)
        view.points.push_back(
            at(0.999 * (-1 + 0.5 * i), 0.999 * (-1 + 0.5 * j)));  // apart at edges
  }
  view.picture = canvas.picture();
  return view;
}

std::vector<Subject> make_subjects() {
  std::vector<Subject> out;
  const auto uniform = [](Random& r, double a, double b) { return a + (b - a) * r.unit(); };

  Subject face{"face", face_views(),
               [](const std::vector<double>& at) { return draw_face(at[0], at[1]); },
               [uniform](Random& r) {
                 return std::vector{uniform(r, 0, 36), uniform(r, 0, 1)};
               }};
  face.set.views.clear();
  for (const double rotation : {0.0, 12.0, 24.0, 36.0})
    for (const double expression : {0.0, 0.5, 1.0})
      face.set.views.push_back(draw_face(rotation, expression));
  out.push_back(std::move(face));

  const auto phase_of = [](const std::vector<double>& at) {
    return std::atan2(at[1], at[0]) / (2 * std::numbers::pi);
  };
  Subject walk{"walk", walk_views(),
               [phase_of](const std::vector<double>& at) { return draw_walk(phase_of(at)); },
               [](Random& r) {
                 const double a = 2 * std::numbers::pi * r.unit();
                 return std::vector{std::cos(a), std::sin(a)};
               }};
  walk.set.characters.clear();
  const View first = walk.set.views[0];
  walk.set.views.clear();
  for (int k = 0; k < 10; ++k) walk.set.views.push_back(draw_walk(k / 10.0));
  for (View& view : walk.set.views)
    view.picture = first.picture, view.texture_points = first.texture_points;
  out.push_back(std::move(walk));

  Subject arm{"arm", arm_views(),
              [](const std::vector<double>& at) { return draw_arm(at[0], at[1]); },
              [uniform](Random& r) {
                return std::vector{uniform(r, -2.6, 1.4), uniform(r, -2.3, 0)};
              }};
  arm.set.views.clear();
  for (const double a : {-2.6, -1.2667, 0.0667, 1.4})
    for (const double e : {0.0, -0.7667, -1.5333, -2.3}) arm.set.views.push_back(draw_arm(a, e));
  out.push_back(std::move(arm));

  Subject box{"3-D box",
              {},
              [](const std::vector<double>& at) { return draw_box(at[0], at[1]); },
              [uniform](Random& r) {
                return std::vector{uniform(r, 0.3, 1.2), uniform(r, -0.9, -0.3)};
              }};
  box.set.name = "box", box.set.parameters = {{"yaw", 0.3, 1.2, 0}, {"pitch", -0.9, -0.3, 0}};
  for (const double yaw : {0.3, 0.6, 0.9, 1.2})
    for (const double pitch : {-0.9, -0.6, -0.3}) box.set.views.push_back(draw_box(yaw, pitch));
  for (std::uint32_t f = 0; f < 3; ++f)
    for (std::uint32_t i = 0; i < 4; ++i)
      for (std::uint32_t j = 0; j < 4; ++j) {
        const std::uint32_t a = 25 * f + 5 * i + j;
        box.set.faces.push_back({{a, a + 5, a + 6, a + 1}, 4});
      }
  out.push_back(std::move(box));
  int k = 0;
  for (Subject& s : out)
    for (View& view : s.set.views) view.name = s.name + " " + std::to_string(++k);
  return out;
}

// Shares of the views at a place: the RBF's, or those of an interpolation.
enum class Method { Linear, Gaussian, ThinPlate, Multiquadric, Triangles, Nearest };
constexpr const char* kNames[] = {"linear kernel",        "gaussian",
                                  "thin-plate",           "multiquadric",
                                  "linear interpolation", "nearest view"};

double wrap_distance(const ViewSet& set, const std::vector<double>& a,
                     const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t d = 0; d < a.size(); ++d) {
    const double range =
        set.parameters.empty() ? 1 : set.parameters[d].high - set.parameters[d].low;
    sum += std::pow((a[d] - b[d]) / range, 2);
  }
  return sum;
}

// Piecewise linear weights over the Delaunay triangles of the parameters; round the circle, between
// the two neighbours.
std::vector<double> linear_weights(const Subject& subject, const std::vector<View>& views,
                                   const std::vector<double>& at) {
  std::vector<double> out(views.size(), 0);
  if (subject.name == "walk") {
    double best_below = HUGE_VAL, best_above = HUGE_VAL;
    std::size_t below = 0, above = 0;
    const double a = std::atan2(at[1], at[0]), turn = 2 * std::numbers::pi;
    for (std::size_t v = 0; v < views.size(); ++v) {
      const double gap = a - std::atan2(views[v].at[1], views[v].at[0]);
      const double down = gap - turn * std::floor(gap / turn), up = turn - down;
      if (down < best_below) best_below = down, below = v;
      if (up < best_above) best_above = up, above = v;
    }
    out[below] += best_above / (best_above + best_below);
    out[above] += best_below / (best_above + best_below);
    return out;
  }
  std::vector<Vec2> places;
  const auto place = [&](const std::vector<double>& x) {
    const PuppetParameter &p = subject.set.parameters[0], &q = subject.set.parameters[1];
    return Vec2{static_cast<float>(1000 * (x[0] - p.low) / (p.high - p.low)),
                static_cast<float>(1000 * (x[1] - q.low) / (q.high - q.low))};
  };
  for (const View& view : views) places.push_back(place(view.at));
  const Vec2 p = place(at);
  double least = HUGE_VAL;
  for (const Face& f : triangulate(places)) {
    const Vec2 a = places[f.corners[0]], b = places[f.corners[1]], c = places[f.corners[2]];
    const double area = double{b.x - a.x} * (c.y - a.y) - double{b.y - a.y} * (c.x - a.x);
    const double wb = (double{p.x - a.x} * (c.y - a.y) - double{p.y - a.y} * (c.x - a.x)) / area;
    const double wc = (double{b.x - a.x} * (p.y - a.y) - double{b.y - a.y} * (p.x - a.x)) / area;
    const double outside = std::max({0.0, -wb, -wc, wb + wc - 1});
    if (outside >= least) continue;
    least = outside;
    std::fill(out.begin(), out.end(), 0.0);
    out[f.corners[0]] = 1 - wb - wc, out[f.corners[1]] = wb, out[f.corners[2]] = wc;
  }
  return out;
}

struct Off {
  double points = 0, pictures = 0;
  int count = 0;
};

double picture_difference(const Image& a, const Image& b) {
  int x0 = a.width, x1 = 0, y0 = a.height, y1 = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const auto i = static_cast<std::size_t>(4 * (y * a.width + x));
      if (a.rgba[i + 3] + b.rgba[i + 3] == 0) continue;
      x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
  double sum = 0;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      for (int c = 0; c < 4; ++c) {
        const auto i = static_cast<std::size_t>(4 * (y * a.width + x) + c);
        sum += std::abs(a.rgba[i] - b.rgba[i]);
      }
  return 100 * sum / (255.0 * 4 * (x1 - x0 + 1) * (y1 - y0 + 1));
}

constexpr int kCanvas = 640;

// The truth's picture: of parts laid apart, the mesh at its true points.
Image true_picture(const Subject& subject, const Puppet& puppet, const View& truth,
                   PuppetPainter& painter) {
  Image canvas = make_image(kCanvas, kCanvas, 0, 0, 0, 0);
  if (truth.texture_points.empty() && truth.picture.width > 0) {
    Image picture = truth.picture;
    premultiply(picture);
    draw_picture(canvas, picture, {0, 0});
    return canvas;
  }
  Puppet own = puppet;
  if (subject.name == "arm") {
    own.views = {{truth.picture, truth.texture_points, {}}};
    premultiply(own.views[0].picture);
    own.net.outputs -= static_cast<int>(puppet.views.size()) - 1;
    own.net.weights.assign(static_cast<std::size_t>(own.net.center_count() * own.net.outputs), 0);
    own.net.polynomial.assign(static_cast<std::size_t>(own.net.term_count() * own.net.outputs), 0);
    own = std::move(*make_puppet(std::move(own)));
  }
  PuppetPose pose = make_pose(own);
  pose.points = truth.points;
  for (std::size_t i = 0; i < pose.depth.size(); ++i) pose.depth[i] = subject.set.depth[i];
  render_puppet(own, pose, painter, canvas, {0, 0});
  return canvas;
}

void measure(const Subject& subject, Method method, const std::vector<View>& views,
             const std::vector<double>& at, Off& off) {
  ViewSet set = subject.set;
  set.views = views;
  RbfConfig config = choose_config(set);
  config.pseudo_inverse = false;
  if (method <= Method::Multiquadric) {
    config.kernel = static_cast<Kernel>(method);
    config.degree = method == Method::Linear ? 0 : 1;
    config.width = method == Method::Gaussian ? 0.8 : 0.5;
  }
  if (subject.name == "walk") config.width *= 2;
  set.rbf = config;
  const auto puppets = fit_puppets(set);
  if (!puppets) {
    std::fprintf(stderr, "%s\n", puppets.error().message.c_str());
    std::exit(1);
  }
  const Puppet& puppet = (*puppets)[0];
  PuppetPose pose = make_pose(puppet);
  pose_puppet(puppet, at, pose);
  if (method >= Method::Triangles) {
    std::vector<double> weights(views.size(), 0);
    if (method == Method::Triangles) {
      weights = linear_weights(subject, views, at);
    } else {
      std::size_t best = 0;
      for (std::size_t v = 0; v < views.size(); ++v)
        if (wrap_distance(subject.set, views[v].at, at) <
            wrap_distance(subject.set, views[best].at, at))
          best = v;
      weights[best] = 1;
    }
    pose.center = {};
    std::fill(pose.points.begin(), pose.points.end(), Vec2{});
    for (std::size_t v = 0; v < views.size(); ++v) {
      const auto w = static_cast<float>(weights[v]);
      pose.shares[v] = w;
      for (std::size_t i = 0; i < pose.points.size(); ++i)
        pose.points[i] = {pose.points[i].x + w * views[v].points[i].x,
                          pose.points[i].y + w * views[v].points[i].y};
    }
  }
  const View truth = subject.truth(at);
  double sum = 0;
  for (std::size_t i = 0; i < truth.points.size(); ++i)
    sum += std::pow(double{pose.points[i].x} + pose.center.x - truth.points[i].x, 2) +
           std::pow(double{pose.points[i].y} + pose.center.y - truth.points[i].y, 2);
  off.points += sum / static_cast<double>(truth.points.size());
  PuppetPainter painter;
  Image drawn = make_image(kCanvas, kCanvas, 0, 0, 0, 0);
  render_puppet(puppet, pose, painter, drawn, pose.center);
  off.pictures += picture_difference(drawn, true_picture(subject, puppet, truth, painter));
  ++off.count;
}

bool inside_others(const Subject& subject, std::size_t left_out) {
  if (subject.name == "walk") return true;  // round the circle every view has neighbours
  Examples e{.dims = 2, .outputs = 1, .x = {}, .y = {}};
  for (std::size_t v = 0; v < subject.set.views.size(); ++v)
    if (v != left_out)
      e.x.insert(e.x.end(), subject.set.views[v].at.begin(), subject.set.views[v].at.end());
  RbfNetwork net;
  net.dims = 2, net.outputs = 1, net.hull = e.x;
  std::vector<double> at = subject.set.views[left_out].at;
  return clamp_to_hull(net, at) < 1e-9;
}

void table() {
  std::printf("%-9s %-21s %22s %22s\n", "", "", "left out: px, picture %",
              "between: px, picture %");
  for (Subject& subject : make_subjects()) {
    if (!subject.set.links.empty()) {  // their angles are the parameters
      subject.set.parameters = {{"upper", -2.6, 1.4, 0}, {"forearm", -2.3, 0, 0}};
      for (View& view : subject.set.views) view.at.clear();
      int k = 0;
      for (const double a : {-2.6, -1.2667, 0.0667, 1.4})
        for (const double e : {0.0, -0.7667, -1.5333, -2.3})
          subject.set.views[static_cast<std::size_t>(k++)].at = {a, e};
    }
    for (int m = 0; m < 6; ++m) {
      const auto method = static_cast<Method>(m);
      Off left_out, between;
      for (std::size_t v = 0; v < subject.set.views.size(); ++v) {
        if (!inside_others(subject, v)) continue;
        std::vector<View> others = subject.set.views;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(v));
        measure(subject, method, others, subject.set.views[v].at, left_out);
      }
      Random random{21};
      for (int k = 0; k < 60; ++k)
        measure(subject, method, subject.set.views, subject.somewhere(random), between);
      std::printf("%-9s %-21s %12.2f %9.2f %12.2f %9.2f\n", subject.name.c_str(), kNames[m],
                  std::sqrt(left_out.points / left_out.count), left_out.pictures / left_out.count,
                  std::sqrt(between.points / between.count), between.pictures / between.count);
    }
  }
}

// Rows: the truth, control points, pixels by three kernels; columns: views from one to the next.
void draw_fig8(const std::string& path) {
  const RbfConfig kernels[3] = {{.kernel = Kernel::Gaussian, .degree = -1, .width = 0.1},
                                {.kernel = Kernel::Gaussian, .degree = -1, .width = 0.35},
                                {.kernel = Kernel::Multiquadric, .degree = 0, .width = 0.3}};
  const auto points = fit_rbf(wire_cube::examples(false), {});
  std::vector<RbfNetwork> pixels;
  for (const RbfConfig& k : kernels) pixels.push_back(*fit_rbf(wire_cube::examples(true), k));
  constexpr int kColumns = 9, kSide = wire_cube::kSide;
  Image sheet = make_image(kColumns * kSide, 5 * kSide, 0, 0, 0);
  for (int column = 0; column < kColumns; ++column) {
    const std::array<double, 2> at{0.35 * column / 2, 0.15 + 0.35 * column / 4};
    for (int row = 0; row < 5; ++row) {
      const auto picture =
          row == 0   ? wire_cube::draw(wire_cube::corners(at[0], at[1]))
          : row == 1 ? wire_cube::draw(wire_cube::to_corners(wire_cube::predicted(*points, at)))
                     : wire_cube::predicted(pixels[static_cast<std::size_t>(row - 2)], at);
      for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
          const double v = std::clamp(picture[static_cast<std::size_t>(y * kSide + x)], 0.0, 1.0);
          std::uint8_t* p = &sheet.rgba[static_cast<std::size_t>(
              4 * ((row * kSide + y) * sheet.width + column * kSide + x))];
          p[0] = p[1] = p[2] = static_cast<std::uint8_t>(255 * v);
        }
    }
  }
  const auto bytes = encode_png(sheet);
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes->data()),
             static_cast<std::streamsize>(bytes->size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) draw_fig8(std::string(argv[1]) + "/pixels.png");
  if (argc < 2) table();
  return 0;
}
