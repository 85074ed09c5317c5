// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "tool/keyed.h"

#include <zstd.h>

#include <algorithm>
#include <filesystem>
#include <memory>

namespace vsprite {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kChunkMagic = 0x33444559454B5356;  // "VSKEYED3"
constexpr int kLevel = -5;  // the files live for a minute: a third of the time of 1, 15 % larger

void put_compressed(ByteWriter& writer, const std::vector<std::uint8_t>& bytes) {
  // Of the thread: the room would be cleared anew for every picture.
  thread_local std::vector<char> packed;
  thread_local const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context{
      ZSTD_createCCtx(), ZSTD_freeCCtx};
  packed.resize(std::max(packed.size(), ZSTD_compressBound(bytes.size())));
  const std::size_t size = ZSTD_compressCCtx(context.get(), packed.data(), packed.size(),
                                             bytes.data(), bytes.size(), kLevel);
  const auto whole = std::span<const char>(packed).first(ZSTD_isError(size) ? 0 : size);
  writer.put(std::uint64_t{whole.size()});
  writer.put_array(whole);
}

bool get_compressed(ByteReader& reader, std::vector<std::uint8_t>& bytes, std::size_t size) {
  std::uint64_t packed_size = 0;
  if (!reader.get(packed_size) || packed_size > reader.left()) return false;
  const std::string_view packed = reader.take(packed_size);
  bytes.resize(size);
  return ZSTD_decompress(bytes.data(), size, packed.data(), packed.size()) == size;
}

bool get_shade(ByteReader& reader, KeyedFrame& frame) {
  const Rect& cells = frame.shade_cells;
  if (!reader.get(frame.shade_cells)) return false;
  if (cells.width == 0) return true;
  const auto count = static_cast<std::size_t>(cells.width) * static_cast<std::size_t>(cells.height);
  return get_compressed(reader, frame.shade, count) &&
         get_compressed(reader, frame.shade_labels, count);
}

bool get_keyed(ByteReader& reader, KeyedFrame& frame) {
  std::uint32_t blobs = 0;
  if (!reader.get(frame.index) || !reader.get(frame.lost_before) || !reader.get(frame.crop) ||
      !reader.get(frame.difference) || !reader.get(blobs) || !reader.get_array(frame.blobs, blobs))
    return false;
  const auto pixels =
      static_cast<std::size_t>(frame.crop.width) * static_cast<std::size_t>(frame.crop.height);
  frame.straight.width = frame.crop.width;
  frame.straight.height = frame.crop.height;
  return get_compressed(reader, frame.straight.rgba, 4 * pixels) &&
         get_compressed(reader, frame.labels, pixels) && get_shade(reader, frame);
}

std::string chunk_name(int chunk) {
  std::string digits = std::to_string(chunk);
  if (digits.size() < 6) digits.insert(0, 6 - digits.size(), '0');
  return "/" + digits + ".bin";
}

}  // namespace

FrameSummary summary_of(const KeyedFrame& frame, bool ground) {
  FrameSummary summary{.index = frame.index,
                       .blobs = frame.blobs,
                       .difference = frame.difference,
                       .ground = {},
                       .lost_before = frame.lost_before};
  if (ground) summary.ground = ground_lines(frame);
  return summary;
}

std::string pack_keyed(const KeyedFrame& frame) {
  ByteWriter writer;
  writer.put(frame.index);
  writer.put(frame.lost_before);
  writer.put(frame.crop);
  writer.put(frame.difference);
  writer.put(static_cast<std::uint32_t>(frame.blobs.size()));
  writer.put_array(std::span<const Blob>(frame.blobs));
  put_compressed(writer, frame.straight.rgba);
  put_compressed(writer, frame.labels);
  writer.put(frame.shade_cells);
  if (frame.shade_cells.width > 0) {
    put_compressed(writer, frame.shade);
    put_compressed(writer, frame.shade_labels);
  }
  return std::move(writer).take();
}

Result<KeyedStore> KeyedStore::open(const Project& project, const std::string& origin) {
  KeyedStore store;
  store.folder_ = project.path("keyed");
  const auto stands = read_file(store.folder_ + "/origin");
  if (!stands || *stands != origin) store.remove();
  if (auto made = make_folder(store.folder_); !made) return made.error();
  if (auto wrote = write_file(store.folder_ + "/origin", origin); !wrote) return wrote.error();
  return store;
}

std::optional<std::vector<KeyedFrame>> KeyedStore::read(int chunk) const {
  const auto bytes = read_file(folder_ + chunk_name(chunk));
  constexpr std::size_t kSum = 8;
  if (!bytes || bytes->size() < 16 + kSum) return std::nullopt;
  const std::string_view body = std::string_view(*bytes).substr(0, bytes->size() - kSum);
  std::uint64_t sum = 0, magic = 0, count = 0;
  ByteReader(std::string_view(*bytes).substr(body.size())).get(sum);
  ByteReader reader(body);
  if (hash_bytes(body) != sum || !reader.get(magic) || magic != kChunkMagic || !reader.get(count) ||
      count > kChunkFrames)
    return std::nullopt;
  std::vector<KeyedFrame> frames(static_cast<std::size_t>(count));
  for (KeyedFrame& frame : frames)
    if (!get_keyed(reader, frame)) return std::nullopt;
  return frames;
}

Result<void> KeyedStore::write(int chunk, const std::vector<std::string>& frames) const {
  ByteWriter writer;
  std::size_t bytes = 24;
  for (const std::string& frame : frames) bytes += frame.size();
  writer.reserve(bytes);
  writer.put(kChunkMagic);
  writer.put(std::uint64_t{frames.size()});
  for (const std::string& frame : frames) writer.put_array(std::span<const char>(frame));
  writer.put(hash_bytes(writer.bytes()));
  return write_scratch_file(folder_ + chunk_name(chunk), writer.bytes());
}

Result<bool> KeyedStore::resume_cutting(const std::string& extraction,
                                        const std::function<Result<void>()>& clear) const {
  const std::string note = folder_ + "/cutting";
  const auto stands = read_file(note);
  if (stands && *stands == extraction) return true;
  if (auto cleared = clear(); !cleared) return cleared.error();
  if (auto wrote = write_file(note, extraction); !wrote) return wrote.error();
  return false;
}

void KeyedStore::remove() const {
  // The note of their origin goes last, so that a half-removed store is still known for what it is.
  std::error_code ignored;
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(folder_, ignored)) names.push_back(entry.path());
  for (const fs::path& name : names)
    if (name.filename() != "origin") fs::remove_all(name, ignored);
  fs::remove_all(folder_, ignored);
}

}  // namespace vsprite
