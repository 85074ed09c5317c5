// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// SVG 1.1, sections 7 (transforms, viewBox), 8.3 (path data), 9 (basic shapes), as far as the
// places of nodes need them. pugixml reads the XML.
#include "tool/svg_points.h"

#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <pugixml.hpp>
#include <string_view>

namespace vsprite {
namespace {

struct Place {
  double x = 0, y = 0;
};

/// x' = a x + c y + e, y' = b x + d y + f.
struct Matrix {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  Place operator()(Place p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
  Matrix operator*(const Matrix& m) const {
    return {a * m.a + c * m.b, b * m.a + d * m.b,     a * m.c + c * m.d,
            b * m.c + d * m.d, a * m.e + c * m.f + e, b * m.e + d * m.f + f};
  }
};

/// Numbers of path data, apart by blanks, commas, signs, or nothing at all (`1.5.5`).
class Numbers {
 public:
  explicit Numbers(std::string_view text) : rest_(text) {}

  void skip() {
    while (!rest_.empty() &&
           std::string_view(" \t\r\n\f,").find(rest_[0]) != std::string_view::npos)
      rest_.remove_prefix(1);
  }
  bool at_end() {
    skip();
    return rest_.empty();
  }
  bool at_letter() {
    skip();
    return !rest_.empty() && ((rest_[0] | 32) >= 'a' && (rest_[0] | 32) <= 'z');
  }
  char letter() {
    const char found = rest_[0];
    rest_.remove_prefix(1);
    return found;
  }
  bool take(double& value) {
    skip();
    if (!rest_.empty() && rest_[0] == '+') rest_.remove_prefix(1);
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc{} || !(std::abs(value) < 1e9)) return false;
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }
  /// 0 or 1, which need nothing between them and what follows.
  bool take_flag() {
    skip();
    if (rest_.empty() || (rest_[0] != '0' && rest_[0] != '1')) return false;
    rest_.remove_prefix(1);
    return true;
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

using Nodes = std::vector<Place>;

/// Appends the nodes of one subpath, without a last one that lies on its first.
void close_run(Nodes& run, Nodes& out) {
  if (run.size() > 1 && std::hypot(run.back().x - run[0].x, run.back().y - run[0].y) < 1e-6)
    run.pop_back();
  out.insert(out.end(), run.begin(), run.end());
  run.clear();
}

/// How many numbers a command takes; -1: it is none.
int count_of(char command) {
  switch (command | 32) {
    case 'm':
    case 'l':
    case 't':
      return 2;
    case 'h':
    case 'v':
      return 1;
    case 's':
    case 'q':
      return 4;
    case 'c':
      return 6;
    case 'a':
      return 7;
    case 'z':
      return 0;
    default:
      return -1;
  }
}

/// Path data [8.3]. The sentence of what is wrong, or none.
std::optional<std::string> take_path(std::string_view text, Nodes& out) {
  Numbers from(text);
  Nodes run;
  Place now, start;
  char command = 0;
  bool moved = false;
  while (!from.at_end()) {
    if (from.at_letter())
      command = from.letter();
    else if (command == 0 || (command | 32) == 'z')
      return "a command is due where `" + std::string(from.rest().substr(0, 12)) + "` stands";
    else if ((command | 32) == 'm')
      command = command == 'm' ? 'l' : 'L';  // what follows a move without a letter are lines
    const int count = count_of(command);
    if (count < 0) return "`" + std::string(1, command) + "` is no command";
    if (!moved && (command | 32) != 'm') return std::string("it has to begin with M or m");
    moved = true;
    double n[7] = {};
    for (int k = 0; k < count; ++k) {
      const bool is_flag = count == 7 && (k == 3 || k == 4);
      if (is_flag ? !from.take_flag() : !from.take(n[k]))
        return "`" + std::string(1, command) + "` needs " + std::to_string(count) +
               " numbers, something else stands at `" + std::string(from.rest().substr(0, 12)) +
               "`";
    }
    const bool is_relative = command >= 'a';
    Place to = is_relative ? now : Place{};
    switch (command | 32) {
      case 'z':
        close_run(run, out);
        now = start;
        continue;
      case 'h':
        to = {to.x + n[0], now.y};
        break;
      case 'v':
        to = {now.x, to.y + n[0]};
        break;
      default:
        to = {to.x + n[count - 2], to.y + n[count - 1]};
    }
    if ((command | 32) == 'm') {
      close_run(run, out);
      start = to;
    } else if (run.empty()) {
      run.push_back(now);  // after a z without a new move
    }
    now = to;
    run.push_back(to);
  }
  close_run(run, out);
  return std::nullopt;
}

/// transform="..." [7.6].
std::optional<Matrix> take_transform(std::string_view text) {
  Matrix out;
  Numbers from(text);
  while (!from.at_end()) {
    std::string name;
    while (from.at_letter()) name += from.letter();
    const std::size_t open =
        text.find('(', static_cast<std::size_t>(from.rest().data() - text.data()));
    const std::size_t close = text.find(')', open);
    if (close == std::string_view::npos) return std::nullopt;
    Numbers inner(text.substr(open + 1, close - open - 1));
    std::vector<double> n;
    while (!inner.at_end()) {
      double value = 0;
      if (!inner.take(value)) return std::nullopt;
      n.push_back(value);
    }
    const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180; };
    Matrix m;
    if (name == "matrix" && n.size() == 6) {
      m = {n[0], n[1], n[2], n[3], n[4], n[5]};
    } else if (name == "translate" && (n.size() == 1 || n.size() == 2)) {
      m.e = n[0], m.f = n.size() == 2 ? n[1] : 0;
    } else if (name == "scale" && (n.size() == 1 || n.size() == 2)) {
      m.a = n[0], m.d = n.back();
    } else if (name == "rotate" && (n.size() == 1 || n.size() == 3)) {
      const double c = std::cos(radians(n[0])), s = std::sin(radians(n[0]));
      m = {c, s, -s, c, 0, 0};
      if (n.size() == 3) m = Matrix{1, 0, 0, 1, n[1], n[2]} * m * Matrix{1, 0, 0, 1, -n[1], -n[2]};
    } else if (name == "skewX" && n.size() == 1) {
      m.c = std::tan(radians(n[0]));
    } else if (name == "skewY" && n.size() == 1) {
      m.b = std::tan(radians(n[0]));
    } else {
      return std::nullopt;
    }
    out = out * m;
    from = Numbers(text.substr(close + 1));
  }
  return out;
}

/// A length of the page in px at 96 an inch; none for %, em and the like.
std::optional<double> length_of(std::string_view text) {
  Numbers from(text);
  double value = 0;
  if (!from.take(value)) return std::nullopt;
  const std::string_view unit = from.rest();
  if (unit.empty() || unit == "px") return value;
  if (unit == "in") return value * 96;
  if (unit == "mm") return value * 96 / 25.4;
  if (unit == "cm") return value * 96 / 2.54;
  if (unit == "pt") return value * 96 / 72;
  if (unit == "pc") return value * 16;
  return std::nullopt;
}

class Reader {
 public:
  Reader(const std::string& path, int width, int height)
      : path_(path), width_(width), height_(height) {}

  Result<std::vector<Vec2>> read(const pugi::xml_node& root) {
    const std::optional<Matrix> page = page_of(root);
    if (!page) return fault_;
    if (!take(root, *page)) return fault_;
    if (points_.empty())
      return bad("no path is in it: the nodes of paths, in order, become the control points");
    return points_;
  }

 private:
  Error bad(const std::string& what) const { return {ErrorCode::BadContent, path_ + ": " + what}; }

  /// From the units of the root to px of the picture.
  std::optional<Matrix> page_of(const pugi::xml_node& root) {
    double box[4] = {0, 0, 0, 0};
    if (const std::string_view text = root.attribute("viewBox").as_string(); !text.empty()) {
      Numbers from(text);
      for (double& n : box)
        if (!from.take(n)) box[2] = 0;
      if (!(box[2] > 0) || !(box[3] > 0)) {
        fault_ = bad("viewBox: `" + std::string(text) +
                     "`: four numbers, the last two above 0, "
                     "are due");
        return std::nullopt;
      }
    } else {
      box[2] = length_of(root.attribute("width").as_string()).value_or(width_);
      box[3] = length_of(root.attribute("height").as_string()).value_or(height_);
    }
    const double across = width_ / box[2], down = height_ / box[3];
    if (!(box[2] > 0) || !(box[3] > 0) || std::abs(across / down - 1) > 0.01) {
      fault_ = bad("its page of " + text_of(box[2]) + " x " + text_of(box[3]) +
                   " has another shape than the picture of " + std::to_string(width_) + " x " +
                   std::to_string(height_) + " px: the page has to lie over the picture");
      return std::nullopt;
    }
    return Matrix{across, 0, 0, down, -box[0] * across, -box[1] * down};
  }

  bool take(const pugi::xml_node& node, const Matrix& outer, int depth = 0) {
    if (depth > 200) {
      fault_ = bad("groups lie more than 200 deep in each other");
      return false;
    }
    for (const pugi::xml_node& each : node.children()) {
      const std::string name = local_name(each.name());
      if (name == "defs" || name == "clipPath" || name == "mask" || name == "symbol" ||
          name == "pattern" || name == "marker")
        continue;
      if (std::string_view(each.attribute("display").as_string()) == "none" ||
          std::string_view(each.attribute("style").as_string()).find("display:none") !=
              std::string_view::npos)
        continue;
      const auto own = take_transform(each.attribute("transform").as_string());
      if (!own) {
        fault_ = bad(which(each, name) + ": transform: `" +
                     std::string(each.attribute("transform").as_string()) +
                     "`: matrix, translate, scale, rotate, skewX or skewY with their numbers are "
                     "due");
        return false;
      }
      const Matrix inner = outer * *own;
      if (!take_shape(each, name, inner) || !take(each, inner, depth + 1)) return false;
    }
    return true;
  }

  bool take_shape(const pugi::xml_node& node, const std::string& name, const Matrix& matrix) {
    Nodes nodes;
    std::optional<std::string> wrong;
    if (name == "path") {
      wrong = take_path(node.attribute("d").as_string(), nodes);
    } else if (name == "polyline" || name == "polygon") {
      const std::string data = "M" + std::string(node.attribute("points").as_string());
      if (data.size() > 1) wrong = take_path(data, nodes);
    } else if (name == "line") {
      for (const char* end : {"1", "2"})
        nodes.push_back({node.attribute((std::string("x") + end).c_str()).as_double(),
                         node.attribute((std::string("y") + end).c_str()).as_double()});
    }
    for (const Place& each : nodes) {
      const Place p = matrix(each);
      if (!(std::abs(p.x) <= 30000) || !(std::abs(p.y) <= 30000)) {
        wrong =
            "a node lies at " + text_of(p.x) + ", " + text_of(p.y) + " px: at most 30000 is due";
        break;
      }
      points_.push_back({static_cast<float>(std::round(p.x * 100) / 100),
                         static_cast<float>(std::round(p.y * 100) / 100)});
    }
    if (points_.size() > 65535) wrong = "more than 65535 nodes";
    if (wrong) fault_ = bad(which(node, name) + ": " + *wrong);
    return !wrong;
  }

  static std::string local_name(std::string_view name) {
    return std::string(name.substr(name.find(':') == name.npos ? 0 : name.find(':') + 1));
  }
  static std::string which(const pugi::xml_node& node, const std::string& name) {
    const std::string id = node.attribute("id").as_string();
    return id.empty() ? "a " + name : name + " `" + id + "`";
  }
  static std::string text_of(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
  }

  const std::string& path_;
  int width_, height_;
  std::vector<Vec2> points_;
  Error fault_;
};

}  // namespace

Result<std::vector<Vec2>> parse_svg_points(const std::string& text, const std::string& path,
                                           int width, int height) {
  pugi::xml_document document;
  const pugi::xml_parse_result read = document.load_buffer(text.data(), text.size());
  if (!read)
    return Error{ErrorCode::BadContent,
                 path + ": no XML at byte " + std::to_string(read.offset) + ": an SVG file is due"};
  const pugi::xml_node root = document.document_element();
  const std::string_view name = root.name();
  if (name != "svg" && !name.ends_with(":svg"))
    return Error{ErrorCode::BadContent,
                 path + ": its root is <" + std::string(name) + ">: an SVG file is due"};
  return Reader(path, width, height).read(root);
}

}  // namespace vsprite
