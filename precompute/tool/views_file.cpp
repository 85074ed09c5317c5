// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/views_file.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "tool/files.h"
#include "tool/toml_table.h"
#include "vsprite/pack.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

constexpr const char *kPuppetsFile = "/puppets.bin", *kSetsFile = "/puppet_sets.bin";

void take_faces(TomlTable& from, const char* key, std::uint32_t corners, std::vector<Face>& out) {
  from.each_of(key, true, "an array of arrays is due", [&](const toml::node& each) {
    const toml::array* row = each.as_array();
    Face face{.corners = {}, .count = corners};
    for (std::uint32_t c = 0; c < corners; ++c) {
      const auto value = row != nullptr && row->size() == corners
                             ? row->get(c)->value<std::int64_t>()
                             : std::nullopt;
      if (!value || *value < 1 || *value > 65535)
        from.complain(each, key, std::to_string(corners) + " control points, from 1, are due");
      face.corners[c] = static_cast<std::uint32_t>(value.value_or(1) - 1);
    }
    out.push_back(face);
  });
}

class Parser {
 public:
  Parser(const std::string& path, bool is_draft) : path_(path), is_draft_(is_draft) {}

  Result<ViewSet> parse(const toml::table& root) {
    TomlTable top(root, path_, error_);
    set_.name = top.word("name", fs::path(path_).stem().string());
    const std::string texture = top.word("texture", "blend");
    if (texture != "blend" && texture != "choose")
      top.complain("texture", "`" + texture + "`: blend or choose is due");
    set_.blends = texture != "choose";
    set_.allow_folds = top.flag("allow_folds", false);
    for (const double d : top.numbers("depth", true)) set_.depth.push_back(static_cast<float>(d));
    take_faces(top, "triangles", 3, set_.faces);
    take_faces(top, "quads", 4, set_.faces);
    for (const toml::table* each : top.tables("parameter")) take_parameter(*each);
    for (const toml::table* each : top.tables("view")) set_.views.push_back(take_view(*each, true));
    for (const toml::table* each : top.tables("link")) take_link(*each);
    take_sets(top);
    for (const toml::table* each : top.tables("character")) take_character(*each);
    take_network(top);
    take_hyper(top);
    top.done();
    if (error_) return *error_;
    if (failed_) return *failed_;
    if (set_.views.empty())
      return Error{ErrorCode::BadContent, path_ + ": no [[view]], at least two are due"};
    if (set_.parameters.empty() && set_.links.empty())
      return Error{ErrorCode::BadContent, path_ + ": no [[parameter]] and no [[link]], one is due"};
    if (is_draft_ && set_.views[0].points.empty()) set_.depth.clear();
    if (!set_.depth.empty() && set_.depth.size() != set_.views[0].points.size())
      return Error{ErrorCode::BadContent, path_ + ": depth: " + std::to_string(set_.depth.size()) +
                                              " numbers, one a control point is due"};
    if (is_draft_) return std::move(set_);
    if (auto ok = check_views(set_); !ok)
      return Error{ok.error().code, path_ + ": " + ok.error().message};
    return std::move(set_);
  }

 private:
  void take_parameter(const toml::table& table) {
    TomlTable from(table, path_, error_);
    PuppetParameter p{.name = from.word("name")};
    p.low = from.number("low", 0), p.high = from.number("high", 1);
    p.period = from.number("period", 0);
    if (p.name.empty() || p.name.size() > 255 || !(p.high > p.low) || p.period < 0)
      from.complain("parameter",
                    "a name, a low below its high and a period of 0 or more are "
                    "due");
    from.done();
    set_.parameters.push_back(std::move(p));
  }

  View take_view(const toml::table& table, bool needs_at) {
    TomlTable from(table, path_, error_);
    View view = take_picture(from);
    if (needs_at) view.at = from.numbers("at", true);
    from.done();
    return view;
  }

  View take_picture(TomlTable& from) {
    View view;
    const std::string file = from.word("file", "");
    view.name = file.empty() ? "view " + std::to_string(set_.views.size() + 1) : file;
    view.points = from.points("points", is_draft_, "control point");
    view.texture_points = from.points("texture_points", true, "control point");
    for (const double d : from.numbers("depth", true)) view.depth.push_back(static_cast<float>(d));
    if (!view.depth.empty() && view.depth.size() != view.points.size())
      from.complain("depth", "one number a control point is due");
    if (file.empty()) return view;
    auto picture = read_png((fs::path(path_).parent_path() / file).string());
    if (picture)
      view.picture = std::move(*picture);
    else if (!failed_)
      failed_ = picture.error();
    return view;
  }

  void take_link(const toml::table& table) {
    TomlTable from(table, path_, error_);
    const int points = set_.views.empty() ? 1 : static_cast<int>(set_.views[0].points.size());
    LinkMark link{.name = from.word("name")};
    link.first = from.index("first", points);
    link.count = from.index("last", points) - link.first + 1;
    link.pivot = from.index("pivot", points), link.end = from.index("end", points);
    const std::string parent = from.word("parent", "");
    for (std::size_t l = 0; l < set_.links.size(); ++l)
      if (set_.links[l].name == parent) link.parent = static_cast<int>(l);
    if (!parent.empty() && link.parent < 0)
      from.complain("parent", "`" + parent + "` is no earlier link");
    from.done();
    set_.links.push_back(std::move(link));
  }

  void take_sets(TomlTable& top) {
    std::vector<std::vector<std::string>> joins;
    const std::vector<const toml::table*> tables = top.tables("set");
    for (const toml::table* each : tables) {
      TomlTable from(*each, path_, error_);
      SetMark mark{.name = from.word("name")};
      mark.views = from.indices("views", static_cast<int>(set_.views.size()));
      joins.push_back(from.words("joins", true));
      from.done();
      set_.sets.push_back(std::move(mark));
    }
    for (std::size_t k = 0; k < tables.size(); ++k) {
      TomlTable from(*tables[k], path_, error_);
      for (const std::string& name : joins[k]) {
        int found = -1;
        for (std::size_t other = 0; other < tables.size(); ++other)
          if (other != k && set_.sets[other].name == name) found = static_cast<int>(other);
        if (found < 0) from.complain("joins", "`" + name + "` is no other set");
        set_.sets[k].joins.push_back(std::max(found, 0));
      }
      if (!from.has("joins")) join_neighbours(k);
    }
  }

  // Sets that share a view look alike there.
  void join_neighbours(std::size_t k) {
    const std::vector<int>& own = set_.sets[k].views;
    for (std::size_t other = 0; other < set_.sets.size(); ++other) {
      bool shares = false;
      for (const int v : set_.sets[other].views)
        shares |= other != k && std::find(own.begin(), own.end(), v) != own.end();
      if (shares) set_.sets[k].joins.push_back(static_cast<int>(other));
    }
  }

  void take_character(const toml::table& table) {
    TomlTable from(table, path_, error_);
    Character character;
    character.name = from.word("name");
    if (!from.has("file")) from.complain("file", "it is missing here and is due");
    character.view = take_picture(from);
    character.like = from.has("like") ? from.index("like", static_cast<int>(set_.views.size())) : 0;
    character.modulate = from.flag("modulate", false);
    from.done();
    set_.characters.push_back(std::move(character));
  }

  void take_network(TomlTable& top) {
    const bool given = top.has("kernel") || top.has("degree") || top.has("width") ||
                       top.has("ridge") || top.has("allow_low_degree");
    RbfConfig config = choose_config(set_);
    const std::string kernel = top.word("kernel", std::string(kernel_name(config.kernel)));
    bool known = false;
    for (int k = 0; k < kKernelCount; ++k)
      if (kernel_name(static_cast<Kernel>(k)) == kernel)
        config.kernel = static_cast<Kernel>(k), known = true;
    if (!known)
      top.complain("kernel",
                   "`" + kernel + "`: linear, gaussian, thin-plate or multiquadric is due");
    if (top.has("kernel")) config.degree = std::max(0, least_degree(config.kernel));
    if (top.has("degree")) config.degree = take_degree(top);
    config.width = top.number("width", config.width);
    config.ridge = top.number("ridge", config.ridge);
    config.allow_low_degree = top.flag("allow_low_degree", false);
    if (given) set_.rbf = std::move(config);
  }

  // Fewer, movable centres and a learned norm, where their number is given.
  void take_hyper(TomlTable& top) {
    HyperConfig config;
    const std::string training = top.word("training", "gradient");
    if (training != "gradient" && training != "random")
      top.complain("training", "`" + training + "`: gradient or random is due");
    if (training == "random") config.training = HyperTraining::RandomSearch;
    constexpr double kMostSteps = 1e6, kMostSeed = 1e9;
    config.steps = static_cast<int>(top.number("steps", double(config.steps), 0, kMostSteps));
    config.temperature = top.number("temperature", config.temperature);
    if (config.temperature < 0) top.complain("temperature", "0 or more is due");
    config.seed = static_cast<std::uint64_t>(top.number("seed", double(config.seed), 0, kMostSeed));
    if (top.has("centers")) {
      config.centers = top.index("centers", static_cast<int>(set_.views.size())) + 1;
      set_.hyper = std::move(config);
      return;
    }
    for (const char* key : {"training", "steps", "temperature", "seed"})
      if (top.has(key))
        top.complain(key, "centers, the number of movable centres, is due beside it");
  }

  int take_degree(TomlTable& top) {
    if (top.is_word("degree", "none")) return -1;
    const double degree = top.number("degree", 1);
    if (degree != 0 && degree != 1) top.complain("degree", "\"none\", 0 or 1 is due");
    return static_cast<int>(degree);
  }

  const std::string& path_;
  bool is_draft_;
  ViewSet set_;
  std::optional<Error> error_, failed_;
};

// A pack needs samples: the drawn views themselves, one after the other in a ring.
SpriteData ring_of_views(const Puppet& puppet) {
  SpriteData data;
  data.name = puppet.name;
  const auto count = static_cast<std::uint32_t>(puppet.views.size());
  data.row_start.assign(1, 0);
  for (std::uint32_t v = 0; v < count; ++v) {
    const Image& picture = puppet.views[v].picture;
    Sample sample;
    sample.width = static_cast<std::uint16_t>(picture.width);
    sample.height = static_cast<std::uint16_t>(picture.height);
    sample.anchor = {static_cast<float>(picture.width) / 2, static_cast<float>(picture.height) / 2};
    sample.clip = v, sample.frame = v, sample.kept = 1;
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4)
      sample.area += static_cast<float>(picture.rgba[i]) / 255;
    data.body_length = std::max(
        {data.body_length, static_cast<float>(picture.width), static_cast<float>(picture.height)});
    data.samples.push_back(sample);
    data.transitions.push_back({(v + 1) % count, 0});
    data.row_start.push_back(v + 1);
  }
  ControlMode mode;
  mode.name = "paper";
  mode.table_of.fill(Direction::Rest);
  for (std::size_t t = 0; t < mode.tables(); ++t)
    for (std::uint32_t v = 0; v < count; ++v) mode.next.push_back((v + 1) % count);
  mode.go.assign(mode.next.size(), 0);
  data.modes.push_back(std::move(mode));
  return data;
}

}  // namespace

Result<std::string> read_views_text(const std::string& path) {
  auto text = read_file(path);
  if (text && text->find('\0') != std::string::npos)
    return Error{ErrorCode::BadContent,
                 path +
                     ": a text is due that names the views, their parameters and control points "
                     "(VIEWS.toml, see `vsprite help fit`), not a picture or another binary file"};
  return text;
}

Result<ViewSet> parse_views(const std::string& text, const std::string& path) {
  const auto parsed = parse_toml(text, path);
  if (!parsed) return parsed.error();
  return Parser(path, false).parse(*parsed);
}

Result<ViewSet> parse_draft_views(const std::string& text, const std::string& path) {
  const auto parsed = parse_toml(text, path);
  if (!parsed) return parsed.error();
  return Parser(path, true).parse(*parsed);
}

Result<void> save_puppet_pack(const std::string& path, const std::vector<Puppet>& puppets) {
  const FrameSource frames = [&](std::uint32_t sample) -> Result<Image> {
    Image picture = puppets[0].views[sample].picture;
    unpremultiply(picture);
    return picture;
  };
  auto bytes = encode_puppets(puppets);
  if (!bytes) return bytes.error();
  auto sets = encode_puppet_sets(puppets);
  if (!sets) return sets.error();
  const PackExtra extras[] = {{"PUPT", std::move(*bytes)}, {"PSET", std::move(*sets)}};
  return save_pack(path, ring_of_views(puppets[0]), frames, extras);
}

Result<void> write_puppets(const std::string& work, const std::vector<Puppet>& puppets) {
  const auto bytes = encode_puppets(puppets);
  if (!bytes) return bytes.error();
  const auto sets = encode_puppet_sets(puppets);
  if (!sets) return sets.error();
  if (auto wrote = write_files({{work + kPuppetsFile, *bytes}, {work + kSetsFile, *sets}}); !wrote)
    return wrote;
  return sync_folder(work);
}

Result<PuppetSections> puppet_sections(const std::string& work) {
  PuppetSections out;
  const std::string path = work + kPuppetsFile;
  if (!fs::exists(path)) return out;
  const auto text = read_file(path);
  if (!text) return text.error();
  out.puppets.assign(text->begin(), text->end());
  auto puppets = decode_puppets(out.puppets, path);
  if (!puppets) return puppets.error();
  const std::string sets_path = work + kSetsFile;
  if (!fs::exists(sets_path)) return out;
  const auto sets = read_file(sets_path);
  if (!sets) return sets.error();
  if (sets->empty()) return out;
  out.sets.assign(sets->begin(), sets->end());
  if (auto fits = decode_puppet_sets(out.sets, sets_path, *puppets); !fits) return fits.error();
  return out;
}

}  // namespace vsprite
