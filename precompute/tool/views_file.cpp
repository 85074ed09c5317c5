// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/views_file.h"

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "tool/files.h"
#include "tool/settings.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

/// Takes values out of a table; the first complaint is kept; keys nobody asked for are one.
class Taker {
 public:
  Taker(const toml::table& table, const std::string& file, std::optional<Error>& error)
      : table_(table), file_(file), error_(error) {}

  bool has(const char* key) const { return table_.contains(key); }
  std::string word(const char* key, std::optional<std::string> fallback = std::nullopt) {
    const toml::node* node = find(key, fallback.has_value());
    if (node == nullptr) return fallback.value_or("");
    if (!node->is_string()) complain(*node, key, "a text in quotes is due");
    return node->value<std::string>().value_or("");
  }
  bool is_word(const char* key, std::string_view word) {
    const toml::node* node = find(key, true);
    return node != nullptr && node->value<std::string_view>() == word;
  }
  double number(const char* key, double fallback) {
    const toml::node* node = find(key, true);
    if (node == nullptr) return fallback;
    const auto value = node->value<double>();
    if (!value || !std::isfinite(*value)) complain(*node, key, "a number is due");
    return value.value_or(fallback);
  }
  bool flag(const char* key, bool fallback) {
    const toml::node* node = find(key, true);
    if (node == nullptr) return fallback;
    if (!node->is_boolean()) complain(*node, key, "true or false is due");
    return node->value<bool>().value_or(fallback);
  }
  int index(const char* key, int most) {  // counted from 1; from 0 here
    const toml::node* node = find(key, false);
    if (node == nullptr) return 0;
    const auto value = node->value<std::int64_t>();
    if (!value || *value < 1 || *value > most)
      complain(*node, key, "a whole number from 1 to " + std::to_string(most) + " is due");
    return static_cast<int>(value.value_or(1)) - 1;
  }
  std::vector<double> numbers(const char* key, bool may_be_absent) {
    std::vector<double> out;
    const toml::node* node = find(key, may_be_absent);
    if (node == nullptr) return out;
    if (!node->is_array()) complain(*node, key, "an array of numbers is due");
    if (const toml::array* list = node->as_array())
      for (const toml::node& each : *list) {
        const auto value = each.value<double>();
        if (!value || !std::isfinite(*value)) complain(each, key, "a number is due");
        out.push_back(value.value_or(0));
      }
    return out;
  }
  std::vector<Vec2> points(const char* key, bool may_be_absent) {
    std::vector<Vec2> out;
    const toml::node* node = find(key, may_be_absent);
    if (node == nullptr) return out;
    if (!node->is_array()) complain(*node, key, "an array of [x, y] is due");
    if (const toml::array* list = node->as_array())
      for (const toml::node& each : *list) {
        const toml::array* pair = each.as_array();
        double x = NAN, y = NAN;
        if (pair != nullptr && pair->size() == 2) {
          x = pair->get(0)->value_or(NAN);
          y = pair->get(1)->value_or(NAN);
        }
        if (!(std::abs(x) <= 30000) || !(std::abs(y) <= 30000))
          complain(each, key,
                   "control point " + std::to_string(out.size() + 1) +
                       " is no place: [x, y] in px, each from -30000 to 30000, is due");
        out.push_back({static_cast<float>(x), static_cast<float>(y)});
      }
    return out;
  }
  void faces(const char* key, std::uint32_t corners, std::vector<Face>& out) {
    const toml::node* node = find(key, true);
    if (node == nullptr) return;
    if (!node->is_array()) complain(*node, key, "an array of arrays is due");
    if (const toml::array* list = node->as_array())
      for (const toml::node& each : *list) {
        const toml::array* row = each.as_array();
        Face face{.corners = {}, .count = corners};
        for (std::uint32_t c = 0; c < corners; ++c) {
          const auto value = row != nullptr && row->size() == corners
                                 ? row->get(c)->value<std::int64_t>()
                                 : std::nullopt;
          if (!value || *value < 1 || *value > 65535)
            complain(each, key, std::to_string(corners) + " control points, from 1, are due");
          face.corners[c] = static_cast<std::uint32_t>(value.value_or(1) - 1);
        }
        out.push_back(face);
      }
  }
  std::vector<const toml::table*> tables(const char* key) {
    std::vector<const toml::table*> out;
    const toml::node* node = find(key, true);
    if (node == nullptr) return out;
    if (const toml::array* list = node->as_array())
      for (const toml::node& each : *list)
        if (each.is_table()) out.push_back(each.as_table());
    if (out.empty()) complain(*node, key, "tables [[" + std::string(key) + "]] are due");
    return out;
  }
  void complain(const toml::node& at, const std::string& key, const std::string& what) {
    complain_at(at.source(), key, what);
  }
  void complain_here(const std::string& key, const std::string& what) {
    complain_at(table_.source(), key, what);
  }
  void done() {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (taken_.count(name)) continue;
      const std::string near = nearest_name(name, {taken_.begin(), taken_.end()});
      complain_at(key.source(), name,
                  "not known here" + (near.empty() ? "" : "; is `" + near + "` meant?"));
    }
  }

 private:
  void complain_at(const toml::source_region& at, const std::string& key, const std::string& what) {
    if (!error_)
      error_ = Error{ErrorCode::BadContent,
                     file_ + ":" + std::to_string(at.begin.line) + ": " + key + ": " + what};
  }
  const toml::node* find(const char* key, bool may_be_absent) {
    taken_.insert(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr && !may_be_absent)
      complain_at(table_.source(), key, "it is missing here and is due");
    return node;
  }

  const toml::table& table_;
  const std::string& file_;
  std::optional<Error>& error_;
  std::set<std::string> taken_;
};

class Parser {
 public:
  explicit Parser(const std::string& path) : path_(path) {}

  Result<ViewSet> parse(const toml::table& root) {
    Taker top(root, path_, error_);
    set_.name = top.word("name", fs::path(path_).stem().string());
    const std::string texture = top.word("texture", "blend");
    if (texture != "blend" && texture != "choose")
      top.complain_here("texture", "`" + texture + "`: blend or choose is due");
    set_.blends = texture != "choose";
    set_.allow_folds = top.flag("allow_folds", false);
    for (const double d : top.numbers("depth", true)) set_.depth.push_back(static_cast<float>(d));
    top.faces("triangles", 3, set_.faces);
    top.faces("quads", 4, set_.faces);
    for (const toml::table* each : top.tables("parameter")) take_parameter(*each);
    for (const toml::table* each : top.tables("view")) set_.views.push_back(take_view(*each, true));
    for (const toml::table* each : top.tables("link")) take_link(*each);
    for (const toml::table* each : top.tables("character")) take_character(*each);
    take_network(top);
    top.done();
    if (error_) return *error_;
    if (failed_) return *failed_;
    if (set_.views.empty())
      return Error{ErrorCode::BadContent, path_ + ": no [[view]], at least two are due"};
    if (set_.parameters.empty() && set_.links.empty())
      return Error{ErrorCode::BadContent, path_ + ": no [[parameter]] and no [[link]], one is due"};
    if (!set_.depth.empty() && set_.depth.size() != set_.views[0].points.size())
      return Error{ErrorCode::BadContent, path_ + ": depth: " + std::to_string(set_.depth.size()) +
                                              " numbers, one a control point is due"};
    if (auto ok = check_views(set_); !ok)
      return Error{ok.error().code, path_ + ": " + ok.error().message};
    return std::move(set_);
  }

 private:
  void take_parameter(const toml::table& table) {
    Taker from(table, path_, error_);
    PuppetParameter p{.name = from.word("name")};
    p.low = from.number("low", 0), p.high = from.number("high", 1);
    p.period = from.number("period", 0);
    if (p.name.empty() || p.name.size() > 255 || !(p.high > p.low) || p.period < 0)
      from.complain_here("parameter",
                         "a name, a low below its high and a period of 0 or more are "
                         "due");
    from.done();
    set_.parameters.push_back(std::move(p));
  }

  View take_view(const toml::table& table, bool needs_at) {
    Taker from(table, path_, error_);
    View view = take_picture(from);
    if (needs_at) view.at = from.numbers("at", true);
    from.done();
    return view;
  }

  View take_picture(Taker& from) {
    View view;
    const std::string file = from.word("file", "");
    view.name = file.empty() ? "view " + std::to_string(set_.views.size() + 1) : file;
    view.points = from.points("points", false);
    view.texture_points = from.points("texture_points", true);
    for (const double d : from.numbers("depth", true)) view.depth.push_back(static_cast<float>(d));
    if (!view.depth.empty() && view.depth.size() != view.points.size())
      from.complain_here("depth", "one number a control point is due");
    if (file.empty()) return view;
    auto picture = read_png((fs::path(path_).parent_path() / file).string());
    if (picture)
      view.picture = std::move(*picture);
    else if (!failed_)
      failed_ = picture.error();
    return view;
  }

  void take_link(const toml::table& table) {
    Taker from(table, path_, error_);
    const int points = set_.views.empty() ? 1 : static_cast<int>(set_.views[0].points.size());
    LinkMark link{.name = from.word("name")};
    link.first = from.index("first", points);
    link.count = from.index("last", points) - link.first + 1;
    link.pivot = from.index("pivot", points), link.end = from.index("end", points);
    const std::string parent = from.word("parent", "");
    for (std::size_t l = 0; l < set_.links.size(); ++l)
      if (set_.links[l].name == parent) link.parent = static_cast<int>(l);
    if (!parent.empty() && link.parent < 0)
      from.complain_here("parent", "`" + parent + "` is no earlier link");
    from.done();
    set_.links.push_back(std::move(link));
  }

  void take_character(const toml::table& table) {
    Taker from(table, path_, error_);
    Character character;
    character.name = from.word("name");
    if (!from.has("file")) from.complain_here("file", "it is missing here and is due");
    character.view = take_picture(from);
    character.like = from.has("like") ? from.index("like", static_cast<int>(set_.views.size())) : 0;
    character.modulate = from.flag("modulate", false);
    from.done();
    set_.characters.push_back(std::move(character));
  }

  void take_network(Taker& top) {
    const bool given = top.has("kernel") || top.has("degree") || top.has("width") ||
                       top.has("ridge") || top.has("allow_low_degree");
    RbfConfig config = choose_config(set_);
    const std::string kernel = top.word("kernel", std::string(kernel_name(config.kernel)));
    bool known = false;
    for (int k = 0; k < kKernelCount; ++k)
      if (kernel_name(static_cast<Kernel>(k)) == kernel)
        config.kernel = static_cast<Kernel>(k), known = true;
    if (!known)
      top.complain_here("kernel",
                        "`" + kernel + "`: linear, gaussian, thin-plate or multiquadric is due");
    if (top.has("kernel")) config.degree = std::max(0, least_degree(config.kernel));
    if (top.has("degree")) config.degree = take_degree(top);
    config.width = top.number("width", config.width);
    config.ridge = top.number("ridge", config.ridge);
    config.allow_low_degree = top.flag("allow_low_degree", false);
    if (given) set_.rbf = std::move(config);
  }

  int take_degree(Taker& top) {
    if (top.is_word("degree", "none")) return -1;
    const double degree = top.number("degree", 1);
    if (degree != 0 && degree != 1) top.complain_here("degree", "\"none\", 0 or 1 is due");
    return static_cast<int>(degree);
  }

  const std::string& path_;
  ViewSet set_;
  std::optional<Error> error_, failed_;
};

}  // namespace

Result<ViewSet> parse_views(const std::string& text, const std::string& path) {
  const toml::parse_result parsed = toml::parse(text, path);
  if (!parsed)
    return Error{ErrorCode::BadContent, path + ":" +
                                            std::to_string(parsed.error().source().begin.line) +
                                            ": " + std::string(parsed.error().description())};
  return Parser(path).parse(parsed.table());
}

Result<void> add_puppets(const std::string& work, const std::string& pack) {
  const std::string path = work + "/puppets.bin";
  if (!fs::exists(path)) return {};
  const auto text = read_file(path);
  if (!text) return text.error();
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(text->data()), text->size());
  const auto puppets = decode_puppets(bytes, path);
  if (!puppets) return puppets.error();
  return save_puppets(pack, pack, *puppets);
}

}  // namespace vsprite
