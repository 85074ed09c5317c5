// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// keytrial FILM SHEET.png [key [first step rows]] - keys a film, prints what came of it, and writes
// a contact sheet to look at.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "film/contact.h"
#include "film/extract.h"
#include "film/matte.h"
#include "film/plate.h"
#include "film/video.h"

using namespace vsprite;

namespace {

int fail(const Error& error) {
  std::fprintf(stderr, "keytrial: error: %s\n", error.message.c_str());
  return 1;
}

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::string path = argv[1];
  auto config = parse_key(argc > 3 ? argv[3] : "auto");
  if (!config) return fail(config.error());
  const int first = argc > 4 ? std::atoi(argv[4]) : 0;
  const int rows = argc > 6 ? std::atoi(argv[6]) : 6;
  double start = seconds();
  auto samples = sample_frames(path, config->sample_count);
  if (!samples) return fail(samples.error());
  std::printf("%zu frames sampled in %.2f s\n", samples->size(), seconds() - start);
  start = seconds();
  auto screen = measure_screen(*samples, *config);
  if (!screen) return fail(screen.error());
  std::printf(
      "%s; key %d normaliser %.2f noise %.2f %.2f %.2f threshold %.1f opening %d hidden %.4f (%.2f "
      "s)\n",
      screen->reason.c_str(), screen->key, static_cast<double>(screen->key_normaliser),
      static_cast<double>(screen->noise[0]), static_cast<double>(screen->noise[1]),
      static_cast<double>(screen->noise[2]), static_cast<double>(screen->threshold),
      screen->opening, static_cast<double>(screen->hidden), seconds() - start);
  auto film = FilmReader::open(path);
  if (!film) return fail(film.error());
  const int total = film->info().claimed_frames;
  const int step =
      argc > 5 && std::atoi(argv[5]) > 0 ? std::atoi(argv[5]) : std::max((total - first) / rows, 1);

  Keyer keyer(*screen, {});
  Frame frame;
  Frame before;
  std::vector<FrameSummary> summaries;
  std::vector<Frame> shown;
  std::vector<KeyedFrame> shown_keyed;
  double keying = 0;
  for (;;) {
    auto more = film->read(frame);
    if (!more) return fail(more.error());
    if (!*more) break;
    start = seconds();
    KeyedFrame keyed = keyer.key(frame, frame.index > 0 ? &before : nullptr);
    keying += seconds() - start;
    summaries.push_back({keyed.index, keyed.blobs, keyed.difference});
    if (frame.index >= first && (frame.index - first) % step == 0 &&
        static_cast<int>(shown.size()) < rows) {
      shown.push_back(frame);
      shown_keyed.push_back(std::move(keyed));
    }
    std::swap(frame, before);
  }
  std::printf("keyed at %.0f frames/s\n", static_cast<double>(summaries.size()) / keying);
  const Image sheet = make_contact_sheet(shown, shown_keyed);
  if (auto png = encode_png(sheet)) {
    std::ofstream(argv[2], std::ios::binary)
        .write(reinterpret_cast<const char*>(png->data()),
               static_cast<std::streamsize>(png->size()));
  }
  const double fps = static_cast<double>(film->info().fps_numerator) / film->info().fps_denominator;
  auto extraction = extract(summaries, fps, path, {});
  if (!extraction) return fail(extraction.error());
  std::printf(
      "%zu frames: %zu samples in %d clips, %d duplicates, %d at the border, %d empty, %d in short "
      "clips, "
      "velocity noise %.2f px/s, scale %.3f\n",
      extraction->fates.size(), extraction->rows.size(), extraction->clips,
      extraction->count(Fate::Duplicate), extraction->count(Fate::Border),
      extraction->count(Fate::Empty), extraction->count(Fate::Short), extraction->velocity_noise,
      extraction->rows[0].scale);
  if (argc > 7) {
    std::ofstream csv(argv[7]);
    for (const FrameSummary& s : summaries) {
      csv << s.index << ',' << s.difference << ',' << s.blobs.size();
      if (!s.blobs.empty())
        csv << ',' << s.blobs[0].anchor_x << ',' << s.blobs[0].anchor_y << ',' << s.blobs[0].area
            << ',' << s.blobs[0].touches_border << ',' << s.blobs[0].box.width << ','
            << s.blobs[0].box.height;
      csv << '\n';
    }
  }
  return 0;
}
