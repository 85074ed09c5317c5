// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/tiles.h"

#include <chrono>
#include <cstdio>
#include <cstring>

#include "tool/files.h"

namespace vsprite {
namespace {

constexpr char kMagic[] = {'V', 'S', 'P', 'A', 'I', 'R', 'S', '1'};
constexpr std::size_t kHead = 5 * 8, kPair = 12;
constexpr int kRowsTried = 32;
// Of an accepted pair at the peak: the pair, both triangles of D, T, T restricted, and the file.
constexpr double kBytesPerPair = 12 + 2 * 8 + 2 * 8 + 2 * 8 + 12;

std::string tile_path(const std::string& folder, int tile) {
  char name[24];
  std::snprintf(name, sizeof name, "/%06d.bin", tile);
  return folder + name;
}

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::uint64_t number_at(const std::string& bytes, std::size_t at) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::string format_tile(std::uint64_t key, const PairTile& tile) {
  std::string bytes(kMagic, sizeof kMagic);
  append(bytes, key);
  append(bytes, tile.considered);
  append(bytes, tile.compared);
  append(bytes, std::uint64_t{tile.pairs.size()});
  static_assert(sizeof(PairDistance) == kPair);
  if (!tile.pairs.empty()) {
    bytes.append(reinterpret_cast<const char*>(tile.pairs.data()), kPair * tile.pairs.size());
  }
  append(bytes, hash_bytes(bytes));
  return bytes;
}

bool parse_tile(const std::string& bytes, std::uint64_t key, PairTile& tile) {
  if (bytes.size() < kHead + 8 || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0 ||
      number_at(bytes, 8) != key) {
    return false;
  }
  const std::size_t body = bytes.size() - kHead - 8;
  if (body % kPair != 0 || number_at(bytes, 32) != body / kPair ||
      number_at(bytes, bytes.size() - 8) !=
          hash_bytes(std::string_view(bytes).substr(0, bytes.size() - 8))) {
    return false;
  }
  tile.considered = number_at(bytes, 16), tile.compared = number_at(bytes, 24);
  tile.pairs.resize(body / kPair);
  if (body > 0) std::memcpy(tile.pairs.data(), bytes.data() + kHead, body);
  return true;
}

double free_memory() {
  double kilobytes = 0;
  if (std::FILE* file = std::fopen("/proc/meminfo", "r")) {
    char line[128];
    while (std::fgets(line, sizeof line, file) != nullptr) {
      if (std::strncmp(line, "MemAvailable:", 13) == 0) kilobytes = std::atof(line + 13);
    }
    std::fclose(file);
  }
  return 1024 * kilobytes;
}

std::string gigabytes(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GB", bytes / 1e9);
  return text;
}

}  // namespace

TileStore keep_tiles(const std::string& folder, std::uint64_t key) {
  if (!make_folder(folder)) return {};
  TileStore store;
  store.load = [folder, key](int tile, PairTile& found) {
    const auto bytes = read_file(tile_path(folder, tile));
    return bytes && parse_tile(*bytes, key, found);
  };
  store.save = [folder, key](int tile, const PairTile& found) {
    static_cast<void>(
        static_cast<bool>(write_file(tile_path(folder, tile), format_tile(key, found))));
  };
  return store;
}

Result<std::string> foresee(const PairFinder& finder, std::size_t samples) {
  const auto n = static_cast<double>(samples);
  PairTile tried;
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < kRowsTried; ++k) {
    const auto row = static_cast<int>((samples - 1) * static_cast<std::size_t>(k) / kRowsTried);
    finder.find_row(row, 0, static_cast<int>(samples), tried);
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  const double pairs = n * (n - 1) / 2, share = pairs / (kRowsTried * n);
  const double accepted = share * static_cast<double>(tried.pairs.size());
  const double bytes = kBytesPerPair * accepted, free = free_memory();
  char text[160];
  std::snprintf(text, sizeof text,
                "%.0f million pairs, of which about %.1f million look alike: about %.0f s on one "
                "core and ",
                pairs / 1e6, accepted / 1e6, share * took.count() + 0.5);
  const std::string needs = text + gigabytes(bytes) + " of memory";
  if (free > 0 && bytes > free) {
    return Error{ErrorCode::OutOfMemory,
                 needs + ", " + gigabytes(free) +
                     " are free: film less, lower --near-miss, or use a machine with more memory"};
  }
  return needs;
}

}  // namespace vsprite
