// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Pages with a description that other programs read: Aseprite's JSON (an array of frames and tags
// over it), TexturePacker's (a hash of frames, with the keys that PixiJS adds), Godot's
// SpriteFrames.
//
// The first two describe one page a file. So runs are dealt out to pages whole: a page is filled
// with runs until the next one does not fit; what two runs of a page share stands there once, and a
// run that no page holds goes on, under another name, on the next.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "tool/atlas.h"
#include "tool/export.h"
#include "tool/files.h"
#include "vsprite/vsprite.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

// One page and what is played from it.
struct Sheet {
  std::vector<PlayedRun> runs;
  std::vector<std::uint32_t> samples;  // of the choice, ascending
  std::vector<AtlasPlace> places;      // of `samples`
  const AtlasPlace& place_of(std::uint32_t sample) const {
    const auto at = std::lower_bound(samples.begin(), samples.end(), sample);
    return places[static_cast<std::size_t>(at - samples.begin())];
  }
};

struct Sheets {
  std::vector<Sheet> sheets;
  Atlas atlas;                      // of all of them
  std::vector<std::uint32_t> from;  // the pack's sample of each place of `atlas`
};

// Every sample that the runs show, once, ascending.
std::vector<std::uint32_t> samples_of(const std::vector<PlayedRun>& runs) {
  std::vector<std::uint32_t> out;
  for (const PlayedRun& run : runs) out.insert(out.end(), run.samples.begin(), run.samples.end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Result<Atlas> arrange(const SpriteData& data, const std::vector<std::uint32_t>& which) {
  std::vector<Sample> samples;
  for (const std::uint32_t i : which) samples.push_back(data.samples[i]);
  return arrange_atlas(data.name, samples);
}

// How many of the run's samples, from `first` on, a page of their own holds: all, if it can be.
Result<std::size_t> longest_piece(const SpriteData& data, const PlayedRun& run, std::size_t first) {
  std::size_t fits = 0, count = run.samples.size() - first;
  for (std::size_t least = 1, most = count; least <= most; count = (least + most + 1) / 2) {
    const auto begin = run.samples.begin() + static_cast<std::ptrdiff_t>(first);
    const auto atlas = arrange(
        data, samples_of({{"", {begin, begin + static_cast<std::ptrdiff_t>(count)}, false, {}}}));
    if (!atlas) return atlas.error();
    if (atlas->pages.size() == 1) {
      fits = count;
      least = count + 1;
    } else {
      most = count - 1;
    }
  }
  return fits;
}

// Runs that no page holds, cut: "film", "film.2", ...
Result<std::vector<PlayedRun>> cut_to_pages(const SpriteData& data,
                                            const std::vector<PlayedRun>& runs) {
  std::vector<PlayedRun> out;
  for (const PlayedRun& run : runs) {
    for (std::size_t first = 0, part = 1; first < run.samples.size(); ++part) {
      const auto count = longest_piece(data, run, first);
      if (!count) return count.error();
      const auto begin = run.samples.begin() + static_cast<std::ptrdiff_t>(first);
      PlayedRun piece{
          run.name, {begin, begin + static_cast<std::ptrdiff_t>(*count)}, run.loops, run.seam};
      if (part > 1) piece.name += "." + std::to_string(part);
      if (*count < run.samples.size()) piece.loops = false;
      out.push_back(std::move(piece));
      first += *count;
    }
  }
  return out;
}

Result<Sheets> deal_out(const ExportJob& job) {
  const SpriteData& data = job.choice.data;
  const auto runs = cut_to_pages(data, job.runs);
  if (!runs) return runs.error();
  Sheets out;
  for (const PlayedRun& run : *runs) {
    Sheet sheet;
    if (!out.sheets.empty()) sheet.runs = out.sheets.back().runs;
    sheet.runs.push_back(run);
    auto atlas = arrange(data, samples_of(sheet.runs));
    if (!atlas) return atlas.error();
    if (atlas->pages.size() == 1 && !out.sheets.empty()) {
      out.sheets.back() = std::move(sheet);
    } else {
      out.sheets.push_back({{run}, {}, {}});
    }
  }
  for (Sheet& sheet : out.sheets) {
    sheet.samples = samples_of(sheet.runs);
    const auto atlas = arrange(data, sheet.samples);
    sheet.places = atlas->places;
    for (AtlasPlace& place : sheet.places) place.page = static_cast<int>(out.atlas.pages.size());
    out.atlas.places.insert(out.atlas.places.end(), sheet.places.begin(), sheet.places.end());
    out.atlas.pages.push_back(atlas->pages.front());
    for (const std::uint32_t i : sheet.samples) out.from.push_back(job.choice.from[i]);
  }
  return out;
}

Json rectangle(int x, int y, int width, int height) {
  return {{"x", x}, {"y", y}, {"w", width}, {"h", height}};
}

// What both kinds of JSON say about a frame in the same words.
Json frame_json(const Sample& s, const AtlasPlace& place, const Canvas& canvas) {
  return {{"frame", rectangle(place.x, place.y, s.width, s.height)},
          {"rotated", false},
          {"trimmed", true},
          {"spriteSourceSize", rectangle(canvas.left(s), canvas.top(s), s.width, s.height)},
          {"sourceSize", {{"w", canvas.width}, {"h", canvas.height}}}};
}

Json velocity_json(const Sample& s) { return {{"x", s.velocity.x}, {"y", s.velocity.y}}; }

Json meta_json(const AtlasPage& page, std::size_t number) {
  return {{"app", "vsprite"},
          {"version", VSPRITE_VERSION},
          {"image", numbered_png("page", number)},
          {"format", "RGBA8888"},
          {"size", {{"w", page.width}, {"h", page.height}}},
          {"scale", "1"}};
}

// Whole milliseconds, whose sum keeps in step with the ticks.
class Milliseconds {
 public:
  explicit Milliseconds(double fps) : fps_(fps) {}
  long next(int ticks) {
    const long before = std::lround(1000 * static_cast<double>(ticks_) / fps_);
    ticks_ += ticks;
    return std::lround(1000 * static_cast<double>(ticks_) / fps_) - before;
  }

 private:
  double fps_;
  long ticks_ = 0;
};

std::string page_json_name(std::size_t number) {
  return "page-" + std::to_string(number) + ".json";
}

Json aseprite_json(const ExportJob& job, const Sheets& all, std::size_t number,
                   const Canvas& canvas) {
  const SpriteData& data = job.choice.data;
  const Sheet& sheet = all.sheets[number];
  Json frames = Json::array(), tags = Json::array();
  for (const PlayedRun& run : sheet.runs) {
    Milliseconds time(fps_of(data));
    const std::size_t first = frames.size();
    for (std::size_t k = 0; k < run.samples.size(); ++k) {
      const Sample& s = data.samples[run.samples[k]];
      Json frame{
          {"filename", data.name + " (" + run.name + ") " + std::to_string(k) + ".aseprite"}};
      frame.update(frame_json(s, sheet.place_of(run.samples[k]), canvas));
      frame["duration"] = time.next(s.duration);
      frame["velocity"] = velocity_json(s);
      frames.push_back(std::move(frame));
    }
    Json tag{{"name", run.name},
             {"from", first},
             {"to", frames.size() - 1},
             {"direction", "forward"},
             {"color", "#000000ff"}};
    if (!run.loops) tag["repeat"] = "1";
    if (run.seam) tag["data"] = "seam " + std::to_string(*run.seam);
    tags.push_back(std::move(tag));
  }
  Json meta = meta_json(all.atlas.pages[number], number);
  meta["frameTags"] = std::move(tags);
  meta["layers"] = {{{"name", data.name}, {"opacity", 255}, {"blendMode", "normal"}}};
  meta["slices"] = {{{"name", "anchor"},
                     {"color", "#0000ffff"},
                     {"keys",
                      {{{"frame", 0},
                        {"bounds", rectangle(0, 0, canvas.width, canvas.height)},
                        {"pivot", {{"x", canvas.width / 2}, {"y", canvas.height / 2}}}}}}}};
  return {{"frames", std::move(frames)}, {"meta", std::move(meta)}};
}

std::string frame_name(const PlayedRun& run, std::size_t k) {
  std::string number = std::to_string(k);
  if (number.size() < 4) number.insert(0, 4 - number.size(), '0');
  return run.name + "_" + number + ".png";
}

Json texture_packer_json(const ExportJob& job, const Sheets& all, std::size_t number,
                         const Canvas& canvas) {
  const SpriteData& data = job.choice.data;
  const Sheet& sheet = all.sheets[number];
  Json frames = Json::object(), animations = Json::object();
  for (const PlayedRun& run : sheet.runs) {
    Json names = Json::array();
    for (std::size_t k = 0; k < run.samples.size(); ++k) {
      const Sample& s = data.samples[run.samples[k]];
      Json frame = frame_json(s, sheet.place_of(run.samples[k]), canvas);
      frame["pivot"] = frame["anchor"] = {{"x", 0.5}, {"y", 0.5}};
      frame["velocity"] = velocity_json(s);
      const std::string name = frame_name(run, k);
      for (int tick = 0; tick < s.duration; ++tick) names.push_back(name);
      // Names are new, so none has to be looked for.
      auto& object = frames.get_ref<Json::object_t&>();
      static_cast<Json::object_t::Container&>(object).emplace_back(name, std::move(frame));
    }
    animations[run.name] = std::move(names);
  }
  Json meta = meta_json(all.atlas.pages[number], number);
  meta["fps"] = fps_of(data);
  Json others = Json::array();
  for (std::size_t p = 0; p < all.sheets.size(); ++p)
    if (p != number) others.push_back(page_json_name(p));
  if (!others.empty()) meta["related_multi_packs"] = std::move(others);
  return {{"frames", std::move(frames)},
          {"animations", std::move(animations)},
          {"meta", std::move(meta)}};
}

// Text of Godot's resources, which the two forms say in different words.
class GodotText {
 public:
  GodotText(const ExportJob& job, const Atlas& atlas, const std::vector<std::uint32_t>& samples)
      : job_(job),
        data_(job.choice.data),
        atlas_(atlas),
        samples_(samples),
        canvas_(canvas_of(data_, job.runs)) {}

  std::string write() const {
    std::string out = "[gd_resource type=\"SpriteFrames\" load_steps=" +
                      std::to_string(atlas_.pages.size() + samples_.size() + 1) +
                      " format=" + (is_old() ? "2" : "3") + "]\n\n";
    for (std::size_t p = 0; p < atlas_.pages.size(); ++p) out += page(p);
    for (std::size_t k = 0; k < samples_.size(); ++k) out += picture(k);
    out += "\n[resource]\nanimations = [ ";
    for (const PlayedRun& run : job_.runs)
      out += (&run == &job_.runs.front() ? "" : ", ") + animation(run);
    return out + " ]\n" + velocities();
  }

 private:
  bool is_old() const { return job_.godot == 3; }
  static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
  }
  static std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
      if (c == '"' || c == '\\') out += '\\';
      out += c;
    }
    return out + "\"";
  }
  std::string id(const char* kind, std::size_t k) const {
    const std::string plain = std::to_string(k + 1);
    return is_old() ? plain : quoted(kind + plain);
  }
  std::string page(std::size_t p) const {
    const std::string kind = is_old() ? "Texture" : "Texture2D";
    return "[ext_resource type=" + quoted(kind) + " path=" + quoted(numbered_png("page", p)) +
           " id=" + id("page", p) + "]\n";
  }
  std::string picture(std::size_t k) const {
    const Sample& s = data_.samples[samples_[k]];
    const AtlasPlace& at = atlas_.places[k];
    const auto rect = [](int x, int y, int w, int h) {
      return "Rect2( " + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(w) +
             ", " + std::to_string(h) + " )\n";
    };
    return "\n[sub_resource type=\"AtlasTexture\" id=" + id("picture", k) +
           "]\natlas = ExtResource( " + id("page", static_cast<std::size_t>(at.page)) +
           " )\nregion = " + rect(at.x, at.y, s.width, s.height) + "margin = " +
           rect(canvas_.left(s), canvas_.top(s), canvas_.width - s.width,
                canvas_.height - s.height);
  }
  std::string texture(std::uint32_t sample) const {
    const auto at = std::lower_bound(samples_.begin(), samples_.end(), sample);
    return "SubResource( " + id("picture", static_cast<std::size_t>(at - samples_.begin())) + " )";
  }
  // The older form has no durations: a picture that stays is there several times.
  std::string frames(const PlayedRun& run) const {
    std::string out;
    for (const std::uint32_t i : run.samples) {
      const int ticks = data_.samples[i].duration;
      for (int t = 0; t < (is_old() ? ticks : 1); ++t) {
        if (!out.empty()) out += ", ";
        out += is_old() ? texture(i)
                        : "{\n\"duration\": " + number(ticks) + ".0,\n\"texture\": " + texture(i) +
                              "\n}";
      }
    }
    return out;
  }
  std::string animation(const PlayedRun& run) const {
    return "{\n\"frames\": [ " + frames(run) + " ],\n\"loop\": " + (run.loops ? "true" : "false") +
           ",\n\"name\": " + (is_old() ? "" : "&") + quoted(run.name) +
           ",\n\"speed\": " + number(fps_of(data_)) +
           (fps_of(data_) == std::floor(fps_of(data_)) ? ".0" : "") + "\n}";
  }
  // get_meta("velocities")["right"][k]: px/s of frame k.
  std::string velocities() const {
    std::string out = is_old() ? "__meta__ = {\n\"velocities\": {\n" : "metadata/velocities = {\n";
    for (const PlayedRun& run : job_.runs) {
      out += (&run == &job_.runs.front() ? "" : ",\n") + quoted(run.name) +
             (is_old() ? ": PoolVector2Array( " : ": PackedVector2Array( ");
      bool first = true;
      for (const std::uint32_t i : run.samples) {
        const Sample& s = data_.samples[i];
        for (int t = 0; t < (is_old() ? s.duration : 1); ++t, first = false)
          out += (first ? "" : ", ") + number(s.velocity.x) + ", " + number(s.velocity.y);
      }
      out += " )";
    }
    return out + (is_old() ? "\n}\n}\n" : "\n}\n");
  }

  const ExportJob& job_;
  const SpriteData& data_;
  const Atlas& atlas_;
  const std::vector<std::uint32_t>& samples_;
  Canvas canvas_;
};

std::size_t shown_count(const Sheets& sheets) {
  std::vector<std::uint32_t> all = sheets.from;
  std::sort(all.begin(), all.end());
  return static_cast<std::size_t>(std::unique(all.begin(), all.end()) - all.begin());
}

// Pages, each with its description.
Result<Json> write_sheets(const ExportJob& job, Json (*page_json)(const ExportJob&, const Sheets&,
                                                                  std::size_t, const Canvas&)) {
  const auto sheets = deal_out(job);
  if (!sheets) return sheets.error();
  if (auto wrote = write_atlas(job.film, sheets->from, sheets->atlas, job.output, job.progress);
      !wrote)
    return wrote.error();
  const Canvas canvas = canvas_of(job.choice.data, job.runs);
  for (std::size_t p = 0; p < sheets->sheets.size(); ++p)
    if (auto wrote = write_json(job, page_json_name(p), page_json(job, *sheets, p, canvas)); !wrote)
      return wrote.error();
  return export_report(job, shown_count(*sheets), sheets->sheets.size());
}

}  // namespace

Result<Json> write_aseprite(const ExportJob& job) { return write_sheets(job, aseprite_json); }
Result<Json> write_texture_packer(const ExportJob& job) {
  return write_sheets(job, texture_packer_json);
}

Result<Json> write_godot(const ExportJob& job) {
  const std::vector<std::uint32_t> samples = samples_of(job.runs);
  const auto atlas = arrange(job.choice.data, samples);
  if (!atlas) return atlas.error();
  std::vector<std::uint32_t> from;
  for (const std::uint32_t i : samples) from.push_back(job.choice.from[i]);
  if (auto wrote = write_atlas(job.film, from, *atlas, job.output, job.progress); !wrote)
    return wrote.error();
  const std::string text = GodotText(job, *atlas, samples).write();
  if (auto wrote = write_file((fs::path(job.output) / "character.tres").string(), text); !wrote)
    return wrote.error();
  return export_report(job, samples.size(), atlas->pages.size());
}

}  // namespace vsprite
