// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// doctor FILM: what a film is worth before it is built, and what to film otherwise.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "film/checkup.h"
#include "film/plate.h"
#include "film/video.h"
#include "tool/commands/doctor.h"
#include "tool/report.h"
#include "vsprite/geometry.h"

namespace vsprite {
namespace {

constexpr int kBursts = 36, kBurstFrames = 10;
constexpr double kOtherPlace = 20;     // code values of colour; no lamp changes so much
constexpr double kLeastSeconds = 20;   // usable; below that few jumps are found
constexpr double kHeadingSeconds = 2;  // of a direction; below that it is hardly served

std::string percent(double share) {
  return fixed_text(100 * share, share > 0 && share < 0.095 ? 1 : 0) + " %";
}

std::string seconds_text(double seconds) {
  return fixed_text(seconds, seconds < 10 ? 1 : 0) + " s";
}

/// What the verdicts are made of.
struct Patient {
  std::string path;
  FilmInfo info;
  double fps = 30, seconds = 0;
  ScreenModel screen;
  MatteConfig matte;
  Checkup c;

  double usable() const { return seconds * std::max(c.whole - c.several, 0.0); }
};

Finding film_verdict(const Patient& p) {
  const FilmInfo& info = p.info;
  std::string text = p.path + ": " + std::to_string(info.counted_frames) + " frames of " +
                     std::to_string(info.width) + "x" + std::to_string(info.height) + " px, " +
                     fixed_text(p.fps, 2) + " a second, " + seconds_text(p.seconds) + "; " +
                     info.pixel_format;
  if (info.rotation != 0) text += ", turned by " + std::to_string(info.rotation) + " degrees";
  if (info.transfer != Transfer::Sdr) text += info.transfer == Transfer::Hlg ? ", HLG" : ", PQ";
  if (info.counted_frames < 0.98 * info.claimed_frames - 2)
    return {"film", kBroken,
            text + "; it ends early, " + std::to_string(info.claimed_frames) +
                " frames are due by its header",
            "copy it again from its source"};
  if (info.transfer != Transfer::Sdr)
    return {"film", kWarning,
            text + ": high dynamic range is mapped to plain video by a fixed curve",
            "highlights are compressed: with HDR switched off they would be as filmed"};
  if (info.interlaced)
    return {"film", kWarning, text + "; interlaced: moving edges are combs",
            "ffmpeg -i " + p.path + " -vf bwdif -c:v libx264 -crf 16 whole-frames.mp4"};
  return {"film", kOk, text};
}

Finding camera_verdict(const Patient& p) {
  const Checkup& c = p.c;
  const bool plate = p.screen.kind == KeyKind::Plate;
  if (c.white_shift > kOtherPlace)
    return {"camera", kWarning,
            "camera: the background itself changes, its colour by " + fixed_text(c.white_shift, 0) +
                " of 255: the camera is turned, or something large comes into the picture",
            "put it on a stand, and cut out what shows another place: ffmpeg -ss FROM -to TO"};
  if (c.plain)
    return {"camera", kOk, "camera: the background is plain, whether it moves cannot be told"};
  const double most = std::max(1.5, 0.003 * p.info.width);
  const std::string figures = fixed_text(c.camera_shake, 2) + " px from frame to frame, " +
                              fixed_text(c.camera_shift, 1) + " px over the film";
  if (c.camera_shake < 0.5 && c.camera_shift < most)
    return {"camera", kOk, "camera: stands still (" + figures + ")"};
  return {
      "camera", kWarning,
      "camera: moves, " + figures + (plate ? ": what moves with it is taken for the subject" : ""),
      "put it on a stand and film again, or steady the film first with a stabiliser"};
}

Finding light_verdict(const Patient& p) {
  const Checkup& c = p.c;
  const std::string figures = "brightness changes by " + percent(c.exposure_shift) + ", by " +
                              percent(c.exposure_step) + " from frame to frame; colour by " +
                              fixed_text(c.white_shift, 1) + " of 255";
  if (c.exposure_shift < 0.06 && c.exposure_step < 0.02 && c.white_shift < 3)
    return {"light", kOk, "light: steady, " + figures};
  return {"light", kWarning, "light: " + figures + "; slow drift is followed, steps cost jumps",
          "lock exposure, white balance and focus before filming; no daylight with clouds"};
}

Finding rate_verdict(const Patient& p) {
  const Checkup& c = p.c;
  std::string text = "frame rate: " + fixed_text(p.fps, 2) + " a second";
  if (c.irregular > 0.02)
    text +=
        ", at irregular times (" + percent(c.irregular) + " of them), played as if at even ones";
  if (c.repeated < 0.03) return {"rate", kOk, text + ", no repeated frames"};
  return {"rate", kWarning,
          text + ", of these " + fixed_text(p.fps * (1 - c.repeated), 1) +
              " real while it moves: " + percent(c.repeated) + " repeat the frame before",
          "they are dropped, and the film is worth so much less: film at the camera's own rate, "
          "use the original file"};
}

Finding screen_verdict(const Patient& p) {
  const Checkup& c = p.c;
  const bool color = p.screen.kind == KeyKind::Color;
  std::string text = "background: " + p.screen.reason;
  if (color) text += "; its brightness varies by " + percent(c.unevenness);
  if (c.lost > 0.03)
    return {"screen", kWarning,
            text + "; " + percent(c.lost) +
                " of the subject is too like it and shows as holes (or has holes)",
            "look: vsprite segment " + shell_word(p.path) +
                " --preview 8; a background of another colour or brightness helps"};
  if (color && c.unevenness > 0.5)
    return {"screen", kWarning, text, "light it from two sides, keep the subject off the screen"};
  return {"screen", kOk, text};
}

Finding subject_verdict(const Patient& p) {
  const Checkup& c = p.c;
  if (c.present < 0.02)
    return {"subject", kBroken, "subject: none is found in " + std::to_string(c.frames) + " frames",
            "look: vsprite segment " + shell_word(p.path) +
                " --preview 8; or name the screen's colour: --key"};
  std::string text = "subject: ";
  if (c.body > 0) text += fixed_text(c.body, 0) + " px long, ";
  text += "whole in " + percent(c.whole) + " of the frames";
  const double cut = c.present - c.whole;
  if (cut > 0.005) text += ", cut by the border in " + percent(cut);
  if (c.present < 0.995) text += ", absent in " + percent(1 - c.present);
  if (c.several > 0.05)
    return {"subject", kWarning, text + "; several of like size in " + percent(c.several),
            "film one, or say which: --subject largest"};
  if (c.whole < 0.8)
    return {"subject", kWarning, text,
            "leave a margin on all sides, so that it stays in the picture"};
  if (c.body < 48)
    return {"subject", kWarning, text + ": small", "go nearer, or film at a higher resolution"};
  return {"subject", kOk, text};
}

Finding blur_verdict(const Patient& p) {
  const Checkup& c = p.c;
  const double extra = c.edge_fast - c.edge_slow;
  const std::string text = "motion blur: edges are " + fixed_text(c.edge_slow, 1) +
                           " px wide at rest, " + fixed_text(c.edge_fast, 1) +
                           " px where it is fast";
  if (!(c.edge_fast > 0)) return {"blur", kOk, "motion blur: too little of it to tell"};
  if (extra > std::max(2.0, 0.03 * c.body))
    return {"blur", kWarning, text, "more light, a shorter exposure (1/250 s)"};
  return {"blur", kOk, text};
}

Finding motion_verdict(const Patient& p) {
  const Checkup& c = p.c;
  const double whole = p.seconds * c.whole;
  std::string seen, missing;
  int served = 0, level = 0;  // directions seen for long enough, and right and left among them
  for (std::size_t d = 0; d < c.headings.size(); ++d) {
    const std::string name(direction_name(static_cast<Direction>(d)));
    const double seconds = whole * c.headings[d];
    if (seconds >= 0.05) seen += (seen.empty() ? "" : ", ") + name + " " + seconds_text(seconds);
    if (seconds < kHeadingSeconds)
      missing += (missing.empty() ? "" : ", ") + name;
    else
      ++served, level += d % 4 == 0;
  }
  if (1 - c.still < 0.05)
    return {"motion", kWarning,
            "motion: it hardly leaves its place, " + seconds_text(whole * (1 - c.still)) +
                " in all: the character will play by itself, not steer",
            "film it on its way: every direction for some seconds, every turn twice"};
  if (seen.empty())
    return {"motion", kWarning, "motion: too short a film to tell",
            "film it for longer, with every direction and turn"};
  const std::string text = "motion: " + seen + ", at rest " + seconds_text(whole * c.still) + "; " +
                           fixed_text(c.speed_usual, 0) + " px/s as a rule, " +
                           fixed_text(c.speed_fast, 0) + " at its fastest";
  if (missing.empty()) return {"motion", kOk, text};
  if (served == 2 && level == 2) return {"motion", kOk, text + "; a side view: right and left"};
  return {"motion", kWarning,
          text + (served == 0 ? "; no direction for " + seconds_text(kHeadingSeconds)
                              : "; under " + seconds_text(kHeadingSeconds) + ": " + missing),
          "film more of these, with turns into them and out of them"};
}

Finding length_verdict(const Patient& p) {
  const double usable = p.usable();
  const std::string text =
      "usable: about " + seconds_text(usable) + " of " + seconds_text(p.seconds);
  if (usable >= kLeastSeconds) return {"length", kOk, text};
  return {"length", kWarning, text + ": few jumps will be found",
          "film longer: three minutes, with every direction and turn"};
}

Json measures_of(const Patient& p) {
  const Checkup& c = p.c;
  Json headings = Json::object();
  for (std::size_t d = 0; d < c.headings.size(); ++d)
    headings[std::string(direction_name(static_cast<Direction>(d)))] =
        p.seconds * c.whole * c.headings[d];
  return {{"frames", p.info.counted_frames},
          {"fps", p.fps},
          {"seconds", p.seconds},
          {"usable_seconds", p.usable()},
          {"looked_at", c.frames},
          {"background", p.screen.reason},
          {"plain", c.plain},
          {"camera_shake_px", c.camera_shake},
          {"camera_shift_px", c.camera_shift},
          {"exposure_shift", c.exposure_shift},
          {"exposure_step", c.exposure_step},
          {"white_shift", c.white_shift},
          {"repeated", c.repeated},
          {"irregular", c.irregular},
          {"unevenness", c.unevenness},
          {"lost", c.lost},
          {"present", c.present},
          {"whole", c.whole},
          {"several", c.several},
          {"body_px", c.body},
          {"edge_slow_px", c.edge_slow},
          {"edge_fast_px", c.edge_fast},
          {"speed_usual", c.speed_usual},
          {"speed_fast", c.speed_fast},
          {"still_seconds", p.seconds * c.whole * c.still},
          {"heading_seconds", headings}};
}

void key_burst(const ScreenModel& screen, const MatteConfig& matte, Burst& burst) {
  burst.keyed.resize(burst.frames.size());
  tbb::parallel_for(std::size_t{0}, burst.frames.size(), [&](std::size_t f) {
    Keyer keyer(screen, matte);
    burst.keyed[f] = keyer.key(burst.frames[f], nullptr);
  });
}

/// Runs of frames through the keyer and the meter.
Result<Checkup> look_through(FilmReader& reader, const Patient& p) {
  const FilmInfo& info = p.info;
  CheckupMeter meter(p.fps, static_cast<double>(info.time_numerator) / info.time_denominator);
  Burst burst;
  for (Frame frame;;) {
    const auto more = reader.read(frame);
    if (!more) return more.error();
    const bool joins = *more && !burst.frames.empty() &&
                       frame.index == burst.frames.back().index + 1 &&
                       burst.frames.size() < kBurstFrames;
    if (!joins) {
      key_burst(p.screen, p.matte, burst);
      meter.add(burst);
      burst = {};
    }
    if (!*more) return meter.finish();
    burst.frames.push_back(std::move(frame));
    frame = {};
  }
}

}  // namespace

void check_film(const Settings& settings, const std::string& path, Findings& findings,
                Json& measures) {
  const auto broken = [&findings](const Error& error, const char* remedy) {
    findings.push_back({"film", kBroken, error.message, remedy});
  };
  constexpr const char* kConvert =
      "play it with another program, or convert it: ffmpeg -i FILE new.mp4";
  const auto key = parse_key(settings.key);
  if (!key) return broken(key.error(), "name a colour as #RRGGBB");
  const auto matte = matte_of(settings);
  if (!matte) return broken(matte.error(), "raise --clip-white, or lower --clip-black");
  auto reader = FilmReader::open_bursts(source_of(settings, path), kBursts, kBurstFrames);
  if (!reader)
    return broken(reader.error(), reader.error().code == ErrorCode::NotFound
                                      ? "look at the name, and at the folder you are in"
                                      : kConvert);
  Patient p;
  p.path = path;
  p.matte = *matte;
  p.info = reader->info();
  p.fps = static_cast<double>(p.info.fps_numerator) / p.info.fps_denominator;
  p.seconds = p.info.counted_frames / p.fps;
  const auto sampled = sample_frames(source_of(settings, path), key->sample_count);
  if (!sampled) return broken(sampled.error(), kConvert);
  if (const Bars bars = find_bars(*sampled); bars.any())
    findings.push_back({"bars", kWarning,
                        path + ": " + bars.text() + " are taken for a part of the film",
                        "ffmpeg -i " + shell_word(path) + " -vf " +
                            bars.crop(p.info.width, p.info.height) + " out.mp4"});
  auto screen = measure_screen(*sampled, *key);
  if (!screen) {
    findings.push_back(film_verdict(p));
    findings.push_back({"screen", kBroken, path + ": " + screen.error().message,
                        "film before one even colour, or from a stand; or name its colour: --key"});
    return;
  }
  p.screen = std::move(*screen);
  const auto checkup = look_through(*reader, p);
  if (!checkup) return broken(checkup.error(), kConvert);
  p.c = *checkup;
  for (const auto verdict :
       {film_verdict, camera_verdict, light_verdict, rate_verdict, screen_verdict, subject_verdict})
    findings.push_back(verdict(p));
  if (p.c.whole > 0)
    for (const auto verdict : {blur_verdict, motion_verdict, length_verdict})
      findings.push_back(verdict(p));
  measures = measures_of(p);
}

}  // namespace vsprite
