// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  vsprite::fuzz::fuzz_pack({bytes, size});
  return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size,
                                        std::size_t capacity);

// Half of the mutations keep wrong sums, half get past them to what the numbers mean.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size,
                                               std::size_t capacity, unsigned seed) {
  const std::size_t mutated = LLVMFuzzerMutate(bytes, size, capacity);
  return seed % 2 == 0 ? mutated : vsprite::fuzz::repair_pack(bytes, mutated, capacity);
}
