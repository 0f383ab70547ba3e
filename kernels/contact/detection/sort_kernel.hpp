// Sorting by whole numbers, the same on any number of threads: a stable radix sort over chunks of fixed length.
#pragma once

#include <cstdint>

#include "kernels/device/device_kernel.hpp"

namespace rockfold::contact {

using device::Array;

/// Keys with a value each, and the space that sorting them takes. Grows, never shrinks.
struct SortedKeys {
  Array<std::uint64_t> key, other_key;
  Array<Index> value, other_value;
  Array<Index> histogram;  ///< [256][chunks]
};

/// Room for n keys; what was there is lost where it grows.
void reserve(SortedKeys& keys, std::size_t n);

/// Sorts the first n by the lowest `bits` bits of their keys (no higher bit is set). O(n bits/8).
void sort(SortedKeys& keys, Index n, int bits);

/// The first i < n with key(i) ≥ `least`, else n.
KOKKOS_INLINE_FUNCTION Index lower_bound(const Array<std::uint64_t>& key, Index n,
                                         std::uint64_t least) {
  Index low = 0, high = n;
  while (low < high) {
    const Index middle = low + (high - low) / 2;
    if (key(middle) < least)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

/// begin(i) = Σ of what was in begin before i, for i ≤ n; returns begin(n). begin(n) may hold anything.
Index to_offsets(const Array<Index>& begin, Index n);

}  // namespace rockfold::contact
