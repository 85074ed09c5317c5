// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Decoding the pictures of a pack, one core: ours beside libpng, QOI, zstd and LZ4 on the same
// pixels.
//   VSPRITE_PACK=FILE.vsp frame_bench
// bytes_per_second counts RGBA delivered; `ratio` is RGBA bytes / compressed bytes. Ours includes
// checking the bytes; PNG and QOI hold straight alpha, as in a work folder.
#include <benchmark/benchmark.h>
#include <lz4.h>
#include <lz4hc.h>
#include <zstd.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "pack_format.h"
#include "qoi.h"

namespace vsprite {
namespace {

using Bytes = std::vector<std::uint8_t>;
constexpr std::size_t kPictures = 150;

// Evenly spread over the pack, premultiplied.
const std::vector<Image>& pictures() {
  static const std::vector<Image> all = [] {
    std::vector<Image> out;
    const char* path = std::getenv("VSPRITE_PACK");
    const auto sprite = load_pack(path ? path : "goldfish.vsp");
    if (!sprite) {
      std::fprintf(stderr, "%s (set VSPRITE_PACK)\n", sprite.error().message.c_str());
      std::exit(66);
    }
    const std::size_t n = sprite->samples().size();
    for (std::size_t k = 0; k < kPictures; ++k) {
      Image image;
      const auto sample = static_cast<std::uint32_t>(k * n / kPictures);
      if (sprite->decode_frame(sample, image) && image.width > 0) out.push_back(image);
    }
    return out;
  }();
  return all;
}

using Encode = std::function<Bytes(const Image&)>;
using Decode = std::function<bool(const Bytes&, Image&)>;  // into an image of the right size

void run(benchmark::State& state, const Encode& encode, const Decode& decode) {
  std::vector<Bytes> packed;
  std::size_t raw = 0, small = 0;
  for (const Image& image : pictures()) {
    packed.push_back(encode(image));
    raw += image.rgba.size();
    small += packed.back().size();
  }
  Image out;
  for (auto _ : state) {
    for (std::size_t i = 0; i < packed.size(); ++i) {
      out.width = pictures()[i].width;
      out.height = pictures()[i].height;
      out.rgba.resize(pictures()[i].rgba.size());
      if (!decode(packed[i], out)) return state.SkipWithError("not decoded");
      benchmark::DoNotOptimize(out.rgba.data());
    }
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * raw));
  state.counters["ratio"] = static_cast<double>(raw) / static_cast<double>(small);
  state.counters["seconds_a_picture"] =
      benchmark::Counter(static_cast<double>(state.iterations() * packed.size()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void BM_Ours(benchmark::State& state) {
  detail::FrameCodec codec;
  std::uint64_t sum = 0;
  run(
      state,
      [&](const Image& image) {
        const auto bytes = codec.encode(image);
        return Bytes(bytes.begin(), bytes.end());
      },
      [&](const Bytes& bytes, Image& out) {
        std::copy(bytes.begin(), bytes.end(), codec.input(bytes.size()).begin());
        sum += detail::hash_bytes(bytes);
        benchmark::DoNotOptimize(sum);
        return codec.decode(out.width, out.height, out);
      });
}
BENCHMARK(BM_Ours);

Bytes blocks_of(const Image& image) {
  Bytes out;
  detail::squeeze_blocks(detail::encode_blocks(image), out);
  return out;
}

// GPU-ready pictures, lossy: to pixels, for those who draw on the CPU.
void BM_OursGpuToPixels(benchmark::State& state) {
  Bytes blocks;
  run(state, blocks_of, [&](const Bytes& bytes, Image& out) {
    benchmark::DoNotOptimize(detail::hash_bytes(bytes));
    if (!detail::unsqueeze_blocks(bytes, out.width, out.height, blocks)) return false;
    detail::decode_blocks(blocks, out.width, out.height, out);
    return true;
  });
}
BENCHMARK(BM_OursGpuToPixels);

// The same to what the GPU is sent; counted as RGBA delivered.
void BM_OursGpuToBlocks(benchmark::State& state) {
  Bytes blocks;
  run(state, blocks_of, [&](const Bytes& bytes, Image& out) {
    benchmark::DoNotOptimize(detail::hash_bytes(bytes));
    const bool done = detail::unsqueeze_blocks(bytes, out.width, out.height, blocks);
    benchmark::DoNotOptimize(blocks.data());
    return done;
  });
}
BENCHMARK(BM_OursGpuToBlocks);

// Beside it: the plain blocks, LZ4 over them.
void BM_BlocksLz4Hc(benchmark::State& state) {
  Bytes blocks;
  run(
      state,
      [](const Image& image) {
        const Bytes plain = detail::encode_blocks(image);
        Bytes out(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(plain.size()))));
        out.resize(static_cast<std::size_t>(LZ4_compress_HC(
            reinterpret_cast<const char*>(plain.data()), reinterpret_cast<char*>(out.data()),
            static_cast<int>(plain.size()), static_cast<int>(out.size()), 9)));
        return out;
      },
      [&](const Bytes& bytes, Image& out) {
        const detail::BlockGrid grid(out.width, out.height);
        blocks.resize(grid.count() * detail::kBlockBytes);
        benchmark::DoNotOptimize(blocks.data());
        return LZ4_decompress_safe(
                   reinterpret_cast<const char*>(bytes.data()),
                   reinterpret_cast<char*>(blocks.data()), static_cast<int>(bytes.size()),
                   static_cast<int>(blocks.size())) == static_cast<int>(blocks.size());
      });
}
BENCHMARK(BM_BlocksLz4Hc);

void BM_LibPng(benchmark::State& state) {
  run(
      state,
      [](const Image& image) {
        Image straight = image;
        unpremultiply(straight);
        return *encode_png(straight);
      },
      [](const Bytes& bytes, Image& out) {
        auto image = decode_png(bytes, "picture");
        if (image) out = std::move(*image);
        return image.has_value();
      });
}
BENCHMARK(BM_LibPng);

void BM_Qoi(benchmark::State& state) {
  const auto straight = [](Image image) {
    unpremultiply(image);
    return image;
  };
  for (const Image& image : pictures()) {
    Image out = image;
    if (!bench::decode_qoi(bench::encode_qoi(straight(image)), out) ||
        out.rgba != straight(image).rgba)
      return state.SkipWithError("not the same pixels");
  }
  run(
      state, [&](const Image& image) { return bench::encode_qoi(straight(image)); },
      [](const Bytes& bytes, Image& out) { return bench::decode_qoi(bytes, out); });
}
BENCHMARK(BM_Qoi);

void BM_Zstd(benchmark::State& state) {
  const int level = static_cast<int>(state.range(0));
  run(
      state,
      [&](const Image& image) {
        Bytes out(ZSTD_compressBound(image.rgba.size()));
        out.resize(
            ZSTD_compress(out.data(), out.size(), image.rgba.data(), image.rgba.size(), level));
        return out;
      },
      [](const Bytes& bytes, Image& out) {
        return ZSTD_decompress(out.rgba.data(), out.rgba.size(), bytes.data(), bytes.size()) ==
               out.rgba.size();
      });
}
BENCHMARK(BM_Zstd)->Arg(3)->Arg(9);

void BM_Lz4Hc(benchmark::State& state) {
  const auto chars = [](auto* bytes) { return reinterpret_cast<char*>(bytes); };
  run(
      state,
      [&](const Image& image) {
        Bytes out(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(image.rgba.size()))));
        out.resize(static_cast<std::size_t>(
            LZ4_compress_HC(reinterpret_cast<const char*>(image.rgba.data()), chars(out.data()),
                            static_cast<int>(image.rgba.size()), static_cast<int>(out.size()), 9)));
        return out;
      },
      [&](const Bytes& bytes, Image& out) {
        return LZ4_decompress_safe(reinterpret_cast<const char*>(bytes.data()),
                                   chars(out.rgba.data()), static_cast<int>(bytes.size()),
                                   static_cast<int>(out.rgba.size())) ==
               static_cast<int>(out.rgba.size());
      });
}
BENCHMARK(BM_Lz4Hc);

}  // namespace
}  // namespace vsprite
