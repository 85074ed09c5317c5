// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// film/sum_over.h - sums over frames on all threads.
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace vsprite::detail {

/// What `add` makes of 0..count-1, on all threads, into sums of whole numbers: the same for any
/// number of threads. Sum: has += for another.
template <class Sum, class Add>
Sum sum_over(std::size_t count, Add add) {
  tbb::enumerable_thread_specific<Sum> parts;
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { add(i, parts.local()); });
  Sum sum{};
  for (const Sum& part : parts) sum += part;
  return sum;
}

}  // namespace vsprite::detail
