// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// points: the control points of views, placed in a window, taken from an SVG, or edited by a
// script.
#include <filesystem>

#include "tool/commands/verbs.h"
#include "tool/files.h"
#include "tool/points_edit.h"
#include "tool/report.h"
#include "tool/svg_points.h"
#include "tool/views_file.h"
#ifdef VSPRITE_WINDOW
#include "window/points.h"
#endif

namespace vsprite {
namespace {

namespace fs = std::filesystem;

Result<void> import_points(const Settings& settings, PointsEdit& edit) {
  const auto text = read_file(settings.import_file);
  if (!text) return text.error();
  const auto index = static_cast<std::size_t>(settings.view - 1);
  const View* picture = &edit.sheet(index);
  for (std::size_t k = 0; k < edit.sheet_count() && picture->picture.width == 0; ++k)
    picture = &edit.sheet(k);
  if (picture->picture.width == 0)
    return Error{ErrorCode::BadContent,
                 settings.film + ": no view has a picture that a drawing could lie over"};
  const auto points = parse_svg_points(*text, settings.import_file, picture->picture.width,
                                       picture->picture.height);
  if (!points) return points.error();
  if (auto done = edit.replace(index, PointLayer::Picture, *points); !done)
    return Error{ErrorCode::BadContent, settings.import_file + ": " + done.error().message};
  return {};
}

#ifdef VSPRITE_WINDOW
Result<void> show_window(const Settings& settings, PointsFile& file, PointsEdit& edit,
                         Console& console) {
  PointsWindowOptions options;
  options.first_sheet = static_cast<std::size_t>(settings.view - 1);
  options.headless = settings.headless;
  options.frames = settings.headless && settings.frames == 0 ? 60 : settings.frames;
  options.screenshot = settings.record;
  options.saved = [&console](const std::string& what) { console.remark(what); };
  return points_window(file, edit, options);
}
#else
Result<void> show_window(const Settings&, PointsFile&, PointsEdit&, Console&) {
  return Error{ErrorCode::Unavailable,
               "this vsprite was built without windows: write the points into the file, or give "
               "them with --import or --script"};
}
#endif

/// What a fit would say of it, or nothing.
std::string fault_of(const PointsEdit& edit) {
  if (auto checked = check_views(edit.set()); !checked) return checked.error().message;
  if (auto fitted = fit_puppets(edit.set()); !fitted) return fitted.error().message;
  return {};
}

}  // namespace

Result<int> run_points(const Settings& settings, Console& console) {
  if (settings.film.empty())
    return Error{ErrorCode::BadSetting, "a file of views is due: VIEWS.toml"};
  auto file = PointsFile::open(settings.film);
  if (!file) return file.error();
  auto set = parse_draft_views(file->text(), settings.film);
  if (!set) return set.error();
  auto edit = PointsEdit::make(std::move(*set));
  if (!edit) return Error{edit.error().code, settings.film + ": " + edit.error().message};
  if (static_cast<std::size_t>(settings.view) > edit->sheet_count())
    return Error{ErrorCode::BadSetting, "--view " + std::to_string(settings.view) + ": " +
                                            settings.film + " has " +
                                            std::to_string(edit->sheet_count())};
  if (!settings.import_file.empty())
    if (auto done = import_points(settings, *edit); !done) return done.error();
  if (!settings.script.empty()) {
    const auto text = read_file(settings.script);
    if (!text) return text.error();
    if (auto done = run_points_script(*text, settings.script, *edit); !done) return done.error();
  }
  std::string aside;
  if (settings.window) {
    if (auto shown = show_window(settings, *file, *edit, console); !shown) return shown.error();
    if (!edit->is_saved()) {
      const auto spare = file->save_aside(*edit);
      if (!spare) return spare.error();
      aside = *spare;
    }
  } else if (!edit->is_saved()) {
    if (auto saved = file->save(*edit); !saved) return saved.error();
  }

  const std::string fault = fault_of(*edit);
  std::string text = settings.film + ": " + std::to_string(edit->point_count()) +
                     " control points in " + std::to_string(edit->sheet_count()) + " views, " +
                     std::to_string(edit->faces().size()) + " faces, " +
                     (edit->has_own_faces() ? "those of the file\n" : "made from the points\n");
  if (!aside.empty()) text = settings.film + ": not saved; what was placed lies in " + aside + "\n";
  if (!fault.empty()) console.remark("not to be fitted yet: " + fault);
  console.text(text);
  console.document({{"views", edit->sheet_count()},
                    {"points", edit->point_count()},
                    {"faces", edit->faces().size()},
                    {"own_faces", edit->has_own_faces()},
                    {"saved", aside.empty()},
                    {"fault", fault}});
  console.next("vsprite fit " + shell_word(settings.film) + " -o " +
               shell_word(fs::path(settings.film).stem().string() + ".vsp"));
  return 0;
}

}  // namespace vsprite
