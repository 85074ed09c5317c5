// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// fuzz_replay FOLDER - runs every file of FOLDER/{pack,frame,png,puppet,sets,script} through its target:
// whatever once broke a reader stays in the corpus, and passes with any compiler.
#include <cstdio>
#include <filesystem>
#include <string>

#include "fuzz/targets.h"
#include "support/temp_folder.h"

namespace {

int replay(const std::string& folder, void (*target)(std::span<const std::uint8_t>)) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    target(vsprite::testing::read_bytes(entry.path().string()));
    ++count;
  }
  std::printf("%4d of %s\n", count, folder.c_str());
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fuzz_replay FOLDER\n");
    return 2;
  }
  const std::string folder = argv[1];
  const int packs = replay(folder + "/pack", vsprite::fuzz::fuzz_pack);
  const int frames = replay(folder + "/frame", vsprite::fuzz::fuzz_frame);
  const int pictures = replay(folder + "/png", vsprite::fuzz::fuzz_png);
  const int puppets = replay(folder + "/puppet", vsprite::fuzz::fuzz_puppet);
  const int sets = replay(folder + "/sets", vsprite::fuzz::fuzz_sets);
  const int scripts = replay(folder + "/script", vsprite::fuzz::fuzz_script);
  return packs > 0 && frames > 0 && pictures > 0 && puppets > 0 && sets > 0 && scripts > 0 ? 0 : 1;
}
