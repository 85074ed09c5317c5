// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// From bytes that nobody vouches for to a SpriteData: header, section table, then section by
// section. Every count is compared with the bytes that are there before memory is taken for it;
// what the numbers mean is checked afterwards, in one place (check_sprite_data).
#define XXH_STATIC_LINKING_ONLY  // the size of the streaming state
#include <xxhash.h>

#include <algorithm>
#include <memory>

#include "bulk.h"
#include "pack_format.h"
#include "sections.h"

namespace vsprite::detail {
namespace {

std::string number(std::uint64_t value) { return std::to_string(value); }

Finding unreadable(const Error& error, std::string_view section, std::uint64_t offset) {
  return finding("unreadable", section, offset, error.message, error.code);
}

// magic 8, major 2, minor 2, sections 4, file bytes 8, sum 8, zeros 32.
struct Header {
  std::uint32_t section_count = 0;
  std::uint64_t file_bytes = 0;
  std::uint64_t sum = 0;
};

Check check_version(const PackContent& content) {
  // A newer minor version adds sections, which are skipped.
  if (content.major == kPackMajor) return {};
  return finding("version", "", 8,
                 "pack version " + number(content.major) + "." + number(content.minor) +
                     ", this build reads 1.0 to " + number(kPackMajor) + ".x: " +
                     (content.major == 0 ? "rebuild it with `vsprite build`"
                                         : "get a newer vsprite, or build the pack with this one"),
                 ErrorCode::UnsupportedVersion);
}

Check read_first_bytes(const ByteSource& source, PackContent& content, Header& header,
                       std::vector<std::uint8_t>& table) {
  if (source.size() < kHeaderBytes) {
    return finding("too-short", "", 0,
                   number(source.size()) + " bytes, a pack has at least " + number(kHeaderBytes),
                   ErrorCode::BadFormat);
  }
  table.resize(kHeaderBytes);
  if (auto read = source.read(0, table); !read) return unreadable(read.error(), "", 0);
  if (!std::equal(kMagic.begin(), kMagic.end(), table.begin())) {
    return finding("bad-magic", "", 0, "not a pack (.vsp)", ErrorCode::BadFormat);
  }
  Cursor cursor(std::span<const std::uint8_t>(table).subspan(kMagic.size()));
  content.major = cursor.get<std::uint16_t>();
  content.minor = cursor.get<std::uint16_t>();
  if (Check bad = check_version(content)) return bad;
  header.section_count = cursor.get<std::uint32_t>();
  header.file_bytes = cursor.get<std::uint64_t>();
  header.sum = cursor.get<std::uint64_t>();
  return {};
}

Check check_counts(const ByteSource& source, const Header& header) {
  if (header.file_bytes != source.size()) {
    return finding("file-size", "", 16,
                   number(source.size()) + " bytes, its header says " + number(header.file_bytes));
  }
  if (header.file_bytes > kMaxFileBytes) {
    return finding(
        "file-limit", "", 16,
        number(header.file_bytes) + " bytes, at most " + number(kMaxFileBytes) + " are read",
        ErrorCode::LimitExceeded);
  }
  const std::uint64_t due = kHeaderBytes + std::uint64_t{header.section_count} * kEntryBytes;
  if (header.section_count > kMaxSections || due > source.size()) {
    return finding("section-count", "", 12,
                   number(header.section_count) + " sections, at most " + number(kMaxSections) +
                       " are read and their table needs " + number(due) + " bytes");
  }
  return {};
}

// Sections stand in ascending order, aligned, apart, and the last one ends the file.
Check check_layout(const PackContent& content, std::uint64_t file_bytes) {
  std::uint64_t end = kHeaderBytes + content.sections.size() * kEntryBytes;
  for (std::size_t s = 0; s < content.sections.size(); ++s) {
    const SectionEntry& entry = content.sections[s];
    const std::uint64_t at = kHeaderBytes + s * kEntryBytes;
    if (entry.offset % kAlignment != 0) {
      return finding("section-align", entry.name, at,
                     "offset " + number(entry.offset) + " is no multiple of 64");
    }
    if (entry.offset > file_bytes || entry.bytes > file_bytes - entry.offset) {
      return finding("section-bounds", entry.name, at,
                     number(entry.bytes) + " bytes at " + number(entry.offset) +
                         " reach beyond the file's " + number(file_bytes));
    }
    if (entry.offset < end) {
      return finding("section-overlap", entry.name, at,
                     "starts at " + number(entry.offset) +
                         ", before the end of what precedes it, " + number(end));
    }
    if (entry.offset - end >= kAlignment) {
      return finding("section-gap", entry.name, at,
                     "starts at " + number(entry.offset) + ", a gap after " + number(end));
    }
    end = entry.offset + entry.bytes;
  }
  if (end == file_bytes) return {};
  return finding("trailing-bytes", "", end, "the last section ends before the file does");
}

constexpr std::array<std::string_view, 5> kSingle{"META", "SAMP", "TRAN", "FIDX", "FRAM"};

bool is_known(std::string_view name) {
  return name == "CTRL" || std::find(kSingle.begin(), kSingle.end(), name) != kSingle.end();
}

Check read_entries(std::span<const std::uint8_t> table, PackContent& content) {
  Cursor cursor(table.subspan(kHeaderBytes));
  for (std::uint64_t at = kHeaderBytes; cursor.left() > 0; at += kEntryBytes) {
    SectionEntry entry;
    for (std::uint8_t c : cursor.take(4)) {
      if (c < 'A' || c > 'Z') {
        return finding("section-name", "", at, "a section's name is not four capital letters");
      }
      entry.name.push_back(static_cast<char>(c));
    }
    const auto version = cursor.get<std::uint16_t>();
    const auto flags = cursor.get<std::uint16_t>();
    // Sections that this build does not know may be of any version.
    if (is_known(entry.name) && (version != 1 || flags != 0)) {
      return finding(
          "section-version", entry.name, at + 4,
          "version " + number(version) + " and flags " + number(flags) + ", 1 and 0 are due",
          ErrorCode::UnsupportedVersion);
    }
    entry.offset = cursor.get<std::uint64_t>();
    entry.bytes = cursor.get<std::uint64_t>();
    entry.sum = cursor.get<std::uint64_t>();
    content.sections.push_back(std::move(entry));
  }
  return {};
}

Check check_names(const PackContent& content) {
  const auto count = [&](std::string_view name) {
    return std::count_if(content.sections.begin(), content.sections.end(),
                         [&](const SectionEntry& e) { return e.name == name; });
  };
  for (std::string_view name : kSingle) {
    const auto found = count(name);
    if (found == 0) return finding("section-missing", name, kHeaderBytes, "is missing");
    if (found > 1) return finding("section-twice", name, kHeaderBytes, "stands there twice");
  }
  const auto modes = static_cast<std::uint64_t>(count("CTRL"));
  if (modes == 0) return finding("section-missing", "CTRL", kHeaderBytes, "is missing");
  if (modes <= kMaxModes) return {};
  return finding("mode-count", "CTRL", kHeaderBytes,
                 number(modes) + " modes, at most " + number(kMaxModes) + " are read");
}

// One section in memory, with its sum checked.
struct Section {
  std::string_view name;
  std::uint64_t offset = 0;
  std::span<const std::uint8_t> bytes;
  // One place for all sections, one after the other; what is read over is not zeroed before.
  std::unique_ptr<std::uint8_t[]> memory;
  std::size_t room = 0;

  Finding wrong_size(std::string_view code, const std::string& what, std::uint64_t due) const {
    return finding(
        code, name, offset,
        what + ": need " + number(due) + " bytes, " + number(bytes.size()) + " are there");
  }
};

Check read_section(const ByteSource& source, const SectionEntry& entry, Section& section) {
  section.name = entry.name;
  section.offset = entry.offset;
  if (entry.bytes > section.room) {
    section.memory.reset();
    section.memory = std::make_unique_for_overwrite<std::uint8_t[]>(entry.bytes);
    section.room = entry.bytes;
  }
  const std::span bytes(section.memory.get(), entry.bytes);
  if (auto read = source.read(entry.offset, bytes); !read) {
    return unreadable(read.error(), entry.name, entry.offset);
  }
  section.bytes = bytes;
  if (hash_bytes(section.bytes) == entry.sum) return {};
  return finding("section-sum", entry.name, entry.offset,
                 "the section's sum does not fit its bytes");
}

// A section of many megabytes: read in pieces that stay in the cache while they are summed up and
// their numbers taken out. What was taken counts only after finish(). All takes are multiples of
// four bytes, so that numbers lie aligned in the piece.
class SectionReader {
 public:
  SectionReader(const ByteSource& source, const SectionEntry& entry)
      : source_(source),
        entry_(entry),
        piece_bytes_(std::min<std::uint64_t>(entry.bytes, kPieceBytes)),
        piece_(std::make_unique_for_overwrite<std::uint8_t[]>(piece_bytes_)) {
    XXH3_64bits_reset(&sum_);
  }

  std::uint64_t offset() const { return entry_.offset; }
  std::uint64_t size() const { return entry_.bytes; }
  std::uint64_t left() const { return front_.size() + entry_.bytes - read_; }

  // The next bytes, valid until the next call. Pre: count <= left(), and at most 1 KB.
  std::span<const std::uint8_t> take(std::size_t count) {
    if (front_.size() < count) read_more();
    const auto taken = front_.first(count);
    front_ = front_.subspan(count);
    return taken;
  }

  // So many numbers, or pairs of numbers of four bytes. Pre: they are left.
  template <class T>
  void take_all(std::uint64_t count, std::vector<T>& out) {
    reserve_bulk(out, count);
    while (out.size() < count) {
      if (front_.size() < sizeof(T)) read_more();
      const std::size_t part =
          std::min<std::uint64_t>(front_.size() / sizeof(T), count - out.size());
      append(front_.first(part * sizeof(T)), out);
      front_ = front_.subspan(part * sizeof(T));
    }
  }

  // Reads and sums up the rest. What is wrong with the bytes comes before what they say, `bad`.
  Check finish(Check bad) {
    while (read_ < entry_.bytes) {
      front_ = {};
      read_more();
    }
    if (failed_) return failed_;
    if (XXH3_64bits_digest(&sum_) == entry_.sum) return bad;
    return finding("section-sum", entry_.name, entry_.offset,
                   "the section's sum does not fit its bytes");
  }

  Finding wrong_size(std::string_view code, const std::string& what, std::uint64_t due) const {
    return finding(code, entry_.name, entry_.offset,
                   what + ": need " + number(due) + " bytes, " + number(size()) + " are there");
  }

 private:
  static constexpr std::size_t kPieceBytes = std::size_t{128} << 10;

  void read_more() {
    std::copy(front_.begin(), front_.end(), piece_.get());
    const auto fresh =
        std::span(piece_.get(), piece_bytes_)
            .subspan(front_.size())
            .first(std::min<std::uint64_t>(piece_bytes_ - front_.size(), entry_.bytes - read_));
    if (!failed_) {
      if (auto read = source_.read(entry_.offset + read_, fresh); !read)
        failed_ = unreadable(read.error(), entry_.name, entry_.offset);
    }
    if (failed_) std::fill(fresh.begin(), fresh.end(), std::uint8_t{0});
    XXH3_64bits_update(&sum_, fresh.data(), fresh.size());
    read_ += fresh.size();
    front_ = std::span(piece_.get(), front_.size() + fresh.size());
  }

  template <class T>
  static void append(std::span<const std::uint8_t> bytes, std::vector<T>& out) {
    static_assert(alignof(T) == 4 && std::is_trivially_copyable_v<T>);
    const auto* first = reinterpret_cast<const T*>(bytes.data());
    out.insert(out.end(), first, first + bytes.size() / sizeof(T));
    if constexpr (std::endian::native == std::endian::big) {
      auto* at = reinterpret_cast<std::uint8_t*>(out.data() + out.size()) - bytes.size();
      for (std::size_t i = 0; i < bytes.size(); i += 4) std::reverse(at + i, at + i + 4);
    }
  }

  const ByteSource& source_;
  const SectionEntry& entry_;
  std::size_t piece_bytes_;
  std::unique_ptr<std::uint8_t[]> piece_;
  std::span<const std::uint8_t> front_;  // of the piece, not yet taken
  std::uint64_t read_ = 0;
  XXH3_state_t sum_;
  Check failed_;
};

const SectionEntry& entry_of(const PackContent& content, std::string_view name) {
  return *std::find_if(content.sections.begin(), content.sections.end(),
                       [&](const SectionEntry& e) { return e.name == name; });
}

Check read_text(const Section& section, Cursor& cursor, std::string& text) {
  const std::uint64_t at = section.offset + section.bytes.size() - cursor.left();
  if (cursor.left() < 2)
    return finding("text-size", section.name, at, "a text's length is cut off");
  const std::size_t length = cursor.get<std::uint16_t>();
  if (length > cursor.left()) {
    return finding(
        "text-size", section.name, at,
        "a text of " + number(length) + " bytes, " + number(cursor.left()) + " are left");
  }
  const auto bytes = cursor.take(length);
  text.assign(bytes.begin(), bytes.end());
  return {};
}

Check read_meta(const Section& section, SpriteData& data, std::uint32_t& sample_count) {
  if (section.bytes.size() < kMetaBytes) {
    return section.wrong_size("meta-size", "fixed fields", kMetaBytes);
  }
  Cursor cursor(section.bytes);
  data.fps_numerator = cursor.get<std::uint32_t>();
  data.fps_denominator = cursor.get<std::uint32_t>();
  data.body_length = cursor.get<float>();
  data.start_sample = cursor.get<std::uint32_t>();
  sample_count = cursor.get<std::uint32_t>();
  const auto tag_count = cursor.get<std::uint32_t>();
  if (cursor.get<std::uint64_t>() != 0) {
    return finding("reserved", "META", section.offset + 24, "reserved bytes are not 0");
  }
  if (tag_count > kMaxTags || tag_count * 2 > cursor.left()) {
    return finding("tag-count", "META", section.offset + 20,
                   number(tag_count) + " tags in " + number(cursor.left()) + " bytes, at most " +
                       number(kMaxTags) + " are read");
  }
  if (Check bad = read_text(section, cursor, data.name)) return bad;
  data.tags.assign(tag_count, {});
  for (std::string& tag : data.tags) {
    if (Check bad = read_text(section, cursor, tag)) return bad;
  }
  if (cursor.left() == 0) return {};
  return finding("meta-size", "META", section.offset,
                 number(cursor.left()) + " bytes too many after the last tag");
}

Check read_samples(const Section& section, SpriteData& data, std::uint32_t count) {
  const std::uint64_t due = std::uint64_t{count} * kSampleBytes;
  if (section.bytes.size() != due) {
    return section.wrong_size("samp-size", number(count) + " samples", due);
  }
  data.samples.resize(count);
  Cursor cursor(section.bytes);
  for (Sample& s : data.samples) {
    s.anchor.x = cursor.get<float>();
    s.anchor.y = cursor.get<float>();
    s.velocity.x = cursor.get<float>();
    s.velocity.y = cursor.get<float>();
    s.step_x = cursor.get<std::int32_t>();
    s.step_y = cursor.get<std::int32_t>();
    s.area = cursor.get<float>();
    s.scale = cursor.get<float>();
    s.width = cursor.get<std::uint16_t>();
    s.height = cursor.get<std::uint16_t>();
    s.duration = cursor.get<std::uint16_t>();
    s.tag = cursor.get<std::uint16_t>();
    s.clip = cursor.get<std::uint32_t>();
    s.frame = cursor.get<std::uint32_t>();
    s.mirror_of = cursor.get<std::uint32_t>();
    s.kept = cursor.get<std::uint32_t>();
    s.skip_cost = cursor.get<float>();
  }
  return {};
}

Check read_transitions(SectionReader& section, SpriteData& data) {
  const std::uint64_t rows = std::uint64_t{data.samples.size()} + 1;
  if (section.size() < 8 + 4 * rows) {
    return section.wrong_size("tran-size", number(rows) + " row starts", 8 + 4 * rows);
  }
  const auto count = Cursor(section.take(8)).get<std::uint64_t>();
  const std::uint64_t left = section.left() - 4 * rows;
  if (count > kMaxTransitions || count * 8 != left) {
    return finding("tran-size", "TRAN", section.offset(),
                   number(count) + " transitions of 8 bytes, " + number(left) + " bytes are there");
  }
  section.take_all(rows, data.row_start);
  section.take_all(count, data.transitions);
  return {};
}

// The counts on which the size of the tables depends.
Check check_table_count(const ControlMode& mode, std::uint64_t offset) {
  if (mode.headings != 8 && mode.headings != 16 && mode.headings != 32) {
    return finding("headings", "CTRL", offset + 52,
                   number(mode.headings) + " headings, 8, 16 or 32 are due");
  }
  if (mode.stages >= 1 && mode.stages <= kMaxTables && mode.tables() <= kMaxTables) return {};
  return finding("stages", "CTRL", offset + 12,
                 number(mode.stages) + " stages of " + number(mode.headings) + " headings, 1 to " +
                     number(kMaxTables / (mode.headings + 2)) + " are due");
}

Check read_mode(SectionReader& section, std::size_t n, ControlMode& mode) {
  if (section.size() < kModeBytes) {
    return section.wrong_size("ctrl-size", "fixed fields", kModeBytes);
  }
  Cursor cursor(section.take(kModeBytes));
  mode.alpha = cursor.get<float>();
  mode.w1 = cursor.get<float>();
  mode.cap = cursor.get<float>();
  mode.stages = cursor.get<std::uint32_t>();
  mode.residual = cursor.get<double>();
  mode.error_bound = cursor.get<double>();
  mode.served = cursor.get<std::uint32_t>();
  const auto name_bytes = cursor.get<std::uint32_t>();
  for (Direction& d : mode.table_of) d = static_cast<Direction>(cursor.get<std::uint8_t>());
  const auto flags = cursor.get<std::uint8_t>();
  mode.by_state = (flags & kByState) != 0;
  mode.plays_through = (flags & kPlaysThrough) != 0;
  if ((flags & ~(kByState | kPlaysThrough)) != 0) {
    return finding("switching", "CTRL", section.offset() + 50,
                   "flags " + number(flags) + ", at most 3 is due");
  }
  mode.power = cursor.get<std::uint8_t>();
  mode.headings = cursor.get<std::uint32_t>();
  mode.served_headings = cursor.get<std::uint32_t>();
  mode.turn_w1 = cursor.get<float>();
  mode.change_rate = cursor.get<float>();
  mode.speed_weight = cursor.get<float>();
  mode.skip_price = cursor.get<float>();
  mode.exit_angle = cursor.get<float>();
  mode.dead_angle = cursor.get<float>();
  mode.bend_cos = cursor.get<std::int32_t>();
  mode.bend_sin = cursor.get<std::int32_t>();
  for (std::uint8_t zero : cursor.take(cursor.left())) {
    if (zero != 0)
      return finding("reserved", "CTRL", section.offset() + 92, "reserved bytes are not 0");
  }
  const std::uint64_t padded = (std::uint64_t{name_bytes} + 3) / 4 * 4;
  if (name_bytes > kMaxText || padded > section.left()) {
    return finding(
        "text-size", "CTRL", section.offset() + 36,
        "a name of " + number(name_bytes) + " bytes, " + number(section.left()) + " are left");
  }
  const auto name = section.take(padded);
  mode.name.assign(name.begin(), name.begin() + name_bytes);
  if (std::any_of(name.begin() + name_bytes, name.end(), [](auto c) { return c != 0; })) {
    return finding("padding", "CTRL", section.offset() + kModeBytes,
                   "padding of the name is not 0");
  }
  if (Check bad = check_table_count(mode, section.offset())) return bad;
  const std::uint64_t entries = mode.tables() * n;
  const std::uint64_t due = 4 * (2 * entries + (mode.by_state ? n : 0));
  if (section.left() != due) {
    return finding("ctrl-size", "CTRL", section.offset(),
                   number(mode.tables()) + " tables need " + number(due) + " bytes, " +
                       number(section.left()) + " are there");
  }
  section.take_all(entries, mode.next);
  section.take_all(entries, mode.go);
  section.take_all(mode.by_state ? n : 0, mode.arrived);
  return {};
}

// Compressed pictures lie one behind the other, in the order of the samples, and fill FRAM.
Check read_frames(const Section& section, PackContent& content) {
  const std::uint64_t due = std::uint64_t{content.data.samples.size()} * kFrameBytes;
  if (section.bytes.size() != due) {
    return section.wrong_size("fidx-size", number(content.data.samples.size()) + " pictures", due);
  }
  const SectionEntry& fram = entry_of(content, "FRAM");
  content.fram_offset = fram.offset;
  content.frames.resize(content.data.samples.size());
  Cursor cursor(section.bytes);
  std::uint64_t end = 0;
  for (std::size_t i = 0; i < content.frames.size(); ++i) {
    FrameEntry& frame = content.frames[i];
    frame.offset = cursor.get<std::uint64_t>();
    frame.bytes = cursor.get<std::uint32_t>();
    const auto zero = cursor.get<std::uint32_t>();
    frame.sum = cursor.get<std::uint64_t>();
    const auto bad = [&](std::string_view code, const std::string& what) {
      return finding(code, "FIDX", section.offset + i * kFrameBytes,
                     "picture " + number(i) + ": " + what);
    };
    if (zero != 0) return bad("reserved", "reserved bytes are not 0");
    const bool kept = content.data.samples[i].kept != 0;
    if (kept ? frame.bytes == 0 : frame.bytes != 0 || frame.offset != 0 || frame.sum != 0) {
      return bad("frame-kept", kept ? "none for a kept sample" : "one for a sample not kept");
    }
    if (!kept) continue;
    if (frame.offset != end || frame.bytes > fram.bytes - end) {
      return bad("frame-bounds", number(frame.bytes) + " bytes at " + number(frame.offset) +
                                     ", due at " + number(end) + " within " + number(fram.bytes));
    }
    end += frame.bytes;
  }
  if (end == fram.bytes) return {};
  return finding("frame-bounds", "FIDX", section.offset,
                 "the pictures end at " + number(end) + ", FRAM at " + number(fram.bytes));
}

Check read_modes(const ByteSource& source, const PackContent& content,
                 std::vector<ControlMode>& modes) {
  for (const SectionEntry& entry : content.sections) {
    if (entry.name != "CTRL") continue;
    SectionReader section(source, entry);
    ControlMode& mode = modes.emplace_back();
    if (Check bad = section.finish(read_mode(section, content.data.samples.size(), mode)))
      return bad;
  }
  return {};
}

// The two kinds of large tables, side by side.
Check read_tables(const ByteSource& source, PackContent& content) {
  const SectionEntry& transitions = entry_of(content, "TRAN");
  std::uint64_t bytes = transitions.bytes;
  for (const SectionEntry& entry : content.sections)
    bytes += entry.name == "CTRL" ? entry.bytes : 0;
  Check bad_transitions, bad_modes;
  std::vector<ControlMode> modes;
  run_both(
      source.is_shared() ? bytes : 0,
      [&] {
        SectionReader section(source, transitions);
        bad_transitions = section.finish(read_transitions(section, content.data));
      },
      [&] { bad_modes = read_modes(source, content, modes); });
  content.data.modes = std::move(modes);
  return bad_transitions ? bad_transitions : bad_modes;
}

// An offset that says where the section lies, for findings about its meaning.
Check locate(Check bad, const PackContent& content) {
  if (bad && bad->issue.offset == 0 && !bad->issue.section.empty()) {
    bad->issue.offset = entry_of(content, bad->issue.section).offset;
  }
  return bad;
}

}  // namespace

Check read_header(const ByteSource& source, PackContent& content) {
  Header header;
  std::vector<std::uint8_t> table;
  if (Check bad = read_first_bytes(source, content, header, table)) return bad;
  if (Check bad = check_counts(source, header)) return bad;
  table.resize(kHeaderBytes + header.section_count * kEntryBytes);
  if (auto read = source.read(0, table); !read) return unreadable(read.error(), "", 0);
  std::fill(table.begin() + 24, table.begin() + 32, std::uint8_t{0});
  if (hash_bytes(table) != header.sum) {
    return finding("header-sum", "", 24, "the sum of header and section table does not fit");
  }
  if (std::any_of(table.begin() + 32, table.begin() + kHeaderBytes,
                  [](auto c) { return c != 0; })) {
    return finding("reserved", "", 32, "reserved bytes are not 0");
  }
  content.identity = header.sum;
  if (Check bad = read_entries(table, content)) return bad;
  if (Check bad = check_layout(content, header.file_bytes)) return bad;
  return check_names(content);
}

Check read_loss(const ByteSource& source, PackContent& content) {
  for (const SectionEntry& entry : content.sections) {
    if (entry.name != "LOSS") continue;
    if (content.loss)
      return finding("section-twice", "LOSS", entry.offset, "stands there more than once");
    if (entry.bytes != kLossBytes)
      return finding("loss", "LOSS", entry.offset,
                     "two errors need 16 bytes, " + number(entry.bytes) + " are there");
    Section section;
    if (Check bad = read_section(source, entry, section)) return bad;
    Cursor cursor(section.bytes);
    PictureErrors& loss = content.loss.emplace();
    loss.colour = cursor.get<double>();
    loss.alpha = cursor.get<double>();
    const auto is_error = [](double value) { return value >= 0 && value <= 255.0 * 255.0; };
    if (!is_error(loss.colour) || !is_error(loss.alpha))
      return finding("loss", "LOSS", entry.offset,
                     "a mean squared error is not a number from 0 to 65025");
  }
  return {};
}

Check read_content(const ByteSource& source, PackContent& content) {
  SpriteData& data = content.data;
  std::uint32_t sample_count = 0;
  Section section;
  if (Check bad = read_section(source, entry_of(content, "META"), section)) return bad;
  if (Check bad = read_meta(section, data, sample_count)) return bad;
  if (Check bad = read_section(source, entry_of(content, "SAMP"), section)) return bad;
  if (Check bad = read_samples(section, data, sample_count)) return bad;
  if (Check bad = read_tables(source, content)) return bad;
  if (Check bad = locate(check_sprite_data(data), content)) return bad;
  if (Check bad = read_optional(source, content)) return bad;
  if (Check bad = read_loss(source, content)) return bad;
  if (Check bad = locate(check_picture_sizes(data), content)) return bad;
  if (Check bad = read_section(source, entry_of(content, "FIDX"), section)) return bad;
  return read_frames(section, content);
}

}  // namespace vsprite::detail
