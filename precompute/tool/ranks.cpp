// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/ranks.h"

#define OMPI_SKIP_MPICXX 1
#include <mpi.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <thread>

namespace vsprite {
namespace {

constexpr int kHead = 3 * 8;   // of a tile: pairs considered, compared, accepted
constexpr int kTogether = 16;  // tiles found before they are sent or looked for
constexpr int kEndTag = 0;     // of a process's last message; tile t has the tag t + 1
constexpr int kTableTag = 0;   // of tables, which come when no search is on

/// What the first process says. Pairs: the tiles that stand follow, a byte each. Solve: the problem
/// follows, as send_problem() says it.
struct Order {
  enum Kind : std::int32_t { kEnd, kPairs, kSolve } kind = kEnd;
  std::int32_t tiles = 0;
  float limit = 1;
  double v0 = 0;
  SolveOrder solve{};
};

/// Gives the processor away meanwhile: a stage that one process works at may take minutes.
void wait_for(MPI_Request& request) {
  for (int done = 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE), done == 0;)
    std::this_thread::sleep_for(std::chrono::microseconds(100));
}

/// Calls `move` for parts that MPI's counts can name.
template <class Move>
void in_parts(std::span<std::byte> bytes, const Move& move) {
  constexpr std::size_t kPart = std::size_t{1} << 30;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(kPart, bytes.size()))) {
    MPI_Request request;
    move(bytes.data(), static_cast<int>(std::min(kPart, bytes.size())), request);
    wait_for(request);
  }
}

void share(std::size_t owner, std::span<std::byte> bytes) {
  in_parts(bytes, [&](void* data, int size, MPI_Request& request) {
    MPI_Ibcast(data, size, MPI_BYTE, static_cast<int>(owner), MPI_COMM_WORLD, &request);
  });
}
template <class T>
void share_value(T& value) {
  share(0, std::as_writable_bytes(std::span(&value, 1)));
}
/// An array of any length, from the first process.
template <class T>
void tell(std::span<const T> values) {
  std::uint64_t count = values.size();
  share_value(count);
  const auto bytes = std::as_bytes(values);
  share(0, {const_cast<std::byte*>(bytes.data()), bytes.size()});  // are only read here
}
template <class T>
void hear(std::vector<T>& values) {
  std::uint64_t count = 0;
  share_value(count);
  values.resize(static_cast<std::size_t>(count));
  share(0, std::as_writable_bytes(std::span(values)));
}

Spread make_spread(int rank, int ranks) {
  const auto gather = [rank](std::size_t owner, std::span<std::byte> bytes) {
    in_parts(bytes, [&](void* data, int size, MPI_Request& request) {
      if (rank == 0)
        MPI_Irecv(data, size, MPI_BYTE, static_cast<int>(owner), kTableTag, MPI_COMM_WORLD,
                  &request);
      else
        MPI_Isend(data, size, MPI_BYTE, 0, kTableTag, MPI_COMM_WORLD, &request);
    });
  };
  return {static_cast<std::size_t>(rank), static_cast<std::size_t>(ranks), share, gather};
}

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
Result<void> find_own_pairs(const std::string& folder, const Order& order,
                            const std::vector<std::uint8_t>& stands, int jobs, int rank,
                            int ranks) {
  const auto project = Project::look(folder);
  if (!project) return project.error();
  const auto classifier = project->classifier();
  if (!classifier) return classifier.error();
  const auto sprites = load_sprites(*project);
  if (!sprites) return sprites.error();
  const PairFinder finder(sprites->features, *classifier, order.limit);
  if (finder.tile_count() != order.tiles)
    return Error{ErrorCode::CorruptData,
                 folder + ": process " + std::to_string(rank) +
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
    Order order{.kind = Order::kPairs,
                .tiles = static_cast<std::int32_t>(tiles_.size()),
                .limit = finder_.limit()};
    share_value(order);
    tell(std::span<const std::uint8_t>(stands_));
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

void help_search(const std::string& folder, const Order& order, int jobs, int rank, int ranks) {
  std::vector<std::uint8_t> stands;
  hear(stands);
  const auto found = find_own_pairs(folder, order, stands, jobs, rank, ranks);
  send(found ? "" : static_cast<char>(found.error().code) + found.error().message, kEndTag);
}

void send_problem(const CostTable& costs, const Motion& motion) {
  tell(std::span(costs.row_start));
  tell(std::span(costs.transitions));
  tell(std::span(costs.kept));
  tell(std::span(costs.needed));
  tell(motion.velocities);
  tell(motion.skip_costs);
}

/// An error is the first's as well: it makes the same solve.
void help_solve(const Order& order, int jobs, const Spread& spread) {
  CostTable costs;
  std::vector<Vec2> velocities;
  std::vector<float> skip_costs;
  hear(costs.row_start);
  hear(costs.transitions);
  hear(costs.kept);
  hear(costs.needed);
  hear(velocities);
  hear(skip_costs);
  if (order.solve.is_joint)
    (void)solve_joint(costs, {velocities, skip_costs, order.v0}, order.solve.joint,
                      order.solve.served, jobs, spread);
  else
    (void)solve(costs, velocities, order.v0, order.solve.paper, jobs, spread);
}

void follow_orders(const std::string& folder, int jobs, int rank, int ranks) {
  for (;;) {
    Order order;
    share_value(order);
    if (order.kind == Order::kEnd) return;
    if (order.kind == Order::kPairs)
      help_search(folder, order, jobs, rank, ranks);
    else
      help_solve(order, jobs, make_spread(rank, ranks));
  }
}

Sharing make_sharing(int jobs, int ranks) {
  return {.search =
              [=](const PairFinder& finder, const TileStore& store, std::uint64_t* compared,
                  const std::function<void(double)>& progress) {
                return Gatherer(finder, store).run(jobs, ranks, compared, progress);
              },
          .spread =
              [=](const CostTable& costs, const Motion& motion, const SolveOrder& solve_order) {
                Order order{.kind = Order::kSolve, .v0 = motion.v0, .solve = solve_order};
                share_value(order);
                send_problem(costs, motion);
                return make_spread(0, ranks);
              }};
}

}  // namespace

Result<int> run_over_ranks(const std::string& folder, int jobs,
                           const std::function<Result<int>(const Sharing&)>& first) {
  const bool spread = std::getenv("OMPI_COMM_WORLD_SIZE") || std::getenv("PMI_SIZE");
  if (!spread) return first({});
  int level = 0, rank = 0, ranks = 1;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  Result<int> result = 0;
  if (rank > 0) {
    follow_orders(folder, jobs, rank, ranks);
  } else {
    result = first(make_sharing(jobs, ranks));
    Order end;
    share_value(end);
  }
  MPI_Finalize();
  return result;
}

}  // namespace vsprite
