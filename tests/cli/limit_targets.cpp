// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// Preloaded into the tool by the determinism test: the CPU seems to have no better instructions than
// VSPRITE_TEST_TARGET (avx3_dl, avx3, avx2, sse4, ssse3, none) names, for the tool's own code, and in
// the last three for FFmpeg's decoders and colour conversion too.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

extern "C" {
#include <libavutil/cpu.h>
}
#include <hwy/targets.h>

namespace {

struct Target {
  std::string_view name;
  std::int64_t bit;
  int av_flags;  // of FFmpeg; -1: all that the CPU has
};
constexpr int kSsse3 = AV_CPU_FLAG_MMX | AV_CPU_FLAG_MMXEXT | AV_CPU_FLAG_SSE | AV_CPU_FLAG_SSE2 |
                       AV_CPU_FLAG_SSE3 | AV_CPU_FLAG_SSSE3 | AV_CPU_FLAG_CMOV;
constexpr Target kTargets[] = {
    {"avx3_dl", HWY_AVX3_DL, -1},
    {"avx3", HWY_AVX3, -1},
    {"avx2", HWY_AVX2, -1},
    {"sse4", HWY_SSE4, kSsse3 | AV_CPU_FLAG_SSE4 | AV_CPU_FLAG_SSE42},
    {"ssse3", HWY_SSSE3, kSsse3},
    {"none", std::int64_t{1} << (HWY_HIGHEST_TARGET_BIT_X86 + 1), 0},
};

[[gnu::constructor]] void limit() {
  const char* wanted = std::getenv("VSPRITE_TEST_TARGET");
  if (wanted == nullptr) return;
  for (const Target& target : kTargets) {
    if (target.name != wanted) continue;
    hwy::DisableTargets(target.bit - 1);  // a better one has a lower bit
    if (target.av_flags != -1) av_force_cpu_flags(target.av_flags & av_get_cpu_flags());
    return;
  }
  std::fprintf(stderr, "limit_targets: no such target: %s\n", wanted);
  std::_Exit(2);
}

}  // namespace
