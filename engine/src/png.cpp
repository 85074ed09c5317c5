// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// PNG through libpng's low-level interface: its simplified one applies the gAMA chunk, which would
// change the colours that a designer sees. libpng reports errors by longjmp, so no object with a
// destructor lives in the functions that call setjmp.
#include "vsprite/image.h"

#if VSPRITE_PNG

#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>

#include "file.h"

namespace vsprite {
namespace {

constexpr png_uint_32 kLongestSide = 65535;
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 28;
constexpr std::uint64_t kMostFileBytes = std::uint64_t{1} << 30;
// Deflate turns one byte into at most 1032; a header that claims more cannot be true.
constexpr std::uint64_t kDeflateLimit = 1032;

struct Reader {
  std::span<const std::uint8_t> bytes;
  std::size_t at = 0;
  char message[160] = "";
};

void remember(png_structp png, png_const_charp message) {
  auto* reader = static_cast<Reader*>(png_get_error_ptr(png));
  std::snprintf(reader->message, sizeof reader->message, "%s", message);
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep out, std::size_t count) {
  auto* reader = static_cast<Reader*>(png_get_io_ptr(png));
  if (count > reader->bytes.size() - reader->at) png_error(png, "the file ends too early");
  std::memcpy(out, reader->bytes.data() + reader->at, count);
  reader->at += count;
}

enum class Outcome { Ok, Damaged, TooLarge, NoMemory };

// Reads the header and asks for 8-bit straight RGBA without any gamma.
Outcome read_header(png_structp png, png_infop info, const Reader& reader, Image& image) {
  png_read_info(png, info);
  const png_uint_32 width = png_get_image_width(png, info);
  const png_uint_32 height = png_get_image_height(png, info);
  if (std::uint64_t{width} * height > kMostPixels) return Outcome::TooLarge;
  const std::uint64_t raw = std::uint64_t{png_get_rowbytes(png, info)} * height;
  if (raw / kDeflateLimit > reader.bytes.size()) {
    png_error(png, "too few bytes for its width and height");
  }
  png_set_expand(png);
  png_set_scale_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  return Outcome::Ok;
}

// `rows` and `image` live in the caller, so that a longjmp skips no destructor.
Outcome read_pixels(png_structp png, png_infop info, Reader& reader, Image& image,
                    std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(png))) return Outcome::Damaged;
  const Outcome header = read_header(png, info, reader, image);
  if (header != Outcome::Ok) return header;
  const std::size_t stride = 4 * static_cast<std::size_t>(image.width);
  if (png_get_rowbytes(png, info) != stride) png_error(png, "pixels of an unknown kind");
  try {
    image.rgba.assign(stride * static_cast<std::size_t>(image.height), 0);
    rows.resize(static_cast<std::size_t>(image.height));
  } catch (const std::bad_alloc&) {
    return Outcome::NoMemory;
  }
  for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = image.rgba.data() + y * stride;
  png_read_image(png, rows.data());
  png_read_end(png, info);
  return Outcome::Ok;
}

Outcome decode(Reader& reader, Image& image) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, remember, ignore);
  if (!png) return Outcome::NoMemory;
  png_infop info = png_create_info_struct(png);
  if (!info) {
    png_destroy_read_struct(&png, nullptr, nullptr);
    return Outcome::NoMemory;
  }
  png_set_user_limits(png, kLongestSide, kLongestSide);
  png_set_chunk_malloc_max(png, 8'000'000);
  png_set_chunk_cache_max(png, 128);
  // Every optional chunk but tRNS is passed over: libpng takes memory for the length that one
  // claims.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_read_fn(png, &reader, read_bytes);
  std::vector<png_bytep> rows;
  const Outcome outcome = read_pixels(png, info, reader, image, rows);
  png_destroy_read_struct(&png, &info, nullptr);
  return outcome;
}

void append(png_structp png, png_bytep bytes, std::size_t count) {
  auto* out = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  bool failed = false;
  try {
    out->insert(out->end(), bytes, bytes + count);
  } catch (const std::bad_alloc&) {
    failed = true;
  }
  if (failed) png_error(png, "out of memory");
}

void flush(png_structp) {}

// zlib's Z_RLE, whose header this file needs for nothing else: after the filter only runs repeat in
// a filmed picture, so that looking for more takes six times as long and makes it larger.
constexpr int kRunLengths = 3;

// A fixed level and filter and no optional chunk: the same pixels, the same bytes.
bool write_pixels(png_structp png, png_infop info, const ImageView& image) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_user_limits(png, kLongestSide, kLongestSide);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB_ALPHA,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(png, 6);
  png_set_compression_strategy(png, kRunLengths);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) png_write_row(png, image.pixel(0, y));
  png_write_end(png, nullptr);
  return true;
}

}  // namespace

Result<Image> decode_png(std::span<const std::uint8_t> bytes, const std::string& name) {
  if (bytes.size() < 8 || png_sig_cmp(bytes.data(), 0, 8) != 0) {
    return Error{ErrorCode::BadFormat, name + ": not a PNG file"};
  }
  Reader reader{.bytes = bytes};
  Image image;
  switch (decode(reader, image)) {
    case Outcome::Ok:
      return image;
    case Outcome::TooLarge:
      return Error{ErrorCode::LimitExceeded, name + ": picture of " + std::to_string(image.width) +
                                                 " x " + std::to_string(image.height) +
                                                 " pixels, at most 2^28 pixels are read"};
    case Outcome::NoMemory:
      return Error{ErrorCode::OutOfMemory, name + ": out of memory"};
    case Outcome::Damaged:
      break;
  }
  const bool limit = std::strstr(reader.message, "exceeds user limit") != nullptr;
  return Error{limit ? ErrorCode::LimitExceeded : ErrorCode::CorruptData,
               name + ": damaged PNG file: " + reader.message};
}

Result<Image> read_png(const std::string& path) {
  auto bytes = detail::read_file(path, kMostFileBytes);
  if (!bytes) return bytes.error();
  return decode_png(*bytes, path);
}

Result<std::vector<std::uint8_t>> encode_png(ImageView image) {
  assert(image.width > 0 && image.height > 0);
  const Error no_memory{ErrorCode::OutOfMemory, "out of memory while writing a PNG file"};
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, ignore);
  if (!png) return no_memory;
  png_infop info = png_create_info_struct(png);
  std::vector<std::uint8_t> out;
  png_set_write_fn(png, &out, append, flush);
  const bool ok = info && write_pixels(png, info, image);
  png_destroy_write_struct(&png, &info);
  if (!ok) return no_memory;
  return out;
}

}  // namespace vsprite

#else  // a build without libpng

namespace vsprite {
namespace {

Error without_png(const std::string& what) {
  return {ErrorCode::Unavailable,
          what + ": PNG files are not read or written by this build (VSPRITE_PNG=OFF)"};
}

}  // namespace

Result<Image> decode_png(std::span<const std::uint8_t>, const std::string& name) {
  return without_png(name);
}
Result<Image> read_png(const std::string& path) { return without_png(path); }
Result<std::vector<std::uint8_t>> encode_png(ImageView) { return without_png("picture"); }

}  // namespace vsprite

#endif
