// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/ranks.h"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "vsprite/exit_code.h"

namespace vsprite {
namespace {

constexpr int kHead = 3 * 8;   // of a tile: pairs considered, compared, accepted
constexpr int kTogether = 16;  // tiles found before they are sent or looked for
constexpr int kEndTag = 0;     // of a process's last message; tile t has the tag t + 1

/// What the first process says before the search. The tiles that stand follow, a byte each.
struct Order {
  std::int32_t go = 0, tiles = 0;
  float limit = 1;
};

std::string format_message(const PairTile& tile) {
  const std::uint64_t head[] = {tile.considered, tile.compared, tile.pairs.size()};
  static_assert(sizeof head == kHead);
  std::string bytes(reinterpret_cast<const char*>(head), kHead);
  bytes.append(reinterpret_cast<const char*>(tile.pairs.data()),
               sizeof(PairDistance) * tile.pairs.size());
  return bytes;
}

PairTile parse_message(const std::string& bytes) {
  std::uint64_t head[3] = {};
  std::memcpy(head, bytes.data(), kHead);
  PairTile tile;
  tile.considered = head[0], tile.compared = head[1];
  tile.pairs.resize(static_cast<std::size_t>(head[2]));
  if (!tile.pairs.empty())
    std::memcpy(tile.pairs.data(), bytes.data() + kHead, bytes.size() - kHead);
  return tile;
}

/// Finds the tiles `due`, some at once; `found` gets each, in order, in the calling thread.
void find_tiles(const PairFinder& finder, int jobs, const std::vector<int>& due,
                const std::function<void(int, PairTile&)>& found) {
  tbb::task_arena arena(jobs > 0 ? jobs : tbb::task_arena::automatic);
  for (std::size_t begin = 0; begin < due.size(); begin += kTogether) {
    std::vector<PairTile> tiles(std::min<std::size_t>(kTogether, due.size() - begin));
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, tiles.size(),
                        [&](std::size_t k) { tiles[k] = finder.find(due[begin + k]); });
    });
    for (std::size_t k = 0; k < tiles.size(); ++k) found(due[begin + k], tiles[k]);
  }
}

std::vector<int> tiles_of(int rank, int ranks, const std::vector<std::uint8_t>& stands) {
  std::vector<int> due;
  for (int t = rank; t < static_cast<int>(stands.size()); t += ranks)
    if (stands[static_cast<std::size_t>(t)] == 0) due.push_back(t);
  return due;
}

void send(const std::string& bytes, int tag) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, 0, tag, MPI_COMM_WORLD);
}

/// Another process: its tiles, as the first one orders.
Result<void> serve(const Result<std::string>& folder, const Order& order,
                   const std::vector<std::uint8_t>& stands, int jobs, int rank, int ranks) {
  if (!folder) return folder.error();
  const auto project = Project::look(*folder);
  if (!project) return project.error();
  const auto classifier = project->classifier();
  if (!classifier) return classifier.error();
  const auto sprites = load_sprites(*project);
  if (!sprites) return sprites.error();
  const PairFinder finder(sprites->features, *classifier, order.limit);
  if (finder.tile_count() != order.tiles)
    return Error{ErrorCode::CorruptData,
                 *folder + ": process " + std::to_string(rank) +
                     " sees other samples than the first one: all must see the same folder"};
  find_tiles(finder, jobs, tiles_of(rank, ranks, stands),
             [](int t, const PairTile& tile) { send(format_message(tile), t + 1); });
  return {};
}

/// The first process: its own tiles and everybody's, in order.
class Gatherer {
 public:
  Gatherer(const PairFinder& finder, const TileStore& store)
      : finder_(finder),
        store_(store),
        tiles_(static_cast<std::size_t>(finder.tile_count())),
        stands_(tiles_.size(), 0) {
    for (std::size_t t = 0; t < tiles_.size() && store.load; ++t)
      stands_[t] = store.load(static_cast<int>(t), tiles_[t]) ? 1 : 0;
    left_ = std::count(stands_.begin(), stands_.end(), std::uint8_t{0});
  }

  Result<std::vector<PairDistance>> run(int jobs, int ranks, std::uint64_t* compared,
                                        const std::function<void(double)>& progress) {
    Order order{1, static_cast<std::int32_t>(tiles_.size()), finder_.limit()};
    MPI_Bcast(&order, sizeof order, MPI_BYTE, 0, MPI_COMM_WORLD);
    MPI_Bcast(stands_.data(), order.tiles, MPI_BYTE, 0, MPI_COMM_WORLD);
    const auto take = [&](int t, PairTile& tile) {
      keep(t, std::move(tile));
      while (receive(false)) {
      }
      if (progress) progress(1 - static_cast<double>(left_) / static_cast<double>(tiles_.size()));
    };
    find_tiles(finder_, jobs, tiles_of(0, ranks, stands_), take);
    while (ended_ < ranks - 1) receive(true);
    if (fault_) return *fault_;
    std::vector<PairDistance> pairs;
    std::uint64_t looked_at = 0;
    for (PairTile& tile : tiles_) {
      pairs.insert(pairs.end(), tile.pairs.begin(), tile.pairs.end());
      looked_at += tile.compared;
      tile = {};
    }
    if (compared) *compared = looked_at;
    return pairs;
  }

 private:
  void keep(int t, PairTile tile) {
    PairTile& place = tiles_[static_cast<std::size_t>(t)];
    place = std::move(tile);
    --left_;
    if (store_.save) store_.save(t, place);
  }
  /// One message; false where there is none yet.
  bool receive(bool wait) {
    MPI_Status status;
    int there = 1;
    if (wait)
      MPI_Probe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &status);
    else
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
    if (there == 0) return false;
    int size = 0;
    MPI_Get_count(&status, MPI_BYTE, &size);
    std::string bytes(static_cast<std::size_t>(size), '\0');
    MPI_Recv(bytes.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
             MPI_STATUS_IGNORE);
    if (status.MPI_TAG == kEndTag && ++ended_ > 0 && !bytes.empty())
      fault_ = Error{static_cast<ErrorCode>(bytes[0]), bytes.substr(1)};
    if (status.MPI_TAG != kEndTag) keep(status.MPI_TAG - 1, parse_message(bytes));
    return true;
  }

  const PairFinder& finder_;
  const TileStore& store_;
  std::vector<PairTile> tiles_;
  std::vector<std::uint8_t> stands_;
  std::ptrdiff_t left_ = 0;
  int ended_ = 0;  // other processes that have sent all
  std::optional<Error> fault_;
};

void wait_for_orders(const Result<std::string>& folder, int jobs, int rank, int ranks) {
  Order order;
  MPI_Bcast(&order, sizeof order, MPI_BYTE, 0, MPI_COMM_WORLD);
  if (order.go == 0) return;
  std::vector<std::uint8_t> stands(static_cast<std::size_t>(order.tiles));
  MPI_Bcast(stands.data(), order.tiles, MPI_BYTE, 0, MPI_COMM_WORLD);
  const auto served = serve(folder, order, stands, jobs, rank, ranks);
  send(served ? "" : static_cast<char>(served.error().code) + served.error().message, kEndTag);
}

}  // namespace

Result<int> run_over_ranks(const Result<std::string>& folder, int jobs,
                           const std::function<Result<int>(const PairSearch&)>& first) {
  const bool spread = std::getenv("OMPI_COMM_WORLD_SIZE") || std::getenv("PMI_SIZE");
  if (!spread) return first({});
  int level = 0, rank = 0, ranks = 1;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  Result<int> result = 0;
  if (rank > 0) {
    wait_for_orders(folder, jobs, rank, ranks);
  } else {
    bool asked = false;
    result = first([&](const PairFinder& finder, const TileStore& store, std::uint64_t* compared,
                       const std::function<void(double)>& progress) {
      asked = true;
      return Gatherer(finder, store).run(jobs, ranks, compared, progress);
    });
    Order rest;
    if (!asked) MPI_Bcast(&rest, sizeof rest, MPI_BYTE, 0, MPI_COMM_WORLD);
  }
  MPI_Finalize();
  return result;
}

}  // namespace vsprite
