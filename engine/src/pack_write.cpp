// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Writing a pack: tables from memory, pictures one at a time, header last. The same data and
// pictures give the same bytes.
#define XXH_STATIC_LINKING_ONLY  // the size of the streaming state
#include <xxhash.h>

#include <cstddef>

#include "block_codec.h"
#include "pack_format.h"
#include "sections.h"

namespace vsprite {
namespace detail {
namespace {

Bytes meta_bytes(const SpriteData& data) {
  Bytes out;
  out.put(data.fps_numerator);
  out.put(data.fps_denominator);
  out.put(data.body_length);
  out.put(data.start_sample);
  out.put(static_cast<std::uint32_t>(data.samples.size()));
  out.put(static_cast<std::uint32_t>(data.tags.size()));
  out.put(std::uint64_t{0});
  out.put(static_cast<std::uint16_t>(data.name.size()));
  out.text(data.name);
  for (const std::string& tag : data.tags) {
    out.put(static_cast<std::uint16_t>(tag.size()));
    out.text(tag);
  }
  return out;
}

Bytes sample_bytes(const SpriteData& data) {
  Bytes out;
  out.data.reserve(data.samples.size() * kSampleBytes);
  for (const Sample& s : data.samples) {
    out.put(s.anchor.x);
    out.put(s.anchor.y);
    out.put(s.velocity.x);
    out.put(s.velocity.y);
    out.put(s.step_x);
    out.put(s.step_y);
    out.put(s.area);
    out.put(s.scale);
    out.put(s.kept ? s.width : std::uint16_t{0});
    out.put(s.kept ? s.height : std::uint16_t{0});
    out.put(s.duration);
    out.put(s.tag);
    out.put(s.clip);
    out.put(s.frame);
    out.put(s.mirror_of);
    out.put(s.kept);
    out.put(s.skip_cost);
  }
  return out;
}

Bytes transition_bytes(const SpriteData& data) {
  Bytes out;
  out.data.reserve(8 + 4 * data.row_start.size() + 8 * data.transitions.size());
  out.put(std::uint64_t{data.transitions.size()});
  for (std::uint32_t start : data.row_start) out.put(start);
  for (const Transition& t : data.transitions) {
    out.put(t.to);
    out.put(t.cost);
  }
  return out;
}

Bytes mode_bytes(const ControlMode& mode) {
  Bytes out;
  out.data.reserve(kModeBytes + mode.name.size() + 4 +
                   4 * (mode.next.size() + mode.go.size() + mode.arrived.size()));
  out.put(mode.alpha);
  out.put(mode.w1);
  out.put(mode.cap);
  out.put(mode.stages);
  out.put(mode.residual);
  out.put(mode.error_bound);
  out.put(mode.served);
  out.put(static_cast<std::uint32_t>(mode.name.size()));
  for (Direction d : mode.table_of) out.put(static_cast<std::uint8_t>(d));
  out.put(static_cast<std::uint8_t>((mode.by_state ? kByState : 0) |
                                    (mode.plays_through ? kPlaysThrough : 0)));
  out.put(static_cast<std::uint8_t>(mode.power));
  out.put(mode.headings);
  out.put(mode.served_headings);
  out.put(mode.turn_w1);
  out.put(mode.change_rate);
  out.put(mode.speed_weight);
  out.put(mode.skip_price);
  out.put(mode.exit_angle);
  out.put(mode.dead_angle);
  out.put(mode.bend_cos);
  out.put(mode.bend_sin);
  out.pad_to(kModeBytes);
  out.text(mode.name);
  out.pad_to(4);
  for (std::uint32_t next : mode.next) out.put(next);
  for (float go : mode.go) out.put(go);
  for (std::uint32_t arrived : mode.arrived) out.put(arrived);
  return out;
}

// Puts sections into the file one behind the other and keeps their table.
class PackWriter {
 public:
  PackWriter(FileWriter file, std::size_t section_count, std::uint16_t minor)
      : file_(std::move(file)), end_(kHeaderBytes + section_count * kEntryBytes), minor_(minor) {}

  // Starts a section at the next multiple of 64; the gap before it is zeros.
  Result<void> begin(std::string_view name) {
    std::vector<std::uint8_t> zeros((kAlignment - end_ % kAlignment) % kAlignment);
    if (auto written = file_.write(end_, zeros); !written) return written;
    end_ += zeros.size();
    sections_.push_back({std::string(name), end_, 0, 0});
    return {};
  }

  Result<void> append(std::span<const std::uint8_t> bytes) {
    if (auto written = file_.write(end_, bytes); !written) return written;
    end_ += bytes.size();
    sections_.back().bytes += bytes.size();
    return {};
  }

  void end(std::uint64_t sum) { sections_.back().sum = sum; }

  Result<void> section(std::string_view name, std::span<const std::uint8_t> bytes) {
    if (auto begun = begin(name); !begun) return begun;
    end(hash_bytes(bytes));
    return append(bytes);
  }

  // Replaces the bytes of an earlier section by as many others.
  Result<void> rewrite(std::size_t index, const Bytes& bytes) {
    sections_[index].sum = hash_bytes(bytes.data);
    return file_.write(sections_[index].offset, bytes.data);
  }

  Result<void> finish() {
    if (auto written = file_.write(0, header_bytes(sections_, end_, minor_).data); !written)
      return written;
    return file_.finish();
  }

  std::size_t section_count() const { return sections_.size(); }

 private:
  FileWriter file_;
  std::uint64_t end_;
  std::uint16_t minor_;
  std::vector<SectionEntry> sections_;
};

Error misfit(const std::string& path, std::uint32_t sample, const Sample& s, const Image& image) {
  return {ErrorCode::CorruptData,
          path + ": picture of sample " + std::to_string(sample) + " is " +
              std::to_string(image.width) + " x " + std::to_string(image.height) + ", " +
              std::to_string(s.width) + " x " + std::to_string(s.height) + " is due"};
}

// One picture at a time, in the form that is wanted.
class PictureWriter {
 public:
  explicit PictureWriter(PictureForm form) : form_(form) {}
  // `image` premultiplied. Valid until the next call.
  std::span<const std::uint8_t> encode(const Image& image) {
    if (form_ == PictureForm::Exact) return codec_.encode(image);
    blocks_ = encode_blocks(image);
    decode_blocks(blocks_, image.width, image.height, decoded_);
    loss_.add(image, decoded_);
    squeeze_blocks(blocks_, bytes_);
    return bytes_;
  }
  Bytes loss_bytes() const {
    const double pixels = static_cast<double>(std::max<std::uint64_t>(loss_.pixels, 1));
    Bytes out;
    out.put(static_cast<double>(loss_.colour) / (3 * pixels));
    out.put(static_cast<double>(loss_.alpha) / pixels);
    return out;
  }

 private:
  PictureForm form_;
  FrameCodec codec_;
  BlockLoss loss_;
  std::vector<std::uint8_t> blocks_, bytes_;
  Image decoded_;
};

// FRAM, one picture in memory at a time; fills `index` with FIDX.
Result<void> write_frames(const std::string& path, const SpriteData& data,
                          const FrameSource& frames, PictureWriter& pictures, PackWriter& pack,
                          Bytes& index) {
  XXH3_state_t sum;
  XXH3_64bits_reset(&sum);
  std::uint64_t offset = 0;
  for (std::uint32_t i = 0; i < data.samples.size(); ++i) {
    FrameEntry entry;
    if (data.samples[i].kept != 0) {
      auto image = frames(i);
      if (!image) return image.error();
      const Sample& s = data.samples[i];
      const std::size_t due = std::size_t{4} * s.width * s.height;
      if (image->width != s.width || image->height != s.height || image->rgba.size() != due) {
        return misfit(path, i, s, *image);
      }
      premultiply(*image);
      const auto bytes = pictures.encode(*image);
      entry = {offset, static_cast<std::uint32_t>(bytes.size()), hash_bytes(bytes)};
      offset += entry.bytes;
      XXH3_64bits_update(&sum, bytes.data(), bytes.size());
      if (auto written = pack.append(bytes); !written) return written;
    }
    index.put(entry.offset);
    index.put(entry.bytes);
    index.put(std::uint32_t{0});
    index.put(entry.sum);
  }
  pack.end(XXH3_64bits_digest(&sum));
  return {};
}

Result<void> write_pack(const std::string& path, const SpriteData& data, const FrameSource& frames,
                        std::span<const PackExtra> extras, PictureForm form) {
  auto file = FileWriter::create(path);
  if (!file) return file.error();
  const std::vector<OptionalSection> optional = optional_sections(data);
  const auto extra_count = static_cast<std::size_t>(
      std::count_if(extras.begin(), extras.end(), [](const auto& e) { return !e.bytes.empty(); }));
  const bool exact = form == PictureForm::Exact;
  PackWriter pack(std::move(*file),
                  5 + data.modes.size() + optional.size() + extra_count + (exact ? 0 : 1),
                  exact ? 0 : 1);
  PictureWriter pictures(form);
  if (auto done = pack.section("META", meta_bytes(data).data); !done) return done;
  if (auto done = pack.section("SAMP", sample_bytes(data).data); !done) return done;
  if (auto done = pack.section("TRAN", transition_bytes(data).data); !done) return done;
  for (const ControlMode& mode : data.modes) {
    if (auto done = pack.section("CTRL", mode_bytes(mode).data); !done) return done;
  }
  for (const OptionalSection& section : optional) {
    if (auto done = pack.section(section.name, section.bytes.data); !done) return done;
  }
  // Errors and index stand before the pictures but are known only after them: their places are
  // kept free.
  const std::size_t loss_section = pack.section_count();
  if (!exact) {
    if (auto done = pack.section("LOSS", pictures.loss_bytes().data); !done) return done;
  }
  Bytes index;
  index.data.resize(data.samples.size() * kFrameBytes);
  const std::size_t index_section = pack.section_count();
  if (auto done = pack.section("FIDX", index.data); !done) return done;
  index.data.clear();
  if (auto done = pack.begin("FRAM"); !done) return done;
  if (auto done = write_frames(path, data, frames, pictures, pack, index); !done) return done;
  if (auto done = pack.rewrite(index_section, index); !done) return done;
  if (!exact) {
    if (auto done = pack.rewrite(loss_section, pictures.loss_bytes()); !done) return done;
  }
  for (const PackExtra& extra : extras) {
    if (extra.bytes.empty()) continue;
    if (auto done = pack.section(extra.name, extra.bytes); !done) return done;
  }
  return pack.finish();
}

}  // namespace

Bytes header_bytes(std::span<const SectionEntry> sections, std::uint64_t end, std::uint16_t minor) {
  Bytes out;
  out.data.assign(kMagic.begin(), kMagic.end());
  out.put(kPackMajor);
  out.put(minor);
  out.put(static_cast<std::uint32_t>(sections.size()));
  out.put(end);
  out.pad_to(kHeaderBytes);
  for (const SectionEntry& entry : sections) {
    out.text(entry.name);
    out.put(std::uint16_t{1});
    out.put(std::uint16_t{0});
    out.put(entry.offset);
    out.put(entry.bytes);
    out.put(entry.sum);
  }
  Bytes sum;
  sum.put(hash_bytes(out.data));
  std::copy(sum.data.begin(), sum.data.end(), out.data.begin() + 24);
  return out;
}
}  // namespace detail

Result<void> save_pack(const std::string& path, const SpriteData& data, const FrameSource& frames,
                       std::span<const PackExtra> extras, PictureForm form) {
  try {
    if (detail::Check bad = detail::check_sprite_data(data)) {
      return Error{bad->error, path + ": " + bad->issue.section + ": " + bad->issue.message};
    }
    return detail::write_pack(path, data, frames, extras, form);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::OutOfMemory, path + ": out of memory while writing"};
  }
}

}  // namespace vsprite
