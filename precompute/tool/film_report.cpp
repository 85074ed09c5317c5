// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/film_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "control/response.h"
#include "similarity/features.h"
#include "tool/page.h"
#include "tool/report.h"
#include "vsprite/image.h"

namespace vsprite {
namespace {

constexpr int kStripPictures = 8, kStripSide = 96;
constexpr std::uint32_t kStripApart = 4;  // samples
constexpr const char* kFeatureNames[kFeatureCount] = {"speed", "angle",       "colour",
                                                      "alpha", "mean colour", "area"};

std::string name(Direction d) { return std::string(direction_name(d)); }
std::string fixed(double value, int decimals = 1) { return fixed_text(value, decimals); }

// Smaller by a whole factor, each pixel the mean of a square; premultiplied in and out.
Image shrink(const Image& image, int factor) {
  Image out{(image.width + factor - 1) / factor, (image.height + factor - 1) / factor, {}};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      std::array<unsigned, 4> sum{};
      for (int v = y * factor; v < std::min((y + 1) * factor, image.height); ++v) {
        for (int u = x * factor; u < std::min((x + 1) * factor, image.width); ++u) {
          const std::uint8_t* p = ImageView(image).pixel(u, v);
          for (std::size_t c = 0; c < 4; ++c) sum[c] += p[c];
        }
      }
      for (const unsigned s : sum)
        out.rgba.push_back(static_cast<std::uint8_t>(s / static_cast<unsigned>(factor * factor)));
    }
  }
  return out;
}

Result<std::string> picture_tag(const Sprite& sprite, std::uint32_t sample) {
  Image image;
  if (auto decoded = sprite.decode_frame(sample, image); !decoded) return decoded.error();
  if (image.width == 0) return std::string();
  const int factor = (std::max(image.width, image.height) + kStripSide - 1) / kStripSide;
  image = shrink(image, factor);
  unpremultiply(image);
  const auto png = encode_png(image);
  if (!png) return png.error();
  return "<img alt='' title='sample " + std::to_string(sample) + "' src='data:image/png;base64," +
         base64(*png) + "'>";
}

// Where the film goes a direction longest without a cut, its middle.
std::uint32_t best_run(const Sprite& sprite, Direction direction, double moving) {
  std::uint32_t best = kNoSample, longest = 0, length = 0;
  for (std::uint32_t i = 0; i < sprite.samples().size(); ++i) {
    const Sample& s = sprite.samples()[i];
    const double speed =
        std::hypot(static_cast<double>(s.velocity.x), static_cast<double>(s.velocity.y));
    const bool goes = s.kept != 0 && speed > moving && nearest_direction(s.velocity) == direction;
    const bool joined = i > 0 && sprite.samples()[i - 1].clip == s.clip;
    length = !goes ? 0 : joined ? length + 1 : 1;
    if (length > longest) longest = length, best = i + 1 - length / 2;
  }
  return best;
}

Result<std::string> strips(const Sprite& sprite) {
  std::string out;
  const double moving = measure_speeds(sprite.samples()).moving;
  for (int d = 0; d < kCompassCount; ++d) {
    const auto direction = static_cast<Direction>(d);
    const std::uint32_t middle = best_run(sprite, direction, moving);
    if (middle == kNoSample) continue;
    out += "<div class='strip'><b>" + name(direction) + "</b>";
    const std::uint32_t half = kStripApart * kStripPictures / 2;
    std::uint32_t i = middle > half ? middle - half : 0;
    for (int k = 0; k < kStripPictures && i < sprite.samples().size(); ++k, i += kStripApart) {
      if (sprite.samples()[i].clip != sprite.samples()[middle].clip) continue;
      const auto tag = picture_tag(sprite, i);
      if (!tag) return tag.error();
      out += *tag;
    }
    out += "</div>\n";
  }
  return out;
}

// Eight by eight: frames to turn, dark where slow.
std::string turn_table(const Advice& advice, double fps) {
  if (advice.turns.empty()) return "<p>No two directions are served.</p>";
  std::string out = "<table class='turns'><tr><th>from \\ to</th>";
  for (int d = 0; d < kCompassCount; ++d) out += "<th>" + name(static_cast<Direction>(d)) + "</th>";
  out += "</tr>\n";
  for (int from = 0; from < kCompassCount; ++from) {
    out += "<tr><th>" + name(static_cast<Direction>(from)) + "</th>";
    for (int to = 0; to < kCompassCount; ++to) {
      const auto t = std::find_if(advice.turns.begin(), advice.turns.end(), [&](const auto& turn) {
        return static_cast<int>(turn.from) == from && static_cast<int>(turn.to) == to;
      });
      if (t == advice.turns.end()) {
        out += "<td></td>";
        continue;
      }
      const int light = static_cast<int>(std::clamp(98 - 1.5 * t->frames, 45.0, 98.0));
      out += "<td style='background:hsl(14 70% " + std::to_string(light) + "%)' title='" +
             fixed(1000 * t->frames / fps, 0) + " ms; slowest tenth " + fixed(t->slow, 0) +
             " frames; dearest jump " + fixed(t->worst_cost, 2) + "; filmed " +
             std::to_string(t->filmed) + " times'>" + fixed(t->frames, 0) + "<small>" +
             fixed(t->worst_cost, 2) + "</small></td>";
    }
    out += "</tr>\n";
  }
  return out + "</table>";
}

std::string rose(const Advice& advice) {
  double most = 1e-9, fastest = 1e-9;
  for (const RoseSector& s : advice.rose) {
    most = std::max(most, s.seconds);
    fastest = std::max(fastest, s.speed);
  }
  std::string out =
      "<svg width='300' height='300' viewBox='-150 -150 300 300'>"
      "<circle r='120' class='grid'/><circle r='60' class='grid'/>";
  for (std::size_t k = 0; k < kRoseSectors; ++k) {
    const RoseSector& s = advice.rose[k];
    const double middle = 2 * kPi * static_cast<double>(k) / kRoseSectors;
    const double half = kPi / kRoseSectors * 0.9, r = 120 * std::sqrt(s.seconds / most);
    const auto at = [&](double radius, double angle) {
      return fixed(radius * std::cos(angle)) + " " + fixed(radius * std::sin(angle));
    };
    out += "<path class='rose' d='M0 0L" + at(r, middle - half) + "A" + fixed(r) + " " + fixed(r) +
           " 0 0 1 " + at(r, middle + half) + "Z'><title>" + fixed(s.seconds) + " s, " +
           fixed(s.speed, 0) + " px/s</title></path><circle class='speed' r='3' cx='" +
           fixed(120 * s.speed / fastest * std::cos(middle)) + "' cy='" +
           fixed(120 * s.speed / fastest * std::sin(middle)) + "'/>";
  }
  return out + "</svg>";
}

// Clips along a line, and of every hundredth sample its cheapest jump as an arc.
std::string graph(const Sprite& sprite) {
  const auto n = static_cast<std::uint32_t>(sprite.samples().size());
  const auto x = [&](std::uint32_t i) { return 900.0 * i / n; };
  std::string out = "<svg width='900' height='260' viewBox='0 0 900 260'>";
  for (std::uint32_t i = 0, first = 0; i < n; ++i) {
    const bool last = i + 1 == n || sprite.samples()[i + 1].clip != sprite.samples()[i].clip;
    if (!last) continue;
    out += "<rect class='clip' x='" + fixed(x(first)) + "' y='246' height='8' width='" +
           fixed(std::max(1.0, x(i + 1) - x(first) - 1)) + "'/>";
    first = i + 1;
  }
  for (std::uint32_t i = 0; i < n; i += std::max(1u, n / 400)) {
    const Transition* best = nullptr;
    for (const Transition& t : sprite.transitions(i)) {
      if (!sprite.is_natural(i, t.to) && (best == nullptr || t.cost < best->cost)) best = &t;
    }
    if (best == nullptr) continue;
    const double a = x(i), b = x(best->to), height = std::min(235.0, 8 + std::fabs(a - b) / 2);
    out += "<path class='arc' style='stroke:hsl(" +
           fixed(210 - 190 * std::min(1.0, static_cast<double>(best->cost)), 0) +
           " 70% 45%)' d='M" + fixed(a) + " 245Q" + fixed((a + b) / 2) + " " +
           fixed(245 - 2 * height) + " " + fixed(b) + " 245'/>";
  }
  return out + "</svg>";
}

std::string cost_histogram(const Sprite& sprite) {
  std::array<std::uint64_t, 20> bins{};
  for (std::uint32_t i = 0; i < sprite.samples().size(); ++i) {
    for (const Transition& t : sprite.transitions(i)) {
      if (!sprite.is_natural(i, t.to))
        ++bins[static_cast<std::size_t>(std::clamp(t.cost * 20, 0.0f, 19.0f))];
    }
  }
  const auto most =
      static_cast<double>(std::max<std::uint64_t>(1, *std::max_element(bins.begin(), bins.end())));
  std::string out = "<svg width='420' height='150' viewBox='0 0 420 150'>";
  for (std::size_t k = 0; k < bins.size(); ++k) {
    const double h = 120 * static_cast<double>(bins[k]) / most;
    out += "<rect class='bar' x='" + fixed(20.0 * static_cast<double>(k) + 2) + "' y='" +
           fixed(125 - h) + "' width='16' height='" + fixed(h) + "'><title>" +
           std::to_string(bins[k]) + "</title></rect>";
  }
  return out +
         "<text x='0' y='143'>0</text><text x='400' y='143' text-anchor='end'>1 "
         "(threshold)</text></svg>";
}

std::string classifier_table(const Classifier& classifier) {
  std::string out = "<table><tr><th>feature</th><th>weight / threshold</th></tr>";
  for (std::size_t k = 0; k < std::size(kFeatureNames); ++k) {
    out += "<tr><td>" + std::string(kFeatureNames[k]) + "</td><td>" +
           fixed_text(classifier.weights[k] / classifier.threshold, 6) + "</td></tr>";
  }
  return out + "</table>";
}

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_float()) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value.get<double>());
    return text;
  }
  if (!value.is_array()) return value.dump();
  std::string out;
  for (const Json& entry : value) out += (out.empty() ? "" : ", ") + value_text(entry);
  return out;
}

// A row for every figure, those of an object below its name; lists of objects have a place of their
// own on the page or are too long for it.
void add_rows(const std::string& key, const Json& value, std::string& out) {
  if (value.is_object()) {
    for (const auto& [inner, entry] : value.items()) add_rows(key + ": " + inner, entry, out);
    return;
  }
  const bool listed =
      value.is_array() && (value.size() > 12 || (!value.empty() && value.front().is_structured()));
  if (listed || value.is_null() || (value.is_array() && value.empty())) return;
  std::string words = key;
  std::replace(words.begin(), words.end(), '_', ' ');
  out +=
      "<tr><td>" + escape_html(words) + "</td><td>" + escape_html(value_text(value)) + "</td></tr>";
}

std::string record_table(const Json& records) {
  std::string out;
  for (const auto& [stage, result] : records.items()) {
    out += "<details><summary>" + escape_html(stage) + "</summary><table class='figures'>";
    for (const auto& [key, value] : result.items())
      if (key != "dropped" && key != "roc") add_rows(key, value, out);
    out += "</table></details>";
  }
  return out;
}

std::string embedded(const std::string& png, const std::string& title) {
  return "<img class='whole' alt='" + escape_html(title) + "' src='data:image/png;base64," +
         base64({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()}) + "'>";
}

std::string dropped_pictures(const FilmReport& report) {
  std::string out;
  for (const FilmReport::Dropped& d : report.dropped)
    out += "<figure>" + embedded(d.png, d.reason) + "<figcaption>" + escape_html(d.reason) + ": " +
           fixed(100 * d.share) + " % of the frames, for instance " + std::to_string(d.frame) +
           "</figcaption></figure>";
  return out;
}

double kept_seconds(const Sprite& sprite) {
  double seconds = 0;
  for (const Sample& s : sprite.samples())
    if (s.kept != 0) seconds += s.duration / sprite.fps();
  return seconds;
}

constexpr const char* kStyle =
    "<style>body{font:15px/1.5 sans-serif;max-width:960px;margin:2em auto;color:#222}"
    "table{border-collapse:collapse}td,th{border:1px solid #ddd;padding:3px 8px;text-align:right}"
    ".turns td{text-align:center;min-width:52px}small{display:block;color:#555}"
    ".strip{display:flex;align-items:center;gap:4px;margin:4px 0}.strip b{width:90px}"
    ".strip img{background:repeating-conic-gradient(#bbb 0 25%,#eee 0 50%) 0 0/16px 16px}"
    ".grid{fill:none;stroke:#ccc}.rose{fill:#1f6fb4;opacity:.7}.speed{fill:#b4472c}"
    ".clip{fill:#888}.arc{fill:none;opacity:.5}.bar{fill:#1f6fb4}text{font-size:12px}"
    "li{margin:.3em 0}.whole{max-width:100%}figure{display:inline-block;width:45%;margin:0 2% 1em "
    "0}"
    ".figures td{text-align:left;overflow-wrap:anywhere}.figures td:first-child{width:40%}"
    "summary{cursor:pointer;font-weight:bold;margin:.5em 0}</style>";

}  // namespace

Json report_json(const Sprite& sprite, const FilmReport& report) {
  Json turns = Json::array(), sectors = Json::array();
  for (const TurnForecast& t : report.advice.turns) {
    turns.push_back({{"from", name(t.from)},
                     {"to", name(t.to)},
                     {"frames", t.frames},
                     {"ms", std::round(1000 * t.frames / sprite.fps())},
                     {"p90", t.slow},
                     {"worst_cost", t.worst_cost},
                     {"filmed", t.filmed}});
  }
  for (const RoseSector& s : report.advice.rose)
    sectors.push_back({{"seconds", s.seconds}, {"speed", s.speed}});
  return {{"mode", report.mode},
          {"turns", turns},
          {"rose", sectors},
          {"standing_seconds", report.advice.standing},
          {"unused", report.advice.unused},
          {"film_next", report.advice.film}};
}

std::string report_text(const Sprite& sprite, const FilmReport& report) {
  std::string out = "  " + fixed(kept_seconds(sprite)) + " s of film in use, " +
                    std::to_string(report.advice.unused.size()) +
                    " samples that no direction shows\n  what to film next:\n";
  for (const std::string& sentence : report.advice.film) out += "    " + sentence + "\n";
  return out;
}

Result<std::string> report_html(const Sprite& sprite, const FilmReport& report) {
  const auto pictures = strips(sprite);
  if (!pictures) return pictures.error();
  const std::string title = escape_html(sprite.data().name);
  std::string page = "<!doctype html><html lang='en'><meta charset='utf-8'><title>" + title +
                     "</title>" + kStyle + "\n<h1>" + title + "</h1>\n<p>" +
                     std::to_string(sprite.samples().size()) + " samples, " +
                     fixed(kept_seconds(sprite)) + " s of film in use at " +
                     fixed(sprite.fps(), 2) + " frames a second; mode " + escape_html(report.mode) +
                     ".</p>\n<h2>What to film next</h2><ul>";
  for (const std::string& sentence : report.advice.film)
    page += "<li>" + escape_html(sentence) + "</li>";
  page +=
      "</ul>\n<h2>Frames to turn</h2><p>From the key to the path that fits it, median; below, "
      "the dearest jump on the way (1 is the threshold).</p>" +
      turn_table(report.advice, sprite.fps()) +
      "\n<h2>What the film holds</h2><p>Area: seconds of each heading (none moves for " +
      fixed(report.advice.standing) + " s more); dots: its speed. " +
      std::to_string(report.advice.unused.size()) +
      " samples were shown in no turn and in ten minutes of random goals.</p>" +
      rose(report.advice) + "\n<h2>Mattes</h2>" + *pictures;
  if (!report.contact.empty())
    page += "<p>Spread over the film, as it was cut out:</p>" +
            embedded(report.contact, "contact sheet");
  if (!report.dropped.empty()) page += "\n<h2>Left out</h2>" + dropped_pictures(report);
  page += "\n<h2>Transitions</h2><p>Clips in a row, and for one sample in " +
          std::to_string(std::max<std::size_t>(1, sprite.samples().size() / 400)) +
          " its cheapest jump, blue where nobody sees it.</p>" + graph(sprite) +
          "<p>Costs of all jumps:</p>" + cost_histogram(sprite);
  if (report.classifier)
    page += "\n<h2>Classifier</h2>" + classifier_table(*report.classifier) + report.roc;
  if (!report.records.empty()) page += "\n<h2>Stages</h2>" + record_table(report.records);
  return page + "\n</html>\n";
}

}  // namespace vsprite
