// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// The aquarium's own words on the command line.
#include "options.h"

#include <array>
#include <charconv>
#include <filesystem>
#include <string_view>

namespace aquarium {

using vsprite::Error;
using vsprite::ErrorCode;
using vsprite::Result;

namespace {

Error refused(std::string_view option, std::string_view given, std::string_view due) {
  return {ErrorCode::BadSetting, std::string(option) + ": " +
                                     (given.empty() ? "nothing" : std::string(given)) +
                                     " was given, " + std::string(due) + " is due"};
}

bool parse_int(std::string_view text, int low, int high, int& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && value >= low && value <= high;
}

bool parse_size(std::string_view text, Options& options) {
  const std::size_t cross = text.find('x');
  return cross != std::string_view::npos &&
         parse_int(text.substr(0, cross), 16, 7680, options.width) &&
         parse_int(text.substr(cross + 1), 16, 4320, options.height);
}

bool parse_quality(std::string_view text, Options& options) {
  constexpr std::array<std::string_view, 3> kNames{"low", "middle", "high"};
  for (std::size_t k = 0; k < kNames.size(); ++k)
    if (text == kNames[k]) options.quality = static_cast<Quality>(k);
  return options.quality.has_value() || text == "auto";
}

}  // namespace

Result<Options> take_own_options(int argc, char** argv) {
  Options options;
  for (int k = 0; k < argc; ++k) {
    const std::string_view word = argv[k];
    if (word == "--mute") {
      options.mute = true;
    } else if (word == "--size" || word == "--quality" || word == "--others") {
      const std::string_view value = k + 1 < argc ? argv[++k] : "";
      if (word == "--size" && !parse_size(value, options))
        return refused(word, value, "WIDTHxHEIGHT from 16x16 to 7680x4320");
      if (word == "--quality" && !parse_quality(value, options))
        return refused(word, value, "auto, low, middle or high");
      if (word == "--others" && !parse_int(value, 2, 6, options.others))
        return refused(word, value, "a number from 2 to 6");
    } else {
      options.rest.push_back(argv[k]);
    }
  }
  return options;
}

std::string find_bundled_pack() {
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
  const std::filesystem::path folder = program.parent_path();
  for (const std::filesystem::path& place :
       {std::filesystem::path("goldfish.vsp"), std::filesystem::path("build/goldfish.vsp"),
        folder / "goldfish.vsp", folder.parent_path() / "goldfish.vsp"}) {
    if (std::filesystem::is_regular_file(place, ignored)) return place.string();
  }
  return "build/goldfish.vsp";
}

}  // namespace aquarium
