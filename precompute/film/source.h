// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/source.h - where frames come from: a film, a picture, pictures in a row, a matte beside it.
//
//   walk.mp4        a film                     shots/            a folder of pictures, or of films
//   walk.png        one picture                walk_%04d.png     numbered pictures
//                                              'walk_*.png'      the pictures that fit
//
// Everywhere in natural order: walk_9.png comes before walk_10.png.
#pragma once

#include <climits>
#include <string>
#include <vector>

#include "vsprite/result.h"

namespace vsprite {

/// One clip as a person names it. FilmReader (film/video.h) reads it.
struct FilmSource {
  FilmSource() = default;
  FilmSource(std::string film) : path(std::move(film)) {}  // NOLINT: a name is a source
  FilmSource(const char* film) : path(film) {}             // NOLINT

  std::string path;
  std::string matte =
      {};          ///< a source of the same frames whose brightness is the coverage; or none
  double fps = 0;  ///< of pictures, a second, 0 = 30; a film knows its own
  int first = 0, end = INT_MAX;  ///< frames first..end-1 alone; they keep their numbers
};

/// "a2" before "a10": runs of digits compare as numbers, all else byte by byte. A total order.
bool natural_less(const std::string& a, const std::string& b);

/// True where `path` is a folder or pattern of pictures, or a picture, not a film.
bool is_picture_source(const std::string& path);

/// The pictures of a source, in natural order.
/// Errors: NotFound (nothing fits), CannotRead, BadFormat (the folder holds neither).
Result<std::vector<std::string>> find_pictures(const std::string& path);

/// The clips that `path` stands for: itself, or of a folder of films (or of folders of pictures)
/// each one, in natural order. Errors: those of find_pictures.
Result<std::vector<std::string>> find_clips(const std::string& path);

/// Every file that a source is read from, for sums over its content. Errors: those of
/// find_pictures.
Result<std::vector<std::string>> files_of(const FilmSource& source);

/// True where the folder holds what find_clips can use; a work folder does not count.
bool is_film_folder(const std::string& path);

}  // namespace vsprite
