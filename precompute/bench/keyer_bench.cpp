// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// keyer_bench
// [speed|truth|chosen|chosen2|chosen3|chosen4|unseen2|decision|temporal|ours|0..13|FOLDER/]...
// - this keyer beside what is free, in one run:
//
//   speed    frames/s at 1080p on one core, the rivals' reading and writing of frames taken off
//   truth    the bundled film against its exact matte
//   chosen   the bundled film's fish before 14 screens: the films that constants were chosen with
//   chosen2  a ball of fur with a veil before the same screens: looked at since, so chosen with
//   chosen3  a dragonfly and a long-haired animal before 12 other screens: looked at since, too
//   chosen4  a white bird, a puppet in a dark cloak and a jellyfish before 12 plain screens without
//            a colour: chosen with
//   unseen2  a seed head and a dancer in a skirt of net, 12 others again: no choice has seen them
//   decision grey parts read as opaque or as translucent, on the fish and on a grey mouse
//   temporal whether mixing with the neighbours in time would lower the flicker
//   ours     the rivals are left out of truth and the chosen: for choosing
//   0..13    only these of a pool's screens
//   FOLDER/  (with a slash) a sheet of every film is drawn there
//
// ffmpeg's filters are given the screen's true colour and the best of their settings is reported,
// for each film; this keyer and closed-form matting (seeds from this keyer's alpha, widened) are
// given nothing. Errors are taken within 10 px of the true edge: mean |e|, root of mean e^2, mean
// |grad e|, and flicker, the mean change of e from one frame to the next; all in percent.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#ifdef VSPRITE_BENCH_OPENCV
#include <opencv2/imgproc.hpp>
#include <opencv2/video/background_segm.hpp>
#endif

#include "capture/goldfish.h"
#include "film/color.h"
#include "film/matte.h"
#include "support/closed_form.h"
#include "support/composites.h"
#include "support/temp_folder.h"

using namespace vsprite;
using testing::CutOut;

namespace {

constexpr int kBand = 10;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Case {
  std::string name;
  std::vector<Frame> frames, samples;
  std::vector<std::vector<float>> truth;
  std::vector<std::vector<char>> band;
  std::vector<char> follows;  // the frame before is the film's frame before
  double color[3] = {};
};

std::vector<char> band_of(const std::vector<float>& alpha, int w, int h) {
  std::vector<char> rows(alpha.size()), both(alpha.size());
  const auto at = [w](int x, int y) { return static_cast<std::size_t>(y * w + x); };
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      if (const float a = alpha[at(x, y)]; a > 0.02f && a < 0.98f)
        for (int u = std::max(x - kBand, 0); u <= std::min(x + kBand, w - 1); ++u)
          rows[at(u, y)] = 1;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      if (rows[at(x, y)])
        for (int v = std::max(y - kBand, 0); v <= std::min(y + kBand, h - 1); ++v)
          both[at(x, v)] = 1;
  return both;
}

struct Errors {
  double mean = 0, square = 0, gradient = 0, flicker = 0, rest = 0;
};

using Mattes = std::vector<std::vector<float>>;

Errors measure(const Case& c, const Mattes& mattes) {
  Errors e;
  double band = 0, rest = 0, steady = 0;
  std::vector<float> before;
  for (std::size_t f = 0; f < mattes.size(); ++f) {
    const int w = c.frames[f].width;
    const int h = c.frames[f].height;
    std::vector<float> error(mattes[f].size());
    for (std::size_t i = 0; i < error.size(); ++i) error[i] = mattes[f][i] - c.truth[f][i];
    for (int y = 0; y + 1 < h; ++y)
      for (int x = 0; x + 1 < w; ++x) {
        const auto i = static_cast<std::size_t>(y * w + x);
        const double d = static_cast<double>(error[i]);
        if (!c.band[f][i]) {
          e.rest += std::abs(d);
          rest += 1;
          continue;
        }
        e.mean += std::abs(d);
        e.square += d * d;
        e.gradient += std::hypot(static_cast<double>(error[i + 1]) - d,
                                 static_cast<double>(error[i + static_cast<std::size_t>(w)]) - d);
        band += 1;
        if (!c.follows[f]) continue;
        e.flicker += std::abs(d - static_cast<double>(before[i]));
        steady += 1;
      }
    before = std::move(error);
  }
  return {100 * e.mean / band, 100 * std::sqrt(e.square / band), 100 * e.gradient / band,
          100 * e.flicker / std::max(steady, 1.0), 100 * e.rest / std::max(rest, 1.0)};
}

// `normaliser`: instead of the measured one where above 0.
Mattes key_ours(const Case& c, float normaliser = 0) {
  auto screen = measure_screen(c.samples, {});
  if (screen && normaliser > 0) screen->key_normaliser = normaliser;
  Mattes mattes;
  for (const Frame& frame : c.frames) {
    std::vector<float> alpha(frame.y.size());
    if (screen) {
      Keyer keyer(*screen, {});
      const KeyedFrame keyed = keyer.key(frame, nullptr);
      for (int y = 0; y < keyed.crop.height; ++y)
        for (int x = 0; x < keyed.crop.width; ++x)
          alpha[static_cast<std::size_t>((keyed.crop.y + y) * frame.width + keyed.crop.x + x)] =
              static_cast<float>(
                  keyed.straight
                      .rgba[static_cast<std::size_t>(4 * (y * keyed.crop.width + x) + 3)]) /
              255;
    }
    mattes.push_back(std::move(alpha));
  }
  return mattes;
}

void write_raw(const std::vector<Frame>& frames, const std::string& path, int repeats = 1) {
  std::ofstream out(path, std::ios::binary);
  for (int r = 0; r < repeats; ++r)
    for (const Frame& f : frames)
      for (const auto* plane : {&f.y, &f.cb, &f.cr})
        out.write(reinterpret_cast<const char*>(plane->data()),
                  static_cast<std::streamsize>(plane->size()));
}

std::string ffmpeg_of(const Frame& frame, const std::string& raw, const std::string& filter,
                      const std::string& rest) {
  return "ffmpeg -v error -nostdin -y -threads 1 -filter_threads 1 -f rawvideo -pix_fmt yuv420p "
         "-s " +
         std::to_string(frame.width) + "x" + std::to_string(frame.height) + " -i '" + raw + "'" +
         (filter.empty() ? "" : " -vf '" + filter + "'") + " " + rest + " 2>/dev/null";
}

std::string hex_of(const double (&color)[3]) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%02X%02X%02X", static_cast<unsigned>(color[0] + 0.5),
                static_cast<unsigned>(color[1] + 0.5), static_cast<unsigned>(color[2] + 0.5));
  return text;
}

// The best, by mean error, of a grid of settings.
Errors key_ffmpeg(const Case& c, const std::string& filter, const testing::TempFolder& folder) {
  const std::string raw = folder.file("in.raw");
  const std::string gray = folder.file("out.gray");
  write_raw(c.frames, raw);
  Errors best;
  best.mean = 1e9;
  // colorkey works on rgba, chromakey on the film's planes; only so both keep their alpha.
  const bool planes = filter == "chromakey";
  for (const char* similarity : {"0.03", "0.06", "0.1", "0.15", "0.22", "0.3"})
    for (const char* blend : {"0", "0.08", "0.2"}) {
      const std::string key = filter + "=" + hex_of(c.color) + ":" + similarity + ":" + blend;
      const std::string chain = planes ? key + ",format=yuva420p" : "format=rgba," + key;
      const std::string command = ffmpeg_of(c.frames[0], raw, chain + ",alphaextract,format=gray",
                                            "-f rawvideo '" + gray + "'");
      if (std::system(command.c_str()) != 0) {
        std::printf("    ffmpeg failed: %s\n", command.c_str());
        continue;
      }
      std::ifstream in(gray, std::ios::binary);
      Mattes mattes;
      std::vector<char> bytes(c.frames[0].y.size());
      while (in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
        std::vector<float> alpha(bytes.size());
        for (std::size_t i = 0; i < bytes.size(); ++i)
          alpha[i] = static_cast<float>(static_cast<std::uint8_t>(bytes[i])) / 255;
        mattes.push_back(std::move(alpha));
      }
      if (mattes.size() != c.frames.size()) continue;
      const Errors e = measure(c, mattes);
      if (e.mean < best.mean) best = e;
    }
  return best;
}

#ifdef VSPRITE_BENCH_OPENCV
// What MOG2 calls foreground after it has seen the film's samples twice; its shadows are plate. The
// best of its thresholds.
Errors key_mog2(const Case& c) {
  const auto bgr = [](const Frame& frame) {
    const Image image = to_image(frame);
    cv::Mat out(frame.height, frame.width, CV_8UC3);
    for (std::size_t i = 0; i < frame.y.size(); ++i)
      for (std::size_t p = 0; p < 3; ++p) out.data[3 * i + p] = image.rgba[4 * i + 2 - p];
    return out;
  };
  cv::setNumThreads(1);
  Errors best;
  best.mean = 1e9;
  for (const double threshold : {9.0, 16.0, 36.0, 80.0}) {
    const auto model = cv::createBackgroundSubtractorMOG2(500, threshold, true);
    cv::Mat mask;
    for (int pass = 0; pass < 2; ++pass)
      for (const Frame& frame : c.samples) model->apply(bgr(frame), mask);
    Mattes mattes;
    for (const Frame& frame : c.frames) {
      model->apply(bgr(frame), mask, 0);
      std::vector<float> alpha(frame.y.size());
      for (std::size_t i = 0; i < alpha.size(); ++i) alpha[i] = mask.data[i] == 255 ? 1.0f : 0.0f;
      mattes.push_back(std::move(alpha));
    }
    const Errors e = measure(c, mattes);
    if (e.mean < best.mean) best = e;
  }
  return best;
}
#endif

// OpenCV's usual recipe, inRange in HSV: hue within `reach` of the screen's, enough saturation and
// value; a hard mask. Written out, so that the row needs no OpenCV.
Errors key_hsv(const Case& c) {
  const auto hsv = [](double r, double g, double b, double& hue, double& s, double& v) {
    v = std::max({r, g, b});
    const double d = v - std::min({r, g, b});
    s = v > 0 ? 255 * d / v : 0;
    hue = 0;
    if (d > 0)
      hue = v == r ? 30 * (g - b) / d : v == g ? 60 + 30 * (b - r) / d : 120 + 30 * (r - g) / d;
    if (hue < 0) hue += 180;
  };
  double screen_hue = 0, screen_s = 0, screen_v = 0;
  hsv(c.color[0], c.color[1], c.color[2], screen_hue, screen_s, screen_v);
  Errors best;
  best.mean = 1e9;
  for (const double reach : {6.0, 10.0, 15.0, 25.0})
    for (const double least : {0.3, 0.5, 0.7}) {
      Mattes mattes;
      for (const Frame& frame : c.frames) {
        const Image image = to_image(frame);
        std::vector<float> alpha(frame.y.size());
        for (std::size_t i = 0; i < alpha.size(); ++i) {
          double hue = 0, s = 0, v = 0;
          hsv(image.rgba[4 * i], image.rgba[4 * i + 1], image.rgba[4 * i + 2], hue, s, v);
          double off = std::abs(hue - screen_hue);
          off = std::min(off, 180 - off);
          alpha[i] = off <= reach && s >= least * screen_s && v >= least * screen_v ? 0.0f : 1.0f;
        }
        mattes.push_back(std::move(alpha));
      }
      const Errors e = measure(c, mattes);
      if (e.mean < best.mean) best = e;
    }
  return best;
}

// Closed form on the chroma grid, doubled; the unknown is where our alpha is soft, two cells wider.
Errors key_closed_form(const Case& c, const Mattes& ours, std::size_t every) {
  Case few;
  Mattes mattes;
  for (std::size_t f = 0; f < c.frames.size(); ++f) {
    if (f % every > 1) continue;  // pairs of neighbours
    const Frame& frame = c.frames[f];
    const int w = frame.width / 2;
    const int h = frame.height / 2;
    const Image image = to_image(frame);
    std::vector<float> rgb(static_cast<std::size_t>(3 * w * h)), mean(rgb.size() / 3);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x)
        for (int k = 0; k < 4; ++k) {
          const auto i = static_cast<std::size_t>((2 * y + k / 2) * frame.width + 2 * x + k % 2);
          const auto o = static_cast<std::size_t>(y * w + x);
          mean[o] += 0.25f * ours[f][i];
          for (std::size_t p = 0; p < 3; ++p)
            rgb[3 * o + p] +=
                static_cast<float>(0.25 * testing::SyntheticFilm::linear(image.rgba[4 * i + p]));
        }
    std::vector<float> known(mean.size());
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        float low = 1, high = 0;
        for (int v = std::max(y - 2, 0); v <= std::min(y + 2, h - 1); ++v)
          for (int u = std::max(x - 2, 0); u <= std::min(x + 2, w - 1); ++u) {
            low = std::min(low, mean[static_cast<std::size_t>(v * w + u)]);
            high = std::max(high, mean[static_cast<std::size_t>(v * w + u)]);
          }
        known[static_cast<std::size_t>(y * w + x)] = low >= 1 ? 1.0f : high <= 0 ? 0.0f : -1.0f;
      }
    const auto small = testing::closed_form_matte(rgb, known, w, h);
    std::vector<float> alpha(frame.y.size());
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x) {
        const double u = std::clamp(0.5 * x - 0.25, 0.0, w - 1.001);
        const double v = std::clamp(0.5 * y - 0.25, 0.0, h - 1.001);
        const auto i = static_cast<std::size_t>(static_cast<int>(v) * w + static_cast<int>(u));
        const double fu = u - std::floor(u), fv = v - std::floor(v);
        const auto s = [&](std::size_t k) { return static_cast<double>(small[k]); };
        alpha[static_cast<std::size_t>(y * frame.width + x)] =
            static_cast<float>((1 - fv) * ((1 - fu) * s(i) + fu * s(i + 1)) +
                               fv * ((1 - fu) * s(i + static_cast<std::size_t>(w)) +
                                     fu * s(i + static_cast<std::size_t>(w) + 1)));
      }
    mattes.push_back(std::move(alpha));
    few.frames.push_back(frame);
    few.truth.push_back(c.truth[f]);
    few.band.push_back(c.band[f]);
    few.follows.push_back(f % every == 1 && c.follows[f]);
  }
  return measure(few, mattes);
}

void print(const char* name, const Errors& e) {
  std::printf("    %-22s %6.2f %6.2f %6.2f %6.2f   rest %.3f\n", name, e.mean, e.square, e.gradient,
              e.flicker, e.rest);
}

// Where frames are drawn, empty: nowhere.
std::string picture_folder;

// Three frames of a film, each a row: as filmed, true matte, ours, what it has too much (red) and
// too little (blue).
void draw(const Case& c, const Mattes& mattes) {
  const int w = c.frames[0].width, h = c.frames[0].height;
  Image sheet{4 * w, 3 * h, std::vector<std::uint8_t>(static_cast<std::size_t>(48 * w * h), 255)};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t f = k * (c.frames.size() - 1) / 2;
    const Image filmed = to_image(c.frames[f]);
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const auto i = static_cast<std::size_t>(y * w + x);
        const auto at = [&](int column) {
          return sheet.rgba.data() +
                 4 * ((k * static_cast<std::size_t>(h) + static_cast<std::size_t>(y)) *
                          static_cast<std::size_t>(4 * w) +
                      static_cast<std::size_t>(column * w + x));
        };
        const auto gray = [](float v) { return static_cast<std::uint8_t>(255 * v + 0.5f); };
        const float e = mattes[f][i] - c.truth[f][i];
        std::copy_n(filmed.rgba.data() + 4 * i, 3, at(0));
        std::fill_n(at(1), 3, gray(c.truth[f][i]));
        std::fill_n(at(2), 3, gray(mattes[f][i]));
        at(3)[0] = gray(1 - std::max(-e, 0.0f));
        at(3)[1] = gray(1 - std::abs(e));
        at(3)[2] = gray(1 - std::max(e, 0.0f));
      }
  }
  std::string name = c.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  if (const auto png = encode_png(sheet)) {
    std::ofstream out(picture_folder + "/" + name + ".png", std::ios::binary);
    out.write(reinterpret_cast<const char*>(png->data()),
              static_cast<std::streamsize>(png->size()));
  }
}

void compare(const Case& c, const testing::TempFolder& folder, std::size_t closed_form_every,
             int& won, int& all) {
  std::printf("  %s\n", c.name.c_str());
  const Mattes mattes = key_ours(c);
  const Errors ours = measure(c, mattes);
  print("this keyer", ours);
  if (!picture_folder.empty()) draw(c, mattes);
  if (closed_form_every == 0) return;
  const Errors chroma = key_ffmpeg(c, "chromakey", folder);
  const Errors color = key_ffmpeg(c, "colorkey", folder);
  const Errors hsv = key_hsv(c);
  print("ffmpeg chromakey", chroma);
  print("ffmpeg colorkey", color);
  print("inRange in HSV", hsv);
  bool best = true;
  const auto against = [&](const Errors& e) {
    best = best && ours.mean <= e.mean && ours.square <= e.square && ours.gradient <= e.gradient &&
           ours.flicker <= e.flicker;
  };
  for (const Errors* e : {&chroma, &color, &hsv}) against(*e);
#ifdef VSPRITE_BENCH_OPENCV
  const Errors mog2 = key_mog2(c);
  print("OpenCV MOG2", mog2);
  against(mog2);
#else
  std::printf("    OpenCV MOG2            left out: built without OpenCV\n");
#endif
  const Errors closed = key_closed_form(c, mattes, closed_form_every);
  print("closed form, our seeds", closed);
  against(closed);
  std::fflush(stdout);
  won += best;
  ++all;
}

Case truth_case(int first_run, int runs, int length) {
  const std::string path = VSPRITE_SOURCE_DIR "/assets/goldfish.mp4";
  const capture::GoldfishFilm film;
  Case c;
  c.name = "the bundled film";
  if (auto samples = sample_frames(path, 50)) c.samples = std::move(*samples);
  auto reader = FilmReader::open(path);
  if (!reader) return c;
  capture::TruthFrame t;
  Frame frame;
  while (*reader->read(frame)) {
    const int run = frame.index / 160;
    const auto bounds = film.bounds(frame.index);
    if (frame.index % 160 >= length || run % 5 != first_run || run / 5 >= runs) continue;
    if (!bounds.visible || bounds.touches_border) continue;
    film.render(frame.index, t);
    c.follows.push_back(!c.frames.empty() && c.frames.back().index + 1 == frame.index);
    c.truth.push_back(t.alpha);
    c.band.push_back(band_of(t.alpha, t.width, t.height));
    c.frames.push_back(frame);
  }
  c.color[0] = 68, c.color[1] = 104, c.color[2] = 158;
  double mean[3] = {};
  for (std::size_t i = 0; i < t.plate.size(); ++i)
    mean[i % 3] += static_cast<double>(t.plate[i]) / static_cast<double>(t.plate.size() / 3);
  for (int p = 0; p < 3; ++p) c.color[p] = testing::SyntheticFilm::code(mean[p]);
  return c;
}

Case composite_case(const testing::Condition& condition, const std::vector<CutOut>& cuts,
                    const testing::TempFolder& folder) {
  Case c;
  c.name = condition.name;
  for (int p = 0; p < 3; ++p) c.color[p] = condition.screen[p];
  std::vector<Frame> filmed;
  for (std::size_t f = 0; f < cuts.size(); ++f)
    filmed.push_back(to_frame(testing::composite(cuts[f], condition, static_cast<int>(f))));
  const std::string path = folder.file("film.mp4");
  if (!testing::encode_film(
          filmed, path,
          "-threads 1 -c:v libx264 -preset veryfast -crf " + std::to_string(condition.crf)))
    return c;
  auto reader = FilmReader::open(path);
  Frame frame;
  while (reader && *reader->read(frame)) {
    c.samples.push_back(frame);
    // Six runs of four neighbours.
    if (frame.index % 10 >= 4) continue;
    const CutOut& cut = cuts[static_cast<std::size_t>(frame.index)];
    c.follows.push_back(!c.frames.empty() && c.frames.back().index + 1 == frame.index);
    c.frames.push_back(frame);
    c.truth.push_back(cut.alpha);
    c.band.push_back(band_of(cut.alpha, cut.width, cut.height));
  }
  return c;
}

std::vector<CutOut> fish_cuts(int count) {
  const capture::GoldfishFilm film;
  std::vector<CutOut> cuts;
  capture::TruthFrame t;
  for (int k = 0; static_cast<int>(cuts.size()) < count; ++k) {
    const int frame = 300 + 2 * k;
    const auto bounds = film.bounds(frame);
    if (!bounds.visible || bounds.touches_border) continue;
    film.render(frame, t);
    cuts.push_back({t.width, t.height, t.alpha, t.foreground});
  }
  return cuts;
}

template <class Make>
std::vector<CutOut> cuts_of(int count, Make make) {
  std::vector<CutOut> cuts;
  for (int k = 0; k < count; ++k) cuts.push_back(make(k));
  return cuts;
}

// The screens whose numbers were given, else all.
std::set<std::string> screens;
bool wanted(std::size_t number) {
  return screens.empty() || screens.count(std::to_string(number)) > 0;
}

// Every subject in turn, one a screen.
void run_pool(const char* title, const std::vector<testing::Condition>& pool,
              const std::vector<std::vector<CutOut>>& subjects, const testing::TempFolder& folder,
              std::size_t closed_form_every) {
  std::printf("%s: mean |e|, root mean square, gradient, flicker (percent, within %d px)\n", title,
              kBand);
  int won = 0, all = 0;
  for (std::size_t k = 0; k < pool.size(); ++k)
    if (wanted(k))
      compare(composite_case(pool[k], subjects[k % subjects.size()], folder), folder,
              closed_form_every, won, all);
  if (closed_form_every > 0) std::printf("  lowest of all four errors on %d of %d\n", won, all);
}

// The same grey over the same screen may be an opaque grey part or a translucent coloured one. What
// each reading costs: key strength over the film's own (translucent), as it is (opaque), between.
void run_decision(const testing::TempFolder& folder) {
  std::printf(
      "grey is opaque (1) or translucent (the film's strength): mean |e| of each reading\n");
  const auto row = [](const Case& c) {
    const auto screen = measure_screen(c.samples, {});
    if (!screen || screen->key < 0) return;
    const float full = screen->key_normaliser;
    std::printf("    %-28s strength %.2f:", c.name.c_str(), static_cast<double>(full));
    for (const float share : {0.0f, 0.5f, 1.0f}) {
      const float n = 1 + share * (full - 1);
      std::printf("  %6.2f at %.2f", measure(c, key_ours(c, n)).mean, static_cast<double>(n));
    }
    std::printf("\n");
    std::fflush(stdout);
  };
  row(truth_case(0, 6, 4));
  std::vector<CutOut> mice;
  for (int k = 0; k < 60; ++k) mice.push_back(testing::grey_mouse(k, 640, 480));
  const auto fish = fish_cuts(60);
  for (std::size_t k = 0; k < testing::conditions().size(); ++k) {
    if (!wanted(k)) continue;
    const testing::Condition& condition = testing::conditions()[k];
    for (const bool is_fish : {true, false}) {
      Case c = composite_case(condition, is_fish ? fish : mice, folder);
      c.name = (is_fish ? "fish, " : "grey mouse, ") + c.name;
      row(c);
    }
  }
}

// A matte at a place between pixels.
float sampled(const std::vector<float>& matte, int w, int h, double x, double y) {
  const int left = static_cast<int>(std::floor(x));
  const int top = static_cast<int>(std::floor(y));
  if (left < 0 || top < 0 || left + 1 >= w || top + 1 >= h) return 0;
  const auto i = static_cast<std::size_t>(top * w + left);
  const auto u = static_cast<float>(x - left);
  const auto v = static_cast<float>(y - top);
  const auto below = i + static_cast<std::size_t>(w);
  return (1 - v) * ((1 - u) * matte[i] + u * matte[i + 1]) +
         v * ((1 - u) * matte[below] + u * matte[below + 1]);
}

// Would the neighbours in time help? Each matte mixed with those before and after it, moved along
// with the subject's centroid, by more and more.
void run_temporal() {
  const Case c = truth_case(0, 6, 4);
  const Mattes plain = key_ours(c);
  const int w = c.frames[0].width;
  const int h = c.frames[0].height;
  std::vector<std::array<double, 2>> centre;
  for (const auto& matte : plain) {
    double sum = 1e-9, x_sum = 0, y_sum = 0;
    for (int y = 0; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        const auto a = static_cast<double>(matte[static_cast<std::size_t>(y * w + x)]);
        sum += a, x_sum += a * x, y_sum += a * y;
      }
    centre.push_back({x_sum / sum, y_sum / sum});
  }
  std::printf("the bundled film, mattes mixed with their neighbours in time\n");
  for (const float share : {0.0f, 0.1f, 0.2f, 0.3f}) {
    Mattes mixed = plain;
    for (std::size_t f = 0; f < mixed.size(); ++f)
      for (const std::size_t other : {f - 1, f + 1}) {
        if (other >= mixed.size() || !c.follows[std::max(f, other)]) continue;
        const double dx = centre[other][0] - centre[f][0];
        const double dy = centre[other][1] - centre[f][1];
        for (int y = 0; y < h; ++y)
          for (int x = 0; x < w; ++x) {
            const auto i = static_cast<std::size_t>(y * w + x);
            if (!c.band[f][i]) continue;
            mixed[f][i] += share * (sampled(plain[other], w, h, x + dx, y + dy) - plain[f][i]);
          }
      }
    char name[32];
    std::snprintf(name, sizeof name, "share %.1f each", static_cast<double>(share));
    print(name, measure(c, mixed));
  }
}

// Planes stretched to 1080p, nearest.
Frame stretched(const Frame& in, int w, int h) {
  Frame out;
  out.resize(w, h);
  out.coding = in.coding;
  const auto plane = [](const std::vector<std::uint8_t>& from, int fw, int fh,
                        std::vector<std::uint8_t>& to, int tw, int th) {
    for (int y = 0; y < th; ++y)
      for (int x = 0; x < tw; ++x)
        to[static_cast<std::size_t>(y * tw + x)] =
            from[static_cast<std::size_t>(y * fh / th * fw + x * fw / tw)];
  };
  plane(in.y, in.width, in.height, out.y, w, h);
  plane(in.cb, in.cell_width(), in.cell_height(), out.cb, out.cell_width(), out.cell_height());
  plane(in.cr, in.cell_width(), in.cell_height(), out.cr, out.cell_width(), out.cell_height());
  return out;
}

struct Times {
  double least = 1e9, middle = 0;
};
template <class Body>
Times repeat(int times, Body body) {
  std::vector<double> all;
  for (int k = 0; k < times; ++k) {
    const double start = seconds();
    body();
    all.push_back(seconds() - start);
  }
  std::sort(all.begin(), all.end());
  return {all.front(), all[all.size() / 2]};
}

void run_speed(const testing::TempFolder& folder) {
  const Case film = truth_case(1, 3, 8);
  std::vector<Frame> frames, samples;
  for (std::size_t f = 0; f < film.frames.size(); f += 2)
    frames.push_back(stretched(film.frames[f], 1920, 1080));
  for (std::size_t f = 0; f < film.samples.size(); f += 3)
    samples.push_back(stretched(film.samples[f], 1920, 1080));
  const auto start = seconds();
  const auto screen = measure_screen(samples, {});
  if (!screen) return;
  std::printf("speed, 1080p, one thread, %zu frames (screen measured on %zu in %.2f s)\n",
              frames.size(), samples.size(), seconds() - start);
  Keyer keyer(*screen, {});
  std::uint64_t area = 0;
  const Times ours = repeat(9, [&] {
    for (const Frame& frame : frames) area += keyer.key(frame, nullptr).labels.size();
  });
  const double count = static_cast<double>(frames.size());
  std::printf("    %-28s %7.1f frames/s (median %.1f)\n", "this keyer", count / ours.least,
              count / ours.middle);
  const std::string raw = folder.file("speed.raw");
  write_raw(frames, raw);
  const auto time = [&](const std::string& filter) {
    const std::string command = ffmpeg_of(frames[0], raw, filter, "-f null -");
    return repeat(3, [&] {
      if (std::system(command.c_str()) != 0) std::printf("ffmpeg failed\n");
    });
  };
  const Times null = time("");
  const std::string color = hex_of(film.color);
  for (const std::string& filter :
       {std::string("chromakey=") + color + ":0.1:0.08,format=rgba,despill=type=blue",
        std::string("format=rgba,colorkey=") + color + ":0.2:0.08,despill=type=blue"}) {
    const Times t = time(filter);
    const double rate = count / std::max(t.least - null.least, 1e-3);
    std::printf("    %-28s %7.1f frames/s: ours is %.1fx\n", filter.substr(0, 26).c_str(), rate,
                count / ours.least / rate);
  }
  if (area == 0) std::printf("nothing was keyed\n");
}

}  // namespace

int main(int argc, char** argv) {
  std::set<std::string> parts(argv + 1, argv + argc);
  for (const std::string& part : parts)
    if (part.find_first_not_of("0123456789") == std::string::npos) screens.insert(part);
  for (const std::string& number : screens) parts.erase(number);
  if (parts.empty())
    parts = {"speed", "truth", "chosen", "chosen2", "chosen3", "chosen4", "unseen2"};
  const bool alone = parts.count("ours") > 0;
  for (const std::string& part : parts)
    if (part.find('/') != std::string::npos) picture_folder = part;
  const testing::TempFolder folder;
  if (parts.count("speed")) run_speed(folder);
  if (parts.count("truth")) {
    std::printf("mean |e|, root mean square, gradient, flicker (percent, within %d px)\n", kBand);
    int won = 0, all = 0;
    compare(truth_case(0, 6, 4), folder, alone ? 0 : 4, won, all);
  }
  if (parts.count("temporal")) run_temporal();
  if (parts.count("decision")) run_decision(folder);
  if (parts.count("chosen"))
    run_pool("chosen with: the fish", testing::conditions(), {fish_cuts(60)}, folder,
             alone ? 0 : 12);
  if (parts.count("chosen2"))
    run_pool("chosen with: fur and a veil", testing::conditions(),
             {cuts_of(60, [](int k) { return testing::furry_ball(k, 640, 480); })}, folder,
             alone ? 0 : 12);
  const auto filmed = [](auto make) {
    return cuts_of(60, [make](int k) { return testing::shuttered(make, k, 640, 480, 0.5); });
  };
  if (parts.count("chosen3"))
    run_pool("chosen with: clear wings and long hair", testing::more_conditions(),
             {filmed(testing::dragonfly), filmed(testing::longhair)}, folder, alone ? 0 : 12);
  if (parts.count("chosen4"))
    run_pool("chosen with: a white bird, a puppet, a jellyfish", testing::plain_conditions(),
             {filmed(testing::gull), filmed(testing::puppet), filmed(testing::jellyfish)}, folder,
             alone ? 0 : 12);
  if (parts.count("unseen2"))
    run_pool("never seen: a seed head and a dancer", testing::unseen_conditions(),
             {filmed(testing::seed_head), filmed(testing::dancer)}, folder, alone ? 0 : 12);
  return 0;
}
