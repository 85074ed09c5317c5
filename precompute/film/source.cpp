// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "film/source.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

namespace vsprite {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string lower_extension(const fs::path& path) {
  std::string text = path.extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_picture(const fs::path& path) { return lower_extension(path) == ".png"; }

// By name alone: the decoder looks into what it is asked to open.
bool is_film(const fs::path& path) {
  constexpr std::array kNames = {".mp4", ".mov", ".m4v",  ".mkv", ".webm", ".avi", ".mpg", ".mpeg",
                                 ".ts",  ".mts", ".m2ts", ".3gp", ".3g2",  ".wmv", ".flv", ".ogv",
                                 ".gif", ".y4m", ".mxf",  ".dv",  ".nut",  ".ivf", ".apng"};
  const std::string extension = lower_extension(path);
  return std::find(kNames.begin(), kNames.end(), extension) != kNames.end();
}

// `*` stands for anything, `?` for one character, `%d` and `%04d` for digits.
bool fits(const std::string& pattern, std::size_t p, const std::string& name, std::size_t n) {
  for (; p < pattern.size(); ++p, ++n) {
    if (pattern[p] == '*') {
      for (std::size_t end = n; end <= name.size(); ++end)
        if (fits(pattern, p + 1, name, end)) return true;
      return false;
    }
    if (pattern[p] == '%') {
      const std::size_t d = pattern.find_first_not_of("0123456789", p + 1);
      if (d != std::string::npos && pattern[d] == 'd') {
        std::size_t end = n;
        while (end < name.size() && is_digit(name[end])) ++end;
        if (end == n) return false;
        p = d;
        n = end - 1;
        continue;
      }
    }
    if (n >= name.size() || (pattern[p] != '?' && pattern[p] != name[n])) return false;
  }
  return n == name.size();
}

bool exists(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

bool is_folder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool is_pattern(const std::string& path) {
  return path.find_first_of("*?%") != std::string::npos && !exists(path);
}

template <class Wanted>
Result<std::vector<std::string>> list(const std::string& folder, Wanted wanted) {
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (!name.starts_with(".") && wanted(at->path())) found.push_back(at->path().string());
  }
  if (error) return Error{ErrorCode::CannotRead, folder + ": cannot be read: " + error.message()};
  std::sort(found.begin(), found.end(), natural_less);
  return found;
}

Error nothing_in(const std::string& folder) {
  return {ErrorCode::BadFormat,
          folder +
              ": no film in this folder: neither films nor PNG pictures; due: a film, or a "
              "folder of them"};
}

bool is_work_folder(const std::string& path) {
  return exists(path + "/manifest.json") || exists(path + "/samples.csv");
}

}  // namespace

bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return static_cast<unsigned char>(a[i]) < static_cast<unsigned char>(b[j]);
      ++i, ++j;
      continue;
    }
    while (i < a.size() && a[i] == '0') ++i;
    while (j < b.size() && b[j] == '0') ++j;
    std::size_t p = i, q = j;
    while (p < a.size() && is_digit(a[p])) ++p;
    while (q < b.size() && is_digit(b[q])) ++q;
    if (p - i != q - j) return p - i < q - j;
    const int order = a.compare(i, p - i, b, j, q - j);
    if (order != 0) return order < 0;
    i = p, j = q;
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;  // 01 and 1: some order, always the same
}

bool is_picture_source(const std::string& path) {
  return is_pattern(path) || is_folder(path) || is_picture(path);
}

Result<std::vector<std::string>> find_pictures(const std::string& path) {
  if (is_folder(path)) {
    auto found = list(path, [](const fs::path& file) { return is_picture(file); });
    if (found && found->empty()) return nothing_in(path);
    return found;
  }
  if (!is_pattern(path)) return std::vector<std::string>{path};
  const fs::path whole(path);
  const std::string pattern = whole.filename().string();
  const std::string parent = whole.parent_path().string();
  if (!parent.empty() && !is_folder(parent))
    return Error{ErrorCode::NotFound, path + ": no such folder"};
  auto found = list(parent.empty() ? "." : parent, [&pattern](const fs::path& file) {
    return is_picture(file) && fits(pattern, 0, file.filename().string(), 0);
  });
  if (found && found->empty())
    return Error{ErrorCode::NotFound,
                 path +
                     ": no such file, and no PNG picture fits; a pattern is due such as "
                     "walk_%04d.png, in quotes where it holds *"};
  return found;
}

Result<std::vector<std::string>> find_clips(const std::string& path) {
  if (!is_folder(path)) return std::vector<std::string>{path};
  bool pictures = false;
  auto clips = list(path, [&pictures](const fs::path& entry) {
    if (is_folder(entry.string())) {
      const auto inside = find_pictures(entry.string());
      return inside && !is_work_folder(entry.string());
    }
    pictures |= is_picture(entry);
    return is_film(entry);
  });
  if (!clips) return clips;
  if (clips->empty() && !pictures) return nothing_in(path);
  if (clips->empty()) return std::vector<std::string>{path};
  return clips;
}

Result<std::vector<std::string>> files_of(const FilmSource& source) {
  std::vector<std::string> files;
  for (const std::string& path : {source.path, source.matte}) {
    if (path.empty()) continue;
    const auto found = find_pictures(path);
    if (!found) return found.error();
    files.insert(files.end(), found->begin(), found->end());
  }
  return files;
}

bool is_film_folder(const std::string& path) {
  return is_folder(path) && !is_work_folder(path) && find_clips(path);
}

}  // namespace vsprite
