// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Film -> sprites, in one pass over the film and one over the keyed frames:
//   1. some frames spread over the whole film -> the model of the background
//   2. every frame keyed, in order, by all threads; what was keyed waits on disk in chunks
//   3. the subject followed through all summaries, then every sample cut and written as PNG
// Memory does not grow with the film: some sampled frames, a few frames in flight, one chunk.
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <future>
#include <memory>
#include <mutex>

#include "film/checkup.h"
#include "film/contact.h"
#include "film/extract.h"
#include "film/matte.h"
#include "film/plate.h"
#include "film/video.h"
#include "tool/keyed.h"
#include "tool/shadows.h"
#include "tool/stages.h"

namespace vsprite {
namespace {

namespace fs = std::filesystem;

// Shares of the time that the three steps take, for the progress bar.
constexpr double kSampled = 0.05, kKeyed = 0.75;
constexpr int kContactRows = 6;

using FramePointer = std::shared_ptr<const Frame>;

void report(const StageRun& run, double fraction) {
  if (run.listener.progress) run.listener.progress(std::min(fraction, 1.0));
}

bool stands_on_ground(const Settings& settings) {
  return settings.anchor == "ground" || !settings.horizon.empty();
}

int stride_of(const Settings& settings) { return settings.draft ? kDraftStride : 1; }

/// Frames whose memory is used again: a large one costs as much to fetch and clear as to fill.
class FramePool {
 public:
  /// Its contents are not specified.
  std::shared_ptr<Frame> take() {
    std::unique_ptr<Frame> frame;
    {
      const std::scoped_lock lock(guard_);
      if (!free_.empty()) frame = std::move(free_.back()), free_.pop_back();
    }
    if (!frame) frame = std::make_unique<Frame>();
    return {frame.release(), [this](Frame* used) {
              const std::scoped_lock lock(guard_);
              free_.emplace_back(used);
            }};
  }

 private:
  std::mutex guard_;
  std::vector<std::unique_ptr<Frame>> free_;
};

/// One frame on its way through the pipeline.
struct KeyingItem {
  FramePointer frame, before;
  int position = 0;     ///< in the keyed store and among the summaries
  int lost = 0;         ///< summaries that are missing before it
  bool stands = false;  ///< its chunk is on disk already
  std::string packed;
  FrameSummary summary;
};

/// Pass 2: reads in order, keys in parallel, writes chunks in order.
class KeyingPass {
 public:
  KeyingPass(StageRun& run, FilmReader& reader, const ScreenModel& screen, const MatteConfig& matte,
             const KeyedStore& store)
      : run_(run),
        stride_(stride_of(run.settings)),
        ground_(stands_on_ground(run.settings)),
        reader_(reader),
        keyers_([&screen, matte] { return Keyer(screen, matte); }),
        store_(store) {}

  Result<std::vector<FrameSummary>> run() {
    // Where every chunk stands, the film is not decoded again: the last one is known by its length.
    for (int chunk = 0;; ++chunk) {
      const auto stand = load(chunk);
      summaries_.insert(summaries_.end(), stand.begin(), stand.end());
      if (stand.size() == kChunkFrames) continue;
      if (!stand.empty()) return std::move(summaries_);
      break;
    }
    summaries_.clear();
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
    if (!chunk_.empty()) write_chunk();
    if (write_fault_) return *write_fault_;
    return std::move(summaries_);
  }

 private:
  /// Summaries of a chunk that stands; none where it does not.
  std::vector<FrameSummary> load(int chunk) const {
    std::vector<FrameSummary> summaries;
    if (const auto frames = store_.read(chunk))
      for (const KeyedFrame& frame : *frames) summaries.push_back(summary_of(frame, ground_));
    return summaries;
  }

  std::shared_ptr<KeyingItem> next(tbb::flow_control& flow) {
    auto item = std::make_shared<KeyingItem>();
    std::shared_ptr<Frame> frame = frames_.take();
    // A draft passes over the frames between.
    for (int pass = read_ == 0 ? stride_ - 1 : 0; pass < stride_; ++pass) {
      const auto more = reader_.read(*frame);
      if (more && *more) {
        lost_ += frame->lost_before;
        continue;
      }
      if (!more) fault_ = more.error();
      flow.stop();
      return item;
    }
    if (read_ % kChunkFrames == 0) standing_ = load(read_ / kChunkFrames);
    item->stands = standing_.size() == kChunkFrames;
    if (item->stands) item->summary = standing_[static_cast<std::size_t>(read_ % kChunkFrames)];
    item->before = std::move(last_);
    item->frame = last_ = std::move(frame);
    item->position = read_++;
    item->lost = lost_ / stride_;
    lost_ %= stride_;
    return item;
  }

  void key(KeyingItem& item) {
    if (item.stands) return;
    KeyedFrame keyed = keyers_.local().key(*item.frame, item.before.get());
    keyed.lost_before = item.lost;
    item.summary = summary_of(keyed, ground_);
    item.packed = pack_keyed(keyed);
    item.before.reset();
  }

  void collect(KeyingItem& item) {
    const int index = item.frame->index;
    summaries_.push_back(std::move(item.summary));
    if (!item.stands && !write_fault_) {
      chunk_number_ = item.position / kChunkFrames;
      chunk_.push_back(std::move(item.packed));
      if ((item.position + 1) % kChunkFrames == 0) write_chunk();
    }
    const int claimed = reader_.info().claimed_frames;
    if (index % 8 == 0 && claimed > 0)
      report(run_, kSampled + (kKeyed - kSampled) * std::min(1.0, 1.0 * index / claimed));
  }

  void write_chunk() {
    if (const auto wrote = store_.write(chunk_number_, chunk_); !wrote)
      write_fault_ = wrote.error();
    chunk_.clear();
  }

  StageRun& run_;
  int stride_;
  bool ground_;
  FilmReader& reader_;
  tbb::enumerable_thread_specific<Keyer> keyers_;
  const KeyedStore& store_;
  FramePool frames_;  ///< outlives those that are kept below
  // Of the first filter.
  int read_ = 0, lost_ = 0;
  std::vector<FrameSummary> standing_;  ///< of the chunk that is being read, where it stands
  FramePointer last_;
  std::optional<Error> fault_;
  // Of the last filter.
  std::vector<FrameSummary> summaries_;
  int chunk_number_ = 0;
  std::vector<std::string> chunk_;
  std::optional<Error> write_fault_;
};

/// The blob of a frame keyed anew that sample `row` was cut from: the one that covers most of it.
std::size_t blob_of(const KeyedFrame& frame, const SampleRow& row) {
  const auto shared = [](double a, double a_size, double b, double b_size) {
    return std::max(0.0, std::min(a + a_size, b + b_size) - std::max(a, b));
  };
  std::size_t best = 0;
  double most = -1;
  for (std::size_t b = 0; b < frame.blobs.size(); ++b) {
    const Rect& box = frame.blobs[b].box;
    const double common = shared(box.x, box.width, row.left, row.width) *
                          shared(box.y, box.height, row.top, row.height);
    const double all = box.width * box.height + row.width * row.height - common;
    if (common / all > most) most = common / all, best = b;
  }
  return best;
}

/// Shows frames that samples stand for, about the subject that was followed. Returns the share of
/// it that shows as holes, the median of the frames shown.
Result<double> write_contact_sheet(const StageRun& run, const ScreenModel& screen,
                                   const MatteConfig& matte, const std::vector<Frame>& sampled,
                                   const Extraction& extraction) {
  std::error_code ignored;
  fs::remove(run.project.path("contact.png"), ignored);
  const auto& rows = extraction.rows;
  const auto filmed =
      std::find_if(rows.begin(), rows.end(), [](const SampleRow& r) { return r.mirror_of >= 0; });
  std::vector<Frame> frames;
  std::vector<KeyedFrame> keyed;
  Keyer keyer(screen, matte);
  const std::size_t stride = std::max<std::size_t>(1, sampled.size() / (3 * kContactRows));
  for (std::size_t i = 0; i < sampled.size() && frames.size() < kContactRows; i += stride) {
    const auto after =
        std::upper_bound(rows.begin(), filmed, sampled[i].index,
                         [](int index, const SampleRow& row) { return index < row.frame; });
    if (after == rows.begin()) continue;
    const SampleRow& row = *std::prev(after);
    if (sampled[i].index >= row.frame + row.duration) continue;
    KeyedFrame frame = keyer.key(sampled[i], nullptr);
    if (frame.blobs.empty()) continue;
    std::swap(frame.blobs.front(), frame.blobs[blob_of(frame, row)]);
    frames.push_back(sampled[i]);
    keyed.push_back(std::move(frame));
    i += 2 * stride;
  }
  if (frames.empty()) return 0.0;
  const auto png = encode_png(make_contact_sheet(frames, keyed, {}));
  if (!png) return png.error();
  if (auto wrote = write_file(run.project.path("contact.png"),
                              {reinterpret_cast<const char*>(png->data()), png->size()});
      !wrote)
    return wrote.error();
  std::vector<double> holes;
  for (const KeyedFrame& frame : keyed) holes.push_back(hole_share(frame, frame.blobs.front()));
  return detail::median(std::move(holes));
}

/// The keyed frame at `position`, its parts boxed, as a PNG of the work folder.
Result<void> write_parts(const StageRun& run, const KeyedStore& store, const FilmInfo& info,
                         int position, std::span<const Blob> parts, const std::string& name) {
  const auto frames = store.read(position / kChunkFrames);
  if (!frames) return {};  // damaged meanwhile: cutting will say so
  const auto png =
      encode_png(show_parts((*frames)[static_cast<std::size_t>(position % kChunkFrames)],
                            info.width, info.height, parts));
  if (!png) return png.error();
  return write_file(run.project.path(name),
                    {reinterpret_cast<const char*>(png->data()), png->size()});
}

/// Several subjects: the refusal names a picture in which each has its number.
Result<void> refuse_rivals(const StageRun& run, const KeyedStore& store, const FilmInfo& info,
                           double rate, std::span<const FrameSummary> summaries) {
  const Rivals rivals = find_rivals(summaries, rate);
  if (rivals.position < 0) return {};
  if (auto wrote = write_parts(run, store, info, rivals.position, rivals.parts, "subjects.png");
      !wrote)
    return wrote.error();
  const FrameSummary& frame = summaries[static_cast<std::size_t>(rivals.position)];
  return Error{ErrorCode::BadContent,
               run.film + ": several subjects of like size in " + std::to_string(rivals.frames) +
                   " of " + std::to_string(rivals.present) + " frames; " +
                   run.project.path("subjects.png") + " shows those of frame " +
                   std::to_string(frame.index) +
                   ", numbered; due: one subject, or --subject largest or its number"};
}

/// For each reason for which frames were dropped the middle one of them, as dropped/REASON.png.
Result<Json> write_dropped(const StageRun& run, const KeyedStore& store, const FilmInfo& info,
                           std::span<const FrameSummary> summaries, const Extraction& extraction) {
  std::error_code ignored;
  fs::remove_all(run.project.path("dropped"), ignored);
  Json pictures = Json::object();
  for (const Fate fate : {Fate::Border, Fate::Touched, Fate::Hidden, Fate::Short}) {
    const int count = extraction.count(fate);
    if (count == 0) continue;
    int seen = 0;
    std::size_t position = 0;
    for (std::size_t f = 0; f < extraction.fates.size() && seen <= count / 2; ++f)
      if (extraction.fates[f] == fate) position = f, ++seen;
    const std::string name = std::string("dropped/") + fate_name(fate) + ".png";
    if (auto made = make_folder(run.project.path("dropped")); !made) return made.error();
    const auto& blobs = summaries[position].blobs;
    const auto subject = static_cast<std::size_t>(std::max(extraction.followed[position], 0));
    if (auto wrote = write_parts(run, store, info, static_cast<int>(position),
                                 std::span(blobs).subspan(subject, 1), name);
        !wrote)
      return wrote.error();
    pictures[fate_name(fate)] = {
        {"frame", summaries[position].index},
        {"share", static_cast<double>(count) / static_cast<double>(extraction.fates.size())},
        {"picture", name}};
  }
  return pictures;
}

/// Everything in sprites/ goes, and all shadows; the folder stays.
Result<void> clear_sprites(const Project& project) {
  const std::string folder = project.path("sprites");
  std::error_code error;
  fs::remove(project.path("samples.csv"), error);
  fs::remove_all(folder, error);
  if (!error) remove_shadows(project);
  if (error)
    return Error{ErrorCode::CannotWrite, folder + ": cannot be removed: " + error.message()};
  return make_folder(folder);
}

struct Picture {
  std::string path;
  std::vector<std::uint8_t> png;
};

Result<void> write_pictures(const std::vector<Picture>& pictures) {
  std::vector<NamedBytes> files;
  for (const Picture& picture : pictures) files.push_back({picture.path, picture.png});
  return write_files(files);
}

/// Cuts the rows with the numbers `due`, all of one chunk, in parallel. `shadows`: null, or gets a
/// row for each that casts one.
Result<std::vector<Picture>> cut_chunk(const Project& project,
                                       const std::vector<KeyedFrame>& frames,
                                       const Extraction& extraction,
                                       const std::vector<std::size_t>& due,
                                       std::vector<ShadowRow>* shadows) {
  using Png = Result<std::vector<std::uint8_t>>;
  std::vector<Png> pictures(due.size(), Png(std::vector<std::uint8_t>{}));
  std::vector<Png> shades = pictures;
  std::vector<ShadowRow> shade_rows(due.size());
  tbb::parallel_for(std::size_t{0}, due.size(), [&](std::size_t k) {
    const SampleRow& row = extraction.rows[due[k]];
    const int position = extraction.positions[due[k]];
    const auto& frame = frames[static_cast<std::size_t>(position % kChunkFrames)];
    pictures[k] = encode_png(cut_sample(frame, extraction.labels[due[k]], row));
    if (shadows == nullptr) return;
    const CutShadow shadow = cut_shadow(frame, extraction.labels[due[k]], row);
    shade_rows[k] = row_of(row.sample, shadow);
    if (shadow.image.width > 0) shades[k] = encode_png(shadow.image);
  });
  std::vector<Picture> cut;
  for (std::size_t k = 0; k < due.size(); ++k) {
    if (!pictures[k]) return pictures[k].error();
    if (!shades[k]) return shades[k].error();
    if (!shades[k]->empty()) {
      shadows->push_back(shade_rows[k]);
      cut.push_back({shadow_path(project, shade_rows[k].sample), std::move(*shades[k])});
    }
    cut.push_back({project.sprite_path(extraction.rows[due[k]].sample), std::move(*pictures[k])});
  }
  return cut;
}

/// Step 3: rows are in film order, so that every chunk is read once. With shadows all is cut. What
/// was cut is written, and waited for, while the next chunk is cut.
Result<void> cut_sprites(StageRun& run, const KeyedStore& store, const Extraction& extraction,
                         bool resumed) {
  const bool shaded = run.settings.shadow;
  std::vector<ShadowRow> shadows;
  if (shaded)
    if (auto made = make_folder(run.project.path(kShadowFolder)); !made) return made.error();
  std::future<Result<void>> writing;
  const auto written = [&writing] { return writing.valid() ? writing.get() : Result<void>{}; };
  const auto& rows = extraction.rows;
  const auto chunk_of = [&](std::size_t row) { return extraction.positions[row] / kChunkFrames; };
  for (std::size_t begin = 0; begin < rows.size() && rows[begin].mirror_of < 0;) {
    const int chunk = chunk_of(begin);
    std::size_t end = begin;
    std::vector<std::size_t> due;
    for (; end < rows.size() && rows[end].mirror_of < 0 && chunk_of(end) == chunk; ++end) {
      std::error_code error;
      if (shaded || !resumed || !fs::exists(run.project.sprite_path(rows[end].sample), error))
        due.push_back(end);
    }
    if (!due.empty()) {
      const auto frames = store.read(chunk);
      if (!frames)
        return Error{ErrorCode::CorruptData, run.project.path("keyed") + ": chunk " +
                                                 std::to_string(chunk) +
                                                 " was damaged meanwhile: run it again"};
      auto cut = cut_chunk(run.project, *frames, extraction, due, shaded ? &shadows : nullptr);
      if (!cut) return cut.error();
      if (auto wrote = written(); !wrote) return wrote;
      writing = std::async(std::launch::async, write_pictures, std::move(*cut));
    }
    begin = end;
    report(run,
           kKeyed + (1 - kKeyed) * static_cast<double>(end) / static_cast<double>(rows.size()));
  }
  if (auto wrote = written(); !wrote) return wrote;
  if (shaded)
    if (auto wrote = write_shadows(run.project, shadows); !wrote) return wrote;
  return sync_folder(run.project.path("sprites"));
}

Json segment_result(const std::string& name, const FilmInfo& info, const ScreenModel& screen,
                    const Extraction& extraction, int stride) {
  const std::size_t frames = extraction.fates.size() * static_cast<std::size_t>(stride);
  const int kept = static_cast<int>(extraction.rows.size());
  return {{"film", name},
          {"width", info.width},
          {"height", info.height},
          {"fps", {info.fps_numerator, info.fps_denominator}},
          {"background", screen.reason},
          {"frames", frames},
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
          {"velocity_noise", extraction.velocity_noise},
          {"draft", stride > 1}};
}

/// File name without folders; that of a folder of pictures is the folder's.
std::string source_name(const std::string& path) {
  const fs::path film(path);
  return (film.has_filename() ? film : film.parent_path()).filename().string();
}

/// Black bars, and what to do about them; nothing where there are none.
std::string bars_text(std::span<const Frame> sampled, const FilmInfo& info) {
  const Bars bars = find_bars(sampled);
  if (!bars.any()) return {};
  return bars.text() + " are taken for a part of the film; due: ffmpeg -i FILM -vf " +
         bars.crop(info.width, info.height) + " out.mp4";
}

/// What a person ought to know of the film before relying on its sprites; `holes`: the share of the
/// subject that shows as such.
std::vector<std::string> warnings_of(const FilmInfo& info, const ScreenModel& screen,
                                     const MatteConfig& matte, const std::string& bars,
                                     double holes) {
  constexpr double kManyHoles = 0.03;
  std::vector<std::string> out;
  if (!bars.empty()) out.push_back(bars);
  if (info.transfer != Transfer::Sdr)
    out.push_back(std::string(info.transfer == Transfer::Hlg ? "HLG" : "PQ") +
                  " is mapped to plain video by a fixed curve");
  if (info.interlaced)
    out.push_back(
        "the film is interlaced: its frames hold two moments each, and moving edges become combs; "
        "due: ffmpeg -i FILM -vf bwdif out.mp4");
  const bool keyed = screen.kind != KeyKind::None && screen.kind != KeyKind::Alpha;
  if (!keyed && matte != MatteConfig{.shadow = matte.shadow})
    out.push_back("clip-black, clip-white, edge and despill change what is keyed: nothing is");
  if (!keyed && matte.shadow)
    out.push_back("shadow: nothing is keyed, so no background is known that a shadow darkens");
  if (keyed && holes > kManyHoles)
    out.push_back(std::to_string(std::lround(100 * holes)) +
                  " % of the subject is too like the background and shows as holes (or has "
                  "holes); look at contact.png");
  return out;
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
  const auto matte = matte_of(run.settings);
  if (!matte) return matte.error();
  // The film is opened before any thread is started: opening forks.
  FilmSource source = source_of(run.settings, run.film);
  source.first = run.first_frame, source.end = run.end_frame;
  auto reader = FilmReader::open(source);
  if (!reader) return reader.error();
  const FilmInfo info = reader->info();
  const std::string name = source_name(run.film);

  const auto sampled = sample_frames(source, key->sample_count);
  if (!sampled) return sampled.error();
  report(run, kSampled);
  const auto screen = measure_screen(*sampled, *key);
  const std::string bars = bars_text(*sampled, info);
  const auto refused = [&bars](const Error& error, const std::string& film) {
    return Error{error.code, film + error.message + (bars.empty() ? "" : "; " + bars)};
  };
  if (!screen) return refused(screen.error(), run.film + ": ");
  if (run.listener.note) run.listener.note("background: " + screen->reason);

  const auto store = KeyedStore::open(run.project, origin);
  if (!store) return store.error();
  const auto summaries = KeyingPass(run, *reader, *screen, *matte, *store).run();
  if (!summaries) return summaries.error();

  const ExtractConfig config{.max_size = run.settings.draft
                                             ? std::min(run.settings.max_size, kDraftSize)
                                             : run.settings.max_size,
                             .sigma = run.settings.smooth,
                             .min_clip = run.settings.min_clip,
                             .subject = subject_of(run.settings.subject),
                             .ground = stands_on_ground(run.settings),
                             .floor = floor_of(run.settings),
                             .mirror = run.settings.mirror,
                             .stride = stride_of(run.settings),
                             .width = info.width,
                             .height = info.height};
  const double fps = static_cast<double>(info.fps_numerator) / info.fps_denominator;
  if (config.subject.number == SubjectChoice::kOnly)
    if (auto single = refuse_rivals(run, *store, info, fps / config.stride, *summaries); !single)
      return refused(single.error(), "");
  const auto extraction = extract(*summaries, fps, name, config);
  if (!extraction) return refused(extraction.error(), run.film + ": ");

  const std::string table = format_samples(rows_on_floor(*extraction));
  if (auto begun = run.project.begin_stage("segment"); !begun) return begun.error();
  const auto resumed = store->resume_cutting(hex64(hash_bytes(table)),
                                             [&run] { return clear_sprites(run.project); });
  if (!resumed) return resumed.error();
  if (auto made = make_folder(run.project.path("sprites")); !made) return made.error();
  if (auto cut = cut_sprites(run, *store, *extraction, *resumed); !cut) return cut.error();
  const auto holes = write_contact_sheet(run, *screen, *matte, *sampled, *extraction);
  if (!holes) return holes.error();
  if (auto wrote = write_file(run.project.path("samples.csv"), table); !wrote) return wrote.error();
  const auto dropped = write_dropped(run, *store, info, *summaries, *extraction);
  if (!dropped) return dropped.error();
  Json result = segment_result(name, info, *screen, *extraction, stride_of(run.settings));
  result["surplus"] = reader->surplus();
  result["dropped"] = *dropped;
  result["warnings"] = warnings_of(info, *screen, *matte, bars, *holes);
  if (const auto& floor = extraction->floor) {
    result["floor"] = {{"horizon", floor->horizon},
                       {"ground_line", floor->line},
                       {"center", floor->center},
                       {"focal", floor->focal},
                       {"scale", extraction->scale}};
    if (run.listener.note)
      run.listener.note("floor: horizon at y = " + std::to_string(std::lround(floor->horizon)) +
                        ", ground line at y = " + std::to_string(std::lround(floor->line)));
  }
  return result;
}

}  // namespace vsprite
