// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// capture - films the goldfish, and writes what was true in every frame.
#include <tbb/parallel_for.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <future>
#include <string>
#include <vector>

#include "film_writer.h"
#include "goldfish.h"
#include "statistics.h"
#include "vsprite/image.h"

namespace vsprite::capture {
namespace {

struct Options {
  std::string out, truth, stills;
  std::vector<int> frames;
  int every = 1;
  int count = 0;
  double crf = 18.6;  // the bundled film's: just below 10 MB
  bool stats = false;
};

constexpr int kBatch = 24;  // frames in flight

/// Renders the listed frames, many at a time, and hands them over in order; the frames of one batch
/// are taken while the next is rendered.
template <class Take>
Result<void> render_all(const GoldfishFilm& film, const std::vector<int>& frames, Take take) {
  std::vector<TruthFrame> batch(kBatch), done_batch(kBatch);
  std::future<Result<void>> taking;
  for (std::size_t first = 0; first < frames.size(); first += kBatch) {
    const std::size_t n = std::min<std::size_t>(kBatch, frames.size() - first);
    tbb::parallel_for(std::size_t{0}, n,
                      [&](std::size_t k) { film.render(frames[first + k], batch[k]); });
    if (taking.valid()) {
      if (Result<void> done = taking.get(); !done) return done;
    }
    batch.swap(done_batch);
    taking = std::async(std::launch::async, [&, first, n]() -> Result<void> {
      for (std::size_t k = 0; k < n; ++k) {
        if (Result<void> done = take(frames[first + k], done_batch[k]); !done) return done;
      }
      return {};
    });
    if (first / 960 != (first + kBatch) / 960) {
      std::fprintf(stderr, "capture: %zu of %zu frames\n", first + n, frames.size());
    }
  }
  return taking.valid() ? taking.get() : Result<void>{};
}

Result<void> save(const std::string& path, const Image& image) {
  const Result<std::vector<std::uint8_t>> bytes = encode_png(image);
  if (!bytes) return bytes.error();
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes->data()),
             static_cast<std::streamsize>(bytes->size()));
  file.close();
  if (!file) return Error{ErrorCode::CannotWrite, path + ": the file could not be written"};
  return {};
}

std::string numbered(const std::string& folder, const char* name, int frame) {
  char text[64];
  std::snprintf(text, sizeof text, "/%s_%05d.png", name, frame);
  return folder + text;
}

std::uint8_t code_of(float linear) {
  return srgb_from_linear(
      static_cast<std::uint16_t>(std::lround(65535 * std::clamp(linear, 0.0f, 1.0f))));
}

/// Alpha as a grey picture, and the fish's own colour as straight RGBA.
void truth_images(const TruthFrame& t, Image& alpha, Image& foreground) {
  alpha.width = foreground.width = t.width;
  alpha.height = foreground.height = t.height;
  alpha.rgba.assign(4 * t.alpha.size(), 255);
  foreground.rgba.assign(4 * t.alpha.size(), 0);
  for (std::size_t i = 0; i < t.alpha.size(); ++i) {
    const auto a = static_cast<std::uint8_t>(std::lround(255 * t.alpha[i]));
    for (std::size_t c = 0; c < 3; ++c) {
      alpha.rgba[4 * i + c] = a;
      if (a > 0) foreground.rgba[4 * i + c] = code_of(t.foreground[3 * i + c]);
    }
    foreground.rgba[4 * i + 3] = a;
  }
}

std::string truth_row(const GoldfishFilm& film, int frame, const TruthFrame& t) {
  const FishPose& p = film.pose(frame);
  const FishBounds b = film.bounds(frame);
  char row[512];
  std::snprintf(
      row, sizeof row,
      "%d,%d,%d,%.4f,%.4f,%.4f,%.4f,%.3f,%.3f,%.3f,%.2f,%.5f,%.5f,%.5f,%.5f,%.4f,%.4f,%d\n", frame,
      b.visible ? 1 : 0, b.touches_border ? 1 : 0, p.x, p.y, t.centroid_x, t.centroid_y,
      p.velocity_x, p.velocity_y, p.speed, t.area, p.yaw, p.pitch, p.bend, p.arch, p.tail_phase,
      p.tail_amplitude, p.heading);
  return row;
}

Result<void> write_truth(const GoldfishFilm& film, const std::vector<int>& frames,
                         const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Error{ErrorCode::CannotCreate, folder + ": " + failed.message()};
  std::string table =
      "frame,visible,touches_border,x,y,centroid_x,centroid_y,velocity_x,velocity_y,speed,area,"
      "yaw,pitch,bend,arch,tail_phase,tail_amplitude,heading\n";
  Image alpha, foreground;
  const Result<void> done = render_all(film, frames, [&](int frame, const TruthFrame& t) {
    truth_images(t, alpha, foreground);
    table += truth_row(film, frame, t);
    if (Result<void> saved = save(numbered(folder, "alpha", frame), alpha); !saved) return saved;
    return save(numbered(folder, "foreground", frame), foreground);
  });
  if (!done) return done;
  std::ofstream file(folder + "/truth.csv");
  file << table;
  file.close();
  if (!file) return Error{ErrorCode::CannotWrite, folder + "/truth.csv: could not be written"};
  return {};
}

Result<void> write_stills(const GoldfishFilm& film, const std::vector<int>& frames,
                          const std::string& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Error{ErrorCode::CannotCreate, folder + ": " + failed.message()};
  return render_all(film, frames, [&](int frame, const TruthFrame& t) {
    return save(numbered(folder, "frame", frame), t.composite);
  });
}

Result<void> write_film(const GoldfishFilm& film, const Options& options) {
  std::vector<int> frames(static_cast<std::size_t>(
      options.count > 0 ? std::min(options.count, film.frame_count()) : film.frame_count()));
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = static_cast<int>(i);
  Result<FilmWriter> writer = FilmWriter::open(
      options.out, {film.width(), film.height(), static_cast<int>(film.fps()), options.crf});
  if (!writer) return writer.error();
  const Result<void> done = render_all(
      film, frames, [&](int, const TruthFrame& t) { return writer->write(t.composite); });
  if (!done) return done;
  return writer->finish();
}

std::vector<int> chosen_frames(const GoldfishFilm& film, const Options& options) {
  if (!options.frames.empty()) return options.frames;
  std::vector<int> frames;
  for (int k = 0; k < film.frame_count(); k += options.every) frames.push_back(k);
  return frames;
}

Result<void> run(const Options& options) {
  const GoldfishFilm film;
  for (const int k : options.frames) {
    if (k < 0 || k >= film.frame_count()) {
      return Error{ErrorCode::BadSetting, "--frames: " + std::to_string(k) +
                                              " is not a frame of the film, which has 0 to " +
                                              std::to_string(film.frame_count() - 1)};
    }
  }
  if (options.stats) std::fputs(statistics_text(film).c_str(), stdout);
  const std::vector<int> frames = chosen_frames(film, options);
  if (!options.stills.empty()) {
    if (Result<void> done = write_stills(film, frames, options.stills); !done) return done;
  }
  if (!options.truth.empty()) {
    if (Result<void> done = write_truth(film, frames, options.truth); !done) return done;
  }
  return options.out.empty() ? Result<void>{} : write_film(film, options);
}

}  // namespace
}  // namespace vsprite::capture

int main(int argc, char** argv) {
  using namespace vsprite;
  capture::Options options;
  CLI::App app{"capture - films a goldfish before a blue screen, and writes the exact truth of it"};
  app.add_option("--out", options.out, "film to write (MP4)")->type_name("FILM");
  app.add_option("--crf", options.crf, "x264 quality of the film, 0 (best) to 51")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 51.0));
  app.add_option("--count", options.count, "film only the first N frames")->type_name("N");
  app.add_option("--truth", options.truth, "folder for alpha_N.png, foreground_N.png and truth.csv")
      ->type_name("DIR");
  app.add_option("--frames-png", options.stills, "folder for the frames as filmed, before coding")
      ->type_name("DIR");
  app.add_option("--frames", options.frames, "which frames, for --truth and --frames-png")
      ->delimiter(',')
      ->type_name("A,B,C");
  app.add_option("--every", options.every, "or every N-th")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000));
  app.add_flag("--stats", options.stats, "say what the film holds");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (options.out.empty() && options.truth.empty() && options.stills.empty() && !options.stats) {
    std::fputs(app.help().c_str(), stdout);
    return 0;
  }
  if (const Result<void> done = capture::run(options); !done) {
    std::fprintf(stderr, "capture: error: %s\n", done.error().message.c_str());
    return 1;
  }
  return 0;
}
