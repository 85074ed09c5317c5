// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// tool/film_report.h - what a film became and what to film next: one self-contained HTML page, and
// JSON. Makes text only.
#pragma once

#include <optional>
#include <string>

#include "control/advice.h"
#include "similarity/classifier.h"
#include "tool/project.h"
#include "vsprite/sprite.h"

namespace vsprite {

struct FilmReport {
  std::string mode;
  Advice advice;
  std::optional<Classifier> classifier;  ///< of the work folder, where there is one
  Json records = Json::object();         ///< figures of its stages, by name
  std::string roc{};                     ///< its roc.svg
  std::string contact{};                 ///< its contact.png, the bytes
  struct Dropped {
    std::string reason;
    int frame = 0;
    double share = 0;  ///< of the film's frames
    std::string png;   ///< a frame that was left out for it
  };
  std::vector<Dropped> dropped{};
};

Json report_json(const Sprite& sprite, const FilmReport& report);
/// Plain sentences for the terminal.
std::string report_text(const Sprite& sprite, const FilmReport& report);
/// The page: inline SVG and PNG, nothing fetched. Errors: those of decode_frame and encode_png.
Result<std::string> report_html(const Sprite& sprite, const FilmReport& report);

}  // namespace vsprite
