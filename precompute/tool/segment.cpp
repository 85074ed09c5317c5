// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Film -> sprites, in two passes over the film and one over the keyed frames:
//   1. frames spread over the whole film -> the model of the background
//   2. every frame keyed, in order, by all threads; what was keyed waits on disk in chunks
//   3. the subject followed through all summaries, then every sample cut and written as PNG
// Memory does not grow with the film: some sampled frames, a few frames in flight, one chunk.
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "film/contact.h"
#include "film/extract.h"
#include "film/matte.h"
#include "film/plate.h"
#include "film/video.h"
#include "tool/keyed.h"
#include "tool/stages.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

// Shares of the time that the three steps take, for the progress bar.
constexpr double kSampled = 0.15, kKeyed = 0.75;
constexpr int kContactRows = 6;

using FramePointer = std::shared_ptr<const Frame>;

void report(const StageRun& run, double fraction) {
  if (run.listener.progress) run.listener.progress(std::min(fraction, 1.0));
}

/// Every k-th frame of a film of unknown length: k doubles whenever the room is full.
class SpreadSample {
 public:
  explicit SpreadSample(int room) : room_(static_cast<std::size_t>(std::max(room, 16))) {}
  void offer(const Frame& frame) {
    if (frame.index % stride_ != 0) return;
    if (frames_.size() == room_) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < frames_.size(); i += 2) std::swap(frames_[kept++], frames_[i]);
      frames_.resize(kept);
      stride_ *= 2;
      if (frame.index % stride_ != 0) return;
    }
    frames_.push_back(frame);
  }
  std::vector<Frame> take() && { return std::move(frames_); }

 private:
  std::size_t room_;
  int stride_ = 1;
  std::vector<Frame> frames_;
};

/// As many frames as are asked for, or fewer where they would take more than 400 MB.
int sample_room(const FilmInfo& info, int wanted) {
  const std::int64_t bytes = std::int64_t{3} * info.width * info.height;
  return static_cast<int>(std::clamp<std::int64_t>(
      (std::int64_t{400} << 20) / std::max<std::int64_t>(bytes, 1), 16, wanted));
}

struct Sampled {
  std::vector<Frame> frames;
  int frame_count = 0;
};

Result<Sampled> sample_film(StageRun& run, FilmReader& reader, const KeyConfig& key) {
  SpreadSample sample(sample_room(reader.info(), key.sample_count));
  Frame frame;
  Sampled sampled;
  for (;;) {
    const auto more = reader.read(frame);
    if (!more) return more.error();
    if (!*more) break;
    sample.offer(frame);
    ++sampled.frame_count;
    if (sampled.frame_count % 16 == 0 && reader.info().claimed_frames > 0)
      report(run, kSampled * sampled.frame_count / reader.info().claimed_frames);
  }
  sampled.frames = std::move(sample).take();
  return sampled;
}

/// One frame on its way through the pipeline.
struct KeyingItem {
  FramePointer frame, before;
  bool stands = false;  ///< its chunk is on disk already
  std::string packed;
  FrameSummary summary;
};

/// Pass 2: reads in order, keys in parallel, writes chunks in order.
class KeyingPass {
 public:
  KeyingPass(StageRun& run, FilmReader& reader, const ScreenModel& screen, const KeyedStore& store,
             int frame_count)
      : run_(run),
        reader_(reader),
        keyers_([&screen] { return Keyer(screen, MatteConfig{}); }),
        store_(store),
        frame_count_(frame_count),
        summaries_(static_cast<std::size_t>(frame_count)) {
    for (int chunk = 0; chunk * kChunkFrames < frame_count; ++chunk) stands_.push_back(load(chunk));
  }

  Result<std::vector<FrameSummary>> run() {
    const auto tokens = static_cast<std::size_t>(2 * tbb::this_task_arena::max_concurrency() + 2);
    using Item = std::shared_ptr<KeyingItem>;
    tbb::parallel_pipeline(
        tokens,
        tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order,
                                     [this](tbb::flow_control& flow) { return next(flow); }) &
            tbb::make_filter<Item, Item>(tbb::filter_mode::parallel,
                                         [this](const Item& item) {
                                           key(*item);
                                           return item;
                                         }) &
            tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order,
                                         [this](const Item& item) { collect(*item); }));
    if (fault_) return *fault_;
    if (write_fault_) return *write_fault_;
    if (read_ != frame_count_)
      return Error{ErrorCode::DecoderFailed,
                   run_.film + ": " + std::to_string(read_) + " frames on the second reading, " +
                       std::to_string(frame_count_) +
                       " on the first: run it again, and look after the disk"};
    return std::move(summaries_);
  }

 private:
  bool load(int chunk) {
    const auto frames = store_.read(chunk);
    const int first = chunk * kChunkFrames;
    const int due = std::min(kChunkFrames, frame_count_ - first);
    if (!frames || static_cast<int>(frames->size()) != due) return false;
    for (int i = 0; i < due; ++i)
      summaries_[static_cast<std::size_t>(first + i)] =
          summary_of((*frames)[static_cast<std::size_t>(i)], false);
    return true;
  }

  bool all_stand() const {
    return std::all_of(stands_.begin(), stands_.end(), [](bool b) { return b; });
  }

  std::shared_ptr<KeyingItem> next(tbb::flow_control& flow) {
    auto item = std::make_shared<KeyingItem>();
    auto frame = std::make_shared<Frame>();
    if (fault_ || all_stand()) {
      if (!fault_) read_ = frame_count_;
      flow.stop();
      return item;
    }
    const auto more = reader_.read(*frame);
    if (!more) fault_ = more.error();
    if (!more || !*more || read_ == frame_count_) {
      if (more && *more) ++read_;  // longer than on the first reading: run() says so
      flow.stop();
      return item;
    }
    item->stands = stands_[static_cast<std::size_t>(read_ / kChunkFrames)];
    item->before = std::move(last_);
    item->frame = last_ = std::move(frame);
    ++read_;
    return item;
  }

  void key(KeyingItem& item) {
    if (item.stands) return;
    const KeyedFrame keyed = keyers_.local().key(*item.frame, item.before.get());
    item.summary = summary_of(keyed, false);
    item.packed = pack_keyed(keyed);
    item.before.reset();
  }

  void collect(KeyingItem& item) {
    const int index = item.frame->index;
    if (!item.stands && !write_fault_) {
      summaries_[static_cast<std::size_t>(index)] = std::move(item.summary);
      chunk_.push_back(std::move(item.packed));
      const bool last = index + 1 == frame_count_ || (index + 1) % kChunkFrames == 0;
      if (last) {
        if (const auto wrote = store_.write(index / kChunkFrames, chunk_); !wrote)
          write_fault_ = wrote.error();
        chunk_.clear();
      }
    }
    if (index % 8 == 0) report(run_, kSampled + (kKeyed - kSampled) * index / frame_count_);
  }

  StageRun& run_;
  FilmReader& reader_;
  tbb::enumerable_thread_specific<Keyer> keyers_;
  const KeyedStore& store_;
  int frame_count_;
  int read_ = 0;
  std::vector<FrameSummary> summaries_;
  std::vector<bool> stands_;
  FramePointer last_;
  std::vector<std::string> chunk_;
  std::optional<Error> fault_;        ///< of the first filter
  std::optional<Error> write_fault_;  ///< of the last one
};

Result<void> write_contact_sheet(const StageRun& run, const ScreenModel& screen,
                                 const std::vector<Frame>& sampled) {
  std::vector<Frame> frames;
  std::vector<KeyedFrame> keyed;
  Keyer keyer(screen, MatteConfig{});
  const std::size_t stride = std::max<std::size_t>(1, sampled.size() / (3 * kContactRows));
  for (std::size_t i = 0; i < sampled.size() && frames.size() < kContactRows; i += stride) {
    KeyedFrame frame = keyer.key(sampled[i], nullptr);
    if (frame.blobs.empty() || frame.blobs.front().touches_border) continue;
    frames.push_back(sampled[i]);
    keyed.push_back(std::move(frame));
    i += 2 * stride;
  }
  if (frames.empty()) return {};
  const auto png = encode_png(make_contact_sheet(frames, keyed, {}));
  if (!png) return png.error();
  return write_file(run.project.path("contact.png"),
                    {reinterpret_cast<const char*>(png->data()), png->size()});
}

/// Everything in sprites/ goes; the folder stays.
Result<void> clear_sprites(const Project& project) {
  const std::string folder = project.path("sprites");
  std::error_code error;
  fs::remove(project.path("samples.csv"), error);
  fs::remove_all(folder, error);
  if (error)
    return Error{ErrorCode::CannotWrite, folder + ": cannot be removed: " + error.message()};
  return make_folder(folder);
}

/// Cuts the rows with the numbers `due`, all of one chunk, in parallel; writes them together.
Result<void> cut_chunk(const Project& project, const std::vector<KeyedFrame>& frames,
                       const Extraction& extraction, const std::vector<std::size_t>& due) {
  using Png = Result<std::vector<std::uint8_t>>;
  std::vector<Png> pictures(due.size(), Png(std::vector<std::uint8_t>{}));
  tbb::parallel_for(std::size_t{0}, due.size(), [&](std::size_t k) {
    const SampleRow& row = extraction.rows[due[k]];
    const auto& frame = frames[static_cast<std::size_t>(row.frame % kChunkFrames)];
    pictures[k] = encode_png(cut_sample(frame, extraction.labels[due[k]], row));
  });
  std::vector<NamedBytes> files;
  for (std::size_t k = 0; k < due.size(); ++k) {
    if (!pictures[k]) return pictures[k].error();
    files.push_back({project.sprite_path(extraction.rows[due[k]].sample), *pictures[k]});
  }
  return write_files(files);
}

/// Step 3: rows are in film order, so that every chunk is read once.
Result<void> cut_sprites(StageRun& run, const KeyedStore& store, const Extraction& extraction,
                         bool resumed) {
  const auto& rows = extraction.rows;
  for (std::size_t begin = 0; begin < rows.size();) {
    const int chunk = rows[begin].frame / kChunkFrames;
    std::size_t end = begin;
    std::vector<std::size_t> due;
    for (; end < rows.size() && rows[end].frame / kChunkFrames == chunk; ++end) {
      std::error_code error;
      if (!resumed || !fs::exists(run.project.sprite_path(rows[end].sample), error))
        due.push_back(end);
    }
    if (!due.empty()) {
      const auto frames = store.read(chunk);
      if (!frames)
        return Error{ErrorCode::CorruptData, run.project.path("keyed") + ": chunk " +
                                                 std::to_string(chunk) +
                                                 " was damaged meanwhile: run it again"};
      if (auto cut = cut_chunk(run.project, *frames, extraction, due); !cut) return cut.error();
    }
    begin = end;
    report(run,
           kKeyed + (1 - kKeyed) * static_cast<double>(end) / static_cast<double>(rows.size()));
  }
  return sync_folder(run.project.path("sprites"));
}

Json segment_result(const std::string& name, const FilmInfo& info, const ScreenModel& screen,
                    const Extraction& extraction) {
  const int kept = static_cast<int>(extraction.rows.size());
  return {{"film", name},
          {"width", info.width},
          {"height", info.height},
          {"fps", {info.fps_numerator, info.fps_denominator}},
          {"background", screen.reason},
          {"frames", extraction.fates.size()},
          {"duplicates", extraction.count(Fate::Duplicate)},
          {"samples", kept},
          {"clips", extraction.clips},
          {"cuts", extraction.cuts},
          {"missing", extraction.missing},
          {"dropped_border", extraction.count(Fate::Border)},
          {"dropped_empty", extraction.count(Fate::Empty)},
          {"dropped_touched", extraction.count(Fate::Touched)},
          {"dropped_hidden", extraction.count(Fate::Hidden)},
          {"dropped_short", extraction.count(Fate::Short)},
          {"velocity_noise", extraction.velocity_noise}};
}

SubjectChoice subject_of(const std::string& text) {
  if (text == "only") return {SubjectChoice::kOnly};
  if (text == "largest") return {SubjectChoice::kLargest};
  return {std::atoi(text.c_str())};
}

}  // namespace

Result<Json> segment_film(StageRun& run, const std::string& origin) {
  const auto key = parse_key(run.settings.key);
  if (!key) return key.error();
  // Both readings are opened before any thread is started: opening forks.
  auto first = FilmReader::open(run.film);
  if (!first) return first.error();
  auto second = FilmReader::open(run.film);
  if (!second) return second.error();
  const FilmInfo info = first->info();
  const std::string name = fs::path(run.film).filename().string();

  const auto sampled = sample_film(run, *first, *key);
  if (!sampled) return sampled.error();
  const auto screen = measure_screen(sampled->frames, *key);
  if (!screen) return Error{screen.error().code, run.film + ": " + screen.error().message};
  if (run.listener.note) run.listener.note("background: " + screen->reason);

  const auto store = KeyedStore::open(run.project, origin);
  if (!store) return store.error();
  const auto summaries = KeyingPass(run, *second, *screen, *store, sampled->frame_count).run();
  if (!summaries) return summaries.error();

  const ExtractConfig config{.max_size = run.settings.max_size,
                             .sigma = run.settings.smooth,
                             .min_clip = run.settings.min_clip,
                             .subject = subject_of(run.settings.subject),
                             .ground = run.settings.anchor == "ground",
                             .mirror = run.settings.mirror,
                             .width = info.width,
                             .height = info.height};
  const double fps = static_cast<double>(info.fps_numerator) / info.fps_denominator;
  const auto extraction = extract(*summaries, fps, name, config);
  if (!extraction)
    return Error{extraction.error().code, run.film + ": " + extraction.error().message};

  const std::string table = format_samples(extraction->rows);
  const auto resumed = store->resume_cutting(hex64(hash_bytes(table)),
                                             [&run] { return clear_sprites(run.project); });
  if (!resumed) return resumed.error();
  if (auto made = make_folder(run.project.path("sprites")); !made) return made.error();
  if (auto cut = cut_sprites(run, *store, *extraction, *resumed); !cut) return cut.error();
  if (auto sheet = write_contact_sheet(run, *screen, sampled->frames); !sheet) return sheet.error();
  if (auto wrote = write_file(run.project.path("samples.csv"), table); !wrote) return wrote.error();
  return segment_result(name, info, *screen, *extraction);
}

}  // namespace vsprite
