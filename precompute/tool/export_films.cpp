// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// One moving picture a run, all of one size, and runs.json, which says what the pictures cannot:
// where the anchor is and how the character moves while a run plays.
#include <filesystem>

#include "tool/atlas.h"
#include "tool/export.h"
#include "vsprite/compose.h"
#include "vsprite/record.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

Result<void> write_run(const ExportJob& job, const PlayedRun& run, const Canvas& canvas,
                       const std::string& path) {
  FilmWriter film;
  if (auto opened = film.open(path, canvas.width, canvas.height, fps_of(job.choice.data)); !opened)
    return opened;
  for (const std::uint32_t i : run.samples) {
    const Sample& s = job.choice.data.samples[i];
    const auto picture = straight_picture(job.film, job.choice.from[i]);
    if (!picture) return picture.error();
    Image frame = make_image(canvas.width, canvas.height, 0, 0, 0, 0);
    put_picture(frame, *picture, canvas.left(s), canvas.top(s));
    for (int tick = 0; tick < s.duration; ++tick)
      if (auto added = film.add(frame); !added) return added;
  }
  return film.close();
}

Json run_json(const SpriteData& data, const PlayedRun& run, const std::string& file) {
  Json samples = Json::array(), film = Json::array(), ticks = Json::array(), x = Json::array(),
       y = Json::array();
  for (const std::uint32_t i : run.samples) {
    const Sample& s = data.samples[i];
    film.push_back(s.frame);
    ticks.push_back(s.duration);
    x.push_back(s.velocity.x);
    y.push_back(s.velocity.y);
  }
  Json json{{"name", run.name},   {"file", file},    {"loops", run.loops}, {"frames", film},
            {"durations", ticks}, {"velocity_x", x}, {"velocity_y", y}};
  if (run.seam) json["seam"] = *run.seam;
  return json;
}

Result<Json> write_films(const ExportJob& job, const char* ending) {
  const SpriteData& data = job.choice.data;
  const Canvas canvas = canvas_of(data, job.runs);
  Json runs = Json::array();
  std::size_t done = 0, frames = 0;
  for (const PlayedRun& run : job.runs) {
    const std::string file = run.name + ending;
    if (auto wrote = write_run(job, run, canvas, (fs::path(job.output) / file).string()); !wrote)
      return wrote.error();
    runs.push_back(run_json(data, run, file));
    frames += run.samples.size();
    if (job.progress)
      job.progress(static_cast<double>(++done) / static_cast<double>(job.runs.size()));
  }
  const Json document{{"format", "vsprite-runs"},
                      {"version", 1},
                      {"name", data.name},
                      {"fps", fps_of(data)},
                      {"width", canvas.width},
                      {"height", canvas.height},
                      {"anchor_x", canvas.width / 2},
                      {"anchor_y", canvas.height / 2},
                      {"body_length", data.body_length},
                      {"runs", std::move(runs)}};
  if (auto wrote = write_json(job, "runs.json", document); !wrote) return wrote.error();
  return export_report(job, frames);
}

}  // namespace

Result<Json> write_apngs(const ExportJob& job) { return write_films(job, ".apng"); }
Result<Json> write_gifs(const ExportJob& job) { return write_films(job, ".gif"); }
Result<Json> write_webms(const ExportJob& job) { return write_films(job, ".webm"); }
Result<Json> write_ffv1s(const ExportJob& job) { return write_films(job, ".mkv"); }

}  // namespace vsprite
