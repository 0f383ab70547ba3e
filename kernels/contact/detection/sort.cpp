#include <utility>

#include "kernels/contact/detection/sort_kernel.hpp"

namespace rockfold::contact {

namespace {

/// Keys of a chunk: enough of them to pay for its 256 counters.
constexpr Index chunk = 1024;

Index chunks_of(Index n) {
  return (n + chunk - 1) / chunk;
}

void count_digits(const SortedKeys& k, Index n, int shift) {
  const Index chunks = chunks_of(n);
  const auto key = k.key;
  const auto histogram = k.histogram;
  device::for_each(
      "rockfold::contact::count_digits", chunks,
      KOKKOS_LAMBDA(const Index c) {
        for (Index d = 0; d < 256; ++d) histogram(d * chunks + c) = 0;
        const Index end = (c + 1) * chunk < n ? (c + 1) * chunk : n;
        for (Index i = c * chunk; i < end; ++i)
          ++histogram(static_cast<Index>((key(i) >> shift) & 255) * chunks + c);
      },
      chunk);
}

void move_keys(const SortedKeys& k, Index n, int shift) {
  const Index chunks = chunks_of(n);
  const SortedKeys s = k;
  device::for_each(
      "rockfold::contact::move_keys", chunks,
      KOKKOS_LAMBDA(const Index c) {
        const Index end = (c + 1) * chunk < n ? (c + 1) * chunk : n;
        for (Index i = c * chunk; i < end; ++i) {
          const Index at =
              s.histogram(static_cast<Index>((s.key(i) >> shift) & 255) * chunks + c)++;
          s.other_key(at) = s.key(i);
          s.other_value(at) = s.value(i);
        }
      },
      chunk);
}

}  // namespace

void reserve(SortedKeys& k, std::size_t n) {
  if (k.key.extent(0) >= n) return;
  const std::size_t room = n + n / 2;
  k.key = device::allocate<std::uint64_t>("contact::key", room);
  k.other_key = device::allocate<std::uint64_t>("contact::other_key", room);
  k.value = device::allocate<Index>("contact::value", room);
  k.other_value = device::allocate<Index>("contact::other_value", room);
  k.histogram = device::allocate<Index>(
      "contact::histogram",
      256 * static_cast<std::size_t>(chunks_of(static_cast<Index>(room))) + 1);
}

void sort(SortedKeys& k, Index n, int bits) {
  for (int shift = 0; shift < bits; shift += 8) {
    count_digits(k, n, shift);
    to_offsets(k.histogram, 256 * chunks_of(n));
    move_keys(k, n, shift);
    std::swap(k.key, k.other_key);
    std::swap(k.value, k.other_value);
  }
}

Index to_offsets(const Array<Index>& begin, Index n) {
  Index total = 0;
  const auto add = KOKKOS_LAMBDA(const Index i, Index& sum, const bool last) {
    const Index own = begin(i);
    if (last) begin(i) = sum;
    sum += own;
  };
  if (!device::on_gpu && n <= device::serial_limit) {
    for (Index i = 0; i < n; ++i) add(i, total, true);
  } else {
    Kokkos::parallel_scan("rockfold::contact::offsets", device::Range(0, n), add, total);
  }
  Kokkos::deep_copy(Kokkos::subview(begin, n), total);
  return total;
}

}  // namespace rockfold::contact
